// SPDX-License-Identifier: GPL-3.0-or-later
// What a simulated loop stands on: conditioning of the position Jacobian, gravity, friction, encoders, delays, a hand
// that moves along. A program of its own, because it counts allocations: Eigen's by its own switch, all others by
// operator new.
#define EIGEN_RUNTIME_NO_MALLOC
#include "../examples/count_allocations.h"
#include "maximal_coordinates.h"
#include <boost/test/unit_test.hpp>

namespace {

using namespace device_populations;
using Vector = Device_vector<double>;
using Long = long double;
constexpr unsigned seed = 20250311;
constexpr Device_form both_forms[] = {Device_form::ditetrahedral, Device_form::general};

Device_description<double> with_friction(Device_description<double> d, double viscous, double coulomb) {
  d.viscous_friction = viscous, d.coulomb_friction = coulomb;
  return d;
}

/// A hand: a mass, moved by a spring and a damper that follow a path, that holds the platform's centre by another
/// spring and damper. Place and velocity of its mass are the first six further states; then come, if there is room, the
/// work of the path and of friction done so far.
template <class S, int count>
struct Hand {
  const Device_parameters<S>& parameters;
  Device_vector<S> centre;
  S mass = S(1.46), arm_stiffness = S(48.8), arm_damping = S(4.5), grip_stiffness = S(375), grip_damping = S(7.9);

  Surroundings_effect<S, count> operator()(const Device_motion<S>& motion, const Further_states<S, count>& y,
                                           const S& time) const {
    using std::cos;
    using std::sin;
    const Device_vector<S> place = y.template head<3>(), velocity = y.template segment<3>(3);
    const Device_vector<S> swing(S(0.012), S(-0.008), S(0.006)), target = centre + sin(S(20) * time) * swing,
                                                                 speed = (S(20) * cos(S(20) * time)) * swing;
    const Device_vector<S> arm = arm_stiffness * (target - place) + arm_damping * (speed - velocity);
    const Device_vector<S> grip =
        grip_stiffness * (place - motion.pose.position) + grip_damping * (velocity - motion.velocity.linear);
    Surroundings_effect<S, count> effect;
    effect.torque = motion.jacobian.linear.transpose() * grip;
    effect.further_rate.setZero();
    effect.further_rate.template head<3>() = velocity;
    effect.further_rate.template segment<3>(3) = (arm - grip) / mass;
    if constexpr (count > 6) { // work of the path's spring on the hand, and what damping, friction and gravity
                               // compensation take or give
      effect.further_rate[6] = arm.dot(velocity);
      effect.further_rate[7] = joint_friction(parameters, motion.rate).dot(motion.rate);
      effect.further_rate[8] = grip.dot(motion.velocity.linear - velocity); // what the grip's spring and damper take
      const Device_vector<S> carried = gravity_torque(parameters, motion.pose, motion.jacobian);
      effect.torque += carried;
      effect.further_rate[9] = carried.dot(motion.rate);
    }
    return effect;
  }
};

template <class S, int count>
Coupled_state<S, count> at_rest(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  Coupled_state<S, count> state;
  state.device.pose = *forward_kinematics(parameters, theta);
  state.further.setZero();
  state.further.template head<3>() = state.device.pose.position;
  return state;
}

} // namespace

BOOST_AUTO_TEST_SUITE(device_simulation)

