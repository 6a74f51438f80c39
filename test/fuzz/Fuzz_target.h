// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What a fuzz target defines. libFuzzer and `fuzz_main.cpp` both run it.

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

/// Runs one input. Whatever breaks the promise under test ends the program: an exception, `std::abort()` or a
/// sanitizer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// An input that is likely to lead far.
std::string fuzz_input(std::mt19937_64& random);

/// What became of the inputs so far, for people.
std::string fuzz_summary();
