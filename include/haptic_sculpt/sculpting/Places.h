// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_PLACES_H
#define HAPTIC_SCULPT_SCULPTING_PLACES_H

#include <haptic_sculpt/sculpting/vector_3.h>
#include <haptic_sculpt/surface/Box_3.h>

#include <cstdint>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// Points, and on which sides of planes each of them lies: a bit a side. All of an edge lies on a side if both ends do.
///
/// One array for each coordinate, so that compilers take several points at a time.
class Places {
public:
  using Sides = std::uint64_t;

  std::size_t size() const { return x_.size(); }
  Vector operator[](std::size_t v) const { return {x_[v], y_[v], z_[v]}; }
  Sides sides(std::size_t v) const { return sides_[v]; }

  void clear() { x_.clear(), y_.clear(), z_.clear(); }
  void reserve(std::size_t n) { x_.reserve(n), y_.reserve(n), z_.reserve(n), sides_.reserve(n); }
  void push_back(const Vector& p) { x_.push_back(p[0]), y_.push_back(p[1]), z_.push_back(p[2]); }

  /// Sets the sides to those of the box that the points lie beyond: bits 0 to 5.
  void compare(const Box_3& box) {
    const std::size_t n = size();
    sides_.resize(n);
    const double *x = x_.data(), *y = y_.data(), *z = z_.data();
    Sides* const sides = sides_.data();
    for (std::size_t v = 0; v < n; ++v)
      sides[v] = (x[v] > box.upper[0] ? bit(0) : none) | (x[v] < box.lower[0] ? bit(1) : none) |
                 (y[v] > box.upper[1] ? bit(2) : none) | (y[v] < box.lower[1] ? bit(3) : none) |
                 (z[v] > box.upper[2] ? bit(4) : none) | (z[v] < box.lower[2] ? bit(5) : none);
  }

  /// Adds `below` to the sides of points whose height along n, rounded, is less than `low`, `above` where it is more than
  /// `high`. \pre compare() was called for these points
  void compare(const Vector& n, double low, Sides below, double high, Sides above) {
    const double *x = x_.data(), *y = y_.data(), *z = z_.data();
    Sides* const sides = sides_.data();
    for (std::size_t v = 0, end = size(); v < end; ++v) {
      const double height = n[0] * x[v] + n[1] * y[v] + n[2] * z[v];
      sides[v] |= (height < low ? below : none) | (height > high ? above : none);
    }
  }

  /// The same with an upper limit alone.
  void compare(const Vector& n, double high, Sides above) {
    const double *x = x_.data(), *y = y_.data(), *z = z_.data();
    Sides* const sides = sides_.data();
    for (std::size_t v = 0, end = size(); v < end; ++v)
      sides[v] |= n[0] * x[v] + n[1] * y[v] + n[2] * z[v] > high ? above : none;
  }

private:
  static constexpr Sides none = 0;
  static constexpr Sides bit(int k) { return Sides{1} << k; }

  std::vector<double> x_, y_, z_;
  std::vector<Sides> sides_;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
