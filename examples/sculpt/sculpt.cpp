// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpts a mesh from a script. See --help; options and exit codes: doc/use/sculpt.md, script: script.md,
// report: report.md.
#include "../common/Log_file.h"
#include "../common/Result_writer.h"
#include "../common/contents_of.h"
#include "../common/mesh_program.h"
#include "../common/numbers.h"
#include "../common/output_targets.h"
#include "../common/printable.h"
#include "../common/told_loss.h"
#include "../common/write_file.h"
#include "Progress.h"
#include "Report.h"
#include "comparison.h"
#include "nearest_vertices.h"
#include "picture.h"
#include "read_mesh.h"
#include "resume.h"

#include <haptic_sculpt/sculpting/paper_1997.h>
#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>
#include <haptic_sculpt/surface/orient_components.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <numeric>
#include <system_error>
#include <utility>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::sculpt_program;
using Kind = Command::Kind;
using examples::Result_writer;

/// A script, and the hash that a log knows it by.
struct Script {
  std::vector<Command> commands;
  std::string hash;
};

Script script_of(const Arguments& arguments, Result_writer& writer) {
  if (arguments.script.empty())
    return {};
  const std::string text = examples::contents_of<Script_error>(arguments.script, "the script");
  const std::string_view whole = examples::whole_commands_of(text);
  if (whole.size() != text.size())
    writer.note("'" + arguments.script + "' is a log whose last command is unfinished: that is left out");
  return {read_script(whole, arguments.script), Sha256().add(text).digest()};
}

/// \throw Usage_error, Write_error
void check_files(const Arguments& a) {
  examples::check_mesh_name({"-o", a.out});
  examples::check_picture_name({"--picture", a.picture}), examples::check_picture_name({"--compare", a.comparison});
  examples::Run_files files;
  files.outputs = {{"--log", a.log},
                   {"-o", a.out},
                   {"--report", a.report},
                   {"--picture", a.picture},
                   {"--compare", a.comparison},
                   {"--repair-report", a.repair.report}};
  files.inputs = {{examples::input_mesh, a.mesh}, {"--script", a.script}};
  if (a.log.empty()) // the result may take the place of the mesh that was read
    files.replaced_by = "-o", files.replaced = examples::input_mesh;
  else if (!a.out.empty() && examples::are_one_file(a.out, a.mesh))
    throw Usage_error("'" + a.out + "' is the mesh that the log '" + a.log +
                      "' begins with; sculpted, it could not be resumed from the log. Give the result another name");
  files.check_apart();
  for (const std::string& path : {a.out, a.report, a.picture, a.comparison, a.repair.report}) // a log looks for itself
    if (!path.empty())
      examples::check_target(path);
  if (std::error_code error; !a.log.empty() && !std::filesystem::exists(a.log, error)) // else it is looked at later
    examples::check_target(a.log);
}

/// \param hash of the mesh \throw Foreign_log
void check_mesh_directives(const std::vector<Command>& script, const Arguments& arguments, const std::string& hash) {
  for (const Command& command : script)
    if (command.kind == Kind::mesh && command.word != hash)
      throw Foreign_log(arguments.script + ": line " + std::to_string(command.line) + " is about the mesh " +
                        command.word + ", but '" + arguments.mesh + "' is " + hash +
                        " (with other --repair, --triangulate or --orient it is another surface)");
}

Run_result run(Mesh& mesh, const std::vector<Command>& script, const Arguments& arguments, const Run_hooks& hooks) {
  Sculptor_parameters parameters;
  parameters.delta(arguments.delta.value_or(0));
  if (!arguments.response.empty())
    parameters.response(*response_by_name(arguments.response));
  if (arguments.clearance)
    parameters.clearance(*arguments.clearance);
  if (arguments.broad_phase == "brute")
    return run_script<Brute_force_broad_phase<Mesh>>(mesh, script, parameters, hooks);
  if (arguments.broad_phase == "six-lists")
    return run_script<Six_list_broad_phase<Mesh>>(mesh, script, parameters, hooks);
  return run_script<Box_tree_broad_phase<Mesh>>(mesh, script, parameters, hooks);
}

