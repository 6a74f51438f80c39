// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SCULPTOR_H
#define HAPTIC_SCULPT_SCULPTING_SCULPTOR_H

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/sculpting/Grab.h>
#include <haptic_sculpt/sculpting/Sculptor_parameters.h>
#include <haptic_sculpt/sculpting/Stroke.h>
#include <haptic_sculpt/sculpting/contact/is_within_distance.h>
#include <haptic_sculpt/sculpting/edits/Editor.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/sculpting/first_impact.h>
#include <haptic_sculpt/sculpting/motion/Guarded_star.h>
#include <haptic_sculpt/sculpting/response/Responses.h>
#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/reserve_faces.h>
#include <haptic_sculpt/surface/validate.h>

#include <CGAL/Surface_mesh.h>

namespace haptic_sculpt {

/// A parameter outside of its range, e.g. a negative clearance.
class Invalid_parameter : public Error {
public:
  using Error::Error;
};

/// Guards a mesh: embedded in, embedded out, whatever is dragged where.
///
/// \tparam Mesh_ `CGAL::Surface_mesh<K::Point_3>` with K::FT = double
/// \tparam Broad_phase_ a model of BroadPhase (doc/broad_phase.md); no result depends on the choice
/// \tparam Visitor_ a model of EditVisitor (Default_edit_visitor), told of moved, created and dead elements
///
/// Refers to the mesh, which must outlive it, and moves its vertices in place: descriptors and property maps stay. Changes
/// made to the mesh by others are refused where they are found (Mesh_watch says when); `check_unchanged()` looks at all.
/// Several objects are several components of the one mesh. Orientation does not matter: an inside-out component is guarded
/// like any other. An isolated vertex is a probe: it can be dragged and touches, but nothing touches it.
///
/// One Sculptor, and the mesh it guards, belong to one thread at a time; different Sculptors on different meshes are
/// independent. There is no global state.
template <class Mesh_, class Broad_phase_ = Box_tree_broad_phase<Mesh_>, class Visitor_ = Default_edit_visitor>
class Sculptor {
public:
  using Mesh_type = Mesh_;
  using Broad_phase = Broad_phase_;
  using Visitor = Visitor_;
  using Point = typename Mesh_type::Point;
  using Vertex_index = typename Mesh_type::Vertex_index;
  using Face_index = typename Mesh_type::Face_index;
  using Grab_type = Grab<Sculptor>;
  using Result = Drag_result<Mesh_type>;
  using Edge_index = typename Mesh_type::Edge_index;
  using Halfedge_index = typename Mesh_type::Halfedge_index;
  using Stroke_type = Stroke<Sculptor>;
  using Edited = Edit_result<Mesh_type>;

  static_assert(std::is_same<Mesh_type, CGAL::Surface_mesh<Point>>::value, "Sculptor: the mesh must be a CGAL::Surface_mesh");
  static_assert(std::is_same<typename CGAL::Kernel_traits<Point>::Kernel::FT, double>::value,
                "Sculptor: the mesh's points must have double coordinates, e.g. those of "
                "CGAL::Exact_predicates_inexact_constructions_kernel");

  /// \throw Invalid_surface when the mesh is not closed, 2-manifold, triangular, non-degenerate and embedded, or does not
  /// obey the delta rule; Invalid_parameter; Out_of_range. The mesh is not changed. Cost: that of validate(), n log n in practice.
  explicit Sculptor(Mesh_type& mesh, const Sculptor_parameters& options = Sculptor_parameters(), Visitor visitor = Visitor())
    : mesh_(&mesh), watch_(mesh), options_(options), broad_phase_(validated(mesh, options)), corners_(mesh),
      editor_(mesh, broad_phase_, corners_, counters_, watch_, std::move(visitor)), guard_(mesh, broad_phase_, corners_, counters_, &watch_),
      probe_guard_(mesh, broad_phase_, corners_, counters_, &watch_) {
    grow_to(extent_of(mesh).largest);
  }

  Sculptor(const Sculptor&) = delete;
  Sculptor& operator=(const Sculptor&) = delete;

  const Mesh_type& mesh() const { return *mesh_; }
  const Sculptor_parameters& options() const { return options_; }

