// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/culling/Convex_star.h>
#include <haptic_sculpt/sculpting/culling/Near_pairs.h>
#include <haptic_sculpt/sculpting/geometry/Work.h>
#include <haptic_sculpt/sculpting/geometry/stop.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// A star, or a probe, and what it may touch: looks candidates up in the broad phase when the motions of a grab leave
/// the region for which they are known.
///
/// \tparam Fetch a function object `fetch(v)`, told of each vertex that will be read: to ask for memory ahead
template <class Mesh, class Broad_phase, class Fetch>
class Star_candidates {
public:
  using Vertex_index = typename Mesh::Vertex_index;

  /// \param runs working memory, to be shared \param work where faces looked up are counted
  Star_candidates(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners,
                  Star_runs<Mesh>& runs, Work& work, Fetch fetch)
    : mesh_(&mesh), broad_phase_(&broad_phase), corners_of_(&corners), runs_(&runs), work_(&work)
    , fetch_(std::move(fetch)) {}

  Star<Mesh>& star() { return star_; }
  const Star<Mesh>& star() const { return star_; }
  const Candidate_list<Mesh>& list() const { return list_; }
  const Near_pairs<Mesh>& pairs() const { return pairs_; }
  /// How often a list has been filled: it has changed when this has.
  std::size_t looks() const { return looks_; }

  /// Takes the star of a vertex, and asks for the memory that its first motion will read. Cost: the valence.
  void collect(Vertex_index v) {
    // While the star is read, each of whose faces is found by what memory tells of the last one, the broad phase can
    // wait for its own memory: the surroundings are about as large as those of the star before.
    const double size = usual_reach * link_extent();
    Box_3 about(vertex_coordinates(*mesh_, v));
    for (int i = 0; i < 3; ++i)
      about.lower[i] -= size, about.upper[i] += size;
    broad_phase_->fetch_ahead(about);
    star_.collect(*mesh_, v, [this](Vertex_index neighbour) {
      fetch_(neighbour);
      broad_phase_->fetch_on();
    });
    invalidate();
  }

  /// Whether a star is taken to make one motion only: then its candidates are looked up for that one, with no room for
  /// others. No decision depends on it.
  void expect_one_motion(bool on) { is_for_one_motion_ = on; }

  /// Makes room for a star and candidates of usual size.
  void reserve(std::size_t valence, std::size_t faces) {
    star_.reserve(valence);
    list_.reserve(valence, faces);
    candidates_.reserve(faces);
    whole_candidates_.reserve(faces);
    runs_->reserve(valence, valence + 3 * faces, 3 * faces);
  }

  /// Forget the candidates: an element outside the star has changed.
  void invalidate() {
    list_.clear();
    pairs_.clear();
    patience_ = 1, waited_ = 0;
    is_crowded_ = false, room_share_ = 1;
    crowded_way_ = std::numeric_limits<double>::infinity();
  }

  /// Whether there is a proof that the motion is free which costs less than the sweeps. Looked for where only one
  /// motion is to be decided; if there is none the faces found are left for the list.
  bool is_certainly_free(const Coordinates& source, const Coordinates& target) {
    has_looked_ = false;
    if (!is_for_one_motion_ || star_.valence() == 0 || is_long(source, target) ||
        !convex_star_.assign(star_, source, target))
      return false;
    look_at(star_.swept(source, target));
    has_looked_ = true;
    return !work_->is_spent() &&
           std::all_of(candidates_.begin(), candidates_.end(), [this](typename Mesh::Face_index f) {
             return convex_star_.is_apart(*mesh_, (*corners_of_)(f));
           });
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
    if (!is_due || looks_ != looks || work_->is_spent()) // not both in one motion: it would be the slowest of all
      return false;
    waited_ = 0;
    pairs_.assign(star_, list_, *runs_, source, target);
    const bool covered = pairs_.cover(source, target);
    patience_ = covered ? 0 : std::min(2 * patience_ + 1, most_patience);
    return covered;
  }

