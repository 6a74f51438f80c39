// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Invalid_parameter.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>

namespace haptic_sculpt::internal {

/// The way of a translation, or of a rotation by less than half a turn, told by a matrix: straight, or along arcs.
class Rigid_way {
public:
  /// \param linear its rows \throw Invalid_parameter where it is something else
  explicit Rigid_way(const std::array<Vector, 3>& linear) {
    bool is_rigid = dot(cross(linear[0], linear[1]), linear[2]) > 0;
    for (int i = 0; i < 3; ++i) // the matrix times the transposed is the identity; false for what is not a number
      for (int j = 0; j < 3; ++j)
        is_rigid = is_rigid && std::abs(dot(linear[i], linear[j]) - (i == j ? 1 : 0)) <= rigidity;
    if (!is_rigid)
      refuse("it does not keep lengths, or mirrors");
    const Vector turning{(linear[2][1] - linear[1][2]) / 2, (linear[0][2] - linear[2][0]) / 2,
                         (linear[1][0] - linear[0][1]) / 2}; // the axis times the sine of the angle
    sine_ = length(turning);
    const double cosine = (linear[0][0] + linear[1][1] + linear[2][2] - 1) / 2;
    if (cosine < 0 && sine_ <= rigidity)
      refuse("it is half a turn, of which nobody knows which way round; make it of two quarters");
    angle_ = std::atan2(sine_, cosine);
    axis_ = normalized(cosine < 0 ? from_symmetric_part(linear, cosine, turning) : turning);
  }

  /// \param shift where the origin goes \param size the largest coordinate of what moves, on the way: what rounding
  /// leaves of a shift grows with it, as in a product of a rotation and two translations that are each other's inverse
  /// \throw Invalid_parameter for a screw
  void check_shift(const Vector& shift, double size) const {
    const double unit = unit_of(std::fmax(size, largest_magnitude(shift)));
    // The axis is known the better the larger the angle is; of next to none each direction is one.
    if (std::abs(dot(axis_, scaled(shift, unit))) * sine_ > 2 * rigidity)
      refuse("it shifts along the axis of its rotation; make it of a rotation and a translation");
  }

  /// What is left of a displacement that the whole way makes of it, at a share of the way: the chord of a part of an
  /// arc is shorter than that of the arc, and turned against it by half of what is missing. Rounded. \param share in
  /// [0, 1]
  Vector at(double share, const Vector& whole) const {
    if (angle_ < straight)
      return scaled(whole, share);
    const double ratio = std::sin(share * angle_ / 2) / std::sin(angle_ / 2), turn = (share - 1) * angle_ / 2;
    const Vector along = scaled(axis_, dot(axis_, whole)), across = minus(whole, along);
    const Vector turned = plus(scaled(across, std::cos(turn)), scaled(cross(axis_, across), std::sin(turn)));
    return plus(scaled(turned, ratio), scaled(along, share));
  }

  /// By how much sums of products of the entries of a matrix that are 0 or 1 for a rotation may differ from these: some
  /// thousand times what rounding leaves, for matrices that are products of others; and far less than anyone sees.
  static constexpr double rigidity = 0x1p-40;
  /// Rad. An arc of less is straight to far more than a double's places; quotients of subnormal sines are not shares.
  static constexpr double straight = 0x1p-500;

private:
  double angle_, sine_;
  Vector axis_; ///< of length 1, or zero

  [[noreturn]] static void refuse(const char* why) {
    throw Invalid_parameter(
        std::string("a rigid motion must be a translation, or a rotation by less than half a turn: ") + why);
  }

  /// Near half a turn the sine says too little: (R + R^T) / 2 = cosine I + (1 - cosine) u u^T.
  static Vector from_symmetric_part(const std::array<Vector, 3>& linear, double cosine, const Vector& turning) {
    int i = 0;
    for (int k = 1; k < 3; ++k)
      i = linear[k][k] > linear[i][i] ? k : i;
    Vector u;
    for (int k = 0; k < 3; ++k)
      u[k] = (linear[i][k] + linear[k][i]) / 2 - (k == i ? cosine : 0);
    return dot(u, turning) < 0 ? scaled(u, -1) : u;
  }
};

} // namespace haptic_sculpt::internal
