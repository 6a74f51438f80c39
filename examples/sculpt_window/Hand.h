// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_HAND_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_HAND_H

#include "Brush_hand.h"

#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Virtual_coupling.h>

namespace haptic_sculpt::window_program {

/// The mouse as a device of pose and force: where it points is the pose of a handle, and there is a force on it that
/// one sees.
///
/// A vertex or probe that is held is drawn to its target by drags, one a tick at most, and the force is that of a
/// spring between the two, as in haptic_rendering; the scene's diagonal is 0.1 m for it.
class Hand {
public:
  /// Pairs that a drag may decide in a tick; the next tick goes on.
  static constexpr std::size_t work = 400;

  explicit Hand(Model& model)
      : model_(&model)
      , editor_(model)
      , brush_(model, editor_)
      , map_(std::fmax(model.extent(), 1e-300) / diagonal, Eigen::Vector3d::Zero(), 0.5 * (model.lower + model.upper),
             Eigen::Vector3d::Zero()) {
    model.sculptor->set_work_limit(work);
  }

  /// Does what the window asks. \return for people: why it was refused; empty: it was not
  std::string press(const Request& request) {
    let_go();
    pointer_ = request.pointer;
    const auto hit = pointed();
    if (request.tool == Tool::probe)
      return press_probe(request, hit);
    if (!hit)
      return "there is nothing to take hold of: point at the surface";
    if (!editor_.has_room(64))
      return "the disk is behind with the log; wait a moment";
    if (request.tool == Tool::brush) {
      editor_.begin_stroke();
      brush_.begin(request.brush, internal::vector_of(hit->point));
      hold_ = Status::Hold::brush;
      return {};
    }
    if (request.tool == Tool::remove)
      return refusal(editor_.remove(nearest_corner(*hit)), "the vertex cannot be removed: ");
    Vertex_index v = nearest_corner(*hit);
    if (request.tool == Tool::create) {
      if (hit->feature == Surface_feature::vertex)
        return "a vertex stands here already";
      editor_.begin_stroke();
      const auto made = create(*hit);
      if (!made) {
        editor_.end_stroke();
        return refusal(made, "no vertex can be created here: ");
      }
      v = *made.vertex;
    } else {
      editor_.begin_stroke();
    }
    take(v);
    return {};
  }

  void point(const Request& request) {
    pointer_ = request.pointer;
    depth_ = request.depth;
    is_pointed_at_known_ = false;
    if (hold_ == Status::Hold::probe)
      if (const auto hit = pointed())
        aim_ = internal::vector_of(hit->point);
  }

  void let_go() {
    brush_.end();
    editor_.let_go();
    editor_.end_stroke();
    hold_ = Status::Hold::nothing;
    result_ = {};
    force_.setZero();
    is_pointed_at_known_ = false; // what was pointed at may be another face now
  }

  std::string flip(const Request& request) {
    return edit_pointed_edge(request, "the edge cannot be flipped: ", [this](Mesh::Halfedge_index h) {
      return editor_.flip(model_->mesh.edge(h));
    });
  }
  std::string collapse(const Request& request) {
    return edit_pointed_edge(
        request, "the edge cannot be collapsed: ", [this](Mesh::Halfedge_index h) { return editor_.collapse(h); });
  }
  std::string undo() {
    let_go();
    return refusal(editor_.undo(), "nothing is undone: ");
  }
  std::string redo() {
    let_go();
    return refusal(editor_.redo(), "nothing is redone: ");
  }

  /// A tick: draws what is held nearer to its target.
  void move() {
    if (hold_ == Status::Hold::vertex)
      drag_vertex();
    else if (hold_ == Status::Hold::probe)
      drag_probe();
    else if (hold_ == Status::Hold::brush)
      brush();
    force_ = hold_ == Status::Hold::vertex || hold_ == Status::Hold::probe
                 ? clamped(coupling_.force(map_, proxy_, target_, result_.reached), Force_limits().largest)
                 : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }

