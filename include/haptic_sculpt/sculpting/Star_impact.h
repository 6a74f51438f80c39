// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_STAR_IMPACT_H
#define HAPTIC_SCULPT_SCULPTING_STAR_IMPACT_H

#include <haptic_sculpt/collision.h>

#include <CGAL/Kernel_traits.h>

#include <tuple>
#include <vector>

namespace haptic_sculpt {

/// An impact of a moving star, with the mesh elements that meet.
template <class Mesh>
class Star_impact {
public:
  using Kernel = typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel;
  using Vertex_index = typename Mesh::Vertex_index;

  Star_impact(Impact_feature feature, const std::array<Vertex_index, 3>& vertices, const internal::Sweep_points& points,
              const internal::Sweep_verdict& verdict)
    : vertices_(vertices), impact_(feature, points, verdict) {}

  Impact_feature feature() const { return impact_.feature(); }

  /// The vertices that stand still, beside the moving one, J:
  /// vertex_face: the corners of the face that J meets; edge_edge: V, A, B: edge JV meets edge AB;
  /// face_vertex: G, I, A: face JGI meets vertex A.
  const std::array<Vertex_index, 3>& vertices() const { return vertices_; }

  const Impact_3<Kernel>& impact() const { return impact_; }

  /// An order that depends on nothing but the elements.
  friend bool operator<(const Star_impact& a, const Star_impact& b) {
    return std::make_tuple(a.feature(), a.vertices_) < std::make_tuple(b.feature(), b.vertices_);
  }

private:
  std::array<Vertex_index, 3> vertices_;
  Impact_3<Kernel> impact_;
};

/// The impacts that come first along one motion: all at exactly the same time, in the order of operator<.
template <class Mesh>
using Star_impacts = std::vector<Star_impact<Mesh>>;

} // namespace haptic_sculpt

#endif
