# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of the process: stopped, without threads, ended by a signal, without a reader, with a full disk, with a
changed clock."""
import pathlib
import signal
import subprocess
import time

from kit import Program, case, check, need, pair


@case("F3", "SIGSTOP for 3 s, SIGCONT", "nothing old is taken as new; live under 1.5 s")
def stopped(setup):
    with setup.testbed(2) as bed:
        sniffer = bed.sniff()
        alice, bob = pair(bed, setup)
        alice.signal(signal.SIGSTOP)
        time.sleep(3)
        since = time.monotonic()
        alice.signal(signal.SIGCONT)
        time.sleep(2)
        first = next((when for when, source, _, _ in list(sniffer.datagrams)
                      if when >= since and source == bed.address(1)), None)
        check(first is not None and first - since < 1.5, "silent after it was woken")
        report = alice.report()
        check(report["stale_datagrams"] > 0, "what waited in the kernel was taken as new")
        bob.report()
        return f"sends after {first - since:.2f} s; {report['stale_datagrams']} datagrams dropped as stale"


@case("T1", "no thread can be started (ulimit -u)", "exit status 3 with the remedy under 5 s")
def no_thread(setup):
    need("setpriv", "util-linux")
    need("prlimit", "util-linux")
    with setup.testbed(1) as bed:
        told = []
        for room in range(1, 6):
            program = bed.run(1, ["setpriv", "--reuid", "61234", "--regid", "61234", "--clear-groups",
                                  "prlimit", f"--nproc={room}:{room}", setup.reckon, "peer",
                                  str(setup.scene), "--iface", "e0", "--for", "2s"])
            status = program.wait(10)
            check(status in (0, 3), f"room for {room} threads: status {status}, {program.error_text()}")
            if status == 3:
                check("ulimit -u" in program.error_text(), program.error_text())
            told.append(status)
        check(3 in told, "every thread could be started")
        return f"exit status with room for 1 to 5 threads: {told}"


def leaves(setup, number, name):
    """Ends a peer by a signal; returns the time until the other one reported it, and the exit status."""
    with setup.testbed(2) as bed:
        under_nohup = signal.signal(signal.SIGHUP, signal.SIG_DFL)  # peers would inherit an ignored signal
        try:
            alice, bob = pair(bed, setup)
        finally:
            signal.signal(signal.SIGHUP, under_nohup)
        since = bob.seconds()
        alice.signal(number)
        gone = bob.wait_event("gone", 4, "ALICE", since)
        check(gone, f"{name} leaves a ghost")
        status = alice.wait(10)
        check(status == 0, f"{name}: exit status {status}: {alice.error_text()}")
        return gone[0] - since


@case("T2", "SIGTERM, SIGHUP", "a good-bye under 1 s, exit status 0")
def signals(setup):
    took = {name: leaves(setup, getattr(signal, name), name) for name in ("SIGTERM", "SIGHUP")}
    check(max(took.values()) < 1, f"{took}")
    return ", ".join(f"{name}: gone after {seconds:.2f} s" for name, seconds in took.items())


@case("T3", "whoever reads stdout goes (SIGPIPE)", "a good-bye under 1 s of the next line, exit status 0")
def reader_goes(setup):
    with setup.testbed(3) as bed:
        bob = bed.peer(2, setup.scene, "BOB", 2)
        alice = bed.run(1, [setup.reckon, "peer", str(setup.scene), "--iface", "e0", "--name", "ALICE",
                            "--events"], Unread)
        check(bob.wait_event("appeared", 8, "ALICE"), "never shown")
        alice.process.stdout.close()
        since = bob.seconds()
        bob.report()  # the departure of BOB is ALICE's next line
        status = alice.wait_status(5)
        check(status == 0, f"exit status {status}: {alice.error_text()}")
        return f"exit status {status}, {bob.seconds() - since:.1f} s after the next line"


class Unread(Program):
    """Its stdout is a pipe without a reader."""

    def _read(self, stream, lines):
        if stream is self.process.stderr:
            super()._read(stream, lines)

    def wait_status(self, timeout):
        return self.process.wait(timeout)


@case("F8", "clock set by 10 s and back, drift", "no jump shown (tests of the build)")
def clock_set(setup):
    return setup.passes("integration_tests", "Hosts.*")


@case("F9", "disk full while recording", "recording ends with a line, the file is whole, peers go on")
def disk_full(setup):
    with setup.testbed(3) as bed:
        alice, bob = pair(bed, setup)
        path = pathlib.Path(setup.folder) / "full.pcapng"
        disk = pathlib.Path(setup.folder) / "disk"  # mounted only for this program
        disk.mkdir()
        recorder = bed.run(3, ["sh", "-c", f"mount -t tmpfs -o size=32k none {disk} && {setup.reckon} "
                               f"record {disk}/full.pcapng --iface e0 --for 30s; status=$?; "
                               f"cp {disk}/full.pcapng {path}; exit $status"])
        status = recorder.wait(30)
        check(status == 3 and recorder.error_text(), f"status {status}: {recorder.error_text()}")
        info = subprocess.run([setup.reckon, "info", str(path), "--json"], capture_output=True, text=True)
        check(info.returncode in (0, 1) and info.stdout, f"the file cannot be read: {info.stderr}")
        time.sleep(1)
        reports = [alice.report(), bob.report()]
        check(all(r["datagrams_lost"] == 0 for r in reports), "peers lost datagrams")
        return f"recorder ended with status {status} and a line, {path.stat().st_size} octets readable"


@case("F19", "time stamps and numbers wrap", "order kept (tests of the build)")
def wraps(setup):
    return ", ".join([
        setup.passes("integration_tests", "HardCases.TheOrderOfUpdatesHoldsAcrossTheHour"),
        setup.passes("peer_tests", "SenderClock.Carries*:PeerClock.CarriesOnWhere*")])


@case("F20", "duplicates, disorder, damaged octets", "counted exactly, none taken twice (tests of the build)")
def duplicates(setup):
    return ", ".join([
        setup.passes("aoim_tests", "SequenceTracker.*"),
        setup.passes("integration_tests", "HardCases.*Repeat*:HardCases.Copies*"),
        setup.passes("pdu_tests", "*EveryPdu*")])
