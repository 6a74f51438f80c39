#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a trefoil knot of round cross section to standard output, as OFF: a closed, embedded triangle mesh."""
import math
import sys

ALONG, AROUND, RADIUS = 480, 40, 0.3


def on_knot(t):
    return ((2 + math.cos(3 * t)) * math.cos(2 * t), (2 + math.cos(3 * t)) * math.sin(2 * t), math.sin(3 * t))


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def ring(t):
    """A circle across the knot. Its frame is that of the torus the knot lies on, so the last ring fits the first."""
    step = 1e-4
    tangent = unit(tuple(b - a for a, b in zip(on_knot(t - step), on_knot(t + step))))
    out = (math.cos(3 * t) * math.cos(2 * t), math.cos(3 * t) * math.sin(2 * t), math.sin(3 * t))
    side = unit(cross(tangent, out))
    normal = cross(side, tangent)
    centre = on_knot(t)
    for j in range(AROUND):
        a = 2 * math.pi * j / AROUND
        yield tuple(c + RADIUS * (math.cos(a) * n + math.sin(a) * s) for c, n, s in zip(centre, normal, side))


def write_knot(file):
    points = [p for i in range(ALONG) for p in ring(2 * math.pi * i / ALONG)]
    print(f"OFF\n{len(points)} {2 * len(points)} 0", file=file)
    for p in points:
        print(" ".join(f"{x:.6f}" for x in p), file=file)
    for i in range(ALONG):
        for j in range(AROUND):
            a, b = i * AROUND + j, i * AROUND + (j + 1) % AROUND
            c, d = (a + AROUND) % len(points), (b + AROUND) % len(points)
            print(f"3 {a} {b} {c}\n3 {c} {b} {d}", file=file)


if __name__ == "__main__":
    try:
        with open(sys.stdout.fileno(), "w", closefd=False) as output:  # which says here what cannot be written
            write_knot(output)
    except OSError as error:
        sys.exit(f"make_knot.py: standard output: {error.strerror}")
