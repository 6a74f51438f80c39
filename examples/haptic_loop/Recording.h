// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Settings.h"

#include "../common/contents_of.h"

#include <haptic_sculpt/haptic_rendering/Joint_reading.h>

#include <cstdio>

namespace haptic_sculpt::loop_program {

/// What a device said in a run, and what the run was about: a line of JSON, then a line a tick, numbers in hexadecimal.
struct Recording {
  std::string mesh; ///< SHA-256 of its file
  Settings settings;
  std::vector<Joint_reading> readings;

  /// \throw Usage_error, Foreign_recording
  static Recording read(const std::string& path);
};

/// The first line. A path and a hand are not in it: the readings say what they did.
inline std::string recording_head(const std::string& mesh, const Settings& settings) {
  nlohmann::json head = json_of(settings);
  head["haptic_loop"] = 1;
  head["mesh"] = mesh;
  return head.dump() + "\n";
}

inline void write_reading(std::FILE* file, const Joint_reading& r) {
  std::fprintf(file, "%a %a %a %a %a %a %d %a\n", r.theta[0], r.theta[1], r.theta[2], r.torque[0], r.torque[1],
               r.torque[2], r.button, r.elapsed);
}

inline Recording Recording::read(const std::string& path) {
  const std::string text = examples::contents_of<Usage_error>(path, "the recording");
  const std::size_t end = text.find('\n');
  Recording recording;
  const nlohmann::json head = nlohmann::json::parse(text.substr(0, end), nullptr, false);
  if (!head.is_object() || head.value("haptic_loop", nlohmann::json(0)) != 1 ||
      !head.value("mesh", nlohmann::json(0)).is_string())
    throw Foreign_recording("'" + path + "' is no recording of haptic_loop");
  recording.mesh = head["mesh"];
  recording.settings = settings_of(head);
  std::size_t number = 1;
  for (std::size_t at = end == std::string::npos ? text.size() : end + 1; at < text.size();) {
    const std::size_t stop = text.find('\n', at);
    if (stop == std::string::npos)
      break; // a killed process may leave part of a line
    ++number;
    const std::string line = text.substr(at, stop - at);
    Joint_reading r;
    if (std::sscanf(line.c_str(), "%la %la %la %la %la %la %d %la", &r.theta[0], &r.theta[1], &r.theta[2], &r.torque[0],
                    &r.torque[1], &r.torque[2], &r.button, &r.elapsed) != 8)
      throw Foreign_recording(path + ": line " + std::to_string(number) + " is no line of a recording");
    recording.readings.push_back(r);
    at = stop + 1;
  }
  return recording;
}

} // namespace haptic_sculpt::loop_program
