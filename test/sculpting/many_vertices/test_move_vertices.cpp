// SPDX-License-Identifier: GPL-3.0-or-later
// Many vertices at once against what every run has to keep: embedded, never farther, one step, counted right.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/move_vertices.h>

#include <boost/iterator/transform_iterator.hpp>

#include <iterator>
#include <limits>
#include <sstream>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// Where `function(v)` says.
template <class Function>
Point_map targets(Mesh& mesh, const Function& function) {
  const Point_map map = mesh.add_property_map<Vertex_index, Point_3>("v:target").first;
  for (const Vertex_index v : mesh.vertices())
    map[v] = function(v);
  return map;
}

std::vector<Vertex_index> all(const Mesh& mesh) {
  return {mesh.vertices().begin(), mesh.vertices().end()};
}

long double distance(const Point_3& p, const Point_3& q) {
  const long double x = static_cast<long double>(p.x()) - q.x(), y = static_cast<long double>(p.y()) - q.y(),
                    z = static_cast<long double>(p.z()) - q.z();
  return std::sqrt(x * x + y * y + z * z);
}

/// Runs it and checks all that holds for every run. \return the report
Move_report checked_run(const std::string& name, Mesh mesh,
                        const std::function<Point_3(const Mesh&, Vertex_index)>& function,
                        const Move_parameters& parameters = Move_parameters()) {
  BOOST_TEST_CONTEXT(name) {
    const Point_map map = targets(mesh, [&](Vertex_index v) { return function(mesh, v); });
    const Mesh old = mesh;
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot before = snapshot(sculptor);
    std::vector<Vertex_index> behind;
    const Move_report report = move_vertices(sculptor, mesh.vertices(), map, parameters, std::back_inserter(behind));
    BOOST_TEST(validate(mesh).is_valid());
    sculptor.check_unchanged();
    long double asked = 0, left = 0, asked_max = 0, left_max = 0;
    std::vector<Vertex_index> not_there;
    for (const Vertex_index v : mesh.vertices()) {
      const long double a = distance(old.point(v), map[v]), b = distance(mesh.point(v), map[v]);
      // Long doubles round too.
      BOOST_TEST(b <= a * (1 + 1e-15L), "vertex " << v << " ends at " << b << " from its target, it was at " << a);
      asked += a * a, left += b * b;
      asked_max = std::max(asked_max, a), left_max = std::max(left_max, b);
      if (mesh.point(v) != map[v])
        not_there.push_back(v);
    }
    BOOST_TEST(report.asked == mesh.number_of_vertices());
    BOOST_TEST(report.reached == report.asked - not_there.size());
    BOOST_TEST((behind == not_there));
    BOOST_TEST(report.left() == not_there.size());
    BOOST_TEST(report.counted >= report.drags);
    BOOST_TEST(report.counted <= parameters.drag_limit);
    BOOST_TEST(report.left_l2 <= report.asked_l2);
    BOOST_TEST(std::abs(report.asked_l2 - static_cast<double>(std::sqrt(asked))) <= 1e-12 * report.asked_l2);
    BOOST_TEST(std::abs(report.left_l2 - static_cast<double>(std::sqrt(left))) <= 1e-12 * report.asked_l2);
    BOOST_TEST(std::abs(report.asked_max - static_cast<double>(asked_max)) <= 1e-12 * report.asked_max);
    BOOST_TEST(std::abs(report.left_max - static_cast<double>(left_max)) <= 1e-12 * report.asked_max);
    BOOST_TEST(sculptor.history().number_of_undo_steps() <= 1u);
    BOOST_TEST((sculptor.history().number_of_undo_steps() == 1u || snapshot(sculptor) == before));
    check_undo_and_redo(sculptor, before);
    BOOST_TEST_MESSAGE(name << ": reached " << report.reached << " of " << report.asked << " in " << report.drags
                            << " drags, " << 100 * (1 - report.left_l2 / report.asked_l2) << " % of the way");
    return report;
  }
  return {};
}

} // namespace

BOOST_AUTO_TEST_CASE(translations_by_ten_edges_arrive_to_the_bit) {
  for (const auto& [name, mesh] : scenes()) {
    const double l = 10 * mean_edge(mesh);
    for (const Vector_3& d : {Vector_3(0.6, 0.64, 0.48), Vector_3(-1, 0, 0)}) {
      const Move_report report = checked_run("translation of " + name, mesh,
                                             [&](const Mesh& m, Vertex_index v) { return m.point(v) + l * d; });
      BOOST_TEST(report.reached == report.asked, name);
    }
  }
}

BOOST_AUTO_TEST_CASE(turns_by_a_right_angle_arrive_to_the_bit) {
  for (const auto& [name, mesh] : scenes()) {
    const Move_report report = checked_run("turn of " + name, mesh, [](const Mesh& m, Vertex_index v) {
      return Point_3(-m.point(v).y(), m.point(v).x(), m.point(v).z());
    });
    BOOST_TEST(report.reached == report.asked, name);
  }
}

