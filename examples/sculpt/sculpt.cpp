// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpts a mesh from a script. See --help; options, script, report keys and exit codes: doc/sculpt.md.
#include "Log_file.h"
#include "Report.h"
#include "Run_result.h"
#include "output_targets.h"
#include "sha256_of_file.h"

#include "../drawing/surface_mesh_arrays.h"
#include "../drawing/write_picture.h"

#include <haptic_sculpt/surface/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/Brute_force_broad_phase.h>
#include <haptic_sculpt/surface/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/replace_file.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::sculpt_program;
using Kind = Command::Kind;

enum Exit { done = 0, no_memory = 1, usage = 2, mesh_refused = 3, script_error = 4, cannot_write = 5, foreign_log = 6 };

struct Arguments {
  std::string mesh, script, out, report, log, response, broad_phase = "tree", picture;
  std::optional<double> clearance;
  double delta = 0;
};

/// Something that was asked for and does not exist yet, or does not fit together.
struct Usage_error : Error {
  using Error::Error;
};

std::vector<Command> script_of(const Arguments& arguments) {
  if (arguments.script.empty())
    return {};
  std::ifstream file(arguments.script);
  if (!file)
    throw Script_error("cannot open the script '" + arguments.script + "': " + std::strerror(errno));
  return read_script(file, arguments.script);
}

/// \throw Usage_error where one file would be written over another of this run; Write_error
void check_targets(const Arguments& arguments) {
  if (!arguments.out.empty() && !mesh_file_format(arguments.out))
    throw Usage_error("'" + arguments.out + "' does not end in .off, .ply, .obj or .stl");
  // The result may take the place of the mesh that was read: that is what one asks of an editor.
  std::vector<std::string> taken = {arguments.script, arguments.out, arguments.report, arguments.picture, arguments.log};
  for (std::size_t i = 0; i < taken.size(); ++i)
    for (std::size_t j = i + 1; j < taken.size(); ++j)
      if (!taken[i].empty() && !taken[j].empty() && are_one_file(taken[i], taken[j]))
        throw Usage_error("'" + taken[i] + "' and '" + taken[j] + "' are one file; give each its own");
  for (const std::string& path : {arguments.report, arguments.picture, arguments.log})
    if (!path.empty() && are_one_file(path, arguments.mesh))
      throw Usage_error("'" + path + "' is the mesh to be read; give another name");
  for (const std::string& path : {arguments.out, arguments.report, arguments.picture})
    if (!path.empty())
      check_target(path);
}

/// \throw Foreign_log
void check_mesh_directives(const std::vector<Command>& script, const Arguments& arguments) {
  std::string hash;
  for (const Command& command : script) {
    if (command.kind != Kind::mesh)
      continue;
    if (hash.empty())
      hash = sha256_of_file(arguments.mesh);
    if (command.word != hash)
      throw Foreign_log(arguments.script + ": line " + std::to_string(command.line) + " is about the mesh " +
                        command.word + ", but '" + arguments.mesh + "' is " + hash);
  }
}

Run_result run(Mesh& mesh, const std::vector<Command>& script, const Arguments& arguments, const After_command& after) {
  Sculptor_parameters parameters;
  parameters.delta(arguments.delta);
  if (!arguments.response.empty())
    parameters.response(*response_named(arguments.response));
  if (arguments.clearance)
    parameters.clearance(*arguments.clearance);
  if (arguments.broad_phase == "brute")
    return run_script<Brute_force_broad_phase<Mesh>>(mesh, script, parameters, after);
  if (arguments.broad_phase == "six-lists")
    return run_script<Six_list_broad_phase<Mesh>>(mesh, script, parameters, after);
  return run_script<Box_tree_broad_phase<Mesh>>(mesh, script, parameters, after);
}

/// The options that a log has to repeat, as directives.
std::vector<Command> settings(const Arguments& arguments) {
  std::vector<Command> directives;
  Command command;
  if (!arguments.response.empty()) {
    command.kind = Kind::response;
    command.word = arguments.response;
    directives.push_back(command);
    command.word.clear();
  }
  if (arguments.clearance) {
    command.kind = Kind::clearance;
    command.length = *arguments.clearance;
    directives.push_back(command);
  }
  if (arguments.delta > 0) {
    command.kind = Kind::delta;
    command.length = arguments.delta;
    directives.push_back(command);
  }
  return directives;
}

void write_picture_of(const Mesh& mesh, const Run_result& result, const std::string& path) {
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
  drawing::write_picture(scene, path);
}

