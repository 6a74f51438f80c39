// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Whatever is called of a Sculptor, in whatever order, with memory that runs out, visitors that throw and callers'
/// modes of rounding: the mesh stays valid, and undo leads back to the bit. The bytes of the input are choices.

#include <fuzz/Fuzz_target.h>
#include <fuzz/call_at_random.h>

namespace {

haptic_sculpt::fuzz::Call_tally tally;
std::size_t unguarded = 0; ///< the unit was too small for the mesh, or too large

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace haptic_sculpt;
  fuzz::Choices choices(data, size);
  auto list = fuzz::tiny_list(choices);
  const double unit = fuzz::unit_length(choices);
  const auto mesh = meshes::to_mesh(list.scale_and_move(unit, 0, 0, 0));
  if (!fuzz::call_at_random(choices, mesh, unit, {}, tally))
    ++unguarded;
  return 0;
}

std::string fuzz_input(std::mt19937_64& random) {
  return haptic_sculpt::fuzz::random_bytes(random, 300);
}

std::string fuzz_summary() {
  return tally.in_words() + ", " + std::to_string(unguarded) + " meshes refused";
}
