// SPDX-License-Identifier: GPL-3.0-or-later
// Values of kept property maps: back after undo and redo, carried on by edits; compared with copies by number of
// vertex.
#include "sculpting/edits/Numbered_mesh.h"
#include "sculpting/edits/random_edits.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

#include <boost/test/unit_test.hpp>

#include <map>
#include <set>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

// The mesh knows nothing of it.
template <class Key>
struct Own_map {
  using key_type = Key;
  using value_type = int;
  using reference = int;
  using category = boost::read_write_property_map_tag;
  std::map<Key, int>* values;
  friend int get(const Own_map& map, Key key) { return (*map.values)[key]; }
  friend void put(const Own_map& map, Key key, int value) { (*map.values)[key] = value; }
};

template <class Key>
struct Two_maps {
  typename Mesh::Property_map<Key, int> of_mesh;
  std::map<Key, int> own;

  explicit Two_maps(Mesh& mesh) : of_mesh(mesh.add_property_map<Key, int>("own", 0).first) {}
  template <class Range>
  void fill(const Range& keys) {
    int value = 100;
    for (const Key key : keys)
      of_mesh[key] = own[key] = value++;
  }
  void keep(Sculptor<Mesh>& sculptor) {
    sculptor.keep(of_mesh);
    sculptor.keep(Own_map<Key>{&own});
  }
  template <class Range>
  std::size_t differing(const Range& keys) {
    std::size_t result = 0;
    for (const Key key : keys)
      result += of_mesh[key] != own[key];
    return result;
  }
};

} // namespace

// Values of what is new are overwritten after each edit by ones never used, so that what undo and redo bring back
// cannot come from anywhere else.
BOOST_AUTO_TEST_CASE(kept_values_are_back_after_undo_and_redo) {
  const auto seed = seed_from_environment(20);
  Random random(seed);
  BOOST_TEST_MESSAGE("seed " << seed);
  std::size_t edits = 0, undone = 0, redone = 0;
  for (int scene = 0; scene < 20; ++scene) {
    Numbered_mesh numbered(lumpy_ball());
    Sculptor<Mesh> sculptor(numbered.mesh);
    numbered.keep_all(sculptor);
    const bool is_bounded = scene % 3 == 1;
    if (is_bounded)
      sculptor.set_history_limit({20, 1000000});
    std::vector<std::map<std::pair<int, Names>, int>> states = {all_values(sculptor, numbered)};
    std::size_t at = 0; // of the states, the one that is now
    for (int k = 0; k < 200; ++k) {
      const Mesh_snapshot before = snapshot(sculptor);
      const auto values_before = all_values(sculptor, numbered);
      const std::size_t undo_steps = sculptor.history().number_of_undo_steps();
      const Random_edit edit = random_edit(sculptor, random);
      if (edit.kind == Random_edit::undo || edit.kind == Random_edit::redo) {
        if (!edit.is_done)
          continue;
        at += edit.kind == Random_edit::redo ? 1 : -1;
        BOOST_REQUIRE((all_values(sculptor, numbered) == states[at]));
        ++(edit.kind == Random_edit::undo ? undone : redone);
        continue;
      }
      if (sculptor.history().number_of_undo_steps() == undo_steps && snapshot(sculptor) == before)
        continue;
      ++edits;
      for (const auto& [names, value] : all_values(sculptor, numbered))
        if (const auto old = values_before.find(names); old != values_before.end())
          BOOST_REQUIRE_EQUAL(value, old->second); // what stays keeps its value
      for (const auto v : numbered.mesh.vertices())
        if (values_before.count({0, {sculptor.id(v), 0, 0}}) == 0)
          numbered.of_vertices[v] = numbered.next++;
      for (const auto f : numbered.mesh.faces()) {
        Names corners{};
        std::size_t i = 0;
        for (const auto v : numbered.mesh.vertices_around_face(numbered.mesh.halfedge(f)))
          corners[i++] = sculptor.id(v);
        std::sort(corners.begin(), corners.end());
        if (values_before.count({3, corners}) == 0)
          numbered.of_faces[f] = numbered.next++;
      }
      for (const auto h : numbered.mesh.halfedges())
        if (values_before.count({1, {sculptor.id(numbered.mesh.source(h)), sculptor.id(numbered.mesh.target(h)), 0}}) ==
            0)
          numbered.of_halfedges[h] = numbered.of_edges[numbered.mesh.edge(h)] = numbered.next++;
      states.resize(++at);
      states.push_back(all_values(sculptor, numbered));
    }
  }
  BOOST_TEST_MESSAGE(edits << " edits, " << undone << " undone, " << redone << " redone");
  BOOST_TEST(edits > 2000);
  BOOST_TEST(undone > 200);
  BOOST_TEST(redone > 20);
}

