# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares the datagram balance of peers (`reckon peer --balance`) with the traffic recorded by an observer at the
switch. docs/robustness.md has the equations; all of them are exact. Standard library."""
import bisect
import collections
import copy
import socket
import struct
import time

import dis_wire as dis
from machine import Backlog
from sniffer import SO_RCVBUFFORCE, SOL_PACKET, Observer

PACKET_IGNORE_OUTGOING, SO_TIMESTAMPNS = 23, 35
BASE_GROUP = "239.192.1.0"
OBJECT_PORTS = (3002, 3003)  # files for those who join without the scene, which no balance contains
JOINING = 0.2   # [s], longest time until a membership reaches the switch if its report was not recorded
LEAVING = 0.05  # [s], longest time of a datagram from the switch to a socket
WAITING = 30.0  # [s], longest time of a host's datagrams in its slow cable; its own copy arrives earlier
EXPLAINED = 20  # findings that are printed with the state of the switch: each takes about 0.1 s
WENT = ("sent", "sealed")
NEVER_SENT = ("held_back", "send_error", "write_overflow", "stale_unsent", "withheld", "to_nobody", "unsealable")
OUT = WENT + NEVER_SENT
NOT_IN = frozenset(OUT) | {"numbered", "copied_to_list", "arrived", "copied_by_law"}


class Sent:
    """The numbers of one life of a sender in one group, as recorded at the switch."""

    def __init__(self):
        self.numbers, self.times = [], []

    def add(self, number, when):
        """Numbers are in order, because one thread of one host sends them; 2^32 - 1 is reached only after years."""
        if self.numbers and number <= self.numbers[-1]:
            raise ValueError(f"number {number} passed the switch behind {self.numbers[-1]}")
        self.numbers.append(number)
        self.times.append(when)

    def places(self, first, last):
        """Indices of the numbers from first to last."""
        return bisect.bisect_left(self.numbers, first), bisect.bisect_right(self.numbers, last)

    def between(self, begin, end):
        """Indices of the datagrams from begin to end [s]."""
        return bisect.bisect_left(self.times, begin), bisect.bisect_right(self.times, end)


class Wire(Observer):
    """All numbered datagrams that hosts p1, p2, .. send into a switch, by (life, group); datagrams to the addresses
    of a list by (life, group, address). A life is the epoch of trailers, or (boot, stream) of envelopes. No envelope
    may be sent as an offload run. `interface`: place of the socket if it is not at the ports of a switch."""

    def __init__(self, sock, interface=None):
        self._interface = interface
        sock.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, 1 << 26)
        sock.setsockopt(SOL_PACKET, PACKET_IGNORE_OUTGOING, 1)
        sock.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.sent = collections.defaultdict(Sent)
        self.by_place = collections.defaultdict(list)  # group or address of a list: (key, Sent)
        self.host = {}  # of a life
        self.asked_for = collections.defaultdict(list)  # (host, group): times of its IGMP reports
        self.datagrams = self.frames = 0
        self.octets = collections.Counter()  # of these frames, by host
        self.problem = None
        super().__init__(sock)

    def _receive(self):
        frame, stamps, _, address = self._socket.recvmsg(1 << 17, 64)
        if not (address[0] == self._interface if self._interface else address[0].startswith("p")):
            return
        seconds, nanos = struct.unpack("qq", stamps[0][2])
        late = time.time() - seconds - 1e-9 * nanos  # of this thread; both clocks are read together
        try:
            self._take(frame, int(address[0][1:]) if self._interface is None else None, time.monotonic() - late)
        except ValueError as problem:
            self.problem = self.problem or f"{address[0]}: {problem}"

    def _take(self, frame, host, when):
        for group in dis.igmp_reports_of_frame(frame):
            self.asked_for[host, group].append(when)
        datagram = dis.udp_of_frame(frame)
        if datagram is None or len(datagram[2]) < 24 or dis.udp_port_of_frame(frame) in OBJECT_PORTS:
            return
        place, payload = datagram[1], datagram[2]
        group, before = place, self.datagrams
        front, envelope = in_front(payload)
        if envelope:
            if front is not None:
                group = group_text(front)
            boot, stream, count = struct.unpack_from(">QH6s", envelope, 8)
            self._add((boot, stream), group, place, int.from_bytes(count, "big"), when, host)
        else:
            for kind, octets in dis.pdus(payload):  # an offload run has many trailers
                if kind == dis.UNICAST_FRAME:
                    group = group_text(struct.unpack_from(">H", octets, 12)[0])
                elif kind == dis.TRAILER:
                    number, epoch = struct.unpack_from(">II", octets, 12)
                    self._add(epoch, group, place, number, when, host)
        if self.datagrams > before:
            self.frames += 1
            self.octets[host] += len(frame)

    def _add(self, life, group, place, number, when, host):
        key = (life, group) if place == group else (life, group, place)
        if key not in self.sent:
            self.by_place[place].append((key, self.sent[key]))
        self.sent[key].add(number, when)
        self.host[life] = host
        self.datagrams += 1

    def passed(self, life, group):
        """The numbers of each path of a group of a life: one path, or one to each address of a list."""
        return [sent.numbers for key, sent in list(self.sent.items()) if key[:2] == (life, group)]

    def opened(self, host, group, joining, joined):
        """Time at which a host's report opened the group at the switch, if the host joined between these times."""
        reports = self.asked_for[host, group]
        at = bisect.bisect_left(reports, joining)
        return max(joined, reports[at]) if at < len(reports) else joined + JOINING


