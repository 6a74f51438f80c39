// SPDX-License-Identifier: GPL-3.0-or-later
// Load a surface, drag a vertex of it, save it.
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iostream>

int main(int argc, char** argv) try {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  if (argc != 3) {
    std::cerr << "usage: drag_and_save MESH SCULPTED\n";
    return 2;
  }
  Mesh mesh = haptic_sculpt::read_surface<Mesh>(argv[1]); // refuses what is not a valid surface, and names why
  haptic_sculpt::Sculptor<Mesh> sculptor(mesh, haptic_sculpt::parameters::known_valid(true)); // it was read as one
  auto grab = sculptor.grab(Mesh::Vertex_index(145));
  const auto result = grab.drag_to({2.2, 0, 0.25}); // goes there, or slides along what it may not cross
  std::cout << name_of(result.end) << " at " << result.position << " after " << result.legs << " straight legs\n";
  for (const auto& contact : result.contacts)
    std::cout << "  by a contact " << name_of(contact.kind) << '\n';
  haptic_sculpt::write_surface(argv[2], mesh); // every coordinate to the last bit
  return 0;
} catch (const haptic_sculpt::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
