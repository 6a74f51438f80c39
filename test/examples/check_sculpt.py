#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `sculpt` and `sweep_queries` as a user would: results, reports, and every exit code with its message."""
import hashlib
import json
import os
import socket
import struct
import subprocess
import tempfile

from program_runs import (FURTHER as QUERIES, OCTAHEDRON, SCULPT, SOURCE, TETRAHEDRON, bytes_of, check, end, fails,
                          points, run, surface, two_octahedra, write)


def happy_path(folder, mesh):
    out, report = f"{folder}/out.off", f"{folder}/report.json"
    script = ("# comment\ndrag 3 0.2 0.2 0x1p+1  # up\ndrag 3 0.2 0.2 -1\nrelease\nprobe 0.2 0.25 5 0.2 0.25 -4\n"
              "probe 0 0 0 1 1 1\ndrag 17 0 0 0\nclearance 1e-9\ndrag 3 0.3 0.3 1\ndrag 3 0.3 0.3 -1\n")
    done = run(mesh, "--script", "/dev/stdin", "-o", out, "--report", report, script=script)
    check(done.returncode == 0, f"happy path: {done.returncode} {done.stderr}")
    told = json.load(open(report))
    check(set(told) >= {"version", "totals", "edits", "notes", "time_ns", "filter"}, "report keys")
    check(set(told["time_ns"]) >= {"p50", "p99", "p999", "max"}, "time keys")
    totals = told["totals"]
    check(totals["asked"] == totals["reached"] + totals["blocked"] + totals["refused"] == 7, f"totals {totals}")
    status = [(edit["line"], edit["op"], edit["status"]) for edit in told["edits"]]
    check(status == [(2, "drag", "reached"), (3, "drag", "blocked"), (5, "probe", "blocked"), (6, "probe", "refused"),
                     (7, "drag", "refused"), (9, "drag", "reached"), (10, "drag", "blocked")], f"statuses {status}")
    for edit in told["edits"]:
        check(set(edit) >= {"source", "line", "script_line", "op", "status", "reason", "elements", "position", "legs", "stop_error", "kkt_residual",
                            "contacts"}, f"edit keys {edit}")
    check(told["edits"][0]["position"] == [0.2, 0.2, 2.0], "hexadecimal target")
    contact = told["edits"][1]["contacts"][0]
    check(contact["kind"] == "vertex-face" and sorted(contact["ids"]) == [0, 1, 2] and contact["normal"] == [0, 0, 1],
          f"contact {contact}")
    check(0 < told["edits"][1]["position"][2] <= 8 * 2**-52, "stop above the base")
    check(1e-10 < told["edits"][6]["position"][2] <= 2e-9, "clearance directive")
    check(told["edits"][4]["elements"] == [17] and told["edits"][4]["reason"], "unknown vertex is named")
    after = points(out)
    check(after[:3] == points(mesh)[:3], "vertices that were not dragged keep their bits")
    check(list(after[3]) == told["edits"][6]["position"], "the result has the position of the report, bit for bit")


def directives_and_refusals(folder, mesh):
    report = f"{folder}/refusals.json"
    script = ("drag 99999999999999999 0 0 0\n drag 18446744073709551615 0 0 0\ndelta 0.5\ndrag 3 0.1 0.1 0.3\r\nrelease\ndelta 3\n"
              "delta 0\ndrag 3 0.1 0.1 0.3\nresponse stop\n\n# end\ndrag 4 0 0 0")
    done = run(mesh, "--script", "/dev/stdin", "--report", report, script=script)
    check(done.returncode == 0, f"refusals: {done.returncode} {done.stderr}")
    told = json.load(open(report))
    status = [(edit["line"], edit["op"], edit["status"], edit["reason"]) for edit in told["edits"]]
    check(status == [(1, "drag", "refused", "unknown-element"), (2, "drag", "refused", "unknown-element"), (4, "drag", "blocked", "held"),
                     (6, "delta", "refused", "triangle-lower-than-delta"), (8, "drag", "reached", None),
                     (12, "drag", "refused", "unknown-element")], f"refusals {status}")
    edits = told["edits"]
    shift = run(mesh, "--script", "/dev/stdin", "--report", report, script="shift 0 3\n0 0.5\n77 0.5\n99 0\nend\n")
    shifted = json.load(open(report))["edits"]
    check(shift.returncode == 0 and [(e["reason"], e["elements"]) for e in shifted] == [("unknown-element", [77, 99])],
          f"a shift names the vertices that are not there: {shifted}")
    fails(4, ["the length of edges must be more than 0"], run(mesh, "--script", "/dev/stdin", script="remesh 0\n"), "no length")
    check(edits[1]["elements"] == [2**64 - 1] and edits[1]["position"] is None and edits[1]["contacts"] == [], "unknown vertex")
    check(edits[2]["contacts"][0]["kind"] == "delta", "the delta rule blocks")
    check(edits[3]["elements"] == [0, 1, 2, 3], f"vertices of low triangles: {edits[3]}")
    check(told["totals"] == {"asked": 6, "reached": 1, "blocked": 1, "refused": 4}, f"totals {told['totals']}")
    check(0 < told["time_ns"]["p50"] <= told["time_ns"]["p99"] <= told["time_ns"]["p999"] <= told["time_ns"]["max"], "times in order")
    for words in ("unknown-element 4\n", "triangle-lower-than-delta 0 1 2 3\n"):
        check(words in done.stdout, f"the table does not say '{words}': {done.stdout}")
    empty = run(mesh, "--script", "/dev/null", "--report", report)
    told = json.load(open(report))
    check(empty.returncode == 0 and told["edits"] == [] and told["totals"]["asked"] == 0 and told["time_ns"]["max"] == 0, "empty script")
    fails(4, ["'/dev/zero'", "longer than 1024 MiB"], run(mesh, "--script", "/dev/zero"), "a script without end")
    huge = run(mesh, "--script", "/dev/stdin", "--report", report, script="drag 3 1e300 1e300 1e300\ndrag 3 -1e300 -1e300 -1.07e301\n")
    check(huge.returncode == 0 and len(json.load(open(report))["edits"]) == 2, f"huge coordinates: {huge.stderr}")


