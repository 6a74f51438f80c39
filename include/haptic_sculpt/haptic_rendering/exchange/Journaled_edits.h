// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_JOURNALED_EDITS_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_JOURNALED_EDITS_H

#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <optional>

namespace haptic_sculpt {

/// What a tool does to the mesh: edits, drags of vertices and strokes, each told to a journal, if there is one.
template <class Sculptor>
class Journaled_edits {
public:
  using Vertex_index = typename Sculptor::Vertex_index; ///< of the mesh
  using Point = typename Sculptor::Point;               ///< in the scene
  using Grab_type = typename Sculptor::Grab_type;       ///< what holds a vertex
  using Edited = Applied<typename Sculptor::Mesh_type>; ///< what an edit gives
  using Result = typename Sculptor::Result;             ///< what a drag gives

  /// Without a journal
  explicit Journaled_edits(Sculptor& sculptor) : sculptor_(&sculptor) {
    legs_.reserve(most_legs);
  }
  /// From here on in another scene, without a journal. \pre no stroke is under way
  void enter(Sculptor& sculptor) { sculptor_ = &sculptor, journal_ = nullptr; }
  void keep_journal(Edit_journal* journal) { journal_ = journal; } ///< nullptr: none

  /// What follows is one step of undo.
  void begin_stroke() {
    stroke_.emplace(sculptor_->stroke());
    add(Edit::of(Edit_kind::stroke));
  }
  /// Of the stroke under way, if there is one.
  void end_stroke() {
    if (stroke_)
      add(Edit::of(Edit_kind::end));
    stroke_.reset();
  }

  /// \pre it is no stroke and no end
  Edited make(const Edit& wanted) {
    auto made = sculptor_->apply(wanted);
    if (made)
      tell(made.edit);
    return made;
  }
  /// Makes an edit and begins a stroke with it. Where it is refused, or throws, there is no stroke.
  Edited make_in_stroke(const Edit& wanted) {
    std::optional<typename Sculptor::Stroke_type> begun(sculptor_->stroke());
    auto made = sculptor_->apply(wanted);
    if (made) {
      stroke_.emplace(std::move(*begun));
      add(Edit::of(Edit_kind::stroke));
      tell(made.edit);
    }
    return made;
  }

  /// A drag of a vertex of the surface; its legs are reported. \throw what drags throw
  Result drag(Grab_type& grab, const Point& target, const std::optional<Drag_parameters>& parameters) {
    const auto result = grab.drag_to(target, legs_, parameters);
    for (std::size_t k = 1; k < legs_.size(); ++k)
      if (legs_[k] != legs_[k - 1])
        add_move(grab.vertex(), legs_[k]);
    return result;
  }

  /// Moves many towards their targets, all at once along each axis, as far as that is free. \throw what move_vertices()
  /// throws; what has been moved is reported
  template <class Vertex_range, class Target_map>
  Move_report move_many(const Vertex_range& vertices, const Target_map& targets) {
    Places before;
    for (const Vertex_index v : vertices)
      before.emplace_back(v, vertex_coordinates(sculptor_->mesh(), v));
    try {
      const Move_report report = move_vertices(*sculptor_, vertices, targets, Move_parameters().drags(false));
      add_shifts(before);
      return report;
    } catch (...) {
      add_shifts(before);
      throw;
    }
  }

private:
  using Places = std::vector<std::pair<Vertex_index, std::array<double, 3>>>;

  Sculptor* sculptor_;
  Edit_journal* journal_ = nullptr;
  static constexpr std::size_t most_legs = 64; ///< of a drag, and more: room that is made for them
  std::optional<typename Sculptor::Stroke_type> stroke_;
  std::vector<Point> legs_; ///< of the last drag

  /// What many vertices have moved by, as three shifts: all of a coordinate's changes were one.
  void add_shifts(const Places& before) {
    for (int axis = 0; axis < 3; ++axis) {
      Edit shift = Edit::of(Edit_kind::shift);
      shift.axis = axis;
      for (const auto& [v, p] : before)
        if (const double now = vertex_coordinates(sculptor_->mesh(), v)[axis]; now != p[axis])
          shift.ways.emplace_back(sculptor_->id(v), now);
      if (!shift.ways.empty())
        add(shift);
    }
  }
  void add_move(Vertex_index v, const Point& to) {
    add(Edit::of(Edit_kind::move, {sculptor_->id(v), 0, 0}, {to.x(), to.y(), to.z()}));
  }
  /// A slide as its legs, each a move of its own, all one step; of what has changed nothing, nothing.
  void tell(const Edit& made) {
    const bool is_slide = !made.legs.empty() && !stroke_;
    if (is_slide)
      add(Edit::of(Edit_kind::stroke));
    for (const auto& leg : made.legs)
      add(Edit::of(Edit_kind::move, made.vertices, leg));
    if (made.kind == Edit_kind::move)
      add(Edit::of(Edit_kind::move, made.vertices, made.point));
    else if (made.kind != Edit_kind::none)
      add(made);
    if (is_slide)
      add(Edit::of(Edit_kind::end));
  }
  void add(const Edit& edit) {
    if (journal_ != nullptr)
      journal_->add(edit);
  }
};

} // namespace haptic_sculpt

#endif
