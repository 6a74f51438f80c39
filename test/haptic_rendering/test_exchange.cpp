// SPDX-License-Identifier: GPL-3.0-or-later
// What goes between the loop's thread and others: commands, changes, the journal. To be run with ThreadSanitizer, too.
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/haptic_rendering.h>
#include <haptic_sculpt/surface.h>

#include <boost/test/unit_test.hpp>

#include <map>
#include <random>
#include <thread>

using namespace haptic_sculpt;
using Eigen::Vector3d;
using Mesh = meshes::Mesh;

namespace {

using Scene = Loop_scene<Mesh>;
using Loop = Pose_loop<Scene::Sculptor_type>;
using Session = Loop_session<Loop, Scene>;
using Command = Loop_command<Scene>;
using Entries = std::vector<Journal_entry>;

const Workspace_map map_of_tests(50, Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero());

std::unique_ptr<Scene> scene_of(int level) {
  return std::make_unique<Scene>(meshes::to_mesh(meshes::bumpy_sphere(level, 0.12)),
                                 [](const Vector3d&, const Vector3d&) { return map_of_tests; });
}

/// A hand that goes about the ball: comes down on it, presses the button, pulls outwards, lets go; and so on.
Pose_reading reading_at(std::uint64_t tick) {
  const std::uint64_t phase = tick % 700;
  const double a = 0.002 * static_cast<double>(tick), p = static_cast<double>(phase);
  const double r = phase < 150   ? 1.25
                   : phase < 300 ? 1.25 - 0.35 * (p - 150) / 150
                   : phase < 600 ? 0.9 + 0.4 * (p - 300) / 300
                                 : 1.3 - 0.05 * (p - 600) / 100;
  Pose_reading reading;
  reading.position = map_of_tests.to_device(
      r * Vector3d(std::cos(a), std::sin(a) * std::cos(0.3 * a), std::sin(a) * std::sin(0.3 * a)));
  reading.button = phase < 300 ? 0 : phase < 600 ? 1 : phase < 620 ? 2 : 0;
  reading.elapsed = 0.001;
  return reading;
}

Pose_loop_parameters parameters_of_tests() {
  Pose_loop_parameters parameters;
  parameters.reach = 0.003;
  return parameters;
}

/// Points and faces by the vertices' numbers: what a mesh is, whatever its indices are.
struct Surface {
  std::map<std::uint64_t, std::array<double, 3>> points;
  std::vector<std::array<std::uint64_t, 3>> faces;
  bool operator==(const Surface& other) const { return points == other.points && faces == other.faces; }

