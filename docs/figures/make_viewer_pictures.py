#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Takes the pictures of docs/viewer.md, and of the README, from the running page:

    python3 docs/figures/make_viewer_pictures.py [RECKON [NAME ..]]

RECKON is build/release/reckon where it is not said; NAME takes that picture alone. Needs Debian's chromium,
chromium-driver and python3-selenium. One more picture is one row of PICTURES.
"""
import importlib.util
import math
import pathlib
import sys
import tempfile
import time
from typing import NamedTuple

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
MOST_OCTETS = 300_000
TRUCKS = 300


class Picture(NamedTuple):
    name: str
    arguments: list  # of reckon; {folder} is where the scene of trucks lies
    wishes: dict
    size: tuple
    until: str  # JavaScript: is it the moment?
    before: str = ""  # JavaScript that is run when pictures come


PRESSED = "window.reckon.hands.some((hand) => hand.newtons > 0.3) && window.reckon.time > 25"
SHAKES = "window.reckon.hands.every((hand) => hand.newtons > 1) && window.reckon.hands.some((hand) => hand.twin > 4) && window.reckon.time > 42"
STILL = "window.reckon.hands.every((hand) => hand.newtons > 1.9 && !(hand.flags & 14)) && window.reckon.numbers.pdu_per_s < 60 && window.reckon.time > 25"
FOLLOW = "document.querySelector('tbody tr:nth-child(3)').click()"
PICTURES = [
    Picture("viewer_touch", ["demo"], {"theme": "dark", "tour": "off"}, (1280, 800), STILL),
    Picture("viewer_network", ["demo", "--impair", "delay=100ms jitter=30ms loss=20%"], {"theme": "light", "tour": "off"}, (1280, 800), PRESSED),
    Picture("viewer_twin", ["demo", "--impair", "delay=150ms loss=20%"], {"theme": "dark", "tour": "off"}, (1280, 800), SHAKES),
    Picture("viewer_world", ["demo", "{folder}/trucks.toml"], {"theme": "light", "main": "world"}, (1280, 800), "window.reckon.time > 30", FOLLOW),
    Picture("viewer_narrow", ["demo"], {"theme": "dark", "tour": "off"}, (400, 860), PRESSED),
]


def page_driver():
    spec = importlib.util.spec_from_file_location("page_driver", ROOT / "tests/tools/viewer/page/page_driver.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def write_trucks(folder):
    """Trucks of one peer on rings, a track for each ring."""
    lines = ['[scene]\nname = "trucks"\norigin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}\n',
             '[aoim]\nscheme = "square"\ncell = "100 m"\nradius = "150 m"\n']
    rings = TRUCKS // 10
    for ring in range(rings):
        radius = 40 + 14 * ring
        turn = (1 if ring % 2 else -1) * (4 + ring % 5) / radius
        period = 2 * math.pi / abs(turn)
        steps = math.ceil(period / 0.2)
        for truck in range(10):
            begin = 2 * math.pi * truck / 10 + 0.7 * ring
            name = f"ring_{ring}_{truck}.csv"
            with open(folder / name, "w", encoding="utf-8") as file:
                file.write("t_s,px_m,py_m,pz_m\n")
                for step in range(steps):
                    angle = begin + 2 * math.pi * step / steps * math.copysign(1, turn)
                    wave = radius + 4 * math.sin(3 * angle)
                    file.write(f"{step * period / steps:.4f},{wave * math.cos(angle):.4f},{wave * math.sin(angle):.4f},0\n")
            force = ("friendly", "opposing", "neutral")[(ring + truck) % 3]
            lines.append(f'[[entity]]\nmarking = "TRUCK{10 * ring + truck}"\ntype = "1.1.206.7"\nforce_id = "{force}"\ntrack = "{name}"\n')
    (folder / "trucks.toml").write_text("\n".join(lines), encoding="utf-8")


def take(browser, picture, reckon, folder):
    arguments = [word.format(folder=folder) for word in picture.arguments]
    with browser.program(str(reckon), arguments[0], *arguments[1:], "--view=0", "--for", "10min") as started, browser.browser() as page:
        page.size(*picture.size)
        page.open(started.address, fine=1, **picture.wishes)
        page.wait("window.reckon?.state === 'live' && window.reckon.entities > 0", "entities")
        page.wait_for_pictures()
        if picture.before:
            time.sleep(5)  # the table sorts itself every 2 s
            page.driver.execute_script(picture.before)
        browser.WebDriverWait(page.driver, 120, 0.05).until(lambda _: page.ask(picture.until))
        file = HERE / f"{picture.name}.png"
        page.driver.save_screenshot(str(file))
    octets = file.stat().st_size
    print(f"{file.name}: {octets} octets")
    if octets > MOST_OCTETS:
        sys.exit(f"{file.name} has more than {MOST_OCTETS} octets")


def main(arguments):
    reckon = pathlib.Path(arguments[0]) if arguments else ROOT / "build/release/reckon"
    wanted = arguments[1:] or [picture.name for picture in PICTURES]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_trucks(folder)
        browser = page_driver()
        for picture in PICTURES:
            if picture.name in wanted:
                take(browser, picture, reckon, folder)


if __name__ == "__main__":
    main(sys.argv[1:])
