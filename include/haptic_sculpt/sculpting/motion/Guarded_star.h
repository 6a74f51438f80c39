// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_GUARDED_STAR_H
#define HAPTIC_SCULPT_SCULPTING_GUARDED_STAR_H

#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/contact/clearance.h>
#include <haptic_sculpt/sculpting/culling/Convex_star.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/sculpting/motion/Narrow_phase.h>
#include <haptic_sculpt/sculpting/motion/delta_limit.h>
#include <haptic_sculpt/sculpting/motion/stop.h>
#include <haptic_sculpt/sculpting/response/kkt_residual.h>
#include <haptic_sculpt/surface/broad_phase/fetch_ahead.h>
#include <haptic_sculpt/surface/coordinate_range.h>

namespace haptic_sculpt {

/// A star, or a probe, with the checklist of what it may touch: decides motions and makes legs that are proven free.
///
/// Knows nothing of who holds it; the mesh is read for candidates only.
template <class Mesh, class Broad_phase>
class Guarded_star {
public:
  using Coordinates = internal::Coordinates;
  using Vertex_index = typename Mesh::Vertex_index;

  /// \param watch is asked to fetch its copies of the candidates, where it is given
  Guarded_star(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners, Filter_counters& counters,
               const Mesh_watch<Mesh>* watch = nullptr)
    : mesh_(&mesh), broad_phase_(&broad_phase), corners_of_(&corners), watch_(watch), counters_(&counters),
      narrow_phase_(counters) {}

  Star<Mesh>& star() { return star_; }
  const Star<Mesh>& star() const { return star_; }
  const Checklist<Mesh>& checklist() const { return list_; }
  /// How often a checklist has been filled: it has changed when this has.
  std::size_t looks() const { return looks_; }

  /// Takes the star of a vertex, and asks for the memory that its first motion will read. Cost: the valence.
  void collect(Vertex_index v) {
    // While the star is read, each of whose faces is found by what memory tells of the last one, the broad phase can wait
    // for its own memory: the surroundings are about as large as those of the star before.
    if (!mesh_->is_isolated(v)) {
      const double size = usual_reach * link_extent();
      Box_3 about(vertex_coordinates(*mesh_, v));
      for (int i = 0; i < 3; ++i)
        about.lower[i] -= size, about.upper[i] += size;
      internal::fetch_ahead(*broad_phase_, about);
    }
    star_.collect(*mesh_, v, [this](Vertex_index neighbour) {
      prefetch_watched(neighbour);
      internal::fetch_on(*broad_phase_);
    });
    invalidate();
  }

  /// Whether a star is taken to make one motion only: then its candidates are looked up for that one, with no room for others.
  /// No decision depends on it.
  void expect_one_motion(bool on) { is_for_one_motion_ = on; }

  /// Makes room for a star and candidates of usual size.
  void reserve(std::size_t valence, std::size_t faces) {
    star_.reserve(valence);
    list_.reserve(valence, faces);
    candidates_.reserve(faces);
    whole_candidates_.reserve(faces);
    narrow_phase_.runs().reserve(valence + 3 * faces, 3 * faces);
    firsts_.reserve(faces);
  }

  /// Forget the candidates: an element outside the star has changed.
  void invalidate() {
    list_.clear();
    pairs_.clear();
    patience_ = 1, waited_ = 0;
    is_crowded_ = false;
  }

  /// Finds what stops the motion: `firsts()` and the delta limits that come exactly first, or neither. A target that is
  /// not in range, or no number, is blocked without either: whatever proposed it, no leg is made that is not proven.
  void decide(const Coordinates& source, const Coordinates& target, double delta) {
    firsts_.clear();
    limits_.clear();
    is_out_of_range_ = !internal::is_in_range(target);
    if (is_out_of_range_)
      return;
    if (!is_certainly_free(source, target))
      find_impacts(source, target);
    find_delta_limits(source, target, delta);
    if (limits_.empty() || firsts_.empty())
      return;
    const CGAL::Gmpq impact_time(firsts_[0].impact().exact_time().get_mpq_t());
    const CGAL::Comparison_result order = CGAL::compare(limits_[0].time, impact_time);
    if (order == CGAL::SMALLER)
      firsts_.clear();
    else if (order == CGAL::LARGER)
      limits_.clear();
  }

  const Star_impacts<Mesh>& firsts() const { return firsts_; }
  bool is_blocked() const { return is_out_of_range_ || !firsts_.empty() || !limits_.empty(); }

