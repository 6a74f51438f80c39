// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/Work.h>
#include <haptic_sculpt/sculpting/response/Search_memory.h>

#include <optional>
#include <utility>

namespace haptic_sculpt::internal {

/// The searches that are made where a vertex has come to rest, one after the other. The bound on the work of a drag may
/// cut them short; the next drag then goes on with them, as long as the vertex is at the same place
/// (doc/use/work.md, "How a drag goes on").
///
/// The trials of one search always come in the same order, so a number of each search tells which are due.
class Search_round {
public:
  enum class Search { near_planes, corner, straight_ways, rising_ways };

  void forget() { *this = Search_round(); }

  /// A drag begins. One without a bound begins its searches anew.
  void begin(bool is_bounded) {
    if (!is_cut_ || !is_bounded)
      forget();
    is_cut_ = has_searched_ = false;
    last_due_.reset();
    for (auto& trials : trials_)
      trials.counted = 0;
  }
  /// The vertex rests on its way to the target.
  void search_at(const Vector& place, const Vector& target, const Slide_lengths& lengths) {
    if (!is_begun_ || place != place_) {
      forget();
      is_begun_ = true;
      place_ = place, target_ = target;
    }
    has_searched_ = true;
    is_for_other_ = !are_one_target(target, target_, lengths);
  }
  /// To be asked once before each trial of a search. False where an earlier drag has made it, and where the work is
  /// spent.
  bool is_due(Search search, const Work& work) {
    if (work.is_spent())
      return false;
    Trials& trials = trials_[static_cast<std::size_t>(search)];
    const std::size_t number = trials.counted++;
    if (number < trials.first_due)
      return false;
    last_due_ = Trial{search, number};
    is_mixed_ = is_mixed_ || is_for_other_;
    return true;
  }
  /// The drag has searched for all that it could.
  void end(const Work& work) {
    is_cut_ = work.is_spent() && last_due_;
    if (!is_cut_)
      return;
    for (auto& trials : trials_)
      trials.first_due = std::max(trials.first_due, trials.counted);
    // The last trial was not finished. It is begun once more, then left out: it might always cost more than the bound.
    if (last_due_ == last_cut_)
      has_left_out_ = true;
    else
      trials_[static_cast<std::size_t>(last_due_->first)].first_due = last_due_->second;
    last_cut_ = last_due_;
  }

  /// Whether this drag has made a trial.
  bool is_searching() const { return last_due_.has_value(); }
  /// Whether the search was begun by an earlier drag.
  bool is_resumed(Search search) const { return trials_[static_cast<std::size_t>(search)].first_due != 0; }
  /// Whether a trial had to be left out, so that nothing is known of what it would have found.
  bool has_left_out() const { return has_searched_ && has_left_out_; }
  /// Whether all that was tried, if anything, was tried for the target of this drag, or one that is as good.
  bool is_for_its_target() const { return !has_searched_ || (!is_mixed_ && !is_for_other_); }

  /// The search has found nothing. Kept in mind only where all of it was tried, for this target.
  void note(Search_memory& memory) const {
    if (!has_left_out_ && is_for_its_target())
      memory.note(place_, target_);
  }

private:
  struct Trials {
    std::size_t counted = 0;   ///< in this drag
    std::size_t first_due = 0; ///< those before were made by earlier ones, or left out
  };
  using Trial = std::pair<Search, std::size_t>;

  bool is_begun_ = false, is_cut_ = false, has_left_out_ = false;
  bool has_searched_ = false; ///< this drag has come to where it is
  bool is_for_other_ = false; ///< this drag's target is not the one that the round was begun for
  bool is_mixed_ = false;     ///< a trial was made for another target
  Vector place_{}, target_{};
  std::array<Trials, 4> trials_{};
  std::optional<Trial> last_due_; ///< in this drag
  std::optional<Trial> last_cut_;
};

} // namespace haptic_sculpt::internal
