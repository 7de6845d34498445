# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Peers that are killed and peers that flood, each in a network namespace of its own: the forces and entities that
the others get from them. One case per call, with the arguments of namespaces.py."""
import json
import math
import shutil
import statistics
import sys
import time

import testbed
from namespaces import BASE_GROUP, PORT, run
from testbed import Program, Skip, Testbed, check

PICTURE = 0.05             # [s], between two pictures of a peer
FELT_FOR = 0.75            # [s], after the last datagram of a dead peer in contact
PRESENCE_TIMEOUT = 6.1     # [s]
SLACK = 0.25               # [s], for a busy machine
ROUNDING = 1e-9            # [J], of the ledgers
SPEED = 0.32               # [m/s], greatest speed of the sweep below

SCENE = """
[scene]
name = "silence"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"
k1 = "300 N/m"
"""
GRIP = SCENE + """
[[operator]]
sweep = {from = "-20 0 0 mm", to = "0 0 0 mm", period = "8 s"}

[[operator]]
passive = true
position = "10 0 0 mm"
stiffness = "150 N/m"
"""
STILL = """
[[operator]]
passive = true
position = "{} 0 0 mm"
stiffness = "150 N/m"
"""
SWEEP = SCENE + """
[[operator]]
sweep = {from = "-100 0 0 mm", to = "100 0 0 mm", period = "2 s"}

