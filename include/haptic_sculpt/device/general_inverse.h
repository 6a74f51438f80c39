// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/ditetrahedral_kinematics.h>
#include <haptic_sculpt/device/general_kinematics.h>
#include <haptic_sculpt/device/linear_algebra/Small_lu.h>

#include <vector>

/// \file
/// Inverse kinematics of the general form from the platform's position: joint angles and platform rotation together are
/// six unknowns for the three link lengths and the three right angles between links and platform axes.

namespace haptic_sculpt {
namespace internal {

/// The six equations at a fixed platform position, in units of l2: of each leg (|link|^2 - 1) / 2 and arm . axis, with
/// the arm from the centre to the elbow, and their derivative by the joint angles and a rotation vector of the
/// platform.
template <class S>
struct Position_equations {
  Eigen::Matrix<S, 6, 1> f;                 ///< of the three legs their lengths, then their right angles
  Eigen::Matrix<S, 6, 6> derivative;        ///< by the three joint angles, then the rotation vector
  Device_vector<S> link_length, arm_length; ///< of each leg, in l2

  /// \param pose its elbows are those of its angles
  Position_equations(const Device_parameters<S>& parameters, const Device_vector<S>& position,
                     const Device_pose<S>& pose) {
    using std::sqrt;
    const S scale = parameters.inverse_secondary_length(), r = parameters.platform_radius() * scale;
    derivative.setZero();
    for (int i = 0; i < 3; ++i) {
      const Device_vector<S> axis = pose.orientation * Leg_frame<S>::tangential(i);
      const Device_vector<S> rate = pose.elbow_rate(parameters, i) * scale,
                             arm = (pose.elbows.col(i) - position) * scale;
      const Device_vector<S> lever = r * (pose.orientation * Leg_frame<S>::radial(i)), link = lever - arm;
      const S square = link.squaredNorm();
      link_length[i] = sqrt(square), arm_length[i] = sqrt(S(arm.squaredNorm()));
      f[i] = (square - S(1)) / S(2);
      f[3 + i] = arm.dot(axis);
      derivative(i, i) = -link.dot(rate);
      derivative(3 + i, i) = rate.dot(axis);
      derivative.template block<1, 3>(i, 3) = lever.cross(link).transpose();
      derivative.template block<1, 3>(3 + i, 3) = axis.cross(arm).transpose();
    }
  }
};

/// Newton's method at a fixed platform position from the angles and rotation in `pose`; steps are cut to 0.3 rad. On
/// success the pose is complete. False if it does not settle within `most_iterations`.
template <class S>
bool inverse_newton(const Device_parameters<S>& parameters, const Device_vector<S>& position, Device_pose<S>& pose,
                    int most_iterations) {
  using std::abs;
  const S epsilon = std::numeric_limits<S>::epsilon(), scale = parameters.inverse_secondary_length(),
          r = parameters.platform_radius();
  S previous(0);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    if (!place_elbows(parameters, Device_vector<S>(pose.theta), pose))
      return false;
    const Position_equations<S> equations(parameters, position, pose);
    Small_lu<S, 6> lu;
    lu.compute(equations.derivative);
    Eigen::Matrix<S, 6, 1> step = lu.solve(-equations.f);
    S length = step.cwiseAbs().maxCoeff();
    if (!is_finite(length) || !all_finite(step))
      return false;
    if (length > S(0.3))
      step *= S(0.3) / length, length = S(0.3);
    pose.theta += step.template head<3>();
    // Cayley's rotation keeps Q orthogonal.
    const Device_vector<S> half = step.template tail<3>() / S(2);
    for (int column = 0; column < 3; ++column) {
      const Device_vector<S> before = pose.orientation.col(column), turned = half.cross(before);
      pose.orientation.col(column) = before + (S(2) / (S(1) + half.squaredNorm())) * (turned + half.cross(turned));
    }
    if (length <= S(8) * epsilon || (length * length <= epsilon && iteration > 0 && !(length < previous / S(2)))) {
      pose.orientation.col(0).normalize();
      pose.orientation.col(1) =
          (pose.orientation.col(1) - pose.orientation.col(0).dot(pose.orientation.col(1)) * pose.orientation.col(0))
              .normalized();
      pose.orientation.col(2) = pose.orientation.col(0).cross(pose.orientation.col(1));
      place_elbows(parameters, Device_vector<S>(pose.theta), pose);
      pose.mode = 0;
      pose.position = position;
      S residual(0);
      for (int i = 0; i < 3; ++i) {
        const Device_vector<S> radial = pose.orientation * Leg_frame<S>::radial(i);
        pose.joints.col(i) = position + r * radial;
        const Device_vector<S> link = (pose.joints.col(i) - pose.elbows.col(i)) * scale;
        const S square_error = abs(S(link.squaredNorm() - S(1)));
        residual = square_error > residual ? square_error : residual;
        pose.cos_phi[i] = -link.dot(radial);
        pose.sin_phi[i] = -link.dot(pose.orientation.col(2));
        const S across = abs(S(link.dot(pose.orientation * Leg_frame<S>::tangential(i))));
        residual = across > residual ? across : residual;
        pose.links.col(i) = link;
      }
      return residual <= S(256) * epsilon * (S(1) + position.norm() * scale);
    }
    previous = length;
  }
  return false;
}

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
  // Of differences of places, whose squares are about 1.
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
  const S drift =
      weighed(moved * (l1 * joint + r * turn), moved * turn); // of the derivative, by the move of the centre
  const S link_rate = l1 * joint + r * turn, link = equations.link_length.maxCoeff() + moved + turned * link_rate,
          arm = equations.arm_length.maxCoeff() + moved + turned * l1 * joint;
  const S curvature = weighed(link_rate * link_rate + link * (l1 * joint * joint + r * turn * turn),
                              l1 * joint * joint + S(2) * l1 * joint * turn + arm * turn * turn);
  return drift + curvature * turned <= S(0.5) ? turned : std::numeric_limits<S>::infinity();
}

