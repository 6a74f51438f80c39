// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The sweeps whose five points lie in one plane, or on one line.
///
/// They drop to exact 2D predicates in a coordinate projection that is one-to-one on the plane of the points. The
/// first contact in a plane is always a vertex reaching a segment, so two questions serve all three sweeps; see
/// doc/proofs/exact_sweeps.md, "Flat sweeps".

#include <haptic_sculpt/collision/arithmetic/Sweep_signs.h>
#include <haptic_sculpt/collision/arithmetic/sweep_time.h>


namespace haptic_sculpt::internal {

/// Flat sweeps among five coplanar points. All functions take indices into the points.
template <class Counters>
class Flat_sweep {
public:
  /// Finds a projection that is one-to-one on the five points' plane or line.
  /// \pre All five points are coplanar.
  Flat_sweep(const Sweep_points& points, Sweep_signs<Counters>& signs) : p(points), signs(signs) {
    for (int i = 4; i >= 2; --i) // static points first: they seldom coincide
      for (int j = i - 1; j >= 1; --j)
        for (int k = j - 1; k >= 0; --k)
          for (int candidate = 0; candidate < 3; ++candidate)
            if (signs.orientation_2(i, j, k, candidate) != 0) {
              axis = candidate;
              return;
            }
    // All on one line: any projection keeps it that does not drop the one coordinate that varies.
    for (int coordinate = 0; coordinate < 3; ++coordinate)
      for (int i = 1; i < 5; ++i)
        if (p[i][coordinate] != p[0][coordinate]) {
          axis = (coordinate + 1) % 3;
          return;
        }
  }

  /// The moving vertex against the static triangle a, b, c.
  Sweep_verdict vertex_face(int a, int b, int c) const {
    if (orientation(a, b, c) != 0 && triangle_contains(a, b, c, 0)) { // else its edges say where
      Sweep_verdict verdict = at_start();
      verdict.location = location_from_signs(orientation(a, b, 0), orientation(b, c, 0), orientation(c, a, 0));
      return verdict;
    }
    using L = Triangle_location;
    Sweep_verdict first = vertex_segment(a, b, {L::edge_ab, L::vertex_a, L::vertex_b});
    keep_earlier(first, vertex_segment(b, c, {L::edge_bc, L::vertex_b, L::vertex_c}));
    keep_earlier(first, vertex_segment(c, a, {L::edge_ca, L::vertex_c, L::vertex_a}));
    return first;
  }

  /// The moving edge, whose far end is v, against the static segment a, b.
  Sweep_verdict edge_edge(int v, int a, int b) const {
    if (segments_meet(0, v, a, b))
      return at_start();
    Sweep_verdict first = segment_point(v, a);
    keep_earlier(first, segment_point(v, b));
    keep_earlier(first, vertex_segment(a, b, {}));
    return first;
  }

  /// The moving face, whose far edge is g, i, against the static point a.
  Sweep_verdict face_vertex(int g, int i, int a) const {
    if (triangle_contains(0, g, i, a))
      return at_start();
    Sweep_verdict first = segment_point(g, a);
    keep_earlier(first, segment_point(i, a));
    return first;
  }

  /// Where in triangle a, b, c a point of it lies, from its orientations with the edges.
  static Triangle_location location_from_signs(int ab, int bc, int ca) {
    using L = Triangle_location;
    if (ab == 0)
      return ca == 0 ? L::vertex_a : bc == 0 ? L::vertex_b : L::edge_ab;
    if (bc == 0)
      return ca == 0 ? L::vertex_c : L::edge_bc;
    return ca == 0 ? L::edge_ca : L::face;
  }

private:
  /// What to call a vertex-face impact inside a segment and at its two ends.
  struct Segment_locations {
    Triangle_location inside, first, second;
  };

  const Sweep_points& p;
  Sweep_signs<Counters>& signs;
  int axis = 0;

  static Sweep_verdict at_start() {
    Sweep_verdict verdict;
    verdict.hits = true;
    return verdict;
  }

  int orientation(int a, int b, int c) const { return signs.orientation_2(a, b, c, axis); }

  /// Lexicographic order in the projection.
  int compare(int a, int b) const {
    for (int i : {(axis + 1) % 3, (axis + 2) % 3})
      if (p[a][i] != p[b][i])
        return p[a][i] < p[b][i] ? -1 : 1;
    return 0;
  }

