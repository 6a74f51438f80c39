// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Drag_tally.h"
#include "Edit_tally.h"
#include "robustness_meshes.h"

#include <haptic_sculpt/sculpting.h>

#include <optional>
#include <sstream>

namespace haptic_sculpt::robustness {

/// What a batch is to do.
struct Batch {
  Response response = Response::slide;
  std::optional<double> clearance; ///< a length; the default of the library where there is none
  std::uint64_t seed = 1;
  std::size_t count = 0; ///< of drags, or of edits
  std::size_t validate_every = 0; ///< 0: at the end only
  bool is_of_a_hand = false; ///< drags only: strokes of short steps
  bool has_only_bits = false; ///< what came of it is compared with another batch; nothing else is judged

  Sculptor_parameters parameters() const {
    Sculptor_parameters result = parameters::response(response);
    if (clearance)
      result.clearance(*clearance);
    return result;
  }
  /// The lines of a script that say so.
  std::string opening() const {
    std::ostringstream out;
    out << std::hexfloat << "response " << name_of(response) << '\n';
    if (clearance)
      out << "clearance " << *clearance << '\n';
    return out.str();
  }
};

/// What has come of it.
template <class Tally>
struct Batch_made {
  Tally tally;
  std::uint64_t bits = 0; ///< of all results and of the mesh at the end
  std::string script; ///< for `sculpt`; empty unless a promise is broken, or it was asked for
  Mesh end; ///< the mesh afterwards; empty unless it was asked for
  bool has_outgrown_clearance = false; ///< it has ended there, before the edit that was refused for that
};

/// Whether the script and the mesh at the end are asked for.
enum class Keep { what_fails, all };

/// One source for each of three broad phases instantiates these. \throw Invalid_parameter where the clearance does not
/// serve the mesh
template <class Broad_phase>
Batch_made<Drag_tally> drag_batch(const Mesh& mesh, const Batch& batch, Keep keep);
template <class Broad_phase>
Batch_made<Edit_tally> edit_batch(const Mesh& mesh, const Batch& batch, Keep keep);

template <class Tally>
using Batch_maker = Batch_made<Tally> (*)(const Mesh&, const Batch&, Keep);

/// How batches are made with one of them.
struct Broad_phase_choice {
  Batch_maker<Drag_tally> drag_batch;
  Batch_maker<Edit_tally> edit_batch;
};

} // namespace haptic_sculpt::robustness
