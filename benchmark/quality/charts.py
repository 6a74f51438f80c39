# SPDX-License-Identifier: GPL-3.0-or-later
"""What the page says of quality: speed against error of each stage, on one pair of axes each."""
from figures import Finding, Table, lines, power_text, seconds_text, speed_error


def of_arithmetics(populations, names, queries, error):
    """[(short name, mean of the medians in seconds, error)] over populations; \\param names {in the report: in the figure}

    Medians, because a busy machine adds to a mean what has nothing to do with the arithmetic."""
    points = []
    for name, short in names.items():
        rows = [a for p in populations for a in p["arithmetics"] if a["name"] == name]
        if rows:
            points.append((short, sum(r.get("median_ns", r["mean_ns"]) for r in rows) / len(rows) * 1e-9, error(rows, queries)))
    return points


def share_of_wrong(rows, queries):
    return sum(r["false_positives"] + r["false_negatives"] for r in rows) / len(rows) / queries


def largest_error(rows, _):
    return max(r["largest_error_in_u"] or 0 for r in rows)


def percent(share):
    return f"{100 * share:.3g} %"


def table_of_arithmetics(report):
    rows = []
    for p in report["populations"]:
        for a in p["arithmetics"]:
            error = a.get("largest_error_in_u")
            rows.append([p["name"], a["name"], seconds_text(a["mean_ns"] * 1e-9), seconds_text(a["p99_ns"] * 1e-9) if "p99_ns" in a else "",
                         a["false_positives"], a["false_negatives"], "" if error is None else f"{error:.2g}"])
    return Table("Each population and arithmetic", ["population", "arithmetic", "mean", "p99", "false alarms", "missed", "largest error in u"], rows)


def sweeps(report):
    degenerate = [p for p in report["populations"] if p["degenerate"]]
    queries = report["queries_per_population"]
    verdicts = of_arithmetics(degenerate, {
        "haptic_sculpt, verdict": "haptic_sculpt", "double": "doubles", "paper, epsilon 1e-9": "the paper's epsilon", "MPFR 256 bits": "MPFR, 256 bits",
        "GMP rationals": "GMP rationals", "EPICK composition, verdict": "CGAL's predicates"}, queries, share_of_wrong)
    times = of_arithmetics(degenerate, {
        "haptic_sculpt, verdict and enclosed time": "haptic_sculpt, enclosed", "double": "doubles", "long double": "long doubles",
        "MPFR 256 bits": "MPFR, 256 bits", "GMP rationals": "GMP rationals", "EPICK composition, rational time": "CGAL's predicates, rational"},
        queries, largest_error)
    ours, doubles = verdicts[0], next(p for p in verdicts if p[0] == "doubles")
    time = times[0]
    total = queries * len(degenerate)
    return [Finding("sweeps", f"On degenerate queries haptic_sculpt gives {'no wrong verdict' if ours[2] == 0 else percent(ours[2]) + ' wrong verdicts'} of {total:,} in "
                    f"{seconds_text(ours[1])} each; doubles give {percent(doubles[2])} wrong ones.", seconds_text(ours[1]), f"a verdict, of {total:,} degenerate sweeps",
                    speed_error(verdicts, "share of wrong verdicts", "median time of a sweep"), "Time of a sweep against its wrong verdicts, by arithmetic",
                    [table_of_arithmetics(report)], picture="sweep_speed_error"),
            Finding("sweeps", f"The time of impact is enclosed to {power_text(time[2])} of the way in {seconds_text(time[1])}; doubles are off by up to {power_text(times[1][2])}.",
                    power_text(time[2]), "largest error of a time of impact, of the way", speed_error(times, "largest error of the time of impact", "median time of a sweep"),
                    "Time of a sweep against the error of the time of impact, by arithmetic")]


