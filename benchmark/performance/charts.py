# SPDX-License-Identifier: GPL-3.0-or-later
"""What the page says of performance."""
from figures import Finding, Table, lines, seconds_text, speed_error, two_panels


def row_times(report, **wanted):
    """{x: seconds} of the rows with these fields."""
    x = "valence" if "valence" in wanted.pop("against", "triangles") else "triangles"
    return sorted((r[x], r["median_ns"] * 1e-9) for r in report["rows"] if x in r and "median_ns" in r and all(r.get(k) == v for k, v in wanted.items()))


def drags(report):
    ours = {"structure": "box tree", "mesh": "torus", "step_edges": 0.1, "response": "stop"}
    inside = row_times(report, **ours, workload="in a drag")
    if not inside:
        return []
    new = row_times(report, **ours, workload="new vertex")
    size, seconds = inside[-1]
    series = {"a further step of a drag": inside, "a new vertex": new}
    for name, structure in (("with the paper's six lists", "six lists"), ("with Boost's rtree", "Boost rtree"), ("with all faces looked at", "brute force")):
        series[name] = row_times(report, structure=structure, workload="new vertex", step_edges=0.1)
    series["does_self_intersect after it"] = row_times(report, structure="does_self_intersect, whole", step_edges=0.1)
    table = Table("Drags against the number of triangles", ["structure", "mesh", "triangles", "what", "step, edges", "response", "median", "p99", "blocked"],
                  [[r.get("structure"), r["mesh"], f"{r['triangles']:,}", r["workload"], r.get("step_edges", ""), r.get("response", ""),
                    seconds_text(r["median_ns"] * 1e-9), seconds_text(r["p99_ns"] * 1e-9), r.get("blocked", "")]
                   for r in report["rows"] if "median_ns" in r and "valence" not in r])
    growth = seconds / inside[0][1]
    found = [Finding("drags", f"A further step of a drag takes {seconds_text(seconds)} on {size:,} triangles, {growth:.2g} times what it takes on {inside[0][0]:,}.",
                     seconds_text(seconds), f"median of a step of 0.1 edges, {size:,} triangles",
                     lines(series, "triangles", "median time"), "Time of drags against triangles, ours and with other structures", [table], picture="drag_performance")]
    found += valences(report)
    found += memory(report)
    return found


def valences(report):
    series = {}
    for name, what in (("first drag", "valence: first drag"), ("pushed through", "valence: push through, stopped")):
        series[name] = row_times(report, against="valence", workload=what, mesh="fan")
    first = series["first drag"]
    sizes = {"our tree": row_times(report, structure="box tree", mesh="torus", workload="new vertex", step_edges=0.1),
             "the paper's six lists": row_times(report, structure="six lists", workload="new vertex", step_edges=0.1)}
    if len(first) < 2:
        return []
    fits = {(f["mesh"], f["workload"]): f["exponent"] for f in report["valence_fits"]}
    exponent = fits.get(("fan", "valence: first drag"))
    said = f", growing as its power {exponent:.2f}" if exponent else ""
    table = Table("Drags against the valence", ["mesh", "valence", "what", "median", "p99"],
                  [[r["mesh"], r["valence"], r["workload"], seconds_text(r["median_ns"] * 1e-9), seconds_text(r["p99_ns"] * 1e-9)]
                   for r in report["rows"] if "median_ns" in r and "valence" in r])
    return [Finding("drags", f"A vertex of valence {first[-1][0]:,} is dragged in {seconds_text(first[-1][1])}{said}. The paper expected linear cost in triangles and exponential cost in valence.",
                    seconds_text(first[-1][1]), f"median, valence {first[-1][0]:,}", two_panels((sizes, "triangles"), (series, "valence"), "median time of a drag"),
                    "The paper's two claims of cost: time of a drag against triangles, and against valence", [table], picture="drag_valences")]


