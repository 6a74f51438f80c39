// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Action.h"
#include "Background.h"
#include "Options.h"
#include "Sculpture_view.h"
#include "keys.h"

#include "../common/output_targets.h"

#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>

#include <chrono>
#include <cstdio>
#include <deque>
#include <memory>

namespace haptic_sculpt::window_program {

/// What the hand has chosen, and what the window shows of it.
struct Choices {
  Tool tool = Tool::brush;
  Brush brush;
  double depth = 0;   ///< of the probe
  bool slides = true; ///< what is blocked; else it stops
  bool shows_help = false, shows_panels = true, shows_figures = false, shows_hints = true;
  /// What the window asks before it goes on.
  enum class Question { none, leave_unsaved, name_to_save, name_to_open } question = Question::none;
  std::array<char, 4096> name{}; ///< as long as a path may be
};

/// The window's thread: input, requests to the loop, what comes back, and what is drawn. Knows no window library: the
/// program hands it what happens.
class Application {
public:
  using Clock = std::chrono::steady_clock;

  Application(const Options& options, std::vector<Action> script);
  ~Application();

  /// Opens the first mesh and waits for it. \throw what opening meshes and logs throws
  void open_first(int width, int height);

  /// \name What happens. Pixels from the upper left corner.
  ///@{
  void on_move(double x, double y);
  void on_press(int button, bool shift, bool ctrl, bool alt); ///< 0: left, 1: right, 2: middle
  void on_release(int button);
  void on_scroll(double notches, bool ctrl, bool shift);
  void on_key(const Key& key);
  void on_drop(const std::vector<std::string>& paths); ///< \pre there is one
  void on_close();
  void on_resize(int width, int height);
  ///@}

  /// What the panel takes of the window's width, in pixels.
  static constexpr int panel_width = 250;

  /// Takes what has come from the loop and the files, goes on with the script. To be called before each frame.
  void step();
  /// Whether there may be something new to see.
  bool needs_frame();
  /// Draws the scene; panels.cpp draws the panels over it.
  void draw();
  void draw_panels();
  /// How long a frame took, in nanoseconds: of time, and of processors, this thread's and all threads'.
  struct Frame_time {
    std::uint64_t elapsed, thread, process;
  };
  void frame_done(const Frame_time& time);
  bool is_done() const { return is_done_; }
  /// Of the window: what is open, and whether it is saved.
  std::string title() const {
    return "sculpt_window " + path_ + (is_unsaved() ? " (not saved)" : "") +
           (status_.log_has_failed ? " (its log cannot be written)" : "");
  }
  /// Whether a script has actions left.
  bool is_playing() const { return next_action_ < script_.size(); }
  /// A picture is due: of what has just been drawn. \return where it goes; empty: none is due
  std::string take_screenshot() { return std::exchange(screenshot_, {}); }
  void say(const std::string& text);
  /// Leaves the mesh, tells what has been measured, writes the report. \return the exit code
  int finish();
  /// A file could not be written: the exit code says so.
  void fail_to_write(const std::string& what);
  /// Ends as soon as it can, without asking; a log keeps what is not saved.
  void end() {
    is_done_ = true;
    if (is_playing())
      unopened_.clear(); // a second `open` may have been to come
    thread_.break_off(); // what is yet to be saved is saved as it is then
  }

private:
  Options options_;
  Choices choices_;
  Sculpting_thread thread_;
  Sculpture_view view_;
  Background background_;
  Status status_; ///< as of the last step()

  /// Of a mesh until its model has come back: what has it beside the loop.
  struct Kept {
    std::string log;
    std::size_t resumed = 0;       ///< edits of the log that were made again
    std::uint64_t saved_edits = 0; ///< as of the last saving
    bool is_saved = false;         ///< at least once
    bool is_unsaved(std::uint64_t edits) const { return is_saved ? edits != saved_edits : edits > 0 || resumed > 0; }
  };

  std::string path_, log_;  ///< of the mesh that is shown
  std::deque<Kept> kept_;   ///< in the order in which they were entered; that of the mesh that is shown is the last one
  std::vector<examples::Named_file> opened_before_; ///< other meshes of this session, and their logs
  std::array<std::vector<examples::Named_file>, 3> written_; ///< in this session, by what they hold
  std::uint32_t scene_ = 0; ///< its number, from 1
  std::deque<Background::Saved> to_save_; ///< copies that were asked for and are not there yet
  std::vector<Model*> left_;