def axis(report):
    queries = report["queries_per_population"]
    degenerate = [p for p in report["populations"] if p["degenerate"]]
    points = of_arithmetics(degenerate, {"haptic_sculpt": "haptic_sculpt", "double": "doubles", "long double": "long doubles",
                                         "MPFR 113 bits": "MPFR, 113 bits", "GMP rationals": "GMP rationals"}, queries, share_of_wrong)
    return [Finding("axis", f"When all vertices move along one axis at once, a pair is decided in {seconds_text(points[0][1])}, "
                    f"{'none' if points[0][2] == 0 else percent(points[0][2])} wrongly; by doubles {percent(points[1][2])} wrongly.",
                    seconds_text(points[0][1]), "a pair in or near contact", speed_error(points, "share of wrong verdicts", "mean time of a pair"),
                    "Time of an axis sweep against its wrong verdicts, by arithmetic", [table_of_arithmetics(report)])]


def whole_drags(report):
    points, rows = [], []
    names = {"haptic_sculpt, exact": "haptic_sculpt", "double": "doubles", "paper, epsilon 1e-9": "the paper's epsilon", "long double": "long doubles"}
    for name, short in names.items():
        of = [a for s in report["scripts"] for a in s["arithmetics"] if a["name"] == name]
        drags = sum(a["drags"] for a in of)
        points.append((short, sum(a["median_us"] * a["drags"] for a in of) / drags * 1e-6, sum(a["crossed"] + a["wrongly_blocked"] for a in of) / drags))
    for s in report["scripts"]:
        rows += [[s["name"], a["name"], a["drags"], seconds_text(a["median_us"] * 1e-6), a["crossed"], a["wrongly_blocked"]] for a in s["arithmetics"]]
    drags = sum(a["drags"] for s in report["scripts"] for a in s["arithmetics"] if a["name"] == "haptic_sculpt, exact")
    return [Finding("whole_drags", f"Of {drags:,} whole drags in hard places {'none' if points[0][2] == 0 else percent(points[0][2])} of ours crossed anything or was stopped wrongly, "
                    f"{percent(points[1][2])} by doubles; a drag takes {points[0][1] / points[1][1]:.2g} times as long.",
                    f"{points[0][1] / points[1][1]:.2g}×", "the time of doubles, for the whole drag",
                    speed_error(points, "share of drags gone wrong", "median time of a drag"), "Time of whole drags against those gone wrong, by arithmetic",
                    [Table("Each script", ["script", "arithmetic", "drags", "median", "crossed", "wrongly stopped"], rows)], picture="drag_speed_error")]


def responses(report):
    of = {r: [row for row in report["chart"] if row["response"] == r] for r in ("slide", "stop", "paper")}
    mean = {r: (sum(x["median_ns"] for x in rows) / len(rows) * 1e-9, 1 - sum(x["at_minimum"] for x in rows) / sum(x["judged"] for x in rows),
                sum(x["mean_distance_left"] for x in rows) / len(rows)) for r, rows in of.items() if any(x["judged"] for x in rows)}
    if len(mean) < 3:  # every drag arrives, or no response was asked for
        return []
    names = {"slide": "slide", "stop": "stop", "paper": "the paper's walk"}
    rows = [[x["scene"], x["response"], x["drags"], f"{x['mean_distance_left']:.3g}", f"{x['at_minimum']} of {x['judged']}", f"{x['mean_legs']:.2g}",
             seconds_text(x["mean_ns"] * 1e-9)] for x in report["chart"]]
    refused = [Table("Meshes refused", ["file", "reason"], [[r["file"], r["reason"]] for r in report["refused"]])] if report.get("refused") else []
    return [Finding("responses", f"A slide that does not arrive ends at a nearest point in {percent(1 - mean['slide'][1])} of the drags, in {seconds_text(mean['slide'][0])}; "
                    f"the paper's walk in {percent(1 - mean['paper'][1])}.", percent(1 - mean["slide"][1]), "of the slides that do not arrive end at a local minimum",
                    speed_error([(names[r], m[0], m[1]) for r, m in mean.items()], "share of these not at a minimum", "median time of a drag"),
                    "Time of a drag against the share of those that end neither at the target nor at a minimum, by response",
                    [Table("Each scene", ["scene", "response", "drags", "distance left, half extents", "at a minimum", "legs", "mean"], rows), *refused],
                    picture="response_quality"),
            Finding("responses", f"What is left to the target is {mean['slide'][2]:.3g} half extents with a slide, {mean['stop'][2]:.3g} with a stop.",
                    f"{mean['slide'][2]:.3g}", "half extents left to the target, slide",
                    speed_error([(names[r], m[0], m[2]) for r, m in mean.items()], "distance left, half extents", "median time of a drag"),
                    "Time of a drag against the distance left, by response")]


