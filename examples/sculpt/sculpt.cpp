// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpts a mesh from a script. See --help; options, script, report keys and exit codes: doc/sculpt.md.
#include "../Printable_stream.h"
#include "Log_file.h"
#include "output_targets.h"
#include "nearest_vertices.h"
#include "printable.h"
#include "read_mesh.h"
#include "resume.h"
#include "sha256_of_file.h"
#include "write_results.h"

#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/orient_components.h>
#include <haptic_sculpt/surface/read_surface.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <new>
#include <numeric>
#include <utility>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::sculpt_program;
using Kind = Command::Kind;

enum Exit { done = 0, no_memory = 1, usage = 2, mesh_refused = 3, script_error = 4, cannot_write = 5, foreign_log = 6 };

/// A script, and the hash that a log knows it by.
struct Script {
  std::vector<Command> commands;
  std::string hash;
};

Script script_of(const Arguments& arguments) {
  if (arguments.script.empty())
    return {};
  std::ifstream file(arguments.script, std::ios::binary);
  if (!file)
    throw Script_error("cannot open the script '" + arguments.script + "': " + std::strerror(errno));
  std::string text, block(1 << 16, '\0');
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    text.append(block, 0, static_cast<std::size_t>(file.gcount()));
  if (!file.eof())
    throw Script_error("reading the script '" + arguments.script + "' failed");
  return {read_script(text, arguments.script), Sha256().add(text).digest()};
}

