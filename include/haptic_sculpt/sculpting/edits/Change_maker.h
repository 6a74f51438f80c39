// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_CHANGE_MAKER_H
#define HAPTIC_SCULPT_SCULPTING_CHANGE_MAKER_H

#include <haptic_sculpt/sculpting/Edit_visitor.h>
#include <haptic_sculpt/sculpting/edits/Change.h>
#include <haptic_sculpt/sculpting/edits/Element_room.h>
#include <haptic_sculpt/sculpting/edits/Kept_properties.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/sculpting/edits/Write_state.h>
#include <haptic_sculpt/sculpting/edits/faces_around.h>
#include <haptic_sculpt/sculpting/edits/star_edits.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <type_traits>

namespace haptic_sculpt {
namespace internal {

/// Makes changes of a mesh and takes them back, and keeps the broad phase, the numbers of the vertices and a visitor
/// told. Nothing is proven here: what comes in has been, or restores what was.
///
/// Every change but a move, a shift and a flip replaces the fan of one vertex over a polygon by the star of another, or
/// the other way round. Cost: the size of the polygon, the degree of the fan's vertex to find it, and the broad phase.
///
/// In this order: what is to be replaced is looked up and compared with what is known; room is made for all that will
/// be written; values are kept, and the visitor hears, of what dies; all is written, `noted` included; what was made
/// gets values, and the visitor hears of it. So an exception leaves a change not begun, or complete. One that comes
/// while all is written leaves the Write_state saying so (doc/use/edits.md, "Memory that runs out").
template <class Mesh, class Broad_phase, class Visitor>
class Change_maker {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Halfedge_index = typename Mesh::Halfedge_index;

  Change_maker(Mesh& mesh, Broad_phase& broad_phase, Face_corners<Mesh>& corners, Mesh_watch<Mesh>& watch,
               Write_state& writing, Visitor visitor)
      : mesh_(&mesh)
      , broad_phase_(&broad_phase)
      , corners_of_(&corners)
      , writing_(&writing)
      , ids_(mesh)
      , room_(mesh, broad_phase, corners, watch, ids_)
      , kept_(mesh)
      , visitor_(std::move(visitor)) {
    kept_.tell_lineage(visitor_);
  }
  Change_maker(const Change_maker&) = delete; // its parts refer to each other
  Change_maker& operator=(const Change_maker&) = delete;

  const Vertex_ids<Mesh>& ids() const { return ids_; }
  Visitor& visitor() { return visitor_; }
  Kept_properties<Mesh>& kept() { return kept_; }
  using Place = typename Kept_properties<Mesh>::Place;

  /// \param place where it stands in the history
  /// \param noted called as `noted(v)` when the change is made and the visitor has not been told yet; v has moved or is
  /// new, or is the null index. May not throw: room for what it writes has to be there \return the vertex moved or
  /// created; of a removal, the neighbour it went into; of a flip, an end of the new edge \throw Mesh_changed where the
  /// faces to be replaced are not those known; std::bad_alloc; and nothing has changed \param run who may share the
  /// work of a shift
  template <class Noted>
  Vertex_index make(const Change& edit, const Place& place, const Noted& noted,
                    const Part_runner& run = Part_runner()) {
    begin(edit, false, place);
    switch (edit.kind) {
    case Edit_kind::move:
      return put(edit.vertex, edit.after, noted);
    case Edit_kind::shift:
      return put_all(edit, 1, noted, run);
    case Edit_kind::insert_on_face:
      return create_on_face(edit, noted);
    case Edit_kind::insert_on_edge:
      return create_on_edge(edit, noted);
    case Edit_kind::flip:
      return flip(edit, 0, noted);
    default:
      return fan_instead_of_star(edit, noted);
    }
  }

  /// \return the vertex moved or revived; of a creation, a neighbour of what was created; of a flip, an end of the old
  /// edge
  template <class Noted>
  Vertex_index take_back(const Change& edit, const Place& place, const Noted& noted) {
    begin(edit, true, place);
    switch (edit.kind) {
    case Edit_kind::move:
      return put(edit.vertex, edit.before, noted);
    case Edit_kind::shift:
      return put_all(edit, 0, noted, Part_runner());
    case Edit_kind::collapse:
      return star_instead_of_fan(edit, noted);
    case Edit_kind::flip:
      return flip(edit, 2, noted);
    default:
      return fan_instead_of_star(edit, noted);
    }
  }

  /// Whether a change since expect_change() has had all it needed: an exception came from the visitor then, or broke it
  /// off.
  bool was_ready() const { return is_ready_; }
  void expect_change() { is_ready_ = false; }

  /// The visitor hears of a move that was made elsewhere.
  void tell_moved(Vertex_index v) { visitor_.vertex_moved(v); }

  /// Room for this many edits.
  void reserve(std::size_t edits, std::size_t usual_valence) {
    room_.reserve(edits);
    star_.reserve(usual_valence);
    fan_.reserve(usual_valence);
    link_.reserve(usual_valence);
    faces_.reserve(usual_valence);
  }

private:
  using Elements = typename Element_room<Mesh, Broad_phase>::Elements;
  static constexpr bool has_visitor = !std::is_same<Visitor, Default_edit_visitor>::value;

