// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled instead of the drawing code where the libraries it needs were not found.
#include "write_picture.h"

namespace haptic_sculpt::drawing {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path) {
  throw Picture_error("Cannot write the picture " + path.string() +
                      ": this program was built without pictures, " HAPTIC_SCULPT_MISSING
                      ". Install libepoxy-dev, libegl-dev, libgl1-mesa-dri, libpng-dev, libfreetype-dev and "
                      "fonts-dejavu-core, configure with -DHAPTIC_SCULPT_PICTURES=ON and build it anew, or ask for no "
                      "picture.");
}

} // namespace

std::string write_picture(const Scene&, const std::filesystem::path& path, const View&) {
  refuse(path);
}

std::string write_pictures(const std::vector<Scene>&, const std::filesystem::path& path, const View&) {
  refuse(path);
}

} // namespace haptic_sculpt::drawing
