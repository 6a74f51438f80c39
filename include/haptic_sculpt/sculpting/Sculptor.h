// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Applied.h>
#include <haptic_sculpt/sculpting/Grab.h>
#include <haptic_sculpt/sculpting/History_view.h>
#include <haptic_sculpt/sculpting/Probe.h>
#include <haptic_sculpt/sculpting/Stroke.h>
#include <haptic_sculpt/sculpting/axis_moves/shift_all.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Edit_applier.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Guarded_mesh.h>
#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>

#include <CGAL/Surface_mesh.h>

namespace haptic_sculpt {

/// Guards a mesh: embedded in, embedded out, whatever is dragged where.
///
/// \tparam Mesh_ `CGAL::Surface_mesh<K::Point_3>` with K::FT = double
/// \tparam Broad_phase_ a model of BroadPhase (doc/proofs/broad_phase.md); no result depends on the choice
/// \tparam Visitor_ a model of EditVisitor (Default_edit_visitor), told of moved, created and dead elements
/// \tparam Traits_ a model of SweptCollisionTraits_3: decides what a dragged vertex meets, and what of it first. With
/// the default no decision is ever wrong; with another nothing is promised of drags but what that one keeps. Edits,
/// finding, the delta rule, and which pairs are not looked at, are exact whatever the traits
/// (doc/use/exact_sweeps.md, "Another arithmetic").
///
/// Refers to the mesh, which must outlive it, and moves its vertices in place: descriptors and property maps stay.
/// Changes made to the mesh by others are refused where they are found (doc/use/edits.md); `check_unchanged()`
/// looks at all. Several objects are several components of the one mesh. Orientation does not matter: an inside-out
/// component is guarded like any other.
///
/// An exception leaves everything as it was, std::bad_alloc included, or the change complete where it came from the
/// visitor. Where it could not, every later call throws Unfinished_change but those that only tell: mesh(),
/// parameters(), visitor(), filter_counters(), history(), memory(), clearance(), and probes, which are stale
/// (doc/proofs/edits.md, "Memory that runs out").
///
/// One Sculptor, and the mesh it guards, belong to one thread at a time; different Sculptors on different meshes are
/// independent. There is no global state.
template <class Mesh_, class Broad_phase_ = Box_tree_broad_phase<Mesh_>, class Visitor_ = Default_edit_visitor,
          class Traits_ = Exact_sweep_traits<Mesh_>>
class Sculptor {
public:
  using Mesh_type = Mesh_;                                   ///< the mesh that is guarded
  using Broad_phase = Broad_phase_;                          ///< finds what is near
  using Visitor = Visitor_;                                  ///< hears of what edits do
  using Traits = Traits_;                                    ///< decides what a motion meets
  using Point = typename Mesh_type::Point;                   ///< with double coordinates
  using Vertex_index = typename Mesh_type::Vertex_index;     ///< used again by the mesh; id() lasts
  using Face_index = typename Mesh_type::Face_index;         ///< used again by the mesh
  using Grab_type = Grab<Sculptor>;                          ///< what grab() gives
  using Probe_type = Probe<Sculptor>;                        ///< what probe() gives
  using Result = Drag_result<Mesh_type>;                     ///< what a drag gives
  using Edge_index = typename Mesh_type::Edge_index;         ///< used again by the mesh
  using Halfedge_index = typename Mesh_type::Halfedge_index; ///< used again by the mesh
  using Stroke_type = Stroke<Sculptor>;                      ///< what stroke() gives
  using Edited = Edit_result<Mesh_type>;                     ///< what an edit gives

  static_assert(std::is_same<Mesh_type, CGAL::Surface_mesh<Point>>::value,
                "Sculptor: the mesh must be a CGAL::Surface_mesh");
  static_assert(std::is_same<typename CGAL::Kernel_traits<Point>::Kernel::FT, double>::value,
                "Sculptor: the mesh's points must have double coordinates, e.g. those of "
                "CGAL::Exact_predicates_inexact_constructions_kernel");
  static_assert(
      sizeof(Point) >= 3 * sizeof(double),
      "Sculptor: the mesh's points must hold their coordinates; those of CGAL::Cartesian<double> are handles, "
      "and every write of one asks for memory: use CGAL::Simple_cartesian<double>");

