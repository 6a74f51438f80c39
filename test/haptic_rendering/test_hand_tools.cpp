// SPDX-License-Identifier: GPL-3.0-or-later
// Clutch, zoom and a button that bounces: no step of the force, no energy, one press.
#include "haptic_rendering/pose_readings.h"
#include "meshes/generated_meshes.h"
#include "sculpting/public_functions/Callers_mode.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

/// A probe, or a vertex in hand, at the box [0, 1]^3.
struct Clutch_bench {
  using Mesh = meshes::Mesh;
  Mesh mesh = meshes::to_mesh(meshes::box(1, 1));
  Sculptor<Mesh> sculptor{mesh};
  Pose_loop_parameters parameters = parameters_of_tests();
  Pose_loop<Sculptor<Mesh>> loop{sculptor, map_of_tests, parameters};
  Vector3d handle = map_of_tests.to_device(Vector3d(0.5, 0.4, 1.2)), force = Vector3d::Zero();
  double work = 0, largest_excess = -1; ///< J given to the hand; N beyond what slew limit and the handle's way permit

  /// The force is held until the next reading.
  const Haptic_tick& go(const Vector3d& step) {
    Pose_reading reading;
    reading.position = handle += step, reading.elapsed = 0.001;
    work += force.dot(step);
    const Haptic_tick& tick = loop.tick(reading);
    const double permitted = parameters.limits.slew * parameters.tick + parameters.coupling.stiffness * step.norm();
    largest_excess = std::fmax(largest_excess, (tick.rendered.force - force).norm() - permitted);
    force = tick.rendered.force;
    return tick;
  }
  void wait(int ticks) {
    for (int k = 0; k < ticks; ++k)
      go(Vector3d::Zero());
  }
  /// Down onto the face z = 1 and 2 mm of the device into it.
  void press_on() {
    for (int k = 0; k < 400; ++k)
      go(Vector3d(0, 0, k < 300 ? 0 : -0.00006)); // m
  }
};

BOOST_AUTO_TEST_CASE(a_clutch_moves_the_handle_alone_and_a_zoom_makes_no_step_of_the_force) {
  for (const double factor : {1.0, 0.25, 3.0}) {
    Clutch_bench b;
    b.press_on();
    BOOST_REQUIRE(b.force.norm() > 0.5);
    const Vector3d held = b.loop.tick(Pose_reading{b.handle, 0, 0.001}).tool.proxy;
    b.loop.open_clutch();
    b.wait(20);
    BOOST_TEST(b.force == Vector3d::Zero()); // 300 N/s
    for (int k = 0; k < 100; ++k)            // into the solid as far as one likes, and aside
      BOOST_TEST((b.go(Vector3d(0.0001, 0, -0.0001)).tool.proxy - held).norm() == 0);
    BOOST_TEST(b.force == Vector3d::Zero());
    if (factor != 1)
      b.loop.zoom(factor);
    b.loop.open_clutch(false);
    const Haptic_tick first = b.go(Vector3d::Zero());
    BOOST_TEST((first.tool.target - held).norm() <= 1e-12);
    BOOST_TEST(first.rendered.force.norm() <= 1e-9);
    BOOST_TEST(std::abs(b.loop.map().scale() - factor * map_of_tests.scale()) <= 1e-12 * map_of_tests.scale());
    BOOST_TEST((b.loop.map().to_scene(b.handle) - held).norm() <= 1e-12);
    // From there on as ever, at the new scale: against the closed form of a plane, where the spring is k x depth.
    for (int k = 0; k < 20; ++k)
      b.go(Vector3d(0, 0, -0.00005));
    b.wait(30);
    BOOST_TEST((b.force - Vector3d(0, 0, b.parameters.coupling.stiffness * 0.001)).norm() <= 1e-6);
    for (int k = 0; k < 40; ++k) // up again; free, the probe goes with the handle at the new scale
      b.go(Vector3d(0, 0, 0.0001));
    b.wait(2);
    const Vector3d before = b.loop.tick(Pose_reading{b.handle, 0, 0.001}).tool.proxy;
    const Vector3d after = b.go(Vector3d(0.0002, 0, 0)).tool.proxy;
    BOOST_TEST((after - before - Vector3d(0.0002 * factor * map_of_tests.scale(), 0, 0)).norm() <= 1e-9);
    BOOST_TEST(b.largest_excess <= 1e-12);
    BOOST_TEST((b.loop.tick(Pose_reading{b.handle, 0, 0.001}).fault == Loop_fault::none));
  }
}

