// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/dynamics.h>
#include <haptic_sculpt/device/forward_by_all_modes.h>
#include <haptic_sculpt/device/simulation/Torque_delay.h>
#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Acceleration_estimate.h>
#include <haptic_sculpt/haptic_rendering/Passivity_controller.h>
#include <haptic_sculpt/haptic_rendering/Virtual_coupling.h>
#include <haptic_sculpt/haptic_rendering/critical_gains.h>
#include <haptic_sculpt/haptic_rendering/loop/require_number.h>
#include <haptic_sculpt/haptic_rendering/reach_position.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

namespace haptic_sculpt {

/// The largest stiffness, N/m, that cannot give energy to any hand: 2 (b_phys - |b|) / (T (1 + 2 d)).
/// \param friction b_phys, the least damping at the handle, N s/m \param damping b, N s/m \param tick T, s \param delay
/// d, ticks
inline double passive_stiffness(double friction, double damping, double tick, double delay) {
  return 2 * (friction - std::abs(damping)) / (tick * (1 + 2 * delay));
}

/// N: as much of the force may come and go under a hand that holds still, because the place is known by counts only.
constexpr double largest_restlessness = 0.1;

/// The largest stiffness, N/m, at which counts do no more than that: a handle at rest may be between two counts along
/// all three axes or joints at once, and the damper's velocity, behind its low-pass of f Hz, jumps with it by 2 pi f a
/// count. Infinite for exact places.
/// \param count way of the handle in one of them, m \param damping b, N s/m
inline double calm_stiffness(double count, double damping) {
  return largest_restlessness / (std::sqrt(3.0) * std::abs(count)) -
         Velocity_estimate::change_of_way(std::abs(damping));
}

/// Where the device gives least friction, or has least mass, at the handle, for what is rendered there.
struct Worst_pose {
  Device_pose<double> pose; ///< of no meaning unless `is_found`
  double greatest = 0;      ///< sigma_max(J), m/rad
  double fading = 0;        ///< the share of the force that is rendered there
  bool is_found = false;    ///< false: no pose of the workspace can be used
  double badness = -1;      ///< by which it was sought

