// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/response/Search_round.h>
#include <haptic_sculpt/sculpting/response/Slide_walk.h>

#include <optional>

namespace haptic_sculpt::internal {

/// Half-spaces forbid more than facets do: at a corner that is neither convex nor concave there may be a way on
/// although the planes meet. Looks for one where a walk has settled (doc/proofs/slide.md, "The search at corners").
template <class Mesh>
class Corner_search {
public:
  using Walk = Slide_walk<Mesh>;

  /// This many legs are tried to show that a way out of a mixed corner is one.
  static constexpr int trial_legs = 4;
  /// At most this many ways out of one place are tried.
  static constexpr int most_trials = 64;

  /// Something has changed: where none was found there may be one now.
  void forget() { memory_.forget(); }

  /// Takes a way if it brings the vertex nearer by more than what clearances can feign. Returns whether there was one.
  template <class Guard>
  bool take(Walk& walk, Guard& guard, Search_round& round, const Vector& target, int most_legs) {
    walk_ = &walk;
    most_legs_ = most_legs;
    const Slide_lengths lengths = walk_->lengths(); // trials may change those of the walk
    const Vector pull = walk_->pull_to(target);
    if (walk_->facets.empty() || length(pull) <= lengths.shortest_pull())
      return false;
    if (memory_.holds(walk_->x, target, lengths) || !may_lead_on())
      return false;
    const auto without_clearance = walk_->nearest(pull, 0);
    const double gain =
        std::fmax(8 * lengths.clearance, without_clearance.exists ? 4 * length(without_clearance.displacement) : 0);
    if (!round.is_resumed(Search_round::Search::corner)) {
      seen_ = walk_->facets;
      trials_ = 0;
      all_legs_were_left_ = true;
    }
    int trials_at_cut = trials_;
    const auto brings_nearer = [&](const Vector& first_aim) {
      ++trials_;
      trial_.forget_progress();
      if (first_aim != target) {
        trial_.go(guard, first_aim,
                  std::min(trial_.legs() + 1, most_legs_)); // one leg: on from there it must not climb
        trial_.forget_progress();
      }
      const bool is_nearer =
          trial_.go_instead_of(*walk_, guard, target, std::min(walk_->legs() + trial_legs, most_legs_), gain);
      for (const auto& facet : trial_.facets)
        remember(facet);
      return is_nearer;
    };
    all_legs_were_left_ = all_legs_were_left_ && walk_->legs() + trial_legs <= most_legs;
    memory_.forget();
    if (follow_features(guard, round, pull, target, trials_at_cut, brings_nearer))
      return true;
    if (guard.is_spent())
      trials_ = trials_at_cut;
    else if (all_legs_were_left_)
      round.note(memory_);
    return false;
  }

private:
  Walk* walk_ = nullptr; ///< set in take()
  int most_legs_ = 0;
  Walk trial_;
  typename Walk::Facets seen_;     ///< all that was met meanwhile
  int trials_ = 0;                 ///< made at this place
  bool all_legs_were_left_ = true; ///< for each of them
  Search_memory memory_;

  /// Whether there may be a way past a border of some contact. Where all contacts near one are faces and each goes over
  /// to another of them, rising or flat, there is none: a concave edge or corner, all of which is known.
  bool may_lead_on() const {
    for (const auto& facet : walk_->facets) {
      if (facet.is_wall())
        return true;
      for (int k = 0; k < facet.borders(); ++k)
        if (facet.beyond_border(k, walk_->x) > -walk_->lengths().border() && !walk_->is_closed(facet, k))
          return true;
    }
    return false;
  }

  /// The paper's vertex rule (3.2.2 c): from a little off, tries every face and every edge that was met here.
  template <class Guard, class Brings_nearer>
  bool follow_features(Guard& guard, Search_round& round, const Vector& pull, const Vector& target, int& trials_at_cut,
                       const Brings_nearer& brings_nearer) {
    const auto is_due = [&] {
      const bool is = round.is_due(Search_round::Search::corner, guard.work());
      if (is)
        trials_at_cut = trials_;
      return is;
    };
    const Slide_lengths lengths = walk_->lengths();
    std::optional<Vector> lifted;
    const double beside = lengths.border() / 4;
    const auto start = [&] {
      if (!lifted)
        lifted = off_the_contacts(guard);
      trial_.begin_at(*walk_);
      if (*lifted != walk_->x && trial_.legs() < most_legs_)
        trial_.step_to(*lifted);
    };
    // seen_ grows on the way.
    for (std::size_t i = 0; i < seen_.size() && trials_ < most_trials; ++i) {
      if (is_due()) {
        start();
        trial_.facets.push_back(seen_[i]);
        trial_.place(trial_.x);
        if (brings_nearer(target))
          return true;
      }
      for (int k = 0; k < seen_[i].borders() && trials_ < most_trials; ++k) {
        if (seen_[i].beyond_border(k, walk_->x) < -lengths.border() || !is_due())
          continue;
        // Past the border, where it may be only a clearance to free space.
        start();
        const Vector past = advanced(trial_.x, beside, seen_[i].outward(k));
        if (trial_.legs() < most_legs_ && guard.is_free(trial_.x, past, walk_->delta())) {
          trial_.step_to(past);
          if (brings_nearer(target))
            return true;
        }
        const Vector along = seen_[i].along_border(k);
        start();
        if (brings_nearer(advanced(trial_.x, dot(pull, along), along)))
          return true;
      }
      for (std::size_t j = 0; j < i && trials_ < most_trials; ++j) {
        if (!is_due())
          continue;
        start();
        trial_.facets.push_back(seen_[i]);
        trial_.facets.push_back(seen_[j]);
        trial_.place(trial_.x);
        if (brings_nearer(target))
          return true;
      }
    }
    return false;
  }

  /// A free point a few clearances from the vertex along the mean normal of its contacts, or where it is.
  template <class Guard>
  Vector off_the_contacts(Guard& guard) const {
    const Vector up = walk_->mean_normal();
    for (const double height : {4.0, 1.0}) {
      const Vector off = advanced(walk_->x, height * walk_->lengths().clearance, up);
      if (off != walk_->x && guard.is_free(walk_->x, off, walk_->delta()))
        return off;
    }
    return walk_->x;
  }

  void remember(const Facet<Mesh>& facet) {
    for (const auto& other : seen_)
      if (facet.is_wall() || other.is_of(facet.contact()))
        return;
    if (seen_.size() < seen_.capacity())
      seen_.push_back(facet);
  }
};

} // namespace haptic_sculpt::internal
