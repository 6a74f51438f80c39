// SPDX-License-Identifier: GPL-3.0-or-later
// What perspective and symmetry demand of a picture of a mesh.
#include "drawing/pictures.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

using namespace haptic_sculpt::drawing;
using namespace drawing_tests;

BOOST_AUTO_TEST_CASE(size_background_and_surface) {
  const Picture p = draw(icosahedron(), View{});
  BOOST_TEST(p.width == 1200);
  BOOST_TEST(p.height == 900);
  for (int x : {0, 1199})
    for (int y : {0, 899})
      BOOST_TEST(is_background(p.at(x, y)));
  // The surface's colour under white light: red >= green >= blue as in `colors::surface`, neither black nor white.
  const Eigen::Vector3i center = p.at(600, 460);
  BOOST_TEST_CONTEXT("centre " << center.transpose()) {
    BOOST_TEST(center.minCoeff() > 60);
    BOOST_TEST(center.maxCoeff() < 250);
  }
  Scene blue = icosahedron();
  blue.surface_color = {0, 0, 1};
  const Eigen::Vector3i blue_center = draw(blue, View{}).at(600, 460);
  BOOST_TEST(blue_center.z() > 100 + blue_center.x());
  blue.point_colors.assign(12, Color(0, 1, 0));
  const Eigen::Vector3i green_center = draw(blue, View{}).at(600, 460);
  BOOST_TEST(green_center.y() > 100 + green_center.z());
}

BOOST_AUTO_TEST_CASE(the_mesh_fills_the_picture_and_is_not_cut_off) {
  Scene scene = icosahedron();
  scene.points[9] *= 2.5; // a spike: the box's centre is no longer the outline's
  for (const Vector& direction : {Vector(0, 1, 0), Vector(-1, 2, -0.9), Vector(0, 0, -1), Vector(3, -1, 5)}) {
    const Picture p = draw(scene, small_view(direction));
    int left = p.width, right = -1, top = p.height, bottom = -1;
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x)
        if (!is_background(p.at(x, y)))
          left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    BOOST_TEST_CONTEXT("outline from " << left << ", " << top << " to " << right << ", " << bottom) {
      BOOST_TEST(left > 0);
      BOOST_TEST(top > 0);
      BOOST_TEST(right < p.width - 1);
      BOOST_TEST(bottom < p.height - 1);
      // 1 / 1.12 of the picture, less what perspective takes from the far parts.
      BOOST_TEST(std::max((right - left) / double(p.width), (bottom - top) / double(p.height)) > 0.75);
      BOOST_TEST(std::abs(left + right - p.width) < 0.16 * p.width);
      BOOST_TEST(std::abs(top + bottom - p.height) < 0.16 * p.height);
    }
  }
}

// Along y the icosahedron is mirrored by x -> -x. The lights are not, so only the outline must be.
BOOST_AUTO_TEST_CASE(a_mirrored_mesh_has_a_mirrored_outline) {
  const Picture p = draw(icosahedron(), small_view());
  int different = 0, covered = 0;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      covered += !is_background(p.at(x, y));
      different += is_background(p.at(x, y)) != is_background(p.at(p.width - 1 - x, y));
    }
  BOOST_TEST(covered > 20000);
  BOOST_TEST(different < 0.002 * covered);
}

// Half a turn about the vertical axis maps the icosahedron onto itself; lights go with the eye, so all colours agree.
BOOST_AUTO_TEST_CASE(half_a_turn_changes_nothing) {
  const Picture there = draw(icosahedron(), small_view({1, 2, -0.7})),
                back = draw(icosahedron(), small_view({-1, -2, -0.7}));
  BOOST_TEST(difference(there, back) < 0.003);
  BOOST_TEST(difference(there, draw(icosahedron(), small_view({1, 1, -0.7}))) > 0.05); // it can tell a difference
}

