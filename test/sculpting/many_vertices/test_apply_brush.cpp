// SPDX-License-Identifier: GPL-3.0-or-later
// Brushes: what a dab wants by its formula written out again, what is made of it, masks, symmetry and refusals.
#include "seeds_and_sizes.h"
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <boost/property_map/function_property_map.hpp>

#include <map>
#include <random>
#include <set>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Dab = Dab_3<meshes::Kernel>;
using Dabs = std::vector<Dab>;
const Brush_kind kinds[] = {Brush_kind::grab, Brush_kind::inflate, Brush_kind::smooth, Brush_kind::flatten,
                            Brush_kind::pinch};

/// Where a dab wants the vertices that can be reached from the one nearest to its centre.
std::map<Vertex_index, Point_3> wanted(const Mesh& mesh, const Dab& dab, const std::vector<double>& mask) {
  const auto share = [&](Vertex_index v) {
    return CGAL::squared_distance(mesh.point(v), dab.centre) / (dab.radius * dab.radius);
  };
  Vertex_index nearest(0);
  for (const Vertex_index v : mesh.vertices())
    nearest = share(v) < share(nearest) ? v : nearest;
  std::set<Vertex_index> reached;
  if (share(nearest) < 1)
    reached.insert(nearest);
  for (std::size_t size = 0; size != reached.size();) {
    size = reached.size();
    for (const auto e : mesh.edges())
      for (const int end : {0, 1})
        if (reached.count(mesh.vertex(e, end)) != 0 && share(mesh.vertex(e, 1 - end)) < 1)
          reached.insert(mesh.vertex(e, 1 - end));
  }
  const auto weight = [&](Vertex_index v) { return std::pow(1 - share(v), 2) * mask[v]; };
  Vector_3 direction = CGAL::NULL_VECTOR, mean = CGAL::NULL_VECTOR;
  double sum = 0;
  for (const Vertex_index v : reached) {
    direction += weight(v) * normal(mesh, v);
    mean += weight(v) * (mesh.point(v) - CGAL::ORIGIN);
    sum += weight(v);
  }
  direction = dab.direction.value_or(direction);
  direction = direction / std::sqrt(direction.squared_length());
  const Point_3 middle = CGAL::ORIGIN + mean / sum;
  std::map<Vertex_index, Point_3> targets;
  for (const Vertex_index v : reached) {
    const Point_3 p = mesh.point(v);
    Vector_3 way = CGAL::NULL_VECTOR;
    if (dab.kind == Brush_kind::grab)
      way = direction;
    else if (dab.kind == Brush_kind::inflate)
      way = normal(mesh, v);
    else if (dab.kind == Brush_kind::flatten)
      way = -(CGAL::scalar_product(p - middle, direction) * direction);
    else if (dab.kind == Brush_kind::pinch)
      way = meshes::Kernel::Line_3(dab.centre, direction).projection(p) - p;
    else {
      Vector_3 neighbours = CGAL::NULL_VECTOR;
      std::size_t count = 0;
      for (const Vertex_index w : mesh.vertices_around_target(mesh.halfedge(v)))
        neighbours += mesh.point(w) - p, ++count;
      way = neighbours / static_cast<double>(count);
    }
    targets[v] = p + dab.strength * weight(v) * way;
  }
  return targets;
}

double length_between(const Point_3& p, const Point_3& q) {
  return std::sqrt(CGAL::squared_distance(p, q));
}

} // namespace

BOOST_AUTO_TEST_CASE(the_gap_of_a_boundary_is_no_face_of_a_normal) {
  Mesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({3, 0, 0}), c = mesh.add_vertex({0, 4, 0});
  mesh.add_face(a, b, c);
  for (const auto v : {a, b, c})
    BOOST_TEST((vertex_normal(mesh, v) == Mesh::Point(0, 0, 1) - Mesh::Point(0, 0, 0)));
}

