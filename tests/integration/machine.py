# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""What the machine itself keeps back or loses, whoever's fault it is. Standard library."""
import bisect
import threading
import time


class Stalls:
    """Notices when this machine keeps a process waiting that asks for little."""

    PERIOD = 0.01  # [s]

    def __init__(self):
        self.worst = 0.0  # [s] beyond the period
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self):
        while True:
            begin = time.monotonic()
            time.sleep(self.PERIOD)
            self.worst = max(self.worst, time.monotonic() - begin - self.PERIOD)


class Backlog:
    """Frames that this machine dropped between interfaces, for want of room in a processor's queue
    (net.core.netdev_max_backlog): of all namespaces together, and of other programs in them."""

    SOON = 1.0  # [s] after which a look has noted them

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
