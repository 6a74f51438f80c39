#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""System calls that fail: each that makes, writes or keeps a file fails in turn, by itself and with all after it, while `sculpt`,
`sculpt --repair` and `haptic_loop` write meshes, logs and reports; descriptors run out; files may not grow.

Whatever fails: the program ends by itself with an exit code of its own and says why; what stood in an output stands there whole, the old
or the new; the log is the beginning of that of a run in which nothing fails; the same command then comes through.
A loop whose log fails ends there: its mesh is as far as it came, and valid.

Arguments: sculpt, source folder, haptic_loop. HAPTIC_SCULPT_FAILING_CALLS says how many calls of each run fail (12;
`all`: each)."""
import errno
import os
import random
import resource
import shutil
import subprocess
import tempfile

from program_runs import FURTHER as LOOP, IS_SANITIZED, PATIENCE, SCULPT, SOURCE, bytes_of, check, end, failing_calls
from program_runs import surface, up_to_last_tick

MOST = os.environ.get("HAPTIC_SCULPT_FAILING_CALLS", "12")
SEED = int(os.environ.get("HAPTIC_SCULPT_SEED", "1"))
MESH = f"{SOURCE}/examples/data/ball_and_moon.off"
CODES = {0, 2, 3, 4, 5, 6}  # 1 is a fault of the program
COUNTS = {}


def if_there(path):
    return bytes_of(path) if os.path.exists(path) else None


def is_valid(mesh):
    return subprocess.run([SCULPT, mesh], capture_output=True, timeout=PATIENCE).returncode == 0


class Task:
    """A command, and what it makes in a folder: outputs, which are whole or as they were, and a log, which grows."""

    def __init__(self, name, program, arguments, outputs, log=None):
        self.name, self.program, self.arguments, self.outputs, self.log = name, program, arguments, outputs, log
        self.sound = {}

    def run(self, folder, environment=None, limits=()):
        def limit():
            for which, value in limits:
                resource.setrlimit(which, (value, value))

        done = subprocess.run([self.program, *self.arguments], cwd=folder, capture_output=True, text=True,
                              timeout=3 * PATIENCE, env={**os.environ, **(environment or {})}, preexec_fn=limit,
                              restore_signals=True)
        COUNTS[self.name, done.returncode] = COUNTS.get((self.name, done.returncode), 0) + 1
        return done

    def prepare(self, folder):
        """As it is before: old outputs, no log."""
        for name in os.listdir(folder):
            os.remove(os.path.join(folder, name))
        shutil.copy(MESH, f"{folder}/mesh.off")
        if self.name == "repair":
            head, counts, *rows = [line for line in open(MESH).read().split("\n") if line and not line.startswith("#")]
            vertices, faces = map(int, counts.split()[:2])
            open(f"{folder}/mesh.off", "w").write("\n".join([head, f"{vertices} {faces - 1} 0", *rows[:-1], ""]))  # a hole
        with open(f"{folder}/edits.script", "w") as file:
            file.write(SCRIPT)
        for name in self.outputs:
            with open(f"{folder}/{name}", "w") as file:
                file.write("kept")

    def make_sound(self, folder):
        self.prepare(folder)
        done = self.run(folder, {"FAILING_COUNT": f"{folder}/count", "LD_PRELOAD": SHIM})
        check(done.returncode == 0, f"{self.name}: exit {done.returncode}: {done.stderr}")
        self.sound = {name: if_there(f"{folder}/{name}") for name in [*self.outputs, *([self.log] if self.log else [])]}
        return int(open(f"{folder}/count").read())

    def look(self, folder, done, what):
        what = f"{self.name}, {what}"
        check(done.returncode in CODES, f"{what}: exit {done.returncode}: {done.stderr}")
        check(done.returncode == 0 or done.stderr.strip(), f"{what}: exit {done.returncode}, and nothing is said")
        whole = True
        for name in self.outputs:
            now = if_there(f"{folder}/{name}")
            is_report = name.endswith(".json")  # tells of what failed, and of times
            check(now == b"kept" or now == self.sound[name] or (is_report and now and now.rstrip().endswith(b"}")) or
                  ("lacks the last edits" in done.stderr and is_valid(f"{folder}/{name}")),
                  f"{what}: {name} is neither the old nor the new")
            whole = whole and now != b"kept"
        if self.log:
            now = if_there(f"{folder}/{self.log}") or b""
            check(self.sound[self.log].startswith(now), f"{what}: the log is not the beginning of that of a sound run")
            whole = whole and now == self.sound[self.log]
        check(done.returncode != 0 or whole, f"{what}: exit 0, and something is missing: {done.stderr}")
        left = [name for name in os.listdir(folder) if "haptic_sculpt-new" in name]
        check(not left, f"{what}: left-over files {left}")

    def come_through(self, folder, what):
        """The same command, with nothing that fails."""
        left = (if_there(f"{folder}/{self.log}") or b"") if self.log else b""
        done = self.run(folder)
        if self.program == LOOP:  # it goes on behind the last whole tick
            check(done.returncode == 0, f"{self.name}, {what}: then it does not come through: exit {done.returncode}: {done.stderr}")
            now = if_there(f"{folder}/{self.log}")
            check(now.startswith(up_to_last_tick(left)), f"{self.name}, {what}: the log does not go on behind its last whole tick")
            again = subprocess.run([SCULPT, "mesh.off", "--log", self.log, "-o", "again.off"], cwd=folder,
                                   capture_output=True, text=True, timeout=3 * PATIENCE)
            check(again.returncode == 0 and surface(f"{folder}/again.off") == surface(f"{folder}/{self.outputs[0]}"), f"{self.name}, {what}: its log gives another mesh: {again.stderr}")
            return
        complete = self.log and if_there(f"{folder}/{self.log}") == self.sound[self.log]
        check(done.returncode == 0 or (complete and done.returncode == 2), f"{self.name}, {what}: then it does not come through: exit {done.returncode}: {done.stderr}")
        for name, bytes_ in self.sound.items():
            check(name.endswith(".json") or if_there(f"{folder}/{name}") == bytes_ or done.returncode == 2,
                  f"{self.name}, {what}: then {name} is another")


def chosen(number, rng):
    return range(1, number + 1) if MOST == "all" else sorted(rng.sample(range(1, number + 1), min(number, int(MOST))))


def main():
    print("seed", SEED)
    rng = random.Random(SEED)
    path = f"{SOURCE}/examples/data/hand_path.csv"
    tasks = [Task("sculpt", SCULPT, ["mesh.off", "--script", "edits.script", "--log", "run.log", "-o", "out.off", "--report", "report.json"], ["out.off", "report.json"], "run.log"),
             Task("repair", SCULPT, ["mesh.off", "--repair", "-o", "out.ply", "--repair-report", "repair.json"], ["out.ply", "repair.json"]),
             Task("haptic_loop", LOOP, ["mesh.off", "--no-wait", "--seconds", "5.5", "--path", path, "--log", "run.log", "-o", "out.off"], ["out.off"], "run.log")]
    tries = 0
    with tempfile.TemporaryDirectory() as folder:
        for task in tasks:
            number = task.make_sound(folder)
            check(number > 5, f"{task.name}: only {number} calls were seen: is the library loaded?")
            for call in chosen(number, rng):
                for error in (errno.ENOSPC, errno.EIO):
                    for more in ("0", "1"):
                        task.prepare(folder)
                        what = f"call {call} of {number} fails with {errno.errorcode[error]}{', and all after it' if more == '1' else ''}"
                        done = task.run(folder, {"LD_PRELOAD": SHIM, "FAILING_CALL": str(call), "FAILING_ERROR": str(error), "FAILING_MORE": more})
                        task.look(folder, done, what)
                        task.come_through(folder, what)
                        tries += 1
            # With fewer the system cannot load the program; UBSan looks at objects through a pipe of its own.
            for descriptors in range(6 if IS_SANITIZED else 4, 12):
                task.prepare(folder)
                task.look(folder, task.run(folder, limits=[(resource.RLIMIT_NOFILE, descriptors)]), f"{descriptors} descriptors")
            largest = max(len(b) for b in task.sound.values())
            for size in sorted(rng.randrange(largest) for _ in range(8 if MOST != "all" else 200)):
                task.prepare(folder)
                what = f"no file may have more than {size} bytes"
                task.look(folder, task.run(folder, limits=[(resource.RLIMIT_FSIZE, size)]), what)
                task.come_through(folder, what)
    print(f"{tries} runs with a failing call; exits: " + ", ".join(f"{name} {code}: {count}" for (name, code), count in sorted(COUNTS.items())))


SCRIPT = "".join(f"drag {v} {0.01 * v} 0.2 0.1\n" for v in range(0, 60, 3)) + "stroke\ninsert_face 0 1 2 0.1 0.1 0.1\nremove 7\nend\nundo\nredo\nflip 3 4\ncollapse 5 6\n"

with tempfile.TemporaryDirectory() as shim_folder:
    SHIM = failing_calls(shim_folder)
    main()
end()
