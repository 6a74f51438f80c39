// SPDX-License-Identifier: GPL-3.0-or-later
// A probe slides on a surface: a point that touches and feels, and that nothing touches.
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <iostream>

int main() {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Kernel::Point_3(0, 0, 0), 1.0);

  haptic_sculpt::Sculptor<Mesh> sculptor(mesh, haptic_sculpt::parameters::clearance(1e-6));
  auto probe = sculptor.probe(Kernel::Point_3(0, 0, 2));

  // A hand moves on a circle inside of the solid; the probe stays outside, and slides after it.
  bool is_outside = true;
  int touched = 0;
  for (int tick = 0; tick < 100; ++tick) {
    const double angle = 0.06 * tick;
    const Kernel::Point_3 hand(0.6 * std::sin(angle), 0.1, 0.6 * std::cos(angle));
    const auto result = probe.drag_to(hand);
    is_outside = is_outside && !result.reached;
    touched += !result.contacts.empty();
    if (tick % 20 != 0)
      continue;
    // What a device would feel: a spring from the hand to the probe. It pushes along the normals of the contacts.
    const Kernel::Vector_3 force = 500 * (result.position - hand);
    std::cout << "hand " << hand << ": " << name_of(result.end) << ", force " << force << " N,";
    for (const auto& contact : result.contacts)
      std::cout << ' ' << name_of(contact.kind) << " with normal " << contact.normal[0] << ' ' << contact.normal[1]
                << ' ' << contact.normal[2];
    std::cout << '\n';
  }
  std::cout << "in contact in " << touched << " of 100 ticks\n";

  // Any change of the mesh ends a probe. It goes on where it is, if that is still outside.
  sculptor.grab(Mesh::Vertex_index(0)).drag_to(Kernel::Point_3(0, 0, 0.5));
  const bool has_ended = probe.drag_to({0, 0, 3}).end == haptic_sculpt::Drag_end::stale;
  probe = sculptor.probe(probe.position());
  std::cout << "placed again at " << probe.position() << ": " << (probe ? "outside" : name_of(probe.refusal()->reason))
            << '\n';
  return is_outside && touched == 100 && has_ended ? 0 : 1;
}
