// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Edit.h>

#include <boost/lockfree/spsc_queue.hpp>

#include <atomic>
#include <new>

namespace haptic_sculpt {

/// What the loop's thread has done, on its way to the thread that writes it down, each as it can be done again: a move
/// is one straight leg, so no contact and no bound on work plays a role in it. Bounded, without a lock; the edits of a
/// tick come through whole or not at all, and one of kind `none` ends them.
///
/// Once an entry finds no room, or the oldest that waits is older than `most_age` ticks, the journal has overrun: it
/// takes nothing more, so that what is written ends at the end of a tick, and the run should end: a Loop_session ends
/// its loop by the fault `log`.
class Edit_journal {
public:
  /// \param most_age in ticks \param entries_a_tick room, in the mean; a slide makes a move a leg, mostly one
  /// \pre their product is a number that memory may have room for
  explicit Edit_journal(std::uint64_t most_age, std::size_t entries_a_tick = 36)
      : most_age_(most_age), queue_((most_age + 2) * entries_a_tick), waiting_(most_age + 2) {}

  /// \name The loop's thread
  ///@{

  /// Takes what was done in the tick under way; where there is no room, or no memory, the journal has overrun.
  void add(const Edit& edit) {
    try {
      has_overrun_ = has_overrun_ || !queue_.push(edit);
    } catch (const std::bad_alloc&) {
      has_overrun_ = true;
    }
    lost_ += has_overrun_;
    has_entries_ = true;
  }
  /// Something stands of which nobody can say how it was done: the journal has overrun.
  void break_off() { has_overrun_ = has_entries_ = true; }
  /// To be called at the end of each tick, with growing numbers.
  void end_tick(std::uint64_t tick) {
    const std::uint64_t taken = taken_.load(std::memory_order_acquire);
    if (age(tick) > most_age_)
      has_overrun_ = true;
    if (!std::exchange(has_entries_, false) || has_overrun_)
      return;
    const Edit end = Edit::of(Edit_kind::none, {static_cast<std::size_t>(tick), 0, 0});
    if (ended_ - taken == waiting_.size() || !queue_.push(end)) {
      has_overrun_ = true;
      return;
    }
    waiting_[ended_++ % waiting_.size()] = tick;
  }
  bool has_overrun() const { return has_overrun_; } ///< nothing more is taken: the run should end
  /// Entries that were not taken: all since the journal has overrun.
  std::uint64_t lost() const { return lost_; }
  /// This many entries more find room: who would rather wait than overrun asks before a tick.
  std::size_t room() const { return queue_.write_available(); }
  /// Ticks with entries that are not written yet.
  std::uint64_t waiting() const { return ended_ - taken_.load(std::memory_order_acquire); }
  std::uint64_t most_age() const { return most_age_; } ///< in ticks, as given
  /// Of the oldest tick that waits, at the end of this one; 0: none does.
  std::uint64_t age(std::uint64_t tick) const {
    const std::uint64_t taken = taken_.load(std::memory_order_acquire);
    return taken != ended_ ? tick + 1 - waiting_[taken % waiting_.size()] : 0;
  }
  ///@}

  /// \name The thread that writes
  ///@{

  /// Takes the next entry. \return false where there is none yet. The entries of the last tick may be followed by none:
  /// they wait for its end.
  bool take(Edit& edit) {
    if (queue_.read_available() == 0)
      return false;
    edit = std::move(queue_.front()); // pop() would copy
    return queue_.pop();
  }
  /// This many more ticks are written, or cannot be.
  void wrote(std::uint64_t ticks) { taken_.fetch_add(ticks, std::memory_order_release); }
  ///@}

private:
  std::uint64_t most_age_;
  boost::lockfree::spsc_queue<Edit> queue_;
  std::vector<std::uint64_t> waiting_; ///< numbers of the ticks that are not written, by how many were before
  std::uint64_t ended_ = 0, lost_ = 0;
  bool has_entries_ = false, has_overrun_ = false;
  std::atomic<std::uint64_t> taken_{0};
};

} // namespace haptic_sculpt
