// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_speed_error/Drag_script.h"

#include "meshes/generated_meshes.h"

#include <stdexcept>

namespace haptic_sculpt::benchmark {

namespace {

class Random {
public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// In [-1, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }
  std::size_t below(std::size_t n) { return engine_() % n; }
  std::array<double, 3> about(const std::array<double, 3>& p, double size) {
    return {p[0] + size * uniform(), p[1] + size * uniform(), p[2] + size * uniform()};
  }

private:
  std::mt19937_64 engine_;
};

using Step_maker = std::array<double, 3> (*)(const Drag_script&, std::size_t vertex, std::size_t step, Random&);

/// How many drags one vertex makes before the next.
constexpr std::size_t drags_of_a_grab = 8;

Drag_script filled(const std::string& name, const meshes::Triangle_list& list, std::size_t drags, std::uint64_t seed,
                   Step_maker make) {
  Drag_script script{name, {}, list.faces, {}};
  for (const meshes::Point_3& p : list.points)
    script.points.push_back({p.x(), p.y(), p.z()});
  Random random(seed);
  std::size_t vertex = 0;
  for (std::size_t step = 0; step < drags; ++step) {
    if (step % drags_of_a_grab == 0)
      vertex = random.below(script.points.size());
    script.steps.push_back({vertex, make(script, vertex, step % drags_of_a_grab, random)});
  }
  return script;
}

/// Half an edge about the vertex, in general position.
std::array<double, 3> near_by(const Drag_script& script, std::size_t vertex, std::size_t, Random& random) {
  return random.about(script.points[vertex], 0.05);
}
/// Through the object, to about the same place again and again: all but the first start at the contact.
std::array<double, 3> through(const Drag_script& script, std::size_t vertex, std::size_t, Random& random) {
  const auto& other = script.points[script.points.size() - 1 - vertex];
  return random.about(other, 0.01);
}
/// Exactly onto another vertex, or the middle between two: along edges, in planes, onto corners of a grid.
std::array<double, 3> in_planes(const Drag_script& script, std::size_t vertex, std::size_t step, Random& random) {
  const auto& other = script.points[random.below(script.points.size())];
  if (step % 2 == 0)
    return other;
  const auto& p = script.points[vertex];
  return {(p[0] + other[0]) / 2, p[1], (p[2] + other[2]) / 2};
}
/// To the point right across a gap along x, and past it.
std::array<double, 3> across_gap(const Drag_script& script, std::size_t vertex, std::size_t, Random& random) {
  const auto& p = script.points[vertex];
  return {-p[0] + 1e-8 * random.uniform(), p[1] + 1e-3 * random.uniform(), p[2] + 1e-3 * random.uniform()};
}
/// By about a layer of the stack up or down, and little aside.
std::array<double, 3> by_layers(const Drag_script& script, std::size_t vertex, std::size_t, Random& random) {
  const auto& p = script.points[vertex];
  const double aside = random.below(2) == 0 ? 0x1p-39 : 0x1p-3;
  return {p[0] + aside * random.uniform(), p[1] + aside * random.uniform(), p[2] + 0x1p-38 * random.uniform()};
}

} // namespace

const std::vector<std::string>& drag_script_names() {
  static const std::vector<std::string> names = {"near by",   "pushed through", "pushed through, far from the origin",
                                                 "in planes", "narrow gap",     "thin layers"};
  return names;
}

Drag_script drag_script(const std::string& name, std::size_t drags, std::uint64_t seed) {
  const auto& names = drag_script_names();
  if (name == names[0])
    return filled(name, meshes::bumpy_sphere(4, 0.3, 0.02), drags, seed, near_by);
  if (name == names[1])
    return filled(name, meshes::bumpy_sphere(3, 0.3, 0.02), drags, seed, through);
  if (name == names[2])
    return filled(name, meshes::bumpy_sphere(3, 0.3, 0.02).scale_and_move(1, 1e6, 1e6, 1e6), drags, seed, through);
  if (name == names[3])
    return filled(name, meshes::box(6), drags, seed, in_planes);
  if (name == names[4])
    return filled(name, meshes::c_tube(1e-9, 16), drags, seed, across_gap);
  if (name == names[5])
    return filled(name, meshes::sliver_stack(6, 0x1p-39), drags, seed, by_layers);
  throw std::invalid_argument("no script is called " + name);
}

} // namespace haptic_sculpt::benchmark
