// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/cgal_compatibility.h>

#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/tags.h>

#include <cstddef>

namespace haptic_sculpt::internal {

/// What holes are closed with. CGAL seeks their triangles in a Delaunay triangulation, and of some that are as good
/// takes those it meets first: in the order of its cells, which is that of their addresses where they have no time
/// stamps. Those of this kernel have, so that the same hole gets the same triangles in each process.
struct Hole_kernel : Decision_kernel {};

} // namespace haptic_sculpt::internal

/// \cond
template <class Cell_base>
class CGAL::Delaunay_triangulation_cell_base_3<haptic_sculpt::internal::Hole_kernel, Cell_base>
    : public CGAL::Delaunay_triangulation_cell_base_3<haptic_sculpt::Decision_kernel, Cell_base> {
  using Base = CGAL::Delaunay_triangulation_cell_base_3<haptic_sculpt::Decision_kernel, Cell_base>;

public:
  using Has_timestamp = CGAL::Tag_true;
  template <class Structure>
  struct Rebind_TDS {
    using Cells = typename Cell_base::template Rebind_TDS<Structure>::Other;
    using Other = CGAL::Delaunay_triangulation_cell_base_3<haptic_sculpt::internal::Hole_kernel, Cells>;
  };

  using Base::Base;
  std::size_t time_stamp() const { return time_stamp_; }
  void set_time_stamp(const std::size_t& time_stamp) { time_stamp_ = time_stamp; }

private:
  std::size_t time_stamp_ = static_cast<std::size_t>(-1); ///< none yet
};
/// \endcond
