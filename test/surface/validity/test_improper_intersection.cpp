// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of faces that meet where they should not, against integers and against CGAL.
#include <haptic_sculpt/surface/validate.h>

#include "surface/index_lists.h"
#include "surface/soup_of.h"

#include <meshes/generated_meshes.h>
#include <oracle/exact_triangles.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using haptic_sculpt::Face_soup;
using haptic_sculpt::validate;
using haptic_sculpt::validate_soup;
using haptic_sculpt::Validity_report;
using haptic_sculpt::test::soup_of;
using meshes::Mesh;
using meshes::to_mesh;

BOOST_AUTO_TEST_SUITE(validity)

// Random triangles on a small grid: every way to share, touch, overlap and lie flat occurs.
BOOST_AUTO_TEST_CASE(intersections_agree_with_integers_on_degenerate_soups) {
  constexpr unsigned seed = 31;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::size_t wrong = 0, hits = 0, asked = 0;
  for (int round = 0; round < 6000; ++round) {
    const int grid = 2 + round % 3, n = 5 + round % 5;
    Face_soup soup;
    oracle::Mesh_list list;
    for (int i = 0; i < n; ++i) {
      const std::array<double, 3> p{double(random() % grid), double(random() % grid),
                                    round % 4 ? double(random() % grid) : 0.0};
      list.points.push_back(p);
      soup.points.emplace_back(p[0], p[1], p[2]);
    }
    for (int i = 0; i < 6; ++i) {
      const int a = random() % n, b = random() % n, c = random() % n;
      if (a == b || b == c || c == a)
        continue;
      list.faces.push_back({a, b, c});
      soup.add_face(std::array<int, 3>{a, b, c});
    }
    const auto report = validate_soup(soup);
    const std::vector<std::size_t> flat = numbers(report.degenerate_faces);
    const auto is_flat = [&](std::size_t f) { return std::binary_search(flat.begin(), flat.end(), f); };
    Pairs found, expected;
    for (const auto& [f, g] : report.intersecting_faces)
      if (!is_flat(f) && !is_flat(g))
        found.emplace_back(f, g);
    for (const auto& [f, g] : oracle::improper_pairs(list))
      expected.emplace_back(f, g);
    const auto points = oracle::scaled_to_integers(list.points);
    const oracle::Still_signs<mpz_class> signs{points};
    for (std::size_t f = 0; f < list.faces.size(); ++f) {
      const auto& t = list.faces[f];
      wrong += is_flat(f) != oracle::on_one_line(signs, t[0], t[1], t[2]);
    }
    wrong += found != expected;
    hits += expected.size();
    asked += list.faces.size() * (list.faces.size() - 1) / 2;
  }
  BOOST_TEST_MESSAGE(asked << " pairs, " << hits << " improper");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(hits > asked / 20);
}

BOOST_AUTO_TEST_CASE(degenerate_faces_meet_others) {
  Face_soup soup = soup_of(meshes::cube());
  const auto flat = [&](const std::array<double, 3>& a, const std::array<double, 3>& b,
                        const std::array<double, 3>& c) {
    const std::size_t n = soup.points.size();
    for (const auto& p : {a, b, c})
      soup.points.emplace_back(p[0], p[1], p[2]);
    soup.add_face(std::array<std::size_t, 3>{n, n + 1, n + 2});
  };
  flat({.5, .3, .5}, {.5, .3, 3}, {.5, .3, 2});  // 12: out through a side
  flat({.5, .3, 1.5}, {.5, .3, 3}, {.5, .3, 2}); // 13: outside, overlaps 12
  flat({.5, -.3, 2}, {.5, 3, 2}, {.5, 1, 2});    // 14: crosses 12 and 13
  flat({7, 7, 7}, {7, 7, 7}, {7, 7, 7});         // 15: a point
  const auto report = validate_soup(soup);
  BOOST_TEST(numbers(report.degenerate_faces) == (Numbers{12, 13, 14, 15}));
  Pairs among, with_cube;
  for (const auto& [f, g] : report.intersecting_faces)
    (f >= F(12) ? among : with_cube).emplace_back(f, g);
  BOOST_TEST(among == (Pairs{{12, 13}, {12, 14}, {13, 14}}));
  BOOST_TEST(with_cube.size() == 1u);
}

