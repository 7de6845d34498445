# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Two tabs take the hands of two peers in the scene of cubes; the page shows the owner of a pushed cube.

  page_owners.py RECKON SCENES     exit status 77 = skipped, with a message
"""
import sys
import time

from page_driver import ActionChains, browser, expect, needs_browser, program, shows_no_fault

CUBE = 2  # index of a bottom cube of the stack; no other cube is in its way along y
ASIDE = 0.06  # [m], from the centre of the cube to the hand before the push
DEEP = 0.012  # [m], from the side of the cube to the target inside it
FAR = 0.005  # [m], least motion of a pushed cube
AWAY = ([-0.02, -0.06, 0.15], [-0.09, -0.09, 0.1])  # [m], places of the second hand away from all cubes
WHEEL = 0.2  # pixels of depth for each pixel of the wheel
PATIENCE = 20  # [s], time-out of a motion


class Tab:
    def __init__(self, page, address, wanted):
        self.page, self.hand = page, wanted
        page.size(1000, 700)
        page.open(address, tour="off")
        self.window = page.driver.current_window_handle
        page.wait("window.reckon?.hands?.length === 2 && window.reckon.owners?.length === 6", "two hands and six cubes with owners")
        page.click("hand")
        page.wait(f"window.reckon.yours === {wanted}", f"the hand {wanted + 1}")
        self.canvas = page.driver.find_element("css selector", "canvas")

    def lead(self, place):
        """Moves the pointer so that the hand goes to the place; another tab may have been in front."""
        self.page.driver.switch_to.window(self.window)
        for _ in range(2):  # a move in depth changes the place on the screen
            x, y, depth = self.page.ask(f"window.reckon.pointerAt({place})")
            size, chain = self.canvas.size, ActionChains(self.page.driver, duration=0)
            chain.move_to_element_with_offset(self.canvas, int(x - size["width"] / 2), int(y - size["height"] / 2)).perform()
            self.page.driver.execute_script("arguments[0].dispatchEvent(new WheelEvent('wheel', {deltaY: arguments[1], bubbles: true, cancelable: true}))",
                                            self.canvas, depth / WHEEL)

    def is_there(self, place):
        return self.page.ask(f"Math.hypot(...window.reckon.hands[{self.hand}].position.map((x, k) => x - {place}[k])) < 0.01")

    def until(self, holds, place, what):
        begin = time.monotonic()
        while not holds():
            expect(time.monotonic() - begin < PATIENCE, f"{what}; the page says {self.page.ask('JSON.stringify(window.reckon)')}")
            self.lead(place)
            time.sleep(0.1)

    def go(self, *places):
        for place in places:
            self.until(lambda: self.is_there(place), place, "the hand follows the pointer")

    def push(self):
        """Pushes the cube along y, and leaves it there."""
        self.page.driver.switch_to.window(self.window)
        x, y, z = self.page.ask(f"window.reckon.bodies[{CUBE}].position")
        above, beside = [x, y - ASIDE, 0.15], [x, y - ASIDE, z]
        self.go(above, beside)
        inside = [x, y - 0.02 + DEEP, z]
        self.until(lambda: self.page.ask(f"window.reckon.bodies[{CUBE}].position[1]") - y > FAR, inside, "the cube is pushed")
        self.page.wait(f"window.reckon.owners[{CUBE}] === {self.hand}", f"the page shows the peer of hand {self.hand + 1} as the owner")
        self.page.wait("[...document.querySelectorAll('#key button')].some((row) => !row.hidden && row.textContent.includes('owner of a body'))",
                       "the legend has the owners")
        self.go(beside, above)


def main(arguments):
    reckon, scenes = arguments
    needs_browser(reckon)
    with program(reckon, "demo", f"{scenes}/cubes.toml", "--view=0", "--for", "10min") as started, browser() as page:
        first = Tab(page, started.address, 0)
        page.driver.switch_to.new_window("window")
        second = Tab(page, started.address, 1)
        second.go(*AWAY)
        first.push()
        page.driver.execute_script("const slider = document.getElementById('delay'); slider.value = 50; slider.dispatchEvent(new Event('input'))")
        page.driver.switch_to.window(second.window)
        page.wait("document.getElementById('delay').value === '50'", "the other tab shows the delay")
        second.push()
        shows_no_fault(page)
    print("good")


if __name__ == "__main__":
    main(sys.argv[1:])
