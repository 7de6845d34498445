# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A LAN that lies: two peers touch each other while a third host, at an address of its own, attacks without knowing a
key. `table` runs every attack against a fresh pair and prints what it did; `short` runs some against one pair; `leaders` those
on a pair whose cells have leaders; `relay` against a quiet peer; `families` draws the numbers of each attack from a seed; `sealed` sends forged and replayed datagrams, 10 million of them, to such a pair that has a key."""
import json
import math
import pathlib
import random
import re
import statistics
import subprocess
import sys
import threading
import time

import hostile_drawn
import hostile_page
import testbed
from hostile_attacks import ALICE, ATTACKS, BOB, Heard
from hostile_leaders import FORGED, LEADER_ATTACKS
from hostile_relay import hostile_relay
from namespaces import BASE_GROUP, PORT, run
from testbed import check

MALLORY, CAROL = 3, 4  # hosts beside ALICE and BOB
FROZEN = 1 << 21  # of an appearance
ESTABLISHED = 2.0     # [s] until a peer holds its number against whoever claims to be older
HANDED_OUT = 7.0      # [s] until leaders are elected, and groups handed out and in use
BEFORE = 1.5          # [s] of contact looked at before each attack
FILLING = 10.0        # [s] longer where a table is to be filled first
SEEN = 2.5            # [s] within which a newcomer is shown meanwhile
LONGEST = 0.5         # [s] for which an attack may take the contact away
HEALED = 1.0          # [s] after it within which all is as before
MEMORY = 64.0         # [MiB] by which a peer may grow meanwhile
LINES = 3.0           # a second, to the user of a victim
FORGED_PER_S = 50_000
RECORDED = 3.0        # [s]
ATTACKS |= LEADER_ATTACKS
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")

SCENE = """
[scene]
name = "hostile"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"
k1 = "300 N/m"

[dead_reckoning]
position = "0.5 mm"
force = "0.02 N"

[aoim]
pool = 16

[[operator]]
trace = "press.csv"
approach = "-20 0 0 mm"
start = "1 s"

[[operator]]
trace = "press.csv"
position = "14 0 0 mm"
speed = 0.9

