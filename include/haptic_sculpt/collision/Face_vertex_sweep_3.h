// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Sweep_3.h>

namespace haptic_sculpt {

/// Does a face from the moving vertex to the edge `a`, `b` touch the point `c` while the vertex goes from `s` to `t`?
///
/// Exact for all finite doubles (the 1997 paper, 3.2.1, test III: tetrahedron stab contains c). The tetrahedron may be
/// flat. The time is 0 where `c` lies on ab. \pre a != b. Where the checks are compiled out, degenerate static features
/// are still answered exactly, as the hulls they are.
template <class K, class Counters = No_filter_counters>
using Face_vertex_sweep_3 = Sweep_3<Impact_feature::face_vertex, K, Counters>;

} // namespace haptic_sculpt
