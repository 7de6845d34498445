# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""How far off entities were shown before each update, as CSV: capture_errors.py CAPTURE [OUT.csv]"""
import csv
import sys

import numpy
import reckon


def main() -> None:
    states = reckon.read_capture(sys.argv[1])
    out = open(sys.argv[2], "w", newline="") if len(sys.argv) > 2 else sys.stdout
    rows = csv.writer(out)
    rows.writerow(["entity", "time_s", "error_m"])
    for entity in states.entities():
        of_one = states.of(entity)
        shown = reckon.predict(of_one[:-1], of_one.time[1:])
        errors = numpy.linalg.norm(shown.location - of_one.location[1:], axis=1)
        for time, error in zip(of_one.time[1:], errors):
            rows.writerow([":".join(map(str, entity)), f"{time:.6f}", f"{error:.4f}"])


main()
