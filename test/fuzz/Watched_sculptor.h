// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fuzz/Choices.h>
#include <fuzz/Throwing_visitor.h>
#include <fuzz/any_response.h>
#include <fuzz/call_at_random.h>
#include <fuzz/require.h>
#include <oracle/exact_triangles.h>
#include <sculpting/Mesh_snapshot.h>
#include <sculpting/edits/failing_allocations.h>
#include <sculpting/public_functions/Callers_mode.h>

#include <haptic_sculpt/sculpting.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace haptic_sculpt::fuzz {

/// A Sculptor of a copy of a mesh that is looked at after each call, whether all promises hold. Memory runs out in the
/// calls, visitors throw, and callers have modes of rounding, as the choices say.
class Watched_sculptor {
public:
  using Mesh = meshes::Mesh;
  using Vertex_index = Mesh::Vertex_index;
  using Sculptor_type = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor>;

  /// What is to be known of a call.
  struct Call {
    std::size_t which = 0;            ///< a number, to tell of
    Edit_kind kind = Edit_kind::none; ///< of an edit by value
    bool is_compound = false;         ///< whether it makes several steps
    bool restores = false;            ///< whether it is undo or redo
  };

  Watched_sculptor(Choices& choices, const Mesh& mesh, double unit, Call_tally& tally)
      : choices_(choices)
      , unit_(unit)
      , tally_(tally)
      , at_first_(mesh)
      , mesh_(mesh)
      , heat_(mesh_.add_property_map<Vertex_index, double>("v:heat", 0).first)
      , label_(mesh_.add_property_map<Mesh::Face_index, std::int64_t>("f:label", 0).first)
      , parameters_(Sculptor_parameters().response(any_response(choices)))
      , sculptor_(mesh_, parameters_, Throwing_visitor{&visits_left_}) {
    for (const auto v : mesh_.vertices())
      heat_[v] = static_cast<double>(v.idx());
    for (const auto f : mesh_.faces())
      label_[f] = f.idx();
    sculptor_.keep(heat_, Interpolate_property());
    sculptor_.keep(label_);
    start_ = seen();
    ++tally_.guarded;
  }

  Sculptor_type& sculptor() { return sculptor_; }
  const Mesh& mesh() const { return mesh_; }
  Mesh& mesh_to_write() { return mesh_; }      ///< as a function of CGAL has it
  bool is_broken_off() const { return is_broken_off_; } ///< whether the Sculptor refuses for good

  /// A map of vertices to keep from now on, whose values are all 1; once.
  std::optional<Mesh::Property_map<Vertex_index, double>> one_more_map() {
    if (ones_)
      return std::nullopt;
    ones_ = mesh_.add_property_map<Vertex_index, double>("v:ones", 1).first;
    return ones_;
  }

  /// One call: in a mode, with failures. Ends the program where a promise is broken.
  template <class Function>
  void make(const Call& call, const Function& function) {
    const std::uint8_t mode = choices_.byte(), failure = choices_.byte();
    constexpr int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    const bool fails = failure % 8 == 1, fails_for_good = failure & 8, throws = failure % 8 == 2;
    const std::size_t nth = 1 + (failure >> 4) + (fails || throws ? choices_.below(32) : 0);
    call_ = call;
    const Seen before = seen();
    const auto history = [view = sculptor_.history()] {
      return std::tuple(view.number_of_undo_steps(), view.number_of_redo_steps(), view.is_in_stroke());
    };
    const auto history_before = history();
    bool was_refused = false, lacked_memory = false, was_thrown = false, stands = true;
    ++tally_.calls;
    const auto call_it = [&] {
      std::optional<test::Failing_allocations> failing;
      if (fails)
        failing.emplace(nth, fails_for_good);
      function();
    };
    {
      const test::Callers_mode callers_mode(modes[mode % 4], mode % 32 >= 28);
      visits_left_ = throws ? nth : 0;
      try {
        call_it();
        ++tally_.done;
      } catch (const Unfinished_change&) {
        is_broken_off_ = true;
      } catch (const Error& error) {
        require(std::strstr(error.what(), "fault of haptic_sculpt") == nullptr, error.what());
        was_refused = true, ++tally_.refused;
      } catch (const std::bad_alloc&) {
        lacked_memory = true, ++tally_.out_of_memory;
      } catch (const Thrown&) {
        was_thrown = true, ++tally_.thrown;
      }
      visits_left_ = 0;
      stands = callers_mode.stands();
    }
    require(stands, "the caller's mode of rounding stands");
    require(!lacked_memory || fails, "memory runs out only where it does");
    bool refuses = is_broken_off_;
    try {
      sculptor_.check_unchanged();
    } catch (const Unfinished_change&) {
      refuses = true;
    }
    if (refuses) { // every call from now on
      require(fails_for_good && (call.restores || call.is_compound),
              "a change is broken off only where memory runs out again while a step is taken back");
      is_broken_off_ = true, ++tally_.broken_off;
      return;
    }
    require(!was_refused || seen() == before, "where a call was refused all is as it was");
    if (lacked_memory && !call.is_compound) {
      require(seen() == before, "where memory ran out all is as it was");
      require(history() == history_before, "where memory ran out the history is as it was");
    }
    is_recorded_ = is_recorded_ && !was_thrown && !(lacked_memory && call.is_compound);
    look(choices_.below(4) == 0);
  }

