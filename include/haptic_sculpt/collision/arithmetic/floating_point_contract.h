// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What the error bounds of the filters take for granted of the compiler; see doc/proofs/sweep_arithmetic.md.
///
/// Contraction to fused multiply-add and every rounding mode are allowed for. Re-association, finite-only and
/// reciprocal arithmetic, and evaluation in a wider format are not: they are refused here.

#include <haptic_sculpt/no_fast_math.h>

#include <cfloat>
#include <limits>

#if !defined(__SIZEOF_INT128__)
#error "haptic_sculpt: the exact stage needs a 128-bit integer: g++ or clang for a 64-bit machine"
#endif

namespace haptic_sculpt {
static_assert(std::numeric_limits<double>::is_iec559, "haptic_sculpt needs IEEE 754 doubles");
static_assert(FLT_EVAL_METHOD == 0, "haptic_sculpt needs doubles evaluated as doubles: compile with -mfpmath=sse");
} // namespace haptic_sculpt
