// SPDX-License-Identifier: GPL-3.0-or-later
// Taubin's smoothing, which shrinks and swells in turn, of two noisy rings or of the MESH that is given: alone, and
// with each step under the guard. (G. Taubin, A signal processing approach to fair surface design, SIGGRAPH 1995.)
#include "example_meshes.h"

#include <haptic_sculpt/sculpting/apply_guarded.h>
#include <haptic_sculpt/surface/read_surface.h>

#include <CGAL/Random.h>

#include <iostream>

namespace {

using Vector_3 = Kernel::Vector_3;

/// Every vertex by a share of the way to the mean of its neighbours.
template <class Point_map>
void step(const Mesh& mesh, Point_map map, double share) {
  std::vector<Kernel::Point_3> moved;
  for (const auto v : mesh.vertices()) {
    Vector_3 sum = CGAL::NULL_VECTOR;
    for (const auto w : CGAL::vertices_around_target(v, mesh))
      sum = sum + (get(map, w) - get(map, v));
    moved.push_back(get(map, v) + share / static_cast<double>(mesh.degree(v)) * sum);
  }
  auto place = moved.begin();
  for (const auto v : mesh.vertices())
    put(map, v, *place++);
}

Mesh noisy_rings() {
  Mesh mesh = nested_rings(48, 8, 0.34);
  CGAL::Random random(3);
  for (const auto v : mesh.vertices())
    mesh.point(v) =
        mesh.point(v) + 0.002 * Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(-1, 1));
  return mesh;
}

} // namespace

int main(int argc, char** argv) try {
  Mesh plain = argc > 1 ? haptic_sculpt::read_surface<Mesh>(argv[1]) : noisy_rings();
  Mesh guarded = plain;
  std::cout << "self-intersecting pairs before: " << self_intersecting_pairs(plain) << '\n';
  constexpr double shrinking = 0.5, swelling = -0.53;
  constexpr int rounds = 4;
  for (int k = 0; k < rounds; ++k) {
    step(plain, get(CGAL::vertex_point, plain), shrinking);
    step(plain, get(CGAL::vertex_point, plain), swelling);
  }
  const std::size_t plain_pairs = self_intersecting_pairs(plain);
  std::cout << "after Taubin's smoothing alone: " << plain_pairs << '\n';

  haptic_sculpt::Sculptor<Mesh> sculptor(guarded);
  std::size_t asked = 0, reached = 0;
  for (int k = 0; k < rounds; ++k)
    for (const double share : {shrinking, swelling}) {
      const auto report = haptic_sculpt::apply_guarded(sculptor, [&](auto& mesh, auto map) { step(mesh, map, share); });
      asked += report.asked, reached += report.reached;
    }
  const std::size_t guarded_pairs = self_intersecting_pairs(guarded);
  std::cout << "under the guard: " << guarded_pairs << "; " << reached << " of " << asked << " motions arrived\n";
  return guarded_pairs == 0 && (argc > 1 || plain_pairs > 0) ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
