// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_REMESHING_MARKS_H
#define HAPTIC_SCULPT_SCULPTING_REMESHING_MARKS_H

#include <haptic_sculpt/sculpting/many_vertices/triangle_shape.h>
#include <haptic_sculpt/surface/Face_corners.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// What a remeshing has to leave as it is: constrained edges, fixed vertices, and all that is not in the range of
/// faces.
///
/// A constrained edge that is split hands its constraint on to both halves. The caller's map of edges is kept up to
/// date, for elements that come and go, too.
template <class Mesh, class Edge_map>
class Remeshing_marks {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Edge_index = typename Mesh::Edge_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Face_index = typename Mesh::Face_index;

  /// \param faces the range; the edges on its border are constrained and protected
  template <class Faces, class Vertex_map>
  Remeshing_marks(const Mesh& mesh, const Faces& faces, const Edge_map& edge_map, const Vertex_map& vertex_map)
      : mesh_(&mesh)
      , edge_map_(edge_map)
      , is_constrained_(mesh.num_edges(), 0)
      , is_fixed_(mesh.num_vertices(), 0)
      , is_whole_(faces.size() == mesh.number_of_faces()) {
    if (!is_whole_) {
      is_in_range_.assign(mesh.num_faces(), 0);
      for (const Face_index f : faces)
        is_in_range_[static_cast<std::size_t>(f)] = 1;
    }
    for (const Edge_index e : mesh.edges()) {
      if (get(edge_map_, e))
        note(e, true);
      if (const Halfedge_index h = mesh.halfedge(e); is_in_range(h) != is_in_range(mesh.opposite(h)))
        is_fixed_[static_cast<std::size_t>(mesh.source(h))] = is_fixed_[static_cast<std::size_t>(mesh.target(h))] = 1;
    }
    for (const Vertex_index v : mesh.vertices())
      if (get(vertex_map, v))
        is_fixed_[static_cast<std::size_t>(v)] = 1;
  }

  /// Constrains the edges of the range at which the normals of the faces differ by more than this angle.
  void constrain_features(double degrees) {
    const double cosine = std::cos(degrees * (3.14159265358979323846 / 180));
    for (const Edge_index e : mesh_->edges()) {
      if (!is_inside(e))
        continue;
      const Vector n = normalized(normal(mesh_->halfedge(e))),
                   m = normalized(normal(mesh_->opposite(mesh_->halfedge(e))));
      if (quick_dot(n, m) < cosine)
        constrain(e, true);
    }
  }

  bool is_constrained(Edge_index e) const { return is_constrained_[static_cast<std::size_t>(e)] != 0; }
  /// Whether both of its faces are in the range.
  bool is_inside(Edge_index e) const {
    const Halfedge_index h = mesh_->halfedge(e);
    return is_in_range(h) && is_in_range(mesh_->opposite(h));
  }
  /// Whether v is constrained, or on the border of the range.
  bool is_fixed(Vertex_index v) const { return is_fixed_[static_cast<std::size_t>(v)] != 0; }
  /// How many constrained edges v has. Cost: its valence, where any edge is constrained.
  int constrained_degree(Vertex_index v) const {
    int degree = 0;
    if (has_constraints_)
      for (const Halfedge_index h : mesh_->halfedges_around_target(mesh_->halfedge(v)))
        degree += is_constrained(mesh_->edge(h));
    return degree;
  }
  /// Whether v may go elsewhere than along constrained edges, and in the range.
  bool is_free(Vertex_index v) const {
    return !is_fixed(v) && !mesh_->is_isolated(v) && is_in_range(mesh_->halfedge(v)) && constrained_degree(v) == 0;
  }

  /// v has been created on the edge from a to b, which was constrained or not.
  void split(Vertex_index v, Vertex_index a, Vertex_index b, bool was_constrained) {
    grow();
    is_fixed_[static_cast<std::size_t>(v)] = 0;
    for (const Halfedge_index h : mesh_->halfedges_around_target(mesh_->halfedge(v))) {
      const Vertex_index w = mesh_->source(h);
      constrain(mesh_->edge(h), was_constrained && (w == a || w == b));
      if (!is_whole_)
        is_in_range_[static_cast<std::size_t>(mesh_->face(h))] = 1;
    }
  }
  /// A new edge.
  void constrain(Edge_index e, bool on) {
    grow();
    if (is_constrained(e) != on || get(edge_map_, e) != on)
      put(edge_map_, e, on);
    note(e, on);
  }
  /// A new face is in the range.
  void face_created(Face_index f) {
    grow();
    if (!is_whole_)
      is_in_range_[static_cast<std::size_t>(f)] = 1;
  }

private:
  const Mesh* mesh_;
  Edge_map edge_map_;
  std::vector<char> is_constrained_, is_fixed_, is_in_range_; ///< the last one empty where all faces are in the range
  bool is_whole_, has_constraints_ = false;

  bool is_in_range(Halfedge_index h) const {
    return is_whole_ || is_in_range_[static_cast<std::size_t>(mesh_->face(h))] != 0;
  }
  void note(Edge_index e, bool on) {
    is_constrained_[static_cast<std::size_t>(e)] = on;
    has_constraints_ |= on;
  }
  void grow() {
    is_constrained_.resize(std::max<std::size_t>(is_constrained_.size(), mesh_->num_edges()), 0);
    is_fixed_.resize(std::max<std::size_t>(is_fixed_.size(), mesh_->num_vertices()), 0);
    if (!is_whole_)
      is_in_range_.resize(std::max<std::size_t>(is_in_range_.size(), mesh_->num_faces()), 1);
  }
  Vector normal(Halfedge_index h) const {
    const auto corners = corners_of_face(*mesh_, mesh_->face(h));
    return area_normal(vertex_coordinates(*mesh_, corners[0]), vertex_coordinates(*mesh_, corners[1]),
                       vertex_coordinates(*mesh_, corners[2]));
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