// Three hubs of some hundred faces each, fans upon fans on a small grid and off it, against every pair of faces.
BOOST_AUTO_TEST_CASE(hubs_agree_with_all_pairs) {
  constexpr unsigned seed = 33;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::size_t hits = 0;
  for (int round = 0; round < 4; ++round) {
    Face_soup soup;
    const auto add_at_random = [&] {
      double p[3];
      for (double& x : p)
        x = round % 2 ? double(random() % 40) : random() / 1e8;
      soup.add_point(p[0], p[1], p[2]);
    };
    for (int i = 0; i < 500; ++i)
      add_at_random();
    for (unsigned i = 0; i < 960; ++i) {
      unsigned a = random() % 500, b = random() % 500, hub = i % 3;
      if (round % 4 < 2) { // near to each other, so that not all faces meet
        a = 3 + i % 497, b = 3 + (i + 1) % 497;
      }
      if (i % 50 == 0)
        a = (hub + 1) % 3; // two hubs
      if (a != b && a != hub && b != hub)
        soup.add_face(std::array<unsigned, 3>{hub, a, b});
    }
    for (int i = 0; i < 200; ++i) {
      const unsigned a = 3 + random() % 165, b = 170 + random() % 165, c = 340 + random() % 160;
      soup.add_face(std::array<unsigned, 3>{a, b, c});
    }
    const haptic_sculpt::internal::Meet_improperly meet_improperly(soup);
    std::vector<bool> flat;
    std::vector<Face_soup::Index> faces;
    for (Face_soup::Index f = 0; f < soup.number_of_faces(); ++f) {
      faces.push_back(f);
      flat.push_back(meet_improperly.is_flat(f));
    }
    std::vector<std::pair<Face_soup::Index, Face_soup::Index>> expected;
    for (const auto f : faces)
      for (const auto g : faces)
        if (f < g && (flat[f] || flat[g] ? meet_improperly.degenerate(f, g) : meet_improperly(f, g)))
          expected.emplace_back(f, g);
    const auto found =
        haptic_sculpt::internal::improper_intersections(soup, faces, flat, Validity_report::all_intersections);
    BOOST_TEST((found.pairs == expected),
               "round " << round << ": " << found.pairs.size() << ", not " << expected.size());
    hits += expected.size();
    const auto some = haptic_sculpt::internal::improper_intersections(soup, faces, flat, 100);
    BOOST_TEST(some.has_more);
    BOOST_TEST(some.pairs.size() == 100u);
  }
  BOOST_TEST_MESSAGE(hits << " improper pairs");
  BOOST_TEST(hits > 10000u);
}

// Counted, for times are those of a machine: all pairs would be 12 million.
BOOST_AUTO_TEST_CASE(faces_at_one_vertex_are_not_all_paired) {
  Face_soup soup;
  constexpr unsigned n = 5000;
  for (unsigned i = 0; i < n; ++i)
    soup.add_point(std::cos(2 * CGAL_PI * i / n), std::sin(2 * CGAL_PI * i / n), 0);
  soup.add_point(0, 0, 1);
  std::vector<Face_soup::Index> faces;
  for (unsigned i = 0; i < n; ++i) {
    faces.push_back(i);
    soup.add_face(std::array<unsigned, 3>{i, (i + 1) % n, n});
  }
  std::size_t pairs = 0;
  haptic_sculpt::internal::Near_faces(soup, faces).for_each_pair([&](auto, auto) { ++pairs; });
  BOOST_TEST_MESSAGE(pairs << " pairs of " << n << " faces at one vertex");
  BOOST_TEST(pairs >= n);
  BOOST_TEST(pairs < 10 * n);
}

BOOST_AUTO_TEST_CASE(agrees_with_polygon_mesh_processing) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::size_t hits = 0;
  for (int round = 0; round < 31; ++round) {
    auto list = meshes::icosphere(round < 30 ? 3 : 6); // the last, 81,920 faces, is looked at in several slabs
    list.transform([&](const meshes::Point_3& p) {
      const auto noise = [&] { return (round < 30 ? 0.02 * round : 0.05) * (random() / 4294967296.0 - 0.5); };
      return meshes::Point_3(p.x() + noise(), p.y() + noise(), p.z() + noise());
    });
    const Mesh mesh = to_mesh(list);
    std::vector<std::pair<F, F>> expected;
    CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(expected));
    for (auto& [f, g] : expected)
      if (g < f)
        std::swap(f, g);
    std::sort(expected.begin(), expected.end());
    const auto report = validate(mesh, 0, Validity_report::all_intersections);
    BOOST_TEST((report.intersecting_faces == expected));
    hits += expected.size();
  }
  BOOST_TEST_MESSAGE(hits << " intersecting pairs");
  BOOST_TEST(hits > 1000u);
}

BOOST_AUTO_TEST_SUITE_END()
