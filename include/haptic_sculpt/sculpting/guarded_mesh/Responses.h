// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Ground_of_hand.h>
#include <haptic_sculpt/sculpting/response/Slide_response.h>
#include <haptic_sculpt/sculpting/response/nearest_permitted.h>

namespace haptic_sculpt::internal {

/// The one place where a result is made to say one thing: what follows from where a drag began, where it ended and
/// where it was to end is derived from these, whatever the response has written. \pre contacts, legs, stop errors and
/// `end` are as the response tells, `end` for the case that the target was not reached: a response says `held` or
/// `stuck`, not `no_progress`
///
/// Coordinates are compared as numbers: +0 and -0 are one place.
template <class Mesh>
void settle_result(const Coordinates& source, const Coordinates& target, const Coordinates& end,
                   Drag_result<Mesh>& result) {
  result.position = typename Mesh::Point(end[0], end[1], end[2]);
  if (end == source)
    result.legs = 0; // whatever was tried, or gone and come back
  const bool explains_nothing = result.end == Drag_end::held && result.contacts.empty();
  if (end == target)
    result.end = Drag_end::reached;
  else if (result.end == Drag_end::reached || explains_nothing)
    result.end = Drag_end::stuck;
  result.reached = result.end == Drag_end::reached;
  if (result.reached) {
    result.contacts.clear(); // nothing holds it
    result.stop_error = result.stop_error_along_path = 0;
    return;
  }
  if (end == source && result.end == Drag_end::leg_limit)
    result.end = Drag_end::stuck;
  if (end == source && result.end == Drag_end::stuck && result.contacts.empty())
    result.end = Drag_end::no_progress;
}

/// The responses to a blocked way behind one call, with the contacts they carry along.
template <class Mesh>
class Responses {
public:
  Responses() { permitted_.reserve(Drag_result<Mesh>::usual_contacts); }

  /// The vertex was let go: the next drag begins without contacts.
  void forget() {
    slide_.forget();
    if (other_)
      other_->forget();
  }

  /// Moves from source towards target and fills in the result. Returns where the vertex is then: no farther from the
  /// target than it was, exactly. \pre source != target, both in range
  template <class Guard>
  Coordinates move(Response response, Guard& guard, const Mesh& mesh, const Coordinates& source,
                   const Coordinates& target, const Drag_rules& rules, Drag_result<Mesh>& result) {
    Coordinates end;
    if (response == Response::slide)
      end = slide_.move(guard, source, target, rules, result);
    else if (response == Response::stop) {
      end = guard.leg(source, target, rules, result);
      result.end = guard.is_spent() ? Drag_end::work_limit : Drag_end::held;
    } else {
      make_other(response);
      leg_.contacts.clear(), leg_.legs = 0, leg_.stop_error = leg_.stop_error_along_path = 0;
      Ground_of_hand<Mesh, Guard> ground(guard, mesh, rules, leg_);
      result.end = other_->move(ground, source, target, rules.clearance);
      result.contacts = leg_.contacts;
      result.stop_error = leg_.stop_error, result.stop_error_along_path = leg_.stop_error_along_path;
      end = other_->place();
      result.legs = other_->path().legs();
    }
    settle_result(source, target, end, result);
    const Vector pull = minus(target, end);
    if (result.contacts.empty())
      result.kkt_residual = end == target ? 0 : 1;
    if (!result.contacts.empty() && length(pull) > shortest_pull(rules, end, result))
      measure_residual(pull, result);
    return end;
  }

  /// Appends the points of the last move: where it began, and the ends of its legs. \pre that was between these
  template <class Points>
  void append_path(Response response, const Coordinates& source, const Coordinates& end, Points& points) const {
    const auto append = [&points](const Coordinates& p) { points.emplace_back(p[0], p[1], p[2]); };
    if (response == Response::stop) {
      append(source);
      if (end != source)
        append(end);
      return;
    }
    const Slide_path& path = response == Response::slide ? slide_.path() : other_->path();
    for (int i = 0; i <= path.legs(); ++i)
      append(path.point(i));
  }

private:
  Slide_response<Mesh> slide_;
  std::unique_ptr<Other_walk> other_; ///< none until a response that is neither slide nor stop is asked for
  Response other_response_ = Response::stop; ///< whose that is
  Drag_result<Mesh> leg_;                    ///< its last leg; kept to allocate no more
  std::vector<Half_space> permitted_; ///< by the contacts; kept to allocate no more

  void make_other(Response response) {
    if (other_response_ == response)
      return;
    other_ = response.kind_->make_walk();
    other_response_ = response;
  }

  static double shortest_pull(const Drag_rules& rules, const Coordinates& end, const Drag_result<Mesh>& result) {
    double reach = largest_magnitude(end);
    for (const Contact_3<Mesh>& contact : result.contacts)
      reach = std::fmax(reach, largest_coordinate_of(contact));
    return Slide_lengths{rules.clearance.at(reach), 0}.shortest_pull();
  }

  void measure_residual(const Vector& pull, Drag_result<Mesh>& result) {
    permitted_.clear();
    for (const Contact_3<Mesh>& contact : result.contacts)
      permitted_.push_back({coordinates(contact.normal), 0});
    result.kkt_residual = kkt_residual(pull, permitted_);
  }
};

} // namespace haptic_sculpt::internal
