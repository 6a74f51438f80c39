// SPDX-License-Identifier: GPL-3.0-or-later
#include <fuzz/call_at_random.h>

#include <fuzz/require.h>
#include <oracle/exact_triangles.h>
#include <sculpting/Mesh_snapshot.h>
#include <sculpting/edits/failing_allocations.h>
#include <sculpting/public_functions/Callers_mode.h>
#include <sculpting/result_contradiction.h>

#include <haptic_sculpt/sculpting.h>

#include <boost/property_map/vector_property_map.hpp>

#include <map>
#include <optional>

namespace haptic_sculpt::fuzz {
namespace {

/// What a visitor or a progress function throws.
struct Thrown {};

/// Throws in the call that makes `*left` 0; never where it is 0 already.
struct Throwing_visitor {
  std::size_t* left;

  template <class... Arguments>
  void told(const Arguments&...) {
    if (*left != 0 && --*left == 0)
      throw Thrown();
  }
  template <class Vertex>
  void vertex_moved(Vertex v) { told(v); }
  template <class Vertex>
  void vertex_dies(Vertex v, std::size_t number) { told(v, number); }
  template <class Edge>
  void edge_dies(Edge e) { told(e); }
  template <class Face>
  void face_dies(Face f) { told(f); }
  template <class Vertex>
  void vertex_created(Vertex v, std::size_t number) { told(v, number); }
  template <class Edge>
  void edge_created(Edge e) { told(e); }
  template <class Face>
  void face_created(Face f) { told(f); }
};

/// Makes public calls of a Sculptor and of the free functions, as the choices say, with memory that runs out, visitors
/// that throw, and callers' modes of rounding; after each it looks whether all promises hold.
class Caller {
public:
  using Mesh = meshes::Mesh;
  using Kernel = meshes::Kernel;
  using Point_3 = meshes::Point_3;
  using Vertex_index = Mesh::Vertex_index;
  using Sculptor_type = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor>;

  Caller(Choices& choices, const Mesh& mesh, double unit, const Call_limits& limits, Call_tally& tally)
      : choices_(choices)
      , unit_(unit)
      , limits_(limits)
      , tally_(tally)
      , at_first_(mesh)
      , mesh_(mesh)
      , heat_(mesh_.add_property_map<Vertex_index, double>("v:heat", 0).first)
      , label_(mesh_.add_property_map<Mesh::Face_index, std::int64_t>("f:label", 0).first)
      , parameters_(Sculptor_parameters().response(static_cast<Response>(choices.below(3))))
      , is_by_value_(choices.below(4) == 0)
      , sculptor_(mesh_, parameters_, Throwing_visitor{&visits_left_}) {
    for (const auto v : mesh_.vertices())
      heat_[v] = static_cast<double>(v.idx());
    for (const auto f : mesh_.faces())
      label_[f] = f.idx();
    sculptor_.keep(heat_, Interpolate_property());
    sculptor_.keep(label_);
    start_ = seen();
    ++tally_.guarded;
  }

  /// Makes the calls and looks. Ends the program where a promise is broken.
  void run() {
    for (int i = 0; i < limits_.calls && !choices_.at_end() && mesh_.number_of_faces() < limits_.faces; ++i) {
      call();
      if (is_broken_off_)
        return;
    }
    look(true);
    if (is_by_value_ && is_recorded_)
      make_again();
    undo_and_redo_all();
  }

private:
  /// All that can be seen of the mesh: points, faces, values.
  struct Seen {
    test::Mesh_snapshot mesh;
    std::map<std::size_t, double> heat;
    bool operator==(const Seen& other) const { return mesh == other.mesh && heat == other.heat; }
  };

  Choices& choices_;
  const double unit_;
  const Call_limits limits_;
  Call_tally& tally_;
  const Mesh at_first_;
  Mesh mesh_;
  Mesh::Property_map<Vertex_index, double> heat_;
  Mesh::Property_map<Mesh::Face_index, std::int64_t> label_;
  std::size_t visits_left_ = 0;
  const Sculptor_parameters parameters_;
  const bool is_by_value_; ///< whether all edits are given by value, and made again in the end
  Sculptor_type sculptor_;
  std::optional<Sculptor_type::Grab_type> grab_;
  std::optional<Sculptor_type::Probe_type> probe_;
  std::vector<Sculptor_type::Stroke_type> strokes_;
  Seen start_;
  std::vector<Edit> made_;     ///< by value
  bool is_recorded_ = true;    ///< whether these are all: not where an exception came from a change that was made
  bool keeps_all_ = true;      ///< whether no history was limited
  std::size_t which_ = 0;      ///< the call, as call() numbers them
  Edit_kind kind_ = Edit_kind::none; ///< of an edit by value
  bool is_compound_ = false;   ///< whether the call makes several steps
  bool restores_ = false;      ///< whether the call is undo or redo
  bool is_broken_off_ = false; ///< whether the Sculptor refuses for good

