// SPDX-License-Identifier: GPL-3.0-or-later
// Does not compile, and says why in one sentence.
#include <haptic_sculpt/surface/read_surface.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

int main() {
  haptic_sculpt::read_surface<CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>>("a.off");
}
