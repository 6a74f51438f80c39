// SPDX-License-Identifier: GPL-3.0-or-later
#include "Model.h"

#include "../sculpt/sha256_of_file.h"

#include <haptic_sculpt/surface/read_surface.h>

namespace haptic_sculpt::window_program {

namespace {

constexpr std::size_t edits = 1000, moves = 100000; // room that is made for this many

} // namespace

Model::Model(const std::string& path_given, const std::string& log_given)
    : Scene(
          read_surface<Mesh>(path_given),
          [](const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
            return Mouse::map_for((upper - lower).stableNorm());
          },
          edits, moves, parameters::known_valid(true))
    , path(path_given)
    , log_path(log_given)
    , log(log_given, log_given.empty() ? "" : sculpt_program::sha256_of_file(path_given)) {
  note = log.resume(static_cast<Scene&>(*this));
  resumed = log.number_of_edits();
  changes_ = sculptor.visitor().changed.number();
  const std::uint64_t most_age = 20000; // ticks; a second half as long would be waited for, see Loop_thread::has_room
  const std::size_t entries_a_tick = 4; // in the mean; a mouse that drags makes one, a dab some fifty in sixteen ticks
  log.begin("the hand in sculpt_window", most_age, entries_a_tick);
}

} // namespace haptic_sculpt::window_program
