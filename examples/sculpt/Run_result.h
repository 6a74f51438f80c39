// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../common/carry_out_line.h"

#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace haptic_sculpt::sculpt_program {

using namespace examples;

/// What became of one edit. Small: a benchmark's script has millions of lines.
struct Edit_record {
  enum class Status : std::uint8_t { reached, blocked, refused };
  using Coordinates = std::array<double, 3>;

  struct Contact {
    const char* kind;
    std::array<std::size_t, 3> ids; ///< of vertices, as in Contact_3
    Coordinates normal;
  };
  /// Where a motion began, ended, and was to end.
  struct Motion {
    Coordinates start, stop, target;
  };

  std::size_t line = 0; ///< of the log where `is_logged`, else of the script
  bool is_logged = false;
  std::size_t script_line = 0; ///< of the script that a line of the log came from; 0 where the log does not say
  const char* op = nullptr;     ///< the word that its line begins with
  Status status = Status::refused;
  const char* reason = nullptr; ///< why it was not reached, or nullptr
  std::string detail;           ///< for people: what would serve instead, or what was done, where there is more to say
  std::vector<std::size_t>
      elements;                 ///< the vertices that the edit names; of a refused `delta`, those of too low triangles
  std::optional<Motion> motion; ///< none where refused; a creation, removal, undo or redo stands still
  /// Of a brush, a move or a remeshing: how many vertices or operations were asked for, and how many of them arrived
  /// or were done.
  std::optional<std::array<std::size_t, 2>> many;
  int legs = 0;
  double stop_error = 0, stop_error_along_path = 0, kkt_residual = 0;
  std::vector<Contact> contacts;
  /// Blocked no farther from its target than two clearances: a stop keeps one, and up to two where it grazes.
  bool is_within_clearance = false;
  /// Where it began, and the end of each leg; of the first `most_drawn` that were blocked, for the picture.
  std::vector<Coordinates> way;

  static constexpr std::size_t most_drawn = 2000; ///< more hide the mesh, and cost a few hundred triangles each
};

/// What a script did.
struct Run_result {
  std::vector<Edit_record> edits;
  std::size_t reached = 0, blocked = 0, refused = 0;
  std::size_t within_clearance = 0;        ///< of those blocked
  std::vector<Vertex_index> moved_vertices;                ///< those that are still there
  std::vector<Validity_report::Vertex_index> vertex_order; ///< by number, dead ones left out
  std::vector<std::size_t> numbers;        ///< of these
  std::vector<double> nanoseconds;         ///< of each edit that was carried out
  Filter_counters filter;
  std::exception_ptr failure; ///< of a line that could not be carried out and ended the script, which was `failed`
  struct Failed_line {
    const char* name = "";
    std::size_t line = 0;
    bool is_logged = false; ///< it is one of the log
  } failed;
  /// That line: what it had done by then could not be taken back, and log or report may not have it.
  bool may_be_in_part = false;

  std::size_t asked() const { return reached + blocked + refused; }
};

/// Called with what has been done, once it is, as a log has it: a line of the script; of a `move` what it did, and
/// nothing of one that did nothing.
using After_command = std::function<void(const Command&)>;

struct Run_hooks {
  std::function<void()> begin; ///< called when mesh and parameters have been taken
  After_command after;
};

/// Carries out a script on a mesh. \throw Invalid_surface, Invalid_parameter, and what `hooks` throw
template <class Broad_phase>
Run_result run_script(Mesh& mesh, const std::vector<Command>& script, const Sculptor_parameters& parameters,
                      const Run_hooks& hooks);

} // namespace haptic_sculpt::sculpt_program
