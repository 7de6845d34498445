# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Peers that own more entities than a hand, or none, each in a network namespace of its own: a truck, two hands, no
device, a post that is felt elsewhere, ten thousand vehicles. One case per call, with the arguments of namespaces.py."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

import dis_wire as dis
import testbed
from namespaces import BASE_GROUP, PORT, meet, run, served
from testbed import Skip, Testbed, check

ROUNDING = 1e-9            # [J], of the ledgers
TO_ALL = f"udp://{BASE_GROUP}:{PORT}"


def energy_kept(report):
    print(f"  {report['id']}: energy never below {report['energy_min_j']:.1e} J (late steps {report['late_cost_j']:.1e}), {report['trips']} trips")
    check(report["energy_min_j"] >= -ROUNDING - report["late_cost_j"], f"energy {report['energy_min_j']} J")
    check(report["trips"] == 0, f"{report['trips']} cuts of the force")


def two_handed(setup):
    """One peer with two devices: another sees both its hands, and all feel each other by books that stay right."""
    scene = setup.folder / "scenes/two_handed.toml"
    with setup.testbed(2) as bed:
        both = bed.peer(1, scene, "BOTH", 1)
        guest = bed.peer(2, scene, "ONE", 2)
        for marking in ("LEFT", "RIGHT"):
            check(guest.wait_event("appeared", 5, marking), f"{marking} was never shown; {guest.error_text()}")
        check(both.wait_event("appeared", 5, "GUEST"), f"GUEST was never shown; {both.error_text()}")
        time.sleep(7)  # each hand has moved to and fro
        shown = [event["marking"] for event in both.events("appeared")]
        check(shown == ["GUEST"], f"a peer shows its own hands as remote ones: {shown}")
        for peer in (guest, both):
            report = peer.report()
            served(report)
            energy_kept(report)


def without_device(setup):
    """A peer without any device has no servo and shows its truck; a hand elsewhere comes and goes."""
    scene = setup.folder / "scenes/truck.toml"
    with setup.testbed(2) as bed:
        depot = bed.peer(1, scene, "DEPOT", 1)
        hand = bed.peer(2, scene, "HAND", 2)
        meet(depot, hand, ("TRUCK", "HAND"))
        time.sleep(3)
        report = hand.report()
        check(depot.wait_event("gone", 2, "HAND"), "the hand that left is still shown")
        mine = depot.report()
        print(f"  without a device: {mine['servo_steps']} servo steps, {mine['updates_out']} updates, "
              f"{report['updates_in']} arrived")
        check(mine["servo_steps"] == 0 and mine["missed_steps"] == 0, f"{mine['servo_steps']} servo steps")
        # 9 m/s in a circle at a threshold of 1 m: at most a few a second, and at least a heartbeat.
        check(2 <= report["updates_in"] <= 100, f"{report['updates_in']} updates of the truck")
        served(report)


def hand_heights(sniffer, host, marking, until, ground=430.0):
    """Height [m] above the scene's origin in each Entity State of an entity that was received before a time."""
    for _, _, _, kind, octets in sniffer.pdus(Testbed.address(host), until=until):
        if kind == dis.ENTITY_STATE and dis.EntityState(octets).marking == marking:
            yield dis.geodetic(dis.EntityState(octets).location)[2] - ground


