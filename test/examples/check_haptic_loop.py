# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks haptic_loop as a user would run it: trace, report, replay, faults and exit codes. Arguments:
sculpt, source folder, haptic_loop."""
import atexit
import csv
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import program_runs
from program_runs import FURTHER as LOOP, SOURCE, check, end, points

MESH = os.path.join(SOURCE, "examples/data/ball_and_moon.off")
COLUMNS = "t,theta1,theta2,theta3,tx,ty,tz,x,y,z,fcx,fcy,fcz,fx,fy,fz,tau1,tau2,tau3,end,contacts,pairs,cpu_ns".split(",")
KEYS = {"version", "ticks", "missed", "missed_by_cpu", "cpu_ns", "wall_ns", "wakeup_ns", "allocations", "force", "energy", "limits", "edits",
        "faults", "valid"}


def run(*arguments, code=0):
    done = program_runs.run(*arguments, program=LOOP, seconds=3 * program_runs.PATIENCE)
    check(done.returncode == code, f"{arguments}: exit {done.returncode}, expected {code}: {done.stderr}")
    return done


def rows_of(path):
    with open(path) as file:
        reader = csv.DictReader(file)
        check(reader.fieldnames == COLUMNS, f"columns of the trace: {reader.fieldnames}")
        return list(reader)


def vector(row, *names):
    return [float(row[name]) for name in names]


folder = tempfile.mkdtemp()
atexit.register(shutil.rmtree, folder, True)
at = lambda name: os.path.join(folder, name)

# What OUT loses is said once, as sculpt says it; nothing where nothing is lost.
LINES = [line for line in open(MESH).read().split("\n") if line]
COUNT = int(LINES[1].split()[0])
with open(at("coloured.off"), "w") as file:
    file.write("\n".join(["COFF", LINES[1], *(line + " 255 0 0" for line in LINES[2:2 + COUNT]), *LINES[2 + COUNT:]]))
COLOURED = at("coloured.off")
with open(at("coloured.obj"), "w") as file:
    file.write("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0.1 0.1 1 1 1 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
for mesh, out, loses in ((COLOURED, "lost.off", True), (COLOURED, "", False), (at("coloured.obj"), "lost.off", True),
                         (at("coloured.obj"), "kept.ply", False), (at("coloured.obj"), "kept.obj", False), (MESH, "kept.off", False)):
    done = run(mesh, "--no-wait", "--seconds", 0.02, "--report", at("lost.json"), *(["-o", at(out)] if out else []))
    notes = json.load(open(at("lost.json")))["notes"]
    check(("besides its faces: colours" in done.stderr) == loses and done.stderr.count("besides") == loses, f"what {mesh} loses in '{out}': {done.stderr}")
    check(any("colours" in note for note in notes) == loses, f"notes: {notes}")

run(MESH, "--no-wait", "-o", at("a.off"), "--report", at("a.json"), "--trace", at("a.csv"), "--record", at("a.rec"), "--picture", at("a.png"))
check(open(at("a.png"), "rb").read(8) == b"\x89PNG\r\n\x1a\n", "a picture")
DRAW = os.path.join(SOURCE, "examples/haptic_loop/draw_trace.py")
done = subprocess.run([sys.executable, DRAW, at("a.csv"), at("plots.png")], capture_output=True, text=True)
if "No module named 'matplotlib'" in done.stderr:
    print("skipped: the plots of a trace, because python3-matplotlib is not installed")
else:
    check(done.returncode == 0 and open(at("plots.png"), "rb").read(8) == b"\x89PNG\r\n\x1a\n", f"plots of a trace: {done.stderr}")
    refused = subprocess.run([sys.executable, DRAW, at("a.json"), at("none.png")], capture_output=True, text=True)
    check(refused.returncode == 2 and "there is no column 't'" in refused.stderr,
          f"what is no trace is refused: {refused.stderr}")
numbers = [line.split() for line in open(MESH).read().split("\n") if line and not line.startswith("#")]
corners = 2 + int(numbers[1][0])
with open(at("coloured.obj"), "w") as file:
    file.write("vn 0 0 1\n" + "".join(f"v {' '.join(p)} 0.5 0.25 1\n" for p in numbers[2:corners])
               + "".join("f " + " ".join(str(int(v) + 1) for v in f[1:4]) + "\n" for f in numbers[corners:]))
told = run(at("coloured.obj"), "--no-wait", "--seconds", 0.1, "-o", at("coloured.off")).stderr
check("normals, colours" in told, f"what the result is without: {told}")
told = run(at("coloured.obj"), "--no-wait", "--seconds", 0.1, "-o", at("coloured.ply")).stderr
check("normals" in told and "colours" not in told, f"PLY holds colours: {told}")
report = json.load(open(at("a.json")))
check(KEYS <= set(report), f"keys of the report: {sorted(report)}")
check(report["valid"] is True and report["faults"] == [], "the run is valid and has no faults")
check(set(report["cpu_ns"]) == {"p50", "p99", "p999", "p9999", "max"}, "percentiles")
check({"port", "dissipated", "observer"} <= set(report["energy"]), "energies")
check(report["energy"]["port"] + report["energy"]["dissipated"] > 0, "the device gives no energy")
check(report["limits"]["passive_k"] > 500, "the default is passive")
# A handle has friction / sigma^2, and moves by encoder step * sigma in a count, both at the worst pose.
limits, encoder_step = report["limits"], report["settings"]["device"]["encoder_step"]
check(limits["stable_k"] is None, f"there is no stable limit any more: {limits}")
sigma = math.sqrt(report["settings"]["device"]["friction"] / limits["friction"])
check(abs(limits["calm_k"] * math.sqrt(3) * encoder_step * sigma / 0.1 - 1) < 1e-9, f"the calm limit: {limits}")
check(report["allocations"] == 0, f"{report['allocations']} allocations after the start")
check(all(time is not None for time in report["happened"].values()) and len(report["happened"]) == 10, f"happened: {report['happened']}")
edits = report["edits"]
check(edits["grabbed"] >= 1 and edits["created"] >= 1 and edits["removed"] >= 1 and edits["refused"] >= 1, f"edits: {edits}")
rows = rows_of(at("a.csv"))
check(len(rows) == report["ticks"], "a row a tick")
check({row["end"] for row in rows} >= {"reached", "held"}, "free motion and contact")
scale, stiffness, touching = report["map"][0], report["settings"]["stiffness"], 0
for row in rows:  # the fitted map is not turned
    target, proxy, coupling = vector(row, "tx", "ty", "tz"), vector(row, "x", "y", "z"), vector(row, "fcx", "fcy", "fcz")
    wanted = [stiffness * (x - t) / scale for x, t in zip(proxy, target)]
    check(math.dist(wanted, coupling) <= 1e-9 * max(1e-3, math.hypot(*wanted)), f"coupling force at {row['t']}")
    if row["end"] == "reached":
        check(coupling == [0, 0, 0], f"no force in free motion at {row['t']}")
    touching += row["end"] != "reached"
check(touching > 500, f"touching in {touching} ticks")
told = run(MESH, "--no-wait", "--rate", 10000, "--stiffness", 1.001 * limits["calm_k"], code=7).stderr
check("not calm" in told and f" {int(limits['calm_k'])}." in told, f"at a high rate counts bound it: {told}")
run(MESH, "--no-wait", "--rate", 10000, "--stiffness", 0.999 * limits["calm_k"], "--seconds", 0.01,
    "--report", at("k.json"))
high = json.load(open(at("k.json")))["limits"]
check(high["calm_k"] == limits["calm_k"] < high["passive_k"] and high["stable_k"] is None, f"limits at 10 kHz: {high}")
with open(at("exact.json"), "w") as file:
    json.dump({**report["settings"]["device"], "encoder_step": 0}, file)
run(MESH, "--no-wait", "--device", at("exact.json"), "--seconds", 0.01, "--report", at("e.json"))
check(json.load(open(at("e.json")))["limits"]["calm_k"] is None, "exact angles are calm at any stiffness")
print("report:", {key: report[key] for key in ("ticks", "cpu_ns", "allocations", "force", "energy", "limits", "edits", "missed_by_cpu")})

run(MESH, "--replay", at("a.rec"), "-o", at("b.off"), "--trace", at("b.csv"))
check(open(at("a.off")).read() == open(at("b.off")).read(), "a replay has the same mesh")
strip = lambda rows: [[row[name] for name in COLUMNS if name != "cpu_ns"] for row in rows]
check(strip(rows) == strip(rows_of(at("b.csv"))), "a replay has the same forces")
with open(at("a.rec")) as recording, open(at("cut.rec"), "w") as cut:
    cut.write(recording.read()[:-3])
cut = run(MESH, "--replay", at("cut.rec"), "--trace", at("cut.csv"))
check("ends within a reading" in cut.stderr, f"a recording that was cut: {cut.stderr}")
check(strip(rows[:-1]) == strip(rows_of(at("cut.csv"))), "it is replayed as far as it goes")

for kind in ("nan", "jump", "stall", "singular", "torque"):
    run(MESH, "--no-wait", "--fault", kind + "@1.2", "--report", at("f.json"), "--trace", at("f.csv"),
        "--record", at("f.rec"), "-o", at("f.off"), code=8)
    run(MESH, "--replay", at("f.rec"), "--report", at("fr.json"), "--trace", at("fr.csv"), code=8)
    report = json.load(open(at("f.json")))
    check(strip(rows_of(at("f.csv"))) == strip(rows_of(at("fr.csv"))), f"{kind}: a replay has the same trace")
    check(json.load(open(at("fr.json")))["faults"] == report["faults"], f"{kind}: a replay has the same fault")
    check([fault["what"] for fault in report["faults"]] == [kind], f"{kind}: {report['faults']}")
    check(report["valid"] is True, f"{kind}: the mesh is valid")
    last = rows_of(at("f.csv"))[-1]
    check(vector(last, "fx", "fy", "fz", "tau1", "tau2", "tau3") == [0] * 6, f"{kind} ends at zero")

# A log that fails lets go in the run; no reading after that is replayed.
run(MESH, "--no-wait", "--log", at("failed.log"), "--fault", "log@1.2", "--record", at("l.rec"), "-o", at("l.off"),
    code=8)
run(MESH, "--replay", at("l.rec"), "-o", at("lr.off"))
check(open(at("l.off")).read() == open(at("lr.off")).read(), "a replay of a run whose log failed has the same mesh")

# A stiff and fast loop, on which a finger comes down 30 mm in 0.1 s: calm after half a second, or refused or a fault by
# name; it gives no energy.
open(at("finger.json"), "w").write('{"name": "finger"}')
with open(at("down.csv"), "w") as file:
    places = ((0, 0.15508), (0.4, 0.15508), (0.5, 0.12508), (1.2, 0.12508))  # s, m
    file.write("t,x,y,z,button\n" + "".join(f"{t},-0.00898,-0.00003,{z},0\n" for t, z in places))
done = program_runs.run(MESH, "--no-wait", "--rate", 4000, "--stiffness", 2300, "--hand", at("finger.json"),
                        "--path", at("down.csv"), "--trace", at("d.csv"), "--report", at("d.json"), program=LOOP,
                        seconds=3 * program_runs.PATIENCE)
check(done.returncode in (0, 7, 8), f"a finger that comes down: exit {done.returncode}: {done.stderr}")
if done.returncode == 7:
    check("is not passive" in done.stderr or "is not calm" in done.stderr, f"refused by name: {done.stderr}")
else:
    report = json.load(open(at("d.json")))
    energy, faults = report["energy"], [fault["what"] for fault in report["faults"]]
    check(energy["is_true"] and energy["port"] + energy["dissipated"] >= -1e-3, f"a finger is given energy: {energy}")
    forces = [(float(row["t"]), math.hypot(*vector(row, "fx", "fy", "fz"))) for row in rows_of(at("d.csv"))]
    check(max(force for _, force in forces) > 0.5, "the finger has touched")
    late = [force for t, force in forces if t >= 1.0]  # it has come down at 0.5
    check((done.returncode == 8) == bool(faults), f"a fault has a name: {faults}")
    swing = max(late, default=0) - min(late, default=0)
    check(faults or (late and swing <= 0.1), f"not calm: {swing} N peak to peak")
    print("a finger that comes down:", energy, faults, f"{swing:.3f} N peak to peak")

# So little work that a drag cannot tell what is there: no force, and the trace says why.
run(MESH, "--no-wait", "--work", 1, "--seconds", 1.5, "--trace", at("w.csv"), "-o", at("w.off"))
starved = [row for row in rows_of(at("w.csv")) if row["end"] == "starved"]
check(starved, "no drag was starved")
check(all(vector(row, "fcx", "fcy", "fcz") == [0, 0, 0] and row["contacts"] == "0" for row in starved),
      "where work runs out nothing pushes")

# The log's thread does not come: the run ends in order, what is not in the log is not older than 100 ms. (Without waiting, the thread
# may be some ticks behind before.)
done = run(MESH, "--no-wait", "--log", at("g.log"), "--fault", "log@4.7", "--report", at("g.json"),
           "--trace", at("g.csv"), "-o", at("g.off"), code=8)
report = json.load(open(at("g.json")))
check("g.log' lacks the last edits" in done.stderr and any("lacks the last edits" in note for note in report["notes"]),
      f"it is said that the log ends earlier: {done.stderr}")
check([fault["what"] for fault in report["faults"]] == ["log"] and report["valid"] is True and report["log"]["lost"] > 0, f"log: {report['faults']}")
check(4.73 <= report["faults"][0]["t"] <= 4.81, f"within 100 ms of the log's thread: {report['faults']}")
check(vector(rows_of(at("g.csv"))[-1], "fx", "fy", "fz", "tau1", "tau2", "tau3") == [0] * 6, "log ends at zero")
lines = open(at("g.log")).read().split("\n")
check(lines[-1] == "" and lines[-2].startswith("# tick ") and 4630 <= int(lines[-2].split()[2]) <= 4701, f"the log ends at a tick: {lines[-2:]}")
# A disk that takes no more: the run ends, too, and says what the log has.
done = program_runs.run(MESH, "--no-wait", "--log", at("cut.log"), "--report", at("cut.json"), program=LOOP,
                        limit=20000)
report = json.load(open(at("cut.json")))
written = open(at("cut.log")).read().count("\n# tick ") - 1  # one ends the head
check(done.returncode == 5 and "lacks the last edits" in done.stderr,
      f"a disk that takes no more: exit {done.returncode}: {done.stderr}")
check([fault["what"] for fault in report["faults"]] == ["log"] and report["log"]["lost"] > 0 and
      report["log"]["ticks"] == written > 0, f"what the log has: {written} ticks, {report['log']}, {report['faults']}")
# The same where the run ends before anybody notices.
last = max(int(line.split()[2]) for line in lines if line.startswith("# tick ")) / 1000
done = run(MESH, "--no-wait", "--seconds", last + 0.02, "--log", at("short.log"), "--fault", f"log@{last - 0.02}",
           "--report", at("short.json"), "-o", at("short.off"), code=5)
lost = json.load(open(at("short.json")))["log"]["lost"]
check("short.log' lacks the last edits" in done.stderr and lost > 0, f"it is said: {done.stderr}")
check(" done # " not in open(at("short.log")).read(), "a log that lacks edits says that it is whole")
# Noticed in the last tick, or behind it: a log that lacks edits is never a run without a fault.
done = program_runs.run(MESH, "--seconds", 4.8, "--log", at("last.log"), "--fault", "log@4.7", "--report", at("last.json"),
                        program=LOOP)
check(done.returncode in (5, 8) and "lacks the last edits" in done.stderr, f"exit {done.returncode}: {done.stderr}")
# A vertex that was created beside one that was created is of that part, too: pushed into another one, it is said.
corners = [(-2, -2, 0), (2, -2, 0), (0, 2, 0), (0, 0, -2), (-3, -3, 1), (3, -3, 1), (0, 3, 1), (0, 0, 3)]
with open(at("two.off"), "w") as file:
    file.write("OFF\n8 8 0\n" + "".join("%g %g %g\n" % place for place in corners) +
               "3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n")
HOME, time_of_row, rows = 0.13238963483516536, 0, []  # m: of the handle
for seconds, y, z, button in ((0, 0, 0.5, 0), (0.4, -0.6, 0.3, 0), (0.4, -0.6, -0.15, 0), (0.1, -0.6, -0.15, 0),
                              (0.01, -0.6, -0.15, 1), (0.1, -0.6, -0.15, 1), (0.01, -0.6, -0.15, 0),
                              (0.1, -0.6, -0.15, 0), (0.4, -0.6, 0.3, 0), (0.4, 0.5, 0.3, 0), (0.4, 0.5, -0.15, 0),
                              (0.1, 0.5, -0.15, 0), (0.01, 0.5, -0.15, 1), (0.1, 0.5, -0.15, 1), (1, 0.5, 1.6, 1),
                              (0.3, 0.5, 1.6, 1)):
    time_of_row += seconds
    rows.append(f"{time_of_row:.4f},0,{y / 100:.6f},{HOME + (z - 0.5) / 100:.6f},{button}\n")
with open(at("twice.csv"), "w") as file:
    file.write("t,x,y,z,button\n" + "".join(rows))
run(at("two.off"), "--no-wait", "--path", at("twice.csv"), "--map", 100, 0, 0, 0.5, "--stiffness", 300,
    "--report", at("twice.json"))
report = json.load(open(at("twice.json")))
check(report["edits"]["created"] == 2 and report["happened"]["pushed_into_another_part"],
      f"pushed: {report['happened']}")
# A pause is not made up for by ticks that follow each other at once, which would be more than the log can take.
with open(at("early.csv"), "w") as file:  # where the hand holds a vertex for long
    head, *path = open(os.path.join(SOURCE, "examples/data/hand_path.csv")).read().split()
    timed = [(float(t), place) for t, place in (row.split(",", 1) for row in path)]
    file.write("\n".join([head] + [f"{t - 3.5},{place}" for t, place in timed if t >= 3.5]))


def run_with_a_pause():
    if os.path.exists(at("pause.log")):
        os.remove(at("pause.log"))
    process = subprocess.Popen([LOOP, MESH, "--rate", "100", "--stiffness", "50", "--path", at("early.csv"),
                                "--seconds", "2", "--log", at("pause.log"), "-o", at("pause.off"),
                                "--report", at("pause.json"), "--trace", "/dev/stdout"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for _ in range(130):
        process.stdout.readline()
    process.send_signal(signal.SIGSTOP)
    time.sleep(1.5)
    process.send_signal(signal.SIGCONT)
    words = process.communicate(timeout=3 * program_runs.PATIENCE)[1]
    return process.returncode, words


for attempt in range(3):  # a busy machine may keep the log's thread waiting, too
    code, words = run_with_a_pause()
    if code == 0:
        break
check(code == 0, f"a pause: exit {code}: {words}")
report = json.load(open(at("pause.json")))
check(report["missed_by_wakeup"] >= 100 and report["wakeup_ns"]["max"] >= 1e9,
      f"a pause in the report: {report['missed_by_wakeup']}, {report['wakeup_ns']}")
done = program_runs.run(MESH, "--log", at("pause.log"), "-o", at("again.off"))
check(done.returncode == 0, f"the log of a run with a pause: {done.stderr}")
check(points(at("again.off")) == points(at("pause.off")) != points(MESH), "the log of a run with a pause has all edits")
endless = subprocess.Popen([LOOP, MESH, "--seconds", "1e24", "--log", at("endless.log"), "-o", at("endless.off")],
                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
for _ in range(10 * program_runs.PATIENCE):
    if os.path.exists(at("endless.log")) or endless.poll() is not None:
        break
    time.sleep(0.1)
endless.send_signal(signal.SIGINT)
try:
    words = endless.communicate(timeout=program_runs.PATIENCE)[1]
except subprocess.TimeoutExpired:
    endless.kill()
    words = endless.communicate()[1] + "it goes on"
check(endless.returncode == 0 and os.path.exists(at("endless.off")), f"10^24 s: exit {endless.returncode}: {words}")
done = run(MESH, "--real-time", "--seconds", 0.3)
check("haptic_loop: " in done.stderr or os.geteuid() == 0, f"real time, or why not: {done.stderr}")
run(MESH, "--real-time", "--no-wait", code=2)

# What serves is done and replayed, with forces of its own; what is larger is refused by name, with the largest that serves.
largest = json.load(open(at("a.json")))["limits"]
ours = ["--virtual-mass", 0.99 * largest["largest_mass"], "--controller", 0.99 * largest["largest_controller"], "--damping", 0.1]
run(MESH, "--no-wait", *ours, "-o", at("m.off"), "--report", at("m.json"), "--trace", at("m.csv"), "--record", at("m.rec"))
report = json.load(open(at("m.json")))
check(report["valid"] is True and report["faults"] == [] and report["allocations"] == 0, f"virtual mass: {report['faults']}")
check(report["energy"]["virtual_mass"] != 0, f"energies: {report['energy']}")
run(MESH, "--replay", at("m.rec"), "-o", at("n.off"), "--trace", at("n.csv"))
check(strip(rows_of(at("m.csv"))) == strip(rows_of(at("n.csv"))), "a replay has the same virtual mass")
check(open(at("m.off")).read() == open(at("n.off")).read(), "a replay has the same mesh")
for option, key in (("--virtual-mass", "largest_mass"), ("--controller", "largest_controller"), ("--damping", "largest_b")):
    told = run(MESH, "--no-wait", option, 1.01 * largest[key], code=7).stderr
    check("not stable" in told and f"{largest[key]:.4g}"[:4] in told, f"{option} is refused with what serves: {told}")
# Drawn to vertices, the hand feels more forces, none above the limit; the snap counts as stiffness, and is in a recording.
run(MESH, "--no-wait", "--snap", 0.004, 0.1, "--trace", at("s.csv"), "--record", at("s.rec"), "--report", at("s.json"), "-o", at("s.off"))
report = json.load(open(at("s.json")))
check(report["faults"] == [] and report["allocations"] == 0, f"snap: {report['faults']}, {report['allocations']} allocations")
drawn = [row for row in rows_of(at("s.csv")) if 0.05 < sum(x * x for x in vector(row, "fx", "fy", "fz")) ** 0.5 <= 0.1 + 1e-9]
check(drawn, "no vertex draws the hand")
run(MESH, "--replay", at("s.rec"), "--trace", at("t.csv"))
check(strip(rows_of(at("s.csv"))) == strip(rows_of(at("t.csv"))), "a replay has the same snap")
check("is not passive" in run(MESH, "--no-wait", "--snap", 0.004, 10, code=7).stderr, "a snap too steep is refused")
run(MESH, "--no-wait", "--snap", -1, code=2)
run(MESH, "--no-wait", "--virtual-mass", "nan", code=2)
run(MESH, "--no-wait", "--stiffness", 100000, code=7)
run(MESH, "--nonsense", code=2)
run(MESH, "--no-wait", "--rate", 5, code=2)
run(MESH, "--no-wait", "--fault", "fire@1", code=2)
for x in (1, 3e6, 1e9):
    open(at("far.csv"), "w").write(f"t,x,y,z,button\n0,{x},0,0.1,0\n1,0,0,0.1,0\n")
    far = run(MESH, "--no-wait", "--path", at("far.csv"), code=2)
    check("cannot come to where the path begins" in far.stderr, f"a path that begins {x} m off: {far.stderr}")
open(at("device.json"), "w").write('{"form": "general", "params": {"R": 0.03}}')
run(MESH, "--no-wait", "--device", at("device.json"), code=2)
open(at("massless.json"), "w").write('{"R": 0.03, "l1": 0.07, "l2": 0.1, "m1": 0, "m2": 0, "M": 0}')
check("no mass" in run(MESH, "--no-wait", "--device", at("massless.json"), code=2).stderr, "a device without a mass")
open(at("hand.json"), "w").write('{"name": "arm", "mass": [5]}')
check("nothing else" in run(MESH, "--no-wait", "--hand", at("hand.json"), code=2).stderr, "a hand with a name and more")
open(at("hand.json"), "w").write('{"mass": [0.2], "stiffness": [300], "damping": [3], "stifness": [5]}')
check("`stifness`" in run(MESH, "--no-wait", "--hand", at("hand.json"), code=2).stderr, "a key that is misspelt")
open(at("deep.json"), "w").write('{"params":' * 50000 + "1" + "}" * 50000)
deep = run(MESH, "--no-wait", "--device", at("deep.json"), code=2)
check("nested more than 32 deep" in deep.stderr, "deep nesting is refused")
check("longer than 1 MiB" in run(MESH, "--replay", "/dev/zero", code=6).stderr, "a recording without end is refused")
open(at("open.off"), "w").write("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
run(at("open.off"), "--no-wait", code=3)
open(at("path.csv"), "w").write("t,x,y,z,button\n0,0,0,x,0\n")
check("line 2, column 7" in run(MESH, "--no-wait", "--path", at("path.csv"), code=4).stderr, "a bad path is known by line and column")
open(at("path.csv"), "w").write("t,x,y,z,button\n0,0,0,0.1,0\n")
check("--seconds" in run(MESH, "--no-wait", "--path", at("path.csv"), code=2).stderr, "a path without a tick")
run(MESH, "--no-wait", "--path", at("path.csv"), "--seconds", 0.01)
open(at("path.csv"), "w").write("t,x,y,z,button\n0,0,0,0.1,3\n")
refused = run(MESH, "--no-wait", "--path", at("path.csv"), code=4).stderr
check("line 2, column 11" in refused, f"which column the button is in: {refused}")
run(MESH, "--no-wait", "-o", at("missing/a.off"), code=5)
run(at("a.off"), "--replay", at("a.rec"), code=6)
# The general form's pose is found from where the path begins, which only the head of a recording says.
general = {"form": "general", "R": 0.03, "l1": 0.07, "l2": 0.1, "r": 0.02, "m1": 0.004, "m2": 0.004, "M": 0.02,
           "friction": 0.005, "coulomb": 0.0005, "encoder_step": 0.000153}
open(at("general.json"), "w").write(json.dumps(general))
open(at("early.csv"), "w").write("t,x,y,z,button\n0,-0.00898,-0.00003,0.15508,1\n"
                                 "0.05,-0.00898,-0.00003,0.15508,1\n0.3,0.004,0.011,0.145,1\n")
run(MESH, "--no-wait", "--device", at("general.json"), "--path", at("early.csv"), "--reach", 0.1,
    "--record", at("general.rec"), "--trace", at("g.csv"), "-o", at("g.off"))
run(MESH, "--replay", at("general.rec"), "--trace", at("h.csv"), "-o", at("h.off"))
check(strip(rows_of(at("g.csv"))) == strip(rows_of(at("h.csv"))), "the general form replayed has the same forces")
check(open(at("g.off")).read() == open(at("h.off")).read() != open(MESH).read(), "the general form has the same mesh")
# What options could not have given is not taken from a recording either; one without the beginning is an older one.
head, *readings = open(at("a.rec")).read().split("\n")
for key, value, code in (("map", [1, 1e9, 0, 0], 6), ("map", [1, 0, 0, 0, 1e300, 1e300, 1e300], 6),
                         ("begin", [0, 0, 5], 6), ("begin", [0, "x", 0], 6), ("begin", None, 0)):
    changed = json.dumps({**json.loads(head), key: value})
    open(at("other.rec"), "w").write("\n".join([changed, *readings[:20]]) + "\n")
    refused = run(MESH, "--replay", at("other.rec"), code=code).stderr
    check(code == 0 or "recording" in refused, f"a recording whose {key} is {value}: {refused}")
run(at("a.off"), "--log", at("g.log"), "--no-wait", code=6)
run(MESH, "--log", at("g.log"), "--record", at("g.rec"), "--no-wait", code=2)
# A log that sculpt has written is made again with all its lines, objects that are moved included.
moved = ("--script", "/dev/stdin", "--log", at("moved.log"), "-o", at("moved.off"))
check(program_runs.run(MESH, *moved, script="move 0 0 0 -0.25\n").returncode == 0, "an object is moved")
run(MESH, "--log", at("moved.log"), "--no-wait", "--seconds", "0.01", "-o", at("again.off"))
check(points(at("again.off")) == points(at("moved.off")) != points(MESH), "the loop makes it another mesh")
# Nothing is emptied where the log is refused.
open(at("part.log"), "wb").write(b"".join(open(at("moved.log"), "rb").read().splitlines(True)[:3]))
for name in ("kept.csv", "kept.rec"):
    open(at(name), "w").write("kept")
run(MESH, "--log", at("part.log"), "--trace", at("kept.csv"), "--record", at("kept.rec"), "--no-wait", code=6)
check(open(at("kept.csv")).read() == open(at("kept.rec")).read() == "kept", "what was there before stays")
# A log that is removed or changed while it is written is not passed off as one.
for which, spoil in (("removed", os.remove), ("changed", lambda path: os.truncate(path, 0))):
    log = at(f"{which}.log")
    process = subprocess.Popen([LOOP, MESH, "--seconds", "5", "--log", log], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    until = time.monotonic() + program_runs.PATIENCE
    while not (os.path.exists(log) and b"# tick 0" in open(log, "rb").read()) and time.monotonic() < until:
        time.sleep(0.01)
    spoil(log)
    words = process.communicate(timeout=program_runs.PATIENCE)[1]
    check(process.returncode == 5 and "moved away, or changed" in words,
          f"a log that is {which}: exit {process.returncode}: {words}")
for option in (("--fault", "nan@0.1"), ("--seconds", "0.1"), ("--path", "other.csv"), ("--stiffness", "100")):
    run(MESH, "--replay", at("a.rec"), *option, code=2)
end()