[[operator]]
sweep = {from = "0 300 0 mm", to = "0 310 0 mm", period = "1 s"}
"""


# A hand that goes to and fro by a millimetre each 1.1 s.
PRESS = "t_s,px_m,py_m,pz_m\n" + "".join(f"{0.01 * i:.3f},{0.0005 * (1 - math.cos(2 * math.pi * i / 110)):.7f},0,0\n"
                                         for i in range(111))

# Cells so small that there are more of them than groups.
WITH_LEADERS = "pool = 16\nleaders = true\nhand_out = true"


class Contact:
    """Two peers that touch each other, and what their lines told."""

    def __init__(self, bed, scene, heard=True, leaders=False):
        self._bed, self._scene = bed, scene
        self.sniffer = bed.sniff()
        self.heard = Heard(self.sniffer) if heard else None
        self._senders = {}
        self.peers = {"ALICE": self._start(ALICE, "ALICE"), "BOB": self._start(BOB, "BOB")}
        for peer, other in zip(self.peers.values(), ("BOB", "ALICE")):
            check(peer.wait_event("appeared", 5, other), f"{other} was never shown; {peer.error_text()}")
        time.sleep(HANDED_OUT if leaders else ESTABLISHED)

    def _start(self, host, name):
        return self._bed.peer(host, self._scene, name, host if host < CAROL else 3, ["--felt"])

    def say(self, group, octets, source=0):
        """From one of the ports of the attacker, by its number."""
        if source not in self._senders:
            self._senders[source] = self._bed.multicast_sender(MALLORY)
        try:
            self._senders[source].sendto(octets, (group, PORT))
        except OSError:
            pass  # a full queue of its own is the attacker's trouble

    def forces(self, peer, begin, end):
        """(monotonic time, force [N]) that its hand felt of others."""
        found = []
        for event in peer.events("felt"):
            when = peer.started + event["when"]
            if begin <= when < end:
                found.append((when, max(event["force_n"].values(), default=0.0)))
        return found

    def median(self, begin, end):
        """Of the one that feels less."""
        return min(statistics.median([f for _, f in self.forces(p, begin, end)] or [0.0])
                   for p in self.peers.values())

    def longest_gap(self, begin, end):
        """Longest time [s] for which one of them felt less than half of the least, or half more than the most, that it
        felt before."""
        longest = 0.0
        for peer in self.peers.values():
            before = [force for _, force in self.forces(peer, begin - BEFORE, begin)] or [0.0]
            since = last = begin
            for when, force in self.forces(peer, begin, end):
                if 0.5 * min(before) <= force <= 1.5 * max(before):
                    longest = max(longest, last - since)
                    since = when
                last = when
            longest = max(longest, last - since)
        return longest

    def memory(self):
        """Of the larger of both [MiB]."""
        return max(int(re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{p.process.pid}/status").read_text())[1])
                   for p in self.peers.values()) / 1024

    def notices(self, begin):
        return [event["text"] for peer in self.peers.values() for event in peer.events("notice")
                if peer.started + event["when"] >= begin]

    def wrongs(self, begin):
        """What the victims themselves said or did since `begin` that they would not have."""
        wrongs = []
        for (name, peer), host, other in zip(self.peers.items(), (ALICE, BOB), (BOB, ALICE)):
            said = self.heard.states(host)
            if any(state.appearance & FROZEN for state in said):
                wrongs.append(f"{name} froze")
            if len({state.id for state in said}) > 1:
                wrongs.append(f"{name} was renamed")
            theirs = {"{}:{}:{}".format(*state.id) for state in self.heard.states(other)}
            if any(peer.started + event["when"] >= begin and event["id"] in theirs for event in peer.events("gone")):
                wrongs.append(f"{name} dropped the other's hand")
        return wrongs

    def groups(self):
        """Groups that each victim has joined, as its kernel says."""
        return {host: set(re.findall(r"^\s+([0-9A-F]{8})\s", self._bed.system(host, "cat /proc/net/igmp"), re.M))
                for host in (ALICE, BOB)}

    def led(self, begin):
        """What the victims said of leaders since then."""
        return [text for text in self.notices(begin) if " led by " in text]

    def attack(self, attack, seconds):
        """(normal force, force meanwhile, force after, longest gap, sentences told, newcomer seen or None, wrongs). What
        was told of the attacker before stays told: a quiet minute makes it news again."""
        if attack.newcomer:
            seconds += FILLING
        time.sleep(BEFORE)
        groups = self.groups()
        begin = time.monotonic()
        normal = self.median(begin - BEFORE, begin)
        mallory = threading.Thread(target=self._repeat, args=(attack, begin, begin + seconds))
        mallory.start()
        seen = None
        if attack.newcomer:
            time.sleep(seconds - SEEN)
            carol = self._start(CAROL, "CAROL")
            since = [peer.seconds() for peer in self.peers.values()]
            until = time.monotonic() + SEEN
            seen = all(peer.wait_event("appeared", until - time.monotonic(), "CAROL", when)
                       for peer, when in zip(self.peers.values(), since))
        mallory.join()
        end = time.monotonic()
        time.sleep(HEALED + BEFORE)
        wrongs = self.wrongs(begin)
        if attack.leaders and not attack.believed:
            wrongs += self.misled(begin, groups, [carol] if attack.newcomer else [])
        if attack.newcomer:
            carol.end()
        return (normal, self.median(begin, end), self.median(end + HEALED, end + HEALED + BEFORE),
                self.longest_gap(begin, end + HEALED + BEFORE), self.notices(begin) + self.notices(0), seen, wrongs)

    def misled(self, begin, groups, newcomers):
        """Leaders, joins and entities that are there because of what was forged."""
        wrongs = [f"another leader: {text}" for text in self.led(begin)]
        for host, joined in self.groups().items():
            if joined != groups[host]:
                wrongs.append(f"host {host} joined {sorted(joined - groups[host])}, left {sorted(groups[host] - joined)}")
        for peer in [*self.peers.values(), *newcomers]:
            if any(event["marking"] == FORGED.decode() for event in peer.events("appeared")):
                wrongs.append("a forged entity was shown")
        return wrongs

    def _repeat(self, attack, begin, end):
        while time.monotonic() < end:
            attack.send(self.heard, begin, self.say)
            time.sleep(1.0 / attack.rate)


def short_of(attack, result, contact):
    """What this attack has done that it must not; empty where it failed."""
    normal, _, after, gap, told, seen, problems = result
    if gap > LONGEST:
        problems.append(f"contact interrupted for {gap:.1f} s")
    if not 0.8 * normal < after < 1.25 * normal:
        problems.append("not healed when it was over")
    if attack.told and not any(testbed.Testbed.address(MALLORY) in text for text in told):
        problems.append("nobody was told of the attacker")
    if seen is False:
        problems.append("a newcomer was shut out")
    for peer in contact.peers.values():
        if any(CONTROL.search(text) for _, text in peer.lines + peer.errors):
            problems.append("control characters reached a terminal")
            break
    return problems


def row(attack, result, problems):
    normal, during, after, gap, told, seen, _ = result
    print(f"| {attack.sentence} | {normal:.2f} | {during:.2f} | {after:.2f} | {gap:.1f} | "
          f"{'' if seen is None else 'seen' if seen else 'shut out'} | {told[0] if told else 'nothing'} | "
          f"{'; '.join(problems) or 'held'} |", flush=True)


HEAD = ("| attack | force before [N] | during | after | longest interruption [s] | newcomer | first told | |\n"
        "|---|---:|---:|---:|---:|---|---|---|")


def scene_in(setup, aoim="pool = 16", network=(), objects=""):
    (setup.folder / "scenes/press.csv").write_text(PRESS)
    path = setup.folder / "scenes/hostile.toml"
    path.write_text("\n".join((SCENE.replace("pool = 16", aoim), objects, "[network]", *network)))
    return path


def attack_all(setup, names, seconds, fresh):
    """Each by a fresh pair, or all by one."""
    failed = []
    print(HEAD, flush=True)

    def one(contact, attack):
        result = contact.attack(attack, seconds)
        check(result[0] > 0.1, f"no contact before the attack: {result[0]} N")
        problems = short_of(attack, result, contact)
        row(attack, result, problems)
        failed.extend(f"{attack.sentence}: {problem}" for problem in problems)

    if fresh:
        for name in names:
            with setup.testbed(CAROL) as bed:
                leaders = ATTACKS[name].leaders
                contact = Contact(bed, scene_in(setup, WITH_LEADERS) if leaders else scene_in(setup), leaders=leaders)
                one(contact, ATTACKS[name])
                if "-v" in sys.argv:
                    print(contact.notices(0), *(peer.report() for peer in contact.peers.values()), sep="\n")
    else:
        with setup.testbed(CAROL) as bed:
            contact = Contact(bed, scene_in(setup))
            for name in names:
                one(contact, ATTACKS[name])
    check(not failed, "; ".join(failed))


def hostile_table(setup):
    """Every attack, each against a fresh pair in contact: none interrupts it, none outlasts itself, each is told."""
    attack_all(setup, ATTACKS, 4.0, fresh=True)
    hostile_page.hostile_page(setup)


def hostile_leaders(setup):
    """Forged claims of the lead, maps of groups and snapshots, each against a fresh pair in contact: no leader, no join, no
    entity of theirs."""
    attack_all(setup, LEADER_ATTACKS, 4.0, fresh=True)


FAMILIES_HEAD = ("| family | attacks | held | longest interruption [s] | more memory [MiB] | lines a second |\n"
                 "|---|---:|---:|---:|---:|---:|")
FAMILIES_PLACE = re.compile(r"(<!-- table of families -->\n).*?(<!-- end of it -->)", re.S)


def summary(results):
    """The worst of each family, as a table: (gap, memory, lines, held) of each of its attacks."""
    rows = [FAMILIES_HEAD]
    for name, attacks in results.items():
        gap, memory, lines, _ = (max(column) for column in zip(*attacks))
        held = sum(attack[3] for attack in attacks)
        rows.append(f"| `{name}` | {len(attacks)} | {held} | {gap:.1f} | {max(0.0, memory):.0f} | {lines:.1f} |")
    return "\n".join(rows) + "\n"


def hostile_families(setup):
    """Attacks whose numbers a seed draws: no contact is interrupted, memory and lines are bounded, nobody exits."""
    first = random.randrange(10**6) if setup.seed is None else setup.seed
    failed, results = [], {}
    print(HEAD, flush=True)
    for seed in range(first, first + setup.runs):
        for name in (setup.family,) if setup.family else (*hostile_drawn.FAMILIES, hostile_page.NAME):
            if name == hostile_page.NAME:
                failed.extend(f"{name} {seed}: {problem}" for problem in hostile_page.attack(setup, seed))
                continue
            with setup.testbed(CAROL) as bed:
                attack = hostile_drawn.of(name, seed)
                aoim = "\n".join(("pool = 16", *attack.aoim))
                contact = Contact(bed, scene_in(setup, aoim, attack.network, attack.objects))
                memory, begin = contact.memory(), time.monotonic()
                result = contact.attack(attack, 4.0)
                check(result[0] > 0.1, f"no contact before the attack: {result[0]} N")
                problems = short_of(attack, result, contact)
                more = contact.memory() - memory
                lines = len(contact.notices(begin)) / len(contact.peers) / (time.monotonic() - begin)
                if more > MEMORY:
                    problems.append(f"{more:.0f} MiB more memory")
                if lines > LINES:
                    problems.append(f"{lines:.0f} lines a second")
                row(attack, result, problems)
                results.setdefault(name, []).append((result[3], more, lines, not problems))
                if "-v" in sys.argv:
                    print(contact.notices(0), *(peer.report() for peer in contact.peers.values()), sep="\n")
            failed.extend(f"{name} {seed}: {problem}" for problem in problems)
    print("\n" + summary(results), flush=True)
    if setup.write:
        page = setup.write.read_text()
        check(FAMILIES_PLACE.search(page), f"{setup.write} has no place for the table")
        setup.write.write_text(FAMILIES_PLACE.sub(lambda m: m[1] + summary(results) + m[2], page))
    check(not failed, "; ".join(failed))


def hostile_short(setup):
    """Five forgeries against one pair in contact: none interrupts it, each is told."""
    attack_all(setup, ("freeze", "leap", "deactivate", "move", "replay"), 1.0, fresh=False)


def sealed_scene(setup):
    """The scene with a key, and the key."""
    (setup.folder / "scenes/press.csv").write_text(PRESS)
    path = setup.folder / "scenes/sealed.toml"
    path.write_text(SCENE.replace("pool = 16", WITH_LEADERS) + '\n[network]\nkey = "exercise.key"\n')
    key = setup.folder / "scenes/exercise.key"
    subprocess.run([setup.reckon, "key", "new", str(key)], check=True, capture_output=True)
    return path


REFUSED = ("unsealed_in", "sealed_other_suite_in", "sealed_unknown_epoch_in", "sealed_old_epoch_in", "sealed_own_in",
           "sealed_no_stream_in", "sealed_replayed_in", "sealed_forged_in", "sealed_outdated_in")


def forge(setup, wanted):
    """So many datagrams of a sealed pair in contact, altered or as they were. An accepted one would be one that is neither
    refused nor dropped by the kernel."""
    with setup.testbed(CAROL) as bed:
        contact = Contact(bed, sealed_scene(setup), heard=False, leaders=True)
        # What a peer missed, before it came, say, is no replay to it but a late datagram.
        since = time.monotonic()
        time.sleep(RECORDED)
        said = [payload for when, _, _, payload in list(contact.sniffer.datagrams) if when > since]
        contact.sniffer.stop()
        check(len(said) > 20, f"{len(said)} datagrams recorded")
        recording = setup.folder / "recording"
        recording.write_text("".join(payload.hex() + "\n" for payload in said))
        groups = contact.groups()
        begin, sent = time.monotonic(), 0
        while sent < wanted:
            seconds = max((wanted - sent) / FORGED_PER_S, 0.1)  # a shorter flood may be over before it sends
            flood = bed.run(MALLORY, [setup.flood, testbed.Testbed.address(MALLORY), BASE_GROUP, str(PORT + 1),
                                      str(FORGED_PER_S), str(seconds), str(recording)])
            flood.wait(seconds + 20)
            check(flood.process.returncode == 0 and flood.lines, f"flood: {flood.error_text()}")
            more = json.loads(flood.lines[-1][1])["sent"]
            check(more > 0, "nothing could be sent")
            sent += more
        end = time.monotonic()
        time.sleep(HEALED)
        gap = contact.longest_gap(begin, end + HEALED)
        misled = contact.misled(begin, groups, [])
        gone = [f"{name} dropped {event['id']}" for name, peer in contact.peers.items() for event in peer.events("gone")]
        for peer in contact.peers.values():
            peer.interrupt()
        reports = {name: peer.report() for name, peer in contact.peers.items()}
    print(f"  {sent} sent, {sent / (end - begin):.0f} a second, made of {len(said)}")
    for (name, report), other in zip(reports.items(), reversed(reports.values())):
        refused = {counter: report[counter] for counter in REFUSED if report[counter]}
        drops = report["link"]["kernel_drops"]
        print(f"  {name}: {sum(refused.values())} refused ({refused}), {drops} dropped by the kernel; "
              f"{report['sealed_in']} opened of {other['link']['sent']} that the other sent")
        check(sum(refused.values()) + drops >= sent, f"{name} accepted {sent - sum(refused.values()) - drops}")
        check(report["sealed_in"] <= other["link"]["sent"], f"{name} opened more than was sent")
        check(drops < 0.5 * sent, "this machine is too busy: most were dropped before they were looked at")
    print(f"  longest interruption of the contact {gap:.2f} s")
    print(f"  leaders: {[report['leaders']['scene'] for report in reports.values()]}, "
          f"{sum(map(len, groups.values()))} groups joined before and after")
    check(not gone + misled, "; ".join(gone + misled))
    check(gap <= LONGEST, f"contact interrupted for {gap:.1f} s")


def hostile_sealed(setup):
    """Ten million forged, altered or replayed datagrams against a pair with a key: none is accepted, contact goes on."""
    forge(setup, 10_000_000)


def hostile_sealed_short(setup):
    """200,000 of the same."""
    forge(setup, 200_000)


CASES = {case.__name__: case for case in (hostile_table, hostile_leaders, hostile_families, hostile_short, hostile_sealed, hostile_sealed_short, hostile_page.hostile_page, hostile_relay)}


def one_attack(name):
    """A case of its own."""
    def case(setup):
        attack_all(setup, (name,), 4.0, fresh=True)
    case.__doc__ = ATTACKS[name].sentence
    return case


CASES |= {f"hostile_{name}": one_attack(name) for name in ATTACKS}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
