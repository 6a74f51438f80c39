// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Part_runner.h>
#include <haptic_sculpt/sculpting/Edit_visitor.h>
#include <haptic_sculpt/sculpting/edits/Change.h>
#include <haptic_sculpt/sculpting/edits/Element_room.h>
#include <haptic_sculpt/sculpting/edits/Kept_properties.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/sculpting/edits/Write_state.h>
#include <haptic_sculpt/sculpting/edits/star_edits.h>
#include <haptic_sculpt/surface/containers/Round_marks.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <algorithm>
#include <exception>
#include <new>
#include <type_traits>

namespace haptic_sculpt::internal {

/// Makes changes of a mesh and takes them back, and keeps the broad phase, the numbers of the vertices and a visitor
/// told. Nothing is proven here: what comes in has been, or restores what was.
///
/// Every change but a move, a shift and a flip replaces the fan of one vertex over a polygon by the star of another, or
/// the other way round. Cost: the size of the polygon, the degree of the fan's vertex to find it, and the broad phase.
///
/// In this order: what is to be replaced is looked up and compared with what is known; room is made for all that will
/// be written; values are kept, and the visitor hears, of what dies; all is written, `noted` included; what was made
/// gets values, and the visitor hears of it. So an exception leaves a change not begun, or complete. One that comes
/// while all is written leaves the Write_state saying so (doc/proofs/edits.md, "Memory that runs out").
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
  Vertex_index make(const Change& change, const Place& place, const Noted& noted,
                    const Part_runner& run = Part_runner()) {
    const Edit& edit = change.edit;
    begin(change, false, place);
    switch (edit.kind) {
    case Edit_kind::move:
      return put(edit.vertices[0], edit.point, noted);
    case Edit_kind::shift:
      return put_all(edit, [&edit](std::size_t k) { return edit.ways[k].second; }, noted, run);
    case Edit_kind::insert_on_face:
    case Edit_kind::insert_on_edge:
      return create(change, noted);
    case Edit_kind::flip:
      return flip(edit.vertices[0], edit.vertices[1], change.around[0], noted);
    default:
      return fan_instead_of_star(edit.vertices[0], edit.vertices[1], noted);
    }
  }

  /// \return the vertex moved or revived; of a creation, a neighbour of what was created; of a flip, an end of the old
  /// edge
  template <class Noted>
  Vertex_index take_back(const Change& change, const Place& place, const Noted& noted,
                         const Part_runner& run = Part_runner()) {
    const Edit& edit = change.edit;
    begin(change, true, place);
    switch (edit.kind) {
    case Edit_kind::move:
      return put(edit.vertices[0], change.before, noted);
    case Edit_kind::shift:
      return put_all(edit, [&change](std::size_t k) { return change.starts[k]; }, noted, run);
    case Edit_kind::collapse:
      return star_instead_of_fan(change, noted);
    case Edit_kind::flip:
      return flip(change.around[0], change.around[1], edit.vertices[0], noted);
    default:
      return fan_instead_of_star(change.around[0], edit.vertices[0], noted);
    }
  }

  /// Whether the visitor hears of changes; at first it does.
  void tell_visitor(bool does) { tells_visitor_ = does; }
  /// Whether the exception that ended the last make() or take_back() is the visitor's; what it hears of lineages comes
  /// from a map.
  bool has_visitor_thrown() const { return is_visitor_asked_; }

  /// The visitor hears of a move that was made elsewhere.
  void tell_moved(Vertex_index v) {
    if constexpr (has_visitor) {
      const Write_state::Asking asking(*writing_);
      is_visitor_asked_ = true;
      visitor_.vertex_moved(v);
      is_visitor_asked_ = false;
    }
  }

