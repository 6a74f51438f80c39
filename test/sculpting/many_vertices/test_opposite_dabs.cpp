// SPDX-License-Identifier: GPL-3.0-or-later
// Dabs whose ways cancel.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/brushes.h>

#include <cmath>
#include <random>
#include <vector>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

// Ways are added up, not places, which are rounded.
BOOST_AUTO_TEST_CASE(a_dab_and_its_opposite_leave_all_where_it_is) {
  std::mt19937_64 random(seed_from_environment(38));
  std::uniform_real_distribution<double> number(0, 1);
  for (int n = 0; n < 50; ++n) {
    Mesh mesh = meshes::to_mesh(meshes::box(4).scale_and_move(1, number(random), number(random), number(random)));
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot before = snapshot(sculptor);
    const Point_3 centre = mesh.point(Vertex_index(static_cast<unsigned>(random() % mesh.number_of_vertices())));
    const Dab_3<meshes::Kernel> dab{Brush_kind::grab, centre, 0.6, std::ldexp(number(random), n % 5 == 0 ? 40 : -3),
                                    Vector_3(1, 0, 0)};
    const Dab_3<meshes::Kernel> opposite = mirrored(dab, meshes::Kernel::Plane_3(centre, Vector_3(1, 0, 0)));
    BOOST_TEST(apply_brush(sculptor, std::vector<Dab_3<meshes::Kernel>>{dab, opposite}).asked > 5u);
    BOOST_TEST((snapshot(sculptor) == before));
  }
}
