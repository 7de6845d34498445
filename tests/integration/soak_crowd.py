# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Twelve peers that drive about, join and leave cells, and come and go, for long: each datagram is accounted
for, none too few and none too many, and memory stands still.
  soak_crowd.py --reckon PROGRAM [--minutes N] [--seed N]"""
import argparse
import json
import math
import pathlib
import random
import signal
import socket
import sys
import time

import memory
import testbed
import wire_balance
from switch_view import SwitchView
from testbed import Testbed, check

PEERS = 12
STAY = (1, 2)    # hosts whose memory is measured: without disturbances
SLEEP = (3, 9)   # stopped for seconds, but not ended
LOSSY = (3, 6, 7)
NARROW = 9       # its sockets hold about five datagrams
SLOW = 10        # its cable has less capacity than its traffic
REFUSED = 11     # its kernel refuses some of its datagrams
CUT_OFF = 5      # some of the datagrams that pass the switch do not reach it
CROWD = 12       # owns many entities at rest: it sends in bursts
RATE = "24kbit"  # of the slow cable
REFUSES = 12     # one of this number of datagrams is refused
LOSES = 40       # one of this number is lost
TELL = "5s"      # period of the balance reports
CAUGHT_UP = 0.5  # [s] until the observer has received the datagrams in the peers' reports
SEEN = 1.0       # [s] until the observer has received all that was sent
RING = 2 << 20   # octets: after frames of this size a peer's ring has been filled once
SHOWN = 60.0     # [s] within which each column has a value
GROWTH = 512     # [KiB], greatest growth of memory of a host in STAY within JUDGED [s] after that; less in less time,
JUDGED = 2400.0  # but at least LEAST [KiB], and not checked for less than SHORTEST [s]
LEAST, SHORTEST = 128, 300.0
LOSS = """
[impairment]
delay = "8 ms"
jitter = "6 ms"
loss = "5 %"
duplicate = "3 %"
reorder = "2 %"
reorder_delay = "30 ms"
seed = {}
"""


def track(number):
    """A closed path of at least 500 m through many cells, in 61 to 94 s."""
    lap = 61.0 + 3 * number
    rows = ["t_s,px_m,py_m,pz_m"]
    for i in range(int(lap / 0.25) + 1):
        turn = 2 * math.pi * 0.25 * i / lap
        rows.append(f"{0.25 * i:.2f},{170 * math.sin(2 * turn + number):.3f},{150 * math.sin(3 * turn + 2 * number):.3f},0")
    return "\n".join(rows) + "\n"


def world():
    text = ['[scene]\nname = "crowd"\norigin = {latitude = "47 deg", longitude = "8 deg", height = "400 m"}\n']
    for peer in range(1, PEERS + 1):
        for car in range(3):
            text.append(f'[[entity]]\npeer = {peer}\nmarking = "CAR{peer}_{car}"\ntype = "1.1.225.1"\n'
                        f'track = "track_{peer}.csv"\nrepeat = true\nspeed = {1 + 0.13 * car:.2f}\n'
                        'dead_reckoning = {position = "5 cm", heartbeat = "2 s"}\n')
    for post in range(30):
        text.append(f'[[entity]]\npeer = {CROWD}\nmarking = "POST{post}"\ntype = "1.1.225.1"\n'
                    f'position = [{post - 15}.0, 10.0, 0.0]\ndead_reckoning = {{heartbeat = "1.5 s"}}\n')
    return "\n".join(text) + '\n[aoim]\ncell = "60 m"\nradius = "70 m"\npool = 100\n'


class Host:
    """One host: successive lives of its peer, and its disturbances."""

    def __init__(self, bed, number, scene, dice, begun, keeps):
        self.bed, self.number, self.scene, self.dice = bed, number, scene, dice
        self.program = self.told = None
        self.read = 0           # lines read from the program
        self.over = []          # lives to be checked
        self.kept = [] if keeps else None  # all of them, with all their reports
        self.memory = []        # (seconds, KiB)
        self.settled = None     # [s], time at which its ring had been filled once
        self.wakes = None       # time at which it continues
        self.next = begun + dice.uniform(0, 3)
        self.events = {"SIGTERM": 0, "SIGKILL": 0, "SIGSTOP": 0}

    def start(self):
        self.program = self.bed.peer(self.number, self.scene, f"P{self.number}", self.number,
                                     ("--balance", TELL))
        self.told = wire_balance.Told(self.number)
        if self.kept is not None:
            self.told.log = []
            self.kept.append(self.told)
        self.read = 0

    def take(self):
        """Reads its new lines."""
        lines = self.program.lines
        while self.read < len(lines):
            text = lines[self.read][1]
            lines[self.read] = (0, "")
            self.read += 1
            if '"event":"balance"' in text or '"datagrams_lost"' in text:
                self.told.take(json.loads(text))

    def end(self, how):
        self.told.asked_s = time.monotonic()
        if how == "SIGKILL":
            self.program.kill()
        else:
            self.program.signal(signal.SIGTERM)
        status = self.program.wait(60)
        self.told.end_s = time.monotonic()
        check(how == "SIGKILL" or status == 0, f"host {self.number} ended with {status}: {self.program.error_text()}")
        self.take()
        check(how == "SIGKILL" or self.told.ended, f"host {self.number} ended without a last word")
        self.over.append(self.told)
        self.bed.programs.remove(self.program)
        self.program = None

    def befall(self, now):
        """Performs the disturbances that are due."""
        if self.program is not None:
            status = self.program.process.poll()
            check(status is None, f"host {self.number} ended by itself with {status}: {self.program.error_text()}")
        if self.wakes is not None:
            if now < self.wakes:
                return
            self.program.signal(signal.SIGCONT)
            self.wakes = None
        if now < self.next:
            return
        if self.program is None:
            self.start()
            self.next = now + self.dice.uniform(8, 16 if self.number in SLEEP else 45)
            return
        how = "SIGSTOP" if self.number in SLEEP else self.dice.choice(("SIGTERM", "SIGTERM", "SIGKILL", "SIGSTOP"))
        if self.number in STAY:
            self.next = math.inf
            return
        self.events[how] += 1
        if how == "SIGSTOP":
            self.program.signal(signal.SIGSTOP)
            self.wakes = now + self.dice.uniform(1.6 if self.number in SLEEP else 0.3, 4)
            self.next = self.wakes + self.dice.uniform(5, 30)
        else:
            self.end(how)
            self.next = now + self.dice.uniform(0.2, 6)

    def look_at_memory(self, seconds, said):
        """@param said octets of its frames up to now, for a host with a single life"""
        if self.program is not None:
            self.memory.append((seconds, memory.resident(self.program)))
        if self.settled is None and said > RING:
            self.settled = seconds

    def judge_memory(self, length):
        """Checks memory from the time its ring is full, but not before a third of the run."""
        settled = max(self.settled or 0.0, length / 3)
        judged = self.settled is not None and length - settled >= SHORTEST
        memory.judge(f"host {self.number}", self.memory, settled if judged else None,
                     max(LEAST, GROWTH * min(1.0, (length - settled) / JUDGED)))


def hinder(bed):
    """Restricts the network of the hosts that send and receive with losses."""
    bed.slow(SLOW, RATE)
    bed.firewall(REFUSED, "output", f"udp dport 3000 numgen random mod {REFUSES} == 0 drop")
    bed.lose(CUT_OFF, LOSES)


def soak(arguments, folder, bed):
    dice = random.Random(arguments.seed)
    hinder(bed)
    wire = wire_balance.Wire(bed.switch_socket())
    packets = socket.AF_PACKET, socket.SOCK_RAW, socket.htons(testbed.ALL_PACKETS)
    reach = wire_balance.Wire(bed.socket(CUT_OFF, *packets), "e0")
    view = SwitchView(bed, wire, folder / "mdb.log")
    balance = wire_balance.Balance(wire, {CUT_OFF: reach}, slow=(SLOW,), switch=view)
    begun = time.monotonic()
    hosts = [Host(bed, n, folder / f"peer_{n}.toml", random.Random(dice.random()), begun, arguments.keeps)
             for n in range(1, PEERS + 1)]
    length = 60 * arguments.minutes
    told, looked = begun, begun
    try:
        while (now := time.monotonic()) < begun + length:
            for host in hosts:
                host.befall(now)
                if host.program is not None:
                    host.take()
            balance.backlog.look()
            if now - looked >= 5:
                looked = now
                for host in hosts:
                    host.look_at_memory(now - begun, wire.octets[host.number])
            if now - told >= 60:
                told = now
                judge(balance, hosts, now - begun)
            time.sleep(0.05)
        for host in hosts:
            if host.wakes is not None:
                host.program.signal(signal.SIGCONT)
        for host in hosts:
            if host.program is not None:
                host.end("SIGTERM")
        time.sleep(2 * SEEN)
        judge(balance, hosts, length)
        balance.check_reach(CUT_OFF, *bed.forwarded_and_lost())
        check(view.changes(wire_balance.BASE_GROUP), "the switch told of no member of the base group: its log is empty")
    finally:
        wire.stop()
        reach.stop()
    return balance, hosts


def judge(balance, hosts, seconds):
    """Checks the lives that are over, and the finished parts of the others."""
    time.sleep(CAUGHT_UP)
    wire = balance.wire
    for observer in (wire, *balance.reach.values()):
        check(observer.dropped() == 0, f"the observer missed {observer.dropped()} frames: nothing can be told")
        check(observer.problem is None, observer.problem)
    before, now = len(balance.findings), time.monotonic()
    for host in hosts:
        for told in [told for told in host.over if told.end_s < now - SEEN]:
            host.over.remove(told)
            balance.check(told)
        if host.program is not None:
            balance.look(host.told)
    sums = balance.sums
    print(f"{seconds:6.0f} s: {wire.datagrams} datagrams passed; {sums['lives']} lives over, {sums['stretches']} stretches, "
          f"{sums['arrived']} arrived, {sums['dropped by kernels']} dropped by kernels; "
          f"{len(balance.findings)} findings", flush=True)
    for sentence in balance.findings[before:][:20]:
        print("  " + sentence, flush=True)


def tell(balance, hosts, length):
    sums = balance.sums
    print("in all: " + ", ".join(f"{name} {count}" for name, count in sorted(sums.items())))
    print(f"dropped by the machine's backlog, whoever's: {balance.backlog.dropped()}")
    events = {name: sum(host.events[name] for host in hosts) for name in hosts[0].events}
    print("befell: " + ", ".join(f"{name} {count}" for name, count in events.items()))
    for host in hosts:
        if host.number in STAY + SLEEP:
            host.judge_memory(length)
    check(not balance.findings, f"{len(balance.findings)} balances are off")
    check(sums["dropped by kernels"] > 0, "no kernel dropped anything: nothing was shown of that")
    check(sums["lost_by_law"] > 0 and sums["duplicate"] > 0, "nothing was lost or doubled")
    for fate in ("held_back", "send_error", "stale_unsent", "lost on the cable"):
        check(sums[fate] > 0 or length < SHOWN, f"{fate}: none, nothing was shown of that")
    check(all(events.values()), "not everything befell them")


def run(arguments, folder):
    folder = pathlib.Path(folder)
    folder.chmod(0o755)
    program = testbed.copied_program(arguments.reckon, folder)
    for peer in range(1, PEERS + 1):
        (folder / f"track_{peer}.csv").write_text(track(peer))
    for peer in range(1, PEERS + 1):
        network = '[network]\nrate = 100\noffload = false\n' if peer == NARROW else "[network]\nrate = 5000\n"
        if peer in SLEEP:  # so that datagrams are waiting when it is stopped
            network += '[network.bundle]\nhold = "400 ms"\n'
        (folder / f"peer_{peer}.toml").write_text(
            world() + network + (LOSS.format(peer) if peer in LOSSY else ""))
    with Testbed(PEERS, program, snooping=True) as bed:
        balance, hosts = soak(arguments, folder, bed)
        tell(balance, hosts, 60 * arguments.minutes)
    return balance, hosts


def main(run=run, minutes=60.0, keeps=False):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--minutes", type=float, default=minutes)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    arguments.keeps = keeps
    return testbed.status_of(lambda folder: run(arguments, folder))


if __name__ == "__main__":
    sys.exit(main())
