// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Sha256.h"
#include "contents_of.h"

#include <haptic_sculpt/surface/read_surface.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace haptic_sculpt::examples {

/// A mesh's file, read once: what is sculpted, and the hash that a log knows it by, are of the same bytes, whatever
/// becomes of the file meanwhile.
class Mesh_file {
public:
  /// \throw Read_error when it cannot be read
  explicit Mesh_file(std::string path) : path_(std::move(path)) {
    try {
      check_regular_file(path_);
    } catch (const Read_error& error) {
      throw Read_error("cannot read '" + path_ + "': " + error.what());
    }
    bytes_ = contents_of<Read_error>(path_, "", std::numeric_limits<std::size_t>::max() >> 20);
  }

  const std::string& path() const { return path_; }
  /// The SHA-256 of its bytes.
  std::string hash() const { return Sha256().add(bytes_).digest(); }
  /// \throw Read_error, Out_of_range
  Face_soup soup() const { return read_face_soup(path_, bytes_); }

  /// \param left_out receives what the file has and a mesh has not
  /// \throw Read_error, Out_of_range, Invalid_surface
  template <class Mesh>
  Mesh surface(std::vector<std::string>* left_out = nullptr) const {
    Face_soup read = soup();
    if (left_out != nullptr)
      *left_out = std::move(read.left_out);
    return make_surface<Mesh>(read, 0, '\'' + path_ + '\'');
  }

private:
  std::string path_, bytes_;
};

} // namespace haptic_sculpt::examples