def memory(report):
    rows = [r for r in report["rows"] if r.get("workload") == "set-up"]
    if not rows:
        return []
    last = rows[-1]
    # Of the smallest meshes most is what is there once.
    series = {"Sculptor, mesh not counted": [(r["triangles"], r["sculptor_bytes_per_triangle"]) for r in rows],
              "of this, the tree": [(r["triangles"], r["tree_bytes_per_triangle"]) for r in rows]}
    table = Table("Set-up and memory", ["triangles", "tree, bytes a triangle", "Sculptor, bytes a triangle", "tree", "Sculptor with validation"],
                  [[f"{r['triangles']:,}", f"{r['tree_bytes_per_triangle']:.1f}", f"{r['sculptor_bytes_per_triangle']:.1f}", seconds_text(r["tree_seconds"]),
                    seconds_text(r["sculptor_seconds_with_validation"])] for r in rows])
    return [Finding("drags", f"The Sculptor of {last['triangles']:,} triangles takes {last['sculptor_bytes_per_triangle']:.0f} bytes a triangle.",
                    f"{last['sculptor_bytes_per_triangle']:.0f} B", "a triangle, beside the mesh", lines(series, "triangles", "bytes a triangle", times=False),
                    "Bytes a triangle against triangles", [table])]


def edits(report):
    names = [e["edit"] for e in report["sizes"][0]["edits"]]
    series = {n: [(s["triangles"], e["ns"]["p50"] * 1e-9) for s in report["sizes"] for e in s["edits"] if e["edit"] == n] for n in names}
    last = report["sizes"][-1]
    slowest = max(last["edits"], key=lambda e: e["ns"]["p50"])
    table = Table("Edits, undo and redo", ["triangles or valence", "edit", "median", "p99", "undo", "redo", "bytes a step"],
                  [[s.get("triangles", f"valence {s.get('valence')}"), e["edit"], seconds_text(e["ns"]["p50"] * 1e-9), seconds_text(e["ns"]["p99"] * 1e-9),
                    seconds_text(e["undo_ns"]["p50"] * 1e-9), seconds_text(e["redo_ns"]["p50"] * 1e-9), f"{e.get('bytes_per_undo_step', 0):.0f}"]
                   for s in report["sizes"] + report["valences"] for e in s["edits"]])
    return [Finding("edits", f"On {last['triangles']:,} triangles the slowest edit, {slowest['edit']}, takes {seconds_text(slowest['ns']['p50'] * 1e-9)}.",
                    seconds_text(slowest["ns"]["p50"] * 1e-9), f"median, {slowest['edit']}", lines(series, "triangles", "median time"),
                    "Time of edits against triangles", [table], picture="edit_cost")]


def hand(report):
    series, rows = {}, []
    for r in report["rows"]:
        for key, name in (("cpu_us", "no bound"), ("bounded_cpu_us", "bounded")):
            if key in r:
                series[f"{r['what']}, {name}"] = [(q, r[key][p] * 1e-6) for q, p in ((0.5, "p50"), (0.01, "p99"), (0.001, "p999"), (0.0001, "p9999"))]
                rows.append([r["what"], name, *(seconds_text(r[key][p] * 1e-6) for p in ("p50", "p99", "p999", "p9999", "max"))])
    worst = max(r["bounded_cpu_us"]["p9999"] for r in report["rows"]) * 1e-6
    return [Finding("hand", f"Under a hand of {report['speed_mm_s']:g} mm/s on {report['triangles']:,} triangles 9,999 of 10,000 bounded drags take at most {seconds_text(worst)}.",
                    seconds_text(worst), "p99.99 of the processor time of a bounded drag",
                    lines(series, "share of drags that take longer", "processor time"), "Times of drags by quantile",
                    [Table("Drags under a fast hand", ["what", "work", "p50", "p99", "p99.9", "p99.99", "max"], rows)])]


def ticks(report):
    rows = [[name, *(seconds_text(report[key][p] * 1e-6) for p in ("p50", "p99", "p999", "p9999", "max"))]
            for name, key in (("all", "cpu_us"), ("probe", "cpu_us_probe"), ("vertex in hand", "cpu_us_vertex_in_hand"))]
    series = {name: [(q, report[key][p] * 1e-6) for q, p in ((0.5, "p50"), (0.01, "p99"), (0.001, "p999"), (0.0001, "p9999"))]
              for name, key in (("all ticks", "cpu_us"), ("probe", "cpu_us_probe"), ("vertex in hand", "cpu_us_vertex_in_hand"))}
    worst = seconds_text(report["cpu_us"]["p9999"] * 1e-6)
    return [Finding("ticks", f"9,999 of 10,000 ticks of the haptic loop on {report['triangles']:,} triangles take at most {worst} of processor time.", worst,
                    "p99.99 of the processor time of a tick", lines(series, "share of ticks that take longer", "processor time"),
                    "Times of ticks by quantile", [Table("Ticks", ["what", "p50", "p99", "p99.9", "p99.99", "max"], rows)])]


