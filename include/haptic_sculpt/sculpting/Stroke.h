// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

#include <cstddef>
#include <utility>

namespace haptic_sculpt {

/// What is only to be done between steps of the history was asked for within a stroke. Nothing has changed.
class Open_stroke : public Error {
public:
  using Error::Error; ///< takes the message that `what()` gives
};

/// All drags and edits of a Sculptor while this lives are one step of its history: made by `Sculptor::stroke()`, ended
/// by `end()` or destruction, an exception included; what was done by then is the step.
///
/// A stroke made while there is one joins it, and the step ends with the last of them. `undo()` and `redo()` end the
/// stroke, unless memory runs out; edits after that are steps of their own, though the object lives. Refers to its
/// Sculptor, which must outlive it.
template <class Sculptor>
class [[nodiscard]] Stroke {
public:
  /// For Sculptor::stroke(), which has begun it and knows its number.
  Stroke(Sculptor& sculptor, std::size_t number) : sculptor_(&sculptor), number_(number) {}
  ~Stroke() { end(); }

  /// Ends the stroke in place of `other`, which ends nothing any more.
  Stroke(Stroke&& other) noexcept : sculptor_(std::exchange(other.sculptor_, nullptr)), number_(other.number_) {}
  /// Ends its own stroke first; then as above.
  Stroke& operator=(Stroke&& other) noexcept {
    if (this != &other) {
      end();
      sculptor_ = std::exchange(other.sculptor_, nullptr);
      number_ = other.number_;
    }
    return *this;
  }

  /// A second call does nothing. Does not end the grab at hand.
  void end() noexcept {
    if (sculptor_ != nullptr)
      sculptor_->end_stroke(number_);
    sculptor_ = nullptr;
  }

  /// Whether edits are still added to its step.
  bool is_open() const { return sculptor_ != nullptr && sculptor_->guarded_.editor().history().is_in_stroke(number_); }

private:
  Sculptor* sculptor_; ///< nullptr once it has ended or was moved from
  std::size_t number_;
};

} // namespace haptic_sculpt
