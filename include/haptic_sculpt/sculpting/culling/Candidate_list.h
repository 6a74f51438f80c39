// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/culling/Distinct_pairs.h>
#include <haptic_sculpt/surface/connectivity/Face_corners.h>
#include <haptic_sculpt/surface/connectivity/star.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>


namespace haptic_sculpt::internal {

/// The paper's checklist (4.0): the static faces, edges and vertices that a star may touch while it stays in a region,
/// each once, with a private copy of their points.
///
/// Everything but the grabbed vertex stands still, so the list holds until another vertex moves or the mesh is edited.
/// Filled again and again; allocates only when a list is longer than any before.
template <class Mesh>
class Candidate_list {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Coordinates = std::array<double, 3>;

  struct Vertex {
    Vertex_index index;
    Coordinates point;
  };
  using Edge = std::array<std::uint32_t, 2>; ///< positions in vertices(), increasing
  struct Face {
    std::array<std::uint32_t, 3> vertices; ///< positions in vertices(), in the face's order
    Face_index index;
  };

  /// The star's link first, in its order.
  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const std::vector<Face>& faces() const { return faces_; }

  /// The list is complete for every motion of the star's centre in here.
  const Box_3& region() const { return region_; }

  Box_3 box(const Edge& edge) const { return Box_3(vertices_[edge[0]].point).include(vertices_[edge[1]].point); }
  Box_3 box(const Face& face) const {
    Box_3 result(vertices_[face.vertices[0]].point);
    return result.include(vertices_[face.vertices[1]].point).include(vertices_[face.vertices[2]].point);
  }

  /// Makes room for this many candidates about a star: none that are fewer allocate.
  void reserve(std::size_t valence, std::size_t faces) {
    vertices_.reserve(valence + 3 * faces);
    edges_.reserve(3 * faces);
    faces_.reserve(faces);
    corners_.reserve(faces);
    found_.reserve(valence + 3 * faces);
    names_.prepare(valence + 3 * faces);
    pairs_.reserve(3 * faces);
  }

  void clear() {
    vertices_.clear();
    edges_.clear();
    faces_.clear();
    region_ = Box_3();
  }

  /// Takes the candidate faces that are not incident to the star's centre; `region` is where the centre may be.
  /// \param corners_of gives a face's corners in the orientation of the mesh: Face_corners, or corners_in(mesh)
  /// \param is_known is called with each vertex as soon as it is known, before its point is read: to ask for memory
  /// ahead \pre the link names no vertex twice, as on any mesh without doubled edges. Cost: linear in the number of
  /// candidates.
  template <class Corners_of, class Is_known>
  void assign(const Mesh& mesh, const Corners_of& corners_of, const Star<Mesh>& star,
              const std::vector<Face_index>& candidates, const Box_3& region, const Is_known& is_known) {
    region_ = region;
    // Each of the first three loops asks for all of its memory at once: nothing read decides what is read next. And
    // none branches on what is as good as random: whatever comes is written behind the last one, and counted if it is
    // new.
    const std::size_t n = candidates.size();
    corners_.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      corners_[k] = corners_of(candidates[k]);
    names_.prepare(star.valence() + 3 * n);
    faces_.resize(n);
    found_.resize(star.valence() + 3 * n);
    std::size_t faces = 0, vertices = star.valence();
    for (std::size_t k = 0; k < vertices; ++k) {
      names_.insert(static_cast<std::uint64_t>(star.link[k]));
      found_[k] = star.link[k];
    }
    for (std::size_t k = 0; k < n; ++k) {
      const auto& [a, b, c] = corners_[k];
      if (star.valence() != 0 && (int(a == star.centre) | int(b == star.centre) | int(c == star.centre)) != 0)
        continue;
      Face& face = faces_[faces++];
      face.index = candidates[k];
      for (int i = 0; i < 3; ++i) {
        const auto [position, is_new] = names_.insert(static_cast<std::uint64_t>(corners_[k][i]));
        face.vertices[i] = position;
        found_[position] = corners_[k][i];
        vertices += is_new;
      }
    }
    faces_.resize(faces);
    for (std::size_t v = 0; v < vertices; ++v)
      is_known(found_[v]);
    vertices_.resize(vertices);
    for (std::size_t v = 0; v < vertices; ++v)
      vertices_[v] = {found_[v], vertex_coordinates(mesh, found_[v])};
    pairs_.prepare(vertices, 3 * faces);
    edges_.resize(3 * faces);
    std::size_t edges = 0;
    for (const Face& face : faces_)
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t a = face.vertices[i], b = face.vertices[i == 2 ? 0 : i + 1];
        edges_[edges] = {a < b ? a : b, a < b ? b : a};
        edges += pairs_.insert(edges_[edges][0], edges_[edges][1]);
      }
    edges_.resize(edges);
  }

  template <class Corners_of>
  void assign(const Mesh& mesh, const Corners_of& corners_of, const Star<Mesh>& star,
              const std::vector<Face_index>& candidates, const Box_3& region) {
    assign(mesh, corners_of, star, candidates, region, [](Vertex_index) {});
  }

private:
  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  Box_3 region_;
  std::vector<std::array<Vertex_index, 3>> corners_; ///< of the candidates
  std::vector<Vertex_index> found_;                  ///< the vertices, in the order of their positions
  Distinct_numbers names_;                 ///< of the vertices
  Distinct_pairs pairs_;                   ///< the edges that were met so far
};

} // namespace haptic_sculpt::internal
