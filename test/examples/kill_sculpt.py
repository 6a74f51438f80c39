#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""kill -9, and other signals, while `sculpt` edits and logs, with options, directives, strokes, brushes and batches
mixed in; the same command goes on until it is through, and then another script on the same log. One of three kills falls within the
write of a line or of a batch, and some have to leave a part of it. A second program that wants the log while the first is stopped
within a write is refused.

Whenever it is killed, its log is the beginning of the log of a run that is not killed, byte for byte; replayed, it gives what its lines
give as a script; a stroke it was killed in is taken back by one undo; and in the end log and result are those of the run that is not
killed. HAPTIC_SCULPT_KILLS says how often (12)."""
import os
import random
import signal
import subprocess
import tempfile
import time

from program_runs import (LINES_OF_HEAD, SCULPT, SOURCE, before_open_stroke, bytes_of, check, end, failing_calls,
                          fails, run, surface, whole_edits, write)

MESH = f"{SOURCE}/examples/data/ball_and_moon.off"
KILLS = int(os.environ.get("HAPTIC_SCULPT_KILLS", "12"))
SEED = int(os.environ.get("HAPTIC_SCULPT_SEED", "7"))
SIGNALS = [signal.SIGKILL] * 5 + [signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGUSR1, signal.SIGALRM]


def random_script(rng, lines):
    """Drags, edits, dabs, batches, strokes, undo, redo, probes and directives mixed; many are refused, as they name what
    is gone by then."""
    text = [line.split() for line in open(MESH).read().split("\n") if line and not line.startswith("#")]
    vertices, faces = int(text[1][0]), int(text[1][1])
    corners = [row[1:4] for row in text[2 + vertices:2 + vertices + faces]]
    at = text[2:2 + vertices]

    def middle(indices):
        return " ".join(str(sum(float(at[int(i)][k]) for i in indices) / len(indices)) for k in range(3))

    def near(v):
        return " ".join(str(rng.uniform(-0.2, 0.2) + float(at[v % vertices][k])) for k in range(3))

    def batch():
        axis, moved = rng.randrange(3), rng.sample(range(vertices), 5)
        ways = "".join(f"{v} {float(at[v][axis]) + rng.uniform(-0.02, 0.02)}\n" for v in moved)
        return f"shift {axis} {len(moved)}\n{ways}end"

    def dab():
        kind = rng.choice(["grab", "inflate", "smooth", "flatten", "pinch"])
        return f"brush {kind} {near(rng.randrange(vertices))} {rng.uniform(0.1, 0.5)} {rng.uniform(-0.1, 0.1)}"

    script = [batch() + "\n", batch() + "\n"]
    for _ in range(lines):
        face, v = rng.choice(corners), rng.randrange(vertices + 50)
        script.append(rng.choices(
            [f"drag {v} {near(v)}", f"insert_face {' '.join(face)} {middle(face)}", f"insert_edge {' '.join(face[:2])} {middle(face[:2])}",
             f"remove {v}", f"collapse {face[0]} {face[1]}", f"flip {face[0]} {face[1]}", "stroke", "end", "undo", "redo", f"probe {near(v)} {near(v + 1)}", "release", f"response {rng.choice(['slide', 'stop', 'paper'])}",
             f"clearance {rng.choice(['default', '1e-9', '0x1p-20', str(rng.uniform(1e-6, 1e-3))])}", f"delta {rng.choice(['0', '1e-6', '0.001'])}",
             dab(), f"move {v} {near(v)}", batch(), f"remesh {rng.uniform(0.3, 0.5)}", f"# comment {v}", ""],
            [50, 15, 8, 10, 8, 10, 4, 4, 6, 6, 4, 2, 2, 2, 1, 4, 2, 4, 0.03, 1, 1])[0] + "\n")
    return "".join(script)


def random_options(rng):
    return [word for option, values in (("--response", ["slide", "stop", "paper"]), ("--clearance", ["1e-9", "0x1p-20"]), ("--delta", ["0", "1e-6"]))
            if rng.random() < 0.5 for word in (option, rng.choice(values))]


def undo_gives(folder, left, lines, before):
    """Whether one undo after a kill gives the state before the stroke it was killed in; False where nothing had been done in that."""
    log, now, then = write(f"{folder}/undone.log", left), f"{folder}/now.off", f"{folder}/then.off"
    for script, out in ((lines, now), (before, then)):
        check(run(MESH, "--script", "/dev/stdin", "-o", out, script="".join(script)).returncode == 0, "lines of a killed run")
    if surface(now) == surface(then):
        return False
    check(run(MESH, "--script", write(f"{folder}/undo.script", "undo\n"), "--log", log, "-o", now).returncode == 0, "undo after kill -9")
    check(surface(now) == surface(then), f"one undo does not take back the stroke it was killed in (seed {SEED})")
    return True


def within_a_write(rng, sound, left, name, is_batch):
    """The environment in which the program sends itself the signal of that name within a write to the log: of a batch, where
    one is still to come, or of any line."""
    to_come = sound[len(left):]
    batches, lines = to_come.count(b"\nshift "), to_come.count(b"\n")
    is_batch = is_batch and batches > 0
    # The shortest batch has seven lines; with less than 3 tenths of it not even the first is whole.
    return {**os.environ, "LD_PRELOAD": SHIM, "FAILING_SIGNAL": str(int(name)), "FAILING_START": "shift " if is_batch else "",
            "FAILING_WRITE": str(rng.randint(1, batches if is_batch else 1 + lines // 8)),
            "FAILING_SHARE": str(rng.randint(300, 900))}


def refuse_a_second(rng, folder, script):
    """One is stopped within a write; another that wants its log is refused, and nothing of the log is lost."""
    log, alone = f"{folder}/both.log", f"{folder}/alone.log"
    check(run(MESH, "--script", script, "--log", alone).returncode == 0, "a run alone")
    first = subprocess.Popen([SCULPT, MESH, "--script", script, "--log", log], stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL, env=within_a_write(rng, bytes_of(alone), b"", signal.SIGSTOP, True))
    _, status = os.waitpid(first.pid, os.WUNTRACED)
    check(os.WIFSTOPPED(status), "the first program is not stopped within a write")
    if os.WIFSTOPPED(status):
        left = bytes_of(log)
        for arguments in ([], ["--script", script]):
            fails(5, ["in use"], run(MESH, "--log", log, *arguments), "a second program on the log")
        check(bytes_of(log) == left, "the second program has changed the log of the first")
        first.send_signal(signal.SIGCONT)
        check(first.wait() == 0, "the first program does not come through")
    check(bytes_of(log) == bytes_of(alone), "the log of the first is not as it is alone")


class Killed:
    """Counts what was killed."""
    aimed = kills = runs = within_a_line = within_a_batch = within_strokes = strokes_undone = before_log = complete = 0


def kill(rng, folder, script, options, log, whole, counts):
    """Carries a script out on a log that may have lines of another, killed again and again, and beside it without a kill
    on `whole`."""
    out, expected = f"{folder}/killed.off", f"{folder}/whole.off"
    for path in (out, expected):
        if os.path.exists(path):
            os.remove(path)
    start = time.monotonic()
    done = run(MESH, "--script", script, "--log", whole, "-o", expected, *options)
    check(done.returncode == 0, "a run that is not killed")
    takes = time.monotonic() - start
    sound, result = bytes_of(whole), bytes_of(expected)
    where = f"(seed {SEED}, kill {counts.kills})"
    for attempt in range(12):
        is_killed, environment = attempt < 11 and counts.kills < KILLS, None
        if is_killed and counts.kills % 3 == 0:
            left = bytes_of(log) if os.path.exists(log) else b""
            environment = within_a_write(rng, sound, left, signal.SIGKILL, counts.aimed % 2 == 0)
        process = subprocess.Popen([SCULPT, MESH, "--script", script, "--log", log, "-o", out, *options],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
        counts.runs += 1
        counts.aimed += environment is not None
        if is_killed and environment is None:
            # Often near the end, where the results are written.
            time.sleep(takes * (rng.uniform(0.85, 1.02) if rng.random() < 0.3 else rng.uniform(0, 1)))
            process.send_signal(rng.choice(SIGNALS))
        code = process.wait()
        left = bytes_of(log) if os.path.exists(log) else b""
        check(sound.startswith(left), f"the log of a killed run is not the beginning of a whole one {where}")
        check(not os.path.exists(out) or bytes_of(out) == result, "a part of a result, or another")
        if code >= 0:
            break
        counts.kills += 1
        counts.within_a_line += not left.endswith(b"\n") and left != b""
        counts.before_log += left == b""
        counts.complete += left == sound
        lines = whole_edits(left)
        counts.within_a_batch += lines != left[:left.rfind(b"\n") + 1].decode().splitlines(keepends=True)
        before = before_open_stroke(lines)
        if before is not None:
            counts.within_strokes += 1
            counts.strokes_undone += undo_gives(folder, left, lines, before)
        # Without a whole head only the same command goes on.
        if left.count(b"\n") >= LINES_OF_HEAD and counts.kills % 5 == 0:
            replayed = run(MESH, "--log", write(f"{folder}/copy.log", left), "-o", f"{folder}/a.off")
            check(replayed.returncode == 0, "replay after kill -9")
            scripted = run(MESH, "--script", "/dev/stdin", "-o", f"{folder}/b.off", script="".join(lines))
            check(scripted.returncode == 0, "its lines as a script")
            check(bytes_of(f"{folder}/a.off") == bytes_of(f"{folder}/b.off"), "the replay is not what the lines say")
    # Killed between its last line and its end, it is through.
    check(code == 0 or (code == 2 and left == sound), f"the same command does not come through: exit {code}")
    check(bytes_of(log) == sound and bytes_of(out) == result, f"after kills log or result are others {where}")
    # A file half written is cleared by the next run that writes into the folder: the one that came through.
    left_over = [name for name in os.listdir(folder) if "haptic_sculpt-new" in name]
    check(not left_over, f"left-over files {left_over}")


def main():
    rng = random.Random(SEED)
    print("seed", SEED)
    counts = Killed()
    with tempfile.TemporaryDirectory() as folder:
        log, whole = f"{folder}/killed.log", f"{folder}/whole.log"
        while counts.kills < KILLS:
            for path in (log, whole):
                if os.path.exists(path):
                    os.remove(path)
            # The second goes on in the settings that the first has left.
            for turn, options in enumerate((random_options(rng), [])):
                script = write(f"{folder}/edits_{turn}.script", random_script(rng, rng.choice([30, 300, 1000])))
                kill(rng, folder, script, options, log, whole, counts)
        refuse_a_second(rng, folder, write(f"{folder}/both.script", random_script(rng, 300)))
    check(counts.within_a_line > 0, f"of {counts.aimed} kills aimed at it none fell within a line")
    check(counts.within_a_batch > 0, f"of {counts.aimed} kills aimed at it none fell within a batch")
    print(f"killed {counts.kills} times in {counts.runs} runs, {counts.before_log} before the log was begun, "
          f"{counts.complete} when it was complete, {counts.within_a_line} within a line, {counts.within_a_batch} within "
          f"a batch, {counts.within_strokes} within a stroke, of which {counts.strokes_undone} with edits in it were undone")


with tempfile.TemporaryDirectory() as shim_folder:
    SHIM = failing_calls(shim_folder)
    main()
end()
