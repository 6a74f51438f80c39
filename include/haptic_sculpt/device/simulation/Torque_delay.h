// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/device/leg_frame.h>
#include <array>
#include <string>

namespace haptic_sculpt {

/// Torques that are commanded once a tick, held until the next, and act a number of ticks late, which need not be
/// whole.
///
/// With the delay n + f, n whole and 0 <= f < 1, the torque in force during tick k is that of tick k - n - 1 for the
/// first part f of the tick and that of tick k - n for the rest. Before the first command no torque is in force. No
/// allocation.
template <class S>
class Torque_delay {
public:
  static constexpr int most_ticks = 16; ///< a device that answers later is no haptic device

  /// \throw Error unless 0 <= ticks <= most_ticks
  explicit Torque_delay(const S& ticks) : ticks_(ticks) {
    if (!(ticks >= S(0) && ticks <= S(most_ticks)))
      throw Error("the delay of the torques must be from 0 to " + std::to_string(most_ticks) + " ticks");
    while (S(whole_ + 1) <= ticks)
      ++whole_;
    held_.fill(Device_vector<S>::Zero());
  }

  const S& ticks() const { return ticks_; } ///< The whole delay, n + f, as given.
  /// The part of a tick, at its beginning, in which `before()` is in force: f.
  S fraction() const { return ticks_ - S(whole_); }

  /// Begins a tick with its torque, N m.
  void command(const Device_vector<S>& torque) {
    newest_ = (newest_ + 1) % size;
    held_[newest_] = torque;
  }
  /// In force for the first part of the tick begun last, N m.
  const Device_vector<S>& before() const { return held_[(newest_ + size - whole_ - 1) % size]; }
  /// In force for the rest of it, N m.
  const Device_vector<S>& after() const { return held_[(newest_ + size - whole_) % size]; }
  /// The mean over that tick: times the joints' way during the tick, the work at the joints.
  Device_vector<S> mean() const { return fraction() * before() + (S(1) - fraction()) * after(); }

private:
  static constexpr int size = most_ticks + 2;
  S ticks_;
  int whole_ = 0, newest_ = 0;
  std::array<Device_vector<S>, size> held_;
};

} // namespace haptic_sculpt
