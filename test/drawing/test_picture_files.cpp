// SPDX-License-Identifier: GPL-3.0-or-later
// What is refused, and what is left where a picture was to be written.
#include "drawing/pictures.h"

#include <boost/test/unit_test.hpp>

#include <cfenv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

using namespace haptic_sculpt::drawing;
using namespace drawing_tests;

namespace {

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
  BOOST_TEST(says(refusal(scene, folder.path / "mesh.off"), "does not end in .png"));
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
