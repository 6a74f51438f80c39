// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_JOURNALED_EDITS_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_JOURNALED_EDITS_H

#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>
#include <haptic_sculpt/sculpting.h>

#include <optional>

namespace haptic_sculpt {

/// What a tool does to the mesh: edits, drags of vertices and strokes, each told to a journal, if there is one.
template <class Sculptor>
class Journaled_edits {
public:
  using Kind = Journal_entry::Kind;                     ///< of entries
  using Vertex_index = typename Sculptor::Vertex_index; ///< of the mesh
  using Point = typename Sculptor::Point;               ///< in the scene
  using Grab_type = typename Sculptor::Grab_type;       ///< what holds a vertex
  using Edited = typename Sculptor::Edited;             ///< what an edit gives
  using Result = typename Sculptor::Result;             ///< what a drag gives

  explicit Journaled_edits(Sculptor& sculptor) : sculptor_(&sculptor) { legs_.reserve(most_legs); } ///< without a journal
  /// From here on in another scene, without a journal. \pre no stroke is under way
  void enter(Sculptor& sculptor) { sculptor_ = &sculptor, journal_ = nullptr; }
  void keep_journal(Edit_journal* journal) { journal_ = journal; } ///< nullptr: none

  /// What follows is one step of undo.
  void begin_stroke() {
    stroke_.emplace(sculptor_->stroke());
    add(Kind::stroke);
  }
  /// Of the stroke under way, if there is one.
  void end_stroke() {
    if (stroke_)
      add(Kind::end);
    stroke_.reset();
  }

  /// \param wanted with `Sculptor::name()`s \pre its kind is an edit of elements, an undo or a redo
  Edited make(const Journal_entry& wanted) {
    auto made = edit(wanted);
    if (made)
      note(wanted, made);
    return made;
  }
  /// Makes an edit and begins a stroke with it. Where it is refused, or throws, there is no stroke.
  Edited make_in_stroke(const Journal_entry& wanted) {
    std::optional<typename Sculptor::Stroke_type> begun(sculptor_->stroke());
    auto made = edit(wanted);
    if (made) {
      stroke_.emplace(std::move(*begun));
      add(Kind::stroke);
      note(wanted, made);
    }
    return made;
  }

  /// A drag of a vertex of the surface; its legs are told. \throw what drags throw
  Result drag(Grab_type& grab, const Point& target) {
    const auto result = grab.drag_to(target, legs_);
    for (std::size_t k = 1; k < legs_.size(); ++k)
      if (legs_[k] != legs_[k - 1])
        add_move(grab.vertex(), legs_[k]);
    return result;
  }

  /// Moves many as near to their targets as straight ways lead. The Sculptor's visitor has to be a Scene_teller.
  /// \throw what move_vertices() throws; what has been moved is told
  template <class Vertex_range, class Target_map>
  Move_report move_many(const Vertex_range& vertices, const Target_map& targets) {
    const Telling_moves telling(*this);
    return move_vertices(*sculptor_, vertices, targets, Move_parameters().steps(false).slide(false));
  }

private:
  using Moves = std::vector<std::pair<Vertex_index, Point>>;

  Sculptor* sculptor_;
  Edit_journal* journal_ = nullptr;
  static constexpr std::size_t most_legs = 64; ///< of a drag, and more: room that is made for them
  std::optional<typename Sculptor::Stroke_type> stroke_;
  std::vector<Point> legs_; ///< of the last drag
  Moves moves_;             ///< of the last move_many()

  /// Each move that the Sculptor makes as long as this lives is told at its end, also where something was thrown.
  struct Telling_moves {
    Journaled_edits& edits;

    explicit Telling_moves(Journaled_edits& told) : edits(told) {
      edits.moves_.clear();
      edits.sculptor_->visitor().tell_to(&edits.moves_);
    }
    ~Telling_moves() {
      edits.sculptor_->visitor().tell_to(static_cast<Moves*>(nullptr));
      for (const auto& [v, p] : edits.moves_)
        edits.add_move(v, p);
    }
    Telling_moves(const Telling_moves&) = delete;
    Telling_moves& operator=(const Telling_moves&) = delete;
  };

  Edited edit(const Journal_entry& wanted) {
    const auto& v = wanted.vertices;
    const Point p(wanted.point[0], wanted.point[1], wanted.point[2]);
    switch (wanted.kind) {
    case Kind::undo:
      return sculptor_->undo();
    case Kind::redo:
      return sculptor_->redo();
    case Kind::insert_on_face:
      return sculptor_->insert_on_face(sculptor_->face_of(v[0], v[1], v[2]), p);
    case Kind::insert_on_edge:
      return sculptor_->insert_on_edge(sculptor_->edge_of(v[0], v[1]), p);
    case Kind::flip:
      return sculptor_->flip(sculptor_->edge_of(v[0], v[1]));
    case Kind::collapse: {
      const auto& mesh = sculptor_->mesh();
      const auto e = sculptor_->edge_of(v[0], v[1]);
      const auto h = e.is_valid() ? mesh.halfedge(e) : typename Sculptor::Halfedge_index();
      return sculptor_->collapse(!h.is_valid() || mesh.source(h) == sculptor_->vertex(v[0]) ? h : mesh.opposite(h));
    }
    default:
      return sculptor_->remove(sculptor_->vertex(v[0]));
    }
  }

  /// Which neighbour a removal has taken is said.
  void note(Journal_entry made, const Edited& edited) {
    if (made.kind == Kind::remove) {
      made.kind = Kind::collapse;
      made.vertices[1] = sculptor_->name(*edited.vertex);
    }
    add(made);
  }

  void add_move(Vertex_index v, const Point& to) {
    Journal_entry entry;
    entry.kind = Kind::move;
    entry.vertices = {sculptor_->name(v), 0, 0};
    entry.point = {to.x(), to.y(), to.z()};
    add(entry);
  }
  void add(Kind kind) {
    Journal_entry entry;
    entry.kind = kind;
    add(entry);
  }
  void add(const Journal_entry& entry) {
    if (journal_ != nullptr)
      journal_->add(entry);
  }
};

} // namespace haptic_sculpt

#endif
