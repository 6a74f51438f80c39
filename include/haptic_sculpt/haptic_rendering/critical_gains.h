// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Acceleration_estimate.h>
#include <haptic_sculpt/haptic_rendering/Velocity_estimate.h>

/// \file
/// Where a free mass that is given its own acceleration, velocity or place begins to swing by itself
/// (doc/proofs/haptic_stability.md, "What a free mass carries").

namespace haptic_sculpt {
namespace internal {

/// The response of a free mass of 1 kg to a force that is held from tick to tick and late by `delay` ticks: its place
/// over the force, m/N, at q = exp(-i angle), angle being that of one tick.
inline std::complex<double> held_force_response(double tick, double delay, double angle) {
  const double whole = std::floor(delay), early = 1 - (delay - whole); // what the first tick sees of the force
  const std::complex<double> q = std::polar(1.0, -angle), u = 1.0 - q;
  return std::polar(1.0, -angle * whole) * (tick * tick) * q *
         (0.5 * early * early * u * u + 0.5 * q * u + q * (early * u + q)) / (u * u);
}

/// The largest gain below which a loop of this response is stable, as Nyquist tells it: the response is that of a
/// stable filter, or of one with a pole at rest, and crosses the negative half-axis farthest out at minus its inverse.
/// \param response at angles in (0, pi]
template <class Response>
double critical_gain(const Response& response) {
  constexpr int angles = 20000; // between two of them a crossing is found by halving
  constexpr double pi = EIGEN_PI;
  double farthest = 0, last_angle = 0.1 * pi / angles / angles;
  std::complex<double> last = response(last_angle);
  for (int k = 1; k <= angles; ++k) {
    const double angle = pi * k / angles * k / angles; // closer to each other where they are small
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
  return internal::critical_gain([&](double angle) {
    const std::complex<double> step = 1.0 - std::polar(1.0, -angle);
    return estimate.response(angle) * step * step / (tick * tick) *
           internal::held_force_response(tick, delay, angle);
  });
}

/// The damping beyond which a free mass swings in no hand at all, N s/m for each kg of it.
/// \param cutoff of the velocity, Hz; infinite: steps are taken as they come
inline double critical_damping_rate(double tick, double delay, double cutoff = Velocity_estimate::default_cutoff) {
  const Velocity_estimate estimate(tick, cutoff);
  return internal::critical_gain([&](double angle) {
    return estimate.response(angle) * (1.0 - std::polar(1.0, -angle)) / tick *
           internal::held_force_response(tick, delay, angle);
  });
}

/// Of what makes a free mass swing by itself, the share that may be asked for: a wall, a hand and its grip take from
/// the rest. A gain margin of three, 9.5 dB.
constexpr double stable_share = 1.0 / 3;

/// The damping that may be asked for, N s/m for each kg that it stops: that share of critical, and at most one over the
/// time by which the velocity lags. A stronger one stops the mass sooner, pushes on, and throws it off a wall faster
/// than it came.
inline double largest_damping_rate(double tick, double delay, double cutoff = Velocity_estimate::default_cutoff) {
  return std::fmin(stable_share * critical_damping_rate(tick, delay, cutoff), 2 * double(EIGEN_PI) * cutoff);
}

} // namespace haptic_sculpt
