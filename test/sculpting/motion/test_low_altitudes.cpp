// SPDX-License-Identifier: GPL-3.0-or-later
// Altitudes that are below delta already, as undo may leave them after set_delta(): they may not get lower, and that is
// all.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/Random_scene.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

#include <boost/test/unit_test.hpp>

#include <gmpxx.h>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using internal::Altitude_over;
using Coordinates = std::array<double, 3>;
using Rational_point = std::array<mpq_class, 3>;

Rational_point minus(const Rational_point& p, const Rational_point& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
mpq_class squared(const Rational_point& p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; }
Rational_point rational(const Coordinates& p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }

/// The square of the altitude of c over ab.
mpq_class squared_height(const Rational_point& a, const Rational_point& b, const Rational_point& c) {
  const Rational_point u = minus(b, a), v = minus(c, a);
  const Rational_point n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  return squared(n) / squared(u);
}

mpq_class squared_altitude_at(const mpq_class& u, const Coordinates& s, const Coordinates& t, const Coordinates& g,
                              const Coordinates& i, Altitude_over side) {
  const Rational_point from = rational(s), to = rational(t), rg = rational(g), ri = rational(i);
  Rational_point j;
  for (int k = 0; k < 3; ++k)
    j[k] = from[k] + u * (to[k] - from[k]);
  return side == Altitude_over::gi   ? squared_height(rg, ri, j)
         : side == Altitude_over::ji ? squared_height(j, ri, rg)
                                     : squared_height(j, rg, ri);
}

/// The squares of the three altitudes of each face.
std::vector<mpq_class> squared_altitudes(const Mesh& mesh) {
  std::vector<mpq_class> all;
  for (const auto f : mesh.faces()) {
    const auto corners = internal::corners_of_face(mesh, f);
    std::array<Rational_point, 3> p;
    for (int k = 0; k < 3; ++k)
      p[k] = rational(haptic_sculpt::vertex_coordinates(mesh, corners[k]));
    for (int k = 0; k < 3; ++k)
      all.push_back(squared_height(p[k], p[(k + 1) % 3], p[(k + 2) % 3]));
  }
  return all;
}

/// A tetrahedron with its last vertex, J, close to the edge of the first two.
Mesh low_tetrahedron() {
  meshes::Triangle_list list = meshes::tetrahedron();
  list.points[3] = Point_3(0.4, 0.02, 0.02);
  return meshes::to_mesh(list);
}

} // namespace

BOOST_AUTO_TEST_CASE(undo_restores_what_was_whatever_delta_is_and_drags_mend_it) {
  for (const Response response : {Response::stop, Response::slide}) {
    Mesh mesh = low_tetrahedron();
    Sculptor<Mesh> sculptor(mesh, parameters::response(response));
    const Vertex_index j(3);
    const Point_3 high(0.3, 0.3, 0.6);
    const Mesh_snapshot begin = snapshot(sculptor);
    BOOST_TEST(sculptor.grab(j).drag_to(high).reached);
    sculptor.set_delta(0.1);
    BOOST_TEST(static_cast<bool>(sculptor.undo()));
    BOOST_TEST((snapshot(sculptor) == begin));
    BOOST_TEST(!validate(mesh, 0.1).is_valid());
    const Point_3 low = mesh.point(j);
    // Lower it does not go, upwards it does, below delta or not.
    auto grab = sculptor.grab(j);
    const auto down = grab.drag_to(Point_3(0.4, 0.018, 0.018));
    BOOST_TEST(!down.reached);
    BOOST_REQUIRE(!down.contacts.empty());
    BOOST_TEST((down.contacts[0].kind == Contact_kind::delta));
    BOOST_TEST(down.stop_error == 0); // it is where it may not get lower
    if (response == Response::stop)
      BOOST_TEST((mesh.point(j) == low));
    while (mesh.point(j) != low) // a slide goes beside it
      BOOST_REQUIRE(static_cast<bool>(sculptor.undo()));
    BOOST_TEST(grab.drag_to(Point_3(0.4, 0.03, 0.05)).reached);
    BOOST_TEST(!validate(mesh, 0.1).is_valid());
    BOOST_TEST(sculptor.move_if_free(j, Point_3(0.4, 0.04, 0.06)));
    BOOST_TEST(!sculptor.move_if_free(j, Point_3(0.4, 0.03, 0.05)));
    BOOST_TEST(grab.drag_to(high).reached);
    BOOST_TEST(validate(mesh, 0.1).is_valid());
    BOOST_TEST(!grab.drag_to(Point_3(0.4, 0.02, 0.02)).reached);
    BOOST_TEST(validate(mesh, 0.1).is_valid());
    while (sculptor.undo())
      ;
    BOOST_TEST((snapshot(sculptor) == begin));
  }
}

