// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/outward_float.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace haptic_sculpt::internal {

/// The power of two by which coordinates are multiplied before they become floats: the range of floats ends at 2^128,
/// that of coordinates does not. Taken from the scene once. What is outside of the range of floats then has boxes that
/// are infinite, or too wide: no answer is lost.
class Box_scale {
public:
  Box_scale() = default; ///< 1

  /// The one that brings the middle one of the points to about 1, by the exponents of their largest coordinates; the
  /// origin does not count, nor what is not finite. So a few points far out, or close to the origin, take no digits
  /// from the others. \param for_each `for_each(visit)` calls `visit(p)` with all points. Cost: linear.
  template <class For_each>
  explicit Box_scale(const For_each& for_each) {
    constexpr int least = -1074, largest = 1023;
    std::vector<std::size_t> counts(largest - least + 1, 0);
    std::size_t count = 0;
    for_each([&](const Box_3::Coordinates& p) {
      const double size = std::max(std::abs(p[0]), std::max(std::abs(p[1]), std::abs(p[2])));
      if (size > 0 && std::isfinite(size))
        ++count, ++counts[std::ilogb(size) - least];
    });
    if (count == 0)
      return;
    int exponent = least;
    for (std::size_t passed = counts[0]; 2 * passed < count; passed += counts[++exponent - least])
      ;
    exponent = std::max(-most, std::min(most, -exponent));
    factor_ = std::ldexp(1.0, exponent);
    inverse_ = std::ldexp(1.0, -exponent);
  }

  /// That of the vertices of a mesh.
  template <class Mesh>
  static Box_scale of(const Mesh& mesh) {
    return Box_scale([&mesh](const auto& visit) {
      for (const auto v : mesh.vertices())
        visit(vertex_coordinates(mesh, v));
    });
  }

  double factor() const { return factor_; }

  /// Multiplied; exact but where that overflows or falls below the normal numbers.
  Box_3::Coordinates operator()(const Box_3::Coordinates& p) const {
    return {p[0] * factor_, p[1] * factor_, p[2] * factor_};
  }
  Box_3 operator()(Box_3 box) const {
    box.lower = (*this)(box.lower), box.upper = (*this)(box.upper);
    return box;
  }

  /// A float that is not above x times the factor. What the product has lost, and the conversion, the comparison tells:
  /// a float times the inverse is exact, or so large that the next float down is right, too.
  float below(double x) const {
    const float f = to_float(x * factor_);
    return next_down(f, static_cast<double>(f) * inverse_ > x);
  }
  /// A float that is not below it.
  float above(double x) const { return -below(-x); }

  /// A box around a multiplied box of doubles.
  Float_box around(const Box_3& box) const {
    Float_box result;
    for (int i = 0; i < 3; ++i)
      result.lower[i] = below(box.lower[i]), result.upper[i] = above(box.upper[i]);
    return result;
  }
  /// The box to ask with: it meets what around(box) meets, except the box of nothing. For the lower bound of a box
  /// around finite doubles is never +infinity: no such box is lost where an upper bound asked with is at most the
  /// largest float.
  Float_box query(const Box_3& box) const {
    constexpr float largest = std::numeric_limits<float>::max();
    Float_box result = around(box);
    for (int i = 0; i < 3; ++i) {
      result.lower[i] = std::max(result.lower[i], -largest);
      result.upper[i] = std::min(result.upper[i], largest);
    }
    return result;
  }

private:
  static constexpr int most = 1000; ///< the factor and its inverse are normal numbers

  double factor_ = 1, inverse_ = 1;
};

} // namespace haptic_sculpt::internal
