// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Model.h"

#include <haptic_sculpt/haptic_rendering/exchange/Loop_session.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

/// \file
/// What the window has the loop's thread do between two ticks.

namespace haptic_sculpt::window_program {

using Hit = std::optional<Surface_hit<Mesh>>;

/// A task whose refusal people hear of.
class Window_task : public Loop_task<Scene> {
public:
  std::string refusal;    ///< why nothing was done; empty: it was
  bool is_beside = false; ///< nothing was done, for the mouse does not point at the mesh

  bool go_on(Scene& scene, Tool_type& tool) final {
    try {
      return work(scene, tool);
    } catch (const Error& error) { // such as a target out of range: the mesh is as it was
      refusal = error.what();
      tool.let_go();
      return true;
    }
  }

protected:
  virtual bool work(Scene& scene, Tool_type& tool) = 0;

  static Kernel::Point_3 point(const Place& p) { return {p[0], p[1], p[2]}; }
  static Hit hit_of(Scene& scene, const Pointer& pointer) {
    const auto within = within_range(pointer);
    return within ? scene.sculptor.first_hit(point(within->first), point(within->second)) : std::nullopt;
  }
  /// The part of a pointer's line where there may be a mesh, and which a Sculptor takes; none where it has no length.
  static std::optional<std::pair<Place, Place>> within_range(const Pointer& pointer) {
    double begin = 0, end = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double from = pointer.from[k], way = pointer.to[k] - from;
      if (way == 0 && std::fabs(from) > largest_coordinate)
        return std::nullopt;
      if (way == 0)
        continue;
      const auto [first, last] = std::minmax({(-largest_coordinate - from) / way, (largest_coordinate - from) / way});
      begin = std::fmax(begin, first), end = std::fmin(end, last);
    }
    const auto at = [&](double share) {
      Place p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = std::clamp(pointer.from[k] + share * (pointer.to[k] - pointer.from[k]), -largest_coordinate,
                          largest_coordinate);
      return p;
    };
    const Place from = begin > 0 ? at(begin) : pointer.from, to = end < 1 ? at(end) : pointer.to;
    return begin < end && from != to ? std::optional(std::pair(from, to)) : std::nullopt;
  }
  /// Of the face, of any length.
  static Place normal_at(const Scene& scene, const Surface_hit<Mesh>& hit) {
    const auto h = scene.mesh.halfedge(hit.face);
    return place(drawing::to_eigen(vertex_normal(scene.mesh, scene.mesh.source(h)) +
                                   vertex_normal(scene.mesh, scene.mesh.target(h)) +
                                   vertex_normal(scene.mesh, scene.mesh.target(scene.mesh.next(h)))));
  }
  /// \return always true: it is done
  bool refuse(const std::string& why) {
    refusal = why;
    return true;
  }
  /// \return always true: it is done
  bool miss() { return is_beside = true; }
  bool refuse_unless(const Edit_result<Mesh>& made, const Scene& scene, const std::string& text) {
    if (made)
      return true;
    refusal = text + name_of(made.refusal->reason);
    for (const Vertex_index v : made.refusal->elements)
      refusal += ' ' + std::to_string(scene.sculptor.id(v));
    return true;
  }
  static Edit edit_of(Edit_kind kind, const Scene& scene, Vertex_index a, Vertex_index b) {
    return Edit::of(kind, {scene.sculptor.id(a), scene.sculptor.id(b), 0});
  }
};

/// What of the surface the mouse points at.
class Pick : public Window_task {
public:
  explicit Pick(const Pointer& pointer) : pointer_(pointer) {}
  Pointed pointed;

private:
  Pointer pointer_;

  bool work(Scene& scene, Tool_type&) override {
    const Hit hit = hit_of(scene, pointer_);
    if (!hit)
      return true;
    pointed.feature = name_of(hit->feature);
    pointed.at = place(drawing::to_eigen(hit->point)), pointed.normal = normal_at(scene, *hit);
    const auto add = [&](Vertex_index v) {
      pointed.ids[static_cast<std::size_t>(pointed.size++)] = scene.sculptor.id(v);
    };
    if (hit->feature == Surface_feature::vertex)
      add(hit->vertex);
    else if (hit->feature == Surface_feature::edge)
      add(scene.mesh.vertex(hit->edge, 0)), add(scene.mesh.vertex(hit->edge, 1));
    else
      for (const Vertex_index v : scene.mesh.vertices_around_face(scene.mesh.halfedge(hit->face)))
        add(v);
    return true;
  }
};

