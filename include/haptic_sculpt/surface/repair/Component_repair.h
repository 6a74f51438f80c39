// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/orient_components.h>
#include <haptic_sculpt/surface/repair/Crossing_removal.h>
#include <haptic_sculpt/surface/repair/order_by_places.h>

#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Resolves what intersects in a soup of triangles, component by component: those that meet themselves, and then those
/// that meet others, which are united. Components that meet nothing are not touched.
class Component_repair {
  using Index = Face_soup::Index;

public:
  /// \pre the soup is a 2-manifold of triangles, with or without boundary
  Component_repair(const Face_soup& soup, Trail& trail) : soup_(soup), trail_(trail) {}

  /// Appends steps. \return the soup afterwards
  Face_soup run(std::vector<Repair_step>& steps) {
    collect();
    if (meeting_.empty() && crossed_.empty())
      return soup_;
    find_sheets();
    if (sheets_.size() == number_of_components_)
      return soup_; // it holds nothing
    steps.push_back({Repair_kind::drop_sheets, {{"components without volume dropped", sheets_.size()}}, 0, {}});
    split();
    steps.push_back(resolve());
    steps.push_back(unite());
    Face_soup result;
    for (const Work_mesh& mesh : meshes_)
      append(face_soup(mesh), result);
    trail_.keep(result.points); // both only take points away, and add
    return result;
  }

private:
  void collect() {
    Disjoint_sets sets = Soup_connectivity(soup_).components();
    std::map<Index, std::size_t> number;
    std::vector<Index> triangles(soup_.number_of_faces());
    std::vector<bool> flat(triangles.size());
    const Meet_improperly meet_improperly(soup_);
    component_of_.resize(triangles.size());
    for (Index f = 0; f < triangles.size(); ++f) {
      component_of_[f] = number.emplace(sets.find(*soup_.begin(f)), number.size()).first->second;
      triangles[f] = f;
      flat[f] = meet_improperly.is_flat(f);
    }
    number_of_components_ = number.size();
    for (const auto& [f, g] : improper_intersections(soup_, triangles, flat, Vertex_separation::most_pairs).pairs) {
      const auto pair = std::minmax(component_of_[f], component_of_[g]);
      ++(pair.first == pair.second ? crossed_[pair.first] : meeting_[{pair.first, pair.second}]);
    }
  }

  // Loose faces and walls in the inside: closed by faces upon themselves, they enclose nothing, and so meet themselves.
  void find_sheets() {
    std::map<std::size_t, std::vector<Index>> faces;
    for (Index f = 0; f < soup_.number_of_faces(); ++f)
      if (crossed_.count(component_of_[f]) != 0)
        faces[component_of_[f]].push_back(f);
    for (const auto& [c, of_component] : faces)
      if (volume_sign(soup_, of_component) == CGAL::ZERO && is_closed(of_component)) // else the sign says nothing
        sheets_.insert(c);
    for (const std::size_t c : sheets_)
      crossed_.erase(c);
    for (auto meeting = meeting_.begin(); meeting != meeting_.end();)
      meeting = sheets_.count(meeting->first.first) + sheets_.count(meeting->first.second) > 0 ? meeting_.erase(meeting)
                                                                                           : std::next(meeting);
  }

  bool is_closed(const std::vector<Index>& faces) const {
    std::set<std::pair<Index, Index>> arcs;
    for (const Index f : faces)
      for (int i = 0; i < 3; ++i)
        arcs.emplace(soup_.begin(f)[i], soup_.begin(f)[(i + 1) % 3]);
    return std::all_of(arcs.begin(), arcs.end(),
                       [&](const auto& arc) { return arcs.count({arc.second, arc.first}) != 0; });
  }

  static void append(const Face_soup& part, Face_soup& soup) {
    std::vector<Index> number(part.points.size(), static_cast<Index>(-1));
    for (std::size_t f = 0; f < part.number_of_faces(); ++f) {
      for (const Index* corner = part.begin(f); corner != part.end(f); ++corner) {
        if (number[*corner] == static_cast<Index>(-1)) {
          number[*corner] = static_cast<Index>(soup.points.size());
          soup.points.push_back(part.points[*corner]);
        }
        soup.corners.push_back(number[*corner]);
      }
      soup.close_face();
    }
  }

