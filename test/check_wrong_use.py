#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_wrong_use.py ROOT: scripts that are used wrongly end with exit code 2 and a message, before any work; nothing
is built. In a copy of a tree that has no build and no programs but those below."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve()
faults = []
TRACE = "t,tx,ty,tz,x,y,z,fcx,fcy,fcz,fx,fy,fz,cpu_ns"
NO_REGEX = "is no regular expression"


def expect(code, said, *words, **more):
    try:
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=60, **more)
    except subprocess.TimeoutExpired:
        faults.append(f"{words} does not end")
        return
    told = done.stdout + done.stderr
    if done.returncode != code or said not in told or "Traceback" in told:
        faults.append(f"{words}: exit {done.returncode}, expected {code} and '{said}': {told[-500:]}")


def program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


def python_scripts(tree):
    # A test that passes at once, with one randomised case: what would begin to run would end with 0.
    program(tree / "build/test/test_a", '#!/bin/sh\n[ "$1" != --list_content ] || echo case_a\necho seed 1\n')
    program(tree / "build-test/test/fuzz/fuzz_a", "#!/bin/sh\necho no promise broken\n")
    seeds, fuzz = tree / "test/seeds", (tree / "test/fuzz/run", "--no-build", "--preset", "test")
    soak, memory = tree / "test/soak/run", (tree / "test/soak/loop_memory.py", "true", "none.off")
    expect(0, "1 randomised cases", sys.executable, seeds, "--seeds", "2", "--json", tree / "seeds.json")
    expect(0, "| `fuzz_a` | 3 |", sys.executable, *fuzz, "--runs", "3", "-R", "_a$")
    for said, *words in (
            (NO_REGEX, seeds, "-R", "("), ("'nan'", seeds, "--hours", "nan"), ("'0'", seeds, "--seeds", "0"),
            ("cannot be written", seeds, "--json", "/nowhere/x.json"), ("--share", seeds, "--share", "nan"),
            ("'-1'", seeds, "--first", "-1"), ("no such test", seeds, "-R", "none"),
            ("cannot be written", tree / "test/planted_faults", "--json", "/nowhere/x.json"),
            (NO_REGEX, *fuzz, "-R", "("), ("'0'", *fuzz, "--cores", "0"), ("'-1'", *fuzz, "--runs", "-1"),
            ("'-1'", *fuzz, "--seed", "-1"), ("'0'", *fuzz, "--programs", "0"), ("no such target", *fuzz, "-R", "none"),
            (NO_REGEX, tree / "test/numerics", "-R", "("), (NO_REGEX, tree / "test/numerics", "--tests", "("),
            ("'0'", tree / "test/numerics", "--scale", "0"), (NO_REGEX, tree / "test/coverage", "-R", "("),
            ("'x'", tree / "test/coverage", "--jobs", "x"), ("'nan'", soak, "--no-build", "--minutes", "nan"),
            ("a loop has to have begun", soak, "--no-build", "--minutes", "0.01"),
            ("a loop has to have begun", soak, "--no-build", "--minutes", "-1"),
            ("is not built", soak, "--no-build", "--preset", "debug"),
            ("the loop has to have begun", *memory, "--minutes", "0.01")):
        expect(2, said, sys.executable, *words)


def with_programs_of_its_own(tree, **texts):
    """An environment for a script, in which these come first."""
    folder = tree / "_".join(texts)
    for name, text in texts.items():
        program(folder / name, f"#!/bin/sh\n{text}\n")
    return {"env": {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}}


def numerics(tree):
    """A number that is none is far, wherever it stands, and so is what is no longer 0; zeros are not. A part that is
    missing is not the same."""
    words = (sys.executable, tree / "test/numerics", "--build", tree / "numerics", "-R", "^clang.. -O3$")
    for said, code, numbers in (("| 0e+00 |", 0, "0 -0 0"), ("| inf **far** |", 1, "0 0 1e-300"),
                                ("| inf **far** |", 1, "nan 0 0"), ("| inf **far** |", 1, "0 nan 0")):
        for name, told in (("g_Debug", "0 0 0"), ("clang_O3", numbers)):
            program(tree / "numerics" / name / "test/result_bits/result_bits",
                    f"#!/bin/sh\nfor part in scene sweeps validate axis_moves finding edits; do echo $part 1; done\necho device place 1 2 3\necho device torque {told}\n")
        expect(code, said, *words, **with_programs_of_its_own(tree, cmake="true"))
    program(tree / "numerics/g_Debug/test/result_bits/result_bits", "#!/bin/sh\necho scene 1\necho sweeps 1\necho device place 1\n")
    expect(1, "lacks what is to be compared: validate", *words, **with_programs_of_its_own(tree, cmake="true"))


def coverage(tree):
    """Counts of earlier runs are no part of a run's."""
    old = tree / "build-coverage/test/old.gcda"
    old.parent.mkdir(parents=True)
    tools = {"gcovr": "echo '{\"files\": []}'", "clang++": "true", "llvm-cov": "true", "ctest": "true"}
    path = with_programs_of_its_own(tree, **tools)
    (tree / "include/haptic_sculpt").mkdir(parents=True)
    for words, is_kept in ((["--no-run"], True), (["--no-build"], False)):
        old.write_text("counts")
        expect(0, "| all | 0 |", sys.executable, tree / "test/coverage", *words, **path)
        if old.exists() != is_kept:
            faults.append(f"coverage {words}: counts of earlier runs are {'lost' if is_kept else 'added'}")


