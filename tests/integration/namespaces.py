# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Peers as users run them, each in a network namespace of its own: joining, dying, coming back, meeting
strangers. One case per call:
  namespaces.py CASE --reckon PROGRAM --scenes FOLDER [--data FOLDER] [--stream PROGRAM] [--snooping]"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import dis_wire as dis
import testbed
from testbed import Skip, Testbed, check

BASE_GROUP, PORT = "239.192.1.0", 3000
SEEN_WITHIN = 1.0          # [s], acceptance limit until a remote entity is shown
PRESENCE_TIMEOUT = 6.1     # [s], six missed announcements and 100 ms of slack
POLL = 0.1                 # [s], between two checks of a peer's own table
SLACK = 1.0                # [s], for a loaded machine


def served(report, share=0.95):
    """Checks that the servo ran on: it missed at most 1 - share of the periods of its life."""
    periods = 1000 * report["seconds"]
    missed = report["missed_steps"]
    print(f"  {report['id']}: {report['seconds']:.1f} s, {missed} servo periods missed, "
          f"{report['packets_per_s']:.1f} packets/s, lost {report['datagrams_lost']}")
    check(missed < (1 - share) * periods, f"{missed} of {periods:.0f} servo periods missed")


def meet(first, second, names):
    """Checks that both peers show each other's hand in time."""
    for peer, other in ((first, names[1]), (second, names[0])):
        seen = peer.wait_event("appeared", 5, other)
        check(seen, f"{other} was never shown; {peer.error_text()}")


def survivor_stream(sniffer, host, since, until):
    """Entity States of a host, longest gap in its datagrams, and missing sequence numbers: seen neither in that time
    nor before or after, because two datagrams may be swapped at its ends."""
    sender = Testbed.address(host)
    states = sum(kind == dis.ENTITY_STATE
                 for _, _, _, kind, _ in sniffer.pdus(sender, since, until))
    times = [when for when, source, _, _ in list(sniffer.datagrams)
             if source == sender and since <= when < until]
    gap = max((b - a for a, b in zip([since, *times], [*times, until])), default=until - since)
    then, ever = {}, {}
    for when, source, group, payload in list(sniffer.datagrams):
        mark = dis.trailer(payload)
        if source == sender and mark:
            ever.setdefault((group, mark[1]), set()).add(mark[0])
            if since <= when < until:
                then.setdefault((group, mark[1]), []).append(mark[0])
    missing = sum(len(set(range(min(numbers), max(numbers))) - ever[stream])
                  for stream, numbers in then.items())
    check(sniffer.dropped() == 0, f"the sniffer itself lost {sniffer.dropped()} frames")
    return states, gap, missing


def two_peers(setup):
    """Shown < 1 s after start; one is killed: the other goes on and drops it; it comes back."""
    with setup.testbed(2) as bed:
        sniffer = bed.sniff()
        alice = bed.peer(1, setup.scene, "ALICE", 1)
        bob = bed.peer(2, setup.scene, "BOB", 2)
        meet(alice, bob, ("ALICE", "BOB"))
        time.sleep(3)

        killed, killed_by_alice = time.monotonic(), alice.seconds()
        bob.kill()
        gone = alice.wait_event("gone", PRESENCE_TIMEOUT + 2, "BOB", killed_by_alice)
        check(gone, "the dead peer was never dropped")
        silent = gone[0] - killed_by_alice
        print(f"  dropped {silent:.2f} s after kill -9 (time-out {PRESENCE_TIMEOUT} s)")
        check(PRESENCE_TIMEOUT - 1.1 < silent < PRESENCE_TIMEOUT + POLL + SLACK,
              f"dropped after {silent:.2f} s")
        count, gap, missing = survivor_stream(sniffer, 1, killed, time.monotonic())
        print(f"  survivor meanwhile: {count} Entity States, longest gap {gap:.2f} s, {missing} lost")
        check(count >= 3 and gap < 1.5 and missing == 0, "the survivor's updates did not flow on")

        bob = bed.peer(2, setup.scene, "BOB", 2)
        again = alice.wait_event("appeared", 5, "BOB", gone[0])
        check(again, "the restarted peer was not shown")
        back = again[0] + alice.started - bob.started
        time.sleep(1.5)
        reports = [bob.report(), alice.report()]
        print(f"  back {back:.2f} s after its new process began; "
              f"remote seen after {[r['remote_seen_s'] for r in reports]} s")
        check(back < SEEN_WITHIN, f"shown {back:.2f} s after the restart")
        for report in reports:
            check(report["remote_seen_s"] < SEEN_WITHIN, f"seen after {report['remote_seen_s']} s")
            check(report["energy_min_j"] >= -1e-9 - report["late_cost_j"], f"energy {report['energy_min_j']} J")
            served(report)