BOOST_AUTO_TEST_CASE(size_and_place_of_the_mesh_do_not_matter) {
  Scene plain = icosahedron();
  plain.add_moved_vertex(plain.points[5]);
  plain.add_blocked_drag({0, -4, 2}, {0, -2, 1}, {0, 2, 0});
  plain.add_contact({0, -2, 1}, {0, -1, 0.3});
  const Picture expected = draw(plain, small_view({1, 2, -0.7}));
  const double largest = std::numeric_limits<double>::max(), smallest = std::numeric_limits<double>::min();
  for (double scale : {1e-6, 1e6, smallest, largest / 8})
    for (double offset : {0., 1e9}) {
      if (offset != 0 && scale != 1e6)
        continue;
      Scene moved = plain;
      auto map = [&](Vector& v) { v = v * scale + Vector(offset, -offset, offset); };
      for (auto& q : moved.points)
        map(q);
      for (auto& s : moved.segments)
        map(s.source), map(s.target);
      for (auto& b : moved.balls)
        map(b.center);
      for (auto& a : moved.arrows)
        map(a.foot), a.direction *= scale;
      BOOST_TEST_CONTEXT("scale " << scale << ", offset " << offset)
      BOOST_TEST(difference(draw(moved, small_view({1, 2, -0.7})), expected) < 0.003);
    }
  // Where the box's extent overflows, or its coordinates are subnormal.
  for (double scale : {largest / 1.7, 4000 * std::numeric_limits<double>::denorm_min()}) {
    Scene extreme = icosahedron();
    for (auto& q : extreme.points)
      q *= scale;
    BOOST_TEST_CONTEXT("scale " << scale)
    BOOST_TEST(difference(draw(extreme, small_view()), draw(icosahedron(), small_view())) < 0.01);
  }
  Scene far = icosahedron(); // the icosahedron of edge 2e-6 at 1e9 has no digits left; edge 2 has 23 bits
  for (auto& q : far.points)
    q += Vector(1e9, 1e9, -1e9);
  BOOST_TEST(difference(draw(far, small_view()), draw(icosahedron(), small_view())) < 0.003);
}

// A slab whose two sides are nearer to each other than depths can be distinguished, cut into triangles that do not
// match.
BOOST_AUTO_TEST_CASE(faces_in_contact_do_not_flicker) {
  Scene scene;
  const double thin = 1e-14;
  scene.points = {{-1, -1, 0},    {1, -1, 0},    {1, 1, 0},      {-1, 1, 0},    {-1, -1, -thin},
                  {1, -1, -thin}, {1, 1, -thin}, {-1, 1, -thin}, {0.3, 0.1, 0}, {-0.2, 0.4, -thin}};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    scene.triangles.push_back({i, j, 8});
    scene.triangles.push_back({j + 4, i + 4, 9});
    scene.triangles.push_back({i + 4, j + 4, j});
    scene.triangles.push_back({i + 4, j, i});
  }
  for (const Vector& direction :
       {Vector(0.1, 0.3, -1), Vector(0.5, 1, -0.1), Vector(-1, 2, -0.02), Vector(0.5, 1, 0.3)}) {
    const Picture p = draw(scene, small_view(direction));
    int covered = 0, pink = 0;
    for (int x = 0; x < p.width; ++x)
      for (int y = 0; y < p.height; ++y) {
        covered += !is_background(p.at(x, y));
        pink += p.at(x, y).x() > 12 + p.at(x, y).y(); // the surface's own red is less above its green
      }
    BOOST_TEST_CONTEXT("from " << direction.transpose() << ": " << covered << " covered") {
      BOOST_TEST(covered > 300);
      BOOST_TEST(pink == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_inside_out_mesh_is_pink) {
  Scene scene = icosahedron();
  for (auto& t : scene.triangles)
    std::swap(t[0], t[1]);
  const Eigen::Vector3i inside = draw(scene, small_view()).at(200, 160),
                        outside = draw(icosahedron(), small_view()).at(200, 160);
  BOOST_TEST(inside.x() - inside.y() > 20 + outside.x() - outside.y());
}
