// SPDX-License-Identifier: GPL-3.0-or-later
// Marks, arrows, labels and the legend.
#include "drawing/pictures.h"

#include <drawing/mark_triangles.h>

#include <boost/test/unit_test.hpp>

#include <utility>

using namespace haptic_sculpt::drawing;
using namespace drawing_tests;

BOOST_AUTO_TEST_CASE(marks_are_seen_where_they_are) {
  const View view = small_view({1, 2, -0.7});
  Scene scene = icosahedron();
  const Vector front = scene.points[4], stop{-1, -3, 0}, target{1e9, -3, 0}, start{-1, -3, 2};
  scene.add_moved_vertex(front);
  scene.balls.back().color = {0, 1, 0};
  scene.add_blocked_drag(start, stop, target);
  scene.segments.push_back({{-1e200, -3, 0}, stop, {0, 1, 0}, 3});
  const Camera camera(scene, view);
  const Picture p = draw(scene, view);
  const Eigen::Vector3i moved = p.at(camera.pixel(front)), stopped = p.at(camera.pixel(stop)),
                        travelled = p.at(camera.pixel((start + stop) / 2));
  BOOST_TEST(moved.y() > 60 + moved.x());
  BOOST_TEST(stopped.x() > 60 + stopped.z());
  BOOST_TEST(travelled.z() > 60 + travelled.x());
  // Ways from and to far away run to the picture's margin of 12 pixels: green at the bottom, red and dashed on the
  // right.
  const auto count = [&p](int left, int right, int top, int bottom, auto has_color) {
    int n = 0;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x)
        n += has_color(p.at(x, y));
    return n;
  };
  BOOST_TEST(
      count(0, p.width, p.height - 20, p.height - 10, [](const Eigen::Vector3i& c) { return c.y() > 60 + c.x(); }) > 0);
  BOOST_TEST(
      count(p.width - 30, p.width - 10, 0, p.height, [](const Eigen::Vector3i& c) { return c.x() > 60 + c.z(); }) > 0);
  for (int x = 0; x < p.width; ++x)
    for (int y = 0; y < p.height; ++y)
      if (x < 5 || y < 5 || x >= p.width - 5 || y >= p.height - 5)
        BOOST_REQUIRE(is_background(p.at(x, y)));
  // One behind the surface shows through, fainter.
  Scene hidden = icosahedron();
  hidden.add_moved_vertex({0, 0, 0});
  hidden.balls.back().color = {0, 1, 0};
  const Eigen::Vector2d pixel = Camera(hidden, view).pixel({0, 0, 0});
  const Eigen::Vector3i with = draw(hidden, view).at(pixel), without = draw(icosahedron(), view).at(pixel);
  BOOST_TEST(with.y() - with.x() > 15 + without.y() - without.x());
  BOOST_TEST(with.x() > 40);
}

BOOST_AUTO_TEST_CASE(arrows_stay_inside_the_frame) {
  for (const Vector& direction : {Vector(0, 1, 0), Vector(-1, 2, -0.9), Vector(0, 0, -1)}) {
    Scene scene = icosahedron();
    for (const Vector& p : icosahedron().points)
      scene.add_contact(p, p);
    const Picture p = draw(scene, small_view(direction));
    int purple = 0;
    for (int x = 0; x < p.width; ++x)
      for (int y = 0; y < p.height; ++y) {
        purple += p.at(x, y).z() > 30 + p.at(x, y).y();
        if (x < 3 || y < 3 || x >= p.width - 3 || y >= p.height - 3)
          BOOST_REQUIRE(is_background(p.at(x, y)));
      }
    BOOST_TEST(purple > 500);
  }
}

