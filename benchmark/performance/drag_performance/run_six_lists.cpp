// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_performance/run_peer.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>

void haptic_sculpt::benchmark::run_six_lists(Json& rows, std::size_t triangles, const Effort& effort) {
  run_peer<Six_list_broad_phase<Mesh>>("six lists", rows, triangles, effort, true);
}
