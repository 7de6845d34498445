# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Many peers, each a process in a network namespace of its own, on a bridge that snoops IGMP and floods nothing. One
case per call:
  namespaces_many.py CASE --roamer PROGRAM --border PROGRAM --all-groups LIBRARY
  --slow-joins LIBRARY [--count N] [--seconds S]"""
import argparse
import json
import pathlib
import socket
import struct
import sys
import threading
import time

import testbed
from testbed import Skip, Testbed, check

BASE_GROUP, PORT = "239.192.1.0", 3000
DECOYS = 16         # groups of the pool that a neighbour of each peer has joined on another interface
DECOY_PERIOD = 0.5  # [s]
LOOPBACK = 1        # index of lo in each namespace
TOO_LATE = 0.6      # [s] by which a step may be late if a peer has 1 s to show a new entity
MEMBERSHIPS = 20    # groups that Linux allows for one socket


def group(index):
    first = struct.unpack("!I", socket.inet_aton(BASE_GROUP))[0]
    return socket.inet_ntoa(struct.pack("!I", first + index))


class Neighbours:
    """In each host a program that has joined groups on lo, and sends to them there; and two programs without joined
    groups, one with IP_MULTICAST_ALL at its default and one without it, which count what they receive."""
    IP_MULTICAST_ALL = 49

    def __init__(self, bed, hosts):
        self.sent = 0
        self._senders, self._members, self._careless, self._careful = [], [], [], []
        for host in hosts:
            self._senders.append(self._sender(bed, host))
            self._members.append(self._member(bed, host))
            self._careless.append(self._listener(bed, host, True))
            self._careful.append(self._listener(bed, host, False))
        self._running = True
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    @staticmethod
    def _sender(bed, host):
        sock = bed.socket(host, socket.AF_INET, socket.SOCK_DGRAM)
        sock.bind(("127.0.0.1", 0))
        sock.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, struct.pack("4s4si", bytes(4), bytes(4), LOOPBACK))
        return sock

    @staticmethod
    def _member(bed, host):
        sock = bed.socket(host, socket.AF_INET, socket.SOCK_DGRAM)
        for index in range(min(DECOYS, MEMBERSHIPS)):
            sock.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                            struct.pack("4s4si", socket.inet_aton(group(index)), bytes(4), LOOPBACK))
        return sock

    @classmethod
    def _listener(cls, bed, host, everything):
        sock = bed.socket(host, socket.AF_INET, socket.SOCK_DGRAM)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        sock.setsockopt(socket.IPPROTO_IP, cls.IP_MULTICAST_ALL, int(everything))
        sock.setblocking(False)
        sock.bind(("0.0.0.0", PORT))
        return sock

    def _run(self):
        while self._running:
            for sender in self._senders:
                for index in range(DECOYS):
                    sender.sendto(b"for others", (group(index), PORT))
                    self.sent += 1
            time.sleep(DECOY_PERIOD)

    @staticmethod
    def _waiting(sockets):
        """Number of datagrams in the queues of these sockets, which have room for some hundred each."""
        count = 0
        for sock in sockets:
            try:
                while sock.recv(9216) is not None:
                    count += 1
            except BlockingIOError:
                pass
        return count

    def stop(self):
        """(datagrams received with IP_MULTICAST_ALL, datagrams received without it)"""
        self._running = False
        self._thread.join()
        counts = self._waiting(self._careless), self._waiting(self._careful)
        for sock in self._senders + self._members + self._careless + self._careful:
            sock.close()
        return counts


def roam(setup, count, seconds, preload=""):
    """Final reports of `count` peers, and datagrams at neighbours without joined groups."""
    with Testbed(count, "", snooping=True) as bed:
        neighbours = Neighbours(bed, range(1, count + 1))
        begin = time.monotonic_ns() + int((3 + 0.25 * count) * 1e9)
        first = ["env", f"LD_PRELOAD={preload}"] if preload else []
        programs = [bed.run(n + 1, [*first, setup.roamer, "e0", str(n), str(count), str(begin), str(seconds)])
                    for n in range(count)]
        reports = []
        for program in programs:
            status = program.wait(seconds + 60 + count)
            check(status == 0, f"a peer ended with status {status}: {program.error_text()}")
            reports.append(json.loads(program.lines[-1][1]))
        return reports, neighbours.stop(), neighbours.sent


def total(reports, key):
    return sum(report[key] for report in reports)


def many(setup):
    """All join, cross cell borders, leave and come back: each shows all in its reach within a second, nothing
    is lost, and what others of its host have joined does not reach it."""
    shown_in_time(*roam(setup, setup.count, setup.seconds))


def slow_joins(setup):
    """The same where one join of six waits 140 ms for the kernel, so that what others say to a newcomer has gone by."""
    shown_in_time(*roam(setup, 8, 12, setup.slow_joins))


def shown_in_time(reports, neighbours, decoys):
    careless, careful = neighbours
    late = max(report["latest_s"] for report in reports)
    share = total(reports, "cpu_s") / sum(report["seconds"] for report in reports)
    print(f"  {len(reports)} peers, {total(reports, 'looks')} looks at an entity in reach: {total(reports, 'unseen')} not shown "
          f"yet, {total(reports, 'overdue')} after a second; {total(reports, 'ghosts')} of the gone are shown\n"
          f"  heard {total(reports, 'heard')} datagrams, lost {total(reports, 'lost')}, dropped {total(reports, 'dropped')}; "
          f"{total(reports, 'joins')} joins; slowest to be shown {max(r['worst_shown_s'] for r in reports)} s, worst pose "
          f"{max(r['worst_pose_m'] for r in reports)} m\n"
          f"  {decoys} datagrams to others of their hosts: {total(reports, 'foreign')} reached a peer; {careless} a socket "
          f"that joined nothing, {careful} one with IP_MULTICAST_ALL=0\n"
          f"  each {100 * share:.2f} % of a core: some {1 / share:.0f} a core; latest step {late} s late")
    if late > TOO_LATE:
        raise Skip(f"this machine is too busy: a step came {late} s late")
    check(total(reports, "joins") > len(reports), "they did not cross cells")
    check(total(reports, "overdue") == 0, "entities in reach were not shown")
    check(total(reports, "ghosts") == 0, "those who had left were still shown")
    check(total(reports, "lost") == 0 and total(reports, "dropped") == 0, "datagrams were lost")
    check(total(reports, "foreign") == 0, "datagrams of groups that were not joined came")
    check(careless > 0, "the others' datagrams came to nobody: this is no trap")
    check(careful == 0, "IP_MULTICAST_ALL=0 does nothing on this kernel")


def all_groups(setup):
    """The same with the option taken away from the peers: then the datagrams of others do reach them."""
    reports, _, decoys = roam(setup, 4, 10, setup.all_groups)
    foreign = total(reports, "foreign")
    print(f"  of {decoys} datagrams to others of their hosts {foreign} reached a peer")
    check(foreign > 0, "nothing came: the counter of `many` cannot fail")


def cell_border(setup):
    """A listener at 40 m/s towards an entity just behind the border of each cell, sent at 200 Hz: nothing is
    missed where cells are joined 100 ms before; the gap without that is printed."""
    with Testbed(3, "", snooping=True) as bed:
        begin = str(time.monotonic_ns() + int(1.5e9))
        programs = [bed.run(host, [setup.border, "hear", "e0", begin, lookahead])
                    for host, lookahead in ((2, "100"), (3, "0"))]
        sender = bed.run(1, [setup.border, "send", "e0", begin])
        check(sender.wait(60) == 0, sender.error_text())
        results = []
        for program in programs:
            check(program.wait(60) == 0, program.error_text())
            results.append(json.loads(program.lines[-1][1]))
        ahead, without = results
        for name, result in (("joined 100 ms ahead", ahead), ("joined when in reach", without)):
            print(f"  {name}: {result['missed']} datagrams of {result['cells']} cells missed, gap {result['mean_gap_ms']} ms "
                  f"on average, {result['longest_gap_ms']} ms at most")
        check(ahead["never"] == 0 and without["never"] == 0, "a cell was never heard")
        check(without["missed"] > 0, "nothing is missed without it either: this shows nothing")
        check(ahead["missed"] == 0, f"{ahead['missed']} datagrams were missed")


CASES = {case.__name__: case for case in (many, all_groups, slow_joins, cell_border)}


def run(case):
    parser = argparse.ArgumentParser()
    parser.add_argument("case")
    parser.add_argument("--roamer", required=True)
    parser.add_argument("--border", required=True)
    parser.add_argument("--all-groups", required=True)
    parser.add_argument("--slow-joins", required=True)
    parser.add_argument("--count", type=int, default=64)
    parser.add_argument("--seconds", type=float, default=40.0)
    arguments = parser.parse_args()
    arguments.all_groups, arguments.slow_joins = (
        pathlib.Path(library).resolve() for library in (arguments.all_groups, arguments.slow_joins))
    testbed.need_root_and_ip()
    print(case.__doc__)
    case(arguments)


if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
