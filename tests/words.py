#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds comments and names of tests to plain English.

  words.py ROOT             status 1, and a line for each fault, where a rule is broken
  words.py ROOT --list      each sentence that has a mark, with its place
  words.py ROOT --planted   plants a fault of each kind, in memory, and wants each to be found

The rules:
  comment   at most 5 % of the sentences of a room have a mark of MARKS; one is free in a small room
  name      the name of a test has at most 8 words, with capitals or digits as their begins
  word      `told` and `tells` stand at most WORDS times in product code
The marks are a floor. CONTRIBUTING.md says how sentences are written.
"""
import re
import sys
from collections import Counter, defaultdict
from pathlib import Path

SHARE, NAME, WORDS = 0.05, 8, 40
PRODUCT = ("pdu", "aoim", "deadreckon", "haptics", "src", "tools", "python")
FOLDERS = (*PRODUCT, "bench", "tests")
RELATIVE = r"\b(who|whom|whose|which|what)\b"
MARKS = [re.compile(mark, re.IGNORECASE) for mark in (
    rf"{RELATIVE}[^.;:]{{0,80}}{RELATIVE}[^.;:]{{0,80}}\b(who|whom|whose|which|that|what)\b",
    r"\b(told|tells?|telling|said|says?|saying)\b",
    r"\b(hears?|heard|hearing)\b",
    r"\b(who|whom|whoever)\b",
    r"\b(that of|those of|of such|of these|those that|what it|what others|what is)\b",
    r"\b(goes by|go by|is by|stands? (in|at|for|still)|lies|lets go|let go|in the place of|at the most|anew|likewise)\b")]
TEST = re.compile(r"\b(?:TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P)\(\s*(\w+)\s*,\s*(\w+)\s*\)")


def blocks(text):
    """(line, comment) of each comment of C++; lines that follow each other are one."""
    block, begin = [], 0
    for number, line in enumerate(text.split("\n"), 1):
        whole = re.match(r"\s*//[/!]?<?\s?(.*)", line)
        if whole and "SPDX" not in line:
            begin = begin if block else number
            block.append(whole[1])
            continue
        if block:
            yield begin, " ".join(block)
        block = []
        if behind := re.search(r"\S\s+///?<?\s(.*)$", line):
            yield number, behind[1]


def sentences(text):
    for line, block in blocks(text):
        for sentence in re.split(r"(?<=[.;:?!])\s+", block):
            if len(sentence.split()) >= 4:
                yield line, sentence


def is_marked(sentence):
    return any(mark.search(sentence) for mark in MARKS)


def words_of(name):
    return len(re.findall(r"[A-Z][a-z0-9]*|[a-z0-9]+", name))


def faults(files):
    rooms, marked, product = Counter(), Counter(), 0
    for path, text in files.items():
        room = path.rpartition("/")[0]
        for _, sentence in sentences(text):
            rooms[room] += 1
            marked[room] += is_marked(sentence)
        if path.startswith(PRODUCT):
            product += len(re.findall(r"\b(told|tells)\b", text, re.IGNORECASE))
        if path.startswith("tests/"):
            for test in TEST.finditer(text):
                if words_of(test[2]) > NAME:
                    yield f"{path}: {test[1]}.{test[2]} has {words_of(test[2])} words, {NAME} at most"
    for room, count in sorted(marked.items()):
        if count > max(1, SHARE * rooms[room]):
            yield f"{room}: {count} of {rooms[room]} sentences of comments have a mark, 5 % at most: words.py ROOT --list"
    if product > WORDS:
        yield f"told and tells stand {product} times in product code, {WORDS} at most"


def planted(files):
    room = defaultdict(int)
    for path, text in files.items():
        room[path.rpartition("/")[0]] += sum(1 for _ in sentences(text))
    many = "".join("// The value that it was told last.\n\n" for _ in range(2 + room["src/clocks"] // 10))
    yield "sentences with marks", {"src/clocks/planted.hpp": many}, "src/clocks: "
    yield "marks behind members", {"src/planted/p.hpp": "int a;  ///< what is heard of others here\n" * 2}, "src/planted: 2"
    yield "a long name", {"tests/p.cpp": "TEST(A, OneTwoThreeFourFiveSixSevenEight9Ten) {"}, "tests/p.cpp: A.One"
    yield "a name over two lines", {"tests/p.cpp": "TEST_F(A,\n  OneTwoThreeFourFiveSixSevenEightNine) {"}, "tests/p.cpp: A.One"
    yield "words in code", {"src/p.cpp": "int told;\n" * WORDS + "int tells;\n" * WORDS}, "told and tells stand"


def missed_plants(files):
    before = set(faults(files))
    for what, more, wanted in planted(files):
        if not any(wanted in fault for fault in set(faults({**files, **more})) - before):
            yield f"not found: {what}"


def main(arguments):
    root = Path(arguments[0])
    paths = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*")) if path.suffix in (".cpp", ".hpp", ".h")]
    files = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in paths}
    if "--list" in arguments:
        for path, text in files.items():
            for line, sentence in sentences(text):
                if is_marked(sentence):
                    print(f"{path}:{line}: {sentence}")
        return 0
    found = list(missed_plants(files) if "--planted" in arguments else faults(files))
    print("\n".join(found) or f"{len(files)} files")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
