#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds files, functions, classes and folders to sizes that a reader can survey.

  sizes.py ROOT             status 1, and a line for each fault, where a rule is broken
  sizes.py ROOT --list      the present numbers, in the form of the tables below
  sizes.py ROOT --planted   plants a fault of each kind, in memory, and wants each to be found

The rules:
  file      at most 400 lines, in C, C++, Python and JavaScript; tests too
  function  at most 60 lines of C++, from its signature to its closing brace; tests too
  class     at most 300 lines of function bodies, in all its files together, and 25 data members;
            the classes of LARGE keep the numbers that stand there and may only shrink
  folder    at most the lines of C++ that TOTAL allows; TOTAL may not be far above the count
"""
import re
import sys
from collections import Counter
from pathlib import Path

FILE, FUNCTION, BODIES, MEMBERS, STEP, SLACK = 400, 60, 300, 25, 500, 1000
# The code of others: the page's libraries, as their makers publish them.
EXEMPT = ("tools/viewer/page/third_party/",)
# Lines of .cpp, .hpp and .h. A rise is an edit here; the message of its commit says what for.
TOTAL = {
    "pdu": 12500,
    "aoim": 12500,
    "deadreckon": 4500,
    "haptics": 41000,
    "src": 56500,
    "tools": 41500,
    "python": 2500,
    "bench": 38000,
    "tests": 145500,
}
# Class -> lines of function bodies, data members.
LARGE = {
    "aoim/Aggregator": (406, 12),
    "aoim/AreaOfInterestManager": (317, 24),
    "aoim/LeaderRole": (363, 26),
    "aoim/Presence": (360, 18),
    "bench/ScaleWords": (0, 29),
    "haptics/BoundingVolumeTree": (309, 6),
    "haptics/ContactSolver": (321, 24),
    "haptics/DeviceMeasurement": (193, 26),
    "haptics/RemoteContact": (348, 30),
    "haptics/SerialSession": (178, 27),
    "haptics/ServoSnapshot": (1, 35),
    "src/ModelLoop": (313, 26),
    "src/NetworkReadLoop": (102, 31),
    "src/PeerThreads": (191, 27),
    "src/RemoteEntities": (455, 21),
    "src/SharedRecords": (305, 12),
    "src/RemoteEntity": (21, 31),
    "tools/Exercise": (304, 17),
    "tools/Listener": (327, 12),
    "tools/ViewStage": (430, 25),
}
FOLDERS = [*TOTAL, "cmake", "docs", "scenes"]
CPP = (".cpp", ".hpp", ".h")
SUFFIXES = (*CPP, ".c", ".py", ".js", ".mjs")

# What a count of braces must not see, and numbers, whose separators look like quotes.
OPAQUE = re.compile(r"""//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\b\d[\w.']*|'(?:\\.|[^'\\\n])*'"""
                    r"""|^[ \t]*\#(?:[^\n\\]|\\.)*""", re.S | re.M)
ACCESS = re.compile(r"\b(?:public|private|protected)\s*:(?!:)")
SCOPE = re.compile(r"^(?:template\s*<.*>\s*)?"
                   r"(?:(?:inline\s+)?namespace\b|extern\b[^(]*$|(class|struct|union)\b(?:[^(]|alignas\()*$)", re.S)
CLASS_NAME = re.compile(r"(?:class|struct|union)\s+(?:\[\[.*?\]\]\s*|alignas\(.*?\)\s*)*(\w+)")
FUNCTION_NAME = re.compile(r"((?:\w+(?:<[^()]*?>)?\s*::\s*)*(?:~?\w+|operator\b[^;{]*?))\s*\(")
NOT_DATA = re.compile(r"^(?:using|typedef|friend|static|enum|struct|class|union|template|explicit|virtual)\b")


def bare(text):
    """The text without comments, strings and directives, with its line ends."""
    def plain(found):
        return ("" if found[0].lstrip()[0] in "/#" else "0") + "\n" * found[0].count("\n")

    return ACCESS.sub(";", OPAQUE.sub(plain, text))


def without_nested(text):
    """The text without what is in angle brackets, parentheses after `alignas`, braces, and initial values."""
    text = re.sub(r"alignas\([^)]*\)|\[\[.*?\]\]", "", text)
    while text != (less := re.sub(r"<[^<>;]*>|\{[^{}]*\}", "", text)):
        text = less
    return re.sub(r"=[^;]*", "", text).strip()


