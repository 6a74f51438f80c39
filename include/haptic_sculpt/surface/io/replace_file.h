// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_REPLACE_FILE_H
#define HAPTIC_SCULPT_SURFACE_REPLACE_FILE_H

#include <haptic_sculpt/surface/Write_error.h>
#include <haptic_sculpt/surface/io/Temporary_file.h>
#include <haptic_sculpt/surface/io/follow_links.h>

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
namespace internal {

/// Gives a new file the owner, group and permissions of the old one, as far as this process may. Bits that lend the
/// owner's or the group's rights to whoever runs the file (setuid, setgid) are not passed on: the contents are others
/// now. Nor does a group come by rights that it did not have. \return what was not kept, empty if all was; errno tells
/// a failure
inline std::string pass_on_rights(int file, const struct stat& old, bool& failed) {
  struct stat made {};
  failed = ::fstat(file, &made) != 0;
  std::string note;
  if (made.st_uid != old.st_uid && ::fchown(file, old.st_uid, static_cast<gid_t>(-1)) != 0)
    note = "its owner (user " + std::to_string(old.st_uid) + ") could not be kept and is user " +
           std::to_string(made.st_uid);
  mode_t mode = old.st_mode & 0777;
  if (made.st_gid != old.st_gid && ::fchown(file, static_cast<uid_t>(-1), old.st_gid) != 0) {
    note += std::string(note.empty() ? "" : "; ") + "its group (" + std::to_string(old.st_gid) +
            ") could not be kept and is " + std::to_string(made.st_gid);
    mode &= ~((~mode & 07) << 3); // no more than everybody has
  }
  failed = failed || ::fchmod(file, mode) != 0;
  return note;
}

} // namespace internal

/// Why no file can be put at a place that `follow_links()` gave, as far as that can be known without writing; empty if
/// one can.
inline std::string why_not_replaceable(const std::filesystem::path& target) {
  namespace fs = std::filesystem;
  const auto system_says = [] { return " (" + std::generic_category().message(errno) + ")"; };
  if (target.filename().empty())
    return "this does not name a file";
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status))
    return "this is a directory; name a file in it";
  if (fs::exists(status) && !fs::is_regular_file(status))
    return "this is not a regular file, so it cannot be replaced";
  if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0)
    return "the file may not be written" + system_says();
  const fs::path folder = internal::folder_of(target);
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return "no file can be made in its folder" + system_says();
  struct stat file {}, around {};
  if (::stat(target.c_str(), &file) == 0 && ::stat(folder.c_str(), &around) == 0 && (around.st_mode & S_ISVTX) != 0 &&
      ::geteuid() != 0 && ::geteuid() != file.st_uid && ::geteuid() != around.st_uid)
    return "in this folder only its owner (user " + std::to_string(file.st_uid) + ") may replace the file";
  return fs::is_directory(folder, error) ? "" : "'" + folder.string() + "' is not a folder";
}

/// Puts a file of these bytes at `path`, whole or not at all (POSIX).
///
/// The bytes go to a temporary file in the same folder, are forced to the disk, and the temporary file is renamed. On
/// any failure it is removed and what stood at `path` stays as it was. A file replaced passes on its permissions (not
/// setuid and setgid, nor access control lists) and, where this process may give it, its owner; other hard links keep
/// the old contents. A symbolic link stays, and what it leads to is replaced or, where nothing is there yet, made.
/// Temporary files that killed processes have left in that folder are removed; those of living ones are locked, and
/// stay.
///
/// \return for people: what of the old file could not be kept, such as its owner; empty if all was
/// \throw Write_error
inline std::string replace_file(const std::filesystem::path& path, std::string_view bytes) {
  const auto fail = [&](const std::string& why) { throw Write_error("cannot write '" + path.string() + "': " + why); };
  const auto system_says = [] { return " (" + std::generic_category().message(errno) + ")"; };
  const std::filesystem::path target = follow_links(path);
  if (const std::string why = why_not_replaceable(target); !why.empty())
    fail(why);
  struct stat old {};
  const bool is_there = ::stat(target.c_str(), &old) == 0;

  internal::Temporary_file::remove_left(internal::folder_of(target));
  internal::Temporary_file temporary(target);
  if (!temporary.is_open())
    fail("no file can be made in its folder" + system_says());
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t written = ::write(temporary.descriptor(), rest.data(), rest.size());
    if (written < 0 && errno != EINTR)
      fail("the data do not go to the disk" + system_says());
    if (written > 0)
      rest.remove_prefix(static_cast<std::size_t>(written));
  }
  std::string note;
  if (is_there) {
    bool failed = false;
    note = internal::pass_on_rights(temporary.descriptor(), old, failed);
    if (failed)
      fail("the permissions of the old file cannot be kept" + system_says());
  }
  if (::fsync(temporary.descriptor()) != 0)
    fail("the data do not reach the disk" + system_says());
  if (!temporary.rename_to(target))
    fail("the new file cannot take the place of the old" + system_says());
  // The name, too, has to survive a power failure; where a folder cannot be synchronised the file is whole all the
  // same.
  const int directory = ::open(internal::folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory >= 0) {
    ::fsync(directory);
    ::close(directory);
  }
  return note.empty() ? note : "'" + path.string() + "': " + note;
}

} // namespace haptic_sculpt

#endif
