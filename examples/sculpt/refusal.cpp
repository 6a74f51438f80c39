// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.h"


#include "../common/Result_writer.h"
#include "../common/numbers.h"
#include "../common/write_file.h"
#include "../drawing/write_picture.h"

#include <haptic_sculpt/version.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace haptic_sculpt::sculpt_program {
namespace {

using Json = nlohmann::ordered_json;

template <class Index>
Json json_of_element(Index index) {
  return static_cast<std::size_t>(index);
}
template <class Index>
Json json_of_element(const std::pair<Index, Index>& pair) {
  return {static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second)};
}
template <class List>
Json json_of_list(const List& list) {
  Json elements = Json::array();
  for (const auto& element : list)
    elements.push_back(json_of_element(element));
  return elements;
}

std::string refusal_json(const std::string& mesh, const Validity_report& report) {
  Json faults = Json::object();
  for_each_kind_of_fault(report, [&](const char* key, const auto& list) { faults[key] = json_of_list(list); });
  const Json all = {{"version", HAPTIC_SCULPT_VERSION},
                    {"refused", mesh},
                    {"number_of_faults", report.number_of_faults()},
                    {"delta", report.delta},
                    {"faults", std::move(faults)},
                    {"isolated_vertices", json_of_list(report.isolated_vertices)}};
  return all.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n'; // the name of a file may be no UTF-8
}

/// The faces, but for those with a corner that is no place: at fault red, with corners of their own.
class Fault_scene {
  using Index = Face_soup::Index;
  static constexpr std::size_t most_marks = 2000; // of a kind; a picture shows no more
  static constexpr double edge_radius = 2.5, vertex_radius = 6;

public:
  Fault_scene(const Face_soup& soup, const Validity_report& report)
      : soup_(soup), is_red_(soup.number_of_faces(), false) {
    for (const auto* const list : {&report.non_triangular_faces, &report.degenerate_faces, &report.low_faces})
      for (const auto f : *list)
        is_red_[f] = true;
    for (const auto& [f, g] : report.intersecting_faces)
      is_red_[f] = is_red_[g] = true;
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      scene_.points.push_back(soup.is_finite(v) ? place(v) : Eigen::Vector3d::Zero());
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
      add_face(f);
    scene_.point_colors.resize(scene_.points.size(), drawing::colors::red);
    std::fill_n(scene_.point_colors.begin(), soup.points.size(), drawing::colors::surface);
    for (const auto* const list :
         {&report.boundary_edges, &report.non_manifold_edges, &report.inconsistently_oriented_edges})
      for (std::size_t i = 0; i < list->size() && i < most_marks; ++i)
        add_edge((*list)[i].first, (*list)[i].second);
    for (std::size_t i = 0; i < report.non_manifold_vertices.size() && i < most_marks; ++i)
      add_vertex(report.non_manifold_vertices[i]);
    for (std::size_t i = 0; i < report.isolated_vertices.size() && i < most_marks; ++i)
      add_vertex(report.isolated_vertices[i]);
    for (std::size_t i = 0; i < report.coincident_vertices.size() && i < most_marks; ++i)
      add_vertex(report.coincident_vertices[i].first);
    scene_.title =
        std::to_string(report.number_of_faults()) + (report.has_more_intersections ? " faults at least" : " faults");
    scene_.legend.push_back(
        {drawing::Legend_entry::Mark::ball, drawing::colors::red, "faces, edges and vertices at fault"});
  }

  const drawing::Scene& scene() const { return scene_; }

private:
  Eigen::Vector3d place(std::size_t v) const { return {soup_.points[v].x(), soup_.points[v].y(), soup_.points[v].z()}; }
  bool is_somewhere(std::size_t f) const {
    return std::all_of(soup_.begin(f), soup_.end(f), [this](Index v) { return soup_.is_finite(v); });
  }
  void add_face(std::size_t f) {
    if (soup_.number_of_corners(f) < 3 || !is_somewhere(f))
      return;
    std::vector<int> corners(soup_.begin(f), soup_.end(f));
    if (is_red_[f])
      for (int& corner : corners) {
        const Eigen::Vector3d p = scene_.points[static_cast<std::size_t>(corner)];
        corner = static_cast<int>(scene_.points.size());
        scene_.points.push_back(p);
      }
    for (std::size_t i = 2; i < corners.size(); ++i)
      scene_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  void add_edge(std::size_t v, std::size_t w) {
    if (soup_.is_finite(v) && soup_.is_finite(w))
      scene_.segments.push_back({place(v), place(w), drawing::colors::red, edge_radius});
  }
  void add_vertex(std::size_t v) {
    if (soup_.is_finite(v))
      scene_.balls.push_back({place(v), drawing::colors::red, vertex_radius});
  }

  const Face_soup& soup_;
  std::vector<bool> is_red_;
  drawing::Scene scene_;
};

/// As of a mesh that is not refused, as far as it can be: vertices have numbers, and no edit has been made.
drawing::View view_of(const Picture_arguments& shown, const Face_soup& soup) {
  drawing::View view;
  if (!shown.view.empty())
    view.direction = {shown.view[0], shown.view[1], shown.view[2]};
  if (!shown.at.empty() && shown.at[0] == '@')
    view.focus = [&] {
      const auto p = examples::place_of(shown.at).value(); // the command line has looked at it
      return Eigen::Vector3d(p[0], p[1], p[2]);
    }();
  else if (!shown.at.empty() && shown.at != "edit") {
    const std::size_t v = std::strtoull(shown.at.c_str(), nullptr, 10);
    if (v >= soup.points.size() || !soup.is_finite(v))
      throw drawing::Picture_error("--picture-at: there is no vertex " + shown.at + " at a finite place");
    view.focus = Eigen::Vector3d(soup.points[v].x(), soup.points[v].y(), soup.points[v].z());
  }
  view.magnification = shown.zoom > 0 ? shown.zoom : view.focus ? 8 : 1;
  return view;
}

} // namespace

void write_refusal(const Arguments& arguments, const Face_soup& soup, const Validity_report& report) {
  examples::Result_writer writer("sculpt");
  writer.write(arguments.picture, [&](const std::string& path) {
    return drawing::write_picture(Fault_scene(soup, report).scene(), path, view_of(arguments.shown, soup));
  });
  writer.write(arguments.report, [&](const std::string& path) {
    return examples::write_file(path, refusal_json(arguments.mesh, report));
  });
}

} // namespace haptic_sculpt::sculpt_program
