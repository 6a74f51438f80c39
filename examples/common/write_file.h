// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/write_surface.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

/// \file
/// Files of programs, which may run for root or for somebody who shares a folder with others.

namespace haptic_sculpt::examples {

/// keep_permissions(), and gives the new file the owner and the group of the old one, as far as this process may. No
/// group comes by rights that it did not have. \return what was not kept, empty if all was \throw std::system_error
inline std::string keep_owner_and_permissions(int new_file, const struct stat& old) {
  struct stat made {};
  if (::fstat(new_file, &made) != 0)
    throw std::system_error(errno, std::generic_category());
  std::string note;
  if (made.st_uid != old.st_uid && ::fchown(new_file, old.st_uid, static_cast<gid_t>(-1)) != 0)
    note = "its owner (user " + std::to_string(old.st_uid) + ") could not be kept and is user " +
           std::to_string(made.st_uid);
  struct stat permitted = old;
  if (made.st_gid != old.st_gid && ::fchown(new_file, static_cast<uid_t>(-1), old.st_gid) != 0) {
    note += std::string(note.empty() ? "" : "; ") + "its group (" + std::to_string(old.st_gid) +
            ") could not be kept and is " + std::to_string(made.st_gid);
    permitted.st_mode &= ~((~old.st_mode & 07) << 3); // no more than everybody has
  }
  keep_permissions(new_file, permitted);
  return note;
}

/// why_not_replaceable(), and folders that have been removed, or in which only the owner of a file may replace it.
inline std::string why_not_writable(const std::filesystem::path& target) {
  if (std::string why = why_not_replaceable(target); !why.empty())
    return why;
  struct stat file {};
  struct stat folder {};
  const std::filesystem::path around = target.has_parent_path() ? target.parent_path() : ".";
  if (::stat(around.c_str(), &folder) != 0)
    return {};
  if (folder.st_nlink == 0)
    return "its folder has been removed"; // and is there for those only who are still in it
  if (::stat(target.c_str(), &file) == 0 && (folder.st_mode & S_ISVTX) != 0 && ::geteuid() != 0 &&
      ::geteuid() != file.st_uid && ::geteuid() != folder.st_uid)
    return "in this folder only its owner (user " + std::to_string(file.st_uid) + ") may replace the file";
  return {};
}

/// replace_file(), which keeps the owner. \return for people: what could not be kept \throw Write_error
inline std::string write_file(const std::filesystem::path& path, std::string_view bytes) {
  return replace_file(path, bytes, keep_owner_and_permissions);
}

/// write_surface(), which keeps the owner. \return for people: what could not be kept \throw Write_error
template <class Mesh>
std::string write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Write_parameters& parameters = {}) {
  return write_file(path, surface_bytes(mesh, path, parameters));
}

} // namespace haptic_sculpt::examples
