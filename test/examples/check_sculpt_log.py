#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The edit log of `sculpt`: resumed, refused, spoilt, locked, on a full disk, and in the format of earlier versions."""
import fcntl
import hashlib
import json
import os
import random
import re
import subprocess
import tempfile
import time

from program_runs import (LINES_OF_HEAD, OCTAHEDRON, SCULPT, SOURCE, TETRAHEDRON, before_open_stroke, bytes_of, check,
                          end, fails, points, run, sha256, surface, two_octahedra, write)

EDITS = ("insert_face 0 1 2 0.2 0.2 0\ndrag 4 0.2 0.2 -0.5\ninsert_edge 1 2 0.55 0.55 0\nundo\nundo\nredo\nremove 4\n"
         "remove 4\nundo\ndrag 4 0.3 0.2 -0.25\nremove 0\nredo\n")

CUBE_OF_SQUARES = ("OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                   "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n")


def words(line):
    """What a line of a log says, without comments."""
    return line.split(b"#")[0].split()


def checked(*lines):
    """Lines of a log, with their checksums."""
    text, before = "", hashlib.sha256().hexdigest()
    for line in lines:
        before = hashlib.sha256((before + line).encode()).hexdigest()[:16]
        text += f"{line} # {before}\n"
    return text.encode()


def edits_and_log(folder, mesh):
    log, report, script = f"{folder}/edits.log", f"{folder}/edits.json", write(f"{folder}/edits.script", EDITS)
    whole, again = f"{folder}/whole.off", f"{folder}/again.off"
    done = run(mesh, "-o", whole, "--log", log, "--report", report, "--script", script)
    check(done.returncode == 0, f"edits: {done.stderr}")
    edits = json.load(open(report))["edits"]
    told = [(e["op"], e["status"], e["reason"], e["elements"]) for e in edits]
    check(told[0] == ("insert_face", "reached", None, [4]) and told[2] == ("insert_edge", "reached", None, [5]), f"names {told}")
    check(told[7] == ("remove", "refused", "unknown-element", [4]), f"a dead vertex {told[7]}")
    check(told[11][1:3] == ("refused", "nothing-to-redo"), f"nothing to redo {told[11]}")
    check(len(points(whole)) == 4, "one vertex came and one went")
    check([(e["source"], e["line"], e["script_line"]) for e in edits] == [("script", i, i) for i in range(1, 13)], "sources")
    expected = bytes_of(whole)
    check(run(mesh, "-o", again, "--log", log, "--report", report).returncode == 0, "replay")
    check(bytes_of(again) == expected, "replay is exact to the bit")
    edits = json.load(open(report))["edits"]
    check([(e["source"], e["line"], e["script_line"]) for e in edits] == [("log", i + LINES_OF_HEAD + 1, i) for i in range(1, 13)], "sources of a replay")
    check(run(mesh, "--script", log, "-o", again).returncode == 0, "a log is a script")
    check(bytes_of(again) == expected, "a log as a script gives the same")
    # Cut anywhere behind its head, the log gives the state after the whole lines that are left, and the script goes on from there.
    complete = bytes_of(log)
    lines = complete.splitlines(keepends=True)
    head = sum(map(len, lines[:LINES_OF_HEAD]))
    check(b"".join(lines[:LINES_OF_HEAD]).startswith(b"# haptic_sculpt log 1 # ") and words(lines[1]) == [b"mesh", sha256(mesh).encode()], "head")
    check([words(line) for line in lines[2:LINES_OF_HEAD]] == [[b"response", b"slide"], [b"clearance", b"default"], [b"delta", b"0x0p+0"]], "settings")
    for length in sorted({*range(head, head + 120, 3), *range(len(complete) - 90, len(complete)), *range(head, len(complete), 29)}):
        cut = write(f"{folder}/cut.log", complete[:length])
        kept = b"".join(lines[:complete[:length].count(b"\n")])
        if length % 4 == 0:
            check(run(mesh, "-o", again, "--log", cut).returncode == 0, f"log cut at {length}")
            as_script = f"{folder}/as_script.off"
            done = run(mesh, "--script", "/dev/stdin", "-o", as_script, script=complete[:length].decode())
            is_whole = kept == complete[:length]
            check(done.returncode == 0 and ("unfinished" in done.stderr) != is_whole, f"log cut at {length} as a script: {done.stderr}")
            check(bytes_of(again) == bytes_of(as_script), f"log cut at {length} gives another mesh")
            check(bytes_of(cut) == kept, f"log cut at {length}: the unfinished line stays")
        done = run(mesh, "-o", again, "--log", cut, "--script", script)
        check(done.returncode == 0 and bytes_of(again) == expected, f"log cut at {length} goes on to another mesh: {done.stderr}")
        check(bytes_of(cut) == complete, f"log cut at {length}: it ends otherwise than without the break")
    cut_within_head(folder, mesh, script, expected, complete)


def cut_within_head(folder, mesh, script, expected, complete):
    """Within its head nothing was done yet: the same command goes on with it, and no other. What only resembles a part
    of a head stays as it is."""
    again, cut = f"{folder}/again.off", f"{folder}/cut.log"
    lines = complete.splitlines(keepends=True)
    head, first_two = sum(map(len, lines[:LINES_OF_HEAD])), lines[0] + lines[1]
    other = write(f"{folder}/other.off", OCTAHEDRON)
    for length in (0, 20, len(lines[0]), len(lines[0]) + 9, len(first_two), head - 20, head - 1):
        what = f"log cut within its head, at {length}"
        write(cut, complete[:length])
        others = [(mesh, "--response", "stop")] if length >= head - 20 else []  # where the settings stand
        others += [(other,)] if length > len(lines[0]) else []  # where some of the mesh's hash does
        for arguments in others:
            fails(6, ["cut.log"], run(*arguments, "--log", cut, "--script", script), f"{what}, {arguments}")
            check(bytes_of(cut) == complete[:length], f"{what}, and yet changed: {arguments}")
        done = run(mesh, "-o", again, "--log", cut, "--script", script)
        check(done.returncode == 0 and bytes_of(again) == expected, f"{what}: {done.stderr}")
        check(bytes_of(cut) == complete, f"{what}: it ends otherwise than without the break")
    unchecked = [line.decode().rsplit(" # ", 1)[0] for line in lines]
    check(checked(*unchecked) == complete, "checksums are as the format says")
    for damaged in (complete.replace(b"\n", b"\r"), complete.replace(b"\n", b""),
                    first_two + complete[len(first_two):].replace(b"\n", b"\r"),
                    checked(*unchecked[:2], *unchecked[LINES_OF_HEAD:LINES_OF_HEAD + 3]),  # edits behind no settings
                    b"# haptic_sculpt log of my day: precious", lines[0].replace(b"log 1", b"log 2")[:-1],
                    complete[:head - 9] + b"?"):
        for arguments in ((), ("--script", script)):
            done = run(mesh, "--log", write(cut, damaged), *arguments)
            check(done.returncode in (4, 6) and bytes_of(cut) == damaged, f"taken for a part of a head: {damaged[:90]}")


SHIFTS = ("drag 3 0.1 0.1 2\nshift 2 3\n0 -1\n1 -0.5 # a comment\n2 -0x1p-1\nend\nstroke\nshift 0 2\n3 0.5\n1 1.25\nend\nend\n"
          "shift 2 1\n3 -5\nend\nundo\nredo\nshift 1 0\nend\nshift 1 1\n17 0\nend\ndrag 2 0 1.5 -0.5\n")


def shifts(folder, mesh):
    """Many vertices at once, over several lines: in a log whole or not at all."""
    log, report, script = f"{folder}/shifts.log", f"{folder}/shifts.json", write(f"{folder}/shifts.script", SHIFTS)
    whole, again = f"{folder}/shifted.off", f"{folder}/shifted again.off"
    done = run(mesh, "-o", whole, "--log", log, "--report", report, "--script", script)
    check(done.returncode == 0, f"shifts: {done.stderr}")
    check(points(whole) == [(0, 0, -1), (1.25, 0, -0.5), (0, 1.5, -0.5), (0.5, 0.1, 2)], f"where they went: {points(whole)}")
    told = [(e["op"], e["status"], e["reason"], e["line"]) for e in json.load(open(report))["edits"]]
    check([t for t in told if t[0] == "shift"] == [("shift", "reached", None, 2), ("shift", "reached", None, 8), ("shift", "refused", "blocked", 13),
          ("shift", "reached", None, 18), ("shift", "refused", "unknown-element", 20)], f"what is reported: {told}")
    complete, expected = bytes_of(log), bytes_of(whole)
    check(run(mesh, "--script", log, "-o", again).returncode == 0 and bytes_of(again) == expected, "a log with shifts is a script")
    lines = complete.splitlines(keepends=True)
    head = sum(map(len, lines[:LINES_OF_HEAD]))
    for length in range(head, len(complete), 11):
        cut = write(f"{folder}/cut.log", complete[:length])
        kept, begin, left = lines[:complete[:length].count(b"\n")], None, 0
        for i, line in enumerate(kept):
            if begin is not None:
                left -= 1
                begin = begin if left else None
            elif words(line)[:1] == [b"shift"]:
                begin, left = i, int(words(line)[2]) + 1
        kept = b"".join(kept[:begin])
        as_script = f"{folder}/as_script.off"
        done = run(mesh, "-o", as_script, "--script", cut)
        check(done.returncode == 0 and ("unfinished" in done.stderr) == (kept != complete[:length]), f"cut at {length} as a script: {done.stderr}")
        check(run(mesh, "-o", again, "--log", cut).returncode == 0 and bytes_of(cut) == kept, f"cut at {length}: what is left of a shift is dropped")
        check(bytes_of(again) == bytes_of(as_script), f"cut at {length}: as a script it gives another mesh")
        done = run(mesh, "-o", again, "--log", cut, "--script", script)
        check(done.returncode == 0 and bytes_of(again) == expected, f"cut at {length} goes on to another mesh: {done.stderr}")
        check(bytes_of(cut) == complete, f"cut at {length}: the log ends otherwise than without the break")
    for text, line, column, part in (("shift 3 1\n0 0\nend\n", 1, 7, "the axis must be"), ("shift 0 2\n0 0\nend\n", 3, 1, "'end'"),
                                     ("shift 0 1\n0 0\n1 0\nend\n", 3, 1, "has to end"), ("drag 0 0 0 0\nshift 0 1\n0 0\n", 2, 1, "no `end`"),
                                     ("shift 0 1\n0 inf\nend\n", 2, 3, "finite"), ("shift 0 1\n0 0 0\nend\n", 2, 5, "more than"),
                                     ("shift 0 -1\nend\n", 1, 9, "a number of vertices"), ("shift 0 1\n@1,2 0\nend\n", 2, 1, "@X,Y,Z")):
        fails(4, [f"line {line}, column {column}", part], run(mesh, "--script", "/dev/stdin", script=text), f"shift: {text!r}")


def c_hexadecimal(x):
    """As `%a` prints it: Python leaves no zeros out at the end."""
    return re.sub(r"\.?0*p", "p", float(x).hex()).encode()


def shifted(at, lines):
    """Where the vertices are that the whole shifts of these lines move; by arithmetic of our own. \\return that, and
    how many lines are left of a shift that is not whole"""
    at, i = [list(p) for p in at], 0
    while i < len(lines):
        word = words(lines[i])
        size = int(word[2]) + 2 if word[:1] == [b"shift"] else 1
        if i + size > len(lines):
            break
        for way in map(words, lines[i + 1:i + size - 1]):
            at[int(way[0])][int(word[1])] = float.fromhex(way[1].decode())
        i += size
    return [tuple(p) for p in at], len(lines) - i


def moves(folder, _):
    """A moved object is logged as the shifts that it was, in a stroke; as soon as each stands."""
    mesh = two_octahedra(f"{folder}/two.off")
    log, out, again, part = (f"{folder}/{name}" for name in ("moves.log", "moved.off", "again.off", "part.off"))
    undo = write(f"{folder}/undo.script", "undo\n")
    at = points(mesh)

    def logged(script):
        """The lines after the head, without comments; what a shift moves in the order of the vertices."""
        if os.path.exists(log):
            os.remove(log)
        done = run(mesh, "--script", write(f"{folder}/moves.script", script), "--log", log, "-o", out)
        check(done.returncode == 0, f"{script!r}: {done.stderr}")
        check(run(mesh, "--log", log, "-o", again).returncode == 0 and bytes_of(again) == bytes_of(out),
              f"{script!r} replayed")
        lines = [line for line in map(words, bytes_of(log).splitlines()[LINES_OF_HEAD:]) if line]
        for i, line in enumerate(lines):
            if line[0] == b"shift":
                ways = slice(i + 1, i + 1 + int(line[2]))
                lines[ways] = sorted(lines[ways], key=lambda way: int(way[0]))
        return lines

    def along(axis, by, first=0):
        """The shift of six vertices from the first on, with numbers as C prints them."""
        ways = [(v, at[v][axis] + by) for v in range(first, first + 6)]
        return [[b"shift", b"%d" % axis, b"6"], *([b"%d" % v, c_hexadecimal(x)] for v, x in ways), [b"end"]]

    lines = logged("move 3 0.5 0.25 -1\n")
    check(lines == [[b"stroke"], *along(0, 0.5), *along(1, 0.25), *along(2, -1), [b"end"]], f"of a free way: {lines}")
    check(run(mesh, "--log", log, "--script", undo, "-o", out).returncode == 0 and points(out) == at, "undone once")
    # What does nothing is not there, and leaves what can be redone; but the drag after it begins anew.
    check(logged("move 0 0 0 0\nmove 99 1 0 0\nmove 0 1e301 1e301 1e301\n") == [], "moves that do nothing")
    lines = logged("drag 4 0 0 2\nundo\nmove 0 0 0 0\nredo\n")
    check([line[0] for line in lines] == [b"drag", b"undo", b"redo"] and points(out)[4] == (0, 0, 2),
          f"redone: {lines}")
    lines = logged("drag 4 0 0 2\nmove 0 0 0 0\nmove 0 0 0 0\ndrag 4 0 0 3\n")
    check([line[0] for line in lines] == [b"drag", b"release", b"drag"], f"a grab that a move has ended: {lines}")
    # Within a stroke it is a part of that.
    lines = logged("stroke\ndrag 4 0 0 2\nmove 6 0 0.5 0\ndrag 5 0 0 -2\nend\nmove 6 0 0.25 0\nundo\n")
    check(lines[2:12] == [[b"stroke"], *along(1, 0.5, 6), [b"end"]] and lines[12][0] == b"drag",
          f"in a stroke: {lines}")
    expected = at[:4] + [(0, 0, 2), (0, 0, -2)] + [(x, y + 0.5, z) for x, y, z in at[6:]]
    check(points(out) == expected, f"the last one undone: {points(out)}")
    done = run(mesh, "--log", log, "--script", undo, "-o", out)
    check(done.returncode == 0 and points(out) == at, "the stroke undone once")
    # One that is blocked, in steps. The last before the points touch, at an eighth, is the 127th 1024th.
    logged("move 6 0 1 0\nmove 6 0 -1 0\nmove 0 16 0 0\nmove 6 0 0 1\n")
    script, complete, expected = f"{folder}/moves.script", bytes_of(log), bytes_of(out)
    lines = complete.splitlines(keepends=True)
    by = 16 * 127 / 1024
    lifted = [(x, y, z + 1) for x, y, z in at[6:]]
    pushed = [(x + by, y, z) for x, y, z in at[:6]]
    check(b"move" not in [word for line in lines for word in words(line)[:1]], "a move in the log")
    check(points(out) == pushed + lifted, f"where they went: {points(out)}")
    other = write(f"{folder}/other.script", "drag 4 -1 0 1.5\n")
    for length in range(sum(map(len, lines[:LINES_OF_HEAD])), len(complete), 61):
        kept = lines[:complete[:length].count(b"\n")]
        state, left = shifted(at, kept)
        kept = b"".join(kept[:len(kept) - left])
        cut = write(f"{folder}/cut.log", complete[:length])
        done = run(mesh, "-o", part, "--log", cut)
        check(done.returncode == 0 and points(part) == state, f"cut at {length}: replayed to {points(part)}")
        check(bytes_of(cut) == kept, f"cut at {length}: what is left of a shift is dropped")
        # The script makes the move that broke off from its beginning.
        done = run(mesh, "-o", again, "--log", cut, "--script", script)
        check(done.returncode == 0 and bytes_of(again) == expected, f"cut at {length}: goes on: {done.stderr}")
        check(bytes_of(cut) == complete, f"cut at {length}: the log ends otherwise than without the break")
    # Behind another script it leaves that move as it is.
    broken = [i for i in range(LINES_OF_HEAD, len(lines)) if lines[i].startswith(b"shift ") and b" line 3 #" in lines[i - 1]]
    check(len(broken) == 7, f"steps of an eighth less a 1024th: {len(broken)}")
    for count in broken:
        cut = write(f"{folder}/cut.log", b"".join(lines[:count]))
        for name in (other, script):
            done = run(mesh, "--script", name, "--log", cut, "-o", part)
            check(done.returncode == 0, f"three passes, cut after {count} lines: {done.stderr}")
        state = [(x, y, z + (v > 5)) for v, (x, y, z) in enumerate(shifted(at, lines[:count])[0])]
        state[4] = (-1, 0, 1.5)
        check(points(part) == state, f"a move is made twice, cut after {count} lines: {points(part)}")
    # A log of a time when a move was logged as itself.
    old = checked("# haptic_sculpt log 1", f"mesh {sha256(mesh)}", "response slide", "clearance default", "delta 0x0p+0",
                  f"# script {'0' * 64} after line 0", "move 0 0x1p+4 0x0p+0 0x0p+0 # line 1",
                  "move 6 0x0p+0 0x0p+0 0x1p+0 # line 2")
    done = run(mesh, "--log", write(log, old), "-o", out)
    check(done.returncode == 0 and bytes_of(log) == old and points(out) == pushed + lifted,
          f"an older log: {done.stderr}")
    done = run(mesh, "--log", log, "-o", out, "--script", undo)
    check(done.returncode == 0 and points(out) == pushed + at[6:], "an older log goes on")
    check(bytes_of(log).startswith(old), "what was in an older log is another")


def settings(folder, mesh):
    script, log = write(f"{folder}/s.script", "drag 3 0.2 0.3 -1\ndrag 3 0.5 0.2 -0.5\n"), f"{folder}/settings.log"
    out, again = f"{folder}/s.off", f"{folder}/t.off"
    options = ("--response", "stop", "--clearance", "0x1p-10", "--delta", "0.01")
    check(run(mesh, "--script", script, "--log", log, "-o", out, *options).returncode == 0, "with options")
    begun = bytes_of(log)
    check([words(line) for line in begun.splitlines()[2:LINES_OF_HEAD]]
          == [[b"response", b"stop"], [b"clearance", b"0x1p-10"], [b"delta", float(0.01).hex().encode()]], f"settings {begun}")
    for what, arguments in (("no option", ()), ("the same options", options)):
        check(run(mesh, "--log", log, "-o", again, *arguments).returncode == 0 and bytes_of(again) == bytes_of(out), f"replay with {what}")
    done = run(mesh, "--script", log, "-o", again, "--response", "paper", "--clearance", "0.005")
    check(done.returncode == 0 and bytes_of(again) == bytes_of(out), "the settings of a log that is given as a script hold")
    plain = f"{folder}/plain.log"
    run(mesh, "--script", script, "--log", plain)
    kept = bytes_of(plain)
    for name, value, logged, of in (("--response", "slide", "response stop", log), ("--clearance", "0.001", "clearance 0.0009765625", log),
                                    ("--delta", "0", "delta 0.01", log), ("--response", "stop", "response slide", plain),
                                    ("--clearance", "0.001", "clearance default", plain), ("--delta", "0.5", "delta 0", plain)):
        fails(2, [f"{name} {value}", logged, of, "script"], run(mesh, "--log", of, "-o", f"{folder}/none.off", name, value), "an option against the log")
    check(bytes_of(log) == begun and bytes_of(plain) == kept and not os.path.exists(f"{folder}/none.off"), "refused, and yet changed")
    # What holds at the end is what a further script begins with.
    changes, further = write(f"{folder}/changes.script", "response stop\nclearance default\ndrag 3 0 0 2\n"), write(f"{folder}/further.script", "drag 3 0.2 0.2 -1\n")
    mixed = f"{folder}/mixed.log"
    check(run(mesh, "--script", changes, "--log", mixed, "--response", "slide", "--clearance", "0.00390625").returncode == 0, "settings that change")
    fails(2, ["--response slide", "ends with", "response stop"], run(mesh, "--script", further, "--log", mixed, "--response", "slide"), "option against the end")
    fails(2, ["--clearance 0.00390625", "ends with", "default"], run(mesh, "--script", further, "--log", mixed, "--clearance", "0.00390625"), "option against the end")
    check(run(mesh, "--script", further, "--log", mixed, "-o", out).returncode == 0, "no option")
    together = "clearance 0.00390625\nresponse stop\nclearance default\ndrag 3 0 0 2\ndrag 3 0.2 0.2 -1\n"
    check(run(mesh, "--script", "/dev/stdin", "-o", again, script=together).returncode == 0 and bytes_of(again) == bytes_of(out), "what the log ends with holds")


def settings_that_others_change(folder, mesh):
    """A script that broke off goes on with what was in force then, whatever came between."""
    log, out, whole = f"{folder}/broken.log", f"{folder}/broken.off", f"{folder}/whole.off"
    script = write(f"{folder}/broken.script", "delta 0.3\ndrag 3 0.2 0.3 2\ndrag 1 0.05 0 0\n")
    command = (mesh, "--script", script, "--log", log, "--response", "stop", "-o")
    check(run(*command, whole).returncode == 0, "without a break")
    lines = bytes_of(log).splitlines(keepends=True)
    broken = b"".join(lines[:LINES_OF_HEAD + 3])  # up to the first drag
    between = write(f"{folder}/between.script", "delta 0\nresponse slide\nclearance 0.001\n")
    write(log, broken)
    check(run(mesh, "--script", between, "--log", log).returncode == 0, "another script in between")
    visited = len(bytes_of(log).splitlines())
    done = run(*command, out)
    check(done.returncode == 0 and bytes_of(out) == bytes_of(whole), f"goes on with other settings: {done.stderr}")
    complete = bytes_of(log)
    lines = complete.splitlines(keepends=True)
    logged = [words(line)[0] for line in lines[visited + 1:visited + 4]]
    check(logged == [b"response", b"clearance", b"delta"], f"what is in force is logged: {lines[visited:]}")
    for n in range(visited, len(lines) + 1):
        write(log, b"".join(lines[:n]))
        done = run(*command, out)
        is_same = bytes_of(out) == bytes_of(whole) and bytes_of(log) == complete
        check(done.returncode == (2 if n == len(lines) else 0) and is_same, f"cut after line {n}: {done.stderr}")


def settings_that_cannot_be_set_again(folder, mesh):
    """A script does not go on without what was in force when it broke off."""
    log, out = f"{folder}/broken.log", f"{folder}/broken.off"
    script = write(f"{folder}/broken.script", "delta 0.3\ndrag 3 0.2 0.3 2\ndrag 1 0.05 0 0\n")
    command = (mesh, "--script", script, "--log", log, "-o", out)
    check(run(*command).returncode == 0, "without a break")
    write(log, b"".join(bytes_of(log).splitlines(keepends=True)[:LINES_OF_HEAD + 3]))  # up to the first drag
    between = write(f"{folder}/between.script", "delta 0\ndrag 1 0.05 0 0\n")
    check(run(mesh, "--script", between, "--log", log).returncode == 0, "lower than its delta")
    for attempt in range(2):
        fails(2, ["delta", "had this when it broke off", "Undo"], run(*command), f"without its delta, {attempt}")
    undo = write(f"{folder}/undo.script", "undo\n")
    check(run(mesh, "--script", undo, "--log", log).returncode == 0, "what was done since is undone")
    done = run(*command)
    check(done.returncode == 0 and "blocked 1," in done.stdout, f"goes on, with its delta: {done.stdout}{done.stderr}")


def settings_that_were_refused(folder, mesh):
    """What was refused is in a log, for a replay says so again, and is said there not to be in force."""
    low = write(f"{folder}/low.script", "delta 0\ndrag 1 0.05 0 0\ndelta 0.3\n")
    further = write(f"{folder}/further.script", "drag 3 0.2 0.2 2\n")
    log, out, again = f"{folder}/low.log", f"{folder}/low.off", f"{folder}/again.off"
    done = run(mesh, "--script", low, "--log", log, "-o", out, "--delta", "0.3")
    check(done.returncode == 0 and "refused 1\n" in done.stdout, f"a delta that is refused: {done.stdout}")
    logged = bytes_of(log).splitlines()[-2]
    check(words(logged) == [b"delta", (0.3).hex().encode()], f"what was refused: {logged}")
    check(b" # refused # line 3 # " in logged, f"said to be refused: {logged}")
    done = run(mesh, "--script", further, "--log", log, "--delta", "0.3")
    fails(2, ["--delta 0.3", "ends with", "delta 0'"], done, "a delta that was refused")
    check(run(mesh, "--log", log, "-o", again).returncode == 0 and bytes_of(again) == bytes_of(out), "replay")
    wide, log = write(f"{folder}/wide.script", "clearance 1\n"), f"{folder}/wide.log"
    for arguments in (("--script", wide), ("--script", further)):
        done = run(mesh, *arguments, "--log", log, "--clearance", "0.001")
        check(done.returncode == 0, f"a clearance that was refused is in nobody's way: {done.stderr}")
    # Where the log ends behind it, too, as on a full disk: the script that goes on later has what was in force.
    first = write(f"{folder}/first.script", "clearance 0.1\ndrag 3 0.2 0.2 -5\n")
    between, log = write(f"{folder}/between.script", "clearance 0.001\ndrag 3 0 0 3\n"), f"{folder}/cut.log"
    done = run(mesh, "--script", first, "--log", log)
    check("refused 1\n" in done.stdout, f"a clearance that is too long: {done.stdout}")
    write(log, b"".join(bytes_of(log).splitlines(keepends=True)[:LINES_OF_HEAD + 2]))
    for script in (between, first):
        done = run(mesh, "--script", script, "--log", log, "-o", out)
        check(done.returncode == 0, f"behind a clearance that was refused: {done.stderr}")
    together = "clearance 0.001\ndrag 3 0 0 3\nclearance default\ndrag 3 0.2 0.2 -5\n"
    done = run(mesh, "--script", "/dev/stdin", "-o", again, script=together)
    check(done.returncode == 0 and bytes_of(again) == bytes_of(out), "a clearance that was refused holds")


def rerun(folder, mesh):
    log, out, report = f"{folder}/rerun.log", f"{folder}/rerun.off", f"{folder}/rerun.json"
    script = write(f"{folder}/rerun.script", "# begin\ninsert_face 0 1 2 0.2 0.2 0\n\ndrag 4 0.2 0.2 -0.5\n")
    command = (mesh, "--script", script, "--log", log, "-o", out, "--report", report)
    check(run(*command).returncode == 0, "first run")
    complete, result = bytes_of(log), bytes_of(out)
    os.remove(out)
    fails(2, ["--append", script, log], run(*command), "the same command again")
    check(bytes_of(log) == complete and not os.path.exists(out), "refused, and yet something was written")
    # Killed while the results were being written.
    write(log, b"".join(complete.splitlines(keepends=True)[:-1]))
    check(run(*command).returncode == 0 and bytes_of(log) == complete and bytes_of(out) == result, "results are written by the next run")
    # In a pass that was asked for once more, and killed.
    check(run(*command, "--append").returncode == 0 and len(points(out)) == 5, "--append")
    twice = bytes_of(log)
    edits = json.load(open(report))["edits"]
    check([(e["source"], e["line"], e["script_line"], e["status"]) for e in edits]
          == [("log", 7, 2, "reached"), ("log", 8, 4, "reached"), ("script", 2, 2, "refused"), ("script", 4, 4, "reached")], f"sources {edits}")
    check("log 11  insert_face" in run(mesh, "--log", log).stdout, "the table does not say which line of the log was refused")
    lines = twice.splitlines(keepends=True)
    for count in range(len(complete.splitlines()) + 1, len(lines)):
        for options in ((), ("--append",)):
            write(log, b"".join(lines[:count]))
            check(run(*command, *options).returncode == 0 and bytes_of(log) == twice, f"the second pass broken after {count} lines, {options}")
    fails(2, ["--append"], run(*command), "complete again")
    # Another script goes on behind; and the first one, broken then, after it.
    other = write(f"{folder}/other.script", "drag 3 0 0 2\n")
    broken = b"".join(complete.splitlines(keepends=True)[:-2])
    write(log, broken)
    check(run(mesh, "--script", other, "--log", log).returncode == 0 and bytes_of(log).startswith(broken), "another script")
    done = run(*command)
    check(done.returncode == 0 and "after line 2" in done.stdout, f"the first script goes on: {done.stdout} {done.stderr}")
    edits = json.load(open(report))["edits"]
    check([(e["source"], e["script_line"], e["op"]) for e in edits] == [("log", 2, "insert_face"), ("log", 1, "drag"), ("script", 4, "drag")], f"{edits}")
    fails(2, ["--append"], run(*command), "complete behind another")
    check(run(mesh, "--log", log, "-o", f"{folder}/r.off").returncode == 0 and bytes_of(out) == bytes_of(f"{folder}/r.off"), "replay of three passes")
    fails(2, ["--log"], run(mesh, "--script", script, "--append"), "--append without a log")
    for _ in range(2):  # nothing is done twice by a script that does nothing
        check(run(mesh, "--script", "/dev/null", "--log", f"{folder}/empty.log").returncode == 0, "empty script")


def strokes(folder, _):
    """Wherever a log breaks off, its last whole edit is there, an open stroke is one step of undo, and the same command goes on within it."""
    mesh = write(f"{folder}/octahedron.off", OCTAHEDRON)
    text = ("drag 0 2 0 0\nstroke\ndrag 0 2.5 0 0.1\ninsert_face 0 2 4 1 0.6 0.6\nstroke\ndrag 6 1 0.7 0.7\nflip 1 3\nend\ncollapse 6 2\nend\nundo\nredo\n"
            "stroke\ndrag 2 0 2 0\nundo\ndrag 2 0 3 0\nend\nstroke\ndrag 4 0 0 2\nresponse stop\ndrag 4 0 0 3\n")
    script, undo = write(f"{folder}/strokes.script", text), write(f"{folder}/undo.script", "undo\n")
    log, out, whole, part = f"{folder}/strokes.log", f"{folder}/strokes.off", f"{folder}/whole.off", f"{folder}/part.off"
    check(run(mesh, "--script", script, "--log", log, "-o", whole).returncode == 0, "strokes")
    complete, expected = bytes_of(log), bytes_of(whole)
    lines = complete.splitlines(keepends=True)
    open_strokes, within = 0, 0
    for count in range(LINES_OF_HEAD, len(lines) + 1):
        for tail in (b"", lines[count][:-1]) if count < len(lines) else (b"",):
            left = b"".join(lines[:count]) + tail
            write(log, left)
            check(run(mesh, "--script", script, "--log", log, "-o", out).returncode == (2 if count == len(lines) else 0), f"resumed after {count} lines")
            check(bytes_of(log) == complete and bytes_of(whole) == expected and (count == len(lines) or bytes_of(out) == expected),
                  f"log or result is another, resumed after {count} lines")
        # Another script goes on: the open strokes have ended with what is there, and are one step.
        write(log, b"".join(lines[:count]))
        done = [line.decode() for line in lines[:count]]
        before = before_open_stroke(done)
        run(mesh, "--script", "/dev/stdin", "-o", part, script="".join(done))
        check(run(mesh, "--script", undo, "--log", log, "-o", out).returncode == 0, f"undo after {count} lines")
        ends = [words(line) for line in bytes_of(log).splitlines()[count:] if words(line) == [b"end"]]
        begun = [words(line)[:1] for line in lines[:count]]
        check(len(ends) == begun.count([b"stroke"]) - begun.count([b"end"]), f"ends written behind {count} lines: {ends}")
        if before is not None:
            open_strokes += 1
            state = surface(part)
            run(mesh, "--script", "/dev/stdin", "-o", part, script="".join(before))
            if state != surface(part):
                within += 1
                check(surface(out) == surface(part), f"one undo does not take back the stroke that broke off after {count} lines")
        result, replayed = bytes_of(out), f"{folder}/replayed.off"
        check(run(mesh, "--log", log, "-o", replayed).returncode == 0 and bytes_of(replayed) == result, "replay of two passes")
        check(run(mesh, "--script", log, "-o", replayed).returncode == 0 and bytes_of(replayed) == result, "two passes as a script")
    check(open_strokes >= 10 and within >= 7, f"{open_strokes} logs broke off within a stroke, {within} of these after an edit in it")
    # The first script, broken off in a stroke, goes on behind another.
    write(log, b"".join(lines[:LINES_OF_HEAD + 5]))
    for name in (undo, script):
        check(run(mesh, "--script", name, "--log", log, "-o", out).returncode == 0, "three passes")
    result = bytes_of(out)
    check(run(mesh, "--script", log, "-o", out).returncode == 0 and bytes_of(out) == result, "three passes as a script")


def earlier_version(folder, _):
    """A log written before there were shifts, with all that a line could say then, is replayed and gone on with."""
    mesh, log, out, report = (f"{folder}/{name}" for name in ("octahedron.off", "old.log", "old.off", "old.json"))
    write(mesh, OCTAHEDRON)
    written = bytes_of(f"{SOURCE}/test/examples/earlier_version.log")
    write(log, written)
    done = run(mesh, "--log", log, "-o", out, "--report", report)
    check(done.returncode == 0 and bytes_of(log) == written, f"a log of an earlier version: {done.stderr}")
    # By the lines: where vertices were dragged and created; what else was done was undone, or refused.
    expected = points(mesh)[:4] + [(0.25, 0, 2), (0, 0, -3), (1, 1, 1.5), (-0.75, -0.75, 0)]
    check(points(out) == expected and len(surface(out)[1]) == 12, f"it is replayed to another mesh: {surface(out)}")
    edits = json.load(open(report))["edits"]
    check(len(edits) == 19 and [(e["op"], e["reason"]) for e in edits if e["status"] != "reached"] ==
          [("remove", "unknown-element"), ("redo", "nothing-to-redo")], f"what is reported of it: {edits}")
    done = run(mesh, "--log", log, "-o", out, "--script", "/dev/stdin", script="undo\ndrag 4 0 0 2.5\n")
    expected[4], expected[6] = (0, 0, 2.5), (0.5, 0.5, 1)
    check(done.returncode == 0 and points(out) == expected, f"it is not gone on with: {done.stderr}")
    check(bytes_of(log).startswith(written), "what was in it is another")


def delta_in_stroke(folder, mesh):
    """Delta changes between steps of the history only."""
    log, report = f"{folder}/delta.log", f"{folder}/delta.json"
    script = write(f"{folder}/delta.script", "stroke\ndelta 0.01\ndrag 3 0.2 0.2 2\nend\ndelta 0.01\n")
    for source in ("--script", script), ():
        done = run(mesh, *source, "--log", log, "--report", report)
        told = [(e["op"], e["status"], e["reason"]) for e in json.load(open(report))["edits"]]
        expected = [("delta", "refused", "open-stroke"), ("drag", "reached", None)]
        check(done.returncode == 0 and told == expected, f"delta within a stroke: {told}")


def no_logs(folder, mesh):
    """What is no log of this mesh is refused, byte for byte as it was."""
    digest = sha256(mesh)
    other = write(f"{folder}/other.off", TETRAHEDRON.replace("0.1 0.1 1", "0.1 0.1 2"))
    run(other, "--script", "/dev/stdin", "--log", f"{folder}/foreign.log", script="drag 3 0 0 3\n")
    foreign = bytes_of(f"{folder}/foreign.log")
    for contents in (b"precious", b"precious\n", b"\n", b"#", b"m", b"mesh", b"mesh 12\n", b"mesh " + digest.encode(), b"drag 3 0 0 2\n", b"\0" * 5000,
                     b"two\nlines", bytes_of(mesh), b"\x89PNG\r\n\x1a\n" + bytes(range(256)), b"# haptic_sculpt log",
                     checked("# haptic_sculpt log"), checked("# haptic_sculpt log 2"),
                     f"mesh {'0' * 64}\ndrag 3 0 0 2\nunfinished".encode(), foreign, foreign[:-5]):
        log = write(f"{folder}/no.log", contents)
        for arguments in ((), ("--script", "/dev/stdin")):
            fails(6, ["no.log"], run(mesh, "--log", log, "-o", f"{folder}/none.off", *arguments, script="drag 3 0 0 2\n"), f"no log: {contents[:40]}")
            check(bytes_of(log) == contents, f"no log, and yet changed: {contents[:40]}")
    check(not os.path.exists(f"{folder}/none.off"), "no log, and yet a result")
    empty = write(f"{folder}/empty.log", b"")
    check(run(mesh, "--log", empty, "--script", "/dev/stdin", script="drag 3 0 0 2\n").returncode == 0 and len(bytes_of(empty)) > 100, "an empty file is begun")
    newer = run(mesh, "--log", write(f"{folder}/newer.log", b"# haptic_sculpt log 2 # 0123456789abcdef\n"))
    fails(4, ["line 1"], newer, "a version that does not agree with its checksum")


def changed_logs(folder, mesh):
    """Every change of a byte, and of the order of lines, is found, and its line named."""
    rng = random.Random(int(os.environ.get("HAPTIC_SCULPT_SEED", "5")))
    log, script = f"{folder}/sound.log", write(f"{folder}/c.script", EDITS)
    check(run(mesh, "--log", log, "--script", script).returncode == 0, "a sound log")
    sound = bytes_of(log)
    changed = f"{folder}/changed.log"
    for i in range(300):
        at = rng.randrange(len(sound)) if i > 0 else len(sound) - 1
        byte = rng.choice([b for b in (*b"0123456789abcdef .#-+px\n\0", rng.randrange(256)) if b != sound[at]])
        text = sound[:at] + bytes([byte]) + sound[at + 1:]
        done = run(mesh, "--log", write(changed, text))
        line = sound[:at].count(b"\n") + 1
        fails(6 if done.returncode == 6 and line == 1 else 4, [f"line {line}"], done, f"byte {at} is {byte} instead of {sound[at]}")
        check(bytes_of(changed) == text, f"a changed log (byte {at}) is touched")
    lines = sound.splitlines(keepends=True)
    for i in range(1, len(lines) - 1):
        for what, text, line in (("gone", lines[:i] + lines[i + 1:], i + 1), ("doubled", lines[:i + 1] + lines[i:], i + 2),
                                 ("swapped", lines[:i] + [lines[i + 1], lines[i]] + lines[i + 2:], i + 1)):
            fails(4, [f"line {line}"], run(mesh, "--log", write(changed, b"".join(text))), f"line {i + 1} {what}")


def without_checksums(folder, mesh):
    """The lines of a log without version and checksums are a script, and nothing is appended to them."""
    lines = f"mesh {sha256(mesh)}\nresponse stop\nclearance 0x1p-10\ninsert_face 0 1 2 0x1.999999999999ap-3 0x1.999999999999ap-3 0x0p+0\n"
    log = write(f"{folder}/old.log", lines)
    fails(6, ["old.log", "--script"], run(mesh, "--log", log, "--script", "/dev/stdin", script="remove 4\n"), "lines without checksums")
    check(bytes_of(log).decode() == lines, "lines without checksums are touched")
    begun = f"{folder}/begun.log"
    check(run(mesh, "--script", log, "--log", begun).returncode == 0 and b"insert_face 0 1 2" in bytes_of(begun), "what the message says to do")


def two_processes(folder, mesh):
    log = f"{folder}/locked.log"
    run(mesh, "--log", log)
    kept = bytes_of(log)
    with open(log) as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        fails(5, ["in use", log], run(mesh, "--log", log, "--script", "/dev/stdin", script="drag 3 0 0 2\n"), "a locked log")
    check(bytes_of(log) == kept, "a locked log is changed")
    script = write(f"{folder}/long.script", "drag 3 0.2 0.2 2\ndrag 3 0.3 0.3 1\n" * 20000)
    log = f"{folder}/new.log"
    first = subprocess.Popen([SCULPT, mesh, "--script", script, "--log", log], stdout=subprocess.DEVNULL)
    while first.poll() is None and not (os.path.exists(log) and os.path.getsize(log) > 0):
        time.sleep(0.001)
    fails(5, ["in use"], run(mesh, "--script", script, "--log", log), "a second process")
    check(first.poll() is None, "the first process was too fast for this check")
    check(first.wait() == 0 and run(mesh, "--log", log).returncode == 0, "the first process is disturbed")
    for i in range(10): # rarely does one of them make the file and another one lock it first
        race = f"{folder}/race{i}.log"
        begun = [subprocess.Popen([SCULPT, mesh, "--log", race], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for _ in range(8)]
        codes = {process.wait() for process in begun}
        check(0 in codes and codes <= {0, 5} and run(mesh, "--log", race).returncode == 0, f"eight begin one log: {codes}")


def places(folder, mesh):
    os.mkfifo(f"{folder}/pipe")
    os.mkdir(f"{folder}/folder")
    os.symlink("loop", f"{folder}/loop")
    for path in (f"{folder}/pipe", f"{folder}/folder", "/dev/null", "/dev/full", "/dev/stdin", f"{folder}/loop", f"{folder}/nowhere/x.log"):
        fails(5, [path], run(mesh, "--log", path, "-o", f"{folder}/none.off", script=""), f"a log at {path}")
    check(not os.path.exists(f"{folder}/none.off"), "written though the log cannot be")
    os.symlink("led_to.log", f"{folder}/link.log")
    check(run(mesh, "--log", f"{folder}/link.log").returncode == 0 and os.path.islink(f"{folder}/link.log") and os.path.exists(f"{folder}/led_to.log"),
          "a log through a link that leads nowhere yet")
    # The mesh a log begins with has to stay.
    copy = write(f"{folder}/copy.off", TETRAHEDRON)
    os.link(copy, f"{folder}/hard.off")
    os.symlink("copy.off", f"{folder}/soft.off")
    for out in (copy, f"{folder}/hard.off", f"{folder}/soft.off", f"{folder}/./copy.off"):
        fails(2, [out, "log"], run(copy, "-o", out, "--log", f"{folder}/copy.log"), "the result in place of the mesh, with a log")
    check(bytes_of(copy) == TETRAHEDRON.encode() and not os.path.exists(f"{folder}/copy.log"), "the mesh is spoilt")
    check(run(copy, "-o", copy).returncode == 0, "the result in place of the mesh, without a log")


def full_disk(folder, mesh):
    script = write(f"{folder}/full.script", "drag 3 0.2 0.2 2\ndrag 3 0.3 0.3 1.5\n" * 100)
    expected, out, report = f"{folder}/e.off", f"{folder}/full.off", f"{folder}/full.json"
    run(mesh, "--script", script, "-o", expected)
    whole = f"{folder}/whole.log"
    run(mesh, "--script", script, "--log", whole)
    for limit in (200, 400, 2000, 2001, 2002, 5000):  # 200: less than the head
        log = f"{folder}/full{limit}.log"
        done = run(mesh, "--script", script, "--log", log, "-o", out, limit=limit)
        fails(5, [log, "goes on without"], done, f"the log may not grow beyond {limit} bytes")
        check(bytes_of(out) == bytes_of(expected), "the result is not written, or another")
        os.remove(out)
        if limit == 200:
            check(not os.path.exists(log), "a log without a whole head is left")
            continue
        check(bytes_of(whole).startswith(bytes_of(log)) and bytes_of(log).endswith(b"\n"), "the log does not end with a whole line")
        done = run(mesh, "--script", script, "--log", log, "-o", out, "--report", report)
        check(done.returncode == 0 and bytes_of(out) == bytes_of(expected) and bytes_of(log) == bytes_of(whole), f"resumed with room: {done.stderr}")
    small = f"{folder}/small"
    os.mkdir(small)
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8k", "tmpfs", small], stderr=subprocess.DEVNULL).returncode != 0:
        print("skipped: no small disk can be mounted here")
        return
    try:
        for room in (8192, 4096, 0):  # some, a page, none
            write(f"{small}/ballast", b"x" * (8192 - room))
            done = run(mesh, "--script", script, "--log", f"{small}/x.log", "-o", out, "--report", report)
            fails(5, ["x.log", "No space left"], done, f"a disk with room for {room} bytes")
            check(bytes_of(out) == bytes_of(expected) and any("x.log" in note for note in json.load(open(report))["notes"]), "the result, and a note in the report")
            if os.path.exists(f"{small}/x.log"):
                os.remove(f"{small}/x.log")
            check(os.listdir(small) == ["ballast"], "what is left on a full disk")
            os.remove(out)
    finally:
        subprocess.run(["umount", small], check=True)


def surfaces_of_options(folder, mesh):
    """A log is of the surface that was sculpted, which an option may have made of the file."""
    cube = write(f"{folder}/cube.off", CUBE_OF_SQUARES)
    inside_out = write(f"{folder}/inside_out.off", TETRAHEDRON.replace("0 2 1", "0 1 2").replace("0 1 3", "0 3 1")
                       .replace("1 2 3", "1 3 2").replace("2 0 3", "2 3 0"))
    for path, option, others in ((cube, ("--triangulate",), ("--repair",)), (inside_out, ("--orient",), ()),
                                 (inside_out, ("--repair",), ())):
        log, script = f"{path}{option[0]}.log", write(f"{folder}/drag.script", "drag 0 -0.25 -0.25 -0.25\n")
        first, again = f"{folder}/first.off", f"{folder}/again.off"
        done = run(path, *option, "--script", script, "--log", log, "-o", first)
        check(done.returncode == 0, f"{option}: {done.stderr}")
        check(run(path, *option, "--log", log, "-o", again).returncode == 0 and bytes_of(first) == bytes_of(again), f"{option}: made again")
        fails(6, ["--orient"], run(path, *others, "--log", log, "-o", f"{folder}/other.off"), f"{option}, then {others}")
        check(not os.path.exists(f"{folder}/other.off"), f"{option}: another surface is sculpted")


def refused_settings(folder, mesh):
    """A setting that cannot be begins no log: the command without it, or with another one, would be refused for it."""
    log, script = f"{folder}/edits.log", write(f"{folder}/edits.script", EDITS)
    fails(2, ["clearance"], run(mesh, "--script", script, "--log", log, "--clearance", "1e5"), "a clearance of no use")
    check(not os.path.exists(log), "it has begun a log")
    check(run(mesh, "--script", script, "--log", log, "--clearance", "1e-9").returncode == 0, "another clearance")


def main():
    with tempfile.TemporaryDirectory() as folder:
        mesh = write(f"{folder}/tetrahedron.off", TETRAHEDRON)
        for part in (edits_and_log, shifts, moves, settings, settings_that_others_change,
                     settings_that_cannot_be_set_again, settings_that_were_refused,
                     rerun, strokes, earlier_version, delta_in_stroke, no_logs, changed_logs, without_checksums,
                     two_processes, places, full_disk, surfaces_of_options, refused_settings):
            inner = f"{folder}/{part.__name__}"
            os.mkdir(inner)
            start = time.monotonic()
            part(inner, mesh)
            print(f"{part.__name__}: {time.monotonic() - start:.1f} s")
    end()


main()
