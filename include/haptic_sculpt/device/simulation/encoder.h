// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_parameters.h>

namespace haptic_sculpt {

/// What the encoders say of joint angles: each the nearest multiple of the encoder step, rad, as the rounded quotient
/// says, so off by half a step and that rounding at most; halves go up.
template <class S>
Device_vector<S> measured_angles(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  using std::abs;
  using std::floor;
  const S& step = parameters.encoder_step();
  if (step == S(0))
    return theta;
  Device_vector<S> measured;
  for (int joint = 0; joint < 3; ++joint) {
    const S steps = theta[joint] / step; // overflows where a step is next to nothing
    // From 2^52 steps on, a step is less than what doubles tell of the angle: it is measured as it is.
    const S whole = floor(steps); // steps + 0.5 would be rounded; this is not where it is near a half
    measured[joint] =
        abs(steps) < S(0x1p52) ? S(step * (S(steps - whole) < S(0.5) ? whole : S(whole + S(1)))) : theta[joint];
  }
  return measured;
}

} // namespace haptic_sculpt