  /// The Sculptor's own copy.
  Visitor& visitor() { return editor_.visitor(); }

  /// How many signs the floating-point filter could not decide so far.
  const Filter_counters& filter_counters() const { return counters_; }

  /// Takes a vertex in hand. \throw Unknown_vertex, Mesh_changed
  Grab_type grab(Vertex_index v) {
    internal::check_vertex(*mesh_, v);
    release();
    hold(v);
    return Grab_type(*this, editor_.names().name(v));
  }

  /// Whether vertices are dragged once each, as a rule: then each drag looks up what is near for itself alone, with no room for
  /// further drags, and only the points of the star are compared with where they were left. Off at first. No result depends on it.
  void expect_single_drags(bool on) {
    release();
    guard_.expect_one_motion(on);
    expects_single_drags_ = on;
  }
  bool expects_single_drags() const { return expects_single_drags_; }

  /// Lets go of the vertex in hand, if any.
  void release() {
    if (held_.is_valid() && moved_)
      broad_phase_.faces_moved(guard_.star().faces);
    held_ = Vertex_index();
    moved_ = false;
    responses_.forget();
  }

  /// Moves v straight to `target` if nothing is touched on the way and the delta rule is kept; else it stays where it is. For
  /// callers that would rather try a shorter way than have the vertex stopped in front of what is in the way. A step of the history.
  /// \return whether it is at the target. \throw Unknown_vertex, Out_of_range, Mesh_changed. Cost: that of a drag.
  bool move_if_free(Vertex_index v, const Point& target) {
    const internal::Rounding_to_nearest rounding;
    internal::check_point("the target", target);
    internal::check_vertex(*mesh_, v);
    hold(v);
    const internal::Coordinates s = vertex_coordinates(*mesh_, v), t = internal::coordinates(target);
    if (s == t)
      return true;
    const bool is_free = guard_.is_free(s, t, options_.delta_length);
    check_candidates();
    if (is_free)
      put(v, s, t);
    return is_free;
  }

  /// \name Edits
  /// Each is done, proven, or refused with a reason and nothing has changed. They end the grab at hand; a Grab stays usable. What
  /// dies is said at each; Surface_mesh may use its descriptors again, within the edit too, all others stay, and `name()` gives
  /// a vertex a number that lasts. The visitor is told. Cost: the valence times the candidates near the star, and the broad phase;
  /// undo and redo: the valence and the broad phase. \throw Mesh_changed
  ///@{

  /// Creates a vertex at `p` and joins it to the corners of f, whose place the three new faces take.
  /// \post f has died; its edges and corners have not. \throw Out_of_range
  Edited insert_on_face(Face_index f, const Point& p) {
    internal::check_point("the new vertex", p);
    if (!f.is_valid() || static_cast<std::size_t>(f) >= mesh_->num_faces() || mesh_->is_removed(f))
      return Edited::refused(Refusal_reason::unknown_element);
    return edited([&] { return editor_.insert_on_face(f, internal::coordinates(p), options_.delta_length); });
  }

  /// Creates a vertex at `p` and joins it to the ends of e and the two opposite corners; four faces take the place of two.
  /// \post e and its two faces have died, no vertex has. \throw Out_of_range
  Edited insert_on_edge(Edge_index e, const Point& p) {
    internal::check_point("the new vertex", p);
    if (!e.is_valid() || static_cast<std::size_t>(e) >= mesh_->num_edges() || mesh_->is_removed(e))
      return Edited::refused(Refusal_reason::unknown_element);
    return edited([&] { return editor_.insert_on_edge(mesh_->halfedge(e), internal::coordinates(p), options_.delta_length); });
  }

  /// Draws v into one of its neighbours and lets the edge between them collapse. The neighbours are tried in the order of the
  /// triangles they leave, best first (doc/edits.md).
  /// \post v has died, and so have the edges and faces of its star; its neighbours have not.
  Edited remove(Vertex_index v) {
    if (!v.is_valid() || static_cast<std::size_t>(v) >= mesh_->num_vertices() || mesh_->is_removed(v))
      return Edited::refused(Refusal_reason::unknown_element);
    return edited([&] { return editor_.remove(v, options_.delta_length); });
  }

