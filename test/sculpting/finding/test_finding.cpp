// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest vertices and first hits against brute force in exact arithmetic, and the broad phases against each other.
#include "sculpting/Random_scene.h"

#include "oracle/sweep_oracle.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>

#include <boost/test/unit_test.hpp>

#include <map>
#include <set>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Face_index = Mesh::Face_index;

/// Whole grid points; their halves, which are middles of edges; and vertices.
Point_3 random_place(Random& random, const meshes::Triangle_list& list, int size) {
  const auto vertex = [&] { return list.points[random() % list.points.size()]; };
  switch (random() % 4) {
  case 0:
    return vertex();
  case 1:
    return CGAL::midpoint(vertex(), vertex());
  case 2:
    return random_grid_point(random, 2 * size);
  default:
    return CGAL::midpoint(random_grid_point(random, 2 * size), random_grid_point(random, 2 * size));
  }
}

mpq_class exact_square(const Point_3& p, const Point_3& q) {
  mpq_class sum = 0;
  for (int i = 0; i < 3; ++i) {
    const mpq_class d = mpq_class(p[i]) - mpq_class(q[i]);
    sum += d * d;
  }
  return sum;
}

Vertex_index nearest_by_brute_force(const Mesh& mesh, const Point_3& p, double within) {
  Vertex_index best;
  std::optional<mpq_class> least;
  if (std::isfinite(within))
    least = mpq_class(within) * mpq_class(within);
  for (const Vertex_index v : mesh.vertices()) {
    const mpq_class square = exact_square(p, mesh.point(v));
    if (least && (best.is_valid() ? square >= *least : square > *least))
      continue;
    best = v;
    least = square;
  }
  return best;
}

struct Expected_hit {
  mpq_class time;
  std::set<Vertex_index> feature; ///< one vertex, two or three
  Face_index face;
};

/// All faces, by linear feasibility over the integers: the weights of the first common point say what it lies on.
std::optional<Expected_hit> first_hit_by_brute_force(const Mesh& mesh, const Point_3& s, const Point_3& t) {
  std::optional<Expected_hit> first;
  for (const Face_index f : mesh.faces()) {
    const auto corners = internal::corners_of_face(mesh, f);
    Sweep_coordinates x;
    int k = 0;
    for (const Point_3& p : {s, t, mesh.point(corners[0]), mesh.point(corners[1]), mesh.point(corners[2])})
      for (int i = 0; i < 3; ++i)
        x[k++] = p[i];
    const auto meeting = first_meeting(Sweep_kind::vertex_face, x);
    if (!meeting || (first && meeting->time >= first->time))
      continue;
    first = Expected_hit{meeting->time, {}, f};
    for (int i = 0; i < 3; ++i)
      if (meeting->has_weight[2 + i])
        first->feature.insert(corners[i]);
  }
  return first;
}

std::set<Vertex_index> vertices_of(const Mesh& mesh, const Surface_hit<Mesh>& hit) {
  if (hit.feature == Surface_feature::vertex)
    return {hit.vertex};
  if (hit.feature == Surface_feature::edge)
    return {mesh.vertex(hit.edge, 0), mesh.vertex(hit.edge, 1)};
  const auto corners = internal::corners_of_face(mesh, hit.face);
  return {corners.begin(), corners.end()};
}

bool is_sound(const Mesh& mesh, const Surface_hit<Mesh>& hit) {
  const auto corners = internal::corners_of_face(mesh, hit.face);
  for (const Vertex_index v : vertices_of(mesh, hit))
    if (std::find(corners.begin(), corners.end(), v) == corners.end())
      return false;
  return hit.vertex.is_valid() == (hit.feature == Surface_feature::vertex) &&
         hit.edge.is_valid() == (hit.feature == Surface_feature::edge);
}

/// A power of two by which a grid is scaled: nothing changes in exact arithmetic, much in rounded.
double random_scale(Random& random) {
  constexpr double scales[] = {1, 1, 0x1p-1060, 0x1p-500, 0x1p-20, 0x1p+600, 0x1p+990};
  return scales[random() % 7];
}

template <class Broad_phase>
struct Scene {
  Mesh mesh;
  Sculptor<Mesh, Broad_phase> sculptor;
  explicit Scene(const Mesh& m) : mesh(m), sculptor(mesh) {}
};

} // namespace

