// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/axis_moves/Axis_box.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_item.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_obstacle.h>
#include <haptic_sculpt/sculpting/axis_moves/axis_delta.h>
#include <haptic_sculpt/surface/broad_phase/processor.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <cstring>

namespace haptic_sculpt::internal {

/// Vertices, and where each is to be along an axis.
template <class Mesh>
using Axis_ways = std::vector<std::pair<typename Mesh::Vertex_index, double>>;

/// What a part of a round of an axis move has found: what several parts found is put together in their order.
struct Axis_findings {
  Filter_counters counters;
  std::vector<Axis_obstacle> obstacles;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> put_off; ///< pairs of slots to be looked at last
  std::size_t work = 0; ///< faces and pairs counted

  void add(Axis_obstacle::Kind kind, const std::array<std::uint32_t, 4>& vertices) {
    obstacles.push_back({kind, vertices});
  }
  void clear() {
    counters = Filter_counters();
    obstacles.clear();
    put_off.clear();
    work = 0;
  }
};

/// Faces of a mesh, and where their corners move along an axis: decides, face by face and pair by pair, what is in the
/// way. Members that are `const` may be called by several threads at a time.
template <class Mesh>
class Axis_scene {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;

  struct Vertex {
    double share = 1;       ///< proposed in this round
    std::uint8_t sides = 0; ///< bits: whether a face around it is seen from below, on edge, from above
    std::uint8_t pulls = 0;
    bool moves = false, is_pulled = false;
  };

  explicit Axis_scene(const Mesh& mesh) : mesh_(&mesh) {}

  /// As Axis_move::take().
  void take(const std::vector<Face_index>& faces, bool are_all) {
    are_all_ = false; // until all have been taken: memory may run out
    items_.clear();
    items_.reserve(faces.size());
    if (slot_of_face_.size() < mesh_->num_faces())
      slot_of_face_.resize(mesh_->num_faces());
    if (places_.size() < mesh_->num_vertices()) { // the last to be made room for
      vertices_.resize(mesh_->num_vertices());
      places_.resize(mesh_->num_vertices());
    }
    for (const Face_index f : faces) {
      slot_of_face_[f] = static_cast<std::uint32_t>(items_.size());
      items_.push_back(item_of(f));
    }
    are_all_ = are_all;
  }
  void forget() { are_all_ = false; } ///< connectivity is to change

  /// As Axis_move::begin(); look_along() each face next.
  void begin(int axis, const Axis_ways<Mesh>& ways, double delta) {
    delta_ = delta;
    const auto begin_with = [&](std::uint32_t v) {
      const Coordinates p = vertex_coordinates(*mesh_, Vertex_index(v));
      places_[v] = {p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis], p[axis]};
      vertices_[v] = Vertex{};
    };
    if (are_all_)
      for (std::uint32_t v = 0; v < vertices_.size(); ++v)
        begin_with(v);
    else
      for (const Axis_item& item : items_)
        for (const std::uint32_t v : item.corners)
          begin_with(v);
    for (const auto& [v, end] : ways)
      if (end != height(index(v)))
        places_[index(v)][3] = end, vertices_[index(v)].moves = true;
    for (Axis_item& item : items_)
      item.moves = does_move(item);
  }

  /// Asks for the memory that look_along() will read a few slots on: its corners are all over the mesh.
  void fetch_ahead(std::uint32_t slot) const {
    if (slot + ahead < items_.size())
      for (const std::uint32_t v : items_[slot + ahead].corners)
        internal::prefetch(&places_[v], sizeof(Axis_place));
  }
  /// Finds from which side a face is seen. Threads may share the slots. \return its motion
  Axis_motion<3> look_along(std::uint32_t slot, Filter_counters& counters) {
    const Axis_motion<3> motion = motion_of(items_[slot].corners);
    items_[slot].side = static_cast<std::int8_t>(Axis_sweep<3, Filter_counters>(motion, counters).seen(0, 1, 2));
    return motion;
  }
  /// After all have been looked at: tells their corners. Not for several threads.
  void tell_corners() {
    for (const Axis_item& item : items_)
      for (const std::uint32_t v : item.corners)
        vertices_[v].sides = static_cast<std::uint8_t>(vertices_[v].sides | 1u << (item.side + 1));
  }
  /// After that. Threads may share the slots.
  void find_folds(std::uint32_t slot) {
    Axis_item& item = items_[slot];
    item.unfolded = static_cast<std::uint8_t>(is_unfolded(item.corners[0]) | is_unfolded(item.corners[1]) << 1 |
                                              is_unfolded(item.corners[2]) << 2);
  }

