// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_COMPONENT_ORIENTATION_H
#define HAPTIC_SCULPT_SURFACE_COMPONENT_ORIENTATION_H

#include <haptic_sculpt/surface/Face_soup.h>
#include <haptic_sculpt/surface/soup_connectivity.h>

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/determinant.h>

#include <limits>
#include <map>
#include <random>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// Finds the components of a valid surface whose normals point into the solid.
///
/// A closed embedded component has its normals on the outside of itself iff it encloses a positive signed volume. It
/// has to, unless it lies in an odd number of other components, when it bounds a cavity and has to enclose a negative
/// one. O(n), and for each component O(n of the components whose box holds it).
class Component_orientation {
  using Index = Face_soup::Index;
  using Point_3 = Decision_kernel::Point_3;

  struct Component {
    std::vector<Index> faces;
    CGAL::Bbox_3 box;
  };

public:
  /// \pre the soup is a closed, consistently oriented, embedded triangle surface
  explicit Component_orientation(const Face_soup& soup) : soup_(soup) {
    Disjoint_sets sets = Soup_connectivity(soup).components();
    std::map<Index, std::size_t> number;
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
      const auto [place, is_new] = number.emplace(sets.find(*soup.begin(f)), components_.size());
      if (is_new)
        components_.emplace_back();
      Component& component = components_[place->second];
      component.faces.push_back(static_cast<Index>(f));
      for (const Index* corner = soup.begin(f); corner != soup.end(f); ++corner)
        component.box += soup.points[*corner].bbox();
    }
  }

  /// The lowest face of each such component.
  std::vector<Index> inside_out() const {
    std::vector<Index> found;
    for (const Component& component : components_) {
      std::size_t depth = 0;
      const Point_3& p = soup_.points[*soup_.begin(component.faces.front())];
      for (const Component& other : components_)
        depth += &other != &component && CGAL::do_overlap(p.bbox(), other.box) && contains(other, p);
      if (volume_sign(component) != (depth % 2 == 0 ? CGAL::POSITIVE : CGAL::NEGATIVE))
        found.push_back(component.faces.front());
    }
    return found;
  }

private:
  CGAL::Sign volume_sign(const Component& component) const {
    {
      CGAL::Protect_FPU_rounding<true> upward;
      const auto sign = CGAL::sign(volume<CGAL::Interval_nt<false>>(component));
      if (CGAL::is_certain(sign))
        return CGAL::get_certain(sign);
    }
    return CGAL::sign(volume<Exact_ring_number>(component));
  }

  // Six times the signed volume, taken from a corner of the component so that intervals stay narrow far from the
  // origin.
  template <class Number>
  Number volume(const Component& component) const {
    const Point_3& o = soup_.points[*soup_.begin(component.faces.front())];
    const auto from_o = [&](Index i, std::array<Number, 3>& d) {
      for (int k = 0; k < 3; ++k)
        d[k] = Number(soup_.points[i][k]) - Number(o[k]);
    };
    Number sum(0);
    std::array<Number, 3> a, b, c;
    for (const Index f : component.faces) {
      const Index* corner = soup_.begin(f);
      from_o(corner[0], a);
      from_o(corner[1], b);
      from_o(corner[2], c);
      sum = sum + CGAL::determinant(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]);
    }
    return sum;
  }

  // Parity of the faces that a segment from p to a point beyond the component's box crosses. A segment that meets an
  // edge or a corner says nothing, so another is drawn at random: all but a null set of them will do.
  bool contains(const Component& component, const Point_3& p) const {
    const CGAL::Bbox_3& box = component.box;
    constexpr double far = std::numeric_limits<double>::max();
    const double length = std::max(box.xmax() / 2 - box.xmin() / 2, std::numeric_limits<double>::min());
    const bool to_right = box.xmax() <= far - 2 * length || box.xmax() < far;
    const double x = to_right ? std::min(far, box.xmax() + std::min(length, far / 4))
                              : std::max(-far, box.xmin() - std::min(length, far / 4));
    std::minstd_rand random(1);
    std::uniform_real_distribution<double> slope(-1, 1);
    for (;;) {
      const double y =
          box.ymin() / 2 + box.ymax() / 2 + slope(random) * std::max(box.ymax() / 2 - box.ymin() / 2, length);
      const double z =
          box.zmin() / 2 + box.zmax() / 2 + slope(random) * std::max(box.zmax() / 2 - box.zmin() / 2, length);
      const int crossings = count_crossings(component, p, Point_3(beyond(x, box, to_right), y, z));
      if (crossings >= 0)
        return crossings % 2 == 1;
    }
  }

  static double beyond(double x, const CGAL::Bbox_3& box, bool to_right) {
    // Rounding may have left x on the box.
    if (to_right && x <= box.xmax())
      return std::nextafter(box.xmax(), std::numeric_limits<double>::infinity());
    if (!to_right && x >= box.xmin())
      return std::nextafter(box.xmin(), -std::numeric_limits<double>::infinity());
    return x;
  }

  // -1 if the segment is in special position.
  int count_crossings(const Component& component, const Point_3& p, const Point_3& q) const {
    const CGAL::Bbox_3 reach = p.bbox() + q.bbox();
    int crossings = 0;
    for (const Index f : component.faces) {
      const Index* corner = soup_.begin(f);
      const Point_3 &a = soup_.points[corner[0]], &b = soup_.points[corner[1]], &c = soup_.points[corner[2]];
      if (!CGAL::do_overlap(reach, a.bbox() + b.bbox() + c.bbox()))
        continue;
      const CGAL::Orientation u = CGAL::orientation(p, q, a, b), v = CGAL::orientation(p, q, b, c),
                              w = CGAL::orientation(p, q, c, a);
      if ((u == CGAL::POSITIVE || v == CGAL::POSITIVE || w == CGAL::POSITIVE) &&
          (u == CGAL::NEGATIVE || v == CGAL::NEGATIVE || w == CGAL::NEGATIVE))
        continue; // the line passes by, whatever the third sign
      const CGAL::Orientation at_p = CGAL::orientation(a, b, c, p), at_q = CGAL::orientation(a, b, c, q);
      if (u == CGAL::ZERO || v == CGAL::ZERO || w == CGAL::ZERO || at_p == CGAL::ZERO || at_q == CGAL::ZERO)
        return -1;
      crossings += at_p != at_q;
    }
    return crossings;
  }

  const Face_soup& soup_;
  std::vector<Component> components_;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
