// SPDX-License-Identifier: GPL-3.0-or-later
// The tool and the tick of the loop on meshes whose forces are known.
#include "haptic_rendering/map_of_tests.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/haptic_rendering.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Side_of_triangle_mesh.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace haptic_sculpt;
using haptic_rendering_tests::map_of_tests;
using Eigen::Vector3d;
using Mesh = meshes::Mesh;

namespace {

using Random = std::mt19937_64;

/// A cube of edge 3 with a cavity of edge 1, [0, 1]^3, in it: planes, concave edges and corners for a probe.
struct Cavity {
  Mesh mesh;
  Cavity() {
    meshes::Triangle_list list = meshes::box(1, 3), room = meshes::box(3, 1);
    list.scale_and_move(1, -1, -1, -1);
    list += room.turn_inside_out();
    mesh = meshes::to_mesh(list);
  }
};

BOOST_AUTO_TEST_CASE(the_static_force_is_that_of_planes_concave_edges_and_corners) {
  Random random(haptic_sculpt::test::seed_from_environment(1));
  std::uniform_real_distribution<double> inside(0.05, 0.95), beyond(0.01, 0.4);
  const Virtual_coupling coupling{700, 0};
  double worst = 0, largest_jump = 0;
  std::size_t blocked[4] = {};
  for (int round = 0; round < 200; ++round) {
    Cavity scene;
    Sculptor<Mesh> sculptor(scene.mesh);
    Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 1e-3, 1e-3);
    Vector3d target;
    int walls = 0;
    for (int i = 0; i < 3; ++i) {
      const double coordinate = inside(random), over = beyond(random);
      const bool is_beyond = random() % 2 == 0;
      walls += is_beyond;
      target[i] = !is_beyond ? coordinate : random() % 2 == 0 ? 1 + over : -over;
    }
    ++blocked[walls];
    const Vector3d start(0.5, 0.5, 0.5), nearest = target.cwiseMax(0.0).cwiseMin(1.0);
    Vector3d last_force = Vector3d::Zero(), last_hand = map_of_tests.to_device(start);
    const int ticks = 100;
    for (int k = 0; k <= ticks + 3; ++k) {
      const Vector3d hand = map_of_tests.to_device(start + (target - start) * std::min(1.0, double(k) / ticks));
      const Tool_step step = tool.move(hand, 0);
      const Vector3d force = coupling.force(map_of_tests, step.proxy, step.target, step.reached);
      BOOST_TEST((step.proxy - step.target).isZero(0) == step.reached);
      const Vector3d true_target = map_of_tests.to_scene(hand), held = true_target.cwiseMax(0.0).cwiseMin(1.0);
      if (held == true_target)
        BOOST_TEST(force == Vector3d::Zero()); // free motion
      const double jump = (force - last_force).norm(), way = 700 * (hand - last_hand).norm();
      if (way > 0) {
        BOOST_TEST(jump <= 1.01 * way + 1e-9);
        largest_jump = std::max(largest_jump, jump / way);
      }
      last_force = force, last_hand = hand;
    }
    const Vector3d exact = 700 * map_of_tests.way_to_device(nearest - target);
    if (walls > 0)
      worst = std::max(worst, (last_force - exact).norm() / exact.norm());
  }
  BOOST_TEST_MESSAGE("static force off by at most " << worst << " of itself; largest jump over k x step "
                                                    << largest_jump);
  BOOST_TEST(worst <= 1e-9);
  for (const std::size_t n : blocked)
    BOOST_TEST(n >= 4u); // of 200, an eighth for two of them
}

