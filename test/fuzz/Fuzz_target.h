// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What a fuzz target defines. libFuzzer and `fuzz_main.cpp` both run it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Runs one input. Whatever breaks the promise under test ends the program: an exception, `std::abort()` or a
/// sanitizer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// Good inputs to be damaged. The first byte, which says what kind of input it is, is never damaged.
std::vector<std::string> fuzz_seeds();

/// What became of the inputs so far, for people.
std::string fuzz_summary();
