// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <algorithm>
#include <optional>

namespace haptic_sculpt {

/// What a tool does to the mesh: edits, drags of vertices and strokes, each told to a journal, if there is one.
///
/// It takes the place of a Sculptor in functions that change many elements: move_vertices() without drags,
/// apply_brush(), move_rigidly(), isotropic_remeshing().
///
/// What a visitor throws leaves an edit that stands, maybe in part, and nobody can say how: the journal breaks off,
/// except by shifts of many vertices at once, which it has unless the Sculptor has ended (Unfinished_change).
///
/// \tparam Journal has `add(const Edit&)`, which is called once the edit stands, and `break_off()`; they throw nothing
template <class Sculptor, class Journal = Edit_journal>
class Journaled_edits {
public:
  using Mesh_type = typename Sculptor::Mesh_type;           ///< of the surface
  using Vertex_index = typename Sculptor::Vertex_index;     ///< of the mesh
  using Edge_index = typename Sculptor::Edge_index;         ///< of the mesh
  using Halfedge_index = typename Sculptor::Halfedge_index; ///< of the mesh
  using Face_index = typename Sculptor::Face_index;         ///< of the mesh
  using Point = typename Sculptor::Point;                   ///< in the scene
  using Grab_type = typename Sculptor::Grab_type;           ///< what holds a vertex
  using Edited = Applied<Mesh_type>;                        ///< what an edit gives
  using Result = typename Sculptor::Result;                 ///< what a drag gives

  /// Without a journal
  explicit Journaled_edits(Sculptor& sculptor) : sculptor_(&sculptor), guarded_(*this) { legs_.reserve(most_legs); }
  Journaled_edits(const Journaled_edits&) = delete;
  Journaled_edits& operator=(const Journaled_edits&) = delete;

  /// From here on in another scene, without a journal. \pre no stroke is under way
  void enter(Sculptor& sculptor) { sculptor_ = &sculptor, journal_ = nullptr; }
  void keep_journal(Journal* journal) { journal_ = journal; } ///< nullptr: none
  Journal* journal() const { return journal_; }               ///< that is kept now

  /// What follows is one step of undo; the stroke under way ends. \throw Reentrant_call, and nothing has changed
  void begin_stroke() {
    check_nobody_asks();
    end_stroke();
    stroke_.emplace(sculptor_->stroke());
    add(Edit::of(Edit_kind::stroke));
  }
  /// Of the stroke under way, if there is one. \pre not is_asked()
  void end_stroke() {
    if (stroke_)
      add(Edit::of(Edit_kind::end));
    stroke_.reset();
  }
  /// Whether a function of the caller's runs now, in the middle of a call: then no stroke may begin or end.
  bool is_asked() const { return internal::Sculptor_access::guarded(*sculptor_).is_asking(); }
  /// \throw Reentrant_call where that is so
  void check_nobody_asks() const {
    if (is_asked())
      throw Reentrant_call();
  }

  /// \pre it is no stroke and no end
  Edited make(const Edit& wanted) {
    auto made = attempt(wanted);
    tell(made.edit); // also one that is refused, and has ended a stroke
    return made;
  }
  /// Makes an edit and begins a stroke with it; the one under way ends. Where it is refused, or throws, there is none.
  Edited make_in_stroke(const Edit& wanted) {
    check_nobody_asks();
    end_stroke();
    std::optional<typename Sculptor::Stroke_type> begun(sculptor_->stroke());
    auto made = attempt(wanted);
    if (made) {
      stroke_.emplace(std::move(*begun));
      add(Edit::of(Edit_kind::stroke));
      tell(made.edit);
    }
    return made;
  }

  /// A drag of a vertex of the surface; its legs are reported. \throw what drags throw
  Result drag(Grab_type& grab, const Point& target, const std::optional<Drag_parameters>& parameters) {
    const internal::Rounding_to_nearest rounding; // points that differ by a subnormal number differ
    const Vertex_index v = grab.vertex(); // a visitor may move the Grab elsewhere, or drag by it once more
    struct Borrowed { // with its room
      std::vector<Point>& from;
      std::vector<Point> legs = std::move(from);
      ~Borrowed() { from = std::move(legs); }
    } borrowed{legs_};
    std::vector<Point>& legs = borrowed.legs;
    const auto result = or_break_off([&] { return grab.drag_to(target, legs, parameters); });
    if (!legs.empty()) // a place twice in a row, and +0 beside -0, is no leg
      legs.erase(std::unique(legs.begin(), legs.end()), legs.end());
    in_one_step(legs.size() > 2, [&] {
      for (std::size_t k = 1; k < legs.size(); ++k)
        add_move(v, legs[k]);
    });
    return result;
  }