  void add_face(std::array<std::uint64_t, 3> face) {
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(face);
  }
};

/// \param without a probe's number, above which numbers are one less; or none
Surface surface_of(const Scene& scene, bool without_probe = false) {
  const auto name = [&](Mesh::Vertex_index v) {
    const std::size_t n = scene.sculptor.name(v);
    return n - (without_probe && n > scene.sculptor.name(scene.probe));
  };
  Surface surface;
  for (const auto v : scene.mesh.vertices())
    if (v != scene.probe) {
      const auto& p = scene.mesh.point(v);
      surface.points[name(v)] = {p.x(), p.y(), p.z()};
    }
  for (const auto f : scene.mesh.faces()) {
    std::array<std::uint64_t, 3> face{};
    int i = 0;
    for (const auto v : scene.mesh.vertices_around_face(scene.mesh.halfedge(f)))
      face[i++] = name(v);
    surface.add_face(face);
  }
  std::sort(surface.faces.begin(), surface.faces.end());
  return surface;
}

Surface surface_of(const Scene_copy& copy) {
  Surface surface;
  for (std::size_t v = 0; v < copy.names.size(); ++v)
    if (copy.names[v] != Scene_copy::absent)
      surface.points[copy.names[v]] = copy.points[v];
  for (const auto& f : copy.faces)
    if (f[0] != Scene_copy::no_corner)
      surface.add_face({copy.names[f[0]], copy.names[f[1]], copy.names[f[2]]});
  std::sort(surface.faces.begin(), surface.faces.end());
  return surface;
}

/// What a journal says, made again by other means: no probe, no tool, no slide, each leg by itself.
Surface made_again(Mesh mesh, const Entries& entries) {
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
  std::vector<Sculptor<Mesh>::Stroke_type> strokes;
  std::size_t failed = 0;
  for (const Journal_entry& e : entries) {
    using Kind = Journal_entry::Kind;
    const Mesh::Point p(e.point[0], e.point[1], e.point[2]);
    const auto& v = e.vertices;
    switch (e.kind) {
    case Kind::move:
      failed += !sculptor.grab(sculptor.vertex(v[0])).drag_to(p).reached;
      break;
    case Kind::insert_on_face:
      failed += !sculptor.insert_on_face(sculptor.face_of(v[0], v[1], v[2]), p);
      break;
    case Kind::insert_on_edge:
      failed += !sculptor.insert_on_edge(sculptor.edge_of(v[0], v[1]), p);
      break;
    case Kind::collapse: {
      auto h = mesh.halfedge(sculptor.edge_of(v[0], v[1]));
      h = mesh.target(h) == sculptor.vertex(v[1]) ? h : mesh.opposite(h);
      failed += !sculptor.collapse(h);
      break;
    }
    case Kind::remove: // is said as a collapse
      ++failed;
      break;
    case Kind::undo:
      failed += !sculptor.undo();
      break;
    case Kind::redo:
      failed += !sculptor.redo();
      break;
    case Kind::stroke:
      strokes.push_back(sculptor.stroke());
      break;
    case Kind::end:
      strokes.pop_back();
      break;
    case Kind::tick:
      break;
    }
  }
  BOOST_TEST(failed == 0u);
  Surface surface;
  for (const auto w : mesh.vertices())
    surface.points[sculptor.name(w)] = {mesh.point(w).x(), mesh.point(w).y(), mesh.point(w).z()};
  for (const auto f : mesh.faces()) {
    std::array<std::uint64_t, 3> face{};
    int i = 0;
    for (const auto w : mesh.vertices_around_face(mesh.halfedge(f)))
      face[i++] = sculptor.name(w);
    surface.add_face(face);
  }
  std::sort(surface.faces.begin(), surface.faces.end());
  return surface;
}

/// What a window's thread does: shows, and asks for edits.
class Window {
public:
  Window(Loop_desk<Scene>& desk, Scene_feed& feed, std::uint64_t seed) : desk_(desk), feed_(feed), random_(seed) {}

  std::size_t done = 0, refused = 0, copies = 0, left = 0;
  std::unique_ptr<Scene_copy> shown;
  bool is_current = false; ///< nothing was lost since the copy

  void ask_for_copy() {
    if (asked_)
      return;
    asked_ = std::make_unique<Scene_copy>(4000, 8000);
    Command command;
    command.kind = Command::Kind::copy, command.copy = asked_.get();
    lost_at_copy_ = feed_.lost_changes();
    if (!desk_.ask(command))
      asked_.reset();
  }
  bool waits_for_copy() const { return asked_ != nullptr; }

  void ask_for_something() {
    Command command;
    const auto vertex = random_() % 160;
    using Kind = Command::Kind;
    constexpr Kind kinds[] = {Kind::undo, Kind::redo, Kind::remove, Kind::insert_on_face, Kind::let_go, Kind::undo};
    command.kind = kinds[random_() % 6];
    command.vertices = {vertex, vertex + 1, vertex + 2};
    if (command.kind == Kind::insert_on_face && shown) { // on a face that is seen; maybe it is gone by then
      const auto& f = shown->faces[random_() % 200];
      if (f[0] == Scene_copy::no_corner)
        return;
      for (int i = 0; i < 3; ++i) {
        command.vertices[i] = shown->names[f[i]];
        for (int k = 0; k < 3; ++k)
          command.point[k] += shown->points[f[i]][k] / 3;
      }
    }
    desk_.ask(command);
  }

