// SPDX-License-Identifier: GPL-3.0-or-later
// What is rendered beside the coupling: bursts, virtual mass, compensated inertia, the passivity controller. Needs no
// mesh.
#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Inertia_rendering.h>
#include <haptic_sculpt/haptic_rendering/Passivity_controller.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>
#include <haptic_sculpt/haptic_rendering/check_coupling.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <complex>
#include <random>

using namespace haptic_sculpt;
using Eigen::Vector3d;

namespace {

using Random = std::mt19937_64;
constexpr double rates[] = {250, 333, 500, 1000, 4000, 10000};

Vector3d random_direction(Random& random) {
  std::normal_distribution<double> number;
  const double x = number(random), y = number(random), z = number(random);
  return Vector3d(x, y, z).normalized();
}

Device_parameters<double> device(Device_form form) {
  Device_description<double> d = named_design<double>(Named_design::D1, form);
  d.viscous_friction = 0.005;
  return Device_parameters<double>(d);
}

Force_limits no_limits() {
  Force_limits limits;
  limits.slew = limits.largest = 1e9, limits.ramp_time = 1e-9;
  return limits;
}

BOOST_AUTO_TEST_CASE(a_burst_has_no_mean_and_no_first_moment) {
  for (const double rate : rates)
    for (const double mass : {0.005, 0.03, 0.2}) {
      Refusal_burst burst(1 / rate);
      burst.begin(Vector3d(0, 0, 2), 1 / mass);
      double sum = 0, moment = 0, largest = 0, velocity = 0, place = 0, farthest = 0;
      for (int k = 0; !burst.is_over(); ++k) {
        const Vector3d force = burst.next();
        sum += force[2], moment += force[2] * k, largest = std::max(largest, std::abs(force[2]));
        for (int part = 0; part < 16; ++part) { // a free mass, the force held
          place += velocity / rate / 16 + force[2] / mass / rate / rate / 512;
          velocity += force[2] / mass / rate / 16;
          farthest = std::max(farthest, std::abs(place));
        }
      }
      BOOST_TEST(std::abs(sum) <= 1e-12);
      BOOST_TEST(std::abs(moment) <= 1e-9);
      BOOST_TEST(std::abs(place) <= 1e-12); // it is back
      BOOST_TEST(largest <= 1);
      BOOST_TEST(farthest <= 1.0001 * Refusal_burst::farthest);
      BOOST_TEST((largest >= 0.9 || farthest >= 0.95 * Refusal_burst::farthest)); // no less than is needed
      BOOST_TEST(burst.next() == Vector3d::Zero());
      BOOST_TEST_MESSAGE(rate << " Hz, " << mass << " kg: burst of " << largest << " N moves it by " << 1e3 * farthest
                              << " mm");
    }
}

BOOST_AUTO_TEST_CASE(a_refused_edit_moves_the_handle_by_less_than_a_tenth_of_a_millimetre) {
  Random random(21);
  std::uniform_real_distribution<double> angle(0.4, 1.6);
  Simulated_hand open_hand; // touches nothing
  open_hand.stages = 1;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form);
    for (const double rate : rates) {
      double farthest = 0, least_peak = 10;
      for (int round = 0; round < 12;) {
        const double a = angle(random), b = angle(random), c = angle(random);
        const auto pose = forward_kinematics(parameters, Vector3d(a, b, c));
        if (!pose || !(translation_conditioning(*jacobian(parameters, *pose)).condition <= 10))
          continue;
        const Hand_path path({{0, pose->position, 0}});
        const Simulated_hand hands[] = {Simulated_hand::finger(), Simulated_hand::arm(), open_hand};
        Simulated_device with(parameters, *pose, hands[round % 3], path, 1 / rate, 0), without = with;
        Handle_motion handle(parameters, *pose, 1 / rate), other = handle;
        Force_renderer renderer(Force_limits(), Gravity_compensation::spatial, 1 / rate), quiet = renderer;
        for (int k = 0; k < 0.5 * rate; ++k)
          handle.follow(pose->theta), renderer.render(handle, Vector3d::Zero()); // the ramp is over
        renderer.refuse(handle, random_direction(random));
        double peak = 0;
        for (int k = 0; k < 0.1 * rate; ++k) {
          handle.follow(with.read().theta), other.follow(without.read().theta);
          const Rendered_force felt = renderer.render(handle, Vector3d::Zero()),
                               nothing = quiet.render(other, Vector3d::Zero());
          BOOST_REQUIRE((with.write(felt.torque, felt.interaction_torque) == Device_status::success));
          BOOST_REQUIRE((without.write(nothing.torque, nothing.interaction_torque) == Device_status::success));
          peak = std::max(peak, felt.force.norm());
          farthest = std::max(farthest, (with.state().pose.position - without.state().pose.position).norm());
        }
        least_peak = std::min(least_peak, peak);
        ++round;
      }
      BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                         << ", " << rate << " Hz: a refused edit moves the handle by at most " << 1e3 * farthest
                         << " mm; bursts of at least " << least_peak << " N");
      BOOST_TEST(farthest <= 1e-4);
      BOOST_TEST(least_peak >= 0.1);
    }
  }
}

