// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SLIDE_WALK_H
#define HAPTIC_SCULPT_SCULPTING_SLIDE_WALK_H

#include <haptic_sculpt/sculpting/contact/Facet.h>
#include <haptic_sculpt/sculpting/motion/stop.h>
#include <haptic_sculpt/sculpting/response/Slide_lengths.h>
#include <haptic_sculpt/sculpting/response/Slide_path.h>
#include <haptic_sculpt/sculpting/response/nearest_permitted.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <optional>

namespace haptic_sculpt {
namespace internal {

/// How a walk ended.
enum class Walk_end : std::uint8_t {
  reached, ///< at the target
  settled, ///< at the point nearest to the target that the contacts permit
  stuck,   ///< no representable point on the way there is free
  spent,   ///< as much work as the drag may do
  limit    ///< as many legs as permitted
};

/// A vertex under way, with its contacts: goes in legs, each proven free, to the point nearest to the target that the
/// contacts permit; finds contacts on the way and loses others (doc/slide.md). Plain data: copied to try a way out.
///
/// \tparam Guard decides motions exactly: Guarded_star
template <class Mesh>
struct Slide_walk {
  /// More contacts than this at once are not carried; whoever matters is met again.
  static constexpr std::size_t most_facets = 32;
  /// Bounds the turns in which no leg is made: each of them learns of a contact or forgets one.
  static constexpr int most_turns = 128;
  /// How often a place near a new contact is sought with growing clearance, and how often at all, as each may meet yet
  /// another contact, before the vertex steps back along its path.
  static constexpr int approaches = 6, most_tries = 24;

  /// So often contacts are forgotten, because J is past them, where it rests or comes no nearer: what is met again
  /// after that is kept, for it is met on the way to the target, far from where J is.
  static constexpr int most_rests = 2;
  /// So many times in a row an approach in a narrow gap may bring less than half as near as the one before: a gap that
  /// closes.
  static constexpr int most_shrinking = 6;

  /// After so many legs none is made that is short and only takes J off a contact just met: the next one, farther, does
  /// that as well.
  static constexpr int legs_before_thrift = 8;

  /// One unit in the last place of a unit vector, and how much alike two normals are that differ by rounding alone.
  static constexpr double rounding_of_normals = 0x1p-52, alike = 2 * rounding_of_normals;

  using Facets = boost::container::static_vector<Facet<Mesh>, most_facets>;
  using Half_spaces = boost::container::static_vector<Half_space, most_facets>;

  Vector x{};
  Facets facets;
  Slide_path path; ///< made so far, ends at x

  int legs() const { return path.legs(); }
  /// Where J is now.
  const Slide_lengths& lengths() const { return lengths_; }
  const Drag_rules& rules() const { return rules_; }
  double delta() const { return rules_.delta; }

