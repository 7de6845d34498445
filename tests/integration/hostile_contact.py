# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Two peers that touch each other, the effects of a third host on them, and their reports."""
import math
import pathlib
import re
import statistics
import threading
import time

from hostile_attacks import ALICE, ATTACKS, BOB, Heard
from hostile_leaders import FORGED, LEADER_ATTACKS
from namespaces import PORT
from testbed import check

MALLORY, CAROL = 3, 4  # further hosts beside ALICE and BOB
FROZEN = 1 << 21  # bit of an appearance
BODIES = (65534, 1)  # simulation address of the scene's bodies, which its peers send
ESTABLISHED = 2.0     # [s] until a peer keeps its number against a claim with an earlier start
HANDED_OUT = 7.0      # [s] until leaders are elected, and groups are distributed and in use
BEFORE = 1.5          # [s] of contact that are measured before each attack, two periods of the hands
FILLING = 10.0        # [s] more if a table is to be filled first
SEEN = 2.5            # [s] within which a newcomer is shown during an attack
LONGEST = 0.5         # [s], longest interruption of the contact by an attack
HEALED = 1.0          # [s] after the attack until everything is as before
MEMORY = 64.0         # [MiB], greatest growth of a peer during an attack
LINES = 3.0           # a second, for the user of a victim
FORGED_PER_S = 50_000
RECORDED = 3.0        # [s]
ATTACKS |= LEADER_ATTACKS
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")

SCENE = """
[scene]
name = "hostile"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"
k1 = "300 N/m"

[dead_reckoning]
position = "0.5 mm"
force = "0.02 N"

[aoim]
pool = 16

[[operator]]
trace = "press.csv"
approach = "-20 0 0 mm"
start = "1 s"

[[operator]]
trace = "press.csv"
position = "14 0 0 mm"

[[operator]]
sweep = {from = "0 300 0 mm", to = "0 310 0 mm", period = "1 s"}
"""


# A hand that moves to and fro by a millimetre. Both hands have this period: the medians of BEFORE do not depend on when
# it begins.
PERIOD = 75  # [10 ms]
PRESS = "t_s,px_m,py_m,pz_m\n" + "".join(
    f"{0.01 * i:.3f},{0.0005 * (1 - math.cos(2 * math.pi * i / PERIOD)):.7f},0,0\n" for i in range(PERIOD + 1))

# Cells so small that there are more of them than groups.
WITH_LEADERS = "pool = 16\nleaders = true\nhand_out = true"