  bool has_taken_all() const { return are_all_; }
  const std::vector<Axis_item>& items() const { return items_; } ///< by slot, in the order of space
  Vertex& vertex(std::uint32_t v) { return vertices_[v]; }
  std::uint32_t slot(Face_index f) const { return slot_of_face_[static_cast<std::size_t>(f)]; } ///< of one taken
  /// Bytes held, capacity included.
  std::size_t memory() const {
    return items_.capacity() * sizeof(Axis_item) + slot_of_face_.capacity() * sizeof(std::uint32_t) +
           vertices_.capacity() * sizeof(Vertex) + places_.capacity() * sizeof(Axis_place);
  }

  static std::uint32_t index(Vertex_index v) { return static_cast<std::uint32_t>(v); }
  double height(std::uint32_t v) const { return places_[v][2]; } ///< along the axis, at the start
  double end_of(std::uint32_t v) const { return places_[v][3]; }  ///< the same at the end
  void set_end(std::uint32_t v, double end) { places_[v][3] = end; }

  template <std::size_t n>
  Axis_motion<n> motion_of(const std::array<std::uint32_t, n>& v) const {
    std::array<Axis_place, n> places;
    for (std::size_t k = 0; k < n; ++k)
      places[k] = places_[v[k]];
    return Axis_motion<n>(places);
  }

  /// Whether all corners are to be held back.
  bool is_pulled(const Axis_item& item) const {
    const auto& v = item.corners;
    return vertices_[v[0]].is_pulled && vertices_[v[1]].is_pulled && vertices_[v[2]].is_pulled;
  }

  /// Whether a pair counts as work: neither side by side nor with intervals that are apart. Told by the two faces and
  /// their motion alone, in doubles: it does not depend on what else is looked at, nor on the tree that found the pair.
  bool does_count(const Axis_item& f, const Axis_item& g) const {
    const unsigned shared = shared_corners(f, g);
    if (shared != 0)
      return !are_side_by_side(f, g, shared);
    return !Axis_bounds(motion_of(f.corners)).are_apart(Axis_bounds(motion_of(g.corners)));
  }

  void decide_face(const Axis_item& f, Axis_findings& found) const {
    if (f.side != 0 && delta_ == 0)
      return;
    const Axis_motion<3> motion = motion_of(f.corners);
    if (f.side == 0 && Axis_sweep<3, Filter_counters>(motion, found.counters).is_face_degenerate(0, 1, 2))
      found.add(Axis_obstacle::Kind::flat_face, {f.corners[0], f.corners[1], f.corners[2], f.corners[0]});
    else if (delta_ > 0 && !is_delta_kept(motion, delta_))
      found.add(Axis_obstacle::Kind::delta, {f.corners[0], f.corners[1], f.corners[2], f.corners[0]});
  }

  bool may_meet(const Axis_item& f, const Axis_item& g) const { return !are_side_by_side(f, g, shared_corners(f, g)); }

