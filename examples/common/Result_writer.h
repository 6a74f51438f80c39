// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "run_program.h"

#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace haptic_sculpt::examples {

/// Writes the results of a run, one after the other: what cannot be written is reported and does not keep the others
/// from being written, as the work is done. To write the report last gives it what there is to say of the others.
class Result_writer {
public:
  /// \param program whose name messages begin with
  explicit Result_writer(std::string program) : program_(std::move(program)) {}

  /// Tells it on standard error, and keeps it for the report.
  void note(const std::string& text) {
    std::cerr << program_ << ": " << text << '\n';
    notes_.push_back(text);
  }
  const std::vector<std::string>& notes() const { return notes_; }

  /// \param path empty: it was not asked for \param write(path) writes, and returns what of an old file could not be
  /// kept; what it throws is reported
  template <class Write>
  void write(const std::string& path, const Write& write) {
    if (path.empty())
      return;
    try {
      if (const std::string lost = write(path); !lost.empty())
        note(lost);
    } catch (const std::bad_alloc&) {
      exit_code_ = failed;
      fail("cannot write '" + path + "': the memory does not suffice");
    } catch (const std::exception& error) { // told, and by the exit code
      fail(error.what());
    }
  }
  bool all_written() const { return exit_code_ == done; }
  /// `failed` where the memory did not suffice, else cannot_write where something was not written.
  int exit_code() const { return exit_code_; }
  /// Something was not written, which has been told.
  void fail(const std::string& text) {
    if (all_written())
      exit_code_ = cannot_write;
    note(text);
  }

private:
  std::string program_;
  std::vector<std::string> notes_;
  Exit exit_code_ = done;
};

} // namespace haptic_sculpt::examples
