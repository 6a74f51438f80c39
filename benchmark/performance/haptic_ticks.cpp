// SPDX-License-Identifier: GPL-3.0-or-later
// CPU time of whole ticks of the haptic loop, from joint angles to torques, when a hand goes fast over a fine mesh, a
// little deep in it: with the probe, with a vertex that it grabs or creates, letting go and removing; or with a vertex
// of a valence of one's choice in hand. Counts allocations, too.
#include "Benchmark_program.h"
#include "meshes/generated_meshes.h"

#include "../examples/count_allocations.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <sys/mman.h>
#include <time.h>

#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <vector>

namespace {

using namespace haptic_sculpt;
using Eigen::Vector3d;
using Mesh = meshes::Mesh;
using Scene = Loop_scene<Mesh>;
using Loop = Haptic_loop<Scene::Sculptor_type>;
using Json = nlohmann::ordered_json;

struct Options {
  int level = 8;
  double radius = 30, speed = 300, rate = 1000, depth = 2, reach = 0.05; ///< mm, mm/s, Hz, mm, mm
  std::size_t ticks = 1000000, work = Haptic_parameters().work_limit, runs = 1, valence = 0;
  std::size_t work_of_a_face = Haptic_parameters().work_of_a_face;
  bool refuses_allocations = false;
};

std::uint64_t cpu_nanoseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<std::uint64_t>(t.tv_sec) * 1000000000u + static_cast<std::uint64_t>(t.tv_nsec);
}

/// Great circles whose axis turns slowly; every second is half a second of the probe, a quarter with a vertex in hand,
/// which every other second is removed, and the probe again. With a valence: from the tip up and down, into the sphere
/// and into the tip's own cone, and from side to side, all at once.
struct Hand {
  const Options& options;
  Vector3d home;

  Vector3d position(std::size_t tick) const {
    return home + 1e-3 * (options.valence == 0 ? circles(tick) : hops(tick));
  }
  static int button(std::size_t tick) {
    const std::size_t phase = tick % 1000;
    return phase >= 500 && phase < 750 ? 1 : phase >= 750 && phase < 760 && tick / 1000 % 2 == 1 ? 2 : 0;
  }

private:
  /// mm, from home
  Vector3d circles(std::size_t tick) const {
    const double angle = options.speed / options.rate / options.radius * static_cast<double>(tick),
                 turn = 0.0137 * angle;
    const Vector3d direction(std::cos(angle), std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn));
    const double above =
        std::fmax(0, 5 - 0.02 * static_cast<double>(tick)); // mm: it comes from outside, as a probe must
    return (options.radius - options.depth + above) * direction;
  }
  Vector3d hops(std::size_t tick) const {
    const double angle = options.speed / options.rate / tip_way * static_cast<double>(tick);
    return {side_way * std::sin(0.71 * angle), side_way * std::sin(0.53 * angle),
            tip_height - (1 - std::cos(angle)) * (tip_height + options.depth) / 2 + back * std::sin(0.31 * angle)};
  }

public:
  /// mm: the tip over the sphere; its ways.
  static constexpr double tip_height = 5, tip_way = 6, side_way = 6, back = 1;
};

/// The sphere, 60 mm wide; or, with a valence, one of a third of that, and over it a double cone whose lower tip, the
/// last vertex, has that valence.
meshes::Triangle_list surface(const Options& options) {
  if (options.valence == 1 || options.valence == 2)
    throw benchmark::Wrong_use("--valence: the tip of a double cone has at least 3 faces");
  meshes::Triangle_list list = meshes::bumpy_sphere(options.level, 0.05);
  if (options.valence == 0)
    return list.scale_and_move(options.radius, 0, 0, 0);
  constexpr double height = 12;
  list.scale_and_move(options.radius / 3, 0, 0, -options.radius / 3);
  return list += meshes::bipyramid(options.valence).scale_and_move(height, 0, 0, Hand::tip_height + height);
}

