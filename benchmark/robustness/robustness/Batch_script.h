// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "robustness_meshes.h"

#include <haptic_sculpt/surface.h>

#include <filesystem>
#include <sstream>

namespace haptic_sculpt::robustness {

/// In a script, behind a drag: it stays where it began, more than a distance from its contact. `minimise` reads that.
constexpr const char* stays_farther_mark = " # stays farther from its contact than ";

/// What a batch has done to a mesh, as a script that `sculpt` replays. Vertices are named by numbers that last.
class Batch_script {
public:
  void add(const char* word, std::initializer_list<std::size_t> vertices = {}) {
    Line& line = lines_.emplace_back();
    line.word = word;
    for (const std::size_t v : vertices)
      line.vertices[line.number_of_vertices++] = v;
  }
  void add(const char* word, std::initializer_list<std::size_t> vertices, const Point_3& p) {
    add(word, vertices);
    lines_.back().point = {p.x(), p.y(), p.z()};
    lines_.back().has_point = true;
  }

  /// The last line is a drag that stays, farther than this from its contact.
  void stays_farther_than(double distance) { lines_.back().farther_than = distance; }

  /// \param opening lines that come first
  std::string text(const std::string& opening) const {
    std::ostringstream out;
    out << std::hexfloat << opening;
    for (const Line& line : lines_) {
      out << line.word;
      for (std::size_t i = 0; i < line.number_of_vertices; ++i)
        out << ' ' << line.vertices[i];
      if (line.has_point)
        out << ' ' << line.point[0] << ' ' << line.point[1] << ' ' << line.point[2];
      if (line.farther_than > 0)
        out << stays_farther_mark << line.farther_than;
      out << '\n';
    }
    return out.str();
  }

private:
  struct Line {
    const char* word = nullptr;
    std::array<std::size_t, 3> vertices{};
    std::size_t number_of_vertices = 0;
    std::array<double, 3> point{};
    bool has_point = false;
    double farther_than = 0;
  };
  std::vector<Line> lines_;
};

/// NAME.off and NAME.script. \throw Error
inline void write_case(const std::filesystem::path& folder, const std::string& name, const Mesh& input,
                       const std::string& script) {
  std::error_code none; // where it cannot be made, the files say so
  std::filesystem::create_directories(folder, none);
  write_surface(folder / (name + ".off"), input);
  replace_file(folder / (name + ".script"), script);
}

} // namespace haptic_sculpt::robustness
