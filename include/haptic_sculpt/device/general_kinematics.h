// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_DEVICE_GENERAL_KINEMATICS_H
#define HAPTIC_SCULPT_DEVICE_GENERAL_KINEMATICS_H

#include <haptic_sculpt/device/assembly_modes.h>

/// \file
/// Forward kinematics of the general form: warm (continuing a pose), from a seed, and cold (the home mode).

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
  const S along = S(1) / sqrt(world_aa * seen_aa), normal = S(1) / sqrt(world_nn * seen_nn), across = along * normal;
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

/// Follows the mode x from `from` to `to` along the straight way between the two triples of joint angles, in certified
/// steps. Returns the part of the way done: 1 on success. The steps shrink towards a fold; no more than `most_steps`
/// are taken.
template <class S>
inline S follow_mode(const Device_parameters<S>& parameters, const Device_vector<S>& from, const Device_vector<S>& to,
                     Link_angles<S>& x, int most_steps) {
  S done(0), step(0.5);
  Device_pose<S> pose;
  for (int k = 0; k < most_steps; ++k) {
    const bool last = done + step >= S(1);
    const Device_vector<S> theta = last ? to : Device_vector<S>(from + (done + step) * (to - from));
    place_elbows(parameters, theta, pose);
    Link_angles<S> next = x;
    if (certified_newton(Platform_closure<S>(parameters, pose.elbows), next) == Newton_end::converged) {
      x = next;
      x.normalize();
      if (last)
        return S(1);
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

/// Sign of the closure's determinant: it changes only across a fold, so the modes of one sheet share it.
template <class S> bool on_home_sheet(const Platform_closure<S>& closure, const Link_angles<S>& x) {
  Device_matrix<S> adjugate;
  S determinant;
  closure.derivative_adjugate(x, adjugate, determinant);
  return determinant > S(0);
}

template <class S>
void finish_general(const Device_parameters<S>& parameters, const Link_angles<S>& x, Outcome<Device_pose<S>>& outcome) {
  if (place_platform(parameters, x, outcome.value_to_fill()))
    outcome.succeed();
  else
    outcome.fail(Device_status::singular, S(0));
}

/// How far the closure is from having a solution: the least residual (largest of the three, in units of l2^2) that
/// damped Gauss-Newton steps find from x. Local, so an upper bound of the true distance.
template <class S> S least_residual(const Platform_closure<S>& closure, Link_angles<S> x) {
  Device_vector<S> f = closure.residual(x);
  S damping(0.01);
  for (int iteration = 0; iteration < 100 && damping < S(1e8); ++iteration) {
    const Device_matrix<S> g = closure.derivative(x);
    Device_matrix<S> normal = g.transpose() * g, inverse;
    normal.diagonal().array() += damping;
    S determinant;
    adjugate(normal, inverse, determinant);
    const Device_vector<S> step = -(inverse * (g.transpose() * f)) / determinant;
    Link_angles<S> next = x;
    next.turn(step);
    next.normalize();
    const Device_vector<S> trial = closure.residual(next);
    if (trial.squaredNorm() < f.squaredNorm())
      x = next, f = trial, damping /= S(4);
    else
      damping *= S(4);
  }
  return largest_magnitude(f);
}

/// The mode nearest to a seed. Two modes about a fold that are closer to each other than to the seed cannot be
/// distinguished by it: then the one on the home sheet is meant.
template <class S>
bool nearest_mode(const Platform_closure<S>& closure, const Assembly_modes<S>& modes, const Link_angles<S>& seed,
                  Link_angles<S>& x) {
  if (modes.count == 0)
    return false;
  int best = 0;
  S best_distance = angular_distance(modes.modes[0], seed);
  for (int k = 1; k < modes.count; ++k) {
    const S distance = angular_distance(modes.modes[k], seed);
    if (distance < best_distance)
      best_distance = distance, best = k;
  }
  if (!on_home_sheet(closure, modes.modes[best]))
    for (int k = 0; k < modes.count; ++k)
      if (k != best && on_home_sheet(closure, modes.modes[k]) &&
          angular_distance(modes.modes[k], modes.modes[best]) < best_distance) {
        best = k;
        break;
      }
  x = modes.modes[best];
  return true;
}

} // namespace internal

/// The pose at `theta` reached from `previous` by moving the joints straight there, its assembly mode kept.
///
/// One certified Newton iteration if the move is small, else in certified steps. Failures: `not_finite`; `mode_lost`:
/// the way meets a singular pose, shortfall is how far before `theta` (largest joint angle left, rad); `singular`:
/// elbows on a line. No allocation; about 0.3 microseconds in double for the moves of a 1 kHz loop, at worst (a fold on
/// the way) tens of them.
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
  x.normalize();
  if (certified_newton(Platform_closure<S>(parameters, pose.elbows), x) != Newton_end::converged) {
    x = Link_angles<S>{previous.cos_phi, previous.sin_phi};
    x.normalize();
    const S done = follow_mode(parameters, previous.theta, theta, x, 400);
    if (done < S(1)) {
      outcome.fail(Device_status::mode_lost,
                   (S(1) - done) * largest_magnitude(Device_vector<S>(theta - previous.theta)));
      return outcome;
    }
  }
  finish_general(parameters, x, outcome);
  return outcome;
}

/// The mode nearest to the link angles `phi` (rad). Of two modes about a fold that are closer to each other than to the
/// seed, the one on the home sheet.
///
/// Failures: `not_finite`; `no_real_mode`, shortfall the least residual of the closure found from the seed, as a part
/// of l2^2; `singular`.
template <class S>
inline Outcome<Device_pose<S>> general_forward_from_seed(const Device_parameters<S>& parameters,
                                                         const Device_vector<S>& theta, const Device_vector<S>& phi);

/// The home mode: platform above the elbows, reached from the symmetric pose at the mean joint angle by moving the
/// joints straight to `theta`.
///
/// If a singular pose stands in that way, the mode of the home sheet (that sign of the closure's determinant) nearest
/// to the symmetric pose. Mirror designs: the mirror pose, in closed form. Failures as with a seed.
template <class S>
inline Outcome<Device_pose<S>> general_forward(const Device_parameters<S>& parameters, const Device_vector<S>& theta);

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
    const Outcome<Assembly_modes<S>> modes = assembly_modes(parameters, theta);
    if (!modes) {
      outcome.fail(modes.status(), modes.shortfall());
      return outcome;
    }
    if (!nearest_mode(closure, *modes, seed, x)) {
      outcome.fail(Device_status::no_real_mode, least_residual(closure, seed));
      return outcome;
    }
  }
  x.normalize();
  finish_general(parameters, x, outcome);
  return outcome;
}

