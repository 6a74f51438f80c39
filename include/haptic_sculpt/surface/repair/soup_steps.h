// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/repair/Repair_report.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace haptic_sculpt::internal {

/// A soup as CGAL's functions take it.
struct Polygon_soup {
  using Face = std::vector<std::size_t>;
  std::vector<Face_soup::Point_3> points;
  std::vector<Face> faces;

  explicit Polygon_soup(const Face_soup& soup) : points(soup.points) {
    faces.reserve(soup.number_of_faces());
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
      faces.emplace_back(soup.begin(f), soup.end(f));
  }
  Face_soup face_soup() const {
    Face_soup soup;
    soup.points = points;
    for (const Face& face : faces)
      soup.add_face(face);
    return soup;
  }
};

/// Equal points become one; faces without area by their corners alone, doubled faces and unused points go. No point
/// moves.
inline void clean_soup(Polygon_soup& soup, std::vector<Repair_step>& steps) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  const std::size_t merged = PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.faces);
  const auto distinct_corners = [](Polygon_soup::Face face) {
    std::sort(face.begin(), face.end());
    return static_cast<std::size_t>(std::unique(face.begin(), face.end()) - face.begin());
  };
  const auto is_degenerate = [&](const Polygon_soup::Face& face) { return distinct_corners(face) < 3; };
  std::size_t faces = soup.faces.size();
  soup.faces.erase(std::remove_if(soup.faces.begin(), soup.faces.end(), is_degenerate), soup.faces.end());
  const std::size_t degenerate = faces - soup.faces.size(), points = soup.points.size();
  faces = soup.faces.size();
  std::size_t mended = 0, pieces = 0; // a polygon that meets itself may become two, or less than one
  for (const Polygon_soup::Face& face : soup.faces)
    if (distinct_corners(face) < face.size()) {
      ++mended;
      std::vector<Face_soup::Point_3> corners;
      std::vector<Polygon_soup::Face> alone(1);
      for (const std::size_t corner : face) {
        alone[0].push_back(corners.size());
        corners.push_back(soup.points[corner]);
      }
      PMP::repair_polygon_soup(corners, alone);
      pieces += alone.size();
    }
  PMP::repair_polygon_soup(soup.points, soup.faces);
  const std::size_t doubled = faces - mended + pieces - soup.faces.size();
  steps.push_back({Repair_kind::merge_points, {{"points merged with equal ones", merged}}, 0, {}});
  steps.push_back({Repair_kind::drop_faces,
                   {{"faces with a repeated corner dropped", degenerate}, {"doubled faces dropped", doubled},
                    {"polygons with a repeated corner divided there", mended}}, 0, {}});
  steps.push_back({Repair_kind::drop_points, {{"points without faces dropped", points - soup.points.size()}}, 0, {}});
}

/// Makes neighbours agree, and splits edges of more than two faces and vertices of several fans.
/// \post the soup is a 2-manifold with or without boundary
inline Repair_step orient_soup(Polygon_soup& soup) {
  const std::vector<Polygon_soup::Face> before = soup.faces;
  const std::size_t points = soup.points.size();
  CGAL::Polygon_mesh_processing::orient_polygon_soup(soup.points, soup.faces);
  // What corner has been split does not matter: a face that was turned over has its corners the other way round.
  const auto is_turned = [&](std::size_t f) {
    const auto &a = before[f], &b = soup.faces[f];
    const auto at = [&](std::size_t corner) { return soup.points[b[corner % b.size()]]; };
    std::size_t first = 0;
    while (first < b.size() && at(first) != soup.points[a[0]])
      ++first;
    return at(first + 1) != soup.points[a[1]];
  };
  std::size_t turned = 0;
  for (std::size_t f = 0; f < before.size(); ++f)
    turned += is_turned(f);
  return {Repair_kind::orient_faces,
          {{"faces turned over", turned}, {"copies of points made", soup.points.size() - points}}, 0, {}};
}

} // namespace haptic_sculpt::internal
