// SPDX-License-Identifier: GPL-3.0-or-later
// The same hand drags with each response: how far from the target it ends, how often at a local minimum, how long it
// takes.
#include "Benchmark_program.h"
#include "Long_sculpting.h"
#include "quantile.h"

#include "sculpting/Mover_hand.h"
#include "sculpting/clearances.h"
#include "sculpting/response/convex_scenes.h"
#include "sculpting/response/outside_scenes.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <map>

namespace {

using namespace haptic_sculpt;
using test::Convex_scene;
using test::Outside_scene;
using test::Random;
using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vertex_index = Mesh::Vertex_index;
using Json = nlohmann::ordered_json;

enum Exit { not_embedded = 10, no_minimum = 11, contradiction = 12 };

using benchmark::Promises;
using benchmark::Shard;

/// One scene, response and clearance.
struct Row {
  std::size_t drags = 0, held = 0, judged = 0, at_minimum = 0, legs = 0, most_legs = 0;
  std::size_t unfinished = 0; ///< judged, and at no minimum, for their legs were used up
  double left = 0; ///< sum of distances left to the target, in half extents of the scene
  std::vector<double> nanoseconds;
};

struct Subject {
  std::string name;
  Mesh mesh;
  Vertex_index moved;
  double size;
};

constexpr std::array<Response, 3> responses = {Response::slide, Response::stop, Response::paper()};

class Chart {
public:
  Chart(std::uint64_t seed, Shard& shard) : seed_(seed), shard_(shard) {}

  /// The same targets for each response, one grab from where the scene begins.
  void add(const Subject& subject, const std::vector<Point_3>& targets) {
    if (units_.count(subject.name) == 0) {
      const std::size_t unit = shard_.next_unit();
      units_[subject.name] = {unit, shard_.takes_next(), Random(seed_ * 1000003 + unit)};
    }
    auto& [unit, is_ours, random] = units_[subject.name];
    if (!is_ours)
      return;
    for (const Response response : responses) {
      test::Mover_hand grab(subject.mesh, subject.moved, parameters::response(response));
      const Mesh& mesh = grab.mesh;
      const test::Surroundings around(mesh, subject.moved);
      if (rows_.count(subject.name) == 0)
        order_.push_back(subject.name);
      Row& row = rows_[subject.name][name_of(response)];
      for (const Point_3& target : targets) {
        const Point_3 start = mesh.point(subject.moved);
        const auto begin = std::chrono::steady_clock::now();
        const auto r = grab.drag_to(target);
        row.nanoseconds.push_back(
            std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count());
        ++row.drags;
        contradictions_ += test::contradiction(r, start, target) != nullptr;
        row.held += !r.reached;
        row.legs += static_cast<std::size_t>(r.legs);
        row.most_legs = std::max(row.most_legs, static_cast<std::size_t>(r.legs));
        row.left += std::sqrt(CGAL::squared_distance(r.position, target)) / subject.size;
        const auto check =
            test::check_local_minimum(around, mesh, r, target, test::clearance_kept(grab.sculptor, r), random);
        if (!check.asked) // arrived, or almost
          continue;
        ++row.judged;
        const bool is_at_minimum = check.random_gain <= 0 && check.directed_gain <= 0;
        row.at_minimum += is_at_minimum;
        row.unfinished += !is_at_minimum && r.end == Drag_end::leg_limit;
      }
      ++validations_;
      invalid_ += !validate(grab.surface()).is_valid();
    }
  }

  std::size_t invalid() const { return invalid_; }
  std::size_t validations() const { return validations_; }
  std::size_t contradictions() const { return contradictions_; }
  /// Of all scenes.
  std::size_t sum(Response response, std::size_t Row::*count) const {
    std::size_t sum = 0;
    for (const auto& [scene, rows] : rows_)
      sum += rows.at(name_of(response)).*count;
    return sum;
  }