  Seen seen() const {
    Seen all{test::snapshot(sculptor_), {}};
    for (const auto v : mesh_.vertices())
      all.heat[sculptor_.id(v)] = heat_[v];
    return all;
  }

  /// Says which call it was where a promise is broken.
  void require(bool holds, const char* promise) const {
    if (!holds)
      std::fprintf(stderr, "call %zu, by value %d, unit %a\n", which_, static_cast<int>(kind_), unit_);
    fuzz::require(holds, promise);
  }

  /// \name What calls are made with
  ///@{

  double length() { return choices_.number() * unit_; }
  /// Elements that are there, mostly; one behind the last, or dead, now and then.
  template <class Index>
  Index element(std::size_t slots) {
    const std::size_t k = slots < 200 ? choices_.byte() : choices_.integer<std::uint16_t>() % (2 * slots);
    return k == 255 ? Index() : Index(static_cast<Mesh::size_type>(k % (slots + (k % 64 == 63))));
  }
  Vertex_index vertex() { return element<Vertex_index>(mesh_.num_vertices()); }
  Mesh::Edge_index edge() { return element<Mesh::Edge_index>(mesh_.num_edges()); }
  Mesh::Halfedge_index halfedge() { return element<Mesh::Halfedge_index>(mesh_.num_halfedges()); }
  Mesh::Face_index face() { return element<Mesh::Face_index>(mesh_.num_faces()); }
  template <class Index>
  bool lives(Index i) const { return mesh_.has_valid_index(i) && !mesh_.is_removed(i); }

  Point_3 near(const Point_3& p, int farthest = 0) {
    const double by = std::ldexp(unit_, farthest - static_cast<int>(choices_.below(60)));
    const double x = choices_.number(), y = choices_.number(), z = choices_.number();
    return {p.x() + x * by, p.y() + y * by, p.z() + z * by};
  }
  Point_3 point() {
    const double x = length(), y = length(), z = length();
    return {x, y, z};
  }
  Point_3 target(Vertex_index v) {
    const Vertex_index w = vertex();
    switch (choices_.below(4)) {
    case 0: // another vertex
      return lives(w) ? mesh_.point(w) : Point_3(0, 0, 0);
    case 1:
      return near(lives(v) ? mesh_.point(v) : Point_3(0, 0, 0));
    default:
      return point();
    }
  }
  Point_3 in_face(Mesh::Face_index f) {
    if (!lives(f) || choices_.below(4) == 0)
      return point();
    const auto c = internal::corners_of_face(mesh_, f);
    const double a = static_cast<double>(choices_.below(17)) / 16, b = static_cast<double>(choices_.below(17)) / 32;
    const Point_3 p = mesh_.point(c[0]);
    const Point_3 q = p + a * (mesh_.point(c[1]) - p) + b * (mesh_.point(c[2]) - p);
    return choices_.flag() ? q : near(q, -1);
  }
  std::optional<Drag_parameters> drag_parameters() {
    if (choices_.below(3) != 0)
      return std::nullopt;
    Drag_parameters drag;
    drag.response(static_cast<Response>(choices_.below(3))).once(choices_.flag());
    if (choices_.below(4) == 0)
      drag.clearance(length());
    if (choices_.below(4) == 0)
      drag.work_limit(choices_.integer<std::uint16_t>());
    return drag;
  }
  std::vector<Vertex_index> some_vertices() {
    std::vector<Vertex_index> some;
    if (choices_.flag())
      some.assign(mesh_.vertices().begin(), mesh_.vertices().end());
    else
      for (std::size_t n = choices_.below(6); n > 0; --n)
        some.push_back(vertex());
    return some;
  }
  Move_parameters move_parameters() {
    Move_parameters move;
    move.most_drags(choices_.byte() * 8u).steps(choices_.below(4) != 0).drags(choices_.flag()).slide(choices_.flag());
    if (choices_.below(4) == 0)
      move.progress([left = choices_.byte()](const Move_progress&) mutable {
        if (left % 2 == 1 && left < 3)
          throw Thrown();
        return left == 0 || --left > 0;
      });
    return move;
  }
  ///@}