  /// Room for this many edits.
  void reserve(std::size_t edits, std::size_t usual_valence) {
    room_.reserve(edits);
    star_.reserve(usual_valence);
    fan_.reserve(usual_valence);
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
  std::vector<Face_index> faces_;
  Round_marks is_taken_; ///< faces
  bool tells_visitor_ = true;
  bool is_visitor_asked_ = false; ///< stays so where it throws

  Vertex_index vertex(std::size_t id) const { return ids_.vertex(id); }
  void begin(const Change& change, bool is_back, const Place& place) {
    is_visitor_asked_ = false;
    if (change.edit.kind != Edit_kind::move && change.edit.kind != Edit_kind::shift)
      kept_.begin(change, is_back, place);
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
    writing_->begin();
    mesh_->point(v) = to_point(p);
    broad_phase_->faces_moved(star_.faces);
    noted(v);
    writing_->end();
    if (tells_visitor_)
      tell_moved(v);
    return v;
  }

  /// All at once: the visitor hears when all stand. \param coordinate(k) where the k-th is to be along the axis
  template <class Coordinate, class Noted>
  Vertex_index put_all(const Edit& edit, const Coordinate& coordinate, const Noted& noted, const Part_runner& run) {
    // All that allocates comes before the first point is written.
    collect_faces_around(edit.ways);
    writing_->begin();
    for (std::size_t k = 0; k < edit.ways.size(); ++k) {
      const Vertex_index v = vertex(edit.ways[k].first);
      Coordinates p = vertex_coordinates(*mesh_, v);
      p[edit.axis] = coordinate(k);
      mesh_->point(v) = to_point(p);
    }
    try {
      broad_phase_->many_faces_moved(faces_, *corners_of_, run);
    } catch (const std::bad_alloc&) {
      if (!run.is_shared())
        throw;
      broad_phase_->many_faces_moved(faces_, *corners_of_, Part_runner()); // alone it takes no memory
    }
    noted(Vertex_index());
    writing_->end();
    if constexpr (has_visitor)
      for (const auto& way : edit.ways)
        if (tells_visitor_)
          tell_moved(vertex(way.first));
    return edit.ways.empty() ? Vertex_index() : vertex(edit.ways.back().first);
  }

  /// Each face once, in any order. Cost: linear in the faces. Where half of all vertices move, or more (removed ones
  /// count), all faces are looked at in their order, which takes a fraction of the time: nothing waits for halfedges.
  void collect_faces_around(const std::vector<std::pair<std::size_t, double>>& ways) {
    faces_.clear();
    is_taken_.begin(std::max<std::size_t>(mesh_->num_faces(), mesh_->num_vertices()));
    if (2 * ways.size() >= mesh_->num_vertices()) {
      for (const auto& way : ways)
        is_taken_.mark(static_cast<std::size_t>(vertex(way.first)));
      const auto moves = [&](Vertex_index v) { return is_taken_.is_marked(static_cast<std::size_t>(v)); };
      for (const Face_index f : mesh_->faces())
        if (const auto& v = (*corners_of_)(f); moves(v[0]) || moves(v[1]) || moves(v[2]))
          faces_.push_back(f);
      return;
    }
    for (const auto& way : ways)
      for (const Face_index f : mesh_->faces_around_target(mesh_->halfedge(vertex(way.first))))
        if (is_taken_.mark(static_cast<std::size_t>(f)))
          faces_.push_back(f);
  }

  template <class Noted>
  Vertex_index create(const Change& change, const Noted& noted) {
    const auto& corners = change.edit.vertices;
    const bool is_on_edge = change.edit.kind == Edit_kind::insert_on_edge;
    const Halfedge_index h = halfedge(vertex(corners[0]), vertex(corners[1]));
    fan_.assign(1, is_on_edge ? mesh_->opposite(h) : h);
    if (is_on_edge)
      fan_.push_back(h);
    make_room_for_star(change.around[0], is_on_edge ? 4 : 3, {1, 3, 2}, {});
    fan_dies();
    const auto p = to_point(change.edit.point);
    return star_created(is_on_edge ? insert_star_in_edge(*mesh_, h, p) : insert_star_in_face(*mesh_, h, p),
                        change.around[0], noted);
  }

  template <class Noted>
  Vertex_index star_instead_of_fan(const Change& change, const Noted& noted) {
    const std::size_t n = change.around.size(), id = change.edit.vertices[0];
    find_fan(*mesh_, halfedge(vertex(change.around[1]), vertex(change.around[0])), n - 2, fan_);
    make_room_for_star(id, n, {1, n, n - 1}, {0, n - 3, n - 3});
    fan_dies();
    return star_created(insert_star_in_face(*mesh_, merge_fan(*mesh_, fan_), to_point(change.before)), id, noted);
  }

  template <class Noted>
  Vertex_index fan_instead_of_star(std::size_t id, std::size_t apex_id, const Noted& noted) {
    const Vertex_index v = vertex(id), apex = vertex(apex_id);
    star_.collect(*mesh_, v);
    Mesh_watch<Mesh>::check_faces(*corners_of_, star_.faces);
    const std::size_t n = star_.valence();
    fan_.reserve(n - 2);
    faces_.reserve(n - 2);
    room_.make({0, n - 3, n - 3}, {1, n, n - 1}, n - 2);
    begin_to_write(v, star_.faces, halfedges_into(v));
    take_away(star_.faces);
    ids_.take(id);
    fill_with_fan(*mesh_, remove_star(*mesh_, v), apex, fan_);
    collect_fan_faces();
    put_there(faces_);
    end_to_write(Vertex_index(), faces_, inside_of_fan(), noted);
    return apex;
  }

  /// The edge from one to the other. \param corner an end of the new edge, which is returned
  template <class Noted>
  Vertex_index flip(std::size_t from, std::size_t to, std::size_t corner, const Noted& noted) {
    const std::array<Halfedge_index, 1> edge = {halfedge(vertex(from), vertex(to))};
    faces_.assign(1, mesh_->face(edge[0]));
    faces_.push_back(mesh_->face(mesh_->opposite(edge[0])));
    Mesh_watch<Mesh>::check_faces(*corners_of_, faces_);
    begin_to_write(Vertex_index(), faces_, edge);
    CGAL::Euler::flip_edge(edge[0], *mesh_);
    corners_of_->update(faces_);
    broad_phase_->faces_moved(faces_); // they keep their descriptors
    end_to_write(Vertex_index(), faces_, edge, noted);
    return vertex(corner);
  }

  void collect_fan_faces() {
    faces_.clear();
    for (const Halfedge_index h : fan_)
      faces_.push_back(mesh_->face(h));
  }

  auto inside_of_fan() const { return CGAL::make_range(fan_.begin() + 1, fan_.end()); }
  auto halfedges_into(Vertex_index v) const { return mesh_->halfedges_around_target(mesh_->halfedge(v)); }

  /// Looks up and compares the fan that a star of this valence is to replace, and makes room for all that will be
  /// written.
  void make_room_for_star(std::size_t id, std::size_t valence, const Elements& born, const Elements& dead) {
    collect_fan_faces();
    Mesh_watch<Mesh>::check_faces(*corners_of_, faces_);
    star_.reserve(valence);
    ids_.make_room_for(id);
    room_.make(born, dead, valence);
  }

  void fan_dies() {
    begin_to_write(Vertex_index(), faces_, inside_of_fan());
    take_away(faces_);
  }

  template <class Noted>
  Vertex_index star_created(Vertex_index v, std::size_t id, const Noted& noted) {
    ids_.give(id, v);
    star_.collect(*mesh_, v);
    put_there(star_.faces);
    end_to_write(v, star_.faces, halfedges_into(v), noted);
    return v;
  }

  void take_away(const std::vector<Face_index>& faces) {
    broad_phase_->faces_removed(faces);
    corners_of_->forget(faces);
  }
  void put_there(const std::vector<Face_index>& faces) {
    corners_of_->update(faces);
    broad_phase_->faces_inserted(faces);
  }

  /// Values are kept, and the visitor hears, of what will die. \param v the null index where no vertex dies
  template <class Halfedges>
  void begin_to_write(Vertex_index v, const std::vector<Face_index>& faces, const Halfedges& halfedges) {
    const Write_state::Asking asking(*writing_);
    kept_.die(ids_, v, faces, halfedges);
    if (has_visitor && tells_visitor_) {
      is_visitor_asked_ = true;
      for (const Face_index f : faces)
        visitor_.face_dies(f);
      for (const Halfedge_index h : halfedges)
        visitor_.edge_dies(mesh_->edge(h));
      if (v.is_valid())
        visitor_.vertex_dies(v, ids_.id(v));
      is_visitor_asked_ = false;
    }
    writing_->begin();
  }

  /// What was made gets values, and the visitor hears of it. \param v the null index where no vertex was made
  template <class Halfedges, class Noted>
  void end_to_write(Vertex_index v, const std::vector<Face_index>& faces, const Halfedges& halfedges,
                    const Noted& noted) {
    noted(v);
    writing_->end();
    const Write_state::Asking asking(*writing_);
    std::exception_ptr failure; // of a map: who listens hears all the same of what stands
    try {
      kept_.create(ids_, v, faces, halfedges);
    } catch (...) {
      failure = std::current_exception();
    }
    if (has_visitor && tells_visitor_) {
      is_visitor_asked_ = true;
      if (v.is_valid())
        visitor_.vertex_created(v, ids_.id(v));
      for (const Halfedge_index h : halfedges)
        visitor_.edge_created(mesh_->edge(h));
      for (const Face_index f : faces)
        visitor_.face_created(f);
      is_visitor_asked_ = false;
    }
    if (failure)
      std::rethrow_exception(failure);
  }
};

} // namespace haptic_sculpt::internal
