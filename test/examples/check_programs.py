#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `sculpt` and `haptic_loop` must not lose, whatever becomes of their streams, readers, disks and inputs, and the words that help.
Arguments: sculpt, source folder, haptic_loop."""
import fcntl
import json
import os
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import termios
import time

from box_mesh import box
from program_runs import (FURTHER as LOOP, IS_SANITIZED, OCTAHEDRON, PATIENCE, SCULPT, SOURCE, TETRAHEDRON,
                          bytes_of, check, end, fails, points, run, surface, write)

BALL = f"{SOURCE}/examples/data/ball_and_moon.off"
PATH = f"{SOURCE}/examples/data/hand_path.csv"
DRAGS = "drag 3 0.2 0.2 2\ndrag 3 0.2 0.2 -1\n"


def loop(*arguments, **options):
    return run(*arguments, program=LOOP, **options)


def started(*arguments, program=SCULPT, before=None, **streams):
    """Without streams of its own it says nothing to anybody."""
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **streams}
    return subprocess.Popen([program, *map(str, arguments)], restore_signals=True, preexec_fn=before, **streams)


def waits_for(path, process):
    """Makes a pipe of `path`; \\return a function that hands it a text once the process reads there."""
    os.mkfifo(path)

    def give(text):
        with open(path, "w") as pipe:  # opens when the other side does
            pipe.write(text)

    return give


def closed_streams(folder, mesh):
    """A log is not what standard output goes to."""
    def closing(streams):
        return lambda: [os.close(stream) for stream in streams]

    script, out = write(f"{folder}/drags.script", DRAGS), f"{folder}/out.off"
    run(mesh, "--script", script, "--log", f"{folder}/sound.log", "-o", f"{folder}/sound.off")
    for streams in ((0,), (1,), (2,), (1, 2), (0, 1, 2)):
        log = f"{folder}/{''.join(map(str, streams))}.log"
        done = subprocess.run([SCULPT, mesh, "--script", script, "--log", log, "-o", out],
                              preexec_fn=closing(streams), timeout=PATIENCE)
        check(done.returncode == 0, f"without the streams {streams}: exit {done.returncode}")
        check(bytes_of(log) == bytes_of(f"{folder}/sound.log") and bytes_of(out) == bytes_of(f"{folder}/sound.off"),
              f"without the streams {streams} log or result are others")
    done = subprocess.run([SCULPT, mesh, "--script", "-"], preexec_fn=closing((0,)), capture_output=True, text=True,
                          timeout=PATIENCE)
    fails(4, ["script", "Bad file descriptor"], done, "a script from a standard input that is closed")
    log = f"{folder}/loop.log"
    done = subprocess.run([LOOP, BALL, "--no-wait", "--seconds", "0.1", "--log", log],
                          preexec_fn=closing((1, 2)), timeout=PATIENCE)
    check(done.returncode == 0 and run(BALL, "--log", log).returncode == 0, "haptic_loop without streams")


def closed_pipe():
    read, written = os.pipe()
    os.close(read)
    return written


def readers_that_have_gone(folder, mesh):
    colours = write(f"{folder}/colours.off", TETRAHEDRON.replace("3 0 2 1", "3 0 2 1 255 0 0"))  # of which something is said
    out, report = f"{folder}/out.off", f"{folder}/report.json"
    code = started(colours, "-o", out, "--report", report, stderr=closed_pipe()).wait(100)
    check(code == 0 and os.path.exists(out) and os.path.exists(report), f"nobody reads the messages: exit {code}")
    os.remove(out)
    code = started(mesh, "-o", out, stdout=closed_pipe(), stderr=subprocess.DEVNULL).wait(100)
    check(code == 5 and os.path.exists(out), f"nobody reads the table: exit {code}")
    os.remove(out)
    code = started(BALL, "--no-wait", "--seconds", "1", "-o", out, "--report", report, "--trace", "/dev/stdout", program=LOOP, stdout=closed_pipe()).wait(100)
    check(code == 5 and os.path.exists(out), f"nobody reads the trace: exit {code}")
    check("/dev/stdout" in " ".join(json.load(open(report))["notes"]), "the report says which rows did not arrive")


def signals(folder, mesh):
    out, report = f"{folder}/out.off", f"{folder}/report.json"
    script = f"{folder}/fifo.script"
    give = waits_for(script, None)
    process = started(mesh, "--script", script, "-o", out)
    time.sleep(0.3)
    process.send_signal(signal.SIGHUP)
    give(DRAGS)
    check(process.wait(100) == 0 and os.path.exists(out), f"a terminal that is closed costs the result: exit {process.returncode}")
    process = started(mesh, "--script", script, stderr=subprocess.PIPE)
    time.sleep(0.3)
    process.send_signal(signal.SIGSEGV)
    words = process.communicate(timeout=PATIENCE)[1]
    is_said = process.returncode == -signal.SIGSEGV and b"sculpt: ended by a fault of its own" in words
    check(is_said or IS_SANITIZED, f"a crash says so: {process.returncode} {words}")

    def running(seconds, before=None):
        process = started(BALL, "--seconds", seconds, "-o", out, "--report", report, "--trace", "/dev/stdout", program=LOOP, before=before,
                          stdout=subprocess.PIPE)
        for _ in range(200):
            process.stdout.readline()
        return process

    for which in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
        for path in (out, report):
            if os.path.exists(path):
                os.remove(path)
        process = running(60)
        process.send_signal(which)
        process.communicate(timeout=PATIENCE)
        check(process.returncode == 0 and os.path.exists(out), f"{which} costs the mesh: exit {process.returncode}")
        check(json.load(open(report))["interrupted"] is True, f"{which} in the report")
    process = running(1, lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))  # as by nohup
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=PATIENCE)
    check(process.returncode == 0 and json.load(open(report))["interrupted"] is False, "nohup")
    process = running(1)
    process.send_signal(signal.SIGSTOP)
    time.sleep(0.1)
    process.send_signal(signal.SIGCONT)
    process.communicate(timeout=PATIENCE)
    told = json.load(open(report))
    check(told["missed_by_wakeup"] >= 10, f"ticks that came late: {told['missed_by_wakeup']}")
    loop(BALL, "--no-wait", "--seconds", "0.1", "--report", report)
    check(json.load(open(report))["missed_by_wakeup"] == 0, "where nothing is waited for, nothing is late")
    rows_that_wait(folder)
    # Before the loop begins nothing can be lost: while a workspace is searched there is no reason to wait.
    device = write(f"{folder}/far.json", '{"form":"general","R":0.03,"l1":0.07,"l2":0.1,"r":0.03,"m1":0.02,"m2":0.02,'
                   '"M":0.05,"friction":0.005,"angle_limits":[-100,100]}')
    kept = write(f"{folder}/kept.json", "kept")
    for which in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
        process = started(mesh, "--no-wait", "--device", device, "--report", kept, program=LOOP)
        time.sleep(1)
        process.send_signal(which)
        check(process.wait(PATIENCE) == -which, f"{which} while the workspace is searched: exit {process.returncode}")
    check(open(kept).read() == "kept", "a run that has not begun writes a report")


def rows_that_wait(folder):
    """A signal ends a program whose rows nobody reads; a socket, which nothing opens, is not waited for."""
    pipe, out = f"{folder}/rows", f"{folder}/waited.off"
    os.mkfifo(pipe)
    for seconds in (0.05, 0.5, 1):  # before it waits, or while it does
        with open(f"{folder}/old.csv", "w") as file:
            file.write("kept")
        process = started(BALL, "--no-wait", "--trace", f"{folder}/old.csv", "--record", pipe,
                          "--log", f"{folder}/new.log", program=LOOP)
        time.sleep(seconds)
        process.send_signal(signal.SIGTERM)
        check(process.wait(60) in (5, -signal.SIGTERM), f"nobody has opened the pipe: exit {process.returncode}")
        with open(f"{folder}/old.csv") as file:
            check(file.read() == "kept" and not os.path.exists(f"{folder}/new.log"), "a refused run has written")
    done = subprocess.run([LOOP, BALL, "--no-wait", "--seconds", "0.1", "--trace", "/dev/stdout"],
                          capture_output=True, text=True, timeout=PATIENCE)
    rows = done.stdout.splitlines()
    check(done.returncode == 0 and len(rows) == 101 and len({row.count(",") for row in rows}) == 1,
          f"rows alone are in a pipe of rows: exit {done.returncode}, {rows[-2:]}")
    check("100 ticks" in done.stderr, f"the summary goes elsewhere: {done.stderr}")
    here, there = socket.socketpair()
    with here, there:
        done = subprocess.run([LOOP, BALL, "--no-wait", "--trace", "/dev/stdout"], stdout=there, stderr=subprocess.PIPE,
                              text=True, timeout=PATIENCE)
    fails(5, ["/dev/stdout", "socket"], done, "rows to a socket")
    smallest = 4096  # bytes that a pipe holds
    with open(os.open(pipe, os.O_RDONLY | os.O_NONBLOCK), "rb") as rows:
        fcntl.fcntl(rows, fcntl.F_SETPIPE_SZ, smallest)
        process = started(BALL, "--no-wait", "--trace", pipe, "-o", out, program=LOOP)
        waiting, latest = bytearray(4), time.monotonic() + PATIENCE
        while int.from_bytes(waiting, sys.byteorder) < smallest and time.monotonic() < latest:
            fcntl.ioctl(rows, termios.FIONREAD, waiting)
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        check(process.wait(60) == 5 and os.path.exists(out), f"nobody reads the pipe: exit {process.returncode}")
    os.remove(out)
    # A reader who is slow gets all.
    process = started(BALL, "--no-wait", "--trace", pipe, "-o", out, program=LOOP)
    with open(pipe, "rb") as rows:
        got = rows.read(1)
        time.sleep(1)
        process.send_signal(signal.SIGTERM)
        while block := rows.read(8192):
            time.sleep(0.02)
            got += block
    check(process.wait(60) == 0 and os.path.exists(out) and got.endswith(b"\n"),
          f"a slow reader of rows: exit {process.returncode}, {got[-50:]}")


def a_line_that_takes_long(folder, mesh):
    """It is said that it goes on, and where."""
    process = started(mesh, "--script", write(f"{folder}/long.script", "remesh 1e-3\n"), stderr=subprocess.PIPE)
    words = process.stderr.readline()  # whenever it is said
    process.kill()
    process.communicate(timeout=PATIENCE)
    check(words == b"sculpt: the script: 0 of 1 lines, 2 s\n", f"a line that takes long: {words}")


def thrown_while_a_script_runs(folder, mesh):
    """A line that does not serve any more is refused; what is thrown leaves the results so far."""
    out, report, log = f"{folder}/out.off", f"{folder}/report.json", f"{folder}/a.log"
    script = "clearance 1e-12\ndrag 3 0 0 1000000\ndelta 1e-9\ndrag 3 0 0 1\n"
    done = run(mesh, "--script", "-", "--log", log, "-o", out, "--report", report, script=script)
    check(done.returncode == 0, f"delta after an outgrown clearance: exit {done.returncode}: {done.stderr}")
    told = [(edit["line"], edit["op"], edit["status"], edit["reason"], edit["detail"]) for edit in json.load(open(report))["edits"]] if done.returncode == 0 else []
    check([edit[:4] for edit in told[1:2]] == [(3, "delta", "refused", "clearance-of-no-use")] and "clearance default" in told[1][4], f"it is a refused line: {told}")
    check(run(mesh, "--log", log, "-o", f"{folder}/again.off").returncode == 0 and bytes_of(out) == bytes_of(f"{folder}/again.off"), "replayed by sculpt")
    done = loop(mesh, "--no-wait", "--seconds", "0.001", "--log", log, "-o", f"{folder}/loop.off")
    check(done.returncode == 0 and points(f"{folder}/loop.off") == points(out), f"replayed by haptic_loop: {done.stderr}")
    if IS_SANITIZED:
        return
    # The memory that a line asks for is not there.
    ball = write(f"{folder}/box.off", box(8))
    before = f"{folder}/before.off"
    run(ball, "--script", "-", "-o", before, script="drag 0 -1.25 -1 1\n")
    command = [ball, "--script", "-", "-o", out, "--report", report]
    done = run(*command, script="drag 0 -1.25 -1 1\nremesh 0.003\ndrag 0 -1.5 -1 1\n", memory=200 << 20,
               seconds=3 * PATIENCE)
    fails(1, ["line 2", "remesh", "memory"], done, "no memory in a script")
    check(os.path.exists(out) and surface(out) == surface(before),
          "what was done until then is written, and nothing of the line that ended it")
    told = json.load(open(report))
    check("line 2" in " ".join(told["notes"]) and [edit["line"] for edit in told["edits"]] == [1],
          f"and told in the report: {told['notes']}, {told['edits']}")
    check("may have done" not in done.stderr, f"a line that was taken back: {done.stderr}")
    done = run(*command, script="stroke\ndrag 0 -1.25 -1 1\nremesh 0.003\n", memory=200 << 20, seconds=3 * PATIENCE)
    fails(1, ["line 3", "remesh", "memory", "may have done"], done, "no memory in a stroke, which is not taken back")
    check((-1.25, -1, 1) in points(out), "what the stroke had done before is written")


def limits_of_memory_below_need(run_within):
    """Twenty, 0.18 % apart, from the least down, to an eighth of a megabyte, within which it ends with exit 0."""
    low, high = 1 << 20, 1 << 30
    while high - low > 1 << 17:
        middle = (low + high) // 2
        low, high = (low, middle) if run_within(middle).returncode == 0 else (middle, high)
    return [high - step * high // 556 for step in range(20)]


def memory_that_runs_out(folder, mesh):
    """Wherever it does, a program ends in order, and what it wrote is what its log makes again, or it says that not."""
    if IS_SANITIZED:
        return
    box_file = write(f"{folder}/box.off", box(24))
    log, out, again, report = (f"{folder}/{name}" for name in ("a.log", "out.off", "again.off", "report.json"))
    at = points(box_file)
    shifts = "".join(f"shift {axis} {len(at)}\n" + "".join(f"{v} {p[axis] + 1}\n" for v, p in enumerate(at)) + "end\n"
                     for axis in (0, 1))
    outputs = ["--log", log, "-o", out, "--report", report]

    def anew(program, *arguments, **options):
        for file in (log, out, report):
            if os.path.exists(file):
                os.remove(file)
        return program(*arguments, *outputs, **options)

    def sculpt_within(memory):
        return anew(run, box_file, "--script", "-", script=shifts, memory=memory)

    def loop_within(memory):
        return anew(loop, BALL, "--no-wait", memory=memory)

    for source, run_within in ((box_file, sculpt_within), (BALL, loop_within)):
        limits = limits_of_memory_below_need(run_within)
        told = written = 0
        for memory in limits:
            done = run_within(memory)
            what = f"{run_within.__name__} {memory} bytes"
            is_in_order = done.returncode in (0, 1, 5) or "GNU MP" in done.stderr  # which ends the process itself
            check(is_in_order, f"{what}: exit {done.returncode}: {done.stderr}")
            has_begun = run_within is sculpt_within and os.path.exists(log) and " # line " in open(log).read()
            check(not has_begun or "GNU MP" in done.stderr or os.path.exists(out) or f"cannot write '{out}'" in done.stderr,
                  f"{what}: what was done is lost: {done.stderr}")
            if not os.path.exists(out):
                continue
            written += 1
            if "cannot append to the log" in done.stderr:
                told += 1
            else:
                code = run(source, "--log", log, "-o", again).returncode
                check(code == 0 and surface(out) == surface(again), f"{what}: another mesh than its log makes: {done.stderr}")
        check(written > 0, f"{run_within.__name__}: no mesh written")
        print(f"{run_within.__name__}: {limits[-1]} to {limits[0]} bytes; {written} of {len(limits)} meshes written, "
              f"{told} beside a log that ends before")


def targets(folder, mesh):
    """No file of a run is written over another one."""
    script, plain = write(f"{folder}/a.script", DRAGS), lambda name: f"{folder}/{name}"
    before = bytes_of(mesh)
    for options, parts in ((["--report", mesh], ["--report", "MESH"]), (["--log", mesh], ["--log", "MESH"]), (["-o", plain("x.off"), "--report", plain("x.off")], ["-o", "--report"]),
                           (["--script", script, "--report", script], ["--report", "--script"]), (["--log", script, "--script", script], ["--log", "--script"]),
                           (["--picture", plain("a.png"), "--compare", plain("a.png"), "--script", script], ["--picture", "--compare"])):
        fails(2, parts + ["one file"], run(mesh, *options), f"sculpt {options}")
    fails(2, [".png"], run(mesh, "--picture", mesh), "a picture over the mesh")
    here = os.open(".", os.O_RDONLY)
    os.chdir(folder)
    for _ in range(17):  # a current folder whose name is longer than the system gives out
        os.mkdir("d" * 250), os.chdir("d" * 250)
    shutil.copy(mesh, "mesh.off")
    done = run("mesh.off", "-o", "x.off", "--report", "x.json")
    check(done.returncode == 0 and os.path.exists("x.json"), f"two files in a deep folder: {done.stderr}")
    fails(2, ["one file"], run("mesh.off", "-o", "x.off", "--report", "./x.off"), "one file in a deep folder")
    os.fchdir(here), os.close(here)
    os.mkdir(plain("first")), os.mkdir(plain("second"))
    mounted = [shutil.which("unshare") or "false", "--mount", *([] if os.geteuid() == 0 else ["--map-root-user"]),
               "sh", "-c", 'mount --bind "$1/first" "$1/second" && shift && exec "$@"', "sh", folder]
    if subprocess.run([*mounted, "true"], capture_output=True).returncode == 0:  # not in every container
        done = subprocess.run([*mounted, SCULPT, mesh, "-o", plain("first/x.off"), "--report", plain("second/x.off")],
                              capture_output=True, text=True, timeout=PATIENCE)
        fails(2, ["-o", "--report", "one file"], done, "one file by two names of its folder")
    for options, parts in ((["--report", mesh], ["--report", "MESH"]), (["--trace", mesh], ["--trace", "MESH"]), (["--record", mesh], ["--record", "MESH"]),
                           (["--trace", plain("t"), "--record", plain("t")], ["--trace", "--record"]), (["--path", script, "--trace", script], ["--trace", "--path"]),
                           (["--log", plain("l"), "-o", mesh], ["-o", "MESH"]),
                           (["--record", plain("r"), "-o", mesh], ["-o", "MESH"]),
                           (["--hand", script, "--report", script], ["--report", "--hand"])):
        fails(2, parts + ["one file"], loop(mesh, "--no-wait", *options), f"haptic_loop {options}")
    fails(2, [".png"], loop(mesh, "--no-wait", "--picture", mesh), "a picture over the mesh")
    check(bytes_of(mesh) == before and open(script).read() == DRAGS, "an input was written over")
    for program in (SCULPT, LOOP):  # in a working folder that is no longer there
        gone = plain("gone")
        os.mkdir(gone)
        done = subprocess.run([program, mesh, "-o", "o.off", "--report", "r.json"], cwd=gone, capture_output=True,
                              text=True, timeout=PATIENCE, preexec_fn=lambda: os.rmdir(gone))
        fails(5, ["o.off", "has been removed"], done, "a folder that has been removed")
    kept = write(plain("kept.csv"), "kept")
    fails(3, [], loop(write(plain("open.off"), TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 2 0 3\n", "")), "--no-wait", "--trace", kept, "--record", plain("r")), "a mesh that is refused")
    check(open(kept).read() == "kept" and not os.path.exists(plain("r")), "a run that was refused spoils an old trace")


def inputs_of_the_loop(folder, mesh):
    for option in ("--path", "--hand", "--device", "--replay"):
        fails(4 if option == "--path" else 2, ["'.'", "directory"], loop(BALL, "--no-wait", option, "."), f"a folder as {option}")
    rows = open(PATH).read()
    out, report, picture = (f"{folder}/{name}" for name in ("out.off", "report.json", "picture.png"))
    done = loop(BALL, "--no-wait", "--seconds", "0.1", "--path", write(f"{folder}/bom.csv", "\ufeff" + rows))
    check(done.returncode == 0, f"a byte order mark before a path: {done.stderr}")
    # Torn through a singular pose.
    torn = write(f"{folder}/torn.csv", "\n".join(rows.splitlines()[:8]) + "\n")
    last = float(open(torn).read().splitlines()[-1].split(",")[0])
    write(torn, open(torn).read() + f"{last + 0.5},1e3,0,0.1,0\n")
    done = loop(BALL, "--no-wait", "--path", torn, "-o", out, "--report", report, "--picture", picture)
    fails(8, ["torn"], done, "a path that tears the mechanism")
    for path in (out, report, picture):
        check(os.path.exists(path), f"a path that tears the mechanism costs {path}")
    if os.path.exists(report):
        told = json.load(open(report))
        check([fault["what"] for fault in told["faults"]][-1] == "torn" and told["valid"] is True, f"torn: {told['faults']}")
    # No room for the mesh when the work is done.
    for path in (out, report, picture):
        if os.path.exists(path):
            os.remove(path)
    path, gone = f"{folder}/fifo.csv", f"{folder}/gone"
    os.mkdir(gone)
    give = waits_for(path, None)
    process = started(BALL, "--no-wait", "--seconds", "0.1", "--path", path, "-o", f"{gone}/out.off", "--report", report, "--picture", picture, program=LOOP)
    time.sleep(0.3)
    os.rmdir(gone)
    give(rows)
    check(process.wait(100) == 5 and os.path.exists(report) and os.path.exists(picture), f"no room for the mesh: exit {process.returncode}, {os.listdir(folder)}")
    check("out.off" in " ".join(json.load(open(report))["notes"] if os.path.exists(report) else []), "the report says what is missing")
    # Names are bytes.
    name = os.fsencode(folder) + b"/\xff\xfe.off"
    os.mkdir(os.fsencode(folder) + b"/\xff")
    os.symlink(b"\xff", os.fsencode(folder) + b"/link")
    write(name, OCTAHEDRON)
    os.chmod(name, 0o600)
    done = subprocess.run([LOOP, name, b"--no-wait", b"--seconds", b"0.01", b"-o", os.fsencode(folder) + b"/\xff.off",
                           b"--report", report.encode(), b"--trace", b"/dev/full", b"--record",
                           os.fsencode(folder) + b"/\xff.rec"], capture_output=True, timeout=PATIENCE)
    check(done.returncode == 5 and b"/dev/full" in done.stderr, f"names that are not UTF-8: exit {done.returncode}: {done.stderr}")
    done = subprocess.run([LOOP, name, b"--no-wait", b"--seconds", b"0.2", b"--report", report.encode(), b"--trace", os.fsencode(folder) + b"/full\xff"],
                          capture_output=True, timeout=PATIENCE,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (16384, 16384)))
    check(done.returncode == 5 and b"full\\xff" in done.stderr and "full" in " ".join(json.load(open(report))["notes"]), f"a note with such a name: exit {done.returncode}: {done.stderr}")


def recordings(folder, mesh):
    """Settings of a recording are what options could have given."""
    recording = f"{folder}/a.rec"
    check(loop(mesh, "--no-wait", "--seconds", "0.01", "--record", recording).returncode == 0, "a recording")
    head, rest = open(recording).read().split("\n", 1)
    for key, value in (("rate", -1.0), ("rate", 5), ("work", 0), ("work", -1), ("work", 1.5), ("map", [1, 2]), ("map", [0, 0, 0, 0]), ("delay", 99), ("stiffness", -1),
                       ("damping", -1), ("damping", 1e6), ("reach", -1), ("reach", 0), ("reach", 5e-324),
                       ("reach", 1.0000001), ("work", 2 * 10**15), ("snap", [0.1, 0.1, 0]), ("map", [1e308, 0, 0, 0]),
                       ("virtual_mass", 11), ("compensated_inertia", 0.5), ("controller", -1), ("rate", "x"),
                       ("delay", []), ("reach", None), ("work", "x"), ("map", [None]), ("map", {}), ("snap", ["x", 0]),
                       ("virtual_mass", "x"), ("controller", "x"), ("compensated_inertia", "x"), ("device", 1)):
        bad = write(f"{folder}/bad.rec", json.dumps({**json.loads(head), key: value}) + "\n" + rest)
        fails(6, [key, "bad.rec"], loop(mesh, "--replay", bad), f"a recording with {key} = {value}")
    check(loop(mesh, "--replay", recording).returncode == 0, "the recording itself")
    line = rest.split("\n")[2].split()
    for change in ([*line, "more"], [*line[:6], "99999999999999999999999", line[7]], [*line[:6], "7", line[7]], line[:7]):
        bad = write(f"{folder}/bad.rec", head + "\n" + " ".join(change) + "\n" + rest)
        fails(6, ["line 2"], loop(mesh, "--replay", bad), f"a recording with the line {change}")
    # The greatest number is no vertex, for a log either.
    log, out = f"{folder}/a.log", f"{folder}/out.off"
    run(mesh, "--log", log, "--script", "-", "-o", out, script=f"drag {2**64 - 1} 5 5 5\ndrag {2**64 - 2} 5 5 5\n")
    done = loop(mesh, "--no-wait", "--seconds", "0.001", "--log", log, "-o", f"{folder}/loop.off")
    check(done.returncode == 0 and points(f"{folder}/loop.off") == points(mesh) == points(out), "vertex 2^64 - 1 is another one in a replay")


def words(folder, mesh):
    """What is at fault is named, and what to do."""
    fails(3, ["--delta 9", "smaller"], run(mesh, "--delta", "9"), "a delta that the mesh has not")
    fails(3, ["boundary"], run(write(f"{folder}/open.off", TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 2 0 3\n", "")), "--delta", "0.01"), "a mesh that is open")
    fails(2, ["--nearest", "nan"], run(mesh, "--nearest", "nan", "0", "0"), "--nearest nan")
    fails(4, ["directory"], run(mesh, "--script", folder), "a folder as script")
    fails(4, ["no-such"], loop(mesh, "--path", f"{folder}/no-such"), "a path that is not there")
    options_of = {SCULPT: ("--log", "-o", "--delta", "--clearance", "--picture"),
                  LOOP: ("--log", "-o", "--replay", "--stiffness", "--seconds", "--device")}
    for program, options in options_of.items():
        for option in options:
            fails(2, [option, "empty"], run(mesh, option, "", program=program), f"{option} of nothing")
            if option != "-o":
                fails(2, [option, "empty"], run(mesh, option + "=", program=program), f"{option}=")
        for follows in ("--log", "--report=a.json", "-o", "-ox.off"):
            done = run(mesh, "--picture", follows, program=program)
            fails(2, ["--picture", "lacks its value", follows], done, f"--picture {follows}")
    check(run(mesh, "--report", "./--log", folder=folder).returncode == 0 and os.path.exists(f"{folder}/--log"),
          "a file with the name of an option")
    fails(2, ["empty"], run(""), "a mesh without a name")
    for program, line in ((SCULPT, "sculpt MESH [OPTIONS]"), (LOOP, "haptic_loop [MESH] [OPTIONS]")):
        told = run("--help", program=program).stdout
        check(line in told, f"--help does not say {line}: {told[:2000]}")
    fails(2, ["--seconds"], loop(mesh, "--seconds", "0"), "no time")
    fails(2, ["--log"], loop(mesh, "--fault", "log@0.01"), "a fault of no log")
    for never in (["--fault", "nan@inf"], ["--fault", "nan@1e300"], ["--fault", "nan@1", "--seconds", "1"],
                  ["--fault", "stall@0"], ["--fault", "jump@0"], ["--fault", "stall@0.0999999", "--seconds", "0.1"]):
        fails(2, ["--fault"], loop(mesh, *never), f"a fault that never comes: {never}")
    fails(2, ["--reach"], loop(mesh, "--reach", "0"), "no reach")
    for number in ("-1", "+400", "0x400", "18446744073709551616", "4e2"):
        fails(2, ["--work", number], loop(mesh, "--work", number), "what is no whole number")
        fails(2, ["--repair-largest-hole", number], run(mesh, "--repair", "--repair-largest-hole", number),
              "what is no whole number")
    for number in ("0400", "0900"):  # decimal all the same
        done = loop(BALL, "--no-wait", "--seconds", "0.01", "--work", number, "--report", f"{folder}/work.json")
        check(done.returncode == 0, f"--work {number}: {done.stderr}")
        check(json.load(open(f"{folder}/work.json"))["settings"]["work"] == int(number), f"--work {number}")
    check(run(mesh, "--repair", "--repair-largest-hole", "09").returncode == 0, "--repair-largest-hole 09")
    with open("/dev/full", "w") as full:
        for program in (SCULPT, LOOP):
            for option in ("--help", "--version") if program == SCULPT else ("--help",):
                done = subprocess.run([program, option], stdout=full, stderr=subprocess.DEVNULL)
                check(done.returncode == 5, f"{option} to a full disk")
    opened = loop(f"{folder}/open.off", "--no-wait")
    fails(3, ["holes"], opened, "advice of haptic_loop")
    check("PMP" not in opened.stderr, f"advice for programmers: {opened.stderr}")
    for text, parts in (('{"form": nonsense}', ["line 1, column 11"]), ("", ["line 1"]), ('{"form": "ditetra",\n,}', ["line 2, column 1"])):
        done = loop(BALL, "--no-wait", "--device", write(f"{folder}/device.json", text))
        fails(2, ["device.json", *parts], done, f"the device {text!r}")
        check("json.exception" not in done.stderr and "syntax error while parsing" not in done.stderr, f"words of a library: {done.stderr}")
    rigid = {"form": "ditetra", "R": 0.03, "l1": 0.07, "l2": 0.1, "m1": 0.02, "m2": 0.02, "M": 0.05}
    fails(7, ["friction"], loop(BALL, "--no-wait", "--device", write(f"{folder}/device.json", json.dumps(rigid))), "a device without friction")
    for options in (["--picture-at", "@nan,0,0"], ["--picture-at", "@inf,0,0"], ["--picture-at", "@ 1,0,0"], ["--picture-zoom", "nan"], ["--picture-zoom", "1e9"],
                    ["--picture-view", "nan", "0", "1"], ["--picture-view", "inf", "0", "1"]):
        fails(2, [options[0]], run(mesh, "--picture", f"{folder}/never.png", *options), f"{options}")
    pictures = []
    for place in ("@1,0,0", "@0x1p0,0,0", "@0,1,0"):
        done = run(mesh, "--picture", f"{folder}/a.png", "--picture-at", place)
        pictures.append(bytes_of(f"{folder}/a.png") if done.returncode == 0 else None)
    if pictures[0]:
        check(pictures[0] == pictures[1] != pictures[2], "--picture-at reads hexadecimal numbers as scripts do")


def limits_of_another_user(folder, mesh):
    """A user who gets no threads, and a log that he may not write."""
    if os.getuid() != 0 or IS_SANITIZED:
        print("skipped: only root can be somebody else, and sanitizers need threads")
        return
    os.chmod(os.path.dirname(folder), 0o755)
    os.chmod(folder, 0o777)
    # Where other users reach them: not in a home folder.
    sculpt, looped, ball = (shutil.copy(file, folder) for file in (SCULPT, LOOP, BALL))
    log = f"{folder}/a.log"
    run(ball, "--script", "-", "--log", log, script=DRAGS)
    os.chmod(log, 0o444)
    options = {"program": looped, "user": 34567}
    fails(5, ["appending", "give it to sculpt"],
          run(ball, "--no-wait", "--seconds", "0.1", "--log", log, **options), "a log that may not be written")
    done = run(ball, "--no-wait", "--seconds", "0.1", "--log", f"{folder}/b.log", processes=1, **options)
    fails(1, ["no thread"], done, "a loop without a thread for its log")
    check("fault of the program" not in done.stderr, f"a limit is no fault: {done.stderr}")
    if run(mesh, "--picture", f"{folder}/a.png").returncode != 0:
        return print("skipped: no picture can be drawn here")
    for processes in (1, 2):  # none, and not as many as the driver wants
        done = run(ball, "--picture", f"{folder}/{processes}.png", program=sculpt, user=34567, processes=processes)
        check(done.returncode == 0 and os.path.exists(f"{folder}/{processes}.png"),
              f"a picture, drawn by {processes} thread(s): {done.stderr}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        mesh = write(f"{folder}/mesh.off", TETRAHEDRON)
        for part in (closed_streams, readers_that_have_gone, signals, a_line_that_takes_long,
                     thrown_while_a_script_runs, memory_that_runs_out, limits_of_another_user, targets,
                     inputs_of_the_loop, recordings, words):
            inner = f"{folder}/{part.__name__}"
            os.mkdir(inner)
            part(inner, mesh)
    end()


main()