  /// One call: with what has been read, in a mode, with failures.
  template <class Function>
  void make(const Function& function) {
    const std::uint8_t mode = choices_.byte(), failure = choices_.byte();
    constexpr int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    const bool fails = failure % 8 == 1, fails_for_good = failure & 8, throws = failure % 8 == 2;
    const std::size_t nth = 1 + (failure >> 4) + (fails || throws ? choices_.below(32) : 0);
    const Seen before = seen();
    const auto steps = [this] {
      const auto history = sculptor_.history();
      return std::pair(history.number_of_undo_steps(), history.number_of_redo_steps());
    };
    const auto steps_before = steps();
    bool lacked_memory = false, was_thrown = false, stands = true;
    ++tally_.calls;
    const auto call_it = [&] {
      std::optional<test::Failing_allocations> failing;
      if (fails)
        failing.emplace(nth, fails_for_good);
      function();
    };
    {
      const test::Callers_mode callers_mode(modes[mode % 4], mode % 32 >= 28);
      visits_left_ = throws ? nth : 0;
      try {
        call_it();
        ++tally_.done;
      } catch (const Unfinished_change&) {
        is_broken_off_ = true;
      } catch (const Error& error) {
        require(std::strstr(error.what(), "fault of haptic_sculpt") == nullptr, error.what());
        ++tally_.refused;
      } catch (const std::bad_alloc&) {
        lacked_memory = true, ++tally_.out_of_memory;
      } catch (const Thrown&) {
        was_thrown = true, ++tally_.thrown;
      }
      visits_left_ = 0;
      stands = callers_mode.stands();
    }
    require(stands, "the caller's mode of rounding stands");
    require(!lacked_memory || fails, "memory runs out only where it does");
    bool refuses = is_broken_off_;
    try {
      sculptor_.check_unchanged();
    } catch (const Unfinished_change&) {
      refuses = true;
    }
    if (refuses) { // every call from now on
      require(fails_for_good && (restores_ || is_compound_),
              "a change is broken off only where memory runs out again while a step is taken back");
      is_broken_off_ = true, ++tally_.broken_off;
      return;
    }
    if (lacked_memory && !is_compound_) {
      require(seen() == before, "where memory ran out all is as it was");
      require(steps() == steps_before || !strokes_.empty(), "where memory ran out the history is as it was");
    }
    is_recorded_ = is_recorded_ && !was_thrown && !(lacked_memory && is_compound_);
    look(choices_.below(4) == 0);
  }

  /// Whether the surface is valid, by the library's oracle and by one that shares nothing with it, and numbers last.
  void look(bool by_integers) {
    require(mesh_.is_valid(false), "connectivity is consistent");
    const auto report = validate(mesh_);
    require(report.is_valid(), report.message().c_str());
    for (const auto v : mesh_.vertices())
      require(sculptor_.vertex(sculptor_.id(v)) == v, "numbers lead back");
    if (!by_integers || mesh_.number_of_faces() > 16)
      return;
    oracle::Mesh_list list;
    std::map<Vertex_index, int> place;
    for (const auto v : mesh_.vertices()) {
      place[v] = static_cast<int>(list.points.size());
      list.points.push_back(vertex_coordinates(mesh_, v));
    }
    for (const auto f : mesh_.faces()) {
      const auto c = internal::corners_of_face(mesh_, f);
      list.faces.push_back({place[c[0]], place[c[1]], place[c[2]]});
    }
    require(oracle::improper_pairs(list).empty(), "no two faces meet improperly, by integers");
  }

  void undo_and_redo_all() {
    strokes_.clear();
    const Seen end = seen();
    std::size_t undone = 0;
    while (sculptor_.undo())
      ++undone;
    if (keeps_all_)
      require(seen() == start_, "undo of all gives the bits of the start");
    look(false);
    for (; undone > 0; --undone)
      require(static_cast<bool>(sculptor_.redo()), "what was undone can be redone");
    require(seen().mesh == end.mesh, "redo of all gives the bits of the end");
  }

