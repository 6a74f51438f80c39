// SPDX-License-Identifier: GPL-3.0-or-later
// Property maps: values of faces and vertices that live through remeshing, and are back after undo.
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Where two patches meet, the larger number wins.
struct Larger_patch {
  int operator()(const haptic_sculpt::Property_origin<int>& origin) const {
    int result = *origin.values[0];
    for (std::size_t k = 1; k < origin.size; ++k)
      result = std::max(result, *origin.values[k]);
    return result;
  }
};

int main() {
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Kernel::Point_3(0, 0, 0), 1.0);
  auto patch = mesh.add_property_map<Mesh::Face_index, int>("f:patch", 0).first;
  auto heat = mesh.add_property_map<Mesh::Vertex_index, double>("v:heat", 0).first;
  for (const auto f : mesh.faces())
    patch[f] = 1 + static_cast<int>(static_cast<std::size_t>(f) % 2);
  for (const auto v : mesh.vertices())
    heat[v] = mesh.point(v).z();
  const auto before = heat[Mesh::Vertex_index(0)];

  haptic_sculpt::Sculptor<Mesh> sculptor(mesh);
  sculptor.keep(patch, Larger_patch());
  sculptor.keep(heat, haptic_sculpt::Interpolate_property());

  haptic_sculpt::isotropic_remeshing(sculptor, 0.4, CGAL::parameters::number_of_iterations(2));
  const auto has_patch = [&](Mesh::Face_index f) { return patch[f] != 0; };
  const auto with_patch = std::count_if(mesh.faces().begin(), mesh.faces().end(), has_patch);
  std::cout << with_patch << " of " << mesh.number_of_faces() << " faces have a patch after remeshing\n";
  if (static_cast<std::size_t>(with_patch) != mesh.number_of_faces())
    return 1;

  if (!sculptor.undo())
    return 1;
  const bool is_back = std::all_of(mesh.faces().begin(), mesh.faces().end(), has_patch) && mesh.number_of_faces() == 20;
  std::cout << "after undo " << mesh.number_of_faces() << " faces, all with their patch: " << (is_back ? "yes" : "no")
            << '\n';
  return is_back && heat[sculptor.vertex(0)] == before ? 0 : 1;
}
