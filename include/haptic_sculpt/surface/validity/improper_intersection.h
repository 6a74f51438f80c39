// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_IMPROPER_INTERSECTION_H
#define HAPTIC_SCULPT_SURFACE_IMPROPER_INTERSECTION_H

#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// Whether two closed triangles of a soup meet elsewhere than in the vertices and the edge they share; exact.
///
/// Which vertices are shared is told by their indices, not by their coordinates: two vertices at one point are a touch.
/// `CGAL::Polygon_mesh_processing::self_intersections` decides the same for triangles that are not degenerate, with
/// shared edges found through the half-edges; here nothing but the list of corners is used.
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
/// found. Pairs whose boxes meet are found by CGAL's box intersection, O(n log^3 n + pairs), always in the same order;
/// each is then decided exactly.
/// \param flat[f] whether face f is degenerate
inline Improper_intersections improper_intersections(const Face_soup& soup, const std::vector<Face_soup::Index>& faces,
                                                     const std::vector<bool>& flat, std::size_t most) {
  using Index = Face_soup::Index;
  struct Enough {}; // thrown through the box intersection: it has no other way to end early
  using Box =
      CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index, CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;
  std::vector<Box> boxes;
  boxes.reserve(faces.size());
  for (const Index f : faces) {
    CGAL::Bbox_3 bounds;
    for (const Index* corner = soup.begin(f); corner != soup.end(f); ++corner)
      bounds += soup.points[*corner].bbox();
    boxes.emplace_back(bounds, f);
  }
  std::vector<const Box*> pointers;
  pointers.reserve(boxes.size());
  for (const Box& box : boxes)
    pointers.push_back(&box);

  Improper_intersections found;
  const Meet_improperly meet_improperly(soup);
  const auto decide = [&](const Box* a, const Box* b) {
    const Index f = std::min(a->info(), b->info()), g = std::max(a->info(), b->info());
    if (!(flat[f] || flat[g] ? meet_improperly.degenerate(f, g) : meet_improperly(f, g)))
      return;
    if (found.pairs.size() == most)
      throw Enough();
    found.pairs.emplace_back(f, g);
  };
  constexpr std::ptrdiff_t cutoff = 2000; // below so many boxes all pairs are tried; the figure PMP uses
  try {
    CGAL::box_self_intersection_d(pointers.begin(), pointers.end(), decide, cutoff);
  } catch (const Enough&) {
    found.has_more = true;
  }
  std::sort(found.pairs.begin(), found.pairs.end());
  return found;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
