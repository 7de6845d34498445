# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The parts of DIS (IEEE 1278.1-2012) and pcap that the integration tests need, written with struct alone so that no
code is shared with the tested programs."""
import math
import socket
import struct

ENTITY_STATE = 1
FIRE = 2
COLLISION_ELASTIC = 66
ATTRIBUTE = 72
FIRST_EXPERIMENTAL = 129
TRAILER = 141
UNICAST_FRAME = 148
SEALED = 0xE7  # first octet of an envelope
ENERGY_ACCOUNT = 0x48415003  # record type
HEADER = struct.Struct(">BBBBIHBB")  # version, exercise, type, family, time, length, status, padding
WGS84_A = 6378137.0
WGS84_E2 = 6.69437999014e-3


def udp_of_frame(frame):
    """(sender, group, payload) of an Ethernet frame with IPv4 and UDP; None for other frames."""
    if len(frame) < 42 or frame[12:14] != b"\x08\x00" or frame[23] != 17:
        return None
    at = 14 + 4 * (frame[14] & 15)
    length = struct.unpack_from(">H", frame, at + 4)[0]
    sender, group = (".".join(map(str, frame[i:i + 4])) for i in (26, 30))
    return sender, group, frame[at + 8:at + length]


def udp_port_of_frame(frame):
    """Destination port of a frame of udp_of_frame()."""
    return struct.unpack_from(">H", frame, 14 + 4 * (frame[14] & 15) + 2)[0]


def igmp_reports_of_frame(frame):
    """Groups that an Ethernet frame with IPv4 and IGMP (2 or 3) requests from a switch."""
    if len(frame) < 34 or frame[12:14] != b"\x08\x00" or frame[23] != 2:
        return []
    igmp = frame[14 + 4 * (frame[14] & 15):]
    if igmp[0] == 0x16:
        return [socket.inet_ntoa(igmp[4:8])]
    groups, at = [], 8
    while igmp[0] == 0x22 and at + 8 <= len(igmp):
        kind, more, sources = struct.unpack_from(">BBH", igmp, at)
        if kind in (2, 4):  # from all sources, or newly so
            groups.append(socket.inet_ntoa(igmp[at + 4:at + 8]))
        at += 8 + 4 * (more + sources)
    return groups


def pdus(payload):
    """(type, octets) of each PDU of a datagram, by the length fields; ValueError for a damaged tail."""
    at = 0
    while at < len(payload):
        rest = payload[at:]
        if at % 8 and not any(rest[:8 - at % 8]):
            at += 8 - at % 8
            continue
        if len(rest) < HEADER.size:
            raise ValueError(f"{len(rest)} octets behind the last PDU")
        length = HEADER.unpack_from(rest)[5]
        if not HEADER.size <= length <= len(rest):
            raise ValueError(f"length field {length} with {len(rest)} octets left")
        yield rest[2], rest[:length]
        at += length


def trailer(payload):
    """(sequence, epoch) of a datagram between Reckon peers; None if it has no trailer."""
    last = payload[-24:]
    if len(last) < 24 or last[2] != TRAILER or struct.unpack_from(">H", last, 8)[0] != 24:
        return None
    return struct.unpack_from(">II", last, 12)


class EntityState:
    """The fixed part of an Entity State PDU."""

    def __init__(self, octets):
        if len(octets) < 144:
            raise ValueError(f"an Entity State of {len(octets)} octets")
        (self.version, self.exercise, self.type, self.family, self.timestamp, self.length,
         self.status, _) = HEADER.unpack_from(octets)
        self.id = struct.unpack_from(">HHH", octets, 12)
        self.variable_records = octets[19]
        self.velocity = struct.unpack_from(">fff", octets, 36)
        self.location = struct.unpack_from(">ddd", octets, 48)
        self.orientation = struct.unpack_from(">fff", octets, 72)
        self.appearance = struct.unpack_from(">I", octets, 84)[0]
        self.algorithm = octets[88]
        self.marking = octets[129:140].rstrip(b"\0").decode("ascii")

    def problems(self):
        """Faults that a plain DIS receiver would report."""
        if self.version not in (6, 7) or self.family != 1 or self.type != ENTITY_STATE:
            yield f"header {self.version} {self.type} {self.family}"
        if self.length != 144 + 16 * self.variable_records:
            yield f"length {self.length} with {self.variable_records} records"
        if not all(map(math.isfinite, self.velocity + self.location + self.orientation)):
            yield "not finite"
        if not 6.2e6 < math.hypot(*self.location) < 6.6e6:
            yield f"location {self.location} is not near the surface of the Earth"
        if not 1 <= self.algorithm <= 9:
            yield f"dead reckoning algorithm {self.algorithm}"
        if 0 in self.id or 0xFFFF in self.id:
            yield f"entity ID {self.id}"


def fire(firing, target, location):
    """A Fire PDU of exercise 1."""
    body = struct.pack(">HHHHHHHHHHHHIdddBBHBBBBHHHHffff", *firing, *target, 0, 0, 0, *firing[:2], 1, 0,
                       *location, 2, 2, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0.0, 0.0, 0.0, 0.0)
    return HEADER.pack(7, 1, 2, 2, 0, HEADER.size + len(body), 0, 0) + body


def struck(octets):
    """The struck entity in a Collision-Elastic PDU."""
    return struct.unpack_from(">HHH", octets, 18)


def energy_accounts(octets):
    """(entity, counterpart, given so far [J], needed now [J]) of each account in an Attribute PDU."""
    at = 32
    for _ in range(struct.unpack_from(">H", octets, 30)[0]):
        *entity, count = struct.unpack_from(">HHHH", octets, at)
        at += 8
        for _ in range(count):
            kind, length = struct.unpack_from(">IH", octets, at)
            if kind == ENERGY_ACCOUNT:
                *other, given, need, _ = struct.unpack_from(">HHHdHH", octets, at + 6)
                yield tuple(entity), tuple(other), given, 1e-6 * need
            at += length


def read_pcap(path):
    """(seconds, UDP payload) of each frame of a little-endian pcap file."""
    with open(path, "rb") as file:
        octets = file.read()
    if struct.unpack_from("<I", octets)[0] != 0xA1B2C3D4:
        raise ValueError(f"{path} is no plain pcap file")
    at = 24
    while at + 16 <= len(octets):
        seconds, micros, captured, _ = struct.unpack_from("<IIII", octets, at)
        datagram = udp_of_frame(octets[at + 16:at + 16 + captured])
        at += 16 + captured
        if datagram:
            yield seconds + 1e-6 * micros, datagram[2]


def geodetic(location):
    """Latitude and longitude [deg] and height [m] of a geocentric point."""
    x, y, z = location
    radius = math.hypot(x, y)
    latitude = math.atan2(z, radius * (1 - WGS84_E2))
    for _ in range(10):
        n = WGS84_A / math.sqrt(1 - WGS84_E2 * math.sin(latitude) ** 2)
        height = radius / math.cos(latitude) - n
        latitude = math.atan2(z, radius * (1 - WGS84_E2 * n / (n + height)))
    return math.degrees(latitude), math.degrees(math.atan2(y, x)), height
