// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace haptic_sculpt::loop_program {

/// What a picture of a run shows: some thousands of its ticks, evenly spread.
class Run_samples {
public:
  struct Sample {
    Eigen::Vector3d target, proxy;
    bool is_blocked;
  };
  static constexpr std::size_t most = 8192;

  Run_samples() { samples_.reserve(most); }

  /// Keeps each tick of a stride; the stride doubles whenever there is no room, and every second sample goes.
  void add(const Sample& sample) {
    if (ticks_++ % stride_ != 0)
      return;
    if (samples_.size() == most) {
      for (std::size_t i = 0; i < most / 2; ++i)
        samples_[i] = samples_[2 * i];
      samples_.resize(most / 2);
      stride_ *= 2;
      if ((ticks_ - 1) % stride_ != 0)
        return;
    }
    samples_.push_back(sample);
  }

  struct Event {
    Eigen::Vector3d place;
    std::string what;
  };
  static constexpr std::size_t most_events = 2000; ///< more hide the mesh, and each is a ball of 400 triangles
  std::vector<Event> events;                       ///< of the button, the first of them

  const std::vector<Sample>& samples() const { return samples_; }

private:
  std::vector<Sample> samples_;
  std::uint64_t ticks_ = 0, stride_ = 1;
};

} // namespace haptic_sculpt::loop_program
