#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_minimise.py ROOT SCULPT: a case of three components and 60 lines becomes one that still fails, with the least of both.

What "fails" here is known beforehand: that a drag of one vertex is blocked. One line is enough for that, and the two
components that it goes between."""
import json
import os
import pathlib
import random
import select
import signal
import subprocess
import sys
import tempfile
import time

ROOT, SCULPT, SEED, BLOCKED = pathlib.Path(sys.argv[1]), sys.argv[2], 3, 10

# Ends with 10 where the script has a blocked drag whose vertex is pushed to x = 7.
JUDGE = """import json, subprocess, sys
subprocess.run([sys.argv[1], sys.argv[2], '--script', sys.argv[3], '-o', sys.argv[4] + '/o.off', '--report', sys.argv[4] + '/r.json', '--response', 'stop'], check=True)
lines = open(sys.argv[3]).read().splitlines()
edits = json.load(open(sys.argv[4] + '/r.json'))['edits']
sys.exit(10 if any(e['op'] == 'drag' and e['status'] == 'blocked' and lines[e['line'] - 1].split()[2] == '7' for e in edits) else 0)
"""


# A broad phase that leads elsewhere where a vertex is dragged to x = 7: the mesh it makes has a comment more.
PLANTED = """#!/usr/bin/env python3
import subprocess, sys
done = subprocess.run([REAL, *sys.argv[1:]])
script, out = (open(sys.argv[sys.argv.index(o) + 1], m) for o, m in (("--script", "r"), ("-o", "a")))
if done.returncode == 0 and "brute" in sys.argv and any(line.startswith("drag ") and line.split()[2] == "7" for line in script):
    out.write("# elsewhere\\n")
