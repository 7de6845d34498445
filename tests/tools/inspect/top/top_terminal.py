#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""`reckon inspect` on a terminal: started in a pseudo-terminal within a network namespace, with incoming datagrams,
keys and resizes, ended by a key and by signals.

    top_terminal.py RECKON        exit status 77 = skipped, with a message
"""
import os
import pathlib
import signal
import socket
import struct
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import pseudo_terminal  # noqa: E402

GROUP, PORT = "239.1.2.3", 3000


def entity_state(marking: bytes, entity: int = 1, length: int = 144) -> bytes:
    header = struct.pack(">BBBBIHBB", 7, 1, 1, 1, 0, length, 0, 0)
    body = struct.pack(">HHHBB", 1, 2, entity, 1, 0) + bytes([1, 2, 0, 225, 1, 2, 3, 0]) * 2
    body += struct.pack(">fffdddfff", 0, 0, 0, 6378137, 0, 0, 0, 0, 0) + bytes(4)
    body += bytes([1]) + bytes(15 + 24) + bytes([1]) + marking.ljust(11, b"\0") + bytes(4)
    return header + body


class Terminal(pseudo_terminal.Terminal):
    """The program on a pseudo-terminal, and the datagrams sent to it."""

    def __init__(self, program: str, environment: dict, arguments=()):
        self.sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
        self.datagram = entity_state(b"VEHICLE1")
        command = [program, "inspect", f"udp://{GROUP}:{PORT}", "--iface", "lo", *arguments]
        super().__init__(command, environment, 24, 150)

    def feed(self):
        self.sender.sendto(self.datagram, (GROUP, PORT))


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
    terminal.expect("broke an octet rule")
    terminal.press("c")
    terminal.expect("VEHICLE1")
    terminal.press("q")
    said = terminal.expect_end()
    assert b"lost before they reached this program" in said, said
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
        pseudo_terminal.into_namespace()
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
