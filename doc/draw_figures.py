#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the figures that explain the sweeps and the contact plane: draw_figures.py [FOLDER], by default doc/pictures.

Needs python3-matplotlib. All that is drawn is computed here from a few points; nothing is measured.
"""
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
import numpy
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

HERE = os.path.dirname(os.path.abspath(__file__))
FOLDER = sys.argv[1] if len(sys.argv) > 1 else f"{HERE}/pictures"
STILL, MOVING, SWEPT, TOUCH, WAY = "#5b6b7b", "#2a7fb8", "#8cc4e8", "#d1495b", "#222222"
pyplot.rcParams.update({"font.size": 10, "font.family": "DejaVu Sans"})


def at(*numbers):
    return numpy.array(numbers, dtype=float)


def faces(axis, triangles, color, alpha):
    axis.add_collection3d(Poly3DCollection(triangles, facecolors=color, edgecolors=color, alpha=alpha, linewidths=1.0))


def lines(axis, ends, color, width=1.2, style="-"):
    axis.add_collection3d(Line3DCollection(ends, colors=color, linewidths=width, linestyles=style))


def dot(axis, point, color, label="", shift=(0, 0, 0.08)):
    axis.scatter(*point, color=color, s=28, depthshade=False, zorder=10)
    if label:
        axis.text(*(point + at(*shift)), label, color=color, zorder=11)


def arrow(axis, source, target):
    axis.quiver(*source, *(target - source), color=WAY, linewidth=1.6, arrow_length_ratio=0.14)


def panel(figure, place, title, view, box):
    axis = figure.add_subplot(1, 4, place, projection="3d", computed_zorder=False)
    axis.set_axis_off()
    axis.view_init(*view)
    axis.set_xlim(*box[0]), axis.set_ylim(*box[1]), axis.set_zlim(*box[2])
    axis.set_box_aspect([b[1] - b[0] for b in box], zoom=1.65)
    axis.set_title(title, fontsize=11)
    return axis


def sweeps():
    """A star and what it sweeps over; the three kinds of first contact."""
    figure = pyplot.figure(figsize=(15, 3.9))
    box = [(-1.1, 1.1), (-1.1, 1.1), (-0.2, 1.3)]

    axis = panel(figure, 1, "the star of the moving vertex,\nand what it sweeps over", (16, -62), box)
    angles = numpy.arange(6) * numpy.pi / 3
    link = [at(numpy.cos(a), numpy.sin(a), 0.12 * (-1) ** k) for k, a in enumerate(angles)]
    source, target = at(0, 0, 0.25), at(0.25, 0, 1.15)
    for k in range(6):
        u, v = link[k], link[(k + 1) % 6]
        faces(axis, [[source, u, v]], STILL, 0.35)
        faces(axis, [[source, target, u]], SWEPT, 0.22)
    lines(axis, [[target, u] for u in link], MOVING)
    lines(axis, [[link[k], link[(k + 1) % 6]] for k in range(6)], STILL, 2)
    arrow(axis, source, target)
    dot(axis, source, WAY, "S", (-0.16, 0, -0.02))
    dot(axis, target, MOVING, "T")
    axis.text2D(0.62, 0.12, "link, stands still", color=STILL, transform=axis.transAxes)

    # Each: a moving part at its start, at the touch, and what it touches.
    axis = panel(figure, 2, "vertex–face: the moving vertex\nmeets a face", (18, -60), box)
    triangle = [at(-0.9, -0.6, 0.5), at(0.9, -0.7, 0.5), at(0.1, 0.9, 0.5)]
    source, touch, target = at(-0.1, -0.1, 1.25), at(0, -0.12, 0.5), at(0.09, -0.14, -0.15)
    faces(axis, [triangle], STILL, 0.45)
    arrow(axis, source, target)
    dot(axis, source, MOVING, "S", (-0.18, 0, 0))
    dot(axis, touch, TOUCH, "P(u)", (0.08, 0, 0.05))
    dot(axis, target, WAY, "T", (0.08, 0, 0))

    axis = panel(figure, 3, "face–vertex: a face of the star\nmeets a vertex", (18, -60), box)
    g, h = at(-0.9, -0.5, 0.1), at(0.8, -0.8, 0.1)
    source, target = at(0.2, 0.9, 1.25), at(0.2, 0.9, -0.15)
    vertex = at(0.05, -0.1, 0.42)
    # The face (g, h, P) passes the vertex where det(g - vertex, h - vertex, P - vertex) = 0, which is linear in u.
    def volume(p):
        return numpy.linalg.det([g - vertex, h - vertex, p - vertex])
    u = volume(source) / (volume(source) - volume(target))
    touch = source + u * (target - source)
    faces(axis, [[g, h, source]], SWEPT, 0.3)
    faces(axis, [[g, h, touch]], MOVING, 0.4)
    arrow(axis, source, target)
    dot(axis, source, MOVING, "S", (0.08, 0, 0))
    dot(axis, target, WAY, "T", (0.08, 0, 0))
    dot(axis, vertex, TOUCH, "vertex A", (-0.25, 0, -0.22))

    axis = panel(figure, 4, "edge–edge: an edge of the star\nmeets an edge", (18, -60), box)
    g = at(-0.9, -0.3, 0.2)
    a, b = at(0.1, -0.9, 0.55), at(0.1, 0.9, 0.45)
    source, target = at(0.9, 0.1, 1.25), at(0.9, 0.1, 0.0)
    def volume(p):
        return numpy.linalg.det([a - g, b - g, p - g])
    u = volume(source) / (volume(source) - volume(target))
    touch = source + u * (target - source)
    share = (a[0] - g[0]) / (touch[0] - g[0])  # both edges are seen along y and x, so this is where they cross
    point = g + share * (touch - g)
    faces(axis, [[g, source, target]], SWEPT, 0.3)
    lines(axis, [[g, source], [g, touch]], MOVING, 2)
    lines(axis, [[a, b]], STILL, 3)
    arrow(axis, source, target)
    dot(axis, source, MOVING, "S", (0.06, 0, 0.02))
    dot(axis, target, WAY, "T", (0.06, 0, 0))
    dot(axis, point, TOUCH)
    figure.subplots_adjust(left=0, right=1, bottom=0, top=0.86, wspace=0)
    figure.savefig(f"{FOLDER}/sweeps.png", dpi=110)


def contact_plane():
    """Where a blocked vertex stops, and for how long a contact holds a slide."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(13, 4.4))
    c = 0.35

    left.set_title("a stop: the clearance c, normal to the contact plane", fontsize=11)
    left.fill_between([-1.2, 2.6], -0.6, 0, color=STILL, alpha=0.35)
    left.axhline(0, color=STILL, linewidth=2)
    left.axhline(c, color=STILL, linewidth=0.8, linestyle="--")
    source, impact, target = at(-1, 1.6), at(0.6, 0), at(1.1, -0.5)
    stop = impact + (source - impact) * c / source[1]
    left.annotate("", xy=target, xytext=impact, arrowprops={"arrowstyle": "->", "color": WAY, "linestyle": ":"})
    left.annotate("", xy=stop, xytext=source, arrowprops={"arrowstyle": "-", "color": MOVING, "linewidth": 2})
    for point, name, color, shift in ((source, "S", MOVING, (0.06, 0.04)), (stop, "J", MOVING, (0.06, 0.06)),
                                      (impact, "first impact, u", TOUCH, (0.08, 0.05)), (target, "T", WAY, (0.06, 0))):
        left.plot(*point, "o", color=color)
        left.text(*(point + at(*shift)), name, color=color)
    left.annotate("", xy=(stop[0], 0), xytext=stop, arrowprops={"arrowstyle": "<->", "color": STILL})
    left.text(stop[0] - 0.12, c / 2 - 0.05, "c", color=STILL)
    middle = (stop + impact) / 2
    left.text(middle[0] + 0.1, middle[1] + 0.07, "setback c / sin of the angle", color=MOVING, fontsize=9)
    left.text(1.55, -0.4, "what it met", color=STILL)

    right.set_title("a facet: for how long a contact holds a slide (seen from above)", fontsize=11)
    corners = numpy.array([(0.2, 0.2), (2.0, 0.3), (1.0, 1.6)])
    middle = corners.mean(axis=0)
    right.add_patch(pyplot.Polygon(corners, facecolor=STILL, alpha=0.35, edgecolor=STILL, linewidth=2))
    # Borders stand a clearance outside of the feature.
    wider = []
    for k in range(3):
        p, q = corners[k], corners[(k + 1) % 3]
        normal = at(q[1] - p[1], p[0] - q[0])
        normal /= numpy.linalg.norm(normal)
        wider.append((normal, normal @ p + 0.18))
    outline = [numpy.linalg.solve([wider[k][0], wider[k - 1][0]], [wider[k][1], wider[k - 1][1]]) for k in range(3)]
    right.add_patch(pyplot.Polygon(outline, facecolor="none", edgecolor=STILL, linestyle="--"))
    right.text(0.72, 0.5, "face met", color=STILL)
    right.text(-0.3, 1.42, "left behind c outside", color=STILL)
    ways = [at(0.45, 0.42), at(1.2, 0.85), at(1.75, 1.12), at(2.5, 1.2)]
    for p, q, color in ((ways[0], ways[1], MOVING), (ways[1], ways[2], MOVING), (ways[2], ways[3], WAY)):
        right.annotate("", xy=q, xytext=p, arrowprops={"arrowstyle": "->", "color": color, "linewidth": 2})
    right.plot(*ways[0], "o", color=MOVING)
    right.text(ways[0][0] - 0.02, ways[0][1] - 0.16, "J slides: held by the plane", color=MOVING, fontsize=9)
    right.text(1.82, 0.95, "past a border the contact\nis forgotten: free again", color=WAY, fontsize=9, va="top")
    right.set_xlim(-0.5, 3), right.set_ylim(-0.1, 2.1)
    left.set_xlim(-1.2, 2.6), left.set_ylim(-0.6, 1.8)
    for axis in (left, right):
        axis.set_aspect("equal")
        axis.set_axis_off()
    figure.tight_layout()
    figure.savefig(f"{FOLDER}/contact_plane.png", dpi=110)


sweeps()
contact_plane()
