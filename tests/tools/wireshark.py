# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The Wireshark plug-in: tshark reads captures with it, and what it shows is held against the octets
themselves and against `reckon inspect`. One case per call:
  wireshark.py CASE --plugin reckon.lua --reckon PROGRAM --samples FOLDER [--data FOLDER]"""
import math
import random
import struct
import subprocess
import sys

from tshark import check, run_case

OWN = ("attribute", "haptic", "energy", "presence", "trailer", "membership", "cell", "exchange", "compressed",
       "echo", "heard", "peer", "roles", "role", "group_map", "cell_group", "snapshot", "unicast", "assured")
ENTITY_STATE, ATTRIBUTE = 1, 72
PLACES = ("reckon.pdu.index", "reckon.pdu.offset", "reckon.pdu.id", "reckon.pdu.rule", "reckon.pdu.at",
          "udp.length")


def bundles_of(samples, per_datagram, padded):
    """Datagrams with that many PDUs, and for each the (index, offset, type) of every PDU."""
    pdus, datagrams, expected = list(samples.values()), [], []
    for first in range(0, len(pdus), per_datagram):
        datagram, places = b"", []
        for index, pdu in enumerate(pdus[first:first + per_datagram], 1):
            if padded:
                datagram += bytes(-len(datagram) % 8)
            places.append((index, len(datagram), pdu[2]))
            datagram += pdu
        datagrams.append(datagram)
        expected.append(places)
    return datagrams, expected


def bundles(tools):
    """Every PDU of every bundle is found at its offset, with and without zero padding between."""
    samples = tools.samples()
    check(len(samples) >= 75, f"{len(samples)} samples")
    for per_datagram, padded in ((1, False), (5, False), (5, True), (9, True)):
        datagrams, expected = bundles_of(samples, per_datagram, padded)
        frames = tools.fields(tools.capture(datagrams), "reckon.pdu.index", "reckon.pdu.offset",
                              "reckon.pdu.type", "reckon.pdus", "reckon.pdu.rule")
        check(len(frames) == len(expected), f"{len(frames)} frames of {len(expected)}")
        for frame, places in zip(frames, expected):
            seen = list(zip(*(map(int, frame[name]) for name in
                              ("reckon.pdu.index", "reckon.pdu.offset", "reckon.pdu.type"))))
            check(seen == places, f"seen {seen}, are {places}")
            check(frame["reckon.pdus"] == [str(len(places))], str(frame))
            check(not frame["reckon.pdu.rule"], f"{frame}: no rule is broken")
    print(f"  {len(samples)} types, alone, in bundles of 5 and 9, padded and not")


def inner(tools):
    """Wireshark's own fields exist for each PDU of a bundle, not only for the first."""
    state = bytearray(tools.samples()["entity_state"])
    datagram = b""
    for entity in range(1, 8):
        struct.pack_into(">H", state, 16, entity)
        datagram += state
    frame, = tools.fields(tools.capture([datagram]), "dis.entity_id_entity", "_ws.malformed")
    check(frame["dis.entity_id_entity"] == [str(n) for n in range(1, 8)], str(frame))
    without = subprocess.run(["tshark", "-n", "-r", str(tools.capture([datagram])), "-T", "fields",
                              "-e", "dis.entity_id_entity"], capture_output=True, text=True, check=True)
    print(f"  {frame['dis.entity_id_entity']}; without the plug-in {without.stdout.split()}")


def flat(value, path=""):
    """(path, leaf) of nested objects, in order."""
    if isinstance(value, dict):
        for key, inside in value.items():
            yield from flat(inside, f"{path}.{key}" if path else key)
    else:
        yield path, value


def numbers_of(fields):
    """The numbers without the names beside them."""
    if isinstance(fields, list):
        return [numbers_of(each) for each in fields]
    if not isinstance(fields, dict):
        return fields
    return {name: numbers_of(value) for name, value in fields.items()
            if not name.endswith(("_name", "_bits", "_read", "_text"))}


