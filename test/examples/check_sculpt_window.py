# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs sculpt_window under Xvfb as a hand would, replays its logs with sculpt, and looks at its screenshots.
Arguments: sculpt, sweep_queries (not used), source folder, sculpt_window."""
import colorsys
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from program_runs import SCULPT, SOURCE, check, end, run, write, bytes_of, points

WINDOW = os.path.abspath(sys.argv[4])
SKIPPED = 77  # what CMake takes for skipped
if shutil.which("Xvfb") is None:
    print("skipped: there is no Xvfb (Debian: xvfb), so no window can be opened without a display")
    sys.exit(SKIPPED)
try:
    import numpy
    from matplotlib.image import imread
except ImportError:
    print("skipped: screenshots are read by matplotlib (Debian: python3-matplotlib), which is not there")
    sys.exit(SKIPPED)

folder = tempfile.mkdtemp()
at = lambda name: os.path.join(folder, name)


def start_display():
    read, write_end = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1300x1000x24", "-nolisten", "tcp"],
                              pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    number = b""
    while not number.endswith(b"\n"):
        part = os.read(read, 16)
        if not part:
            print("skipped: Xvfb does not start")
            sys.exit(SKIPPED)
        number += part
    return server, ":" + number.decode().strip()


server, DISPLAY = start_display()


def start(*arguments, script="", display=DISPLAY):
    environment = dict(os.environ, LP_NUM_THREADS="1")
    environment.pop("DISPLAY", None)
    environment.pop("WAYLAND_DISPLAY", None)
    if display:
        environment["DISPLAY"] = display
    path = write(at("script.txt"), script)
    return subprocess.Popen([WINDOW, *map(str, arguments), "--script", path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            env=environment, cwd=folder)


def window(*arguments, script="", code=0, what="window", display=DISPLAY):
    process = start(*arguments, script=script, display=display)
    try:
        out, err = process.communicate(timeout=120)
    except subprocess.TimeoutExpired:
        process.kill()
        out, err = process.communicate()
        check(False, f"{what}: has not ended after 120 s: {out[-500:]} {err}")
        return [], err
    check(process.returncode == code, f"{what}: exit {process.returncode}, expected {code}: {err}")
    return [json.loads(line) for line in out.splitlines() if line.startswith("{")], err


def replayed(mesh, log, saved, what):
    """The log makes the same mesh again, bit for bit, by sculpt; and what was edited is not what was there."""
    done = run(mesh, "--log", log, "-o", at("again.off"))
    check(done.returncode == 0, f"{what}: sculpt does not replay the log: {done.stderr}")
    check(os.path.exists(saved) and bytes_of(saved) == bytes_of(at("again.off")), f"{what}: the replayed mesh is another one")
    check("blocked 0, " in done.stdout and "refused 0\n" in done.stdout, f"{what}: a line of the log is not made whole: {done.stdout[:500]}")


def off(vertices, faces):
    return "OFF\n%d %d 0\n" % (len(vertices), len(faces)) + "".join("%r %r %r\n" % tuple(v) for v in vertices) + \
        "".join("3 %d %d %d\n" % tuple(f) for f in faces)


def box(n, size=(2.0, 2.0, 2.0)):
    """A box about the origin, each side cut into n x n squares of two triangles."""
    number, faces = {}, []

    def vertex(i, j, k):
        return number.setdefault((i, j, k), len(number))

    def square(a, b, c, d):
        faces.extend([(a, b, c), (a, c, d)])

    for i in range(n):
        for j in range(n):
            square(*(vertex(x, y, n) for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))))
            square(*(vertex(x, y, 0) for x, y in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))))
            square(*(vertex(n, y, z) for y, z in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))))
            square(*(vertex(0, y, z) for y, z in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))))
            square(*(vertex(x, n, z) for x, z in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))))
            square(*(vertex(x, 0, z) for x, z in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))))
    return off([[s * (c / n - 0.5) for s, c in zip(size, v)] for v in number], faces)


def pixels_of(path, hue, spread=0.05):
    """Those whose hue is this, and not pale, as x and y from the upper left."""
    image = imread(path)[:, :, :3]
    high, low = image.max(axis=2), image.min(axis=2)
    chroma = high - low
    r, g, b = image[:, :, 0], image[:, :, 1], image[:, :, 2]
    with numpy.errstate(divide="ignore", invalid="ignore"):
        sector = numpy.where(high == r, ((g - b) / chroma) % 6, numpy.where(high == g, (b - r) / chroma + 2, (r - g) / chroma + 4)) / 6
    apart = numpy.abs((sector - hue + 0.5) % 1 - 0.5)
    y, x = numpy.nonzero((chroma > 0.35 * numpy.maximum(high, 1e-9)) & (chroma > 0.25) & (apart < spread))
    return numpy.stack([x + 0.5, y + 0.5], axis=1)


CONTACT = colorsys.rgb_to_hsv(0.93, 0.00, 0.60)[0]
FORCE = colorsys.rgb_to_hsv(0.00, 0.62, 0.12)[0]

# The box's faces are axis-aligned: what a probe pressed on its top has to say and to show is known without the program.
cube = write(at("cube.off"), box(4))
lines, _ = window(cube, "--log", at("probe.log"), script=f"""
key tab
view 0 1 -0.5
tool probe
depth 0.3
settle
screenshot {at("before.png")}
move @0.1,0.1,1
press left
settle
wait 0.1
settle
print
where @0,0,1
where @0,0,2
screenshot {at("probe.png")}
release
settle
print
quit
""", what="probe on a box")
if len(lines) == 4:
    held, foot, head, after = lines
    check(held["hold"] == "probe" and held["end"] == "held" and not held["reached"], f"the probe is held: {held}")
    check(len(held["contacts"]) == 1 and held["contacts"][0]["kind"] == "vertex-face", f"by one face: {held['contacts']}")
    proxy, target, force = held["proxy"], held["target"], held["force"]
    check(abs(proxy[2] - 1) < 1e-9 and abs(proxy[0] - 0.1) < 0.02, f"the proxy is on the top: {proxy}")
    depth = math.dist(target, (0.1, 0.1, 1))
    check(abs(depth - 0.3) < 0.02, f"the target is 0.3 below along the view: {target}")
    check(math.hypot(force[0], force[1]) < 1e-6 * force[2], f"the force is along the normal: {force}")
    for c in held["contacts"]:
        check(all(abs(p[2] - 1) < 1e-12 for p in c["points"]) and c["normal"][2] > 1 - 1e-12, f"the contact is the top: {c}")
    check(after["hold"] == "nothing" and after["edits"] == 0, f"a probe changes nothing: {after}")
    check(len(pixels_of(at("before.png"), CONTACT)) + len(pixels_of(at("before.png"), FORCE)) == 0, "without a contact there is none to see")
    arrow, marker = pixels_of(at("probe.png"), FORCE), pixels_of(at("probe.png"), CONTACT)
    check(len(arrow) > 100 and len(marker) > 50, f"{len(arrow)} pixels of the force, {len(marker)} of the contact")
    if len(arrow) > 100 and len(marker) > 50:
        # The normal is seen as the way from (0, 0, 1) to (0, 0, 2), nearly; the arrow by its longest axis.
        normal = numpy.array(head["where"]) - numpy.array(foot["where"])
        _, _, axes = numpy.linalg.svd(arrow - arrow.mean(axis=0), full_matrices=False)
        cosine = abs(axes[0] @ normal) / numpy.linalg.norm(normal)
        check(cosine > math.cos(math.radians(5)), f"the arrow is {math.degrees(math.acos(min(1, cosine))):.1f} degrees off the normal")
        check((arrow.mean(axis=0) - marker.mean(axis=0)) @ normal > 0, "the arrow points outwards")
        lowest = arrow[numpy.argmin(arrow @ normal)]
        check(numpy.min(numpy.linalg.norm(marker - lowest, axis=1)) < 12, "the arrow begins at the contact")
else:
    check(False, f"four lines were to be printed: {lines}")

# All that a hand can do, on meshes of different kinds; the log makes the same again.
MESHES = [("ball and moon", os.path.join(SOURCE, "examples/data/ball_and_moon.off")), ("box", cube)]
shared = os.path.join(SOURCE, "../shared/meshes")
if os.path.isdir(shared):
    MESHES += [(name, os.path.join(shared, name)) for name in sorted(os.listdir(shared))
               if name.endswith((".off", ".obj", ".ply")) and os.path.getsize(os.path.join(shared, name)) < 3000000]
WORK = """
key tab
settle
drag 600 430 760 300 12
drag 560 460 600 250 12 normal
tool create
drag 640 520 700 430 8
brush inflate {r} 1
drag 500 480 640 480 10
brush grab {r} 1
drag 600 450 700 380 10
brush smooth {r} 0.5
drag 560 420 640 470 6
brush flatten {r} 0.5
drag 620 420 560 470 6
brush pinch {r} 0.5
drag 620 460 580 430 6
key u
key u
key shift+u
tool remove
click 590 450
orbit 70 20
tool drag
drag 600 450 300 460 12
drag 610 440 900 440 12
key t
drag 580 470 600 900 12
settle
print
save {out}
settle
quit
"""
for name, mesh in MESHES:
    out, log = at("out.off"), at("work.log")
    for path in (out, log):
        if os.path.exists(path):
            os.remove(path)
    lines, err = window(mesh, "--log", log, "--size", 1200, 900, "--samples", 0, "--report", at("report.json"),
                        script=WORK.format(r=0.2, out=out), what=name)
    if lines:
        check(lines[0]["edits"] > 0, f"{name}: nothing was edited: {lines[0]}")
        replayed(mesh, log, out, name)
        report = json.load(open(at("report.json")))
        check(report["frames"] > 50 and report["frame_ns"]["p99"] >= report["frame_ns"]["p50"] > 0, f"{name}: frame times: {report}")
        check(report["ticks"] > 500, f"{name}: ticks: {report}")
        check(report["uploaded"]["faces"] > 0 and report["uploaded"]["bytes"] < 108 * (report["uploaded"]["faces"] + 1100 + lines[0]["faces"] // 8),
              f"{name}: uploads: {report['uploaded']}")

# A process that is killed loses nothing: its log makes what it had done, and the same command goes on from there.
BALL = os.path.join(SOURCE, "examples/data/ball_and_moon.off")
mesh = shutil.copy(BALL, at("killed.off"))
process = start(mesh, "--samples", 0, script=f"""
settle
drag 600 430 760 300 12
drag 560 460 600 250 12
settle
save {at("before_kill.off")}
settle
print
wait 100
""")
line = process.stdout.readline()
time.sleep(0.3)  # the log is written some milliseconds after the tick
process.send_signal(signal.SIGKILL)
process.communicate()
check(json.loads(line)["edits"] > 0 and os.path.exists(mesh + ".log"), "the log of a killed window is beside the mesh")
replayed(mesh, mesh + ".log", at("before_kill.off"), "killed")
lines, _ = window(mesh, "--samples", 0, "-o", at("resumed.off"), script=f"""
settle
print
close
settle
screenshot {at("asks.png")}
key escape
key s
settle
close
settle
""", what="resumed")
check(bytes_of(at("resumed.off")) == bytes_of(at("before_kill.off")), "what a killed window had done is there again")
check(not os.path.exists(mesh + ".log"), "a log that was not asked for is gone once the work is saved")
check(len(set(map(tuple, (imread(at("asks.png"))[300:600, 400:800, :3] * 255).astype(int).reshape(-1, 3)))) > 20, "unsaved work is asked about")

# Refusals, errors, recordings.
lines, _ = window(BALL, "--no-log", "--samples", 0, "--record", at("recorded.actions"), script=f"""
settle
tool drag
move 5 5
press left
settle
print
release
key u
settle
print
wait 0.1
move 600 450
press left
move 640 420
settle
release
settle
save {at("recorded.off")}
settle
quit
""", what="refusals")
check(len(lines) == 2 and "nothing to take hold of" in lines[0]["refused"] and "nothing-to-undo" in lines[1]["refused"], f"refusals: {lines}")
recorded = open(at("recorded.actions")).read()
check("press left" in recorded and "wait 0." in recorded, f"a recording: {recorded}")
window(BALL, "--no-log", "--samples", 0, script=recorded + f"settle\nsave {at('played.off')}\nsettle\nquit\n", what="a recording played")
check(os.path.exists(at("played.off")) and points(at("played.off")) != points(BALL), "a recording sculpts when played")
for script, part in (("fly 1 2 3\n", "line 1: 'fly'"), ("\nkey f99\n", "line 2: 'f99'"), ("move 1\n", "is expected"), ("drag 1 2 3 4 0\n", "steps")):
    _, err = window(BALL, "--no-log", script=script, code=4, what=script)
    check(part in err, f"{script!r}: {err}")
_, err = window(at("nowhere.off"), "--no-log", script="quit\n", code=3, what="no mesh")
check("nowhere.off" in err, f"no mesh: {err}")
_, err = window(cube, "--log", at("work.log"), script="quit\n", code=6, what="the log of another mesh")
_, err = window(BALL, "--no-log", script="quit\n", code=7, display=None, what="no display")
check("DISPLAY" in err, f"no display: {err}")
check(window(BALL, "--no-log", "--samples", 0, "--screenshot", at("last.png"))[1] == "" and imread(at("last.png")).std() > 0.05, "--screenshot")
for option in ("--help", "--version"):
    done = subprocess.run([WINDOW, option], capture_output=True, text=True)
    check(done.returncode == 0 and "sculpt_window" in done.stdout, option)
described = open(os.path.join(SOURCE, "doc/window.md")).read()
help_text = subprocess.run([WINDOW, "--help"], capture_output=True, text=True).stdout
for action in ("move", "press", "release", "click", "drag", "scroll", "key", "view", "orbit", "zoom", "fit", "tool", "brush", "depth", "wait", "settle",
               "screenshot", "save", "open", "record", "print", "where", "close", "quit"):
    check(f"`{action}" in described and f" {action}" in help_text, f"the action {action} is described")

# A file that is opened in place of another; the log of the first one stays, for it has what was not saved.
second = shutil.copy(cube, at("second.off"))
lines, _ = window(mesh, "--samples", 0, script=f"""
settle
drag 600 430 700 350 6
open {second}
settle
open {second}
settle
print
quit
""", what="opening")
check(len(lines) == 1 and lines[0]["faces"] == 192 and lines[0]["edits"] == 0, f"another mesh is opened: {lines}")
check(os.path.exists(mesh + ".log") and not os.path.exists(second + ".log"), "the log of unsaved work stays")

server.terminate()
server.wait()
end()
