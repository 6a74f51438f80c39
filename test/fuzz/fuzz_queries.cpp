// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// What `sweep_queries` answers to a line is what the oracles say, for any finite doubles, degenerate features among
/// them; a line that asks nothing is refused with its number. The first byte says whether choices or a text follow.

#define main sweep_queries_main
#include "sweep_queries.cpp"
#undef main

#include <fuzz/Choices.h>
#include <fuzz/Damage.h>
#include <fuzz/Fuzz_target.h>
#include <fuzz/require.h>
#include <oracle/axis_oracle.h>
#include <oracle/sweep_oracle.h>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;
using fuzz::require;

std::size_t hits = 0, misses = 0, axis_hits = 0, axis_misses = 0, refused = 0, answered = 0;

std::string hexadecimal(double x) {
  char text[40];
  std::snprintf(text, sizeof text, " %a", x);
  return text;
}

/// Coordinates that often agree with those before, or lie beside them.
class Coordinates_of_query {
public:
  explicit Coordinates_of_query(fuzz::Choices& choices)
      : choices_(choices), unit_(std::ldexp(1.0, static_cast<int>(choices.integer<std::uint16_t>() % 2040) - 1070))
      , is_scaled_(choices.flag()) {}

  double next() {
    const std::size_t sort = choices_.below(8);
    double x = sort < 2 && count_ > 0 ? seen_[choices_.byte() % count_] : choices_.number();
    if (sort == 1)
      x = std::nextafter(x, choices_.flag() ? INFINITY : -INFINITY);
    else if (sort != 0 && is_scaled_)
      x *= unit_;
    if (!std::isfinite(x))
      x = 0;
    return seen_[count_++] = x;
  }

private:
  fuzz::Choices& choices_;
  const double unit_;
  const bool is_scaled_;
  std::array<double, 16> seen_{};
  std::size_t count_ = 0;
};

void ask_sweep(Sweep_kind kind, Coordinates_of_query& coordinates) {
  Sweep_coordinates x;
  std::string line = sweep_name(kind);
  for (double& c : x)
    line += hexadecimal(c = coordinates.next());
  const auto expected = first_time(kind, x);
  ++(expected ? hits : misses);
  const std::string right =
      expected ? "1 " + expected->get_num().get_str() + "/" + expected->get_den().get_str() : std::string("0");
  require(answer(line, 1, Traits()) == right, line.c_str());
}

void ask_axis_sweep(bool is_vertex_and_face, int axis, Coordinates_of_query& coordinates) {
  Axis_query query{is_vertex_and_face, axis, {}, {}};
  std::string line = std::string("AX ") + (is_vertex_and_face ? "VF " : "EE ") + std::to_string(axis);
  for (auto& p : query.start)
    for (double& c : p)
      line += hexadecimal(c = coordinates.next());
  for (double& c : query.end)
    line += hexadecimal(c = coordinates.next());
  const bool expected = axis_features_meet(query);
  ++(expected ? axis_hits : axis_misses);
  require(answer(line, 1, Traits()) == (expected ? "1" : "0"), line.c_str());
  const auto p = [&query](int i) { return Point_3(query.start[i][0], query.start[i][1], query.start[i][2]); };
  require(Axis_sweep_traits_3<Kernel>().degenerate_face_axis_sweep_3_object()(
              axis, p(1), p(2), p(3), {query.end[1], query.end[2], query.end[3]}) == axis_face_degenerates(query),
          line.c_str());
}

void ask_text(const std::string& line) {
  try {
    const std::string told = answer(line, 7, Traits());
    require(told == "0" || told == "1" || (told.rfind("1 ", 0) == 0 && told.find('/') != std::string::npos),
            "an answer is 0, 1, or 1 and a time");
    ++answered;
  } catch (const Malformed_line& error) {
    require(std::string(error.what()).rfind("line 7, column ", 0) == 0, "a refusal names the line");
    ++refused;
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  if (data[0] % 8 == 7) {
    ask_text(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    return 0;
  }
  fuzz::Choices choices(data + 1, size - 1);
  const std::size_t axis = choices.below(3), is_vertex_and_face = choices.below(2);
  Coordinates_of_query coordinates(choices);
  if (data[0] % 8 < 5)
    ask_sweep(sweep_kinds[axis], coordinates);
  else
    ask_axis_sweep(is_vertex_and_face != 0, static_cast<int>(axis), coordinates);
  return 0;
}

std::string fuzz_input(std::mt19937_64& random) {
  static const std::vector<std::string> lines = {"\7VF 0.25 0.25 1 0.25 0.25 -1 0 0 0 1 0 0 0 1 0",
                                                 "\7EE 0 0 1 0 0 -1 1 0 0 0 1 0 0x1p-3 -1 0",
                                                 "\7FV 0 0 1 0 0 -1 1 0 0 0 1 0 0.25 0.25 0.125",
                                                 "\7AX VF 2 0 0 1 0 0 0 1 0 0 0 1 0 -1 0 0 0",
                                                 "\7AX EE 0 0 0 1 0 0 0 1 0 0 0 1 0 -1 0 0 0"};
  if (random() % 16 == 0)
    return fuzz::Damage(random, lines)();
  std::string input(1, static_cast<char>(random() % 7));
  return input + fuzz::random_bytes(random, 120);
}

std::string fuzz_summary() {
  return "sweeps: " + std::to_string(hits) + " hits, " + std::to_string(misses) + " misses; axis sweeps: " +
         std::to_string(axis_hits) + " hits, " + std::to_string(axis_misses) + " misses; texts: " +
         std::to_string(answered) + " answered, " + std::to_string(refused) + " refused";
}
