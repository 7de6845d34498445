# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A hostile LAN: two peers touch each other while a third host, at an address of its own, attacks without a key.
`table` runs every attack against a fresh pair and prints the result; `short` runs some attacks against one pair;
`leaders` runs those for a pair whose cells have leaders; `relay` runs against a quiet peer; `families` draws the
numbers of each attack from a seed; `sealed` sends forged and replayed datagrams, 10 million of them, to such a pair
with a key."""
import json
import random
import subprocess
import sys
import time

import hostile_drawn
import hostile_page
import hostile_relay
import testbed
from hostile_attacks import ATTACKS
from hostile_contact import (CAROL, CONTROL, FORGED_PER_S, HEALED, LINES, LONGEST, MALLORY, MEMORY, PRESS, RECORDED, SCENE,
                             WITH_LEADERS, Contact)
from hostile_leaders import LEADER_ATTACKS
from namespaces import BASE_GROUP, PORT, run
from testbed import check


def short_of(attack, result, contact):
    """Requirements that this attack violated; empty if the victims passed."""
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
    """Runs each attack against a fresh pair, or all against one."""
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


OWN_FAMILIES = {"page": hostile_page.attack, "relay": hostile_relay.attack}  # they need no contact


def hostile_families(setup):
    """Attacks whose numbers a seed draws: no contact is interrupted, memory and lines are bounded, nobody exits."""
    first = random.randrange(10**6) if setup.seed is None else setup.seed
    failed, results = [], {}
    print(HEAD, flush=True)
    for seed in range(first, first + setup.runs):
        for name in (setup.family,) if setup.family else (*hostile_drawn.FAMILIES, *OWN_FAMILIES):
            if name in OWN_FAMILIES:
                problems = OWN_FAMILIES[name](setup, seed)
                results.setdefault(name, []).append((0.0, 0.0, 0.0, not problems))
                failed.extend(f"{name} {seed}: {problem}" for problem in problems)
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
    hostile_drawn.show_summary(results, setup.write)
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
    """Sends `wanted` datagrams of a sealed pair in contact, altered or unchanged. An accepted datagram is one that is
    neither refused nor dropped by the kernel."""
    with setup.testbed(CAROL) as bed:
        contact = Contact(bed, sealed_scene(setup), heard=False, leaders=True)
        # A datagram that a peer missed, for example before it joined, is late for it and not a replay.
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
            seconds = max((wanted - sent) / FORGED_PER_S, 0.1)  # a shorter flood may end before it sends
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


CASES = {case.__name__: case for case in (hostile_table, hostile_leaders, hostile_families, hostile_short, hostile_sealed, hostile_sealed_short, hostile_page.hostile_page, hostile_relay.hostile_relay)}


def one_attack(name):
    """Declares the attack as a case."""
    def case(setup):
        attack_all(setup, (name,), 4.0, fresh=True)
    case.__doc__ = ATTACKS[name].sentence
    return case


CASES |= {f"hostile_{name}": one_attack(name) for name in ATTACKS}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
