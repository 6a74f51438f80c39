// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/sculpting/Applied.h>
#include <haptic_sculpt/sculpting/Stroke.h>
#include <haptic_sculpt/sculpting/contact/check_arguments.h>
#include <haptic_sculpt/sculpting/edits/Sculptor_access.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Responses.h>
#include <haptic_sculpt/sculpting/response/Slide_path.h>
#include <haptic_sculpt/surface/containers/make_room.h>

#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Edits by value, made by a Sculptor's functions.
template <class Sculptor, class Mesh>
class Edit_applier {
public:
  using Point = typename Mesh::Point;
  using Done = Applied<Mesh>;

  Done apply(Sculptor& sculptor, const Edit& edit) {
    const Rounding_to_nearest rounding;
    Sculptor_access::guarded(sculptor).check_may_begin(); // before anything is looked up, or written here
    Edit made = edit; // before anything is changed: memory may run out, and a visitor may drop the caller's
    if (made.kind == Edit_kind::move)
      return move(sculptor, made);
    made.legs.clear(); // those of a move alone
    const auto v = made.vertices;
    const Point p = point(made.point);
    sculptor.release();
    switch (made.kind) {
    case Edit_kind::insert_on_face:
      return done(std::move(made), sculptor.insert_on_face(sculptor.face_of(v[0], v[1], v[2]), p));
    case Edit_kind::insert_on_edge:
      return done(std::move(made), sculptor.insert_on_edge(sculptor.edge_of(v[0], v[1]), p));
    case Edit_kind::remove: {
      Done result = done(std::move(made), sculptor.remove(sculptor.vertex(v[0])));
      if (result)
        result.edit = Edit::of(Edit_kind::collapse, {v[0], sculptor.id(*result.vertex), 0});
      return result;
    }
    case Edit_kind::collapse:
      return done(std::move(made), sculptor.collapse(sculptor.halfedge_of(v[0], v[1])));
    case Edit_kind::flip:
      return done(std::move(made), sculptor.flip(sculptor.edge_of(v[0], v[1])));
    case Edit_kind::shift:
      return shift(sculptor, std::move(made));
    case Edit_kind::undo:
      return restored(sculptor, std::move(made), [&] { return sculptor.undo(); });
    case Edit_kind::redo:
      return restored(sculptor, std::move(made), [&] { return sculptor.redo(); });
    case Edit_kind::stroke:
      strokes_.push_back(sculptor.stroke());
      break;
    case Edit_kind::end:
      if (strokes_.empty())
        return done({}, Edit_result<Mesh>::refused(Refusal_reason::no_stroke));
      strokes_.pop_back();
      break;
    default: // none
      break;
    }
    return done(std::move(made), {});
  }

private:
  std::vector<Stroke<Sculptor>> strokes_; ///< begun and not ended, each within the one before
  std::vector<Point> path_;               ///< of the last drag; kept to allocate no more

  static Point point(const std::array<double, 3>& p) { return Point(p[0], p[1], p[2]); }

  static Done done(Edit&& made, Edit_result<Mesh>&& result) {
    Done done;
    static_cast<Edit_result<Mesh>&>(done) = std::move(result);
    if (done)
      done.edit = std::move(made);
    return done;
  }

  /// One that is refused has ended the stroke under way all the same, and does so again.
  template <class Restore>
  static Done restored(Sculptor& sculptor, Edit&& made, const Restore& restore) {
    const bool ends_stroke = Sculptor_access::guarded(sculptor).editor().history().is_in_stroke();
    Done result;
    static_cast<Edit_result<Mesh>&>(result) = restore();
    if (result || ends_stroke)
      result.edit = std::move(made);
    return result;
  }

  /// Contacts are carried on from the last edit, if that was a move of the same vertex.
  Done move(Sculptor& sculptor, const Edit& edit) {
    const auto v = sculptor.vertex(edit.vertices[0]);
    if (!v.is_valid()) {
      sculptor.release();
      return done({}, Edit_result<Mesh>::refused(Refusal_reason::unknown_element));
    }
    for (const auto& leg : edit.legs) // before the first is gone, not after
      check_point("a leg", point(leg));
    check_point("the target", point(edit.point));
    Done result;
    result.vertex = v;
    auto& guarded = Sculptor_access::guarded(sculptor);
    const bool serves = !guarded.has_outgrown_clearance();
    const auto drag_to = [&](const std::array<double, 3>& p) {
      make_room(result.edit.legs, result.edit.legs.size() + Slide_path::most_legs); // before it: memory may run out
      const Coordinates source = vertex_coordinates(sculptor.mesh(), v);
      path_.assign({point(source), point(p)});
      // By a leg before the scene may have outgrown the clearance: what was free once needs none.
      if (serves && guarded.has_outgrown_clearance() &&
          guarded.move_if_free(v, point(p), std::nullopt, sculptor.parameters().delta_length)) {
        result.drag.emplace().legs = 1;
        settle_result(source, p, p, *result.drag);
      } else {
        result.drag = guarded.drag(v, point(p), &path_, std::nullopt);
      }
      for (std::size_t k = 1; k < path_.size(); ++k)
        if (path_[k] != path_[k - 1]) // +0 and -0 are one place
          result.edit.legs.push_back({path_[k].x(), path_[k].y(), path_[k].z()});
    };
    std::optional<Stroke<Sculptor>> all_are_one_step;
    if (!edit.legs.empty())
      all_are_one_step.emplace(sculptor.stroke());
    for (const auto& leg : edit.legs)
      drag_to(leg);
    drag_to(edit.point);
    if (result.edit.legs.empty())
      return result;
    result.edit.kind = Edit_kind::move, result.edit.vertices = {edit.vertices[0], 0, 0};
    result.edit.point = result.edit.legs.back();
    result.edit.legs.pop_back();
    return result;
  }

  static Done shift(Sculptor& sculptor, Edit&& made) {
    std::vector<std::pair<typename Mesh::Vertex_index, double>> ways;
    ways.reserve(made.ways.size());
    for (const auto& [id, end] : made.ways) {
      ways.emplace_back(sculptor.vertex(id), end);
      if (!ways.back().first.is_valid())
        return done({}, Edit_result<Mesh>::refused(Refusal_reason::unknown_element));
    }
    const auto& guarded = Sculptor_access::guarded(sculptor);
    const std::uint64_t before = guarded.changes();
    auto result = sculptor.shift(made.axis, ways);
    return done(guarded.changes() != before ? std::move(made) : Edit(), std::move(result));
  }
};

} // namespace haptic_sculpt::internal
