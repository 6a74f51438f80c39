// SPDX-License-Identifier: GPL-3.0-or-later
// Broad phases against brute force and exact sweeps, while the mesh moves, grows and shrinks.
#include "../examples/count_allocations.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/collision.h>
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/star.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <boost/test/unit_test.hpp>

#include <gmpxx.h>

#include <cfenv>
#include <iostream>

using namespace haptic_sculpt;

namespace {

using Mesh = meshes::Mesh;
using Kernel = meshes::Kernel;
using Point_3 = meshes::Point_3;
using Vertex_index = Mesh::Vertex_index;
using Face_index = Mesh::Face_index;
using Halfedge_index = Mesh::Halfedge_index;
using Random = std::mt19937_64;
using Coordinates = std::array<double, 3>;

std::uint64_t seed() {
  const char* text = std::getenv("HAPTIC_SCULPT_SEED");
  const std::uint64_t value = text != nullptr ? std::strtoull(text, nullptr, 10) : 20260101;
  std::cout << "seed " << value << '\n';
  return value;
}

double uniform(Random& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

/// Where a scene lies: x -> offset + scale * x.
struct Frame {
  double scale, offset;
  Coordinates operator()(const Coordinates& p) const {
    return {offset + scale * p[0], offset + scale * p[1], offset + scale * p[2]};
  }
};

/// A point of a coarse grid, or anywhere, in [-size, size]^3.
Coordinates random_point(Random& random, double size) {
  Coordinates p;
  const bool on_grid = random() % 2 == 0;
  for (double& x : p)
    x = on_grid ? size / 4 * (static_cast<double>(random() % 9) - 4) : size * uniform(random);
  return p;
}

std::vector<Face_index> sorted(std::vector<Face_index> faces) {
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Exactly whether the tetrahedron stgi, degenerate or not, meets the triangle: a corner of what they share is a corner
/// of the triangle in the tetrahedron, or lies on an edge of one and a face of the other. Where the sweeps do not take
/// a degenerate feature, others see what it meets; only a triangle that is a point on a tetrahedron with g == i is
/// overlooked.
bool do_meet(const Coordinates& s, const Coordinates& t, const Coordinates& g, const Coordinates& i,
             const std::array<Coordinates, 3>& triangle) {
  const Swept_collision_traits_3<Kernel> traits;
  const auto vertex_face = traits.vertex_face_sweep_3_object();
  const auto edge_edge = traits.edge_edge_sweep_3_object();
  const auto face_vertex = traits.face_vertex_sweep_3_object();
  const auto point = [](const Coordinates& p) { return Point_3(p[0], p[1], p[2]); };
  const std::array<Point_3, 3> a = {point(triangle[0]), point(triangle[1]), point(triangle[2])};
  const std::array<Point_3, 4> tet = {point(s), point(t), point(g), point(i)};
  const bool is_flat = CGAL::collinear(a[0], a[1], a[2]);
  for (int k = 0; k < 3; ++k)
    if (tet[2] != tet[3] && face_vertex.do_collide(tet[0], tet[1], tet[2], tet[3], a[k]))
      return true;
  for (int j = 0; j < 4; ++j)
    for (int k = j + 1; k < 4; ++k)
      if (!is_flat && vertex_face.do_collide(tet[j], tet[k], a[0], a[1], a[2]))
        return true;
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 3; ++k)
      if (a[k] != a[(k + 1) % 3] &&
          edge_edge.do_collide(tet[(j + 1) % 4], tet[(j + 2) % 4], tet[(j + 3) % 4], a[k], a[(k + 1) % 3]))
        return true;
  return false;
}

std::array<Coordinates, 3> corners(const Mesh& mesh, Face_index f) {
  const auto h = mesh.halfedge(f);
  return {vertex_coordinates(mesh, mesh.source(h)), vertex_coordinates(mesh, mesh.target(h)),
          vertex_coordinates(mesh, mesh.target(mesh.next(h)))};
}

/// The faces that the star sweeps over, exactly; only those whose box meets the star's can be among them.
std::vector<Face_index> swept_faces(const Mesh& mesh, const Swept_star_3& star) {
  std::vector<Face_index> near, swept;
  Brute_force_broad_phase<Mesh>(mesh).query(star.box(), near);
  for (const Face_index f : near) {
    const auto triangle = corners(mesh, f);
    bool meets = star.valence == 0 && do_meet(star.source, star.target, star.target, star.target, triangle);
    for (std::size_t i = 0; i < star.valence && !meets; ++i)
      meets = do_meet(star.source, star.target, star.link[i], star.link[(i + 1) % star.valence], triangle);
    if (meets)
      swept.push_back(f);
  }
  return swept;
}

/// A mesh that changes, and broad phases that are told.
struct Changing_mesh {
  Mesh mesh;
  Frame frame;
  Brute_force_broad_phase<Mesh> brute_force{mesh};
  Six_list_broad_phase<Mesh> six_lists{mesh};
  Box_tree_broad_phase<Mesh> tree{mesh};
  std::size_t inserted = 0, removed = 0, parts = 0, given_up = 0;

  Changing_mesh(const Mesh& m, const Frame& f) : mesh(m), frame(f) {
    for (const Vertex_index v : mesh.vertices())
      set_point(v, vertex_coordinates(mesh, v));
    std::vector<Face_index> all(mesh.faces().begin(), mesh.faces().end());
    moved(all);
  }

  void set_point(Vertex_index v, const Coordinates& p) {
    const Coordinates q = frame(p);
    mesh.point(v) = Point_3(q[0], q[1], q[2]);
  }
  template <class Faces>
  void moved(const Faces& faces) {
    six_lists.faces_moved(faces), tree.faces_moved(faces);
  }
  template <class Faces>
  void came(const Faces& faces) {
    six_lists.faces_inserted(faces), tree.faces_inserted(faces);
    inserted += faces.size();
  }
  template <class Faces>
  void went(const Faces& faces) {
    six_lists.faces_removed(faces), tree.faces_removed(faces);
    removed += faces.size();
  }

  std::vector<Face_index> faces_around(Vertex_index v) const {
    std::vector<Face_index> faces;
    if (!mesh.is_isolated(v))
      for (const Face_index f : mesh.faces_around_target(mesh.halfedge(v)))
        if (f != Mesh::null_face())
          faces.push_back(f);
    return faces;
  }
  Vertex_index random_vertex(Random& random) const {
    for (;;) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
      if (!mesh.is_removed(v))
        return v;
    }
  }

  void move_a_vertex(Random& random) {
    const Vertex_index v = random_vertex(random);
    if (random() % 4 == 0) // onto another: degenerate faces, flat boxes
      mesh.point(v) = mesh.point(random_vertex(random));
    else
      set_point(v, random_point(random, 1.5));
    moved(faces_around(v));
  }
  void insert_a_vertex(Random& random) {
    const Vertex_index v = random_vertex(random);
    const Face_index f = mesh.face(mesh.halfedge(v));
    const std::array<Coordinates, 3> c = corners(mesh, f);
    const Halfedge_index h = CGAL::Euler::add_center_vertex(mesh.halfedge(f), mesh);
    mesh.point(mesh.target(h)) = Point_3(c[0][0] / 2 + c[1][0] / 2, c[1][1], c[2][2]);
    std::vector<Face_index> fresh = faces_around(mesh.target(h));
    fresh.erase(std::find(fresh.begin(), fresh.end(), f));
    moved(std::vector<Face_index>{f});
    came(fresh);
  }
  void collapse_an_edge(Random& random, bool told_before) {
    const Vertex_index v = random_vertex(random);
    const auto h = mesh.halfedge(v);
    const auto e = mesh.edge(h);
    if (mesh.number_of_faces() <= 8 || !CGAL::Euler::does_satisfy_link_condition(e, mesh))
      return;
    const std::vector<Face_index> gone = {mesh.face(h), mesh.face(mesh.opposite(h))};
    if (told_before)
      went(gone);
    const Vertex_index kept = CGAL::Euler::collapse_edge(e, mesh);
    if (!told_before)
      went(gone);
    moved(faces_around(kept));
  }
  void change(Random& random, unsigned growth) {
    const unsigned dice = random() % 8;
    if (dice < 3)
      move_a_vertex(random);
    else if (dice < 3 + growth)
      insert_a_vertex(random);
    else
      collapse_an_edge(random, random() % 2 == 0);
  }

  /// Asks all models, and the ones built anew, the same.
  void check_box(const Box_3& box) {
    std::vector<Face_index> expected, lists, leaves, rounded;
    brute_force.query(box, expected);
    six_lists.query(box, lists);
    tree.query(box, leaves);
    // Of the tree it is known exactly what it should say: which of the rounded boxes meet.
    const internal::Float_box around = internal::Float_box::query(box);
    for (const Face_index f : mesh.faces()) {
      internal::Box_node node;
      node.set(0, internal::Float_box(face_box(mesh, f)));
      if (node.meeting(around) == 1)
        rounded.push_back(f);
    }
    BOOST_TEST((sorted(lists) == sorted(expected)));
    BOOST_TEST((sorted(leaves) == rounded));
    BOOST_TEST(std::includes(rounded.begin(), rounded.end(), expected.begin(), expected.end()));
  }
  template <class Model>
  void check_star(Model& model, const Swept_star_3& star, const std::vector<Face_index>& swept) {
    std::vector<Face_index> found;
    model.query(star, found);
    found = sorted(found);
    BOOST_TEST((std::adjacent_find(found.begin(), found.end()) == found.end()));
    for (const Face_index f : found)
      BOOST_TEST((static_cast<std::size_t>(f) < mesh.num_faces() && !mesh.is_removed(f)));
    BOOST_TEST(std::includes(found.begin(), found.end(), swept.begin(), swept.end()));
  }
  void check_star(const Swept_star_3& star) {
    const std::vector<Face_index> swept = swept_faces(mesh, star);
    check_star(brute_force, star, swept);
    check_star(six_lists, star, swept);
    check_star(tree, star, swept);
    check_giving_up(star);
  }
  /// An answer that is said to be whole is; and one that is small enough, is.
  void check_giving_up(const Swept_star_3& star) {
    std::vector<Face_index> all, found;
    tree.query(star, all);
    for (const std::size_t most : {std::size_t(0), all.size() / 2, all.size(), 8 * all.size() + 1}) {
      found.clear();
      const bool is_whole = tree.query(star, found, most);
      BOOST_TEST((!is_whole || (all.size() <= most && sorted(found) == sorted(all))));
      BOOST_TEST((is_whole || most <= all.size() || found.empty())); // else there were many nodes to read
      given_up += !is_whole && most < all.size();
    }
  }
  /// A part of a way, where its end is a point: swept up to there, asked as the beginning of a longer way.
  void check_part(Swept_star_3 star, int halvings) {
    const Swept_star_3 part = star;
    star.until = std::ldexp(1.0, -halvings);
    for (int i = 0; i < 3; ++i) {
      star.target[i] = star.source[i] + std::ldexp(part.target[i] - star.source[i], halvings);
      if (!std::isfinite(star.target[i]))
        return;
      const mpq_class way = mpq_class(part.target[i]) - mpq_class(star.source[i]);
      if (mpq_class(star.target[i]) != mpq_class(star.source[i]) + way * (1 << halvings))
        return;
    }
    ++parts;
    const std::vector<Face_index> swept = swept_faces(mesh, part);
    check_star(brute_force, star, swept);
    check_star(six_lists, star, swept);
    check_star(tree, star, swept);
  }
  /// The centre anywhere in a box: some ways in it.
  void check_anywhere(Swept_star_3 star, Random& random) {
    const Box_3 path = Box_3(star.source).include(star.target);
    Swept_star_3 anywhere = star;
    anywhere.is_box = true;
    for (int k = 0; k < 2; ++k) {
      for (Coordinates* p : {&star.source, &star.target})
        for (int i = 0; i < 3; ++i) {
          const double share = random() % 3 == 0 ? 0 : random() % 3 == 0 ? 1 : 0.5 * uniform(random) + 0.5;
          (*p)[i] = std::fmin(path.upper[i], std::fmax(path.lower[i], (1 - share) * path.lower[i] + share * path.upper[i]));
        }
      const std::vector<Face_index> swept = swept_faces(mesh, star);
      check_star(brute_force, anywhere, swept);
      check_star(six_lists, anywhere, swept);
      check_star(tree, anywhere, swept);
    }
  }
  void check(Random& random) {
    const Coordinates a = frame(random_point(random, 1.5)), b = frame(random_point(random, 1.5));
    Box_3 box(a);
    if (random() % 3 != 0) { // else a point
      Coordinates other = b;
      if (random() % 3 == 0) // a flat box
        other[random() % 3] = a[0], other[0] = a[0];
      box.include(other);
    }
    check_box(box);
    check_box(face_box(mesh, mesh.face(mesh.halfedge(random_vertex(random))))); // touches its neighbours' boxes
    internal::Star<Mesh> star;
    const Vertex_index v = random_vertex(random);
    star.collect(mesh, v);
    const Coordinates s = vertex_coordinates(mesh, v);
    Coordinates t = random() % 4 == 0 ? s : frame(random_point(random, 4));
    if (random() % 3 == 0)
      t[random() % 3] = s[0];
    check_star(star.swept(s, t));
    check_star(star.swept(s, vertex_coordinates(mesh, random_vertex(random))));
    check_part(star.swept(s, t), 1 + static_cast<int>(random() % 8));
    // A long edge far sideways: what it sweeps is a sheet.
    const Coordinates tip = frame(random_point(random, 4));
    check_star(star.swept(tip, t));
    check_part(star.swept(tip, t), 1 + static_cast<int>(random() % 8));
    check_star(star.swept(tip, star.link_points[random() % star.valence()])); // a spike that is drawn in
    for (int i = 0; i < 3; ++i)
      t[i] = tip[i] + (t[i] - tip[i]) / 16;
    check_anywhere(star.swept(tip, t), random);
    star.clear();
    check_star(star.swept(a, b));
  }
  void check_everything() {
    const double infinity = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
    check_box(Box_3());
    for (const double end : {infinity, largest, static_cast<double>(std::numeric_limits<float>::max())})
      check_box(Box_3({-end, -end, -end}).include({end, end, end}));
    check_box(Box_3({infinity, infinity, infinity}));
    check_box(Box_3({0, 0, 0}));
  }
};

const std::vector<Frame> frames = {{1, 0},      {1, 1e6},  {1e-3, 1e9},    {1e-7, 1},  {1e-42, 0},
                                   {1e-310, 0}, {3e38, 0}, {5e37, 2.5e38}, {1e150, 0}, {1e300, 0}};

std::vector<Mesh> scenes() {
  return {meshes::to_mesh(meshes::icosphere(1)), meshes::to_mesh(meshes::box(3)), meshes::to_mesh(meshes::torus(9, 6)),
          meshes::to_mesh(meshes::tetrahedron())};
}

} // namespace

