// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/contact/Facet.h>
#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/geometry/stop.h>
#include <haptic_sculpt/sculpting/response/nearest_permitted.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace haptic_sculpt::internal {

/// Where a vertex J is, and the facets of its contacts, measured from there: which of them are known, where they let J
/// go, and which it has left (doc/proofs/slide.md).
template <class Mesh>
class Slide_contacts {
public:
  /// More contacts than this at once are not carried; whoever matters is met again.
  static constexpr std::size_t most_facets = 32;
  /// One unit in the last place of a unit vector, and how much alike two normals are that differ by rounding alone.
  static constexpr double rounding_of_normals = 0x1p-52, alike = 2 * rounding_of_normals;

  /// Two faces form a convex edge, round which a way may lead, where one falls off from the other's plane by more than
  /// this: a smaller angle, of 1e-12 radians, is none that a clearance or a rounded normal can tell from a seam.
  static constexpr double least_slope = 0x1p-40;

  using Facets = boost::container::static_vector<Facet<Mesh>, most_facets>;
  using Half_spaces = boost::container::static_vector<Half_space, most_facets>;

  Vector x{};
  Facets facets;

  /// Where J is now.
  const Slide_lengths& lengths() const { return lengths_; }
  const Drag_rules& rules() const { return rules_; }
  double delta() const { return rules_.delta; }

  /// From x towards the target, no longer than is of use.
  Vector pull_to(const Vector& target) const {
    const Vector pull = minus(target, x);
    const double distance = length(pull), most = lengths_.farthest_pull();
    if (distance <= most)
      return pull;
    const double share = most / distance;
    return share >= std::numeric_limits<double>::min() ? scaled(pull, share) : scaled(normalized(pull), most);
  }

  bool is_beyond_reach(const Vector& target) const { return length(minus(target, x)) > lengths_.farthest_pull(); }

  /// x and a displacement. What is less than the last bits of all else here is noise, which exact decisions would pay
  /// for.
  Vector place_at(const Vector& displacement) const {
    Vector place = plus(x, displacement);
    for (double& coordinate : place)
      coordinate = std::abs(coordinate) < lengths_.noise() ? 0 : coordinate;
    return place;
  }

  /// Where the contacts let J go from x, when it wants to go by `pull`, keeping this many clearances from each; in a
  /// gap too narrow for that, or too acute, a half or a quarter of it, and at last coming no nearer to any than it is.
  Nearest_permitted nearest(const Vector& pull, double clearances) const {
    const double distance = length(pull);
    Nearest_permitted found;
    for (const double share : {1.0, 0.5, 0.25}) {
      found = nearest_among(pull, distance,
                            [&](const Facet<Mesh>& f) { return share * clearances * f.clearance() - f.height(); });
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

  /// Whether the facet goes over to another one there that is known, rising or flat: no way leads round that border.
  bool is_closed(const Facet<Mesh>& facet, int border) const {
    return std::any_of(facets.begin(), facets.end(), [&](const Facet<Mesh>& other) {
      return &other != &facet && facet.shares_border(border, other) &&
             dot(other.normal(), facet.outward(border)) < least_slope;
    });
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
    if (kept == facets.end())
      return false;
    facets.erase(kept, facets.end());
    find_lengths();
    return true;
  }

  void forget_what_was_left() { left_.clear(); }

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

  /// Takes in the steepest of the contacts that come first in the motion decided, from x to y, and are not known yet:
  /// of several features that meet in one point some are no obstacle, and whichever is will be met next. Returns the
  /// fraction of the way.
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

protected:
  Drag_rules rules_;
  Slide_lengths lengths_{};

private:
  boost::container::static_vector<Contact_3<Mesh>, most_facets> left_; ///< contacts gone past in this drag

  void find_lengths() {
    double reach = largest_magnitude(x);
    for (const Facet<Mesh>& f : facets)
      reach = std::fmax(reach, f.largest_coordinate());
    lengths_ = {rules_.clearance.at(reach), unit_in_the_last_place(reach)};
  }

  /// As nearest(), with `least(facet)` the height above where it is now that J has to have over each. Normals that
  /// differ by rounding alone count as one.
  template <class Least>
  Nearest_permitted nearest_among(const Vector& pull, double distance, const Least& least) const {
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
    // Where nearly parallel planes meet may be 2^48 times as far: in the usual unit that might leave the range.
    double largest = distance;
    for (const Half_space& space : spaces)
      largest = std::fmax(largest, std::abs(space.least));
    const double unit = unit_of(largest);
    for (Half_space& space : spaces)
      space.least *= unit;
    const double slack = lengths_.resolution * unit, slack_there = slack + rounding_of_normals * (distance * unit);
    Nearest_permitted found = nearest_permitted(scaled(pull, unit), spaces.data(), spaces.size(), slack, slack_there);
    found.displacement = scaled(found.displacement, 1 / unit);
    for (int i = 0; i < found.number_active; ++i)
      found.active[i] = facet_of[found.active[i]];
    return found;
  }

  bool has_left(const Contact_3<Mesh>& contact) const {
    return std::any_of(left_.begin(), left_.end(),
                       [&](const Contact_3<Mesh>& before) { return Facet<Mesh>::is_same(before, contact); });
  }
};

} // namespace haptic_sculpt::internal
