#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes FOLDER/index.html of the reports in a folder of results: make_page.py FOLDER [--answers FILE ...] [--pictures FOLDER]

One file: figures are in it, nothing is fetched. Of each part the headline comes first; tables are behind. `--answers`
adds what other programs have answered to the queries of sweep_speed_error --write-queries. `--pictures` writes those
figures that the manual shows as files, too: its pictures are the page's own.
"""
import argparse
import importlib.util
import pathlib
import sys

import jinja2

import failing_cases
import figures
import results
import steps

sys.path.insert(0, str(steps.BENCHMARK / "quality"))
TITLES = {"performance": "Performance", "quality": "Quality: speed against error", "robustness": "Robustness"}


def charts_of(part):
    spec = importlib.util.spec_from_file_location(f"charts_of_{part}", steps.BENCHMARK / part / "charts.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def findings(part, reports, answers):
    """What the charts of a part make of the reports. Charts are made for whole reports: of one whose shards did not all
    fit there is none where it lacks what the chart shows; the table of steps lists it."""
    module = charts_of(part)
    found = []
    for name, chart in module.CHARTS.items():
        if name in reports and any(key not in ("shard", "did_not_fit") for key in reports[name]):
            try:
                found += chart(reports[name])
            except (ArithmeticError, LookupError, StopIteration, ValueError):
                # a part, the row sought, or all rows are missing
                if not reports[name].get("did_not_fit"):
                    raise
    if part == "quality" and answers:
        import read_answers
        found += module.answers_of_others("answers", read_answers.read(answers))
    return found


def rows_of_steps(out, names):
    """How each step went: shards, time, deaths, what did not fit."""
    rows = []
    known = steps.all_steps()
    for name in names:
        shards = results.shards(out, name)
        died = results.deaths(out, [name])
        rows.append({"name": name, "part": known[name].part, "program": known[name].program, "shards": len(shards),
                     "seconds": sum(note.get("cpu_seconds", 0) for _, note, _ in shards),
                     "memory": max((note.get("peak_megabytes", 0) for _, note, _ in shards), default=0),
                     "hosts": sorted({note["host"] for _, note, _ in shards if "host" in note}),
                     "retried": [shard for shard, note, _ in shards if note.get("attempts", 1) > 1], "unfit": results.did_not_fit(out, name), "died": died,
                     "command": next((note.get("command") for _, note, _ in shards), "")})
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--answers", type=pathlib.Path, action="append", default=[])
    parser.add_argument("--pictures", type=pathlib.Path)
    options = parser.parse_args()
    figures.has_pictures = options.pictures is not None
    reports = results.reports(options.folder)
    run = results.circumstances(options.folder)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    parts = [(part, TITLES[part], findings(part, reports, options.answers)) for part in steps.PARTS]
    page = environment.get_template("page.html.jinja").render(
        run=run, parts=parts, steps=rows_of_steps(options.folder, run["steps"]), broken=results.broken_promises(options.folder),
        failures=failing_cases.rows(options.folder, run["steps"]),
        promises=sum(p["asked"] > 0 for _, p in results.promises(options.folder)))
    target = options.folder / "index.html"
    target.with_suffix(".new").write_text(page)
    target.with_suffix(".new").replace(target)
    for finding in (f for _, _, found in parts for f in found if options.pictures and f.picture and f.figure):
        picture = options.pictures / f"{finding.picture}.png"
        picture.with_suffix(".new").write_bytes(figures.PICTURES[finding.figure])
        picture.with_suffix(".new").replace(picture)
        print("picture:", picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
