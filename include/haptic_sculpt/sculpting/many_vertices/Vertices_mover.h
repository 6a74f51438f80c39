// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_VERTICES_MOVER_H
#define HAPTIC_SCULPT_SCULPTING_VERTICES_MOVER_H

#include <haptic_sculpt/sculpting/Move_report.h>
#include <haptic_sculpt/sculpting/many_vertices/Response_scope.h>
#include <haptic_sculpt/sculpting/many_vertices/leading_order.h>
#include <haptic_sculpt/sculpting/motion/stop.h>

namespace haptic_sculpt {
namespace internal {

/// Brings many vertices as near to their targets as single drags do (doc/many_vertices.md).
///
/// No drag ends farther from where it was to go than it began. So a vertex that goes by points of its way is never
/// farther from such a point than that point is from where it began, nor from its target than that was.
template <class Sculptor>
class Vertices_mover {
public:
  using Mesh = typename Sculptor::Mesh_type;
  using Moving = Moving_vertex<Mesh>;

  /// \param vertices successive ones near each other in space; all targets are in range
  /// \param are_short whether the ways are so short that few vertices stand in each other's way: then the first drags
  /// are made in a way that costs less where there is nothing in the way, and more where there is, and in any order
  Vertices_mover(Sculptor& sculptor, const std::vector<Moving>& vertices, const Move_parameters& parameters,
                 bool are_short)
      : sculptor_(sculptor), vertices_(vertices), parameters_(parameters), tries_whole_(are_short) {}

  /// Fills in what the report tells of drags, `cancelled` and `out_of_work`.
  void run(Move_report& report) {
    report_ = &report;
    asked_ = sum_left();
    const Response_scope scope(sculptor_, Response::stop, true);
    Positions behind = all_behind();
    // To be taken back if too many stay behind; else the log is of no use.
    log_.reserve(parameters_.takes_steps ? behind.size() : 0);
    stop_passes(behind, {1}, parameters_.takes_steps);
    tries_whole_ = false;
    if (behind.size() > few(vertices_.size()) && parameters_.takes_steps && goes_on_) {
      take_back();
      walk_in_steps();
    }
    log_ = {};
    finish();
  }

private:
  using Position = std::uint32_t; ///< in vertices_
  using Positions = std::vector<Position>;
  /// Where vertices go: to a share of their ways, all at once or one coordinate after the other.
  struct Aim {
    double share;
    int axis = -1; ///< 0, 1 or 2: only that coordinate; -1: all
  };
  /// A motion that was made.
  struct Made {
    Position position;
    Coordinates before;
  };

  /// Steps are not made shorter than this share of the way, nor than half the shortest edge of a vertex that moves,
  /// unless all can be made with so many drags: small meshes, whose faces are long.
  static constexpr double least_step = 1.0 / 128, affordable_drags = 50000;
  /// So many passes of slides are made when few are left.
  static constexpr int slide_passes_of_few = 3;
  /// A slide decides at most so many pairs: few need more, where parts lie close about each other, and these would take
  /// most of the time (doc/many_vertices.md).
  static constexpr std::size_t slide_work = 10000;
  /// One coordinate after the other is worth its three drags a vertex where it leaves no more than this share behind.
  static constexpr double axes_gain = 0.75;
  /// Another pass is made at the end while the last has gained more than this share of what was left, as a sum of
  /// distances, and more than this share of what was asked is left: to the origin there is no end of coming nearer.
  static constexpr double least_gain = 0.01, least_left = 0x1p-100;

  /// So few of n do not stand in each other's way as a whole: what blocks them is local.
  static std::size_t few(std::size_t n) { return 1 + n / 32; }
  /// So few of n may stay behind in a step where a shorter one may bring more along: those that do slide off their ways,
  /// and of a right angle that could arrive some never find back (doc/many_vertices.md).
  static std::size_t hardly_any(std::size_t n) { return n / 4096; }

  Sculptor& sculptor_;
  const std::vector<Moving>& vertices_;
  const Move_parameters& parameters_;
  Move_report* report_ = nullptr;
  std::vector<Made> log_; ///< of the step under way
  bool tries_whole_;
  bool goes_on_ = true; ///< neither cancelled nor out of work
  std::size_t behind_ = 0;
  double way_ = 1, asked_ = 0; ///< a share; a sum of distances

  Coordinates place(Position k) const { return vertex_coordinates(sculptor_.mesh(), vertices_[k].vertex); }
  double distance_left(Position k) const { return distance(place(k), vertices_[k].target); }

  Positions all_behind() const {
    Positions behind;
    for (Position k = 0; k < vertices_.size(); ++k)
      if (place(k) != vertices_[k].target)
        behind.push_back(k);
    return behind;
  }

