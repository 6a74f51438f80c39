// SPDX-License-Identifier: GPL-3.0-or-later
// The coupling force against what geometry says: of a grabbed vertex whose edge or face is held, on convex edges and
// facets, and in motion.
#include "haptic_rendering/led_motion.h"
#include "haptic_rendering/map_of_tests.h"

#include <seeds_and_sizes.h>

using namespace haptic_rendering_tests;

namespace {

Vector3d force_of(const Tool_step& step) {
  return Virtual_coupling{stiffness, 0}.force(map_of_tests, step.proxy, step.target, step.reached);
}

void check_static_force(Obstacle kind, bool with_wall, std::uint64_t seed) {
  Random random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0, largest_jump = 0;
  for (int round = 0; round < 40; ++round) {
    const Held_scene scene(kind, random);
    meshes::Triangle_list list = tetrahedron_of(scene.moving);
    list += tetrahedron_of(scene.obstacle);
    list += tetrahedron_of(scene.wall);
    Mesh mesh = meshes::to_mesh(list);
    const Vector3d first = scene.moving[0], start = first + 0.1 * scene.down;
    Sculptor<Mesh> sculptor(mesh);
    Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 0.02, 1e-3);
    tool.move(map_of_tests.to_device(start), 0);
    BOOST_TEST((tool.move(map_of_tests.to_device(start), 1).event == Tool_event::grabbed));
    const double across = with_wall ? 0.4 + 0.2 * unit(random) : 0.2 * unit(random) - 0.1;
    const Vector3d way = ((with_wall ? 1.4 : 1.2) + 0.3 * unit(random)) * scene.down + across * scene.out +
                         (0.1 * unit(random) - 0.05) * scene.along;
    Vector3d last_force = Vector3d::Zero(), last_hand = map_of_tests.to_device(start);
    Tool_step step;
    const int ticks = 150;
    for (int k = 0; k <= ticks + 3; ++k) {
      const Vector3d hand = map_of_tests.to_device(start + way * std::min(1.0, double(k) / ticks));
      step = tool.move(hand, 1);
      const Vector3d force = force_of(step);
      const double jump = (force - last_force).norm(), moved = stiffness * (hand - last_hand).norm();
      if (moved > 0) {
        BOOST_TEST(jump <= 1.01 * moved + 1e-9);
        largest_jump = std::max(largest_jump, jump / moved);
      }
      if (step.reached)
        BOOST_TEST(force == Vector3d::Zero());
      last_force = force, last_hand = hand;
    }
    BOOST_TEST((step.target - first - way).norm() <= 1e-12); // the grab is anchored at the vertex
    const Side side = scene.held_side(kind);
    const Vector3d nearest =
        with_wall ? nearest_in_corner(side, scene.wall_side(), step.target) : side.nearest(step.target);
    const Vector3d exact = stiffness * map_of_tests.way_to_device(nearest - step.target);
    BOOST_TEST(step.contacts == (with_wall ? 2 : 1));
    BOOST_TEST(exact.norm() > 1);
    worst = std::max(worst, (last_force - exact).norm() / exact.norm());
  }
  BOOST_TEST_MESSAGE((kind == Obstacle::edge ? "edge" : "vertex")
                     << (with_wall ? " and wall" : "") << ", seed " << seed << ": static force off by at most " << worst
                     << " of itself; largest jump over k x step " << largest_jump);
  BOOST_TEST(worst <= 1e-9);
}

BOOST_AUTO_TEST_CASE(an_edge_that_holds_an_edge_pushes_normal_to_their_plane) {
  check_static_force(Obstacle::edge, false, 11);
}
BOOST_AUTO_TEST_CASE(a_vertex_that_holds_a_face_pushes_normal_to_it) {
  check_static_force(Obstacle::vertex, false, 12);
}
BOOST_AUTO_TEST_CASE(an_edge_and_a_plane_push_as_a_corner) {
  check_static_force(Obstacle::edge, true, 13);
}
BOOST_AUTO_TEST_CASE(a_vertex_and_a_plane_push_as_a_corner) {
  check_static_force(Obstacle::vertex, true, 14);
}

BOOST_AUTO_TEST_CASE(seams_of_a_plane_and_concave_edges_and_corners_are_not_felt_in_sliding) {
  Random random(haptic_sculpt::test::seed_from_environment(15));
  std::uniform_real_distribution<double> coordinate(-0.3, 1.3);
  double largest_jump = 0;
  meshes::Triangle_list list = meshes::box(1, 3), room = meshes::box(4, 1);
  list.scale_and_move(1, -1, -1, -1);
  list += room.turn_inside_out();
  Mesh mesh = meshes::to_mesh(list);
  Sculptor<Mesh> sculptor(mesh);
  Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 1e-3, 1e-3);
  Vector3d place(0.5, 0.5, 0.5), last_force = Vector3d::Zero();
  tool.move(map_of_tests.to_device(place), 0);
  for (int leg = 0; leg < 100; ++leg) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    const Vector3d way = (Vector3d(x, y, z) - place) / 100;
    for (int k = 0; k < 100; ++k) {
      place += way;
      const Tool_step step = tool.move(map_of_tests.to_device(place), 0);
      const Vector3d force = force_of(step);
      const double jump = (force - last_force).norm(), moved = stiffness * map_of_tests.way_to_device(way).norm();
      BOOST_TEST(jump <= 1.01 * moved + 1e-9);
      largest_jump = std::max(largest_jump, jump / moved);
      last_force = force;
      const Vector3d exact =
          stiffness * map_of_tests.way_to_device(step.target.cwiseMax(0.0).cwiseMin(1.0) - step.target);
      BOOST_TEST((force - exact).norm() <= 1e-9 * (1 + exact.norm()));
    }
  }
  BOOST_TEST_MESSAGE("sliding about a cavity of 4 x 4 cells a side: largest jump over k x step " << largest_jump);
}

