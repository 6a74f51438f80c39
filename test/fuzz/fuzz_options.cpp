// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Whatever stands on the command lines of `sculpt` and `haptic_loop`: it is refused with a message, or read as it is
/// written: numbers to the last bit, as MPFR and GMP read them. The first byte says which program, lines are arguments.

#include "haptic_loop/Arguments.h"
#include "sculpt/Arguments.h"

#include <fuzz/Fuzz_target.h>
#include <fuzz/require.h>

#include <gmpxx.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace haptic_sculpt;
using fuzz::require;
using Words = std::vector<std::string>;

std::array<std::size_t, 2> accepted{}, refused{}, asked{};

/// What a program has read: by the names of options.
struct Read_options {
  std::vector<std::pair<const char*, std::vector<double>>> numbers;
  std::vector<std::pair<const char*, std::optional<std::size_t>>> whole;
  std::vector<std::pair<const char*, std::string>> texts;
  bool is_consistent = true; ///< what needs another option has it
};

template <class Number>
std::vector<Number> list(const std::optional<Number>& number) {
  return number ? std::vector<Number>{*number} : std::vector<Number>{};
}

Read_options read(const sculpt_program::Arguments& a) {
  const auto& [view, at, zoom, color, before, numbers] = a.shown;
  const auto nearest = a.nearest ? std::vector<double>(a.nearest->begin(), a.nearest->end()) : std::vector<double>{};
  Read_options options{{{"--clearance", list(a.clearance)},
                        {"--delta", list(a.delta)},
                        {"--picture-zoom", zoom == 0 ? std::vector<double>{} : std::vector<double>{zoom}},
                        {"--picture-view", view},
                        {"--nearest", nearest},
                        {"--repair-gap", list(a.repair.gap)}},
                       {{"--repair-largest-hole", a.repair.largest_hole}},
                       {{"--log", a.log}, {"--report", a.report}, {"--output", a.out}, {"--picture-at", at}}};
  const bool of_picture = zoom != 0 || !at.empty() || !color.empty() || before || numbers;
  const bool of_repair = a.repair.gap || a.repair.largest_hole || !a.repair.report.empty();
  options.is_consistent =
      (!of_picture || !a.picture.empty()) && (!of_repair || a.repair.is_asked) &&
      (view.empty() || !a.picture.empty() || !a.comparison.empty()) && (!a.append || !a.log.empty()) &&
      (a.comparison.empty() || (!a.script.empty() && a.log.empty())) && (zoom == 0 || (zoom >= 0.25 && zoom <= 1e5));
  return options;
}

Read_options read(const loop_program::Arguments& a) {
  const auto& s = a.settings;
  Read_options options{{{"--seconds", list(a.seconds)},
                        {"--rate", {s.rate}},
                        {"--delay", {s.delay}},
                        {"--stiffness", {s.stiffness}},
                        {"--damping", {s.damping}},
                        {"--virtual-mass", {s.virtual_mass}},
                        {"--controller", list(s.controller)},
                        {"--map", s.map},
                        {"--reach", {s.reach}},
                        {"--snap", {s.snap.length, s.snap.force}}},
                       {{"--work", s.work}},
                       {{"--log", a.log}, {"--trace", a.trace}, {"--device", a.device}, {"--replay", a.replay}}};
  for (const auto& [name, numbers] : options.numbers)
    options.is_consistent &= std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  options.is_consistent &= a.replay.empty() || (!a.seconds && !s.controller && s.map.empty() && a.device.empty());
  return options;
}

/// The nearest double, by MPFR: decimal or hexadecimal.
double own_number(const std::string& text) {
  mpfr_t x;
  mpfr_init2(x, 53);
  const auto emin = mpfr_get_emin(), emax = mpfr_get_emax();
  mpfr_set_emin(-1073), mpfr_set_emax(1024);
  char* end = nullptr;
  const bool is_hexadecimal = text.find_first_of("xX") != std::string::npos;
  const int rounded = mpfr_strtofr(x, text.c_str(), &end, is_hexadecimal ? 16 : 10, MPFR_RNDN);
  mpfr_subnormalize(x, rounded, MPFR_RNDN);
  const double value = mpfr_get_d(x, MPFR_RNDN);
  mpfr_clear(x);
  mpfr_set_emin(emin), mpfr_set_emax(emax);
  require(end == text.c_str() + text.size(), "an argument that is read as a number is one");
  return value;
}

