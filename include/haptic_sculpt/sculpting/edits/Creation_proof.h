// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/culling/Convex_star.h>
#include <haptic_sculpt/sculpting/edits/Edit_proof.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <boost/container/static_vector.hpp>

#include <limits>

namespace haptic_sculpt::internal {

/// Decides whether one or two faces can be replaced by the star of a new vertex: the new faces meet nothing improperly,
/// and nothing stands between them and the old (doc/use/edits.md).
template <class Mesh, class Broad_phase>
class Creation_proof {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Refused = std::optional<Refusal<Mesh>>;
  /// One in each of the old faces; of two, those of their common edge.
  using Old_halfedges = boost::container::static_vector<Halfedge_index, 2>;

  Creation_proof(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners,
                 Filter_counters& counters)
      : mesh_(&mesh), broad_phase_(&broad_phase), corners_of_(&corners), proof_(counters) {}

  Refused refuse(const Old_halfedges& old_halfedges, const Coordinates& p, double delta) {
    old_faces_.clear(), new_faces_.clear();
    for (const Halfedge_index h : old_halfedges) {
      Mesh_watch<Mesh>::check_face(*corners_of_, mesh_->face(h));
      const Corners<Mesh> old = corners_at(*mesh_, h);
      old_faces_.push_back(old);
      for (int i = 0; i < 3; ++i) {
        if (old[i].point == p)
          return Refusal<Mesh>{Refusal_reason::coincident_vertex, {old[i].index}};
        if (i > 0 || old_halfedges.size() == 1) // the side that two old faces share is split
          new_faces_.push_back({Corner<Mesh>{Vertex_index(), p}, old[i], old[(i + 1) % 3]});
      }
    }
    for (const Corners<Mesh>& f : new_faces_)
      if (!keeps_delta<Mesh>(f[0].point, f[1].point, f[2].point, delta))
        return Refusal<Mesh>{Refusal_reason::delta, {f[1].index, f[2].index}};
    for (std::size_t i = 0; i < new_faces_.size(); ++i)
      for (std::size_t j = i + 1; j < new_faces_.size(); ++j)
        if (proof_.meet_improperly(new_faces_[i], new_faces_[j]))
          return Refusal<Mesh>{Refusal_reason::blocked, {new_faces_[j][1].index, new_faces_[j][2].index}};
    return refuse_what_is_near(old_halfedges, p);
  }

  void reserve(std::size_t usual_candidates) {
    candidates_.reserve(usual_candidates);
    star_.reserve(4);
  }

private:
  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  const Face_corners<Mesh>* corners_of_;
  Edit_proof<Mesh, Filter_counters> proof_;
  boost::container::static_vector<Corners<Mesh>, 2> old_faces_;
  boost::container::static_vector<Corners<Mesh>, 4> new_faces_;
  std::vector<Face_index> candidates_;
  Star<Mesh> star_;                ///< the corners about the new vertex
  Convex_star<Mesh> convex_star_;

  /// Whether the corners of the old faces, seen along some direction, are a convex polygon with p inside: then old and
  /// new faces are within its walls, and a face beyond one of them is near neither. So of the needles about a split
  /// one, whose boxes all meet its own, few are left for exact decisions.
  bool is_convex(const Coordinates& p) {
    star_.clear();
    const auto add = [this](const Corner<Mesh>& corner) {
      star_.link.push_back(corner.index);
      star_.link_points.push_back(corner.point);
    };
    const Corners<Mesh>& old = old_faces_[0];
    add(old[0]);
    if (old_faces_.size() == 2) // beyond their common edge, from the first corner to the second
      add(old_faces_[1][2]);
    add(old[1]);
    add(old[2]);
    return convex_star_.assign(star_, p, p);
  }

  /// Adds what is near the tetrahedron between an old face and the new faces in its place. It is what a corner's edge
  /// opposite passes over where the corner goes to p: of a face of a spike, far less than a box holds if the edge is
  /// short.
  void add_candidates(const Corners<Mesh>& old, const Coordinates& p) {
    int apex = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const Coordinates &a = old[(i + 1) % 3].point, &b = old[(i + 2) % 3].point;
      const double length = std::fmax(std::fmax(std::abs(a[0] - b[0]), std::abs(a[1] - b[1])), std::abs(a[2] - b[2]));
      if (length < shortest)
        apex = i, shortest = length;
    }
    const std::array<Coordinates, 2> edge = {old[(apex + 1) % 3].point, old[(apex + 2) % 3].point};
    broad_phase_->query_star(Swept_star_3{old[apex].point, p, edge.data(), edge.size()}, candidates_);
  }

  Refused refuse_what_is_near(const Old_halfedges& old_halfedges, const Coordinates& p) {
    candidates_.clear();
    for (const Corners<Mesh>& old : old_faces_)
      add_candidates(old, p);
    const bool has_walls = is_convex(p);
    const auto is_out = [&](Face_index f) {
      for (const Halfedge_index h : old_halfedges)
        if (mesh_->face(h) == f)
          return true;
      return has_walls && convex_star_.is_apart(*mesh_, (*corners_of_)(f));
    };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), is_out), candidates_.end());
    std::sort(candidates_.begin(), candidates_.end());
    candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
    for (const Face_index f : candidates_) {
      const Corners<Mesh> other = corners_at(*mesh_, mesh_->halfedge(f));
      for (const Corner<Mesh>& corner : other)
        if (corner.point == p)
          return Refusal<Mesh>{Refusal_reason::coincident_vertex, {corner.index}};
      for (const Corners<Mesh>& g : new_faces_)
        if (proof_.meet_improperly(g, other))
          return Refusal<Mesh>{Refusal_reason::blocked, {other[0].index, other[1].index, other[2].index}};
      for (const Corners<Mesh>& old : old_faces_)
        for (const Corner<Mesh>& corner : other)
          if (corner.index != old[0].index && corner.index != old[1].index && corner.index != old[2].index &&
              proof_.contains(old, p, corner.point))
            return Refusal<Mesh>{Refusal_reason::blocked, {corner.index}};
    }
    return std::nullopt;
  }
};

} // namespace haptic_sculpt::internal
