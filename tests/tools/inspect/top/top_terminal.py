#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""`reckon inspect` on a terminal: started in a pseudo terminal within a network namespace of its
own, fed with datagrams, worked by keys, resized, ended by a key and by signals.

    top_terminal.py RECKON        exit status 77 = skipped, with a message
"""
import fcntl
import os
import pty
import re
import select
import signal
import socket
import struct
import subprocess
import sys
import termios
import time

GROUP, PORT = "239.1.2.3", 3000
PATIENCE = 30  # seconds until an expected text must have come
LEAVE_SCREEN = b"\x1b[?1049l"
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


def entity_state(marking: bytes, entity: int = 1, length: int = 144) -> bytes:
    header = struct.pack(">BBBBIHBB", 7, 1, 1, 1, 0, length, 0, 0)
    body = struct.pack(">HHHBB", 1, 2, entity, 1, 0) + bytes([1, 2, 0, 225, 1, 2, 3, 0]) * 2
    body += struct.pack(">fffdddfff", 0, 0, 0, 6378137, 0, 0, 0, 0, 0) + bytes(4)
    body += bytes([1]) + bytes(15 + 24) + bytes([1]) + marking.ljust(11, b"\0") + bytes(4)
    return header + body


class Terminal:
    """The program on a pseudo terminal, and the datagrams that it hears."""

    def __init__(self, program: str, environment: dict, arguments=()):
        self.master, self.slave = pty.openpty()
        self.resize(24, 150)
        self.before = termios.tcgetattr(self.slave)
        self.seen = self.everything = b""
        self.sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
        self.datagram = entity_state(b"VEHICLE1")

        def become_leader():
            os.setsid()
            fcntl.ioctl(self.slave, termios.TIOCSCTTY, 0)

        self.process = subprocess.Popen(
            [program, "inspect", f"udp://{GROUP}:{PORT}", "--iface", "lo", *arguments],
            stdin=self.slave, stdout=self.slave, stderr=self.slave, preexec_fn=become_leader,
            env={**os.environ, "TERM": "xterm-256color", **environment})

    def resize(self, rows: int, columns: int) -> None:
        fcntl.ioctl(self.master, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def press(self, keys: str) -> None:
        os.write(self.master, keys.encode())

    def pump(self) -> None:
        self.sender.sendto(self.datagram, (GROUP, PORT))
        while select.select([self.master], [], [], 0.05)[0]:
            try:
                octets = os.read(self.master, 65536)
            except OSError:  # the other side is closed
                return
            self.seen += octets
            self.everything += octets

    def expect(self, pattern: str) -> None:
        """Sends datagrams until the terminal was sent this since the last call."""
        end = time.monotonic() + PATIENCE
        while not re.search(pattern.encode(), self.seen):
            if time.monotonic() > end or self.process.poll() is not None:
                sys.exit(f"never saw {pattern!r}; got {self.seen!r}")
            self.pump()
        self.seen = b""

    def expect_end(self) -> bytes:
        """Waits for the program's end and checks that it left the terminal as it was."""
        end = time.monotonic() + PATIENCE
        while self.process.poll() is None:
            if time.monotonic() > end:
                sys.exit("does not end")
            self.pump()
        self.pump()
        assert LEAVE_SCREEN in self.seen, f"the screen was not given back: {self.seen!r}"
        assert termios.tcgetattr(self.slave) == self.before, "terminal settings changed"
        return self.seen


def keys_and_sizes(program: str) -> None:
    terminal = Terminal(program, {})
    terminal.expect("VEHICLE1")
    terminal.press("/knd == 1\r")
    terminal.expect("no field 'knd'")
    terminal.press("\x7f" * 20 + "marking == other\r")
    terminal.expect("no entity passes")
    terminal.press("/" + "\x7f" * 20 + "\r")
    terminal.expect("VEHICLE1")
    for rows, columns in ((1, 1), (2, 20), (3, 200), (24, 150)):
        terminal.resize(rows, columns)
        terminal.pump()
    terminal.press("\r")
    terminal.expect("location")
    terminal.press("b")
    terminal.expect("datagrams")
    terminal.press("c")
    terminal.expect("broke a rule")
    terminal.press("c")
    terminal.expect("VEHICLE1")
    terminal.press("q")
    said = terminal.expect_end()
    assert b"lost before they reached us" in said, said
    assert terminal.process.returncode == 0


def ends_by(program: str, how) -> None:
    terminal = Terminal(program, {})
    terminal.expect("VEHICLE1")
    how(terminal)
    terminal.expect_end()
    assert terminal.process.returncode == 0


def colours(program: str, environment: dict, wanted: bool) -> None:
    terminal = Terminal(program, environment)
    terminal.datagram = entity_state(b"GOOD") + entity_state(b"BROKEN", 2, 9000)
    terminal.expect("E-TRUNCATED")
    terminal.pump()
    assert (b"\x1b[31m" in terminal.everything) == wanted, terminal.everything
    terminal.press("q")
    terminal.expect_end()


def main() -> None:
    if "RECKON_IN_NAMESPACE" not in os.environ:
        into_namespace()
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    program = sys.argv[1]
    keys_and_sizes(program)
    ends_by(program, lambda terminal: terminal.press("\x03"))
    ends_by(program, lambda terminal: terminal.process.send_signal(signal.SIGTERM))
    colours(program, {"NO_COLOR": ""}, True)
    colours(program, {"NO_COLOR": "1"}, False)
    print("good")


if __name__ == "__main__":
    main()