// Elements that come from nothing have descriptors of others that died.
BOOST_AUTO_TEST_CASE(maps_of_ones_own_have_the_values_of_those_of_the_mesh) {
  const auto seed = seed_from_environment(21);
  Random random(seed);
  BOOST_TEST_MESSAGE("seed " << seed);
  for (int scene = 0; scene < 10; ++scene) {
    Mesh mesh = meshes::to_mesh(lumpy_ball());
    Two_maps<Mesh::Vertex_index> vertices(mesh);
    Two_maps<Mesh::Halfedge_index> halfedges(mesh);
    Two_maps<Mesh::Edge_index> edges(mesh);
    Two_maps<Mesh::Face_index> faces(mesh);
    Sculptor<Mesh> sculptor(mesh);
    vertices.fill(mesh.vertices()), halfedges.fill(mesh.halfedges()), edges.fill(mesh.edges()),
        faces.fill(mesh.faces());
    vertices.keep(sculptor), halfedges.keep(sculptor), edges.keep(sculptor), faces.keep(sculptor);
    for (int k = 0; k < 100; ++k) {
      random_edit(sculptor, random);
      BOOST_REQUIRE_EQUAL(vertices.differing(mesh.vertices()), 0u);
      BOOST_REQUIRE_EQUAL(halfedges.differing(mesh.halfedges()), 0u);
      BOOST_REQUIRE_EQUAL(edges.differing(mesh.edges()), 0u);
      BOOST_REQUIRE_EQUAL(faces.differing(mesh.faces()), 0u);
    }
  }
}

BOOST_AUTO_TEST_CASE(kept_values_are_back_after_a_stroke_of_remeshing) {
  Numbered_mesh numbered(meshes::bumpy_sphere(3, 0.2, 0.1));
  Sculptor<Mesh> sculptor(numbered.mesh);
  numbered.keep_all(sculptor);
  const auto before = all_values(sculptor, numbered);
  isotropic_remeshing(sculptor, 0.15, CGAL::parameters::number_of_iterations(3));
  const auto after = all_values(sculptor, numbered);
  std::size_t without = 0;
  for (const auto& [names, value] : after)
    without += names.first == 3 && value == 0;
  BOOST_TEST(without == 0); // every new face comes from an old one
  BOOST_REQUIRE(sculptor.undo());
  BOOST_TEST((all_values(sculptor, numbered) == before));
  BOOST_REQUIRE(sculptor.redo());
  BOOST_TEST((all_values(sculptor, numbered) == after));
}

// Each rule by hand, on one place of a ball.
BOOST_AUTO_TEST_CASE(what_is_new_has_the_value_of_what_it_comes_from) {
  Numbered_mesh numbered(lumpy_ball());
  Mesh& mesh = numbered.mesh;
  auto weights = mesh.add_property_map<Mesh::Vertex_index, double>("v:weight", 0).first;
  for (const auto v : mesh.vertices())
    weights[v] = static_cast<double>(static_cast<std::size_t>(v));
  Sculptor<Mesh> sculptor(mesh);
  numbered.keep_all(sculptor);
  sculptor.keep(weights, Interpolate_property());

  { // on a face: the three new ones have the value of the old one
    const auto f = *mesh.faces().begin();
    const auto h = mesh.halfedge(f);
    const double sum = weights[mesh.source(h)] + weights[mesh.target(h)] + weights[mesh.target(mesh.next(h))];
    const int value = numbered(f);
    const auto done = sculptor.insert_on_face(f, in_face(mesh, f, 1.0 / 3, 1.0 / 3));
    BOOST_REQUIRE(done);
    for (const auto g : mesh.faces_around_target(mesh.halfedge(*done.vertex)))
      BOOST_TEST(numbered(g) == value);
    BOOST_TEST(std::abs(weights[*done.vertex] - sum / 3) < 1e-9 * sum);
    for (const auto g : mesh.halfedges_around_target(mesh.halfedge(*done.vertex)))
      BOOST_TEST(numbered(mesh.edge(g)) == 0); // edges within a face come from none
    BOOST_REQUIRE(sculptor.undo());
  }
  numbered.renumber();
  { // on an edge: its halves have its value, the faces theirs
    const auto h = *mesh.halfedges().begin();
    const auto a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h)),
               d = mesh.target(mesh.next(mesh.opposite(h)));
    const int edge = numbered(mesh.edge(h)), forth = numbered(h), back = numbered(mesh.opposite(h)),
              left = numbered(mesh.face(h)), right = numbered(mesh.face(mesh.opposite(h)));
    const auto done = sculptor.insert_on_edge(mesh.edge(h), CGAL::midpoint(mesh.point(a), mesh.point(b)));
    BOOST_REQUIRE(done);
    const auto v = *done.vertex;
    BOOST_TEST(numbered(mesh.halfedge(a, v)) == forth);
    BOOST_TEST(numbered(mesh.halfedge(v, b)) == forth);
    BOOST_TEST(numbered(mesh.halfedge(b, v)) == back);
    BOOST_TEST(numbered(mesh.halfedge(v, a)) == back);
    for (const auto end : {a, b}) {
      BOOST_TEST(numbered(mesh.edge(mesh.halfedge(v, end))) == edge);
      const auto to = mesh.halfedge(v, end);
      for (const auto g : {to, mesh.opposite(to)})
        BOOST_TEST(numbered(mesh.face(g)) == (mesh.target(mesh.next(g)) == c ? left : right));
    }
    BOOST_TEST(numbered(mesh.edge(mesh.halfedge(v, d))) == 0);
    BOOST_REQUIRE(sculptor.undo());
  }
  numbered.renumber();
  { // collapse: what had the one has the other, and what the other had stays
    std::size_t done = 0;
    for (const auto h : mesh.halfedges()) {
      const auto v = mesh.source(h), p = mesh.target(h);
      std::map<std::pair<Vertex_index, Vertex_index>, int> faces;
      std::map<Vertex_index, int> edges;
      for (const auto g : mesh.halfedges_around_target(mesh.halfedge(v))) {
        faces[{mesh.source(g), mesh.target(mesh.next(g))}] = numbered(mesh.face(g));
        edges[mesh.source(g)] = numbered(mesh.edge(g));
      }
      std::map<Vertex_index, int> old;
      for (const auto g : mesh.halfedges_around_target(mesh.halfedge(p)))
        old[mesh.source(g)] = numbered(mesh.edge(g));
      if (!sculptor.collapse(h))
        continue;
      std::size_t carried = 0;
      for (const auto g : mesh.halfedges_around_target(mesh.halfedge(p))) {
        const auto w = mesh.source(g);
        BOOST_TEST(numbered(mesh.edge(g)) == (old.count(w) ? old[w] : edges[w]));
        if (const auto at = faces.find({w, mesh.target(mesh.next(g))}); at != faces.end()) {
          BOOST_TEST(numbered(mesh.face(g)) == at->second);
          ++carried;
        }
      }
      BOOST_TEST(carried == faces.size() - 2);
      BOOST_REQUIRE(sculptor.undo());
      if (++done == 10)
        break;
    }
    BOOST_TEST(done == 10u);
  }
  { // flip: the new edge has the value of the old one; the faces those that their descriptors had, or one of both
    std::size_t done = 0;
    for (const auto e : mesh.edges()) {
      const int value = numbered(e);
      const std::set<int> both = {numbered(mesh.face(mesh.halfedge(e))),
                                  numbered(mesh.face(mesh.opposite(mesh.halfedge(e))))};
      if (!sculptor.flip(e))
        continue;
      BOOST_TEST(numbered(e) == value);
      BOOST_TEST(both.count(numbered(mesh.face(mesh.halfedge(e)))) == 1u);
      BOOST_REQUIRE(sculptor.undo());
      if (++done == 10)
        break;
    }
    BOOST_TEST(done == 10u);
  }
}

