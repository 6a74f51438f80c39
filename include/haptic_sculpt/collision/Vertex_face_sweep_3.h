// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Sweep_3.h>

namespace haptic_sculpt {

/// Does a vertex on its way from `s` to `t` touch the closed triangle `a`, `b`, `c`, and when first?
///
/// Exact for all finite doubles (the 1997 paper, 3.2.1, test I: segment st meets triangle abc). Where a, b, c are
/// collinear or coincide the answer is about their hull, exact as well.
template <class K, class Counters = No_filter_counters>
using Vertex_face_sweep_3 = Sweep_3<Impact_feature::vertex_face, K, Counters>;

} // namespace haptic_sculpt
