// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Camera.h"
#include "Text.h"

namespace haptic_sculpt::drawing {

inline const Color ink{0.10f, 0.10f, 0.12f};

/// Puts a label beside each of its points that is seen, in the order given, as long as they do not cover one another.
///
/// \param depth of the surface, by pixel, the lowest row first, as OpenGL keeps it
inline void write_labels(Image& image, const Scene& scene, const Camera& camera, const std::vector<float>& depth) {
  if (scene.labels.empty())
    return;
  const Text text(11);
  const float tolerance = 1e-4f; // of OpenGL's depths: those of a pixel vary where its surface is steep
  std::vector<bool> is_taken(std::size_t(image.width) * image.height, false);
  for (const Label& label : scene.labels) {
    const Eigen::Vector4d clip = camera.projection() * camera.scaled(label.place).homogeneous();
    const Eigen::Vector2d at = camera.pixel(label.place);
    if (!(clip.w() > 0 && at.x() >= 1 && at.y() >= 1 && at.x() < camera.width() - 1 && at.y() < camera.height() - 1))
      continue;
    const int x = int(at.x()), y = int(at.y());
    float behind = 0; // the farthest of the surface here
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        behind = std::max(behind, depth[std::size_t(camera.height() - 1 - y - j) * camera.width() + x + i]);
    if ((clip.z() / clip.w() + 1) / 2 > double(behind + tolerance))
      continue;
    const int width = text.width(label.text), left = std::min(x + 4, camera.width() - width - 2),
              base = std::max(y - 3, text.height());
    bool is_free = true;
    const auto each_pixel = [&](const auto& visit) {
      for (int v = std::max(0, base - text.height()); v <= base + 1 && v < image.height; ++v)
        for (int u = std::max(0, left - 1); u <= left + width && u < image.width; ++u)
          visit(std::size_t(v) * image.width + u, u, v);
    };
    each_pixel([&](std::size_t pixel, int, int) { is_free = is_free && !is_taken[pixel]; });
    if (!is_free)
      continue;
    each_pixel([&](std::size_t pixel, int u, int v) {
      is_taken[pixel] = true;
      image.blend(u, v, colors::white, 0.6f);
    });
    text.write(image, left, base - 1, label.text, ink);
  }
}

/// Says below the picture what its marks mean.
inline void write_legend(Image& image, const Scene& scene, int strip) {
  if (scene.legend.empty())
    return;
  const int column = image.width / int(scene.legend.size()), sign = 2 * strip;
  int size = strip / 2;
  const auto fits = [&](int height) {
    const Text text(height);
    return std::all_of(scene.legend.begin(), scene.legend.end(),
                       [&](const Legend_entry& e) { return text.width(e.text) < column - sign - strip; });
  };
  while (size > 6 && !fits(size))
    --size;
  const Text text(size);
  for (std::size_t i = 0; i < scene.legend.size(); ++i) {
    const Legend_entry& entry = scene.legend[i];
    const double left = int(i) * column + 0.5 * strip, right = left + sign, middle = image.height - 0.5 * strip,
                 thickness = 0.07 * strip;
    const auto bar = [&](double from, double to) {
      image.fill_box({from, middle - thickness}, {to, middle + thickness}, entry.color);
    };
    switch (entry.mark) {
    case Legend_entry::Mark::line:
      bar(left, right);
      break;
    case Legend_entry::Mark::dashes:
      for (double x = left; x < right; x += 0.5 * strip)
        bar(x, std::min(x + 0.3 * strip, right));
      break;
    case Legend_entry::Mark::arrow: {
      bar(left, right - 0.4 * strip);
      const double tip = right, head = 0.5 * strip;
      image.fill({tip - head, middle - head}, {tip, middle + head}, entry.color, [&](const Eigen::Vector2d& p) {
        return std::min(p.x() - (tip - head), 0.4 * (tip - p.x()) - std::abs(p.y() - middle));
      });
      break;
    }
    case Legend_entry::Mark::ball:
      image.fill_disc({right - 0.3 * strip, middle}, 0.2 * strip, entry.color);
      break;
    }
    text.write(image, int(right + 0.3 * strip), int(middle + 0.36 * size), entry.text, ink);
  }
}

} // namespace haptic_sculpt::drawing