BOOST_AUTO_TEST_CASE(clutch_and_zoom_give_no_energy_and_keep_a_vertex_in_hand) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(7));
  std::uniform_real_distribution<double> uniform(-1, 1);
  double most = 0; // J given to the hand
  for (int run = 0; run < 20; ++run) {
    Clutch_bench b;
    b.press_on();
    const bool holds = run % 2 == 1;
    if (holds) { // a corner; until it is let go of
      const auto corner = *b.mesh.vertices_begin();
      b.loop.tool().take(corner);
      b.go(Vector3d::Zero());
      BOOST_REQUIRE((b.loop.tool().vertex() == corner));
    }
    b.work = 0, b.largest_excess = -1;
    const double stored = b.force.squaredNorm() / (2 * b.parameters.coupling.stiffness);
    int pressed = 0;
    for (int k = 0; k < 3000; ++k) {
      // Pressed down with the clutch closed, and up with it open: a force that stayed would give 2 to 5 mJ each time.
      const double along = k % 200 < 50 ? -0.02 : k % 200 < 120 ? 0.1 : 0; // m/s
      const Vector3d speed =
          Vector3d(0, 0, along) + 0.002 * Vector3d(uniform(random), uniform(random), uniform(random));
      pressed += k % 200 == 50 && b.force.norm() > 0.2;
      if (k % 200 == 50)
        b.loop.open_clutch();
      if (k % 200 == 120)
        b.loop.open_clutch(false);
      if (k % 300 == 140)
        b.loop.zoom(k % 600 == 140 ? 0.5 : 2);
      b.go(0.001 * speed);
      if (holds)
        BOOST_TEST(b.loop.tool().holds_vertex());
      most = std::fmax(most, b.work - stored);
    }
    BOOST_TEST((b.loop.tick(Pose_reading{b.handle, 0, 0.001}).fault == Loop_fault::none));
    BOOST_TEST(b.largest_excess <= 1e-12);
    if (!holds)
      BOOST_TEST(pressed >= 10);
  }
  BOOST_TEST_MESSAGE("given to the hand at most " << 1e3 * most << " mJ");
  BOOST_TEST(most <= 1e-3); // J
}

BOOST_AUTO_TEST_CASE(a_zoom_that_makes_no_scale_is_refused_where_it_is_asked_for) {
  Clutch_bench b;
  for (const double bad : {0.0, -1.0, std::nan(""), 1e308})
    BOOST_CHECK_THROW(b.loop.zoom(bad), Error);
  BOOST_TEST((b.go(Vector3d::Zero()).fault == Loop_fault::none));
  BOOST_TEST(b.loop.map().scale() == map_of_tests.scale());
  b.go(Vector3d(5, 0, 0)); // a loop of pose and force that has just begun anew takes any place
  b.loop.restart();
  b.go(Vector3d::Zero());
  b.loop.open_clutch();
  b.loop.zoom(1e-162); // waits, as the next does: they are multiplied with each other first
  BOOST_CHECK_THROW(b.loop.zoom(1e-162), Error);
  b.loop.open_clutch(false);
  BOOST_TEST((b.go(Vector3d::Zero()).fault == Loop_fault::none));
  b.loop.zoom(1e162);
  b.go(Vector3d::Zero());
  BOOST_CHECK_THROW(b.loop.zoom(1e306), Error); // a scale, and yet no place of the tool could be kept
  BOOST_TEST((b.go(Vector3d::Zero()).fault == Loop_fault::none));
}

BOOST_AUTO_TEST_CASE(what_is_thrown_beside_a_tick_is_a_fault_of_the_next) {
  Clutch_bench b;
  b.loop.attempt([] {});
  BOOST_TEST((b.go(Vector3d::Zero()).fault == Loop_fault::none));
  b.loop.attempt([] { throw Error("a viewer's"); });
  BOOST_TEST((b.go(Vector3d::Zero()).fault == Loop_fault::error));
  BOOST_TEST(std::string(b.loop.failure()) == "a viewer's");
}