BOOST_AUTO_TEST_CASE(finding_agrees_with_brute_force_over_rationals) {
  const std::size_t scenes = count_from_environment("HAPTIC_SCULPT_FINDINGS", 300);
  Random random(seed_from_environment(16));
  std::size_t wrong_vertices = 0, wrong_hits = 0, wrong_fallbacks = 0, found = 0, ties = 0, none = 0, points = 0;
  std::map<std::size_t, std::size_t> hits; // by dimension
  for (std::size_t k = 0; k < scenes; ++k) {
    const int size = 1 + static_cast<int>(random() % 3);
    const double scale = random_scale(random);
    meshes::Triangle_list list = random_small_list(random, size);
    const auto scaled = [scale](const Point_3& p) { return Point_3(p.x() * scale, p.y() * scale, p.z() * scale); };
    meshes::Triangle_list large = list;
    for (Point_3& p : large.points)
      p = scaled(p);
    const Mesh mesh = meshes::to_mesh(large);
    Scene<Box_tree_broad_phase<Mesh>> tree(mesh);
    Scene<Six_list_broad_phase<Mesh>> lists(mesh);
    Scene<Brute_force_broad_phase<Mesh>> all(mesh);
    for (int i = 0; i < 20; ++i) {
      const Point_3 s = random_place(random, list, size), t = random() % 6 == 0 ? s : random_place(random, list, size);
      // Distances of grid points are met exactly.
      const double within =
          random() % 4 == 0 ? std::numeric_limits<double>::infinity() : static_cast<double>(random() % 9) / 2 * scale;
      const Vertex_index nearest = tree.sculptor.nearest_vertex(scaled(s), within);
      wrong_vertices += nearest != nearest_by_brute_force(mesh, scaled(s), within);
      found += nearest.is_valid();
      for (const Vertex_index v : mesh.vertices())
        if (nearest.is_valid() && v != nearest &&
            exact_square(scaled(s), mesh.point(v)) == exact_square(scaled(s), mesh.point(nearest))) {
          ++ties;
          break;
        }
      const auto hit = tree.sculptor.first_hit(scaled(s), scaled(t));
      const auto expected = first_hit_by_brute_force(mesh, scaled(s), scaled(t));
      if (!hit || !expected) {
        wrong_hits += hit.has_value() != expected.has_value();
        ++none;
      } else {
        wrong_hits += !is_sound(mesh, *hit) || vertices_of(mesh, *hit) != expected->feature ||
                      hit->face != expected->face || std::abs(hit->time - expected->time.get_d()) > 0x1p-40;
        ++hits[expected->feature.size()];
        points += s == t;
      }
      for (const auto& other :
           {lists.sculptor.first_hit(scaled(s), scaled(t)), all.sculptor.first_hit(scaled(s), scaled(t))})
        wrong_fallbacks +=
            other.has_value() != hit.has_value() ||
            (hit && (other->face != hit->face || other->vertex != hit->vertex || other->edge != hit->edge ||
                     other->time != hit->time || other->point != hit->point));
      wrong_fallbacks += lists.sculptor.nearest_vertex(scaled(s), within) != nearest;
      wrong_fallbacks += all.sculptor.nearest_vertex(scaled(s), within) != nearest;
    }
  }
  BOOST_TEST_MESSAGE(scenes << " scenes: " << found << " nearest vertices, " << ties << " of several; hits: " << hits[1]
                            << " vertices, " << hits[2] << " edges, " << hits[3] << " faces, " << points
                            << " of points, " << none << " none");
  BOOST_TEST(wrong_vertices == 0u);
  BOOST_TEST(wrong_hits == 0u);
  BOOST_TEST(wrong_fallbacks == 0u);
  for (const std::size_t count : {found, ties, hits[1], hits[2], hits[3], points, none})
    BOOST_TEST(count > scenes / 2);
}

// On meshes with levels of the tree, also while a vertex is in hand, and after edits that filled its overflow.
BOOST_AUTO_TEST_CASE(finding_does_not_depend_on_the_broad_phase) {
  Random random(seed_from_environment(17));
  const Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(4, 0.3, 0.01));
  Scene<Box_tree_broad_phase<Mesh>> tree(mesh);
  Scene<Brute_force_broad_phase<Mesh>> all(mesh);
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  const auto place = [&] {
    const double x = number(random), y = number(random), z = number(random);
    return Point_3(x, y, z);
  };
  std::size_t different = 0, hits = 0, wrong = 0;
  for (int k = 0; k < 300; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    const Face_index f(static_cast<Mesh::size_type>(random() % mesh.num_faces()));
    auto here = tree.sculptor.grab(v);
    auto there = all.sculptor.grab(v);
    const Point_3 target = CGAL::midpoint(tree.mesh.point(v), place());
    here.drag_to(target), there.drag_to(target);
    if (k % 3 == 0) {
      const auto corners = internal::corners_of_face(tree.mesh, f);
      const Point_3 middle =
          CGAL::centroid(tree.mesh.point(corners[0]), tree.mesh.point(corners[1]), tree.mesh.point(corners[2]));
      tree.sculptor.insert_on_face(f, middle), all.sculptor.insert_on_face(f, middle);
    }
    for (int i = 0; i < 4; ++i) {
      const Point_3 s = place(), t = i == 0 ? tree.mesh.point(v) : i == 1 ? s : place();
      const auto a = tree.sculptor.first_hit(s, t), b = all.sculptor.first_hit(s, t);
      different +=
          a.has_value() != b.has_value() || (a && (a->face != b->face || a->vertex != b->vertex || a->edge != b->edge));
      hits += a.has_value();
      wrong += i == 0 && !a; // it ends on the surface
      const double within = i == 0 ? 0.05 : 10;
      different += tree.sculptor.nearest_vertex(s, within) != all.sculptor.nearest_vertex(s, within);
      wrong += tree.sculptor.nearest_vertex(tree.mesh.point(v), 0) != v;
    }
  }
  BOOST_TEST(different == 0u);
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(hits > 300u);
}

