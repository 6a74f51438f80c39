// SPDX-License-Identifier: GPL-3.0-or-later
#include "write_picture.h"
#include "Mesh_view.h"
#include "Offscreen_context.h"
#include "write_png.h"
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
    glGenRenderbuffers(3, renderbuffers_);
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

  std::vector<unsigned char> pixels() const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[0]);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[1]);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    std::vector<unsigned char> result(std::size_t(3) * width_ * height_);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, result.data());
    if (const GLenum code = glGetError(); code != GL_NO_ERROR)
      throw Picture_error("The OpenGL driver failed while drawing (error " + std::to_string(code) +
                          "). Draw a smaller picture or a coarser mesh.");
    return result;
  }

private:
  int width_, height_;
  GLuint framebuffers_[2] = {}, renderbuffers_[3] = {};

  void attach(GLuint framebuffer, GLenum place, GLuint renderbuffer, GLenum format, int samples) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width_, height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, renderbuffer);
  }
  void destroy() {
    glDeleteRenderbuffers(3, renderbuffers_);
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

} // namespace

std::string write_picture(const Scene& scene, const std::filesystem::path& path, const View& view) {
  scene.check();
  const Camera camera(scene, view);
  const Floating_point_guard guard;
  const Offscreen_context context;
  const Offscreen_framebuffer framebuffer(view.width, view.height);
  Mesh_view mesh_view;
  mesh_view.set_scene(scene, camera);
  mesh_view.draw(camera, view.background);
  return write_png(path, view.width, view.height, framebuffer.pixels());
}

} // namespace haptic_sculpt::drawing
