# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The interface of a host disappears and returns, with the same or with another identity."""
import subprocess
import time

from kit import case, check, pair, sends_after, wait_told

GROUP_PORTS = ("0BB8", "0BB9")  # 3000, and 3001 where it is sealed


@case("F6", "NIC down for 1 s", "back under 1.5 s after it is up, told twice")
def nic_down(setup):
    with setup.testbed(2) as bed:
        sniffer = bed.sniff()
        alice, _ = pair(bed, setup)
        begun = alice.seconds()
        bed.ip(1, "link", "set", "e0", "down")
        wait_told(alice, "is down", 3, begun)
        time.sleep(1)
        up = time.monotonic()
        back = alice.seconds()
        bed.ip(1, "link", "set", "e0", "up")
        sent = sends_after(sniffer, 1, up)
        joined = wait_told(alice, "joined again", 5, back) - back
        time.sleep(1)
        report = alice.report()
        check(max(sent, joined) < 1.5, f"sent after {sent:.2f} s, joined after {joined:.2f} s")
        check(report["link"]["interface_losses"] == 1, "not one loss was counted")
        return f"sends after {sent:.2f} s, joined after {joined:.2f} s"


@case("F7", "NIC removed, and another put in its place 8 s later", "heard and hearing under 3 s")
def nic_replaced(setup, more=()):
    with setup.testbed(2) as bed:
        sniffer = bed.sniff()
        alice, bob = pair(bed, setup, more=more)
        before = set(local_ports(bed, 1))
        gone = alice.seconds()
        bed.unplug(1)
        wait_told(alice, "is gone", 3, gone)
        check(alice.wait_event("gone", 15, "BOB", gone), "the peer that is cut off was never dropped")
        check(bob.wait_event("gone", 15, "ALICE"), "the peer without a NIC was never dropped")
        plugged, heard_from = time.monotonic(), alice.seconds()
        seen_from = bob.seconds()
        bed.plug(1)
        sent = sends_after(sniffer, 1, plugged)
        heard = alice.wait_event("appeared", 6, "BOB", heard_from)
        seen = bob.wait_event("appeared", 6, "ALICE", seen_from)
        check(heard and seen, f"not seen again: {alice.error_text()}")
        heard, seen = heard[0] - heard_from, seen[0] - seen_from
        check(max(heard, seen, sent) < 3, f"hears after {heard:.2f} s, is heard after {seen:.2f} s")
        check(before & set(local_ports(bed, 1)), "the own port is another one")
        return f"sends after {sent:.2f} s, hears after {heard:.2f} s, is shown after {seen:.2f} s"


@case("F7c", "as F7 in a sealed exercise", "heard and hearing under 3 s")
def sealed_nic_replaced(setup):
    key = str(setup.folder / "exercise.key")
    subprocess.run([setup.reckon, "key", "new", key], check=True, capture_output=True)
    return nic_replaced(setup, ["--key", key])


@case("F7a", "address of the NIC changed", "heard under 3 s from the new address and the old port, accepted 2 s after its first datagram")
def address_changed(setup):
    with setup.testbed(2) as bed:
        sniffer = bed.sniff()
        alice, bob = pair(bed, setup)
        ports = set(local_ports(bed, 1))
        changed, since, bobs = time.monotonic(), alice.seconds(), bob.seconds()
        bed.ip(1, "addr", "delete", "10.77.0.1/24", "dev", "e0")
        bed.ip(1, "addr", "add", "10.77.0.99/24", "dev", "e0")
        sent = sends_after(sniffer, 1, changed, address="10.77.0.99")
        believed = wait_told(bob, "moved to 10.77.0.99:", 3, bobs) - bobs - sent
        wait_told(alice, "10.77.0.99", 3, since)
        check(ports & set(local_ports(bed, 1)), "the own port is another one")
        time.sleep(4)
        check(not bob.events("gone"), "the peer was dropped because its address changed")
        check(not alice.events("gone"), "the peer lost the other because its own address changed")
        check(sent < 3, f"sent after {sent:.2f} s")
        check(believed < 2.3, f"accepted {believed:.2f} s after its first datagram from there")  # messages wait 0.3 s
        return f"sends after {sent:.2f} s, is accepted after {believed:.2f} s more, none was dropped"


