# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Peers on hosts that carry no multicast, each in a network namespace of its own: `reckon peer --to`. One case per call,
with the arguments of namespaces.py."""
import socket
import sys
import time

import dis_wire as dis
import testbed
from namespaces import PORT, run
from testbed import Testbed, check

NAMES = ("ONE", "TWO", "THREE", "FOUR")


def world(more=""):
    """A car of each peer, all within 100 m."""
    text = '[scene]\nname = "cloud"\norigin = {latitude = "47 deg", longitude = "8 deg", height = "400 m"}\n'
    for number, name in enumerate(NAMES, 1):
        text += (f'[[entity]]\npeer = {number}\nmarking = "{name}"\ntype = "1.1.225.1"\nposition = [{30 * number}, 0, 0]\n'
                 'dead_reckoning = {heartbeat = "1 s"}\n')
    return text + f'[aoim]\ncell = "40 m"\nradius = "200 m"\n[network]\n{more}'


def start(setup, bed, host, scene, peers):
    """A peer whose datagrams go to `peers` alone."""
    path = setup.folder / f"scenes/cloud_{host}.toml"
    path.write_text(scene)
    return bed.peer(host, path, NAMES[host - 1], host, ("--to", peers))


def drop_multicast(bed, hosts):
    for host in range(1, hosts + 1):
        bed.firewall(host, "output", "ip daddr 224.0.0.0/4 drop; ip6 daddr ff00::/8 udp dport 3000 drop")


def hosts_of_a_list(setup):
    """Three of a list show one another, by cells as ever; nothing goes to a group. A fourth whom nobody lists is shown
    to none; what it says is heard all the same, and that it does not hear them is told."""
    listed = ", ".join([*map(Testbed.address, (1, 2)), f"{Testbed.address(3)}:{PORT}"])
    with setup.testbed(4) as bed:
        drop_multicast(bed, 4)
        sniffer = bed.sniff()
        peers = [start(setup, bed, host, world(), listed) for host in (1, 2, 3)]
        for host, peer in zip((1, 2, 3), peers):
            for other in (1, 2, 3):
                if other != host:
                    check(peer.wait_event("appeared", 5, NAMES[other - 1]),
                          f"{NAMES[other - 1]} was never shown to {NAMES[host - 1]}; {peer.error_text()}")
        stranger = start(setup, bed, 4, world(), listed)
        check(peers[0].wait_event("appeared", 5, "FOUR"), f"FOUR is not heard; {peers[0].error_text()}")
        check(peers[0].wait_line("does not hear this one", 10), "who is in no list hears nobody, and nobody is told")
        check(not stranger.events("appeared"), "somebody spoke to who is in no list")
        mine = stranger.report()
        check(mine["datagrams_in"] == 0, f"{mine['datagrams_in']} datagrams went to who is in no list")
        check(peers[1].wait_event("gone", 3, "FOUR"), "FOUR left and is still shown")
        reports = [peer.report() for peer in peers]
        for report in reports:
            print(f"  {report['id']}: {report['datagrams_in']} in, {report['link']['sent']} out, {report['datagrams_lost']} lost")
            check(report["datagrams_lost"] == 0 and report["link"]["kernel_drops"] == 0, "datagrams were lost")
            check(report["unicast_refused"] == 0 and report["malformed_in"] == 0, "datagrams were refused")
        check(not sniffer.datagrams, f"{len(sniffer.datagrams)} datagrams went to groups")


def plain_dis(setup):
    """With `interop` a program that knows plain DIS alone hears Entity States, and is heard, by unicast."""
    scene = world("interop = true\n")
    with setup.testbed(2) as bed:
        drop_multicast(bed, 2)
        tool = bed.socket(2, socket.AF_INET, socket.SOCK_DGRAM)
        tool.bind((Testbed.address(2), PORT))
        tool.settimeout(0.1)
        peer = start(setup, bed, 1, scene, Testbed.address(2))
        heard, end = [], time.monotonic() + 4
        while time.monotonic() < end:
            try:
                heard += dis.pdus(tool.recv(65536))
            except TimeoutError:
                continue
        states = [octets for kind, octets in heard if kind == dis.ENTITY_STATE]
        print(f"  {len(heard)} PDUs, {len(states)} of them Entity States")
        check(states and len(states) == len(heard), f"PDUs of types {sorted({kind for kind, _ in heard})}")
        check(not list(dis.EntityState(states[-1]).problems()), "no valid Entity State")
        guest = bytearray(states[-1])
        guest[12:18] = bytes((0, 9, 0, 9, 0, 9))
        guest[129:140] = b"GUEST".ljust(11, b"\0")
        tool.sendto(guest, (Testbed.address(1), PORT))
        check(peer.wait_event("appeared", 3, "GUEST"), f"GUEST is not shown; {peer.error_text()}")
        peer.report()
        tool.close()


def impaired_and_sealed(setup):
    """Over IPv6, sealed, with 10 % lost: two of a list show each other."""
    with setup.testbed(2) as bed:
        for host in (1, 2):
            bed.ip(host, "addr", "add", f"fd00::{host}/64", "dev", "e0", "nodad")
        drop_multicast(bed, 2)
        (setup.folder / "scenes/cloud.key").write_text("group cloud\nsuite aes-256-gcm\nepoch 1 secret " + "5a" * 32 + "\n")
        (setup.folder / "scenes/cloud.key").chmod(0o600)
        peers = []
        for host in (1, 2):
            more = (f'group = "ff15::c0:100"\nkey = "cloud.key"\n[impairment]\nloss = "10 %"\nseed = {host}\n')
            peers.append(start(setup, bed, host, world(more), "fd00::1, [fd00::2]"))
        for peer, other in zip(peers, ("TWO", "ONE")):
            check(peer.wait_event("appeared", 8, other), f"{other} was never shown; {peer.error_text()}")
        time.sleep(8)
        peers[0].interrupt()
        for report in [peer.report() for peer in peers]:
            print(f"  {report['id']}: {report['datagrams_in']} in, {report['datagrams_lost']} lost, "
                  f"{report['link']['lost_by_law']} by the law")
            check(report["link"]["lost_by_law"] > 0, "nothing was lost: nothing was shown")


CASES = {case.__name__: case for case in (hosts_of_a_list, plain_dis, impaired_and_sealed)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
