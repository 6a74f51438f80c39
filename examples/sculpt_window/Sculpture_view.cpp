// SPDX-License-Identifier: GPL-3.0-or-later
#include "Sculpture_view.h"

#include <haptic_sculpt/haptic_rendering/Force_limit.h>

#include <algorithm>

namespace haptic_sculpt::window_program {
namespace {

const drawing::Color clay{0.80f, 0.71f, 0.64f}, background{0.16f, 0.18f, 0.21f};

std::array<drawing::Corner, 3> corners_of(const Seen_face& face, const drawing::Camera& camera) {
  std::array<drawing::Corner, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& n = face.normals[i];
    const float mask = face.masks[i];
    corners[i] = {face.is_there ? Eigen::Vector3f(camera.scaled(vector(face.corners[i])).cast<float>())
                                : Eigen::Vector3f(0, 0, 0),
                  {n[0], n[1], n[2]},
                  (1 - mask) * clay + mask * mark_colors::mask};
  }
  return corners;
}

} // namespace

void Sculpture_view::show(const std::vector<Seen_face>& faces, const Place& middle, int width, int height) {
  drawing::Scene scene;
  for (const Seen_face& face : faces)
    if (face.is_there) {
      const int first = int(scene.points.size());
      for (const Place& corner : face.corners)
        scene.points.push_back(vector(corner));
      scene.triangles.push_back({first, first + 1, first + 2});
    }
  scene.check();
  drawing::View view;
  view.width = std::max(1, width), view.height = std::max(1, height); // a window that is an icon has neither
  drawing::Camera camera(scene, view);
  camera.make_turnable();
  std::vector<drawing::Corner> corners;
  corners.reserve(3 * faces.size());
  double volume = 0; // six times
  for (const Seen_face& face : faces) {
    const auto at = corners_of(face, camera);
    corners.insert(corners.end(), at.begin(), at.end());
    volume += double(at[0].position.dot(at[1].position.cross(at[2].position)));
  }
  if (!view_)
    view_.emplace();
  view_->mesh().set(corners); // the last that may throw
  camera_ = first_camera_ = camera;
  covered_ = 0, middle_ = middle;
  faces_outwards_ = volume > 0;
  changes_.clear();
}

void Sculpture_view::fit() {
  const Eigen::Matrix3d rotation = camera_->rotation();
  const int width = camera_->width(), height = camera_->height();
  camera_ = first_camera_;
  camera_->resize(width, height);
  camera_->look(-rotation.row(2), rotation.row(1));
  covered_ = 0;
}

void Sculpture_view::frame(double covered) {
  const double width = camera_->width(), height = camera_->height();
  const auto side = [&](double taken) { return std::fmin(width - taken, height); };
  camera_->magnify(side(covered) / side(covered_), {(width + covered_) / 2, height / 2});
  camera_->shift({(covered - covered_) / 2, 0});
  covered_ = covered;
}

/// \return why not all is there: what there is no room for; none: it is
std::exception_ptr Sculpture_view::upload() {
  std::exception_ptr failure;
  if (changes_.empty())
    return failure;
  // Of several changes of a face the last one counts; faces with successive indices are written at once.
  std::stable_sort(changes_.begin(), changes_.end(),
                   [](const Seen_face& a, const Seen_face& b) { return a.index < b.index; });
  drawing::Triangle_buffer& mesh = view_->mesh();
  if (const std::size_t needed = std::size_t(changes_.back().index) + 1; needed > mesh.size()) {
    const std::size_t room = needed + needed / 8 + 1024;
    const std::size_t before = mesh.size();
    try {
      mesh.resize(room);
    } catch (const std::exception&) {
      failure = std::current_exception();
      changes_.erase(std::remove_if(changes_.begin(), changes_.end(),
                                    [&](const Seen_face& change) { return change.index >= before; }),
                     changes_.end());
    }
    uploaded_ += 3 * (mesh.size() - before) * sizeof(drawing::Corner);
  }
  std::vector<drawing::Corner> run;
  std::uint32_t first = 0;
  const auto write = [&] {
    if (!run.empty())
      mesh.write(first, run.data(), run.size() / 3);
    uploaded_ += run.size() * sizeof(drawing::Corner);
    uploaded_faces_ += run.size() / 3;
    run.clear();
  };
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    if (i + 1 < changes_.size() && changes_[i + 1].index == changes_[i].index)
      continue;
    if (run.empty() || changes_[i].index != first + run.size() / 3) {
      write();
      first = changes_[i].index;
    }
    const auto corners = corners_of(changes_[i], *camera_);
    run.insert(run.end(), corners.begin(), corners.end());
  }
  write();
  changes_.clear();
  return failure;
}

