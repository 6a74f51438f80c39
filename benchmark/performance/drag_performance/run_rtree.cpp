// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_performance/run_peer.h"

#include "drag_performance/Rtree_broad_phase.h"

void haptic_sculpt::benchmark::run_rtree(Json& rows, std::size_t triangles, const Effort& effort) {
  run_peer<Rtree_broad_phase<Mesh>>("Boost rtree", rows, triangles, effort, false);
}