BOOST_AUTO_TEST_CASE(a_legend_stands_below_the_picture) {
  Scene scene = icosahedron();
  scene.add_moved_vertex(scene.points[5]);
  scene.add_blocked_drag({0, -4, 2}, {0, -2, 1}, {0, 2, 0});
  scene.add_contact({0, -2, 1}, {0, -1, 0.3});
  const View view = small_view({1, 2, -0.7});
  View less = view;
  scene.explain_marks();
  BOOST_TEST(scene.legend.size() == 5u);
  const int strip = scene.legend_height(view.width);
  less.height -= strip;
  const Picture with = draw(scene, view);
  scene.legend.clear();
  const Picture without = draw(scene, less);
  BOOST_TEST(with.height == view.height);
  int different = 0, dark = 0, purple = 0;
  for (int x = 0; x < view.width; ++x)
    for (int y = 0; y < view.height; ++y)
      if (y < less.height) {
        different += with.at(x, y) != without.at(x, y);
      } else {
        dark += with.at(x, y).maxCoeff() < 110;
        purple += with.at(x, y).z() > 40 + with.at(x, y).y() && with.at(x, y).x() > 20 + with.at(x, y).y();
      }
  BOOST_TEST(different == 0); // it takes nothing from the picture above
  BOOST_TEST(dark > 50);      // words
  BOOST_TEST(purple > 10);    // the arrow
}

BOOST_AUTO_TEST_CASE(labels_stand_beside_points_that_are_seen) {
  const View view = small_view();
  Scene scene = icosahedron();
  const Picture plain = draw(scene, view);
  const Camera camera(scene, view);
  const auto changed_about = [&](const Vector& place) {
    const Picture p = draw(scene, view);
    const Eigen::Vector2d at = camera.pixel(place);
    int near = 0, all = 0;
    for (int x = 0; x < p.width; ++x)
      for (int y = 0; y < p.height; ++y)
        if (p.at(x, y) != plain.at(x, y)) {
          ++all;
          near += x >= at.x() && x < at.x() + 30 && y <= at.y() && y > at.y() - 20;
        }
    return std::pair(near, all);
  };
  scene.labels = {{scene.points[4], "17"}}; // towards the eye
  const auto [near, all] = changed_about(scene.points[4]);
  BOOST_TEST(near > 20);
  BOOST_TEST(near == all);
  scene.labels = {{scene.points[7], "17"}}; // behind
  BOOST_TEST(changed_about(scene.points[7]).second == 0);
  scene.labels = {{scene.points[4], "17"}, {scene.points[4], "9999999"}}; // no room
  BOOST_TEST(changed_about(scene.points[4]).second == all);
}

// A way along the view is seen as a point, at any zoom, and is not cut by the frame.
BOOST_AUTO_TEST_CASE(a_dashed_line_has_few_dashes_however_near_one_looks) {
  Scene scene = icosahedron();
  scene.segments.push_back({{0, 0, 2}, {0, 0, -2}, {1, 0, 0}, 3, true});
  std::size_t at_first = 0;
  for (const double zoom : {1.0, 10.0, Camera::most_magnification}) {
    View view = small_view({0, 0, -1});
    view.magnification = zoom;
    const Camera camera(scene, view);
    Mark_triangles triangles(camera);
    triangles.add(scene.segments.back());
    at_first = at_first == 0 ? triangles.corners().size() : at_first;
    BOOST_TEST(triangles.corners().size() > 0u);
    BOOST_TEST(triangles.corners().size() <= 501u * 600u);
  }
  BOOST_TEST(at_first < 20000u);
}

BOOST_AUTO_TEST_CASE(a_place_behind_the_eye_has_no_pixel) {
  const Scene scene = icosahedron();
  const Camera camera(scene, small_view({0, 1, 0}));
  BOOST_TEST(camera.pixel({0, 0, 0}).allFinite());
  BOOST_TEST(camera.pixel({0.3, -2, 0.2}).allFinite());
  BOOST_TEST(!camera.pixel({0.3, -100, 0.2}).allFinite());
  BOOST_TEST(!camera.pixel({0, -1e300, 0}).allFinite());
}