BOOST_AUTO_TEST_CASE(a_vertex_let_go_of_in_a_thin_pit_leaves_the_probe_outside) {
  Random random(haptic_sculpt::test::seed_from_environment(4));
  std::uniform_real_distribution<double> number(-0.5, 0.5);
  for (int round = 0; round < 6; ++round) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(5));
    const Vector3d above(0.3 * number(random), 0.3 * number(random), 1.1), touching = above - Vector3d(0, 0, 0.15);
    Sculptor<Mesh> sculptor(mesh);
    Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 1e-4, 1e-3); // reach 0.002 in the scene
    const auto move = [&](const Vector3d& place, int button) {
      return tool.move(map_of_tests.to_device(place), button);
    };
    for (int k = 0; k <= 50; ++k)
      move(above + k / 50. * (touching - above), 0);
    move(touching, 1);
    BOOST_TEST(tool.holds_vertex());
    const Vector3d way(number(random), number(random), -1.2); // through the inside, to all but the other side
    for (int k = 1; k <= 200; ++k)
      move(touching + k / 200. * way, 1);
    BOOST_TEST((move(touching + way, 0).event == Tool_event::released));
    BOOST_TEST((!tool.holds_vertex() && !tool.holds_probe()));
    int ticks = 0; // one place a tick is tried: three near by, then behind sixteen surfaces in two directions
    while (!tool.holds_probe() && ticks < 3 + 2 * 16) {
      const Tool_step step = move(touching + way, 0);
      BOOST_TEST((step.reached && step.proxy == step.target)); // no force meanwhile
      ++ticks;
    }
    BOOST_TEST_MESSAGE("the probe has a place after " << ticks << " ticks");
    BOOST_REQUIRE(tool.holds_probe());
    const CGAL::Side_of_triangle_mesh<Mesh, meshes::Kernel> side(mesh);
    BOOST_TEST((side(tool.probe()->position()) == CGAL::ON_UNBOUNDED_SIDE));
  }
}

BOOST_AUTO_TEST_CASE(a_grabbed_vertex_is_felt_where_it_meets_a_plane) {
  meshes::Triangle_list list = meshes::box(2, 1), above = meshes::tetrahedron(); // its corner (0, 0, 0) will be the tip
  above.transform([](const meshes::Point_3& p) {
    return meshes::Point_3(0.45 + 0.3 * p.x(), 0.4 + 0.3 * p.y(), 1.2 + 0.3 * p.z());
  });
  list += above;
  Mesh mesh = meshes::to_mesh(list);
  Sculptor<Mesh> sculptor(mesh);
  Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 0.02, 1e-3);
  tool.move(map_of_tests.to_device(Vector3d(0.45, 0.4, 1.1)), 0);
  Tool_step step = tool.move(map_of_tests.to_device(Vector3d(0.45, 0.4, 1.1)), 1);
  BOOST_TEST((step.event == Tool_event::grabbed));
  BOOST_TEST(step.reached); // anchored: no force
  BOOST_TEST((step.target - Vector3d(0.45, 0.4, 1.2)).norm() <= 1e-14);
  for (int k = 0; k <= 60; ++k)
    step = tool.move(map_of_tests.to_device(Vector3d(0.45, 0.4, 1.1 - 0.01 * k)), 1);
  BOOST_TEST(!step.reached);
  const Vector3d force = Virtual_coupling{700, 0}.force(map_of_tests, step.proxy, step.target, step.reached);
  const Vector3d exact = 700 * map_of_tests.way_to_device(Vector3d(0, 0, 1 - 0.6));
  BOOST_TEST((force - exact).norm() <= 1e-9 * exact.norm());
  step = tool.move(map_of_tests.to_device(Vector3d(0.45, 0.4, 0.9)), 0);
  BOOST_TEST((step.event == Tool_event::released));
  BOOST_TEST((step.reached && step.proxy == step.target)); // no force
  for (int k = 0; k < 35 && !tool.holds_probe(); ++k)
    step = tool.move(map_of_tests.to_device(Vector3d(0.45, 0.4, 0.9)), 0);
  BOOST_TEST((tool.holds_probe() && step.reached));
  BOOST_TEST((step.proxy - step.target).norm() <= 1e-12); // the probe is anchored again
}

