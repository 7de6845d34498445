#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Takes the pictures of docs/viewer.md, and of the README, from the running page:

    python3 docs/figures/make_viewer_pictures.py [RECKON [NAME ..]]

RECKON is build/release/reckon by default; NAME takes that picture alone. Needs Debian's chromium,
chromium-driver and python3-selenium. One more picture is one row of PICTURES.
"""
import importlib.util
import pathlib
import sys
import time
from typing import NamedTuple

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
MOST_OCTETS = 300_000


class Picture(NamedTuple):
    name: str
    arguments: list  # of reckon
    wishes: dict
    size: tuple
    until: str  # JavaScript: is it the moment?
    before: str = ""  # JavaScript that is run when pictures come


PRESSED = "window.reckon.hands.some((hand) => hand.newtons > 0.3) && window.reckon.time > 25"
SHAKES = "window.reckon.hands.every((hand) => hand.newtons > 1) && window.reckon.hands.some((hand) => hand.twin > 4) && window.reckon.time > 42"
STILL = "window.reckon.hands.every((hand) => hand.newtons > 1.9 && !(hand.flags & 14)) && window.reckon.numbers.pdu_per_s < 60 && window.reckon.time > 25"
FOLLOW = "[...document.querySelectorAll('tbody tr')].find((row) => row.textContent.startsWith('FERRY')).click()"
PICTURES = [
    Picture("viewer_touch", ["demo"], {"theme": "dark", "tour": "off"}, (1280, 800), STILL),
    Picture("viewer_network", ["demo", "--impair", "delay=100ms jitter=30ms loss=20%"], {"theme": "light", "tour": "off"}, (1280, 800), PRESSED),
    Picture("viewer_twin", ["demo", "--impair", "delay=150ms loss=20%"], {"theme": "dark", "tour": "off"}, (1280, 800), SHAKES),
    Picture("viewer_world", ["demo", str(ROOT / "scenes/exercise.toml")], {"theme": "light"}, (1280, 800), "window.reckon.time > 40", FOLLOW),
    Picture("viewer_narrow", ["demo"], {"theme": "dark", "tour": "off"}, (400, 860), PRESSED),
]


def page_driver():
    spec = importlib.util.spec_from_file_location("page_driver", ROOT / "tests/tools/viewer/page/page_driver.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def take(browser, picture, reckon):
    with browser.program(str(reckon), *picture.arguments, "--view=0", "--for", "10min") as started, browser.browser() as page:
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
    browser = page_driver()
    for picture in PICTURES:
        if picture.name in wanted:
            take(browser, picture, reckon)


if __name__ == "__main__":
    main(sys.argv[1:])
