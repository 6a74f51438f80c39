#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the programs with random options and damaged files: fuzz_programs.py SOURCE PROGRAM ... [--runs N] [--seed S].

The options are read from each program's --help, so that a new one is tried without being named here. Values are
numbers from all doubles and all integers, words, bytes that are no text, and names of files: good, damaged, missing,
folders, devices. What must hold of every run:

- it ends by itself, or in order within seconds of a SIGTERM, and never by another signal;
- its exit code is one that its --help names, and never that of a fault of the program;
- nothing of the runtime stands on the screen (a sanitizer's report, an exception that nobody caught);
- what it is given to read is as it was, but a mesh that is named as the output, too;
- with exit code 0, a mesh that it wrote is valid: `sculpt MESH` reads it.

Each run is a draw of its own: --first N --runs 1 makes run N again, and --keep its files.
"""
import argparse
import collections
import concurrent.futures
import os
import re
import resource
import shlex
import shutil
import signal
import sys
import tempfile
import threading

from forked_runs import Forking_program
from random_runs import FAULT_OF_THE_PROGRAM, Draw, corpus_of, options_of

MEMORY = 3 << 30  # bytes: what is refused below this is refused in order
PATIENCE = 1  # seconds before a run is asked to end; loops of 10^24 seconds are one in a hundred
GRACE = 20  # seconds that it may take then
# AddressSanitizer reserves more than any limit of addresses. It is given bounds of its own, and ends a program there.
BOUNDS_OF_THE_SANITIZER = f"max_allocation_size_mb={MEMORY >> 20}:hard_rss_limit_mb={2 * MEMORY >> 20}"
ENDED_AT_A_BOUND = re.compile(rb"AddressSanitizer: (allocation-size-too-big|out-of-memory|hard rss limit exhausted)")
RUNTIME = re.compile(rb"Sanitizer|runtime error:|terminate called|Assertion|CGAL error|std::|what\(\):")


def is_sanitized(program):
    return "sanitize" in program


def environment():
    # Drivers of OpenGL leak where there is a display: nothing would tell them from others.
    leaks = ":detect_leaks=0" if "DISPLAY" in os.environ else ""
    # The library that makes the programs fork is loaded before the sanitizer's.
    return {**os.environ, "ASAN_OPTIONS": f"abort_on_error=1:verify_asan_link_order=0:{BOUNDS_OF_THE_SANITIZER}{leaks}"}


def slowness(program):
    return 10 if is_sanitized(program) else 1


def grace(program):
    """Seconds that it may take to end."""
    return GRACE * slowness(program)


def set_limits(program):
    """Of this process, from which its children have them."""
    if not is_sanitized(program):
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))


class Runner:
    """Runs the programs, each of which stands by once for each thread."""

    def __init__(self, server):
        self.server, self.here, self.all = server, threading.local(), []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for program in self.all:
            program.close()

    def run(self, arguments, stdin, folder, patience=PATIENCE):
        program, *words = arguments
        standing_by = self.here.__dict__.setdefault("programs", {})
        if program not in standing_by:
            standing_by[program] = Forking_program(program, self.server, environment())
            self.all.append(standing_by[program])
        return standing_by[program].run(words, stdin, folder, patience * slowness(program), grace(program))


def faults_of(draw, arguments, code, output, was_asked, validate):
    faults = []
    if is_sanitized(arguments[0]) and ENDED_AT_A_BOUND.search(output):
        return faults
    if code is None:
        faults.append(f"does not end within {grace(arguments[0])} s of a SIGTERM")
    elif code < 0 and not (was_asked and code == -signal.SIGTERM):
        faults.append(f"ended by {signal.Signals(-code).name}")
    elif code >= 0 and code not in draw.codes and not was_asked and not (
            code == FAULT_OF_THE_PROGRAM and b"memory" in output):
        faults.append(f"exit code {code}, which is not one that --help names, or a fault of the program")
    told = RUNTIME.search(output)
    if told:
        faults.append(f"says '{told.group(0).decode()}'")
    for path, data in draw.inputs.items():
        # `sculpt MESH -o MESH` sculpts a file in its place.
        is_named = arguments.count(path) == 2 and "--output" in arguments
        try:
            is_kept = is_named or open(path, "rb").read() == data
        except OSError:
            is_kept = False
        if not is_kept:
            faults.append(f"{path} is not as it was")
    if code == 0 and "--output" in arguments and not faults:
        made = arguments[arguments.index("--output") + 1]
        if os.path.isfile(made) and made not in draw.inputs and made.endswith((".off", ".ply", ".obj")):
            code, said, _ = validate(made)
            if code != 0:
                faults.append(f"the mesh it wrote is refused: {said.decode(errors='replace')[:300]}")
    return faults


def run_of(number, arguments, programs, known, corpus, runner):
    """((program, exit code), whether it had to be asked to end, what is wrong)"""
    with tempfile.TemporaryDirectory() as folder:
        draw = Draw(arguments.seed, number, folder, known, corpus)
        command = [programs[draw.program], *draw.arguments]
        code, output, was_asked = runner.run(command, draw.stdin, folder)
        faults = faults_of(draw, command, code, output, was_asked,
                           lambda mesh: runner.run([programs["sculpt"], mesh], b"", folder, patience=GRACE))
        if not faults:
            return (draw.program, code), was_asked, ""
        if arguments.keep:
            shutil.copytree(folder, os.path.join(arguments.keep, f"run{number}"), dirs_exist_ok=True)
        told = f"run {number}: {'; '.join(faults)}\n  {' '.join(shlex.quote(c) for c in command)}\n  "
        return (draw.program, code), was_asked, told + output.decode(errors="replace")[-400:].replace("\n", "\n  ")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("source", help="the folder of the sources")
    parser.add_argument("programs", nargs="+", help="example programs, built; sculpt and haptic_loop among them")
    parser.add_argument("--fork-server", metavar="LIBRARY", required=True, type=os.path.abspath,
                        help="the library made of fork_server.cpp: a run costs no loading of libraries")
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="begin with this run")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cores", type=int, default=1, help="this many runs at a time (default: 1)")
    parser.add_argument("--keep", metavar="FOLDER", help="where the files of runs with faults are kept")
    parser.add_argument(
        "--display",
        action="store_true",
        help="open one without a screen (Xvfb) for sculpt_window; else its command line is tried only",
    )
    arguments = parser.parse_args()
    if arguments.cores < 1 or arguments.runs < 1 or arguments.first < 0:
        parser.error("--cores and --runs must be at least 1, --first at least 0")
    os.environ.pop("DISPLAY", None)
    if arguments.display:
        sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples"))
        from virtual_display import Display

        display = Display()  # ends with this script
        os.environ["DISPLAY"] = display.name
    programs = {os.path.basename(path): os.path.abspath(path) for path in arguments.programs}
    for name in ("sculpt", "haptic_loop"):
        if name not in programs:
            parser.error(f"{name} is not among the programs: it makes files to begin with")
    set_limits(programs["sculpt"])
    known = {name: options_of(path) for name, path in programs.items()}
    print(f"seed {arguments.seed}, runs {arguments.first} to {arguments.first + arguments.runs - 1}", flush=True)
    found, ends, asked = 0, collections.Counter(), 0
    with tempfile.TemporaryDirectory() as good, Runner(arguments.fork_server) as runner, \
            concurrent.futures.ThreadPoolExecutor(arguments.cores) as pool:
        corpus = corpus_of(programs, os.path.abspath(arguments.source), good)
        end = arguments.first + arguments.runs
        for first in range(arguments.first, end, 1000):
            numbers = range(first, min(first + 1000, end))
            for ended, was_asked, fault in pool.map(
                    lambda n: run_of(n, arguments, programs, known, corpus, runner), numbers):
                ends[ended] += 1
                asked += was_asked
                found += bool(fault)
                if fault:
                    print(fault.encode(errors="replace").decode(), flush=True)
            if first + 1000 < end:
                print(f"{first + 1000 - arguments.first} runs, {found} with faults", file=sys.stderr)
    for (name, code), count in sorted(ends.items(), key=str):
        print(f"{name}: {count} times exit {code}")
    print(f"{arguments.runs} runs, {asked} asked to end, {found} with faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
