// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Mesh_changed.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_box_tree.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_scene.h>
#include <haptic_sculpt/sculpting/axis_moves/Pair_budget.h>

namespace haptic_sculpt::internal {

/// Decides whether many vertices of a mesh can go at once along one axis, and holds those back that cannot: it reads
/// the mesh and changes nothing. The theorem is in doc/proofs/axis_moves.md.
///
/// All decisions are exact, and no result depends on the order in which pairs are looked at, nor on who shares the
/// work. \pre the mesh is closed and embedded
template <class Mesh>
class Axis_move {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  Axis_move(const Mesh& mesh, Filter_counters& counters) : mesh_(&mesh), counters_(&counters), scene_(mesh) {}

  /// Which faces are looked at from here on, until connectivity changes.
  /// \param faces near ones side by side \param are_all whether these are all; else at least those that move and all
  /// that these could meet. Cost: linear in what is taken
  void take(const std::vector<Face_index>& faces, bool are_all) {
    forget();
    scale_ = Box_scale([&](const auto& visit) {
      for (const Face_index f : faces)
        visit(vertex_coordinates(*mesh_, mesh_->target(mesh_->halfedge(f))));
    });
    tree_.resize(faces.size());
    scene_.take(faces, are_all); // last: then all has been taken
  }

  /// Connectivity is to change: what was taken is of no use any more.
  void forget() { scene_.forget(); }

  /// A motion of the vertices given, each once. \param delta 0: no rule \param run who shares the work of the motion
  /// \param most it is given up as soon as it is known that more would be held back; the search ends then
  /// \param work where it is not null, it is given up before anything is decided that would pass it, and what is
  /// decided is taken from it \pre every face of theirs has been taken
  void begin(int axis, const Axis_ways<Mesh>& ways, double delta, const Part_runner& run = Part_runner(),
             std::size_t most = std::numeric_limits<std::size_t>::max(), Pair_budget* work = nullptr) {
    run_ = run;
    held_ = 0;
    most_ = most;
    budget_ = work;
    counted_ = 0;
    is_too_much_ = false;
    obstacles_.clear();
    pulled_.clear();
    scene_.begin(axis, ways, delta);
    tree_.begin_round();
    active_.clear();
    for (std::uint32_t slot = 0; slot < items().size(); ++slot)
      if (items()[slot].moves)
        active_.push_back(slot);
    if (budget_ != nullptr && active_.size() > budget_->left()) {
      is_too_much_ = true;
      return;
    }
    look_at(items().size(), slots_a_part, [this](std::size_t k, Axis_findings& found) {
      const auto slot = static_cast<std::uint32_t>(k);
      scene_.fetch_ahead(slot);
      tree_.put(slot, Axis_box(scale_, scene_.look_along(slot, found.counters)), items()[slot].moves);
    });
    tree_.refit_all(run_);
    scene_.tell_corners();
    run_.in_ranges(items().size(), slots_a_part, [this](std::size_t first, std::size_t end) {
      for (std::size_t slot = first; slot < end; ++slot)
        scene_.find_folds(static_cast<std::uint32_t>(slot));
    });
    decide();
  }

  bool is_free() const { return obstacles_.empty() && !is_too_much_; }
  /// Whether it was given up because more would have been decided than may be.
  bool is_too_much() const { return is_too_much_; }
  /// All of the last round, the least first: as they were found they depend on the order of the broad phase. Where the
  /// motion was given up, those that were found till then.
  const std::vector<Axis_obstacle>& sorted_obstacles() {
    std::sort(obstacles_.begin(), obstacles_.end());
    return obstacles_;
  }

  /// Where the vertex is along the axis at the end, as far as it is held back by now.
  double end(Vertex_index v) const { return scene_.end_of(static_cast<std::uint32_t>(v)); }

  /// Holds vertices back until the motion is free: each by the least that some round proposes. Every round holds one
  /// back at least, and one held back `most_pulls` times stays where it is; standing still is free. \return false where
  /// it was given up \throw Mesh_changed where the mesh cannot have been embedded
  bool hold_back() {
    while (!is_free()) {
      if (is_given_up())
        return false;
      if (pulled_.empty())
        throw Mesh_changed("faces that do not move meet each other");
      pull();
      decide();
    }
    return true;
  }
  /// This many vertices are held back by now.
  std::size_t held() const { return held_; }

  /// Whether all of the mesh is looked at.
  bool has_taken_all() const { return scene_.has_taken_all(); }
  const std::vector<Axis_item>& items() const { return scene_.items(); } ///< what is looked at
  /// Bytes held, capacity included.
  std::size_t memory() const { return scene_.memory() + tree_.memory(); }

private:
  static constexpr std::uint8_t most_pulls = 20;
  /// That make a part, and parts that make a wave. No two parts share a node of the tree.
  static constexpr std::size_t slots_a_part = 512 * Axis_box_node::width, joins_a_part = 16, pairs_a_part = 4096,
                               parts_a_wave = 64;

  const Mesh* mesh_;
  Filter_counters* counters_;
  Part_runner run_;
  Box_scale scale_;
  std::size_t held_ = 0; ///< vertices that have been pulled, or are to be in this round
  std::size_t most_ = 0;
  Pair_budget* budget_ = nullptr;
  std::size_t counted_ = 0; ///< faces and pairs of this round
  bool is_too_much_ = false;
  Axis_scene<Mesh> scene_;
  Axis_box_tree tree_;
  std::vector<std::uint32_t> active_; ///< slots to be looked at in this round
  std::vector<Axis_findings> parts_;  ///< of a wave
  std::vector<Axis_obstacle> obstacles_;
  std::vector<std::uint32_t> pulled_; ///< vertices for which shares are proposed in this round
  std::vector<std::pair<std::uint32_t, std::uint32_t>> put_off_; ///< pairs of slots

