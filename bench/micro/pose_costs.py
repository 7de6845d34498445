#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""What a pose costs, as Markdown: a query and a smoothed query.

    bench/micro/pose_costs.py build/release/bench [--repetitions 5] [--core 0]

Runs pose_bench of that folder, pinned to one core.
"""
import argparse
import json
import os
import statistics
import subprocess


def rows_of(options, pattern, seconds):
    """Medians over the repetitions, one dictionary for each row."""
    command = [os.path.join(options.folder, "pose_bench"), f"--benchmark_filter=^{pattern}",
               f"--benchmark_repetitions={options.repetitions}", "--benchmark_format=json",
               "--benchmark_enable_random_interleaving=true", f"--benchmark_min_time={seconds}"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True,
                          preexec_fn=lambda: os.sched_setaffinity(0, {options.core}))
    rows = {}
    for row in json.loads(done.stdout)["benchmarks"]:
        if row.get("error_occurred"):
            raise SystemExit(f"pose_bench: {row['name']}: {row['error_message']}")
        if row["run_type"] == "iteration":
            rows.setdefault((row["family_index"], row["per_family_instance_index"]), []).append(row)
    for _, repetitions in sorted(rows.items()):
        first = repetitions[0]
        yield {key: statistics.median(row[key] for row in repetitions)
               if isinstance(value, float) else value for key, value in first.items()}


def spread(row, name, digits):
    low, high = row[name + "_p10"], row[name + "_p90"]
    return f"{row[name]:.{digits}f} ({low:.{digits}f} to {high:.{digits}f})"


def metres(value):
    return f"**{value:.3g} m**" if value > 1e-6 else f"{value:.1g} m"


def print_queries(options):
    print("| w | printed closed form ns | its error | V and A turned once ns | its error "
          "| query ns (p10 to p90) | its error | x closed form (p10 to p90) |")
    print("|---|---|---|---|---|---|---|---|")
    for row in rows_of(options, "query", options.seconds):
        rate = 1e-9 * float(row["name"].split(":")[1].split("/")[0])
        print(f"| {rate:g} rad/s | {row['plain_ns']:.0f} | {metres(row['plain_error_m'])} "
              f"| {row['straight_ns']:.0f} | {metres(row['straight_error_m'])} "
              f"| {spread(row, 'query_ns', 0)} | {metres(row['error_m'])} "
              f"| {spread(row, 'ratio', 2)} |")


def print_curves(options):
    rows = list(rows_of(options, "smoothed", options.seconds))
    print("\n| smoothed by | ns (p10 to p90) | x the query alone | x the plain blend "
          "| step in position | step in velocity |")
    print("|---|---|---|---|---|---|")
    for row in rows:
        print(f"| {row['label']} | {spread(row, 'smoothed_ns', 0)} | {spread(row, 'ratio', 2)} "
              f"| {spread(row, 'plain_ratio', 2)} | {row['step_m']:.3f} m "
              f"| {row['step_m_per_s']:.3f} m/s |")
    plain = {key: statistics.median(row[key] for row in rows)
             for key in ("plain_ns", "plain_ns_p10", "plain_ns_p90", "plain_step_m_per_s")}
    print(f"| plain blend | {spread(plain, 'plain_ns', 0)} | | 1 | 0.000 m "
          f"| {plain['plain_step_m_per_s']:.3f} m/s |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", help="where the benchmarks are, build/release/bench")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=0.1, help="of each row and repetition")
    parser.add_argument("--core", type=int, default=0)
    options = parser.parse_args()
    print_queries(options)
    print_curves(options)


if __name__ == "__main__":
    main()
