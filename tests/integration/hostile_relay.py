# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A relay: a third host sends the announcements of a quiet peer again from its own address, and its states with an
offset of 50 m, while datagrams of the peer are lost at a receiver. Its Entity States are not lost: for a quiet entity
two lost heartbeats in a row are a time-out without any attack. A seed draws loss and delay."""
import random
import struct
import time

import dis_wire as dis
from hostile_attacks import ALICE, BOB, now_stamp, patched
from namespaces import PORT
from testbed import Testbed, check

MALLORY = 3
QUIET = 4.0      # [s] before the attack
ATTACKED = 30.0  # [s]
SCENE = """
[scene]
name = "relay"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"

[[operator]]
sweep = {from = "0 0 0 mm", to = "100 0 0 mm", period = "2 s"}

[[operator]]
sweep = {from = "500 0 0 mm", to = "500.001 0 0 mm", period = "9 s"}
"""


def off(state):
    """The same Entity State with an offset of 50 m and a later time."""
    x, y, z = struct.unpack_from(">ddd", state, 48)
    return patched(state, (4, ">I", now_stamp()), (48, ">ddd", x + 29, y + 29, z + 29))


def relay(bed, sniffer, delay, end):
    """Relays the datagrams of host BOB. @return number of relayed announcements"""
    sender, done, count = bed.multicast_sender(MALLORY), len(sniffer.datagrams), 0
    while time.monotonic() < end:
        new = list(sniffer.datagrams)[done:]
        done += len(new)
        time.sleep(delay)
        for _, source, group, payload in new:
            if source != Testbed.address(BOB):
                continue
            kinds = dict(dis.pdus(payload))
            if dis.ENTITY_STATE in kinds:
                payload = off(payload)
            sender.sendto(payload, (group, PORT))
            count += 140 in kinds
    return count


def attack(setup, seed):
    draw = random.Random(f"relay {seed}")
    loss, delay = draw.randrange(1, 31), draw.choice((0.0002, 0.001, 0.005))
    scene = setup.folder / "scenes/relay.toml"
    scene.write_text(SCENE)
    with setup.testbed(MALLORY) as bed:
        sniffer = bed.sniff()
        alice, bob = (bed.peer(host, scene, name, host) for host, name in ((ALICE, "ALICE"), (BOB, "BOB")))
        check(alice.wait_event("appeared", 5, "BOB"), f"BOB was never shown; {alice.error_text()}")
        time.sleep(QUIET)
        no_state = f"@th,80,8 != {dis.ENTITY_STATE}"  # the type of the first PDU, after 8 octets of UDP
        bed.firewall(ALICE, "input", f"ip saddr {Testbed.address(BOB)} udp dport {PORT} {no_state} numgen random mod 100 < {loss} drop")
        count = relay(bed, sniffer, delay, time.monotonic() + ATTACKED)
        told = [event["text"] for event in alice.events("notice")]
        gone = [event["id"] for event in alice.events("gone")]
        bob.interrupt()
        alice.interrupt()
    moved = [text for text in told if " moved to " in text]
    wrong = [text for text in told if text.startswith(Testbed.address(BOB)) and "uses the identity" in text]
    right = [text for text in told if text.startswith(Testbed.address(MALLORY))]
    print(f"| {seed} | {loss} % | {1e3 * delay:g} ms | {count} | {len(moved)} | {'; '.join(right) or 'nothing'} |", flush=True)
    return moved + wrong + gone + ([] if right else ["the relay was not reported"])


def hostile_relay(setup):
    """Relays of a quiet peer whose loss and delay a seed draws: its identity never moves, and the relay is reported."""
    first = random.randrange(10**6) if setup.seed is None else setup.seed
    print("| seed | loss | delay | announcements sent again | moves | reported |\n|---:|---:|---:|---:|---:|---|", flush=True)
    problems = [f"{seed}: {problem}" for seed in range(first, first + setup.runs) for problem in attack(setup, seed)]
    check(not problems, "; ".join(problems))
