// SPDX-License-Identifier: GPL-3.0-or-later
// Drags vertices of machine parts and near-degenerate solids, and asks of each end whether a free straight way leads
// nearer.
#include "Benchmark_program.h"
#include "Certified_grabs.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::benchmark;
using Json = nlohmann::ordered_json;

enum Exit { not_embedded = 10, ends_too_early = 11 };

struct Options {
  std::string dump, family, off, script;
  std::size_t drags = 10000, drags_per_scene = 40, ways = 1000, dumped_per_family = 20;
  std::uint64_t seed = 1;
  double share_of_parts = 2e-3, share_of_near_degenerate = 2e-2; ///< twice what was measured
  bool is_verbose = false;
};

Json row(const std::string& name, const End_tally& tally) {
  Json json = {{"family", name}};
  json.update(tally.json());
  std::cout << name << ": " << tally.drags << " drags, " << tally.not_reached() << " not reached, " << tally.asked
            << " certified, " << tally.missed << " missed (" << tally.missed_random << " by random ways, at most "
            << 100 * tally.largest_gain << " % of what was left), " << tally.gave_up << " gave up, "
            << tally.at_leg_limit << " at the limit of legs; " << 100 * tally.share() << " % too early; "
            << tally.nanoseconds / static_cast<double>(tally.drags) / 1000 << " us a drag, "
            << tally.certificate_nanoseconds / static_cast<double>(tally.drags) / 1000 << " us a certificate; "
            << tally.invalid << " invalid of " << tally.validations << '\n'
            << std::flush;
  return json;
}

Json run(const Options& options, Shard& shard, Promises& promises) {
  const auto& families = test::part_families();
  if (std::none_of(families.begin(), families.end(), [&](const std::string& family) {
        return (family + ", deformed").find(options.family) != std::string::npos;
      }))
    throw Wrong_use("no family has '" + options.family + "' in its name");
  Json rows = Json::array();
  End_tally parts, near_degenerate;
  std::size_t unwritten = 0;
  for (std::size_t family = 0; family < families.size(); ++family)
    for (const bool is_kept_deformed : {false, true}) {
      const std::string name = families[family] + (is_kept_deformed ? ", deformed" : "");
      if (!options.family.empty() && name.find(options.family) == std::string::npos)
        continue;
      End_tally tally;
      std::size_t dumped = 0;
      for (std::size_t done = 0, unit = 0; done < options.drags; done += options.drags_per_scene, ++unit) {
        if (!shard.takes_next())
          continue;
        const std::uint64_t seed = ((options.seed * 1000003 + family) * 2 + is_kept_deformed) * 1000003 + unit;
        test::Random random(seed);
        const test::Part_scene scene = test::part_scene(family, random);
        Certified_grabs grabs(scene, is_kept_deformed, seed, options.ways,
                              [&](const Grab_record& record, const std::string& what) {
                                if (options.is_verbose)
                                  std::cout << what << '\n';
                                if (options.dump.empty() || dumped >= options.dumped_per_family)
                                  return;
                                std::string file = name + '_' + std::to_string(unit) + '_' + std::to_string(dumped++);
                                std::replace_if(
                                    file.begin(), file.end(),
                                    [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
                                try {
                                  record.write(options.dump, file, what);
                                } catch (const Write_error& error) { // a full disk costs the case alone
                                  ++unwritten;
                                  std::cerr << error.what() << '\n';
                                }
                              });
        tally += grabs.run(std::min(options.drags_per_scene, options.drags - done));
      }
      if (tally.drags == 0)
        continue;
      (family < test::first_near_degenerate_family ? parts : near_degenerate) += tally;
      rows.push_back(row(name, tally));
      rows.back()["unit"] = 2 * family + is_kept_deformed;
    }
  Json totals = Json::array();
  promises.add(not_embedded, "the mesh is embedded", parts.validations + near_degenerate.validations,
               parts.invalid + near_degenerate.invalid);
  for (const auto& [name, tally, share] :
       {std::tuple("all parts", parts, options.share_of_parts),
        std::tuple("all near-degenerate", near_degenerate, options.share_of_near_degenerate)}) {
    promises.add(ends_too_early, std::string("no free way leads nearer from where a drag ends, ") + name, tally.drags,
                 tally.misses(), share);
    if (tally.drags == 0)
      continue;
    totals.push_back(row(name, tally));
  }
  promises.add_unwritten(benchmark::cannot_write, unwritten);
  std::cout << "seed " << options.seed << ", shard " << shard.text() << ", exit " << promises.exit() << '\n';
  return {
      {"seed", options.seed}, {"drags", options.drags}, {"ways", options.ways}, {"families", rows}, {"total", totals}};
}

Json replay(const Options& options, Promises& promises) {
  const Grab_record record = read_given([&] { return Grab_record::read(options.off, options.script); });
  const End_tally tally = Certified_grabs::replay(
      record, options.seed, options.ways, [](const Grab_record& so_far, const std::string& what) {
        std::cout << "drag " << so_far.targets.size() << ": " << what << '\n';
      });
  std::cout << tally.drags << " drags, " << tally.misses() << " end too early\n";
  promises.add(ends_too_early, "no free way leads nearer from where a drag ends", tally.drags, tally.misses());
  return {{"seed", options.seed}, {"ways", options.ways}, {"total", tally.json()}};
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Drags vertices of machine parts and of near-degenerate solids, as made and once deformed, and "
               "certifies every end that is not the\n"
               "target: does a free straight way lead nearer by more than 16 clearances? How often is judged.\n"
               "Exit: 10 a mesh is no longer embedded, 11 more "
               "drags end too early than may.");
  app.add_option("--drags", options.drags, "Drags in each family, as made and again once deformed")
      ->capture_default_str();
  app.add_option("--per-scene", options.drags_per_scene, "Drags in one scene, then another is drawn")
      ->check(positive_number)
      ->capture_default_str();
  app.add_option("--ways", options.ways, "Random ways tried from each end")->capture_default_str();
  app.add_option("--family", options.family, "Only families whose names contain this");
  app.add_option("--parts", options.share_of_parts, "Share of the drags of parts that may end too early")
      ->capture_default_str();
  app.add_option("--near-degenerate", options.share_of_near_degenerate, "The same of the near-degenerate solids")
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Seed")->capture_default_str();
  app.add_option("--dump", options.dump,
                 "Folder for what ends too early: NAME.off and NAME.script, for --replay or `sculpt`");
  app.add_option("--dump-most", options.dumped_per_family, "This many of each family are written")
      ->capture_default_str();
  app.add_flag("--verbose", options.is_verbose, "Tell of every end that is too early");
  auto* replayed =
      app.add_option("--replay", options.off, "NAME.off of a case written by --dump: makes its drags again");
  auto* script = app.add_option("--script", options.script, "NAME.script of it")->needs(replayed);
  replayed->needs(script);
  Benchmark_program program("certify_ends", app, "scene");
  return program.run(argc, argv, [&](Promises& promises) {
    if (!options.dump.empty())
      check_folder(options.dump);
    return options.off.empty() ? run(options, program.shard, promises) : replay(options, promises);
  });
}
