// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle against hand-worked cases, against Fourier-Motzkin elimination and against published answers.
#include "oracle/analytic_cases.h"
#include "oracle/fourier_motzkin.h"
#include "oracle/hexadecimal.h"
#include "oracle/sample_queries.h"
#include "oracle/sweep_oracle.h"
#include "populations/sweep_populations.h"

#include <seeds_and_sizes.h>
#include <shared_data.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>

using namespace haptic_sculpt::test;

namespace {

/// Permutes the axes, scales all by 2^exponent and adds `shift`, exactly for the small cases it is used on.
Sweep_coordinates moved(const Sweep_coordinates& x, const std::array<int, 3>& axes, int exponent, double shift) {
  Sweep_coordinates y;
  for (int i = 0; i < 15; ++i)
    y[i] = std::ldexp(x[i - i % 3 + axes[i % 3]], exponent) + shift;
  return y;
}

Sweep_coordinates with_points_swapped(Sweep_coordinates x, int i, int j) {
  for (int axis = 0; axis < 3; ++axis)
    std::swap(x[3 * i + axis], x[3 * j + axis]);
  return x;
}

} // namespace

BOOST_AUTO_TEST_CASE(hand_worked_cases) {
  BOOST_TEST(analytic_cases().size() >= 40);
  for (const Analytic_case& c : analytic_cases()) {
    std::optional<mpq_class> expected;
    if (c.denominator != 0)
      expected = mpq_class(c.numerator, c.denominator);
    const auto check = [&](const Sweep_coordinates& x, const char* how) {
      BOOST_TEST((first_time(c.kind, x) == expected), sweep_name(c.kind) << ' ' << c.what << how);
      BOOST_TEST((first_time(c.kind, x, Early_out::none) == expected), sweep_name(c.kind) << ' ' << c.what << how);
    };
    check(c.x, "");
    const bool is_integral = std::all_of(c.x.begin(), c.x.end(), [](double v) { return 2 * v == std::rint(2 * v); });
    for (const std::array<int, 3>& axes : {std::array<int, 3>{1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}}) {
      check(moved(c.x, axes, 0, 0), ", axes permuted");
      if (is_integral)
        for (const int exponent : {-900, 0, 1000})
          check(moved(c.x, axes, exponent, std::ldexp(3, exponent)), ", scaled and shifted");
    }
    // What is symmetric in the question is symmetric in the answer.
    if (c.kind == Sweep_kind::face_vertex) {
      check(with_points_swapped(c.x, 2, 3), ", G and I swapped");
    } else {
      check(with_points_swapped(c.x, 3, 4), ", last two points swapped");
      if (c.kind == Sweep_kind::vertex_face)
        check(with_points_swapped(c.x, 2, 4), ", A and C swapped");
    }
    BOOST_TEST(first_time(c.kind, with_points_swapped(c.x, 0, 1)).has_value() == expected.has_value());
  }
}