/// Reduces angles to (-pi, pi], or to the nearest turn that is within the joint limits.
template <class S>
void reduce_angles(const Device_parameters<S>& parameters, Device_vector<S>& theta) {
  using std::acos;
  using std::atan2;
  using std::ceil;
  using std::cos;
  using std::sin;
  const S turn = S(2) * S(acos(S(-1)));
  for (int leg = 0; leg < 3; ++leg) {
    if (theta[leg] > S(3.1415926) || theta[leg] < S(-3.1415926))
      theta[leg] = atan2(S(sin(theta[leg])), S(cos(theta[leg])));
    const S least = parameters.least_angle()[leg], greatest = parameters.greatest_angle()[leg];
    const S up = theta[leg] + turn * S(ceil(S((least - theta[leg]) / turn)));
    const S down = theta[leg] - turn * S(ceil(S((theta[leg] - greatest) / turn)));
    if (theta[leg] < least && up <= greatest)
      theta[leg] = up;
    else if (theta[leg] > greatest && down >= least)
      theta[leg] = down;
  }
}

} // namespace internal

/// Whether the platform's centre is on the side of the elbow plane its normal (B_1 - B_0) x (B_2 - B_0) points to.
template <class S> bool platform_above_elbows(const Device_pose<S>& pose) {
  const Device_vector<S> a = pose.elbows.col(1) - pose.elbows.col(0), b = pose.elbows.col(2) - pose.elbows.col(0);
  return a.cross(b).dot(pose.position - pose.elbows.col(0)) > S(0);
}

/// Within the joint limits, which count angles as given (not modulo a turn).
template <class S> bool within_joint_limits(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  return (theta.array() >= parameters.least_angle().array()).all() &&
         (theta.array() <= parameters.greatest_angle().array()).all();
}

