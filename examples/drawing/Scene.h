// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Write_error.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace haptic_sculpt::drawing {

/// A picture that cannot be drawn or written; says what to do about it.
class Picture_error : public Write_error {
public:
  using Write_error::Write_error;
};

/// Red, green, blue in [0, 1].
using Color = Eigen::Vector3f;

/// Blue, orange, red and purple of different lightness on a sandy surface: told apart by colour-blind readers and in
/// greyscale print.
namespace colors {
inline const Color blue{0.00f, 0.38f, 0.72f}, orange{0.96f, 0.62f, 0.05f}, red{0.80f, 0.09f, 0.12f},
    purple{0.48f, 0.16f, 0.56f}, surface{0.89f, 0.86f, 0.79f}, white{1.00f, 1.00f, 1.00f};
}

/// A round line. Its radius is in pixels at the distance of the mesh's centre, as are all sizes of marks: a mark looks
/// the same on a mesh of any size.
struct Segment {
  Eigen::Vector3d source, target;
  Color color = colors::blue;
  double radius = 2;
  bool dashed = false;
};

struct Ball {
  Eigen::Vector3d center;
  Color color = colors::orange;
  double radius = 6;
};

/// An arrow from `foot` along `direction`, whose length does not count but may not be zero.
struct Arrow {
  Eigen::Vector3d foot, direction;
  Color color = colors::purple;
  double length = 60;
};

/// Words beside a point: shown where the point is seen and no label that stands before it in the scene is in the way.
struct Label {
  Eigen::Vector3d place;
  std::string text;
};

/// A line of the legend below the picture.
struct Legend_entry {
  enum class Mark { line, dashes, arrow, ball };
  Mark mark;
  Color color;
  std::string text; ///< ASCII
};

/// What a picture shows: one triangle mesh and marks on it. Coordinates are the user's, of any size and offset.
struct Scene {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles; ///< indices into `points`, counterclockwise from outside
  std::vector<Color> point_colors;           ///< one a point, or empty: all of `surface_color`
  std::vector<Eigen::Vector3d>
      point_normals; ///< of length 1, one a point, for smooth shading; or empty: faces are flat
  Color surface_color = colors::surface;
  float edge_opacity = 0.62f; ///< of the lines along the mesh's edges; 0: none
  std::vector<Segment> segments;
  std::vector<Ball> balls;
  std::vector<Arrow> arrows;
  std::vector<Label> labels;
  std::vector<Legend_entry> legend; ///< empty: none
  std::string title;                ///< ASCII, above; empty: none

  /// Marks a vertex that was moved.
  void add_moved_vertex(const Eigen::Vector3d& p) { balls.push_back({p}); }

  /// Marks a drag that was stopped: blue the way travelled, red the stop, dashed the way that was refused.
  void add_blocked_drag(const Eigen::Vector3d& start, const Eigen::Vector3d& stop, const Eigen::Vector3d& target) {
    add_blocked_drag(std::vector<Eigen::Vector3d>{start, stop}, target);
  }
  /// The same of a way with several legs. \param way where it began, the bends, where it was stopped
  void add_blocked_drag(const std::vector<Eigen::Vector3d>& way, const Eigen::Vector3d& target) {
    const Eigen::Vector3d start = way.front(), stop = way.back();
    for (std::size_t i = 1; i < way.size(); ++i)
      segments.push_back({way[i - 1], way[i], colors::blue, 3});
    segments.push_back({stop, target, colors::red, 1.8, true});
    balls.push_back({start, colors::blue, 5});
    balls.push_back({stop, colors::red, 7.5});
    balls.push_back({target, colors::red, 4});
  }

  /// Marks a contact and the normal along which it pushes.
  void add_contact(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    arrows.push_back({p, normal});
    balls.push_back({p, colors::purple, 4.5});
  }

  /// Says in the legend what those of these marks mean that are in the scene.
  void explain_marks() {
    const auto has_ball = [this](const Color& color) {
      return std::any_of(balls.begin(), balls.end(), [&](const Ball& b) { return b.color == color; });
    };
    if (has_ball(colors::orange))
      legend.push_back({Legend_entry::Mark::ball, colors::orange, "vertex moved"});
    if (has_ball(colors::red)) {
      legend.push_back({Legend_entry::Mark::line, colors::blue, "way made"});
      legend.push_back({Legend_entry::Mark::ball, colors::red, "stopped"});
      legend.push_back({Legend_entry::Mark::dashes, colors::red, "way refused"});
    }
    if (!arrows.empty())
      legend.push_back({Legend_entry::Mark::arrow, colors::purple, "push of a contact"});
  }

  /// How many rows of a picture so wide the legend takes, at its bottom.
  int legend_height(int width) const { return legend.empty() ? 0 : std::clamp(width * 36 / 1200, 16, 60); }

  /// \throw Picture_error for an empty mesh, an index out of range, a number that is not finite: the element is named.
  void check() const {
    if (triangles.empty())
      throw Picture_error("There is nothing to draw: the mesh has no triangle. Give a mesh with triangles.");
    if (!point_colors.empty() && point_colors.size() != points.size())
      throw Picture_error("There are " + std::to_string(point_colors.size()) + " colours for " +
                          std::to_string(points.size()) + " points. Give one colour a point, or none.");
    if (!point_normals.empty() && point_normals.size() != points.size())
      throw Picture_error("There are " + std::to_string(point_normals.size()) + " normals for " +
                          std::to_string(points.size()) + " points. Give one normal a point, or none.");
    auto require_finite = [](bool finite, const std::string& kind, std::size_t i) {
      if (!finite)
        throw Picture_error(kind + ' ' + std::to_string(i) + " is not finite. Give finite numbers.");
    };
    for (std::size_t i = 0; i < points.size(); ++i)
      require_finite(points[i].allFinite(), "Point", i);
    for (std::size_t i = 0; i < point_colors.size(); ++i)
      require_finite(point_colors[i].allFinite(), "The colour of point", i);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (int v : triangles[i])
        if (v < 0 || std::size_t(v) >= points.size())
          throw Picture_error("Triangle " + std::to_string(i) + " names point " + std::to_string(v) +
                              ", but there are " + std::to_string(points.size()) +
                              " points, from 0. Correct the triangle.");
    for (std::size_t i = 0; i < segments.size(); ++i)
      require_finite(segments[i].source.allFinite() && segments[i].target.allFinite(), "Segment", i);
    for (std::size_t i = 0; i < labels.size(); ++i)
      require_finite(labels[i].place.allFinite(), "Label", i);
    for (std::size_t i = 0; i < balls.size(); ++i)
      require_finite(balls[i].center.allFinite(), "Ball", i);
    for (std::size_t i = 0; i < arrows.size(); ++i) {
      require_finite(arrows[i].foot.allFinite() && arrows[i].direction.allFinite(), "Arrow", i);
      if (arrows[i].direction.isZero(0))
        throw Picture_error("Arrow " + std::to_string(i) + " has no direction. Give it one that is not zero.");
    }
  }
};

} // namespace haptic_sculpt::drawing
