// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/culling/Outcodes.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/Box_3.h>


namespace haptic_sculpt::internal {

/// Planes about some consecutive faces of a star, which part many pairs of a moving and a still feature at once.
///
/// For each plane it says of every still point on which side of what moves it certainly lies, if on any: 64 sides of
/// a point are one number. A still edge or face all of whose corners lie on one side of a plane, beyond what a moving
/// feature sweeps over, is apart from that, which is one comparison of numbers. Whatever direction a plane has, that
/// holds: what is swept over is measured along it, and roundings are taken off. (doc/proofs/culling.md)
///
/// There is one plane along each spoke, which tells the sectors of the star apart; one along each edge of the link, for
/// what lies beyond it; and the sides of a box. Points are given relative to the start of the motion, rounded once.
class Separating_planes {
public:
  /// Which sides of planes: two bits a plane.
  using Outcode = Outcodes::Outcode;

  /// This many faces, with as many spokes or one more, and the box have sides that fit in a number.
  static constexpr std::size_t most_faces = 14;

  /// \param way from the start of the motion to its end \param spokes ends of the spokes \param first,last the faces
  /// [first, last) of the star, most_faces at most \param reach bounds the magnitude of all coordinates given, here and
  /// later \param margin what is no farther than this (rounded) is not apart, either \param box around all that moves,
  /// relative to the start like all else, each of its coordinates rounded once, and with the margin
  void assign(const Vector& way, const std::vector<Vector>& spokes, std::size_t first, std::size_t last, double reach,
              double margin, const Box_3& box) {
    box_ = box;
    first_ = first;
    size_ = 0;
    const std::size_t faces = last - first;
    const bool is_whole = faces == spokes.size();
    const std::size_t ends = is_whole ? faces : faces + 1;
    edges_.fill(box_sides);
    vertex_ = box_sides;
    faces_are_closed_ = is_whole;
    ends_ = ends;
    if (!Outcodes::serve(reach))
      return;
    const auto spoke = [&](std::size_t k) -> const Vector& {
      return spokes[first + k < spokes.size() ? first + k : first + k - spokes.size()];
    };
    Vector up{}, middle{};
    double length = 0;
    for (std::size_t k = 0; k < faces; ++k) {
      up = plus(up, quick_cross(spoke(k), spoke(k + 1)));
      middle = plus(middle, spoke(k));
      length = larger(length, quick_magnitude(spoke(k)));
    }
    // A long way, or a star like a spike, is a cone: its sides go to its tip. Else they stand upright.
    const bool is_long = quick_magnitude(way) > length;
    const bool is_spike = 2 * quick_magnitude(middle) > static_cast<double>(faces) * length;
    const Vector axis = is_long ? way : up, tip = is_long ? way : Vector{};
    const double beyond = Outcodes::slack(reach, longest_normal, margin);
    std::array<double, most_faces + 1> heights;
    for (std::size_t k = 0; k < ends + faces; ++k) {
      const bool is_spoke = k < ends;
      const std::size_t at = is_spoke ? k : k - ends, other = is_spoke ? at : is_whole && at + 1 == ends ? 0 : at + 1;
      const Vector along = is_spoke ? spoke(at) : minus(spoke(other), spoke(at));
      const Vector n = of_size_one(
          quick_cross(along, is_spoke || !(is_long || is_spike) ? axis : minus(tip, spoke(at))));
      for (std::size_t j = 0; j < ends; ++j)
        heights[j] = quick_dot(n, spoke(j));
      const double height_of_way = quick_dot(n, way);
      const double low = smaller(smaller(0, height_of_way), smaller(heights[at], heights[other])),
                   high = larger(larger(0, height_of_way), larger(heights[at], heights[other]));
      const Outcode below = side_below(k), above = below << 1;
      for (std::size_t j = 0; j < ends; ++j)
        edges_[j] |= (heights[j] >= low ? below : 0) | (heights[j] <= high ? above : 0);
      normals_[k] = n;
      lows_[k] = low - beyond;
      highs_[k] = high + beyond;
    }
    size_ = ends + faces;
    for (std::size_t j = 0; j < ends; ++j)
      vertex_ |= edges_[j]; // each plane has on both of its sides what it is about
  }

  /// Finds the sides of all points.
  void compare(Outcodes& points) const {
    points.compare(box_);
    for (std::size_t k = 0; k < size_; ++k)
      points.compare(normals_[k], lows_[k], side_below(k), highs_[k], side_below(k) << 1);
  }

  /// The sides that lie beyond what the moving vertex, the edge to link vertex i, and face i sweep over.
  Outcode beyond_vertex() const { return vertex_; }
  Outcode beyond_edge(std::size_t i) const { return edges_[i - first_]; }
  Outcode beyond_face(std::size_t i) const {
    const std::size_t k = i - first_;
    return edges_[k] & edges_[faces_are_closed_ && k + 1 == ends_ ? 0 : k + 1];
  }

private:
  static constexpr int box_bits = 6;
  static constexpr Outcode box_sides = (Outcode{1} << box_bits) - 1;
  static constexpr Outcode side_below(std::size_t k) { return Outcode{1} << (box_bits + 2 * k); }
  static constexpr double longest_normal = 2; ///< coordinates are at most 1

  Box_3 box_;
  std::size_t first_ = 0, size_ = 0, ends_ = 0;
  bool faces_are_closed_ = false;
  std::array<Vector, 2 * most_faces + 1> normals_;
  std::array<double, 2 * most_faces + 1> lows_, highs_;
  std::array<Outcode, most_faces + 1> edges_;
  Outcode vertex_ = box_sides;
};

} // namespace haptic_sculpt::internal
