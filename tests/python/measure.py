#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Costs of the module: build/python/bin/python tests/python/measure.py [PDUS]

Prints Entity States a second by columns, microseconds an object, the speed of another Python thread while a capture
is read, and milliseconds of an import and of the first use. Best of five, each on a separate capture.
"""
import pathlib
import struct
import subprocess
import sys
import tempfile
import threading
import time

import reckon


def write(path, pdus):
    octets = reckon.encode(reckon.EntityState())
    udp = struct.pack(">4H", 3000, 3000, 8 + len(octets), 0) + octets
    ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 0, 0, 1, 17, 0, bytes(4), bytes([239, 192, 1, 0]))
    frame = bytes(12) + b"\x08\x00" + ip + udp
    record = struct.pack("<4I", 1, 0, len(frame), len(frame)) + frame
    path.write_bytes(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1) + record * pdus)


def cpu_of(work):
    begin = time.process_time()
    work()
    return time.process_time() - begin


def pace_beside(work):
    """Counts of another thread while `work` runs, as a share of its counts in the same time without it."""
    counts, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counts[0] += 1

    def counted(during):
        counts[0] = 0
        stop.clear()
        thread = threading.Thread(target=count)
        begin = time.perf_counter()
        thread.start()
        during()
        stop.set()
        took = time.perf_counter() - begin
        thread.join()
        return counts[0] / took

    alone = counted(lambda: time.sleep(0.2))
    return counted(work) / alone


def main():
    pdus = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    octets = reckon.encode(reckon.EntityState())
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "states.pcap"
        write(path, pdus)
        cost = min(cpu_of(lambda: reckon.read_capture(path)) for _ in range(5))
        print(f"columns: {pdus / cost / 1e6:.1f} M PDU/s of CPU time")
        print(f"another thread beside: {max(pace_beside(lambda: reckon.read_capture(path)) for _ in range(5)):.0%} of its pace")
    each = min(cpu_of(lambda: [reckon.decode(octets) for _ in range(100_000)]) for _ in range(5)) / 1e5
    print(f"decode: {each * 1e6:.2f} us an Entity State")
    state = reckon.decode(octets)
    each = min(cpu_of(lambda: [reckon.encode(state) for _ in range(20_000)]) for _ in range(5)) / 2e4
    print(f"encode: {each * 1e6:.2f} us")
    for what, use in (("import", ""), ("import and first use of every part", "; from reckon import *")):
        timed = f"import numpy, time; begin = time.process_time(); import reckon{use}; print(time.process_time() - begin)"
        took = [float(subprocess.run([sys.executable, "-c", timed], capture_output=True, text=True, check=True).stdout)
                for _ in range(5)]
        print(f"{what}: {min(took) * 1e3:.1f} ms beside numpy's")


if __name__ == "__main__":
    main()
