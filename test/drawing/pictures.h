// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Pictures are written, and read back with libpng.

#include "drawing/write_picture.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <png.h>
#include <unistd.h>

namespace drawing_tests {

using namespace haptic_sculpt::drawing;
namespace fs = std::filesystem;
using Vector = Eigen::Vector3d;

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

inline Picture read_png(const fs::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  BOOST_REQUIRE(png_image_begin_read_from_file(&image, path.c_str()));
  image.format = PNG_FORMAT_RGB;
  Picture result{int(image.width), int(image.height), std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
  BOOST_REQUIRE(png_image_finish_read(&image, nullptr, result.bytes.data(), 0, nullptr));
  return result;
}

inline Picture draw(const Scene& scene, const View& view) {
  Folder folder;
  write_picture(scene, folder.path / "picture.png", view);
  BOOST_TEST(folder.entries() == 1u); // no partial file is left beside it
  return read_png(folder.path / "picture.png");
}

inline Scene icosahedron() {
  const double g = (1 + std::sqrt(5.)) / 2;
  Scene s;
  s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  s.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return s;
}

inline View small_view(const Vector& direction = {0, 1, 0}) {
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
inline double difference(const Picture& a, const Picture& b) {
  return difference(a, [&](int x, int y) { return b.at(x, y); });
}

inline bool is_background(const Eigen::Vector3i& color) {
  return color == Eigen::Vector3i(255, 255, 255);
}

} // namespace drawing_tests
