# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Listeners in the traffic of a real LAN: IPv6, interfaces that appear and disappear, other protocols at the port,
fragments, and a page beside it. tshark and the sent numbers are the reference. One case per call, with the arguments
of namespaces.py."""
import base64
import json
import os
import shutil
import socket
import struct
import sys
import time

import dis_wire as dis
import testbed
from namespaces import BASE_GROUP, PORT, run
from namespaces_listen import EVERYBODY, PLAIN_USER, SUBNET, broadcaster, heard, listener, pdu
from testbed import Skip, Testbed, check

MTU = 1500


def comment(number, octets):
    """A Comment PDU of a given length, with one variable datum that begins with a number."""
    text = struct.pack(">I", number) + bytes(octets - 44)
    body = struct.pack(">6HII", 1, 1, 1, 1, 2, 1, 0, 1) + struct.pack(">II", 1, 8 * len(text)) + text
    return dis.HEADER.pack(7, 1, 22, 5, 0, dis.HEADER.size + len(body), 0, 0) + body


def ipv6(setup):
    """Groups of IPv6 with and without a scope of one link, and unicast to an own address, on every interface."""
    with setup.testbed(2) as bed:
        for host in (1, 2):
            bed.ip(host, "addr", "add", f"fd00::{host}/64", "dev", "e0", "nodad")
        sender = bed.socket(2, socket.AF_INET6, socket.SOCK_DGRAM)
        index = int(bed.system(2, "cat /sys/class/net/e0/ifindex"))
        sender.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_MULTICAST_IF, index)
        for place, more in (("ff15::c0:100", ()), ("ff02::c0:100", ("--iface", "e0")), ("fd00::1", ()), ("::", ())):
            program = listener(setup, bed, 1, f"udp://[{place}]:{PORT}", *more, seconds=3)
            target = "fd00::1" if place == "::" else place
            for number in range(30):
                sender.sendto(pdu(number), (target, PORT, 0, index))
                time.sleep(0.005)
            rows = heard(program)
            print(f"  [{place}]: {len(rows)} heard; {program.errors[-1][1]}")
            check("cannot" not in program.error_text(), program.error_text())
            check(len(rows) == 30 and {row["interface"] for row in rows} == {"e0"}, f"{len(rows)} of 30: {program.error_text()}")


def comes_and_goes(setup):
    """A cable that is plugged in while a listener runs is heard, and one that is pulled takes nothing with it."""
    with setup.testbed(2) as bed:
        bed.unplug(1)
        program = listener(setup, bed, 1, seconds=9)
        sender = bed.multicast_sender(2)

        def send(first):
            for number in range(first, first + 20):
                sender.sendto(pdu(number), (BASE_GROUP, PORT))
                time.sleep(0.01)

        send(0)  # nobody can receive these
        bed.plug(1)
        time.sleep(1)
        send(100)
        bed.unplug(1)
        time.sleep(0.5)
        send(200)
        bed.plug(1)
        time.sleep(1)
        send(300)
        rows = heard(program)
        found = len(rows)
        print(f"  {found} of 40 heard; " + "; ".join(text for _, text in program.errors))
        check("e0: 40 datagrams" in program.error_text(), program.error_text())
        check(found == 40 and all(row["status"] == "ok" for row in rows), f"{found} of 40: {program.error_text()}")


NOISE = (
    (53, bytes.fromhex("1a2b01000001000000000000") + b"\x07example\x03org\x00\x00\x01\x00\x01"),  # DNS
    (5353, bytes.fromhex("000000000001000000000000") + b"\x05_http\x04_tcp\x05local\x00\x00\x0c\x00\x01"),  # mDNS
    (123, bytes.fromhex("e30003fa00010000") + bytes(40)),  # NTP
    (1900, b"M-SEARCH * HTTP/1.1\r\nHOST: 239.255.255.250:1900\r\nMAN: \"ssdp:discover\"\r\n\r\n"),  # SSDP
)


def noise(setup):
    """60 PDUs beside four other protocols on one interface, and at the very port: 60 PDUs, no error, the rest counted."""
    with setup.testbed(2) as bed:
        on_interface = bed.run(1, [str(setup.reckon), "inspect", "iface:e0", "--json", "--for", "4s"])
        check(on_interface.wait_line("listening to all UDP of e0", 5, errors=True), on_interface.error_text())
        at_port = listener(setup, bed, 1, f"udp://{SUBNET}")
        sender = broadcaster(bed, 2)
        for number in range(60):
            sender.sendto(pdu(number), (SUBNET, PORT))
            for port, octets in NOISE:
                sender.sendto(octets, (SUBNET, port))
                sender.sendto(octets, (SUBNET, PORT))
            time.sleep(0.01)
        for name, program in (("interface", on_interface), ("port", at_port)):
            rows = heard(program)
            good = [row for row in rows if row.get("status") == "ok" and row.get("type") == "acknowledge"]
            errors = [row for row in rows if row.get("status") == "error"]
            print(f"  {name}: {len(good)} PDUs, {len(errors)} errors, {len(rows)} rows; {program.errors[-1][1]}")
            check(len(good) == 60, f"{len(good)} of 60 PDUs on the {name}")
            check("; 480 datagrams of other protocols" in program.error_text() or name == "port", program.error_text())
            check("60 PDUs in 60 datagrams: 60 good, 0 errors, 0 notes" in program.error_text(), program.error_text())
            check(not errors, f"an error on the {name}: {errors[0] if errors else None}")


PROBE = 300  # octets of a comment that only shows that tshark has started


def judged(setup):
    """tshark and `inspect` beside each other: multicast, both broadcasts, unicast and fragments, PDU by PDU."""
    if shutil.which("tshark") is None:
        raise Skip("needs tshark, the judge")
    with setup.testbed(2) as bed:
        fields = ("ip.dst", "dis.proto_ver", "dis.pdu_type", "dis.exer_id", "dis.pdu_length")
        shark = bed.run(1, ["tshark", "-i", "e0", "-n", "-Q", "-l", "-f", "udp or (ip[6:2] & 0x3fff != 0)", "-Y", "dis",
                            "-d", f"udp.port=={PORT},dis", "-T", "fields", *(word for field in fields for word in ("-e", field))])
        sender = broadcaster(bed, 2)
        group = bed.multicast_sender(2)
        # tshark does not report its start.
        end = time.monotonic() + 30
        while not shark.lines and time.monotonic() < end:
            group.sendto(comment(0, PROBE), (BASE_GROUP, PORT))
            time.sleep(0.1)
        check(shark.lines, f"tshark saw nothing in 30 s: {shark.error_text()}")
        program = bed.run(1, [str(setup.reckon), "inspect", "iface:e0", "--json", "--for", "6s"])
        check(program.wait_line("listening", 5, errors=True), program.error_text())
        for number in range(20):
            for target in (SUBNET, EVERYBODY, Testbed.address(1)):
                sender.sendto(pdu(number), (target, PORT))
            group.sendto(pdu(number), (BASE_GROUP, PORT))
            group.sendto(comment(number, 7000), (BASE_GROUP, PORT))
            time.sleep(0.01)
        probe = str(len(comment(0, PROBE)))
        rows = heard(program)
        ours = sorted((str(row["type_number"]), str(row["length"])) for row in rows)
        shark.interrupt()
        check(shark.wait() == 0, shark.error_text())
        judge = sorted((words[2], words[4]) for words in (text.split("\t") for _, text in shark.lines) if words[4] != probe)
        ours = [pdu for pdu in ours if pdu[1] != probe]
        print(f"  tshark {len(judge)} PDUs, inspect {len(ours)}")
        check(len(judge) == 100, f"tshark itself saw {len(judge)} of 100")
        check(ours == judge, f"inspect: {sorted(set(ours) ^ set(judge))[:4]}, {len(ours)} PDUs")


def frames_of(bed, payload, identifier, left_out=None):
    """Ethernet frames of a UDP datagram to the group in fragments of the MTU; `left_out` is the number of the lost
    fragment."""
    udp = struct.pack(">HHHH", 4000, PORT, 8 + len(payload), 0) + payload
    room = (MTU - 20) // 8 * 8
    target = socket.inet_aton(BASE_GROUP)
    ethernet = bytes([1, 0, 0x5E, target[1] & 0x7F, target[2], target[3]]) + bytes([2, 0, 0, 0, 0, 2]) + b"\x08\x00"
    for place, at in enumerate(range(0, len(udp), room)):
        piece = udp[at:at + room]
        more = 0x2000 if at + room < len(udp) else 0
        head = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(piece), identifier & 0xFFFF, more | at // 8, 8, 17, 0,
                           socket.inet_aton(Testbed.address(2)), target)
        total = sum(struct.unpack(">10H", head))
        total = (total & 0xFFFF) + (total >> 16)
        head = head[:10] + struct.pack(">H", ~(total + (total >> 16)) & 0xFFFF) + head[12:]
        if place != left_out:
            yield ethernet + head + piece


def fragments(setup):
    """Datagrams of 7,000 octets in fragments, one fragment of each 100 datagrams lost: all others are whole."""
    count, seconds = 1000, 4
    with setup.testbed(2) as bed:
        sender = bed.socket(2, socket.AF_PACKET, socket.SOCK_RAW)
        sender.bind(("e0", 0))
        sources = {"iface:e0": bed.run(1, [str(setup.reckon), "inspect", "iface:e0", "--json", "--for", f"{seconds}s"])}
        check(sources["iface:e0"].wait_line("listening", 5, errors=True), "does not listen")
        sources["group"] = listener(setup, bed, 1, f"udp://{BASE_GROUP}:{PORT}", seconds=seconds)
        begin = time.monotonic()
        for number in range(count):
            lost = number // 100 % 5 if number % 100 == 50 else None
            for frame in frames_of(bed, comment(number, 7000), number + 1, lost):
                sender.send(frame)
            time.sleep(max(0, begin + number / 1000 - time.monotonic()))
        for name, program in sources.items():
            rows = [row for row in heard(program) if row["type"] == "comment"]
            whole = [row for row in rows if row["status"] == "ok" and row["length"] == 7000]
            print(f"  {name}: {len(whole)} of {count - count // 100} whole, {len(rows)} rows; {program.errors[-1][1]}")
            lost = f"{count // 100} datagrams still waited for IP fragments" in program.error_text()
            check(lost or name == "group", f"what was lost is not said: {program.error_text()}")
            check(len(whole) == len(rows) == count - count // 100, f"{name}: {len(whole)} whole: {program.error_text()}")


def websocket(bed, host, port):
    """A tab's connection; yields the server's texts."""
    sock = bed.socket(host, socket.AF_INET, socket.SOCK_STREAM)
    sock.settimeout(5)
    sock.connect(("127.0.0.1", port))
    key = base64.b64encode(os.urandom(16)).decode()
    sock.sendall((f"GET /stream HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                  f"Origin: http://127.0.0.1:{port}\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
    stream = sock.makefile("rb")
    check(b" 101 " in stream.readline(), "the page's connection was refused")
    while stream.readline().strip():
        pass
    while True:
        first, size = stream.read(2)
        if size in (126, 127):
            size = int.from_bytes(stream.read(2 if size == 126 else 8), "big")
        octets = stream.read(size)
        if first & 0x0F == 1:
            yield json.loads(octets)
        elif octets.startswith(b"RKV4"):
            sock.sendall(drawn(*struct.unpack_from("<I", octets, 4)))


def drawn(number):
    """A tab's masked frame: acknowledges the picture with this number, so that more may be sent."""
    return bytes([0x82, 0x85, 0, 0, 0, 0, 1]) + struct.pack("<I", number)