def own_values(fields, kind):
    """Values of our own records in one PDU from `reckon inspect --full`: field of the plug-in -> values."""
    values = {}

    def note(prefix, record):
        for path, value in flat(record):
            values.setdefault(f"reckon.{prefix}.{path}", []).append(value)

    fields = numbers_of(fields)
    sets, cells = fields.pop("attribute_record_sets", []), fields.pop("cells", [])
    echoes, peers = fields.pop("echoes", []), fields.pop("peers", [])
    roles, groups = fields.pop("roles", []), fields.pop("groups", [])
    fields.pop("header")
    fields.pop("states", None)
    for epoch in fields.pop("addressees", []):
        note("peer", epoch)
    fields.pop("content", None)
    prefix = {"attribute": "attribute", "presence": "presence", "datagram_trailer": "trailer",
              "cell_membership": "membership", "time_exchange": "exchange",
              "peers_heard": "heard", "cell_roles": "roles", "group_map": "group_map",
              "cell_snapshot": "snapshot", "compressed_states": "compressed",
              "unicast_frame": "unicast", "assured_record": "assured"}.get(kind)
    if prefix:
        note(prefix, fields)
    for cell in cells:
        note("cell", cell)
    for echo in echoes:
        note("echo", echo)
    for peer in peers:
        note("peer", peer)
    for role in roles:
        note("role", role)
    for group in groups:
        note("cell_group", group)
    for one in sets:
        for record in one["attribute_records"]:
            kind = {0x48415001: "haptic", 0x48415003: "energy"}.get(record["record_type"])
            if kind:
                note(kind, record)
    return values


def same(shown, told):
    """Compares a value from tshark with one from JSON; tshark prints 32-bit floats with 6 digits."""
    if isinstance(told, str):  # also numbers that JSON cannot represent
        return shown == told or (shown.startswith("0x") and told == str(int(shown, 16)))
    if shown.startswith("0x"):
        return int(shown, 16) == told
    if isinstance(told, float) or "." in shown or "e" in shown:
        return math.isclose(float(shown), float(told), rel_tol=2e-6, abs_tol=1e-30)
    return int(shown) == told


def values(tools):
    """Each field of our own records and PDUs has the value that `reckon inspect --full` prints."""
    samples = tools.samples()
    wanted = ["attribute", "presence", "datagram_trailer", "cell_membership", "time_exchange",
              "peers_heard", "cell_roles", "group_map", "cell_snapshot",
              "compressed_states", "unicast_frame", "assured_record"]
    capture = tools.capture([samples["entity_state"] + b"".join(samples[name] for name in wanted)])
    expected = {}
    for row in tools.inspect(capture, "--full")[1]:
        for name, told in own_values(row["fields"], row["type"]).items():
            expected.setdefault(name, []).extend(told)
    check(len(expected) > 60, f"{len(expected)} fields to compare")
    frame, = tools.fields(capture, *expected)
    for name, told in expected.items():
        shown = frame[name]
        check(len(shown) == len(told) and all(map(same, shown, told)), f"{name}: {shown}, is {told}")
    registered = {line.split("\t")[2] for line in tools.tshark("-G", "fields").splitlines()
                  if line.startswith("F\t")}
    own = {name for name in registered if name.split(".")[0] == "reckon" and name.count(".") > 1
           and name.split(".")[1] in OWN}
    check(own == set(expected), f"compared in vain or not: {own ^ set(expected)}")
    print(f"  {len(expected)} fields")


def filters(tools):
    """Display filters on our fields select the expected frames."""
    attribute = bytearray(tools.samples()["attribute"])
    datagrams = []
    for stiffness in (100.0, 400.0, 500.0):
        struct.pack_into(">f", attribute, 32 + 8 + 16, stiffness)
        datagrams.append(tools.samples()["entity_state"] + bytes(attribute))
    capture = tools.capture(datagrams)
    for show, frames in (("reckon.haptic.k1 > 400", ["3"]), ("reckon.haptic.k1 >= 400", ["2", "3"]),
                         ('reckon.set.id == "100:7:4"', ["1", "2", "3"]),
                         ("reckon.pdu.type == 72 and reckon.pdu.index == 2", ["1", "2", "3"]),
                         ("reckon.pdu.type == 2", []), ("reckon.pdu.rule", [])):
        found = [frame["frame.number"][0] for frame in tools.fields(capture, "frame.number", show=show)]
        check(found == frames, f"{show}: frames {found}, are {frames}")