Json of(const Tick_statistics& s) {
  const auto microseconds = [](std::uint64_t ns) { return static_cast<double>(ns) / 1000; };
  return {{"ticks", s.number()},
          {"p50", microseconds(s.percentile(0.5))},
          {"p99", microseconds(s.percentile(0.99))},
          {"p999", microseconds(s.percentile(0.999))},
          {"p9999", microseconds(s.percentile(0.9999))},
          {"max", microseconds(s.largest())}};
}

Vector3d place_of(const Scene& scene, Mesh::Vertex_index v) {
  const auto& p = scene.mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

/// What the button did in a tick, in the order of Tool_event.
constexpr const char* event_names[] = {nullptr,    "grabbed", "created_on_face", "created_on_edge",
                                       "released", "removed", "refused"};

/// \param least the least that each tick has taken in any run: the runs are the same to the bit, so what only one took
/// is the machine's
Json run(const Options& options, std::vector<std::uint64_t>& least) {
  Device_description<double> description = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  description.viscous_friction = 0.005, description.encoder_step = 1.53e-4;
  const Device_parameters<double> device(description);
  const auto home = home_pose(device);
  Scene scene(
      meshes::to_mesh(surface(options)),
      [&](const Vector3d&, const Vector3d&) {
        return Workspace_map(1000, Vector3d::Zero(), Vector3d::Zero(), home->position);
      },
      10000, 100000);
  Haptic_parameters parameters;
  parameters.tick = 1 / options.rate, parameters.reach = 1e-3 * options.reach;
  parameters.work_limit = options.work, parameters.work_of_a_face = options.work_of_a_face;
  const Passivity_limits limits = benchmark::read_given([&] {
    return passivity_limits(device, parameters.limits, scene.map, 1.1 * scene.lower, 1.1 * scene.upper, 0,
                            parameters.tick, 0);
  });
  const Hand hand{options, home->position};
  auto pose = reach_position(device, *home, hand.position(0));
  if (!pose)
    throw benchmark::Wrong_use("the hand's path begins where the device cannot be");
  const auto begun = benchmark::read_given(
      [&] { return std::make_unique<Loop>(scene.sculptor, device, *pose, scene.map, parameters, limits); });
  Loop& loop = *begun;
  if (mlockall(MCL_CURRENT) != 0)
    std::cerr << "haptic_ticks: the memory cannot be locked: first uses of pages are in the times\n";
  Tick_statistics all, probe, vertex;
  std::array<Tick_statistics, std::size(event_names)> events; // by Tool_event
  std::size_t allocations = 0, missed = 0, missed_in_last_run = 0, cut_short = 0, blocked = 0, starved = 0;
  const Mesh::Vertex_index tip(scene.mesh.num_vertices() - 1);
  if (options.valence > 0)
    loop.tool().take(tip);
  double moved = 0; // mm
  Joint_reading reading;
  for (std::size_t tick = 0; tick < options.ticks && !loop.has_stopped(); ++tick) {
    pose = reach_position(device, *pose, hand.position(tick));
    if (!pose)
      throw benchmark::Wrong_use("the hand's path leaves the workspace");
    reading.theta = measured_angles(device, pose->theta);
    reading.button = options.valence == 0 ? Hand::button(tick) : 0, reading.elapsed = tick == 0 ? 0 : parameters.tick;
    const Vector3d tip_before = place_of(scene, tip);
    const std::size_t before = allocations_so_far;
    const std::uint64_t begin = cpu_nanoseconds();
    const Haptic_tick& made = loop.tick(reading);
    const std::uint64_t in_this_run = cpu_nanoseconds() - begin;
    allocations += allocations_so_far - before;
    const std::uint64_t taken = least[tick] = std::min(least[tick], in_this_run);
    missed += static_cast<double>(taken) > 1e9 * parameters.tick;
    missed_in_last_run += static_cast<double>(in_this_run) > 1e9 * parameters.tick;
    cut_short += made.tool.end == Drag_end::work_limit;
    blocked += !made.tool.reached;
    all.add(taken);
    starved += made.tool.starved, moved += options.valence == 0 ? 0 : (place_of(scene, tip) - tip_before).norm();
    const auto event = static_cast<std::size_t>(made.tool.event);
    (event != 0 ? events[event] : loop.tool().holds_vertex() ? vertex : probe).add(taken);
    if (made.is_new_fault)
      throw benchmark::Wrong_use(std::string("the loop ends by a fault: ") + name_of(made.fault));
  }
  const Tool_edits& done = loop.tool().edits();
  if (options.depth > 0 && options.valence == 0 && 4 * blocked < all.number())
    throw benchmark::Wrong_use("the hand was held back in " + std::to_string(blocked) +
                               " ticks only: that is not what is measured here");
  if (options.refuses_allocations && allocations != 0)
    throw Error(std::to_string(allocations) + " allocations were made in ticks, with " + std::to_string(done.created) +
                " creations and " + std::to_string(done.removed) + " removals");
  Json of_events;
  for (std::size_t event = 1; event < events.size(); ++event)
    of_events[event_names[event]] = of(events[event]);
  return {{"triangles", scene.mesh.number_of_faces()},
          {"valence", options.valence},
          {"moved_mm", moved},
          {"cpu_us", of(all)},
          {"cpu_us_probe", of(probe)},
          {"cpu_us_vertex_in_hand", of(vertex)},
          {"cpu_us_button", of_events},
          {"runs", options.runs},
          {"missed_by_cpu", missed},
          {"missed_by_cpu_in_the_last_run", missed_in_last_run},
          {"allocations", allocations},
          {"blocked", blocked},
          {"cut_short", cut_short},
          {"starved", starved},
          {"grabbed", done.grabbed},
          {"created", done.created},
          {"removed", done.removed},
          {"refused", done.refused},
          {"work", options.work},
          {"work_of_a_face", options.work_of_a_face}};
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "CPU time of whole ticks of the haptic loop under a fast hand. The object is a sphere with hills, 60 mm wide.");
  app.add_option("--level", options.level, "Times the icosahedron is divided: 20 * 4^level triangles")
      ->check(CLI::Range(0, 10))
      ->capture_default_str();
  app.add_option("--ticks", options.ticks)->capture_default_str();
  app.add_option("--speed", options.speed, "Of the hand, mm/s")->capture_default_str();
  app.add_option("--rate", options.rate, "Ticks a second")->check(benchmark::positive_number)->capture_default_str();
  app.add_option("--depth", options.depth,
                 "How deep the hand is under the mean surface, mm; less than 0: above it, which tells what the machine "
                 "itself takes")
      ->capture_default_str();
  app.add_option("--reach", options.reach, "Of a grab, mm; where no vertex is so near, one is created")
      ->capture_default_str();
  app.add_option(
         "--valence", options.valence,
         "Have a vertex of that many faces in hand: a tip of a double cone that hops on a sphere of a third of the "
         "size; at least 3, or 0: none")
      ->capture_default_str();
  app.add_option("--work", options.work, "Pairs that a drag may decide")->capture_default_str();
  app.add_option("--work-of-a-face", options.work_of_a_face, "Pairs more for each face about the vertex in hand")
      ->capture_default_str();
  app.add_option("--runs", options.runs, "Make the same run so often, and take the least time of each tick")
      ->check(benchmark::positive_number)
      ->capture_default_str();
  app.add_flag("--no-allocations", options.refuses_allocations, "End with an error where a tick has allocated");
  benchmark::Benchmark_program program("haptic_ticks", app, "run; there is one, of one hand");
  return program.run(argc, argv, [&](benchmark::Promises&) {
    std::vector<std::uint64_t> least(options.ticks, std::numeric_limits<std::uint64_t>::max());
    Json report;
    if (program.shard.takes_next())
      for (std::size_t k = 0; k < options.runs; ++k)
        report = run(options, least);
    std::cout << report.dump(2) << '\n';
    return report;
  });
}
