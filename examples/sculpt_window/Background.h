// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Sculpting_thread.h"

#include <future>
#include <optional>

namespace haptic_sculpt::window_program {

/// Files are read and written by threads of their own, while window and loop go on. One mesh is opened at a time.
class Background {
public:
  /// \pre not is_opening()
  void open(const std::string& path, const std::string& log);
  bool is_opening() const { return opening_.valid(); }
  /// What has been opened by now. \throw what open() throws
  std::optional<Opened> take_opened();

  struct Saved {
    std::string path;
    std::uint32_t scene = 0; ///< the number of the mesh that was written
    std::uint64_t edits = 0; ///< that it had then
    bool quits = false;      ///< what was asked for is to end then
    std::string lost;        ///< what of an old file could not be kept
    std::exception_ptr error;
  };
  /// Writes the copy to `saved.path`, after all that are being written: of two in one file the later one stays. The
  /// rest of `saved` comes back with it.
  void save(const Saved_copy& copy, Saved saved);
  bool is_saving() const { return !saving_.empty(); }
  /// What has been written by now, in order.
  std::optional<Saved> take_saved();

private:
  std::future<Opened> opening_;
  std::vector<std::shared_future<Saved>> saving_;
};

} // namespace haptic_sculpt::window_program
