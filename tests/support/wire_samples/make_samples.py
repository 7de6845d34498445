#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the golden samples beside this file: NAME.hex (octets, one field a line) and NAME.json (values).

Layouts are written by hand here and in layouts.txt, in wire order, from the tables of the standard and of
docs/wire_format.md. Nothing comes from the C++ field tables, because the samples check these. 32-bit floats have
their shortest form in the JSON.
"""
import json
import pathlib
import struct

HERE = pathlib.Path(__file__).parent


class Sample:
    """Collects fields; a dotted name creates nested objects, `None` as name omits the field from the JSON."""

    def __init__(self, name, pdu_type, family, length, timestamp=0x12345679, status=0):
        self.name, self.lines, self.values, self.size = name, [], {}, 0
        self.wanted = length
        for field, form, value in (
                ("protocol_version", "B", 7), ("exercise_id", "B", 3), ("pdu_type", "B", pdu_type),
                ("protocol_family", "B", family), ("timestamp", "I", timestamp),
                ("length", "H", length), ("pdu_status", "B", status), ("padding", "B", 0)):
            self.put("header." + field, form, value)

    def octets(self, field, octets):
        self.lines.append(f"{octets.hex(' '):<48} # {self.size:3} {field}")
        self.size += len(octets)

    def put(self, field, form, value):
        if form == "hex":
            octets = bytes.fromhex(value)
        elif form.startswith("text"):
            octets = value.encode().ljust(int(form[4:]), b"\0")
        else:
            octets = struct.pack(">" + form, value)
        self.octets(field, octets)
        at, *path = self.values, *field.split(".")
        for key in path[:-1]:
            at = at.setdefault(key, {})
        at[path[-1]] = value

    def many(self, prefix, names, form, values):
        for name, value in zip(names.split(), values):
            self.put(f"{prefix}.{name}", form, value)

    def entity(self, field, site, application, entity):
        self.many(field, "site application entity", "H", (site, application, entity))

    def vector(self, field, form, values):
        self.many(field, "x y z", form, values)

    def entity_type(self, field, kind, domain, country, *rest):
        self.put(field + ".kind", "B", kind)
        self.put(field + ".domain", "B", domain)
        self.put(field + ".country", "H", country)
        self.many(field, "category subcategory specific extra", "B", rest)

    def write(self):
        assert self.size == self.wanted, (self.name, self.size, self.wanted)
        licence = "# SPDX-FileCopyrightText: 2026 The Reckon authors\n# SPDX-License-Identifier: Apache-2.0\n"
        (HERE / f"{self.name}.hex").write_text(licence + "\n".join(self.lines) + "\n")
        (HERE / f"{self.name}.json").write_text(json.dumps(self.values, indent=1) + "\n")


def entity_state():
    s = Sample("entity_state", 1, 1, 176, status=8)
    s.entity("entity_id", 100, 7, 3)
    s.put("force_id", "B", 1)
    s.put("number_of_variable_parameter_records", "B", 2)
    s.entity_type("entity_type", 1, 2, 225, 1, 2, 3, 4)
    s.entity_type("alternate_entity_type", 1, 2, 222, 5, 6, 7, 8)
    s.vector("entity_linear_velocity", "f", (1.5, -2.25, 0.125))
    s.vector("entity_location", "d", (4437345.6789, 1061234.5, 4443210.0625))
    s.many("entity_orientation", "psi theta phi", "f", (0.5, -0.25, 3.0))
    s.put("entity_appearance", "I", 0x00A00001)
    s.put("dead_reckoning_parameters.dead_reckoning_algorithm", "B", 4)
    s.put("dead_reckoning_parameters.other_parameters", "hex", "0102030405060708090a0b0c0d0e0f")
    s.vector("dead_reckoning_parameters.entity_linear_acceleration", "f", (0.1, 0.2, -9.81))
    s.vector("dead_reckoning_parameters.entity_angular_velocity", "f", (0.01, -0.02, 0.03))
    s.put("entity_marking.entity_marking_character_set", "B", 1)
    s.put("entity_marking.entity_marking_string", "text11", "HAND-1")
    s.put("capabilities", "I", 0x80000001)
    s.octets("articulated part", struct.pack(">BBHIfI", 0, 5, 1, 4107, 0.75, 0))
    s.octets("vendor record 240", bytes([240]) + bytes(range(1, 16)))
    s.values["variable_parameters"] = [
        {"record_type": 0, "change_indicator": 5, "part_attached_to": 1, "parameter_type": 4107,
         "parameter_value": 0.75, "padding": 0},
        {"record_type": 240, "body": bytes(range(1, 16)).hex()}]
    return s


def attribute():
    s = Sample("attribute", 72, 1, 32 + 8 + 72 + 24 + 8 + 16 + 8 + 24)
    s.many("originating_simulation_address", "site application", "H", (100, 7))
    s.put("padding_1", "I", 0)
    s.put("padding_2", "H", 0)
    s.put("attribute_record_pdu_type", "B", 1)
    s.put("attribute_record_protocol_version", "B", 7)
    s.put("master_attribute_record_type", "I", 0)
    s.put("action_code", "B", 1)
    s.put("padding_3", "B", 0)
    s.put("number_of_attribute_record_sets", "H", 3)
    s.octets("set 1: entity 100:7:3, 2 records", struct.pack(">4H", 100, 7, 3, 2))
    s.octets("haptic: type, length", struct.pack(">IH", 0x48415001, 72))
    s.octets("version, kind, order, flags", bytes((1, 2, 3, 0)))
    s.octets("surface, validity ms, grip stiffness", struct.pack(">3H", 17, 12000, 170))
    s.octets("k1 k3 damping mass", struct.pack(">4f", 800.0, 2.5e6, 1.5, 0.25))
    s.octets("point", struct.pack(">3f", 0.01, -0.02, 0.03))
    s.octets("normal", struct.pack(">3f", 0.0, 0.0, -1.0))
    s.octets("friction, restitution, radius", struct.pack(">4f", 0.5, 0.25, 0.75, 0.0625))
    s.octets("energy: type, length", struct.pack(">IH", 0x48415003, 24))
    s.octets("counterpart 200:1:9", struct.pack(">3H", 200, 1, 9))
    s.octets("given, need, spring need", struct.pack(">dHH", 0.001953125, 500, 7500))
    s.octets("set 2: entity 100:7:4, 1 record", struct.pack(">4H", 100, 7, 4, 1))
    s.octets("vendor record 252000", struct.pack(">IH", 252000, 16) + bytes(range(10)))
    s.octets("set 3: entity 65534:1:2, 1 record", struct.pack(">4H", 65534, 1, 2, 1))
    s.octets("ownership: type, length, flags, padding", struct.pack(">IHBB", 0x48415004, 24, 0, 0))
    s.octets("owner, world, version", struct.pack(">IIQ", 0xA1B2C3D4, 0, 0x100000002))
    xyz = lambda *v: dict(zip("xyz", v))
    ids = lambda *v: dict(zip(("site", "application", "entity"), v))
    s.values["attribute_record_sets"] = [
        {"entity_id": ids(100, 7, 3), "number_of_attribute_records": 2, "attribute_records": [
            {"record_type": 0x48415001, "record_length": 72, "version": 1, "kind": 2, "order": 3,
             "flags": 0, "surface": 17, "validity_ms": 12000, "grip_stiffness": 170, "k1": 800.0, "k3": 2.5e6,
             "damping": 1.5, "mass": 0.25, "point": xyz(0.01, -0.02, 0.03), "normal": xyz(0, 0, -1),
             "static_friction": 0.5, "kinetic_friction": 0.25, "restitution": 0.75, "radius": 0.0625},
            {"record_type": 0x48415003, "record_length": 24, "counterpart": ids(200, 1, 9),
             "given": 0.001953125, "need": 500, "spring_need": 7500}]},
        {"entity_id": ids(100, 7, 4), "number_of_attribute_records": 1, "attribute_records": [
            {"record_type": 252000, "record_length": 16, "body": bytes(range(10)).hex()}]},
        {"entity_id": ids(65534, 1, 2), "number_of_attribute_records": 1, "attribute_records": [
            {"record_type": 0x48415004, "record_length": 24, "flags": 0, "padding": 0,
             "owner": 0xA1B2C3D4, "world": 0, "version": 0x100000002}]}]
    return s


def collisions():
    s = Sample("collision", 4, 1, 60)
    s.entity("issuing_entity_id", 1, 2, 3)
    s.entity("colliding_entity_id", 4, 5, 6)
    s.many("event_id", "site application event", "H", (1, 2, 77))
    s.put("collision_type", "B", 1)
    s.put("padding", "B", 0)
    s.vector("velocity", "f", (1.0, 2.0, -3.0))
    s.put("mass", "f", 12.5)
    s.vector("location", "f", (0.1, 0.2, 0.3))
    e = Sample("collision_elastic", 66, 1, 100)
    e.entity("issuing_entity_id", 1, 2, 3)
    e.entity("colliding_entity_id", 4, 5, 6)
    e.many("collision_event_id", "site application event", "H", (1, 2, 78))
    e.put("padding", "H", 0)
    e.vector("contact_velocity", "f", (1.0, 2.0, -3.0))
    e.put("mass", "f", 0.2)
    e.vector("location_of_impact", "f", (0.1, 0.2, 0.3))
    e.many("collision_intermediate_result", "xx xy xz yy yz zz", "f", (5.0, 0.5, -0.25, 4.0, 0.125, 3.0))
    e.vector("unit_surface_normal", "f", (0.0, 0.6, 0.8))
    e.put("coefficient_of_restitution", "f", 0.9)
    return s, e


def managed(name, pdu_type, length):
    s = Sample(name, pdu_type, 5, length)
    s.entity("originating_entity_id", 10, 11, 12)
    s.entity("receiving_entity_id", 65535, 65535, 65535)
    return s


def management():
    create, remove = managed("create_entity", 11, 28), managed("remove_entity", 12, 28)
    start, stop = managed("start_resume", 13, 44), managed("stop_freeze", 14, 40)
    acknowledge = managed("acknowledge", 15, 32)
    for s in (start, stop):
        s.many("real_world_time", "hour", "i", (480000,))
        s.many("real_world_time", "time_past_hour", "I", (0x23456789,))
    start.many("simulation_time", "hour", "i", (-1,))
    start.many("simulation_time", "time_past_hour", "I", (0xFFFFFFFE,))
    stop.put("reason", "B", 2)
    stop.put("frozen_behavior", "B", 5)
    stop.put("padding", "H", 0)
    acknowledge.put("acknowledge_flag", "H", 3)
    acknowledge.put("response_flag", "H", 1)
    all_of_them = (create, remove, start, stop, acknowledge)
    for number, s in enumerate(all_of_them):
        s.put("request_id", "I", 0xA0B0C0D0 + number)
    return all_of_them


def datums():
    data, comment = managed("data", 20, 40 + 16 + 16 + 24), managed("comment", 22, 32 + 24)
    data.put("request_id", "I", 41)
    data.put("padding", "I", 0)
    data.put("number_of_fixed_datum_records", "I", 2)
    data.put("number_of_variable_datum_records", "I", 2)
    data.octets("fixed datum 1", struct.pack(">II", 1000, 7))
    data.octets("fixed datum 2", struct.pack(">II", 1001, 0xFFFFFFFF))
    data.octets("variable datum 1, 64 bits", struct.pack(">II", 2000, 64) + bytes(range(8)))
    data.octets("variable datum 2, 71 bits", struct.pack(">II", 2001, 71) + b"\xf1" * 9 + bytes(7))
    data.values["fixed_datum_records"] = [
        {"fixed_datum_id": 1000, "fixed_datum_value": 7},
        {"fixed_datum_id": 1001, "fixed_datum_value": 0xFFFFFFFF}]
    data.values["variable_datum_records"] = [
        {"variable_datum_id": 2000, "variable_datum_length": 64,
         "variable_datum_value": bytes(range(8)).hex()},
        {"variable_datum_id": 2001, "variable_datum_length": 71, "variable_datum_value": "f1" * 9}]
    text = b"hand touches"
    comment.put("number_of_fixed_datum_records", "I", 0)
    comment.put("number_of_variable_datum_records", "I", 1)
    comment.octets("variable datum", struct.pack(">II", 3000, 8 * len(text)) + text.ljust(16, b"\0"))
    comment.values["fixed_datum_records"] = []
    comment.values["variable_datum_records"] = [
        {"variable_datum_id": 3000, "variable_datum_length": 8 * len(text),
         "variable_datum_value": text.hex()}]
    return data, comment


def experimental():
    presence = Sample("presence", 140, 129, 160)
    presence.many("simulation_address", "site application", "H", (0xBEEF, 2))
    presence.put("epoch", "I", 0x89ABCDEF)
    presence.put("pool_size", "H", 256)
    presence.put("port", "H", 3000)
    presence.put("scene_hash", "Q", 0x0123456789ABCDEF)
    presence.put("send_time", "Q", 1790000000123456789)
    presence.put("base_group", "hex", "00000000000000000000ffffefc00100")
    presence.put("cell_scheme", "B", 2)
    presence.put("scene_peer", "B", 2)
    presence.put("flags", "H", 4)
    presence.put("cell_size", "f", 25.0)
    presence.vector("scene_origin", "d", (4075539.5, 931735.25, 4801629.125))
    presence.put("interest_radius", "f", 40.0)
    presence.put("started", "I", 1789999999)
    presence.put("name", "text16", "left hand")
    presence.put("chain_number", "I", 258)
    presence.put("slot_time", "I", 20123)
    presence.put("chain_link", "hex", bytes(range(0x10, 0x20)).hex())
    presence.put("next_anchor", "hex", bytes(range(0x20, 0x30)).hex())
    presence.put("address_mac", "hex", bytes(range(0x40, 0x48)).hex())
    trailer = Sample("datagram_trailer", 141, 129, 24)
    trailer.put("sequence", "I", 0xFFFFFFFF)
    trailer.put("epoch", "I", 0x89ABCDEF)
    trailer.put("send_time", "I", 0x01020304)
    cells = Sample("cell_membership", 142, 129, 32 + 16)
    cells.many("simulation_address", "site application", "H", (0xBEEF, 2))
    cells.put("epoch", "I", 0x89ABCDEF)
    cells.put("action", "B", 5)
    cells.put("near_row", "B", 2)
    cells.put("number_of_cells", "H", 2)
    cells.put("since", "Q", 1790000000000000000)
    cells.octets("cell -1, 5", struct.pack(">ii", -1, 5))
    cells.octets("cell 2147483647, -2147483648", struct.pack(">ii", 2**31 - 1, -2**31))
    cells.values["cells"] = [{"column": -1, "row": 5}, {"column": 2**31 - 1, "row": -2**31}]
    exchange = Sample("time_exchange", 143, 129, 24 + 24)
    exchange.many("simulation_address", "site application", "H", (0xBEEF, 2))
    exchange.put("epoch", "I", 0x89ABCDEF)
    exchange.put("number_of_echoes", "H", 2)
    exchange.put("padding", "H", 0)
    exchange.octets("echo to 0x01234567", struct.pack(">III", 0x01234567, 0xFFFFFFF0, 0x10))
    exchange.octets("echo to 0xfedcba98", struct.pack(">III", 0xFEDCBA98, 0x80000000, 0x7FFFFFFF))
    exchange.values["echoes"] = [
        {"epoch": 0x01234567, "sent": 0xFFFFFFF0, "heard": 0x10},
        {"epoch": 0xFEDCBA98, "sent": 0x80000000, "heard": 0x7FFFFFFF}]
    heard = Sample("peers_heard", 144, 129, 24 + 8)
    heard.many("simulation_address", "site application", "H", (0xBEEF, 2))
    heard.put("epoch", "I", 0x89ABCDEF)
    heard.put("number_of_peers", "H", 2)
    heard.put("continues", "H", 0)
    heard.octets("peer 0x01234567", struct.pack(">I", 0x01234567))
    heard.octets("peer 0xfedcba98", struct.pack(">I", 0xFEDCBA98))
    heard.values["peers"] = [{"epoch": 0x01234567}, {"epoch": 0xFEDCBA98}]
    roles = Sample("cell_roles", 145, 129, 24 + 80)
    roles.many("simulation_address", "site application", "H", (0xBEEF, 2))
    roles.put("epoch", "I", 0x89ABCDEF)
    roles.put("number_of_roles", "H", 2)
    roles.put("padding", "H", 0)
    names = ("column", "row", "entered", "successor", "beacon", "flags", "serial", "first_part", "padding", "parts")
    roles.values["roles"] = []
    for row in ((-1, 5, 1790000000000000000, 0x01234567, 0xCAFE, 1, 0, 0, 0, 0),
                (-2**31, -2**31, 1790000000000000001, 0, 0, 4, 7, 64, 0, 0x8000000000000001)):
        roles.octets(f"role in cell {row[0]}, {row[1]}", struct.pack(">iiQIIHHHHQ", *row))
        roles.values["roles"].append(dict(zip(names, row)))
    groups = Sample("group_map", 146, 129, 32 + 32)
    groups.many("simulation_address", "site application", "H", (0xBEEF, 2))
    groups.put("epoch", "I", 0x89ABCDEF)
    groups.put("version", "I", 41)
    groups.put("part", "H", 1)
    groups.put("parts", "H", 2)
    groups.put("pool", "H", 256)
    groups.put("number_of_groups", "H", 2)
    names = ("column", "row", "beacon", "group", "padding")
    groups.values["groups"] = []
    for row in ((-1, 5, 0xCAFE, 12, 0), (3, -4, 0, 256, 0)):
        groups.octets(f"group of cell {row[0]}, {row[1]}", struct.pack(">iiIHH", *row))
        groups.values["groups"].append(dict(zip(names, row)))
    snapshot = Sample("cell_snapshot", 147, 129, 36 + 12)
    snapshot.many("simulation_address", "site application", "H", (0xBEEF, 2))
    snapshot.put("epoch", "I", 0x89ABCDEF)
    snapshot.put("column", "i", -1)
    snapshot.put("row", "i", 5)
    snapshot.put("serial", "H", 7)
    snapshot.put("part", "H", 3)
    snapshot.put("parts", "H", 125)
    snapshot.put("states_length", "H", 12)
    states = struct.pack(">IHH", 0x01234567, 4, 250) + bytes((1, 2, 3, 4))
    snapshot.octets("states", states)
    snapshot.values["states"] = states.hex()
    unicast = Sample("unicast_frame", 148, 129, 16)
    unicast.put("group", "H", 0x0102)
    unicast.put("padding", "H", 0)
    return presence, trailer, cells, exchange, heard, roles, groups, snapshot, unicast


# The lines of layouts.txt: codes of structures, then the PDUs.
LAYOUTS = [line for line in (HERE / "layouts.txt").read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
STRUCTURES = dict(line[2:].split(" ", 1) for line in LAYOUTS if line.startswith("* "))


class LaidOut(Sample):
    """A sample with values derived from the offset of each field, so that neighbours differ."""

    def __init__(self, name, pdu_type, family):
        super().__init__(name, pdu_type, family, 0)

    def value(self, code):
        if code in "fd":
            return (self.size * 37 % 401 - 200) / 8
        size = struct.calcsize(">" + code)
        return int.from_bytes(bytes((self.size + 17 * k) % 127 + 1 for k in range(size)), "big")

    def field(self, into, where, code, name, given):
        form = STRUCTURES.get(code, code)
        if code == "hex":
            self.octets(where + name, bytes.fromhex(given))
            into[name] = given
        elif code.endswith("-"):
            self.octets("padding", bytes(int(code[:-1])))
        elif code.endswith("x"):
            octets = bytes((self.size + 3 * k) % 256 for k in range(int(code[:-1])))
            self.octets(where + name, octets)
            into[name] = octets.hex()
        elif code.startswith("text"):
            self.octets(where + name, given.encode().ljust(int(code[4:]), b"\0"))
            into[name] = given
        elif ":" in form:
            into[name] = {}
            self.record(into[name], where + name + ".", form)
        else:
            into[name] = int(given) if given else self.value(form)
            self.octets(where + name, struct.pack(">" + form, into[name]))

    def record(self, into, where, text):
        for token in text.split():
            code, _, rest = token.partition(":")
            name, _, given = rest.partition("=")
            self.field(into, where, code, name, given)

    def line(self, text):
        code, _, rest = text.partition(" ")
        if code == "&":
            path, _, tokens = rest.partition(" ")
            self.record(self.values[path][-1], path + ".", tokens)
            return
        if code != "@":
            self.field(self.values, "", code, *rest.partition("=")[::2])
            return
        path, _, tokens = rest.partition(" ")
        *outer, last = path.split("/")
        at = self.values
        for key in outer:
            at = at[key][-1]
        items = at.setdefault(last, [])
        if tokens:
            items.append({})
            self.record(items[-1], path + ".", tokens)

    def write(self):
        self.values["header"]["length"] = self.wanted = self.size
        at = next(k for k, text in enumerate(self.lines) if text.endswith("header.length"))
        self.lines[at] = self.lines[at].replace("00 00", struct.pack(">H", self.size).hex(" "), 1)
        super().write()


def laid_out():
    layouts = "\n".join(line for line in LAYOUTS if not line.startswith("* "))
    for block in layouts.strip().split("\n= "):
        first, *lines = block.strip("= \n").split("\n")
        name, pdu_type, family = first.split()
        sample = LaidOut(name, int(pdu_type), int(family))
        for text in lines:
            for part in [text] if text[0] in "@&" else text.split(", "):
                sample.line(part)
        yield sample


for sample in (entity_state(), attribute(), *collisions(), *management(), *datums(), *experimental(), *laid_out()):
    sample.write()
