// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <nlohmann/json.hpp>
#include <algorithm>
#include <istream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

/// \file
/// JSON that is not trusted, in files and by lines from a stream: nothing it says can take more than a bounded amount
/// of memory or of stack.

namespace haptic_sculpt {

/// A longer line is refused unread, in bytes. A request takes about one thousandth of this.
constexpr std::size_t longest_line = std::size_t(1) << 20;

/// Objects and arrays within each other, counted with the outermost; deeper is refused. A request needs three.
/// The library copies and prints values by recursion, so the depth is what bounds the stack.
constexpr int deepest_nesting = 32;

/// Values in a text, those within others counted too; more are refused. A request has some sixty. Taking a value down
/// needs memory (16 bytes an element) and has no way to say that there is none, so that a value must stay small.
constexpr int most_values = 1000;

/// Reads line after line into one buffer of fixed size.
class Line_reader {
public:
  explicit Line_reader(std::istream& in) : in_(in), buffer_(longest_line + 1) {} // the line and a terminating 0

  /// The next line, without its end, good until the next call; false at the end of the stream.
  bool next() {
    ++number_;
    in_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    std::size_t count = static_cast<std::size_t>(in_.gcount());
    too_long_ = in_.fail() && count > 0;
    if (too_long_ && !in_.bad()) {
      in_.clear();
      in_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    } else if (in_.fail())
      return false;
    else if (!in_.eof())
      --count; // the end of the line was counted
    line_ = std::string_view(buffer_.data(), count);
    return true;
  }
  const std::string_view& line() const { return line_; }
  std::size_t number() const { return number_; } ///< of the line, from 1
  /// The line has more bytes than `longest_line`: `line()` is its beginning, the rest has been skipped.
  bool is_too_long() const { return too_long_; }

private:
  std::istream& in_;
  std::vector<char> buffer_;
  std::string_view line_;
  std::size_t number_ = 0;
  bool too_long_ = false;
};

/// An answer that is not there, with the code that says why.
class No_answer : public Error {
public:
  No_answer(const char* code, const std::string& message) : Error(message), code_(code) {}
  const char* code() const { return code_; }

private:
  const char* code_;
};

/// The value that a text says, or a line.
/// \throw nlohmann::json::exception if it is no JSON; No_answer (`malformed_json` for a byte 0; `nested_too_deep`,
/// `too_many_values` before anything deeper or more is built); std::bad_alloc
inline nlohmann::json parse_bounded(std::string_view text) {
  using Event = nlohmann::json::parse_event_t;
  if (const std::size_t at = text.find('\0'); at != text.npos) { // the library takes it for the end
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const std::size_t begin = line == 0 ? 0 : text.rfind('\n', at) + 1;
    throw No_answer("malformed_json", "a byte 0 stands at " +
                                          (line == 0 ? "" : "line " + std::to_string(line + 1) + ", ") + "column " +
                                          std::to_string(at - begin + 1));
  }
  int values = 0;
  return nlohmann::json::parse(text.begin(), text.end(), [&](int depth, Event event, nlohmann::json&) {
    const bool opens = event == Event::object_start || event == Event::array_start;
    if (opens && depth >= deepest_nesting)
      throw No_answer("nested_too_deep",
                      "objects and arrays are nested more than " + std::to_string(deepest_nesting) + " deep");
    if ((opens || event == Event::value) && ++values > most_values)
      throw No_answer("too_many_values", "there are more than " + std::to_string(most_values) + " values");
    return true;
  });
}

} // namespace haptic_sculpt