def three_peers(setup):
    """Each of three is killed in turn; the two others lose nothing of each other."""
    names = ("ALICE", "BOB", "CAROL")
    with setup.testbed(3) as bed:
        sniffer = bed.sniff()
        scene = setup.scene_of(3)
        for victim in range(3):
            peers = [bed.peer(i + 1, scene, names[i], i + 1) for i in range(3)]
            for i, peer in enumerate(peers):
                for other in set(names) - {names[i]}:
                    check(peer.wait_event("appeared", 5, other), f"{names[i]} never saw {other}")
            time.sleep(1)
            killed = time.monotonic()
            peers[victim].kill()
            survivors = [i for i in range(3) if i != victim]
            for i in survivors:
                check(peers[i].wait_event("gone", PRESENCE_TIMEOUT + 2, names[victim]),
                      f"{names[i]} never dropped {names[victim]}")
            until = time.monotonic()
            print(f" {names[victim]} killed")
            for i in survivors:
                count, gap, missing = survivor_stream(sniffer, i + 1, killed, until)
                print(f"  {names[i]}: {count} Entity States in {until - killed:.1f} s, "
                      f"longest gap {gap:.2f} s, {missing} missing on the wire")
                check(count >= 3 and gap < 1.5, f"{names[i]}: {count} updates, silent {gap:.2f} s")
                check(missing == 0, f"{missing} datagrams of {names[i]} missing on the wire")
            for i in survivors:
                # The other survivor is still there: it lost nothing and was not dropped.
                other = names[next(k for k in survivors if k != i)]
                check(not any(e["marking"] == other for e in peers[i].events("gone")),
                      f"{names[i]} dropped the living {other}")
            for i in survivors:
                peers[i].interrupt()
            for i in survivors:
                report = peers[i].report()
                served(report)
                check(report["datagrams_lost"] == 0, f"{report['datagrams_lost']} datagrams lost")


def other_scene(setup):
    """The same scene with another stiffness: told once, never joined."""
    changed = setup.changed_scene("other", 'stiffness = "800 N/m"', 'stiffness = "700 N/m"')
    with setup.testbed(2) as bed:
        peers = [bed.peer(1, setup.scene, "ALICE", 1), bed.peer(2, changed, "BOB", 2)]
        time.sleep(5)
        for peer in peers:
            report = peer.report()
            told = [text for _, text in peer.errors if "another scene" in text]
            print(f"  told {told}")
            check(len(told) == 1, f"told {len(told)} times in {report['seconds']:.1f} s")
            check(report["entities"] == 0 and not peer.events("appeared"), "joined all the same")


def inspector(setup):
    """`reckon inspect` on a third host, as a normal user, understands every PDU of two peers."""
    if shutil.which("setpriv") is None:
        raise Skip("needs setpriv (Debian: util-linux)")
    with setup.testbed(3) as bed:
        alice = bed.peer(1, setup.scene, "ALICE", 1)
        bob = bed.peer(2, setup.scene, "BOB", 2)
        meet(alice, bob, ("ALICE", "BOB"))
        watch = bed.run(3, ["setpriv", "--reuid", "65534", "--regid", "65534", "--clear-groups",
                            setup.reckon, "inspect", "--iface", "e0", "--for", "5s", "--json"])
        status = watch.wait(20)
        rows = [json.loads(text) for _, text in watch.lines]
        kinds = {kind: sum(r["type"] == kind for r in rows) for kind in {r["type"] for r in rows}}
        print(f"  {len(rows)} PDUs: {kinds}; {watch.error_text().splitlines()[-1]}")
        bad = [row for row in rows if row["status"] in ("error", "warning")]
        check(status == 0 and not bad, f"status {status}, {bad[:3]}")
        for kind in ("entity_state", "attribute", "presence", "datagram_trailer"):
            check(kinds.get(kind, 0) > 0, f"no {kind} among {kinds}")
        markings = {row.get("marking") for row in rows if row["type"] == "entity_state"}
        check(markings == {"ALICE", "BOB"}, f"markings {markings}")


