// SPDX-License-Identifier: GPL-3.0-or-later
// A hand is drawn to the nearest vertex by a bounded force that has a potential, and gives no more energy than a
// spring.
#include "haptic_rendering/pose_readings.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

using Mesh = meshes::Mesh;

/// u of the distance to the nearest of all vertices, J: the force integrated by hand.
double potential(const Mesh& mesh, const Vertex_snap& snap, const Vector3d& handle) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    nearest = std::fmin(
        nearest, map_of_tests.way_to_device(Vector3d(p.x(), p.y(), p.z()) - map_of_tests.to_scene(handle)).norm());
  }
  const double l = snap.length, f = snap.force, rest = l - nearest;
  return nearest >= l ? f * l / 2 : nearest >= l / 2 ? f * l / 2 - f * rest * rest / l : f * nearest * nearest / l;
}

/// A mouse with forces that goes about a ball.
struct Snap_bench {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
  Sculptor<Mesh> sculptor{mesh};
  Pose_loop_parameters parameters = parameters_of_tests();
  std::optional<Pose_loop<Sculptor<Mesh>>> loop;
  Vector3d handle = map_of_tests.to_device(Vector3d(0, 0, 1.5));

  explicit Snap_bench(const Vertex_snap& snap) {
    parameters.snap = snap, parameters.limits.ramp_time = 0.01;
    loop.emplace(sculptor, map_of_tests, parameters);
  }
  const Haptic_tick& go(const Vector3d& step) {
    Pose_reading reading;
    reading.position = handle += step, reading.elapsed = 0.001;
    return loop->tick(reading);
  }
};

const Vertex_snap snap_of_tests{0.004, 0.2};

BOOST_AUTO_TEST_CASE(the_force_is_bounded_and_the_slope_of_a_potential) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(21));
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Snap_bench b(snap_of_tests);
  constexpr double h = 1e-7; // m
  int drawn = 0, kinks = 0;
  for (int k = 0; k < 2000; ++k) {
    const auto& p =
        b.mesh.point(Mesh::Vertex_index(static_cast<std::uint32_t>(random() % b.mesh.number_of_vertices())));
    const Vector3d vertex = map_of_tests.to_device(Vector3d(p.x(), p.y(), p.z()));
    const Vector3d handle = vertex + 0.005 * Vector3d(uniform(random), uniform(random), uniform(random));
    Vector3d nearest = vertex, slope, other;
    for (const auto v : b.mesh.vertices()) {
      const Vector3d at =
          map_of_tests.to_device(Vector3d(b.mesh.point(v).x(), b.mesh.point(v).y(), b.mesh.point(v).z()));
      if ((at - handle).norm() < (nearest - handle).norm())
        nearest = at;
    }
    const Vector3d force = snap_of_tests.force_for(nearest - handle);
    BOOST_TEST(force.norm() <= snap_of_tests.force * (1 + 1e-12));
    for (int axis = 0; axis < 3; ++axis) {
      const double there = potential(b.mesh, snap_of_tests, handle + h * Vector3d::Unit(axis)),
                   here = potential(b.mesh, snap_of_tests, handle),
                   back = potential(b.mesh, snap_of_tests, handle - h * Vector3d::Unit(axis));
      slope[axis] = (there - here) / h, other[axis] = (here - back) / h;
    }
    drawn += force.norm() > 0;
    if ((slope - other).norm() > 1e-4) // as far from two vertices
      ++kinks;
    else
      BOOST_TEST((force + slope).norm() <= 1e-4); // stiffness x h, and rounding
  }
  BOOST_TEST(drawn > 500);
  BOOST_TEST(kinks < 20);
}