  /// Draws the source of h into its target and lets the edge between them collapse.
  /// \post The source has died, and so have the edges and faces of its star; its neighbours have not.
  Edited collapse(Halfedge_index h) {
    if (!h.is_valid() || static_cast<std::size_t>(h) >= mesh_->num_halfedges() || mesh_->is_removed(h))
      return Edited::refused(Refusal_reason::unknown_element);
    return edited([&] { return editor_.collapse(h, options_.delta_length); });
  }

  /// Joins the two corners opposite to e by an edge in its place. Exactly those flips are refused after which the mesh is not
  /// embedded, or breaks the delta rule, or for which anything is in the closed tetrahedron of the four corners.
  /// \post e and its two faces have died, and the new ones have their descriptors; no vertex has.
  Edited flip(Edge_index e) {
    if (!e.is_valid() || static_cast<std::size_t>(e) >= mesh_->num_edges() || mesh_->is_removed(e))
      return Edited::refused(Refusal_reason::unknown_element);
    return edited([&] { return editor_.flip(mesh_->halfedge(e), options_.delta_length); });
  }

  /// Takes back the last step that changed the mesh: a drag, creation, removal or flip, or a whole stroke; as many as the history
  /// keeps. Ends the stroke under way first. A new change clears what could be redone.
  /// \post What the step had created has died; what died by it lives again, maybe with other descriptors. Of a drag: none dies.
  Edited undo() {
    largest_coordinate_ = largest_ever_; // many vertices may move
    return edited([&] { return editor_.undo(); });
  }
  /// Makes the step that was taken back last again. \post The same have died as when it was first made.
  Edited redo() {
    largest_coordinate_ = largest_ever_;
    return edited([&] { return editor_.redo(); });
  }

  const Edit_history& history() const { return editor_.history(); }

  /// All drags and edits until what is returned ends are one step of the history, whatever their number; in it the moves of a vertex
  /// between two other edits are kept as one.
  Stroke_type stroke() { return Stroke_type(*this, editor_.history().begin_stroke(number_of_names())); }

  /// Bounds the history, in steps or bytes (`history().bytes()`), or turns it off; without limit at first. The oldest steps are
  /// forgotten; a stroke that alone is larger is not kept, nor is anything before it.
  void set_history_limit(const History_limit& limit) { editor_.history().set_limit(limit); }

  /// Makes room, in the mesh too: after it so many edits (flips, collapses, creations, removals) and so many moves allocate nothing,
  /// nor do undo and redo, as long as no vertex has more than 28 neighbours, no star has more than 512 faces about it, and no
  /// decision takes rational numbers; with the Box_tree_broad_phase. A slide's own lists are warm after a few drags. Cost: linear
  /// in the mesh.
  void reserve(std::size_t edits, std::size_t moves) {
    const auto n = static_cast<typename Mesh_type::size_type>(edits);
    mesh_->reserve(mesh_->num_vertices() + n, mesh_->num_edges() + 3 * n, mesh_->num_faces() + 2 * n);
    watch_.reserve(mesh_->num_vertices() + edits);
    corners_.reserve(mesh_->num_faces() + 2 * edits);
    internal::reserve_faces(broad_phase_, mesh_->num_faces() + 2 * edits, 4 * edits);
    editor_.reserve(edits, moves);
    guard_.reserve(editor_.usual_valence, editor_.usual_candidates);
  }
  ///@}

  /// \name Numbers of vertices that last
  /// At first a vertex's index; a new vertex takes the next number never used; a removed one's stays dead until undo revives it.
  ///@{
  std::size_t name(Vertex_index v) const { return editor_.names().name(v); }
  Vertex_index vertex(std::size_t name) const { return editor_.names().vertex(name); }
  /// One more than the largest number given.
  std::size_t number_of_names() const { return editor_.names().size(); }
  /// The null index where there is no such face or edge.
  Face_index face_of(std::size_t a, std::size_t b, std::size_t c) const { return editor_.face_of(a, b, c); }
  Edge_index edge_of(std::size_t a, std::size_t b) const {
    const auto h = editor_.halfedge_of(a, b);
    return h.is_valid() ? mesh_->edge(h) : Edge_index();
  }
  ///@}

