// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Exact sweep predicates on points. Needs CGAL and GMP.

#include <haptic_sculpt/collision/Axis_sweep_traits_3.h>
#include <haptic_sculpt/collision/Swept_collision_traits_3.h>