BOOST_AUTO_TEST_CASE(on_any_way_it_gives_no_more_than_a_spring_of_its_stiffness) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(22));
  std::uniform_real_distribution<double> uniform(-1, 1);
  double most = -1, most_force = 0, bare = 0;
  for (int run = 0; run < 20; ++run) {
    Snap_bench b(snap_of_tests);
    b.go(Vector3d::Zero());
    Vector3d velocity = Vector3d::Zero(), force = Vector3d::Zero();
    double work = 0, friction = 0;
    for (int k = 0; k < 30; ++k) // the force begins
      force = b.go(Vector3d::Zero()).rendered.force;
    const double begin = potential(b.mesh, snap_of_tests, b.handle);
    for (int k = 0; k < 4000; ++k) {
      velocity = 0.98 * velocity + 0.004 * Vector3d(uniform(random), uniform(random), uniform(random));
      const Vector3d out = b.handle - map_of_tests.to_device(Vector3d::Zero());
      const double above = out.norm() * map_of_tests.scale() - 1.1; // about the ball, a little above it
      velocity -= (0.05 * above + (above < 0 ? 0.2 * above : 0)) * out.normalized();
      const Vector3d step = 0.001 * velocity;
      work += force.dot(step), friction += 0.5 * snap_of_tests.stiffness() * step.squaredNorm();
      const Haptic_tick& tick = b.go(step);
      force = tick.rendered.force;
      BOOST_REQUIRE((tick.fault == Loop_fault::none));
      if (tick.tool.contacts == 0) {
        BOOST_TEST(force.norm() <= snap_of_tests.force * (1 + 1e-12));
        most_force = std::fmax(most_force, force.norm());
      }
      if (tick.tool.reached) { // the spring has nothing
        const double beyond = work - (begin - potential(b.mesh, snap_of_tests, b.handle));
        most = std::fmax(most, beyond - friction), bare = std::fmax(bare, beyond);
      }
    }
  }
  BOOST_TEST_MESSAGE("beyond a spring's at most " << 1e6 * most << " uJ, force at most " << most_force << " N");
  BOOST_TEST(most_force > 0.5 * snap_of_tests.force);
  BOOST_TEST(bare > 1e-8);  // J; what the friction of a device is for
  BOOST_TEST(most <= 1e-6); // J; where the nearest vertex changes, the slew limit turns the force within two ticks
}

// What it gives a hand on its way in is lent: nobody has put it in before.
BOOST_AUTO_TEST_CASE(a_hand_that_is_drawn_in_slowly_by_a_deep_snap_is_no_fault) {
  for (const Vertex_snap& snap : {Vertex_snap{0.01, 2}, Vertex_snap{0.02, 1}, Vertex_snap{0.03, 2}}) {
    Snap_bench b(snap);
    BOOST_TEST(std::abs(snap.energy() - (potential(b.mesh, snap, Vector3d(1, 0, 0)))) <= 1e-15);
    const auto& top = b.mesh.point(Mesh::Vertex_index(5));
    const Vector3d vertex = map_of_tests.to_device(Vector3d(top.x(), top.y(), top.z()));
    b.handle = vertex + (snap.length + 0.003) * vertex.normalized();
    for (int k = 0; k < 100; ++k)
      b.go(Vector3d::Zero());
    double work = 0;
    Vector3d force = Vector3d::Zero();
    const Vector3d step = -5e-6 * vertex.normalized(); // 5 mm/s
    while ((b.handle - vertex).norm() > 0.0005) {
      work += force.dot(step);
      const Haptic_tick& tick = b.go(step);
      BOOST_REQUIRE((tick.fault == Loop_fault::none));
      force = tick.rendered.force;
    }
    BOOST_TEST_MESSAGE(snap.length << " m, " << snap.force << " N: given to the hand " << 1e3 * work << " of "
                                   << 1e3 * snap.energy() << " mJ");
    BOOST_TEST(work > 0.8 * snap.energy()); // or the case was none
  }
}

BOOST_AUTO_TEST_CASE(a_vertex_in_hand_is_not_drawn_and_what_is_not_passive_is_refused) {
  Snap_bench b(snap_of_tests);
  b.go(Vector3d::Zero());
  b.loop->tool().take(*b.mesh.vertices_begin());
  for (int k = 0; k < 20; ++k)
    b.go(Vector3d::Zero());
  BOOST_TEST(b.loop->tool().holds_vertex());
  BOOST_TEST(b.go(Vector3d::Zero()).rendered.force == Vector3d::Zero());

  Pose_loop_parameters parameters = parameters_of_tests();
  const double room = parameters.passive_stiffness() - parameters.coupling.stiffness;
  parameters.snap = {0.004, 0.999 * room * 0.002};
  BOOST_CHECK_NO_THROW((Pose_loop<Sculptor<Mesh>>(b.sculptor, map_of_tests, parameters)));
  parameters.snap.force = 1.001 * room * 0.002;
  BOOST_CHECK_THROW((Pose_loop<Sculptor<Mesh>>(b.sculptor, map_of_tests, parameters)), Unstable_coupling);
  for (const Vertex_snap& bad :
       {Vertex_snap{-1, 0.2}, Vertex_snap{std::nan(""), 0.2}, Vertex_snap{1e-9, 0.2}, Vertex_snap{0.01, -1}})
    BOOST_CHECK_THROW(bad.check(), Error);
}

} // namespace
