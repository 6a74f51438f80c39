// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Arguments.h"
#include "Run_result.h"

#include "../common/numbers.h"
#include "../drawing/altitude.h"
#include "../drawing/surface_mesh_arrays.h"
#include "../drawing/write_picture.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace haptic_sculpt::sculpt_program {

/// Whether the picture needs the mesh as it was before the edits.
inline bool needs_before(const Picture_arguments& shown) {
  return shown.before || shown.color == "displacement";
}

namespace pictures {

inline Eigen::Vector3d vector_of(const Edit_record::Coordinates& p) {
  return {p[0], p[1], p[2]};
}

/// What was done: vertices moved, ways made and refused, contacts; and numbers, first of those moved.
inline void add_marks(drawing::Scene& scene, const Mesh& mesh, const Run_result& result, bool with_numbers) {
  constexpr std::size_t most = Edit_record::most_drawn;
  std::vector<bool> is_labelled(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), !with_numbers);
  std::vector<std::size_t> number_of(is_labelled.size());
  for (std::size_t i = 0; i < result.numbers.size(); ++i)
    number_of[static_cast<std::size_t>(result.vertex_order[i])] = result.numbers[i];
  const auto label = [&](std::size_t v) {
    if (!is_labelled[v])
      scene.labels.push_back(
          {drawing::to_eigen(mesh.point(Vertex_index(static_cast<Mesh::size_type>(v)))), std::to_string(number_of[v])});
    is_labelled[v] = true;
  };
  for (std::size_t i = 0; i < result.moved_vertices.size() && i < most; ++i) {
    scene.add_moved_vertex(drawing::to_eigen(mesh.point(result.moved_vertices[i])));
    label(result.moved_vertices[i]);
  }
  for (const auto v : result.vertex_order)
    label(static_cast<std::size_t>(v));
  for (const Edit_record& edit : result.edits) {
    if (edit.status != Edit_record::Status::blocked || edit.way.empty())
      continue;
    std::vector<Eigen::Vector3d> way;
    for (const auto& p : edit.way)
      way.push_back(vector_of(p));
    scene.add_blocked_drag(way, vector_of(edit.motion->target));
    for (const auto& contact : edit.contacts)
      if (vector_of(contact.normal).squaredNorm() > 0)
        scene.add_contact(way.back(), vector_of(contact.normal));
  }
  scene.explain_marks();
}

inline std::string short_number(double x) {
  std::ostringstream text;
  text.precision(3);
  text << x;
  return text.str();
}

/// A share from 0 to 1, light to dark: told apart in greyscale print, too.
inline drawing::Color shade(double share) {
  const drawing::Color steps[] = {
      drawing::colors::surface, {0.98f, 0.72f, 0.30f}, {0.86f, 0.27f, 0.18f}, {0.42f, 0.05f, 0.30f}};
  const double at = 3 * std::fmin(1, std::fmax(0, share));
  const int i = std::min(2, int(at));
  return steps[i] + float(at - i) * (steps[i + 1] - steps[i]);
}

inline void add_scale(drawing::Scene& scene, double share, const std::string& text) {
  scene.legend.push_back({drawing::Legend_entry::Mark::ball, shade(share), text});
}

/// How far each vertex is from where it was. New ones are from where they were created: as if they had not moved.
inline void color_by_displacement(drawing::Scene& scene, const Run_result& result, const drawing::Scene& before,
                                  const std::vector<int>& rank_of_index) {
  std::vector<double> way(scene.points.size(), 0);
  for (std::size_t i = 0; i < result.numbers.size(); ++i)
    if (const std::size_t number = result.numbers[i]; number < before.points.size()) {
      const auto at = static_cast<std::size_t>(rank_of_index[static_cast<std::size_t>(result.vertex_order[i])]);
      way[at] = (scene.points[at] - before.points[number]).stableNorm();
    }
  const double largest = *std::max_element(way.begin(), way.end());
  for (const double w : way)
    scene.point_colors.push_back(shade(largest > 0 ? w / largest : 0));
  add_scale(scene, 0, "not moved");
  add_scale(scene, 1, "moved by " + short_number(largest));
}

