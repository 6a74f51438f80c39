// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../sculpt/Log_text.h"
#include "../sculpt/many_vertices_lines.h"

#include <haptic_sculpt/haptic_rendering/exchange/Loop_scene.h>

namespace haptic_sculpt::loop_program {

/// Makes the lines of a log again in a scene: what can be undone afterwards is what could be before.
template <class Scene>
class Log_replay {
public:
  using Sculptor_type = typename Scene::Sculptor_type;
  using Command = sculpt_program::Command;
  using Kind = Command::Kind;

  explicit Log_replay(Scene& scene) : scene_(scene), sculptor_(scene.sculptor) {}

  /// Strokes that are open at the end, end.
  void run(const std::vector<Command>& commands) {
    for (const Command& command : commands)
      make(command);
    while (sculptor_.apply(Edit::of(Edit_kind::end))) // strokes that are open
      ;
    sculptor_.set_drag_parameters(Drag_parameters());
    if (sculptor_.parameters().delta_length != 0)
      sculptor_.set_delta(0);
  }

private:
  Scene& scene_;
  Sculptor_type& sculptor_;

  void make(const Command& c) {
    if (const auto edit = sculpt_program::edit_of(c)) {
      try {
        sculptor_.apply(*edit);
      } catch (const Invalid_parameter&) { // a clearance that the scene has outgrown: the edit was refused then, too
        sculptor_.release();
      }
      return;
    }
    sculptor_.release();
    switch (c.kind) {
    case Kind::response:
      sculptor_.set_drag_parameters(drag().response(*response_named(c.word)));
      break;
    case Kind::clearance:
      clearance(c);
      break;
    case Kind::delta:
      delta(c);
      break;
    case Kind::brush:
      sculpt_program::carry_out_brush(sculptor_, c);
      break;
    case Kind::remesh:
      sculpt_program::carry_out_remesh(sculptor_, c);
      break;
    default:
      break;
    }
  }

  Drag_parameters drag() const { return sculptor_.parameters().drag; }
  void clearance(const Command& c) {
    try {
      sculptor_.set_drag_parameters(c.word == "default" ? drag().clearance(std::nullopt) : drag().clearance(c.length));
    } catch (const Invalid_parameter&) { // refused then, too
    }
  }
  void delta(const Command& c) {
    if (c.length == sculptor_.parameters().delta_length)
      return;
    try {
      sculptor_.set_delta(c.length);
    } catch (const Invalid_surface&) {   // refused then, too
    } catch (const Invalid_parameter&) { // a clearance that the scene has outgrown
    }
  }
};

} // namespace haptic_sculpt::loop_program
