// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_MODEL_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_MODEL_H

#include "Log_thread.h"
#include "exchange.h"

#include <haptic_sculpt/haptic_rendering/exchange/Scene_teller.h>
#include <haptic_sculpt/haptic_rendering/finding_and_placing.h>
#include <haptic_sculpt/sculpting.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <memory>

namespace haptic_sculpt::window_program {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex_index = Mesh::Vertex_index;
using Face_index = Mesh::Face_index;

/// Which faces have changed since the window was told, each once, in the order in which they changed first.
class Dirty_faces {
public:
  void mark(std::size_t face) {
    if (face >= is_dirty_.size())
      is_dirty_.resize(face + 1, false);
    if (is_dirty_[face])
      return;
    is_dirty_[face] = true;
    waiting_.push_back(static_cast<std::uint32_t>(face));
  }
  std::size_t size() const { return waiting_.size() - next_; }
  std::uint32_t front() const { return waiting_[next_]; }
  void pop() {
    is_dirty_[waiting_[next_++]] = false;
    if (next_ == waiting_.size())
      waiting_.clear(), next_ = 0;
  }

private:
  std::vector<bool> is_dirty_;
  std::vector<std::uint32_t> waiting_;
  std::size_t next_ = 0;
};

/// What the Sculptor tells: faces become dirty, moves are listed where a caller asks for them, and a copy under way
/// (Scene_teller) follows.
struct Face_watch : Scene_teller<Mesh> {
  struct Move {
    Vertex_index vertex;
    Kernel::Point_3 point;
  };
  const Mesh* mesh;
  Dirty_faces* dirty;
  std::vector<Move>* moves = nullptr;

  Face_watch(const Mesh& mesh, Dirty_faces& dirty)
      : Scene_teller<Mesh>(mesh, Vertex_index()), mesh(&mesh), dirty(&dirty) {} // no vertex is a probe

  void vertex_moved(Vertex_index v) {
    Scene_teller<Mesh>::vertex_moved(v);
    for (const Face_index f : mesh->faces_around_target(mesh->halfedge(v)))
      if (f.is_valid())
        dirty->mark(f);
    if (moves != nullptr)
      moves->push_back({v, mesh->point(v)});
  }
  void face_dies(Face_index f) {
    Scene_teller<Mesh>::face_dies(f);
    dirty->mark(f);
  }
  void face_created(Face_index f) {
    Scene_teller<Mesh>::face_created(f);
    dirty->mark(f);
  }
};

/// A mesh, its Sculptor and its log. Made by a thread that may take its time, then the loop's alone.
struct Model {
  using Sculptor_type = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Face_watch>;

  std::string path;
  Mesh mesh;
  Eigen::Vector3d lower, upper; ///< the box of the mesh as it was opened
  Dirty_faces dirty;
  std::unique_ptr<Sculptor_type> sculptor;
  std::unique_ptr<Log_thread> log; ///< none: not logged
  std::uint64_t edits = 0;         ///< that changed the mesh
  std::size_t resumed = 0;         ///< lines of the log that were there

  Face_change face(std::uint32_t index) const {
    Face_change change;
    change.index = index;
    const Face_index f(index);
    change.is_there = index < mesh.num_faces() && !mesh.is_removed(f);
    if (!change.is_there)
      return change;
    auto h = mesh.halfedge(f);
    for (Place& corner : change.corners) {
      const auto& p = mesh.point(mesh.source(h));
      corner = {p.x(), p.y(), p.z()};
      h = mesh.next(h);
    }
    return change;
  }

  double extent() const { return (upper - lower).norm(); }
};

/// Reads, checks, and makes again what a log has of it. \param log its path; empty: none
/// \throw what reading meshes and logs throws
std::unique_ptr<Model> open_model(const std::string& path, const std::string& log);

/// Writes by the rules of `sculpt -o`. \return what of an old file could not be kept \throw Write_error
std::string write_copy(const Scene_copy& copy, const std::string& path);

} // namespace haptic_sculpt::window_program

#endif