def in_front(payload):
    """(the group in a unicast frame, or None; its sealed content, or None)."""
    front = None
    if payload[2] == dis.UNICAST_FRAME:
        front, payload = struct.unpack_from(">H", payload, 12)[0], payload[16:]
    return front, payload if payload[:1] == bytes((dis.SEALED,)) else None


def group_text(number):
    """The base group, or the n-th group of the pool."""
    base = int.from_bytes(socket.inet_aton(BASE_GROUP), "big")
    return socket.inet_ntoa((base + number).to_bytes(4, "big"))


def group_of(row):
    """The group without its port."""
    return row["group"].rsplit(":", 1)[0]


def life_of(row):
    return (int(row["boot"], 16), row["stream"]) if "boot" in row else row["epoch"]


def life_text(life):
    return f"{life[0]:016x}/{life[1]}" if isinstance(life, tuple) else f"{life:08x}"


class Told:
    """The balance reports of one life of a peer, line by line."""

    def __init__(self, host):
        self.host = host
        self.log = None  # a list, if the lines are to be kept
        self.fates = collections.defaultdict(collections.Counter)
        self.arrived = collections.Counter()  # from the stretches, by (life, group)
        self.stretches = collections.defaultdict(list)  # by place, for memberships that are not yet checked
        self.new, self.tracked, self.memberships = [], [], []
        self.lost_by_row = 0
        self.missed = 0
        self.ended = False  # by itself: its last line was a final report
        self.lost = None    # datagrams_lost
        self.begun_s = time.monotonic()
        self.asked_s = self.end_s = None  # time of the request to end, and of the end

    def take(self, line):
        if self.log is not None:
            self.log.append(copy.deepcopy(line))
        if line.get("event") != "balance":
            if "datagrams_lost" in line:
                self.lost = line["datagrams_lost"]
            return
        self.missed = line["missed_events"]
        self.ended = line["end"]
        for row in line["fates"]:
            counts = self.fates[life_of(row), group_of(row)]
            for fate, count in row.items():
                if fate not in ("epoch", "boot", "stream", "group"):
                    counts[fate] += count
        self.new += line["stretches"]
        self.tracked += line["tracked"]
        self.memberships += line["memberships"]