  /// Makes the list complete for a motion, or for a part of it from the start, and calls `is_enough(part)`; for longer
  /// parts until that is true, and at last for the whole. Does not call it where the work is spent before.
  template <class Is_enough>
  void look_along(const Coordinates& source, const Coordinates& target, const Is_enough& is_enough) {
    Swept_star_3 part = star_.swept(source, target);
    const bool is_listed = star_.valence() == 0 && look_about_probe(part);
    if (is_listed || !is_long(source, target)) {
      if (!is_listed)
        look_close_by(part);
      if (!work_->is_spent())
        is_enough(part);
      return;
    }
    const bool has_looked = !is_crowded_;
    if (has_looked) {
      look_at(part);
      is_crowded_ = candidates_.size() > few_faces;
    }
    if (is_crowded_) {
      const double way = path_length(source, target), size = std::fmax(link_extent(), way * least_part);
      std::swap(candidates_, whole_candidates_);
      part.until = 0.25;
      while (part.until > least_part && part.until * way > 2 * size)
        part.until /= 16;
      for (; part.until < 1; part.until *= 16) {
        look_at(part);
        if (!take_candidates() || is_enough(part))
          return;
      }
      part.until = 1;
      if (has_looked)
        std::swap(candidates_, whole_candidates_);
      else
        look_at(part);
      is_crowded_ = candidates_.size() > few_faces;
    }
    if (take_candidates())
      is_enough(part);
  }

private:
  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  const Face_corners<Mesh>* corners_of_;
  Star_runs<Mesh>* runs_;
  Work* work_;
  Fetch fetch_;
  Star<Mesh> star_;
  Candidate_list<Mesh> list_;
  Near_pairs<Mesh> pairs_;
  std::size_t looks_ = 0;
  int patience_ = 1, waited_ = 0;
  bool is_crowded_ = false; ///< the last long motion passed over many faces
  double room_share_ = 1;   ///< less where the room for others held more than a drag's work was for
  double crowded_way_ =
      std::numeric_limits<double>::infinity();          ///< about a probe's motion of half that length many were
  bool is_for_one_motion_ = false, has_looked_ = false; ///< has_looked_: the candidates are those of the motion at hand
  Convex_star<Mesh> convex_star_;
  std::vector<typename Mesh::Face_index> candidates_, whole_candidates_;

  /// How much larger than the motion, in extents of the link, the region of a list is: of the first, which has to be
  /// filled from memory not seen lately, and of those that follow in one grab.
  static constexpr double first_margin = 0.125, region_margin = 0.5;
  static constexpr double least_room = 0x1p-9; ///< of these: below it there is none

  /// From a vertex to the end of its first region, in extents of a link: half of one and the margin.
  static constexpr double usual_reach = 0.5 + first_margin;

  /// Pairs cost as much as to decide a motion or two without them, so they are taken at the second motion of a grab,
  /// and with every one that leaves the ball. Where they cannot be had, or are too many, they are tried again after
  /// twice as many motions.
  static constexpr int most_patience = 64;

  /// This many faces are looked at at once. Of a long way that passes over more, first a part is looked at, about as
  /// long as the star is wide, then sixteen times as much, up to a quarter of it: most long pushes that pass over many
  /// are soon stopped.
  static constexpr std::size_t few_faces = 192;
  static constexpr double least_part = 0x1p-10;

  /// About a probe's motion no more are listed: each motion looks through all of them.
  static constexpr std::size_t few_about_probe = 64;

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

  void look_close_by(const Swept_star_3& motion) {
    if (!is_for_one_motion_ || star_.valence() == 0) {
      look_around(motion.source, motion.target);
      return;
    }
    if (!has_looked_)
      look_at(motion);
    take_candidates();
  }