  /// Whether the target is in range and the closed way touches nothing and keeps the delta rule; exact.
  bool is_free(const Coordinates& source, const Coordinates& target, double delta) {
    if (!internal::is_in_range(target))
      return false;
    bool free = is_certainly_free(source, target);
    if (free)
      return keeps_delta(source, target, delta);
    if (has_pairs(source, target))
      free = narrow_phase_.is_free(star_, list_, pairs_, source, target);
    else
      look_along(source, target,
                 [&](const Swept_star_3&) { return !(free = narrow_phase_.is_free(star_, list_, source, target)); });
    return free && keeps_delta(source, target, delta);
  }

  /// One leg from source towards target: all the way if it is free, else proven up to a stop. Fills contacts and stop error.
  Coordinates leg(const Coordinates& source, const Coordinates& target, const Drag_rules& rules,
                  Drag_result<Mesh>& result) {
    ++result.legs;
    result.contacts.clear();
    result.stop_error = result.stop_error_along_path = 0;
    decide(source, target, rules.delta);
    if (!is_blocked())
      return target;
    // Of several simultaneous contacts the least setback decides: they meet in a point, and a clearance from one plane
    // through it is a clearance from it. The proof sees to the others.
    double steepest = 0, reach = 0;
    const double time = for_each_first_contact(source, target, [&](const Contact_3<Mesh>& contact, double sine) {
      steepest = std::fmax(steepest, sine > 0 ? sine : 1);
      reach = std::fmax(reach, internal::largest_coordinate_of(contact));
      result.contacts.push_back(contact);
    });
    reach = std::fmax(reach, internal::largest_magnitude(internal::point_of_path(source, target, time)));
    const Coordinates end =
        internal::stop_before(source, target, time, internal::setback(rules.clearance.at(reach), steepest),
                              [&](const Coordinates& q) { return is_free(source, q, rules.delta); });
    measure_stop(source, target, end, time, rules.delta, result);
    return end;
  }

  /// Calls `found(contact, sine)` for all that come first in the motion last decided; `sine` is that of the angle between
  /// the path and the contact plane. Returns when, as a fraction of the path. \pre is_blocked()
  template <class Found>
  double for_each_first_contact(const Coordinates& source, const Coordinates& target, const Found& found) const {
    double time = 1;
    for (const Star_impact<Mesh>& first : firsts_) {
      const internal::Path_at_plane at = internal::path_at_plane(first.impact());
      time = at.time;
      found(haptic_sculpt::contact_of(first, at), at.sine);
    }
    for (const Limit& limit : limits_) {
      const Contact_3<Mesh> contact = contact_of_limit(limit, source, target, time);
      found(contact, -internal::dot(contact.normal, internal::normalized(internal::minus(target, source))));
    }
    return time;
  }

private:
  /// The delta rule reached by face i of the star.
  struct Limit {
    std::size_t face;
    internal::Altitude_over side;
    internal::Limit_time time;
  };

  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  const Face_corners<Mesh>* corners_of_;
  const Mesh_watch<Mesh>* watch_;
  Filter_counters* counters_;
  Narrow_phase<Mesh, Filter_counters> narrow_phase_;
  Star<Mesh> star_;
  Checklist<Mesh> list_;
  std::size_t looks_ = 0;
  Near_pairs<Mesh> pairs_;
  int patience_ = 1, waited_ = 0;
  bool is_crowded_ = false; ///< the last long motion passed over many faces
  std::vector<typename Mesh::Face_index> candidates_, whole_candidates_;
  Star_impacts<Mesh> firsts_;
  std::vector<Limit> limits_;
  bool is_out_of_range_ = false; ///< of the motion last decided
  bool is_for_one_motion_ = false, has_looked_ = false; ///< has_looked_: the candidates are those of the motion at hand
  internal::Convex_star<Mesh> convex_star_;

  /// How much larger than the motion, in extents of the link, the region of a checklist is: of the first, which has to be filled from
  /// memory not seen lately, and of those that follow in one grab.
  static constexpr double first_margin = 0.125, region_margin = 0.5;

  /// From a vertex to the end of its first region, in extents of a link: half of one and the margin.
  static constexpr double usual_reach = 0.5 + first_margin;

  /// Pairs cost as much as to decide a motion or two without them, so they are taken at the second motion of a grab, and with every
  /// one that leaves the ball. Where they cannot be had, or are too many, they are tried again after twice as many motions.
  static constexpr int most_patience = 64;

