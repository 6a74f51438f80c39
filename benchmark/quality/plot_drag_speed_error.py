#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws time against error of whole drags from the JSON of drag_speed_error: plot_drag_speed_error.py IN.json OUT.png"""
import json
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

if len(sys.argv) != 3:
    sys.exit(__doc__)
report = json.load(open(sys.argv[1]))
drags = report["drags_per_script"]
names = [a["name"] for a in report["scripts"][0]["arithmetics"]]
colours = dict(zip(names, ("tab:red", "tab:orange", "tab:blue", "black")))
markers = dict(zip((s["name"] for s in report["scripts"]), "osDv^P*X"))
FLOOR = 0.3 / drags  # where zero is drawn on a logarithmic axis

figure, panels = plt.subplots(1, 2, sharex=True, sharey=True, figsize=(12, 5.2))
for axes, field, title in ((panels[0], "crossed", "touched or crossed something on the way"),
                           (panels[1], "wrongly_blocked", "stopped although the way was free")):
    for script in report["scripts"]:
        for a in script["arithmetics"]:
            axes.plot(a["median_us"], max(a[field] / a["drags"], FLOOR), color=colours[a["name"]], marker=markers[script["name"]],
                      linestyle="none", markersize=8, alpha=0.8)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.axhline(FLOOR, color="grey", linewidth=0.8)
    axes.text(1, FLOOR * 1.1, "none", color="grey", transform=axes.get_yaxis_transform(), horizontalalignment="right")
    axes.set_title(title, fontsize=10)
    axes.set_xlabel("median time of a drag, µs")
    axes.grid(alpha=0.3)
panels[0].set_ylabel("share of drags")
handles = [plt.Line2D([], [], color=colours[n], marker="o", linestyle="none", label=n) for n in names]
handles += [plt.Line2D([], [], color="grey", marker=m, linestyle="none", label=n) for n, m in markers.items()]
figure.legend(handles=handles, loc="center left", bbox_to_anchor=(0.78, 0.5), fontsize=8)
figure.suptitle(f"Whole drags: time against error; {drags} drags a script, seed {report['seed']}, response {report['response']}",
                fontsize=10)
figure.subplots_adjust(left=0.07, right=0.77, top=0.88, bottom=0.11, wspace=0.05)
figure.savefig(sys.argv[2], dpi=110)
