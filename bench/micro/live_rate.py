#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""How much `reckon inspect` shows of a heavy load on loopback, and whether it counts the rest.

    bench/micro/live_rate.py [--reckon build/release/reckon] [--rate 50000] [--seconds 10] [--view top]

A capture of Entity States is made, `reckon replay` sends it at that many datagrams a second, and
`reckon inspect` listens, all in a network namespace of their own. Prints one JSON object; exit
status 1 where less than 99 % is shown, or less than that was sent of what was asked.
"""
import argparse
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile

GROUP = "239.1.2.3"
PORT = 3000
START = 1_700_000_000
UNITS_PER_HOUR = 2**31 - 1


def entity_state(entity: int, seconds: float, fraction: float) -> bytes:
    """An aircraft in a circle, with dead reckoning by velocity and acceleration (RVW)."""
    timestamp = int((START + seconds) % 3600 / 3600 * UNITS_PER_HOUR) << 1 | 1
    phase = 0.1 * seconds + fraction
    radius, rate = 1000.0, 0.1
    header = struct.pack(">BBBBIHBB", 7, 1, 1, 1, timestamp, 144, 0, 0)
    body = struct.pack(">HHHBB", 1, 2, entity, 1, 0) + bytes([1, 2, 0, 225, 1, 2, 3, 0]) * 2
    body += struct.pack(">fff", 0, -radius * rate * math.sin(phase), radius * rate * math.cos(phase))
    body += struct.pack(">ddd", 6378137, radius * math.cos(phase), radius * math.sin(phase))
    body += struct.pack(">fffI", 0, 0, 0, 0) + bytes([4]) + bytes(15)
    acceleration = radius * rate * rate
    body += struct.pack(">fff", 0, -acceleration * math.cos(phase), -acceleration * math.sin(phase))
    body += struct.pack(">fff", 0, 0, 0) + bytes([1]) + b"VEH%08d" % entity + struct.pack(">I", 0)
    return header + body


def write_capture(path: str, rate: int, seconds: float, entities: int) -> int:
    """Writes a pcap file of raw IP; returns its datagrams."""
    count = int(rate * seconds)
    group = struct.unpack(">I", bytes(int(part) for part in GROUP.split(".")))[0]
    ip = struct.pack(">BBHHHBBHII", 0x45, 0, 172, 1, 0, 1, 17, 0, 0x0A000007, group)
    udp = struct.pack(">HHHH", PORT, PORT, 152, 0)
    with open(path, "wb") as file:
        file.write(struct.pack("<IHHiIII", 0xA1B23C4D, 2, 4, 0, 0, 65535, 101))
        for i in range(count):
            time = i / rate
            nanoseconds = int(time % 1 * 1e9)
            file.write(struct.pack("<IIII", START + int(time), nanoseconds, 172, 172) + ip + udp)
            file.write(entity_state(i % entities + 1, time, i % entities))
    return count


def into_namespace() -> None:
    """Restarts this script in a network namespace, so that nothing reaches the network."""
    user = [] if os.geteuid() == 0 else ["--map-root-user"]
    command = ["unshare", "--net", *user, sys.executable, *sys.argv]
    os.environ["RECKON_LIVE_RATE"] = "1"
    os.execvp(command[0], command)


def measure(options: argparse.Namespace, capture: str, count: int) -> dict:
    listener = subprocess.Popen(
        [options.reckon, "inspect", f"udp://{GROUP}:{PORT}", options.view, "--iface", "lo", "--json",
         "--for", f"{options.seconds + options.patience:g}s"],
        stdout=subprocess.PIPE if options.view == "top" else subprocess.DEVNULL,
        stderr=subprocess.PIPE, text=True)
    said = listener.stderr.readline()  # it listens after this message
    if "listening" not in said:
        sys.exit(said)
    sender = subprocess.run([options.reckon, "replay", capture, "--iface", "lo"],
                            stderr=subprocess.PIPE, text=True, check=False)
    out, err = listener.communicate()
    shown = int(re.search(r"(\d+) PDU", err).group(1))
    dropped = int(re.search(r"(\d+) lost before", err).group(1))
    result = {"view": options.view, "asked_per_s": options.rate, "sent": count, "shown": shown,
              "shown_percent": round(100 * shown / count, 3), "dropped_counted": dropped,
              "unaccounted": count - shown - dropped,
              "replay": sender.stderr.strip().splitlines()[-1:]}
    if options.view == "top":
        result["entities"] = json.loads(out.splitlines()[-1])["entities"]
    return result


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--reckon", default="build/release/reckon")
    parser.add_argument("--rate", type=int, default=50_000, help="datagrams a second")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--entities", type=int, default=1000)
    parser.add_argument("--view", choices=["top", "tail"], default="top")
    parser.add_argument("--patience", type=float, default=5, help="seconds that the listener stays on")
    options = parser.parse_args()
    if "RECKON_LIVE_RATE" not in os.environ:
        into_namespace()
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    with tempfile.TemporaryDirectory() as folder:
        capture = os.path.join(folder, "load.pcap")
        count = write_capture(capture, options.rate, options.seconds, options.entities)
        result = measure(options, capture, count)
    print(json.dumps(result))
    return 0 if result["shown_percent"] >= 99 else 1


if __name__ == "__main__":
    sys.exit(main())
