#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what drag_performance --json has measured: python3 plot_drag_performance.py results.json doc/pictures/drag_performance.png"""
import json
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

BY_SIZE = [  # workload, step in edges, response, label
    ("new vertex", 0.1, "stop", "new vertex"),
    ("in a drag", 0.1, "stop", "in a drag, 0.1 edge"),
    ("in a drag", 0.01, "stop", "in a drag, 0.01 edge"),
    ("push until contact: the step that meets", 0.1, "stop", "the step that meets"),
    ("slide in contact", 0.1, "slide", "slide in contact"),
    ("push", 100, "stop", "push of 100 edges"),
]
PHASES = [("grab_ns", "grab"), ("broad_ns", "query"), ("checklist_ns", "checklist"), ("narrow_ns", "narrow"), ("stop_ns", "stop, contact planes"), ("response_ns", "response"),
          ("watch_and_history_ns", "watch, history"), ("update_at_release_ns", "update at release")]


def series(rows, structure, workload, step, response):
    found = [r for r in rows if r["structure"] == structure and r["workload"] == workload and r.get("step_edges") == step
             and r.get("response") == response and r.get("count", 0) > 0]
    return sorted(found, key=lambda r: r["triangles"])


def main(source, picture):
    with open(source) as file:
        results = json.load(file)
    rows, phases = results["rows"], results["phases"]
    figure, ((sizes, peers), (valences, split)) = plt.subplots(2, 2, figsize=(13, 10))

    for k, (workload, step, response, label) in enumerate(BY_SIZE):
        found = series(rows, "box tree", workload, step, response)
        if found:
            x = [r["triangles"] for r in found]
            sizes.loglog(x, [r["median_ns"] / 1e3 for r in found], "o-", color=f"C{k}", label=label)
            sizes.loglog(x, [r["p999_ns"] / 1e3 for r in found], ":", color=f"C{k}")
    sizes.set(xlabel="triangles", ylabel="µs a drag", title="whole drags: median; dotted: 99.9 %")
    sizes.legend(fontsize=8)

    for k, structure in enumerate(["box tree", "Boost rtree", "six lists", "brute force"]):
        for workload, style in (("new vertex", "o-"), ("in a drag", "s--")):
            found = series(rows, structure, workload, 0.1, "stop")
            if found:
                peers.loglog([r["triangles"] for r in found], [r["median_ns"] / 1e3 for r in found], style, color=f"C{k}",
                             label=f"{structure}, {workload}")
    for k, structure in enumerate(["AABB_tree, stale", "AABB_tree, rebuilt", "does_self_intersect, whole"]):
        found = sorted((r for r in rows if r["structure"] == structure and r["step_edges"] == 0.1), key=lambda r: r["triangles"])
        if found:
            peers.loglog([r["triangles"] for r in found], [r["median_ns"] / 1e3 for r in found], "^:", color=f"C{k + 4}", label=structure)
    peers.set(xlabel="triangles", ylabel="µs, median", title="beside others (triangles: end of the motion only)")
    peers.legend(fontsize=7)

    fits = results.get("valence_fits", [])
    for k, mesh in enumerate(("fan", "fan in a crowd")):
        for workload, style in (("valence: first drag", "o-"), ("valence: push through, stopped", "s--")):
            found = sorted((r for r in rows if r["workload"] == workload and r["mesh"] == mesh), key=lambda r: r["valence"])
            if not found:
                continue
            exponent = next((f["exponent"] for f in fits if f["mesh"] == mesh and f["workload"] == workload), float("nan"))
            valences.loglog([r["valence"] for r in found], [r["median_ns"] / 1e3 for r in found], style, color=f"C{k}",
                            label=f"{mesh}, {workload[9:]}: exponent {exponent:.2f}")
    low, high = valences.get_ylim()
    claim = [(v, low * 2 ** (v - 3)) for v in range(3, 40) if low * 2 ** (v - 3) < high]
    valences.loglog([v for v, _ in claim], [t for _, t in claim], "k:", label="“exponential” (paper), 2^v")
    valences.set(xlabel="valence", ylabel="µs a drag, median", title="valence")
    valences.legend(fontsize=8)

    largest = max((p["triangles"] for p in phases), default=0)
    chosen = [p for p in phases if math.isclose(p["triangles"], min(largest, 1e6), rel_tol=0.05)]
    base = [0.0] * len(chosen)
    for key, label in PHASES:
        heights = [p["per_drag"].get(key, 0) / 1e3 for p in chosen]
        split.barh(range(len(chosen)), heights, left=base, label=label)
        base = [b + h for b, h in zip(base, heights)]
    split.set_yticks(range(len(chosen)), [p["workload"] for p in chosen], fontsize=8)
    split.set(xlabel="µs, mean without the slowest 1 %", title="where the time goes, 10^6 triangles")
    split.legend(fontsize=8)

    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