/// \throw Usage_error where one file would be written over another of this run; Write_error
void check_targets(const Arguments& arguments) {
  if (!arguments.out.empty() && !mesh_file_format(arguments.out))
    throw Usage_error("'" + arguments.out + "' does not end in .off, .ply, .obj or .stl");
  for (const std::string& path : {arguments.picture, arguments.comparison})
    if (const auto extension = std::filesystem::path(path).extension(); !extension.empty() && extension != ".png" && extension != ".PNG")
      throw Usage_error("a picture is written as PNG: give a name that ends in .png instead of '" + path + "'");
  // The result may take the place of the mesh that was read: that is what one asks of an editor.
  std::vector<std::string> taken = {arguments.script, arguments.out, arguments.report, arguments.picture, arguments.comparison,
                                    arguments.log, arguments.repair.report};
  for (std::size_t i = 0; i < taken.size(); ++i)
    for (std::size_t j = i + 1; j < taken.size(); ++j)
      if (!taken[i].empty() && !taken[j].empty() && are_one_file(taken[i], taken[j]))
        throw Usage_error("'" + taken[i] + "' and '" + taken[j] + "' are one file; give each its own");
  for (const std::string& path : {arguments.report, arguments.picture, arguments.comparison, arguments.log, arguments.repair.report})
    if (!path.empty() && are_one_file(path, arguments.mesh))
      throw Usage_error("'" + path + "' is the mesh to be read; give another name");
  if (!arguments.log.empty() && !arguments.out.empty() && are_one_file(arguments.out, arguments.mesh))
    throw Usage_error("'" + arguments.out + "' is the mesh that the log '" + arguments.log +
                      "' begins with; sculpted, it could not be resumed from the log. Give the result another name");
  for (const std::string& path : {arguments.out, arguments.report, arguments.picture, arguments.comparison, arguments.repair.report})
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
  parameters.delta(arguments.delta.value_or(0));
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

/// \throw Usage_error
void check_lengths(const Arguments& arguments) {
  if (arguments.clearance && !(*arguments.clearance > 0 && internal::is_in_range(*arguments.clearance)))
    throw Usage_error("--clearance must be a length > 0 and at most 2^1000, about 1.07e301");
  if (arguments.delta && !(*arguments.delta >= 0 && internal::is_in_range(*arguments.delta)))
    throw Usage_error("--delta must be a length >= 0 and at most 2^1000, about 1.07e301");
  if (arguments.repair.gap && !(*arguments.repair.gap >= 0 && internal::is_in_range(*arguments.repair.gap)))
    throw Usage_error("--repair-gap must be a length >= 0 and at most 2^1000, about 1.07e301");
  for (const double x : arguments.nearest.value_or(std::array<double, 3>{}))
    if (!internal::is_in_range(x))
      throw Usage_error("--nearest takes coordinates of at most 2^1000, about 1.07e301");
}

/// E.g. "normals, colours".
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// What `--nearest` asks for, of the sculpted mesh; nothing where it does not.
std::vector<Near_vertex> nearest_to(const Arguments& arguments, const Mesh& mesh, const Run_result& result) {
  std::vector<Near_vertex> found;
  if (!arguments.nearest)
    return found;
  constexpr std::size_t most = 8;
  std::vector<std::size_t> places(result.numbers.size()); // in vertex_order, which is in the order of the numbers
  std::iota(places.begin(), places.end(), std::size_t(0));
  const auto point_of = [&](std::size_t i) { return mesh.point(Vertex_index(static_cast<Mesh::size_type>(result.vertex_order[i]))); };
  const auto& [x, y, z] = *arguments.nearest;
  for (const std::size_t i : nearest_vertices(std::move(places), point_of, {x, y, z}, most)) {
    const Kernel::Point_3 p = point_of(i);
    found.push_back({result.numbers[i], {p.x(), p.y(), p.z()}, distance({p.x(), p.y(), p.z()}, *arguments.nearest)});
  }
  return found;
}

/// What the log adds to the work: what to replay, and where the script goes on.
struct Plan {
  std::vector<Command> commands;
  std::size_t replayed = 0;
  Rest rest;
};

Plan plan_of(const Script& script, const Log_file* log, const Arguments& arguments) {
  Plan plan;
  plan.rest.commands = script.commands;
  if (log && log->contents()) {
    const Log_contents& logged = *log->contents();
    if (!script.commands.empty())
      plan.rest = rest_of(script.commands, script.hash, logged, arguments);
    check_options(arguments, logged, !script.commands.empty() && plan.rest.is_new_pass);
    plan.commands = logged.commands;
    if (!script.commands.empty() && !plan.rest.is_announced) { // as Log_file::begin_pass() writes them
      Command end;
      end.kind = Kind::end;
      end.is_logged = true;
      plan.commands.insert(plan.commands.end(), open_strokes(logged.commands), end);
    }
    plan.replayed = plan.commands.size();
  }
  plan.commands.insert(plan.commands.end(), std::make_move_iterator(plan.rest.commands.begin()),
                       std::make_move_iterator(plan.rest.commands.end()));
  plan.rest.commands.clear();
  return plan;
}

Exit sculpt(const Arguments& arguments) {
  check_lengths(arguments);
  const Script script = script_of(arguments);
  check_targets(arguments);
  std::optional<Log_file> log;
  if (!arguments.log.empty())
    log.emplace(arguments.log, sha256_of_file(arguments.mesh));
  const Plan plan = plan_of(script, log ? &*log : nullptr, arguments);
  std::vector<std::string> left_out;
  std::string repair_told;
  Validity_report found;
  Mesh mesh = arguments.repair.is_asked ? read_repaired(arguments, left_out, repair_told)
              : arguments.triangulate   ? read_triangulated(arguments.mesh, arguments.delta.value_or(0), left_out, found)
                                        : read_surface<Mesh>(arguments.mesh, arguments.delta.value_or(0), &left_out, &found);
  std::cout << repair_told;
  if (arguments.orient && !found.inside_out_components.empty()) {
    std::cout << "components turned over: " << orient_components(mesh) << '\n';
    found.inside_out_components.clear();
  }
  check_mesh_directives(script.commands, arguments);
  const drawing::Scene before = needs_before(arguments.shown) ? drawing::scene_of(mesh) : drawing::Scene();

  std::vector<std::string> notes;
  const auto note = [&notes](const std::string& text) {
    std::cerr << "sculpt: " << text << '\n';
    notes.push_back(text);
  };
  if (const std::string remarks = found.remarks(); !remarks.empty())
    note("'" + arguments.mesh + "' has " + remarks + "These are sculpted as they are; --orient turns components that are inside out, "
         "--repair also leaves out vertices without faces");
  if (!arguments.out.empty() && !left_out.empty())
    note("'" + arguments.out + "' will be without what '" + arguments.mesh + "' has besides its faces: " + listed(left_out));
  bool is_told = false;
  const auto tell_failure = [&] { // once, and at once: the work may take hours
    if (log && !log->failure().empty() && !std::exchange(is_told, true))
      note(log->failure() + ". The work goes on without; what the log holds can be resumed");
  };
  const bool is_logging = log && !script.commands.empty();
  if (log) {
    if (log->contents() && !log->contents()->unfinished.empty())
      note("the unfinished last line of the log '" + arguments.log + "' is dropped: " + printable(log->contents()->unfinished));
    log->begin(settings_of(arguments));
    if (is_logging && !plan.rest.is_announced)
      log->begin_pass(script.hash, plan.rest.after);
    tell_failure();
  }
  std::optional<Mesh> without_guard;
  if (!arguments.comparison.empty())
    without_guard = sculpted_without_guard(mesh, script.commands);
  std::size_t made = 0;
  const Run_result result = run(mesh, plan.commands, arguments, [&](const Command& command) {
    if (log && ++made > plan.replayed) {
      log->append(command);
      tell_failure();
    }
  });
  const std::vector<Near_vertex> nearest = nearest_to(arguments, mesh, result);
  bool all_written = write_all(mesh, result, arguments, notes, nearest, before, without_guard);
  if (is_logging && all_written) {
    log->end_pass(script.hash);
    tell_failure();
  }
  all_written = all_written && (!log || log->failure().empty());
  if (plan.replayed > 0)
    std::cout << "replayed " << plan.replayed << " lines of " << arguments.log << '\n';
  if (plan.rest.after > 0)
    std::cout << "went on with " << arguments.script << " after line " << plan.rest.after << '\n';
  if (arguments.nearest)
    print_nearest(std::cout, *arguments.nearest, nearest);
  print_table(std::cout, result, mesh); // last: whoever reads it may close the pipe
  if (!std::cout.flush())
    throw Write_error("cannot write the table to standard output");
  return all_written ? done : cannot_write;
}

/// The message, with advice for people who do not program.
std::string in_words_of_a_user(const Invalid_surface& error, bool is_triangulated) {
  const std::string said = error.what();
  std::string text = said.substr(0, said.find('\n') + 1) + error.report().message(8, Validity_report::Reader::user);
  if (!is_triangulated && !error.report().non_triangular_faces.empty())
    text += "--triangulate divides faces into triangles.\n";
  if (error.report().is_repairable())
    text += "Or let --repair do what it can: sculpt MESH --repair -o REPAIRED.\n";
  return text;
}

} // namespace

int main(int argc, char** argv) {
  const examples::Printable_stream messages(std::cerr), table(std::cout);
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is told like a full disk, and the others are written
  Arguments arguments;
  if (const auto is_good = read_arguments(argc, argv, arguments))
    return *is_good ? done : usage;
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
    std::cerr << "sculpt: " << in_words_of_a_user(error, arguments.triangulate);
    return mesh_refused;
  } catch (const Out_of_range& error) { // those of lengths and of the script have been found before
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
