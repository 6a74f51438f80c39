// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/connectivity/star.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// A cheap proof that the motion of an ordinary star is free: its link, seen along some direction n, is a strictly
/// convex polygon, its centre stays strictly inside, and every other face nearby is beyond one of the walls that stand
/// on the link's edges along n.
///
/// The wall of link edge AB is the plane through AB along n; its normal n x AB points out, A to B being the order of
/// the link about the star. If all other link vertices, and both ends of the motion, are strictly inside of all walls,
/// then the star's triangles tile the polygon at all times, so the star is embedded and meets its link where it has to.
/// All of it is on the inner side of each wall, and on the wall itself there is only AB. So a face whose vertices are
/// strictly outside of a wall, but for those it shares with the wall's edge, meets the star only there.
///
/// n is taken as it was rounded; the wall of AB is the exact plane through AB along that n. `error_` bounds what
/// rounding can do to the side of a point, a hundred times over. Where nothing is proven, nothing is said: the sweeps
/// decide.
template <class Mesh>
class Convex_star {
public:
  using Vertex_index = typename Mesh::Vertex_index;

  /// Whether the star and the motion are of this kind. Cost: the square of the valence.
  bool assign(const Star<Mesh>& star, const Coordinates& source, const Coordinates& target) {
    star_ = &star;
    const std::size_t n = star.valence();
    if (n < 3 || n > most_walls)
      return false;
    origin_ = source;
    target_ = minus(target, source);
    along_ = Vector{};
    reach_ = quick_magnitude(target_);
    for (std::size_t i = 0; i < n; ++i) {
      link_[i] = minus(star.link_points[i], source);
      reach_ = larger(reach_, quick_magnitude(link_[i]));
    }
    unit_ = reach_ > least_plain && reach_ < largest_plain ? 1 : unit_of(reach_);
    if (unit_ != 1) {
      reach_ *= unit_;
      target_ = scaled(target_, unit_);
      for (std::size_t i = 0; i < n; ++i)
        link_[i] = scaled(link_[i], unit_);
    }
    for (std::size_t i = 0; i < n; ++i) // in the orientation of the mesh the link runs the other way round
      along_ = plus(along_, quick_cross(link_[star.next(i)], link_[i]));
    const double size = quick_magnitude(along_);
    // A side is a sum of products of at most 24 size reach^2 in all, and some twelve roundings of 2^-53 of that go into
    // it, those of the coordinates relative to the source included: less than 2^-44 size reach^2.
    error_ = 0x1p-36 * size * reach_ * reach_;
    if (!(reach_ > least_size && reach_ < largest_size && size > least_size))
      return false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = star.next(i);
      wall_[i] = quick_cross(along_, minus(link_[j], link_[i]));
      if (!(side(i, Vector{}) < -error_ && side(i, target_) < -error_))
        return false;
      for (std::size_t k = 0; k < n; ++k)
        if (k != i && k != j && !(side(i, link_[k]) < -error_))
          return false;
    }
    lowest_ = smaller(0, quick_dot(along_, target_)), highest_ = larger(0, quick_dot(along_, target_));
    for (std::size_t i = 0; i < n; ++i) {
      const double height = quick_dot(along_, link_[i]);
      lowest_ = smaller(lowest_, height), highest_ = larger(highest_, height);
    }
    return true;
  }

  /// Whether a face that is not of the star meets it, at all times of the motion, in nothing but what they share. False
  /// where that is not proven.
  bool is_apart(const Mesh& mesh, const std::array<Vertex_index, 3>& corners) const {
    constexpr std::size_t none = most_walls;
    const std::size_t n = star_->valence();
    std::array<std::size_t, 3> place; ///< in the link
    std::array<Vector, 3> p;
    int shared = 0;
    double far = reach_;
    for (int i = 0; i < 3; ++i) {
      place[i] = none;
      for (std::size_t k = 0; k < n; ++k)
        place[i] = star_->link[k] == corners[i] ? k : place[i];
      shared += place[i] != none;
      p[i] = scaled(minus(vertex_coordinates(mesh, corners[i]), origin_), unit_);
      far = larger(far, quick_magnitude(p[i]));
    }
    if (!(far < farthest))
      return false;
    const double error = error_ * (far / reach_);
    if (shared == 0) {
      // Two heights of twelve roundings each, and limits of three: 27 of 2^-53 of this product; these are 1024.
      const double slack = 0x1p-43 * quick_magnitude(along_) * far;
      const double a = quick_dot(along_, p[0]), b = quick_dot(along_, p[1]), c = quick_dot(along_, p[2]);
      if (smaller(a, smaller(b, c)) > highest_ + slack || larger(a, larger(b, c)) < lowest_ - slack)
        return true;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = star_->next(i);
      bool is_beyond = true;
      for (int k = 0; k < 3 && is_beyond; ++k)
        is_beyond = (place[k] != none && (place[k] == i || place[k] == j)) || side(i, p[k]) > error;
      if (is_beyond)
        return true;
    }
    return false;
  }

private:
  static constexpr std::size_t most_walls = 12;
  /// Stars smaller or larger than these are measured in a unit of their own.
  static constexpr double least_plain = 0x1p-100, largest_plain = 0x1p100;
  /// Within these no product here leaves the range of doubles, nor loses digits at its lower end.
  static constexpr double least_size = 0x1p-150, largest_size = 0x1p150, farthest = 0x1p200;

  const Star<Mesh>* star_ = nullptr;
  Coordinates origin_{};                 ///< the source; all else is relative to it
  double unit_ = 1;                      ///< a power of two, by which that is multiplied
  Vector target_{}, along_{};            ///< along_: n
  std::array<Vector, most_walls> link_, wall_;
  double reach_ = 0, error_ = 0, lowest_ = 0, highest_ = 0;

  /// Of a point from wall i; positive outside.
  double side(std::size_t i, const Vector& p) const { return quick_dot(wall_[i], minus(p, link_[i])); }
};

} // namespace haptic_sculpt::internal
