// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_SCRIPT_RUNNER_H
#define HAPTIC_SCULPT_EXAMPLES_SCRIPT_RUNNER_H

#include "Progress.h"
#include "Run_result.h"

#include <chrono>
#include <set>

namespace haptic_sculpt::sculpt_program {

/// Carries out commands one by one. Vertices are named by index in file order; no edit here makes or removes any, so
/// the mesh's own indices serve.
template <class Broad_phase>
class Script_runner {
public:
  using Result = Drag_result<Mesh>;

  Script_runner(Mesh& mesh, const Sculptor_parameters& parameters) : mesh_(mesh), sculptor_(mesh, parameters) {}

  Run_result run(const std::vector<Command>& script) {
    Progress progress(script.size());
    for (std::size_t i = 0; i < script.size(); ++i) {
      carry_out(script[i]);
      progress.step(i + 1);
    }
    result_.moved_vertices.assign(moved_.begin(), moved_.end());
    result_.filter = sculptor_.filter_counters();
    return std::move(result_);
  }

private:
  using Clock = std::chrono::steady_clock;
  using Kind = Command::Kind;
  using Status = Edit_record::Status;

  Mesh& mesh_;
  Sculptor<Mesh, Broad_phase> sculptor_;
  std::optional<typename Sculptor<Mesh, Broad_phase>::Grab_type> grab_;
  bool held_ = false; ///< whether the line before was a drag of grab_'s vertex
  Run_result result_;
  std::set<std::size_t> moved_;

  void carry_out(const Command& command) {
    if (command.kind != Kind::drag)
      held_ = false; // any other line ends the grab
    switch (command.kind) {
    case Kind::drag:
      drag(command);
      break;
    case Kind::probe:
      probe(command);
      break;
    case Kind::clearance:
      sculptor_.release();
      sculptor_.set_clearance(command.length);
      break;
    case Kind::delta:
      delta(command);
      break;
    default:
      sculptor_.release(); // release; response stop; mesh was checked before the first edit
    }
  }

  static Kernel::Point_3 point(const Edit_record::Coordinates& p) { return {p[0], p[1], p[2]}; }
  static Edit_record::Coordinates coordinates(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

  void drag(const Command& command) {
    const std::size_t index = command.indices[0];
    if (index >= mesh_.num_vertices()) {
      refuse(command, "unknown-vertex", {index});
      return;
    }
    const Mesh::Vertex_index v(static_cast<Mesh::size_type>(index));
    const Kernel::Point_3 start = mesh_.point(v);
    const auto begin = Clock::now();
    // A grab of the vertex already in hand would let go of it first.
    if (!held_ || grab_->vertex() != v)
      grab_.emplace(sculptor_.grab(v));
    held_ = true;
    const Result done = grab_->drag_to(point(command.points[0]));
    finish(command, begin, done, coordinates(start), command.points[0], {index});
    if (done.position != start)
      moved_.insert(index);
  }

  void probe(const Command& command) {
    const auto begin = Clock::now();
    const Result done = sculptor_.probe(point(command.points[0]), point(command.points[1]));
    if (done.end == Drag_end::refused)
      refuse(command, "starts-in-clearance", ids(done.contacts[0]));
    else
      finish(command, begin, done, command.points[0], command.points[1], {});
  }

  void delta(const Command& command) {
    try {
      sculptor_.set_delta(command.length);
    } catch (const Invalid_surface& error) {
      std::set<std::size_t> corners;
      for (const auto f : error.report().low_faces)
        for (const auto v : mesh_.vertices_around_face(mesh_.halfedge(f)))
          corners.insert(v);
      refuse(command, "triangle-lower-than-delta", {corners.begin(), corners.end()});
    }
  }

  template <class Ids = std::vector<std::size_t>>
  static Ids ids(const Contact_3<Mesh>& contact) {
    return {contact.vertices[0], contact.vertices[1], contact.vertices[2]};
  }

  Edit_record& record(const Command& command, Status status, const char* reason, std::vector<std::size_t> elements) {
    Edit_record edit;
    edit.line = command.line;
    edit.kind = command.kind;
    edit.status = status;
    edit.reason = reason;
    edit.elements = std::move(elements);
    result_.edits.push_back(std::move(edit));
    return result_.edits.back();
  }

  void refuse(const Command& command, const char* reason, std::vector<std::size_t> elements) {
    held_ = false;
    ++result_.refused;
    record(command, Status::refused, reason, std::move(elements));
  }

  void finish(const Command& command, Clock::time_point begin, const Result& done,
              const Edit_record::Coordinates& start, const Edit_record::Coordinates& target,
              std::vector<std::size_t> elements) {
    result_.nanoseconds.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
    ++(done.reached ? result_.reached : result_.blocked);
    Edit_record& edit = record(command, done.reached ? Status::reached : Status::blocked,
                               done.reached ? nullptr : name_of(done.end), std::move(elements));
    edit.motion = {start, coordinates(done.position), target};
    edit.legs = done.legs;
    edit.stop_error = done.stop_error;
    edit.stop_error_along_path = done.stop_error_along_path;
    edit.kkt_residual = done.kkt_residual;
    for (const auto& contact : done.contacts)
      edit.contacts.push_back({name_of(contact.kind), ids<std::array<std::size_t, 3>>(contact), contact.normal});
  }
};

template <class Broad_phase>
Run_result run_script(Mesh& mesh, const std::vector<Command>& script, const Sculptor_parameters& parameters) {
  return Script_runner<Broad_phase>(mesh, parameters).run(script);
}

} // namespace haptic_sculpt::sculpt_program

#endif
