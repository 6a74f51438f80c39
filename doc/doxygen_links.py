#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A filter for Doxygen, whose Markdown is not that of the web: doxygen_links.py PAGE.md

- Headings get the names that they have on the web (`page.md#a-heading`), and links lead to them.
- The text of a link stands on one line, without code: else Doxygen 1.9 prints what follows as it stands.
- Titles are without code, which the tree of pages would print as it stands.
- The pages that the manual links to stand below it in the tree.
- Pictures are named as Doxygen copies them, tutorials as its pages of examples (tutorials.dox); links to what is no page are text.
"""
import os
import re
import sys

folder = os.path.dirname(os.path.abspath(sys.argv[1]))


def of_page(path):
    """Folder and name, for pages of one name may stand in two folders."""
    return "-".join(os.path.splitext(os.path.normpath(os.path.join(folder, path)))[0].lower().split(os.sep)[-2:])


page = of_page(os.path.basename(sys.argv[1]))
below = set()  # the manual


def name_of(heading):
    """As the web makes it of a heading: letters, digits, and hyphens for blanks."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def label(of, name):
    return f"{of}-{name}".replace("_", "-")


def heading(match):
    return f"{match[1]} {match[2]} {{#{label(page, name_of(match[2]))}}}"


def link(match):
    is_picture, text, target = match.groups()
    lines = text.count("\n")
    if page.endswith("manual") and target.endswith(".md") and target not in below:
        below.add(target)
        number_of_page = re.sub(r"\W", "_", os.path.splitext(os.path.relpath(os.path.join(folder, target)))[0])
        return f'@subpage md_{number_of_page} "{" ".join(text.replace("`", "").split())}"' + "\n" * lines
    text = " ".join(text.replace("`", "").split())
    path, _, name = target.partition("#")
    if is_picture:
        target = os.path.basename(path)
    elif name and not path.startswith("http"):
        of = of_page(path) if path else page
        target = f"@ref {label(of, name)}"
    elif path.startswith("examples/tutorials/"):
        target = os.path.basename(path).replace(".", "_8") + "-example.html"
    elif not path.endswith(".md") and not path.startswith("http"):
        return text + "\n" * lines
    return f"{is_picture}[{text}]({target})" + "\n" * lines


with open(sys.argv[1]) as file:
    parts = re.split(r"(^```.*?^```$)", file.read(), flags=re.M | re.S)
for part in parts:
    if not part.startswith("```"):
        part = re.sub(r"^# .*$", lambda title: title[0].replace("`", ""), part, flags=re.M)
        part = re.sub(r"^(##+) (.*)$", heading, part, flags=re.M)
        part = re.sub(r"(!?)\[([^\[\]]+)\]\(([^\s()]+)\)", link, part)
    sys.stdout.write(part)
