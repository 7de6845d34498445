# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that the memory of a program does not grow. Standard library."""
import pathlib

from testbed import Failure, check


def resident(program):
    """[KiB] of the program started by `ip netns exec`, which replaces itself by it."""
    for line in pathlib.Path(f"/proc/{program.process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1])
    raise Failure(f"no memory of process {program.process.pid}; {program.error_text()}")


def judge(name, rows, settled, growth):
    """Prints the memory of a program, from (seconds, KiB), and fails if it grew by more than `growth` [KiB] after
    `settled` [s]. None: the run was too short for a check, which is printed."""
    kept = [kib for seconds, kib in rows if seconds >= (settled or 0)]
    if not kept:
        return
    if settled is None:
        print(f"{name}: {kept[0]} KiB resident at first, {max(kept)} at most; growth is not judged in so short a run: rings of datagrams fill first")
        return
    grown = max(kept) - kept[0]
    print(f"{name}: {kept[0]} KiB resident after {settled:.0f} s, when its rings were full, {max(kept)} at most, {kept[-1]} at last")
    check(grown <= growth, f"{name} grew by {grown} KiB, more than {growth:.0f}")
