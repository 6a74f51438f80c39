// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/assembly_modes.h>
#include <haptic_sculpt/device/forward_kinematics.h>

/// \file
/// Forward kinematics that is never `undecided`: where a singular pose stands in the way, all assembly modes are looked
/// at. Not a part of device.h, since it compiles the eigenvalues, too.

namespace haptic_sculpt {
namespace internal {

/// The sheet of the symmetric pose at the mean joint angle, by the sign of the closure's determinant: it changes only
/// across a fold, so the modes of one sheet share it. There it is that of R + l1 cos, how far the elbows are from the
/// middle: beyond it they stand crosswise.
template <class S>
class Home_sheet {
public:
  Home_sheet(const Device_parameters<S>& parameters, const S& mean)
      : is_positive_(parameters.base_radius() + parameters.primary_length() * cos_of(mean) > S(0)) {}

  bool has(const Platform_closure<S>& closure, const Link_angles<S>& x) const {
    Device_matrix<S> adjugate;
    S determinant;
    closure.derivative_adjugate(x, adjugate, determinant);
    return is_positive_ ? determinant > S(0) : determinant < S(0);
  }

private:
  bool is_positive_;

  static S cos_of(const S& angle) {
    using std::cos;
    return cos(angle);
  }
};

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

/// Whether y is the mode on the other side of the fold next to x, with which it would merge there.
template <class S>
bool is_across_the_fold(const Platform_closure<S>& closure, const Link_angles<S>& x, const Link_angles<S>& y) {
  Link_angles<S> twin = across_the_fold(closure, x);
  return free_newton(closure, twin, 60) && angular_distance(twin, y) <= mode_separation<S>();
}

/// The mode nearest to a seed. Two modes about a fold that are closer to each other than to the seed cannot be
/// distinguished by it: then the one on the home sheet is meant, and where two folds meet the nearer one of these.
template <class S>
bool nearest_mode(const Platform_closure<S>& closure, const Home_sheet<S>& home, const Assembly_modes<S>& modes,
                  const Link_angles<S>& seed, Link_angles<S>& x) {
  if (modes.count == 0)
    return false;
  int best = 0;
  S best_distance = angular_distance(modes.modes[0], seed);
  for (int k = 1; k < modes.count; ++k) {
    const S distance = angular_distance(modes.modes[k], seed);
    if (distance < best_distance)
      best_distance = distance, best = k;
  }
  x = modes.modes[best];
  if (home.has(closure, x))
    return true;
  bool found = false;
  for (int k = 0; k < modes.count; ++k) {
    const Link_angles<S>& mode = modes.modes[k];
    if (home.has(closure, mode) && angular_distance(mode, modes.modes[best]) < best_distance &&
        (!found || angular_distance(mode, seed) < angular_distance(x, seed)) &&
        is_across_the_fold(closure, mode, modes.modes[best]))
      x = mode, found = true;
  }
  return true;
}

/// The mode nearest to a seed, among all or among those of the home sheet.
template <class S>
Outcome<Device_pose<S>> forward_nearest_to(const Device_parameters<S>& parameters, const Device_vector<S>& theta,
                                           const Link_angles<S>& seed, bool at_home) {
  Outcome<Device_pose<S>> outcome;
  const Outcome<Assembly_modes<S>> all = assembly_modes(parameters, theta);
  if (!all) {
    outcome.fail(all.status(), all.shortfall());
    return outcome;
  }
  Device_pose<S>& pose = outcome.value_to_fill();
  place_elbows(parameters, theta, pose);
  const Platform_closure<S> closure(parameters, pose.elbows);
  const Home_sheet<S> home(parameters, mean_of(theta));
  Assembly_modes<S> candidates;
  for (int k = 0; k < all->count; ++k)
    if (!at_home || home.has(closure, all->modes[k]))
      candidates.modes[candidates.count++] = all->modes[k];
  Link_angles<S> x;
  if (!nearest_mode(closure, home, candidates, seed, x)) {
    outcome.fail(Device_status::no_real_mode, least_residual(closure, seed));
    return outcome;
  }
  x.normalize();
  finish_general(parameters, x, outcome);
  return outcome;
}

} // namespace internal

/// The pose in the home mode, as forward_kinematics(); where that is `undecided`, the mode of the home sheet (that sign
/// of the closure's determinant that the symmetric pose at the mean angle has) nearest to the symmetric pose.
///
/// Failures as of the form's own function, but for `undecided`; `no_real_mode`: there is none on the home sheet,
/// shortfall the least residual of the closure found from the symmetric pose, as a part of l2^2. About 0.1 ms where all
/// modes are needed.
template <class S>
Outcome<Device_pose<S>> forward_by_all_modes(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  const Outcome<Device_pose<S>> straight = forward_kinematics(parameters, theta);
  if (straight.status() != Device_status::undecided)
    return straight;
  Link_angles<S> seed;
  if (!internal::symmetric_home(parameters, internal::mean_of(theta), seed)) {
    seed.cosine.setZero();
    seed.sine.setConstant(S(-1));
  }
  return internal::forward_nearest_to(parameters, theta, seed, true);
}

/// The mode nearest to the link angles `phi` (rad). Of two modes about a fold (the closure's second-order expansion
/// leads from one to the other) that are closer to each other than to the seed, the one on the home sheet. Failures:
/// `not_finite`; `no_real_mode`, as above, from the seed; `singular`.
/// \pre `parameters.form() == Device_form::general`
template <class S>
Outcome<Device_pose<S>> forward_by_all_modes(const Device_parameters<S>& parameters, const Device_vector<S>& theta,
                                             const Device_vector<S>& phi) {
  const Outcome<Device_pose<S>> beside = general_forward_from_seed(parameters, theta, phi);
  return beside.status() == Device_status::undecided
             ? internal::forward_nearest_to(parameters, theta, Link_angles<S>::from(phi), false)
             : beside;
}

} // namespace haptic_sculpt