  Mesh* mesh_;
  Broad_phase* broad_phase_;
  Face_corners<Mesh>* corners_of_;
  Write_state* writing_;
  Vertex_ids<Mesh> ids_;
  Element_room<Mesh, Broad_phase> room_;
  Kept_properties<Mesh> kept_;
  Visitor visitor_;
  Star<Mesh> star_;
  Fan<Mesh> fan_;
  std::vector<Vertex_index> link_;
  std::vector<Face_index> faces_;
  Round_marks is_taken_; ///< faces
  bool is_ready_ = false;

  Vertex_index vertex(std::size_t id) const { return ids_.vertex(id); }
  void begin(const Change& edit, bool is_back, const Place& place) {
    if (edit.kind != Edit_kind::move && edit.kind != Edit_kind::shift)
      kept_.begin(edit, is_back, place);
  }
  static typename Mesh::Point to_point(const Coordinates& p) { return {p[0], p[1], p[2]}; }

  /// \throw Mesh_changed where there is none: whoever calls knows that there was
  Halfedge_index halfedge(Vertex_index v, Vertex_index w) const {
    const Halfedge_index h = mesh_->halfedge(v, w);
    if (!h.is_valid())
      throw Mesh_changed("vertices " + std::to_string(static_cast<std::size_t>(v)) + " and " +
                         std::to_string(static_cast<std::size_t>(w)) + " are not joined any more");
    return h;
  }

  template <class Noted>
  Vertex_index put(std::size_t id, const Coordinates& p, const Noted& noted) {
    const Vertex_index v = vertex(id);
    star_.collect(*mesh_, v);
    is_ready_ = true;
    writing_->begin();
    mesh_->point(v) = to_point(p);
    broad_phase_->faces_moved(star_.faces);
    noted(v);
    writing_->end();
    visitor_.vertex_moved(v);
    return v;
  }

  /// All at once: the visitor hears when all stand. \param end 0: as before, 1: as after
  template <class Noted>
  Vertex_index put_all(const Change& edit, int end, const Noted& noted, const Part_runner& run) {
    // All that allocates comes before the first point is written.
    collect_faces_around(*mesh_, *corners_of_, ids_, edit.around, is_taken_, faces_);
    is_ready_ = true;
    writing_->begin();
    for (std::size_t k = 0; k < edit.around.size(); ++k) {
      const Vertex_index v = vertex(edit.around[k]);
      Coordinates p = vertex_coordinates(*mesh_, v);
      p[edit.vertex] = edit.ways[k][end];
      mesh_->point(v) = to_point(p);
    }
    broad_phase_->many_faces_moved(faces_, *corners_of_, run);
    noted(Vertex_index());
    writing_->end();
    if constexpr (has_visitor)
      for (const std::size_t id : edit.around)
        visitor_.vertex_moved(vertex(id));
    return edit.around.empty() ? Vertex_index() : vertex(edit.around.back());
  }

  template <class Noted>
  Vertex_index create_on_face(const Change& edit, const Noted& noted) {
    const Halfedge_index h = halfedge(vertex(edit.around[0]), vertex(edit.around[1]));
    fan_.assign(1, h);
    make_room_for_star(edit, 3, {1, 3, 2}, {});
    fan_dies();
    return star_created(insert_star_in_face(*mesh_, h, to_point(edit.after)), edit, noted);
  }

  template <class Noted>
  Vertex_index create_on_edge(const Change& edit, const Noted& noted) {
    const Halfedge_index h = halfedge(vertex(edit.around[0]), vertex(edit.around[1]));
    fan_.assign(1, mesh_->opposite(h));
    fan_.push_back(h);
    make_room_for_star(edit, 4, {1, 3, 2}, {});
    fan_dies();
    return star_created(insert_star_in_edge(*mesh_, h, to_point(edit.after)), edit, noted);
  }

  template <class Noted>
  Vertex_index star_instead_of_fan(const Change& edit, const Noted& noted) {
    link_.clear();
    for (const std::size_t id : edit.around)
      link_.push_back(vertex(id));
    const std::size_t n = link_.size();
    find_fan(*mesh_, halfedge(link_[1], link_[0]), n - 2, fan_);
    make_room_for_star(edit, n, {1, n, n - 1}, {0, n - 3, n - 3});
    fan_dies();
    return star_created(insert_star_in_face(*mesh_, merge_fan(*mesh_, fan_), to_point(edit.before)), edit, noted);
  }

