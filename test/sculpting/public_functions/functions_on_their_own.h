// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/public_functions/Scaled_scene.h"

#include <haptic_sculpt/sculpting/decimate.h>
#include <haptic_sculpt/surface/repair.h>

#include <optional>
#include <vector>

namespace haptic_sculpt::test {

/// Those of headers that no other one includes, for what they take to compile.
inline std::vector<Public_function> functions_on_their_own() {
  std::vector<Public_function> all;
  all.push_back({"decimate", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   // CGAL's own policies multiply six lengths, which no double holds at the ends of the range.
                   const auto cost = [](const auto& profile, const auto&) {
                     return std::optional<double>((7 * profile.v0().idx() + 3 * profile.v1().idx()) % 11);
                   };
                   const auto middle = [](const auto& profile) {
                     return std::optional<Point_3>(CGAL::midpoint(profile.p0(), profile.p1()));
                   };
                   const auto is_enough = [](double, const auto&, std::size_t, std::size_t edges) {
                     return edges <= 72;
                   };
                   const auto report =
                       decimate(sculptor, is_enough, CGAL::parameters::get_cost(cost).get_placement(middle));
                   outcome.number(static_cast<double>(report.collapsed));
                   outcome.number(static_cast<double>(report.refused));
                   outcome.number(report.collapsed > 10);
                   outcome.mesh(scene.mesh);
                 }});
  for (const bool is_mesh : {false, true})
    all.push_back({"repair", [=](double unit, Outcome& outcome) {
                     const Scaled_scene scene(unit);
                     Face_soup whole = face_soup(scene.mesh), soup;
                     soup.points = whole.points;
                     for (std::size_t f = 0; f < whole.number_of_faces(); ++f) {
                       std::vector<Face_soup::Index> face(whole.begin(f), whole.end(f));
                       if (f == 5) // a hole
                         continue;
                       if (!is_mesh && f % 9 == 2) { // open edges: its corners are points of their own
                         for (auto& corner : face) {
                           soup.points.push_back(soup.points[corner]);
                           corner = static_cast<Face_soup::Index>(soup.points.size() - 1);
                         }
                       }
                       soup.add_face(face);
                       if (!is_mesh && f % 20 == 3)
                         soup.add_face(face); // twice
                     }
                     const auto tell_report = [&](const Repair_report& report) {
                       outcome.number(report.is_repaired()), outcome.number(static_cast<double>(report.steps.size()));
                       outcome.length(report.moved), outcome.length(report.removed_distance);
                       outcome.number(static_cast<double>(report.points_added));
                     };
                     if (is_mesh) {
                       Mesh mesh = mesh_of<Mesh>(soup);
                       tell_report(repair(mesh));
                       outcome.mesh(mesh);
                       return;
                     }
                     tell_report(repair(soup, Repair_parameters().gap(scene.length(0x1p-20)).largest_hole(100)));
                     for (const auto& p : soup.points)
                       outcome.length(p.x()), outcome.length(p.y()), outcome.length(p.z());
                     for (const auto corner : soup.corners)
                       outcome.number(corner);
                   }});
  return all;
}

} // namespace haptic_sculpt::test
