// SPDX-License-Identifier: GPL-3.0-or-later
#include "Sculpture_view.h"

#include <haptic_sculpt/haptic_rendering/Force_limit.h>

#include <algorithm>

namespace haptic_sculpt::window_program {
namespace {

std::array<drawing::Corner, 3> corners_of(const Face_change& face, const drawing::Camera& camera) {
  if (!face.is_there) {
    const drawing::Corner none{{0, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    return {none, none, none};
  }
  return drawing::corners_of(camera, {vector(face.corners[0]), vector(face.corners[1]), vector(face.corners[2])},
                             drawing::colors::surface);
}

} // namespace

void Sculpture_view::show(const std::vector<Face_change>& faces, int width, int height) {
  drawing::Scene scene;
  for (const Face_change& face : faces)
    if (face.is_there) {
      const int first = int(scene.points.size());
      for (const Place& corner : face.corners)
        scene.points.push_back(vector(corner));
      scene.triangles.push_back({first, first + 1, first + 2});
    }
  scene.check();
  drawing::View view;
  view.width = width, view.height = height;
  camera_.emplace(scene, view);
  camera_->make_turnable();
  first_camera_ = camera_;
  std::vector<drawing::Corner> corners;
  corners.reserve(3 * faces.size());
  double volume = 0; // six times
  for (const Face_change& face : faces) {
    const auto at = corners_of(face, *camera_);
    corners.insert(corners.end(), at.begin(), at.end());
    volume += double(at[0].position.dot(at[1].position.cross(at[2].position)));
  }
  faces_outwards_ = volume > 0;
  if (!view_)
    view_.emplace();
  view_->mesh().set(corners);
  changes_.clear();
  uploaded_ = uploaded_faces_ = 0;
}

void Sculpture_view::fit() {
  const Eigen::Matrix3d rotation = camera_->rotation();
  const int width = camera_->width(), height = camera_->height();
  camera_ = first_camera_;
  camera_->resize(width, height);
  camera_->look(-rotation.row(2), rotation.row(1));
}

void Sculpture_view::upload() {
  if (changes_.empty())
    return;
  // Of several changes of a face the last one counts; faces with successive indices are written at once.
  std::stable_sort(changes_.begin(), changes_.end(),
                   [](const Face_change& a, const Face_change& b) { return a.index < b.index; });
  drawing::Triangle_buffer& mesh = view_->mesh();
  if (const std::size_t needed = std::size_t(changes_.back().index) + 1; needed > mesh.size()) {
    const std::size_t room = needed + needed / 8 + 1024;
    uploaded_ += 3 * (room - mesh.size()) * sizeof(drawing::Corner);
    mesh.resize(room);
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
}

void Sculpture_view::draw(const Status& status, const Hand_marks& marks) {
  upload();
  view_->set_marks(marks_of(status, marks), *camera_);
  view_->draw(*camera_, drawing::colors::white,
              faces_outwards_ ? drawing::Mesh_view::Faces::outside : drawing::Mesh_view::Faces::all);
}

drawing::Scene Sculpture_view::marks_of(const Status& status, const Hand_marks& marks) const {
  using Hold = Status::Hold;
  drawing::Scene scene;
  if (status.pointed.size > 0)
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
  if (marks.shows_brush && (status.pointed.size > 0 || status.hold == Hold::brush)) {
    // A circle across the view about where the mouse points, of the brush's size.
    const Eigen::Vector3d centre = vector(status.pointed.at);
    const Eigen::Matrix3d axes = camera_->rotation();
    const int sides = 40;
    const auto at = [&](int i) -> Eigen::Vector3d {
      const double angle = 2 * EIGEN_PI * i / sides;
      return centre + marks.brush_radius * (std::cos(angle) * axes.row(0) + std::sin(angle) * axes.row(1)).transpose();
    };
    for (int i = 0; i < sides; ++i)
      scene.segments.push_back({at(i), at(i + 1), mark_colors::brush, 1.2});
  }
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