/// The button is pressed with a tool that holds one vertex or the probe, or removes a vertex.
class Press : public Window_task {
public:
  /// \param press what the mouse said when the button was pressed \param now what it says in the tick, the loop's
  Press(const Mouse_reading& press, Tool which, const Mouse_reading& now)
      : pointer_(press.pointer), press_(press.press), now_(&now), which_(which) {}
  Held held;

private:
  Pointer pointer_;
  std::uint64_t press_;
  const Mouse_reading* now_;
  Tool which_;

  bool work(Scene& scene, Tool_type& tool) override {
    if (now_->press < press_)
      return false; // the handle is not at home yet: what is taken now would be anchored elsewhere
    tool.let_go();
    const Hit hit = hit_of(scene, pointer_);
    if (!hit)
      return miss();
    if (which_ == Tool::probe)
      return take_probe(scene, tool, *hit);
    const Vertex_index nearest = nearest_corner(scene.mesh, *hit);
    if (which_ == Tool::remove)
      return refuse_unless(tool.edit(edit_of(Edit_kind::remove, scene, nearest, nearest)), scene,
                           "the vertex cannot be removed: ");
    if (which_ == Tool::drag) {
      tool.take(nearest);
    } else {
      if (hit->feature == Surface_feature::vertex)
        return refuse("a vertex stands here already");
      if (const auto made = tool.create_and_take(creation(scene, *hit)); !made)
        return refuse_unless(made, scene, "no vertex can be created here: ");
    }
    held.hold = Status::Hold::vertex;
    held.home = place(drawing::to_eigen(scene.mesh.point(tool.vertex())));
    held.normal = place(drawing::to_eigen(vertex_normal(scene.mesh, tool.vertex())));
    return true;
  }

  /// In front of the surface, nearer to it than the eye.
  bool take_probe(Scene& scene, Tool_type& tool, const Surface_hit<Mesh>& hit) {
    const Eigen::Vector3d aim = drawing::to_eigen(hit.point), back = vector(pointer_.from) - aim;
    const Eigen::Vector3d front =
        aim + std::fmin(0.1 * scene.extent(), 0.5 * back.stableNorm()) * back.stableNormalized();
    if (!tool.take_probe(front))
      return refuse("there is no room for the probe in front of the surface");
    held.hold = Status::Hold::probe;
    held.home = place(front), held.pressed = place(aim);
    return true;
  }

  static Vertex_index nearest_corner(const Mesh& mesh, const Surface_hit<Mesh>& hit) {
    if (hit.feature == Surface_feature::vertex)
      return hit.vertex;
    Vertex_index best;
    for (const Vertex_index v : mesh.vertices_around_face(mesh.halfedge(hit.face)))
      if (!best.is_valid() || CGAL::has_smaller_distance_to_point(hit.point, mesh.point(v), mesh.point(best)))
        best = v;
    return best;
  }

  static Edit creation(const Scene& scene, const Surface_hit<Mesh>& hit) {
    const Mesh& mesh = scene.mesh;
    const auto h = mesh.halfedge(hit.face);
    Edit wanted = creation_at(scene.sculptor, {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))},
                              drawing::to_eigen(hit.point));
    if (hit.feature == Surface_feature::edge)
      wanted.kind = Edit_kind::insert_on_edge,
      wanted.vertices = {scene.sculptor.id(mesh.vertex(hit.edge, 0)), scene.sculptor.id(mesh.vertex(hit.edge, 1)), 0};
    return wanted;
  }
};

/// Flips the edge that the mouse points at, or collapses it, its nearer end into the other.
class Edge_edit : public Window_task {
public:
  Edge_edit(const Pointer& pointer, bool flips) : pointer_(pointer), flips_(flips) {}

private:
  Pointer pointer_;
  bool flips_;