BOOST_AUTO_TEST_CASE(singular_values_of_the_position_jacobian_against_differences_and_another_decomposition) {
  BOOST_TEST_MESSAGE("seed " << seed);
  Random random(seed);
  double worst = 0, worst_direction = 0;
  int used = 0;
  for (Device_form form : both_forms)
    for (int k = 0; k < 300; ++k) {
      const Device_description<double> design = random_design(random, form);
      const Device_parameters<double> parameters(design);
      const Device_parameters<Long> fine(description_as<Long>(design));
      const Vector theta = random_angles(random, 0.5, 1.5);
      const auto pose = forward_kinematics(parameters, theta);
      if (!pose || conditioning(parameters, *pose)->constraint_condition > 20)
        continue;
      const auto map = jacobian(parameters, *pose);
      const auto found = translation_conditioning(*map);
      // The Jacobian once more, as differences of places in long double, and its values by Eigen.
      const auto start = forward_kinematics(fine, vector_as<Long>(theta));
      const Long h = 1e-4L;
      Device_matrix<Long> difference;
      for (int joint = 0; joint < 3; ++joint) {
        Device_vector<Long> column = Device_vector<Long>::Zero();
        for (int step : {-2, -1, 1, 2}) {
          Device_vector<Long> moved = vector_as<Long>(theta);
          moved[joint] += step * h;
          column += (step == 1 || step == -1 ? 8.0L : -1.0L) * (step > 0 ? 1 : -1) / (12 * h) *
                    forward_kinematics(fine, moved, *start)->position;
        }
        difference.col(joint) = column;
      }
      const Device_vector<Long> values = Eigen::JacobiSVD<Device_matrix<Long>>(difference).singularValues();
      const double greatest = static_cast<double>(values[0]), least = static_cast<double>(values[2]);
      worst =
          std::max({worst, std::abs(found.greatest - greatest) / greatest, std::abs(found.least - least) / greatest});
      BOOST_TEST(found.condition == found.greatest / found.least);
      for (int direction = 0; direction < 20; ++direction) { // no joint rate moves the centre faster or slower
        const double speed = (map->linear * random_vector(random, 1).normalized()).norm();
        worst_direction =
            std::max({worst_direction, speed / found.greatest - 1, (found.least - speed) / found.greatest});
      }
      ++used;
    }
  BOOST_TEST_MESSAGE(used << " poses: singular values off by " << worst << " of the greatest");
  BOOST_TEST(used > 300);
  BOOST_TEST(worst < 1e-8);
  BOOST_TEST(worst_direction < 1e-14);
  // A straight knee: its joint moves nothing, and in that direction nothing can be moved or felt.
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  Device_jacobian<double> flat;
  flat.linear << 0.1, 0.2, 0, 0.3, 0.1, 0, 0.2, 0.1, 0;
  flat.angular.setZero();
  BOOST_TEST(translation_conditioning(flat).condition > 1e15);
  flat.linear.setZero();
  BOOST_TEST((translation_conditioning(flat).condition == HUGE_VAL && translation_conditioning(flat).least == 0));
}

BOOST_AUTO_TEST_CASE(gravity_alone_is_the_slope_of_the_potential_energy) {
  Random random(seed + 1);
  double worst = 0, worst_slope = 0;
  for (Device_form form : both_forms)
    for (int k = 0; k < 300; ++k) {
      Device_description<double> design = random_design(random, form);
      design.gravity = uniform(random, -12, 12);
      const Device_parameters<double> parameters(design);
      const Device_parameters<Long> fine(description_as<Long>(design));
      const Vector theta = random_angles(random, 0.5, 1.5);
      const auto pose = forward_kinematics(parameters, theta);
      if (!pose || conditioning(parameters, *pose)->constraint_condition > 20)
        continue;
      const Vector found = gravity_torque(parameters, *pose, *jacobian(parameters, *pose));
      const auto terms = dynamics(parameters, Dynamics_model::spatial, *pose, Vector(Vector::Zero()));
      worst = std::max(worst, (found - terms->gravity).norm() / terms->gravity.norm());
      const auto start = forward_kinematics(fine, vector_as<Long>(theta));
      const auto potential = [&](const Device_vector<Long>& angles) { // from the places of the parts alone
        const auto there = forward_kinematics(fine, angles, *start);
        Long height = fine.platform_mass() * there->position[2];
        for (int leg = 0; leg < 3; ++leg)
          height += fine.primary_mass() * there->elbows(2, leg) / 2 +
                    fine.secondary_mass() * (there->elbows(2, leg) + there->joints(2, leg)) / 2;
        return Long(fine.gravity() * height);
      };
      for (int joint = 0; joint < 3; ++joint) {
        const Long h = 1e-5L;
        Device_vector<Long> ahead = vector_as<Long>(theta), behind = ahead;
        ahead[joint] += h, behind[joint] -= h;
        const double slope = static_cast<double>((potential(ahead) - potential(behind)) / (2 * h));
        worst_slope = std::max(worst_slope, std::abs(slope - found[joint]) / found.norm());
      }
    }
  BOOST_TEST_MESSAGE("gravity: from the whole model " << worst << ", from differences of the potential " << worst_slope
                                                      << " (relative)");
  BOOST_TEST(worst < 1e-13);
  BOOST_TEST(worst_slope < 1e-7);
}

