#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the example programs with random options and damaged files: fuzz_programs.py SOURCE PROGRAM ... [--runs N] [--seed S].

The options are read from each program's --help, so that a new one is tried without being named here. Values are numbers from all
doubles and all integers, words, bytes that are no text, and names of files: good, damaged, missing, folders, devices. What must hold
of every run:

- it ends by itself, or in order within seconds of a SIGTERM, and never by another signal;
- its exit code is one that its --help names, and never that of a fault of the program;
- nothing of the runtime stands on the screen (a sanitizer's report, an exception that nobody caught);
- what it is given to read is as it was, but a mesh that is named as the output, too;
- with exit code 0, a mesh that it wrote is valid: `sculpt MESH` reads it.

Each run is a draw of its own: --first N --runs 1 makes run N again, and --keep its files.
"""
import argparse
import os
import random
import re
import resource
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import typing

MEMORY = 3 << 30  # bytes: what is refused below this is refused in order
PATIENCE = 10  # seconds before a run is asked to end
GRACE = 20  # seconds that it may take then
FAULT_OF_THE_PROGRAM = 1
# AddressSanitizer reserves more than any limit of addresses. It is given bounds of its own, and ends a program there.
BOUNDS_OF_THE_SANITIZER = f"max_allocation_size_mb={MEMORY >> 20}:hard_rss_limit_mb={2 * MEMORY >> 20}"
ENDED_AT_A_BOUND = re.compile(rb"AddressSanitizer: (allocation-size-too-big|out-of-memory|hard rss limit exhausted)")
RUNTIME = re.compile(rb"Sanitizer|runtime error:|terminate called|Assertion|CGAL error|std::|what\(\):")


class Option(typing.NamedTuple):
    name: str
    values: int
    choices: list
    needs: list


def options_of(program):
    """The options, the exit codes, and whether there is a MESH, from --help."""
    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    options = []
    for line in text.splitlines():
        found = re.match(r"  (-[\w,-]+)(.*)", line)
        if not found or found.group(1) in ("-h,--help", "--version"):
            continue
        name, rest = found.group(1).split(",")[-1], found.group(2)
        head = re.split(r" {2,}", rest.strip())[0] if rest.startswith(" ") and not rest.startswith("   ") else ""
        choices = re.search(r"\{([^}]*)\}", head)
        count = re.search(r" x (\d+)", head)
        kind = re.match(r"(TEXT|FLOAT|UINT|INT|[A-Z]\b)", head)
        letters = re.match(r"((?:[A-Z] )*[A-Z])(?: |$)", head)
        values = int(count.group(1)) if count else len(letters.group(1).split()) if letters else 1 if kind else 0
        needs = re.search(r"Needs: ((?:--[\w-]+ ?)+)", head)
        options.append(Option(name, values, choices.group(1).split(",") if choices else [], needs.group(1).split() if needs else []))
    exits = text[text.index("Exit:"):] if "Exit:" in text else ""
    named = {int(code) for code in re.findall(r"Exit code (\d+)", text)}
    codes = named | {int(code) for code in re.findall(r"(?:[ ,]|^)(\d+) [a-z]", exits.split("\n")[0])} | {0, 2}
    if not exits:  # a benchmark that ends, on wrong use, with the codes of CLI11
        codes |= set(range(100, 116))
    return options, codes - {FAULT_OF_THE_PROGRAM}, re.search(r"\n *MESH", text) is not None


class Draw:
    """One run, from its own random numbers."""

    program = ""  # that these are for

    def __init__(self, seed, number, folder, corpus):
        self.random = random.Random(f"{seed}/{number}")
        self.folder, self.corpus = folder, corpus
        self.inputs = {}

    def number(self):
        r = self.random
        kinds = [
            lambda: repr(struct.unpack("d", struct.pack("Q", r.getrandbits(64)))[0]),
            lambda: repr(r.uniform(-2, 2)),
            lambda: repr(10.0 ** r.randint(-320, 308)),
            lambda: str(r.choice([0, 1, 2, 3, 7, 100, 2**31 - 1, 2**31, 2**32, 2**63 - 1, 2**64 - 1, 2**64, -1, -(2**63)])),
            lambda: struct.unpack("d", struct.pack("Q", r.getrandbits(64)))[0].hex(),
            lambda: r.choice(["nan", "-nan", "inf", "-inf", "-0", "0x", "1e", "", " ", "1,5", "1e400", "+1", "++1", "0x1p-1074"]),
        ]
        return r.choice(kinds)()

    def text(self):
        return self.random.choice(["", "-", "--", "é\u202e", "\udcff\udcfe", "a" * 5000, "%s%n", "$(true)", "edit", "@0,0,0", "@nan,0,0", "slide",
                                   "off", "..", "0", "nan@1", "jump@0", "jump@-1e300", "V"])

    def damaged(self, data):
        r = self.random
        data = bytearray(data)
        for _ in range(r.choice([0, 1, 1, 2, 3, 8])):
            at = r.randrange(len(data) + 1)
            length = r.randint(1, 40)
            kind = r.randrange(7)
            if kind == 0 and at < len(data):
                data[at] ^= 1 << r.randrange(8)
            elif kind == 1:
                del data[at:at + length]
            elif kind == 2:
                data[at:at] = data[max(0, at - length):at]
            elif kind == 3:
                data[at:at] = f" {self.number()} ".encode("utf-8", "replace")
            elif kind == 4:
                del data[at:]
            elif kind == 5:
                data[at:at] = bytes(r.randrange(256) for _ in range(length))
            else:
                digits = re.search(rb"-?\d[\d.e+-]*", data[at:])
                if digits:
                    data[at + digits.start():at + digits.end()] = self.number().encode("utf-8", "replace")
        return bytes(data)

    def file(self, suffix, name, damaged):
        """A copy of something like that from the corpus, perhaps damaged."""
        r = self.random
        like = [p for p in self.corpus if p.endswith(suffix)] or self.corpus
        with open(r.choice(like), "rb") as source:
            data = source.read()
        if damaged:
            data = self.damaged(data)
        path = os.path.join(self.folder, name + suffix)
        with open(path, "wb") as file:
            file.write(data)
        self.inputs[path] = data
        return path

    def path(self, option, is_good):
        r = self.random
        reads, writes = READ.get(option), WRITTEN.get(option)
        if self.program == "sculpt_window" and option in ("--script", "--record"):
            reads, writes = (".window-script", None) if option == "--script" else (None, ".window-script")
        if reads and (is_good or r.random() < 0.8):
            return self.file(reads, "in" + option.strip("-"), not is_good)
        good = os.path.join(self.folder, "out" + option.strip("-") + (writes or ".log"))
        return good if is_good else r.choice([good + ".", os.path.join(self.folder, "outoutput.off"), os.path.join(self.folder, "none", "x" + (writes or "")),
                                              self.folder, "/dev/null", "/dev/full", "/proc/self/mem", "", *self.inputs])

    def value(self, name, choices, is_good):
        r = self.random
        if choices and (is_good or r.random() < 0.5):
            return r.choice(choices)
        if name in READ or name in WRITTEN or name == "--log":
            return self.path(name, is_good)
        if is_good:
            return r.choice(["0.001", "0.1", "0.5", "1", "4", "100", "1000"])
        return self.number() if r.random() < 0.9 else self.text()


# Options that a benchmark gets where none were drawn, so that a run takes seconds.
SMALLEST = {
    "axis_speed_error": {"--queries": "1"}, "sweep_speed_error": {"--queries": "1"},
    "drag_speed_error": {"--drags": "1"},
    "edit_performance": {"--samples": "2", "--largest": "1000", "--largest-valence": "4"},
    "hand_drags": {"--level": "2", "--drags": "2"},
    "robustness": {"--drags": "2", "--drags-on-large": "0", "--edits": "2", "--edits-on-large": "0"},
}
USUAL = {"sculpt": ["--script", "--output", "--report"], "haptic_loop": ["--output", "--no-wait", "--report"],
         "sculpt_window": ["--script", "--screenshot", "--no-log"]}
READ = {"--script": ".script", "--hand": ".json", "--device": ".json", "--path": ".csv", "--replay": ".rec"}
WRITTEN = {"--output": ".off", "--report": ".json", "--repair-report": ".json", "--picture": ".png", "--compare": ".png", "--record": ".rec",
           "--trace": ".csv", "--json": ".json", "--screenshot": ".png"}


def is_sanitized(program):
    return "sanitize" in program


def environment():
    # Drivers of OpenGL leak where there is a display: nothing would tell them from others.
    leaks = ":detect_leaks=0" if "DISPLAY" in os.environ else ""
    return {**os.environ, "ASAN_OPTIONS": f"abort_on_error=1:{BOUNDS_OF_THE_SANITIZER}{leaks}"}


def grace(program):
    """Seconds that it may take to end."""
    return GRACE * (10 if is_sanitized(program) else 1)


def limits(program):
    if not is_sanitized(program):
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))


def run(arguments, stdin, folder):
    """(exit code, what stands on the screen, whether it had to be asked to end)"""
    # Without a terminal, in a folder of its own.
    with subprocess.Popen([os.fsencode(a) for a in arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, cwd=folder, preexec_fn=lambda: limits(arguments[0]),
                          env=environment()) as process:
        try:
            output = process.communicate(stdin, timeout=PATIENCE)[0]
            return process.returncode, output, False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGTERM)
            try:
                output = process.communicate(timeout=grace(arguments[0]))[0]
            except subprocess.TimeoutExpired:
                process.kill()
                return None, process.communicate()[0], True
            return process.returncode, output, True


def faults_of(draw, program, codes, arguments, code, output, was_asked, validator):
    faults = []
    if is_sanitized(arguments[0]) and ENDED_AT_A_BOUND.search(output):
        return faults
    if code is None:
        faults.append(f"does not end within {grace(arguments[0])} s of a SIGTERM")
    elif code < 0 and not (was_asked and code == -signal.SIGTERM):
        faults.append(f"ended by {signal.Signals(-code).name}")
    elif code >= 0 and code not in codes and not (code == FAULT_OF_THE_PROGRAM and b"memory" in output) and not was_asked:
        faults.append(f"exit code {code}, which is not one that --help names, or a fault of the program")
    told = RUNTIME.search(output)
    if told:
        faults.append(f"says '{told.group(0).decode()}'")
    for path, data in draw.inputs.items():
        is_named = arguments.count(path) == 2 and "--output" in arguments  # `sculpt MESH -o MESH` sculpts a file in its place
        if not is_named and open(path, "rb").read() != data:
            faults.append(f"{path} is not as it was")
    if code == 0 and "--output" in arguments and not faults:
        made = arguments[arguments.index("--output") + 1]
        if os.path.isfile(made) and made not in draw.inputs and made.endswith((".off", ".ply", ".obj")):
            read = subprocess.run([validator, made], capture_output=True, env=environment(),
                                  preexec_fn=lambda: limits(validator))
            if read.returncode != 0:
                faults.append(f"the mesh it wrote is refused: {read.stderr.decode(errors='replace')[:300]}")
    return faults


def corpus_of(programs, source, folder):
    """Good files of each kind, made by the programs themselves."""
    data = os.path.join(source, "examples", "data")
    mesh = os.path.join(data, "ball_and_moon.off")
    corpus = [os.path.join(data, name) for name in os.listdir(data) if name.endswith((".off", ".script", ".csv"))]
    small = {"tetrahedron.off": "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n",
             "hand.json": '{"mass": [0, 0.2], "stiffness": [2000, 300], "damping": [2, 3]}', "named.json": '{"name": "finger"}',
             "device.json": '{"form": "general", "params": {"R": 0.06, "l1": 0.1, "l2": 0.12, "r": 0.03, "m1": 0.1, "m2": 0.1, "M": 0.1, "g": 9.81}}',
             "small.window-script": "brush inflate 0.3 0.1\ndrag 300 300 320 310 3\nkey u\ntool create\n"
                                    "click 300 280\nquit\n",
             "some.queries": "VF 0.25 0.25 1 0.25 0.25 -2 0 0 0 1 0 0 0 1 0\n"
                             "EE 0 0 1 0x1p0 0 -1 1 1 0 0 1 0.25 1 0 0.25\n"
                             "FV 0 0 1 0 0 -1 1 0 1 0 1 1 0.375 0.375 0\n# none\n"
                             "AX VF 2 0 0 1 0 0 0 1 0 0 0 1 0 -1 0 0 0\n",
             "all.script": "drag 0 0.5 0.5 0.5\ninsert_face 0 1 2 0.2 0.2 0.2\nundo\nredo\nbrush inflate 0 0 0 1 0.1\nremesh 0.3\nstroke\nremove 1\nend\n"
                           "flip 0 1\ncollapse 0 1\ndelta 1e-6\nclearance 1e-9\nresponse stop\n"}
    for name, text in small.items():
        corpus.append(os.path.join(folder, name))
        with open(corpus[-1], "w") as file:
            file.write(text)
    log, script = os.path.join(folder, "good.log"), os.path.join(data, "demo.script")
    subprocess.run([programs["sculpt"], mesh, "--script", script, "--log", log], check=True, capture_output=True)
    recording = os.path.join(folder, "good.rec")
    subprocess.run([programs["haptic_loop"], "--no-wait", "--seconds", "0.2", "--record", recording], check=True, capture_output=True)
    return corpus + [log, recording]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("source", help="the folder of the sources")
    parser.add_argument("programs", nargs="+", help="example programs, built; sculpt and haptic_loop among them")
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="begin with this run")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", metavar="FOLDER", help="where the files of runs with faults are kept")
    parser.add_argument("--display", action="store_true", help="open one without a screen (Xvfb) for sculpt_window; "
                        "else it refuses to make a window, and its command line is tried only")
    arguments = parser.parse_args()
    os.environ.pop("DISPLAY", None)
    if arguments.display:
        sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples"))
        from virtual_display import Display
        display = Display()  # ends with this script
        os.environ["DISPLAY"] = display.name
    programs = {os.path.basename(path): os.path.abspath(path) for path in arguments.programs}
    for name in ("sculpt", "haptic_loop"):
        if name not in programs:
            parser.error(f"{name} is not among the programs: it makes files to begin with")
    known = {name: options_of(path) for name, path in programs.items()}
    weights = {"sculpt": 4, "haptic_loop": 3}
    print(f"seed {arguments.seed}, runs {arguments.first} to {arguments.first + arguments.runs - 1}")
    found, ends, asked = 0, {}, 0
    with tempfile.TemporaryDirectory() as good:
        corpus = corpus_of(programs, os.path.abspath(arguments.source), good)
        for number in range(arguments.first, arguments.first + arguments.runs):
            with tempfile.TemporaryDirectory() as folder:
                draw = Draw(arguments.seed, number, folder, corpus)
                r = draw.random
                name = r.choice([name for name in programs for _ in range(weights.get(name, 1))])
                options, codes, takes_mesh = known[name]
                command = [programs[name]]
                if takes_mesh and r.random() < 0.95:
                    command.append(draw.file(".off", "mesh", r.random() < 0.3))
                draw.program, usual = name, USUAL.get(name, [])
                if name == "sweep_queries" and r.random() < 0.95:
                    command.append(draw.file(".queries", "in", r.random() < 0.8))
                chosen = {o.name for o in options if (o.name in usual and r.random() < 0.8) or r.random() < r.choice([0, 0, 0.05, 0.2])}
                chosen |= {need for o in options if o.name in chosen and r.random() < 0.9 for need in o.needs}
                chosen = [o for o in options if o.name in chosen]
                spoiled = r.sample(range(len(chosen)), min(len(chosen), r.choice([0, 1, 1, 2])))
                for k, option in enumerate(chosen):
                    command += [option.name, *(draw.value(option.name, option.choices, k not in spoiled) for _ in range(option.values))]
                for option, value in SMALLEST.get(name, {}).items():
                    command += [option, value] if option not in command else []
                if name == "haptic_loop" and "--seconds" not in command:
                    command += ["--seconds", "0.1"]
                stdin = draw.damaged(b'{"op": "forward", "theta": [0.1, 0.2, 0.3]}\n' * 3) if name == "device_calculator" else b""
                command = [c.replace("\0", "") for c in command]
                code, output, was_asked = run(command, stdin, folder)
                ends[name, code] = ends.get((name, code), 0) + 1
                asked += was_asked
                faults = faults_of(draw, name, codes, command, code, output, was_asked, programs["sculpt"])
                if faults:
                    found += 1
                    print(f"run {number}: {'; '.join(faults)}\n  {' '.join(shlex.quote(c) for c in command)}".encode(errors="replace").decode())
                    print("  " + output.decode(errors="replace")[-400:].replace("\n", "\n  "))
                    if arguments.keep:
                        shutil.copytree(folder, os.path.join(arguments.keep, f"run{number}"), dirs_exist_ok=True)
    for (name, code), count in sorted(ends.items(), key=str):
        print(f"{name}: {count} times exit {code}")
    print(f"{arguments.runs} runs, {asked} asked to end, {found} with faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
