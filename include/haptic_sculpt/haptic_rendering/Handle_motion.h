// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/conditioning.h>
#include <haptic_sculpt/device/forward_kinematics.h>
#include <haptic_sculpt/haptic_rendering/Velocity_estimate.h>

namespace haptic_sculpt {

/// Where the handle is and how it moves, from joint angles tick by tick. The assembly mode is carried on.
class Handle_motion {
public:
  /// \param start a pose near the first angles; those after a restart() are sought from it, too, where the last pose
  /// leads to none
  Handle_motion(const Device_parameters<double>& parameters, const Device_pose<double>& start, double tick)
      : parameters_(parameters), start_(start), pose_(start), tick_(tick), velocity_(tick) {}

  /// \return the condition number of the position Jacobian; infinite where there is none, and the last pose stays
  double follow(const Eigen::Vector3d& theta) { return follow(theta, tick_); }
  /// The same where the tick has truly taken so long. \param elapsed s, > 0; does not count at the first angles
  double follow(const Eigen::Vector3d& theta, double elapsed) {
    auto pose = forward_kinematics(parameters_, theta, pose_);
    if (!pose && is_first_)
      pose = forward_kinematics(parameters_, theta, start_);
    if (!pose)
      return std::numeric_limits<double>::infinity();
    const auto map = haptic_sculpt::jacobian(parameters_, *pose);
    if (!map)
      return std::numeric_limits<double>::infinity();
    joint_step_ = is_first_ ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(theta - pose_.theta);
    step_ = is_first_ ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(pose->position - pose_.position);
    has_step_ = !is_first_, is_first_ = false;
    pose_ = *pose, jacobian_ = *map;
    velocity_.add(step_, has_step_ ? elapsed : tick_);
    const auto conditioning = translation_conditioning(jacobian_);
    condition_ = conditioning.condition, greatest_ = conditioning.greatest;
    return condition_;
  }

  const Device_parameters<double>& parameters() const { return parameters_; } ///< of the device, a copy
  const Device_pose<double>& pose() const { return pose_; } ///< the last that was found; the start before
  /// At pose(); 0 before a pose was found.
  const Device_jacobian<double>& jacobian() const { return jacobian_; }
  const Eigen::Vector3d& position() const { return pose_.position; } ///< of the handle, m, in axes of the device
  const Eigen::Vector3d& step() const { return step_; }              ///< since the last tick, m
  const Eigen::Vector3d& joint_step() const { return joint_step_; }  ///< since the last tick, rad
  const Eigen::Vector3d& velocity() const { return velocity_.value(); } ///< of the handle, low-passed, m/s
  double condition() const { return condition_; } ///< cond(J) of the last pose found; infinite before
  double greatest() const { return greatest_; }   ///< sigma_max(J) of the last pose found, m/rad; 0 before
  /// Whether the last angles were not the first: then the steps above are steps.
  bool has_step() const { return has_step_; }

  /// The next angles are taken as they are: no step leads there. Where no straight way of the joints does, neither from
  /// the last pose nor from the start, the hand has to be led back.
  void restart() { is_first_ = true, velocity_.reset(); }

private:
  Device_parameters<double> parameters_;
  Device_pose<double> start_, pose_;
  Device_jacobian<double> jacobian_{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  double tick_;
  Velocity_estimate velocity_;
  Eigen::Vector3d step_ = Eigen::Vector3d::Zero(), joint_step_ = Eigen::Vector3d::Zero();
  double condition_ = std::numeric_limits<double>::infinity(), greatest_ = 0;
  bool is_first_ = true, has_step_ = false;
};

} // namespace haptic_sculpt