// The way overflows in the scale of the scene, along any axis and either way along it.
BOOST_AUTO_TEST_CASE(a_way_far_beyond_the_scene_meets_what_reaches_as_far) {
  constexpr double unit = 0x1p-45;
  for (int axis = 0; axis < 3; ++axis)
    for (const double far : {1e300, -1e300}) {
      Mesh mesh;
      const auto point = [axis, far](double along, double x, double y) {
        std::array<double, 3> p;
        p[axis] = far < 0 ? -along : along, p[(axis + 1) % 3] = x * unit, p[(axis + 2) % 3] = y * unit;
        return Point_3(p[0], p[1], p[2]);
      };
      const auto add_tetrahedron = [&mesh](std::array<Point_3, 4> p, bool is_mirrored) {
        if (is_mirrored)
          std::swap(p[1], p[2]);
        std::array<Vertex_index, 4> v;
        std::transform(p.begin(), p.end(), v.begin(), [&mesh](const Point_3& q) { return mesh.add_vertex(q); });
        for (const auto& f : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
          mesh.add_face(v[f[0]], v[f[1]], v[f[2]]);
      };
      const double end = std::abs(far);
      add_tetrahedron({point(unit, 0, -1), point(end, 0, -1), point(end, 0, 4), point(unit, 50, 0)}, far < 0);
      for (int k = 20; k < 26; ++k)
        add_tetrahedron({point(5 * k * unit, 5 * k, 5 * k), point((5 * k + 1) * unit, 5 * k, 5 * k),
                         point(5 * k * unit, 5 * k + 1, 5 * k), point(5 * k * unit, 5 * k, 5 * k + 1)}, far < 0);
      Sculptor<Mesh> sculptor(mesh);
      const auto hit = sculptor.first_hit(point(unit, -1, 0), point(end, 1, 0));
      BOOST_TEST((hit && hit->face == Face_index(0) && hit->time == 0.5), "axis " << axis << ", " << far);
    }
}

BOOST_AUTO_TEST_CASE(finding_refuses_what_is_no_place) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  Sculptor<Mesh> sculptor(mesh);
  BOOST_CHECK_THROW(sculptor.nearest_vertex({0, 0, std::nan("")}, 1), Non_finite_point);
  BOOST_CHECK_THROW(sculptor.nearest_vertex({0, 0, 0}, -1), Invalid_parameter);
  BOOST_CHECK_THROW(sculptor.nearest_vertex({0, 0, 0}, std::nan("")), Invalid_parameter);
  BOOST_CHECK_THROW(sculptor.first_hit({0, 0, 0}, {0x1p1001, 0, 0}), Out_of_range);
  BOOST_CHECK_THROW(sculptor.clearance({std::nan(""), 0, 0}), Non_finite_point);
  BOOST_TEST(!sculptor.nearest_vertex({5, 0, 0}, 1).is_valid());
  // The grab at hand goes on.
  auto grab = sculptor.grab(Vertex_index(0));
  const Point_3 p = mesh.point(Vertex_index(0));
  BOOST_TEST(grab.drag_to(p + 0.5 * (p - CGAL::ORIGIN)).reached);
  const auto hit = sculptor.first_hit(CGAL::ORIGIN + 3 * (p - CGAL::ORIGIN), mesh.point(Vertex_index(0)));
  BOOST_REQUIRE(hit.has_value());
  BOOST_TEST((hit->feature == Surface_feature::vertex && hit->vertex == Vertex_index(0)));
  BOOST_TEST(grab.drag_to(p).reached);
  Mesh empty;
  Sculptor<Mesh> nothing(empty);
  BOOST_TEST(!nothing.first_hit({0, 0, 0}, {1, 1, 1}).has_value());
  BOOST_TEST(!nothing.nearest_vertex({0, 0, 0}, 1e300).is_valid());
}