template <class S>
std::vector<Device_pose<S>> general_inverse_all(const Device_parameters<S>& parameters,
                                                const Device_vector<S>& position);

/// The pose with the platform's centre at `position`, reached from `previous` by moving the centre straight there. Its
/// joint angles are from -pi to pi, or of the nearest turn within the joint limits.
///
/// Of steps that are certain to keep the branch (doc/proofs/device.md). Failures: `not_finite`; `unreachable`: the way
/// meets a singular pose, as at the edge of the workspace, shortfall the distance left, m. Cost: 5 microseconds for a
/// tenth of a millimetre, 0.1 to 1 ms for a centimetre, both in the mean; up to 0.1 s beside a singular pose. No
/// allocation.
template <class S>
Outcome<Device_pose<S>> general_inverse(const Device_parameters<S>& parameters, const Device_vector<S>& position,
                                        const Device_pose<S>& previous) {
  using namespace internal;
  Outcome<Device_pose<S>> outcome;
  if (!all_finite(position)) {
    outcome.fail(Device_status::not_finite, S(0));
    return outcome;
  }
  const Device_vector<S> start = previous.position, way = position - start;
  const Turn_norm<S> norm(parameters);
  constexpr int most_steps = 20000;
  const S least_step(1e-7); // of the way: nearer to a singular pose is at it
  Device_pose<S> reached = previous;
  S done(0), step(1);
  for (int k = 0; k < most_steps && done < S(1); ++k) {
    const bool last = done + step >= S(1);
    Device_pose<S> next = reached;
    const Device_vector<S> target = last ? position : Device_vector<S>(start + (done + step) * way);
    const S turned = certain_turn(parameters, target, reached);
    if (is_finite(turned) && inverse_newton(parameters, target, next, 12) && norm(reached, next) <= turned) {
      reached = next;
      done = last ? S(1) : done + step;
      step *= S(2);
    } else {
      step /= S(2);
      if (step < least_step)
        break;
    }
  }
  if (done < S(1)) {
    outcome.fail(Device_status::unreachable, (S(1) - done) * way.stableNorm());
    return outcome;
  }
  outcome.value_to_fill() = reached;
  reduce_angles(parameters, outcome.value_to_fill().theta);
  outcome.succeed();
  return outcome;
}

/// All poses with the platform's centre at `position`, within the joint limits and with the platform above its elbows.
///
/// By Newton's method from a grid of platform rotations and all eight knee choices; a search, not a proof of
/// completeness, compared with random multi-starts in the tests. Of angles that differ by a turn one is given. Tens of
/// milliseconds, allocates: not for a tick. Empty if there is none.
template <class S>
std::vector<Device_pose<S>> general_inverse_all(const Device_parameters<S>& parameters,
                                                const Device_vector<S>& position) {
  using namespace internal;
  using std::cos;
  using std::sin;
  std::vector<Device_pose<S>> found;
  if (!all_finite(position))
    return found;
  // Tilts to 2.1 rad in twelve directions, turns to 2 rad about the axis: half as dense a grid lost one solution in
  // twenty.
  for (int ring = 0; ring < 7; ++ring)
    for (int sector = 0; sector < (ring == 0 ? 1 : 12); ++sector)
      for (int twist = -4; twist <= 4; ++twist)
        for (int knees = 0; knees < 8; ++knees) {
          const S tilt = S(0.35) * S(ring), direction = S(0.5235987755982988) * S(sector), spin = S(0.5) * S(twist);
          Device_pose<S> pose;
          pose.orientation = (Eigen::AngleAxis<S>(tilt, Device_vector<S>(cos(direction), sin(direction), S(0))) *
                              Eigen::AngleAxis<S>(spin, Device_vector<S>::UnitZ()))
                                 .toRotationMatrix();
          bool usable = true;
          for (int leg = 0; leg < 3; ++leg) {
            using std::atan2;
            using std::sqrt;
            const Device_vector<S> joint =
                position + parameters.platform_radius() * (pose.orientation * Leg_frame<S>::radial(leg));
            const auto t = leg_triangle(parameters, joint, leg);
            usable = usable && is_finite(t.one_minus) && is_finite(t.one_plus);
            const S low = t.one_minus > S(0) ? t.one_minus : S(0), high = t.one_plus > S(0) ? t.one_plus : S(0);
            const S half_opening = S(2) * atan2(S(sqrt(low)), S(sqrt(high)));
            pose.theta[leg] = S(atan2(t.z, t.x)) + (knees >> leg & 1 ? half_opening : S(-half_opening));
          }
          if (!usable || !inverse_newton(parameters, position, pose, 40))
            continue;
          reduce_angles(parameters, pose.theta);
          if (!within_joint_limits(parameters, pose.theta) || !platform_above_elbows(pose))
            continue;
          bool known = false;
          for (const Device_pose<S>& other : found)
            known = known || ((other.theta - pose.theta).cwiseAbs().maxCoeff() < mode_separation<S>() &&
                              (other.orientation - pose.orientation).cwiseAbs().maxCoeff() < mode_separation<S>());
          if (!known)
            found.push_back(pose);
        }
  return found;
}

