#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A filter for Doxygen, which does not know the names that headings of Markdown have on the web (`page.md#a-heading`): gives
every heading a label, and makes links lead to it. Usage: doxygen_links.py PAGE.md"""
import os
import re
import sys

page = os.path.splitext(os.path.basename(sys.argv[1]))[0].lower()


def name_of(heading):
    """As the web makes it of a heading: letters, digits, and hyphens for blanks."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def label(of, name):
    return f"{of}-{name}".replace("_", "-")


def link(match):
    of = os.path.splitext(os.path.basename(match.group(1)))[0].lower() or page
    return f"](@ref {label(of, match.group(2))})"


with open(sys.argv[1]) as file:
    is_code = False
    for line in file:
        is_code ^= line.startswith("```")
        heading = None if is_code else re.fullmatch(r"(##+) (.*)\n", line)
        if heading:
            line = f"{heading[1]} {heading[2]} {{#{label(page, name_of(heading[2]))}}}\n"
        elif not is_code:
            line = re.sub(r"\]\(([\w./]*)#([\w-]+)\)", link, line)
        sys.stdout.write(line)