  /// \throw Invalid_surface when the mesh is not closed, 2-manifold, triangular, non-degenerate and embedded, or does
  /// not obey the delta rule; Invalid_parameter; Out_of_range. The mesh is not changed. Cost: that of validate(), n log
  /// n in practice.
  explicit Sculptor(Mesh_type& mesh, const Sculptor_parameters& parameters = Sculptor_parameters(),
                    Visitor visitor = Visitor())
      : guarded_(
            mesh, parameters, std::move(visitor), [](Filter_counters& counters) { return traits_that_count(counters); },
            internal::Rounding_to_nearest()) {}

  /// The same with traits of its own, which are copied. \throw as above
  Sculptor(Mesh_type& mesh, const Sculptor_parameters& parameters, Visitor visitor, const Traits& traits)
      : guarded_(
            mesh, parameters, std::move(visitor), [&traits](Filter_counters&) { return traits; },
            internal::Rounding_to_nearest()) {}
  ~Sculptor() { set_hand(nullptr); }

  Sculptor(const Sculptor&) = delete;
  Sculptor& operator=(const Sculptor&) = delete;

  const Mesh_type& mesh() const { return guarded_.mesh(); }                  ///< the one that is guarded, as it is now
  /// Those given, with what was set since.
  const Sculptor_parameters& parameters() const { return guarded_.parameters; }

  /// The Sculptor's own copy.
  Visitor& visitor() { return guarded_.editor().visitor(); }

  /// How many signs the floating-point filter could not decide so far. Traits that were given do not count here.
  const Filter_counters& filter_counters() const { return guarded_.counters(); }

  /// Takes a vertex in hand. \throw Unknown_vertex, Mesh_changed
  Grab_type grab(Vertex_index v) {
    const internal::Rounding_to_nearest rounding;
    guarded_.grab(v);
    return Grab_type(*this, guarded_.editor().ids().id(v));
  }

  /// Drags v as Grab::drag_to() does, without a Grab. Takes v in hand, and contacts that were carried along are
  /// forgotten if that is another vertex. \param drag unset: parameters().drag \throw Unknown_vertex, and as there
  Result drag(Vertex_index v, const Point& target, const std::optional<Drag_parameters>& drag = std::nullopt) {
    return guarded_.drag(v, target, nullptr, drag);
  }

  /// Moves v straight to `target` if nothing is touched on the way and the delta rule is kept; else it stays where it
  /// is. A step of the history. Returns whether it is at the target. \param drag unset: parameters().drag; of no effect
  /// are its response and clearance \throw Unknown_vertex, Out_of_range, Mesh_changed. Cost: that of a drag.
  bool move_if_free(Vertex_index v, const Point& target, const std::optional<Drag_parameters>& drag = std::nullopt) {
    return guarded_.move_if_free(v, target, drag, parameters().delta_length);
  }

  /// What v would touch first on its straight way to `target`, as the free function first_impact() tells, at the cost
  /// of a grab and a drag, or of a drag alone where the same was asked last and nothing has changed. Moves nothing, and
  /// who is in hand stays so. \throw Unknown_vertex, Out_of_range, Mesh_changed
  std::optional<Star_impact<Mesh_type, typename Traits::Impact_3>> first_impact(Vertex_index v, const Point& target) {
    return guarded_.first_impact(v, target);
  }

  /// Lets go of the vertex in hand, if any.
  void release() { guarded_.release(); }

  /// \name Finding
  /// Exact (doc/use/finding.md). Changes nothing, and does not end
  /// the grab at hand. Cost: log n with the default broad phase.
  ///@{

  /// The vertex of the surface nearest to p, of those at most `within` from it; the null index where there is none. Of
  /// several at the same distance that of the smallest index. \param within >= 0; may be infinite \throw Out_of_range,
  /// Invalid_parameter, Mesh_changed
  Vertex_index nearest_vertex(const Point& p, double within) { return guarded_.nearest_vertex(p, within); }

  /// Whether the normals of v's component point into the solid (doc/use/validity.md). \throw Unknown_vertex,
  /// Mesh_changed. Cost: constant, but n log n when it is asked for the first time, after edits where components
  /// differ, and each time in the midst of another call.
  bool is_inside_out(Vertex_index v) { return guarded_.is_inside_out(v); }

  /// What of the surface the closed segment from `source` to `target` meets first: a vertex, or the inside of an edge
  /// or of a face. A segment in the plane of a face meets it where it enters it or begins, and one that is a point
  /// meets what it lies on. \throw Out_of_range, Mesh_changed
  std::optional<Surface_hit<Mesh_type>> first_hit(const Point& source, const Point& target) {
    return guarded_.first_hit(source, target);
  }
  ///@}

