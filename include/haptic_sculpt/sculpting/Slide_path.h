// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SLIDE_PATH_H
#define HAPTIC_SCULPT_SCULPTING_SLIDE_PATH_H

#include <haptic_sculpt/sculpting/vector_3.h>

#include <algorithm>
#include <array>

namespace haptic_sculpt {
namespace internal {

/// The legs a vertex has made in one drag: a polyline, each segment of which is proven free. Plain data.
class Slide_path {
public:
  /// One drag makes at most so many legs. Rough terrain leaves 0.6 % of drags unfinished with 16 (RULES 4).
  static constexpr int most_legs = 32;

  explicit Slide_path(const Vector& source = {}) { points_[0] = source; }

  int legs() const { return legs_; }
  const Vector& end() const { return points_[legs_]; }

  /// \pre legs() < most_legs, and the way from end() to there is free
  void add(const Vector& point) { points_[++legs_] = point; }

  Slide_path& operator=(const Slide_path& other) {
    legs_ = other.legs_;
    std::copy_n(other.points_.begin(), legs_ + 1, points_.begin());
    return *this;
  }
  Slide_path(const Slide_path& other) { *this = other; }

  /// Puts one or two legs in place of many, between the same ends, wherever those are free: round a finely cut surface
  /// the way found is one of many legs, a facet each, and not the only one. Ways of two legs pass the middle of what they
  /// replace, or above it, away from the target. Returns whether there are fewer now.
  /// \param is_free(a, b) whether the straight way from a to b is free; called some hundred times at most
  template <class Is_free>
  bool shorten(const Vector& target, const Is_free& is_free) {
    std::array<Vector, most_legs + 1> old = points_;
    const int before = legs_;
    legs_ = 0;
    for (int i = 0; i < before;) {
      int next = i + 1;
      for (int j = before; j > i + 1 && next == i + 1; j = i + (j - i) / 2) {
        if (is_free(old[i], old[j])) {
          next = j;
          break;
        }
        if (j - i < least_bent)
          continue;
        const Vector& middle = old[i + (j - i) / 2];
        const Vector up = normalized(minus(middle, target));
        const double way = length(minus(old[j], old[i]));
        for (const double rise : rises) {
          const Vector above = advanced(middle, rise * way, up);
          if (is_free(old[i], above) && is_free(above, old[j])) {
            add(above);
            next = j;
            break;
          }
        }
      }
      add(old[next]);
      i = next;
    }
    return legs_ < before;
  }

private:
  /// Fewer legs are not replaced by two, and how far above their middle these pass, in lengths of the way.
  static constexpr int least_bent = 4;
  static constexpr std::array<double, 4> rises = {0, 0x1p-6, 0x1p-4, 0x1p-2};

  int legs_ = 0;
  std::array<Vector, most_legs + 1> points_;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
