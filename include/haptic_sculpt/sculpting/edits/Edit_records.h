// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/History_limit.h>
#include <haptic_sculpt/sculpting/edits/Change.h>
#include <haptic_sculpt/sculpting/edits/Record_queue.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

namespace haptic_sculpt::internal {

/// The changes made, and those taken back, in steps: what one undo takes back. A stroke is one step; any other change
/// is one each.
///
/// Within a stroke the moves between two other edits are kept once a vertex, from where it was first to where it was
/// last. Bytes: a move 56, a shift 48 and 24 for each vertex that it moves, another edit 72 and 8 for each vertex
/// around it, a step 16.
class Edit_records {
public:
  /// This many drags follow a `make_room()` without an allocation: a quarter of a minute of a hand that drags a
  /// thousand times a second. Of drags beyond, one in as many allocates. 1.2 MB.
  static constexpr std::size_t room = std::size_t{1} << 14;

  /// To be called where time does not matter: before a drag begins.
  void make_room() { reserve_records(room, 0, 0, room); }

  /// This many edits, of which each has up to eight vertices around in the mean, and this many moves allocate nothing.
  /// \param ids how many numbers of vertices there are then \param valence of the largest star
  void reserve(std::size_t edits, std::size_t moves, std::size_t ids, std::size_t valence) {
    if (is_off())
      return;
    reserve_records(moves, edits, edits * usual_words, edits + moves);
    reserve_ids(ids); // or the first stroke would fill it
    current_.around.reserve(std::max(valence, usual_words * usual_words));
  }

  /// Where there is more already, the oldest is forgotten.
  void set_limit(const History_limit& limit) {
    limit_ = limit;
    if (!is_between_steps())
      forget_redo();
    enforce();
    while (is_over())
      cut_last_step();
  }
  void forget() {
    const History_limit limit = limit_;
    set_limit(History_limit::off());
    set_limit(limit);
  }

  /// \name Strokes
  ///@{
  /// Begins a stroke, or joins the one under way. \return its number \param ids how many numbers of vertices there are
  std::size_t begin_stroke(std::size_t ids) {
    reserve_ids(ids);
    if (open_++ == 0) {
      ++stroke_;
      has_step_ = is_lost_ = false;
      first_of_run_ = moves_done_;
    }
    return stroke_;
  }
  /// Of those that began it, one ends the stroke of this number. Nothing, where it has ended already.
  void end_stroke(std::size_t number) {
    if (open_ != 0 && number == stroke_)
      --open_;
  }
  /// Whoever began it.
  void end_stroke() { open_ = 0; }
  bool is_in_stroke() const { return open_ != 0; }
  bool is_in_stroke(std::size_t number) const { return open_ != 0 && number == stroke_; }
  ///@}

  /// \name Going back and forth, change by change
  /// What is given here is good until something is given again.
  ///@{
  /// The change that was made last and not taken back; nullptr where there is none.
  const Change* to_undo() {
    if (number_of_undo_steps() == 0)
      return nullptr;
    return is_edit_last() ? read(edits_[edits_done_ - 1]) : read(moves_[moves_done_ - 1]);
  }
  /// The change that was taken back last; nullptr where there is none.
  const Change* to_redo() {
    if (is_edit_next())
      return read(edits_[edits_done_]);
    return moves_done_ < moves_.end() ? read(moves_[moves_done_]) : nullptr;
  }
  /// It has been taken back.
  void undone() {
    --(is_edit_last() ? edits_done_ : moves_done_);
    if (is_at(begin_of(steps_done_ - 1)))
      --steps_done_;
  }
  /// It has been made again.
  void redone() {
    if (is_between_steps())
      ++steps_done_;
    ++(is_edit_next() ? edits_done_ : moves_done_);
  }
  /// Whether no step is done in part. One is only while its changes are taken back or made again, and for good where
  /// the Sculptor refuses every call.
  bool is_between_steps() const { return is_at(begin_of(steps_done_)); }
  ///@}

  /// \name Numbers of edits other than moves, in the order made; those of edits taken back are given again
  ///@{
  std::size_t first_number() const { return edits_.begin(); }
  std::size_t number_to_undo() const { return edits_done_ - 1; }
  std::size_t number_to_redo() const { return edits_done_; }
  /// That of an edit that is made now; the largest number where it will not be recorded.
  std::size_t number_of_next() const { return is_off() ? std::numeric_limits<std::size_t>::max() : edits_done_; }
  ///@}

