// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Sweep_3.h>

namespace haptic_sculpt {

/// Does an edge from the moving vertex to `a` touch the closed segment `b`, `c` while the vertex goes from `s` to `t`?
///
/// Exact for all finite doubles (the 1997 paper, 3.2.1, test II: triangle sta meets segment bc). s, t, a may coincide
/// or be collinear. The time is 0 where `a` itself lies on bc. \pre b != c. Where the checks are compiled out,
/// degenerate static features are still answered exactly, as the hulls they are.
template <class K, class Counters = No_filter_counters>
using Edge_edge_sweep_3 = Sweep_3<Impact_feature::edge_edge, K, Counters>;

} // namespace haptic_sculpt
