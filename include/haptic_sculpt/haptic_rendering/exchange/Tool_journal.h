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
    Journal_entry entry;
    entry.kind = Kind::move;
    for (std::size_t k = 1; k < path.size(); ++k)
      if (path[k] != path[k - 1]) {
        entry.vertices = {name, 0, 0};
        entry.point = {path[k].x(), path[k].y(), path[k].z()};
        add(entry);
      }
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

} // namespace haptic_sculpt

#endif
