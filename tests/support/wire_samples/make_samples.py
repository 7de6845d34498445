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
    s.octets("energy: type, length", struct.pack(">IH", 0x48415003, 24))
    s.octets("counterpart 200:1:9", struct.pack(">3H", 200, 1, 9))
    s.octets("given, need, spring need", struct.pack(">dHH", 0.001953125, 500, 7500))
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
            {"record_type": 0x48415003, "record_length": 24, "counterpart": ids(200, 1, 9),
             "given": 0.001953125, "need": 500, "spring_need": 7500}]},
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


# Further PDUs, in wire order. "= NAME TYPE FAMILY" begins one; then fields "CODE name" or "CODE name=value", separated by
# commas. "@ list CODE:name ..." is one record of a list, "@ list/inner" one of a list in the last record (without fields: the inner
# list is empty), "& list ..." goes on with the last record. Nx = N octets shown in hexadecimal, N- = N octets of padding that are not shown, hex = given octets. Codes of structure:
STRUCTURES = {
    "E": "H:site H:application H:entity", "V": "H:site H:application H:event", "S": "H:site H:application",
    "T": "B:kind B:domain H:country B:category B:subcategory B:specific B:extra",
    "C": "i:hour I:time_past_hour", "w": "d:x d:y d:z", "v": "f:x f:y f:z", "e": "f:psi f:theta f:phi",
    "D": "T:munition_type H:warhead H:fuse H:quantity H:rate", "O": "B:domain B:kind B:category B:subcategory",
    "id4": "B:site B:application H:entity", "address2": "B:site B:application",
    "relative": "H:reference_point h:delta_x h:delta_y h:delta_z", "v16": "h:x h:y h:z", "v8": "b:x b:y b:z",
    "e16": "h:psi h:theta h:phi",
    "positions": "H:horizontal_error H:vertical_error", "orientations": "H:azimuth_error H:elevation_error H:rotation_error",
    "reckoning": "B:dead_reckoning_algorithm v8:entity_linear_acceleration v8:entity_angular_velocity",
    "modulation6": "H:spread_spectrum H:major_modulation H:detail H:radio_system=6",
    "sincgars": "H:frequency_hopping_network_id H:frequency_set_id H:frequency_lockout_set_id B:start_of_message B:reserved"
                " I:sync_time_offset H:transmission_security_key B:clear_channel B:padding",
    "beam": "e:beam_direction f:azimuth_beamwidth f:elevation_beamwidth B:reference_system B:padding_1 H:padding_2 f:ez"
            " f:ex f:phase I:padding_3",
    "marking": "B:entity_marking_character_set text11:entity_marking_string=LIVE-1", "e8": "b:psi b:theta b:phi", "F": "B", "A": "B", "K": "H", "L": "H", "R": "B"}
