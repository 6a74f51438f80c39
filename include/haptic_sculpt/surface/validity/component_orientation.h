// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validity/Face_soup.h>
#include <haptic_sculpt/surface/validity/First_face_along_x.h>
#include <haptic_sculpt/surface/validity/soup_connectivity.h>

#include <CGAL/determinant.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Six times the signed volume that faces closed upon themselves enclose. From a corner of them, so that intervals stay
/// narrow far from the origin. \pre there is a face
template <class Number>
Number volume(const Face_soup& soup, const std::vector<Face_soup::Index>& faces) {
  const auto& o = soup.points[*soup.begin(faces.front())];
  const auto from_o = [&](Face_soup::Index i, std::array<Number, 3>& d) {
    for (int k = 0; k < 3; ++k)
      d[k] = Number(soup.points[i][k]) - Number(o[k]);
  };
  Number sum(0);
  std::array<Number, 3> a, b, c;
  for (const Face_soup::Index f : faces) {
    const Face_soup::Index* corner = soup.begin(f);
    from_o(corner[0], a), from_o(corner[1], b), from_o(corner[2], c);
    sum = sum + CGAL::determinant(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]);
  }
  return sum;
}

/// Its sign.
inline CGAL::Sign volume_sign(const Face_soup& soup, const std::vector<Face_soup::Index>& faces) {
  return by_intervals_or_exactly([&](auto number) { return CGAL::sign(volume<decltype(number)>(soup, faces)); });
}

/// Finds the components of a valid surface whose normals point into the solid.
///
/// A closed embedded component has its normals on the outside of itself iff it encloses a positive signed volume. It
/// has to, unless it lies in an odd number of other components, when it bounds a cavity and has to enclose a negative
/// one. Where a component lies follows from what is first seen from its outermost vertex: the outside of a component
/// that lies as deep, or the inside of the one it lies in. doc/proofs/validity.md says why that is enough, and what it
/// costs: O(n log n) and the faces whose boxes the rays meet on their way.
class Component_orientation {
  using Index = Face_soup::Index;
  using Point_3 = Decision_kernel::Point_3;

  struct Component {
    std::vector<Index> faces;
    Index outermost;                                         // the vertex with the lexicographically greatest point
    double origin = std::numeric_limits<double>::infinity(); // the least x
    bool encloses_positive_volume = false;
    bool lies_in_odd_number = false;
  };

public:
  /// \pre the soup is a closed, consistently oriented, embedded triangle surface
  explicit Component_orientation(const Face_soup& soup) : soup_(soup), component_of_face_(soup.number_of_faces()) {
    collect_components();
    for (Component& component : components_)
      component.encloses_positive_volume = volume_sign(soup, component.faces) == CGAL::POSITIVE;
    if (components_.size() > 1)
      locate_components();
  }

  /// The lowest face of each such component.
  std::vector<Index> inside_out() const {
    std::vector<Index> found;
    for (const Component& component : components_)
      if (component.encloses_positive_volume == component.lies_in_odd_number)
        found.push_back(component.faces.front());
    return found;
  }

  /// Whether each face is of such a component.
  std::vector<bool> faces_inside_out() const {
    std::vector<bool> turned(component_of_face_.size());
    for (std::size_t f = 0; f < turned.size(); ++f) {
      const Component& component = components_[component_of_face_[f]];
      turned[f] = component.encloses_positive_volume == component.lies_in_odd_number;
    }
    return turned;
  }

private:
  bool is_less(Index v, Index w) const {
    return CGAL::compare_lexicographically_xyz(soup_.points[v], soup_.points[w]) == CGAL::SMALLER;
  }

  // They are numbered by their lowest faces.
  void collect_components() {
    Disjoint_sets sets = Soup_connectivity(soup_).components();
    constexpr Index none = static_cast<Index>(-1);
    std::vector<Index> number(soup_.points.size(), none);
    for (Index f = 0; f < soup_.number_of_faces(); ++f) {
      Index& place = number[sets.find(*soup_.begin(f))];
      if (place == none) {
        place = static_cast<Index>(components_.size());
        components_.emplace_back();
        components_.back().outermost = *soup_.begin(f);
      }
      Component& component = components_[place];
      component_of_face_[f] = place;
      component.faces.push_back(f);
      for (const Index* corner = soup_.begin(f); corner != soup_.end(f); ++corner) {
        component.origin = std::min(component.origin, soup_.points[*corner].x());
        if (is_less(component.outermost, *corner))
          component.outermost = *corner;
      }
    }
  }

  void locate_components() {
    std::vector<double> origin(soup_.number_of_faces());
    for (std::size_t f = 0; f < origin.size(); ++f)
      origin[f] = components_[component_of_face_[f]].origin;
    const First_face_along_x first_face(soup_, std::move(origin));
    // What is seen reaches further than what sees it, so it has been located before.
    std::vector<std::size_t> order(components_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [this](std::size_t i, std::size_t j) {
      return is_less(components_[j].outermost, components_[i].outermost);
    });
    for (const std::size_t i : order) {
      const auto seen = first_face(components_[i].outermost);
      if (!seen)
        continue;
      const Component& other = components_[component_of_face_[seen->face]];
      const bool from_inside = seen->normal_towards_v != other.encloses_positive_volume;
      components_[i].lies_in_odd_number = other.lies_in_odd_number != from_inside;
    }
  }

  const Face_soup& soup_;
  std::vector<Index> component_of_face_;
  std::vector<Component> components_;
};

} // namespace haptic_sculpt::internal
