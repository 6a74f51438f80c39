// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Move_lines.h"
#include "Progress.h"
#include "Run_result.h"

#include "../common/Usage_error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

namespace haptic_sculpt::sculpt_program {

/// Carries out commands one by one. Vertices are named by numbers that last: at first the index in file order.
template <class Broad_phase>
class Script_runner {
public:
  using Result = Drag_result<Mesh>;

  Script_runner(Mesh& mesh, const Sculptor_parameters& parameters) : mesh_(mesh), sculptor_(mesh, parameters) {
    keep_vertex_attributes(sculptor_);
  }

  Run_result run(const std::vector<Command>& script, const After_command& after) {
    Progress progress("the script", script.size());
    make_room();
    for (std::size_t i = 0; i < script.size() && !result_.failure; ++i) {
      try {
        std::optional<Command> found;
        const Command& command = script[i].places.empty() ? script[i] : found.emplace(with_vertices_found(script[i]));
        if (command.kind == Kind::move) {
          carry_out_move(command, i != 0 && script[i - 1].edit.kind == Edit_kind::move, after);
        } else {
          carry_out_whole(command);
          tell(command, after);
        }
      } catch (const std::exception&) { // told with what was done so far, which is not lost
        result_.failure = std::current_exception();
        result_.failed = {name_of(script[i]), script[i].line, script[i].is_logged};
      }
      progress.step(i + 1);
    }
    for (const std::size_t name : moved_)
      if (sculptor_.vertex(name).is_valid())
        result_.moved_vertices.push_back(sculptor_.vertex(name));
    add_numbers(result_.numbers);
    for (const std::size_t name : result_.numbers)
      result_.vertex_order.emplace_back(static_cast<Mesh::size_type>(sculptor_.vertex(name)));
    result_.filter = sculptor_.filter_counters();
    return std::move(result_);
  }

private:
  using Clock = std::chrono::steady_clock;
  using Kind = Command::Kind;
  using Status = Edit_record::Status;

  Mesh& mesh_;
  Sculptor<Mesh, Broad_phase> sculptor_;
  Run_result result_;
  std::set<std::size_t> moved_;

  /// For what is said of all vertices after a line that lacked memory.
  void make_room() {
    const std::size_t n = sculptor_.number_of_ids();
    if (n <= result_.numbers.capacity())
      return;
    result_.moved_vertices.reserve(n + n / 2);
    result_.vertex_order.reserve(n + n / 2);
    result_.numbers.reserve(n + n / 2);
  }

  /// Of the vertices that are there.
  void add_numbers(std::vector<std::size_t>& all) const {
    for (std::size_t name = 0; name < sculptor_.number_of_ids(); ++name)
      if (sculptor_.vertex(name).is_valid())
        all.push_back(name);
  }

  /// The line as it is logged: with vertices by number.
  Command with_vertices_found(Command command) {
    for (const Command::Place& place : command.places) {
      const bool is_shift = command.kind == Kind::edit && command.edit.kind == Edit_kind::shift;
      std::size_t& vertex = is_shift ? command.edit.ways[place.which].first : command.edit.vertices[place.which];
      vertex = sculptor_.id(sculptor_.nearest_vertex(point(place.point), std::numeric_limits<double>::infinity()));
    }
    command.places.clear();
    return command;
  }

  /// Hands the line to who logs it.
  void tell(const Command& command, const After_command& after) {
    try {
      if (is_in_force(command))
        after(command);
      else
        after(as_refused(command));
    } catch (const std::bad_alloc&) { // it has been carried out, and the log may not have it
      result_.may_be_in_part = true;
      throw;
    }
  }

  /// Whoever reads the log has to know of a setting that is not in force.
  static Command as_refused(Command setting) {
    if (setting.is_restored)
      throw examples::Usage_error(
          "the script had this when it broke off behind that line, and the mesh, changed since, does not take it. "
          "Undo what was done since, or carry out the lines that are left as another script");
    setting.is_refused = true;
    return setting;
  }

  /// \return true of what is no setting that may be refused
  bool is_in_force(const Command& command) const {
    const Sculptor_parameters& held = sculptor_.parameters();
    if (command.kind == Kind::delta)
      return command.length == held.delta_length;
    if (command.kind == Kind::clearance)
      return held.drag.clearance_length ? command.word.empty() && command.length == *held.drag.clearance_length
                                        : command.word == "default";
    return true;
  }

