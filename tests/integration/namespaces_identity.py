# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Identities of peers as users run them: many started at one instant, numbers from a scene, a restart, a suspended
peer, a link cut in one direction. One case per call, with the arguments of namespaces.py."""
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time

import testbed
from namespaces import SLACK, run
from testbed import Testbed, check, ip

PRESENCE = 140
SEALED = 0xE7  # first octet
CONVERGED = 2.0  # [s], acceptance limit: all distinct and mutually visible after the last start


def announcements(sniffer):
    """(time, epoch, id, leaving) of each Presence received."""
    for when, _, _, kind, octets in sniffer.pdus():
        if kind == PRESENCE:
            site, application, epoch = struct.unpack_from(">HHI", octets, 12)
            yield when, epoch, f"{site}:{application}", bool(struct.unpack_from(">H", octets, 58)[0] & 2)


def eight_at_once(setup):
    """Eight peers with hands start in one instant on one host: distinct within 2 s, and nobody moves after that."""
    with setup.testbed(1) as bed:
        sniffer = bed.sniff()
        scene = setup.scene_of(8)
        peers = [bed.peer(1, scene, f"P{i}", i) for i in range(1, 9)]
        time.sleep(12)
        first, last = {}, {}
        for when, epoch, own, _ in announcements(sniffer):
            first.setdefault(epoch, when)
            if last.get(epoch, (None, None))[1] != own:
                last[epoch] = (when, own)
        seen = [len({e["marking"] for e in peer.events("appeared")}) for peer in peers]
        settled = max(when for when, _ in last.values()) - max(first.values())
        print(f"  {len(first)} peers, ids {sorted(own for _, own in last.values())}, the last taken "
              f"{settled:.2f} s after the last start; others' hands seen {seen}")
        check(seen == [7] * 8, f"hands seen: {seen}")
        check(len(first) == 8, f"{len(first)} epochs")
        check(len({own for _, own in last.values()}) == 8, "two hold one id")
        check(settled < CONVERGED, f"an id changed {settled:.2f} s after the last start")
        buried = [text for p in peers for _, text in p.errors if "silent" in text or "restarted" in text]
        check(not buried, f"the living were buried: {buried}")


def number_of(peer):
    told = peer.wait_line(r"this is peer \d+ of the scene", 10, errors=True)
    check(told, f"the number was never told: {peer.error_text()}")
    return int(re.search(r"this is peer (\d+)", told[1])[1])


def plain_peer(bed, host, setup, name, *more):
    """Starts a peer with the README's own command, which names no operator."""
    return bed.run(host, [setup.reckon, "peer", str(setup.scene), "--iface", "e0", "--name", name,
                          "--events", "--json", *more], testbed.PeerProgram)


def operators(setup):
    """Two hosts in one instant get different hands, a third and one with a number of its own too."""
    with setup.testbed(3) as bed:
        for _ in range(3):
            peers = [plain_peer(bed, host, setup, name) for host, name in ((1, "ALICE"), (2, "BOB"))]
            numbers = [number_of(peer) for peer in peers]
            check(sorted(numbers) == [1, 2], f"numbers {numbers}")
            third = plain_peer(bed, 3, setup, "CAROL")
            numbers.append(number_of(third))
            check(numbers[2] == 3, f"numbers {numbers}")
            for peer, other in ((peers[0], "BOB"), (peers[1], "CAROL"), (third, "ALICE")):
                check(peer.wait_event("appeared", 5, other), f"{other} was never shown")
            print(f"  numbers {numbers}")
            for peer in (*peers, third):
                peer.interrupt()
            for peer in (*peers, third):
                peer.report()
        sniffer = bed.sniff()
        bed.peer(1, setup.scene, "ALICE", 1)
        end = time.monotonic() + 5
        while not list(announcements(sniffer)) and time.monotonic() < end:
            time.sleep(0.05)
        check(number_of(plain_peer(bed, 2, setup, "BOB")) == 2, "an explicit number was dealt again")


