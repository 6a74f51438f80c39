// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Tool_step.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

#include <boost/lockfree/spsc_queue.hpp>

#include <array>
#include <atomic>
#include <cstdint>

namespace haptic_sculpt {

/// A face as it is after a tick, by value; or none at its index any more.
struct Face_change {
  std::uint32_t scene = 0;                 ///< of the scenes that the loop has entered, from 0
  std::uint32_t index = 0;                 ///< of the face; indices are used again
  bool is_there = false;                   ///< false: what stood at the index is gone
  std::array<std::uint64_t, 3> vertices{}; ///< the numbers of its corners that last, counterclockwise from outside
  std::array<std::array<double, 3>, 3> corners{}; ///< where they are
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
  std::uint64_t faces_passed_on = 0;   ///< so far: who has taken these, while none waits, has the mesh of this tick
  std::uint64_t faces_waiting = 0;     ///< that have changed and are passed on later
};

/// A way from the loop's thread to one viewer or logger, which never stops the loop. No change is lost: a face that
/// finds no room is passed on later, as it is then. Ticks that find no room are lost, and counted.
///
/// \tparam Face what is passed on of a face: Face_change, or what is derived from it (`Loop_scene::Face_type`)
template <class Face>
class Basic_scene_feed {
public:
  /// \param faces, ticks room for this many that have not been taken; allocated here
  explicit Basic_scene_feed(std::size_t faces = std::size_t{1} << 16, std::size_t ticks = 4096)
      : faces_(faces), ticks_(ticks) {}

  /// \name The loop's thread
  ///@{

  /// Passes a face on. \return false where there is no room: then again, later
  bool tell(const Face& face) { return faces_.push(face) && ++passed_on_ != 0; }
  /// Passes a tick on.
  void tell(const Tick_view& tick) {
    if (!ticks_.push(tick))
      lost_ticks_.fetch_add(1, std::memory_order_relaxed);
  }
  std::uint64_t passed_on() const { return passed_on_; } ///< faces so far
  ///@}

  /// \name The viewer's thread
  ///@{

  bool take(Face& face) { return faces_.pop(face); }      ///< the next; false where there is none yet
  bool take(Tick_view& tick) { return ticks_.pop(tick); } ///< the next; false where there is none yet
  /// Ticks that found no room so far.
  std::uint64_t lost_ticks() const { return lost_ticks_.load(std::memory_order_relaxed); }
  ///@}

private:
  boost::lockfree::spsc_queue<Face> faces_;
  boost::lockfree::spsc_queue<Tick_view> ticks_;
  std::uint64_t passed_on_ = 0;
  std::atomic<std::uint64_t> lost_ticks_{0};
};

/// Of scenes whose viewers need no more than corners.
using Scene_feed = Basic_scene_feed<Face_change>;

} // namespace haptic_sculpt