/// The handle is led along a sinusoid; F is compared with -m a as complex amplitudes: size and phase.
double error_of_mass(const Device_parameters<double>& parameters, double rate, double frequency, double cutoff) {
  const double omega = 2 * M_PI * frequency, amplitude = 0.004, mass = 0.05;
  const auto home = home_pose(parameters);
  const Vector3d direction = Vector3d(0.3, -0.5, 0.8).normalized();
  Handle_motion handle(parameters, *home, 1 / rate);
  Inertia_parameters wanted;
  wanted.mass = mass, wanted.cutoff = cutoff;
  Inertia_rendering inertia(wanted, parameters, 1 / rate, 0);
  Force_renderer renderer(no_limits(), Gravity_compensation::none, 1 / rate);
  Device_pose<double> pose = *home;
  const double settled = 0.5, periods = std::max(1.0, std::floor(frequency)), end = settled + periods / frequency;
  double square = 0, all = 0, largest = 0;
  for (int k = 0; k / rate < end; ++k) {
    const double t = k / rate;
    pose = *reach_position(parameters, pose, Vector3d(home->position + amplitude * std::sin(omega * t) * direction));
    handle.follow(pose.theta);
    const Vector3d force = renderer.render(handle, inertia.force(handle, true)).force;
    const Vector3d exact = mass * amplitude * omega * omega * std::sin(omega * t) * direction;
    if (t < settled)
      continue;
    square += (force - exact).squaredNorm(), all += exact.squaredNorm();
    largest = std::max(largest, (force - exact).norm() / (mass * amplitude * omega * omega));
  }
  BOOST_TEST(largest <= 2 * std::sqrt(square / all) + 1e-3); // an error of size and phase alone, no spikes
  return std::sqrt(square / all);
}

BOOST_AUTO_TEST_CASE(a_virtual_mass_resists_acceleration_in_size_and_phase) {
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (const double rate : {250.0, 500.0, 1000.0, 4000.0, 10000.0}) {
      double worst = 0;
      for (const double frequency : {0.5, 1.0, 2.0, 3.5, 5.0})
        worst = std::max(worst, error_of_mass(device(form), rate, frequency, Acceleration_estimate::default_cutoff));
      BOOST_TEST_MESSAGE(rate << " Hz: virtual mass off by at most " << 100 * worst << " % of m a, to 5 Hz");
      BOOST_TEST(worst <= 0.01);
    }
}

