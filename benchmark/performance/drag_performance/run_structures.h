// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// One translation unit a structure: each holds a whole Sculptor.

#include "drag_performance/Latencies.h"
#include "drag_performance/workload_meshes.h"

#include <haptic_sculpt/sculpting/Response.h>

namespace haptic_sculpt::benchmark {

/// How much to run.
struct Effort {
  std::size_t drags = 20000;     ///< timed operations of the box tree, a workload
  std::size_t peer_drags = 2000; ///< the same of other structures, at most
  std::size_t slow = 3;          ///< operations that take about a second on a large mesh
  std::uint64_t seed = 1;
};

/// All workloads of the default Sculptor: torus, shell and flat region of that many triangles.
void run_box_tree(Json& rows, std::size_t triangles, const Effort& effort);
/// Nearest vertices, first hits of segments, beginnings of a probe.
void run_finding(Json& rows, std::size_t triangles, const Effort& effort);
/// High valences.
void run_valences(Json& rows, const std::vector<std::size_t>& valences, const Effort& effort);
/// Where the time of a drag goes.
void run_phases(Json& phases, std::size_t triangles, const Effort& effort);

/// New vertex, in a drag, long push and contact of a Sculptor with another broad phase.
void run_brute_force(Json& rows, std::size_t triangles, const Effort& effort);
void run_six_lists(Json& rows, std::size_t triangles, const Effort& effort);
void run_rtree(Json& rows, std::size_t triangles, const Effort& effort);

/// What memory costs here, and how many cache lines a new vertex needs.
void run_memory(Json& rows, std::size_t triangles, const Effort& effort);

/// CGAL's AABB_tree and does_self_intersect after a move.
void run_end_states(Json& rows, std::size_t triangles, const Effort& effort);

} // namespace haptic_sculpt::benchmark
