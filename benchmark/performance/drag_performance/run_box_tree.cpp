// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_performance/Sculptor_workloads.h"
#include "drag_performance/run_structures.h"

#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>

namespace haptic_sculpt::benchmark {

namespace {

using Workloads = Sculptor_workloads<Box_tree_broad_phase<Mesh>>;

/// Seconds to build the tree alone and the whole Sculptor, and what they take.
void set_up(Json& rows, const Workload_mesh& scene) {
  Latencies tree, sculptor;
  Mesh mesh = scene.mesh;
  const auto broad_phase = tree.measure([&] { return std::make_unique<Box_tree_broad_phase<Mesh>>(mesh); });
  const auto guard = sculptor.measure([&] { return std::make_unique<Sculptor<Mesh>>(mesh); });
  const auto faces = static_cast<double>(mesh.number_of_faces());
  rows.push_back({{"structure", "box tree"},
                  {"mesh", scene.name},
                  {"triangles", static_cast<std::size_t>(mesh.number_of_faces())},
                  {"workload", "set-up"},
                  {"tree_seconds", tree.last() * 1e-9},
                  {"sculptor_seconds_with_validation", sculptor.last() * 1e-9},
                  {"tree_bytes_per_triangle", static_cast<double>(broad_phase->memory()) / faces},
                  {"sculptor_bytes_per_triangle", static_cast<double>(guard->memory()) / faces}});
}

} // namespace

void run_box_tree(Json& rows, std::size_t triangles, const Effort& effort) {
  {
    const Workload_mesh torus = torus_of(triangles);
    set_up(rows, torus);
    Workloads stop("box tree", torus, effort.seed, Response::stop);
    stop.new_vertex(rows, effort.drags, 0.1);
    stop.in_a_drag(rows, effort.drags, 0.01, 100);
    stop.in_a_drag(rows, effort.drags, 0.1, 40);
    for (const double reach : {1.0, 10.0, 30.0, 100.0})
      stop.long_push(rows, effort.drags / 4, reach);
  }
  {
    const Workload_mesh shell = shell_of(triangles);
    Workloads("box tree", shell, effort.seed, Response::stop).contact(rows, effort.drags / 50, 0.1, 20);
    Workloads slide("box tree", shell, effort.seed, Response::slide);
    slide.contact(rows, effort.drags / 50, 0.1, 20);
    slide.long_push(rows, effort.drags / 20, 100);
  }
  Workloads("box tree", flat_of(triangles), effort.seed, Response::stop)
      .in_a_flat_region(rows, effort.drags / 4, 0.1, 20);
}

void run_valences(Json& rows, const std::vector<std::size_t>& valences, const Effort& effort) {
  for (const std::size_t valence : valences)
    for (const Workload_mesh& scene : {fan_of(valence), fan_in_a_crowd(valence, effort.seed)})
      Workloads("box tree", scene, effort.seed, Response::stop)
          .apex(rows, Vertex_index(static_cast<Mesh::size_type>(valence)), valence,
                std::max<std::size_t>(20, effort.drags / 40), 0.02);
}

} // namespace haptic_sculpt::benchmark
