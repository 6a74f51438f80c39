// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptic_rendering/pose_readings.h"
#include "meshes/generated_meshes.h"
#include "sculpting/public_functions/Callers_mode.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace haptic_sculpt;
using namespace exchange_tests;
using Mesh = meshes::Mesh;

namespace {

BOOST_AUTO_TEST_CASE(a_device_of_pose_and_force_feels_a_wall_and_its_faults_end_at_no_force) {
  for (const int fault : {0, 1, 2}) {
    Mesh mesh = meshes::to_mesh(meshes::box(1, 1)); // [0, 1]^3
    Sculptor<Mesh> sculptor(mesh);
    Pose_loop_parameters parameters = parameters_of_tests();
    parameters.coupling.stiffness = 4001;
    BOOST_CHECK_THROW(Pose_loop<Sculptor<Mesh>>(sculptor, map_of_tests, parameters), Error);
    parameters.coupling.stiffness = 700;
    Pose_loop<Sculptor<Mesh>> loop(sculptor, map_of_tests, parameters);
    Pose_reading reading;
    const auto go = [&](double z) {
      reading.position = map_of_tests.to_device(Vector3d(0.5, 0.4, z)), reading.elapsed = 0.001;
      return loop.tick(reading);
    };
    for (int k = 0; k < 400; ++k)
      BOOST_TEST(go(1.4).rendered.force == Vector3d::Zero());
    Pose_tick tick;
    for (int k = 0; k <= 200; ++k)
      tick = go(1.4 - 0.0025 * k);
    for (int k = 0; k < 50; ++k)
      tick = go(0.9);
    BOOST_TEST((tick.rendered.force - Vector3d(0, 0, 700 * 0.1 / 50)).norm() <= 1e-9);
    reading.position[0] += fault == 0 ? NAN : fault == 1 ? 0.5 : 0, reading.elapsed = fault == 2 ? 0.1 : 0.001;
    tick = loop.tick(reading);
    BOOST_TEST((tick.fault == (fault == 0   ? Loop_fault::not_finite
                               : fault == 1 ? Loop_fault::jump
                                            : Loop_fault::stall)));
    for (int k = 0; k < 101; ++k)
      tick = go(0.9);
    BOOST_TEST(tick.rendered.force == Vector3d::Zero());
    BOOST_TEST(loop.has_stopped());
    loop.restart();
    BOOST_TEST(go(0.9).rendered.force == Vector3d::Zero()); // anchored
    BOOST_TEST(!loop.has_stopped());
  }
}

struct Ball_loop {
  Mesh mesh = meshes::to_mesh(meshes::box(1, 1)); // [0, 1]^3
  Sculptor<Mesh> sculptor{mesh};
  Pose_loop<Sculptor<Mesh>> loop;
  explicit Ball_loop(const Pose_loop_parameters& parameters) : loop(sculptor, map_of_tests, parameters) {}
  const Haptic_tick& go(double z, double elapsed = 0.001) {
    Pose_reading reading;
    reading.position = map_of_tests.to_device(Vector3d(0.5, 0.4, z)), reading.elapsed = elapsed;
    return loop.tick(reading);
  }
};

BOOST_AUTO_TEST_CASE(what_throws_in_a_tick_is_a_fault_that_fades) {
  Ball_loop b(parameters_of_tests());
  static_assert(noexcept(b.loop.tick(std::declval<const Pose_reading&>())), "a driver may call it from C");
  for (int k = 0; k < 500; ++k)
    b.go(1.4 - 0.001 * k);
  for (int k = 0; k < 400; ++k)
    b.go(0.9);
  const double before = b.go(0.9).rendered.force.norm();
  BOOST_TEST(before > 0.5);
  b.mesh.point(*b.mesh.vertices_begin()) = Mesh::Point(-0.1, -0.1, -0.1); // by others: drags throw
  const Mesh::Vertex_index extra = b.mesh.add_vertex(Mesh::Point(9, 9, 9));
  (void)extra;
  const Haptic_tick& tick = b.go(0.9);
  BOOST_TEST((tick.fault == Loop_fault::error));
  const std::string first = b.loop.failure();
  BOOST_TEST(first != "");
  b.loop.attempt([] { throw Error("what came of it"); });
  BOOST_TEST(b.loop.failure() == first);
  BOOST_TEST(tick.rendered.force.norm() < before);
  BOOST_TEST(tick.rendered.force.norm() > 0.9 * before);
  for (int k = 0; k < 101; ++k)
    b.go(0.9);
  BOOST_TEST(tick.rendered.force == Vector3d::Zero());
  BOOST_TEST(b.loop.has_stopped());
}

BOOST_AUTO_TEST_CASE(places_beyond_all_numbers_are_faults_also_where_no_speed_is_a_jump) {
  for (const double z : {1e305, -1e305, 1e308}) {
    Pose_loop_parameters parameters = Pose_loop_parameters::without_force();
    parameters.speed = std::numeric_limits<double>::infinity();
    Ball_loop b(parameters);
    for (int k = 0; k < 10; ++k)
      b.go(1.4);
    const Haptic_tick& tick = b.go(z);
    BOOST_TEST((tick.fault == Loop_fault::error || tick.fault == Loop_fault::not_finite), name_of(tick.fault));
    BOOST_TEST(tick.rendered.force.allFinite());
    b.loop.restart();
    BOOST_TEST((b.go(1.4).fault == Loop_fault::none));
  }
}

BOOST_AUTO_TEST_CASE(a_reading_whose_place_in_the_scene_overflows_is_a_fault_and_the_tick_has_finite_places) {
  for (const bool is_clutch_open : {false, true}) {
    Mesh mesh = meshes::to_mesh(meshes::box(1, 1));
    Sculptor<Mesh> sculptor(mesh);
    Pose_loop_parameters parameters = Pose_loop_parameters::without_force();
    parameters.speed = std::numeric_limits<double>::infinity();
    Pose_loop<Sculptor<Mesh>> loop(sculptor, map_of_tests, parameters);
    loop.open_clutch(is_clutch_open);
    Pose_reading reading;
    reading.position = Vector3d(0, 0, 1.7e308), reading.elapsed = 0.001; // at its first, nothing is a jump
    const auto& tick = loop.tick(reading);
    BOOST_TEST((tick.fault == Loop_fault::not_finite), name_of(tick.fault));
    BOOST_TEST((tick.tool.target.allFinite() && tick.tool.proxy.allFinite()));
  }
}

BOOST_AUTO_TEST_CASE(a_step_whose_energy_no_hand_has_is_a_fault_after_which_energy_is_seen_again) {
  Pose_loop_parameters parameters = parameters_of_tests();
  parameters.speed = std::numeric_limits<double>::infinity();
  for (const double far : {1e7, 1e10, 1e155}) { // at the least, all that a hand does is lost in the rounding
    Ball_loop b(parameters);
    for (int k = 0; k < 10; ++k)
      b.go(1.4);
    const Haptic_tick& tick = b.go(far);
    BOOST_TEST((tick.fault == Loop_fault::not_finite), name_of(tick.fault));
    BOOST_TEST(b.loop.interaction().observer().is_blind());
    b.loop.restart();
    for (int k = 0; k < 10; ++k)
      BOOST_TEST((b.go(1.4).fault == Loop_fault::none));
    BOOST_TEST(!b.loop.interaction().observer().is_blind());
    BOOST_TEST(std::abs(b.loop.interaction().observer().balance()) < 1);
  }
}

BOOST_AUTO_TEST_CASE(parameters_are_checked_where_they_are_given) {
  const double inf = std::numeric_limits<double>::infinity();
  const auto refuses = [](const std::string& member, const auto& change) {
    Pose_loop_parameters parameters(2);
    change(parameters);
    BOOST_CHECK_EXCEPTION(Ball_loop{parameters}, Error, [&](const Error& error) {
      BOOST_TEST_MESSAGE(error.what());
      return std::string(error.what()).find(member) != std::string::npos;
    });
  };
  using P = Pose_loop_parameters;
  for (const double bad : {std::nan(""), inf, -1.0}) {
    refuses("tick", [&](P& p) { p.tick = bad; });
    refuses("stiffness", [&](P& p) { p.coupling.stiffness = bad; });
    refuses("damping", [&](P& p) { p.coupling.damping = bad; });
    refuses("Force_limits::slew", [&](P& p) { p.limits.slew = bad; });
    refuses("Force_limits::largest", [&](P& p) { p.limits.largest = bad; });
    refuses("Force_limits::ramp_time", [&](P& p) { p.limits.ramp_time = bad; });
    refuses("Force_limits::fade_time", [&](P& p) { p.limits.fade_time = bad; });
    refuses("Pose_device::mass", [&](P& p) { p.device.mass = bad; });
    refuses("Pose_device::resolution", [&](P& p) { p.device.resolution = bad; });
    refuses("delay", [&](P& p) { p.delay = bad; });
    refuses("Pose_loop_parameters::stall_time", [&](P& p) { p.stall_time = bad; });
    refuses("controller_damping", [&](P& p) { p.controller_damping = bad; });
    refuses("reach", [&](P& p) { p.reach = bad; });
    refuses("button_quiet_time", [&](P& p) { p.button_quiet_time = bad; });
  }
  refuses("tick", [](P& p) { p.tick = 0; });
  refuses("work_limit", [](P& p) { p.work_limit = 0; });
  refuses("work_of_a_face", [](P& p) { p.work_of_a_face = std::numeric_limits<std::size_t>::max(); });
  refuses("Pose_device::friction", [](P& p) { p.device.friction = -1; });
  refuses("Pose_device::friction", [](P& p) { p.device.friction = NAN; });
  refuses("Pose_device::friction", [&](P& p) { p = P(inf); }); // no way to say "no force"
  refuses("Pose_device::friction", [&](P& p) { p.device.friction = inf; });
  P mouse = P::without_force();
  BOOST_TEST((!mouse.has_force() && mouse.passive_stiffness() == inf && mouse.calm_stiffness() == inf));
  BOOST_TEST((mouse.device.friction == 0 && P(0).has_force() && P(0).passive_stiffness() == 0));
  mouse.stall_time = 0; // whatever it is
  Ball_loop{mouse};
  mouse.device.mass = NAN;
  BOOST_CHECK_THROW(Ball_loop{mouse}, Error);
  for (const double bad : {std::nan(""), inf, -1.0})
    BOOST_CHECK_THROW(Pose_side(Pose_device(bad), Haptic_parameters()), Error); // checked by itself, too
  refuses("Pose_loop_parameters::speed", [](P& p) { p.speed = NAN; });
  refuses("damping", [](P& p) { p.coupling.damping = 2.1; }); // more than the friction
  Ball_loop{Pose_loop_parameters(2)};
}

BOOST_AUTO_TEST_CASE(a_clock_that_says_no_time_and_ticks_that_are_late_are_faults) {
  for (const double elapsed : {0.0, -0.001, std::nan(""), std::numeric_limits<double>::infinity()}) {
    Ball_loop b(parameters_of_tests());
    BOOST_TEST((b.go(1.4, elapsed).fault == Loop_fault::none)); // the first has none before it
    BOOST_TEST((b.go(1.4, elapsed).fault == Loop_fault::clock));
    b.loop.restart();
    BOOST_TEST((b.go(1.4, elapsed).fault == Loop_fault::none));
  }
  Ball_loop late(parameters_of_tests());
  int ticks = 0;
  while (late.go(1.4, 0.01).fault == Loop_fault::none && ticks < 100)
    ++ticks;
  BOOST_TEST(ticks <= 6);
  BOOST_TEST((late.go(1.4).fault == Loop_fault::late));
  Ball_loop hiccup(parameters_of_tests()), mouse(Pose_loop_parameters::without_force());
  for (int k = 0; k < 2000; ++k) {
    BOOST_TEST((hiccup.go(1.4, k % 100 == 99 ? 0.019 : 0.0011).fault == Loop_fault::none));
    BOOST_TEST((mouse.go(1.4, k % 100 == 99 ? 0.5 : 0.015).fault == Loop_fault::none)); // without force nothing swings
  }
}

// By then the device has let go by its own timeout: what came back would push the hand. A late reading that is bad is
// no better.
BOOST_AUTO_TEST_CASE(after_a_stall_no_force_comes_back) {
  for (const bool is_finite : {true, false}) {
    Ball_loop b(parameters_of_tests());
    for (int k = 0; k < 1000; ++k)
      b.go(1.4 - 0.0006 * k);
    BOOST_REQUIRE(b.go(0.8).rendered.force.norm() > 0.1);
    const Haptic_tick& stalled = b.go(is_finite ? 0.8 : NAN, 0.025);
    BOOST_TEST((stalled.fault == (is_finite ? Loop_fault::stall : Loop_fault::not_finite)));
    BOOST_TEST(stalled.rendered.force == Eigen::Vector3d::Zero());
    BOOST_TEST(b.loop.has_stopped());
    BOOST_TEST(b.go(0.8).rendered.force == Eigen::Vector3d::Zero());
  }
  for (const auto fault : {Loop_fault::stall, Loop_fault::log}) { // by a driver, and while a force fades
    Ball_loop b(parameters_of_tests());
    for (int k = 0; k < 1000; ++k)
      b.go(1.4 - 0.0006 * k);
    b.loop.end_by(fault);
    BOOST_TEST((b.go(0.8).rendered.force.norm() > 0.1) == (fault == Loop_fault::log));
    BOOST_TEST((b.go(0.8, 0.019).rendered.force.norm() > 0.1) == (fault == Loop_fault::log));
    BOOST_TEST(b.go(0.8, 0.025).rendered.force == Eigen::Vector3d::Zero());
    BOOST_TEST(b.loop.has_stopped());
  }
}

/// Two cones over one ring of this many vertices; the upper tip is (0, 0, 1), the first vertex.
Mesh double_cone(int valence) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> ring;
  const auto tip = mesh.add_vertex(Mesh::Point(0, 0, 1)), bottom = mesh.add_vertex(Mesh::Point(0, 0, -1));
  for (int i = 0; i < valence; ++i) {
    const double angle = 2 * M_PI * i / valence;
    ring.push_back(mesh.add_vertex(Mesh::Point(std::cos(angle), std::sin(angle), 0)));
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto a = ring[i], b = ring[(i + 1) % ring.size()];
    mesh.add_face(tip, a, b), mesh.add_face(bottom, b, a);
  }
  return mesh;
}