  /// b_phys at the handle, N s/m, in units of what is rendered.
  double friction(const Device_parameters<double>& parameters) const {
    const internal::Rounding_to_nearest rounding;
    return internal::kept(is_found ? parameters.viscous_friction() / (greatest * greatest * fading) : 0);
  }
  /// The most, m, that one count of an encoder may be worth at the handle, in units of what is rendered.
  double count(const Device_parameters<double>& parameters) const {
    const internal::Rounding_to_nearest rounding;
    return internal::kept(is_found ? parameters.encoder_step() * greatest * std::sqrt(fading) : 0);
  }
  /// The least apparent mass at the handle, kg, in units of what is rendered.
  double apparent_mass(const Device_parameters<double>& parameters) const {
    const internal::Rounding_to_nearest rounding;
    if (!is_found)
      return 0;
    const auto map = jacobian(parameters, pose);
    const auto terms = dynamics(parameters, Dynamics_model::spatial, pose, Device_vector<double>(0, 0, 0));
    if (!map || !terms)
      return 0;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> apparent(
        haptic_sculpt::apparent_mass(terms->mass, map->linear), Eigen::EigenvaluesOnly);
    return apparent.eigenvalues()[0] / fading;
  }
};

namespace internal {

/// A pose and how bad it is, by `badness(pose)`; not found where nothing is rendered.
/// Poses with a knee on the other side than at `home` do not count: the way there leads through poses without any
/// force.
template <class Contains, class Badness>
Worst_pose rated_pose(const Device_parameters<double>& parameters, const Device_pose<double>& home,
                      const Device_vector<double>& theta, const Force_limits& limits, const Contains& contains,
                      const Badness& badness) {
  Worst_pose rated;
  if (!within_joint_limits(parameters, theta))
    return rated;
  const auto pose = forward_by_all_modes(parameters, theta); // a hand may come there by another way than straight
  if (!pose || working_mode(parameters, *pose) != working_mode(parameters, home) || !contains(pose->position))
    return rated;
  const auto map = jacobian(parameters, *pose);
  if (!map)
    return rated;
  const auto conditioning = translation_conditioning(*map);
  rated = {*pose, conditioning.greatest, fading_by_condition(limits, conditioning.condition), true, -1};
  rated.is_found = rated.fading > 0;
  if (rated.is_found)
    rated.badness = badness(rated);
  return rated;
}

/// Searches the poses whose handle's place `contains(position)` for the worst: a grid of joint angles, and from its
/// worst a climb by random steps that get smaller. Allocates; some tenths of a second.
template <class Contains, class Badness>
Worst_pose worst_pose_by(const Device_parameters<double>& parameters, const Force_limits& limits,
                         const Contains& contains, const Badness& badness, int per_joint) {
  require_number("per_joint, the angles of a joint in a search for the worst pose,", "", per_joint, 2, 1000);
  const Rounding_to_nearest rounding;
  using V = Device_vector<double>;
  constexpr std::size_t starts = 24;
  std::vector<Worst_pose> worst;
  const auto home = home_pose(parameters);
  if (!home)
    return Worst_pose();
  const V span = parameters.greatest_angle() - parameters.least_angle();
  for (int i = 0; i < per_joint * per_joint * per_joint; ++i) {
    const V part(i % per_joint, i / per_joint % per_joint, i / per_joint / per_joint);
    const V theta = parameters.least_angle() + span.cwiseProduct(part / (per_joint - 1.0));
    const Worst_pose rated = rated_pose(parameters, *home, theta, limits, contains, badness);
    if (!rated.is_found)
      continue;
    worst.push_back(rated);
    std::sort(worst.begin(), worst.end(),
              [](const Worst_pose& a, const Worst_pose& b) { return a.badness > b.badness; });
    if (worst.size() > starts)
      worst.pop_back();
  }
  // At the edge of what counts, and on ridges, the axes lead nowhere: directions are drawn.
  std::mt19937_64 draw(1);
  const auto number = [&draw] { return 2 * (static_cast<double>(draw() >> 11) * 0x1p-53) - 1; };
  Worst_pose found;
  // In radians, where climbing ends: the limit differs by less than a hundred-thousandth between such neighbours.
  constexpr double finest_step = 1e-5;
  for (Worst_pose& start : worst) {
    for (double step = 2 * span.maxCoeff() / (per_joint - 1); step > finest_step; step /= 2)
      for (int failures = 0; failures < 40;) {
        const double x = number(), y = number(), z = number();
        const Worst_pose next =
            rated_pose(parameters, *home, V(start.pose.theta + step * V(x, y, z)), limits, contains, badness);
        if (next.badness > start.badness)
          start = next, failures = 0;
        else
          ++failures;
      }
    if (start.badness > found.badness)
      found = start;
  }
  return found;
}

} // namespace internal

/// Searches the poses whose handle's place `contains(position)` for that of least friction. \param per_joint angles of
/// each joint that are looked at first, 2 to 1000 \throw Error for another number. Cost: their third power in
/// microseconds
template <class Contains>
Worst_pose worst_pose(const Device_parameters<double>& parameters, const Force_limits& limits, const Contains& contains,
                      int per_joint = 25) {
  return internal::worst_pose_by(
      parameters, limits, contains, [](const Worst_pose& p) { return p.greatest * p.greatest * p.fading; }, per_joint);
}

/// The same for that of least apparent mass. Some times slower, for the dynamics of each pose.
template <class Contains>
Worst_pose lightest_pose(const Device_parameters<double>& parameters, const Force_limits& limits,
                         const Contains& contains, int per_joint = 25) {
  return internal::worst_pose_by(
      parameters, limits, contains, [&](const Worst_pose& p) { return 1 / p.apparent_mass(parameters); }, per_joint);
}

/// What may be asked of a loop, and what these limits were made for. Made by passivity_limits().
struct Passivity_limits {
  double friction = 0;           ///< b_phys at the worst pose, N s/m
  double passive_stiffness = 0;  ///< k_p at the damping asked for, N/m; < 0 where that alone is too much
  double calm_stiffness = std::numeric_limits<double>::infinity(); ///< beyond it counts of the encoders are felt, N/m
  double apparent_mass = 0;      ///< the least in the workspace, kg
  double largest_damping = 0;    ///< b that may be asked for, N s/m
  double largest_mass = 0;       ///< virtual mass that may be asked for, kg
  double largest_controller = 0; ///< damping of a passivity controller that may be asked for, N s/m
  Worst_pose worst,              ///< that of least friction
      lightest;                  ///< that of least apparent mass
  double damping = 0; ///< for which they were made, N s/m
  double tick = 0;    ///< for which they were made, s
  double delay = 0;   ///< for which they were made, ticks
  double cutoff = Acceleration_estimate::default_cutoff; ///< of the acceleration, Hz
  std::optional<Workspace_map> map; ///< for which they were made; none: they are for no loop
  double full_condition = 0,        ///< for which they were made, as in Force_limits
      no_condition = 0;             ///< for which they were made, as in Force_limits

