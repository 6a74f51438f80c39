// SPDX-License-Identifier: GPL-3.0-or-later
// Searches that a bound has cut: drag after drag, each trial is made once but for those that were cut, and what was
// left out or tried for another target is not kept in mind.
#include <haptic_sculpt/sculpting/response/Search_round.h>

#include <boost/test/unit_test.hpp>

#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <seeds_and_sizes.h>

using namespace haptic_sculpt::internal;

namespace {

using Search = Search_round::Search;

constexpr Slide_lengths lengths{1e-9, 1e-15};
const Vector place{1, 2, 3}, target{4, 5, 6}, near_target{4, 5, 6 + 1e-9}, other_target{4, 5, 6.5};

/// A search of trials of given costs.
struct Searcher {
  Search search;
  std::vector<std::size_t> costs;
  Search_memory memory = {};

  /// Whether the search came to its end. \param made the target of each trial that was finished
  bool go(Search_round& round, Work& work, const Vector& aim,
          std::map<std::pair<Search, std::size_t>, std::vector<Vector>>& made) {
    for (std::size_t i = 0; i < costs.size(); ++i)
      if (round.is_due(search, work)) {
        work.spend(costs[i]);
        if (!work.is_spent())
          made[{search, i}].push_back(aim);
      }
    if (!work.is_spent())
      round.note(memory);
    return !work.is_spent();
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(each_trial_is_made_once_or_left_out_where_it_costs_more_than_the_bound) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(1));
  int rounds_of_many_drags = 0, left_out = 0, came_back = 0;
  for (int k = 0; k < 2000; ++k) {
    std::array<Searcher, 3> searchers{{{Search::near_planes, {}}, {Search::corner, {}}, {Search::straight_ways, {}}}};
    const std::size_t bound = 1 + random() % 40;
    std::size_t too_costly = 0;
    for (auto& searcher : searchers)
      for (std::size_t i = random() % 12; i != 0; --i) {
        searcher.costs.push_back(random() % (k % 2 == 0 ? bound + 1 : bound + 5));
        too_costly += searcher.costs.back() > bound;
      }
    // Every third hand is at times elsewhere, and comes back.
    const auto next_aim = [&] {
      return k % 3 == 0 && random() % 3 == 0 ? other_target : random() % 2 == 0 ? target : near_target;
    };
    Search_round round;
    std::map<std::pair<Search, std::size_t>, std::vector<Vector>> made;
    std::set<bool> is_elsewhere;
    Vector aim{};
    bool has_ended = false;
    int drags = 0;
    for (; !has_ended && drags < 200; ++drags) {
      aim = next_aim();
      is_elsewhere.insert(aim == other_target);
      Work work;
      work.begin(bound);
      round.begin(work.is_bounded());
      round.search_at(place, aim, lengths);
      has_ended = true;
      for (auto& searcher : searchers)
        if (has_ended && !searcher.memory.holds(place, aim, lengths))
          has_ended = searcher.go(round, work, aim, made);
      round.end(work);
    }
    BOOST_REQUIRE(has_ended);
    BOOST_TEST(round.has_left_out() == (too_costly > 0));
    const bool is_proven = !round.has_left_out() && round.is_for_its_target();
    for (const auto& searcher : searchers)
      for (std::size_t i = 0; i < searcher.costs.size(); ++i) {
        const auto& aims = made[{searcher.search, i}];
        BOOST_REQUIRE(aims.size() == (searcher.costs[i] > bound ? 0u : 1u));
        BOOST_TEST((!is_proven || are_one_target(aims[0], aim, lengths)));
      }
    BOOST_TEST(searchers.back().memory.holds(place, aim, lengths) == is_proven);
    if (is_elsewhere.size() == 1 && too_costly == 0)
      BOOST_TEST(is_proven);
    came_back += !is_proven && too_costly == 0;
    rounds_of_many_drags += drags > 2;
    left_out += too_costly > 0;
  }
  BOOST_TEST(rounds_of_many_drags > 500);
  BOOST_TEST(left_out > 500);
  BOOST_TEST(came_back > 100);
}

// A target beyond reach is searched for nowhere.
BOOST_AUTO_TEST_CASE(a_drag_that_comes_to_no_search_knows_nothing_of_the_last_one) {
  Search_round round;
  for (const Vector& aim : {target, other_target}) {
    Work work;
    work.begin(10);
    round.begin(true);
    round.search_at(place, aim, lengths);
    BOOST_TEST(round.is_due(Search::corner, work));
    work.spend(11);
    round.end(work);
  }
  BOOST_TEST(round.has_left_out());
  BOOST_TEST(!round.is_for_its_target());
  for (const bool is_bounded : {true, false}) {
    round.begin(is_bounded);
    BOOST_TEST(!round.has_left_out());
    BOOST_TEST(round.is_for_its_target());
  }
}

BOOST_AUTO_TEST_CASE(elsewhere_without_a_bound_and_after_its_end_a_search_begins_anew) {
  for (const bool moves : {false, true})
    for (const bool is_bounded : {false, true})
      for (const bool is_cut : {false, true}) {
        Search_round round;
        Work work;
        work.begin(10);
        round.begin(true);
        round.search_at(place, target, lengths);
        for (int i = 0; i < 3; ++i)
          BOOST_TEST(round.is_due(Search::corner, work));
        work.spend(is_cut ? 11 : 10);
        BOOST_TEST(round.is_due(Search::corner, work) == !is_cut);
        round.end(work);
        round.begin(is_bounded);
        round.search_at(moves ? other_target : place, target, lengths);
        const bool goes_on = is_cut && is_bounded && !moves;
        BOOST_TEST(round.is_resumed(Search::corner) == goes_on);
        BOOST_TEST(!round.is_resumed(Search::straight_ways));
        work.begin(10);
        BOOST_TEST(round.is_due(Search::corner, work) == !goes_on);
      }
}