  /// One drag. \return whether the vertex is there
  bool drag(Position k, const Coordinates& p) {
    ++report_->drags;
    if (tries_whole_ && sculptor_.move_if_free(vertices_[k].vertex, {p[0], p[1], p[2]}))
      return true;
    return sculptor_.grab(vertices_[k].vertex).drag_to({p[0], p[1], p[2]}).reached;
  }

  /// Whether another drag may be made; asks the progress function in its turn.
  bool may_drag() {
    if (!goes_on_)
      return false;
    if (report_->drags >= parameters_.drag_limit) {
      report_->out_of_work = true;
      return goes_on_ = false;
    }
    if (parameters_.progress_function && report_->drags % Move_parameters::drags_between_calls == 0 &&
        !parameters_.progress_function(Move_progress{vertices_.size(), behind_, report_->drags, way_})) {
      report_->cancelled = true;
      return goes_on_ = false;
    }
    return true;
  }

  /// Where a vertex is to go; where it is, unless that is nearer to the target.
  Coordinates aimed_at(Position k, const Aim& aim) const {
    const Moving& v = vertices_[k];
    const Coordinates from = place(k), p = aim.share == 1 ? v.target : point_of_path(v.source, v.target, aim.share);
    if (aim.axis < 0)
      return aim.share == 1 || is_farther(v.target, from, p) ? p : from;
    Coordinates to = from;
    if (std::abs(p[aim.axis] - v.target[aim.axis]) < std::abs(from[aim.axis] - v.target[aim.axis]))
      to[aim.axis] = p[aim.axis];
    return to;
  }

  /// Whether `from` is farther from the target than `to`. Rounded; so by more than rounding can do.
  static bool is_farther(const Coordinates& target, const Coordinates& from, const Coordinates& to) {
    return distance(from, target) * (1 - 0x1p-48) > distance(to, target);
  }

  /// Those that are not where they are to go, in an order in which they are least in each other's way: leaders first,
  /// and where the faces leave it open the foremost, along the axis or the sum of all ways.
  Positions ordered(const Positions& given, const Aim& aim) const {
    struct Motion {
      double advance;
      Position position;
      Moving moving;
    };
    std::vector<Motion> motions;
    motions.reserve(given.size());
    Vector whole{};
    for (const Position k : given)
      if (const Coordinates from = place(k), to = aimed_at(k, aim); from != to) {
        motions.push_back({0, k, {vertices_[k].vertex, from, to}});
        whole = plus(whole, minus(to, from));
      }
    whole = scaled(whole, unit_of(quick_magnitude(whole))); // its products with places stay in range
    for (Motion& motion : motions) {
      const Coordinates &from = motion.moving.source, &to = motion.moving.target;
      motion.advance = aim.axis < 0                      ? quick_dot(whole, minus(from, Coordinates{}))
                       : to[aim.axis] > from[aim.axis] ? from[aim.axis]
                                                       : -from[aim.axis];
    }
    std::sort(motions.begin(), motions.end(), [](const Motion& a, const Motion& b) {
      return std::make_pair(b.advance, a.position) < std::make_pair(a.advance, b.position);
    });
    std::vector<Moving> sorted;
    sorted.reserve(motions.size());
    for (const Motion& motion : motions)
      sorted.push_back(motion.moving);
    Positions order = leaders_first(sculptor_.mesh(), sorted);
    for (Position& k : order)
      k = motions[k].position;
    return order;
  }

  /// Drags those that are behind to where they aim, again while they at least halve, few while a tenth comes along.
  /// Leaves in `behind` those that stay behind.
  void stop_passes(Positions& behind, const Aim& aim, bool logs) {
    way_ = aim.share;
    if (!tries_whole_)
      behind = ordered(behind, aim);
    for (;;) {
      const std::size_t before = behind.size();
      pass(behind, aim, logs);
      const std::size_t gained = before - behind.size(), share = behind.size() <= few(vertices_.size()) ? 10 : 2;
      if (!goes_on_ || behind.empty() || gained == 0 || share * gained < before)
        return;
    }
  }

  /// Drags each once.
  void pass(Positions& behind, const Aim& aim, bool logs) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < behind.size(); ++i) {
      const Position k = behind[i];
      behind_ = behind.size() - i + kept;
      const Coordinates from = place(k), to = aimed_at(k, aim);
      if (from == to)
        continue;
      if (!may_drag()) {
        behind[kept++] = k;
        continue;
      }
      const bool reached = drag(k, to);
      if (logs && place(k) != from)
        log_.push_back({k, from});
      if (!reached)
        behind[kept++] = k;
    }
    behind.resize(kept);
  }

  /// Takes the motions of the log back, the last one first: each is free, for all stands as it did when the motion was
  /// made.
  void take_back() {
    for (; !log_.empty() && may_drag(); log_.pop_back())
      drag(log_.back().position, log_.back().before);
  }

