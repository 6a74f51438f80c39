// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_performance/End_state_peers.h"
#include "drag_performance/run_structures.h"

void haptic_sculpt::benchmark::run_end_states(Json& rows, std::size_t triangles, const Effort& effort) {
  End_state_peers(shell_of(triangles), effort.seed)
      .run(rows, std::min<std::size_t>(effort.peer_drags, 500), effort.slow, {0.1, 4});
}
