#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws time against mesh size and valence from the JSON of edit_performance: plot_edit_performance.py IN.json OUT.png"""
import json
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

if len(sys.argv) != 3:
    sys.exit(__doc__)
report = json.load(open(sys.argv[1]))
figure, panels = plt.subplots(1, 2, figsize=(12, 5), sharey=True)
for axes, key, what, title in ((panels[0], "sizes", "triangles", "random places of a bumpy sphere"),
                               (panels[1], "valences", "valence", "apex of a bipyramid")):
    rows = report[key]
    x = [row[what] for row in rows]
    for k, edit in enumerate(row["edit"] for row in rows[0]["edits"]):
        colour = f"C{k}"
        for field, style in (("ns", "-o"), ("undo_ns", "--s"), ("redo_ns", ":^")):
            label = edit + {"ns": "", "undo_ns": ", undo", "redo_ns": ", redo"}[field]
            axes.plot(x, [row["edits"][k][field]["p50"] / 1000 for row in rows], style, color=colour, markersize=4, label=label)
        if key == "sizes":
            axes.fill_between(x, [row["edits"][k]["ns"]["p50"] / 1000 for row in rows],
                              [row["edits"][k]["ns"]["p99"] / 1000 for row in rows], color=colour, alpha=0.1)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(what)
    axes.set_title(title, fontsize=10)
    axes.grid(alpha=0.3, which="both")
valences = [row["valence"] for row in report["valences"]]
panels[1].plot(valences, [0.02 * v for v in valences], color="grey", linewidth=0.8)
panels[1].text(valences[-1], 0.02 * valences[-1], "valence", color="grey", ha="right", va="top", fontsize=8)
panels[0].set_ylabel("median time, µs (bands: up to the 99th percentile)")
panels[0].legend(fontsize=7, ncol=2)
figure.suptitle(f"Edits, undo and redo; {report['samples']} of each kind, seed {report['seed']}", fontsize=10)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