  /// \name Edits
  /// Each is done, proven, or refused with a reason and nothing has changed. They end the grab at hand; a Grab stays
  /// usable. What dies is said at each; Surface_mesh may use its descriptors again, within the edit too, all others
  /// stay, and `id()` gives a vertex a number that lasts. The visitor hears. Cost: the valence times the candidates
  /// near the star, and the broad phase; undo and redo: the valence and the broad phase. \throw Mesh_changed
  ///@{

  /// Creates a vertex at `p` and joins it to the corners of f, whose place the three new faces take.
  /// \post f has died; its edges and corners have not. \throw Out_of_range
  Edited insert_on_face(Face_index f, const Point& p) {
    const internal::Rounding_to_nearest rounding;
    internal::check_point("the new vertex", p);
    return edited(f, mesh().num_faces(), [&](auto& editor) {
      guarded_.expect_vertex(internal::coordinates(p));
      return editor.insert_on_face(f, internal::coordinates(p), delta());
    });
  }

  /// Creates a vertex at `p` and joins it to the ends of e and the two opposite corners; four faces take the place of
  /// two. \post e and its two faces have died, no vertex has. \throw Out_of_range
  Edited insert_on_edge(Edge_index e, const Point& p) {
    const internal::Rounding_to_nearest rounding;
    internal::check_point("the new vertex", p);
    return edited(e, mesh().num_edges(), [&](auto& editor) {
      guarded_.expect_vertex(internal::coordinates(p));
      return editor.insert_on_edge(mesh().halfedge(e), internal::coordinates(p), delta());
    });
  }

  /// Draws v into one of its neighbours and lets the edge between them collapse. The neighbours are tried in the order
  /// of the triangles they leave, best first (doc/use/edits.md). \post v has died, and so have the edges and faces of
  /// its star; its neighbours have not.
  Edited remove(Vertex_index v) {
    return edited(v, mesh().num_vertices(), [&](auto& editor) { return editor.remove(v, delta()); });
  }

  /// Draws the source of h into its target and lets the edge between them collapse.
  /// \post The source has died, and so have the edges and faces of its star; its neighbours have not.
  Edited collapse(Halfedge_index h) {
    return edited(h, mesh().num_halfedges(), [&](auto& editor) { return editor.collapse(h, delta()); });
  }

  /// Joins the two corners opposite to e by an edge in its place. Exactly those flips are refused after which the mesh
  /// is not embedded, or breaks the delta rule, or for which anything is in the closed tetrahedron of the four corners.
  /// \post e and its two faces have died, and the new ones have their descriptors; no vertex has.
  Edited flip(Edge_index e) {
    return edited(e, mesh().num_edges(), [&](auto& editor) { return editor.flip(mesh().halfedge(e), delta()); });
  }

  /// Moves many vertices at once along one coordinate axis, each to a coordinate of its own, the last given of one
  /// given again. Done where the surface stays embedded, and the delta rule kept, at every time; decided exactly,
  /// whatever the traits (doc/use/axis_moves.md). Else refused, with the vertices of a place that is in the way. One
  /// change of the history. \tparam Concurrency_tag as of move_vertices() \param axis 0 to 2 \post Nothing has died.
  /// \throw Unknown_vertex, Out_of_range, Invalid_parameter. Cost: n log n in what moves and is near,
  /// and the square of the valence of a moving vertex whose star is seen folded along the axis
  template <class Concurrency_tag = CGAL::Sequential_tag>
  Edited shift(int axis, const std::vector<std::pair<Vertex_index, double>>& ways) {
    return internal::shift_all(guarded_, axis, ways, Part_runner::by<Concurrency_tag>());
  }

  /// Does an edit given by value, and gives it back as it can be done again. Strokes begun by one are ended by another;
  /// moves of one vertex that follow each other are one grab. A move with legs is a drag for each, all one step: what
  /// is thrown in one leaves those before it. \throw Mesh_changed whatever the kind; else as the functions that the
  /// kinds are named after
  Applied<Mesh_type> apply(const Edit& edit) { return applier_.apply(*this, edit); }

  /// Takes back the last step that changed the mesh: a drag, creation, removal or flip, or a whole stroke; as many as
  /// the history keeps. Ends the stroke under way, unless memory runs out. A new change clears what could be redone.
  /// Restores what was, whatever delta is now. \post What the step had created has died; what died by it lives again,
  /// maybe with other descriptors. Of a drag: none dies.
  Edited undo() { return guarded_.restored([&] { return guarded_.editor().undo(); }); }
  /// Makes the step that was taken back last again. \post The same have died as when it was first made.
  Edited redo() { return guarded_.restored([&] { return guarded_.editor().redo(); }); }

