#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the include lines of a tree against the rules of docs/architecture.md.

  layering.py ROOT            status 1, and a line for each fault, where a rule is broken
  layering.py ROOT --planted  plants a fault of each kind, in memory, and wants each to be found

The compiler cannot tell: one include path serves all folders. The rules:
  name       an include of ours reads "reckon/<folder>/..", and the file exists
  direction  a top folder includes only what it may know (MAY_KNOW)
  door       the files that lie directly in a folder are its door: they may know the rooms behind it,
             no room knows the door
  loop       folders do not include each other in a circle
  sign       each folder has a README.md of a title and one sentence: what lives there
  listed     each source stands in the CMakeLists.txt of its top folder, or of one below
  mirror     a room of tests/<folder> has the name of a room of <folder>, or is `support`
  top        the project has no other top folders, but those that git ignores
"""
import re
import sys
from functools import cache
from pathlib import Path, PurePosixPath

STANDARD = r"<[a-z_0-9]+>"
SYSTEM = r"<[a-z_]+\.h>|<(sys|linux|net|netinet|arpa)/"
# What each top folder may include, of ours and of others.
MAY_KNOW = {
    "pdu": (["pdu"], STANDARD),
    "aoim": (["pdu", "aoim"], STANDARD + r"|<immintrin\.h>"),
    "deadreckon": (["pdu", "deadreckon"], STANDARD + "|<Eigen/"),
    "haptics": (["pdu", "deadreckon", "haptics"], f"{STANDARD}|{SYSTEM}|<(libusb-1.0|(unsupported/)?Eigen|OpenMesh|ode)/"),
    "src": (["pdu", "deadreckon", "aoim", "haptics", "src"], "<"),
    "tools": (["pdu", "deadreckon", "aoim", "haptics", "src", "tools"], "<"),
    "python": (["pdu", "deadreckon", "aoim", "haptics", "src", "tools", "python"], "<"),
    "tests": (["pdu", "deadreckon", "aoim", "haptics", "src", "tools", "tests", "bench"], "<"),
    "bench": (["pdu", "deadreckon", "aoim", "haptics", "src", "tools", "tests", "bench"], "<"),
}
WITHOUT_CODE = [".ci", ".git", "cmake", "devices", "docs", "scenes"]
PRODUCT = ["pdu", "aoim", "deadreckon", "haptics", "src", "tools"]
ROOMED = [*PRODUCT, "python", "bench"]
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"][^>"]*[>"])', re.M)
GENERATED = {"pdu/codec/siso_names_data.inc"}
# Written by hand in another project's name: they include what is installed.
FOREIGN = "tests/consumer/"


def read(root):
    """Path -> text of every file that the rules look at."""
    ignored = (root / ".gitignore").read_text(encoding="utf-8").split()
    files = {f"{path.name}/": "" for path in root.iterdir() if path.is_dir() and f"{path.name}/" not in ignored}
    for top in MAY_KNOW:
        for path in sorted((root / top).rglob("*")):
            if path.suffix in (".cpp", ".hpp", ".h") or path.name in ("CMakeLists.txt", "README.md"):
                files[path.relative_to(root).as_posix()] = path.read_text(encoding="utf-8")
    return {path: text for path, text in files.items() if not path.startswith(FOREIGN)}


def is_source(path):
    return path.endswith((".cpp", ".hpp"))


@cache
def folder_of(path):
    return PurePosixPath(path).parent.as_posix()


@cache
def included(text):
    """Of each include: as written, and the path of ours that it names or None."""
    lines = []
    for written in INCLUDE.findall(text):
        named = re.fullmatch(r'"reckon/(.+)"', written)
        lines.append((written, re.sub(r"^peer/", "src/", named[1]) if named else None))
    return lines


def check_lines(files):
    """Rules that each include line keeps or breaks by itself."""
    for path, text in files.items():
        if not is_source(path):
            continue
        top = path.split("/")[0]
        ours, others = MAY_KNOW[top]
        for written, target in included(text):
            where = f"{path}: #include {written}"
            if target is None:
                if written.startswith('"'):
                    yield "name", f"{where}: write \"reckon/..\""
                elif not re.match(others, written):
                    yield "direction", f"{where}: {top}/ must not know it"
                continue
            if target not in files and target not in GENERATED:
                yield "name", f"{where}: there is no such file"
            if target.split("/")[0] not in ours:
                yield "direction", f"{where}: {top}/ must not know {target.split('/')[0]}/"
            if folder_of(path).startswith(folder_of(target) + "/"):
                yield "door", f"{where}: a room includes the door of {folder_of(target)}/"


def arrows_of(files):
    """Folder -> folder -> one include that joins them."""
    arrows = {}
    for path, text in files.items():
        if not is_source(path):
            continue
        for written, target in included(text):
            if target and folder_of(target) != folder_of(path):
                arrows.setdefault(folder_of(path), {}).setdefault(folder_of(target), f"{path} includes {written}")
    return arrows


def way_back(arrows, start):
    """The shortest way from a folder to itself, or nothing."""
    ways = [[start]]
    seen = set()
    for way in ways:
        for folder in sorted(arrows.get(way[-1], {})):
            if folder == start:
                return way + [start]
            if folder not in seen:
                seen.add(folder)
                ways.append(way + [folder])
    return []


def check_loops(files):
    arrows = arrows_of(files)
    told = set()
    for start in sorted(arrows):
        way = way_back(arrows, start)
        if not way or told & set(way):
            continue
        told |= set(way)
        steps = "; ".join(arrows[one][other] for one, other in zip(way, way[1:]))
        yield "loop", f"{' -> '.join(way)}: {steps}"


def check_folders(files):
    folders = {folder_of(path) for path in files if is_source(path) and path.split("/")[0] in ROOMED}
    folders |= {parent.as_posix() for folder in folders for parent in PurePosixPath(folder).parents} - {"."}
    for folder in sorted(folders):
        sign = files.get(f"{folder}/README.md", "")
        if not re.fullmatch(r"# \S+\n\n[^\n#].*[.]\n", sign, re.S) or sign.count("\n\n") != 1:
            yield "sign", f"{folder}/README.md: has to be a title and one sentence, what lives there"
    for path in files:
        if is_source(path) and not is_listed(path, files):
            yield "listed", f"{path}: stands in no CMakeLists.txt"
    for folder in sorted({folder_of(path) for path in files if path.startswith("tests/") and is_source(path)}):
        room = folder.split("/", 1)[-1]
        known = room.split("/")[0] not in ROOMED or room in folders or room.endswith("/support")
        if not known:
            yield "mirror", f"{folder}/: there is no {room}/"


@cache
def names(text, name):
    return re.search(rf"(?<![\w/]){re.escape(name)}(?!\w)", text) is not None


def check_top(files):
    for path in files:
        if path.endswith("/") and path.count("/") == 1 and path[:-1] not in (*MAY_KNOW, *WITHOUT_CODE):
            yield "top", f"{path}: delete it, or name it here and in docs/architecture.md"


def is_listed(path, files):
    """Headers of tests and benches need no line."""
    if path.endswith(".hpp") and path.split("/")[0] not in PRODUCT:
        return True
    for folder in PurePosixPath(path).parents:
        text = files.get(f"{folder}/CMakeLists.txt".lstrip("./"), "")
        name = PurePosixPath(path).relative_to(folder).as_posix()
        if names(text, name):
            return True
    # <name>_bench.cpp and <name>_fuzz.cpp are found by a loop over their names.
    family = re.fullmatch(r"(bench(?=/micro)|tests/fuzz)(/micro)?/(\w+)_(bench|fuzz)\.cpp", path)
    return bool(family) and re.search(rf"\b{family[3]}\b", files[f"{family[1]}/CMakeLists.txt"]) is not None


def faults(files):
    return [*check_lines(files), *check_loops(files), *check_folders(files), *check_top(files)]


# Rule, file, and what is planted in it: an include line at its end, or another text where it starts with "=".
PLANTED = [
    ("name", "pdu/bundle.hpp", '#include "pdu/timestamp.hpp"'),
    ("name", "pdu/bundle.hpp", '#include "reckon/pdu/no_such_file.hpp"'),
    ("direction", "pdu/bundle.cpp", '#include "reckon/haptics/servo/safety.hpp"'),
    ("direction", "pdu/bundle.cpp", "#include <Eigen/Core>"),
    ("direction", "aoim/interest/interest.cpp", '#include "reckon/peer/peer.hpp"'),
    ("direction", "src/peer.cpp", '#include "reckon/tools/program.hpp"'),
    ("direction", "tools/verbs/program_start.cpp", '#include "reckon/bench/program.hpp"'),
    ("direction", "haptics/servo/safety.cpp", '#include "reckon/tests/support/touch_meshes.hpp"'),
    ("direction", "tools/verbs/info.cpp", '#include "reckon/python/records/shape.hpp"'),
    ("direction", "pdu/bundle.cpp", "#include <pybind11/pybind11.h>"),
    ("door", "pdu/codec/codec.hpp", '#include "reckon/pdu/bundle.hpp"'),
    ("door", "tools/verbs/info.cpp", '#include "reckon/tools/program.hpp"'),
    ("door", "tools/inspect/views/stats.cpp", '#include "reckon/tools/inspect/view_list.hpp"'),
    ("door", "src/world/state_table.cpp", '#include "reckon/peer/peer.hpp"'),
    ("loop", "haptics/geometry/shapes.cpp", '#include "reckon/haptics/scene/scene.hpp"'),
    ("loop", "tools/terminal/text_table.cpp", '#include "reckon/tools/verbs/completion.hpp"'),
    ("sign", "haptics/geometry/README.md", "="),
    ("sign", "bench/studies/scale/README.md", "="),
    ("sign", "src/README.md", "=# src\n\nOne. \n\nTwo.\n"),
    ("listed", "pdu/entity/forgotten.hpp", "=#pragma once\n"),
    ("listed", "tests/pdu/codec/forgotten_test.cpp", "=\n"),
    ("mirror", "tests/haptics/nowhere/some.hpp", "=\n"),
    ("mirror", "tests/bench/nowhere/some.hpp", "=\n"),
    ("top", "page_pictures/", "="),
]


def missed_plants(files):
    for rule, path, plant in PLANTED:
        changed = dict(files)
        changed[path] = plant[1:] if plant.startswith("=") else changed[path] + plant + "\n"
        found = {kind for kind, _ in faults(changed)}
        if rule not in found:
            yield f"not found: {rule} by {path} with {plant!r}; found {sorted(found) or 'nothing'}"


def main(arguments):
    files = read(Path(arguments[0]))
    if "--planted" in arguments:
        told = list(missed_plants(files))
        print(f"{len(PLANTED) - len(told)} of {len(PLANTED)} planted faults found")
    else:
        told = [f"{rule}: {text}" for rule, text in faults(files)]
        print(f"{sum(map(is_source, files))} sources in {len({folder_of(p) for p in files if is_source(p)})} folders")
    print("\n".join(told))
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
