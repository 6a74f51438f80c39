// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers near both ends of the range: what is outside is refused by name before anything moves, all else is guarded as
// ever; and clearances that depend on the contact alone.
#include <boost/test/unit_test.hpp>

#include "sculpting/Random_scene.h"
#include "sculpting/clearances.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

#include <CGAL/Gmpq.h>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Exact_point = CGAL::Simple_cartesian<CGAL::Gmpq>::Point_3;

Exact_point exact(const Point_3& p) { return {p.x(), p.y(), p.z()}; }

bool is_farther(const Point_3& target, const Point_3& end, const Point_3& start) {
  return CGAL::squared_distance(exact(end), exact(target)) > CGAL::squared_distance(exact(start), exact(target));
}

/// Of any sign and exponent, subnormal numbers to the largest, as likely as any other.
double any_double(Random& random) {
  const std::uint64_t exponent = random() % 2047, fraction = random() % (std::uint64_t{1} << 52), sign = random() % 2;
  const std::uint64_t bits = sign << 63 | exponent << 52 | fraction;
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

std::vector<Mesh> extreme_scenes() {
  std::vector<Mesh> all = {meshes::to_mesh(meshes::tetrahedron()), meshes::to_mesh(meshes::cube(4)),
                           meshes::to_mesh(meshes::box(3, 2)), meshes::to_mesh(meshes::ball_in_a_cavity(1)),
                           meshes::to_mesh(meshes::sliver_stack(3, 0x1p-39))};
  Mesh extreme = meshes::to_mesh(meshes::tetrahedron());
  extreme.point(Vertex_index(0)) = Point_3(0, 0, 0);
  extreme.point(Vertex_index(1)) = Point_3(1e150, 0, 0);
  extreme.point(Vertex_index(2)) = Point_3(0, 1e-160, 0);
  extreme.point(Vertex_index(3)) = Point_3(3e-320, 5e-324, 1e120);
  all.push_back(extreme);
  return all;
}

constexpr Response responses[] = {Response::slide, Response::stop, Response::paper()};

} // namespace

BOOST_AUTO_TEST_CASE(what_is_out_of_range_is_refused_and_nothing_moves) {
  const double beyond = std::nextafter(largest_coordinate, std::numeric_limits<double>::infinity());
  Mesh mesh = meshes::to_mesh(meshes::cube(4));
  const Mesh before = mesh;
  Sculptor<Mesh> sculptor(mesh);
  auto grab = sculptor.grab(Vertex_index(0));
  for (const double x : {beyond, -beyond, std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity(),
                         std::numeric_limits<double>::quiet_NaN()}) {
    BOOST_CHECK_THROW(grab.drag_to({0, x, 0}), Out_of_range);
    BOOST_CHECK_THROW(sculptor.probe({0, 0, 5}).drag_to({x, 0, 0}), Out_of_range);
    BOOST_CHECK_THROW(sculptor.probe({0, 0, x}), Out_of_range);
    BOOST_CHECK_THROW(sculptor.insert_on_face(*mesh.faces().begin(), {0, 0, x}), Out_of_range);
    BOOST_CHECK_THROW(sculptor.insert_on_edge(*mesh.edges().begin(), {x, 0, 0}), Out_of_range);
    BOOST_CHECK_THROW(sculptor.set_drag_parameters(Drag_parameters().clearance(x)), Out_of_range);
    BOOST_CHECK_THROW(sculptor.set_delta(x), Out_of_range);
    BOOST_CHECK_THROW(first_impacts(mesh, Vertex_index(0), {x, 0, 0}), Out_of_range);
  }
  for (const Vertex_index v : mesh.vertices())
    BOOST_TEST(mesh.point(v) == before.point(v));
  Mesh far = before;
  far.point(Vertex_index(2)) = Point_3(beyond, far.point(Vertex_index(2)).y(), far.point(Vertex_index(2)).z());
  BOOST_CHECK_THROW(Sculptor<Mesh>{far}, Out_of_range);
  // The bound itself is in range.
  grab.drag_to({-largest_coordinate, largest_coordinate, largest_coordinate});
  BOOST_TEST(validate(mesh).is_valid());
}