  // The mesh of each component.
  void split() {
    std::vector<Polygon_soup> parts(number_of_components_, Polygon_soup(Face_soup()));
    std::vector<std::size_t> number(soup_.points.size(), static_cast<std::size_t>(-1));
    for (Index f = 0; f < soup_.number_of_faces(); ++f) {
      Polygon_soup& part = parts[component_of_[f]];
      part.faces.emplace_back();
      for (const Index* corner = soup_.begin(f); corner != soup_.end(f); ++corner) {
        if (number[*corner] == static_cast<std::size_t>(-1)) {
          number[*corner] = part.points.size();
          part.points.push_back(soup_.points[*corner]);
        }
        part.faces.back().push_back(number[*corner]);
      }
    }
    for (std::size_t c = 0; c < parts.size(); ++c)
      meshes_.push_back(sheets_.count(c) == 0 ? work_mesh(parts[c]) : Work_mesh());
  }

  Repair_step resolve() {
    std::size_t crossed = 0, removed = 0, added = 0, left = 0;
    std::string failure;
    for (const auto& [c, pairs] : crossed_) {
      crossed += pairs;
      Work_mesh copy = meshes_[c];
      try {
        if (!CGAL::is_closed(copy) || !Crossing_removal::run(copy)) {
          ++left;
          continue;
        }
      } catch (const CGAL::Failure_exception& error) {
        failure = error.what();
        continue;
      }
      removed += meshes_[c].number_of_faces();
      added += copy.number_of_faces();
      meshes_[c] = std::move(copy);
    }
    return {Repair_kind::resolve_self_intersections,
            {{"pairs of faces of a component that met", crossed}, {"components where some are left", left},
             {"faces before", removed}, {"faces after", added}}, 0, failure};
  }

  /// Unites the solids that components bound. Corefinement asks that what it is given is a surface, with the normals
  /// out of the solid: of what crosses itself or has a hole it may end the process, or go on for ever.
  Repair_step unite() {
    namespace PMP = CGAL::Polygon_mesh_processing;
    std::size_t united = 0, failed = 0;
    std::string failure;
    std::vector<std::size_t> now(meshes_.size()); // the mesh that a component has become part of
    std::iota(now.begin(), now.end(), std::size_t(0));
    std::vector<std::optional<bool>> known(meshes_.size()); // looked at once: each may meet many
    const auto is_sound = [&](std::size_t c) {
      if (!known[c])
        known[c] = validate(meshes_[c], 0, 1).is_valid();
      return *known[c];
    };
    for (const auto& meeting : meeting_) {
      const std::size_t a = now[meeting.first.first], b = now[meeting.first.second];
      if (a == b)
        continue;
      if (!is_sound(a) || !is_sound(b)) {
        ++failed;
        continue;
      }
      Work_mesh one = meshes_[a], other = meshes_[b], sum;
      orient_components(one);
      orient_components(other);
      try {
        if (!PMP::corefine_and_compute_union(one, other, sum) || !inconsistent_elements(sum).empty()) {
          ++failed;
          continue;
        }
      } catch (const CGAL::Failure_exception& error) {
        failure = error.what();
        continue;
      }
      ++united;
      Polygon_soup soup(face_soup(sum));
      order_by_places(soup);
      // Where vertices of the sum are pinched it stays as it is: another round splits them.
      const bool is_mesh = PMP::is_polygon_soup_a_polygon_mesh(soup.faces);
      meshes_[a] = is_mesh ? work_mesh(soup) : std::move(sum);
      meshes_[b].clear();
      known[a].reset();
      for (std::size_t& c : now)
        if (c == b)
          c = a;
    }
    return {Repair_kind::unite_solids,
            {{"times two solids were united", united}, {"pairs that could not be united", failed}}, 0, failure};
  }

  const Face_soup& soup_;
  Trail& trail_;
  std::size_t number_of_components_ = 0;
  std::vector<std::size_t> component_of_; // of each face
  std::map<std::size_t, std::size_t> crossed_;                         // pairs of faces within a component
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> meeting_; // pairs of faces of two components
  std::set<std::size_t> sheets_;                                       // components without volume
  std::vector<Work_mesh> meshes_;
};

} // namespace haptic_sculpt::internal
