#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges what another program has answered to queries of sweep_speed_error --write-queries: read_answers.py ANSWERS ...

An answer file stands in the folder of `queries.txt` and `truth.txt`, or names it: lines `# name: TEXT`,
`# seconds: NUMBER` (of all queries together, optional), `# queries: FOLDER` (optional), then a line for each query, in
their order: `0`, or `1`, or `1 u` with the time of impact as a decimal. `-` says that the program has no answer: it counts
as wrong. `truth.txt` is written by the rational oracle, `0` or `1 num/den` a line.
"""
import json
import math
import pathlib
import sys
from fractions import Fraction

ANSWERS = {("0", 1), ("1", 1), ("1", 2), ("-", 1)}  # what a line begins with, and how many words it has


class Bad_answers(Exception):
    """Names the file and the line."""


def text_of(path):
    try:
        if not path.is_file():
            raise Bad_answers(f"{path} is no file")
        return path.read_text(encoding="utf-8-sig")  # a mark of the order of bytes is no answer
    except ValueError:  # its bytes, or those of its name
        raise Bad_answers(f"{str(path)!r} is no text") from None


def lines_of(path):
    lines = enumerate(text_of(path).splitlines(), 1)
    return [(n, line.split()) for n, line in lines if line.strip() and not line.startswith("#")]


def truth_of(path):
    """The time of impact for each query, None where there is none."""
    truth = []
    for number, words in lines_of(path):
        try:
            truth.append({("0", 1): lambda: None, ("1", 2): lambda: Fraction(words[1])}[words[0], len(words)]())
        except (KeyError, ValueError, ZeroDivisionError):
            raise Bad_answers(f"{path}, line {number}: '{' '.join(words)}' is not 0, or 1 and a fraction") from None
    if not truth:
        raise Bad_answers(f"{path} tells of no query")
    return truth


def read_one(path):
    """A row for the page."""
    head = dict(line[1:].split(":", 1) for line in text_of(path).splitlines() if line.startswith("#") and ":" in line)
    head = {key.strip(): value.strip() for key, value in head.items()}
    folder = pathlib.Path(head.get("queries", path.parent))
    truth = truth_of(folder / "truth.txt")
    answers = lines_of(path)
    if len(answers) != len(truth):
        raise Bad_answers(f"{path}: {len(answers)} answers to {len(truth)} queries: give one line each, '-' where there is none")
    seconds = None
    if "seconds" in head:
        try:
            seconds = float(head["seconds"]) / len(truth)
        except ValueError:
            seconds = math.nan
        if not 0 <= seconds < math.inf:
            raise Bad_answers(f"{path}: the seconds, '{head['seconds']}', are no time")
    false_positives = false_negatives = none = 0
    largest = None
    for (number, words), impact in zip(answers, truth):
        hits = impact is not None
        time = None
        try:
            is_answer = (words[0], len(words)) in ANSWERS
            time = float(words[1]) if is_answer and len(words) == 2 else None
        except ValueError:
            is_answer = False
        if not is_answer:
            raise Bad_answers(f"{path}, line {number}: '{' '.join(words)}' is not 0, 1, 1 u or -")
        if words[0] == "-":
            none += 1
            continue
        false_positives += words[0] == "1" and not hits
        false_negatives += words[0] == "0" and hits
        if hits and time is not None:
            error = float(abs(Fraction(time) - impact)) if 0 <= time <= 1 else 1.0
            largest = max(largest or 0.0, error)
    return {"name": head.get("name", path.stem), "queries": len(truth), "seconds_a_query": seconds, "false_positives": false_positives,
            "false_negatives": false_negatives, "not_answered": none, "share_wrong": (false_positives + false_negatives + none) / len(truth),
            "largest_error": largest}


def read(paths):
    return [read_one(pathlib.Path(path)) for path in paths]


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        sys.exit(0)
    try:
        print(json.dumps(read(sys.argv[1:]), indent=1))
    except (Bad_answers, OSError) as bad:
        sys.exit(f"read_answers: {bad}")
