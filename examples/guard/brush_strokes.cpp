// SPDX-License-Identifier: GPL-3.0-or-later
// Each brush on a ring, on both sides of a plane of symmetry, with a part of the ring masked.
#include "example_meshes.h"

#include <haptic_sculpt/sculpting/brushes.h>

#include <iostream>

int main() {
  Mesh mesh = torus(96, 32, 0.4, 0.15);
  haptic_sculpt::Sculptor<Mesh> sculptor(mesh);
  const auto mask = mesh.add_property_map<Mesh::Vertex_index, double>("v:mask", 1).first;
  for (const auto v : mesh.vertices())
    mask[v] = mesh.point(v).x() > 1.2 ? 0 : 1; // the outer rim at +x stays
  const Kernel::Plane_3 symmetry(Kernel::Point_3(0, 0, 0), Kernel::Vector_3(1, 0, 0));
  const Mesh before = mesh;

  std::cout << "self-intersecting pairs before: " << self_intersecting_pairs(mesh) << '\n';
  for (const char* const name : {"grab", "inflate", "smooth", "flatten", "pinch"}) {
    haptic_sculpt::Dab_3<Kernel> dab{*haptic_sculpt::brush_kind(name), {1, 0, 0.06}, 0.4, 0.5};
    if (dab.kind == haptic_sculpt::Brush_kind::grab)
      dab.direction = Kernel::Vector_3(0, 0, -1); // down, where the underside is in the way
    const std::vector<haptic_sculpt::Dab_3<Kernel>> both = {dab, mirrored(dab, symmetry)};
    const auto report = apply_brush(sculptor, both, mask); // one step of undo
    std::cout << "after " << name << ": " << self_intersecting_pairs(mesh) << "; " << report.reached << " of "
              << report.asked << " vertices arrived\n";
  }
  for (const auto v : mesh.vertices())
    if (mask[v] == 0 && mesh.point(v) != before.point(v))
      return 1;
  return self_intersecting_pairs(mesh) == 0 ? 0 : 1;
}
