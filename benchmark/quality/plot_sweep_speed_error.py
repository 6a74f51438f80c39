#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws time against error from the JSON of sweep_speed_error: plot_sweep_speed_error.py IN.json OUT.png"""
import json
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

if len(sys.argv) != 3:
    sys.exit(__doc__)
report = json.load(open(sys.argv[1]))
queries = report["queries_per_population"]
names = [a["name"] for a in report["populations"][0]["arithmetics"]]
others = [n for n in names if not n.startswith("haptic_sculpt")]
colours = {n: plt.get_cmap("tab20")(i % 20) for i, n in enumerate(others)}
colours.update(zip((n for n in names if n not in others), ("black", "dimgrey", "darkgrey")))
NO_VERDICT_FLOOR, NO_ERROR_FLOOR = 3e-6, 1e-18  # where zero is drawn on a logarithmic axis

figure, (verdicts, times) = plt.subplots(2, 1, sharex=True, figsize=(12.5, 9))
for name in names:
    for degenerate, marker in ((False, "o"), (True, "s")):
        rows = [a for p in report["populations"] if p["degenerate"] == degenerate
                for a in p["arithmetics"] if a["name"] == name]
        if not rows:
            continue
        style = {"color": colours[name], "marker": marker, "linestyle": "none"}
        face = {} if not degenerate else {"markerfacecolor": "none", "markeredgewidth": 2}
        mean = sum(r["mean_ns"] for r in rows) / len(rows)
        share = sum(r["false_positives"] + r["false_negatives"] for r in rows) / len(rows) / queries
        # each population faintly, all of them together in full
        verdicts.plot([r["mean_ns"] for r in rows],
                      [max((r["false_positives"] + r["false_negatives"]) / queries, NO_VERDICT_FLOOR) for r in rows],
                      **style, markersize=3, alpha=0.35)
        verdicts.plot(mean, max(share, NO_VERDICT_FLOOR), **style, **face, markersize=9,
                      label=name if not degenerate else None)
        rows = [r for r in rows if r["largest_error_in_u"] is not None]
        if rows:
            times.plot([r["mean_ns"] for r in rows], [max(r["largest_error_in_u"], NO_ERROR_FLOOR) for r in rows],
                       **style, markersize=3, alpha=0.35)
            times.plot(mean, max(NO_ERROR_FLOOR, max(r["largest_error_in_u"] for r in rows)), **style, **face, markersize=9)

for axes in (verdicts, times):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(alpha=0.3)
verdicts.axhline(NO_VERDICT_FLOOR, color="grey", linewidth=0.8)
verdicts.text(1, NO_VERDICT_FLOOR * 1.15, "none wrong", color="grey", transform=verdicts.get_yaxis_transform(),
              horizontalalignment="right")
times.axhline(2**-53, color="grey", linewidth=0.8)
times.text(1, 2**-53 * 1.4, "half an ulp of 1", color="grey", transform=times.get_yaxis_transform(),
           horizontalalignment="right")
verdicts.set_ylabel("share of wrong verdicts")
times.set_ylabel("largest error in u, where both see a hit")
times.set_xlabel("mean time of a query, ns")
verdicts.set_title(f"Sweeps: time against error; {queries} queries a population, seed {report['seed']}\n"
                   "discs: ordinary populations, squares: degenerate ones; small: each population alone", fontsize=10)
figure.legend(*verdicts.get_legend_handles_labels(), loc="center left", bbox_to_anchor=(0.765, 0.5), fontsize=8)
figure.subplots_adjust(left=0.09, right=0.755, top=0.93, bottom=0.07, hspace=0.05)
figure.savefig(sys.argv[2], dpi=110)
