// SPDX-License-Identifier: GPL-3.0-or-later
// Drags and edits real and generated meshes at random and on purpose, and checks every promise afterwards.
#include "Run.h"
#include "hard_meshes.h"

#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
  using namespace haptic_sculpt;
  robustness::Options options;
  CLI::App app(
      "Drags vertices, and mixes drags with creations, removals, undo and redo, at random and on purpose; checks every "
      "promise.\n"
      "Exit: 10 a mesh is no longer "
      "embedded, 11 fewer than 95 % of "
      "the short "
      "drags arrived, 12 a push through the object did not move without reason, 13 a mesh that has to be refused "
      "was accepted, 14 one was refused where --refuse names others, 15 an element not in hand has changed, 16 undoing "
      "everything does not give back the input, 17 redoing everything does not give back the end, 18 more than 1 % of "
      "the "
      "feasible creations were refused, 19 a creation was accepted that crosses or jumps over a part of the surface, "
      "20 an extreme drag "
      "left a coordinate that is not finite, 21 one ended farther from its target than it began, 22 one was refused "
      "but moved something, 23 "
      "the result of a drag contradicts itself, 24 another broad phase has led to other results.");
  app.add_option("--meshes", options.folder,
                 "Folder of meshes to work on before the generated ones; what cannot be read, or is refused, is listed")
      ->check(CLI::ExistingDirectory);
  app.add_flag("--repair", options.repairs, "Files of the folder that are refused are repaired, and worked on then");
  app.add_option("--refuse", options.refuse,
                 "File names in the folder that have to be refused; the others have to be accepted then");
  app.add_option("--drags", options.drags, "Drags on each mesh")->capture_default_str();
  app.add_option("--drags-on-large", options.drags_on_large,
                 "Drags on meshes of 200,000 faces or valence 4,000 or more")
      ->capture_default_str();
  app.add_option("--edits", options.edits, "Mixed edits on each mesh, in batches that are undone and redone whole")
      ->capture_default_str();
  app.add_option("--edits-on-large", options.edits_on_large,
                 "Mixed edits on meshes of 200,000 faces or valence 4,000 or more")
      ->capture_default_str();
  app.add_option("--batch", options.batch, "Drags of a batch; each has a fresh copy of the mesh")
      ->capture_default_str()
      ->check(benchmark::positive_number);
  app.add_option("--edit-batch", options.edit_batch, "Mixed edits of a batch")
      ->capture_default_str()
      ->check(benchmark::positive_number);
  app.add_option("--extreme", options.extreme,
                 "Drags in all, on some small meshes, with targets, clearances and deltas anywhere among the doubles")
      ->capture_default_str();
  app.add_option("--response", options.response, "What a blocked vertex does")
      ->check(CLI::IsMember({"slide", "stop", "paper"}))
      ->capture_default_str();
  app.add_option("--motion", options.motion,
                 "odd: single drags, many of them degenerate; hand: strokes of a hundred short steps with one vertex")
      ->check(CLI::IsMember({"odd", "hand"}))
      ->capture_default_str();
  app.add_option("--broad-phase", options.broad_phases,
                 "One or more, e.g. box_tree,six_lists: the first one counts; each batch is made with the others, too, "
                 "which has to give the same bits")
      ->delimiter(',')
      ->check(CLI::IsMember({"box_tree", "six_lists", "all_faces"}))
      ->capture_default_str();
  app.add_option("--clearance", options.clearances,
                 "One or more, e.g. 0,1e-9: of the extent of each mesh; 0: the default, 4 ulp. Where one does not "
                 "serve a mesh its batches are counted as refused")
      ->delimiter(',')
      ->check([](const std::string& text) -> std::string { // CLI::Range lets pass what is no number
        const double share = std::strtod(text.c_str(), nullptr);
        return share >= 0 && share <= 1 ? "" : "'" + text + "' is not a number from 0 to 1";
      })
      ->capture_default_str();
  app.add_option("--least-faces", options.least_faces, "Leave out meshes with fewer faces");
  app.add_option("--seed", options.seed, "Seed")->capture_default_str();
  app.add_flag("--hard", options.has_hard_meshes,
               "On meshes, too, that are an ulp thick, almost flat, nested, crumpled and so on");
  app.add_option("--dump", options.dump,
                 "Folder without cases for batches that break a promise: a mesh and a script, for `sculpt` and "
                 "`minimise`. Drags are "
                 "replayed to the bit; of mixed edits, where a vertex stays in hand meanwhile, most are");
  app.add_flag("--dump-all", options.dumps_all,
               "All batches are written there, and what has become of the mesh, NAME.end.off");
  benchmark::Benchmark_program program("robustness", app, "batch");
  return program.run(argc, argv, [&](benchmark::Promises& promises) {
    if (!options.dump.empty()) {
      benchmark::check_folder(options.dump);
      std::error_code none; // where it is not there yet
      for (const auto& entry : std::filesystem::directory_iterator(options.dump, none))
        if (entry.path().filename().string().compare(0, 6, "batch_") == 0)
          throw benchmark::Wrong_use("'" + options.dump + "' (--dump) has cases already, such as " +
                                     entry.path().filename().string() + "; give another folder");
    }
    robustness::Run run(options, program.shard);
    if (!options.folder.empty())
      run.folder(); // first: one hears of its files before hours of the others
    for (const auto& [name, mesh] : robustness::robustness_meshes())
      run.mesh(name, mesh);
    if (options.has_hard_meshes)
      for (const auto& [name, mesh] : robustness::hard_meshes())
        run.mesh(name, mesh, true);
    for (const auto& small : robustness::small_meshes())
      run.extreme(small.name, small.mesh, small.share);
    return run.finish(promises);
  });
}
