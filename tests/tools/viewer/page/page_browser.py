# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The viewer's page in Chromium, against the program.

  page_browser.py CASE RECKON SCENES     exit status 77 = skipped, with a message

  demo    a demo of two hands: live within 10 s, two themes and two widths without horizontal scroll, no error
          in the console, swap, pause, a second back, live again, keys
  saved   the last minute as one file: plays from disk, asks nobody for anything, runs no other script
  capture the same of a capture, written by `reckon view --save`; names with markup in them are shown as text
  hand    a hand taken by the pointer presses the other one: more than 1 N at both within 5 s, the same within 5 % when held
          still for 3 s, energy never below zero; without delay, and at 100 ms with 20 % loss
  twin    what a hand would feel without the gate: the same without delay, thrown about at 150 ms with 20 % loss, and said
  tour    the tour goes through its five steps by what its user does, and does not come back once left
  peer    a peer lends its own hand: it goes where the pointer goes
  rest    the owner of the bodies is killed: the other peer's bodies rest, and go on by the button, which a tab without the word lacks
  recording  a capture opens with touch large, holds its last moment with somebody in it, and has axes of its own length
  empty   a world in which nobody sends says what to do
  lost    a program that ends is told, and is found again at the same port; a tab with the old word says so
"""
import contextlib
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from page_driver import PATIENCE, ActionChains, Keys, browser, expect, needs_browser, program, record, shows_no_fault, skip

# Numbers of a picture have single precision, and a late step on a busy machine takes energy that the servo cannot
# know in time [J].
PASSIVE = "(hand) => hand.energy + hand.loan >= -1e-6"


def pictures_folder():
    folder = Path.cwd() / "page_pictures"
    folder.mkdir(exist_ok=True)
    return folder


def demo(reckon, scenes):
    with program(reckon, "demo", f"{scenes}/two_hands.toml", "--view=0", "--for", "10min") as started, browser() as page:
        for theme in ("dark", "light"):
            for width, height in ((1280, 800), (400, 860)):
                page.size(width, height)
                page.open(started.address, theme=theme)
                page.wait("window.reckon?.state === 'live' && window.reckon.entities === 2", "two live hands")
                page.wait_for_pictures()
                shows_no_fault(page)
                page.driver.save_screenshot(str(pictures_folder() / f"demo-{theme}-{width}.png"))
        expect(page.ask("window.reckon.large") == "touch", "a demo of hands opens with touch large")
        explains_itself(page)
        overlaps_nothing(page)
        page.press("v")
        page.wait("window.reckon.large === 'world'", "the world large")
        page.press(" ")
        page.wait("window.reckon.play === 'paused'", "paused")
        paused_at = page.settled("window.reckon.time")
        page.click("back-second")
        page.wait(f"Math.abs(window.reckon.time - ({paused_at} - 1)) < 0.1", "a second back")
        page.click("live")
        page.wait(f"window.reckon.play === 'live' && window.reckon.time > {paused_at}", "live again")
        page.press("?")
        page.wait("document.getElementById('keys').open", "the list of keys")
        expect(page.ask("document.querySelectorAll('#keys dt').length") > 15, "each key has its line")
        shows_no_fault(page)
        own = re.match(r"http://[^/]+/", started.address)[0]
        asked = [url for url in page.requests() if not url.startswith((own, "data:", "about:"))]
        expect(not asked, f"nobody else is asked for anything: {asked}")


def explains_itself(page):
    page.wait("document.getElementById('says').textContent.startsWith('Two hands')", "a sentence of what is seen")
    page.size(1280, 800)
    rows = "[...document.querySelectorAll('#key .touch')].filter((row) => !row.hidden).map((row) => row.textContent)"
    page.wait(f"{rows}.includes('solid of the scene')", "a legend of what is in the picture")
    others = {"region of the scene", "tool and its probes", "entity of another peer"} & set(page.ask(rows))
    expect(not others, f"a legend without what is not in the picture: {others}")
    page.driver.execute_script("document.querySelector('#plot-energy h2').focus()")
    page.wait("!document.getElementById('term').hidden", "a term is explained at the focus of the keyboard")
    page.wait("window.reckon.tour === 0", "the tour")
    page.press(Keys.ESCAPE)
    page.wait("window.reckon.tour === null && document.getElementById('tour').hidden", "Esc leaves the tour")


def overlaps_nothing(page):
    """Between the narrow and the wide layout nothing lies on the picture but its own labels."""
    for width, height in ((800, 600), (900, 700), (1000, 700)):
        page.size(width, height)
        page.wait_for_pictures(3)
        boxes = page.ask("['labels', 'push', 'slider', 'plots'].map((id) => document.getElementById(id).getBoundingClientRect()).map((box) => [box.top, box.bottom, box.width])")
        for above, below in zip(boxes, boxes[1:]):
            expect(above[1] <= below[0] + 1, f"at {width} px one below the other: {boxes}")
        expect(boxes[2][2] > 300, f"at {width} px a slider, not a dot: {boxes}")
        shows_no_fault(page)


def saved(reckon, scenes):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "run.html"
        with program(reckon, "demo", f"{scenes}/two_hands.toml", "--view=0", "--for", "10min") as started, browser() as page:
            page.open(started.address)
            page.wait("window.reckon?.pictures > 40", "pictures of some seconds")
            page.driver.set_script_timeout(PATIENCE)
            text = page.driver.execute_async_script("window.reckon.minute().then(arguments[0], (error) => arguments[0](String(error)))")
            expect(text.startswith("<!doctype html>"), f"a saved page, not {text[:200]}")
            file.write_text(text, encoding="utf-8")
        expect(file.stat().st_size <= 4_000_000, f"at most 4 MB, not {file.stat().st_size}")
        with browser() as page:
            plays_from_disk(page, file, 2)
            page.driver.execute_script("document.getElementById('play').click()")
            page.wait("window.reckon.play === 'paused'", "it pauses")
            before = json.dumps(page.ask("window.reckon.target"))
            page.driver.execute_script("document.querySelector('#table tbody tr').click()")
            page.wait(f"Math.hypot(...window.reckon.target.map((x, i) => x - {before}[i])) > 0.001", "a paused picture turns to the followed entity")


def plays_from_disk(page, file, entities):
    page.open(f"file://{file}")
    page.wait(f"window.reckon?.frames > 5 && window.reckon.entities === {entities}", "it plays")
    expect(page.ask("window.reckon.kind") == "saved", "it knows that it is saved")
    asked = [url for url in page.requests() if not url.startswith(("file://", "about:", "data:"))]
    expect(not asked, f"nobody is asked for anything: {asked}")
    expect(page.ask("performance.getEntriesByType('resource').length") == 0, "no resource is loaded")
    page.driver.execute_script("const s = document.createElement('script'); s.textContent = 'window.foreign = 1'; document.body.append(s)")
    expect(page.ask("window.foreign ?? 0") == 0, "no other script runs")
    errors = [text for text in page.errors() if "Content Security Policy" not in text]
    expect(not errors, f"no error in the console: {errors}")


def capture(reckon, scenes):
    markup = "<img src=x onerror='window.foreign=1'></script>"
    marking = "</script><b"  # a marking has eleven letters
    with tempfile.TemporaryDirectory() as folder, resting_hands() as scene:
        heard, file = Path(folder) / f"{markup.replace('/', '%')}.pcapng", Path(folder) / "run.html"
        record(reckon, scene, heard, "--name", marking)
        told = subprocess.run([reckon, "view", heard, "--save", file], check=True, capture_output=True, text=True).stderr
        expect(re.search(r"\d s, 1 entity, \d+ pictures", told), f"it says what is saved: {told}")
        with browser() as page:
            plays_from_disk(page, file, 1)
            page.wait(f"document.getElementById('table').textContent.includes('{marking}')", "the marking as text")
            expect("onerror" in page.text("source"), f"the name of the file as text, not {page.text('source')}")
            expect(page.ask("document.images.length + document.querySelectorAll('#table b').length") == 0, "no element is made of names")
            begin = page.ask("window.reckon.time")
            page.wait(f"window.reckon.time > {begin} || window.reckon.play === 'end'", "time passes")


class OtherHand:
    """The hand of another peer, and the pointer that moves to it."""

    OTHER = "window.reckon.hands.find((hand) => hand.index !== window.reckon.yours).index"
    WHEEL = 0.2  # pixels of depth for each pixel of the wheel

    def __init__(self, page):
        self.page = page
        self.canvas = page.driver.find_element("css selector", "canvas")

    def reach(self):
        x, y = self.page.ask(f"window.reckon.placeOf({self.OTHER})")
        box = self.canvas.size
        chain = ActionChains(self.page.driver, duration=0)
        chain.move_to_element_with_offset(self.canvas, int(x - box["width"] / 2), int(y - box["height"] / 2)).perform()
        turn = self.page.ask(f"window.reckon.depthTo({self.OTHER})") / self.WHEEL
        self.page.driver.execute_script(
            "arguments[0].dispatchEvent(new WheelEvent('wheel', {deltaY: arguments[1], bubbles: true, cancelable: true}))", self.canvas, turn)

    def forces(self):
        return self.page.ask("window.reckon.hands.map((hand) => hand.newtons)")

    def press(self):
        begin = time.monotonic()
        while time.monotonic() - begin < 5:
            self.reach()
            if min(self.forces()) > 1:
                return
        raise AssertionError(f"more than 1 N at both hands within 5 s; felt are {self.forces()}")

    def hold(self):
        """Keeps the pointer still for three seconds, and longer if a busy machine delays the servo; then requires the
        same force over a second."""
        for second in range(PATIENCE):
            sums = self.summed_forces()
            low, high = sorted(sums)
            if second >= 3 and high - low <= 0.05 * high:
                return
        raise AssertionError(f"held still, both feel the same within 5 %: sums over the last second are {low} and {high} N")

    def summed_forces(self):
        """Sums over as many samples as a second has; in none of them is an energy below zero."""
        sums, begin = [0, 0], time.monotonic()
        while time.monotonic() - begin < 1:
            expect(self.page.ask(f"window.reckon.hands.every({PASSIVE})"), "energy never below zero")
            sums = [total + force for total, force in zip(sums, self.forces())]
        return sums


def set_network(page, delay_ms, loss_percent):
    for name, value in (("delay", delay_ms), ("loss", loss_percent)):
        page.driver.execute_script("const slider = document.getElementById(arguments[0]); slider.value = arguments[1];"
                                   "for (const type of ['input', 'change']) slider.dispatchEvent(new Event(type))", name, value)
        # Searched among the last lines, because a line about a peer may come after it.
        page.wait(f"[...document.querySelectorAll('#log-list li')].some((line) => line.textContent.includes(': {name} {value} '))",
                  "the log says what a slider did")


# Two hands that rest beside each other until a pointer moves.
RESTING = """
[scene]
name = "resting hands"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}
[hand]
radius = "10 mm"
k1 = "500 N/m"
[dead_reckoning]
algorithm = "fpw"
position = "0.5 mm"
force = "0.03 N"
[[operator]]
passive = true
position = "-25 0 90 mm"
[[operator]]
passive = true
position = "25 0 90 mm"
"""


@contextlib.contextmanager
def resting_hands():
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "resting.toml"
        # Peers of other programs on this host cannot join.
        scene.write_text(RESTING + f'[network]\ngroup = "239.192.79.0"\nport = {20000 + os.getpid() % 20000}\n')
        yield str(scene)


def hand(reckon, scenes):
    with resting_hands() as scene, program(reckon, "demo", scene, "--view=0", "--for", "10min") as started, browser() as page:
        page.size(1280, 800)
        page.open(started.address)
        page.wait("window.reckon?.hands?.length === 2", "two hands")
        if page.ask("document.getElementById('push').hidden"):
            skip("this program lends no hand")
        page.click("hand")
        page.wait("window.reckon.yours !== null", "a hand")
        other = OtherHand(page)
        for delay_ms, loss_percent in ((0, 0), (100, 20)):
            set_network(page, delay_ms, loss_percent)
            other.press()
            other.hold()
        page.press("h")
        page.wait("window.reckon.yours === null", "the hand is given back")
        shows_no_fault(page)


def twin(reckon, scenes):
    """Without the gate: equal to the felt force without a delay, and oscillating over a bad network, where the hands
    themselves stay calm."""
    with program(reckon, "demo", f"{scenes}/meeting.toml", "--view=0", "--for", "10min") as started, browser() as page:
        page.size(1280, 800)
        page.open(started.address)
        pressed = "window.reckon.hands?.length === 2 && window.reckon.hands.every(({ newtons }) => newtons > 1.8)"
        made = "(window.reckon.numbers.twin ?? []).reduce((sum, { energy }) => sum + energy, 0)"
        page.wait(pressed, "hands that press each other")
        page.wait(f"{pressed} && window.reckon.hands.every((hand) => Math.abs(hand.twin - hand.newtons) < 0.2)", "twins that feel the same")
        expect(page.ask("window.reckon.numbers.twin.every(({ resets }) => resets === 0)"), "no twin is lost")
        set_network(page, 150, 20)
        page.wait(f"{made} < -0.05", "twins that make energy")
        page.wait("window.reckon.hands.some(({ twin }) => twin > 5)", "a twin that is thrown about")
        expect(page.ask(f"window.reckon.hands.every((hand) => ({PASSIVE})(hand) && hand.newtons < 4)"), "hands that stay calm")
        page.wait("[...document.querySelectorAll('#log-list li')].some((line) => line.textContent.includes('their twins were restarted'))",
                  "a line of the log about restarted twins")
        page.wait("[...document.querySelectorAll('.plot')].filter((plot) => plot.parentElement.textContent.includes('without the gate')).length === 2",
                  "lines in the plots of force and energy")
        shows_no_fault(page)
        page.driver.save_screenshot(str(pictures_folder() / "twin.png"))


def tour(reckon, scenes):
    with resting_hands() as scene, program(reckon, "demo", scene, "--view=0", "--for", "10min") as started, browser() as page:
        page.size(1280, 800)
        page.open(started.address)
        page.wait("window.reckon?.tour === 0", "the first step")
        page.click("hand")
        page.wait("window.reckon.tour === 1", "a hand is taken")
        other = OtherHand(page)
        other.press()
        page.wait("window.reckon.tour === 2", "something is pressed")
        set_network(page, 150, 20)
        page.wait("window.reckon.tour === 3", "the network is slow")
        begin = time.monotonic()
        while page.ask("window.reckon.tour") == 3:
            expect(time.monotonic() - begin < 2 * PATIENCE, "the twin shakes while the hands press each other")
            other.reach()
        expect("toured" in page.ask("document.getElementById('plot-energy').className"), "the plot of energy is outlined")
        page.driver.save_screenshot(str(pictures_folder() / "tour.png"))
        page.click("tour-next")
        page.wait("window.reckon.tour === null && document.getElementById('tour').hidden", "the end")
        page.open(started.address)
        page.wait("window.reckon?.hands?.length === 2 && !document.getElementById('twins').hidden", "the page anew")
        page.wait_for_pictures()
        expect(page.ask("window.reckon.tour") is None, "it does not come back")
        page.press("?")
        page.click("tour-again")
        page.wait("window.reckon.tour === 0", "it begins again where its user wants it")
        shows_no_fault(page)


def peer(reckon, scenes):
    with resting_hands() as scene, browser() as page, \
            program(reckon, "peer", scene, "--iface", "lo", "--operator", "1", "--view=0", "--for", "10min") as started:
        page.size(1280, 800)
        page.open(started.address)
        page.wait("window.reckon?.hands?.length === 1", "its hand")
        expect(page.ask("document.getElementById('network').hidden"), "it has no network to change")
        page.click("hand")
        page.wait("window.reckon.yours === 0", "the hand")
        canvas = page.driver.find_element("css selector", "canvas")
        x, y = page.ask("window.reckon.placeOf(0)")
        before = page.ask("window.reckon.hands[0].position")
        chain = ActionChains(page.driver, duration=0)
        for aside in (0, 100):
            chain.move_to_element_with_offset(canvas, int(x - canvas.size["width"] / 2) + aside, int(y - canvas.size["height"] / 2)).perform()
        page.wait(f"Math.hypot(...window.reckon.hands[0].position.map((x, i) => x - {json.dumps(before)}[i])) > 0.005", "it follows the pointer")
        shows_no_fault(page)


def rest(reckon, scenes):
    flags = (f"{scenes}/cubes.toml", "--iface", "lo", "--for", "10min", "--operator")
    owner = subprocess.Popen([reckon, "peer", *flags, "1", "--json"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with browser() as page, program(reckon, "peer", *flags, "2", "--view=0") as started:
        try:
            page.open(started.address)
            page.wait("document.querySelectorAll('#table tbody tr:not([hidden])').length >= 6", "six cubes")
            page.driver.execute_script("[...document.querySelectorAll('#table tbody tr')].find((row) => row.textContent.startsWith('cube')).click()")
            page.wait("document.getElementById('card').textContent.includes('hand-overs')", "the card of a cube says who owns it")
            page.wait("window.reckon.numbers.peers !== undefined", "the owner is received")
        finally:
            owner.kill()
            owner.wait()
        page.wait(rests := "document.getElementById('rest').offsetWidth > 0", "the bodies rest")
        page.open(started.address.split("#")[0])
        page.wait("!document.getElementById('rest').hidden && document.getElementById('rest').offsetWidth === 0", "no button without the word")
        page.open(started.address)
        page.wait(rests, "the button")
        page.click("go-alone")
        page.wait("document.getElementById('rest').hidden", "they go on")
        shows_no_fault(page)


def recording(reckon, scenes):
    there = "window.reckon.entities === 2 && document.getElementById('notice').hidden"
    with program(reckon, "view", f"{scenes}/exercise.pcapng", "--port", "0") as started, browser() as page:
        page.open(started.address)
        page.wait("window.reckon?.play === 'end'", "the end")
        page.wait(f"{there} && document.getElementById('says').textContent.startsWith('Nobody sends')", "the last moment with somebody in it")
        expect(page.ask("window.reckon.large") == "touch", "hands open with touch large")
        expect(page.ask("window.reckon.window") < 4, "plots as long as the capture")
        page.press(" ")
        page.wait("[...document.querySelectorAll('#log-list li')].some((line) => line.textContent.includes('from 0:00.0'))", "it begins anew, and says so")
        page.driver.execute_script("const slider = document.getElementById('slider'); slider.value = slider.min; slider.dispatchEvent(new Event('input'))")
        page.wait("window.reckon.time < 0.1 && window.reckon.entities > 0 && document.getElementById('notice').hidden", "somebody at the begin")
        shows_no_fault(page)


def empty(reckon, scenes):
    with program(reckon, "view", "udp://239.255.77.1:39977", "--iface", "lo", "--port", "0") as started, browser() as page:
        page.open(started.address)
        page.wait("!document.getElementById('notice').hidden", "a notice")
        expect(len(page.ask("document.querySelector('#notice p').textContent")) > 20, "it says what to do")
        shows_no_fault(page)


def lost(reckon, scenes):
    with browser() as page:
        with program(reckon, "demo", f"{scenes}/two_hands.toml", "--view=0", "--for", "10min") as started:
            page.open(started.address)
            page.wait("window.reckon?.state === 'live' && window.reckon.entities === 2", "live")
            port = re.search(r":(\d+)/", started.address)[1]
        page.wait("window.reckon.state === 'lost' && !document.getElementById('notice').hidden", "the loss is told")
        with program(reckon, "demo", f"{scenes}/two_hands.toml", f"--view={port}", "--for", "10min"):
            page.wait("window.reckon.state === 'live' && document.getElementById('notice').hidden", "it comes back by itself")
            page.wait_for_pictures()
            page.wait("document.getElementById('push').textContent.includes('started anew') && document.getElementById('hand').hidden", "an old word is told")


CASES = {case.__name__: case for case in (demo, saved, capture, hand, twin, tour, peer, rest, recording, empty, lost)}


def main(arguments, cases=CASES):
    name, reckon, scenes = arguments
    needs_browser(reckon)
    cases[name](reckon, scenes)
    print(f"{name}: good")


if __name__ == "__main__":
    main(sys.argv[1:])
