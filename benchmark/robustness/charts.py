# SPDX-License-Identifier: GPL-3.0-or-later
"""What the page says of robustness: how often each promise was looked at, and how often it broke."""
from figures import Finding, Table, bars, seconds_text


def is_kept(p):
    return p["broken"] <= p["may"] * p["asked"]


def of_promises(step, report, sentence, number, of, tables):
    rows = [p for p in report["promises"] if p["asked"] > 0]
    figure = bars([(p["promise"], p["asked"], f"{p['broken']:,} of {p['asked']:,} broken" + (f", {100 * p['may']:g} % may" if p["may"] else ""), is_kept(p))
                   for p in rows], "times looked at")
    behind = Table("Promises", ["promise", "looked at", "broken", "may be", "exit code"],
                   [[p["promise"], f"{p['asked']:,}", f"{p['broken']:,}", f"{100 * p['may']:g} %", p["exit"]] for p in report["promises"]])
    return Finding(step, sentence, number, of, figure, "How often each promise was looked at, and broken", [behind, *tables])


def drags_and_edits(report):
    broken = [p for p in report["promises"] if not is_kept(p)]
    drags, edits = report["total"]["drags"], report["total_of_edits"]["edits"]
    meshes = len({r["mesh"] for r in report["meshes"]})
    rows = [[r["mesh"], r.get("clearance", "default"), f"{r['faces']:,}", f"{r.get('drags', 0):,}", f"{r.get('blocked', 0):,}", f"{r.get('mixed_edits', {}).get('edits', 0):,}",
             r.get("invalid", 0) + r.get("mixed_edits", {}).get("invalid", 0), f"{r.get('largest_stop_error_in_clearances', 0):.3g}",
             *(seconds_text(r[key] * 1e-9) if r.get(key) else "" for key in ("mean_ns", "longest_ns"))] for r in report["meshes"]]
    tables = [Table("Meshes", ["mesh", "clearance", "faces", "drags", "blocked", "mixed edits", "not valid after", "largest stop error, clearances", "mean drag", "longest"], rows)]
    if report["refused"]:
        tables.append(Table("Meshes refused", ["file", "had to be", "repaired", "reason"], [[r["file"], *("yes" if r[key] else "no" for key in ("has_to_be", "repaired")), r["reason"]] for r in report["refused"]]))
    how = " by strokes of a hand" if report["motion"] == "hand" else ""
    how += "" if report["response"] == "slide" else f", response {report['response']},"
    phases = report.get("broad_phases", "box_tree").count(",") + 1
    how += "" if phases == 1 else f" with {phases} broad phases"
    how += "" if report.get("clearances", "default") == "default" else f" and clearances of {report['clearances'].replace(' of the extent', '')} of the extent"
    said = "no promise broke" if not broken else "broken: " + "; ".join(p["promise"] for p in broken)
    name = "broad_phases" if phases > 1 else "drags" + ("_of_a_hand" if report["motion"] == "hand" else "") + ("" if report["response"] == "slide" else f"_{report['response']}")
    return [of_promises(name, report, f"In {drags:,} drags and {edits:,} mixed edits of {meshes} hard meshes{how} {said}.", str(len(broken)),
                        f"broken promises of {sum(p['asked'] > 0 for p in report['promises'])}", tables)]


def ends(report):
    total = sum(t["drags"] for t in report["total"])
    missed = sum(t["missed"] + t["gave_up"] for t in report["total"])
    rows = [[f["family"], f["drags"], f["not_reached"], f["certified"], f["missed"], f["gave_up"], f"{100 * f['largest_gain_missed']:.2g} %"] for f in report["families"]]
    return [of_promises("ends", report, f"Of {total:,} drags of machine parts and near-degenerate solids {missed:,} end where a free way leads nearer.", f"{missed:,}",
                        f"ends too early, of {total:,}", [Table("Families", ["family", "drags", "not reached", "certified", "missed", "gave up", "largest gain missed"], rows)])]


def asked_twice(name, sentence, caption, held="all agree", broken="some differ"):
    """The chart of a step of one promise. `sentence` has {n}, how many were asked, and {how}, how it went."""
    def chart(report):
        promise = report["promises"][0]
        asked = f"{promise['asked']:,}"
        how = broken if promise["broken"] else held
        return [of_promises(name, report, sentence.format(n=asked, how=how), asked, caption, [])]
    return chart


CHARTS = {"drags_and_edits": drags_and_edits, "broad_phases": drags_and_edits, "drags_with_stop": drags_and_edits, "drags_with_paper": drags_and_edits, "drags_of_a_hand": drags_and_edits, "drags_of_a_hand_with_stop": drags_and_edits,
          "ends": ends,
          "sweeps_by_oracle": asked_twice("sweeps_by_oracle", "{n} sweeps were asked of a second, exact implementation; {how}.",
                                          "sweeps asked twice"),
          "sweeps_by_cgal": asked_twice("sweeps_by_cgal", "{n} sweeps were asked of CGAL's predicates; {how}.",
                                        "sweeps asked twice"),
          "drags_by_oracle": asked_twice("drags_by_oracle",
                                         "{n} drags were decided once more, in integers over all pairs of faces; {how}.",
                                         "drags decided twice"),
          "axis_moves_by_oracle": asked_twice("axis_moves_by_oracle",
                                              "Of {n} axis moves the free ones were looked at on the way, exactly; {how}.",
                                              "axis moves tried", "all are embedded", "some are not")}
