# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run has left in its folder: circumstances, reports, notes of shards, deaths."""
import datetime
import json
import os
import pathlib
import platform
import re
import subprocess

import merge_shards


def output_of(*words, cwd=None):
    try:
        return subprocess.run(words, cwd=cwd, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def processor():
    found = re.search(r"^model name\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found[1] if found else platform.machine()


def write_circumstances(out, root, build, options, digest, shards):
    """Machine, compiler, flags, commit and seed, before anything runs. \\param digest of the meshes \\param shards {step: how many}"""
    cache = (build / "CMakeCache.txt").read_text() if (build / "CMakeCache.txt").exists() else ""
    entry = {m[1]: m[2] for m in re.finditer(r"^(\w+):\w+=(.*)$", cache, re.MULTILINE)}
    kind = entry.get("CMAKE_BUILD_TYPE", "")
    compiler = entry.get("CMAKE_CXX_COMPILER", "")
    version = re.search(r'HAPTIC_SCULPT_VERSION "([^"]*)"', (root / "include/haptic_sculpt/version.h").read_text())
    changed = output_of("git", "status", "--porcelain", "--untracked-files=no", cwd=root)
    circumstances = {
        "mode": options.mode, "steps": list(shards), "shards": shards, "seed": options.seed, "profile": options.profile,
        "meshes": str(options.meshes or ""), "meshes_digest": digest, "begun": datetime.datetime.now().astimezone().isoformat(timespec="seconds"),
        "version": version[1] if version else "", "commit": output_of("git", "rev-parse", "HEAD", cwd=root) + (", changed" if changed else ""),
        "machine": processor(), "cores": os.cpu_count(), "memory_GB": round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30, 1),
        "system": platform.platform(), "compiler": output_of(compiler, "--version").splitlines()[0] if compiler and output_of(compiler, "--version") else "",
        "flags": " ".join([entry.get("CMAKE_CXX_FLAGS", ""), entry.get(f"CMAKE_CXX_FLAGS_{kind.upper()}", "")]).strip(),
        "load": os.getloadavg()[0]}
    (out / "run.json").write_text(json.dumps(circumstances, indent=1) + "\n")


def circumstances(out):
    return json.loads((out / "run.json").read_text())


def reports(out):
    """The merged report of each step of this run all of whose shards have one."""
    wanted = circumstances(out)["steps"]
    return {name: json.loads(path.read_text()) for name in wanted
            if (path := out / "results" / f"{name}.json").exists() and not deaths(out, [name])}


def shards(out, name):
    """(shard, note, report) of each shard that has ended. Those of a run with another number of them may lie there, too."""
    rows, count = [], circumstances(out)["shards"][name]
    for path in sorted((out / "shards" / name).glob(f"*_of_{count}.json"), key=lambda p: int(p.name.split("_")[0])):
        note = path.with_suffix(".note")
        rows.append((path.stem.replace("_of_", "/"), json.loads(note.read_text()) if note.exists() else {}, json.loads(path.read_text())))
    return rows


def read_or_nothing(path):
    """A JSON object; nothing where the file is not whole, or not there."""
    try:
        value = json.loads(path.read_text())
    except (OSError, ValueError):
        return None
    return value if isinstance(value, dict) else None


def forget_what_cannot_be_used(out):
    """What did not fit, and what is damaged, so that it is made again."""
    for path in (out / "shards").glob("*/*_of_*.json"):
        report, note = read_or_nothing(path), path.with_suffix(".note")
        if report is None or "did_not_fit" in report or (note.exists() and read_or_nothing(note) is None):
            for file in (path, note, out / "results" / f"{path.parent.name}.json"):
                file.unlink(missing_ok=True)
    for path in (out / "results").glob("*.json"):
        if read_or_nothing(path) is None:
            path.unlink()


def did_not_fit(out, name):
    """The shards of a step for which `--minutes` were too few."""
    return [shard for shard, _, report in shards(out, name) if "did_not_fit" in report]


def deaths(out, names):
    """The last word of each shard that has no report."""
    count = circumstances(out)["shards"]
    found = []
    for name in names:
        for i in range(count[name]):
            path = out / "shards" / name / f"{i}_of_{count[name]}.failed"
            if not path.with_suffix(".json").exists():
                lines = path.read_text().splitlines() if path.exists() else []  # none where the disk was full
                found.append(lines[-1] if lines else f"{name}, shard {i}/{count[name]}, was ended from outside, or not begun")
    return found


def promises(out):
    """[(step, promise)] by all shards that have ended: what one of them saw broken is not undone by the death of another."""
    return [(name, p) for name in circumstances(out)["steps"]
            for p in merge_shards.merged_promises([report for _, _, report in shards(out, name)])]


def broken_promises(out):
    """Of every step: sentences."""
    return [f"{name}: {p['promise']}: {p['broken']} of {p['asked']} not, exit {p['exit']}" for name, p in promises(out)
            if merge_shards.is_broken(p)]
