// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Runs a fuzz target without libFuzzer, with any compiler: each input is a draw of its own, so that any one of them
/// can be made again.

#include <fuzz/Fuzz_target.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <sys/time.h>
#include <unistd.h>

// So that a sanitizer's finding, too, comes to `tell_input()`.
extern "C" const char* __asan_default_options() {
  return "abort_on_error=1";
}
extern "C" const char* __ubsan_default_options() {
  return "abort_on_error=1:print_stacktrace=1";
}

namespace {

constexpr int longest = 60; ///< seconds of processor time that one input may take

char how_to_repeat[160];

void tell_input(int signal) {
  std::signal(signal, SIG_DFL);
  constexpr char late[] = "an input takes too long\n";
  if ((signal == SIGPROF && ::write(2, late, sizeof late - 1) < 0) ||
      ::write(2, how_to_repeat, std::strlen(how_to_repeat)) < 0)
    std::_Exit(3);
  std::raise(signal);
}

std::string input_of(std::uint64_t seed, std::uint64_t number) {
  std::seed_seq sequence{std::uint32_t(seed), std::uint32_t(seed >> 32), std::uint32_t(number),
                         std::uint32_t(number >> 32)};
  std::mt19937_64 random(sequence);
  return fuzz_input(random);
}

int run(const std::string& input) {
  const itimerval time{{0, 0}, {longest, 0}};
  ::setitimer(ITIMER_PROF, &time, nullptr);
  return LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

int usage(const char* program, int code) {
  std::fprintf(code == 0 ? stdout : stderr,
               "usage: %s [--runs N] [--seed S] [--first I] [--write FOLDER] | FILE...\n"
               "Runs random inputs. Ends with an abort at the first broken promise, or where an input takes more than\n"
               "%d s, and says how to repeat it. With files: runs these.\n"
               "  --runs N         this many inputs (100000)\n"
               "  --seed S         other draws (1)\n"
               "  --first I        begin with input I (0)\n"
               "  --write FOLDER   only write the inputs there, e.g. for libFuzzer to begin with\n",
               program, longest);
  return code;
}

} // namespace

int main(int argc, char** argv) {
  std::uint64_t runs = 100000, seed = 1, first = 0;
  std::filesystem::path folder;
  std::vector<const char*> files;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--help")
      return usage(argv[0], 0);
    if (option.rfind("--", 0) != 0) {
      files.push_back(argv[i]);
      continue;
    }
    if (++i == argc)
      return usage(argv[0], 2);
    const char *value = argv[i], *end = value + std::strlen(value);
    std::uint64_t* const number = option == "--runs"    ? &runs
                                  : option == "--seed"  ? &seed
                                  : option == "--first" ? &first
                                                        : nullptr;
    if (option == "--write")
      folder = value;
    else if (!number || std::from_chars(value, end, *number).ptr != end)
      return usage(argv[0], 2);
  }
  for (const char* name : files) {
    std::ifstream file(name, std::ios::binary);
    if (!file) {
      std::fprintf(stderr, "cannot read %s\n", name);
      return 2;
    }
    run(std::string(std::istreambuf_iterator<char>(file), {}));
  }
  if (!files.empty())
    return 0;
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGPROF})
    std::signal(signal, tell_input);
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t i = first; i < first + runs; ++i) {
    std::snprintf(how_to_repeat, sizeof how_to_repeat, "repeat with: --seed %llu --first %llu --runs 1\n",
                  static_cast<unsigned long long>(seed), static_cast<unsigned long long>(i));
    const std::string input = input_of(seed, i);
    if (folder.empty())
      run(input);
    else
      std::ofstream(folder / (std::to_string(seed) + "_" + std::to_string(i)), std::ios::binary) << input;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::printf("seed %llu, %llu inputs from %llu on in %.1f s, no promise broken; %s\n",
              static_cast<unsigned long long>(seed), static_cast<unsigned long long>(runs),
              static_cast<unsigned long long>(first), took.count(), fuzz_summary().c_str());
  return 0;
}
