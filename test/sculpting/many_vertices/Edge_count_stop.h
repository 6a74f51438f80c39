// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_count_stop_predicate.h>
#else
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#endif

namespace haptic_sculpt {

/// CGAL's stop at a number of edges, by the name that it has in either version.
#if CGAL_VERSION_NR >= 1060000000
template <class Mesh>
using Edge_count_stop = CGAL::Surface_mesh_simplification::Edge_count_stop_predicate<Mesh>;
#else
template <class Mesh>
using Edge_count_stop = CGAL::Surface_mesh_simplification::Count_stop_predicate<Mesh>;
#endif

} // namespace haptic_sculpt
