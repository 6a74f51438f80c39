// SPDX-License-Identifier: GPL-3.0-or-later
// What the guard says to those of CGAL's functions that do more than move points.
#include "example_meshes.h"

#include <haptic_sculpt/sculpting/guarded_point_map.h>

#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <boost/iterator/function_output_iterator.hpp>

#include <iostream>

namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;
using haptic_sculpt::Sculptor;

namespace {

const Mesh thin_ring = torus(48, 12, 0.5, 0.04);
constexpr double length = 0.08; // of an edge, less than the ring's have
bool is_as_told = true;

void tell(const std::string& row, const std::string& outcome, bool as_told) {
  std::cout << row << ": " << outcome << (as_told ? "\n" : ", WHICH IS NOT WHAT THE DOCUMENTATION TELLS\n");
  is_as_told = is_as_told && as_told;
}

/// \param function `function(mesh, sculptor)` changes connectivity and then moves a vertex
template <class Function>
void expect_mesh_changed(const std::string& row, const Function& function) {
  Mesh mesh = thin_ring;
  Sculptor<Mesh> sculptor(mesh);
  try {
    function(mesh, sculptor);
    tell(row, "not noticed", false);
  } catch (const haptic_sculpt::Mesh_changed& error) {
    tell(row, "Mesh_changed, at the first point that is put", true);
  }
}

void expect_invalid(const std::string& row, Mesh mesh) {
  try {
    Sculptor<Mesh> sculptor(mesh);
    tell(row, "not noticed", false);
  } catch (const haptic_sculpt::Invalid_surface& error) {
    tell(row, "its input is no mesh for a Sculptor (Invalid_surface)", true);
  }
}

const auto drop = boost::make_function_output_iterator([](const auto&) {});

/// Remeshing that only relaxes and projects moves points and no more.
void relax_and_project_only() {
  const auto only_moves = params::do_split(false).do_collapse(false).do_flip(false).number_of_iterations(5);
  Mesh plain = thin_ring, guarded = thin_ring;
  PMP::isotropic_remeshing(plain.faces(), length, plain, only_moves);
  Sculptor<Mesh> sculptor(guarded);
  const auto map = haptic_sculpt::guarded_point_map(sculptor);
  PMP::isotropic_remeshing(guarded.faces(), length, guarded, only_moves.vertex_point_map(map));
  const std::size_t alone = self_intersecting_pairs(plain), pairs = self_intersecting_pairs(guarded);
  tell("isotropic_remeshing, split, collapse and flip off",
       std::to_string(alone) + " self-intersecting pairs alone, " + std::to_string(pairs) + " guarded; " +
           std::to_string(map.refused()) + " of " + std::to_string(map.counts().puts) + " points were not reached",
       alone > 0 && pairs == 0);
}

} // namespace

int main() {
  relax_and_project_only();
  expect_mesh_changed("isotropic_remeshing", [](Mesh& mesh, Sculptor<Mesh>& sculptor) {
    PMP::isotropic_remeshing(mesh.faces(), length, mesh,
                             params::vertex_point_map(haptic_sculpt::guarded_point_map(sculptor)));
  });
  expect_mesh_changed("split_long_edges", [](Mesh& mesh, Sculptor<Mesh>& sculptor) {
    PMP::split_long_edges(mesh.edges(), length, mesh,
                          params::vertex_point_map(haptic_sculpt::guarded_point_map(sculptor)));
  });
  expect_mesh_changed("refine", [](Mesh& mesh, Sculptor<Mesh>& sculptor) {
    const std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().begin() + 100);
    PMP::refine(mesh, faces, drop, drop,
                params::density_control_factor(5).vertex_point_map(haptic_sculpt::guarded_point_map(sculptor)));
  });
  expect_mesh_changed("corefine_and_compute_difference, then a drag", [](Mesh& mesh, Sculptor<Mesh>& sculptor) {
    Mesh tool = torus(24, 6, 0.3);
    PMP::corefine_and_compute_difference(mesh, tool, mesh);
    put(haptic_sculpt::guarded_point_map(sculptor), *mesh.vertices().begin(), Kernel::Point_3(2, 0, 0));
  });

  Mesh holed = thin_ring, crossing = thin_ring;
  CGAL::Euler::remove_face(holed.halfedge(*holed.faces().begin()), holed);
  expect_invalid("hole filling, stitch_borders", holed);
  PMP::tangential_relaxation(crossing, params::number_of_iterations(5));
  expect_invalid("remove_self_intersections", crossing);
  return is_as_told ? 0 : 1;
}
