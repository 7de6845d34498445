# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that the soak can fail: after a minute a difference of one is planted in the reports of a peer, repeatedly,
and must be found each time.
  planted_balance.py --reckon PROGRAM [--seed N]"""
import collections
import copy
import random
import sys

import soak_crowd
import testbed
import wire_balance
from testbed import check

PLANTS = 600
RARE = ("fates.held_back", "fates.send_error", "fates.stale_unsent")  # also planted one by one
OF_RARE = 10
EDGE = "memberships.kernel_drops"  # the only number that is not exact at the ends of a stretch, see docs/robustness.md


def places(log):
    """(kind, line, part, row, key) of each count in the reports of a life."""
    for i, line in enumerate(log):
        if line.get("event") != "balance":
            yield "datagrams_lost", i, None, None, "datagrams_lost"
            continue
        for part in ("fates", "stretches", "tracked", "memberships"):
            for j, row in enumerate(line[part]):
                for key, value in row.items():
                    if isinstance(value, int) and key != "epoch":
                        yield f"{part}.{key}", i, part, j, key


def judged(whole, life, log):
    """The findings for these reports."""
    told = wire_balance.Told(life.host)
    told.asked_s, told.end_s = life.asked_s, life.end_s
    for line in copy.deepcopy(log):
        told.take(line)
    balance = wire_balance.Balance(whole.wire, whole.reach, slow=whole.slow)
    balance.check(told)
    return balance.findings


def plant(balance, hosts, dice):
    lives = [told for host in hosts for told in host.kept if told.ended]
    unplanted = sum(len(judged(balance, life, life.log)) for life in lives)
    check(unplanted == 0, f"{unplanted} findings without a plant")
    tried, found = collections.Counter(), collections.Counter()

    def plant_one(life, kind=None):
        by_kind = collections.defaultdict(list)
        for found_kind, *place in places(life.log):
            by_kind[found_kind].append(place)
        kind = kind or dice.choice(sorted(by_kind))
        line, part, row, key = dice.choice(by_kind[kind])
        log = copy.deepcopy(life.log)
        (log[line] if part is None else log[line][part][row])[key] += dice.choice((-1, 1))
        tried[kind] += 1
        found[kind] += bool(judged(balance, life, log))
    for _ in range(PLANTS):
        plant_one(dice.choice(lives))
    for fate in RARE:
        having = [life for life in lives if any(kind == fate for kind, *_ in places(life.log))]
        check(having, f"no life that ended has {fate}: nothing was planted there")
        for _ in range(OF_RARE):
            plant_one(dice.choice(having), fate)
    for host, observer in balance.reach.items():
        for forwarded, lost in ((0, 1), (1, 0), (-1, 0), (0, -1)):
            tried["cable"] += 1
            apart = wire_balance.Balance(balance.wire, balance.reach, slow=balance.slow)
            cut = balance.sums["lost on the cable"]
            apart.check_reach(host, observer.frames + cut + forwarded, cut + lost)
            found["cable"] += bool(apart.findings)
    print(f"{len(lives)} lives; planted and found: " + ", ".join(f"{k} {found[k]} of {tried[k]}" for k in sorted(tried)))
    for kind in tried:
        check(found[kind] == tried[kind] or kind == EDGE, f"{tried[kind] - found[kind]} plants in {kind} are not found")


def run(arguments, folder):
    balance, hosts = soak_crowd.run(arguments, folder)
    plant(balance, hosts, random.Random(arguments.seed))


if __name__ == "__main__":
    sys.exit(soak_crowd.main(run, minutes=1.0, keeps=True))
