// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_MODEL_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_MODEL_H

#include "Mouse.h"

#include "../drawing/surface_mesh_arrays.h"
#include "../haptic_loop/Run_log.h"

#include <haptic_sculpt/haptic_rendering/exchange/Loop_scene.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <memory>

namespace haptic_sculpt::window_program {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex_index = Mesh::Vertex_index;
using Face_index = Mesh::Face_index;

using Scene = Loop_scene<Mesh>;

/// A mesh, its Sculptor and its log. Made by a thread that may take its time, then the loop's alone.
struct Model : Scene {
  /// Where a brush wants the vertices of a dab.
  using Targets = Mesh::Property_map<Vertex_index, Kernel::Point_3>;

  std::string path;
  std::string log_path; ///< empty: there is none
  loop_program::Run_log log;
  std::size_t resumed = 0; ///< edits of the log that were there
  std::string note;        ///< for people: what of the log was not made again
  std::uint64_t edits = 0; ///< ticks that changed the mesh
  Targets targets = mesh.add_property_map<Vertex_index, Kernel::Point_3>("v:target_of_brush").first;

  /// \throw what reading meshes and logs throws
  Model(const std::string& path, const std::string& log);

  /// After each tick: counts those that changed something.
  void end_tick() {
    const std::uint64_t changes = sculptor.visitor().changed.number();
    edits += changes != changes_;
    changes_ = changes;
  }

  double extent() const { return (upper - lower).stableNorm(); }

private:
  std::uint64_t changes_ = 0; ///< of the mesh, before the tick under way
};

} // namespace haptic_sculpt::window_program

#endif
