// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

namespace haptic_sculpt::internal {

/// The way of functions that are no members to what a Sculptor guards.
struct Sculptor_access {
  template <class Sculptor>
  static auto& guarded(Sculptor& sculptor) {
    return sculptor.guarded_;
  }
};

/// Calls a function of the caller's in the middle of a call: what it wants to change is refused (Reentrant_call).
template <class Guarded, class Function, class... Arguments>
decltype(auto) ask(Guarded& guarded, const Function& function, Arguments&&... arguments) {
  const auto asking = guarded.asking();
  return function(std::forward<Arguments>(arguments)...);
}

/// Shifts, or moves, made while one lives are noted at its end; those taken back by then are not.
template <class Guarded>
class [[nodiscard]] Edit_trial {
public:
  explicit Edit_trial(Guarded& guarded) : guarded_(guarded) { guarded_.begin_trial(); }
  ~Edit_trial() { guarded_.end_trial(); }
  Edit_trial(const Edit_trial&) = delete;
  Edit_trial& operator=(const Edit_trial&) = delete;

private:
  Guarded& guarded_;
};

} // namespace haptic_sculpt::internal
