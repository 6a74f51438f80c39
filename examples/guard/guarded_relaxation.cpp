// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's tangential relaxation of a thin wall, by itself and with one named parameter more.
#include "example_meshes.h"

#include <haptic_sculpt/sculpting/apply_guarded.h>
#include <haptic_sculpt/sculpting/guarded_point_map.h>

#include <CGAL/Polygon_mesh_processing/tangential_relaxation.h>

#include <iostream>

namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

int main() {
  Mesh plain = torus(48, 12, 0.5, 0.04), guarded = plain;
  std::cout << "self-intersecting pairs before: " << self_intersecting_pairs(plain) << '\n';

  PMP::tangential_relaxation(plain, params::number_of_iterations(5));
  const std::size_t plain_pairs = self_intersecting_pairs(plain);
  std::cout << "after CGAL alone: " << plain_pairs << '\n';

  haptic_sculpt::Sculptor<Mesh> sculptor(guarded);
  const auto map = haptic_sculpt::guarded_point_map(sculptor);
  {
    const auto stroke = sculptor.stroke(); // one step of undo
    PMP::tangential_relaxation(guarded, params::number_of_iterations(5).vertex_point_map(map));
  }
  haptic_sculpt::apply_guarded(sculptor, [](auto& mesh, auto map) {
    PMP::tangential_relaxation(mesh, params::number_of_iterations(5).vertex_point_map(map));
  });
  const std::size_t guarded_pairs = self_intersecting_pairs(guarded);
  std::cout << "after CGAL under the guard: " << guarded_pairs << "; " << map.refused() << " of " << map.counts().puts
            << " points were not reached\n";
  return plain_pairs > 0 && guarded_pairs == 0 ? 0 : 1;
}