  /// All of it, or nothing: what it did before it was broken off would be in the mesh, but in no log and no report.
  void carry_out_whole(const Command& command) {
    const auto was = sculptor_.history();
    const std::size_t steps = was.number_of_undo_steps(), edits = result_.edits.size(),
                      times = result_.nanoseconds.size();
    const bool was_in_stroke = was.is_in_stroke();
    const std::size_t reached = result_.reached, blocked = result_.blocked, refused = result_.refused,
                      within_clearance = result_.within_clearance;
    try {
      carry_out(command);
      make_room();
    } catch (...) {
      result_.edits.resize(edits);
      result_.nanoseconds.resize(times);
      result_.reached = reached, result_.blocked = blocked, result_.refused = refused;
      result_.within_clearance = within_clearance;
      try {
        const auto now = sculptor_.history();
        if (was_in_stroke || now.is_in_stroke()) // whose earlier lines an undo would take back, too
          result_.may_be_in_part = true;
        else if (now.number_of_undo_steps() > steps)
          result_.may_be_in_part = !sculptor_.undo();
        else if (now.number_of_undo_steps() < steps)
          result_.may_be_in_part = !sculptor_.redo();
      } catch (const std::exception&) { // no memory for that, either
        result_.may_be_in_part = true;
      }
      throw;
    }
  }

  void carry_out(const Command& command) {
    if (command.kind == Kind::edit)
      apply(command);
    else if (command.kind == Kind::probe)
      probe(command);
    else
      carry_out_other(command);
  }

