// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Star_impact.h>
#include <haptic_sculpt/sculpting/culling/Star_runs.h>
#include <haptic_sculpt/sculpting/geometry/separation.h>

namespace haptic_sculpt::internal {

/// The free ball: how far apart the features of a star and its candidates are with the moving vertex J in one
/// place, the centre. A motion of J between two points nowhere farther than r from there can make only pairs touch that
/// are at most r apart.
///
/// A point of the star is (1 - t) J + t B with B fixed on the link, so it is nowhere farther from where it was than J
/// is. Distances are bounded from below by separating planes, with all roundings taken off; so what is left out is
/// proven free, not guessed. Near a contact a few pairs are left to be swept, elsewhere none.
/// (doc/proofs/culling.md, with the proof)
template <class Mesh>
class Near_pairs {
public:
  using Coordinates = std::array<double, 3>;

  /// A moving and a still feature.
  struct Pair {
    double
        square; ///< J has to go that far from the centre, squared, before they can touch, in units; 0: nothing is known
    Impact_feature feature;
    std::uint32_t spoke;     ///< which face or edge of the star; unless J itself moves against a face
    std::uint32_t candidate; ///< which face, edge or vertex of the candidates
  };

  Near_pairs() { pairs_.reserve(2 * most_pairs); }

  void clear() {
    square_ = -1;
    pairs_.clear();
  }

  /// Whether the straight motion between these points is covered. The ball is convex: both ends in it suffice.
  bool cover(const Coordinates& p, const Coordinates& q) const { return farther(p, q) < square_; }

  /// Calls `function(pair)` for all pairs that may touch in this motion, until it returns false; returns whether it
  /// never did. \pre cover(p, q)
  template <class Function>
  bool for_each_near(const Coordinates& p, const Coordinates& q, const Function& function) const {
    const double square = farther(p, q);
    if (square < nearest_)
      return true;
    for (const Pair& pair : pairs_)
      if (!(square < pair.square) && !function(pair))
        return false;
    return true;
  }

  /// Takes pairs around a place a little ahead on the way from source to target. Covers that motion afterwards, or
  /// nothing: where it is long, or there are many pairs, or sizes are extreme. \pre the list is complete in its region,
  /// which the motion does not leave. Cost: n log n, as a motion is decided.
  void assign(const Star<Mesh>& star, const Candidate_list<Mesh>& list, Star_runs<Mesh>& runs,
              const Coordinates& source, const Coordinates& target) {
    clear();
    double extent = 0, around = 0;
    for (std::size_t i = 0; i < star.valence(); ++i)
      extent = larger(extent, quick_magnitude(minus(star.link_points[i], source)));
    unit_ = extent > least_plain && extent < largest_plain ? 1 : unit_of(extent);
    extent *= unit_;
    for (std::size_t i = 0; i < star.valence(); ++i) {
      const Vector edge = scaled(minus(star.link_points[star.next(i)], star.link_points[i]), unit_);
      around += std::sqrt(quick_dot(edge, edge));
    }
    radius_ = widest * smaller(extent, around / static_cast<double>(star.valence()));
    const Vector way = minus(target, source), scaled_way = scaled(way, unit_);
    const double length = std::sqrt(quick_dot(scaled_way, scaled_way));
    if (!(extent > least_extent && length > 0 && length <= longest * radius_))
      return;
    centre_ = quick_sum(source, larger(0.5, ahead * radius_ / length), way);
    for (int i = 0; i < 3; ++i) // the link stays; only J can leave the region
      radius_ = smaller(
          radius_, smaller(centre_[i] - list.region().lower[i], list.region().upper[i] - centre_[i]) * unit_);
    // What stands still may reach far beyond the star: products with it round by as much more.
    double reach = 0;
    for (const auto& vertex : list.vertices())
      reach = larger(reach, quick_magnitude(minus(vertex.point, centre_)));
    reach = larger(extent, reach * unit_);
    error_ = rounding * (reach + radius_ + quick_magnitude(centre_) * unit_);
    const double r = safe(radius_);
    if (!(reach < largest_extent && farther(source, target) < r * r))
      return;
    faces(list);
    Star_motion at_centre(centre_, centre_);
    const auto are_few = [&] { return pairs_.size() <= most_pairs; };
    runs.for_each_run(star, list, at_centre, radius_ / unit_, [&](const auto& run) {
      return run.for_each_edge_pair([&](std::size_t i, std::uint32_t e) {
        return edge(star, list, i, e), are_few();
      }) && run.for_each_vertex_pair([&](std::size_t i, std::uint32_t v) {
        return vertex(star, list, i, v), are_few();
      });
    });
    if (!are_few())
      return clear();
    square_ = r * r;
    nearest_ = square_;
    for (const Pair& pair : pairs_)
      nearest_ = smaller(nearest_, pair.square);
  }

private:

