#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what haptic_passivity --parts rate --chart --json wrote: plot_haptic_passivity.py IN.json OUT.png"""
from plot_report import plot_report, pyplot


def draw_stiffness(axes, rows, x, colour, label):
    rows = sorted(rows, key=x)
    axes.plot(
        [x(r) for r in rows],
        [r["passive_formula"] if r["passive_formula"] > 0 else None for r in rows],
        "-",
        color=colour,
        label=label,
    )
    active = [r for r in rows if "active_from" in r]
    axes.plot(
        [x(r) for r in active], [r["active_from"] for r in active], "o", color=colour, markersize=7, fillstyle="none"
    )
    axes.plot([x(r) for r in rows], [r["stable_to"] for r in rows], "^", color=colour, markersize=5)


def draw(report):
    chart = report["chart"]
    friction = chart["friction_Ns_m"]
    figure, (by_damping, by_tick, by_rate) = pyplot().subplots(1, 3, figsize=(15, 4.6), dpi=80)
    for delay, colour in zip((0.0, 0.5, 1.0), ("tab:blue", "tab:orange", "tab:green")):
        draw_stiffness(
            by_damping,
            [r for r in chart["rows"] if r["tick_s"] == 0.001 and r["delay"] == delay],
            lambda r: r["damping"] / friction,
            colour,
            f"d = {delay:g} ticks",
        )
    by_damping.set_xlabel("b / b_phys")
    by_damping.set_title("T = 1 ms")
    for share, colour in zip((0.0, 0.5, 0.95), ("tab:blue", "tab:red", "tab:purple")):
        draw_stiffness(
            by_tick,
            [r for r in chart["rows"] if r["delay"] == 0 and abs(r["damping"] - share * friction) < 1e-9],
            lambda r: 1 / r["tick_s"],
            colour,
            f"b = {share:g} b_phys",
        )
    by_tick.set_xscale("log")
    by_tick.set_yscale("log")
    by_tick.set_xlabel("rate, Hz")
    by_tick.set_title("d = 0")
    for axes in (by_damping, by_tick):
        axes.set_ylabel("k, N/m")
        axes.legend(fontsize=8, title="lines: k_p;\ncircles: activity from,\ntriangles: calm to", title_fontsize=8)
    for delay, colour in zip((0.0, 0.5, 1.0), ("tab:blue", "tab:orange", "tab:green")):
        rows = [r for r in report["rate"] if r["delay"] == delay]
        exact = [r for r in rows if r["encoder_step"] == 0]
        steps = [r for r in rows if r["encoder_step"] > 0]
        by_rate.plot(
            [r["rate_Hz"] for r in exact],
            [1e3 * r["mean_N"] for r in exact],
            "o-",
            color=colour,
            markersize=4,
            label=f"d = {delay:g}: mean",
        )
        by_rate.plot([r["rate_Hz"] for r in exact], [1e3 * r["largest_N"] for r in exact], "--", color=colour)
        by_rate.plot([r["rate_Hz"] for r in steps], [1e3 * r["mean_N"] for r in steps], "x:", color=colour)
    by_rate.set_xscale("log")
    by_rate.set_yscale("log")
    by_rate.set_xlabel("rate, Hz")
    by_rate.set_ylabel("error of the force, mN")
    by_rate.set_title("60 mm/s into 500 N/m")
    by_rate.legend(fontsize=8, title="dashed: largest; dotted: with encoders", title_fontsize=8)
    for axes in (by_damping, by_tick, by_rate):
        axes.grid(alpha=0.3, which="both")
    figure.tight_layout()
    return figure


plot_report(__doc__, "chart", draw)
