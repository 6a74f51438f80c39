#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A filter for Doxygen that puts what a header has into a topic of topics.dox, by its place: doxygen_topics.py HEADER.h"""
import pathlib
import re
import sys

MANY = ("many_vertices/", "axis_moves/", "brushes", "move_", "Move_", "Rigid_", "apply_guarded", "guarded_point_map", "Allow_embedded",
        "isotropic_remeshing", "Remeshing_", "decimate")
EDITS = ("edits/", "Edit", "Applied", "Stroke", "History_", "Property_origin", "Unfinished_change", "Reentrant_call")
FILES = ("io/", "read_surface", "write_surface", "Write_error", "Mesh_file_format")


def topic(path):
    """Of a path below include/haptic_sculpt."""
    folder, _, rest = path.partition("/")
    if folder == "surface":
        return ("files" if rest.startswith(FILES) else "repair" if rest.startswith(("repair", "orient")) else
                "broad_phases" if rest.startswith("broad_phase/") else "validity")
    if folder == "sculpting":
        return ("many_vertices" if rest.startswith(MANY) else "edits" if rest.startswith(EDITS) else
                "broad_phases" if rest.startswith("paper_1997/") else "drags")
    if folder == "haptic_rendering":
        return "talking" if rest.startswith("exchange/") else "loop"
    return {"collision": "sweeps", "device": "device"}.get(folder, "errors")


path = pathlib.Path(sys.argv[1])
text = path.read_text()
if path.parent.name == "concepts":
    text = re.sub(r"\nclass ", r"\n/// \\ingroup concepts\nclass ", text, count=1)
elif "haptic_sculpt/" in path.as_posix():
    begin = f"/** \\addtogroup {topic(path.as_posix().split('haptic_sculpt/')[-1])} */ /** @{{ */"
    text = re.sub(r"^namespace haptic_sculpt \{$", lambda m: f"{m[0]} {begin}", text, flags=re.M)
    text = re.sub(r"^\} // namespace haptic_sculpt$", lambda m: f"/** @}} */ {m[0]}", text, flags=re.M)
sys.stdout.write(text)
