#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a trace of haptic_loop: draw_trace.py TRACE.csv PICTURE. Needs python3-matplotlib.

Three plots: the forces over time, how far the proxy is behind the hand, and how many ticks took which time of the
processor.
Exit: 0 drawn, 2 a file that is no trace, or a picture that cannot be written or is the trace.
"""
import csv
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import draw_file

COUPLING, RENDERED, LAG = "#e69f00", "#0072b2", "#009e73"  # told apart by colour-blind readers
NEEDED = ["t", "tx", "ty", "tz", "x", "y", "z", "fcx", "fcy", "fcz", "fx", "fy", "fz", "cpu_ns"]


def rows_of(path):
    """\\throw ValueError, OSError"""
    with open(path, newline="") as file:
        reader = csv.DictReader(file)
        try:
            missing = [name for name in NEEDED if name not in (reader.fieldnames or [])]
            rows = [{name: float(row[name]) for name in NEEDED} for row in reader if not missing]
        except TypeError:
            raise ValueError(f"line {reader.line_num}: the row is cut short") from None
        except (ValueError, csv.Error) as error:
            raise ValueError(f"line {reader.line_num}: {error}") from None
    if missing:
        raise ValueError(f"there is no column '{missing[0]}'")
    if not rows:
        raise ValueError("there is no row")
    if not all(math.isfinite(row["cpu_ns"]) for row in rows):
        raise ValueError("a cpu_ns is not finite")
    return rows


def draw(rows):
    time = [row["t"] for row in rows]
    norms = lambda *names: [math.hypot(*(row[name] for name in names)) for row in rows]
    lag = [math.dist([row[n] for n in ("tx", "ty", "tz")], [row[n] for n in ("x", "y", "z")]) for row in rows]
    cpu = [max(row["cpu_ns"], 1) / 1000 for row in rows]
    figure, (force, behind, ticks) = draw_file.pyplot().subplots(3, 1, figsize=(8, 8), dpi=110, constrained_layout=True)
    force.plot(time, norms("fcx", "fcy", "fcz"), color=COUPLING, linewidth=1, label="coupling")
    force.plot(time, norms("fx", "fy", "fz"), color=RENDERED, linewidth=1, label="rendered")
    force.set(title="Force on the hand", xlabel="s", ylabel="N")
    force.legend(frameon=False)
    behind.plot(time, lag, color=LAG, linewidth=1)
    behind.set(title="From the hand to the proxy", xlabel="s", ylabel="units of the scene")
    edges = [0.1 * 2 ** (k / 4) for k in range(4 * math.ceil(math.log2(max(cpu) / 0.1)) + 2)]
    ticks.hist(cpu, bins=edges, color=RENDERED)
    ticks.set(title="Ticks by time of the processor", xlabel="µs", ylabel="ticks", xscale="log", yscale="log")
    return figure


if __name__ == "__main__":
    draw_file.draw_file(__doc__, "haptic_loop --trace", rows_of, draw)
