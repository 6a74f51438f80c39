# SPDX-License-Identifier: GPL-3.0-or-later
"""How figures look: few series, names beside them instead of a legend, colours that colour-blind readers tell apart."""
import base64
import io
import math
from dataclasses import dataclass, field

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Okabe and Ito's colours. The first is ours, everywhere.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MARKERS = ("o", "s", "^", "D", "v", "P")
MOST_SERIES = len(COLOURS)
INK, FAINT = "#333333", "#999999"

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": FAINT,
    "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK, "axes.axisbelow": True, "svg.hashsalt": "haptic_sculpt"})


@dataclass
class Table:
    title: str
    head: list
    rows: list


@dataclass
class Finding:
    """A sentence, a number, a figure, and the tables behind."""
    step: str
    sentence: str
    number: str
    of: str  # what the number is
    figure: str = ""  # a data address
    alternative: str = ""  # what the figure shows, in words
    tables: list = field(default_factory=list)


def axes(width=7.2, height=4.0):
    figure, one = plt.subplots(figsize=(width, height))
    one.grid(True, which="major", color="#e6e6e6", linewidth=0.8)
    one.tick_params(which="both", length=0)
    return figure, one


def data_address(figure):
    """The figure as it stands in the page, so that the page is one file."""
    file = io.BytesIO()
    figure.savefig(file, format="svg", bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)
    return "data:image/svg+xml;base64," + base64.b64encode(file.getvalue()).decode()


def seconds_text(seconds):
    """0.00000123 as 1.2 µs."""
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def time_axis(axis):
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: seconds_text(x)))
    axis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def names_beside(one, ends):
    """Names at the right of points, (x, y, name, colour), moved apart up and down where they would overlap."""
    one.figure.canvas.draw()
    size = 13 * one.figure.dpi / 72
    placed = []
    for x, y, name, colour in sorted(ends, key=lambda e: one.transData.transform((e[0], e[1]))[1]):
        px, py = one.transData.transform((x, y))
        low = py
        for qx, qy, length in placed:
            if abs(qy - low) < size and px < qx + length and qx < px + 6.2 * len(name) * one.figure.dpi / 72:
                low = qy + size
        placed.append((px, low, 6.2 * len(name) * one.figure.dpi / 72))
        one.annotate(name, (x, y), xytext=(8, (low - py) * 72 / one.figure.dpi), textcoords="offset points", color=colour, va="center",
                     fontsize=9.5, annotation_clip=False, fontweight="bold" if colour == COLOURS[0] else "normal")


def lines(series, x_label, y_label, times=True):
    """\\param series {name: [(x, y), ...]}, ours first. Both axes are logarithmic."""
    figure, one = axes()
    one.set_xscale("log"), one.set_yscale("log")
    ends = []
    for (name, points), colour, marker in zip(list(series.items())[:MOST_SERIES], COLOURS, MARKERS):
        points = sorted(p for p in points if p[1] > 0)
        if not points:
            continue
        one.plot(*zip(*points), marker=marker, markersize=5, color=colour, linewidth=2 if colour == COLOURS[0] else 1.4)
        ends.append((*points[-1], name, colour))
    one.set_xlabel(x_label), one.set_ylabel(y_label)
    if times:
        time_axis(one.yaxis)
    names_beside(one, ends)
    return data_address(figure)


def speed_error(points, y_label, x_label="time of one"):
    """Time against error on one pair of axes. \\param points [(name, seconds, error)], ours first; no error stands on a line below"""
    figure, one = axes()
    one.set_xscale("log")
    points = [p for p in points if p[1] > 0][:MOST_SERIES]
    errors = [e for _, _, e in points if e > 0]
    floor = 10 ** (math.floor(math.log10(min(errors))) - 1) if errors else 1e-3
    one.set_yscale("log")
    top = max(errors, default=1)
    one.set_ylim(floor / 2.5, top * 4)
    one.axhline(floor, color=FAINT, linewidth=0.8, linestyle=(0, (4, 4)))
    one.annotate("none", (0, floor), xycoords=("axes fraction", "data"), xytext=(4, 4), textcoords="offset points", color=FAINT, fontsize=9)
    ends = []
    for (name, seconds, error), colour, marker in zip(points, COLOURS, MARKERS):
        y = error if error > 0 else floor
        one.plot(seconds, y, marker, color=colour, markersize=10)
        ends.append((seconds, y, name, colour))
    if points:
        low, high = min(p[1] for p in points), max(p[1] for p in points)
        one.set_xlim(low / 1.6, high * 2.5)
    one.set_xlabel(x_label), one.set_ylabel(y_label)
    time_axis(one.xaxis)
    names_beside(one, ends)
    return data_address(figure)


def bars(rows, x_label):
    """\\param rows [(name, length, text at its end, is good)]; the axis is logarithmic"""
    figure, one = axes(height=0.7 + 0.32 * len(rows))
    one.set_xscale("log")
    for k, (name, length, text, good) in enumerate(rows):
        one.barh(k, max(length, 1), left=0.5, height=0.62, color=COLOURS[0] if good else COLOURS[1])
        one.annotate(text, (max(length, 1) + 0.5, k), xytext=(5, 0), textcoords="offset points", va="center", fontsize=9, color=INK if good else COLOURS[1])
    one.set_yticks(range(len(rows)), [r[0] for r in rows], fontsize=9)
    one.invert_yaxis()
    one.grid(False, axis="y")
    one.set_xlabel(x_label)
    return data_address(figure)