BOOST_AUTO_TEST_CASE(over_a_convex_edge_the_force_jumps_by_the_fall_and_no_more) {
  for (const double half_width : {0.5, 1.0, 2.0, 4.0, 8.0, 20.0}) { // of the roof, over its height of 4
    const std::array<Vector3d, 4> roof{{{0, -9, 1}, {0, 9, 1}, {half_width, 0, -3}, {-half_width, 0, -3}}};
    Mesh mesh = meshes::to_mesh(tetrahedron_of(roof));
    const Vector3d right = Vector3d(4, 0, half_width).normalized(), left(-right[0], 0, right[2]);
    const Vector3d up = Vector3d(-half_width, 0, 4).normalized(), ridge(0, 0.1, 1);
    const Vector3d outside = ridge - 0.2 * up + 0.1 * right;
    Sculptor<Mesh> sculptor(mesh);
    Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 1e-3, 1e-3);
    tool.move(map_of_tests.to_device(outside), 0);
    const double depth = 0.04, length = 1e-3; // scene: 2 mm deep, steps of 0.05 mm
    for (int k = 1; k <= 140; ++k)
      tool.move(map_of_tests.to_device(outside - length * k * right), 0);
    Vector3d last = Vector3d::Zero();
    double largest = 0;
    for (int k = 1; k <= 300; ++k) {
      const Vector3d force = force_of(tool.move(map_of_tests.to_device(outside - 0.14 * right + length * k * up), 0));
      if (k > 1)
        largest = std::max(largest, (force - last).norm());
      last = force;
    }
    // At the ridge the target is `depth` below the right plane, and depth * cosine below the left one, or above it.
    const double cosine = left.dot(right);
    const double fall = cosine > 0 ? depth * std::sqrt(1 - cosine * cosine) : depth;
    const double own = stiffness * fall / map_of_tests.scale(), step = stiffness * length / map_of_tests.scale();
    BOOST_TEST_MESSAGE("convex edge, its faces turned by " << std::acos(cosine) * 180 / M_PI << " degrees: jump "
                                                           << largest << " N, the surface's own " << own
                                                           << " N, k x step " << step << " N");
    BOOST_TEST(std::abs(largest - own) <= 2.02 * step);
  }
}

BOOST_AUTO_TEST_CASE(facets_are_felt_as_fine_as_they_are) {
  const Workspace_map map(1 / 0.03, Vector3d::Zero(), Vector3d::Zero(), Vector3d(0, 0, 0.132)); // a ball of 30 mm
  const Virtual_coupling coupling{1000, 0};
  double last_jump = 1;
  for (const int level : {2, 3, 4, 5}) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(level));
    const std::size_t faces = mesh.number_of_faces();
    Sculptor<Mesh> sculptor(mesh);
    Tool<Sculptor<Mesh>> tool(sculptor, map, 1e-3, 1e-3);
    const auto force_at = [&](double radius, double angle, double tilt) {
      const Vector3d place(radius * std::sin(angle), radius * std::cos(angle) * tilt,
                           radius * std::cos(angle) * std::sqrt(1 - tilt * tilt));
      const Tool_step step = tool.move(map.to_device(place), 0);
      return coupling.force(map, step.proxy, step.target, step.reached);
    };
    for (int k = 0; k <= 100; ++k)
      force_at(1.2 - k * (0.2 + 0.002 / 0.03) / 100, 0, 0.2);
    Vector3d last = Vector3d::Zero();
    double jump = 0, turn = 0;
    for (int k = 0; k <= 4000; ++k) {
      const Vector3d force = force_at(1 - 0.002 / 0.03, k * 2.5e-4, 0.2);
      if (k > 0) {
        jump = std::max(jump, (force - last).norm() / force.norm());
        turn = std::max(turn, std::atan2(force.cross(last).norm(), force.dot(last)) * 180 / M_PI);
      }
      last = force;
    }
    BOOST_TEST_MESSAGE("ball of 30 mm, " << faces << " triangles, 2 N: jumps by " << 100 * jump << " % and " << turn
                                         << " degrees");
    BOOST_TEST(jump < last_jump);
    last_jump = jump;
  }
}

