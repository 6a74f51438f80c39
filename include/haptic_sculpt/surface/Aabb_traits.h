// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

namespace haptic_sculpt {

/// The traits of CGAL's `AABB_tree`, by the name that they have in either version.
#if CGAL_VERSION_NR >= 1060000000
template <class Kernel, class Primitive>
using Aabb_traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
template <class Kernel, class Primitive>
using Aabb_traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif

} // namespace haptic_sculpt
