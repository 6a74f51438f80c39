// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/ditetrahedral_kinematics.h>
#include <haptic_sculpt/device/linear_algebra/hessenberg_eigenvalues.h>
#include <haptic_sculpt/device/platform_closure.h>
#include <array>

/// \file
/// All real assembly modes of the general form for given joint angles.
///
/// With phi_0 held, each of two closure equations is linear in (cos, sin) of one other angle, so it has two solutions
/// with a square root each; the third equation multiplied over the four sign choices, and divided by the fourth power
/// of the common denominator, is a polynomial of degree 8 in cos phi_0 (16 in the tangent of the half angle, and even).
/// Its values at nine Chebyshev points give its Chebyshev coefficients, these a colleague matrix, and its eigenvalues
/// the candidates; Newton's method on the closure decides. That is done with each of the three angles in turn, because
/// solutions that share one cosine (double roots, always so in symmetric poses) seldom share the others.

namespace haptic_sculpt {

/// Up to 16 assembly modes, as link angles, sorted by (phi_0, phi_1, phi_2).
template <class S> struct Assembly_modes {
  using Scalar = S;                     ///< what `Outcome` measures a shortfall in
  int count = 0;                        ///< of the modes; 0 is an answer, too
  std::array<Link_angles<S>, 16> modes; ///< the first `count` of them; the others are not set
};

namespace internal {

/// The closure with one angle held at cosine c: what the other two angles can be.
template <class S> struct Held_angle {
  S a, b_squared, n, c1, c2; ///< A cos + B sin = C_1 (or C_2), N = A^2 + B^2, for the two other angles

  Held_angle(const Platform_closure<S>& closure, int held, const S& c) {
    const int first = (held + 1) % 3, second = (held + 2) % 3;
    a = closure.linear + c;
    b_squared = S(4) * (S(1) - c * c);
    n = a * a + b_squared;
    const S common = closure.constant + closure.linear * c;
    c1 = closure.separation_squared[second] - common; // the pair held-first is opposite the second
    c2 = closure.separation_squared[first] - common;
  }
};

/// The degree-8 polynomial in the cosine of the held angle.
template <class S> S mode_polynomial(const Platform_closure<S>& closure, int held, const S& c) {
  const Held_angle<S> h(closure, held, c);
  const S x2 = h.n - h.c1 * h.c1, y2 = h.n - h.c2 * h.c2;
  const S a0 = h.n * h.n * (closure.constant - closure.separation_squared[held]) +
               h.n * closure.linear * h.a * (h.c1 + h.c2) + (h.a * h.a - S(2) * h.b_squared) * h.c1 * h.c2;
  const S b1 = h.n * closure.linear + S(3) * h.a * h.c2,
          b2 = h.n * closure.linear + S(3) * h.a * h.c1; // less their factor B
  const S b12 = h.b_squared - S(2) * h.a * h.a;
  const S u = a0 * a0 + h.b_squared * b1 * b1 * x2 - y2 * (h.b_squared * b2 * b2 + b12 * b12 * x2);
  const S v = S(2) * (a0 * b1 - y2 * b2 * b12);
  const S n4 = h.n * h.n * h.n * h.n;
  return (u * u - x2 * h.b_squared * v * v) / n4;
}

/// Real parts of the polynomial's roots that may be cosines. Returns their number; -1 if the polynomial vanishes.
template <class S> int candidate_cosines(const Platform_closure<S>& closure, int held, std::array<S, 8>& cosines) {
  using std::abs;
  using std::cos;
  constexpr int degree = 8, points = degree + 1;
  using W = typename Wider<S>::type; // the division by N^4 loses digits where N is small
  const W pi(W(3.141592653589793238462643383279502884L));
  std::array<W, points> values;
  std::array<W, points> nodes;
  Platform_closure<W> wide(closure);
  for (int j = 0; j < points; ++j) {
    nodes[j] = cos(pi * (W(2 * j + 1) / W(2 * points)));
    values[j] = mode_polynomial(wide, held, nodes[j]);
  }
  std::array<S, points> coefficients;
  S largest(0);
  for (int k = 0; k < points; ++k) {
    W sum(0);
    for (int j = 0; j < points; ++j) { // the Chebyshev polynomial T_k at the node, by its recurrence
      W before(1), now(nodes[j]);
      for (int i = 1; i < k; ++i) {
        const W next = W(2) * nodes[j] * now - before;
        before = now;
        now = next;
      }
      sum += values[j] * (k == 0 ? W(1) : now);
    }
    coefficients[k] = S(sum * (k == 0 ? W(1) : W(2)) / W(points));
    if (!is_finite(coefficients[k]))
      return -1;
    largest = abs(coefficients[k]) > largest ? abs(coefficients[k]) : largest;
  }
  if (largest == S(0))
    return -1;
  const S rounding = S(16) * std::numeric_limits<S>::epsilon() * largest; // of a coefficient that is truly 0
  int top = degree;
  while (top > 0 && abs(coefficients[top]) <= rounding)
    --top;
  if (top == 0)
    return 0;
  // A polynomial of lower degree is padded with roots at 2, outside what a cosine can be: the matrix keeps its size.
  Eigen::Matrix<S, degree, degree> colleague = Eigen::Matrix<S, degree, degree>::Zero();
  for (int k = top; k < degree; ++k)
    colleague(k, k) = S(2);
  if (top == 1)
    colleague(0, 0) = -coefficients[0] / coefficients[1];
  else { // transposed, the polynomial in its last column: so it is a Hessenberg matrix
    colleague(1, 0) = S(1);
    for (int k = 1; k < top; ++k) {
      colleague(k - 1, k) = S(0.5);
      if (k + 1 < top)
        colleague(k + 1, k) = S(0.5);
    }
    for (int k = 0; k < top; ++k)
      colleague(k, top - 1) -= coefficients[k] / (S(2) * coefficients[top]);
  }
  Hessenberg_eigenvalues<S, degree> eigenvalues;
  if (!eigenvalues.compute(colleague))
    return -1;
  // A double root splits into a pair of complex ones by the square root of the rounding, a quadruple one by its fourth
  // root.
  const S slack(0.05);
  int count = 0;
  for (int k = 0; k < degree; ++k) {
    const S real = eigenvalues.real[k], imaginary = eigenvalues.imaginary[k];
    if (abs(imaginary) <= slack && abs(real) <= S(1) + slack)
      cosines[count++] = real > S(1) ? S(1) : real < S(-1) ? S(-1) : real;
  }
  return count;
}

template <class S> bool insert_mode(Assembly_modes<S>& found, const Link_angles<S>& mode) {
  for (int k = 0; k < found.count; ++k)
    if (angular_distance(found.modes[k], mode) <= mode_separation<S>())
      return false;
  if (found.count == 16)
    return false;
  found.modes[found.count++] = mode;
  return true;
}

/// The mode on the other side of the fold next to x, by the second-order expansion of the closure along its null
/// direction.
template <class S> Link_angles<S> across_the_fold(const Platform_closure<S>& closure, const Link_angles<S>& x) {
  Device_matrix<S> adjugate;
  S determinant;
  closure.derivative_adjugate(x, adjugate, determinant);
  Eigen::Index row = 0, column = 0; // near a fold the adjugate is (right null vector)(left null vector)^T
  adjugate.cwiseAbs().maxCoeff(&row, &column);
  const Device_vector<S> right = adjugate.col(column) / adjugate(row, column), left = adjugate.row(row).transpose();
  const S curvature = left.dot(closure.curvature(x, right));
  Link_angles<S> twin = x;
  if (curvature == S(0))
    return twin;
  const S slope = left.dot(closure.derivative(x) * right);
  const S way = S(-2) * slope / curvature;
  if (way < S(0.5) && way > S(-0.5))
    twin.turn(way * right);
  return twin;
}

template <class S>
void insert_with_mirror_image(const Platform_closure<S>& closure, Assembly_modes<S>& found,
                              const Link_angles<S>& mode) {
  if (!insert_mode(found, mode))
    return;
  Link_angles<S> image = mode;
  image.sine = -image.sine;
  insert_mode(found, image);
  Link_angles<S> twin = across_the_fold(closure, mode);
  if (free_newton(closure, twin, 60) && insert_mode(found, twin)) {
    twin.sine = Device_vector<S>(-twin.sine);
    insert_mode(found, twin);
  }
}

/// Candidates of one held angle, polished and inserted. False if the elimination failed.
template <class S> bool insert_modes_by(const Platform_closure<S>& closure, int held, Assembly_modes<S>& found) {
  using std::sqrt;
  const int first = (held + 1) % 3, second = (held + 2) % 3;
  std::array<S, 8> cosines;
  const int count = candidate_cosines(closure, held, cosines);
  for (int k = 0; k < count; ++k) {
    const S c = cosines[k];
    const Held_angle<S> h(closure, held, c);
    if (!(h.n > S(0)))
      continue;
    const S b = -sqrt(h.b_squared); // B = -2 sin phi with sin phi >= 0: the mirror images have the other sign
    const S x2 = h.n - h.c1 * h.c1, y2 = h.n - h.c2 * h.c2;
    // A root that slips just outside the reach of a link is still tried at its nearest angle.
    const S x = x2 > S(0) ? S(sqrt(x2)) : S(0), y = y2 > S(0) ? S(sqrt(y2)) : S(0);
    for (int signs = 0; signs < 4; ++signs) {
      const S sx = signs & 1 ? x : S(-x), sy = signs & 2 ? y : S(-y);
      Link_angles<S> guess;
      guess.cosine[held] = c, guess.sine[held] = -b / S(2);
      guess.cosine[first] = (h.a * h.c1 + b * sx) / h.n, guess.sine[first] = (b * h.c1 - h.a * sx) / h.n;
      guess.cosine[second] = (h.a * h.c2 + b * sy) / h.n, guess.sine[second] = (b * h.c2 - h.a * sy) / h.n;
      for (int leg = 0; leg < 3; ++leg) {
        const S length = sqrt(guess.cosine[leg] * guess.cosine[leg] + guess.sine[leg] * guess.sine[leg]);
        if (length > S(0))
          guess.cosine[leg] /= length, guess.sine[leg] /= length;
      }
      if (free_newton(closure, guess, 60))
        insert_with_mirror_image(closure, found, guess);
    }
  }
  return count >= 0;
}

template <class S> Outcome<Assembly_modes<S>> assembly_modes(const Platform_closure<S>& closure) {
  Outcome<Assembly_modes<S>> outcome;
  Assembly_modes<S>& found = outcome.value_to_fill();
  found.count = 0;
  bool eliminated = false;
  for (int held = 0; held < 3; ++held)
    eliminated = insert_modes_by(closure, held, found) || eliminated;
  if (!eliminated) {
    outcome.fail(Device_status::singular, S(0));
    return outcome;
  }
  for (int i = 1; i < found.count; ++i) { // insertion sort of at most 16 triples, by angle
    const Link_angles<S> mode = found.modes[i];
    const Device_vector<S> key = mode.angles();
    int k = i;
    for (; k > 0; --k) {
      const Device_vector<S> other = found.modes[k - 1].angles();
      if (!(key[0] < other[0] ||
            (key[0] == other[0] && (key[1] < other[1] || (key[1] == other[1] && key[2] < other[2])))))
        break;
      found.modes[k] = found.modes[k - 1];
    }
    found.modes[k] = mode;
  }
  outcome.succeed();
  return outcome;
}

} // namespace internal

/// All real assembly modes of the general form: 0, 4, 8, 12 or 16 in general position, in pairs mirrored by the elbow
/// plane.
///
/// No mode at all is a success with count 0. Failures: `not_finite`; `singular`: elbows on a line or coincident, where
/// modes are not isolated. About 0.1 ms in double: not for every tick. \pre `parameters.form() == Device_form::general`
template <class S>
inline Outcome<Assembly_modes<S>> assembly_modes(const Device_parameters<S>& parameters,
                                                 const Device_vector<S>& theta) {
  Device_pose<S> pose;
  if (!internal::place_elbows(parameters, theta, pose))
    return Outcome<Assembly_modes<S>>(Device_status::not_finite, S(0));
  const Device_vector<S> a = pose.elbows.col(1) - pose.elbows.col(0), b = pose.elbows.col(2) - pose.elbows.col(0);
  if (!internal::spans_a_plane<S>(a.cross(b).squaredNorm(), a.squaredNorm(), b.squaredNorm(),
                                  parameters.base_radius() + parameters.primary_length()))
    return Outcome<Assembly_modes<S>>(Device_status::singular, S(0));
  return internal::assembly_modes(internal::Platform_closure<S>(parameters, pose.elbows));
}

} // namespace haptic_sculpt
