// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Camera.h"
#include <utility>

namespace haptic_sculpt::drawing {

/// What the graphics card gets for each corner of a triangle, in scaled coordinates (Camera).
struct Corner {
  Eigen::Vector3f position, normal;
  Color color;
};

/// Turns marks into triangles: OpenGL's core profile has no wide lines, and round ones can be lit.
class Mark_triangles {
public:
  explicit Mark_triangles(const Camera& camera) : camera_(camera), pixel_(camera.pixel_width()) {}

  void add(const Ball& b) {
    if (is_within_frame(b.center, b.radius))
      add_profile(camera_.scaled(b.center), axis_z, arc(b.radius * pixel_), b.color);
  }

  void add(const Segment& s) {
    Eigen::Vector3d a = camera_.scaled(s.source), b = camera_.scaled(s.target);
    if (!cut_to_picture(a, b))
      return;
    const auto [from, to] = part_within_frame(a, b);
    if (!(from < to))
      return;
    const Eigen::Vector3d whole = b - a;
    b = a + to * whole;
    a += from * whole;
    if (a == b)
      return;
    const double length = (b - a).stableNorm(), radius = s.radius * pixel_;
    // A line along the view lies within the frame as a whole, however near the eye looks.
    const double period = std::max(18 * pixel_, length / most_dashes), dash = period * 11 / 18;
    const Eigen::Vector3d axis = (b - a) / length;
    const double step = s.dashed ? period : length;
    for (double t = 0; t < length; t += step) {
      const double end = s.dashed ? std::min(dash, length - t) : length;
      add_profile(a + t * axis, axis,
                  {{0, 0, -1, 0},
                   {0, radius, -1, 0},
                   {0, radius, 0, 1},
                   {end, radius, 0, 1},
                   {end, radius, 1, 0},
                   {end, 0, 1, 0}},
                  s.color);
    }
    if (to < 1) // it goes on outside of the picture
      add_profile(b, axis,
                  {{-5 * radius, 0, -1, 0},
                   {-5 * radius, 3 * radius, -1, 0},
                   {-5 * radius, 3 * radius, 0.5, 0.87},
                   {0, 0, 0.5, 0.87}},
                  s.color);
  }

  void add(const Arrow& a) {
    if (!is_within_frame(a.foot, 0))
      return;
    const double tip = a.length * pixel_, neck = 0.68 * tip, shaft = 0.035 * tip, head = 0.115 * tip;
    add_profile(camera_.scaled(a.foot), a.direction.stableNormalized(),
                {{0, 0, -1, 0},
                 {0, shaft, -1, 0},
                 {0, shaft, 0, 1},
                 {neck, shaft, 0, 1},
                 {neck, shaft, -1, 0},
                 {neck, head, -1, 0},
                 {neck, head, 0.34, 0.94},
                 {tip, 0, 0.34, 0.94}},
                a.color);
  }

  const std::vector<Corner>& corners() const { return corners_; }

private:
  // A point of a profile turned about an axis: height along the axis and radius, and the normal's two components.
  struct Profile_point {
    double height, radius, normal_along, normal_out;
  };

  const Eigen::Vector3d axis_z = Eigen::Vector3d::UnitZ();
  const Camera& camera_;
  double pixel_;
  std::vector<Corner> corners_;

  static std::vector<Profile_point> arc(double radius) {
    std::vector<Profile_point> result;
    for (int i = 0; i <= 10; ++i) {
      const double s = -std::cos(EIGEN_PI * i / 10), c = std::sin(EIGEN_PI * i / 10);
      result.push_back({radius * s, radius * c, s, c});
    }
    return result;
  }

  void add_profile(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                   const std::vector<Profile_point>& profile, const Color& color) {
    if (origin.lpNorm<Eigen::Infinity>() > 4)
      return; // outside the picture
    const int sides = 20;
    const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    auto corner = [&](const Profile_point& p, int side) -> Corner {
      const double angle = 2 * EIGEN_PI * (side % sides) / sides;
      const Eigen::Vector3d out = std::cos(angle) * u + std::sin(angle) * v;
      return {(origin + p.height * axis + p.radius * out).cast<float>(),
              (p.normal_along * axis + p.normal_out * out).cast<float>(), color};
    };
    for (std::size_t i = 1; i < profile.size(); ++i)
      for (int side = 0; side < sides; ++side) {
        const Corner a = corner(profile[i - 1], side), b = corner(profile[i - 1], side + 1),
                     c = corner(profile[i], side + 1), d = corner(profile[i], side);
        corners_.insert(corners_.end(), {a, b, c, a, c, d});
      }
  }

  // Across a picture of 9,000 pixels there are as many.
  static constexpr double most_dashes = 500;
  // Marks keep this many pixels away from the picture's border.
  static constexpr double margin = 12;

  bool is_within_frame(const Eigen::Vector3d& p, double radius) const {
    const Eigen::Vector4d clip = camera_.projection() * camera_.scaled(p).homogeneous();
    const Eigen::Array2d most = frame() + (margin - radius) * 2 / Eigen::Array2d(camera_.width(), camera_.height());
    return clip.w() > 0 && (clip.head<2>().array().abs() <= most * clip.w()).all();
  }

  // The part of the segment, from 0 to 1, that is seen within the margin.
  std::pair<double, double> part_within_frame(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    const Eigen::Vector4d p = camera_.projection() * a.homogeneous(), q = camera_.projection() * b.homogeneous();
    double from = 0, to = 1;
    const auto cut = [&](double at_p, double at_q) { // by where a linear function is not negative
      if (at_p < 0 && at_q < 0)
        to = -1;
      else if (at_p < 0)
        from = std::max(from, at_p / (at_p - at_q));
      else if (at_q < 0)
        to = std::min(to, at_p / (at_p - at_q));
    };
    cut(p.w() - camera_.near_plane(), q.w() - camera_.near_plane());
    for (int i = 0; i < 2; ++i) {
      cut(frame()[i] * p.w() - p[i], frame()[i] * q.w() - q[i]);
      cut(frame()[i] * p.w() + p[i], frame()[i] * q.w() + q[i]);
    }
    return {from, to};
  }

  // Half the frame's width and height within the margin, where the picture's are 1.
  Eigen::Array2d frame() const {
    return (1 - 2 * margin / Eigen::Array2d(camera_.width(), camera_.height())).max(0.5);
  }

  // Cuts the segment to the cube of half-edge 4 around the picture (Liang and Barsky's parametric clipping);
  // false if nothing is left.
  static bool cut_to_picture(Eigen::Vector3d& a, Eigen::Vector3d& b) {
    if (a.squaredNorm() > b.squaredNorm())
      return cut_to_picture(b, a); // measured from the nearer end: a far one's digits would drown the cut
    const Eigen::Vector3d from = a, along = b - a;
    double enter = 0, leave = 1;
    for (int i = 0; i < 3; ++i) {
      if (along[i] == 0) {
        if (std::abs(from[i]) > 4)
          return false;
        continue;
      }
      const double t1 = (-4 - from[i]) / along[i], t2 = (4 - from[i]) / along[i];
      enter = std::max(enter, std::min(t1, t2));
      leave = std::min(leave, std::max(t1, t2));
    }
    if (enter > leave)
      return false;
    if (leave < 1)
      b = from + leave * along;
    if (enter > 0)
      a = from + enter * along;
    return true;
  }
};

} // namespace haptic_sculpt::drawing
