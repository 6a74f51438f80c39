// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The one place that knows CGAL 5.5 from CGAL 6, but for what few are to pay for: trees (Aabb_traits.h,
/// nearest_point_tree.h) and what repairs (repair/Work_mesh.h, repair/mesh_steps.h).

#include <haptic_sculpt/no_fast_math.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/version.h>

#include <optional>
#include <string>
#include <utility>

namespace haptic_sculpt {

/// The kernel of every yes/no decision of this folder, whatever the kernel of the mesh: points are copied to it
/// coordinate by coordinate, which changes nothing, and its predicates are exact.
using Decision_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A number type in which sums, differences and products of doubles are exact.
#ifdef CGAL_HAS_MPZF
using Exact_ring_number = CGAL::Mpzf;
#else
using Exact_ring_number = CGAL::Exact_rational;
#endif

namespace internal {

/// What is certain of `question(Number())` by intervals, else by exact numbers. \pre the question needs sums,
/// differences and products only
template <class Question>
auto by_intervals_or_exactly(const Question& question) {
  {
    CGAL::Protect_FPU_rounding<true> upward;
    const auto answer = question(CGAL::Interval_nt<false>());
    if (CGAL::is_certain(answer))
      return CGAL::get_certain(answer);
  }
  return CGAL::get_certain(question(Exact_ring_number()));
}

template <class Map>
std::optional<Map> optional_of(const std::pair<Map, bool>& found) { // CGAL 5
  return found.second ? std::optional<Map>(found.first) : std::nullopt;
}
template <class Map>
std::optional<Map> optional_of(const std::optional<Map>& found) { // CGAL 6, whose adaptor derives from std::optional
  return found;
}

} // namespace internal

/// The property map `name` of `mesh` with keys `Index` and values `Value`, or nothing if there is none of that type.
template <class Index, class Value, class Mesh>
auto find_property_map(const Mesh& mesh, const std::string& name) {
  return internal::optional_of(mesh.template property_map<Index, Value>(name));
}

} // namespace haptic_sculpt