def post(setup):
    """A post and a tip of one process are felt by a hand of another; the energy of both is booked."""
    shipped = setup.folder / "scenes/post.toml"
    lead = 'sweep = {from = "0 0 30 mm", to = "0 0 -58 mm", period = "8 s"}'
    check(shipped.read_text().count(lead) == 1, f"'{lead}' is not once in {shipped}")
    # Fast enough to strike, and not deeper than the device can resist; another hand that the tip pushes.
    scene = setup.folder / "scenes/struck_post.toml"
    scene.write_text(shipped.read_text().replace(
        lead, 'sweep = {from = "0 0 0 mm", to = "0 0 -54 mm", period = "1.2 s"}\nstiffness = "300 N/m"')
        + '\n[[operator]]\npassive = true\nposition = "10 20 15 mm"\nstiffness = "60 N/m"\n'
        + '\n[[device]]\npeer = 2\noperator = 2\nmarking = "PUSHED"\n')
    with setup.testbed(2) as bed:
        sniffer = bed.sniff()
        owner = bed.peer(1, scene, "OWNER", 1)
        hand = bed.peer(2, scene, "HAND", 2)
        for marking in ("POST", "TIP"):
            check(hand.wait_event("appeared", 5, marking), f"{marking} was never shown; {hand.error_text()}")
        time.sleep(6)
        # The post disappears with its owner, so forces on it are checked only while it exists.
        stands_until = time.monotonic()
        mine, theirs = owner.report(), hand.report()
        served(theirs)
        energy_kept(theirs)
        check(mine["servo_steps"] == 0, "the owner of the post has a servo")

        ids = {dis.EntityState(o).marking: dis.EntityState(o).id for _, _, _, k, o in sniffer.pdus()
               if k == dis.ENTITY_STATE}
        lowest = min(hand_heights(sniffer, 2, "HAND", stands_until))
        struck = {dis.struck(o) for _, _, _, k, o in sniffer.pdus(Testbed.address(2)) if k == dis.COLLISION_ELASTIC}
        print(f"  the hand is led to -54 mm and comes to {1e3 * lowest:.1f} mm; it struck {struck}, {ids}")
        # Surface at -50 mm, felt from 10 mm above; 600 N/m against 300 N/m: -44.7 mm, plus its oscillation.
        check(lowest > -0.051, "the post was not felt")
        check(lowest < -0.040, "the hand never came to the post")
        check(ids["POST"] in struck, "no impact on the post was told")

        given, asked = {}, set()
        for host in (1, 2):
            for _, _, _, kind, octets in sniffer.pdus(Testbed.address(host)):
                for entity, other, total, need in dis.energy_accounts(octets) if kind == dis.ATTRIBUTE else ():
                    check(total >= given.get((entity, other), 0.0), f"{entity} took back from {other}")
                    given[entity, other] = total
                    if need > 0:
                        asked.add(entity)
        by_owner = sum(total for (entity, _), total in given.items() if entity[:2] == ids["POST"][:2])
        print(f"  given [J]: {given}; asked: {asked}; the owner put in {mine['power_given_uj']} uJ")
        check(given.get((ids["POST"], ids["HAND"]), 0.0) == 0.0, "a post that stands gave energy")
        check(by_owner <= 1e-6 * (mine["power_given_uj"] + 1), "more was said to be given than was booked")
        check(by_owner > 0 and (ids["PUSHED"], ids["TIP"]) in {pair[:2] for pair in given},
              "the tip pushed nobody: the books were not asked")
        check(by_owner <= 0.05 * mine["seconds"], "the tip gave more than its 50 mW")


def datagrams_of(bed, host):
    """Number of datagrams that a host has sent so far, counted at its port of the switch."""
    words = ["ip", "-n", bed.namespace("sw"), "-s", "-j", "link", "show", f"p{host}"]
    link = json.loads(subprocess.run(words, capture_output=True, text=True, check=True).stdout)[0]
    return time.monotonic(), link["stats64"]["rx"]["packets"]


def busiest(bed, host, seconds):
    """Greatest rate of datagrams a second from a host in any 100 ms of the next `seconds`."""
    seen, most = [datagrams_of(bed, host)], 0.0
    end = seen[0][0] + seconds
    while seen[-1][0] < end:
        seen.append(datagrams_of(bed, host))
        while len(seen) > 2 and seen[-1][0] - seen[1][0] >= 0.1:
            seen.pop(0)
        span = seen[-1][0] - seen[0][0]
        if span >= 0.1:
            most = max(most, (seen[-1][1] - seen[0][1]) / span)
    return most


