// SPDX-License-Identifier: GPL-3.0-or-later
// A bounded call says so where its last drag was cut short.
#include "sculpting/Random_scene.h"
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/move_vertices.h>

#include <array>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

// Of one vertex nobody asks for another drag after the one that was cut.
BOOST_AUTO_TEST_CASE(a_call_whose_last_drag_was_cut_says_so) {
  const std::uint64_t seed = seed_from_environment(67);
  Random random(seed);
  const Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05));
  std::size_t cut = 0, whole = 0, silent = 0;
  for (int k = 0; k < 12; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
    const auto move = [&](const Move_parameters& parameters) {
      Mesh copy = mesh;
      Sculptor<Mesh> sculptor(copy);
      const Point_map targets = copy.add_property_map<Vertex_index, Point_3>("v:target").first;
      put(targets, v, CGAL::ORIGIN - 0.5 * (mesh.point(v) - CGAL::ORIGIN)); // through the other side
      return move_vertices(sculptor, std::array{v}, targets, parameters);
    };
    for (const bool slides : {false, true}) {
      const auto options = Move_parameters().slide(slides);
      const Move_report all = move(Move_parameters(options).most_pairs(std::numeric_limits<std::size_t>::max()));
      for (std::size_t bound = 0; bound <= all.pairs; bound += 1 + all.pairs / 40) {
        const Move_report report = move(Move_parameters(options).most_pairs(bound));
        (report.out_of_work ? cut : whole) += 1;
        silent += !report.out_of_work && report.left_l2 != all.left_l2;
      }
    }
  }
  BOOST_TEST_MESSAGE("seed " << seed << ": " << cut << " cut, " << whole << " whole, " << silent << " cut and silent");
  BOOST_TEST(silent == 0u);
  BOOST_TEST(cut > 50u);
  BOOST_TEST(whole > 5u);
}
