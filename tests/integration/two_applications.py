# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Plain DIS programs of one host, over lo: no two of them use the same entity ID. A plain socket is the reference for
the traffic on the wire. two_applications.py TRUCK RECKON SCENES"""
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

import dis_wire as dis

GROUP, PORT = "239.192.1.0", 3000
EXERCISE = 77  # of the scene; the truck uses 1


def check(condition, sentence):
    if not condition:
        sys.exit(f"failed: {sentence}")


class Judge:
    """Receives the group on lo."""

    def __init__(self, exercise):
        self._exercise = exercise
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self._socket.bind((GROUP, PORT))
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                                socket.inet_aton(GROUP) + socket.inet_aton("127.0.0.1"))
        self._socket.settimeout(0.05)

    def senders(self, seconds=10, applications=None):
        """{ID: set of source ports} of the Entity States received in this time, or until all of these applications
        were received."""
        end, senders = time.monotonic() + seconds, {}
        while time.monotonic() < end and not (applications and applications <= {i[1] for i in senders}):
            try:
                payload, (_, port) = self._socket.recvfrom(65536)
            except socket.timeout:
                continue
            for kind, octets in dis.pdus(payload):
                if kind == dis.ENTITY_STATE and octets[1] == self._exercise:
                    senders.setdefault(tuple(octets[i] << 8 | octets[i + 1] for i in (12, 14, 16)), set()).add(port)
        return senders


def start(*words):
    return subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def own_id(text):
    return tuple(map(int, re.search(r"^is (\d+):(\d+):(\d+)$", text, re.M).groups()))


def trucks(truck):
    """The program of docs/library.md, twice in the same instant: two entities, and each sees the other."""
    judge = Judge(1)
    both = [start(truck, "lo", 4) for _ in range(2)]
    senders = judge.senders(3)
    said = [program.communicate(timeout=20)[0] for program in both]
    ids = [own_id(text) for text in said]
    check(sorted(i[1] for i in ids) == [1, 2], f"they say that they are {ids}")
    check(set(senders) == set(ids), f"on the wire are {senders}, and they say {ids}")
    check(all(len(ports) == 1 for ports in senders.values()), f"an ID has two senders: {senders}")
    for text in said:
        check(text.count("sees TRUCK1") == 1, f"a truck does not see the other:\n{text}")
    print(f"two trucks: {ids}, each sees the other")


def peers(reckon, scene):
    """Programs of an interop scene: the next free number is taken and told, a given one is kept or refused."""
    judge = Judge(EXERCISE)
    run = [reckon, "peer", scene, "--iface", "lo", "--for"]
    first, second = start(*run, "2min"), start(*run, "2min")
    senders = judge.senders(applications={1, 2})
    check(sorted(i[1] for i in senders) == [1, 2], f"two peers at once are {senders}")

    third = start(*run, "1s")
    text = third.communicate(timeout=20)[1]
    told = re.search(r"this is application 3 of site \d+, because 1 is used on this host by process (\d+) \(reckon-peer\)", text)
    check(told and int(told[1]) in (first.pid, second.pid), f"the third does not say what it is:\n{text}")

    refused = start(*run, "1s", "--application", "2")
    _, text = refused.communicate(timeout=20)
    check(refused.returncode == 3, f"a number that is taken: exit status {refused.returncode}")
    check("application 2 of site" in text and "is used on this host by process" in text, f"it says:\n{text}")
    named = start(*run, "3s", "--application", "9")
    check(9 in {i[1] for i in judge.senders(applications={9})}, "a number that was given is not kept")
    check("this is application" not in named.communicate(timeout=20)[1], "a number that was given is told as news")

    (holder,) = [program for program in (first, second) if program.pid == int(told[1])]  # of number 1
    holder.send_signal(signal.SIGKILL)
    holder.wait()
    judge.senders(0.3)  # its remaining datagrams
    again = start(*run, "3s")
    check(1 in {i[1] for i in judge.senders(applications={1})}, "the number of a peer that was killed is not free again")
    check("this is application" not in again.communicate(timeout=20)[1], "the first number is told as news")
    for program in {first, second} - {holder}:
        program.send_signal(signal.SIGINT)
        check(program.wait(timeout=20) == 0, "a peer does not end")
    print("peers: the next free one, told; 9 kept; 2 refused; 1 free again after a kill")


def main():
    truck, reckon, scenes = sys.argv[1:]
    trucks(truck)
    with tempfile.TemporaryDirectory() as folder:
        text = (pathlib.Path(scenes) / "truck.toml").read_text()
        text = text.replace('"truck_track.csv"', f'"{pathlib.Path(scenes).resolve()}/truck_track.csv"')
        scene = pathlib.Path(folder) / "plain.toml"
        scene.write_text(f"{text}\n[network]\ninterop = true\nexercise = {EXERCISE}\n")
        peers(reckon, scene)


if __name__ == "__main__":
    main()
