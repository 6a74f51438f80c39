// SPDX-License-Identifier: GPL-3.0-or-later
// As-rigid-as-possible deformation pulls a ring through itself; its result, taken as targets, does not. An argument is
// a picture to write: left ARAP alone, with the faces of intersecting pairs in red, right the same under the guard.
#ifndef CGAL_EIGEN3_ENABLED
#define CGAL_EIGEN3_ENABLED // CGAL asks for it before it solves by Eigen
#endif

#include "example_meshes.h"
#include "picture_of_pairs.h"

#include <haptic_sculpt/sculpting/move_vertices.h>

#include <CGAL/Surface_mesh_deformation.h>

#include <iostream>

int main(int argc, char** argv) try {
  const Mesh input = torus(48, 12, 0.2);
  Mesh bent = input, mesh = input;

  // Two opposite sides of the ring are pulled towards, and past, one another.
  CGAL::Surface_mesh_deformation<Mesh> deformation(bent);
  deformation.insert_roi_vertices(vertices(bent).begin(), vertices(bent).end());
  std::vector<Mesh::Vertex_index> handles;
  for (const auto v : bent.vertices())
    if (std::abs(input.point(v).x()) > 0.9 && std::abs(input.point(v).y()) < 0.3)
      handles.push_back(v);
  deformation.insert_control_vertices(handles.begin(), handles.end());
  if (!deformation.preprocess())
    return 2;
  for (const auto v : handles)
    deformation.set_target_position(v, input.point(v) + Kernel::Vector_3(input.point(v).x() > 0 ? -1.1 : 1.1, 0, 0));
  deformation.deform(20, 1e-4);

  std::cout << "self-intersecting pairs before: " << self_intersecting_pairs(input) << '\n'
            << "after ARAP alone: " << self_intersecting_pairs(bent) << '\n';

  haptic_sculpt::Sculptor<Mesh> sculptor(mesh);
  const auto report = haptic_sculpt::move_vertices(sculptor, mesh.vertices(), get(CGAL::vertex_point, bent));
  std::cout << "ARAP under the guard: " << self_intersecting_pairs(mesh) << "; " << report.reached << " of "
            << report.asked << " vertices arrived, " << 100 * (1 - report.left_l2 / report.asked_l2)
            << " % of the way was made\n";
  if (argc > 1) {
    haptic_sculpt::drawing::Scene scene;
    add_to_picture(scene, bent, 0);
    add_to_picture(scene, mesh, 2);
    haptic_sculpt::drawing::View view;
    view.direction = {-0.2, 1, -2};
    view.width = 1400, view.height = 800;
    haptic_sculpt::drawing::write_picture(scene, argv[1], view);
  }
  return self_intersecting_pairs(bent) > 0 && self_intersecting_pairs(mesh) == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
