# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Computes the README's table of measured figures again, with the commands that stand in it, and compares each figure.
readme_figures.py ROOT [WORD]: only rows whose command has this word. Exit status 1 where a figure differs.

All but the processor's time are of simulated runs: a figure is the same where it is within its last digit or 2 %, for
compilers and processors round differently."""
import json
import pathlib
import re
import shlex
import subprocess
import sys
import time

SPREAD = 0.02


def objects(text):
    return [json.loads(line) for line in text.splitlines() if line.startswith("{")]


def demo(text):
    run = objects(text)[-1]
    return [run["raw_packets_per_s"] / run["packets_per_s"], 1e3 * run["pose_error_m"]["p99"], run["force_error_n"]["p99"]]


def least_energy(text):
    return [objects(text)[-1]["energy_min_j"]]


def presses(text):
    return [100 * float(re.search(r"after 3 s ([0-9.]+)", text)[1])]


def circle(text):
    rms = {(row["model"], row["curve"]): row["position_m"]["rms"] for row in objects(text)}
    return [1e6 * rms["auto", "cubic"], 4, 1e3 * rms["rvw+adaptive", "cubic"]]


def stability(text):
    modes = {row["mode"]: row for row in objects(text) if row["kind"] == "mode"}
    shown = "reckon", "passivity_controller", "printed_dead_reckoning", "effort_flow"
    return [100 * modes[mode][key] for mode in shown for key in ("made_energy", "right")]


def figures(text):
    row = next(row for row in objects(text) if row["name"] == "4.4")
    return [row["ours"], row["thesis"]]


# By the words of a command: what makes its output readable here, and the figures of the cell in their order.
ROWS = {
    "demo --simulated-time --for 60s": ("--json", demo),
    "demo scenes/two_hands.toml": ("--json", demo),
    "SlowPress": ("", presses),
    "accuracy --circle": ("--json", circle),
    "bench stability": ("--json", stability),
    "--for 10min": ("--json", least_energy),
    "reckon figures": ("--json --out build/readme_figures", figures),
}
EACH = {"position error": 1, "error of the force": 2}  # of the figures of a command that has several rows
NUMBER = r"\d+(?:\.\d+)?"
REMARKS = r"of 2 N|; 2 s$"  # what is no figure of the run, and the processor's time


def rows_of(readme):
    """(what, figure, command) of each row; "the same" is the command above."""
    command = ""
    for line in readme.split("| measured |")[1].split("\n\n")[0].splitlines()[2:]:
        what, figure, how = (cell.strip() for cell in line.strip("|").split(" | "))
        command = command if how == "the same" else re.fullmatch(r"`(.*)`\s*", how)[1]
        yield what, figure, command


def agrees(stated, measured):
    digits = len(stated.partition(".")[2])
    return abs(float(stated) - measured) <= max(0.5 * 10 ** -digits, SPREAD * abs(measured)) + 1e-12


class Table:
    def __init__(self, root):
        self._root = root
        self._outputs = {}

    def output(self, command, more):
        """Of a command, run once; a failure is told and ends all."""
        if command not in self._outputs:
            words = shlex.split(command) + shlex.split(more)
            program = {"./run": "build/release/reckon", "reckon": "build/release/reckon"}.get(words[0], words[0])
            begun = time.monotonic()
            done = subprocess.run([program, *words[1:]], cwd=self._root, capture_output=True, text=True)
            if done.returncode:
                sys.exit(f"failed: {command}: exit status {done.returncode}\n{done.stderr[-2000:]}")
            print(f"{time.monotonic() - begun:6.1f} s  {command}", flush=True)
            self._outputs[command] = done.stdout
        return self._outputs[command]

    def check(self, what, figure, command):
        """Whether the row still holds."""
        found = [row for words, row in ROWS.items() if words in command]
        if len(found) != 1:
            sys.exit(f"failed: nothing computes the row '{what}' again: {command}")
        more, read = found[0]
        stated = re.findall(NUMBER, re.sub(REMARKS, "", figure))
        measured = read(self.output(command, more))
        place = next((place for words, place in EACH.items() if what.startswith(words)), None)
        measured = measured if place is None else [measured[place]]
        if what.startswith("packets"):
            measured = measured[:1]
        if len(stated) != len(measured):
            sys.exit(f"failed: {len(stated)} figures in '{figure}', {len(measured)} are computed")
        good = all(map(agrees, stated, measured))
        print(f"{'same' if good else 'OTHER':>8}  {figure}  |  " + ", ".join(f"{x:.4g}" for x in measured), flush=True)
        return good


def main():
    root = pathlib.Path(sys.argv[1])
    word = sys.argv[2] if len(sys.argv) > 2 else ""
    table = Table(root)
    rows = [row for row in rows_of((root / "README.md").read_text()) if word in row[2]]
    bad = [row for row in rows if not table.check(*row)]
    sys.exit(f"failed: {len(bad)} of {len(rows)} rows" if bad or not rows else 0)


if __name__ == "__main__":
    main()
