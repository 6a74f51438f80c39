// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../common/run_program.h"

#include <haptic_sculpt/haptic_rendering/Vertex_snap.h>
#include <haptic_sculpt/device/Device_parameters.h>
#include <haptic_sculpt/haptic_rendering/simulation/Hand_path.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_hand.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace haptic_sculpt::loop_program {

using examples::Usage_error;

/// A recording of another mesh, or none at all.
struct Foreign_recording : Error {
  using Error::Error;
};

struct Injected_fault {
  Loop_fault kind = Loop_fault::none;
  double time = 0; ///< s
};

/// What a run is about, apart from where its results go. All of it is in a recording.
struct Settings {
  double rate = 1000, delay = 0, stiffness = 500, damping = 0, reach = 0.001;
  double virtual_mass = 0; ///< kg
  std::optional<double> controller;                 ///< N s/m; nothing: half of what may be asked for
  Vertex_snap snap;                                 ///< off by default
  std::size_t work = 400;
  std::vector<double> map; ///< scale, origin and, if given, the rotation vector; empty: the scene is fitted
  std::optional<Eigen::Vector3d> begin; ///< where the path begins, m, in the device; older recordings do not say it
  Device_description<double> device;
  Simulated_hand hand = Simulated_hand::finger();
};

/// D1, di-tetrahedral, with joints of a built device.
Device_description<double> default_device();

/// \throw Usage_error naming file and member
Device_description<double> read_device(const std::string& path);
Simulated_hand read_hand(const std::string& path);
/// \throw Hand_path_error
Hand_path read_path(const std::string& path);
/// `nan@0.5` and the like. \throw Usage_error
Injected_fault fault_of(const std::string& text);

nlohmann::json json_of(const Device_description<double>& device);
/// Number types as the double they are, so that reading gives the same settings.
nlohmann::json json_of(const Settings& settings);
/// \throw Foreign_recording where a setting is missing, or is none that the options could give
Settings settings_of(const nlohmann::json& json);

/// A setting that cannot be used.
struct Bad_setting {
  std::string option; ///< its name without the dashes: "virtual-mass"
  std::string demand; ///< what it has to be: "must be from 0 to 10 kg"
};
/// The first of them, apart from the device; nothing where all can be used.
std::optional<Bad_setting> bad_setting(const Settings& settings);

} // namespace haptic_sculpt::loop_program