[[operator]]
passive = true
position = "0 1 0 m"
stiffness = "150 N/m"
"""


class Feeler(Program):
    """The program that prints the forces on its hand."""

    def samples(self, since=0.0):
        """Its pictures received after `since`, in seconds since its start; without partial lines."""
        return [dict(json.loads(text), at=when) for when, text in list(self.lines)
                if when >= since and text.startswith('{"seconds"')]

    def notices(self):
        return [json.loads(text)["notice"] for _, text in list(self.lines) if '"notice"' in text]

    def finish(self):
        """Waits for its end; returns the losses of the link, and its counters."""
        check(self.wait(60) == 0, f"it ended badly: {self.error_text()}")
        return json.loads(self.lines[-2][1]), json.loads(self.lines[-1][1])


def feeler(bed, setup, host, scene, name, seconds):
    path = setup.folder / f"{name}.toml"  # a separate file: others may still be reading theirs
    path.write_text(scene)
    return bed.run(host, [setup.feeler, str(path), "e0", str(host), name, str(seconds)], Feeler)


def wait_for(what, condition, timeout):
    end = time.monotonic() + timeout
    while not condition():
        check(time.monotonic() < end, f"{what}: not within {timeout} s")
        time.sleep(0.005)


def last_word(sniffer, host):
    return max(when for when, source, _, _ in list(sniffer.datagrams) if source == Testbed.address(host))


def killed_in_contact(setup):
    """kill -9 of a peer whose hand presses another: its force is gone 0.75 s after its last word, it is dropped after 6.1 s, a third
    loses nothing."""
    with setup.testbed(3) as bed:
        sniffer = bed.sniff()
        dead = feeler(bed, setup, 1, GRIP, "DEAD", 60)
        alive = feeler(bed, setup, 2, GRIP, "ALIVE", 20)
        third = feeler(bed, setup, 3, GRIP + STILL.format(500), "THIRD", 20)
        wait_for("a press", lambda: alive.samples() and alive.samples()[-1]["force"] > 0.4, 15)
        dead.kill()
        time.sleep(PRESENCE_TIMEOUT + 1)
        word = last_word(sniffer, 1) - alive.started
        after = alive.samples(word)
        # Each line is about a picture that is at most one picture and one check older.
        felt = max((s["at"] for s in after if s["force"] > 0), default=word) - word
        gone = next((s["at"] for s in after if s["entities"] < 2), math.inf) - word
        print(f"  felt for {felt:.2f} s after its last word, dropped after {gone:.2f} s; {alive.notices()}")
        check(felt <= FELT_FOR + PICTURE + SLACK, f"felt for {felt:.2f} s")
        check(abs(gone - PRESENCE_TIMEOUT) < PICTURE + SLACK, f"dropped after {gone:.2f} s")
        check(any("no longer felt" in n for n in alive.notices()), "it was not told")
        for peer in (alive, third):
            link, report = peer.finish()
            print(f"  {report['id']}: energy never below {report['energy_min_j']:.1e} J (late steps {report['late_cost_j']:.1e}), lost {report['datagrams_lost']}, "
                  f"kernel drops {link['kernel_drops']}")
            check(report["energy_min_j"] >= -ROUNDING - report["late_cost_j"], f"energy {report['energy_min_j']} J")
            check(report["datagrams_lost"] == 0 and link["kernel_drops"] == 0, "the others lost updates")


def killed_in_a_sweep(setup):
    """kill -9 of a peer whose hand is on its way: it is shown to come to rest within three seconds of its speed."""
    with setup.testbed(2) as bed:
        sniffer = bed.sniff()
        dead = feeler(bed, setup, 1, SWEEP, "DEAD", 60)
        alive = feeler(bed, setup, 2, SWEEP, "ALIVE", 20)
        wait_for("a sweep", lambda: alive.samples() and "place" in alive.samples()[-1], 10)
        time.sleep(3.2)
        dead.kill()
        time.sleep(PRESENCE_TIMEOUT - 0.5)
        word = last_word(sniffer, 1) - alive.started
        places = [s["place"] for s in alive.samples(word) if "place" in s]
        farthest = max(math.dist(places[0], place) for place in places)
        print(f"  shown {farthest:.3f} m beyond; {SPEED} m/s for 3 s are {3 * SPEED:.2f} m")
        check(farthest <= 3 * SPEED, f"shown {farthest:.2f} m beyond")
        check(places[-1] == places[-20], "it does not rest")


def flood(setup):
    """100,000 datagrams/s of junk, then of whole Entity States, while two hands press: the flooder is muted and told, the force
    stays, nothing of the genuine peers is lost at the ring."""
    with setup.testbed(3) as bed:
        grip = SCENE + STILL.format(0) + STILL.format(10)
        one = feeler(bed, setup, 1, grip, "ONE", 24)
        other = feeler(bed, setup, 2, grip, "OTHER", 24)
        wait_for("a press", lambda: other.samples() and other.samples()[-1]["force"] > 0.3, 10)
        time.sleep(2)
        forces = {}
        for kind in ("quiet", "junk", "states", "quiet again"):
            begun = other.seconds()
            if kind.startswith("quiet"):
                time.sleep(3)
            else:
                # A flooder on another machine would not be slowed by its effects on this one.
                first = ["chrt", "-f", "45"] if shutil.which("chrt") else []
                program = bed.run(3, [*first, setup.flood, Testbed.address(3), BASE_GROUP, str(PORT), "100000", "3", kind])
                program.wait()
                flooded = json.loads(program.lines[-1][1])
                print(f"  {kind}: {flooded['sent']} sent, {flooded['per_s']} a second")
                if flooded["per_s"] < 50_000:
                    raise Skip("this machine is too busy to flood")
            forces[kind] = statistics.mean(s["force"] for s in other.samples(begun + 0.2))
        print("  mean force: " + ", ".join(f"{kind} {force:.3f} N" for kind, force in forces.items()))
        for peer in (one, other):
            link, report = peer.finish()
            print(f"  {report['id']}: read {report['datagrams_in']}, muted {report['muted_in']}, refused "
                  f"{report['refused_version_in']}, waits {report['read_waits']}, lost {report['datagrams_lost']}, kernel drops "
                  f"{link['kernel_drops']}, servo late p99 {report['servo_late_us']}")
            print(f"  {[n for n in peer.notices() if Testbed.address(3) in n]}")
            check(report["read_waits"] == 0, "the ring was full")
            check(any("too many datagrams" in n and Testbed.address(3) in n for n in peer.notices()), "it was not told")
            check(any("read again" in n for n in peer.notices()), "its end was not told")
        for kind in ("junk", "states"):
            even = (forces["quiet"] + forces["quiet again"]) / 2
            check(abs(forces[kind] - even) <= 0.05 * even + abs(forces["quiet again"] - forces["quiet"]),
                  f"{forces[kind]} N of {even} N")


CASES = {case.__name__: case for case in (killed_in_contact, killed_in_a_sweep, flood)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
