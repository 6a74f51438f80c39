// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Workspace_map.h>
#include <haptic_sculpt/haptic_rendering/exchange/Scene_visitor.h>
#include <haptic_sculpt/haptic_rendering/finding_and_placing.h>
#include <haptic_sculpt/sculpting.h>

#include <limits>

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
      , lower(corner_of_box(-1))
      , upper(corner_of_box(1))
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

private:
  Eigen::Vector3d corner_of_box(int sign) const {
    Eigen::Vector3d corner = Eigen::Vector3d::Constant(-sign * std::numeric_limits<double>::infinity());
    for (const auto v : mesh.vertices()) {
      const auto& p = mesh.point(v);
      const Eigen::Vector3d at(p.x(), p.y(), p.z());
      corner = sign < 0 ? Eigen::Vector3d(corner.cwiseMin(at)) : Eigen::Vector3d(corner.cwiseMax(at));
    }
    return corner;
  }
};

} // namespace haptic_sculpt
