// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/io/quoted.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace haptic_sculpt::internal {

/// The text behind a byte order mark of UTF-8, which some editors put before it.
inline std::string_view without_bom(std::string_view text) {
  return text.substr(text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0);
}

/// Takes text apart into lines and words, and words into numbers; says in which line something is wrong.
///
/// Numbers are read to the nearest double, in the C locale whatever the program has set, and have to fill their word.
class Text_scanner {
public:
  /// \param comment a character that begins a comment up to the end of the line, or 0
  /// \param lines_before how many lines of the file stand before the text
  explicit Text_scanner(std::string_view text, char comment = '#', std::size_t lines_before = 0)
      : rest_(text), comment_(comment), line_number_(lines_before) {}

  /// Goes to the next line that holds a word; false at the end.
  bool next_line() {
    while (!rest_.empty()) {
      ++line_number_;
      take_line(rest_.find('\n'));
      if (has_word())
        return true;
    }
    line_ = {};
    return false;
  }

  /// Whether the line holds another word.
  bool has_word() {
    const std::size_t begin = line_.find_first_not_of(blanks);
    line_ = begin == std::string_view::npos ? std::string_view() : line_.substr(begin);
    return !line_.empty();
  }

  /// The next word of the line. \throw Read_error if there is none
  std::string_view word(const char* expected) {
    if (!has_word())
      fail_at_end("line", expected);
    const std::size_t end = std::min(line_.find_first_of(blanks), line_.size());
    const std::string_view found = line_.substr(0, end);
    line_.remove_prefix(end);
    return found;
  }

  /// The next word, on a later line if need be. \throw Read_error at the end of the text
  std::string_view word_anywhere(const char* expected) {
    if (!has_word() && !next_line())
      fail_at_end("file", expected);
    return word(expected);
  }

  void skip_rest_of_line() { line_ = {}; }

  /// \throw Read_error if the line holds another word
  void expect_end_of_line(const char* after) {
    if (has_word())
      fail_at(word(""), " stands after ", after);
  }

  /// A number in decimal notation. "nan" and "inf" are numbers here, to be found and named later.
  template <class Number = double>
  Number to_number(std::string_view word, const char* expected) const {
    std::string_view digits = word;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
      digits.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool all = end == digits.data() + digits.size();
    if (all && error == std::errc())
      return value;
    if constexpr (std::is_floating_point_v<Number>)
      if (all && error == std::errc::result_out_of_range)
        if (const Number rounded = static_cast<Number>(nearest(digits)); rounded == 0)
          return rounded; // below the least subnormal
    fail_at(word, " is not ", expected, error == std::errc::result_out_of_range ? " (too large)" : "");
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Read_error("line " + std::to_string(line_number_) + ": " + message);
  }

  /// Says what is wrong with a word, which stands first and in quotation marks.
  [[noreturn]] void fail_at(std::string_view word, const char* problem, const char* with = "",
                            const char* more = "") const {
    fail(in_quotes(word) + problem + with + more);
  }

  /// What has not been taken yet.
  std::string_view rest() const { return rest_; }

private:
  [[noreturn]] void fail_at_end(const char* of, const char* expected) const {
    fail(std::string("the ") + of + " ends where " + expected + " should stand");
  }

  static constexpr const char* blanks = " \t\r\v\f";

  void take_line(std::size_t end) {
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (comment_ != 0)
      line_ = line_.substr(0, line_.find(comment_));
  }

  static double nearest(std::string_view digits) {
    std::istringstream stream{std::string(digits)};
    stream.imbue(std::locale::classic());
    double value = 1;
    stream >> value;
    return stream ? value : 1;
  }

  std::string_view rest_, line_;
  char comment_;
  std::size_t line_number_;
};

/// \throw Read_error if a file of `bytes` bytes cannot hold `count` items of at least `least` bytes each: nothing is
/// allocated on the word of a header alone.
inline void check_count(std::uint64_t count, std::size_t least, std::size_t bytes, const std::string& items) {
  if (count > (bytes + 1) / least)
    throw Read_error("the header promises " + std::to_string(count) + " " + items + ", but only " +
                     std::to_string(bytes) + " bytes follow: the file is cut short or its header is wrong");
  if (count >= UINT32_MAX / 3)
    throw Read_error("the header promises " + std::to_string(count) + " " + items + ", more than 32-bit indices hold");
}

} // namespace haptic_sculpt::internal
