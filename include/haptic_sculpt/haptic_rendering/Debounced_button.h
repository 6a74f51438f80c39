// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/loop/require_number.h>

namespace haptic_sculpt {

/// One press where the contacts of a button bounce. Every loop has one; and it is for whoever calls a Tool without a
/// loop. A change counts at once, so nothing comes late; the next one counts only when the contact has said the same
/// for a while. Reads no clock, allocates nothing.
class Debounced_button {
public:
  /// s; contacts of common buttons bounce for some milliseconds, and a hand presses for 50 ms and more.
  static constexpr double default_quiet_time = 0.02;

  /// \param quiet_time for which the contact has to say the same before the next change, s; 0: all changes count
  /// \throw Error for a time that is not from 0 to 1 s
  explicit Debounced_button(double quiet_time = default_quiet_time) : quiet_time_(quiet_time) {
    internal::require_number("the quiet time of a Debounced_button", "s", quiet_time, 0, 1);
  }

  /// Once a reading. \param contact as it is \param elapsed since the last call, s; one that is not > 0 counts as 0
  /// \return the button: 0 at first, then what was pressed
  int next(int contact, double elapsed) {
    quiet_ = contact != contact_ ? 0 : quiet_ + (elapsed > 0 ? elapsed : 0);
    contact_ = contact;
    if (quiet_ >= quiet_time_)
      is_quiet_ = true;
    if (is_quiet_ && contact != button_)
      button_ = contact, is_quiet_ = false;
    return button_;
  }

private:
  double quiet_time_, quiet_ = 0;
  int contact_ = 0, button_ = 0;
  bool is_quiet_ = true;
};

} // namespace haptic_sculpt