  /// One that is done in part counts.
  std::size_t number_of_undo_steps() const { return steps_done_ - steps_.begin(); }
  std::size_t number_of_redo_steps() const { return steps_.end() - steps_done_; }

  /// Of all that can be undone and redone.
  std::size_t bytes() const {
    return moves_.size() * sizeof(Move) + edits_.size() * sizeof(Other) + words_.size() * sizeof(std::size_t) +
           steps_.size() * sizeof(Place);
  }

protected:
  struct Move {
    std::size_t vertex;
    Coordinates before, after;
  };
  /// This many more of each, and these numbers of vertices, allocate nothing. \throw std::bad_alloc, and no record has
  /// changed
  void reserve_records(std::size_t moves, std::size_t edits, std::size_t words, std::size_t steps) {
    if (is_off())
      return;
    moves_.reserve(moves);
    edits_.reserve(edits);
    words_.reserve(words);
    steps_.reserve(steps);
  }
  void reserve_ids(std::size_t ids) {
    if (!is_off() && latest_.size() < ids)
      latest_.resize(ids, no_move);
  }
  /// That are kept of it besides.
  static std::size_t words_of(const Change& change) {
    return change.edit.kind == Edit_kind::shift ? 3 * change.starts.size() : 3 + change.around.size();
  }
  /// A new record. Clears what could be redone. \pre there is room
  void record_move(std::size_t vertex, const Coordinates& before, const Coordinates& after) {
    if (!begin_record())
      return;
    if (is_in_stroke()) {
      const std::size_t latest = latest_[vertex]; // maybe of another time
      if (latest >= first_of_run_ && latest < moves_.end() && moves_[latest].vertex == vertex) {
        moves_[latest].after = after;
        return;
      }
      latest_[vertex] = moves_done_;
    }
    moves_.push_back({vertex, before, after});
    ++moves_done_;
    end_record();
  }
  void record(const Change& change) {
    if (!begin_record())
      return;
    const Edit& edit = change.edit;
    edits_.push_back({edit.kind == Edit_kind::collapse ? change.before : edit.point, moves_done_, words_.end(),
                      static_cast<std::uint32_t>(words_of(change)), edit.kind, static_cast<std::uint8_t>(edit.axis)});
    const auto add = [this](std::size_t word) { words_.push_back(word); };
    if (edit.kind != Edit_kind::shift)
      std::for_each(edit.vertices.begin(), edit.vertices.end(), add);
    std::for_each(change.around.begin(), change.around.end(), add);
    for (std::size_t k = 0; k < edit.ways.size(); ++k)
      add(edit.ways[k].first), add(word_of(edit.ways[k].second)), add(word_of(change.starts[k]));
    ++edits_done_;
    first_of_run_ = moves_done_;
    end_record();
  }

private:
  /// An edit that is not a move.
  struct Other {
    Coordinates point; ///< of a collapse, where the vertex was before
    std::size_t moves_before; ///< the number of the first move that came later
    std::size_t first_word;   ///< of the vertices and those around; of a shift, of vertex, end and start of each way
    std::uint32_t words;      ///< how many there are
    Edit_kind kind;
    std::uint8_t axis;
  };
  /// Between two records.
  struct Place {
    std::size_t moves, edits;
  };
  static constexpr std::size_t usual_words = 11, no_move = std::numeric_limits<std::size_t>::max();

  Record_queue<Move, room> moves_;
  Record_queue<Other, 1024> edits_;
  Record_queue<std::size_t, 1024 * usual_words> words_;
  Record_queue<Place, room> steps_; ///< the end of each
  Place first_{0, 0};                         ///< the begin of the first step
  std::size_t moves_done_ = 0, edits_done_ = 0, steps_done_ = 0;
  Change current_; ///< what was given last
  History_limit limit_;

  std::size_t open_ = 0;                    ///< how many began the stroke under way and have not ended it
  std::size_t stroke_ = 0;                  ///< its number
  bool has_step_ = false, is_lost_ = false; ///< whether it is the last step; whether it is not kept
  std::size_t first_of_run_ = 0;            ///< the first move of the stroke since its last other edit
  std::vector<std::size_t> latest_;         ///< by number of vertex, its last move; maybe one that is no more

