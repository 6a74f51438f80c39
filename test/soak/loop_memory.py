# SPDX-License-Identifier: GPL-3.0-or-later
"""One long run of the haptic loop, in one process, whose memory is looked at: loop_memory.py HAPTIC_LOOP MESH
[--minutes M] [--seed S] [--touch].

A hand goes about at random, in and out of the mesh; it presses its buttons, or touches only. What it edits may cost
memory: the history and the journal keep it. What it touches may not. Exit code 0: the memory is as flat as the named
bounds say; 1: it is not, or the loop failed; 2: wrong use."""
import argparse
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent / name) for name in (".", "examples")]
from argument_types import number, whole_number
from hand_paths import BUTTONS_OF_A_HAND, random_path

TICKS_A_SECOND = 1000
# Simulated seconds that one of the clock may bring: more than the fastest machine makes of a path.
FASTEST = 200
# Minutes: before it is ended the loop has to have begun, to end in order, and its memory to have been looked at.
LEAST = 0.1
# Seconds in which it ends: it writes its mesh, log and report.
IN_ORDER = 120
# Bytes after the first quarter, touching only: what allocators keep in pieces, and pages used for the first time.
ALLOWED = 4 << 20
# Bytes that an edit may keep: those of a grab, a creation or a removal in the history, the mesh and the tables; 1.2 to
# 1.6 KB were seen on two meshes.
ALLOWED_AN_EDIT = 8 << 10


def slope_of(samples):
    """Bytes a second, by least squares."""
    n = len(samples)
    mean_t, mean_m = sum(t for t, _ in samples) / n, sum(m for _, m in samples) / n
    spread = sum((t - mean_t) ** 2 for t, _ in samples)
    return sum((t - mean_t) * (m - mean_m) for t, m in samples) / spread if spread > 0 else 0


def resident(process):
    with open(f"/proc/{process.pid}/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("loop")
    parser.add_argument("mesh")
    parser.add_argument("--minutes", type=number(LEAST, 10000, ": the loop has to have begun"), default=1)
    parser.add_argument("--seed", type=whole_number(0), default=1)
    parser.add_argument("--touch", action="store_true", help="press no button: nothing is edited")
    options = parser.parse_args()
    rng, seconds = random.Random(options.seed), FASTEST * 60 * options.minutes
    with tempfile.TemporaryDirectory() as folder:
        at = lambda name: os.path.join(folder, name)
        subprocess.run([options.loop, options.mesh, "--no-wait", "--seconds", "0.001", "--report", at("home.json")],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(at("home.json")) as file:
            home = json.load(file)["map"][7:10]
        with open(at("path.csv"), "w") as file:
            file.write(random_path(rng, seconds, home, [0] if options.touch else BUTTONS_OF_A_HAND))
        command = [options.loop, options.mesh, "--no-wait", "--seconds", str(seconds), "--path", at("path.csv"),
                   "--rate", str(TICKS_A_SECOND), "--report", at("report.json"), "--log", at("run.log")]
        samples, begin = [], time.monotonic()
        with open(at("said"), "w+") as said, subprocess.Popen(command, stdout=said, stderr=said) as process:
            while process.poll() is None and time.monotonic() < begin + 60 * options.minutes:
                time.sleep(max(0.05, 0.6 * options.minutes))
                try:
                    samples.append((time.monotonic() - begin, resident(process)))
                except (FileNotFoundError, IndexError, ProcessLookupError):
                    break
            process.terminate()  # it ends in order
            try:
                process.wait(timeout=IN_ORDER)
            except subprocess.TimeoutExpired:
                process.kill()
                print(f"FAULT: the loop has not ended {IN_ORDER} s after SIGTERM")
                return 1
            said.seek(0)
            words = said.read()
        if process.returncode != 0 or not os.path.exists(at("report.json")):
            print(f"FAULT: the loop ends with exit {process.returncode}: {words[-300:]}")
            return 1
        with open(at("report.json")) as file:
            report = json.load(file)
    late = samples[len(samples) // 4:]
    if len(late) < 8:
        print(f"FAULT: only {len(samples)} looks at the memory: a longer run is needed")
        return 1
    edits = sum(report["edits"].values())
    grown, slope = max(m for _, m in late) - late[0][1], slope_of(late)
    allowed = ALLOWED + edits * ALLOWED_AN_EDIT
    print(f"{os.path.basename(options.mesh)}, {'touched' if options.touch else 'edited'}: {report['ticks']} ticks, "
          f"{edits} edits, {late[-1][1] / 1e6:.1f} MB, after the first quarter {grown / 1e6:.2f} MB more, slope "
          f"{3600 * slope / 1e6:.2f} MB an hour; allowed {allowed / 1e6:.1f} MB")
    if not report["valid"] or grown > allowed:
        print("FAULT: the mesh is not valid" if not report["valid"] else "FAULT: the memory grows")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
