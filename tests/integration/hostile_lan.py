# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A LAN that lies: two peers touch each other while a third host, at an address of its own, attacks without knowing a
key. `table` runs every attack against a fresh pair and prints what it did; `short` runs some against one pair."""
import random
import re
import statistics
import struct
import sys
import threading
import time

import dis_wire as dis
import testbed
from namespaces import BASE_GROUP, PORT, run
from testbed import check

ALICE, BOB, MALLORY, CAROL = 1, 2, 3, 4  # hosts
STOP_FREEZE, PRESENCE = 14, 140
FROZEN, DEACTIVATED = 1 << 21, 1 << 23  # of an appearance
ESTABLISHED = 2.0     # [s] until a peer holds its number against whoever claims to be older
BEFORE = 1.5          # [s] of contact looked at before each attack
FILLING = 10.0        # [s] longer where a table is to be filled first
SEEN = 2.5            # [s] within which a newcomer is shown meanwhile
LONGEST = 0.5         # [s] for which an attack may take the contact away
HEALED = 1.0          # [s] after it within which all is as before
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
sweep = {from = "0 0 0 mm", to = "1 0 0 mm", period = "1.1 s"}

[[operator]]
sweep = {from = "14 0 0 mm", to = "15 0 0 mm", period = "1.3 s"}

[[operator]]
sweep = {from = "0 300 0 mm", to = "0 310 0 mm", period = "1 s"}
"""


def now_stamp():
    """An absolute DIS timestamp of this instant."""
    return int(time.time() % 3600 / 3600 * 2**31) << 1 | 1


def patched(octets, *changes):
    """A copy with values packed over it; each change is (offset, format, value ...)."""
    copy = bytearray(octets)
    for offset, form, *values in changes:
        struct.pack_into(form, copy, offset, *values)
    return bytes(copy)


def without_trailer(payload):
    return payload[:-24] if dis.trailer(payload) else payload


class Heard:
    """What an attacker on the LAN knows of the victims: all that they sent."""

    def __init__(self, sniffer):
        self._sniffer = sniffer

    def datagrams(self, host, since=0.0):
        address = testbed.Testbed.address(host)
        return [d for d in list(self._sniffer.datagrams) if d[1] == address and d[0] >= since]

    def last(self, host, kind):
        """(group, octets) of the last PDU of a type."""
        for _, _, group, payload in reversed(self.datagrams(host)):
            for found, octets in dis.pdus(payload):
                if found == kind:
                    return group, octets
        raise testbed.Failure(f"host {host} never sent a PDU of type {kind}")

    def announcement(self, host):
        """The last datagram with its Presence."""
        for _, _, _, payload in reversed(self.datagrams(host)):
            if any(kind == PRESENCE for kind, _ in dis.pdus(payload)):
                return payload
        raise testbed.Failure(f"host {host} never announced itself")

    def states(self, host):
        """All Entity States that it sent."""
        return [dis.EntityState(octets) for _, _, _, payload in self.datagrams(host)
                for kind, octets in dis.pdus(payload) if kind == dis.ENTITY_STATE]


class Attack:
    """One attack: a sentence, how often a second it is repeated, and what it sends each time."""

    def __init__(self, sentence, rate, send, newcomer=False, told=True):
        self.sentence, self.rate, self.send = sentence, rate, send
        self.newcomer = newcomer  # whether a genuine peer that comes meanwhile must be seen
        self.told = told          # whether the user of a victim must be told


def announce(payload, epoch, started, simulation=None, name=None):
    """An announcement with other contents: Presence first, its trailer last."""
    changes = [(16, ">I", epoch), (92, ">I", started), (len(payload) - 8, ">I", epoch),
               (len(payload) - 12, ">I", int(1000 * time.monotonic()))]
    if simulation:
        changes.append((12, ">HH", *simulation))
    if name:
        changes.append((96, "16s", name))
    return patched(payload, *changes)


def only_presence(heard, host):
    """Its Presence and a trailer alone in a datagram."""
    payload = heard.announcement(host)
    octets = next(octets for kind, octets in dis.pdus(payload) if kind == PRESENCE)
    return octets + payload[-24:]


def freeze(heard, _, say):
    everybody = 0xFFFF
    say(BASE_GROUP, dis.HEADER.pack(7, 1, STOP_FREEZE, 5, now_stamp(), 40, 0, 0)
        + struct.pack(">HHHHHHIIBBHI", 9, 9, 1, everybody, everybody, everybody, 0, 0, 2, 0, 0, 77))


def leap(heard, _, say):
    last = {(host, group): payload for host in (ALICE, BOB) for _, _, group, payload in heard.datagrams(host)
            if dis.trailer(payload)}
    for (_, group), payload in last.items():
        sequence, _ = dis.trailer(payload)
        say(group, patched(payload[-24:], (12, ">I", (sequence + 2**30) % 2**32)))


def new_epoch(heard, _, say):
    say(BASE_GROUP, announce(only_presence(heard, BOB), 0x0BADCAFE, int(time.time())))


def oldest(heard, _, say):
    say(BASE_GROUP, announce(only_presence(heard, BOB), 0x0BADF00D, 0))


