// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/edits/random_edits.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace haptic_sculpt::test {

using Vector_3 = meshes::Kernel::Vector_3;

/// A mesh with all that is held of its Sculptor.
template <class Broad_phase>
struct World {
  using Sculptor_type = Sculptor<Mesh, Broad_phase>;

  Mesh mesh; ///< a copy: its arrays are exactly full
  Sculptor_type sculptor;
  std::optional<typename Sculptor_type::Grab_type> grab;
  std::optional<typename Sculptor_type::Probe_type> probe;
  std::optional<typename Sculptor_type::Stroke_type> stroke;

  World(const Mesh& original, const Sculptor_parameters& parameters) : mesh(original), sculptor(mesh, parameters) {}

  Point_3 beside(std::size_t v, double by) const {
    return mesh.point(Vertex_index(v)) + by * Vector_3(0.3, -0.2, 0.25);
  }
  void drag(std::size_t v, double by) { sculptor.grab(Vertex_index(v)).drag_to(beside(v, by)); }
  Mesh::Halfedge_index halfedge(std::size_t v) const { return mesh.halfedge(Vertex_index(v)); }
};

/// What is tried: `act` has each of its allocations fail, after `prepare`.
template <class World>
struct Case {
  const char* name;
  std::function<void(World&)> prepare, act;
  /// Whether it is several calls: then some may have been made.
  bool is_compound = false;
};

template <class World>
void nothing(World&) {}

/// Many changes of all kinds.
template <class World>
void change_much(World& w) {
  Random random(99);
  for (int i = 0; i < 60; ++i) {
    const std::size_t kind = random() % 6;
    const Vertex_index v = pick(w.mesh.vertices(), w.mesh.number_of_vertices(), random);
    const auto e = pick(w.mesh.edges(), w.mesh.number_of_edges(), random);
    const auto f = pick(w.mesh.faces(), w.mesh.number_of_faces(), random);
    switch (kind) {
    case 0: w.drag(v, 0.1); break;
    case 1: w.sculptor.insert_on_face(f, in_face(w.mesh, f, 0.3, 0.35)); break;
    case 2:
      w.sculptor.insert_on_edge(e,
                                CGAL::midpoint(w.mesh.point(w.mesh.vertex(e, 0)), w.mesh.point(w.mesh.vertex(e, 1))));
      break;
    case 3: w.sculptor.remove(v); break;
    case 4: w.sculptor.collapse(w.mesh.halfedge(v)); break;
    default: w.sculptor.flip(e);
    }
  }
}