/// Writes what was asked for. A file that cannot be written does not keep the others from being written: the work is
/// done.
bool write_all(const Mesh& mesh, const Run_result& result, const Arguments& arguments) {
  bool all_written = true;
  const auto attempt = [&](const std::string& path, const auto& write) {
    try {
      if (!path.empty())
        write(path);
    } catch (const Write_error& error) {
      std::cerr << "sculpt: " << error.what() << '\n';
      all_written = false;
    } catch (const drawing::Picture_error& error) {
      std::cerr << "sculpt: " << error.what() << '\n';
      all_written = false;
    }
  };
  attempt(arguments.out, [&](const std::string& path) {
    Write_options options;
    options.vertex_order = result.vertex_order;
    write_surface(path, mesh, options);
  });
  attempt(arguments.report, [&](const std::string& path) { replace_file(path, report_of(result)); });
  attempt(arguments.picture, [&](const std::string& path) { write_picture_of(mesh, result, path); });
  return all_written;
}

Exit sculpt(const Arguments& arguments) {
  if (arguments.clearance && !(*arguments.clearance > 0 && std::isfinite(*arguments.clearance)))
    throw Usage_error("--clearance must be a finite length > 0");
  if (!(arguments.delta >= 0 && std::isfinite(arguments.delta)))
    throw Usage_error("--delta must be a finite length >= 0");
  std::vector<Command> script = script_of(arguments);
  check_targets(arguments);
  Mesh mesh = read_surface<Mesh>(arguments.mesh, arguments.delta);
  check_mesh_directives(script, arguments);
  std::optional<Log_file> log;
  std::size_t replayed = 0;
  if (!arguments.log.empty()) {
    log.emplace(arguments.log, sha256_of_file(arguments.mesh), settings(arguments));
    replayed = log->commands().size();
    script.insert(script.begin(), log->commands().begin(), log->commands().end());
  }
  std::size_t made = 0;
  const Run_result result = run(mesh, script, arguments, [&](const Command& command) {
    if (log && ++made > replayed)
      log->append(command);
  });
  const bool all_written = write_all(mesh, result, arguments);
  if (replayed > 0)
    std::cout << "replayed " << replayed << " lines of " << arguments.log << '\n';
  print_table(std::cout, result, mesh); // last: whoever reads it may close the pipe
  if (!std::cout.flush())
    throw Write_error("cannot write the table to standard output");
  return all_written ? done : cannot_write;
}

} // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Sculpts a closed triangle mesh from a script; no surface ever passes through a surface.\n"
               "Exit: 0 done (blocked drags and refused edits are done), 1 out of memory, 2 usage, 3 mesh refused, 4 "
               "script error, "
               "5 cannot write, 6 script or log of another mesh.\n"
               "Script, one edit a line, # comments, numbers decimal or hexadecimal:\n"
               "  drag V X Y Z | release | insert_face A B C X Y Z | insert_edge A B X Y Z | remove V |\n"
               "  probe X Y Z X2 Y2 Z2 | undo | redo | response slide|stop|paper | clearance L | delta L | mesh SHA256");
  const CLI::Validator named([](const std::string& path) { return path.empty() ? "the name is empty" : ""; }, "");
  app.add_option("MESH", arguments.mesh, "Input: .off .ply .obj .stl")->required()->check(named);
  app.add_option("--script", arguments.script, "The edits; may be /dev/stdin")->check(named);
  app.add_option("-o,--output", arguments.out, "Where the sculpted mesh goes: .off .ply .obj .stl")->check(named);
  app.add_option("--report", arguments.report, "Where the JSON report goes")->check(named);
  app.add_option("--log", arguments.log, "Edit log: replayed if it exists, then appended to")->check(named);
  app.add_option("--response", arguments.response, "What a blocked vertex does: slide (the default), stop or paper")
      ->check(CLI::IsMember({"slide", "stop", "paper"}));
  app.add_option("--broad-phase", arguments.broad_phase, "How candidates are found; the results are the same")
      ->capture_default_str()
      ->check(CLI::IsMember({"tree", "six-lists", "brute"}));
  app.add_option("--clearance", arguments.clearance,
                 "Distance kept from what blocks, > 0; by default 4 ulp of the largest coordinate");
  app.add_option("--delta", arguments.delta, "No triangle altitude may be less, >= 0")->capture_default_str();
  app.add_option("--picture", arguments.picture, "Where a picture goes: .png")->check(named);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : usage;
  }
  const auto fail = [](const std::exception& error, Exit code) {
    std::cerr << "sculpt: " << error.what() << '\n';
    return code;
  };
  try {
    return sculpt(arguments);
  } catch (const Usage_error& error) {
    return fail(error, usage);
  } catch (const Foreign_log& error) {
    return fail(error, foreign_log);
  } catch (const Invalid_parameter& error) {
    return fail(error, usage);
  } catch (const Read_error& error) {
    return fail(error, mesh_refused);
  } catch (const Invalid_surface& error) {
    return fail(error, mesh_refused);
  } catch (const Script_error& error) {
    return fail(error, script_error);
  } catch (const Write_error& error) {
    return fail(error, cannot_write);
  } catch (const std::bad_alloc&) {
    std::cerr << "sculpt: the memory does not suffice for this mesh and script\n";
    return no_memory;
  }
}
