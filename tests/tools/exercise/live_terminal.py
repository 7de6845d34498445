#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""`reckon demo` and `reckon peer` on terminals: output fits every size, follows a resize while running, the terminal
is restored for every way to end, and plain lines appear if the terminal cannot be drawn on.

    live_terminal.py RECKON SCENES        exit status 77 = skipped, with a message
"""
import os
import pathlib
import re
import signal
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import pseudo_terminal  # noqa: E402
from pseudo_terminal import ENTER_SCREEN, LEAVE_SCREEN, Terminal  # noqa: E402

MOVES = re.compile(rb"\x1b\[(\d+)(?:;(\d+))?[Hd]")


def demo(program, *words):
    return [program, "demo", "--peers", "8", *words]


def check_within(octets, rows, columns):
    """Checks that no cursor position is outside the screen, and that newlines do not move it outside."""
    between = octets.split(ENTER_SCREEN)[-1].split(LEAVE_SCREEN)[0]
    for move in MOVES.finditer(between):
        assert int(move[1]) <= rows and int(move[2] or 1) <= columns, (move[0], rows, columns)


def sizes(program):
    """Each size from the start, with eight peers; the summary is below the restored screen."""
    for rows, columns in ((24, 80), (10, 40), (60, 200), (2, 5)):
        terminal = Terminal(demo(program), rows=rows, columns=columns)
        terminal.expect("meet")
        for _ in range(20):
            terminal.pump()
        check_within(terminal.everything, rows, columns)
        if rows > 20:
            assert b"each sees 7 others" in terminal.everything, terminal.everything
        if (rows, columns) == (60, 200):
            assert b"LEDGER" in terminal.everything
        terminal.press("q")
        terminal.expect_end()
        assert terminal.process.returncode == 0
        before, after = terminal.everything.split(ENTER_SCREEN)[0], terminal.everything.split(LEAVE_SCREEN)[-1]
        assert before.count(b"\n") <= 2, before
        assert b"What " in after and b"peers cost" in after, after
        assert after.count(b"each sees 7 others") == 1 and b" joined" not in after, after


def resized(program):
    """Smaller and larger sizes while running."""
    terminal = Terminal(demo(program))
    terminal.expect("PEER")
    for rows, columns in ((10, 40), (60, 200), (24, 80)):
        terminal.resize(rows, columns)
        terminal.process.send_signal(signal.SIGWINCH)
        terminal.expect("PEER")
    terminal.press("q")
    terminal.expect_end()


def endings(program):
    """Ctrl-C, SIGTERM, SIGHUP, and immediate ends: the terminal is restored each time."""
    for how, status in ((lambda t: t.press("\x03"), 0), (lambda t: t.process.send_signal(signal.SIGTERM), 0),
                        (lambda t: t.process.send_signal(signal.SIGHUP), 0),
                        (lambda t: t.process.send_signal(signal.SIGQUIT), -signal.SIGQUIT),
                        (lambda t: t.process.send_signal(signal.SIGSEGV), -signal.SIGSEGV)):
        terminal = Terminal(demo(program))
        terminal.expect("PEER")
        how(terminal)
        terminal.expect_end()
        assert terminal.process.returncode == status, terminal.process.returncode
    # Two Ctrl-C: an orderly or an immediate end, depending on the time of the second one.
    terminal = Terminal(demo(program))
    terminal.expect("PEER")
    terminal.process.send_signal(signal.SIGINT)
    terminal.process.send_signal(signal.SIGINT)
    terminal.expect_end()
    assert terminal.process.returncode in (0, -signal.SIGINT), terminal.process.returncode


def plain(program):
    """No screen if TERM is dumb or unset, or stdin is closed: only a few lines and the summary."""
    for environment, stdin in (({"TERM": "dumb"}, True), ({"TERM": None}, True), ({"TERM": "no-such"}, True),
                               ({}, False)):
        terminal = Terminal(demo(program, "--for", "3s"), environment, stdin=stdin)
        said = terminal.expect_end(drawn=False)
        assert b"\x1b" not in said, said
        assert b"8 peers: each sees 7 others" in said and b"peers cost" in said, said
        assert said.count(b"\n") < 60, said  # a busy host adds notices; a screen would be hundreds of lines
        assert terminal.process.returncode == 0


def one_peer(program, scene):
    """`reckon peer` draws in the same way; its earlier messages appear below."""
    other = subprocess.Popen([program, "peer", scene, "--iface", "lo", "--operator", "2", "--name", "BOB"],
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    terminal = Terminal([program, "peer", scene, "--iface", "lo", "--name", "ALICE"])
    terminal.expect("BOB")
    terminal.expect("joined")
    terminal.resize(10, 40)
    terminal.process.send_signal(signal.SIGWINCH)
    terminal.expect("REMOTE")
    terminal.press("q")
    said = terminal.expect_end()
    other.terminate()
    other.wait()
    after = said.split(LEAVE_SCREEN)[-1]
    assert b"'BOB' joined" in after and b" cost" in after, after


def stopped(program):
    """The key s and SIGUSR1 stop all forces and enable them again; the summary counts it."""
    terminal = Terminal(demo(program), rows=40, columns=120)
    terminal.expect("stop all forces")
    terminal.press("s")
    terminal.expect("STOPPED")
    terminal.process.send_signal(signal.SIGUSR1)
    for _ in range(10):
        terminal.pump()
    terminal.press("q")
    after = terminal.expect_end().split(LEAVE_SCREEN)[-1]
    for said in (b"all forces are stopped by the key s", b"forces are restored: SIGUSR1", b"forces stopped             1 time,"):
        assert said in after, after
    assert terminal.process.returncode == 0


def main():
    if "RECKON_IN_NAMESPACE" not in os.environ:
        pseudo_terminal.into_namespace()
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    program = sys.argv[1]
    sizes(program)
    resized(program)
    endings(program)
    plain(program)
    stopped(program)
    one_peer(program, str(pathlib.Path(sys.argv[2]) / "two_hands.toml"))
    print("good")


if __name__ == "__main__":
    main()
