// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validity/Face_soup.h>
#include <haptic_sculpt/surface/validity/near_faces.h>

#include <CGAL/intersections.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Whether two closed triangles of a soup meet elsewhere than in the vertices and the edge they share; exact.
///
/// Which vertices are shared follows from their indices, not by their coordinates: two vertices at one point are a
/// touch. `CGAL::Polygon_mesh_processing::self_intersections` decides the same for triangles that are not degenerate,
/// with shared edges found through the half-edges; here nothing but the list of corners is used.
class Meet_improperly {
  using Index = Face_soup::Index;
  using Point_3 = Decision_kernel::Point_3;
  using Segment_3 = Decision_kernel::Segment_3;
  using Triangle_3 = Decision_kernel::Triangle_3;

public:
  explicit Meet_improperly(const Face_soup& soup) : soup_(soup) {}

  /// \pre both faces are triangles with finite corners that do not lie on a line
  bool operator()(Index f, Index g) const {
    // Shared vertices to the front, in the same order.
    std::array<Index, 3> a, b;
    std::copy_n(soup_.begin(f), 3, a.begin());
    std::copy_n(soup_.begin(g), 3, b.begin());
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = shared; j < 3; ++j)
        if (a[i] == b[j]) {
          std::swap(a[i], a[shared]);
          std::swap(b[j], b[shared]);
          ++shared;
          break;
        }
    switch (shared) {
    case 0:
      return CGAL::do_intersect(triangle(a), triangle(b));
    case 1:
      // Another common point makes, with the shared vertex, a common segment; prolonged, it leaves one of the triangles
      // through the edge opposite to the shared vertex while still in the other.
      return CGAL::do_intersect(triangle(a), Segment_3(point(b[1]), point(b[2]))) ||
             CGAL::do_intersect(triangle(b), Segment_3(point(a[1]), point(a[2])));
    case 2:
      // Two half-planes on one line meet elsewhere only if they are the same half-plane.
      return CGAL::coplanar(point(a[0]), point(a[1]), point(a[2]), point(b[2])) &&
             CGAL::coplanar_orientation(point(a[0]), point(a[1]), point(a[2]), point(b[2])) == CGAL::POSITIVE;
    default:
      return true;
    }
  }

  /// The same where at least one of the faces is degenerate: it counts as the segment that its corners span. Faces that
  /// share a vertex are not looked at, nor those whose three corners are one point (these are coincident vertices).
  /// \pre both faces are triangles with finite corners
  bool degenerate(Index f, Index g) const {
    if (std::find_first_of(soup_.begin(f), soup_.end(f), soup_.begin(g), soup_.end(g)) != soup_.end(f))
      return false;
    const bool f_flat = is_flat(f), g_flat = is_flat(g);
    const Segment_3 s = span(f), t = span(g);
    if ((f_flat && s.is_degenerate()) || (g_flat && t.is_degenerate()))
      return false;
    if (f_flat && g_flat)
      return CGAL::do_intersect(s, t);
    return f_flat ? CGAL::do_intersect(s, triangle(g)) : CGAL::do_intersect(t, triangle(f));
  }

  /// Whether the corners lie on a line.
  bool is_flat(Index f) const {
    const Index* corner = soup_.begin(f);
    return CGAL::collinear(point(corner[0]), point(corner[1]), point(corner[2]));
  }

private:
  const Point_3& point(Index i) const { return soup_.points[i]; }
  Triangle_3 triangle(const std::array<Index, 3>& a) const { return {point(a[0]), point(a[1]), point(a[2])}; }
  Triangle_3 triangle(Index f) const {
    const Index* corner = soup_.begin(f);
    return {point(corner[0]), point(corner[1]), point(corner[2])};
  }
  // Points of a line are ordered along it as they are lexicographically.
  Segment_3 span(Index f) const {
    const auto less = [this](Index i, Index j) { return CGAL::lexicographically_xyz_smaller(point(i), point(j)); };
    const auto ends = std::minmax_element(soup_.begin(f), soup_.end(f), less);
    return {point(*ends.first), point(*ends.second)};
  }

  const Face_soup& soup_;
};

struct Improper_intersections {
  std::vector<std::pair<Face_soup::Index, Face_soup::Index>> pairs; // f < g, sorted
  bool has_more = false;
};

/// Pairs of triangles of `faces` that meet improperly: all if there are at most `most`, else the first `most` that are
/// found. Pairs that are near are found by Near_faces, always in the same order; each is then decided exactly.
/// \param flat[f] whether face f is degenerate
template <class Concurrency_tag = CGAL::Sequential_tag>
Improper_intersections improper_intersections(const Face_soup& soup, const std::vector<Face_soup::Index>& faces,
                                              const std::vector<bool>& flat, std::size_t most) {
  using Index = Face_soup::Index;
  struct Enough {}; // thrown through the box intersection: it has no other way to end early
  Improper_intersections found;
  std::set<std::pair<Index, Index>> pairs;
  const Meet_improperly meet_improperly(soup);
  std::mutex finding;
  const auto meets = [&](Index f, Index g) {
    return flat[f] || flat[g] ? meet_improperly.degenerate(f, g) : meet_improperly(f, g);
  };
  const auto decide = [&](Index f, Index g) {
    if (!meets(f, g))
      return;
    const std::lock_guard<std::mutex> lock(finding);
    if (pairs.count({f, g}) != 0)
      return;
    if (pairs.size() == most)
      throw Enough();
    pairs.emplace(f, g);
  };
  try {
    Near_faces(soup, faces).for_each_pair(decide, Part_runner::by<Concurrency_tag>());
  } catch (const Enough&) {
    if constexpr (std::is_convertible<Concurrency_tag,
                                      CGAL::Parallel_tag>::value) // which were found first hangs on the threads
      return improper_intersections<CGAL::Sequential_tag>(soup, faces, flat, most);
    found.has_more = true;
  }
  found.pairs.assign(pairs.begin(), pairs.end());
  return found;
}

} // namespace haptic_sculpt::internal