  /// Sweeps a free point from `source` towards `target` with the response. Changes nothing. A start that is nearer than the
  /// clearance to a face, or on it, is refused: `end` is Drag_end::refused and the contact names the face.
  /// \throw Out_of_range, Mesh_changed
  Result probe(const Point& source, const Point& target) {
    const internal::Rounding_to_nearest rounding;
    internal::check_point("the source", source);
    internal::check_point("the target", target);
    check_clearance_serves();
    release();
    watch_.check_counts();
    watch_.check_some();
    const internal::Coordinates s = internal::coordinates(source), t = internal::coordinates(target);
    Result result;
    result.position = source;
    result.reached = s == t;
    if (refuse_start(s, result))
      return result;
    probe_guard_.star().clear();
    probe_guard_.invalidate();
    if (s != t)
      finish(responses_.move(options_.response_rule, probe_guard_, *mesh_, s, t, {Clearance_rule(options_.clearance_length), 0}, result),
             t, result);
    responses_.forget();
    return result;
  }

  /// What is kept from a contact that a vertex at p makes with features whose coordinates are no larger: the length set, or
  /// the default.
  double clearance(const Point& p) const {
    return Clearance_rule(options_.clearance_length).at(internal::largest_magnitude(internal::coordinates(p)));
  }

  /// \throw Out_of_range; Invalid_parameter where the length does not serve the scene as it is (Sculptor_parameters), and
  /// nothing changes. Cost: reads every point.
  void set_clearance(double length) {
    const Sculptor_parameters changed = Sculptor_parameters(options_).clearance(length);
    check_options(changed);
    check_clearance(*mesh_, changed);
    options_ = changed;
  }

  /// From here on the default of each contact.
  void set_default_clearance() { options_.clearance_length.reset(); }

  /// \throw Out_of_range; Invalid_parameter; Invalid_surface where the mesh has a lower altitude already, and nothing changes. Cost: that
  /// of validate().
  void set_delta(double length) {
    const Sculptor_parameters changed = Sculptor_parameters(options_).delta(length);
    release();
    validated(*mesh_, changed);
    options_ = changed;
  }

  void set_response(Response rule) {
    release();
    options_.response(rule);
  }

  /// \throw Mesh_changed if anything was changed by others, points or connectivity. Cost: reads all of the mesh.
  void check_unchanged() const { watch_.check_all(corners_); }

  /// Bytes held that grow with the mesh, capacity included: the broad phase, the corners of the faces, the copy of the points, the
  /// numbers of the vertices. Not the mesh itself, nor the history.
  std::size_t memory() const { return broad_phase_.memory() + corners_.memory() + watch_.memory() + editor_.names().memory(); }

private:
  friend class Grab<Sculptor>;
  friend class Stroke<Sculptor>;

  void end_stroke(std::size_t number) noexcept { editor_.history().end_stroke(number); }

  Mesh_type* mesh_;
  Mesh_watch<Mesh_type> watch_;
  Sculptor_parameters options_;
  Filter_counters counters_;
  Broad_phase broad_phase_;
  Face_corners<Mesh_type> corners_;
  Editor<Mesh_type, Broad_phase, Visitor> editor_;
  Guarded_star<Mesh_type, Broad_phase> guard_, probe_guard_;
  Responses<Mesh_type> responses_;
  Vertex_index held_; ///< whose star guard_ has; invalid when none
  bool expects_single_drags_ = false;
  bool moved_ = false; ///< the broad phase has not been told yet where the held star is
  double largest_coordinate_ = 0; ///< bounds those of all vertices
  double largest_ever_ = 0;       ///< the same, those they have had included
  std::size_t watched_look_ = 0, next_watched_ = 0;

  /// So many candidates are compared with where they were left at every drag; a list that holds for long is seen whole soon.
  static constexpr std::size_t candidates_per_drag = 4;

  static void check_options(const Sculptor_parameters& options) {
    if (options.clearance_length)
      internal::check_range("the clearance", *options.clearance_length);
    internal::check_range("delta", options.delta_length);
    if (options.clearance_length && !(*options.clearance_length > 0))
      throw Invalid_parameter("the clearance must be a length > 0, not " + internal::number(*options.clearance_length));
    if (!(options.delta_length >= 0))
      throw Invalid_parameter("delta must be a length >= 0, not " + internal::number(options.delta_length));
  }

