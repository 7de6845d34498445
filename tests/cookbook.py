# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs each block of commands of docs/cookbook.md as a reader pastes it, in a folder with links to the sources that they name.

  cookbook.py ROOT BUILD              status 1, and the output, where a block fails or does not print the line below it
  cookbook.py ROOT BUILD --planted    wants each fault of PLANTED to be found

A block of Python is skipped where the module is not built.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

TASKS = 12
SECONDS = 120  # of one block, on a busy machine
LINKS = ("scenes", "tests/consumer", "python")

BLOCK = "```sh\n{}\n```\n\n```text\n{}\n```\n"
PLANTED = [  # a block that fails, one that prints something else, one without a line
    BLOCK.format("echo done; false", "done"),
    BLOCK.format("echo 2 PDUs", "3 PDUs"),
    "```sh\necho 2 PDUs\n```\n",
]


def blocks_of(page):
    """(task, commands, line below them or None)."""
    for section in re.split(r"^## ", page, flags=re.M)[1:]:
        for commands, line in re.findall(r"^```sh\n(.*?)^```\n(?:\n```text\n(.*?)\n```)?", section, re.M | re.S):
            yield section.split("\n")[0], commands, line


def is_printed(line, output):
    """Whether the output has the line; `..` stands for anything, and a space for spaces."""
    words = re.escape(line).replace(r"\ \.\.", r"(?: .*)?").replace(r"\.\.", ".*").replace(r"\ ", r" +")
    return re.search(rf"^ *{words}", output, re.M) is not None


class Kitchen:
    def __init__(self, root, build, folder):
        self._folder = folder
        (folder / "build").mkdir()
        (folder / "tests").mkdir()
        (folder / "build/release").symlink_to(build)
        for link in LINKS:
            (folder / link).symlink_to(root / link)
        self._module = build / "python"
        if any(self._module.glob("reckon/_native*.so")):
            (folder / "build/python/bin").mkdir(parents=True)
            python = folder / "build/python/bin/python"
            python.write_text(f'#!/bin/sh\nPYTHONPATH="{self._module}" exec /usr/bin/python3 -B "$@"\n')
            python.chmod(0o755)
        self._environment = dict(os.environ, PATH=f"{build}:{os.environ['PATH']}", TERM="dumb")

    def lacks(self, commands):
        return "the Python module" if "build/python" in commands and not (self._folder / "build/python").exists() else None

    def problem_of(self, commands, line):
        """Why a reader does not get the line; None if he does."""
        if not line:
            return "no line says what it prints"
        try:
            done = subprocess.run(["bash", "-e", "-c", commands], cwd=self._folder, env=self._environment, text=True, timeout=SECONDS,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        except subprocess.TimeoutExpired:
            return f"it does not end in {SECONDS} s"
        if done.returncode:
            return f"exit status {done.returncode}\n{done.stdout[-3000:]}"
        return None if is_printed(line, done.stdout) else f"no line is: {line}\n{done.stdout[-3000:]}"


def main():
    root, build = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    planted = "--planted" in sys.argv
    page = "".join(f"## planted {number}\n{text}" for number, text in enumerate(PLANTED)) if planted else (
        root / "docs/cookbook.md").read_text(encoding="utf-8")
    blocks, failed = list(blocks_of(page)), 0
    tasks = {task for task, _, _ in blocks}
    if not planted and len(tasks) < TASKS:
        sys.exit(f"failed: only {len(tasks)} tasks have commands")
    with tempfile.TemporaryDirectory() as folder:
        kitchen = Kitchen(root, build, pathlib.Path(folder))
        for task, commands, line in blocks:
            begun = time.monotonic()
            if lacking := kitchen.lacks(commands):
                print(f"skipped  {task}: {lacking} is not built")
                continue
            problem = kitchen.problem_of(commands, line)
            failed += problem is not None
            print(f"{time.monotonic() - begun:6.1f} s  {'FAILED' if problem else 'ok    '}  {task}" + (f"\n{problem}" if problem else ""), flush=True)
    if planted:
        sys.exit(0 if failed == len(PLANTED) else "failed: a planted fault was not found")
    sys.exit(f"failed: {failed} of {len(blocks)} blocks" if failed else 0)


if __name__ == "__main__":
    main()
