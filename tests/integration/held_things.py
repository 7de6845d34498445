# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Forces on hands that hold a light object, and on two hands that hold the same one, in simulated time, from the
trace of the servo. held_things.py RECKON"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

FORCE = ("fx_N", "fy_N", "fz_N")
K, GRIP, IN = 500.0, 300.0, 0.012  # [N/m], of the cube and of a hand; [m], target depth
RIGHT = IN / (1 / K + 1 / GRIP)  # [N], springs in series


def run(reckon, scene, peers, seconds):
    """({(peer, device): rows of the trace}, summary, text of the summary)"""
    with tempfile.TemporaryDirectory(prefix="reckon_") as folder:
        path, trace = pathlib.Path(folder) / "scene.toml", pathlib.Path(folder) / "trace.csv"
        path.write_text(scene)
        words = [reckon, "demo", path, "--simulated-time", "--peers", str(peers), "--for", f"{seconds}s"]
        done = subprocess.run([*map(str, words), "--trace", str(trace), "--json"], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"reckon demo ends with status {done.returncode}: {done.stderr}")
        text = subprocess.run([*map(str, words)], capture_output=True, text=True).stdout
        hands = {}
        with trace.open() as lines:
            for row in csv.DictReader(lines):
                hands.setdefault((int(row["peer"]), int(row["device"])), []).append(row)
        return hands, json.loads(done.stdout.splitlines()[-1]), text


def forces(rows):
    return [[float(row[name]) for name in FORCE] for row in rows]


def squeeze_of(edge, peers):
    """Two fingers of the default radius, of one peer or of two, with targets 12 mm inside both sides of a cube."""
    goal = 1e3 * (0.5 * edge - IN)
    hands = "".join(f"""
[[operator]]
sweep = {{from = "{way * 60} 0 0 mm", to = "{way * goal} 0 0 mm", period = "4 s"}}
stiffness = {GRIP}
[[device]]
peer = {1 + side * (peers - 1)}
operator = {1 + side}
""" for side, way in enumerate((-1, 1)))
    return f"""[scene]
gravity = "0 0 0 m/s2"
[[object]]
name = "c"
box = [{edge}, {edge}, {edge}]
mass = "0.2 kg"
surface = {{stiffness = {K}}}
{hands}"""


def squeezes(reckon):
    """Each finger feels the cube and not the other finger."""
    faults = []
    for edge in (0.02, 0.03, 0.04):
        hands, _, _ = run(reckon, squeeze_of(edge, 1), 1, 2)
        for hand, rows in sorted(hands.items()):
            felt = abs(forces(rows)[-1][0])
            print(f"cube of {1e3 * edge:.0f} mm, hand {hand}: {felt:.3f} N, right {RIGHT:.3f} N")
            if abs(felt - RIGHT) > 0.01 * RIGHT:
                faults.append(f"cube of {1e3 * edge:.0f} mm, hand {hand} feels {felt:.3f} of {RIGHT:.3f} N")
            if max(float(row["hand_fx_N"]) ** 2 for row in rows) > 1e-6:
                faults.append(f"cube of {1e3 * edge:.0f} mm, hand {hand} feels the other hand")
        hands, summary, text = run(reckon, squeeze_of(edge, 2), 2, 2)
        for hand, rows in sorted(hands.items()):
            most = max(abs(float(row["hand_fx_N"])) for row in rows)
            felt = abs(forces(rows)[-1][0])
            print(f"cube of {1e3 * edge:.0f} mm between two peers, hand {hand}: {felt:.3f} N, right {RIGHT:.3f} N")
            if abs(felt - RIGHT) > 0.02 * RIGHT:
                faults.append(f"two peers, cube of {1e3 * edge:.0f} mm, hand {hand} feels {felt:.3f} of {RIGHT:.3f} N")
            if most > 1e-3:
                faults.append(f"two peers, cube of {1e3 * edge:.0f} mm, hand {hand} feels {most:.3f} N of the other")
        touched = [hand["touching_bodies_s"] for hand in summary["hands"]]
        if not (touched[1] > 0.5 and touched[0] == 0):
            faults.append(f"two peers, cube of {1e3 * edge:.0f} mm: the summary has {touched} s at bodies of others")
        if "or an object of another peer" in text:
            faults.append("two peers: the summary says that nobody touched anything of others")
    return faults


def stroke_of(mass, viscosity, speed, shape):
    amplitude = 0.012
    return f"""[scene]
gravity = "0 0 0 m/s2"
[[object]]
name = "b"
{shape}
mass = "{mass} kg"
surface = {{stiffness = 500}}
drag = {{viscosity = "{viscosity} N s/m"}}
[[operator]]
sweep = {{from = [-{amplitude}, 0.002, 0.016], to = [{amplitude}, 0.002, 0.016], period = "{6.283 * amplitude / speed:.4f} s"}}
stiffness = 300
damping = 2
[[device]]
peer = 1
operator = 1
damping = "2 N s/m"
"""


def turned(rows):
    """Greatest change of the force that one step makes and the next reverses [N]."""
    worst, force = 0.0, forces(rows)
    for axis in range(3):
        steps = [b[axis] - a[axis] for a, b in zip(force, force[1:])]
        for one, other in zip(steps, steps[1:]):
            if one * other < 0:
                worst = max(worst, min(abs(one), abs(other)))
    return worst


def strokes(reckon):
    """Drag does not reverse a light body within a period."""
    faults = []
    for shape in ("box = [0.04, 0.04, 0.04]", "sphere = 0.02", "box = [0.2, 0.06, 0.04]"):
        for mass in (0.002, 0.004, 0.02, 0.2):
            for speed, viscosity in ((0.05, 8), (0.2, 30), (1.0, 8)):
                hands, _, _ = run(reckon, stroke_of(mass, viscosity, speed, shape), 1, 1)
                worst = turned(hands[1, 1])
                if worst > 0.1:
                    faults.append(f"{shape}, {mass} kg, {viscosity} N s/m, {speed} m/s: {worst:.3f} N turned in 1 ms")
    return faults


def pushes_of(mass, damping, speed):
    """Two hands alternately push a cube over a floor, 4 mm beside its centre."""
    hands = "".join(f"""
[[operator]]
sweep = {{from = "{way * 34} {way * -4} 2 mm", to = "{way * 10} {way * -4} 2 mm", period = "{period * 0.0754 / speed:.4f} s"}}
stiffness = 300
damping = 2
[[device]]
peer = 1
operator = {number}
damping = "2 N s/m"
""" for number, way, period in ((1, -1, 1.0), (2, 1, 1.2)))
    return f"""[hand]
radius = "0.5 mm"
[[object]]
name = "floor"
plane = [0, 0, 1]
position = "0 0 -20 mm"
[[object]]
name = "c"
box = "40 40 40 mm"
mass = "{mass} kg"
surface = {{stiffness = 500, damping = {damping}}}
{hands}"""


def pushes(reckon):
    """Surface damping reverses no light body within a period."""
    faults = []
    for mass in (0.004, 0.02):
        for speed, damping in ((0.1, 10), (0.3, 30)):
            hands, _, _ = run(reckon, pushes_of(mass, damping, speed), 1, 1)
            worst = max(turned(rows) for rows in hands.values())
            if worst > 0.1:
                faults.append(f"{mass} kg, damping {damping} N s/m, {speed} m/s: {worst:.3f} N turned in 1 ms")
    return faults


def main():
    faults = squeezes(sys.argv[1]) + strokes(sys.argv[1]) + pushes(sys.argv[1])
    for text in faults:
        print(f"FAILED: {text}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
