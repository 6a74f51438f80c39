// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_SLAB_OF_POINTS_H
#define HAPTIC_SCULPT_SURFACE_SLAB_OF_POINTS_H

#include <haptic_sculpt/surface/broad_phase/Box_node.h>
#include <haptic_sculpt/surface/broad_phase/Swept_star_3.h>

namespace haptic_sculpt {
namespace internal {

/// What lies between two parallel planes that have a swept star between them: a long edge that goes far sideways sweeps
/// a sheet. The proof that no rounding loses a box is in doc/broad_phase.md.
class Slab_of_points {
public:
  /// About the plane of the source, the target and a point of the link.
  explicit Slab_of_points(const Swept_star_3& star) {
    if (star.valence == 0)
      return;
    const auto &s = star.source, &t = star.target, &g = star.link[0];
    double normal[3], largest = 0;
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(s[i] - g[i]) < largest_extent && std::abs(t[i] - g[i]) < largest_extent))
        return;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      normal[i] = (s[j] - g[j]) * (t[k] - g[k]) - (s[k] - g[k]) * (t[j] - g[j]);
      largest = std::fmax(largest, std::abs(normal[i]));
    }
    if (!(largest > least_size))
      return;
    double low = 0, high = 0, across = 0;
    for (int i = 0; i < 3; ++i) {
      origin_[i] = static_cast<float>(g[i]); // any origin will do
      normal_[i] = static_cast<float>(normal[i] / largest);
    }
    // Both factors are floats from here on: what is bounded is this function, whatever it has to do with the plane.
    const auto include = [&](const Swept_star_3::Coordinates& p, bool is_first) {
      double sum = 0, size = 0;
      for (int i = 0; i < 3; ++i) {
        const double term = double{normal_[i]} * (p[i] - double{origin_[i]});
        sum += term, size += std::abs(term);
      }
      const double error = 0x1p-40 * size; // seven roundings of 2^-53
      low = is_first || sum - error < low ? sum - error : low;
      high = is_first || sum + error > high ? sum + error : high;
      across = std::fmax(across, size);
    };
    include(s, true);
    include(t, false);
    for (std::size_t i = 0; i < star.valence; ++i)
      include(star.link[i], false);
    is_thin_ = high - low < across / 8 && across > 0x1p-100 && across < 0x1p+100;
    low_ = -float_above(-low), high_ = float_above(high);
  }

  /// Whether it is much thinner than a box around the points.
  bool is_thin() const { return is_thin_; }

  /// Bit j is 0 only if box j of the node lies on one side of the slab.
  unsigned meeting(const Box_node& node) const {
    static constexpr int bits[8] = {1, 2, 4, 8, 16, 32, 64, 128};
    float least[8] = {}, most[8] = {}, size[8] = {};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 8; ++j) {
        const float a = (node.bounds[i][j] - origin_[i]) * normal_[i],
                    b = (node.bounds[i + 3][j] - origin_[i]) * normal_[i];
        const float small = a < b ? a : b, large = a < b ? b : a;
        least[j] += small, most[j] += large;
        size[j] += std::abs(a) + std::abs(b);
      }
    int mask = 0;
    for (int j = 0; j < 8; ++j) {
      const float error = 0x1p-19f * size[j] + least_error;
      mask |= ((least[j] - error > high_) | (most[j] + error < low_)) ? 0 : bits[j];
    }
    return static_cast<unsigned>(mask);
  }

private:
  static constexpr double least_size = 0x1p-200, largest_extent = 0x1p+100;
  static constexpr float least_error =
      0x1p-120f; ///< more than products lose that underflow; far below any thickness there is

  float origin_[3] = {}, normal_[3] = {}, low_ = 0, high_ = 0;
  bool is_thin_ = false;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
