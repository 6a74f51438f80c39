// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/cgal_compatibility.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/assertions.h>

#include <cstddef>

namespace haptic_sculpt::internal {

/// What CGAL's functions work on, whatever the user's kernel: a mesh that counts the steps from a half-edge to the next
/// or the one before. Corefinement walks around vertices up to a border that is not there where two solids touch in
/// certain ways, and would go on for ever.
class Work_mesh : public CGAL::Surface_mesh<Decision_kernel::Point_3> {
  using Base = CGAL::Surface_mesh<Decision_kernel::Point_3>;

  /// For each half-edge and for each of 1000 more, so that a mesh that is being built has some. Far more than functions
  /// take that are linear in the half-edges, or nearly so, and on a tiny mesh a fraction of a second.
  static constexpr std::size_t most_steps = 10000;

public:
  /// \throw CGAL::Failure_exception if there have been too many
  void count_step() const {
    if (++steps_ > most_steps * (num_halfedges() + 1000))
      throw CGAL::Failure_exception("CGAL", "", __FILE__, __LINE__, "", "a walk along half-edges that does not end");
  }

  friend Halfedge_index next(Halfedge_index h, const Work_mesh& mesh) {
    mesh.count_step();
    return static_cast<const Base&>(mesh).next(h);
  }
  friend Halfedge_index prev(Halfedge_index h, const Work_mesh& mesh) {
    mesh.count_step();
    return static_cast<const Base&>(mesh).prev(h);
  }

  /// CGAL 6 clears a Surface_mesh at once, and what is derived from one in quadratic time.
  friend void remove_all_elements(Work_mesh& mesh) { mesh.clear_without_removing_property_maps(); }

private:
  mutable std::size_t steps_ = 0;
};

} // namespace haptic_sculpt::internal

#define CGAL_GRAPH_TRAITS_INHERITANCE_CLASS_NAME haptic_sculpt::internal::Work_mesh
#define CGAL_GRAPH_TRAITS_INHERITANCE_BASE_CLASS_NAME CGAL::Surface_mesh<haptic_sculpt::Decision_kernel::Point_3>
#include <CGAL/boost/graph/graph_traits_inheritance_macros.h>

/// \cond
template <>
struct boost::graph_traits<const haptic_sculpt::internal::Work_mesh>
    : boost::graph_traits<haptic_sculpt::internal::Work_mesh> {};
/// \endcond