  /// \name What functions ask of a Sculptor, and as it does
  /// \pre elements are in the mesh
  ///@{
  const Mesh_type& mesh() const { return sculptor_->mesh(); }                       ///< that is guarded
  const Sculptor_parameters& parameters() const { return sculptor_->parameters(); } ///< of the Sculptor
  void check_unchanged() const { sculptor_->check_unchanged(); }                    ///< \throw Mesh_changed
  /// Of the surface. \throw as there
  Vertex_index nearest_vertex(const Point& p, double within) { return sculptor_->nearest_vertex(p, within); }
  bool is_inside_out(Vertex_index v) const { return sculptor_->is_inside_out(v); } ///< the component of v
  /// A creation.
  Edited insert_on_edge(Edge_index e, const Point& p) {
    return make(of_ends(Edit_kind::insert_on_edge, mesh().halfedge(e), {p.x(), p.y(), p.z()}));
  }
  /// Draws the source into the target.
  Edited collapse(Halfedge_index h) { return make(of_ends(Edit_kind::collapse, h)); }
  /// Of an edge.
  Edited flip(Edge_index e) { return make(of_ends(Edit_kind::flip, mesh().halfedge(e))); }
  /// All of the way or none.
  bool move_if_free(Vertex_index v, const Point& target, const std::optional<Drag_parameters>& drag = std::nullopt) {
    const internal::Rounding_to_nearest rounding;
    const Point before = mesh().point(v);
    const bool is_there = or_break_off([&] { return sculptor_->move_if_free(v, target, drag); });
    if (mesh().point(v) != before)
      add_move(v, target);
    return is_there;
  }
  /// One drag of a vertex; its legs are reported.
  Result drag(Vertex_index v, const Point& target, const std::optional<Drag_parameters>& drag = std::nullopt) {
    auto grab = sculptor_->grab(v);
    return this->drag(grab, target, drag);
  }

  /// Ends what it began.
  class [[nodiscard]] Stroke_type {
  public:
    explicit Stroke_type(Journaled_edits* edits) : edits_(edits) {} ///< nullptr: it has joined another one
    ~Stroke_type() {
      if (edits_ != nullptr)
        edits_->end_stroke();
    }
    Stroke_type(const Stroke_type&) = delete;
    Stroke_type& operator=(const Stroke_type&) = delete;

  private:
    Journaled_edits* edits_;
  };
  /// Joins the one under way, or begins one.
  Stroke_type stroke() {
    if (is_in_stroke())
      return Stroke_type(nullptr);
    begin_stroke();
    return Stroke_type(this);
  }
  ///@}

private:
  /// \cond
  /// What a Sculptor guards, for functions that shift many vertices at once.
  class Guarded {
  public:
    explicit Guarded(Journaled_edits& edits) : edits_(&edits) {}
    const Mesh_type& mesh() const { return edits_->mesh(); }
    void look_around(const internal::Vertex_targets<Mesh_type>& targets) { guarded().look_around(targets); }
    bool shift(int axis, const internal::Axis_ways<Mesh_type>& ways, std::size_t most_held, const Part_runner& run,
               internal::Pair_budget* pairs = nullptr) {
      return told(axis, ways, [&] { return guarded().shift(axis, ways, most_held, run, pairs); });
    }
    void begin_trial() {
      guarded().begin_trial();
      is_trial_ = true;
    }
    void end_trial() noexcept {
      is_trial_ = false;
      for (const Edit& edit : tried_)
        edits_->add(edit);
      tried_.clear();
      guarded().end_trial();
    }
    std::size_t tried_shifts() { return guarded().tried_shifts(); }
    void take_back_tried_shift(const Part_runner& run) {
      const auto forget = [this] { tried_.erase(tried_.begin() + tried_shifts(), tried_.end()); };
      try {
        guarded().take_back_tried_shift(run);
      } catch (...) { // the visitor's, when all has moved
        forget();
        throw;
      }
      forget();
    }
    void tell_visitor(bool does) { guarded().tell_visitor(does); }
    auto asking() { return guarded().asking(); }
    auto& axis_move() { return guarded().axis_move(); }
    void check_clearance_serves() { guarded().check_clearance_serves(); }
    const auto& obstacles_to(int axis, const internal::Axis_ways<Mesh_type>& ways, const Part_runner& run,
                             internal::Pair_budget* pairs = nullptr) {
      return guarded().obstacles_to(axis, ways, run, pairs);
    }

