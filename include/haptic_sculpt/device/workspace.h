// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/conditioning.h>
#include <haptic_sculpt/device/forward_kinematics.h>
#include <haptic_sculpt/device/general_inverse.h>
#include <vector>

namespace haptic_sculpt {

/// What a pose must keep to belong to the usable workspace. Dimensionless or radians.
template <class S> struct Workspace_limits {
  S least_transmission =
      S(0.1); ///< |sin| of the knee angle times cos gamma: below it a motor's torque explodes into link force
  S greatest_tilt = S(1);           ///< of the platform's axis from the vertical, 0 to pi, rad; general form
  S greatest_condition = S(50);     ///< of the velocity equations
};

/// Which limits a pose breaks; none: it is inside.
struct Workspace_verdict {
  bool joint_limits = false, ///< a joint angle is outside of its limits
      knees = false,         ///< the least transmission is too small; not looked at where the pose is singular
      tilt = false,          ///< the platform's axis leans too far; never in the di-tetrahedral form
      condition = false;     ///< the condition number is too large, or the pose is singular
  bool inside() const { return !(joint_limits || knees || tilt || condition); } ///< Whether no limit is broken.
};

/// Tests a pose against joint limits and workspace limits. A singular pose breaks `condition`.
template <class S>
Workspace_verdict workspace_verdict(const Device_parameters<S>& parameters, const Device_pose<S>& pose,
                                    const Workspace_limits<S>& limits = Workspace_limits<S>()) {
  using std::cos;
  Workspace_verdict verdict;
  verdict.joint_limits = !within_joint_limits(parameters, pose.theta);
  const Outcome<Conditioning<S>> c = conditioning(parameters, pose);
  verdict.condition = !c || c->constraint_condition > limits.greatest_condition;
  verdict.knees = c && c->least_transmission < limits.least_transmission;
  verdict.tilt = pose.orientation(2, 2) < cos(limits.greatest_tilt);
  return verdict;
}

/// The greatest force, N, the joint torque limits allow at this pose in *every* direction: min over joints of limit /
/// |column of J|. Moments are taken as zero. A joint that moves nothing sets no limit; if none does the answer is
/// infinite.
template <class S> S isotropic_force(const Device_parameters<S>& parameters, const Device_jacobian<S>& jacobian) {
  S least = std::numeric_limits<S>::infinity();
  for (int joint = 0; joint < 3; ++joint) {
    const S force = parameters.torque_limit() / jacobian.linear.col(joint).norm();
    least = force < least ? force : least;
  }
  return least;
}

/// One reachable pose of a sampled workspace.
template <class S> struct Workspace_sample {
  Device_pose<S> pose;       ///< in the home mode; of a mirror design the mirror pose, which may be below its elbows
  Workspace_verdict verdict; ///< which limits it breaks: samples need not be inside
  S condition,               ///< number, of the velocity equations
      force;                 ///< isotropic force, N
};

/// Samples the workspace: every triple of `per_joint` (>= 2) equally spaced angles between the joint limits that has a
/// regular pose by `forward(parameters, theta)`. Allocates; cost per_joint^3 times some microseconds.
/// \param forward forward_kinematics(); where that is `undecided` at some angles forward_by_all_modes() finds more
/// poses
template <class S, class Forward>
std::vector<Workspace_sample<S>> sample_workspace(const Device_parameters<S>& parameters, int per_joint,
                                                  const Workspace_limits<S>& limits, const Forward& forward) {
  std::vector<Workspace_sample<S>> samples;
  const Device_vector<S> low = parameters.least_angle(), span = parameters.greatest_angle() - low;
  for (int i = 0; i < per_joint; ++i)
    for (int j = 0; j < per_joint; ++j)
      for (int k = 0; k < per_joint; ++k) {
        const Device_vector<S> fraction(S(i) / S(per_joint - 1), S(j) / S(per_joint - 1), S(k) / S(per_joint - 1));
        const Device_vector<S> theta = (low + span.cwiseProduct(fraction)).cwiseMin(parameters.greatest_angle());
        const Outcome<Device_pose<S>> pose = forward(parameters, theta);
        if (!pose)
          continue;
        const Outcome<Device_jacobian<S>> map = jacobian(parameters, *pose);
        const Outcome<Conditioning<S>> c = conditioning(parameters, *pose);
        if (map && c)
          samples.push_back({*pose, workspace_verdict(parameters, *pose, limits), c->constraint_condition,
                             isotropic_force(parameters, *map)});
      }
  return samples;
}

/// The same by forward_kinematics().
template <class S>
std::vector<Workspace_sample<S>> sample_workspace(const Device_parameters<S>& parameters, int per_joint,
                                                  const Workspace_limits<S>& limits = Workspace_limits<S>()) {
  return sample_workspace(parameters, per_joint, limits,
                          [](const auto& p, const auto& theta) { return forward_kinematics(p, theta); });
}

} // namespace haptic_sculpt
