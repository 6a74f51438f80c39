// SPDX-License-Identifier: GPL-3.0-or-later
#include "write_picture.h"
#include "Mesh_view.h"
#include "Offscreen_context.h"
#include "draw_plot.h"
#include "write_png.h"
#include "write_words.h"
#include <cfenv>

namespace haptic_sculpt::drawing {
namespace {

/// A framebuffer with smooth edges (four samples a pixel), and a plain one to read it through.
class Offscreen_framebuffer {
public:
  Offscreen_framebuffer(int width, int height) : width_(width), height_(height) {
    int largest = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width > largest || height > largest)
      throw Picture_error("A picture of " + std::to_string(width) + " x " + std::to_string(height) +
                          " pixels cannot be drawn. Give a width and height of at most " + std::to_string(largest) +
                          '.');
    glGenFramebuffers(2, framebuffers_);
    glGenRenderbuffers(4, renderbuffers_);
    attach(framebuffers_[1], GL_DEPTH_ATTACHMENT, renderbuffers_[3], GL_DEPTH_COMPONENT24, 0);
    attach(framebuffers_[1], GL_COLOR_ATTACHMENT0, renderbuffers_[2], GL_RGBA8, 0);
    attach(framebuffers_[0], GL_DEPTH_ATTACHMENT, renderbuffers_[1], GL_DEPTH_COMPONENT24, 4);
    attach(framebuffers_[0], GL_COLOR_ATTACHMENT0, renderbuffers_[0], GL_RGBA8, 4);
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

Image draw(const Scene& scene, const View& view) {
  scene.check();
  const Camera camera(scene, view);
  const Floating_point_guard guard;
  const Offscreen_context context;
  const Offscreen_framebuffer framebuffer(camera.width(), camera.height());
  Mesh_view mesh_view;
  mesh_view.set_scene(scene, camera);
  std::vector<float> depths; // of the mesh alone: marks do not hide the numbers of what they mark
  if (!scene.labels.empty()) {
    mesh_view.draw_mesh(camera, view.background);
    depths = framebuffer.depths();
  }
  mesh_view.draw(camera, view.background);
  const std::vector<unsigned char> drawn = framebuffer.pixels();
  Image image(view.width, view.height, view.background);
  const int strip = view.height - camera.height();
  std::copy(drawn.begin(), drawn.end(), image.bytes.begin() + std::ptrdiff_t(3) * view.width * strip);
  write_labels(image, scene, camera, depths);
  write_legend(image, scene, strip);
  return image;
}

} // namespace

std::string write_picture(const Scene& scene, const std::filesystem::path& path, const View& view) {
  const Image image = draw(scene, view);
  return write_png(path, image.width, image.height, image.bytes);
}

std::string write_figure(const Scene& scene, const std::vector<Plot>& plots, const std::filesystem::path& path,
                         const View& view) {
  const Image left = draw(scene, view);
  Image image(view.width + 2 * view.width / 3, view.height, view.background);
  for (int row = 0; row < view.height; ++row)
    std::copy_n(left.bytes.begin() + std::ptrdiff_t(3) * row * left.width, std::ptrdiff_t(3) * left.width,
                image.bytes.begin() + std::ptrdiff_t(3) * row * image.width);
  const int number = std::max(1, int(plots.size()));
  for (int i = 0; i < int(plots.size()); ++i)
    Plot_painter(image, {view.width, view.height * i / number}, {image.width, view.height * (i + 1) / number}, plots[i]);
  return write_png(path, image.width, image.height, image.bytes);
}

} // namespace haptic_sculpt::drawing