bool is_same(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

/// What stands behind an option that is there once, as `--name VALUE ...` or `--name=VALUE ...`, down to the last word.
std::optional<Words> behind(const Words& words, const std::string& name) {
  std::optional<Words> found;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool has_value = words[i].rfind(name + '=', 0) == 0;
    if (words[i] != name && !has_value)
      continue;
    if (found)
      return std::nullopt;
    found.emplace(words.begin() + i + 1, words.end());
    if (has_value)
      found->insert(found->begin(), words[i].substr(name.size() + 1));
  }
  return found;
}

void compare(const Words& words, const Read_options& options) {
  require(options.is_consistent, "what needs another option is refused without it, and so is what is out of range");
  if (std::find(words.begin(), words.end(), "--") != words.end()) // names of options stand for files behind it
    return;
  for (const auto& [name, numbers] : options.numbers)
    if (const auto values = behind(words, name)) {
      require(!numbers.empty() && !values->empty(), "what is given is read");
      for (std::size_t k = 0; k < std::min(numbers.size(), values->size()); ++k) {
        if (k > 0 && std::strcmp(name, "--snap") == 0 && (*values)[k][0] == '-')
          break; // the force was left out
        if (numbers.size() > 1 && (*values)[k][0] == '[')
          break; // CLI11 takes [1,2] for two values
        require(is_same(numbers[k], own_number((*values)[k])), "a number is read to the last bit");
      }
    }
  for (const auto& [name, number] : options.whole)
    if (const auto values = behind(words, name))
      require(number && !values->empty() && mpz_class(values->at(0), 10) == mpz_class(std::to_string(*number), 10),
              "a whole number is read as it is, in decimal");
  for (const auto& [name, text] : options.texts)
    if (const auto values = behind(words, name))
      require(!values->empty() && text == values->at(0), "the name of a file is read as it is");
}

/// Gives the words to a program, and looks at what it says and at what it has read.
template <class Arguments, class Read_arguments>
void run(std::size_t which, const Words& words, const Read_arguments& read_arguments) {
  Words all = {"program"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : all)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::ostringstream out, messages;
  auto* const screen = std::cout.rdbuf(out.rdbuf());
  auto* const errors = std::cerr.rdbuf(messages.rdbuf());
  Arguments arguments;
  std::optional<bool> ends;
  try {
    ends = read_arguments(int(all.size()), pointers.data(), arguments);
  } catch (const examples::Usage_error& error) {
    messages << error.what() << '\n';
    ends = false;
  }
  std::cout.rdbuf(screen), std::cerr.rdbuf(errors);
  if (!ends) {
    require(messages.str().empty() && out.str().empty(), "of what is accepted nothing is said");
    compare(words, read(arguments));
    ++accepted[which];
  } else if (*ends) {
    require(!out.str().empty() && messages.str().empty(), "what was asked for is on standard output");
    ++asked[which];
  } else {
    std::size_t letters = 0;
    for (const std::string& word : words)
      letters += word.size() + 1;
    const std::string said = messages.str();
    require(said.size() > 1 && said.back() == '\n' && said.size() < 1000 + 10 * letters, "a refusal says why, shortly");
    ++refused[which];
  }
}

/// The options of a program with what they take, from its --help: FLOAT, UINT, TEXT, X Y Z, or nothing.
std::vector<std::pair<std::string, std::string>> options_of(const std::string& help) {
  std::vector<std::pair<std::string, std::string>> options;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("--");
    if (line.rfind("  -", 0) != 0 || at == std::string::npos)
      continue;
    const std::size_t end = std::min(line.find(' ', at), line.size());
    const std::string behind = line.substr(end);
    std::string takes;
    for (const char* const kind : {"TEXT", "FLOAT", "UINT", "X Y Z"})
      if (behind.rfind(std::string(" ") + kind, 0) == 0)
        takes = kind;
    options.emplace_back(line.substr(at, end - at), takes);
  }
  return options;
}

