// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Triangle_buffer.h"

namespace haptic_sculpt::drawing {

/// What the card gets of a triangle: its corners and its normal, scaled.
std::array<Corner, 3> corners_of(const Camera& camera, const std::array<Eigen::Vector3d, 3>& points,
                                 const Color& color);

/// How Mesh_view::draw_smooth() shows a mesh.
struct Smooth_look {
  bool shows_edges = false;
  bool faces_outwards = true;           ///< else the backs of faces are what is seen of the mesh
  std::vector<Eigen::Vector3f> brushes; ///< scaled; a ring about each, and a tint that fades towards it; at most 8
  float brush_radius = 0;               ///< of the rings, scaled
  Color brush_color = colors::blue;
};

/// Draws a scene into the current framebuffer of the current OpenGL 3.3 core context, whoever made it: a file's
/// off-screen context or a window's. The framebuffer has the camera's size.
///
/// Faces are lit flat by two lights that stay beside the eye, and edges are thin lines that fade where triangles are
/// too small for them. A face seen from inside is pink: on a closed, outward oriented mesh there is none. Marks hidden
/// by the surface show through it faintly. Where two faces touch, the one seen from outside is seen.
class Mesh_view {
public:
  /// \pre an OpenGL 3.3 context is current, the same one in all calls. \throw Picture_error if it cannot draw.
  Mesh_view();
  ~Mesh_view();
  Mesh_view(const Mesh_view&) = delete;
  Mesh_view& operator=(const Mesh_view&) = delete;

  /// Hands mesh and marks to the graphics card. The marks get their size from `camera`; once the camera or the scene
  /// has changed this must be called anew. O(triangles + marks). \pre `scene.check()` has passed.
  void set_scene(const Scene& scene, const Camera& camera);
  /// The marks alone.
  void set_marks(const Scene& scene, const Camera& camera);
  /// For who changes the mesh triangle by triangle (corners_of()).
  Triangle_buffer& mesh() { return mesh_; }

  /// Clears the framebuffer to `background` and draws.
  void draw(const Camera& camera, const Color& background) const {
    draw_mesh(camera, background);
    draw_marks(camera);
  }
  /// Clears and draws the mesh alone.
  void draw_mesh(const Camera& camera, const Color& background) const;
  /// As draw(), for a hand that sculpts: of a closed surface the faces that are seen from outside, lit at their corners
  /// and at their rim, in less than half of the time.
  void draw_smooth(const Camera& camera, const Color& background, const Smooth_look& look) const;

private:
  unsigned program_ = 0, smooth_program_ = 0, smooth_program_with_edges_ = 0;
  float edge_opacity_ = Scene().edge_opacity;
  Triangle_buffer mesh_, marks_;

  /// \pre the mesh has just been drawn
  void draw_marks(const Camera& camera) const;
  void use(unsigned program, const Camera& camera) const;
  static void clear(const Camera& camera, const Color& background);
};

} // namespace haptic_sculpt::drawing
