// SPDX-License-Identifier: GPL-3.0-or-later
// No leg of a slide crosses anything: every leg against the independent decision of all pairs of faces at all times.
#include "sculpting/response/Recording_guard.h"
#include "sculpting/response/Slide_faults.h"
#include "sculpting/motion/embedding_oracle_input.h"

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Coordinates = std::array<double, 3>;
using Broad_phase = Box_tree_broad_phase<Mesh>;

Point_3 target_of_hand(Random& random, const meshes::Triangle_list& list, int size) {
  const auto vertex = [&] { return list.points[random() % list.points.size()]; };
  switch (random() % 5) {
  case 0: return vertex();
  case 1: return CGAL::midpoint(vertex(), vertex());
  case 2: return random_grid_point(random, 2 * size);
  case 3: return random_grid_point(random, size);
  default: return Point_3(0, 0, 0) + uniform_vector(random, 2 * size);
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(every_leg_of_a_slide_is_free) {
  const std::size_t drags = count_from_environment("HAPTIC_SCULPT_SLIDE_LEGS", 600);
  Random random(seed_from_environment(510));
  std::size_t checked = 0, crossing = 0, unproven = 0, held = 0, invalid = 0, done = 0;
  while (done < drags) {
    const int size = 1 + static_cast<int>(random() % 3);
    meshes::Triangle_list list = random_small_list(random, size);
    std::size_t moved = random() % list.points.size();
    Mesh mesh = meshes::to_mesh(list);
    const Vertex_index v(static_cast<Mesh::size_type>(moved));
    Broad_phase broad_phase(mesh);
    const internal::Face_corners<Mesh> corners(mesh);
    Filter_counters counters;
    Recording_guard<Mesh> guard(mesh, broad_phase, corners, Exact_sweep_traits<Mesh>(&counters));
    guard.collect(v);
    internal::Responses<Mesh> responses;
    for (int i = 0; i < 5; ++i, ++done) {
      const Point_3 target = target_of_hand(random, list, size);
      const Coordinates s = vertex_coordinates(mesh, v), t = {target.x(), target.y(), target.z()};
      if (s == t)
        continue;
      const std::optional<double> c = i % 2 == 0 ? std::nullopt : std::optional<double>(1e-6);
      Drag_result<Mesh> result;
      guard.clear();
      const Coordinates end =
          responses.move(response_under_test(), guard, mesh, s, t, {internal::Clearance_rule(c), 0}, result);
      held += end != t;
      const auto legs = guard.way(s, end);
      // The path that is reported is one of free motions: none of fewer legs is needed to explain it.
      if (end != s && (legs.empty() || legs.size() > static_cast<std::size_t>(result.legs)))
        ++unproven;
      oracle::Mesh_list independent = to_oracle(list);
      for (const auto& [from, to] : legs) {
        independent.points[moved] = from;
        ++checked;
        if (oracle::first_time_not_embedded(independent, static_cast<int>(moved), to)) {
          ++crossing;
          BOOST_TEST_MESSAGE("a leg from " << exact_text(Point_3(from[0], from[1], from[2])) << " to "
                                           << exact_text(Point_3(to[0], to[1], to[2])) << " crosses something");
        }
      }
      mesh.point(v) = Point_3(end[0], end[1], end[2]);
      list.points[moved] = mesh.point(v);
      invalid += !validate(mesh).is_valid();
    }
  }
  BOOST_TEST_MESSAGE(done << " drags, " << held << " held, " << checked << " legs checked, " << crossing
                          << " cross something, " << unproven << " ways are not proven");
  BOOST_TEST(checked > drags / 2);
  BOOST_TEST(held > drags / 4);
  BOOST_TEST(crossing == 0u);
  BOOST_TEST(unproven == 0u);
  BOOST_TEST(invalid == 0u);
}
