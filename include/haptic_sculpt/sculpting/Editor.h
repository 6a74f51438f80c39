// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_EDITOR_H
#define HAPTIC_SCULPT_SCULPTING_EDITOR_H

#include <haptic_sculpt/sculpting/Change_maker.h>
#include <haptic_sculpt/sculpting/Edit_proof.h>
#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/Pivot_order.h>
#include <haptic_sculpt/surface/delta_rule.h>

#include <CGAL/Kernel_traits.h>

namespace haptic_sculpt {

/// Creates and removes vertices of a mesh by Euler operations: each is proven and then done, or refused and nothing has changed.
/// Also takes changes back and makes them again. Change_maker makes what is decided here. See doc/edits.md.
template <class Mesh, class Broad_phase, class Visitor = Default_edit_visitor>
class Editor {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Point = typename Mesh::Point;
  using Coordinates = internal::Coordinates;
  using Result = Edit_result<Mesh>;

  Editor(Mesh& mesh, Broad_phase& broad_phase, Face_corners<Mesh>& corners, Filter_counters& counters, Visitor visitor = Visitor())
    : mesh_(&mesh), broad_phase_(&broad_phase), corners_of_(&corners),
      changes_(mesh, broad_phase, corners, std::move(visitor)), proof_(counters) {}

  const Vertex_names<Mesh>& names() const { return changes_.names(); }
  Visitor& visitor() { return changes_.visitor(); }
  const Edit_history& history() const { return history_; }

  /// Many drags may follow: what they need for undo is allocated now.
  void prepare_for_moves() { history_.make_room(); }

  /// A drag that has been made.
  void note_move(Vertex_index v, const Coordinates& before, const Coordinates& after) {
    history_.push({Edit_kind::move, names().name(v), before, after, {}});
    changes_.visitor().vertex_moved(v);
  }

  Result insert_on_face(Face_index f, const Coordinates& p, double delta) {
    const Halfedge_index h = mesh_->halfedge(f);
    if (auto refusal = refuse_creation({h}, p, delta))
      return *std::move(refusal);
    const Edit edit{Edit_kind::insert_on_face, names().size(), p, p, names_of(corners(h))};
    return make(edit);
  }

  Result insert_on_edge(Halfedge_index h, const Coordinates& p, double delta) {
    if (auto refusal = refuse_creation({h, mesh_->opposite(h)}, p, delta))
      return *std::move(refusal);
    const Edit edit{Edit_kind::insert_on_edge, names().size(), p, p, {names().name(mesh_->source(h)), names().name(mesh_->target(h))}};
    return make(edit);
  }

  /// Draws v into each neighbour in turn, the one first whose fan has the largest least angle, until one is free.
  Result remove(Vertex_index v, double delta) {
    if (mesh_->is_isolated(v))
      return Result::refused(Refusal_reason::isolated_vertex, {v});
    star_.collect(*mesh_, v);
    const Coordinates centre = vertex_coordinates(*mesh_, v);
    if (is_tetrahedron())
      return Result::refused(Refusal_reason::tetrahedron, {star_.link.begin(), star_.link.end()});
    candidates_.clear();
    // Whatever the pivot, the way stays in the hull of the star.
    broad_phase_->query(star_.swept(centre, centre).box(), candidates_);
    list_.assign(*mesh_, *corners_of_, star_, candidates_, Box_3());
    Result refusal = Result::refused(Refusal_reason::doubled_edge);
    for (internal::Pivot_order<Mesh> order(star_); const auto next = order.next();) {
      const std::size_t pivot = *next;
      std::vector<Vertex_index> in_the_way;
      if (!link_condition(pivot, in_the_way))
        keep_graver(refusal, Refusal_reason::doubled_edge, in_the_way);
      else if (!fan_keeps_delta(pivot, delta, in_the_way))
        keep_graver(refusal, Refusal_reason::delta, in_the_way);
      else if (!proof_.can_collapse(star_, list_, centre, pivot, in_the_way))
        keep_graver(refusal, Refusal_reason::blocked, in_the_way);
      else {
        std::vector<std::size_t> link;
        for (std::size_t i = 0; i < star_.valence(); ++i)
          link.push_back(names().name(star_.link[(pivot + i) % star_.valence()]));
        return make({Edit_kind::remove, names().name(v), centre, centre, std::move(link)});
      }
    }
    return refusal;
  }

