// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures are written, read back with libpng, and compared with what perspective and symmetry demand.
#include "drawing/write_picture.h"
#include <boost/test/unit_test.hpp>
#include <cfenv>
#include <fstream>
#include <limits>
#include <png.h>
#include <unistd.h>

using namespace haptic_sculpt::drawing;
namespace fs = std::filesystem;
using Vector = Eigen::Vector3d;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("haptic_sculpt_test_drawing_" + std::to_string(::getpid()));
  Folder() { fs::create_directory(path); }
  ~Folder() { fs::remove_all(path); }
  std::size_t entries() const { return std::size_t(std::distance(fs::directory_iterator(path), {})); }
};

struct Picture {
  int width, height;
  std::vector<unsigned char> bytes;
  Eigen::Vector3i at(int x, int y) const {
    const unsigned char* p = &bytes[3 * (std::size_t(y) * width + x)];
    return {p[0], p[1], p[2]};
  }
  Eigen::Vector3i at(const Eigen::Vector2d& p) const { return at(int(p.x()), int(p.y())); }
};

Picture read_png(const fs::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  BOOST_REQUIRE(png_image_begin_read_from_file(&image, path.c_str()));
  image.format = PNG_FORMAT_RGB;
  Picture result{int(image.width), int(image.height), std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
  BOOST_REQUIRE(png_image_finish_read(&image, nullptr, result.bytes.data(), 0, nullptr));
  return result;
}

Picture draw(const Scene& scene, const View& view) {
  Folder folder;
  write_picture(scene, folder.path / "picture.png", view);
  BOOST_TEST(folder.entries() == 1u); // no partial file is left beside it
  return read_png(folder.path / "picture.png");
}

Scene icosahedron() {
  const double g = (1 + std::sqrt(5.)) / 2;
  Scene s;
  s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  s.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return s;
}

View small_view(const Vector& direction = {0, 1, 0}) {
  View view;
  view.direction = direction;
  view.width = 400;
  view.height = 300;
  return view;
}

// The share of pixels whose colours differ by more than 8 of 255.
template <class Other_pixel>
double difference(const Picture& a, Other_pixel other_pixel) {
  int different = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      different += (a.at(x, y) - other_pixel(x, y)).cwiseAbs().maxCoeff() > 8;
  return double(different) / (a.width * a.height);
}
double difference(const Picture& a, const Picture& b) {
  return difference(a, [&](int x, int y) { return b.at(x, y); });
}

bool is_background(const Eigen::Vector3i& color) {
  return color == Eigen::Vector3i(255, 255, 255);
}

std::string refusal(const Scene& scene, const fs::path& path, const View& view = small_view()) {
  try {
    write_picture(scene, path, view);
  } catch (const Picture_error& error) {
    BOOST_TEST_MESSAGE(error.what());
    return error.what();
  }
  return "no refusal";
}
bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

} // namespace

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
  // Ways from and to far away run to the picture's margin of 12 pixels: green on the left, red and dashed on the right.
  const auto count = [&p](int from, int to, auto has_color) {
    int n = 0;
    for (int y = 0; y < p.height; ++y)
      for (int x = from; x < to; ++x)
        n += has_color(p.at(x, y));
    return n;
  };
  BOOST_TEST(count(10, 22, [](const Eigen::Vector3i& c) { return c.y() > 60 + c.x(); }) > 0);
  BOOST_TEST(count(p.width - 30, p.width - 10, [](const Eigen::Vector3i& c) { return c.x() > 60 + c.z(); }) > 0);
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

