#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""`reckon inspect` against tshark on the same captures, in turn, on one core.

    bench/micro/against_tshark.py build/release/reckon [--rounds 5] [--core 0] [--wall] [CAPTURE..]

Makes a capture of Entity States, one a datagram, and runs both programs on it; then on each CAPTURE
and, where RECKON_DATA is set, on the recorded sessions in it. Prints one Markdown table a capture:
median of the processor time (user and system), its range, PDUs each second, PDUs seen, and how many
times tshark's time the fastest of the same kind took. Processor time and not the clock on the wall,
as it holds on a machine that does other things too; --wall takes the clock.
"""
import argparse
import csv
import io
import os
import pathlib
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
import time

FIELDS = ["frame.number", "dis.pdu_type", "dis.entity_id_site", "dis.entity_id_application",
          "dis.entity_id_entity"]
START = 1_700_000_000  # s


def entity_state(entity, seconds):
    past_the_hour = (START + seconds) % 3600
    timestamp = int(past_the_hour / 3600 * 2**31) << 1 | 1
    kind = struct.pack(">BBHBBBB", 1, 1, 225, 1, 2, 3, 0)
    return b"".join([
        struct.pack(">BBBBIHBB", 7, 1, 1, 1, timestamp, 144, 0, 0),
        struct.pack(">HHHBB", 100, 7, entity, 1, 0), kind, kind,
        struct.pack(">3f", 3, 4, 0),
        struct.pack(">3d", 4437345.6789 + 3 * seconds, 1061234.5 + 4 * seconds, 4443210.06 + entity),
        struct.pack(">3fI", 0.1, 0.2, 0.3, 0),
        struct.pack(">B15x3f3f", 2, 0, 0, 0, 0, 0, 0),
        b"\1" + f"ENTITY {entity}".encode().ljust(11, b"\0"), struct.pack(">I", 0)])


def write_capture(path, frames):
    ethernet = bytes.fromhex("01005e010203" "020000000001" "0800")
    with open(path, "wb") as file:
        file.write(struct.pack("<IHHiIII", 0xA1B23C4D, 2, 4, 0, 0, 65535, 1))
        for i in range(frames):
            ns = i * 20_000
            pdu = entity_state(1 + i % 100, ns * 1e-9)
            udp = struct.pack(">HHHH", 3000, 3000, len(pdu) + 8, 0) + pdu
            ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, len(udp) + 20, 0, 0, 1, 17, 0,
                             bytes([10, 0, 0, 1]), bytes([239, 1, 2, 3]))
            frame = ethernet + ip + udp
            seconds, rest = divmod(ns, 10**9)
            file.write(struct.pack("<IIII", START + seconds, rest, len(frame), len(frame)) + frame)


def run(command, core, wall):
    """Runs one program; returns its time in seconds and its output."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        begin = time.monotonic()
        child = subprocess.Popen(command, stdout=out, stderr=err,
                                 preexec_fn=lambda: os.sched_setaffinity(0, {core}))
        _, status, usage = os.wait4(child.pid, 0)
        elapsed = time.monotonic() - begin
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read()
        if child.returncode > 1:  # 1: findings in the capture
            err.seek(0)
            sys.exit(f"{' '.join(command)}\nended with {child.returncode}: {err.read().decode()}")
    return (elapsed if wall else usage.ru_utime + usage.ru_stime), text


def pdus_of_fields(text):
    column = (line.split(b"\t")[1] for line in text.splitlines())
    return sum(cell.count(b",") + 1 for cell in column if cell)


def pdus_of_json(text):
    return text.count(b'"dis.pdu_type":')


def pdus_of_stats(text):
    rows = csv.DictReader(io.StringIO(text.decode()))
    return sum(int(row["pdus"]) for row in rows if row["by"] == "type")


def pdus_of_lines(text):
    return text.count(b"\n")


def ports_of(reckon, path):
    """UDP ports of the DIS traffic, for the command line of tshark."""
    text = subprocess.run([reckon, "inspect", path, "stats", "--by", "group", "--csv"], check=False,
                          capture_output=True, text=True).stdout
    return sorted({row["key"].rsplit(":", 1)[1] for row in csv.DictReader(io.StringIO(text))})


def has_view(reckon, view):
    """Whether this build has the view."""
    text = subprocess.run([reckon, "help", "inspect"], capture_output=True, text=True, check=False)
    return f"{view}:" in text.stdout + text.stderr


