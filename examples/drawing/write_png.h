// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_DRAWING_WRITE_PNG_H
#define HAPTIC_SCULPT_DRAWING_WRITE_PNG_H

#include "Scene.h"
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <png.h>
#include <unistd.h>

namespace haptic_sculpt::drawing {

/// Writes `width` x `height` pixels of red, green, blue bytes, the lowest row first as OpenGL gives them.
///
/// The file appears whole or not at all: it is written beside its place and then renamed. A link is followed.
/// \throw Picture_error if it cannot be written, or if `path` is something other than a file, which is left as it is.
inline void write_png(const std::filesystem::path& path, int width, int height,
                      const std::vector<unsigned char>& pixels) {
  namespace fs = std::filesystem;
  const std::string cannot = "Cannot write the picture " + path.string() + ": ";
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
  if (target.filename().empty() || (fs::exists(target, error) && !fs::is_regular_file(target, error)))
    throw Picture_error(cannot + "it is not a file. Name a file, such as picture.png.");

  const fs::path partial = target.string() + ".partial-" + std::to_string(::getpid());
  std::FILE* file = std::fopen(partial.c_str(), "wb");
  if (!file)
    throw Picture_error(cannot + std::strerror(errno) + ". Name a file in a folder that exists and may be written to.");
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGB;
  const int lowest_row_first = -3 * width;
  const bool written = png_image_write_to_stdio(&image, file, 0, pixels.data(), lowest_row_first, nullptr);
  const bool closed = std::fclose(file) == 0;
  if (written && closed)
    fs::rename(partial, target, error);
  if (!written || !closed || error) {
    const std::string reason = error ? error.message() : closed ? image.message : std::strerror(errno);
    std::error_code ignored; // the failure to report is the first one
    fs::remove(partial, ignored);
    throw Picture_error(cannot + reason + ". Check the folder and the room left on the disk.");
  }
}

} // namespace haptic_sculpt::drawing

#endif