BOOST_AUTO_TEST_CASE(friction_encoders_and_delays_are_what_they_say) {
  Device_description<double> d =
      with_friction(named_design<double>(Named_design::D1, Device_form::general), 3e-4, 2e-3);
  d.encoder_step = 1.53e-4;
  const Device_parameters<double> parameters(d);
  Random random(seed + 2);
  for (int k = 0; k < 1000; ++k) {
    const Vector rate = random_vector(random, k % 2 ? 5 : 0.05), torque = joint_friction(parameters, rate),
                 theta = random_vector(random, 3);
    BOOST_TEST((torque + joint_friction(parameters, Vector(-rate))).norm() == 0);
    const Vector measured = measured_angles(parameters, theta);
    for (int joint = 0; joint < 3; ++joint) {
      BOOST_TEST(torque[joint] * rate[joint] <= 0);
      BOOST_TEST(std::abs(torque[joint] + 3e-4 * rate[joint]) <= 2e-3);
      BOOST_TEST(std::abs(torque[joint] + 3e-4 * rate[joint] + 2e-3 * std::tanh(rate[joint] / 0.02)) < 1e-17);
      BOOST_TEST(std::abs(measured[joint] - theta[joint]) <= 1.53e-4 / 2 * (1 + 1e-9));
      const double count = measured[joint] / 1.53e-4;
      BOOST_TEST(std::abs(count - std::round(count)) < 1e-9);
    }
  }
  BOOST_TEST(coulomb_rate<double>() == 0.02);
  BOOST_TEST(joint_friction(parameters, Vector(HUGE_VAL, 1, -HUGE_VAL))[0] == -HUGE_VAL);
  d.encoder_step = 0;
  BOOST_TEST((measured_angles(Device_parameters<double>(d), Vector(0.1, -0.2, 0.3)) - Vector(0.1, -0.2, 0.3)).norm() ==
             0);
  for (double Device_description<double>::*member :
       {&Device_description<double>::viscous_friction, &Device_description<double>::coulomb_friction,
        &Device_description<double>::encoder_step})
    for (double value : {-1e-9, double(HUGE_VAL), std::nan("")}) {
      Device_description<double> bad = d;
      bad.*member = value;
      BOOST_TEST(violations(bad).size() == 1u);
    }

  for (double delay : {0.0, 0.25, 0.999, 1.0, 1.6, 2.0, 15.5, 16.0}) { // against the torque as a function of time
    Torque_delay<double> held(delay);
    std::vector<Vector> commanded;
    const auto in_force = [&](double ticks) { // commanded at tick k, in force from k + delay to k + 1 + delay
      const double k = std::floor(ticks - delay);
      return k < 0 ? Vector(Vector::Zero()) : commanded[static_cast<std::size_t>(k)];
    };
    for (int tick = 0; tick < 100; ++tick) {
      commanded.push_back(random_vector(random, 1));
      held.command(commanded.back());
      const double fraction = held.fraction();
      BOOST_TEST(std::abs(delay - std::floor(delay) - fraction) == 0);
      Vector sum = Vector::Zero();
      for (int part = 0; part < 1000; ++part)
        sum += in_force(tick + (part + 0.5) / 1000) / 1000;
      BOOST_TEST((held.mean() - sum).norm() < 2e-3);
      BOOST_TEST((held.after() - in_force(tick + (1 + fraction) / 2)).norm() == 0);
      if (fraction > 0)
        BOOST_TEST((held.before() - in_force(tick + fraction / 2)).norm() == 0);
    }
  }
  for (double delay : {-1e-9, 16.001, double(HUGE_VAL), std::nan("")})
    BOOST_CHECK_THROW(Torque_delay<double>{delay}, Error);
}

