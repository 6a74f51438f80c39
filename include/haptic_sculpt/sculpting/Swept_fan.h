// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SWEPT_FAN_H
#define HAPTIC_SCULPT_SCULPTING_SWEPT_FAN_H

#include <haptic_sculpt/sculpting/vector_3.h>
#include <haptic_sculpt/surface/star.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace haptic_sculpt {
namespace internal {

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
  /// Motions in whose surroundings coordinates reach less or more than this get no planes: products might leave the
  /// range of doubles.
  static constexpr double least_reach = 0x1p-200, largest_reach = 0x1p+200;

  /// No plane: nothing is known to be apart.
  Swept_fan() = default;

  /// \param way from the start of the motion to its end \param spokes ends of the spokes
  /// \param first,last the faces [first, last) of the star \param reach bounds the magnitude of all coordinates given,
  /// here and later \param margin what is no farther than this (rounded) is not apart, either Cost: linear in the
  /// number of faces.
  Swept_fan(const Vector& way, const std::vector<Vector>& spokes, std::size_t first, std::size_t last, double reach,
            double margin = 0) {
    if (!(reach > least_reach && reach < largest_reach))
      return;
    const auto spoke = [&](std::size_t i) -> const Vector& { return spokes[i < spokes.size() ? i : 0]; };
    Vector up{};
    for (std::size_t i = first; i < last; ++i)
      up = plus(up, product(spoke(i), spoke(i + 1)));
    up = of_size_one(up);
    planes_at(spoke(first), way, up, 1, 0);
    planes_at(spoke(last), way, up, -1, 2);
    for (std::size_t k = 0; k < normals_.size(); ++k) {
      double highest = std::fmax(0.0, product_sum(normals_[k], way));
      for (std::size_t i = first; i <= last; ++i)
        highest = std::fmax(highest, product_sum(normals_[k], spoke(i)));
      levels_[k] = highest + rounding * reach + longest_normal * margin;
    }
  }

  /// Whether the point, or the whole segment, is certainly apart from the fan. False says nothing.
  bool is_apart(const Vector& p) const { return is_apart(p, p); }
  bool is_apart(const Vector& p, const Vector& q) const {
    for (std::size_t k = 0; k < normals_.size(); ++k)
      if (product_sum(normals_[k], p) > levels_[k] && product_sum(normals_[k], q) > levels_[k])
        return true;
    return false;
  }

private:
  /// 2^-45: more than ten times what two sums of three products with a direction, whose coordinates are at most 1 +
  /// lean, and a difference rounded once can be wrong together.
  static constexpr double rounding = 0x1p-45;

  /// How far planes lean over or under the fan. Any value serves; 1 is neither flat nor steep.
  static constexpr double lean = 1;

  /// Of the length: coordinates are at most 1 + lean.
  static constexpr double longest_normal = 3.5;

  std::array<Vector, 4> normals_{};
  std::array<double, 4> levels_{}; // of normals 0: nothing is higher

  /// Two planes through the end of the first or last spoke, with both ends of the way below: one leans under the fan,
  /// one over it. \param turn 1: the fan lies counterclockwise of the spoke about `up`; -1: clockwise
  void planes_at(const Vector& spoke, const Vector& way, const Vector& up, double turn, std::size_t k) {
    Vector upright = scaled(product(spoke, up), turn);
    if (product_sum(upright, way) > 0)
      upright = scaled(product(minus(spoke, way), up), turn);
    upright = of_size_one(upright);
    normals_[k] = advanced_plainly(upright, lean, of_size_one(leaning(spoke, way, up, -1)));
    normals_[k + 1] = advanced_plainly(upright, lean, of_size_one(leaning(spoke, way, up, 1)));
  }

  /// About `side * up`, turned so that neither end of the way is higher than the spoke's.
  static Vector leaning(const Vector& spoke, const Vector& way, const Vector& up, double side) {
    const Vector from_start = scaled(upright_to(up, spoke), side);
    if (product_sum(from_start, way) <= 0)
      return from_start;
    const Vector from_end = scaled(upright_to(up, minus(spoke, way)), side);
    if (product_sum(from_end, spoke) >= 0)
      return from_end;
    const Vector swept = product(spoke, way); // normal to what the spoke sweeps over
    return product_sum(swept, up) * side < 0 ? scaled(swept, -1) : swept;
  }

  /// What of a is normal to b.
  static Vector upright_to(const Vector& a, const Vector& b) {
    const double square = product_sum(b, b);
    return square > 0 ? advanced_plainly(a, -product_sum(a, b) / square, b) : a;
  }

  // Not fused, which calls a function where the machine has no such instruction: what is fast counts here, and both are
  // within the bound.
  static double product_sum(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector product(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Vector advanced_plainly(const Vector& a, double factor, const Vector& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
  }
  /// Largest coordinate 1; zero, a plane that parts nothing, for what is so small that its reciprocal is not a number.
  static Vector of_size_one(const Vector& a) {
    constexpr double least_size = 0x1p-1000;
    const double size = largest_magnitude(a);
    return size > least_size ? scaled(a, 1 / size) : Vector{};
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
