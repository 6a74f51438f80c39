// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_COLLISION_H
#define HAPTIC_SCULPT_COLLISION_H

/// \file
/// Exact sweep predicates on points. Needs CGAL and GMP.

#include <haptic_sculpt/collision/Axis_sweep_traits_3.h>
#include <haptic_sculpt/collision/Swept_collision_traits_3.h>

#endif
