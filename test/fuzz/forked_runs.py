# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a program that forks for each (fork_server.cpp): a run costs no loading of its libraries."""
import array
import contextlib
import os
import signal
import socket
import struct
import subprocess


class Forking_program:
    """A program that waits before its main() for command lines, until close()."""

    def __init__(self, program, server, environment):
        """server: the library made of fork_server.cpp"""
        self.program = program
        self.socket, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with other:
            environment = {**environment, "LD_PRELOAD": server, "HAPTIC_SCULPT_FORK_SERVER": str(other.fileno())}
            self.process = subprocess.Popen([program], env=environment, pass_fds=[other.fileno()])

    def close(self):
        self.socket.close()
        self.process.wait()

    def run(self, arguments, stdin, folder, patience, grace):
        """(exit code, what stands on the screen, whether it had to be asked to end): as subprocess names exit codes,
        None where it did not end within `grace` seconds of a SIGTERM, which it gets after `patience` seconds."""
        with os.fdopen(os.memfd_create("stdin"), "w+b") as given, os.fdopen(os.memfd_create("screen"), "w+b") as screen:
            given.write(stdin)
            given.seek(0)
            words = b"".join(os.fsencode(word) + b"\0" for word in [folder, self.program, *arguments])
            descriptors = array.array("i", [given.fileno(), screen.fileno()])
            self.socket.settimeout(None)
            self.socket.sendmsg([words], [(socket.SOL_SOCKET, socket.SCM_RIGHTS, descriptors)])
            child = self.receive()
            code, was_asked = self.wait(patience), False
            if code is None:
                was_asked = True
                with contextlib.suppress(ProcessLookupError):  # it has ended meanwhile
                    os.kill(child, signal.SIGTERM)
                code = self.wait(grace)
                if code is None:
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(child, signal.SIGKILL)
                    self.wait(None)
            screen.seek(0)
            return code, screen.read(), was_asked

    def receive(self):
        try:
            message = self.socket.recv(4)
        except ConnectionError:
            message = b""
        if len(message) != 4:
            raise RuntimeError(f"{self.program} no longer forks: exit code {self.process.wait()}")
        return struct.unpack("i", message)[0]

    def wait(self, seconds):
        """The exit code of the run, None where it has not ended."""
        self.socket.settimeout(seconds)
        try:
            return os.waitstatus_to_exitcode(self.receive())
        except TimeoutError:
            return None