BOOST_AUTO_TEST_CASE(a_button_creates_where_the_probe_touches_and_removes_and_is_refused) {
  Mesh mesh = meshes::to_mesh(meshes::box(1, 1));
  Sculptor<Mesh> sculptor(mesh);
  Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 1e-3, 1e-3); // reach 0.02 in the scene
  const auto move = [&](double x, double y, double z, int button) {
    return tool.move(map_of_tests.to_device(Vector3d(x, y, z)), button);
  };
  move(0.3, 0.6, 1.5, 0);
  BOOST_TEST((move(0.3, 0.6, 1.4, 1).event == Tool_event::refused)); // nothing there
  move(0.3, 0.6, 1.4, 0);
  for (int k = 0; k < 50; ++k)
    move(0.3, 0.6, 1.4 - 0.01 * k, 0);
  BOOST_TEST((move(0.3, 0.6, 0.9, 1).event == Tool_event::created_on_face));
  BOOST_TEST(mesh.number_of_faces() == 14u);
  for (int k = 0; k < 50; ++k)
    move(0.3, 0.6, 0.9 + 0.01 * k, 1);
  move(0.3, 0.6, 1.4, 0);
  BOOST_TEST((move(0.3, 0.6, 1.4, 2).event == Tool_event::removed));
  BOOST_TEST(mesh.number_of_faces() == 12u);
  move(0.3, 0.6, 1.6, 0);
  for (int k = 0; k < 80; ++k) // on the diagonal
    move(0.5, 0.5, 1.6 - 0.01 * k, 0);
  BOOST_TEST((move(0.5, 0.5, 0.8, 1).event == Tool_event::created_on_edge));
  BOOST_TEST(tool.edits().created == 2u);
  BOOST_TEST(validate(mesh).is_valid());
}

/// A bumpy ball, the device's simulated run on it, everything that came of it.
struct Loop_run {
  std::vector<Joint_reading> readings;
  std::vector<Vector3d> torques, forces;
  std::vector<double> ways; // of the handle, m
  std::vector<Mesh::Point> points;
  Loop_fault fault = Loop_fault::none;
  bool has_stopped = false, is_valid = false, has_touched = false;
  std::size_t edits = 0;
};

/// \param spoil changes a reading before the loop sees it \param given replaces the device
template <class Spoil>
Loop_run run_loop(double seconds, const Spoil& spoil, const std::vector<Joint_reading>* given = nullptr) {
  Loop_run run;
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
  Sculptor<Mesh> sculptor(mesh);
  Device_description<double> description = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  description.viscous_friction = 0.006, description.encoder_step = 1.53e-4;
  const Device_parameters<double> device(description);
  const auto home = home_pose(device);
  const Workspace_map map(50, Vector3d::Zero(), Vector3d(0, 0, 0.9), home->position);
  const auto place = [&](double x, double y, double z) { return map.to_device(Vector3d(x, y, z)); };
  const Hand_path path({{0, place(0, 0, 1.4), 0},
                        {0.3, place(0, 0, 1.4), 0},
                        {0.5, place(0, 0, 0.9), 0},
                        {0.7, place(0.2, 0.1, 0.85), 0},
                        {0.8, place(0.2, 0.1, 0.85), 1},
                        {1.2, place(0.3, 0.2, 1.3), 1},
                        {1.5, place(0.3, 0.2, 1.3), 0}});
  Haptic_parameters parameters;
  parameters.reach = 0.004;
  static const Passivity_limits limits = // the same in all runs
      passivity_limits(device, parameters.limits, map, Vector3d(-1, -1, 0), Vector3d(1, 1, 1.5), 0, 0.001, 0);
  Haptic_loop<Sculptor<Mesh>> loop(sculptor, device, *reach_position(device, *home, path.at(0).position), map,
                                   parameters, limits);
  Simulated_device simulated(device, *reach_position(device, *home, path.at(0).position), Simulated_hand::finger(),
                             path, 0.001, 0);
  const std::size_t ticks = given != nullptr ? given->size() : static_cast<std::size_t>(seconds * 1000);
  for (std::size_t k = 0; k < ticks && !run.has_stopped; ++k) {
    Joint_reading reading = given != nullptr ? (*given)[k] : simulated.read();
    if (given == nullptr)
      spoil(reading, k);
    const Haptic_tick& tick = loop.tick(reading);
    run.readings.push_back(reading);
    run.ways.push_back(loop.handle().step().norm());
    run.torques.push_back(tick.rendered.torque), run.forces.push_back(tick.rendered.force);
    run.has_touched = run.has_touched || !tick.tool.reached;
    run.fault = tick.fault, run.has_stopped = loop.has_stopped();
    if (given == nullptr)
      simulated.write(tick.rendered.torque, tick.rendered.interaction_torque);
  }
  run.edits = loop.tool().edits().grabbed + loop.tool().edits().created;
  run.is_valid = validate(mesh).is_valid();
  for (const auto v : mesh.vertices())
    run.points.push_back(mesh.point(v));
  return run;
}