BOOST_AUTO_TEST_CASE(turns_take_few_drags_where_edges_are_short_beside_the_way) {
  // All vertices of a ring go in a circle, so that each is in the way of the next: in straight steps that takes some
  // hundred drags a vertex, one coordinate after the other it takes a dozen.
  const Mesh mesh = meshes::to_mesh(meshes::torus(160, 40));
  for (const Vector_3& axis : {Vector_3(0, 0, 1), Vector_3(0.48, 0.6, 0.64)}) {
    const auto turned = [&](const Mesh& m, Vertex_index v) {
      const Vector_3 p = m.point(v) - CGAL::ORIGIN;
      return CGAL::ORIGIN + (axis * (axis * p) + CGAL::cross_product(axis, p));
    };
    const Move_report report = checked_run("turn of a fine torus", mesh, turned);
    BOOST_TEST(report.reached == report.asked);
    BOOST_TEST(report.drags < 40 * report.asked);
  }
}

BOOST_AUTO_TEST_CASE(small_meshes_of_long_faces_turn_about_axes_far_away) {
  // Half of such a mesh is a few vertices, and a share of a hundredth of the way is many edges.
  meshes::Triangle_list nested = meshes::box(1), inner = meshes::box(1);
  inner.scale_and_move(0.8, 0.1, 0.1, 0.1);
  inner.turn_inside_out();
  nested += inner;
  const Vector_3 axis(0.48, 0.6, 0.64);
  for (const auto& [name, list] :
       {std::make_pair("torus of 9 vertices", meshes::torus(3, 3)), std::make_pair("cube in a cube", nested)})
    for (const Point_3& centre : {Point_3(0, 0, 0), Point_3(3, -2, 1), Point_3(100, 30, -50)})
      for (const double angle : {0.5, 1.3, 1.5707}) {
        const auto turned = [&](const Mesh& m, Vertex_index v) {
          const Vector_3 p = m.point(v) - centre;
          return centre + (std::cos(angle) * p + std::sin(angle) * CGAL::cross_product(axis, p) +
                           (1 - std::cos(angle)) * (axis * p) * axis);
        };
        const Move_report report = checked_run(name, meshes::to_mesh(list), turned);
        BOOST_TEST(report.reached == report.asked, name << " by " << angle << " about " << centre);
      }
}

BOOST_AUTO_TEST_CASE(what_cannot_arrive_stays_embedded_and_comes_nearer) {
  std::mt19937 random(static_cast<std::uint32_t>(seed_from_environment(7)));
  for (const auto& [name, mesh] : scenes()) {
    const double l = mean_edge(mesh);
    const auto inflated = [&](const Mesh& m, Vertex_index v) { return m.point(v) + 2 * l * normal(m, v); };
    const auto deflated = [&](const Mesh& m, Vertex_index v) { return m.point(v) - 2 * l * normal(m, v); };
    const auto noisy = [&](const Mesh& m, Vertex_index v) {
      return m.point(v) + l * Vector_3(meshes::uniform(random), meshes::uniform(random), meshes::uniform(random));
    };
    const auto mirrored = [](const Mesh& m, Vertex_index v) {
      return Point_3(-m.point(v).x(), m.point(v).y(), m.point(v).z());
    };
    const Move_parameters bounded = Move_parameters().most_drags(3 * mesh.number_of_vertices());
    checked_run("inflated " + name, mesh, inflated, bounded);
    checked_run("deflated " + name, mesh, deflated, bounded);
    checked_run("noisy " + name, mesh, noisy, bounded);
    checked_run("mirrored " + name, mesh, mirrored, bounded);
    checked_run("noisy " + name + ", stops only", mesh, noisy, Move_parameters().slide(false).steps(false));
  }
}

