// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Write_error.h>
#include <haptic_sculpt/surface/io/Temporary_file.h>
#include <haptic_sculpt/surface/io/quoted.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace haptic_sculpt {

// Cold: what waits for disks is compiled small, which is fast.

namespace internal {

inline std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

} // namespace internal

/// Where a file that is written at `path` comes to lie: the end of the chain of symbolic links that begins there,
/// whether or not something is there yet. \throw Write_error if the links lead in a circle
[[gnu::cold]] inline std::filesystem::path follow_links(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  constexpr int most = 40; // as many as Linux follows
  fs::path at = path;
  std::error_code error;
  for (int link = 0; fs::is_symlink(fs::symlink_status(at, error)); ++link) {
    if (fs::is_other(fs::status(at, error))) // a device or a pipe: links such as /dev/stdout do not say where they lead
      return at;
    const fs::path next = fs::read_symlink(at, error);
    if (error || link == most)
      throw Write_error("cannot write " + internal::quoted_path(path) + ": " +
                        (error ? "the symbolic link cannot be read (" + error.message() + ")"
                               : "its symbolic links lead in a circle, or are more than " + std::to_string(most)));
    at = at.parent_path() / next; // an absolute path takes the place of both
  }
  return at;
}

/// The default of `replace_file()`: gives the new file the permissions of the old one, but not setuid and setgid: the
/// contents are others now. Owner and group are those of the process. \throw std::system_error
inline std::string keep_permissions(int new_file, const struct stat& old) {
  if (::fchmod(new_file, old.st_mode & 0777) != 0)
    throw std::system_error(errno, std::generic_category());
  return {};
}

/// Why no file can be put at a place that `follow_links()` gave, as far as that can be known without writing; empty if
/// one can.
[[gnu::cold]] inline std::string why_not_replaceable(const std::filesystem::path& target) {
  namespace fs = std::filesystem;
  const auto system_says = [] { return " (" + std::generic_category().message(errno) + ")"; };
  if (target.filename().empty())
    return "this does not name a file";
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (error == std::errc::filename_too_long)
    return "its name is too long";
  if (fs::is_directory(status))
    return "this is a directory; name a file in it";
  if (fs::exists(status) && !fs::is_regular_file(status))
    return "this is not a regular file, so it cannot be replaced";
  if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0)
    return "the file may not be written" + system_says();
  const fs::path folder = internal::folder_of(target);
  const fs::file_status folder_status = fs::status(folder, error);
  if (fs::exists(folder_status) && !fs::is_directory(folder_status))
    return internal::quoted_path(folder) + " is not a folder";
  return ::access(folder.c_str(), W_OK | X_OK) == 0 ? "" : "no file can be made in its folder" + system_says();
}

/// Puts a file of these bytes at `path`, whole or not at all (POSIX).
///
/// The bytes go to a temporary file in the same folder, are forced to the disk, and the temporary file is renamed. On
/// any failure it is removed and what stood at `path` stays as it was. Other hard links keep the old contents. A
/// symbolic link stays, and what it leads to is replaced or, where nothing is there yet, made. Temporary files that
/// killed processes have left in that folder are removed; those of living ones are locked, and stay.
///
/// \param keep_rights gives the new file what it is to have of the old one, where there is one: it takes the
/// descriptor of the new file and the status of the old one, returns for people what could not be kept, and may throw
/// std::system_error. Before that only the owner may read the new file
/// \return for people: what of the old file could not be kept; empty if all was
/// \throw Write_error
[[gnu::cold]] inline std::string replace_file(const std::filesystem::path& path, std::string_view bytes,
                                std::string (*keep_rights)(int, const struct stat&) = keep_permissions) {
  const auto fail = [&](const std::string& why) {
    throw Write_error("cannot write " + internal::quoted_path(path) + ": " + why);
  };
  const auto system_says = [] { return " (" + std::generic_category().message(errno) + ")"; };
  const std::filesystem::path target = follow_links(path);
  if (const std::string why = why_not_replaceable(target); !why.empty())
    fail(why);
  struct stat old {};
  const bool is_there = ::stat(target.c_str(), &old) == 0;

  const std::filesystem::path folder = internal::folder_of(target);
  internal::Temporary_file::remove_left(folder);
  // Until the rights of an old one are kept nobody else may read what he could not read there.
  internal::Temporary_file temporary(target, is_there ? 0600 : 0666);
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
  try {
    if (is_there)
      note = keep_rights(temporary.descriptor(), old);
  } catch (const std::system_error& error) {
    fail("the permissions of the old file cannot be kept (" + error.code().message() + ")");
  }
  if (!note.empty())
    note = internal::quoted_path(path) + ": " + note;
  if (::fsync(temporary.descriptor()) != 0)
    fail("the data do not reach the disk" + system_says());
  if (!temporary.rename_to(target))
    fail("the new file cannot take the place of the old" + system_says());
  // From here on nothing asks for memory: what is thrown would say that the old file is still there.
  // The name, too, has to survive a power failure; where a folder cannot be synchronised the file is whole all the
  // same.
  const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory >= 0) {
    ::fsync(directory);
    ::close(directory);
  }
  return note;
}

} // namespace haptic_sculpt
