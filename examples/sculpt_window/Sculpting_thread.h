// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "exchange.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace haptic_sculpt::window_program {

class Save;

/// A copy of the mesh, to be written by any thread.
using Saved_copy = std::shared_ptr<const Save>;

/// What came of what was asked for, where there is something to tell.
struct Report {
  enum class Kind : std::uint8_t { refused, beside, left, copied };
  Kind kind = Kind::refused; ///< beside: the button, still down, was pressed beside the mesh
  std::string text;
  Model* model = nullptr;
  Saved_copy copy;         ///< none where it failed: the text says why
  bool outgrown = false;   ///< copied: the mesh has grown beyond the room that was made for it
  std::uint64_t edits = 0; ///< copied: Status::edits of that moment
};

/// Of a model that comes to nobody: its log stays.
struct Destroy_with_log {
  void operator()(Model* model) const;
};

/// The window's side of the haptic loop, which is a thread of its own, a thousand ticks a second, and the only one that
/// touches the mesh it was given: the mouse, what is asked of the loop through its Command_queue, and what comes back.
/// Waits for nothing but the end.
class Sculpting_thread {
public:
  Sculpting_thread();
  ~Sculpting_thread();
  Sculpting_thread(const Sculpting_thread&) = delete;
  Sculpting_thread& operator=(const Sculpting_thread&) = delete;

  /// \name Asking; all but `copy()` let go of what is in hand
  ///@{
  /// The loop begins with the first. The model is the loop's until it comes back as Report::Kind::left.
  void enter(std::unique_ptr<Model, Destroy_with_log> model);
  void press(const Pointer& pointer, Tool tool, const Brush& brush);
  void let_go();
  void break_off();                                   ///< lets go, and ends remeshing where it is
  void edit_edge(const Pointer& pointer, bool flips); ///< else collapses
  void take_back(bool undo);                          ///< else makes again
  void choose_response(bool slides);                  ///< else what is blocked stops
  void remesh(const Pointer& pointer, const std::optional<Brush>& brush, double length);
  void unmask_all();
  void copy();
  ///@}

  /// Whether a press that begins neither has not been answered yet.
  bool is_press_waiting() const;
  /// Where the mouse is, and by how much a probe is pressed in.
  void point(const Pointer& pointer, double depth);
  /// \name Of a brush or an object in hand
  ///@{
  bool has_stroke() const;
  bool is_stroke_waiting() const;     ///< what was asked for last, the press at first, has not been done yet
  void go_on(const Pointer& pointer); ///< \pre has_stroke() and not is_stroke_waiting()
  ///@}

  const Status& status();
  const Pointed& pointed() const; ///< what the mouse has pointed at last, as far as it is known
  bool is_pick_waiting() const;   ///< it is not known what it points at now
  bool take(Seen_face& change);
  bool take(Report& report);
  /// Whether all that was asked for is done and in status(); a stroke is done when it waits for nothing.
  bool has_done_all() const;
  /// The same, and the mouse is where status() has it.
  bool is_idle() const;
  /// Ends the loop: status() is of its last tick from here on. \return all models that have not come back, the one that
  /// was asked for last at the end
  std::vector<Model*> end();

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A model that another thread has opened, and what the window needs of it.
struct Opened {
  std::unique_ptr<Model, Destroy_with_log> model; ///< to be entered, or destroyed
  std::string path, log;
  std::size_t resumed = 0;      ///< edits of the log that were made again
  std::string note;             ///< for people: what of the log was not
  std::vector<Seen_face> faces; ///< all, by index
  Place middle{};               ///< of its box as it came: where planes of symmetry are
};

/// Takes its time. \param log the path of an edit log that is replayed if it exists; empty: none
/// \throw what reading meshes and logs throws
Opened open(const std::string& path, const std::string& log);
/// Ticks that changed it.
std::uint64_t number_of_edits(const Model& model);
/// Ends the log of a model, too. \param keeps_log false: a log that only windows have written is removed
/// \return why the log does not hold all; empty if it does
std::string destroy(Model* model, bool keeps_log);

/// Writes by the rules of `sculpt -o`. \return for people: what could not be kept \throw Write_error
std::string write_copy(const Save& saved, const std::string& path);

} // namespace haptic_sculpt::window_program
