#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the flat figures of the pages: classes, culling, the contacts of a slide, axis moves, the loop.

draw_diagrams.py [FOLDER], by default doc/pictures. Needs python3-matplotlib. Nothing is measured.
"""
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
from matplotlib.patches import FancyBboxPatch, Polygon

HERE = os.path.dirname(os.path.abspath(__file__))
FOLDER = sys.argv[1] if len(sys.argv) > 1 else f"{HERE}/pictures"
STILL, MOVING, SWEPT, TOUCH, WAY = "#5b6b7b", "#2a7fb8", "#8cc4e8", "#d1495b", "#222222"
pyplot.rcParams.update({"font.size": 10, "font.family": "DejaVu Sans"})


def sheet(width, height, columns=1):
    figure, axes = pyplot.subplots(1, columns, figsize=(width, height))
    for axis in [axes] if columns == 1 else axes:
        axis.set_axis_off()
    return figure, axes


def save(figure, name):
    figure.tight_layout()
    figure.savefig(f"{FOLDER}/{name}.png", dpi=110)


def box(axis, x, y, width, height, text, color=STILL, alpha=0.12):
    axis.add_patch(FancyBboxPatch((x, y), width, height, boxstyle="round,pad=0.02,rounding_size=0.08", facecolor=color, alpha=alpha, linewidth=0))
    axis.add_patch(FancyBboxPatch((x, y), width, height, boxstyle="round,pad=0.02,rounding_size=0.08", facecolor="none", edgecolor=color))
    axis.text(x + width / 2, y + height / 2, text, ha="center", va="center", fontsize=9.5)


def arrow(axis, source, target, color=WAY, style="->", line="-", width=1.2):
    axis.annotate("", xy=target, xytext=source, arrowprops={"arrowstyle": style, "color": color, "linestyle": line, "linewidth": width})


def classes():
    """Who holds what: arrows from what is used to what it stands on."""
    figure, axis = sheet(12, 6.2)
    axis.set_xlim(0, 12), axis.set_ylim(0, 6.2)
    box(axis, 0.2, 5.2, 2.6, 0.8, "Grab\na vertex in the hand", MOVING)
    box(axis, 3.1, 5.2, 2.4, 0.8, "Probe\na point that touches", MOVING)
    box(axis, 5.8, 5.2, 2.4, 0.8, "Stroke\none step of undo", MOVING)
    box(axis, 8.6, 5.2, 3.2, 0.8, "move_vertices, apply_brush,\nremeshing, point maps", MOVING)
    box(axis, 1.2, 3.9, 7.4, 0.8, "Sculptor<Mesh, BroadPhase, EditVisitor, SweptCollisionTraits_3>\nguards a CGAL::Surface_mesh", MOVING, 0.3)
    box(axis, 0.2, 2.4, 3.6, 0.9, "the hand: one moving star\ncandidates, pairs, legs, slide")
    box(axis, 4.1, 2.4, 3.2, 0.9, "the editor: proofs, changes,\nhistory, numbers of vertices")
    box(axis, 7.6, 2.4, 2.6, 0.9, "axis moves\nmany vertices at once")
    box(axis, 0.2, 1.1, 3.1, 0.8, "exact sweeps\nwhat is met, when, what first")
    box(axis, 3.6, 1.1, 3.1, 0.8, "broad phase\nfaces near something")
    box(axis, 7.0, 1.1, 3.2, 0.8, "axis sweeps\nwhat meets along one axis")
    box(axis, 8.9, 3.9, 2.9, 0.8, "Tool, Haptic_loop, Pose_loop\nprobe and grabs by a handle", TOUCH)
    box(axis, 10.45, 1.1, 1.4, 2.2, "device:\nkinematics,\ndynamics\n(no CGAL)", TOUCH)
    for source in ((1.5, 5.2), (4.3, 5.2), (7, 5.2), (9.4, 5.2)):
        arrow(axis, source, (min(source[0], 8.0), 4.72))
    arrow(axis, (8.9, 4.3), (8.62, 4.3)), arrow(axis, (11.15, 3.9), (11.15, 3.32))
    for x, below in ((2.0, 2.0), (5.7, 5.7), (8.2, 8.9)):
        arrow(axis, (x, 3.9), (below, 3.32))
    arrow(axis, (1.6, 2.4), (1.6, 1.92)), arrow(axis, (3.0, 2.4), (4.2, 1.92)), arrow(axis, (5.4, 2.4), (5.2, 1.92)), arrow(axis, (8.9, 2.4), (8.7, 1.92))
    arrow(axis, (4.6, 2.4), (2.9, 1.92))
    axis.text(0.2, 0.45, "blue: what a program calls     grey: inside, namespace internal     red: from a device's handle to its motors", color=STILL)
    save(figure, "class_overview")


def culling():
    """What of the surroundings of a moving star is left to be swept."""
    figure, axes = sheet(13, 4.2, 3)
    link = [(-1.0, 0.0), (1.1, 0.1)]
    start, end = (-0.1, 0.5), (0.25, 0.95)
    still = [((-1.6, 0.9), (-1.2, 1.3)), ((-0.9, 1.0), (-0.5, 1.35)), ((-0.2, 1.25), (0.15, 1.15)), ((0.0, 0.85), (0.3, 0.72)),
             ((0.8, 0.85), (1.15, 0.6)), ((1.4, 0.2), (1.8, 0.5)), ((-0.4, -0.45), (0.2, -0.6)), ((0.7, -0.2), (1.2, -0.4))]
    near, left = {1, 2, 3, 4, 7}, {3}
    titles = ("the broad phase: faces whose boxes\nmeet that of the star's way", "planes along the star: what is wholly\nbeyond one of them cannot be touched",
              "pairs that are left\nare swept exactly")
    for step, (axis, title) in enumerate(zip(axes, titles)):
        axis.set_title(title, fontsize=11)
        axis.add_patch(Polygon([link[0], start, end, link[1]], facecolor=SWEPT, alpha=0.35))
        for corner in (start, end):
            for l in link:
                axis.plot([l[0], corner[0]], [l[1], corner[1]], color=MOVING, linewidth=2 if corner == start else 1, linestyle="-" if corner == start else "--")
        for i, (a, b) in enumerate(still):
            kept = (True, i in near, i in left)[step]
            color = TOUCH if (i in near, i in near, i in left)[step] and (step != 1 or i in left) else STILL
            axis.plot([a[0], b[0]], [a[1], b[1]], color=color, linewidth=2.4, alpha=1 if kept else 0.18)
        if step == 0:
            axis.add_patch(pyplot.Rectangle((-1.0, 0.0), 2.1, 0.95 + 0.12, fill=False, edgecolor=STILL, linestyle=":"))
            axis.add_patch(pyplot.Rectangle((-1.1, -0.25), 2.3, 1.6, fill=False, edgecolor=STILL, linestyle="--"))
            axis.text(-1.08, 1.4, "region, kept for the drags that follow", fontsize=8.5, color=STILL)
        if step == 1:
            for (x0, y0), (x1, y1) in (((-1.35, -0.25), (0.55, 1.35)), ((-0.1, 1.23), (1.65, -0.42)), ((-1.5, -0.12), (1.6, 0.02))):
                axis.plot([x0, x1], [y0, y1], color=WAY, linewidth=1, linestyle=":")
        arrow(axis, start, end, MOVING, width=2)
        axis.plot(*start, "o", color=MOVING)
        axis.set_xlim(-1.7, 1.9), axis.set_ylim(-0.75, 1.6), axis.set_aspect("equal")
    save(figure, "culling")


def slide_contacts():
    """Legs, clearance, and what is kept of a contact."""
    figure, axis = sheet(9.5, 6.4)
    floor, wall, c = 0.0, 6.2, 0.3
    axis.add_patch(Polygon([(-0.5, floor), (wall, floor), (wall, 3.4), (7.6, 3.4), (7.6, -2.5), (-0.5, -2.5)], facecolor=STILL, alpha=0.35))
    axis.plot([-0.5, wall, wall], [floor, floor, 3.4], color=STILL, linewidth=2)
    axis.plot([-0.5, wall - c, wall - c], [floor + c, floor + c, 3.4], color=STILL, linewidth=0.8, linestyle="--")
    source, target, corner = (0.2, 2.9), (7.0, -2.0), (wall - c, floor + c)
    share = (source[1] - corner[1]) / (source[1] - target[1])
    landing = (source[0] + share * (target[0] - source[0]), corner[1])
    arrow(axis, landing, target, WAY, line=":")
    for a, b in ((source, landing), (landing, corner)):
        arrow(axis, a, b, MOVING, width=2)
    for p, name, place, color in ((source, "S, where the drag began", (0.3, 2.98), MOVING), (landing, "", landing, MOVING),
                                  (corner, "J, held", (wall + 0.12, corner[1] - 0.05), MOVING), (target, "T, the target", (5.75, -2.3), WAY)):
        axis.plot(*p, "o", color=color)
        axis.text(*place, name, color=color)
    arrow(axis, (corner[0] - 0.04, corner[1] + 0.06), (corner[0] - 0.04, corner[1] + 1), TOUCH, width=1.8)
    arrow(axis, (corner[0] - 0.06, corner[1] + 0.09), (corner[0] - 1, corner[1] + 0.09), TOUCH, width=1.8)
    axis.text(4.15, 1.3, "push of the first contact", color=TOUCH, fontsize=9), axis.text(4.75, 0.58, "of the second", color=TOUCH, fontsize=9)
    arrow(axis, (1.4, floor), (1.4, floor + c), STILL, style="<->")
    axis.text(1.5, floor - 0.3, "c, the clearance from every contact plane", color=STILL, fontsize=9)
    axis.text(2.1, 1.75, "leg 1: proven free as a whole", color=MOVING, fontsize=9)
    axis.text(4.3, 0.08, "leg 2: along the plane", color=MOVING, fontsize=9)
    axis.text(-0.4, -2.35, "A contact is kept until J is 8 c off its plane, or past the border of its facet.", color=STILL, fontsize=9)
    axis.set_xlim(-0.6, 7.7), axis.set_ylim(-2.5, 3.4), axis.set_aspect("equal")
    save(figure, "slide_contacts")


def axis_moves():
    """Sheets over a plane: who is above whom decides."""
    figure, axes = sheet(13, 4.3, 3)
    xs = [0, 1, 2, 3, 4]
    upper, lower = [2.0, 2.5, 2.2, 2.6, 2.1], [0.8, 1.3, 0.7, 1.1, 0.9]
    new_upper, new_lower = [2.9, 2.6, 3.2, 2.8, 3.1], [1.6, 0.6, 1.9, 1.2, 2.2]
    bad_lower = [1.6, 0.6, 3.6, 1.2, 2.2]
    shows = (("at the start", upper, lower, None), ("free: each vertex goes its own way along the axis;\nat the end the order is what it was", new_upper, new_lower, True),
             ("not free: between the same two features\nthe order has changed, so they have met", new_upper, bad_lower, False))
    for axis, (title, top, bottom, is_free) in zip(axes, shows):
        axis.set_title(title, fontsize=11)
        if is_free is not None:
            axis.plot(xs, upper, color=MOVING, alpha=0.25), axis.plot(xs, lower, color=STILL, alpha=0.25)
            for x, a, b in [*zip(xs, upper, top), *zip(xs, lower, bottom)]:
                arrow(axis, (x, a), (x, b), WAY, width=0.9)
        axis.plot(xs, top, "o-", color=MOVING, linewidth=2), axis.plot(xs, bottom, "o-", color=STILL, linewidth=2)
        if is_free is False:
            axis.plot(2, 3.4, "o", markersize=26, fillstyle="none", color=TOUCH, markeredgewidth=2)
        axis.plot([0, 4], [-0.3, -0.3], color=WAY, linewidth=1)
        for x in xs:
            axis.plot([x, x], [-0.3, min(bottom[x], top[x])], color=WAY, linewidth=0.5, linestyle=":")
        axis.text(0, -0.65, "the plane across the axis: seen from there nothing moves", fontsize=8.5)
        axis.set_xlim(-0.4, 4.4), axis.set_ylim(-0.8, 4.1)
    save(figure, "axis_moves")


def loop():
    """The chain of forces in a tick, and who else is there."""
    figure, axis = sheet(13, 5.4)
    axis.set_xlim(0, 13), axis.set_ylim(0, 5.4)
    steps = (("reading:\nangles or place,\nbutton, time", TOUCH), ("watchdog:\nfaults fade\nthe force", STILL), ("place, velocity,\nJacobian", STILL), ("tool: anchored\ntarget T, drag with\nbounded work,\nproxy x", MOVING),
             ("coupling\nk (x − T),\ndamping", STILL), ("virtual mass,\npassivity\ncontroller", STILL), ("clamp, slew,\nburst, ramp,\nfade", STILL), ("force, or torques\nwithin the motors'\nlimits, and gravity", TOUCH))
    for i, (text, color) in enumerate(steps):
        box(axis, 0.15 + 1.61 * i, 2.5, 1.42, 1.25, text, color)
        if i:
            arrow(axis, (0.15 + 1.61 * i - 0.17, 3.12), (0.15 + 1.61 * i, 3.12))
    axis.add_patch(pyplot.Rectangle((0.02, 2.3), 12.95, 1.95, fill=False, edgecolor=MOVING, linestyle="--"))
    axis.text(0.15, 3.98, "the loop's thread: one tick, nothing waits, nothing throws, nothing is allocated once warm", color=MOVING)
    box(axis, 0.9, 4.55, 3.3, 0.7, "the hand, through the device's handle", TOUCH), arrow(axis, (1.0, 4.55), (0.85, 3.77), TOUCH), arrow(axis, (12.1, 3.77), (4.2, 4.9), TOUCH)
    box(axis, 0.6, 0.5, 3.4, 1.0, "who asks: a window, a program\ncommands and tasks by Command_queue", STILL)
    box(axis, 4.8, 0.5, 3.4, 1.0, "who looks: changed faces\nand ticks by Scene_feed", STILL)
    box(axis, 9.0, 0.5, 3.4, 1.0, "who writes: the log\nby Edit_journal", STILL)
    arrow(axis, (2.3, 1.52), (5.2, 2.48)), arrow(axis, (5.8, 2.48), (6.4, 1.52)), arrow(axis, (6.1, 2.48), (10.2, 1.52))
    axis.text(0.15, 0.1, "other threads never touch the mesh; between two of them stand queues without locks", color=STILL)
    save(figure, "loop")


for draw in (classes, culling, slide_contacts, axis_moves, loop):
    draw()
