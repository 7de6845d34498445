#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/figures/effects.svg from a run of scenes/touch_gallery.toml: python3 docs/figures/make_effects.py

The force on each hand over its place, on its way from left to right: along the motion and, of surfaces, out of them. Standard
library only.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/reckon"
BLUE, ORANGE, STONE, INK = "#1f6fb4", "#d9730d", "#8a8f98", "#24292f"
LEFT, WIDTH, HEIGHT = 60, 900, 150
# What stands along x [mm], as in the scene.
SAMPLES = [("skin", -240, -180), ("smooth", -180, -120), ("wood", -120, -60), ("cloth", -60, 0), ("grooves", 0, 60),
           ("oil", 60, 120), ("bow", 120, 180), ("velcro", 180, 240), ("sandstone", 240, 300)]
REGIONS = [("honey", -160, -80), ("sand", -70, 10), ("magnet", 30, 90), ("engine", 110, 190)]


def record():
    """Steps of each hand on its second way from left to right: the first begins inside."""
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder) / "trace.csv"
        subprocess.run([PROGRAM, "demo", ROOT / "scenes/touch_gallery.toml", "--simulated-time", "--for", "28s", "--trace", trace],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        hands = {1: [], 2: []}
        with open(trace, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                hands[int(row["peer"])].append([float(row[key]) for key in ("t_s", "px_m", "fx_N", "fz_N")])
    begun = hands[1][0][0]
    period = {1: 18.0, 2: 12.0}
    return {hand: [step for step in steps if period[hand] <= step[0] - begun < 1.5 * period[hand]] for hand, steps in hands.items()}


def text(x, y, words, size=12, colour=INK, anchor="start"):
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" text-anchor="{anchor}">{words}</text>'


def path(points, colour, width):
    data = "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<path d="{data}" fill="none" stroke="{colour}" stroke-width="{width}"/>'


def thinned(points):
    """The lowest and the highest of each page unit, in their order."""
    cells = {}
    for i, (x, y) in enumerate(points):
        low, high = cells.setdefault(round(x), [(y, i), (y, i)])
        cells[round(x)] = [min(low, (y, i)), max(high, (y, i))]
    kept = sorted({i for cell in cells.values() for _, i in cell})
    return [points[i] for i in kept]


def panel(out, top, steps, places, reach, forces, title):
    low, high = reach
    least, most = forces

    def at(millimetres, newton):
        return LEFT + WIDTH * (millimetres - low) / (high - low), top + HEIGHT * (most - newton) / (most - least)

    out.append(text(LEFT, top - 28, title, 14))
    for name, begin, end in places:
        x, width = at(begin, 0)[0], at(end, 0)[0] - at(begin, 0)[0]
        out.append(f'<rect x="{x:.1f}" y="{top}" width="{width:.1f}" height="{HEIGHT}" fill="#f3f5f8"/>')
        out.append(text(x + width / 2, top - 8, name, 12, INK, "middle"))
    newton = least
    while newton <= most + 1e-9:
        y = at(low, newton)[1]
        out.append(path([(LEFT, y), (LEFT + WIDTH, y)], "#d0d7de", 1))
        out.append(text(LEFT - 8, y + 4, f"{newton:g} N", 11, STONE, "end"))
        newton += 0.5
    for index, colour in ((3, STONE), (2, BLUE)):
        out.append(path(thinned([at(1e3 * step[1], min(max(step[index], least), most)) for step in steps]), colour, 1.2))


def main():
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is missing; ./run build makes it")
    hands = record()
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 980 500" font-family="DejaVu Sans, Helvetica, sans-serif">',
           '<rect width="980" height="500" fill="white"/>']
    panel(out, 60, hands[1], SAMPLES, (-240, 300), (-1.5, 2.0), "on surfaces, pressed and stroked from left to right")
    panel(out, 290, hands[2], REGIONS, (-170, 200), (-1.0, 1.0), "through regions, from left to right")
    out.append(text(LEFT, 480, "along the motion", 12, BLUE))
    out.append(text(LEFT + 150, 480, "out of the surface; up", 12, STONE))
    out.append("</svg>")
    target = ROOT / "docs/figures/effects.svg"
    target.write_text("\n".join(out) + "\n", encoding="utf-8")
    print(f"{target.relative_to(ROOT)}: {target.stat().st_size} octets")


if __name__ == "__main__":
    main()
