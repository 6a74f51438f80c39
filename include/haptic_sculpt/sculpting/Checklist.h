// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_CHECKLIST_H
#define HAPTIC_SCULPT_SCULPTING_CHECKLIST_H

#include <haptic_sculpt/sculpting/Distinct_numbers.h>
#include <haptic_sculpt/surface/Face_corners.h>
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

  /// The list is complete for every motion of the star's centre in here.
  const Box_3& region() const { return region_; }

  void clear() {
    vertices_.clear();
    edges_.clear();
    faces_.clear();
    region_ = Box_3();
  }

  /// Takes the candidate faces that are not incident to the star's centre; `region` is where the centre may be.
  /// \param corners_of gives a face's corners in the orientation of the mesh: Face_corners, or corners_in(mesh)
  /// Cost: linear in the number of candidates.
  template <class Corners_of>
  void assign(const Mesh& mesh, const Corners_of& corners_of, const Star<Mesh>& star,
              const std::vector<Face_index>& candidates, const Box_3& region) {
    clear();
    region_ = region;
    names_.prepare(3 * candidates.size());
    for (const Face_index f : candidates) {
      const std::array<Vertex_index, 3> corners = corners_of(f);
      if (star.valence() != 0 && std::find(corners.begin(), corners.end(), star.centre) != corners.end())
        continue;
      Face face;
      face.index = f;
      for (int i = 0; i < 3; ++i) {
        const auto [position, is_new] = names_.insert(static_cast<std::uint64_t>(corners[i]));
        face.vertices[i] = position;
        if (is_new)
          vertices_.push_back({corners[i], {}});
      }
      faces_.push_back(face);
    }
    // All at once, so that the memory is asked for all at once.
    for (Vertex& v : vertices_)
      v.point = vertex_coordinates(mesh, v.index);
    names_.prepare(3 * faces_.size());
    for (Face& face : faces_)
      finish(face);
  }

private:
  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  Box_3 region_;
  internal::Distinct_numbers names_; ///< of the vertices, then of the edges that were met so far

  void finish(Face& face) {
    for (const std::uint32_t corner : face.vertices)
      face.box.include(vertices_[corner].point);
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(face.vertices[i], face.vertices[(i + 1) % 3]);
      if (names_.insert(std::uint64_t{a} << 32 | b).second)
        edges_.push_back({{a, b}, Box_3(vertices_[a].point).include(vertices_[b].point)});
    }
  }
};

} // namespace haptic_sculpt

#endif
