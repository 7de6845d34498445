#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""What the wire costs, as Markdown: Entity State against memcpy, and every PDU type in one table.

    bench/micro/wire_costs.py build/release/bench [--repetitions 5] [--core 0]

Runs pdu_bench and every_pdu_bench of that folder, pinned to one core.
"""
import argparse
import json
import os
import statistics
import subprocess


def rows_of(program, options, pattern, repetitions):
    """{name: [row of each repetition]} of one Google Benchmark program."""
    command = [os.path.join(options.folder, program), f"--benchmark_filter={pattern}",
               f"--benchmark_repetitions={repetitions}", "--benchmark_format=json",
               "--benchmark_enable_random_interleaving=true",
               f"--benchmark_min_time={options.seconds}"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True,
                          preexec_fn=lambda: os.sched_setaffinity(0, {options.core}))
    rows = {}
    for row in json.loads(done.stdout)["benchmarks"]:
        if row.get("error_occurred"):
            raise SystemExit(f"{program}: {row['name']}: {row['error_message']}")
        if row["run_type"] == "iteration":
            rows.setdefault(row["run_name"], []).append(row)
    return dict(sorted(rows.items(), key=lambda item: (item[1][0]["family_index"],
                                                       item[1][0]["per_family_instance_index"])))


def print_against_memcpy(options):
    known = [statistics.median(row["cpu_time"] for row in rows) for rows in
             rows_of("pdu_bench", options, "MemcpyOfKnownSize", options.repetitions).values()]
    print("| octets | memcpy ns | of a size known to the compiler ns | encode ns | x memcpy (p10 to p90) "
          "| decode ns | x memcpy (p10 to p90) |")
    print("|---|---|---|---|---|---|---|")
    for rows in rows_of("pdu_bench", options, "AgainstMemcpy", options.repetitions).values():
        value = {key: statistics.median(row[key] for row in rows)
                 for key, first in rows[0].items() if isinstance(first, float)}
        print(f"| {value['octets']:.0f} | {value['memcpy_ns']:.2f} | {known.pop(0):.2f} ", end="")
        for way in ("encode", "decode"):
            ratio = way + "_ratio"
            print(f"| {value[way + '_ns']:.2f} | {value[ratio]:.2f} "
                  f"({value[ratio + '_p10']:.2f} to {value[ratio + '_p90']:.2f}) ", end="")
        print("|")


def print_every_type(options):
    rows = rows_of("every_pdu_bench", options, ".", options.repetitions)
    print("\n| PDU | octets | decode ns | encode ns | decode ns/octet | encode ns/octet |")
    print("|---|---|---|---|---|---|")
    for name in (name.removeprefix("Decode/") for name in rows if name.startswith("Decode/")):
        decode, encode = (statistics.median(row["cpu_time"] for row in rows[way + name])
                          for way in ("Decode/", "Encode/"))
        octets = rows["Decode/" + name][0]["octets"]
        print(f"| {name} | {octets:.0f} | {decode:.1f} | {encode:.1f} | {decode / octets:.3f} "
              f"| {encode / octets:.3f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", help="where the benchmarks are, build/release/bench")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=0.05, help="of each row and repetition")
    parser.add_argument("--core", type=int, default=0)
    options = parser.parse_args()
    print_against_memcpy(options)
    print_every_type(options)


if __name__ == "__main__":
    main()
