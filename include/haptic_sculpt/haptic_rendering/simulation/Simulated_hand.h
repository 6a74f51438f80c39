// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/device/leg_frame.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace haptic_sculpt {

/// A hand as a chain from the handle to the place where it wants to be: each stage is a mass with a spring and a damper
/// to the next mass, the last stage's to that place. The first mass moves with the handle, and may be 0. The hand
/// carries its own weight.
struct Simulated_hand {
  static constexpr int most_stages = 3; ///< room for this many
  /// A mass, and what ties it to the next.
  struct Stage {
    double mass = 0;      ///< kg; 0 for the first stage only
    double stiffness = 0; ///< N/m
    double damping = 0;   ///< N s/m
  };

  int stages = 0;                         ///< how many there are; check() wants 1 to most_stages
  std::array<Stage, most_stages> stage{}; ///< from the handle on; those beyond `stages` do not count

  /// Places and velocities of the masses that do not move with the handle, in three coordinates each.
  static constexpr int most_states = 6 * (most_stages - 1);
  using States = Eigen::Matrix<double, most_states, 1>; ///< of each such mass its place, m, then its velocity, m/s

  /// \throw Error naming the stage
  void check() const {
    if (stages < 1 || stages > most_stages)
      throw Error("a hand has from 1 to " + std::to_string(most_stages) + " stages, not " + std::to_string(stages));
    for (int i = 0; i < stages; ++i) {
      const auto is_length = [](double x) { return x >= 0 && x <= 1e6; };
      if (!is_length(stage[i].mass) || !is_length(stage[i].stiffness) || !is_length(stage[i].damping))
        throw Error("stage " + std::to_string(i) + " of the hand: mass, stiffness and damping must be from 0 to 1e6");
      if (i > 0 && stage[i].mass == 0)
        throw Error("stage " + std::to_string(i) + " of the hand needs a mass; only the first may have none");
    }
  }

  /// A light grip that is held still: 300 N/m and 3 N s/m. doc/results/haptics.md has the sources of all three.
  static Simulated_hand finger() { return {1, {{{0, 300, 3}}}}; }
  /// The grip of a stylus, 575 N/m and 1.3 N s/m, and the arm behind it, 0.21 kg, 175 N/m and 11 N s/m.
  static Simulated_hand arm() { return {2, {{{0, 575, 1.3}, {0.21, 175, 11}}}}; }
  /// An arm that grips a handle, as measured in one trial: 0.554 kg, 135 N/m, 6.45 N s/m.
  static Simulated_hand measured_arm() { return {1, {{{0.554, 135, 6.45}}}}; }
  /// The hand "finger", "arm" or "measured_arm"; none for another name.
  static std::optional<Simulated_hand> named(std::string_view name) {
    if (name == "finger")
      return finger();
    if (name == "arm")
      return arm();
    if (name == "measured_arm")
      return measured_arm();
    return std::nullopt;
  }

  /// At rest, every mass where the handle is.
  States at_rest(const Eigen::Vector3d& handle) const {
    States states = States::Zero();
    for (int i = 1; i < stages; ++i)
      states.segment<3>(6 * (i - 1)) = handle;
    return states;
  }

  /// What the hand does to the handle, and to itself.
  struct Effect {
    Eigen::Vector3d force; ///< on the handle, N
    States rates;          ///< by how much the states change a second
    double dissipated;     ///< by the dampers, W
  };
  /// \param wish, wish_velocity where the hand wants to be, and how that moves
  Effect effect(const States& states, const Eigen::Vector3d& handle, const Eigen::Vector3d& handle_velocity,
                const Eigen::Vector3d& wish, const Eigen::Vector3d& wish_velocity) const {
    Effect effect{Eigen::Vector3d::Zero(), States::Zero(), 0};
    Eigen::Vector3d place = handle, velocity = handle_velocity;
    for (int i = 0; i < stages; ++i) {
      const bool is_last = i + 1 == stages;
      const Eigen::Vector3d next = is_last ? wish : Eigen::Vector3d(states.segment<3>(6 * i));
      const Eigen::Vector3d next_velocity = is_last ? wish_velocity : Eigen::Vector3d(states.segment<3>(6 * i + 3));
      const Eigen::Vector3d pull = stage[i].stiffness * (next - place) + stage[i].damping * (next_velocity - velocity);
      effect.dissipated += stage[i].damping * (next_velocity - velocity).squaredNorm();
      if (i == 0)
        effect.force = pull;
      else
        effect.rates.segment<3>(6 * (i - 1) + 3) += pull / stage[i].mass;
      if (!is_last) {
        effect.rates.segment<3>(6 * i) = next_velocity;
        effect.rates.segment<3>(6 * i + 3) -= pull / stage[i + 1].mass;
      }
      place = next, velocity = next_velocity;
    }
    return effect;
  }
};

} // namespace haptic_sculpt
