// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons divided into triangles, and faces of meshes by them: counted in whole numbers.
#include <haptic_sculpt/surface/divide_polygon.h>
#include <haptic_sculpt/surface/repair.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

namespace {

using haptic_sculpt::Corners_of_triangle;
using haptic_sculpt::divided_polygon;
using haptic_sculpt::Face_soup;
using haptic_sculpt::repair;
using haptic_sculpt::Repair_kind;
using haptic_sculpt::Repair_step;
using Polygon = std::vector<std::array<double, 3>>; // of small whole numbers

/// Along an axis: > 0 for a turn to the left. Exact.
double turn(const Polygon& p, std::size_t a, std::size_t b, std::size_t c, int axis) {
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  return (p[b][x] - p[a][x]) * (p[c][y] - p[a][y]) - (p[b][y] - p[a][y]) * (p[c][x] - p[a][x]);
}

/// Whether two sides, neither next to the other, meet: by all their turns.
bool sides_meet(const Polygon& p, std::size_t i, std::size_t k, int axis) {
  const std::size_t n = p.size(), a = i, b = (i + 1) % n, c = k, d = (k + 1) % n;
  const double abc = turn(p, a, b, c, axis), abd = turn(p, a, b, d, axis);
  const double cda = turn(p, c, d, a, axis), cdb = turn(p, c, d, b, axis);
  if (abc == 0 && abd == 0 && cda == 0 && cdb == 0) { // on a line, or one is a point
    for (const int x : {(axis + 1) % 3, (axis + 2) % 3})
      if (std::fmax(p[a][x], p[b][x]) < std::fmin(p[c][x], p[d][x]) ||
          std::fmax(p[c][x], p[d][x]) < std::fmin(p[a][x], p[b][x]))
        return false;
    return true;
  }
  return abc * abd <= 0 && cda * cdb <= 0;
}

bool is_simple(const Polygon& p, int axis) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 2; k < n; ++k)
      if ((k + 1) % n != i && sides_meet(p, i, k, axis))
        return false;
    // The next side neither ends where this one begins nor goes back over it.
    const std::size_t b = (i + 1) % n, c = (i + 2) % n;
    if (turn(p, i, b, c, axis) == 0) {
      const int x = (axis + 1) % 3, y = (axis + 2) % 3;
      const double back = (p[b][x] - p[i][x]) * (p[c][x] - p[b][x]) + (p[b][y] - p[i][y]) * (p[c][y] - p[b][y]);
      if (back <= 0)
        return false;
    }
  }
  return true;
}

/// Whether triangles turn as the polygon does, none without area, and have its area together: then they cover it once.
bool covers(const Polygon& p, const std::vector<Corners_of_triangle>& triangles, int axis) {
  double whole = 0, sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    whole += turn(p, 0, i, i + 1, axis);
  for (const Corners_of_triangle& t : triangles) {
    const double area = turn(p, t[0], t[1], t[2], axis);
    if (!(area * whole > 0))
      return false;
    sum += area;
  }
  return sum == whole && triangles.size() == p.size() - 2;
}

Polygon random_polygon(std::mt19937_64& random) {
  Polygon p(3 + random() % 6);
  const int range = 2 + static_cast<int>(random() % 5), flat = static_cast<int>(random() % 6);
  for (auto& corner : p)
    for (int axis = 0; axis < 3; ++axis)
      corner[axis] = axis == flat ? 1 : static_cast<int>(random() % (2 * range + 1)) - range;
  return p;
}

Face_soup soup_of(const std::vector<Polygon>& polygons) {
  Face_soup soup;
  for (const Polygon& p : polygons) {
    std::vector<std::size_t> face;
    for (const auto& corner : p) {
      face.push_back(soup.points.size());
      soup.points.emplace_back(corner[0], corner[1], corner[2]);
    }
    soup.add_face(face);
  }
  return soup;
}

std::size_t count(const Repair_step& step, const std::string& what) {
  for (const auto& [name, number] : step.counts)
    if (name == what)
      return number;
  return 0;
}

} // namespace