  /// Walks until it ends, or `most_legs` have been made.
  template <class Guard>
  Walk_end go(Guard& guard, const Vector& target, int most_legs) {
    leave_what_is_past(lengths_.resolution);
    for (int turn = 0; turn < most_turns; ++turn) {
      const Vector pull = pull_to(target);
      const bool is_nearer = !nearest_so_far_ || nearer_by(target, *nearest_so_far_, x) > lengths_.clearance;
      if (is_nearer) {
        nearest_so_far_ = x;
        rests_ = 0;
      }
      const Nearest_permitted way = nearest(pull, 1);
      const bool is_to_target = way.exists && way.number_active == 0, is_far = is_to_target && is_beyond_reach(target);
      Vector y = is_to_target && !is_far ? target : place_at(way.displacement);
      if (y == target && x == target)
        return Walk_end::reached;
      if (!way.exists || y == x || (!is_to_target && length(way.displacement) <= lengths_.settled())) {
        if (rests_ >= most_rests)
          return Walk_end::settled;
        ++rests_;
        if (!leave_what_is_past(lengths_.clearance))
          return Walk_end::settled;
        continue;
      }
      if (legs() >= most_legs)
        return Walk_end::limit;
      auto decision = guard.decide(x, y, rules_.delta);
      if (is_far && decision.is_free()) { // what is near has been decided, by numbers of about one size
        y = target;
        decision = guard.decide(x, y, rules_.delta);
      }
      if (!decision.is_free()) {
        if (guard.is_spent())
          return Walk_end::spent;
        const int legs_before = legs();
        const Vector before = x;
        if (!approach(guard, decision, y, target))
          return guard.is_spent() ? Walk_end::spent : Walk_end::stuck;
        if (legs() == legs_before)
          continue;
        // What is past is kept: over a flat groove a new contact is met c / tan(angle) behind the border of the last
        // one.
        forget_what_is_over();
        const double gain = nearer_by(target, before, x);
        shrinking_ = way.is_squeezed && gain < last_gain_ / 2 ? shrinking_ + 1 : 0;
        last_gain_ = gain;
        if (shrinking_ >= most_shrinking)
          return Walk_end::stuck;
        continue;
      }
      // Where the faces round a vertex are one plane but for rounding, J would otherwise leave each of them for the
      // next.
      const bool is_short = largest_magnitude(minus(y, x)) <= lengths_.border();
      step_to(y);
      if (is_to_target)
        return Walk_end::reached;
      if (is_short || rests_ >= most_rests)
        forget_what_is_over();
      else if (leave_what_is_past(lengths_.resolution) && !is_nearer)
        ++rests_; // to and fro over an edge
    }
    return legs() >= most_legs ? Walk_end::limit : Walk_end::stuck;
  }

  /// From x towards the target, no longer than is of use.
  Vector pull_to(const Vector& target) const {
    const Vector pull = minus(target, x);
    const double distance = length(pull), most = lengths_.farthest_pull();
    return distance > most ? scaled(pull, most / distance) : pull;
  }

  bool is_beyond_reach(const Vector& target) const { return length(minus(target, x)) > lengths_.farthest_pull(); }

  /// x and a displacement. What is less than the last bits of all else here is noise, which exact decisions would pay for.
  Vector place_at(const Vector& displacement) const {
    Vector place = plus(x, displacement);
    for (double& coordinate : place)
      coordinate = std::abs(coordinate) < lengths_.noise() ? 0 : coordinate;
    return place;
  }

  /// Where the contacts let J go from x, when it wants to go by `pull`, keeping so many clearances from each; in a gap
  /// too narrow for that, or too acute, a half or a quarter of it, and at last coming no nearer to any than it is.
  Nearest_permitted nearest(const Vector& pull, double clearances) const {
    const double distance = length(pull);
    Nearest_permitted found;
    for (const double share : {1.0, 0.5, 0.25}) {
      found = nearest_among(pull, distance, [&](const Facet<Mesh>& f) { return share * clearances * f.clearance() - f.height(); });
      found.is_squeezed = share < 1;
      if (found.exists &&
          (found.number_active < 2 || length(minus(pull, found.displacement)) <= distance + lengths_.retreat()))
        return found;
    }
    found = nearest_among(pull, distance, [&](const Facet<Mesh>& f) {
      return std::fmin(0.25 * clearances * f.clearance() - f.height(), 0.0);
    });
    found.is_squeezed = true;
    return found;
  }

  /// Whether two normals differ by rounding alone.
  static bool is_alike(const Vector& a, const Vector& b) {
    return std::abs(a[0] - b[0]) <= alike && std::abs(a[1] - b[1]) <= alike && std::abs(a[2] - b[2]) <= alike;
  }

  /// Makes a leg. \pre it is free, and legs() < Slide_path::most_legs
  void step_to(const Vector& place_reached) {
    place(place_reached);
    path.add(place_reached);
  }

  /// Goes to where another walk is, without its contacts.
  void begin_at(const Slide_walk& other) {
    facets.clear();
    path = other.path;
    rules_ = other.rules_;
    place(other.x);
  }

  /// J is at x; contacts are measured from there.
  void place(const Vector& place) {
    x = place;
    for (Facet<Mesh>& f : facets)
      f.measure(x, rules_);
    find_lengths();
  }

