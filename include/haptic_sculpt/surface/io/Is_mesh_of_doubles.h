// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <type_traits>

namespace haptic_sculpt::internal {

template <class Mesh>
struct Is_mesh_of_doubles : std::false_type {};
template <class Point>
struct Is_mesh_of_doubles<CGAL::Surface_mesh<Point>>
    : std::is_same<typename CGAL::Kernel_traits<Point>::Kernel::FT, double> {};

} // namespace haptic_sculpt::internal
