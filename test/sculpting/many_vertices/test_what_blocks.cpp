// SPDX-License-Identifier: GPL-3.0-or-later
// What is in the way of objects that move as one, with every broad phase.
#include "sculpting/many_vertices/many_vertices_scene.h"
#include "sculpting/scene_parts.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Translation = CGAL::Aff_transformation_3<meshes::Kernel>;

/// What blocks, in words, of a copy of the mesh.
template <class Broad_phase>
std::vector<std::string> contacts_with(Mesh mesh, const std::vector<Vertex_index>& moving, const Vector_3& way) {
  Sculptor<Mesh, Broad_phase> sculptor(mesh);
  std::vector<std::string> contacts;
  for (const auto& contact : move_rigidly(sculptor, moving, Translation(CGAL::TRANSLATION, way)).contacts) {
    contacts.push_back(std::to_string(static_cast<int>(contact.kind)));
    for (const Vertex_index v : contact.vertices)
      contacts.back() += ' ' + std::to_string(static_cast<std::size_t>(v));
  }
  return contacts;
}

} // namespace

BOOST_AUTO_TEST_CASE(what_blocks_is_the_same_with_every_broad_phase) {
  Random random(seed_from_environment(32));
  std::size_t several = 0;
  for (const auto& [name, scene] : scenes(false))
    for (int motion = 0; motion < 8; ++motion) {
      std::vector<Vertex_index> moving; // many, or so few that only what is near is looked at
      const double height = motion % 2 == 0 ? uniform(random, -0.5, 0.5) : 0.9;
      for (const Vertex_index v : scene.vertices())
        if (scene.point(v).z() > height)
          moving.push_back(v);
      const Vector_3 way = uniform_vector(random, 3);
      const auto contacts = contacts_with<Box_tree_broad_phase<Mesh>>(scene, moving, way);
      BOOST_TEST(contacts == contacts_with<Brute_force_broad_phase<Mesh>>(scene, moving, way), name);
      BOOST_TEST(contacts == contacts_with<Six_list_broad_phase<Mesh>>(scene, moving, way), name);
      several += contacts.size() > 1;
    }
  BOOST_TEST(several >= 10u);
}
