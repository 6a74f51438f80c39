// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Refuses to be compiled with re-associated, reciprocal or finite-only arithmetic: exact predicates, tests for
/// infinite and undefined numbers and the device's error bounds all come out wrong under it. Needs nothing.
///
/// clang says nothing of -fassociative-math given alone; there only -ffast-math and -ffinite-math-only are seen.

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||                               \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error                                                                                                                 \
    "haptic_sculpt: exact predicates do not survive -ffast-math and what it stands for; compile without it"
#endif
