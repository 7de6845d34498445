# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Processes of one host that own the cubes of a scene, and take and give them at random while each loses a tenth of
what it receives: never two owners, no version back, no jump. One case per call:
  owners_lan.py CASE --process PROGRAM [--reckon PROGRAM] [--hand-overs N] [--rate R] [--keep FOLDER]
  judge    the judge finds planted faults
  short    some hundred hand-overs
  soak     until N hand-overs, 10000 (default)
  stopped  SIGSTOP of an owner for 8 s
  killed   kill -9 of an owner: its bodies are adopted within 5 s
  recorded a recording has the owners, and so has its replay"""
import argparse
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import owners_judge
import testbed
from testbed import Program, check

PROCESSES, CUBES = 4, 20
JOINED = 2.5   # [s] until all have joined and one has founded
QUIET = 3.0    # [s] after the last wish, until all agree
STOPPED = 8.0  # [s]
REST = 0.1     # [mm], between the places of a body at two processes after that
SCENE = """
[[object]]
name = "floor"
plane = [0, 0, 1]
surface = {stiffness = "400 N/m"}

[[operator]]
passive = true

[[device]]
peer = 1
operator = 1

[impairment]
loss = "10 %"
"""
CUBE = """
[[object]]
name = "cube {number}"
box = "40 40 40 mm"
position = "{x} {y} 20 mm"
mass = "50 g"
body_friction = 0.4
surface = {{stiffness = "400 N/m"}}
"""


def monotonic_ns():
    return time.clock_gettime_ns(time.CLOCK_MONOTONIC)


class Owners:
    """The processes, and their logs in a folder."""

    def __init__(self, setup, seconds):
        self.folder, self.killed = setup.folder, {}
        scene = self.folder / "scene.toml"
        scene.write_text(SCENE + "".join(CUBE.format(number=i, x=150 * (i % 5), y=150 * (i // 5)) for i in range(CUBES)))
        self.programs = []
        for number in range(1, PROCESSES + 1):
            words = [setup.process, scene, "lo", number, seconds + JOINED, setup.rate]
            self.programs.append(Program(["sh", "-c", 'exec "$@" >"$0"', str(self.path(number)), *map(str, words)]))
        time.sleep(JOINED)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for program in self.programs:
            program.end()

    def path(self, number):
        return self.folder / f"{number}.log"

    def held(self, number):
        """Number of bodies that a process simulates, by its log up to now."""
        text = self.path(number).read_text()
        return text.count(" begin ") - text.count(" end ")

    def hand_overs(self):
        return sum(self.path(n).read_text().count(" begin ") for n in range(1, PROCESSES + 1)) - CUBES

    def kill(self, number):
        self.programs[number - 1].kill()
        self.killed[number] = monotonic_ns()

    def finish(self):
        """Ends all; the judge of their logs."""
        until = monotonic_ns()
        for number, program in enumerate(self.programs, 1):
            if number not in self.killed:
                program.signal(signal.SIGTERM)
        for number, program in enumerate(self.programs, 1):
            status = program.wait()
            check(status == 0 or number in self.killed, f"process {number} ended with status {status}: {program.error_text()}")
        logs = {number: owners_judge.Log(self.path(number).read_text(), self.killed.get(number))
                for number in range(1, PROCESSES + 1)}
        return owners_judge.Judge(logs, until)


def verdict_of(judge, least, is_quiet=True):
    faults = judge.judge()
    if is_quiet:
        judge.agreement()
    received, lost = judge.count("received"), judge.count("lost_by_law")
    print(f"  {judge.hand_overs} hand-overs; lost {lost} of {received + lost} datagrams; granted {judge.count('bodies_granted')}, "
          f"adopted {judge.count('bodies_adopted')}, released {judge.count('bodies_released')}, refused "
          f"{judge.count('ownership_refused')}, stale {judge.count('bodies_stale')}\n"
          f"  longest time without an owner {judge.longest_gap:.3f} s, worst jump {judge.worst_jump:.2f} mm beyond the error "
          f"before it, which is {judge.worst_error:.1f} mm at most; {judge.unjudged} "
          f"jumps not judged, passes too far apart; places at the end differ by {judge.spread():.2f} mm")
    for fault in faults[:20]:
        print(f"  {fault}")
    check(not faults, f"{len(faults)} faults")
    check(not is_quiet or judge.spread() <= REST, f"places at the end differ by {judge.spread():.2f} mm")
    check(judge.hand_overs >= least, f"only {judge.hand_overs} hand-overs")
    check(lost > 0.07 * received, "datagrams were not lost")


def judge(_):
    """The judge finds each planted fault."""
    wrong = owners_judge.check_itself()
    check(not wrong, "; ".join(wrong))


def short(setup):
    """Some hundred hand-overs."""
    with Owners(setup, 12) as owners:
        time.sleep(12 + QUIET)
        verdict_of(owners.finish(), 250)


def soak(setup):
    """Many hand-overs."""
    with Owners(setup, 1e6) as owners:
        while (count := owners.hand_overs()) < setup.hand_overs:
            check(all(program.process.poll() is None for program in owners.programs), "a process ended")
            print(f"  {count} hand-overs", flush=True)
            time.sleep(20)
        verdict_of(owners.finish(), setup.hand_overs, is_quiet=False)


def stopped(setup):
    """An owner gets no processor time for 8 s, and then finds that it owns nothing."""
    seconds = 4 + STOPPED + 4
    with Owners(setup, seconds) as owners:
        time.sleep(4)
        sleeper = owners.programs[0]
        sleeper.signal(signal.SIGSTOP)
        held = owners.held(1)
        time.sleep(STOPPED)
        sleeper.signal(signal.SIGCONT)
        time.sleep(4 + QUIET)
        judge = owners.finish()
        print(f"  it owned {held} bodies; slept {[round((b - a) / 1e9, 2) for a, b in judge.logs[1].slept]} s")
        check(held > 0, "it owned nothing: this shows nothing")
        check(judge.logs[1].slept, "it did not sleep")
        verdict_of(judge, 250)


def killed(setup):
    """An owner is killed."""
    with Owners(setup, 12) as owners:
        time.sleep(4)
        held = owners.held(1)
        owners.kill(1)
        time.sleep(8 + QUIET)
        judge = owners.finish()
        at = owners.killed[1]
        taken = [min((i.begin - at) / 1e9 for i in rows if i.begin > at) for rows in judge.simulated.values()
                 if any(i.owner == 1 and i.end == at for i in rows) and rows[-1].begin > at]
        print(f"  it owned {held} bodies; {len(taken)} adopted after {min(taken, default=0):.2f} to {max(taken, default=0):.2f} s")
        check(held > 0, "it owned nothing: this shows nothing")
        verdict_of(judge, 200)


def changes_in(lines):
    """[(body, version, address of its new owner)] of `inspect owners --json`."""
    rows = map(json.loads, lines)
    return [(row["body"], row["version"], row["to"]) for row in rows if "version" in row]


def recorded(setup):
    """A recording of the exercise has each owner, and its replay has the same."""
    capture = setup.folder / "owners.pcapng"
    recorder = Program([setup.reckon, "record", str(capture), "--iface", "lo"])
    with Owners(setup, 6) as owners:
        time.sleep(6 + QUIET)
        judge = owners.finish()
    recorder.interrupt()
    check(recorder.wait() == 0, f"record: {recorder.error_text()}")
    told = subprocess.run([setup.reckon, "inspect", "owners", str(capture), "--json"], capture_output=True, text=True, check=True)
    changes = changes_in(told.stdout.splitlines())
    last = {body: (version, to) for body, version, to in changes}
    listener = Program([setup.reckon, "inspect", "owners", "--iface", "lo", "--json"])
    time.sleep(0.5)
    subprocess.run([setup.reckon, "replay", str(capture), "--rate", "4"], capture_output=True, check=True)
    time.sleep(0.5)
    listener.interrupt()
    check(listener.wait() == 0, f"inspect: {listener.error_text()}")
    replayed = changes_in(text for _, text in listener.lines)
    begun = sum(len(rows) for rows in judge.simulated.values()) - CUBES
    print(f"  {begun} hand-overs; {len(changes)} changes in the recording, {len(replayed)} in its replay")
    check(len(last) == CUBES, f"the recording has {len(last)} bodies")
    # An owner that keeps a body for less than some ms sends no state of it.
    check(0.9 * begun <= len(changes) - CUBES <= begun, "the recording has other hand-overs")
    check(len({to for _, _, to in changes}) == PROCESSES, "not each process owned a body")
    check(replayed == changes, "the replay has other changes")


CASES = {case.__name__: case for case in (judge, short, soak, stopped, killed, recorded)}


def run(case):
    parser = argparse.ArgumentParser()
    parser.add_argument("case")
    parser.add_argument("--process", default="")
    parser.add_argument("--reckon", default="")
    parser.add_argument("--hand-overs", type=int, default=10_000)
    parser.add_argument("--rate", type=float, default=8.0)
    parser.add_argument("--keep", type=pathlib.Path, help="where the logs stay")
    arguments = parser.parse_args()
    print(case.__doc__)
    with tempfile.TemporaryDirectory(prefix="reckon_") as folder:
        arguments.folder = arguments.keep or pathlib.Path(folder)
        arguments.folder.mkdir(exist_ok=True)
        case(arguments)


if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
