// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled by -O2, whatever the other tests are: there g++ 12 takes two conversions to float and back for none.
#include "sculpting/public_functions/Callers_mode.h"
#include <haptic_sculpt/sculpting/brushes/Dab_3.h>
#include <haptic_sculpt/surface/Vertex_attribute.h>
#include <haptic_sculpt/surface/broad_phase/Box_scale.h>
#include <haptic_sculpt/surface/write_surface.h>
#include <meshes/generated_meshes.h>

#include <boost/test/unit_test.hpp>

#include <array>
#include <random>
#include <vector>

using namespace haptic_sculpt;

namespace {

/// Through memory that the compiler knows nothing of.
double by_memory(double x) {
  volatile float f = static_cast<float>(x);
  return f;
}

std::vector<double> numbers(std::size_t count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> any(-3, 3);
  std::vector<double> all(count);
  for (double& x : all)
    x = any(engine);
  return all;
}

} // namespace

BOOST_AUTO_TEST_SUITE(to_float)

BOOST_AUTO_TEST_CASE(points_are_rounded_to_floats) {
  const std::vector<double> all = numbers(300);
  Face_soup soup;
  for (std::size_t i = 0; i < all.size(); i += 3)
    soup.points.push_back({all[i], all[i + 1], all[i + 2]});
  const Face_soup rounded = internal::rounded_to_float(soup);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    differ += rounded.points[i / 3][int(i % 3)] != by_memory(all[i]);
  BOOST_TEST(differ == 0u);
}

BOOST_AUTO_TEST_CASE(attributes_are_rounded_to_floats) {
  const std::vector<double> all = numbers(300);
  std::vector<double> rounded(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    rounded[i] = rounded_to(Vertex_attribute::Type::float32, all[i]);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    differ += rounded[i] != by_memory(all[i]);
  BOOST_TEST(differ == 0u);
}

BOOST_AUTO_TEST_CASE(boxes_of_floats_hold_boxes_of_doubles) {
  const std::vector<double> all = numbers(600);
  const internal::Box_scale scale([](const auto& visit) { visit(Box_3::Coordinates{1, 1, 1}); });
  std::size_t outside = 0;
  for (std::size_t i = 0; i + 6 <= all.size(); i += 6) {
    Box_3 box({all[i], all[i + 1], all[i + 2]});
    box.include({all[i + 3], all[i + 4], all[i + 5]});
    const auto around = scale.around(box);
    for (int k = 0; k < 3; ++k)
      outside +=
          !(around.lower[k] <= box.lower[k] * scale.factor() && around.upper[k] >= box.upper[k] * scale.factor());
  }
  BOOST_TEST(outside == 0u);
}

// Inlined, in a mode of the caller's.
BOOST_AUTO_TEST_CASE(numbers_are_worked_out_before_the_mode_is_set_back) {
  const std::vector<double> all = numbers(300);
  const Dab_3<meshes::Kernel> dab{Brush_kind::grab, {0.1, 0.2, 0.3}, 0.7, 0.5, {}};
  const auto each = [&](std::vector<double>& results) {
    for (std::size_t i = 0; i + 2 < all.size(); ++i) {
      results.push_back(rounded_to(Vertex_attribute::Type::float32, all[i]));
      results.push_back(rounded_to(Vertex_attribute::Type::int8, 1e-9 * all[i]));
      results.push_back(dab.squared_share({all[i], all[i + 1], all[i + 2]}));
    }
  };
  std::vector<double> usual;
  each(usual);
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::vector<double> results;
    results.reserve(usual.size());
    {
      const test::Callers_mode mode(rounding, false);
      each(results);
    }
    BOOST_TEST((results == usual), "mode " << rounding);
  }
}

BOOST_AUTO_TEST_SUITE_END()