class Parsed:
    """Functions (name, line, lines, body lines, class) and data members by class of one file."""

    def __init__(self, text):
        self.functions, self.members, self.open = [], Counter(), 0
        text = bare(text)
        self.scopes = []
        start, block, kept = 0, 0, 0  # of the statement; depth in a block that is no scope; its begin
        parentheses = 0
        for found in re.finditer(r"[{};()]", text):
            sign, at = found[0], found.start()
            if block:
                block += (sign == "{") - (sign == "}")
                if not block and (end := self.ends(text, start, kept, at, parentheses)):
                    start = end
            elif sign in "()":
                parentheses += 1 if sign == "(" else -1
            elif sign == "{":
                head = text[start:at].strip()
                if not parentheses and (scope := SCOPE.match(head)):
                    self.scopes.append(CLASS_NAME.search(head)[1] if scope[1] and CLASS_NAME.search(head) else None)
                    start = at + 1
                else:
                    block, kept = 1, at
            elif sign == "}":
                self.scopes = self.scopes[:-1]
                start = at + 1
            elif not parentheses:
                self.declared(text[start:at])
                start = at + 1
        self.open = len(self.scopes) + block

    def ends(self, text, start, begin, at, parentheses):
        """Where the next statement starts after the block [begin, at], or None while this one goes on."""
        next_sign = text[at + 1:at + 200].lstrip()[:1]
        head = text[start:begin].strip()
        if parentheses or next_sign in (",", "{", ")"):
            return None
        if next_sign == ";" and "](" not in head.replace(" ", "") or "(" not in head:
            return None if next_sign == ";" else at + 1
        first = begin - len(text[start:begin].lstrip())
        name = FUNCTION_NAME.search(re.sub(r"^template\s*<.*?>\s*(?=\w)", "", head))
        path = re.sub(r"<.*?>|\s", "", name[1]).split("::") if name else ["?"]
        of = next((scope for scope in reversed(self.scopes) if scope), None)
        if len(path) > 1 and path[0]:
            of = path[-2]
        self.functions.append((path[-1], text.count("\n", 0, first) + 1, text.count("\n", first, at) + 1,
                               text.count("\n", begin, at) + 1, of))
        return at + 1

    def declared(self, statement):
        """Counts the data members of a statement directly in a class."""
        if not self.scopes or not self.scopes[-1]:
            return
        plain = without_nested(statement)
        if plain and not NOT_DATA.match(plain) and "(" not in plain and " " in plain:
            self.members[self.scopes[-1]] += 1 + plain.count(",")


def top_of(path):
    return path.split("/")[0]


class Sizes:
    def __init__(self, files):
        self.parsed = {path: parse(text) for path, text in files.items() if path.endswith(CPP)}
        self.lines = {path: text.count("\n") for path, text in files.items()}
        self.totals, self.bodies, self.members = Counter(), Counter(), Counter()
        for path, parsed in self.parsed.items():
            top = top_of(path)
            self.totals[top] += self.lines[path]
            if top != "tests":
                for *_, body, of in parsed.functions:
                    self.bodies[f"{top}/{of}"] += body if of else 0
                for of, count in parsed.members.items():
                    self.members[f"{top}/{of}"] = max(count, self.members[f"{top}/{of}"])

    def large(self):
        """The classes above a bound, as LARGE names them."""
        names = {name for name, count in self.bodies.items() if count > BODIES}
        names |= {name for name, count in self.members.items() if count > MEMBERS}
        return {name: (self.bodies[name], self.members[name]) for name in sorted(names)}


KNOWN = {}


def parse(text):
    if text not in KNOWN:
        KNOWN[text] = Parsed(text)
    return KNOWN[text]


def faults(files, large, total):
    sizes = Sizes(files)
    for path, count in sizes.lines.items():
        if count > FILE:
            yield f"{path}: {count} lines, {FILE} at most: give a concept of it its own file"
    for path, parsed in sizes.parsed.items():
        if parsed.open:
            yield f"{path}: its braces do not match as this test counts them"
        for name, line, count, *_ in parsed.functions:
            if count > FUNCTION:
                yield f"{path}:{line}: {name} has {count} lines, {FUNCTION} at most: cut out a step with a name"
    for name in sorted({*sizes.large(), *large}):
        bodies, members = sizes.bodies[name], sizes.members[name]
        most_bodies, most_members = large.get(name, (BODIES, MEMBERS))
        if bodies > most_bodies or members > most_members:
            yield (f"{name}: {bodies} lines of function bodies and {members} data members, "
                   f"{most_bodies} and {most_members} at most: cut it by concept")
        elif name in large and (bodies, members) != large[name]:
            now = f"({bodies}, {members})" if name in sizes.large() else "no more"
            yield f"{name}: is {large[name]} in LARGE, now {now}: lower it there"
    for top, most in total.items():
        count = sizes.totals[top]
        if count > most:
            yield f"{top}: {count} lines, {most} at most: shorten it, or raise TOTAL and say in the commit what for"
        if most > count + SLACK or most % STEP:
            yield f"{top}: {count} lines, TOTAL says {most}: lower it to {ceiling(count)}"


