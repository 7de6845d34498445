# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Peers without the scene file, each in a network namespace of its own: `reckon peer --join`. One case per call, with
the arguments of namespaces.py."""
import json
import random
import re
import subprocess
import sys
import time

import testbed
from namespaces import run
from testbed import PeerProgram, check

IN_WITHIN = 1.5   # [s] after its start until a peer without the scene shows the other hand; measured 0.4 to 0.6
MESH = 10 << 20   # [octets]
PORTS = "{3000, 3002}"
RECEIVED = r"received (\S+) \((\d+) files, ([\d.]+) MB; ([\d.]+) MB over the network\) from peer (\S+) at (\S+) in ([\d.]+) s: (.*)"


def joiner(setup, bed, host, name, operator, more=()):
    """Starts a peer without a scene, with the cache folder of its host."""
    command = ["env", f"XDG_CACHE_HOME={setup.folder}/cache_{host}", setup.reckon, "peer", "--join", "--iface", "e0",
               "--name", name, "--operator", str(operator), "--events", "--felt", "--json", *more]
    return bed.run(host, command, PeerProgram)


def received(peer, within):
    """What the peer said of the scene that it got."""
    line = peer.wait_line(RECEIVED, within, errors=True)
    check(line, f"no scene: {peer.error_text()}")
    print(f"  {line[1]}")
    return re.search(RECEIVED, line[1])


def felt(peer, within):
    """When its hand first felt another one [s]."""
    end = time.monotonic() + within
    while time.monotonic() < end:
        for when, text in list(peer.lines):
            line = json.loads(text)
            if line.get("event") == "felt" and any(force > 0.05 for force in line["force_n"].values()):
                return when
        time.sleep(0.02)
    check(False, f"nothing was felt: {[text for _, text in peer.lines][-3:]}, {peer.error_text()}")


def refused(setup, bed, host, words, status, more=()):
    """A joiner that ends by itself."""
    peer = joiner(setup, bed, host, "CAROL", 2, more)
    got = peer.wait(20)
    check(got == status and words in peer.error_text(), f"status {got}, not {status} with '{words}': {peer.error_text()}")


def join(setup):
    """A host with an empty folder is in the exercise within 1.5 s, and touches the mesh and the other hand as soon as its
    trace leads there, 2.9 s after it joined. Its files equal the player's; the second time nothing is fetched. It offers
    the scene too, when the first player has gone."""
    with setup.testbed(3) as bed:
        refused(setup, bed, 3, "no peer offers a scene on 239.192.1.0:3000 within 3 s", 3)
        alice = bed.peer(1, setup.scene, "ALICE", 1)
        check(alice.wait_line('"event":"notice"', 1) is None, f"a notice: {alice.lines}")
        bob = joiner(setup, bed, 2, "BOB", 2, ("--exercise", "1"))
        files = received(bob, 5)
        shown = bob.wait_event("appeared", 5, "ALICE")
        check(shown and shown[0] <= IN_WITHIN, f"in the exercise only after {shown} s")
        print(f"  in the exercise {shown[0]:.2f} s after its start; feels the other hand after {felt(bob, 10):.2f} s")
        folder = files[8].rsplit("/", 1)[0]
        for name in ("two_hands.toml", "touchstone.obj", "hand_trace.csv", "hand_trace_2.csv"):
            done = subprocess.run(["cmp", f"{folder}/{name}", setup.folder / "scenes" / name], capture_output=True)
            check(done.returncode == 0, f"{name} differs")
        bob.report()
        bob = joiner(setup, bed, 2, "BOB", 2)
        check(received(bob, 5)[4] == "0.0", "what is in the cache is fetched again")
        alice.report()
        refused(setup, bed, 3, "no peer offers a scene", 3, ("--exercise", "9"))
        carol = joiner(setup, bed, 3, "CAROL", 1)
        check(received(carol, 5)[6] == bed.address(2), "not from the second player")
        check(carol.wait_event("appeared", 5, "BOB"), carol.error_text())
        carol.report()
        bob.report()


def join_sealed(setup):
    """With a key: only a host that has it gets the scene."""
    key, other = (setup.folder / name for name in ("one.key", "other.key"))
    for file in (key, other):
        subprocess.run([setup.reckon, "key", "new", file], check=True, capture_output=True)
    with setup.testbed(3) as bed:
        alice = bed.peer(1, setup.scene, "ALICE", 1, ("--key", str(key)))
        check(alice.wait_line(".", 5, errors=True), "does not start")
        time.sleep(1)
        bob = joiner(setup, bed, 2, "BOB", 2, ("--key", str(key)))
        received(bob, 5)
        check(bob.wait_event("appeared", 5, "ALICE"), bob.error_text())
        refused(setup, bed, 3, "or its key (--key)", 3)
        refused(setup, bed, 3, "no peer offers a scene", 3, ("--key", str(other)))
        alice.report()
        bob.report()


def big_scene(setup):
    """The scene with a mesh of 10 MiB, most of it comments."""
    source = (setup.folder / "scenes/touchstone.obj").read_text()
    draw = random.Random(1)
    with open(setup.folder / "scenes/big.obj", "w") as file:
        file.write(source)
        while file.tell() < MESH:
            file.write(f"# {draw.getrandbits(4000):x}\n")
    return setup.changed_scene("big", 'mesh = "touchstone.obj"', 'mesh = "big.obj"')


def join_lossy(setup):
    """A mesh of 10 MiB at 20 % loss, for two hosts, one of which is killed on the way and starts again."""
    scene = big_scene(setup)
    with setup.testbed(3) as bed:
        for host in (2, 3):
            bed.lose(host, 5, PORTS)
        alice = bed.peer(1, scene, "ALICE", 1)
        time.sleep(2)
        bob, carol = joiner(setup, bed, 2, "BOB", 2), joiner(setup, bed, 3, "CAROL", 1)
        time.sleep(1.2)
        bob.kill()
        bob = joiner(setup, bed, 2, "BOB", 2)
        print(f"  {received(carol, 15)[7]} s for the one that goes on, {received(bob, 15)[7]} s for the other after its second start")
        for name in ("2", "3"):
            found = subprocess.run(f"cmp {setup.folder}/cache_{name}/reckon/scenes/*/big.obj {setup.folder}/scenes/big.obj", shell=True, capture_output=True)
            check(found.returncode == 0, f"host {name}: another mesh")
        for peer in (alice, bob, carol):
            peer.kill()


def join_two_scenes(setup):
    """Where two scenes are played, both are named."""
    other = setup.changed_scene("other", "[hand]", "[hand]", '\n[aoim]\ncell = "3 m"\n')
    with setup.testbed(3) as bed:
        players = [bed.peer(1, setup.scene, "ALICE", 1), bed.peer(2, other, "BOB", 1)]
        time.sleep(2)
        refused(setup, bed, 3, "2 scenes are played", 2)
        refused(setup, bed, 3, f"{other.name} of peer", 2)
        for peer in players:
            peer.report()


CASES = {case.__name__: case for case in (join, join_sealed, join_lossy, join_two_scenes)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