  /// Of length 1, over all contacts; zero where they cancel.
  Vector mean_normal() const {
    Vector sum{};
    for (const auto& facet : facets)
      sum = plus(sum, facet.normal());
    return normalized(sum);
  }

  bool knows(const Contact_3<Mesh>& contact) const {
    for (const Facet<Mesh>& f : facets)
      if (f.is_of(contact))
        return true;
    return false;
  }

  /// Whether it was new.
  bool meet(const Contact_3<Mesh>& contact, const Vector& where) {
    if (knows(contact))
      return false;
    if (facets.size() == most_facets) // the one J is farthest out of makes room
      facets.erase(std::max_element(facets.begin(), facets.end(), [this](const Facet<Mesh>& a, const Facet<Mesh>& b) {
        return a.outside(x) < b.outside(x);
      }));
    facets.emplace_back(contact, where);
    if (has_left(contact))
      facets.back().hold_on();
    facets.back().measure(x, rules_);
    find_lengths();
    return true;
  }

  /// J rests: takes in all the faces that come first in a motion from x. Returns whether there were any new ones.
  template <class Decision>
  bool meet_faces(const Decision& decision) {
    boost::container::static_vector<Contact_3<Mesh>, most_facets> met;
    decision.for_each_first_contact([&](const Contact_3<Mesh>& contact, double) {
      const bool is_face = contact.kind == Contact_kind::vertex_face && !contact.is_flat;
      if (is_face && met.size() < met.capacity() && !knows(contact))
        met.push_back(contact);
    });
    for (const Contact_3<Mesh>& contact : met)
      meet(contact, x);
    return !met.empty();
  }

  /// J rests: edges and faces of the star may hold it, because they were left and met again, where it is not over their
  /// facets. Lets them go, for by now more is known. Returns whether there were any.
  bool let_go() {
    return forget([&](const Facet<Mesh>& f) {
      return f.contact().kind != Contact_kind::vertex_face && f.is_past(x, lengths_.resolution);
    });
  }

  template <class Predicate>
  bool forget(const Predicate& is_over) {
    const auto kept = std::remove_if(facets.begin(), facets.end(), is_over);
    const bool any = kept != facets.end();
    facets.erase(kept, facets.end());
    find_lengths();
    return any;
  }

  /// A new drag begins: what was left in the last one may be met and left again.
  void begin(const Vector& source, const Drag_rules& rules) {
    rules_ = rules;
    path = Slide_path(source);
    forget_what_was_left();
    forget_progress();
    place(source);
  }

  /// Takes all legs back.
  void return_to(const Vector& source) {
    path = Slide_path(source);
    place(source);
  }

  void forget_what_was_left() { left_.clear(); }

  /// Another target, or another way to it.
  void forget_progress() {
    nearest_so_far_.reset();
    last_gain_ = 0;
    rests_ = shrinking_ = 0;
  }

private:
  /// Round a corner that is flat to within some clearances J would leave and meet the same contacts again and again.
  void forget_what_is_over() {
    const double clearances =
        rests_ < most_rests ? Slide_lengths::clearances_of_lift : Slide_lengths::clearances_of_retreat;
    forget([clearances](const Facet<Mesh>& f) { return f.is_over(clearances); });
  }

  void find_lengths() {
    double reach = largest_magnitude(x);
    for (const Facet<Mesh>& f : facets)
      reach = std::fmax(reach, f.largest_coordinate());
    lengths_ = {rules_.clearance.at(reach), unit_in_the_last_place(reach)};
  }

  /// As nearest(), with `least(facet)` the height above where it is now that J has to have over each. Normals that differ
  /// by rounding alone count as one.
  template <class Least>
  Nearest_permitted nearest_among(const Vector& pull, double distance, const Least& least) const {
    const double slack = lengths_.resolution, slack_there = slack + rounding_of_normals * distance;
    Half_spaces spaces;
    boost::container::static_vector<std::size_t, most_facets> facet_of;
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const Half_space space = {facets[i].normal(), least(facets[i])};
      const auto same = std::find_if(spaces.begin(), spaces.end(),
                                     [&](const Half_space& other) { return is_alike(other.normal, space.normal); });
      if (same == spaces.end()) {
        spaces.push_back(space);
        facet_of.push_back(i);
      } else
        same->least = std::fmax(same->least, space.least);
    }
    Nearest_permitted found = nearest_permitted(pull, spaces, slack, slack_there);
    for (int i = 0; i < found.number_active; ++i)
      found.active[i] = facet_of[found.active[i]];
    return found;
  }