def ceiling(count):
    return -(-count // STEP) * STEP


def planted(files):
    """Kind of fault -> files, LARGE and TOTAL that have it."""
    def lines(count):
        return "  f();\n" * count

    function = "void {}() {{\n" + lines(FUNCTION - 2) + "}}\n"
    sizes, most = Sizes(files), BODIES // 2
    first = function.format("Planted::f")
    method = "  void f() {\n" + lines(BODIES) + "  }\n"
    half = "void Planted::{}() {{\n" + lines(most) + "}}\n"
    below = {name: (count[0] - 1, count[1]) for name, count in LARGE.items()}
    member = {name: (count[0], count[1] - 1) for name, count in LARGE.items()}
    above = {name: (count[0] + 1, count[1] + 1) for name, count in LARGE.items()}
    short = {top: ceiling(count) - STEP for top, count in sizes.totals.items()}
    high = {top: ceiling(count) + 2 * STEP for top, count in sizes.totals.items()}
    full = {top: ceiling(count) for top, count in sizes.totals.items()}

    def at(path, text):
        return {**files, path: text}, LARGE, full

    yield "a long file", at("tests/planted.py", "\n" * (FILE + 1)), "planted.py"
    yield "a long function", at("tests/planted.cpp", first.replace("}", "  f();\n}")), "planted.cpp:1"
    yield "a long test", at("tests/planted.cpp", "\nTEST(A, B) {\n" + lines(FUNCTION) + "}\n"), "planted.cpp:2"
    yield "a long constructor", at("src/planted.cpp", "A::A(int b)\n    : b_{b}, c_(b) {\n" + lines(FUNCTION) + "}\n"), \
        "planted.cpp:1: A"
    yield "a long lambda", at("src/planted.cpp", "const auto f = [](int a) {\n" + lines(FUNCTION) + "};\n"), "planted.cpp:1"
    yield "a long function in a class", at("src/p.hpp", "class A {\n public:\n" + method + "};\n"), "p.hpp:3: f"
    yield "braces that do not match", at("src/p.hpp", "void f() {\n"), "p.hpp: its braces"
    yield "a large class", at("src/p.hpp", "class Planted {\n" + method + "};\n"), "src/Planted: 302"
    yield "a large class in two files", (
        {**files, "src/p.cpp": half.format("f"), "src/q.cpp": half.format("g")}, LARGE, full), "src/Planted: 304"
    yield "a class of many members", at(
        "src/p.hpp", "class Planted {\n" + "  std::function<int(int)> f_{0};\n" * (MEMBERS + 1) + "};\n"), "src/Planted: 0"
    yield "a class that grew", (files, below, full), "at most: cut it by concept"
    yield "a class that has one member more", (files, member, full), "at most: cut it by concept"
    yield "a class that shrank", (files, above, full), "lower it there"
    yield "a class that is gone", (files, {**LARGE, "src/Gone": (301, 0)}, full), "src/Gone: is (301, 0) in LARGE, now no more"
    yield "a folder that grew", (files, LARGE, short), "raise TOTAL"
    yield "a folder that shrank", (files, LARGE, high), "lower it to"
    yield "a number between the steps", (files, LARGE, {"src": full["src"] + 1}), "lower it to"


def missed_plants(files):
    before = set(faults(files, LARGE, {}))
    for what, (others, large, total), wanted in planted(files):
        if not any(wanted in fault for fault in set(faults(others, large, total)) - before):
            yield f"not found: {what}"


def main(arguments):
    root = Path(arguments[0])
    paths = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*")) if path.suffix in SUFFIXES]
    files = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in paths}
    files = {path: text for path, text in files.items() if not path.startswith(EXEMPT)}
    if "--list" in arguments:
        sizes = Sizes(files)
        print("\n".join(f'    "{top}": {ceiling(sizes.totals[top])},' for top in TOTAL))
        print("\n".join(f'    "{name}": {numbers},' for name, numbers in sizes.large().items()))
        return 0
    found = list(missed_plants(files) if "--planted" in arguments else faults(files, LARGE, TOTAL))
    print("\n".join(found) or f"{len(files)} files")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
