// SPDX-License-Identifier: GPL-3.0-or-later
// Creation, removal, undo and redo: against the independent decision, in inverse pairs, and mixed at random.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/random_edits.h"

#include "oracle/embedding_oracle.h"

#include <boost/test/unit_test.hpp>

#include <map>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

BOOST_AUTO_TEST_CASE(removal_agrees_with_an_independent_decision) {
  Random random(seed_from_environment(31));
  const std::size_t collapses = count_from_environment("HAPTIC_SCULPT_COLLAPSES", 2000);
  std::size_t wrong = 0, removed = 0, invalid = 0, tried = 0;
  while (tried < collapses) {
    const meshes::Triangle_list list = random_small_list(random, 2);
    oracle::Mesh_list independent;
    for (const Point_3& p : list.points)
      independent.points.push_back({p.x(), p.y(), p.z()});
    for (const auto& f : list.faces)
      independent.faces.push_back({static_cast<int>(f[0]), static_cast<int>(f[1]), static_cast<int>(f[2])});
    const Mesh original = meshes::to_mesh(list);
    for (const Vertex_index v : original.vertices()) {
      Mesh mesh = original;
      Sculptor<Mesh> sculptor(mesh);
      const auto before = snapshot(sculptor);
      const auto result = sculptor.remove(v);
      bool possible = false, right_neighbour = false;
      for (const auto h : original.halfedges_around_target(original.halfedge(v))) {
        const Vertex_index w = original.source(h);
        const bool embedded = oracle::collapse_stays_embedded(independent, static_cast<int>(v), static_cast<int>(w));
        ++tried;
        possible |= embedded;
        right_neighbour |= result && *result.vertex == w && embedded;
      }
      wrong += static_cast<bool>(result) != possible || (result && !right_neighbour);
      removed += static_cast<bool>(result);
      invalid += !validate(mesh).is_valid();
      if (!result)
        wrong += !(snapshot(sculptor) == before);
      else {
        const auto after = snapshot(sculptor);
        BOOST_REQUIRE(sculptor.undo());
        wrong += !(snapshot(sculptor) == before);
        BOOST_REQUIRE(sculptor.redo());
        wrong += !(snapshot(sculptor) == after);
      }
    }
  }
  BOOST_TEST_MESSAGE(tried << " collapses, " << removed << " vertices removed");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(invalid == 0u);
  BOOST_TEST(is_enough(removed, 50));
}

BOOST_AUTO_TEST_CASE(feasible_creations_are_accepted_and_undone_by_removal) {
  Random random(seed_from_environment(32));
  std::uniform_real_distribution<double> number(0, 1);
  for (const auto& list : {meshes::bumpy_sphere(2, 0.2, 0.02), meshes::torus(16, 10), meshes::box(3)}) {
    Mesh mesh = meshes::to_mesh(list);
    Sculptor<Mesh> sculptor(mesh);
    const auto before = snapshot(sculptor);
    const int characteristic = euler_characteristic(mesh);
    std::size_t accepted = 0, asked = 0;
    for (int i = 0; i < 300; ++i) {
      const bool on_face = i % 2 == 0;
      double a = 0.05 + 0.9 * number(random), b = 0.05 + 0.9 * number(random);
      if (a + b > 0.95)
        a = 0.5 * (1 - a), b = 0.5 * (1 - b);
      ++asked;
      Edit_result<Mesh> result;
      if (on_face) {
        const auto f = pick(mesh.faces(), mesh.number_of_faces(), random);
        result = sculptor.insert_on_face(f, in_face(mesh, f, a, b));
      } else {
        const auto e = pick(mesh.edges(), mesh.number_of_edges(), random);
        const Point_3 p = mesh.point(mesh.vertex(e, 0)), q = mesh.point(mesh.vertex(e, 1));
        result = sculptor.insert_on_edge(e, p + (0.05 + 0.9 * a) * (q - p));
      }
      if (!result)
        continue;
      ++accepted;
      BOOST_TEST(mesh.degree(*result.vertex) == (on_face ? 3u : 4u));
      BOOST_TEST(euler_characteristic(mesh) == characteristic);
      if (on_face && sculptor.remove(*result.vertex))
        BOOST_TEST((snapshot(sculptor).faces == before.faces));
      else
        BOOST_REQUIRE(sculptor.undo());
      BOOST_REQUIRE((snapshot(sculptor) == before));
    }
    BOOST_TEST(validate(mesh).is_valid());
    BOOST_TEST_MESSAGE(accepted << " of " << asked << " creations accepted");
    BOOST_TEST(static_cast<double>(accepted) >= 0.99 * static_cast<double>(asked));
  }
}

