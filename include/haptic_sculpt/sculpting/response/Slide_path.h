// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <algorithm>
#include <array>

namespace haptic_sculpt::internal {

/// The legs a vertex has made in one drag: a polyline, each segment of which is proven free. Plain data.
class Slide_path {
public:
  /// One drag makes at most this many legs. Rough terrain leaves 0.6 % of drags unfinished with 16.
  static constexpr int most_legs = 32;

  explicit Slide_path(const Vector& source = {}) { points_[0] = source; }

  int legs() const { return legs_; }
  const Vector& end() const { return points_[legs_]; }
  /// Where leg i begins, and leg i - 1 ends. \pre 0 <= i <= legs()
  const Vector& point(int i) const { return points_[i]; }

  /// \pre legs() < most_legs, and the way from end() to there is free
  void add(const Vector& point) { points_[++legs_] = point; }

  Slide_path& operator=(const Slide_path& other) {
    legs_ = other.legs_;
    std::copy_n(other.points_.begin(), legs_ + 1, points_.begin());
    return *this;
  }
  Slide_path(const Slide_path& other) { *this = other; }

  /// What is tried in the place of many legs.
  enum class Ways { straight, straight_and_bent };

  /// Puts one leg or two in the place of many, between the same two points, wherever those are free: round a finely cut
  /// surface the way found is one of many legs, a facet each, and not the only one. From each point on, the farthest
  /// ones are tried first, and half as far and so on. Bent ways, of two legs, pass the middle of what they replace, or
  /// above it, away from the target. The path begins and ends where it did. Returns whether there are fewer legs now.
  /// \param is_free(a, b) whether the straight way from a to b is free; every leg that is new has been asked
  ///        for. Called about a hundred times at most for straight ways, four hundred times for bent ones too
  /// \param enough no more is tried once this few legs are left
  template <class Is_free>
  bool shorten(const Vector& target, const Is_free& is_free, Ways ways, int enough = 1) {
    const std::array<Vector, most_legs + 1> old = points_;
    const int before = legs_;
    legs_ = 0;
    for (int i = 0; i < before;) {
      int next = i + 1;
      const bool is_enough = legs_ + before - i <= enough;
      for (int j = before; !is_enough && j > i + 1 && next == i + 1; j = i + (j - i) / 2) {
        if (is_free(old[i], old[j])) {
          next = j;
          break;
        }
        if (ways == Ways::straight || j - i < least_bent)
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

} // namespace haptic_sculpt::internal
