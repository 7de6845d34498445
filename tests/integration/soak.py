# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Two peers in contact for long, between network namespaces, that send some 80 datagrams a second and
lose 5 % of what they hear: memory that stands still, and counters of one that are those of the other.
  soak.py --reckon PROGRAM --scenes FOLDER [--minutes N]"""
import argparse
import pathlib
import shutil
import sys
import time

import memory
import testbed
from testbed import Testbed, check

LOSS = '\n[impairment]\nloss = "5 %"\nseed = {}\n'
FINE = {'position = "0.5 mm"': 'position = "5 um"', 'force = "0.015 N"': 'force = "1 mN"'}  # so that more is sent
SETTLED = 240.0 # [s] until the rings of datagrams, 2 MiB each, have been filled once
GROWTH = 256    # [KiB], greatest growth of resident memory after that, in a run at least twice as long
EDGE = 1.0      # [s] of datagrams that may be sent before the other listens or after it left
UNSEEN = 4      # lost datagrams without a later one that would reveal the gap
NEVER = ("kernel_drops", "receive_errors", "send_errors", "truncated", "too_big", "queue_overflows", "join_errors")


def compare(name, one, other):
    """Compares the datagrams that `one` received with those that `other` sent; returns a line for people."""
    said, heard = other["link"]["sent"], one["link"]["received"]
    lost, by_law = one["datagrams_lost"], one["link"]["lost_by_law"]
    for counter in NEVER:
        check(one["link"][counter] == 0, f"{name}: {counter} {one['link'][counter]}, not 0")
    check(one["write_overflow"] == 0, f"{name}: write_overflow {one['write_overflow']}, not 0")
    edge = EDGE * said / other["seconds"]
    check(abs(said - heard - by_law) <= edge, f"{name} received {heard} and lost {by_law} of {said} datagrams")
    check(0 <= by_law - lost <= UNSEEN, f"{name} counts {lost} lost datagrams of {by_law}")
    return f"{name}: of {said} datagrams {heard} received, {by_law} lost; {lost} of these counted"


def run(arguments, folder):
    folder = pathlib.Path(folder)
    folder.chmod(0o755)
    program = testbed.copied_program(arguments.reckon, folder)
    shutil.copytree(arguments.scenes, folder / "scenes")
    text = (folder / "scenes/two_hands.toml").read_text()
    for usual, fine in FINE.items():
        check(text.count(usual) == 1, f"'{usual}' is not once in the scene")
        text = text.replace(usual, fine)
    with Testbed(2, program) as bed:
        peers = []
        for host, name in ((1, "ALICE"), (2, "BOB")):
            scene = folder / f"scenes/soak_{host}.toml"
            scene.write_text(text + LOSS.format(host))
            peers.append(bed.peer(host, scene, name, host))
        for peer, other in zip(peers, ("BOB", "ALICE")):
            check(peer.wait_event("appeared", 10, other), f"{other} was never shown; {peer.error_text()}")
        begun, length = time.monotonic(), 60.0 * arguments.minutes
        samples = {"ALICE": [], "BOB": []}
        while (left := begun + length - time.monotonic()) > 0:
            time.sleep(min(10.0, left))
            for rows, peer in zip(samples.values(), peers):
                rows.append((time.monotonic() - begun, memory.resident(peer)))
        for peer in peers:
            peer.interrupt()  # both, before waiting for either: datagrams of a single peer are not received
        reports = [peer.report() for peer in peers]
        print(compare("ALICE", *reports))
        print(compare("BOB", *reversed(reports)))
        for name, rows in samples.items():
            memory.judge(name, rows, SETTLED if length >= 2 * SETTLED else None, GROWTH)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--scenes", required=True)
    parser.add_argument("--minutes", type=float, default=20.0)
    arguments = parser.parse_args()
    return testbed.status_of(lambda folder: run(arguments, folder))


if __name__ == "__main__":
    sys.exit(main())
