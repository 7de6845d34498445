#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Each header compiles alone: a header that leans on what its user happens to include is found.

  headers_alone.py BUILD [-j N]  status 1, and the compiler's words, where one does not; after `all` is compiled
  headers_alone.py BUILD --list  what each translation unit is, and the headers that it shows to compile alone
  headers_alone.py --planted CXX faults in a small tree of their own, each of which is to be found

One translation unit shows it of several headers, and of none less than a unit of its own would:
  source  a source file that is compiled for the program or a test, and whose first line of code includes the header, has shown it
  chain   lower.hpp, then upper.hpp: where upper includes lower, in whatever way, lower brings nothing into view
          that upper does not bring itself. So both are read as if each was alone, and so on upwards
A chain holds only through headers whose includes all stand at their top, under no condition.
"""
import argparse
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDERS = ["pdu", "deadreckon", "aoim", "haptics", "peer", "tools"]
INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')
# Given to sources of ours alone, which a header cannot count on.
OWN_DEFINITION = re.compile(r"-D(ASIO|RECKON)_")


def includes(text):
    """The includes of a header, and whether all stand at its top and under no condition."""
    found, plain, code, depth = [], True, False, 0
    for line in text.splitlines():
        include = INCLUDE.match(line)
        if include:
            plain = plain and not code and depth == 0
            found.append(include[1])
        elif re.match(r"\s*#\s*if", line):
            depth += 1
        elif re.match(r"\s*#\s*endif", line):
            depth -= 1
        elif line.strip() and not re.match(r"\s*(//|#\s*pragma once)", line):
            code = True
    return found, plain


def read_headers(include):
    """Name as in an include line -> (its includes, plain)."""
    headers = {}
    for folder in FOLDERS:
        for path, _, files in os.walk(include / "reckon" / folder):
            for file in files:
                if file.endswith(".hpp"):
                    full = Path(path) / file
                    headers[full.relative_to(include).as_posix()] = includes(full.read_text(encoding="utf-8"))
    return headers


def closures(headers):
    """Name -> all headers of ours that surely come with it."""
    found = {}

    def visit(name, below):
        if name in found:
            return found[name]
        own, plain = headers[name]
        reached = set()
        for other in own if plain else []:
            if other in headers and other not in below:
                reached |= {other} | visit(other, below | {name})
        found[name] = reached
        return reached

    for name in headers:
        visit(name, frozenset())
    return found


def longest_chains(names, closure):
    """The fewest lists, each from lower to upper, that hold all names: a greatest matching of each with one above it."""
    names = sorted(names, key=lambda name: (-len(closure[name]), name))
    above = {name: [upper for upper in names if name in closure[upper]] for name in names}
    lower_of = {}

    def place(lower, tried):
        for upper in above[lower]:
            if upper not in tried:
                tried.add(upper)
                if upper not in lower_of or place(lower_of[upper], tried):
                    lower_of[upper] = lower
                    return True
        return False

    for name in names:
        place(name, set())
    chains = []
    for top in sorted(set(names) - set(lower_of.values())):
        chain = [top]
        while chain[0] in lower_of:
            chain.insert(0, lower_of[chain[0]])
        chains.append(chain)
    return chains


def first_include(path, include):
    """What the first line of code of a source file includes, through files that are compiled together."""
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if not line.strip() or line.lstrip().startswith("//"):
            continue
        found = INCLUDE.match(line)
        if found and found[1].endswith(".cpp"):
            return first_include(include / found[1], include)
        return found[1] if found else None
    return None


def shown_by_sources(commands, include, headers):
    """Header -> the object file of a source that has shown it to compile alone."""
    shown = {}
    for command in commands:
        words = shlex.split(command["command"])
        output = Path(command["directory"]) / words[words.index("-o") + 1]
        if not output.exists() or any(OWN_DEFINITION.match(word) for word in words):
            continue
        name = first_include(Path(command["file"]), include)
        if name in headers:
            shown.setdefault(name, str(output))
    return shown


def compiler_of(folder, commands):
    """How a folder is compiled: the compiler, its limits of memory, where it looks for includes, the standard; no more."""
    folder = {"peer": "src"}.get(folder, folder)
    found = []
    for command in commands:
        words = shlex.split(command["command"])
        is_cpp = Path(command["file"]).suffix not in (".S", ".c")
        if is_cpp and words[words.index("-o") + 1].startswith(folder + "/"):
            found.append([word for at, word in enumerate(words) if word.startswith(("-I", "-isystem", "-std=", "--param="))
                          or words[at - 1] == "-isystem" or at < words.index(next(w for w in words if w[0] == "-"))])
    if not found:
        raise SystemExit(f"headers_alone: nothing of {folder}/ is compiled in this build")
    # Of the libraries of a folder that which looks in the most places.
    return shlex.join(max(found, key=len))


def write(path, text):
    """Leaves a file alone that says it already, so that nothing is compiled anew."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def plan(build):
    """(chains, headers shown by sources, commands)"""
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    include = build / "include"
    headers = read_headers(include)
    shown = shown_by_sources(commands, include, headers)
    return longest_chains(set(headers) - set(shown), closures(headers)), shown, commands