BOOST_AUTO_TEST_CASE(a_vertex_of_any_valence_follows_the_hand_and_one_that_is_cut_short_has_no_spring) {
  for (const int valence : {6, 300, 1000})
    for (const bool is_bound : {false, true}) {
      Mesh mesh = double_cone(valence);
      const auto tip = *mesh.vertices().begin();
      Sculptor<Mesh> sculptor(mesh);
      auto parameters = parameters_of_tests();
      if (is_bound) // as if it did not grow with the valence
        parameters.work_limit = static_cast<std::size_t>(valence) / 2, parameters.work_of_a_face = 0;
      Pose_loop<Sculptor<Mesh>> loop(sculptor, map_of_tests, parameters);
      Pose_reading reading;
      reading.elapsed = 0.001;
      int starved = 0;
      std::size_t most_pairs = 0;
      double largest_jump = 0;
      Vector3d last = Vector3d::Zero();
      for (int k = 0; k < 900; ++k) {
        const double z = k < 300 ? 1.05 : k < 500 ? 1.05 + 0.002 * (k - 300) : 1.45;
        reading.position = map_of_tests.to_device(Vector3d(0.1 * (z - 1.05), 0, z)), reading.button = k < 100 ? 0 : 1;
        const Haptic_tick& made = loop.tick(reading);
        BOOST_REQUIRE((made.fault == Loop_fault::none));
        if (k == 100) {
          BOOST_REQUIRE((made.tool.event == Tool_event::grabbed));
          BOOST_REQUIRE((loop.tool().vertex() == tip));
        }
        starved += made.tool.starved, most_pairs = std::max(most_pairs, made.tool.pairs);
        if (made.tool.starved)
          BOOST_TEST(made.coupling == Vector3d::Zero());
        largest_jump = std::max(largest_jump, (made.rendered.force - last).norm());
        last = made.rendered.force;
      }
      BOOST_TEST_MESSAGE("valence " << valence << (is_bound ? ", too little work" : "") << ": starved in " << starved
                                    << " ticks, at most " << most_pairs << " pairs, at z = " << mesh.point(tip).z());
      BOOST_TEST(last == Vector3d::Zero());
      if (!is_bound) {
        BOOST_TEST(starved == 0);
        BOOST_TEST(mesh.point(tip).z() > 1.39);
      } else if (valence > 6) {
        BOOST_TEST(starved > 100); // and the hand feels nothing of it
        BOOST_TEST(largest_jump == 0);
      }
    }
}

