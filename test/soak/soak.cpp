// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpts at random for as long as asked, with all that a Sculptor and the free functions can do: one mesh after the
// other, calls as the fuzz target makes them. Looks at the memory of the process between meshes.
#include <fuzz/call_at_random.h>

#include <haptic_sculpt/surface/read_surface.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

#include <malloc.h>
#include <unistd.h>

namespace {

using namespace haptic_sculpt;

struct Named_mesh {
  std::string name;
  meshes::Mesh mesh;
};

constexpr std::size_t most_faces = 20000; ///< a validation follows each call

std::vector<Named_mesh> all_meshes(const std::vector<std::string>& files) {
  std::vector<Named_mesh> all;
  const auto add = [&](const char* name, const meshes::Triangle_list& list) {
    all.push_back({name, meshes::to_mesh(list)});
  };
  add("bumpy sphere", meshes::bumpy_sphere(2, 0.2, 0.02));
  add("torus", meshes::torus(24, 12));
  add("box", meshes::box(6, 2));
  add("C", meshes::c_tube(0x1p-10));
  add("ball in a cavity", meshes::ball_in_a_cavity(1));
  add("row of spheres", meshes::row_of_spheres(4));
  add("slivers", meshes::sliver_stack(20, 0x1p-39));
  add("bipyramid", meshes::bipyramid(100));
  for (const std::string& file : files)
    try {
      auto mesh = read_surface<meshes::Mesh>(file);
      if (mesh.number_of_faces() <= most_faces)
        all.push_back({std::filesystem::path(file).filename().string(), std::move(mesh)});
    } catch (const Error&) { // of those given some are to be refused
    }
  return all;
}

/// Bytes of the process that are in memory.
double resident() {
  ::malloc_trim(0);
  std::size_t pages = 0, ignored = 0;
  std::ifstream("/proc/self/statm") >> ignored >> pages;
  return static_cast<double>(pages) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// \return whether all of a text is a number of at least 0
bool read(const char* text, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value >= 0 && std::isfinite(value);
}
bool read(const char* text, std::size_t& value) {
  const char* end = text + std::strlen(text);
  const auto result = std::from_chars(text, end, value);
  return result.ec == std::errc() && result.ptr == end;
}

int usage() {
  std::cerr << "usage: soak [--minutes M | --rounds N] [--seed S] [MESH...]\n"
               "Sculpts generated meshes, and those given that are valid and have at most 20,000 faces, in turn, one "
               "round through all of them\nafter the other. Exit: 0 no promise broken and the memory is flat, 1 it is "
               "not, or M minutes are too few to tell; 2 usage; ends by an abort where a promise is broken. The memory "
               "of N < 10 rounds is not judged.\n";
  return 2;
}

} // namespace

int main(int argc, char** argv) {
  double minutes = 0;
  std::size_t rounds = 1, seed = 1;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind("--", 0) != 0)
      files.push_back(word);
    else if (i + 1 == argc)
      return usage();
    else if (word == "--minutes") {
      if (!read(argv[++i], minutes) || minutes == 0)
        return usage();
      rounds = std::numeric_limits<std::size_t>::max();
    } else if (word != "--rounds" && word != "--seed")
      return usage();
    else if (!read(argv[++i], word == "--rounds" ? rounds : seed) || rounds == 0)
      return usage();
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto passed = [&begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / 60;
  };
  const std::vector<Named_mesh> meshes = all_meshes(files);
  std::printf("seed %zu, %zu meshes\n", seed, meshes.size());
  fuzz::Call_tally tally;
  std::vector<std::pair<double, double>> memory; // minutes, bytes: after each round
  std::size_t round = 0;
  for (; round < rounds && (minutes == 0 || passed() < minutes); ++round) {
    for (std::size_t k = 0; k < meshes.size() && (minutes == 0 || passed() < minutes); ++k) {
      std::seed_seq sequence{std::uint32_t(seed), std::uint32_t(seed >> 32), std::uint32_t(round), std::uint32_t(k)};
      std::mt19937_64 random(sequence);
      const std::string bytes = fuzz::random_bytes(random, 1 << 14);
      fuzz::Choices choices(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      const fuzz::Call_limits limits{100, 2 * meshes[k].mesh.number_of_faces() + 500};
      std::printf("\rround %zu, %s                    ", round, meshes[k].name.c_str());
      std::fflush(stdout); // what it was where a promise is broken
      fuzz::call_at_random(choices, meshes[k].mesh, 1, limits, tally);
    }
    memory.emplace_back(passed(), resident());
  }
  // The first rounds warm up: allocators and tables grow to what the largest mesh needs.
  double sum_t = 0, sum_m = 0, sum_tt = 0, sum_tm = 0, least = HUGE_VAL, largest = 0;
  std::size_t n = 0;
  for (std::size_t k = memory.size() / 4; k < memory.size(); ++k, ++n) {
    const auto [t, m] = memory[k];
    sum_t += t, sum_m += m, sum_tt += t * t, sum_tm += t * m;
    least = std::fmin(least, m), largest = std::fmax(largest, m);
  }
  const double of_n = static_cast<double>(n), spread = of_n * sum_tt - sum_t * sum_t;
  const double slope = spread > 0 ? (of_n * sum_tm - sum_t * sum_m) / spread : 0; // bytes a minute
  std::printf("\r%zu rounds in %.1f minutes: %s\n", round, passed(), tally.in_words().c_str());
  std::printf("memory after the first quarter: %.1f to %.1f MB, slope %.3f MB an hour\n", least / 1e6, largest / 1e6,
              60 * slope / 1e6);
  constexpr double allowed = 8e6; ///< bytes: what allocators keep in pieces
  constexpr std::size_t least_looks = 8;
  if (n < least_looks) {
    std::printf(minutes > 0 ? "FAULT: %zu looks at the memory: a longer run is needed\n"
                            : "%zu looks at the memory: too few to judge it\n",
                n);
    return minutes > 0 ? 1 : 0;
  }
  if (largest - least >= allowed)
    std::printf("FAULT: the memory grows\n");
  return largest - least < allowed ? 0 : 1;
}
