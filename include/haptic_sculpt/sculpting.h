// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_H
#define HAPTIC_SCULPT_SCULPTING_H

/// \file
/// Dragging the vertices of a closed triangle mesh so that no surface ever passes through a surface.

#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/first_impact.h>

#endif