namespace {

/// Keeps an attribute of faces by what it hears.
struct Attribute_visitor : Default_edit_visitor {
  std::map<Mesh::Face_index, std::size_t> attribute, dead;
  void face_dies(Mesh::Face_index f) {
    dead[f] = attribute[f];
    attribute.erase(f);
  }
  void face_replaces(Mesh::Face_index created, Mesh::Face_index old) { attribute[created] = dead.at(old); }
  void face_created(Mesh::Face_index) { dead.clear(); }
};

} // namespace

// A visitor that hears which face comes from which knows what a kept map has.
BOOST_AUTO_TEST_CASE(a_visitor_hears_what_comes_from_what) {
  Random random(seed_from_environment(21));
  Numbered_mesh numbered(lumpy_ball());
  Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Attribute_visitor> sculptor(numbered.mesh);
  numbered.keep_all(sculptor);
  auto& attribute = sculptor.visitor().attribute;
  for (const auto f : numbered.mesh.faces())
    attribute[f] = static_cast<std::size_t>(numbered(f));
  for (int k = 0; k < 2000; ++k) {
    const auto edit = random_edit(sculptor, random);
    if (edit.kind == Random_edit::undo ||
        edit.kind == Random_edit::redo) { // two faces of a revived star come from none
      for (const auto f : numbered.mesh.faces())
        attribute[f] = static_cast<std::size_t>(numbered(f));
      continue;
    }
    BOOST_REQUIRE_EQUAL(attribute.size(), numbered.mesh.number_of_faces());
    for (const auto f : numbered.mesh.faces())
      BOOST_REQUIRE_EQUAL(attribute.at(f), static_cast<std::size_t>(numbered(f)));
  }
}

// Else a value made of its neighbours' would take the place of the point that was proven.
BOOST_AUTO_TEST_CASE(the_points_of_the_mesh_are_not_kept) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  const auto copied = mesh.add_property_map<Mesh::Vertex_index, Point_3>("v:copied").first;
  Sculptor<Mesh> sculptor(mesh);
  BOOST_CHECK_THROW(sculptor.keep(mesh.points()), Invalid_parameter);
  sculptor.keep(copied);
  const auto f = *mesh.faces().begin();
  BOOST_REQUIRE(sculptor.insert_on_face(f, in_face(mesh, f, 0.3, 0.3)));
  sculptor.check_unchanged();
  BOOST_TEST(validate(mesh).is_valid());
}