BOOST_AUTO_TEST_CASE(nothing_moves_where_a_target_cannot_be_used) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2));
  const Point_map map = targets(mesh, [&](Vertex_index v) { return mesh.point(v) + Vector_3(0.1, 0, 0); });
  Sculptor<Mesh> sculptor(mesh);
  const Mesh_snapshot before = snapshot(sculptor);
  const Vertex_index last(static_cast<Mesh::size_type>(mesh.num_vertices() - 1));
  const Point_3 good = map[last];
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const Point_3& bad : {Point_3(nan, 0, 0), Point_3(0, infinity, 0), Point_3(0, 0, -0x1.1p1000)}) {
    map[last] = bad;
    BOOST_CHECK_EXCEPTION(move_vertices(sculptor, mesh.vertices(), map), Out_of_range, [&](const Out_of_range& error) {
      return std::string(error.what()).find("vertex " + std::to_string(static_cast<std::size_t>(last))) !=
             std::string::npos;
    });
    BOOST_TEST((snapshot(sculptor) == before));
  }
  map[last] = good;
  std::vector<Vertex_index> vertices = all(mesh);
  vertices.push_back(Vertex_index(static_cast<Mesh::size_type>(mesh.num_vertices())));
  BOOST_CHECK_THROW(move_vertices(sculptor, vertices, map), Unknown_vertex);
  vertices.back() = Vertex_index();
  BOOST_CHECK_THROW(move_vertices(sculptor, vertices, map), Unknown_vertex);
  sculptor.set_drag_parameters(Drag_parameters().clearance(1e-9));
  map[last] = Point_3(1e9, 0, 0); // where an ulp is more than the clearance
  BOOST_CHECK_THROW(move_vertices(sculptor, mesh.vertices(), map), Invalid_parameter);
  BOOST_TEST((snapshot(sculptor) == before));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
}

BOOST_AUTO_TEST_CASE(cancelled_bounded_and_thrown_out_of) {
  struct Thrown {};
  for (const std::size_t after : {0, 1, 2}) { // it is free along each of three axes: three calls, before each
    Mesh mesh = meshes::to_mesh(meshes::hollow_ball(3));
    const double l = mean_edge(mesh);
    const Point_map map = targets(mesh, [&](Vertex_index v) { return mesh.point(v) + 2 * l * normal(mesh, v); });
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot before = snapshot(sculptor);

    std::size_t calls = 0;
    const auto cancelling = [&](const Move_progress& progress) {
      BOOST_TEST(progress.asked == mesh.number_of_vertices());
      BOOST_TEST(progress.behind <= progress.asked);
      BOOST_TEST(validate(mesh).is_valid());
      return calls++ < after;
    };
    const Move_report cancelled = move_vertices(sculptor, mesh.vertices(), map, Move_parameters().progress(cancelling));
    BOOST_TEST(cancelled.cancelled);
    BOOST_TEST(!cancelled.out_of_work);
    BOOST_TEST(calls == after + 1);
    BOOST_TEST((cancelled.drags == 0) == (after == 0));
    check_undo_and_redo(sculptor, before);
    if (cancelled.drags != 0)
      sculptor.undo();

    calls = 0;
    const auto throwing = [&](const Move_progress&) -> bool {
      if (calls++ == after)
        throw Thrown();
      return true;
    };
    BOOST_CHECK_THROW(move_vertices(sculptor, mesh.vertices(), map, Move_parameters().progress(throwing)), Thrown);
    BOOST_TEST(validate(mesh).is_valid());
    BOOST_TEST(!sculptor.history().is_in_stroke());
    check_undo_and_redo(sculptor, before);
    if (after != 0)
      sculptor.undo();

    const Move_report bounded =
        move_vertices(sculptor, mesh.vertices(), map, Move_parameters().most_drags(100 * after));
    BOOST_TEST(bounded.drags == 100 * after);
    BOOST_TEST(bounded.out_of_work);
    BOOST_TEST(!bounded.cancelled);
    BOOST_TEST(validate(mesh).is_valid());
  }
}

// Free along x and y, and then not along z, for the plate below is in the way of all: that step is taken back, and the
// next is not begun.
BOOST_AUTO_TEST_CASE(progress_tells_how_many_are_behind_not_how_many_move_along_the_axis_at_hand) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.02));
  const std::vector<Vertex_index> every = all(mesh), some(every.begin(), every.begin() + 12);
  const auto target = [&mesh](Vertex_index v) { // half of them along x, the others along y
    const bool is_even = static_cast<std::size_t>(v) % 2 == 0;
    return mesh.point(v) + Vector_3(is_even ? 1e-4 : 0, is_even ? 0 : 1e-4, 0);
  };
  Sculptor<Mesh> sculptor(mesh);
  std::vector<std::size_t> behind;
  const auto report = move_vertices(sculptor, some, targets(mesh, target),
                                    Move_parameters().progress([&](const Move_progress& progress) {
                                      BOOST_TEST(progress.asked == 12u);
                                      behind.push_back(progress.behind);
                                      return true;
                                    }));
  BOOST_TEST(report.reached == 12u);
  BOOST_TEST((behind == std::vector<std::size_t>{12, 6}));
}

