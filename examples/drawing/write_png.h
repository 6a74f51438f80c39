// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"

#include "../common/write_file.h"

#include <filesystem>
#include <png.h>

namespace haptic_sculpt::drawing {

/// Writes `width` x `height` pixels of red, green, blue bytes, the lowest row first as OpenGL gives them, by
/// `write_file()`: the file appears whole or not at all, and a link is followed.
/// \return what of an old file could not be kept \throw Picture_error if it cannot be written
inline std::string write_png(const std::filesystem::path& path, int width, int height,
                             const std::vector<unsigned char>& pixels) {
  const std::string cannot = "Cannot write the picture " + path.string() + ": ";
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGB;
  const int lowest_row_first = -3 * width;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), lowest_row_first, nullptr))
    throw Picture_error(cannot + image.message);
  bytes.resize(size);
  try {
    return examples::write_file(path, bytes);
  } catch (const Write_error& error) {
    throw Picture_error(std::string("The picture: ") + error.what());
  }
}

} // namespace haptic_sculpt::drawing
