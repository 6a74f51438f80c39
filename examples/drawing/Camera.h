// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace haptic_sculpt::drawing {

/// How a scene is looked at.
struct View {
  Eigen::Vector3d direction{-1, 2, -0.9}; ///< from the eye into the scene; its length does not count
  Eigen::Vector3d up{0, 0, 1};            ///< upwards in the picture; another axis is taken if parallel to `direction`
  int width = 1200, height = 900;         ///< in pixels, legend included
  std::optional<Eigen::Vector3d> focus;   ///< in the middle of the picture; nothing: the whole mesh is
  double magnification = 1;               ///< 1: the whole mesh is in the picture, if no focus is given
  Color background = colors::white;
};

/// A perspective camera that sees the whole mesh in the middle of the picture.
///
/// The graphics card computes in single precision, so it gets *scaled* coordinates: the box's centre is at 0 and its
/// longest half-edge is 1. Scaling is done in double precision after an exact shift of the exponent, so that boxes from
/// the smallest to the largest doubles, or far from the origin, look alike.
class Camera {
public:
  /// Fits the mesh, and those marks that lie within twice the mesh's size: the way to the target of a long drag is cut
  /// off at the picture's margin rather than shrinking the mesh to a dot. O(points + marks). \pre `scene.check()` has
  /// passed. \throw Picture_error for a view without direction or with an impossible size.
  Camera(const Scene& scene, const View& view)
      : width_(view.width), height_(view.height - scene.legend_height(view.width)) {
    if (!view.direction.allFinite() || view.direction.isZero(0) || !view.up.allFinite())
      throw Picture_error("The view has no direction. Give a finite vector that is not zero.");
    if (width_ < 1 || height_ < 1)
      throw Picture_error("A picture of " + std::to_string(width_) + " x " + std::to_string(height_) +
                          " pixels cannot be drawn. Give a positive width and height.");
    frame_box(scene);
    look_along(unit(view.direction), unit(view.up));
    fit(scene);
    if (view.focus)
      aim_at(scaled(*view.focus));
    zoom_ = std::clamp(view.magnification, least_magnification, most_magnification);
  }

  static constexpr double least_magnification = 0.25, most_magnification = 1e5;

  /// The scaled coordinates of a point; components beyond `farthest` are cut off there.
  Eigen::Vector3d scaled(const Eigen::Vector3d& p) const {
    const double farthest = 1e100; // beyond any picture, and its square is still finite
    return ((shifted(p) - center_) / half_edge_).unaryExpr([=](double x) {
      return std::clamp(x, -farthest, farthest);
    });
  }

  /// Rows: rightwards, upwards, towards the eye.
  const Eigen::Matrix3d& rotation() const { return rotation_; }

  /// From scaled coordinates to OpenGL's clip coordinates.
  Eigen::Matrix4d projection() const {
    const double near = near_plane(), far = distance_ + 8; // marks reach 4 from the centre at most
    Eigen::Matrix4d eye = Eigen::Matrix4d::Identity(), clip = Eigen::Matrix4d::Zero();
    eye.topLeftCorner<3, 3>() = rotation_;
    eye.topRightCorner<3, 1>() << -aim_.x(), -aim_.y(), -distance_;
    clip(0, 0) = 1 / tangent_x();
    clip(1, 1) = 1 / tangent_y();
    clip(2, 2) = (far + near) / (near - far);
    clip(2, 3) = 2 * far * near / (near - far);
    clip(3, 2) = -1;
    return clip * eye;
  }

  /// As far from the eye as what is to be seen allows: the finer are the depths that the graphics card tells apart.
  double near_plane() const { return std::max(0.05 * distance_, 0.9 * (distance_ - nearest_)); }

  /// The user's coordinates of a scaled point: the inverse of `scaled()`, rounded.
  Eigen::Vector3d unscaled(const Eigen::Vector3d& q) const {
    return (center_ + half_edge_ * q).unaryExpr([this](double x) { return std::ldexp(x, exponent_); });
  }
  /// A length in scaled coordinates, in the user's unit.
  double unscaled(double length) const { return std::ldexp(half_edge_ * length, exponent_); }

