// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Runs a fuzz target without libFuzzer, with any compiler: damages the target's seeds, each input by a draw of its
/// own, so that any one of them can be made again.

#include <fuzz/Fuzz_target.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <unistd.h>

// So that a sanitizer's finding, too, comes to `tell_input()`.
extern "C" const char* __asan_default_options() {
  return "abort_on_error=1";
}
extern "C" const char* __ubsan_default_options() {
  return "abort_on_error=1:print_stacktrace=1";
}

namespace {

char how_to_repeat[160];

void tell_input(int signal) {
  std::signal(signal, SIG_DFL);
  if (::write(2, how_to_repeat, std::strlen(how_to_repeat)) < 0)
    std::_Exit(3);
  std::raise(signal);
}

/// Damages a text or some bytes in a few of many ways.
class Damage {
public:
  Damage(std::uint64_t seed, std::uint64_t number, const std::vector<std::string>& seeds) : seeds_(seeds) {
    std::seed_seq sequence{std::uint32_t(seed), std::uint32_t(seed >> 32), std::uint32_t(number),
                           std::uint32_t(number >> 32)};
    random_.seed(sequence);
  }

  std::string operator()() {
    std::string input = seeds_[below(seeds_.size())];
    const std::string kind = input.substr(0, 1);
    input.erase(0, 1);
    for (std::size_t n = 1 + below(4); n-- > 0;)
      damage(input);
    return kind + input;
  }

private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  void damage(std::string& text) {
    static const char* const words[] = {"nan",        "inf",        "-inf",
                                        "1e308",      "-1e308",     "1e999",
                                        "1e-320",     "5e-324",     "-0",
                                        "0",          "1",          "-1",
                                        "+-1",        "+1",         "4294967295",
                                        "4294967296", "2147483648", "18446744073709551616",
                                        "0x1",        "1e",         ".5",
                                        "3",          "4",          "solid",
                                        "endsolid",   "facet",      "v",
                                        "f",          "vt",         "l",
                                        "#",          "\n",         " ",
                                        "ply",        "format",     "element",
                                        "property",   "list",       "uchar",
                                        "double",     "face",       "vertex",
                                        "OFF",        "end_header", "binary_big_endian 1.0",
                                        "1/1/1",      "-4//1",      "0.5",
                                        "0.25",       "1e-300",     "\r",
                                        "\\"};
    const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at + 1, 40));
    switch (below(10)) {
    case 0: // a bit
      if (at < text.size())
        text[at] = char(text[at] ^ (1 << below(8)));
      break;
    case 1: // a byte
      if (at < text.size())
        text[at] = char(random_());
      break;
    case 2: // a part lost
      text.erase(at, length);
      break;
    case 3: // a part doubled
      text.insert(below(text.size() + 1), text.substr(at, length));
      break;
    case 4: // a word put in
      text.insert(at, words[below(std::size(words))]);
      break;
    case 5: { // the rest of another
      const std::string& other = seeds_[below(seeds_.size())];
      text = text.substr(0, at) + other.substr(below(other.size()));
      break;
    }
    case 6: { // some bytes of a number
      const std::uint64_t values[] = {0, 1, 0x7fffffff, 0xffffffff, 0x7ff0000000000000, 0x8000000000000000, random_()};
      const std::uint64_t value = values[below(std::size(values))];
      const std::size_t bytes = std::min(text.size() - at, std::size_t(1) << below(4));
      std::memcpy(text.data() + at, &value, bytes);
      break;
    }
    default: // a word for a word, where there are digits: what is likely to be read all the same
      const std::size_t begin = std::min(text.find_first_of("0123456789", at), text.size());
      const std::size_t end = std::min(text.find_first_of(" \t\r\n/", begin), text.size());
      if (end - begin < 40)
        text.replace(begin, end - begin, below(2) ? words[below(std::size(words))] : std::to_string(below(9)));
    }
  }

  const std::vector<std::string>& seeds_;
  std::mt19937_64 random_;
};

int usage(const char* program, int code) {
  std::fprintf(code == 0 ? stdout : stderr,
               "usage: %s [--files N] [--seed S] [--first I] [--write-seeds FOLDER]\n"
               "Damages good inputs at random and runs them. Ends with an abort at the first broken promise, and says\n"
               "how to repeat it.\n"
               "  --files N              this many inputs (100000)\n"
               "  --seed S               other draws (1)\n"
               "  --first I              begin with input I (0)\n"
               "  --write-seeds FOLDER   only write the good inputs, for libFuzzer\n",
               program);
  return code;
}

} // namespace

int main(int argc, char** argv) {
  std::uint64_t files = 100000, seed = 1, first = 0;
  const std::vector<std::string> seeds = fuzz_seeds();
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--help")
      return usage(argv[0], 0);
    if (i + 1 == argc)
      return usage(argv[0], 2);
    const char *value = argv[i + 1], *end = value + std::strlen(value);
    if (option == "--write-seeds") {
      for (std::size_t k = 0; k < seeds.size(); ++k)
        std::ofstream(std::filesystem::path(value) / ("seed" + std::to_string(k)), std::ios::binary) << seeds[k];
      return 0;
    }
    std::uint64_t* const number = option == "--files"   ? &files
                                  : option == "--seed"  ? &seed
                                  : option == "--first" ? &first
                                                        : nullptr;
    if (!number || std::from_chars(value, end, *number).ptr != end)
      return usage(argv[0], 2);
  }
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL})
    std::signal(signal, tell_input);
  for (std::uint64_t i = first; i < first + files; ++i) {
    std::snprintf(how_to_repeat, sizeof how_to_repeat, "repeat with: --seed %llu --first %llu --files 1\n",
                  static_cast<unsigned long long>(seed), static_cast<unsigned long long>(i));
    const std::string input = Damage(seed, i, seeds)();
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  }
  std::printf("seed %llu, %llu inputs from %llu on, no promise broken; %s\n", static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(files), static_cast<unsigned long long>(first), fuzz_summary().c_str());
  return 0;
}
