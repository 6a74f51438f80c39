// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "End_tally.h"
#include "Grab_record.h"

#include "sculpting/clearances.h"
#include "sculpting/response/end_certificate.h"
#include "sculpting/response/part_scenes.h"

#include <chrono>
#include <functional>
#include <string_view>

namespace haptic_sculpt::benchmark {

/// Drags vertices of one scene about, and certifies where each drag ends.
class Certified_grabs {
public:
  using Mesh = meshes::Mesh;
  using Point_3 = meshes::Point_3;
  using Vertex_index = Mesh::Vertex_index;
  using Miss_found = std::function<void(const Grab_record&, const std::string& what)>;

  /// \param is_kept whether what the drags do stays, else each grab is undone
  Certified_grabs(const test::Part_scene& scene, bool is_kept, std::uint64_t seed, std::size_t ways,
                  Miss_found miss_found)
      : scene_(scene)
      , random_(seed)
      , ways_(ways)
      , is_kept_(is_kept)
      , miss_found_(std::move(miss_found))
      , mesh_(scene.mesh)
      , sculptor_(mesh_, options())
      , certifier_(mesh_) {}

  End_tally run(std::size_t drags) {
    while (tally_.drags < drags)
      grab();
    return tally_;
  }

  /// One drag, told to `log` where it ends too early.
  static End_tally replay(const Grab_record& record, std::uint64_t seed, std::size_t ways, const Miss_found& log) {
    test::Part_scene scene;
    scene.mesh = record.mesh;
    Certified_grabs grabs(scene, true, seed, ways, log);
    if (record.clearance > 0)
      grabs.sculptor_.set_drag_parameters(Drag_parameters().clearance(record.clearance));
    grabs.sculptor_.set_delta(record.delta);
    grabs.record_ = record;
    grabs.record_.targets.clear();
    const auto drag_all = [&](auto&& held, Point_3 p) {
      for (const Point_3& t : record.targets)
        p = grabs.drag(held, record.vertex, p, t);
    };
    if (record.vertex.is_valid())
      drag_all(grabs.sculptor_.grab(record.vertex), record.mesh.point(record.vertex));
    else
      drag_all(grabs.sculptor_.probe(record.start, Probe_start::anywhere), record.start);
    return grabs.tally_;
  }

private:
  test::Part_scene scene_;
  test::Random random_;
  std::size_t ways_;
  bool is_kept_;
  Miss_found miss_found_;
  Mesh mesh_;
  Sculptor<Mesh> sculptor_;
  test::End_certifier certifier_;
  End_tally tally_;
  Grab_record record_;

  /// By default, of a size that can be seen, and now and then with the delta rule.
  Sculptor_parameters options() {
    Sculptor_parameters options;
    if (scene_.first_mover == 0)
      return options; // replayed
    if (random_() % 4 == 0) {
      double least = 0; // that serves the scene
      for (const auto v : scene_.mesh.vertices())
        least = std::max(
            least, internal::unit_in_the_last_place(internal::largest_magnitude(vertex_coordinates(scene_.mesh, v))));
      options.clearance(std::max(least, (scene_.is_near_degenerate ? 1e-14 : 1e-9) * scene_.size));
    }
    const double delta = 1e-3 * scene_.size;
    if (random_() % 8 == 0 && validate(scene_.mesh, delta).is_valid())
      options.delta(delta);
    return options;
  }

