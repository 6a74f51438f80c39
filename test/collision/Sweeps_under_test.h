// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/sweep_oracle.h"
#include "populations/sweep_populations.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <haptic_sculpt/collision.h>

#include <optional>

namespace haptic_sculpt::test {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = Swept_collision_traits_3<Kernel>;
using Impact = Impact_3<Kernel>;

inline Kernel::Point_3 point(const Sweep_query& query, int i) {
  return {query.x[3 * i], query.x[3 * i + 1], query.x[3 * i + 2]};
}

/// Calls `ask` with the functor and the five points of the query.
template <class Ask> auto with_functor(const Traits& traits, const Sweep_query& query, Ask ask) {
  const auto p = [&query](int i) { return point(query, i); };
  switch (query.kind) {
  case Sweep_kind::vertex_face: return ask(traits.vertex_face_sweep_3_object(), p(0), p(1), p(2), p(3), p(4));
  case Sweep_kind::edge_edge: return ask(traits.edge_edge_sweep_3_object(), p(0), p(1), p(2), p(3), p(4));
  default: return ask(traits.face_vertex_sweep_3_object(), p(0), p(1), p(2), p(3), p(4));
  }
}

inline std::optional<Impact> sweep(const Traits& traits, const Sweep_query& query) {
  return with_functor(traits, query, [](const auto& functor, const auto&... p) -> std::optional<Impact> {
    return functor(p...);
  });
}

inline bool do_collide(const Traits& traits, const Sweep_query& query) {
  return with_functor(traits, query, [](const auto& functor, const auto&... p) -> bool {
    return functor.do_collide(p...);
  });
}

inline Impact_feature feature(Sweep_kind kind) {
  return kind == Sweep_kind::vertex_face ? Impact_feature::vertex_face
         : kind == Sweep_kind::edge_edge ? Impact_feature::edge_edge
                                         : Impact_feature::face_vertex;
}

/// The face, edge or vertex of the triangle on which the first common point lies, from its weights.
inline Triangle_location location(const First_meeting& meeting) {
  const bool a = meeting.has_weight[2], b = meeting.has_weight[3], c = meeting.has_weight[4];
  if (a && b && c)
    return Triangle_location::face;
  if (a && b)
    return Triangle_location::edge_ab;
  if (b && c)
    return Triangle_location::edge_bc;
  if (a && c)
    return Triangle_location::edge_ca;
  return a ? Triangle_location::vertex_a : b ? Triangle_location::vertex_b : Triangle_location::vertex_c;
}

} // namespace haptic_sculpt::test
