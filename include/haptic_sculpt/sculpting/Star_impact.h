// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision.h>

#include <CGAL/Kernel_traits.h>

#include <tuple>
#include <vector>

namespace haptic_sculpt {

/// The traits by which motions of a mesh's vertices are decided where no others are given: exact. Counts what the
/// filter leaves.
template <class Mesh>
using Exact_sweep_traits =
    Swept_collision_traits_3<typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel, Filter_counters>;

/// An impact of a moving star, with the mesh elements that meet.
/// \tparam Impact that of the traits which decided: SweptCollisionTraits_3::Impact_3
template <class Mesh, class Impact = typename Exact_sweep_traits<Mesh>::Impact_3>
class Star_impact {
public:
  using Vertex_index = typename Mesh::Vertex_index; ///< of the mesh of the star

  /// Made by those who decide sweeps: copies of what vertices() and impact() give.
  Star_impact(const std::array<Vertex_index, 3>& vertices, const Impact& impact)
      : vertices_(vertices), impact_(impact) {}

  Impact_feature feature() const { return impact_.feature(); } ///< which pair meets: says what vertices() are

  /// The vertices that stand still, beside the moving one, J:
  /// vertex_face: the corners of the face that J meets; edge_edge: V, A, B: edge JV meets edge AB;
  /// face_vertex: G, I, A: face JGI meets vertex A.
  const std::array<Vertex_index, 3>& vertices() const { return vertices_; }

  const Impact& impact() const { return impact_; } ///< when and where they meet, as the traits tell

  /// An order that depends on nothing but the elements.
  friend bool operator<(const Star_impact& a, const Star_impact& b) {
    return std::make_tuple(a.feature(), a.vertices_) < std::make_tuple(b.feature(), b.vertices_);
  }

private:
  std::array<Vertex_index, 3> vertices_;
  Impact impact_;
};

/// The impacts that come first along one motion: all at exactly the same time, in the order of operator<.
template <class Mesh, class Impact = typename Exact_sweep_traits<Mesh>::Impact_3>
using Star_impacts = std::vector<Star_impact<Mesh, Impact>>;

} // namespace haptic_sculpt