  /// Makes the list complete for a probe's motion and half as much about it, where few faces are: a slide makes many
  /// short motions about one place. Returns false, and nothing has changed, where there are many.
  bool look_about_probe(const Swept_star_3& motion) {
    Box_3 region = motion.path();
    if (list_.region().contains(region))
      return true;
    double way = 0;
    for (int i = 0; i < 3; ++i)
      way = std::fmax(way, region.upper[i] - region.lower[i]);
    if (is_for_one_motion_ || !(way < crowded_way_))
      return false;
    for (int i = 0; i < 3; ++i)
      region.lower[i] -= region_margin * way, region.upper[i] += region_margin * way;
    Swept_star_3 anywhere{region.lower, region.upper};
    anywhere.is_box = true;
    candidates_.clear();
    // Of a drag's work no more than a quarter: what is left has to do for the motions.
    if (!broad_phase_->query_star(anywhere, candidates_, std::min(few_about_probe, work_->left() / 4))) {
      crowded_way_ = way / 2;
      return false;
    }
    work_->spend(candidates_.size());
    take_candidates(region);
    return true;
  }

  /// Makes the list complete for a motion that is not long, and `room` around it. Those of one grab share a list. Where
  /// more is in the room than half of the work left the list is for the motion alone, and the next room is smaller: or
  /// a large star beside a fine surface would never move. A face beyond each of the link's edges is about any motion:
  /// work for these is not risked.
  void look_around(const Coordinates& source, const Coordinates& target, double room = 0) {
    const Box_3 motion = Box_3(source).include(target);
    if (list_.region().contains(grown(motion, room_share_ * room)))
      return;
    const double margin = room_share_ * (list_.faces().empty() ? first_margin : region_margin) * link_extent();
    const Box_3 region = grown(motion, margin);
    const std::size_t portion = (work_->left() - std::min(work_->left(), star_.valence())) / 2;
    const bool has_room = margin > 0 && portion > 0 && look_at(anywhere_in(region), portion);
    if (!has_room) {
      room_share_ = room_share_ > least_room ? room_share_ / 8 : 0;
      look_at(anywhere_in(motion));
    }
    if (!work_->is_spent() && candidates_.size() < portion / 8)
      room_share_ = std::fmin(1, std::fmax(least_room, 2 * room_share_));
    take_candidates(has_room ? region : motion);
  }

  static Box_3 grown(Box_3 box, double margin) {
    for (int i = 0; i < 3; ++i)
      box.lower[i] -= margin, box.upper[i] += margin;
    return box;
  }
  /// All motions of the star's centre within a box.
  Swept_star_3 anywhere_in(const Box_3& box) const {
    Swept_star_3 anywhere = star_.swept(box.lower, box.upper);
    anywhere.is_box = true;
    return anywhere;
  }

  void look_at(const Swept_star_3& part) { look_at(part, work_->left()); }
  /// Where more is near than there is work left, the work is spent and what was found is of no use.
  /// \param portion of what is left \return false where more is near than that, and the portion is spent
  bool look_at(const Swept_star_3& part, std::size_t portion) {
    candidates_.clear();
    const std::size_t most = portion < Work::unbounded - star_.valence() ? portion + star_.valence() : portion;
    if (broad_phase_->query_star(part, candidates_, most)) {
      leave_own_faces_out();
      if (candidates_.size() <= portion) {
        work_->spend(candidates_.size());
        return true;
      }
    }
    candidates_.clear(); // how many were found before it was given up is the broad phase's
    work_->spend(portion == work_->left() ? portion + 1 : portion);
    return false;
  }

  /// Where the star's own faces are the broad phase is not told before the vertex is let go: they do not count.
  void leave_own_faces_out() {
    if (star_.valence() == 0)
      return;
    std::size_t others = 0;
    for (const auto f : candidates_) {
      const auto& [a, b, c] = (*corners_of_)(f);
      candidates_[others] = f;
      others += (int(a == star_.centre) | int(b == star_.centre) | int(c == star_.centre)) == 0; // as good as random
    }
    candidates_.resize(others);
  }

  /// \param region empty for one motion alone: the next one asks again
  /// Returns false, and leaves the list as it was, where the work is spent.
  bool take_candidates(const Box_3& region = Box_3()) {
    if (work_->is_spent())
      return false;
    pairs_.clear();
    // The order in which pairs are decided tells how many are, for the first that is met ends a decision: it is not the
    // broad phase's.
    std::sort(candidates_.begin(), candidates_.end());
    list_.assign(*mesh_, *corners_of_, star_, candidates_, region, fetch_);
    ++looks_;
    return true;
  }
};

} // namespace haptic_sculpt::internal
