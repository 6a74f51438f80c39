// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_DRAWING_WRITE_FIGURE_H
#define HAPTIC_SCULPT_DRAWING_WRITE_FIGURE_H

#include "Camera.h"
#include <filesystem>

namespace haptic_sculpt::drawing {

/// Values over x, in order of x; drawn as a line, or as bars that stand on 0, each from its x to the next.
struct Curve {
  std::vector<Eigen::Vector2d> points;
  Color color = colors::blue;
  std::string name; ///< ASCII; empty: not explained
  bool has_bars = false;
};

/// Curves over a common axis. Not finite values are left out.
struct Plot {
  std::string title, x_label; ///< ASCII, with units
  std::vector<Curve> curves;
  bool has_logarithmic_x = false, has_logarithmic_y = false; ///< values <= 0 are left out then
};

/// Draws a scene and, at its right, plots one below the other, and writes all as one PNG file, whole or not at all.
/// \param view of the scene alone; each plot is two thirds as wide
/// \return, \throw as write_picture()
std::string write_figure(const Scene& scene, const std::vector<Plot>& plots, const std::filesystem::path& path,
                         const View& view = {});

} // namespace haptic_sculpt::drawing

#endif
