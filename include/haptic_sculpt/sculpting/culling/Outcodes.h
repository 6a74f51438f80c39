// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/Box_3.h>

#include <cstdint>
#include <vector>

namespace haptic_sculpt::internal {

/// Points and their outcodes: on the far side of which planes each certainly lies, a bit a side. All of an edge or face
/// lies on a side if all its corners do, which is one `and`.
///
/// The claim is that of any separating plane: whatever direction n has, a set is apart from what reaches no higher
/// along n than the lowest of the set. So directions may be rounded; what is measured along them has what rounding can
/// do taken off by slack(). Separating_planes, Spoke_planes and Swept_fan say which planes, and what each bit means.
///
/// One array for each coordinate, so that compilers take several points at a time.
class Outcodes {
public:
  using Outcode = std::uint64_t;

  std::size_t size() const { return x_.size(); }
  /// Of a point.
  Outcode outcode(std::size_t v) const { return sides_[v]; }

  /// Whether planes serve where no coordinate is larger than `reach`: else products might leave the range of doubles.
  static bool serve(double reach) { return reach > least_reach && reach < largest_reach; }

  /// A point so far beyond the highest of what moves, both measured and rounded along n, is certainly apart from it by
  /// more than `margin`. \param reach bounds all coordinates \param longest bounds the length of n
  static double slack(double reach, double longest, double margin) { return rounding * reach + longest * margin; }

  void reserve(std::size_t n) { x_.reserve(n), y_.reserve(n), z_.reserve(n), sides_.reserve(n); }
  void resize(std::size_t n) { x_.resize(n), y_.resize(n), z_.resize(n); }
  void set(std::size_t v, const Vector& p) { x_[v] = p[0], y_[v] = p[1], z_[v] = p[2]; }
  void scale(double factor) {
    for (std::vector<double>* coordinates : {&x_, &y_, &z_})
      for (double& x : *coordinates)
        x *= factor;
  }

  /// Takes those of the points, without their sides.
  void assign(const Outcodes& points, const std::vector<std::uint32_t>& which) {
    const std::size_t n = which.size();
    resize(n);
    for (std::size_t v = 0; v < n; ++v)
      x_[v] = points.x_[which[v]], y_[v] = points.y_[which[v]], z_[v] = points.z_[which[v]];
  }

  /// Sets the sides to those of the box that the points lie beyond: bits 0 to 5.
  void compare(const Box_3& box) {
    const std::size_t n = size();
    sides_.resize(n);
    const double *x = x_.data(), *y = y_.data(), *z = z_.data();
    Outcode* const sides = sides_.data();
    for (std::size_t v = 0; v < n; ++v)
      sides[v] = (x[v] > box.upper[0] ? bit(0) : none) | (x[v] < box.lower[0] ? bit(1) : none) |
                 (y[v] > box.upper[1] ? bit(2) : none) | (y[v] < box.lower[1] ? bit(3) : none) |
                 (z[v] > box.upper[2] ? bit(4) : none) | (z[v] < box.lower[2] ? bit(5) : none);
  }

  /// Sets all outcodes to none.
  void clear() { sides_.assign(size(), none); }

  /// Adds `below` to the sides of points whose height along n, rounded, is less than `low`, `above` where it is more
  /// than `high`. \pre sides of these points were set
  void compare(const Vector& n, double low, Outcode below, double high, Outcode above) {
    const double *x = x_.data(), *y = y_.data(), *z = z_.data();
    Outcode* const sides = sides_.data();
    for (std::size_t v = 0, end = size(); v < end; ++v) {
      const double height = n[0] * x[v] + n[1] * y[v] + n[2] * z[v];
      sides[v] |= (height < low ? below : none) | (height > high ? above : none);
    }
  }

  /// Adds `above_a` to the sides of points whose height along `a` is more than `high_a`, and the same with `b`.
  void compare(const Vector& a, double high_a, Outcode above_a, const Vector& b, double high_b, Outcode above_b) {
    const double *x = x_.data(), *y = y_.data(), *z = z_.data();
    Outcode* const sides = sides_.data();
    for (std::size_t v = 0, end = size(); v < end; ++v)
      sides[v] |= (a[0] * x[v] + a[1] * y[v] + a[2] * z[v] > high_a ? above_a : none) |
                  (b[0] * x[v] + b[1] * y[v] + b[2] * z[v] > high_b ? above_b : none);
  }

  /// Two planes with the same upper limits at most: of the height along n and another height together, given for each
  /// point in `us`, and the same with `vs`.
  void compare(const Vector& n, const std::vector<double>& us, double high_u, Outcode above_u,
               const std::vector<double>& vs, double high_v, Outcode above_v) {
    const double *x = x_.data(), *y = y_.data(), *z = z_.data(), *u = us.data(), *w = vs.data();
    Outcode* const sides = sides_.data();
    for (std::size_t v = 0, end = size(); v < end; ++v) {
      const double height = n[0] * x[v] + n[1] * y[v] + n[2] * z[v];
      sides[v] |= (height + u[v] > high_u ? above_u : none) | (height + w[v] > high_v ? above_v : none);
    }
  }

  /// The heights of all points along n, into the first elements of `heights`, which gets no shorter.
  void find_heights(const Vector& n, std::vector<double>& heights) const {
    if (heights.size() < x_.capacity())
      heights.resize(x_.capacity());
    for (std::size_t v = 0, end = size(); v < end; ++v)
      heights[v] = n[0] * x_[v] + n[1] * y_[v] + n[2] * z_[v];
  }

private:
  static constexpr double least_reach = 0x1p-200, largest_reach = 0x1p+200;

  /// 2^-45: more than ten times what two sums of three products with a direction, whose coordinates are at most 2, and
  /// a difference rounded once can be wrong together.
  static constexpr double rounding = 0x1p-45;

  static constexpr Outcode none = 0;
  static constexpr Outcode bit(int k) { return Outcode{1} << k; }

  std::vector<double> x_, y_, z_;
  std::vector<Outcode> sides_;
};

} // namespace haptic_sculpt::internal
