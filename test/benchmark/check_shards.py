#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_shards.py ROOT PROGRAM ...: the merged report of three shards is that of the run without shards, but for times.

And the merge refuses what is not one whole run: a shard left out, given twice, or of another seed. A program that is given a mesh
says so where it cannot be read. Whole numbers are decimal, and what is none is refused."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(root / "benchmark" / "common"))
import merge_shards

SHARDS = 3
OPTIONS = {"robustness": "--drags 40 --edits 40 --batch 20 --edit-batch 20 --extreme 20", "drag_speed_error": "--drags 6",
           "edit_performance": "--samples 20 --largest 6000 --largest-valence 16", "certify_ends": "--drags 3 --per-scene 1 --ways 20",
           "device_speed_error": "--count 64", "axis_speed_error": "--queries 030", "haptic_passivity": "--parts rate",
           "brush_dabs": "--level 3 --dabs 4 --vertices 40", "threads": "--level 3 --moves 2 --threads 1,2", "validation": "--largest 1000",
           "response_quality": "--drags 3", "sweep_speed_error": "--queries 10", "many_vertices_speed_error": "--rounds 1 --mesh MESH",
           "guard_for_cgal": "--quick --drags-a-vertex 2 --iterations 1 --no-large", "simplification": "--level 2",
           "hand_drags": "--level 3 --drags 600",
           "drag_performance": "--sizes 1000 --valences 3,8 --drags 30 --peer-drags 10 --core -1"}
MESH_OPTION = {"brush_dabs": "--mesh", "threads": "--mesh", "many_vertices_speed_error": "--mesh",
               "simplification": "--meshes"}


def write_torus(path, around=6, across=4):
    """For a program whose own meshes take minutes, unoptimised."""
    turn = [2 * math.pi * k / around for k in range(around)], [2 * math.pi * k / across for k in range(across)]
    points = [((2 + math.cos(b)) * math.cos(a), (2 + math.cos(b)) * math.sin(a), math.sin(b)) for a in turn[0] for b in turn[1]]
    corner = lambda i, j: i % around * across + j % across
    faces = [f for i in range(around) for j in range(across)
             for f in ((corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)), (corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)))]
    path.write_text(f"OFF\n{len(points)} {len(faces)} 0\n" + "".join("%r %r %r\n" % p for p in points) + "".join("3 %d %d %d\n" % f for f in faces))


def untimed(value):
    """Without all that hangs on the clock."""
    if isinstance(value, dict):
        return {k: untimed(v) for k, v in value.items() if not merge_shards.is_time(k)}
    return [untimed(v) for v in value] if isinstance(value, list) else value


def difference(a, b, where=""):
    """Where two reports differ first; None where they do not."""
    if isinstance(a, dict) and isinstance(b, dict):
        for k in {**a, **b}:
            if (found := difference(a.get(k), b.get(k), f"{where}/{k}")) is not None:
                return found
        return None
    if isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        return next((d for i, (x, y) in enumerate(zip(a, b)) if (d := difference(x, y, f"{where}[{i}]")) is not None), None)
    # Sums in another order: nothing but rounding may differ.
    if isinstance(a, float) and isinstance(b, float) and abs(a - b) <= 1e-12 * max(abs(a), abs(b)):
        return None
    return None if a == b else f"{where}: {a!r} whole, {b!r} merged"


def run(program, folder, name, *arguments):
    file = folder / f"{name}.json"
    done = subprocess.run([program, *arguments, "--json", str(file)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if not file.exists():
        sys.exit(f"{program} {' '.join(arguments)} ended with {done.returncode} and no report:\n{done.stdout[-2000:]}")
    return file, done.returncode


def merge_of(files, folder):
    merged = folder / "merged.json"
    done = subprocess.run([sys.executable, str(root / "benchmark/common/merge_shards.py"), "--json", str(merged), *map(str, files)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return merged, done.returncode, done.stdout


faults = []
for program in sys.argv[2:]:
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        write_torus(folder / "torus.off")
        options = OPTIONS[pathlib.Path(program).name].replace("MESH", str(folder / "torus.off")).split()
        whole, code = run(program, folder, "whole", *options)
        shards = [run(program, folder, f"shard{i}", *options, "--shard", f"{i}/{SHARDS}")[0] for i in range(SHARDS)]
        merged, merged_code, output = merge_of(reversed(shards), folder)  # in any order
        name = pathlib.Path(program).name
        if merged_code != code:
            faults.append(f"{name}: the whole run ends with {code}, the merge with {merged_code}: {output}")
            continue
        reports = [json.loads(f.read_text()) for f in (whole, merged)]
        found = difference(*map(untimed, reports))
        if found is not None:
            faults.append(f"{name}{found}")
        parts = [len(f.read_text()) for f in shards]
        if min(parts) >= len(whole.read_text()):
            faults.append(f"{name}: each shard says as much as the whole run: nothing was shared out")
        for wrong, why in (([shards[0], shards[2]], "missing: shard 1/3"), ([*shards, shards[1]], "there twice")):
            _, wrong_code, output = merge_of(wrong, folder)
            if wrong_code != 2 or why not in output:
                faults.append(f"{name}: {why!r} is not said of {len(wrong)} shards, but: {output}")
        other = json.loads(shards[1].read_text())
        other["seed"] = 99
        shards[1].write_text(json.dumps(other))
        if "seed" in reports[0] and merge_of(shards, folder)[1] != 2:
            faults.append(f"{name}: a shard of another seed is merged")
        if name == "axis_speed_error" and reports[0]["queries_per_population"] != 30:
            faults.append(f"{name}: --queries 030 is {reports[0]['queries_per_population']}")
        wrong_numbers = [("--seed", "-1"), ("--seed", "0x10")] if "seed" in reports[0] else []
        for option, number in wrong_numbers + [("--queries", "0")] * (name == "axis_speed_error"):
            refused = subprocess.run([program, option, number], capture_output=True, text=True, timeout=100)
            if refused.returncode != 2 or option not in refused.stderr or len(refused.stderr) > 300:
                faults.append(f"{name}: {option} {number}: exit {refused.returncode}, {refused.stderr}")
        if name in MESH_OPTION:
            command = [program, MESH_OPTION[name], str(folder / "lost.off")]
            lost = subprocess.run(command, capture_output=True, text=True)
            if lost.returncode != 2 or "lost.off" not in lost.stderr or lost.stderr.count("\n") != 1:
                faults.append(f"{name}: a mesh that is not there: exit {lost.returncode}, {lost.stderr}")
        print(f"{name}: exit {code}, {len(whole.read_text())} bytes whole, {parts} in shards")
print(*faults, sep="\n")
sys.exit(1 if faults else 0)
