// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "exchange.h"

#include "../drawing/Mesh_view.h"

#include <exception>
#include <optional>

namespace haptic_sculpt::window_program {

/// Colours that nothing else in the window has, so that a test finds what they mark.
namespace mark_colors {
inline const drawing::Color contact{0.93f, 0.00f, 0.60f}, force{0.00f, 0.62f, 0.12f}, brush{0.10f, 0.75f, 0.90f},
    mask{0.16f, 0.26f, 0.62f};
}

/// The mesh as the window draws it, with what the hand does. Uploads what has changed and no more.
/// \pre the window's OpenGL context is current whenever it is called
class Sculpture_view {
public:
  /// Another mesh, seen from where all of it is seen. O(faces).
  /// \param middle where planes of symmetry are \throw drawing::Picture_error: the one before stays then
  void show(const std::vector<Seen_face>& faces, const Place& middle, int width, int height);
  bool has_mesh() const { return camera_.has_value(); }
  /// \pre has_mesh()
  drawing::Camera& camera() { return *camera_; }
  /// Sees all of the mesh as it was opened, along the same direction.
  void fit();
  /// From here on the picture is that of the window without its leftmost pixels. \pre has_mesh()
  void frame(double covered);
  bool shows_edges() const { return shows_edges_; }
  void show_edges(bool shows) { shows_edges_ = shows; }

  /// To be drawn with the next frame.
  void change(const Seen_face& change) { changes_.push_back(change); }
  /// What changes have had uploaded, of all meshes so far, in bytes; and how many faces.
  std::size_t uploaded_bytes() const { return uploaded_; }
  std::size_t uploaded_faces() const { return uploaded_faces_; }

  struct Hand_marks {
    bool shows_brush = false;
    Brush brush;
  };
  /// Uploads, clears the framebuffer and draws. \throw drawing::Picture_error where there was no memory for all
  /// changes; what there is room for is drawn, and the others are not tried again
  void draw(const Status& status, const Hand_marks& marks);

  /// From the eye through a pixel to beyond the mesh. \pre has_mesh()
  Pointer pointer_at(const Eigen::Vector2d& pixel) const;

private:
  std::optional<drawing::Mesh_view> view_;
  std::optional<drawing::Camera> camera_, first_camera_;
  bool faces_outwards_ = true; ///< else the mesh is turned inside out, and what is seen of it are the backs of faces
  bool shows_edges_ = false;
  double covered_ = 0; ///< pixels on the left
  Place middle_{};
  std::vector<Seen_face> changes_;
  std::size_t uploaded_ = 0, uploaded_faces_ = 0;

  std::exception_ptr upload();
  std::vector<std::array<Eigen::Vector3d, 2>> brush_spots(const Pointed& pointed, const Brush& brush) const;
  drawing::Scene marks_of(const Status& status, const Hand_marks& marks) const;
};

} // namespace haptic_sculpt::window_program
