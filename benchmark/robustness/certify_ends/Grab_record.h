// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../../../examples/common/contents_of.h"
#include "../../../examples/common/numbers.h"
#include "sculpting/scene_parts.h"

#include <haptic_sculpt/surface.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace haptic_sculpt::benchmark {

/// One grab, or one probe, so that it can be made again: the mesh before, and the targets.
struct Grab_record {
  using Mesh = meshes::Mesh;
  using Point_3 = meshes::Point_3;

  Mesh mesh;
  Mesh::Vertex_index vertex; ///< null: a probe
  Point_3 start{0, 0, 0};    ///< of the probe
  std::vector<Point_3> targets;
  double clearance = 0, delta = 0; ///< the clearance set, 0: the default

  static std::string hexadecimal(const Point_3& p) {
    char text[128];
    std::snprintf(text, sizeof text, "%a %a %a", p.x(), p.y(), p.z());
    return text;
  }

  /// NAME.off and NAME.script, a script for `sculpt`, to which each line of a probe is a probe of its own. \pre no
  /// vertex is removed
  void write(const std::filesystem::path& folder, const std::string& name, const std::string& what) const {
    std::ostringstream off, script;
    off.precision(17);
    off << "OFF\n" << mesh.number_of_vertices() << ' ' << mesh.number_of_faces() << " 0\n";
    for (const auto v : mesh.vertices())
      off << mesh.point(v) << '\n';
    for (const auto f : mesh.faces()) {
      off << 3;
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        off << ' ' << static_cast<std::size_t>(v);
      off << '\n';
    }
    script << "# " << what << '\n';
    script << std::hexfloat;
    if (clearance > 0)
      script << "clearance " << clearance << '\n';
    if (delta > 0)
      script << "delta " << delta << '\n';
    for (const Point_3& t : targets)
      script << (vertex.is_valid() ? "drag " + std::to_string(static_cast<std::size_t>(vertex))
                                   : "probe " + hexadecimal(start))
             << ' ' << hexadecimal(t) << '\n';
    std::filesystem::create_directories(folder);
    replace_file(folder / (name + ".off"), off.str());
    replace_file(folder / (name + ".script"), script.str());
  }

  /// What write() wrote. \throw Error
  static Grab_record read(const std::filesystem::path& off, const std::filesystem::path& script) {
    Grab_record record;
    record.mesh = read_surface<Mesh>(off);
    std::istringstream lines(examples::contents_of<Error>(script.string(), "the script"));
    for (std::string line; std::getline(lines, line);) {
      const auto refuse = [&](const std::string& why) {
        throw Error("'" + script.string() + "' is not a script of one grab: " + line + why);
      };
      std::istringstream words(line);
      std::string op, word;
      if (!(words >> op) || op[0] == '#')
        continue;
      std::vector<double> numbers;
      while (words >> word) {
        numbers.push_back(examples::number_of(word).value_or(INFINITY));
        if (!std::isfinite(numbers.back()))
          refuse(": '" + word + "' is not a finite number");
      }
      if (op == "clearance" && numbers.size() == 1)
        record.clearance = numbers[0];
      else if (op == "delta" && numbers.size() == 1)
        record.delta = numbers[0];
      else if (op == "drag" && numbers.size() == 4) {
        const std::size_t count = record.mesh.number_of_vertices();
        if (!(numbers[0] >= 0 && numbers[0] < static_cast<double>(count) && std::trunc(numbers[0]) == numbers[0]))
          refuse(": the vertex is not a whole number below " + std::to_string(count) + ", the number of vertices");
        const Mesh::Vertex_index v(static_cast<Mesh::size_type>(numbers[0]));
        if (!record.targets.empty() && record.vertex != v)
          refuse(": it is another grab than before");
        record.vertex = v;
        record.targets.emplace_back(numbers[1], numbers[2], numbers[3]);
      } else if (op == "probe" && numbers.size() == 6) {
        const Point_3 start(numbers[0], numbers[1], numbers[2]);
        if (!record.targets.empty() && (record.vertex.is_valid() || record.start != start))
          refuse(": it is another grab than before");
        record.start = start;
        record.targets.emplace_back(numbers[3], numbers[4], numbers[5]);
      } else
        refuse("");
    }
    if (record.targets.empty())
      throw Error("'" + script.string() + "' has no drag");
    return record;
  }
};

} // namespace haptic_sculpt::benchmark