/// \throw Usage_error
void check_lengths(const Arguments& arguments) {
  const auto check = [](const char* option, const std::optional<double>& length, bool may_be_0) {
    if (length && !((may_be_0 ? *length >= 0 : *length > 0) && is_in_range(*length)))
      throw Usage_error(option + std::string(" must be a length ") + (may_be_0 ? ">= 0" : "> 0") +
                        " and at most 2^1000, about 1.07e301");
  };
  check("--clearance", arguments.clearance, false);
  check("--delta", arguments.delta, true);
  check("--repair-gap", arguments.repair.gap, true);
  for (const double x : arguments.nearest.value_or(std::array<double, 3>{}))
    if (!is_in_range(x))
      throw Usage_error("--nearest takes finite coordinates of at most 2^1000, about 1.07e301; " +
                        examples::decimal(x) + " is none");
}

/// A mesh whose only fault is that a delta was asked for which it does not have.
struct Delta_of_no_use : Error {
  using Error::Error;
};

/// As it is sculpted. \throw Delta_of_no_use; what reading meshes throws
Sculpted_mesh mesh_of(const examples::Mesh_file& file, const Arguments& arguments, Result_writer& writer) {
  const double delta = arguments.delta.value_or(0);
  if (arguments.repair.is_asked) {
    std::string told;
    Sculpted_mesh read = [&] {
      const Progress progress("repairing '" + arguments.mesh + "'");
      return read_repaired(file, arguments, writer, told);
    }();
    std::cout << told;
    return read;
  }
  try {
    Sculpted_mesh read = [&] {
      const Progress progress("reading and validating '" + arguments.mesh + "'");
      return read_mesh(file, arguments);
    }();
    if (arguments.orient && !read.found.inside_out_components.empty()) {
      std::cout << "components turned over: " << orient_components(read.mesh) << '\n';
      read.found.inside_out_components.clear();
      read.is_changed = true;
    }
    return read;
  } catch (const Invalid_surface& error) {
    const auto& low = error.report().low_faces;
    if (low.empty() || low.size() != error.report().number_of_faults())
      throw;
    throw Delta_of_no_use(
        "--delta " + examples::decimal(delta) + " does not serve '" + arguments.mesh + "'," +
        (arguments.triangulate ? " its faces divided into triangles," : "") + " which has " +
        std::to_string(low.size()) + " triangle(s) with an altitude below it, the first of them face " +
        std::to_string(static_cast<std::size_t>(low[0])) + "; give a smaller length, or leave the option out");
  }
}

/// What `--nearest` asks for, of the sculpted mesh; nothing where it does not.
std::vector<Near_vertex> nearest_to(const Arguments& arguments, const Mesh& mesh, const Run_result& result) {
  std::vector<Near_vertex> found;
  if (!arguments.nearest)
    return found;
  constexpr std::size_t most = 8;
  std::vector<std::size_t> places(result.numbers.size()); // in vertex_order, which is in the order of the numbers
  std::iota(places.begin(), places.end(), std::size_t(0));
  const auto point_of = [&](std::size_t i) {
    return mesh.point(Vertex_index(static_cast<Mesh::size_type>(result.vertex_order[i])));
  };
  const auto& [x, y, z] = *arguments.nearest;
  for (const std::size_t i : nearest_vertices(std::move(places), point_of, {x, y, z}, most)) {
    const Kernel::Point_3 p = point_of(i);
    found.push_back({result.numbers[i], {p.x(), p.y(), p.z()}, distance({p.x(), p.y(), p.z()}, *arguments.nearest)});
  }
  return found;
}

