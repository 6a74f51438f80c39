// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison.h"

#include "nearest_vertices.h"

#include "../drawing/occlusion.h"
#include "../drawing/surface_mesh_arrays.h"
#include "../drawing/write_picture.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <boost/iterator/function_output_iterator.hpp>

#include <numeric>
#include <unordered_map>

namespace haptic_sculpt::sculpt_program {
namespace {

using Kind = Command::Kind;

/// The vertex of a line; not in the mesh where there is none of that number.
std::size_t vertex_of(const Mesh& mesh, const Command& command) {
  std::size_t v = command.edit.vertices[0];
  if (!command.places.empty()) {
    std::vector<std::size_t> all(mesh.number_of_vertices());
    std::iota(all.begin(), all.end(), std::size_t(0));
    const auto& p = command.places[0].point;
    const auto point_of = [&](std::size_t i) { return mesh.point(Vertex_index(static_cast<Mesh::size_type>(i))); };
    v = nearest_vertices(std::move(all), point_of, Kernel::Point_3(p[0], p[1], p[2]), 1).at(0);
  }
  return v;
}

void drag(Mesh& mesh, const Command& command) {
  const std::size_t v = vertex_of(mesh, command);
  const auto& target = command.edit.point;
  if (v < mesh.number_of_vertices())
    mesh.point(Vertex_index(static_cast<Mesh::size_type>(v))) = Kernel::Point_3(target[0], target[1], target[2]);
}

void move(Mesh& mesh, const Command& command) {
  const std::size_t v = vertex_of(mesh, command);
  const auto& way = command.edit.point;
  if (v < mesh.number_of_vertices())
    for (const Vertex_index w : component_of(mesh, Vertex_index(static_cast<Mesh::size_type>(v))))
      if (const auto p = mesh.point(w) + Kernel::Vector_3(way[0], way[1], way[2]); is_in_range({p.x(), p.y(), p.z()}))
        mesh.point(w) = p;
}

/// The vertices of components whose normals point into the solid.
std::vector<bool> inside_out_vertices(const Mesh& mesh) {
  std::vector<bool> found(mesh.number_of_vertices(), false);
  for (const auto f : validate(mesh, 0, 1).inside_out_components)
    for (const Vertex_index v :
         component_of(mesh, mesh.target(mesh.halfedge(Mesh::Face_index(static_cast<Mesh::size_type>(f))))))
      found[v] = true;
  return found;
}

void dab(Mesh& mesh, const Command& command, const std::vector<bool>& inside_out) {
  std::unordered_map<Vertex_index, Kernel::Point_3> targets;
  const auto brush = dab_of(command);
  Vertex_index nearest;
  const auto distance = [&](Vertex_index v) { return brush.squared_share(mesh.point(v)); };
  for (const Vertex_index v : mesh.vertices())
    if (!nearest.is_valid() || distance(v) < distance(nearest))
      nearest = v;
  if (nearest.is_valid())
    fill_brush_targets(touched_vertices(mesh, brush, nearest), mesh, brush,
                       boost::associative_property_map<decltype(targets)>(targets),
                       boost::static_property_map<double, Vertex_index>(1.0), inside_out[nearest]);
  for (const auto& [v, target] : targets)
    if (is_in_range({target.x(), target.y(), target.z()}))
      mesh.point(v) = target;
}

struct Pairs {
  std::size_t number = 0;
  std::vector<bool> is_red; ///< by face
};

Pairs self_intersecting_pairs(const Mesh& mesh) {
  Pairs result{0, std::vector<bool>(mesh.num_faces(), false)};
  const auto add = [&](const std::pair<Mesh::Face_index, Mesh::Face_index>& pair) { // too many for a list
    ++result.number;
    result.is_red[pair.first] = result.is_red[pair.second] = true;
  };
  CGAL::Polygon_mesh_processing::self_intersections(mesh, boost::make_function_output_iterator(add));
  return result;
}

/// Smooth, with crevices darker, but for what is red. Each face has corners of its own, so that it may have a colour of
/// its own.
drawing::Scene scene_with_pairs(const Mesh& mesh, const Pairs& pairs) {
  drawing::Scene scene;
  scene.edge_opacity = 0;
  const auto open = drawing::openness(mesh);
  std::vector<Eigen::Vector3d> normals(mesh.num_vertices());
  for (const auto v : mesh.vertices())
    normals[v] = drawing::to_eigen(vertex_normal(mesh, v));
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners;
    int i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      corners[i++] = static_cast<int>(scene.points.size());
      scene.points.push_back(drawing::to_eigen(mesh.point(v)));
      scene.point_normals.push_back(normals[v]);
      scene.point_colors.push_back(pairs.is_red[f] ? drawing::colors::red : open[v] * drawing::colors::surface);
    }
    scene.triangles.push_back(corners);
  }
  return scene;
}

std::string told(const char* how, std::size_t pairs) {
  return std::string(how) + ": " + std::to_string(pairs) + (pairs == 1 ? " self-intersection" : " self-intersections");
}

} // namespace

Mesh sculpted_without_guard(Mesh mesh, const std::vector<Command>& script, const std::string& name) {
  const std::vector<bool> inside_out = inside_out_vertices(mesh);
  for (const Command& command : script)
    switch (command.kind) {
    case Kind::move: move(mesh, command); break;
    case Kind::brush: dab(mesh, command, inside_out); break;
    case Kind::edit:
      if (command.edit.kind == Edit_kind::move)
        drag(mesh, command);
      if (command.edit.kind == Edit_kind::move || command.edit.kind == Edit_kind::stroke ||
          command.edit.kind == Edit_kind::end)
        break;
      [[fallthrough]];
    case Kind::remesh:
      throw Script_error(name, command.line, 1,
                         std::string("'") + name_of(command) +
                             "' does more than to move vertices: --compare takes "
                             "scripts of drags, moves and brushes only");
    default: break;
    }
  return mesh;
}

std::string write_comparison(const Mesh& without_guard, const Mesh& with_guard, const std::string& path,
                             const std::vector<double>& direction) {
  drawing::View view;
  if (!direction.empty())
    view.direction = {direction[0], direction[1], direction[2]};
  view.width = 1500, view.height = 800;
  const Pairs left = self_intersecting_pairs(without_guard), right = self_intersecting_pairs(with_guard);
  std::vector<drawing::Scene> scenes = {scene_with_pairs(without_guard, left), scene_with_pairs(with_guard, right)};
  using Mark = drawing::Legend_entry::Mark;
  scenes.back().legend = {{Mark::ball, drawing::colors::red, told("without the guard", left.number)},
                          {Mark::ball, drawing::colors::blue, told("the same script, with it", right.number)}};
  return drawing::write_pictures(scenes, path, view);
}

} // namespace haptic_sculpt::sculpt_program
