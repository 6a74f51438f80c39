// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_HAPTIC_LOOP_RUN_SAMPLES_H
#define HAPTIC_SCULPT_EXAMPLES_HAPTIC_LOOP_RUN_SAMPLES_H

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace haptic_sculpt::loop_program {

/// What a picture of a run shows: some thousands of its ticks, evenly spread, and the times of all.
class Run_samples {
public:
  struct Sample {
    double time, coupling, force; ///< s, N
    double port, dissipated;      ///< J, since the begin
    Eigen::Vector3d target, proxy;
    bool is_blocked;
  };
  static constexpr std::size_t most = 8192;
  /// Classes of CPU time, `classes_an_octave` from 100 ns on.
  static constexpr int classes_an_octave = 4, octaves = 20;

  Run_samples() { samples_.reserve(most); }

  /// Keeps each tick of a stride; the stride doubles whenever there is no room, and every second sample goes.
  void add(const Sample& sample, std::uint64_t cpu_ns) {
    ++times_[static_cast<std::size_t>(
        std::fmin(std::fmax(0, classes_an_octave * std::log2(static_cast<double>(cpu_ns) / 100)), times_.size() - 1))];
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
  std::vector<Event> events; ///< of the button

  const std::vector<Sample>& samples() const { return samples_; }
  /// Microseconds where a class begins, and how many ticks are in it.
  std::vector<Eigen::Vector2d> histogram() const {
    std::vector<Eigen::Vector2d> bars;
    for (std::size_t i = 0; i < times_.size(); ++i)
      bars.push_back({0.1 * std::exp2(static_cast<double>(i) / classes_an_octave), static_cast<double>(times_[i])});
    return bars;
  }

private:
  std::vector<Sample> samples_;
  std::array<std::uint64_t, classes_an_octave * octaves> times_{};
  std::uint64_t ticks_ = 0, stride_ = 1;
};

} // namespace haptic_sculpt::loop_program

#endif
