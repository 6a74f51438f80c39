// SPDX-License-Identifier: GPL-3.0-or-later
#include "Arguments.h"

#include "../common/parse_arguments.h"

#include <cmath>

namespace haptic_sculpt::loop_program {
namespace {

void check_numbers(const Settings& settings, const std::optional<double>& seconds) {
  if (const auto bad = bad_setting(settings))
    throw Usage_error("--" + bad->option + ' ' + bad->demand);
  if (seconds && !(*seconds > 0 && std::isfinite(*seconds)))
    throw Usage_error("--seconds must be a finite time > 0; leave it out for as long as the path");
}

} // namespace

std::optional<bool> read_arguments(int argc, char** argv, Arguments& arguments) {
  Settings& settings = arguments.settings;
  CLI::App app(
      "Sculpts in a closed loop: a simulated device in a simulated hand that follows a path.\n"
      "Exit: 0 done, 1 out of memory or a fault of the program, 2 usage, 3 mesh refused, 4 path or log cannot be read, "
      "5 cannot write, 6 recording or log of another mesh, 7 stiffness not passive or not calm, or damping, "
      "virtual mass or controller too large, 8 a fault ended the run.");
  app.add_option("MESH", arguments.mesh, "Input: .off .ply .obj .stl")->capture_default_str();
  app.add_option("-o,--output", arguments.out, "Where the sculpted mesh goes");
  app.add_option("--seconds", arguments.seconds, "How long; by default as long as the path");
  app.add_option("--rate", settings.rate, "Ticks a second, Hz")->capture_default_str();
  app.add_option("--delay", settings.delay, "From a command to its torque, ticks")->capture_default_str();
  app.add_option("--stiffness", settings.stiffness, "Of the coupling, at the handle, N/m")->capture_default_str();
  app.add_option("--damping", settings.damping, "Of the coupling, at the handle, N s/m")->capture_default_str();
  app.add_option("--virtual-mass", settings.virtual_mass, "What is grabbed weighs so much more when shaken, kg")
      ->capture_default_str();
  app.add_option(
      "--controller", settings.controller,
      "The most that the passivity controller may damp, N s/m; 0: there is none; by default half of what may be");
  app.add_option("--map", settings.map,
                 "SCALE X Y Z [RX RY RZ]: scene = (X, Y, Z) + SCALE R (device - home); by default the scene is fitted")
      ->expected(4, 7);
  app.add_option("--reach", settings.reach, "Of a grab, m in the device")->capture_default_str();
  std::vector<double> snap;
  app.add_option(
         "--snap", snap,
         "LENGTH [FORCE]: a hand that holds nothing is drawn to the nearest vertex within LENGTH, m, by at most "
         "FORCE, N (0.2); counts as a stiffness of 2 FORCE / LENGTH")
      ->expected(1, 2);
  app.add_option("--work", settings.work, "Pairs that a drag may decide")->capture_default_str();
  app.add_option("--device", arguments.device, "Device, JSON");
  app.add_option("--hand", arguments.hand, "Hand, JSON");
  app.add_option("--path", arguments.path, "Where the hand wants to be: t,x,y,z,button")->capture_default_str();
  app.add_option("--fault", arguments.fault, "KIND@SECONDS: nan, jump, stall, singular, torque or log");
  app.add_option(
      "--log", arguments.log,
      "Where what is done goes while it is done, for `sculpt` too; one that is there is made again, then gone on with");
  app.add_option("--record", arguments.record, "Where the readings of the device go");
  auto* const replay =
      app.add_option("--replay", arguments.replay, "A recording instead of device, hand and path; its settings hold");
  for (const char* const set_there :
       {"--seconds", "--rate", "--delay", "--stiffness", "--damping", "--virtual-mass", "--controller", "--map",
        "--reach", "--snap", "--work", "--device", "--hand", "--path", "--fault"})
    replay->excludes(set_there);
  app.add_option("--trace", arguments.trace, "Where a row a tick goes: .csv");
  app.add_option("--report", arguments.report, "Where the JSON report goes");
  app.add_option("--picture", arguments.picture, "Where a picture of the run goes: .png");
  app.add_flag(
      "--real-time", arguments.is_real_time,
      "Asks the system for a thread that goes first (SCHED_FIFO) and memory that stays; says what it does not give");
  app.add_flag("--no-wait", arguments.does_not_wait, "As fast as it goes");
  try {
    examples::parse_arguments(app, argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0;
  }
  if (!snap.empty())
    settings.snap = {snap[0], snap.size() > 1 ? snap[1] : settings.snap.force};
  check_numbers(settings, arguments.seconds);
  return std::nullopt;
}

} // namespace haptic_sculpt::loop_program