BOOST_AUTO_TEST_CASE(what_changes_nothing_is_no_step_and_what_was_undone_can_be_redone) {
  Box_over_plate scene;
  auto& [box, mesh, sculptor] = scene;
  const Mesh_snapshot first = snapshot(sculptor);
  sculptor.drag(box[0], mesh.point(box[0]) + Vector_3(0, 0, 0.1));
  const Mesh_snapshot before = snapshot(sculptor);
  sculptor.drag(box[1], mesh.point(box[1]) + Vector_3(0, 0, 0.2));
  const Mesh_snapshot both = snapshot(sculptor);
  sculptor.undo();
  const Point_map map = targets(mesh, [&m = scene.mesh](Vertex_index v) { return m.point(v) + Vector_3(3, 5, -4); });
  for (const bool in_stroke : {false, true}) {
    auto stroke = std::optional(sculptor.stroke());
    if (!in_stroke)
      stroke.reset();
    std::size_t calls = 0;
    const auto report = move_vertices(sculptor, box, map,
                                      Move_parameters().progress([&](const Move_progress&) { return calls++ < 3; }));
    BOOST_TEST((report.cancelled && report.drags == 3 * box.size()));
    BOOST_TEST((snapshot(sculptor) == before));
    BOOST_TEST((scene.steps() == std::pair(std::size_t{1}, std::size_t{1})));
  }
  BOOST_TEST(static_cast<bool>(sculptor.redo()));
  BOOST_TEST((snapshot(sculptor) == both));
  sculptor.undo();
  sculptor.undo();
  BOOST_TEST((snapshot(sculptor) == first));
  sculptor.check_unchanged();
}

BOOST_AUTO_TEST_CASE(a_slide_counts_by_its_work) {
  // A shell about a ball: blown up and down they are in each other's way, and only slides lead on.
  Mesh mesh = meshes::to_mesh(meshes::ball_in_a_cavity());
  const double l = mean_edge(mesh);
  const auto noisy = [l](std::size_t seed) {
    std::mt19937 random(seed);
    return [l, random](const Mesh& m, Vertex_index v) mutable {
      return m.point(v) + 2 * l * Vector_3(meshes::uniform(random), meshes::uniform(random), meshes::uniform(random));
    };
  };
  const Move_report whole = checked_run("noisy", mesh, noisy(1), Move_parameters().steps(false));
  BOOST_TEST(whole.counted > whole.drags); // some slides decide more than a drag does
  BOOST_TEST(!whole.out_of_work);
  const Move_report stops =
      checked_run("noisy, stops only", mesh, noisy(1), Move_parameters().steps(false).slide(false));
  BOOST_TEST(stops.counted == stops.drags);
  // Whatever the limit is, it holds, and no more is left than where there are no slides.
  for (const std::size_t more : {1, 2, 10, 100, 1000}) {
    const Move_report bounded =
        checked_run("noisy, bounded", mesh, noisy(1), Move_parameters().steps(false).most_drags(stops.counted + more));
    BOOST_TEST(bounded.left_l2 <= stops.left_l2);
    BOOST_TEST((!bounded.out_of_work || bounded.counted == stops.counted + more));
  }
}

BOOST_AUTO_TEST_CASE(few_none_and_repeated) {
  Mesh mesh = meshes::to_mesh(meshes::ball_in_a_cavity());
  const Vertex_index other(6);
  const Point_map map = targets(mesh, [&](Vertex_index v) { return mesh.point(v) + Vector_3(0.125, 0, 0); });
  Sculptor<Mesh> sculptor(mesh);
  const Move_report none = move_vertices(sculptor, std::vector<Vertex_index>(), map);
  BOOST_TEST(none.asked == 0u);
  BOOST_TEST(none.asked_l2 == 0);
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
  const std::vector<Vertex_index> twice = {Vertex_index(5), other, Vertex_index(5)};
  const Point_3 five = map[Vertex_index(5)], beside = map[other];
  const Move_report report = move_vertices(sculptor, twice, map);
  BOOST_TEST(report.asked == 2u);
  BOOST_TEST(report.reached == 2u);
  BOOST_TEST((mesh.point(Vertex_index(5)) == five && mesh.point(other) == beside));
  // There already: nothing is dragged, no step is made.
  BOOST_TEST(move_vertices(sculptor, twice, map).drags == 0u);
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
  // In a stroke of the caller's it joins that.
  {
    const auto stroke = sculptor.stroke();
    map[Vertex_index(5)] = five + Vector_3(0.01, 0, 0);
    move_vertices(sculptor, twice, map);
    map[Vertex_index(5)] = five;
    move_vertices(sculptor, twice, map);
    BOOST_TEST(stroke.is_open());
  }
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 2u);
  // A range that can be read once only.
  map[other] = beside + Vector_3(0.01, 0, 0);
  std::istringstream numbers("5 6 5");
  const auto vertex = [](std::uint32_t n) { return Vertex_index(n); };
  using Once = boost::transform_iterator<decltype(vertex), std::istream_iterator<std::uint32_t>, Vertex_index>;
  const Move_report once = move_vertices(
      sculptor, CGAL::make_range(Once(std::istream_iterator<std::uint32_t>(numbers), vertex), Once({}, vertex)), map);
  BOOST_TEST((once.asked == 2u && once.reached == 2u && mesh.point(other) == map[other]));
}
