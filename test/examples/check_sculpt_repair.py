#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`sculpt --repair` and `--orient`: what they mend, what they say, what they leave alone."""
import hashlib
import json
import os
import tempfile

from box_mesh import box, off
from program_runs import OCTAHEDRON, bytes_of, check, end, fails, points, run, surface, write


def parsed_box():
    lines = [line.split() for line in box(2).split("\n")[2:] if line]
    return [tuple(map(float, line)) for line in lines if len(line) == 3], [list(map(int, line[1:])) for line in lines if len(line) == 4]


def turned(faces):
    return [[a, c, b] for a, b, c in faces]


def moved(vertices, x):
    return [(v[0] + x, v[1] + 0.25, v[2] + 0.125) for v in vertices]


def broken_meshes():
    vertices, faces = parsed_box()
    n = len(vertices)
    both = [[a + n, b + n, c + n] for a, b, c in faces]
    yield "hole", off(vertices, faces[2:])
    yield "soup", off([vertices[v] for f in faces for v in f], [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(len(faces))])
    yield "gaps", off([tuple(x + 1e-7 * ((7 * i + k) % 5 - 2) / 5 for k, x in enumerate(vertices[v])) for f in faces for i, v in enumerate(f)],
                      [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(len(faces))])
    yield "doubled", off(vertices, faces + faces[:5] + turned(faces[7:9]))
    yield "turned faces", off(vertices, faces[:4] + turned(faces[4:9]) + faces[9:])
    yield "overlap", off(vertices + moved(vertices, 1.0), faces + both)
    yield "degenerate", off(vertices, faces + [[0, 0, 1]])
    yield "quadrangles", "OFF\n5 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 1\n4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"


def repairs(folder):
    for name, text in broken_meshes():
        mesh, out, steps = write(f"{folder}/{name}.off", text), f"{folder}/{name} repaired.off", f"{folder}/{name}.json"
        refused = run(mesh, "-o", out)
        fails(3, ["is not a valid surface", "--repair"], refused, f"{name}, not repaired unasked")
        check(refused.stderr.rstrip().split("\n")[-1].find("--repair") >= 0, f"{name}: the last line names what helps: {refused.stderr}")
        done = run(mesh, "--repair", "--repair-report", steps, "-o", out)
        check(done.returncode == 0, f"{name}: {done.stderr}")
        check(bytes_of(mesh) == text.encode(), f"{name}: the mesh that was read is as it was")
        report = json.loads(bytes_of(steps))
        check(report["repaired"] and report["steps"] and not any(report["left"].values()), f"{name}: report {report}")
        check(0 <= report["moved"] <= (2e-7 if name == "gaps" else 0), f"{name}: moved by {report['moved']}")
        again = run(out, "--repair", "-o", f"{folder}/again.off")
        check("nothing to repair" in again.stdout and surface(f"{folder}/again.off") == surface(out), f"{name}: repaired twice")


def goes_on_to_sculpt(folder):
    vertices, faces = parsed_box()
    mesh = write(f"{folder}/open.off", off(vertices, faces[2:]))
    done = run(mesh, "--repair", "--script", "-", "-o", f"{folder}/sculpted.off", script="drag @1,1,1 1.5 1.5 1.5\n")
    check(done.returncode == 0 and "reached 1" in done.stdout, f"sculpting what was repaired: {done.stdout}{done.stderr}")
    check((1.5, 1.5, 1.5) in points(f"{folder}/sculpted.off"), "where the vertex went")


