// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_CHANGE_MAKER_H
#define HAPTIC_SCULPT_SCULPTING_CHANGE_MAKER_H

#include <haptic_sculpt/sculpting/Edit_history.h>
#include <haptic_sculpt/sculpting/Edit_visitor.h>
#include <haptic_sculpt/sculpting/Vertex_names.h>
#include <haptic_sculpt/sculpting/star_edits.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/star.h>

#include <type_traits>

namespace haptic_sculpt {

/// Makes changes of a mesh and takes them back, and keeps the broad phase, the numbers of the vertices and a visitor told. Nothing
/// is proven here: what comes in has been, or restores what was.
///
/// Every change but a move replaces the fan of one vertex over a polygon by the star of another, or the other way round. Cost:
/// the size of the polygon, the degree of the fan's vertex to find it, and the broad phase.
template <class Mesh, class Broad_phase, class Visitor>
class Change_maker {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Coordinates = internal::Coordinates;

  Change_maker(Mesh& mesh, Broad_phase& broad_phase, Face_corners<Mesh>& corners, Visitor visitor)
    : mesh_(&mesh), broad_phase_(&broad_phase), corners_of_(&corners), names_(mesh), visitor_(std::move(visitor)) {}

  const Vertex_names<Mesh>& names() const { return names_; }
  Visitor& visitor() { return visitor_; }

  /// \return the vertex moved or created; of a removal, the neighbour it went into
  Vertex_index make(const Edit& edit) {
    switch (edit.kind) {
    case Edit_kind::move:
      return put(edit.vertex, edit.after);
    case Edit_kind::insert_on_face:
      return create_on_face(mesh_->halfedge(vertex(edit.around[0]), vertex(edit.around[1])), edit);
    case Edit_kind::insert_on_edge:
      return create_on_edge(mesh_->halfedge(vertex(edit.around[0]), vertex(edit.around[1])), edit);
    default:
      fan_instead_of_star(edit);
      return vertex(edit.around[0]);
    }
  }

  /// \return the vertex moved or revived; of a creation, a neighbour of what was created
  Vertex_index take_back(const Edit& edit) {
    switch (edit.kind) {
    case Edit_kind::move:
      return put(edit.vertex, edit.before);
    case Edit_kind::remove:
      return star_instead_of_fan(edit);
    default:
      fan_instead_of_star(edit);
      return vertex(edit.around[0]);
    }
  }

private:
  static constexpr bool has_visitor = !std::is_same<Visitor, Default_edit_visitor>::value;

  Mesh* mesh_;
  Broad_phase* broad_phase_;
  Face_corners<Mesh>* corners_of_;
  Vertex_names<Mesh> names_;
  Visitor visitor_;
  Star<Mesh> star_;
  internal::Fan<Mesh> fan_;
  std::vector<Vertex_index> link_;
  std::vector<Face_index> faces_;

  Vertex_index vertex(std::size_t name) const { return names_.vertex(name); }
  static typename Mesh::Point to_point(const Coordinates& p) { return {p[0], p[1], p[2]}; }

  Vertex_index put(std::size_t name, const Coordinates& p) {
    const Vertex_index v = vertex(name);
    mesh_->point(v) = to_point(p);
    star_.collect(*mesh_, v);
    broad_phase_->faces_moved(star_.faces);
    visitor_.vertex_moved(v);
    return v;
  }

  Vertex_index create_on_face(Halfedge_index h, const Edit& edit) {
    fan_.assign(1, h);
    fan_dies();
    return star_created(internal::insert_star_in_face(*mesh_, h, to_point(edit.after)), edit);
  }

  Vertex_index create_on_edge(Halfedge_index h, const Edit& edit) {
    fan_.assign({mesh_->opposite(h), h});
    fan_dies();
    return star_created(internal::insert_star_in_edge(*mesh_, h, to_point(edit.after)), edit);
  }

  Vertex_index star_instead_of_fan(const Edit& edit) {
    link_.clear();
    for (const std::size_t name : edit.around)
      link_.push_back(vertex(name));
    internal::find_fan(*mesh_, link_, fan_);
    fan_dies();
    return star_created(internal::insert_star_in_face(*mesh_, internal::merge_fan(*mesh_, fan_), to_point(edit.before)), edit);
  }

  void fan_instead_of_star(const Edit& edit) {
    const Vertex_index v = vertex(edit.vertex);
    star_dies(v);
    names_.take(edit.vertex);
    internal::fill_with_fan(*mesh_, internal::remove_star(*mesh_, v), vertex(edit.around[0]), fan_);
    fan_created();
  }

  void collect_fan_faces() {
    faces_.clear();
    for (const Halfedge_index h : fan_)
      faces_.push_back(mesh_->face(h));
  }

  void fan_dies() {
    collect_fan_faces();
    if constexpr (has_visitor) {
      for (const Face_index f : faces_)
        visitor_.face_dies(f);
      for (std::size_t i = 1; i < fan_.size(); ++i)
        visitor_.edge_dies(mesh_->edge(fan_[i]));
    }
    broad_phase_->faces_removed(faces_);
  }

  void fan_created() {
    collect_fan_faces();
    corners_of_->update(faces_);
    broad_phase_->faces_inserted(faces_);
    if constexpr (has_visitor) {
      for (std::size_t i = 1; i < fan_.size(); ++i)
        visitor_.edge_created(mesh_->edge(fan_[i]));
      for (const Face_index f : faces_)
        visitor_.face_created(f);
    }
  }

  void star_dies(Vertex_index v) {
    star_.collect(*mesh_, v);
    if constexpr (has_visitor) {
      for (const Face_index f : star_.faces)
        visitor_.face_dies(f);
      for (const Halfedge_index h : mesh_->halfedges_around_target(mesh_->halfedge(v)))
        visitor_.edge_dies(mesh_->edge(h));
      visitor_.vertex_dies(v, names_.name(v));
    }
    broad_phase_->faces_removed(star_.faces);
  }

  Vertex_index star_created(Vertex_index v, const Edit& edit) {
    names_.give(edit.vertex, v);
    star_.collect(*mesh_, v);
    corners_of_->update(star_.faces);
    broad_phase_->faces_inserted(star_.faces);
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

} // namespace haptic_sculpt

#endif
