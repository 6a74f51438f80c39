# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of programs drawn at random, for fuzz_programs.py: options, values, copies of good files, perhaps damaged."""
import os
import random
import re
import struct
import subprocess
import typing

TETRAHEDRON = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
OCTAHEDRON = "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n" + "".join(
    f"3 {a} {b} {c}\n"
    for a, b, c in [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
)
SMALL = {
    name: text.encode()
    for name, text in {
        "tetrahedron.off": "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + TETRAHEDRON,
        "octahedron.off": OCTAHEDRON,
        "two.off": "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n2 0 0\n3 0 0\n2 1 0\n2 0 1\n"
        + TETRAHEDRON
        + "3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n",
        "hand.json": '{"mass": [0, 0.2], "stiffness": [2000, 300], "damping": [2, 3]}',
        "named.json": '{"name": "finger"}',
        "device.json": '{"form": "general", "params": {"R": 0.06, "l1": 0.1, "l2": 0.12, "r": 0.03, "m1": 0.1, '
        '"m2": 0.1, "M": 0.1, "g": 9.81}}',
        "D1.json": '{"params": {"R": 0.06, "l1": 0.12, "l2": 0.12, "r": 0.06, "m1": 0.1, "m2": 0.1, "M": 0.1, '
        '"g": 9.81}}',
        "small.window-script": "brush inflate 0.3 0.1\ndrag 300 300 320 310 3\nkey u\ntool create\n"
        "click 300 280\nquit\n",
        "some.queries": "VF 0.25 0.25 1 0.25 0.25 -2 0 0 0 1 0 0 0 1 0\nEE 0 0 1 0x1p0 0 -1 1 1 0 0 1 0.25 1 0 0.25\n"
        "FV 0 0 1 0 0 -1 1 0 1 0 1 1 0.375 0.375 0\n# none\nAX VF 2 0 0 1 0 0 0 1 0 0 0 1 0 -1 0 0 0\n",
        "all.script": "drag 0 0.5 0.5 0.5\ninsert_face 0 1 2 0.2 0.2 0.2\nundo\nredo\n"
        "brush inflate 0 0 0 1 0.1\nremesh 0.3\n"
        "stroke\nremove 1\nend\nflip 0 1\ncollapse 0 1\ndelta 1e-6\nclearance 1e-9\nresponse stop\n",
    }.items()
}

WHOLE_NUMBERS = [0, 1, 2, 3, 7, 100, 2**31 - 1, 2**31, 2**32, 2**63 - 1, 2**64 - 1, 2**64, -1, -(2**63)]
WORDS = ["", "-", "--", "é\u202e", "\udcff\udcfe", "a" * 5000, "%s%n", "$(true)", "edit", "@0,0,0", "@nan,0,0",
         "slide", "off", "..", "0", "nan@1", "jump@0", "jump@-1e300", "V"]

# Options that a program gets where none were drawn, so that a run takes milliseconds: where nothing else does it, a
# share of the work that is empty.
EMPTY_SHARE = {"--shard": "999/1000"}
SMALLEST = {
    "axis_speed_error": {"--queries": "1"},
    "brush_dabs": {"--level": "2", "--dabs": "1", "--vertices": "8"},
    "certify_ends": {"--drags": "1", "--ways": "1", **EMPTY_SHARE},
    "device_speed_error": {"--count": "1"},
    "drag_performance": EMPTY_SHARE,
    "drag_speed_error": {"--drags": "1", **EMPTY_SHARE},
    "edit_performance": {"--samples": "2", "--largest": "1000", "--largest-valence": "4"},
    "guard_for_cgal": {"--largest": "0", "--iterations": "1", **EMPTY_SHARE},
    "hand_drags": {"--level": "2", "--drags": "2"},
    "haptic_passivity": {"--parts": "rate", "--runs": "1", "--seconds": "0.01"},
    "haptic_ticks": {"--level": "2", "--ticks": "10", "--depth": "0"},
    "many_vertices_speed_error": {"--level": "2", **EMPTY_SHARE},
    "response_quality": {"--drags": "1", **EMPTY_SHARE},
    "robustness": {"--drags": "2", "--drags-on-large": "0", "--edits": "2", "--edits-on-large": "0"},
    "simplification": {"--level": "2", **EMPTY_SHARE},
    "sweep_speed_error": {"--queries": "1"},
    "threads": {"--level": "2", "--moves": "1"},
    "validation": {"--largest": "1000", **EMPTY_SHARE},
}
# The others 20; those at 1 take seconds for any options. sculpt and haptic_loop get about the same time of a processor.
OFTEN = {
    "sculpt": 1000,
    "haptic_loop": 250,
    "device_calculator": 200,
    "sculpt_window": 200,
    "sweep_queries": 200,
    "certify_ends": 1,
    "haptic_passivity": 1,
    "many_vertices_speed_error": 1,
    "response_quality": 1,
}
# Of ten runs that would draw a picture one does: it takes 0.2 s, of OpenGL's driver.
PICTURES = 0.1
# What stands without an option's name: kinds of files, and how often they are damaged; None: an output.
ARGUMENTS = {
    "sculpt": {".off": 0.3},
    "haptic_loop": {".off": 0.3},
    "sculpt_window": {".off": 0.3},
    "sweep_queries": {".queries": 0.8},
    "device_workspace": {".txt": None, ".json": 0.6},
}
FAULT_OF_THE_PROGRAM = 1
USUAL = {
    "sculpt": ["--script", "--output", "--report"],
    "haptic_loop": ["--output", "--no-wait", "--report"],
    "sculpt_window": ["--script", "--screenshot", "--no-log"],
}
READ = {
    "--script": ".script",
    "--mesh": ".off",
    "--large": ".off",
    "--hand": ".json",
    "--device": ".json",
    "--path": ".csv",
    "--replay": ".rec",
}
WRITTEN = {
    "--output": ".off",
    "--report": ".json",
    "--repair-report": ".json",
    "--picture": ".png",
    "--compare": ".png",
    "--record": ".rec",
    "--trace": ".csv",
    "--json": ".json",
    "--screenshot": ".png",
}


class Option(typing.NamedTuple):
    name: str
    values: int
    choices: list
    needs: list


def options_of(program):
    """The options and the exit codes, from --help."""
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
        options.append(Option(name, values, choices.group(1).split(",") if choices else [],
                              needs.group(1).split() if needs else []))
    codes = {int(code) for line in re.findall(r"Exit:(.*\n.*)", text) for code in re.findall(r" (\d+) [a-z]", line)}
    return options, codes - {FAULT_OF_THE_PROGRAM}


class Draw:
    """Run NUMBER of SEED, from random numbers of its own."""

    def __init__(self, seed, number, folder, programs, corpus):
        """programs: options_of() by name; corpus: (name, bytes) of good files"""
        self.random = r = random.Random(f"{seed}/{number}")
        self.folder, self.corpus = folder, corpus
        self.inputs = {}  # bytes by path
        self.program = name = r.choice([name for name in programs for _ in range(OFTEN.get(name, 20))])
        options, self.codes = programs[name]
        words = []
        for suffix, damaged in ARGUMENTS.get(name, {}).items():
            if r.random() < 0.95:
                is_output = damaged is None
                words.append(os.path.join(folder, "out" + suffix) if is_output else
                             self.file(suffix, "argument", r.random() < damaged))
        chosen = {
            o.name
            for o in options
            if (o.name in USUAL.get(name, []) and r.random() < 0.8) or r.random() < r.choice([0, 0, 0.05, 0.2])
        }
        chosen |= {need for o in options if o.name in chosen and r.random() < 0.9 for need in o.needs}
        if r.random() >= PICTURES:
            chosen -= {o.name for o in options if o.name.startswith("--picture") or o.name == "--compare"}
        chosen = [o for o in options if o.name in chosen]
        spoiled = r.sample(range(len(chosen)), min(len(chosen), r.choice([0, 1, 1, 2])))
        for k, option in enumerate(chosen):
            values = (self.value(option.name, option.choices, k not in spoiled) for _ in range(option.values))
            words += [option.name, *values]
        smallest = dict(SMALLEST.get(name, {}))
        if name == "haptic_loop":  # the hand has edited by 8 s; without waiting that takes 0.1 s
            smallest["--seconds"] = "8" if "--no-wait" in words and r.random() < 0.1 else "0.02"
        for option, value in smallest.items():
            words += [option, value] if option not in words and "--replay" not in words else []
        self.arguments = [word.replace("\0", "") for word in words]
        self.stdin = (
            self.damaged(b'{"op": "forward", "theta": [0.1, 0.2, 0.3]}\n' * 3) if name == "device_calculator" else b""
        )

    def number(self):
        r = self.random
        kinds = [
            lambda: repr(struct.unpack("d", struct.pack("Q", r.getrandbits(64)))[0]),
            lambda: repr(r.uniform(-2, 2)),
            lambda: repr(10.0 ** r.randint(-320, 308)),
            lambda: str(r.choice(WHOLE_NUMBERS)),
            lambda: struct.unpack("d", struct.pack("Q", r.getrandbits(64)))[0].hex(),
            lambda: r.choice(
                ["nan", "-nan", "inf", "-inf", "-0", "0x", "1e", "", " ", "1,5", "1e400", "+1", "++1", "0x1p-1074"]
            ),
        ]
        return r.choice(kinds)()

    def text(self):
        return self.random.choice(WORDS)

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
                del data[at : at + length]
            elif kind == 2:
                data[at:at] = data[max(0, at - length) : at]
            elif kind == 3:
                data[at:at] = f" {self.number()} ".encode("utf-8", "replace")
            elif kind == 4:
                del data[at:]
            elif kind == 5:
                data[at:at] = bytes(r.randrange(256) for _ in range(length))
            else:
                digits = re.search(rb"-?\d[\d.e+-]*", data[at:])
                if digits:
                    data[at + digits.start() : at + digits.end()] = self.number().encode("utf-8", "replace")
        return bytes(data)

    def file(self, suffix, name, damaged):
        """A copy of something like that from the corpus, perhaps damaged."""
        r = self.random
        data = r.choice([data for name, data in self.corpus if name.endswith(suffix)] or self.corpus[0][1:])
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
        if is_good:
            return good
        missing = os.path.join(self.folder, "none", "x" + (writes or ""))
        # To read what has no end until the limit takes a second: seldom.
        endless = ["/dev/full"] if writes or r.random() < 0.05 else []
        return r.choice([good + ".", os.path.join(self.folder, "outoutput.off"), missing, self.folder, "/dev/null",
                         "/proc/self/mem", "", *endless, *self.inputs])

    def value(self, name, choices, is_good):
        r = self.random
        if choices and (is_good or r.random() < 0.5):
            return r.choice(choices)
        if name in READ or name in WRITTEN or name == "--log":
            return self.path(name, is_good)
        if is_good:
            return r.choice(["0.001", "0.1", "0.5", "1", "4", "100", "1000"])
        return self.number() if r.random() < 0.9 else self.text()


def corpus_of(programs, source, folder):
    """(name, bytes) of good files of each kind, some of them made by the programs themselves."""
    data = os.path.join(source, "examples", "data")
    mesh, script = os.path.join(data, "ball_and_moon.off"), os.path.join(data, "demo.script")
    log, recording = os.path.join(folder, "good.log"), os.path.join(folder, "good.rec")
    subprocess.run([programs["sculpt"], mesh, "--script", script, "--log", log], check=True, capture_output=True)
    subprocess.run(
        [programs["haptic_loop"], "--no-wait", "--seconds", "0.2", "--record", recording],
        check=True,
        capture_output=True,
    )
    made = [
        os.path.join(data, name) for name in sorted(os.listdir(data)) if name.endswith((".off", ".script", ".csv"))
    ] + [log, recording]
    corpus = list(SMALL.items())
    for path in made:
        with open(path, "rb") as file:
            corpus.append((path, file.read()))
    return corpus