  /// Whether c lies between a and b, ends included. \pre a, b, c are collinear.
  bool is_between(int a, int b, int c) const { return compare(a, c) * compare(b, c) <= 0; }

  bool is_on_segment(int a, int b, int c) const { return orientation(a, b, c) == 0 && is_between(a, b, c); }

  bool segments_meet(int a, int b, int c, int d) const {
    const int abc = orientation(a, b, c), abd = orientation(a, b, d);
    const int cda = orientation(c, d, a), cdb = orientation(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0)
      return true;
    return (abc == 0 && is_between(a, b, c)) || (abd == 0 && is_between(a, b, d)) ||
           (cda == 0 && is_between(c, d, a)) || (cdb == 0 && is_between(c, d, b));
  }

  bool triangle_contains(int a, int b, int c, int q) const {
    const int side = orientation(a, b, c);
    const int ab = orientation(a, b, q), bc = orientation(b, c, q), ca = orientation(c, a, q);
    if (side != 0)
      return ab * side >= 0 && bc * side >= 0 && ca * side >= 0;
    return (ab == 0 && is_between(a, b, q)) || (bc == 0 && is_between(b, c, q)) || (ca == 0 && is_between(c, a, q));
  }

  Sweep_verdict on_line(int a, int b) const {
    Sweep_verdict verdict = at_start();
    verdict.form = Time_form::line;
    verdict.axis = static_cast<std::uint8_t>(axis);
    verdict.through = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), 0};
    return verdict;
  }

  /// The moving vertex reaches point a, which lies on its path. \pre start and target differ.
  Sweep_verdict at_point(int a) const {
    Sweep_verdict verdict = at_start();
    verdict.form = Time_form::point;
    verdict.axis = static_cast<std::uint8_t>(p[0][0] != p[1][0] ? 0 : p[0][1] != p[1][1] ? 1 : 2);
    verdict.through = {static_cast<std::uint8_t>(a), 0, 0};
    return verdict;
  }

  /// The first time the moving vertex lies on segment a, b.
  Sweep_verdict vertex_segment(int a, int b, const Segment_locations& locations) const {
    const int start = orientation(a, b, 0), target = orientation(a, b, 1);
    Sweep_verdict verdict;
    if (start == 0 && is_between(a, b, 0)) {
      verdict = at_start();
      verdict.location = compare(a, 0) == 0   ? locations.first
                         : compare(b, 0) == 0 ? locations.second
                                              : locations.inside;
    } else if (start == 0 &&
               target == 0) { // along the line of the segment, from outside it: its nearer end comes first
      const bool a_is_nearer = compare(0, a) == compare(a, b);
      const int nearer = a_is_nearer ? a : b;
      if (compare(0, 1) != 0 && is_on_segment(0, 1, nearer)) {
        verdict = at_point(nearer);
        verdict.location = a_is_nearer ? locations.first : locations.second;
      }
    } else if (start != 0 && start * target <= 0) {
      const int side_a = orientation(0, 1, a), side_b = orientation(0, 1, b);
      if (side_a * side_b <= 0) {
        verdict = on_line(a, b);
        verdict.location = side_a == 0 ? locations.first : side_b == 0 ? locations.second : locations.inside;
      }
    }
    return verdict;
  }

  /// The first time the moving segment, whose far end is v, covers point a.
  Sweep_verdict segment_point(int v, int a) const {
    const int side = orientation(0, 1, v);
    if (side == 0) { // the segment stays in its line
      if (is_on_segment(0, v, a))
        return at_start();
      return is_on_segment(0, 1, a) ? at_point(a) : Sweep_verdict();
    }
    if (orientation(0, 1, a) * side < 0 || orientation(1, v, a) * side < 0 || orientation(v, 0, a) * side < 0)
      return Sweep_verdict();
    return compare(v, a) == 0 ? at_start() : on_line(v, a);
  }

  void keep_earlier(Sweep_verdict& first, const Sweep_verdict& other) const {
    if (other.hits && (!first.hits || compare_times(p, other, p, first, signs.counters()) < 0))
      first = other;
  }
};

} // namespace haptic_sculpt::internal
