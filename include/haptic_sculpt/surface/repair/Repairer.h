// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/orient_components.h>
#include <haptic_sculpt/surface/repair/Component_repair.h>
#include <haptic_sculpt/surface/repair/Unit_scale.h>
#include <haptic_sculpt/surface/repair/close_gaps.h>
#include <haptic_sculpt/surface/repair/distance_to_surface.h>

#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Carries out repair() on a copy of a soup. \pre its points are finite and in range, its corners are indices of points
class Repairer {
public:
  Repairer(const Face_soup& soup, const Repair_parameters& parameters)
      : soup_(soup), parameters_(parameters), scale_(soup, parameters.gap_length), trail_(soup) {
    scale_.down(soup_);
    trail_ = Trail(soup_);
    if (parameters_.gap_length)
      parameters_.gap_length = std::fmin(scale_.down(*parameters_.gap_length), haptic_sculpt::largest_coordinate);
  }

  Repair_report run() {
    Repair_report report;
    report.points_before = trail_.size();
    const bool has_faces = soup_.number_of_faces() > 0;
    Places_of_faces last, now;
    for (int round = 0; round < most_rounds; ++round) {
      std::vector<Repair_step> steps;
      run_round(steps, round == 0);
      if (round > 0 && (now = places_of_faces()) == last)
        break; // it undid what it did, and the next one would do so, too
      bool did = false;
      for (Repair_step& step : steps) {
        did = did || step.did_something();
        step.moved = scale_.up(step.moved);
        if (step.did_something())
          report.steps.push_back(std::move(step));
      }
      if (!did || validate_soup(soup_, 0, 1).is_valid())
        break;
      last = round > 0 ? std::move(now) : places_of_faces();
    }
    if (const std::size_t turned = turn_components(soup_); turned > 0)
      report.steps.push_back({Repair_kind::orient_solids, {{"components turned", turned}}, 0, {}});
    const std::vector<Trail::Point> removed = trail_.removed();
    report.moved = scale_.up(trail_.moved());
    report.points_removed = removed.size();
    report.removed_distance = removed.empty() ? 0 : scale_.up(farthest_from_surface(removed, soup_));
    report.points_added = trail_.number_of_new(soup_.points);
    scale_.up(soup_);
    report.left = validate_soup(soup_, parameters_.delta_length);
    report.has_vanished = has_faces && soup_.number_of_faces() == 0;
    return report;
  }

  /// What it came to.
  Face_soup& soup() { return soup_; }

private:
  /// A step may make work for one before it: a union rounds its points. What is not done then goes round in circles.
  static constexpr int most_rounds = 4;

  using Places_of_faces = std::vector<std::vector<Face_soup::Point_3>>;

  /// Whatever the order of points and faces, and which corner is the first.
  Places_of_faces places_of_faces() const {
    Places_of_faces places(soup_.number_of_faces());
    for (std::size_t f = 0; f < places.size(); ++f) {
      for (const auto* corner = soup_.begin(f); corner != soup_.end(f); ++corner)
        places[f].push_back(soup_.points[*corner]);
      std::rotate(places[f].begin(), std::min_element(places[f].begin(), places[f].end()), places[f].end());
    }
    std::sort(places.begin(), places.end());
    return places;
  }

  void run_round(std::vector<Repair_step>& steps, bool closes_gaps) {
    Polygon_soup polygons(soup_);
    clean_soup(polygons, steps);
    if (closes_gaps) {
      steps.push_back(Gap_closer(polygons, parameters_).run(trail_));
      if (steps.back().did_something()) { // which has counted the points that are equal now
        std::vector<Repair_step> again;
        clean_soup(polygons, again);
        steps.insert(steps.end(), again.begin() + 1, again.end());
      }
    }
    trail_.keep(polygons.points);
    steps.push_back(orient_soup(polygons));
    soup_ = polygons.face_soup();
    Work_mesh mesh = work_mesh(polygons);
    const auto change = [&](Repair_kind kind, const auto& function) {
      Work_mesh copy = mesh;
      std::vector<Trail::Move> moves;
      try {
        const Vertex_marks marks(copy);
        steps.push_back(function(copy));
        if (!steps.back().did_something())
          return;
        if (!inconsistent_elements(copy).empty()) {
          steps.back() = {kind, {}, 0, "the half-edges contradict each other"};
          return;
        }
        marks.append_moves(moves);
      } catch (const CGAL::Failure_exception& error) {
        steps.push_back({kind, {}, 0, error.what()});
        return;
      }
      steps.back().moved = trail_.follow(std::move(moves));
      copy.collect_garbage();
      mesh = std::move(copy);
    };
    change(Repair_kind::divide_faces, divide_faces);
    change(Repair_kind::stitch_edges, stitch_edges);
    if (CGAL::is_triangle_mesh(mesh)) // some polygons cannot be divided
      change(Repair_kind::remove_degenerate_faces, remove_degenerate);
    change(Repair_kind::close_holes, [&](Work_mesh& m) { return close_holes(m, parameters_.hole_limit); });
    change(Repair_kind::separate_vertices, [](Work_mesh& m) { return Vertex_separation(m).run(); });
    soup_ = face_soup(mesh);
    // Two edges of a mesh may have the same ends after these steps: the next round splits them.
    if (CGAL::is_triangle_mesh(mesh) &&
        CGAL::Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(Polygon_soup(soup_).faces))
      soup_ = Component_repair(soup_, trail_).run(steps);
  }

  Face_soup soup_;
  Repair_parameters parameters_;
  Unit_scale scale_;
  Trail trail_;
};

} // namespace haptic_sculpt::internal