void Sculpture_view::draw(const Status& status, const Hand_marks& marks) {
  const std::exception_ptr failure = upload();
  view_->set_marks(marks_of(status, marks), *camera_);
  drawing::Smooth_look look;
  look.shows_edges = shows_edges_, look.faces_outwards = faces_outwards_;
  look.brush_color = mark_colors::brush;
  if (marks.shows_brush)
    for (const auto& spot : brush_spots(status.pointed, marks.brush))
      look.brushes.push_back(camera_->scaled(spot[0]).cast<float>());
  look.brush_radius = float(marks.brush.radius / camera_->unscaled(1.0));
  view_->draw_smooth(*camera_, background, look);
  if (failure)
    std::rethrow_exception(failure);
}

/// Where a brush is, on all sides where it is symmetric, and the normals there.
std::vector<std::array<Eigen::Vector3d, 2>> Sculpture_view::brush_spots(const Pointed& pointed,
                                                                        const Brush& brush) const {
  if (vector(pointed.normal).isZero(0))
    return {};
  std::vector<std::array<Eigen::Vector3d, 2>> spots;
  spots.push_back({vector(pointed.at), vector(pointed.normal)});
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = brush.symmetry[std::size_t(axis)] ? spots.size() : 0; i > 0; --i) {
      auto spot = spots[i - 1];
      spot[0][axis] = 2 * middle_[std::size_t(axis)] - spot[0][axis];
      spot[1][axis] = -spot[1][axis];
      spots.push_back(spot);
    }
  return spots;
}

drawing::Scene Sculpture_view::marks_of(const Status& status, const Hand_marks& marks) const {
  using Hold = Status::Hold;
  drawing::Scene scene;
  if (status.pointed.size > 0 && !marks.shows_brush)
    scene.balls.push_back({vector(status.pointed.at),
                           status.pointed.size == 1 ? drawing::colors::orange : drawing::colors::blue,
                           status.pointed.size == 1 ? 6. : 3.5});
  const Eigen::Vector3d target = vector(status.target), proxy = vector(status.proxy), force = vector(status.force);
  if (status.hold == Hold::vertex || status.hold == Hold::probe) {
    if (!status.reached) {
      scene.segments.push_back({proxy, target, drawing::colors::red, 1.6, true});
      scene.balls.push_back({target, drawing::colors::red, 4.5});
    }
    const bool touches = status.contacts > 0;
    scene.balls.push_back({proxy, touches ? mark_colors::contact : drawing::colors::orange, 7});
    for (int i = 0; i < status.contacts; ++i) {
      const Contact_view& contact = status.contact[std::size_t(i)];
      for (int j = 0; j < contact.still; ++j) {
        const Eigen::Vector3d a = vector(contact.points[std::size_t(j)]),
                              b = vector(contact.points[std::size_t((j + 1) % contact.still)]);
        if (contact.still == 1)
          scene.balls.push_back({a, mark_colors::contact, 5});
        else if (contact.still == 3 || j == 0)
          scene.segments.push_back({a, b, mark_colors::contact, 1.6});
      }
      if (!vector(contact.normal).isZero(0))
        scene.arrows.push_back({proxy, vector(contact.normal), drawing::colors::purple, 50});
    }
    if (!force.isZero(0))
      scene.arrows.push_back(
          {proxy, force, mark_colors::force, std::min(150.0, 70 + 80 * force.norm() / Force_limits().largest)});
  }
  if (marks.shows_brush) // by its length, how strong it is
    for (const auto& [at, normal] : brush_spots(status.pointed, marks.brush))
      scene.segments.push_back(
          {at, at + marks.brush.radius * marks.brush.strength * normal.stableNormalized(), mark_colors::brush, 1.2});
  return scene;
}

Pointer Sculpture_view::pointer_at(const Eigen::Vector2d& pixel) const {
  Pointer pointer;
  const Eigen::Vector3d eye = camera_->eye(), way = camera_->ray(pixel);
  pointer.from = place(camera_->unscaled(eye));
  pointer.to = place(camera_->unscaled(Eigen::Vector3d(eye + 3 * eye.norm() * way + 6 * way)));
  pointer.view = place(-camera_->rotation().row(2).transpose());
  return pointer;
}

} // namespace haptic_sculpt::window_program
