// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Write_error.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include <fcntl.h>

namespace haptic_sculpt::loop_program {

/// A file, device or pipe that rows go to as they come. What cannot be written is reported in the end: a run does not
/// end for a reader who has gone.
class Row_file {
public:
  Row_file() = default;
  Row_file(const Row_file&) = delete;
  Row_file& operator=(const Row_file&) = delete;
  ~Row_file() {
    if (file_ != nullptr)
      std::fclose(file_);
  }

  /// \param path empty: none \throw Write_error
  void open(const std::string& path) {
    path_ = path;
    if (!path.empty() && (file_ = std::fopen(path.c_str(), "wb")) == nullptr)
      throw Write_error("cannot write '" + path + "': " + std::strerror(errno));
  }
  /// nullptr: there is none
  std::FILE* get() const { return file_; }

  /// \throw Write_error where not all rows have arrived
  void close() {
    if (file_ == nullptr)
      return;
    errno = 0;
    const bool had_failed = std::ferror(file_) != 0;
    if (had_failed) // what is left must not wait for a reader who takes nothing
      ::fcntl(::fileno(file_), F_SETFL, ::fcntl(::fileno(file_), F_GETFL) | O_NONBLOCK);
    const bool fails = std::fclose(file_) != 0;
    file_ = nullptr;
    if (had_failed || fails)
      throw Write_error("cannot write all rows of '" + path_ + "': " +
                        (fails && errno != 0 ? std::strerror(errno) : "the disk is full, or its reader has gone"));
  }

private:
  std::string path_;
  std::FILE* file_ = nullptr;
};

} // namespace haptic_sculpt::loop_program
