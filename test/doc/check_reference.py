#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference has no warnings, no undocumented name, and nothing internal, not in a public signature either, and in its HTML every picture and every link within it
exists: check_reference.py ROOT"""
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse
import xml.etree.ElementTree

SKIPPED = 77

root = pathlib.Path(sys.argv[1])


class Page(html.parser.HTMLParser):
    """What a page refers to, and what in it can be referred to."""

    def __init__(self, text):
        super().__init__()
        self.links, self.pictures, self.names = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names.update(values[key] for key in ("id", "name") if values.get(key))
        if tag == "img" and values.get("src"):
            self.pictures.append(values["src"])
        elif tag == "a" and values.get("href"):
            self.links.append(values["href"])


def broken_links(folder):
    """Links to `#nested-classes` are Doxygen's own, of classes whose nested ones are all private."""
    pages = {path.resolve(): Page(path.read_text()) for path in folder.rglob("*.html")}
    broken, pictures = [], 0
    for path, page in pages.items():
        pictures += sum(not picture.endswith("doxygen.svg") for picture in page.pictures)
        for link in page.links + page.pictures:
            parts = urllib.parse.urlparse(link)
            if parts.scheme or parts.netloc or parts.fragment == "nested-classes":
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            name = urllib.parse.unquote(parts.fragment)
            if not target.exists() or (name and target in pages and name not in pages[target].names):
                broken.append(f"{path.name}: nothing is at '{link}'")
    for path in folder.glob("md_*.html"):  # what Doxygen could not read stands in the page as it is
        broken += [f"{path.name}: {line}" for line in path.read_text().splitlines() if re.match(r"@\w+section|@code", line)]
    return sorted(set(broken)), len(pages), pictures


def internal_in_signatures(folder):
    """Public functions and members whose type, parameters or template parameters name what is internal."""
    faults = []
    for path in folder.glob("*.xml"):
        for compound in xml.etree.ElementTree.parse(path).getroot().findall("compounddef"):
            if compound.get("kind") in ("file", "dir", "page"):  # they list what stands in a class or namespace already
                continue
            for member in compound.iter("memberdef"):
                parts = [member.find("type"), member.find("argsstring"), member.find("templateparamlist")]
                signature = " ".join("".join(part.itertext()) for part in parts if part is not None)
                if member.get("prot") == "public" and member.get("kind") != "friend" and "internal::" in signature:
                    faults.append(f"{compound.findtext('compoundname')}::{member.findtext('name')}: internal in a public signature: {signature}")
    return sorted(faults)


if shutil.which("doxygen") is None:
    print("skipped: the reference, because doxygen is not installed; bash .ci/install_packages installs it")
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
    faults += internal_in_signatures(pathlib.Path(folder, "xml"))
    faults += warnings_of("", r"doc/[\w/]+\.md|README\.md")  # links of pages that lead nowhere
    broken, pages, pictures = broken_links(pathlib.Path(folder, "html"))
    faults += broken
    in_source = sum(len(re.findall(r"!\[[^\]]*\]\(", page.read_text())) for page in [*root.glob("doc/**/*.md"), root / "README.md"])
    if pictures < in_source:
        faults.append(f"{pictures} pictures in the HTML, {in_source} in the pages it is made from")

for fault in faults:
    print(fault)
print(f"reference: {len(names)} classes, structs and namespaces, {pages} pages with {pictures} pictures, {len(faults)} faults")
sys.exit(1 if faults else 0)