def refusals(folder):
    sheet = write(f"{folder}/sheet.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    fails(3, ["cannot repair", "what is left"], run(sheet, "--repair", "--repair-report", f"{folder}/sheet.json", "-o", f"{folder}/no.off"), "a sheet")
    report = json.loads(bytes_of(f"{folder}/sheet.json"))
    check(not report["repaired"] and any(report["left"].values()), f"report of what could not be repaired: {report}")
    vertices, faces = parsed_box()
    point = write(f"{folder}/point.off", off([(1, 2, 3)] * len(vertices), faces))
    vanished = f"{folder}/vanished.json"
    fails(3, ["cannot repair", "no face is left"], run(point, "--repair", "--repair-report", vanished, "-o", f"{folder}/no.off"), "all points are one")
    check(json.loads(bytes_of(vanished))["has_vanished"], "the report says that no face is left")
    check(not os.path.exists(f"{folder}/no.off"), "nothing is written of what could not be repaired")
    mesh = write(f"{folder}/hole.off", off(vertices, faces[2:]))
    fails(3, ["boundary edge"], run(mesh, "--repair", "--repair-largest-hole", 3), "a hole too large")
    check(run(mesh, "--repair", "--repair-largest-hole", 4).returncode == 0, "a hole that may be closed")
    fails(2, ["--repair-gap"], run(mesh, "--repair", "--repair-gap", "-1"), "a gap below zero")
    fails(2, ["the mesh to be read"], run(mesh, "--repair", "--repair-report", mesh), "a report over the mesh")
    check(run(mesh, "--repair-report", f"{folder}/x.json").returncode == 2, "a report of no repair")
    # What is refused after the repair leaves the old report, too.
    kept, log = write(f"{folder}/kept.json", "kept"), f"{folder}/short.log"
    script = write(f"{folder}/u.script", "undo\n")
    fails(4, ["does more than"], run(mesh, "--repair", "--script", script, "--compare", f"{folder}/c.png",
                                     "--repair-report", kept), "a comparison with an undo")
    drag = write(f"{folder}/d.script", "drag @1,1,1 1.5 1.5 1.5\n")
    done = run(mesh, "--repair", "--script", drag, "--log", log)
    check(done.returncode == 0, f"a log of what was repaired: {done.stderr}")
    begun = bytes_of(log)
    with open(log, "wb") as file:  # killed within its head
        file.write(begun[:begun.index(b"clearance")])
    fails(6, ["a whole head"], run(mesh, "--repair", "--script", drag, "--log", log, "--response", "stop",
                               "--repair-report", kept), "a log with another response")
    check(open(kept).read() == "kept", "a report of a repair is written where the run is refused")
    # A log or script of another mesh, or a log that cannot be: nothing is written.
    kept, other = write(f"{folder}/kept.json", "kept"), f"{folder}/other.log"
    box_mesh = write(f"{folder}/whole.off", off(vertices, faces))
    run(box_mesh, "--script", "-", "--log", other, script="undo\n")
    for code, log, script in ((6, other, "undo\n"), (6, "", "mesh " + 64 * "0" + "\n"),
                              (5, f"{folder}/nowhere/x.log", "undo\n")):
        logged = ["--log", log] if log else []
        done = run(mesh, "--repair", "--repair-report", kept, "--script", "-", *logged, script=script)
        fails(code, [], done, f"a repair beside {log or script}")
        check(bytes_of(kept) == b"kept", f"the report of a repair beside {log or script}")


def faults_are_all_told(folder):
    """On the screen the first of a kind, in the report all, in the picture red."""
    vertices, faces = parsed_box()
    gone = faces[2:-9]
    uses = {}
    for f in gone:
        for i in range(3):
            uses.setdefault(tuple(sorted((f[i], f[i - 1]))), []).append(f)
    border = sorted(list(e) for e, of in uses.items() if len(of) == 1)
    mesh, out, picture = write(f"{folder}/open box.off", off(vertices, gone)), f"{folder}/faults.json", f"{folder}/faults.png"
    done = run(mesh, "--report", out, "--picture", picture)
    fails(3, [f"{len(border)} boundary edge(s)", f"(8 of {len(border)})"], done, "an open box")
    told = json.loads(bytes_of(out))
    check(told["refused"] == mesh and told["faults"]["boundary_edges"] == border, f"faults of an open box: {told}")
    check(told["number_of_faults"] == sum(map(len, told["faults"].values())), f"their number: {told}")
    if "cannot draw" in done.stderr or "OpenGL" in done.stderr:
        print("skipped: nothing can be drawn here")
    else:
        check(bytes_of(picture)[:8] == b"\x89PNG\r\n\x1a\n", f"a picture of the faults: {done.stderr}")
        try:
            from PIL import Image
        except ImportError:
            print("skipped: no PIL to look at the picture of the faults")
        else:
            red = sum(r > 150 and g < 70 and b < 80 for r, g, b in Image.open(picture).convert("RGB").getdata())
            check(red > 500, f"{red} red pixels at {len(border)} boundary edges")
            alone, picture = write(f"{folder}/stray.off", off(vertices + [(0.5, 0.5, 1.125)], faces)), f"{folder}/stray.png"
            run(alone, "--picture", picture)
            red = sum(r > 100 and g < 70 and b < 80 for r, g, b in Image.open(picture).convert("RGB").crop((0, 0, 1200, 840)).getdata())
            check(red > 20, f"{red} red pixels at a vertex without faces, beside those of the legend")
    # Sheets upon sheets: more pairs than are looked for unless a report is asked for.
    stack = [(x, y, 0.0) for i in range(60) for x, y in ((i % 7, 0), (10 + i % 5, 1), (3, 9 + i % 3))]
    mesh = write(f"{folder}/stack.off", off(stack, [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(60)]))
    fails(3, ["(8 of at least 1000)"], run(mesh, "--report", out), "a stack of triangles")
    pairs = json.loads(bytes_of(out))["faults"]["intersecting_faces"]
    check(len(pairs) == 60 * 59 // 2, f"all triangles of the plane hold (3.5, 1), {len(pairs)} pairs")
    # The same of what a repair came to.
    flaps = [(x + 0.1 * i, y, z) for i in range(90) for x, y, z in ((0, 0, i % 7), (9, 9, 3), (9, -9, 3 + i % 5))]
    mesh = write(f"{folder}/flaps.off", off(flaps, [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(90)]))
    done = run(mesh, "--repair", "--report", out, "--repair-report", f"{folder}/repair.json",
               "--repair-largest-hole", 0)
    told, repair = json.loads(bytes_of(out)), json.loads(bytes_of(f"{folder}/repair.json"))
    pairs = told["faults"]["intersecting_faces"]
    check(done.returncode == 3 and len(pairs) > 1000 and repair["left"]["intersecting_faces"] == len(pairs),
          f"all faults of what could not be repaired: {len(pairs)} pairs, {repair['left']}, {done.stderr[:300]}")


def orients(folder):
    vertices, faces = parsed_box()
    n = len(vertices)
    text = off(vertices + moved(vertices, 5.0), faces + turned([[a + n, b + n, c + n] for a, b, c in faces]))
    mesh, out = write(f"{folder}/flipped.off", text), f"{folder}/flipped out.off"
    done = run(mesh, "-o", out)
    check(done.returncode == 0 and "inside out" in done.stderr and "--orient" in done.stderr,
          f"what is remarked on: {done.stderr}")
    check(surface(out) == surface(mesh), "nothing is turned unasked")
    done = run(mesh, "--orient", "-o", out)
    check("components turned over: 1" in done.stdout and "inside out, with" not in done.stderr, f"turned: {done.stdout}{done.stderr}")
    right = write(f"{folder}/right.off", off(vertices + moved(vertices, 5.0), faces + [[a + n, b + n, c + n] for a, b, c in faces]))
    check(surface(out) == surface(right), "that component, and nothing else")
    alone = write(f"{folder}/alone.off", off(vertices + [(9, 9, 9)], faces))
    fails(3, [f"vertex(es) without faces: {n}", "--repair"], run(alone), "a vertex without faces")
    check(run(alone, "--repair", "-o", out).returncode == 0 and len(points(out)) == n, "which a repair leaves out")
    octahedron = write(f"{folder}/octahedron.off", OCTAHEDRON)
    check(run(octahedron).stderr == "", "nothing is remarked where there is nothing")
    about = write(f"{folder}/about.script", f"mesh {hashlib.sha256(bytes_of(octahedron)).hexdigest()}\n")
    check(run(octahedron, "--repair", "--script", about).returncode == 0, "what a repair leaves as it is keeps its hash")
    whole = f"{folder}/whole.off"
    fails(5, ["long.json"], run(octahedron, "--repair", "--repair-report", f"{folder}/long.json", "-o", whole, limit=300), "a full disk")
    check(points(whole) == points(octahedron), "a full disk costs the file that does not fit")


with tempfile.TemporaryDirectory() as folder:
    repairs(folder)
    goes_on_to_sculpt(folder)
    refusals(folder)
    faults_are_all_told(folder)
    orients(folder)
end()
