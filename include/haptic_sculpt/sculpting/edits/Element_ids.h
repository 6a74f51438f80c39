// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/edits/Change.h>
#include <haptic_sculpt/sculpting/edits/Vertex_ids.h>

#include <algorithm>
#include <array>
#include <optional>

namespace haptic_sculpt::internal {

/// An element by the numbers of its vertices, which last: of a face and an edge in ascending order, of a halfedge its
/// source first.
using Element_ids = std::array<std::size_t, 3>;

inline constexpr std::size_t no_id = static_cast<std::size_t>(-1);

inline Element_ids sorted(Element_ids ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

template <class Mesh>
Element_ids ids_of(const Mesh&, const Vertex_ids<Mesh>& ids, typename Mesh::Vertex_index v) {
  return {ids.id(v), no_id, no_id};
}
template <class Mesh>
Element_ids ids_of(const Mesh& mesh, const Vertex_ids<Mesh>& ids, typename Mesh::Halfedge_index h) {
  return {ids.id(mesh.source(h)), ids.id(mesh.target(h)), no_id};
}
template <class Mesh>
Element_ids ids_of(const Mesh& mesh, const Vertex_ids<Mesh>& ids, typename Mesh::Edge_index e) {
  return sorted(ids_of(mesh, ids, mesh.halfedge(e)));
}
template <class Mesh>
Element_ids ids_of(const Mesh& mesh, const Vertex_ids<Mesh>& ids, typename Mesh::Face_index f) {
  const auto h = mesh.halfedge(f);
  return sorted({ids.id(mesh.source(h)), ids.id(mesh.target(h)), ids.id(mesh.target(mesh.next(h)))});
}

/// Which of the elements that an edit takes away one of those it makes comes from, by ids. What comes from none is
/// not in the table.
///
/// | edit | new | comes from |
/// |---|---|---|
/// | insert on face | face | the old face |
/// | insert on edge | face, edge, halfedge | the old one that it is a part of |
/// | collapse of V into P | what has P as a vertex | what had V in the place of P |
/// | flip | face; edge, halfedge | both old faces; the old edge, halfedge |
///
/// Of an edit that is taken back the columns change places.
class Edit_lineage {
public:
  /// \param is_directed whether the ids are those of halfedges
  Edit_lineage(const Change& change, bool is_back, bool is_directed)
      : change_(&change), is_back_(is_back), is_directed_(is_directed) {}

  /// Of a collapse, what `created` comes from, if there was one such; of other edits none is said.
  std::optional<Element_ids> only_origin(Element_ids created) const {
    if (change_->edit.kind != Edit_kind::collapse)
      return std::nullopt;
    const std::size_t v = change_->edit.vertices[0], p = change_->edit.vertices[1];
    std::replace(created.begin(), created.end(), is_back_ ? v : p, is_back_ ? p : v);
    return is_directed_ ? created : sorted(created);
  }

  /// Whether `created` comes from `dead`. \pre both are of one kind
  bool comes_from(const Element_ids& created, const Element_ids& dead) const {
    return is_back_ ? is_of(dead, created) : is_of(created, dead);
  }

private:
  const Change* change_;
  bool is_back_, is_directed_;

  /// As the edit is made.
  bool is_of(const Element_ids& made, const Element_ids& old) const {
    switch (change_->edit.kind) {
    case Edit_kind::insert_on_face:
      return true; // no edge dies
    case Edit_kind::insert_on_edge:
      return is_directed_ ? made[0] == old[0] || made[1] == old[1] : is_part(made, old);
    case Edit_kind::flip:
      return !is_directed_ || (made[0] == change_->around[0]) == (old[0] == change_->edit.vertices[0]);
    default:
      return only_origin(made) == old;
    }
  }
  /// Whether all vertices of `made` but the new one are those of `old`.
  bool is_part(const Element_ids& made, const Element_ids& old) const {
    return std::all_of(made.begin(), made.end(), [&](std::size_t id) {
      return id == change_->around[0] || std::find(old.begin(), old.end(), id) != old.end();
    });
  }
};

} // namespace haptic_sculpt::internal
