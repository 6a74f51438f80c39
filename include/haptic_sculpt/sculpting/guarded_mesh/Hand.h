// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_parameters.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Responses.h>
#include <haptic_sculpt/sculpting/motion/Guarded_star.h>

#include <CGAL/exceptions.h>

namespace haptic_sculpt::internal {

/// The vertex that is being dragged: its guarded star, the contacts it carries along, and when the mesh about it is
/// compared with how it was left.
template <class Mesh, class Broad_phase, class Traits>
class Hand {
public:
  using Vertex_index = typename Mesh::Vertex_index;

  Hand(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners, const Traits& traits,
       Mesh_watch<Mesh>& watch)
    : mesh_(&mesh), broad_phase_(&broad_phase), corners_(&corners), watch_(&watch)
    , guard_(mesh, broad_phase, corners, traits, Fetch_watched{&watch}) {}

  void reserve(std::size_t valence, std::size_t faces) { guard_.reserve(valence, faces); }

  /// Whether v is held and ready to be dragged on; its place is compared then. \throw Mesh_changed
  /// \param once see Drag_parameters
  bool holds(Vertex_index v, bool once) const {
    watch_->check_counts();
    if (held_ != v || !is_ready_ || (is_held_once_ && !once))
      return false;
    watch_->check(v);
    return true;
  }

  /// Takes another vertex, having let go of the last. \param meanwhile is called while memory is waited for
  /// \throw Mesh_changed
  template <class Meanwhile>
  void take(Vertex_index v, bool once, const Meanwhile& meanwhile) {
    prefetch(&mesh_->point(v), sizeof(typename Mesh::Point));
    watch_->prefetch(v);
    release();
    expect_one_motion(once);
    if (!once) {
      meanwhile();
      watch_->check_some();
    }
    guard_.collect(v);
    watch_->check(v);
    for (const Vertex_index neighbour : guard_.star().link)
      watch_->check(neighbour);
    held_ = v;
    is_ready_ = true;
  }

  /// Takes a point that is no vertex.
  void take_point() {
    release();
    expect_one_motion(false);
    guard_.star().clear();
    guard_.invalidate();
    is_ready_ = true;
  }
  /// Whether what was looked up may be used on.
  bool is_ready() const { return is_ready_; }

  /// Lets go, if anything is held. The next drag begins without contacts.
  void release() {
    tell_where_it_is();
    held_ = Vertex_index();
    responses_.forget();
  }

  /// The same where nothing may throw: asks nobody. Whatever comes next lets go first, or tells where the vertex is.
  void let_go() noexcept { is_ready_ = false; }

  /// Tells the broad phase where the vertex has come to: it may be asked by others then. \throw Mesh_changed
  void tell_where_it_is() {
    if (held_.is_valid() && has_moved_) {
      watch_->check_counts(); // its faces may be no more
      broad_phase_->faces_moved(guard_.star().faces);
    }
    has_moved_ = false;
  }

  /// Goes from source towards target as the response tells; the mesh is not written. \pre source != target
  Coordinates move(const Coordinates& source, const Coordinates& target, const Drag_parameters& parameters,
                   double delta, Drag_result<Mesh>& result) {
    const bool is_as_before =
        last_response_ == parameters.response_rule && last_clearance_ == parameters.clearance_length;
    if (!is_as_before) // what was found was found by other rules
      responses_.forget();
    last_response_ = parameters.response_rule;
    last_clearance_ = parameters.clearance_length;
    begin_to_decide(parameters.work_limit_pairs);
    const Drag_rules rules = {Clearance_rule(parameters.clearance_length), delta};
    const Coordinates end = decided(
        [&] { return responses_.move(parameters.response_rule, guard_, *mesh_, source, target, rules, result); });
    result.work = guard_.work().done();
    return end;
  }

  /// Writes where the last move was after each leg, the start first.
  template <class Point>
  void write_path(const Coordinates& source, const Coordinates& end, std::vector<Point>& path) const {
    path.clear();
    if (source == end)
      path.emplace_back(source[0], source[1], source[2]);
    else
      responses_.append_path(last_response_, source, end, path);
  }

  /// Whether the straight way is free, and that has been decided within the bound on the work.
  bool is_free(const Coordinates& source, const Coordinates& target, const Drag_parameters& parameters, double delta) {
    begin_to_decide(parameters.work_limit_pairs);
    return decided([&] { return guard_.is_free(source, target, delta); });
  }

  auto first_impact(const Coordinates& source, const Coordinates& target) {
    begin_to_decide(std::nullopt);
    return decided([&] { return guard_.decide(source, target, 0).first_impact(); });
  }

  /// The mesh has been written: v has moved.
  void note_moved() { has_moved_ = true; }

  /// Compares candidates with where they were left: all where they have just been looked up, else some of them in turn.
  /// To be called when a motion has been decided. \throw Mesh_changed, and what was looked up is not used any more.
  void check_candidates() {
    compare_candidates();
    is_ready_ = true;
  }

private:
  /// Asks for the watch's copy of what will be read.
  struct Fetch_watched {
    const Mesh_watch<Mesh>* watch;
    void operator()(Vertex_index v) const { watch->prefetch(v); }
  };

  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  const Face_corners<Mesh>* corners_;
  Mesh_watch<Mesh>* watch_;
  Guarded_star<Mesh, Broad_phase, Traits, Fetch_watched> guard_;
  Responses<Mesh> responses_;
  Vertex_index held_;      ///< whose star guard_ has; invalid when none
  bool is_held_once_ = false; ///< taken for one drag
  Response last_response_ = Response::slide;
  std::optional<double> last_clearance_;
  /// Whether what was looked up about the held vertex is whole: not while a motion is decided, nor where an exception
  /// has ended that.
  bool is_ready_ = false;
  bool has_moved_ = false; ///< the broad phase has not been told yet where the held star is
  std::size_t compared_look_ = 0, next_compared_ = 0;

  /// This many candidates are compared at every drag; a list that holds for long is seen whole soon.
  static constexpr std::size_t candidates_per_drag = 4;

  void expect_one_motion(bool on) {
    guard_.expect_one_motion(on);
    is_held_once_ = on;
  }

  void begin_to_decide(const std::optional<std::size_t>& work_limit) {
    guard_.work().begin(work_limit.value_or(Work::unbounded));
    is_ready_ = false;
  }

  /// \throw Mesh_changed for a precondition of the kernels: what others have made infinite or no number
  template <class Decide>
  auto decided(const Decide& decide) const {
    try {
      return decide();
    } catch (const CGAL::Precondition_exception&) {
      compare_all();
      throw;
    }
  }

  void compare_all() const {
    for (const auto& candidate : guard_.candidate_list().vertices())
      watch_->check(candidate.index);
    watch_->check_faces(*corners_, guard_.star().faces);
  }

  void compare_candidates() {
    if (is_held_once_) { // whatever else is near is the vertex or a neighbour at another drag
      watch_->check_faces(*corners_, guard_.star().faces);
      return;
    }
    const auto& candidates = guard_.candidate_list().vertices();
    if (compared_look_ != guard_.looks()) {
      compared_look_ = guard_.looks();
      compare_all();
      return;
    }
    for (std::size_t left = std::min(candidates.size(), candidates_per_drag); left != 0; --left) {
      next_compared_ = next_compared_ + 1 < candidates.size() ? next_compared_ + 1 : 0;
      watch_->check(candidates[next_compared_].index);
    }
  }
};

} // namespace haptic_sculpt::internal
