# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Shared parts of the tests of the Python package: golden samples, captures of PDUs, paths."""
import os
import pathlib
import struct
import subprocess
import sys

SOURCES = pathlib.Path(os.environ["RECKON_SOURCES"])
PROGRAM = os.environ["RECKON_PROGRAM"]


def golden():
    """Name and octets of each golden sample."""
    for path in sorted((SOURCES / "tests/support/wire_samples").glob("*.hex")):
        digits = "".join(line.split("#")[0] for line in path.read_text().splitlines())
        yield path.stem, bytes.fromhex("".join(digits.split()))


def frame(payload):
    """The payload in UDP, IPv4 and Ethernet."""
    udp = struct.pack(">4H", 3000, 3000, 8 + len(payload), 0) + payload
    ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 0, 0, 1, 17, 0, bytes([10, 0, 0, 1]), bytes([239, 192, 1, 0]))
    return bytes(12) + b"\x08\x00" + ip + udp


def write_capture(path, datagrams):
    """datagrams: (time [s], octets)"""
    with open(path, "wb") as out:
        out.write(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1))
        for time, octets in datagrams:
            whole = frame(octets)
            out.write(struct.pack("<4I", int(time), round(time % 1 * 1e6), len(whole), len(whole)) + whole)


def fuzz_seeds(folder):
    """The initial files of the fuzz targets for PDUs and bundles."""
    subprocess.run([sys.executable, "-B", str(SOURCES / "tests/fuzz/seeds.py"), str(folder)], check=True,
                   stdout=subprocess.DEVNULL)
    for target in ("pdu", "bundle"):
        yield from sorted((pathlib.Path(folder) / "seeds" / target).iterdir())
