// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Run.h"

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>
#include <haptic_sculpt/haptic_rendering/check_coupling.h>
#include <haptic_sculpt/haptic_rendering/Haptic_parameters.h>

namespace haptic_sculpt::loop_program {

/// What the settings of a run, or of its recording, make of a device and a scene. It refers to the plan.
class Run_conditions {
public:
  /// \throw Foreign_recording, Usage_error where the device has no home
  explicit Run_conditions(const Plan& plan);

  double tick() const { return tick_; } ///< s
  const Device_parameters<double>& device() const { return device_; }
  Haptic_parameters parameters() const;

  /// From the device to a scene in this box. \throw as of_settings()
  Workspace_map map(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) const;
  /// What may be asked of a loop in this box. \throw as of_settings(); Usage_error where the map leads nowhere
  Passivity_limits limits(const Haptic_parameters& parameters, const Workspace_map& map, const Eigen::Vector3d& lower,
                          const Eigen::Vector3d& upper) const;
  /// \throw Unstable_coupling that says more where the device is the reason
  void check(const Haptic_parameters& parameters, const Passivity_limits& limits) const;
  /// Where the device is first: the same in a run and in its replay, to the bit. \throw as of_settings()
  Device_pose<double> start() const;

  /// What is made of the settings. \throw what `make` throws; Foreign_recording where a recording's settings are why
  template <class Make>
  auto of_settings(const Make& make) const -> decltype(make()) {
    try {
      return make();
    } catch (const Unstable_coupling&) { // options could have asked for it
      throw;
    } catch (const Error& error) {
      if (!plan_.replay)
        throw;
      throw Foreign_recording(std::string("the settings of the recording cannot be used: ") + error.what());
    }
  }

private:
  const Plan& plan_;
  const Settings& settings_;
  double tick_;
  Device_parameters<double> device_;
  Device_pose<double> home_;

  Device_pose<double> home() const;
  Device_pose<double> start_of_recording() const;
};

} // namespace haptic_sculpt::loop_program
