// SPDX-License-Identifier: GPL-3.0-or-later
#include "Model.h"

namespace haptic_sculpt::window_program {

namespace {

constexpr std::size_t edits = 1000, moves = 100000; // room that is made for this many

double mean_edge_length(const Mesh& mesh) {
  double mean = 0;
  for (const auto e : mesh.edges())
    mean += (drawing::to_eigen(mesh.point(mesh.vertex(e, 0))) - drawing::to_eigen(mesh.point(mesh.vertex(e, 1))))
                .stableNorm() /
            double(mesh.number_of_edges());
  return mean;
}

} // namespace

Model::Model(const examples::Mesh_file& file, const std::string& log_given, std::vector<std::string> found)
    : Loop_scene<Mesh>(
          file.surface<Mesh>(&found),
          [](const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
            return Mouse::map_for((upper - lower).stableNorm());
          },
          window_program::edits, moves, parameters::known_valid(true))
    , path(file.path())
    , left_out(std::move(found))
    , log_path(log_given)
    , log(log_given, log_given.empty() ? "" : file.hash())
    , edge_length(mean_edge_length(mesh))
    , unit_(std::ldexp(1, std::min(1000, -std::ilogb(extent())))) {
  keep_vertex_attributes(sculptor);
  sculptor.keep(mask, Interpolate_property());
  note = log.resume(static_cast<Loop_scene<Mesh>&>(*this));
  resumed = log.number_of_edits();
  changes_ = sculptor.visitor().changed.number();
  const std::uint64_t most_age = 20000; // ticks; a second half as long would be waited for, see Loop_thread::has_room
  const std::size_t entries_a_tick = 4; // in the mean; a mouse that drags makes one, a dab some fifty in sixteen ticks
  log.begin("the hand in sculpt_window", most_age, entries_a_tick);
}

Eigen::Vector3d Model::normal_of(Face_index f) const {
  const auto h = mesh.halfedge(f);
  const Eigen::Vector3d a = drawing::to_eigen(mesh.point(mesh.source(h))),
                        b = drawing::to_eigen(mesh.point(mesh.target(h))),
                        c = drawing::to_eigen(mesh.point(mesh.target(mesh.next(h))));
  return (unit_ * (b - a)).cross(unit_ * (c - a));
}

Seen_face Model::face(std::uint32_t index) const {
  Seen_face face;
  static_cast<Face_change&>(face) = Loop_scene<Mesh>::face(index);
  if (!face.is_there)
    return face;
  const double cosine_of_crease = 0.7; // of 45 degrees, between the normals of two faces
  constexpr std::size_t most_faces = 256; // about a vertex whose normal is smoothed
  const Face_index own(index);
  const Eigen::Vector3d normal = normal_of(own);
  auto h = mesh.prev(mesh.halfedge(own)); // its target is the first corner
  for (std::size_t i = 0; i < 3; ++i, h = mesh.next(h)) {
    Eigen::Vector3d sum = normal;
    std::size_t seen = 0;
    for (const Face_index f : mesh.faces_around_target(h)) { // from h on, whose face is this one
      if (f != own)
        if (const Eigen::Vector3d other = normal_of(f);
            other.dot(normal) > cosine_of_crease * other.norm() * normal.norm())
          sum += other;
      if (++seen == most_faces) { // a hub: each of its faces would look at all
        sum = normal;
        break;
      }
    }
    const Eigen::Vector3f unit = sum.stableNormalized().cast<float>();
    face.normals[i] = {unit[0], unit[1], unit[2]};
    face.masks[i] = float(mask[mesh.target(h)]);
  }
  return face;
}

} // namespace haptic_sculpt::window_program
