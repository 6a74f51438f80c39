// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "device/Mpfr_scalar.h"

#include <haptic_sculpt/device.h>

namespace haptic_sculpt::benchmark {

using Exact = device_populations::Mpfr<60>;

/// What 60 digits say of the very numbers that another type was given. Compiled by itself: these templates cost the
/// compiler more than all else.
class Reference {
public:
  struct State {
    Device_vector<Exact> position, torque;
  };

  /// \param rounded the design as the other type has it; where its roundings make it no valid design, `otherwise`
  /// serves
  Reference(const Device_description<Exact>& rounded, const Device_description<Exact>& otherwise);

  State state(const Device_vector<Exact>& angles, const Device_vector<Exact>& rates,
              const Device_vector<Exact>& accelerations) const;
  /// The joint angles for a point, by the closed form of the di-tetrahedral mechanism.
  Device_vector<Exact> inverse(const Device_vector<Exact>& point, const Eigen::Vector3i& knees) const;
  const Exact& secondary_length() const { return parameters_.secondary_length(); }

private:
  Device_parameters<Exact> parameters_;
};

} // namespace haptic_sculpt::benchmark
