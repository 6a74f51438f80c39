// SPDX-License-Identifier: GPL-3.0-or-later
// One thread runs the haptic loop; another shows what it sculpts, looks, asks it to undo, and has a copy to save.
#include <haptic_sculpt/haptic_rendering.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <atomic>
#include <iostream>
#include <map>
#include <memory>
#include <thread>

using namespace haptic_sculpt;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
using Scene = Loop_scene<Mesh>; // mesh, Sculptor and map; made by any thread

/// A device without force: goes down to the surface, presses its button, draws what it holds up and aside, lets go.
struct Mouse {
  int tick = 0;
  Pose_reading read_pose() {
    const double down = std::min(tick, 400) / 400., up = std::clamp((tick - 400) / 300., 0., 1.);
    Pose_reading reading;
    reading.position = {0.003 + 0.004 * up, 0.002, 0.05 * (1 - down) + 0.045 * up};
    reading.button = tick >= 400 && tick < 700 ? 1 : 0;
    reading.elapsed = 0.001;
    ++tick;
    return reading;
  }
  void write_force(const Eigen::Vector3d&) {}
};

/// What the loop's thread is to do for another one: here it looks from above.
struct Look : Loop_task<Scene> {
  std::optional<Surface_hit<Mesh>> seen;
  bool go_on(Scene& scene, Tool_type&) override {
    const Eigen::Vector3d middle = 0.5 * (scene.lower + scene.upper), above = 2 * scene.upper - scene.lower;
    seen = scene.sculptor.first_hit({middle[0], middle[1], above[2]}, {middle[0], middle[1], scene.lower[2]});
    return true; // done; false: once more before the next tick
  }
};

int main(int argc, char** argv) try {
  if (argc != 2)
    return std::cerr << "usage: talking_to_a_loop MESH\n", 2;
  const Eigen::Vector3d home = Eigen::Vector3d::Zero();
  const double radius = 0.04; // m: a ball about home that the hand reaches
  const auto parameters = Pose_loop_parameters::without_force();
  Mouse mouse;

  Scene scene(read_surface<Mesh>(argv[1]),
              [&](const auto& lower, const auto& upper) { return Workspace_map::fitted(lower, upper, home, radius); });
  Pose_loop<Scene::Sculptor_type> loop(scene.sculptor, scene.map, parameters);
  Command_queue<Scene> queue;
  Scene_feed feed;
  Loop_session session(loop, scene, &queue, &feed, nullptr); // nullptr: no log

  const std::size_t vertices = scene.mesh.num_vertices(), faces = scene.mesh.num_faces();
  std::atomic<bool> ends{false};
  std::thread loop_thread([&] {
    while (!ends) { // the loop's thread
      mouse.write_force(session.tick(mouse.read_pose()).rendered.force);
      std::this_thread::sleep_for(std::chrono::microseconds(200)); // a device has a clock
    }
    session.end();
  });
  const auto end_loop = [&](void*) { ends = true, loop_thread.join(); };
  std::unique_ptr<void, decltype(end_loop)> running(&ends, end_loop); // on every way out

  // From here on this is the window's thread, and the mesh is the loop's alone.
  std::map<std::uint32_t, Face_change> shown; // or vertices of a graphics card
  std::size_t passed_on = 0;
  const auto follow = [&] {
    for (Face_change face; feed.take(face); ++passed_on) // at first all of them, then what changes
      if (face.is_there)
        shown[face.index] = face;
      else
        shown.erase(face.index);
  };
  for (Tick_view tick; tick.tick < 800; follow())
    while (feed.take(tick))
      ;
  const bool has_moved = passed_on > shown.size();
  std::cout << "the hand has " << (has_moved ? "sculpted" : "done nothing") << "; " << shown.size() << " faces\n";

  Look look;
  Loop_command<Scene> looking;
  looking.kind = Loop_command<Scene>::Kind::task, looking.task = &look;
  queue.ask(looking);
  Loop_answer<Scene> answer;
  while (!queue.take(answer)) // from here on `look` is this thread's again
    std::this_thread::yield();
  if (look.seen)
    std::cout << "seen from above: a " << name_of(look.seen->feature) << " at " << look.seen->point << '\n';

  Loop_command<Scene> undo;
  undo.kind = Loop_command<Scene>::Kind::edit, undo.edit = Edit::of(Edit_kind::undo);
  queue.ask(undo);
  while (!queue.take(answer)) // done, or refused and why
    std::this_thread::yield();
  bool is_good = has_moved && answer.done;

  Copy_task<Scene> copying(vertices + 16, faces + 32); // the mesh of one tick, which may have grown by so much
  Loop_command<Scene> copy;
  copy.kind = Loop_command<Scene>::Kind::task, copy.task = &copying;
  queue.ask(copy);
  while (!queue.take(answer)) // the hand goes on meanwhile
    std::this_thread::yield();
  running.reset();
  if (!copying.copy.is_whole())
    return std::cerr << "the mesh has outgrown the room of its copy\n", 1;
  const Mesh before = read_surface<Mesh>(argv[1]), after = copying.copy.mesh<Mesh>(); // to be saved
  is_good = is_good && before.number_of_vertices() == after.number_of_vertices();
  for (const auto v : before.vertices())
    is_good = is_good && before.point(v) == after.point(v);
  if (has_moved)
    std::cout << "undone: " << (is_good ? "all is as before\n" : "not all is as before\n");
  return is_good ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