BOOST_AUTO_TEST_CASE(refusals_name_the_rule) {
  {
    Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
    Sculptor<Mesh> sculptor(mesh);
    const auto f = *mesh.faces().begin();
    const auto h = mesh.halfedge(f);
    BOOST_TEST((sculptor.remove(Vertex_index(0)).refusal->reason == Refusal_reason::tetrahedron));
    const auto on_corner = sculptor.insert_on_face(f, mesh.point(mesh.target(h)));
    BOOST_TEST((on_corner.refusal->reason == Refusal_reason::coincident_vertex));
    BOOST_TEST((on_corner.refusal->elements.at(0) == mesh.target(h)));
    const Point_3 middle = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
    BOOST_TEST((sculptor.insert_on_face(f, middle).refusal->reason == Refusal_reason::delta));
    BOOST_TEST((sculptor.undo().refusal->reason == Refusal_reason::nothing_to_undo));
    BOOST_TEST((sculptor.redo().refusal->reason == Refusal_reason::nothing_to_redo));
    BOOST_TEST((sculptor.remove(Vertex_index(99)).refusal->reason == Refusal_reason::unknown_element));
    BOOST_TEST(
        (sculptor.insert_on_face(Mesh::Face_index(), middle).refusal->reason == Refusal_reason::unknown_element));
    // A new vertex takes the next number; a removed one's stays dead.
    const auto made = sculptor.insert_on_face(f, in_face(mesh, f, 0.3, 0.3));
    BOOST_REQUIRE(made);
    BOOST_TEST(sculptor.id(*made.vertex) == 4u);
    BOOST_REQUIRE(sculptor.remove(*made.vertex));
    BOOST_TEST(!sculptor.vertex(4).is_valid());
    const auto again = sculptor.insert_on_face(*mesh.faces().begin(), in_face(mesh, *mesh.faces().begin(), 0.2, 0.3));
    BOOST_REQUIRE(again);
    BOOST_TEST(sculptor.id(*again.vertex) == 5u);
  }
  { // a vertex pulled up over a ball that lies above the face would jump over it
    meshes::Triangle_list list = meshes::cube();
    list += meshes::icosphere(0).scale_and_move(0.1, 0.5, 0.5, 1.3);
    Mesh mesh = meshes::to_mesh(list);
    Sculptor<Mesh> sculptor(mesh);
    std::size_t blocked = 0;
    for (std::size_t i = 0; i < 12; ++i) { // the cube's faces
      const Mesh::Face_index f(static_cast<Mesh::size_type>(i));
      const auto result = sculptor.insert_on_face(f, Point_3(0.5, 0.48, 2));
      blocked += !result && result.refusal->reason == Refusal_reason::blocked;
      BOOST_TEST(validate(mesh).is_valid());
      if (result)
        BOOST_REQUIRE(sculptor.undo());
    }
    BOOST_TEST(blocked >= 2u);
  }
}

BOOST_AUTO_TEST_CASE(edits_mixed_at_random_keep_every_promise_and_undo_to_the_bit) {
  Random random(seed_from_environment(33));
  const std::size_t edits = count_from_environment("HAPTIC_SCULPT_EDITS", 12000);
  std::map<int, std::size_t> done, refused;
  std::size_t invalid = 0;
  for (std::size_t batch = 0; batch * 2000 < edits; ++batch) {
    meshes::Triangle_list list =
        batch % 2 == 0 ? meshes::bumpy_sphere(1, 0.3, 0.05, static_cast<std::uint32_t>(batch)) : meshes::torus(7, 5);
    list += meshes::icosphere(0).scale_and_move(0.4, 2, 0, 0);
    Mesh mesh = meshes::to_mesh(list);
    const int characteristic = euler_characteristic(mesh);
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot begin = snapshot(sculptor);
    for (int i = 0; i < 2000; ++i) {
      const Random_edit edit = random_edit(sculptor, random);
      ++(edit.is_done ? done : refused)[edit.kind];
      BOOST_REQUIRE(mesh.is_valid(false));
      BOOST_REQUIRE(euler_characteristic(mesh) == characteristic);
      if (i % 100 == 99)
        invalid += !validate(mesh).is_valid();
    }
    sculptor.check_unchanged();
    while (sculptor.redo())
      ;
    const Mesh_snapshot end = snapshot(sculptor);
    std::size_t steps = 0;
    while (sculptor.undo())
      ++steps;
    BOOST_REQUIRE((snapshot(sculptor) == begin));
    invalid += !validate(mesh).is_valid();
    for (; steps > 0; --steps)
      BOOST_REQUIRE(sculptor.redo());
    BOOST_REQUIRE((snapshot(sculptor) == end));
    invalid += !validate(mesh).is_valid();
    sculptor.check_unchanged();
  }
  for (const auto& [kind, count] : done)
    BOOST_TEST_MESSAGE("kind " << kind << ": " << count << " done, " << refused[kind] << " refused or blocked");
  BOOST_TEST(invalid == 0u);
  for (const int kind : {Random_edit::drag, Random_edit::insert_on_face, Random_edit::insert_on_edge,
                         Random_edit::remove, Random_edit::collapse, Random_edit::flip})
    BOOST_TEST(is_enough(done[kind], 100));
}