BOOST_AUTO_TEST_CASE(the_box_of_a_scene_of_subnormal_size_is_right_for_callers_who_flush_them) {
  const Vector3d zero(0, 0, 0), size(0x1p-1060, 0x1p-1060, 0x1p-1060);
  Vector3d least, greatest;
  const auto map_of_box = [&](const Vector3d& lower, const Vector3d& upper) {
    least = lower, greatest = upper;
    return map_of_tests;
  };
  Mesh cube = meshes::to_mesh(meshes::cube(0x1p-1060));
  {
    const haptic_sculpt::test::Callers_mode mode(FE_TONEAREST, true);
    const Loop_scene<Mesh> scene(std::move(cube), map_of_box);
  }
  BOOST_TEST((least == zero && greatest == size));
}

BOOST_AUTO_TEST_CASE(a_viewer_is_passed_which_ticks_were_starved) {
  using Scene = Loop_scene<Mesh>;
  Scene scene(double_cone(300), [](const Vector3d&, const Vector3d&) { return map_of_tests; });
  auto parameters = parameters_of_tests();
  parameters.work_limit = 150, parameters.work_of_a_face = 0; // too little for the vertex in hand
  Pose_loop<Scene::Sculptor_type> loop(scene.sculptor, scene.map, parameters);
  Scene_feed feed;
  Loop_session<decltype(loop), Scene> session(loop, scene, nullptr, &feed, nullptr);
  Pose_reading reading;
  reading.elapsed = 0.001;
  int starved = 0;
  for (int k = 0; k < 500; ++k) { // taken at 100, drawn upwards from 300 on
    const double z = k < 300 ? 1.05 : 1.05 + 0.002 * (k - 300);
    reading.position = map_of_tests.to_device(Vector3d(0.1 * (z - 1.05), 0, z)), reading.button = k < 100 ? 0 : 1;
    session.tick(reading);
    Tick_view view;
    BOOST_REQUIRE(feed.take(view));
    if (k < 300)
      BOOST_TEST(!view.starved);
    else if (view.starved) { // not where the hand wants it, held by nothing, and without a force
      ++starved;
      BOOST_TEST((view.holds_vertex && !view.reached && view.contacts == 0));
      BOOST_TEST((view.proxy != view.target && view.force == std::array<double, 3>{}));
    }
  }
  BOOST_TEST(starved > 100);
}

} // namespace
