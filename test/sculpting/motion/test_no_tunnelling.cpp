// SPDX-License-Identifier: GPL-3.0-or-later
// Every verdict and time of a moving star against an independent decision: all pairs of faces at every critical time
// and between any two, in integers (oracle/embedding_oracle.h).
#include "sculpting/motion/embedding_oracle_input.h"


#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// On the grid, on another vertex, in the middle of two, or just beyond.
Point_3 random_target(Random& random, const meshes::Triangle_list& list, int size) {
  const auto vertex = [&] { return list.points[random() % list.points.size()]; };
  switch (random() % 4) {
  case 0: return vertex();
  case 1: return CGAL::midpoint(vertex(), vertex());
  case 2: return random_grid_point(random, 2 * size);
  default: return random_grid_point(random, size);
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(verdicts_and_times_agree_with_an_independent_decision) {
  const std::size_t moves = count_from_environment("HAPTIC_SCULPT_EMBEDDING_MOVES", 3000);
  Random random(seed_from_environment(77));
  std::size_t wrong_verdicts = 0, wrong_times = 0, blocked = 0, invalid_ends = 0;
  constexpr std::size_t moves_per_mesh = 20;
  for (std::size_t done = 0; done < moves;) {
    const int size = 1 + static_cast<int>(random() % 3);
    const meshes::Triangle_list list = random_small_list(random, size);
    const oracle::Mesh_list independent = to_oracle(list);
    const Mesh original = meshes::to_mesh(list);
    for (std::size_t i = 0; i < moves_per_mesh && done < moves; ++i, ++done) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % list.points.size()));
      const Point_3 target = random_target(random, list, size);
      const auto expected =
          oracle::first_time_not_embedded(independent, static_cast<int>(v), {target.x(), target.y(), target.z()});
      const auto found = first_impact(original, v, target);
      blocked += expected.has_value();
      if (expected.has_value() != found.has_value())
        ++wrong_verdicts;
      else if (expected && found->impact().exact_time() != *expected)
        ++wrong_times;
      Mesh mesh = original;
      Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
      const auto result = sculptor.grab(v).drag_to(target);
      if (result.reached == expected.has_value() && original.point(v) != target)
        ++wrong_verdicts;
      if (!validate(mesh).is_valid())
        ++invalid_ends;
      // The way to where it was stopped is free by the independent decision too.
      const Point_3 end = mesh.point(v);
      if (oracle::first_time_not_embedded(independent, static_cast<int>(v), {end.x(), end.y(), end.z()}))
        ++invalid_ends;
    }
  }
  BOOST_TEST_MESSAGE(moves << " moves, " << blocked << " blocked; wrong: " << wrong_verdicts << " verdicts, "
                           << wrong_times << " times, " << invalid_ends << " ends");
  BOOST_TEST(wrong_verdicts == 0u);
  BOOST_TEST(wrong_times == 0u);
  BOOST_TEST(invalid_ends == 0u);
  BOOST_TEST(blocked > moves / 10);
  BOOST_TEST(blocked < moves);
}
