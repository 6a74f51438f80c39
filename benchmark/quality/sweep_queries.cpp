// SPDX-License-Identifier: GPL-3.0-or-later
// Answers sweep queries from a file, exactly: one line in, one line out, so that any other implementation can be
// checked.
#include "../../examples/common/printable.h"
#include "../../examples/common/run_program.h"

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/collision.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CLI/CLI.hpp>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

namespace {

using namespace haptic_sculpt;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Traits = Swept_collision_traits_3<Kernel>;
using examples::printable;

/// A longer line is refused, in bytes; sixteen coordinates in all their digits are a quarter of it.
constexpr std::size_t longest_line = 1 << 16;

struct Malformed_line : Error {
  Malformed_line(std::size_t line, std::size_t column, const std::string& what)
    : Error("line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + what) {}
};

/// Takes a line apart into words and remembers where each began.
class Line_reader {
public:
  Line_reader(const std::string& text, std::size_t line) : text_(text), line_(line) {}

  bool at_end() {
    position_ = text_.find_first_not_of(" \t\r", position_);
    return position_ == std::string::npos;
  }

  std::string word(const char* expected) {
    if (at_end())
      throw Malformed_line(line_, text_.size() + 1, std::string("the line ends where ") + expected + " is expected");
    begin_ = position_;
    position_ = std::min(text_.find_first_of(" \t\r", begin_), text_.size());
    return text_.substr(begin_, position_ - begin_);
  }

  /// \param all how many there are to be on the line
  double coordinate(int all) {
    const std::string number = word(("a coordinate (" + std::to_string(all) + " in all)").c_str());
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    if (end != number.c_str() + number.size())
      fail("'" + printable(number) + "' is not a number");
    if (!std::isfinite(value))
      fail("'" + printable(number) + "' is not finite; sweeps are defined for finite coordinates only");
    return value;
  }

  Point_3 point(int all) {
    const double x = coordinate(all), y = coordinate(all), z = coordinate(all);
    return {x, y, z};
  }

  void expect_end(int coordinates) {
    if (at_end())
      return;
    const std::string rest = word("");
    fail("'" + printable(rest) + "' follows the " + std::to_string(coordinates) + " coordinates");
  }

  [[noreturn]] void fail(const std::string& what) const { throw Malformed_line(line_, begin_ + 1, what); }

private:
  const std::string& text_;
  std::size_t line_, position_ = 0, begin_ = 0;
};

/// The rest of a line that asks about an axis move.
bool axis_answer(Line_reader& reader) {
  const std::string kind = reader.word("VF or EE");
  if (kind != "VF" && kind != "EE")
    reader.fail("'" + printable(kind) + "' is not VF or EE");
  const std::string axis = reader.word("the axis");
  if (axis != "0" && axis != "1" && axis != "2")
    reader.fail("'" + printable(axis) + "' is not an axis: 0, 1 or 2");
  std::array<Point_3, 4> p;
  for (Point_3& point : p)
    point = reader.point(16);
  std::array<double, 4> ends;
  for (double& end : ends)
    end = reader.coordinate(16);
  reader.expect_end(16);
  const Axis_sweep_traits_3<Kernel> traits;
  const int k = axis[0] - '0';
  return kind == "VF" ? traits.vertex_face_axis_sweep_3_object()(k, p[0], p[1], p[2], p[3], ends)
                      : traits.edge_edge_axis_sweep_3_object()(k, p[0], p[1], p[2], p[3], ends);
}

/// The next line, without its end. \return false at the end of the input \throw Malformed_line
bool next_line(std::istream& input, std::string& text, std::size_t line) {
  static std::array<char, longest_line + 1> buffer; // and a terminating 0
  input.getline(buffer.data(), buffer.size());
  const auto count = static_cast<std::size_t>(input.gcount());
  if (input.fail() && count == longest_line)
    throw Malformed_line(line, longest_line, "the line is longer than " + std::to_string(longest_line) + " bytes");
  text.assign(buffer.data(), input.good() ? count - 1 : count); // the line's end was counted
  return !input.fail();
}

/// What is printed for a line.
std::string answer(const std::string& text, std::size_t line, const Traits& traits) {
  Line_reader reader(text, line);
  const std::string kind = reader.word("VF, EE, FV or AX");
  if (kind == "AX")
    return axis_answer(reader) ? "1" : "0";
  if (kind != "VF" && kind != "EE" && kind != "FV")
    reader.fail("'" + printable(kind) + "' is not VF, EE, FV or AX");
  std::array<Point_3, 5> p;
  for (Point_3& point : p)
    point = reader.point(15);
  reader.expect_end(15);
  const auto impact = kind == "VF"   ? traits.vertex_face_sweep_3_object()(p[0], p[1], p[2], p[3], p[4])
                      : kind == "EE" ? traits.edge_edge_sweep_3_object()(p[0], p[1], p[2], p[3], p[4])
                                     : traits.face_vertex_sweep_3_object()(p[0], p[1], p[2], p[3], p[4]);
  if (!impact)
    return "0";
  const mpq_class time = impact->exact_time();
  return "1 " + time.get_num().get_str() + "/" + time.get_den().get_str();
}

int answer_queries(int argc, char** argv) {
  examples::end_at_once_by_signals();
  CLI::App app(
      "Answers exact sweep queries.\n"
      "Each line of FILE (doubles are decimal or C99 hexadecimal): VF, EE or FV and 15 doubles, the coordinates of\n"
      "  VF S T A B C   vertex from S to T against face ABC\n"
      "  EE S T V A B   edge from the moving vertex to V against edge AB\n"
      "  FV S T G I A   face from the moving vertex to GI against vertex A\n"
      "or AX VF K or AX EE K and 16 doubles: all move at once along axis K (0, 1 or 2), from four points, V A B C or "
      "the\n"
      "ends of two edges, to where they are along K at the end.\n"
      "Prints a line each: 0, or 1 and the first time u as num/den in lowest terms; of AX, 1 without a time.\n"
      "Empty lines and lines that begin with # are skipped. Exit: 0 done, 1 out of memory, 2 usage or a malformed "
      "line, 5 the answers "
      "cannot be written.");
  std::string path;
  app.add_option("FILE", path, "The queries; - is standard input")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? examples::done : examples::usage;
  }

  std::ifstream file;
  if (path != "-") {
    file.open(path);
    if (!file)
      throw Error("cannot open '" + path + "': " + std::strerror(errno));
  }
  std::istream& input = path == "-" ? std::cin : file;
  const Traits traits;
  std::string text;
  for (std::size_t line = 1; next_line(input, text, line) && std::cout; ++line) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos || text[first] == '#')
      continue;
    std::cout << answer(text, line, traits) << '\n';
  }
  if (path == "-" ? std::ferror(stdin) != 0 : input.bad()) // std::cin says nothing of what the system could not read
    throw Error("reading '" + path + "' failed");
  return examples::done;
}

} // namespace

int main(int argc, char** argv) {
  return examples::run_program(
      "sweep_queries", [&] { return answer_queries(argc, argv); },
      [](const std::exception& error) {
        return dynamic_cast<const Error*>(&error) != nullptr ? examples::usage : examples::failed;
      },
      [](const std::exception& error) {
        std::cout.flush();
        return std::string(error.what());
      });
}
