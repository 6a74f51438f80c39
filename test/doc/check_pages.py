#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of the manual are short, their lines too, what they refer to exists, and figures name the command that
makes them: check_pages.py ROOT

Counted as `wc -w` counts. Lines in tables and code may be longer. Links of the HTML are checked by check_reference.py.
"""
import pathlib
import re
import sys

LONGEST_LINE = 100
MOST_WORDS = {"doc/use": 1200, "doc/concepts": 1200, "doc/proofs": 1600, "doc/results": 1800, "doc": 1300}
MOST_IN_ALL = 52200
MOST_IN_SENTENCES = 27300 # outside of tables and code
NOT_PLAIN = r"\b(?:is|are|was|were|be) told\b|\bthe latter\b|\bnone the less\b|\bnonetheless\b"
# What makes a figure: a program that is built, a script, a test by its name.
COMMAND = r"build[\w-]*/(?:benchmark|test|examples)/|\b(?:benchmark|test)/[\w/]+|\btest_\w+|\bpython3 |\bctest |\bcmake |`sculpt_window "
CITES = {"comparison.md", "paper_1997.md"}  # tables of what others say, with their sources
SOURCES = {".h", ".cpp", ".py", ".txt", ".cmake"}


def anchors(page):
    """Of its headings, as GitHub makes them."""
    headings = re.findall(r"^#+ +(.*)$", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"[`*]", "", heading)).strip().lower().replace(" ", "-") for heading in headings}


def faults(page, root):
    text = page.read_text()
    name = page.relative_to(root)
    words, most = len(text.split()), MOST_WORDS[str(name.parent)]
    if words > most:
        yield f"{name}: {words} words, more than {most}: shorten it, or make two pages of it"
    is_code = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            is_code = not is_code
        elif not is_code and not line.startswith("|") and len(line) > LONGEST_LINE and "](" not in line:
            yield f"{name}:{number}: {len(line)} columns, more than {LONGEST_LINE}"
        if not is_code and (phrase := re.search(NOT_PLAIN, line)):
            yield f"{name}:{number}: '{phrase.group()}' is not plain: say who does what"
        for link in [] if is_code else re.findall(r"\]\(([^)\s]+)\)", line):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = (page.parent / path).resolve() if path else page
            if not target.exists():
                yield f"{name}:{number}: there is no {link}"
            elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                yield f"{name}:{number}: {path or name} has no heading '{anchor}'"


def figures_without_command(page, root):
    """Sections of a page of results with a table or a picture, for which neither they nor the page's opening name a command."""
    opening, *sections = re.split(r"^(?=## )", page.read_text(), flags=re.M)
    for section in [opening, *sections]:
        if re.search(r"^\||^!\[", section, re.M) and not re.search(COMMAND, section + opening):
            yield f"{page.relative_to(root)}: '{section.splitlines()[0].lstrip('# ')}' has figures, and no command that makes them"


def words_of_sentences(page):
    """Without tables and code, which are looked up and not read."""
    is_code, words = False, 0
    for line in page.read_text().splitlines():
        is_code ^= line.startswith("```")
        words += 0 if is_code or line.startswith(("|", "```")) else len(line.split())
    return words


def not_plain_in(source, root):
    for number, line in enumerate(source.read_text(errors="replace").splitlines(), 1):
        if phrase := re.search(NOT_PLAIN + r"|\bso many\b", line):
            yield f"{source.relative_to(root)}:{number}: '{phrase.group()}' is not plain"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = sorted((root / "doc").rglob("*.md"))
    found = [fault for page in pages for fault in faults(page, root)]
    found += [fault for page in pages if page.parent.name == "results" and page.name not in CITES for fault in figures_without_command(page, root)]
    found += [fault for folder in ("include", "examples", "test", "benchmark") for source in sorted((root / folder).rglob("*"))
              if source.suffix in SOURCES and source.name != pathlib.Path(__file__).name for fault in not_plain_in(source, root)]
    words, sentences = sum(len(page.read_text().split()) for page in pages), sum(words_of_sentences(page) for page in pages)
    if words > MOST_IN_ALL or sentences > MOST_IN_SENTENCES:
        found.append(f"{words} words in all pages, {sentences} of them in sentences: more than {MOST_IN_ALL} or {MOST_IN_SENTENCES}")
    for fault in found:
        print(fault)
    print(f"pages: {len(pages)}, {words} words, {sentences} of them in sentences, {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