// Connectivity changed by others: nothing moves, nothing is counted differently.
BOOST_AUTO_TEST_CASE(flips_by_others_are_found) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05));
  Sculptor<Mesh> sculptor(mesh);
  const auto e = sculptor.edge_of(0, static_cast<std::size_t>(mesh.source(mesh.halfedge(Vertex_index(0)))));
  const auto h = mesh.halfedge(e);
  const Vertex_index a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h));
  sculptor.check_unchanged();
  const Mesh_snapshot before = snapshot(sculptor);
  CGAL::Euler::flip_edge(mesh.halfedge(a, b), mesh);
  const Mesh_snapshot flipped = snapshot(sculptor);
  BOOST_REQUIRE((flipped != before));
  BOOST_CHECK_THROW(sculptor.check_unchanged(), Mesh_changed);
  for (const Vertex_index v : {a, b, c}) {
    auto grab = sculptor.grab(v);
    BOOST_CHECK_THROW(grab.drag_to(mesh.point(v) + meshes::Kernel::Vector_3(0.01, 0, 0)), Mesh_changed);
    BOOST_CHECK_THROW(sculptor.remove(v), Mesh_changed);
  }
  const auto wrong = mesh.face(mesh.halfedge(e));
  BOOST_CHECK_THROW(sculptor.insert_on_face(wrong, in_face(mesh, wrong, 0.3, 0.3)), Mesh_changed);
  BOOST_CHECK_THROW(sculptor.flip(e), Mesh_changed);
  BOOST_TEST((snapshot(sculptor) == flipped));
  for (int i = 0; i < 3; ++i) // all the way round
    CGAL::Euler::flip_edge(mesh.halfedge(e), mesh);
  sculptor.check_unchanged();
  BOOST_TEST((snapshot(sculptor) == before));
  { // a grab goes on where it was, with nothing of what it has seen meanwhile
    Mesh copy = mesh;
    Sculptor<Mesh> fresh(copy);
    auto expecting = fresh.grab(a);
    const Point_3 home = mesh.point(a), near = home + meshes::Kernel::Vector_3(0.01, 0, 0),
                  far = home + meshes::Kernel::Vector_3(-3, 0.2, 0.1);
    CGAL::Euler::flip_edge(mesh.halfedge(e), mesh);
    auto grab = sculptor.grab(a);
    BOOST_CHECK_THROW(grab.drag_to(near), Mesh_changed);
    for (int i = 0; i < 3; ++i)
      CGAL::Euler::flip_edge(mesh.halfedge(e), mesh);
    for (const Point_3& target : {near, far, home}) {
      const auto expected = expecting.drag_to(target), is = grab.drag_to(target);
      BOOST_TEST((is.position == expected.position && is.legs == expected.legs));
    }
    BOOST_TEST(validate(mesh).is_valid());
    while (sculptor.undo())
      ;
  }

  // Undo of a creation whose star was changed.
  const auto f = *mesh.faces().begin();
  const auto made = sculptor.insert_on_face(f, in_face(mesh, f, 0.3, 0.3));
  BOOST_REQUIRE(made);
  const auto spoke = mesh.edge(mesh.halfedge(*made.vertex));
  CGAL::Euler::flip_edge(mesh.halfedge(spoke), mesh);
  BOOST_CHECK_THROW(sculptor.undo(), Mesh_changed);
  for (int i = 0; i < 3; ++i)
    CGAL::Euler::flip_edge(mesh.halfedge(spoke), mesh);
  sculptor.check_unchanged();
  BOOST_TEST(static_cast<bool>(sculptor.undo()));
  BOOST_TEST((snapshot(sculptor) == before));
}

BOOST_AUTO_TEST_CASE(a_drag_of_a_removed_vertex_is_a_result) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05));
  Sculptor<Mesh> sculptor(mesh);
  const Vertex_index v(20);
  auto grab = sculptor.grab(v);
  const Point_3 home = mesh.point(v), target = home + meshes::Kernel::Vector_3(0.01, 0, 0);
  BOOST_TEST(grab.drag_to(target).reached);
  BOOST_REQUIRE(static_cast<bool>(sculptor.remove(v)));
  const Mesh_snapshot removed = snapshot(sculptor);
  const auto stale = grab.drag_to(home);
  BOOST_TEST((stale.end == Drag_end::stale));
  BOOST_TEST(std::string(name_of(stale.end)) == "stale");
  BOOST_TEST(!stale.reached);
  BOOST_TEST(stale.legs == 0);
  BOOST_TEST(stale.contacts.empty());
  BOOST_TEST((snapshot(sculptor) == removed));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 2u);
  BOOST_CHECK_THROW(grab.drag_to(Point_3(0, std::nan(""), 0)), Non_finite_point);
  BOOST_REQUIRE(static_cast<bool>(sculptor.undo()));
  BOOST_TEST(grab.drag_to(home).reached);
  BOOST_TEST((mesh.point(grab.vertex()) == home));
}
