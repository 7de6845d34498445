# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Computes the README's table of measured figures again, with the commands that stand in it, and compares each figure.
readme_figures.py ROOT [WORD]: only rows whose command has this word. Exit status 1 where a figure differs.

All runs are simulated: a figure is the same where it is within its last digit or 2 %, for compilers and processors
round differently."""
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
    return {
        "packets": run["raw_packets_per_s"] / run["packets_per_s"],
        "position error": 1e3 * run["pose_error_m"]["p99"],
        "error of the 2 N": run["force_error_n"]["p99"],
    }


def least_energy(text):
    return {"least energy": objects(text)[-1]["energy_min_j"]}


def presses(text):
    return {"two hands": 100 * float(re.search(r"after 3 s ([0-9.]+)", text)[1])}


def circle(text):
    rms = {(row["model"], row["curve"]): row["position_m"]["rms"] for row in objects(text)}
    return {"RMS position error": 1e6 * rms["auto", "cubic"], "the same vehicle": 1e3 * rms["rvw+adaptive", "cubic"]}


def body_owner(text):
    share = {row["setting"]: 100 * row["error_share"] for row in objects(text) if row["kind"] == "touch"}
    return {
        "a hand pushes 1 kg": share["push, 50 ms, before touch"],
        "this error": share["push, 50 ms, fixed"],
    }


def stability(text):
    modes = {row["mode"]: row for row in objects(text) if row["kind"] == "mode"}
    ours, rival = modes["reckon"], modes["passivity_controller"]
    return {
        "a hand on a remote surface": 100 * ours["made_energy"],
        "the same share": 100 * rival["made_energy"],
        "share of these": 100 * ours["right"],
        "this share": 100 * rival["right"],
    }


def figures(text):
    row = next(row for row in objects(text) if row["name"] == "4.4")
    return {"Fig 4.4": row["ours"]}


# By the words of a command: flags for output that is readable here, and the figures by the first words of their rows.
ROWS = {
    "demo --simulated-time --for 60s": ("--json", demo),
    "demo scenes/two_hands.toml": ("--json", demo),
    "SlowPress": ("", presses),
    "accuracy --circle": ("--json", circle),
    "--touch --axis owner": ("--json", body_owner),
    "bench stability": ("--json", stability),
    "--for 10min": ("--json", least_energy),
    "reckon figures": ("--json --out build/readme_figures", figures),
}
NUMBER = r"\d+(?:\.\d+)?"


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
        stated = re.findall(NUMBER, figure)
        measured = [value for words, value in read(self.output(command, more)).items() if what.startswith(words)]
        if len(stated) != 1 or len(measured) != 1:
            sys.exit(f"failed: {len(stated)} figures in '{figure}', {len(measured)} are computed")
        good = agrees(stated[0], measured[0])
        print(f"{'same' if good else 'OTHER':>8}  {figure}  |  {measured[0]:.4g}  {what}", flush=True)
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