  void tell(Status& status);

private:
  static constexpr double diagonal = 0.1; ///< m

  Model* model_;
  Editor editor_;
  Brush_hand brush_;
  Workspace_map map_;
  Virtual_coupling coupling_;
  Status::Hold hold_ = Status::Hold::nothing;
  Pointer pointer_;
  double depth_ = 0;
  Eigen::Vector3d home_, normal_, offset_; ///< of the vertex when it was taken; from where the mouse pointed to it
  double along_ = 0;                       ///< where the mouse pointed on the line along the normal
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero(), proxy_ = Eigen::Vector3d::Zero(), force_ = Eigen::Vector3d::Zero(),
                  aim_ = Eigen::Vector3d::Zero();
  Drag_result<Mesh> result_;
  std::optional<Surface_hit<Mesh>> pointed_at_;
  bool is_pointed_at_known_ = false;

  std::optional<Surface_hit<Mesh>> pointed() {
    if (pointer_.from == pointer_.to)
      return std::nullopt;
    return model_->sculptor->first_hit(point(pointer_.from), point(pointer_.to));
  }

  void brush() {
    if (brush_.is_under_way())
      brush_.go_on();
    else if (!brush_.is_due())
      return;
    else if (brush_.follows_the_hand())
      brush_.pull_to(on_plane(brush_.centre()));
    else if (const auto hit = pointed())
      brush_.dab(internal::vector_of(hit->point));
  }
  static Kernel::Point_3 point(const Place& p) { return {p[0], p[1], p[2]}; }

  Vertex_index nearest_corner(const Surface_hit<Mesh>& hit) const {
    if (hit.feature == Surface_feature::vertex)
      return hit.vertex;
    Vertex_index best;
    for (const Vertex_index v : model_->mesh.vertices_around_face(model_->mesh.halfedge(hit.face)))
      if (!best.is_valid() || CGAL::squared_distance(model_->mesh.point(v), hit.point) <
                                  CGAL::squared_distance(model_->mesh.point(best), hit.point))
        best = v;
    return best;
  }

  /// Of the face that is met: the edge that is nearest, and how near, in parts of the face's altitude on it.
  std::pair<Mesh::Halfedge_index, double> nearest_edge(const Surface_hit<Mesh>& hit) const {
    const Mesh& mesh = model_->mesh;
    auto h = mesh.halfedge(hit.face);
    std::pair<Mesh::Halfedge_index, double> nearest{h, std::numeric_limits<double>::infinity()};
    const Eigen::Vector3d p = internal::vector_of(hit.point);
    for (int i = 0; i < 3; ++i, h = mesh.next(h)) {
      const Eigen::Vector3d a = internal::vector_of(mesh.point(mesh.source(h))),
                            b = internal::vector_of(mesh.point(mesh.target(h))),
                            c = internal::vector_of(mesh.point(mesh.target(mesh.next(h))));
      const double height = (b - a).cross(p - a).norm() / (b - a).cross(c - a).norm();
      if (height < nearest.second)
        nearest = {h, height};
    }
    return nearest;
  }
  /// From the end that is nearer to where the mouse points. \return the null index where it points at none
  Mesh::Halfedge_index pointed_edge() {
    const auto hit = pointed();
    if (!hit || hit->feature == Surface_feature::vertex)
      return {};
    const Mesh& mesh = model_->mesh;
    const auto h = hit->feature == Surface_feature::edge ? mesh.halfedge(hit->edge) : nearest_edge(*hit).first;
    return CGAL::squared_distance(mesh.point(mesh.target(h)), hit->point) <
                   CGAL::squared_distance(mesh.point(mesh.source(h)), hit->point)
               ? mesh.opposite(h)
               : h;
  }
  /// Makes an edit of it. \return why it was refused; empty: it was not
  template <class Edit>
  std::string edit_pointed_edge(const Request& request, const char* refused, const Edit& edit) {
    let_go();
    pointer_ = request.pointer;
    const auto h = pointed_edge();
    if (!h.is_valid())
      return "there is no edge here: point at one, on the surface";
    if (!editor_.has_room(64))
      return "the disk is behind with the log; wait a moment";
    return refusal(edit(h), refused);
  }

