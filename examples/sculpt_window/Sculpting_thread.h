// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_SCULPTING_THREAD_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_SCULPTING_THREAD_H

#include "exchange.h"

#include <memory>
#include <string>
#include <vector>

namespace haptic_sculpt {
class Scene_copy;
}

namespace haptic_sculpt::window_program {

/// A copy of the mesh, to be written by any thread.
using Saved_copy = std::shared_ptr<const Scene_copy>;

/// What came of a request, where there is something to tell.
struct Report {
  enum class Kind : std::uint8_t { refused, left, copied };
  Kind kind = Kind::refused;
  std::string text;
  Model* model = nullptr;
  Saved_copy copy;
  std::uint64_t edits = 0; ///< copied: Status::edits of that moment
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

  /// The loop begins with the first model that is entered. \return false where the queue is full: then ask later
  bool ask(const Request& request);
  /// Where the mouse is, and by how much a probe is pressed in.
  void point(const Pointer& pointer, double depth);
  const Status& status();
  bool take(Face_change& change);
  bool take(Report& report);
  /// Whether all that was asked for is done and in status(); a brush in the hand makes dab after dab.
  bool is_idle() const;
  /// Ends the loop. \return all models that have not come back, the one that was asked for last at the end
  std::vector<Model*> end();

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A model that another thread has opened, and what the window needs of it.
struct Opened {
  Model* model = nullptr; ///< to be entered, or destroyed
  std::string path, log;
  std::size_t resumed = 0;        ///< edits of the log that were made again
  std::string note;               ///< for people: what of the log was not
  std::vector<Face_change> faces; ///< all, by index
};

/// Takes its time. \param log the path of an edit log that is replayed if it exists; empty: none
/// \throw what reading meshes and logs throws
Opened open(const std::string& path, const std::string& log);
/// Ends the log of a model, too. \param keeps_log false: the log is removed
/// \return why the log does not hold all; empty if it does
std::string destroy(Model* model, bool keeps_log);

/// Writes by the rules of `sculpt -o`. \return what of an old file could not be kept \throw Write_error
std::string write_copy(const Scene_copy& copy, const std::string& path);

} // namespace haptic_sculpt::window_program

#endif
