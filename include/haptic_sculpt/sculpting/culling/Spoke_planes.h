// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/culling/Swept_fan.h>

#include <algorithm>

namespace haptic_sculpt::internal {

/// Planes at the ends of some consecutive spokes of a large star, which part each spoke and each face from what lies
/// beside it, under and over its neighbours too.
///
/// At each spoke's end there are four, as in Swept_fan: beyond each lies what is to one side of the spoke, and either
/// under or over the fan. How far a point is under or over the fan is measured once for all spokes, so a plane costs
/// half a product sum a point. Each plane has a bit of its own spoke, so what is apart from which spokes takes a few
/// operations for all of them. (doc/proofs/culling.md)
///
/// Points are given relative to the start of the motion, rounded once.
class Spoke_planes {
public:
  using Outcode = Outcodes::Outcode;

  /// This many faces have one spoke more, each with a bit in each quarter of a number.
  static constexpr std::size_t most_faces = 15;

  /// Like Swept_fan's. \pre last - first <= most_faces, and that is less than the number of spokes
  void assign(const Vector& way, const std::vector<Vector>& spokes, std::size_t first, std::size_t last, double reach,
              double margin) {
    size_ = 0;
    if (!Outcodes::serve(reach))
      return;
    const std::size_t n = spokes.size(), faces = last - first;
    const auto spoke = [&](std::size_t i) -> const Vector& { return spokes[i < n ? i : i - n]; };
    Vector up{};
    for (std::size_t i = first; i < last; ++i)
      up = plus(up, quick_cross(spoke(i), spoke(i + 1)));
    up = of_size_one(up);
    for (std::size_t side = 0; side < 2; ++side)
      leans_[side] =
          scaled(of_size_one(Swept_fan::leaning(spoke(first + faces / 2), way, up, side == 0 ? -1 : 1)), lean);
    const double beyond = Outcodes::slack(reach, longest_normal, margin);
    size_ = faces + 1;
    for (std::size_t k = 0; k < size_; ++k) {
      const Vector& end = spoke(first + k);
      for (std::size_t turn = 0; turn < 2; ++turn) {
        const Vector& neighbour = spoke(turn == 0 ? first + k + n - 1 : first + k + 1);
        Plane& plane = planes_[2 * k + turn];
        plane.normal = beside(end, way, turn == 0 ? up : scaled(up, -1));
        for (std::size_t side = 0; side < 2; ++side) {
          const auto height = [&](const Vector& p) { return quick_dot(plane.normal, p) + quick_dot(leans_[side], p); };
          plane.levels[side] = larger(larger(0.0, height(way)), larger(height(end), height(neighbour))) + beyond;
        }
      }
    }
  }

  /// Makes room for this many points.
  void reserve(std::size_t points) {
    for (std::vector<double>& heights : heights_)
      heights.resize(std::max(heights.size(), points));
  }
  /// Finds the sides of all points.
  void compare(Outcodes& points) {
    points.clear();
    if (size_ == 0)
      return;
    for (std::size_t side = 0; side < 2; ++side)
      points.find_heights(leans_[side], heights_[side]);
    for (std::size_t k = 0; k < size_; ++k)
      for (std::size_t turn = 0; turn < 2; ++turn) {
        const Plane& plane = planes_[2 * k + turn];
        const Outcode under = Outcode{1} << (32 * turn + k);
        points.compare(plane.normal, heights_[0], plane.levels[0], under, heights_[1], plane.levels[1], under << 16);
      }
  }

  /// Of which spokes or faces, counted from the first, something is apart all of whose corners lie on these sides.
  static unsigned apart_from_spokes(Outcode sides) {
    const unsigned after = beyond_after(sides), before = beyond_before(sides);
    return after | after >> 1 | before | before << 1;
  }
  static unsigned apart_from_faces(Outcode sides) { return beyond_after(sides) >> 1 | beyond_before(sides); }

private:
  // Bit k of the first and second quarter of a number: after spoke k, and so beyond spokes k - 1 and k; of the third
  // and fourth: before spoke k, and so beyond k and k + 1.
  static unsigned beyond_after(Outcode sides) { return static_cast<unsigned>(sides | sides >> 16) & 0xffff; }
  static unsigned beyond_before(Outcode sides) { return static_cast<unsigned>(sides >> 32 | sides >> 48); }

  /// Of the sum of two directions with coordinates of at most 1 and `lean`.
  static constexpr double longest_normal = 2.25;

  /// How far planes lean: little, for what is under or over the middle of the fan leans with the angle between the
  /// spokes.
  static constexpr double lean = 0.25;

  struct Plane {
    Vector normal;
    std::array<double, 2> levels; ///< of the sums with the two leans
  };

  std::size_t size_ = 0;
  std::array<Vector, 2> leans_; ///< under and over the fan
  std::array<Plane, 2 * most_faces + 2> planes_;
  std::array<std::vector<double>, 2> heights_; ///< of the points along those

  /// Across the spoke, with both ends of the way below. \param up the fan's, or its opposite for the other side
  static Vector beside(const Vector& spoke, const Vector& way, const Vector& up) {
    const Vector from_start = quick_cross(up, spoke);
    return of_size_one(quick_dot(from_start, way) > 0 ? quick_cross(up, minus(spoke, way)) : from_start);
  }
};

} // namespace haptic_sculpt::internal
