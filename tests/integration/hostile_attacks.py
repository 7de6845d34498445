# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Attacks of a third host on the LAN: without a key, from an address of its own, each built from the received
traffic."""
import random
import struct
import time

import dis_wire as dis
import testbed
from namespaces import BASE_GROUP

ALICE, BOB = 1, 2  # hosts under attack
STOP_FREEZE, PRESENCE, ASSURED = 14, 140, 150
DEACTIVATED = 1 << 23  # bit of an appearance


def now_stamp():
    """An absolute DIS timestamp of the current time."""
    return int(time.time() % 3600 / 3600 * 2**31) << 1 | 1


def patched(octets, *changes):
    """A copy with some values overwritten; each change is (offset, format, value ...)."""
    copy = bytearray(octets)
    for offset, form, *values in changes:
        struct.pack_into(form, copy, offset, *values)
    return bytes(copy)


def without_trailer(payload):
    return payload[:-24] if dis.trailer(payload) else payload


class Heard:
    """Everything that an attacker on the LAN receives: all datagrams of the victims."""

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
        """The last datagram of a victim with its Presence."""
        for _, _, _, payload in reversed(self.datagrams(host)):
            if any(kind == PRESENCE for kind, _ in dis.pdus(payload)):
                return payload
        raise testbed.Failure(f"host {host} never announced itself")

    def states(self, host):
        """All Entity States that a victim sent."""
        return [dis.EntityState(octets) for _, _, _, payload in self.datagrams(host)
                for kind, octets in dis.pdus(payload) if kind == dis.ENTITY_STATE]


class Attack:
    """One attack: a sentence, its rate a second, and a function that sends it."""

    def __init__(self, sentence, rate, send, newcomer=False, told=True, leaders=False, believed=False, aoim=(),
                 network=(), objects=""):
        self.sentence, self.rate, self.send = sentence, rate, send
        self.leaders = leaders    # whether the cells of the scene have leaders, which distribute groups
        self.aoim = aoim          # further settings of the scene under [aoim]
        self.network = network    # further settings under [network]
        self.objects = objects    # further objects of the scene
        self.believed = believed  # whether another leader is expected
        self.newcomer = newcomer  # whether a genuine peer that joins during the attack must be shown
        self.told = told          # whether a victim must report the attack


def announce(payload, epoch, started, simulation=None, name=None):
    """An announcement with changed contents: Presence first, its trailer last."""
    changes = [(16, ">I", epoch), (92, ">I", started), (len(payload) - 8, ">I", epoch),
               (len(payload) - 12, ">I", int(1000 * time.monotonic()))]
    if simulation:
        changes.append((12, ">HH", *simulation))
    if name:
        changes.append((96, "16s", name))
    return patched(payload, *changes)


def only_presence(heard, host):
    """Its Presence and a trailer as a separate datagram."""
    payload = heard.announcement(host)
    octets = next(octets for kind, octets in dis.pdus(payload) if kind == PRESENCE)
    return octets + payload[-24:]


def freezing():
    everybody = 0xFFFF
    return (dis.HEADER.pack(7, 1, STOP_FREEZE, 5, now_stamp(), 40, 0, 0)
            + struct.pack(">HHHHHHIIBBHI", 9, 9, 1, everybody, everybody, everybody, 0, 0, 2, 0, 0, 77))


def freeze(heard, _, say):
    say(BASE_GROUP, freezing())


def assured(heard, _, say):
    """Records with a Freeze, marks of one, and acknowledgements in a victim's epoch, with its trailer and without."""
    trailer = heard.announcement(BOB)[-24:]
    sequence, epoch = dis.trailer(trailer)

    def record(kind, number, content):
        return dis.HEADER.pack(7, 1, ASSURED, 129, now_stamp(), 32 + len(content), 0, 0) + struct.pack(
            ">HHBBHIIHH", 9, 9, kind, kind == 1, 0, epoch, number, 0, len(content)) + content

    for number in (1, random.randrange(2**32)):
        for octets in (record(1, number, freezing()), record(3, number, b"\xff" * 64)):
            say(BASE_GROUP, octets)
            say(BASE_GROUP, octets + patched(trailer, (12, ">I", (sequence + 1) % 2**32)))


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
    """An Attribute PDU with changed energy accounts: change(given) returns given and need."""
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


PEERS = 1024  # capacity of the list of peers


def fake_presences(heard, _, say):
    payload = only_presence(heard, BOB)
    for number in range(PEERS):
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
    "assured": Attack("assured Freeze and acknowledgements in the victim's epoch", 10, assured),
    "leap": Attack("bare trailer with sequence + 2^30", 10, leap),
    "new_epoch": Attack("Presence with another's id and new epoch", 10, new_epoch),
    "oldest": Attack("Presence with the victim's id and started = 0", 10, oldest),
    "deactivate": Attack("plain deactivation", 10, deactivate),
    "move": Attack("plain Entity State of another's entity", 50, move),
    "replay": Attack("replayed capture, its trailers cut off", 10, replay),
    "credit": Attack("rising energy account", 50, credit),
    "need": Attack("false need", 50, need),
    "fake_ids": Attack("as many invented ids as the table has rows", 50, fake_ids, newcomer=True),
    "fake_presences": Attack("as many invented presences as peers are remembered", 4, fake_presences, newcomer=True),
    "escapes": Attack("escape sequences in names and markings", 10, escapes, told=False),
}
