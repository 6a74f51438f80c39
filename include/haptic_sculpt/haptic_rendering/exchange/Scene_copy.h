// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/connectivity/add_faces.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace haptic_sculpt {

/// A mesh by value, copied by the loop's thread a slice a tick while the hand goes on: changes made meanwhile go into
/// it, too, so that in the end it is the mesh of one tick. Made, and given room, by the thread that asks for it, for
/// one copy: the next one needs another, for what is beyond the mesh is not cleared.
class Scene_copy {
public:
  static constexpr std::uint64_t absent = std::numeric_limits<std::uint64_t>::max();    ///< the id of no vertex
  static constexpr std::uint32_t no_corner = std::numeric_limits<std::uint32_t>::max(); ///< the corner of no face
  static constexpr std::array<std::uint32_t, 3> no_face = {no_corner, 0, 0};            ///< at an index without a face

  /// Room for a mesh with this many descriptors (`number_of_vertices() + number_of_removed_vertices()`, and faces).
  Scene_copy(std::size_t vertices, std::size_t faces)
      : points(vertices), ids(vertices, std::uint64_t(absent)), faces(faces, no_face) {}

  std::vector<std::array<double, 3>> points;       ///< by index of vertex
  std::vector<std::uint64_t> ids;                  ///< by index of vertex, its number that lasts; or `absent`
  std::vector<std::array<std::uint32_t, 3>> faces; ///< by index of face, the corners; or `no_corner` first
  /// How many vertices there should have been room for: where there is less, the copy is of no use; ask with a new one.
  std::size_t vertices_needed = 0,
              faces_needed = 0; ///< the same of faces

  /// Whether there was room for all so far.
  bool is_whole() const { return vertices_needed <= points.size() && faces_needed <= faces.size(); }

  /// \name The loop's thread
  ///@{

  void begin() { next_vertex_ = next_face_ = 0; } ///< from the first element again; what was needed is kept
  /// A vertex is there now.
  void set_vertex(std::uint32_t v, std::uint64_t id, const std::array<double, 3>& point) {
    vertices_needed = std::max(vertices_needed, std::size_t{v} + 1);
    if (v < points.size())
      ids[v] = id, points[v] = point;
  }
  /// A vertex has moved.
  void move_vertex(std::uint32_t v, const std::array<double, 3>& point) {
    if (v < points.size())
      points[v] = point;
  }
  /// A vertex is gone.
  void unset_vertex(std::uint32_t v) {
    if (v < ids.size())
      ids[v] = absent;
  }
  /// A face is there now, or is gone: `no_corner` first.
  void set_face(std::uint32_t f, const std::array<std::uint32_t, 3>& corners) {
    faces_needed = std::max(faces_needed, std::size_t{f} + 1);
    if (f < faces.size())
      faces[f] = corners;
  }
  /// Copies up to this many elements more. \return whether all are copied. Allocates nothing.
  template <class Sculptor>
  bool copy_some(const Sculptor& sculptor, std::size_t elements) {
    const auto& mesh = sculptor.mesh();
    const std::size_t all_vertices = mesh.num_vertices(), all_faces = mesh.num_faces(); // removed ones included
    vertices_needed = std::max(vertices_needed, all_vertices), faces_needed = std::max(faces_needed, all_faces);
    const std::size_t vertices = std::min(all_vertices, points.size()), known_faces = std::min(all_faces, faces.size());
    for (; elements > 0 && next_vertex_ < vertices; --elements, ++next_vertex_) {
      const typename Sculptor::Vertex_index v(static_cast<std::uint32_t>(next_vertex_));
      ids[next_vertex_] = mesh.is_removed(v) ? std::uint64_t(absent) : sculptor.id(v);
      points[next_vertex_] = vertex_coordinates(mesh, v);
    }
    for (; elements > 0 && next_face_ < known_faces; --elements, ++next_face_) {
      const typename Sculptor::Face_index f(static_cast<std::uint32_t>(next_face_));
      faces[next_face_] = mesh.is_removed(f) ? no_face : corners_of(mesh, f);
    }
    return next_vertex_ >= vertices && next_face_ >= known_faces;
  }
  ///@}

  /// The mesh, vertices in the order of their numbers, each face with the corner first that it had: a file of it is the
  /// one that the mesh itself, without attributes, would be written to in that order
  /// (Write_parameters::vertex_order()). \pre is_whole()
  template <class Mesh>
  Mesh mesh() const {
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < ids.size(); ++v)
      if (ids[v] != absent)
        order.push_back(v);
    std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) { return ids[a] < ids[b]; });
    std::vector<typename Mesh::Vertex_index> vertex(ids.size());
    Mesh mesh;
    for (const std::uint32_t v : order)
      vertex[v] = mesh.add_vertex({points[v][0], points[v][1], points[v][2]});
    std::vector<std::array<typename Mesh::Vertex_index, 3>> corners;
    for (const auto& face : faces)
      if (face[0] != no_corner)
        corners.push_back({vertex[face[0]], vertex[face[1]], vertex[face[2]]});
    internal::add_faces(corners, mesh);
    return mesh;
  }

  /// \pre f lives
  template <class Mesh>
  static std::array<std::uint32_t, 3> corners_of(const Mesh& mesh, typename Mesh::Face_index f) {
    const auto h = mesh.halfedge(f);
    return {static_cast<std::uint32_t>(mesh.source(h)), static_cast<std::uint32_t>(mesh.target(h)),
            static_cast<std::uint32_t>(mesh.target(mesh.next(h)))};
  }

private:
  std::size_t next_vertex_ = 0, next_face_ = 0;
};

} // namespace haptic_sculpt
