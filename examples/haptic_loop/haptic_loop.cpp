// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpts in a closed loop with a simulated device in a simulated hand. See --help; formats: doc/haptic_rendering.md.
#include "Loop_report.h"

#include "../count_allocations.h"
#include "../drawing/Scene.h"
#include "../sculpt/Log_text.h"
#include "../sculpt/output_targets.h"

#include <haptic_sculpt/device/simulation/Torque_delay.h>
#include <haptic_sculpt/haptic_rendering/check_coupling.h>
#include <haptic_sculpt/surface/read_surface.h>

#include <CLI/CLI.hpp>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>

std::size_t haptic_sculpt::loop_program::allocations() {
  return allocations_so_far;
}

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::loop_program;

enum Exit {
  done = 0,
  no_memory = 1,
  usage = 2,
  mesh_refused = 3,
  path_error = 4,
  cannot_write = 5,
  foreign_recording = 6,
  unstable = 7,
  fault = 8
};

struct Arguments {
  std::string mesh = HAPTIC_SCULPT_EXAMPLE_DATA "/ball_and_moon.off",
              path = HAPTIC_SCULPT_EXAMPLE_DATA "/hand_path.csv";
  std::string out, log, device, hand, record, replay, trace, report, picture, fault;
  double seconds = 0;
  bool does_not_wait = false, is_real_time = false;
};

std::atomic<bool> is_interrupted{false};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// \throw Write_error
File opened(const std::string& path) {
  if (path.empty())
    return {nullptr, &std::fclose};
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr)
    throw Write_error("cannot write '" + path + "': " + std::strerror(errno));
  return {file, &std::fclose};
}

void close(File& file, const std::string& path) {
  std::FILE* const raw = file.release();
  if (raw == nullptr)
    return;
  const bool has_failed = std::ferror(raw) != 0;
  if (std::fclose(raw) != 0 || has_failed)
    throw Write_error("cannot write all of '" + path + "': the disk may be full");
}

void check_numbers(const Settings& s, double seconds) {
  const auto require = [](bool holds, const char* what) {
    if (!holds)
      throw Usage_error(what);
  };
  require(s.rate >= 100 && s.rate <= 100000, "--rate must be from 100 to 100000 Hz");
  require(s.delay >= 0 && s.delay <= Torque_delay<double>::most_ticks, "--delay must be from 0 to 16 ticks");
  require(s.stiffness >= 0 && std::isfinite(s.stiffness), "--stiffness must be a finite number >= 0, N/m");
  require(s.damping >= 0 && std::isfinite(s.damping), "--damping must be a finite number >= 0, N s/m");
  require(s.virtual_mass >= 0 && s.virtual_mass <= 10, "--virtual-mass must be from 0 to 10 kg");
  require(s.compensated_inertia >= 0 && s.compensated_inertia <= 1, "--compensated-inertia must be from 0 to 1");
  require(s.controller.value_or(0) >= 0 && std::isfinite(s.controller.value_or(0)), "--controller must be a finite number >= 0, N s/m");
  require(s.reach >= 0 && std::isfinite(s.reach), "--reach must be a finite length >= 0, m");
  require(s.work > 0, "--work must be at least 1");
  require(seconds >= 0 && std::isfinite(seconds), "--seconds must be a finite time >= 0");
  require(s.map.empty() || s.map.size() == 4 || s.map.size() == 7,
          "--map needs 4 numbers, SCALE X Y Z, or 7, with RX RY RZ");
  for (double x : s.map)
    require(std::isfinite(x), "--map must be finite numbers");
  require(s.map.empty() || s.map[0] > 0, "the scale of --map must be > 0");
}

void check_targets(const Arguments& a) {
  if (!a.out.empty() && !mesh_file_format(a.out))
    throw Usage_error("'" + a.out + "' does not end in .off, .ply, .obj or .stl");
  const std::string files[] = {a.out,    a.trace,  a.report, a.record, a.picture, a.log,
                               a.replay, a.device, a.hand,   a.path,   a.mesh};
  const auto may_be_one = [&](std::size_t i, std::size_t j) { // a log begins with the mesh
    return i == 0 && j + 1 == std::size(files) && a.log.empty();
  };
  constexpr std::size_t outputs = 6;
  for (std::size_t i = 0; i < outputs; ++i)
    for (std::size_t j = i + 1; j < std::size(files); ++j)
      if (!files[i].empty() && !files[j].empty() && !may_be_one(i, j) &&
          sculpt_program::are_one_file(files[i], files[j]))
        throw Usage_error("'" + files[i] + "' and '" + files[j] + "' are one file; give each its own");
  const auto is_stream = [&](const std::string& file) { // rows may go into a pipe as they come
    std::error_code error;
    return (file == a.trace || file == a.record) && std::filesystem::exists(file, error) &&
           !std::filesystem::is_regular_file(file, error) && !std::filesystem::is_directory(file, error);
  };
  for (std::size_t i = 0; i + 1 < outputs; ++i) // a log looks for itself
    if (!files[i].empty() && !is_stream(files[i]))
      sculpt_program::check_target(files[i]);
}

