// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptic_rendering/random_vector.h"

#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(percentiles_against_a_sorted_list) {
  Random random(haptic_sculpt::test::seed_from_environment(8));
  for (int round = 0; round < 20; ++round) {
    Tick_statistics statistics;
    std::vector<std::uint64_t> all;
    for (int i = 0; i < 5000; ++i) {
      all.push_back(random() >> (random() % 64));
      statistics.add(all.back());
    }
    std::sort(all.begin(), all.end());
    BOOST_TEST(statistics.largest() == all.back());
    for (const double share : {0.01, 0.5, 0.99, 0.999, 0.9999, 1.0}) {
      const std::uint64_t exact = all[static_cast<std::size_t>(std::ceil(share * 5000)) - 1],
                          told = statistics.percentile(share);
      BOOST_TEST(told >= exact);
      BOOST_TEST(static_cast<double>(told) <= static_cast<double>(exact) * (1 + 1.0 / 32));
    }
  }
  BOOST_TEST(Tick_statistics().percentile(0.5) == 0u);
}

BOOST_AUTO_TEST_CASE(of_no_ticks_all_numbers_are_0_and_of_a_few_they_are_theirs) {
  Tick_statistics statistics;
  BOOST_TEST((statistics.number() == 0u && statistics.largest() == 0u && statistics.percentile(0.5) == 0u));
  statistics.add(7), statistics.add(9), statistics.add(8);
  for (const double share : {-1e300, -0.5, 0.0})
    BOOST_TEST(statistics.percentile(share) == 7u);
  BOOST_TEST(statistics.percentile(1e300) == 9u);
  BOOST_TEST((statistics.number() == 3u && statistics.largest() == 9u && statistics.percentile(0.5) == 8u));
}

} // namespace
