#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""kill -9 while `haptic_loop` sculpts and logs, in real time and as fast as it goes.

Whenever it is killed, its log is the beginning of the log of the run that is not killed, byte for byte, and no more than 100 ms are
lost: the trace, read through a pipe, says how far the loop was. Made again, by `haptic_loop` and by `sculpt`, it gives one and the same
valid mesh, that of a tick. HAPTIC_SCULPT_KILLS says how often (6). Arguments: sculpt, source folder, haptic_loop."""
import json
import os
import random
import subprocess
import tempfile
import threading
import time

import program_runs
from program_runs import FURTHER as LOOP, SCULPT, SOURCE, bytes_of, check, end, surface, up_to_last_tick, write

KILLS = int(os.environ.get("HAPTIC_SCULPT_KILLS", "6"))
SEED = int(os.environ.get("HAPTIC_SCULPT_SEED", "7"))
MESH = f"{SOURCE}/examples/data/ball_and_moon.off"


def run(*arguments, program=LOOP):
    done = program_runs.run(*arguments, program=program, seconds=3 * program_runs.PATIENCE)
    check(done.returncode == 0, f"{arguments}: exit {done.returncode}: {done.stderr}")


def last_tick(lines):
    """Of the log: the number of the last tick that is whole; 0 where there is none."""
    return max([int(line.split()[2]) for line in lines if line.startswith(b"# tick ")] or [0])


def recover(at, left, path, which):
    """`haptic_loop` goes on behind the last whole tick of what is left; `sculpt` makes the same of that."""
    run(MESH, "--no-wait", "--seconds", "0.001", "--log", write(at("b.log"), left), "-o", at("b.off"), "--report", at("b.json"), "--path", path)
    check(bytes_of(at("b.log")).startswith(up_to_last_tick(left)), f"recovered, the log does not go on behind its last whole tick ({which})")
    check(json.load(open(at("b.json")))["valid"] is True, f"the recovered mesh is not valid ({which})")
    run(MESH, "--log", at("b.log"), "-o", at("c.off"), program=SCULPT)
    check(surface(at("b.off")) == surface(at("c.off")), f"sculpt recovers another mesh ({which})")


def watch(stream, seen):
    """How many rows of the trace came through the pipe."""
    for _ in stream:
        seen[0] += 1


def main():
    rng = random.Random(SEED)
    print("seed", SEED)
    within_a_tick, moments = 0, []
    with tempfile.TemporaryDirectory() as folder:
        at = lambda name: os.path.join(folder, name)
        path = f"{SOURCE}/examples/data/hand_path.csv"
        run(MESH, "--no-wait", "--log", at("whole.log"), "-o", at("whole.off"), "--path", path)
        sound = bytes_of(at("whole.log"))
        run(MESH, "--log", at("whole.log"), "-o", at("again.off"), program=SCULPT)
        check(surface(at("whole.off")) == surface(at("again.off")), "sculpt makes the whole log again")
        for kill in range(KILLS):
            in_real_time = kill % 3 == 0
            if os.path.exists(at("a.log")):
                os.remove(at("a.log"))
            seen = [-1]  # without the first line
            process = subprocess.Popen([LOOP, MESH, "--log", at("a.log"), "--path", path, "--trace", "/dev/stdout", *([] if in_real_time else ["--no-wait"])],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            reader = threading.Thread(target=watch, args=(process.stdout, seen))
            reader.start()
            # While the hand sculpts, which it does from 4.5 s on; now and then before.
            wanted = rng.randrange(4500, 6000 if in_real_time else 9900) if kill % 10 != 9 else rng.randrange(4500)
            while seen[0] < wanted and process.poll() is None:
                time.sleep(0.0005)
            time.sleep(rng.uniform(0, 0.002))
            process.kill()
            process.wait()
            reader.join()
            left = bytes_of(at("a.log")) if os.path.exists(at("a.log")) else b""
            moments.append(len(left) / len(sound))
            check(sound.startswith(left), f"the log of a killed run is not the beginning of a whole one (seed {SEED}, kill {kill})")
            lines = left.split(b"\n")
            within_a_tick += left != up_to_last_tick(left)
            # What the loop had done before it was killed, a tick a row, is in the log, but for 100 ms. Between two edits nothing is logged.
            due = [n for n in (int(line.split()[2]) for line in sound.split(b"\n") if line.startswith(b"# tick ")) if n <= seen[0] - 100]
            check(not due or last_tick(lines) >= due[-1], f"{seen[0]} ticks were made, and the log ends at {last_tick(lines)} (kill {kill})")
            if not left:
                continue
            recover(at, left, path, f"seed {SEED}, kill {kill}")
        for _ in range(3):  # what a machine that stops may leave: any beginning
            left = sound[:rng.randrange(len(sound) // 100, len(sound))]
            within_a_tick += left != up_to_last_tick(left)
            recover(at, left, path, f"seed {SEED}, cut to {len(left)} bytes")
    print(f"killed {KILLS} times, {sum(m == 1 for m in moments)} after the end, {within_a_tick} logs end within a tick; "
          f"at {', '.join(f'{m:.0%}' for m in sorted(moments)[:: max(1, KILLS // 10)])} of the log")

main()
end()
