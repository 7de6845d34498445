# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Hosts on one LAN inside this machine: network namespaces on a bridge, programs in them, and an observer that
records the traffic. Standard library, root and iproute2; nothing leaves the machine."""
import ctypes
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

from machine import Stalls
from sniffer import SO_RCVBUFFORCE, Sniffer

SKIP = 77  # exit status for a skipped test in ctest
PREFIX = "rk"
SWITCH = "sw"  # the switch in the place of a host
ALL_PACKETS = 0x0003  # ETH_P_ALL
STALL = 0.1              # [s], longest delay by the machine; a fifth of the time that peers in contact allow
PDEATHSIG = 1
_libc = ctypes.CDLL(None, use_errno=True)


class Skip(Exception):
    """This machine cannot run the case; the text states the reason."""


class Failure(Exception):
    """A failed expectation; the text states the actual result."""


def check(condition, sentence):
    if not condition:
        raise Failure(sentence)


def need_root_and_ip():
    if os.geteuid() != 0:
        raise Skip("needs root, to make network namespaces")
    if shutil.which("ip") is None:
        raise Skip("needs the program ip (Debian: iproute2)")
    probe = f"{PREFIX}{os.getpid()}-probe"  # ip remounts file systems, which a chroot may forbid
    try:
        for words in (["netns", "add", probe], ["-n", probe, "link"]):
            done = subprocess.run(["ip", *words], capture_output=True, text=True)
            if done.returncode != 0:
                raise Skip(f"cannot make network namespaces here: {done.stderr.strip()}")
    finally:
        subprocess.run(["ip", "netns", "delete", probe], capture_output=True)


def verdict(run):
    """Runs run() and returns the exit status for the shell, with a message. SIGTERM also cleans up."""
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))
    try:
        run()
    except Skip as reason:
        print(f"skipped: {reason}")
        return SKIP
    except Failure as sentence:
        print(f"FAILED: {sentence}")
        return 1
    return 0


def status_of(run):
    """verdict() of run(folder), with a temporary folder."""
    def with_folder():
        need_root_and_ip()
        with tempfile.TemporaryDirectory(prefix="reckon_") as folder:
            run(folder)
    return verdict(with_folder)


def ip(*words):
    done = subprocess.run(["ip", *words], capture_output=True, text=True)
    if done.returncode != 0:
        text = f"ip {' '.join(words)}: {done.stderr.strip()}"
        raise Skip(text) if "not permitted" in done.stderr else Failure(text)


def _die_with_parent():
    _libc.prctl(PDEATHSIG, signal.SIGKILL)


class Program:
    """A program in a namespace; its lines are collected with the time at which they arrived."""

    def __init__(self, command):
        self.started = time.monotonic()
        self.lines = []   # (seconds since start, text) of stdout
        self.errors = []  # the same of stderr
        self._interrupted = False
        self._changed = threading.Condition()
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True, preexec_fn=_die_with_parent)
        self._readers = [threading.Thread(target=self._read, args=pair, daemon=True)
                         for pair in ((self.process.stdout, self.lines),
                                      (self.process.stderr, self.errors))]
        for reader in self._readers:
            reader.start()

    def _read(self, stream, lines):
        for text in stream:
            with self._changed:
                lines.append((time.monotonic() - self.started, text.rstrip("\n")))
                self._changed.notify_all()

    def seconds(self):
        return time.monotonic() - self.started

    def wait_line(self, pattern, timeout, since=0.0, errors=False):
        """The first line since `since` that matches, as (seconds, text); None after `timeout`."""
        lines = self.errors if errors else self.lines
        end = time.monotonic() + timeout
        with self._changed:
            while True:
                for when, text in lines:
                    if when >= since and re.search(pattern, text):
                        return when, text
                left = end - time.monotonic()
                if left <= 0:
                    return None
                self._changed.wait(left)

    def kill(self):
        """kill -9."""
        self.process.kill()
        self.process.wait()

    def interrupt(self):
        """Ctrl-C, once: a second one would end the program immediately."""
        if not self._interrupted:
            self._interrupted = True
            self.process.send_signal(signal.SIGINT)

    def signal(self, number):
        self.process.send_signal(number)

    def wait(self, timeout=20):
        status = self.process.wait(timeout)
        for reader in self._readers:
            reader.join(5)
        return status

    def end(self):
        """Kills the program if it still runs."""
        if self.process.poll() is None:
            self.kill()

    def error_text(self):
        return "\n".join(text for _, text in self.errors)


class PeerProgram(Program):
    """`reckon peer` with --events --json."""

    def wait_event(self, event, timeout=5.0, marking=None, since=0.0):
        name = f'.*"marking":"{marking}"' if marking else ""
        return self.wait_line(f'"event":"{event}"{name}', timeout, since)

    def events(self, event):
        """Its lines of this kind; `when` is the time of arrival [s] after the program's start."""
        found = []
        for when, text in list(self.lines):
            line = json.loads(text)
            if line.get("event") == event:
                found.append(line | {"when": when})
        return found

    def report(self):
        """Ends the peer with Ctrl-C; returns the object in its last line."""
        self.interrupt()
        status = self.wait()
        check(status == 0, f"peer ended with status {status}: {self.error_text()}")
        check(self.lines, "peer said nothing")
        return json.loads(self.lines[-1][1])


