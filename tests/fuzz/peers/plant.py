# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Plants faults in a copy of aoim, one at a time, and wants the simulation of peers to find each: what ./run fuzz peers --plant does.

  plant.py BUILD [SEEDS]  builds in BUILD/plants, prints a table; status 1 where a fault was not found
  plant.py --check        status 1, and a line for each, where the text that a plant replaces is not there once
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from plants import PLANTS  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
FLAGS = ["-std=c++20", "-O1", "-DNDEBUG", "-ffp-contract=off"]
SEEDS = 10_000


def complaints():
    """A line for each plant that cannot be planted."""
    for name, file, old, new in PLANTS:
        count = (ROOT / "aoim" / file).read_text(encoding="utf-8").count(old)
        if count != 1 or old == new:
            yield f"{name}: aoim/{file} has {count} of what it replaces: {old.splitlines()[0].strip()}"


def compiler():
    launcher = shutil.which("ccache")
    return ([launcher] if launcher else []) + [os.environ.get("CXX", "c++")]


def compile_one(source, target, include):
    command = [*compiler(), *FLAGS, f"-I{include}", "-c", str(source), "-o", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"plant.py: {source} does not compile:\n{done.stderr[:2000]}")
    return target


def sources():
    return sorted((ROOT / "aoim").glob("*.cpp")) + [p for p in sorted(HERE.glob("*.cpp")) if p.name != "peers_test.cpp"]


def include_of(folder):
    """An include path in which reckon/aoim is a copy of ours."""
    include = folder / "include" / "reckon"
    include.mkdir(parents=True)
    for name in ("pdu", "tests"):
        (include / name).symlink_to(ROOT / name)
    shutil.copytree(ROOT / "aoim", include / "aoim")
    return include.parent


def link(build, objects, program):
    subprocess.run([*compiler()[-1:], *map(str, objects), str(build / "release/pdu/libreckon_pdu.a"), "-lfmt", "-o",
                    str(program)], check=True)
    return program


def planted_program(plant, folder, build, sound):
    """The simulation with one fault in it; `sound` are the objects without."""
    name, file, old, new = plant
    include = include_of(folder)
    faulty = include / "reckon" / "aoim" / file
    faulty.write_text(faulty.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    objects = dict(sound)
    for path in sound:
        touched = path.name == file or file.endswith(".hpp")
        if touched:
            source = include / "reckon" / "aoim" / path.name if path.parent.name == "aoim" else path
            objects[path] = compile_one(source, folder / (path.stem + ".o"), include)
    return link(build, objects.values(), folder / "simulation")


def hunt(plant, build, number, sound):
    """Row of the table: fault, seed that found it, invariant, sentence."""
    folder = build / "plants" / plant[0].replace(" ", "_").replace("/", "_")
    program = planted_program(plant, folder, build, sound)
    told = subprocess.run(["nice", "-n", "19", str(program), "--seeds", str(number)], capture_output=True, text=True,
                          check=False).stdout
    found = re.search(r"seed (\d+) breaks (I\d+) at [\d.]+ s: (.*)", told)
    return (plant[0], *(found.groups() if found else ("-", "-", "not found")))


def main(build, number=SEEDS):
    faults = list(complaints())
    for fault in faults:
        print(f"plant.py: {fault}", file=sys.stderr)
    if faults:
        return 1
    shutil.rmtree(build / "plants", ignore_errors=True)
    include = include_of(build / "plants" / "sound")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        objects = pool.map(lambda p: compile_one(p, include.parent / (p.stem + ".o"), include), sources())
        sound = dict(zip(sources(), objects))
        rows = list(pool.map(lambda plant: hunt(plant, build, number, sound), PLANTS))
    print("| planted | seed | invariant | told |\n|---|---|---|---|")
    for row in rows:
        print("| {} | {} | {} | {} |".format(*row))
    missed = sum(row[1] == "-" for row in rows)
    print(f"{len(rows) - missed} of {len(rows)} found")
    return 1 if missed else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        lines = list(complaints())
        print(*lines, sep="\n")
        sys.exit(1 if lines else 0)
    sys.exit(main(pathlib.Path(sys.argv[1]), *map(int, sys.argv[2:3])))
