#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""No class grows beyond what one can hold in mind, in however many files its functions lie.

  class_sizes.py ROOT             status 1, and a line for each class whose function bodies have more lines than MOST
  class_sizes.py ROOT --list      the largest, with their sizes
  class_sizes.py ROOT --planted   adds bodies to classes, in memory, and wants each to be found

Counted are the lines of function bodies, in sources and in the class itself.
"""
import re
import sys
from collections import Counter
from pathlib import Path

FOLDERS = ["pdu", "deadreckon", "aoim", "haptics", "src", "tools", "bench"]
MOST = 400
OUTSIDE = re.compile(r"^(?![ \t}/#])[^;={]*?\b([A-Z]\w*)(?:<[^>]*>)?::(?:\w+::)*~?(?:\w+|operator\W+)\([^;]*$", re.M)
CLASS = re.compile(r"^(?:template <.*>\n)?(?:class|struct) (\w+)\b[^;{]*\{", re.M)
INSIDE = re.compile(r"^  (?! )[^;={}#/]*\)[^;={}]*\{\n", re.M)


def outside_bodies(text):
    """(class, lines) of each function that is defined at the left margin."""
    for found in OUTSIDE.finditer(text):
        begin = text.find("{", found.start(1))
        end = text.find("\n}", found.start(1))
        if begin < 0 or end < 0 or begin > end:
            continue
        yield found[1], text.count("\n", begin, end) + 1


def inside_bodies(text):
    for found in CLASS.finditer(text):
        body = text[found.end():text.find("\n};", found.end())]
        for function in INSIDE.finditer(body):
            end = body.find("\n  }", function.end() - 1)
            if end > 0:
                yield found[1], body.count("\n", function.end() - 1, end) + 1


def sizes(files):
    """Lines of function bodies by top folder and class."""
    lines = Counter()
    for path, text in files.items():
        top = path.split("/")[0]
        for name, count in [*outside_bodies(text), *inside_bodies(text)]:
            lines[f"{top}/{name}"] += count
    return lines


def faults(files):
    lines = sizes(files)
    for name, count in sorted(lines.items()):
        if count > MOST:
            yield f"{name}: {count} lines of function bodies, {MOST} at most: cut it by concept"


def missed_plants(files):
    body = "void {}::planted() {{\n" + "  f();\n" * (MOST + 1) + "}}\n"
    header = "class Planted {\n  void planted() {\n" + "    f();\n" * (MOST + 1) + "  }\n};\n"
    halves = "void Planted::one() {\n" + "  f();\n" * (MOST // 2 + 1) + "}\n"
    for what, more in {
        "a long body": {"src/planted.cpp": body.format("Planted")},
        "a long body in the class": {"src/planted.hpp": header},
        "two files": {"src/planted_1.cpp": halves, "src/planted_2.cpp": halves},
    }.items():
        if not list(faults({**files, **more})):
            yield f"not found: {what}"


def main(arguments):
    root = Path(arguments[0])
    files = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
             for folder in FOLDERS for path in sorted((root / folder).rglob("*.?pp"))}
    if "--list" in arguments:
        print("\n".join(f"{count:5} {name}" for name, count in sizes(files).most_common(20)))
        return 0
    found = list(missed_plants(files) if "--planted" in arguments else faults(files))
    print("\n".join(found) or f"{len(sizes(files))} classes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
