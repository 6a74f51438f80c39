#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_dump.py ROBUSTNESS SCULPT: what `robustness` dumps of a batch, replayed by `sculpt`, gives the same mesh.

Drags, strokes of a hand, and mixed edits with undo, redo and strokes, with two clearances: the corners of all faces are
compared, to the last bit."""
import pathlib
import subprocess
import sys
import tempfile

ROBUSTNESS, SCULPT = sys.argv[1:3]
COMMON = "--drags-on-large 0 --edits-on-large 0 --seed 7 --dump-all --dump"
RUNS = {"odd": "--drags 40 --edits 150 --clearance 0,1e-6",
        "hand": "--motion hand --drags 150 --edits 0 --response stop"}


def faces(path):
    """The corners' coordinates of each face, from the least on: the same for the same mesh, whatever its numbers."""
    words = [w for line in path.read_text().splitlines() for w in line.split("#")[0].split()]
    n, m = int(words[1]), int(words[2])
    points = [tuple(map(float, words[4 + 3 * i:7 + 3 * i])) for i in range(n)]
    at, found = 4 + 3 * n, []
    for _ in range(m):
        corners = [points[int(w)] for w in words[at + 1:at + 4]]
        least = corners.index(min(corners))
        found.append(tuple(corners[least:] + corners[:least]))
        at += 4
    return sorted(found)


faults, counts, same = [], {}, {}
with tempfile.TemporaryDirectory() as place:
    for name, options in RUNS.items():
        folder = pathlib.Path(place) / name
        words = [ROBUSTNESS, *options.split(), *COMMON.split(), str(folder)]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            faults.append(f"{name}: robustness ended with {done.returncode}: {done.stdout[-1000:]}{done.stderr}")
        for script in sorted(folder.glob("*.script"))[:20]:
            out = folder / "out.off"
            words = [SCULPT, str(script.with_suffix(".off")), "--script", str(script), "-o", str(out)]
            replayed = subprocess.run(words, capture_output=True, text=True)
            kind = "edits" if "\nflip " in script.read_text() else f"drags, {name}"
            counts[kind] = counts.get(kind, 0) + 1
            if replayed.returncode != 0:
                faults.append(f"{script.name}: sculpt ended with {replayed.returncode}: {replayed.stderr[-500:]}")
            elif faces(out) == faces(script.with_name(script.stem + ".end.off")):
                same[kind] = same.get(kind, 0) + 1
            else:
                faults.append(f"{name}, {script.name}, {kind}: sculpt makes another mesh of it")
for kind in ("drags, odd", "drags, hand", "edits"):
    if counts.get(kind, 0) < 5:
        faults.append(f"only {counts.get(kind, 0)} batches of {kind}")
print(counts, same, f"{len(faults)} faults", *faults[:5], sep="\n")
sys.exit(1 if faults else 0)