def sealed_operators(setup):
    """With a key hands are dealt out in sealed words, too: nothing plain is ever sent."""
    with setup.testbed(2) as bed, tempfile.TemporaryDirectory(prefix="reckon_") as folder:
        key = f"{folder}/exercise.key"
        subprocess.run([setup.reckon, "key", "new", key], check=True, capture_output=True)
        sniffer = bed.sniff()
        peers = [plain_peer(bed, host, setup, name, "--key", key) for host, name in ((1, "ALICE"), (2, "BOB"))]
        numbers = [number_of(peer) for peer in peers]
        check(sorted(numbers) == [1, 2], f"numbers {numbers}")
        check(peers[0].wait_event("appeared", 5, "BOB"), "BOB was never shown")
        said = [payload for _, _, _, payload in list(sniffer.datagrams)]
        plain = [payload for payload in said if payload[0] != SEALED]
        print(f"  numbers {numbers}, {len(said)} datagrams, {len(plain)} of them plain")
        check(len(said) > 20, "nothing was said")
        check(not plain, f"PDU types of plain datagrams: {sorted({payload[2] for payload in plain})}")


def restart(setup):
    """A peer that is killed and comes back within its time-out is seen within 1 s of its first announcement."""
    with setup.testbed(2) as bed:
        sniffer = bed.sniff()
        alice = bed.peer(1, setup.scene, "ALICE", 1)
        bob = bed.peer(2, setup.scene, "BOB", 2)
        for _ in range(4):
            check(alice.wait_event("appeared", 5, "BOB", max(0.0, bob.started - alice.started)),
                  "BOB was never shown")
            time.sleep(3)
            bob.kill()
            time.sleep(0.4)
            again = time.monotonic()
            bob = bed.peer(2, setup.scene, "BOB", 2)
            told = alice.wait_line("restarted", 5, again - alice.started, errors=True)
            check(told, f"the restart was not seen: {alice.error_text()}")
            begun = min(when for when, source, _, kind, _ in sniffer.pdus(Testbed.address(2), again)
                        if kind == PRESENCE)
            seen = told[0] + alice.started - begun
            print(f"  seen {seen:.2f} s after the first announcement")
            check(seen < 1.0 + 0.4, f"seen after {seen:.2f} s")  # messages are collected for 0.3 s


def sleeper(setup):
    """A peer that is stopped for 5 s says so, and calls nobody silent."""
    with setup.testbed(2) as bed:
        alice = bed.peer(1, setup.scene, "ALICE", 1)
        bob = bed.peer(2, setup.scene, "BOB", 2)
        check(alice.wait_event("appeared", 5, "BOB"), "BOB was never shown")
        time.sleep(3)
        alice.process.send_signal(signal.SIGSTOP)
        time.sleep(5)
        alice.process.send_signal(signal.SIGCONT)
        told = alice.wait_line("this peer was suspended for", 3, errors=True)
        check(told, f"the sleep was not told: {alice.error_text()}")
        time.sleep(2)
        blamed = [text for _, text in alice.errors if "silent" in text]
        print(f"  {told[1]}; {bob.error_text()}")
        check(not blamed, f"others were blamed: {blamed}")


def one_way(setup):
    """Host 2 hears nothing of host 1: both say so within 3 s, and again when it is over."""
    with setup.testbed(2) as bed:
        alice = bed.peer(1, setup.scene, "ALICE", 1)
        bob = bed.peer(2, setup.scene, "BOB", 2)
        check(alice.wait_event("appeared", 5, "BOB"), "BOB was never shown")
        time.sleep(5)
        cut = time.monotonic()
        # A datagram from an address without a return route is dropped.
        ip("netns", "exec", bed.namespace(2), "sysctl", "-qw", "net.ipv4.conf.all.rp_filter=1")
        ip("-n", bed.namespace(2), "route", "add", "blackhole", f"{Testbed.address(1)}/32")
        for peer, words in ((alice, "does not receive this one"), (bob, "was silent for")):
            told = peer.wait_line(words, 5, cut - peer.started, errors=True)
            check(told, f"'{words}' was not told: {peer.error_text()}")
            after = told[0] + peer.started - cut
            print(f"  '{told[1]}' after {after:.2f} s")
            check(after < 3.0 + 0.4 + SLACK / 2, f"told after {after:.2f} s")  # collected for 0.3 s
        healed = time.monotonic()
        ip("-n", bed.namespace(2), "route", "del", "blackhole", f"{Testbed.address(1)}/32")
        for peer in (alice, bob):
            told = peer.wait_line("receive each other again", 5, healed - peer.started, errors=True)
            check(told, f"the end of the cut was not told: {peer.error_text()}")


CASES = {case.__name__: case for case in (eight_at_once, operators, sealed_operators, restart, sleeper, one_way)}


if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