  /// So many faces are looked at at once. Of a long way that passes over more, first a part is looked at, about as long as the star is
  /// wide, then sixteen times as much, up to a quarter of it: most long pushes that pass over many are soon stopped.
  static constexpr std::size_t few_faces = 192;
  static constexpr double least_part = 0x1p-10;

  void find_impacts(const Coordinates& source, const Coordinates& target) {
    if (has_pairs(source, target))
      narrow_phase_.first_impacts(star_, list_, pairs_, source, target, firsts_);
    else
      look_along(source, target, [&](const Swept_star_3& part) {
        narrow_phase_.first_impacts_near(star_, list_, source, target, part.path(), firsts_);
        return part.until < 1 && !firsts_.empty() && firsts_[0].impact().time().second <= part.until;
      });
  }

  /// A proof that costs less than the sweeps, where only one motion is to be decided. If there is none it leaves the candidates.
  bool is_certainly_free(const Coordinates& source, const Coordinates& target) {
    has_looked_ = false;
    if (!is_for_one_motion_ || star_.valence() == 0 || is_long(source, target) || !convex_star_.assign(star_, source, target))
      return false;
    look_at(star_.swept(source, target));
    has_looked_ = true;
    const auto is_apart = [&](typename Mesh::Face_index f) {
      const auto& corners = (*corners_of_)(f);
      return std::find(corners.begin(), corners.end(), star_.centre) != corners.end() || convex_star_.is_apart(*mesh_, corners);
    };
    return std::all_of(candidates_.begin(), candidates_.end(), is_apart);
  }

  /// Whether pairs cover the motion; takes them where it is worth while.
  bool has_pairs(const Coordinates& source, const Coordinates& target) {
    if (pairs_.cover(source, target))
      return true;
    if (is_for_one_motion_ || star_.valence() == 0 || is_long(source, target))
      return false;
    const bool is_due = ++waited_ > patience_;
    const std::size_t looks = looks_;
    look_around(source, target, is_due ? region_margin / 2 * link_extent() : 0);
    if (!is_due || looks_ != looks) // not both in one motion: it would be the slowest of all
      return false;
    waited_ = 0;
    pairs_.assign(star_, list_, narrow_phase_.runs(), source, target);
    const bool covered = pairs_.cover(source, target);
    patience_ = covered ? 0 : std::min(2 * patience_ + 1, most_patience);
    return covered;
  }

  /// Longer than the link is wide.
  bool is_long(const Coordinates& source, const Coordinates& target) const {
    double way = 0;
    for (int i = 0; i < 3; ++i)
      way = std::fmax(way, std::abs(target[i] - source[i]));
    return way > link_extent();
  }

  double link_extent() const {
    Box_3 link;
    for (const Coordinates& p : star_.link_points)
      link.include(p);
    double most = 0;
    for (int i = 0; i < 3; ++i)
      most = std::fmax(most, link.upper[i] - link.lower[i]);
    return most;
  }

  /// Makes the checklist complete for a motion that is not long, and `room` around it. Those of one grab share a list.
  void look_around(const Coordinates& source, const Coordinates& target, double room = 0) {
    Box_3 region = Box_3(source).include(target), with_room = region;
    for (int i = 0; i < 3; ++i)
      with_room.lower[i] -= room, with_room.upper[i] += room;
    if (list_.region().contains(with_room))
      return;
    const double margin = (list_.faces().empty() ? first_margin : region_margin) * link_extent();
    for (int i = 0; i < 3; ++i) {
      region.lower[i] -= margin;
      region.upper[i] += margin;
    }
    Swept_star_3 anywhere = star_.swept(region.lower, region.upper);
    anywhere.is_box = true;
    look_at(anywhere);
    take_candidates(region);
  }

  /// Makes the checklist complete for a motion, or for a part of it from the start, and calls `is_enough(part)`; for longer parts
  /// until that is true, and at last for the whole.
  template <class Is_enough>
  void look_along(const Coordinates& source, const Coordinates& target, const Is_enough& is_enough) {
    Swept_star_3 part = star_.swept(source, target);
    if (!is_long(source, target)) {
      if (is_for_one_motion_ && star_.valence() != 0) {
        if (!has_looked_)
          look_at(part);
        take_candidates();
      } else {
        look_around(source, target);
      }
      is_enough(part);
      return;
    }
    const bool has_looked = !is_crowded_;
    if (has_looked) {
      look_at(part);
      is_crowded_ = candidates_.size() > few_faces;
    }
    if (is_crowded_) {
      const double way = internal::path_length(source, target), size = std::fmax(link_extent(), way * least_part);
      std::swap(candidates_, whole_candidates_);
      part.until = 0.25;
      while (part.until > least_part && part.until * way > 2 * size)
        part.until /= 16;
      for (; part.until < 1; part.until *= 16) {
        look_at(part);
        take_candidates();
        if (is_enough(part))
          return;
      }
      part.until = 1;
      if (has_looked)
        std::swap(candidates_, whole_candidates_);
      else
        look_at(part);
      is_crowded_ = candidates_.size() > few_faces;
    }
    take_candidates();
    is_enough(part);
  }

