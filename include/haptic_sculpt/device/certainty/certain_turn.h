// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/certainty/Position_equations.h>
#include <haptic_sculpt/device/linear_algebra/Small_lu.h>
#include <haptic_sculpt/device/platform_closure.h>

/// \file
/// What is certain of a pose of the general form while the platform's centre moves straight.

namespace haptic_sculpt::internal {

/// A size of turns: the largest joint angle, by how far it moves an elbow, or part of a rotation vector of the
/// platform, by how far it moves a joint of the platform, and l2 more, in units of l2.
template <class S>
struct Turn_norm {
  S of_joint, of_platform; ///< for 1 rad

  explicit Turn_norm(const Device_parameters<S>& parameters)
      : of_joint(parameters.primary_length() * parameters.inverse_secondary_length())
      , of_platform(S(1) + parameters.platform_radius() * parameters.inverse_secondary_length()) {}

  /// From one pose to another.
  S operator()(const Device_pose<S>& from, const Device_pose<S>& to) const {
    using std::atan2;
    const Device_matrix<S> turn = to.orientation * from.orientation.transpose();
    const Device_vector<S> sines =
        Device_vector<S>(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)) / S(2);
    const S sine = sines.norm(), angle = atan2(sine, S((turn.trace() - S(1)) / S(2)));
    const S part = sine > S(0) ? S(angle * largest_magnitude(sines) / sine) : angle;
    const S joints = of_joint * largest_magnitude(Device_vector<S>(to.theta - from.theta)),
            platform = of_platform * part;
    return joints > platform ? joints : platform;
  }
};

/// How far a pose turns at most, by Turn_norm, where the centre moves straight from that of `from` to `position`, if it
/// is certain that no singular pose is on that way; else infinite. At the end the pose is the only one within this of
/// `from`. By a contraction that holds at every place of the way (doc/proofs/device.md).
template <class S>
S certain_turn(const Device_parameters<S>& parameters, const Device_vector<S>& position, const Device_pose<S>& from) {
  using std::sqrt;
  const Turn_norm<S> norm(parameters);
  const S scale = parameters.inverse_secondary_length(), l1 = parameters.primary_length() * scale,
          r = parameters.platform_radius() * scale;
  const S moved = (position - from.position).norm() * scale;
  const Position_equations<S> equations(parameters, position, from);
  // Of an equation, which is about 1, in units of l2: the places in it are rounded in proportion to how far they are
  // from the origin, and subtracted, multiplied and summed by eight roundings at most.
  const S rounding =
      S(8) * std::numeric_limits<S>::epsilon() * (S(1) + l1 + r + (position.norm() + parameters.base_radius()) * scale);
  Small_lu<S, 6> lu;
  lu.compute(equations.derivative);
  Eigen::Matrix<S, 6, 6> inverse; // its results in the units of the norm
  for (int k = 0; k < 6; ++k)
    inverse.col(k) = lu.solve(Eigen::Matrix<S, 6, 1>::Unit(k));
  inverse.template topRows<3>() *= norm.of_joint;
  inverse.template bottomRows<3>() *= norm.of_platform;
  // Through the inverse, of numbers that bound those of each equation.
  const auto weighed = [&](const S& of_lengths, const S& of_right_angles) {
    Eigen::Matrix<S, 6, 1> bounds;
    bounds << of_lengths, of_lengths, of_lengths, of_right_angles, of_right_angles, of_right_angles;
    return S((inverse.cwiseAbs() * bounds).maxCoeff());
  };
  // Of a turn of 1 by the norm: the joint angle, and the length of the rotation vector.
  const S joint = S(1) / norm.of_joint, turn = sqrt(S(3)) / norm.of_platform;
  // What is left of the equations anywhere on the way: lengths are of second degree in the place, right angles linear.
  const S first = S((inverse * equations.f).cwiseAbs().maxCoeff()) + weighed(moved * moved / S(8) + rounding, rounding);
  const S turned = S(2) * first;
  const S link_rate = l1 * joint + r * turn;
  const S drift = weighed(moved * link_rate, moved * turn); // of the derivative, by the move of the centre
  const S link = equations.link_length.maxCoeff() + moved + turned * link_rate,
          arm = equations.arm_length.maxCoeff() + moved + turned * l1 * joint;
  const S curvature = weighed(link_rate * link_rate + link * (l1 * joint * joint + r * turn * turn),
                              l1 * joint * joint + S(2) * l1 * joint * turn + arm * turn * turn);
  return drift + curvature * turned <= S(0.5) ? turned : std::numeric_limits<S>::infinity();
}

} // namespace haptic_sculpt::internal
