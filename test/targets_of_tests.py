#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints what has to be built for some tests, one target a line: targets_of_tests.py BUILD_FOLDER [arguments of ctest ...]

A test's command line names the programs that it runs, so these are the targets among its words."""
import os
import pathlib
import re
import subprocess
import sys

build = os.path.abspath(sys.argv[1])
listed = subprocess.run(["ctest", "--test-dir", build, "-N", *sys.argv[2:]], capture_output=True, text=True)
if listed.returncode != 0:
    sys.exit(listed.stderr)
names = set(re.findall(r"^ +Test +#\d+: (\S+)", listed.stdout, re.MULTILINE))
known = subprocess.run(["ninja", "-C", build, "-t", "targets", "all"], capture_output=True, text=True, check=True).stdout
targets = {line.split(": ")[0] for line in known.splitlines()}
wanted = set()
for file in pathlib.Path(build).rglob("CTestTestfile.cmake"):
    for name, command in re.findall(r"^add_test\((?:\[=*\[)?([^\s\]]+)(?:\]=*\])? (.*)\)$", file.read_text(), re.MULTILINE):
        if name in names:
            wanted.update(os.path.relpath(word, build) for word in re.findall(r'"((?:[^"\\]|\\.)*)"', command) if os.path.isabs(word))
print(*sorted(wanted & targets), sep="\n")
