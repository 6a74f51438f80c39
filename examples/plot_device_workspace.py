#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what device_workspace wrote: plot_device_workspace.py SAMPLES.txt PICTURE.png

Exit: 0 drawn, 2 a file without such samples, or a picture that cannot be written or is that file.
"""
import warnings

import draw_file

plt = draw_file.pyplot()
import numpy as np

COLUMNS = 8


def samples_of(path):
    """(all, whether each is in a slab about the plane y = 0). \\throw ValueError, OSError"""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that there is none is said below
        data = np.loadtxt(path, ndmin=2)
    if data.shape[1] < COLUMNS:
        raise ValueError(f"there are no samples of {COLUMNS} numbers a line")
    near = np.abs(data[:, 1]) < 0.006
    if not near.any():
        raise ValueError("there is no sample near the plane y = 0, which is drawn")
    return data, near


def draw(samples):
    data, near = samples
    x, z = 1e3 * data[:, 0], 1e3 * data[:, 2]
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.4), dpi=70, sharey=True)
    panels = (("condition", data[:, 3]), ("isotropic force, N", data[:, 4]),
              ("apparent mass, largest axis, g", 1e3 * data[:, 7]))
    for panel, (title, values) in zip(axes, panels):
        drawn = panel.scatter(x[near], z[near], c=values[near], s=6, vmax=np.percentile(values[near], 95))
        panel.set_title(title, fontsize=9)
        panel.set_xlabel("x, mm")
        panel.set_aspect("equal")
        figure.colorbar(drawn, ax=panel, shrink=0.8)
    axes[0].set_ylabel("z, mm")
    figure.tight_layout()
    return figure


if __name__ == "__main__":
    draw_file.draw_file(__doc__, "device_workspace", samples_of, draw)