def test_run(tree):
    """With a cmake that ends with 9: so far, and no farther, right uses come."""
    program(tree / ".ci/install_packages", "")
    program(tree / "bin/cmake", "#!/bin/sh\nexit 9\n")
    program(tree / "bin/ctest", "#!/bin/sh\nexit 8\n")
    path = {"env": {**os.environ, "PATH": f"{tree / 'bin'}:{os.environ['PATH']}"}}
    run = ("bash", tree / "test/run")
    for words in ([], ["--quick"], ["--sanitize", "-R", "a"], ["--thread-sanitizer", "-V"], ["-R", "a b", "-j4"]):
        expect(9, "", *run, *words, **path)
    for said, *words in (("--quick has to come first", "-R", "a", "--quick"),
                         ("--sanitize has", "--quick", "--sanitize"),
                         ("--thread-sanitizer has", "-V", "--thread-sanitizer"),
                         ("'collision' belongs", "collision"), ("'b' belongs", "-R", "a", "b"),
                         ("'b' belongs", "--quick", "b"), ("'--sanitze' is none", "--sanitze"),
                         ("-R lacks", "-R"), ("'--nope' is none", "--sanitize", "-j4", "--nope")):
        expect(2, said, *run, *words, **path)
    expect(2, "cannot create directory", "bash", ROOT / "test/newer_cgal", "sid", tree / "test/run")
    expect(2, "prints the folder", "bash", ROOT / "test/newer_cgal", "sid")
    told = with_programs_of_its_own(tree, ctest='echo "$@"', cmake="true", python3="true")
    for words in (["-V"], ["-R", "b"]):
        expect(0, " ".join(["-R ^(test_threads|test_exchange|haptic_loop_program)$", *words]),
               *run, "--thread-sanitizer", *words, **told)
    for words in (["--help"], ["-R", "a", "-h"]):
        expect(0, "Installs what is missing", *run, *words, **path)


def plots(folder):
    python = next((p for p in (sys.executable, "/usr/bin/python3") if subprocess.run(
        [p, "-c", "import matplotlib, numpy"], capture_output=True).returncode == 0), None)
    if python is None:
        print("skipped: the plots, because python3-matplotlib is not installed")
        return
    examples, quality = ROOT / "examples", ROOT / "benchmark/quality"
    trace, samples = (python, examples / "haptic_loop/draw_trace.py"), (python, examples / "plot_device_workspace.py")
    passivity, chain = ((python, quality / f"plot_haptic_{name}.py") for name in ("passivity", "chain"))
    tables = (python, quality / "tabulate_guard_for_cgal.py")
    good, row = folder / "good", "1," * TRACE.count(",") + "1000"
    good.write_text(f"{TRACE}\n{row}\n{row}\n")
    expect(0, "", *trace, good, folder / "trace.png")
    expect(2, "nowhere/trace.png", *trace, good, folder / "nowhere/trace.png")
    for name, text in (("empty", b""), ("binary", b"\xff\xfe\0"), ("no_column", b"a,b\n1,2\n"),
                       ("no_row", f"{TRACE}\n".encode()), ("short", f"{TRACE}\n1\n".encode()),
                       ("nan", f"{TRACE}\n{row[:-4]}nan\n".encode()), ("other.json", b"[]"), ("none.json", b"{}"),
                       ("folder", None), ("lost", None),
                       ("other_part.json", b'{"effects": [{"effect": 1}], "chart": [], "comparisons": [{"way": 1}]}'),
                       ("other_kind.json", b'{"effects": 5, "chart": 5, "comparisons": 5}')):
        given = folder / name
        if text is not None:
            given.write_bytes(text)
        elif name == "folder":
            given.mkdir()
        expect(2, str(given), *trace, given, folder / "none.png")
        expect(2, str(given), *samples, given, folder / "none.png")
        expect(2, str(given), *tables, given)
        if name in ("binary", "none.json", "lost", "other_part.json", "other_kind.json"):
            expect(2, str(given), *passivity, given, folder / "none.png")
            expect(2, str(given), *chain, given, folder / "none.png")
    good.write_text("0 0 0 1 1 1 1 1\n0.001 0.001 0 1 2 1 1 1\n")
    expect(0, "", *samples, good, folder / "samples.png")
    expect(2, "nowhere/samples.png", *samples, good, folder / "nowhere/samples.png")
    good.write_text("0 1 0 1 1 1 1 1\n")
    expect(2, "near the plane", *samples, good, folder / "none.png")
    good.write_text(json.dumps({"effects": [{"effect": effect, "least_energy_J": -0.001, "force_off_mean_N": 0.1,
                                             "force_off_largest_N": 1} for effect in "ab"]}))
    expect(0, "", *chain, good, folder / "chain.png")
    expect(2, "nowhere/chain.png", *chain, good, folder / "nowhere/chain.png")
    for name in ("trace.png", "samples.png", "chain.png"):
        if not (folder / name).exists():
            faults.append(f"{name} is not drawn")
    for script in (trace, samples, passivity, chain):
        expect(2, "usage", *script)
        before = (folder / "chain.png").read_bytes()
        expect(2, "name another file", *script, folder / "chain.png", folder / "chain.png")
        if before != (folder / "chain.png").read_bytes():
            faults.append(f"{script[1]} has written over what it reads")
    expect(0, "usage", *tables, "--help")


with tempfile.TemporaryDirectory() as place:
    tree = pathlib.Path(place) / "tree"
    for name in ("test/run", "test/seeds", "test/planted_faults", "test/numerics", "test/coverage",
                 "test/argument_types.py", "test/fuzz/run", "test/soak/run", "test/soak/loop_memory.py",
                 "test/examples/hand_paths.py"):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tree / name)
    python_scripts(tree)
    numerics(tree)
    coverage(tree)
    test_run(tree)
    plots(pathlib.Path(place))
print(f"{len(faults)} faults", *faults, sep="\n")
sys.exit(1 if faults else 0)