BOOST_AUTO_TEST_CASE(a_virtual_mass_comes_and_goes_and_its_energy_is_told) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral);
  const auto home = home_pose(parameters);
  const double rate = 1000, mass = 0.05;
  Handle_motion handle(parameters, *home, 1 / rate);
  Inertia_parameters wanted;
  wanted.mass = mass;
  Inertia_rendering inertia(wanted, parameters, 1 / rate, 0);
  Device_pose<double> pose = *home;
  Vector3d last = Vector3d::Zero();
  double energy = 0, kinetic = 0;
  for (int k = 0; k < 400; ++k) { // grabbed at 100, in motion; let go at 300
    const double t = k / rate, omega = 2 * M_PI * 2;
    const auto next =
        reach_position(parameters, pose, Vector3d(home->position + Vector3d(0, 0, 0.005 * (1 - std::cos(omega * t)))));
    energy -= last.dot(next->position - pose.position);
    pose = *next;
    handle.follow(pose.theta);
    const bool is_grabbed = k >= 100 && k < 300;
    const Vector3d force = inertia.force(handle, is_grabbed);
    if (k < 100 || k >= 351)
      BOOST_TEST(force == Vector3d::Zero());
    BOOST_TEST((force - last).norm() <= mass * 0.8 * (1 / (rate * Inertia_rendering::fade_time) + 0.03));
    last = force;
    if (k == 299)
      kinetic = mass * std::pow(0.005 * omega * std::sin(omega * t), 2) / 2;
  }
  BOOST_TEST(std::abs(inertia.mass_energy() - energy) <= 5e-3 * std::abs(energy));
  BOOST_TEST(std::abs(energy) > 1e-6);
  BOOST_TEST(kinetic > 0);
  Inertia_parameters bad;
  bad.mass = -1;
  BOOST_CHECK_THROW(Inertia_rendering(bad, parameters, 0.001, 0), Error);
  bad.mass = 0, bad.compensated = 1.5;
  BOOST_CHECK_THROW(Inertia_rendering(bad, parameters, 0.001, 0), Error);
  bad.compensated = 0.5, bad.cutoff = 0;
  BOOST_CHECK_THROW(Inertia_rendering(bad, parameters, 0.001, 0), Error);
}

/// The force that a hand gives to lead the handle along a sinusoid: the mechanism's own inertia and friction, less what
/// motors carry. Joint torques by inverse dynamics on the exact motion.
BOOST_AUTO_TEST_CASE(compensated_inertia_is_not_felt) {
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    Device_description<double> description = named_design<double>(Named_design::D1, form);
    description.gravity = 0;
    const Device_parameters<double> parameters(description);
    const auto home = home_pose(parameters);
    const double rate = 1000, omega = 2 * M_PI * 4;
    for (const double share : {0.5, 0.8}) {
      Handle_motion handle(parameters, *home, 1 / rate);
      Inertia_parameters wanted;
      wanted.compensated = share;
      Inertia_rendering inertia(wanted, parameters, 1 / rate, 0);
      double square = 0, all = 0;
      for (int k = 0; k < 1000; ++k) {
        const double t = k / rate;
        const Vector3d swing = 0.1 * Vector3d(1, -0.4, 0.6);
        const auto pose = forward_kinematics(parameters, Vector3d(home->theta + swing * std::sin(omega * t)), *home);
        handle.follow(pose->theta);
        const Vector3d force = inertia.force(handle, false);
        if (k < 200)
          continue;
        const auto torque = spatial_inverse_dynamics(parameters, *pose, Vector3d(swing * omega * std::cos(omega * t)),
                                                     Vector3d(-swing * omega * omega * std::sin(omega * t)));
        const Vector3d exact = share * torque->torque;
        square += (handle.jacobian().linear.transpose() * force - exact).squaredNorm(), all += exact.squaredNorm();
      }
      BOOST_TEST(std::sqrt(square / all) <= 0.02);
      BOOST_TEST(inertia.mass_energy() == 0);
      BOOST_TEST_MESSAGE("compensated inertia off by " << 100 * std::sqrt(square / all) << " %");
    }
  }
}