Exit loop(const Arguments& arguments, Plan& plan) {
  Settings& settings = plan.settings;
  check_numbers(settings, arguments.seconds);
  check_targets(arguments);
  settings.device = arguments.device.empty() ? default_device() : read_device(arguments.device);
  if (!arguments.hand.empty())
    settings.hand = read_hand(arguments.hand);
  if (!arguments.fault.empty())
    plan.fault = fault_of(arguments.fault);
  if (!arguments.replay.empty()) {
    plan.replay = Recording::read(arguments.replay);
    settings = plan.replay->settings;
  } else
    plan.path = read_path(arguments.path);
  plan.mesh = arguments.mesh, plan.out = arguments.out, plan.log = arguments.log;
  if (arguments.is_real_time && (arguments.does_not_wait || !arguments.replay.empty()))
    throw Usage_error(
        "--real-time is for a run that waits for the time of each tick; leave out --no-wait and --replay");
  plan.picture = arguments.picture, plan.is_real_time = arguments.is_real_time;
  plan.seconds = arguments.seconds;
  plan.waits = !arguments.does_not_wait && !plan.replay;
  File trace = opened(arguments.trace), record = opened(arguments.record);
  plan.trace = trace.get(), plan.record = record.get();
  std::vector<std::string> notes;
  const Run_result result = run_loop(plan, notes, is_interrupted);
  for (const std::string& note : notes)
    std::cerr << "haptic_loop: " << note << '\n';
  close(trace, arguments.trace), close(record, arguments.record);
  if (!arguments.report.empty())
    replace_file(arguments.report, report_of(result, settings, notes));
  print_summary(std::cout, result, settings);
  if (!std::cout.flush())
    throw Write_error("cannot write the summary to standard output");
  if (!result.log_failure.empty())
    throw Write_error(result.log_failure);
  return result.faults.empty() ? done : fault;
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGINT, [](int) { is_interrupted = true; });
  std::signal(SIGTERM, [](int) { is_interrupted = true; });
  Arguments arguments;
  Plan plan;
  Settings& settings = plan.settings;
  CLI::App app("Sculpts in a closed loop: a simulated device in a simulated hand that follows a path.\n"
               "Exit: 0 done, 1 out of memory, 2 usage, 3 mesh refused, 4 path cannot be read, 5 cannot write, "
               "6 recording of another mesh, 7 stiffness not passive, or damping, virtual mass or controller not stable, 8 a fault "
               "ended the run.");
  app.add_option("MESH", arguments.mesh, "Input: .off .ply .obj .stl")->capture_default_str();
  app.add_option("-o,--output", arguments.out, "Where the sculpted mesh goes");
  app.add_option("--seconds", arguments.seconds, "How long; by default as long as the path");
  app.add_option("--rate", settings.rate, "Ticks a second, Hz")->capture_default_str();
  app.add_option("--delay", settings.delay, "From a command to its torque, ticks")->capture_default_str();
  app.add_option("--stiffness", settings.stiffness, "Of the coupling, at the handle, N/m")->capture_default_str();
  app.add_option("--damping", settings.damping, "Of the coupling, at the handle, N s/m")->capture_default_str();
  app.add_option("--virtual-mass", settings.virtual_mass, "What is grabbed weighs so much more when shaken, kg")
      ->capture_default_str();
  app.add_option("--compensated-inertia", settings.compensated_inertia,
                 "Share of the device's own inertia that its motors carry, 0 to 1")
      ->capture_default_str();
  app.add_option("--controller", settings.controller,
                 "The most that the passivity controller may damp, N s/m; 0: there is none; by default half of what may be");
  app.add_option("--map", settings.map,
                 "SCALE X Y Z [RX RY RZ]: scene = (X, Y, Z) + SCALE R (device - home); by default the scene is fitted")
      ->expected(4, 7);
  app.add_option("--reach", settings.reach, "Of a grab, m in the device")->capture_default_str();
  app.add_option("--work", settings.work, "Pairs that a drag may decide")->capture_default_str();
  app.add_option("--device", arguments.device, "Device, JSON");
  app.add_option("--hand", arguments.hand, "Hand, JSON");
  app.add_option("--path", arguments.path, "Where the hand wants to be: t,x,y,z,button")->capture_default_str();
  app.add_option("--fault", arguments.fault, "KIND@SECONDS: nan, jump, stall, singular, torque or log");
  app.add_option(
      "--log", arguments.log,
      "Where what is done goes while it is done, for `sculpt` too; one that is there is made again, then gone on with");
  app.add_option("--record", arguments.record, "Where the readings of the device go");
  app.add_option("--replay", arguments.replay, "A recording instead of device, hand and path; its settings hold");
  app.add_option("--trace", arguments.trace, "Where a row a tick goes: .csv");
  app.add_option("--report", arguments.report, "Where the JSON report goes");
  app.add_option("--picture", arguments.picture, "Where a picture of the run goes: .png");
  app.add_flag(
      "--real-time", arguments.is_real_time,
      "Asks the system for a thread that goes first (SCHED_FIFO) and memory that stays; says what it does not give");
  app.add_flag("--no-wait", arguments.does_not_wait, "As fast as it goes");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : usage;
  }
  const auto fail = [](const std::exception& error, Exit code) {
    std::cerr << "haptic_loop: " << error.what() << '\n';
    return code;
  };
  try {
    return loop(arguments, plan);
  } catch (const Unstable_coupling& error) {
    return fail(error, unstable);
  } catch (const Hand_path_error& error) {
    return fail(error, path_error);
  } catch (const Foreign_recording& error) {
    return fail(error, foreign_recording);
  } catch (const sculpt_program::Foreign_log& error) {
    return fail(error, foreign_recording);
  } catch (const sculpt_program::Script_error& error) {
    return fail(error, path_error);
  } catch (const Write_error& error) {
    return fail(error, cannot_write);
  } catch (const drawing::Picture_error& error) {
    return fail(error, cannot_write);
  } catch (const Read_error& error) {
    return fail(error, mesh_refused);
  } catch (const Invalid_surface& error) {
    return fail(error, mesh_refused);
  } catch (const std::bad_alloc&) {
    std::cerr << "haptic_loop: the memory does not suffice for this mesh\n";
    return no_memory;
  } catch (const Error& error) {
    return fail(error, usage);
  }
}