BOOST_AUTO_TEST_CASE(a_zoom_is_the_same_in_all_modes_of_a_caller) {
  std::set<double> scales;
  for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    Clutch_bench b;
    b.wait(1);
    {
      const haptic_sculpt::test::Callers_mode mode(rounding, true);
      for (int k = 0; k < 7; ++k)
        b.loop.zoom(1.1);
    }
    b.wait(1);
    scales.insert(b.loop.map().scale());
  }
  BOOST_TEST(scales.size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_loop_is_the_same_in_whatever_mode_of_a_caller_it_was_made) {
  Pose_loop_parameters parameters = parameters_of_tests();
  parameters.coupling.damping = 0.3;
  std::set<std::vector<double>> runs;
  for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    meshes::Mesh mesh = meshes::to_mesh(meshes::box(1, 1));
    Sculptor<meshes::Mesh> sculptor(mesh);
    std::unique_ptr<Pose_loop<Sculptor<meshes::Mesh>>> loop;
    {
      const haptic_sculpt::test::Callers_mode mode(rounding, true);
      loop = std::make_unique<Pose_loop<Sculptor<meshes::Mesh>>>(sculptor, map_of_tests, parameters);
    }
    meshes::Mesh::Vertex_index corner;
    for (const auto v : mesh.vertices())
      if (mesh.point(v) == meshes::Point_3(1, 1, 1))
        corner = v;
    std::vector<double> run;
    double largest = 0;
    for (int k = 0; k < 900; ++k) { // takes a corner and lets it go, which leaves an offset; then presses on the face
      if (k == 100)
        loop->tool().take(corner);
      const Vector3d way(0.5 + 1e-4 * k, 0.4, k < 300 ? 1.4 : std::fmax(0.9, 1.4 - 0.002 * (k - 300)));
      const int button = k >= 90 && k < 200;
      const Haptic_tick& tick = loop->tick(Pose_reading{map_of_tests.to_device(way), button, 0.001});
      largest = std::fmax(largest, tick.rendered.force.norm());
      for (int i = 0; i < 3; ++i)
        run.push_back(tick.rendered.force[i]), run.push_back(tick.tool.proxy[i]);
    }
    BOOST_TEST(largest > 0.5);
    runs.insert(run);
  }
  BOOST_TEST(runs.size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_button_that_bounces_is_pressed_once_and_at_once) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(8));
  std::uniform_int_distribution<int> bouncing(0, 19), contact(0, 1), held(25, 200);
  int bare = 0, changes = 0;
  constexpr int presses = 500;
  for (int press = 0; press < presses; ++press) {
    Debounced_button button;
    int last = 0, last_contact = 0;
    const auto say = [&](int now) {
      bare += now == 2 && last_contact != 2, last_contact = now;
      const int pressed = button.next(now, 0.001);
      changes += pressed != last, last = pressed;
      return pressed;
    };
    for (const int aim : {2, 0}) {
      BOOST_TEST(say(aim) == aim); // at once
      const int ticks = bouncing(random);
      for (int k = 0; k < ticks; ++k)
        say(contact(random) ? aim : 2 - aim);
      for (int k = held(random); k > 0; --k)
        say(aim);
      BOOST_TEST(last == aim);
    }
  }
  BOOST_TEST(changes == 2 * presses);
  BOOST_TEST(bare > 3 * presses); // what the contacts alone would have done
  for (const double bad : {-1.0, 2.0, std::nan("")})
    BOOST_CHECK_THROW(Debounced_button{bad}, Error);
}