/// A hand presses on a plane whose stiffness is a multiple of the passive limit.
struct Pressed {
  double least = 0, buzz = 0, most_damping = 0; ///< J; mean |acceleration| in the second half, m/s^2; N s/m
};
Pressed press(double times, double most_damping) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral);
  const auto home = home_pose(parameters);
  const double tick = 0.001, sigma = translation_conditioning(*jacobian(parameters, *home)).greatest;
  const double stiffness = times * 2 * 0.005 / (sigma * sigma) / tick;
  const Hand_path path(
      {{0, home->position + Vector3d(0, 0, 0.002), 0}, {0.2, home->position - Vector3d(0, 0, 0.008), 0}});
  const auto start = reach_position(parameters, *home, path.at(0).position);
  Simulated_device simulated(parameters, *start, Simulated_hand::finger(), path, tick, 0);
  Handle_motion handle(parameters, *start, tick);
  Force_renderer renderer(no_limits(), Gravity_compensation::spatial, tick);
  Passivity_observer observer(0, tick, 0.005, 0);
  Passivity_controller controller(most_damping, tick);
  Pressed pressed;
  Vector3d last_step = Vector3d::Zero();
  for (int k = 0; k < 1000; ++k) {
    handle.follow(simulated.read().theta);
    observer.add_step(handle.joint_step(), stiffness, handle.step());
    const double depth = home->position[2] - handle.position()[2];
    const Vector3d wall(0, 0, stiffness * std::max(0.0, depth));
    const Rendered_force rendered = renderer.render(handle, wall + controller.force(observer, handle));
    observer.command(rendered.interaction_torque);
    if (simulated.write(rendered.torque, rendered.interaction_torque) != Device_status::success)
      break;
    pressed.least = std::min(pressed.least, simulated.port() + simulated.dissipated());
    pressed.most_damping = std::max(pressed.most_damping, controller.damping());
    if (k >= 500)
      pressed.buzz += (handle.step() - last_step).norm() / tick / tick / 500;
    last_step = handle.step();
  }
  return pressed;
}

BOOST_AUTO_TEST_CASE(a_controller_does_nothing_within_the_limit_and_takes_energy_back_beyond_it) {
  const Pressed passive = press(0.9, 5);
  BOOST_TEST(passive.most_damping == 0);
  BOOST_TEST(passive.least >= -1e-9);
  for (const double times : {7.0, 8.0, 10.0}) {
    const Pressed without = press(times, 0), with = press(times, 10);
    BOOST_TEST_MESSAGE(times << " times the passive limit: least energy " << without.least << " J and " << with.least
                             << " J with a controller; mean acceleration at rest " << without.buzz << " and "
                             << with.buzz << " m/s^2");
    BOOST_TEST(without.least < -1e-2); // it buzzes
    BOOST_TEST(with.least >= 0.02 * without.least);
    BOOST_TEST(with.buzz <= 0.02 * without.buzz);
  }
}

BOOST_AUTO_TEST_CASE(estimates_respond_to_sinusoids_as_they_say) {
  for (const double tick : {0.0001, 0.001, 0.004})
    for (const double cutoff : {30.0, 100.0})
      for (const double angle : {0.01, 0.3, 1.5, 3.0}) {
        Acceleration_estimate acceleration(tick, cutoff);
        Velocity_estimate velocity(tick, cutoff);
        const auto at = [&](int k) { return std::polar(1.0, angle * k); };
        std::complex<double> wanted_a, wanted_v;
        double a = 0, v = 0;
        for (int k = 0; k < 4000; ++k) {
          const Vector3d step(at(k).real(), 0, 0);
          a = acceleration.add(step)[0], v = velocity.add(step)[0];
          wanted_a = acceleration.response(angle) * (at(k) - at(k - 1)) / (tick * tick);
          wanted_v = velocity.response(angle) * at(k) / tick;
        }
        BOOST_TEST(std::abs(a - wanted_a.real()) <= 1e-9 * std::abs(wanted_a));
        BOOST_TEST(std::abs(v - wanted_v.real()) <= 1e-9 * std::abs(wanted_v));
      }
}

/// A free mass of 1 kg, pushed once, under a force that follows its steps and is held from tick to tick, `delay` late.
/// \return by how much the force is larger in the end than soon after the push
template <class Force>
double growth(double tick, double delay, const Force& force) {
  const int whole = static_cast<int>(delay), ticks = 6000;
  const double late = delay - whole;
  std::vector<double> commands(static_cast<std::size_t>(whole) + 2, 0.0); // the latest first
  double place = 0, last = 0, velocity = 0, earlier = 0, later = 0;
  const auto go = [&](double newtons, double time) {
    place += velocity * time + newtons * time * time / 2, velocity += newtons * time;
  };
  for (int k = 0; k < ticks; ++k) {
    std::rotate(commands.begin(), commands.end() - 1, commands.end());
    commands[0] = force(place - last) + (k == 0 ? 1 : 0);
    last = place;
    go(commands[static_cast<std::size_t>(whole) + 1], late * tick);
    go(commands[static_cast<std::size_t>(whole)], (1 - late) * tick);
    if (k >= 100 && k < 200)
      earlier = std::max(earlier, std::abs(commands[0]));
    if (k >= ticks - 100)
      later = std::max(later, std::abs(commands[0]));
  }
  return later / std::max(earlier, 1e-200);
}