  struct Extent {
    Box_3 box;
    double largest = 0; ///< magnitude of a coordinate
  };
  static Extent extent_of(const Mesh_type& mesh) {
    Extent extent;
    for (const Vertex_index v : mesh.vertices()) {
      const internal::Coordinates p = vertex_coordinates(mesh, v);
      extent.box.include(p);
      extent.largest = std::fmax(extent.largest, internal::largest_magnitude(p));
    }
    return extent;
  }

  /// \throw Invalid_parameter unless a clearance that is set serves the scene: what is less than an ulp cannot be kept, and the
  /// longest way that a slide goes back to keep it from several planes should not be longer than the scene.
  static void check_clearance(const Mesh_type& mesh, const Sculptor_parameters& options) {
    if (!options.clearance_length)
      return;
    const Extent extent = extent_of(mesh);
    double widest = 0;
    for (int i = 0; i < 3; ++i)
      widest = std::fmax(widest, extent.box.upper[i] - extent.box.lower[i]);
    const double least = unit_in_the_last_place(extent.largest),
                 most = widest / internal::Slide_lengths::clearances_of_retreat;
    if (!(*options.clearance_length >= least && *options.clearance_length <= most))
      throw Invalid_parameter("the clearance " + internal::number(*options.clearance_length) + " does not serve this scene: give " +
                              internal::number(least) + " (an ulp of its largest coordinate) to " + internal::number(most) +
                              " (1/128 of its extent), or none");
  }

  void grow_to(double coordinate) {
    largest_coordinate_ = std::fmax(largest_coordinate_, coordinate);
    largest_ever_ = std::fmax(largest_ever_, coordinate);
  }

  /// \throw Invalid_parameter where the scene has outgrown the clearance set.
  void check_clearance_serves() {
    if (!options_.clearance_length || *options_.clearance_length >= unit_in_the_last_place(largest_coordinate_))
      return;
    largest_coordinate_ = extent_of(*mesh_).largest; // what was far may be back
    if (!(*options_.clearance_length >= unit_in_the_last_place(largest_coordinate_)))
      check_clearance(*mesh_, options_);
  }

  static const Mesh_type& validated(const Mesh_type& mesh, const Sculptor_parameters& options) {
    check_options(options);
    for (const Vertex_index v : mesh.vertices())
      if (const auto p = vertex_coordinates(mesh, v); !internal::is_in_range(p) && is_finite(p))
        internal::check_range("vertex " + std::to_string(static_cast<std::size_t>(v)) + " at", p);
    Validity_report report = validate(mesh, options.delta_length);
    if (!report.is_valid())
      throw Invalid_surface("the mesh", std::move(report));
    check_clearance(mesh, options);
    return mesh;
  }

  /// Others are named, all of them, by the report of validate().
  static bool is_finite(const internal::Coordinates& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  }

  /// Makes guard_ the guard of v. \throw Mesh_changed
  void hold(Vertex_index v) {
    watch_.check_counts();
    if (held_ == v) {
      watch_.check(v);
      return;
    }
    internal::prefetch(&mesh_->point(v), sizeof(Point)); // there is other work until it comes
    watch_.prefetch(v);
    release();
    if (!expects_single_drags_) {
      editor_.prepare_for_moves();
      watch_.check_some();
    }
    guard_.collect(v);
    watch_.check(v);
    for (const Vertex_index neighbour : guard_.star().link)
      watch_.check(neighbour);
    held_ = v;
  }

  Result drag(Vertex_index v, const Point& target) {
    const internal::Rounding_to_nearest rounding;
    internal::check_point("the target", target);
    if (!v.is_valid()) {
      Result stale;
      stale.position = target;
      stale.end = Drag_end::stale;
      return stale;
    }
    internal::check_vertex(*mesh_, v);
    check_clearance_serves();
    hold(v);
    const internal::Coordinates s = vertex_coordinates(*mesh_, v), t = internal::coordinates(target);
    Result result;
    const internal::Coordinates end =
        s == t ? t
               : responses_.move(options_.response_rule, guard_, *mesh_, s, t,
                                 {Clearance_rule(options_.clearance_length), options_.delta_length}, result);
    check_candidates();
    if (end != s) {
      // Whatever the response has proposed: each leg has been proven by the sweeps, which take no end that is not in range.
      if (!internal::is_in_range(end))
        throw Error("a drag would have ended out of range: this is a fault of haptic_sculpt, the mesh is as it was");
      put(v, s, end);
    }
    finish(end, t, result);
    return result;
  }