def stops(report):
    """Of the step that meets: how far from the contact it ends, beside the clearance that was asked for."""
    rows = [r for r in report["rows"] if "stop_error_max_clearances" in r and r.get("response") == "stop" and "valence" not in r]
    if not rows:
        return []
    by = {}
    for r in rows:
        if r["structure"] == "box tree":
            by.setdefault(r["workload"], []).append(r)
    names = {"push until contact: the step that meets": "the step that meets", "pressed in contact": "pressed on", "push": "long pushes"}
    points = [(names[w], sum(r["median_ns"] for r in of) / len(of) * 1e-9, max(r["stop_error_max_clearances"] for r in of)) for w, of in by.items() if w in names]
    if not points:
        return []
    measured = sum(r["stops_measured"] for of in by.values() for r in of)
    worst = max(r["stop_error_max_clearances"] for of in by.values() for r in of)
    beyond = sum(r["stops_beyond_two_clearances"] for of in by.values() for r in of)
    return [Finding("drags", f"A stopped vertex ends at most {worst:.3g} clearances from what stops it, of {measured:,} stops; {beyond:,} beyond two.",
                    f"{worst:.3g} c", "largest distance of a stop, in clearances", speed_error(points, "largest distance, clearances", "median time"),
                    "Time of a stop against its distance from the contact",
                    [Table("Stops", ["mesh", "triangles", "what", "stops", "median distance", "largest", "beyond 2"],
                           [[r["mesh"], f"{r['triangles']:,}", r["workload"], r["stops_measured"], f"{r['stop_error_median_clearances']:.3g}",
                             f"{r['stop_error_max_clearances']:.3g}", r["stops_beyond_two_clearances"]] for r in rows])])]


def many_vertices(report):
    methods = {"move_vertices": "move_vertices", "one after the other": "one after the other", "halving on does_self_intersect": "halving on does_self_intersect"}
    points = []
    for method, name in methods.items():
        rows = [r for r in report["rows"] if r["method"] == method]
        points.append((name, sum(r["seconds"] for r in rows) / len(rows), 1 - sum(r["share"] for r in rows) / len(rows)))
    through = sum(r["passed_through"] for r in report["rows"])
    motions = len(report["rows"]) // 3
    rows = [[r["motion"], r["method"], f"{r['vertices']:,}", seconds_text(r["seconds"]), percent(r["share"]), "yes" if r["passed_through"] else "", "yes" if r["valid"] else "no"]
            for r in report["rows"]]
    return [Finding("many_vertices", f"move_vertices goes {percent(1 - points[0][2])} of the way; a halved step goes {percent(1 - points[2][2])}, and through the surface in "
                    f"{through} of {motions} motions.", percent(1 - points[0][2]), "of the way of all vertices, mean of the motions",
                    speed_error(points, "share of the way not gone", "mean processor time of a motion"), "Time of moves of many vertices against the way not gone, by method",
                    [Table("Each motion", ["motion", "method", "vertices", "time", "of the way", "passed through itself", "valid"], rows)])]


