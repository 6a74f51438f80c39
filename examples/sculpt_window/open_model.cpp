// SPDX-License-Identifier: GPL-3.0-or-later
#include "Model.h"

#include "../sculpt/many_vertices_lines.h"
#include "../sculpt/sha256_of_file.h"

#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

namespace haptic_sculpt::window_program {
namespace {

using sculpt_program::Command;
using Kind = Command::Kind;

/// Makes again what a log has, by the same calls as `sculpt`.
class Replay {
public:
  explicit Replay(Model& model) : model_(&model), sculptor_(&*model.sculptor) {}

  void make(const Command& command) {
    if (command.kind != Kind::drag)
      held_ = false;
    const auto vertex = [&](std::size_t i) { return sculptor_->vertex(command.indices[i]); };
    const auto point = [&] {
      return Kernel::Point_3(command.points[0][0], command.points[0][1], command.points[0][2]);
    };
    switch (command.kind) {
    case Kind::drag:
      drag(vertex(0), point());
      break;
    case Kind::release:
      sculptor_->release();
      break;
    case Kind::insert_face:
      sculptor_->insert_on_face(sculptor_->face_of(command.indices[0], command.indices[1], command.indices[2]),
                                point());
      break;
    case Kind::insert_edge:
      sculptor_->insert_on_edge(sculptor_->edge_of(command.indices[0], command.indices[1]), point());
      break;
    case Kind::remove:
      sculptor_->remove(vertex(0));
      break;
    case Kind::flip:
      sculptor_->flip(sculptor_->edge_of(command.indices[0], command.indices[1]));
      break;
    case Kind::collapse:
      collapse(command);
      break;
    case Kind::undo:
      sculptor_->undo();
      break;
    case Kind::redo:
      sculptor_->redo();
      break;
    case Kind::stroke:
      strokes_.push_back(sculptor_->stroke());
      break;
    case Kind::end:
      if (!strokes_.empty())
        strokes_.pop_back();
      break;
    case Kind::response:
      sculptor_->set_response(*response_named(command.word));
      break;
    case Kind::clearance:
      clearance(command);
      break;
    case Kind::delta:
      sculptor_->set_delta(command.length);
      break;
    case Kind::brush:
      sculpt_program::carry_out_brush(*sculptor_, command);
      break;
    case Kind::remesh:
      sculpt_program::carry_out_remesh(*sculptor_, command);
      break;
    case Kind::probe:
    case Kind::mesh:
      break;
    }
  }

private:
  Model* model_;
  Model::Sculptor_type* sculptor_;
  std::optional<Model::Sculptor_type::Grab_type> grab_;
  bool held_ = false;
  std::vector<Model::Sculptor_type::Stroke_type> strokes_;

  void drag(Vertex_index v, const Kernel::Point_3& target) {
    if (!v.is_valid())
      return;
    if (!grab_ || grab_->vertex() != v || !held_)
      grab_.emplace(sculptor_->grab(v));
    held_ = true;
    grab_->drag_to(target);
  }
  void collapse(const Command& command) {
    const auto e = sculptor_->edge_of(command.indices[0], command.indices[1]);
    if (!e.is_valid())
      return;
    auto h = model_->mesh.halfedge(e);
    if (model_->mesh.source(h) != sculptor_->vertex(command.indices[0]))
      h = model_->mesh.opposite(h);
    sculptor_->collapse(h);
  }
  void clearance(const Command& command) {
    if (command.word == "default")
      sculptor_->set_default_clearance();
    else
      sculptor_->set_clearance(command.length);
  }
};

} // namespace

std::unique_ptr<Model> open_model(const std::string& path, const std::string& log) {
  auto model = std::make_unique<Model>();
  model->path = path;
  if (!log.empty())
    model->log = std::make_unique<Log_thread>(log, sculpt_program::sha256_of_file(path));
  model->mesh = read_surface<Mesh>(path);
  model->lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), model->upper = -model->lower;
  for (const Vertex_index v : model->mesh.vertices()) {
    const Eigen::Vector3d p = internal::vector_of(model->mesh.point(v));
    model->lower = model->lower.cwiseMin(p), model->upper = model->upper.cwiseMax(p);
  }
  model->sculptor = std::make_unique<Model::Sculptor_type>(model->mesh, parameters::known_valid(true),
                                                           Face_watch(model->mesh, model->dirty));
  if (model->log && model->log->contents()) {
    Replay replay(*model);
    for (const Command& command : model->log->contents()->commands)
      replay.make(command), ++model->resumed;
  }
  while (model->dirty.size() > 0) // the window is shown all there is
    model->dirty.pop();
  if (model->log)
    model->log->begin();
  model->sculptor->set_response(Response::slide);
  return model;
}

std::string write_copy(const Scene_copy& copy, const std::string& path) {
  if (!copy.is_whole())
    throw Error("the copy of the mesh, which was to be saved as '" + path + "', has no room for all of it; save again");
  return write_surface(path, copy.mesh<Mesh>());
}

} // namespace haptic_sculpt::window_program