  Json json() const {
    Json all = Json::array();
    for (const std::string& name : order_)
      for (const Response response : responses) {
        const Row& row = rows_.at(name).at(name_of(response));
        std::vector<double> times = row.nanoseconds;
        const double n = static_cast<double>(row.drags);
        double sum = 0;
        for (const double t : times)
          sum += t;
        all.push_back({{"unit", units_.at(name).number},
                       {"scene", name},
                       {"response", name_of(response)},
                       {"drags", row.drags},
                       {"held", row.held},
                       {"mean_distance_left", row.left / n},
                       {"judged", row.judged},
                       {"at_minimum", row.at_minimum},
                       {"unfinished", row.unfinished},
                       {"mean_legs", static_cast<double>(row.legs) / n},
                       {"most_legs", row.most_legs},
                       {"mean_ns", sum / n},
                       {"median_ns", benchmark::quantile(times, 0.5)},
                       {"p99_ns", benchmark::quantile(times, 0.99)}});
      }
    return all;
  }

private:
  /// One scene: all its drags, which draw from a seed of their own.
  struct Unit {
    std::size_t number = 0;
    bool is_ours = false;
    Random random;
  };

  std::uint64_t seed_;
  Shard& shard_;
  std::map<std::string, Unit> units_;
  std::vector<std::string> order_;
  std::map<std::string, std::map<std::string, Row>> rows_; ///< of a scene and a response
  std::size_t invalid_ = 0, validations_ = 0, contradictions_ = 0;
};

/// Larger objects are dragged as robustness does; this is the response, not the mesh.
constexpr std::size_t targets_per_grab = 20;

void chart_scenes(Chart& chart, std::size_t drags, Random& random) {
  for (std::size_t done = 0; done < drags; done += targets_per_grab) {
    for (const Convex_scene& scene : test::convex_scenes(random)) {
      std::vector<Point_3> targets;
      for (std::size_t i = 0; i < targets_per_grab; ++i)
        targets.push_back(scene.any_target(random));
      chart.add({scene.name, scene.mesh, scene.moved, 2}, targets);
    }
    for (const Outside_scene& scene : test::outside_scenes(random)) {
      std::vector<Point_3> targets;
      for (std::size_t i = 0; i < targets_per_grab; ++i)
        targets.push_back(test::outside_target(scene, scene.mesh, random));
      chart.add({scene.name, scene.mesh, scene.moved, scene.size}, targets);
    }
  }
}

void chart_mesh(Chart& chart, const std::string& name, const Mesh& mesh, std::size_t drags, Random& random) {
  Outside_scene scene;
  scene.mesh = mesh;
  const auto box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  scene.size = std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()}) / 2;
  for (std::size_t done = 0; done < drags; done += targets_per_grab) {
    scene.moved = Vertex_index(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
    const Point_3 p = mesh.point(scene.moved);
    std::vector<Point_3> targets;
    for (std::size_t i = 0; i < targets_per_grab; ++i)
      targets.push_back(p + test::uniform_vector(random, scene.size * (i % 2 == 0 ? 0.3 : 0.03)));
    chart.add({name, mesh, scene.moved, scene.size}, targets);
  }
}

struct Options {
  std::string folder;
  std::size_t drags = 200, sculpt = 0, check_every = 100, largest = 200000;
  std::uint64_t seed = 1;
};

