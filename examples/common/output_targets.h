// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "run_program.h"
#include "write_file.h"

#include <haptic_sculpt/surface/Mesh_file_format.h>
#include <haptic_sculpt/surface/Write_error.h>

#include <exception>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

/// \file
/// Looked at before the work begins: no file of a run is written over another one of it, and each can be written.

namespace haptic_sculpt::examples {

/// A file that a program was given, or makes by itself.
struct Named_file {
  std::string role; ///< how the command line calls it: "--report", "MESH"
  std::string path; ///< empty: it was not given
};

/// The role of the mesh that a program begins with.
constexpr const char* input_mesh = "MESH, the mesh to be read";

/// Whether two names lead to one file, there or not yet there; a folder may have two names by a mount.
inline bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (const bool are_one = std::filesystem::equivalent(a, b, error); !error) // one of them is there
    return are_one;
  // Made absolute first: weakly_canonical leaves the name of a file that is not there yet as it is, but not ./name.
  const auto full = [](const std::filesystem::path& path) {
    try {
      return std::filesystem::weakly_canonical(std::filesystem::absolute(follow_links(path)));
    } catch (const std::exception&) { // such as links in a circle, told by check_target(), or a current folder too deep
      return path.lexically_normal();
    }
  };
  const std::filesystem::path first = full(a), second = full(b);
  return first == second || (first.filename() == second.filename() &&
                             std::filesystem::equivalent(first.parent_path(), second.parent_path(), error));
}

/// The first of these files that this one is; none where it is empty, or another.
inline const Named_file* same_file(const std::string& path, const std::vector<Named_file>& files) {
  for (const Named_file& file : files)
    if (!path.empty() && !file.path.empty() && are_one_file(path, file.path))
      return &file;
  return nullptr;
}

/// Whether the file, which is of this type (`S_IFREG`, `S_IFIFO`), is that of a stream.
inline bool is_file_of_stream(const std::string& path, mode_t type, int stream) {
  struct stat file {
  }, there{};
  return !path.empty() && ::stat(path.c_str(), &file) == 0 && (file.st_mode & S_IFMT) == type &&
         ::fstat(stream, &there) == 0 && there.st_ino == file.st_ino && there.st_dev == file.st_dev;
}

/// The standard stream that comes from this regular file, or goes to it; nullptr: none. What the program says would be
/// written over it, or it over that: a stream keeps a place of its own in a file.
inline const char* standard_stream_at(const std::string& path) {
  for (const auto& [number, name] :
       {std::pair(STDIN_FILENO, "input"), std::pair(STDOUT_FILENO, "output"), std::pair(STDERR_FILENO, "error")})
    if (is_file_of_stream(path, S_IFREG, number))
      return name;
  return nullptr;
}

/// The files of a run.
struct Run_files {
  std::vector<Named_file> outputs, inputs;
  /// Output and input that may be one: that is what one asks of an editor. Empty: none may.
  std::string replaced_by, replaced;

  /// \throw Usage_error where an output is another output, an input, or the file of a standard stream; says which
  void check_apart() const {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const Named_file& output = outputs[i];
      const auto refuse = [&](const Named_file& other) {
        throw Usage_error("'" + output.path + "' (" + output.role + ") and '" + other.path + "' (" + other.role +
                          ") are one file; give " + output.role + " another name");
      };
      std::vector<Named_file> others(outputs.begin() + static_cast<std::ptrdiff_t>(i) + 1, outputs.end());
      for (const Named_file& input : inputs)
        if (!(output.role == replaced_by && input.role == replaced))
          others.push_back(input);
      if (const Named_file* const other = same_file(output.path, others))
        refuse(*other);
      if (const char* const stream = standard_stream_at(output.path); stream != nullptr)
        throw Usage_error("'" + output.path + "' (" + output.role + ") is the file of standard " + stream + "; give " +
                          output.role + " another name");
    }
  }
};

/// Finds out before hours of work whether a file can be put at `path`, as far as that can be known without writing; a
/// disk may still be full in the end. \throw Write_error
inline void check_target(const std::filesystem::path& path) {
  if (const std::string why = why_not_writable(follow_links(path)); !why.empty())
    throw Write_error("cannot write '" + path.string() + "': " + why);
}

/// \throw Usage_error unless the name says which format the mesh is to have; none where it is empty
inline void check_mesh_name(const Named_file& file) {
  if (!file.path.empty() && !mesh_file_format(file.path))
    throw Usage_error("'" + file.path + "' (" + file.role + ") does not end in .off, .ply, .obj or .stl");
}

/// Whether it ends in .png, or has no extension.
inline bool is_picture_name(const std::string& path) {
  const auto extension = std::filesystem::path(path).extension();
  return extension.empty() || extension == ".png" || extension == ".PNG";
}

/// \throw Usage_error unless it is a picture's name, or empty
inline void check_picture_name(const Named_file& file) {
  if (!is_picture_name(file.path))
    throw Usage_error("a picture is written as PNG: give " + file.role + " a name that ends in .png instead of '" +
                      file.path + "'");
}

} // namespace haptic_sculpt::examples
