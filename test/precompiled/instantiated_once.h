// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What nearly every test, example and benchmark includes and instantiates. It is precompiled, and instantiated in one
/// translation unit for each set of options (instantiated_once.cpp): that halves the time of a small program.

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

namespace haptic_sculpt {

namespace instantiated_once {
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
} // namespace instantiated_once

namespace internal {
extern template class Guarded_mesh<instantiated_once::Mesh, Box_tree_broad_phase<instantiated_once::Mesh>,
                                   Default_edit_visitor, Exact_sweep_traits<instantiated_once::Mesh>>;
extern template class Axis_move<instantiated_once::Mesh>;
} // namespace internal

extern template class Sculptor<instantiated_once::Mesh>;
extern template class Grab<Sculptor<instantiated_once::Mesh>>;
extern template Validity_report validate<CGAL::Sequential_tag>(const instantiated_once::Mesh&, double, std::size_t);
extern template Validity_report validate_soup<CGAL::Sequential_tag>(const Face_soup&, double, std::size_t,
                                                                    std::vector<Face_soup::Index>, std::vector<bool>);
extern template instantiated_once::Mesh read_surface(const std::filesystem::path&, double, std::vector<std::string>*,
                                                     Validity_report*);
extern template void write_surface(const std::filesystem::path&, const instantiated_once::Mesh&,
                                   const Write_parameters&);

} // namespace haptic_sculpt
