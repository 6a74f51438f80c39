#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots what device_speed_error --json wrote: plot_device_speed_error.py RESULTS.json PICTURE.png"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

rows = [r for r in json.load(open(sys.argv[1]))["rows"] if r["population"] == "path" and r["error_over_condition"]["median"]]
figure, axes = plt.subplots(figsize=(6.4, 4.2))
for what in sorted({(r["form"], r["what"]) for r in rows}):
    chosen = [r for r in rows if (r["form"], r["what"]) == what]
    axes.loglog([r["ns"] for r in chosen], [r["error_over_condition"]["median"] for r in chosen], "o-", label=f"{what[0]}: {what[1]}")
axes.set_xlabel("ns per call")
axes.set_ylabel("median error / condition")
axes.legend(fontsize=7)
axes.grid(True, which="major", alpha=0.3)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=80)
