// SPDX-License-Identifier: GPL-3.0-or-later
// The set of impacts that come first, against the rational oracle of single sweeps over all pairs; and the broad phases
// against each other.
#include "sculpting/Random_scene.h"

#include "oracle/sweep_oracle.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Named = std::pair<int, std::set<std::size_t>>; ///< feature and static vertices

std::array<double, 15> fifteen(const std::array<Point_3, 5>& p) {
  std::array<double, 15> x;
  for (int i = 0; i < 5; ++i)
    x[3 * i] = p[i].x(), x[3 * i + 1] = p[i].y(), x[3 * i + 2] = p[i].z();
  return x;
}

/// All pairs, no boxes, no order: straight from the statement of the three tests.
std::set<Named> brute_force(const Mesh& mesh, Vertex_index j, const Point_3& target) {
  std::set<Named> firsts;
  std::optional<mpq_class> first;
  const Point_3 source = mesh.point(j);
  const auto ask = [&](Sweep_kind kind, std::array<Vertex_index, 3> v) {
    const auto time = first_time(kind, fifteen({source, target, mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])}));
    if (!time || (first && *time > *first))
      return;
    if (!first || *time < *first)
      firsts.clear();
    first = *time;
    firsts.insert({static_cast<int>(kind), {v.begin(), v.end()}});
  };
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const std::array<Vertex_index, 3> v = {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
    if (std::find(v.begin(), v.end(), j) == v.end())
      ask(Sweep_kind::vertex_face, v);
  }
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(j))) {
    const Vertex_index v = mesh.source(h);
    for (const auto e : mesh.edges()) {
      const Vertex_index a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
      if (a != j && b != j && a != v && b != v)
        ask(Sweep_kind::edge_edge, {v, a, b});
    }
    const Vertex_index g = v, i = mesh.target(mesh.next(h));
    for (const Vertex_index a : mesh.vertices())
      if (a != j && a != g && a != i)
        ask(Sweep_kind::face_vertex, {g, i, a});
  }
  return firsts;
}

template <class Broad_phase>
std::vector<Point_3> positions_after(Mesh mesh, std::uint64_t seed, std::size_t drags) {
  Random random(seed);
  Sculptor<Mesh, Broad_phase> sculptor(mesh, parameters::response(Response::stop));
  std::uniform_real_distribution<double> step(-0.5, 0.5);
  std::vector<Point_3> positions;
  for (std::size_t i = 0; i < drags; ++i) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
    auto grab = sculptor.grab(v);
    for (int k = 0; k < 3; ++k) {
      const double scale = random() % 4 == 0 ? 8 : 0.5;
      const double x = step(random), y = step(random), z = step(random);
      const auto result = grab.drag_to(mesh.point(v) + scale * Mesh::Point::R::Vector_3(x, y, z));
      positions.push_back(result.position);
      for (const auto& contact : result.contacts)
        positions.push_back({contact.normal[0], contact.normal[1], contact.normal[2]});
    }
  }
  BOOST_TEST(validate(mesh).is_valid());
  return positions;
}