  /// What undo and redo can make: number_of_undo_steps(), number_of_redo_steps(), bytes().
  History_view history() const { return History_view(guarded_.editor().history()); }

  /// All drags and edits until what is returned ends are one step of the history, whatever their number; in it the
  /// moves of a vertex between two other edits are kept as one.
  Stroke_type stroke() { return Stroke_type(*this, guarded_.whole_editor().history().begin_stroke(number_of_ids())); }

  /// Bounds the history, in steps or bytes (`history().bytes()`), or turns it off; without limit at first. The oldest
  /// steps are forgotten; a stroke that alone is larger is not kept, nor is anything before it.
  void set_history_limit(const History_limit& limit) { guarded_.whole_editor().history().set_limit(limit); }
  /// Forgets all of it, as where a log begins; the limit stays, and the room. A stroke under way that
  /// has changed the mesh is not kept.
  void forget_history() { guarded_.whole_editor().history().forget(); }

  /// Makes room, in the mesh too: after it this many edits (flips, collapses, creations, removals), of stars of eight
  /// faces in the mean, and this many moves allocate nothing, nor do undo and redo, as long as no vertex has more
  /// neighbours than any has now, or 28, no star more faces about it than 2,048 and twice as many, no decision takes
  /// rational numbers, nothing is kept, no visitor has `face_replaces` or `edge_replaces`, and the mesh recycles its
  /// garbage; with the Box_tree_broad_phase. A slide's lists are warm after a few drags. Cost: linear in the mesh.
  void reserve(std::size_t edits, std::size_t moves) { guarded_.reserve(edits, moves); }
  ///@}

  /// Keeps the values of a property map from now on: what undo and redo revive has its values again, and what edits
  /// create gets a value made of those of the elements it comes from (doc/use/properties.md); where it comes from none,
  /// the default of a map of the mesh, in other maps `value()` if there is one. \param map a model of
  /// `ReadWritePropertyMap`, copied; its keys are vertices, halfedges, edges or faces of the mesh
  /// \param carry `value carry(const Property_origin<value>&)`: Copy_property, Interpolate_property, or your own.
  /// What the functions of the map and `carry` throw goes on to the caller of the edit, which stands; where a value
  /// cannot be copied before the edit, the edit is not made. Cost: while a map is kept, an edit looks up its ids,
  /// n log n in the valence; the history keeps the values of what dies, which `history().bytes()` does not count.
  /// \pre the map lives as long as the Sculptor: one of the mesh is not removed from it before
  /// \throw Invalid_parameter for the mesh's own map of points
  template <class Map, class Carry = Copy_property>
  void keep(Map map, Carry carry = Carry()) {
    guarded_.whole_editor().kept().add(map, std::move(carry));
  }

  /// \name Numbers of vertices that last
  /// At first a vertex's index; a new vertex takes the next number never used; a removed one's stays dead until undo
  /// revives it.
  ///@{

  /// The number of v. \pre v is in the mesh \throw Mesh_changed where others have added it
  std::size_t id(Vertex_index v) const { return guarded_.whole_editor().ids().checked_id(v); }
  /// The null index where the vertex is dead, or the number was never given.
  Vertex_index vertex(std::size_t id) const { return guarded_.whole_editor().ids().vertex(id); }
  /// One more than the largest number given; at first the slots of the mesh, those of removed vertices included.
  std::size_t number_of_ids() const { return guarded_.whole_editor().ids().size(); }
  /// The face of three corners, by number and in any order; the null index where there is none.
  Face_index face_of(std::size_t a, std::size_t b, std::size_t c) const {
    return guarded_.whole_editor().face_of(a, b, c);
  }
  /// From a to b, by number; the null index where there is none.
  Halfedge_index halfedge_of(std::size_t a, std::size_t b) const { return guarded_.whole_editor().halfedge_of(a, b); }
  /// The edge between two vertices, by number; the null index where there is none.
  Edge_index edge_of(std::size_t a, std::size_t b) const {
    const Halfedge_index h = halfedge_of(a, b);
    return h.is_valid() ? mesh().edge(h) : Edge_index();
  }
  ///@}

  /// A point that touches the surface, to be dragged about the scene; changes nothing (doc/use/probes.md). Refused
  /// where p is on a face, not farther from one than the clearance, or inside of a solid, of which a cavity is no part.
  /// Any change of the mesh ends it. Does not end the grab at hand. \throw Out_of_range, Invalid_parameter,
  /// Mesh_changed. Cost: log n and the faces whose boxes a ray meets.
  Probe_type probe(const Point& p, Probe_start start = Probe_start::outside) {
    return Probe_type(*this, p, guarded_.refuse_probe(p, start));
  }

