# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A gamepad and a finger on the viewer's page in Chromium, whose motors are replaced by a record.

  page_haptics.py CASE RECKON SCENES     exit status 77 = skipped, with a message

  pad      a gamepad takes a hand and moves it to the other one: no rumble before the contact, rumble that grows with the force at
           it, none after the pad is pulled out, which releases the hand; the other pad of two then moves it
  strange  a pad without the standard mapping is named and moves nothing; a browser without gamepads, or one that forbids them, works
  phone    a finger that moves the hand to the other one: pulses at contact, none after it is lifted or the switch is off
"""
import contextlib
import sys
import time

from page_browser import OtherHand, main, pictures_folder, resting_hands
from page_driver import PATIENCE, browser, expect, program, shows_no_fault

# Records each command to a motor, and whether the newest message about a hand holds it.
RECORD = """
window.rumbles = []; window.pulses = []; window.pads = [null]; window.holds = null;
const send = WebSocket.prototype.send;
WebSocket.prototype.send = function (data) {
  const octets = new Uint8Array(data);
  if (octets[0] === 6) window.holds = octets[15];
  return send.call(this, data);
};
window.makePad = (index, id, mapping = 'standard') => {
  const note = (more) => window.rumbles.push({ index, at: performance.now(), ...more });
  window.pads[index] = {
    index, id, mapping, connected: true, axes: [0, 0, 0, 0], buttons: Array.from({ length: 17 }, () => ({ pressed: false, value: 0 })),
    vibrationActuator: {
      playEffect: (type, wanted) => { note({ type, ...wanted }); return Promise.reject(new Error('a motor that refuses')); },
      reset: () => { note({ reset: true }); return Promise.resolve('complete'); },
    },
  };
};
window.press = (index, button, value) => { window.pads[index].buttons[button] = { pressed: value > 0, value }; };
navigator.getGamepads = () => window.pads;
navigator.vibrate = (length) => { window.pulses.push({ at: performance.now(), length }); return true; };
"""
PLAYED = "window.rumbles.filter(({ type }) => type === 'dual-rumble')"
MINE = "window.reckon.hands.find(({ index }) => index === window.reckon.yours)"


@contextlib.contextmanager
def page_of(reckon, script=RECORD):
    with resting_hands() as scene, program(reckon, "demo", scene, "--view=0", "--for", "10min") as started, browser() as page:
        page.size(1280, 800)
        page.driver.execute_cdp_cmd("Emulation.setFocusEmulationEnabled", {"enabled": True})
        page.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": script == RECORD, "maxTouchPoints": 1})
        page.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": script})
        page.open(started.address, tour="off")
        page.wait("window.reckon?.hands?.length === 2 && window.reckon.large === 'touch'", "two hands")
        yield page


def run(page, script, *values):
    page.driver.execute_script(script, *values)


def tap(page, pad, button):
    """Presses a button for some pictures of the page."""
    for value in (1, 0):
        run(page, "press(arguments[0], arguments[1], arguments[2])", pad, button, value)
        page.wait_for_pictures(3)


def stick(error):
    """Place of a stick for a way [pixels]: beyond the dead zone, slower nearby."""
    return 0 if abs(error) < 2 else max(-1, min(1, error / 300 + (0.3 if error > 0 else -0.3)))


def steer(page, index):
    """Turns the sticks towards the other hand."""
    x, y = page.ask(f"window.reckon.placeOf({MINE}.index)")
    to_x, to_y = page.ask(f"window.reckon.placeOf({OtherHand.OTHER})")
    nearer = page.ask(f"window.reckon.depthTo({OtherHand.OTHER})")
    run(page, "pads[arguments[0]].axes = arguments[1]", index, [stick(to_x - x), stick(to_y - y), 0, stick(nearer)])


def press_by(page, step):
    """Repeats a step towards the other hand until it is pressed."""
    begin = time.monotonic()
    while page.ask(f"{MINE}.newtons") < 1:
        expect(time.monotonic() - begin < PATIENCE, f"more than 1 N: {page.ask('JSON.stringify(window.reckon.hands)')}")
        step()


def press_by_sticks(page):
    press_by(page, lambda: steer(page, 2))
    run(page, "pads[2].axes = [0, NaN, 0]")  # at rest, with one that is missing


def pad(reckon, scenes):
    with page_of(reckon) as page:
        expect(page.ask("document.getElementById('pad').hidden"), "nothing about pads before there is one")
        run(page, "makePad(2, 'Test Pad (STANDARD GAMEPAD Vendor: 045e Product: 028e)'); makePad(1, '0810-0001-Other Pad')")
        page.wait("document.getElementById('pad').textContent.includes('takes a hand')", "the pad is named")
        tap(page, 2, 0)
        page.wait("window.reckon.yours !== null", "a hand by the first button")
        expect(page.ask("window.holds") is None, "a hand that is taken stays where it is")
        expect(page.ask(f"{PLAYED}.length") == 0, "no rumble before a contact")
        steer(page, 2)
        page.wait("window.holds === 1", "the sticks hold it")
        run(page, "pads[1].axes = [1, 0, 0, 0]")  # moves nothing, because the first pad holds the hand
        press_by_sticks(page)
        run(page, "pads[1].axes = [0, 0, 0, 0]")
        rumbles(page)
        says = page.text("pad")
        expect("“Test Pad” moves hand 1" in says and "no direction and no newtons" in says, f"which pad, which hand: {says}")
        for width, height in ((1280, 800), (390, 844)):
            page.size(width, height)
            page.wait_for_pictures(3)
            page.driver.save_screenshot(str(pictures_folder() / f"pad-{width}.png"))
            shows_no_fault(page)
        holds_and_pauses(page)
        pulls_out(page)


def rumbles(page):
    """At a steady force: the strong motor in proportion to it, no slip, renewed in time, never far ahead."""
    last = f"({{ strongMagnitude, weakMagnitude }}) => Math.abs(strongMagnitude - Math.min(1, {MINE}.newtons / 5)) < 0.1 && weakMagnitude < 0.05"
    page.wait(f"{PLAYED}.length > 8 && {PLAYED}.slice(-3).every({last})", "rumble is renewed at rest, as strong as the force")
    played = page.ask(PLAYED)
    expect({one["index"] for one in played} == {2}, "the pad that moves the hand rumbles")
    expect(all(one["duration"] <= 100 and one["startDelay"] == 0 for one in played), "never more than 100 ms ahead")
    expect(played[0]["strongMagnitude"] >= 0.8, f"a pulse as the contact begins: {played[0]}")


def quiet(page, motor, what):
    """No command reaches the motor for half a second."""
    page.wait(f"performance.now() - (({motor}).at(-1)?.at ?? 0) > 500", what)


def holds_and_pauses(page):
    run(page, "press(2, 0, 1)")
    page.wait("window.holds === 2", "A holds what it touches")
    run(page, "press(2, 0, 0)")
    page.wait("window.holds === 1", "until it is let go")
    page.click("play")
    quiet(page, PLAYED, "no rumble while paused")
    page.click("live")
    count = page.ask(f"{PLAYED}.length")
    page.wait(f"{PLAYED}.length > {count}", "rumble again")
    run(page, "window.dispatchEvent(new Event('blur'))")
    quiet(page, PLAYED, "no rumble in a page without the focus")
    expect(page.ask("window.holds === 0 && 'reset' in window.rumbles.at(-1)"), "it releases the hand and stops the motors")
    page.wait(f"{MINE}.newtons < 0.5", "the other hand pushes it away")
    press_by_sticks(page)
    page.wait("window.holds === 1", "the sticks hold it again")


def pulls_out(page):
    run(page, "window.pads[2] = null")
    page.wait("window.holds === 0", "a pad that is pulled out releases the hand")
    page.wait("[...document.querySelectorAll('#log-list li')].some((line) => line.textContent.includes('“Test Pad” is disconnected; hand 1 is released.'))",
              "the log says so")
    quiet(page, PLAYED, "no rumble of a pad that is gone")
    page.wait(f"{MINE}.newtons < 0.5", "the other hand pushes it away")
    run(page, "window.pads[1].axes = [0, -1, 0, 0]")
    page.wait("window.holds === 1 && document.getElementById('pad').textContent.includes('“Other Pad” moves hand 1')", "the other pad moves it then")
    tap(page, 1, 1)
    page.wait("window.reckon.yours === null", "B releases it")
    shows_no_fault(page)


def strange(reckon, scenes):
    with page_of(reckon) as page:
        run(page, "makePad(1, 'Flight Stick', ''); pads[1].axes = [-1]; press(1, 0, 1)")
        page.wait("document.getElementById('pad').textContent.includes('“Flight Stick”: this browser does not know its layout')", "it is named")
        page.wait_for_pictures(5)
        expect(page.ask("window.reckon.yours === null && window.holds === null"), "it moves nothing")
        run(page, "makePad(1, 'Bare'); pads[1].axes = []; delete pads[1].vibrationActuator; press(1, 0, 1)")
        page.wait("window.reckon.yours !== null && document.getElementById('pad').textContent.includes('It has no rumble in this browser')", "a pad of no axes")
        run(page, "press(1, 7, 1)")
        page.wait("window.holds === 1", "its trigger moves the hand")
        shows_no_fault(page)
    for absent in ("Object.defineProperty(navigator, 'getGamepads', { value: undefined })", "navigator.getGamepads = () => { throw new Error('forbidden') }"):
        with page_of(reckon, absent) as page:
            page.click("hand")
            page.wait("window.reckon.yours !== null", "a hand")
            page.wait_for_pictures(5)
            shows_no_fault(page)


def touch(page, kind, *points):
    page.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})


def finger_to_other(page, kind):
    """The finger goes to the other hand; the depth is by the wheel."""
    top = page.ask("document.querySelector('canvas').getBoundingClientRect().top")
    x, y = page.ask(f"window.reckon.placeOf({OtherHand.OTHER})")
    touch(page, kind, {"x": x, "y": top + y})
    turn = page.ask(f"window.reckon.depthTo({OtherHand.OTHER})") / OtherHand.WHEEL
    run(page, "document.querySelector('canvas').dispatchEvent(new WheelEvent('wheel', { deltaY: arguments[0] }))", turn)


def phone(reckon, scenes):
    with page_of(reckon) as page:
        page.size(390, 844)
        page.wait("!document.getElementById('push').hidden && !document.getElementById('vibrates').hidden", "a switch")
        page.click("hand")
        page.wait("window.reckon.yours !== null", "a hand")
        page.wait_for_pictures(3)
        finger_to_other(page, "touchStart")
        press_by(page, lambda: finger_to_other(page, "touchMove"))
        page.wait("window.pulses.length > 5", "pulses at contact")
        page.driver.save_screenshot(str(pictures_folder() / "phone.png"))
        pulses = page.ask("window.pulses.map(({ length }) => length)")
        expect(all(0 <= length <= 100 for length in pulses), f"never more than 100 ms ahead: {pulses}")
        expect(page.ask("window.rumbles.length") == 0, "a finger moves no motor of a pad")
        page.click("vibrate")
        page.wait("window.pulses.at(-1).length === 0", "they are stopped at the next picture")
        quiet(page, "window.pulses", "none while the switch is off")
        page.click("vibrate")
        count = page.ask("window.pulses.length")
        page.wait(f"window.pulses.length > {count} + 2", "pulses again")
        touch(page, "touchEnd")
        quiet(page, "window.pulses", "none after the finger is lifted")
        shows_no_fault(page)


CASES = {case.__name__: case for case in (pad, strange, phone)}


if __name__ == "__main__":
    main(sys.argv[1:], CASES)