/// A broad phase must name every face whose box meets the query's, each once, and none that is dead.
template <class Broad_phase>
void check_queries(std::uint64_t seed) {
  Random random(seed);
  Mesh mesh = meshes::to_mesh(meshes::torus(20, 12));
  Broad_phase broad_phase(mesh);
  std::uniform_real_distribution<double> number(-1.6, 1.6);
  const auto point = [&]() -> Box_3::Coordinates {
    const double x = number(random), y = number(random), z = number(random);
    return {x, y, z};
  };
  std::vector<Mesh::Face_index> found, star;
  std::size_t missed = 0, twice = 0, dead = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vertex_index v =
        *std::next(mesh.vertices().begin(), static_cast<std::ptrdiff_t>(random() % mesh.number_of_vertices()));
    star.clear();
    switch (random() % 4) {
    case 0: { // move a vertex
      mesh.point(v) = Point_3(number(random), number(random), number(random));
      for (const auto f : mesh.faces_around_target(mesh.halfedge(v)))
        star.push_back(f);
      broad_phase.faces_moved(star);
      break;
    }
    case 1: { // a new vertex in a face
      const auto f = mesh.face(mesh.halfedge(v));
      broad_phase.faces_removed(std::vector<Mesh::Face_index>{f});
      const auto h = CGAL::Euler::add_center_vertex(mesh.halfedge(f), mesh);
      mesh.point(mesh.target(h)) = Point_3(number(random), number(random), number(random));
      for (const auto g : mesh.faces_around_target(h))
        star.push_back(g);
      broad_phase.faces_inserted(star);
      break;
    }
    case 2: // remove a vertex of valence 3
      if (mesh.degree(v) == 3) {
        for (const auto f : mesh.faces_around_target(mesh.halfedge(v)))
          star.push_back(f);
        broad_phase.faces_removed(star);
        const auto h = CGAL::Euler::remove_center_vertex(mesh.halfedge(v), mesh);
        broad_phase.faces_inserted(std::vector<Mesh::Face_index>{mesh.face(h)});
      }
      break;
    default:;
    }
    Box_3 box(point());
    if (random() % 3 != 0)
      box.include(point());
    if (random() % 50 == 0) // beyond all floats
      box.include({-1e300, -1e300, -1e300}).include({1e300, 1e300, 1e300});
    if (random() % 3 == 0) { // touches a face's box from outside, exactly
      const Box_3 other = face_box(mesh, *mesh.faces().begin());
      box.upper = other.lower;
      for (int k = 0; k < 3; ++k)
        box.lower[k] = box.upper[k] - 0.25;
    }
    found.clear();
    broad_phase.query(box, found);
    std::set<Mesh::Face_index> unique(found.begin(), found.end());
    twice += unique.size() != found.size();
    for (const auto f : found)
      dead += mesh.is_removed(f);
    for (const auto f : mesh.faces())
      missed += do_meet(face_box(mesh, f), box) && unique.count(f) == 0;
    // A long swept star: every face that the three sweeps can hit has to be there.
    const Vertex_index w = *mesh.vertices().begin();
    internal::Star<Mesh> swept;
    swept.collect(mesh, w);
    const auto source = vertex_coordinates(mesh, w), target = point();
    found.clear();
    broad_phase.query_star(swept.swept(source, target), found);
    unique = {found.begin(), found.end()};
    const auto is_free_of = [&](const std::vector<Mesh::Face_index>& faces) {
      internal::Candidate_list<Mesh> list;
      list.assign(mesh, internal::Face_corners<Mesh>(mesh), swept, faces, Box_3());
      return internal::Narrow_phase<Mesh>(Exact_sweep_traits<Mesh>()).is_free(swept, list, source, target);
    };
    if (i % 30 == 0 && is_free_of({})) // the star does not meet its own link's vertices, which are in every list
      for (const auto f : mesh.faces())
        missed += !is_free_of({f}) && unique.count(f) == 0;
  }
  BOOST_TEST(missed == 0u);
  BOOST_TEST(twice == 0u);
  BOOST_TEST(dead == 0u);
}

} // namespace

BOOST_AUTO_TEST_CASE(simultaneous_firsts_agree_with_all_pairs_over_rationals) {
  Random random(seed_from_environment(5));
  std::size_t wrong = 0, several = 0;
  for (int i = 0; i < 60; ++i) {
    const meshes::Triangle_list list = random_small_list(random, 2);
    const Mesh mesh = meshes::to_mesh(list);
    for (int k = 0; k < 10; ++k) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % list.points.size()));
      const Point_3 target =
          random() % 2 == 0 ? random_grid_point(random, 4) : list.points[random() % list.points.size()];
      if (target == mesh.point(v))
        continue;
      std::set<Named> found;
      for (const auto& impact : first_impacts(mesh, v, target))
        found.insert({static_cast<int>(impact.feature()), {impact.vertices().begin(), impact.vertices().end()}});
      wrong += found != brute_force(mesh, v, target);
      several += found.size() > 1;
    }
  }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(several > 50u);
}

