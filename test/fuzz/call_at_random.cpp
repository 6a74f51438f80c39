// SPDX-License-Identifier: GPL-3.0-or-later
#include <fuzz/call_at_random.h>

#include <fuzz/Random_arguments.h>
#include <fuzz/Watched_sculptor.h>
#include <sculpting/result_contradiction.h>

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/sculpting/decimate.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/vector_property_map.hpp>

#include <array>
#include <optional>
#include <vector>

namespace haptic_sculpt::fuzz {
namespace {

/// Makes public calls of a Sculptor and of the free functions, as the choices say.
class Caller {
public:
  using Mesh = meshes::Mesh;
  using Kernel = meshes::Kernel;
  using Point_3 = meshes::Point_3;
  using Vertex_index = Mesh::Vertex_index;
  using Sculptor_type = Watched_sculptor::Sculptor_type;

  Caller(Choices& choices, const Mesh& mesh, double unit, const Call_limits& limits, Call_tally& tally)
      : choices_(choices)
      , limits_(limits)
      , watched_(choices, mesh, unit, tally)
      , sculptor_(watched_.sculptor())
      , mesh_(watched_.mesh())
      , random_(choices, mesh_, unit)
      , is_by_value_(choices.below(4) == 0) {}

  /// Makes the calls and looks. Ends the program where a promise is broken.
  void run() {
    for (int i = 0; i < limits_.calls && !choices_.at_end() && mesh_.number_of_faces() < limits_.faces; ++i) {
      call();
      if (watched_.is_broken_off())
        return;
    }
    watched_.look(true);
    if (is_by_value_)
      watched_.make_again(made_);
    strokes_.clear();
    watched_.undo_and_redo_all(keeps_all_);
  }

private:
  Choices& choices_;
  const Call_limits limits_;
  Watched_sculptor watched_;
  Sculptor_type& sculptor_;
  const Mesh& mesh_;
  Random_arguments random_;
  const bool is_by_value_; ///< whether all edits are given by value, and made again in the end
  std::optional<Sculptor_type::Grab_type> grab_;
  std::optional<Sculptor_type::Probe_type> probe_;
  std::vector<Sculptor_type::Stroke_type> strokes_;
  std::vector<Edit> made_; ///< by value
  bool keeps_all_ = true;  ///< whether no history was limited
  Watched_sculptor::Call call_;

  template <class Function>
  void make(const Function& function) {
    watched_.make(call_, function);
  }
  void require(bool holds, const char* promise) const { watched_.require(holds, promise); }

  void result_of_drag(const Drag_result<Mesh>& result, const Point_3& source, const Point_3& target) {
    const internal::Rounding_to_nearest rounding; // where a caller flushes subnormal numbers any two are equal
    const char* const wrong = test::contradiction(result, source, target);
    require(wrong == nullptr, wrong);
  }