def functions(report):
    rows, pairs, ours, ratios = [], 0, 0, []
    for c in report["comparisons"]:
        pairs += c["plain"]["pairs"]
        ours += c["guarded"]["pairs"]
        if c["plain"]["seconds"] > 0:
            ratios.append(c["guarded"]["seconds"] / c["plain"]["seconds"])
        rows.append([c["mesh"], c["function"], c["way"], c["plain"]["pairs"], c["guarded"]["pairs"],
                     "" if c["share"] is None else percent(c["share"]), seconds_text(c["plain"]["seconds"] or 1e-9),
                     seconds_text(c["guarded"]["seconds"] or 1e-9)])
    alone = [c["plain"]["seconds"] for c in report["comparisons"]]
    guarded = [c["guarded"]["seconds"] for c in report["comparisons"]]
    count = len(report["comparisons"])
    points = [("under the guard", sum(guarded) / count, ours / count), ("CGAL alone", sum(alone) / count, pairs / count)]
    return [Finding("functions", f"CGAL's smoothing, deformation and remeshing leave {pairs:,} pairs of intersecting faces in {count} runs alone, {ours} under the guard.",
                    f"{ours}", f"pairs under the guard, {pairs:,} without", speed_error(points, "pairs of intersecting faces, mean", "mean processor time of a run"),
                    "Time of CGAL's functions against intersecting faces, alone and under the guard",
                    [Table("Each function", ["mesh", "function", "way of the guard", "pairs alone", "pairs guarded", "of the way", "time alone", "time guarded"], rows)])]


def simplification(report):
    methods = {"under the guard": "under the guard", "edge_collapse": "CGAL's edge_collapse"}
    points, pairs = [], {}
    for method, name in methods.items():
        rows = [r for r in report["rows"] if r["method"] == method]
        pairs[method] = sum(r["pairs"] for r in rows)
        points.append((name, sum(r["seconds"] for r in rows) / len(rows), pairs[method] / len(rows)))
    return [Finding("simplification", f"Simplified to {percent(report['share'])} of the edges, {len(report['rows']) // 2} runs leave {pairs['edge_collapse']:,} pairs of intersecting "
                    f"faces by CGAL's edge_collapse, {pairs['under the guard']:,} under the guard.", f"{pairs['under the guard']:,}",
                    f"pairs under the guard, {pairs['edge_collapse']:,} without",
                    speed_error(points, "pairs of intersecting faces, mean", "mean processor time of a mesh"), "Time of simplification against intersecting faces",
                    [Table("Each mesh", ["mesh", "policies", "method", "faces before", "faces left", "time", "pairs", "distance", "valid"],
                           [[r["mesh"], r["policies"], r["method"], f"{r['faces_before']:,}", f"{r['faces_left']:,}", seconds_text(r["seconds"] or 1e-6), r["pairs"], f"{r['distance']:.3g}", "yes" if r["valid"] else "no"]
                            for r in report["rows"]])])]


def device(report):
    def points(form, what):
        rows = {r["scalar"]: r for r in report["rows"] if r["population"] == "path" and r["form"] == form and r["what"] == what}
        return [(s, rows[k]["ns"] * 1e-9, rows[k]["error_over_condition"]["median"] or 0)
                for k, s in (("double", "double"), ("float", "float"), ("long double", "long double"), ("MPFR 34", "MPFR, 34 digits")) if k in rows]

    table = Table("Each function and number type", ["population", "form", "function", "number", "time", "median error / condition", "largest"],
                  [[r["population"], r["form"], r["what"], r["scalar"], seconds_text(r["ns"] * 1e-9),
                    *("" if r["error_over_condition"].get(k) is None else f"{r['error_over_condition'][k]:.2g}" for k in ("median", "max"))] for r in report["rows"]])
    found = []
    for form, what, title in (("ditetra", "forward", "The forward kinematics"), ("ditetra", "inverse dynamics", "The inverse dynamics")):
        of = points(form, what)
        if of:
            found.append(Finding("device", f"{title} in doubles take {seconds_text(of[0][1])}, with an error of {power_text(of[0][2])} of the condition.", seconds_text(of[0][1]),
                                 f"{what}, doubles", speed_error(of, "median error over condition", "time of a call"),
                                 f"Time of the {what} against its error, by number type", [table] if not found else [], picture="" if found else "device_speed_error"))
    return found + models_of_device(report)


