// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Reentrant_call.h>
#include <haptic_sculpt/sculpting/Unfinished_change.h>

#include <cstdint>
#include <utility>

namespace haptic_sculpt::internal {

/// Whether the mesh, or what is kept beside it, is being written: an exception that comes meanwhile leaves it so, for
/// good. And whether anything may change now: not while a function of the caller's runs in the middle of a call.
class Write_state {
public:
  void begin() noexcept {
    is_writing_ = true;
    ++changes_;
  }
  void end() noexcept { is_writing_ = false; }

  bool is_under_way() const noexcept { return is_writing_; }

  /// \throw Unfinished_change if a change has been begun and never ended
  void check() const {
    if (is_writing_)
      throw Unfinished_change();
  }

  /// While one lives a function of the caller's runs in the middle of a call.
  class [[nodiscard]] Asking {
  public:
    explicit Asking(Write_state& state) noexcept : state_(state), was_asking_(std::exchange(state.is_asking_, true)) {}
    ~Asking() { state_.is_asking_ = was_asking_; }
    Asking(const Asking&) = delete;
    Asking& operator=(const Asking&) = delete;

  private:
    Write_state& state_;
    bool was_asking_;
  };
  /// Whether one runs now: the mesh may have changed since its last question.
  bool is_asking() const noexcept { return is_asking_; }
  /// \throw Reentrant_call, Unfinished_change
  void check_may_change() const {
    check();
    if (is_asking_)
      throw Reentrant_call();
  }

  /// How many changes have been begun: as long as this stays the mesh has not been written.
  std::uint64_t changes() const noexcept { return changes_; }

private:
  bool is_writing_ = false, is_asking_ = false;
  std::uint64_t changes_ = 0;
};

} // namespace haptic_sculpt::internal
