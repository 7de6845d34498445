# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Families of attacks: each run draws the numbers of a family from a seed. The datagrams are well formed; only their
contents are wrong."""
import math
import random
import re
import struct
import time

import dis_wire as dis
from hostile_attacks import ALICE, BOB, Attack, announce, now_stamp, only_presence, patched, without_trailer
from namespaces import BASE_GROUP

HAPTIC = struct.Struct(">IHBBBBHHHffff3f3fffff")
KINDS = {"plane": 1, "sphere": 2, "field": 3, "region": 4}
NUMBERS = (0, 1, 2, 255, 256, 32767, 32768, 65534, 65535)
NAMES = '["14089:1", "13886:1"]'  # IDs of ALICE and BOB, derived from their addresses
REALS = (0.0, -0.0, 1e-30, 1e-9, 1.0, -1.0, 1e9, -1e30, 3e38, math.inf, -math.inf, math.nan)


def drawn_log(draw, least, most):
    return math.exp(draw.uniform(math.log(least), math.log(most)))


def haptic_set(entity, draw, kind, radius, k1, validity):
    """A record set of an Attribute PDU: the force model of one entity."""
    normal = [draw.gauss(0, 1) for _ in range(3)]
    length = math.hypot(*normal) or 1.0
    point = [draw.uniform(-0.02, 0.02) for _ in range(3)]
    record = HAPTIC.pack(0x48415001, 72, 1, KINDS[kind], 0, 0, 0, validity, 0, k1, 0.0, 0.0, 0.1, *point,
                         *(x / length for x in normal), 0.0, 0.0, 0.0, radius)
    return struct.pack(">HHHH", *entity, 1) + record


def attribute(simulation, sets):
    body = struct.pack(">HHIHBBIBBH", *simulation, 0, 0, 1, 7, 0, 1, 0, len(sets)) + b"".join(sets)
    return dis.HEADER.pack(7, 1, dis.ATTRIBUTE, 1, now_stamp(), dis.HEADER.size + len(body), 0, 0) + body


def rows(own_group):
    """Rows of tiers by distance, some of them with a group of their own."""
    own = ", own_group = true" if own_group else ""
    return ('tier = [{farthest = "1 m", active = "1 kHz", passive = "1 kHz", octets = 232, kept = true}, '
            f'{{farthest = "50 m", active = 30, passive = 0.2, octets = 232{own}}}, '
            f'{{farthest = "200 m", body = "approximate", active = 10, passive = 0.2, octets = 176, coarser = 4{own}}}, '
            '{body = "rigid", active = 1, passive = 0.2, octets = 144, coarser = 16}]')


AOIM = ((), ('tier = [{to = "touch"}]',), (rows(False),), (rows(True),))


def guests(draw):
    """Bodies around the hands, in greater number and depth than any other, of guests or of joined peers."""
    return crowd(draw, draw.choice((0.0, 1e-30, 1e-9, 1e-3)), draw.choice(AOIM), ())


def pushers(draw):
    """The same with the stiffness of hands. Bodies of joined peers would be felt, so the two list each other in the
    scene."""
    return crowd(draw, drawn_log(draw, 30, 2000), draw.choice(AOIM), (f"touch = {NAMES}",))


def crowd(draw, k1, aoim, network):
    count, ports = round(drawn_log(draw, 33, 10_000)), draw.choice((1, 3, 40))
    kind, radius = draw.choice(list(KINDS)), drawn_log(draw, 0.05, 3)
    validity, at_once = draw.choice((500, 12_000, 65_535)), draw.choice((3, 9, 33))
    rate, joined = draw.choice((0.2, 1.0, 10.0)), draw.random() < 0.3
    if not joined and draw.random() < 0.5:
        network = ()  # guests are not felt by default
    sequence = [0] * ports

    def numbered(payload, source):
        """Inserts the next sequence number into its trailer."""
        sequence[source] += 1
        return patched(payload, (len(payload) - 12, ">I", sequence[source]))

    def send(heard, _, say):
        group, octets = heard.last(draw.choice((ALICE, BOB)), dis.ENTITY_STATE)
        state = patched(octets[:144], (4, ">I", now_stamp()), (8, ">H", 144), (19, ">B", 0))
        location = dis.EntityState(octets).location
        trailers = {}
        for source in range(ports if joined else 0):
            said = announce(only_presence(heard, BOB), 5000 + source, int(time.time()), (900, 1 + source), b"MALLORY")
            say(BASE_GROUP, numbered(said, source), source)
            trailers[source] = said[-24:]
        for first in range(0, count, at_once):
            source = draw.randrange(ports)
            ids = [(900, 1 + source, 1 + n) for n in range(first, min(count, first + at_once))]
            states = [patched(state, (12, ">HHH", *entity), (48, ">ddd", *(x + draw.uniform(-0.03, 0.03) for x in location)))
                      for entity in ids]
            sets = [haptic_set(entity, draw, kind, radius, k1, validity) for entity in ids]
            said = b"".join(states) + attribute((900, 1 + source), sets) + trailers.get(source, b"")
            say(group, numbered(said, source) if joined else said, source)

    return Attack(f"{count} bodies of {'joined peers' if joined else 'guests'} round the hands, {kind} of {radius:.2f} m and "
                  f"{k1:g} N/m, {at_once} a datagram, {ports} ports, {rate:g}/s, valid for {1e-3 * validity:g} s"
                  f"{', '.join(('', *aoim, *network))}", rate, send, told=bool(network), aoim=aoim,
                  network=network)


def one_shot(draw):
    """Stiff guests in one datagram: they appear inside a hand, or approach in free space and stay in it."""
    count, kind = draw.choice((1, 1, 2, 9, 33)), draw.choice(("sphere", "region"))
    k1, radius, comes = drawn_log(draw, 90, 700), draw.uniform(0.02, 0.06), draw.random() < 0.5
    everybody = draw.random() < 0.7
    speed = draw.uniform(0.1, 0.4)

    def send(heard, _, say):
        group, octets = heard.last(draw.choice((ALICE, BOB)), dis.ENTITY_STATE)
        state = patched(octets[:144], (4, ">I", now_stamp()), (8, ">H", 144), (19, ">B", 0), (88, ">B", 2))
        location = dis.EntityState(octets).location
        states, sets = [], []
        for n in range(count):
            way = [draw.gauss(0, 1) for _ in range(3)]
            away = (0.1 + radius if comes else 0.01) / math.hypot(*way)
            states.append(patched(state, (12, ">HHH", 900, 1, 1 + n), (48, ">ddd", *(x + away * w for x, w in zip(location, way))),
                                  (36, ">fff", *(-speed / math.hypot(*way) * w if comes else 0.0 for w in way))))
            sets.append(haptic_set((900, 1, 1 + n), draw, kind, radius, k1, 12_000))
        say(group, b"".join(states) + attribute((900, 1), sets))

    network = ('touch = "all"',) if everybody else ()
    return Attack(f"one datagram of {count} guests, {kind} of {1e3 * radius:.0f} mm and {k1:.0f} N/m, "
                  f"{f'at {speed:.2f} m/s into' if comes else 'inside'} a hand{', '.join(('', *network))}", 0.2, send,
                  network=network)


CUBE_ID = (65534, 1, 1)  # of the scene, which no peer has
CUBE = """
[[object]]
name = "floor"
plane = [0, 0, 1]
position = "0 0 -100 mm"
surface = {stiffness = "400 N/m"}