BOOST_AUTO_TEST_CASE(what_is_asked_of_open_meshes_and_polygons) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  const auto face = *mesh.faces().begin();
  const auto at_the_hole = mesh.target(mesh.halfedge(face));
  CGAL::Euler::remove_face(mesh.halfedge(face), mesh);
  const auto inside = *std::find_if(mesh.vertices().begin(), mesh.vertices().end(),
                                    [&](const Vertex_index v) { return !mesh.is_border(v); });
  BOOST_CHECK_THROW(first_impacts(mesh, at_the_hole, Point_3(0, 0, 0)), Error);
  const auto p = mesh.point(inside);
  BOOST_TEST(first_impacts(mesh, inside, Point_3(2 * p.x(), 2 * p.y(), 2 * p.z())).empty());
  BOOST_TEST(!first_impacts(mesh, inside, Point_3(-2 * p.x(), -2 * p.y(), -2 * p.z())).empty());
  Mesh square;
  std::vector<Vertex_index> corners;
  for (const Point_3& p : {Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0)})
    corners.push_back(square.add_vertex(p));
  square.add_face(corners);
  const Vertex_index beside = square.add_vertex(Point_3(0.25, 0.75, 1));
  BOOST_CHECK_THROW(first_impacts(square, beside, Point_3(0.25, 0.75, -1)), Error); // through it
}

// An edge that was flipped onto another is there twice.
BOOST_AUTO_TEST_CASE(a_vertex_with_two_edges_to_another_is_named) {
  meshes::Triangle_list list = meshes::tetrahedron();
  list += meshes::tetrahedron().scale_and_move(1, 5, 0, 0);
  Mesh mesh = meshes::to_mesh(list);
  const auto flipped = mesh.halfedge(Vertex_index(0), Vertex_index(1));
  CGAL::Euler::flip_edge(flipped, mesh);
  const Point_3 target(20, 0.1, 0.1);
  const auto names = [](const Error& error) {
    return std::string(error.what()).find("has two edges") != std::string::npos;
  };
  for (const auto v : {mesh.source(flipped), mesh.target(flipped)})
    BOOST_CHECK_EXCEPTION(first_impact(mesh, v, target), Error, names);
  BOOST_TEST(first_impact(mesh, Vertex_index(0), target).has_value());
}

// The sweeps answer of edges of no length, too, whether preconditions are checked or not.
BOOST_AUTO_TEST_CASE(meshes_with_edges_of_no_length_are_answered) {
  meshes::Triangle_list list = meshes::tetrahedron();
  list += meshes::tetrahedron().scale_and_move(1, 5, 0, 0);
  Mesh mesh = meshes::to_mesh(list);
  mesh.point(Vertex_index(5)) = mesh.point(Vertex_index(4));
  for (const auto v : mesh.vertices())
    BOOST_TEST(
        first_impact(mesh, v, mesh.point(v) + meshes::Kernel::Vector_3(v.idx() < 4 ? 20 : -20, 0.1, 0.1)).has_value());
}

BOOST_AUTO_TEST_CASE(meshes_with_coordinates_out_of_range_are_refused) {
  constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {infinite, -infinite, none, 0x1.8p1000})
    for (const std::size_t which : {0, 5}) { // what is dragged, and another
      meshes::Triangle_list list = meshes::tetrahedron();
      list += meshes::tetrahedron().scale_and_move(1, 5, 0, 0);
      Mesh mesh = meshes::to_mesh(list);
      mesh.point(Vertex_index(which)) = {0, x, 0};
      const auto names_it = [&](const Out_of_range& error) {
        return std::string(error.what()).find("vertex " + std::to_string(which) + " at") != std::string::npos;
      };
      BOOST_CHECK_EXCEPTION(first_impacts(mesh, Vertex_index(0), Point_3(0, 0, 1)), Out_of_range, names_it);
      BOOST_CHECK_EXCEPTION(first_impact(mesh, Vertex_index(0), Point_3(0, 0, 1)), Out_of_range, names_it);
    }
}