template <class World>
std::vector<Case<World>> calls_that_allocate() {
  const auto insert_on_face = [](World& w) {
    w.sculptor.insert_on_face(Mesh::Face_index(5), in_face(w.mesh, Mesh::Face_index(5), 0.3, 0.3));
  };
  const auto insert_on_edge = [](World& w) {
    const auto e = w.mesh.edge(w.halfedge(7));
    w.sculptor.insert_on_edge(e, CGAL::midpoint(w.mesh.point(w.mesh.vertex(e, 0)), w.mesh.point(w.mesh.vertex(e, 1))));
  };
  const auto remove = [](World& w) { w.sculptor.remove(Vertex_index(13)); };
  const auto collapse = [](World& w) { w.sculptor.collapse(w.halfedge(9)); };
  const auto flip = [](World& w) { w.sculptor.flip(w.mesh.edge(w.halfedge(9))); };
  const auto drag = [](World& w) { w.drag(8, 0.1); };
  const auto push = [](World& w) { w.drag(8, -40); };
  const auto move = [](World& w) { w.sculptor.move_if_free(Vertex_index(8), w.beside(8, 0.05)); };
  // All along x: a little farther, and through each other, which is refused.
  const auto shift_by = [](World& w, double factor) {
    std::vector<std::pair<Vertex_index, double>> ways;
    for (const auto v : w.mesh.vertices())
      ways.emplace_back(v, w.mesh.point(v).x() * factor);
    w.sculptor.shift(0, ways);
  };
  const auto shift = [shift_by](World& w) { shift_by(w, 1.25); };
  const auto mirror = [shift_by](World& w) { shift_by(w, -1); };
  const auto by_value = [](auto edit) { return [edit](World& w) { w.sculptor.apply(edit(w)); }; };
  const auto take = [](World& w) { w.grab.emplace(w.sculptor.grab(Vertex_index(8))); };
  const auto undo = [](World& w) { w.sculptor.undo(); };
  const auto redo = [](World& w) { w.sculptor.redo(); };
  const auto begin_stroke = [](World& w) { w.stroke.emplace(w.sculptor.stroke()); };
  const auto stroke_of_much = [](World& w) {
    const auto stroke = w.sculptor.stroke();
    change_much(w);
  };
  using F = std::function<void(World&)>;
  const auto both = [](const F& a, const F& b) { return F([a, b](World& w) { a(w), b(w); }); };
  std::vector<Case<World>> cases = {
      {"grab", nothing<World>, take},
      {"begin of a stroke", nothing<World>, begin_stroke},
      {"drag in hand", take, [](World& w) { w.grab->drag_to(w.beside(8, 0.1)); }},
      {"long drag in hand", take, [](World& w) { w.grab->drag_to(w.beside(8, -40)); }},
      {"drag on", both(take, [](World& w) { w.grab->drag_to(w.beside(8, 0.1)); }),
       [](World& w) { w.grab->drag_to(w.beside(8, 0.3)); }},
      {"drag with its path", take,
       [](World& w) {
         std::vector<Point_3> path;
         w.grab->drag_to(w.beside(8, -40), path);
       }},
      {"end of a grab", both(take, [](World& w) { w.grab->drag_to(w.beside(8, 0.1)); }),
       [](World& w) { w.grab.reset(); }},
      {"release", both(take, [](World& w) { w.grab->drag_to(w.beside(8, 0.1)); }), [](World& w) { w.grab->release(); }},
      {"first impact", nothing<World>, [](World& w) { w.sculptor.first_impact(Vertex_index(8), w.beside(8, -40)); }},
      {"nearest vertex", drag, [](World& w) { w.sculptor.nearest_vertex(Point_3(2, 0, 0), 1e9); }},
      {"first hit", drag, [](World& w) { w.sculptor.first_hit(Point_3(2, 0, 0), Point_3(0, 0, 0)); }},
      {"probe", drag, [](World& w) { w.sculptor.probe(Point_3(2, 0.1, 0)); }},
      {"drag of a probe", [](World& w) { w.drag(8, 0.1), w.probe.emplace(w.sculptor.probe(Point_3(2, 0.1, 0))); },
       [](World& w) { w.probe->drag_to(Point_3(0, 0, 0.1)); }},
      {"set delta", drag, [](World& w) { w.sculptor.set_delta(1e-6); }},
      {"reserve", drag, [](World& w) { w.sculptor.reserve(50, 50); }},
      {"whole drag", nothing<World>, drag, true},
      {"whole push", nothing<World>, push, true},
      {"undo of many", stroke_of_much, undo},
      {"redo of many", both(stroke_of_much, undo), redo},
      {"undo of a stroke under way", both(begin_stroke, change_much<World>), undo},
      {"redo in a stroke", both(both(stroke_of_much, undo), begin_stroke), redo},
  };
  const std::pair<const char*, F> edits[] = {{"insert on face", insert_on_face},
                                             {"insert on edge", insert_on_edge},
                                             {"remove", remove},
                                             {"collapse", collapse},
                                             {"flip", flip},
                                             {"move if free", move},
                                             {"shift", shift},
                                             {"shift that is refused", mirror},
                                             {"drag by value", by_value([](World& w) {
                                                const Point_3 p = w.beside(8, -40);
                                                return Edit::of(Edit_kind::move, {8, 0, 0}, {p.x(), p.y(), p.z()});
                                              })},
                                             {"shift by value", by_value([](World& w) {
                                                Edit edit = Edit::of(Edit_kind::shift);
                                                for (std::size_t v = 0; v < 20; ++v)
                                                  edit.ways.emplace_back(v, w.beside(v, 0).x() + 0.125);
                                                return edit;
                                              })}};
  for (const auto& [name, edit] : edits) {
    cases.push_back({name, nothing<World>, edit});
    cases.push_back({name, begin_stroke, edit});
    cases.push_back({name, both(take, [](World& w) { w.grab->drag_to(w.beside(8, 0.1)); }), edit});
    cases.push_back({name, change_much<World>, edit});
    cases.push_back({"undo", edit, undo});
    cases.push_back({"undo", both(edit, [](World& w) { w.mesh.shrink_to_fit(); }), undo});
    cases.push_back({"redo", both(edit, undo), redo});
  }
  return cases;
}

} // namespace haptic_sculpt::test