  /// Brings all together to a share of their ways, by axes one coordinate after the other. \return those that stay
  /// behind, in their order
  Positions step_to(const Positions& going, double share, bool by_axes, bool logs) {
    Positions behind;
    for (int axis = by_axes ? 0 : 3; axis <= 3; ++axis) {
      behind = going;
      stop_passes(behind, {share, axis < 3 ? axis : -1}, logs); // at last all coordinates, for those that stay behind
    }
    std::sort(behind.begin(), behind.end());
    return behind;
  }

  /// All go on together, in steps that halve where some stay behind and double after two in which hardly any did. Few
  /// who stay behind in a step half as long too, or in the shortest, are left to slide; where those are many they are
  /// given up. The first step is tried both ways, straight and by axes, and the better one is kept to, but for the
  /// shortest steps: these are straight.
  void walk_in_steps() {
    Positions going = all_behind();
    const double shortest = shortest_step();
    double way = 0, step = 0.5;
    bool by_axes = false, is_first = true;
    std::size_t stuck = 0; // so many stay behind in any step
    std::size_t before = 0; // so many stayed behind in the step twice as long; 0: there was none
    for (int successes = 0; way < 1 && !going.empty();) {
      const double next = std::fmin(1, way + step);
      const bool is_shortest = step <= shortest, logs = is_first || !is_shortest;
      log_.clear();
      Positions behind = step_to(going, next, by_axes && !is_shortest, logs);
      if (std::exchange(is_first, false) && behind.size() > hardly_any(going.size())) {
        take_back();
        const std::size_t straight = behind.size();
        behind = step_to(going, next, true, logs);
        by_axes = static_cast<double>(behind.size()) < axes_gain * static_cast<double>(straight);
      }
      if (!goes_on_)
        return;
      const bool is_hopeless = is_shortest || (before > 0 && 2 * behind.size() > before);
      if (is_hopeless && behind.size() <= few(going.size()))
        stuck = std::max(stuck, behind.size());
      if (behind.size() <= std::max(stuck, hardly_any(going.size()))) {
        slide_few(behind, next);
        way = next, before = 0;
        if (++successes % 2 == 0)
          step *= 2;
        continue;
      }
      successes = 0, before = behind.size();
      if (is_shortest) {
        way = next, before = 0;
        give_up(going, behind);
      } else {
        take_back();
        step /= 2;
      }
      if (!goes_on_)
        return;
    }
  }

  /// So that they do not stay in the way of others.
  void slide_few(Positions& behind, double share) {
    if (behind.empty() || !parameters_.slides)
      return;
    const Response_scope scope(sculptor_, Response::slide, false, slide_work);
    for (int i = 0; i < slide_passes_of_few && goes_on_ && !behind.empty(); ++i)
      pass(behind, {share}, false);
  }

  /// Takes away from `going` what is in `behind`, which has the same order.
  static void give_up(Positions& going, const Positions& behind) {
    Positions left;
    std::set_difference(going.begin(), going.end(), behind.begin(), behind.end(), std::back_inserter(left));
    going = std::move(left);
  }

  /// As a share of the way: that on which the vertex with the longest way goes half the shortest edge.
  double shortest_step() const {
    const Mesh& mesh = sculptor_.mesh();
    double edge = std::numeric_limits<double>::infinity(), way = 0;
    for (const Moving& v : vertices_) {
      way = std::fmax(way, distance(v.source, v.target));
      if (!mesh.is_isolated(v.vertex))
        for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v.vertex)))
          edge = std::fmin(edge, distance(vertex_coordinates(mesh, mesh.source(h)), v.source));
    }
    const double affordable = static_cast<double>(vertices_.size()) / affordable_drags;
    return std::fmin(std::fmax(least_step, 0.5 * edge / way), affordable);
  }

  double sum_left() const {
    double sum = 0;
    for (Position k = 0; k < vertices_.size(); ++k)
      sum += distance_left(k);
    return sum;
  }

  /// Whole ways, stopped and then sliding, until a pass gains little.
  void finish() {
    passes_to_the_end(std::numeric_limits<int>::max());
    if (!parameters_.slides)
      return;
    const Response_scope scope(sculptor_, Response::slide, false, slide_work);
    passes_to_the_end(all_behind().size() <= few(vertices_.size()) ? slide_passes_of_few
                                                                   : std::numeric_limits<int>::max());
  }

  void passes_to_the_end(int most_passes) {
    double left = sum_left();
    for (int i = 0; i < most_passes && goes_on_ && left > least_left * asked_; ++i) {
      Positions behind = all_behind();
      way_ = 1;
      pass(behind, {1}, false);
      const double before = std::exchange(left, sum_left());
      if (!(before - left > least_gain * before))
        return;
    }
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
