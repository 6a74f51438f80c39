// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Settings.h"

#include "../common/contents_of.h"
#include "../json_line.h"

#include <haptic_sculpt/haptic_rendering/Joint_reading.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace haptic_sculpt::loop_program {

/// What a device said in a run, and what the run was about: a line of JSON, then a line a tick, numbers in hexadecimal.
struct Recording {
  std::string mesh; ///< SHA-256 of its file
  Settings settings;
  std::vector<Joint_reading> readings;
  bool is_cut = false; ///< it ends within a reading, which is left out

  /// \throw Usage_error, Foreign_recording
  static Recording read(const std::string& path);

private:
  void take_head(const std::string& line, const std::string& path);
  void take_reading(const std::string& line, const std::string& path);
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
  Recording recording;
  std::string line; // that has begun; a killed process may leave part of one at the end
  bool has_head = false;
  examples::read_blocks<Usage_error>(path, "the recording", [&](std::string_view block) {
    while (!block.empty()) {
      const std::size_t end = std::min(block.find('\n'), block.size());
      line += block.substr(0, end);
      if (line.size() > longest_line)
        throw Foreign_recording("'" + path + "' is no recording of haptic_loop: a line is longer than 1 MiB");
      if (end == block.size())
        return;
      has_head ? recording.take_reading(line, path) : recording.take_head(line, path);
      has_head = true, line.clear();
      block.remove_prefix(end + 1);
    }
  });
  if (!has_head)
    recording.take_head(line, path);
  recording.is_cut = has_head && !line.empty();
  return recording;
}

inline void Recording::take_head(const std::string& line, const std::string& path) {
  nlohmann::json head;
  try {
    head = parse_bounded(line);
  } catch (const nlohmann::json::exception&) { // said below
  } catch (const No_answer&) {
  }
  if (!head.is_object() || head.value("haptic_loop", nlohmann::json(0)) != 1 ||
      !head.value("mesh", nlohmann::json(0)).is_string())
    throw Foreign_recording("'" + path + "' is no recording of haptic_loop");
  mesh = head["mesh"];
  try {
    settings = settings_of(head);
  } catch (const Foreign_recording& error) {
    throw Foreign_recording("the recording '" + path + "': " + error.what());
  }
}

inline void Recording::take_reading(const std::string& line, const std::string& path) {
  Joint_reading r;
  double button = 0; // what is no int has no meaning as one
  int end = 0;
  if (std::sscanf(line.c_str(), "%la %la %la %la %la %la %la %la %n", &r.theta[0], &r.theta[1], &r.theta[2],
                  &r.torque[0], &r.torque[1], &r.torque[2], &button, &r.elapsed, &end) != 8 ||
      static_cast<std::size_t>(end) != line.size() || !(button == 0 || button == 1 || button == 2) ||
      !std::isfinite(r.elapsed)) // the device's clock, which no fault makes another
    throw Foreign_recording(path + ": line " + std::to_string(readings.size() + 2) + " is no line of a recording");
  r.button = static_cast<int>(button);
  readings.push_back(r);
}

} // namespace haptic_sculpt::loop_program