  /// What is kept from a contact that a vertex at p makes with features whose coordinates are no larger: the length
  /// set, or the default. \throw Non_finite_point, Out_of_range
  double clearance(const Point& p) const {
    const internal::Rounding_to_nearest rounding;
    internal::check_point("the place", p);
    return internal::Clearance_rule(parameters().drag.clearance_length)
        .at(internal::largest_magnitude(internal::coordinates(p)));
  }

  /// Of drags from here on that are given none. \throw Out_of_range; Invalid_parameter where the clearance is another
  /// one than before and does not serve the scene. Cost: reads every point where it is another one.
  void set_drag_parameters(const Drag_parameters& drag) {
    const internal::Rounding_to_nearest rounding;
    guarded_.check_may_change();
    if (drag.clearance_length != parameters().drag.clearance_length) { // else drags find what it has been outgrown by
      internal::check_length(drag.clearance_length);
      internal::check_clearance(mesh(), drag.clearance_length);
    }
    guarded_.parameters.drag = drag;
  }

  /// Of drags and edits from here on; undo and redo restore what was, and altitudes that are lower then may only grow
  /// (doc/proofs/stop.md). It changes between steps of the history: \throw Open_stroke within a stroke; Mesh_changed;
  /// Out_of_range; Invalid_parameter; Invalid_surface where the mesh has a lower altitude already. Cost: that of
  /// validate().
  void set_delta(double length) {
    const internal::Rounding_to_nearest rounding;
    if (guarded_.whole_editor().history().is_in_stroke())
      throw Open_stroke("delta may not change within a stroke: end the stroke first");
    const Sculptor_parameters changed = Sculptor_parameters(parameters()).delta(length);
    check_unchanged();
    Sculptor_parameters asked = changed;
    asked.drag.clearance(std::nullopt); // it was checked when it was set
    internal::checked_scene(mesh(), asked);
    guarded_.check_clearance_serves();
    release();
    guarded_.parameters = changed;
  }

  /// \throw Mesh_changed if anything was changed by others, points or connectivity. Cost: reads all of the mesh.
  void check_unchanged() const { guarded_.check_unchanged(); }

  /// Bytes held that grow with the mesh, capacity included. Not the mesh itself, nor the history, nor the lists
  /// of single rounds of axis moves.
  std::size_t memory() const { return guarded_.memory(); }

private:
  friend class Grab<Sculptor>;
  friend class Probe<Sculptor>;
  friend struct internal::Sculptor_access;
  friend class Stroke<Sculptor>;

  void end_stroke(std::size_t number) noexcept { guarded_.editor().history().end_stroke(number); }

  internal::Guarded_mesh<Mesh_type, Broad_phase, Visitor, Traits> guarded_;
  Grab_type* holder_ = nullptr; ///< the Grab that has the hand
  internal::Edit_applier<Sculptor, Mesh_type> applier_;

  double delta() const { return parameters().delta_length; }

  /// \throw Unfinished_change
  template <class Index>
  bool is_unknown(Index element, std::size_t slots) const {
    guarded_.check_is_whole();
    return !element.is_valid() || static_cast<std::size_t>(element) >= slots || mesh().is_removed(element);
  }

  /// An edit of an element that has to be in the mesh.
  template <class Index, class Edit_function>
  Edited edited(Index element, std::size_t slots, const Edit_function& edit) {
    if (is_unknown(element, slots))
      return Edited::refused(Refusal_reason::unknown_element);
    return guarded_.edited([&] { return edit(guarded_.editor()); });
  }

  /// The exact ones count; others are made by default.
  static Traits traits_that_count(Filter_counters& counters) {
    if constexpr (std::is_same<Traits, Exact_sweep_traits<Mesh_type>>::value)
      return Traits(&counters);
    else
      return Traits();
  }

  /// Whoever had the hand is stale from now on.
  void set_hand(Grab_type* grab) noexcept {
    if (holder_ != nullptr && holder_ != grab) {
      if (grab != nullptr) // else this may be dying, after its mesh
        holder_->note_place();
      holder_->sculptor_ = nullptr;
    }
    holder_ = grab;
  }

  /// For the Grab.
  void let_go() noexcept {
    guarded_.let_go();
    set_hand(nullptr);
  }
};

} // namespace haptic_sculpt
