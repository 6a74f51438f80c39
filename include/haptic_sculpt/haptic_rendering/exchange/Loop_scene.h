// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Workspace_map.h>
#include <haptic_sculpt/haptic_rendering/exchange/Scene_feed.h>
#include <haptic_sculpt/haptic_rendering/exchange/Scene_visitor.h>
#include <haptic_sculpt/haptic_rendering/finding_and_placing.h>
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface/broad_phase/face_box.h>

namespace haptic_sculpt {

/// A mesh, its Sculptor, and where it is for the hand: what a loop sculpts. Made by any thread, then given
/// to the loop's.
///
template <class Mesh_>
struct Loop_scene {
  using Mesh = Mesh_; ///< a `CGAL::Surface_mesh`
  /// What viewers are passed of a face. A class derived from this may hide it, and face(), to pass on more.
  using Face_type = Face_change;
  /// Viewers and copies know of its edits.
  using Sculptor_type = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Scene_visitor<Mesh>>;

  Mesh mesh;              ///< to be changed through the Sculptor only
  Eigen::Vector3d lower,  ///< of the mesh's box as it came
      upper;              ///< of the same box
  Sculptor_type sculptor; ///< of `mesh`
  Workspace_map map;      ///< between the device and the scene

  /// \param map_of_box what gives a Workspace_map for the mesh's box: `(lower, upper)`
  /// A viewer is passed all faces on, unless `sculptor.visitor().changed` is cleared first.
  ///
  /// \param edits, moves room that is made for this many (Sculptor::reserve)
  /// \throw Invalid_surface and what else the Sculptor throws. Cost: that of validate()
  template <class Map_of_box>
  Loop_scene(Mesh given, const Map_of_box& map_of_box, std::size_t edits = 1000, std::size_t moves = 100000,
             const Sculptor_parameters& parameters = Sculptor_parameters())
      : mesh(std::move(given))
      , lower(internal::mesh_box(mesh).lower.data())
      , upper(internal::mesh_box(mesh).upper.data())
      , sculptor(mesh, parameters, Scene_visitor<Mesh>(mesh))
      , map(map_of_box(lower, upper)) {
    sculptor.reserve(edits, moves);
    sculptor.visitor().mark_all(2 * edits);
  }

  /// As it is now, also of an index at which no face is. Constant time.
  Face_change face(std::uint32_t index) const {
    Face_change face;
    face.index = index;
    const typename Mesh::Face_index f(index);
    face.is_there = index < mesh.num_faces() && !mesh.is_removed(f);
    if (!face.is_there)
      return face;
    std::size_t i = 0;
    for (const std::uint32_t corner : Scene_copy::corners_of(mesh, f)) {
      const typename Mesh::Vertex_index v(corner);
      face.vertices[i] = sculptor.id(v), face.corners[i++] = vertex_coordinates(mesh, v);
    }
    return face;
  }
};

} // namespace haptic_sculpt
