# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The page of a peer under attack, with numbers drawn from a seed: tabs that never read or read everything, with a
wrong word or none; requests that never end; from the LAN and from the peer's own host. Meanwhile its user opens tabs
with the right word."""
import random
import re
import selectors
import socket
import ssl
import statistics
import subprocess
import threading
import time

from testbed import Testbed, check

NAME = "page"
ALICE, MALLORY = 1, 3
SECONDS = 6.0
FIRST_PICTURE = 0.5  # [s] until the user's tab has one, during any attack
EVERY = 0.3          # [s] between two tabs of the user
AT_ONCE = 20         # connections that strangers open before a pause
PAUSE = 0.005        # [s]
MARKING = "ALICE"
PICTURE = b"RKV4"  # start of a picture


class Drawn:
    """The numbers of an attack."""

    def __init__(self, seed):
        draw = random.Random(f"{NAME} {seed}")
        self.has_key, self.has_tls = draw.random() < 0.75, draw.random() < 0.5
        self.silent, self.readers = draw.randrange(64, 301), draw.randrange(8, 65)
        self.heads = draw.randrange(64, 501)
        self.from_own_host = draw.choice((0.0, 0.5, 1.0))
        self.draw = draw
        self.sentence = (f"{self.silent} silent tabs, {self.readers} that read, {self.heads} half heads, "
                         f"{100 * self.from_own_host:.0f} % from its own host, {'with' if self.has_key else 'without'} a "
                         f"key, {'https' if self.has_tls else 'http'}")

    def word(self):
        return self.draw.choice(("", "", f"?word={self.draw.getrandbits(128):032x}", "?word=" + "0" * 32))


def request(address, word):
    scheme, host = address.split("//")
    return (f"GET /stream{word} HTTP/1.1\r\nHost: {host}\r\nOrigin: {scheme}//{host}\r\nUpgrade: websocket\r\n"
            "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n").encode()


class Strangers(threading.Thread):
    """The attackers' connections, each replaced after it is closed."""

    def __init__(self, bed, drawn, address):
        super().__init__(daemon=True)
        self._ended = threading.Event()
        self._bed, self._drawn, self._address = bed, drawn, address
        self._port = int(address.rsplit(":", 1)[1])
        self._waiting = ["silent"] * drawn.silent + ["reader"] * drawn.readers + ["head"] * drawn.heads
        drawn.draw.shuffle(self._waiting)
        self._open = {}  # socket: kind
        self._readable = selectors.DefaultSelector()
        self.pictures = self.named = self.opened = 0

    def run(self):
        while not self._ended.wait(PAUSE):
            self._step()

    def _step(self):
        """Opens some connections that are closed, and reads the available data for those that read."""
        for _ in range(min(AT_ONCE, len(self._waiting))):
            self._begin(self._waiting.pop(0))
        for key, _ in self._readable.select(0):
            self._take(key.fileobj)

    def end(self):
        """Stops, and reads the data that was sent to silent connections."""
        self._ended.set()
        self.join()
        for sock in list(self._open):
            if self._open[sock] == "silent":
                self._take(sock, again=False)
            sock.close()

    def _begin(self, kind):
        own = self._drawn.draw.random() < self._drawn.from_own_host
        sock = self._bed.socket(ALICE if own else MALLORY, socket.AF_INET, socket.SOCK_STREAM)
        try:
            if own:
                sock.bind((f"127.0.0.{self._drawn.draw.randrange(1, 20)}", 0))
            sock.settimeout(0.5)
            sock.connect(("127.0.0.1" if own else Testbed.address(ALICE), self._port))
            if kind == "head":
                sock.send(b"\x16\x03\x01" if self._drawn.has_tls else b"GET / HTTP/1.1\r\nHost: ")
            else:
                sock = secured(sock) if self._drawn.has_tls else sock
                sock.send(request(self._address, self._drawn.word()))
            sock.setblocking(False)
        except OSError:
            sock.close()
            return self._waiting.append(kind)
        self.opened += 1
        self._open[sock] = kind
        if kind != "silent":
            self._readable.register(sock, selectors.EVENT_READ)

    def _take(self, sock, again=True):
        try:
            while octets := sock.recv(1 << 16):
                self.pictures += octets.count(PICTURE)
                self.named += octets.count(MARKING.encode())
        except (BlockingIOError, ssl.SSLWantReadError):
            return
        except OSError:
            pass
        if again:
            self._readable.unregister(sock)
            self._waiting.append(self._open.pop(sock))
            sock.close()


