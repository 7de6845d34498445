# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Plants faults in copies of sources, one at a time. The simulation of peers, of leaders or of owners must find each
one. This is `./run fuzz peers --plant`. The faults are in plants.py of each simulation.

  plant.py BUILD [SEEDS [TARGET]]  builds in BUILD/plants on BUILD/release, prints a table; status 1 if a fault was not found
  plant.py --check                 status 1, and a line for each, if the text that a plant replaces does not occur exactly once
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from leaders.plants import PLANTS as PLANTS_OF_LEADERS  # noqa: E402
from owners.plants import PLANTS as PLANTS_OF_OWNERS  # noqa: E402
from peers.plants import PLANTS as PLANTS_OF_PEERS  # noqa: E402

PEERS, LEADERS, OWNERS = "peers", "leaders", "owners"
PLANTS = {PEERS: PLANTS_OF_PEERS, LEADERS: PLANTS_OF_LEADERS, OWNERS: PLANTS_OF_OWNERS}
FOLDERS = {PEERS: "aoim", LEADERS: "aoim", OWNERS: "src/ownership"}
ROOT = HERE.parents[2]
FLAGS = ["-std=c++20", "-O1", "-DNDEBUG", "-ffp-contract=off"]
SEEDS = 10_000


def complaints():
    """A line for each plant that cannot be applied."""
    for target, plants in PLANTS.items():
        folder = FOLDERS[target]
        for name, file, old, new in plants:
            count = (ROOT / folder / file).read_text(encoding="utf-8").count(old)
            if count != 1 or old == new:
                yield f"{name}: {folder}/{file} has {count} of what it replaces: {old.splitlines()[0].strip()}"


def program_of(target, release):
    return release / "tests/fuzz" / target / f"{target}_simulation"


def united_with(file, faulty, release):
    """The united source of all files of aoim that are compiled together with this one, with the faulty copy."""
    line = f'#include "reckon/aoim/{file}"\n'
    united = next(text for unit in (release / "aoim/united/reckon_aoim").glob("*.cpp")
                  if line in (text := unit.read_text(encoding="utf-8")))
    return united.replace(line, f'#include "{faulty}"\n')


def room_with(file, text, folder):
    """A source of all files of the room of ownership, in a copy of the room that the includes find first."""
    room = folder.resolve() / "include/reckon/peer/ownership"
    shutil.copytree(ROOT / FOLDERS[OWNERS], room)
    (room / file).write_text(text, encoding="utf-8")
    return "".join(f'#include "{path}"\n' for path in sorted(room.glob("*.cpp")))


def planted_program(plant, target, folder, release):
    """The simulation with one fault: the object of all files that are compiled together with the faulty one comes
    before the library with the correct ones."""
    _, file, old, new = plant
    folder.mkdir(parents=True)
    faulty = folder / pathlib.Path(file).name
    text = (ROOT / FOLDERS[target] / file).read_text(encoding="utf-8").replace(old, new)
    faulty.write_text(text, encoding="utf-8")
    unit = folder / "unit.cpp"
    unit.write_text(room_with(file, text, folder) if target == OWNERS else united_with(file, faulty, release),
                    encoding="utf-8")
    compiler = os.environ.get("CXX", "c++")
    main = release / f"tests/fuzz/{target}/CMakeFiles/{target}_simulation.dir/simulate.cpp.o"
    libraries = [release / f"tests/fuzz/{target}/libreckon_{target}.a",
                 release / "aoim/libreckon_aoim.a", release / "pdu/libreckon_pdu.a"]
    program = folder / "simulation"
    command = ["nice", compiler, *FLAGS, f"-I{folder / 'include'}", f"-I{release / 'include'}", unit, main, *libraries, "-lfmt", "-o",
               program]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"plant.py: '{plant[0]}' does not compile:\n{done.stderr[:2000]}")
    return program


def finding(program, first, number):
    """Report of the first seed that violates an invariant: seed, invariant, sentence; none if all hold."""
    told = subprocess.run(["nice", "-n", "19", str(program), "--first", str(first), "--seeds", str(number)],
                          capture_output=True, text=True, check=False).stdout
    found = re.search(r"seed (\d+) breaks ([IL]\d+) at [\d.]+ s: (.*)", told)
    return found and (int(found[1]), found[2], found[3])


def hunt(plant, target, build, number):
    """Row of the table: fault, the first seed that finds it and passes without it, invariant, sentence."""
    program = planted_program(plant, target, build / "plants" / plant[0].replace(" ", "_"), build / "release")
    sound = program_of(target, build / "release")
    first = 1
    while first <= number:
        found = finding(program, first, number - first + 1)
        if not found:
            break
        if not finding(sound, found[0], 1):
            return (plant[0], *found)
        first = found[0] + 1
    return (plant[0], "-", "-", "not found")


def main(build, number=SEEDS, target=PEERS):
    """`build` has release/ with the target's simulation, built from the current tree."""
    faults = list(complaints())
    for fault in faults:
        print(f"plant.py: {fault}", file=sys.stderr)
    if faults:
        return 1
    shutil.rmtree(build / "plants", ignore_errors=True)
    print("| planted | seed | invariant | told |\n|---|---|---|---|", flush=True)
    missed = 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        hunts = [pool.submit(hunt, plant, target, build, number) for plant in PLANTS[target]]
        for row in (found.result() for found in concurrent.futures.as_completed(hunts)):
            print("| {} | {} | {} | {} |".format(*row), flush=True)
            missed += row[1] == "-"
    print(f"{len(PLANTS[target]) - missed} of {len(PLANTS[target])} found")
    return 1 if missed else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        lines = list(complaints())
        print(*lines, sep="\n")
        sys.exit(1 if lines else 0)
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1]), *map(int, sys.argv[2:3]), *sys.argv[3:4]))