def same_id(setup):
    """Two peers start at the same instant on one host: both want the same ID, one gets another."""
    with setup.testbed(1) as bed:
        for attempt in range(3):
            peers = [bed.peer(1, setup.scene, name, i + 1)
                     for i, name in enumerate(("ALICE", "BOB"))]
            meet(*peers, ("ALICE", "BOB"))
            time.sleep(1)
            for peer in peers:
                peer.interrupt()
            ids = [peer.report()["id"] for peer in peers]
            taken = [text for p in peers for _, text in p.errors if "is taken" in text]
            print(f"  {ids}; {taken}")
            check(ids[0] != ids[1], f"both are {ids[0]}")
            check(taken, f"no conflict was told; IDs {ids}")


def interop(setup):
    """A plain DIS listener hears valid Entity States and nothing experimental."""
    scene = setup.changed_scene("interop", "[hand]", "[network]\ninterop = true\n\n[hand]")
    with setup.testbed(3) as bed:
        sniffer = bed.sniff()
        listener = bed.multicast_receiver(3, BASE_GROUP, PORT)
        peers = [bed.peer(1, scene, "ALICE", 1), bed.peer(2, scene, "BOB", 2)]
        heard, kinds, end = {}, {}, time.monotonic() + 5
        while time.monotonic() < end:
            try:
                payload = listener.recv(65536)
            except TimeoutError:
                continue
            for kind, octets in dis.pdus(payload):
                kinds[kind] = kinds.get(kind, 0) + 1
                if kind == dis.ENTITY_STATE:
                    state = dis.EntityState(octets)
                    check(not list(state.problems()), f"{list(state.problems())}")
                    heard.setdefault(state.marking, []).append(state)
        groups = {group for _, _, group, kind, _ in sniffer.pdus()}
        print(f"  PDUs by type {kinds}; hands {({m: len(s) for m, s in heard.items()})}")
        check(set(heard) == {"ALICE", "BOB"}, f"heard {set(heard)}")
        check(not any(k >= dis.FIRST_EXPERIMENTAL for k in kinds), f"experimental PDUs: {kinds}")
        check(groups == {BASE_GROUP}, f"spoke to {groups}")
        meet(*peers, ("ALICE", "BOB"))
        for peer in peers:
            served(peer.report())


def recorded_session(setup):
    """A recorded VR-Forces exercise, played into the base group, shows as remote entities."""
    capture = setup.data / "dis-captures/real-sessions/turn90-1.pcap"
    if not capture.exists():
        raise Skip(f"needs {capture}; set RECKON_DATA")
    frames = list(dis.read_pcap(capture))
    states = []
    for _, payload in frames:
        try:
            states += [dis.EntityState(o) for k, o in dis.pdus(payload) if k == dis.ENTITY_STATE]
        except ValueError:
            pass  # the recorder truncated one datagram; the peer must tolerate it
    latitude, longitude, height = dis.geodetic(states[0].location)
    # They move within 1 km: the peer has a scene of its own there with a sufficient radius.
    scene = setup.changed_scene(
        "hawaii", 'latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"',
        f'latitude = "{latitude:.7f} deg", longitude = "{longitude:.7f} deg", height = "{height:.2f} m"',
        more='\n[aoim]\ncell = "5 km"\nradius = "5 km"\n')
    near_only = setup.changed_scene(
        "hawaii_near", 'latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"',
        f'latitude = "{latitude:.7f} deg", longitude = "{longitude + 1:.7f} deg", height = "{height:.2f} m"')
    speed = 10.0
    with setup.testbed(3) as bed:
        alice = bed.peer(1, scene, "ALICE", 1)
        far = bed.peer(2, near_only, "FAR", 1)
        sender = bed.multicast_sender(3)
        time.sleep(1)
        begin = time.monotonic()
        for when, payload in frames:
            due = begin + (when - frames[0][0]) / speed
            time.sleep(max(0.0, due - time.monotonic()))
            sender.sendto(payload, (BASE_GROUP, PORT))
        time.sleep(0.5)
        report, far_report = alice.report(), far.report()
    ids = {"{}:{}:{}".format(*s.id) for s in states}
    shown = {e["id"]: e["marking"] for e in alice.events("appeared")}
    print(f"  {len(frames)} datagrams, {len(states)} Entity States of {ids}; shown {shown}, "
          f"{report['updates_in']} updates accepted, {report['stale_in']} stale, "
          f"{report['malformed_in']} malformed; "
          f"100 km away: {far_report['entities']} shown")
    check(ids <= set(shown), f"{ids - set(shown)} were never shown")
    check(report["updates_in"] >= 0.99 * len(states), f"{report['updates_in']} of {len(states)}")
    check(report["malformed_in"] == 1, "the one PDU that the recorder cut was not refused")
    check(far_report["updates_in"] == 0, "a peer 100 km away took them in")
    served(report)


