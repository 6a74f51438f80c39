// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt {

/// How a question to the mechanism ended. Everything but `success` is an answer too, never an exception.
enum class Device_status {
  success,     ///< there is a value; the shortfall is 0
  not_finite,  ///< an input is infinite or not a number, or so large that the answer overflows
  unreachable, ///< no apex (forward) or joint angles (inverse) exist, or none on the straight way from the pose before;
               ///< the shortfall says how far that is
  no_real_mode, ///< general form: these joint angles have no real assembly mode
  singular,     ///< the answer is not unique or not differentiable here: elbows on a line, a matrix without an inverse
  undecided,    ///< no mode was followed that far; forward_by_all_modes() (device/forward_by_all_modes.h) decides
  mode_lost, ///< the way from the previous pose meets a singular pose, where the mode to follow ceases to exist, or is
             ///< longer than some tens of turns
  diverged   ///< of an Outcome that nothing was put into
};

/// The word that names a status, as programs print it, e.g. "no_real_mode".
inline const char* name_of(Device_status status) {
  switch (status) {
  case Device_status::success: return "success";
  case Device_status::not_finite: return "not_finite";
  case Device_status::unreachable: return "unreachable";
  case Device_status::no_real_mode: return "no_real_mode";
  case Device_status::singular: return "singular";
  case Device_status::undecided: return "undecided";
  case Device_status::mode_lost: return "mode_lost";
  case Device_status::diverged: return "diverged";
  }
  return "unknown";
}

/// A value of type T, or why there is none and how far the question is from having one.
///
/// `T::Scalar` is the scalar. On failure the value is unfinished, never an old or a guessed pose that could be taken
/// for an answer: reading it is an error of the caller, who is expected to have looked at `status()` first.
/// `shortfall()` is 0 on success; each function says what it measures (dimensionless unless said otherwise) and it is
/// finite and non-negative always.
template <class T> class Outcome {
public:
  using Scalar = typename T::Scalar; ///< what a shortfall is measured in

  Outcome() = default; ///< An unfinished answer; `value_to_fill()` and `succeed()` complete it in place.
  Outcome(const T& value)
      : status_(Device_status::success), shortfall_(0), value_(value) {} ///< A success; copies the value.
  /// A failure; a shortfall that is negative or not finite counts as 0. \pre status is not `success`
  Outcome(Device_status status, const Scalar& shortfall)
      : status_(status), shortfall_(usable(shortfall) ? shortfall : Scalar(0)) {}

  explicit operator bool() const { return status_ == Device_status::success; } ///< Whether there is a value.
  Device_status status() const { return status_; }                             ///< `diverged` for an unfinished answer.
  const Scalar& shortfall() const { return shortfall_; } ///< 0 on success; else as the function says.

  /// \pre the outcome is a success
  const T& operator*() const { return value_; }
  const T* operator->() const { return &value_; } ///< \pre the outcome is a success
  const T& value() const { return value_; }       ///< \pre the outcome is a success

  /// For functions that build large values without copying them.
  T& value_to_fill() { return value_; }
  void succeed() { status_ = Device_status::success, shortfall_ = Scalar(0); } ///< The value is complete now.
  /// There is no value; shortfall as in the constructor. \pre status is not `success`
  void fail(Device_status status, const Scalar& shortfall) {
    status_ = status;
    shortfall_ = usable(shortfall) ? shortfall : Scalar(0);
  }

private:
  static bool usable(const Scalar& value) { return value >= Scalar(0) && value * Scalar(0) == Scalar(0); }
  Device_status status_ = Device_status::diverged;
  Scalar shortfall_ = Scalar(0);
  T value_;
};

} // namespace haptic_sculpt