  void look() {
    Scene_change change;
    while (feed_.take(change)) {
      if (change.kind == Scene_change::Kind::replaced)
        is_current = false;
      later_.push_back(change);
      if (shown && change.number > shown->number)
        shown->follow(change);
    }
    Tick_view tick;
    while (feed_.take(tick))
      last_tick = tick.tick;
    Loop_answer<Scene> answer;
    while (desk_.take(answer)) {
      ++(answer.done ? done : refused);
      left += answer.left != nullptr;
      if (answer.copy == nullptr)
        continue;
      ++copies;
      BOOST_TEST(answer.done);
      shown = std::move(asked_);
      // What was lost before the last change in the copy does not matter; that of later ones is not known here.
      is_current = true;
      for (const Scene_change& c : later_) {
        is_current = is_current && !(c.kind == Scene_change::Kind::replaced && c.number > shown->number);
        if (c.number > shown->number)
          shown->follow(c);
      }
    }
    if (!asked_)
      later_.clear();
    if (feed_.lost_changes() != lost_at_copy_)
      is_current = false;
  }
  std::uint64_t last_tick = 0;

private:
  Loop_desk<Scene>& desk_;
  Scene_feed& feed_;
  std::mt19937_64 random_;
  std::unique_ptr<Scene_copy> asked_;
  std::vector<Scene_change> later_; ///< while a copy is on its way
  std::uint64_t lost_at_copy_ = 0;
};

/// A loop, a window and a writer, each with a thread.
struct Threads {
  std::unique_ptr<Scene> scene = scene_of(2), other = scene_of(2);
  Loop_desk<Scene> desk{16};
  Scene_feed feed;
  Edit_journal journal{1000000, 1};
  Entries entries;
  std::uint64_t ticks = 0;
  std::size_t edits = 0;
  Scene* last = nullptr;

  explicit Threads(std::size_t room) : feed(room, 64) {}

