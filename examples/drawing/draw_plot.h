// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_DRAWING_DRAW_PLOT_H
#define HAPTIC_SCULPT_DRAWING_DRAW_PLOT_H

#include "Image.h"
#include "Text.h"
#include "write_figure.h"
#include "write_words.h"
#include <cmath>
#include <cstdio>

namespace haptic_sculpt::drawing {

/// From values to pixels, along one direction.
struct Plot_axis {
  double least = 0, greatest = 1, first = 0, last = 1; ///< values (their logarithms, if so), and the pixels of both
  bool is_logarithmic = false;

  double place_of(double value) const {
    const double v = is_logarithmic ? std::log10(value) : value;
    return first + (v - least) / (greatest - least) * (last - first);
  }
  /// Where numbers stand: 1, 2 or 5 times a power of ten apart, or at powers of ten.
  std::vector<double> marks() const {
    std::vector<double> all;
    if (is_logarithmic) {
      for (double power = std::ceil(least - 1e-9); power <= greatest + 1e-9; ++power)
        all.push_back(std::pow(10, power));
      return all;
    }
    const double wanted = (greatest - least) / 5, power = std::pow(10, std::floor(std::log10(wanted)));
    const double step = power * (wanted > 5 * power ? 10 : wanted > 2 * power ? 5 : wanted > power ? 2 : 1);
    for (double k = std::ceil(least / step - 1e-9); k * step <= greatest + 1e-9 * step; ++k)
      all.push_back(k * step);
    return all;
  }
};

/// Draws a plot into a box of an image, from its upper left to its lower right corner, in pixels.
class Plot_painter {
public:
  Plot_painter(Image& image, const Eigen::Vector2i& lower, const Eigen::Vector2i& upper, const Plot& plot)
      : image_(image), plot_(plot), text_(std::max(9, (upper.y() - lower.y()) / 18)) {
    const int line = 3 * text_.height() / 2;
    x_ = axis(0, plot.has_logarithmic_x, lower.x() + 5 * text_.height(), upper.x() - line);
    y_ = axis(1, plot.has_logarithmic_y, upper.y() - 3 * line, lower.y() + 2 * line);
    text_.write(image, int(x_.first), lower.y() + line, plot.title, ink);
    text_.write(image, int(x_.last) - text_.width(plot.x_label), upper.y() - line / 2, plot.x_label, ink);
    paint_grid(line);
    for (const Curve& curve : plot.curves)
      paint(curve);
    int left = int(x_.last);
    for (auto curve = plot.curves.rbegin(); curve != plot.curves.rend(); ++curve)
      if (!curve->name.empty()) {
        left -= text_.width(curve->name) + line;
        text_.write(image, left, lower.y() + line, curve->name, curve->color);
      }
  }

private:
  Image& image_;
  const Plot& plot_;
  Text text_;
  Plot_axis x_, y_;

  bool is_shown(const Eigen::Vector2d& p) const {
    return p.allFinite() && (!plot_.has_logarithmic_x || p.x() > 0) && (!plot_.has_logarithmic_y || p.y() > 0);
  }

  Plot_axis axis(int which, bool is_logarithmic, double first, double last) const {
    Plot_axis axis;
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    bool has_bars = false;
    for (const Curve& curve : plot_.curves) {
      has_bars = has_bars || curve.has_bars;
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const Eigen::Vector2d& p = curve.points[i];
        if (is_shown(p) && which == 0 && curve.has_bars && i + 1 < curve.points.size()) { // to where the bar ends
          const double end = curve.points[i + 1].x();
          greatest = std::max(greatest, is_logarithmic ? std::log10(end) : end);
        }
        if (is_shown(p)) {
          const double v = is_logarithmic ? std::log10(p[which]) : p[which];
          least = std::min(least, v), greatest = std::max(greatest, v);
        }
      }
    }
    if (which == 1 && !is_logarithmic)
      least = std::min(least, 0.0), greatest = std::max(greatest, 0.0);
    if (which == 1 && is_logarithmic && has_bars)
      least -= 0.3; // the lowest bar is seen, too
    if (!(greatest > least))
      least = std::isfinite(least) ? least - 0.5 : 0, greatest = least + 1;
    const double margin = which == 1 ? 0.05 * (greatest - least) : 0;
    axis.least = least - (least < 0 && !is_logarithmic ? margin : 0), axis.greatest = greatest + margin;
    axis.first = first, axis.last = last, axis.is_logarithmic = is_logarithmic;
    return axis;
  }

  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 1e-12 ? 0.0 : value);
    return text;
  }

  void paint_grid(int line) {
    const Color pale(0.86f, 0.86f, 0.86f), dark(0.45f, 0.45f, 0.45f);
    for (const double value : x_.marks()) {
      const double x = x_.place_of(value);
      image_.fill_box({x - 0.5, y_.last}, {x + 0.5, y_.first}, pale);
      text_.write(image_, int(x) - text_.width(number(value)) / 2, int(y_.first) + line, number(value), ink);
    }
    for (const double value : y_.marks()) {
      const double y = y_.place_of(value);
      image_.fill_box({x_.first, y - 0.5}, {x_.last, y + 0.5}, pale);
      text_.write(image_, int(x_.first) - text_.width(number(value)) - 4, int(y) + text_.height() / 3, number(value),
                  ink);
    }
    image_.fill_box({x_.first, y_.first - 0.5}, {x_.last, y_.first + 0.5}, dark);
    image_.fill_box({x_.first - 0.5, y_.last}, {x_.first + 0.5, y_.first}, dark);
  }

  /// A line as what it covers in each column of pixels: any number of points costs the same.
  void paint(const Curve& curve) {
    const double zero = y_.is_logarithmic ? y_.first : y_.place_of(0);
    if (curve.has_bars) {
      for (std::size_t i = 0; i + 1 < curve.points.size(); ++i)
        if (is_shown(curve.points[i])) {
          const double top = y_.place_of(curve.points[i].y());
          image_.fill_box({x_.place_of(curve.points[i].x()), std::min(top, zero)},
                          {x_.place_of(curve.points[i + 1].x()), std::max(top, zero)}, curve.color);
        }
      return;
    }
    const int columns = int(x_.last - x_.first) + 1;
    std::vector<double> upper(columns, 1e300), lower(columns, -1e300); // in pixels, downwards
    const auto cover = [&](int column, double y) {
      if (column >= 0 && column < columns)
        upper[column] = std::min(upper[column], y), lower[column] = std::max(lower[column], y);
    };
    const Eigen::Vector2d* last = nullptr;
    for (const auto& p : curve.points) {
      if (!is_shown(p)) {
        last = nullptr;
        continue;
      }
      const double x = x_.place_of(p.x()) - x_.first, y = y_.place_of(p.y());
      if (last != nullptr) {
        const double from = x_.place_of(last->x()) - x_.first, height = y_.place_of(last->y());
        for (int column = int(std::floor(from)) + 1; column <= int(x); ++column)
          cover(column, height + (y - height) * (column - from) / (x - from));
      }
      cover(int(x), y);
      last = &p;
    }
    for (int column = 0; column < columns; ++column)
      if (upper[column] < 1e299)
        image_.fill_box({x_.first + column, upper[column] - 0.75}, {x_.first + column + 1, lower[column] + 0.75},
                        curve.color);
  }
};

} // namespace haptic_sculpt::drawing

#endif
