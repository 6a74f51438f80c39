// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/culling/Star_candidates.h>
#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/motion/Delta_limits.h>
#include <haptic_sculpt/sculpting/motion/Narrow_phase.h>
#include <haptic_sculpt/surface/coordinate_range.h>

namespace haptic_sculpt::internal {

/// Asks for no memory ahead.
struct Fetch_nothing {
  template <class Descriptor>
  void operator()(Descriptor) const {}
};

/// A star, or a probe, with its candidates: decides motions and makes legs that are proven free.
///
/// Knows nothing of who holds it or watches the mesh, which is read for candidates only. All motions of a drag are
/// decided here, and here alone is said that one is free: never of a target that is not in range, and never once the
/// work is spent. \tparam Traits decide the sweeps: a model of SweptCollisionTraits_3
template <class Mesh, class Broad_phase, class Traits = Exact_sweep_traits<Mesh>, class Fetch = Fetch_nothing>
class Guarded_star {
public:
  using Impact = Star_impact<Mesh, typename Traits::Impact_3>;
  using Vertex_index = typename Mesh::Vertex_index;
  using Coordinates = internal::Coordinates;

  Guarded_star(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners, const Traits& traits,
               Fetch fetch = Fetch())
    : narrow_phase_(traits)
    , candidates_(mesh, broad_phase, corners, narrow_phase_.runs(), narrow_phase_.work(), std::move(fetch)) {}
  Guarded_star(const Guarded_star&) = delete; // the candidates refer to the narrow phase
  Guarded_star& operator=(const Guarded_star&) = delete;

  Star<Mesh>& star() { return candidates_.star(); }
  const Star<Mesh>& star() const { return candidates_.star(); }
  const Candidate_list<Mesh>& candidate_list() const { return candidates_.list(); }
  std::size_t looks() const { return candidates_.looks(); }
  void collect(Vertex_index v) { candidates_.collect(v); }
  void invalidate() { candidates_.invalidate(); }
  void expect_one_motion(bool on) { candidates_.expect_one_motion(on); }
  void reserve(std::size_t valence, std::size_t faces) {
    candidates_.reserve(valence, faces);
    firsts_.reserve(faces);
  }

  /// What its decisions have cost, and may.
  Work& work() { return narrow_phase_.work(); }
  const Work& work() const { return narrow_phase_.work(); }
  bool is_spent() const { return narrow_phase_.work().is_spent(); }

  /// A decided motion. Refers to what the star has found: of use until the star decides the next one.
  class Decision {
  public:
    /// Whether the target is in range, and the closed way to it touches nothing and keeps the delta rule; exact.
    bool is_free() const { return is_free_; }

    /// The first of those that come exactly first.
    std::optional<Impact> first_impact() const {
      return star_->firsts_.empty() ? std::nullopt : std::optional<Impact>(star_->firsts_[0]);
    }

    /// Calls `found(contact, sine)` for all that come exactly first; `sine` is that of the angle between the path and
    /// the contact plane. There are none where the motion is free, out of range, or cost more than the work that was
    /// left. Returns when, as a fraction of the path.
    template <class Found>
    double for_each_first_contact(const Found& found) const {
      double time = 1;
      for (const Impact& first : star_->firsts_) {
        const Path_at_plane at = path_at_plane(first.impact());
        time = at.time;
        found(internal::contact_of(first, at), at.sine);
      }
      if (!star_->limits_.empty())
        time = star_->limits_.for_each_contact(star_->star(), source_, target_, [&](const Contact_3<Mesh>& contact) {
          found(contact, -dot(coordinates(contact.normal), normalized(minus(target_, source_))));
        });
      return time;
    }

  private:
    friend class Guarded_star;
    const Guarded_star* star_;
    Coordinates source_, target_;
    bool is_free_;

    Decision(const Guarded_star& star, const Coordinates& source, const Coordinates& target, bool is_free)
      : star_(&star), source_(source), target_(target), is_free_(is_free) {}
  };

  /// Finds what stops the motion: the impacts and the delta limits that come exactly first.
  Decision decide(const Coordinates& source, const Coordinates& target, double delta) {
    firsts_.clear();
    limits_.clear();
    if (is_in_range(target) && !is_spent()) {
      if (!candidates_.is_certainly_free(source, target))
        find_first_impacts(source, target);
      if (is_spent()) // others might come before them
        firsts_.clear();
      else {
        limits_.find(star(), source, target, delta);
        keep_the_first();
      }
    }
    const bool is_free = firsts_.empty() && limits_.empty() && is_in_range(target) && !is_spent();
    return Decision(*this, source, target, is_free);
  }

