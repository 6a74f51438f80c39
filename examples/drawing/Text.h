// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Image.h"
#include <ft2build.h>
#include FT_FREETYPE_H

namespace haptic_sculpt::drawing {

/// Writes plain ASCII into an image by FreeType.
class Text {
public:
  /// \throw Picture_error where the font that was there when the program was built is gone
  explicit Text(int height) : height_(height) {
    if (FT_Init_FreeType(&library_) != 0)
      throw Picture_error("FreeType cannot be started; ask for a picture without legend and numbers.");
    if (FT_New_Face(library_, HAPTIC_SCULPT_FONT, 0, &face_) != 0 ||
        FT_Set_Pixel_Sizes(face_, 0, unsigned(height)) != 0) {
      FT_Done_FreeType(library_);
      throw Picture_error("The font " HAPTIC_SCULPT_FONT " cannot be read. Install fonts-dejavu-core.");
    }
  }
  ~Text() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;

  int height() const { return height_; }

  /// In pixels.
  int width(const std::string& text) const {
    int sum = 0;
    for (const char c : text)
      if (FT_Load_Char(face_, FT_ULong(static_cast<unsigned char>(c)), FT_LOAD_DEFAULT) == 0)
        sum += int(face_->glyph->advance.x >> 6);
    return sum;
  }

  /// \param left, base where the text begins, and the line its letters stand on
  void write(Image& image, int left, int base, const std::string& text, const Color& color) const {
    for (const char c : text) {
      if (FT_Load_Char(face_, FT_ULong(static_cast<unsigned char>(c)), FT_LOAD_RENDER) != 0)
        continue;
      const FT_GlyphSlot glyph = face_->glyph;
      const FT_Bitmap& bitmap = glyph->bitmap;
      for (int y = 0; y < int(bitmap.rows); ++y)
        for (int x = 0; x < int(bitmap.width); ++x)
          image.blend(left + glyph->bitmap_left + x, base - glyph->bitmap_top + y, color,
                      bitmap.buffer[y * bitmap.pitch + x] / 255.f);
      left += int(glyph->advance.x >> 6);
    }
  }

private:
  int height_;
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

} // namespace haptic_sculpt::drawing
