# SPDX-License-Identifier: GPL-3.0-or-later
"""Which public functions of a folder of headers no test of some folders calls by name."""
import re


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def without_bodies(text):
    """What stands in no braces, and the braces' own ends."""
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


def signatures(text):
    """{name: what stands up to the body}: of what has a name before a parenthesis and begins a function."""
    found = {}
    for statement in re.split(r"[;}]|\{", without_bodies(re.sub(r"#[^\n]*", "", text))):
        statement = re.sub(r"static_assert\s*\(.*", "", statement, flags=re.S)
        plain = re.sub(r"template\s*<[^()]*?>\s*(?=\w)", "", statement)
        if match := re.search(r"(?:^|[\s&*>~])([A-Za-z]\w*)\s*\(", plain):
            if not re.search(r"\bfriend\b|\boperator\b|\b(if|for|while|return)\b|= *delete", statement):
                found[match[1]] = found.get(match[1], "") + statement
    return found


def functions(text):
    """Names of functions in what has no bodies any more."""
    return set(signatures(text))


def outside_of_internal(text):
    """What stands in namespace haptic_sculpt and in no namespace within."""
    out = ""
    text = re.sub(r"^#[^\n]*", "", without_comments(text), flags=re.M)
    for part in re.finditer(r"namespace haptic_sculpt \{", text):
        body = block_after(text, part.start())
        while inner := re.search(r"namespace \w+ \{", body):
            length = len(block_after(body, inner.start()))
            body = body[:inner.start()] + body[inner.end() + length + 1:]
        out += body
    return out


def classes(body):
    """(name, bases, what is public in it) of each class and struct that is in no other."""
    head = re.compile(r"\b(?<!enum )(class|struct)\s+(?:\[\[nodiscard\]\]\s+)?(\w+)(?:\s+final)?\s*(:[^;{()]*)?\{")
    for match in head.finditer(body):
        before = body[:match.start()]
        if before.count("{") != before.count("}"):
            continue
        parts = re.split(r"\b(public|private|protected):", block_after(body, match.start()))
        public = parts[0] if match[1] == "struct" else ""
        public += "".join(text for word, text in zip(parts[1::2], parts[2::2]) if word == "public")
        yield match[2], re.findall(r"(\w+)(?:<[^>]*>)?\s*(?:,|$)", match[3] or ""), public


def with_included(file, root, seen=None):
    """The text of a test, and of the headers of tests that it includes."""
    seen = set() if seen is None else seen
    if file in seen or not file.is_file():
        return ""
    seen.add(file)
    text = file.read_text()
    included = re.findall(r'#include "([^"]+)"', text)
    return without_comments(text) + "".join(with_included(root / name, root, seen) for name in included)


class Api:
    """The public functions of headers: `wanted` holds names, those of members as Class::name."""

    def __init__(self, headers):
        self.wanted, self.leads_to = {}, {}
        for header in headers:
            body = outside_of_internal(header.read_text())
            self.learn_aliases(body)
            for name, signature in signatures(body).items():
                self.wanted[name] = None
                self._leads(name, signature)
            for name, bases, public in classes(body):
                for base in bases:
                    self.leads_to.setdefault(base, set()).add(name)
                for member, signature in signatures(public).items():
                    if not member.endswith("_") and len(member) > 1: # S(1), and what is initialised in parentheses
                        self.wanted[f"{name}::{member}"] = name
                    self._leads(name, signature)

    def learn_aliases(self, text):
        for alias, meaning in re.findall(r"\busing (\w+) = ([^;]+);", text):
            self._leads(alias, meaning)

    def _leads(self, name, signature):
        """Who names it may hold each class of its signature."""
        for word in set(re.findall(r"\b[A-Z]\w+", signature)):
            self.leads_to.setdefault(word, set()).add(name)

    def is_called(self, name, tests):
        """In a test that names its class, one derived from it, or a function or class that has to do with it."""
        owner, function = self.wanted[name], name.split("::")[-1]
        if owner is None:
            return any(re.search(rf"\b{function}\s*(<[^;()]*>)?\(", test) for test in tests)
        ways = "|".join(sorted({owner} | self.leads_to.get(owner, set())))
        if function == owner: # a constructor: of an object, or of a class derived from it
            return any(re.search(rf"\b({ways})\b(<[^;(){{]*>)?\s*(\w+\s*)?[({{]", test) for test in tests)
        call = re.compile(rf"(\.|->|::)\s*(template )?{function}\s*(<[^;()]*>)?\(")
        return any(call.search(test) and re.search(rf"\b({ways})\b", test) for test in tests)