sys.exit(done.returncode)
"""


def box(x):
    """A cube of side 1 from x on, two triangles a side."""
    points = [(x + (i & 1), i >> 1 & 1, i >> 2 & 1) for i in range(8)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]


def minimise(*words):
    return subprocess.run([sys.executable, str(ROOT / "benchmark/robustness/minimise"), *map(str, words)],
                          capture_output=True, text=True)


def wrong_use(folder, mesh, script, faults):
    """Exit code 2, before anything is tried, and what is given is as it was."""
    (folder / "no_text.script").write_bytes(b"\xff\xfe")
    no_program = folder / "no_program"
    no_program.write_text("\0")
    no_program.chmod(0o755)
    before = mesh.read_bytes(), script.read_bytes(), sorted(folder.iterdir())
    new = ("--out", folder / "new")
    for words, said in (((SCULPT, mesh, folder / "lost.script", *new), "lost.script"),
                        ((SCULPT, mesh, folder / "no_text.script", *new), "no_text.script"),
                        ((SCULPT, folder / "lost.off", script, *new), "lost.off"),
                        ((folder / "lost", mesh, script, *new), "lost"),
                        ((no_program, mesh, script, *new), "no_program"),
                        ((SCULPT, mesh, script, *new, "--command", "/nowhere/program {mesh}"), "/nowhere/program"),
                        ((SCULPT, mesh, script, *new, "--command", ""), "is empty"),
                        ((SCULPT, mesh, script, *new, "--command", "true {"), "a brace"),
                        ((SCULPT, mesh, script, *new, "--command", "true {mash}"), "a brace"),
                        ((SCULPT, mesh, script, *new, "--command", "true '"), "No closing quotation"),
                        ((SCULPT, mesh, script, *new, "--seconds", "nan"), "--seconds"),
                        ((SCULPT, mesh, script, "--out", folder / "nowhere/small"), "nowhere/small.off"),
                        ((SCULPT, mesh, script, "--out", ""), "is no name"),
                        ((SCULPT, mesh, script, "--out", mesh.with_suffix("")), "is read from")):
        done = minimise(*words)
        if done.returncode != 2 or said not in done.stderr or "Traceback" in done.stderr:
            faults.append(f"wrong use, {words[1:]}: exit {done.returncode}, {done.stderr[-500:]}")
    if before != (mesh.read_bytes(), script.read_bytes(), sorted(folder.iterdir())):
        faults.append("wrong use has changed files")


def killed(folder, mesh, script, faults):
    """What it has started ends with it."""
    sculpt, fifo = folder / "sleeping_sculpt", folder / "fifo"
    os.mkfifo(fifo)
    sculpt.write_text(f"#!/usr/bin/env python3\nimport time\nwith open({str(fifo)!r}, 'w') as told:\n"
                      "    print('begins', file=told, flush=True)\n    time.sleep(60)\n    print('ends', file=told)\n")
    sculpt.chmod(0o755)
    words = [ROOT / "benchmark/robustness/minimise", sculpt, mesh, script, "--out", folder / "never"]
    going = subprocess.Popen([sys.executable, *map(str, words)], stderr=subprocess.DEVNULL)
    with open(os.open(fifo, os.O_RDONLY | os.O_NONBLOCK)) as told:
        while going.poll() is None and not select.select([told], [], [], 0.1)[0]:
            pass
        os.set_blocking(told.fileno(), True)
        began = told.readline()
        going.kill()
        going.wait()
        left = told.read()  # until nobody has it open any more
    if began != "begins\n" or left:
        faults.append(f"killed: what it has started tells '{began}', then '{left}'")


def stopped(folder, mesh, lines, faults):
    """By Ctrl-C, or when its time is up, it writes what the case is by then; also of many lines soon after. The judge of
    the fourth try gives the signal itself: no other try comes after it."""
    script, needed = folder / "long.script", "drag 3 0 0 0.125"
    script.write_text("\n".join([*(lines * 800)[:20000], needed]) + "\n")
    tries = folder / "tries"
    tries.touch()
    judge = f"""bash -c 'echo >> {tries}; test ! -e {folder}/interrupts || test $(wc -l < {tries}) -ne 4 ||
                 kill -INT $PPID; grep -qxF "{needed}" {{script}}'"""
    words = [sys.executable, ROOT / "benchmark/robustness/minimise", SCULPT, mesh, script, "--command", judge,
             "--exit", 0]
    for name, options in (("by_time", ("--seconds", 0.2)), ("by_hand", ())):
        if name == "by_hand":
            tries.write_text("")
            (folder / "interrupts").touch()
        going = subprocess.Popen([*map(str, words), "--out", folder / name, *map(str, options)],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                 preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
        try:
            out, err = going.communicate(timeout=100)
        except subprocess.TimeoutExpired:
            going.kill()
            out, err = going.communicate()
        left = (folder / f"{name}.script").read_text().splitlines() if going.returncode == 0 else []
        told = tries.stat().st_size
        if going.returncode != 0 or needed not in left or err or (name == "by_hand" and (told != 4 or len(left) < 1000)):
            faults.append(f"stopped {name}: exit {going.returncode}, {len(left)} lines, {told} tries, {out} {err[-500:]}")


def places(folder, mesh, lines, faults):
    """A vertex may be named by a place near it, which is kept as it is."""
    script, place = folder / "places.script", "drag @0.1,0.1,0 0.1 0.1 0.1"
    script.write_text("\n".join([place, *lines[:3]]) + "\n")
    needed = f"grep -qF '{place}' {{script}}"
    done = minimise(SCULPT, mesh, script, "--out", folder / "places_small", "--command", needed, "--exit", 0)
    left = (folder / "places_small.script").read_text().splitlines()[1:] if done.returncode == 0 else []
    if left != [place]:
        faults.append(f"a place that is needed: exit {done.returncode}, {left}, {done.stderr[-500:]}")


def shifts(folder, mesh, lines, faults):
    """The `end` of a shift ends no stroke: what is left is the one shift that is needed, of the one vertex."""
    script, way = folder / "shifts.script", "1 0.25"
    idle = ["shift 2 2", "24 40.5", "25 40.5", "end"]
    needed = ["shift 0 3", "0 0.125", way, "2 0.5", "end"]
    script.write_text("\n".join([*lines[:3], *idle, "stroke", lines[3], *needed, "end", *idle]) + "\n")
    has_way = f"grep -qxF '{way}' {{script}}"
    done = minimise(SCULPT, mesh, script, "--out", folder / "shifts_small", "--command", has_way, "--exit", 0)
    left = (folder / "shifts_small.script").read_text().splitlines()[1:] if done.returncode == 0 else []
    if left != ["shift 0 1", way, "end"] or "19 lines" not in done.stdout or "now 3 " not in done.stdout:
        faults.append(f"a shift that is needed: exit {done.returncode}, {left}, {done.stdout} {done.stderr[-500:]}")


def main():
    draw = random.Random(SEED)
    points, faces = [], []
    for x in (0, 3, 6.5, 40):
        p, f = box(x)
        faces += [[len(points) + v for v in t] for t in f]
        points += p
    # Each face once divided, so that there are vertices to be left out.
    for t in list(faces):
        faces.remove(t)
        points.append(tuple(sum(points[v][k] for v in t) / 3 + 0.1 * (k == 5) for k in range(3)))
        m = len(points) - 1
        faces += [[t[0], t[1], m], [t[1], t[2], m], [t[2], t[0], m]]
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "judge.py").write_text(JUDGE)
        mesh, script = folder / "case.off", folder / "case.script"
        mesh.write_text(f"OFF\n{len(points)} {len(faces)} 0\n" + "".join("%r %r %r\n" % p for p in points) + "".join("3 %d %d %d\n" % tuple(f) for f in faces))
        lines = [f"drag {draw.randrange(24, 32)} {40 + draw.random()} {draw.random()} {draw.random()}" for _ in range(60)]
        lines[37] = "drag 7 7 0.5 0.5"  # a corner of the first cube, into the third, through the second
        script.write_text("\n".join(lines) + "\n")
        command = f"{sys.executable} {folder / 'judge.py'} {SCULPT} {{mesh}} {{script}} {folder}"
        done = subprocess.run([sys.executable, str(ROOT / "benchmark/robustness/minimise"), SCULPT, str(mesh), str(script), "--out", str(folder / "small"),
                               "--command", command, "--exit", str(BLOCKED)], capture_output=True, text=True)
        print(f"seed {SEED}:", done.stdout.strip(), done.stderr.strip())
        faults = []
        if done.returncode != 0:
            faults.append(f"minimise ended with {done.returncode}")
        else:
            small = [line for line in (folder / "small.script").read_text().splitlines() if not line.startswith("#")]
            count = int((folder / "small.off").read_text().split()[2])
            if len(small) != 1 or not small[0].startswith("drag "):
                faults.append(f"{len(small)} lines are left: {small}")
            if count > 24:  # two tetrahedra at least; two cubes of 36 at most
                faults.append(f"{count} faces are left of {len(faces)}")
            again = subprocess.run([sys.executable, str(folder / "judge.py"), SCULPT, str(folder / "small.off"), str(folder / "small.script"), str(folder)])
            if again.returncode != BLOCKED:
                faults.append("the small case does not fail")
        kept = subprocess.run([sys.executable, str(ROOT / "benchmark/robustness/minimise"), SCULPT, str(mesh), str(script), "--out", str(folder / "no")],
                              capture_output=True, text=True)
        if kept.returncode != 1 or "does not fail" not in kept.stderr:
            faults.append(f"a case that keeps its promise: exit {kept.returncode}, {kept.stderr}")
        planted, other = folder / "planted", folder / "other.script"
        planted.write_text(PLANTED.replace("REAL", repr(SCULPT)))
        planted.chmod(0o755)
        other.write_text("# other broad phases lead elsewhere\n" + "\n".join(lines[30:42]) + "\n")
        for seconds, most in (("0", 1), ("1e-9", 12)):  # without a bound one line is left; with none to speak of all
            bits = subprocess.run([sys.executable, str(ROOT / "benchmark/robustness/minimise"), str(planted), str(mesh), str(other), "--out", str(folder / "bits"),
                                   "--seconds", seconds], capture_output=True, text=True)
            left = (folder / "bits.script").read_text().splitlines() if bits.returncode == 0 else []
            if not left or left[0] != "# other broad phases lead elsewhere" or sum(line.startswith("drag ") for line in left) != most:
                faults.append(f"other bits, {seconds} s: exit {bits.returncode}, {left}, {bits.stderr}")
        # Pushed once it goes up to what is in its way, pushed again it stays: on what the first has made of the mesh one
        # line is enough.
        mark = "# stays farther from its contact than 0x1p-99"
        pushes = folder / "pushes.script"
        pushes.write_text("\n".join(["response stop", *lines[:20], lines[37], *lines[20:30], f"{lines[37]} {mark}"]) + "\n")
        stays = subprocess.run([sys.executable, str(ROOT / "benchmark/robustness/minimise"), SCULPT, str(mesh), str(pushes),
                                "--out", str(folder / "stays")], capture_output=True, text=True)
        small = (folder / "stays.script").read_text().splitlines() if stays.returncode == 0 else []
        drags = [line for line in small if line.startswith("drag ")]
        if len(drags) != 1 or mark not in drags[0]:
            faults.append(f"a push that stays: exit {stays.returncode}, {small}, {stays.stderr}")
        wrong_use(folder, mesh, script, faults)
        killed(folder, mesh, script, faults)
        stopped(folder, mesh, lines, faults)
        places(folder, mesh, lines, faults)
        shifts(folder, mesh, lines, faults)
        print(*faults, sep="\n")
        return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