/// The mirror case's inverse in closed form: every elbow lies in the plane that halves the way from the base's centre
/// to p, `p.B_i = |p|^2 / 2`, an equation in theta_i alone with two solutions. Same fields as the di-tetrahedral
/// inverse.
///
/// Failures: `not_finite`; `singular`: p at the base's centre; `unreachable`, shortfall the largest |cosine| - 1 of a
/// leg, 0 where p has no part in a leg's plane. \pre `parameters.is_mirror()`
template <class S>
Outcome<Ditetrahedral_inverse<S>> mirror_inverse(const Device_parameters<S>& parameters,
                                                 const Device_vector<S>& position) {
  using std::atan2;
  using std::sqrt;
  Outcome<Ditetrahedral_inverse<S>> outcome;
  Ditetrahedral_inverse<S> inverse;
  const S square = position.squaredNorm();
  const bool finite = internal::is_finite(S(S(2) * square)); // twice: a leg's part of it may be rounded up
  if (!finite || square == S(0)) {
    outcome.fail(finite ? Device_status::singular : Device_status::not_finite, S(0));
    return outcome;
  }
  S shortfall(0);
  for (int leg = 0; leg < 3; ++leg) {
    const S x = Leg_frame<S>::along_radial(leg, position), z = position[2], length = sqrt(x * x + z * z);
    S cosine = (square / S(2) - parameters.base_radius() * x) / (parameters.primary_length() * length);
    const S rounding = internal::rounding_of_leg<S>();
    if (cosine > S(1) && cosine < S(1) + rounding)
      cosine = S(1);
    if (cosine < S(-1) && cosine > S(-1) - rounding)
      cosine = S(-1);
    const S least = cosine > S(0) ? S(1 - cosine) : S(1 + cosine);
    inverse.one_minus_cosine[leg] = least;
    inverse.leg_reaches[leg] = least >= S(0);
    inverse.minus[leg] = inverse.plus[leg] = S(0);
    if (!inverse.leg_reaches[leg]) {
      shortfall = -least > shortfall ? S(-least) : shortfall;
      continue;
    }
    const S centre = atan2(z, x), half_opening = atan2(S(sqrt((S(1) - cosine) * (S(1) + cosine))), cosine);
    inverse.minus[leg] = centre - half_opening;
    inverse.plus[leg] = centre + half_opening;
  }
  if (inverse.leg_reaches[0] && inverse.leg_reaches[1] && inverse.leg_reaches[2])
    outcome.succeed();
  else
    outcome.fail(Device_status::unreachable, shortfall);
  outcome.value_to_fill() = inverse;
  return outcome;
}

} // namespace haptic_sculpt