class Balance:
    """Compares lives with the wire. `findings` are sentences; empty if all is right. `reach`: observers at hosts
    whose cable loses frames after the switch. `listed`: address of each host, if there are no groups. `slow`: hosts
    whose cable delays their datagrams. `switch`: a SwitchView, whose lines are added to findings about a membership."""

    def __init__(self, wire, reach=None, listed=None, sealed=False, slow=(), switch=None):
        self.wire, self.reach, self.listed, self.sealed, self.slow = wire, reach or {}, listed, sealed, slow
        self.switch = switch
        self.backlog = Backlog()
        self.findings = []
        self.sums = collections.Counter()

    def expect(self, condition, sentence):
        if not condition:
            self.findings.append(sentence)

    def seen_by(self, told, life):
        """The observer of the datagrams of a life that a host can receive: a host gets its own datagrams without the
        network."""
        return self.wire if self.wire.host.get(life) == told.host else self.reach.get(told.host, self.wire)

    def by_place(self, told, place):
        return [(key, sent) for wire in {self.wire, self.reach.get(told.host, self.wire)}
                for key, sent in wire.by_place[place] if self.seen_by(told, key[0]) is wire]

    def key_of(self, told, life, group):
        """Key in the wire's record for the datagrams of a life in a group at this host."""
        return (life, group, self.listed(told.host)) if self.listed else (life, group)

    def is_content(self, life):
        """Whether the life's numbers are inside envelopes, which an observer cannot read."""
        return self.sealed and isinstance(life, int)

    def look(self, told):
        """Checks the finished parts of a life's reports."""
        self._check_stretches(told)
        self._check_tracked(told)
        for membership in told.memberships:
            self._check_membership(told, membership)
        for membership in told.memberships:
            rows = told.stretches[group_of(membership)]
            rows[:] = [row for row in rows if row["joined_s"] not in (membership["joined_s"], None)]
        told.memberships.clear()

    def check(self, told):
        """Checks a life that is over."""
        self.sums["lives"] += 1
        self.sums["ended by themselves"] += told.ended
        self.expect(told.missed == 0, f"host {told.host}: {told.missed} events were missed")
        self.look(told)
        self._check_sent(told)
        self._check_received(told)
        if told.ended and told.lost is not None:
            self.sums["lost as counted"] += told.lost
            self.expect(told.lost_by_row == told.lost,
                        f"host {told.host}: datagrams_lost {told.lost}, by sender and group {told.lost_by_row}")

    def check_reach(self, host, forwarded, lost):
        """forwarded by the switch = lost on the cable + seen at the host; frames."""
        seen = self.reach[host].frames
        self.sums["lost on the cable"] += lost
        self.expect(forwarded == lost + seen, f"host {host}: {forwarded} forwarded, {lost} lost on the cable, {seen} seen")

    def _check_sent(self, told):
        """numbered, and once more for each further address of a list = sent + each reason not to; sent = seen at the switch."""
        for (life, group), counts in told.fates.items():
            if not any(counts[fate] for fate in ("numbered", *OUT)):
                continue
            name = f"host {told.host}, life {life_text(life)}, to {group}"
            ways = self.wire.passed(life, group)
            seen = sum(map(len, ways))
            self.sums["sent"] += seen
            if not told.ended:
                self.expect(seen >= counts["sent"], f"{name}: {counts['sent']} sent, {seen} at the switch")
                continue
            came, out = counts["numbered"] + counts["copied_to_list"], sum(counts[fate] for fate in OUT)
            for fate in ("copied_to_list", "sealed", *NEVER_SENT):
                self.sums[fate] += counts[fate]
            self.expect(came == out, f"{name}: {came} numbered and copied, {out} accounted for: {dict(counts)}")
            between = self.backlog.dropped(told.begun_s, told.end_s)
            self.expect(seen <= counts["sent"] <= seen + between,
                        f"{name}: {counts['sent']} sent, {seen} at the switch, {between} dropped by the machine's backlog")
            for numbers in ways if isinstance(life, int) else ():
                self.expect(1 <= numbers[0] and numbers[-1] <= counts["numbered"],
                            f"{name}: numbers {numbers[0]} to {numbers[-1]} at the switch of {counts['numbered']}")

    def _check_received(self, told):
        """arrived and copied = delivered + filtered by reason + duplicates, by sender and group."""
        for key, counts in told.fates.items():
            name = f"host {told.host} from {life_text(key[0])} by {key[1]}"
            came = counts["arrived"] + counts["copied_by_law"]
            went = sum(count for fate, count in counts.items() if fate not in NOT_IN)
            for fate in set(counts) - NOT_IN:
                self.sums[fate] += counts[fate]
            self.sums["arrived"] += counts["arrived"]
            if not told.ended:
                self.expect(went <= came, f"{name}: {came} came, {went} accounted for")
                continue
            self.sums["balances"] += 1
            self.expect(came == went, f"{name}: {came} came, {went} accounted for: {dict(counts)}")
            if key[0]:
                self.expect(told.arrived[key] == counts["arrived"],
                            f"{name}: {counts['arrived']} arrived, {told.arrived[key]} in stretches")

    def _check_stretches(self, told):
        """last - first + 1 = arrived + dropped on the way + never sent, or to another group under the same number."""
        for row in told.new:
            life, group = life_of(row), group_of(row)
            told.arrived[life, group] += row["arrived"] + row["copies"]
            name = f"host {told.host} from {life_text(life)} by {group}, {row['first']} to {row['last']}"
            span = row["last"] - row["first"] + 1
            self.expect(span == row["arrived"] + row["missing"], f"{name}: {row['arrived']} + {row['missing']}")
            if self.is_content(life):
                continue
            key, wire = self.key_of(told, life, group), self.seen_by(told, life)
            if key not in wire.sent:
                self.findings.append(f"{name}: nothing of it was seen at the switch")
                continue
            low, high = wire.sent[key].places(row["first"], row["last"])
            row["dropped"] = high - low - row["arrived"]
            self.sums["stretches"] += 1
            self.sums["dropped on the way"] += row["dropped"]
            self.expect(row["dropped"] + self.backlog.dropped(told.begun_s) >= 0,
                        f"{name}: {row['arrived']} arrived of {high - low} at the switch")
            row["key"] = key
            told.stretches[key[-1]].append(row)
        told.new.clear()

    def _check_tracked(self, told):
        """The tracker's count of lost datagrams equals the unused numbers between its first and last number."""
        for row in told.tracked:
            span = row["last"] - row["first"] + 1
            self.expect(span == row["received"] + row["lost"],
                        f"host {told.host} from {life_text(life_of(row))} by {row['group']}: {row['first']} to {row['last']} "
                        f"is not {row['received']} received and {row['lost']} lost")
            told.lost_by_row += row["lost"]
        told.tracked.clear()

    def _check_membership(self, told, membership):
        """sent while it was a member = arrived + dropped by its socket, or by the machine before it."""
        place, joining, joined = group_of(membership), membership["joining_s"], membership["joined_s"]
        leaving = membership["leaving_s"] or told.asked_s  # the request to end: from then on it may stop reading
        left = membership["left_s"] or told.end_s
        opened = self.wire.opened(told.host, place, joining, joined)
        dropped, surely, perhaps, missing = 0, 0, 0, []
        for key, sent in self.by_place(told, place):  # its own datagrams loop back and use the queue
            if not sent.times or sent.times[-1] < joining - LEAVING:
                continue
            wide = sent.between(joining - LEAVING, left + LEAVING)
            strict = sent.between(opened + LEAVING, leaving - LEAVING)
            if told.host in self.slow and self.wire.host.get(key[0]) == told.host:
                wide, strict = sent.between(joining - LEAVING, left + WAITING), (0, 0)
            if wide[0] == wide[1]:
                continue
            inside_wide = inside_strict = 0
            for row in told.stretches[place]:
                if row["key"] != key or row["joined_s"] not in (joined, None):  # None: a list without groups
                    continue
                low, high = sent.places(row["first"], row["last"])
                dropped += row["dropped"]
                inside_wide += max(0, min(high, wide[1]) - max(low, wide[0]))
                inside_strict += max(0, min(high, strict[1]) - max(low, strict[0]))
            perhaps += wide[1] - wide[0] - inside_wide
            missed = max(0, strict[1] - strict[0]) - inside_strict
            surely += missed
            if missed > 0:
                missing.append(f"{missed} of host {self.wire.host.get(key[0])}, life {life_text(key[0])}, which said {strict[1] - strict[0]} "
                               f"from {sent.times[strict[0]]:.3f} to {sent.times[strict[1] - 1]:.3f}")
        drops = membership["kernel_drops"]
        self.sums["memberships"] += 1
        self.sums["memberships without an edge"] += perhaps == 0
        self.sums["dropped by kernels"] += drops
        between = self.backlog.dropped(joining, left)
        if dropped + surely <= drops + between and drops <= dropped + perhaps + between:
            return
        which = f" ({'; '.join(missing[:4])})" if missing else ""
        about = self.switch.about(told.host, place, joined, left) if self.switch and len(self.findings) < EXPLAINED else []
        self.findings.append("\n    ".join([
            f"host {told.host} in {place} from {joined} to {left}: the kernel dropped {drops}, missing are {dropped} "
            f"between others, {surely} to {perhaps} before the first or behind the last heard{which}; the switch was asked "
            f"at {opened:.3f}, and the machine's backlog dropped {between}", *about]))
