# SPDX-License-Identifier: GPL-3.0-or-later
"""How figures look: few series, names beside them instead of a legend, colours that colour-blind readers tell apart."""
import base64
import io
import math
from dataclasses import dataclass, field

import matplotlib

matplotlib.use("Agg")
import matplotlib.patheffects as patheffects
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
    picture: str = ""  # its name among the manual's pictures, where it is one of them


PICTURES = {}  # of each figure, by its data address, what a file needs; only where they are asked for
has_pictures = False


def axes(width=7.2, height=4.0):
    figure, one = plt.subplots(figsize=(width, height))
    one.grid(True, which="major", color="#e6e6e6", linewidth=0.8)
    one.tick_params(which="both", length=0)
    return figure, one


def data_address(figure):
    """The figure as it stands in the page, so that the page is one file."""
    file = io.BytesIO()
    figure.savefig(file, format="svg", bbox_inches="tight", metadata={"Date": None})
    address = "data:image/svg+xml;base64," + base64.b64encode(file.getvalue()).decode()
    if has_pictures:
        png = io.BytesIO()
        figure.savefig(png, format="png", bbox_inches="tight", dpi=110, metadata={"Software": None})
        PICTURES[address] = png.getvalue()
    plt.close(figure)
    return address


def seconds_text(seconds):
    """0.00000123 as 1.2 µs."""
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def power_text(x):
    """0.00000123 as 1·10⁻⁶."""
    if x == 0 or 1e-3 <= abs(x) < 1e4:
        return f"{x:.3g}"
    digits, exponent = f"{x:.0e}".split("e")
    return f"{digits}·10" + str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def time_axis(axis):
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: seconds_text(x)))
    axis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def whole_decades(low, high):
    """Limits that end at powers of ten, so that an axis has labels."""
    return 10.0 ** math.floor(math.log10(low / 1.15)), 10.0 ** math.ceil(math.log10(high * 1.15))


def names_beside(one, ends, may_stand_above=True):
    """Names at the right of points, (x, y, name, colour): above where another point is in the way, moved up over others."""
    one.figure.canvas.draw()
    points = one.figure.dpi / 72
    height, gap = 13 * points, 9 * points
    places = [one.transData.transform((x, y)) for x, y, _, _ in ends]
    boxes = [(px - 0.7 * gap, py - 0.7 * gap, px + 0.7 * gap, py + 0.7 * gap) for px, py in places]  # of markers, then of names

    def is_free(box, but):
        return all(k == but or box[2] < b[0] or b[2] < box[0] or box[3] < b[1] or b[3] < box[1] for k, b in enumerate(boxes))

    for k in sorted(range(len(ends)), key=lambda k: places[k][1]):
        (x, y, name, colour), (px, py) = ends[k], places[k]
        length = 6.6 * len(name) * points
        for dx, dy in [(gap, 0), *([(-length / 2, 1.3 * height)] if may_stand_above else []), *((gap, up * 0.2 * height) for up in range(1, 40))]:
            box = (px + dx, py + dy - 0.45 * height, px + dx + length, py + dy + 0.45 * height)
            if is_free(box, k):
                break
        boxes.append(box)
        text = one.annotate(name, (x, y), xytext=(dx / points, dy / points), textcoords="offset points", color=colour, va="center",
                            fontsize=9.5, annotation_clip=False, fontweight="bold" if colour == COLOURS[0] else "normal")
        text.set_path_effects([patheffects.withStroke(linewidth=3, foreground="white")])


def draw_lines(one, series, x_label, heights, times):
    one.set_xscale("log"), one.set_yscale("log")
    ends = []
    for (name, points), colour, marker in zip(list(series.items())[:MOST_SERIES], COLOURS, MARKERS):
        points = sorted(p for p in points if p[1] > 0)
        if not points:
            continue
        one.plot(*zip(*points), marker=marker, markersize=5, color=colour, linewidth=2 if colour == COLOURS[0] else 1.4)
        ends.append((*points[-1], name, colour))
    if heights:
        one.set_ylim(*whole_decades(min(heights), max(heights)))
    one.set_xlabel(x_label)
    if times:
        time_axis(one.yaxis)
    else:
        one.yaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda y, _: f"{y:,g}"))
        one.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    names_beside(one, ends, may_stand_above=False)