  template <class Noted>
  Vertex_index fan_instead_of_star(const Change& edit, const Noted& noted) {
    const Vertex_index v = vertex(edit.vertex), apex = vertex(edit.around[0]);
    star_.collect(*mesh_, v);
    Mesh_watch<Mesh>::check_faces(*corners_of_, star_.faces);
    const std::size_t n = star_.valence();
    fan_.reserve(n - 2);
    faces_.reserve(n - 2);
    room_.make({0, n - 3, n - 3}, {1, n, n - 1}, n - 2);
    star_dies(v);
    ids_.take(edit.vertex);
    fill_with_fan(*mesh_, remove_star(*mesh_, v), apex, fan_);
    fan_created(noted);
    return apex;
  }

  /// \param old where in edit.around the ends of the edge that dies are: 0 or 2
  template <class Noted>
  Vertex_index flip(const Change& edit, std::size_t old, const Noted& noted) {
    const Halfedge_index h = halfedge(vertex(edit.around[old]), vertex(edit.around[old + 1]));
    faces_.assign(1, mesh_->face(h));
    faces_.push_back(mesh_->face(mesh_->opposite(h)));
    Mesh_watch<Mesh>::check_faces(*corners_of_, faces_);
    kept_.die(ids_, Vertex_index(), faces_, std::array<Halfedge_index, 1>{h});
    is_ready_ = true;
    if constexpr (has_visitor) {
      for (const Face_index f : faces_)
        visitor_.face_dies(f);
      visitor_.edge_dies(mesh_->edge(h));
    }
    writing_->begin();
    CGAL::Euler::flip_edge(h, *mesh_);
    corners_of_->update(faces_);
    broad_phase_->faces_moved(faces_); // they keep their descriptors
    noted(Vertex_index());
    writing_->end();
    kept_.create(ids_, Vertex_index(), faces_, std::array<Halfedge_index, 1>{h});
    if constexpr (has_visitor) {
      visitor_.edge_created(mesh_->edge(h));
      for (const Face_index f : faces_)
        visitor_.face_created(f);
    }
    return vertex(edit.around[2 - old]);
  }

  void collect_fan_faces() {
    faces_.clear();
    for (const Halfedge_index h : fan_)
      faces_.push_back(mesh_->face(h));
  }

  auto inside_of_fan() const { return CGAL::make_range(fan_.begin() + 1, fan_.end()); }

  /// Looks up and compares the fan that a star of this valence is to replace, and makes room for all that will be
  /// written.
  void make_room_for_star(const Change& edit, std::size_t valence, const Elements& born, const Elements& dead) {
    collect_fan_faces();
    Mesh_watch<Mesh>::check_faces(*corners_of_, faces_);
    star_.reserve(valence);
    ids_.make_room_for(edit.vertex);
    room_.make(born, dead, valence);
  }

  void fan_dies() {
    kept_.die(ids_, Vertex_index(), faces_, inside_of_fan());
    is_ready_ = true;
    if constexpr (has_visitor) {
      for (const Face_index f : faces_)
        visitor_.face_dies(f);
      for (std::size_t i = 1; i < fan_.size(); ++i)
        visitor_.edge_dies(mesh_->edge(fan_[i]));
    }
    writing_->begin();
    broad_phase_->faces_removed(faces_);
    corners_of_->forget(faces_);
  }

  template <class Noted>
  void fan_created(const Noted& noted) {
    collect_fan_faces();
    corners_of_->update(faces_);
    broad_phase_->faces_inserted(faces_);
    noted(Vertex_index());
    writing_->end();
    kept_.create(ids_, Vertex_index(), faces_, inside_of_fan());
    if constexpr (has_visitor) {
      for (std::size_t i = 1; i < fan_.size(); ++i)
        visitor_.edge_created(mesh_->edge(fan_[i]));
      for (const Face_index f : faces_)
        visitor_.face_created(f);
    }
  }

  void star_dies(Vertex_index v) {
    kept_.die(ids_, v, star_.faces, mesh_->halfedges_around_target(mesh_->halfedge(v)));
    is_ready_ = true;
    if constexpr (has_visitor) {
      for (const Face_index f : star_.faces)
        visitor_.face_dies(f);
      for (const Halfedge_index h : mesh_->halfedges_around_target(mesh_->halfedge(v)))
        visitor_.edge_dies(mesh_->edge(h));
      visitor_.vertex_dies(v, ids_.id(v));
    }
    writing_->begin();
    broad_phase_->faces_removed(star_.faces);
    corners_of_->forget(star_.faces);
  }

  template <class Noted>
  Vertex_index star_created(Vertex_index v, const Change& edit, const Noted& noted) {
    ids_.give(edit.vertex, v);
    star_.collect(*mesh_, v);
    corners_of_->update(star_.faces);
    broad_phase_->faces_inserted(star_.faces);
    noted(v);
    writing_->end();
    kept_.create(ids_, v, star_.faces, mesh_->halfedges_around_target(mesh_->halfedge(v)));
    if constexpr (has_visitor) {
      visitor_.vertex_created(v, edit.vertex);
      for (const Halfedge_index h : mesh_->halfedges_around_target(mesh_->halfedge(v)))
        visitor_.edge_created(mesh_->edge(h));
      for (const Face_index f : star_.faces)
        visitor_.face_created(f);
    }
    return v;
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
