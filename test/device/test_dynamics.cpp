// SPDX-License-Identifier: GPL-3.0-or-later
#include "maximal_coordinates.h"
#include "device/symplectic_step.h"
#include <shared_data.h>

#include <boost/test/unit_test.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

namespace {

using namespace device_populations;
using Vector = Device_vector<double>;
using Matrix = Device_matrix<double>;
constexpr unsigned seed = 20240612;

/// Calls f(parameters, pose, rate) for well-conditioned random states of both forms; returns how many.
template <class F> int for_random_states(int tries, unsigned seed_of_population, const F& f) {
  BOOST_TEST_MESSAGE("seed " << seed_of_population);
  Random random(seed_of_population);
  int used = 0;
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (int k = 0; k < tries; ++k) {
      const Device_parameters<double> parameters(random_design(random, form));
      const Vector theta = random_angles(random, 0.5, 1.5), rate = random_vector(random, 5);
      const auto pose = forward_kinematics(parameters, theta);
      const auto c = pose ? conditioning(parameters, *pose) : Outcome<Conditioning<double>>();
      if (!c || c->constraint_condition > 10 || c->least_transmission < 0.05)
        continue;
      f(parameters, *pose, rate, random);
      ++used;
    }
  return used;
}

double energy(const Device_parameters<double>& parameters, Dynamics_model model, const Device_pose<double>& pose,
              const Vector& rate) {
  const auto terms = dynamics(parameters, model, pose, rate);
  return terms->kinetic + terms->potential;
}

} // namespace

BOOST_AUTO_TEST_SUITE(device_dynamics)

BOOST_AUTO_TEST_CASE(spatial_model_agrees_with_a_constrained_simulation_in_maximal_coordinates) {
  double worst = 0;
  const int used =
      for_random_states(400, seed, [&](const auto& parameters, const auto& pose, const Vector& rate, Random& random) {
        const Vector torque = random_vector(random, 0.05);
        const Vector expected = maximal_coordinates::joint_accelerations(parameters, pose, rate, torque);
        const auto found = forward_dynamics(parameters, Dynamics_model::spatial, pose, rate, torque);
        BOOST_REQUIRE(static_cast<bool>(found));
        worst = std::max(worst, (found->acceleration - expected).norm() / expected.norm());
        const auto back = spatial_inverse_dynamics(parameters, pose, rate, found->acceleration);
        BOOST_TEST((back->torque - torque).norm() < 1e-12);
      });
  BOOST_TEST_MESSAGE(used << " states, worst relative difference of accelerations " << worst);
  BOOST_TEST(used > 200);
  BOOST_TEST(worst < 1e-10);
}

BOOST_AUTO_TEST_CASE(mass_coriolis_gravity_and_power_are_those_of_a_mechanical_system) {
  double worst_rate = 0, worst_gravity = 0, worst_power = 0;
  const int used = for_random_states(
      300, seed + 1, [&](const auto& parameters, const auto& pose, const Vector& rate, Random& random) {
        for (Dynamics_model model : {Dynamics_model::spatial, Dynamics_model::planar}) {
          const auto terms = dynamics(parameters, model, pose, rate);
          BOOST_REQUIRE(static_cast<bool>(terms));
          BOOST_TEST((terms->mass - terms->mass.transpose()).norm() == 0);
          BOOST_TEST((Eigen::SelfAdjointEigenSolver<Matrix>(terms->mass).eigenvalues().minCoeff() > 0));
          const double h = 1e-5;
          Matrix mass_rate = Matrix::Zero();
          Vector slope;
          for (int joint = 0; joint < 3; ++joint) {
            Vector theta = pose.theta;
            theta[joint] += h;
            const auto ahead = forward_kinematics(parameters, theta, pose);
            theta[joint] -= 2 * h;
            const auto behind = forward_kinematics(parameters, theta, pose);
            const auto after = dynamics(parameters, model, *ahead, Vector(Vector::Zero())),
                       before = dynamics(parameters, model, *behind, Vector(Vector::Zero()));
            mass_rate += (after->mass - before->mass) / (2 * h) * rate[joint];
            slope[joint] = (after->potential - before->potential) / (2 * h);
          }
          worst_rate = std::max(worst_rate, (mass_rate - terms->coriolis - terms->coriolis.transpose()).norm() /
                                                terms->coriolis.norm());
          worst_gravity = std::max(worst_gravity, (slope - terms->gravity).norm() / terms->gravity.norm());
          const Vector torque = random_vector(random, 0.05), acceleration = terms->acceleration(rate, torque);
          const double t = 1e-6; // power balance: dE/dt along the motion is what the motors put in
          const auto later =
              forward_kinematics(parameters, Vector(pose.theta + t * rate + t * t / 2 * acceleration), pose);
          const auto earlier =
              forward_kinematics(parameters, Vector(pose.theta - t * rate + t * t / 2 * acceleration), pose);
          const double power = (energy(parameters, model, *later, rate + t * acceleration) -
                                energy(parameters, model, *earlier, rate - t * acceleration)) /
                               (2 * t);
          worst_power = std::max(worst_power, std::abs(power - torque.dot(rate)) /
                                                  (std::abs(torque.dot(rate)) + rate.norm() * terms->gravity.norm()));
        }
      });
  BOOST_TEST_MESSAGE(used << " states; dM/dt - C - C^T " << worst_rate << ", gravity - grad P " << worst_gravity
                          << ", power " << worst_power << " (relative)");
  BOOST_TEST(worst_rate < 1e-6);
  BOOST_TEST(worst_gravity < 1e-7);
  BOOST_TEST(worst_power < 1e-6);
}

