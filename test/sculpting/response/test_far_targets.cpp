// SPDX-License-Identifier: GPL-3.0-or-later
// Slides of a vertex at the origin, where a unit in the last place is the least number there is, towards targets that
// are farther than 2^62 of those by more than the exponents of doubles can say.
#include "sculpting/Random_scene.h"

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// J, with number 0, at the origin.
Mesh tetrahedron_at_the_origin(const Point_3& a, const Point_3& b, const Point_3& c) {
  meshes::Triangle_list list = meshes::tetrahedron();
  list.points = {Point_3(0, 0, 0), a, b, c};
  return meshes::to_mesh(list);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_far_target_is_slid_to_from_the_origin) {
  const Point_3 a(1, 0, 0), b(0, 1, 0), c(0, 0, 1);
  for (const double far : {1e3, 1e17, 1e20, 1e30, 1e100, 1e299}) {
    Mesh mesh = tetrahedron_at_the_origin(a, b, c);
    BOOST_REQUIRE(validate(mesh).is_valid());
    Sculptor<Mesh> sculptor(mesh);
    // The face opposite of J is in the way at first; it leads on past its corner.
    auto grab = sculptor.grab(Vertex_index(0));
    const Point_3 target(far, 0.25 * far, 0.125 * far);
    auto r = grab.drag_to(target);
    BOOST_TEST(r.position.x() > 0.5, "first drag to " << far);
    for (int drags = 1; r.end == Drag_end::leg_limit && drags < 32; ++drags)
      r = grab.drag_to(target);
    BOOST_TEST_MESSAGE(far << ": " << name_of(r.end) << ", " << r.legs << " legs, at " << r.position << ", residual "
                           << r.kkt_residual);
    BOOST_TEST((r.end == Drag_end::held || r.end == Drag_end::reached));
    BOOST_TEST(r.kkt_residual < 1e-9);
    BOOST_TEST(validate(mesh).is_valid());
  }
}

BOOST_AUTO_TEST_CASE(a_far_target_is_slid_to_on_extreme_coordinates) {
  Mesh mesh =
      tetrahedron_at_the_origin(Point_3(1e150, 0, 0), Point_3(0, 1e-160, 0), Point_3(0x1.7b8p-1062, 0x1p-1074, 1e120));
  BOOST_REQUIRE(validate(mesh).is_valid());
  Sculptor<Mesh> sculptor(mesh);
  const auto r = sculptor.grab(Vertex_index(0)).drag_to(Point_3(std::exp2(498.6), 0, 0));
  BOOST_TEST_MESSAGE(name_of(r.end) << ", " << r.legs << " legs, at " << r.position << ", residual " << r.kkt_residual);
  BOOST_TEST(r.position.x() > 1e150);
  BOOST_TEST((r.end == Drag_end::held || r.end == Drag_end::reached));
  BOOST_TEST(r.kkt_residual < 1e-9);
  BOOST_TEST(validate(mesh).is_valid());
}

// Where the near part of the way ends has been rounded: that part may be blocked although the whole way is free.
BOOST_AUTO_TEST_CASE(a_straight_way_that_is_free_is_gone_whole) {
  meshes::Triangle_list octahedron = meshes::tetrahedron(), sliver = meshes::tetrahedron();
  octahedron.points = {Point_3(0x1p-29, 0, 0),
                       Point_3(1.8626451492309543e-09, -1.3775324423698682e-40, -9.8566039097300996e-26),
                       Point_3(0, 0x1p-29, 0),
                       Point_3(0, -0x1p-29, 0),
                       Point_3(0, 0, 0x1p-29),
                       Point_3(1.1716830767198667, 6.0038285874002267e-17, 0.042958959446437357)};
  octahedron.faces = {{4, 0, 2}, {4, 2, 1}, {4, 1, 3}, {4, 3, 0}, {5, 2, 0}, {5, 1, 2}, {5, 3, 1}, {5, 0, 3}};
  sliver.points = {Point_3(4.4967495551660476e+62, -3.9685903389388194e+62, -8.4236423935514126e+61),
                   Point_3(1, -0.069873809798145781, 0), Point_3(8.7900282575468599e-14, 1, -4.3556142965880123e+40),
                   Point_3(5.9452582616195368e+146, -5.2469665499723941e+146, -1.1137095566208568e+146)};
  sliver.faces = {{0, 2, 1}, {2, 0, 3}, {1, 2, 3}, {0, 1, 3}};
  const Point_3 targets[] = {Point_3(0x1.2bf36c27c9da4p-2, 0x1.14e0b27d57d4p-56, 0x1.5feb77bc907f1p-7),
                             Point_3(0x1.17d55a7a350f2p+372, -0x1.edee955681b35p+371, -0x1.a35d17ac79a96p+369)};
  const meshes::Triangle_list* lists[] = {&octahedron, &sliver};
  for (const int i : {0, 1}) {
    Mesh mesh = meshes::to_mesh(*lists[i]);
    BOOST_REQUIRE(validate(mesh).is_valid());
    BOOST_TEST(!first_impact(mesh, Vertex_index(0), targets[i]).has_value()); // brute force over all faces
    Sculptor<Mesh> sculptor(mesh);
    const auto result = sculptor.grab(Vertex_index(0)).drag_to(targets[i]);
    BOOST_TEST(result.reached, name_of(result.end) << " at " << result.position);
    BOOST_TEST(result.legs == 1);
  }
}
