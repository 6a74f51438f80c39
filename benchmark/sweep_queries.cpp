// SPDX-License-Identifier: GPL-3.0-or-later
// Answers sweep queries from a file, exactly: one line in, one line out, so that any other implementation can be checked.
#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/collision.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iostream>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Traits = haptic_sculpt::Swept_collision_traits_3<Kernel>;

struct Malformed_line : haptic_sculpt::Error {
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

  double coordinate() {
    const std::string number = word("a coordinate (15 in all)");
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    if (end != number.c_str() + number.size())
      fail("'" + number + "' is not a number");
    if (!std::isfinite(value))
      fail("'" + number + "' is not finite; sweeps are defined for finite coordinates only");
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const { throw Malformed_line(line_, begin_ + 1, what); }

private:
  const std::string& text_;
  std::size_t line_, position_ = 0, begin_ = 0;
};

std::optional<haptic_sculpt::Impact_3<Kernel>> answer(const std::string& text, std::size_t line, const Traits& traits) {
  Line_reader reader(text, line);
  const std::string kind = reader.word("VF, EE or FV");
  if (kind != "VF" && kind != "EE" && kind != "FV")
    reader.fail("'" + kind + "' is not VF, EE or FV");
  std::array<Point_3, 5> p;
  for (Point_3& point : p) {
    const double x = reader.coordinate(), y = reader.coordinate(), z = reader.coordinate();
    point = Point_3(x, y, z);
  }
  if (!reader.at_end()) {
    const std::string rest = reader.word("");
    reader.fail("'" + rest + "' follows the 15 coordinates");
  }
  if (kind == "VF")
    return traits.vertex_face_sweep_3_object()(p[0], p[1], p[2], p[3], p[4]);
  if (kind == "EE")
    return traits.edge_edge_sweep_3_object()(p[0], p[1], p[2], p[3], p[4]);
  return traits.face_vertex_sweep_3_object()(p[0], p[1], p[2], p[3], p[4]);
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app("Answers exact sweep queries.\n"
               "Each line of FILE: VF, EE or FV and 15 doubles (decimal or C99 hexadecimal):\n"
               "  VF S T A B C   vertex from S to T against face ABC\n"
               "  EE S T V A B   edge from the moving vertex to V against edge AB\n"
               "  FV S T G I A   face from the moving vertex to GI against vertex A\n"
               "Prints a line each: 0, or 1 and the first time u as num/den in lowest terms.\n"
               "Empty lines and lines that begin with # are skipped. Exit: 0 done, 2 usage or a malformed line.");
  std::string path;
  app.add_option("FILE", path, "The queries; - is standard input")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  std::ifstream file;
  if (path != "-") {
    file.open(path);
    if (!file) {
      std::cerr << "sweep_queries: cannot open '" << path << "': " << std::strerror(errno) << '\n';
      return 2;
    }
  }
  std::istream& input = path == "-" ? std::cin : file;
  const Traits traits;
  std::string text;
  try {
    for (std::size_t line = 1; std::getline(input, text); ++line) {
      const std::size_t first = text.find_first_not_of(" \t\r");
      if (first == std::string::npos || text[first] == '#')
        continue;
      if (const auto impact = answer(text, line, traits)) {
        const mpq_class time = impact->exact_time();
        std::cout << "1 " << time.get_num() << '/' << time.get_den() << '\n';
      } else {
        std::cout << "0\n";
      }
    }
    if (input.bad())
      throw haptic_sculpt::Error("reading '" + path + "' failed");
  } catch (const haptic_sculpt::Error& error) {
    std::cout.flush();
    std::cerr << "sweep_queries: " << error.what() << '\n';
    return 2;
  }
  std::cout.flush();
  if (!std::cout) {
    std::cerr << "sweep_queries: cannot write the answers\n";
    return 2;
  }
  return 0;
}
