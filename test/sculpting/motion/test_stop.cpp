// SPDX-License-Identifier: GPL-3.0-or-later
// Where a blocked vertex stops: scenes with known ends, repeated and grazing pushes, slivers, offsets and scales; the
// delta rule.
#include "sculpting/Random_scene.h"
#include "sculpting/clearances.h"

#include <boost/test/unit_test.hpp>

#include <gmpxx.h>

#include <numeric>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Vector_3 = meshes::Kernel::Vector_3;

/// Two tetrahedra: the corners of the first, then those of the second.
Mesh two_tetrahedra(const std::array<Point_3, 8>& p) {
  meshes::Triangle_list list = meshes::tetrahedron();
  list += meshes::tetrahedron();
  for (int i = 0; i < 8; ++i)
    list.points[i] = p[i];
  Mesh mesh = meshes::to_mesh(list);
  BOOST_REQUIRE_MESSAGE(validate(mesh).is_valid(), validate(mesh).message());
  return mesh;
}

constexpr int pushed = 4; ///< the first corner of the second tetrahedron

/// A wide slab of a tetrahedron below z = 0 with its top face in that plane, and a tetrahedron with its tip above it.
Mesh tip_over_plane(const Point_3& tip) {
  return two_tetrahedra({Point_3(-8, -8, 0), Point_3(8, -8, 0), Point_3(0, 8, 0), Point_3(0, 0, -3), tip,
                         Point_3(-0.5, -0.5, 2), Point_3(0.5, -0.5, 2), Point_3(0, 0.5, 2)});
}

} // namespace

BOOST_AUTO_TEST_CASE(a_vertex_stops_on_a_plane) {
  Mesh mesh = tip_over_plane({0.1, 0.2, 1});
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
  const Point_3 target(0.3, 0.1, -1);
  const double c = largest_clearance(sculptor, target);
  BOOST_TEST(c == 4 * (std::nextafter(8.0, 9.0) - 8.0));
  const auto result = sculptor.grab(Vertex_index(pushed)).drag_to(target);
  BOOST_TEST(!result.reached);
  BOOST_TEST(result.position.z() > 0);
  BOOST_TEST(result.position.z() <= 2 * c);
  BOOST_TEST(result.stop_error == result.position.z());
  // The crossing with z = 0 is at u = 1/2.
  BOOST_TEST(std::abs(result.position.x() - 0.2) <= 2 * c);
  BOOST_TEST(std::abs(result.position.y() - 0.15) <= 2 * c);
  BOOST_REQUIRE(result.contacts.size() == 1u);
  BOOST_TEST((result.contacts[0].kind == Contact_kind::vertex_face));
  BOOST_TEST(result.contacts[0].normal[2] == 1);
}

BOOST_AUTO_TEST_CASE(an_edge_stops_on_an_edge) {
  // The ridge from (-4, 0, 0) to (4, 0, 0) along x; the moving edge runs along y above it.
  Mesh mesh = two_tetrahedra({Point_3(-4, 0, 0), Point_3(4, 0, 0), Point_3(0, -1, -3), Point_3(0, 1, -3),
                              Point_3(0, -2, 1), Point_3(0, 2, 0.5), Point_3(-0.5, 0, 4), Point_3(0.5, 0, 4)});
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
  const Point_3 target(0, -2, -3);
  const double c = largest_clearance(sculptor, target);
  const auto result = sculptor.grab(Vertex_index(pushed)).drag_to(target);
  // The edge from (0, -2, z) to (0, 2, 1/2) passes the ridge at height (z + 1/2)/2: it touches at z = -1/2.
  BOOST_REQUIRE(!result.contacts.empty());
  BOOST_TEST((result.contacts[0].kind == Contact_kind::edge_edge));
  BOOST_TEST(result.position.z() > -0.5);
  BOOST_TEST(result.stop_error <= 2 * c);
  BOOST_TEST(result.position.z() + 0.5 <= 4 * c); // the plane is steep: along z the clearance is longer
}

