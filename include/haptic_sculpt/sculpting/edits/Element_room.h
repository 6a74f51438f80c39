// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/sculpting/edits/Vertex_ids.h>

#include <limits>
#include <new>

namespace haptic_sculpt::internal {

/// Makes room in a mesh, and in all that is kept for each of its elements, for an edit that is about to begin: no array
/// grows in the middle of it.
///
/// Surface_mesh does not say how much room it has, so what was asked for last is kept here. Cost: a few comparisons;
/// arrays without room grow by half.
template <class Mesh, class Broad_phase>
class Element_room {
public:
  /// Numbers of elements.
  struct Elements {
    std::size_t vertices = 0, edges = 0, faces = 0;
  };

  Element_room(Mesh& mesh, Broad_phase& broad_phase, Face_corners<Mesh>& corners, Mesh_watch<Mesh>& watch,
               Vertex_ids<Mesh>& ids)
      : mesh_(&mesh)
      , broad_phase_(&broad_phase)
      , corners_(&corners)
      , watch_(&watch)
      , ids_(&ids)
      , room_{mesh.num_vertices(), mesh.num_edges(), mesh.num_faces()}
      , points_(points()) {}

  /// Room for an edit that makes `born` after `dead` have died, and tells the broad phase of this many insertions.
  /// \throw std::bad_alloc, and nothing has changed but room
  void make(const Elements& born, const Elements& dead, std::size_t insertions) {
    Elements free; // slots of elements that are no more
    if (mesh_->does_recycle_garbage())
      free = {mesh_->number_of_removed_vertices() + dead.vertices, mesh_->number_of_removed_edges() + dead.edges,
              mesh_->number_of_removed_faces() + dead.faces};
    const auto slots = [](std::size_t all, std::size_t made, std::size_t found) {
      return made > found ? all + (made - found) : all;
    };
    const Elements needed = {slots(mesh_->num_vertices(), born.vertices, free.vertices),
                             slots(mesh_->num_edges(), born.edges, free.edges),
                             slots(mesh_->num_faces(), born.faces, free.faces)};
    // Points stay where they are where none is born: a caller's policy may hold references to them.
    const auto room = [](std::size_t need, std::size_t has, std::size_t all, std::size_t limit) {
      return need > has ? std::max(need, std::min(grown(all), limit)) : has;
    };
    if (needed.vertices > room_.vertices || needed.edges > room_.edges || needed.faces > room_.faces ||
        points() != points_)
      reserve({room(needed.vertices, room_.vertices, mesh_->num_vertices(), most),
               room(needed.edges, room_.edges, mesh_->num_edges(), most / 2),
               room(needed.faces, room_.faces, mesh_->num_faces(), most)});
    if (insertions > insertions_)
      reserve_insertions(std::max(insertions, usual_insertions));
    insertions_ -= insertions;
  }

  /// Room for this many edits of stars of eight faces.
  void reserve(std::size_t edits) {
    reserve({mesh_->num_vertices() + edits, mesh_->num_edges() + 3 * edits, mesh_->num_faces() + 2 * edits});
    ids_->reserve(edits);
    reserve_insertions(8 * edits);
  }

private:
  static constexpr std::size_t usual_insertions = 64; ///< asked for at once
  static constexpr std::size_t most = std::numeric_limits<typename Mesh::size_type>::max(); ///< of half-edges, too

  Mesh* mesh_;
  Broad_phase* broad_phase_;
  Face_corners<Mesh>* corners_;
  Mesh_watch<Mesh>* watch_;
  Vertex_ids<Mesh>* ids_;
  Elements room_;              ///< for this many the arrays have been reserved
  std::size_t insertions_ = 0; ///< for this many more the broad phase has
  const void* points_;         ///< the array of points then: another one has the room that others gave it

  const void* points() const { return mesh_->num_vertices() != 0 ? mesh_->points().data() : nullptr; }

  void reserve(Elements room) {
    using Size = typename Mesh::size_type;
    if (room.vertices > most || room.edges > most / 2 || room.faces > most)
      throw std::bad_alloc();
    const bool is_known = points() == points_;
    if (is_known) // what was asked for before stays
      room = {std::max(room.vertices, room_.vertices), std::max(room.edges, room_.edges),
              std::max(room.faces, room_.faces)};
    try {
      mesh_->reserve(static_cast<Size>(room.vertices), static_cast<Size>(room.edges), static_cast<Size>(room.faces));
      corners_->reserve(room.faces);
      watch_->reserve(room.vertices);
      ids_->reserve_slots(room.vertices);
      broad_phase_->reserve(room.faces, 0);
    } catch (...) {
      if (is_known) // some arrays have grown, and none has less room: an undo needs no more
        points_ = points();
      throw;
    }
    room_ = room;
    points_ = points();
  }

  void reserve_insertions(std::size_t insertions) {
    insertions = std::max(insertions, insertions_);
    broad_phase_->reserve(room_.faces, insertions);
    insertions_ = insertions;
  }
};

} // namespace haptic_sculpt::internal
