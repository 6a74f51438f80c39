// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_AXIS_MOVE_H
#define HAPTIC_SCULPT_SCULPTING_AXIS_MOVE_H

#include <haptic_sculpt/sculpting/Mesh_changed.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_box_tree.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_item.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_obstacle.h>
#include <haptic_sculpt/sculpting/axis_moves/axis_delta.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/broad_phase/spatial_order.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt {
namespace internal {

/// Vertices, and where each is to be along an axis.
template <class Mesh>
using Axis_ways = std::vector<std::pair<typename Mesh::Vertex_index, double>>;

/// Decides whether many vertices of a mesh can go at once along one axis, and holds those back that cannot: it reads
/// the mesh and changes nothing. The theorem is in doc/proofs/axis_moves.md.
///
/// All decisions are exact, and no result depends on the order in which pairs are looked at.
/// \pre the mesh is closed and embedded
template <class Mesh>
class Axis_move {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  Axis_move(const Mesh& mesh, Filter_counters& counters) : mesh_(&mesh), counters_(&counters) {}

  /// Which faces are looked at from here on, until connectivity changes.
  /// \param faces near ones side by side \param are_all whether these are all; else at least those that move and all
  /// that these could meet. Cost: linear in what is taken
  void take(const std::vector<Face_index>& faces, bool are_all) {
    are_all_ = are_all;
    scale_ = Box_scale([&](const auto& visit) {
      for (const Face_index f : faces)
        visit(vertex_coordinates(*mesh_, mesh_->target(mesh_->halfedge(f))));
    });
    items_.clear();
    items_.reserve(faces.size());
    if (slot_of_face_.size() < mesh_->num_faces())
      slot_of_face_.resize(mesh_->num_faces());
    if (vertices_.size() < mesh_->num_vertices())
      vertices_.resize(mesh_->num_vertices());
    for (const Face_index f : faces) {
      slot_of_face_[f] = static_cast<std::uint32_t>(items_.size());
      items_.push_back(item_of(f));
    }
    tree_.resize(items_.size());
  }

  /// Connectivity is to change: what was taken is of no use any more.
  void forget() { are_all_ = false; }

  /// A motion of the vertices given, each once. \param delta 0: no rule \param most it is given up as soon as it is
  /// known that more would be held back; the search ends then. \pre every face of theirs has been taken
  void begin(int axis, const Axis_ways<Mesh>& ways, double delta,
             std::size_t most = std::numeric_limits<std::size_t>::max()) {
    axis_ = axis;
    delta_ = delta;
    held_ = 0;
    most_ = most;
    if (are_all_)
      vertices_.assign(vertices_.size(), Vertex{});
    else
      for (const Item& item : items_)
        for (const std::uint32_t v : item.corners)
          vertices_[v] = Vertex{};
    tree_.begin_round();
    for (const auto& [v, end] : ways)
      if (end != height(index(v)))
        vertices_[index(v)].end = end, vertices_[index(v)].moves = true;
    active_.clear();
    for (std::uint32_t slot = 0; slot < items_.size(); ++slot) {
      Item& item = items_[slot];
      const Axis_motion<3> motion = motion_of(item.corners);
      item.side = static_cast<std::int8_t>(Axis_sweep<3, Filter_counters>(motion, *counters_).seen(0, 1, 2));
      for (const std::uint32_t v : item.corners)
        vertices_[v].sides = static_cast<std::uint8_t>(vertices_[v].sides | 1u << (item.side + 1));
      set(slot, motion, does_move(item));
    }
    for (Item& item : items_)
      item.unfolded = static_cast<std::uint8_t>(is_unfolded(item.corners[0]) | is_unfolded(item.corners[1]) << 1 |
                                                is_unfolded(item.corners[2]) << 2);
    decide();
  }

  bool is_free() const { return obstacles_.empty(); }
  /// All of the last round; where the motion was given up, those that were found till then.
  const std::vector<Axis_obstacle>& obstacles() const { return obstacles_; }

  /// Where the vertex is along the axis at the end, as far as it is held back by now.
  double end(Vertex_index v) const { return end_of(index(v)); }

  /// Holds vertices back until the motion is free: each by the least that some round proposes. Every round holds one
  /// back at least, and one held back `most_pulls` times stays where it is; standing still is free. \return false where
  /// it was given up \throw Mesh_changed where the mesh cannot have been embedded
  bool hold_back() {
    while (!is_free()) {
      if (pulled_.empty())
        throw Mesh_changed("faces that do not move meet each other");
      if (is_given_up())
        return false;
      pull();
      decide();
    }
    return true;
  }
  /// This many vertices are held back by now.
  std::size_t held() const { return held_; }