def crowd(setup):
    """10,000 vehicles of one peer: another shows all within 2 s and keeps up; several newcomers in a row are
    answered at 20,000 datagrams a second at most."""
    traffic = setup.data / "trajectories/vehicles_town_sumo.csv"
    if not traffic.exists():
        raise Skip(f"needs {traffic}; set RECKON_DATA")
    count = os.environ.get("RECKON_CROWD", "10000")
    with setup.testbed(2) as bed:
        owner = bed.run(1, [setup.crowd, "own", "e0", count, "24", str(traffic)])
        time.sleep(6)
        first = bed.run(2, [setup.crowd, "hear", "e0", count, "8"])
        alone = busiest(bed, 1, 2)
        time.sleep(2)
        usual = busiest(bed, 1, 1)
        check(first.wait() == 0, first.error_text())
        others = []
        for _ in range(4):
            others.append(bed.run(2, [setup.crowd, "hear", "e0", count, "4"]))
            time.sleep(0.03)
        row = busiest(bed, 1, 2)
        for program in others:
            check(program.wait() == 0, program.error_text())
        check(owner.wait(40) == 0, owner.error_text())
        heard, owned = json.loads(first.lines[-1][1]), json.loads(owner.lines[-1][1])
        print(f"  owner {owned}\n  first listener {heard}")
        print(f"  datagrams/s: {usual:.0f} as usual, {alone:.0f} for one newcomer, {row:.0f} for four in a row")
        check(heard["size"] == int(count) and 0 < heard["all_s"] <= 2.0,
              f"{heard['size']} shown, all after {heard['all_s']} s")
        check(heard["datagrams_lost"] <= 0.001 * heard["datagrams_in"], f"{heard['datagrams_lost']} lost")
        check(owned["write_overflow"] == 0, f"{owned['write_overflow']} datagrams did not fit")
        for program in others:
            late = json.loads(program.lines[-1][1])
            print(f"  one of four: all after {late['all_s']} s, {late['datagrams_lost']} lost")
            check(late["size"] == int(count), f"one of four shows {late['size']}")
        check(max(alone, row) <= 20000, "a newcomer is flooded")


def open_dis_reads(setup, pdus):
    """Checks that the npm package open-dis decodes each of these PDUs completely; returns a message if it is not
    installed."""
    if shutil.which("node") is None:
        return print("  open-dis: skipped, needs node (Debian: nodejs)")
    listing = setup.folder / "pdus.hex"
    listing.write_text("".join(octets.hex() + "\n" for octets in pdus))
    done = subprocess.run(["node", str(pathlib.Path(__file__).with_name("open_dis.js")), str(listing)],
                          capture_output=True, text=True,
                          env={**os.environ, "NODE_PATH": f"{setup.node_path}:{os.environ.get('NODE_PATH', '')}"})
    if done.returncode == testbed.SKIP:
        return print(f"  open-dis: skipped, needs npm install --prefix {setup.node_path.split(':')[0][:-13]} open-dis")
    print(f"  open-dis: {done.stdout.strip()}")
    check(done.stdout.strip() == f"ok {len(pdus)}", done.stdout + done.stderr)


def tshark_reads(recording, host, marking, least):
    if shutil.which("tshark") is None:
        return print("  tshark: skipped, is not installed")
    words = ["tshark", "-r", str(recording), "-d", f"udp.port=={PORT},dis", "-Y",
             f"dis.pdu_type==1 && ip.src=={Testbed.address(host)}", "-T", "fields", "-e", "dis.entity_marking"]
    markings = subprocess.run(words, capture_output=True, text=True, check=True).stdout.split()
    print(f"  tshark reads {len(markings)} Entity States: {set(markings)}")
    check(len(markings) >= least and set(markings) == {marking}, f"{set(markings)}")


