#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what haptic_passivity --parts effects --json wrote, what each part of the chain of forces adds to the energy
and to the force: plot_haptic_chain.py IN.json OUT.png"""
from plot_report import plot_report, pyplot

LEAST_FORCE = 1e-3  # N: what is less stands at the left edge
BLUE, ORANGE = "#0072B2", "#D55E00"  # told apart by all eyes, and by their signs


def draw(report):
    rows = report["effects"][::-1]
    places = range(len(rows))
    figure, (energy, force) = pyplot().subplots(
        1, 2, sharey=True, figsize=(11, 0.34 * len(rows) + 1.3), dpi=100, gridspec_kw={"width_ratios": [1, 1.5]}
    )
    least = [1e3 * row["least_energy_J"] for row in rows]
    energy.barh(places, least, color=BLUE, height=0.6)
    farthest = min(min(least), -1)
    for place, value in zip(places, least):
        text = "0" if value > -5e-4 else f"{value:.2g}"
        energy.annotate(
            text,
            (value, place),
            xytext=(-3, 0),
            textcoords="offset points",
            ha="right",
            va="center",
            fontsize=8,
            color=BLUE,
        )
    energy.set_xlim(1.25 * farthest, -0.02 * farthest)
    energy.set_yticks(list(places))
    energy.set_yticklabels([row["effect"] for row in rows], fontsize=8)
    energy.set_xlabel("least port + friction of all runs, mJ")
    # Where the two are farthest apart, so that the words are.
    labelled = max(places, key=lambda k: rows[k]["force_off_largest_N"] / max(LEAST_FORCE, rows[k]["force_off_mean_N"]))
    for key, colour, marker, label in (
        ("force_off_mean_N", BLUE, "o", "mean"),
        ("force_off_largest_N", ORANGE, "D", "largest"),
    ):
        values = [max(LEAST_FORCE, row[key]) for row in rows]
        force.plot(values, places, marker, color=colour, markersize=6)
        force.annotate(
            label,
            (values[labelled], places[labelled]),
            xytext=(0, 8),
            textcoords="offset points",
            ha="center",
            fontsize=9,
            color=colour,
        )
    for place, row in zip(places, rows):
        force.plot(
            [max(LEAST_FORCE, row["force_off_mean_N"]), max(LEAST_FORCE, row["force_off_largest_N"])],
            [place, place],
            "-",
            color="0.75",
            zorder=0,
        )
    force.set_xscale("log")
    force.set_xlim(left=LEAST_FORCE * 0.7)
    force.set_ylim(-0.7, len(rows) + 0.1)
    force.set_xlabel("force against spring and damper of the true place, N")
    for axes in (energy, force):
        axes.grid(axis="x", alpha=0.3)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    figure.tight_layout()
    return figure


plot_report(__doc__, "effects", draw)