/// Of points and faces, to the last bit.
std::string sha256_of_surface(const Mesh& mesh) {
  return examples::Sha256().add(surface_bytes(mesh, "surface.off")).digest();
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
      Command end(Edit::of(Edit_kind::end));
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

/// Writes what was asked for; the report last, with what there is to say of the others.
void write_all(Result_writer& writer, const Mesh& mesh, const Run_result& result,
                      const Arguments& arguments, const std::vector<Near_vertex>& nearest,
                      const drawing::Scene& before, const std::optional<Mesh>& without_guard) {
  writer.write(arguments.out, [&](const std::string& path) {
    return examples::write_mesh(path, mesh, Write_parameters().vertex_order(result.vertex_order));
  });
  writer.write(arguments.picture,
          [&](const std::string& path) { return write_picture_of(mesh, result, before, path, arguments.shown); });
  writer.write(arguments.comparison,
          [&](const std::string& path) { return write_comparison(*without_guard, mesh, path, arguments.shown.view); });
  writer.write(arguments.report, [&](const std::string& path) {
    return examples::write_file(path, report_of(result, writer.notes(), nearest));
  });
}

int sculpt(const Arguments& arguments) {
  check_lengths(arguments);
  Result_writer writer("sculpt");
  const Script script = script_of(arguments, writer);
  check_files(arguments);
  // A log is of what is sculpted: of the file, unless an option makes another surface of it, which is looked at first.
  const examples::Mesh_file file(arguments.mesh);
  std::optional<Sculpted_mesh> read;
  if (arguments.repair.is_asked || arguments.triangulate || arguments.orient)
    read = mesh_of(file, arguments, writer);
  const std::string hash = read && read->is_changed ? sha256_of_surface(read->mesh) : file.hash();
  std::optional<Log_file> log;
  if (!arguments.log.empty())
    log.emplace(arguments.log, hash);
  if (log && log->contents() && ends_within_move(script.commands, script.hash, *log->contents()))
    log->drop_last_line();
  const Plan plan = plan_of(script, log ? &*log : nullptr, arguments);
  if (!read)
    read = mesh_of(file, arguments, writer);
  Mesh& mesh = read->mesh;
  check_mesh_directives(script.commands, arguments, hash);
  const drawing::Scene before = needs_before(arguments.shown) ? drawing::scene_of(mesh) : drawing::Scene();

  if (const std::string remarks = read->found.remarks(); !remarks.empty())
    writer.note("'" + arguments.mesh + "' has " + remarks +
                "They are sculpted as they are; --orient turns components over "
                "that are inside out");
  if (const std::string loss = examples::told_loss(arguments.mesh, arguments.out, mesh, read->left_out); !loss.empty())
    writer.note(loss);
  bool is_told = false;
  const auto tell_failure = [&] { // once, and at once: the work may take hours
    if (log && !log->failure().empty() && !std::exchange(is_told, true))
      writer.note(log->failure() + ". The work goes on without; what the log holds can be resumed");
  };
  const bool is_logging = log && !script.commands.empty();
  const auto begin_log = [&] {
    if (!log)
      return;
    if (log->contents() && !log->contents()->unfinished.empty())
      writer.note("the unfinished last line of the log '" + arguments.log +
                  "' is dropped: " + printable(log->contents()->unfinished));
    log->begin(settings_of(arguments));
    if (is_logging && !plan.rest.is_announced)
      log->begin_pass(script.hash, plan.rest.after);
    tell_failure();
  };
  const auto begin = [&] { // once nothing is refused any more
    begin_log();
    if (arguments.repair.is_asked)
      write_repair_report(arguments, writer, *read);
  };
  std::optional<Mesh> without_guard;
  if (!arguments.comparison.empty())
    without_guard = sculpted_without_guard(mesh, script.commands, arguments.script);
  const auto append_to_log = [&](const Command& command) {
    if (log && !command.is_logged) {
      log->append(command);
      tell_failure();
    }
  };
  const Run_result result = run(mesh, plan.commands, arguments, {begin, append_to_log});
  if (result.failure)
    writer.note((result.failed.is_logged ? arguments.log : arguments.script) + ": line " +
                std::to_string(result.failed.line) + ": `" + result.failed.name + "` has ended the script: " +
                examples::message_of(result.failure) + ". What was done until then is written" +
                (result.may_be_in_part ? ", with what this line may have done, which log and report may lack" : ""));
  const std::vector<Near_vertex> nearest = nearest_to(arguments, mesh, result);
  write_all(writer, mesh, result, arguments, nearest, before, without_guard);
  if (is_logging && writer.all_written() && !result.failure) {
    log->end_pass(script.hash);
    tell_failure();
  }
  const bool is_log_whole = !log || log->failure().empty();
  if (plan.replayed > 0)
    std::cout << "replayed " << plan.replayed << " lines of " << arguments.log << '\n';
  if (plan.rest.after > 0)
    std::cout << "went on with " << arguments.script << " after line " << plan.rest.after << '\n';
  if (arguments.nearest)
    print_nearest(std::cout, *arguments.nearest, nearest);
  print_table(std::cout, result, mesh); // last: whoever reads it may close the pipe
  if (!std::cout.flush())
    throw Write_error("cannot write the table to standard output");
  if (result.failure)
    return examples::exit_code_of(result.failure);
  return is_log_whole ? writer.exit_code() : examples::cannot_write;
}

} // namespace

int main(int argc, char** argv) {
  const auto exit_code_of = [](const std::exception& error) {
    return examples::is_a<Delta_of_no_use>(error) ? examples::mesh_refused : examples::exit_code_of(error);
  };
  return examples::run_mesh_program("sculpt", [&]() -> int {
    const examples::Printable_stream table(std::cout);
    Arguments arguments;
    if (const auto is_good = read_arguments(argc, argv, arguments))
      return *is_good ? examples::done : examples::usage;
    return sculpt(arguments);
  }, exit_code_of);
}