  bool work(Scene& scene, Tool_type& tool) override {
    tool.let_go();
    const auto h = pointed_edge(scene);
    if (!h.is_valid())
      return refuse("there is no edge here: point at one, on the surface");
    const auto kind = flips_ ? Edit_kind::flip : Edit_kind::collapse;
    return refuse_unless(tool.edit(edit_of(kind, scene, scene.mesh.source(h), scene.mesh.target(h))), scene,
                         flips_ ? "the edge cannot be flipped: " : "the edge cannot be collapsed: ");
  }

  /// From the end that is nearer to where the mouse points. \return the null index where it points at none
  Mesh::Halfedge_index pointed_edge(Scene& scene) const {
    const Hit hit = hit_of(scene, pointer_);
    if (!hit || hit->feature == Surface_feature::vertex)
      return {};
    const Mesh& mesh = scene.mesh;
    const auto h = hit->feature == Surface_feature::edge ? mesh.halfedge(hit->edge) : nearest_edge(mesh, *hit);
    const bool is_target_nearer =
        CGAL::has_smaller_distance_to_point(hit->point, mesh.point(mesh.target(h)), mesh.point(mesh.source(h)));
    return is_target_nearer ? mesh.opposite(h) : h;
  }

  /// Of the face that is met, in parts of the face's altitude on it.
  static Mesh::Halfedge_index nearest_edge(const Mesh& mesh, const Surface_hit<Mesh>& hit) {
    auto h = mesh.halfedge(hit.face), best = h;
    double least = std::numeric_limits<double>::infinity();
    const Eigen::Vector3d p = drawing::to_eigen(hit.point);
    for (int i = 0; i < 3; ++i, h = mesh.next(h)) {
      const Eigen::Vector3d a = drawing::to_eigen(mesh.point(mesh.source(h))),
                            b = drawing::to_eigen(mesh.point(mesh.target(h))),
                            c = drawing::to_eigen(mesh.point(mesh.target(mesh.next(h))));
      const Eigen::Vector3d along = (b - a).stableNormalized();
      const double height = along.cross(p - a).stableNorm() / along.cross(c - a).stableNorm();
      if (height < least)
        least = height, best = h;
    }
    return best;
  }
};

/// Lets go, and what is blocked slides or stops from here on.
class Choose_response : public Window_task {
public:
  explicit Choose_response(Response response) : response_(response) {}

private:
  Response response_;

  bool work(Scene& scene, Tool_type& tool) override {
    tool.let_go();
    scene.sculptor.set_drag_parameters(Drag_parameters(scene.sculptor.parameters().drag).response(response_));
    return true;
  }
};

/// The mesh, to be saved, with what its file had for each vertex.
class Save : public Copy_task<Scene> {
public:
  using Copy_task<Scene>::Copy_task;
  std::uint64_t edits = 0; ///< that are in it
  std::string opened;      ///< the file that it is of
  std::vector<std::string> left_out; ///< what that has besides

  /// \pre it is done, and the copy is whole
  Mesh mesh() const {
    Mesh mesh = copy.mesh<Mesh>();
    std::vector<std::size_t> order; // the mesh's vertices are in that of their numbers
    for (std::size_t v = 0; v < copy.ids.size(); ++v)
      if (copy.ids[v] != Scene_copy::absent)
        order.push_back(v);
    std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) { return copy.ids[a] < copy.ids[b]; });
    for (const Attribute& attribute : attributes_) {
      auto map = add_vertex_attribute(mesh, attribute.name, attribute.type).map;
      for (const Vertex_index v : mesh.vertices())
        map[v] = attribute.values[order[static_cast<std::size_t>(v)]];
    }
    return mesh;
  }

  /// Attributes, which no drag changes, all in the last tick.
  bool go_on(Scene& scene, Tool_type& tool) override {
    edits = scene.edits;
    if (!Copy_task<Scene>::go_on(scene, tool))
      return false;
    opened = scene.path, left_out = scene.left_out;
    for (const auto& [name, type, map] : vertex_attributes(scene.mesh)) {
      attributes_.push_back({name, type, {}});
      for (std::size_t v = 0; v < scene.mesh.num_vertices(); ++v)
        attributes_.back().values.push_back(map[Vertex_index(static_cast<Mesh::size_type>(v))]);
    }
    return true;
  }

private:
  struct Attribute {
    std::string name;
    Vertex_attribute::Type type;
    std::vector<double> values; ///< by index of vertex
  };
  std::vector<Attribute> attributes_;
};

} // namespace haptic_sculpt::window_program
