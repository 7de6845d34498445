# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A program on a pseudo-terminal, with its output, typed keys and resizes; in a network namespace of its own."""
import fcntl
import os
import pty
import re
import select
import struct
import subprocess
import sys
import termios
import time

PATIENCE = 30  # seconds within which an expected text must arrive
ENTER_SCREEN, LEAVE_SCREEN = b"\x1b[?1049h", b"\x1b[?1049l"
SKIPPED = 77


def skip(reason: str) -> None:
    print("skipped:", reason)
    sys.exit(SKIPPED)


def into_namespace() -> None:
    user = [] if os.geteuid() == 0 else ["--map-root-user"]
    probe = subprocess.run(["unshare", "--net", *user, "ip", "link", "set", "lo", "up"],
                           capture_output=True, check=False)
    if probe.returncode != 0:
        skip("no network namespace: " + probe.stderr.decode().strip())
    os.environ["RECKON_IN_NAMESPACE"] = "1"
    os.execvp("unshare", ["unshare", "--net", *user, sys.executable, *sys.argv])


class Terminal:
    """`command` on a pseudo-terminal. An environment variable with the value None is unset."""

    def __init__(self, command, environment=None, rows=24, columns=80, stdin=True):
        self.master, self.slave = pty.openpty()
        self.resize(rows, columns)
        self.before = termios.tcgetattr(self.slave)
        self.seen = self.everything = b""
        wanted = {**os.environ, "TERM": "xterm-256color", **(environment or {})}

        def become_leader():
            os.setsid()
            fcntl.ioctl(self.slave, termios.TIOCSCTTY, 0)
            if not stdin:
                os.close(0)

        self.process = subprocess.Popen(
            command, stdin=self.slave, stdout=self.slave, stderr=self.slave, preexec_fn=become_leader,
            env={name: value for name, value in wanted.items() if value is not None})

    def resize(self, rows, columns):
        fcntl.ioctl(self.master, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def press(self, keys):
        os.write(self.master, keys.encode())

    def feed(self):
        """Keeps the program busy; for subclasses that need it."""

    def pump(self):
        self.feed()
        while select.select([self.master], [], [], 0.05)[0]:
            try:
                octets = os.read(self.master, 65536)
            except OSError:  # the other side is closed
                return
            self.seen += octets
            self.everything += octets

    def expect(self, pattern):
        """Reads until the terminal has received this text since the last call; returns the text read."""
        end = time.monotonic() + PATIENCE
        while not re.search(pattern.encode(), self.seen):
            if time.monotonic() > end or self.process.poll() is not None:
                sys.exit(f"never saw {pattern!r}; got {self.seen!r}")
            self.pump()
        seen, self.seen = self.seen, b""
        return seen

    def expect_end(self, drawn=True):
        """Waits for the program's end and checks that it restored the terminal."""
        end = time.monotonic() + PATIENCE
        while self.process.poll() is None:
            if time.monotonic() > end:
                sys.exit("does not end")
            self.pump()
        self.pump()
        assert (LEAVE_SCREEN in self.everything) == drawn, f"drawn, or not given back: {self.seen!r}"
        assert termios.tcgetattr(self.slave) == self.before, "terminal settings changed"
        os.close(self.master)
        os.close(self.slave)
        return self.seen