def models_of_device(report):
    """Of torques and positions: what a simpler model saves, and how far off it is."""
    short = {"ditetrahedral": "di-tetrahedral", "general": "general"}
    rows = [r for r in report.get("models", []) if r["population"] == "path"]
    if not rows:
        return []
    by = {(r["form"], r["model"]): r for r in rows}
    points = [(f"{r['model']}, {short[r['form']]}" if r["what"] == "joint torques" else r["model"],
               r["ns"] * 1e-9, r["relative_error"]["median"]) for r in rows]
    planar, spatial = (by["general", m] for m in ("links in their planes", "links in space"))
    point = by["general", "a point for the platform"]
    table = Table("Each model", ["population", "form", "what", "model", "time", "off by, median", "largest"],
                  [[r["population"], short[r["form"]], r["what"], r["model"], seconds_text(r["ns"] * 1e-9),
                    *(f"{r['relative_error'][k]:.2g}" for k in ("median", "max"))] for r in report["models"]])
    off = percent(planar["relative_error"]["median"])
    sentence = (f"Links counted as if they stayed in their planes put the torques off by {off}, a point in the place of "
                f"the platform the handle by {percent(point['relative_error']['median'])} of a link; the true torques "
                f"take {seconds_text(spatial['ns'] * 1e-9)}.")
    figure = speed_error(points, "median relative error", "time of a call")
    return [Finding("device", sentence, off, "of the torques, planar links, median", figure,
                    "Time of the device's models against their error", [table], picture="device_models")]


def force(report):
    rows = [r for r in report["rate"] if r["encoder_step"] == 0]
    series = {f"delay of {d:g} ticks": [(r["rate_Hz"], r["mean_N"]) for r in rows if r["delay"] == d] for d in (0.0, 0.5, 1.0)}
    at = next(r for r in rows if r["delay"] == 0 and r["rate_Hz"] == 1000)
    table = Table("Error of the force, 60 mm/s into 500 N/m", ["rate, Hz", "delay, ticks", "encoder step, rad", "mean, mN", "largest, mN"],
                  [[f"{r['rate_Hz']:g}", r["delay"], r["encoder_step"], f"{1e3 * r['mean_N']:.3g}", f"{1e3 * r['largest_N']:.3g}"] for r in report["rate"]])
    return [Finding("force", f"At 1 kHz the force held over a tick is {1e3 * at['mean_N']:.3g} mN off in the mean, at 60 mm/s into 500 N/m; half the tick, half the error.",
                    f"{1e3 * at['mean_N']:.3g} mN", "mean error of the force at 1 kHz", lines(series, "rate, Hz", "mean error of the force, N", times=False),
                    "Error of the force against the rate, by delay", [table])]


def answers_of_others(name, rows):
    """Of programs whose answers were handed in, judged by the oracle."""
    points = [(r["name"], r["seconds_a_query"], r["share_wrong"]) for r in rows if r["seconds_a_query"]]
    table = Table("Answers handed in", ["program", "queries", "time of one", "false alarms", "missed", "largest error of the time"],
                  [[r["name"], r["queries"],
                    "not said" if r["seconds_a_query"] is None else seconds_text(r["seconds_a_query"]),
                    r["false_positives"], r["false_negatives"],
                    "" if r["largest_error"] is None else f"{r['largest_error']:.2g}"] for r in rows])
    return [Finding(name, f"{len(rows)} programs have answered the same queries.", str(len(rows)), "programs beside ours",
                    speed_error(points, "share of wrong verdicts", "time of a query") if points else "", "Time of other programs' answers against wrong verdicts", [table])]


CHARTS = {"sweeps": sweeps, "axis": axis, "drags": stops, "responses": responses, "whole_drags": whole_drags, "many_vertices": many_vertices, "functions": functions, "simplification": simplification,
          "device": device, "force": force}
