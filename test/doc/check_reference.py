#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference has no warnings, no undocumented name, and nothing internal: check_reference.py ROOT"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77

root = pathlib.Path(sys.argv[1])
if shutil.which("doxygen") is None:
    print("reference: doxygen is not installed, so the reference is not checked; bash .ci/install_packages installs it")
    sys.exit(SKIPPED)

with tempfile.TemporaryDirectory() as folder:
    def warnings_of(options, files="include|doc/concepts"):
        settings = (root / "doc" / "Doxyfile").read_text() + f"\nOUTPUT_DIRECTORY = {folder}\n{options}\n"
        run = subprocess.run(["doxygen", "-"], input=settings, cwd=root, capture_output=True, text=True, check=True)
        return [line for line in run.stderr.splitlines() if re.search(rf"/({files})/?.*: (warning|error):", line)]

    faults = warnings_of("INPUT = include doc/concepts\nUSE_MDFILE_AS_MAINPAGE =\nGENERATE_XML = YES")
    listed = pathlib.Path(folder, "xml", "index.xml").read_text()
    names = re.findall(r'<compound [^>]*kind="(?:class|struct|concept|namespace)"><name>([^<]*)</name>', listed)
    faults += [f"internal, but in the reference: {name}" for name in names if "internal" in name.split("::")]
    for name in ("haptic_sculpt::Sculptor", "haptic_sculpt::Swept_collision_traits_3", "SweptCollisionTraits_3"):
        if name not in names:  # then nothing was read, and no warning means nothing
            faults.append(f"not in the reference: {name}")
    faults += warnings_of("", r"doc/\w+\.md|README\.md")  # links of pages that lead nowhere

for fault in faults:
    print(fault)
print(f"reference: {len(names)} classes, structs and namespaces, {len(faults)} faults")
sys.exit(1 if faults else 0)
