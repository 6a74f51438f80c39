#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Joins the reports of all shards of one run: merge_shards.py --json MERGED.json SHARD.json ...

The merged report is that of the run without --shard, but for times. A row carries the number of its unit, and rows stand
in the order of units. A unit that is in one shard alone is taken as it is; of one that several shards have, counts add up
and the largest stays the largest. The exit code is that of the first promise that is broken in all shards together.
Exit: that code, 0 where every promise is kept, 2 usage: a shard is missing, there twice, or of another run, 5 the
merged report cannot be written.
"""
import argparse
import itertools
import json
import os
import pathlib
import re
import sys

TIME = re.compile(r"_ns$|_us$|^ns$|_seconds$|^seconds$|^cpu_us|_cpu_us$|^seconds_|_seconds_|^time_ratio$|^set_up$|^ns_a_line|^ms_|^(shift|held_back|validate)_s$")
LARGEST = re.compile(r"^(largest|longest|most|max)(_|$)")
SAME = {"unit", "faces", "triangles", "exit", "may"}  # of a row: part of what it is
OF_A_PROMISE = {"exit": int, "promise": str, "asked": (int, float), "broken": (int, float), "may": (int, float)}
MOST_DEEP = 50  # lists and objects in each other: reports have few, and Python takes some hundreds
ADDED_AT_THE_TOP = {"wrongly_accepted", "wrongly_refused"}


class Odd_shards(Exception):
    """What is given is not one run."""


def is_time(name):
    """Whether a field's value hangs on the clock, or on the machine."""
    return bool(TIME.search(name)) or name == "pinned_to_core"


def merged_values(name, values, where):
    """Of one field that several shards have."""
    first = values[0]
    if all(isinstance(v, dict) for v in values):
        return merged_fields(values, where)
    if all(isinstance(v, list) for v in values):
        return merged_lists(values, where)
    if name in SAME or any(isinstance(v, (str, bool)) or v is None for v in values):
        if any(v != first for v in values) and not is_time(name):
            raise Odd_shards(f"{where}: {name} is {', '.join(map(repr, values))}: shards of different runs?")
        return first
    if LARGEST.search(name):
        return max(values)
    return sum(values) / len(values) if is_time(name) else sum(values)


def merged_fields(dicts, where):
    names = dict.fromkeys(name for d in dicts for name in d)
    return {name: merged_values(name, [d[name] for d in dicts if name in d], f"{where}/{name}") for name in names}


def identity(row):
    return tuple((k, v) for k, v in row.items() if isinstance(v, str) or k in SAME)


def merged_lists(lists, where):
    if all(isinstance(row, dict) for rows in lists for row in rows):
        if any("unit" in row for rows in lists for row in rows):
            return merged_units(lists, where)
        if all(rows == lists[0] for rows in lists) and "promise" not in (lists[0] or [{}])[0] and "family" not in (lists[0] or [{}])[0]:
            return lists[0]  # what every shard has seen
        groups = {}
        for rows in lists:
            for row in rows:
                groups.setdefault(identity(row), []).append(row)
        return [merged_fields(rows, where) for rows in groups.values()]
    if all(isinstance(x, (int, float)) for values in lists for x in values) and len({len(values) for values in lists}) == 1:
        return [sum(column) for column in zip(*lists)]
    return list(dict.fromkeys(x for values in lists for x in values))


def merged_units(lists, where):
    units = {}
    for shard, rows in enumerate(lists):
        for row in rows:
            units.setdefault(row["unit"], {}).setdefault(shard, []).append(row)
    result = []
    for unit in sorted(units):
        of_shards = list(units[unit].values())
        if len(of_shards) == 1:
            result += of_shards[0]
            continue
        groups = {}
        for rows in of_shards:
            for row in rows:
                groups.setdefault(identity(row), []).append(row)
        result += [merged_fields(rows, f"{where}, unit {unit}") for rows in groups.values()]
    return result


def is_broken(promise):
    """More often than it may be."""
    return promise["broken"] > promise["may"] * promise["asked"]


def exit_of(promises):
    """The code of the first promise that is broken."""
    return next((p["exit"] for p in promises if is_broken(p)), 0)


def merged_promises(reports):
    """Of any shards, in order: all of them or some."""
    return merged_lists([[], *(report.get("promises", []) for report in reports)], "promises")


