// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

/// \file
/// What a process may find when it begins, and what may be sent to it, without losing results. (POSIX)

namespace haptic_sculpt::examples {

/// Puts something in the place of closed standard streams: else the next file that is opened, such as a log, would be
/// one, and get what is printed. What is printed then goes nowhere; what reads a closed standard input hears of a bad
/// file descriptor, as it would have, for an empty input would pass for an empty script.
inline void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
      const int opened = ::open("/dev/null", O_WRONLY);
      if (opened >= 0 && opened != stream) { // it is the lowest that is free, unless others open files here
        ::dup2(opened, stream);
        ::close(opened);
      }
    }
}

namespace process {

/// What is said of a signal that ends the program by a fault of its own; made beforehand, as a handler may do little.
inline std::array<char, 256>& last_words() {
  static std::array<char, 256> text{};
  return text;
}

extern "C" inline void say_last_words(int signal) {
  const auto& text = last_words();
  if (::write(STDERR_FILENO, text.data(), std::strlen(text.data())) < 0)
    ::_exit(128 + signal); // nobody listens
  ::raise(signal);         // its own handler is the default one again
}

inline std::atomic<bool>& is_ended() {
  static std::atomic<bool> ended{false};
  return ended;
}

/// Whether it was begun so (nohup) that a terminal that is closed does not matter.
inline bool& outlives_terminal() {
  static bool outlives = false;
  return outlives;
}

} // namespace process

/// A signal that ends the program by a fault of its own says so, in words, before it does. Sanitizers keep theirs.
inline void announce_crashes(const char* program) {
  std::snprintf(
      process::last_words().data(), process::last_words().size(),
      "\n%s: ended by a fault of its own. What was not written by now is lost, but for what a log has. Please "
      "report it with its input\n",
      program);
  alignas(16) static char stack[1 << 16]; // of its own: the fault may be that the other one has no room
  stack_t there{};
  there.ss_sp = stack, there.ss_size = sizeof stack;
  ::sigaltstack(&there, nullptr);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction action {}, old {};
    if (::sigaction(signal, nullptr, &old) != 0 || old.sa_handler != SIG_DFL)
      continue;
    action.sa_handler = process::say_last_words;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_ONSTACK | SA_NODEFER;
    ::sigaction(signal, &action, nullptr);
  }
}

/// Everything a main has to do first. A file that may not grow (SIGXFSZ) is reported like a full disk; a reader who has
/// gone (SIGPIPE) and a terminal that was closed (SIGHUP) cost what they would have been told, and no result.
inline void put_process_in_order(const char* program) {
  open_closed_streams();
  for (const int signal : {SIGXFSZ, SIGPIPE})
    std::signal(signal, SIG_IGN);
  process::outlives_terminal() = std::signal(SIGHUP, SIG_IGN) == SIG_IGN;
  announce_crashes(program);
}

/// Of a program that has nothing to lose yet: a terminal that is closed ends it at once, as control-C and SIGTERM do,
/// unless it was begun not to mind. \pre put_process_in_order()
inline void end_at_once_by_signals() {
  if (!process::outlives_terminal())
    std::signal(SIGHUP, SIG_DFL);
}

/// Of a program that goes on until it is ended: from here on control-C, SIGTERM, SIGHUP and a limit of processor time
/// (SIGXCPU) end it in order, as far as they were not ignored when it began. \pre put_process_in_order()
/// \return becomes true with the first of them
inline const std::atomic<bool>& end_in_order_by_signals() {
  const auto note = [](int) { process::is_ended() = true; };
  for (const int signal : {SIGINT, SIGTERM, SIGXCPU})
    if (std::signal(signal, note) == SIG_IGN)
      std::signal(signal, SIG_IGN);
  if (!process::outlives_terminal())
    std::signal(SIGHUP, note);
  return process::is_ended();
}

} // namespace haptic_sculpt::examples