BOOST_AUTO_TEST_CASE(runge_kutta_is_of_fourth_order_and_the_symplectic_step_of_sixth) {
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::general));
  const Vector rest(1.1, 1.1, 1.1);
  const auto spring = [&](const Device_pose<double>& pose, const Vector&, double) {
    return Vector(-0.2 * (pose.theta - rest));
  };
  const Device_state<double> start{*forward_kinematics(parameters, Vector(1.08, 1.22, 0.98)), Vector(1.5, -1, 0.7)};
  auto end = [&](int steps, bool symplectic) {
    Device_state<double> state = start;
    for (int k = 0; k < steps; ++k) {
      const double step = 0.064 / steps;
      const auto next = symplectic
                            ? symplectic_step(parameters, Dynamics_model::spatial, state, k * step, step, spring)
                            : runge_kutta_step(parameters, Dynamics_model::spatial, state, k * step, step, spring);
      BOOST_REQUIRE(static_cast<bool>(next));
      state = *next;
    }
    return state.pose.theta;
  };
  const Vector truth = end(256, true);
  const double coarse = (end(16, false) - truth).norm(), fine = (end(32, false) - truth).norm();
  const double coarse_6 = (end(8, true) - truth).norm(), fine_6 = (end(16, true) - truth).norm();
  BOOST_TEST_MESSAGE("Runge-Kutta: order " << std::log2(coarse / fine) << ", error " << fine << "; symplectic: order "
                                           << std::log2(coarse_6 / fine_6) << ", error " << fine_6);
  BOOST_TEST(std::log2(coarse / fine) > 3.7);
  BOOST_TEST(std::log2(coarse / fine) < 4.6);
  BOOST_TEST(std::log2(coarse_6 / fine_6) > 5.5);
}

BOOST_AUTO_TEST_CASE(energy_and_constraints_over_ten_seconds_on_springs) {
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (Dynamics_model model : {Dynamics_model::spatial, Dynamics_model::planar}) {
      const Device_parameters<double> parameters(named_design<double>(Named_design::D1, form));
      const Vector rest(1.1, 1.1, 1.1);
      const auto spring = [&](const Device_pose<double>& pose, const Vector&, double) {
        return Vector(-0.2 * (pose.theta - rest));
      };
      Device_state<double> state{*forward_kinematics(parameters, Vector(1.08, 1.22, 0.98)), Vector(1.5, -1, 0.7)};
      auto total = [&] {
        return energy(parameters, model, state.pose, state.rate) + 0.1 * (state.pose.theta - rest).squaredNorm();
      };
      const double before = total();
      double drift = 0, constraint = 0;
      for (int k = 0; k < 10000; ++k) {
        const auto next = symplectic_step(parameters, model, state, k * 1e-3, 1e-3, spring);
        BOOST_REQUIRE(static_cast<bool>(next));
        state = *next;
        if (k % 10 == 0 || k == 9999) {
          drift = std::max(drift, std::abs(total() - before) / std::abs(before));
          constraint =
              std::max(constraint,
                       nine_equation_residual(parameters, state.pose.elbows, state.pose.joints).cwiseAbs().maxCoeff());
        }
      }
      BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                         << (model == Dynamics_model::spatial ? ", spatial" : ", planar") << ": relative energy drift "
                         << drift << ", constraint residual " << constraint);
      BOOST_TEST(drift <= 1e-10);
      BOOST_TEST(constraint < 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(reference_trajectory) {
  const auto path = haptic_sculpt::test::shared_data("device/reference_sample.json");
  if (!path)
    return;
  std::ifstream file(*path);
  const nlohmann::json reference = nlohmann::json::parse(file);
  auto vector = [](const nlohmann::json& j) {
    return Vector(j[0].get<double>(), j[1].get<double>(), j[2].get<double>());
  };
  for (const auto& t : reference["trajectories"]) {
    const auto& p = t["params"];
    Device_description<double> d;
    d.form = p["form"] == "general" ? Device_form::general : Device_form::ditetrahedral;
    d.base_radius = p["R"], d.primary_length = p["l1"], d.secondary_length = p["l2"], d.platform_radius = p["r"];
    d.primary_mass = p["m1"], d.secondary_mass = p["m2"], d.platform_mass = p["M"], d.rotor_inertia = p["Jm"],
    d.gravity = p["g"];
    d.platform_inertia = vector(p["I"]);
    const Device_parameters<double> parameters(d);
    const double stiffness = t["k"];
    const Vector rest = vector(t["theta_ref"]);
    const auto spring = [&](const Device_pose<double>& pose, const Vector&, double) {
      return Vector(-stiffness * (pose.theta - rest));
    };
    const auto model = t["model"] == "paper" ? Dynamics_model::planar : Dynamics_model::spatial;
    Device_state<double> state{*forward_kinematics(parameters, vector(t["theta0"])), vector(t["thetad0"])};
    double now = 0;
    for (std::size_t k = 0; k < t["t"].size(); ++k) {
      const double until = t["t"][k];
      const int steps = static_cast<int>(std::lround((until - now) / 2.5e-4));
      for (int s = 0; s < steps; ++s)
        state = *symplectic_step(parameters, model, state, 0.0, (until - now) / steps, spring);
      now = until;
      const double error = (state.pose.theta - vector(t["theta"][k])).norm();
      BOOST_TEST_MESSAGE("t = " << now << ": angles differ by " << error);
      BOOST_TEST(error < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