  /// Takes the last change back. No proof is needed: the mesh was embedded before it, and moved back it is so again.
  Result undo() {
    const Edit* edit = history_.to_undo();
    if (edit == nullptr)
      return Result::refused(Refusal_reason::nothing_to_undo);
    const Vertex_index v = changes_.take_back(*edit);
    history_.undone();
    return Result::done(v);
  }

  /// Makes the last change that was taken back again.
  Result redo() {
    const Edit* edit = history_.to_redo();
    if (edit == nullptr)
      return Result::refused(Refusal_reason::nothing_to_redo);
    const Vertex_index v = changes_.make(*edit);
    history_.redone();
    return Result::done(v);
  }

  /// The face with these three corners, by number and in any order; the null index where there is none.
  Face_index face_of(std::size_t a, std::size_t b, std::size_t c) const {
    const Halfedge_index h = halfedge_of(a, b);
    const Vertex_index third = names().vertex(c);
    if (!h.is_valid() || !third.is_valid())
      return Face_index();
    for (const Halfedge_index g : {h, mesh_->opposite(h)})
      if (mesh_->target(mesh_->next(g)) == third)
        return mesh_->face(g);
    return Face_index();
  }

  /// The halfedge from a to b, by number; the null index where there is none.
  Halfedge_index halfedge_of(std::size_t a, std::size_t b) const {
    const Vertex_index v = names().vertex(a), w = names().vertex(b);
    if (!v.is_valid() || !w.is_valid() || v == w || mesh_->is_isolated(v) || mesh_->is_isolated(w))
      return Halfedge_index();
    return mesh_->halfedge(v, w);
  }

private:
  using Corners = internal::Corners<Mesh>;
  using Kernel = typename CGAL::Kernel_traits<Point>::Kernel;

  Mesh* mesh_;
  Broad_phase* broad_phase_;
  const Face_corners<Mesh>* corners_of_;
  Change_maker<Mesh, Broad_phase, Visitor> changes_;
  Edit_history history_;
  internal::Edit_proof<Mesh, Filter_counters> proof_;
  Star<Mesh> star_;
  Checklist<Mesh> list_;
  std::vector<Face_index> candidates_;

  Result make(Edit edit) {
    const Vertex_index v = changes_.make(edit);
    history_.push(std::move(edit));
    return Result::done(v);
  }

  static Point to_point(const Coordinates& p) { return Point(p[0], p[1], p[2]); }

  std::array<Vertex_index, 3> corners(Halfedge_index h) const {
    return {mesh_->source(h), mesh_->target(h), mesh_->target(mesh_->next(h))};
  }
  std::vector<std::size_t> names_of(const std::array<Vertex_index, 3>& vertices) const {
    return {names().name(vertices[0]), names().name(vertices[1]), names().name(vertices[2])};
  }
  Corners with_points(const std::array<Vertex_index, 3>& v) const {
    Corners result;
    for (int i = 0; i < 3; ++i)
      result[i] = {v[i], vertex_coordinates(*mesh_, v[i])};
    return result;
  }
  bool keeps_delta(const Coordinates& a, const Coordinates& b, const Coordinates& c, double delta) const {
    return Satisfies_delta_rule_3<Kernel>(delta)(to_point(a), to_point(b), to_point(c));
  }

