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
