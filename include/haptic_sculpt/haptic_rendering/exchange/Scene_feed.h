// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_SCENE_FEED_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_SCENE_FEED_H

#include <haptic_sculpt/haptic_rendering/Tool_step.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

#include <boost/lockfree/spsc_queue.hpp>

#include <array>
#include <atomic>
#include <cstdint>

namespace haptic_sculpt {

/// A change of the mesh, by value. Indices are those of the mesh's own descriptors, which it uses again.
struct Scene_change {
  /// What has changed.
  enum class Kind : std::uint8_t {
    vertex_moved,
    vertex_created,
    vertex_dies,
    face_created, ///< with these corners
    face_dies,
    replaced ///< all of the scene is another: a copy of it is needed
  };
  Kind kind = Kind::vertex_moved;         ///< says which of the members below count
  std::uint32_t index = 0;                ///< of the vertex or face
  std::array<std::uint32_t, 3> corners{}; ///< of a face, counterclockwise from outside
  std::array<double, 3> point{};          ///< of a vertex that was moved or created
  std::uint64_t id = 0;                   ///< of a vertex that was created: its number that lasts
  std::uint64_t number = 0;               ///< of the change, from 1; those that were lost count
};

/// A tick, as a viewer or a logger sees it. Places in the scene, forces in N on the hand in axes of the device.
struct Tick_view {
  std::uint64_t tick = 0;              ///< its number, from 0
  std::array<double, 3> target{},      ///< where the hand wants what it holds
      proxy{},                         ///< where that is
      force{};                         ///< rendered
  bool reached = true;                 ///< the proxy is at the target
  bool starved = false;                ///< the drag was cut short before any contact was found: no force stands for it
  bool holds_vertex = false;           ///< one of the surface; else the probe is in hand, or nothing
  std::uint64_t vertex = 0;            ///< held: its number that lasts
  int contacts = 0;                    ///< that hold the proxy
  Tool_event event = Tool_event::none; ///< what the button did in this tick
  Loop_fault fault = Loop_fault::none; ///< why the loop has let go of the hand
};

/// A way from the loop's thread to one viewer or logger, which never stops the loop: what finds no room is lost, and
/// counted. Who sees that `lost_changes()` has grown asks for a new copy of the scene (Copy_task).
class Scene_feed {
public:
  /// \param changes, ticks room for this many that have not been taken; allocated here
  explicit Scene_feed(std::size_t changes = std::size_t{1} << 16, std::size_t ticks = 4096)
      : changes_(changes), ticks_(ticks) {}

  /// \name The loop's thread
  ///@{

  /// Gives the change the next number and passes it on. \return the change with its number
  Scene_change tell(Scene_change change) {
    change.number = ++number_;
    if (!changes_.push(change))
      lost_changes_.fetch_add(1, std::memory_order_relaxed);
    return change;
  }
  /// Passes a tick on.
  void tell(const Tick_view& tick) {
    if (!ticks_.push(tick))
      lost_ticks_.fetch_add(1, std::memory_order_relaxed);
  }
  /// Of the last change.
  std::uint64_t number() const { return number_; }
  ///@}

  /// \name The viewer's thread
  ///@{

  bool take(Scene_change& change) { return changes_.pop(change); } ///< the next; false where there is none yet
  bool take(Tick_view& tick) { return ticks_.pop(tick); }          ///< the next; false where there is none yet
  /// Changes that found no room so far.
  std::uint64_t lost_changes() const { return lost_changes_.load(std::memory_order_relaxed); }
  /// Ticks that found no room so far.
  std::uint64_t lost_ticks() const { return lost_ticks_.load(std::memory_order_relaxed); }
  ///@}

private:
  boost::lockfree::spsc_queue<Scene_change> changes_;
  boost::lockfree::spsc_queue<Tick_view> ticks_;
  std::uint64_t number_ = 0;
  std::atomic<std::uint64_t> lost_changes_{0}, lost_ticks_{0};
};

} // namespace haptic_sculpt

#endif