  template <class Work>
  void run(bool keeps_journal, const Work& window) {
    std::atomic<bool> ends{false}, has_ended{false};
    std::thread loop_thread([&] {
      Loop loop(scene->sculptor, scene->probe, scene->map, parameters_of_tests());
      Session session(loop, *scene, &desk, &feed, keeps_journal ? &journal : nullptr);
      while (!ends) {
        session.tick(reading_at(session.ticks()));
        if (loop.has_stopped())
          break;
        if (session.ticks() % 8 == 0) // others get a turn
          std::this_thread::yield();
      }
      session.end();
      ticks = session.ticks(), edits = loop.tool().edits().grabbed + loop.tool().edits().created;
      last = &session.scene();
      has_ended = true;
    });
    std::thread writer([&] {
      Journal_entry entry;
      for (bool was_ended = false; keeps_journal;) {
        while (journal.take(entry)) {
          entries.push_back(entry);
          journal.wrote(entry.kind == Journal_entry::Kind::tick);
        }
        if (was_ended)
          break;
        was_ended = has_ended;
        std::this_thread::yield();
      }
    });
    window();
    ends = true;
    loop_thread.join(), writer.join();
  }
};

BOOST_AUTO_TEST_CASE(a_window_asks_and_sees_and_a_journal_is_kept_while_the_loop_runs) {
  Threads threads(std::size_t{1} << 18);
  Window window(threads.desk, threads.feed, 7);
  threads.run(true, [&] {
    window.ask_for_copy();
    for (int k = 0; k < 300 || window.last_tick < 9000; ++k) {
      window.look();
      if (!window.waits_for_copy() && window.last_tick > 1000 && k % 5 == 0)
        window.ask_for_something();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    while (window.waits_for_copy())
      window.look();
  });
  window.look();
  BOOST_TEST_MESSAGE(threads.ticks << " ticks, " << threads.edits << " grabs and creations, " << window.done
                                   << " commands done, " << window.refused << " refused, " << threads.entries.size()
                                   << " entries");
  BOOST_TEST(window.done > 20u);
  BOOST_TEST(window.refused > 0u);
  BOOST_TEST(threads.edits >= 2u);
  BOOST_TEST(threads.feed.lost_changes() == 0u);
  BOOST_TEST(!threads.journal.has_overrun());
  BOOST_TEST(window.is_current);
  BOOST_TEST((surface_of(*window.shown) == surface_of(*threads.scene)));
  BOOST_TEST((made_again(meshes::to_mesh(meshes::bumpy_sphere(2, 0.12)), threads.entries) == surface_of(*threads.scene, true)));
  Mesh sculpted = threads.scene->mesh;
  sculpted.remove_vertex(threads.scene->probe);
  BOOST_TEST(validate(sculpted).is_valid());
  BOOST_TEST(validate(window.shown->mesh<Mesh>()).is_valid());
}

BOOST_AUTO_TEST_CASE(a_removal_that_a_probe_has_turned_elsewhere_is_made_again_by_what_its_journal_says) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto random_vector = [&] {
    const double x = number(random), y = number(random), z = number(random);
    return Vector3d(x, y, z);
  };
  std::size_t removed = 0, elsewhere = 0;
  for (int round = 0; round < 500; ++round) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
    // A pit whose rim is no plane: which neighbour its bottom is drawn into says what is passed over near the rim.
    const Mesh::Vertex_index bottom(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    Vector3d middle = Vector3d::Zero();
    {
      Sculptor<Mesh> sculptor(mesh);
      for (const auto w : mesh.vertices_around_target(mesh.halfedge(bottom))) {
        const Vector3d to = internal::vector_of(mesh.point(w)) + 0.1 * random_vector();
        sculptor.grab(w).drag_to(internal::point_of<Mesh::Point>(to));
        middle += internal::vector_of(mesh.point(w)) / mesh.degree(bottom);
      }
      sculptor.grab(bottom).drag_to(internal::point_of<Mesh::Point>(0.8 * middle));
    }
    Scene scene(mesh, [](const Vector3d&, const Vector3d&) { return map_of_tests; });
    Tool<Scene::Sculptor_type> tool(scene.sculptor, scene.probe, map_of_tests, 0.01, 0.001);
    Edit_journal journal(100);
    tool.keep_journal(&journal);
    const Vector3d hand = map_of_tests.to_device(middle + 0.08 * random_vector());
    tool.move(hand, 0); // puts the probe there, if that is outside
    if (tool.move(hand, 2).event != Tool_event::removed || tool.vertex() != scene.probe)
      continue;
    ++removed;
    Entries entries(1);
    BOOST_TEST(journal.take(entries[0]));
    BOOST_TEST((entries[0].kind == Journal_entry::Kind::collapse));
    Mesh without_probe = mesh;
    Sculptor<Mesh> sculptor(without_probe);
    const auto made = sculptor.remove(sculptor.vertex(entries[0].vertices[0]));
    elsewhere += !made || sculptor.name(*made.vertex) != entries[0].vertices[1];
    BOOST_TEST((made_again(mesh, entries) == surface_of(scene, true)));
  }
  BOOST_TEST_MESSAGE(removed << " removals, of which the probe has turned " << elsewhere << " elsewhere");
  BOOST_TEST(removed >= 50u);
  BOOST_TEST(elsewhere >= 5u);
}

BOOST_AUTO_TEST_CASE(a_slow_viewer_loses_changes_is_told_and_gets_a_copy_and_another_scene_comes_in) {
  Threads threads(8);
  Window window(threads.desk, threads.feed, 11);
  Scene* const first = threads.scene.get();
  threads.run(false, [&] {
    while (threads.feed.lost_changes() == 0) // nobody looks
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    Command enter;
    enter.kind = Command::Kind::enter, enter.scene = threads.other.get();
    BOOST_TEST(threads.desk.ask(enter));
    while (window.left == 0)
      window.look();
    BOOST_TEST(!window.is_current);
    window.ask_for_copy();
    while (window.waits_for_copy())
      window.look();
  });
  const std::uint64_t lost = threads.feed.lost_changes();
  BOOST_TEST(lost > 0u);
  BOOST_TEST(threads.feed.lost_ticks() > 0u);
  BOOST_TEST(threads.last == threads.other.get());
  BOOST_TEST(threads.last != first);
  BOOST_TEST(window.copies == 1u);
  BOOST_TEST(validate(window.shown->mesh<Mesh>()).is_valid()); // the mesh of one tick, though the hand went on
  // With the loop at rest a copy is the mesh, whatever was lost.
  Scene_copy copy(4000, 8000);
  copy.begin();
  while (!copy.copy_some(threads.last->sculptor, threads.last->probe, 7))
    ;
  BOOST_TEST((surface_of(copy) == surface_of(*threads.last)));
}

BOOST_AUTO_TEST_CASE(a_journal_that_is_not_written_in_time_ends_at_the_end_of_a_tick) {
  Journal_entry move, taken;
  move.kind = Journal_entry::Kind::move;
  { // too old: a tick waits, and nothing else happens
    Edit_journal journal(100);
    journal.add(move);
    journal.end_tick(5);
    for (std::uint64_t tick = 6; tick <= 104; ++tick) {
      journal.end_tick(tick);
      BOOST_TEST(journal.age(tick) <= 100u);
      BOOST_TEST(!journal.has_overrun());
    }
    journal.end_tick(105);
    BOOST_TEST(journal.has_overrun());
    journal.add(move);
    BOOST_TEST(journal.lost() == 1u);
  }
  { // too many: the tick that finds no room is not ended
    Edit_journal journal(100, 1);
    std::uint64_t tick = 0;
    for (; !journal.has_overrun(); ++tick) {
      for (int k = 0; k < 10; ++k)
        journal.add(move);
      journal.end_tick(tick);
    }
    std::uint64_t whole = 0, rest = 0;
    while (journal.take(taken)) {
      ++rest;
      if (taken.kind == Journal_entry::Kind::tick) {
        BOOST_TEST(taken.vertices[0] == whole);
        ++whole, rest = 0;
      }
    }
    BOOST_TEST(whole == tick - 1);
    BOOST_TEST(rest < 11u);
    BOOST_TEST(journal.lost() > 0u);
  }
  { // in time: nothing ends
    Edit_journal journal(100);
    for (std::uint64_t tick = 0; tick < 5000; ++tick) {
      journal.add(move);
      journal.end_tick(tick);
      while (tick % 90 == 0 && journal.take(taken))
        journal.wrote(taken.kind == Journal_entry::Kind::tick);
    }
    BOOST_TEST(!journal.has_overrun());
    BOOST_TEST(journal.lost() == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_device_of_pose_and_force_feels_a_wall_and_its_faults_end_at_no_force) {
  for (const int fault : {0, 1, 2}) {
    Mesh mesh = meshes::to_mesh(meshes::box(1, 1)); // [0, 1]^3
    const auto probe = mesh.add_vertex(Mesh::Point(0.5, 0.4, 3));
    Sculptor<Mesh> sculptor(mesh);
    Pose_loop_parameters parameters = parameters_of_tests();
    parameters.friction = 2, parameters.coupling.stiffness = 4001;
    BOOST_CHECK_THROW(Pose_loop<Sculptor<Mesh>>(sculptor, probe, map_of_tests, parameters), Error);
    parameters.coupling.stiffness = 700;
    Pose_loop<Sculptor<Mesh>> loop(sculptor, probe, map_of_tests, parameters);
    Pose_reading reading;
    const auto go = [&](double z) {
      reading.position = map_of_tests.to_device(Vector3d(0.5, 0.4, z)), reading.elapsed = 0.001;
      return loop.tick(reading);
    };
    for (int k = 0; k < 400; ++k)
      BOOST_TEST(go(1.4).force == Vector3d::Zero());
    Pose_tick tick;
    for (int k = 0; k <= 200; ++k)
      tick = go(1.4 - 0.0025 * k);
    for (int k = 0; k < 50; ++k)
      tick = go(0.9);
    BOOST_TEST((tick.force - Vector3d(0, 0, 700 * 0.1 / 50)).norm() <= 1e-9);
    reading.position[0] += fault == 0 ? NAN : fault == 1 ? 0.5 : 0, reading.elapsed = fault == 2 ? 0.1 : 0.001;
    tick = loop.tick(reading);
    BOOST_TEST((tick.fault == (fault == 0   ? Loop_fault::not_finite
                               : fault == 1 ? Loop_fault::jump
                                            : Loop_fault::stall)));
    for (int k = 0; k < 101; ++k)
      tick = go(0.9);
    BOOST_TEST(tick.force == Vector3d::Zero());
    BOOST_TEST(loop.has_stopped());
    loop.restart();
    BOOST_TEST(go(0.9).force == Vector3d::Zero()); // anchored
    BOOST_TEST(!loop.has_stopped());
  }
}

} // namespace
