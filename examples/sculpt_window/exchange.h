// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What the window's thread and the loop's thread tell each other, all of it by value. Lengths are in the mesh's unit.
/// Numbers of vertices are those of files and logs.

#include <haptic_sculpt/haptic_rendering/Pose_reading.h>
#include <haptic_sculpt/haptic_rendering/exchange/Scene_feed.h>
#include <haptic_sculpt/sculpting/brushes/Dab_3.h>

#include <Eigen/Core>

#include <array>
#include <atomic>
#include <cstdint>

namespace haptic_sculpt::window_program {

struct Model;

using Place = std::array<double, 3>;

inline Eigen::Vector3d vector(const Place& p) {
  return {p[0], p[1], p[2]};
}
inline Place place(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}

enum class Tool : std::uint8_t { drag, probe, create, remove, brush, object };
inline constexpr const char* tool_words[] = {"drag", "probe", "create", "remove", "brush", "object"}; ///< of scripts

/// Where the mouse is: it points along the segment from the eye to beyond the mesh.
struct Pointer {
  Place from{}, to{};
  Place view{};              ///< the direction in which the eye looks: a drag stays in the plane across it
  bool along_normal = false; ///< a drag goes along the vertex's normal instead
};

/// Where the mouse's line meets the plane through p across the view.
inline Eigen::Vector3d on_plane(const Pointer& pointer, const Eigen::Vector3d& p) {
  const Eigen::Vector3d from = vector(pointer.from), way = vector(pointer.to) - from, across = vector(pointer.view);
  const double slope = way.dot(across);
  return slope > 0 ? Eigen::Vector3d(from + (p - from).dot(across) / slope * way) : p;
}

/// What a brush is for: what the library's brushes do, in their order, and what the window does by itself.
enum class Brush_use : std::uint8_t { grab, inflate, smooth, flatten, pinch, mask, unmask };
inline constexpr int brush_uses = 7;
inline constexpr const char* brush_words[] = {"grab", "inflate", "smooth", "flatten", "pinch", "mask", "unmask"};

struct Brush {
  Brush_use use = Brush_use::inflate;
  double radius = 0;
  double strength = 0.5;          ///< of what the brush can do in a dab, from -1 (the other way) to 1
  std::array<bool, 3> symmetry{}; ///< each dab is made on the other side of the plane across x, y, z, too
  bool remeshes = false;          ///< triangles under it keep to its size

  /// Of triangles that it can work with; never longer than they were on the mean when the mesh came.
  double edge_length(double at_first) const { return radius / 12 < at_first ? radius / 12 : at_first; }
};

/// What the device says: on its way to the loop the newest counts.
struct Mouse_reading {
  Pose_reading pose;
  Pointer pointer;          ///< where a brush goes
  std::uint64_t number = 0; ///< from 1
  std::uint64_t press = 0;  ///< of the button, that it belongs to: the handle begins anew with each
};

/// A face, and how it is to be lit and tinted.
struct Seen_face : Face_change {
  std::array<std::array<float, 3>, 3> normals{}; ///< at the corners, of length 1: of the faces that go on smoothly
  std::array<float, 3> masks{};                  ///< at the corners: 1 is held still
};

struct Contact_view {
  const char* kind = "";
  int still = 0; ///< this many of `points` are the feature that stands still: 1 a vertex, 2 an edge, 3 a face
  std::array<Place, 3> points{};
  std::array<std::size_t, 3> ids{};
  Place normal{};
};

struct Percentiles {
  std::uint64_t p50 = 0, p99 = 0, p999 = 0, largest = 0; ///< ns
};

/// What the mouse points at.
struct Pointed {
  const char* feature = ""; ///< vertex, edge or face; empty: nothing
  Place at{}, normal{};     ///< of the face, of any length
  std::array<std::size_t, 3> ids{};
  int size = 0; ///< how many ids
};

/// What there is to see, as of one tick.
struct Status {
  enum class Hold : std::uint8_t { nothing, vertex, probe, brush, object };
  static constexpr int most_contacts = 8;

  std::uint64_t ticks = 0, missed_by_work = 0, woken_late = 0;
  std::uint64_t made = 0;      ///< ticks by the session: fewer where the disk stays behind
  std::uint64_t mouse = 0;     ///< the number of the Mouse_reading that the last of them had
  bool waits_for_disk = false; ///< until the log is written
  bool log_has_failed = false; ///< what is done is not in it any more
  Percentiles work, lateness;

  Hold hold = Hold::nothing;
  std::size_t vertex = 0; ///< held: its number that lasts
  Place target{}, proxy{};
  Place force{}; ///< on the hand, N
  bool reached = true;
  const char* end = "";
  int contacts = 0; ///< shown: at most most_contacts
  std::array<Contact_view, most_contacts> contact{};
  Pointed pointed; ///< while nothing is held; else where a brush or an object is

  std::uint32_t scene = 0; ///< the number of the mesh that all this is of, from 1
  std::size_t vertices = 0, faces = 0;
  std::size_t vertex_slots = 0, face_slots = 0; ///< removed ones included
  std::size_t undo_steps = 0, redo_steps = 0;
  std::uint64_t edits = 0;     ///< ticks that changed the mesh, since it was entered; undo and redo count
  std::size_t dirty_faces = 0; ///< not told yet

  std::uint64_t failures = 0;      ///< ticks that ended by an error, and let go
  std::array<char, 200> failure{}; ///< the last of them, for people
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
