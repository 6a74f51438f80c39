#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_merge.py [FOLDER OF merge_shards.py]: the merge of drawn runs, against the same run counted without shards.

The runs are drawn here: units with counts, largest values and promises, shared out by number as the programs do. What
is no run, or cannot be written, ends with a message and its exit code."""
import json
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

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


def merge_by_command(target, *files):
    # Bounded: a list of 10^12 shards would take all memory there is.
    command = [sys.executable, merge_shards.__file__, "--json", target, *files]
    done = subprocess.run(command, capture_output=True, text=True,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30)))
    return done.returncode, done.stderr


def wrong_use(folder):
    """[what is wrong]"""
    found = []

    def expect(code, said, target, *files):
        told = merge_by_command(target, *files)
        if told[0] != code or said not in told[1] or "Traceback" in told[1]:
            found.append(f"{[str(f) for f in (target, *files)]}: {told}")

    units = [(0, 5, 0, 0.5), (1, 7, 0, 0.25)]
    shards = [folder / "s0.json", folder / "s1.json"]
    for i, shard in enumerate(shards):
        shard.write_text(json.dumps(report(units, i, 2, SEED)))
    before = [shard.read_text() for shard in shards]
    merged, link = folder / "merged.json", folder / "link.json"
    link.symlink_to("merged.json")
    (folder / "linked.json").symlink_to("s0.json")
    expect(0, "", link, *shards)
    if not link.is_symlink() or json.loads(merged.read_text())["shard"] != "0/1":
        found.append("the report is not written where a link leads")
    for target in (shards[0], folder / "linked.json"):
        expect(2, f"{target} is a shard", target, *shards)
    for target in ("/nowhere/m.json", "/dev/full", folder):
        expect(5, f"{target} cannot be written", target, *shards)
    expect(0, "", "/dev/null", *shards)
    promise = report(units, 0, 1, SEED)["promises"][0]
    for text in ('{"shard": "0/1", "promises": 7}', '{"shard": "0/1", "promises": [{}]}',
                 '{"shard": "0/1", "exit": "x"}', json.dumps({"shard": "0/1", "promises": [{**promise, "may": None}]}),
                 "[" * 100000, '{"shard": "0/1", "a": ' + "[" * 300 + "]" * 300 + "}",
                 '{"shard": "0/1", "rows": [{"unit": []}]}'):
        odd = folder / "odd.json"
        odd.write_text(text)
        expect(2, "odd.json", folder / "none.json", odd)
    (folder / "odd.json").write_text('{"shard": "0/1000000000000"}')
    expect(2, "missing: shard 1/1000000000000", folder / "none.json", folder / "odd.json")
    if [shard.read_text() for shard in shards] != before:
        found.append("a shard is written over")
    left = sorted(path.name for path in folder.iterdir())
    if left != ["link.json", "linked.json", "merged.json", "odd.json", "s0.json", "s1.json"]:
        found.append(f"files are left: {left}")
    return found


draw = random.Random(SEED)
faults = []
with tempfile.TemporaryDirectory() as place:
    faults += wrong_use(pathlib.Path(place))
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
