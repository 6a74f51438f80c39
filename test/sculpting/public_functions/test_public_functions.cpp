// SPDX-License-Identifier: GPL-3.0-or-later
// Every public function that reads coordinates, at both ends of their range and in every mode that a caller's processor
// may be in. check_public_functions.py sees to it that none is missing.
#include <boost/test/unit_test.hpp>

#include "sculpting/public_functions/Callers_mode.h"
#include "sculpting/public_functions/free_functions.h"
#include "sculpting/public_functions/functions_on_their_own.h"
#include "sculpting/public_functions/sculptor_functions.h"

#include <set>
#include <string>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

std::vector<Public_function> public_functions() {
  std::vector<Public_function> all = sculptor_functions();
  for (auto& functions : {free_functions(), functions_on_their_own()})
    all.insert(all.end(), functions.begin(), functions.end());
  return all;
}

} // namespace

BOOST_AUTO_TEST_CASE(functions_give_the_same_at_both_ends_of_the_range) {
  // Below 2^-900 clearances are subnormal, as are what is measured there: then results need not be the same, but are
  // finite.
  constexpr int least_exact = -900;
  for (const Public_function& function : public_functions()) {
    Outcome at_scale_1;
    function.call(1, at_scale_1);
    BOOST_TEST(at_scale_1.is_finite(), function.names);
    for (const int k : {-1050, -1000, -900, -511, -300, -153, 1, 199, 300, 511, 900, 995, 999}) {
      Outcome outcome;
      std::string error;
      try {
        function.call(std::ldexp(1.0, k), outcome);
      } catch (const std::exception& caught) {
        error = caught.what();
      }
      BOOST_TEST(error == "", function.names << " at 2^" << k << ": " << error);
      BOOST_TEST(outcome.is_finite(), function.names << " at 2^" << k);
      if (k < least_exact)
        continue;
      if (const auto first = outcome.first_difference(at_scale_1, k))
        BOOST_ERROR(function.names << " at 2^" << k << ": number " << *first << " of " << outcome.size() << " is "
                                   << outcome.value(*first) << " where it is " << at_scale_1.value(*first)
                                   << " at scale 1");
    }
  }
}

BOOST_AUTO_TEST_CASE(functions_give_the_same_in_every_mode_and_leave_it_as_it_was) {
  for (const bool flushes : {false, true})
    for (const Public_function& function : public_functions()) {
      const double unit = flushes ? 0x1p-1050 : 1; // with subnormal numbers, which flushing would take away
      Outcome usual;
      function.call(unit, usual);
      for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
        if (flushes || rounding != FE_TONEAREST) {
          Outcome outcome;
          std::string error;
          bool stands = false;
          {
            const Callers_mode mode(rounding, flushes);
            try {
              function.call(unit, outcome);
            } catch (const std::exception& caught) {
              error = caught.what();
            }
            stands = mode.stands();
          }
          const std::string where = function.names + " in mode " + std::to_string(rounding) +
                                    (flushes ? ", flushing" : "") + (error.empty() ? "" : ": " + error);
          BOOST_TEST(error == "", where);
          BOOST_TEST(stands, where);
          if (const auto first = outcome.first_difference(usual, 0))
            BOOST_ERROR(where << ": number " << *first << " of " << outcome.size() << " is " << outcome.value(*first)
                              << ", not " << usual.value(*first));
        }
    }
}
