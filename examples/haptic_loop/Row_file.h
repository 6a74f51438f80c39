// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Write_error.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace haptic_sculpt::loop_program {

/// A file, device or pipe that rows go to as they come. What cannot be written is reported in the end: a run does not
/// end for a reader who has gone. One that is slow is waited for; once the run is to end, no longer than he takes
/// nothing for two seconds. (GNU)
class Row_file {
public:
  Row_file() = default;
  Row_file(const Row_file&) = delete;
  Row_file& operator=(const Row_file&) = delete;
  ~Row_file() {
    if (file_ != nullptr)
      std::fclose(file_);
  }

  /// Waits until a pipe has a reader; a file stays as it is until begin(). \param path empty: none
  /// \param is_ended whether the run is to end, kept \throw Write_error
  void open(const std::string& path, const std::atomic<bool>& is_ended) {
    path_ = path, is_ended_ = &is_ended;
    if (path.empty())
      return;
    int why = 0; // errno
    for (;;) {   // a call that waits would go on waiting after a signal, or before one
      descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0666);
      why = descriptor_ < 0 ? errno : 0;
      if (why != ENXIO || is_socket(path) || is_ended)
        break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (descriptor_ >= 0) {
      cookie_io_functions_t functions{};
      functions.write = write, functions.close = close_descriptor;
      if ((file_ = ::fopencookie(this, "w", functions)) == nullptr) {
        ::close(descriptor_);
        throw std::bad_alloc();
      }
    }
    if (file_ == nullptr)
      throw Write_error("cannot write '" + path + "': " +
                        (why != ENXIO      ? std::strerror(why)
                         : is_socket(path) ? "it is a socket"
                                           : "nobody reads it"));
  }
  /// Takes out what a file held before.
  void begin() {
    if (file_ != nullptr && ::ftruncate(descriptor_, 0) != 0 && errno != EINVAL) // which says: no regular file
      failure_ = errno;
  }
  /// nullptr: there is none
  std::FILE* get() const { return file_; }

  /// \throw Write_error where not all rows have arrived
  void close() {
    if (file_ == nullptr)
      return;
    std::fclose(file_);
    file_ = nullptr;
    if (failure_ != 0)
      throw Write_error("cannot write all rows of '" + path_ + "': " +
                        (failure_ == EAGAIN  ? "its reader takes nothing"
                         : failure_ == EPIPE ? "its reader has gone"
                                             : std::strerror(failure_)));
  }

private:
  std::string path_;
  std::FILE* file_ = nullptr;
  int descriptor_ = -1, failure_ = 0; ///< errno of the first write that failed
  const std::atomic<bool>* is_ended_ = nullptr;

  static ssize_t write(void* self, const char* bytes, std::size_t size) {
    return static_cast<Row_file*>(self)->write(bytes, size);
  }
  /// Which nothing will ever open, while a pipe waits for its reader.
  static bool is_socket(const std::string& path) {
    std::error_code unknown;
    return std::filesystem::is_socket(path, unknown);
  }
  /// \return 0: an error
  ssize_t write(const char* bytes, std::size_t size) {
    constexpr int milliseconds = 100, most_waits = 20;
    int waits = 0; // for nothing, since the run is to end
    for (std::size_t done = 0; done < size && failure_ == 0;) {
      const ssize_t written = ::write(descriptor_, bytes + done, size - done);
      pollfd file{descriptor_, POLLOUT, 0};
      if (written >= 0)
        done += static_cast<std::size_t>(written), waits = 0;
      else if (errno == EAGAIN && (!*is_ended_ || ++waits <= most_waits))
        ::poll(&file, 1, milliseconds);
      else if (errno != EINTR)
        failure_ = errno;
    }
    return failure_ == 0 ? static_cast<ssize_t>(size) : 0;
  }
  static int close_descriptor(void* self) {
    Row_file& rows = *static_cast<Row_file*>(self);
    const int code = ::close(rows.descriptor_);
    if (code != 0 && rows.failure_ == 0)
      rows.failure_ = errno;
    return code;
  }
};

} // namespace haptic_sculpt::loop_program
