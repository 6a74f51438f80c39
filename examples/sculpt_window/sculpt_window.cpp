// SPDX-License-Identifier: GPL-3.0-or-later
// A window to sculpt in. See --help; what the mouse and the keys do, scripts, limits: doc/use/window.md.
#include "Application.h"
#include "write_ball.h"

#include "../common/contents_of.h"
#include "../common/mesh_program.h"
#include "../drawing/write_png.h"

#include <haptic_sculpt/haptic_rendering/Force_limit.h>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <ctime>
#include <thread>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::window_program;

enum Own_exit { no_window = 7 };

struct No_window : Error {
  using Error::Error;
};

std::string& glfw_says() {
  static std::string text;
  return text;
}

Application& application_of(GLFWwindow* window) {
  return *static_cast<Application*>(glfwGetWindowUserPointer(window));
}

/// The window, with GLFW and Dear ImGui about it.
class Window {
public:
  explicit Window(const Options& options) {
    glfwSetErrorCallback([](int, const char* text) { glfw_says() = text; });
    if (!glfwInit())
      refuse("GLFW does not start");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SAMPLES, options.samples ? *options.samples : draws_in_software() ? 0 : 4);
    window_ = glfwCreateWindow(options.size[0], options.size[1], "sculpt_window", nullptr, nullptr);
    if (window_ == nullptr) {
      glfwTerminate();
      refuse("there is no window with OpenGL 3.3");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    set_callbacks();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // no file is left behind
    ImGui::StyleColorsDark();
    ImGui_ImplGlfw_InitForOpenGL(window_, true); // keeps our callbacks
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }
  ~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// From here on input goes there.
  void serve(Application& application) { glfwSetWindowUserPointer(window_, &application); }

  std::array<int, 2> size() const {
    std::array<int, 2> size{};
    glfwGetFramebufferSize(window_, &size[0], &size[1]);
    return size;
  }
  bool was_closed() {
    const bool closed = glfwWindowShouldClose(window_) != 0;
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
    return closed;
  }

  void draw(Application& application) {
    if (const std::string title = application.title(); title != title_)
      glfwSetWindowTitle(window_, (title_ = title).c_str());
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    application.draw_panels();
    ImGui::Render();
    application.draw();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }
  /// Of what has just been drawn.
  std::string write_screenshot(const std::string& path) const {
    const auto [width, height] = size();
    std::vector<unsigned char> pixels(std::size_t(3) * std::size_t(width) * std::size_t(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    return drawing::write_png(path, width, height, pixels);
  }
  void show() const {
    glfwSwapBuffers(window_);
    glFinish();
  }

private:
  GLFWwindow* window_ = nullptr;
  std::string title_;

  /// Asks the driver, by a window that is not shown. \pre what the context has to be has been said
  static bool draws_in_software() {
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* const window = glfwCreateWindow(1, 1, "", nullptr, nullptr);
    glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
    if (window == nullptr)
      return false; // what is missing is said of the window proper
    glfwMakeContextCurrent(window);
    const GLubyte* const name_of_renderer = glGetString(GL_RENDERER); // none: the driver is at fault
    const std::string renderer = name_of_renderer ? reinterpret_cast<const char*>(name_of_renderer) : "";
    glfwDestroyWindow(window);
    for (const char* const name : {"llvmpipe", "softpipe", "swrast", "Software", "SwiftShader"})
      if (renderer.find(name) != std::string::npos)
        return true;
    return false;
  }

  [[noreturn]] static void refuse(const std::string& what) {
    throw No_window("no window can be made: " + what + (glfw_says().empty() ? "" : " (" + glfw_says() + ')') +
                    ". It needs a display (DISPLAY; Xvfb serves, too: xvfb-run sculpt_window ...) and OpenGL 3.3 "
                    "(libgl1-mesa-dri)");
  }

  void set_callbacks() const {
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
      if (application_of(w).is_playing())
        return; // the script's hand is the one that counts
      if (!ImGui::GetIO().WantCaptureMouse || glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
        application_of(w).on_move(x * scale(w), y * scale(w));
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
      if (application_of(w).is_playing())
        return;
      if (action == GLFW_RELEASE)
        application_of(w).on_release(button);
      else if (!ImGui::GetIO().WantCaptureMouse && button <= GLFW_MOUSE_BUTTON_MIDDLE)
        application_of(w).on_press(button, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0,
                                   (mods & GLFW_MOD_ALT) != 0);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double notches) {
      if (application_of(w).is_playing())
        return;
      const auto is_down = [w](int left, int right) {
        return glfwGetKey(w, left) == GLFW_PRESS || glfwGetKey(w, right) == GLFW_PRESS;
      };
      if (!ImGui::GetIO().WantCaptureMouse)
        application_of(w).on_scroll(notches, is_down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
                                    is_down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT));
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int code, int, int action, int mods) {
      if (action == GLFW_RELEASE || (ImGui::GetIO().WantTextInput && code != GLFW_KEY_ESCAPE))
        return;
      const auto key = key_pressed(code, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0);
      if (key && (action == GLFW_PRESS || goes_on(key->order)))
        application_of(w).on_key(*key);
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
      application_of(w).on_drop({paths, paths + count});
    });
    glfwSetFramebufferSizeCallback(
        window_, [](GLFWwindow* w, int width, int height) { application_of(w).on_resize(width, height); });
  }

