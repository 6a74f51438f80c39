// SPDX-License-Identifier: GPL-3.0-or-later
// For the reference only: what is asked of a template parameter. It is not compiled.

/// The concept of what decides the sweeps of a dragged vertex: the last template parameter of haptic_sculpt::Sculptor, and an
/// argument of haptic_sculpt::first_impacts(). Has model haptic_sculpt::Swept_collision_traits_3, which is exact.
///
/// One vertex J goes from S to T in a straight line while all else stands still. The three sweeps say whether a pair of features
/// meets, as closed sets, and when first (doc/proofs/exact_sweeps.md). A Sculptor asks only of pairs that boxes and separating planes
/// leave, both exact; and it takes each answer at its word. What is promised of a drag is so as right as its traits: with a model
/// that answers wrongly now and then, vertices pass through surfaces, or are stopped where nothing is.
///
/// A model is copied; what it makes lives as long as the Sculptor. One object is asked by one thread at a time.
class SweptCollisionTraits_3 {
public:
  /// The mesh's point, of a kernel with `FT` = double.
  typedef unspecified_type Point_3;

  /// A first meeting: copyable, and a model of what follows, if `i` is one.
  ///
  /// | expression | type | meaning |
  /// |---|---|---|
  /// | `i.feature()` | haptic_sculpt::Impact_feature | which features meet |
  /// | `i.location()` | haptic_sculpt::Triangle_location | where on the face; of a vertex and a face only, told in contacts |
  /// | `i.source()`, `i.target()` | Point_3 | S and T |
  /// | `i.static_point(k)` | Point_3 | what stands still, k = 0, 1, 2, in the order of the functor's arguments |
  /// | `i.is_flat()` | bool | the three points span no plane that J enters; else that is looked at once more |
  /// | `i.time()` | pair of double | an interval in [0, 1] that holds the fraction of the way, about 2^-40 wide |
  /// | `i.time_bounds()` | pair of double | the same, wider and at less cost; what is later than its end is not swept any more |
  /// | `i.exact_time()` | mpq_class | the time; asked for only where a delta rule is set |
  typedef unspecified_type Impact_3;

  /// `f(s, t, a, b, c)` returns a `std::optional<Impact_3>`: where J first meets the triangle abc; `f.do_collide(s, t, a, b, c)`
  /// returns only whether it does. Both have to give the same answer; s and t may be equal.
  typedef unspecified_type Vertex_face_sweep_3;
  /// The same where the edge from J to a first meets the segment bc.
  typedef unspecified_type Edge_edge_sweep_3;
  /// The same where the face of J and the edge ab first meets the point c.
  typedef unspecified_type Face_vertex_sweep_3;
  /// `f(i, j)` returns a `CGAL::Comparison_result`: which of two impacts of one motion comes first. An order: of what comes
  /// first all are kept.
  typedef unspecified_type Compare_time_3;

  /// \name Functors
  ///@{
  Vertex_face_sweep_3 vertex_face_sweep_3_object() const; ///< The functor of this name; a Sculptor keeps it.
  Edge_edge_sweep_3 edge_edge_sweep_3_object() const;     ///< The functor of this name; a Sculptor keeps it.
  Face_vertex_sweep_3 face_vertex_sweep_3_object() const; ///< The functor of this name; a Sculptor keeps it.
  Compare_time_3 compare_time_3_object() const;           ///< The functor of this name; a Sculptor keeps it.
  ///@}
};