def validation(report):
    series = {}
    for r in report["rows"]:
        series.setdefault(r["mesh"], []).append((r["triangles"], r["validate_seconds"]))
        if r["mesh"] == "torus":
            series.setdefault("torus, does_self_intersect", []).append((r["triangles"], r["does_self_intersect_seconds"]))
    last = [r for r in report["rows"] if r["mesh"] == "torus"][-1]
    table = Table("Validation", ["mesh", "triangles", "validate()", "does_self_intersect", "a vertex pulled through"],
                  [[r["mesh"], f"{r['triangles']:,}", seconds_text(r["validate_seconds"]), seconds_text(r["does_self_intersect_seconds"]),
                    "refused" if r["pulled_through_is_refused"] else "valid"] for r in report["rows"]])
    return [Finding("validation", f"A torus of {last['triangles']:,} triangles is validated in {seconds_text(last['validate_seconds'])}; CGAL's test for intersections alone takes {seconds_text(last['does_self_intersect_seconds'])}.",
                    seconds_text(last["validate_seconds"]), f"validation, {last['triangles']:,} triangles", lines(series, "triangles", "time"),
                    "Time of validation against triangles", [table])]


def dabs(report):
    """Time of a dab against the share of the way that its vertices do not go, by brush."""
    rows = report["rows"]
    slowest = max(rows, key=lambda r: r["ms_p50"])
    points = [(r["brush"], r["ms_p50"] * 1e-3, max(0, 1 - r["share_of_the_way"])) for r in rows]
    table = Table("Dabs with each brush", ["brush", "dabs", "vertices, median", "median", "p99", "longest", "of the way", "valid"],
                  [[r["brush"], f"{r['dabs']:,}", f"{r['vertices_p50']:,.0f}", *(seconds_text(r[f"ms_{q}"] * 1e-3) for q in ("p50", "p99", "max")),
                    f"{100 * r['share_of_the_way']:.4g} %", "yes" if r["is_valid"] else "no"] for r in rows])
    return [Finding("dabs", f"Of the brushes {slowest['brush']} is the slowest: {seconds_text(slowest['ms_p50'] * 1e-3)} in the median for a dab of {slowest['vertices_p50']:,.0f} "
                    f"vertices on {report['triangles']:,} triangles.", seconds_text(slowest["ms_p50"] * 1e-3), f"median of a dab with {slowest['brush']}",
                    speed_error(points, "share of the way not gone", "median time of a dab"), "Time of a dab against the way not gone, by brush", [table])]


def threads(report):
    """By the clock: what more threads save."""
    rows = report["rows"]
    names = {"shift_s": "all along one axis", "held_back_s": "moved, most held back", "validate_s": "validation"}
    series = {name: [(r["threads"], r[key]) for r in rows if r["threads"] > 0] for key, name in names.items()}
    table = Table("With several threads", ["threads", *names.values(), "same bits"],
                  [[r["threads"] or "none", *(seconds_text(r[key]) for key in names), "yes" if r["same_bits"] else "no"] for r in rows])
    most = max(rows, key=lambda r: r["threads"])
    alone = next((r for r in rows if r["threads"] == 1), most)
    if most["threads"] == 0:
        return []  # compiled without oneTBB: nothing to compare
    ratio = alone["shift_s"] / most["shift_s"]
    return [Finding("threads", f"With {most['threads']} threads all {report['triangles']:,} triangles move along one axis in {seconds_text(most['shift_s'])}, {ratio:.2g} times as fast as with one; "
                    f"{'the bits are the same' if all(r['same_bits'] for r in rows) else 'the bits differ'}.", f"{ratio:.2g}×", f"as fast, {most['threads']} threads for one",
                    lines(series, "threads", "time by the clock", ticks=[r["threads"] for r in rows if r["threads"] > 0]) if any(series.values()) else "", "Time against the number of threads", [table])]


CHARTS = {"drags": drags, "edits": edits, "hand": hand, "ticks": ticks, "dabs": dabs, "validation": validation, "threads": threads}
