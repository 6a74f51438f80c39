// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/certainty/elbow_way.h>
#include <haptic_sculpt/device/platform_closure.h>

/// \file
/// Forward kinematics of the general form: warm (continuing a pose), from a seed, and cold (the home mode).
/// What these leave undecided, forward_by_all_modes.h decides.

namespace haptic_sculpt {
namespace internal {

/// Completes a pose whose elbows and link angles are known: the one rotation and translation that lay the elbow
/// triangle, as seen from the platform, on the elbow triangle in the world. False where the elbows are on a line.
template <class S>
inline bool place_platform(const Device_parameters<S>& parameters, const Link_angles<S>& x, Device_pose<S>& pose) {
  using std::sqrt;
  const S& l2 = parameters.secondary_length();
  const S& r = parameters.platform_radius();
  pose.mode = 0;
  pose.cos_phi = x.cosine;
  pose.sin_phi = x.sine;
  Device_matrix<S> seen;
  for (int leg = 0; leg < 3; ++leg)
    seen.col(leg) = Leg_frame<S>::in_leg_plane(leg, r + l2 * x.cosine[leg], l2 * x.sine[leg]);
  const Device_vector<S> world_a = pose.elbows.col(1) - pose.elbows.col(0),
                         world_b = pose.elbows.col(2) - pose.elbows.col(0);
  const Device_vector<S> seen_a = seen.col(1) - seen.col(0), seen_b = seen.col(2) - seen.col(0);
  const Device_vector<S> world_n = world_a.cross(world_b), seen_n = seen_a.cross(seen_b);
  const S world_aa = world_a.squaredNorm(), world_nn = world_n.squaredNorm(), seen_aa = seen_a.squaredNorm(),
          seen_nn = seen_n.squaredNorm();
  if (!spans_a_plane<S>(world_nn, world_aa, world_b.squaredNorm(),
                        parameters.base_radius() + parameters.primary_length()) ||
      !spans_a_plane<S>(seen_nn, seen_aa, seen_b.squaredNorm(), r + l2))
    return false;
  // Orthonormal frames (a, n x a, n) of both triangles; the scales of the first and last are folded into the products.
  const Device_vector<S> world_m = world_n.cross(world_a), seen_m = seen_n.cross(seen_a);
  // Roots first: a product of them is in range wherever the lengths are.
  const S along = S(1) / (sqrt(world_aa) * sqrt(seen_aa)), normal = S(1) / (sqrt(world_nn) * sqrt(seen_nn)),
          across = along * normal;
  pose.orientation.noalias() = (world_a * along) * seen_a.transpose() + (world_n * normal) * seen_n.transpose() +
                               (world_m * across) * seen_m.transpose();
  const Device_vector<S> world_centre = pose.elbows.col(0) + pose.elbows.col(1) + pose.elbows.col(2);
  const Device_vector<S> seen_centre = seen.col(0) + seen.col(1) + seen.col(2);
  const Device_vector<S> turned_centre = pose.orientation * seen_centre;
  pose.position = (world_centre - turned_centre) / S(3);
  for (int leg = 0; leg < 3; ++leg) {
    const Device_vector<S> radial = pose.orientation * Leg_frame<S>::radial(leg);
    pose.joints.col(leg) = pose.position + r * radial;
    pose.links.col(leg) = -(x.cosine[leg] * radial + x.sine[leg] * pose.orientation.col(2));
  }
  return all_finite(pose.position) && all_finite(pose.orientation);
}

/// Whether the mode x is certain to go on, without a singular pose, while the joints turn straight from those of the
/// elbows `from` to those of `to`, none by more than `turned` rad. If so, x is the link angles there; else it stays.
template <class S>
inline bool certified_step(const Device_parameters<S>& parameters, const Device_matrix<S>& from,
                           const Device_matrix<S>& to, const S& turned, Link_angles<S>& x) {
  Link_angles<S> next = x;
  next.normalize();
  if (!elbows_stay_off_a_line(parameters, from, turned) ||
      certified_newton(Platform_closure<S>(parameters, to), next, strayed_separation(parameters, turned)) !=
          Newton_end::converged)
    return false;
  x = next;
  return true;
}

/// Of follow_mode(): a turn of all joints takes some hundred, a singular pose on the way some hundred more.
constexpr int most_tries = 4000;

/// Follows the mode x from `from` to `to` along the straight way between the two triples of joint angles, in certified
/// steps. Returns the part of the way done: 1 on success. The steps shrink towards a singular pose; no more than
/// `most_tries` are made.
template <class S>
inline S follow_mode(const Device_parameters<S>& parameters, const Device_vector<S>& from, const Device_vector<S>& to,
                     Link_angles<S>& x) {
  const S turned = largest_magnitude(Device_vector<S>(to - from));
  S done(0), step(0.5);
  Device_pose<S> here, there;
  if (!place_elbows(parameters, from, here))
    return done;
  for (int k = 0; k < most_tries; ++k) {
    const bool last = done + step >= S(1);
    const Device_vector<S> theta = last ? to : Device_vector<S>(from + (done + step) * (to - from));
    place_elbows(parameters, theta, there);
    if (certified_step(parameters, here.elbows, there.elbows, S((last ? S(1) - done : step) * turned), x)) {
      if (last) {
        x.normalize();
        return S(1);
      }
      here.elbows = there.elbows;
      done += step;
      step *= S(2);
    } else {
      step /= S(2);
      if (step < S(8) * std::numeric_limits<S>::epsilon())
        break;
    }
  }
  return done;
}

template <class S>
S mean_of(const Device_vector<S>& theta) {
  return (theta[0] + theta[1] + theta[2]) / S(3);
}

/// The symmetric pose at the mean angle: its link angles, platform above the elbows. False if the links cannot close
/// there.
template <class S> bool symmetric_home(const Device_parameters<S>& parameters, const S& theta, Link_angles<S>& x) {
  using std::cos;
  using std::sqrt;
  const S c = (parameters.base_radius() + parameters.primary_length() * cos(theta) - parameters.platform_radius()) *
              parameters.inverse_secondary_length();
  if (!(c > S(-1) && c < S(1)))
    return false;
  x.cosine.setConstant(c);
  x.sine.setConstant(-sqrt((S(1) - c) * (S(1) + c)));
  return true;
}

template <class S>
void finish_general(const Device_parameters<S>& parameters, const Link_angles<S>& x, Outcome<Device_pose<S>>& outcome) {
  if (place_platform(parameters, x, outcome.value_to_fill()))
    outcome.succeed();
  else
    outcome.fail(Device_status::singular, S(0));
}

} // namespace internal

/// The pose at `theta` reached from `previous` by moving the joints straight there, its assembly mode kept.
///
/// One certified Newton iteration if the move is small, else in certified steps. Failures: `not_finite`; `mode_lost`:
/// the way meets a singular pose, shortfall is how far before `theta` (largest joint angle left, rad); `singular`:
/// elbows on a line. No allocation; about 0.3 microseconds in double for the moves of a 1 kHz loop, at worst (a fold on
/// the way) some hundred.
template <class S>
inline Outcome<Device_pose<S>> general_forward(const Device_parameters<S>& parameters, const Device_vector<S>& theta,
                                               const Device_pose<S>& previous) {
  using namespace internal;
  Outcome<Device_pose<S>> outcome;
  Device_pose<S>& pose = outcome.value_to_fill();
  if (!place_elbows(parameters, theta, pose)) {
    outcome.fail(Device_status::not_finite, S(0));
    return outcome;
  }
  Link_angles<S> x{previous.cos_phi, previous.sin_phi};
  const S turned = largest_magnitude(Device_vector<S>(theta - previous.theta));
  if (!certified_step(parameters, previous.elbows, pose.elbows, turned, x)) {
    const S done = follow_mode(parameters, previous.theta, theta, x);
    if (done < S(1)) {
      outcome.fail(Device_status::mode_lost, (S(1) - done) * turned);
      return outcome;
    }
  }
  finish_general(parameters, x, outcome);
  return outcome;
}

/// The mirror case R = r, l1 = l2 in closed form: the platform is the base's image in the elbow plane.
///
/// n the unit normal of the elbow plane, d its distance: p = 2 d n, Q = (I - 2 n n^T) diag(1, 1, -1).
/// Failures: `not_finite`; `singular`: elbows on a line.
/// \pre `parameters.is_mirror()`
template <class S>
inline Outcome<Device_pose<S>> mirror_forward(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  using namespace internal;
  using std::sqrt;
  Outcome<Device_pose<S>> outcome;
  Device_pose<S>& pose = outcome.value_to_fill();
  if (!place_elbows(parameters, theta, pose)) {
    outcome.fail(Device_status::not_finite, S(0));
    return outcome;
  }
  const Device_vector<S> a = pose.elbows.col(1) - pose.elbows.col(0), b = pose.elbows.col(2) - pose.elbows.col(0);
  Device_vector<S> n = a.cross(b);
  const S nn = n.squaredNorm();
  if (!spans_a_plane<S>(nn, a.squaredNorm(), b.squaredNorm(), parameters.base_radius() + parameters.primary_length())) {
    outcome.fail(Device_status::singular, S(0));
    return outcome;
  }
  n *= S(1) / sqrt(nn);
  const S distance = n.dot(pose.elbows.col(0) + pose.elbows.col(1) + pose.elbows.col(2)) / S(3);
  pose.mode = 0;
  pose.position = (S(2) * distance) * n;
  pose.orientation.noalias() = S(-2) * n * n.transpose();
  pose.orientation.diagonal().array() += S(1);
  pose.orientation.col(2) = -pose.orientation.col(2);
  // The secondary link is the image of the primary one: seen from the platform it makes the angle -theta with its
  // radius.
  pose.cos_phi = pose.cos_theta;
  pose.sin_phi = -pose.sin_theta;
  for (int leg = 0; leg < 3; ++leg) {
    const Device_vector<S> radial = pose.orientation * Leg_frame<S>::radial(leg);
    pose.joints.col(leg) = pose.position + parameters.platform_radius() * radial;
    pose.links.col(leg) = -(pose.cos_phi[leg] * radial + pose.sin_phi[leg] * pose.orientation.col(2));
  }
  if (all_finite(pose.position))
    outcome.succeed();
  else
    outcome.fail(Device_status::not_finite, S(0));
  return outcome;
}

/// The mode that Newton's method is certified to reach from the link angles `phi` (rad): the one beside them.
///
/// Failures: `not_finite`; `undecided`: the seed is too far from any mode, or too near a fold; shortfall its largest
/// residual of the closure, as a part of l2^2; `singular`. forward_by_all_modes() then finds the nearest.
template <class S>
inline Outcome<Device_pose<S>> general_forward_from_seed(const Device_parameters<S>& parameters,
                                                         const Device_vector<S>& theta, const Device_vector<S>& phi) {
  using namespace internal;
  Outcome<Device_pose<S>> outcome;
  Device_pose<S>& pose = outcome.value_to_fill();
  if (!all_finite(phi) || !place_elbows(parameters, theta, pose)) {
    outcome.fail(Device_status::not_finite, S(0));
    return outcome;
  }
  const Platform_closure<S> closure(parameters, pose.elbows);
  const Link_angles<S> seed = Link_angles<S>::from(phi);
  Link_angles<S> x = seed;
  if (certified_newton(closure, x) != Newton_end::converged) {
    outcome.fail(Device_status::undecided, largest_magnitude(closure.residual(seed)));
    return outcome;
  }
  x.normalize();
  finish_general(parameters, x, outcome);
  return outcome;
}

/// The home mode: platform above the elbows, reached from the symmetric pose at the mean joint angle by moving the
/// joints straight to `theta`. Mirror designs: the mirror pose, in closed form.
///
/// Failures: `not_finite`; `undecided`: a singular pose stands in that way, shortfall how far before `theta` (largest
/// joint angle left, rad), or the links do not close at the mean angle; `singular`. forward_by_all_modes() then looks
/// at all modes. At most some tens of microseconds.
template <class S>
inline Outcome<Device_pose<S>> general_forward(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  using namespace internal;
  if (parameters.is_mirror())
    return mirror_forward(parameters, theta);
  Outcome<Device_pose<S>> outcome;
  if (!place_elbows(parameters, theta, outcome.value_to_fill())) {
    outcome.fail(Device_status::not_finite, S(0));
    return outcome;
  }
  const S mean = internal::mean_of(theta);
  const Device_vector<S> symmetric = Device_vector<S>::Constant(mean);
  Link_angles<S> x;
  const S done = symmetric_home(parameters, mean, x) ? follow_mode(parameters, symmetric, theta, x) : S(0);
  if (done < S(1))
    outcome.fail(Device_status::undecided, (S(1) - done) * largest_magnitude(Device_vector<S>(theta - symmetric)));
  else
    finish_general(parameters, x, outcome);
  return outcome;
}

} // namespace haptic_sculpt
