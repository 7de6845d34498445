#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A flood as fast as one core can send it, into the group in which two hands touch, on loopback in a network namespace: how
long a touch is under way meanwhile, whether memory grows, and how soon all is as before. The rate of the flood is told. Each flood
twice: of the one group of all, and, where what is felt has groups of its own, of that of the cell, which then must not tell."""
import argparse
import json
import os
import subprocess
import sys
import threading
import time

import memory
import testbed
from testbed import Failure, Program, Skip, check

MOST_LATE_US = 5000   # p99 of a touch, servo to servo
MOST_GROWN_KIB = 1024  # of resident memory, beyond the growth in the same time without a flood
MOST_TOLD = 1.15       # p99 of touches in groups of their own, as a factor of p99 without a flood, and
MOST_TOLD_US = 100     # this additional time: both have only some hundreds of touches
POOL = 16              # of the study: contact groups have numbers higher by this than the groups of their cells
BEGUN = 6.0            # [s] after the start of the touches, when the memory that a flood needs has been allocated
RECOVERY = 1.0        # [s] after the flood until touches take their earlier time
AFTER = 28            # [s] of touches after it: 300, so that p99 is not the maximum, which the machine may cause
KINDS = {"junk": "max", "states": "max", "runs": "max",
         "crowd": "60000",  # the greatest rate that no peer mutes: 540,000 states a second
         "hosts": "max"}    # from eight addresses, none of which is muted


def busiest_group(namespace, seconds):
    """The address and port with most of the longer datagrams: those of the hands."""
    script = f"""
import collections, socket, struct, time
sniffer = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(3))
sniffer.bind(("lo", 0))
sniffer.settimeout(0.2)
seen, end = collections.Counter(), time.monotonic() + {seconds}
while time.monotonic() < end:
    try:
        frame = sniffer.recv(4096)
    except TimeoutError:
        continue
    if len(frame) > 242 and frame[12:14] == b"\\x08\\x00" and frame[23] == 17 and frame[30] >= 224:
        seen[(socket.inet_ntoa(frame[30:34]), struct.unpack(">H", frame[36:38])[0])] += 1
