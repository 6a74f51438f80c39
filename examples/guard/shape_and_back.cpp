// SPDX-License-Identifier: GPL-3.0-or-later
// A ring becomes another shape of the same connectivity, and a ring again: on straight ways, all vertices at the same
// pace, the surface passes through itself; under the guard it does not. Arguments: two meshes FROM and TO.
#include "example_meshes.h"

#include <haptic_sculpt/sculpting/move_vertices.h>
#include <haptic_sculpt/surface/read_surface.h>

#include <iostream>

namespace {

/// The ring turned by half a turn about the axis x, a whole one on its far side: straight ways lead through its middle.
Mesh turned(const Mesh& ring) {
  Mesh mesh = ring;
  for (const auto v : mesh.vertices()) {
    const auto& p = ring.point(v);
    const double angle = 3.141592653589793 * (1 + 0.3 * p.x());
    const double c = std::cos(angle), s = std::sin(angle);
    mesh.point(v) = Kernel::Point_3(p.x(), c * p.y() - s * p.z(), s * p.y() + c * p.z());
  }
  return mesh;
}

void go(haptic_sculpt::Sculptor<Mesh>& sculptor, const Mesh& to, const char* name) {
  const auto report = haptic_sculpt::move_vertices(sculptor, sculptor.mesh().vertices(), get(CGAL::vertex_point, to));
  std::cout << name << ": " << self_intersecting_pairs(sculptor.mesh()) << " pairs; " << report.reached << " of "
            << report.asked << " vertices arrived, " << 100 * (1 - report.left_l2 / report.asked_l2)
            << " % of the way was made\n";
}

} // namespace

int main(int argc, char** argv) try {
  if (argc != 1 && argc != 3) {
    std::cerr << "usage: shape_and_back [FROM TO]\n";
    return 2;
  }
  const Mesh from = argc > 2 ? haptic_sculpt::read_surface<Mesh>(argv[1]) : torus(64, 12, 0.2);
  const Mesh to = argc > 2 ? haptic_sculpt::read_surface<Mesh>(argv[2]) : turned(from);
  if (from.num_vertices() != to.num_vertices()) {
    std::cerr << "the meshes have " << from.num_vertices() << " and " << to.num_vertices() << " vertices\n";
    return 2;
  }
  std::size_t most = 0;
  for (int k = 1; k < 16; ++k) {
    Mesh between = from;
    for (const auto v : from.vertices())
      between.point(v) = from.point(v) + k / 16.0 * (to.point(v) - from.point(v));
    most = std::max(most, self_intersecting_pairs(between));
  }
  std::cout << "straight ways at the same pace: up to " << most << " self-intersecting pairs\n";

  Mesh mesh = from;
  haptic_sculpt::Sculptor<Mesh> sculptor(mesh);
  go(sculptor, to, "there under the guard");
  go(sculptor, from, "and back");
  return self_intersecting_pairs(mesh) == 0 && (argc > 2 || most > 0) ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
