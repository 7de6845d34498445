# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Reception by listeners: every interface, one copy of a datagram, broadcast and unicast without privileges, and the
messages about silence. Bare sockets beside them are the reference. One case per call, with the arguments of
namespaces.py."""
import json
import socket
import struct
import sys
import time

import dis_wire as dis
import testbed
from namespaces import BASE_GROUP, PORT, run
from testbed import Testbed, check

PLAIN_USER = ("setpriv", "--bounding-set=-all", "--inh-caps=-all")  # root without its privileges
SUBNET, EVERYBODY = "10.77.0.255", "255.255.255.255"


def pdu(number):
    """An Acknowledge PDU with a number as its request ID."""
    body = struct.pack(">HHHHHHHHI", 1, 1, 1, 1, 2, 1, 1, 1, number)
    return dis.HEADER.pack(7, 1, 15, 5, 0, dis.HEADER.size + len(body), 0, 0) + body


class Judge:
    """A bare socket in a host that counts what it receives, like any other DIS program."""

    def __init__(self, bed, host, address):
        self.socket = bed.socket(host, socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.bind((address, PORT))
        self.socket.setblocking(False)

    def count(self):
        heard = 0
        while True:
            try:
                self.socket.recv(65536)
            except BlockingIOError:
                return heard
            heard += 1


def broadcaster(bed, host):
    sock = bed.socket(host, socket.AF_INET, socket.SOCK_DGRAM)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, b"e0")
    return sock


def listener(setup, bed, host, *arguments, seconds=4):
    """Starts `reckon inspect` as a plain user."""
    program = bed.run(host, [*PLAIN_USER, str(setup.reckon), "inspect", *arguments, "--json", "--for", f"{seconds}s"])
    check(program.wait_line("listening to", 5, errors=True), f"does not listen: {program.error_text()}")
    return program


def heard(program):
    """Its PDUs, read after its end."""
    status = program.wait()
    check(status == 0, f"ended with status {status}: {program.error_text()}")
    return [json.loads(text) for _, text in program.lines]


def one_host(setup):
    """`reckon demo` in one terminal, `inspect` and `record` in others: without --iface they meet, over lo."""
    with setup.testbed(1) as bed:
        demo = bed.run(1, [str(setup.reckon), "demo", "--for", "8s"])
        capture = setup.folder / "demo.pcapng"
        recorder = bed.run(1, [*PLAIN_USER, str(setup.reckon), "record", str(capture), "--for", "4s"])
        rows = heard(listener(setup, bed, 1))
        states = [row for row in rows if row["type"] == "entity_state"]
        print(f"  inspect: {len(rows)} PDUs, {len(states)} Entity States")
        check(states and {row["interface"] for row in rows} == {"lo"}, f"heard {len(rows)} PDUs")
        check(recorder.wait() == 0, f"record: {recorder.error_text()}")
        check("on lo and e0" in recorder.error_text(), f"record does not say where it listens: {recorder.error_text()}")
        recorded = json.loads(bed.system(1, f"{setup.reckon} info {capture} --json").splitlines()[0])
        print("  " + recorder.error_text().replace("\n", "\n  "))
        check(recorded.get("datagrams", 0) > 10, f"recorded {recorded}")
        demo.interrupt()
        demo.wait()


def two_interfaces(setup):
    """A host with two cables to one LAN: each datagram is counted once, and equal ones as often as they were sent."""
    with setup.testbed(2) as bed:
        bed.ip(1, "link", "add", "e1", "type", "veth", "peer", "name", "p1b", "netns", bed.namespace(testbed.SWITCH))
        bed.ip(testbed.SWITCH, "link", "set", "p1b", "master", "br0", "up")
        bed.ip(1, "addr", "add", "10.77.0.101/24", "dev", "e1")
        bed.ip(1, "link", "set", "e1", "up")
        bed.system(1, "for i in all e0 e1; do echo 0 > /proc/sys/net/ipv4/conf/$i/rp_filter; done")
        program = listener(setup, bed, 1)
        sender = bed.multicast_sender(2)
        for number in range(40):
            for _ in range(1 + number % 2):
                sender.sendto(pdu(number), (BASE_GROUP, PORT))
            time.sleep(0.01)
        rows = heard(program)
        print("  " + program.errors[-1][1])
        check(len(rows) == 60, f"{len(rows)} of 60 datagrams")
        check("60 datagrams also arrived on another interface" in program.error_text(), program.error_text())
        alone = listener(setup, bed, 1, "--iface", "e1", seconds=2)
        sender.sendto(pdu(1), (BASE_GROUP, PORT))
        rows = heard(alone)
        check([row["interface"] for row in rows] == ["e1"], f"{rows}")


def broadcast(setup):
    """Broadcast and unicast of plain DIS are heard by a plain user, beside another program on the port."""
    with setup.testbed(2) as bed:
        sender = broadcaster(bed, 2)
        both = {SUBNET: 20, EVERYBODY: 20}
        for place, wanted, has_neighbour in ((SUBNET, both, True), (EVERYBODY, both, True), ("0.0.0.0", both, True),
                                             ("0.0.0.0", both | {Testbed.address(1): 20}, False),
                                             (Testbed.address(1), {Testbed.address(1): 20}, False)):
            judge = Judge(bed, 1, "0.0.0.0") if has_neighbour else None
            program = listener(setup, bed, 1, f"udp://{place}:{PORT}", seconds=3)
            for number in range(20):
                for target in (SUBNET, EVERYBODY, Testbed.address(1)):
                    sender.sendto(pdu(number), (target, PORT))
                time.sleep(0.01)
            rows = heard(program)
            print(f"  {place}: {len(rows)} heard; {program.errors[-1][1]}")
            check(len(rows) == sum(wanted.values()), f"{place}: {len(rows)} of {wanted}: {program.error_text()}")
            check(all(row["status"] == "ok" and row["interface"] == "e0" for row in rows), f"{rows[0]}")
            if judge:
                count = judge.count()
                check(count == 60, f"{place}: the other program heard {count} of 60")
                judge.socket.close()
        capture = setup.folder / "broadcast.pcapng"
        recorder = bed.run(1, [*PLAIN_USER, str(setup.reckon), "record", str(capture), f"udp://{SUBNET}", "--for", "2s"])
        check(recorder.wait_line("recording", 5, errors=True), recorder.error_text())
        for number in range(20):
            sender.sendto(pdu(number), (SUBNET, PORT))
        check(recorder.wait() == 0 and "20 datagrams" in recorder.error_text(), recorder.error_text())
        taken = bed.run(1, [str(setup.reckon), "inspect", f"udp://{Testbed.address(2)}"])
        check(taken.wait() == 3 and "an address or a broadcast address" in taken.error_text(), taken.error_text())


def broadcast_peers(setup):
    """A peer that broadcasts to everybody and one that broadcasts to the subnet hear each other."""
    with setup.testbed(3) as bed:
        judges = {address: Judge(bed, 3, address) for address in (EVERYBODY, SUBNET)}
        peers = [bed.peer(host, setup.changed_scene(f"broadcast_{host}", "[hand]",
                                                    f'[network]\ninterop = true\ngroup = "{address}"\n\n[hand]'), name, host)
                 for host, address, name in ((1, EVERYBODY, "ALICE"), (2, SUBNET, "BOB"))]
        for peer, other in zip(peers, ("BOB", "ALICE")):
            check(peer.wait_event("appeared", 6, other), f"{other} was never shown; {peer.error_text()}")
        counts = {address: judge.count() for address, judge in judges.items()}
        print(f"  a bare socket heard {counts}")
        check(all(counts.values()), "one form was not sent")
        for peer in peers:
            peer.report()


def silence(setup):
    """Who hears nothing is told where it listens, and what else is heard on this host."""
    with setup.testbed(2) as bed:
        demo = bed.run(1, [str(setup.reckon), "demo", "--for", "20s"])
        elsewhere = listener(setup, bed, 1, "--iface", "e0", seconds=9)
        other = bed.multicast_receiver(1, "239.9.9.9", 6400)
        port = listener(setup, bed, 1, "udp://239.7.7.7:7000", seconds=9)
        sender = bed.multicast_sender(2)
        for number in range(80):
            sender.sendto(pdu(number), ("239.9.9.9", 6400))
            time.sleep(0.1)
        check(not heard(elsewhere) and not heard(port), "heard what it does not listen to")
        for program, where, what in ((elsewhere, rf"nothing received yet at {BASE_GROUP}:{PORT} .* on e0", f"{BASE_GROUP}:{PORT} on lo"),
                                     (port, "nothing received yet at 239.7.7.7:7000 on lo and e0", "239.9.9.9:6400 on e0")):
            told = program.wait_line(where, 0, errors=True)
            check(told and 2.9 < told[0] < 5, f"not told where it listens: {program.error_text()}")
            check(program.wait_line(f"received by this host: {what}", 0, errors=True), f"not told of {what}: {program.error_text()}")
        print("  " + "\n  ".join(text for _, text in port.errors))
        other.close()
        demo.interrupt()
        demo.wait()


def as_typed(setup):
    """The commands of docs/first_steps/lan_operator.md on two hosts: a recording, its replay, and who hears it."""
    capture = setup.folder / "today.pcapng"
    words = [str(setup.reckon), "replay", str(capture), "--rate", "4"]
    with setup.testbed(2) as bed:
        sender = bed.multicast_sender(2)
        recorder = bed.run(1, [str(setup.reckon), "record", str(capture), "--iface", "e0", "--for", "3s"])
        check(recorder.wait_line("recording", 5, errors=True), recorder.error_text())
        for number in range(20):
            sender.sendto(pdu(number), (BASE_GROUP, PORT))
            time.sleep(0.05)
        check(recorder.wait() == 0 and "20 datagrams" in recorder.error_text(), recorder.error_text())
        place = f"{BASE_GROUP}:{PORT} on "
        for more, reach, here, there in (([], place + "lo (only this host; --iface e0 for the LAN)", 20, 0),
                                         (["--iface", "e0"], place + "e0", 20, 20),
                                         (["--iface", "recorded"], place + "e0", 20, 20)):
            listeners = [listener(setup, bed, host, seconds=3) for host in (1, 2)]
            replay = bed.run(1, words + more)
            check(replay.wait() == 0, replay.error_text())
            said = [text for _, text in replay.errors + replay.lines]
            print("  " + " | ".join(said))
            check(said[0] == "sending to " + reach and reach in said[-1], f"{more}: {said}")
            counts = [len(heard(program)) for program in listeners]
            check(counts == [here, there], f"{more}: heard {counts} instead of {here, there}")


CASES = {case.__name__: case for case in (as_typed, one_host, two_interfaces, broadcast, broadcast_peers, silence)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