  /// What was made by value, made in another Sculptor, gives the same bits.
  void make_again() {
    Mesh copy = at_first_;
    Sculptor<Mesh> other(copy, parameters_);
    for (const Edit& edit : made_)
      other.apply(edit);
    const auto number = [&](Vertex_index v) { return other.id(v); };
    require(test::snapshot_of(copy, number) == seen().mesh, "edits by value, made again, give the same bits");
    ++tally_.made_again;
  }

  void result_of_drag(const Drag_result<Mesh>& result, const Point_3& source, const Point_3& target) {
    const char* const wrong = test::contradiction(result, source, target);
    require(wrong == nullptr, wrong);
  }

  void call();
  void call_for_many(std::size_t which);
};

inline void Caller::call() {
  is_compound_ = restores_ = false;
  which_ = is_by_value_ ? 25 : choices_.below(32);
  kind_ = Edit_kind::none;
  switch (which_) {
  default: {
    const auto v = vertex();
    const Point_3 to = target(v), from = lives(v) ? mesh_.point(v) : to;
    return make([&, drag = drag_parameters()] {
      const auto result = sculptor_.drag(v, to, drag);
      result_of_drag(result, from, to);
      require(result.position == mesh_.point(v), "the result says where the vertex is");
    });
  }
  case 1:
    return make([&, v = vertex()] { grab_.emplace(sculptor_.grab(v)); });
  case 2:
  case 3:
    if (grab_) {
      const Point_3 to = target(grab_->vertex());
      make([&, drag = drag_parameters()] {
        std::vector<Point_3> path;
        grab_->drag_to(to, path, drag);
      });
    }
    return;
  case 4:
    return make([&] { grab_.reset(); });
  case 5: {
    const auto v = vertex();
    return make([&, to = target(v)] { require(!sculptor_.move_if_free(v, to) || mesh_.point(v) == to, "it is there"); });
  }
  case 6:
    return make([&, p = point(), start = choices_.flag()] {
      probe_.emplace(sculptor_.probe(p, start ? Probe_start::anywhere : Probe_start::outside));
    });
  case 7:
    if (probe_)
      make([&, to = target({})] { probe_->drag_to(to); });
    return;
  case 8:
  case 9: {
    const auto f = face();
    return make([&, p = in_face(f)] { sculptor_.insert_on_face(f, p); });
  }
  case 10: {
    const auto e = edge();
    const Point_3 p = lives(e) && choices_.below(4) != 0
                          ? CGAL::midpoint(mesh_.point(mesh_.vertex(e, 0)), mesh_.point(mesh_.vertex(e, 1)))
                          : point();
    return make([&, q = choices_.flag() ? p : near(p, -1)] { sculptor_.insert_on_edge(e, q); });
  }
  case 11:
    return make([&, v = vertex()] { sculptor_.remove(v); });
  case 12:
    return make([&, h = halfedge()] { sculptor_.collapse(h); });
  case 13:
    return make([&, e = edge()] { sculptor_.flip(e); });
  case 14: {
    std::vector<std::pair<Vertex_index, double>> ways;
    const int axis = static_cast<int>(choices_.below(3));
    for (const auto v : some_vertices())
      ways.emplace_back(v, choices_.flag() || !lives(v) ? length() : internal::coordinates(near(mesh_.point(v)))[axis]);
    return make([&] { sculptor_.shift(axis, ways); });
  }
  case 15:
  case 16:
    restores_ = true;
    return make([&] { sculptor_.undo(); });
  case 17:
    restores_ = true;
    return make([&] { sculptor_.redo(); });
  case 18:
    return make([&] { strokes_.push_back(sculptor_.stroke()); });
  case 19:
    if (!strokes_.empty())
      strokes_.pop_back();
    return;
  case 20:
    return make([&, p = point(), within = length(), v = vertex()] {
      sculptor_.nearest_vertex(p, within);
      const auto one = sculptor_.first_impact(v, p), other = first_impact(mesh_, v, p);
      require(one.has_value() == other.has_value(), "an impact is found with a broad phase and without");
    });
  case 21:
    return make([&, p = point(), q = point()] { sculptor_.first_hit(p, q); });
  case 22: {
    Drag_parameters drag = sculptor_.parameters().drag;
    drag.clearance(choices_.flag() ? std::optional<double>() : std::optional<double>(length()));
    drag.response(static_cast<Response>(choices_.below(3)));
    return make([&] { sculptor_.set_drag_parameters(drag); });
  }
  case 23:
    return make([&, delta = choices_.flag() ? 0 : std::abs(length())] { sculptor_.set_delta(delta); });
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
    if (const auto f = face(); lives(f) && choices_.below(4) != 0) { // corners of a face, for edits of elements
      const auto c = internal::corners_of_face(mesh_, f);
      for (int k = 0; k < 3; ++k)
        edit.vertices[k] = sculptor_.id(c[k]);
      edit.point = internal::coordinates(in_face(f));
    } else
      edit.point = internal::coordinates(point());
    if (edit.kind == Edit_kind::move && choices_.flag())
      edit.legs.push_back(internal::coordinates(point()));
    edit.axis = static_cast<int>(choices_.below(3));
    if (edit.kind == Edit_kind::shift)
      edit.ways.emplace_back(choices_.integer<std::uint16_t>() % numbers, length());
    kind_ = edit.kind;
    restores_ = edit.kind == Edit_kind::undo || edit.kind == Edit_kind::redo;
    is_compound_ = !edit.legs.empty();
    std::optional<Edit> applied;
    make([&] { applied = std::move(sculptor_.apply(edit).edit); });
    if (applied)
      made_.push_back(*applied);
    return;
  }
  case 26: case 27: case 28: case 29: case 30: case 31:
    is_compound_ = true;
    return call_for_many(which_ - 26);
  }
}

inline void Caller::call_for_many(std::size_t which) {
  boost::vector_property_map<Point_3> targets(mesh_.num_vertices() + 1);
  switch (which) {
  case 0: {
    const auto some = some_vertices();
    const bool is_all_alike = choices_.flag();
    const double x = length(), y = length(), z = length();
    for (const auto v : some)
      if (lives(v))
        targets[v] = is_all_alike ? Point_3(mesh_.point(v).x() + x, mesh_.point(v).y() + y, mesh_.point(v).z() + z)
                                  : target(v);
    return make([&, parameters = move_parameters()] { move_vertices(sculptor_, some, targets, parameters); });
  }
  case 1:
    for (const auto v : mesh_.vertices())
      targets[v] = choices_.below(3) == 0 ? target(v) : mesh_.point(v);
    return make([&, parameters = move_parameters()] {
      apply_guarded(
          sculptor_,
          [&](auto& mesh, auto map) {
            for (const auto v : mesh.vertices())
              put(map, v, targets[v]);
          },
          parameters);
    });
  case 2: {
    Dab_3<Kernel> dab{static_cast<Brush_kind>(choices_.below(5)), point(), length(), length(), {}};
    if (choices_.flag())
      dab.direction = point() - CGAL::ORIGIN;
    return make([&] { apply_brush(sculptor_, std::array<Dab_3<Kernel>, 1>{dab}); });
  }
  case 3: {
    const auto some = some_vertices();
    const auto by = point() - CGAL::ORIGIN;
    CGAL::Aff_transformation_3<Kernel> way(CGAL::TRANSLATION, by);
    if (choices_.flag())
      way = CGAL::Aff_transformation_3<Kernel>(0.6, -0.8, 0, by.x(), 0.8, 0.6, 0, by.y(), 0, 0, 1, by.z());
    return make([&] { move_rigidly(sculptor_, some, way); });
  }
  case 4: {
    std::vector<Mesh::Face_index> faces(mesh_.faces().begin(), mesh_.faces().end());
    if (choices_.flag())
      faces.resize(choices_.below(faces.size()));
    Remeshing_parameters parameters;
    parameters.most_faces(choices_.byte()).feature_angle(choices_.byte());
    if (choices_.flag())
      parameters.max_distance(length());
    return make([&, edge = length(), protects = choices_.flag(), relaxes = choices_.flag()] {
      isotropic_remeshing(faces, sculptor_, edge,
                          CGAL::parameters::protect_constraints(protects).relax_constraints(relaxes), parameters);
    });
  }
  default: {
    const auto v = vertex();
    return make([&, to = target(v), policy = static_cast<Guard_policy>(choices_.below(4))] {
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