LAYOUTS = """
= fire 2 2
E firing_entity_id, E target_entity_id, E munition_expendable_id, V event_id, I fire_mission_index
w location_in_world_coordinates, D descriptor, v velocity, f range
= detonation 3 2
E source_entity_id, E target_entity_id, E exploding_entity_id, V event_id, v velocity
w location_in_world_coordinates, D descriptor, v location_in_entity_coordinates, B detonation_result
B number_of_variable_parameter_records=2, H padding=0
@ variable_parameters B:record_type=1 B:detached_indicator H:part_attached_to I:parameter_type T:attached_part_type
@ variable_parameters B:record_type=240 15x:body
= entity_state_update 67 1
E entity_id, B padding=0, B number_of_variable_parameter_records=2, v entity_linear_velocity, w entity_location
e entity_orientation, I entity_appearance
@ variable_parameters B:record_type=1 B:detached_indicator H:part_attached_to I:parameter_type T:attached_part_type
@ variable_parameters B:record_type=240 15x:body
= designator 24 6
E designating_entity_id, H code_name, E designated_entity_id, H designator_code, f designator_power
f designator_wavelength, v designator_spot_with_respect_to_designated_entity, w designator_spot_location
A spot_dead_reckoning_algorithm, B padding_1=0, H padding_2=0, v spot_linear_acceleration
= action_request 16 5
E originating_entity_id, E receiving_entity_id, I request_id, I action_id, I number_of_fixed_datum_records=1
I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= action_response 17 5
E originating_entity_id, E receiving_entity_id, I request_id, I request_status, I number_of_fixed_datum_records=1
I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= data_query 18 5
E originating_entity_id, E receiving_entity_id, I request_id, I time_interval, I number_of_fixed_datum_ids=2
I number_of_variable_datum_ids=2
@ fixed_datum_ids I:datum_id
@ fixed_datum_ids I:datum_id
@ variable_datum_ids I:datum_id
@ variable_datum_ids I:datum_id
= set_data 19 5
E originating_entity_id, E receiving_entity_id, I request_id, I padding=0, I number_of_fixed_datum_records=1
I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= event_report 21 5
E originating_entity_id, E receiving_entity_id, I event_type, I padding=0, I number_of_fixed_datum_records=1
I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= transmitter 25 4
E radio_reference_id, H radio_number, T radio_type, B transmit_state, B input_source
H number_of_variable_transmitter_parameters=2, w antenna_location, v relative_antenna_location
H antenna_pattern_type=1, H length_of_antenna_pattern=40, Q frequency, f transmit_frequency_bandwidth, f power
modulation6 modulation_type, H crypto_system, H crypto_key_id, B length_of_modulation_parameters=16, B padding_1=0
H padding_2=0, sincgars modulation_parameters, beam antenna_pattern
@ variable_transmitter_parameters I:record_type=4600 H:record_length=16 10x:body
@ variable_transmitter_parameters I:record_type=252000 H:record_length=8 2x:body
= signal 26 4
E radio_reference_id, H radio_number, H encoding_scheme, H tdl_type, I sample_rate, H data_length=71, H samples
9x data, 3-
= receiver 27 4
E radio_reference_id, H radio_number, H receiver_state, H padding=0, f received_power
E transmitter_radio_reference_id, H transmitter_radio_number
= intercom_signal 31 4
E intercom_reference_id, H intercom_number, H encoding_scheme, H tdl_type, I sample_rate, H data_length=71
H samples, 9x data, 3-
= intercom_control 32 4
B control_type, B communications_channel_type, E source_entity_id, H source_intercom_number, B source_line_id
B transmit_priority, B transmit_line_state, B command, E master_intercom_reference_id, H master_intercom_number
H master_channel_id, I length_of_intercom_parameters=12, 12x intercom_parameters
= create_entity_r 51 10
E originating_entity_id, E receiving_entity_id, B required_reliability_service, B padding_1=0, H padding_2=0
I request_id
= remove_entity_r 52 10
E originating_entity_id, E receiving_entity_id, B required_reliability_service, B padding_1=0, H padding_2=0
I request_id
= start_resume_r 53 10
E originating_entity_id, E receiving_entity_id, C real_world_time, C simulation_time, B required_reliability_service
B padding_1=0, H padding_2=0, I request_id
= stop_freeze_r 54 10
E originating_entity_id, E receiving_entity_id, C real_world_time, R reason, B frozen_behavior
B required_reliability_service, B padding=0, I request_id
= acknowledge_r 55 10
E originating_entity_id, E receiving_entity_id, K acknowledge_flag, L response_flag, I request_id
= action_request_r 56 10
E originating_entity_id, E receiving_entity_id, B required_reliability_service, B padding_1=0, H padding_2=0
I request_id, I action_id, I number_of_fixed_datum_records=1, I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= action_response_r 57 10
E originating_entity_id, E receiving_entity_id, I request_id, I response_status, I number_of_fixed_datum_records=1
I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= data_query_r 58 10
E originating_entity_id, E receiving_entity_id, B required_reliability_service, B padding_1=0, H padding_2=0
I request_id, I time_interval, I number_of_fixed_datum_ids=2, I number_of_variable_datum_ids=2
@ fixed_datum_ids I:datum_id
@ fixed_datum_ids I:datum_id
@ variable_datum_ids I:datum_id
@ variable_datum_ids I:datum_id
= set_data_r 59 10
E originating_entity_id, E receiving_entity_id, B required_reliability_service, B padding_1=0, H padding_2=0
I request_id, I number_of_fixed_datum_records=1, I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= data_r 60 10
E originating_entity_id, E receiving_entity_id, I request_id, B required_reliability_service, B padding_1=0
H padding_2=0, I number_of_fixed_datum_records=1, I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= event_report_r 61 10
E originating_entity_id, E receiving_entity_id, I event_type, I padding=0, I number_of_fixed_datum_records=1
I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= comment_r 62 10
E originating_entity_id, E receiving_entity_id, I number_of_fixed_datum_records=1
I number_of_variable_datum_records=2
@ fixed_datum_records I:fixed_datum_id I:fixed_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
@ variable_datum_records I:variable_datum_id I:variable_datum_length=17 3x:variable_datum_value 5-
= record_r 63 10
E originating_entity_id, E receiving_entity_id, I request_id, B required_reliability_service, B padding=0
H event_type, I response_serial_number, I number_of_record_sets=2
@ record_sets I:record_id=25000 I:record_set_serial_number I:padding=0 H:record_length=32 H:record_count=3 16x:body
@ record_sets I:record_id=25001 I:record_set_serial_number I:padding=0 H:record_length=64 H:record_count=0 0x:body
= set_record_r 64 10
E originating_entity_id, E receiving_entity_id, I request_id, B required_reliability_service, B padding_1=0
H padding_2=0, I padding_3=0, I number_of_record_sets=2
@ record_sets I:record_id=25000 I:record_set_serial_number I:padding=0 H:record_length=32 H:record_count=3 16x:body
@ record_sets I:record_id=25001 I:record_set_serial_number I:padding=0 H:record_length=64 H:record_count=0 0x:body
= record_query_r 65 10
E originating_entity_id, E receiving_entity_id, I request_id, B required_reliability_service, B padding=0
H event_type, I time, I number_of_record_ids=2
@ record_ids I:datum_id
@ record_ids I:datum_id
= environmental_process 41 9
E environmental_process_id, T environment_type, B model_type, B environment_status
H number_of_environment_records=6, H sequence_number
@ environment_records I:record_type=655360 H:record_length=256 B:record_index B:padding=0 w:location
@ environment_records I:record_type=786432 H:record_length=448 B:record_index B:padding=0 w:start w:end
@ environment_records I:record_type=65536 H:record_length=320 B:record_index B:padding=0 w:center f:radius I:geometry_padding
@ environment_records I:record_type=1048576 H:record_length=448 B:record_index B:padding=0 w:center v:sigma e:orientation
@ environment_records I:record_type=5242880 H:record_length=512 B:record_index B:padding=0 w:corner v:lengths e:orientation 8x:further_octets
@ environment_records I:record_type=8200 H:record_length=100 B:record_index B:padding=0 8x:body
= gridded_data 42 9
E environmental_simulation_application_id, H field_number, H pdu_number, H pdu_total, H coordinate_system
B number_of_grid_axes=2, B constant_grid, T environment_type, e orientation, C sample_time, I total_values
B vector_dimension=3, B padding_1=0, H padding_2=0
@ grid_axes d:domain_initial_xi d:domain_final_xi H:domain_points_xi B:interleaf_factor B:axis_type=0 H:number_of_points_on_xi_axis H:initial_index
@ grid_axes d:domain_initial_xi d:domain_final_xi H:domain_points_xi B:interleaf_factor B:axis_type=1 H:number_of_points_on_xi_axis=3 H:initial_index d:coordinate_scale_xi d:coordinate_offset_xi
@ grid_axes/values H:value
@ grid_axes/values H:value
@ grid_axes/values H:value
& grid_axes 2x:padding
@ grid_data H:sample_type H:data_representation=0 H:number_of_values=3 4x:values
@ grid_data H:sample_type H:data_representation=1 f:field_scale f:field_offset H:number_of_values=2
@ grid_data/values H:value
@ grid_data/values H:value
& grid_data 2x:padding
@ grid_data H:sample_type H:data_representation=2 H:number_of_values=2 H:padding_1
@ grid_data/values f:value
@ grid_data/values f:value
& grid_data 0x:padding
= point_object_state 43 9
E object_id, E referenced_object_id, H update_number, F force_id, B modifications, O object_type, w object_location
e object_orientation, I specific_object_appearance, H general_object_appearance, H padding_1=0
S requester_simulation_address, S receiving_simulation_address, I padding_2=0
= linear_object_state 44 9
E object_id, E referenced_object_id, H update_number, F force_id, B number_of_linear_segments=2
S requester_simulation_address, S receiving_simulation_address, O object_type
@ linear_segments B:segment_number B:segment_modification H:general_segment_appearance I:specific_segment_appearance w:segment_location e:segment_orientation f:segment_length f:segment_width f:segment_height f:segment_depth I:padding
@ linear_segments B:segment_number B:segment_modification H:general_segment_appearance I:specific_segment_appearance w:segment_location e:segment_orientation f:segment_length f:segment_width f:segment_height f:segment_depth I:padding
= areal_object_state 45 9
E object_id, E referenced_object_id, H update_number, F force_id, B modifications, O object_type
I specific_object_appearance, H general_object_appearance, H number_of_points=2, S requester_simulation_address
S receiving_simulation_address
@ points d:x d:y d:z
@ points d:x d:y d:z
= electromagnetic_emission 23 6
E emitting_entity_id, V event_id, B state_update_indicator, B number_of_systems=2, H padding=0
@ systems B:system_data_length=33 B:number_of_beams=2 H:padding=0 H:emitter_name B:emitter_function B:emitter_number v:location
@ systems/beams B:beam_data_length=15 B:beam_number H:beam_parameter_index f:frequency f:frequency_range f:effective_radiated_power f:pulse_repetition_frequency f:pulse_width f:beam_azimuth_center f:beam_azimuth_sweep f:beam_elevation_center f:beam_elevation_sweep f:beam_sweep_sync B:beam_function B:number_of_targets=1 B:high_density_track_jam B:beam_status B:jamming_technique_kind B:jamming_technique_category B:jamming_technique_subcategory B:jamming_technique_specific
@ systems/beams/track_jam_targets E:entity_id B:emitter_number B:beam_number
@ systems/beams B:beam_data_length=13 B:beam_number H:beam_parameter_index f:frequency f:frequency_range f:effective_radiated_power f:pulse_repetition_frequency f:pulse_width f:beam_azimuth_center f:beam_azimuth_sweep f:beam_elevation_center f:beam_elevation_sweep f:beam_sweep_sync B:beam_function B:number_of_targets=0 B:high_density_track_jam B:beam_status B:jamming_technique_kind B:jamming_technique_category B:jamming_technique_subcategory B:jamming_technique_specific
@ systems/beams/track_jam_targets
@ systems B:system_data_length=5 B:number_of_beams=0 H:padding=0 H:emitter_name B:emitter_function B:emitter_number v:location
@ systems/beams
= iff 28 6
E emitting_entity_id, V event_id, v relative_antenna_location, H system_type, H system_name, B system_mode
B change_options, B system_designator, B system_specific_data, B system_status, B alternate_parameter_4
B information_layers, B modifier, H parameter_1, H parameter_2, H parameter_3, H parameter_4, H parameter_5
H parameter_6
@ layers B:layer_number=2 B:layer_specific_information H:length=52 f:beam_azimuth_center f:beam_azimuth_sweep f:beam_elevation_center f:beam_elevation_sweep f:beam_sweep_sync B:operational_parameter_1 B:operational_parameter_2 H:number_of_fundamental_parameters=1
@ layers/fundamental_parameters f:effective_radiated_power f:frequency f:pulse_group_repetition_frequency f:pulse_width I:burst_length B:applicable_modes 3x:system_specific_data
@ layers B:layer_number=3 B:layer_specific_information H:length=36 S:reporting_simulation 16x:mode_5_basic_data H:padding H:number_of_data_records=1
@ layers/data_records I:record_type=4600 H:record_length=8 2x:body
@ layers B:layer_number=4 B:layer_specific_information H:length=44 S:reporting_simulation H:transponder_status B:levels_present B:aircraft_present_domain text8:aircraft_identification=HB-ABC I:aircraft_address B:aircraft_identification_type B:dap_source H:altitude B:capability_report B:padding_1 H:padding_2 H:padding_3 H:number_of_data_records=1
@ layers/data_records I:record_type=4600 H:record_length=8 2x:body
@ layers B:layer_number=4 B:layer_specific_information H:length=36 S:reporting_simulation B:interrogator_status B:padding_1=0 B:levels_present B:padding_2=0 hex:padding_3=0000000000000000000000000000000000000000 H:padding_4=0 H:number_of_data_records=0
@ layers/data_records
@ layers B:layer_number=5 B:layer_specific_information H:length=16 S:reporting_simulation H:padding_1 B:applicable_layers B:data_category H:padding_2 H:number_of_data_records=0
@ layers/data_records
= underwater_acoustic 29 6
E emitting_entity_id, V event_id, B state_change_update_indicator, B padding=0, H passive_parameter_index
B propulsion_plant_configuration, B number_of_shafts=2, B number_of_additional_passive_activities=2
B number_of_emitter_systems=1
@ shafts h:current_rpm h:ordered_rpm i:rate_of_change
@ shafts h:current_rpm h:ordered_rpm i:rate_of_change
@ additional_passive_activities H:parameter_index h:value
@ additional_passive_activities H:parameter_index h:value
@ emitter_systems B:system_data_length=11 B:number_of_beams=1 H:padding=0 H:acoustic_system_name B:acoustic_function B:acoustic_id_number v:location
@ emitter_systems/beams B:beam_data_length=6 B:beam_number H:padding=0 H:active_emission_parameter_index H:scan_pattern f:beam_center_azimuth f:azimuthal_beamwidth f:beam_center_depression_elevation f:depression_elevation_beamwidth 0x:body
= supplemental_emission_entity_state 30 6
E originating_entity_id, H infrared_signature_representation_index, H acoustic_signature_representation_index
H radar_cross_section_signature_representation_index, H number_of_propulsion_systems=2
H number_of_vectoring_nozzle_systems=2
@ propulsion_systems f:power_setting f:engine_rpm
@ propulsion_systems f:power_setting f:engine_rpm
@ vectoring_nozzle_systems f:horizontal_deflection_angle f:vertical_deflection_angle
@ vectoring_nozzle_systems f:horizontal_deflection_angle f:vertical_deflection_angle
= service_request 5 3
E requesting_entity_id, E servicing_entity_id, B service_type_requested, B number_of_supply_types=2, H padding=0
@ supplies T:supply_type f:quantity
@ supplies T:supply_type f:quantity
= resupply_offer 6 3
E receiving_entity_id, E supplying_entity_id, B number_of_supply_types=2, B padding_1=0, H padding_2=0
@ supplies T:supply_type f:quantity
@ supplies T:supply_type f:quantity
= resupply_received 7 3
E receiving_entity_id, E supplying_entity_id, B number_of_supply_types=2, B padding_1=0, H padding_2=0
@ supplies T:supply_type f:quantity
@ supplies T:supply_type f:quantity
= resupply_cancel 8 3
E receiving_entity_id, E supplying_entity_id
= repair_complete 9 3
E receiving_entity_id, E repairing_entity_id, H repair, H padding=0
= repair_response 10 3
E receiving_entity_id, E repairing_entity_id, B repair_result, B padding_1=0, H padding_2=0
= directed_energy_fire 68 2
E firing_entity_id, V event_id, T munition_type, C shot_start_time, f cumulative_shot_time
v aperture_emitter_location, f aperture_diameter, f wavelength, I padding_1=0, f pulse_repetition_frequency
f pulse_width, H flags, B pulse_shape, B padding_2=0, I padding_3=0, H padding_4=0
H number_of_directed_energy_records=2
@ directed_energy_records I:record_type=4600 H:record_length=16 10x:body
@ directed_energy_records I:record_type=252000 H:record_length=8 2x:body
= entity_damage_status 69 2
E damaged_entity_id, H padding_1=0, H padding_2=0, H number_of_damage_description_records=2
@ damage_description_records I:record_type=4600 H:record_length=16 10x:body
@ damage_description_records I:record_type=252000 H:record_length=8 2x:body
= aggregate_state 33 7
E aggregate_id, F force_id, B aggregate_state, T aggregate_type, I formation, B aggregate_marking_character_set
text31 aggregate_marking=TEST UNIT, v dimensions, e orientation, w center_of_mass, v velocity
H number_of_aggregates=2, H number_of_entities=1, H number_of_silent_aggregate_systems=1
H number_of_silent_entity_systems=2
@ aggregate_ids H:site H:application H:entity
@ aggregate_ids H:site H:application H:entity
@ entity_ids H:site H:application H:entity
2x padding_to_32_bits
@ silent_aggregate_systems H:number_of_aggregates H:padding T:aggregate_type
@ silent_entity_systems H:number_of_entities H:number_of_appearance_records=2 T:entity_type
@ silent_entity_systems/appearance_records I:entity_appearance
@ silent_entity_systems/appearance_records I:entity_appearance
@ silent_entity_systems H:number_of_entities H:number_of_appearance_records=0 T:entity_type
@ silent_entity_systems/appearance_records
I number_of_variable_datum_records=1
@ variable_datum_records I:variable_datum_id I:variable_datum_length=64 8x:variable_datum_value
= is_group_of 34 7
E group_entity_id, B grouped_entity_category=6, B number_of_grouped_entities=2, I padding=0, d latitude, d longitude
@ grouped_entity_descriptions H:entity_number h:x_offset h:y_offset h:z_offset I:entity_appearance b:psi b:theta b:phi B:fuel_status b:movement_horizontal_deviation b:movement_vertical_deviation h:movement_speed b:turret_azimuth b:gun_elevation b:turret_scan_rate b:gun_elevation_rate B:supplemental_fuel_status B:air_maintenance_status B:primary_ammunition B:secondary_ammunition
@ grouped_entity_descriptions H:entity_number h:x_offset=-7 h:y_offset h:z_offset I:entity_appearance b:psi=-100 b:theta b:phi B:fuel_status b:movement_horizontal_deviation b:movement_vertical_deviation h:movement_speed b:turret_azimuth b:gun_elevation b:turret_scan_rate b:gun_elevation_rate B:supplemental_fuel_status B:air_maintenance_status B:primary_ammunition B:secondary_ammunition
= transfer_ownership 35 7
E originating_entity_id, E receiving_entity_id, I request_id, B required_reliability_service, B transfer_type
E transfer_entity_id, I number_of_record_sets=2
@ record_sets I:record_id=25000 I:record_set_serial_number I:padding=0 H:record_length=32 H:record_count=3 16x:body
@ record_sets I:record_id=25001 I:record_set_serial_number I:padding=0 H:record_length=64 H:record_count=0 0x:body
= is_part_of 36 7
E originating_entity_id, E receiving_entity_id, H relationship_nature, H relationship_position, v part_location
H station_name, H station_number, T part_entity_type
= minefield_state 37 8
E minefield_id, H minefield_sequence, F force_id, B number_of_perimeter_points=2, T minefield_type
H number_of_mine_types=2, w minefield_location, e minefield_orientation, H appearance, H protocol_mode
@ perimeter_points f:x f:y
@ perimeter_points f:x f:y
@ mine_types B:kind B:domain H:country B:category B:subcategory B:specific B:extra
@ mine_types B:kind B:domain H:country B:category B:subcategory B:specific B:extra
= minefield_query 38 8
E minefield_id, E requesting_entity_id, B request_id, B number_of_perimeter_points=2, B padding=0
B number_of_sensor_types=2, I data_filter, T requested_mine_type
@ requested_perimeter_points f:x f:y
@ requested_perimeter_points f:x f:y
@ sensor_types H:sensor_type
@ sensor_types H:sensor_type
20x padding_to_32_bits
= minefield_data 39 8
E minefield_id, E requesting_entity_id, H minefield_sequence, B request_id, B pdu_sequence_number, B number_of_pdus
B number_of_mines=3, B number_of_sensor_types=1, B padding=0, I data_filter=2047, T mine_type
@ sensor_types H:sensor_type
2x padding_to_32_bits
@ mine_locations f:x f:y f:z
@ mine_locations f:x f:y f:z
@ mine_locations f:x f:y f:z
@ ground_burial_depth_offsets f:value
@ ground_burial_depth_offsets f:value
@ ground_burial_depth_offsets f:value
@ water_burial_depth_offsets f:value
@ water_burial_depth_offsets f:value
@ water_burial_depth_offsets f:value
@ snow_burial_depth_offsets f:value
@ snow_burial_depth_offsets f:value
@ snow_burial_depth_offsets f:value
@ mine_orientations f:psi f:theta f:phi
@ mine_orientations f:psi f:theta f:phi
@ mine_orientations f:psi f:theta f:phi
@ thermal_contrasts f:value
@ thermal_contrasts f:value
@ thermal_contrasts f:value
@ reflectances f:value
@ reflectances f:value
@ reflectances f:value
@ mine_emplacement_times i:hour I:time_past_hour
@ mine_emplacement_times i:hour I:time_past_hour
@ mine_emplacement_times i:hour I:time_past_hour
@ mine_entity_numbers H:value
@ mine_entity_numbers H:value
@ mine_entity_numbers H:value
@ fusings H:value
@ fusings H:value
@ fusings H:value
@ scalar_detection_coefficients B:value
@ scalar_detection_coefficients B:value
@ scalar_detection_coefficients B:value
@ paint_schemes B:value
@ paint_schemes B:value
@ paint_schemes B:value
2x padding_behind_mines
@ numbers_of_wires B:value=1
@ numbers_of_wires B:value=0
@ numbers_of_wires B:value=2
1x padding_behind_numbers_of_wires
@ numbers_of_vertices B:value=2
@ numbers_of_vertices B:value=0
@ numbers_of_vertices B:value=1
1x padding_behind_numbers_of_vertices
@ wire_vertices f:x f:y f:z
@ wire_vertices f:x f:y f:z
@ wire_vertices f:x f:y f:z
= minefield_response_nack 40 8
E minefield_id, E requesting_entity_id, B request_id, B number_of_missing_pdus=12, 12x missing_pdu_sequence_numbers
20x padding_to_32_bits
= tspi 46 11
id4 live_entity_id, B tspi_flags=127, relative entity_location, v16 entity_linear_velocity, e8 entity_orientation
positions position_error, orientations orientation_error, reckoning dead_reckoning_parameters, H measured_speed
B system_specific_data_length=5, 5x system_specific_data
= appearance 47 11
id4 live_entity_id, B appearance_flags_1=255, B appearance_flags_2=3, F force_id, T entity_type
T alternate_entity_type, marking entity_marking, I capabilities, I visual_appearance, I infrared_appearance
I electromagnetic_appearance, I acoustic_appearance
= articulated_parts 48 11
id4 live_entity_id, B number_of_variable_parameter_records=2
@ variable_parameters B:record_type=1 B:detached_indicator H:part_attached_to I:parameter_type T:attached_part_type
@ variable_parameters B:record_type=240 15x:body
= le_fire 49 11
id4 firing_live_entity_id, B fire_flags=127, id4 target_live_entity_id, address2 munition_simulation_address
H munition_entity_number, address2 event_simulation_address, H event_number, relative location, T munition_type
H warhead, H fuse, H quantity, H rate, v16 velocity, H range
= le_detonation 50 11
id4 firing_live_entity_id, B detonation_flags_1=255, B detonation_flags_2=3, id4 target_live_entity_id
address2 munition_simulation_address, H munition_entity_number, address2 event_simulation_address, H event_number
v16 velocity, e16 munition_orientation, T munition_type, H warhead, H fuse, H quantity, H rate, v16 entity_location
B detonation_result
= information_operations_action 70 13
E originating_simulation_id, E receiving_simulation_id, I request_id, H io_warfare_type, H io_simulation_source
H io_action_type, H io_action_phase, I padding_1=0, E io_attacker_entity_id, E io_primary_target_entity_id
H padding_2=0, H number_of_io_records=2
@ io_records I:record_type=4600 H:record_length=16 10x:body
@ io_records I:record_type=252000 H:record_length=8 2x:body
= compressed_states 149 129
S simulation_address, B form=3, B layout=1, H number_of_states=2, 61x states
= information_operations_report 71 13
E originating_simulation_id, H io_simulation_source, B io_report_type, B padding_1=0, E io_attacker_entity_id
E io_primary_target_entity_id, H padding_2=0, H padding_3=0, H number_of_io_records=2
@ io_records I:record_type=4600 H:record_length=16 10x:body
@ io_records I:record_type=252000 H:record_length=8 2x:body
"""


class LaidOut(Sample):
    """A sample whose values follow from the offset of each field, so that no two neighbours are equal."""

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
    for block in LAYOUTS.strip().split("\n= "):
        first, *lines = block.strip("= \n").split("\n")
        name, pdu_type, family = first.split()
        sample = LaidOut(name, int(pdu_type), int(family))
        for text in lines:
            for part in [text] if text[0] in "@&" else text.split(", "):
                sample.line(part)
        yield sample


for sample in (entity_state(), attribute(), *collisions(), *management(), *datums(), *experimental(), *laid_out()):
    sample.write()
