// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Box_3.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Finds the face that a ray from a vertex v in the direction of x meets first.
///
/// The ray begins at v + (e, e^2, e^3) with an infinitely small e > 0, and so meets neither edges nor corners: none is
/// in special position, and none has to be tried twice. doc/proofs/validity.md has the mathematics. Faces lie in a
/// balanced tree of boxes; those in front are looked at first, and what begins behind the best face so far is left out.
class First_face_along_x {
  using Index = Face_soup::Index;
  using Point_3 = Decision_kernel::Point_3;
  using Point_2 = Decision_kernel::Point_2;
  static constexpr std::ptrdiff_t leaf_size = 4;

  struct Box : Box_3 {
    double origin = std::numeric_limits<double>::infinity(); // the least x of all components that have faces here
    void operator+=(const Box& other) {
      include(other);
      origin = std::min(origin, other.origin);
    }
  };
  struct Node {
    Box box;
    std::size_t begin, end; // of its faces
    std::size_t right;      // its second child, if it has more than `leaf_size`; the first stands next to it
  };

public:
  struct Answer {
    Index face;
    bool normal_towards_v;
  };

  /// O(n log n).
  /// \param origin[f] the least x of the component that has face f
  First_face_along_x(const Face_soup& soup, std::vector<double> origin)
      : soup_(soup), origin_(std::move(origin)), faces_(origin_.size()) {
    std::vector<Box> boxes(faces_.size());
    for (Index f = 0; f < faces_.size(); ++f) {
      for (const Index* corner = soup.begin(f); corner != soup.end(f); ++corner) {
        const Point_3& p = soup.points[*corner];
        boxes[f].include(Box_3::Coordinates{p.x(), p.y(), p.z()});
      }
      boxes[f].origin = origin_[f];
    }
    std::iota(faces_.begin(), faces_.end(), Index(0));
    if (!faces_.empty())
      build(boxes, 0, faces_.size());
  }

  /// The first face of a component that does not begin beyond v.
  /// \pre the soup is embedded, and no point of v's component is lexicographically greater than v
  std::optional<Answer> operator()(Index v) const {
    Search search{soup_.points[v], {}, 0, std::numeric_limits<double>::infinity()};
    if (!nodes_.empty())
      visit(nodes_.front(), search);
    if (!search.face)
      return std::nullopt;
    return Answer{*search.face, search.side < 0};
  }

private:
  struct Search {
    const Point_3& v;
    std::optional<Index> face; // the first so far,
    int side;                  // the sign of its normal's x,
    double limit;              // and its greatest x
  };

  void build(const std::vector<Box>& boxes, std::size_t begin, std::size_t end) {
    const std::size_t number = nodes_.size();
    Box box = boxes[faces_[begin]];
    for (std::size_t i = begin; i < end; ++i)
      box += boxes[faces_[i]];
    nodes_.push_back({box, begin, end, 0});
    if (end - begin <= leaf_size)
      return;
    // Across the axis along which the middles of the faces are spread most. (Their boxes may all be wide along another,
    // and no cut across that one would tell them apart.)
    const auto middle = [&](Index f, std::size_t k) { return boxes[f].lower[k] / 2 + boxes[f].upper[k] / 2; };
    std::size_t axis = 0;
    double widest = -1; // halved, so that none overflows
    for (std::size_t k = 0; k < 3; ++k) {
      const auto less = [&](Index f, Index g) { return middle(f, k) < middle(g, k); };
      const auto ends = std::minmax_element(faces_.begin() + begin, faces_.begin() + end, less);
      if (const double spread = middle(*ends.second, k) / 2 - middle(*ends.first, k) / 2; spread > widest) {
        widest = spread;
        axis = k;
      }
    }
    const std::size_t half = begin + (end - begin) / 2;
    std::nth_element(faces_.begin() + begin, faces_.begin() + half, faces_.begin() + end,
                     [&](Index f, Index g) { return middle(f, axis) < middle(g, axis); });
    build(boxes, begin, half);
    nodes_[number].right = nodes_.size();
    build(boxes, half, end);
  }

