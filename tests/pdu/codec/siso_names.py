#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds pdu/codec/siso_names.txt against other people's lists of the same enumerations.

  siso_names.py CASE --list pdu/codec/siso_names.txt --data REFERENCE_DATA

CASE: reference (28 tables of SISO-REF-010 v35, and the whole of 2006 for categories and bits),
tshark (its value strings and bit masks). Names are equal where their letters and digits are, or
where one abbreviates the other. Where we say something else on purpose it stands in a list below.
Exit status 77: the other list is not on this machine.
"""

import argparse
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

SECTION = re.compile(r"\[(\w+)\](?: \d+)?( bits)?( all)?$")


def read_names(path):
    """Tables {name: {value: text}}, and sets {name: {first bit: (width, field)}}."""
    tables, sets, current = {}, {}, None
    for line in pathlib.Path(path).read_text(encoding="ascii").splitlines():
        match = SECTION.match(line)
        if match:
            current = (sets if match[2] else tables).setdefault(match[1], {})
            in_set = bool(match[2])
        elif line and not line.startswith("#"):
            number, rest = line.split(" ", 1)
            if in_set:
                width, field, _ = rest.split(" ")
                current[int(number)] = (int(width), field)
            else:
                current[int(number)] = rest
    return tables, sets


def plain(text):
    return re.sub(r"[^a-z0-9]", "", text.lower())


def alike(ours, theirs):
    """Equal but for punctuation, or one is the other with its explanation in parentheses."""
    def forms(text):
        bare = re.sub(r"\([^)]*\)", "", text)
        inside = re.findall(r"\(([^)]*)\)", text)
        return {plain(text), plain(bare), *(plain(part) for part in inside)} - {""}
    return bool(forms(ours) & forms(theirs))


class Comparison:
    """Counts and tells what differs."""

    def __init__(self):
        self.compared, self.failures, self.unused = 0, [], set()

    def table(self, name, ours, theirs, on_purpose):
        """Every value of theirs is in ours under a name alike, but for those on purpose."""
        for value, text in sorted(theirs.items()):
            self.compared += 1
            known = ours.get(value, "")
            if (name, value) in on_purpose:
                if alike(known, text):
                    self.failures.append(f"{name} {value}: no longer different: {known}")
            elif not alike(known, text):
                self.failures.append(f"{name} {value}: we say '{known}', they '{text}'")

    def no_others(self, name, ours, theirs, allowed):
        """We have no value that they have not."""
        for value in sorted(set(ours) - set(theirs)):
            if (name, value) not in allowed:
                self.failures.append(f"{name} {value}: only we have '{ours[value]}'")

    def bits(self, name, ours, first, width, on_purpose):
        self.compared += 1
        if (name, first) in on_purpose:
            return
        if first not in ours or ours[first][0] != width:
            self.failures.append(f"{name}: no field of {width} bits at bit {first}")

    def finish(self, what):
        for failure in self.failures:
            print(failure)
        print(f"{what}: {self.compared} names and fields compared, {len(self.failures)} differ")
        return 1 if self.failures or self.compared == 0 else 0


# Tables of the reference, and ours.
REFERENCE_TABLES = {
    "AcknowledgeAcknowledgeFlag": "acknowledge_flag", "AcknowledgeResponseFlag": "response_flag",
    "ActionRequestActionID": "action_id", "ArticulatedPartsTypeClass": "articulated_part_class",
    "ArticulatedPartsTypeMetric": "articulated_part_metric", "CollisionType": "collision_type",
    "Country": "country", "DISAttributeActionCode": "attribute_action",
    "DISPDUStatusCoupledExtensionIndicatorCEI": "coupled_extension",
    "DISPDUStatusDetonationTypeIndicatorDTI": "detonation_type",
    "DISPDUStatusFireTypeIndicatorFTI": "fire_type",
    "DISPDUStatusLVCIndicatorLVC": "live_virtual_constructive",
    "DISPDUStatusTransferredEntityIndicatorTEI": "transferred_entity",
    "DISProtocolFamily": "protocol_family", "DISProtocolVersion": "protocol_version",
    "DeadReckoningAlgorithm": "dead_reckoning_algorithm", "DetonationResult": "detonation_result",
    "DisPduType": "pdu_type", "EntityKind": "entity_kind",
    "EntityMarkingCharacterSet": "marking_character_set", "EventReportEventType": "event_type",
    "ForceID": "force_id", "MunitionDescriptorFuse": "fuse", "MunitionDescriptorWarhead": "warhead",
    "PlatformDomain": "platform_domain", "StopFreezeReason": "stop_freeze_reason",
    "VariableParameterRecordType": "variable_parameter_type", "VariableRecordType": "datum_id",
}
REFERENCE_ON_PURPOSE = {
    # said shorter
    *(("action_id", value) for value in (*range(1001, 1008), 1009)),
    *(("dead_reckoning_algorithm", value) for value in range(1, 10)),
    *(("protocol_version", value) for value in (1, 3, 4)),
    ("articulated_part_class", 39), ("collision_type", 55), ("country", 224), ("country", 225),
}
OURS = {("protocol_family", 129)}
SHORTENED_DATUMS = re.compile(
    r"DDCP|TADIL J|Tactical Lighting|Radio (Channel )?Initialization")  # left out for their size


def country_codes(comparison, ours, theirs):
    """The code of three letters stands last in the reference's name of a country."""
    codes = {value: re.search(r"\(([A-Z]{3})\)$", text) for value, text in theirs.items()}
    codes = {value: match[1] for value, match in codes.items() if match}
    comparison.table("country_code", ours, codes, set())
    comparison.no_others("country_code", ours, codes, set())


