// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Random_places.h"
#include "meshes/thin_walls.h"

#include <haptic_sculpt/sculpting.h>

#include <cmath>
#include <limits>

namespace haptic_sculpt::robustness {

/// Hills after this many random slides: full of contacts, slivers and folds, none of them drawn by hand.
inline Mesh crumpled(std::size_t slides, std::uint64_t seed) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.2, 0.02, 5));
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::slide));
  Random_places places(mesh, seed);
  for (std::size_t k = 0; k < slides; ++k) {
    const Vertex_index v = places.vertex();
    sculptor.grab(v).drag_to(k % 3 == 0 ? places.through(v) : places.long_step(v));
  }
  return mesh;
}

/// A cube between z = 1 and the next double.
inline meshes::Triangle_list plate_of_one_ulp() {
  return meshes::cube().transform([](const Point_3& p) {
    return Point_3(p.x(), p.y(), p.z() > 0.5 ? std::nextafter(1.0, 2.0) : 1.0);
  });
}

/// Two cubes whose sides are 2^-52 apart.
inline meshes::Triangle_list cubes_almost_touching() {
  meshes::Triangle_list list = meshes::box(4), other = meshes::box(4);
  return list += other.scale_and_move(1, 1 + std::numeric_limits<double>::epsilon(), 0.125, 0.25);
}

/// Spheres one in the other, every second one inside out.
inline meshes::Triangle_list nested_spheres(int count) {
  meshes::Triangle_list list;
  for (int k = 0; k < count; ++k) {
    meshes::Triangle_list sphere = meshes::icosphere(2);
    sphere.scale_and_move(1 - 0.1 * k, 0, 0, 0);
    list += k % 2 == 0 ? sphere : sphere.turn_inside_out();
  }
  return list;
}

/// Meshes on which rounded arithmetic errs, each for a reason of its own.
inline std::vector<std::pair<std::string, Mesh>> hard_meshes() {
  using namespace meshes;
  std::vector<std::pair<std::string, Mesh>> list;
  list.emplace_back("plate of one ulp", to_mesh(plate_of_one_ulp()));
  list.emplace_back("dihedral angles of 1e-10", to_mesh(bipyramid(32, 1e-10)));
  list.emplace_back("valence 256", to_mesh(bipyramid(256)));
  list.emplace_back("valence 20,000", to_mesh(bipyramid(20000)));
  list.emplace_back("comb, plates 2^-35 apart", to_mesh(comb(6, 3)));
  list.emplace_back("layers 2^-39 thick", to_mesh(sliver_stack(12, 0x1p-39)));
  list.emplace_back("cubes 2^-52 apart", to_mesh(cubes_almost_touching()));
  list.emplace_back("nested spheres", to_mesh(nested_spheres(5)));
  list.emplace_back("sponge", to_mesh(swiss_cheese(2, 1e-6, 1)));
  list.emplace_back("hollow ball, wall 0.01", to_mesh(hollow_ball(3, 0.01)));
  list.emplace_back("nearly pinched by 1e-15", to_mesh(nearly_pinched(1e-15)));
  list.emplace_back("terrain of size 1e-150", to_mesh(bumpy_sphere(2, 0.2, 0.02, 9).scale_and_move(1e-150, 0, 0, 0)));
  list.emplace_back("crumpled by 2,000 slides", crumpled(2000, 1));
  return list;
}

} // namespace haptic_sculpt::robustness
