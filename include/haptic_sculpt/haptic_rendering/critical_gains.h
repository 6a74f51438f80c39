// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_CRITICAL_GAINS_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_CRITICAL_GAINS_H

#include <haptic_sculpt/haptic_rendering/Acceleration_estimate.h>
#include <haptic_sculpt/haptic_rendering/Velocity_estimate.h>

/// \file
/// Where a free mass that is told its own acceleration or velocity begins to swing by itself
/// (doc/haptic_stability.md, "Virtual mass and inertia").

namespace haptic_sculpt {
namespace internal {

/// The response of a free mass of 1 kg to a force that is held from tick to tick and late by `delay` ticks: second
/// differences of its place over the square of the tick, at q = exp(-i angle), angle being that of one tick.
inline std::complex<double> held_force_response(double delay, double angle) {
  const double whole = std::floor(delay), late = delay - whole; // a step of the force acts on three differences
  const std::complex<double> q = std::polar(1.0, -angle);
  return std::polar(1.0, -angle * whole) *
         ((1 - late) * (1 - late) / 2 * q + (0.5 + late - late * late) * q * q + late * late / 2 * q * q * q);
}

/// The largest gain below which a loop of this response is stable, as Nyquist tells it: the response is that of a
/// stable filter, or of one with a pole at rest, and crosses the negative half-axis farthest out at minus its inverse.
/// \param response at angles in (0, pi]
template <class Response>
double critical_gain(const Response& response) {
  constexpr int angles = 20000; // between two of them a crossing is found by halving
  constexpr double pi = 3.14159265358979323846;
  double farthest = 0, last_angle = 0.1 * pi / angles;
  std::complex<double> last = response(last_angle);
  for (int k = 1; k <= angles; ++k) {
    const double angle = k * pi / angles;
    const std::complex<double> here = response(angle);
    if (k == angles) // real there, but for rounding
      farthest = std::fmin(farthest, here.real());
    else if ((last.imag() < 0) != (here.imag() < 0)) {
      double low = last_angle, high = angle;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        ((response(middle).imag() < 0) == (last.imag() < 0) ? low : high) = middle;
      }
      farthest = std::fmin(farthest, response(high).real());
    }
    last = here, last_angle = angle;
  }
  return farthest < 0 ? -1 / farthest : std::numeric_limits<double>::infinity();
}

} // namespace internal

/// The virtual mass, over the mass that carries it, beyond which that swings in no hand at all. No unit.
/// \param tick s \param delay from a command to its torque, ticks \param cutoff of the acceleration, Hz
inline double critical_mass_ratio(double tick, double delay, double cutoff) {
  const Acceleration_estimate estimate(tick, cutoff);
  return internal::critical_gain(
      [&](double angle) { return estimate.response(angle) * internal::held_force_response(delay, angle); });
}

/// The damping beyond which a free mass swings in no hand at all, N s/m for each kg of it.
/// \param cutoff of the velocity, Hz; infinite: steps are taken as they come
inline double critical_damping_rate(double tick, double delay, double cutoff = Velocity_estimate::default_cutoff) {
  const Velocity_estimate estimate(tick, cutoff);
  return internal::critical_gain([&](double angle) {
           return estimate.response(angle) * internal::held_force_response(delay, angle) /
                  (1.0 - std::polar(1.0, -angle));
         }) /
         tick;
}

} // namespace haptic_sculpt

#endif
