# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""State of a group at a snooping switch over time: its log of each change, in a file of the run; the requests of the
hosts; and the current state of both. Standard library and the program bridge (iproute2)."""
import bisect
import re
import socket
import time

from testbed import SWITCH

ABOUT = 5.0  # [s] before and after, in reports
MOST = 24    # lines of each kind
STAMP = re.compile(r"Timestamp: (.+ \d{4}) (\d+) usec")


class SwitchView:
    """View of a Testbed whose bridge snoops. `path`: the file; `wire`: the observer at the switch, which receives the
    requests of hosts. The program that writes the log ends with the bed."""

    def __init__(self, bed, wire, path):
        self._bed, self._wire, self._path = bed, wire, path
        path.touch()
        bed.run(SWITCH, ["sh", "-c", f"exec bridge -t monitor mdb > {path}"])

    def changes(self, group):
        """(time by time.monotonic(), text) of each change of a group in the switch's log, in order."""
        monotonic = time.monotonic() - time.time()
        when, found = None, []
        with open(self._path, encoding="utf-8") as lines:
            for line in lines:
                stamp = STAMP.match(line)
                if stamp:
                    when = time.mktime(time.strptime(stamp[1])) + 1e-6 * int(stamp[2]) + monotonic
                elif when is not None and f" grp {group} " in line:
                    found.append((when, line.strip()))
        return found

    def about(self, host, group, begin, end):
        """Lines for people on a group at a host from begin to end [s], and its current state."""
        rows = [row for row in self.changes(group) if f" port p{host} " in row[1]]
        rows += [(when, f"host {host} asks for it") for when in self._wire.asked_for[host, group]]
        rows.sort()
        first = max(0, bisect.bisect_left(rows, (begin - ABOUT,)) - 1)  # the state before
        told = [f"{when:.3f} {text}" for when, text in rows[first:bisect.bisect_left(rows, (end + ABOUT,))]]
        if len(told) > 2 * MOST:
            told[MOST:-MOST] = [f".. {len(told) - 2 * MOST} more .."]
        return told + self._now(host, group)

    def _now(self, host, group):
        now = f"now, {time.monotonic():.3f}:"
        entries = [line.strip() for line in self._bed.system(SWITCH, "bridge -d -s mdb show").splitlines()
                   if f" grp {group} " in line]
        number = socket.inet_aton(group)[::-1].hex().upper()
        member = [line.strip() for line in self._bed.system(host, "cat /proc/net/igmp").splitlines() if number in line]
        return ([f"{now} {line}" for line in entries or ["the switch has the group at no port"]]
                + [f"{now} /proc/net/igmp of host {host}: {line}" for line in member or ["not a member"]])
