// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_FREE_BALL_H
#define HAPTIC_SCULPT_SCULPTING_FREE_BALL_H

#include <haptic_sculpt/sculpting/Checklist.h>
#include <haptic_sculpt/sculpting/vector_3.h>

namespace haptic_sculpt {

/// A ball around where a vertex J is in which nothing can stop it: every motion from a point of it to another is free.
///
/// When J is nowhere farther than r from the centre, no point of its star is farther than r from where it was with J in the centre:
/// a point of the star is (1 - t) J + t B with B fixed on the link. So the star touches nothing if each pair of the three sweeps is
/// more than r apart with J in the centre. Distances are bounded from below by separating planes, whatever direction n they
/// have: min n . p over one set less max n . q over the other, over |n|. What rounding can do to that is taken off. Thus a
/// motion inside is proven free, not guessed; of one that leaves the ball, the ball says nothing. (doc/performance.md)
template <class Mesh>
class Free_ball {
public:
  using Coordinates = std::array<double, 3>;

  void clear() {
    square_ = -1;
    spokes_left_ = 0;
  }

  /// Whether the straight motion between these points is certainly free. The ball is convex: both ends in it suffice.
  bool contains(const Coordinates& p, const Coordinates& q) const { return is_in(p, square_) && is_in(q, square_); }

  /// Begins a ball around the centre of the star, inside the region of the list; `go_on()` finishes it. Cost: the candidate faces.
  /// \pre the star is embedded with its centre at `centre`
  void begin(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& centre) {
    clear();
    centre_ = centre;
    double extent = 0;
    for (const Coordinates& p : star.link_points)
      extent = std::fmax(extent, internal::largest_magnitude(internal::minus(p, centre)));
    // What stands still may reach far beyond the star: products with it round by as much more.
    double reach = extent;
    for (const auto& vertex : list.vertices())
      reach = std::fmax(reach, internal::largest_magnitude(internal::minus(vertex.point, centre)));
    if (!(extent > least_extent && reach < largest_extent))
      return;
    error_ = rounding * (reach + internal::largest_magnitude(centre));
    // The link stays; only J can leave the region.
    radius_ = widest * extent;
    for (int i = 0; i < 3; ++i)
      radius_ = std::fmin(radius_, std::fmin(centre[i] - list.region().lower[i], list.region().upper[i] - centre[i]));
    faces(list);
    spokes_left_ = radius_ > error_ ? star.valence() : 0;
  }

  /// Whether a ball was begun and is not finished.
  bool is_unfinished() const { return spokes_left_ > 0; }

  /// Takes in one more neighbour: so that no single motion pays for all of them. \pre is_unfinished(), and neither star nor list
  /// has changed since begin(); J may have moved. Cost: the candidate edges and vertices.
  void go_on(const Star<Mesh>& star, const Checklist<Mesh>& list) {
    --spokes_left_;
    edges(star, list, spokes_left_);
    vertices(star, list, spokes_left_);
    const double r = radius_ * (1 - rounding) - error_;
    if (!(r > 0))
      spokes_left_ = 0;
    else if (spokes_left_ == 0)
      square_ = r * r;
  }

private:
  using Vector = internal::Vector;

  /// 2^-40: a thousand times what the some twenty roundings of a bound or a comparison, each of 2^-53, can make.
  static constexpr double rounding = 0x1p-40;
  /// Stars smaller or larger than these, whose squares of squares might leave the range of doubles, have no ball.
  static constexpr double least_extent = 0x1p-200, largest_extent = 0x1p+200;

  /// The radius is at most so much of the star's extent. A larger ball is seldom left later, but has more pairs to bound.
  static constexpr double widest = 0.5;

  Coordinates centre_{};
  double square_ = -1, radius_ = 0, error_ = 0;
  std::size_t spokes_left_ = 0;

  bool is_in(const Coordinates& p, double square) const {
    const double x = p[0] - centre_[0], y = p[1] - centre_[1], z = p[2] - centre_[2];
    return x * x + y * y + z * z < square;
  }

  /// Lowers the radius to what separates two sets of points along n.
  template <std::size_t N, std::size_t M>
  void bound(const std::array<Vector, N>& moving, const std::array<Vector, M>& still, const Vector& n) {
    const double norm = std::sqrt(internal::dot(n, n));
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Vector& p : moving)
      lowest = std::fmin(lowest, internal::dot(n, p));
    for (const Vector& q : still)
      highest = std::fmax(highest, internal::dot(n, q));
    const double apart = (lowest - highest) / norm;
    // The two are about |n| apart. Where that is no more than roundings, and the norm of a tiny n worth nothing, no ball is.
    radius_ = norm > error_ && apart > 0 ? std::fmin(radius_, apart) : 0;
  }