def in_order(reports):
    """The reports by number. \\throw Odd_shards unless they are 0 to n - 1 of n"""
    numbered = {}
    for report in reports:
        i, n = map(int, report["shard"].split("/"))
        if not 0 <= i < n:
            raise Odd_shards(f"there is no shard {i}/{n}")
        if i in numbered:
            raise Odd_shards(f"shard {i}/{n} is there twice")
        numbered[i] = report
    counts = {report["shard"].split("/")[1] for report in reports}
    if len(counts) != 1:
        raise Odd_shards("shards of runs with different numbers of them: " + ", ".join(sorted(counts)))
    n = int(counts.pop())
    missing = list(itertools.islice((f"{i}/{n}" for i in range(n) if i not in numbered), 10))  # of 10^12 the first
    if missing:
        raise Odd_shards("missing: shard " + ", ".join(missing))
    return [numbered[i] for i in range(n)]


def merge(reports):
    """The report of the whole run. \\throw Odd_shards"""
    reports = in_order(reports)
    merged = {}
    for name in dict.fromkeys(name for report in reports for name in report):
        values = [report[name] for report in reports if name in report]
        if name == "shard":
            merged[name] = "0/1"
        elif name == "did_not_fit":
            merged[name] = len(values)  # this many shards
        elif name == "exit":
            merged[name] = max(values)  # judged below, where the promises are known
        elif isinstance(values[0], (dict, list)):
            merged[name] = merged_values(name, values, name)
        elif name in ADDED_AT_THE_TOP:
            merged[name] = sum(values)
        elif is_time(name):
            merged[name] = values[0]
        elif any(v != values[0] for v in values):
            raise Odd_shards(f"{name} is {', '.join(map(repr, values))}: shards of different runs?")
        else:
            merged[name] = values[0]
    if "promises" in merged:
        merged["exit"] = exit_of(merged["promises"])
    return merged


def is_deeper(value, most):
    values = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return most == 0 or any(is_deeper(v, most - 1) for v in values)


def is_promise(value):
    return isinstance(value, dict) and all(isinstance(value.get(k), kind) for k, kind in OF_A_PROMISE.items())


def report_in(path):
    """\\throw Odd_shards unless it is the report of a shard"""
    try:
        report = json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise Odd_shards(f"{path}: {error}") from error
    except RecursionError:
        report = None
    is_of_a_shard = isinstance(report, dict) and re.fullmatch(r"\d+/\d+", str(report.get("shard")))
    if not is_of_a_shard or is_deeper(report, MOST_DEEP):
        raise Odd_shards(f"{path} is no report of a shard")
    promises, code = report.get("promises", []), report.get("exit", 0)
    if not isinstance(promises, list) or not all(map(is_promise, promises)) or not isinstance(code, int):
        raise Odd_shards(f"{path}: its promises, or its exit code, are none")
    return report


def write_report(path, report):
    """The merged one, whole or not at all. \\throw OSError"""
    text = json.dumps(report, indent=1) + "\n"
    if path.exists() and not path.is_file():  # a device or a pipe
        path.write_text(text)
        return
    path = path.resolve()  # a link stays
    whole = path.with_name(f"{path.name}.{os.getpid()}.whole")
    try:
        whole.write_text(text)
        whole.replace(path)
    except OSError:
        whole.unlink(missing_ok=True)
        raise


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reports", nargs="+", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path, required=True, help="where the merged report goes")
    options = parser.parse_args()
    try:
        reports = [report_in(path) for path in options.reports]
        if options.json.exists() and any(options.json.samefile(path) for path in options.reports):
            raise Odd_shards(f"{options.json} is a shard: it would be written over")
        merged = merge(reports)
    except Odd_shards as odd:
        print("merge_shards:", odd, file=sys.stderr)
        return 2
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:  # JSON, but of other things
        names = ", ".join(map(str, options.reports))
        print(f"merge_shards: no reports of one run: {names}: {error!r}", file=sys.stderr)
        return 2
    try:
        write_report(options.json, merged)
    except OSError as error:
        print(f"merge_shards: {options.json} cannot be written: {error.strerror}", file=sys.stderr)
        return 5
    return merged.get("exit", 0)


if __name__ == "__main__":
    sys.exit(main())
