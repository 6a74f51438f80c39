// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mouse.h"

#include "../common/Mesh_file.h"
#include "../common/Run_log.h"
#include "../drawing/surface_mesh_arrays.h"

#include <haptic_sculpt/haptic_rendering/exchange/Loop_scene.h>

#include <atomic>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace haptic_sculpt::window_program {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex_index = Mesh::Vertex_index;
using Face_index = Mesh::Face_index;

/// A mesh, its Sculptor and its log. Made by a thread that may take its time, then the loop's alone.
struct Model : Loop_scene<Mesh> {
  using Face_type = Seen_face;
  using Mask = Mesh::Property_map<Vertex_index, double>;

  std::string path;
  std::vector<std::string> left_out; ///< what its file has and a mesh has not
  std::string log_path; ///< empty: there is none
  examples::Run_log log;
  std::size_t resumed = 0; ///< edits of the log that were there
  std::string note;        ///< for people: what of the log was not made again
  std::uint64_t edits = 0; ///< ticks that changed the mesh
  /// How much of a vertex brushes leave alone, from 0 to 1. Nothing of the mesh: it is not undone, saved or logged.
  Mask mask = mesh.add_property_map<Vertex_index, double>("v:mask_of_brushes", 0.0).first;
  double edge_length = 0; ///< mean, of the mesh as it came
  /// By the window's thread, for what takes long: how often it was to be broken off; and that all ends.
  std::atomic<unsigned> times_broken_off{0};
  std::atomic<bool> ends{false};

  /// \param found takes what the file has and a mesh has not \throw what reading meshes and logs throws
  Model(const examples::Mesh_file& file, const std::string& log, std::vector<std::string> found = {});

  /// Lit by the faces about each corner that differ by less than a crease.
  Seen_face face(std::uint32_t index) const;
  /// What is seen of these faces has changed, not the mesh.
  void show_again(Vertex_index v) {
    for (const Face_index f : mesh.faces_around_target(mesh.halfedge(v)))
      sculptor.visitor().mark(f), ++changes_;
  }

  /// After each tick: counts those that changed something. \param held the vertex in hand, if any: how faces near it
  /// are lit changes, too
  void end_tick(Vertex_index held) {
    const std::uint64_t changes = sculptor.visitor().changed.number();
    edits += changes != changes_;
    if (std::exchange(changes_, changes) != changes && held.is_valid())
      for (const Vertex_index v : mesh.vertices_around_target(mesh.halfedge(held)))
        show_again(v);
  }

  double extent() const { return (upper - lower).stableNorm(); }

private:
  std::uint64_t changes_ = 0; ///< of the mesh, before the tick under way
  double unit_ = 1;           ///< a power of two that brings lengths of the mesh near 1: so are squares of them

  Eigen::Vector3d normal_of(Face_index f) const;
};

using Scene = Model;

} // namespace haptic_sculpt::window_program