BOOST_AUTO_TEST_CASE(the_coupled_step_is_of_fourth_order_and_solves_the_equations_of_another_formulation) {
  for (Device_form form : both_forms) {
    const Device_parameters<double> parameters(with_friction(named_design<double>(Named_design::D1, form), 2e-4, 1e-4));
    const Vector theta(1.0, 1.1, 0.95);
    Hand<double, 6> hand{parameters, forward_kinematics(parameters, theta)->position};
    hand.grip_stiffness = 100, hand.grip_damping = 0.5; // a loose grip
    const Coupled_state<double, 6> start = [&] {
      Coupled_state<double, 6> s = at_rest<double, 6>(parameters, theta);
      // No joint stops on the way: there Coulomb friction turns over faster than coarse steps resolve.
      s.device.rate = Vector(4, 3.5, 3);
      return s;
    }();
    const double length = 0.008;
    const auto end = [&](int steps) {
      Coupled_state<double, 6> state = start;
      for (int k = 0; k < steps; ++k)
        state = *runge_kutta_step(parameters, Dynamics_model::spatial, state, k * length / steps, length / steps, hand);
      return state;
    };
    // The same by seven bodies with multipliers, midpoint steps extrapolated twice (fourth order), place of the hand
    // included.
    const auto slope = [&](const Eigen::Matrix<double, 12, 1>& x, double time) {
      const auto pose = forward_kinematics(parameters, Vector(x.head<3>()), start.device.pose);
      const auto motion = device_motion(parameters, *pose, Vector(x.segment<3>(3)));
      const auto effect = hand(*motion, Eigen::Matrix<double, 6, 1>(x.tail<6>()), time);
      const Vector rate = x.segment<3>(3);
      Vector torque = effect.torque;
      for (int joint = 0; joint < 3; ++joint)
        torque[joint] -= 2e-4 * rate[joint] + 1e-4 * std::tanh(50 * rate[joint]);
      Eigen::Matrix<double, 12, 1> s;
      s << rate, maximal_coordinates::joint_accelerations(parameters, *pose, rate, torque), effect.further_rate;
      return s;
    };
    const auto reference = [&](int steps) {
      Eigen::Matrix<double, 12, 1> x;
      x << theta, start.device.rate, start.further;
      for (int k = 0; k < steps; ++k) {
        const double h = length / steps, t = k * h;
        const auto half = Eigen::Matrix<double, 12, 1>(x + h / 2 * slope(x, t));
        x += h * slope(half, t + h / 2);
      }
      return x;
    };
    // Midpoint errors have all powers from the second on; two extrapolations take the second and third.
    const auto a = reference(40), b = reference(80), c = reference(160);
    const Eigen::Matrix<double, 12, 1> ab = b + (b - a) / 3, bc = c + (c - b) / 3, truth = bc + (bc - ab) / 7;
    const auto distance = [&](const Coupled_state<double, 6>& s) {
      Eigen::Matrix<double, 12, 1> x;
      x << s.device.pose.theta, s.device.rate, s.further;
      return (x - truth).norm();
    };
    const auto best = end(128);
    const auto error = [&](int steps) {
      const auto s = end(steps);
      return (s.device.pose.theta - best.device.pose.theta).norm() + (s.device.rate - best.device.rate).norm() +
             (s.further - best.further).norm();
    };
    const double order = std::log2(error(8) / error(16));
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                       << ": order " << order << ", differs from seven bodies by " << distance(best));
    BOOST_TEST(order > 3.6);
    BOOST_TEST(order < 4.6);
    BOOST_TEST(distance(best) < 1e-9);
    BOOST_TEST((best.device.rate - start.device.rate).norm() > 0.1); // something happened
    BOOST_TEST(best.device.rate.minCoeff() > 0.5);                   // and no joint came to rest
  }
}