  /// Both passive and calm, N/m; never < 0.
  double largest_stiffness() const { return std::fmax(std::fmin(passive_stiffness, calm_stiffness), 0.0); }
  /// Without a damper and without a hand a handle rings on a stiffer wall: half of the largest, N/m.
  double recommended_stiffness() const { return 0.5 * largest_stiffness(); }
  /// Of the passivity controller where nothing else is asked for, N s/m: half of the largest.
  double default_controller() const { return 0.5 * largest_controller; }
  /// Whether the coupling can give no energy to any hand, and is calm. \pre the damping is the one that the limits were
  /// made for
  bool permits(const Virtual_coupling& coupling) const { return coupling.stiffness <= largest_stiffness(); }
  /// Part of the apparent mass: an eigenvalue of a matrix whose condition is some hundreds, which compilers may round
  /// otherwise at two places. Masses that make a difference differ by far more.
  static constexpr double rounding_of_mass = 1e-9;
  /// Whether they were made for these, N s/m, s, ticks, Hz, for the conditions at which these forces fade, and a device
  /// with the Jacobian, masses, friction and encoders of this one.
  bool are_for(const Device_parameters<double>& device, const Force_limits& forces, const Workspace_map& place,
               double b, double seconds, double ticks, double hertz) const {
    const internal::Rounding_to_nearest rounding; // in which they were made
    if (!map || !(*map == place) || full_condition != forces.full_condition || no_condition != forces.no_condition ||
        damping != b || tick != seconds || delay != ticks || cutoff != hertz || worst.friction(device) != friction ||
        !(std::abs(lightest.apparent_mass(device) - apparent_mass) <= rounding_of_mass * apparent_mass) ||
        haptic_sculpt::passive_stiffness(friction, b, seconds, ticks) != passive_stiffness ||
        haptic_sculpt::calm_stiffness(worst.count(device), b) != calm_stiffness)
      return false;
    if (!worst.is_found) // then nothing is passive
      return true;
    const auto jacobian_there = jacobian(device, worst.pose);
    return jacobian_there && translation_conditioning(*jacobian_there).greatest == worst.greatest;
  }
};

namespace internal {

inline void check_asked_of_limits(const Force_limits& limits, double damping, double tick, double delay,
                                  double cutoff) {
  limits.check();
  require_number("the damping of passivity_limits()", "N s/m", damping, 0, 1e5);
  require_tick("the tick of passivity_limits()", tick);
  require_number("the delay of passivity_limits()", "ticks", delay, 0, Torque_delay<double>::most_ticks);
  require_number("the cutoff of passivity_limits()", "Hz", cutoff, 1e-3, 1e6);
}

} // namespace internal

/// The limits of a device whose worst poses are known. \param delay ticks
/// \param cutoff of the acceleration that a virtual mass follows, Hz \throw Error naming what cannot be used
inline Passivity_limits passivity_limits(const Device_parameters<double>& parameters, const Force_limits& limits,
                                         const Workspace_map& map, const Worst_pose& worst,
                                         const Worst_pose& lightest, double damping, double tick, double delay,
                                         double cutoff = Acceleration_estimate::default_cutoff) {
  const internal::Rounding_to_nearest rounding;
  internal::check_asked_of_limits(limits, damping, tick, delay, cutoff);
  Passivity_limits found;
  found.worst = worst;
  found.friction = found.worst.friction(parameters);
  found.passive_stiffness = passive_stiffness(found.friction, damping, tick, delay);
  found.calm_stiffness = calm_stiffness(found.worst.count(parameters), damping);
  found.lightest = lightest;
  found.apparent_mass = found.lightest.apparent_mass(parameters);
  found.largest_mass = stable_share * found.apparent_mass * critical_mass_ratio(tick, delay, cutoff);
  // Beyond the friction it is not passive, whatever the stiffness, and a stiff hand may swing with it.
  found.largest_damping = std::fmin(found.friction, found.apparent_mass * largest_damping_rate(tick, delay));
  found.largest_controller =
      std::fmin(found.apparent_mass * largest_damping_rate(tick, delay, std::numeric_limits<double>::infinity()),
                Passivity_controller::largest_damping);
  found.damping = damping, found.tick = tick, found.delay = delay, found.cutoff = cutoff, found.map = map;
  found.full_condition = limits.full_condition, found.no_condition = limits.no_condition;
  return found;
}

/// The limits over the device's places whose scene is in a box. Some tenths of a second. \param delay ticks
/// \param cutoff of the acceleration that a virtual mass follows, Hz \throw Error naming what cannot be used
inline Passivity_limits passivity_limits(const Device_parameters<double>& parameters, const Force_limits& limits,
                                         const Workspace_map& map, const Eigen::Vector3d& lower,
                                         const Eigen::Vector3d& upper, double damping, double tick, double delay,
                                         double cutoff = Acceleration_estimate::default_cutoff) {
  const internal::Rounding_to_nearest rounding;
  if (!lower.allFinite() || !upper.allFinite() || (lower.array() > upper.array()).any())
    throw Error("the box of passivity_limits() must be of finite numbers, none of its lower corner above that of its "
                "upper one");
  internal::check_asked_of_limits(limits, damping, tick, delay, cutoff); // before the search, which takes its time
  const auto is_in_scene = [&](const Eigen::Vector3d& device) {
    const Eigen::Vector3d p = map.to_scene(device);
    return (p.array() >= lower.array()).all() && (p.array() <= upper.array()).all();
  };
  return passivity_limits(parameters, limits, map, worst_pose(parameters, limits, is_in_scene),
                          lightest_pose(parameters, limits, is_in_scene), damping, tick, delay, cutoff);
}

} // namespace haptic_sculpt