class Contact:
    """Two peers that touch each other, and their output."""

    def __init__(self, bed, scene, heard=True, leaders=False):
        self._bed, self._scene = bed, scene
        self.sniffer = bed.sniff()
        self.heard = Heard(self.sniffer) if heard else None
        self._senders = {}
        self.peers = {"ALICE": self._start(ALICE, "ALICE"), "BOB": self._start(BOB, "BOB")}
        for peer, other in zip(self.peers.values(), ("BOB", "ALICE")):
            check(peer.wait_event("appeared", 5, other), f"{other} was never shown; {peer.error_text()}")
        time.sleep(HANDED_OUT if leaders else ESTABLISHED)

    def _start(self, host, name):
        return self._bed.peer(host, self._scene, name, host if host < CAROL else 3, ["--felt"])

    def say(self, group, octets, source=0):
        """Sends from one of the ports of the attacker, given by its number."""
        if source not in self._senders:
            self._senders[source] = self._bed.multicast_sender(MALLORY)
        try:
            self._senders[source].sendto(octets, (group, PORT))
        except OSError:
            pass  # its own queue is full: only the attacker is affected

    def forces(self, peer, begin, end):
        """(monotonic time, force [N]) of other hands on a peer's hand."""
        found = []
        for event in peer.events("felt"):
            when = peer.started + event["when"]
            if begin <= when < end:
                found.append((when, max(event["force_n"].values(), default=0.0)))
        return found

    def median(self, begin, end):
        """The lesser of the median forces of both."""
        return min(statistics.median([f for _, f in self.forces(p, begin, end)] or [0.0])
                   for p in self.peers.values())

    def longest_gap(self, begin, end):
        """Longest time [s] for which the force of one of them was outside its earlier range, widened by half on both
        sides."""
        longest = 0.0
        for peer in self.peers.values():
            before = [force for _, force in self.forces(peer, begin - BEFORE, begin)] or [0.0]
            since = last = begin
            for when, force in self.forces(peer, begin, end):
                if 0.5 * min(before) <= force <= 1.5 * max(before):
                    longest = max(longest, last - since)
                    since = when
                last = when
            longest = max(longest, last - since)
        return longest

    def memory(self):
        """Memory of the larger of both [MiB]."""
        return max(int(re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{p.process.pid}/status").read_text())[1])
                   for p in self.peers.values()) / 1024

    def notices(self, begin):
        return [event["text"] for peer in self.peers.values() for event in peer.events("notice")
                if peer.started + event["when"] >= begin]

    def wrongs(self, begin):
        """Abnormal states and events of the victims since `begin`."""
        wrongs = []
        for (name, peer), host, other in zip(self.peers.items(), (ALICE, BOB), (BOB, ALICE)):
            said = self.heard.states(host)
            if any(state.appearance & FROZEN for state in said):
                wrongs.append(f"{name} froze")
            if len({state.id[:2] for state in said} - {BODIES}) > 1:
                wrongs.append(f"{name} was renamed")
            theirs = {"{}:{}:{}".format(*state.id) for state in self.heard.states(other)}
            if any(peer.started + event["when"] >= begin and event["id"] in theirs for event in peer.events("gone")):
                wrongs.append(f"{name} dropped the other's hand")
        return wrongs

    def groups(self):
        """Groups that each victim has joined, from its kernel."""
        return {host: set(re.findall(r"^\s+([0-9A-F]{8})\s", self._bed.system(host, "cat /proc/net/igmp"), re.M))
                for host in (ALICE, BOB)}

    def led(self, begin):
        """Messages of the victims about leaders since `begin`."""
        return [text for text in self.notices(begin) if " led by " in text]

    def attack(self, attack, seconds):
        """Runs the attack. Returns (normal force, force during it, force after it, longest gap, messages, newcomer
        seen or None, wrongs). An earlier report about the attacker suppresses a new one until a minute has been
        quiet."""
        if attack.newcomer:
            seconds += FILLING
        time.sleep(BEFORE)
        groups = self.groups()
        begin = time.monotonic()
        normal = self.median(begin - BEFORE, begin)
        mallory = threading.Thread(target=self._repeat, args=(attack, begin, begin + seconds))
        mallory.start()
        seen = None
        if attack.newcomer:
            time.sleep(seconds - SEEN)
            carol = self._start(CAROL, "CAROL")
            since = [peer.seconds() for peer in self.peers.values()]
            until = time.monotonic() + SEEN
            seen = all(peer.wait_event("appeared", until - time.monotonic(), "CAROL", when)
                       for peer, when in zip(self.peers.values(), since))
        mallory.join()
        end = time.monotonic()
        time.sleep(HEALED + BEFORE)
        wrongs = self.wrongs(begin)
        if attack.leaders and not attack.believed:
            wrongs += self.misled(begin, groups, [carol] if attack.newcomer else [])
        if attack.newcomer:
            carol.end()
        return (normal, self.median(begin, end), self.median(end + HEALED, end + HEALED + BEFORE),
                self.longest_gap(begin, end + HEALED + BEFORE), self.notices(begin) + self.notices(0), seen, wrongs)

    def misled(self, begin, groups, newcomers):
        """Leaders, joins and entities that exist because of forged data."""
        wrongs = [f"another leader: {text}" for text in self.led(begin)]
        for host, joined in self.groups().items():
            if joined != groups[host]:
                wrongs.append(f"host {host} joined {sorted(joined - groups[host])}, left {sorted(groups[host] - joined)}")
        for peer in [*self.peers.values(), *newcomers]:
            if any(event["marking"] == FORGED.decode() for event in peer.events("appeared")):
                wrongs.append("a forged entity was shown")
        return wrongs

    def _repeat(self, attack, begin, end):
        while time.monotonic() < end:
            attack.send(self.heard, begin, self.say)
            time.sleep(1.0 / attack.rate)
