// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What is said of files that are refused. In the namespace of the suite, for others have helpers of these names, too.

#include <haptic_sculpt/surface/read_surface.h>

#include <meshes/generated_meshes.h>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <string>

namespace bad_input {

using namespace haptic_sculpt;
using meshes::Mesh;

/// What the refusal says, which has to name the file; "" if the file is accepted.
template <class Refusal>
std::string refusal(const std::filesystem::path& path) {
  try {
    read_surface<Mesh>(path);
    return {};
  } catch (const Refusal& error) {
    BOOST_TEST(std::string(error.what()).find(path.filename().string()) != std::string::npos);
    return error.what();
  }
}

inline void check_unreadable(const std::filesystem::path& path, const std::string& words) {
  const std::string message = refusal<Read_error>(path);
  BOOST_TEST(message.find(words) != std::string::npos, "'" + message + "' lacks '" + words + "'");
}

inline Validity_report report_of(const std::filesystem::path& path) {
  try {
    read_surface<Mesh>(path);
  } catch (const Invalid_surface& error) {
    BOOST_TEST(std::string(error.what()).find(path.filename().string()) != std::string::npos);
    return error.report();
  }
  BOOST_ERROR("accepted");
  return {};
}

inline const std::string tetrahedron = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
inline const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
inline const std::string ply_head =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
inline const std::string ply_faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  BOOST_REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

} // namespace bad_input
