// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_CHECKLIST_H
#define HAPTIC_SCULPT_SCULPTING_CHECKLIST_H

#include <haptic_sculpt/surface/star.h>

#include <algorithm>

namespace haptic_sculpt {

/// The paper's checklist (4.0): the static faces, edges and vertices that a star may touch while it stays in a region,
/// each once, with their boxes and a private copy of their points.
///
/// Everything but the grabbed vertex stands still, so the list holds until another vertex moves or the mesh is edited.
/// Filled again and again; allocates only when a list is longer than any before.
template <class Mesh>
class Checklist {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Coordinates = std::array<double, 3>;

  struct Vertex {
    Vertex_index index;
    Coordinates point;
  };
  struct Edge {
    std::array<std::uint32_t, 2> vertices; ///< positions in vertices(), increasing
    Box_3 box;
  };
  struct Face {
    std::array<std::uint32_t, 3> vertices; ///< positions in vertices(), in the face's order
    Face_index index;
    Box_3 box;
  };

  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const std::vector<Face>& faces() const { return faces_; }

  /// The list is complete for every swept star whose box lies in here.
  const Box_3& region() const { return region_; }

  void clear() {
    vertices_.clear();
    edges_.clear();
    faces_.clear();
    region_ = Box_3();
  }

  /// Takes the candidate faces that are not incident to the star's centre; `region` is where they are complete.
  /// Cost: n log n in the number of candidates.
  void assign(const Mesh& mesh, const Star<Mesh>& star, const std::vector<Face_index>& candidates, const Box_3& region) {
    clear();
    region_ = region;
    for (const Face_index f : candidates) {
      const auto h = mesh.halfedge(f);
      const std::array<Vertex_index, 3> corners = {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
      if (star.valence() != 0 && std::find(corners.begin(), corners.end(), star.centre) != corners.end())
        continue;
      Face face;
      face.index = f;
      for (int i = 0; i < 3; ++i) {
        face.vertices[i] = static_cast<std::uint32_t>(corners[i]); // renamed below, once all are known
        vertices_.push_back({corners[i], {}});
      }
      faces_.push_back(face);
    }
    std::sort(vertices_.begin(), vertices_.end(), [](const Vertex& a, const Vertex& b) { return a.index < b.index; });
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end(),
                                [](const Vertex& a, const Vertex& b) { return a.index == b.index; }),
                    vertices_.end());
    for (Vertex& v : vertices_)
      v.point = vertex_coordinates(mesh, v.index);
    for (Face& face : faces_)
      finish(face);
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.vertices < b.vertices; });
    edges_.erase(std::unique(edges_.begin(), edges_.end(),
                             [](const Edge& a, const Edge& b) { return a.vertices == b.vertices; }),
                 edges_.end());
    for (Edge& edge : edges_)
      edge.box = Box_3(vertices_[edge.vertices[0]].point).include(vertices_[edge.vertices[1]].point);
  }

private:
  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  Box_3 region_;

  void finish(Face& face) {
    for (std::uint32_t& corner : face.vertices) {
      const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), Vertex_index(corner),
                                          [](const Vertex& v, Vertex_index index) { return v.index < index; });
      corner = static_cast<std::uint32_t>(found - vertices_.begin());
      face.box.include(found->point);
    }
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = face.vertices[i], b = face.vertices[(i + 1) % 3];
      edges_.push_back({{std::min(a, b), std::max(a, b)}, {}});
    }
  }
};

} // namespace haptic_sculpt

#endif
