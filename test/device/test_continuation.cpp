// SPDX-License-Identifier: GPL-3.0-or-later
// Poses of the general form that continue others, beside many small steps of Newton's method on the paper's nine
// equations, whose unknowns are the places of the platform's joints.
#include "device/kinematics_of_tests.h"

#include <Eigen/LU>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <string>

BOOST_AUTO_TEST_SUITE(device_kinematics)

namespace {

using Unknowns = Eigen::VectorXd;

Device_matrix<double> elbows_at(const Device_parameters<double>& parameters, const Vector& theta) {
  Device_matrix<double> elbows;
  for (int i = 0; i < 3; ++i) {
    const double radius = parameters.base_radius() + parameters.primary_length() * std::cos(theta[i]),
                 direction = i * 2 * EIGEN_PI / 3;
    elbows.col(i) << radius * std::cos(direction), radius * std::sin(direction),
        parameters.primary_length() * std::sin(theta[i]);
  }
  return elbows;
}

struct Way {
  bool is_followed = true; // else Newton's method ends, or leaps, or turns its determinant's sign
  double worst = 0;        // the largest row sum of the inverse derivative met
  Unknowns end;
};

// The zeros of equations(part of the way, unknowns), from one at 0.
template <class Equations>
Way follow(const Equations& equations, const Unknowns& start, int steps, double most_of_a_step) {
  Way way{true, 0, start};
  bool is_positive = false;
  for (int k = 1; k <= steps; ++k) {
    Unknowns x = way.end;
    const double part = static_cast<double>(k) / steps;
    bool is_found = false;
    for (int iteration = 0; iteration < 8 && !is_found; ++iteration) {
      Eigen::MatrixXd derivative(x.size(), x.size());
      const double h = 1e-6;
      for (int i = 0; i < x.size(); ++i) {
        const Unknowns by = h * Unknowns::Unit(x.size(), i);
        derivative.col(i) = (equations(part, Unknowns(x + by)) - equations(part, Unknowns(x - by))) / (2 * h);
      }
      const Eigen::PartialPivLU<Eigen::MatrixXd> lu(derivative);
      if (iteration == 0) {
        way.worst = std::max(way.worst, lu.inverse().cwiseAbs().rowwise().sum().maxCoeff());
        const bool positive = lu.determinant() > 0;
        if (k > 1 && positive != is_positive)
          way.is_followed = false;
        is_positive = positive;
      }
      const Unknowns step = lu.solve(equations(part, x));
      x -= step;
      is_found = step.cwiseAbs().maxCoeff() < 1e-11;
    }
    if (!is_found || !((x - way.end).cwiseAbs().maxCoeff() < most_of_a_step))
      way.is_followed = false;
    if (!way.is_followed)
      break;
    way.end = x;
  }
  return way;
}

Way follow_joints(const Device_parameters<double>& parameters, const Device_pose<double>& from, const Vector& theta) {
  const auto equations = [&](double part, const Unknowns& x) {
    const Device_matrix<double> joints = Eigen::Map<const Device_matrix<double>>(x.data());
    return Unknowns(
        nine_equation_residual(parameters, elbows_at(parameters, from.theta + part * (theta - from.theta)), joints));
  };
  const double turn = (theta - from.theta).cwiseAbs().maxCoeff();
  return follow(equations, Eigen::Map<const Unknowns>(from.joints.data(), 9), 10 + static_cast<int>(turn / 1e-3), 0.01);
}

Way follow_centre(const Device_parameters<double>& parameters, const Device_pose<double>& from, const Vector& place) {
  const auto equations = [&](double part, const Unknowns& x) {
    const Device_matrix<double> joints = Eigen::Map<const Device_matrix<double>>(x.data());
    Unknowns f(12);
    f << nine_equation_residual(parameters, elbows_at(parameters, x.tail<3>()), joints),
        (joints.rowwise().sum() / 3 - from.position - part * (place - from.position)) / parameters.secondary_length();
    return f;
  };
  Unknowns start(12);
  start << Eigen::Map<const Unknowns>(from.joints.data(), 9), from.theta;
  return follow(equations, start, 10 + static_cast<int>((place - from.position).norm() / 5e-5), 0.05);
}

Device_parameters<double> random_parameters(Random& random, int k) {
  return Device_parameters<double>(k % 4 < 3 ? named_design<double>(Named_design(k % 4), Device_form::general)
                                             : random_design(random, Device_form::general));
}

// Of the inverse derivative, at steps of 1e-3 rad: below the first no singular pose is between two of them; above the
// other one may be.
constexpr double regular = 50, doubtful = 1e5;

// What is said of many ways beside what follow() finds.
struct Ways {
  int right = 0, refused = 0, unsure = 0;

