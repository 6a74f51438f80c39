#!/usr/bin/env python3
"""check_layers.py SOURCE: the folders of include/haptic_sculpt include each other in one direction only, and so do those
of examples; what the 1997 paper has is included by nobody else; no example names what is internal, and no line of C++
is wider than 120 columns.

A folder and the one around it may include each other: public names stand at a module's root, what serves them stands below.
Between all other folders the includes form no cycle. Exit code 1 names each folder of a cycle, with the includes that close it.
"""
import pathlib
import re
import sys

MOST_COLUMNS = 120
OF_1997 = re.compile(r"sculpting/paper_1997(\.h|/.*)")  # who compares with it asks for it
INCLUDE = re.compile(r"#include <haptic_sculpt/([^>]+)>")
INCLUDE_OF_EXAMPLES = re.compile(r'#include "([^"]+)"')


def includes_between_folders(root):
    """{(folder, folder included): ["header -> header", ...]}, without pairs of which one holds the other."""
    found = {}
    for header in sorted(root.rglob("*.h")):
        folder = header.parent.relative_to(root)
        for name in INCLUDE.findall(header.read_text()):
            target = pathlib.PurePosixPath(name)
            if not (root / target).is_file():
                raise SystemExit(f"{header}: there is no <haptic_sculpt/{name}>")
            other = pathlib.Path(target.parent)
            if other != folder and other not in folder.parents and folder not in other.parents:
                found.setdefault((folder, other), []).append(f"{header.relative_to(root)} -> {name}")
    return found


def includes_of_1997(root):
    """["header -> header", ...] from outside of it"""
    found = []
    for header in sorted(root.rglob("*.h")):
        name = header.relative_to(root).as_posix()
        if not OF_1997.fullmatch(name):
            found += [f"{name} -> {other}" for other in INCLUDE.findall(header.read_text()) if OF_1997.fullmatch(other)]
    return found


def includes_between_examples(root):
    """The same of the sources of examples, which name each other from where they stand, or from `root`."""
    found = {}
    for file in sorted([*root.rglob("*.h"), *root.rglob("*.cpp")]):
        for name in INCLUDE_OF_EXAMPLES.findall(file.read_text()):
            target = next((t.resolve() for t in (file.parent / name, root / name) if t.is_file()), None)
            if target is None:
                raise SystemExit(f'{file}: there is no "{name}"')
            folder, other = file.parent.relative_to(root), target.parent.relative_to(root.resolve())
            if other != folder and other not in folder.parents and folder not in other.parents:
                found.setdefault((folder, other), []).append(f"{file.relative_to(root)} -> {name}")
    return found


def cycle_among(edges):
    """The edges that are left when folders that nobody includes, or that include nobody, are taken away again and again."""
    left = set(edges)
    while True:
        sources, targets = {a for a, _ in left}, {b for _, b in left}
        kept = {(a, b) for a, b in left if a in targets and b in sources}
        if kept == left:
            return left
        left = kept


def internals_in_examples(root):
    """["file: line", ...]"""
    found = []
    for file in sorted([*root.rglob("*.h"), *root.rglob("*.cpp")]):
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if re.search(r"\binternal::", line):
                found.append(f"{file.relative_to(root)}:{number}: {line.strip()}")
    return found


def wide_lines(root):
    """["file: line: columns", ...]"""
    found = []
    for folder in ("include", "examples", "test", "benchmark"):
        for file in sorted([*(root / folder).rglob("*.h"), *(root / folder).rglob("*.cpp")]):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                if len(line) > MOST_COLUMNS:
                    found.append(f"{file.relative_to(root)}:{number}: {len(line)} columns")
    return found


def main(source):
    edges = includes_between_folders(pathlib.Path(source) / "include" / "haptic_sculpt")
    of_examples = includes_between_examples(pathlib.Path(source) / "examples")
    if not edges or not of_examples:
        raise SystemExit(f"{source}: no headers found")
    cycle = cycle_among(edges) | cycle_among(of_examples)
    edges.update(of_examples)
    for a, b in sorted(cycle):
        print(f"{a} includes {b}:", *edges[a, b][:4], sep="\n  ")
    print(f"{len(edges)} pairs of folders, {len(cycle)} of them in a cycle")
    named = internals_in_examples(pathlib.Path(source) / "examples")
    if named:
        print("examples name what is internal; make it public, or do without:", *named, sep="\n  ")
    wide = wide_lines(pathlib.Path(source))
    if wide:
        print(f"wider than {MOST_COLUMNS} columns; clang-format breaks them:", *wide, sep="\n  ")
    of_1997 = includes_of_1997(pathlib.Path(source) / "include" / "haptic_sculpt")
    if of_1997:
        print("what the 1997 paper has is in no umbrella; who wants it includes it:", *of_1997, sep="\n  ")
    return 1 if cycle or named or wide or of_1997 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