BOOST_AUTO_TEST_CASE(in_motion_the_force_lags_by_what_holding_explains_and_is_of_first_order_in_the_tick) {
  std::uint64_t seed = 20;
  for (const double delay : {0.0, 0.5, 1.0, 1.75})
    for (const double speed : {0.01, 0.06, 0.3}) {
      double largest_ratio = 0, felt_ratio = 0;
      for (const double rate : {250.0, 1000.0, 4000.0, 10000.0})
        for (const bool is_normal : {true, false}) {
          const Force_error error = error_of({rate, delay, speed, 0, is_normal}, ++seed);
          const double unit = stiffness * speed / rate, rounding = 1e-9 * stiffness;
          BOOST_TEST(error.mean <= unit * (0.5 + delay) + rounding);
          BOOST_TEST(error.largest <= unit * (1 + delay) + rounding);
          if (is_normal) // of first order: the same multiple of T at all rates
            BOOST_TEST(std::abs(error.mean / unit - (0.5 + delay)) <= 1e-6);
          largest_ratio = std::max(largest_ratio, error.largest / unit);
          felt_ratio = std::max(felt_ratio, error.felt_mean / unit);
        }
      BOOST_TEST_MESSAGE("delay " << delay << ", " << 1e3 * speed << " mm/s, 250 Hz to 10 kHz: mean error "
                                  << 0.5 + delay << " k v T, largest " << largest_ratio
                                  << " k v T; as J turns under held torques, mean up to " << felt_ratio << " k v T");
    }
}

BOOST_AUTO_TEST_CASE(encoders_add_their_share_to_the_error_of_the_force) {
  std::uint64_t seed = 60;
  for (const double rate : {250.0, 1000.0, 10000.0})
    for (const double speed : {0.01, 0.06, 0.3}) {
      const double step = 1.53e-4, unit = stiffness * speed / rate;
      const Force_error error = error_of({rate, 0.5, speed, step, false}, ++seed);
      const double share = error.greatest * step * stiffness;
      BOOST_TEST(error.mean <= unit * 1.0 + share);
      BOOST_TEST(error.largest <= unit * 1.5 + share);
      BOOST_TEST_MESSAGE(rate << " Hz, " << 1e3 * speed << " mm/s with encoders: mean error " << 1e3 * error.mean
                              << " mN, largest " << 1e3 * error.largest << ", k v T " << 1e3 * unit
                              << ", share of an encoder step " << 1e3 * share);
    }
}

BOOST_AUTO_TEST_CASE(what_is_grabbed_is_heavy_and_nothing_else_is) {
  Device_description<double> description = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  description.viscous_friction = 0.02;
  const Device_parameters<double> device(description);
  const auto home = home_pose(device);
  const Workspace_map map(20, Vector3d(0.3, -0.2, 0.9), Vector3d(0, 0, -0.02), home->position);
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  Sculptor<Mesh> sculptor(mesh);
  Haptic_parameters parameters;
  const double mass = 0.005; // kg; near home 18 g are the most that serve, and less far from it
  parameters.virtual_mass.mass = mass, parameters.limits.ramp_time = 1e-9, parameters.reach = 0.002;
  Haptic_loop<Sculptor<Mesh>> loop(sculptor, device, *home, map, parameters);
  const Vector3d away = -map.direction_to_device(Vector3d(1, 1, 1)).normalized();
  const double omega = 2 * M_PI * 3, amplitude = 0.002;
  Device_pose<double> pose = *home;
  double worst = 0, largest = 0, worst_energy = 0, largest_energy = 0;
  for (int k = 0; k < 1200; ++k) { // shaken in free space, at rest and grabbed at 500, shaken again from 700
    const double t = k * 1e-3, swing = k < 334 ? t : k < 700 ? 0 : t - 0.7;
    pose = *reach_position(device, pose, Vector3d(home->position + amplitude * (1 - std::cos(omega * swing)) * away));
    Joint_reading reading;
    reading.theta = pose.theta, reading.elapsed = k == 0 ? 0 : 1e-3, reading.button = k < 500 ? 0 : 1;
    const Haptic_tick& made = loop.tick(reading);
    BOOST_REQUIRE((made.fault == Loop_fault::none));
    BOOST_TEST(made.tool.reached);
    if (k < 500)
      BOOST_TEST(made.rendered.force == Vector3d::Zero());
    if (k == 500)
      BOOST_TEST((made.tool.event == Tool_event::grabbed));
    if (k < 900)
      continue; // the acceleration begins with a step, which low-passes follow
    const Vector3d exact = -mass * amplitude * omega * omega * std::cos(omega * swing) * away;
    worst = std::max(worst, (made.rendered.force - exact).norm()), largest = std::max(largest, exact.norm());
    const double kinetic = mass * std::pow(amplitude * omega * std::sin(omega * swing), 2) / 2;
    worst_energy = std::max(worst_energy, std::abs(loop.interaction().virtual_mass().energy() - kinetic));
    largest_energy = std::max(largest_energy, kinetic);
  }
  BOOST_TEST_MESSAGE("a vertex of 5 g in the loop: force off by " << 100 * worst / largest << " %, its energy by "
                                                                   << 100 * worst_energy / largest_energy << " %");
  BOOST_TEST(worst <= 0.01 * largest);
  BOOST_TEST(worst_energy <= 0.1 * largest_energy);
}

} // namespace
