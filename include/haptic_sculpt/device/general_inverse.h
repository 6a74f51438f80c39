// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/certainty/certain_turn.h>
#include <haptic_sculpt/device/ditetrahedral_kinematics.h>
#include <haptic_sculpt/device/general_kinematics.h>

#include <vector>

/// \file
/// Inverse kinematics of the general form from the platform's position: joint angles and platform rotation together are
/// six unknowns for the three link lengths and the three right angles between links and platform axes.

namespace haptic_sculpt {
namespace internal {

/// Newton's method at a fixed platform position from the angles and rotation in `pose`; steps are cut to 0.3 rad. On
/// success the pose is complete. False if it does not settle within `most_iterations`.
template <class S>
bool inverse_newton(const Device_parameters<S>& parameters, const Device_vector<S>& position, Device_pose<S>& pose,
                    int most_iterations) {
  using std::abs;
  const S epsilon = std::numeric_limits<S>::epsilon(), scale = parameters.inverse_secondary_length(),
          r = parameters.platform_radius();
  // No units. A step of a few roundings is none; of more, its square shows that the next one would be none. What a
  // pose may miss the closure by: 16 roundings of each of its terms, and room.
  const S settled = S(8) * epsilon, closure_rounding = S(256) * epsilon;
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
    if (length <= settled || (length * length <= epsilon && iteration > 0 && !(length < previous / S(2)))) {
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
      return residual <= closure_rounding * (S(1) + position.norm() * scale);
    }
    previous = length;
  }
  return false;
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
  constexpr int most_steps = 20000; // tried: some ten milliseconds
  // Part of the way: the shortfall is known no better, and a singular pose that is nearer than some of these is met.
  const S least_step(1e-7);
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
            known = known || ((other.cos_theta - pose.cos_theta).cwiseAbs().maxCoeff() < mode_separation<S>() &&
                              (other.sin_theta - pose.sin_theta).cwiseAbs().maxCoeff() < mode_separation<S>() &&
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
    const S centre = atan2(internal::without_sign_of_zero(z), x),
            half_opening = atan2(S(sqrt((S(1) - cosine) * (S(1) + cosine))), cosine);
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
