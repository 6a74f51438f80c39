#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program and the CMakeLists.txt in the README are those that are compiled by the tests, and its table names every tutorial."""
import os
import re
import sys

source = sys.argv[1]


def text_of(path):
    with open(f"{source}/{path}") as file:
        return file.read()


readme = text_of("README.md")
program = text_of("examples/tutorials/drag_and_save.cpp").split("\n", 1)[1]  # without the line of the licence
faults = [f"the README does not hold {what} as it is compiled" for what, block in
          (("the program", f"```cpp\n{program}```\n"), ("the consumer's CMakeLists.txt", f"```cmake\n{text_of('test/install/sculpt_consumer/CMakeLists.txt')}```\n"))
          if block not in readme]
tutorials = {name[:-4] for name in os.listdir(f"{source}/examples/tutorials") if name.endswith(".cpp")}
listed = set(re.findall(r"\[`(\w+)`\]\(examples/tutorials/\1\.cpp\)", readme))
run = set(re.findall(r"^haptic_sculpt_add_tutorial\((\w+) LINK", text_of("examples/tutorials/CMakeLists.txt"), re.MULTILINE))
if not tutorials == listed == run:
    faults.append(f"tutorials {tutorials}, in the README {listed}, run {run}")
print("\n".join(faults) or "the README is true")
sys.exit(bool(faults))
