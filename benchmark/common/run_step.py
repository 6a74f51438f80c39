#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one shard of one step, within its time: run_step.py STEP I N --mode MODE --build FOLDER --json FILE [--meshes FOLDER [--meshes-digest D] [--repair]] [--minutes M]

The report appears when it is whole. Beside it go FILE.log, what the program printed, and FILE.note, the command and how
it went. A broken promise is a result, and so is that `--minutes` were too few; a program that dies, or takes longer than
its step allows, is named in FILE.failed, with the command that repeats it.
Exit: 0 there is a report, 1 there is none, 3 by `--unless-it-fits` alone.
"""
import argparse
import json
import os
import pathlib
import platform
import resource
import shlex
import shutil
import subprocess
import sys
import time

import ends_with_parent
import steps

CANNOT_WRITE = 5  # of a program, and no promise is broken


def told(code, minutes):
    if code is None:
        return f"had not ended after its {minutes:g} minutes"
    if code == CANNOT_WRITE:
        return "could not write"
    return f"was ended by signal {-code}" if code < 0 else f"ended with exit code {code} and no report"


def report_of_exit(step, shard, shards, code, asked):
    """Of a program that has no report of its own."""
    promises = [{"exit": 10, "promise": step.promise, "asked": asked, "broken": int(code != 0), "may": 0}]
    return {"shard": f"{shard}/{shards}", "promises": promises, "exit": 10 if code != 0 else 0}


def made_with(step, options):
    """What the result of any shard hangs on: the same for all shards of one run, and for what it need not make again."""
    words, extra = steps.command_of(step, options.mode, 0, options.shards, options.build, options.meshes, options.seed, "", options.repair)
    program = pathlib.Path(words[0])
    return {"command": words, "environment": extra, "program": program.stat().st_mtime_ns if program.exists() else 0,
            "meshes": options.meshes_digest if step.with_meshes else ""}


def minutes_used(folder, shards, settings):
    """By the shards of this run that have ended. Of other settings notes lie there, too, and of shards that are being made again."""
    notes = [json.loads(path.read_text()) for path in folder.glob(f"*_of_{shards}.note") if path.with_suffix(".json").exists()]
    return sum(note["seconds"] for note in notes if note.get("made_with") == settings) / 60


def died(options, why, seconds, shown):
    """Names a shard that leaves no report, and how it is run alone."""
    try:
        with open(options.json.with_suffix(".failed"), "a") as file:
            file.write(f"{options.step}, shard {options.shard}/{options.shards}, {why} on {platform.node()} after {seconds:.0f} s: {shown}\n")
    except OSError as error:  # a full disk, by which the program may have died: its death is named below
        print(f"{error}", file=sys.stderr)
    print(f"{options.step}, shard {options.shard}/{options.shards}, {why}; alone: {shown}", file=sys.stderr)
    return 1


def write_report(path, report):
    whole = path.with_suffix(".whole")
    whole.write_text(json.dumps(report, indent=1) + "\n")
    whole.replace(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step")
    parser.add_argument("shard", type=int)
    parser.add_argument("shards", type=int)
    parser.add_argument("--mode", required=True, choices=steps.MODES)
    parser.add_argument("--build", required=True)
    parser.add_argument("--json", required=True, type=pathlib.Path)
    parser.add_argument("--meshes", default="")
    parser.add_argument("--meshes-digest", default="", help="of what the folder has to hold: that the run began with")
    parser.add_argument("--repair", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=0, help="for all shards of the step together; 0: no bound")
    parser.add_argument("--unless-it-fits", action="store_true", help="do no more than write the report of a shard whose minutes are used up; exit 3 where they are not")
    parser.add_argument("--parent", type=int, default=os.getppid(), help="the process that it ends with")
    options = parser.parse_args()
    ends_with_parent.begin(options.parent)
    step = steps.all_steps()[options.step]
    minutes = step.effort(options.mode).minutes
    settings = made_with(step, options)
    options.json.with_suffix(".note").unlink(missing_ok=True)  # of a result that is being made again
    left = options.minutes - minutes_used(options.json.parent, options.shards, settings)
    is_bounded = 0 < options.minutes and left <= minutes  # by the user: what does not fit has not failed
    minutes = left if is_bounded else minutes
    if minutes <= 0:
        write_report(options.json, {"shard": f"{options.shard}/{options.shards}", "did_not_fit": f"not begun: {options.minutes:g} minutes of the step are used up"})
        return 0
    if options.unless_it_fits:
        return 3
    unfinished = options.json.with_suffix(".unfinished")
    unfinished.unlink(missing_ok=True)
    words, extra = steps.command_of(step, options.mode, options.shard, options.shards, options.build, options.meshes, options.seed,
                                    str(unfinished), options.repair)
    shown = " ".join([*(f"{k}={v}" for k, v in extra.items()), shlex.join(words)])
    shutil.rmtree(steps.dump_folder(step.name, options.shard, options.shards), ignore_errors=True)  # of an earlier try
    digest = steps.digest_of(options.meshes) if step.with_meshes else ""
    if digest and options.meshes_digest not in ("", digest):
        return died(options, "found other meshes in the folder than the run began with", 0, shown)
    begin = time.time()
    with open(options.json.with_suffix(".log"), "wb") as log:
        try:
            done = subprocess.run(words, stdout=log, stderr=subprocess.STDOUT, env={**os.environ, **extra},
                                  timeout=60 * minutes, check=False, preexec_fn=ends_with_parent.of_this_process())
            code = done.returncode
        except subprocess.TimeoutExpired:
            code = None
        except OSError as error:
            log.write(f"{error}\n".encode())
            code = 127
    seconds = time.time() - begin
    if code is None and is_bounded:
        report = {"shard": f"{options.shard}/{options.shards}", "did_not_fit": f"more than {minutes:.3g} minutes"}
    elif code is None:
        report = None
    elif step.promise and code in (0, 201):  # 201: a test failed
        asked = steps.share_of(step, options.mode, options.shards)
        report = report_of_exit(step, options.shard, options.shards, code, asked)
    else:
        try:
            report = json.loads(unfinished.read_text())
        except (OSError, ValueError):
            report = None
        if report is not None and (code != report.get("exit", 0) or code == CANNOT_WRITE):
            report = None  # it died after it had written, or lacks cases that a full disk has not taken
    if report is None:
        return died(options, told(code, minutes), seconds, shown)
    if digest:
        report["meshes_digest"] = digest  # for the merge: shards that have read other files do not belong together
    failed = options.json.with_suffix(".failed")
    attempts = 1 + (len(failed.read_text().splitlines()) if failed.exists() else 0)
    note = {"command": shown, "seconds": round(seconds, 3), "cpu_seconds": round(sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2]), 1),
            "peak_megabytes": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024, "host": platform.node(), "attempts": attempts,
            "exit": code, "made_with": settings}
    options.json.with_suffix(".note").write_text(json.dumps(note, indent=1) + "\n")
    unfinished.unlink(missing_ok=True)
    write_report(options.json, report)
    return 0


if __name__ == "__main__":
    sys.exit(main())