BOOST_AUTO_TEST_SUITE(repairing)

BOOST_AUTO_TEST_CASE(a_polygon_is_divided_where_it_is_simple_along_an_axis) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(77));
  std::size_t divided = 0, left = 0;
  for (std::size_t k = 0; k < haptic_sculpt::test::count_from_environment("HAPTIC_SCULPT_POLYGONS", 20000); ++k) {
    const Polygon p = random_polygon(random);
    const auto triangles = divided_polygon(p);
    bool is_simple_along_any = false, is_covered = false;
    for (int axis = 0; axis < 3; ++axis)
      if (is_simple(p, axis)) {
        is_simple_along_any = true;
        is_covered = is_covered || (triangles && covers(p, *triangles, axis));
      }
    BOOST_TEST_INFO_SCOPE("polygon " << k);
    BOOST_TEST(triangles.has_value() == is_simple_along_any);
    BOOST_TEST(is_covered == is_simple_along_any);
    ++(is_simple_along_any ? divided : left);
  }
  BOOST_TEST(divided > 100u);
  BOOST_TEST(left > 100u);
}

// On each of these CGAL's triangulate_face() never ends, compiled with -O1.
BOOST_AUTO_TEST_CASE(a_polygon_that_crosses_itself_ends_a_repair) {
  const std::vector<Polygon> polygons = {{{2, 6, 4}, {-6, 6, -6}, {6, -5, -6}, {-6, 6, 0}, {0, 6, -3}},
                                         {{-1, 2, 1}, {3, 3, 3}, {3, -1, 3}, {1, 1, 0}, {0, 0, 3}}};
  for (const Polygon& p : polygons) {
    Face_soup soup = soup_of({p});
    const auto report = repair(soup);
    BOOST_TEST(report.left.non_triangular_faces.empty() == divided_polygon(p).has_value());
  }
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(78));
  for (std::size_t k = 0; k < haptic_sculpt::test::count_from_environment("HAPTIC_SCULPT_POLYGONS", 300); ++k) {
    Face_soup soup = soup_of({random_polygon(random), random_polygon(random)});
    repair(soup);
  }
}

// A prism over a star with n points: its floor and its roof are not convex. Embedded, and as large as it was.
BOOST_AUTO_TEST_CASE(faces_of_many_corners_are_divided_in_place) {
  for (const std::size_t n : {2, 3, 5, 40, 200}) {
    Face_soup soup;
    std::vector<std::size_t> floor, roof;
    for (std::size_t i = 0; i < 2 * n; ++i) {
      const double angle = 3.14159265358979 * static_cast<double>(i) / static_cast<double>(n), r = i % 2 == 0 ? 4 : 1;
      for (const double z : {0., 1.})
        soup.points.emplace_back(std::round(1e4 * r * std::cos(angle)), std::round(1e4 * r * std::sin(angle)), z);
      floor.insert(floor.begin(), 2 * i), roof.push_back(2 * i + 1);
    }
    soup.add_face(floor), soup.add_face(roof);
    for (std::size_t i = 0; i < 2 * n; ++i) {
      const std::size_t k = (i + 1) % (2 * n);
      soup.add_face(std::array<std::size_t, 4>{2 * i, 2 * k, 2 * k + 1, 2 * i + 1});
    }
    const std::size_t points = soup.points.size(), polygons = soup.number_of_faces();
    const auto report = repair(soup);
    BOOST_TEST_INFO_SCOPE(n << " points");
    BOOST_REQUIRE(report.is_repaired());
    BOOST_TEST(report.steps.size() == 1u);
    BOOST_TEST((report.steps[0].kind == Repair_kind::divide_faces));
    BOOST_TEST(count(report.steps[0], "faces divided into triangles") == polygons);
    BOOST_TEST(soup.points.size() == points);
    BOOST_TEST(soup.number_of_faces() == 2 * (2 * n - 2) + 4 * n);
  }
}

BOOST_AUTO_TEST_SUITE_END()
