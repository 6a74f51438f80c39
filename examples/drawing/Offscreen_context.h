// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#define EGL_NO_X11 // X11's headers define `None`, `Status`, `Bool` as macros
#define MESA_EGL_NO_X11_HEADERS
#include "Scene.h"
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <cstdlib>

namespace haptic_sculpt::drawing {

/// An OpenGL 3.3 core context without window, display or graphics card (EGL's surfaceless platform). It is current in
/// the calling thread as long as the object lives; then none is.
class Offscreen_context {
public:
  /// \throw Picture_error if the machine has no such context; says which packages bring it.
  Offscreen_context() {
    // Where the system gives no more threads, llvmpipe waits for ever for those that it has not got. It draws without.
    ::setenv("LP_NUM_THREADS", "0", 0);
    // libepoxy ends the program when a function is missing, so every need is asked for first.
    if (!epoxy_has_egl() || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
      refuse("EGL's surfaceless platform is missing");
    display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
      refuse("EGL does not start");
    const EGLint config_attributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint context_attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    if (eglBindAPI(EGL_OPENGL_API) && eglChooseConfig(display_, config_attributes, &config, 1, &configs) &&
        configs == 1)
      context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, context_attributes);
    if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      const EGLint code = eglGetError();
      close();
      refuse("there is no OpenGL 3.3 core context (EGL error " + std::to_string(code) + ')');
    }
  }
  ~Offscreen_context() { close(); }
  Offscreen_context(const Offscreen_context&) = delete;
  Offscreen_context& operator=(const Offscreen_context&) = delete;

private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;

  [[noreturn]] static void refuse(const std::string& what) {
    throw Picture_error("Cannot draw a picture: " + what +
                        ". Install libegl1 and libgl1-mesa-dri, give more memory, or ask for no picture.");
  }

  // The display itself stays initialised: it belongs to the whole process, and others may have a context on it.
  void close() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT)
      eglDestroyContext(display_, context_);
  }
};

} // namespace haptic_sculpt::drawing