def commands(reckon, tshark, path):
    """(name, command, function that counts the PDUs, kind of output) for each program on one capture"""
    decode = [word for port in ports_of(reckon, path) for word in ("-d", f"udp.port=={port},dis")]
    fields = [word for field in FIELDS for word in ("-e", field)]
    theirs = [tshark, "-n", "-r", path, *decode, "-T"]
    ours = [reckon, "inspect", path]
    rows = [("tshark -T fields (5 fields)", [*theirs, "fields", *fields], pdus_of_fields, "table"),
            ("reckon inspect stats", [*ours, "stats", "--csv"], pdus_of_stats, "table"),
            ("reckon inspect check", [*ours, "check"], None, "table"),
            ("reckon inspect tail", [*ours, "tail"], pdus_of_lines, "table"),
            ("tshark -T json", [*theirs, "json"], pdus_of_json, "JSON"),
            ("reckon inspect --json", [*ours, "--json"], pdus_of_lines, "JSON"),
            ("reckon inspect --full", [*ours, "--full"], pdus_of_lines, "JSON")]
    if has_view(reckon, "top"):
        rows.insert(1, ("reckon inspect top", [*ours, "top"], None, "table"))
    return rows


def compare(title, paths, options):
    """Runs all programs on all captures, in alternation; the times of the captures are summed."""
    captures = [commands(options.reckon, options.tshark, path) for path in paths]
    names = [(name, kind) for name, _, _, kind in captures[0]]
    seconds = [[] for _ in names]
    seen = []
    for _ in range(options.rounds):
        seen = [0 if row[2] else None for row in captures[0]]
        for i in range(len(names)):
            spent = 0.0
            for _, command, count, _ in (rows[i] for rows in captures):
                time_of_one, text = run(command, options.core, options.wall)
                spent += time_of_one
                if count:
                    seen[i] += count(text) - (1 if command[-1] == "tail" else 0)  # without its header
            seconds[i].append(spent)
    pdus = seen[names.index(("reckon inspect stats", "table"))]
    print(f"\n{title}: {pdus} PDUs, {options.rounds} rounds in turn on core {options.core}\n")
    print("| | s | range | PDU/s | PDUs seen | tshark's time of the same kind |")
    print("|---|---|---|---|---|---|")
    for i, (name, kind) in enumerate(names):
        rival = next(j for j, (other, of) in enumerate(names) if "tshark" in other and of == kind)
        rival_seconds = seconds[rival] if i != rival else None
        print(row_of(name, seconds[i], rival_seconds, pdus, seen[i]), flush=True)


def row_of(name, seconds, rival, pdus, seen):
    median = statistics.median(seconds)
    times = "1"
    if rival:
        ratios = [theirs / ours for theirs, ours in zip(rival, seconds)]
        times = f"{statistics.median(ratios):.0f} x ({min(ratios):.0f} to {max(ratios):.0f})"
    return (f"| `{name}` | {median:.3f} | {min(seconds):.3f} to {max(seconds):.3f} "
            f"| {pdus / median:,.0f} | {'-' if seen is None else seen} | {times} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("reckon", help="the program, build/release/reckon")
    parser.add_argument("captures", nargs="*", help="further captures")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--frames", type=int, default=100_000)
    parser.add_argument("--core", type=int, default=0)
    parser.add_argument("--wall", action="store_true", help="the clock on the wall instead")
    parser.add_argument("--tshark", default="tshark")
    options = parser.parse_args()
    if not shutil.which(options.tshark):
        sys.exit(f"{options.tshark} is not here; apt-get install tshark, or --tshark PATH")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "entity_states.pcap")
        write_capture(path, options.frames)
        compare(f"{options.frames} Entity States, one a datagram", [path], options)
    for path in options.captures:
        compare(os.path.basename(path), [path], options)
    data = os.environ.get("RECKON_DATA")
    sessions = sorted(pathlib.Path(data).glob("dis-captures/real-sessions/*.pcap*")) if data else []
    if sessions:
        compare(f"{len(sessions)} recorded sessions", [str(path) for path in sessions], options)
    else:
        print("\nno recorded sessions: set RECKON_DATA", file=sys.stderr)


if __name__ == "__main__":
    main()
