// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/Contact_run.h"

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

#include <random>

namespace haptic_sculpt::passivity_benchmark {

using namespace haptic_rendering_tests;

/// Draws of numbers that are the same on every machine.
class Draw {
public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double operator()(double low = 0, double high = 1) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  double logarithmic(double low, double high) { return low * std::pow(high / low, (*this)()); }
  bool chance(double share) { return (*this)() < share; }
  /// Even over the sphere.
  Eigen::Vector3d direction() {
    const double z = (*this)(-1, 1), angle = (*this)(0, 2 * 3.14159265358979323846), ring = std::sqrt(1 - z * z);
    return {ring * std::cos(angle), ring * std::sin(angle), z};
  }

private:
  std::mt19937_64 random_;
};

inline Device_parameters<double> design(Device_form form, double viscous, double coulomb, double encoder_step,
                                        double torque_limit) {
  Device_description<double> d = named_design<double>(Named_design::D1, form);
  d.viscous_friction = viscous, d.coulomb_friction = coulomb, d.encoder_step = encoder_step;
  d.torque_limit = torque_limit;
  return Device_parameters<double>(d);
}

/// What is drawn, and what is not.
struct Contact_wishes {
  double encoder_step = 0;
  double torque_limit = 10;   ///< N m; at 10 nothing is saturated
  double least_condition = 1; ///< of the pose in the middle
  double most_condition = 10; ///< of all poses
  double fixed_tick = 0;      ///< s; 0: drawn from 0.25 to 4 ms
  bool is_at_limit = false;   ///< k = k_p; else a share of it
  bool is_calm = false;       ///< k is, too, at most what is calm with the encoders

  /// Encoders and motors as they are built, and a stiffness that the loop takes with them.
  static Contact_wishes as_built() {
    Contact_wishes wishes;
    wishes.encoder_step = 1.53e-4, wishes.torque_limit = Device_description<double>().torque_limit;
    wishes.is_calm = true;
    return wishes;
  }
};

/// Poses with a handle near one place.
struct Region {
  Device_pose<double> centre;
  double radius = 0, greatest = 0; ///< m; sigma_max of J in it, m/rad
};

/// A ball of the workspace all of whose poses, by sampling, are usable.
inline Region random_region(Draw& draw, const Device_parameters<double>& device, const Contact_wishes& wishes) {
  const auto home = home_pose(device);
  const Eigen::Vector3d low = device.least_angle(), span = device.greatest_angle() - low;
  for (;;) {
    const double a = draw(), b = draw(), c = draw();
    const auto pose = forward_kinematics(device, Eigen::Vector3d(low + span.cwiseProduct(Eigen::Vector3d(a, b, c))));
    if (!pose || working_mode(device, *pose) != working_mode(device, *home))
      continue;
    const auto at_centre = jacobian(device, *pose);
    if (!at_centre || translation_conditioning(*at_centre).condition < wishes.least_condition)
      continue;
    Region region{*pose, draw(0.008, 0.015), 0};
    double most = 0;
    for (int k = 0; k < 60 && most <= wishes.most_condition; ++k) {
      const auto there = reach_position(
          device, *pose, Eigen::Vector3d(pose->position + region.radius * (k < 40 ? 1 : draw()) * draw.direction()));
      const auto map = there ? jacobian(device, *there) : jacobian(device, *pose);
      if (!there || !map) {
        most = 1e300;
        break;
      }
      const auto conditioning = translation_conditioning(*map);
      most = std::fmax(most, conditioning.condition);
      region.greatest = std::fmax(region.greatest, conditioning.greatest);
    }
    if (most <= wishes.most_condition) {
      region.greatest *= 1.01; // between the samples
      return region;
    }
  }
}

inline Simulated_hand random_hand(Draw& draw) {
  const double kind = draw();
  if (kind < 0.2)
    return Simulated_hand::finger();
  if (kind < 0.4)
    return Simulated_hand::arm();
  if (kind < 0.7)
    return {1, {{{draw.chance(0.5) ? 0 : draw(0, 0.1), draw.logarithmic(50, 1000), draw.logarithmic(0.3, 10)}}}};
  const double grip = draw.logarithmic(100, 1000), grip_damping = draw.logarithmic(1, 15),
               mass = draw.logarithmic(0.1, 2);
  const double arm = draw.logarithmic(30, 300), arm_damping = draw.logarithmic(2, 15);
  return {2, {{{0, grip, grip_damping}, {mass, arm, arm_damping}}}};
}

/// A hand that presses, slides and lifts off now and then, within a region, at up to some 200 mm/s.
inline Hand_path random_path(Draw& draw, const Region& region, const Eigen::Vector3d& normal, double seconds) {
  std::vector<Hand_path::Row> rows{{0, region.centre.position + 0.4 * region.radius * normal, 0}};
  while (rows.back().time < seconds) {
    const double height = region.radius * (draw.chance(0.15) ? draw(0, 0.3) : draw(-0.9, -0.02));
    const Eigen::Vector3d direction = draw.direction(), along = direction - normal * normal.dot(direction);
    const double time = rows.back().time + draw.logarithmic(0.05, 0.8);
    rows.push_back({time, region.centre.position + height * normal + 0.5 * region.radius * along, 0});
  }
  return Hand_path(std::move(rows));
}

/// Pose, stiffness of at most k_p, damping, delay, tick, hand and path at random.
inline Contact_setup random_contact(std::uint64_t seed, Device_form form, const Contact_wishes& wishes,
                                    double seconds) {
  Draw draw(seed);
  const double viscous = draw.logarithmic(0.002, 0.02), coulomb = draw.chance(0.5) ? 0 : 5e-4;
  const Device_parameters<double> device = design(form, viscous, coulomb, wishes.encoder_step, wishes.torque_limit);
  const Region region = random_region(draw, device, wishes);
  const Eigen::Vector3d normal = draw.direction();
  const double tick = wishes.fixed_tick > 0 ? wishes.fixed_tick : draw.logarithmic(2.5e-4, 4e-3);
  const double delay = draw.chance(1.0 / 3) ? 0 : draw(0, 2);
  const double friction = viscous / (region.greatest * region.greatest);
  const double damping = draw.chance(0.5) ? 0 : friction * draw(0, 0.9);
  const double share = wishes.is_at_limit ? 1 : draw(0.1, 1);
  const Hand_path path = random_path(draw, region, normal, 3 * seconds);
  const auto start = reach_position(device, region.centre, path.rows().front().position);
  Contact_setup setup{device, *start, region.centre.position, normal, path, random_hand(draw)};
  setup.tick = tick, setup.delay = delay, setup.greatest = region.greatest;
  const double calm = wishes.is_calm ? calm_stiffness(wishes.encoder_step * region.greatest, damping)
                                     : std::numeric_limits<double>::infinity();
  setup.coupling = {share * std::fmax(0, std::fmin(passive_stiffness(friction, damping, tick, delay), calm)), damping};
  setup.most_condition = wishes.most_condition * 1.05;
  setup.limits = no_limits(), setup.controller_damping = 0, setup.follows_pose = false; // nothing else at work
  return setup;
}

} // namespace haptic_sculpt::passivity_benchmark