BOOST_AUTO_TEST_CASE(rounding_is_outward_and_tight_in_every_mode) {
  Random random(seed());
  std::vector<double> values = {0.0,   -0.0,   1e-320, -1e-320, 1e-46, -1e-46,    1e39,
                                -1e39, 3.5e38, 1e308,  0.1,     -0.1,  16777217.0};
  for (const float f : {1.f, 1e-45f, 1e-38f, std::numeric_limits<float>::max(), std::numeric_limits<float>::min()})
    for (const double x : {double(f), std::nextafter(double(f), 0.0), std::nextafter(double(f), 1e300)})
      values.push_back(x), values.push_back(-x);
  for (int k = 0; k < 20000; ++k)
    values.push_back(std::ldexp(uniform(random), static_cast<int>(random() % 700) - 350));
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    std::size_t wrong = 0;
    for (const double x : values) {
      const float below = internal::float_below(x), above = internal::float_above(x);
      wrong += !(double(below) <= x && double(above) >= x);
      // At most one float away on each side.
      wrong += !(double(std::nextafterf(below, std::numeric_limits<float>::infinity())) >= x);
      wrong += !(double(std::nextafterf(above, -std::numeric_limits<float>::infinity())) <= x);
    }
    std::fesetround(FE_TONEAREST);
    BOOST_TEST(wrong == 0u);
  }
}

