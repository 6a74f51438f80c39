// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_performance/run_peer.h"

#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>

void haptic_sculpt::benchmark::run_brute_force(Json& rows, std::size_t triangles, const Effort& effort) {
  run_peer<Brute_force_broad_phase<Mesh>>("brute force", rows, triangles, effort, true);
}
