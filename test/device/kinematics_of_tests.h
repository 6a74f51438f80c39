// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What the tests of kinematics share; in the namespace of their suite.

#include "device/populations.h"

#include <haptic_sculpt/device/forward_by_all_modes.h>

namespace device_kinematics {

using namespace device_populations;
using Vector = Device_vector<double>;
constexpr unsigned seed = 20240611;

inline double residual(const Device_parameters<double>& parameters, const Device_pose<double>& pose) {
  return nine_equation_residual(parameters, pose.elbows, pose.joints).cwiseAbs().maxCoeff();
}

} // namespace device_kinematics
