// SPDX-License-Identifier: GPL-3.0-or-later
#include "Options.h"

#include "keys.h"

#include "../common/output_targets.h"
#include "../common/parse_arguments.h"

#include <haptic_sculpt/version.h>

#include <filesystem>
#include <system_error>

namespace haptic_sculpt::window_program {
namespace {

std::string lists() {
  std::string text = "Mouse:\n";
  const auto line = [&text](const std::string& how, const std::string& what) {
    text += "  " + how + std::string(how.size() < 24 ? 24 - how.size() : 1, ' ') + what + '\n';
  };
  for (const Mouse_use& use : mouse_uses())
    line(use.how, use.what);
  text += "Keys:\n";
  for (const Key& key : keys())
    line(key.name, key.what);
  return text +
         "Script, one action a line; # comments; PLACE is X Y in pixels from the upper left, or @X,Y,Z of the mesh:\n"
         "  move PLACE | press left|right|middle [shift|ctrl|alt] | release | click PLACE\n"
         "  drag PLACE PLACE [STEPS] [normal|ctrl|right|middle] | scroll NOTCHES [ctrl|shift] | key NAME\n"
         "  view X Y Z | orbit DEGREES DEGREES | zoom FACTOR | fit\n"
         "  tool drag|probe|create|remove|brush|object | brush KIND RADIUS [STRENGTH] | depth LENGTH\n"
         "  symmetry x|y|z... | symmetry none | remesh [LENGTH]\n"
         "  wait SECONDS | settle | screenshot FILE | save FILE | open FILE | record FILE\n"
         "  print | where PLACE | close | quit\n"
         "Exit: 0 done, 1 out of memory or a fault of the program, 2 usage, 3 mesh refused, 4 script error, 5 cannot "
         "write, 6 log of another mesh, 7 no window can be made.";
}

} // namespace

std::string Options::log_of(const std::string& path) const {
  return without_log ? "" : !log.empty() && examples::are_one_file(path, mesh) ? log : log_beside(path);
}

std::string Options::sculpted_beside(const std::string& path) {
  const std::filesystem::path mesh(path);
  return (mesh.parent_path() / (mesh.stem().string() + "_sculpted" + mesh.extension().string())).string();
}

void check_files(const Options& options) {
  if (options.has_out) // else it has the name of the mesh, which is looked at when that is read
    examples::check_mesh_name({"-o", options.out});
  examples::check_picture_name({"--screenshot", options.screenshot});
  examples::Run_files files;
  files.outputs = {{"-o", options.out},
                   {"--record", options.record},
                   {"--report", options.report},
                   {"--screenshot", options.screenshot},
                   {"the log", options.log_of(options.mesh)}};
  files.inputs = {{examples::input_mesh, options.mesh}, {"--script", options.script}};
  if (options.without_log) // a log begins with the mesh
    files.replaced_by = "-o", files.replaced = examples::input_mesh;
  files.check_apart();
  for (const std::string& path : {options.report, options.screenshot}) // what is saved may find another place later
    if (!path.empty())
      examples::check_target(path);
}

std::optional<bool> read_options(int argc, char** argv, Options& options) {
  CLI::App app("A window to sculpt a closed triangle mesh in; no surface ever passes through a surface.");
  app.set_version_flag("--version", std::string("sculpt_window of haptic_sculpt ") + HAPTIC_SCULPT_VERSION);
  app.footer(lists());
  app.add_option("MESH", options.mesh,
                 "Input: .off .ply .obj .stl; by default sculpt_window_ball.off, a ball that is written there");
  app.add_option("-o,--output", options.out,
                 "Where the key s saves to: .off .ply .obj .stl; by default MESH_sculpted, of the mesh that is open");
  auto* const log = app.add_option(
      "--log", options.log,
      "Edit log, as of sculpt: replayed if it exists, then appended to, and kept. By default MESH.log, "
      "which is removed when the window is closed with all saved, or left by its question; else the next "
      "run goes on from it");
  app.add_flag("--no-log", options.without_log, "Keeps no log: what is not saved is lost if the program ends badly")
      ->excludes(log);
  app.add_option("--script", options.script, "Actions to be carried out, see below")->check(CLI::ExistingFile);
  app.add_option("--record", options.record, "Writes what the hand does as such a script");
  app.add_option("--screenshot", options.screenshot,
                 "Writes a picture of the window, after the script, and quits: .png");
  app.add_option("--report", options.report, "Where frame and loop times go, as JSON, at the end");
  app.add_option("--size", options.size, "WIDTH HEIGHT of the window, in pixels")->check(CLI::Range(64, 8192));
  app.add_option("--samples", options.samples,
                 "A pixel is drawn by: 0 is fastest, 4 has smooth edges. By default 4, but 0 where the driver draws in "
                 "software")
      ->check(CLI::Range(0, 16));
  try {
    examples::parse_arguments(app, argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0;
  }
  std::error_code unknown; // whether it is there: then writing it says why
  options.makes_ball = options.mesh.empty() && !std::filesystem::exists(Options::ball(), unknown);
  if (options.mesh.empty())
    options.mesh = Options::ball();
  options.has_out = !options.out.empty();
  if (!options.has_out)
    options.out = Options::sculpted_beside(options.mesh);
  return std::nullopt;
}

} // namespace haptic_sculpt::window_program
