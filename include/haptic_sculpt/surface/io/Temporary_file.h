// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace haptic_sculpt::internal {

/// A file beside the one it shall replace. It is removed with its object unless it has been renamed.
///
/// It is locked as long as it is open, and a lock dies with its process. So a file with such a name that nobody has
/// locked is left from a process that was killed. (The number of the process in the name would not tell: numbers are
/// given again, and other machines and containers have their own.)
class Temporary_file {
public:
  /// Makes it, empty. Where that fails, `is_open()` is false and errno says why. \param mode who may do what with it
  [[gnu::cold]] Temporary_file(const std::filesystem::path& target, mode_t mode) {
    for (int attempt = 0; file_ < 0 && attempt < 1000; ++attempt) {
      // The name of the target says what this is; cut, for names have a greatest length.
      path_ = target.parent_path() / ('.' + target.filename().string().substr(0, 200) + mark +
                                      std::to_string(::getpid()) + '-' + std::to_string(number()));
      // O_EXCL: nobody else's file is touched, whatever its name.
      file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      if (file_ < 0 && errno != EEXIST)
        return;
      if (file_ >= 0 && was_taken_for_left())
        close();
    }
  }
  Temporary_file(const Temporary_file&) = delete;
  Temporary_file& operator=(const Temporary_file&) = delete;
  ~Temporary_file() {
    if (file_ < 0)
      return;
    const int kept = errno; // of the failure that is being told
    ::unlink(path_.c_str());
    close();
    errno = kept;
  }

  bool is_open() const { return file_ >= 0; }
  int descriptor() const { return file_; }

  /// Puts it in the place of the target. False on failure; errno says why.
  bool rename_to(const std::filesystem::path& target) {
    if (std::rename(path_.c_str(), target.c_str()) != 0)
      return false;
    close();
    return true;
  }

  /// Removes what killed processes have left in a folder. What cannot be removed stays: it is in nobody's way. (POSIX:
  /// `std::filesystem::directory_iterator` ends the process where memory runs out, in libstdc++ 12.)
  [[gnu::cold]] static void remove_left(const std::filesystem::path& folder) {
    const std::unique_ptr<DIR, Folder_closer> opened(::opendir(folder.c_str()));
    if (opened == nullptr)
      return;
    const int directory = ::dirfd(opened.get());
    while (const dirent* const entry = ::readdir(opened.get())) {
      const char* const name = entry->d_name;
      if (!has_such_a_name(name))
        continue;
      const int file = ::openat(directory, name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
      struct stat status {}, named {};
      if (file >= 0 && ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
          ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::fstatat(directory, name, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
          named.st_dev == status.st_dev && named.st_ino == status.st_ino) // else another one has the name by now
        ::unlinkat(directory, name, 0);
      if (file >= 0)
        ::close(file);
    }
  }

private:
  struct Folder_closer {
    void operator()(DIR* folder) const { ::closedir(folder); }
  };

  /// A process gives no number twice: who has looked at an old file and removes its name never meets a new file. The
  /// first is the time, for in another container another process has the same number.
  static unsigned number() {
    static std::atomic<unsigned> next{
        static_cast<unsigned>(std::chrono::system_clock::now().time_since_epoch().count())};
    return next++;
  }

  static constexpr const char* mark = ".haptic_sculpt-new-";
  std::filesystem::path path_;
  int file_ = -1;

  void close() {
    ::close(file_);
    file_ = -1;
  }

  /// Locks it. True where another process was faster, between the making and the lock, and may have removed it.
  bool was_taken_for_left() const {
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      return true; // else this file system has no locks: nobody can take it for left
    struct stat status {};
    return ::fstat(file_, &status) == 0 && status.st_nlink == 0;
  }

  /// `.NAME.haptic_sculpt-new-PROCESS-NUMBER`
  static bool has_such_a_name(std::string_view name) {
    const std::size_t at = name.rfind(mark);
    if (name[0] != '.' || at == std::string_view::npos)
      return false;
    const std::string_view numbers = name.substr(at + std::char_traits<char>::length(mark));
    const std::size_t dash = numbers.find('-');
    return dash != std::string_view::npos && dash != 0 && dash + 1 < numbers.size() &&
           numbers.find_first_not_of("0123456789-") == std::string_view::npos &&
           numbers.find('-', dash + 1) == std::string_view::npos;
  }
};

} // namespace haptic_sculpt::internal