  static Kernel::Point_3 point(const Edit_record::Coordinates& p) { return {p[0], p[1], p[2]}; }
  static Edit_record::Coordinates coordinates(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

  void apply(const Command& command) {
    const Edit& edit = command.edit;
    const Vertex_index v = edit.kind == Edit_kind::move ? sculptor_.vertex(edit.vertices[0]) : Vertex_index();
    const Kernel::Point_3 start = v.is_valid() ? mesh_.point(v) : Kernel::Point_3();
    const auto begin = Clock::now();
    try {
      const auto done = sculptor_.apply(edit);
      if (!done)
        refuse(command, done.refusal->reason, done.refusal->elements);
      else if (done.drag)
        tell_drag(command, begin, done, start);
      else if (edit.kind != Edit_kind::stroke && edit.kind != Edit_kind::end)
        tell_edit(command, begin, done);
    } catch (const Invalid_parameter& error) { // the scene has outgrown the clearance
      refuse(command, clearance_of_no_use, vertices_of(command)).detail = outgrown(error);
    }
  }

  template <class Elements>
  void refuse(const Command& command, Refusal_reason reason, const Elements& vertices) {
    std::vector<std::size_t> elements;
    for (const Vertex_index v : vertices)
      elements.push_back(sculptor_.id(v));
    if (elements.empty())
      elements = vertices_of(command);
    for (const auto& [id, end] : command.edit.ways)
      if (!sculptor_.vertex(id).is_valid())
        elements.push_back(id);
    refuse(command, name_of(reason), std::move(elements));
  }

  void tell_drag(const Command& command, Clock::time_point begin, const Applied<Mesh>& done,
                 const Kernel::Point_3& start) {
    way_.assign(1, start);
    if (done.edit.kind == Edit_kind::move) {
      for (const auto& leg : done.edit.legs)
        way_.push_back(point(leg));
      way_.push_back(point(done.edit.point));
      moved_.insert(command.edit.vertices[0]);
    }
    finish(command, begin, *done.drag, coordinates(start), command.edit.point, vertices_of(command));
  }

  void tell_edit(const Command& command, Clock::time_point begin, const Applied<Mesh>& done) {
    result_.nanoseconds.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
    ++result_.reached;
    const Edit_kind kind = command.edit.kind;
    if (kind == Edit_kind::shift) {
      record(command, Status::reached, nullptr, {});
      return;
    }
    const std::size_t name = sculptor_.id(*done.vertex);
    const Edit_record::Coordinates p = coordinates(mesh_.point(*done.vertex));
    if (kind == Edit_kind::insert_on_face || kind == Edit_kind::insert_on_edge)
      moved_.insert(name);
    const bool names_an_edge = kind == Edit_kind::collapse || kind == Edit_kind::flip;
    Edit_record& done_edit =
        record(command, Status::reached, nullptr, names_an_edge ? vertices_of(command) : std::vector{name});
    if (kind != Edit_kind::flip) // which leaves every vertex where it is
      done_edit.motion = {p, p, p};
  }

  /// A move that has moved nothing may have ended a grab, and then tells that: the next drag begins anew.
  void carry_out_move(const Command& move, bool ends_grab, const After_command& after) {
    Move_lines lines(move, after);
    try {
      carry_out_other(move, &lines);
      if (!lines.end() && ends_grab)
        after(lines.line_of({}));
    } catch (...) {
      result_.may_be_in_part = lines.has_moved();
      throw;
    }
  }

  void carry_out_other(const Command& command, Move_lines* lines = nullptr) {
    const auto begin = Clock::now();
    const Line_outcome done = carry_out_line(sculptor_, command, lines);
    if (done.refusal) {
      refuse(command, done.refusal, done.elements).detail = done.detail;
      return;
    }
    if (!done.many) // a directive
      return;
    result_.nanoseconds.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
    // A remesher leaves out what is not proven: that is its work, not a fault of it.
    const bool is_whole = command.kind == Kind::remesh || (*done.many)[1] == (*done.many)[0];
    ++(is_whole ? result_.reached : result_.blocked);
    Edit_record& edit =
        record(command, is_whole ? Status::reached : Status::blocked, is_whole ? nullptr : "in-part", done.elements);
    edit.many = done.many;
    edit.detail = done.detail;
  }

  void probe(const Command& command) {
    sculptor_.release(); // only moves that follow each other are one grab
    const auto begin = Clock::now();
    try {
      auto probe = sculptor_.probe(point(command.points[0]), Probe_start::anywhere);
      const Result done = probe.drag_to(point(command.points[1]), way_);
      if (done.end == Drag_end::refused)
        refuse(command, "starts-in-clearance", ids(done.contacts[0]));
      else
        finish(command, begin, done, command.points[0], command.points[1], {});
    } catch (const Invalid_parameter& error) {
      refuse(command, clearance_of_no_use, {}).detail = outgrown(error);
    }
  }

  std::vector<Kernel::Point_3> way_; ///< of the last drag or probe

  template <class Ids = std::vector<std::size_t>>
  Ids ids(const Contact_3<Mesh>& contact) const {
    return {sculptor_.id(contact.vertices[0]), sculptor_.id(contact.vertices[1]), sculptor_.id(contact.vertices[2])};
  }

  bool is_within_clearance(const Result& done, const Edit_record::Coordinates& target) const {
    const Edit_record::Coordinates end = coordinates(done.position);
    double reach = 0; // by which a contact's clearance is set
    const auto include = [&reach](const Edit_record::Coordinates& p) {
      for (const double x : p)
        reach = std::fmax(reach, std::fabs(x));
    };
    include(end);
    for (const auto& contact : done.contacts)
      for (const auto& p : contact.plane)
        include(coordinates(p));
    return std::hypot(target[0] - end[0], target[1] - end[1], target[2] - end[2]) <=
           2 * sculptor_.clearance({reach, reach, reach});
  }

  Edit_record& record(const Command& command, Status status, const char* reason, std::vector<std::size_t> elements) {
    Edit_record edit;
    edit.line = command.line;
    edit.is_logged = command.is_logged;
    edit.script_line = command.script_line;
    edit.op = name_of(command);
    edit.status = status;
    edit.reason = reason;
    edit.elements = std::move(elements);
    result_.edits.push_back(std::move(edit));
    return result_.edits.back();
  }

  Edit_record& refuse(const Command& command, const char* reason, std::vector<std::size_t> elements) {
    sculptor_.release(); // the next drag begins anew
    ++result_.refused;
    return record(command, Status::refused, reason, std::move(elements));
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
    edit.is_within_clearance = done.end == Drag_end::held && is_within_clearance(done, target);
    result_.within_clearance += edit.is_within_clearance;
    if (!done.reached && result_.blocked <= Edit_record::most_drawn)
      for (const Kernel::Point_3& p : way_)
        edit.way.push_back(coordinates(p));
    for (const auto& contact : done.contacts)
      edit.contacts.push_back({name_of(contact.kind), ids<std::array<std::size_t, 3>>(contact),
                               {contact.normal.x(), contact.normal.y(), contact.normal.z()}});
  }
};

template <class Broad_phase>
Run_result run_script(Mesh& mesh, const std::vector<Command>& script, const Sculptor_parameters& parameters,
                      const Run_hooks& hooks) {
  // Not on the stack: where that cannot grow any more the system ends the program.
  const auto runner = std::make_unique<Script_runner<Broad_phase>>(mesh, parameters);
  hooks.begin();
  return runner->run(script, hooks.after);
}

} // namespace haptic_sculpt::sculpt_program
