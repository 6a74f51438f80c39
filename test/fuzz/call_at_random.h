// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fuzz/Choices.h>
#include <fuzz/tiny_scenes.h>

#include <limits>

namespace haptic_sculpt::fuzz {

/// When calls end.
struct Call_limits {
  int calls = 12;
  std::size_t faces = 100; ///< of the mesh
};

/// What came of calls.
struct Call_tally {
  std::size_t guarded = 0, calls = 0, done = 0, refused = 0, out_of_memory = 0, thrown = 0, broken_off = 0,
              made_again = 0;

  std::string in_words() const {
    return std::to_string(guarded) + " meshes guarded, " + std::to_string(calls) + " calls, " + std::to_string(done) +
           " done, " + std::to_string(refused) + " refused, " + std::to_string(out_of_memory) +
           " without memory, of which " + std::to_string(broken_off) + " broken off for good, " +
           std::to_string(thrown) + " thrown by visitors, " + std::to_string(made_again) + " made again by value";
  }
};

/// Makes public calls of a Sculptor of a copy of the mesh, and of the free functions, as the choices say, with memory
/// that runs out, visitors that throw, and callers' modes of rounding. Looks after each whether the mesh is valid, at
/// the end whether all is undone and redone to the bit; ends the program where not. \param unit what numbers are
/// multiplied by \return false where the mesh is none that a Sculptor guards
bool call_at_random(Choices& choices, const meshes::Mesh& mesh, double unit, const Call_limits& limits,
                    Call_tally& tally);

} // namespace haptic_sculpt::fuzz
