// SPDX-License-Identifier: GPL-3.0-or-later
// Three ways in which a vendor's functions give a place and take a force, and the adapter of each: a callback at its
// own rate, a read that waits, and polling. The force is 0 at the end of each, also where something throws, or a signal
// ends it.
#include <haptic_sculpt/haptic_rendering.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <csignal>
#include <iostream>
#include <stdexcept>

using namespace haptic_sculpt;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
using Scene = Loop_scene<Mesh>;
using Loop = Pose_loop<Scene::Sculptor_type>;

/// Stands for what a vendor ships: a handle of 0.1 kg with a friction of 3 N s/m, which a hand lets down with 0.5 N.
namespace vendor {
struct State {
  double time, position[3];
  int button, forces_permitted; // a switch that is held
};
State state;
double speed, force[3];
bool is_plugged_in;

void plug_in() {
  state = {0, {0.003, 0.002, 0.05}, 0, 1}, speed = 0, is_plugged_in = true;
  std::fill(force, force + 3, 0.0);
}
void let_pass(double seconds) { // in steps that a hand does not feel
  for (const double end = state.time + seconds - 1e-9; state.time < end; state.time += 1e-4)
    speed += 1e-4 * (state.forces_permitted * force[2] - 0.5 - 3 * speed) / 0.1, state.position[2] += 1e-4 * speed;
}
int get_state(State* s) { // 0: done
  *s = state;
  return is_plugged_in ? 0 : -1;
}
int wait_for_state(State* s) { // at 1 kHz, a little late every fifth time
  state.forces_permitted = state.time < 0.7 || state.time > 0.71; // once the hand lets go of the switch
  let_pass(static_cast<long>(1000 * state.time) % 5 == 0 ? 0.0012 : 0.001);
  return get_state(s);
}
void set_force(const double f[3]) {
  std::copy(f, f + 3, force);
}
void call_back(int (*function)(void*), void* data) { // now faster, now slower, until it returns 0
  for (int k = 0; function(data) != 0; ++k)
    let_pass(k % 3 == 0 ? 0.0007 : 0.0011);
}
} // namespace vendor

volatile std::sig_atomic_t is_ended = 0; // destructors do not run where a signal ends the process

/// What is the same for all three.
class Adapter {
public:
  explicit Adapter(Loop& loop) : loop_(loop) {}
  ~Adapter() { give({0, 0, 0}); } // an exception's way out, too
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;

  bool goes_on() const { return is_ended == 0 && !loop_.has_stopped() && last_ < 1.5; } // s
  void tick(const vendor::State& state) noexcept {
    Pose_reading reading;
    std::copy(state.position, state.position + 3, reading.position.data()); // metres
    reading.elapsed = state.time - last_, last_ = state.time; // by the device's own clock
    reading.button = state.button;                            // the loop sees to contacts that bounce
    loop_.open_clutch(state.forces_permitted == 0); // not permitted: let go of gently
    give(loop_.tick(reading).rendered.force);
  }

private:
  Loop& loop_;
  double last_ = 0;

  static void give(const Eigen::Vector3d& force) { vendor::set_force(force.data()); }
};

/// A driver that calls at its own rate, from a thread of its own: nothing may be thrown into it.
void run_by_callback(Loop& loop) {
  Adapter adapter(loop);
  vendor::call_back(
      [](void* data) noexcept {
        Adapter& a = *static_cast<Adapter*>(data);
        vendor::State state;
        if (vendor::get_state(&state) != 0)
          return 0;
        a.tick(state);
        return a.goes_on() ? 1 : 0;
      },
      &adapter);
}

/// A driver whose read waits for the next state: it is the clock of the loop.
void run_by_waiting(Loop& loop) {
  Adapter adapter(loop);
  while (adapter.goes_on()) {
    vendor::State state;
    if (vendor::wait_for_state(&state) != 0)
      throw std::runtime_error("the device does not answer; is it plugged in?");
    adapter.tick(state);
  }
}

/// A driver that is asked and waits for nothing: the loop has a clock of its own.
void run_by_polling(Loop& loop, double unplugged) {
  Adapter adapter(loop);
  while (adapter.goes_on()) {
    vendor::let_pass(0.001); // sleep_until() of a steady clock, here
    vendor::is_plugged_in = vendor::state.time < unplugged;
    vendor::State state;
    if (vendor::get_state(&state) != 0)
      throw std::runtime_error("the device does not answer; is it plugged in?");
    adapter.tick(state);
  }
}

int main(int argc, char** argv) try {
  if (argc != 2)
    return std::cerr << "usage: adapters_of_devices MESH\n", 2;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, [](int s) { is_ended = 1, std::signal(s, SIG_DFL); }); // a second one ends it at once
  bool is_right = true;
  for (const int kind : {0, 1, 2, 3}) {
    Scene scene(read_surface<Mesh>(argv[1]), [](const auto& lower, const auto& upper) {
      return Workspace_map::fitted(lower, upper, Eigen::Vector3d::Zero(), 0.04); // a ball of 40 mm holds the mesh
    });
    Pose_loop_parameters parameters(3); // N s/m that the device itself has
    parameters.tick = 0.0011;           // s: the longest usual one; it bounds the stiffness
    Loop loop(scene.sculptor, scene.map, parameters);
    vendor::plug_in();
    bool has_thrown = false;
    try {
      kind == 0 ? run_by_callback(loop) : kind == 1 ? run_by_waiting(loop) : run_by_polling(loop, kind == 2 ? 9 : 1);
    } catch (const std::runtime_error& error) {
      has_thrown = true;
      std::cout << error.what() << '\n';
    }
    const double given = std::abs(vendor::force[0]) + std::abs(vendor::force[1]) + std::abs(vendor::force[2]);
    std::cout << "at " << vendor::state.time << " s the handle is at " << vendor::state.position[2] << " m, at "
              << vendor::speed << " m/s, and feels " << given << " N\n";
    is_right = is_right && given == 0 && has_thrown == (kind == 3) && std::abs(vendor::speed) < 0.01 &&
               vendor::state.position[2] > 0 && vendor::state.position[2] < 0.045;
  }
  return is_right ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
