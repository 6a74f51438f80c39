// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/Face_patches.h>
#include <haptic_sculpt/sculpting/many_vertices/Scaled_points.h>
#include <haptic_sculpt/surface/connectivity/Face_corners.h>

#include <cmath>
#include <vector>

namespace haptic_sculpt::internal {

/// What a remeshing has to leave as it is: constrained edges, fixed vertices, and all that is not in the range of
/// faces; and the patches of the faces, whose borders are constrained.
///
/// A constrained edge that is split hands its constraint on to both halves. The caller's maps of edges and patches are
/// kept up to date, for elements that come and go, too. As in CGAL's, the borders of patches are not written into the
/// map of edges.
template <class Mesh, class Edge_map, class Patch_map>
class Remeshing_marks {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Edge_index = typename Mesh::Edge_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Face_index = typename Mesh::Face_index;
  using Patches = Face_patches<Mesh, Patch_map>;
  using Patch = typename Patches::Patch;

  /// Whether an edge is constrained, and whether the caller's map says so.
  struct Constraint {
    bool is_on = false, is_in_map = false;
  };
  /// What a split of an edge hands on.
  struct Split {
    Vertex_index ends[2], corners[2]; ///< `corners` lie opposite to the edge
    Patch patches[2];                 ///< on the sides of the corners
    Constraint constraint;
  };

  /// \param faces the range; the edges on its border are constrained and protected
  template <class Faces, class Vertex_map>
  Remeshing_marks(const Mesh& mesh, const Faces& faces, const Edge_map& edge_map, const Vertex_map& vertex_map,
                  const Patch_map& patch_map)
      : mesh_(&mesh)
      , edge_map_(edge_map)
      , constraints_(mesh.num_edges())
      , is_fixed_(mesh.num_vertices(), 0)
      , patches_(mesh, faces, patch_map) {
    for (const Edge_index e : mesh.edges()) {
      const Halfedge_index h = mesh.halfedge(e);
      const Patch left = patches_(mesh.face(h)), right = patches_(mesh.face(mesh.opposite(h)));
      const bool is_in_map = get(edge_map_, e);
      note(e, {is_in_map || (left != right && is_inside(e)), is_in_map});
      if (left != right && !is_inside(e))
        is_fixed_[static_cast<std::size_t>(mesh.source(h))] = is_fixed_[static_cast<std::size_t>(mesh.target(h))] = 1;
    }
    for (const Vertex_index v : mesh.vertices())
      if (get(vertex_map, v))
        is_fixed_[static_cast<std::size_t>(v)] = 1;
  }

  /// Constrains the edges of the range at which the normals of the faces differ by more than this angle.
  void constrain_features(const Scaled_points<Mesh>& points, double degrees) {
    // rad: what rounding bends of a flat side, whose triangles are 2^-20 of the coordinates in height, and more
    constexpr double rounding = 0x1p-30;
    const double largest = degrees * (CGAL_PI / 180) + rounding;
    for (const Edge_index e : mesh_->edges()) {
      if (!is_inside(e))
        continue;
      const Vector n = normal(points, mesh_->halfedge(e)), m = normal(points, mesh_->opposite(mesh_->halfedge(e)));
      if (std::atan2(length(cross(n, m)), dot(n, m)) > largest)
        constrain(e, {true, true});
    }
  }

  /// Once all is constrained. Where no patches were given, they are what constrained edges part.
  void connect_patches() {
    patches_.connect([this](Edge_index e) { return is_constrained(e); });
  }

  const Patches& patches() const { return patches_; }
  Patch patch(Face_index f) const { return patches_(f); }
  bool is_in_range(Face_index f) const { return patch(f) != Patches::none; }
  bool is_constrained(Edge_index e) const { return constraint(e).is_on; }
  const Constraint& constraint(Edge_index e) const { return constraints_[static_cast<std::size_t>(e)]; }
  /// Whether both of its faces are in the range.
  bool is_inside(Edge_index e) const {
    const Halfedge_index h = mesh_->halfedge(e);
    return is_in_range(mesh_->face(h)) && is_in_range(mesh_->face(mesh_->opposite(h)));
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
  /// Whether v is in the range and may move, be it along constrained edges only.
  bool may_move(Vertex_index v) const {
    return !is_fixed(v) && is_in_range(mesh_->face(mesh_->halfedge(v)));
  }

  /// Before an edit, so that what it makes is noted without memory: this many edges and faces more at most, and a
  /// vertex.
  void make_room(std::size_t elements) {
    const auto reserve = [](auto& list, std::size_t size) {
      if (list.capacity() < size)
        list.reserve(2 * size);
    };
    reserve(constraints_, mesh_->num_edges() + elements), reserve(is_fixed_, mesh_->num_vertices() + 1);
    patches_.make_room(elements);
  }
  /// Before e is split.
  Split split_of(Edge_index e) const {
    const Halfedge_index h = mesh_->halfedge(e), g = mesh_->opposite(h);
    return {{mesh_->source(h), mesh_->target(h)},
            {mesh_->target(mesh_->next(h)), mesh_->target(mesh_->next(g))},
            {patch(mesh_->face(h)), patch(mesh_->face(g))},
            constraint(e)};
  }
  /// v has been created on it.
  void split(Vertex_index v, const Split& split) {
    grow();
    is_fixed_[static_cast<std::size_t>(v)] = 0;
    for (const Halfedge_index h : mesh_->halfedges_around_target(mesh_->halfedge(v))) {
      const Vertex_index w = mesh_->source(h);
      const bool is_half = w == split.ends[0] || w == split.ends[1];
      constrain(mesh_->edge(h), is_half ? split.constraint : Constraint());
      // Of the two faces of an edge to an opposite corner both have the patch of its side.
      for (int i = 0; i < 2; ++i)
        if (w == split.corners[i]) {
          patches_.set(mesh_->face(h), split.patches[i]);
          patches_.set(mesh_->face(mesh_->opposite(h)), split.patches[i]);
        }
    }
  }
  /// A new edge.
  void constrain(Edge_index e, const Constraint& constraint) {
    grow();
    if (get(edge_map_, e) != constraint.is_in_map)
      put(edge_map_, e, constraint.is_in_map);
    note(e, constraint);
  }
  /// f is a new face, of this patch.
  void face_created(Face_index f, Patch patch) { patches_.set(f, patch); }

private:
  const Mesh* mesh_;
  Edge_map edge_map_;
  std::vector<Constraint> constraints_;
  std::vector<char> is_fixed_;
  Patches patches_;
  bool has_constraints_ = false;

  void note(Edge_index e, const Constraint& constraint) {
    constraints_[static_cast<std::size_t>(e)] = constraint;
    has_constraints_ |= constraint.is_on;
  }
  void grow() {
    constraints_.resize(std::max<std::size_t>(constraints_.size(), mesh_->num_edges()));
    is_fixed_.resize(std::max<std::size_t>(is_fixed_.size(), mesh_->num_vertices()), 0);
  }
  Vector normal(const Scaled_points<Mesh>& points, Halfedge_index h) const {
    const auto corners = corners_of_face(*mesh_, mesh_->face(h));
    return unit_normal(points(corners[0]), points(corners[1]), points(corners[2]));
  }
};

} // namespace haptic_sculpt::internal