BOOST_AUTO_TEST_CASE(broad_phases_miss_nothing) {
  check_queries<Brute_force_broad_phase<Mesh>>(1);
  check_queries<Six_list_broad_phase<Mesh>>(2);
  check_queries<Box_tree_broad_phase<Mesh>>(3);
}

BOOST_AUTO_TEST_CASE(results_do_not_depend_on_the_broad_phase) {
  meshes::Triangle_list list = meshes::bumpy_sphere(2, 0.3);
  list += meshes::bumpy_sphere(1, 0.1).scale_and_move(0.5, 2, 0, 0);
  const Mesh mesh = meshes::to_mesh(list);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto tree = positions_after<Box_tree_broad_phase<Mesh>>(mesh, seed, 100);
    BOOST_TEST((tree == positions_after<Six_list_broad_phase<Mesh>>(mesh, seed, 100)));
    BOOST_TEST((tree == positions_after<Brute_force_broad_phase<Mesh>>(mesh, seed, 100)));
  }
}

// Whole numbers of the least subnormal number: scaled by 2^1074 every answer has to be the same. Stars of more than 14
// faces have more than one run of planes, the later ones of a motion that the first has shortened.
BOOST_AUTO_TEST_CASE(first_impacts_in_the_least_unit_are_those_of_usual_ones) {
  std::size_t asked = 0, met = 0;
  for (std::uint64_t seed = 90; seed < 106; ++seed) { // 98: the first pair was left out
    std::mt19937_64 random(seed);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    meshes::Triangle_list list = meshes::bipyramid(20 + random() % 8, .3);
    for (int k = 0; k < 5; ++k) {
      const double z = uniform(.45, .9), y = uniform(-.8, .8), x = uniform(-.8, .8);
      list += meshes::tetrahedron().scale_and_move(.15, x, y, z);
    }
    const auto size = static_cast<double>(40 + random() % 60);
    const auto in_unit = [&](double unit) {
      meshes::Triangle_list scaled = list;
      scaled.transform([=](const auto& p) {
        return Point_3(std::nearbyint(p.x() * size) * unit, std::nearbyint(p.y() * size) * unit,
                       std::nearbyint(p.z() * size) * unit);
      });
      return meshes::to_mesh<Mesh>(scaled);
    };
    const Mesh usual = in_unit(1), least = in_unit(0x1p-1074);
    if (!validate(usual).is_valid())
      continue;
    BOOST_TEST(validate(least).is_valid());
    Vertex_index apex;
    for (const Vertex_index v : usual.vertices())
      if (usual.degree(v) > 14 && usual.point(v).z() > 0)
        apex = v;
    for (int k = 0; k < 40; ++k) {
      const double x = std::nearbyint(size * uniform(-1, 1)), y = std::nearbyint(size * uniform(-1, 1)),
                   z = std::nearbyint(size * uniform(.2, 1.5));
      const auto a = first_impact(usual, apex, Point_3(x, y, z)),
                 b = first_impact(least, apex, Point_3(x * 0x1p-1074, y * 0x1p-1074, z * 0x1p-1074));
      ++asked;
      BOOST_REQUIRE(a.has_value() == b.has_value());
      if (a) {
        ++met;
        BOOST_TEST((a->feature() == b->feature() && a->vertices() == b->vertices()), "seed " << seed << ", " << k);
      }
    }
  }
  BOOST_TEST(asked > 300u);
  BOOST_TEST(met > 50u);
}