  static_assert(sizeof(std::size_t) == sizeof(double), "coordinates are kept among numbers of vertices");
  static std::size_t word_of(double x) {
    std::size_t word;
    std::memcpy(&word, &x, sizeof word);
    return word;
  }
  static double number_of(std::size_t word) {
    double x;
    std::memcpy(&x, &word, sizeof x);
    return x;
  }

  bool is_off() const { return limit_.steps == 0 || limit_.bytes == 0; }

  Place begin_of(std::size_t step) const { return step == steps_.begin() ? first_ : steps_[step - 1]; }
  bool is_at(const Place& place) const { return place.moves == moves_done_ && place.edits == edits_done_; }
  bool is_edit_last() const {
    return edits_done_ > edits_.begin() && edits_[edits_done_ - 1].moves_before == moves_done_;
  }

  /// Whether what was taken back last was an edit other than a move.
  bool is_edit_next() const { return edits_done_ < edits_.end() && edits_[edits_done_].moves_before == moves_done_; }

  const Change* read(const Move& move) {
    current_.edit.kind = Edit_kind::move;
    current_.edit.vertices[0] = move.vertex;
    current_.edit.point = move.after;
    current_.before = move.before;
    return &current_;
  }
  const Change* read(const Other& other) {
    Edit& edit = current_.edit;
    edit.kind = other.kind, edit.axis = other.axis;
    edit.point = current_.before = other.point;
    edit.ways.clear(), current_.starts.clear(), current_.around.clear();
    std::size_t k = other.first_word;
    const std::size_t end = k + other.words;
    if (other.kind == Edit_kind::shift)
      for (; k < end; k += 3) {
        edit.ways.emplace_back(words_[k], number_of(words_[k + 1]));
        current_.starts.push_back(number_of(words_[k + 2]));
      }
    else
      for (edit.vertices = {words_[k], words_[k + 1], words_[k + 2]}, k += 3; k < end; ++k)
        current_.around.push_back(words_[k]);
    return &current_;
  }

  /// \return false where nothing is to be kept of it
  bool begin_record() {
    forget_redo();
    is_lost_ |= is_in_stroke() && is_off(); // else what follows would be undone without this
    return !is_off() && !(is_in_stroke() && is_lost_);
  }

  /// Of a step that is done in part the rest, too.
  void forget_redo() {
    if (moves_done_ == moves_.end() && edits_done_ == edits_.end())
      return;
    cut_to(moves_done_, edits_done_);
    steps_.cut(steps_done_);
    if (number_of_undo_steps() != 0)
      steps_[steps_done_ - 1] = {moves_done_, edits_done_};
  }

  void end_record() {
    const Place end{moves_done_, edits_done_};
    if (is_in_stroke() && has_step_) {
      steps_[steps_done_ - 1] = end;
    } else {
      steps_.push_back(end);
      ++steps_done_;
      has_step_ = is_in_stroke();
    }
    enforce();
  }

  void cut_to(std::size_t moves, std::size_t edits) {
    if (edits < edits_.end())
      words_.cut(edits_[edits].first_word);
    moves_.cut(moves);
    edits_.cut(edits);
  }

  bool is_over() const { return steps_.size() != 0 && (steps_.size() > limit_.steps || bytes() > limit_.bytes); }

  /// Forgets what was done first, until the rest is within the limit. \pre is_between_steps()
  void enforce() {
    while (number_of_undo_steps() != 0 && is_over()) {
      // What comes after a change that cannot be undone cannot be either, so a stroke too large is not kept in part.
      is_lost_ |= is_in_stroke() && has_step_ && number_of_undo_steps() == 1;
      has_step_ &= !is_lost_;
      first_ = steps_[steps_.begin()];
      moves_.forget(first_.moves);
      words_.forget(first_.edits < edits_.end() ? edits_[first_.edits].first_word : words_.end());
      edits_.forget(first_.edits);
      steps_.forget(steps_.begin() + 1);
    }
  }

  /// \pre it can be redone
  void cut_last_step() {
    steps_.cut(steps_.end() - 1);
    const Place end = begin_of(steps_.end());
    cut_to(end.moves, end.edits);
  }
};

} // namespace haptic_sculpt::internal
