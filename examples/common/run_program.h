// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Printable_stream.h"
#include "Usage_error.h"
#include "process_state.h"

#include <iostream>
#include <new>
#include <string>
#include <system_error>

namespace haptic_sculpt::examples {

/// Exit codes that all programs share; a program's own begin at 7. `failed`: the memory does not suffice, or the
/// program is at fault.
enum Exit { done = 0, failed = 1, usage = 2, mesh_refused = 3, script_error = 4, cannot_write = 5, foreign_log = 6 };

/// What every main does: puts the process into order (see process_state.h), says on standard error what was thrown, and
/// gives the exit code. Messages are written by a Printable_stream.
/// \param body returns the exit code \param exit_code_of that of an exception; `failed`: it was not foreseen
/// \param message_of what people hear of an exception, without the program's name
template <class Body, class Exit_code_of, class Message_of>
int run_program(const char* name, const Body& body, const Exit_code_of& exit_code_of, const Message_of& message_of) {
  put_process_in_order(name);
  const Printable_stream messages(std::cerr);
  try {
    const int code = body();
    if (code == done && !std::cout.flush()) {
      std::cerr << name << ": not all could be written to standard output\n";
      return cannot_write;
    }
    return code;
  } catch (const std::bad_alloc&) {
    std::cerr << name << ": the memory does not suffice for this\n";
    return failed;
  } catch (const std::exception& error) {
    const auto* const refused = dynamic_cast<const std::system_error*>(&error); // by std::thread, at a limit
    if (refused != nullptr && refused->code() == std::errc::resource_unavailable_try_again) {
      std::cerr << name << ": no thread can be made: " << refused->what() << '\n';
      return failed;
    }
    const std::string text = message_of(error);
    std::cerr << name << ": " << text << (!text.empty() && text.back() == '\n' ? "" : "\n");
    const int code = exit_code_of(error);
    if (code == failed)
      std::cerr << name << ": this is a fault of the program; please report it with its input\n";
    return code;
  }
}

} // namespace haptic_sculpt::examples