  void look_at(const Swept_star_3& part) {
    candidates_.clear();
    broad_phase_->query(part, candidates_);
  }
  /// \param region empty for one motion alone: the next one asks again
  void take_candidates(const Box_3& region = Box_3()) {
    pairs_.clear();
    list_.assign(*mesh_, *corners_of_, star_, candidates_, region, [this](Vertex_index v) { prefetch_watched(v); });
    ++looks_;
  }

  void prefetch_watched(Vertex_index v) const {
    if (watch_ != nullptr)
      watch_->prefetch(v);
  }

  template <class Found>
  void for_each_delta_limit(const Coordinates& source, const Coordinates& target, double delta, const Found& found) const {
    if (delta <= 0)
      return;
    using internal::Altitude_over;
    for (std::size_t i = 0; i < star_.valence(); ++i)
      for (const Altitude_over side : {Altitude_over::gi, Altitude_over::ji, Altitude_over::jg})
        if (auto time = internal::delta_limit(source, target, star_.link_points[i], star_.link_points[star_.next(i)], delta,
                                              side))
          if (!found(Limit{i, side, *std::move(time)}))
            return;
  }

  bool keeps_delta(const Coordinates& source, const Coordinates& target, double delta) const {
    bool kept = true;
    for_each_delta_limit(source, target, delta, [&](const Limit&) { return kept = false; });
    return kept;
  }

  void find_delta_limits(const Coordinates& source, const Coordinates& target, double delta) {
    limits_.clear();
    for_each_delta_limit(source, target, delta, [&](Limit limit) {
      const CGAL::Comparison_result order = limits_.empty() ? CGAL::SMALLER : CGAL::compare(limit.time, limits_[0].time);
      if (order == CGAL::SMALLER)
        limits_.clear();
      if (order != CGAL::LARGER)
        limits_.push_back(std::move(limit));
      return true;
    });
  }

  /// Also tells the time in double.
  Contact_3<Mesh> contact_of_limit(const Limit& limit, const Coordinates& source, const Coordinates& target, double& time) const {
    const std::size_t next = star_.next(limit.face);
    time = CGAL::to_double(limit.time);
    Contact_3<Mesh> contact;
    contact.kind = Contact_kind::delta;
    const Vertex_index g = star_.link[limit.face], i = star_.link[next];
    contact.vertices = {g, i, limit.side == internal::Altitude_over::gi ? star_.centre
                              : limit.side == internal::Altitude_over::ji ? g : i};
    contact.normal = internal::altitude_gradient(internal::point_of_path(source, target, time),
                                                 star_.link_points[limit.face], star_.link_points[next], limit.side);
    contact.plane = {star_.link_points[limit.face], star_.link_points[next], star_.link_points[next]};
    contact.is_flat = true;
    return contact;
  }

  void measure_stop(const Coordinates& source, const Coordinates& target, const Coordinates& end, double time, double delta,
                    Drag_result<Mesh>& result) const {
    const double made = internal::length(internal::minus(end, source));
    result.stop_error_along_path = std::fmax(0.0, std::fma(time, internal::path_length(source, target), -made));
    double normal = std::numeric_limits<double>::infinity();
    for (const Contact_3<Mesh>& contact : result.contacts)
      if (!contact.is_flat)
        normal = std::fmin(normal, std::abs(internal::height_over_plane(contact.plane[0], contact.plane[1],
                                                                        contact.plane[2], end)));
    for (const Limit& limit : limits_)
      normal = std::fmin(normal, internal::altitude(end, star_.link_points[limit.face],
                                                    star_.link_points[star_.next(limit.face)], limit.side) - delta);
    result.stop_error = std::isfinite(normal) ? normal : result.stop_error_along_path;
  }
};

} // namespace haptic_sculpt

#endif
