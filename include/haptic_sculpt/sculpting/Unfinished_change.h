// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Reentrant_call.h>

#include <cstdint>
#include <utility>

namespace haptic_sculpt {

/// An exception came in the middle of a change of the mesh, so that nobody knows what the mesh is now. The Sculptor
/// refuses every later call. What to do: make a new Sculptor of a valid mesh, of a copy made before.
///
/// Memory that runs out does not lead here: an edit asks for all it needs first. What may: a broad phase of the
/// caller's own that throws, or allocates without a `reserve()`; a property of the mesh whose values throw when they
/// are made or copied; memory that runs out, or a kept property map that throws, while a part of an undo or redo is
/// taken back.
class Unfinished_change : public Error {
public:
  Unfinished_change()
      : Error("an exception has broken off a change of the mesh, which may have holes or cross itself since: this "
              "Sculptor refuses "
              "every call; make a new one of a valid copy of the mesh") {}
};

namespace internal {

/// Whether the mesh, or what is kept beside it, is being written. An exception that comes meanwhile leaves it so, for
/// good.
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

} // namespace internal

} // namespace haptic_sculpt