// By definition: at the first time the features touch, just before they do not, and a miss touches at no time.
// "Just before" is no guess. Two times that are not equal, with denominators q and q', differ by at least 1/(q q');
// every vertex of the polytope has a time whose denominator is a sum of two 5 x 5 minors, below 2^(3 bits + 8).
BOOST_AUTO_TEST_CASE(agrees_with_elimination_at_each_instant) {
  const auto bits_of_one_axis = [](const Sweep_coordinates& x, int axis) {
    int least = INT_MAX, most = INT_MIN;
    for (int i = axis; i < 15; i += 3)
      if (x[i] != 0) {
        least = std::min(least, std::ilogb(x[i]) - 52);
        most = std::max(most, std::ilogb(x[i]) + 1);
      }
    return least > most ? 1 : most - least + 1;
  };
  std::mt19937_64 engine(seed_from_environment(20240601));
  int hits = 0, misses = 0;
  for (const Sweep_population& population : sweep_populations())
    for (Sweep_kind kind : sweep_kinds)
      for (int i = 0; i < 60; ++i) {
        const Sweep_query query = population(kind, engine);
        const std::optional<mpq_class> u = first_time(kind, query.x, Early_out::none);
        BOOST_TEST((first_time(kind, query.x) == u), hexadecimal(query.kind, query.x));
        BOOST_TEST(swept_hulls_meet(kind, query.x) == u.has_value(),
                   population.name << ' ' << hexadecimal(query.kind, query.x));
        if (!u) {
          ++misses;
          for (const mpq_class& t : {mpq_class(0), mpq_class(1), mpq_class(1, 3), mpq_class(7, 8)})
            BOOST_TEST(!features_meet_at(kind, query.x, t), population.name << ' ' << hexadecimal(query.kind, query.x));
          continue;
        }
        ++hits;
        BOOST_TEST((*u >= 0 && *u <= 1));
        BOOST_TEST(features_meet_at(kind, query.x, *u), population.name << ' ' << hexadecimal(query.kind, query.x));
        if (*u == 0)
          continue;
        std::size_t bits = 10 + mpz_sizeinbase(u->get_den_mpz_t(), 2);
        for (int axis = 0; axis < 3; ++axis)
          bits += bits_of_one_axis(query.x, axis);
        mpq_class before = *u;
        mpq_class step = 1;
        mpq_div_2exp(step.get_mpq_t(), step.get_mpq_t(), bits);
        before -= step;
        BOOST_TEST(!features_meet_at(kind, query.x, before),
                   population.name << ' ' << hexadecimal(query.kind, query.x));
      }
  BOOST_TEST_MESSAGE(hits << " hits and " << misses << " misses agree");
  BOOST_TEST(hits > 1000);
  BOOST_TEST(misses > 1000);
}

BOOST_AUTO_TEST_CASE(early_out_changes_nothing) {
  std::mt19937_64 engine(seed_from_environment(7));
  int skipped = 0;
  for (const Sweep_population& population : sweep_populations())
    for (int i = 0; i < 1500; ++i) {
      const Sweep_query query = population(engine);
      if (!boxes_are_disjoint(query.kind, query.x))
        continue;
      ++skipped;
      BOOST_TEST(!first_time(query.kind, query.x, Early_out::none),
                 population.name << ' ' << hexadecimal(query.kind, query.x));
    }
  BOOST_TEST_MESSAGE(skipped << " queries end at their boxes, all misses");
  BOOST_TEST(skipped > 1000);
}

BOOST_AUTO_TEST_CASE(published_answers) {
  const auto file = haptic_sculpt::test::shared_data("ccd/sample_queries.txt");
  if (!file)
    return;
  const std::vector<Sample_query> queries = read_sample_queries(file->string());
  std::map<std::string, std::array<int, 2>> count; // queries and hits
  for (const Sample_query& query : queries) {
    const std::optional<mpq_class> u = first_time(query.kind, query.x);
    BOOST_TEST(u.has_value() == query.truth, "line " << query.line);
    BOOST_TEST(swept_hulls_meet(query.kind, query.x) == query.truth, "line " << query.line);
    ++count[sweep_name(query.kind)][0];
    count[sweep_name(query.kind)][1] += u.has_value();
  }
  for (const auto& [kind, n] : count)
    BOOST_TEST_MESSAGE(kind << ": " << n[0] << " published queries, " << n[1] << " hits");
  BOOST_TEST(queries.size() > 0);
}

BOOST_AUTO_TEST_CASE(malformed_files_are_refused) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "haptic_sculpt_malformed_queries.txt";
  const std::string good = "VF set 1 2 3 4 5 6 7 8 9 0x1p-3 11 12 13 14 15 1\n";
  const auto read_with = [&](const std::string& line) {
    std::ofstream(file) << good << line << '\n';
    return read_sample_queries(file.string());
  };
  const auto names_line_2 = [](const std::runtime_error& e) {
    return std::string(e.what()).find("line 2") != std::string::npos;
  };
  BOOST_TEST(read_with(good.substr(0, good.size() - 1)).at(1).x[9] == 0.125);
  for (const char* line :
       {"XX set 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 1", "VF set 1 2 3 4 5 6 7 8 9 10 11 12 13 14 1",
        "VF set 1 2 3 4 5 6 7 8 9 10 11 12 13 14 1x 1", "VF set 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 1 1", ""})
    BOOST_CHECK_EXCEPTION(read_with(line), std::runtime_error, names_line_2);
  std::filesystem::remove(file);
  BOOST_CHECK_THROW(read_sample_queries(file.string()), std::runtime_error);
}
