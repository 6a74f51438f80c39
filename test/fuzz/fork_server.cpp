// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes of a program one that forks for each run, so that a run costs no loading of its libraries: random runs take a
// fifth less of a processor. It is preloaded (LD_PRELOAD), so that the programs are the ones that ship;
// fuzz_programs.py is its client. Where HAPTIC_SCULPT_FORK_SERVER names a socket, a program waits there before main():
//
//   request: the words of a command line, each ended by a zero byte, the first a folder to run in;
//            with two descriptors: its standard input, and its standard output and standard error
//   answers: the process identifier (an int), then, when it has ended, the status of waitpid() (an int)
//
// The program ends when the socket is closed.
#include <dlfcn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

using Main = int (*)(int, char**, char**);
Main main_of_the_program;

constexpr int longest_request = 1 << 18; // bytes: more than one message has by default (net.core.wmem_default, 212992)

// Whether there is one: not once the client has closed its end.
bool receive(int socket, std::string& request, int descriptors[2]) {
  request.resize(longest_request);
  iovec part{request.data(), request.size()};
  alignas(cmsghdr) char control[CMSG_SPACE(2 * sizeof(int))];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof(control);
  const auto size = recvmsg(socket, &message, 0);
  const cmsghdr* const sent = CMSG_FIRSTHDR(&message);
  if (size <= 0 || (message.msg_flags & MSG_TRUNC) != 0 || !sent || sent->cmsg_len != CMSG_LEN(2 * sizeof(int))) {
    return false;
  }
  std::memcpy(descriptors, CMSG_DATA(sent), 2 * sizeof(int));
  request.resize(std::size_t(size));
  return true;
}

int run(std::string& request, const int descriptors[2], char** environment) {
  std::vector<char*> words;
  for (std::size_t at = 0; at < request.size(); at += std::strlen(&request[at]) + 1) {
    words.push_back(&request[at]);
  }
  if (chdir(words.front()) != 0) {
    _exit(127);
  }
  dup2(descriptors[0], STDIN_FILENO);
  dup2(descriptors[1], STDOUT_FILENO);
  dup2(descriptors[1], STDERR_FILENO);
  close(descriptors[0]);
  close(descriptors[1]);
  const int count = int(words.size()) - 1;
  words.push_back(nullptr);
  return main_of_the_program(count, &words[1], environment);
}

int serve(int, char**, char** environment) {
  const int socket = std::atoi(std::getenv("HAPTIC_SCULPT_FORK_SERVER"));
  unsetenv("HAPTIC_SCULPT_FORK_SERVER");
  unsetenv("LD_PRELOAD");
  std::string request;
  int descriptors[2];
  while (receive(socket, request, descriptors)) {
    const pid_t child = fork();
    if (child == 0) {
      close(socket);
      return run(request, descriptors, environment);
    }
    close(descriptors[0]);
    close(descriptors[1]);
    int status = 0;
    if (child < 0 || write(socket, &child, sizeof(child)) < 0 || waitpid(child, &status, 0) < 0 ||
        write(socket, &status, sizeof(status)) < 0) {
      _exit(126);
    }
  }
  _exit(0);
}

} // namespace

extern "C" int __libc_start_main(Main main, int count, char** words, void (*init)(), void (*fini)(), void (*at_exit)(),
                                 void* stack_end) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  main_of_the_program = main;
  return start(std::getenv("HAPTIC_SCULPT_FORK_SERVER") ? serve : main, count, words, init, fini, at_exit, stack_end);
}