def damaged_bundles(samples):
    """(datagram, [(PDU, rule, octet)]): planted faults, and the expected reports."""
    state, attribute = samples["entity_state"], samples["attribute"]
    trailer, data = samples["datagram_trailer"], samples["data"]

    def put(octets, at, form, value):
        changed = bytearray(octets)
        struct.pack_into(">" + form, changed, at, value)
        return bytes(changed)

    first, whole = len(state), len(attribute)
    # One variable datum with a declared length of 2^32 - 1 bits, in 56 octets.
    bomb = put(put(put(data, 8, "H", 56), 32, "I", 0), 36, "I", 1)[:40]
    bomb += struct.pack(">II", 7, 2**32 - 1) + bytes(8)
    return [
        (state + put(state, 8, "H", 9472) + trailer, [(2, "E-TRUNCATED", first + 8)]),
        (state + put(state, 8, "H", 0) + trailer, [(2, "E-LENGTH", first + 8)]),
        (state + state[:100], [(2, "E-TRUNCATED", first + 100)]),
        (state + state[:7], [(2, "E-TRUNCATED", first)]),
        (state + b"\xff\x01\x02", [(2, "E-STRAY", first)]),
        (state + put(state, 0, "B", 4) + trailer, [(2, "E-VERSION", first)]),
        (state + put(state, 2, "B", 220) + trailer, [(2, "I-UNKNOWN-TYPE", first + 2)]),
        (state + put(state, 19, "B", 200) + trailer, [(2, "E-COUNT", first + 19)]),
        (state + put(state, 48, "d", math.nan) + trailer, [(2, "W-NOT-FINITE", first + 48)]),
        (state + put(state, 36, "f", -math.inf) + trailer, [(2, "W-NOT-FINITE", first + 36)]),
        (attribute + put(attribute, 40 + 16, "f", math.nan), [(2, "W-NOT-FINITE", whole + 56)]),
        (attribute + put(attribute, 40 + 4, "H", 5), [(2, "E-RECORD", whole + 40)]),
        (attribute + put(attribute, 40 + 6, "B", 9), [(2, "E-VERSION", whole + 40)]),
        (attribute + put(attribute, 30, "H", 4), [(2, "E-COUNT", whole + whole)]),
        (bomb + trailer, [(1, "E-RECORD", 40)]),
        (b"\x07", [(1, "E-TRUNCATED", 0)]),
        (b"\x07\x01", [(1, "E-TRUNCATED", 0)]),
    ]


def faults_shown(frame):
    return list(zip(frame["reckon.pdu.rule"], map(int, frame["reckon.pdu.at"])))


def faults_told(rows):
    return [(row["rule"], row["at"]) for row in rows if row["status"] != "ok"]


def agree(shown, told):
    """The same rules at the same octets; for NaN in a record `reckon inspect` may report only the PDU."""
    return [rule for rule, _ in shown] == [rule for rule, _ in told] and all(
        here == there or rule == "W-NOT-FINITE" and there < here
        for (rule, here), (_, there) in zip(shown, told))


def damage(tools):
    """A fault is reported with the same rule and octet as in `reckon inspect`; the data after it is kept."""
    planted = damaged_bundles(tools.samples())
    capture = tools.capture([datagram for datagram, _ in planted])
    told = tools.inspect(capture, "--json")
    frames = tools.fields(capture, "reckon.pdu.rule", "reckon.pdu.at", "reckon.pdu.index",
                          "_ws.expert.message")
    check(len(frames) == len(planted), f"{len(frames)} frames")
    for number, (frame, (_, expected)) in enumerate(zip(frames, planted), 1):
        shown = faults_shown(frame)
        check(shown == [fault[1:] for fault in expected], f"frame {number}: {shown}, are {expected}")
        check(agree(shown, faults_told(told[number])), f"frame {number}: inspect has {told[number]}")
        check(len(frame["reckon.pdu.index"]) == len(told[number]), f"frame {number}: {frame}")
        for rule, at in shown:
            check(any(f"{rule} at +{at}" in message for message in frame["_ws.expert.message"]),
                  f"frame {number} has no expert info: {frame}")
    print(f"  {len(planted)} broken bundles")


