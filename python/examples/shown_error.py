# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""How far off the circle of truck.py its trucks are shown here: shown_error.py [IFACE [SECONDS [PLOT.png]]]"""
import collections
import math
import sys
import time

import reckon


def main() -> None:
    errors: dict[tuple[int, int, int], list[float]] = collections.defaultdict(list)
    with reckon.Federate(reckon.Exercise(1, 47.05, 8.31), iface=(sys.argv[1:] or ["lo"])[0], name="WATCH") as federate:
        for _ in range(int(float((sys.argv[2:] or ["10"])[0]) * 50)):
            federate.tick()
            for truck in federate.entities():
                errors[truck.id].append(abs(math.hypot(*truck.position[:2]) - 50.0))
            time.sleep(0.02)
    for entity, off in errors.items():
        print(*entity, f"shown {len(off)} times, at most {max(off):.3f} m off", flush=True)
    if len(sys.argv) > 3:
        import matplotlib.pyplot as plt  # type: ignore[import]
        for entity, off in errors.items():
            plt.plot([0.02 * step for step in range(len(off))], off, label=str(entity))
        plt.savefig(sys.argv[3])


main()
