#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What README and manual show as code is compiled, and what they show as commands exists: check_code_blocks.py ROOT BUILD

A block of C++ is lines, one after another, of a file that is compiled; blanks do not count, and a line `// ...` stands for
lines left out. In a block of commands, scripts, programs, options, environment variables and names of tests are looked up;
the options of a program, in its --help, where it has been built."""
import pathlib
import re
import shlex
import subprocess
import sys

root, build = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
pages = [root / "README.md", *sorted((root / "doc").rglob("*.md"))]
faults, counts = [], {"C++": 0, "commands": 0, "options": 0}


def blocks(page):
    """Language, number of the first line, lines."""
    language, lines = None, []
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if line.startswith("```"):
            if language is not None:
                yield language, number - len(lines), lines
                language = None
            else:
                language, lines = line[3:].strip(), []
        elif language is not None:
            lines.append(line)


def plain(lines):
    return [" ".join(line.split()) for line in lines if line.strip()]


def lists():
    """Every CMakeLists.txt, by its folder."""
    return {path.parent: path.read_text() for folder in ("", "examples", "test", "benchmark") for path in
            ([root / "CMakeLists.txt"] if folder == "" else (root / folder).rglob("CMakeLists.txt"))}


cmake = lists()


def is_compiled(path):
    """Named in the CMakeLists.txt of its folder or of one above; of headers the public ones are, by a test of their own."""
    if path.suffix == ".h":
        return True
    return any(re.search(rf"\b{re.escape(path.stem)}\b", cmake.get(folder, "")) for folder in path.parents)


sources = {path: plain(path.read_text().splitlines()) for folder, kind in (("examples", "*.cpp"), ("test", "*.cpp"), ("include", "*.h"))
           for path in (root / folder).rglob(kind) if is_compiled(path)}


def holds(source, block):
    pieces = [[]]
    for line in block:
        if line == "// ...":
            pieces.append([])
        else:
            pieces[-1].append(line)
    at = 0
    for piece in pieces:
        found = next((i for i in range(at, len(source) - len(piece) + 1) if source[i:i + len(piece)] == piece), None)
        if found is None:
            return False
        at = found + len(piece)
    return True


helps = {}


def says(program, argument):
    """What a program prints; None where it has not been built."""
    if (program, argument) not in helps:
        path = build / program
        done = subprocess.run([path, argument], capture_output=True, text=True, timeout=60) if path.is_file() else None
        helps[program, argument] = done.stdout + done.stderr if done else None
    return helps[program, argument]


texts = [path.read_text() for folder in ("examples", "test", "benchmark") for kind in ("*.cpp", "*.h", "*.py") for path in (root / folder).rglob(kind)]
PROGRAM = re.compile(r"build[\w-]*/((?:examples|benchmark|test)/[\w/]+)$")


def check_command(words, where):
    while words and re.fullmatch(r"\w+=.*", words[0]):  # of the environment
        name = words.pop(0).split("=")[0]
        if not any(name in text for text in texts):
            faults.append(f"{where}: nothing reads the environment variable {name}")
    if not words:
        return
    counts["commands"] += 1
    for word in words:
        if re.fullmatch(r"(benchmark|test|examples)/[\w/.-]+", word) and not (root / word).exists():
            faults.append(f"{where}: there is no {word}")
    for i, word in enumerate(words):
        if program := PROGRAM.match(word):
            check_program(program[1], words[i + 1:], where)
            return


def check_program(program, words, where):
    name = program.rsplit("/", 1)[1]
    if not any(re.search(rf"\b{re.escape(name)}\b", text) for text in cmake.values()):
        faults.append(f"{where}: no CMakeLists.txt makes {program}")
    for word in words:
        option = re.match(r"\[*(--[a-z][\w-]*[a-z])(?:=(.*))?", word)
        if not option or "..." in word:
            continue
        counts["options"] += 1
        text = says(program, "--help")
        if text is not None and not re.search(rf"(?<![\w-]){re.escape(option[1])}(?![\w-])", text):
            faults.append(f"{where}: {name} --help does not know {option[1]}, or was not built since")
        if option[1] == "--run_test" and (listed := says(program, "--list_content")) is not None:
            for pattern in option[2].strip("'").split(","):
                if not re.search(rf"^\s*{re.escape(pattern.rstrip('*'))}", listed, re.MULTILINE):
                    faults.append(f"{where}: {name} has no test '{pattern}'")


for page in pages:
    for language, number, lines in blocks(page):
        where = f"{page.relative_to(root)}:{number}"
        if language == "cpp":
            counts["C++"] += 1
            if not any(holds(source, plain(lines)) for source in sources.values()):
                faults.append(f"{where}: this C++ is in no file that is compiled")
        elif language in ("sh", "bash", ""):
            if lines and (synopsis := re.match(r"(sculpt|haptic_loop|sculpt_window) ", lines[0])):
                check_program(f"examples/{synopsis[1]}", " ".join(lines).split(), where)
                continue
            for line in lines if language or any(PROGRAM.match(word) for word in " ".join(lines).split()) else []:
                for command in re.split(r"&&|\|", line):
                    check_command(shlex.split(command, comments=True), where)

if counts["C++"] < 5 or counts["commands"] < 20 or counts["options"] < 40:  # then nothing was read, and no fault means nothing
    faults.append(f"of blocks in the manual there were only {counts}")
print("\n".join(faults) or f"all blocks are true: {counts}")
sys.exit(bool(faults))
