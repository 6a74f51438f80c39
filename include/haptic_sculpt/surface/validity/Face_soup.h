// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/Vertex_attribute.h>
#include <haptic_sculpt/surface/cgal_compatibility.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace haptic_sculpt {

/// Points, and faces as lists of indices of points: what a mesh file holds, and what `validate()` looks at.
///
/// The corners of all faces stand one after another in `corners`; those of face `f` begin at `first_corner[f]`.
/// 4 bytes a corner and a face, 24 a point.
struct Face_soup {
  using Point_3 = Decision_kernel::Point_3; ///< three doubles, as given
  using Index = std::uint32_t; ///< of points and corners: fewer than 2^32 of each

  std::vector<Point_3> points;        ///< in the order of the file
  std::vector<Index> corners;         ///< indices of points, face after face
  std::vector<Index> first_corner{0}; ///< one more than there are faces; the last is the number of corners
  std::vector<Vertex_attribute> attributes; ///< of the points
  /// What the file has besides, e.g. "normals"; each once.
  std::vector<std::string> left_out;

  /// Those that are closed; 0 of what was moved from.
  std::size_t number_of_faces() const { return first_corner.empty() ? 0 : first_corner.size() - 1; }
  /// How many corners a face has. \pre face < number_of_faces()
  std::size_t number_of_corners(std::size_t face) const { return first_corner[face + 1] - first_corner[face]; }
  /// The first corner, as an index.
  const Index* begin(std::size_t face) const {
    return corners.data() + first_corner[face];
  }
  /// Behind the last corner.
  const Index* end(std::size_t face) const {
    return corners.data() + first_corner[face + 1];
  }

  /// Appends a point. Every coordinate of a file comes through here. \throw Read_error for 2^32 points and more
  void add_point(double x, double y, double z) {
    if (points.size() >= std::numeric_limits<Index>::max())
      throw Read_error("there are 2^32 points or more");
    points.emplace_back(x, y, z);
  }

  /// Notes what is not read, once.
  void leave_out(const std::string& what) {
    if (std::find(left_out.begin(), left_out.end(), what) == left_out.end())
      left_out.push_back(what);
  }

  /// Ends the face whose corners were appended to `corners`. \throw Read_error for 2^32 corners and more
  void close_face() {
    if (corners.size() > std::numeric_limits<Index>::max())
      throw Read_error("the faces have 2^32 corners or more");
    if (first_corner.empty()) // it was moved from
      first_corner.push_back(0);
    first_corner.push_back(static_cast<Index>(corners.size()));
  }

  /// Appends a face with these corners. \pre the one before is closed
  template <class Range>
  void add_face(const Range& indices) {
    const std::size_t before = corners.size();
    try {
      for (const auto index : indices)
        corners.push_back(static_cast<Index>(index));
      close_face();
    } catch (...) { // else what was taken of it would be of the next face
      corners.resize(before);
      throw;
    }
  }

  /// Whether all coordinates of a point are finite. \pre point < points.size()
  bool is_finite(std::size_t point) const {
    const Point_3& p = points[point];
    return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
  }
};

namespace internal {

/// Leaves the points of these vertices alone, in this order. \pre no face has another corner
template <class Vertices>
void keep_points(Face_soup& soup, const Vertices& vertices) {
  std::vector<Face_soup::Index> place(soup.points.size());
  std::vector<Face_soup::Point_3> points;
  for (const auto v : vertices) {
    place[v] = static_cast<Face_soup::Index>(points.size());
    points.push_back(soup.points[v]);
  }
  for (Face_soup::Index& corner : soup.corners)
    corner = place[corner];
  soup.points = std::move(points);
}

/// \throw Error where a corner is no index of a point, or a face no part of the corners
inline void check_corners(const Face_soup& soup) {
  for (std::size_t f = 0; f <= soup.number_of_faces() && !soup.first_corner.empty(); ++f)
    if (const std::size_t first = soup.first_corner[f], before = f == 0 ? 0 : soup.first_corner[f - 1];
        first < before || first > soup.corners.size() || (f == 0 && first != 0))
      throw Error("entry " + std::to_string(f) + " of first_corner is " + std::to_string(first) + ", but " +
                  (f == 0 ? std::string("faces begin with corner 0")
                          : "faces follow each other from " + std::to_string(before) + " up to the " +
                                std::to_string(soup.corners.size()) + " corners"));
  for (std::size_t i = 0; i < soup.corners.size(); ++i)
    if (soup.corners[i] >= soup.points.size())
      throw Error("corner " + std::to_string(i) + " of the list of faces is point " + std::to_string(soup.corners[i]) +
                  ", but there are only " + std::to_string(soup.points.size()) + " points; give indices from 0");
}

/// \throw Error where an attribute has not one value for each point
inline void check_attributes(const Face_soup& soup) {
  for (const Vertex_attribute& attribute : soup.attributes)
    if (attribute.values.size() != soup.points.size())
      throw Error("the attribute '" + attribute.name + "' has " + std::to_string(attribute.values.size()) +
                  " values, but there are " + std::to_string(soup.points.size()) + " points; give each point one");
}

} // namespace internal
} // namespace haptic_sculpt