(address, port), _ = seen.most_common(1)[0]
print(address, port)
"""
    done = subprocess.run(["ip", "netns", "exec", namespace, sys.executable, "-c", script], capture_output=True, text=True)
    check(done.returncode == 0, f"nothing heard of the hands: {done.stderr[-200:]}")
    address, port = done.stdout.split()
    return address, port


class Touches:
    """The study of latency as a program: two peers with all their threads. Its memory is measured throughout."""

    def __init__(self, namespace, reckon, seconds, apart):
        self.seconds = seconds
        self.memory = []  # (seconds since the start, KiB)
        self.program = Program(["ip", "netns", "exec", namespace, reckon, "bench", "latency", "--json", "--for", f"{seconds}s"]
                               + (["--contact-groups"] if apart else []))
        self._watcher = threading.Thread(target=self._watch, daemon=True)
        self._watcher.start()

    def _watch(self):
        while self.program.process.poll() is None:
            try:  # ip replaces itself by the program
                kib = memory.resident(self.program)
            except (OSError, Failure):
                return
            self.memory.append((time.monotonic() - self.program.started, kib))
            time.sleep(0.25)

    def finish(self):
        self.program.wait(600)
        self._watcher.join()
        check(self.program.process.returncode == 0 and self.program.lines, f"bench latency: {self.program.error_text()}")
        return json.loads(self.program.lines[-1][1])

    def grown(self):
        """Resident memory after settling, and its later growth [KiB]. Rings of datagrams fill for the first time in
        the first third, tables at the start of the flood; in the last second threads end."""
        settled = [kib for at, kib in self.memory if max(self.seconds / 3, BEGUN) <= at <= self.seconds - 1]
        return (settled[0], max(settled) - settled[0]) if settled else (0, 0)


def cell_of(address):
    """The group of a cell, from its contact group."""
    *rest, last = address.split(".")
    check(int(last) > POOL, f"{address} is no contact group: the hands do not touch in one")
    return ".".join([*rest, str(int(last) - POOL)])


def told(name, result):
    touch = result["touch_us"]
    print(f"  {name:14} touch p50 {touch['p50']:7.0f}  p99 {touch['p99']:7.0f}  p99.9 {touch['p999']:7.0f} us,"
          f" {result['touches']} touches, {result['missed']} not shown in time; ping p99 {result['there_us']['p99']:.0f} us,"
          f" servo steps {result['servo_step_us']['max'] / 1000:.1f} ms apart at most"
          + ("" if result["real_time"] else ", their SCHED_FIFO given up"), flush=True)
    return touch["p99"]


def flooded(namespace, options, kind, apart):
    """One kind of flood: started while the hands touch, ended after them."""
    touches = Touches(namespace, options.reckon, options.seconds + 2, apart)
    time.sleep(1.5)
    address, port = busiest_group(namespace, 2.5)  # they find each other, then pings run for half a second
    if apart:
        address = cell_of(address)
    flood = Program(["ip", "netns", "exec", namespace, options.flood, "127.0.0.1", address, port, KINDS[kind],
                     str(options.seconds + 4), kind])
    result = touches.finish()
    flood.wait(600)
    check(flood.process.returncode == 0 and flood.lines, f"flood: {flood.error_text()}")
    rate = json.loads(flood.lines[-1][1])["per_s"]
    late, (settled, grown) = told(f"{kind}{', apart' if apart else ''}:", result), touches.grown()
    print(f"  {'':14} {rate / 1000:.0f} thousand datagrams/s sent to {address}:{port}; memory {settled} KiB, {grown} more at most",
          flush=True)
    time.sleep(RECOVERY)
    return late, grown, rate, result


def all_floods(namespace, options, apart):
    """Faults; empty if there are none."""
    faults = []
    quiet = Touches(namespace, options.reckon, options.seconds + 2, apart)
    late_quiet = told("quiet, apart:" if apart else "quiet:", quiet.finish())
    settled, grown_quiet = quiet.grown()  # the study stores its measurements
    print(f"  {'':14} memory {settled} KiB, {grown_quiet} more at most", flush=True)
    for kind in options.kinds:
        late, grown, rate, result = flooded(namespace, options, kind, apart)
        after = told("after it:", Touches(namespace, options.reckon, AFTER, apart).finish())
        if rate < 20_000:
            raise Skip("this machine is too busy to flood")
        name = f"{kind}, apart" if apart else kind
        most = MOST_TOLD * late_quiet + MOST_TOLD_US
        for fault, what in ((late > MOST_LATE_US, f"{name}: touches take {late:.0f} us"),
                            (apart and late > most, f"{name}: touches take {late:.0f} us, {late_quiet:.0f} without it"),
                            (result["touches"] == 0, f"{name}: no touch came through"),
                            (apart != (result["felt"] > 0), f"{name}: {result['felt']} updates in contact groups"),
                            (grown > grown_quiet + MOST_GROWN_KIB, f"{name}: memory grew by {grown} KiB"),
                            (after > MOST_LATE_US, f"{name}: touches take {after:.0f} us after it")):
            if fault:
                faults.append(what)
    return faults


def overload(options):
    testbed.need_root_and_ip()
    namespace = f"{testbed.PREFIX}{os.getpid()}-lo"
    testbed.ip("netns", "add", namespace)
    faults = []
    try:
        testbed.ip("-n", namespace, "link", "set", "lo", "up", "multicast", "on")
        testbed.ip("-n", namespace, "route", "add", "224.0.0.0/4", "dev", "lo")
        for apart in (False, True):
            faults += all_floods(namespace, options, apart)
    finally:
        subprocess.run(["ip", "netns", "delete", namespace], capture_output=True)
    if faults:
        raise Failure("; ".join(faults))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--flood", required=True)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--kinds", nargs="*", default=list(KINDS), choices=list(KINDS))
    options = parser.parse_args()
    try:
        overload(options)
    except Skip as reason:
        print(f"skipped: {reason}")
        return testbed.SKIP
    except Failure as sentence:
        print(f"FAILED: {sentence}")
        return 1
    print("passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