def copied_program(reckon, folder):
    """A copy of `reckon` in the folder, with the programs that it starts: a build may replace the originals during
    the run."""
    for name in ("reckon-peer", "reckon-inspect"):
        shutil.copy(pathlib.Path(reckon).with_name(name), folder / name)
    return shutil.copy(reckon, folder / "reckon")


def remove_leftovers():
    """Removes the namespaces of a run that was killed before its cleanup."""
    for name in os.listdir("/run/netns") if os.path.isdir("/run/netns") else []:
        made_by = re.fullmatch(PREFIX + r"(\d+)-\w+", name)
        if made_by and not os.path.exists(f"/proc/{made_by[1]}"):
            subprocess.run(["ip", "netns", "delete", name], capture_output=True)


class Testbed:
    """`hosts` namespaces 1..hosts with interface e0, address 10.77.0.N, on one bridge. With `snooping` the bridge
    queries memberships and floods nothing; this takes 12 s to start."""

    def __init__(self, hosts, reckon, snooping=False):
        remove_leftovers()
        self.prefix = f"{PREFIX}{os.getpid()}"
        self.programs = []
        self._sniffers = []
        self._hosts = hosts
        self._snooping = snooping
        self._reckon = reckon

    def __enter__(self):
        try:
            self._build()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for sniffer in self._sniffers:
            sniffer.stop()
        for program in self.programs:
            program.end()
        for name in map(self.namespace, [*range(1, self._hosts + 1), SWITCH]):
            subprocess.run(["ip", "netns", "delete", name], capture_output=True)

    def namespace(self, host):
        """Name of the namespace of a host, or of the SWITCH."""
        return f"{self.prefix}-{host}"

    @staticmethod
    def address(host):
        return f"10.77.0.{host}"

    def _build(self):
        switch = self.namespace(SWITCH)
        ip("netns", "add", switch)
        on = "1" if self._snooping else "0"
        ip("-n", switch, "link", "add", "br0", "type", "bridge", "mcast_snooping", on,
           "mcast_querier", on)
        ip("-n", switch, "link", "set", "br0", "up")
        for host in range(1, self._hosts + 1):
            name = self.namespace(host)
            ip("netns", "add", name)
            ip("-n", name, "link", "set", "lo", "up")
            self.plug(host)
        if self._snooping:
            time.sleep(12)  # until the bridge has become the querier

    def plug(self, host, address=None):
        """Gives a host its interface e0, with a new identity after unplug()."""
        name, switch = self.namespace(host), self.namespace(SWITCH)
        ip("link", "add", "e0", "netns", name, "type", "veth", "peer", "name", f"p{host}",
           "netns", switch)
        ip("-n", switch, "link", "set", f"p{host}", "master", "br0", "up")
        ip("-n", name, "addr", "add", f"{address or self.address(host)}/24", "dev", "e0")
        ip("-n", name, "link", "set", "e0", "up")
        ip("-n", name, "route", "add", "224.0.0.0/4", "dev", "e0")

    def unplug(self, host):
        """Removes the interface of a host completely."""
        ip("-n", self.namespace(host), "link", "delete", "e0")

    def pull(self, host, back=False):
        """Disconnects the cable of a host at the switch, or connects it again."""
        ip("-n", self.namespace(SWITCH), "link", "set", f"p{host}", "up" if back else "down")

    def narrow(self, host, rate):
        """Limits the rate from the switch to a host, for example to "64kbit"."""
        done = subprocess.run(["tc", "-n", self.namespace(SWITCH), "qdisc", "add", "dev", f"p{host}", "root",
                               "tbf", "rate", rate, "burst", "3k", "latency", "200ms"],
                              capture_output=True, text=True)
        check(done.returncode == 0, f"tc: {done.stderr.strip()}")

    def slow(self, host, rate):
        """Limits the rate of a host's own cable, for example to "64kbit"; waiting frames are not dropped."""
        self.system(host, f"tc qdisc add dev e0 root tbf rate {rate} burst 3k limit 16m")

    def lose(self, host, share, ports="3000"):
        """Drops one of `share` datagrams from the switch to a host on these ports, at random."""
        sent = f'oifname "p{host}" udp dport {ports}'
        rules = f"{sent} counter; {sent} numgen random mod {share} == 0 counter drop"
        self.system(SWITCH, f"nft 'table bridge t{host} {{ chain c {{ type filter hook forward priority 0; {rules}; }}; }}'")

    def forwarded_and_lost(self):
        """Frames that lose() has counted: total, and lost."""
        found = re.findall(r"counter packets (\d+)", self.system(SWITCH, "nft list ruleset"))
        return tuple(map(int, found))

    def ip(self, host, *words):
        """Runs ip in the namespace of a host."""
        ip("-n", self.namespace(host), *words)

    def system(self, host, command):
        """Runs a shell command in a host, or at the SWITCH; returns its output."""
        done = subprocess.run(["ip", "netns", "exec", self.namespace(host), "sh", "-c", command],
                              capture_output=True, text=True)
        check(done.returncode == 0, f"{command}: {done.stderr.strip()}")
        return done.stdout

    def firewall(self, host, hook, rule):
        """Adds a rule of nftables in a host."""
        self.system(host, f"nft 'table inet t {{ chain c {{ type filter hook {hook} priority 0; "
                          f"{rule}; }}; }}'")

    def run(self, host, command, kind=Program):
        program = kind(["ip", "netns", "exec", self.namespace(host), *command])
        self.programs.append(program)
        return program

    def peer(self, host, scene, name, operator=1, more=()):
        """Starts `reckon peer` in a host."""
        return self.run(host, [self._reckon, "peer", str(scene), "--iface", "e0", "--name", name,
                               "--operator", str(operator), "--events", "--json", *more],
                        PeerProgram)

    def socket(self, host, *arguments):
        """A socket in the namespace of a host."""
        return self._socket(self.namespace(host), *arguments)

    @staticmethod
    def _socket(namespace, *arguments):
        home = os.open("/proc/thread-self/ns/net", os.O_RDONLY)
        there = os.open(f"/run/netns/{namespace}", os.O_RDONLY)
        try:
            check(_libc.setns(there, 0) == 0, "setns failed")
            return socket.socket(*arguments)
        finally:
            check(_libc.setns(home, 0) == 0, "could not return to the own network namespace")
            os.close(there)
            os.close(home)

    def switch_socket(self):
        """A socket that receives each frame that passes the switch."""
        return self._socket(self.namespace(SWITCH), socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ALL_PACKETS))

    def sniff(self):
        """Records the datagrams of all hosts."""
        sock = self.switch_socket()
        sock.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, 1 << 25)
        self._sniffers.append(Sniffer(sock))
        return self._sniffers[-1]

    def multicast_sender(self, host):
        sock = self.socket(host, socket.AF_INET, socket.SOCK_DGRAM)
        sock.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF,
                        socket.inet_aton(self.address(host)))
        return sock

    def multicast_receiver(self, host, group, port):
        sock = self.socket(host, socket.AF_INET, socket.SOCK_DGRAM)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        sock.bind((group, port))
        sock.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                        struct.pack("4s4s", socket.inet_aton(group),
                                    socket.inet_aton(self.address(host))))
        sock.settimeout(0.1)
        return sock


def main(cases, run):
    """Runs the case named on the command line: exit status 0, 1 or SKIP."""
    name = sys.argv[1] if len(sys.argv) > 1 else ""
    if name not in cases:
        print(f"usage: {sys.argv[0]} CASE ...; CASE is one of {', '.join(cases)}", file=sys.stderr)
        return 2

    def served():
        stalls = Stalls()
        try:
            run(cases[name])
        except Failure as sentence:
            time.sleep(2 * Stalls.PERIOD)  # the process itself may have been delayed
            if stalls.worst < STALL:
                raise
            # Live peers need processor time: a failure on a stalled machine is not a verdict.
            print(f"FAILED: {sentence}; but this machine stood still for {stalls.worst:.2f} s: once more", flush=True)
            run(cases[name])
        print("passed")
    return verdict(served)