BOOST_AUTO_TEST_CASE(a_face_stops_on_a_vertex) {
  // A spike with its tip at the origin; a flat face comes down on it, held by two corners at z = 1/2.
  Mesh mesh = two_tetrahedra({Point_3(0, 0, 0), Point_3(-1, -1, -3), Point_3(1, -1, -3), Point_3(0, 1, -3),
                              Point_3(0, 3, 1), Point_3(-2, -1, 0.5), Point_3(2, -1, 0.5), Point_3(0, 0, 6)});
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
  const Point_3 target(0, 3, -6);
  const double c = largest_clearance(sculptor, target);
  const auto result = sculptor.grab(Vertex_index(pushed)).drag_to(target);
  // The face through (+-2, -1, 1/2) and (0, 3, z) has height 1/2 + (z - 1/2)/4 over the origin: it touches at z = -3/2.
  BOOST_REQUIRE(!result.contacts.empty());
  BOOST_TEST((result.contacts[0].kind == Contact_kind::face_vertex));
  BOOST_TEST(result.position.z() > -1.5);
  BOOST_TEST(result.stop_error <= 2 * c);
  BOOST_TEST(result.position.z() + 1.5 <= 10 * c);
}

BOOST_AUTO_TEST_CASE(repeated_and_grazing_pushes_keep_the_gap) {
  Random random(seed_from_environment(11));
  std::uniform_real_distribution<double> number(-1, 1);
  for (int scene = 0; scene < 20; ++scene) {
    Mesh mesh = tip_over_plane({0.3 * number(random), 0.3 * number(random), 1});
    Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
    auto grab = sculptor.grab(Vertex_index(pushed));
    const double c = largest_clearance(sculptor, {0, 0, 0});
    for (int push = 0; push < 100; ++push) {
      const Point_3 p = mesh.point(Vertex_index(pushed));
      const double steepness = std::pow(10.0, -3 * std::abs(number(random)));
      grab.drag_to({p.x() + 0.1 * number(random), p.y() + 0.1 * number(random), -steepness});
      const double gap = mesh.point(Vertex_index(pushed)).z();
      BOOST_REQUIRE(gap >= 0.5 * c);
      BOOST_REQUIRE(push > 0 || gap <= 2 * c);
      BOOST_REQUIRE(gap <= 2 * c);
      const Point_3 q = mesh.point(Vertex_index(pushed));
      const auto slide = grab.drag_to({q.x() + (q.x() > 0 ? -10 : 10) * c, q.y(), q.z()});
      BOOST_REQUIRE(slide.reached);
    }
  }
}

BOOST_AUTO_TEST_CASE(generic_stops_are_not_lazy_at_any_scale_and_offset) {
  Random random(seed_from_environment(12));
  std::uniform_real_distribution<double> number(-1, 1);
  for (const double scale : {1.0, 1e-6, 1e6})
    for (const double offset : {0.0, 1e6}) {
      if (scale < 1 && offset > 0)
        continue; // a scene of size 1e-6 at 1e6 has no room: its clearance is 1e-9 of 1e-6
      std::vector<double> in_clearances;
      std::size_t generic = 0, lazy = 0;
      for (int i = 0; i < 300; ++i) {
        Mesh mesh = tip_over_plane({0.3 * number(random), 0.3 * number(random), 1});
        for (const Vertex_index v : mesh.vertices())
          mesh.point(v) = Point_3(mesh.point(v).x() * scale + offset, mesh.point(v).y() * scale + offset,
                                  mesh.point(v).z() * scale + offset);
        Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
        const Point_3 start = mesh.point(Vertex_index(pushed));
        const Point_3 target(start.x() + number(random) * scale, start.y() + number(random) * scale,
                             start.z() - 2 * scale);
        const auto impacts = first_impacts(mesh, Vertex_index(pushed), target);
        if (impacts.size() != 1)
          continue;
        ++generic;
        const auto result = sculptor.grab(Vertex_index(pushed)).drag_to(target);
        in_clearances.push_back(result.stop_error / clearance_kept(sculptor, result));
        lazy += in_clearances.back() > 2;
      }
      std::sort(in_clearances.begin(), in_clearances.end());
      BOOST_TEST_MESSAGE("scale " << scale << " offset " << offset << ": " << generic
                                  << " generic stops, normal distance in clearances: median "
                                  << in_clearances[in_clearances.size() / 2] << ", largest " << in_clearances.back());
      BOOST_TEST(generic > 200u);
      BOOST_TEST(lazy == 0u);
    }
}

namespace {

using Integer_point = std::array<std::int64_t, 3>;

Integer_point sum(const Integer_point& a, std::int64_t f, const Integer_point& b) {
  return {a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]};
}

std::int64_t dot(const Integer_point& a, const Integer_point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// From 2^52 on the doubles are the integers.
Point_3 far_point(const Integer_point& p) {
  const double origin = 0x1p52 + 0x1p20;
  return {origin + static_cast<double>(p[0]), origin + static_cast<double>(p[1]), origin + static_cast<double>(p[2])};
}

} // namespace