  /// Whether all of the mesh is looked at.
  bool has_taken_all() const { return are_all_; }
  const std::vector<Axis_item>& items() const { return items_; } ///< what is looked at
  /// Bytes held, capacity included.
  std::size_t memory() const {
    return items_.capacity() * sizeof(Item) + slot_of_face_.capacity() * sizeof(std::uint32_t) +
           vertices_.capacity() * sizeof(Vertex) + tree_.memory();
  }

private:
  using Item = Axis_item;
  struct Vertex {
    double end = 0;    ///< where it moves
    double share = 1;  ///< proposed in this round
    std::uint8_t sides = 0; ///< bits: whether a face around it is seen from below, on edge, from above
    std::uint8_t pulls = 0;
    bool moves = false, is_pulled = false;
  };
  static constexpr std::uint8_t most_pulls = 20;

  const Mesh* mesh_;
  Filter_counters* counters_;
  double delta_ = 0;
  int axis_ = 0;
  Box_scale scale_;
  bool are_all_ = false;
  std::size_t held_ = 0; ///< vertices that have been pulled, or are to be in this round
  std::size_t most_ = 0;
  std::vector<Item> items_; ///< by slot, in the order of space
  std::vector<std::uint32_t> slot_of_face_; ///< of those taken
  std::vector<Vertex> vertices_;            ///< corners of what is taken; others are as they were left
  Axis_box_tree tree_;
  std::vector<std::uint32_t> active_; ///< slots to be looked at in this round
  std::vector<Axis_obstacle> obstacles_;
  std::vector<std::uint32_t> pulled_; ///< vertices for which shares are proposed in this round
  std::vector<std::pair<std::uint32_t, std::uint32_t>> put_off_; ///< pairs of slots

  static std::uint32_t index(Vertex_index v) { return static_cast<std::uint32_t>(v); }
  Coordinates point(std::uint32_t v) const { return vertex_coordinates(*mesh_, Vertex_index(v)); }
  double height(std::uint32_t v) const { return point(v)[axis_]; }
  double end_of(std::uint32_t v) const { return vertices_[v].moves ? vertices_[v].end : height(v); }
  bool does_move(const Item& item) const {
    const auto& v = item.corners;
    return vertices_[v[0]].moves || vertices_[v[1]].moves || vertices_[v[2]].moves;
  }

  template <std::size_t n>
  Axis_motion<n> motion_of(const std::array<std::uint32_t, n>& v) const {
    std::array<Coordinates, n> start;
    std::array<double, n> ends;
    for (std::size_t k = 0; k < n; ++k) {
      start[k] = point(v[k]);
      ends[k] = vertices_[v[k]].moves ? vertices_[v[k]].end : start[k][axis_];
    }
    return {axis_, start, ends};
  }

