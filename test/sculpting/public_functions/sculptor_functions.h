// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/public_functions/Scaled_scene.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

namespace haptic_sculpt::test {

/// Those of a Sculptor, and of what it gives: Grab and Stroke.
inline std::vector<Public_function> sculptor_functions() {
  std::vector<Public_function> all;
  for (const Response response : {Response::slide, Response::stop, Response::paper()})
    for (const double share : {1.25, 0.25, -1.75})
      all.push_back({"Sculptor::Sculptor Sculptor::grab Sculptor::mesh Sculptor::set_drag_parameters Grab::drag_to "
                     "Grab::vertex Grab::release",
                     [=](double unit, Outcome& outcome) {
                       Scaled_scene scene(unit);
                       Sculptor<Mesh> sculptor(scene.mesh);
                       sculptor.set_drag_parameters(Drag_parameters().response(response));
                       for (std::size_t i = 0; i < Scaled_scene::ball_size; i += 4) {
                         const Vertex_index v = Scaled_scene::vertex(i);
                         auto grab = sculptor.grab(v);
                         std::vector<Point_3> path;
                         outcome.drag(grab.drag_to(scene.beyond(v, share), path));
                         for (const Point_3& p : path)
                           outcome.point(p);
                         outcome.drag(grab.drag_to(scene.at(1.25, 0, 0.125)));
                         outcome.index(grab.vertex());
                         grab.release();
                       }
                       outcome.mesh(sculptor.mesh());
                     }});
  all.push_back({"Sculptor::move_if_free Sculptor::drag Sculptor::release", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   const auto once = Drag_parameters().response(Response::stop).once();
                   for (std::size_t i = 0; i < Scaled_scene::ball_size; ++i) {
                     const Vertex_index v = Scaled_scene::vertex(i);
                     for (const double share : {1.5, 0.75, -2.0})
                       outcome.number(sculptor.move_if_free(v, scene.beyond(v, share), once));
                     outcome.drag(sculptor.drag(v, scene.beyond(v, 0.5), once));
                   }
                   sculptor.release();
                   outcome.mesh(scene.mesh);
                 }});
  all.push_back({"Sculptor::first_impact", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   for (std::size_t i = 0; i < Scaled_scene::ball_size; i += 3) {
                     const auto first =
                         sculptor.first_impact(Scaled_scene::vertex(i), scene.beyond(Scaled_scene::vertex(i), -1.5));
                     outcome.number(first.has_value());
                     if (first)
                       outcome.impact(first->impact());
                   }
                 }});
  all.push_back(
      {"Sculptor::nearest_vertex Sculptor::first_hit Sculptor::is_inside_out", [](double unit, Outcome& outcome) {
         Scaled_scene scene(unit);
         Sculptor<Mesh> sculptor(scene.mesh);
         for (const double within : {0.0, 0.25, 1.0, 4.0, std::numeric_limits<double>::infinity()})
           for (const double x : {-2.0, -0.5, 0.0, 0.125, 1.25})
             outcome.index(sculptor.nearest_vertex(scene.at(x, 0.25, -x / 2), scene.length(within)));
         for (const Vertex_index v : scene.mesh.vertices())
           outcome.number(sculptor.is_inside_out(v));
         for (const double x : {-1.0, -0.5, 0.0, 0.25, 1.25, 2.0}) {
           const auto hit = sculptor.first_hit(scene.at(x, 0.25, 2), scene.at(0.125, x, -1.5));
           outcome.number(hit.has_value());
           if (!hit)
             continue;
           outcome.index(hit->vertex), outcome.index(hit->edge), outcome.index(hit->face);
           outcome.number(hit->time), outcome.point(hit->point);
         }
       }});
  all.push_back({"Sculptor::probe Probe::drag_to Probe::position Probe::refusal", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   for (const double x : {-0.5, 0.0, 0.25, 1.0, 1.75})
                     for (const double y : {1.75, 0.125}) {
                       auto probe = sculptor.probe(scene.at(x, y, 0.5));
                       outcome.number(probe.refusal() ? static_cast<double>(probe.refusal()->reason) : -1);
                       std::vector<Point_3> path;
                       outcome.drag(probe.drag_to(scene.at(x / 2, -1.5, 0.25), path));
                       for (const Point_3& p : path)
                         outcome.point(p);
                       outcome.drag(probe.drag_to(scene.at(x, 0, 0)));
                       outcome.point(probe.position());
                     }
                   outcome.number(bool(sculptor.probe(scene.mesh.point(Scaled_scene::vertex(0)))));
                   outcome.number(bool(sculptor.probe(scene.at(0, 0, 0), Probe_start::anywhere)));
                   outcome.mesh(scene.mesh);
                 }});
  all.push_back({"Sculptor::apply Sculptor::halfedge_of", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   const auto told = [&](const Edit& edit) {
                     const auto done = sculptor.apply(edit);
                     outcome.edit(done);
                     if (done.drag)
                       outcome.drag(*done.drag);
                     for (const auto& leg : done.edit.legs)
                       outcome.point(Point_3(leg[0], leg[1], leg[2]));
                   };
                   for (const std::size_t v : {0, 7, 20}) {
                     const Point_3 p = scene.beyond(Scaled_scene::vertex(v), -1.5);
                     told(Edit::of(Edit_kind::move, {v, 0, 0}, {p.x(), p.y(), p.z()}));
                     told(Edit::of(Edit_kind::remove, {v + 1, 0, 0}));
                   }
                   Edit shift = Edit::of(Edit_kind::shift);
                   for (const std::size_t v : {3, 4, 5})
                     shift.ways.emplace_back(v, scene.length(0.125 * static_cast<double>(v)));
                   told(shift);
                   outcome.number(sculptor.halfedge_of(2, 3).is_valid());
                   outcome.mesh(scene.mesh);
                 }});
  all.push_back({"Sculptor::insert_on_face Sculptor::insert_on_edge Sculptor::remove Sculptor::collapse Sculptor::flip "
                 "Sculptor::undo "
                 "Sculptor::redo Sculptor::reserve Sculptor::keep",
                 [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   sculptor.reserve(10, 10);
                   auto heights = scene.mesh.add_property_map<Vertex_index, double>("v:height", 0).first;
                   for (const Vertex_index v : scene.mesh.vertices())
                     heights[v] = scene.mesh.point(v).z();
                   sculptor.keep(heights, Interpolate_property());
                   const Mesh& mesh = sculptor.mesh();
                   for (int round = 0; round < 4; ++round) {
                     const auto f = *std::next(mesh.faces().begin(), 7 * round + 1);
                     const auto c = internal::corners_of_face(mesh, f);
                     outcome.edit(sculptor.insert_on_face(f, scene.beyond(c[0], 1.125)));
                     outcome.edit(sculptor.insert_on_face(f, scene.beyond(c[0], 0.875)));
                     const auto e = *std::next(mesh.edges().begin(), 11 * round + 2);
                     outcome.edit(sculptor.insert_on_edge(e, scene.middle(mesh.vertex(e, 0), mesh.vertex(e, 1))));
                     for (int k = 0; k < 4; ++k) {
                       outcome.edit(sculptor.remove(Scaled_scene::vertex(5 * round + k)));
                       outcome.edit(sculptor.flip(*std::next(mesh.edges().begin(), 13 * round + 3 * k)));
                       outcome.edit(sculptor.collapse(*std::next(mesh.halfedges().begin(), 17 * round + 5 * k)));
                     }
                     outcome.edit(sculptor.undo());
                     outcome.edit(sculptor.undo());
                     outcome.edit(sculptor.redo());
                     outcome.mesh(mesh);
                     for (const Vertex_index v : mesh.vertices())
                       outcome.length(heights[v]);
                   }
                 }});
  all.push_back({"Sculptor::shift", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   for (int axis = 0; axis < 3; ++axis)
                     for (const double share : {0.5, -2.0, 1.75}) { // a mirror is refused
                       std::vector<std::pair<Vertex_index, double>> ways;
                       for (std::size_t i = 0; i < Scaled_scene::ball_size; ++i) {
                         const Vertex_index v = Scaled_scene::vertex(i);
                         ways.emplace_back(v, internal::coordinates(scene.beyond(v, share, -0.25))[axis]);
                       }
                       outcome.edit(sculptor.shift(axis, ways));
                       outcome.mesh(scene.mesh);
                     }
                   outcome.edit(sculptor.undo());
                   outcome.mesh(scene.mesh);
                 }});
  all.push_back({"Sculptor::set_delta Sculptor::clearance Sculptor::parameters", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh, parameters::response(Response::stop));
                   sculptor.set_delta(scene.length(0.015625));
                   outcome.length(sculptor.parameters().delta_length);
                   auto drag = Drag_parameters(sculptor.parameters().drag).work_limit(300);
                   const auto drags = [&](double share) {
                     for (std::size_t i = 1; i < Scaled_scene::ball_size; i += 5)
                       outcome.drag(sculptor.grab(Scaled_scene::vertex(i))
                                        .drag_to(scene.beyond(Scaled_scene::vertex(i), share), drag));
                   };
                   drags(-1);
                   drag.clearance(scene.length(0x1p-12));
                   sculptor.set_drag_parameters(drag);
                   outcome.length(sculptor.clearance(scene.at(1, 0, 0)));
                   drag.response(Response::slide);
                   drags(-0.5);
                   sculptor.set_drag_parameters(drag.clearance(std::nullopt));
                   outcome.length(sculptor.clearance(scene.at(1, 0.5, 0)));
                   drags(1.25);
                   bool is_refused = false;
                   try {
                     sculptor.set_delta(scene.length(0.25));
                   } catch (const Invalid_surface&) {
                     is_refused = true;
                   }
                   outcome.number(is_refused);
                   outcome.mesh(scene.mesh);
                 }});
  all.push_back({"Sculptor::stroke Sculptor::history Sculptor::set_history_limit Sculptor::forget_history "
                 "Sculptor::check_unchanged Stroke::end "
                 "Stroke::is_open "
                 "Sculptor::id Sculptor::vertex Sculptor::number_of_ids Sculptor::face_of Sculptor::edge_of "
                 "Sculptor::visitor "
                 "Sculptor::filter_counters Sculptor::memory",
                 [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   sculptor.set_history_limit(History_limit{10});
                   sculptor.forget_history();
                   auto stroke = sculptor.stroke();
                   sculptor.grab(Scaled_scene::vertex(3)).drag_to(scene.beyond(Scaled_scene::vertex(3), 1.25));
                   sculptor.grab(Scaled_scene::vertex(9)).drag_to(scene.beyond(Scaled_scene::vertex(9), 0.5));
                   outcome.number(stroke.is_open());
                   stroke.end();
                   outcome.number(stroke.is_open());
                   outcome.number(static_cast<double>(sculptor.history().number_of_undo_steps()));
                   outcome.number(static_cast<double>(sculptor.id(sculptor.vertex(5)) + sculptor.number_of_ids()));
                   outcome.index(sculptor.edge_of(0, 1)), outcome.index(sculptor.face_of(0, 1, 2));
                   sculptor.visitor().vertex_moved(Scaled_scene::vertex(0));
                   outcome.number(sculptor.memory() > 0);
                   sculptor.filter_counters();
                   sculptor.check_unchanged();
                   sculptor.undo();
                   outcome.mesh(scene.mesh);
                 }});
  return all;
}

} // namespace haptic_sculpt::test
