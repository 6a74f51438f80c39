// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace haptic_sculpt::loop_program {

/// Asks the system for what a loop in real time needs: memory that stays, and a thread that goes before all others. To
/// be called by the loop's thread once everything is there. \return what could not be had, why, and what to do; the
/// loop runs without
inline std::vector<std::string> ask_for_real_time() {
  std::vector<std::string> refused;
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    refused.push_back(std::string("the memory cannot be locked (mlockall: ") + std::strerror(errno) +
                      "), so that a page may have to be fetched in a tick; raise `ulimit -l`, or run as root or with "
                      "CAP_IPC_LOCK");
  sched_param parameter{};
  parameter.sched_priority = 80; // of 1 to 99: below the kernel's own threads that serve a device
  if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter); error != 0)
    refused.push_back(
        std::string("the loop's thread does not go first (SCHED_FIFO: ") + std::strerror(error) +
        "), so that others may delay ticks; raise `ulimit -r` to 80, or run as root or with CAP_SYS_NICE");
  return refused;
}

/// The thread goes like any other again, and memory is had beyond `ulimit -l`: results need some.
inline void leave_real_time() {
  munlockall();
  sched_param parameter{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &parameter);
}

} // namespace haptic_sculpt::loop_program
