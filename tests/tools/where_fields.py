# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of PDUs in `reckon inspect --where` against tshark's display filters, on the golden samples of every PDU type
and on PDUs made for it. tshark without the plug-in is the judge: its own dissector of DIS.
  where_fields.py CASE --plugin reckon.lua --reckon PROGRAM --samples FOLDER"""
import json
import re
import struct
import subprocess
import sys

from tshark import check, run_case

# A field of tshark, and our field with the same meaning.
SAME = (
    ("dis.exer_id", "header.exercise_id"), ("dis.pdu_type", "header.pdu_type"), ("dis.proto_fam", "header.protocol_family"),
    ("dis.pdu_length", "header.length"), ("dis.force_id", "force_id"), ("dis.entity_location.x", "entity_location.x"),
    ("dis.entity_orientation.psi", "entity_orientation.psi"), ("dis.entity_linear_velocity.y", "entity_linear_velocity.y"),
    ("dis.entity_linear_acceleration.z", "entity_linear_acceleration.z"), ("dis.capabilities", "fields.capabilities"),
    ("dis.radio.frequency", "fields.frequency"), ("dis.transmit_freq_bandwidth", "transmit_frequency_bandwidth"),
    ("dis.radio.transmit_state", "transmit_state"), ("dis.antenna_location.x", "antenna_location.x"),
    ("dis.radio.mod_type.major", "modulation_type.major_modulation"), ("dis.radio.receive_state", "receiver_state"),
    ("dis.iff.system_type", "fields.system_type"), ("dis.iff.parameter_3", "parameter_3"), ("dis.warhead", "descriptor.warhead"),
    ("dis.fuse", "descriptor.fuse"), ("dis.fire.mission_index", "fire_mission_index"), ("dis.range", "fields.range"),
    ("dis.detonation.result", "detonation_result"), ("dis.electromagnetic.emitter.name", "systems.emitter_name"),
    ("dis.em.fund.frequency", "systems.beams.frequency"), ("dis.designator_wavelength", "designator_wavelength"),
    ("dis.intercom_control.control_type", "control_type"), ("dis.ua.shaft.rpm.current", "shafts.current_rpm"),
    ("dis.aggregate.formation", "fields.formation"), ("dis.aggregate.center_of_mass_x", "center_of_mass.x"),
    ("dis.environmental.sequence_number", "fields.sequence_number"), ("dis.designator_power", "designator_power"),
)


def by_tshark(capture, show):
    """Frames that a display filter selects."""
    result = subprocess.run(["tshark", "-n", "-r", str(capture), "-Y", show, "-T", "fields", "-e", "frame.number"],
                            capture_output=True, text=True, check=False)
    check(result.returncode == 0, f"tshark -Y {show}: {result.stderr}")
    return [int(line) for line in result.stdout.split()]


def number(text):
    """A value as tshark prints it."""
    if text.startswith("0x"):
        return int(text, 16)
    return int(text) if text.lstrip("-").isdigit() else float(text)


def fields(tools):
    """Each field selects the frames with that value in tshark, for each value in the samples."""
    capture = tools.capture(list(tools.samples().values()))
    command = ["tshark", "-n", "-r", str(capture), "-T", "fields", "-E", "aggregator=|"]
    command += [word for theirs, _ in SAME for word in ("-e", theirs)]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    shown = [[cell.split("|") if cell else [] for cell in line.split("\t")] for line in text.split("\n")]
    compared = 0
    for column, (theirs, ours) in enumerate(SAME):
        values = {frame: [number(value) for value in cells[column]]
                  for frame, cells in enumerate(shown, 1) if len(cells) > column and cells[column]}
        ours_too = tools.inspect(capture, "--json", "--where", f"{ours} == 0 or {ours} != 0")
        values = {frame: many for frame, many in values.items() if frame in ours_too}
        check(values, f"{theirs} and {ours} are in no sample together")
        for value in sorted({value for many in values.values() for value in many}):
            if round(value * 1024) != value * 1024:
                continue  # printed with 6 digits
            for sign, holds in (("==", lambda many: value in many), (">", lambda many: max(many) > value)):
                expected = [frame for frame, many in values.items() if holds(many)]
                found = [frame for frame in sorted(tools.inspect(capture, "--json", "--where",
                                                                 f"{ours} {sign} {value}")) if frame in values]
                check(found == expected,
                      f"{ours} {sign} {value}: frames {found}, tshark has {theirs} in {expected}")
                compared += 1
    print(f"  {len(SAME)} fields, {compared} comparisons")


def iff_pdu(sample, parameters, status):
    """An IFF PDU of a Mark X transponder without layers."""
    octets = bytearray(sample[:60])
    struct.pack_into(">H", octets, 8, 60)
    struct.pack_into(">HHBBBB", octets, 36, 1, 1, 1, 0, 0, 0)
    struct.pack_into(">BBBB6H", octets, 44, status, 0, 2, 0, *parameters)
    return bytes(octets)


def readings(tools):
    """Timestamps and codes of IFF modes have the same values as in tshark."""
    samples = tools.samples()
    parameters = (0x2000 | 0o35, 0o7321, 0x2000 | 0o1274, 0x4123, 0x2000 | 90, 0)
    state = bytearray(samples["entity_state"])
    stamped = []
    for timestamp in (0, 1, 305419897, 2**32 - 4, 2**31):
        struct.pack_into(">I", state, 4, timestamp)
        stamped.append(bytes(state))
    capture = tools.capture([iff_pdu(samples["iff"], parameters, 1), *stamped])
    told = [rows[0]["fields"] for rows in tools.inspect(capture, "--full").values()]
    elements = [f"dis.iff.mode_code.element_{number}" for number in (1, 2, 3, 4)]
    shown = tools.fields(capture, "dis.iff.mode_c.altitude", "dis.iff.mode_4", *elements)
    tree = subprocess.run(["tshark", "-n", "-V", "-r", str(capture)], capture_output=True, text=True, check=True).stdout
    stamps = re.findall(r"^ *Timestamp: (.*)$", tree, re.M)
    reads = [one["header"]["timestamp_read"] for one in told]
    ours = [f"{read['past_the_hour']} ({read['clock']})" for read in reads]
    check(ours == stamps, f"{ours}, tshark has {stamps}")
    # Parameters 1, 2 and 3 have elements 1 and 2; parameters 2 and 3 have 3 and 4 as well.
    first, second, third, fourth = ([int(digit, 8) for digit in shown[0][name]] for name in elements)
    codes = [f"{first[0]}{second[0]}"] + [f"{first[n]}{second[n]}{third[n - 1]}{fourth[n - 1]}" for n in (1, 2)]
    modes = [told[0]["parameter_1_read"]["mode_1"], told[0]["parameter_2_read"]["mode_2"],
             told[0]["parameter_3_read"]["mode_3a"]]
    check(codes == modes, f"{modes}, tshark has {codes}")
    altitude = told[0]["parameter_5_read"]["altitude_ft"]
    check(shown[0]["dis.iff.mode_c.altitude"] == [str(altitude // 100)], f"{altitude}: {shown[0]}")
    check(shown[0]["dis.iff.mode_4"] == [told[0]["parameter_4_read"]["mode_4"]], str(shown[0]))
    print(f"  modes {modes}, {altitude} ft, {len(stamped)} timestamps")


def descriptors(tools):
    """A fire's descriptor has the kind that tshark reads from the PDU's status."""
    fire = bytearray(tools.samples()["fire"])
    datagrams = []
    for status in (0, 0x10):
        fire[10] = status
        datagrams.append(bytes(fire))
    capture = tools.capture(datagrams)
    expendable = by_tshark(capture, "dis.pdustatus.fti == 1")
    found = sorted(tools.inspect(capture, "--json", "--where", "expendable_type.kind >= 0"))
    check(found == expendable == [2], f"{found}, tshark has {expendable}")
    rows = tools.inspect(capture, "--full")
    check("warhead" in rows[1][0]["fields"]["descriptor"], json.dumps(rows[1]))
    check("warhead" not in rows[2][0]["fields"]["descriptor"], json.dumps(rows[2]))


CASES = {case.__name__: case for case in (fields, readings, descriptors)}


if __name__ == "__main__":
    sys.exit(run_case(__doc__, CASES))