  std::array<int, 2> view_size_{};
  std::string to_open_;   ///< as soon as nothing is under way
  std::vector<examples::Named_file> opening_; ///< what is being opened, or is to be, and its log
  std::pair<std::string, std::uint64_t> next_open_; ///< asked for once while there was unsaved work: of how many edits
  std::vector<examples::Named_file> unopened_;      ///< by a script, what was refused for that, and not opened since
  bool opens_for_script_ = false;                   ///< what is being opened
  std::uint64_t edits_when_opening_ = 0;            ///< of the mesh that is shown till then
  bool is_log_new_ = false;                         ///< of what is being opened
  bool has_failed_to_open_ = false;

  Eigen::Vector2d mouse_ = Eigen::Vector2d::Zero();
  int button_ = -1; ///< that is down
  bool shifts_ = false, is_along_normal_ = false;
  bool turns_ = false; ///< the left button was pressed beside the mesh
  Eigen::Vector3d pivot_ = Eigen::Vector3d::Zero();

  std::deque<std::pair<Clock::time_point, std::string>> messages_;
  Tick_statistics frames_, frames_of_thread_, frames_of_process_;
  int frames_due_ = 3;
  Clock::time_point last_frame_{};
  bool is_done_ = false, has_failed_to_write_ = false;
  bool has_failed_to_draw_ = false; ///< the mesh that is shown: said once
  bool is_leaving_ = false; ///< as soon as nothing is under way, if all is saved by then; else that is asked
  bool discards_ = false;   ///< what is not saved of the mesh that is shown
  std::string screenshot_, last_refusal_;

  std::vector<Action> script_;
  std::size_t next_action_ = 0;
  std::optional<Clock::time_point> waits_until_;
  int settled_frames_ = 0;
  bool is_misplaced_ = false; ///< the last place to move to was refused: nothing is pressed elsewhere

  std::FILE* record_ = nullptr;
  std::string recorded_to_;
  Clock::time_point last_recorded_{};
  bool has_moved_ = false; ///< since the last frame, which is yet to be noted

  /// Whether status_ is of the mesh that is shown; else the loop has yet to enter it, and nothing was done to it.
  bool has_status() const { return status_.scene == scene_; }
  std::uint64_t edits() const { return has_status() ? status_.edits : 0; }
  bool is_unsaved() const { return !kept_.empty() && kept_.back().is_unsaved(edits()); }
  bool is_at_rest() const;
  Pointer pointer_here() const;
  void point();
  void enter(Opened opened);
  void take_reports();
  void take_answers();
  void refuse(const std::string& text);
  void leave(Model* model);
  void destroy_unseen(Opened opened);
  void leave_unseen();
  void save(const std::string& path, bool quits = false);
  void ask_for_copy(Background::Saved saved);
  /// What a file is to hold that is written while the window is open.
  enum class Written { mesh, picture, recording };
  bool may_write(const std::string& path, Written what);
  std::string free_name(const std::string& extension);
  void take_saved();
  void open(const std::string& path, bool for_script = false);
  void fail_to_open(const std::string& why, bool for_script);
  void quit();
  void leave_window();
  void obey(Order order);
  void choose(Tool tool);
  void choose(Brush_use use);
  void choose_symmetry(const std::array<bool, 3>& axes);
  void scale_tool(double factor);
  void strengthen(double more);
  void remesh(bool all, double length = 0);
  void frame();
  void look(const Eigen::Vector3d& direction);
  void play();
  bool is_settled() const;
  bool is_on_the_way() const;
  bool act(const Action& action);
  Eigen::Vector2d pixel_of(const Spot& spot) const;
  void print_status() const;
  void record(const std::string& path);
  void note_choices();
  void note(const char* format, ...);
  void note_move();
  void note_file(const char* what, const std::string& path); ///< as a comment where no script can name it
  void flush_record();
  void draw_state();
  void draw_brush();
  void draw_figures();
  void draw_hints();
  void draw_help();
  void draw_question();
};

} // namespace haptic_sculpt::window_program