  /// The proof of a creation (doc/edits.md): the new faces meet nothing improperly, and nothing stands between them and the old.
  std::optional<Result> refuse_creation(const std::vector<Halfedge_index>& old_halfedges, const Coordinates& p, double delta) {
    std::vector<Corners> old_faces, new_faces;
    Box_3 box(p);
    for (std::size_t k = 0; k < old_halfedges.size(); ++k) {
      const Corners old = with_points(corners(old_halfedges[k]));
      old_faces.push_back(old);
      for (int i = 0; i < 3; ++i) {
        box.include(old[i].point);
        if (old[i].point == p)
          return Result::refused(Refusal_reason::coincident_vertex, {old[i].index});
        if (i > 0 || old_halfedges.size() == 1) // the side that two old faces share is split
          new_faces.push_back({internal::Corner<Mesh>{Vertex_index(), p}, old[i], old[(i + 1) % 3]});
      }
    }
    for (const Corners& f : new_faces)
      if (!keeps_delta(f[0].point, f[1].point, f[2].point, delta))
        return Result::refused(Refusal_reason::delta, {f[1].index, f[2].index});
    for (std::size_t i = 0; i < new_faces.size(); ++i)
      for (std::size_t j = i + 1; j < new_faces.size(); ++j)
        if (proof_.meet_improperly(new_faces[i], new_faces[j]))
          return Result::refused(Refusal_reason::blocked, {new_faces[j][1].index, new_faces[j][2].index});
    return refuse_what_is_near(old_halfedges, old_faces, new_faces, p, box);
  }

  std::optional<Result> refuse_what_is_near(const std::vector<Halfedge_index>& old_halfedges, const std::vector<Corners>& old_faces,
                                            const std::vector<Corners>& new_faces, const Coordinates& p, const Box_3& box) {
    candidates_.clear();
    broad_phase_->query(box, candidates_);
    std::sort(candidates_.begin(), candidates_.end());
    for (const Face_index f : candidates_) {
      bool is_old = false;
      for (const Halfedge_index h : old_halfedges)
        is_old |= mesh_->face(h) == f;
      if (is_old)
        continue;
      const Corners other = with_points(corners(mesh_->halfedge(f)));
      for (const internal::Corner<Mesh>& corner : other)
        if (corner.point == p)
          return Result::refused(Refusal_reason::coincident_vertex, {corner.index});
      for (const Corners& g : new_faces)
        if (proof_.meet_improperly(g, other))
          return Result::refused(Refusal_reason::blocked, {other[0].index, other[1].index, other[2].index});
      for (const Corners& old : old_faces)
        for (const internal::Corner<Mesh>& corner : other)
          if (corner.index != old[0].index && corner.index != old[1].index && corner.index != old[2].index &&
              proof_.contains(old, p, corner.point))
            return Result::refused(Refusal_reason::blocked, {corner.index});
    }
    return std::nullopt;
  }

  bool is_tetrahedron() const {
    if (star_.valence() != 3)
      return false;
    for (const Vertex_index v : star_.link)
      if (mesh_->degree(v) != 3)
        return false;
    return true;
  }

  /// The centre and the pivot have no common neighbours but the two wings, and are not both of valence 3.
  bool link_condition(std::size_t pivot, std::vector<Vertex_index>& in_the_way) const {
    const Vertex_index apex = star_.link[pivot];
    const std::size_t n = star_.valence(), left = (pivot + 1) % n, right = (pivot + n - 1) % n;
    for (std::size_t i = 0; i < n; ++i)
      if (i != pivot && i != left && i != right && mesh_->halfedge(apex, star_.link[i]).is_valid()) {
        in_the_way = {apex, star_.link[i]};
        return false;
      }
    if (n == 3 && mesh_->degree(apex) == 3) {
      in_the_way = {apex};
      return false;
    }
    return true;
  }

  bool fan_keeps_delta(std::size_t pivot, double delta, std::vector<Vertex_index>& in_the_way) const {
    const std::size_t n = star_.valence();
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const std::size_t i = (pivot + k) % n, j = (pivot + k + 1) % n;
      if (!keeps_delta(star_.link_points[pivot], star_.link_points[i], star_.link_points[j], delta)) {
        in_the_way = {star_.link[pivot], star_.link[i], star_.link[j]};
        return false;
      }
    }
    return true;
  }

  /// Of the refusals for the several pivots, the last in the order of the checks says most.
  static void keep_graver(Result& refusal, Refusal_reason reason, const std::vector<Vertex_index>& elements) {
    if (refusal.refusal->elements.empty() || reason > refusal.refusal->reason)
      refusal = Result::refused(reason, elements);
  }
};

} // namespace haptic_sculpt

#endif
