// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/exact_triangles.h"

#include <gmpxx.h>

namespace haptic_sculpt::test {

/// Vertices on their way along one axis, and nothing else that moves.
struct Axis_scene {
  oracle::Mesh_list mesh; ///< at the start
  int axis;
  std::vector<double> ends; ///< of all vertices, along the axis
};

/// Whether no face is degenerate at time t and all pairs meet properly: integers and all pairs. Shares nothing with
/// what decides whole motions, not even that anything is affine in time.
inline bool is_embedded_at(const Axis_scene& scene, const mpq_class& t) {
  const std::size_t n = scene.mesh.points.size();
  std::vector<oracle::Point<mpz_class>> points(n);
  for (int k = 0; k < 3; ++k) { // each axis scaled to integers by itself, which keeps an embedding one
    std::vector<mpq_class> x(n);
    mpz_class denominator = 1;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = scene.mesh.points[i][k];
      if (k == scene.axis)
        x[i] += t * (mpq_class(scene.ends[i]) - x[i]);
      denominator = lcm(denominator, x[i].get_den());
    }
    for (std::size_t i = 0; i < n; ++i)
      points[i][k] = x[i].get_num() * (denominator / x[i].get_den());
  }
  const oracle::Still_signs<mpz_class> signs{points};
  for (const auto& f : scene.mesh.faces)
    if (oracle::on_one_line(signs, f[0], f[1], f[2]))
      return false;
  for (std::size_t f = 0; f < scene.mesh.faces.size(); ++f)
    for (std::size_t g = 0; g < f; ++g)
      if (oracle::triangles_meet_improperly(signs, scene.mesh.faces[f], scene.mesh.faces[g]))
        return false;
  return true;
}

/// Every time in (0, 1] at which four vertices can be in one plane, or three in one vertical plane on a line.
inline std::vector<mpq_class> times_in_one_plane(const Axis_scene& scene) {
  std::vector<mpq_class> times{1};
  const auto& p = scene.mesh.points;
  const int n = static_cast<int>(p.size()), i = (scene.axis + 1) % 3, j = (scene.axis + 2) % 3;
  // In these determinants rows are (1, x, y, h) or (1, x, h): affine in the heights h.
  const auto add = [&times](const mpq_class& start, const mpq_class& end) {
    if (start != end && sgn(start) * sgn(end) <= 0)
      times.push_back(start / (start - end));
  };
  const auto minor = [&p](int a, int b, int c, int x, int y) {
    return mpq_class((mpq_class(p[b][x]) - p[a][x]) * (mpq_class(p[c][y]) - p[a][y]) -
                     (mpq_class(p[b][y]) - p[a][y]) * (mpq_class(p[c][x]) - p[a][x]));
  };
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      for (int c = b + 1; c < n; ++c) {
        for (const int x : {i, j}) {
          mpq_class ends[2];
          for (int end = 0; end < 2; ++end) {
            const auto h = [&](int v) { return mpq_class(end == 0 ? p[v][scene.axis] : scene.ends[v]); };
            ends[end] = (mpq_class(p[b][x]) - p[a][x]) * (h(c) - h(a)) - (mpq_class(p[c][x]) - p[a][x]) * (h(b) - h(a));
          }
          add(ends[0], ends[1]);
        }
        for (int d = c + 1; d < n; ++d) {
          mpq_class ends[2];
          for (int end = 0; end < 2; ++end) {
            const auto h = [&](int v) { return mpq_class(end == 0 ? p[v][scene.axis] : scene.ends[v]); };
            ends[end] = h(a) * minor(b, c, d, i, j) - h(b) * minor(a, c, d, i, j) + h(c) * minor(a, b, d, i, j) -
                        h(d) * minor(a, b, c, i, j);
          }
          add(ends[0], ends[1]);
        }
      }
  return times;
}

} // namespace haptic_sculpt::test