  /// \name A camera in someone's hand
  /// The eye stays where the whole mesh is before it; to zoom is to narrow its angle. Depths keep their precision so,
  /// and no part of the mesh gets behind the eye.
  ///@{

  /// From here on the view may be turned: the near plane then leaves room for the mesh from any side, and for its
  /// growing.
  void make_turnable() { nearest_ = std::min(2.0, 0.6 * distance_); }

  /// Turns the mesh under the eye by angles, in radians, about the picture's upward and rightward axes; `pivot`
  /// (scaled) stays where it is seen.
  void turn(double about_up, double about_right, const Eigen::Vector3d& pivot) {
    const Eigen::Vector2d before = (rotation_ * pivot).head<2>();
    rotation_ = Eigen::AngleAxisd(about_right, Eigen::Vector3d::UnitX()) *
                Eigen::AngleAxisd(about_up, Eigen::Vector3d::UnitY()) * rotation_;
    rotation_ = Eigen::Quaterniond(rotation_).normalized().toRotationMatrix(); // roundings would add up
    aim_ += (rotation_ * pivot).head<2>() - before;
  }
  /// Looks along a direction, as View says, at the same zoom.
  void look(const Eigen::Vector3d& direction, const Eigen::Vector3d& up) { look_along(unit(direction), unit(up)); }
  /// Magnifies by a factor; what is seen at `pixel` stays there.
  void magnify(double factor, const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d before = in_plane(pixel);
    zoom_ = std::clamp(zoom_ * factor, least_magnification, most_magnification);
    aim_ += before - in_plane(pixel);
  }
  /// Shifts the picture by pixels, downwards positive.
  void shift(const Eigen::Vector2d& pixels) { aim_ -= pixel_width() * Eigen::Vector2d(pixels.x(), -pixels.y()); }
  /// Puts a scaled point into the middle of the picture.
  void aim_at(const Eigen::Vector3d& q) { aim_ = (rotation_ * q).head<2>(); }
  void resize(int width, int height) { width_ = std::max(1, width), height_ = std::max(1, height); }

  /// Where the eye is, scaled.
  Eigen::Vector3d eye() const { return rotation_.transpose() * Eigen::Vector3d(aim_.x(), aim_.y(), distance_); }
  /// From the eye through a pixel, scaled, of length 1.
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const {
    return rotation_.transpose() *
           Eigen::Vector3d((2 * pixel.x() / width_ - 1) * tangent_x(), (1 - 2 * pixel.y() / height_) * tangent_y(), -1)
               .normalized();
  }
  double magnification() const { return zoom_; }
  ///@}

  /// Where a point is seen, in pixels from the picture's upper left corner; not a number behind the eye.
  Eigen::Vector2d pixel(const Eigen::Vector3d& p) const {
    const Eigen::Vector4d clip = projection() * scaled(p).homogeneous();
    if (!(clip.w() > 0))
      return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    return {(clip.x() / clip.w() + 1) / 2 * width_, (1 - clip.y() / clip.w()) / 2 * height_};
  }

  /// The width of a pixel at the box's centre, in scaled coordinates.
  double pixel_width() const { return 2 * distance_ * tangent_y() / height_; }

  int width() const { return width_; }
  int height() const { return height_; }

private:
  int width_, height_, exponent_ = 0;
  double zoom_ = 1;
  Eigen::Vector3d center_;
  double half_edge_ = 1, distance_ = 0;
  double nearest_ = 0; // how far towards the eye what is to be seen reaches from the box's centre
  Eigen::Matrix3d rotation_;
  Eigen::Vector2d aim_; // where the camera's axis passes the box's centre: rightwards, upwards

  // Half the opening angle is 12 degrees along the shorter side: little distortion, yet near parts look near.
  double tangent_x() const { return 0.2126 / zoom_ * std::max(1., double(width_) / height_); }
  double tangent_y() const { return 0.2126 / zoom_ * std::max(1., double(height_) / width_); }

