# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the seeds of the fuzz targets from the project's own samples, and from the captures of RECKON_DATA if there
are any: seeds.py FOLDER writes FOLDER/seeds/TARGET/* and the dictionaries FOLDER/TARGET.dict.
"""
import bz2
import gzip
import hashlib
import lzma
import os
import pathlib
import re
import struct
import sys
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
MOST_DATAGRAMS = 400  # from each capture, one for each type and length


# A copy below a moving node, and a choice.
NODES = b"""[[node]]
name = "a"
scale = 2
turn_rate = 1
swing = [0, 0, 1]
swing_rate = 1
[[node]]
name = "b"
parent = "a"
use = "c"
[[node]]
name = "c"
kind = "switch"
shows = "d"
[[node]]
name = "d"
parent = "c"
[[node]]
name = "e"
kind = "level_of_detail"
[[node]]
name = "f"
parent = "e"
use = "d"
farthest = 2
[[object]]
name = "x"
sphere = 1
node = "d"
"""


def samples():
    """Name and octets of each golden sample."""
    for path in sorted((ROOT / "tests/support/wire_samples").glob("*.hex")):
        digits = "".join(line.split("#")[0] for line in path.read_text().splitlines())
        yield path.stem, bytes.fromhex("".join(digits.split()))


def transfer(kind, content):
    """A Transfer Ownership with the record set of a hand-over."""
    head = struct.pack(">BBBBIHH", 7, 1, 35, 7, 0, 56 + len(content), 0)
    names = struct.pack(">6HIBB3HI", 1, 1, 0, 1, 2, 0, 1, 0, kind, 65534, 1, 1, 1)
    return head + names + struct.pack(">IIIHH", 0x48415005, 0, 0, 64, len(content) // 8) + content


def frame_of(payload):
    """The payload in UDP, IPv4 and Ethernet."""
    udp = struct.pack(">4H", 3000, 3000, 8 + len(payload), 0) + payload
    ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 0, 0, 1, 17, 0,
                     bytes([10, 0, 0, 1]), bytes([239, 192, 1, 0]))
    return bytes(12) + b"\x08\x00" + ip + udp


def fragments_of(payload, number, v6=False, piece=64):
    """The payload in UDP and several fragments of IPv4 or IPv6, in Ethernet."""
    udp = struct.pack(">4H", 3000, 3000, 8 + len(payload), 0) + payload
    for at in range(0, len(udp), piece):
        octets, more = udp[at:at + piece], at + piece < len(udp)
        if v6:
            head = struct.pack(">IHBB32sBBHI", 0x60000000, 8 + len(octets), 44, 1, bytes(range(32)),
                               17, 0, at | more, number)
            yield bytes(12) + b"\x86\xdd" + head + octets
        else:
            head = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(octets), number,
                               at // 8 | (0x2000 if more else 0), 1, 17, 0,
                               bytes([10, 0, 0, 1]), bytes([239, 192, 1, 0]))
            yield bytes(12) + b"\x08\x00" + head + octets


def mixed_pcapng(payloads):
    """Fragments, on interfaces with several link types."""
    out = block(0x0A0D0D0A, struct.pack("<IHHq", 0x1A2B3C4D, 1, 0, -1))
    for link_type, length in ((1, 65535), (101, 262144), (113, 96)):
        out += block(1, struct.pack("<HHI", link_type, 0, length))
    for number, payload in enumerate(payloads):
        for frame in fragments_of(payload, number, number % 2 == 1):
            out += block(6, struct.pack("<5I", 0, 0, number, len(frame), len(frame)) + frame)
        frame = frame_of(payload)[14:]
        out += block(6, struct.pack("<5I", 1, 0, number, len(frame), len(frame)) + frame)
        frame = bytes(14) + struct.pack(">3H", 0x8100, 7, 0x0800) + frame
        out += block(6, struct.pack("<5I", 2, 0, number, len(frame), len(frame)) + frame)
    return out


def tunnelled(frame):
    """A frame in VXLAN, ERSPAN, an IP packet, MPLS and PPPoE."""
    ip = frame[14:]
    for protocol, inner in ((17, struct.pack(">4HII", 1, 4789, 16 + len(frame), 0, 1 << 27, 7 << 8) + frame),
                            (47, bytes.fromhex("100088be00000007 1001000000000000") + frame), (4, ip)):
        head = struct.pack(">BBHHHBBH8x", 0x45, 0, 20 + len(inner), 0, 0, 9, protocol, 0)
        yield bytes(12) + b"\x08\x00" + head + inner
    yield bytes(12) + bytes.fromhex("8847 00010040 00011140") + ip
    yield bytes(12) + bytes.fromhex("8864 11000001") + struct.pack(">HH", 2 + len(ip), 0x21) + ip


def pcap(payloads, frames=()):
    head = struct.pack("<IHHiIII", 0xA1B23C4D, 2, 4, 0, 0, 65535, 1)
    frames = [*frames, *map(frame_of, payloads)]
    return head + b"".join(struct.pack("<4I", 1, 2, len(f), len(f)) + f for f in frames)


def block(kind, body):
    body += bytes(-len(body) % 4)
    length = struct.pack("<I", 12 + len(body))
    return struct.pack("<I", kind) + length + body + length


def pcapng(payloads, resolution):
    """@param resolution times have units of 10^-resolution seconds"""
    section = block(0x0A0D0D0A, struct.pack("<IHHq", 0x1A2B3C4D, 1, 0, -1))
    interface = block(1, struct.pack("<HHIHHBxxxI", 1, 0, 65535, 9, 1, resolution, 0))
    frames = (frame_of(p) for p in payloads)
    return section + interface + b"".join(
        block(6, struct.pack("<5I", 0, 0, 1, len(f), len(f)) + f) for f in frames)


def payloads_of(capture):
    """UDP payloads of a classic capture of Ethernet and IPv4; empty for other captures."""
    octets = capture.read_bytes()
    order = {b"\xd4\xc3\xb2\xa1": "<", b"\x4d\x3c\xb2\xa1": "<", b"\xa1\xb2\xc3\xd4": ">"}.get(octets[:4])
    at = 24
    while order and at + 16 <= len(octets):
        held = struct.unpack_from(order + "I", octets, at + 8)[0]
        frame = octets[at + 16:at + 16 + held]
        at += 16 + held
        if frame[12:14] == b"\x08\x00" and frame[23:24] == b"\x11":
            yield frame[14 + 4 * (frame[14] & 15) + 8:]


def captured():
    """Captures of RECKON_DATA, and their datagrams, one for each type and length."""
    folder = pathlib.Path(os.environ.get("RECKON_DATA", ROOT.parent / "shared/data"))
    files = sorted((folder / "dis-captures").rglob("*.pcap"))
    datagrams = {}
    for path in files:
        of_file = {(p[2:3], len(p)): p for p in payloads_of(path)}
        for key in sorted(of_file)[:MOST_DATAGRAMS]:
            datagrams.setdefault(key, of_file[key])
    return [f for f in files if f.stat().st_size < 20000], list(datagrams.values())


def announcement(own, application, epoch):
    """The sample of a Presence as another peer sends it, with its trailer, from its first datagram."""
    presence, trailer = bytearray(own["presence"]), bytearray(own["datagram_trailer"])
    presence[1] = trailer[1] = 1  # the exercise
    struct.pack_into(">HHI", presence, 12, 7, application, epoch)
    struct.pack_into(">II", trailer, 12, 1, epoch)
    return bytes(presence), bytes(trailer)


def membership_seeds(own):
    """Sequences of datagrams, each after its kind, group, source, time and length. The first octet selects equal
    cells, a tree or locales."""
    def session(kind, *datagrams):
        return b"".join(struct.pack(">4BH", kind, group, source, 30, len(octets)) + octets
                        for group, source, octets in datagrams)
    (one, first), (rival, second) = announcement(own, 2, 17), announcement(own, 2, 18)
    mine, third = announcement(own, 1, 19)
    return [session(kind, *datagrams) for kind in (2, 6, 10) for datagrams in (
        ((0, 1, one + first), (0, 1, own["cell_membership"] + first), (1, 1, own["entity_state"] + first)),
        ((0, 1, one + first), (0, 2, rival + second), (0, 1, one)),
        ((0, 3, mine + third), (0, 3, mine), (0, 1, one + first), (0, 9, one + first)))]


def leading_seeds(own):
    """Sequences of PDUs of the peers 2 and 3, each after an action, group, time and length. The first octet enables
    the distribution of groups."""
    scene = -2**31

    def of(peer, kind, body):
        return struct.pack(">BBBBIHBBHHI", 7, 1, kind, 129, 0, 20 + len(body), 0, 0, 7, peer, peer) + body

    def roles(peer, flags, *cells):
        return of(peer, 145, struct.pack(">HH", len(cells), 0) + b"".join(
            struct.pack(">iiQIIHHHHQ", *cell, peer, 5 - peer, 0, flags, 0, 0, 0, 0) for cell in cells))

    def group_map(peer, version, *entries):
        return of(peer, 146, struct.pack(">IHHHH", version, 0, 1, 6, len(entries)) + b"".join(
            struct.pack(">iiIHH", *entry) for entry in entries))
    state = bytearray(own["entity_state"])
    struct.pack_into(">HH", state, 12, 7, 3)
    state[1] = 1
    told = struct.pack(">IHH", 3, len(state), 100) + state
    snapshot = of(2, 147, struct.pack(">iiHHHH", 0, 0, 1, 0, 1, len(told)) + told)
    cells = ((scene, scene), (0, 0))

    def session(first, *pdus):
        return bytes([first]) + b"".join(struct.pack(">BBBH", peer - 2, group, 40, len(octets)) + octets
                                         for peer, group, octets in pdus)
    return [session(first, (2, 0, roles(2, 9, *cells)), (2, 0, group_map(2, 1, (0, 0, 0xBEAC, 3, 0), (1, 0, 0, 2, 0))), (3, 0, roles(3, 4, *cells)),
                    (2, group, snapshot), (3, group, bytes(state)), (3, 0, roles(3, 1, *cells)), (2, 0, roles(2, 2, *cells)))
            for first, group in ((0, 1), (1, 3), (1, 0))]


def viewer_seeds():
    """A request for a stream followed by frames of each kind of request, a request for a file, and the messages
    alone."""
    host = b"127.0.0.1:8642"
    stream = (b"GET /stream?word=0123456789abcdef HTTP/1.1\r\nHost: " + host + b"\r\nOrigin: http://" + host +
              b"\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
              b"Sec-WebSocket-Version: 13\r\n\r\n")
    messages = [b"\x01" + bytes(4), b"\x02" + struct.pack("<d", 1.5), b"\x03" + struct.pack("<f", 2), b"\x04", b"\x05\xff",
                b"\x06" + struct.pack("<HfffB", 0, .1, .2, .3, 1), b"\x07" + struct.pack("<fffB", 100, 10, .1, 0), b"\x08", b"\x09",
                b"\x0a\x01\x00", b"\x0c"]
    frames = [bytes([0x82, 0x80 | len(m), 0, 0, 0, 0]) + m for m in messages]
    offer = b"permessage-deflate; client_max_window_bits, permessage-deflate; server_max_window_bits=10"
    packer = zlib.compressobj(1, zlib.DEFLATED, -15)
    packed = (packer.compress(messages[1]) + packer.flush(zlib.Z_SYNC_FLUSH))[:-4]
    frames.append(bytes([0xC2, 0x80 | len(packed), 0, 0, 0, 0]) + packed)
    agreed = stream[:-2] + b"Sec-WebSocket-Extensions: " + offer + b"\r\n\r\n"
    return [stream, stream + b"".join(frames), agreed + frames[-1], offer, b"GET / HTTP/1.1\r\nHost: " + host + b"\r\n\r\n", b"".join(frames), *messages]


def image_seeds():
    """Small pictures: PNG with 8 and 16 bits, grey and colour, and PGM as text and binary."""
    def png(bits, kind, octets_a_row):
        def chunk(name, content):
            return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
        rows = b"".join(b"\0" + bytes((31 * (i + row)) % 256 for i in range(octets_a_row)) for row in range(4))
        return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, bits, kind, 0, 0, 0)) +
                chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
    return [png(8, 0, 4), png(16, 0, 8), png(8, 6, 16), b"P5 4 4 255\n" + bytes(range(16)), b"P5 4 4 65535\n" + bytes(range(32)),
            b"P2\n# heights\n4 4\n15\n" + b"0 3 12 15 " * 4]


def mesh_seeds():
    """A tetrahedron in each format, and a polygon that is not convex; the first octet is the format."""
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    obj = ("".join("v %g %g %g\n" % p for p in points) + "usemtl a\ng b\n" +
           "".join("f %d/1 %d//2 %d\n" % tuple(i + 1 for i in f) for f in faces)).encode()
    dart = b"v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 .5 0\nv 0 2 0\nf 1 2 3 4 -1\n"
    off = ("OFF\n4 4 0\n" + "".join("%g %g %g\n" % p for p in points) + "".join("3 %d %d %d\n" % f for f in faces)).encode()
    head = ("element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 4\nproperty list uchar int vertex_indices\nend_header\n").encode()
    text = b"ply\nformat ascii 1.0\n" + head + off.split(b"\n", 2)[2]
    plies = [b"ply\nformat binary_%s_endian 1.0\n" % name + head + b"".join(struct.pack(end + "3f", *p) for p in points) +
             b"".join(struct.pack(end + "B3i", 3, *f) for f in faces) for name, end in ((b"little", "<"), (b"big", ">"))]
    stl = bytes(80) + struct.pack("<I", 4) + b"".join(struct.pack("<12fH", 0, 0, 1, *sum((points[i] for i in f), ()), 0) for f in faces)
    solid = ("solid a\n" + "".join("facet normal 0 0 1\nouter loop\n" + "".join("vertex %g %g %g\n" % points[i] for i in f) +
                                   "endloop\nendfacet\n" for f in faces) + "endsolid\n").encode()
    return [bytes([kind]) + text for kind, text in ((0, obj), (0, dart), (1, off), (2, text), (2, plies[0]), (2, plies[1]), (3, stl), (3, solid))]


def words(paths):
    """Lower-case names in quotes: the words of the lists in the sources."""
    text = "".join((ROOT / path).read_text() for path in paths)
    return sorted(set(re.findall(r'"([a-z][a-z0-9_.:]*)"', text)))


def write(folder, seeds):
    folder.mkdir(parents=True, exist_ok=True)
    for octets in seeds:
        (folder / hashlib.sha1(octets).hexdigest()).write_bytes(octets)


def main(folder):
    own = dict(samples())
    files, datagrams = captured()
    touch = own["entity_state"] + own["attribute"]
    pair = [own["entity_state"], touch + own["datagram_trailer"]]
    every = list(own.values()) + datagrams
    seeds = folder / "seeds"
    write(seeds / "pdu", every)
    write(seeds / "bundle", every + pair + [b"".join(own.values())])
    write(seeds / "force_model", [own["attribute"], *pair])
    write(seeds / "filter", (ROOT / "tests/fuzz/filter_examples.txt").read_bytes().splitlines())
    write(seeds / "scene", [p.read_bytes() for p in (ROOT / "scenes").glob("*.toml")] + [NODES] +
          [b".".join([b"a"] * parts) + b" = 1\n" for parts in (200, 300, 30_927, 500_000)] +
          [b"[" + b".".join([b"a"] * 300) + b"]\n", b"x = " + b"[" * 300, b"x = " + b"{a.b = " * 100])
    write(seeds / "capture", [pcap(pair), pcapng(pair, 9), pcapng(pair, 0), mixed_pcapng(pair),
                              gzip.compress(pcap(pair), mtime=0), lzma.compress(pcap(pair)),
                              bz2.compress(pcap(pair)), pcap([], tunnelled(frame_of(pair[0]))),
                              pcap([], tunnelled(next(fragments_of(pair[0], 1))))] + [f.read_bytes() for f in files])
    pieces = [bytes([4, 0, 151, 1, 0]), bytes([4, 19, 151, 1, 0]), bytes([4, 38, 151, 1, 0]), bytes([0, 57, 143, 1, 0])]
    write(seeds / "fragments", [b"".join(pieces), b"".join(pieces[::-1]), b"".join(pieces[1:]) * 3 + b"".join(pieces),
                                b"".join(p + p for p in pieces), b"".join(pieces[:3]) + bytes([1, 9, 80, 200, 200]) * 4])
    write(seeds / "envelope", [bytes([i]) for i in range(5)] + [bytes([i, 16, 1]) for i in range(4)] +
          [b"\x04\xe7\x12" + bytes(46), b"\x04" + touch[:200]])
    states = own["compressed_states"][20:]
    write(seeds / "compression", [states] + [bytes([length, 0, 1]) + bytes(length) for length in (1, 24, 60, 128 + 40)])
    record = own["assured_record"]
    write(seeds / "assured", [record, touch + record, own["fire"] + record, bytes([0, 0, 1, 0]) * 300,
                              b"".join(bytes([i % 4, i % 3, i % 256, i % 7]) for i in range(500))])
    world = struct.pack(">II", 1, 1)
    messages = [(1, struct.pack(">IIIIIBBBB", 1, 2, 0, 0, 0, 1, 6, 0, 0)), (1, world + struct.pack(">IIIBBBB", 1, 7, 9, 5, 5, 0, 0)),
                (2, world + struct.pack(">IIIIIIIBBBB", 2, 1, 1, 2, 0, 0, 0, 2, 1, 0, 0) + bytes(32) + struct.pack(">II", 1, 0)),
                (3, world + struct.pack(">III", 2, 1, 1)), (4, world + struct.pack(">IIHHHHIQ", 3, 1, 1, 1, 2, 0, 2, 1 << 32 | 1)),
                (5, world + struct.pack(">I", 1) + b"\xff" * 32), (0, own["acknowledge"]), (0, transfer(2, world + b"\xff" * 32)),
                (0, transfer(1, world + struct.pack(">IIBBHI", 1, 2000, 1, 1, 1, 0) + b"\1" + bytes(31) +
                             struct.pack(">HHIQQ16d", 0, 0, 1, 1 << 32 | 1, 0, 0, 0, 0, 1, *[0.0] * 12)))]
    messages = [bytes([kind, 0, 50, (len(octets) + 3) // 4]) + octets + bytes(-len(octets) % 4) for kind, octets in messages]
    write(seeds / "ownership", [*messages, b"".join(messages), b"".join(messages[:2] * 20)])
    write(seeds / "unicast", [own["unicast_frame"][:12] + bytes([0, group, 0, 0]) + touch for group in (0, 1, 2, 7)] +
          [touch, own["unicast_frame"], b"10.0.0.7, host-b:3001", b"2001:db8::7,[2001:db8::8]:3002"])
    digits = b"5a" * 32
    report = b"<BAAAPPPPEDCB\xb6A>"
    write(seeds / "falcon", [report, b"\x01\x60" + report + report[:7], report[5:] + report, b"<AAAA" + report])
    counts = b"\x00\x00\x00\x00\x78\xec" + bytes(6)
    write(seeds / "polhem", [counts + b"\x00\x00", counts + b"\x01\x00", counts[:6] + b"\x07\x00",
                             b"\xff\x7f\x00\x80\x01\xf0\x88\x13\x10\x27\x00\x01\x00\x00" * 3])
    reports = [b"\xd9" + struct.pack("<BHIHHBBiii", 0x82, i, 1000 * i, max(0, i - 2), max(0, i - 1), 3, 0, 5 * i, -7, i) for i in range(12)]
    write(seeds / "serial", [b"".join(reports), b"".join(reports[:5] + reports[7:]), b"".join(reports[:4]) + b"\x60" + b"".join(reports[4:]),
                             b"\x00\x03\x07\x01\x09\x00", b"\x05\x11\x22\x00\x33\x00", bytes(9)])
    mouse = bytes.fromhex("05010902a1010901a100050919012903150025019503750181029501750581010501"
                          "093009311581257f750895028106c0c0")
    places = b"\x05\x01\x00\xff\x7f\x00\x80" * 3
    write(seeds / "hid", [b"\x00" + struct.pack("<H", len(mouse)) + mouse + places, b"\x01" + places, b"\x03" + places,
                          b"\x43\x20\x00\x66\x30\x00\x01" + places, b"\x05\x04\x0a\x01\x01\x00\x00"])
    write(seeds / "key_file", [b"group g\nsuite aes-256-gcm\nepoch 1 secret " + digits,
                               b"# key\ngroup g\nsuite xchacha20-poly1305\nepoch 1 secret " + digits +
                               b"\nepoch 2 from 2026-12-01T06:00:00Z secret " + digits + b"\n"])
    write(seeds / "presence", [bytes([kind, i % 4, i, 16 * i + i % 3, 90]) * 3 for kind in (0, 129, 131) for i in range(12)])
    write(seeds / "tracker", [bytes([64]) + bytes([0, i % 128, 0, 1 + i % 3]) * 40 for i in range(12)])
    write(seeds / "membership", membership_seeds(own))
    write(seeds / "leading", leading_seeds(own))
    write(seeds / "viewer", viewer_seeds())
    write(seeds / "image", image_seeds())
    write(seeds / "mesh", mesh_seeds())
    rows = b"".join(b"%g,%d,%d,0,1,0,0,0\n" % (i / 2, i * i, i) for i in range(6))
    write(seeds / "track", [b"t_s,px_m,py_m,pz_m,qw,qx,qy,qz\n" + rows, b"t_s,px_m,py_m,pz_m,heading_rad,a,b,c\n" + rows,
                            b"\"T_s\", pz_m,\"px_m\",py_m\r\n0,1,2,3\r\n\"1\",1,2,3\r\n"])
    write(seeds / "density", [b"x_m,y_m\n1,2\n-3,4e2\n", b"t_s,px_m,py_m,pz_m\n0,1,2,3\n1,1,2,3\n"])
    write(seeds / "descriptor", [p.read_bytes() for p in (ROOT / "devices").glob("*.toml")])
    for name, sources in (("filter", ["tools/datagrams/filter_fields.cpp"]),
                          ("descriptor", ["src/scene/device_descriptor.cpp"]),
                          ("scene", ["src/scene/scene_sections.cpp", "src/scene/aoim_section.cpp",
                                     "src/scene/tier_section.cpp", "src/scene/network_section.cpp", "src/scene/node_section.cpp",
                                     "src/scene/object_section.cpp",
                                     "src/scene/scene_words.hpp",
                                     "src/scene/device_descriptor.cpp", "src/scene/device_section.cpp", "src/scene/entity_section.cpp",
                                     "deadreckon/sending/send_rules.hpp", "deadreckon/motion/convergence.hpp"])):
        lines = "".join(f'"{word}"\n' for word in words(sources))
        (folder / f"{name}.dict").write_text(lines)
    print(f"reckon: seeds from {len(own)} samples and {len(datagrams)} captured datagrams",
          file=sys.stderr)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
