#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the golden samples beside this file: NAME.hex (octets, one field a line) and NAME.json (values).

Layouts are written out here by hand, in wire order, from the tables of the standard and of
docs/wire_format.md; nothing is taken from the C++ field tables, which the samples are to check.
32-bit floats stand in the JSON in their shortest form.
"""
import json
import pathlib
import struct

HERE = pathlib.Path(__file__).parent


class Sample:
    """Collects fields; a dotted name makes nested objects, `None` as name leaves the JSON alone."""

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
    s = Sample("attribute", 72, 1, 32 + 8 + 72 + 24 + 8 + 16)
    s.many("originating_simulation_address", "site application", "H", (100, 7))
    s.put("padding_1", "I", 0)
    s.put("padding_2", "H", 0)
    s.put("attribute_record_pdu_type", "B", 1)
    s.put("attribute_record_protocol_version", "B", 7)
    s.put("master_attribute_record_type", "I", 0)
    s.put("action_code", "B", 1)
    s.put("padding_3", "B", 0)
    s.put("number_of_attribute_record_sets", "H", 2)
    s.octets("set 1: entity 100:7:3, 2 records", struct.pack(">4H", 100, 7, 3, 2))
    s.octets("haptic: type, length", struct.pack(">IH", 0x48415001, 72))
    s.octets("version, kind, order, flags", bytes((1, 2, 3, 0)))
    s.octets("surface, validity ms, padding", struct.pack(">3H", 17, 12000, 0))
    s.octets("k1 k3 damping mass", struct.pack(">4f", 800.0, 2.5e6, 1.5, 0.25))
    s.octets("point", struct.pack(">3f", 0.01, -0.02, 0.03))
    s.octets("normal", struct.pack(">3f", 0.0, 0.0, -1.0))
    s.octets("friction, restitution, radius", struct.pack(">4f", 0.5, 0.25, 0.75, 0.0625))
    s.octets("energy: type, length", struct.pack(">IH", 0x48415002, 24))
    s.octets("counterpart 200:1:9", struct.pack(">3H", 200, 1, 9))
    s.octets("given, need", struct.pack(">df", 0.001953125, 0.5))
    s.octets("set 2: entity 100:7:4, 1 record", struct.pack(">4H", 100, 7, 4, 1))
    s.octets("vendor record 252000", struct.pack(">IH", 252000, 16) + bytes(range(10)))
    xyz = lambda *v: dict(zip("xyz", v))
    ids = lambda *v: dict(zip(("site", "application", "entity"), v))
    s.values["attribute_record_sets"] = [
        {"entity_id": ids(100, 7, 3), "number_of_attribute_records": 2, "attribute_records": [
            {"record_type": 0x48415001, "record_length": 72, "version": 1, "kind": 2, "order": 3,
             "flags": 0, "surface": 17, "validity_ms": 12000, "padding": 0, "k1": 800.0, "k3": 2.5e6,
             "damping": 1.5, "mass": 0.25, "point": xyz(0.01, -0.02, 0.03), "normal": xyz(0, 0, -1),
             "static_friction": 0.5, "kinetic_friction": 0.25, "restitution": 0.75, "radius": 0.0625},
            {"record_type": 0x48415002, "record_length": 24, "counterpart": ids(200, 1, 9),
             "given": 0.001953125, "need": 0.5}]},
        {"entity_id": ids(100, 7, 4), "number_of_attribute_records": 1, "attribute_records": [
            {"record_type": 252000, "record_length": 16, "body": bytes(range(10)).hex()}]}]
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
    presence = Sample("presence", 140, 129, 112)
    presence.many("simulation_address", "site application", "H", (0xBEEF, 2))
    presence.put("epoch", "I", 0x89ABCDEF)
    presence.put("pool_size", "H", 256)
    presence.put("port", "H", 3000)
    presence.put("scene_hash", "Q", 0x0123456789ABCDEF)
    presence.put("send_time", "Q", 1790000000123456789)
    presence.put("base_group", "hex", "00000000000000000000ffffefc00100")
    presence.put("cell_scheme", "B", 2)
    presence.put("padding_1", "B", 0)
    presence.put("flags", "H", 4)
    presence.put("cell_size", "f", 25.0)
    presence.vector("scene_origin", "d", (4075539.5, 931735.25, 4801629.125))
    presence.put("interest_radius", "f", 40.0)
    presence.put("started", "I", 1789999999)
    presence.put("name", "text16", "left hand")
    trailer = Sample("datagram_trailer", 141, 129, 24)
    trailer.put("sequence", "I", 0xFFFFFFFF)
    trailer.put("epoch", "I", 0x89ABCDEF)
    trailer.put("send_time", "I", 0x01020304)
    cells = Sample("cell_membership", 142, 129, 32 + 16)
    cells.many("simulation_address", "site application", "H", (0xBEEF, 2))
    cells.put("epoch", "I", 0x89ABCDEF)
    cells.put("action", "B", 1)
    cells.put("padding", "B", 0)
    cells.put("number_of_cells", "H", 2)
    cells.put("since", "Q", 1790000000000000000)
    cells.octets("cell -1, 5", struct.pack(">ii", -1, 5))
    cells.octets("cell 2147483647, -2147483648", struct.pack(">ii", 2**31 - 1, -2**31))
    cells.values["cells"] = [{"column": -1, "row": 5}, {"column": 2**31 - 1, "row": -2**31}]
    return presence, trailer, cells


for sample in (entity_state(), attribute(), *collisions(), *management(), *datums(), *experimental()):
    sample.write()