BOOST_AUTO_TEST_CASE(one_press_of_a_button_that_bounces_removes_one_vertex_and_is_felt_at_once) {
  for (const bool is_bare : {false, true}) {
    meshes::Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
    Sculptor<meshes::Mesh> sculptor(mesh);
    Pose_loop_parameters parameters = parameters_of_tests();
    parameters.reach = 0.02; // m: a large part of the ball
    if (is_bare)
      parameters.button_quiet_time = 0; // all that the contacts say
    Pose_loop<Sculptor<meshes::Mesh>> loop(sculptor, map_of_tests, parameters);
    const auto say = [&](int button, int ticks) {
      const Pose_reading reading{map_of_tests.to_device(Vector3d(0.1, 0.2, 1.3)), button, 0.001};
      for (int k = 0; k < ticks; ++k)
        BOOST_REQUIRE((loop.tick(reading).fault == Loop_fault::none));
    };
    const auto edits = [&] { return loop.tool().edits(); };
    say(0, 300);
    say(2, 1);
    BOOST_TEST(edits().removed == 1u);
    for (int k = 0; k < 6; ++k) // 18 ms, as a contact comes to rest
      say(0, 2), say(2, 1);
    say(2, 60);
    for (int k = 0; k < 6; ++k)
      say(0, 1), say(2, 2);
    say(0, 60);
    if (is_bare)
      BOOST_TEST(edits().removed > 6u);
    else
      BOOST_TEST(edits().removed == 1u);
    say(2, 60), say(0, 60); // the next press counts
    BOOST_TEST(edits().refused == 0u);
    if (!is_bare)
      BOOST_TEST(edits().removed == 2u);
  }
}

BOOST_AUTO_TEST_CASE(a_restart_under_an_open_clutch_keeps_where_the_tool_is) {
  Clutch_bench b;
  b.wait(50);
  BOOST_REQUIRE(b.loop.tool().holds_probe());
  const Vector3d held = b.go(Vector3d::Zero()).tool.proxy;
  b.loop.open_clutch();
  for (int k = 0; k < 100; ++k)
    b.go(Vector3d(0.0005, 0, 0.0003));
  b.loop.end_by(Loop_fault::stall);
  BOOST_TEST((b.go(Vector3d::Zero()).tool.proxy == held));
  b.loop.restart();
  Pose_reading none;
  none.position = Vector3d(std::nan(""), 0, 0), none.elapsed = 0.001;
  const Haptic_tick failed = b.loop.tick(none); // at the first
  BOOST_TEST((failed.fault == Loop_fault::not_finite && failed.tool.proxy == held));
  b.loop.restart();
  BOOST_TEST((b.go(Vector3d::Zero()).tool.proxy == held));
  b.loop.open_clutch(false);
  double farthest = 0;
  for (int k = 0; k < 300; ++k)
    farthest = std::fmax(farthest, (b.go(Vector3d::Zero()).tool.proxy - held).norm());
  BOOST_TEST(farthest <= 1e-12);
}

// A driver opens the clutch as long as no force is permitted.
BOOST_AUTO_TEST_CASE(under_an_open_clutch_neither_burst_nor_virtual_mass_is_felt) {
  for (const bool opens : {false, true}) {
    Clutch_bench b;
    b.wait(400);
    Pose_reading press;
    press.position = b.handle, press.button = 1, press.elapsed = 0.001;
    BOOST_REQUIRE((b.loop.tick(press).tool.event == Tool_event::refused)); // there is nothing
    if (opens)
      b.loop.open_clutch();
    double felt = 0;
    for (int k = 0; k < 50; ++k)
      felt = std::fmax(felt, b.loop.tick(press).rendered.force.norm());
    BOOST_TEST((felt > 0.01) == !opens, felt);
  }
  for (const bool opens : {false, true}) {
    Clutch_bench b;
    b.parameters.virtual_mass.mass = 0.01;
    Pose_loop<Sculptor<meshes::Mesh>> loop(b.sculptor, map_of_tests, b.parameters);
    double speed = 0, felt = 0; // m/s, N
    const auto go = [&](double faster) {
      speed += faster;
      Pose_reading reading;
      reading.position = b.handle += Vector3d(0, 0, 0.001 * speed), reading.elapsed = 0.001;
      return loop.tick(reading).rendered.force.norm();
    };
    go(0);
    loop.tool().take(*b.mesh.vertices_begin());
    for (int k = 0; k < 400; ++k)
      go(0);
    if (opens)
      loop.open_clutch();
    for (int k = 0; k < 40; ++k) {
      const double force = go(0.004);
      felt = k < 20 ? felt : std::fmax(felt, force);
    }
    BOOST_TEST((felt > 0.005) == !opens, felt);
  }
}

} // namespace
