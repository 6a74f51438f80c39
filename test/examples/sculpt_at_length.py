#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A hand that goes about at random, in and out of meshes, and presses its buttons: every mesh stays valid, every log is made again by
`sculpt` bit for bit, no fault ends a run.

Arguments: sculpt, source folder, haptic_loop, further meshes. HAPTIC_SCULPT_SECONDS says how long in all, in simulated
time (20)."""
import json
import os
import random
import sys
import tempfile

import program_runs
from hand_paths import BUTTONS_OF_A_HAND, random_path
from program_runs import FURTHER as LOOP, SCULPT, SOURCE, check, end, surface

MESHES = [f"{SOURCE}/examples/data/ball_and_moon.off", *sys.argv[4:]]
SECONDS = float(os.environ.get("HAPTIC_SCULPT_SECONDS", "20"))
SEED = int(os.environ.get("HAPTIC_SCULPT_SEED", "1"))


def run(program, *arguments):
    done = program_runs.run(*arguments, program=program, seconds=1200)
    check(done.returncode == 0, f"{arguments}: exit {done.returncode}: {done.stderr.strip()[-300:]}")
    return done.returncode == 0


def main():
    print("seed", SEED)
    rng = random.Random(SEED)
    total = {"ticks": 0, "grabbed": 0, "created": 0, "removed": 0, "refused": 0, "lines": 0}
    largest = 0
    with tempfile.TemporaryDirectory() as folder:
        at = lambda name: os.path.join(folder, name)
        run(LOOP, MESHES[0], "--no-wait", "--seconds", "0.001", "--report", at("home.json"))
        home = json.load(open(at("home.json")))["map"][7:10]
        for mesh in MESHES:
            seconds = SECONDS / len(MESHES)
            open(at("path.csv"), "w").write(random_path(rng, seconds, home, BUTTONS_OF_A_HAND))
            for old in ("a.log", "a.off", "b.off"):
                if os.path.exists(at(old)):
                    os.remove(at(old))
            if not run(LOOP, mesh, "--no-wait", "--seconds", seconds, "--path", at("path.csv"), "--log", at("a.log"), "-o", at("a.off"), "--report",
                       at("a.json"), "--rate", 1000):
                continue
            report = json.load(open(at("a.json")))
            name = os.path.basename(mesh)
            check(report["valid"] is True, f"{name}: the mesh is not valid")
            check(report["log"]["lost"] == 0 and report["log"]["failure"] == "", f"{name}: {report['log']}")
            if run(SCULPT, mesh, "--log", at("a.log"), "-o", at("b.off"), "--report", at("b.json")):
                check(surface(at("a.off")) == surface(at("b.off")), f"{name}: the log gives another mesh")
                totals = json.load(open(at("b.json")))["totals"]
                check(totals["asked"] == totals["reached"], f"{name}: lines of the log were blocked or refused: {totals}")
                total["lines"] += totals["asked"]
            total["ticks"] += report["ticks"]
            for key in ("grabbed", "created", "removed", "refused"):
                total[key] += report["edits"][key]
            largest = max(largest, report["cpu_ns"]["max"])
            print(f"{name}: {report['edits']}, force at most {report['force']['max']:.2f} N, CPU time of a tick "
                  f"{report['cpu_ns']['p50'] / 1e3:.1f} / {report['cpu_ns']['p999'] / 1e3:.0f} / {report['cpu_ns']['max'] / 1e3:.0f} us")
    print(total, f"longest tick {largest / 1e3:.0f} us")
    if len(MESHES) == 1:
        check(total["grabbed"] > 0 and total["created"] > 0 and total["removed"] > 0, f"the hand has done too little: {total}")


main()
end()
