# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Delays and losses of the machine itself, for any cause. Standard library."""
import bisect
import threading
import time


class Stalls:
    """Detects when this machine delays a process that needs little time."""

    PERIOD = 0.01  # [s]

    def __init__(self):
        self.worst = 0.0  # [s] above the period
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self):
        while True:
            begin = time.monotonic()
            time.sleep(self.PERIOD)
            self.worst = max(self.worst, time.monotonic() - begin - self.PERIOD)


class Backlog:
    """Frames that this machine dropped between interfaces because a processor's queue was full
    (net.core.netdev_max_backlog): over all namespaces, and by other programs in them."""

    SOON = 1.0  # [s] within which look() has counted them

    def __init__(self):
        self._times, self._totals = [0.0], [self._read()]

    @staticmethod
    def _read():
        with open("/proc/net/softnet_stat") as rows:
            return sum(int(row.split()[1], 16) for row in rows)

    def look(self):
        total = self._read()
        if total != self._totals[-1]:
            self._times.append(time.monotonic())
            self._totals.append(total)

    def dropped(self, begin=0.0, end=float("inf")):
        before, last = (bisect.bisect_right(self._times, at) - 1 for at in (begin, end + self.SOON))
        return self._totals[last] - self._totals[max(0, before)]
