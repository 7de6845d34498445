# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Creates captures for a test, and runs tshark and `reckon inspect` on them. Standard library only."""
import argparse
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

SKIP = 77  # exit status for a skipped test in ctest


class Skip(Exception):
    """This machine cannot run the case; the text states the reason."""


class Failure(Exception):
    """A failed expectation; the text states the actual result."""


def check(condition, sentence):
    if not condition:
        raise Failure(sentence)


def write_pcap(path, datagrams, port=3000):
    """Writes each datagram in Ethernet, IPv4 and UDP, one a second."""
    with open(path, "wb") as file:
        file.write(struct.pack("<IHHIIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1))
        for number, payload in enumerate(datagrams):
            udp = struct.pack(">HHHH", 40000, port, 8 + len(payload), 0) + payload
            ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), number, 0, 1, 17, 0,
                             bytes((10, 0, 0, 1)), bytes((239, 1, 2, 3)))
            frame = bytes(12) + b"\x08\x00" + ip + udp
            file.write(struct.pack("<IIII", 1_700_000_000 + number, 0, len(frame), len(frame)))
            file.write(frame)


class Tools:
    """tshark with the plug-in, and reckon."""

    def __init__(self, options, folder):
        if not shutil.which("tshark"):
            raise Skip("needs tshark (Debian: tshark)")
        self.options, self.folder = options, pathlib.Path(folder)

    def capture(self, datagrams, port=3000):
        path = self.folder / f"{len(list(self.folder.iterdir()))}.pcap"
        write_pcap(path, datagrams, port)
        return path

    def tshark(self, *arguments):
        """Returns its output; fails if tshark, or Lua in it, reports an error."""
        command = ["tshark", *map(str, arguments), "-X", f"lua_script:{self.options.plugin}"]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        talk = [line for line in result.stderr.splitlines() if "Running as user" not in line]
        damaged = [line for line in talk if "cut short" in line]  # by the capture, not by the plug-in
        check(result.returncode == 0 or damaged, f"tshark: {result.returncode} {talk}")
        check(not re.search(r"(?i)\blua\b", result.stderr), f"tshark says: {talk}")
        check("Lua Error: " not in result.stdout, f"{command}: Lua Error in the tree")
        return result.stdout

    def fields(self, capture, *names, show=None):
        """One dictionary for each frame: name -> list of values as text."""
        more = ["-Y", show] if show else []
        wanted = [word for name in names for word in ("-e", name)]
        text = self.tshark("-n", "-r", capture, *more, "-T", "fields", "-E", "separator=/t", "-E",
                           "aggregator=|", *wanted)
        return [dict(zip(names, (cell.split("|") if cell else [] for cell in line.split("\t"))))
                for line in text.splitlines()]

    def inspect(self, capture, *flags):
        """Rows of `reckon inspect`, by frame."""
        result = subprocess.run([self.options.reckon, "inspect", str(capture), *flags],
                                capture_output=True, text=True, check=False)
        check(result.returncode in (0, 1), f"reckon: {result.stderr}")
        frames = {}
        for line in result.stdout.splitlines():
            row = json.loads(line)
            frames.setdefault(row["frame"], []).append(row)
        return frames

    def samples(self):
        """Golden octets of every PDU type, by name."""
        return {path.stem: bytes.fromhex("".join(line.split("#")[0]
                                                 for line in path.read_text().splitlines()))
                for path in sorted(pathlib.Path(self.options.samples).glob("*.hex"))}

    def data(self, *parts):
        root = os.environ.get("RECKON_DATA") or self.options.data or "/nonexistent"
        folder = pathlib.Path(root).joinpath("dis-captures", *parts)
        if not folder.is_dir():
            raise Skip(f"needs the reference captures in {folder}")
        return sorted(folder.glob("*.pcap"))


def run_case(description, cases):
    """Runs the case that the command line names; returns its exit status."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("case", choices=sorted(cases))
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--samples", required=True)
    parser.add_argument("--data")
    options = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory(prefix="reckon-tshark-") as folder:
            cases[options.case](Tools(options, folder))
    except Skip as reason:
        print(f"skipped: {reason}")
        return SKIP
    except Failure as reason:
        print(f"failed: {reason}", file=sys.stderr)
        return 1
    return 0