# Lists of 2006 that still hold.
OLDER_TABLES = {
    "es.type.kind": "entity_kind", "es.type.kind.1.domain": "platform_domain",
    "es.type.kind.1.domain.1.cat": "land_category", "es.type.kind.1.domain.2.cat": "air_category",
    "es.type.kind.1.domain.3.cat": "surface_category",
    "es.type.kind.1.domain.4.cat": "subsurface_category",
    "es.type.kind.1.domain.5.cat": "space_category", "es.type.kind.2.domain": "munition_domain",
    "es.type.kind.2.cat": "munition_category", "es.type.kind.7.cat": "radio_category",
    "es.type.kind.8.domain.2.cat": "air_expendable_category",
    "es.type.kind.8.domain.3.cat": "surface_expendable_category",
    "es.type.kind.8.domain.4.cat": "subsurface_expendable_category",
    "es.type.kind.9.cat": "sensor_category", "es.type.country": "country",
    "warfare.burstdescriptor.warhead": "warhead", "warfare.burstdescriptor.fuse": "fuse",
    "warfare.detonationresult": "detonation_result", "log.servicerequest": "service_type",
    "log.repairresponse": "repair_result", "simman.actionresponse.status": "request_status",
    "simman.actionrequest.actionid": "action_id", "simman.eventreport.eventtype": "event_type",
    "simman.reliability.service": "reliability_service",
    "der.emission.function": "emitter_function", "der.emission.beamfunction": "beam_function",
    "der.emission.stateupdate": "state_update_indicator",
    "der.emission.hdtj": "high_density_track", "der.designator.code": "designator_code",
    "der.iff.type": "iff_system_type", "der.iff.name": "iff_system_name",
    "der.iff.mode": "iff_system_mode", "der.ua.systemname": "acoustic_name",
    "der.ua.function": "acoustic_function", "der.ua.scanpattern": "scan_pattern",
    "radio.tx.mod.major": "modulation", "radio.tx.mod.system": "radio_system",
    "radio.tx.mod.major.1.detail": "amplitude_detail",
    "radio.tx.mod.major.3.detail": "angle_detail", "radio.tx.mod.major.5.detail": "pulse_detail",
    "radio.tx.state": "transmit_state", "radio.tx.inputsource": "input_source",
    "radio.tx.cryptosystem": "crypto_system",
    "radio.tx.antennapatterntype": "antenna_pattern_type", "radio.tx.tdltype": "tdl_type",
    "radio.rx.state": "receiver_state", "radio.ic.controltype": "control_type",
    "radio.ic.commtype": "communications_type", "radio.ic.command": "intercom_command",
    "radio.ic.transmitstate": "transmit_line_state", "entity.mine.sensortype": "mine_sensor",
    "eman.aggregate.state": "aggregate_state", "eman.aggregate.formation": "formation",
    "eman.aggregate.type.kind": "aggregate_kind",
    "eman.aggregate.type.subcategory": "aggregate_subcategory",
    "eman.ispartof.nature": "relationship_nature",
    "eman.ispartof.position": "relationship_position",
    "eman.ispartof.stationname": "station_name",
    "eman.isgroupof.category": "grouped_entity_category", "eman.tc.transfertype": "transfer_type",
    "env.obj.objecttype.kind": "object_kind", "env.gridded.constantgrid": "constant_grid",
}
OLDER_BITS = {
    "es.appear.platform.land": "land_appearance", "es.appear.platform.air": "air_appearance",
    "es.appear.platform.surface": "surface_appearance",
    "es.appear.platform.subsurface": "subsurface_appearance",
    "es.appear.platform.space": "space_appearance", "es.appear.munition": "munition_appearance",
    "es.appear.lifeform": "life_form_appearance",
    "es.appear.environmental": "environmental_appearance",
    "es.appear.cultural": "cultural_appearance",
    "es.appear.sensoremitter": "sensor_appearance", "es.capabilities": "air_capabilities",
    "simman.stop.frozenbehavior": "frozen_behavior", "der.iff.fop.status": "iff_system_status",
    "radio.tx.mod.spreadspectrum": "spread_spectrum",
    "entity.mine.appear": "minefield_appearance", "entity.mine.datafilter": "mine_data_filter",
    "env.obj.appear.general": "object_appearance", "env.obj.mod.point": "object_modification",
    "env.process.environmentstatus": "environment_status",
}
# Named otherwise since 2006, or shorter by us; the smoke of old takes one bit for each source now.
OLDER_ON_PURPOSE = {(table, value) for table, values in {
    "land_category": [29], "space_category": [1], "radio_category": [*range(4, 15), 17, 18, 19],
    "country": [23, 31, 32, 34, 40, 50, 74, 85, 107, 122, 130, 136, 143, 174, 182, 183, 184, 185,
                186, 204, 207, 208, 209, 222, 236, 247, 256],
    "emitter_function": [3, 6, 9, 14, 42], "state_update_indicator": [0],
    "beam_function": [2, 8, 10, 12, 14], "iff_system_type": [0, 1, 2],
    "iff_system_name": range(8), "iff_system_mode": [0], "acoustic_function": [4],
    "modulation": [0], "radio_system": [1, 2, 3, 4], "crypto_system": [0, 2],
    "antenna_pattern_type": [0], "control_type": [4, 5], "transmit_line_state": [0],
    "station_name": [15], "transfer_type": range(1, 7), "action_id": [*range(1001, 1008), 1009],
}.items() for value in values}
OLDER_SPLIT_BITS = {(f"{kind}_appearance", 5) for kind in (
    "land", "air", "surface", "subsurface", "space", "munition", "cultural", "sensor")}


