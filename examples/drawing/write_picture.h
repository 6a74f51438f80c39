// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Camera.h"
#include <filesystem>

namespace haptic_sculpt::drawing {

/// Draws `scene` and writes it as a PNG file, whole or not at all. Needs neither display nor graphics card.
///
/// The calling thread has no OpenGL context afterwards; its floating-point environment is as before.
/// \return for people: what of an old file could not be kept, such as its owner; empty if all was
/// \throw Picture_error for a scene or view that cannot be drawn, a machine or build that cannot draw, and a file that
/// cannot be written.
std::string write_picture(const Scene& scene, const std::filesystem::path& path, const View& view = {});

/// Several scenes side by side, seen by the same camera, so that lengths compare; the legend is that of the last.
/// \pre there is one at least
std::string write_pictures(const std::vector<Scene>& scenes, const std::filesystem::path& path, const View& view = {});

} // namespace haptic_sculpt::drawing
