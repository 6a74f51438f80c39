// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Box_node.h>
#include <haptic_sculpt/surface/broad_phase/Box_scale.h>
#include <haptic_sculpt/surface/broad_phase/Swept_star_3.h>

#include <limits>

namespace haptic_sculpt::internal {

/// What lies between two parallel planes that have a swept star between them. A long edge that goes far sideways sweeps
/// a sheet, which one slab holds; a needle is held by two that cross along it. The proof that no rounding loses a box
/// is in doc/proofs/broad_phase.md.
class Slab_of_points {
public:
  using Vector = std::array<double, 3>;

  Slab_of_points() = default; ///< everything

  /// \param scale of the boxes \param normal of the planes; any will do, and of one that is too short or not finite the
  /// slab is everything \param thickness in the scale; of a thicker one it is everything, too
  Slab_of_points(const Swept_star_3& star, const Box_scale& scale, const Vector& normal, double thickness) {
    const double largest = std::fmax(std::fmax(std::abs(normal[0]), std::abs(normal[1])), std::abs(normal[2]));
    if (star.valence == 0 || !(largest > least_normal && largest < 1 / least_normal))
      return;
    const Vector g = scale(star.link[0]);
    double low = 0, high = 0, across = 0;
    bool are_finite = true;
    for (int i = 0; i < 3; ++i) {
      origin_[i] = to_float(g[i]); // any origin will do
      normal_[i] = to_float(normal[i] / largest);
    }
    // Both factors are floats from here on: what is bounded is this function, whatever it has to do with the plane.
    const auto include = [&](const Swept_star_3::Coordinates& p, bool is_first) {
      double sum = 0, size = 0;
      for (int i = 0; i < 3; ++i) {
        const double term = double{normal_[i]} * (p[i] - double{origin_[i]});
        sum += term, size += std::abs(term);
      }
      // A point so far out that it overflows in the scale may have no place along the normal: 0 * infinity.
      are_finite = are_finite && size <= std::numeric_limits<double>::max();
      const double error = 0x1p-40 * size; // seven roundings of 2^-53
      low = is_first || sum - error < low ? sum - error : low;
      high = is_first || sum + error > high ? sum + error : high;
      across = std::fmax(across, size);
    };
    include(scale(star.source), true);
    include(scale(star.target), false);
    for (std::size_t i = 0; i < star.valence; ++i)
      include(scale(star.link[i]), false);
    is_thin_ = are_finite && high - low < std::fmin(thickness, across / 8) && across > 0x1p-100 && across < 0x1p+100;
    low_ = -float_above(-low), high_ = float_above(high);
  }

  /// Whether it is much thinner than a box around the points.
  bool is_thin() const { return is_thin_; }

  /// Bit j is 0 only if box j of the node lies on one side of the slab.
  unsigned meeting(const Box_node& node) const {
    float least[8] = {}, most[8] = {}, size[8] = {};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 8; ++j) {
        const float a = (node.bounds[i][j] - origin_[i]) * normal_[i],
                    b = (node.bounds[i + 3][j] - origin_[i]) * normal_[i];
        const float small = a < b ? a : b, large = a < b ? b : a;
        least[j] += small, most[j] += large;
        size[j] += std::abs(a) > std::abs(b) ? std::abs(a) : std::abs(b); // grows with the box
      }
    for (int j = 0; j < 8; ++j) {
      // A difference, a product, two sums and what follows here: five roundings of 2^-24; these are 64.
      const float error = 0x1p-18f * size[j] + least_error;
      least[j] -= error, most[j] += error;
    }
    return (Eight_flags::greater(least, high_) | Eight_flags::greater(low_, most)).where_not();
  }

private:
  static constexpr double least_normal = 0x1p-900; ///< shorter ones, and their inverses, are not divided by
  static constexpr float least_error =
      0x1p-120f; ///< more than products lose that underflow; far below any thickness there is

  float origin_[3] = {}, normal_[3] = {}, low_ = 0, high_ = 0;
  bool is_thin_ = false;
};

} // namespace haptic_sculpt::internal
