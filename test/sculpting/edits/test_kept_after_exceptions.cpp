// SPDX-License-Identifier: GPL-3.0-or-later
// Values of kept property maps where a visitor throws: of what stands, of what is taken back, and of what is not made.
#include "sculpting/edits/Numbered_mesh.h"

#include <boost/test/unit_test.hpp>

#include <utility>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

struct Interruption {};

/// Throws once, at that place.
struct Throwing_visitor : Default_edit_visitor {
  enum class Place { nowhere, dies, replaces } place = Place::nowhere;
  void face_dies(Mesh::Face_index) { hear(Place::dies); }
  void face_replaces(Mesh::Face_index, Mesh::Face_index) { hear(Place::replaces); }

private:
  void hear(Place here) {
    if (here == place) {
      place = Place::nowhere;
      throw Interruption();
    }
  }
};
using Place = Throwing_visitor::Place;

/// Creations on a ball whose elements have values of their own.
struct Interrupted {
  Numbered_mesh numbered{lumpy_ball()};
  Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor> sculptor{numbered.mesh};
  Interrupted() { numbered.keep_all(sculptor); }

  auto values() const { return all_values(sculptor, numbered); }
  bool create(std::uint32_t face, Place place) {
    sculptor.visitor().place = place;
    const auto h = numbered.mesh.halfedge(Mesh::Face_index(face));
    const auto p = [&](auto v) { return numbered.mesh.point(v) - CGAL::ORIGIN; };
    const auto& mesh = numbered.mesh;
    const auto middle = (p(mesh.source(h)) + p(mesh.target(h)) + p(mesh.target(mesh.next(h)))) / 3;
    try {
      BOOST_TEST(static_cast<bool>(sculptor.insert_on_face(Mesh::Face_index(face), CGAL::ORIGIN + 1.01 * middle)));
      return true;
    } catch (const Interruption&) {
      return false;
    }
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(kept_values_are_those_of_an_edit_that_stands_where_the_visitor_has_thrown) {
  Interrupted calm, thrown;
  const auto before = thrown.values();
  BOOST_TEST(calm.create(3, Place::nowhere));
  BOOST_TEST(!thrown.create(3, Place::replaces));
  BOOST_TEST(thrown.sculptor.history().number_of_undo_steps() == 1u);
  BOOST_TEST((thrown.values() == calm.values()));
  BOOST_TEST(static_cast<bool>(thrown.sculptor.undo()));
  BOOST_TEST((thrown.values() == before));
}

BOOST_AUTO_TEST_CASE(kept_values_are_back_where_an_undo_is_taken_back) {
  Interrupted scene;
  const auto begin = scene.values();
  {
    const auto stroke = scene.sculptor.stroke();
    BOOST_TEST((scene.create(3, Place::nowhere) && scene.create(4, Place::nowhere)));
  }
  scene.numbered.renumber();
  const auto before = scene.values();
  scene.sculptor.visitor().place = Place::replaces;
  BOOST_CHECK_THROW(scene.sculptor.undo(), Interruption);
  BOOST_TEST(scene.sculptor.history().number_of_undo_steps() == 1u);
  BOOST_TEST((scene.values() == before));
  BOOST_TEST(static_cast<bool>(scene.sculptor.undo()));
  BOOST_TEST(scene.values().size() == begin.size());
  BOOST_TEST(static_cast<bool>(scene.sculptor.redo()));
  BOOST_TEST((scene.values() == before));
}

BOOST_AUTO_TEST_CASE(an_edit_that_is_not_made_leaves_what_redo_gives_back) {
  Interrupted scene;
  BOOST_TEST(scene.create(3, Place::nowhere));
  scene.numbered.renumber();
  const auto made = scene.values();
  BOOST_TEST(static_cast<bool>(scene.sculptor.undo()));
  BOOST_TEST(!scene.create(9, Place::dies));
  BOOST_TEST(scene.sculptor.history().number_of_redo_steps() == 1u);
  BOOST_TEST(static_cast<bool>(scene.sculptor.redo()));
  BOOST_TEST((scene.values() == made));
}

namespace {

struct Counting_visitor : Default_edit_visitor {
  int faces = 0, vertices = 0;
  void face_dies(Mesh::Face_index) { --faces; }
  void face_created(Mesh::Face_index) { ++faces; }
  void vertex_dies(Mesh::Vertex_index, std::size_t) { --vertices; }
  void vertex_created(Mesh::Vertex_index, std::size_t) { ++vertices; }
};

} // namespace

// A map is not the visitor's: the visitor hears of all that stands.
BOOST_AUTO_TEST_CASE(a_visitor_hears_of_an_edit_that_stands_where_a_map_has_thrown) {
  for (const bool removes : {false, true}) {
    Mesh mesh = meshes::to_mesh(lumpy_ball());
    const auto map = mesh.add_property_map<Mesh::Face_index, int>("f:value", 1).first;
    bool throws = true;
    const auto policy = [&throws](const Property_origin<int>& origin) {
      if (std::exchange(throws, false))
        throw Interruption();
      return *origin.values[0];
    };
    Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Counting_visitor> sculptor(mesh);
    sculptor.keep(map, policy);
    const int faces = static_cast<int>(mesh.number_of_faces()), vertices = static_cast<int>(mesh.number_of_vertices());
    const auto e = *mesh.edges_begin();
    const auto middle = CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
    if (removes)
      BOOST_CHECK_THROW(sculptor.remove(Mesh::Vertex_index(7)), Interruption);
    else
      BOOST_CHECK_THROW(sculptor.insert_on_edge(e, middle), Interruption);
    BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
    BOOST_TEST(static_cast<int>(mesh.number_of_faces()) - faces == sculptor.visitor().faces);
    BOOST_TEST(static_cast<int>(mesh.number_of_vertices()) - vertices == sculptor.visitor().vertices);
  }
}

namespace {

/// A map of others, which throws once, at the n-th value from here on.
template <class Map>
struct Throwing_map {
  using key_type = typename boost::property_traits<Map>::key_type;
  using value_type = typename boost::property_traits<Map>::value_type;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;
  Map map;
  int* left;
  friend value_type get(const Throwing_map& m, key_type k) { return get(m.map, k); }
  friend void put(const Throwing_map& m, key_type k, value_type value) {
    if (*m.left > 0 && --*m.left == 0)
      throw Interruption();
    put(m.map, k, value);
  }
};
template <class Map>
Throwing_map(Map, int*) -> Throwing_map<Map>;

/// A step of two removals, to be undone or to be redone, with values that were given since; the maps, too, if late.
struct Step {
  int left = 0; ///< until a map throws
  Numbered_mesh numbered{lumpy_ball()};
  Sculptor<Mesh> sculptor{numbered.mesh};
  bool is_redo;

  Step(bool is_redo, bool is_late) : is_redo(is_redo) {
    if (!is_late)
      keep_all();
    {
      const auto stroke = sculptor.stroke();
      BOOST_REQUIRE(static_cast<bool>(sculptor.remove(Mesh::Vertex_index(7))));
      BOOST_REQUIRE(static_cast<bool>(sculptor.remove(Mesh::Vertex_index(20))));
    }
    numbered.renumber();
    sculptor.undo();
    numbered.renumber();
    if (!is_redo)
      sculptor.redo();
    if (is_late)
      keep_all();
  }
  void keep_all() {
    sculptor.keep(Throwing_map{numbered.of_vertices, &left});
    sculptor.keep(Throwing_map{numbered.of_halfedges, &left});
    sculptor.keep(Throwing_map{numbered.of_edges, &left});
    sculptor.keep(Throwing_map{numbered.of_faces, &left});
  }
  auto values() const { return all_values(sculptor, numbered); }
  std::size_t steps() const { return sculptor.history().number_of_undo_steps(); }
  void go() { is_redo ? sculptor.redo() : sculptor.undo(); }
};

} // namespace

namespace {

struct Failing_map {
  using key_type = Mesh::Vertex_index;
  using value_type = int;
  using reference = int;
  using category = boost::read_write_property_map_tag;
  Mesh::Property_map<Mesh::Vertex_index, int> map;
  int* left; ///< values that can be put, and one: then each throws; 0: all can
  friend int get(const Failing_map& m, Mesh::Vertex_index v) { return m.map[v]; }
  friend void put(const Failing_map& m, Mesh::Vertex_index v, int value) {
    if (*m.left == 1)
      throw Interruption();
    *m.left -= *m.left > 0;
    m.map[v] = value;
  }
};

} // namespace

// A map that throws from some time on, also while what was taken back is made again.
BOOST_AUTO_TEST_CASE(a_visitor_hears_of_a_step_that_a_map_breaks_off_again_and_again) {
  int broken = 0, stand = 0;
  for (int n = 1; n <= 6; ++n) {
    Mesh mesh = meshes::to_mesh(lumpy_ball());
    const auto values = mesh.add_property_map<Mesh::Vertex_index, int>("v:value", 1).first;
    int left = 0;
    Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Counting_visitor> sculptor(mesh);
    sculptor.keep(Failing_map{values, &left});
    {
      const auto stroke = sculptor.stroke();
      BOOST_REQUIRE(static_cast<bool>(sculptor.remove(Mesh::Vertex_index(3))));
      BOOST_REQUIRE(static_cast<bool>(sculptor.remove(Mesh::Vertex_index(7))));
      const auto e = *mesh.edges_begin(); // to be created again where the removal before it cannot be undone
      BOOST_REQUIRE(static_cast<bool>(
          sculptor.insert_on_edge(e, CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))))));
      BOOST_REQUIRE(static_cast<bool>(sculptor.remove(Mesh::Vertex_index(20))));
    }
    const int faces = static_cast<int>(mesh.number_of_faces()), vertices = static_cast<int>(mesh.number_of_vertices());
    sculptor.visitor() = Counting_visitor();
    left = n;
    try {
      sculptor.undo();
    } catch (const Interruption&) {
      ++broken;
    }
    stand += sculptor.history().number_of_undo_steps() == 0;
    BOOST_TEST(static_cast<int>(mesh.number_of_faces()) - faces == sculptor.visitor().faces);
    BOOST_TEST(static_cast<int>(mesh.number_of_vertices()) - vertices == sculptor.visitor().vertices);
  }
  BOOST_TEST_MESSAGE(broken << " broken off, " << stand << " undone all the same");
  BOOST_TEST(broken == 3);
}

// Of all values, those of the change that was broken off included.
BOOST_AUTO_TEST_CASE(a_step_that_a_map_breaks_off_is_made_later_as_if_nothing_had_been) {
  int broken = 0;
  for (const auto& [is_redo, is_late] : {std::pair(false, false), {true, false}, {false, true}, {true, true}}) {
    Step calm(is_redo, is_late);
    const auto before = calm.values();
    const std::size_t steps = calm.steps();
    calm.go();
    for (int n = 1;; ++n) {
      Step step(is_redo, is_late);
      step.left = n;
      try {
        step.go();
        break; // fewer values are written
      } catch (const Interruption&) {
      }
      if (step.steps() != steps) // the last change of the step was made, and stands
        continue;
      ++broken;
      BOOST_TEST((step.values() == before));
      step.go();
      BOOST_TEST((step.values() == calm.values()));
    }
  }
  BOOST_TEST(broken > 40);
}
