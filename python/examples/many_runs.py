# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""One scene under many draws of a bad network: many_runs.py SCENE [RUNS [SECONDS]]"""
import sys

import numpy
import reckon


def main() -> None:
    runs, seconds = int((sys.argv[2:] or ["100"])[0]), float((sys.argv[3:] or ["5"])[0])
    peaks, errors = [], []
    for seed in range(1, runs + 1):
        run = reckon.run_scene(sys.argv[1], seconds, seed=seed, impair="delay=50ms jitter=20ms loss=10%")
        peaks.append(numpy.linalg.norm(run.force, axis=1).max())
        errors.append(run.numbers["pose_error"]["p99"])
    for name, values, unit in (("peak force", peaks, "N"), ("pose error, 99 %", errors, "m")):
        middle, worst = numpy.median(values), numpy.max(values)
        print(f"{name:18} median {middle:.4g} {unit}, worst of {runs} {worst:.4g} {unit}")


main()