  private:
    Journaled_edits* edits_;
    bool is_trial_ = false;
    std::vector<Edit> tried_; ///< shifts for the journal at the end, if they stand

    auto& guarded() { return internal::Sculptor_access::guarded(*edits_->sculptor_); }
    template <class Move>
    bool told(int axis, const internal::Axis_ways<Mesh_type>& ways, const Move& move) {
      std::vector<double> before;
      for (const auto& [v, end] : ways)
        before.push_back(vertex_coordinates(mesh(), v)[axis]);
      Edit made = Edit::of(Edit_kind::shift);
      made.axis = axis;
      made.ways.reserve(ways.size()); // what is done has to be in the journal
      tried_.reserve(tried_.size() + 1);
      try {
        const bool is_done = move();
        tell_shift(ways, before, made);
        return is_done;
      } catch (...) { // the visitor's, when all has moved
        if (guarded().is_whole())
          tell_shift(ways, before, made);
        else if (edits_->journal_ != nullptr) // of a Sculptor that has ended vertices have no numbers
          edits_->journal_->break_off();
        throw;
      }
    }
    void tell_shift(const internal::Axis_ways<Mesh_type>& ways, const std::vector<double>& before, Edit& made) {
      const int axis = made.axis;
      for (std::size_t k = 0; k < ways.size(); ++k)
        if (const double now = vertex_coordinates(mesh(), ways[k].first)[axis]; now != before[k])
          made.ways.emplace_back(edits_->sculptor_->id(ways[k].first), now);
      if (made.ways.empty())
        return;
      if (is_trial_)
        tried_.push_back(std::move(made));
      else
        edits_->add(made);
    }
  };
  /// \endcond
  friend struct internal::Sculptor_access;

  Sculptor* sculptor_;
  Guarded guarded_;
  Journal* journal_ = nullptr;
  static constexpr std::size_t most_legs = 64; ///< of a drag, and more: room that is made for them
  std::optional<typename Sculptor::Stroke_type> stroke_;
  std::vector<Point> legs_; ///< of the last drag

  /// Where the function throws, and the mesh has been written.
  template <class Function>
  auto or_break_off(const Function& function) {
    const auto& guarded = internal::Sculptor_access::guarded(*sculptor_);
    const std::uint64_t before = guarded.changes();
    try {
      return function();
    } catch (...) {
      if (journal_ != nullptr && guarded.changes() != before)
        journal_->break_off();
      throw;
    }
  }
  Edited attempt(const Edit& wanted) {
    return or_break_off([&] { return sculptor_->apply(wanted); });
  }

  Edit of_ends(Edit_kind kind, Halfedge_index h, const std::array<double, 3>& p = {}) const {
    return Edit::of(kind, {sculptor_->id(mesh().source(h)), sculptor_->id(mesh().target(h)), 0}, p);
  }
  void add_move(Vertex_index v, const Point& to) {
    add(Edit::of(Edit_kind::move, {sculptor_->id(v), 0, 0}, {to.x(), to.y(), to.z()}));
  }
  /// A slide as its legs, each a move of its own; of what has changed nothing, nothing.
  void tell(const Edit& made) {
    if (made.kind == Edit_kind::none)
      return;
    if (made.kind != Edit_kind::move)
      return add(made);
    in_one_step(!made.legs.empty(), [&] {
      for (const auto& leg : made.legs)
        add(Edit::of(Edit_kind::move, made.vertices, leg));
      add(Edit::of(Edit_kind::move, made.vertices, made.point));
    });
  }
  bool is_in_stroke() const { return stroke_ && stroke_->is_open(); } ///< an undo ends it
  /// What the function adds is one step of undo, as it was when it was made.
  template <class Function>
  void in_one_step(bool is_several, const Function& function) {
    const bool is_step = is_several && !is_in_stroke();
    if (is_step)
      add(Edit::of(Edit_kind::stroke));
    function();
    if (is_step)
      add(Edit::of(Edit_kind::end));
  }
  void add(const Edit& edit) {
    if (journal_ != nullptr)
      journal_->add(edit);
  }
};

} // namespace haptic_sculpt
