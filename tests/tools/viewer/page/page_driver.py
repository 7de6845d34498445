# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Chromium with the viewer's page, and the program that serves it."""
import contextlib
import json
import os
import re
import selectors
import signal
import subprocess
import sys
import time

SKIPPED = 77
CHROMIUM = "/usr/bin/chromium"
DRIVER = "/usr/bin/chromedriver"
PATIENCE = 30  # [s] for any expected event; the machine may be busy


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    skip("no python3-selenium: apt-get install chromium chromium-driver python3-selenium")


def needs_browser(reckon):
    for path in (CHROMIUM, DRIVER):
        if not os.access(path, os.X_OK):
            skip(f"no {path}: apt-get install chromium chromium-driver python3-selenium")
    told = subprocess.run([reckon, "demo", "--help"], capture_output=True, text=True, check=False)
    if "--view" not in told.stdout:
        skip("this program serves no page")


class Program:
    """`reckon` with a page; its address is the first one that it prints."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True)
        self.address = self.find_address()

    def find_address(self):
        selector = selectors.DefaultSelector()
        selector.register(self.process.stdout, selectors.EVENT_READ)
        said = []
        while selector.select(PATIENCE):
            line = self.process.stdout.readline()
            said.append(line)
            if found := re.search(r"http://\S+", line):
                return found[0]
            if not line:
                break
        raise AssertionError(f"no address of a page: {''.join(said)}")

    def end(self):
        self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()


@contextlib.contextmanager
def program(*arguments):
    started = Program(*arguments)
    try:
        yield started
    finally:
        started.end()


def record(reckon, scene, file, *flags):
    """Four seconds of the scene's first peer."""
    speaker = subprocess.Popen([reckon, "peer", scene, "--iface", "lo", "--operator", "1", *flags, "--for", "1min", "--json"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        subprocess.run([reckon, "record", file, scene, "--iface", "lo", "--for", "4s"], check=True, capture_output=True)
    finally:
        speaker.terminate()
        speaker.wait(PATIENCE)


@contextlib.contextmanager
def browser():
    options = webdriver.ChromeOptions()
    flags = ["--headless=new", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars", "--disable-background-networking"]
    for flag in flags + (["--no-sandbox"] if os.geteuid() == 0 else []):
        options.add_argument(flag)
    options.binary_location = CHROMIUM
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    started = webdriver.Chrome(service=Service(DRIVER), options=options)
    try:
        yield Page(started)
    finally:
        started.quit()


class Page:
    def __init__(self, driver):
        self.driver = driver

    def size(self, width, height):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def open(self, address, **wishes):
        hash_sign = "&" if "#" in address else "#"
        self.driver.get("about:blank")
        self.driver.get(address + hash_sign + "&".join(f"{name}={value}" for name, value in wishes.items()))

    def ask(self, expression):
        return self.driver.execute_script(f"return {expression}")

    def wait(self, expression, what):
        try:
            WebDriverWait(self.driver, PATIENCE, 0.05).until(lambda _: self.ask(expression))
        except Exception as error:
            raise AssertionError(f"{what}: not within {PATIENCE} s; the page says {self.ask('JSON.stringify(window.reckon)')}, "
                                 f"the console {self.driver.get_log('browser')}") from error

    def wait_for_pictures(self, count=10):
        seen = self.ask("window.reckon?.frames ?? 0")
        self.wait(f"(window.reckon?.frames ?? 0) >= {seen + count}", f"{count} pictures")

    def settled(self, expression):
        """Its value after it stays the same for 1 s and three of the page's longest pictures."""
        before, since = self.ask(expression), time.monotonic()
        while time.monotonic() - since < 1 + self.ask("window.reckon.longest") * 3e-3:
            now = self.ask(expression)
            if now != before:
                before, since = now, time.monotonic()
            time.sleep(0.05)
        return before

    def press(self, *keys):
        actions = ActionChains(self.driver)
        for key in keys:
            actions.send_keys(key)
        actions.perform()

    def click(self, name):
        self.driver.execute_script("document.getElementById(arguments[0]).click()", name)

    def text(self, name):
        return self.ask(f"document.getElementById('{name}').textContent")

    def errors(self):
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def requests(self):
        sent = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [message["params"]["request"]["url"] for message in sent if message["method"] == "Network.requestWillBeSent"]


def expect(holds, what):
    if not holds:
        raise AssertionError(what)


def shows_no_fault(page):
    expect(page.ask("document.documentElement.scrollWidth <= innerWidth"), "no horizontal scroll")
    expect(page.ask("window.reckon.bad") == 0, "no picture is refused")
    errors = page.errors()
    expect(not errors, f"no error in the console: {errors}")