  /// Only whether it is free: costs less.
  bool is_free(const Coordinates& source, const Coordinates& target, double delta) {
    if (!is_in_range(target) || is_spent())
      return false;
    bool free = candidates_.is_certainly_free(source, target);
    if (!free && candidates_.has_pairs(source, target))
      free = narrow_phase_.is_free(star(), candidate_list(), candidates_.pairs(), source, target);
    else if (!free)
      candidates_.look_along(source, target, [&](const Swept_star_3&) {
        return !(free = narrow_phase_.is_free(star(), candidate_list(), source, target));
      });
    return free && !is_spent() && Delta_limits<Mesh>::are_kept(star(), source, target, delta);
  }

  /// One leg from source towards target: all the way if it is free, else proven up to a stop. Fills contacts and stop
  /// error.
  Coordinates leg(const Coordinates& source, const Coordinates& target, const Drag_rules& rules,
                  Drag_result<Mesh>& result) {
    ++result.legs;
    result.contacts.clear();
    result.stop_error = result.stop_error_along_path = 0;
    const Decision decision = decide(source, target, rules.delta);
    if (decision.is_free())
      return target;
    // Of several simultaneous contacts the least setback decides: they meet in a point, and a clearance from one plane
    // through it is a clearance from it. The proof sees to the others.
    double steepest = 0, reach = 0;
    const double time = decision.for_each_first_contact([&](const Contact_3<Mesh>& contact, double sine) {
      steepest = std::fmax(steepest, sine > 0 ? sine : 1);
      reach = std::fmax(reach, largest_coordinate_of(contact));
      result.contacts.push_back(contact);
    });
    if (result.contacts.empty())
      return source; // the work is spent
    reach = std::fmax(reach, largest_magnitude(point_of_path(source, target, time)));
    const Coordinates end = stop_before(source, target, time, setback(rules.clearance.at(reach), steepest),
                                        [&](const Coordinates& q) { return is_free(source, q, rules.delta); });
    measure_stop(source, target, end, time, rules.delta, result);
    return end;
  }

private:
  Narrow_phase<Mesh, Traits> narrow_phase_;
  Star_candidates<Mesh, Broad_phase, Fetch> candidates_;
  typename Narrow_phase<Mesh, Traits>::Impacts firsts_;  ///< of the motion last decided
  Delta_limits<Mesh> limits_;  ///< the same

  void find_first_impacts(const Coordinates& source, const Coordinates& target) {
    if (candidates_.has_pairs(source, target))
      narrow_phase_.first_impacts(star(), candidate_list(), candidates_.pairs(), source, target, firsts_);
    else
      candidates_.look_along(source, target, [&](const Swept_star_3& part) {
        narrow_phase_.first_impacts_near(star(), candidate_list(), source, target, part.path(), firsts_);
        return is_spent() || (part.until < 1 && !firsts_.empty() && firsts_[0].impact().time().second <= part.until);
      });
  }

  void keep_the_first() {
    if (limits_.empty() || firsts_.empty())
      return;
    const CGAL::Gmpq impact_time(firsts_[0].impact().exact_time().get_mpq_t());
    const CGAL::Comparison_result order = CGAL::compare(limits_.time(), impact_time);
    if (order == CGAL::SMALLER)
      firsts_.clear();
    else if (order == CGAL::LARGER)
      limits_.clear();
  }

  void measure_stop(const Coordinates& source, const Coordinates& target, const Coordinates& end, double time,
                    double delta, Drag_result<Mesh>& result) const {
    const double made = length(minus(end, source));
    result.stop_error_along_path = std::fmax(0.0, std::fma(time, path_length(source, target), -made));
    double normal = limits_.least_distance(star(), source, end, delta);
    for (const Contact_3<Mesh>& contact : result.contacts)
      if (!contact.is_flat)
        normal = std::fmin(normal, std::abs(height_over_plane(contact, end)));
    // The stop is proven free: below 0 is what rounding has left of a distance.
    result.stop_error = std::isfinite(normal) ? std::fmax(0.0, normal) : result.stop_error_along_path;
  }
};

} // namespace haptic_sculpt::internal