def deactivate(heard, _, say):
    group, octets = heard.last(BOB, dis.ENTITY_STATE)
    appearance = dis.EntityState(octets).appearance | DEACTIVATED
    say(group, patched(octets, (4, ">I", now_stamp()), (84, ">I", appearance)))


def move(heard, _, say):
    group, octets = heard.last(BOB, dis.ENTITY_STATE)
    x, y, z = dis.EntityState(octets).location
    say(group, patched(octets, (4, ">I", now_stamp()), (48, ">ddd", x + 3, y + 3, z + 3)))


def replay(heard, begin, say):
    recorded = [d for host in (ALICE, BOB) for d in heard.datagrams(host) if d[0] < begin]
    for _, _, group, payload in recorded[-40:]:
        say(group, without_trailer(payload))


def change_accounts(octets, change):
    """An Attribute PDU whose energy accounts are changed: change(given) gives given and need."""
    copy, at = bytearray(octets), 32
    for _ in range(struct.unpack_from(">H", octets, 30)[0]):
        count = struct.unpack_from(">H", octets, at + 6)[0]
        at += 8
        for _ in range(count):
            kind, length = struct.unpack_from(">IH", octets, at)
            if kind == dis.ENERGY_ACCOUNT:
                given, need = change(struct.unpack_from(">d", octets, at + 12)[0])
                struct.pack_into(">dHH", copy, at + 12, given, need, need)
            at += length
    return bytes(copy)


def credit(heard, begin, say):
    group, octets = heard.last(BOB, dis.ATTRIBUTE)
    say(group, change_accounts(octets, lambda given: (given + 10 * (time.monotonic() - begin), 0)))


def need(heard, _, say):
    group, octets = heard.last(BOB, dis.ATTRIBUTE)
    say(group, change_accounts(octets, lambda given: (given, 65535)))