def foreign(tools):
    """Datagrams that are not DIS are ignored; DIS on another port is found."""
    samples = tools.samples()
    dns = bytes.fromhex("12340100000100000000000007") + b"example\x03org\x00\x00\x01\x00\x01"
    others = [dns, b"GET / HTTP/1.1\r\n\r\n", bytes(64), bytes(range(255, 155, -1)), b"\x07" * 40]
    for port in (53, 5353, 40001):
        for frame in tools.fields(tools.capture(others, port), "frame.protocols"):
            check("reckon" not in frame["frame.protocols"][0], f"port {port}: {frame}")
    on_port = tools.capture(others[:4])
    check(not tools.fields(on_port, "frame.number", show="reckon"), "taken on port 3000")
    for frame in tools.fields(on_port, "frame.protocols"):
        check(frame["frame.protocols"][0].endswith("dis"), f"left to whom the port belongs: {frame}")

    bundle = samples["entity_state"] + samples["attribute"]
    frame, = tools.fields(tools.capture([bundle], 40001), "reckon.pdu.type")
    check(frame["reckon.pdu.type"] == ["1", "72"], f"port 40001: {frame}")
    off = tools.tshark("-o", "reckon.other_ports:FALSE", "-r", tools.capture([bundle], 40001), "-T",
                       "fields", "-e", "frame.protocols")
    check("reckon" not in off, off)
    odd = tools.capture([b"\x07" * 40], 40002)
    moved = tools.tshark("-o", "reckon.ports:40002", "-r", odd, "-T", "fields", "-e", "reckon.pdu.rule")
    check(moved.strip() == "E-TRUNCATED", moved)
    left = tools.tshark("-o", "reckon.ports:40002", "-r", tools.capture([bundle]), "-T", "fields", "-e",
                        "frame.protocols")
    check(left.strip().endswith("dis"), f"the port goes back to its owner: {left}")


def sessions(tools):
    """Recorded exercises: as many PDUs of each type as `reckon inspect` counts."""
    types, told_types, broken, told_broken = {}, {}, [], []
    for capture in tools.data("real-sessions"):
        for frame in tools.fields(capture, "reckon.pdu.type", "reckon.pdu.rule", "reckon.pdu.at"):
            broken += faults_shown(frame)
            for kind in frame["reckon.pdu.type"]:
                types[int(kind)] = types.get(int(kind), 0) + 1
        for rows in tools.inspect(capture, "--json").values():
            told_broken += faults_told(rows)
            for row in rows:
                told_types[row["type_number"]] = told_types.get(row["type_number"], 0) + 1
    check(sum(types.values()) == 6001 and types[ATTRIBUTE] == 2406, str(types))
    check(types[ENTITY_STATE] == 2132, str(types))
    check(types == told_types, f"{types}, inspect has {told_types}")
    check(agree(broken, told_broken), f"{broken}, inspect has {told_broken}")
    print(f"  {sum(types.values())} PDUs, {types}; broken: {broken}")


def generated(tools):
    """Generated captures, including malformed ones: the same PDUs, entities and faults as `reckon inspect`."""
    count = 0
    for capture in tools.data("generated-a"):
        tools.tshark("-V", "-r", capture)
        told = tools.inspect(capture, "--json")
        for number, frame in enumerate(tools.fields(capture, *PLACES), 1):
            if frame["udp.length"] == ["8"]:
                continue  # Wireshark does not call a dissector for an empty datagram
            rows = told[number]
            where = f"{capture.name} frame {number}: {frame}, inspect has {rows}"
            check(list(map(int, frame["reckon.pdu.index"])) == [row["pdu"] for row in rows], where)
            check(list(map(int, frame["reckon.pdu.offset"])) == [row["offset"] for row in rows], where)
            check(frame["reckon.pdu.id"] == [row["id"] for row in rows if "id" in row], where)
            check(agree(faults_shown(frame), faults_told(rows)), where)
            count += len(rows)
    print(f"  {count} PDUs")