@case("F7b", "cable pulled (no carrier) for 2 s", "told, and told when it is back")
def cable(setup):
    with setup.testbed(2) as bed:
        alice, _ = pair(bed, setup)
        begun = alice.seconds()
        bed.pull(1)
        out = wait_told(alice, "has no carrier", 3, begun) - begun
        time.sleep(2)
        begun = alice.seconds()
        bed.pull(1, back=True)
        back = wait_told(alice, "joined again", 3, begun) - begun
        return f"told after {out:.2f} s, mended after {back:.2f} s"


def pair_ipv6(bed, setup):
    """A pair in a scene of IPv6 groups, at fd77::1 and fd77::2."""
    for host in (1, 2):
        bed.ip(host, "-6", "addr", "add", f"fd77::{host}/64", "dev", "e0", "nodad")
    return pair(bed, setup, scene=setup.changed_scene("ipv6", "[hand]", '[network]\ngroup = "ff15::c0:100"\n\n[hand]'))


@case("F7d", "IPv6: address of the NIC changed, as the kernel does with a try whether it is free", "told under 5 s, old port, nobody dropped")
def address_changed_ipv6(setup):
    with setup.testbed(2) as bed:
        alice, bob = pair_ipv6(bed, setup)
        ports = set(local_ports(bed, 1, "udp6"))
        since = alice.seconds()
        bed.ip(1, "-6", "addr", "delete", "fd77::1/64", "dev", "e0")
        bed.ip(1, "-6", "addr", "add", "fd77::99/64", "dev", "e0")
        told_after = wait_told(alice, "with fd77::99, works again", 8, since) - since
        check(ports & set(local_ports(bed, 1, "udp6")), "the own port is another one")
        time.sleep(8)  # longer than the time-out of a silent peer
        check(not bob.events("gone"), "the peer was dropped because its address changed")
        check(not alice.events("gone"), "the peer lost the other because its own address changed")
        check(told_after < 5, f"taken after {told_after:.2f} s")
        return f"taken after {told_after:.2f} s, none was dropped in 8 s"


@case("F7e", "IPv6: NIC removed, and another put in its place 8 s later", "heard and hearing under 5 s (2 s of them whether the address is free)")
def nic_replaced_ipv6(setup):
    with setup.testbed(2) as bed:
        alice, bob = pair_ipv6(bed, setup)
        before = set(local_ports(bed, 1, "udp6"))
        bed.unplug(1)
        gone = alice.seconds()
        wait_told(alice, "is gone", 3, gone)
        check(alice.wait_event("gone", 15, "BOB", gone), "the peer that is cut off was never dropped")
        check(bob.wait_event("gone", 15, "ALICE"), "the peer without a NIC was never dropped")
        heard_from, seen_from = alice.seconds(), bob.seconds()
        bed.plug(1)
        bed.ip(1, "-6", "addr", "add", "fd77::1/64", "dev", "e0")
        heard = alice.wait_event("appeared", 10, "BOB", heard_from)
        seen = bob.wait_event("appeared", 10, "ALICE", seen_from)
        check(heard and seen, f"not seen again: {alice.error_text()}")
        heard, seen = heard[0] - heard_from, seen[0] - seen_from
        check(max(heard, seen) < 5, f"hears after {heard:.2f} s, is shown after {seen:.2f} s")
        check(before & set(local_ports(bed, 1, "udp6")), "the own port is another one")
        return f"hears after {heard:.2f} s, is shown after {seen:.2f} s"


def local_ports(bed, host, family="udp"):
    """Ports of the unicast sockets of the programs in a host."""
    text = subprocess.run(["ip", "netns", "exec", bed.namespace(host), "cat", f"/proc/net/{family}"],
                          capture_output=True, text=True, check=True).stdout
    return [int(line.split()[1].split(":")[1], 16) for line in text.splitlines()[1:]
            if line.split()[1].split(":")[1] not in GROUP_PORTS]