  /// Pixels of the picture for one of the mouse's units.
  static double scale(GLFWwindow* window) {
    int width = 1, pixels = 1, height = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &pixels, &height);
    return double(pixels) / std::max(1, width);
  }
};

/// ns
std::uint64_t time_of(clockid_t clock) {
  timespec time;
  clock_gettime(clock, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1000000000u + static_cast<std::uint64_t>(time.tv_nsec);
}

int run(const Options& options) {
  examples::end_at_once_by_signals();
  std::vector<Action> script;
  if (!options.script.empty())
    script = read_actions(examples::contents_of<Action_error>(options.script, "the script"), options.script);
  check_files(options);
  Window window(options);
  if (options.makes_ball)
    write_ball(options.mesh);
  Application application(options, std::move(script)); // destroyed first: it has parts in the window's context
  window.serve(application);
  const auto [width, height] = window.size();
  application.open_first(width, height);
  const std::atomic<bool>& is_ended = examples::end_in_order_by_signals(); // from here on: reading may take its time
  using Clock = std::chrono::steady_clock;
  const auto frame_time = std::chrono::microseconds(16667);
  for (auto due = Clock::now(); !application.is_done(); due = std::max(due + frame_time, Clock::now())) {
    glfwPollEvents();
    if (window.was_closed())
      application.on_close();
    if (is_ended)
      application.end();
    application.step();
    if (application.needs_frame()) {
      const auto begin = Clock::now();
      const std::uint64_t thread = time_of(CLOCK_THREAD_CPUTIME_ID), process = time_of(CLOCK_PROCESS_CPUTIME_ID);
      window.draw(application);
      if (const std::string path = application.take_screenshot(); !path.empty()) {
        try {
          const std::string lost = window.write_screenshot(path);
          application.say("written " + path + (lost.empty() ? "" : ": " + lost));
        } catch (const std::exception&) {
          application.fail_to_write(examples::message_of(std::current_exception()));
        }
        window.show();
      } else { // a screenshot's frame is not one that a hand waits for
        window.show();
        application.frame_done({static_cast<std::uint64_t>(
                                    std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin).count()),
                                time_of(CLOCK_THREAD_CPUTIME_ID) - thread,
                                time_of(CLOCK_PROCESS_CPUTIME_ID) - process});
      }
    }
    std::this_thread::sleep_until(due + frame_time);
  }
  return application.finish();
}

int exit_code_of(const std::exception& error) {
  if (examples::is_a<No_window>(error) || examples::is_a<drawing::Picture_error>(error)) // of the first mesh
    return no_window;
  if (examples::is_a<Action_error>(error))
    return examples::script_error;
  return examples::exit_code_of(error);
}

} // namespace

int main(int argc, char** argv) {
  return examples::run_mesh_program(
      "sculpt_window",
      [&] {
        Options options;
        if (const auto is_good = read_options(argc, argv, options))
          return *is_good ? int(examples::done) : int(examples::usage);
        return run(options);
      },
      exit_code_of);
}