def heights_of(series):
    return [y for points in list(series.values())[:MOST_SERIES] for _, y in points if y > 0]


def lines(series, x_label, y_label, times=True, ticks=()):
    """\\param series {name: [(x, y), ...]}, ours first. Both axes are logarithmic. \\param ticks places on x that are named"""
    figure, one = axes()
    one.set_ylabel(y_label)
    draw_lines(one, series, x_label, heights_of(series), times)
    if ticks:
        one.set_xticks(ticks, [f"{x:g}" for x in ticks])
        one.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    return data_address(figure)


def two_panels(left, right, y_label):
    """Beside each other, with the same heights. \\param left, right (series, label of x)"""
    figure, panels = plt.subplots(1, 2, figsize=(9.4, 4.0), sharey=True)
    figure.subplots_adjust(wspace=0.62)
    for one, (series, x_label) in zip(panels, (left, right)):
        one.grid(True, which="major", color="#e6e6e6", linewidth=0.8)
        one.tick_params(which="both", length=0)
        draw_lines(one, series, x_label, heights_of(left[0]) + heights_of(right[0]), True)
    panels[0].set_ylabel(y_label)
    return data_address(figure)


def speed_error(points, y_label, x_label="time of one"):
    """Time against error on one pair of axes. \\param points [(name, seconds, error)], ours first; no error stands on a line below"""
    figure, one = axes()
    one.set_xscale("log")
    points = [p for p in points if p[1] > 0][:MOST_SERIES]
    errors = [e for _, _, e in points if e > 0]
    floor = 10.0 ** (math.floor(math.log10(min(errors))) - 1) if errors else 1e-3
    has_zero = len(errors) < len(points)
    low, high = whole_decades(min(errors, default=1), max(errors, default=1))
    low = floor if has_zero else low
    pad = (high / low) ** 0.07
    one.set_yscale("log")
    one.set_ylim(low / pad, high * pad)
    if has_zero:
        one.axhline(floor, color=FAINT, linewidth=0.8, linestyle=(0, (4, 4)))
        one.annotate("none", (0, floor), xycoords=("axes fraction", "data"), xytext=(4, 5), textcoords="offset points", color=FAINT, fontsize=9)
    ends = []
    for (name, seconds, error), colour, marker in zip(points, COLOURS, MARKERS):
        y = error if error > 0 else floor
        one.plot(seconds, y, marker, color=colour, markersize=10)
        ends.append((seconds, y, name, colour))
    if points:
        one.set_xlim(*whole_decades(min(p[1] for p in points), max(p[1] for p in points)))
    one.set_xlabel(x_label), one.set_ylabel(y_label)
    time_axis(one.xaxis)
    names_beside(one, ends)
    return data_address(figure)


def bars(rows, x_label):
    """Each with its name above. \\param rows [(name, length, text at its end, is good)]; the axis is logarithmic"""
    figure, one = axes(height=0.9 + 0.5 * len(rows))
    one.set_xscale("log")
    one.set_xlim(0.7, 10 * max((length for _, length, _, _ in rows), default=1))
    for k, (name, length, text, good) in enumerate(rows):
        one.barh(k, max(length, 1), left=0.7, height=0.3, color=COLOURS[0] if good else COLOURS[1])
        one.annotate(name, (0.7, k - 0.15), xytext=(2, 7), textcoords="offset points", va="center", fontsize=9.5,
                     color=INK)
        one.annotate(text, (max(length, 1) + 0.7, k), xytext=(6, 0), textcoords="offset points", va="center", fontsize=9.5, color=FAINT if good else COLOURS[1])
    one.set_yticks([])
    one.spines["left"].set_visible(False)
    one.set_ylim(len(rows) - 0.6, -0.9)
    one.grid(False, axis="y")
    one.set_xlabel(x_label)
    return data_address(figure)
