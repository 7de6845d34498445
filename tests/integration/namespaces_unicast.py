# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Peers on hosts that carry no multicast, each in a network namespace of its own: `reckon peer --to` and `[network] peers`.
One case per call, with the arguments of namespaces.py."""
import json
import signal
import socket
import sys
import time

import dis_wire as dis
import testbed
import wire_balance
from namespaces import PORT, run
from testbed import Testbed, check

NAMES = ("ONE", "TWO", "THREE", "FOUR")


def world(more="", radius=200):
    """A car for each peer, all within 100 m."""
    text = '[scene]\nname = "cloud"\norigin = {latitude = "47 deg", longitude = "8 deg", height = "400 m"}\n'
    for number, name in enumerate(NAMES, 1):
        text += (f'[[entity]]\npeer = {number}\nmarking = "{name}"\ntype = "1.1.225.1"\nposition = [{30 * number}, 0, 0]\n'
                 'dead_reckoning = {heartbeat = "1 s"}\n')
    return text + f'[aoim]\ncell = "40 m"\nradius = "{radius} m"\n[network]\n{more}'


def start(setup, bed, host, scene, peers):
    """Starts a peer that sends datagrams only to `peers`."""
    path = setup.folder / f"scenes/cloud_{host}.toml"
    path.write_text(scene)
    return bed.peer(host, path, NAMES[host - 1], host, ("--to", peers))


def list_of(hosts):
    return ", ".join(f'"{Testbed.address(host)}"' for host in hosts)


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
        check(peers[0].wait_line("does not receive this one", 10), "who is in no list hears nobody, and nobody is told")
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


def scene_of_a_list(setup):
    """Three whose scene names them show one another; of a fourth, whose flag names one other, that alone hears. What is
    wrong with multicast, and the remedy, is told by `reckon doctor`."""
    with setup.testbed(4) as bed:
        drop_multicast(bed, 4)
        (setup.folder / "scenes/groups.toml").write_text(world())
        said = bed.system(1, f"{setup.reckon} doctor {setup.folder}/scenes/groups.toml --iface e0 || true")
        check("[network] peers" in said, f"doctor names no remedy: {said}")
        (setup.folder / "scenes/listed.toml").write_text(world(f"peers = [{list_of((1, 2, 3))}]\n"))
        said = bed.system(1, f"{setup.reckon} doctor {setup.folder}/scenes/listed.toml --iface e0")
        check("the list of 3 peers can be sent to; this host, 10.77.0.1:3000, is in it" in said, said)
        scene = setup.folder / "scenes/listed.toml"
        peers = [bed.peer(host, scene, NAMES[host - 1], host) for host in (1, 2, 3)]
        for host, peer in zip((1, 2, 3), peers):
            for other in {1, 2, 3} - {host}:
                check(peer.wait_event("appeared", 5, NAMES[other - 1]),
                      f"{NAMES[other - 1]} was never shown to {NAMES[host - 1]}; {peer.error_text()}")
        fourth = bed.peer(4, scene, "FOUR", 4, ("--to", Testbed.address(1)))
        check(fourth.wait_line("--to: the scene's 3 peers are ignored", 3, errors=True), fourth.error_text())
        check(peers[0].wait_event("appeared", 5, "FOUR"), f"FOUR is not heard; {peers[0].error_text()}")
        check(not peers[1].events("appeared")[2:], "what the flag leaves out was sent to")
        for peer in [fourth, *peers]:
            peer.report()


def run_accounted(setup, name, more, listed, sealed):
    """Runs four peers that join, lose datagrams, are suspended and leave: each datagram is accounted for."""
    (setup.folder / "scenes/cloud.key").write_text("group cloud\nsuite aes-256-gcm\nepoch 1 secret " + "5a" * 32 + "\n")
    (setup.folder / "scenes/cloud.key").chmod(0o600)
    more += "offload = false\n" + ('key = "cloud.key"\n' if sealed else "")
    loss = '[impairment]\nloss = "10 %"\nduplicate = "5 %"\ndelay = "5 ms"\njitter = "4 ms"\n'
    with setup.testbed(4) as bed:
        wire = wire_balance.Wire(bed.switch_socket())
        told, peers = [], []

        def begin(host, text):
            path = setup.folder / f"scenes/{name}_{host}.toml"
            path.write_text(text)
            peers.append(bed.peer(host, path, NAMES[host - 1], host, ("--balance", "1s")))
            told.append(wire_balance.Told(host))

        def end(index):
            told[index].asked_s = time.monotonic()
            peers[index].interrupt()
            check(peers[index].wait() == 0, peers[index].error_text())
            told[index].end_s = time.monotonic()
        for host in (1, 2, 3):
            begin(host, world(more, radius=35) + (loss if host == 3 else ""))
        check(peers[0].wait_event("appeared", 8, "TWO"), f"TWO was never shown; {peers[0].error_text()}")
        begin(4, world(more, radius=35))
        time.sleep(3)
        peers[1].signal(signal.SIGSTOP)
        time.sleep(1.5)
        peers[1].signal(signal.SIGCONT)
        time.sleep(2)
        for index in (3, 0, 1, 2):
            end(index)
        time.sleep(1)
        wire.stop()
        check(wire.problem is None, wire.problem)
        balance = wire_balance.Balance(wire, listed=Testbed.address if listed else None, sealed=sealed)
        for peer, life in zip(peers, told):
            for _, text in peer.lines:
                if '"event":"balance"' in text or '"datagrams_lost"' in text:
                    life.take(json.loads(text))
            check(life.ended, f"host {life.host} ended without a last word")
            balance.check(life)
        sums = balance.sums
        print(f"  {name}: " + ", ".join(f"{key} {count}" for key, count in sorted(sums.items()) if count))
        for sentence in balance.findings[:20]:
            print("    " + sentence)
        check(not balance.findings, f"{name}: {len(balance.findings)} balances are off")
        check(sums["delivered"] > 100 and sums["lost_by_law"] > 0, "nothing was shown")
        if listed:
            check(sums["copied_to_list"] > 0 and sums["not_listened"] > 0, "no copies, or nothing that is not listened to")
        if sealed:
            check(sums["opened"] > 0 and sums["greeting"] > 0 and sums["held"] > 0, "nothing was sealed")


def accounted(setup):
    """The books balance where datagrams go to a list, where they are sealed, and where both."""
    for name, listed, sealed in (("list", True, False), ("sealed", False, True), ("sealed_list", True, True)):
        run_accounted(setup, name, f"peers = [{list_of((1, 2, 3, 4))}]\n" if listed else "", listed, sealed)


CASES = {case.__name__: case for case in (hosts_of_a_list, scene_of_a_list, plain_dis, impaired_and_sealed, accounted)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
