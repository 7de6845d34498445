#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Octets and CPU time of `reckon view` for each page, of one program or of several in turn.

    bench/micro/page_costs.py build/release/reckon [OTHER] [--entities 1000] [--moving 0.1] [--rounds 3]

Plain DIS on loopback: land vehicles, some of which drive in circles with an update a second. Pages
are WebSocket clients that acknowledge each picture. CPU time is the user's and kernel's of all
threads of the program, as /proc counts it in nanoseconds: a round without a page, with one, with
nine. Prints medians as Markdown, with the least and the largest.
"""
import argparse
import base64
import math
import os
import re
import selectors
import socket
import statistics
import struct
import subprocess
import threading
import time
import zlib

RADIUS, SPEED, WGS84_A = 200.0, 10.0, 6378137.0
HEARTBEAT = 4.0  # [s], of those that stand
TOGETHER = 8     # PDUs in a datagram
MORE = 8         # pages beside the first
DEFLATE = "Sec-WebSocket-Extensions: permessage-deflate; client_max_window_bits\r\n"


def entity_state(entity, now, moves):
    """A vehicle, with dead reckoning by velocity (FPW)."""
    timestamp = int(now % 3600 / 3600 * (2**31 - 1)) << 1 | 1
    angle = (SPEED / RADIUS * now if moves else 0) + 2.4 * entity
    speed = SPEED if moves else 0.0
    middle = 500.0 * (entity % 100), 500.0 * (entity // 100)
    body = struct.pack(">HHHBB", 1, 2, entity, 1 + entity % 2, 0) + bytes([1, 1, 0, 225, 1, 1, 0, 0]) + bytes(8)
    body += struct.pack(">3f", 0, -speed * math.sin(angle), speed * math.cos(angle))
    body += struct.pack(">3d", WGS84_A, middle[0] + RADIUS * math.cos(angle), middle[1] + RADIUS * math.sin(angle))
    body += struct.pack(">3fI", 0, -math.pi / 2, angle, 0) + bytes([2]) + bytes(39) + bytes([1])
    body += b"V%d" % entity + bytes(11 - len(b"V%d" % entity)) + struct.pack(">I", 0)
    return struct.pack(">BBBBIHBB", 7, 1, 1, 1, timestamp, 12 + len(body), 0, 0) + body


class Sender(threading.Thread):
    """Sends the updates that are due, a few in each datagram."""

    def __init__(self, port, entities, moving):
        super().__init__(daemon=True)
        self.to, self.entities, self.moving = ("127.0.0.1", port), entities, moving
        self.ended = threading.Event()

    def run(self):
        sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        due = [(i % 100 / 100, i) for i in range(1, self.entities + 1)]
        share = self.moving * self.entities
        begin, waiting = time.time(), []
        due.sort()
        schedule = [(at, i, i <= share) for at, i in due]
        while not self.ended.wait(0.01):
            now = time.time()
            late = [row for row in schedule if row[0] <= now - begin]
            if not late:
                continue
            schedule = schedule[len(late):]
            waiting = [entity_state(i, now, moves) for _, i, moves in late]
            schedule += [(at + (1.0 if moves else HEARTBEAT), i, moves) for at, i, moves in late]
            schedule.sort()
            for first in range(0, len(waiting), TOGETHER):
                sock.sendto(b"".join(waiting[first:first + TOGETHER]), self.to)


class Page:
    """A client that acknowledges each picture when it has come whole."""

    def __init__(self, port, offer):
        self.sock = socket.create_connection(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        host = f"127.0.0.1:{port}"
        self.sock.sendall((f"GET /stream HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nUpgrade: websocket\r\n"
                           f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n{offer}\r\n").encode())
        self.octets = self.pictures = 0
        self.inflater = zlib.decompressobj(-15)
        self.kept = b""
        self.has_head = False

    def take(self):
        octets = self.sock.recv(1 << 20)
        self.octets += len(octets)
        self.kept += octets
        if not self.has_head:
            head, found, rest = self.kept.partition(b"\r\n\r\n")
            self.has_head, self.kept = bool(found), rest if found else head
        while self.has_head and self._frame():
            pass

    def _frame(self):
        if len(self.kept) < 2:
            return False
        size, at = self.kept[1], 2
        if size >= 126:
            at = 4 if size == 126 else 10
            if len(self.kept) < at:
                return False
            size = int.from_bytes(self.kept[2:at], "big")
        if len(self.kept) < at + size:
            return False
        payload = self.kept[at:at + size]
        if self.kept[0] & 0x40:
            payload = self.inflater.decompress(payload + b"\0\0\xff\xff")
        if self.kept[0] & 0x0F == 2:
            self.pictures += 1
            self.sock.sendall(bytes([0x82, 0x85, 0, 0, 0, 0, 1]) + payload[4:8])
        self.kept = self.kept[at + size:]
        return True


def cpu_seconds(process):
    """Of all threads, children included."""
    total = 0.0
    for pid in [process.pid, *children(process.pid)]:
        for task in os.listdir(f"/proc/{pid}/task"):
            with open(f"/proc/{pid}/task/{task}/schedstat", encoding="ascii") as file:
                total += int(file.read().split()[0]) / 1e9
    return total


def children(pid):
    with open(f"/proc/{pid}/task/{pid}/children", encoding="ascii") as file:
        return [int(word) for word in file.read().split()]


def look(selector, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for key, _ in selector.select(0.05):
            key.data.take()


def measure(program, options, udp_port):
    """CPU [s/s] with no page, one and 1 + MORE; octets and pictures a second of a page."""
    process = subprocess.Popen([program, "view", f"udp://127.0.0.1:{udp_port}", "--port", "0"],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        address = ""
        while not (found := re.search(r"http://127\.0\.0\.1:(\d+)", address)):
            address = process.stdout.readline()
        threading.Thread(target=process.stdout.read, daemon=True).start()
        time.sleep(6)
        cpu, pages, result = [], [], {}
        selector = selectors.DefaultSelector()
        for count in (0, 1, 1 + MORE):
            while len(pages) < count:
                pages.append(Page(int(found[1]), "" if options.plain else DEFLATE))
                selector.register(pages[-1].sock, selectors.EVENT_READ, pages[-1])
            look(selector, 2)
            before = cpu_seconds(process), time.monotonic(), [(page.octets, page.pictures) for page in pages]
            look(selector, options.seconds)
            span = time.monotonic() - before[1]
            cpu.append((cpu_seconds(process) - before[0]) / span)
            if pages:
                result["octets"] = statistics.mean((page.octets - old[0]) / span for page, old in zip(pages, before[2]))
                result["pictures"] = statistics.mean((page.pictures - old[1]) / span for page, old in zip(pages, before[2]))
        result["none"], result["first"], result["more"] = cpu[0], cpu[1] - cpu[0], (cpu[2] - cpu[1]) / MORE
        return result
    finally:
        process.terminate()
        process.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--entities", type=int, nargs="+", default=[1000])
    parser.add_argument("--moving", type=float, nargs="+", default=[0.1, 1.0])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--plain", action="store_true", help="pages do not offer compression")
    options = parser.parse_args()
    print("| entities | moving | program | kB/s | pictures/s | no page % | first page % | each more % | us a picture |\n|" + 9 * "---|")
    for entities in options.entities:
        for moving in options.moving:
            rows = {program: [] for program in options.programs}
            for turn in range(options.rounds):
                for k, program in enumerate(options.programs):
                    port = 21000 + 10 * turn + k
                    sender = Sender(port, entities, moving)
                    sender.start()
                    rows[program].append(measure(program, options, port))
                    sender.ended.set()
            for program, found in rows.items():
                def text(key, scale, digits):
                    values = sorted(scale(row) for row in found)
                    return f"{statistics.median(values):.{digits}f} ({values[0]:.{digits}f}-{values[-1]:.{digits}f})"
                print(f"| {entities} | {100 * moving:.0f} % | {program} | " + " | ".join((
                    text("octets", lambda row: row["octets"] / 1e3, 0), text("pictures", lambda row: row["pictures"], 1),
                    text("none", lambda row: 100 * row["none"], 2), text("first", lambda row: 100 * row["first"], 2),
                    text("more", lambda row: 100 * row["more"], 2),
                    text("us", lambda row: 1e6 * row["more"] / max(row["pictures"], 1), 0))) + " |", flush=True)


if __name__ == "__main__":
    main()