  void call();
  void call_for_many(std::size_t which);
};

inline void Caller::call() {
  call_ = {};
  call_.which = is_by_value_ ? 25 : choices_.below(38);
  switch (call_.which) {
  default: {
    const auto v = random_.vertex();
    const Point_3 to = random_.target(v), from = random_.lives(v) ? mesh_.point(v) : to;
    return make([&, drag = random_.drag_parameters()] {
      const auto result = sculptor_.drag(v, to, drag);
      result_of_drag(result, from, to);
      require(result.position == mesh_.point(v), "the result says where the vertex is");
    });
  }
  case 1:
    return make([&, v = random_.vertex()] { grab_.emplace(sculptor_.grab(v)); });
  case 2:
  case 3:
    if (grab_) {
      const Point_3 to = random_.target(grab_->vertex());
      make([&, drag = random_.drag_parameters()] {
        std::vector<Point_3> path;
        grab_->drag_to(to, path, drag);
      });
    }
    return;
  case 4:
    return make([&] { grab_.reset(); });
  case 5: {
    const auto v = random_.vertex();
    return make([&, to = random_.target(v)] {
      require(!sculptor_.move_if_free(v, to) || mesh_.point(v) == to, "it is there");
    });
  }
  case 6:
    return make([&, p = random_.point(), start = choices_.flag()] {
      probe_.emplace(sculptor_.probe(p, start ? Probe_start::anywhere : Probe_start::outside));
    });
  case 7:
    if (probe_)
      make([&, to = random_.target({})] { probe_->drag_to(to); });
    return;
  case 8:
  case 9: {
    const auto f = random_.face();
    return make([&, p = random_.in_face(f)] { sculptor_.insert_on_face(f, p); });
  }
  case 10: {
    const auto e = random_.edge();
    const Point_3 p = random_.lives(e) && choices_.below(4) != 0
                          ? CGAL::midpoint(mesh_.point(mesh_.vertex(e, 0)), mesh_.point(mesh_.vertex(e, 1)))
                          : random_.point();
    return make([&, q = choices_.flag() ? p : random_.near(p, -1)] { sculptor_.insert_on_edge(e, q); });
  }
  case 11:
    return make([&, v = random_.vertex()] { sculptor_.remove(v); });
  case 12:
    return make([&, h = random_.halfedge()] { sculptor_.collapse(h); });
  case 13:
    return make([&, e = random_.edge()] { sculptor_.flip(e); });
  case 14: {
    std::vector<std::pair<Vertex_index, double>> ways;
    const int axis = static_cast<int>(choices_.below(3));
    for (const auto v : random_.some_vertices())
      ways.emplace_back(v, choices_.flag() || !random_.lives(v)
                               ? random_.length()
                               : internal::coordinates(random_.near(mesh_.point(v)))[axis]);
    return make([&, parallel = choices_.flag()] {
      parallel ? sculptor_.shift<CGAL::Parallel_if_available_tag>(axis, ways) : sculptor_.shift(axis, ways);
    });
  }
  case 15:
  case 16:
    call_.restores = true;
    return make([&] { sculptor_.undo(); });
  case 17:
    call_.restores = true;
    return make([&] { sculptor_.redo(); });
  case 18:
    return make([&] { strokes_.push_back(sculptor_.stroke()); });
  case 19:
    if (!strokes_.empty())
      strokes_.pop_back();
    return;
  case 20:
    return make([&, p = random_.point(), within = random_.length(), v = random_.vertex()] {
      sculptor_.nearest_vertex(p, within);
      const auto one = sculptor_.first_impact(v, p), other = first_impact(mesh_, v, p);
      require(one.has_value() == other.has_value(), "an impact is found with a broad phase and without");
    });
  case 21:
    return make([&, p = random_.point(), q = random_.point()] { sculptor_.first_hit(p, q); });
  case 22: {
    Drag_parameters drag = sculptor_.parameters().drag;
    drag.clearance(choices_.flag() ? std::optional<double>() : std::optional<double>(random_.length()));
    drag.response(any_response(choices_));
    return make([&] { sculptor_.set_drag_parameters(drag); });
  }
  case 23:
    return make([&, delta = choices_.flag() ? 0 : std::abs(random_.length())] { sculptor_.set_delta(delta); });
  case 24:
    if (choices_.below(4) != 0)
      return make([&, n = choices_.below(64)] { sculptor_.reserve(n, n); });
    keeps_all_ = false;
    return make([&, limit = History_limit{choices_.below(4), choices_.byte() * 64u}] {
      sculptor_.set_history_limit(limit);
    });
  case 25: {
    Edit edit = Edit::of(static_cast<Edit_kind>(choices_.below(12)));
    const std::size_t numbers = sculptor_.number_of_ids();
    for (auto& v : edit.vertices)
      v = choices_.integer<std::uint16_t>() % (numbers + 1);
    if (const auto f = random_.face(); random_.lives(f) && choices_.below(4) != 0) { // for edits of elements
      const auto c = internal::corners_of_face(mesh_, f);
      for (int k = 0; k < 3; ++k)
        edit.vertices[k] = sculptor_.id(c[k]);
      edit.point = internal::coordinates(random_.in_face(f));
    } else
      edit.point = internal::coordinates(random_.point());
    if (edit.kind == Edit_kind::move && choices_.flag())
      edit.legs.push_back(internal::coordinates(random_.point()));
    edit.axis = static_cast<int>(choices_.below(3));
    if (edit.kind == Edit_kind::shift)
      edit.ways.emplace_back(choices_.integer<std::uint16_t>() % numbers, random_.length());
    call_.kind = edit.kind;
    call_.restores = edit.kind == Edit_kind::undo || edit.kind == Edit_kind::redo;
    call_.is_compound = !edit.legs.empty();
    std::optional<Edit> applied;
    make([&] { applied = std::move(sculptor_.apply(edit).edit); });
    if (applied)
      made_.push_back(*applied);
    return;
  }
  case 26: case 27: case 28: case 29: case 30: case 31: case 35:
    call_.is_compound = true;
    return call_for_many(call_.which - 26);
  case 32:
    if (choices_.flag())
      return make([&] { sculptor_.release(); });
    if (grab_ && choices_.flag()) {
      auto other = std::move(*grab_); // has the hand now
      return make([&] { *grab_ = std::move(other); });
    }
    if (grab_)
      make([&] { grab_->release(); });
    return;
  case 33:
    if (const auto map = watched_.one_more_map())
      make([&] { sculptor_.keep(*map, Interpolate_property()); });
    return;
  case 34: {
    const auto v = random_.vertex();
    if (!random_.lives(v)) // CGAL asks about those that are there
      return;
    return make([&, to = random_.target(v)] {
      auto& mesh = watched_.mesh_to_write();
      const auto allow = allow_embedded_move(sculptor_, mesh);
      const Point_3 before = mesh.point(v);
      mesh.point(v) = to;
      const bool is_allowed = allow(v, before, to);
      require(mesh.point(v) == (is_allowed ? to : before), "a move is made where it is allowed, and only there");
      require(allow.refused() == !is_allowed, "moves that are refused are counted");
    });
  }
  }
}

inline void Caller::call_for_many(std::size_t which) {
  boost::vector_property_map<Point_3> targets(mesh_.num_vertices() + 1);
  switch (which) {
  case 0: {
    const auto some = random_.some_vertices();
    const bool is_all_alike = choices_.flag();
    const double x = random_.length(), y = random_.length(), z = random_.length();
    for (const auto v : some)
      if (random_.lives(v))
        targets[v] = is_all_alike ? Point_3(mesh_.point(v).x() + x, mesh_.point(v).y() + y, mesh_.point(v).z() + z)
                                  : random_.target(v);
    return make([&, parameters = random_.move_parameters(), parallel = choices_.flag()] {
      parallel ? move_vertices<CGAL::Parallel_if_available_tag>(sculptor_, some, targets, parameters)
               : move_vertices(sculptor_, some, targets, parameters);
    });
  }
  case 1:
    for (const auto v : mesh_.vertices())
      targets[v] = choices_.below(3) == 0 ? random_.target(v) : mesh_.point(v);
    return make([&, parameters = random_.move_parameters()] {
      apply_guarded(
          sculptor_,
          [&](auto& mesh, auto map) {
            for (const auto v : mesh.vertices())
              put(map, v, targets[v]);
          },
          parameters);
    });
  case 2: {
    const auto dabs = random_.dabs();
    if (choices_.flag())
      return make([&] { apply_brush(sculptor_, dabs); });
    const auto shares = random_.mask();
    return make([&, parameters = random_.move_parameters()] {
      apply_brush(sculptor_, dabs, boost::make_function_property_map<Vertex_index>([&](Vertex_index v) {
                    return shares[v];
                  }),
                  parameters);
    });
  }
  case 3: {
    const auto some = random_.some_vertices();
    const auto by = random_.point() - CGAL::ORIGIN;
    CGAL::Aff_transformation_3<Kernel> way(CGAL::TRANSLATION, by);
    if (choices_.flag())
      way = CGAL::Aff_transformation_3<Kernel>(0.6, -0.8, 0, by.x(), 0.8, 0.6, 0, by.y(), 0, 0, 1, by.z());
    return make([&, parameters = random_.move_parameters(), parallel = choices_.flag()] {
      parallel ? move_rigidly<CGAL::Parallel_if_available_tag>(sculptor_, some, way, parameters)
               : move_rigidly(sculptor_, some, way, parameters);
    });
  }
  case 4: {
    std::vector<Mesh::Face_index> faces(mesh_.faces().begin(), mesh_.faces().end());
    if (choices_.flag())
      faces.resize(choices_.below(faces.size()));
    Remeshing_parameters parameters;
    parameters.most_faces(choices_.byte()).feature_angle(choices_.byte());
    if (choices_.flag())
      parameters.max_distance(random_.length());
    return make([&, edge = random_.length(), protects = choices_.flag(), relaxes = choices_.flag()] {
      isotropic_remeshing(faces, sculptor_, edge,
                          CGAL::parameters::protect_constraints(protects).relax_constraints(relaxes), parameters);
    });
  }
  case 9: {
    const std::size_t least = choices_.byte();
    const auto stop = [&](double, const auto&, std::size_t, std::size_t edges) { return edges <= least; };
    if (choices_.flag())
      return make([&] { decimate(sculptor_, stop); });
    return make([&] {
      namespace SMS = CGAL::Surface_mesh_simplification;
      decimate(sculptor_, stop, CGAL::parameters::get_cost(SMS::Edge_length_cost<Mesh>())
                                    .get_placement(SMS::Midpoint_placement<Mesh>()));
    });
  }
  default: {
    const auto v = random_.vertex();
    return make([&, to = random_.target(v), policy = static_cast<Guard_policy>(choices_.below(4))] {
      put(guarded_point_map(sculptor_, policy), v, to);
    });
  }
  }
}

} // namespace

bool call_at_random(Choices& choices, const meshes::Mesh& mesh, double unit, const Call_limits& limits,
                    Call_tally& tally) {
  std::optional<Caller> caller;
  try {
    caller.emplace(choices, mesh, unit, limits, tally);
  } catch (const Error&) { // too small a unit for it, or too large
    return false;
  }
  caller->run();
  return true;
}

} // namespace haptic_sculpt::fuzz
