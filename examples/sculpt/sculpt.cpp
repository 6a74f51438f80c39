// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpts a mesh from a script. See --help, and DESIGN's names of options, report keys and exit codes in doc/sculpt.md.
#include "Log_file.h"
#include "Run_options.h"
#include "sha256_of_file.h"

#include "../drawing/surface_mesh_arrays.h"
#include "../drawing/write_picture.h"

#include <haptic_sculpt/surface/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/Brute_force_broad_phase.h>
#include <haptic_sculpt/surface/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>
#include <haptic_sculpt/version.h>

#include <CLI/CLI.hpp>

#include <fstream>
#include <iomanip>
#include <iostream>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::sculpt_program;
using Kind = Command::Kind;
using Json = nlohmann::ordered_json;

enum Exit { done = 0, usage = 2, mesh_refused = 3, script_error = 4, cannot_write = 5, foreign_log = 6 };

struct Arguments {
  std::string mesh, script, out, report, log, response = "stop", broad_phase = "tree", picture;
  double clearance = 0, delta = 0;
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

/// \throw Usage_error for what does not exist yet; Foreign_log
void check(const std::vector<Command>& script, const Arguments& arguments) {
  const auto not_yet = [&](std::size_t line, const std::string& what) {
    throw Usage_error(arguments.script + ": line " + std::to_string(line) + ": " + what + " does not exist yet");
  };
  std::optional<std::string> hash;
  for (const Command& command : script)
    switch (command.kind) {
    case Kind::response:
      if (command.word != "stop")
        not_yet(command.line, "the response '" + command.word + "'");
      break;
    case Kind::mesh:
      if (!hash)
        hash = sha256_of_file(arguments.mesh);
      if (command.word != *hash)
        throw Foreign_log(arguments.script + ": line " + std::to_string(command.line) + " is about the mesh " + command.word +
                          ", but '" + arguments.mesh + "' is " + *hash);
      break;
    default:
      break;
    }
}

Run_result run(Mesh& mesh, const std::vector<Command>& script, const Arguments& arguments, const After_command& after) {
  Sculptor_parameters parameters;
  parameters.delta(arguments.delta);
  if (arguments.clearance > 0)
    parameters.clearance(arguments.clearance);
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
  if (arguments.clearance > 0) {
    command.kind = Kind::clearance;
    command.length = arguments.clearance;
    directives.push_back(command);
  }
  if (arguments.delta > 0) {
    command.kind = Kind::delta;
    command.length = arguments.delta;
    directives.push_back(command);
  }
  return directives;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty())
    return 0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

Json report_of(const Run_result& result) {
  return {{"version", HAPTIC_SCULPT_VERSION},
          {"totals",
           {{"asked", result.reached + result.blocked + result.refused},
            {"reached", result.reached},
            {"blocked", result.blocked},
            {"refused", result.refused}}},
          {"edits", result.edits},
          {"time_ns",
           {{"p50", percentile(result.nanoseconds, 0.5)},
            {"p99", percentile(result.nanoseconds, 0.99)},
            {"p999", percentile(result.nanoseconds, 0.999)},
            {"max", percentile(result.nanoseconds, 1)}}},
          {"filter",
           {{"permanent", result.filter.permanent},
            {"integer_64", result.filter.integer_64},
            {"integer_128", result.filter.integer_128},
            {"big_integer", result.filter.big_integer}}}};
}

void print_table(const Run_result& result, const Mesh& mesh) {
  std::cout << mesh.number_of_vertices() << " vertices, " << mesh.number_of_faces() << " triangles\n"
            << "edits asked " << result.reached + result.blocked + result.refused << ", reached " << result.reached
            << ", blocked " << result.blocked << ", refused " << result.refused << '\n';
  constexpr std::size_t most = 40;
  if (!result.blocked_drags.empty())
    std::cout << "  line  left to the target  blocked by\n";
  for (std::size_t i = 0; i < result.blocked_drags.size() && i < most; ++i) {
    const Blocked_drag& drag = result.blocked_drags[i];
    std::cout << std::setw(6) << drag.line << "  " << std::setw(18) << (drag.target - drag.stop).norm() << "  " << drag.what
              << '\n';
  }
  if (result.blocked_drags.size() > most)
    std::cout << "  and " << result.blocked_drags.size() - most << " more (see the report)\n";
}

void write_picture_of(const Mesh& mesh, const Run_result& result, const std::string& path) {
  drawing::Scene scene = drawing::scene_of(mesh);
  constexpr std::size_t most = 2000; // marks beyond this hide the mesh, and cost a few hundred triangles each
  for (std::size_t i = 0; i < result.moved_vertices.size() && i < most; ++i)
    scene.add_moved_vertex(drawing::to_eigen(mesh.point(result.moved_vertices[i])));
  for (std::size_t i = 0; i < result.blocked_drags.size() && i < most; ++i) {
    const Blocked_drag& drag = result.blocked_drags[i];
    scene.add_blocked_drag(drag.start, drag.stop, drag.target);
    const Eigen::Vector3d normal(drag.normal[0], drag.normal[1], drag.normal[2]);
    if (normal.squaredNorm() > 0)
      scene.add_contact(drag.stop, normal);
  }
  drawing::write_picture(scene, path);
}

int sculpt(const Arguments& arguments) {
  if (arguments.response != "stop")
    throw Usage_error("the response '" + arguments.response + "' does not exist yet; use stop");
  if (!arguments.out.empty() && !mesh_file_format(arguments.out))
    throw Usage_error("'" + arguments.out + "' does not end in .off, .ply, .obj or .stl");
  std::vector<Command> script = script_of(arguments);
  Mesh mesh = read_surface<Mesh>(arguments.mesh, arguments.delta);
  check(script, arguments);
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
  if (replayed > 0)
    std::cout << "replayed " << replayed << " lines of " << arguments.log << '\n';
  print_table(result, mesh);
  if (!arguments.out.empty()) {
    Write_options options;
    options.vertex_order = result.vertex_order;
    write_surface(arguments.out, mesh, options);
  }
  if (!arguments.report.empty())
    replace_file(arguments.report, report_of(result).dump(1) + '\n');
  if (!arguments.picture.empty())
    write_picture_of(mesh, result, arguments.picture);
  return done;
}

} // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Sculpts a closed triangle mesh from a script; no surface ever passes through a surface.\n"
               "Exit: 0 done (blocked drags and refused edits are done), 2 usage, 3 mesh refused, 4 script error, "
               "5 cannot write, 6 script or log of another mesh.\n"
               "Script, one edit a line, # comments, numbers decimal or hexadecimal:\n"
               "  drag V X Y Z | release | insert_face A B C X Y Z | insert_edge A B X Y Z | remove V |\n"
               "  probe X Y Z X2 Y2 Z2 | undo | redo | response stop | clearance L | delta L | mesh SHA256");
  app.add_option("MESH", arguments.mesh, "Input: .off .ply .obj .stl")->required();
  app.add_option("--script", arguments.script, "The edits; may be /dev/stdin");
  app.add_option("-o,--output", arguments.out, "Where the sculpted mesh goes: .off .ply .obj .stl");
  app.add_option("--report", arguments.report, "Where the JSON report goes");
  app.add_option("--log", arguments.log, "Edit log: replayed if it exists, then appended to");
  app.add_option("--response", arguments.response, "What a blocked vertex does; only stop exists yet")
      ->capture_default_str()->check(CLI::IsMember({"slide", "stop", "paper"}));
  app.add_option("--broad-phase", arguments.broad_phase, "How candidates are found; the results are the same")
      ->capture_default_str()->check(CLI::IsMember({"tree", "six-lists", "brute"}));
  app.add_option("--clearance", arguments.clearance,
                 "Distance kept from what blocks, > 0; by default 4 ulp of the largest coordinate")
      ->check(CLI::PositiveNumber);
  app.add_option("--delta", arguments.delta, "No triangle altitude may be less")->capture_default_str()->check(CLI::NonNegativeNumber);
  app.add_option("--picture", arguments.picture, "Where a picture goes: .png");
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
  } catch (const drawing::Picture_error& error) {
    return fail(error, cannot_write);
  }
}