def older(comparison, names, path):
    tables, sets = names
    root = ElementTree.parse(path).getroot()
    for enum in root.iter("enum"):
        ours = OLDER_TABLES.get(enum.get("cname"))
        if ours is not None:
            theirs = {int(row.get("id")): row.get("description") for row in enum.findall("enumrow")
                      if row.get("description") and row.get("id2") is None}
            comparison.table(ours, tables[ours], theirs, OLDER_ON_PURPOSE)
    for mask in root.iter("bitmask"):
        ours = OLDER_BITS.get(mask.get("cname"))
        for row in mask.findall("bitmaskrow") if ours is not None else []:
            if row.get("name") and not row.get("unused"):
                first = int(row.get("id"))
                width = int(row.get("id2") or first) - first + 1
                comparison.bits(ours, sets[ours], first, width, OLDER_SPLIT_BITS)


def reference(names, data):
    path = data / "dis-schema/siso/siso-ref-010-selected.json"
    if not path.exists():
        print(f"needs {path}")
        return 77
    tables, _ = names
    comparison = Comparison()
    for name, table in json.loads(path.read_text())["enumerations"].items():
        theirs = {int(value): html.unescape(text) for value, text in table["values"].items()}
        ours = REFERENCE_TABLES[name]
        if ours == "articulated_part_class":
            theirs = {value // 32: text for value, text in theirs.items()}
        if ours == "datum_id":
            theirs = {value: text for value, text in theirs.items()
                      if value < 100000 and not SHORTENED_DATUMS.match(text)}
        comparison.table(ours, tables[ours], theirs, REFERENCE_ON_PURPOSE)
        comparison.no_others(ours, tables[ours], theirs, OURS)
        if ours == "country":
            country_codes(comparison, tables["country_code"], theirs)
    older(comparison, names, data / "dis-schema/siso/siso-std-010.xml")
    return comparison.finish("SISO-REF-010")


TSHARK_TABLES = {
    "dis.country": "country", "dis.pdu_type": "pdu_type", "dis.proto_fam": "protocol_family",
    "dis.entityKind": "entity_kind", "dis.entityDomain": "platform_domain",
    "dis.category.land": "land_category", "dis.category.air": "air_category",
    "dis.category.surface": "surface_category", "dis.category.subsurface": "subsurface_category",
    "dis.category.space": "space_category", "dis.radio.radio_category": "radio_category",
    "dis.radio.tdl_type": "tdl_type", "dis.electromagnetic.emission.function": "emitter_function",
    "dis.electromagnetic.emission.beam.function": "beam_function",
    "dis.detonation.result": "detonation_result", "dis.action_id": "action_id",
    "dis.request_status": "request_status", "dis.reason": "stop_freeze_reason",
    "dis.acknowledge_flag": "acknowledge_flag", "dis.response_flag": "response_flag",
    "dis.reliability": "reliability_service", "dis.collision.type": "collision_type",
    "dis.iff.system_name": "iff_system_name", "dis.iff.system_type": "iff_system_type",
    "dis.iff.system_mode": "iff_system_mode", "dis.radio.input_source": "input_source",
    "dis.radio.mod_type.system": "radio_system", "dis.radio.mod_type.major": "modulation",
    "dis.radio.crypto_system": "crypto_system", "dis.radio.encoding_type.audio": "encoding_type",
    "dis.radio.encoding_class": "encoding_class", "dis.radio.transmit_state": "transmit_state",
    "dis.radio.receive_state": "receiver_state",
    "dis.radio.antenna_pattern_type": "antenna_pattern_type",
    "dis.entity_marking_character_set": "marking_character_set",
    "dis.aggregate.state": "aggregate_state", "dis.aggregate.kind": "aggregate_kind",
    "dis.aggregate.subcategory": "aggregate_subcategory",
    "dis.aggregate.specific": "aggregate_specific", "dis.aggregate.formation": "formation",
    "dis.intercom_control.control_type": "control_type",
    "dis.intercom_control.communications_channel_type": "communications_type",
    "dis.designator_code_name": "designator_name", "dis.designator_designator_code": "designator_code",
    "dis.appearance.lifeform.compliance": "compliance",
    "dis.appearance.lifeform.Lifeform_state": "posture", "dis.appearance.lifeform.health": "health",
    "dis.appearance.lifeform.Weapon_1": "weapon",
    "dis.appearance.lifeform.camouflage_type": "camouflage",
    "dis.appearance.lifeform.concealed_movement": "concealed_movement",
    "dis.appearance.landform.hatch": "hatch", "dis.appearance.landform.damage": "damage",
    "dis.appearance.landform.trailing_effects_entity": "effect_size",
    "dis.pdustatus.tei": "transferred_entity", "dis.pdustatus.lvc": "live_virtual_constructive",
    "dis.pdustatus.cei": "coupled_extension", "dis.pdustatus.fti": "fire_type",
    "dis.pdustatus.dti": "detonation_type", "dis.pdustatus.rai": "radio_attached",
    "dis.pdustatus.ism": "iff_simulation_mode", "dis.pdustatus.aii": "active_interrogation",
}
# Older, longer or wrong there (its subsurface category 14, marking sets from 4, TEI, DTI 2), experimental
# PDUs of others, and values that it calls unused.
TSHARK_ON_PURPOSE = {(table, value) for table, values in {
    "pdu_type": [70, 71, 129, 130, 131, 132, 133, 134, 135, 200, 201], "protocol_family": [11,
    129, 130, 140, 150], "transferred_entity": [0, 1], "detonation_type": [2, 3],
    "radio_attached": [3], "land_category": [29], "surface_category": [83], "subsurface_category":
    [14], "space_category": [1], "acknowledge_flag": [5], "action_id": [12, 4301, 4302, 4305],
    "country": [31, 32, 40, 50, 74, 85, 122, 130, 136, 143, 174, 182, 183, 184, 185, 186, 204,
    207, 208, 209, 236, 247, 256], "emitter_function": [3, 6, 9, 42], "beam_function": [2, 8, 10,
    12, 14], "encoding_type": [7, 255], "tdl_type": [112], "radio_category": [4, 5, 6, 7, 8, 9,
    10, 11, 12, 13, 14, 17, 18, 19, 29, 36], "antenna_pattern_type": [0], "modulation": [0],
    "radio_system": range(1, 5), "hatch": range(1, 8), "control_type": [4, 5],
    "aggregate_specific": [1], "compliance": [0], "posture": [0], "weapon": range(0, 4),
    "camouflage": [3], "marking_character_set": [2, 4, 5, 6, 7, 8, 9], "designator_name": [0, 1],
    "designator_code": [1], "iff_system_type": [12, 13], "iff_system_name": [13, 14],
}.items() for value in values}


def tshark_lines(what):
    done = subprocess.run(["tshark", "-G", what], capture_output=True, text=True, check=True)
    return [line.split("\t") for line in done.stdout.splitlines()]


def tshark(names):
    if shutil.which("tshark") is None:
        print("needs tshark")
        return 77
    tables, sets = names
    comparison, theirs = Comparison(), {}
    for line in tshark_lines("values"):
        if line[0] == "V" and line[1] in TSHARK_TABLES:
            theirs.setdefault(line[1], {})[int(line[2], 0)] = line[3]
    for field, values in theirs.items():
        ours = TSHARK_TABLES[field]
        comparison.table(ours, tables[ours], values, TSHARK_ON_PURPOSE)
    for line in tshark_lines("fields"):
        match = re.match(r"dis\.appearance\.(landform|lifeform)\.", line[2])
        if line[0] == "F" and match and len(line) > 6:
            mask = int(line[6], 0)
            if mask == 0:
                continue
            first = (mask & -mask).bit_length() - 1
            ours = {"landform": "land_appearance", "lifeform": "life_form_appearance"}[match[1]]
            comparison.bits(ours, sets[ours], first, mask.bit_count(), OLDER_SPLIT_BITS)
    return comparison.finish("tshark")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", choices=["reference", "tshark"])
    parser.add_argument("--list", required=True)
    parser.add_argument("--data", type=pathlib.Path, required=True)
    options = parser.parse_args()
    names = read_names(options.list)
    return reference(names, options.data) if options.case == "reference" else tshark(names)


if __name__ == "__main__":
    sys.exit(main())