template <class Arguments, class Read_arguments>
std::string help_of(const Read_arguments& read_arguments) {
  std::ostringstream out;
  auto* const screen = std::cout.rdbuf(out.rdbuf());
  std::string name = "program", help = "--help";
  char* words[] = {name.data(), help.data(), nullptr};
  Arguments arguments;
  read_arguments(2, words, arguments);
  std::cout.rdbuf(screen);
  return out.str();
}

/// From all doubles, all whole numbers, and what is nearly a number.
std::string number_word(std::mt19937_64& random) {
  std::ostringstream text;
  double x = 0;
  const std::uint64_t bits = random();
  std::memcpy(&x, &bits, sizeof x);
  switch (random() % 8) {
  case 0:
    text.precision(random() % 30);
    text << x;
    break;
  case 1:
    text << std::hexfloat << x;
    break;
  case 2:
    text << std::uniform_real_distribution<double>(-2, 2)(random);
    break;
  case 3: // half between two doubles, and a digit more or less far behind
    text << "1.00000000000000011102230246251565404236316680908203125" << (random() % 2 ? "0000000001" : "");
    break;
  case 4:
    text << (random() >> random() % 64);
    break;
  default:
    static const char* const words[] = {
        "nan", "-nan", "inf", "-inf", "-0",  "0x", "1e", " ",      "1,5",      "1e400", "+1",
        "++1", "010",  "-1",  "4e2",  "0x1", "@1", "1 ", "1e-400", "2.5e-324", "4",     "18446744073709551616",
        "0.5", "1000", "1",   "100",  "0.1", "0",  "2",  "1e5",    "0.25"};
    text << words[random() % std::size(words)];
  }
  return text.str();
}

std::string text_word(std::mt19937_64& random) {
  static const std::vector<std::string> words = {
      "a.off", "-",     "--",    "",     "edit",     "@0,0,0",   "@nan,0,0",
      "7",     "slide", "stop",  "tree", "altitude", "\xff\xfe", std::string(5000, 'a'),
      "%s%n",  "--log", "-o",    "a b",  "nan@1",    "=",        "{}",
      "'",     "V",     "[1,2]", "a.png"};
  return words[random() % words.size()];
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  Words words;
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  for (std::string word; std::getline(lines, word);)
    words.push_back(word.c_str()); // up to a zero, as arguments are
  if (data[0] % 2 == 0)
    run<sculpt_program::Arguments>(0, words, sculpt_program::read_arguments);
  else
    run<loop_program::Arguments>(1, words, loop_program::read_arguments);
  return 0;
}

std::string fuzz_input(std::mt19937_64& random) {
  static const std::array<std::vector<std::pair<std::string, std::string>>, 2> options = {
      options_of(help_of<sculpt_program::Arguments>(sculpt_program::read_arguments)),
      options_of(help_of<loop_program::Arguments>(loop_program::read_arguments))};
  const std::size_t which = random() % 2;
  std::string input(1, char(which));
  if (random() % 8 != 0)
    input += "mesh.off\n";
  const std::size_t number = random() % 2 + random() % 4;
  for (std::size_t k = 0; k < number; ++k) {
    const auto& [name, takes] = options[which][random() % options[which].size()];
    input += name;
    std::size_t values = takes.empty()      ? 0
                         : name == "--map"  ? 4 + random() % 4
                         : name == "--snap" ? 1 + random() % 2
                         : takes == "X Y Z" ? 3
                                            : 1;
    values += random() % 50 == 0;
    char before = takes.empty() || random() % 4 != 0 ? '\n' : '=';
    for (; values > 0; --values, before = '\n')
      input += before + ((takes[0] != 'T') == (random() % 8 != 0) ? number_word(random) : text_word(random));
    input += '\n';
  }
  if (random() % 16 == 0)
    input += text_word(random) + '\n';
  return input;
}

std::string fuzz_summary() {
  std::string text;
  for (std::size_t k = 0; k < 2; ++k)
    text += std::string(k == 0 ? "sculpt: " : "; haptic_loop: ") + std::to_string(accepted[k]) + " accepted, " +
            std::to_string(refused[k]) + " refused, " + std::to_string(asked[k]) + " asked for help";
  return text;
}