BOOST_AUTO_TEST_CASE(a_dab_goes_where_its_formula_says_and_no_farther_from_there) {
  std::mt19937_64 random(seed_from_environment(3201));
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const std::size_t dabs = count_from_environment("HAPTIC_SCULPT_DABS", 4);
  std::size_t arrived = 0, held = 0;
  for (const Named_mesh& scene : scenes())
    for (const Brush_kind kind : kinds) {
      Mesh mesh = scene.mesh;
      Sculptor<Mesh> sculptor(mesh);
      const double edge = mean_edge(mesh);
      for (std::size_t k = 0; k < dabs; ++k) {
        const Vertex_index centre(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
        const bool is_length = kind == Brush_kind::grab || kind == Brush_kind::inflate;
        Dab dab{
            kind, mesh.point(centre), edge * (1.5 + 6 * uniform()), (is_length ? edge : 1) * (2 * uniform() - 0.5), {}};
        if (random() % 2 == 0)
          dab.direction = Vector_3(uniform() - 0.5, uniform() - 0.5, 10 * uniform());
        std::vector<double> weights(mesh.num_vertices());
        for (double& weight : weights)
          weight = random() % 4 == 0 ? 0 : uniform();
        const auto mask = boost::make_function_property_map<Vertex_index>([&](Vertex_index v) { return weights[v]; });
        const auto targets = wanted(mesh, dab, weights);
        const Mesh before = mesh;
        const Mesh_snapshot before_all = snapshot(sculptor);
        const Move_report report = apply_brush(sculptor, Dabs{dab}, mask);
        BOOST_TEST(report.asked == targets.size(), scene.name);
        std::size_t wrong = 0, reached = 0;
        for (const Vertex_index v : mesh.vertices()) {
          const auto found = targets.find(v);
          if (found == targets.end() || weights[v] == 0) {
            wrong += mesh.point(v) != before.point(v);
            continue;
          }
          // The formula, and its writing out again, are rounded.
          const double slack = 1e-9 * (edge + length_between(before.point(v), CGAL::ORIGIN) * 1e-3);
          wrong +=
              length_between(mesh.point(v), found->second) > length_between(before.point(v), found->second) + slack;
          reached += length_between(mesh.point(v), found->second) <= slack;
        }
        BOOST_TEST(wrong == 0u, scene.name << ", brush " << static_cast<int>(kind));
        reached += static_cast<std::size_t>(std::count_if(
            targets.begin(), targets.end(), [&](const auto& target) { return weights[target.first] == 0; }));
        BOOST_TEST(reached >= report.reached, scene.name);
        arrived += report.reached;
        held += report.left();
        BOOST_TEST(validate(mesh).is_valid(), scene.name);
        check_undo_and_redo(sculptor, before_all);
      }
    }
  BOOST_TEST_MESSAGE(arrived << " arrived, " << held << " held back");
  BOOST_TEST(arrived > held);
  BOOST_TEST(is_enough(held, 0));
}

BOOST_AUTO_TEST_CASE(both_sides_of_a_plane_go_alike_and_several_dabs_add_up) {
  // Symmetric about x = 0: a torus of an even number of segments.
  const Mesh start = meshes::to_mesh(meshes::torus(48, 16));
  std::map<std::array<double, 3>, Vertex_index> at;
  const auto key = [](double x, double y, double z) {
    return std::array<double, 3>{std::round(1e9 * x) + 0.0, std::round(1e9 * y) + 0.0, std::round(1e9 * z) + 0.0};
  };
  for (const Vertex_index v : start.vertices())
    at[key(start.point(v).x(), start.point(v).y(), start.point(v).z())] = v;
  const meshes::Kernel::Plane_3 plane(Point_3(0, 0, 0), Vector_3(3, 0, 0));
  for (const Brush_kind kind : kinds) {
    Mesh mesh = start;
    Sculptor<Mesh> sculptor(mesh);
    const double edge = mean_edge(mesh);
    Vertex_index centre(0);
    for (const Vertex_index v : mesh.vertices())
      centre = mesh.point(v).x() > mesh.point(centre).x() ? v : centre;
    const Dab dab{kind, mesh.point(centre), 4 * edge,
                  kind == Brush_kind::grab || kind == Brush_kind::inflate ? edge / 4 : 0.25, Vector_3(2, 1, 0.5)};
    const Move_report report = apply_brush(sculptor, Dabs{dab, mirrored(dab, plane)});
    BOOST_TEST(report.asked > 40u);
    BOOST_TEST(report.reached == report.asked);
    // The diagonals of its squares are not symmetric, nor are normals and neighbours.
    const bool asks_for_diagonals = kind == Brush_kind::inflate || kind == Brush_kind::smooth;
    double worst = 0;
    for (const Vertex_index v : mesh.vertices()) {
      const Point_3 &p = start.point(v), &q = mesh.point(v);
      const auto other = at.find(key(-p.x(), p.y(), p.z()));
      BOOST_REQUIRE((other != at.end()));
      worst = std::fmax(worst, length_between(Point_3(-q.x(), q.y(), q.z()), mesh.point(other->second)));
    }
    BOOST_TEST((asks_for_diagonals || worst < 1e-12));
    BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);

    // Twice the same dab is one of twice the strength.
    Mesh twice = start, stronger = start;
    Sculptor<Mesh> of_twice(twice), of_stronger(stronger);
    Dab strong = dab;
    strong.strength *= 2;
    apply_brush(of_twice, Dabs{dab, dab});
    apply_brush(of_stronger, Dabs{strong});
    double apart = 0;
    for (const Vertex_index v : start.vertices())
      apart = std::fmax(apart, length_between(twice.point(v), stronger.point(v)));
    BOOST_TEST(apart < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(dabs_that_cannot_be_made_change_nothing) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(2));
  Sculptor<Mesh> sculptor(mesh);
  const Mesh_snapshot before = snapshot(sculptor);
  const Point_3 top(0, 0, 1);
  BOOST_TEST(apply_brush(sculptor, Dabs{}).asked == 0u);
  BOOST_TEST(apply_brush(sculptor, Dabs{{Brush_kind::grab, Point_3(9, 9, 9), 1, 1, {}}}).asked == 0u);
  BOOST_TEST(apply_brush(sculptor, Dabs{{Brush_kind::grab, top, 0, 1, {}}}).asked == 0u);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto names = [](const std::string& what) {
    return [what](const Error& error) { return std::string(error.what()).find(what) == 0; };
  };
  for (const double radius : {nan, -1.0})
    BOOST_CHECK_EXCEPTION(apply_brush(sculptor, Dabs{{Brush_kind::grab, top, radius, 1, {}}}), Invalid_parameter,
                          names("the radius of a dab"));
  BOOST_CHECK_EXCEPTION(apply_brush(sculptor, Dabs{{Brush_kind::grab, top, inf, 1, {}}}), Out_of_range,
                        names("the radius of a dab"));
  for (const double y : {nan, inf})
    BOOST_CHECK_EXCEPTION(apply_brush(sculptor, Dabs{{Brush_kind::grab, top, 1, 1, Vector_3(0, y, 1)}}), Out_of_range,
                          names("the direction of a dab"));
  BOOST_CHECK_EXCEPTION(apply_brush(sculptor, Dabs{{Brush_kind::pinch, top, 1, 1, Vector_3(0, -0.0, 0)}}),
                        Invalid_parameter, names("the direction of a dab must not be 0"));
  for (const double part : {nan, -0.5, 1.5})
    BOOST_CHECK_EXCEPTION(apply_brush(sculptor, Dabs{{Brush_kind::grab, top, 1, 1, {}}},
                                      boost::static_property_map<double, Vertex_index>(part)),
                          Invalid_parameter, names("the mask of vertex "));
  for (const Brush_kind kind : kinds) { // all coordinates are at most 1, and so is the radius: 2^53, 9.007e15
    for (const double strength : {9.0072e15, -9.0072e15, 1e301, 1e307, inf, -inf, nan})
      BOOST_CHECK_EXCEPTION(apply_brush(sculptor, Dabs{{kind, top, 1, strength, {}}}), Invalid_parameter,
                            [](const Error& error) { return std::string(error.what()).find("strength") == 4; });
    BOOST_TEST(largest_strength(mesh, Dab{kind, top, 1, 0, {}}, Vertex_index(0)) == 0x1p53);
  }
  BOOST_TEST((snapshot(sculptor) == before));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
}

// The largest strength is what its kind measures: lengths with the scene and the radius, shares alone.
BOOST_AUTO_TEST_CASE(dabs_of_the_largest_strength_are_made_at_every_scale) {
  for (const double unit : {0x1p-300, 1.0, 0x1p300})
    for (const Brush_kind kind : kinds) {
      Mesh mesh = meshes::to_mesh(meshes::icosphere(2).scale_and_move(unit, 0, 0, 0));
      const bool is_length = kind == Brush_kind::grab || kind == Brush_kind::inflate;
      Dab dab{kind, mesh.point(Vertex_index(0)), 0.5 * unit, 0x1p53 * (is_length ? unit : 1), {}};
      double largest = 0;
      for (const Vertex_index v : mesh.vertices_around_target(mesh.halfedge(Vertex_index(0))))
        for (const Point_3& p : {mesh.point(v), mesh.point(Vertex_index(0))})
          largest = std::max({largest, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
      dab.strength *= is_length ? largest / unit : 1;
      Sculptor<Mesh> sculptor(mesh);
      BOOST_TEST(largest_strength(mesh, dab, Vertex_index(0)) == dab.strength);
      const Dab wide{kind, dab.centre, 8 * unit, 0, {}}; // measured by the radius
      BOOST_TEST(largest_strength(mesh, wide, Vertex_index(0)) == 0x1p53 * (is_length ? 8 * unit : 1));
      BOOST_TEST(apply_brush(sculptor, Dabs{dab}).asked > 1u);
      BOOST_TEST(validate(mesh).is_valid());
    }
}

// A ring and a ball turned over, a ball as it should be, a cavity and one turned over: the solid grows where it is
// inflated, whatever the faces say; which is so is known by how they were made.
BOOST_AUTO_TEST_CASE(inflate_lets_solids_grow_that_are_inside_out) {
  std::vector<std::pair<meshes::Triangle_list, bool>> parts; // and whether it bounds its solid from outside
  const auto add = [&](meshes::Triangle_list part, double x, bool is_cavity, bool is_turned) {
    part.scale_and_move(is_cavity ? 0.5 : 1, x, 0, 0);
    if (is_cavity != is_turned)
      for (auto& f : part.faces)
        std::swap(f[1], f[2]);
    parts.emplace_back(part, !is_cavity);
  };
  add(meshes::torus(24, 12), 0, false, true);
  add(meshes::icosphere(2), 10, false, true);
  add(meshes::icosphere(2), 20, false, false);
  add(meshes::icosphere(2), 20, true, false);
  add(meshes::icosphere(2), 30, false, false);
  add(meshes::icosphere(2), 30, true, true);
  const std::vector<bool> turned = {true, true, false, false, false, true};
  meshes::Triangle_list all;
  std::vector<std::size_t> part_of;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all += parts[i].first;
    part_of.resize(all.points.size(), i);
  }
  const Mesh start = meshes::to_mesh(all);
  const auto volume_of = [&](const Mesh& mesh, std::size_t part) { // as the faces are turned
    double sum = 0;
    for (const auto f : mesh.faces()) {
      std::vector<Vector_3> p;
      for (const Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
        if (part_of[v] == part)
          p.push_back(mesh.point(v) - CGAL::ORIGIN);
      if (p.size() == 3)
        sum += CGAL::determinant(p[0], p[1], p[2]) / 6;
    }
    return std::fabs(sum);
  };
  for (const bool knows : {false, true})
    for (std::size_t part = 0; part < parts.size(); ++part)
      BOOST_TEST_CONTEXT("part " << part) {
        Mesh mesh = start;
        Sculptor<Mesh> sculptor(mesh, parameters::known_valid(knows));
        const auto first = Vertex_index(static_cast<Mesh::size_type>(
            std::find(part_of.begin(), part_of.end(), part) - part_of.begin()));
        BOOST_TEST(sculptor.is_inside_out(first) == turned[part]);
        const auto dabbed = apply_brush(sculptor, Dabs{{Brush_kind::inflate, mesh.point(first), 0.4, 0.01, {}}});
        BOOST_TEST(dabbed.asked > 0u);
        BOOST_TEST(dabbed.reached == dabbed.asked);
        const double before = volume_of(start, part), after = volume_of(mesh, part);
        BOOST_TEST((parts[part].second ? after > before : after < before));
        apply_brush(sculptor, Dabs{{Brush_kind::inflate, start.point(first), 0.4, -0.02, {}}});
        BOOST_TEST((parts[part].second ? volume_of(mesh, part) < after : volume_of(mesh, part) > after));
      }
  // Indices that removed vertices leave are used again, by other components.
  Mesh mesh = start;
  Sculptor<Mesh> sculptor(mesh);
  const auto check = [&] {
    for (const Vertex_index v : mesh.vertices()) {
      const double x = mesh.point(v).x();
      const bool outer = CGAL::squared_distance(mesh.point(v), Point_3(30, 0, 0)) > 0.5;
      BOOST_TEST(sculptor.is_inside_out(v) == (x < 15 || (x > 25 && !outer)));
    }
  };
  check();
  for (const std::size_t part : {0u, 1u, 5u})
    for (int k = 0; k < 3; ++k)
      sculptor.remove(Vertex_index(static_cast<Mesh::size_type>(
          std::find(part_of.begin(), part_of.end(), part) - part_of.begin() + 3 * k + 1)));
  check();
  for (int k = 0; k < 9; ++k)
    for (const auto f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      const Point_3 middle = CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                            mesh.point(mesh.target(mesh.next(h))));
      if (middle.x() > 15 + 10 * (k % 2) && sculptor.insert_on_face(f, middle))
        break;
    }
  check();
  while (sculptor.undo())
    check();
}

// Also where more vertices are given than a dab touches.
BOOST_AUTO_TEST_CASE(what_is_beyond_the_radius_stays) {
  const Mesh mesh = meshes::to_mesh(meshes::icosphere(2));
  const std::vector<Vertex_index> all(mesh.vertices_begin(), mesh.vertices_end());
  for (const Brush_kind kind : kinds)
    for (const double radius : {0.5, 0.0}) {
      const Dab dab{kind, mesh.point(Vertex_index(0)), radius, 0.1, {}};
      std::map<Vertex_index, Point_3> few, many;
      const auto mask = boost::static_property_map<double, Vertex_index>(1);
      fill_brush_targets(touched_vertices(mesh, dab, Vertex_index(0)), mesh, dab, boost::make_assoc_property_map(few),
                         mask);
      fill_brush_targets(all, mesh, dab, boost::make_assoc_property_map(many), mask);
      BOOST_TEST(few.empty() == (radius == 0));
      for (const Vertex_index v : all)
        if (few.count(v) != 0) // the order of sums is another
          BOOST_TEST(CGAL::squared_distance(many.at(v), few.at(v)) <= 1e-28);
        else
          BOOST_TEST((many.at(v) == mesh.point(v)));
    }
}
