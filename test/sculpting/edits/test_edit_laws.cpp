// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of the edits: inverse pairs, what each does to counts, valences and genus, and where removing everything ends.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/random_edits.h"

#include "oracle/embedding_oracle.h"

#include <boost/test/unit_test.hpp>

#include <numeric>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

std::size_t number_of_components(const Mesh& mesh) {
  std::vector<std::size_t> parent(mesh.num_vertices());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::size_t i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto e : mesh.edges())
    parent[root(mesh.vertex(e, 0))] = root(mesh.vertex(e, 1));
  std::size_t components = 0;
  for (const Vertex_index v : mesh.vertices())
    components += root(v) == static_cast<std::size_t>(v);
  return components;
}

struct Counts {
  int vertices, edges, faces;
  std::size_t components;
  explicit Counts(const Mesh& mesh)
    : vertices(static_cast<int>(mesh.number_of_vertices())), edges(static_cast<int>(mesh.number_of_edges())),
      faces(static_cast<int>(mesh.number_of_faces())), components(number_of_components(mesh)) {}
  /// Of all components together.
  int genus() const { return static_cast<int>(components) - (vertices - edges + faces) / 2; }
};

/// The one that `step` more vertices make of it.
void check_counts(const Counts& before, const Mesh& mesh, int step) {
  const Counts after(mesh);
  BOOST_TEST(after.vertices == before.vertices + step);
  BOOST_TEST(after.edges == before.edges + 3 * step);
  BOOST_TEST(after.faces == before.faces + 2 * step);
  BOOST_TEST(after.components == before.components);
  BOOST_TEST(after.genus() == before.genus());
  BOOST_TEST(mesh.is_valid(false));
}

std::vector<std::size_t> link_of(const Sculptor<Mesh>& sculptor, Vertex_index v) {
  std::vector<std::size_t> link;
  for (const Vertex_index w : sculptor.mesh().vertices_around_target(sculptor.mesh().halfedge(v)))
    link.push_back(sculptor.id(w));
  return link;
}

/// The faces, with one number in place of another.
std::vector<std::array<std::size_t, 3>> renamed(const Mesh_snapshot& snapshot, std::size_t from, std::size_t to) {
  Mesh_snapshot result;
  for (auto f : snapshot.faces) {
    std::replace(f.begin(), f.end(), from, to);
    result.add_face(f);
  }
  result.sort();
  return result.faces;
}

oracle::Mesh_list oracle_list(const Mesh& mesh) {
  oracle::Mesh_list list;
  for (std::size_t i = 0; i < mesh.num_vertices();
       ++i) // dead ones are isolated points there, which are no part of the surface
    list.points.push_back(vertex_coordinates(mesh, Vertex_index(static_cast<Mesh::size_type>(i))));
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    list.faces.push_back({static_cast<int>(mesh.source(h)), static_cast<int>(mesh.target(h)),
                          static_cast<int>(mesh.target(mesh.next(h)))});
  }
  return list;
}

