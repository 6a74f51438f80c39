// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/generated_meshes.h"

#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/connectivity/star.h>

namespace haptic_sculpt::benchmark {

using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vertex_index = Mesh::Vertex_index;
using Vector = internal::Vector;

inline Point_3 to_point(const Vector& p) { return Point_3(p[0], p[1], p[2]); }

/// Vertices and directions, the same for every structure that is compared.
class Random_motions {
public:
  explicit Random_motions(std::uint64_t seed) : random_(seed) {}

  Vertex_index vertex(const Mesh& mesh) {
    return Vertex_index(static_cast<Mesh::size_type>(random_() % mesh.num_vertices()));
  }

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  /// Of length 1, evenly distributed.
  Vector direction() {
    for (;;) {
      const Vector d = {2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1};
      const double square = internal::dot(d, d);
      if (square > 0.01 && square < 1)
        return internal::normalized(d);
    }
  }

private:
  std::mt19937_64 random_;
};

/// Out of the solid at v, of length 1: the sum of the doubled areas around it. Worth no more than its use for a
/// direction.
inline Vector normal_at(const Mesh& mesh, Vertex_index v) {
  internal::Star<Mesh> star;
  star.collect(mesh, v);
  const Vector centre = vertex_coordinates(mesh, v);
  Vector sum{};
  for (std::size_t i = 0; i < star.valence(); ++i)
    sum = internal::plus(sum, internal::cross(internal::minus(star.link_points[star.next(i)], centre),
                                              internal::minus(star.link_points[i], centre)));
  return internal::normalized(sum);
}

/// A smooth way like a hand's: the direction turns by about a tenth of a radian a step.
class Smooth_way {
public:
  Smooth_way(Random_motions& random, const Vector& direction) : random_(&random), direction_(direction) {}

  const Vector& next() {
    direction_ = internal::normalized(internal::advanced(direction_, 0.1, random_->direction()));
    return direction_;
  }

private:
  Random_motions* random_;
  Vector direction_;
};

} // namespace haptic_sculpt::benchmark