def fake_ids(heard, begin, say, count=[0]):
    group, octets = heard.last(BOB, dis.ENTITY_STATE)
    state = patched(octets[:144], (4, ">I", now_stamp()), (8, ">H", 144), (19, ">B", 0))
    for _ in range(100):
        say(group, b"".join(patched(state, (12, ">HHH", 500 + (count[0] + i) // 40000, 1, 1 + (count[0] + i) % 40000))
                            for i in range(9)))
        count[0] += 9


def fake_presences(heard, _, say):
    payload = only_presence(heard, BOB)
    for number in range(256):
        say(BASE_GROUP, announce(payload, 0x70000000 + number, int(time.time()), (700, number + 1)))


def escapes(heard, _, say):
    payload = only_presence(heard, BOB)
    number = random.randrange(1, 60000)
    say(BASE_GROUP, announce(payload, number, int(time.time()), (800, number), b"\x1b[2J\x1b]0;x\x07\x9b31m\0"))
    group, octets = heard.last(BOB, dis.ENTITY_STATE)
    say(group, patched(octets, (12, ">HHH", 801, number, 1), (4, ">I", now_stamp()),
                       (129, "11s", b"\x1b[31mX\x07\x08\0")))


ATTACKS = {
    "freeze": Attack("Freeze from a stranger", 10, freeze),
    "leap": Attack("bare trailer with sequence + 2^30", 10, leap),
    "new_epoch": Attack("Presence with another's id and new epoch", 10, new_epoch),
    "oldest": Attack("Presence with the victim's id and started = 0", 10, oldest),
    "deactivate": Attack("plain deactivation", 10, deactivate),
    "move": Attack("plain Entity State of another's entity", 50, move),
    "replay": Attack("replayed capture, its trailers cut off", 10, replay),
    "credit": Attack("rising energy account", 50, credit),
    "need": Attack("false need", 50, need),
    "fake_ids": Attack("as many invented ids as the table has rows", 50, fake_ids, newcomer=True),
    "fake_presences": Attack("256 invented presences", 4, fake_presences, newcomer=True),
    "escapes": Attack("escape sequences in names and markings", 10, escapes, told=False),
}


class Contact:
    """Two peers that touch each other, and what their lines told."""

    def __init__(self, bed, scene):
        self._bed, self._scene = bed, scene
        self.heard = Heard(bed.sniff())
        self._sender = bed.multicast_sender(MALLORY)
        self.peers = {"ALICE": self._start(ALICE, "ALICE"), "BOB": self._start(BOB, "BOB")}
        for peer, other in zip(self.peers.values(), ("BOB", "ALICE")):
            check(peer.wait_event("appeared", 5, other), f"{other} was never shown; {peer.error_text()}")
        time.sleep(ESTABLISHED)

    def _start(self, host, name):
        return self._bed.peer(host, self._scene, name, host if host < CAROL else 3, ["--felt"])

    def say(self, group, octets):
        try:
            self._sender.sendto(octets, (group, PORT))
        except OSError:
            pass  # a full queue of its own is the attacker's trouble

    def forces(self, peer, begin, end):
        """(monotonic time, force [N]) that its hand felt of others."""
        found = []
        for event in peer.events("felt"):
            when = peer.started + event["when"]
            if begin <= when < end:
                found.append((when, max(event["force_n"].values(), default=0.0)))
        return found

    def median(self, begin, end):
        """Of the one that feels less."""
        return min(statistics.median([f for _, f in self.forces(p, begin, end)] or [0.0])
                   for p in self.peers.values())

    def longest_gap(self, begin, end):
        """Longest time [s] for which one of them felt less than half of the least, or half more than the most, that it
        felt before."""
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

    def notices(self, begin):
        return [event["text"] for peer in self.peers.values() for event in peer.events("notice")
                if peer.started + event["when"] >= begin]

    def wrongs(self, begin):
        """What the victims themselves said or did since `begin` that they would not have."""
        wrongs = []
        for (name, peer), host, other in zip(self.peers.items(), (ALICE, BOB), (BOB, ALICE)):
            said = self.heard.states(host)
            if any(state.appearance & FROZEN for state in said):
                wrongs.append(f"{name} froze")
            if len({state.id for state in said}) > 1:
                wrongs.append(f"{name} was renamed")
            theirs = {"{}:{}:{}".format(*state.id) for state in self.heard.states(other)}
            if any(peer.started + event["when"] >= begin and event["id"] in theirs for event in peer.events("gone")):
                wrongs.append(f"{name} dropped the other's hand")
        return wrongs

    def attack(self, attack, seconds):
        """(normal force, force meanwhile, force after, longest gap, sentences told, newcomer seen or None, wrongs). What
        was told of the attacker before stays told: a quiet minute makes it news again."""
        if attack.newcomer:
            seconds += FILLING
        time.sleep(BEFORE)
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
        if attack.newcomer:
            carol.end()
        return (normal, self.median(begin, end), self.median(end + HEALED, end + HEALED + BEFORE),
                self.longest_gap(begin, end + HEALED + BEFORE), self.notices(begin) + self.notices(0), seen,
                self.wrongs(begin))

    def _repeat(self, attack, begin, end):
        while time.monotonic() < end:
            attack.send(self.heard, begin, self.say)
            time.sleep(1.0 / attack.rate)


def short_of(attack, result, contact):
    """What this attack has done that it must not; empty where it failed."""
    normal, _, after, gap, told, seen, problems = result
    if gap > LONGEST:
        problems.append(f"contact interrupted for {gap:.1f} s")
    if not 0.8 * normal < after < 1.25 * normal:
        problems.append("not healed when it was over")
    if attack.told and not any(testbed.Testbed.address(MALLORY) in text for text in told):
        problems.append("nobody was told of the attacker")
    if seen is False:
        problems.append("a newcomer was shut out")
    for peer in contact.peers.values():
        if any(CONTROL.search(text) for _, text in peer.lines + peer.errors):
            problems.append("control characters reached a terminal")
            break
    return problems


def row(attack, result, problems):
    normal, during, after, gap, told, seen, _ = result
    print(f"| {attack.sentence} | {normal:.2f} | {during:.2f} | {after:.2f} | {gap:.1f} | "
          f"{'' if seen is None else 'seen' if seen else 'shut out'} | {told[0] if told else 'nothing'} | "
          f"{'; '.join(problems) or 'held'} |", flush=True)


HEAD = ("| attack | force before [N] | during | after | longest interruption [s] | newcomer | first told | |\n"
        "|---|---:|---:|---:|---:|---|---|---|")


def scene_in(setup):
    path = setup.folder / "scenes/hostile.toml"
    path.write_text(SCENE)
    return path


def attack_all(setup, names, seconds, fresh):
    """Each by a fresh pair, or all by one."""
    scene, failed = scene_in(setup), []
    print(HEAD, flush=True)

    def one(contact, attack):
        result = contact.attack(attack, seconds)
        check(result[0] > 0.1, f"no contact before the attack: {result[0]} N")
        problems = short_of(attack, result, contact)
        row(attack, result, problems)
        failed.extend(f"{attack.sentence}: {problem}" for problem in problems)

    if fresh:
        for name in names:
            with setup.testbed(CAROL) as bed:
                contact = Contact(bed, scene)
                one(contact, ATTACKS[name])
                if "-v" in sys.argv:
                    print(contact.notices(0), *(peer.report() for peer in contact.peers.values()), sep="\n")
    else:
        with setup.testbed(CAROL) as bed:
            contact = Contact(bed, scene)
            for name in names:
                one(contact, ATTACKS[name])
    check(not failed, "; ".join(failed))


def hostile_table(setup):
    """Every attack, each against a fresh pair in contact: none interrupts it, none outlasts itself, each is told."""
    attack_all(setup, ATTACKS, 4.0, fresh=True)


def hostile_short(setup):
    """Five forgeries against one pair in contact: none interrupts it, each is told."""
    attack_all(setup, ("freeze", "leap", "deactivate", "move", "replay"), 1.0, fresh=False)


CASES = {case.__name__: case for case in (hostile_table, hostile_short)}


def one_attack(name):
    """A case of its own."""
    def case(setup):
        attack_all(setup, (name,), 4.0, fresh=True)
    case.__doc__ = ATTACKS[name].sentence
    return case


CASES |= {f"hostile_{name}": one_attack(name) for name in ATTACKS}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
