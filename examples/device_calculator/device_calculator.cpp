// SPDX-License-Identifier: GPL-3.0-or-later
// The mechanism as a calculator: one JSON request a line in, one JSON answer a line out. doc/use/device.md has the
// keys.
#include "common/run_program.h"
#include "device_calculator/answer_line.h"
#include <cstring>
#include <iostream>
#include <new>

namespace {

using namespace haptic_sculpt;
using nlohmann::json;

constexpr const char* help = R"(device_calculator: the three-leg mechanism as a calculator.

It reads JSON requests from its input, one a line, and prints one JSON answer a line. SI units and radians.

Example: the apex above three legs at 1, 1.1 and 0.9 rad.
  $ device_calculator <<'END'
  {"op":"forward","form":"ditetra","params":{"R":0.03,"l1":0.07,"l2":0.1},"theta":[1,1.1,0.9]}
  END
  {"J":[...],"Q":[...],"condA":...,"joints":[...],"ok":true,"p":[...]}

Requests: form, params and one op, with the keys it takes (those in brackets may be left out)
  form      "ditetra" or "general"
  params    R l1 l2 [r] [m1 m2 M] [I] [Jm] [g]; r for "general", masses for "dynamics"
  forward   theta [mode] [phi_seed] [wrench]    pose, Jacobian, condition
  dynamics  the same, thetad thetadd            also velocity, acceleration and both dynamic models
  inverse   p [theta]                           joint angles; theta is the seed in the general form
  modes     theta                               all assembly modes
doc/use/device.md says what each key means.

A request that cannot be answered gets {"ok":false,"error":CODE,"message":TEXT}, and the next line is read. Keys that
are not known are listed in the answer as "unknown_keys". A line may have 1048576 bytes, 1000 values and 32 levels of
nesting.

usage: device_calculator [--help] < REQUESTS > ANSWERS
Exit:  0 all lines answered (failures are answers), 1 a fault of the program, 2 wrong arguments or unreadable requests,
       5 the answers cannot be written
)";
static_assert(longest_line == 1048576 && most_values == 1000 && deepest_nesting == 32, "the help text says these");

int calculate(int argument_count, char** arguments) {
  for (int k = 1; k < argument_count; ++k)
    if (std::strcmp(arguments[k], "--help") == 0 || std::strcmp(arguments[k], "-h") == 0) {
      std::cout << help;
      return examples::done; // or not, as run_program() sees
    }
  if (argument_count > 1)
    throw examples::Usage_error("unknown argument `" + std::string(arguments[1]) +
                                "`. It reads JSON requests, one a line, from its input; see --help.");
  Line_reader reader(std::cin);
  while (reader.next()) {
    try {
      std::cout << examples::answer_line(reader).dump(-1, ' ', false, json::error_handler_t::replace) << std::endl;
    } catch (const std::bad_alloc&) { // what this line took has been given back by now
      std::cout << R"({"error":"out_of_memory","message":"there is not enough memory to answer this line","ok":false})"
                << std::endl;
    }
    if (!std::cout)
      return examples::done; // as above
  }
  if (std::cin.bad())
    throw examples::Usage_error("the requests cannot be read");
  return examples::done;
}

} // namespace

int main(int argument_count, char** arguments) {
  std::ios::sync_with_stdio(false); // first of all: it makes the streams anew
  return examples::run_program(
      "device_calculator", [&] { return calculate(argument_count, arguments); },
      [](const std::exception& error) {
        return dynamic_cast<const examples::Usage_error*>(&error) != nullptr ? examples::usage : examples::failed;
      },
      [](const std::exception& error) { return std::string(error.what()); });
}