meshes::Triangle_list small_scene(std::size_t kind, Random& random) {
  meshes::Triangle_list list;
  switch (kind % 6) {
  case 0: return random_small_list(random, 3);
  case 1: return meshes::torus(3 + random() % 3, 3 + random() % 2);
  case 2: return meshes::bumpy_sphere(0, 0.5, 0.3, static_cast<std::uint32_t>(random()));
  case 3:
    list = meshes::torus(4, 3);
    return list += meshes::cube().scale_and_move(0.25, -0.125, -0.125, -0.125); // a block in the hole
  case 4:
    list = meshes::cube();
    return list += meshes::tetrahedron().scale_and_move(0.5, 0.125, 0.125, 0.125).turn_inside_out(); // a cavity
  default: list = meshes::tetrahedron(); return list += random_small_list(random, 2).scale_and_move(1, 6, 0, 0);
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(removing_until_nothing_more_can_go) {
  Random random(seed_from_environment(35));
  const std::size_t scenes = count_from_environment("HAPTIC_SCULPT_REMOVALS_TO_THE_END", 120);
  std::size_t removed = 0, at_tetrahedra = 0, held = 0, confirmed = 0, wrong = 0;
  std::array<std::size_t, 3> scenes_of_genus{};
  for (std::size_t scene = 0; scene < scenes; ++scene) {
    Mesh mesh = meshes::to_mesh(small_scene(scene, random));
    BOOST_REQUIRE(validate(mesh).is_valid());
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot begin = snapshot(sculptor);
    const Counts counts(mesh);
    ++scenes_of_genus[std::min(counts.genus(), 2)];
    std::size_t steps = 0;
    for (bool something_went = true; something_went;) {
      something_went = false;
      std::vector<Vertex_index> order(mesh.vertices().begin(), mesh.vertices().end());
      std::shuffle(order.begin(), order.end(), random);
      for (const Vertex_index v : order) {
        const Counts before(mesh);
        if (!sculptor.remove(v))
          continue;
        check_counts(before, mesh, -1);
        something_went = true;
        ++steps;
      }
    }
    removed += steps;
    BOOST_TEST(validate(mesh).is_valid());
    // Every vertex that is left is refused for every one of its neighbours by the independent decision, too.
    const oracle::Mesh_list end = oracle_list(mesh);
    bool is_all_tetrahedra = true;
    for (const Vertex_index v : mesh.vertices()) {
      const auto refusal = sculptor.remove(v);
      BOOST_REQUIRE(!refusal);
      is_all_tetrahedra &= refusal.refusal->reason == Refusal_reason::tetrahedron;
      for (const Vertex_index w : mesh.vertices_around_target(mesh.halfedge(v))) {
        wrong += oracle::collapse_stays_embedded(end, static_cast<int>(v), static_cast<int>(w));
        ++confirmed;
      }
    }
    if (is_all_tetrahedra) {
      ++at_tetrahedra;
      BOOST_TEST(mesh.number_of_vertices() == 4 * counts.components);
      BOOST_TEST(counts.genus() == 0);
    } else {
      ++held;
    }
    for (; steps > 0; --steps)
      BOOST_REQUIRE(sculptor.undo());
    BOOST_TEST((snapshot(sculptor) == begin));
  }
  BOOST_TEST_MESSAGE(removed << " removed; " << at_tetrahedra << " scenes ended at tetrahedra, " << held
                             << " at refusals (genus 0, 1, more: " << scenes_of_genus[0] << ' ' << scenes_of_genus[1]
                             << ' ' << scenes_of_genus[2] << "), " << confirmed << " confirmed");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(at_tetrahedra > scenes / 4);
  BOOST_TEST(scenes_of_genus[1] > scenes / 5);
}

BOOST_AUTO_TEST_CASE(inverse_pairs_and_counts) {
  Random random(seed_from_environment(36));
  std::size_t refilled_faces = 0, refilled_edges = 0;
  for (const auto& list : {meshes::bumpy_sphere(1, 0.2, 0.02), meshes::torus(8, 6), meshes::box(2),
                           meshes::row_of_spheres(2, 0), meshes::bipyramid(9)}) {
    Mesh mesh = meshes::to_mesh(list);
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot begin = snapshot(sculptor);
    const Counts counts(mesh);
    const auto is_begin = [&] { return snapshot(sculptor) == begin && Counts(mesh).edges == counts.edges; };

    for (int i = 0; i < 30; ++i) { // on a face; away by undo, by removal
      const auto f = pick(mesh.faces(), mesh.number_of_faces(), random);
      const auto h = mesh.halfedge(f);
      const std::array<Vertex_index, 3> corners = {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
      std::array<std::size_t, 3> degrees;
      for (int k = 0; k < 3; ++k)
        degrees[k] = mesh.degree(corners[k]);
      const auto made = sculptor.insert_on_face(f, in_face(mesh, f, 0.3, 0.25));
      if (!made) // rounding took the place below the face, onto a neighbour
        continue;
      check_counts(counts, mesh, 1);
      BOOST_TEST(mesh.degree(*made.vertex) == 3u);
      for (int k = 0; k < 3; ++k)
        BOOST_TEST(mesh.degree(corners[k]) == degrees[k] + 1);
      const Mesh_snapshot after = snapshot(sculptor);
      BOOST_REQUIRE(sculptor.undo());
      BOOST_TEST(is_begin());
      BOOST_REQUIRE(sculptor.redo());
      BOOST_TEST((snapshot(sculptor) == after));
      BOOST_REQUIRE(sculptor.remove(sculptor.vertex(sculptor.number_of_ids() - 1)));
      BOOST_TEST(is_begin());
    }

    for (int i = 0; i < 30; ++i) { // on an edge; away by undo, by redo and undo
      const auto e = pick(mesh.edges(), mesh.number_of_edges(), random);
      const auto h = mesh.halfedge(e);
      const std::array<Vertex_index, 4> around = {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)),
                                                  mesh.target(mesh.next(mesh.opposite(h)))};
      std::array<std::size_t, 4> degrees;
      for (int k = 0; k < 4; ++k)
        degrees[k] = mesh.degree(around[k]);
      const auto made = sculptor.insert_on_edge(e, CGAL::midpoint(mesh.point(around[0]), mesh.point(around[1])));
      if (!made)
        continue;
      check_counts(counts, mesh, 1);
      BOOST_TEST(mesh.degree(*made.vertex) == 4u);
      for (int k = 0; k < 4; ++k) // the ends keep their valence, the corners opposite gain one
        BOOST_TEST(mesh.degree(around[k]) == degrees[k] + (k < 2 ? 0 : 1));
      const Mesh_snapshot after = snapshot(sculptor);
      BOOST_REQUIRE(sculptor.undo());
      BOOST_TEST(is_begin());
      BOOST_REQUIRE(sculptor.redo());
      BOOST_TEST((snapshot(sculptor) == after));
      BOOST_REQUIRE(sculptor.undo());
      BOOST_TEST(is_begin());
    }

    for (std::size_t number = 0; number < begin.points.size(); ++number) { // away, and back by undo
      const Vertex_index v = sculptor.vertex(number);
      const std::size_t valence = mesh.degree(v);
      const auto gone = sculptor.remove(v);
      if (!gone)
        continue;
      check_counts(counts, mesh, -1);
      const Mesh_snapshot after = snapshot(sculptor);
      BOOST_REQUIRE(sculptor.undo());
      BOOST_TEST(is_begin());
      BOOST_TEST(mesh.degree(sculptor.vertex(number)) == valence);
      BOOST_REQUIRE(sculptor.redo());
      BOOST_TEST((snapshot(sculptor) == after));
      BOOST_REQUIRE(sculptor.undo());
    }

    // What a removal leaves of a vertex of valence 3 or 4 is a face or two: a creation at the old place has to give the
    // same triangles.
    for (int i = 0; i < 40; ++i) {
      const auto f = pick(mesh.faces(), mesh.number_of_faces(), random);
      if (i % 2 == 0)
        sculptor.insert_on_face(f, in_face(mesh, f, 0.4, 0.3));
      const auto e = pick(mesh.edges(), mesh.number_of_edges(), random);
      if (i % 2 == 1)
        sculptor.insert_on_edge(e, CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
      for (const Vertex_index v : std::vector<Vertex_index>(mesh.vertices().begin(), mesh.vertices().end())) {
        if (mesh.is_removed(v) || mesh.degree(v) > 4)
          continue;
        const Mesh_snapshot before = snapshot(sculptor);
        const std::size_t old_number = sculptor.id(v);
        const Point_3 p = mesh.point(v);
        const auto link = link_of(sculptor, v);
        const auto gone = sculptor.remove(v);
        if (!gone)
          continue;
        const std::size_t apex = sculptor.id(*gone.vertex);
        const std::size_t across =
            link.size() == 4 ? link[(std::find(link.begin(), link.end(), apex) - link.begin() + 2) % 4] : 0;
        const auto made = link.size() == 3 ? sculptor.insert_on_face(sculptor.face_of(link[0], link[1], link[2]), p)
                                           : sculptor.insert_on_edge(sculptor.edge_of(apex, across), p);
        BOOST_REQUIRE(made);
        BOOST_TEST((renamed(snapshot(sculptor), sculptor.id(*made.vertex), old_number) == before.faces));
        ++(link.size() == 3 ? refilled_faces : refilled_edges);
        BOOST_REQUIRE(sculptor.undo());
        BOOST_REQUIRE(sculptor.undo());
        BOOST_TEST((snapshot(sculptor) == before));
      }
    }
    while (sculptor.undo())
      ;
    BOOST_TEST(is_begin());
  }
  BOOST_TEST_MESSAGE(refilled_faces << " vertices of valence 3 and " << refilled_edges
                                    << " of valence 4 removed and created anew");
  BOOST_TEST(refilled_faces > 50u);
  BOOST_TEST(refilled_edges > 50u);
}