BOOST_AUTO_TEST_CASE(energy_is_accounted_for_with_friction_a_hand_and_gravity_compensation) {
  for (Device_form form : both_forms) {
    const Device_parameters<double> parameters(with_friction(named_design<double>(Named_design::D1, form), 5e-4, 1e-3));
    const Vector theta(1.0, 1.1, 0.95);
    Coupled_state<double, 10> state = at_rest<double, 10>(parameters, theta);
    const Hand<double, 10> hand{parameters, state.device.pose.position};
    const auto energy = [&] {
      const auto terms = dynamics(parameters, Dynamics_model::spatial, state.device.pose, state.device.rate);
      return terms->kinetic + terms->potential + 0.5 * hand.mass * state.further.segment<3>(3).squaredNorm();
    };
    const double before = energy();
    double worst = 0, dissipated = 0;
    for (int k = 0; k < 2000; ++k) {
      state = *runge_kutta_step(parameters, Dynamics_model::spatial, state, k * 5e-4, 5e-4, hand);
      BOOST_REQUIRE(state.further[7] <= dissipated); // friction never gives back
      dissipated = state.further[7];
      // What the path, friction and the motors have put in; the grip's spring and damper have taken the rest.
      worst = std::max(worst, std::abs(energy() - before -
                                       (state.further[6] + state.further[7] + state.further[8] + state.further[9])));
    }
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                       << ": path " << state.further[6] << " J, friction " << dissipated << " J, unaccounted at most "
                       << worst << " J in one second");
    BOOST_TEST(dissipated < -1e-4);
    BOOST_TEST(worst < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(double_follows_long_double) {
  for (Device_form form : both_forms) {
    const Device_description<double> design = with_friction(named_design<double>(Named_design::D1, form), 5e-4, 1e-3);
    const Device_parameters<double> parameters(design);
    const Device_parameters<Long> fine(description_as<Long>(design));
    const Vector theta(1.0, 1.1, 0.95);
    auto state = at_rest<double, 10>(parameters, theta);
    auto exact = at_rest<Long, 10>(fine, vector_as<Long>(theta));
    const Hand<double, 10> hand{parameters, state.device.pose.position};
    Hand<Long, 10> fine_hand{fine, vector_as<Long>(state.device.pose.position)};
    fine_hand.mass = 1.46, fine_hand.arm_stiffness = 48.8, fine_hand.arm_damping = 4.5, fine_hand.grip_damping = 7.9;
    for (int k = 0; k < 500; ++k) {
      state = *runge_kutta_step(parameters, Dynamics_model::spatial, state, k * 0.0009765625, 0.0009765625, hand);
      exact = *runge_kutta_step(fine, Dynamics_model::spatial, exact, k * 0.0009765625L, 0.0009765625L, fine_hand);
    }
    const double off =
        (exact.device.pose.position.cast<double>() - state.device.pose.position).norm() / design.secondary_length;
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                       << ": after 500 steps double is off by " << off << " of l2");
    BOOST_TEST(off < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(two_substeps_a_tick_are_as_good_as_forty) {
  BOOST_TEST_MESSAGE("seed " << seed + 3);
  Random random(seed + 3);
  double worst = 0;
  for (Device_form form : both_forms)
    for (double delay : {0.0, 0.25, 0.6, 1.0, 1.75}) {
      const Device_parameters<double> parameters(
          with_friction(named_design<double>(Named_design::D1, form), 2e-4, 1e-3));
      auto coarse = at_rest<double, 6>(parameters, Vector(1.0, 1.1, 0.95)), fine = coarse;
      Hand<double, 6> hand{parameters, coarse.device.pose.position};
      hand.arm_stiffness = 2000, hand.arm_damping = 60; // a firm arm: up to 8 rad/s at the joints
      Torque_delay<double> held(delay), held_fine(delay);
      const auto torque = [&](const Coupled_state<double, 6>& state,
                              const Vector& wall) { // a stiff wall
        const auto map = jacobian(parameters, state.device.pose);
        const double depth = wall.dot(state.device.pose.position - hand.centre);
        const Vector force = depth > 0 ? Vector(-600 * depth * wall) : Vector(Vector::Zero());
        return Vector(map->torque(force, Vector::Zero()) + gravity_torque(parameters, state.device.pose, *map));
      };
      const Vector wall = random_vector(random, 1).normalized();
      double farthest = 0;
      for (int tick = 0; tick < 300; ++tick) {
        held.command(torque(coarse, wall)), held_fine.command(torque(fine, wall));
        const auto next = simulate_tick(parameters, Dynamics_model::spatial, coarse, tick * 1e-3, 1e-3, held, hand);
        const auto next_fine =
            simulate_tick(parameters, Dynamics_model::spatial, fine, tick * 1e-3, 1e-3, held_fine, hand, 40);
        BOOST_REQUIRE((next && next_fine));
        coarse = *next, fine = *next_fine;
        farthest = std::max(farthest, (coarse.device.pose.position - hand.centre).norm());
        worst = std::max(worst, (coarse.device.pose.position - fine.device.pose.position).norm());
      }
      BOOST_TEST(farthest > 1e-2);
    }
  BOOST_TEST_MESSAGE("at 1 kHz with Coulomb friction, 10 runs of 300 ticks: two substeps differ from forty by at most "
                     << worst << " m");
  BOOST_TEST(worst < 9e-7);
}

BOOST_AUTO_TEST_CASE(a_tick_is_split_where_the_torque_changes) {
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  const auto start = at_rest<double, 6>(parameters, Vector(1.0, 1.1, 0.95));
  const Hand<double, 6> hand{parameters, start.device.pose.position};
  const Vector old_torque(0.05, -0.02, 0.01), new_torque(-0.03, 0.04, 0.02);
  for (double delay : {0.0, 0.3, 0.5, 0.97}) {
    Torque_delay<double> held(delay);
    held.command(old_torque), held.command(new_torque);
    const auto got = simulate_tick(parameters, Dynamics_model::spatial, start, 0.0, 1e-3, held, hand, 20);
    Coupled_state<double, 6> state = start; // the same by hand, one part after the other
    const auto under = [&](const Vector& torque, double from, double length) {
      for (int k = 0; k < 50 && length > 0; ++k)
        state =
            *runge_kutta_step(parameters, Dynamics_model::spatial, state, from + k * length / 50, length / 50,
                              [&](const Device_motion<double>& motion, const Further_states<double, 6>& y, double now) {
                                auto effect = hand(motion, y, now);
                                effect.torque += torque;
                                return effect;
                              });
    };
    under(old_torque, 0, delay * 1e-3);
    under(new_torque, delay * 1e-3, (1 - delay) * 1e-3);
    BOOST_TEST((got->device.rate - state.device.rate).norm() < 1e-9);
    BOOST_TEST((got->further - state.further).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(failures_are_results_and_leave_the_state_alone) {
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  const auto start = at_rest<double, 6>(parameters, Vector(1.0, 1.1, 0.95));
  const auto with = [](double torque, double slope) {
    return [=](const Device_motion<double>&, const Further_states<double, 6>&, double) {
      return Surroundings_effect<double, 6>{Vector::Constant(torque), Further_states<double, 6>::Constant(slope)};
    };
  };
  BOOST_TEST((runge_kutta_step(parameters, Dynamics_model::spatial, start, 0.0, 1e-3, with(std::nan(""), 0)).status() ==
              Device_status::not_finite));
  BOOST_TEST((runge_kutta_step(parameters, Dynamics_model::spatial, start, 0.0, 1e-3, with(0, HUGE_VAL)).status() ==
              Device_status::not_finite));
  BOOST_TEST((runge_kutta_step(parameters, Dynamics_model::spatial, start, 0.0, 10.0, with(0.2, 0)).status() !=
              Device_status::success));
  Torque_delay<double> held(0.5);
  BOOST_TEST(
      (simulate_tick(parameters, Dynamics_model::spatial, start, 0.0, 1e-3, held, with(0, std::nan(""))).status() ==
       Device_status::not_finite));
  const auto weightless = [] {
    Device_description<double> d;
    d.primary_mass = d.secondary_mass = d.platform_mass = 0;
    d.platform_inertia.setZero();
    return Device_parameters<double>(d);
  }();
  BOOST_TEST((forward_dynamics(weightless, Dynamics_model::spatial, start.device.pose, Vector(Vector::Zero()),
                               Vector(0.1, 0, 0))
                  .status() == Device_status::singular));
}

BOOST_AUTO_TEST_CASE(nothing_is_allocated) {
  for (Device_form form : both_forms) {
    Device_description<double> d = with_friction(named_design<double>(Named_design::D1, form), 5e-4, 1e-3);
    d.encoder_step = 1.53e-4;
    const Device_parameters<double> parameters(d);
    auto state = at_rest<double, 10>(parameters, Vector(1.0, 1.1, 0.95));
    const Hand<double, 10> hand{parameters, state.device.pose.position};
    Torque_delay<double> held(0.7);
    Device_pose<double> seen = state.device.pose;
    double sum = 0;
    bool good = true;
    const std::size_t before = allocations_so_far;
    Eigen::internal::set_is_malloc_allowed(false);
    for (int tick = 0; tick < 100 && good; ++tick) {
      const auto pose = forward_kinematics(parameters, measured_angles(parameters, state.device.pose.theta), seen);
      good = static_cast<bool>(pose);
      seen = *pose;
      const auto map = jacobian(parameters, seen);
      sum += translation_conditioning(*map).condition;
      held.command(Vector(gravity_torque(parameters, seen, *map) + joint_friction(parameters, state.device.rate)));
      const auto next = simulate_tick(parameters, Dynamics_model::spatial, state, tick * 1e-3, 1e-3, held, hand);
      good = good && next;
      state = *next;
    }
    Eigen::internal::set_is_malloc_allowed(true);
    BOOST_TEST(good);
    BOOST_TEST(allocations_so_far == before);
    BOOST_TEST(sum > 100);
  }
}

BOOST_AUTO_TEST_SUITE_END()