def secured(sock):
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    return context.wrap_socket(sock)


def first_picture(bed, drawn, address, word, host):
    """Seconds from the user's connection to the first picture; None if none arrives."""
    begin = time.monotonic()
    sock = bed.socket(host, socket.AF_INET, socket.SOCK_STREAM)
    with sock:
        sock.settimeout(2 * FIRST_PICTURE)
        try:
            sock.connect(("127.0.0.1" if host == ALICE else Testbed.address(ALICE), int(address.rsplit(":", 1)[1])))
            secure = secured(sock) if drawn.has_tls else sock
            secure.sendall(request(address, f"?word={word}"))
            while octets := secure.recv(1 << 16):
                if PICTURE in octets:
                    return time.monotonic() - begin
        except OSError:
            pass
    return None


def start(setup, bed, drawn):
    """(peer, address, word) of the attacked page."""
    more = ["--view=0", "--listen", "0.0.0.0"]
    if drawn.has_key:
        key = setup.folder / "page.key"
        key.unlink(missing_ok=True)
        subprocess.run([setup.reckon, "key", "new", str(key)], check=True, capture_output=True)
        more += ["--key", str(key)]
    if drawn.has_tls:
        files = [str(setup.folder / f"page.{end}") for end in ("crt", "pem")]
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
                        "-subj", "/CN=page", "-days", "2", "-out", files[0], "-keyout", files[1]], check=True,
                       capture_output=True)
        more += ["--tls", *files]
    else:
        more.append("--behind-tunnel")
    peer = bed.peer(ALICE, setup.scene, MARKING, more=more)
    line = peer.wait_line(r"page: \S+#word=", 10, errors=True)
    check(line, f"no page: {peer.error_text()}")
    return (peer, *re.search(r"page: (\S+)/#word=(\w+)", line[1]).groups())


def attack(setup, seed):
    """Requirements that the attack of this seed violated; empty if the page passed."""
    drawn = Drawn(seed)
    with setup.testbed(MALLORY) as bed:
        peer, address, word = start(setup, bed, drawn)
        strangers, times = Strangers(bed, drawn, address), []
        strangers.start()
        begin = time.monotonic()
        while time.monotonic() - begin < SECONDS:
            turn = time.monotonic()
            times.append(first_picture(bed, drawn, address, word, drawn.draw.choice((ALICE, MALLORY - 1))))
            time.sleep(max(0.0, EVERY - (time.monotonic() - turn)))
        strangers.end()
        peer.report()
    seen = [seconds for seconds in times if seconds is not None]
    problems = [f"{len(times) - len(seen)} of {len(times)} tabs of the user without a picture"] if len(seen) < len(times) else []
    if seen and max(seen) > FIRST_PICTURE:
        problems.append(f"the user's first picture after {max(seen):.2f} s")
    if drawn.has_key and (strangers.pictures or strangers.named):
        problems.append(f"{strangers.pictures} pictures and {strangers.named} names without the word")
    told = f"median {statistics.median(seen):.3f} s, longest {max(seen):.3f} s" if seen else "never"
    print(f"| page {seed}: {drawn.sentence} | {strangers.opened} opened | pictures without the word {strangers.pictures} | "
          f"first picture of the user's {len(times)} tabs {told} | {'; '.join(problems) or 'held'} |", flush=True)
    return problems


def hostile_page(setup):
    """A page under attacks that seeds draw: its user has pictures at once; with a key nobody else has any."""
    first = random.randrange(10**6) if setup.seed is None else setup.seed
    problems = [problem for seed in range(first, first + setup.runs) for problem in attack(setup, seed)]
    check(not problems, "; ".join(problems))