  /// Rightwards and upwards, where a pixel is in the plane through the box's centre.
  Eigen::Vector2d in_plane(const Eigen::Vector2d& pixel) const {
    return aim_ + pixel_width() * Eigen::Vector2d(pixel.x() - width_ / 2., height_ / 2. - pixel.y());
  }

  Eigen::Vector3d shifted(const Eigen::Vector3d& p) const {
    return p.unaryExpr([this](double x) { return std::ldexp(x, -exponent_); });
  }

  void frame_box(const Scene& scene) {
    double largest = 0;
    for (const auto& triangle : scene.triangles)
      for (int v : triangle)
        largest = std::max(largest, scene.points[v].lpNorm<Eigen::Infinity>());
    std::frexp(largest, &exponent_);
    Eigen::AlignedBox3d box;
    for (const auto& triangle : scene.triangles)
      for (int v : triangle)
        box.extend(shifted(scene.points[v]));
    center_ = box.center();
    const double longest = box.sizes().maxCoeff();
    half_edge_ = longest > 0 ? longest / 2 : 1;
  }

  /// Of the largest and the smallest numbers, too; zero stays.
  static Eigen::Vector3d unit(const Eigen::Vector3d& direction) {
    const double largest = direction.lpNorm<Eigen::Infinity>();
    return largest > 0 ? Eigen::Vector3d((direction / largest).normalized()) : direction;
  }

  void look_along(const Eigen::Vector3d& direction, Eigen::Vector3d up) {
    if (direction.cross(up).norm() <
        1e-3) // a picture's upward direction, not a geometric decision: any other axis will do
      up = std::abs(direction.y()) < 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
    rotation_.row(2) = -direction.transpose();
    rotation_.row(0) = direction.cross(up).normalized().transpose();
    rotation_.row(1) = rotation_.row(2).cross(rotation_.row(0));
  }

  void fit(const Scene& scene) {
    std::vector<Eigen::Vector3d> shown; // as the camera sees them: rightwards, upwards, towards the eye
    auto include = [&](const Eigen::Vector3d& p) { shown.push_back(rotation_ * p); };
    bool has_far_ends = false;
    auto include_if_near = [&](const Eigen::Vector3d& p) {
      if (const Eigen::Vector3d q = scaled(p); q.lpNorm<Eigen::Infinity>() <= 2)
        include(q);
      else
        has_far_ends = true;
    };
    for (const auto& triangle : scene.triangles)
      for (int v : triangle)
        include(scaled(scene.points[v]));
    for (const auto& s : scene.segments)
      include_if_near(s.source), include_if_near(s.target);
    for (const auto& b : scene.balls)
      include_if_near(b.center);
    for (const auto& a : scene.arrows)
      include_if_near(a.foot);

    frame(shown);
    // The size of marks is in pixels, so the tips of arrows are known when the distance is; it grows little by them.
    const std::size_t without_tips = shown.size();
    for (int i = 0; i < 2 && !scene.arrows.empty(); ++i) {
      shown.resize(without_tips);
      for (const auto& a : scene.arrows)
        if (const Eigen::Vector3d foot = scaled(a.foot); foot.lpNorm<Eigen::Infinity>() <= 2)
          include(foot + a.length * pixel_width() * a.direction.stableNormalized());
      frame(shown);
    }
    if (has_far_ends) // ways may lead past the eye
      nearest_ = distance_;
  }

  void frame(const std::vector<Eigen::Vector3d>& shown) {
    Eigen::AlignedBox3d box;
    for (const auto& q : shown)
      box.extend(q);
    aim_ = box.center().head<2>();
    const double margin = 1.12; // room for balls and labels, too
    distance_ = 0;
    for (const auto& q : shown)
      distance_ = std::max({distance_, q.z() + margin * std::abs(q.x() - aim_.x()) / tangent_x(),
                            q.z() + margin * std::abs(q.y() - aim_.y()) / tangent_y(), q.z() + 1});
    nearest_ = box.max().z();
  }
};

} // namespace haptic_sculpt::drawing