BY_FLAGS = ("tspi", "appearance", "le_fire", "le_detonation")


def mutated(tools):
    """Samples with random changes: no Lua error, the same PDUs as in `reckon inspect`, and no fault that `reckon
    inspect` does not report."""
    chance = random.Random(20121278)
    samples, datagrams = list(tools.samples().values()), []
    for _ in range(1500):
        datagram = bytearray(b"".join(chance.choices(samples, k=chance.randint(1, 4))))
        for _ in range(chance.randint(1, 4)):
            datagram[chance.randrange(len(datagram))] = chance.choice((0, 1, 5, 7, 72, 127, 128, 255))
        if chance.random() < 0.3:
            del datagram[chance.randrange(1, len(datagram)):]
        datagram[0] = 7  # otherwise the plug-in may leave it to other dissectors
        datagrams.append(bytes(datagram))
    capture = tools.capture(datagrams)
    tools.tshark("-n", "-V", "-r", capture)
    told, missed, named = tools.inspect(capture, "--json"), [], 0
    for number, frame in enumerate(tools.fields(capture, *PLACES), 1):
        rows = told[number]
        where = f"{datagrams[number - 1].hex()}: {frame}, inspect has {rows}"
        check(list(map(int, frame["reckon.pdu.offset"])) == [row["offset"] for row in rows], where)
        shown, expected = faults_shown(frame), faults_told(rows)
        if not agree(shown, expected):
            if not any(row["type"] in BY_FLAGS for row in rows):
                missed += [fault for fault in expected if fault not in shown]
            shown = [fault for fault in shown if fault in expected]
        named += len(shown)
        check(all(fault in expected or fault[0] == "W-NOT-FINITE" for fault in shown), where)
    # The plug-in does not examine records that contain their own length, fields that flags switch, or octets after
    # the last field. It leaves foreign data to other dissectors.
    unseen = {"I-FOREIGN", "W-TRAILING"}
    check({rule for rule, _ in missed} <= {"E-RECORD", "E-COUNT", "W-NOT-FINITE", *unseen}, str(missed))
    missed = [fault for fault in missed if fault[0] not in unseen]
    check(len(missed) < named / 10, f"{len(missed)} faults are not named, {named} are")
    print(f"  {len(datagrams)} datagrams, {named} faults named, {len(missed)} left to inspect")


def owners(tools):
    """What a message about the owners of bodies is about; nothing where its content is cut short."""
    sample = tools.samples()["assured_record"][:32]
    group = struct.pack(">II", 1700000000, 0xB0B)
    messages = {
        16: (group + struct.pack(">IIIBBBB", 3, 0, 0, 9, 0, 0, 0), "round 9 of act 3"),
        17: (group + struct.pack(">IIII", 4, 7, 2, 0x4A11C0DE) + bytes(48), "act 4, attempt 2 of 4a11c0de"),
        18: (group + struct.pack(">III", 4, 2, 0x4A11C0DE), "vote for act 4, attempt 2 of 4a11c0de"),
        19: (group + struct.pack(">IIHH", 5, 4, 0, 0), "table 5 with 0 owners"),
        20: (group + struct.pack(">I", 5) + bytes(32), "agreement on table 5"),
    }
    for kind, (content, words) in messages.items():
        for octets in (content, content[:-1]):
            record = bytearray(sample + octets)
            struct.pack_into(">H", record, 8, len(record))
            record[16] = kind
            struct.pack_into(">HH", record, 28, 0, len(octets))
            text = tools.tshark("-n", "-r", tools.capture([bytes(record)]), "-O", "reckon")
            check((f": {words}\n" in text) == (octets is content), f"kind {kind}, {len(octets)} octets: {text}")
    print(f"  {len(messages)} kinds")


CASES = {case.__name__: case for case in
         (bundles, inner, values, filters, damage, mutated, foreign, sessions, generated, owners)}


if __name__ == "__main__":
    sys.exit(run_case(__doc__, CASES))
