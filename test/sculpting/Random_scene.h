// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seeds_and_sizes.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/sculpting.h>

#include <cstdlib>
#include <iostream>
#include <string>

namespace haptic_sculpt::test {

using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vertex_index = Mesh::Vertex_index;
using Random = std::mt19937_64;

/// Of 42 vertices.
inline Mesh ball() { return meshes::to_mesh(meshes::icosphere(1)); }

/// The seed of what is named: its own, so that nothing drawn for it hangs on what else there is.
inline std::uint64_t seed_of(const std::string& name, std::uint64_t seed) {
  std::uint64_t hash = 14695981039346656037u; // FNV-1a: the same everywhere
  for (const char c : name)
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash ^ (seed * 0x9e3779b97f4a7c15u);
}

inline Point_3 random_grid_point(Random& random, int size) {
  const auto coordinate = [&] { return static_cast<double>(random() % (2 * size + 1)) - size; };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

/// A valid mesh of 4 to 12 vertices on a small integer grid: coplanar faces, aligned edges and touching-near parts
/// abound.
inline meshes::Triangle_list random_small_list(Random& random, int size) {
  for (;;) {
    meshes::Triangle_list list;
    switch (random() % 5) {
    case 0: list = meshes::tetrahedron(); break;
    case 1: list = meshes::bipyramid(3 + random() % 4); break;
    case 2: list = meshes::cube(); break;
    case 3: list = meshes::bipyramid(3), list += meshes::tetrahedron(); break;
    default: list = meshes::tetrahedron(), list += meshes::tetrahedron();
    }
    for (int attempt = 0; attempt < 200; ++attempt) {
      for (Point_3& p : list.points)
        p = random_grid_point(random, size);
      const Mesh mesh = meshes::to_mesh(list);
      if (validate(mesh).is_valid())
        return list;
    }
  }
}

} // namespace haptic_sculpt::test