  /// Whether the surface is valid, by the library's oracle and by one that shares nothing with it, and numbers last.
  void look(bool by_integers) {
    require(mesh_.is_valid(false), "connectivity is consistent");
    const auto report = validate(mesh_);
    require(report.is_valid(), report.message().c_str());
    for (const auto v : mesh_.vertices())
      require(sculptor_.vertex(sculptor_.id(v)) == v, "numbers lead back");
    if (ones_)
      for (const auto v : mesh_.vertices()) // shares of ones, rounded in each edit
        require(std::fabs((*ones_)[v] - 1) < 1e-6, "a map that is kept from the middle on has the values of its own");
    if (!by_integers || mesh_.number_of_faces() > 16)
      return;
    oracle::Mesh_list list;
    std::map<Vertex_index, int> place;
    for (const auto v : mesh_.vertices()) {
      place[v] = static_cast<int>(list.points.size());
      list.points.push_back(vertex_coordinates(mesh_, v));
    }
    for (const auto f : mesh_.faces()) {
      const auto c = internal::corners_of_face(mesh_, f);
      list.faces.push_back({place[c[0]], place[c[1]], place[c[2]]});
    }
    require(oracle::improper_pairs(list).empty(), "no two faces meet improperly, by integers");
  }

  /// \param keeps_all whether no history was limited
  void undo_and_redo_all(bool keeps_all) {
    const Seen end = seen();
    std::size_t undone = 0;
    while (sculptor_.undo())
      ++undone;
    if (keeps_all)
      require(seen() == start_, "undo of all gives the bits of the start");
    look(false);
    for (; undone > 0; --undone)
      require(static_cast<bool>(sculptor_.redo()), "what was undone can be redone");
    require(seen().mesh == end.mesh, "redo of all gives the bits of the end");
  }

  /// Edits by value, made in another Sculptor, give the same bits; where these are all.
  void make_again(const std::vector<Edit>& made) {
    if (!is_recorded_)
      return;
    Mesh copy = at_first_;
    Sculptor<Mesh> other(copy, parameters_);
    for (const Edit& edit : made)
      other.apply(edit);
    const auto number = [&](Vertex_index v) { return other.id(v); };
    require(test::snapshot_of(copy, number) == seen().mesh, "edits by value, made again, give the same bits");
    ++tally_.made_again;
  }

  /// Says which call it was where a promise is broken.
  void require(bool holds, const char* promise) const {
    if (!holds)
      std::fprintf(stderr, "call %zu, by value %d, unit %a\n", call_.which, static_cast<int>(call_.kind), unit_);
    fuzz::require(holds, promise);
  }

private:
  /// All that can be seen of the mesh: points, faces, values.
  struct Seen {
    test::Mesh_snapshot mesh;
    std::map<std::size_t, double> heat;
    std::map<std::array<std::size_t, 3>, std::int64_t> labels; ///< by the numbers of the corners, the least first
    bool operator==(const Seen& other) const {
      return mesh == other.mesh && heat == other.heat && labels == other.labels;
    }
  };

  Seen seen() const {
    Seen all{test::snapshot(sculptor_), {}, {}};
    for (const auto v : mesh_.vertices())
      all.heat[sculptor_.id(v)] = heat_[v];
    for (const auto f : mesh_.faces()) {
      const auto corners = internal::corners_of_face(mesh_, f);
      std::array<std::size_t, 3> numbers;
      for (std::size_t k = 0; k < 3; ++k)
        numbers[k] = sculptor_.id(corners[k]);
      std::rotate(numbers.begin(), std::min_element(numbers.begin(), numbers.end()), numbers.end());
      all.labels[numbers] = label_[f];
    }
    return all;
  }

  Choices& choices_;
  const double unit_;
  Call_tally& tally_;
  const Mesh at_first_;
  Mesh mesh_;
  Mesh::Property_map<Vertex_index, double> heat_;
  Mesh::Property_map<Mesh::Face_index, std::int64_t> label_;
  std::optional<Mesh::Property_map<Vertex_index, double>> ones_; ///< one_more_map()
  std::size_t visits_left_ = 0;
  const Sculptor_parameters parameters_;
  Sculptor_type sculptor_;
  Seen start_;
  Call call_;
  bool is_recorded_ = true; ///< whether no exception came from a change that was made
  bool is_broken_off_ = false;
};

} // namespace haptic_sculpt::fuzz