/// The least altitude of the triangles at each vertex; infinite where it has none.
inline std::vector<double> altitudes_of(const drawing::Scene& scene) {
  std::vector<double> altitude(scene.points.size(), std::numeric_limits<double>::infinity());
  for (const auto& t : scene.triangles)
    for (int i = 0; i < 3; ++i) {
      const double height =
          drawing::altitude(scene.points[t[i]], scene.points[t[(i + 1) % 3]], scene.points[t[(i + 2) % 3]]);
      for (const int v : t)
        altitude[v] = std::fmin(altitude[v], height);
    }
  return altitude;
}

/// By the logarithm of the altitude, on one scale for all: the lower the darker.
inline void color_by_altitude(std::vector<drawing::Scene>& scenes) {
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> altitudes;
  double least = none, most = 0;
  for (const drawing::Scene& scene : scenes) {
    altitudes.push_back(altitudes_of(scene));
    for (const double h : altitudes.back())
      if (h < none)
        least = std::fmin(least, std::fmax(h, std::numeric_limits<double>::min())), most = std::fmax(most, h);
  }
  const double span = std::log(most) - std::log(least);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (const double h : altitudes[i])
      scenes[i].point_colors.push_back(
          shade(h < none && span > 0 ? (std::log(most) - std::log(std::fmax(h, least))) / span : 0));
  add_scale(scenes.back(), 0, "altitude " + short_number(most));
  add_scale(scenes.back(), 1, "altitude " + short_number(least));
}

/// \pre `at` is empty, a number, "edit" or @X,Y,Z \throw drawing::Picture_error
inline std::optional<Eigen::Vector3d> focus_of(const std::string& at, const Mesh& mesh, const Run_result& result) {
  if (at.empty())
    return std::nullopt;
  if (at == "edit") {
    const Edit_record* found = nullptr;
    for (const Edit_record& edit : result.edits)
      if (edit.motion && (edit.status == Edit_record::Status::blocked || found == nullptr ||
                          found->status != Edit_record::Status::blocked))
        found = &edit;
    if (found == nullptr)
      throw drawing::Picture_error(
          "--picture-at edit: no edit that was carried out has a place of its own (flips, shifts, "
          "moves, brushes and remeshings have none): give a vertex or @X,Y,Z");
    return vector_of(found->motion->stop);
  }
  if (at[0] == '@') {
    return vector_of(examples::place_of(at).value()); // the command line has looked at it
  }
  const std::size_t number = std::strtoull(at.c_str(), nullptr, 10);
  for (std::size_t i = 0; i < result.numbers.size(); ++i)
    if (result.numbers[i] == number)
      return drawing::to_eigen(mesh.point(Vertex_index(static_cast<Mesh::size_type>(result.vertex_order[i]))));
  throw drawing::Picture_error("--picture-at: there is no vertex " + at);
}

} // namespace pictures

/// \param before the mesh before the edits, where needs_before() \throw drawing::Picture_error
inline std::string write_picture_of(const Mesh& mesh, const Run_result& result, const drawing::Scene& before,
                                    const std::string& path, const Picture_arguments& shown) {
  drawing::View view;
  if (!shown.view.empty())
    view.direction = {shown.view[0], shown.view[1], shown.view[2]};
  view.focus = pictures::focus_of(shown.at, mesh, result);
  view.magnification = shown.zoom > 0 ? shown.zoom : view.focus ? 8 : 1;
  std::vector<drawing::Scene> scenes;
  if (shown.before) {
    scenes.push_back(before);
    scenes.back().title = "before";
    view.width = 2 * view.width;
  }
  drawing::Scene after = drawing::scene_of(mesh);
  if (shown.before)
    after.title = "after";
  pictures::add_marks(after, mesh, result, shown.numbers);
  std::vector<int> rank(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), -1);
  int vertices = 0;
  for (const auto v : mesh.vertices())
    rank[std::size_t(v)] = vertices++;
  if (shown.color == "displacement")
    pictures::color_by_displacement(after, result, before, rank);
  scenes.push_back(std::move(after));
  if (shown.color == "altitude")
    pictures::color_by_altitude(scenes);
  return drawing::write_pictures(scenes, path, view);
}

} // namespace haptic_sculpt::sculpt_program