  template <class Pose>
  void add(const Pose& pose, const Way& way, const std::string& name) {
    if (way.is_followed && way.worst < regular)
      BOOST_TEST(static_cast<bool>(pose), name << ": the way is regular, up to " << way.worst);
    if (!pose)
      ++refused;
    else if (!way.is_followed || way.worst > doubtful)
      ++unsure; // small steps, too, may go past a singular pose, or take one for met that is not
    else {
      ++right;
      BOOST_TEST((Eigen::Map<const Eigen::Matrix<double, 9, 1>>(pose->joints.data()) - way.end.head<9>()).norm() < 1e-7,
                 name << ": another branch; on the way " << way.worst);
    }
  }

  // That each kind was met, or hardly.
  void check_numbers(int fewer_than_refused) const {
    BOOST_TEST_MESSAGE("seed " << seed << ": " << right << " as by small steps, " << refused << " refused, " << unsure
                               << " unsure");
    BOOST_TEST(right > 60);
    BOOST_TEST(refused > fewer_than_refused);
    BOOST_TEST(unsure <= 2);
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(forward_kinematics_goes_on_with_the_branch_of_the_pose_before) {
  Random random(seed + 11);
  Ways ways;
  for (int k = 0; k < 240; ++k) {
    const Device_parameters<double> parameters = random_parameters(random, k);
    const auto from = general_forward(parameters, random_angles(random, -0.5, 2.5));
    if (!from)
      continue;
    const Vector theta = from->theta + random_vector(random, k % 3 == 0 ? 0.1 : 1.0);
    ways.add(general_forward(parameters, theta, *from), follow_joints(parameters, *from, theta),
             "way " + std::to_string(k));
  }
  ways.check_numbers(20);
}

// At both ends of these ways the elbows have the same distances.
BOOST_AUTO_TEST_CASE(forward_kinematics_does_not_leap_to_a_mirrored_triangle_of_elbows) {
  for (const Named_design name : {Named_design::D1, Named_design::D2}) {
    const Device_parameters<double> parameters(named_design<double>(name, Device_form::general));
    const auto leaps = [&](const Vector& start, const Vector& end) {
      const auto from = general_forward(parameters, start);
      BOOST_REQUIRE(from);
      const auto there = general_forward(parameters, end, *from);
      BOOST_TEST(!follow_joints(parameters, *from, end).is_followed);
      BOOST_TEST((there.status() == Device_status::mode_lost), name_of(name) << ": " << start.transpose());
    };
    for (const double radius : {0.0001, 0.0034, 0.01}) { // before and behind the axis of the device
      const auto angle = [&](double r) {
        return std::acos((r - parameters.base_radius()) / parameters.primary_length());
      };
      leaps(Vector::Constant(angle(radius)), Vector::Constant(angle(-radius)));
    }
    if (name != Named_design::D2) // whose links do not close about angles of 0
      continue;
    for (const double angle : {0.7, 1.0})
      leaps(Vector::Constant(angle), Vector::Constant(-angle));
    leaps(Vector(0.9, 1, 1.1), Vector(0.9 + 2 * EIGEN_PI, 1, 1.1));
  }
}

BOOST_AUTO_TEST_CASE(inverse_kinematics_goes_on_with_the_branch_of_the_pose_before) {
  Random random(seed + 12);
  Ways ways;
  const auto add = [&](const Device_parameters<double>& parameters, const Vector& theta, const Vector& place,
                       const std::string& name) {
    const auto from = general_forward(parameters, theta);
    if (!from)
      return;
    const auto there = general_inverse(parameters, place, *from);
    const Way way = follow_centre(parameters, *from, place);
    ways.add(there, way, name);
  };
  for (int k = 0; k < 240; ++k) {
    const Device_parameters<double> parameters = random_parameters(random, k);
    const Vector theta = random_angles(random, -0.5, 2.5);
    const auto from = general_forward(parameters, theta);
    if (from)
      add(parameters, theta, from->position + random_vector(random, k % 3 == 0 ? 0.002 : 0.03),
          "way " + std::to_string(k));
  }
  // Beside another branch, which Newton's method over the whole way finds.
  const auto named = [](Named_design name) {
    return Device_parameters<double>(named_design<double>(name, Device_form::general));
  };
  const int before = ways.right;
  add(named(Named_design::D1), {0.97760681976274744, 1.8753663037342774, 0.67101123986128441},
      {0.00056891598885405736, -0.036092459978500149, 0.15326776970031514}, "D1, 31 mm");
  add(named(Named_design::D1), {1.5176971684572615, 1.6075307619399752, 1.4152263341394233},
      {-0.006231647784867362, 0.0017180569195843409, 0.16503876725925462}, "D1, 9 mm");
  add(named(Named_design::D2), {0.41672617470777551, 0.82950652238448574, 1.4980460802090287},
      {0.034682714004254815, 0.019316941671786679, 0.090421992709852309}, "D2, 9 mm");
  add(named(Named_design::D2), {0.53086964495842359, 1.6649790662621351, 0.77925163059499525},
      {-0.0028461431692753461, -0.0068401596990283892, 0.094456471246639931}, "D2, 51 mm");
  BOOST_TEST(ways.right == before + 4);
  ways.check_numbers(10);
}

BOOST_AUTO_TEST_CASE(long_regular_ways_are_followed_to_their_end) {
  Device_description<double> d = named_design<double>(Named_design::D1, Device_form::general);
  d.base_radius = 0.1, d.primary_length = 0.05, d.secondary_length = 0.1, d.platform_radius = 0.06;
  const Device_parameters<double> parameters(d);
  const auto from = general_forward(parameters, Vector(0.3, 0.3, 0.3));
  BOOST_REQUIRE(from);
  for (const Vector& turns : {Vector(3, 0, 0), Vector(3, 3, 3), Vector(-7, 4, 5)}) {
    const auto there = general_forward(parameters, Vector(from->theta + 2 * EIGEN_PI * turns), *from);
    BOOST_REQUIRE(there);
    BOOST_TEST((there->position - from->position).norm() < 1e-12);
  }
}

// Of a platform far larger than links, of links far shorter than others, and in few digits.
BOOST_AUTO_TEST_CASE(inverse_kinematics_follows_regular_ways_of_odd_designs) {
  const auto goes = [](auto scalar, const std::array<double, 4>& lengths, const Vector& theta, const auto& place_from) {
    using S = decltype(scalar);
    Device_description<double> d = named_design<double>(Named_design::D1, Device_form::general);
    d.base_radius = lengths[0], d.primary_length = lengths[1], d.secondary_length = lengths[2];
    d.platform_radius = lengths[3];
    const Device_parameters<S> parameters(description_as<S>(d));
    const auto from = general_forward(parameters, vector_as<S>(theta));
    BOOST_REQUIRE(from);
    const Vector start = from->position.template cast<double>(), place = place_from(start);
    for (const double part : {0.0, 0.5, 1.0}) {
      const auto there = general_inverse(parameters, vector_as<S>(start + part * (place - start)), *from);
      BOOST_TEST((there.status() == Device_status::success), lengths[3] << ", part " << part);
    }
  };
  goes(0.0, {3, 0.07, 0.1, 3}, {0.8, 0.8, 0.8}, [](const Vector& p) { return Vector(p + Vector(0.001, 0, 0.01)); });
  goes(0.0, {0.07, 1e-5, 0.1, 0.02}, {0.2, 0.2, 0.2},
       [](const Vector& p) { return Vector(p + Vector(1e-6, 0, 5e-6)); });
  goes(0.f, {0.0403142273, 0.0168024097, 0.0875372738, 0.0494013578}, {-0.215173796, 1.0809238, 1.66971171},
       [](const Vector&) { return Vector(0.0173918419, 0.00711896364, 0.0936974734); });
  goes(0.f, {0.0571623668, 0.0746211186, 0.104550697, 0.0776052028}, {1.73218369, 1.81533241, 1.54170537},
       [](const Vector&) { return Vector(0.00639203144, -0.00212149508, 0.164694548); });
}

BOOST_AUTO_TEST_SUITE_END()
