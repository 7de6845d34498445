# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Shared parts of the failure cases: declaration of a case, paths, and a pair of peers."""
import pathlib
import re
import shutil
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import testbed  # noqa: E402
from testbed import PeerProgram, Program, Skip, Testbed, check  # noqa: E402,F401

PORT = 3000
BASE_GROUP = "239.192.1.0"
CASES = {}  # name -> (fault, bar, function)


def case(name, fault, bar):
    """Declares a case: a function of the setup that returns the measured result, or raises Failure."""
    def declare(function):
        CASES[name] = (fault, bar, function)
        return function
    return declare


class Setup:
    """Paths of programs and scenes."""

    def __init__(self, arguments, folder):
        self.folder = pathlib.Path(folder)
        self.folder.chmod(0o755)
        self.reckon = testbed.copied_program(arguments.reckon, self.folder)
        pathlib.Path(self.reckon).chmod(0o755)
        self.tests = arguments.tests
        shutil.copytree(arguments.scenes, self.folder / "scenes")
        self.scene = self.folder / "scenes/two_hands.toml"

    def testbed(self, hosts):
        return Testbed(hosts, self.reckon)

    def changed_scene(self, name, old, new):
        """The shipped scene with one part of its text replaced."""
        text = self.scene.read_text()
        check(text.count(old) == 1, f"'{old}' is not once in {self.scene}")
        path = self.folder / "scenes" / f"{name}.toml"
        path.write_text(text.replace(old, new))
        return path

    def passes(self, program, pattern):
        """Runs cases of a test program of the build; returns the number that passed."""
        found = sorted(pathlib.Path(self.tests or ".").glob(f"*/{program}")) if self.tests else []
        if not found:
            raise Skip(f"needs {program} of a build, see --tests")
        path = found[0].resolve()
        done = subprocess.run([path, f"--gtest_filter={pattern}"], capture_output=True, text=True)
        check(done.returncode == 0, done.stdout[-2000:])
        passed = done.stdout.count("[       OK ]")
        check(passed > 0, f"{program} has no test {pattern}")
        return f"{passed} tests passed"


def need(program, package):
    if shutil.which(program) is None:
        raise Skip(f"needs {program} (Debian: {package})")


def pair(bed, setup, names=("ALICE", "BOB"), scene=None, more=()):
    """A peer on host 1 and one on host 2 that see each other. `more` has options for both."""
    peers = [bed.peer(i + 1, scene or setup.scene, name, i + 1, more) for i, name in enumerate(names)]
    for peer, other in zip(peers, reversed(names)):
        check(peer.wait_event("appeared", 8, other), f"{other} was never shown; {peer.error_text()}")
    return peers


def told(peer, pattern):
    """Messages of a peer that match."""
    return [e["text"] for e in peer.events("notice") if re.search(pattern, e["text"])]


def wait_told(peer, pattern, timeout=5.0, since=0.0):
    """Waits for a message of a peer and returns its time; raises Failure if there is none."""
    found = peer.wait_line(f'"event":"notice".*{pattern}', timeout, since)
    check(found, f"'{pattern}' was not told within {timeout} s: {told(peer, '.')}")
    return found[0]


def sends_after(sniffer, host, moment, timeout=10.0, address=None):
    """Seconds from `moment` to the first datagram that a host sends after it."""
    end = time.monotonic() + timeout
    while time.monotonic() < end:
        for when, source, _, _ in list(sniffer.datagrams):
            if when >= moment and source == (address or Testbed.address(host)):
                return when - moment
        time.sleep(0.02)
    raise testbed.Failure(f"host {host} sent nothing for {timeout} s")
