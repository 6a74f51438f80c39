# SPDX-License-Identifier: GPL-3.0-or-later
"""What `robustness --dump` has left of a run: each case, a mesh and a script, is made small within a bounded time."""
import subprocess
import sys

import ends_with_parent
import results
import steps

SECONDS_A_CASE = 60  # a batch of 1,000 drags takes 1 s to replay, so this is some dozens of tries
MOST_CASES = 10  # of a run: with more of them the first tell enough
SMALL = ".small"
CUT_SHORT = "minimise ended with"  # a note that begins so says why; the same command tries again


def scripts(out, names):
    """(step, shard, script) of each case of these steps, as the programs wrote it. A run with another number of shards has left
    its own, which are made again by nobody."""
    found, count = [], results.circumstances(out)["shards"]
    for name in names:
        for script in sorted((out / "failures" / name).glob(f"*_of_{count[name]}/*.script")):
            if not script.stem.endswith(SMALL):
                found.append((name, script.parent.name.replace("_of_", "/"), script))
    return found


def small(script, suffix):
    return script.with_name(script.stem + SMALL + suffix)


def minimise(out, names, sculpt):
    """Makes the cases small that are not yet."""
    for _, _, script in scripts(out, names)[:MOST_CASES]:
        note = small(script, ".txt")
        said = note.read_text() if note.exists() and note.stat().st_mtime > script.stat().st_mtime else ""
        if said.endswith("\n") and not said.startswith(CUT_SHORT):  # a note without its end was cut off
            continue
        words = [sys.executable, steps.BENCHMARK / "robustness" / "minimise", sculpt, script.with_suffix(".off"),
                 script, "--out", script.with_name(script.stem + SMALL), "--seconds", SECONDS_A_CASE]
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                              preexec_fn=ends_with_parent.of_this_process())
        said = {0: done.stdout.split(" tries")[0] + " tries",
                1: "replayed by sculpt it does not fail: robustness alone judges what did"}
        otherwise = f"{CUT_SHORT} {done.returncode}: {done.stderr.strip()[-300:]}"
        try:
            note.write_text(said.get(done.returncode, otherwise) + "\n")
        except OSError as error:  # a full disk: the same command tries again
            print(f"{note}: {error}", file=sys.stderr)


def rows(out, names):
    """For the page: where each case lies, and what was made of it."""
    result = []
    for step, shard, script in scripts(out, names):
        files, note = small(script, ".script"), small(script, ".txt")
        result.append({"step": step, "shard": shard, "case": str(script.relative_to(out)),
                       "small": str(files.relative_to(out)) if files.exists() else "",
                       "note": note.read_text().strip() if note.exists() else "not made small: the first ten are"})
    return result
