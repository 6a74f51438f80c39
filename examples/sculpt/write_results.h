// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WRITE_RESULTS_H
#define HAPTIC_SCULPT_EXAMPLES_WRITE_RESULTS_H

#include "Arguments.h"
#include "Report.h"
#include "Run_result.h"

#include "../drawing/surface_mesh_arrays.h"
#include "../drawing/write_picture.h"

#include <haptic_sculpt/surface/io/replace_file.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <iostream>

namespace haptic_sculpt::sculpt_program {

inline std::string write_picture_of(const Mesh& mesh, const Run_result& result, const std::string& path) {
  drawing::Scene scene = drawing::scene_of(mesh);
  constexpr std::size_t most = 2000; // marks beyond this hide the mesh, and cost a few hundred triangles each
  for (std::size_t i = 0; i < result.moved_vertices.size() && i < most; ++i)
    scene.add_moved_vertex(drawing::to_eigen(mesh.point(result.moved_vertices[i])));
  const auto vector = [](const Edit_record::Coordinates& p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  std::size_t marks = 0;
  for (const Edit_record& edit : result.edits) {
    if (edit.status != Edit_record::Status::blocked)
      continue;
    if (++marks > most)
      break;
    const Eigen::Vector3d stop = vector(edit.motion->stop);
    scene.add_blocked_drag(vector(edit.motion->start), stop, vector(edit.motion->target));
    for (const auto& contact : edit.contacts)
      if (vector(contact.normal).squaredNorm() > 0)
        scene.add_contact(stop, vector(contact.normal));
  }
  return drawing::write_picture(scene, path);
}

/// Writes what was asked for. A file that cannot be written does not keep the others from being written: the work is
/// done. The report comes last, with what there is to say of the others.
inline bool write_all(const Mesh& mesh, const Run_result& result, const Arguments& arguments,
                      std::vector<std::string>& notes) {
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
  attempt(arguments.picture, [&](const std::string& path) { return write_picture_of(mesh, result, path); });
  attempt(arguments.report, [&](const std::string& path) { return replace_file(path, report_of(result, notes)); });
  return all_written;
}

} // namespace haptic_sculpt::sculpt_program

#endif