// The altitude of I over JG is |GI| sin(JGI): delta is a cone about the line GI, from which J has a distance.
BOOST_AUTO_TEST_CASE(the_stop_error_of_a_low_altitude_is_a_distance) {
  const double delta = 0.05, clearance = 0.002, right_angle = std::acos(0.0);
  for (const Response response : {Response::stop, Response::slide})
    for (const double base : {0.08, 0.125, 0.25, 0.5}) {
      meshes::Triangle_list list = meshes::tetrahedron();
      const Point_3 g(0, 0, 0), i(base, 0, 0);
      list.points = {g, i, Point_3(base / 4, base / 8, -3), Point_3(1.2, 1.8, 0.5)};
      if (CGAL::orientation(list.points[0], list.points[1], list.points[2], list.points[3]) == CGAL::NEGATIVE)
        for (auto& face : list.faces)
          std::swap(face[0], face[1]);
      Mesh mesh = meshes::to_mesh(list);
      Sculptor<Mesh> sculptor(mesh, parameters::response(response).delta(delta).clearance(clearance));
      const auto result = sculptor.drag(Vertex_index(3), Point_3(2, 0.001, 0.001));
      BOOST_TEST(!result.reached);
      BOOST_REQUIRE(!result.contacts.empty());
      BOOST_TEST((result.contacts[0].kind == Contact_kind::delta));
      const auto way = result.position - g;
      const double length = std::sqrt(way.squared_length());
      const double angle = right_angle - std::asin(way * (i - g) / (length * base));
      const double distance = length * std::sin(angle - std::asin(delta / base));
      BOOST_TEST_MESSAGE(name_of(response) << ", base " << base << ": " << result.stop_error << " of " << distance);
      BOOST_TEST(distance > clearance / 2);
      BOOST_TEST(std::abs(result.stop_error - distance) < 0.02 * distance);
    }
}