// A slab whose two sides are nearer to each other than depths can be told apart, cut into triangles that do not match.
BOOST_AUTO_TEST_CASE(faces_in_contact_do_not_flicker) {
  Scene scene;
  const double thin = 1e-14;
  scene.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, -thin}, {1, -1, -thin}, {1, 1, -thin}, {-1, 1, -thin},
                  {0.3, 0.1, 0}, {-0.2, 0.4, -thin}};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    scene.triangles.push_back({i, j, 8});
    scene.triangles.push_back({j + 4, i + 4, 9});
    scene.triangles.push_back({i + 4, j + 4, j});
    scene.triangles.push_back({i + 4, j, i});
  }
  for (const Vector& direction : {Vector(0.1, 0.3, -1), Vector(0.5, 1, -0.1), Vector(-1, 2, -0.02), Vector(0.5, 1, 0.3)}) {
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

BOOST_AUTO_TEST_CASE(an_inside_out_mesh_is_pink) {
  Scene scene = icosahedron();
  for (auto& t : scene.triangles)
    std::swap(t[0], t[1]);
  const Eigen::Vector3i inside = draw(scene, small_view()).at(200, 160),
                        outside = draw(icosahedron(), small_view()).at(200, 160);
  BOOST_TEST(inside.x() - inside.y() > 20 + outside.x() - outside.y());
}

BOOST_AUTO_TEST_CASE(what_cannot_be_drawn_is_refused) {
  const Folder folder;
  const fs::path path = folder.path / "picture.png";
  BOOST_TEST(says(refusal({}, path), "no triangle"));
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (double bad : {infinity, -infinity, nan}) {
    Scene scene = icosahedron();
    scene.points[7].y() = bad;
    BOOST_TEST(says(refusal(scene, path), "Point 7 is not finite"));
    scene = icosahedron();
    scene.add_blocked_drag({0, 0, 0}, {0, 0, 0}, {bad, 0, 0});
    BOOST_TEST(says(refusal(scene, path), "Segment 1 is not finite"));
    scene = icosahedron();
    scene.add_contact({0, 0, bad}, {0, 0, 1});
    BOOST_TEST(says(refusal(scene, path), "Ball 0 is not finite"));
    BOOST_TEST(says(refusal(icosahedron(), path, small_view({bad, 0, 0})), "direction"));
  }
  Scene scene = icosahedron();
  scene.triangles[3][1] = 12;
  BOOST_TEST(says(refusal(scene, path), "Triangle 3 names point 12"));
  scene = icosahedron();
  scene.point_colors.resize(5);
  BOOST_TEST(says(refusal(scene, path), "5 colours for 12 points"));
  scene = icosahedron();
  scene.add_contact({0, 0, 1}, {0, 0, 0});
  BOOST_TEST(says(refusal(scene, path), "Arrow 0 has no direction"));
  BOOST_TEST(says(refusal(icosahedron(), path, small_view({0, 0, 0})), "direction"));
  View view = small_view();
  view.width = 0;
  BOOST_TEST(says(refusal(icosahedron(), path, view), "positive width"));
  view.width = 2000000;
  BOOST_TEST(says(refusal(icosahedron(), path, view), "at most"));
  BOOST_TEST(folder.entries() == 0u);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_written_is_refused_and_leaves_nothing) {
  const Folder folder;
  const Scene scene = icosahedron();
  BOOST_TEST(says(refusal(scene, folder.path / "missing" / "picture.png"), "No such file or directory"));
  BOOST_TEST(says(refusal(scene, folder.path), "directory"));
  BOOST_TEST(says(refusal(scene, ""), "not name a file"));
  BOOST_TEST(says(refusal(scene, "/dev/full"), "not a regular file"));
  BOOST_TEST(fs::is_character_file("/dev/full"));
  BOOST_TEST(folder.entries() == 0u);
}

BOOST_AUTO_TEST_CASE(an_existing_file_is_replaced_also_through_a_link) {
  const Folder folder;
  std::ofstream(folder.path / "old.png") << "not a picture";
  fs::create_symlink("old.png", folder.path / "link.png");
  write_picture(icosahedron(), folder.path / "link.png", small_view());
  BOOST_TEST(fs::is_symlink(folder.path / "link.png"));
  BOOST_TEST(read_png(folder.path / "old.png").width == 400);
  BOOST_TEST(folder.entries() == 2u);
}

BOOST_AUTO_TEST_CASE(exact_arithmetic_can_rely_on_the_floating_point_environment) {
  std::fesetround(FE_UPWARD);
  draw(icosahedron(), small_view());
  const int rounding = std::fegetround();
  std::fesetround(FE_TONEAREST);
  BOOST_TEST(rounding == FE_UPWARD);
  volatile double smallest = std::numeric_limits<double>::min();
  volatile double half = smallest / 2;
  const bool kept = half * 2 == smallest;
  BOOST_TEST(kept); // not flushed to zero
}