const auto nothing_wrong = [](Joint_reading&, std::size_t) {};

BOOST_AUTO_TEST_CASE(a_run_that_is_replayed_has_the_same_bits) {
  const Loop_run first = run_loop(1.5, nothing_wrong), second = run_loop(0, nothing_wrong, &first.readings);
  BOOST_TEST((first.fault == Loop_fault::none));
  BOOST_TEST(first.has_touched);
  BOOST_TEST(first.is_valid);
  BOOST_TEST(first.edits == 1u);
  BOOST_TEST((first.points == second.points));
  BOOST_TEST((first.torques == second.torques));
  BOOST_TEST((first.forces == second.forces));
  double largest = 0, change = 0; // beside what the handle's way makes of the spring
  for (std::size_t k = 1; k < first.forces.size(); ++k)
    largest = std::max(largest, first.forces[k].norm()),
    change = std::max(change, (first.forces[k] - first.forces[k - 1]).norm() - 500 * first.ways[k]);
  BOOST_TEST(largest > 0.1);
  BOOST_TEST(change <= 0.304); // the slew limit, and a tick of the ramp of at most 2 N
}

BOOST_AUTO_TEST_CASE(every_fault_ends_at_no_force_with_a_valid_mesh) {
  const auto check = [](Loop_fault expected, const auto& spoil) {
    const Loop_run run = run_loop(1.5, [&](Joint_reading& reading, std::size_t k) {
      if (k == 600) // pressed on, or nearly
        spoil(reading);
    });
    BOOST_TEST((run.fault == expected), name_of(run.fault) << " in place of " << name_of(expected));
    BOOST_TEST(run.has_stopped);
    BOOST_TEST(run.is_valid);
    BOOST_TEST(run.forces[599].norm() > 0.01);
    BOOST_TEST(run.forces.back() == Vector3d::Zero());
    BOOST_TEST(run.torques.back() == Vector3d::Zero());
    for (std::size_t k = 600; k < run.forces.size(); ++k)
      BOOST_TEST(run.forces[k].norm() <= run.forces[k - 1].norm() + 1e-12);
  };
  check(Loop_fault::not_finite, [](Joint_reading& r) { r.theta[2] = NAN; });
  check(Loop_fault::jump, [](Joint_reading& r) { r.theta[1] += 0.5; });
  check(Loop_fault::stall, [](Joint_reading& r) { r.elapsed = 0.05; });
  check(Loop_fault::torque, [](Joint_reading& r) { r.torque[0] = 0.4; });
  check(Loop_fault::clock, [](Joint_reading& r) { r.elapsed = 0; });
  check(Loop_fault::clock, [](Joint_reading& r) { r.elapsed = NAN; });
}

BOOST_AUTO_TEST_CASE(a_loop_of_joints_that_is_late_lets_go) {
  const Loop_run run = run_loop(1.5, [](Joint_reading& reading, std::size_t k) {
    if (k >= 600)
      reading.elapsed = 0.005; // five ticks: the mean of 64 is above 1.5 in the ninth
  });
  BOOST_TEST((run.fault == Loop_fault::late), name_of(run.fault));
  BOOST_TEST(run.forces[599].norm() > 0.01);
  BOOST_TEST(run.has_stopped);
  BOOST_TEST(run.is_valid);
  BOOST_TEST(run.forces.back() == Vector3d::Zero());
  BOOST_TEST(run.torques.back() == Vector3d::Zero());
  BOOST_TEST(run.forces.size() >= 609u);
  BOOST_TEST(run.forces.size() <= 609u + 21); // the fade of 100 ms, by the clock
}

} // namespace
