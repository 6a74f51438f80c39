// SPDX-License-Identifier: GPL-3.0-or-later
// Repair what a file holds, say what was done, save it.
#include <haptic_sculpt/surface.h>
#include <haptic_sculpt/surface/repair.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iostream>

int main(int argc, char** argv) try {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  if (argc != 3) {
    std::cerr << "usage: repair_and_save MESH REPAIRED\n";
    return 2;
  }
  haptic_sculpt::Face_soup soup = haptic_sculpt::read_face_soup(argv[1]); // whatever its faces form
  const haptic_sculpt::Repair_report report = haptic_sculpt::repair(soup);
  std::cout << report.message(); // step by step: what was changed, and how far points moved
  if (!report.is_repaired())
    return 1; // soup is what it was
  haptic_sculpt::write_surface(argv[2], haptic_sculpt::make_surface<Mesh>(soup));
  return 0;
} catch (const haptic_sculpt::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