  /// The held vertex v, at s, has been proven to come to `end`.
  void put(Vertex_index v, const internal::Coordinates& s, const internal::Coordinates& end) {
    mesh_->point(v) = Point(end[0], end[1], end[2]);
    watch_.remember(v);
    grow_to(internal::largest_magnitude(end));
    moved_ = true;
    editor_.note_move(v, s, end);
  }

  /// \throw Mesh_changed
  void check_candidates() {
    try {
      watch_candidates();
    } catch (const Mesh_changed&) {
      release(); // what was looked up is not to be used when the change has been undone
      throw;
    }
  }

  /// Runs an edit between looking for changes by others and noting what it changed.
  template <class Edit_function>
  Edited edited(const Edit_function& edit) {
    const internal::Rounding_to_nearest rounding;
    release();
    watch_.check_counts();
    watch_.check_some();
    const Edited result = edit();
    if (result && !mesh_->is_removed(*result.vertex))
      grow_to(internal::largest_magnitude(vertex_coordinates(*mesh_, *result.vertex)));
    return result;
  }

  /// All candidates where they have just been looked up, else some of them in turn. \throw Mesh_changed
  void watch_candidates() {
    if (expects_single_drags_) // whatever is near is the vertex or a neighbour at another drag
      return;
    const auto& candidates = guard_.checklist().vertices();
    if (watched_look_ != guard_.looks()) {
      watched_look_ = guard_.looks();
      for (const auto& candidate : candidates)
        watch_.check(candidate.index);
      watch_.check_faces(corners_, guard_.star().faces);
    } else {
      for (std::size_t left = std::min(candidates.size(), candidates_per_drag); left != 0; --left) {
        next_watched_ = next_watched_ + 1 < candidates.size() ? next_watched_ + 1 : 0;
        watch_.check(candidates[next_watched_].index);
      }
    }
  }

  static void finish(const internal::Coordinates& end, const internal::Coordinates& target, Result& result) {
    result.position = Point(end[0], end[1], end[2]);
    result.reached = end == target;
  }

  bool refuse_start(const internal::Coordinates& start, Result& result) {
    const Clearance_rule rule(options_.clearance_length);
    const double reach = internal::largest_magnitude(start), clearance = rule.at(std::fmax(largest_coordinate_, reach));
    Box_3 near(start);
    for (int i = 0; i < 3; ++i) {
      // One ulp more than the clearance, for the sums are rounded.
      near.lower[i] = std::nextafter(near.lower[i] - clearance, -std::numeric_limits<double>::infinity());
      near.upper[i] = std::nextafter(near.upper[i] + clearance, std::numeric_limits<double>::infinity());
    }
    std::vector<Face_index> faces;
    broad_phase_.query(near, faces);
    std::sort(faces.begin(), faces.end());
    for (const Face_index f : faces) {
      const auto h = mesh_->halfedge(f);
      const std::array<Vertex_index, 3> corners = {mesh_->source(h), mesh_->target(h), mesh_->target(mesh_->next(h))};
      const auto a = vertex_coordinates(*mesh_, corners[0]), b = vertex_coordinates(*mesh_, corners[1]),
                 c = vertex_coordinates(*mesh_, corners[2]);
      const double there = std::fmax(std::fmax(reach, internal::largest_magnitude(a)),
                                     std::fmax(internal::largest_magnitude(b), internal::largest_magnitude(c)));
      if (!internal::is_within_distance(start, a, b, c, rule.at(there)))
        continue;
      Contact_3<Mesh_type> contact;
      contact.vertices = corners;
      contact.is_flat = true;
      result.contacts.push_back(contact);
      result.end = Drag_end::refused;
      return true;
    }
    return false;
  }
};

} // namespace haptic_sculpt

#endif
