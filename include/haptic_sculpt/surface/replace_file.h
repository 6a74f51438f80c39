// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_REPLACE_FILE_H
#define HAPTIC_SCULPT_SURFACE_REPLACE_FILE_H

#include <haptic_sculpt/surface/Invalid_surface.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace haptic_sculpt {

/// Puts a file of these bytes at `path`, whole or not at all (POSIX).
///
/// The bytes go to a temporary file in the same folder, are forced to the disk, and the temporary file is renamed. On
/// any failure it is removed and what stood at `path` stays as it was. A file replaced passes on its permissions; a
/// symbolic link stays, and what it leads to is replaced. \throw Write_error
inline void replace_file(const std::filesystem::path& path, std::string_view bytes) {
  namespace fs = std::filesystem;
  const auto fail = [&](const std::string& why, int number = 0) {
    throw Write_error("cannot write '" + path.string() + "': " + why +
                      (number != 0 ? " (" + std::generic_category().message(number) + ")" : std::string()));
  };
  std::error_code error;
  fs::path target = path;
  if (fs::is_symlink(fs::symlink_status(path, error)))
    target = fs::weakly_canonical(path, error);
  const fs::file_status old = fs::status(target, error);
  if (fs::is_directory(old))
    fail("this is a directory; name a file in it");
  if (fs::exists(old) && !fs::is_regular_file(old))
    fail("this is not a regular file, so it cannot be replaced");
  if (fs::exists(old) && ::access(target.c_str(), W_OK) != 0)
    fail("the file may not be written", errno);

  // O_EXCL: nobody else's file is touched, whatever its name.
  fs::path temporary;
  int file = -1;
  for (int attempt = 0; file < 0 && attempt < 1000; ++attempt) {
    temporary = target;
    temporary += ".new" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
    file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && errno != EEXIST)
      break;
  }
  if (file < 0)
    fail("no file can be made in its folder", errno);

  const auto give_up = [&](const char* why) {
    const int number = errno;
    if (file >= 0)
      ::close(file);
    ::unlink(temporary.c_str());
    fail(why, number);
  };
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t written = ::write(file, rest.data(), rest.size());
    if (written < 0 && errno != EINTR)
      give_up("the data do not go to the disk");
    if (written > 0)
      rest.remove_prefix(static_cast<std::size_t>(written));
  }
  if (fs::exists(old) && ::fchmod(file, static_cast<mode_t>(old.permissions()) & 07777) != 0)
    give_up("the permissions of the old file cannot be kept");
  if (::fsync(file) != 0)
    give_up("the data do not reach the disk");
  const int closed = ::close(file);
  file = -1;
  if (closed != 0)
    give_up("the data do not reach the disk");
  if (std::rename(temporary.c_str(), target.c_str()) != 0)
    give_up("the new file cannot take the place of the old");
  // The name, too, has to survive a power failure; where a folder cannot be synchronised the file is whole all the
  // same.
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory >= 0) {
    ::fsync(directory);
    ::close(directory);
  }
}

} // namespace haptic_sculpt

#endif
