// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/exchange/Command_queue.h>
#include <haptic_sculpt/haptic_rendering/exchange/Scene_copy.h>

namespace haptic_sculpt {

/// Copies the mesh, to save it or to show it, some elements a tick, while the hand goes on. For one copy: the next one
/// is another task.
template <class Scene>
class Copy_task : public Loop_task<Scene> {
public:
  using typename Loop_task<Scene>::Tool_type;
  /// Elements, about 30 microseconds.
  static constexpr std::size_t copied_a_tick = 1000;

  /// Room as in Scene_copy: for what comes while it is under way, too.
  Copy_task(std::size_t vertices, std::size_t faces) : copy(vertices, faces) {}

  Scene_copy copy; ///< whole when the task is done, if there was room

  /// A slice; where another copy is under way, none yet. Allocates nothing.
  bool go_on(Scene& scene, Tool_type&) override {
    auto& visitor = scene.sculptor.visitor();
    if (visitor.copy() == nullptr) {
      copy.begin();
      visitor.tell_to(&copy);
    }
    if (visitor.copy() != &copy)
      return false;
    try {
      if (!copy.copy_some(scene.sculptor, copied_a_tick))
        return false;
    } catch (...) { // of a Sculptor that a fault has left unfinished: the task is not gone on with
      visitor.tell_to(nullptr);
      throw;
    }
    visitor.tell_to(nullptr);
    return true;
  }
};

} // namespace haptic_sculpt
