// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_TOOL_JOURNAL_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_TOOL_JOURNAL_H

#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>

namespace haptic_sculpt {

/// What a tool does, as entries of a journal, if there is one. Vertices have the numbers that they would have without
/// the probe: those of the mesh's file, and of what was created since.
class Tool_journal {
public:
  using Kind = Journal_entry::Kind; ///< of entries

  /// \param probe its `Sculptor::name()`
  explicit Tool_journal(std::uint64_t probe) : probe_(probe) {}
  /// nullptr: none
  void keep(Edit_journal* journal) { journal_ = journal; }

  void begin_stroke() { add(Kind::stroke); } ///< what follows is one step of undo
  void end_stroke() { add(Kind::end); }      ///< of the stroke begun last

  /// An edit that was made. \param entry with names
  void add(Journal_entry entry) {
    if (journal_ == nullptr)
      return;
    for (std::uint64_t& name : entry.vertices)
      name -= name > probe_;
    journal_->add(entry);
  }

  /// A drag. \param path where the vertex was, and where after each leg
  template <class Points>
  void add_legs(std::uint64_t name, const Points& path) {
    for (std::size_t k = 1; k < path.size(); ++k)
      if (path[k] != path[k - 1])
        add_move(name, path[k]);
  }
  /// One straight motion of a vertex.
  template <class Point>
  void add_move(std::uint64_t name, const Point& to) {
    Journal_entry entry;
    entry.kind = Kind::move;
    entry.vertices = {name, 0, 0};
    entry.point = {to.x(), to.y(), to.z()};
    add(entry);
  }

private:
  Edit_journal* journal_ = nullptr;
  std::uint64_t probe_;

  void add(Kind kind) {
    Journal_entry entry;
    entry.kind = kind;
    add(entry);
  }
};

namespace internal {

/// Puts each move that a Sculptor makes as long as this lives into a journal. Its visitor is a Scene_teller.
template <class Sculptor>
class Journal_of_moves {
public:
  using Moves = std::vector<std::pair<typename Sculptor::Vertex_index, typename Sculptor::Point>>;

  /// \param moves where they are listed meanwhile
  Journal_of_moves(Sculptor& sculptor, Tool_journal& journal, Moves& moves)
      : sculptor_(sculptor), journal_(journal), moves_(moves) {
    moves.clear();
    sculptor.visitor().tell_to(&moves);
  }
  ~Journal_of_moves() { // also where something was thrown half way
    sculptor_.visitor().tell_to(static_cast<Moves*>(nullptr));
    for (const auto& [v, p] : moves_)
      journal_.add_move(sculptor_.name(v), p);
  }
  Journal_of_moves(const Journal_of_moves&) = delete;
  Journal_of_moves& operator=(const Journal_of_moves&) = delete;

private:
  Sculptor& sculptor_;
  Tool_journal& journal_;
  Moves& moves_;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
