# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Hands of two peers at one body. Each peer has a network namespace of its own, at a delay of 20 ms. The true forces are
those of a simulated run in which one peer has both hands. One case per call, with the arguments of namespaces.py."""
import itertools
import json
import math
import statistics
import sys
import time

import held_things
import testbed
from namespaces import run
from namespaces_silence import Feeler, wait_for
from owners_viewed import ADOPTED, Wire
from testbed import check

LATER = 1.3  # [s], about: peer 2 starts this long after peer 1, which then owns the body
SPEED = 0.05  # [m/s], of a pushing hand
SLOW, THICK = 0.005, 50  # [m/s], [N s/m], slow push after the kill, and drag of the body
DRAG = 20  # [N s/m], of the pushed body
STEADY = 0.02  # greatest error of the median force within a second, as a share of the true force
CURVE = 0.05  # greatest error of the force over time, as a share of the greatest true force
GONE = 1.5  # [s] from the last message of a peer until the force of its hand has ended
LEFT = 0.3  # [N], greatest force that then remains; 2.8 N before
SCENE = """
impairment = {{delay = "20 ms", loss = {loss}}}
hand = {{grab_stiffness = 150, grab_viscosity = 2}}
[scene]
gravity = "0 0 {weight} m/s2"
[[object]]
name = "floor"
plane = [0, 0, 1]
position = "0 0 -40 mm"
[[object]]
name = "body"
box = "{length} 80 80 mm"
mass = 1
body_drag = {drag}
surface = {{stiffness = "500 N/m"}}
"""
# An operator that grabs the bar at x = {0} mm and lifts it by 60 mm within 10 s.
LIFTING = '[[operator]]\nsweep = {{from = "{0} 0 0 mm", to = "{0} 0 60 mm", period = "20 s", grab = true}}\nstiffness = 1000\n'


def eased(t, begin):
    """0 until `begin`, 1 a second later."""
    u = min(max(t - begin, 0.0), 1.0)
    return u * u * (3 - 2 * u)


def pressing(side, begin, more=lambda t: 0.0):
    """x [m] by time [s] of a hand that moves its target from 60 mm outside a side of the body to 15 mm inside. `side` is
    -1 or 1; `more` is added."""
    return lambda t: side * (0.1 - 0.075 * eased(t, begin)) + more(t)


class Touch:
    """Two live peers at one body, `reckon inspect`, which receives its owners, and the true forces. A hand is x [m] as a
    function of the time [s] since the start of peer 1, or the text of an operator. With operators, both peers start at
    once."""

    def __init__(self, setup, bed, hands, seconds, **scene):
        self.folder, self.seconds, self.peers = setup.folder, seconds, []
        self.later = [0.0, LATER if callable(hands[0]) else 0.0]
        self.text = SCENE.format(**({"weight": 0, "loss": 0, "length": 80, "drag": 2} | scene))
        truth, _, _ = held_things.run(setup.reckon, self.scene(hands, [0.0, 0.0], 1), 1, seconds)
        self.truth = [held_things.forces(rows) for _, rows in sorted(truth.items())]
        path = self.folder / "touch.toml"
        path.write_text(self.scene(hands, self.later, 2))
        self.wire = bed.run(3, [setup.reckon, "inspect", "--iface", "e0", "--json"], Wire)
        for number in (1, 2):
            words = [setup.feeler, path, "e0", number, f"PEER{number}", seconds]
            self.peers.append(bed.run(number, list(map(str, words)), Feeler))
            wait_for("an owner", lambda: not self.later[1] or any(s["bodies"] for s in self.peers[0].samples()), 10)

    def scene(self, hands, later, peers):
        text = self.text
        for number, hand in enumerate(hands, 1):
            if callable(hand):
                path, times = self.folder / f"{peers}_{number}.csv", [0.02 * i for i in range(50 * self.seconds)]
                path.write_text("t_s,px_m,py_m,pz_m\n" + "".join(f"{t:.2f},{hand(t + later[number - 1]):.6f},0,0\n" for t in times))
                hand = f'[[operator]]\ntrace = "{path}"\n'
            text += f"{hand}[[device]]\npeer = {min(number, peers)}\noperator = {number}\n"
        return text

    def felt(self, number, begin, end):
        """Waits until `end`. Returns [(time [s], force [N], true force [N])] of a hand."""
        time.sleep(max(0.0, end + 0.2 - self.peers[0].seconds()))
        live = [(s["felt_s"] + self.later[number - 1], s["felt"]) for s in self.peers[number - 1].samples()]
        return [(t, force, self.truth[number - 1][round(1000 * t)]) for t, force in live if begin <= t < end]

    def steady(self, begin, numbers=(1, 2), axes=(0, 1, 2)):
        """Checks the median force [N] of each hand within one second."""
        for number in numbers:
            _, *forces = zip(*self.felt(number, begin, begin + 1))
            live, true = ([round(statistics.median(force[i] for force in some), 4) for i in axes] for some in forces)
            error = math.dist(live, true) / math.hypot(*true)
            print(f"  hand {number} at {begin} s: {live} N, true {true} N, error {100 * error:.2f} %")
            check(error <= STEADY, f"the steady force of hand {number} is off by {100 * error:.2f} %")

    def curve(self, number, begin, end):
        """Checks the 90 % quantile of the force error over time, at the best time shift of up to 0.1 s."""
        felt, true = self.felt(number, begin, end), self.truth[number - 1]
        errors = [sorted(math.dist(force, true[round(1000 * t) - late]) for t, force, _ in felt) for late in range(-100, 101)]
        error = min(some[len(felt) * 9 // 10] for some in errors) / max(math.hypot(*force) for _, _, force in felt)
        print(f"  hand {number}, {begin} to {end} s: error {100 * error:.2f} %")
        check(error <= CURVE, f"the force of hand {number} is off by {100 * error:.2f} %")

    def owners(self):
        """Checks in the sent states that the body had one owner at a time. Returns the number of successive owners."""
        states = [(r["version"], r["owner"]) for _, text in list(self.wire.lines) for r in json.loads(text).get("ownership", [])]
        check(states == sorted(states), "an older version follows a newer one")
        check(len(set(states)) == len({version for version, _ in states}), "a version has two owners")
        return len(list(itertools.groupby(states, lambda state: state[1])))


def pushed(setup):
    """The hand of peer 2 pushes the body of peer 1. Peer 2 owns the body before the touch; the hand feels the true force."""
    with setup.testbed(3) as bed:
        touch = Touch(setup, bed, (lambda t: 1.0, lambda t: SPEED * max(0.0, t - 2.5) - 0.12), 9, drag=DRAG)
        time.sleep(4)  # until it pushes
        pictures = touch.peers[1].samples()
        first = next((i for i, s in enumerate(pictures) if any(s["felt"])), 0)
        check(first > 0 and pictures[first - 1]["bodies"] == 1, "peer 2 did not own the body before the touch")
        touch.curve(2, 3, 8)
        check(touch.owners() == 2, "the body changed its owner more than once")


def pressed(setup):
    """Hands of both peers press the body from two sides."""
    with setup.testbed(3) as bed:
        touch = Touch(setup, bed, (pressing(-1, 3), pressing(1, 3)), 9)
        touch.steady(6)
        touch.owners()


def carried(setup):
    """Hands of both peers press the body and carry it 40 mm, with a loss of 10 %."""
    with setup.testbed(3) as bed:
        touch = Touch(setup, bed, [pressing(side, 3, lambda t: 0.04 * eased(t, 5)) for side in (-1, 1)], 11, loss=0.1)
        touch.steady(8)
        touch.owners()


def held(setup):
    """Hands of both peers hold the ends of a bar and lift it. Each hand feels half of the weight."""
    with setup.testbed(3) as bed:
        touch = Touch(setup, bed, (LIFTING.format(-98), LIFTING.format(98)), 12, weight=-9.81, length=200)
        touch.steady(8.8, axes=(2,))
        touch.owners()


def killed_while_pressed(setup):
    """Hands of both peers press the body; peer 2 owns it and is killed. The hand of peer 1 pushes the body on: at first a
    copy, then the body that peer 1 adopts."""
    with setup.testbed(3) as bed:
        stays = pressing(-1, 4, lambda t: SLOW * max(0.0, t - 6.7))
        touch = Touch(setup, bed, (stays, pressing(1, 2, lambda t: eased(t, 7.5))), 15, drag=THICK)
        touch.steady(5.7)
        touch.peers[1].kill()
        killed = touch.peers[0].seconds()
        for time_s in (9.2, 10.5, 13):
            touch.steady(time_s, (1,))
        pictures = touch.peers[0].samples(killed)
        adopted = next((s["at"] for s in pictures if s["bodies"]), math.inf) - killed
        left = statistics.median(abs(s["felt"][0]) for s in pictures if GONE < s["at"] - killed < GONE + 1)
        print(f"  {left:.3f} N remain on the hand; adopted after {adopted:.2f} s")
        check(left <= LEFT and adopted <= ADOPTED, "the force remains, or no peer adopts the body")
        check(touch.owners() == 3, "peer 1, peer 2 and peer 1 did not own the body in turn")


CASES = {case.__name__: case for case in (pushed, pressed, carried, held, killed_while_pressed)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
