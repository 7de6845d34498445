# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The systemd unit of the recorder: it is valid, it bounds what lies in its folder, and `reckon record` makes no call that it refuses.
recorder_unit.py UNIT RECKON; status 77 where systemd-analyze or strace is missing."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def started(unit, key, folder, *before, **variables):
    """Runs a line of the unit as systemd does, but for its sandbox."""
    command = re.search(rf"^{key}=/bin/sh -c '(.*)'$", unit, re.M)[1].replace("%%", "%")
    return subprocess.run([*before, "/bin/sh", "-c", command], env={**os.environ, "STATE_DIRECTORY": folder, **variables},
                          capture_output=True, text=True)


def calls_of(name):
    """The system calls of a group, groups in it too."""
    lines = subprocess.run(["systemd-analyze", "syscall-filter", name], capture_output=True, text=True, check=True).stdout.split("\n")[1:]
    words = [line.strip() for line in lines if line.strip() and not line.strip().startswith("#")]
    return {call for word in words for call in (calls_of(word) if word.startswith("@") else {word})}


def allowed_calls(unit):
    allowed = set()
    for rule in re.findall(r"^SystemCallFilter=(.*)$", unit, re.M):
        calls = {call for word in rule.lstrip("~").split() for call in (calls_of(word) if word.startswith("@") else {word})}
        allowed = allowed - calls if rule.startswith("~") else allowed | calls
    return allowed


def problems_of(unit, folder):
    path = pathlib.Path(folder, "reckon-record.service")
    path.write_text(unit)
    yield from subprocess.run(["systemd-analyze", "verify", "--man=no", path], capture_output=True, text=True).stderr.splitlines()
    path.unlink()
    for day in range(5):
        pathlib.Path(folder, f"2026010{day}T000000Z_00001.pcapng.zst").write_bytes(os.urandom(400_000))
    started(unit, "ExecStartPre", folder, KEEP_MB="1")
    left = sorted(name[7] for name in os.listdir(folder))
    if left != ["3", "4"]:
        yield f"of five recordings of 0.4 MB the unit leaves {left}, not the newest within 1 MB"
    trace = pathlib.Path(folder, "trace")
    result = started(unit, "ExecStart", folder, "strace", "-f", "-qq", "-o", trace, KEEP_MB="1",
                     RECORD="--iface lo --for 1s --metrics 127.0.0.1:0")
    if result.returncode != 0:
        yield f"the recorder ended with {result.returncode}: {result.stderr}"
    made = set(re.findall(r"^\d+ +(\w+)\(", trace.read_text(), re.M))
    yield from (f"the unit refuses {call}, which the recorder calls" for call in sorted(made - allowed_calls(unit)))


if not all(map(shutil.which, ("systemd-analyze", "strace"))):
    print("skipped: systemd-analyze or strace is not there")
    sys.exit(77)
with tempfile.TemporaryDirectory() as scratch:
    problems = list(problems_of(pathlib.Path(sys.argv[1]).read_text().replace("/usr/bin/reckon", sys.argv[2]), scratch))
print("\n".join(problems) or "the unit is valid, bounds its folder, and lets the recorder work")
sys.exit(1 if problems else 0)