  void decide_pair(const Axis_item& f, const Axis_item& g, Axis_findings& found) const {
    const unsigned shared_of_f = shared_corners(f, g);
    if (are_side_by_side(f, g, shared_of_f))
      return;
    const std::array<std::uint32_t, 6> v{f.corners[0], f.corners[1], f.corners[2],
                                         g.corners[0], g.corners[1], g.corners[2]};
    const Axis_motion<6> motion = motion_of(v);
    const Axis_sweep<6, Filter_counters> sweep(motion, found.counters);
    // Of an edge, by its first end, and a corner of the other face: the tests ask for most of these several times.
    constexpr std::int8_t unknown = 2;
    std::int8_t known[6][6];
    std::memset(known, unknown, sizeof known);
    const auto sign = [&](int a, int b, int c) -> int {
      std::int8_t& s = known[a][c];
      if (s == unknown)
        s = static_cast<std::int8_t>(sweep.seen(a, b, c));
      return s;
    };
    if (shared_of_f == 0 && (sweep.is_seen_beside(f.side, 0, 3, sign) || sweep.is_seen_beside(g.side, 3, 0, sign)))
      return;
    const unsigned shared = shared_of_f | shared_corners(g, f) << 3;
    const auto is_shared = [shared](int k) { return (shared >> k & 1) != 0; };
    for (int i = 0; i < 3; ++i) {
      if ((f.owned >> i & 1) != 0 && !is_shared(i) && sweep.do_vertex_and_face_meet(i, 3, 4, 5, g.side, sign))
        found.add(Axis_obstacle::Kind::vertex_face, {v[i], v[3], v[4], v[5]});
      if ((g.owned >> i & 1) != 0 && !is_shared(3 + i) && sweep.do_vertex_and_face_meet(3 + i, 0, 1, 2, f.side, sign))
        found.add(Axis_obstacle::Kind::vertex_face, {v[3 + i], v[0], v[1], v[2]});
    }
    for (int i = 0; i < 3; ++i) {
      const int a = i, b = (i + 1) % 3;
      if ((f.owned >> i & 8) == 0)
        continue;
      for (int k = 0; k < 3; ++k) {
        const int c = 3 + k, d = 3 + (k + 1) % 3;
        if ((g.owned >> k & 8) == 0 || v[a] == v[c] || v[a] == v[d] || v[b] == v[c] || v[b] == v[d])
          continue;
        if (sweep.do_edges_meet(a, b, c, d, sign))
          found.add(Axis_obstacle::Kind::edge_edge, {v[a], v[b], v[c], v[d]});
      }
    }
  }

private:
  static constexpr std::uint32_t ahead = 8; ///< slots

  const Mesh* mesh_;
  double delta_ = 0;
  bool are_all_ = false;
  std::vector<Axis_item> items_;
  std::vector<std::uint32_t> slot_of_face_; ///< of those taken
  std::vector<Vertex> vertices_;            ///< corners of what is taken; others are as they were left
  std::vector<Axis_place> places_;          ///< theirs

  bool does_move(const Axis_item& item) const {
    const auto& v = item.corners;
    return vertices_[v[0]].moves || vertices_[v[1]].moves || vertices_[v[2]].moves;
  }

  /// Each vertex and each edge is looked at with one of its faces.
  Axis_item item_of(Face_index f) const {
    Axis_item item{{}, 0, 0};
    auto h = mesh_->prev(mesh_->halfedge(f));
    for (int i = 0; i < 3; ++i) {
      const Vertex_index v = mesh_->target(h);
      item.corners[i] = index(v);
      const auto at = mesh_->halfedge(v);
      if ((mesh_->is_border(at) ? mesh_->face(mesh_->opposite(at)) : mesh_->face(at)) == f)
        item.owned = static_cast<std::uint8_t>(item.owned | 1u << i);
      h = mesh_->next(h);
      if (mesh_->is_border(mesh_->opposite(h)) || mesh_->halfedge(mesh_->edge(h)) == h)
        item.owned = static_cast<std::uint8_t>(item.owned | 8u << i);
    }
    return item;
  }

  /// A star all of whose faces are seen from one side is seen without a fold: its link, a closed curve that does not
  /// cross itself about an embedded vertex, goes round once.
  bool is_unfolded(std::uint32_t k) const {
    const Vertex& v = vertices_[k];
    return (are_all_ || v.moves) && (v.sides == 1u || v.sides == 4u);
  }
};

} // namespace haptic_sculpt::internal