  /// 2^-40: a thousand times what the some twenty roundings of a bound or a comparison, each of 2^-53, can make.
  static constexpr double rounding = 0x1p-40;
  /// Stars smaller or larger than these are measured in a unit of their own: squares of squares might leave the range
  /// of doubles.
  static constexpr double least_plain = 0x1p-100, largest_plain = 0x1p+100;
  /// In units, stars smaller or surroundings larger than these get no pairs.
  static constexpr double least_extent = 0x1p-200, largest_extent = 0x1p+200;
  /// The radius, in the smaller of the star's extent and the mean edge of its link. A wider ball is left later, but the
  /// one motion that takes its pairs bounds more of them: at 0.75 the slowest motion in a thousand takes 1.7 times as
  /// long, the mean is the same.
  static constexpr double widest = 0.35;
  /// The centre is this many radii ahead, for a hand goes on in its direction; motions longer than `longest` radii are
  /// not worth it.
  static constexpr double ahead = 0.3, longest = 0.5;
  /// With more pairs than this (the surroundings are much finer than the star), to sweep by boxes costs less.
  static constexpr std::size_t most_pairs = 1024;

  Coordinates centre_{};
  double square_ = -1, nearest_ = -1; ///< the least of all squares
  double unit_ = 1;                ///< a power of two, by which lengths are multiplied
  double radius_ = 0, error_ = 0; ///< in units, like squares
  std::vector<Pair> pairs_;

  /// The square of the distance from the centre to the farther point.
  double farther(const Coordinates& p, const Coordinates& q) const {
    const Vector a = local(p), b = local(q);
    return larger(quick_dot(a, a), quick_dot(b, b));
  }

  /// A distance less what roundings can have added.
  double safe(double distance) const { return larger(0.0, distance * (1 - rounding) - error_); }

  /// Whether two boxes are the radius or more apart.
  bool are_far(const Box_3& a, const Box_3& b) const {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      const double gap = larger(0, larger(a.lower[i] - b.upper[i], b.lower[i] - a.upper[i]));
      square += (gap * unit_) * (gap * unit_);
    }
    return square >= radius_ * radius_;
  }

  void keep(double distance, Impact_feature feature, std::size_t spoke, std::size_t candidate) {
    const double r = safe(distance);
    if (distance < radius_)
      pairs_.push_back({r * r, feature, static_cast<std::uint32_t>(spoke), static_cast<std::uint32_t>(candidate)});
  }

  Vector local(const Coordinates& p) const { return scaled(minus(p, centre_), unit_); }

  void faces(const Candidate_list<Mesh>& list) {
    const Box_3 here(centre_);
    const auto& v = list.vertices();
    for (std::size_t f = 0; f < list.faces().size(); ++f) {
      const auto& face = list.faces()[f];
      if (are_far(list.box(face), here))
        continue;
      const std::array<Vector, 3> t = {local(v[face.vertices[0]].point), local(v[face.vertices[1]].point),
                                       local(v[face.vertices[2]].point)};
      keep(separation(std::array<Vector, 1>{Vector{}}, t,
                                scaled(nearest_to_origin(t), -1), error_),
           Impact_feature::vertex_face, 0, f);
    }
  }

  void edge(const Star<Mesh>& star, const Candidate_list<Mesh>& list, std::size_t i, std::uint32_t e) {
    const auto& edge = list.edges()[e];
    const auto &a = list.vertices()[edge[0]], &b = list.vertices()[edge[1]];
    if (are_far(list.box(edge), Box_3(centre_).include(star.link_points[i])))
      return;
    const std::array<Vector, 2> moving = {Vector{}, local(star.link_points[i])},
                                still = {local(a.point), local(b.point)};
    keep(separation(moving, still, between_segments(moving, still), error_),
         Impact_feature::edge_edge, i, e);
  }

  void vertex(const Star<Mesh>& star, const Candidate_list<Mesh>& list, std::size_t i, std::uint32_t v) {
    const std::size_t j = star.next(i);
    const auto& vertex = list.vertices()[v];
    if (are_far(Box_3(vertex.point), Box_3(centre_).include(star.link_points[i]).include(star.link_points[j])))
      return;
    const Vector p = local(vertex.point);
    const std::array<Vector, 3> face = {minus(Vector{}, p), minus(local(star.link_points[i]), p),
                                        minus(local(star.link_points[j]), p)};
    keep(separation(face, std::array<Vector, 1>{Vector{}}, nearest_to_origin(face), error_),
         Impact_feature::face_vertex, i, v);
  }
};

} // namespace haptic_sculpt::internal
