#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what device_workspace wrote: plot_device_workspace.py SAMPLES.txt PICTURE.png"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

data = np.loadtxt(sys.argv[1])
x, z = 1e3 * data[:, 0], 1e3 * data[:, 2]
near = np.abs(data[:, 1]) < 0.006  # a slab about the plane y = 0
figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.4), sharey=True)
panels = (("condition", data[:, 3]), ("isotropic force, N", data[:, 4]), ("apparent mass, largest axis, g", 1e3 * data[:, 7]))
for panel, (title, values) in zip(axes, panels):
    drawn = panel.scatter(x[near], z[near], c=values[near], s=6, vmax=np.percentile(values[near], 95))
    panel.set_title(title, fontsize=9)
    panel.set_xlabel("x, mm")
    panel.set_aspect("equal")
    figure.colorbar(drawn, ax=panel, shrink=0.8)
axes[0].set_ylabel("z, mm")
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=70)
