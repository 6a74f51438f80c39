// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/generated_meshes.h"

namespace haptic_sculpt::benchmark {

/// A mesh to be dragged at, and what its workloads need to know.
struct Workload_mesh {
  std::string name;
  meshes::Mesh mesh;
  double edge; ///< the usual length of an edge
};

constexpr double turn = 6.283185307179586;

/// A torus of about that many triangles, nearly equilateral.
inline Workload_mesh torus_of(std::size_t triangles) {
  const auto m = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 2) / 2)) * 2;
  return {"torus", meshes::to_mesh(meshes::torus(m, triangles / 2 / m)),
          turn / std::sqrt(static_cast<double>(triangles))};
}

/// The wall of a hollow torus, three edges thick: whichever vertex goes inwards soon meets the other side.
inline Workload_mesh shell_of(std::size_t triangles) {
  const auto m = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 4) / 2)) * 2,
             n = triangles / 4 / m;
  const double edge = turn / std::sqrt(static_cast<double>(triangles) / 2);
  meshes::Triangle_list list = meshes::torus(m, n), inner = meshes::torus(m, n, 0.4 - std::min(0.2, 3 * edge));
  list += inner.turn_inside_out();
  return {"shell", meshes::to_mesh(list), edge};
}

/// A cube whose sides are exactly flat, of about that many triangles.
inline Workload_mesh flat_of(std::size_t triangles) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 12)));
  return {"flat", meshes::to_mesh(meshes::box(n)), 1 / static_cast<double>(n)};
}

/// A bipyramid: an apex over `valence` vertices. The apex has the index `valence`; everything it may touch is small in
/// number.
inline Workload_mesh fan_of(std::size_t valence) {
  return {"fan", meshes::to_mesh(meshes::bipyramid(valence)), 0.1};
}

/// The fan, and over it as many tetrahedra as the apex has neighbours, not touching it: where valence x candidates is
/// naive.
inline Workload_mesh fan_in_a_crowd(std::size_t valence, std::uint64_t seed) {
  meshes::Triangle_list list = meshes::bipyramid(valence);
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const double size = 0.3 / std::sqrt(static_cast<double>(valence));
  // On rings over the cone z = 1 - r, at twice its height.
  const auto per_ring = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(valence) * 3)));
  for (std::size_t k = 0; k < valence; ++k) {
    const double angle = turn * static_cast<double>(k % per_ring) / static_cast<double>(per_ring);
    const double r =
        0.25 + 0.7 * static_cast<double>(k / per_ring) * static_cast<double>(per_ring) / static_cast<double>(valence);
    meshes::Triangle_list crumb = meshes::tetrahedron(size * (0.5 + 0.4 * uniform()));
    list += crumb.scale_and_move(1, r * std::cos(angle), r * std::sin(angle), (1 - r) + 0.25);
  }
  return {"fan in a crowd", meshes::to_mesh(list), 0.1};
}

} // namespace haptic_sculpt::benchmark
