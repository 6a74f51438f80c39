// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/generated_meshes.h"

#include <string>

namespace haptic_sculpt::robustness {

using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vector_3 = meshes::Kernel::Vector_3;
using Vertex_index = Mesh::Vertex_index;
using Face_index = Mesh::Face_index;
using Halfedge_index = Mesh::Halfedge_index;

/// Ordinary and extreme meshes that need no file.
inline std::vector<std::pair<std::string, Mesh>> robustness_meshes() {
  using namespace meshes;
  std::vector<std::pair<std::string, Mesh>> list;
  list.emplace_back("icosphere", to_mesh(icosphere(3)));
  list.emplace_back("terrain", to_mesh(bumpy_sphere(3, 0.2, 0.02, 7)));
  list.emplace_back("flat box", to_mesh(box(12)));
  list.emplace_back("torus", to_mesh(torus(40, 20)));
  list.emplace_back("bipyramid 64", to_mesh(bipyramid(64)));
  list.emplace_back("spheres in a row", to_mesh(row_of_spheres(4)));
  list.emplace_back("ball in a cavity", to_mesh(ball_in_a_cavity()));
  list.emplace_back("C with gap 1e-12", to_mesh(c_tube(1e-12)));
  list.emplace_back("slivers", to_mesh(sliver_stack(30, 1e-9)));
  list.emplace_back("nearly pinched", to_mesh(nearly_pinched(1e-9)));
  list.emplace_back("terrain at 1e6", to_mesh(bumpy_sphere(2, 0.2, 0.02, 8).scale_and_move(1, 1e6, 1e6, 1e6)));
  list.emplace_back("terrain of size 1e-6", to_mesh(bumpy_sphere(2, 0.2, 0.02, 9).scale_and_move(1e-6, 0, 0, 0)));
  list.emplace_back("terrain of size 1e150", to_mesh(bumpy_sphere(2, 0.2, 0.02, 9).scale_and_move(1e150, 0, 0, 0)));
  return list;
}

struct Small_mesh {
  std::string name;
  Mesh mesh;
  double share; ///< of all drags: those of a tetrahedron take 1 ms, of cubes 2 to 6, of the stack 50
};

/// For drags with extreme targets and lengths. The shares add up to 1.
inline std::vector<Small_mesh> small_meshes() {
  using namespace meshes;
  return {{"tetrahedron", to_mesh(tetrahedron()), 0.915},
          {"cube", to_mesh(cube()), 0.02},
          {"split cube far off", to_mesh(box(2).scale_and_move(1, 1e6, -1e6, 0)), 0.02},
          {"sliver stack", to_mesh(sliver_stack(4, 1e-9)), 0.005},
          {"nearly pinched", to_mesh(nearly_pinched(1e-9)), 0.02},
          {"bipyramid", to_mesh(bipyramid(7)), 0.02}};
}

} // namespace haptic_sculpt::robustness