  void grab() {
    if (!scene_.probes.empty() && random_() % 4 == 0) {
      Point_3& place = scene_.probes[random_() % scene_.probes.size()];
      auto probe = sculptor_.probe(place, Probe_start::anywhere);
      if (!probe)
        return;
      record_ = {mesh_,
                 Vertex_index(),
                 place,
                 {},
                 sculptor_.parameters().drag.clearance_length.value_or(0),
                 sculptor_.parameters().delta_length};
      const Point_3 end = drag_some(probe, Vertex_index(), place);
      if (is_kept_)
        place = end;
      return;
    }
    Vertex_index v = test::part_vertex(scene_, mesh_, random_);
    if (random_() % 4 == 0) { // the tip of a new cone over a face
      const Mesh::Face_index f(static_cast<Mesh::size_type>(random_() % mesh_.num_faces()));
      if (!mesh_.is_removed(f)) {
        const auto h = mesh_.halfedge(f);
        const auto created =
            sculptor_.insert_on_face(f, CGAL::centroid(mesh_.point(mesh_.source(h)), mesh_.point(mesh_.target(h)),
                                                       mesh_.point(mesh_.target(mesh_.next(h)))));
        if (created)
          v = *created.vertex;
      }
    }
    record_ = {mesh_,
               v,
               {},
               {},
               sculptor_.parameters().drag.clearance_length.value_or(0),
               sculptor_.parameters().delta_length};
    {
      auto grab = sculptor_.grab(v);
      drag_some(grab, v, mesh_.point(v));
    }
    sculptor_.release();
    ++tally_.validations;
    tally_.invalid += !validate(mesh_, sculptor_.parameters().delta_length).is_valid();
    if (!is_kept_)
      while (sculptor_.undo())
        ;
  }

  /// \param v null: of a probe \return where it is then
  template <class Held>
  Point_3 drag_some(Held& held, Vertex_index v, Point_3 p) {
    p = drag(held, v, p, test::part_target(scene_, mesh_, v, p, random_));
    for (std::size_t more = random_() % 4; more > 0; --more)
      p = drag(held, v, p, test::part_target(scene_, mesh_, v, p, random_));
    return p;
  }

  template <class Held>
  Point_3 drag(Held& held, Vertex_index v, const Point_3& from, const Point_3& target) {
    using Clock = std::chrono::steady_clock;
    const auto nanoseconds = [](Clock::time_point since) {
      return std::chrono::duration<double, std::nano>(Clock::now() - since).count();
    };
    const double way_asked =
        internal::path_length({from.x(), from.y(), from.z()}, {target.x(), target.y(), target.z()});
    const auto begin = Clock::now();
    const auto r = held.drag_to(target);
    tally_.nanoseconds += nanoseconds(begin);
    const double c = test::clearance_kept(sculptor_, r);
    record_.targets.push_back(target);
    ++tally_.drags;
    tally_.reached += r.reached;
    if (r.reached)
      return r.position;
    tally_.at_leg_limit += r.end == Drag_end::leg_limit;
    const auto looked = Clock::now();
    const auto found =
        certifier_.certify(v, r.position, target, way_asked, c, sculptor_.parameters().delta_length, random_, ways_);
    tally_.certificate_nanoseconds += nanoseconds(looked);
    tally_.ways += found.ways;
    tally_.asked += found.asked;
    const bool gave_up = found.asked && std::string_view(name_of(r.end)) == "stuck";
    if (found.gain == 0 && !gave_up)
      return r.position;
    const double left = std::sqrt(CGAL::squared_distance(target, r.position));
    if (found.gain > 0) {
      ++tally_.missed;
      tally_.missed_random += found.is_random;
      tally_.largest_gain = std::max(tally_.largest_gain, found.gain / left);
    } else
      ++tally_.gave_up;
    std::ostringstream what;
    what << scene_.family << (is_kept_ ? ", deformed" : "") << ": " << name_of(r.end) << " after " << r.legs
         << " legs, residual " << r.kkt_residual << ", left " << left << " = " << left / c << " c; nearer by "
         << found.gain << " = " << 100 * found.gain / left << " % = " << found.gain / c << " c at "
         << Grab_record::hexadecimal(found.better) << (found.is_random ? " (random)" : " (near)") << "; at "
         << Grab_record::hexadecimal(r.position) << ", contacts";
    for (const auto& contact : r.contacts) {
      what << ' ' << name_of(contact.kind) << (contact.is_flat ? "(flat)" : "");
      for (const Vertex_index w : contact.vertices)
        what << (w == contact.vertices[0] ? ' ' : '-') << static_cast<std::size_t>(w);
      what << " (" << contact.normal[0] << ' ' << contact.normal[1] << ' ' << contact.normal[2] << ')';
    }
    miss_found_(record_, what.str());
    return r.position;
  }
};

} // namespace haptic_sculpt::benchmark
