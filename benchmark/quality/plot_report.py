# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of scripts that draw a part of what haptic_passivity has written with --json."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples"))
from draw_file import draw_file, pyplot


def part_of_report(path, part):
    """\\throw ValueError, OSError"""
    with open(path) as file:
        report = json.load(file)
    if not isinstance(report, dict) or part not in report:
        raise ValueError(f"there is no '{part}'")
    return report


def plot_report(documentation, part, draw):
    """draw(report): a figure of matplotlib; see draw_file()."""
    draw_file(documentation, f"haptic_passivity --json with '{part}'", lambda path: part_of_report(path, part), draw)