// Where motions are decided it is asked once more, so that no response can go there on its way to a target in range.
BOOST_AUTO_TEST_CASE(no_motion_to_what_is_out_of_range_is_free) {
  const Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  Box_tree_broad_phase<Mesh> broad_phase(mesh);
  const internal::Face_corners<Mesh> corners(mesh);
  Filter_counters counters;
  internal::Guarded_star<Mesh, Box_tree_broad_phase<Mesh>> guard(mesh, broad_phase, corners,
                                                                 Exact_sweep_traits<Mesh>(&counters));
  const double beyond = std::nextafter(largest_coordinate, std::numeric_limits<double>::infinity());
  for (const Vertex_index v : mesh.vertices()) {
    guard.collect(v);
    const internal::Coordinates source = vertex_coordinates(mesh, v);
    std::size_t free = 0;
    for (const double x : {-1.0, 0.0, 1.0})
      for (const double y : {-1.0, 0.0, 1.0})
        for (const double z : {-1.0, 0.0, 1.0}) {
          const auto target = [&](double size) { return internal::Coordinates{x * size, y * size, z * size}; };
          free += guard.decide(source, target(largest_coordinate), 0).is_free();
          if (x == 0 && y == 0 && z == 0)
            continue;
          for (const double size :
               {beyond, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
            BOOST_TEST(!guard.decide(source, target(size), 0).is_free());
            BOOST_TEST(!guard.is_free(source, target(size), 0));
          }
        }
    BOOST_TEST(free > 0u); // outward
  }
}

BOOST_AUTO_TEST_CASE(targets_of_any_size_keep_the_mesh_embedded_and_lead_no_farther) {
  const std::size_t drags = count_from_environment("HAPTIC_SCULPT_EXTREME_DRAGS", 1000);
  Random random(seed_from_environment(911));
  std::size_t made = 0, refused = 0, reached = 0, farther = 0, invalid = 0;
  const std::vector<Mesh> all = extreme_scenes();
  while (made + refused < drags)
    for (const Mesh& scene : all)
      for (const Response response : responses) {
        Mesh mesh = scene;
        Sculptor<Mesh> sculptor(mesh, parameters::response(response));
        for (int i = 0; i < 8; ++i) {
          if (random() % 4 == 0)
            try {
              sculptor.set_delta(std::abs(any_double(random)));
            } catch (const Error&) { // no length, or the mesh does not obey it
            }
          if (random() % 4 == 0)
            try {
              sculptor.set_drag_parameters(
                  Drag_parameters(sculptor.parameters().drag).clearance(std::abs(any_double(random))));
            } catch (const Error&) { // of no use to the scene
            }
          const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
          const Point_3 start = mesh.point(v);
          const auto some = [&] { return random() % 3 == 0 ? 0 : any_double(random); };
          const Point_3 target(some(), some(), some());
          try {
            const auto result = sculptor.grab(v).drag_to(target);
            ++made;
            reached += result.reached;
            farther += is_farther(target, result.position, start);
            BOOST_REQUIRE(result.position == mesh.point(v));
            for (const auto& contact : result.contacts)
              for (const double n : internal::coordinates(contact.normal))
                BOOST_REQUIRE(std::isfinite(n));
            BOOST_REQUIRE(std::isfinite(result.kkt_residual));
          } catch (const Out_of_range&) {
            ++refused;
            BOOST_REQUIRE(mesh.point(v) == start);
          } catch (const Invalid_parameter&) { // the scene has outgrown the clearance
            ++refused;
            BOOST_REQUIRE(mesh.point(v) == start);
          }
        }
        if (!validate(mesh).is_valid())
          ++invalid;
      }
  BOOST_TEST_MESSAGE(made << " drags made, " << reached << " reached, " << refused << " refused");
  BOOST_TEST(made > drags / 4);
  BOOST_TEST(invalid == 0u);
  BOOST_TEST(farther == 0u);
}

BOOST_AUTO_TEST_CASE(a_far_target_inflates_no_clearance_and_leaves_no_trace) {
  // The vertex in the middle of a cube's side is pushed outward: free. Pushed through the cube: held by the other side.
  for (const double far : {4.0, 1e6, 1e100, 1e300}) {
    Mesh mesh = meshes::to_mesh(meshes::box(4, 4));
    Vertex_index v;
    for (const Vertex_index w : mesh.vertices())
      if (mesh.point(w) == Point_3(4, 2, 2))
        v = w;
    BOOST_REQUIRE(v.is_valid());
    Sculptor<Mesh> sculptor(mesh);
    const Point_3 start = mesh.point(v);
    const auto first = sculptor.grab(v).drag_to({-far, start.y(), start.z()});
    BOOST_TEST(!first.reached);
    BOOST_TEST(std::abs(first.position.x()) < 4.1);
    BOOST_TEST(first.stop_error <= 2 * internal::default_clearance(4));
    BOOST_REQUIRE(sculptor.undo());
    BOOST_REQUIRE(mesh.point(v) == start);
    // Out and back again: the same drag ends at the same bits.
    BOOST_REQUIRE(sculptor.grab(v).drag_to({1e200, start.y(), start.z()}).reached);
    BOOST_REQUIRE(sculptor.undo());
    const auto second = sculptor.grab(v).drag_to({-far, start.y(), start.z()});
    BOOST_TEST(second.position == first.position);
  }
}

BOOST_AUTO_TEST_CASE(clearances_depend_on_the_contact_and_on_nothing_else) {
  // A large body far away changes no contact here.
  const auto gap_with = [](bool with_far_body) {
    meshes::Triangle_list list = meshes::cube(2);
    const std::size_t first_far = list.points.size();
    if (with_far_body)
      list += meshes::cube(2);
    Mesh mesh = meshes::to_mesh(list);
    for (std::size_t i = first_far; i < list.points.size(); ++i) {
      auto& p = mesh.point(Vertex_index(static_cast<Mesh::size_type>(i)));
      p = Point_3(p.x() * 1e190 + 1e200, p.y() * 1e190, p.z() * 1e190);
    }
    Sculptor<Mesh> sculptor(mesh);
    return sculptor.grab(Vertex_index(0)).drag_to({9, 8, 7}).position;
  };
  BOOST_TEST(gap_with(true) == gap_with(false));
}

BOOST_AUTO_TEST_CASE(clearances_that_do_not_serve_are_refused_with_the_range_that_does) {
  Mesh mesh = meshes::to_mesh(meshes::cube(4));
  const double ulp = internal::unit_in_the_last_place(4);
  Sculptor<Mesh> sculptor(mesh);
  const auto says_range = [](const Invalid_parameter& e) {
    return std::string(e.what()).find("give ") != std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(sculptor.set_drag_parameters(Drag_parameters().clearance(ulp / 2)), Invalid_parameter,
                        says_range);
  BOOST_CHECK_EXCEPTION(sculptor.set_drag_parameters(Drag_parameters().clearance(1)), Invalid_parameter, says_range);
  BOOST_CHECK_EXCEPTION(Sculptor<Mesh>(mesh, parameters::clearance(1)), Invalid_parameter, says_range);
  sculptor.set_drag_parameters(Drag_parameters().clearance(4 * ulp));
  const Point_3 start = mesh.point(Vertex_index(0));
  BOOST_REQUIRE(sculptor.grab(Vertex_index(0)).drag_to({-1e9, 1e9, -1e9}).reached);
  const Point_3 there = mesh.point(Vertex_index(0));
  BOOST_CHECK_EXCEPTION(sculptor.grab(Vertex_index(0)).drag_to(start), Invalid_parameter, says_range);
  BOOST_TEST(mesh.point(Vertex_index(0)) == there);
  BOOST_REQUIRE(sculptor.undo());
  BOOST_TEST(sculptor.grab(Vertex_index(0)).drag_to({1, 1, 1}).position != start); // the scene is small again
}

BOOST_AUTO_TEST_CASE(units_in_the_last_place_are_those_of_the_next_double) {
  Random random(seed_from_environment(912));
  for (int i = 0; i < 100000; ++i) {
    const double x = std::abs(any_double(random)), next = std::nextafter(x, std::numeric_limits<double>::infinity());
    if (std::isfinite(next))
      BOOST_REQUIRE(internal::unit_in_the_last_place(x) == next - x);
  }
  BOOST_TEST(internal::unit_in_the_last_place(0) == std::numeric_limits<double>::denorm_min());
  BOOST_TEST(internal::unit_in_the_last_place(std::numeric_limits<double>::infinity()) == 0);
}

BOOST_AUTO_TEST_CASE(a_slide_to_a_target_beyond_reach_does_no_less_than_a_stop) {
  // A corner of a tetrahedron drawn through the face opposite: to 1e19 and beyond the slide has once stayed where it
  // was.
  std::size_t moved = 0, less = 0, unexplained = 0;
  for (const double far : {1e3, 2e3, 1e6, 1e17, 1e19, 1e20, 1e40, 1e100, 1e200, 1e301})
    for (const Point_3& direction : {Point_3(1, 0, 0), Point_3(1, 1, 1), Point_3(3, 1, 2), Point_3(1, 0, 1)}) {
      const Point_3 target(far * direction.x() / 4, far * direction.y() / 4, far * direction.z() / 4);
      std::array<Drag_result<Mesh>, 2> results;
      for (int k = 0; k < 2; ++k) {
        Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
        mesh.point(Vertex_index(0)) = Point_3(0, 0, 0);
        mesh.point(Vertex_index(1)) = Point_3(1, 0, 0);
        mesh.point(Vertex_index(2)) = Point_3(0, 1, 0);
        mesh.point(Vertex_index(3)) = Point_3(0, 0, 1);
        Sculptor<Mesh> sculptor(mesh, parameters::response(k == 0 ? Response::slide : Response::stop));
        results[static_cast<std::size_t>(k)] = sculptor.grab(Vertex_index(0)).drag_to(target);
        BOOST_TEST(validate(mesh).is_valid());
      }
      moved += results[0].position != Point_3(0, 0, 0);
      // One that ends beside the other within a clearance or two is as near.
      less += is_farther(target, results[0].position, results[1].position) &&
              CGAL::squared_distance(results[0].position, results[1].position) > 1e-28;
      unexplained += results[0].end == Drag_end::no_progress;
    }
  BOOST_TEST(moved == 40u);
  BOOST_TEST(less == 0u);
  BOOST_TEST(unexplained == 0u);
}
