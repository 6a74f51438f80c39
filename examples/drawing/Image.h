// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"
#include <algorithm>
#include <cmath>

namespace haptic_sculpt::drawing {

/// Red, green, blue bytes, the lowest row first as OpenGL gives them. Places are given in pixels from the upper left
/// corner, like those of `Camera::pixel()`.
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> bytes;

  Image(int w, int h, const Color& background) : width(w), height(h), bytes(std::size_t(3) * w * h) {
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = byte(background[int(i % 3)]);
  }

  /// Mixes a colour in; `share` 0: none, 1: nothing else. Outside of the image: nothing.
  void blend(int x, int y, const Color& color, float share) {
    if (x < 0 || y < 0 || x >= width || y >= height || !(share > 0))
      return;
    unsigned char* const p = &bytes[3 * (std::size_t(height - 1 - y) * width + x)];
    for (int i = 0; i < 3; ++i)
      p[i] = byte(p[i] / 255.f * (1 - share) + color[i] * share);
  }

  /// Fills a shape with smooth edges. \param inside how far a place is inside of the shape, in pixels
  template <class Inside>
  void fill(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, const Color& color, const Inside& inside) {
    for (int y = std::max(0, int(lower.y()) - 1); y <= std::min(height - 1, int(upper.y()) + 1); ++y)
      for (int x = std::max(0, int(lower.x()) - 1); x <= std::min(width - 1, int(upper.x()) + 1); ++x)
        blend(x, y, color, float(std::clamp(inside(Eigen::Vector2d(x + 0.5, y + 0.5)) + 0.5, 0., 1.)));
  }

  void fill_disc(const Eigen::Vector2d& center, double radius, const Color& color) {
    const Eigen::Vector2d reach(radius, radius);
    fill(center - reach, center + reach, color, [&](const Eigen::Vector2d& p) { return radius - (p - center).norm(); });
  }

  void fill_box(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, const Color& color) {
    fill(lower, upper, color,
         [&](const Eigen::Vector2d& p) { return std::min((p - lower).minCoeff(), (upper - p).minCoeff()); });
  }

private:
  static unsigned char byte(float x) { return static_cast<unsigned char>(std::lround(255 * std::clamp(x, 0.f, 1.f))); }
};

} // namespace haptic_sculpt::drawing
