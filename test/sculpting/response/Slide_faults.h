// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/scene_parts.h"

#include <boost/test/unit_test.hpp>

#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace haptic_sculpt::test {

/// Which response the tests of slides drag with. HAPTIC_SCULPT_TESTED_RESPONSE=stop shows what they say to a response
/// that ends anywhere.
inline Response response_under_test() {
  const char* text = std::getenv("HAPTIC_SCULPT_TESTED_RESPONSE");
  return text != nullptr && std::string(text) == "stop" ? Response::stop : Response::slide;
}

inline std::string exact_text(const Point_3& p) {
  std::ostringstream text;
  text << std::hexfloat << p.x() << ' ' << p.y() << ' ' << p.z();
  return text.str();
}

/// What was done to a vertex before: where it began, then targets, and nothing where it was let go.
struct Drag_history {
  Point_3 start;
  std::vector<std::optional<Point_3>> targets;
};

/// Counts faults of one kind, prints the first few of each scene as cases to repeat, and writes their meshes where
/// HAPTIC_SCULPT_FAULTS names a folder: NAME.off with full digits, with the mesh as before the drag.
class Slide_faults {
public:
  explicit Slide_faults(std::string kind) : kind_(std::move(kind)) {}

  void add(const std::string& scene, const Mesh& mesh, Vertex_index v, const Point_3& source, const Point_3& target,
           double clearance, const std::string& what, const Drag_history* history = nullptr) {
    constexpr std::size_t most_printed = 2;
    ++count_;
    if (++count_in_[scene] > most_printed)
      return;
    std::ostringstream text;
    text << kind_ << ": " << scene << ": vertex " << v << " from " << exact_text(source) << " to " << exact_text(target)
         << ", clearance " << std::hexfloat << clearance << ": " << what;
    BOOST_TEST_MESSAGE(text.str());
    if (const char* folder = std::getenv("HAPTIC_SCULPT_FAULTS")) {
      Mesh before = mesh;
      before.point(v) = history != nullptr ? history->start : source;
      std::string name = kind_ + "_" + scene + "_" + std::to_string(count_in_[scene]);
      for (char& c : name)
        c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
      std::ofstream file(std::string(folder) + "/" + name + ".off");
      file << "OFF\n# " << text.str() << '\n';
      if (history != nullptr)
        for (const auto& t : history->targets)
          file << (t ? "# drag " + exact_text(*t) : std::string("# release")) << '\n';
      file << before.number_of_vertices() << ' ' << before.number_of_faces() << " 0\n";
      file.precision(17);
      for (const Vertex_index w : before.vertices())
        file << before.point(w) << '\n';
      for (const auto f : before.faces()) {
        file << 3;
        for (const Vertex_index w : before.vertices_around_face(before.halfedge(f)))
          file << ' ' << static_cast<std::size_t>(w);
        file << '\n';
      }
    }
  }
  std::size_t count() const { return count_; }

private:
  std::string kind_;
  std::size_t count_ = 0;
  std::map<std::string, std::size_t> count_in_;
};

} // namespace haptic_sculpt::test
