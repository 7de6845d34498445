# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Three peers of the scene cubes on one host, the third with a page. The first, which owns the cubes, is killed. The
others own them within 5 s, and their hands push them. owners_viewed.py viewed --reckon PROGRAM --scenes FOLDER"""
import argparse
import json
import math
import pathlib
import re
import sys
import tempfile
import time
import urllib.request

import testbed
from testbed import PeerProgram, Program, check

CUBES = 6
TOGETHER = 4.0  # [s] until all three vote
ADOPTED = 5.0   # [s], greatest time from the kill to the adoption
PUSHED = 15.0   # [s], greatest time from the adoption to the push
FAR = 0.005     # [m], least motion of a pushed cube
# Each survivor has a hand that crosses the box, and reaches the cubes 9 s after its start.
HANDS = """
[[operator]]
sweep = {from = "105 -60 25 mm", to = "-105 60 25 mm", period = "30 s"}
""" + "".join(f"\n[[device]]\npeer = {peer}\noperator = 3\n" for peer in (2, 3))


class Wire(Program):
    """`reckon inspect`: owners and places of the cubes."""

    def cubes(self, since):
        """{cube: [(epoch of its owner, place [m])]}, by the states from `since` on [s after the start of this program]."""
        found, place = {}, {}
        for when, text in list(self.lines):
            row = json.loads(text)
            if when < since or not row.get("id", "").startswith("65534:"):
                continue
            if row["type"] == "entity_state":
                place[row["id"]] = row["location"]
            elif "ownership" in row and row["id"] in place:
                found.setdefault(row["id"], []).append((row["ownership"][0]["owner"], place[row["id"]]))
        return found


def page_of(peer):
    line = peer.wait_line(r"http://127", 10, errors=True)
    check(line, f"no page: {peer.error_text()}")
    address = re.search(r"http://\S+", line[1])[0].split("#")[0]
    with urllib.request.urlopen(address, timeout=5) as page:
        return page.status


def wait_for(holds, seconds, sentence):
    end = time.monotonic() + seconds
    while not holds():
        check(time.monotonic() < end, sentence())
        time.sleep(0.2)


def moved(states):
    return max((math.dist(states[0][1], place) for _, place in states), default=0.0)


def viewed(setup):
    """Three peers, the third with a page; the first is killed, and the world goes on."""
    scene = setup.folder / "cubes.toml"
    text = (setup.scenes / "cubes.toml").read_text()
    scene.write_text(text[:text.rindex("[[device]]")] + HANDS)  # the first hand is the only one of the first peer
    programs = [Wire([setup.reckon, "inspect", "--iface", "lo", "--json"])]
    try:
        wire, peers = programs[0], []
        time.sleep(1)  # `inspect` joins before the first states are sent
        for number in (1, 2, 3):
            words = [setup.reckon, "peer", scene, "--iface", "lo", "--operator", number, "--name", f"P{number}", "--events", "--json"]
            peers.append(PeerProgram([*map(str, words), *(["--view=0"] if number == 3 else [])]))
            programs.append(peers[-1])
            time.sleep(1)
        time.sleep(TOGETHER)
        before = {states[-1][0] for states in wire.cubes(0).values()}
        check(len(before) == 1 and len(wire.cubes(0)) == CUBES, f"the cubes have the owners {before}")
        check(page_of(peers[2]) == 200, "the page does not answer")
        peers[0].kill()
        killed, since = time.monotonic(), wire.seconds()
        wait_for(lambda: any("bodies-adopted" in text for peer in peers[1:] for _, text in list(peer.lines)), ADOPTED,
                 lambda: f"nobody says that it adopts them: {peers[1].error_text()}; {peers[2].error_text()}")
        adopted, seen = time.monotonic() - killed, wire.seconds()
        wait_for(lambda: any(moved(states) > FAR for states in wire.cubes(seen).values()), PUSHED,
                 lambda: f"the cubes moved {[round(moved(s), 4) for s in wire.cubes(seen).values()]} m")
        after = {owner for states in wire.cubes(seen).values() for owner, _ in states}
        print(f"  adopted after {adopted:.2f} s; owner before {before}, then {after}; a cube moved "
              f"{1e3 * max(map(moved, wire.cubes(seen).values())):.1f} mm after {time.monotonic() - killed:.1f} s")
        check(after and not after & before, f"owners before {before}, after the kill {after}")
        check(not any(owner in before for states in wire.cubes(since + 0.5).values() for owner, _ in states), "the dead one sends")
        check(page_of(peers[2]) == 200, "the page does not answer any more")
        peers[1].interrupt()
        for report in (peers[2].report(), peers[1].report()):
            print(f"  {report['id']}: adopted {report['bodies_adopted']}, granted {report['bodies_granted']}, refused "
                  f"{report['ownership_refused']}, stale {report['bodies_stale']}, disputed {report['bodies_disputed']}")
    finally:
        for program in programs:
            program.end()


CASES = {"viewed": viewed}


def run(case):
    parser = argparse.ArgumentParser()
    parser.add_argument("case")
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--scenes", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    print(case.__doc__)
    with tempfile.TemporaryDirectory(prefix="reckon_") as folder:
        arguments.folder = pathlib.Path(folder)
        case(arguments)


if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
