// SPDX-License-Identifier: GPL-3.0-or-later
#include "write_picture.h"
#include "Mesh_view.h"
#include "Offscreen_context.h"
#include "write_png.h"
#include "write_words.h"

#include "../common/output_targets.h"

#include <cfenv>

namespace haptic_sculpt::drawing {
namespace {

/// A framebuffer with smooth edges (four samples a pixel, if the driver has them), and a plain one to read it through.
class Offscreen_framebuffer {
public:
  Offscreen_framebuffer(int width, int height) : width_(width), height_(height) {
    int largest = 0, most_samples = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest), glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
    const int samples = most_samples >= 4 ? 4 : 0;
    if (width > largest || height > largest)
      throw Picture_error("A picture of " + std::to_string(width) + " x " + std::to_string(height) +
                          " pixels cannot be drawn. Give a width and height of at most " + std::to_string(largest) +
                          '.');
    glGenFramebuffers(2, framebuffers_);
    glGenRenderbuffers(4, renderbuffers_);
    attach(framebuffers_[1], GL_DEPTH_ATTACHMENT, renderbuffers_[3], GL_DEPTH_COMPONENT24, 0);
    attach(framebuffers_[1], GL_COLOR_ATTACHMENT0, renderbuffers_[2], GL_RGBA8, 0);
    attach(framebuffers_[0], GL_DEPTH_ATTACHMENT, renderbuffers_[1], GL_DEPTH_COMPONENT24, samples);
    attach(framebuffers_[0], GL_COLOR_ATTACHMENT0, renderbuffers_[0], GL_RGBA8, samples);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR) {
      destroy();
      throw Picture_error("The OpenGL driver cannot make a picture of " + std::to_string(width) + " x " +
                          std::to_string(height) + " pixels. Give a smaller width and height.");
    }
  }
  ~Offscreen_framebuffer() { destroy(); }
  Offscreen_framebuffer(const Offscreen_framebuffer&) = delete;
  Offscreen_framebuffer& operator=(const Offscreen_framebuffer&) = delete;

  /// The lowest row first, as all that OpenGL gives.
  std::vector<unsigned char> pixels() const {
    return read<unsigned char>(GL_COLOR_BUFFER_BIT, 3, GL_RGB, GL_UNSIGNED_BYTE);
  }
  std::vector<float> depths() const { return read<float>(GL_DEPTH_BUFFER_BIT, 1, GL_DEPTH_COMPONENT, GL_FLOAT); }

private:
  int width_, height_;
  GLuint framebuffers_[2] = {}, renderbuffers_[4] = {};

  template <class Number>
  std::vector<Number> read(GLbitfield buffer, int numbers, GLenum format, GLenum type) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[0]);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[1]);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, buffer, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    std::vector<Number> result(std::size_t(numbers) * width_ * height_);
    glReadPixels(0, 0, width_, height_, format, type, result.data());
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
    if (const GLenum code = glGetError(); code != GL_NO_ERROR)
      throw Picture_error("The OpenGL driver failed while drawing (error " + std::to_string(code) +
                          "). Draw a smaller picture or a coarser mesh.");
    return result;
  }

  void attach(GLuint framebuffer, GLenum place, GLuint renderbuffer, GLenum format, int samples) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width_, height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, renderbuffer);
  }
  void destroy() {
    glDeleteRenderbuffers(4, renderbuffers_);
    glDeleteFramebuffers(2, framebuffers_);
  }
};

/// A driver may leave rounding or underflow changed in the thread that calls it, and exact arithmetic relies on both.
class Floating_point_guard {
public:
  Floating_point_guard() { std::fegetenv(&environment_); }
  ~Floating_point_guard() { std::fesetenv(&environment_); }

private:
  std::fenv_t environment_;
};

/// All of them in one, to place the camera by.
Scene joined(const std::vector<Scene>& scenes) {
  Scene all;
  for (const Scene& scene : scenes) {
    const int first = int(all.points.size());
    all.points.insert(all.points.end(), scene.points.begin(), scene.points.end());
    for (const auto& t : scene.triangles)
      all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    all.segments.insert(all.segments.end(), scene.segments.begin(), scene.segments.end());
    all.balls.insert(all.balls.end(), scene.balls.begin(), scene.balls.end());
    all.arrows.insert(all.arrows.end(), scene.arrows.begin(), scene.arrows.end());
  }
  return all;
}

/// Of one scene, without its legend. \pre the framebuffer is bound, and has the camera's size
Image drawn(const Scene& scene, const Camera& camera, const Color& background, Mesh_view& mesh_view,
            const Offscreen_framebuffer& framebuffer) {
  mesh_view.set_scene(scene, camera);
  std::vector<float> depths; // of the mesh alone: marks do not hide the numbers of what they mark
  if (!scene.labels.empty()) {
    mesh_view.draw_mesh(camera, background);
    depths = framebuffer.depths();
  }
  mesh_view.draw(camera, background);
  Image image(camera.width(), camera.height(), background);
  image.bytes = framebuffer.pixels();
  write_labels(image, scene, camera, depths);
  if (!scene.title.empty()) {
    const Text text(std::max(12, camera.height() / 36));
    text.write(image, text.height(), 2 * text.height(), scene.title, ink);
  }
  return image;
}

/// Side by side, with the legend of the last one.
Image drawn(const std::vector<Scene>& scenes, const View& view) {
  for (const Scene& scene : scenes)
    scene.check();
  const int strip = scenes.back().legend_height(view.width);
  View part = view;
  part.width = view.width / int(scenes.size());
  part.height = view.height - strip;
  const Camera camera(joined(scenes), part);
  const Floating_point_guard guard;
  const Offscreen_context context;
  const Offscreen_framebuffer framebuffer(camera.width(), camera.height());
  Mesh_view mesh_view;
  Image image(view.width, view.height, view.background);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Image one = drawn(scenes[i], camera, view.background, mesh_view, framebuffer);
    const std::ptrdiff_t row = std::ptrdiff_t(3) * one.width, left = std::ptrdiff_t(i) * row;
    for (int y = 0; y < one.height; ++y) // the lowest first: above the strip
      std::copy_n(one.bytes.begin() + y * row, row,
                  image.bytes.begin() + std::ptrdiff_t(3) * view.width * (y + strip) + left);
  }
  write_legend(image, scenes.back(), strip);
  return image;
}

} // namespace

std::string write_picture(const Scene& scene, const std::filesystem::path& path, const View& view) {
  return write_pictures({scene}, path, view);
}

std::string write_pictures(const std::vector<Scene>& scenes, const std::filesystem::path& path, const View& view) {
  if (!examples::is_picture_name(path.string())) // a mesh by a slip
    throw Picture_error("'" + path.string() + "' does not end in .png: give the picture another name");
  const Image image = drawn(scenes, view);
  return write_png(path, image.width, image.height, image.bytes);
}

} // namespace haptic_sculpt::drawing
