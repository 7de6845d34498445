#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that each test that the pages quote exists: README.md, the other pages beside it, docs/ and scenes/.

  quoted_tests.py ROOT            status 1, and a line for each fault, where a quoted test does not exist
  quoted_tests.py ROOT --planted  plants a fault of each kind, in memory, and wants each to be found

What counts as a quote, and what has to exist:
  filter   each part of `PROGRAM --gtest_filter=PART:PART`: a test of that program
  pattern  `ctest -R PATTERN`, `run test -R PATTERN`: a test of ctest; of PATTERN, what is before the first `.*`
  name     `Suite.Name` in backquotes: a test of any program
The tests are read from the macros of GoogleTest and from CMakeLists.txt, so nothing is built."""
import fnmatch
import re
import sys
from pathlib import Path

TEST = re.compile(r"\b(TYPED_TEST_P|TYPED_TEST|TEST_P|TEST_F|TEST)\(\s*(\w+)\s*,\s*(\w+)\s*\)")
INSTANCE = re.compile(r"\bINSTANTIATE_(?:TYPED_)?TEST_SUITE_P\(\s*(\w+)\s*,\s*(\w+)")
FILTER = re.compile(r"(?:(\w+) )?--gtest_filter=(?:'([^']*)'|([^\s`']*))")
PATTERN = re.compile(r"\b(?:ctest|run test)\b[^`\n|]*? -R (?:'([^']+)'|([^\s`']+))")
NAME = re.compile(r"`(\*?[A-Z]\w+\.[A-Z*][\w*]*)`")


def programs(files):
    """Program of GoogleTest -> the files that may hold its tests; headers serve all programs of their folder."""
    found = {}
    for path, text in files.items():
        folder = path.rpartition("/")[0]
        for name, body in re.findall(r"^ *(?:reckon_test|reckon_vm_tests|add_executable)\((\w+_tests)([^)]*)\)", text, re.M):
            headers = [other for other in files if other.startswith(folder) and other.endswith(".hpp")]
            found[name] = [f"{folder}/{source}" for source in re.findall(r"[\w/]+\.cpp", body)] + headers
    return found


def tests_of(texts):
    """Names of tests as --gtest_filter matches them; 0 stands for the name of a parameter."""
    whole = "\n".join(texts)
    prefixes = {}
    for prefix, suite in INSTANCE.findall(whole):
        prefixes.setdefault(suite, []).append(prefix)
    for macro, suite, name in TEST.findall(whole):
        typed = "/0" if macro.startswith("TYPED") else ""
        behind = "/0" if macro == "TEST_P" else ""
        for prefix in prefixes.get(suite, []) if macro.endswith("_P") else [""]:
            yield f"{prefix}/{suite}{typed}.{name}{behind}".lstrip("/")


def names_of_ctest(files, tests):
    """Names of tests of ctest; each word of a CMakeLists.txt may be the value of its variables."""
    for program, names in tests.items():
        yield from {f"{program}.{name.partition('.')[0]}" for name in names}
    for path, text in files.items():
        if path.endswith("CMakeLists.txt"):
            for name in re.findall(r"reckon_check\((\S+)", text):
                words = set(re.findall(r"\w+", text)) if "${" in name else [""]
                yield from (re.sub(r"\$\{\w+\}", word, name) for word in words)


def faults(pages, files):
    tests = {program: set(tests_of(files[path] for path in paths if path in files)) for program, paths in programs(files).items()}
    ctest = set(names_of_ctest(files, tests))
    every = {name.replace("/0", "").rpartition("/")[2] for names in tests.values() for name in names}
    for path, page in pages.items():
        for program, quoted, bare in FILTER.findall(page):
            if program and program not in tests:
                yield f"{path}: there is no program {program}"
                continue
            known = tests[program] if program else set().union(*tests.values())
            for part in filter(None, (quoted or bare).split(":")):
                if not fnmatch.filter(known, part):
                    yield f"{path}: --gtest_filter={part} matches no test of {program or 'any program'}"
        for quoted, bare in PATTERN.findall(page):
            pattern = (quoted or bare).partition(".*")[0]
            if not any(re.search(pattern, name) for name in ctest):
                yield f"{path}: -R {quoted or bare} matches no test of ctest"
        for name in NAME.findall(page):
            if not fnmatch.filter(every, name):
                yield f"{path}: there is no test {name}"


PLANTED = [
    ("`haptics_tests --gtest_filter='EnergyLiar.*:NoSuite.*'`", "--gtest_filter=NoSuite.*"),
    ("`haptics_tests --gtest_filter=Energyliar.*`", "--gtest_filter=Energyliar.*"),
    ("`RECKON_SOAK=1 build/release/tests/aoim/aoim_tests --gtest_filter='EnergyLiar.*'`", "--gtest_filter=EnergyLiar.*"),
    ("`haptic_tests --gtest_filter='EnergyLiar.*'`", "there is no program haptic_tests"),
    ("`integration_tests --gtest_filter='Liars.*'`", "--gtest_filter=Liars.*"),  # Seeds/Liars.
    ("```sh\nctest --test-dir build/release -R 'EveryPud.*fire'\n```", "-R EveryPud.*fire"),
    ("`ctest -R namespaces.nowhere`", "-R namespaces.nowhere"),
    ("```sh\n./run test -R aiom    # a part\n```", "-R aiom"),
    ("| `EnergyLiar.WhoMoves*` |", "no test EnergyLiar.WhoMoves*"),
    ("`aoim_tests --gtest_filter='*Relays*'`, `ctest -R namespaces.crowd`, `./run test -R aoim`, `Liars.*`, `EveryPdu.*`, "
     "`Federate::step`, `ctest -R 'EveryPdu.*fire'`", None),
]


def missed_plants(pages, files):
    before = set(faults(pages, files))
    for plant, wanted in PLANTED:
        new = set(faults({**pages, "docs/planted.md": plant}, files)) - before
        if len(new) != bool(wanted) or wanted and wanted not in "".join(new):
            yield f"{plant!r}: wanted {wanted}, found {new or 'nothing'}"


def main(arguments):
    root = Path(arguments[0])
    found = [*root.glob("*.md"), *(root / "docs").rglob("*.md"), *(root / "scenes").rglob("*.md")]
    pages = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in sorted(found)}
    sources = [path for path in sorted((root / "tests").rglob("*")) if path.suffix in (".cpp", ".hpp") or path.name == "CMakeLists.txt"]
    files = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in sources}
    found = list(missed_plants(pages, files) if "--planted" in arguments else faults(pages, files))
    quotes = sum(len(kind.findall(page)) for page in pages.values() for kind in (FILTER, PATTERN, NAME))
    if quotes < 50:
        found.append(f"only {quotes} quotes are found")
    print("\n".join(found) or f"{quotes} quotes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
