#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists what the last run of ctest skipped, with the reason that each test gave: skipped_tests.py BUILD_FOLDER

A test says `skipped: WHY` of itself or of a part of it."""
import pathlib
import re
import sys

log = pathlib.Path(sys.argv[1], "Testing/Temporary/LastTest.log")
test, reasons = "", []
text = re.sub(r"\x1b\[[\d;]*m", "", log.read_text(errors="replace")) if log.exists() else ""  # Boost.Test writes in colours
for line in text.splitlines():
    if begun := re.match(r"\d+/\d+ Test: (\S+)$", line):
        test = begun[1]
    elif (said := re.search(r"\bskipped: (.*)$", line)) and (entry := f"  {test}: {said[1]}") not in reasons:
        reasons.append(entry)
if reasons:
    print("Skipped, in whole or in part:", *reasons, sep="\n")
