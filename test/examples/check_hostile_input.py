# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are made to hurt: headers that promise 10^18 of something, one endless line, text of another encoding,
links in a circle, JSON that is nested deep, a script of too many lines. Each is refused with an exit code and a
message of the program's own, within a bound on the memory.

Arguments: sculpt, source folder, haptic_loop. HAPTIC_SCULPT_LINE says how many MiB the endless lines have (16)."""
import os
import resource
import subprocess
import tempfile

from program_runs import FURTHER as LOOP, IS_SANITIZED, OCTAHEDRON, SCULPT, TETRAHEDRON, check, end, write

LINE = int(os.environ.get("HAPTIC_SCULPT_LINE", "16")) << 20
# What the program takes by itself, and lists of what it reads: beside the file, which it holds once.
BESIDE_THE_FILE = 64 << 20
PATIENCE = 600  # seconds: half a GiB of a line takes a minute in a build for the tests
MANY = 10 ** 18

PLY = ("ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
       "element face {}\nproperty list {} int vertex_indices\nend_header\n")
BINARY = PLY.replace("{} 1.0", "binary_little_endian 1.0")
POINTS = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"


def refused(folder, code, words, *arguments, program=SCULPT, size=0):
    """Ends with that code, says these words, and takes no more memory than the file and what is allowed beside it."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with open(f"{folder}/said", "w+b") as said:
        process = subprocess.Popen([program, *arguments], stdin=subprocess.DEVNULL, stdout=said, stderr=said,
                                   cwd=folder, preexec_fn=lambda: (limit(), resource.setrlimit(resource.RLIMIT_CPU,
                                                                                    (PATIENCE, PATIENCE))))
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read().decode(errors="replace")
    what = " ".join(arguments)
    check(process.returncode == code, f"{what}: exit {process.returncode}, expected {code}: {text[-300:]}")
    check(words in text, f"{what}: does not say '{words}': {text[-300:]}")
    check(len(text) < 20000, f"{what}: says {len(text)} bytes")
    taken = used.ru_maxrss << 10
    check(taken <= size + BESIDE_THE_FILE or IS_SANITIZED,
          f"{what}: takes {taken >> 20} MiB for a file of {size >> 20} MiB")
    return taken


def endless(path, start):
    """A line that does not end; a file with a hole, which takes no disk."""
    with open(path, "wb") as file:
        file.write(start)
        file.truncate(LINE)
    return path


def main():
    with tempfile.TemporaryDirectory() as folder:
        at = lambda name: os.path.join(folder, name)
        write(at("good.off"), TETRAHEDRON)
        for name, text in (("vertices.off", f"OFF\n{MANY} 4 0\n{POINTS}"), ("faces.off", f"OFF\n4 {MANY} 0\n{POINTS}"),
                           ("vertices.ply", PLY.format("ascii", MANY, 4, "uchar") + POINTS),
                           ("faces.ply", PLY.format("ascii", 4, MANY, "uchar") + POINTS),
                           ("binary.ply", BINARY.format(MANY, 4, "uchar") + "x" * 200),
                           ("binary_faces.ply", BINARY.format(4, MANY, "uchar") + "x" * 200)):
            write(at(name), text)
            refused(folder, 3, str(MANY), name)
        # Products of this with the bytes of an element are not integers of 64 bits.
        write(at("overflow.ply"), BINARY.format(2 ** 64 // 24 + 1, 4, "uchar") + "x" * 200)
        refused(folder, 3, "overflow.ply", "overflow.ply")
        write(at("long_face.off"), f"OFF\n4 1 0\n{POINTS}{MANY} 0 1 2\n")
        refused(folder, 3, "long_face.off", "long_face.off")
        write(at("far.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + f"f {MANY} 1 2\n")
        refused(folder, 3, "far.obj", "far.obj")
        write(at("facets.stl"), b"\0" * 80 + b"\xff" * 4 + b"\0" * 50)
        refused(folder, 3, "facets.stl", "facets.stl")
        for name, start in (("line.off", b"OFF\n4 4 0\n"), ("line.obj", b"v "), ("line.stl", b"solid "),
                            ("line.ply", b"ply\nformat ascii 1.0\ncomment ")):
            refused(folder, 3, name, os.path.basename(endless(at(name), start)), size=LINE)
            os.remove(at(name))
        endless(at("line.script"), b"drag ")
        # Twice: a text is copied where it grows.
        refused(folder, 4, "line.script", "good.off", "--script", "line.script", size=2 * LINE)
        endless(at("line.rec"), b"{")
        refused(folder, 6, "longer than 1 MiB", "--replay", "line.rec", program=LOOP)
        for encoding in ("utf-16", "utf-16-be", "utf-32"):
            write(at("other.off"), OCTAHEDRON.encode(encoding))
            refused(folder, 3, "other.off", "other.off")
            write(at("other.script"), "drag 0 1 1 1\n".encode(encoding))
            refused(folder, 4, "other.script", "good.off", "--script", "other.script")
        os.symlink("b.off", at("a.off"))
        os.symlink("a.off", at("b.off"))
        refused(folder, 3, "'a.off': this cannot be reached", "a.off")
        refused(folder, 4, "a.off", "good.off", "--script", "a.off")
        refused(folder, 5, "a.off", "good.off", "-o", "a.off")
        write(at("deep.json"), "[" * 1000000)
        refused(folder, 2, "deep", "--no-wait", "--seconds", "0.01", "--device", "deep.json", program=LOOP)
        write(at("names.ply"), "ply\nformat ascii 1.0\n" + "".join(f"element e{k} 0\n" for k in range(100000)))
        refused(folder, 3, "at most 1000 elements", "names.ply")


main()
end()
