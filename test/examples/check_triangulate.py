#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`sculpt --triangulate` on polygons of many corners, tilted, reflex and folded; and what `remesh` may be asked for of a needle.

What is a triangulation is known in integers: its triangles are turned as the polygon is, their number is its corners' less two, and their
areas are its own together. Arguments: sculpt, source folder."""
import itertools
import json
import math
import os
import random
import tempfile

from program_runs import check, end, fails, run, surface, write

SEED = int(os.environ.get("HAPTIC_SCULPT_SEED", "1"))
FOLDED = ("OFF\n7 7 0\n2 1 2\n2 1 3\n3 1 3\n2 2 3\n2 2 2\n3 1 2\n17.3 -11.1 5.7\n6 0 1 2 3 4 5\n3 1 0 6\n3 2 1 6\n3 3 2 6\n3 4 3 6\n3 5 4 6\n3 0 5 6\n")
COLOURED = ("ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float heat\n"
            "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
            + "".join(f"{v & 1} {v >> 1 & 1} {v >> 2} {v} 2 3 {v}.5\n" for v in range(8))
            + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n")
NEEDLE = "OFF\n4 4 0\n0 0 0\n1 0 0\n0.5 1e-09 0\n0.5 0 1e-09\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


def star(rng, n, size, is_rough):
    """A simple polygon: the corners are seen from the origin one after the other."""
    polygon = []
    for i in range(n):
        angle = 2 * math.pi * (i + rng.uniform(0.1, 0.9)) / n
        radius = size * (rng.uniform(0.5, 1) if is_rough else 0.7 + 0.3 * math.sin(7 * angle))
        polygon.append((round(radius * math.cos(angle)), round(radius * math.sin(angle))))
    return polygon


def prism(polygon, slope, axes, turned):
    """Between two copies of a polygon, tilted and with its axes exchanged, in integers. Exchanging two turns it inside out."""
    at = [(x, y, slope[0] * x + slope[1] * y + z) for z in (0, 10**9) for x, y in polygon]
    at = [tuple(p[k] for k in axes) for p in at]
    n = len(polygon)
    faces = [list(reversed(range(n))), list(range(n, 2 * n))] + [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    if turned:
        faces = [list(reversed(face)) for face in faces]
    return at, faces


def area(points, axis):
    x, y = (axis + 1) % 3, (axis + 2) % 3
    return sum(a[x] * b[y] - b[x] * a[y] for a, b in zip(points, points[1:] + points[:1]))


def is_divided(at, faces, triangles, upright):
    """Whether the first two faces are the union of triangles in their corners, without overlaps."""
    of_face = [set(faces[0]), set(faces[1])]
    for face, corners in zip(faces, of_face):
        inside = [t for t in triangles if set(t) <= corners]
        areas, whole = [area([at[i] for i in t], upright) for t in inside], area([at[i] for i in face], upright)
        if len(inside) != len(face) - 2 or sum(areas) != whole or any(a * whole <= 0 for a in areas):
            return False
    return True


def main():
    rng = random.Random(SEED)
    print("seed", SEED)
    with tempfile.TemporaryDirectory() as folder:
        path, out = f"{folder}/prism.off", f"{folder}/out.off"
        sizes = [4, 5, 6, 7, 12, 40, 300]
        cases = [(n, slope, axes) for n in sizes for slope, axes in zip(((0, 0), (1, -2), (-3, 5)), rng.sample(list(itertools.permutations(range(3))), 3))]
        for n, slope, axes in cases + [(6000, (1, -2), (1, 2, 0))]:
            turned = sum(axes[i] > axes[j] for i in range(3) for j in range(i + 1, 3)) % 2 == 1
            at, faces = prism(star(rng, n, 10**9, n < 1000), slope, axes, turned)
            write(path, f"OFF\n{len(at)} {len(faces)} 0\n" + "".join("%d %d %d\n" % p for p in at) + "".join(f"{len(f)} {' '.join(map(str, f))}\n" for f in faces))
            done = run(path, "--triangulate", "-o", out)
            check(done.returncode == 0, f"{n} corners, slope {slope}, axes {axes}: {done.stderr[:300]}")
            if done.returncode == 0:
                points, triangles = surface(out)
                check([tuple(map(int, p)) for p in points] == at, f"{n} corners: points")
                check(is_divided(at, faces, triangles, axes.index(2)), f"{n} corners, slope {slope}, axes {axes}: this is no triangulation")
        done = run(write(f"{folder}/quads.ply", COLOURED), "--triangulate", "-o", f"{folder}/out.ply")
        text = open(f"{folder}/out.ply", "rb").read()
        words = (b"uchar red", b"uchar green", b"uchar blue", b"float heat")
        check(done.returncode == 0 and all(word in text for word in words), "colours and other numbers go on")
        done = run(f"{folder}/quads.ply", "--triangulate", "-o", out)
        is_told = "colours" in done.stderr and "heat" in done.stderr
        check(done.returncode == 0 and is_told, f"a line says what is lost: {done.stderr}")
        for text in (FOLDED, FOLDED.replace("2 1 3\n", "2 1 3.5\n")):
            fails(3, ["face 0", "folds"], run(write(path, text), "--triangulate", "--report", f"{folder}/folds.json"), "a folded hexagon")
            check(json.load(open(f"{folder}/folds.json"))["faults"]["non_triangular_faces"] == [0], "which the report names")
        on_a_line = "OFF\n4 2 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 1 2 3\n4 3 2 1 0\n"
        fails(3, ["face 0 (and 1 more)"], run(write(path, on_a_line), "--triangulate", "--delta", 1e-3, "--report",
                                              f"{folder}/two.json"), "two polygons without area")
        told = json.load(open(f"{folder}/two.json"))
        check(told["faults"]["non_triangular_faces"] == [0, 1] and told["delta"] == 1e-3, f"both are named: {told}")
        for length, is_refused in (("1e-5", True), ("1e-300", True), ("0.05", False)):
            report = f"{folder}/report.json"
            done = run(write(path, NEEDLE), "--script", "-", "--report", report, script=f"remesh {length}\n")
            edit = json.load(open(report))["edits"][0]
            check(done.returncode == 0 and (edit["reason"] == "too-many-triangles") == is_refused, f"a needle, remesh {length}: {edit}")
    end()


main()
