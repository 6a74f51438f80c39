// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_SCULPTING_THREAD_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_SCULPTING_THREAD_H

#include "exchange.h"

#include <memory>
#include <string>
#include <vector>

namespace haptic_sculpt::window_program {

/// The haptic loop: a thread of its own, a thousand ticks a second, the only one that touches the mesh it was given.
///
/// It never waits for the window: requests come through a bounded queue and are done at the begin of a tick; changed
/// faces go back through a bounded ring, and what finds no room there stays dirty and is told later, as it is then; of
/// the Status the newest counts. All functions but `run()` are the window's thread's.
class Sculpting_thread {
public:
  Sculpting_thread();
  /// Ends the thread, and waits until the log is written.
  ~Sculpting_thread();
  Sculpting_thread(const Sculpting_thread&) = delete;
  Sculpting_thread& operator=(const Sculpting_thread&) = delete;

  /// A copy is asked for once the one before has come. \return the number of the request; 0 if the queue is full: then
  /// ask later
  std::uint64_t ask(Request request);
  const Status& status();
  bool take(Face_change& change);
  bool take(Report& report);

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A model that another thread has opened, and what the window needs of it.
struct Opened {
  Model* model = nullptr; ///< to be entered, or destroyed
  std::string path, log;
  std::size_t resumed = 0;        ///< lines of the log that were made again
  std::vector<Face_change> faces; ///< all, by index
};

/// Takes its time. \param log the path of an edit log that is replayed if it exists; empty: none
/// \throw what reading meshes and logs throws
Opened open(const std::string& path, const std::string& log);
/// Ends the log of a model, too. \param keeps_log false: the log is removed
void destroy(Model* model, bool keeps_log);

/// Writes a Report's copy and destroys it. \return what of an old file could not be kept \throw Write_error
std::string write_and_destroy(Scene_copy* copy, const std::string& path);

} // namespace haptic_sculpt::window_program

#endif
