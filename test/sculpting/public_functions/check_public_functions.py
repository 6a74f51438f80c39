#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public function that users call is tested. Usage: check_public_functions.py SOURCE_FOLDER

What reads coordinates of a scene is in the lists that test_public_functions goes through: of Sculptor, Grab, Probe
and Stroke all public members; of the headers that sculpting.h, collision.h and surface.h include, and of those that
stand on their own, all functions outside of namespace internal. Of the device and the loop each function, and each
public member of a class, is called in a test of test/device or test/haptic_rendering that has to do with its class.
"""
import re
import sys
from pathlib import Path

from called_functions import Api, block_after, functions, with_included, without_comments

root = Path(sys.argv[1])
include = root / "include"

# They read no coordinates: names of enumerators, options, and what is written to by the library itself.
without_coordinates = {
    "name_of", "clearance", "delta", "response", "work_limit", "known_valid",  # options, checked by Sculptor
    "mesh_file_format",
}
# Headers that no other one includes, for what they take to compile.
on_their_own = ("haptic_sculpt/surface/repair.h", "haptic_sculpt/sculpting/decimate.h")

# Parts that tests reach through what is made of them: headers call each member.
parts = {
    "Joint_side": "Interaction", "Pose_side": "Interaction", "Journaled_edits": "Tool",
    "Scene_visitor": "what tells a visitor of edits", "Scene_copy": "Copy_task and Scene_visitor",
    "Changed_faces": "Scene_visitor and Basic_scene_feed", "Basic_scene_feed": "Loop_session",
    "Loop_session": "its tick()", "Outcome": "the functions that give one",
    "Velocity_map": "jacobian and device_motion", "Passivity_limits": "check_limits",
}


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
for header in on_their_own:
    wanted |= free(header)
wanted = {name for name in wanted if name.split("::")[-1] not in without_coordinates or "::" in name}

missing = sorted(wanted - listed)
unknown = sorted(name for name in listed - wanted if "::" in name)
for name in missing:
    print(f"{name} is in no list of test/sculpting/public_functions: add a call of it")
for name in unknown:
    print(f"{name} is listed, but is no public function any more")
print(f"{len(wanted)} public functions, {len(missing)} not listed")

headers = {h: without_comments(h.read_text()) for h in sorted(include.rglob("*.h"))}
folders = ("device", "haptic_rendering")
api = Api([h for h in headers if h.relative_to(include / "haptic_sculpt").parts[0] in folders])
files = [file for name in folders for file in sorted((root / "test" / name).rglob("*.cpp"))]
tests = [with_included(file, root / "test") for file in files]
for test in tests:
    api.learn_aliases(test)
untested = []
for name in sorted(name for name in api.wanted if not api.is_called(name, tests)):
    owner, function = api.wanted[name], name.split("::")[-1]
    uses = sum(len(re.findall(rf"\b{function}\b", text)) for text in headers.values())
    if owner not in parts or uses < 2: # it stands once where it is defined
        untested.append(name)
        print(f"{name} is called in no test of {' or '.join('test/' + name for name in folders)}: add one")
print(f"{len(api.wanted)} public functions of device and loop, {len(untested)} not called in a test")
sys.exit(bool(missing or unknown or untested or len(wanted) < 40 or len(api.wanted) < 300))