def truck(setup):
    """The truck of docs/library.md: seen by tshark, open-dis and a peer; sees a recorded session, hears a Fire. Another
    truck sees and hears the same by a replay of the recording."""
    capture = setup.data / "dis-captures/real-sessions/turn90-1.pcap"
    with setup.testbed(3) as bed:
        sniffer = bed.sniff()
        recording = setup.folder / "truck.pcap"
        recorder = bed.run(3, [setup.reckon, "record", str(recording), "--iface", "e0", "--pool", "0"])
        program = bed.run(1, [setup.truck, "e0", "9"])
        time.sleep(4)
        own = [o for _, _, _, kind, o in sniffer.pdus(Testbed.address(1)) if kind == dis.ENTITY_STATE]
        check(own, "the truck was never heard")
        states = [dis.EntityState(octets) for octets in own]
        problems = [p for s in states for p in s.problems()]
        check(not problems, f"{problems[:3]}")
        check({s.marking for s in states} == {"TRUCK1"}, f"{({s.marking for s in states})}")
        latitude, longitude, _ = dis.geodetic(states[-1].location)
        check(abs(latitude - 47.05) < 0.01 and abs(longitude - 8.31) < 0.01, f"{latitude} {longitude}")
        # 10 m/s on a circle of 50 m is off by 1 m after a second of straight prediction: about two a second.
        print(f"  {len(states)} Entity States of the truck in 4 s")
        check(2 <= len(states) <= 40, f"{len(states)} Entity States in 4 s")
        sender = bed.multicast_sender(2)
        fire = dis.fire((9, 9, 1), (1, 1, 1), states[-1].location)
        sender.sendto(fire, (BASE_GROUP, PORT))
        check(program.wait_line("hears 9:9:1 fire", 2), "the Fire was not heard; " + program.error_text())
        if capture.exists():
            replay = bed.run(2, [setup.reckon, "replay", str(capture), "--iface", "e0", "--rate", "20", "--to", TO_ALL])
            check(program.wait_line("sees UtilVeh 1", 4), f"the recorded session was not seen; {program.lines} {replay.error_text()}")
            replay.wait()  # status 1: two of its datagrams are longer than an Ethernet frame
        program.wait()
        recorder.interrupt()
        recorder.wait()
        sent = [octets for _, _, _, _, octets in sniffer.pdus(Testbed.address(1))]
        tshark_reads(recording, 1, "TRUCK1", len(states))
        open_dis_reads(setup, sent)
        check(dis.EntityState(sent[-1]).appearance & (1 << 23), "its last Entity State does not say that it goes")

        # No recorded session has a Fire, but this recording has one: for a truck on a host with another number.
        late = bed.run(3, [setup.truck, "e0", "6"])
        time.sleep(0.5)
        replay = bed.run(2, [setup.reckon, "replay", str(recording), "--iface", "e0", "--rate", "4", "--to", TO_ALL])
        wanted = ["sees TRUCK1", "hears 9:9:1 fire"] + (["sees UtilVeh 1"] if capture.exists() else [])
        for line in wanted:
            check(late.wait_line(line, 5), f"by the replay nobody '{line}'; {late.lines} {replay.error_text()}")
        print(f"  by a replay: {[text for _, text in late.lines]}")


def foreign_client(setup):
    """A program of the npm package open-dis hears plain DIS peers. Its own PDUs have length 0: a lenient peer shows it,
    any other says what it refuses and the remedy."""
    if shutil.which("node") is None:
        raise Skip("needs node (Debian: nodejs)")
    lines = "[network]\ninterop = true\n{}\n[hand]"
    lenient = setup.changed_scene("lenient", "[hand]", lines.format("lenient = true\n"))
    strict = setup.changed_scene("strict", "[hand]", lines.format(""))
    path = f"NODE_PATH={setup.node_path}:{os.environ.get('NODE_PATH', '')}"
    script = str(pathlib.Path(__file__).with_name("open_dis_live.js"))
    with setup.testbed(3) as bed:
        alice, bob = bed.peer(1, lenient, "ALICE", 1), bed.peer(2, strict, "BOB", 2)
        client = bed.run(3, ["env", path, "node", script, Testbed.address(3), BASE_GROUP, str(PORT), "5"])
        if client.wait() == testbed.SKIP:
            raise Skip(f"needs npm install --prefix {setup.node_path.split(':')[0][:-13]} open-dis")
        heard = {text for _, text in client.lines}
        print(f"  open-dis {sorted(heard)}; {bob.error_text()}")
        check(heard == {"hears ALICE", "hears BOB"}, f"open-dis: {heard} {client.error_text()}")
        check(alice.wait_event("appeared", 1, "FOREIGN"), "a lenient peer did not show it")
        check(not bob.wait_event("appeared", 0, "FOREIGN"), "a strict peer read a PDU of length 0")
        told = [text for _, text in bob.errors if "refused: length field 0" in text]
        check(len(told) == 1 and Testbed.address(3) in told[0] and "lenient" in told[0], f"told {told}")
        refused = bob.report()["refused_no_length_in"]
        check(refused > 20, f"{refused} datagrams refused")
        served(alice.report())


CASES = {case.__name__: case for case in (foreign_client, truck, two_handed, without_device, post, crowd)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
