// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/kinematics_of_tests.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>

BOOST_AUTO_TEST_SUITE(device_kinematics)

BOOST_AUTO_TEST_CASE(eigenvalues_of_companion_matrices_are_the_roots_they_were_made_of) {
  Random random(seed + 7);
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    std::array<double, 8> real,
        imaginary; // four pairs: conjugate, or two real ones; every third time two of them equal
    std::array<double, 9> coefficients{1};
    for (int pair = 0; pair < 4; ++pair) {
      const bool complex = random() % 2;
      const double a = uniform(random, -1, 1), b = complex                   ? uniform(random, 0.1, 1)
                                                   : k % 3 == 0 && pair == 0 ? 0
                                                                             : uniform(random, 0.1, 1);
      real[2 * pair] = complex ? a : a + b, real[2 * pair + 1] = complex ? a : a - b;
      imaginary[2 * pair] = complex ? b : 0, imaginary[2 * pair + 1] = complex ? -b : 0;
      const double linear = -2 * a, constant = complex ? a * a + b * b : a * a - b * b;
      for (int n = 2 * pair + 2; n > 0; --n)
        coefficients[n] += (n >= 1 ? linear * coefficients[n - 1] : 0) + (n >= 2 ? constant * coefficients[n - 2] : 0);
    }
    Eigen::Matrix<double, 8, 8> companion = Eigen::Matrix<double, 8, 8>::Zero();
    for (int n = 0; n < 8; ++n)
      companion(0, n) = -coefficients[n + 1];
    for (int n = 1; n < 8; ++n)
      companion(n, n - 1) = 1;
    internal::Hessenberg_eigenvalues<double, 8> found;
    BOOST_REQUIRE(found.compute(companion));
    for (int root = 0; root < 8; ++root) { // how near each root comes to an eigenvalue, over how well it is determined
      double nearest = HUGE_VAL, separation = 1;
      for (int n = 0; n < 8; ++n) {
        nearest = std::min(nearest, std::hypot(found.real[n] - real[root], found.imaginary[n] - imaginary[root]));
        if (n != root)
          separation *= std::hypot(real[n] - real[root], imaginary[n] - imaginary[root]);
      }
      // A backward error of some roundings moves a simple root by that over the product of the distances, a double one
      // by its square root.
      worst = std::max(worst, std::min(nearest * separation / 1e-14, nearest / 1e-6));
    }
  }
  BOOST_TEST_MESSAGE("roots off by at most " << worst << " of what rounding may do");
  BOOST_TEST(worst < 1);
}

BOOST_AUTO_TEST_SUITE_END()
