// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/repair/mesh_steps.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Draws vertices that are at one point, because the surface was pinched there, apart: each a little towards the middle
/// of its own neighbours. CGAL splits such vertices and leaves them where they are.
class Vertex_separation {
  using Vertex = Work_mesh::Vertex_index;
  using Point = Work_mesh::Point;

  /// Of the way to the middle of the neighbours. To two cones that meet in their tips any serves: this can hardly be
  /// seen, and still is far from what is rounded.
  static constexpr double share = 0x1p-10;
  /// Which vertices of a place move: all, and where surfaces then meet, as cones in each other do, all but one, or one.
  enum Attempt { all, all_but_first, first_only, nobody };

public:
  explicit Vertex_separation(Work_mesh& mesh) : mesh_(mesh) {}

  Repair_step run() {
    std::vector<Vertex> order(mesh_.vertices().begin(), mesh_.vertices().end());
    std::sort(order.begin(), order.end(), [this](Vertex v, Vertex w) {
      const auto c = CGAL::compare_lexicographically_xyz(mesh_.point(v), mesh_.point(w));
      return c == CGAL::SMALLER || (c == CGAL::EQUAL && v < w);
    });
    for (auto begin = order.begin(); begin != order.end();) {
      const Point& here = mesh_.point(*begin);
      const auto end = std::find_if(begin, order.end(), [&](Vertex v) { return mesh_.point(v) != here; });
      if (end - begin > 1)
        places_.push_back({{begin, end}, mesh_.point(*begin), all});
      begin = end;
    }
    std::size_t separated = 0, left = 0;
    if (!places_.empty()) {
      place_of_.assign(mesh_.number_of_vertices() + mesh_.number_of_removed_vertices(), places_.size());
      for (std::size_t i = 0; i < places_.size(); ++i)
        for (const Vertex v : places_[i].vertices)
          place_of_[v] = i;
      set_targets();
      for (int round = 0; round < nobody; ++round) {
        for (const Place& place : places_)
          move(place);
        if (!advance_those_that_meet())
          break;
      }
      for (const Place& place : places_) { // the last attempt may have been put back
        move(place);
        (place.attempt == nobody ? left : separated) += place.vertices.size();
      }
    }
    return {Repair_kind::separate_vertices,
            {{"vertices at one point drawn apart", separated}, {"vertices left at one point", left}}, 0, {}};
  }

private:
  struct Place {
    std::vector<Vertex> vertices;
    Point point;
    Attempt attempt;
    std::vector<Point> targets = {};
  };

  void set_targets() {
    for (Place& place : places_)
      for (const Vertex v : place.vertices) {
        std::array<double, 3> sum = {0, 0, 0};
        double number = 0;
        for (const Vertex w : CGAL::vertices_around_target(v, mesh_)) {
          for (int k = 0; k < 3; ++k)
            sum[k] += mesh_.point(w)[k] - place.point[k];
          ++number;
        }
        std::array<double, 3> x;
        for (int k = 0; k < 3; ++k)
          x[k] = place.point[k] + share * sum[k] / std::max(number, 1.0);
        place.targets.emplace_back(x[0], x[1], x[2]);
      }
  }

  void move(const Place& place) {
    for (std::size_t i = 0; i < place.vertices.size(); ++i) {
      const bool moves = place.attempt == all || (place.attempt == all_but_first && i > 0) ||
                         (place.attempt == first_only && i == 0);
      mesh_.point(place.vertices[i]) = moves ? place.targets[i] : place.point;
    }
  }

  // \return whether there were any
  bool advance_those_that_meet() {
    std::vector<Face_soup::Index> face_name, triangles;
    const Face_soup soup = face_soup(mesh_, &face_name);
    const Meet_improperly meet_improperly(soup);
    std::vector<bool> flat(soup.number_of_faces()), meets(places_.size(), false);
    for (Face_soup::Index f = 0; f < soup.number_of_faces(); ++f) {
      if (soup.number_of_corners(f) != 3)
        continue;
      triangles.push_back(f);
      flat[f] = meet_improperly.is_flat(f);
    }
    const auto mark = [&](Face_soup::Index f) {
      for (const Face_soup::Index* corner = soup.begin(f); corner != soup.end(f); ++corner)
        if (place_of_[*corner] < places_.size())
          meets[place_of_[*corner]] = true;
    };
    for (const auto& [f, g] : improper_intersections(soup, triangles, flat, most_pairs).pairs) {
      mark(f);
      mark(g);
    }
    bool any = false;
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (meets[i] && places_[i].attempt != nobody) {
        places_[i].attempt = static_cast<Attempt>(places_[i].attempt + 1);
        any = true;
      }
    return any;
  }

public:
  /// This many pairs of intersecting faces are looked at, approximately 60 bytes each: there can be as many as the
  /// square of the faces.
  static constexpr std::size_t most_pairs = 4000000;

private:
  Work_mesh& mesh_;
  std::vector<Place> places_;
  std::vector<std::size_t> place_of_;
};

} // namespace haptic_sculpt::internal
