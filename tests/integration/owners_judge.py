# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Judges the logs of owners_process: never two owners, no version goes back, no jump at a hand-over. Times are
CLOCK_MONOTONIC [ns], the same for all processes; lengths are in mm.
  owners_judge.py    checks the judge itself: each planted fault must be found"""
import bisect
import collections
import math
import sys

JUMP = 1.0       # [mm], greatest at a hand-over, beyond the error that the pose had before, and a knock
ADOPTED = 5.0    # [s] after a kill
GIVEN = 7.0      # [s] after it, of a body that was being given to the killed process
UNOWNED = 1.0    # [s] without an owner, while nobody fails
NEAR = (20, 100) # [ms] before and after a hand-over
KNOCK = 0.004    # [s] for which a viewer shows the old velocity after a knock: delay, and the passes of both loops
LOOKS = 5.0      # [ms], between two passes at most: a correction takes 20 ms, and looks like a jump after a longer time
KNOWN = 20       # [ms] for which the last state of an owner says where the body is
SAME = 2.0       # [mm], as far as a place is the same
AWAKE = 2.0      # [s] after a sleep in which an old place would come back
SECOND = 10**9

Interval = collections.namedtuple("Interval", "body begin end owner")


class Log:
    """The events of one process: {kind: [(time, body, numbers)]}."""

    def __init__(self, text, killed=None):
        lines = text.split("\n")[:-1]  # the last one of a killed process may be cut
        self.killed, self.events, self.counts, self.slept = killed, collections.defaultdict(list), {}, []
        for line in lines:
            time, kind, *rest = line.split()
            if kind == "count":
                self.counts[rest[0]] = int(rest[1])
            elif kind == "slept":
                self.slept.append((int(rest[0]), int(time)))
            else:
                self.events[kind].append((int(time), int(rest[0]), [float(n) if "." in n else int(n) for n in rest[1:]]))
        self.last = killed or int(lines[-1].split()[0])

    def intervals(self, name, begin, end):
        """From each begin to its end. What ends in the first pass after a sleep has ended with the last one before:
        nothing can look between a step and the sleep."""
        open_since, found = {}, []
        for time, body, is_end in sorted([(t, b, False) for t, b, _ in self.events[begin]] +
                                         [(t, b, True) for t, b, _ in self.events[end]]):
            if not is_end:
                open_since[body] = time
            elif body in open_since:
                found.append((body, open_since.pop(body), time))
        found += [(body, time, self.last) for body, time in open_since.items()]
        for body, since, until in found:
            for asleep, awake in self.slept:
                if since <= asleep <= until <= awake:
                    until = asleep
            yield Interval(body, since, until, name)


def by_body(rows, key=lambda row: row[1]):
    found = collections.defaultdict(list)
    for row in rows:
        found[key(row)].append(row)
    return found


class Judge:
    """@param logs {name: Log}  @param until time after which nothing counts"""

    def __init__(self, logs, until=math.inf):
        self.logs, self.until, self.faults = logs, until, []
        self.worst_jump = self.worst_error = self.longest_gap = 0.0
        intervals = [i for name, log in logs.items() for i in log.intervals(name, "begin", "end") if i.begin < until]
        self.simulated = by_body(sorted(intervals, key=lambda i: i.begin), lambda i: i.body)
        self.failures = [log.killed for log in logs.values() if log.killed] + [s for log in logs.values() for s, _ in log.slept]
        self.hand_overs = self.unjudged = 0

    def judge(self):
        self.one_owner("begin", "end")
        self.one_owner("owns", "yields")
        self.versions()
        self.jumps()
        self.gaps()
        self.old_places()
        for name, log in self.logs.items():
            for time, body, _ in self.rows(log, "gone"):
                if not self.is_waking(log, time):
                    self.fault(time, body, f"{name} does not show it any more")
        return self.faults

    def fault(self, time, body, sentence):
        self.faults.append(f"{time / SECOND:.4f} body {body}: {sentence}")

    def rows(self, log, kind):
        return [row for row in log.events[kind] if row[0] < self.until]

    def one_owner(self, begin, end):
        intervals = [i for name, log in self.logs.items() for i in log.intervals(name, begin, end)]
        for body, rows in by_body(intervals, lambda i: i.body).items():
            rows.sort(key=lambda i: i.begin)
            held = rows[0]
            for row in rows[1:]:
                if row.begin < min(held.end, self.until) and row.owner != held.owner:
                    self.fault(row.begin, body, f"{held.owner} and {row.owner} are '{begin}' together for "
                                                f"{(min(held.end, row.end) - row.begin) / 1e6:.2f} ms")
                held = max(held, row, key=lambda i: i.end)

    def versions(self):
        """A version has one owner, and is never older than the one before."""
        begins = [(*row, name) for name, log in self.logs.items() for row in self.rows(log, "begin")]
        for body, rows in by_body(begins).items():
            rows.sort(key=lambda row: row[0])
            self.hand_overs += sum(one[3] != two[3] for one, two in zip(rows, rows[1:]))
            for (_, _, (old,), one), (time, _, (new,), two) in zip(rows, rows[1:]):
                if new < old or (new == old and one != two):
                    self.fault(time, body, f"version {old} of {one}, then {new} of {two}")
        owners = {}
        for name, log in self.logs.items():
            for body, rows in by_body(self.rows(log, "knows")).items():
                last = 0
                for time, _, (owner, version) in rows:
                    if version == 0:
                        continue  # not known yet
                    if version < last:
                        self.fault(time, body, f"{name} knows version {last}, then {version}")
                    last = version
                    # Without an owner it is released: its owner does not know whether the taker has it.
                    if owner != 0 and owners.setdefault((body, version), owner) != owner:
                        self.fault(time, body, f"version {version} has the owners {owner} and {owners[body, version]}")

    def truths(self, body, time):
        """Possible positions of the body [mm]; empty: unknown. Between two logged states a body follows the earlier one
        until a knock, then the later one. Without an owner, the last state of the former owner counts for KNOWN ms."""
        def moved(since, state):
            tau = (time - since) / SECOND
            return [p + tau * v for p, v in zip(state[:3], state[3:])]

        for interval in self.simulated.get(body, ()):
            if not interval.begin <= time <= interval.end:
                continue
            times, states = self.states[interval.owner, body]
            at = bisect.bisect_right(times, time)
            near = [i for i in (at - 1, at) if 0 <= i < len(times) and interval.begin <= times[i] <= interval.end]
            if near:
                return [moved(times[i], states[i]) for i in near]
        since, state = max(((t, n) for t, n in self.ends[body] if t <= time + SECOND // 1000), default=(0, None))
        return [] if state is None or time - since > KNOWN * 1e6 else [moved(since, state)]

    def jumps(self):
        """A pose may jump to the truth from where loss has led it, or by a knock, and else stays."""
        self.ends = collections.defaultdict(list)
        self.states = collections.defaultdict(lambda: ([], []))  # (times, states) of (owner, body)
        for name, log in self.logs.items():
            for time, body, state in self.rows(log, "end"):
                self.ends[body].append((time, state))
            for time, body, state in sorted(self.rows(log, "state")):
                for column, value in zip(self.states[name, body], (time, state)):
                    column.append(value)
        for name, log in self.logs.items():
            changes = {body: sorted(row[0] for row in rows) for body, rows in
                       by_body([row for kind in ("knows", "begin", "end") for row in self.rows(log, kind)]).items()}
            for time, body, (excess, change, since, *was) in self.rows(log, "jump"):
                at = [t for t in changes.get(body, ()) if t - NEAR[0] * 1e6 <= time <= t + NEAR[1] * 1e6]
                truths = self.truths(body, time - since * 1e6)
                if not at or not truths or self.is_waking(log, time):
                    continue
                if since > LOOKS:
                    self.unjudged += 1
                    continue
                error = max(math.dist(was, truth) for truth in truths)
                self.worst_error = max(self.worst_error, error)
                excess -= KNOCK * change
                self.worst_jump = max(self.worst_jump, excess - error)
                if excess > JUMP + error:
                    self.fault(time, body, f"the pose that {name} shows jumps by {excess:.2f} mm at a hand-over; it was "
                                           f"wrong by {error:.2f} mm; looks {since:.1f} ms apart, velocity changed by {change:.0f} mm/s")

    @staticmethod
    def is_waking(log, time):
        return any(asleep <= time <= awake + AWAKE * SECOND for asleep, awake in log.slept)

    def has_failure(self, begin, end):
        """Whether a process failed in this time, to which a hand-over may have been under way."""
        return any(end >= failed >= begin - SECOND for failed in self.failures)

    def longest_allowed(self, one, until):
        """Time without an owner after an interval of ownership [s]."""
        if not self.has_failure(one.end, until):
            return UNOWNED
        log = self.logs[one.owner]
        own = [asleep for asleep, _ in log.slept] + ([log.killed] if log.killed else [])
        return ADOPTED if one.end in own else GIVEN

    def gaps(self):
        for body, rows in self.simulated.items():
            for one, two in zip(rows, rows[1:]):
                gap = (two.begin - one.end) / SECOND
                fails = self.has_failure(one.end, two.begin)
                if not fails:
                    self.longest_gap = max(self.longest_gap, gap)
                if gap > self.longest_allowed(one, two.begin):
                    self.fault(two.begin, body, f"without an owner for {gap:.2f} s after {one.owner}")
            last = rows[-1]
            until = min(self.until, max(log.last for log in self.logs.values()))
            if last.end < until - self.longest_allowed(last, until) * SECOND:
                self.fault(last.end, body, f"{last.owner} ends, and nobody owns it any more")

    def old_places(self):
        """After a sleep no pose jumps to where the sleeper left the body, if others have moved it."""
        for sleeper, log in self.logs.items():
            for asleep, awake in log.slept:
                old = self.places(log, asleep)
                moved = {}
                for other in self.logs.values():
                    moved.update({b: p for b, p in self.places(other, awake).items()
                                  if other is not log and b in old and math.dist(p, old[b]) > 3 * SAME})
                for name, shown in self.logs.items():
                    self.returns(name, shown, {b: old[b] for b in moved}, awake)

    def places(self, log, time):
        return {body: rows[-1][2] for body, rows in by_body([row for row in log.events["pose"] if row[0] <= time]).items()}

    def returns(self, name, log, old, since):
        poses = {(time, body): pose for time, body, pose in log.events["pose"]}
        for time, body, (_, _, _, *was) in self.rows(log, "jump"):
            if body not in old or not since <= time <= since + AWAKE * SECOND or (time, body) not in poses:
                continue
            if math.dist(poses[time, body], old[body]) <= SAME < math.dist(was, old[body]):
                self.fault(time, body, f"{name} jumps back to where it was before a sleep")

    def agreement(self):
        """Faults of the end, when nothing moves and nobody asks."""
        living = {name: log for name, log in self.logs.items() if log.killed is None}
        for body in self.simulated:
            owners = {name: next((n for t, b, n in reversed(log.events["knows"]) if b == body), None)
                      for name, log in living.items()}
            if len({tuple(n or ()) for n in owners.values()}) != 1:
                self.fault(self.until, body, f"at the end the owners are {owners}")
            holders = [i.owner for i in self.simulated[body] if i.owner in living and i.end >= min(self.until, living[i.owner].last)]
            if len(holders) != 1:
                self.fault(self.until, body, f"at the end it is simulated by {holders}")
        return self.faults

    def spread(self):
        """Greatest distance between the places of a body at two living processes at the end [mm]."""
        places = [p for log in self.logs.values() for p in by_body(log.events["final"]).items()]
        together = collections.defaultdict(list)
        for body, rows in places:
            together[body] += [row[2] for row in rows]
        return max((math.dist(one, two) for rows in together.values() for one in rows for two in rows), default=0.0)

    def count(self, name):
        return sum(log.counts.get(name, 0) for log in self.logs.values())


GOOD = {
    "one": "1000000000 begin 0 5\n1000000000 owns 0\n1000000000 knows 0 11 5\n1000000000 pose 0 0.00 0.00 20.00\n"
           "2000000000 end 0 0.00 0.00 20.00 0.00 0.00 0.00\n2000000000 yields 0\n2004000000 knows 0 22 6\n3000000000 count received 7\n",
    "two": "1000000000 knows 0 11 5\n1000000000 pose 0 0.00 0.00 20.00\n2002000000 knows 0 22 6\n2002000000 owns 0\n"
           "2003000000 begin 0 6\n2500000000 pose 0 40.00 0.00 20.00\n3000000000 count received 7\n",
}
# (words of the fault, log, old, new)
PLANTED = (
    ("'begin' together", "two", "2003000000 begin", "1999000000 begin"),
    ("'owns' together", "two", "2002000000 owns", "1999000000 owns"),
    ("version 5 of one, then 4", "two", "begin 0 6", "begin 0 4"),
    ("version 5 of one, then 5", "two", "begin 0 6", "begin 0 5"),
    ("knows version 5, then 4", "one", "knows 0 22 6", "knows 0 22 4"),
    ("has the owners", "one", "knows 0 22 6", "knows 0 11 6"),
    ("jumps by 1.50 mm", "two", "2500000000 pose", "2004000000 jump 0 1.50 0.00 1.00 0.00 0.00 20.00\n2500000000 pose"),
    ("without an owner", "two", "2003000000 begin", "3003000000 begin"),
    ("nobody owns it", "two", "3000000000 count received 7", "2600000000 end 0 0.00 0.00 20.00 0.00 0.00 0.00\n9000000000 count received 7"),
    ("does not show it", "two", "2500000000 pose", "2400000000 gone 0\n2500000000 pose"),
    ("'begin' together", "one", "2000000000 end 0 0.00",
     "2600000000 slept 1900000000\n2700000000 end 0 0.00"),
    ("where it was before a sleep", "one", "3000000000 count",
     "2700000000 slept 1900000000\n2800000000 pose 0 40.00 0.00 20.00\n2900000000 jump 0 40.00 0.00 1.00 40.00 0.00 20.00\n"
     "2900000000 pose 0 0.00 0.00 20.00\n3000000000 count"),
)
# With NEW_STATES a knock explains this jump; without them it is a fault.
KNOCKED = ("one", "3000000000 count", "2010000000 jump 0 3.00 0.00 5.00 0.00 0.00 20.00\n3000000000 count")
NEW_STATES = ("two", "2500000000 pose", "2003000000 state 0 0.00 0.00 20.00 0.00 0.00 0.00\n"
              "2010000000 state 0 0.00 0.00 26.00 0.00 0.00 600.00\n2500000000 pose")
# Not judged, but counted.
FAR_APART = ("one", "3000000000 count", "2010000000 jump 0 3.00 0.00 6.00 0.00 0.00 20.00\n3000000000 count")
# It may end in the first pass after a sleep.
SLEPT = ("one", "2000000000 end 0 0.00", "2600000000 slept 1900000000\n2600000000 end 0 0.00")


def faults_of(texts):
    return Judge({name: Log(text) for name, text in texts.items()}).judge()


def replaced(*changes):
    texts = dict(GOOD)
    for name, old, new in changes:
        assert GOOD[name].count(old) == 1, old
        texts[name] = texts[name].replace(old, new)
    return texts


def check_itself():
    wrong = [f"a good log is refused: {faults}" for faults in (faults_of(GOOD),) if faults]
    slept = faults_of(replaced(SLEPT))
    wrong += [f"an end in the first pass after a sleep is refused: {slept}"] if slept else []
    knocked = faults_of(replaced(KNOCKED, NEW_STATES))
    wrong += [f"a jump after a knock is a fault: {knocked}"] if knocked else []
    wrong += [] if faults_of(replaced(KNOCKED)) else ["not found: a jump without a knock"]
    judge = Judge({name: Log(text) for name, text in replaced(FAR_APART).items()})
    wrong += [] if not judge.judge() and judge.unjudged == 1 else ["a jump between passes too far apart is not counted"]
    for words, *change in PLANTED:
        faults = faults_of(replaced(change))
        print(f"  {'; '.join(faults)}")
        wrong += [] if any(words in fault for fault in faults) else [f"not found: {words}"]
    return wrong


if __name__ == "__main__":
    sys.exit("\n".join(check_itself()) or 0)
