#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""`bench scale --whole hosts` with an ssh of our own that stays on this machine: hosts.py CASE --reckon PROGRAM"""
import argparse
import json
import os
import pathlib
import signal
import stat
import subprocess
import tempfile
import time

# What stands for ssh: HOST says what is wrong with it.
SSH = """#!/bin/sh
echo "$1: $2" >>"$FAKE_LOG"
case $1 in
  down*) echo "ssh: connect to host $1 port 22: No route to host" >&2; exit 255 ;;
  bare*) echo "sh: 1: reckon: not found" >&2; exit 127 ;;
  old*) echo "reckon 0.0.1"; exit 0 ;;
  deaf*) case $2 in *--share*) echo "reckon bench: unknown flag --share" >&2; exit 2 ;; esac ;;
  other*) case $2 in *--share*) echo '{"kind":"ready","scene":1}'; exec cat >/dev/null ;; esac ;;
  dies*) case $2 in *--share*) exec timeout -s KILL 4 sh -c "$2" ;; esac ;;
esac
exec sh -c "$2"
"""
SMALL = ["--peers", "4", "--entities", "12", "--rate", "10", "--movement", "walkers"]


class Bench:
    def __init__(self, reckon):
        self.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(self.folder.name)
        self.ssh, self.log = root / "fake_ssh", root / "log"
        self.ssh.write_text(SSH)
        self.ssh.chmod(self.ssh.stat().st_mode | stat.S_IXUSR)
        self.log.touch()
        self.reckon = pathlib.Path(reckon).resolve()
        self.environment = dict(os.environ, FAKE_LOG=str(self.log), PATH=f"{self.reckon.parent}:{os.environ['PATH']}")

    def command(self, hosts, *words, ssh=None):
        words = words if "--for" in words else [*words, "--for", "2s"]
        return [str(self.reckon), "bench", "scale", "--whole", "hosts", "--hosts", hosts, "--ssh", ssh or str(self.ssh), *SMALL, *words]

    def run(self, hosts, *words, ssh=None):
        return subprocess.run(self.command(hosts, *words, ssh=ssh), env=self.environment, capture_output=True, text=True, timeout=120)


def together(bench):
    """Peers of three hosts hear one another, and each host has its share."""
    result = bench.run("a=lo,b=lo,c=lo", "--json")
    assert result.returncode == 0, result.stderr
    row = next(r for r in map(json.loads, result.stdout.splitlines()) if r["kind"] == "whole")
    assert row["meeting"] == "processes on several hosts" and row["peers"] == 4, row
    assert row["looks"] > 100 and row["lost"] == 0, row
    # Where all come at once, one or two entities are first heard when they are said again: 1, 2 or 4 s later.
    assert row["overdue"] < 0.1 * row["looks"], row
    assert row["heard_packets_per_s"] > 1 and row["cpu_share"] > 0 and row["memory_octets"] > 1e5, row
    # What two processes take for the same instant differs by a word's way at most: nobody runs a metre in that.
    assert row["pose_error_p99_m"] < 1.5, row
    shares = sorted(line.split("--share ")[1].split()[0] for line in bench.log.read_text().splitlines() if "--share" in line)
    assert shares == ["1-1='lo'", "2-2='lo'", "3-4='lo'"], shares


def refusals(bench):
    """What a host lacks is told with its name and the remedy, before anything begins."""
    for hosts, *said in [
        ("a=lo,down1", "host down1", "cannot be reached", "without a question"),
        ("bare1,a=lo", "host bare1", "no reckon in the PATH"),
        ("a=lo,old1", "host old1", "'reckon 0.0.1'", "install the same version"),
        ("a=lo,deaf1", "host deaf1", "has an incompatible reckon"),
        ("a=lo,other1=lo", "host other1", "a different exercise"),
        ("a=lo,b=nowhere0", "host b", "cannot use its network", "nowhere0"),
    ]:
        began = time.monotonic()
        result = bench.run(hosts)
        assert result.returncode == 3, (hosts, result.returncode, result.stderr)
        for text in said:
            assert text in result.stderr, (text, result.stderr)
        assert result.stdout == "" and time.monotonic() - began < 30, (hosts, result.stdout)
    result = bench.run("a=lo", ssh="/nowhere/ssh")
    assert result.returncode == 3 and "/nowhere/ssh" in result.stderr, result.stderr
    for hosts, said in [("a,a", "twice"), ("-oProxyCommand=x", "neither HOST"), ("a,,b", "neither HOST"), ("a,b,c,d,e", "--peers")]:
        result = bench.run(hosts)
        assert result.returncode == 2 and said in result.stderr, (hosts, result.stderr)


def early_end(bench):
    """A host that goes while it runs ends the run, and nothing is left behind."""
    result = bench.run("a=lo,dies1=lo")
    assert result.returncode == 3 and "host dies1: ended early, with status 137" in result.stderr, result.stderr
    assert result.stdout == ""
    nobody_left(bench)


def stopped(bench):
    """Who stops the study stops all hosts."""
    process = subprocess.Popen(bench.command("a=lo,b=lo", "--for", "60s"), env=bench.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while bench.log.read_text().count("--share") < 2 and time.monotonic() < deadline:
        time.sleep(0.1)
    time.sleep(2)
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=30)
    assert process.returncode == 0 and "stopped" in errors and " peers with " in out, (process.returncode, out, errors)
    nobody_left(bench)


def nobody_left(bench):
    """No process with this run's log in its environment is there any more."""
    deadline, left = time.monotonic() + 10, []
    while time.monotonic() < deadline:
        left = [p for p in pathlib.Path("/proc").glob("[0-9]*") if p.name != str(os.getpid()) and str(bench.log) in environment_of(p)]
        if not left:
            return
        time.sleep(0.2)
    raise AssertionError(f"still there: {[p.joinpath('cmdline').read_text() for p in left]}")


def environment_of(process):
    try:
        return process.joinpath("environ").read_text(errors="replace")
    except OSError:
        return ""


CASES = {case.__name__: case for case in (together, refusals, early_end, stopped)}

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", choices=CASES)
    parser.add_argument("--reckon", required=True)
    options = parser.parse_args()
    CASES[options.case](Bench(options.reckon))
