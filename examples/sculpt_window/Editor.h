// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_EDITOR_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_EDITOR_H

#include "Model.h"

#include <optional>

namespace haptic_sculpt::window_program {

/// Edits a model and logs what it has done, so that the log makes it again to the last bit.
///
/// The log is written under the response `stop`: each of its drags is a straight leg that was proven free, under which
/// it is made again whole whatever held the vertex, however much work a drag was allowed, and whatever brush or slide
/// found it.
class Editor {
public:
  using Kind = sculpt_program::Command::Kind;
  using Result = Drag_result<Mesh>;
  using Edited = Edit_result<Mesh>;

  /// Room that is left in the log for what ends strokes.
  static constexpr std::size_t spare = 1024;

  explicit Editor(Model& model) : model_(&model) {}

  /// Whether the log takes so many lines now. Where it does not, the disk is behind, and edits have to wait.
  bool has_room(std::size_t lines) const { return !model_->log || model_->log->has_room(lines + spare); }

  /// What follows, until end_stroke(), is one step of undo.
  void begin_stroke() {
    end_stroke();
    stroke_.emplace(model_->sculptor->stroke());
    log({Kind::stroke});
  }
  void end_stroke() {
    if (!stroke_)
      return;
    stroke_.reset();
    log({Kind::end});
  }
  bool is_in_stroke() const { return stroke_.has_value(); }

  void grab(Vertex_index v) { grab_.emplace(model_->sculptor->grab(v)); }
  void let_go() { grab_.reset(); }
  bool holds() const { return grab_.has_value(); }
  Vertex_index vertex() const { return grab_ ? grab_->vertex() : Vertex_index(); }

  /// \pre holds() and has_room(most legs of a drag)
  Result drag(const Kernel::Point_3& target) {
    const std::size_t name = model_->sculptor->name(grab_->vertex());
    const Result result = grab_->drag_to(target, way_);
    bool moved = false;
    for (std::size_t i = 1; i < way_.size(); ++i)
      if (way_[i] != way_[i - 1])
        log_move(name, way_[i]), moved = true;
    model_->edits += moved;
    return result;
  }

  Edited insert_on_face(Face_index f, const Kernel::Point_3& p) {
    Logged_edit line = with_point({Kind::insert_face, 3, true}, p);
    auto h = model_->mesh.halfedge(f);
    for (std::size_t& index : line.index)
      index = model_->sculptor->name(model_->mesh.source(h)), h = model_->mesh.next(h);
    return noted(model_->sculptor->insert_on_face(f, p), line);
  }
  Edited insert_on_edge(Mesh::Edge_index e, const Kernel::Point_3& p) {
    // From source to target: a Surface_mesh edge knows its direction, and new faces get their indices by it.
    const Logged_edit line = with_point(with_ends({Kind::insert_edge, 2, true}, model_->mesh.halfedge(e)), p);
    return noted(model_->sculptor->insert_on_edge(e, p), line);
  }
  Edited remove(Vertex_index v) {
    Logged_edit line{Kind::remove, 1};
    line.index[0] = model_->sculptor->name(v);
    return noted(model_->sculptor->remove(v), line);
  }
  Edited flip(Mesh::Edge_index e) {
    const Logged_edit line = with_ends({Kind::flip, 2}, model_->mesh.halfedge(e));
    return noted(model_->sculptor->flip(e), line);
  }
  /// Draws the source into the target.
  Edited collapse(Mesh::Halfedge_index h) {
    const Logged_edit line = with_ends({Kind::collapse, 2}, h);
    return noted(model_->sculptor->collapse(h), line);
  }
  Edited undo() { return noted(model_->sculptor->undo(), {Kind::undo}); }
  Edited redo() { return noted(model_->sculptor->redo(), {Kind::redo}); }

  /// Moves many as near to their targets as straight ways lead: a dab, or a part of one.
  template <class Vertices, class Targets>
  Move_report move(const Vertices& vertices, const Targets& targets) {
    moves_.clear();
    model_->sculptor->visitor().moves = &moves_;
    const Move_report report =
        move_vertices(*model_->sculptor, vertices, targets, Move_parameters().steps(false).slide(false));
    model_->sculptor->visitor().moves = nullptr;
    for (const Face_watch::Move& move : moves_)
      log_move(model_->sculptor->name(move.vertex), move.point);
    model_->edits += !moves_.empty();
    return report;
  }

private:
  Model* model_;
  std::optional<Model::Sculptor_type::Stroke_type> stroke_;
  std::optional<Model::Sculptor_type::Grab_type> grab_;
  std::vector<Kernel::Point_3> way_;
  std::vector<Face_watch::Move> moves_;

  static Logged_edit with_point(Logged_edit line, const Kernel::Point_3& p) {
    line.point = {p.x(), p.y(), p.z()};
    return line;
  }
  Logged_edit with_ends(Logged_edit line, Mesh::Halfedge_index h) const {
    line.index = {model_->sculptor->name(model_->mesh.source(h)), model_->sculptor->name(model_->mesh.target(h)), 0};
    return line;
  }
  void log(const Logged_edit& line) {
    if (model_->log)
      model_->log->add(line);
  }
  void log_move(std::size_t name, const Kernel::Point_3& p) {
    Logged_edit line = with_point({Kind::drag, 1, true}, p);
    line.index[0] = name;
    log(line);
  }
  Edited noted(Edited made, const Logged_edit& line) {
    if (made)
      log(line), ++model_->edits;
    return made;
  }
};

} // namespace haptic_sculpt::window_program

#endif