BOOST_AUTO_TEST_CASE(a_rounded_stop_is_proven_beside_a_wall_that_is_nearer_than_an_ulp) {
  // A tip comes down to a floor along a wall that is parallel to its path and 1/|n| of an ulp beside it, so that
  // rounding puts a third of the points of the path on the other side of the wall.
  const unsigned seed = seed_from_environment(14);
  Random random(seed);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<std::int64_t>(low, high)(random); };
  std::size_t scenes = 0, trapped = 0, through = 0, invalid = 0, far = 0;
  while (scenes < 200) {
    const Integer_point d = {number(-9, 9), number(-9, 9), -number(1, 9)}, level = {number(-9, 9), number(-9, 9), 0};
    const Integer_point n = {-d[2] * level[1], d[2] * level[0],
                             d[0] * level[1] - d[1] * level[0]}; // across d and level
    if (std::gcd(std::gcd(n[0], n[1]), n[2]) != 1)
      continue;
    Integer_point on_wall; // the integer points of the wall's plane have n x = 1
    do
      on_wall = {number(-40, 40), number(-40, 40), number(-40, 40)};
    while (dot(n, on_wall) != 1);
    const Integer_point away = {level[1], -level[0], 0};
    const std::int64_t lowest =
        static_cast<std::int64_t>(std::floor(static_cast<double>(on_wall[2] - 2) / static_cast<double>(-d[2])));
    const Integer_point foot = sum(on_wall, lowest, d), head = sum(on_wall, -400, d), tip = sum({0, 0, 0}, -300, d);
    const Integer_point back = sum(sum(tip, -500, away), 1000, {0, 0, 1});
    // Floor, wall and the one that moves; each with its fourth corner on the far side of the first three.
    std::array<std::array<Integer_point, 4>, 3> solids = {
        {{{{-9000, -9000, 0}, {9000, -9000, 0}, {0, 9000, 0}, {0, 0, -9000}}},
         {{sum(foot, -900, level), sum(foot, 900, level), head, sum(head, 900, away)}},
         {{tip, sum(back, -300, level), sum(back, 300, level), sum(back, 1000, {0, 0, 1})}}}};
    meshes::Triangle_list list;
    for (auto& p : solids) {
      std::array<Point_3, 4> q = {far_point(p[0]), far_point(p[1]), far_point(p[2]), far_point(p[3])};
      const meshes::Triangle_list like = meshes::tetrahedron();
      if (CGAL::orientation(q[0], q[1], q[2], q[3]) !=
          CGAL::orientation(like.points[0], like.points[1], like.points[2], like.points[3]))
        std::swap(q[1], q[2]);
      list += like;
      std::copy(q.begin(), q.end(), list.points.end() - 4);
    }
    Mesh mesh = meshes::to_mesh(list);
    if (!validate(mesh).is_valid())
      continue;
    ++scenes;
    for (int height = 4; height < 12; ++height) { // the trap: points of the path just above the floor, rounded
      const double t = -static_cast<double>(height) / static_cast<double>(d[2]);
      const Integer_point q = {std::llround(-t * static_cast<double>(d[0])),
                               std::llround(-t * static_cast<double>(d[1])), height};
      trapped += dot(n, q) >= 1;
    }
    const Vertex_index moved(8);
    Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
    const auto result = sculptor.grab(moved).drag_to(far_point(sum({0, 0, 0}, 300, d)));
    const Point_3 origin = far_point({0, 0, 0});
    const Integer_point end = {static_cast<std::int64_t>(result.position.x() - origin.x()),
                               static_cast<std::int64_t>(result.position.y() - origin.y()),
                               static_cast<std::int64_t>(result.position.z() - origin.z())};
    through += end[2] <= 0 || dot(n, end) >= 1;
    far += end[2] > 400;
    invalid += !validate(mesh).is_valid();
  }
  BOOST_TEST_MESSAGE("seed " << seed << ": " << trapped << " of " << 8 * scenes
                             << " rounded points of paths are behind the wall");
  BOOST_TEST(trapped > scenes);
  BOOST_TEST(through == 0u);
  BOOST_TEST(invalid == 0u);
  // The setback doubles until rounding falls on the right side, which may be far back, but seldom is.
  BOOST_TEST(far < scenes / 10);
}

