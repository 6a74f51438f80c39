// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WRITE_RESULTS_H
#define HAPTIC_SCULPT_EXAMPLES_WRITE_RESULTS_H

#include "Arguments.h"
#include "Report.h"
#include "Run_result.h"
#include "comparison.h"

#include "../drawing/surface_mesh_arrays.h"
#include "../drawing/write_picture.h"

#include <haptic_sculpt/surface/io/replace_file.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <iostream>

namespace haptic_sculpt::sculpt_program {

/// \param with_numbers those of the vertices are written beside them, where there is room: first of those moved
inline std::string write_picture_of(const Mesh& mesh, const Run_result& result, const std::string& path,
                                    bool with_numbers) {
  drawing::Scene scene = drawing::scene_of(mesh);
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
  const auto vector = [](const Edit_record::Coordinates& p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  for (const Edit_record& edit : result.edits) {
    if (edit.status != Edit_record::Status::blocked || edit.way.empty())
      continue;
    std::vector<Eigen::Vector3d> way;
    for (const auto& p : edit.way)
      way.push_back(vector(p));
    scene.add_blocked_drag(way, vector(edit.motion->target));
    for (const auto& contact : edit.contacts)
      if (vector(contact.normal).squaredNorm() > 0)
        scene.add_contact(way.back(), vector(contact.normal));
  }
  scene.explain_marks();
  return drawing::write_picture(scene, path);
}

/// Writes what was asked for. A file that cannot be written does not keep the others from being written: the work is
/// done. The report comes last, with what there is to say of the others.
inline bool write_all(const Mesh& mesh, const Run_result& result, const Arguments& arguments,
                      std::vector<std::string>& notes, const std::vector<Near_vertex>& nearest,
                      const std::optional<Mesh>& without_guard) {
  bool all_written = true;
  const auto note = [&](const std::string& text) {
    std::cerr << "sculpt: " << text << '\n';
    notes.push_back(text);
  };
  const auto attempt = [&](const std::string& path, const auto& write) {
    if (path.empty())
      return;
    try {
      if (const std::string lost = write(path); !lost.empty())
        note(lost);
      return;
    } catch (const Write_error& error) {
      note(error.what());
    } catch (const drawing::Picture_error& error) {
      note(error.what());
    }
    all_written = false;
  };
  attempt(arguments.out, [&](const std::string& path) {
    Write_options options;
    options.vertex_order = result.vertex_order;
    return write_surface(path, mesh, options);
  });
  attempt(arguments.picture,
          [&](const std::string& path) { return write_picture_of(mesh, result, path, arguments.numbers); });
  attempt(arguments.comparison,
          [&](const std::string& path) { return write_comparison(*without_guard, mesh, path); });
  attempt(arguments.report,
          [&](const std::string& path) { return replace_file(path, report_of(result, notes, nearest)); });
  return all_written;
}

} // namespace haptic_sculpt::sculpt_program

#endif
