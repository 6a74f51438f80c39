// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_HAPTIC_LOOP_REPLAY_LOG_H
#define HAPTIC_SCULPT_EXAMPLES_HAPTIC_LOOP_REPLAY_LOG_H

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
    sculptor_.set_work_limit(std::nullopt);
    for (const Command& command : commands)
      make(command);
    sculptor_.release();
    strokes_.clear();
    sculptor_.set_response(Response::slide);
    sculptor_.set_default_clearance();
    if (sculptor_.options().delta_length != 0)
      sculptor_.set_delta(0);
  }

private:
  Scene& scene_;
  Sculptor_type& sculptor_;
  std::optional<typename Sculptor_type::Grab_type> grab_;
  bool held_ = false;
  std::vector<typename Sculptor_type::Stroke_type> strokes_;

  void make(const Command& c) {
    if (c.kind != Kind::drag)
      held_ = false;
    switch (c.kind) {
    case Kind::drag:
      drag(c);
      break;
    case Kind::insert_face:
      sculptor_.insert_on_face(sculptor_.face_of(c.indices[0], c.indices[1], c.indices[2]), point(c));
      break;
    case Kind::insert_edge:
      sculptor_.insert_on_edge(sculptor_.edge_of(c.indices[0], c.indices[1]), point(c));
      break;
    case Kind::remove:
      sculptor_.remove(sculptor_.vertex(c.indices[0]));
      break;
    case Kind::collapse:
      sculptor_.collapse(halfedge(c));
      break;
    case Kind::flip:
      sculptor_.flip(sculptor_.edge_of(c.indices[0], c.indices[1]));
      break;
    case Kind::undo:
      sculptor_.undo();
      break;
    case Kind::redo:
      sculptor_.redo();
      break;
    case Kind::stroke:
      strokes_.push_back(sculptor_.stroke());
      break;
    case Kind::end:
      if (!strokes_.empty())
        strokes_.pop_back();
      break;
    case Kind::response:
      sculptor_.set_response(*response_named(c.word));
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
      sculptor_.release();
    }
  }

  static auto point(const Command& c) {
    return typename Scene::Mesh::Point(c.points[0][0], c.points[0][1], c.points[0][2]);
  }
  auto halfedge(const Command& c) const {
    const auto e = sculptor_.edge_of(c.indices[0], c.indices[1]);
    if (!e.is_valid())
      return typename Scene::Mesh::Halfedge_index();
    const auto h = scene_.mesh.halfedge(e);
    return scene_.mesh.source(h) == sculptor_.vertex(c.indices[0]) ? h : scene_.mesh.opposite(h);
  }

  void drag(const Command& c) {
    const auto v = sculptor_.vertex(c.indices[0]);
    if (!v.is_valid())
      return;
    if (!grab_ || grab_->vertex() != v || !held_)
      grab_.emplace(sculptor_.grab(v));
    held_ = true;
    try {
      grab_->drag_to(point(c));
    } catch (const Invalid_parameter&) { // a clearance that the scene has outgrown: the edit was refused then, too
      held_ = false;
    }
  }

  void clearance(const Command& c) {
    sculptor_.release();
    if (c.word == "default")
      return sculptor_.set_default_clearance();
    try {
      sculptor_.set_clearance(c.length);
    } catch (const Invalid_parameter&) { // refused then, too
    }
  }
  void delta(const Command& c) {
    sculptor_.release();
    if (c.length == sculptor_.options().delta_length)
      return;
    try {
      sculptor_.set_delta(c.length);
    } catch (const Invalid_surface&) {   // refused then, too
    } catch (const Invalid_parameter&) { // a clearance that the scene has outgrown
    }
  }
};

} // namespace haptic_sculpt::loop_program

#endif