BOOST_AUTO_TEST_CASE(slivers_stop_what_comes) {
  // The top face is a sliver 1e-12 wide along x; the vertex is pushed straight down on its middle.
  Mesh mesh = two_tetrahedra({Point_3(-8, 0, 0), Point_3(8, 0, 0), Point_3(0, 1e-12, 0), Point_3(0, 0, -3),
                              Point_3(0, 4e-13, 1), Point_3(-0.5, -0.5, 2), Point_3(0.5, -0.5, 2), Point_3(0, 0.5, 2)});
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
  const Point_3 target(0, 4e-13, -1);
  const auto result = sculptor.grab(Vertex_index(pushed)).drag_to(target);
  BOOST_TEST(!result.reached);
  BOOST_TEST(result.position.z() > 0);
  BOOST_TEST(result.position.z() <= 2 * largest_clearance(sculptor, target));
  BOOST_TEST(validate(mesh).is_valid());
}

namespace {

/// |n|^2 - delta^2 L^2 for the least altitude of a triangle, exactly: not negative if and only if the rule is kept.
bool keeps_rule(const std::array<std::array<mpq_class, 3>, 3>& p, const mpq_class& delta) {
  const auto squared = [](const std::array<mpq_class, 3>& v) {
    return mpq_class(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  };
  const auto edge = [&](int i, int j) {
    return std::array<mpq_class, 3>{p[j][0] - p[i][0], p[j][1] - p[i][1], p[j][2] - p[i][2]};
  };
  const auto a = edge(0, 1), b = edge(0, 2), c = edge(1, 2);
  const std::array<mpq_class, 3> n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const mpq_class area = squared(n), square = delta * delta;
  return area >= square * squared(a) && area >= square * squared(b) && area >= square * squared(c);
}

} // namespace

BOOST_AUTO_TEST_CASE(the_delta_rule_stops_where_a_rational_bisection_says) {
  Random random(seed_from_environment(13));
  std::size_t limited = 0, wrong = 0;
  for (int i = 0; i < 400; ++i) {
    const meshes::Triangle_list list = random_small_list(random, 3);
    Mesh mesh = meshes::to_mesh(list);
    const double delta = 0.25;
    if (!validate(mesh, delta).is_valid())
      continue;
    const Vertex_index v(static_cast<Mesh::size_type>(random() % list.points.size()));
    const Point_3 source = mesh.point(v), target = random_grid_point(random, 5);
    if (source == target)
      continue;
    Sculptor<Mesh> sculptor(mesh, parameters::delta(delta).response(Response::stop));
    const auto result = sculptor.grab(v).drag_to(target);
    wrong += !validate(mesh, delta).is_valid();
    // The rational time up to which no sampled point of the way breaks the rule, on 2^8 points.
    const auto kept_at = [&](const mpq_class& u) {
      for (const auto& f : list.faces) {
        if (std::find(f.begin(), f.end(), static_cast<std::size_t>(v)) == f.end())
          continue;
        std::array<std::array<mpq_class, 3>, 3> p;
        for (int k = 0; k < 3; ++k) {
          const Point_3 q = list.points[f[k]];
          p[k] = {q.x(), q.y(), q.z()};
          if (f[k] == static_cast<std::size_t>(v))
            for (int x = 0; x < 3; ++x)
              p[k][x] = mpq_class(source[x]) + u * (mpq_class(target[x]) - mpq_class(source[x]));
        }
        if (!keeps_rule(p, delta))
          return false;
      }
      return true;
    };
    const bool by_delta = !result.contacts.empty() && result.contacts[0].kind == Contact_kind::delta;
    limited += by_delta;
    const double way = std::sqrt(CGAL::squared_distance(source, target));
    const double made = std::sqrt(CGAL::squared_distance(source, result.position)) / way;
    constexpr int samples = 256;
    int first_broken = samples + 1;
    for (int k = 0; k <= samples && first_broken > samples; ++k)
      if (!kept_at(mpq_class(k, samples)))
        first_broken = k;
    // Not beyond the first sample that breaks the rule, and, when it is delta that stops it, at most a sample before
    // it.
    if (made > static_cast<double>(first_broken) / samples + 1e-12)
      ++wrong;
    if (by_delta && first_broken <= samples && made < static_cast<double>(first_broken - 1) / samples - 1e-9)
      ++wrong;
  }
  BOOST_TEST_MESSAGE(limited << " drags were limited by delta");
  BOOST_TEST(is_enough(limited, 50));
  BOOST_TEST(wrong == 0u);
}