  bool is_given_up() const { return held_ > most_ || is_too_much_; }

  /// Looks at n things, until it is known that the motion is given up: in waves, twice as many parts in each as in the
  /// one before. What a wave finds depends on how all was before it, and so not on who shares its parts.
  template <class Look>
  void look_at(std::size_t n, std::size_t things_a_part, const Look& look) {
    std::size_t most_parts = 1;
    for (std::size_t begin = 0; begin < n && !is_given_up(); most_parts = std::min(2 * most_parts, parts_a_wave)) {
      const std::size_t size = std::min(n - begin, most_parts * things_a_part);
      if (parts_.size() < most_parts)
        parts_.resize(most_parts);
      run_.in_ranges(size, things_a_part, [&](std::size_t first, std::size_t end) {
        Axis_findings& found = parts_[first / things_a_part];
        found.clear();
        for (std::size_t k = first; k < end; ++k)
          look(begin + k, found);
      });
      for (std::size_t k = 0; k * things_a_part < size; ++k) {
        *counters_ += parts_[k].counters;
        counted_ += parts_[k].work;
        for (const Axis_obstacle& obstacle : parts_[k].obstacles)
          add(obstacle);
        put_off_.insert(put_off_.end(), parts_[k].put_off.begin(), parts_[k].put_off.end());
      }
      begin += size;
      is_too_much_ = is_too_much_ || (budget_ != nullptr && counted_ > budget_->left());
    }
  }

  /// Takes what this round is to decide from what may be, or finds that it is too much: counted before anything is
  /// decided, so that it does not depend on the order of the tree when a round is given up half-way.
  void count_round() {
    counted_ = active_.size();
    const auto& joins = tree_.joins();
    look_at(joins.size(), joins_a_part, [&](std::size_t k, Axis_findings& found) {
      tree_.for_each_pair(joins[k], [&](std::uint32_t a, std::uint32_t b) {
        found.work += scene_.does_count(items()[a], items()[b]);
      });
    });
    if (!is_too_much_)
      budget_->take(std::exchange(counted_, 0));
  }

  /// One round: finds all obstacles and what they propose, or enough to give up. Pairs of which one face is to be held
  /// back anyway come last: where so much is in the way that it is given up, most pairs are such, and are spared.
  void decide() {
    obstacles_.clear();
    pulled_.clear();
    put_off_.clear();
    tree_.refit();
    if (budget_ != nullptr)
      count_round();
    look_at(active_.size(), slots_a_part,
            [this](std::size_t k, Axis_findings& found) { scene_.decide_face(items()[active_[k]], found); });
    if (is_given_up())
      return;
    const auto& joins = tree_.joins();
    look_at(joins.size(), joins_a_part, [&](std::size_t k, Axis_findings& found) {
      tree_.for_each_pair(joins[k], [&](std::uint32_t a, std::uint32_t b) {
        if (!pulled_.empty() && (scene_.is_pulled(items()[a]) || scene_.is_pulled(items()[b]))) {
          if (scene_.may_meet(items()[a], items()[b])) // of a hub's faces n^2/2 would be written down
            found.put_off.emplace_back(a, b);
        } else
          scene_.decide_pair(items()[a], items()[b], found);
      });
    });
    const auto last = std::move(put_off_);
    put_off_.clear();
    look_at(last.size(), pairs_a_part, [&](std::size_t k, Axis_findings& found) {
      scene_.decide_pair(items()[last[k].first], items()[last[k].second], found);
    });
  }

  /// Every obstacle proposes a share for some of its vertices, from the state as it is; of several the least holds.
  void add(const Axis_obstacle& found) {
    // Which of two edges comes first depends on the tree; shares are rounded, in an order of the vertices.
    const Axis_obstacle obstacle = found.in_order();
    obstacles_.push_back(obstacle);
    const auto& vertices = obstacle.vertices;
    const Axis_pull pull = pull_for(obstacle.kind, scene_.motion_of(vertices));
    bool is_any_pulled = false;
    for (int k = 0; k < obstacle.size(); ++k)
      is_any_pulled |= pull.is_pulled[k] && scene_.vertex(vertices[k]).moves;
    for (int k = 0; k < obstacle.size(); ++k) {
      auto& v = scene_.vertex(vertices[k]);
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
      scene_.vertex(k).is_pulled = false;
      activate_around(k);
    }
    std::sort(active_.begin(), active_.end());
    active_.erase(std::unique(active_.begin(), active_.end()), active_.end());
  }

  void shorten(std::uint32_t k) {
    auto& v = scene_.vertex(k);
    const double start = scene_.height(k), all = scene_.end_of(k), part = std::fma(v.share, all - start, start);
    const double end = all < start ? std::fmin(std::fmax(part, all), start) : std::fmax(std::fmin(part, all), start);
    v.share = 1;
    v.moves = ++v.pulls != most_pulls && end != start;
    scene_.set_end(k, v.moves ? end : start);
  }

  void activate_around(std::uint32_t k) {
    for (const Face_index f : mesh_->faces_around_target(mesh_->halfedge(Vertex_index(k))))
      if (f != mesh_->null_face()) {
        const std::uint32_t slot = scene_.slot(f);
        tree_.set(slot, Axis_box(scale_, scene_.motion_of(items()[slot].corners)), true);
        active_.push_back(slot);
      }
  }
};

} // namespace haptic_sculpt::internal
