# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of an exercise in Chromium: what a capture holds is in it, at a size that can be read.

  page_exercise.py CASE RECKON SCENES DATA     exit status 77 = skipped, with a message

  sessions  each real session, as it opens, and at its start, quarter, half, three quarters and end
  shipped   the same of scenes/exercise.pcapng, in both views
  truck     a recorded truck: ground, scale, switch of the camera, card; three sizes, no overlap; saved
"""
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from page_driver import ActionChains, Keys, browser, expect, needs_browser, program, record, shows_no_fault, skip

SHARES = (0, 0.25, 0.5, 0.75, 1)
LEAST = 12  # [pixels], larger side of an entity
SIZES = ((1280, 800), (900, 700), (390, 844))


def boxes_are_seen(page, where):
    boxes, width, height = page.ask("[window.reckon.boxes(), document.querySelector('canvas').clientWidth, document.querySelector('canvas').clientHeight]")
    expect(boxes, f"{where}: an entity")
    for left, top, right, bottom in boxes:
        expect(max(right - left, bottom - top) >= LEAST, f"{where}: at least {LEAST} pixels, not {right - left:.1f} x {bottom - top:.1f}")
        expect(left >= 0 and top >= 0 and right <= width and bottom <= height, f"{where}: {boxes} within {width} x {height}")


def seek(page, share):
    time_there = page.driver.execute_script(
        "const slider = document.getElementById('slider'); slider.value = Number(slider.min) + arguments[0] * (slider.max - slider.min);"
        "slider.dispatchEvent(new Event('input')); return Number(slider.value)", share)
    page.wait(f"['paused', 'end'].includes(window.reckon.play) && Math.abs(window.reckon.time - {time_there}) < 0.1", f"the instant {share}")
    page.wait("window.reckon.boxes().length > 0", "an entity")


def is_seen(page, started, name, shares=SHARES, **wishes):
    """At these moments, and before them as the page opens and plays."""
    page.open(started.address, **wishes)
    page.wait("window.reckon?.state === 'live' && window.reckon.frames > 3 && window.reckon.boxes().length > 0", f"{name}: entities")
    boxes_are_seen(page, f"{name} as it opens")
    for share in shares:
        seek(page, share)
        boxes_are_seen(page, f"{name} at {share}")
    shows_no_fault(page)


def sessions(reckon, _, data):
    files = sorted(Path(data).glob("dis-captures/real-sessions/*.pcap"))
    if not files:
        skip(f"no dis-captures/real-sessions in {data}: set RECKON_DATA")
    with browser() as page:
        page.size(1280, 800)
        for file in files:
            with program(reckon, "view", file, "--port", "0") as started:
                is_seen(page, started, file.name)
                expect(page.ask("window.reckon.auto"), f"{file.name}: the camera leads")
    print(f"{len(files)} sessions, {len(SHARES) * len(files)} moments")


def shipped(reckon, scenes, _):
    with browser() as page, program(reckon, "view", f"{scenes}/exercise.pcapng", "--port", "0") as started:
        page.size(1280, 800)
        for view in ("touch", "world"):
            is_seen(page, started, view, main=view)
        with program(reckon, "demo", f"{scenes}/exercise.toml", "--view=0") as started:
            page.open(started.address)
            page.wait("window.reckon?.entities === 40 && window.reckon.boxes().length === 40", "40 entities")
            time.sleep(2)
            boxes_are_seen(page, "40 entities of three peers")
            overlaps_nothing(page)
            expect(page.ask("document.getElementById('hand').hidden"), "no hand is offered where there is none")


def truck(reckon, scenes, _):
    with tempfile.TemporaryDirectory() as folder, browser() as page:
        heard, file = Path(folder) / "truck.pcapng", Path(folder) / "truck.html"
        record(reckon, f"{scenes}/truck.toml", heard)
        with program(reckon, "view", heard, "--port", "0") as started:
            for width, height in SIZES:
                page.size(width, height)
                is_seen(page, started, f"{width} x {height}", (0.5,))
                overlaps_nothing(page)
            page.size(1280, 800)
            has_ground(page)
            has_card(page)
            has_switch(page)
        subprocess.run([reckon, "view", heard, "--save", file], check=True, capture_output=True)
        page.open(f"file://{file}")
        page.wait("window.reckon?.frames > 5 && window.reckon.boxes().length > 0", "a saved page")
        boxes_are_seen(page, "saved")
        has_ground(page)
        has_card(page)


LABELS = "[...document.querySelectorAll('#labels span, #lead, #scale, #over > *, #key, #card')].filter((part) => part.offsetWidth && part.textContent)"


def overlaps_nothing(page):
    time.sleep(0.4)  # what lies over the picture is measured five times a second
    boxes = page.ask(f"{LABELS}.map((part) => [part.textContent, ...Object.values(part.getBoundingClientRect().toJSON()).slice(0, 4)])")
    expect(len(boxes) > 4, f"texts in the picture: {boxes}")
    for i, (text, x, y, width, height) in enumerate(boxes):
        for other, u, v, wide, high in boxes[:i]:
            expect(x >= u + wide or u >= x + width or y >= v + high or v >= y + height, f"'{text}' does not cover '{other}'")


def has_ground(page):
    page.wait("[...document.querySelectorAll('#labels .degrees')].filter((label) => !label.hidden).length > 3", "degrees of latitude and longitude")
    texts = page.ask("[...document.querySelectorAll('#labels .degrees')].map((label) => label.textContent)")
    expect(any(text.startswith("47.0") and text.endswith("N") for text in texts) and any(text.startswith("8.3") and text.endswith("E") for text in texts), f"near the origin of the scene: {texts}")
    before = page.ask("window.reckon.scale")
    expect(f"{before:.0e}"[0] in "125", f"a round length, not {before} m")
    page.press(*"-" * 8)
    page.wait(f"window.reckon.scale > {before}", "a longer scale farther away")
    page.press(*"+" * 8)
    page.wait(f"window.reckon.scale === {before}", "the same scale back")


def has_card(page):
    left, top, right, bottom = page.ask("window.reckon.boxes()[0]")
    canvas = page.driver.find_element("css selector", "canvas")
    x, y = (left + right - canvas.size["width"]) / 2, (top + bottom - canvas.size["height"]) / 2
    ActionChains(page.driver).move_to_element_with_offset(canvas, int(x), int(y)).click().perform()
    page.wait("!document.getElementById('card').hidden", "the card of a clicked entity")
    said = page.text("card")
    for words in ("TRUCK", "Platform Land Switzerland Large Wheeled Utility Vehicle", "1.1.206.7.0.0.0", "neutral", "47.0", "° N", "m/s", "s ago", "site : application", "127.0.0.1"):
        expect(words in said, f"'{words}' in the card: {said}")
    page.press(Keys.ESCAPE)
    page.wait("document.getElementById('card').hidden", "Esc closes it")


def has_switch(page):
    for on in (False, True):
        page.click("lead")
        page.wait(f"window.reckon.auto === {str(on).lower()}", "the switch of the camera")


CASES = {case.__name__: case for case in (sessions, shipped, truck)}

if __name__ == "__main__":
    CASE, RECKON, *FOLDERS = sys.argv[1:]
    needs_browser(RECKON)
    CASES[CASE](RECKON, *FOLDERS)
    print(f"{CASE}: good")
