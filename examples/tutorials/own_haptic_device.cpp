// SPDX-License-Identifier: GPL-3.0-or-later
// How a driver plugs in: one that tells a place and takes a force (joints: Haptic_loop, with read() and write(torque)).
#include <haptic_sculpt/haptic_rendering.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <thread>

using namespace haptic_sculpt;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
using Scene = Loop_scene<Mesh>;

/// Stands for what a vendor ships: here a handle of 0.1 kg with some friction, which a hand lets down with half a
/// newton.
namespace vendor {
double time, z = 0.05, speed = 0, force[3];
double get_position(double p[3]) { // returns when that was
  speed += 0.001 * (force[2] - 0.5 - 3 * speed) / 0.1, z += 0.001 * speed;
  p[0] = 0.003, p[1] = 0.002, p[2] = z;
  return time += 0.001;
}
void set_force(const double f[3]) {
  std::copy(f, f + 3, force);
}
bool is_button_down() {
  return false;
}
} // namespace vendor

volatile std::sig_atomic_t is_ended = 0; // destructors do not run where a signal ends the process

struct Driver { // models PoseDevice
  double last = 0;
  ~Driver() { write_force({0, 0, 0}); }
  Pose_reading read_pose() {
    Pose_reading reading;
    const double now = vendor::get_position(reading.position.data()); // metres
    reading.button = vendor::is_button_down() ? 1 : 0;
    reading.elapsed = now - last, last = now; // s, by the device's clock, or std::chrono's, or stalls are not seen
    return reading;
  }
  void write_force(const Eigen::Vector3d& force) { vendor::set_force(force.data()); } // N, on the hand
};

int main(int argc, char** argv) try {
  if (argc != 2)
    return std::cerr << "usage: own_haptic_device MESH\n", 2;
  Scene scene(read_surface<Mesh>(argv[1]), [](const auto& lower, const auto& upper) {
    return Workspace_map::fitted(lower, upper, Eigen::Vector3d::Zero(), 0.04); // a ball of 40 mm holds the mesh
  });
  const Pose_loop_parameters parameters(3); // N s/m that the device itself has: it bounds the stiffness
  Pose_loop<Scene::Sculptor_type> loop(scene.sculptor, scene.map, parameters);
  Driver driver;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, [](int s) { is_ended = 1, std::signal(s, SIG_DFL); }); // a second one ends it at once
  using Clock = std::chrono::steady_clock;
  auto next = Clock::now();
  for (int tick = 0; tick < 1500 && !loop.has_stopped() && is_ended == 0; ++tick) {
    driver.write_force(loop.tick(driver.read_pose()).rendered.force);
    next = std::max(next + std::chrono::milliseconds(1), Clock::now()); // what was missed is not made up for
    std::this_thread::sleep_until(next);
  }
  std::cout << "the handle rests at " << vendor::z << " m; pushed up by " << vendor::force[2] << " N\n";
  const bool is_held = std::abs(vendor::force[2] - 0.5) < 0.05 && std::abs(vendor::speed) < 0.01 && vendor::z > 0;
  return is_held ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
