// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <ostream>
#include <streambuf>
#include <string>

namespace haptic_sculpt::examples {

/// While it lives, what a stream writes is text: control characters (of ASCII but for line ends, and U+0080 to U+009F)
/// and what is no UTF-8 appear as \x1b. Names of files and words of scripts may hold them, and a terminal obeys them.
class Printable_stream : private std::streambuf {
public:
  explicit Printable_stream(std::ostream& stream) : stream_(&stream), below_(stream.rdbuf(this)) {}
  Printable_stream(const Printable_stream&) = delete;
  Printable_stream& operator=(const Printable_stream&) = delete;
  ~Printable_stream() override {
    const bool is_lost = sync() != 0;
    const auto state = stream_->rdstate(); // which rdbuf() clears
    stream_->rdbuf(below_);
    stream_->setstate(is_lost ? state | std::ios_base::badbit : state);
  }

private:
  std::ostream* stream_;
  std::streambuf* below_;
  std::string begun_;       ///< of a character of several bytes
  std::size_t missing_ = 0; ///< bytes of that

  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof()))
      return traits_type::not_eof(c);
    const auto byte = static_cast<unsigned char>(c);
    const bool continues = (byte & 0xc0) == 0x80;
    if (missing_ > 0 && continues) {
      begun_ += static_cast<char>(byte);
      if (--missing_ > 0)
        return c;
      const bool is_good = is_no_character() ? escape_begun() : put(begun_);
      begun_.clear();
      return is_good ? c : traits_type::eof();
    }
    bool is_good = escape_begun();
    if (byte >= 0xc2 && byte < 0xf5) {
      begun_ = static_cast<char>(byte);
      missing_ = byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : 3;
    } else if (byte == '\n' || byte == '\r' || byte == '\t' || (byte >= 0x20 && byte < 0x7f))
      is_good = is_good && put(std::string(1, static_cast<char>(byte)));
    else
      is_good = is_good && escape(byte);
    return is_good ? c : traits_type::eof();
  }

  /// Of a whole sequence: a control character U+0080 to U+009F, an overlong form, a surrogate, beyond U+10FFFF.
  bool is_no_character() const {
    const auto lead = static_cast<unsigned char>(begun_[0]), next = static_cast<unsigned char>(begun_[1]);
    return (lead == 0xc2 && next < 0xa0) || (lead == 0xe0 && next < 0xa0) || (lead == 0xed && next >= 0xa0) ||
           (lead == 0xf0 && next < 0x90) || (lead == 0xf4 && next >= 0x90);
  }

  int sync() override {
    const bool is_good = escape_begun();
    return below_->pubsync() == 0 && is_good ? 0 : -1;
  }

  bool put(const std::string& text) {
    const auto size = static_cast<std::streamsize>(text.size());
    return below_->sputn(text.data(), size) == size;
  }
  bool escape(unsigned char byte) {
    char text[5];
    std::snprintf(text, sizeof text, "\\x%02x", byte);
    return put(text);
  }
  /// What does not go on is no character.
  bool escape_begun() {
    bool is_good = true;
    for (const char c : begun_)
      is_good = is_good && escape(static_cast<unsigned char>(c));
    begun_.clear();
    missing_ = 0;
    return is_good;
  }
};

} // namespace haptic_sculpt::examples