def impairment(setup):
    """The same seed over veth and in process: loss share and mean delay agree within 1 %."""
    law = ["--count", "30000", "--rate", "3000", "--seed", "7"]
    with setup.testbed(2) as bed:
        simulated = json.loads(testbed.subprocess.run(
            [setup.stream, "simulate", *law], capture_output=True, text=True, check=True).stdout)
        receiver = bed.run(2, [setup.stream, "receive", "--iface", "e0", *law])
        check(receiver.wait_line("ready", 5, errors=True), receiver.error_text())
        sender = bed.run(1, [setup.stream, "send", "--iface", "e0", *law])
        check(sender.wait(60) == 0, sender.error_text())
        check(receiver.wait(60) == 0, receiver.error_text())
        real = json.loads(receiver.lines[-1][1])
    print(f"  in process {simulated}\n  over veth  {real}")
    check(abs(real["loss"] - simulated["loss"]) <= 0.01, "loss share differs by more than 1 %")
    for key in ("delay_s", "handed_over_s"):
        apart = abs(real[key] - simulated[key]) / simulated[key]
        print(f"  {key}: apart by {100 * apart:.3f} %")
        check(apart <= 0.01, f"mean {key} differs by {100 * apart:.2f} %")


CASES = {case.__name__: case for case in (two_peers, three_peers, other_scene, inspector, same_id,
                                          interop, recorded_session, impairment)}


class Setup:
    """Paths, and scenes made from the shipped one."""

    def __init__(self, arguments, folder):
        # A copy that any user may execute and read.
        self.folder = pathlib.Path(folder)
        self.folder.chmod(0o755)
        self.reckon = testbed.copied_program(arguments.reckon, self.folder)
        pathlib.Path(self.reckon).chmod(0o755)
        self.stream = arguments.stream
        self.truck = shutil.copy(arguments.truck, self.folder / "truck") if arguments.truck else ""
        self.crowd = arguments.crowd
        self.feeler = arguments.feeler
        self.flood = arguments.flood
        self.coupled = arguments.coupled
        self.node_path = arguments.node_path
        self.runs = arguments.runs
        self.seed = arguments.seed
        self.family = arguments.family
        self.write = arguments.write
        self.snooping = arguments.snooping
        self.data = pathlib.Path(arguments.data)
        shutil.copytree(arguments.scenes, self.folder / "scenes")
        self.scene = self.folder / "scenes/two_hands.toml"

    def testbed(self, hosts):
        return Testbed(hosts, self.reckon, self.snooping)

    def changed_scene(self, name, old, new, more=""):
        text = self.scene.read_text()
        check(text.count(old) == 1, f"'{old}' is not once in {self.scene}")
        path = self.folder / "scenes" / f"{name}.toml"
        path.write_text(text.replace(old, new) + more)
        return path

    def scene_of(self, peers):
        """The scene with so many operators; the further ones rest."""
        resting = "".join(f'\n[[operator]]\npassive = true\nposition = "{60 * number} 80 60 mm"\n' for number in range(3, peers + 1))
        return self.changed_scene(f"of_{peers}", "[hand]", "[hand]", resting)


def run(case):
    parser = argparse.ArgumentParser()
    parser.add_argument("case")
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--scenes", required=True)
    parser.add_argument("--stream", default="")
    parser.add_argument("--truck", default="")
    parser.add_argument("--crowd", default="")
    parser.add_argument("--feeler", default="")
    parser.add_argument("--flood", default="")
    parser.add_argument("--coupled", default="")
    parser.add_argument("--node-path", default="", help="where the npm package open-dis may lie")
    parser.add_argument("--data", default=os.environ.get("RECKON_DATA", ""))
    parser.add_argument("--runs", type=int, default=1, help="so many seeds of each family of attacks")
    parser.add_argument("--seed", type=int, default=None, help="the first of them")
    parser.add_argument("--family", default="", help="this one alone")
    parser.add_argument("--write", type=pathlib.Path, help="the page whose table of families is replaced")
    parser.add_argument("-v", action="store_true", help="reports of the peers too")
    parser.add_argument("--snooping", action="store_true", help="a bridge that floods nothing")
    arguments = parser.parse_args()
    testbed.need_root_and_ip()
    print(case.__doc__)
    with tempfile.TemporaryDirectory(prefix="reckon_") as folder:
        case(Setup(arguments, folder))


if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
