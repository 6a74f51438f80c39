// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpts in a closed loop with a simulated device in a simulated hand. See --help; formats:
// doc/use/haptic_loop.md.
#include "Arguments.h"
#include "Loop_report.h"

#include "../common/mesh_program.h"
#include "../common/numbers.h"
#include "../common/output_targets.h"
#include "../common/write_file.h"
#include "../count_allocations.h"

#include <haptic_sculpt/haptic_rendering/check_coupling.h>

#include <cmath>
#include <filesystem>
#include <iostream>

std::size_t haptic_sculpt::loop_program::allocations() {
  return allocations_so_far;
}

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::loop_program;

enum Own_exit { unstable = 7, fault = 8 };

/// \throw Usage_error, Write_error
void check_files(const Arguments& a) {
  examples::check_mesh_name({"-o", a.out});
  examples::check_picture_name({"--picture", a.picture});
  examples::Run_files files;
  files.outputs = {{"-o", a.out},         {"--trace", a.trace},     {"--report", a.report},
                   {"--record", a.record}, {"--picture", a.picture}, {"--log", a.log}};
  files.inputs = {{"--replay", a.replay},
                  {"--device", a.device},
                  {"--hand", a.hand},
                  {"--path", a.path},
                  {examples::input_mesh, a.mesh}};
  if (a.log.empty() && a.record.empty()) // a log and a recording begin with the mesh
    files.replaced_by = "-o", files.replaced = examples::input_mesh;
  files.check_apart();
  const auto is_stream = [](const std::string& file) { // rows may go into a pipe as they come
    std::error_code error;
    return std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error) &&
           !std::filesystem::is_directory(file, error);
  };
  for (const std::string& path : {a.out, a.report, a.picture}) // a log looks for itself
    if (!path.empty())
      examples::check_target(path);
  for (const std::string& path : {a.trace, a.record})
    if (!path.empty() && !is_stream(path))
      examples::check_target(path);
}

int loop(const Arguments& arguments) {
  check_files(arguments);
  Plan plan;
  Settings& settings = plan.settings = arguments.settings;
  settings.device = arguments.device.empty() ? default_device() : read_device(arguments.device);
  if (!arguments.hand.empty())
    settings.hand = read_hand(arguments.hand);
  if (!arguments.fault.empty())
    plan.fault = fault_of(arguments.fault);
  if (plan.fault && plan.fault->kind == Loop_fault::log && arguments.log.empty())
    throw Usage_error("--fault log is a fault of the log: give --log, too");
  if (!arguments.replay.empty()) {
    plan.replay = Recording::read(arguments.replay);
    settings = plan.replay->settings;
  } else {
    plan.path = read_path(arguments.path);
    settings.begin = plan.path->at(0).position;
    if (!arguments.seconds && !(plan.path->end() > 0))
      throw Usage_error("the path ends at " + examples::decimal(plan.path->end()) +
                        " s, before the first tick: give --seconds, or times above 0");
    const double seconds = arguments.seconds.value_or(plan.path->end());
    const double tick = 1 / settings.rate;
    double ticks = std::ceil(seconds * settings.rate); // one more or less than there are, by rounding
    if (ticks > 1 && (ticks - 1) * tick >= seconds)
      --ticks;
    else if (ticks * tick < seconds)
      ++ticks;
    const double last_tick = (ticks - 1) * tick;
    if (plan.fault && plan.fault->time > last_tick)
      throw Usage_error("--fault comes at " + examples::decimal(plan.fault->time) + " s, after the last tick, at " +
                        examples::decimal(last_tick) + " s");
    if (plan.fault && (plan.fault->kind == Loop_fault::stall || plan.fault->kind == Loop_fault::jump) &&
        plan.fault->time == 0)
      throw Usage_error("--fault stall@0 or jump@0 comes before the first tick, which has none to differ from: give a "
                        "later time");
  }
  plan.mesh = arguments.mesh, plan.out = arguments.out, plan.log = arguments.log;
  if (arguments.is_real_time && (arguments.does_not_wait || !arguments.replay.empty()))
    throw Usage_error(
        "--real-time is for a run that waits for the time of each tick; leave out --no-wait and --replay");
  plan.picture = arguments.picture, plan.is_real_time = arguments.is_real_time;
  plan.seconds = arguments.seconds.value_or(0);
  plan.waits = !arguments.does_not_wait && !plan.replay;
  plan.trace = arguments.trace, plan.record = arguments.record;
  examples::Result_writer writer("haptic_loop");
  const Run_result result = run_loop(plan, writer);
  if (result.failure)
    writer.note("the run has ended after " + std::to_string(result.ticks) +
                " ticks: " + examples::message_of(result.failure) +
                (writer.all_written() ? ". What was done until then is written" : ""));
  if (!result.log_failure.empty())
    writer.fail(result.log_failure);
  writer.write(arguments.report, [&](const std::string& path) {
    return examples::write_file(path, report_of(result, settings, writer.notes()));
  });
  // A pipe that rows have gone into holds nothing else.
  const bool holds_rows = examples::is_file_of_stream(arguments.trace, S_IFIFO, STDOUT_FILENO) ||
                          examples::is_file_of_stream(arguments.record, S_IFIFO, STDOUT_FILENO);
  print_summary(holds_rows ? std::cerr : std::cout, result, settings);
  if (!std::cout.flush())
    throw Write_error("cannot write the summary to standard output");
  if (result.failure)
    return examples::exit_code_of(result.failure);
  if (!writer.all_written())
    return writer.exit_code();
  if (!result.faults.empty())
    return fault;
  return examples::done;
}

int exit_code_of(const std::exception& error) {
  if (examples::is_a<Unstable_coupling>(error))
    return unstable;
  if (examples::is_a<Hand_path_error>(error))
    return examples::script_error;
  return examples::is_a<Foreign_recording>(error) ? examples::foreign_log : examples::exit_code_of(error);
}

/// Reads the command line, and runs.
int run(int argc, char** argv) {
  Arguments arguments;
  if (const auto asked = read_arguments(argc, argv, arguments))
    return *asked ? examples::done : examples::usage;
  return loop(arguments);
}

} // namespace

int main(int argc, char** argv) {
  return examples::run_mesh_program("haptic_loop", [&] { return run(argc, argv); }, exit_code_of);
}