BOOST_AUTO_TEST_CASE(queries_answer_as_brute_force_does_while_the_mesh_changes) {
  Random random(seed());
  std::size_t inserted = 0, removed = 0, parts = 0, given_up = 0;
  for (const Mesh& scene : scenes())
    for (const Frame& frame : frames) {
      Changing_mesh changing(scene, frame);
      changing.check_everything();
      for (int round = 0; round < 60; ++round) {
        const unsigned growth = round < 30 ? 4 : 1; // grows far beyond what it was built for, then shrinks
        for (int k = 0; k < 4; ++k)
          changing.change(random, growth);
        changing.check(random);
      }
      changing.check_everything();
      parts += changing.parts;
      given_up += changing.given_up;
      inserted += changing.inserted;
      removed += changing.removed;
      Changing_mesh anew(changing.mesh, {1, 0}); // with garbage among its faces
      anew.check_everything();
      anew.check(random);
      BOOST_TEST(anew.mesh.has_garbage());
    }
  BOOST_TEST(inserted > 1000u);
  BOOST_TEST(parts > 100u);
  BOOST_TEST(given_up > 1000u);
  BOOST_TEST(removed > 1000u);
}

BOOST_AUTO_TEST_CASE(rounding_modes_lose_nothing) {
  Random random(seed());
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    for (const Frame& frame : {frames[0], frames[1], frames[3]}) {
      Changing_mesh changing(scenes()[1], frame);
      for (int k = 0; k < 30; ++k) {
        changing.change(random, 3);
        internal::Star<Mesh> star;
        const Vertex_index v = changing.random_vertex(random);
        star.collect(changing.mesh, v);
        const Swept_star_3 swept = star.swept(vertex_coordinates(changing.mesh, v), frame(random_point(random, 6)));
        const std::vector<Face_index> expected = swept_faces(changing.mesh, swept);
        std::vector<Face_index> found;
        std::fesetround(mode);
        Box_tree_broad_phase<Mesh> tree(changing.mesh);
        tree.query(swept, found);
        changing.tree.query(swept, found);
        std::fesetround(FE_TONEAREST);
        found = sorted(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        BOOST_TEST(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
      }
    }
}

BOOST_AUTO_TEST_CASE(a_mesh_may_come_from_nothing_and_go) {
  Mesh mesh;
  Six_list_broad_phase<Mesh> six_lists(mesh);
  Box_tree_broad_phase<Mesh> tree(mesh);
  const Box_3 everything = Box_3({-9, -9, -9}).include({9, 9, 9});
  std::vector<Vertex_index> corner;
  for (const auto& p : meshes::box(4).points)
    corner.push_back(mesh.add_vertex(p));
  const auto count = [&](auto& model) {
    std::vector<Face_index> found;
    model.query(everything, found);
    return found.size();
  };
  for (int again = 0; again < 3; ++again) {
    BOOST_TEST(count(six_lists) == 0u);
    BOOST_TEST(count(tree) == 0u);
    std::size_t expected = 0;
    for (const auto& f : meshes::box(4).faces) {
      const std::array<Face_index, 1> face = {mesh.add_face(corner[f[0]], corner[f[1]], corner[f[2]])};
      six_lists.faces_inserted(face), tree.faces_inserted(face);
      ++expected;
      BOOST_TEST(count(six_lists) == expected);
      BOOST_TEST(count(tree) == expected);
    }
    while (mesh.number_of_faces() != 0) {
      const std::array<Face_index, 1> face = {*mesh.faces().begin()};
      six_lists.faces_removed(face), tree.faces_removed(face);
      CGAL::Euler::remove_face(mesh.halfedge(face[0]), mesh);
      BOOST_TEST(count(tree) == --expected);
    }
    mesh = Mesh(); // remove_face() has taken the vertices too
    corner.clear();
    for (const auto& p : meshes::box(4).points)
      corner.push_back(mesh.add_vertex(p));
  }
}

namespace {

/// How many faces the tree names of those in the boxes around swept stars of a torus, over 50 of them.
/// \param swept_of(mesh, v, star, random) makes one, `star` being that of v
template <class Swept_of>
double share_of_boxes(const Swept_of& swept_of) {
  const Mesh mesh = meshes::to_mesh(meshes::torus(400, 200));
  Random random(seed());
  Brute_force_broad_phase<Mesh> brute_force(mesh);
  Box_tree_broad_phase<Mesh> tree(mesh);
  std::vector<Face_index> in_box, found; // of all, one after the other
  internal::Star<Mesh> star;
  for (int k = 0; k < 50; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    star.collect(mesh, v);
    const Swept_star_3 swept = swept_of(mesh, v, star, random);
    brute_force.query(swept, in_box);
    tree.query(swept, found);
  }
  return static_cast<double>(found.size()) / static_cast<double>(in_box.size());
}

Coordinates near_by(Coordinates p, Random& random) {
  for (double& x : p)
    x += uniform(random);
  return p;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_long_push_asks_for_few_faces) {
  BOOST_TEST(share_of_boxes([](const Mesh& mesh, Vertex_index v, const internal::Star<Mesh>& star, Random& random) {
               const Coordinates source = vertex_coordinates(mesh, v);
               return star.swept(source, near_by(source, random));
             }) < 0.05);
}

BOOST_AUTO_TEST_CASE(a_spike_that_is_drawn_in_asks_for_few_faces) {
  BOOST_TEST(share_of_boxes([](const Mesh&, Vertex_index, const internal::Star<Mesh>& star, Random& random) {
               const Coordinates tip = near_by(star.link_points[0], random);
               return star.swept(tip, star.link_points[random() % star.valence()]);
             }) < 0.05);
}

BOOST_AUTO_TEST_CASE(fetching_ahead_changes_no_answer) {
  Mesh mesh = meshes::to_mesh(meshes::torus(320, 160)); // smaller trees are taken to be in cache
  Random random(seed());
  Box_tree_broad_phase<Mesh> tree(mesh), asked_ahead(mesh);
  std::vector<Face_index> expected, found;
  const auto random_box = [&] {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    Box_3 box(vertex_coordinates(mesh, v));
    const double size = std::ldexp(1.0, -static_cast<int>(random() % 12)); // of few faces, or of nearly all
    for (int i = 0; i < 3; ++i)
      box.lower[i] -= size * std::abs(uniform(random)), box.upper[i] += size * std::abs(uniform(random));
    return box;
  };
  for (int k = 0; k < 300; ++k) {
    const Box_3 box = random_box();
    if (random() % 4 != 0)
      asked_ahead.fetch_ahead(random() % 2 == 0 ? box : random_box());
    for (std::size_t steps = random() % 6; steps != 0; --steps) {
      if (random() % 4 == 0) { // what was fetched may have changed
        const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
        const Point_3 p = mesh.point(v);
        mesh.point(v) = Point_3(p.x() + 0.1 * uniform(random), p.y(), p.z());
        const auto around = mesh.faces_around_target(mesh.halfedge(v));
        const std::vector<Face_index> faces(around.begin(), around.end());
        tree.faces_moved(faces);
        asked_ahead.faces_moved(faces);
      }
      asked_ahead.fetch_on();
    }
    expected.clear(), found.clear();
    tree.query(box, expected);
    asked_ahead.query(box, found);
    BOOST_REQUIRE(!expected.empty());
    BOOST_REQUIRE(sorted(found) == sorted(expected));
  }
}

BOOST_AUTO_TEST_CASE(neither_queries_nor_moves_allocate) {
  Mesh mesh = meshes::to_mesh(meshes::torus(60, 30));
  Random random(seed());
  Box_tree_broad_phase<Mesh> tree(mesh);
  for (int k = 0; k < 100; ++k) { // so that there is an overflow too
    const Face_index f(static_cast<Mesh::size_type>(random() % mesh.num_faces()));
    const Halfedge_index h = CGAL::Euler::add_center_vertex(mesh.halfedge(f), mesh);
    mesh.point(mesh.target(h)) = mesh.point(mesh.source(h));
    std::vector<Face_index> around(mesh.faces_around_target(h).begin(), mesh.faces_around_target(h).end());
    tree.faces_inserted(around);
  }
  std::vector<Face_index> found;
  internal::Star<Mesh> star;
  std::size_t before = 0;
  for (int round = 0; round < 2; ++round) { // the same twice: the first warms up
    Random script(17);
    before = allocations_so_far;
    for (int k = 0; k < 500; ++k) {
      const Vertex_index v(static_cast<Mesh::size_type>(script() % mesh.num_vertices()));
      star.collect(mesh, v);
      const Coordinates s = vertex_coordinates(mesh, v), t = random_point(script, 2);
      found.clear();
      tree.query(star.swept(s, t), found);
      tree.query(star.swept(s, s).box(), found);
      mesh.point(v) = Point_3(t[0], t[1], t[2]);
      tree.faces_moved(star.faces);
      mesh.point(v) = Point_3(s[0], s[1], s[2]);
      tree.faces_moved(star.faces);
    }
  }
  BOOST_TEST(allocations_so_far == before);
  BOOST_TEST(before > 0u);
}

BOOST_AUTO_TEST_CASE(memory_of_the_tree_is_as_promised) {
  const Mesh mesh = meshes::to_mesh(meshes::torus(300, 170));
  const double bytes = static_cast<double>(Box_tree_broad_phase<Mesh>(mesh).memory()) / mesh.number_of_faces();
  BOOST_TEST_MESSAGE("bytes per triangle: " << bytes);
  BOOST_TEST(bytes <= 36.0);
}

namespace {

/// What a script of drags does, to the last bit.
template <template <class> class Model>
std::vector<double> trace_of(Mesh mesh, std::uint64_t seed_of_script) {
  Random random(seed_of_script);
  std::vector<double> trace;
  Sculptor<Mesh, Model<Mesh>> sculptor(mesh);
  for (int k = 0; k < 120; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    auto grab = sculptor.grab(v);
    for (int step = 0; step < 4; ++step) {
      const Coordinates p = vertex_coordinates(mesh, v), d = random_point(random, random() % 3 == 0 ? 3 : 0.2);
      const auto result =
          random() % 8 == 0
              ? grab.drag_to(mesh.point(Vertex_index(static_cast<Mesh::size_type>(random() % mesh.num_vertices()))))
              : grab.drag_to(Point_3(p[0] + d[0], p[1] + d[1], p[2] + d[2]));
      trace.insert(trace.end(), {result.position.x(), result.position.y(), result.position.z(), result.stop_error,
                                 result.stop_error_along_path, result.kkt_residual, double(result.legs),
                                 double(static_cast<int>(result.end)), double(result.contacts.size())});
      for (const auto& contact : result.contacts) {
        trace.insert(trace.end(), contact.normal.cartesian_begin(), contact.normal.cartesian_end());
        trace.push_back(static_cast<int>(contact.kind));
        for (const Vertex_index w : contact.vertices)
          trace.push_back(static_cast<double>(static_cast<std::uint32_t>(w)));
      }
    }
  }
  for (const Vertex_index v : mesh.vertices())
    for (const double x : vertex_coordinates(mesh, v))
      trace.push_back(x);
  return trace;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

} // namespace

BOOST_AUTO_TEST_CASE(no_result_of_a_sculptor_depends_on_the_broad_phase) {
  const std::uint64_t first = seed();
  std::size_t script = 0;
  for (const Mesh& scene : {meshes::to_mesh(meshes::icosphere(2)), meshes::to_mesh(meshes::box(4)),
                            meshes::to_mesh(meshes::torus(16, 9)), meshes::to_mesh(meshes::row_of_spheres(3))}) {
    const std::vector<double> expected = trace_of<Brute_force_broad_phase>(scene, first + script);
    BOOST_TEST(same_bits(trace_of<Six_list_broad_phase>(scene, first + script), expected));
    BOOST_TEST(same_bits(trace_of<Box_tree_broad_phase>(scene, first + script), expected));
    ++script;
  }
}
