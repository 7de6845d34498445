# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Attacks of a third host on a LAN where cells have leaders: claims of leadership, maps of groups and snapshots,
under the identities of the victims, under an unknown life, and as a stranger that joined."""
import struct
import time

import dis_wire as dis
from hostile_attacks import ALICE, BOB, Attack, announce, now_stamp, only_presence, patched
from namespaces import BASE_GROUP
from testbed import Failure

CELL_ROLES, GROUP_MAP, CELL_SNAPSHOT = 145, 146, 147
LEADS = 1
WHOLE_SCENE = (-2**31, -2**31)
UNKNOWN = ((700, 7), 0x0BADCAFE)   # number and life of no peer
JOINED = ((700, 1), 0x0BADF00D)    # of the stranger that announces itself
FORGED = b"FORGED"                 # marking of an entity that only forged snapshots contain
POOL = 16


def role_records(heard, host):
    """(column, row, flags) of each role in a host's last message about its cells."""
    found = {}
    for _, _, _, payload in heard.datagrams(host)[-400:]:
        for kind, octets in dis.pdus(payload):
            if kind != CELL_ROLES:
                continue
            for at in range(24, len(octets), 40):
                column, row, flags = *struct.unpack_from(">ii", octets, at), struct.unpack_from(">H", octets, at + 24)[0]
                found[column, row] = flags
    if not found:
        raise Failure(f"host {host} never said its part in a cell")
    return found


def life_of(heard, host):
    """Number and epoch of a victim."""
    payload = heard.announcement(host)
    octets = next(octets for kind, octets in dis.pdus(payload) if kind == 140)
    return struct.unpack_from(">HH", octets, 12), struct.unpack_from(">I", octets, 16)[0]


def liars(heard):
    return life_of(heard, ALICE), life_of(heard, BOB), UNKNOWN


def signed(heard, life, kind, body):
    """A PDU with the trailer of this life, as a separate datagram."""
    simulation, epoch = life
    octets = dis.HEADER.pack(7, 1, kind, dis.FIRST_EXPERIMENTAL, now_stamp(), 20 + len(body), 0, 0) \
        + struct.pack(">HHI", *simulation, epoch) + body
    trailer = heard.announcement(BOB)[-24:]
    return octets + patched(trailer, (16, ">I", epoch), (12, ">I", int(1000 * time.monotonic()) % 2**32))


def claim(heard, life, say):
    """Claims to lead all cells of the victims since 1970."""
    cells = list(role_records(heard, BOB))
    for first in range(0, len(cells), 25):
        part = cells[first:first + 25]
        say(BASE_GROUP, signed(heard, life, CELL_ROLES, struct.pack(">HH", len(part), 0) + b"".join(
            struct.pack(">iiQIIHHHHQ", *cell, 0, life[1], 0, LEADS, 0, 0, 0, 0) for cell in part)))


def hand_out(heard, life, say):
    """A map of the victims' cells with the groups in reverse order."""
    cells = [cell for cell in role_records(heard, BOB) if cell != WHOLE_SCENE][:POOL]
    entries = b"".join(struct.pack(">iiIHH", *cell, 0, POOL - number, 0) for number, cell in enumerate(cells))
    say(BASE_GROUP, signed(heard, life, GROUP_MAP, struct.pack(">IHHHH", 2**31, 0, 1, POOL, len(cells)) + entries))


def tell(heard, life, say):
    """Snapshots of the victims' cells with an entity that does not exist."""
    simulation, epoch = life_of(heard, BOB)
    _, octets = heard.last(BOB, dis.ENTITY_STATE)
    state = patched(octets[:144], (4, ">I", now_stamp()), (8, ">H", 144), (12, ">HHH", *simulation, 999), (19, ">B", 0),
                    (129, "11s", FORGED))
    states = struct.pack(">IHH", epoch, len(state), 0) + state
    for cell in list(role_records(heard, BOB))[:6]:
        for group in range(0, POOL + 1):
            say(BASE_GROUP[:-1] + str(group), signed(heard, life, CELL_SNAPSHOT,
                                                     struct.pack(">iiHHHH", *cell, 1, 0, 1, len(states)) + states))


def of_all(forge):
    def send(heard, _, say):
        for life in liars(heard):
            forge(heard, life, say)
    return send


def join_and_lie(heard, begin, say):
    """Announces itself, claims to lead since 1970, and sends a map."""
    (simulation, epoch) = JOINED
    say(BASE_GROUP, announce(only_presence(heard, BOB), epoch, int(time.time()), simulation, b"MALLORY"))
    if time.monotonic() - begin > 0.5:
        claim(heard, JOINED, say)
        hand_out(heard, JOINED, say)


LEADER_ATTACKS = {
    "lead": Attack("claim of the lead of all cells", 10, of_all(claim), leaders=True),
    "group_map": Attack("map of groups", 10, of_all(hand_out), leaders=True),
    "snapshot": Attack("snapshot, while a newcomer is told", 10, of_all(tell), newcomer=True, leaders=True),
    "joined_liar": Attack("a stranger who joins leads since 1970, with a map (believed without a key)", 10, join_and_lie,
                          leaders=True, told=False, believed=True),
}
