#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_merge.py [FOLDER OF merge_shards.py]: the merge of drawn runs, against the same run counted without shards.

The runs are drawn here: units with counts, largest values and promises, shared out by number as the programs do."""
import pathlib
import random
import sys

sys.path.insert(0, sys.argv[1] if len(sys.argv) > 1 else str(pathlib.Path(__file__).resolve().parents[2] / "benchmark" / "common"))
import merge_shards

ROWS, SEED = 200, 1


def report(units, shard, shards, seed):
    """What a program would write that makes these of the units: (row, drags, invalid, largest)."""
    rows, total, invalid, largest = {}, 0, 0, 0.0
    for number, (row, drags, bad, most) in enumerate(units):
        if number % shards != shard:
            continue
        r = rows.setdefault(row, {"unit": 10 * row, "mesh": f"mesh {row}", "faces": 100 + row, "drags": 0, "largest_error": 0.0, "tally": {"bad": 0}})
        r["drags"] += drags
        r["largest_error"] = max(r["largest_error"], most)
        r["tally"]["bad"] += bad
        total, invalid, largest = total + drags, invalid + bad, max(largest, most)
    promises = [{"exit": 10, "promise": "valid", "asked": total, "broken": invalid, "may": 0},
                {"exit": 11, "promise": "arrives", "asked": total, "broken": total // 3, "may": 0.5}]
    return {"seed": seed, "shard": f"{shard}/{shards}", "meshes": [rows[k] for k in sorted(rows)],
            "total": {"drags": total, "largest_error": largest}, "promises": promises, "exit": merge_shards.exit_of(promises)}


draw = random.Random(SEED)
faults = []
for trial in range(ROWS):
    units = [(draw.randrange(4), draw.randrange(1, 50), int(draw.random() < 0.02), draw.random()) for _ in range(draw.randrange(1, 30))]
    units.sort(key=lambda u: u[0])  # rows stand in the order of units
    shards = draw.randrange(1, 7)
    parts = [report(units, i, shards, SEED) for i in range(shards)]
    draw.shuffle(parts)
    whole, merged = report(units, 0, 1, SEED), merge_shards.merge(parts)
    for r in (whole, merged):  # counted in whole numbers, so it is lost in shards of few drags
        r["promises"][1].pop("broken")
    if whole != merged:
        faults.append(f"run {trial} in {shards} shards:\n  whole {whole}\n  merged {merged}")
    if (units and any(u[2] for u in units)) != (merged["exit"] == 10):
        faults.append(f"run {trial}: exit {merged['exit']}")
    if shards > 1:
        for wrong in (parts[1:], [*parts, parts[0]], [{**parts[0], "seed": 9}, *parts[1:]]):
            try:
                merge_shards.merge(wrong)
                faults.append(f"run {trial}: {[p['shard'] for p in wrong]} with seeds {[p['seed'] for p in wrong]} are merged")
            except merge_shards.Odd_shards:
                pass
print(f"{ROWS} runs, seed {SEED}, {len(faults)} faults", *faults[:3], sep="\n")
sys.exit(1 if faults else 0)
