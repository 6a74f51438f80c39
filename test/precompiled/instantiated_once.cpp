// SPDX-License-Identifier: GPL-3.0-or-later
#include "instantiated_once.h"

namespace haptic_sculpt {

namespace internal {
template class Guarded_mesh<instantiated_once::Mesh, Box_tree_broad_phase<instantiated_once::Mesh>,
                            Default_edit_visitor, Exact_sweep_traits<instantiated_once::Mesh>>;
template class Axis_move<instantiated_once::Mesh>;
} // namespace internal

template class Sculptor<instantiated_once::Mesh>;
template class Grab<Sculptor<instantiated_once::Mesh>>;
template Validity_report validate<CGAL::Sequential_tag>(const instantiated_once::Mesh&, double, std::size_t);
template Validity_report validate_soup<CGAL::Sequential_tag>(const Face_soup&, double, std::size_t,
                                                             std::vector<Face_soup::Index>, std::vector<bool>);
template instantiated_once::Mesh read_surface(const std::filesystem::path&, double, std::vector<std::string>*,
                                              Validity_report*);
template void write_surface(const std::filesystem::path&, const instantiated_once::Mesh&, const Write_parameters&);

} // namespace haptic_sculpt
