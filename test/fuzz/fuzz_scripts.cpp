// SPDX-License-Identifier: GPL-3.0-or-later
// A fuzz target: the bytes are a script. What parses is carried out on a small mesh and logged. It must not crash; the
// mesh must be a valid surface afterwards; the log must replay to the same bits; and no byte of the log may change
// unnoticed.
#include "common/Log_text.h"
#include "sculpt/Run_result.h"

#include <fuzz/Fuzz_target.h>
#include <fuzz/Random_scripts.h>
#include <meshes/generated_meshes.h>

#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/validate.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::sculpt_program;

const std::string any_hash(64, 'a');
std::size_t carried_out = 0, not_parsed = 0, too_long = 0, replayed = 0, dabs = 0, remeshings = 0;

[[noreturn]] void fault(const std::string& what, const std::string& script) {
  std::fprintf(stderr, "FAULT: %s\nscript (%zu bytes):\n%s\n", what.c_str(), script.size(), script.c_str());
  std::abort();
}

/// Small, so that a script takes a fraction of a millisecond, and with something to run into.
Mesh mesh_of(unsigned choice) {
  auto list = meshes::tetrahedron(choice % 4 == 1 ? 4 : 1);
  if (choice % 4 == 1) { // one inside another
    auto inner = meshes::tetrahedron();
    list += inner.scale_and_move(0.5, 0.25, 0.25, 0.25);
  } else if (choice % 4 == 2) {
    list = meshes::box(2, 2);   // coplanar faces, integer coordinates
  } else if (choice % 4 == 3) { // two that touch each other nearly
    auto second = meshes::tetrahedron();
    list += second.scale_and_move(1, 0x1p-50, 0x1p-50, -1 - 0x1p-40);
  }
  return meshes::to_mesh<Mesh>(list);
}

/// Coordinates, as bits, and the corners of the faces.
std::vector<std::uint64_t> bits_of(const Mesh& mesh) {
  std::vector<std::uint64_t> all;
  for (const auto v : mesh.vertices())
    for (int i = 0; i < 3; ++i) {
      const double x = mesh.point(v)[i];
      std::memcpy(&all.emplace_back(), &x, sizeof x);
    }
  for (const auto f : mesh.faces())
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      all.push_back(v);
  return all;
}

/// False where an error of the library ended it, as it would end the program.
bool carry_out(Mesh& mesh, const std::vector<Command>& commands, const Sculptor_parameters& parameters,
               const After_command& after) {
  try {
    run_script<Box_tree_broad_phase<Mesh>>(mesh, commands, parameters, {[] {}, after});
    return true;
  } catch (const Error&) {
    return false;
  }
}

void check_log(const std::string& log, const Mesh& sculpted, unsigned choice, std::size_t number_of_commands,
               const std::string& script) {
  const Log_contents contents = read_log(log, "the log", any_hash).value();
  if (contents.commands.size() != number_of_commands + 4 ||
      read_script(log, "the log as a script").size() != number_of_commands + 4)
    fault("the log has other commands than the script", script);
  Mesh again = mesh_of(choice);
  if (!carry_out(again, contents.commands, {}, [](const Command&) {}))
    fault("the log cannot be replayed", script);
  if (bits_of(again) != bits_of(sculpted))
    fault("the log replays to another mesh", script);
}

/// Changes one byte.
void check_change(std::string log, std::size_t at, unsigned char by, const std::string& script) {
  log[at % log.size()] ^= static_cast<char>(by == 0 ? 1 : by);
  try {
    read_log(log, "the log", any_hash);
  } catch (const Error&) {
    return;
  }
  fault("byte " + std::to_string(at % log.size()) + " of the log can be changed unnoticed", script + "\nlog:\n" + log);
}

/// A remeshing to short edges of what was drawn far out takes minutes, which finds nothing more.
bool takes_long(const std::vector<Command>& commands) {
  bool remeshes = false, is_far = false;
  double moved = 0; // dabs and moves add up
  const auto look_at = [&](const std::array<double, 3>& p) { is_far = is_far || std::hypot(p[0], p[1], p[2]) > 4; };
  for (const Command& c : commands) {
    remeshes = remeshes || c.kind == Command::Kind::remesh;
    is_far = is_far || (c.kind == Command::Kind::remesh && c.length < 0.2);
    look_at(c.edit.point);
    std::for_each(c.points.begin(), c.points.end(), look_at);
    for (const auto& way : c.edit.ways)
      is_far = is_far || std::abs(way.second) > 4;
    moved += std::abs(c.strength) +
             (c.kind == Command::Kind::move ? std::hypot(c.edit.point[0], c.edit.point[1], c.edit.point[2]) : 0);
  }
  return remeshes && (is_far || !(moved <= 4));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 4)
    return 0;
  const unsigned choice = data[0], settings_choice = data[1];
  const std::string script(reinterpret_cast<const char*>(data) + 4, size - 4);
  std::vector<Command> commands;
  try {
    commands = read_script(script, "the script");
  } catch (const Script_error& error) {
    if (std::strncmp(error.what(), "the script: line ", 17) != 0)
      fault(std::string("the message names no line: ") + error.what(), script);
    ++not_parsed;
    return 0;
  }
  if (commands.empty() || commands.size() > 40 || takes_long(commands)) {
    ++too_long;
    return 0;
  }

  Settings settings;
  settings.response = settings_choice % 4 == 1 ? "stop" : settings_choice % 4 == 2 ? "paper" : "slide";
  if (settings_choice & 4)
    settings.clearance = 0x1p-20;
  if (settings_choice & 8)
    settings.delta = 0x1p-10;
  Sculptor_parameters parameters;
  parameters.response(*response_by_name(settings.response)).delta(settings.delta);
  if (settings.clearance)
    parameters.clearance(*settings.clearance);

  Log_writer writer;
  std::string log = writer.head(any_hash, settings);
  log += writer.pass(any_hash, 0);

  ++carried_out;
  Mesh mesh = mesh_of(choice);
  std::size_t told = 0;
  const bool is_done = carry_out(mesh, commands, parameters, [&](const Command& command) {
    log += writer.command(command, command.line);
    ++told;
    dabs += command.kind == Command::Kind::brush;
    remeshings += command.kind == Command::Kind::remesh;
  });
  if (const Validity_report report = validate(mesh); !report.is_valid())
    fault("the mesh is no longer valid: " + report.message(), script);
  if (is_done) {
    check_log(log, mesh, choice, told, script);
    ++replayed;
  }
  check_change(log, data[2] * std::size_t(256) + data[3], static_cast<unsigned char>(data[2] ^ (data[3] << 4)), script);
  return 0;
}

std::string fuzz_input(std::mt19937_64& random) {
  return fuzz::Random_scripts(random).next();
}

std::string fuzz_summary() {
  return std::to_string(carried_out) + " scripts carried out, " + std::to_string(replayed) +
         " logs of them replayed, with " + std::to_string(dabs) + " dabs and " + std::to_string(remeshings) +
         " remeshings; " + std::to_string(not_parsed) + " refused, " + std::to_string(too_long) +
         " empty or left out as too long";
}