template <class S>
inline Outcome<Device_pose<S>> general_forward(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  using namespace internal;
  if (parameters.is_mirror())
    return mirror_forward(parameters, theta);
  Outcome<Device_pose<S>> outcome;
  Device_pose<S>& pose = outcome.value_to_fill();
  if (!place_elbows(parameters, theta, pose)) {
    outcome.fail(Device_status::not_finite, S(0));
    return outcome;
  }
  const S mean = (theta[0] + theta[1] + theta[2]) / S(3);
  Link_angles<S> x;
  const bool has_home = symmetric_home(parameters, mean, x);
  const Device_vector<S> symmetric = Device_vector<S>::Constant(mean);
  if (has_home && follow_mode(parameters, symmetric, theta, x, 400) == S(1)) {
    finish_general(parameters, x, outcome);
    return outcome;
  }
  const Outcome<Assembly_modes<S>> modes = assembly_modes(parameters, theta);
  if (!modes) {
    outcome.fail(modes.status(), modes.shortfall());
    return outcome;
  }
  const Platform_closure<S> closure(parameters, pose.elbows);
  Link_angles<S> seed;
  if (!symmetric_home(parameters, mean, seed)) {
    seed.cosine.setZero();
    seed.sine.setConstant(S(-1));
  }
  Assembly_modes<S> home;
  for (int k = 0; k < modes->count; ++k)
    if (on_home_sheet(closure, modes->modes[k]))
      home.modes[home.count++] = modes->modes[k];
  if (!nearest_mode(closure, home, seed, x))
    outcome.fail(Device_status::no_real_mode, least_residual(closure, seed));
  else
    finish_general(parameters, x, outcome);
  return outcome;
}

} // namespace haptic_sculpt

#endif