Json run(const Options& options, Shard& shard, Promises& promises) {
  Random random(options.seed);
  std::vector<std::pair<std::string, Mesh>> files;
  Json refused = Json::array();
  if (!options.folder.empty()) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(options.folder))
      if (mesh_file_format(entry.path()))
        paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    for (const auto& path : paths)
      try {
        Mesh mesh = read_surface<Mesh>(path);
        if (mesh.number_of_faces() <= options.largest)
          files.emplace_back(path.stem().string(), std::move(mesh));
      } catch (const Error& error) { // one of them is no reason to lose the others
        std::cout << path.filename().string() << ": refused: " << error.what() << '\n';
        refused.push_back({{"file", path.filename().string()}, {"reason", error.what()}});
      }
  }
  Json report = {{"seed", options.seed}, {"drags_per_scene", options.drags}, {"refused", refused}};
  std::size_t validations = 0, invalid = 0, drags = 0, contradictions = 0, minima = 0, missed = 0;
  std::size_t finished = 0, at_minimum = 0; // slides of the chart
  if (options.drags > 0) {
    Chart chart(options.seed + 1, shard);
    chart_scenes(chart, options.drags, random);
    for (const auto& [name, mesh] : files)
      chart_mesh(chart, name, mesh, options.drags, random);
    report["chart"] = chart.json();
    for (const auto& row : report["chart"])
      std::cout << row["scene"].get<std::string>() << ", " << row["response"].get<std::string>() << ": left "
                << row["mean_distance_left"] << ", at a minimum " << row["at_minimum"] << " of " << row["judged"]
                << " that do not arrive, legs " << row["mean_legs"] << " (most " << row["most_legs"] << "), "
                << row["mean_ns"] << " ns\n";
    validations += chart.validations(), invalid += chart.invalid();
    contradictions += chart.contradictions();
    for (const Response response : responses)
      drags += chart.sum(response, &Row::drags);
    finished += chart.sum(Response::slide, &Row::judged) - chart.sum(Response::slide, &Row::unfinished);
    at_minimum += chart.sum(Response::slide, &Row::at_minimum);
  }
  if (options.sculpt > 0) {
    Json rows = Json::array();
    for (const auto& [name, mesh] : files) {
      const std::size_t unit = shard.next_unit();
      if (!shard.takes_next())
        continue;
      const std::size_t validate_every = std::max<std::size_t>(100, mesh.number_of_faces() / 10);
      const auto tally =
          benchmark::Long_sculpting(mesh, options.seed).run(options.sculpt, validate_every, options.check_every);
      Json row = {{"unit", unit}, {"mesh", name}, {"faces", mesh.number_of_faces()}};
      row.update(tally.json());
      rows.push_back(row);
      std::cout << examples::text_of(row) << '\n' << std::flush;
      validations += tally.validations + tally.legs_checked;
      invalid += tally.invalid + tally.legs_crossing + tally.ways_unproven;
      drags += tally.drags, contradictions += tally.contradictions;
      minima += tally.minima_asked, missed += tally.minima_missed;
    }
    report["sculpting"] = rows;
  }
  promises.add(not_embedded, "every mesh is embedded and no leg crosses anything", validations, invalid);
  promises.add(contradiction, "no result contradicts itself", drags, contradictions);
  promises.add(no_minimum, "a slide ends at a local minimum", minima, missed, 1e-3);
  promises.add(no_minimum, "a slide of the chart that has legs left does", finished, finished - at_minimum, 1e-3);
  return report;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Drags with each response: distance left to the target, share at a local minimum of those that do not arrive,\n"
      "time.\n"
      "With --sculpt, slides over the meshes of a folder for long, with creations, removals, undo and redo in "
      "between.\n"
      "Exit: 10 a mesh is "
      "no longer embedded or a leg "
      "crosses something, 11 more than 0.1 % of "
      "the slides are at no minimum (of the chart those with legs left, and those checked of --sculpt), 12 a result "
      "contradicts itself.");
  app.add_option("--meshes", options.folder,
                 "Folder of meshes, beside the generated scenes; what cannot be read, or is refused, is listed")
      ->check(CLI::ExistingDirectory);
  app.add_option("--drags", options.drags, "Drags in each scene and with each response for the chart; 0: no chart")
      ->capture_default_str();
  app.add_option("--sculpt", options.sculpt, "Sliding drags on each mesh of the folder, with edits in between")
      ->capture_default_str();
  app.add_option("--check-every", options.check_every, "Drags of --sculpt between two checks of a local minimum")
      ->check(benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--largest", options.largest, "Leaves out meshes with more faces")->capture_default_str();
  app.add_option("--seed", options.seed, "Seed")->capture_default_str();
  benchmark::Benchmark_program program("response_quality", app, "scene or mesh");
  return program.run(argc, argv, [&](Promises& promises) { return run(options, program.shard, promises); });
}