  /// A lower bound of the distance of two boxes.
  static double gap(const Box_3& a, const Box_3& b) {
    double most = 0;
    for (int i = 0; i < 3; ++i)
      most = std::fmax(most, std::fmax(a.lower[i] - b.upper[i], b.lower[i] - a.upper[i]));
    return most;
  }

  Vector local(const Coordinates& p) const { return internal::minus(p, centre_); }

  void faces(const Checklist<Mesh>& list) {
    const Box_3 here(centre_);
    for (const auto& face : list.faces()) {
      if (gap(face.box, here) >= radius_)
        continue;
      const auto& v = list.vertices();
      const std::array<Vector, 3> t = {local(v[face.vertices[0]].point), local(v[face.vertices[1]].point),
                                       local(v[face.vertices[2]].point)};
      bound(std::array<Vector, 1>{Vector{}}, t, internal::scaled(nearest_to_origin(t), -1));
    }
  }

  void edges(const Star<Mesh>& star, const Checklist<Mesh>& list, std::size_t i) {
    const Box_3 box = Box_3(centre_).include(star.link_points[i]);
    const std::array<Vector, 2> moving = {Vector{}, local(star.link_points[i])};
    for (const auto& edge : list.edges()) {
      if (gap(edge.box, box) >= radius_)
        continue;
      const auto &a = list.vertices()[edge.vertices[0]], &b = list.vertices()[edge.vertices[1]];
      if (a.index == star.link[i] || b.index == star.link[i])
        continue;
      const std::array<Vector, 2> still = {local(a.point), local(b.point)};
      bound(moving, still, between_segments(moving, still));
    }
  }

  void vertices(const Star<Mesh>& star, const Checklist<Mesh>& list, std::size_t i) {
    const std::size_t j = star.next(i);
    const Box_3 box = Box_3(centre_).include(star.link_points[i]).include(star.link_points[j]);
    for (const auto& vertex : list.vertices()) {
      if (gap(Box_3(vertex.point), box) >= radius_ || vertex.index == star.link[i] || vertex.index == star.link[j])
        continue;
      const Vector p = local(vertex.point);
      const std::array<Vector, 3> face = {internal::minus(Vector{}, p), internal::minus(local(star.link_points[i]), p),
                                          internal::minus(local(star.link_points[j]), p)};
      bound(face, std::array<Vector, 1>{Vector{}}, nearest_to_origin(face));
    }
  }

  /// About the point of the segment nearest to the origin.
  static Vector nearest_to_origin(const Vector& a, const Vector& b) {
    const Vector d = internal::minus(b, a);
    const double t = -internal::dot(a, d) / internal::dot(d, d);
    return t <= 0 ? a : t >= 1 ? b : internal::advanced(a, t, d);
  }

  /// About the point of the triangle nearest to the origin.
  static Vector nearest_to_origin(const std::array<Vector, 3>& t) {
    const Vector n = internal::cross(internal::minus(t[1], t[0]), internal::minus(t[2], t[0]));
    bool inside = true;
    for (int k = 0; k < 3; ++k)
      inside = inside && internal::dot(internal::cross(t[k], t[(k + 1) % 3]), n) >= 0;
    if (inside)
      return internal::scaled(n, internal::dot(t[0], n) / internal::dot(n, n));
    Vector best = nearest_to_origin(t[0], t[1]);
    for (int k = 1; k < 3; ++k) {
      const Vector other = nearest_to_origin(t[k], t[(k + 1) % 3]);
      if (internal::dot(other, other) < internal::dot(best, best))
        best = other;
    }
    return best;
  }

  /// About the shortest vector from the second segment to the first.
  static Vector between_segments(const std::array<Vector, 2>& p, const std::array<Vector, 2>& q) {
    using namespace internal;
    const Vector d = minus(p[1], p[0]), e = minus(q[1], q[0]), r = minus(p[0], q[0]);
    const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
    const double determinant = dd * ee - de * de;
    const auto clamped = [](double x) { return x > 0 ? x < 1 ? x : 1 : 0; };
    double s = determinant > 0 ? clamped((de * er - ee * dr) / determinant) : 0;
    const double t = clamped((de * s + er) / ee);
    s = clamped((de * t - dr) / dd);
    return minus(advanced(p[0], s, d), advanced(q[0], t, e));
  }
};

} // namespace haptic_sculpt

#endif