  /// Nearer to an edge than a twentieth of the face's altitude: on the edge; else it would leave a sliver.
  Editor::Edited create(const Surface_hit<Mesh>& hit) {
    if (hit.feature == Surface_feature::edge)
      return editor_.insert_on_edge(hit.edge, hit.point);
    const auto [h, height] = nearest_edge(hit);
    if (height < 0.05)
      return editor_.insert_on_edge(model_->mesh.edge(h), hit.point);
    return editor_.insert_on_face(hit.face, hit.point);
  }

  void take(Vertex_index v) {
    home_ = internal::vector_of(model_->mesh.point(v));
    normal_ = internal::vertex_normal(model_->mesh, v);
    proxy_ = home_;
    offset_ = home_ - on_plane(home_);
    along_ = nearest_on_normal();
    target_ = wanted(); // up to rounding where it is: a click moves nothing
    result_ = {};
    result_.reached = true;
    editor_.grab(v);
    hold_ = Status::Hold::vertex;
  }

  /// Where the mouse's line meets the plane through p across the view.
  Eigen::Vector3d on_plane(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d from = vector(pointer_.from), way = vector(pointer_.to) - from,
                          across = vector(pointer_.view);
    const double slope = way.dot(across);
    return slope > 0 ? Eigen::Vector3d(from + (p - from).dot(across) / slope * way) : p;
  }

  /// The parameter on the line from home_ along normal_ that is nearest to the mouse's line.
  double nearest_on_normal() const {
    const Eigen::Vector3d from = vector(pointer_.from), way = (vector(pointer_.to) - from).normalized();
    const Eigen::Vector3d apart = home_ - from;
    const double cosine = normal_.dot(way), sine = 1 - cosine * cosine;
    const double least_sine = 0.01; // looked at along the normal nearly: a pixel would be too far a way
    return sine > least_sine ? (cosine * apart.dot(way) - apart.dot(normal_)) / sine : along_;
  }

  /// Where the mouse wants the vertex.
  Eigen::Vector3d wanted() const {
    return pointer_.along_normal ? Eigen::Vector3d(home_ + (nearest_on_normal() - along_) * normal_)
                                 : Eigen::Vector3d(on_plane(home_) + offset_);
  }

  void drag_vertex() {
    if (!editor_.vertex().is_valid()) {
      let_go();
      return;
    }
    const Eigen::Vector3d target = wanted();
    const bool goes_on = result_.end == Drag_end::work_limit || result_.end == Drag_end::leg_limit;
    if ((target == target_ && !goes_on) || !editor_.has_room(2048))
      return;
    target_ = target;
    result_ = editor_.drag(internal::point_of<Kernel::Point_3>(target));
    proxy_ = internal::vector_of(result_.position);
  }

  std::string press_probe(const Request& request, const std::optional<Surface_hit<Mesh>>& hit) {
    if (!hit)
      return "there is nothing to touch: point at the surface";
    depth_ = request.depth;
    aim_ = internal::vector_of(hit->point);
    const Eigen::Vector3d back = (vector(pointer_.from) - aim_).normalized();
    proxy_ = target_ = aim_ + std::fmin(0.1 * model_->extent(), 0.5 * (vector(pointer_.from) - aim_).norm()) * back;
    result_ = {};
    result_.reached = true;
    hold_ = Status::Hold::probe;
    return {};
  }

  void drag_probe() {
    const Eigen::Vector3d target = aim_ + depth_ * vector(pointer_.view);
    const bool goes_on = result_.end == Drag_end::work_limit || result_.end == Drag_end::leg_limit;
    if (target == target_ && !goes_on)
      return;
    target_ = target;
    auto result = model_->sculptor->probe(internal::point_of<Kernel::Point_3>(proxy_),
                                          internal::point_of<Kernel::Point_3>(target));
    if (result.end == Drag_end::refused) // what it touched has come nearer: let it begin anew in front of the surface
      proxy_ = aim_ - 0.1 * model_->extent() * vector(pointer_.view), target_ = proxy_;
    else
      proxy_ = internal::vector_of(result.position);
    result_ = std::move(result);
  }

