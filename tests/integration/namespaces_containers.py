# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Peers in containers: namespaces on a bridge with a default route, without privileges, and with more than one
interface. One case per call, with the arguments of namespaces.py."""
import sys

import testbed
from namespaces import meet, run
from testbed import PeerProgram, check

# Rights that a container removes from a program that was started as a user in it.
NOBODY = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "--bounding-set=-all", "--inh-caps=-all", "--no-new-privs"]


def start(setup, bed, host, name, more=()):
    return bed.run(host, [*NOBODY, setup.reckon, "peer", str(setup.scene), "--name", name, "--operator", str(min(host, 2)), "--events",
                          "--json", *more], PeerProgram)


def add_interface(bed, host, name, address):
    """Connects this host to another network without other hosts."""
    bed.ip(host, "link", "add", name, "type", "veth", "peer", "name", f"{name}_end")
    bed.ip(host, "addr", "add", f"{address}/24", "dev", name)
    bed.ip(host, "link", "set", f"{name}_end", "up")
    bed.ip(host, "link", "set", name, "up")


def containers(setup):
    """Two as nobody, without capabilities, find each other by the interface that each chooses itself; one that is told
    the other of two finds nobody, and `doctor` lists both with the flag that chooses."""
    with setup.testbed(3) as bed:
        for host in (1, 2, 3):
            bed.ip(host, "route", "add", "default", "via", bed.address(host % 3 + 1))
            add_interface(bed, host, "e1", f"192.168.{host}.9")
        peers = [start(setup, bed, host, name) for host, name in ((1, "ALICE"), (2, "BOB"))]
        meet(*peers, ("ALICE", "BOB"))
        doctor = bed.run(1, [*NOBODY, setup.reckon, "doctor", str(setup.scene)])
        check(doctor.wait(30) == 0, doctor.error_text())
        said = "\n".join(text for _, text in doctor.errors + doctor.lines)
        for words in ("interface e0, by score (choose another with --iface)", "e1 (index", "e0 is virtual (bridge, tunnel, container)"):
            check(words in said, f"doctor does not say '{words}': {said}")
        elsewhere = start(setup, bed, 3, "CAROL", ("--iface", "e1"))
        check(elsewhere.wait_event("appeared", 3) is None, "a peer on another network was shown somebody")
        check(peers[0].wait_event("appeared", 0.1, "CAROL") is None, "a peer on another network is shown")


if __name__ == "__main__":
    sys.exit(testbed.main({"containers": containers}, run))
