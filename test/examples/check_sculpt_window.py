# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs sculpt_window under Xvfb as a hand would, replays its logs with sculpt, and looks at its screenshots.
Arguments: sculpt, source folder, sculpt_window."""
import colorsys
import json
import math
import os
import shutil
import signal
import subprocess
import time

from box_mesh import box
from program_runs import PATIENCE, SOURCE, TETRAHEDRON, bytes_of, check, end, points, run, write
from window_runs import WINDOW, at, pixels_of, read_png, replayed, start, window


def mean(points):
    return tuple(sum(c) / len(points) for c in zip(*points))


def axis(points):
    """The angle of the longest axis of a set of pixels."""
    mx, my = mean(points)
    xx, yy, xy = (sum(f(x - mx, y - my) for x, y in points) for f in (lambda a, b: a * a, lambda a, b: b * b, lambda a, b: a * b))
    return math.atan2(2 * xy, xx - yy) / 2


BALL = os.path.join(SOURCE, "examples/data/ball_and_moon.off")
CONTACT = colorsys.rgb_to_hsv(0.93, 0.00, 0.60)[0]
FORCE = colorsys.rgb_to_hsv(0.00, 0.62, 0.12)[0]

# The box's faces are axis-aligned: what a probe pressed on its top has to say and to show is known without the program.
cube = write(at("cube.off"), box(4))
lines, _ = window(cube, "--log", at("probe.log"), "--size", 640, 480, script=f"""
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
where @0.1,{0.1 + 0.3 / math.sqrt(1.25)},1
screenshot {at("probe.png")}
release
settle
print
quit
""", what="probe on a box")
if len(lines) == 5:
    held, foot, head, place, after = lines
    check(held["hold"] == "probe" and held["end"] == "held" and not held["reached"], f"the probe is held: {held}")
    check(len(held["contacts"]) == 1 and held["contacts"][0]["kind"] == "vertex-face", f"by one face: {held['contacts']}")
    proxy, target, force = held["proxy"], held["target"], held["force"]
    # Pressed in by 0.3 along (0, 1, -0.5), and from there to the nearest point of the top.
    expected = (0.1, 0.1 + 0.3 / math.sqrt(1.25), 1 - 0.15 / math.sqrt(1.25))
    check(math.dist(target, expected) < 1e-9, f"the target is {target}, expected {expected}")
    check(math.dist(proxy, (*expected[:2], 1)) < 1e-9, f"the proxy is {proxy}, expected above {expected}")
    check(math.hypot(force[0], force[1]) < 1e-6 * force[2], f"the force is along the normal: {force}")
    for c in held["contacts"]:
        check(all(abs(p[2] - 1) < 1e-12 for p in c["points"]) and c["normal"][2] > 1 - 1e-12, f"the contact is the top: {c}")
    check(after["hold"] == "nothing" and after["edits"] == 0, f"a probe changes nothing: {after}")
    check(len(pixels_of(at("before.png"), CONTACT)) + len(pixels_of(at("before.png"), FORCE)) == 0, "without a contact there is none to see")
    arrow, marker = pixels_of(at("probe.png"), FORCE), pixels_of(at("probe.png"), CONTACT)
    check(len(arrow) > 100 and len(marker) > 50, f"{len(arrow)} pixels of the force, {len(marker)} of the contact")
    if len(arrow) > 100 and len(marker) > 50:
        # The normal is seen as the way from (0, 0, 1) to (0, 0, 2), nearly; the arrow by its longest axis.
        normal = tuple(b - a for a, b in zip(foot["where"], head["where"]))
        off_by = math.degrees(abs((axis(arrow) - math.atan2(normal[1], normal[0]) + math.pi / 2) % math.pi - math.pi / 2))
        check(off_by < 5, f"the arrow is {off_by:.1f} degrees off the normal")
        along = lambda p: p[0] * normal[0] + p[1] * normal[1]
        check(along(mean(arrow)) > along(mean(marker)), "the arrow points outwards")
        begin = min(arrow, key=along)
        check(min(math.dist(begin, p) for p in marker) < 12, "the arrow begins at the contact")
        check(min(math.dist(place["where"], p) for p in marker) < 8, "the marker is where the probe is held")
else:
    check(False, f"five lines were to be printed: {lines}")

# All that a hand can do, on meshes of different kinds; the log makes the same again.
MESHES = [("ball and moon", BALL), ("box", cube)]
if os.environ.get("HAPTIC_SCULPT_SHARED"):
    shared = os.path.join(os.environ["HAPTIC_SCULPT_SHARED"], "meshes")
    # A sponge, slivers, one that is hardly there, a part, an animal: each takes up to half a minute.
    MESHES += [(name, os.path.join(shared, name)) for name in sorted(os.listdir(shared))
               if name.startswith(("gen_menger", "gen_sliver", "gen_extreme", "cgal_joint", "oded_spot"))]
else:
    print("skipped: other meshes are read only where HAPTIC_SCULPT_SHARED names their folder")
WORK = """
key tab
settle
tool drag
drag 150 107.5 190 75 6
drag 140 115 150 62.5 6 normal
tool create
drag 160 130 175 107.5 6
tool brush
key .
drag 125 120 160 120 6
drag 140 110 160 110 3 ctrl
key a
drag 150 112.5 175 95 6
key shift+x
key g
drag 140 105 160 117.5 6
key shift+x
key l
drag 155 105 140 117.5 6
key k
drag 155 115 145 107.5 6
key u
key u
key shift+u
key m
drag 140 105 150 105 3
key i
move 150 108
key d
drag 150 108 160 110 4
key ctrl+m
key shift+m
drag 140 105 150 105 3
move 152 108
key e
move 140 120
key c
move 160 118
key e
tool remove
click 147.5 112.5
orbit 70 20
tool object
drag 150 112.5 152 110 3
tool drag
drag 150 112.5 75 115 6
drag 152.5 110 225 110 6
key t
drag 145 117.5 150 225 6
settle
print
save {out}
settle
quit
"""
made = set()
for name, mesh in MESHES:
    out, log = at("out.off"), at("work.log")
    for path in (out, log):
        if os.path.exists(path):
            os.remove(path)
    if run(mesh).returncode == 3:  # not a valid surface: sculpt says so, and the window too
        _, err = window(mesh, "--no-log", script="quit\n", code=3, what=name)
        check("not a valid surface" in err or "cannot" in err, f"{name}: {err}")
        continue
    lines, err = window(mesh, "--log", log, "--size", 300, 225, "--samples", 0, "--report", at("report.json"),
                        script=WORK.format(out=out), what=name)
    if lines and name.startswith("gen_extreme"):  # thinner than 1e-300 of its length: a press is beside it, and turns it
        said = lines[0]
        check(said["edits"] == 0 and said["hold"] == "nothing" and not said["pointed"], f"{name}: {said}")
    elif lines:
        check(lines[0]["edits"] > 0, f"{name}: nothing was edited: {lines[0]}")
        replayed(mesh, log, out, name)
        made.update(line.split()[0] for line in open(log) if line[0] != "#")
        report = json.load(open(at("report.json")))
        check(report["frames"] > 50 and report["frame_ns"]["p99"] >= report["frame_ns"]["p50"] > 0, f"{name}: frame times: {report}")
        check(report["ticks"] > 500, f"{name}: ticks: {report}")
        check(report["uploaded"]["faces"] > 0 and report["uploaded"]["bytes"] < 108 * (2 * report["uploaded"]["faces"] + 1100 + lines[0]["faces"] // 8),
              f"{name}: uploads: {report['uploaded']}")

# What a mesh has besides its faces is not in what is saved of it, which is said.
mesh = write(at("normals.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\n"
                                "f 1//1 3//1 2//1\nf 1//1 2//1 4//1\nf 2//1 3//1 4//1\nf 3//1 1//1 4//1\n")
lines, _ = window(mesh, "--no-log", "--size", 300, 225, "--samples", 0, what="normals",
                  script=f"settle\nsave {at('without.off')}\nsettle\nprint\nquit\n")
check(lines and lines[0]["said"].startswith("saved ") and lines[0]["said"].endswith("has besides its faces: normals"),
      f"a mesh with normals is saved: {lines}")

# A press on an edge creates there, whatever meshes there are: on the diagonal of the top.
mesh, out, log = write(at("two_faces_a_side.off"), box(1)), at("out.off"), at("edge.log")
window(mesh, "--log", log, "--size", 300, 225, "--samples", 0, what="a press on an edge", script=f"""
view 0.2 -0.3 -1
settle
tool create
drag @0,0,1 @0,0,1.3 4
settle
save {out}
settle
quit
""")
replayed(mesh, log, out, "a press on an edge")
made.update(line.split()[0] for line in open(log) if line[0] != "#")

missing = {"drag", "insert_face", "insert_edge", "flip", "collapse", "shift", "undo", "redo", "stroke", "end"} - made
check(not missing, f"the logs have no line {missing}: {made}")

window(cube, "--no-log", "--samples", 0, "--size", 300, 225, "--screenshot", at("end.png"), script="quit\n",
       what="a picture at the end")
check(os.path.exists(at("end.png")), "the picture at the end is written, though the script quits")
for name, script in (("opened", f"tool drag\nmove @0,-1,0\npress left\nopen {cube}\nrelease\n"), ("closed", "settle\nclose\nmove 1 1\n"), ("held", "brush inflate 0.2\nmove @0,-1,0\npress left\n")):
    window(BALL, "--no-log", "--samples", 0, "--size", 300, 225, "--screenshot", at(f"{name}.png"), script=script,
           what=f"a picture at the end, {name}")
    check(os.path.exists(at(f"{name}.png")), f"the picture at the end is written, {name}")
for direction in ("1.7e308 1.7e308 0", "5e-324 5e-324 5e-324"):
    view = " ".join(str(float(x) > 0 and 1 or 0) for x in direction.split())
    for name, way in (("far", direction), ("near", view)):
        window(BALL, "--no-log", "--samples", 0, "--size", 300, 225, "--screenshot", at(f"{name}.png"),
               script=f"key tab\nview {way}\nquit\n", what=f"view {way}")
    check(read_png(at("far.png"))[1] == read_png(at("near.png"))[1], f"view {direction} is view {view}")

# A removal is logged as the collapse that it was, whatever a probe near by has barred.
lines, _ = window(cube, "--log", at("remove.log"), "--samples", 0, "--size", 300, 225, script=f"""
view 0 1 -0.5
tool remove
click @0,0,1
settle
print
tool probe
move @0.5,0.5,1
press left
settle
print
release
tool create
drag @0.3,0.1,1 @0.3,0.1,1.5
tool remove
click @0.5,0.5,1
settle
print
save {at("removed.off")}
settle
quit
""", what="removals")
check([(s["hold"], s["faces"], s["edits"] > 0, s["refused"]) for s in lines] ==
      [("nothing", 190, True, ""), ("probe", 190, True, ""), ("nothing", 190, True, "")], f"what is removed is gone: {lines}")
check([s["vertices"] for s in lines] == [97, 97, 97], f"a probe is not counted: {lines}")
edits = [line.split()[0] for line in open(at("remove.log")) if line[0] != "#"]
check(edits.count("collapse") == 2 and "remove" not in edits, f"the log of removals: {edits}")
replayed(cube, at("remove.log"), at("removed.off"), "removals")

# A log that sculpt has begun, also by remeshing, is gone on with.
remeshed = at("remeshed.log")
done = run(BALL, "--log", remeshed, "--script", "-", "-o", at("again.off"), script="remesh 0.2\n")
begun = bytes_of(remeshed)
check(done.returncode == 0 and b"\nremesh 0x" in begun, f"sculpt begins a log: exit {done.returncode}, {len(begun)} bytes")
lines, _ = window(BALL, "--log", remeshed, "--samples", 0, "--size", 300, 225, script=f"""
settle
drag 150 110 170 90 4
save {at("further.off")}
settle
quit
""", what="a remeshed log")
check(bytes_of(remeshed).startswith(begun) and len(bytes_of(remeshed)) > len(begun), "a remeshed log is not gone on with")
replayed(BALL, remeshed, at("further.off"), "a remeshed log")

# A process that is killed loses nothing: its log makes what it had done, and the same command goes on from there.
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
key tab
settle
print
screenshot {at("asks_not.png")}
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
asked, unasked = read_png(at("asks.png"))[1], read_png(at("asks_not.png"))[1]
changed = [(x, y) for y in range(900) for x in range(0, 3600, 3) if asked[y][x:x + 3] != unasked[y][x:x + 3]]
check(len(changed) > 5000 and all(300 < x / 3 < 900 and 300 < y < 600 for x, y in changed), "unsaved work is asked about, in the middle")

# A log that the disk does not take whole is reported; what there is of it is good.
lines, err = window(BALL, "--log", at("full.log"), "--samples", 0, "--size", 300, 225, code=5, what="a full disk", disk=2500, script="""
settle
drag 150 110 170 90 60
print
quit
""")
check("full.log" in err and lines and lines[0]["edits"] > 0, f"a full disk: {err} {lines}")
done = run(BALL, "--log", at("full.log"), "-o", at("again.off"))
check(done.returncode == 0 and "blocked 0, " in done.stdout, f"the log on a full disk: {done.stderr}")

# Refusals, errors, recordings; beside the mesh the left button turns it, whatever the tool.
turns = "".join(f"tool {tool}\nmove 1195 5\npress left\nsettle\nwhere @0,0,0.5\nmove 1150 50\nwhere @0,0,0.5\nrelease\nsettle\nprint\n"
                for tool in ("drag", "probe", "create", "remove", "brush", "object"))
lines, _ = window(BALL, "--no-log", "--samples", 0, "--record", at("recorded.actions"), script=f"""
settle
{turns}key u
settle
print
wait 0.1
tool drag
move 700 450
press left
move 740 420
settle
release
settle
save {at("recorded.off")}
settle
quit
""", what="refusals")
check(len(lines) == 19 and "nothing-to-undo" in lines[-1]["refused"], f"refusals: {lines[-1:]}")
for i in range(0, 18, 3):
    before, after, state = lines[i:i + 3]
    check(math.dist(before["where"], after["where"]) > 1 and state["edits"] == 0 and state["refused"] == "", f"turned: {lines[i:i + 3]}")
# A script goes on when it is known whether a press was beside the mesh: it turns the same way without `settle`.
script = "settle\n" + turns.replace("press left\nsettle\n", "press left\n") + "quit\n"
at_once, _ = window(BALL, "--no-log", "--samples", 0, script=script, what="turned at once")
places = lambda lines: [line["where"] for line in lines if "where" in line]
check(len(at_once) == 18 and places(at_once) == places(lines),
      f"turned at once: {places(at_once)}, else {places(lines)}")
# What comes of a press beside the mesh does not turn what the next press holds.
presses = "move 1195 5\npress left\nrelease\nmove 700 450\npress left\nmove 701 450\nrelease\n"
script = f"settle\ntool drag\nwhere @0,0,0.5\n{20 * presses}where @0,0,0.5\nquit\n"
at_once, _ = window(BALL, "--no-log", "--samples", 0, script=script, what="beside, then not")
check(len(at_once) == 2 and at_once[0] == at_once[1], f"what is held is not turned: {at_once}")
recorded = open(at("recorded.actions")).read()
check("press left" in recorded and "wait 0." in recorded, f"a recording: {recorded}")
window(BALL, "--no-log", "--samples", 0, script=recorded + f"settle\nsave {at('played.off')}\nsettle\nquit\n", what="a recording played")
check(os.path.exists(at("played.off")) and points(at("played.off")) != points(BALL), "a recording sculpts when played")
apart = max(math.dist(a, b) for a, b in zip(points(at("played.off")), points(at("recorded.off"))))
check("tool drag" in recorded and apart < 1e-3,
      f"a recording played makes about the same mesh: {apart} apart, {recorded}")
for script, part in (("fly 1 2 3\n", "line 1: 'fly'"), ("\nkey f99\n", "line 2: 'f99'"), ("move 1\n", "is expected"), ("drag 1 2 3 4 0\n", "steps"),
                     ("drag 0 0 1 1 100000\n" * 11, "1000000 actions"), ("a" * 10001, "10000 bytes")):
    _, err = window(BALL, "--no-log", script=script, code=4, what=script)
    check(part in err, f"{script[:80]!r}: {err}")
_, err = window(at("nowhere.off"), "--no-log", script="quit\n", code=3, what="no mesh")
check("nowhere.off" in err, f"no mesh: {err}")
_, err = window(write(at("other.off"), box(5)), "--log", at("work.log"), script="quit\n", code=6, what="the log of another mesh")
_, err = window(BALL, "--no-log", script="quit\n", code=7, display=None, what="no display")
check("DISPLAY" in err, f"no display: {err}")
check(window(BALL, "--no-log", "--samples", 0, "--screenshot", at("last.png"))[1] == "" and len(read_png(at("last.png"))[1]) == 900, "--screenshot")
for option in ("--help", "--version"):
    done = subprocess.run([WINDOW, option], capture_output=True, text=True)
    check(done.returncode == 0 and "sculpt_window" in done.stdout, option)
described = open(os.path.join(SOURCE, "doc/use/window.md")).read()
help_text = subprocess.run([WINDOW, "--help"], capture_output=True, text=True).stdout
for action in ("move", "press", "release", "click", "drag", "scroll", "key", "view", "orbit", "zoom", "fit", "tool", "brush", "symmetry", "remesh", "depth", "wait", "settle",
               "screenshot", "save", "open", "record", "print", "where", "close", "quit"):
    check(f"`{action}" in described and f" {action}" in help_text, f"the action {action} is described")

# No file of the run is written over another one, by an option or a line of a script; a line that is refused is known by the exit code.
precious = write(at("precious.off"), box(3))
kept = bytes_of(precious)
for options, parts in ((["--record", precious], ["--record", "MESH"]), (["--report", precious], ["--report", "MESH"]), (["--log", precious], ["the log", "MESH"]),
                       (["-o", precious], ["-o", "MESH"]), (["--report", at("x"), "--record", at("x")], ["--record", "--report"]),
                       (["--report", precious + ".log"], ["--report", "the log"]), (["--report", at("script.txt")], ["--report", "--script"])):
    _, err = window(precious, *options, script="quit\n", code=2, what=f"{options}")
    check(all(part in err for part in parts + ["one file"]), f"{options}: {err}")
_, err = window(precious, "--size", 640, script="", code=2, what="half a size")
before_mesh = run("--size", 300, 225, precious, "--script", at("none.script"), program=WINDOW)
check("none.script" in before_mesh.stderr and "--size" not in before_mesh.stderr,
      f"--size before MESH: {before_mesh.stderr}")
_, err = window(precious, "--screenshot", precious, script="", code=2, what="a screenshot over the mesh")
check(".png" in err, f"a screenshot over the mesh: {err}")
for line in (f"save {precious}", f"save {at('precious.off.log')}", f"save {at('nothing.txt')}", f"screenshot {precious}", f"record {precious}",
             f"record {at('script.txt')}", f"screenshot {at('drawn.json')}", f"screenshot {at('picture.jpg')}"):
    _, err = window(precious, "--samples", 0, "--size", 100, 100, "--report", at("drawn.json"), script=f"settle\n{line}\nsettle\nquit\n", code=5, what=line)
    check("another name" in err or ".off" in err, f"{line}: {err}")
    check(bytes_of(precious) == kept and open(at("script.txt")).read().startswith("settle"), f"{line}: an input was written over")
    check(json.load(open(at("drawn.json")))["version"] != "", f"{line}: the report is there")
# Nor over one by a mesh that is opened later, whose log it would be; nor is one emptied by a run that is refused.
report = at("small_box.off.log")
write(at("small_box.off"), box(2))
_, err = window(precious, "--samples", 0, "--size", 100, 100, "--report", report, code=3, what="a report over a log",
                script=f"settle\nopen {at('small_box.off')}\nsettle\nquit\n")
check("the report" in err and json.load(open(report))["version"] != "", f"a report over a log: {err}")
write(at("kept.actions"), "# kept\n")
window(at("nowhere.off"), "--record", at("kept.actions"), script="quit\n", code=3, what="no mesh to record")
check(bytes_of(at("kept.actions")) == b"# kept\n", "a recording stays where the mesh is refused")
os.mkfifo(at("pipe.actions"))
window(precious, "--samples", 0, "--size", 100, 100, script=f"settle\nrecord {at('pipe.actions')}\nquit\n", code=5,
       what="a recording into a pipe that nobody reads")
# Remeshing that takes long is broken off by escape, and by a signal.
finest = "settle\nremesh 0.004\nwait 1\n"
lines, _ = window(BALL, "--no-log", "--samples", 0, "--size", 200, 150, what="remeshing that is broken off",
                  script=finest + "key escape\nsettle\nprint\nquit\n", patience=PATIENCE / 4)
check(lines and "broken off" in lines[0]["refused"], f"remeshing that is broken off: {lines}")
lines, _ = window(BALL, "--no-log", "--samples", 0, "--size", 200, 150, what="a press behind it", patience=PATIENCE / 4,
                  script=finest + "move 100 75\npress left\nrelease\nwait 0.1\nkey escape\nsettle\nprint\nquit\n")
check(lines and "broken off" in lines[0]["refused"], f"a press waits for what is broken off: {lines}")
process = start(BALL, "--no-log", "--samples", 0, "--size", 200, 150, script=finest + "print\nwait 1000\n")
process.stdout.readline()
process.send_signal(signal.SIGTERM)
try:
    process.communicate(timeout=PATIENCE / 4)
    check(process.returncode == 0, f"a signal ends remeshing: exit {process.returncode}")
except subprocess.TimeoutExpired:
    process.kill()
    check(False, "a signal does not end remeshing")
# So does a signal while a save waits behind it, which is made of what there is by then.
script = f"settle\nremesh 0.004\nsave {at('behind.off')}\nwait 1\nprint\nwait 1000\n"
process = start(BALL, "--no-log", "--samples", 0, "--size", 200, 150, script=script)
process.stdout.readline()
process.send_signal(signal.SIGTERM)
try:
    process.communicate(timeout=PATIENCE / 4)
    is_saved = run(at("behind.off")).returncode == 0
    check(process.returncode == 0 and is_saved, f"a save behind a remeshing: exit {process.returncode}")
except subprocess.TimeoutExpired:
    process.kill()
    check(False, "a signal does not end a window whose save waits behind a remeshing")
# Escape closes the list of keys alone: what is under way behind it goes on.
script = "settle\nkey h\nremesh 0.02\nkey escape\nsettle\nprint\nquit\n"
lines, _ = window(BALL, "--no-log", "--samples", 0, "--size", 200, 150, script=script, what="escape of a list")
check(lines and lines[0]["refused"] == "" and lines[0]["faces"] > 1600, f"escape of the list of keys: {lines}")
# What was created on masked faces can be brushed: masks that were interpolated, and rounded, are masks.
created = "".join(f"click {x} {y}\n" for x in range(120, 181, 10) for y in range(90, 131, 10))
lines, _ = window(BALL, "--no-log", "--samples", 0, "--size", 300, 225, what="a mask that was interpolated", script=f"""
key tab
view 0 1 0
settle
brush mask 0.8 1
click 150 112
click 140 105
settle
tool create
{created}settle
print
brush inflate 0.5 1
drag 120 100 180 130 8
settle
print
quit
""")
check(len(lines) == 2 and lines[1]["refused"] == "" and lines[1]["edits"] > lines[0]["edits"],
      f"brushes beside a mask that was interpolated: {lines}")
# A place behind the eye is nowhere in the window: nothing is pressed.
lines, _ = window(BALL, "--no-log", "--samples", 0, "--size", 300, 225, what="a place behind the eye", script="""
key tab
view 0 1 0
settle
where @0,-100,0
brush inflate 0.5 1
move 150 112
click @0,-100,0
settle
print
quit
""")
check(len(lines) == 2 and lines[0]["where"] == [None, None] and "behind the eye" in lines[1]["refused"] and lines[1]["edits"] == 0,
      f"a place behind the eye: {lines}")
# The report is of the last tick: it counts an edit if the log has one, however soon the window ends.
was_done = False
for wait in ("", "wait 0.05\n", "wait 0.2\n", "settle\n"):
    log = at("ends_at_once.log")
    if os.path.exists(log):
        os.remove(log)
    window(BALL, "--log", log, "--samples", 0, "--size", 200, 150, "--report", at("report.json"), what="ends at once",
           script=f"settle\nremesh 0.02\n{wait}quit\n")
    edits = json.load(open(at("report.json")))["edits"]
    words = [line.split(b" ")[0] for line in bytes_of(log).split(b"\n")]
    done = any(word in (b"insert_edge", b"collapse", b"flip", b"drag") for word in words)
    check((edits > 0) == done, f"the report has {edits} edits, and the log others")
    was_done = was_done or done
check(was_done, "no edit of these was done")
window(precious, "--no-log", "-o", precious, "--samples", 0, script="settle\nkey s\nsettle\nquit\n", what="without a log the mesh may be replaced")
# A log beside the mesh that is of another mesh: nobody has asked for it.
write(at("stale.off"), box(2))
write(at("stale.off.log"), bytes_of(at("work.log")))
_, err = window(at("stale.off"), script="quit\n", code=6, what="a log beside the mesh")
check("--no-log" in err and "--log" in err and "beside" in err, f"a log that nobody gave: {err}")
_, err = window(write(at("hole.off"), TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 2 0 3\n", "")), script="quit\n", code=3, what="a hole")
check("holes" in err and "PMP" not in err, f"advice for people: {err}")
# A terminal that is closed, and being asked to end: the log keeps what is not saved.
for which in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
    ended = write(at(f"ended_{int(which)}.off"), box(3))
    process = start(ended, "--samples", 0, "--report", at("ended.json"), script="settle\ntool drag\ndrag 700 450 800 350 6\nsettle\nprint\nwait 100\n")
    process.stdout.readline()
    process.send_signal(which)
    process.communicate(timeout=PATIENCE)
    check(process.returncode == 0 and os.path.exists(ended + ".log") and json.load(open(at("ended.json")))["edits"] > 0, f"{which}: exit {process.returncode}")
    os.remove(at("ended.json"))

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
# One that is not opened is no success; one that is being opened is waited for; one that is open stays.
unsaved = "settle\ntool drag\ndrag 600 430 700 350 6\nsettle\n"
script = f"{unsaved}open {second}\nsettle\nquit\n"
_, err = window(mesh, "--samples", 0, "--no-log", script=script, code=3, what="a mesh that is not opened")
check("second.off' was not opened" in err and "twice" in err, f"which, and what to do: {err}")
script = f"{unsaved}open {second}\nsettle\nsave {at('unopened.off')}\nsettle\nopen {mesh}\nsettle\nquit\n"
_, err = window(write(at("first.off"), bytes_of(mesh)), "--samples", 0, "--no-log", script=script, code=3,
                what="a mesh that is not opened, and another one")
check("second.off' was not opened" in err, f"which: {err}")
_, err = window(mesh, "--samples", 0, "--no-log", script=f"{unsaved}open {second}\nsettle\nclose\nclose\n", code=3,
                what="a mesh that is not opened, and closed")
check("second.off' was not opened" in err, f"which: {err}")
# That it is asked for twice counts only while nothing is done in between.
script = f"{unsaved}open {second}\nsettle\n{unsaved}open {second}\nsettle\nprint\nquit\n"
lines, err = window(mesh, "--samples", 0, "--no-log", script=script, code=3, what="asked for again after more work")
check("second.off' was not opened" in err and lines[0]["faces"] == 1600,
      f"asked for again after more work: {lines} {err}")
small, large = write(at("small.off"), box(1)), write(at("large.off"), box(60))
script = f"settle\nopen {second}\nopen {small}\nopen {small}\nsettle\nprint\nquit\n"
lines, _ = window(large, "--samples", 0, "--no-log", script=script, what="one after another")
check(lines[0]["faces"] == 12, f"the one that was opened last is seen: {lines}")
# The log of a window is removed, and one that others have begun is not.
others = write(at("others.off"), bytes_of(mesh))
for arguments, is_kept in (((), False), (("--script", write(at("one.script"), "drag 0 -0.1 -0.1 -0.1\n")), True)):
    if arguments:
        check(run(others, "--log", others + ".log", *arguments).returncode == 0, "sculpt begins a log")
    script = f"{unsaved}save {at('others_saved.off')}\nsettle\nclose\nsettle\n"
    window(others, "--samples", 0, script=script, what="closed in order")
    check(os.path.exists(others + ".log") == is_kept, f"the log stays, if others have begun it: {is_kept}")
# Nothing that the session has made, or has left for another mesh, is written over.
edit = "settle\ntool drag\ndrag 600 430 700 350 6\nsettle\n"
for before, line in ((f"save {at('first.off')}\nsettle\n", f"record {at('first.off')}"),
                     (f"save {at('first.off')}\nsettle\n", f"screenshot {at('first.off')}"),
                     (f"open {second}\nopen {second}\nsettle\n", f"save {at('left.off')}"),
                     (f"open {second}\nopen {second}\nsettle\n", f"screenshot {at('left.off.log')}")):
    left = write(at("left.off"), box(3))
    _, err = window(left, "--samples", 0, script=f"{edit}{before}{line}\nsettle\nquit\n", code=5, what=line)
    check("another name" in err and bytes_of(left) == box(3).encode(), f"{line}: {err}")
    check("open" not in before or b"drag" in bytes_of(left + ".log"), f"{line}: the log of the work is gone")
    if os.path.exists(left + ".log"):
        os.remove(left + ".log")
# What was asked to be saved is, before the window ends, and counts for the mesh that it was asked of.
window(large, "--samples", 0, "--no-log", script=f"{edit}save {at('large_saved.off')}\nquit\n", what="save, then quit")
check(os.path.getsize(at("large_saved.off")) > 1000000, "all of it is there")
for line in ("close", "key q"):
    os.remove(at("large_saved.off"))
    script = f"{edit}save {at('first.off')}\nsettle\nsave {at('large_saved.off')}\n{line}\nwait 20\nquit\n"
    window(large, "--samples", 0, "--no-log", script=script, what=f"save, save, then {line}")
    check(os.path.exists(at("large_saved.off")), f"save, save, then {line}: the second one is not there")
os.remove(at("large_saved.off"))
script = f"{edit}print\nsave {at('large_saved.off')}\nprint\nwait 100\n"
process = start(large, "--samples", 0, "--no-log", script=script)
process.stdout.readline(), process.stdout.readline()
process.send_signal(signal.SIGTERM)
process.communicate(timeout=PATIENCE)
is_there = os.path.exists(at("large_saved.off"))
check(process.returncode == 0 and is_there, "a save that was asked for is made though the process is asked to end")
# What is under way when the window is closed is unsaved work, too: the log stays, or one is asked.
under_way = write(at("under_way.off"), box(30))
process = start(under_way, "--samples", 0, script="settle\nprint\nremesh 0.05\nwait 0.5\nprint\nwait 100\n")
process.stdout.readline(), process.stdout.readline()
process.send_signal(signal.SIGTERM)
process.communicate(timeout=PATIENCE)
is_logged = b"stroke" in bytes_of(under_way + ".log")
check(process.returncode == 0 and is_logged, "a remeshing that was under way is in the log")
os.remove(under_way + ".log")
script = f"settle\nremesh 0.05\nopen {second}\nopen {second}\nwait 0.5\nsettle\nquit\n"
window(under_way, "--samples", 0, script=script, what="another mesh, opened while one is remeshed")
check(os.path.exists(under_way + ".log"), "the log of a mesh that was left while it was remeshed stays")
os.remove(under_way + ".log")
script = f"settle\nremesh 1\nopen {second}\nsettle\nquit\n"
_, err = window(under_way, "--samples", 0, "--no-log", script=script, code=3,
                what="another mesh, while unsaved work is under way")
check("second.off' was not opened" in err, f"what is under way is unsaved work: {err}")
# Of a mesh just opened nothing is unsaved, whatever was done to the one before; its counts are its own at once.
script = f"print\n{unsaved}open {second}\nopen {second}\nprint\nopen {small}\nprint\nquit\n"
lines, _ = window(write(at("first.off"), bytes_of(mesh)), "--samples", 0, "--no-log", script=script,
                  what="one after another, at once")
check([(line["faces"], line["edits"]) for line in lines] == [(1600, 0), (192, 0), (12, 0)], f"counts of each: {lines}")
window(small, "--samples", 0, "--no-log", "--report", at("counts.json"), script="quit\n", what="nothing but quit")
check(json.load(open(at("counts.json")))["faces"] == 12, "a report has the counts of the mesh")
# The log of a mesh that is opened again is not another process's.
script = f"settle\nopen {small}\nopen {second}\nopen {small}\nopen {second}\nsettle\nprint\nquit\n"
lines, _ = window(second, "--samples", 0, script=script, what="to and fro")
check(lines[0]["faces"] == 192, f"the last one: {lines}")
script = "settle\nscroll 1e4 ctrl\nscroll -1e4 ctrl\ndrag @0,0,0 @0,0,0.1 2\nsettle\nprint\nquit\n"
lines, _ = window(BALL, "--samples", 0, "--no-log", script=script, what="a brush of any size")
check(lines[0]["refused"] == "" and lines[0]["edits"] > 0, f"a radius is a number: {lines}")
script = f"settle\nsave {at('remeshed.off')}\nremesh 0.05\nsettle\nquit\n"
window(under_way, "--samples", 0, script=script, what="a mesh that grows while it is copied")
check(run(at("remeshed.off")).returncode == 0, "what grew while it was copied is saved")
opened = lambda mesh: f"open {mesh}\nwait 0.5\nsettle\n"
script = f"settle\n{opened(second)}{opened(precious)}save {precious}\nsettle\nquit\n"
window(precious, "--samples", 0, "--no-log", script=script, what="a mesh that is open again may be replaced")
script = f"{edit}save {at('nowhere/x.off')}\nquit\n"
window(large, "--samples", 0, "--no-log", script=script, code=5, what="a save that cannot be")
script = f"{edit}save {at('large_saved.off')}\nopen {second}\nopen {second}\nwait 2\n{edit}print\nquit\n"
lines, _ = window(large, "--samples", 0, script=script, what="another mesh is sculpted while one is saved")
check(lines[0]["faces"] == 192 and lines[0]["edits"] > 0 and os.path.exists(second + ".log"), f"its work is in its log: {lines}")
# What follows an `open` is done to that mesh, however long it is read; the key s saves beside it, over no other mesh.
first, beside = write(at("first.off"), box(2)), lambda name: at(name + "_sculpted.off")
script = f"settle\nopen {large}\nsave {at('after_open.off')}\nquit\n"
window(first, "--samples", 0, script=script, what="a save after an open")
check(len(points(at("after_open.off"))) == len(points(large)), "a save after an open has the mesh before")
script = f"{edit}key s\nsettle\nopen {second}\n{edit}key s\nsettle\nquit\n"
window(first, "--samples", 0, script=script, what="s, another mesh, s")
check([len(points(beside(name))) for name in ("first", "second")] == [len(points(name)) for name in (first, second)],
      "s saves each mesh beside itself")
script = f"{edit}save {at('one.off')}\nsettle\nopen {second}\nsave {at('one.off')}\nsettle\nquit\n"
_, err = window(first, "--samples", 0, script=script, code=5, what="a mesh over another one's")
check("another mesh that was saved" in err and len(points(at("one.off"))) == len(points(first)),
      f"one over another: {err}")
# The response stays what was chosen.
script = "key t\nopen {}\n{}print\nquit\n", "open {}\nkey t\n{}print\nquit\n", "open {}\n{}print\nquit\n"
pull = "settle\ntool drag\nview 0 0 -1\nmove @0,0,1\npress left\nmove @3,0.3,1\nsettle\n"
there, other_way, slid = (window(first, "--samples", 0, "--no-log", script=text.format(BALL, pull), what="stops")[0][0]
                          for text in script)
check(there["proxy"] == other_way["proxy"] != slid["proxy"], f"what stops: {there} {other_way} {slid}")
# Of two saves of one mesh in one file the later one stays, and the window is left after both without a question.
script = f"settle\nremesh 0.02\nsettle\nsave {at('twice.off')}\nkey u\nsave {at('twice.off')}\nclose\n"
window(first, "--samples", 0, script=script, what="saved twice")
check(points(at("twice.off")) == points(first), f"the later of two saves: {len(points(at('twice.off')))} vertices")
# A signal while another mesh is read leaves no log beside it.
process = start(first, "--samples", 0, script=f"settle\nprint\nopen {large}\nwait 100\n")
process.stdout.readline()
time.sleep(0.05)
process.send_signal(signal.SIGTERM)
process.communicate(timeout=PATIENCE)
check(process.returncode == 0 and not os.path.exists(large + ".log"),
      f"a log of a mesh that nobody saw: exit {process.returncode}")
# A terminal that is closed before there is a window.
process = start(large, "--samples", 0, script="wait 1000\n")
time.sleep(0.1)
process.send_signal(signal.SIGHUP)
try:
    process.communicate(timeout=PATIENCE / 4)
except subprocess.TimeoutExpired:
    process.kill()
    check(False, "a terminal that is closed early does not end the window")
check(process.returncode in (0, -signal.SIGHUP), f"a terminal that is closed early: exit {process.returncode}")
_, err = window(write(at("mesh.txt"), "OFF\n"), script="quit\n", code=3, what="a mesh of another name")
check("mesh.txt" in err and "-o" not in err, f"a mesh of another name: {err}")
_, err = window(second, "--no-log", script="key o\n", code=4, what="the key o of a script")
check("`open FILE`" in err, f"the key o of a script: {err}")
for line in ("wait 1e10", "wait -1", "zoom 0", "view 0 0 0", "remesh 0", "scroll 1 alt", "orbit 1e308 0",
             "orbit 0 -2e6", "move 1e7 0"):
    window(second, "--log", at("lines.log"), script=f"{line}\nquit\n", code=4, what=line)
# Where the ball cannot be written the message says so.
os.symlink("sculpt_window_ball.off", at("sculpt_window_ball.off"))
_, err = window("--samples", 0, "--no-log", script="quit\n", code=5, what="a ball that cannot be written")
check("sculpt_window_ball.off" in err and "fault of the program" not in err, f"a ball that cannot be written: {err}")
os.remove(at("sculpt_window_ball.off"))

end()