  /// Each vertex and each edge is looked at with one of its faces.
  Item item_of(Face_index f) const {
    Item item{{}, 0, 0};
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

  void set(std::uint32_t slot, const Axis_motion<3>& motion, bool is_active) {
    std::array<double, 3> ends;
    for (int k = 0; k < 3; ++k)
      ends[k] = motion.end[k][axis_];
    tree_.set(slot, Axis_box(scale_, axis_, motion.start, ends), is_active);
    if (is_active)
      active_.push_back(slot);
  }

  /// A star all of whose faces are seen from one side is seen without a fold: its link, a closed curve that does not
  /// cross itself about an embedded vertex, goes round once.
  bool is_unfolded(std::uint32_t k) const {
    const Vertex& v = vertices_[k];
    return (are_all_ || v.moves) && (v.sides == 1u || v.sides == 4u);
  }

  bool is_given_up() const { return held_ > most_; }

  /// One round: finds all obstacles and what they propose, or enough to give up. Pairs of which one face is to be held
  /// back anyway come last: where so much is in the way that it is given up, most pairs are such, and are spared.
  void decide() {
    obstacles_.clear();
    pulled_.clear();
    put_off_.clear();
    for (const std::uint32_t slot : active_)
      decide_face(items_[slot]);
    if (is_given_up())
      return;
    tree_.for_each_pair([this](std::uint32_t a, std::uint32_t b) {
      if (!pulled_.empty() && (is_pulled(items_[a]) || is_pulled(items_[b])))
        put_off_.emplace_back(a, b);
      else
        decide_pair(items_[a], items_[b]);
      return !is_given_up();
    });
    for (const auto& [a, b] : put_off_) {
      if (is_given_up())
        return;
      decide_pair(items_[a], items_[b]);
    }
  }

  bool is_pulled(const Item& item) const {
    const auto& v = item.corners;
    return vertices_[v[0]].is_pulled && vertices_[v[1]].is_pulled && vertices_[v[2]].is_pulled;
  }

  void decide_face(const Item& f) {
    if (f.side != 0 && delta_ == 0)
      return;
    const Axis_motion<3> motion = motion_of(f.corners);
    if (f.side == 0 && Axis_sweep<3, Filter_counters>(motion, *counters_).is_face_degenerate(0, 1, 2))
      add(Axis_obstacle::Kind::flat_face, {f.corners[0], f.corners[1], f.corners[2], f.corners[0]});
    else if (delta_ > 0 && !is_delta_kept(motion, delta_))
      add(Axis_obstacle::Kind::delta, {f.corners[0], f.corners[1], f.corners[2], f.corners[0]});
  }

  void decide_pair(const Item& f, const Item& g) {
    const unsigned shared_of_f = shared_corners(f, g);
    if (are_side_by_side(f, g, shared_of_f))
      return;
    const std::array<std::uint32_t, 6> v{f.corners[0], f.corners[1], f.corners[2],
                                         g.corners[0], g.corners[1], g.corners[2]};
    const Axis_motion<6> motion = motion_of(v);
    const Axis_sweep<6, Filter_counters> sweep(motion, *counters_);
    if (shared_of_f == 0 && (sweep.is_seen_beside(f.side, 0, 3) || sweep.is_seen_beside(g.side, 3, 0)))
      return;
    const unsigned shared = shared_of_f | shared_corners(g, f) << 3;
    const auto is_shared = [shared](int k) { return (shared >> k & 1) != 0; };
    for (int i = 0; i < 3; ++i) {
      if ((f.owned >> i & 1) != 0 && !is_shared(i) && sweep.do_vertex_and_face_meet(i, 3, 4, 5))
        add(Axis_obstacle::Kind::vertex_face, {v[i], v[3], v[4], v[5]});
      if ((g.owned >> i & 1) != 0 && !is_shared(3 + i) && sweep.do_vertex_and_face_meet(3 + i, 0, 1, 2))
        add(Axis_obstacle::Kind::vertex_face, {v[3 + i], v[0], v[1], v[2]});
    }
    for (int i = 0; i < 3; ++i) {
      const int a = i, b = (i + 1) % 3;
      if ((f.owned >> i & 8) == 0)
        continue;
      for (int k = 0; k < 3; ++k) {
        const int c = 3 + k, d = 3 + (k + 1) % 3;
        if ((g.owned >> k & 8) == 0 || v[a] == v[c] || v[a] == v[d] || v[b] == v[c] || v[b] == v[d])
          continue;
        if (sweep.do_edges_meet(a, b, c, d))
          add(Axis_obstacle::Kind::edge_edge, {v[a], v[b], v[c], v[d]});
      }
    }
  }

  /// Every obstacle proposes a share for some of its vertices, from the state as it is; of several the least holds.
  void add(Axis_obstacle::Kind kind, const std::array<std::uint32_t, 4>& vertices) {
    const Axis_obstacle obstacle{kind, vertices};
    obstacles_.push_back(obstacle);
    const Axis_pull pull = pull_for(kind, motion_of(vertices));
    bool is_any_pulled = false;
    for (int k = 0; k < obstacle.size(); ++k)
      is_any_pulled |= pull.is_pulled[k] && vertices_[vertices[k]].moves;
    for (int k = 0; k < obstacle.size(); ++k) {
      Vertex& v = vertices_[vertices[k]];
      if (!v.moves || (is_any_pulled && !pull.is_pulled[k]))
        continue;
      if (!v.is_pulled) {
        pulled_.push_back(vertices[k]);
        held_ += v.pulls == 0;
      }
      v.is_pulled = true;
      v.share = std::fmin(v.share, is_any_pulled ? pull.share : 0.5);
    }
  }

  /// Shortens the ways as proposed; what is around them is to be looked at again.
  void pull() {
    std::sort(pulled_.begin(), pulled_.end());
    for (const std::uint32_t k : pulled_)
      shorten(k);
    tree_.begin_round();
    active_.clear();
    for (const std::uint32_t k : pulled_) {
      vertices_[k].is_pulled = false;
      activate_around(k);
    }
    std::sort(active_.begin(), active_.end());
    active_.erase(std::unique(active_.begin(), active_.end()), active_.end());
  }

  void shorten(std::uint32_t k) {
    Vertex& v = vertices_[k];
    const double start = height(k), end = std::fma(v.share, v.end - start, start);
    v.end = v.end < start ? std::fmin(std::fmax(end, v.end), start) : std::fmax(std::fmin(end, v.end), start);
    v.share = 1;
    if (++v.pulls == most_pulls || v.end == start)
      v.moves = false;
  }

  void activate_around(std::uint32_t k) {
    const Vertex_index v(k);
    for (const Face_index f : mesh_->faces_around_target(mesh_->halfedge(v)))
      if (f != mesh_->null_face())
        set(slot_of_face_[static_cast<std::size_t>(f)],
            motion_of(items_[slot_of_face_[static_cast<std::size_t>(f)]].corners), true);
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