def extreme_numbers(folder, mesh):
    """What is out of range is a fault of the script, told before the first edit; what is just in range leaves a valid mesh."""
    out = f"{folder}/extreme.off"
    for line in ("drag 3 0 0 1.08e301", "probe 0 0 9 1e308 0 0", "clearance 1e302", "delta 0x1p1001", "insert_edge 0 1 -1e305 0 0"):
        done = run(mesh, "--script", "/dev/stdin", "-o", out, script=f"drag 3 0 0 2\n{line}\n")
        check(done.returncode == 4 and "line 2, column" in done.stderr and "out of range" in done.stderr and not os.path.exists(out), f"{line}: {done.stderr}")
    far = f"{folder}/far.off"
    with open(far, "w") as file:
        file.write("OFF\n4 4 0\n0 0 0\n1e302 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
    done = run(far)
    check(done.returncode == 3 and "vertex 1" in done.stderr and "out of range" in done.stderr, f"a vertex out of range: {done.stderr}")
    for option in ("--clearance", "--delta"):
        check(run(mesh, option, "1e302").returncode == 2, f"{option} out of range")
    done = run(mesh, "--script", "/dev/stdin", "-o", out, script="clearance 1\ndrag 3 0 0 2\nclearance 1e-30\n", )
    check(done.returncode == 0 and done.stdout.count("clearance-of-no-use") == 2 and "give " in done.stdout, f"clearances of no use: {done.stdout}")
    shared = os.environ.get("HAPTIC_SCULPT_SHARED")
    if not shared:
        print("skipped: hard cases are read only where HAPTIC_SCULPT_SHARED names their folder")
        return
    cases, meshes = f"{shared}/hard_cases", f"{shared}/meshes"
    for script, of in (("grid_far_target", f"{cases}/grid.off"), ("menger_far_target", f"{meshes}/gen_menger1.off"), ("tet_far_then_edit", f"{cases}/tet.off"),
                       ("grid_huge_clearance", f"{cases}/grid.off"), ("nested_huge_clearance", f"{cases}/nested.off"),
                       ("extreme_mixed", f"{meshes}/gen_extreme_exponent_tet.off"), ("extreme_delta", f"{meshes}/gen_extreme_exponent_tet.off"),
                       ("tet_small_delta", f"{cases}/tet.off"), ("menger_probe_huge_clearance", f"{meshes}/gen_menger1.off")):
        text = open(f"{cases}/{script}.script").read()
        check(run(of, "--script", "/dev/stdin", "-o", out, script=text).returncode == 4, f"{script} as it is")
        for beyond, within in (("1.7976931348623157e308", "1e301"), ("0x1.fffffffffffffp1023", "0x1p1000"), ("1e308", "1e300")):
            text = text.replace(beyond, within)
        done = run(of, "--script", "/dev/stdin", "-o", out, script=text)
        check(done.returncode == 0 and run(out).returncode == 0, f"{script} in range: {done.returncode} {done.stderr}")
    check(run(f"{cases}/grid_near_2p52.off").returncode == 0, "rays in special position")


def edges_and_strokes(folder, tetrahedron):
    """What collapse and flip make and are refused for; what one undo takes back."""
    mesh, out, report = write(f"{folder}/octahedron.off", OCTAHEDRON), f"{folder}/edges.off", f"{folder}/edges.json"

    def sculpt(script, of=mesh):
        done = run(of, "--script", "/dev/stdin", "-o", out, "--report", report, script=script)
        check(done.returncode == 0, f"{script!r}: {done.stderr}")
        return [(e["op"], e["status"], e["reason"], e["elements"]) for e in json.load(open(report))["edits"]], surface(out)

    def has_edge(faces, a, b):
        return sum(a in face and b in face for face in faces)

    whole = surface(mesh)
    told, (at, faces) = sculpt("flip 0 2\n")
    check(told == [("flip", "reached", None, [0, 2])] and at == whole[0], f"flip {told}")
    check(has_edge(faces, 0, 2) == 0 and has_edge(faces, 4, 5) == 2, f"the flipped edge {faces}")
    check(json.load(open(report))["edits"][0]["position"] is None, "a flip moves nothing")
    told, (at, faces) = sculpt("collapse 0 2\n")
    check(told == [("collapse", "reached", None, [0, 2])] and at == whole[0][1:] and len(faces) == 6, f"collapse {told}")
    check(json.load(open(report))["edits"][0]["position"] == list(whole[0][2]), "where a collapse ends")
    check(has_edge(faces, 1, 2) == 2, "the fan is that of the second vertex")  # renumbered: 2 into 1, 3 into 2
    for line, elements in (("collapse 0 1", [0, 1]), ("flip 0 1", [0, 1]), ("collapse 0 9", [0, 9]), ("flip 3 3", [3, 3])):
        told, after = sculpt(line + "\n")
        check(told == [(line.split()[0], "refused", "unknown-element", elements)] and after == whole, f"{line}: {told}")
    told, after = sculpt("collapse 0 1\nflip 0 1\nflip 3 2\n", tetrahedron)
    check([t[1:3] for t in told] == [("refused", "tetrahedron"), ("refused", "doubled-edge"), ("refused", "doubled-edge")], f"a tetrahedron {told}")
    check(after == surface(tetrahedron), "refused, and yet changed")

    edits = "drag 0 2 0 0\ndrag 0 2.5 0 0.1\nstroke\ndrag 2 0 2 0\nend\nflip 1 3\ninsert_face 0 2 4 0.9 0.8 0.4\ncollapse 6 0\n"
    for script, asked in ((f"stroke\n{edits}end\nundo\n", 7), (f"stroke\n{edits}undo\n", 7), (f"stroke\nstroke\n{edits}end\nundo\nend\n", 7)):
        told, after = sculpt(script)
        check(len(told) == asked and all(t[1] == "reached" for t in told) and after == whole, f"one undo takes back the stroke {script!r}: {told}")
    undone, redone = sculpt(f"stroke\n{edits}end\nundo\nredo\n")[1], sculpt(edits.replace("stroke\n", "").replace("end\n", ""))[1]
    check(undone == redone and redone != whole, "redo of a stroke")
    one = sculpt("drag 0 2 0 0\n")[1]
    check(sculpt("drag 0 2 0 0\nstroke\ndrag 0 3 0 0\ndrag 2 0 3 0\nend\nundo\n")[1] == one, "the step before a stroke stays")
    check(sculpt("stroke\ndrag 2 0 3 0\nundo\ndrag 0 2 0 0\ndrag 0 3 0 0\nend\nundo\n")[1] == one, "after undo within a stroke, edits are steps of their own")
    told, after = sculpt("end\nstroke\nend\nend\n")
    check(told == [("end", "refused", "no-stroke", [])] * 2 and after == whole, f"end without a stroke: {told}")
    check(sculpt("drag 0 2 0 0\nstroke\nend\nundo\n")[1] == whole, "a stroke in which nothing was done is no step")


def finding_vertices(folder, mesh):
    """--nearest, and @X,Y,Z in the place of a vertex: decided exactly, logged as a number."""
    out, log, report = f"{folder}/near.off", f"{folder}/near.log", f"{folder}/near.json"
    octahedron = write(f"{folder}/near_octahedron.off", OCTAHEDRON)
    done = run(octahedron, "--nearest", "-0.25", "0.125", "-3", "--report", report)
    check(done.returncode == 0, f"--nearest: {done.stderr}")
    told = json.load(open(report))["nearest"]
    at = points(octahedron)
    squares = lambda p: sum((a - b) ** 2 for a, b in zip(p, (-0.25, 0.125, -3)))
    check([v["vertex"] for v in told] == sorted(range(6), key=lambda v: (squares(at[v]), v)), f"the order of the nearest {told}")
    check(all(v["position"] == list(at[v["vertex"]]) and abs(v["distance"] - squares(at[v["vertex"]]) ** 0.5) < 1e-12 for v in told), f"distances {told}")
    check([line.split()[0] for line in done.stdout.splitlines() if ", distance" in line] == [str(v["vertex"]) for v in told], f"printed: {done.stdout}")
    # Of equally near ones the first; and of those whose distances are one and the same double the one that is nearer.
    run(octahedron, "--nearest", "0", "0", "0", "--report", report)
    check([v["vertex"] for v in json.load(open(report))["nearest"]] == list(range(6)), "equally near")
    # A hair above the middle of two doubles: rounded once, to 1 + 2^-52; at first to a long double, to 1.
    above = "1.00000000000000011102230246251565404236316680908203126"
    run(octahedron, "--nearest", above, "0", "0", "--report", report)
    check(json.load(open(report))["nearest"][0]["distance"] == 2**-52, "a number of the command line is rounded twice")
    least = "5e-324"
    corners = f"0 0 0\n{least} 0 0\n0 {least} 0\n0 0 {least}\n"
    tiny = write(f"{folder}/tiny.off", "OFF\n4 4 0\n" + corners + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
    done = run(tiny, "--nearest", "0", "0", least, "--report", report)
    check(done.returncode == 0, f"a mesh of the least size: {done.stderr}")
    told = json.load(open(report))["nearest"]
    check([v["distance"] for v in told[:2]] == [0, float(least)], f"the least distance: {told}")
    run(octahedron, "--nearest", "1e300", "0x1p-1070", "0", "--report", report)
    check([v["vertex"] for v in json.load(open(report))["nearest"]] == [0, 2, 4, 5, 3, 1], "nearest to a point far away, where distances are all one double")
    done = run(octahedron, "--script", "-", "--log", log, "-o", out, "--report", report,
               script="drag @0.9,-0.1,0.1 0.5 0.25 0.125\ninsert_face @2,0,0 @0,0x2p0,0 @0,0,2 0.5 0.5 0.5\nremove @0.5,0.5,0.5\n")
    check(done.returncode == 0, f"@X,Y,Z: {done.stderr}")
    check([(e["op"], e["status"]) for e in json.load(open(report))["edits"]] == [("drag", "reached"), ("insert_face", "reached"), ("remove", "reached")], "@X,Y,Z")
    lines = [line.split("#")[0].split() for line in open(log)]
    check([line[:4] for line in lines if line[:1] in (["drag"], ["insert_face"], ["remove"])]
          == [["drag", "0", "0x1p-1", "0x1p-2"], ["insert_face", "0", "2", "4"], ["remove", "6"]], f"logged by number {lines}")
    check(run(octahedron, "--log", log, "-o", f"{folder}/near_again.off").returncode == 0 and surface(f"{folder}/near_again.off") == surface(out), "replay")
    for script in ("shift 2 2\n@0,0,2 1.5\n@0.9,0,0 0.25\nend\n", "shift 2 2\n4 1.5\n0 0.25\nend\n"):
        done = run(octahedron, "--script", "-", "-o", out, script=script)
        check(done.returncode == 0 and points(out)[:5:4] == [(1, 0, 0.25), (0, 0, 1.5)], f"{script!r}: {done.stderr}")
    fails(2, ["--nearest"], run(octahedron, "--nearest", "1", "2"), "--nearest of two numbers")
    fails(2, ["--nearest"], run(octahedron, "--nearest", "1", "2", "1e302"), "--nearest out of range")
    for script, column, part in (("drag @1,2 0 0 0", 6, "@X,Y,Z"), ("drag @1,2,3,4 0 0 0", 6, "@X,Y,Z"), ("drag @1,,3 0 0 0", 6, "number"), ("drag @ 0 0 0", 6, "@X,Y,Z"),
                                 ("remove @1,2,nan", 8, "finite"), ("remove @1,2,1e302", 8, "range"), ("drag @1, 2,3 0 0 0", 6, "@X,Y,Z")):
        fails(4, [f"column {column}", part], run(mesh, "--script", "-", script=script), script)


def objects(folder):
    """An object that goes as far as another lets it: places by arithmetic of our own, one step of undo, logged, refused by name."""
    two, out, report, log = (f"{folder}/{name}" for name in ("two.off", "two_moved.off", "two.json", "two.log"))
    two_octahedra(two)

    def sculpt(script, *more):
        done = run(two, "--script", "-", "-o", out, "--report", report, *more, script=script)
        check(done.returncode == 0, f"{script!r}: {done.returncode} {done.stderr}")
        return [(e["op"], e["status"], e["reason"], e["elements"], e["many"]) for e in json.load(open(report))["edits"]], surface(out)

    whole = surface(two)
    told, (after, _) = sculpt("move 3 0.5 0.25 -1\n")
    check(told == [("move", "reached", None, [], {"asked": 6, "done": 6})], f"a free way: {told}")
    check(after == [(x + 0.5, y + 0.25, z - 1) for x, y, z in whole[0][:6]] + whole[0][6:], f"moved: {after}")
    script = "move @1,0,0 16 0 0\n"
    told, (after, _) = sculpt(script, "--log", log)
    share = 127 / 1024  # the last step before the points touch, at an eighth
    check(told[0][:3] == ("move", "blocked", "in-part") and set(told[0][3]) >= {0, 7}, f"blocked by the other: {told}")
    check(after == [(x + 16 * share, y, z) for x, y, z in whole[0][:6]] + whole[0][6:], f"as far as it may: {after}")
    check(run(two, "--log", log, "-o", out).returncode == 0 and surface(out)[0] == after, "replayed from the log")
    told, after = sculpt("move 3 0.5 0.25 -1\nmove 9 0 0 1\nundo\nundo\n")
    check(after == whole, "a step of undo each")
    told, after = sculpt("move 12 1 0 0\nmove 0 1e301 1e301 1e301\nmove 0 1e301 0 0\nmove 0 1e301 0 0\n")
    check([t[1:3] for t in told[:1]] == [("refused", "unknown-element")], f"refused: {told}")
    fails(4, ["column 9", "coordinate"], run(two, "--script", "-", script="move 0 1"), "move without a vector")
    picture = f"{folder}/moved.png"
    done = run(two, "--script", "-", "--compare", picture, script="move 0 3 0 0\n")
    check(done.returncode == 0 and os.path.getsize(picture) > 5000, f"--compare of a move: {done.stderr}")


def brushes_and_remeshing(folder, mesh):
    """The lines that move many vertices: where they end by arithmetic of our own, one step of undo each, logged, refused by name."""
    octahedron, out, report, log = write(f"{folder}/brush.off", OCTAHEDRON), f"{folder}/brushed.off", f"{folder}/brushed.json", f"{folder}/brush.log"

    def sculpt(script, *more):
        done = run(octahedron, "--script", "-", "-o", out, "--report", report, *more, script=script)
        check(done.returncode == 0, f"{script!r}: {done.returncode} {done.stderr}")
        return [(e["op"], e["status"], e["reason"], e["many"]) for e in json.load(open(report))["edits"]], surface(out)

    whole, (at, _) = surface(octahedron), surface(octahedron)
    top = max(range(6), key=lambda v: at[v][2])
    told, (after, _) = sculpt("brush grab 0 0 1 1 0.25 0 0 7\n")
    check(told == [("brush", "reached", None, {"asked": 1, "done": 1})], f"a dab: {told}")
    check(after[top] == (0, 0, 1.25) and [p for v, p in enumerate(after) if v != top] == [p for v, p in enumerate(at) if v != top], f"grab: {after}")
    told, (after, _) = sculpt("brush inflate 0 0 0 2 0.5\n")  # each at distance 1 of radius 2: weight (1 - 1/4)^2
    check(all(abs(abs(sum(p)) - (1 + 0.5 * 0.5625)) < 1e-12 for p in after) and told[0][3] == {"asked": 6, "done": 6}, f"inflate: {after}")
    told, (after, _) = sculpt("brush smooth 0 0 1 1 0.5\n")  # the mean of the neighbours is the origin
    check(abs(after[top][2] - 0.5) < 1e-12, f"smooth: {after}")
    told, (after, _) = sculpt("brush pinch 0.5 0 1 1 1 0 0 1\n")
    check(abs(after[top][0] - 0.5 * 0.75 ** 2) < 1e-12 and after[top][2] == 1, f"pinch: {after}")
    told, (after, _) = sculpt("brush flatten 0 0 1 1 1\nbrush grab 0 0 1 1 -3 0 0 1\n")
    check(-1 < after[top][2] < -0.99 and told[1][1:3] == ("blocked", "in-part") and told[1][3] == {"asked": 1, "done": 0}, f"through the bottom: {told} {after}")
    told, (after, faces) = sculpt("remesh 0.3\n")
    check(told[0][:3] == ("remesh", "reached", None) and len(after) > 40 and all(abs(abs(x) + abs(y) + abs(z) - 1) < 1e-9 for x, y, z in after),
          f"remeshed, but not on the octahedron: {told} {len(after)}")
    check(sculpt("brush inflate 0 0 0 2 0.5\nremesh 0.3\nundo\nundo\n")[1] == whole, "a step of undo each")
    script = "stroke\nbrush grab 1 0 0 0.9 0.1\nremesh 0.4\nbrush smooth 0 0 1 2 0.3\nend\ndrag 2 0 3 0\n"
    told, sculpted = sculpt(script, "--log", log)
    check(run(octahedron, "--log", log, "-o", out).returncode == 0 and surface(out) == sculpted and len(sculpted[0]) > 20, "replayed from the log")
    check(sculpt(script)[1] == sculpted, "the same twice")
    told, after = sculpt("brush grab 0 0 1 1 3 0 0 1\nbrush smooth 0 0 4 1 1e301\nundo\nbrush grab 9 9 9 1 1\nremesh 1e-5\nbrush inflate 0 0 0 1e-300 1\n")
    check([t[1:3] for t in told[3:]] == [("refused", r) for r in ("nothing-in-reach", "too-many-triangles", "nothing-in-reach")], f"refused: {told}")
    check(told[1][1:3] == ("refused", "out-of-range") and after == whole, f"a target out of range: {told}")
    for line, column, part in (("brush push 0 0 0 1 1", 7, "flatten"), ("brush grab 0 0 0 0 1", 18, "radius"), ("brush grab 0 0 0 1 1 0 0", 25, "direction"),
                               ("brush grab 0 0 0 1 1 0 0 0", 26, "mean normal"), ("brush", 6, "grab"), ("remesh 0", 8, "more than 0"), ("remesh", 7, "length"),
                               ("brush grab 0 0 0 1 1 0 0 1 4", 28, "more than")):
        fails(4, [f"column {column}", part], run(mesh, "--script", "-", script=line), line)
    picture = f"{folder}/compared.png"
    done = run(octahedron, "--script", "-", "--compare", picture, script="drag 4 0 0 -2\nbrush grab 1 0 0 1 0.1\n")
    check(done.returncode == 0 and os.path.getsize(picture) > 5000, f"--compare: {done.stderr}")
    fails(4, ["line 1", "remove"], run(octahedron, "--script", "-", "--compare", picture, script="remove 0\n"), "--compare of what changes connectivity")
    check(run(octahedron, "--compare", picture).returncode == 2, "--compare without a script")


def what_people_read(folder, mesh):
    """The table, the messages, and what is lost on the way from one file to the other."""
    out, report = f"{folder}/read.off", f"{folder}/read.json"
    done = run(mesh, "--script", "-", "--report", report, script="drag 3 0.2 0.2 0\ndrag 3 0.2 0.2 -1\ndrag 9 0 0 0\n")
    told = json.load(open(report))
    check([e["within_clearance"] for e in told["edits"]] == [True, False, False] and told["totals"]["blocked"] == 2, f"within a clearance: {told['edits']}")
    check("arrived within a clearance" in done.stdout.splitlines()[4] and "of those blocked 1 arrived" in done.stdout, f"the table: {done.stdout}")
    check("e-1" not in done.stdout.splitlines()[4], f"a way to go that nobody can go: {done.stdout}")
    # A vertex that comes to another meets all that is there at once.
    done = run(write(f"{folder}/o.off", OCTAHEDRON), "--script", "-", "--report", report, script="response stop\ndrag 4 0 0 -2\n")
    contacts = len(json.load(open(report))["edits"][0]["contacts"])
    check(contacts > 9 and f" and {contacts - 8} more" in done.stdout and done.stdout.count("vertex-") + done.stdout.count("edge-") <= 9,
          f"{contacts} contacts in a line: {done.stdout}")
    done = run("--version")
    check(done.returncode == 0 and "0." in done.stdout, f"--version: {done.stdout}")
    fails(2, [".png", "picture.jpg"], run(mesh, "--picture", f"{folder}/picture.jpg"), "a picture that is no PNG")
    check(not os.path.exists(f"{folder}/picture.jpg"), "a picture under a wrong name")
    done = run(mesh, "--script", "-", "--picture", f"{folder}/picture.png", "--picture-numbers", script="drag 3 0.2 0.2 -1\n")
    check(done.returncode == 0 and os.path.getsize(f"{folder}/picture.png") > 5000, f"--picture-numbers: {done.stderr}")
    check(run(mesh, "--picture-numbers").returncode == 2, "--picture-numbers without a picture")
    looks = set()
    for options in ([], ["--picture-view", "1", "0", "0"], ["--picture-at", "3", "--picture-zoom", "2"], ["--picture-at", "@0,0,-1", "--picture-zoom", "3"],
                    ["--picture-at", "edit"], ["--picture-before"], ["--picture-color", "displacement"], ["--picture-color", "altitude"]):
        done = run(mesh, "--script", "-", "--picture", f"{folder}/picture.png", *options, script="drag 3 0.2 0.2 -1\n")
        check(done.returncode == 0, f"{options}: {done.stderr}")
        picture = bytes_of(f"{folder}/picture.png")
        looks.add(picture)
        check(int.from_bytes(picture[16:20], "big") == (2400 if "--picture-before" in options else 1200), f"the width with {options}")
    check(len(looks) == 8, "each of the picture's options shows something else")
    for options in (["--picture-at", "here"], ["--picture-at", "@1,2"], ["--picture-zoom", "0"], ["--picture-color", "green"], ["--picture-view", "0", "0", "0"]):
        check(run(mesh, "--picture", f"{folder}/never.png", *options).returncode == 2, f"{options}")
    fails(5, ["no vertex 99"], run(mesh, "--picture", f"{folder}/never.png", "--picture-at", "99"), "a picture at a vertex that is not there")
    # A byte order mark.
    bom = "\ufeff"
    for name, text in (("b.off", TETRAHEDRON), ("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.1 0.1 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")):
        check(run(write(f"{folder}/{name}", bom + text), "-o", out).returncode == 0 and surface(out) == surface(mesh), f"a byte order mark in {name}")
    for name in ("m.ply", "m.stl"):
        run(mesh, "-o", f"{folder}/{name}")
        with open(f"{folder}/{name}", "rb") as file:
            text = file.read()
        check(run(write(f"{folder}/bom_{name}", b"\xef\xbb\xbf" + text), "-o", out).returncode == 0 and len(points(out)) == 4, f"a byte order mark in {name}")
    check(run(mesh, "--script", "-", script=bom + "drag 3 0 0 2\n").returncode == 0, "a byte order mark in a script")
    # Of standard input what is left of it, from a file and from a socket.
    lines = b"drag 3 0 0 2\ndrag 3 0 0 3\n"
    with open(write(f"{folder}/two.script", lines), "rb", buffering=0) as file:
        file.read(13)
        subprocess.run([SCULPT, mesh, "--script", "-", "-o", out, "--report", report], stdin=file, capture_output=True)
    edits = json.load(open(report))["edits"]
    is_rest = len(edits) == 1 and points(out)[3] == (0, 0, 3)
    check(is_rest, f"a line that was read before is none of the script: {edits}")
    here, there = socket.socketpair()
    with here, there:
        here.sendall(lines)
        here.shutdown(socket.SHUT_WR)
        done = subprocess.run([SCULPT, mesh, "--script", "-", "--report", report], stdin=there, capture_output=True,
                              text=True)
    edits = json.load(open(report))["edits"]
    check(done.returncode == 0 and len(edits) == 2, f"a script from a socket: {done.stderr}")
    # What is lost.
    for name, text, parts in (
            ("c.off", TETRAHEDRON.replace("OFF", "COFF").replace("0 0 0\n", "0 0 0 255 0 0\n", 1), ["colours"]),
            ("d.off", TETRAHEDRON.replace("3 0 2 1", "3 0 2 1 255 0 0"), ["colours"]),
            ("n.off", TETRAHEDRON.replace("OFF", "STNOFF").replace("0 0 0\n", "0 0 0 0 0 1 0.5 0.5\n", 1), ["normals", "texture coordinates"]),
            ("e.obj", "mtllib x.mtl\no thing\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nv 0.1 0.1 1\nvn 0 0 1\nvt 0 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
             ["materials", "groups", "colours", "normals", "texture coordinates"]),
            ("f.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty uchar red\n"
             "property float heat\nelement face 4\nproperty list uchar int vertex_indices\nproperty float s\nelement edge 1\nproperty int a\nend_header\n"
             "0 0 0 1 255 7\n1 0 0 1 2 3\n0 1 0 1 2 3\n0.1 0.1 1 1 2 3\n3 0 2 1 0\n3 0 1 3 0\n3 1 2 3 0\n3 2 0 3 0\n5\n",
             ["normals", "colours", "texture coordinates", "the property 'heat'", "the element 'edge'"])):
        path = write(f"{folder}/{name}", text)
        done = run(path, "-o", out, "--report", report)
        notes = json.load(open(report))["notes"]
        check(done.returncode == 0 and all(part in done.stderr and part in " ".join(notes) for part in parts), f"what {name} loses is not said: {done.stderr}")
        check(done.stderr.count("besides") == 1 and run(path).stderr == "", f"said too often, or where nothing is written: {done.stderr}")
    short = write(f"{folder}/short.off", TETRAHEDRON.replace("OFF", "CNOFF"))
    check(run(mesh, "-o", out).stderr == run(short, "-o", out).stderr == "", "something is said of nothing")
    # Colours and other numbers of vertices go with them, to PLY all, to OBJ colours; a new vertex has the mean.
    coloured = f"{folder}/f.ply"
    for name, script in (("g.ply", "insert_edge 0 1 0.5 0 0\n"), ("h.obj", "insert_edge 0 1 0.5 0 0\n")):
        done = run(coloured, "-o", f"{folder}/{name}", "--script", "-", script=script)
        check(done.returncode == 0 and "colours" not in done.stderr or name == "h.obj", f"{name}: {done.stderr}")
    text = open(f"{folder}/g.ply", "rb").read()
    head, body = text.split(b"end_header\n", 1)
    check(b"property uchar red\nproperty float heat\n" in head, f"attributes in the head: {head}")
    rows = [struct.unpack("<dddBf", body[29 * i:29 * i + 29])[3:] for i in range(5)]
    check(rows == [(255, 7), (2, 3), (2, 3), (2, 3), (128, 5)], f"attributes of vertices: {rows}")
    # Advice without functions of a library.
    for name in ("degenerate", "boundary", "crossing", "polygon"):
        text = {"degenerate": TETRAHEDRON.replace("0.1 0.1 1", "0.5 0 0"), "boundary": TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 2 0 3\n", ""),
                "crossing": "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n.1 .1 .1\n2 .1 .1\n.1 2 .1\n.1 .1 2\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
                            "3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n", "polygon": CUBE}[name]
        done = run(write(f"{folder}/{name}.off", text))
        check(done.returncode == 3 and "PMP" not in done.stderr and "CGAL" not in done.stderr, f"advice for {name}: {done.stderr}")
        check(("--triangulate" in done.stderr) == (name == "polygon"), f"--triangulate where it serves: {done.stderr}")


CUBE = ("OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
        "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n")


def polygons(folder, mesh):
    """--triangulate: the same points, each polygon in its corners, the script goes on; what cannot be is refused."""
    out, cube = f"{folder}/triangles.off", write(f"{folder}/cube.off", CUBE)
    done = run(cube, "--triangulate", "--script", "-", "-o", out, script="insert_edge 0 1 0.5 -0.5 -0.5\n")
    check(done.returncode == 0, f"--triangulate: {done.stderr}")
    check(run(cube, "--triangulate", "-o", out).returncode == 0, "--triangulate")
    at, faces = surface(out)
    check(at == points(cube) and len(faces) == 12, "points and number of triangles of the cube")
    quads = [set(map(int, line.split()[1:])) for line in CUBE.splitlines()[10:]]
    check(sorted(sum(set(face) <= quad for face in faces) for quad in quads) == [2] * 6, f"triangles of each quadrilateral {faces}")
    check(run(out).returncode == 0, "the triangulated cube is a valid surface")
    check(run(mesh, "--triangulate", "-o", out).returncode == 0 and surface(out) == surface(mesh), "what are triangles stays as it is")
    # A reflex pentagon as the bottom and top of a prism, whose triangles cannot be a fan.
    corners = [(0, 0), (4, 0), (4, 4), (2, 1), (0, 4)]
    prism = "OFF\n10 7 0\n" + "".join(f"{x} {y} {z}\n" for z in (0, 1) for x, y in corners) + "5 4 3 2 1 0\n5 5 6 7 8 9\n" + "".join(
        f"4 {i} {(i + 1) % 5} {(i + 1) % 5 + 5} {i + 5}\n" for i in range(5))
    check(run(write(f"{folder}/prism.off", prism), "--triangulate", "-o", out).returncode == 0 and len(surface(out)[1]) == 16, "a reflex polygon")
    fails(3, ["boundary"], run(write(f"{folder}/open.off", CUBE.replace("8 6 0", "8 5 0").replace("4 3 0 4 7\n", "")), "--triangulate"), "an open cube")
    fails(3, ["not triangles"], run(write(f"{folder}/twice.off", CUBE.replace("4 3 0 4 7", "5 3 0 4 4 7")), "--triangulate"), "a corner twice")
    log = f"{folder}/cube.log"
    check(run(cube, "--triangulate", "--log", log, "--script", "-", script="drag 6 2 2 2\n").returncode == 0, "a log of a cube")
    check(run(cube, "--triangulate", "--log", log, "-o", out).returncode == 0 and points(out)[6] == (2, 2, 2), "and its replay")


def demo(folder):
    """The demo shows what its comments say: every kind of contact, a drag that arrives, a refused edit."""
    report = f"{folder}/demo.json"
    data = f"{SOURCE}/examples/data"
    done = run(f"{data}/ball_and_moon.off", "--script", f"{data}/demo.script", "--report", report, "-o", f"{folder}/demo.off")
    told = json.load(open(report))
    kinds = {contact["kind"] for edit in told["edits"] for contact in edit["contacts"]}
    check(kinds == {"vertex-face", "edge-edge", "face-vertex"}, f"kinds of contact in the demo: {kinds}")
    check(min(told["totals"].values()) > 0, f"totals of the demo: {told['totals']}")
    before, after = points(f"{data}/ball_and_moon.off"), points(f"{folder}/demo.off")
    dragged = {edit["elements"][0]: tuple(edit["position"]) for edit in told["edits"] if edit["op"] == "drag" and edit["position"]}
    check(len(dragged) == 8, f"dragged vertices {dragged}")
    check(after == [dragged.get(v, p) for v, p in enumerate(before)], "bits of the demo's result")
    check(run(f"{folder}/demo.off").returncode == 0, "the demo's result is a valid mesh")
    try:
        from PIL import Image, ImageChops
    except ImportError:
        print("skipped: no PIL to look at the demo's picture")
        return
    run(f"{data}/ball_and_moon.off", "--script", f"{data}/demo.script", "--picture", f"{folder}/demo.png")
    shown, made = (Image.open(path).convert("L") for path in (f"{SOURCE}/doc/pictures/demo.png", f"{folder}/demo.png"))
    check(shown.size == made.size, "size of the picture in doc")
    different = sum(ImageChops.difference(shown, made).histogram()[32:]) / (shown.size[0] * shown.size[1])
    check(different < 0.01, f"{100 * different:.1f} % of the picture in doc are not what the demo makes")


def formats(folder, mesh):
    for name in ("a.ply", "b.obj", "c.stl", "d.off"):
        done = run(mesh, "--script", "/dev/stdin", "-o", f"{folder}/{name}", script="drag 3 0.25 0.3 0.7000000000000001\n")
        check(done.returncode == 0, f"{name}: {done.stderr}")
        again = run(f"{folder}/{name}", "-o", f"{folder}/again.off")
        check(again.returncode == 0, f"{name} read back: {again.stderr}")
        check(any(p == (0.25, 0.3, 0.7000000000000001) for p in points(f"{folder}/again.off")), f"{name} keeps every bit")


def broad_phases_agree(folder):
    data = f"{SOURCE}/examples/data"
    results = []
    for broad_phase in ("tree", "six-lists", "brute"):
        out = f"{folder}/{broad_phase}.off"
        done = run(f"{data}/ball_and_moon.off", "--script", f"{data}/demo.script", "-o", out, "--broad-phase", broad_phase)
        check(done.returncode == 0, done.stderr)
        results.append(open(out, "rb").read())
    check(results[0] == results[1] == results[2], "broad phases differ")


def bad_usage(folder, mesh):
    fails(2, [], run(), "no arguments")
    fails(2, ["--nonsense"], run(mesh, "--nonsense"), "unknown option")
    fails(2, ["clearance"], run(mesh, "--clearance", "-1"), "negative clearance")
    for option, value in (("--clearance", "nan"), ("--clearance", "inf"), ("--clearance", "0"), ("--delta", "nan"), ("--delta", "-1")):
        fails(2, [option], run(mesh, option, value), f"{option} {value}")
    check(run(mesh, "--clearance", "0x1p-20").returncode == 0, "hexadecimal option")
    fails(2, ["empty"], run(mesh, "-o", ""), "empty name")
    before = open(mesh).read()
    fails(2, ["mesh"], run(mesh, "--report", mesh), "the report in place of the mesh")
    check(open(mesh).read() == before, "the mesh is spoilt")
    fails(2, ["one file"], run(mesh, "--report", "same", "--picture", "./same", folder=folder), "two outputs in one file")
    fails(2, ["bounce"], run(mesh, "--response", "bounce"), "response that is not there")
    fails(2, [".xyz"], run(mesh, "-o", f"{folder}/out.xyz"), "unknown format of the result")
    check(run("--help").returncode == 0, "--help")


def bad_meshes(folder):
    def refused(name, text, *parts):
        path = f"{folder}/{name}"
        with open(path, "w") as file:
            file.write(text)
        out = f"{folder}/must_not_be.off"
        fails(3, parts, run(path, "-o", out), name)
        check(not os.path.exists(out), f"{name}: something was written")

    fails(3, ["missing.off"], run(f"{folder}/missing.off"), "missing file")
    os.mkdir(f"{folder}/folder.off")
    fails(3, ["folder.off"], run(f"{folder}/folder.off"), "a folder")
    refused("empty.off", "")
    refused("cut.off", TETRAHEDRON[:60])
    refused("nan.off", TETRAHEDRON.replace("0.1 0.1 1", "0.1 nan 1"), "3")
    refused("infinite.off", TETRAHEDRON.replace("0.1 0.1 1", "0.1 inf 1"), "3")
    refused("huge.off", TETRAHEDRON.replace("4 4 0", "400000000000 4 0"))
    refused("boundary.off", TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 2 0 3\n", ""), "boundary")
    refused("polygon.off", "OFF\n5 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n",
            "triangle")
    refused("flat.off", TETRAHEDRON.replace("0.1 0.1 1", "0.5 0 0"), "degenerate")
    refused("duplicate.off", TETRAHEDRON.replace("0.1 0.1 1", "0 0 0"))
    two = ("OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n.1 .1 .1\n2 .1 .1\n.1 2 .1\n.1 .1 2\n"
           "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n")
    refused("crossing.off", two, "intersecting")
    pinched = two.replace("8 8 0", "7 8 0").replace(".1 .1 .1\n2 .1 .1\n.1 2 .1\n.1 .1 2\n", "-1 0 0\n0 -1 0\n0 0 -1\n").replace(
        "3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n", "3 0 4 5\n3 0 6 4\n3 4 6 5\n3 5 6 0\n")
    refused("pinched.off", pinched, "non-manifold vertex")
    doubled = "OFF\n5 6 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 1 0 4\n3 0 1 2\n3 2 1 4\n"
    refused("doubled.off", doubled, "edge")


def bad_scripts(folder, mesh):
    def refused(script, line, column, *parts):
        out = f"{folder}/must_not_be.off"
        done = run(mesh, "--script", "/dev/stdin", "-o", out, script=script)
        fails(4, [f"line {line}", f"column {column}", *parts], done, repr(script))
        check(not os.path.exists(out), f"{script!r}: something was written")

    refused("drag 3 0 0\n", 1, 11)
    refused("drag 3 0 0 2\ndrag 3 0 x 2\n", 2, 10, "'x'")
    refused("drag 3 0 0 nan\n", 1, 12, "finite")
    refused("drag 3 0 0 1e999\n", 1, 12, "finite")
    refused("drag -3 0 0 1\n", 1, 6, "-3")
    refused("  drug 3 0 0 1\n", 1, 3, "drug")
    refused("release 3\n", 1, 9)
    refused("clearance 0\n", 1, 11)
    refused("clearance standard\n", 1, 11, "default")
    refused("delta default\n", 1, 7)
    refused("drag 3 0 0 \x1b[31m\n", 1, 12, "\\x1b[31m")
    refused("delta -1\n", 1, 7)
    refused("response bounce\n", 1, 10, "bounce")
    refused("mesh 12\n", 1, 6)
    refused("drag 3 0 0 0x1p\n", 1, 12)
    refused("drag 99999999999999999999999 0 0 1\n", 1, 6)
    refused("drag 3 0 0 1 # ok\n\tprobe 0 0 0 1 1 -inf\n", 2, 18, "finite")
    refused("remove\n", 1, 7, "vertex index")
    refused("collapse 1\n", 1, 11, "vertex index")
    refused("flip 1 2 3\n", 1, 10, "flip")
    refused("stroke 1\n", 1, 8)
    refused("end stroke\n", 1, 5)
    refused("drag 3 0 0 2\r\nundo 1\n", 2, 6)
    fails(4, ["failed"], run(mesh, "--script", folder), "a folder as script")
    fails(4, ["missing.script"], run(mesh, "--script", f"{folder}/missing.script"), "missing script")
    digest = hashlib.sha256(open(mesh, "rb").read()).hexdigest()
    check(run(mesh, "--script", "/dev/stdin", script=f"mesh {digest.upper()}\n").returncode == 0, "own hash")
    fails(6, [digest], run(mesh, "--script", "/dev/stdin", script=f"mesh {'0' * 64}\n"), "foreign hash")


def queries(folder):
    vertex_face = "VF 0.25 0.25 1 0.25 0.25 -1 0 0 0 1 0 0 0 1 0\n"
    path = f"{folder}/queries.txt"

    def ask(text):
        with open(path, "w") as file:
            file.write(text)
        return run(path, program=QUERIES)

    check(ask(vertex_face + vertex_face.replace("-1", "0x1p-1")).stdout == "1 1/2\n0\n", "sweep_queries answers")
    check(ask("EE 0 0 1 0 0 2 0 0 0 -1 0 0 1 0 0\n").stdout == "1 0/1\n", "meeting without the moving end")
    check(ask("VF 0 0 0 0 0 0 0 0 0 1 0 0 0 1 0\n").stdout == "1 0/1\n", "standing still in contact")
    check(ask("VF 0 0 1 0 0 0 0 0 0 1 0 0 0 1 0\n").stdout == "1 1/1\n", "contact at the end")
    axis_move = "AX VF 2 1 1 1 0 0 0 4 0 0 0 4 0 0 0 0 0\n"
    crossing = "AX EE 0 1 -1 0 1 1 0 0 0 -1 0 0 1 -0x1p-3 2 0 0\n"
    check(ask(axis_move + axis_move.replace("0 0 0 0\n", "0x1p-1074 0 0 0\n") + crossing).stdout == "1\n0\n0\n", "axis moves")
    fails(2, ["line 1", "column 7"], ask(axis_move.replace("VF 2", "VF 3")), "no such axis")
    fails(2, ["line 1", "column 4"], ask(axis_move.replace("VF", "FV")), "no such question about an axis move")
    fails(2, ["line 1", "16 coordinates"], ask(axis_move.replace("\n", " 1\n")), "a long line")
    fails(2, ["line 2", "column 1"], ask(vertex_face + "VX 1\n"), "unknown kind")
    fails(2, ["line 1", "column 6"], ask(vertex_face.replace("0.25 0.25 1", "0.25x 0.25 1").replace("VF 0.25x", "VF 0 zz")), "bad number")
    fails(2, ["line 1", "finite"], ask(vertex_face.replace("-1", "inf")), "infinite coordinate")
    fails(2, ["line 1", "column 4", r"'\x1b[31m'"], ask("VF \x1b[31m\n"), "a word that a terminal would obey")
    check(len(ask("VF " + "x" * 60000).stderr) < 200, "a long word is not quoted whole")
    fails(2, ["line 2", "longer than 65536 bytes"], ask(vertex_face + "\0" * 100000), "a line that does not end")
    last = vertex_face.strip()
    check(ask(vertex_face + "# " + "x" * 60000 + "\n\n" + last).stdout == "1 1/2\n" * 2, "the last line without an end")
    fails(2, ["line 1"], ask("VF 1 2 3\n"), "short line")
    fails(2, ["none.txt"], run(f"{folder}/none.txt", program=QUERIES), "missing queries")
    for path in (folder, "/dev/null"):
        opened = os.open(path, os.O_RDONLY)
        done = subprocess.run([QUERIES, "-"], stdin=opened, capture_output=True, text=True)
        os.close(opened)
        code = done.returncode
        check(code == (2 if path == folder else 0), f"queries on standard input from {path}: exit {code}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        mesh = f"{folder}/tetrahedron.off"
        with open(mesh, "w") as file:
            file.write(TETRAHEDRON)
        happy_path(folder, mesh)
        directives_and_refusals(folder, mesh)
        extreme_numbers(folder, mesh)
        edges_and_strokes(folder, mesh)
        finding_vertices(folder, mesh)
        objects(folder)
        brushes_and_remeshing(folder, mesh)
        what_people_read(folder, mesh)
        polygons(folder, mesh)
        demo(folder)
        formats(folder, mesh)
        broad_phases_agree(folder)
        bad_usage(folder, mesh)
        bad_meshes(folder)
        bad_scripts(folder, mesh)
        queries(folder)
    end()


main()