  boost::container::static_vector<Contact_3<Mesh>, most_facets> left_; ///< contacts gone past in this drag
  Drag_rules rules_;
  Slide_lengths lengths_{};
  std::optional<Vector> nearest_so_far_;                               ///< to the target
  double last_gain_ = 0;                                               ///< of the last approach
  int rests_ = 0, shrinking_ = 0;

  bool has_left(const Contact_3<Mesh>& contact) const {
    return std::any_of(left_.begin(), left_.end(),
                       [&](const Contact_3<Mesh>& before) { return Facet<Mesh>::is_same(before, contact); });
  }

  /// \param beside how far past a face: at rest within a clearance of a seam it makes no difference which of two holds
  /// J
  bool leave_what_is_past(double beside) {
    return forget([&](const Facet<Mesh>& f) {
      if (f.is_over(Slide_lengths::clearances_of_lift))
        return true;
      const double past = f.contact().kind == Contact_kind::vertex_face ? beside : lengths_.resolution;
      if (!f.is_left(x, past, lengths_.border()))
        return false;
      if (left_.size() < left_.capacity())
        left_.push_back(f.contact());
      return true;
    });
  }

  /// Takes in the steepest of the contacts that come first in the motion decided, from x to y, and are not known yet: of several features that meet in one point some are no obstacle, and whichever is will be met next. Returns
  /// the fraction of the way.
  template <class Decision>
  double meet_first(const Decision& decision, const Vector& y, double& steepest, bool& is_new) {
    std::optional<Contact_3<Mesh>> best;
    double best_sine = -1;
    const double time = decision.for_each_first_contact([&](const Contact_3<Mesh>& contact, double sine) {
      steepest = std::fmax(steepest, sine);
      // A flat impact has the sine 0: it counts where there is no other.
      if (sine > best_sine && !knows(contact)) {
        best = contact;
        best_sine = sine;
      }
    });
    is_new = best && meet(*best, point_of_path(x, y, time));
    return time;
  }

  /// The way from x to y has just been found blocked: goes to the free point nearest to the impact that is c off all
  /// contacts, the new one included. Returns whether anything was gained, in place or in knowledge.
  template <class Guard, class Decision>
  bool approach(Guard& guard, const Decision& blocked, const Vector& y, const Vector& target) {
    double steepest = 0;
    bool any_new = false;
    const double time = meet_first(blocked, y, steepest, any_new);
    const Vector to_impact = scaled(minus(y, x), time);
    bool met = any_new;
    double clearances = 1;
    int tries = 0;
    for (int attempt = 0; attempt < approaches && tries < most_tries; ++tries) {
      const Nearest_permitted near = nearest(to_impact, clearances);
      const Vector z = place_at(near.displacement);
      if (!near.exists || z == x || -nearer_by(target, x, z) > lengths_.retreat())
        break;
      const auto decision = guard.decide(x, z, rules_.delta);
      if (decision.is_free()) {
        const bool is_short = largest_magnitude(minus(z, x)) <= lengths_.border();
        if (!(met && is_short && legs() >= legs_before_thrift && facets.size() < most_facets))
          step_to(z);
        return true;
      }
      bool new_here = false;
      meet_first(decision, z, steepest, new_here);
      met = met || new_here;
      if (new_here)
        continue;
      clearances *= 2;
      ++attempt;
    }
    if (met && facets.size() < most_facets)
      return true;
    // In a gap that closes slowly a whole clearance is not to be had; half the way then is.
    const double back = std::fmin(setback(lengths_.clearance, steepest), time * path_length(x, y) / 2);
    const Vector z = stop_before(x, y, time, back, [&](const Vector& q) { return guard.is_free(x, q, rules_.delta); });
    if (z == x)
      return false;
    step_to(z);
    return true;
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
