// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/culling/Outcodes.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <cstddef>
#include <vector>

namespace haptic_sculpt::internal {

/// What some consecutive faces of a star sweep over, to tell fast what is certainly apart from it.
///
/// Boxes cannot part the faces of a star from each other's surroundings: all of them hold the vertex in the middle.
/// Planes can that stand at the first and the last spoke of the fan. Whatever direction n a plane has, a set with n . q
/// > max n . p over the fan's corners is apart from it; roundings of both sides are taken off. So nothing is decided
/// here that is not certain.
///
/// Points are given relative to the start of the motion, rounded once.
class Swept_fan {
public:
  /// No plane: nothing is known to be apart.
  Swept_fan() = default;

  /// \param way from the start of the motion to its end \param spokes ends of the spokes
  /// \param first,last the faces [first, last) of the star \param reach bounds the magnitude of all coordinates given,
  /// here and later \param margin what is no farther than this (rounded) is not apart, either
  /// \param ends whether there are planes at the first and at the last spoke
  /// Cost: linear in the number of faces.
  Swept_fan(const Vector& way, const std::vector<Vector>& spokes, std::size_t first, std::size_t last, double reach,
            double margin = 0, std::array<bool, 2> ends = {true, true}) {
    if (!Outcodes::serve(reach))
      return;
    const auto spoke = [&](std::size_t i) -> const Vector& { return spokes[i < spokes.size() ? i : 0]; };
    Vector up{};
    for (std::size_t i = first; i < last; ++i)
      up = plus(up, quick_cross(spoke(i), spoke(i + 1)));
    up = of_size_one(up);
    if (ends[0])
      planes_at(spoke(first), way, up, 1);
    if (ends[1])
      planes_at(spoke(last), way, up, -1);
    const double beyond = Outcodes::slack(reach, longest_normal, margin);
    for (std::size_t k = 0; k < size_; ++k) {
      double highest = larger(0.0, quick_dot(normals_[k], way));
      for (std::size_t i = first; i <= last; ++i)
        highest = larger(highest, quick_dot(normals_[k], spoke(i)));
      levels_[k] = highest + beyond;
    }
  }

  /// This many fans have sides that fit in a number: one bit of each quarter a fan.
  static constexpr std::size_t most_fans = 16;

  /// Adds to the sides of the points on the far side of which planes they certainly lie. All points of a set on the far
  /// side of one plane: the set, and its hull, is certainly apart from the fan. \param fan the number of this one
  /// \pre sides of these points were set
  void compare(Outcodes& points, std::size_t fan = 0) const {
    for (std::size_t k = 0; k < size_; k += 2) {
      const Outcodes::Outcode side = Outcodes::Outcode{1} << (most_fans * k + fan);
      points.compare(normals_[k], levels_[k], side, normals_[k + 1], levels_[k + 1], side << most_fans);
    }
  }

  /// The numbers of the fans, a bit each, from which something is apart all of whose corners lie on these sides.
  static unsigned apart_from_fans(Outcodes::Outcode sides) {
    sides |= sides >> 32;
    return static_cast<unsigned>(sides | sides >> 16) & 0xffff;
  }

  /// About `side * up`, turned so that neither end of the way is higher than the spoke's.
  static Vector leaning(const Vector& spoke, const Vector& way, const Vector& up, double side) {
    const Vector from_start = scaled(upright_to(up, spoke), side);
    if (quick_dot(from_start, way) <= 0)
      return from_start;
    const Vector from_end = scaled(upright_to(up, minus(spoke, way)), side);
    if (quick_dot(from_end, spoke) >= 0)
      return from_end;
    const Vector swept = quick_cross(spoke, way); // normal to what the spoke sweeps over
    return quick_dot(swept, up) * side < 0 ? scaled(swept, -1) : swept;
  }

private:
  /// How far planes lean over or under the fan. Any value serves; 1 is neither flat nor steep.
  static constexpr double lean = 1;

  /// Of the length: coordinates are at most 1 + lean.
  static constexpr double longest_normal = 3.5;

  std::size_t size_ = 0;
  std::array<Vector, 4> normals_;
  std::array<double, 4> levels_; ///< of normals 0: nothing is higher

  /// Two planes through the end of the first or last spoke, with both ends of the way below: one leans under the fan,
  /// one over it. \param turn 1: the fan lies counterclockwise of the spoke about `up`; -1: clockwise
  void planes_at(const Vector& spoke, const Vector& way, const Vector& up, double turn) {
    Vector upright = scaled(quick_cross(spoke, up), turn);
    if (quick_dot(upright, way) > 0)
      upright = scaled(quick_cross(minus(spoke, way), up), turn);
    upright = of_size_one(upright);
    for (const double side : {-1.0, 1.0})
      normals_[size_++] = quick_sum(upright, lean, of_size_one(leaning(spoke, way, up, side)));
  }

  /// What of a is normal to b.
  static Vector upright_to(const Vector& a, const Vector& b) {
    const double square = quick_dot(b, b);
    return square > 0 ? quick_sum(a, -quick_dot(a, b) / square, b) : a;
  }
};

} // namespace haptic_sculpt::internal
