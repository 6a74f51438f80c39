// SPDX-License-Identifier: GPL-3.0-or-later
// Exact sweeps and their order: what does a moving vertex, edge or face touch, and which of it first?
#include <haptic_sculpt/collision.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iostream>

int main() {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Traits = haptic_sculpt::Swept_collision_traits_3<Kernel>;
  using Point_3 = Traits::Point_3;
  const Traits traits;

  // A vertex J goes straight from s to t, that is to s + u (t - s) at the time u from 0 to 1.
  const Point_3 s(0.25, 0.25, 1), t(0.25, 0.25, -2);

  // J against the closed triangle abc: met after a third of the way, which no double is.
  const Point_3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto face = traits.vertex_face_sweep_3_object()(s, t, a, b, c);
  if (!face)
    return 1;
  std::cout << "the face is met at u = " << face->exact_time() << ", " << name_of(face->location()) << '\n';

  // The edge from J to v, which stands still, against the edge pq.
  const Point_3 v(1, 1, 0), p(0, 1, 0.25), q(1, 0, 0.25);
  const auto edge = traits.edge_edge_sweep_3_object()(s, t, v, p, q);
  if (!edge)
    return 1;
  std::cout << "the edge is met at u = " << edge->exact_time() << '\n';

  // The face of J, g and i against the point w.
  const Point_3 g(1, 0, 1), i(0, 1, 1), w(0.375, 0.375, 0);
  const auto point = traits.face_vertex_sweep_3_object()(s, t, g, i, w);
  if (!point)
    return 1;
  std::cout << "the point is met at u = " << point->exact_time() << '\n';

  // The order is exact, too, and no time has to be computed for it.
  const auto compare = traits.compare_time_3_object();
  const bool edge_before_face = compare(*edge, *face) == CGAL::SMALLER;
  std::cout << "first comes " << name_of(edge_before_face ? edge->feature() : face->feature()) << '\n';

  // All sets are closed: to touch a corner at the very end is a hit, and to end an ulp before it is none.
  const bool touches = traits.vertex_face_sweep_3_object().do_collide(s, a, a, b, c);
  const bool misses = !traits.vertex_face_sweep_3_object().do_collide(s, Point_3(0, 0, 0x1p-1074), a, b, c);
  std::cout << "touching counts: " << std::boolalpha << touches << ", stopping short does not: " << misses << '\n';
  return edge_before_face && touches && misses ? 0 : 1;
}
