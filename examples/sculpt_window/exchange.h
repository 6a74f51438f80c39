// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_EXCHANGE_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_EXCHANGE_H

/// \file
/// What the window's thread and the loop's thread tell each other, all of it by value. Lengths are in the mesh's unit.

#include <Eigen/Core>

#include <array>
#include <atomic>
#include <cstdint>

namespace haptic_sculpt {
class Scene_copy;
}

namespace haptic_sculpt::window_program {

struct Model;

using Place = std::array<double, 3>;

inline Eigen::Vector3d vector(const Place& p) {
  return {p[0], p[1], p[2]};
}
inline Place place(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}

enum class Tool : std::uint8_t { drag, probe, create, remove, brush };
enum class Brush_kind : std::uint8_t { grab, inflate, smooth, flatten, pinch }; ///< as in examples/brushes.h

/// Where the mouse is: it points along the segment from the eye to beyond the mesh.
struct Pointer {
  Place from{}, to{};
  Place view{};              ///< the direction in which the eye looks: a drag stays in the plane across it
  bool along_normal = false; ///< a drag goes along the vertex's normal instead
};

struct Brush {
  Brush_kind kind = Brush_kind::inflate;
  double radius = 0;
  double strength = 0.5; ///< of what the brush can do in a dab, from -1 (the other way) to 1
};

/// What the window asks of the loop.
struct Request {
  enum class Kind : std::uint8_t { point, press, let_go, flip, collapse, undo, redo, response, copy, enter };
  Kind kind = Kind::point;
  std::uint64_t number = 0; ///< Status::answered tells when it was done
  Pointer pointer;
  Tool tool = Tool::drag;
  Brush brush;
  double depth = 0;           ///< by how much a probe is pressed into what it points at
  int response = 0;           ///< 0: slide, 1: stop
  Model* model = nullptr;     ///< enter: it is the loop's until it comes back as Report::Kind::left
  Scene_copy* copy = nullptr; ///< copy: the loop's until it comes back, filled, as Report::Kind::copied
};

/// What the loop tells besides its Status.
struct Report {
  enum class Kind : std::uint8_t { said, refused, left, copied };
  Kind kind = Kind::said;
  std::array<char, 200> text{};
  Model* model = nullptr;
  Scene_copy* copy = nullptr;
  std::uint64_t edits = 0; ///< copied: Status::edits of that moment
};

/// A face as it is now, or none at its index any more.
struct Face_change {
  std::uint32_t scene = 0; ///< which of the models that were entered, from 1
  std::uint32_t index = 0;
  bool is_there = false;
  std::array<Place, 3> corners{};
};

struct Contact_view {
  const char* kind = "";
  int still = 0; ///< so many of `points` are the feature that stands still: 1 a vertex, 2 an edge, 3 a face
  std::array<Place, 3> points{};
  std::array<std::size_t, 3> names{};
  Place normal{};
};

struct Percentiles {
  std::uint64_t p50 = 0, p99 = 0, p999 = 0, largest = 0; ///< ns
};

/// What there is to see, as of one tick.
struct Status {
  enum class Hold : std::uint8_t { nothing, vertex, probe, brush };
  static constexpr int most_contacts = 8;

  std::uint32_t scene = 0;
  std::uint64_t answered = 0; ///< the number of the last request that was done
  std::uint64_t ticks = 0, missed_by_work = 0, woken_late = 0;
  Percentiles work, lateness;

  Hold hold = Hold::nothing;
  std::size_t vertex = 0; ///< held: its number that lasts
  Place target{}, proxy{};
  Place force{}; ///< on the hand, N
  bool reached = true;
  const char* end = "";
  int contacts = 0; ///< shown: at most most_contacts
  std::array<Contact_view, most_contacts> contact{};

  const char* pointed = ""; ///< vertex, edge or face; empty: nothing
  Place pointed_at{};
  std::array<std::size_t, 3> pointed_names{};
  int pointed_size = 0;

  std::size_t vertices = 0, faces = 0;
  std::size_t vertex_slots = 0, face_slots = 0; ///< removed ones included
  std::size_t undo_steps = 0, redo_steps = 0;
  std::uint64_t edits = 0;     ///< that changed the mesh, since it was entered; undo and redo count
  std::size_t dirty_faces = 0; ///< not told yet
  std::size_t brush_left = 0;  ///< vertices of the dab under way
};

/// The newest value that one thread has given to another. Neither waits (a triple buffer).
template <class Value>
class Latest {
public:
  void put(const Value& value) {
    slots_[back_] = value;
    back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & 3u;
  }
  const Value& get() {
    if ((middle_.load(std::memory_order_relaxed) & fresh) != 0)
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & 3u;
    return slots_[front_];
  }

private:
  static constexpr unsigned fresh = 4;
  std::array<Value, 3> slots_{};
  unsigned back_ = 0, front_ = 2;
  std::atomic<unsigned> middle_{1};
};

} // namespace haptic_sculpt::window_program

#endif
