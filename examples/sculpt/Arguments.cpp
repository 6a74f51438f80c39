// SPDX-License-Identifier: GPL-3.0-or-later
#include "Arguments.h"

#include "../common/numbers.h"
#include "../common/parse_arguments.h"

#include <haptic_sculpt/version.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace haptic_sculpt::sculpt_program {
namespace {

template <class Numbers>
bool are_finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

} // namespace

std::optional<bool> read_arguments(int argc, char** argv, Arguments& arguments) {
  CLI::App app("Sculpts a closed triangle mesh from a script; no surface ever passes through a surface.\n"
               "Exit: 0 done (blocked drags and refused edits are done), 1 out of memory or a fault of the program, 2 "
               "usage, 3 mesh refused, 4 "
               "script error, "
               "5 cannot write, 6 script or log of another mesh, or no log.\n"
               "Script, one edit a line; # comments; numbers decimal or hexadecimal; a vertex by its number, or the "
               "nearest to a point by @X,Y,Z:\n"
               "  drag V X Y Z | release | probe X Y Z X2 Y2 Z2\n"
               "  insert_face A B C X Y Z | insert_edge A B X Y Z | remove V | collapse A B | flip A B\n"
               "  move V X Y Z (the object of V, by a vector)\n"
               "  brush grab|inflate|smooth|flatten|pinch X Y Z RADIUS STRENGTH [NX NY NZ] | remesh L\n"
               "  shift AXIS N, N lines V C, end | undo | redo | stroke ... end (what is between is one step of undo)\n"
               "  response slide|stop|paper | clearance L|default | delta L | mesh SHA256");
  app.set_version_flag("--version", std::string("sculpt of haptic_sculpt ") + HAPTIC_SCULPT_VERSION);
  app.add_option("MESH", arguments.mesh, "Input: .off .ply .obj .stl")->required();
  app.add_option("--script", arguments.script, "The edits; - reads them from standard input");
  app.add_option("-o,--output", arguments.out, "Where the sculpted mesh goes: .off .ply .obj .stl");
  app.add_option("--report", arguments.report, "Where the JSON report goes");
  app.add_option("--log", arguments.log,
                 "Edit log: replayed if it exists, then appended to. The same command goes on where it stopped");
  app.add_flag("--append", arguments.append,
               "With a log that has the whole script already: makes the same edits once more")
      ->needs("--log")
      ->needs("--script");
  app.add_option("--response", arguments.response, "What a blocked vertex does: slide (the default), stop or paper")
      ->check(CLI::IsMember({"slide", "stop", "paper"}));
  app.add_option("--broad-phase", arguments.broad_phase, "How candidates are found; the results are the same")
      ->capture_default_str()
      ->check(CLI::IsMember({"tree", "six-lists", "brute"}));
  app.add_option("--clearance", arguments.clearance,
                 "Distance kept from what blocks, > 0; by default 4 ulp of the largest coordinate of what touches");
  app.add_option("--delta", arguments.delta, "No triangle altitude may be less, >= 0; by default 0");
  app.add_option("--picture", arguments.picture, "Where a picture goes: .png");
  Picture_arguments& shown = arguments.shown;
  const CLI::Validator place(
      [](const std::string& text) -> std::string {
        const bool is_number = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        const auto place = examples::place_of(text);
        if (is_number || text == "edit" || (place && are_finite(*place)))
          return "";
        return "'" + text + "' is not a vertex's number, @X,Y,Z of finite numbers, or edit";
      },
      "V|@X,Y,Z|edit");
  app.add_flag("--picture-numbers", shown.numbers, "In the picture: the numbers of vertices, where there is room")
      ->needs("--picture");
  app.add_option("--picture-view", shown.view, "The direction in which one looks into it, or into that of --compare")
      ->expected(3)
      ->type_name("X Y Z");
  app.add_option(
         "--picture-at", shown.at,
         "What is in its middle: a vertex by its number, a place @X,Y,Z, or 'edit': where the last drag or probe that "
         "was blocked ended, or else the last edit that has a place")
      ->check(place)
      ->needs("--picture");
  app.add_option("--picture-zoom", shown.zoom, "How large; 1 is all of the mesh; by default 8 with --picture-at")
      ->check([](const std::string& text) -> std::string { // CLI::Range lets pass what is no number
        const double zoom = examples::number_of(text).value_or(0);
        return zoom >= 0.25 && zoom <= 1e5 ? "" : "'" + text + "' is not a number from 0.25 to 100000";
      })
      ->needs("--picture");
  app.add_flag("--picture-before", shown.before, "Two side by side: before the edits, and after")->needs("--picture");
  app.add_option(
         "--picture-color", shown.color,
         "Colours by displacement (from where a vertex was before the edits) or by altitude (the least one of the "
         "triangles at a vertex)")
      ->check(CLI::IsMember({"displacement", "altitude"}))
      ->needs("--picture");
  app.add_option("--compare", arguments.comparison,
                 "Where a picture goes (.png): left what the same script makes without the guard, right with it")
      ->needs("--script")
      ->excludes("--log");
  app.add_option("--nearest", arguments.nearest,
                 "Prints the vertices nearest to the point X Y Z, with their numbers, after the edits")
      ->type_name("X Y Z");
  app.add_flag("--triangulate", arguments.triangulate, "Divides faces with more than three corners into triangles");
  app.add_flag("--orient", arguments.orient, "Turns over components that are inside out, and repairs nothing else");
  app.add_flag(
      "--repair", arguments.repair.is_asked,
      "Repairs the mesh on reading, and says how; with -o and no script: converts a broken mesh into a valid one");
  app.add_option("--repair-report", arguments.repair.report, "Where the steps of the repair go, as JSON")
      ->needs("--repair");
  app.add_option(
         "--repair-gap", arguments.repair.gap,
         "Points on open edges become one where they are at most this length apart, >= 0; by default 1e-6 of the "
         "extent where edges are much longer")
      ->needs("--repair");
  app.add_option("--repair-largest-hole", arguments.repair.largest_hole,
                 "Holes with more edges than this are not closed, and the mesh is refused; by default all are closed")
      ->needs("--repair");
  try {
    examples::parse_arguments(app, argc, argv);
    if (!shown.view.empty() && arguments.picture.empty() && arguments.comparison.empty())
      throw CLI::RequiresError("--picture-view", "--picture or --compare");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0;
  }
  if (shown.view.size() == 3 && (shown.view == std::vector<double>(3, 0.0) || !are_finite(shown.view))) {
    std::cerr << "--picture-view takes a direction: three finite numbers that are not all 0\n";
    return false;
  }
  if (arguments.script == "-")
    arguments.script = "/dev/stdin";
  return std::nullopt;
}

} // namespace haptic_sculpt::sculpt_program