  std::string refusal(const Editor::Edited& made, const std::string& text) const {
    if (made)
      return {};
    std::string said = text + name_of(made.refusal->reason);
    for (const Vertex_index v : made.refusal->elements)
      said += ' ' + std::to_string(model_->sculptor->name(v));
    return said;
  }
};

/// What there is to see of it.
inline void Hand::tell(Status& status) {
  const Model::Sculptor_type& sculptor = *model_->sculptor;
  status.hold = hold_;
  status.vertex = hold_ == Status::Hold::vertex && editor_.vertex().is_valid() ? sculptor.name(editor_.vertex()) : 0;
  status.target = place(target_), status.proxy = place(proxy_), status.force = place(force_);
  const bool pulls = hold_ == Status::Hold::vertex || hold_ == Status::Hold::probe;
  status.reached = !pulls || result_.reached;
  status.end = pulls ? name_of(result_.end) : "";
  status.contacts = 0;
  for (const auto& contact : result_.contacts) {
    if (!pulls || status.contacts == Status::most_contacts || contact.kind == Contact_kind::delta)
      break;
    Contact_view& view = status.contact[static_cast<std::size_t>(status.contacts++)];
    view.kind = name_of(contact.kind);
    // Of the three vertices those that are the feature which is met: all, the edge's two, or the one.
    const int first = contact.kind == Contact_kind::vertex_face ? 0 : contact.kind == Contact_kind::edge_edge ? 1 : 2;
    view.still = 3 - first;
    for (int i = 0; i < view.still; ++i) {
      const Vertex_index v = contact.vertices[static_cast<std::size_t>(first + i)];
      view.points[static_cast<std::size_t>(i)] = place(internal::vector_of(model_->mesh.point(v)));
      view.names[static_cast<std::size_t>(i)] = sculptor.name(v);
    }
    view.normal = {contact.normal.x(), contact.normal.y(), contact.normal.z()};
  }
  if (!is_pointed_at_known_ && hold_ == Status::Hold::nothing)
    pointed_at_ = pointed(), is_pointed_at_known_ = true;
  const bool points = pointed_at_ && hold_ == Status::Hold::nothing;
  status.pointed = points ? name_of(pointed_at_->feature) : "";
  status.pointed_size = 0;
  if (points) {
    status.pointed_at = place(internal::vector_of(pointed_at_->point));
    const auto add = [&](Vertex_index v) {
      status.pointed_names[static_cast<std::size_t>(status.pointed_size++)] = sculptor.name(v);
    };
    if (pointed_at_->feature == Surface_feature::vertex)
      add(pointed_at_->vertex);
    else if (pointed_at_->feature == Surface_feature::edge)
      add(model_->mesh.vertex(pointed_at_->edge, 0)), add(model_->mesh.vertex(pointed_at_->edge, 1));
    else
      for (const Vertex_index v : model_->mesh.vertices_around_face(model_->mesh.halfedge(pointed_at_->face)))
        add(v);
  }
  if (hold_ == Status::Hold::brush)
    status.pointed_at = place(brush_.centre());
  status.undo_steps = sculptor.history().number_of_undo_steps();
  status.redo_steps = sculptor.history().number_of_redo_steps();
  status.vertices = model_->mesh.number_of_vertices();
  status.faces = model_->mesh.number_of_faces();
  status.vertex_slots = model_->mesh.num_vertices(), status.face_slots = model_->mesh.num_faces();
  status.edits = model_->edits;
  status.dirty_faces = model_->dirty.size();
  status.brush_left = brush_.left();
}

} // namespace haptic_sculpt::window_program

#endif