def viewed(setup):
    """`reckon view` of a broadcast address: the entity is in the list that a tab is given."""
    with setup.testbed(2) as bed:
        program = bed.run(1, [*PLAIN_USER, str(setup.reckon), "view", f"udp://{SUBNET}", "--port", "8790"])
        check(program.wait_line(r"http://127.0.0.1:8790", 5), f"{program.error_text()}")
        sender = broadcaster(bed, 2)
        deadline = time.monotonic() + 8
        sender.sendto(truck(), (SUBNET, PORT))
        for message in websocket(bed, 1, 8790):
            sender.sendto(truck(), (SUBNET, PORT))
            names = [row.get("marking") for row in message.get("entities", [])]
            if "BROADCAST" in names:
                break
            check(time.monotonic() < deadline, "the entity was never in the list")
        program.interrupt()
        check(program.wait() == 0, program.error_text())


def truck():
    """An Entity State PDU with the marking BROADCAST."""
    body = struct.pack(">HHHBB", 1, 2, 3, 1, 0) + bytes([1, 1, 0, 225, 1, 1, 0, 0]) + bytes(8)
    body += struct.pack(">3f3d3fI", 0, 0, 0, dis.WGS84_A, 0, 0, 0, 0, 0, 0)
    body += bytes([2]) + bytes(39) + bytes([1]) + b"BROADCAST".ljust(11, b"\0") + struct.pack(">I", 0)
    return dis.HEADER.pack(7, 1, dis.ENTITY_STATE, 1, 0, dis.HEADER.size + len(body), 0, 0) + body


CASES = {case.__name__: case for case in (ipv6, comes_and_goes, noise, judged, fragments, viewed)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
