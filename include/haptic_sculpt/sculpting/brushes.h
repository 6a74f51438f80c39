// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_BRUSHES_H
#define HAPTIC_SCULPT_SCULPTING_BRUSHES_H

/// \file
/// Brushes: grab, inflate, smooth, flatten, pinch, with masks and symmetry. A dab is one batch of proven moves.

#include <haptic_sculpt/sculpting/brushes/Brush_dab.h>
#include <haptic_sculpt/sculpting/brushes/Brush_kind.h>
#include <haptic_sculpt/sculpting/brushes/apply_brush.h>
#include <haptic_sculpt/sculpting/brushes/brush_targets.h>

#endif
