// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "drag_performance/Sculptor_workloads.h"
#include "drag_performance/run_structures.h"

namespace haptic_sculpt::benchmark {

/// What takes time that grows with the mesh is done less often, so that a run ends.
template <class Broad_phase>
void run_peer(const std::string& name, Json& rows, std::size_t triangles, const Effort& effort, bool is_slow) {
  const std::size_t most = is_slow ? std::max<std::size_t>(20, 40000000 / triangles) : effort.peer_drags;
  const std::size_t count = std::min(effort.peer_drags, most);
  Sculptor_workloads<Broad_phase> torus(name, torus_of(triangles), effort.seed, Response::stop);
  torus.new_vertex(rows, count, 0.1);
  torus.in_a_drag(rows, count, 0.1, 40);
  torus.long_push(rows, count, 100);
}

} // namespace haptic_sculpt::benchmark