[[object]]
name = "cube"
box = "40 40 40 mm"
position = "0 -200 -80 mm"
mass = "50 g"
surface = {stiffness = "400 N/m"}

[[device]]
peer = 1
operator = 1

[[device]]
peer = 2
operator = 2
"""


def bodies(draw):
    """A joined stranger sends the body of the scene that its first peer owns."""
    number, rate = draw.choice((1, 3, 200)), drawn_log(draw, 5, 100)
    life, speed, version = draw.randrange(1, 2**32), draw.uniform(0.0, 0.5), draw.choice((1, 2, 2**63))
    sequence = [0]

    def numbered(payload):
        sequence[0] += 1
        return patched(payload, (len(payload) - 12, ">I", sequence[0]))

    def send(heard, _, say):
        said = announce(only_presence(heard, BOB), life, int(time.time()), (900, 1), b"MALLORY")
        say(BASE_GROUP, numbered(patched(said, (57, ">B", number))))
        group, octets = heard.last(draw.choice((ALICE, BOB)), dis.ENTITY_STATE)
        location = dis.EntityState(octets).location
        body = patched(octets[:144], (4, ">I", now_stamp()), (8, ">H", 144), (12, ">HHH", *CUBE_ID), (19, ">B", 0),
                       (20, ">BBHBBBB", 0, 0, 0, 66, 0, 0, 0), (36, ">fff", *(draw.uniform(-speed, speed) for _ in range(3))),
                       (48, ">ddd", *(x + draw.uniform(-0.02, 0.02) for x in location)))
        owner = struct.pack(">HHHHIHBBIIQ", *CUBE_ID, 1, 0x48415004, 24, 0, 0, life, 0, version)
        say(group, numbered(body + attribute((900, 1), [owner]) + said[-24:]))

    return Attack(f"the scene's cube {rate:.0f} times a second in a hand, from a joined stranger as scene peer {number}", rate,
                  send, objects=CUBE)


def coming_and_going(draw):
    """Strangers that join and leave, or come from another scene."""
    a_turn, other_scene = draw.choice((5, 20, 100)), draw.random() < 0.5

    def send(heard, _, say):
        payload = only_presence(heard, BOB)
        for _ in range(a_turn):
            number = draw.randrange(1, 60_000)
            joined = announce(payload, number, int(time.time()), (draw.randrange(600, 700), number), b"%016x" % number)
            if other_scene:
                joined = patched(joined, (24, ">Q", draw.getrandbits(64)))
            say(BASE_GROUP, joined)
            say(BASE_GROUP, patched(joined, (58, ">H", 2)))

    return Attack(f"{10 * a_turn} strangers a second who {'show another scene' if other_scene else 'join'} and leave", 10, send)


def mutant(draw, octets):
    """A PDU of correct length with changed field values."""
    changes = []
    for _ in range(draw.randrange(1, 5)):
        form, size, values = draw.choice(((">H", 2, NUMBERS), (">I", 4, NUMBERS), (">f", 4, REALS), (">d", 8, REALS)))
        places = range(12, len(octets) - size + 1, size if size < 8 else 4)
        if places:
            changes.append((draw.choice(places), form, draw.choice(values)))
    copy = patched(octets, *changes)
    if draw.random() < 0.5:  # under an identity of its own
        copy = patched(copy, (12, ">HH", 700, draw.randrange(1, 9)))
    return patched(copy, (4, ">I", draw.choice((now_stamp(), draw.getrandbits(32)))))


def mutants(draw):
    """Valid datagrams of the victims with changed meaning. Bodies in them would be felt, so the two list each other
    in the scene."""
    a_turn, joined = draw.choice((20, 100)), draw.random() < 0.5
    life = draw.randrange(1, 2**32)

    def send(heard, _, say):
        if joined:
            say(BASE_GROUP, announce(only_presence(heard, BOB), life, int(time.time()), (700, 1), b"MALLORY"))
        heard_last = heard.datagrams(ALICE)[-400:] + heard.datagrams(BOB)[-400:]
        by_type = {}
        for _, _, group, payload in heard_last:
            for kind, octets in dis.pdus(without_trailer(payload)):
                by_type.setdefault(kind, []).append((group, octets))
        for _ in range(a_turn):
            group, octets = draw.choice(by_type[draw.choice(list(by_type))])
            say(group, mutant(draw, octets))

    return Attack(f"{20 * a_turn} changed PDUs a second of all types that the victims say, "
                  f"{'joined as a peer' if joined else 'as a guest'}, touch = {NAMES}", 20, send, told=False,
                  network=(f"touch = {NAMES}",))


def invented(draw):
    """An unlimited number of entities that touch nobody."""
    haptic, a_turn = draw.random() < 0.5, draw.choice((50, 150, 300))
    count = [0]

    def send(heard, _, say):
        group, octets = heard.last(BOB, dis.ENTITY_STATE)
        state = patched(octets[:144], (4, ">I", now_stamp()), (8, ">H", 144), (19, ">B", 0))
        location = dis.EntityState(octets).location
        for _ in range(a_turn // 9 + 1):
            ids = [(1000 + (count[0] + i) // 60_000, 1, 1 + (count[0] + i) % 60_000) for i in range(9)]
            count[0] += 9
            out = b"".join(patched(state, (12, ">HHH", *entity), (48, ">d", location[0] + draw.choice((-1, 1)) * draw.uniform(0.1, 50)))
                           for entity in ids)
            if haptic:
                out += attribute((1000, 1), [haptic_set(entity, draw, "sphere", 0.01, 300.0, 5000) for entity in ids])
            say(group, out)

    return Attack(f"{50 * a_turn} new entities a second{', with force models' if haptic else ''}", 50, send, told=False)


HEAD = ("| family | attacks | held | longest interruption [s] | more memory [MiB] | lines a second |\n"
        "|---|---:|---:|---:|---:|---:|")
PLACE = re.compile(r"(<!-- table of families -->\n).*?(<!-- end of it -->)", re.S)


def show_summary(results, page):
    """Prints the worst result of each family, from (gap, memory, lines, held) of each of its attacks, and writes the
    table into a page; None: no page."""
    rows = [HEAD]
    for name, attacks in results.items():
        gap, memory, lines, _ = (max(column) for column in zip(*attacks))
        held = sum(attack[3] for attack in attacks)
        rows.append(f"| `{name}` | {len(attacks)} | {held} | {gap:.1f} | {max(0.0, memory):.0f} | {lines:.1f} |")
    table = "\n".join(rows) + "\n"
    print("\n" + table, flush=True)
    if page:
        text = page.read_text()
        if not PLACE.search(text):
            raise SystemExit(f"{page} has no place for the table of families")
        page.write_text(PLACE.sub(lambda match: match[1] + table + match[2], text))


FAMILIES = {"guests": guests, "pushers": pushers, "one_shot": one_shot, "bodies": bodies, "coming_and_going": coming_and_going, "mutants": mutants, "invented": invented}


def of(name, seed):
    """The attack for a seed."""
    return FAMILIES[name](random.Random(f"{name} {seed}"))
