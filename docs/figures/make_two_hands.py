#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/figures/two_hands.svg from a run of scenes/two_hands.toml: python3 docs/figures/make_two_hands.py

Runs `reckon demo scenes/two_hands.toml --simulated-time --for 60s --trace ...` and draws where the two hands were, and the force
that each felt from the other, computed from what it had received. Standard library only.
"""
import csv
import itertools
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/reckon"
BLUE, ORANGE, STONE, INK = "#1f6fb4", "#d9730d", "#8a8f98", "#24292f"
STIFFNESS, RADIUS = 500.0, 0.010  # of a hand, scenes/two_hands.toml
SCALE = 1950  # page units a metre


def record():
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder) / "trace.csv"
        subprocess.run([PROGRAM, "demo", ROOT / "scenes/two_hands.toml", "--simulated-time", "--for", "60s", "--trace", trace],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        hands = {1: [], 2: []}
        with open(trace, newline="") as file:
            for row in csv.DictReader(file):
                step = {key: float(value) for key, value in row.items()}
                hands[int(step["peer"])].append(step)
    return hands


def mesh():
    points, faces = [], []
    for line in (ROOT / "scenes/touchstone.obj").read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(float(w) for w in words[1:4]))
        elif words[:1] == ["f"]:
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    # As the scene places it: the diagonal of its box is 0.2 m.
    size = math.dist([min(p[i] for p in points) for i in range(3)],
                     [max(p[i] for p in points) for i in range(3)])
    return [tuple(0.2 / size * c for c in p) for p in points], faces


def place(p):
    """Scene metres to the page: seen from the south-east and above."""
    x, y, z = p
    a, b = math.radians(35), math.radians(38)
    across = x * math.cos(a) + y * math.sin(a)
    away = -x * math.sin(a) + y * math.cos(a)
    return 290 + SCALE * across, 250 - SCALE * (z * math.cos(b) + away * math.sin(b))


def path(points, colour, width, extra=""):
    data = "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<path d="{data}" fill="none" stroke="{colour}" stroke-width="{width}" {extra}/>'


def text(x, y, words, size=13, colour=INK, anchor="start", extra=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" '
            f'text-anchor="{anchor}" {extra}>{words}</text>')


def draw_stone(out):
    points, faces = mesh()
    shaded = []
    for face in faces:
        a, b, c = (points[i] for i in face[:3])
        u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        length = math.hypot(*n) or 1.0
        view = (math.sin(math.radians(35)) * math.cos(math.radians(38)),
                -math.cos(math.radians(35)) * math.cos(math.radians(38)),
                math.sin(math.radians(38)))
        facing = sum(n[i] * view[i] for i in range(3)) / length
        if facing <= 0:
            continue
        depth = sum(sum(points[i][k] for i in face) * view[k] for k in range(3))
        light = 0.5 + 0.45 * max(0.0, (0.3 * n[0] - 0.2 * n[1] + 0.9 * n[2]) / length)
        grey = 5 * round(255 * min(0.97, light) / 5)
        shaded.append((depth, grey, [place(points[i]) for i in face]))

    # Neighbours of one shade become one path, which keeps the file small.
    shaded.sort(key=lambda s: s[0])
    for grey, group in itertools.groupby(shaded, key=lambda s: s[1]):
        data = "".join("M" + "L".join(f"{x:.1f},{y:.1f}" for x, y in corners) + "Z"
                       for _, _, corners in group)
        colour = f"#{grey:02x}{grey:02x}{min(255, grey + 6):02x}"
        out.append(f'<path d="{data}" fill="{colour}" stroke="{colour}" stroke-width="0.7"/>')


def size_of(step, prefix):
    return math.hypot(*(step[f"{prefix}_f{axis}_N"] for axis in "xyz"))


def draw_hands(out, hands, moment):
    for peer, colour in ((1, BLUE), (2, ORANGE)):
        steps = hands[peer]
        out.append(path([place([s[f"s{a}_m"] for a in "xyz"]) for s in steps[::50]], colour, 1.6,
                        'opacity="0.8"'))
    for peer, colour, name in ((1, BLUE, "hand 1"), (2, ORANGE, "hand 2")):
        step = hands[peer][moment]
        x, y = place([step[f"s{a}_m"] for a in "xyz"])
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{SCALE * RADIUS:.1f}" fill="{colour}" '
                   f'fill-opacity="0.35" stroke="{colour}" stroke-width="1.5"/>')
        push = [step[f"hand_f{a}_N"] for a in "xyz"]
        tip = place([step[f"s{a}_m"] + 0.06 * f for a, f in zip("xyz", push)])
        out.append(path([(x, y), tip], colour, 3, f'marker-end="url(#{name[-1]})"'))
        out.append(text(x + (-34 if peer == 1 else 34), y + 44, name, 13, colour,
                        "end" if peer == 1 else "start"))


def draw_forces(out, hands, first, last):
    left, top, width, height, most = 630, 80, 320, 230, 0.6
    count = last - first

    def at(i, newton):
        return left + width * (i - first) / count, top + height * (1 - newton / most)

    for newton in (0, 0.2, 0.4, 0.6):
        y = at(first, newton)[1]
        out.append(path([(left, y), (left + width, y)], "#d0d7de", 1))
        out.append(text(left - 8, y + 4, f"{newton:g} N", 12, STONE, "end"))
    truth = []
    for i in range(first, last, 10):
        apart = math.dist([hands[1][i][f"p{a}_m"] for a in "xyz"],
                          [hands[2][i][f"p{a}_m"] for a in "xyz"])
        truth.append(at(i, STIFFNESS * max(0.0, 2 * RADIUS - apart)))
    out.append(path(truth, "#b8bec6", 5))
    for peer, colour in ((1, BLUE), (2, ORANGE)):
        out.append(path([at(i, size_of(hands[peer][i], "hand")) for i in range(first, last, 10)],
                        colour, 1.6))
    start, end = hands[1][first]["t_s"], hands[1][last - 1]["t_s"]
    begun = hands[1][0]["t_s"]
    out.append(text(left, top + height + 20, f"{start - begun:.0f} s", 12, STONE))
    out.append(text(left + width, top + height + 20, f"{end - begun:.0f} s", 12, STONE, "end"))
    out.append(text(left, top - 20, "force between the hands, felt at each end", 14))
    out.append(text(left, top + height + 44, "felt by hand 1", 12, BLUE))
    out.append(text(left + 115, top + height + 44, "felt by hand 2", 12, ORANGE))
    out.append(text(left + 230, top + height + 44, "true", 12, STONE))


def main():
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is missing; ./run build makes it")
    hands = record()
    touching = [i for i, step in enumerate(hands[1]) if size_of(step, "hand") > 0.05]
    first, last = max(0, touching[0] - 800), min(len(hands[1]), len(hands[2]), touching[-1] + 800)
    moment = max(touching, key=lambda i: size_of(hands[1][i], "hand"))

    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 980 400" '
           'font-family="DejaVu Sans, Helvetica, sans-serif">',
           '<rect width="980" height="400" fill="white"/>', "<defs>"]
    for peer, colour in ((1, BLUE), (2, ORANGE)):
        out.append(f'<marker id="{peer}" viewBox="0 0 8 8" refX="4" refY="4" markerWidth="4" '
                   f'markerHeight="4" orient="auto"><path d="M0,0 L8,4 L0,8 Z" fill="{colour}"/></marker>')
    out.append("</defs>")
    draw_stone(out)
    draw_hands(out, hands, moment)
    draw_forces(out, hands, first, last)
    out.append("</svg>")
    target = ROOT / "docs/figures/two_hands.svg"
    target.write_text("\n".join(out) + "\n")
    print(f"{target.relative_to(ROOT)}: hands touch from {hands[1][touching[0]]['t_s']:.1f} s")


if __name__ == "__main__":
    main()
