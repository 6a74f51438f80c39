#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public function that users call is in the lists that test_public_functions goes through.

Of Sculptor, Grab, Probe and Stroke all public members; of the headers that sculpting.h, collision.h and surface.h include, all functions
outside of namespace internal. Usage: check_public_functions.py SOURCE_FOLDER
"""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
include = root / "include"

# They read no coordinates: names of enumerators, options, and what is written to by the library itself.
without_coordinates = {
    "name_of", "clearance", "delta", "response", "work_limit", "known_valid",  # options, checked by Sculptor
    "mesh_file_format",
}


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def without_bodies(text):
    """Braces within functions and classes are emptied below the given depth by the callers; here: all nested braces."""
    out, depth = [], 0
    for c in text:
        depth -= c == "}"
        if depth == 0:
            out.append(c)
        depth += c == "{"
    return "".join(out)


def block_after(text, start):
    """What stands between the braces that open at or after `start`."""
    begin = text.index("{", start)
    depth = 0
    for i in range(begin, len(text)):
        depth += (text[i] == "{") - (text[i] == "}")
        if depth == 0:
            return text[begin + 1:i]
    raise ValueError("unbalanced braces")


def functions(text):
    """Names before a parenthesis that begin a function, in what has no bodies any more."""
    text = re.sub(r"#[^\n]*", "", text)
    found = set()
    for statement in re.split(r"[;}]|\{", without_bodies(text)):
        statement = re.sub(r"static_assert\s*\(.*", "", statement, flags=re.S)
        if match := re.search(r"(?:^|[\s&*>~])([A-Za-z]\w*)\s*\(", re.sub(r"template\s*<[^()]*?>\s*(?=\w)", "", statement)):
            if not re.search(r"\bfriend\b|\boperator\b|\b(if|for|while|return)\b|= *delete", statement):
                found.add(match.group(1))
    return found


def members(header, name):
    text = without_comments((include / header).read_text())
    body = block_after(text, re.search(rf"class (?:\[\[nodiscard\]\] )?{name} \{{", text).start())
    public = body.split("public:", 1)[1].split("private:", 1)[0]
    return {f"{name}::{f}" for f in functions(public) if f not in (name,)} | {f"{name}::{name}"}


def free(header):
    """Functions of namespace haptic_sculpt in a header and not of a namespace within."""
    text = without_comments((include / header).read_text())
    found = set()
    for part in re.finditer(r"namespace haptic_sculpt \{", text):
        body = block_after(text, part.start())
        body = re.sub(r"namespace \w+ (?=\{)", "@@", body)
        while "@@" in body:
            at = body.index("@@")
            body = body[:at] + body[at + 2 + len(block_after(body, at)) + 2:]
        found |= functions(body)
    return found


def included(header):
    return re.findall(r"#include <(haptic_sculpt/[^>]*)>", (include / "haptic_sculpt" / header).read_text())


listed = set()
for file in (root / "test/sculpting/public_functions").glob("*.h"):
    for names in re.findall(r'all\.push_back\(\s*\{((?:\s*"[^"]*")+)', file.read_text()):
        listed |= set(" ".join(re.findall(r'"([^"]*)"', names)).split())

wanted = members("haptic_sculpt/sculpting/Sculptor.h", "Sculptor")
wanted |= members("haptic_sculpt/sculpting/Grab.h", "Grab") - {"Grab::Grab"}
wanted |= members("haptic_sculpt/sculpting/Probe.h", "Probe") - {"Probe::Probe"}
wanted |= members("haptic_sculpt/sculpting/Stroke.h", "Stroke") - {"Stroke::Stroke"}
for public in ("surface.h", "collision.h", "sculpting.h"):
    for header in included(public):
        wanted |= free(header)
wanted = {name for name in wanted if name.split("::")[-1] not in without_coordinates or "::" in name}

missing = sorted(wanted - listed)
unknown = sorted(name for name in listed - wanted if "::" in name)
for name in missing:
    print(f"{name} is in no list of test/sculpting/public_functions: add a call of it")
for name in unknown:
    print(f"{name} is listed, but is no public function any more")
print(f"{len(wanted)} public functions, {len(missing)} not listed")
sys.exit(bool(missing or unknown or len(wanted) < 40))
