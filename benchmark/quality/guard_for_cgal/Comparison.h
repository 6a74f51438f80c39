// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/generated_meshes.h"
#include "sculpting/Mesh_snapshot.h"

#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/surface.h>

#include <nlohmann/json.hpp>

#include <ctime>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace haptic_sculpt::benchmark {

using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vector_3 = meshes::Kernel::Vector_3;
using Vertex_index = Mesh::Vertex_index;
using Edge_index = Mesh::Edge_index;
using Face_index = Mesh::Face_index;
using Json = nlohmann::ordered_json;

struct Named_mesh {
  std::string name;
  Mesh mesh;
};

/// What came out of a function, by CGAL alone or under the guard.
struct Outcome {
  double seconds = 0;    ///< of processor time, so that a busy machine changes little
  std::size_t pairs = 0; ///< of self-intersecting faces
  bool is_valid = false; ///< validate()
  std::size_t faces = 0;
  double least_angle = 0, mean_least_angle = 0; ///< degrees: of all triangles, and of the least of each
  double valence_six = 0;                       ///< share of the vertices
  double length = 0; ///< mean of the edges, in target lengths of a remeshing, else in those of the input
  double hausdorff =
      0; ///< the largest distance of vertices and face centres to the other surface, both ways, in the same unit
  bool failed = false; ///< the function said so
};

/// One function on one mesh.
struct Comparison {
  std::string mesh, function, way; ///< way: how the guard comes in: "map", "functor", "targets" or "remesher"
  Outcome plain, guarded;
  double set_up = 0; ///< seconds to make the Sculptor
  std::optional<double> share; ///< of the way asked for that was made; known of maps and targets
  std::size_t asked = 0, refused = 0;
  std::size_t drags = 0; ///< of targets
  bool out_of_work = false;
  bool undone_to_the_bit = false, redone_to_the_bit = false;
  bool has_to_arrive = false; ///< all vertices, to the bit: the motion is rigid, and its end exact

  bool is_kept() const {
    return guarded.pairs == 0 && guarded.is_valid && (plain.failed || !guarded.failed) && undone_to_the_bit &&
           redone_to_the_bit && (!has_to_arrive || refused == 0 || out_of_work);
  }
};

struct Settings {
  unsigned seed = 1, iterations = 5;                               ///< iterations of remeshing
  std::string only;                                                ///< functions whose names have this in them
  double drags_a_vertex = std::numeric_limits<double>::infinity(); ///< at most, of targets

  bool wants(const std::string& function) const { return function.find(only) != std::string::npos; }
};

inline double seconds_since(std::clock_t begin) {
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double mean_edge(const Mesh& mesh);
/// Whether all triangles have areas as doubles, neither 0 nor infinite. Where none at a vertex has one, CGAL 5.5's
/// tangential_relaxation reads beyond an array.
bool has_areas(const Mesh& mesh);
/// All but seconds. \param unit a length \param input what the surface was; nullptr where its distance is of no
/// interest
void measure(Mesh mesh, double unit, const Mesh* input, Outcome& outcome);
Json to_json(const Comparison& comparison);

/// Takes back all that was done since the mesh was `before`, and does it again.
/// \pre it was one step of the history
template <class Sculptor>
void undo_and_redo(Sculptor& sculptor, const test::Mesh_snapshot& before, Comparison& comparison) {
  const test::Mesh_snapshot after = test::snapshot(sculptor);
  if (after == before) { // no step at all
    comparison.undone_to_the_bit = comparison.redone_to_the_bit = true;
    return;
  }
  sculptor.undo();
  comparison.undone_to_the_bit = test::snapshot(sculptor) == before;
  sculptor.redo();
  comparison.redone_to_the_bit = test::snapshot(sculptor) == after;
}

/// CGAL's functions that move points, on one mesh. \param tell `tell(comparison)`
using Tell = std::function<void(const Comparison&)>;
void compare_functions(const Named_mesh& scene, const Settings& settings, const Tell& tell);
/// Remeshing to 0.7, 1, 1.5, 2 and 3 mean edges.
void compare_remeshing(const Named_mesh& scene, const Settings& settings, const Tell& tell);
/// Every vertex of a mesh by a tenth of an edge, in a random direction, in one stroke.
Json move_all_by_a_tenth(Mesh mesh, unsigned seed);

} // namespace haptic_sculpt::benchmark