BOOST_AUTO_TEST_CASE(a_free_mass_swings_by_itself_beyond_the_critical_gains_and_not_below) {
  Random random(5);
  std::uniform_real_distribution<double> delays(0, 3), exponents(-4, -2.4);
  for (int round = 0; round < 40; ++round) {
    const double tick = std::pow(10, exponents(random)), delay = round % 2 == 0 ? round / 2 % 4 : delays(random);
    const double ratio = critical_mass_ratio(tick, delay, 100), rate = critical_damping_rate(tick, delay);
    const double raw = critical_damping_rate(tick, delay, std::numeric_limits<double>::infinity());
    for (const double share : {0.97, 1.03}) {
      Acceleration_estimate acceleration(tick);
      Velocity_estimate velocity(tick);
      const double mass =
          growth(tick, delay, [&](double step) { return -share * ratio * acceleration.add(Vector3d(step, 0, 0))[0]; });
      const double damper =
          growth(tick, delay, [&](double step) { return -share * rate * velocity.add(Vector3d(step, 0, 0))[0]; });
      const double raw_damper = growth(tick, delay, [&](double step) { return -share * raw * step / tick; });
      for (const double grown : {mass, damper, raw_damper})
        BOOST_TEST((grown < 1) == (share < 1),
                   "a share of " << share << " at T = " << tick << " s, d = " << delay << " grows by " << grown);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_larger_than_stable_is_refused_with_what_serves) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral);
  const auto home = home_pose(parameters);
  const Workspace_map map(1, Vector3d::Zero(), Vector3d::Zero(), home->position);
  const Vector3d corner = Vector3d::Constant(0.02);
  const Passivity_limits limits = passivity_limits(parameters, Force_limits(), map, -corner, corner, 0, 0.001, 0);
  BOOST_TEST(limits.apparent_mass > 0.02);
  for (double x : {-0.019, 0.0, 0.019}) // no pose is lighter
    for (double y : {-0.019, 0.0, 0.019})
      for (double z : {-0.019, 0.0, 0.019}) {
        const auto pose = reach_position(parameters, *home, home->position + Vector3d(x, y, z));
        const auto terms = dynamics(parameters, Dynamics_model::spatial, *pose, Vector3d(0, 0, 0));
        const Eigen::Matrix3d mass = apparent_mass(terms->mass, jacobian(parameters, *pose)->linear);
        for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(0.6, 0, 0.8)})
          BOOST_TEST(way.dot(mass * way) >= limits.apparent_mass);
      }
  Inertia_parameters inertia;
  const auto check = [&](double damping, double mass, double controller) {
    inertia.mass = mass;
    check_dynamics(damping, inertia, controller, limits);
  };
  check(limits.largest_damping, limits.largest_mass, limits.largest_controller);
  const auto names = [](const char* what, double largest) {
    return [=](const Unstable_coupling& error) {
      const std::string text = error.what();
      return text.find(what) != std::string::npos && text.find(internal::number(largest)) != std::string::npos;
    };
  };
  BOOST_CHECK_EXCEPTION(check(1.001 * limits.largest_damping, 0, 0), Unstable_coupling,
                        names("the damping", limits.largest_damping));
  BOOST_CHECK_EXCEPTION(check(0, 1.001 * limits.largest_mass, 0), Unstable_coupling,
                        names("virtual mass", limits.largest_mass));
  BOOST_CHECK_EXCEPTION(check(0, 0, 1.001 * limits.largest_controller), Unstable_coupling,
                        names("controller", limits.largest_controller));
}

} // namespace
