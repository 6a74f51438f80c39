#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what response_quality --json wrote: plot_response_quality.py IN.json OUT.png"""
import json
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

if len(sys.argv) != 3:
    sys.exit(__doc__)
report = json.load(open(sys.argv[1]))
rows = report["chart"]
scenes = list(dict.fromkeys(r["scene"] for r in rows))
responses = list(dict.fromkeys(r["response"] for r in rows))
colours = dict(zip(responses, ("tab:blue", "tab:red", "tab:orange")))

figure, panels = plt.subplots(1, 3, sharey=True, figsize=(13, 0.8 + 0.24 * len(scenes)))
for axes, (key, scale, label) in zip(panels, (
        ("mean_distance_left", 1, "distance left to the target, half extents of the scene"),
        ("share_at_minimum", 100, "drags that end at a local minimum, %"),
        ("mean_ns", 1e-3, "mean time of a drag, µs"))):
    for i, response in enumerate(responses):
        values = {r["scene"]: r[key] * scale for r in rows if r["response"] == response}
        axes.barh([k + (i - 1) * 0.27 for k in range(len(scenes))], [values[s] for s in scenes], height=0.25,
                  color=colours[response], label=response)
    axes.set_xlabel(label, fontsize=9)
    axes.grid(axis="x", alpha=0.3)
panels[2].set_xscale("log")
panels[0].set_yticks(range(len(scenes)), scenes, fontsize=8)
panels[0].invert_yaxis()
panels[0].legend(fontsize=9)
figure.suptitle(f"Responses to a blocked drag; {report['drags_per_scene']} drags a scene, seed {report['seed']}", fontsize=11)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=90)
