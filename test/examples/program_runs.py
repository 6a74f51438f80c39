# SPDX-License-Identifier: GPL-3.0-or-later
"""What the checks of the programs share: running them as a user would, and looking at what they say.

Each has the arguments: sculpt, source folder, and for some a further program."""
import hashlib
import os
import resource
import subprocess
import sys

SCULPT, SOURCE = map(os.path.abspath, sys.argv[1:3])
FURTHER = os.path.abspath(sys.argv[3]) if len(sys.argv) > 3 else ""
IS_SANITIZED = "sanitize" in SCULPT  # it is slow, takes signals of faults itself, and much memory
PATIENCE = 1200 if IS_SANITIZED else 120  # seconds that a program may take
FAULTS = []
OCTAHEDRON = ("OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
              "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n")
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0.1 0.1 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


def check(condition, what):
    if not condition:
        FAULTS.append(what)
        print("FAULT:", what)


def run(*arguments, program=SCULPT, script=None, limit=None, memory=None, processes=None, folder=None, user=None,
        seconds=PATIENCE):
    def set_limits():
        for which, value in ((resource.RLIMIT_FSIZE, limit), (resource.RLIMIT_AS, memory),
                             (resource.RLIMIT_NPROC, processes)):
            if value is not None:
                resource.setrlimit(which, (value, value))

    # Python ignores SIGXFSZ; that the program does so too is checked by restoring signals.
    return subprocess.run([program, *map(str, arguments)], input=script, capture_output=True, text=True, timeout=seconds,
                          cwd=folder, preexec_fn=set_limits, restore_signals=True, user=user, group=user,
                          extra_groups=[] if user else None)


def fails(code, parts, done, what):
    check(done.returncode == code, f"{what}: exit {done.returncode}, expected {code}: {done.stderr}")
    for part in parts:
        check(part in done.stderr, f"{what}: the message does not say '{part}': {done.stderr}")


def points(path):
    lines = [line for line in open(path).read().split("\n") if line and not line.startswith("#")]
    return [tuple(map(float, line.split())) for line in lines[2:2 + int(lines[1].split()[0])]]


def surface(path):
    """Points, and faces in an order of their own: undo may give elements other indices, and with them another order in the file."""
    lines = [line.split() for line in open(path).read().split("\n") if line and not line.startswith("#")]
    first = 2 + int(lines[1][0])
    faces = [[int(v) for v in line[1:]] for line in lines[first:first + int(lines[1][1])]]
    return points(path), sorted(face[face.index(min(face)):] + face[:face.index(min(face))] for face in faces)


def up_to_last_tick(log):
    """Of a log of haptic_loop."""
    end = at = 0
    for line in log.split(b"\n")[:-1]:
        at += len(line) + 1
        end = at if line.startswith(b"# tick ") else end
    return log[:end]


def before_open_stroke(lines):
    """The lines of a script before the outermost stroke that is open at its end; None where none is."""
    begun = []  # strokes by number, and batches as 0, that no line has ended
    number, depth, first = 0, 0, 0  # of the last stroke: which, how often it is open, where it begins
    for i, line in enumerate(lines):
        word = line.split("#")[0].split()[:1]
        if word == ["stroke"]:
            if depth == 0:
                number, first = number + 1, i
            depth += 1
            begun.append(number)
        elif word == ["shift"]:
            begun.append(0)
        elif word == ["end"] and begun:
            depth -= begun.pop() == number and depth > 0
        elif word in (["undo"], ["redo"]):
            depth = 0
    return lines[:first] if depth else None


LINES_OF_HEAD = 5  # of a log: version, mesh, response, clearance, delta


def whole_edits(log):
    """The lines of a log that are whole, without a batch that is not."""
    lines = log[:log.rfind(b"\n") + 1].decode().splitlines(keepends=True)
    words = [line.split("#")[0].split()[:1] for line in lines]
    begins = [i for i, word in enumerate(words) if word == ["shift"]]
    return lines[:begins[-1]] if begins and ["end"] not in words[begins[-1]:] else lines


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()


def write(path, contents):
    with open(path, "wb") as file:
        file.write(contents if isinstance(contents, bytes) else contents.encode())
    return path


def two_octahedra(path):
    """Apart by 2 along x; the second has the vertices from 6 on."""
    lines = OCTAHEDRON.split("\n")
    at, faces = lines[2:8], lines[8:16]
    beyond = [f"{int(p.split()[0]) + 4} {p.split()[1]} {p.split()[2]}" for p in at]
    others = ["3 " + " ".join(str(int(v) + 6) for v in f.split()[1:]) for f in faces]
    return write(path, "\n".join(["OFF", "12 16 0", *at, *beyond, *faces, *others, ""]))


def failing_calls(folder):
    """The library of failing_calls.c, built there."""
    library = os.path.join(folder, "failing_calls.so")
    source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "failing_calls.c")
    subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-o", library, source, "-ldl"], check=True)
    return library


def sha256(path):
    return hashlib.sha256(bytes_of(path)).hexdigest()


def end():
    print(len(FAULTS), "faults")
    sys.exit(1 if FAULTS else 0)