  static bool may_matter(const Node& node, const Search& search) {
    const Box& box = node.box;
    const Point_3& v = search.v;
    return box.upper[0] > v.x() && box.origin <= v.x() && box.lower[0] <= search.limit && box.lower[1] <= v.y() &&
           v.y() <= box.upper[1] && box.lower[2] <= v.z() && v.z() <= box.upper[2];
  }

  void visit(const Node& node, Search& search) const {
    if (!may_matter(node, search))
      return;
    if (node.right == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i)
        consider(faces_[i], search);
      return;
    }
    const Node *near = &node + 1, *far = &nodes_[node.right];
    if (far->box.lower[0] < near->box.lower[0])
      std::swap(near, far);
    visit(*near, search);
    visit(*far, search);
  }

  // Whether the ray meets f, and before what it has met so far.
  void consider(Index f, Search& search) const {
    if (origin_[f] > search.v.x())
      return; // such a component may hide another in which it lies and which has been left out
    const Index* corner = soup_.begin(f);
    const Point_3 &a = soup_.points[corner[0]], &b = soup_.points[corner[1]], &c = soup_.points[corner[2]];
    const int side = CGAL::orientation(along_x(a), along_x(b), along_x(c));
    if (side == 0 || turn(a, b, search.v) != side || turn(b, c, search.v) != side || turn(c, a, search.v) != side)
      return;
    if (CGAL::orientation(a, b, c, search.v) != -side)
      return; // behind v, or v is a corner
    if (search.face && !is_before(f, side, search))
      return;
    search.face = f;
    search.side = side;
    search.limit = std::max({a.x(), b.x(), c.x()});
  }

  static Point_2 along_x(const Point_3& p) { return {p.y(), p.z()}; }

  // On which side of ab the ray passes, seen along x; 0 only if a and b are one point then.
  static int turn(const Point_3& a, const Point_3& b, const Point_3& v) {
    if (const int sign = CGAL::orientation(along_x(a), along_x(b), along_x(v)); sign != 0)
      return sign;
    if (a.z() != b.z())
      return a.z() > b.z() ? 1 : -1;          // the ray is a little beyond v in y
    return (b.y() > a.y()) - (b.y() < a.y()); // and still less in z
  }

  // Whether the ray meets f before search.face.
  bool is_before(Index f, int side, const Search& search) const {
    return side * search.side *
               by_intervals_or_exactly([&](auto number) { return compare<decltype(number)>(f, search); }) <
           0;
  }

  // How far along the ray a face is met: over[0] / under, and how this changes with the y and the z of the ray:
  // over[1] / under and over[2] / under.
  template <class Number>
  struct Distance {
    std::array<Number, 3> over;
    Number under;
  };

  template <class Number>
  Distance<Number> distance(Index f, const Point_3& v) const {
    const Index* corner = soup_.begin(f);
    const auto difference = [](const Point_3& p, const Point_3& q) {
      return std::array<Number, 3>{Number(p.x()) - Number(q.x()), Number(p.y()) - Number(q.y()),
                                   Number(p.z()) - Number(q.z())};
    };
    const Point_3& a = soup_.points[corner[0]];
    const auto p = difference(soup_.points[corner[1]], a), q = difference(soup_.points[corner[2]], a),
               r = difference(a, v);
    const Number x = p[1] * q[2] - p[2] * q[1], y = p[2] * q[0] - p[0] * q[2], z = p[0] * q[1] - p[1] * q[0];
    return {{x * r[0] + y * r[1] + z * r[2], -y, -z}, x};
  }

  // The sign of the difference of the distances of f and search.face, where their normals' x have one sign.
  template <class Number>
  CGAL::Uncertain<CGAL::Sign> compare(Index f, const Search& search) const {
    const auto d = distance<Number>(f, search.v), e = distance<Number>(*search.face, search.v);
    for (int k = 0; k < 3; ++k) {
      const CGAL::Uncertain<CGAL::Sign> sign = CGAL::sign(Number(d.over[k] * e.under - e.over[k] * d.under));
      if (!sign.is_certain() || sign.make_certain() != CGAL::ZERO)
        return sign;
    }
    return CGAL::ZERO; // one plane: not on an embedded surface
  }

  const Face_soup& soup_;
  std::vector<double> origin_;
  std::vector<Index> faces_;
  std::vector<Node> nodes_;
};

} // namespace haptic_sculpt::internal