def write_build(build):
    """The units and a build.ninja of their own; returns its folder, and of how many headers each part shows it."""
    chains, shown, commands = plan(build)
    folder = build / "headers_alone"
    folder.mkdir(exist_ok=True)
    lines = ["builddir = .", "rule alone", "  command = $cxx -O0 -MMD -MF $out.d -o $out -c $in", "  depfile = $out.d",
             "  deps = gcc", "  description = $headers"]
    wanted, compilers = set(), {folder: compiler_of(folder, commands) for folder in {chain[-1].split("/")[1] for chain in chains}}
    for chain in chains:
        unit = re.sub(r"\W", "_", chain[-1].removeprefix("reckon/")) + ".cpp"
        wanted.add(unit)
        write(folder / unit, "".join(f'#include "{name}"\n' for name in chain))
        lines += [f"build {unit}.o: alone {unit}", f"  cxx = {compilers[chain[-1].split('/')[1]]}",
                  f"  headers = {' '.join(chain)}"]
    for old in folder.glob("*.cpp"):
        if old.name not in wanted:
            old.unlink()
    write(folder / "build.ninja", "\n".join(lines) + "\n")
    return folder, sum(map(len, chains)), len(chains), len(shown)


def check(build, jobs):
    """Becomes ninja, so that whoever ends this process ends the compilers."""
    folder, in_chains, units, by_sources = write_build(build)
    print(f"headers alone: {by_sources} shown by sources, {in_chains} in {units} units", flush=True)
    os.execvp("ninja", ["ninja", "-C", str(folder), "-k", "0", "-j", str(jobs)])


# Files of a small tree; each of those named fails to compile alone, and nothing else does.
SMALL_TREE = {
    "pdu/good.hpp": "#include <vector>\ninline std::vector<int> good;\n",
    "pdu/above_good.hpp": '#include "reckon/pdu/good.hpp"\ninline auto above = good;\n',
    # Leans on what its user includes before it.
    "pdu/leans.hpp": "struct Leans { std::vector<int> all; };\n",
    "pdu/above_leans.hpp": '#include <vector>\n\n#include "reckon/pdu/leans.hpp"\ninline Leans leans_above;\n',
    # The same from two headers beside it in one folder, and in a template.
    "aoim/beside.hpp": "template <typename T> T beside() { return good.at(0); }\n",
    # Leans on what is under a condition that does not hold, or comes too late.
    "pdu/answer.hpp": "inline int answer = 42;\n",
    "deadreckon/conditional.hpp": '#ifdef NEVER\n#include "reckon/pdu/answer.hpp"\n#endif\ninline auto conditional = answer;\n',
    "pdu/question.hpp": "inline int question = 6;\n",
    "haptics/late.hpp": 'inline auto late = question;\n#include "reckon/pdu/question.hpp"\n',
    # A source shows a header only where nothing stands before it.
    "peer/first.hpp": "inline int first = 1;\n",
    "peer/first.cpp": '// A word.\n#include "reckon/peer/first.hpp"\n',
    "peer/second.hpp": "inline std::vector<int> second;\n",
    "peer/second.cpp": '#include <vector>\n\n#include "reckon/peer/second.hpp"\n',
    "tools/defined.hpp": "inline int defined = ASIO_ANSWER;\n",
    "tools/defined.cpp": '#include "reckon/tools/defined.hpp"\n',
}
AT_FAULT = {"pdu/leans", "aoim/beside", "deadreckon/conditional", "haptics/late", "peer/second", "tools/defined"}
BROKEN_BY_THEM = {"pdu/above_leans"}  # may be told too, for it ends the chain of one


def small_build(build, compiler):
    commands = []
    for name, text in SMALL_TREE.items():
        path = build / "include" / "reckon" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(("#pragma once\n" if name.endswith(".hpp") else "") + text, encoding="utf-8")
    for folder in FOLDERS:
        for source in sorted((build / "include" / "reckon" / folder).glob("*.cpp")) or [Path("none.cpp")]:
            output = f"{folder.replace('peer', 'src')}/{source.name}.o"
            (build / output).parent.mkdir(parents=True, exist_ok=True)
            definition = "-DASIO_ANSWER=42 " if folder == "tools" else ""
            command = f"{compiler} {definition}-I{build}/include -std=c++20 -o {output} -c {source}"
            if source.exists():
                subprocess.run(shlex.split(command), cwd=build, check=True)
                commands.append({"directory": str(build), "command": command, "file": str(source)})
            else:
                commands.append({"directory": str(build), "command": command, "file": os.devnull})
    (build / "compile_commands.json").write_text(json.dumps(commands), encoding="utf-8")


def planted(compiler):
    with tempfile.TemporaryDirectory() as place:
        build = Path(place)
        small_build(build, compiler)
        chains, shown, _ = plan(build)
        folder = write_build(build)[0]
        words = subprocess.run(["ninja", "-C", str(folder), "-k", "0"], capture_output=True, text=True, check=False).stdout
    told = set(re.findall(r"include/reckon/(\w+/\w+)\.hpp:\d+:\d+: error", words))
    wrong = (AT_FAULT - told) | (told - AT_FAULT - BROKEN_BY_THEM)
    if list(shown) != ["reckon/peer/first.hpp"]:
        wrong.add(f"shown by sources: {list(shown)}")
    if not any(chain == ["reckon/pdu/good.hpp", "reckon/pdu/above_good.hpp"] for chain in chains):
        wrong.add(f"chains: {chains}")
    for fault in sorted(wrong):
        print(f"not as it should be: {fault}")
    print(words if wrong else f"{len(AT_FAULT)} planted faults were found, and nothing else")
    return int(bool(wrong))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, nargs="?")
    parser.add_argument("-j", dest="jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--planted", metavar="CXX")
    options = parser.parse_args()
    if options.planted:
        return planted(options.planted)
    if options.build is None:
        parser.error("which BUILD?")
    build = options.build.resolve()
    if not options.list:
        check(build, options.jobs)
    chains, shown, _ = plan(build)
    for name, output in sorted(shown.items()):
        print(f"{os.path.relpath(output, build)}: {name}")
    for chain in chains:
        print("chain:", " ".join(chain))
    return 0


if __name__ == "__main__":
    sys.exit(main())