BOOST_AUTO_TEST_CASE(the_limit_of_an_altitude_against_rational_samples) {
  Random random(seed_from_environment(51));
  std::size_t low = 0, limited_later = 0, held = 0, free = 0, wrong = 0;
  constexpr int samples = 64;
  for (int round = 0; round < 4000; ++round) {
    const auto point = [&] {
      const Point_3 p = random_grid_point(random, 6);
      return Coordinates{p.x(), p.y(), p.z()};
    };
    const Coordinates s = point(), t = point(), g = point(), i = point();
    const double delta = static_cast<double>(1 + random() % 12) / 2;
    if (s == g || s == i || g == i || s == t)
      continue;
    for (const Altitude_over side : {Altitude_over::gi, Altitude_over::ji, Altitude_over::jg}) {
      const mpq_class start = squared_altitude_at(0, s, t, g, i, side), square = mpq_class(delta) * mpq_class(delta);
      if (start == 0)
        continue;
      const mpq_class least = start < square ? start : square;
      const auto is_broken = [&](const mpq_class& u) {
        // where J passes through a corner there is no altitude
        const Rational_point j = {mpq_class(s[0]) + u * (mpq_class(t[0]) - s[0]),
                                  mpq_class(s[1]) + u * (mpq_class(t[1]) - s[1]),
                                  mpq_class(s[2]) + u * (mpq_class(t[2]) - s[2])};
        return j != rational(g) && j != rational(i) && squared_altitude_at(u, s, t, g, i, side) < least;
      };
      const auto limit = internal::delta_limit(s, t, g, i, delta, side);
      const double time = limit ? CGAL::to_double(*limit) : 1;
      low += start < square;
      for (int k = 0; k <= samples; ++k) {
        const double u = static_cast<double>(k) / samples;
        wrong += u < time - 1e-9 && is_broken(mpq_class(u));
      }
      if (!limit) {
        wrong += is_broken(mpq_class(1));
        ++free;
        continue;
      }
      (start < square ? (time > 0 ? limited_later : held) : free) += 1;
      wrong += !is_broken(mpq_class(time + 1e-7)); // the least grid is far coarser
    }
  }
  BOOST_TEST_MESSAGE(low << " begin low: " << held << " held, " << limited_later << " limited later; " << free
                         << " others");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(low > 300u);
  BOOST_TEST(limited_later > 20u);
  BOOST_TEST(held > 100u);
}

// Whole drags of a mesh of which much is below delta.
BOOST_AUTO_TEST_CASE(no_drag_lowers_an_altitude_below_delta) {
  Random random(seed_from_environment(52));
  std::uniform_real_distribution<double> number(-1, 1);
  const std::size_t drags = count_from_environment("HAPTIC_SCULPT_LOW_DRAGS", 400);
  const double delta = 0.3;
  const mpq_class square = mpq_class(delta) * mpq_class(delta);
  for (const Response response : {Response::stop, Response::slide, Response::paper()}) {
    // A sphere with some vertices close to a neighbour, which undo puts back there.
    const Mesh round = ball();
    Mesh mesh = round;
    std::vector<Vertex_index> displaced;
    for (const Vertex_index v : round.vertices()) {
      const Vertex_index w = round.source(round.halfedge(v));
      bool is_alone = true;
      for (const Vertex_index u : displaced)
        is_alone &= !round.halfedge(u, v).is_valid();
      if (is_alone) {
        mesh.point(v) = round.point(v) + 0.8 * (round.point(w) - round.point(v));
        displaced.push_back(v);
      }
    }
    BOOST_REQUIRE(validate(mesh).is_valid());
    Sculptor<Mesh> sculptor(mesh, parameters::response(response));
    for (const Vertex_index v : displaced)
      BOOST_REQUIRE(sculptor.move_if_free(v, round.point(v)));
    sculptor.set_delta(delta);
    while (sculptor.undo())
      ;
    BOOST_TEST(!validate(mesh, delta).is_valid());
    std::vector<mpq_class> before = squared_altitudes(mesh);
    std::size_t moved = 0, raised = 0, lowered = 0;
    for (std::size_t i = 0; i < drags; ++i) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
      const Point_3 home = mesh.point(v);
      const double x = number(random), y = number(random), z = number(random);
      sculptor.grab(v).drag_to(home + 0.3 * meshes::Kernel::Vector_3(x, y, z));
      const std::vector<mpq_class> after = squared_altitudes(mesh);
      moved += mesh.point(v) != home;
      for (std::size_t k = 0; k < after.size(); ++k) {
        raised += before[k] < square && after[k] > before[k];
        lowered += after[k] < before[k] && after[k] < square;
      }
      before = after;
    }
    BOOST_TEST_MESSAGE(name_of(response) << ": " << moved << " of " << drags << " drags moved, " << raised
                                         << " low altitudes raised");
    BOOST_TEST(lowered == 0u);
    BOOST_TEST(is_enough(moved, 20));
    BOOST_TEST(is_enough(raised, 20));
    BOOST_TEST(validate(mesh).is_valid());
    sculptor.check_unchanged();
  }
}
