// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

/// \file
/// What CGAL 6 calls otherwise about its `AABB_tree`, by one name in either version.

namespace haptic_sculpt {

#if CGAL_VERSION_NR >= 1060000000
template <class Kernel, class Primitive>
using Aabb_traits = CGAL::AABB_traits_3<Kernel, Primitive>; ///< of a tree
template <class Kernel, class Triangle_iterator>
using Aabb_triangle = CGAL::AABB_triangle_primitive_3<Kernel, Triangle_iterator>; ///< a primitive of a tree
#else
template <class Kernel, class Primitive>
using Aabb_traits = CGAL::AABB_traits<Kernel, Primitive>; ///< of a tree
template <class Kernel, class Triangle_iterator>
using Aabb_triangle = CGAL::AABB_triangle_primitive<Kernel, Triangle_iterator>; ///< a primitive of a tree
#endif

} // namespace haptic_sculpt
