// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Batch_script.h"
#include "batches.h"

#include <iostream>

namespace haptic_sculpt::robustness {

/// A script begins with it where broad phases differ: `minimise` compares them then.
constexpr const char* other_bits_line = "# other broad phases lead elsewhere\n";

/// Makes each batch with one broad phase, and again with each of the others, which have to lead to the same bits. What
/// breaks a promise is written to a folder.
class Compared_batches {
public:
  struct Counts {
    std::size_t compared = 0, other_bits = 0, clearance_refused = 0; ///< batches; the last: at first, or later
    std::size_t unwritten = 0; ///< cases that the folder has not taken: a full disk costs no more than these

    Counts& operator+=(const Counts& c) {
      compared += c.compared, other_bits += c.other_bits, clearance_refused += c.clearance_refused;
      unwritten += c.unwritten;
      return *this;
    }
  };

  /// \param broad_phases the first one counts, the others are compared with it \param folder of failing cases, or empty
  /// \param keep whether all batches are written there, with NAME.end.off, what has become of the mesh
  Compared_batches(std::vector<Broad_phase_choice> broad_phases, std::filesystem::path folder, Keep keep)
      : broad_phases_(std::move(broad_phases)), folder_(std::move(folder)), keep_(keep) {}

  /// One batch. \param make how a broad phase makes it \param name of its files \return what the first counts; nothing
  /// of a batch whose clearance does not serve the mesh, and as much as it made of one that has outgrown it
  template <class Tally>
  Tally make(const Mesh& given, const Batch& batch, Batch_maker<Tally> Broad_phase_choice::*make,
             const std::string& name, Counts& counts) const {
    // As `sculpt` reads it from the file: where half-edges begin to go round a vertex, which a file does not hold, has
    // a say in the last bits of a slide and in which of two equal neighbours a removal takes.
    const Mesh mesh = mesh_of<Mesh>(face_soup(given));
    Batch only_bits = batch;
    only_bits.has_only_bits = true;
    try {
      Batch_made<Tally> first = (broad_phases_[0].*make)(mesh, batch, keep_);
      bool is_same = true;
      for (std::size_t i = 1; i < broad_phases_.size(); ++i)
        is_same &= (broad_phases_[i].*make)(mesh, only_bits, Keep::what_fails).bits == first.bits;
      counts.compared += broad_phases_.size() > 1, counts.other_bits += !is_same;
      counts.clearance_refused += first.has_outgrown_clearance;
      if (folder_.empty())
        return first.tally;
      if (!is_same && first.script.empty())
        first.script = (broad_phases_[0].*make)(mesh, only_bits, Keep::all).script;
      try {
        if (!first.script.empty())
          write_case(folder_, name, given, (is_same ? "" : other_bits_line) + first.script);
        if (keep_ == Keep::all)
          write_surface(folder_ / (name + ".end.off"), first.end);
      } catch (const Write_error& error) {
        ++counts.unwritten;
        std::cerr << error.what() << '\n';
      }
      return first.tally;
    } catch (const Invalid_parameter&) {
      if (!batch.clearance)
        throw;
      ++counts.clearance_refused;
      return {};
    }
  }

private:
  std::vector<Broad_phase_choice> broad_phases_;
  std::filesystem::path folder_;
  Keep keep_;
};

} // namespace haptic_sculpt::robustness
