// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/exchange/made_again.h"

namespace exchange_tests {

inline const Mesh ball = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));

/// A tool without a button, and what it has done.
struct Tool_bench {
  std::unique_ptr<Scene> scene = scene_of(2);
  Tool<Scene::Sculptor_type> tool{scene->sculptor, map_of_tests, 0.01, 0.001};
  Edit_journal journal{100000};
  Tool_bench() { tool.keep_journal(&journal); }

  Vector3d place(Mesh::Vertex_index v) const { return internal::vector_of(scene->mesh.point(v)); }
  Tool_step move(const Vector3d& hand) { return tool.move(map_of_tests.to_device(hand), 0); }
  bool is_made_again() {
    Entries entries;
    for (Edit entry; journal.take(entry);)
      entries.push_back(entry);
    return made_again(ball, entries) == surface_of(*scene);
  }
};

} // namespace exchange_tests
