#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""`reckon devices measure` on a terminal: its questions, the messages of each end, and a board behind a tty.
RECKON_SOAK=1 measures the board on the clock of this host.

    measure_terminal.py RECKON DRIVER.so BOARD_BEHIND_TTY
"""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import pseudo_terminal  # noqa: E402
from pseudo_terminal import Terminal  # noqa: E402

# Accepted failures of a busy host; each message states the disturbance.
BUSY = ("this host was too busy", "its readings fail", "it is no longer ready")
LATE = "its clock is wrong by more than 5 %"  # a busy host reads the board late
# For a handle that a hand holds.
HELD = ("release the handle",)
ASKED = "Press Enter to begin"
OVERTAKEN = ("SIGUSR1: nothing moved",)  # on a busy host a signal comes before the program has read the key


def measure(program, device, out, *flags):
    return Terminal(["sh", "-c", 'exec "$0" devices measure "$@" > ' + str(out), program, device, *flags])


def end(terminal, out, says):
    """The program ended with a reason, without success and without an open descriptor."""
    terminal.expect_end(drawn=False)
    told = terminal.everything.decode()
    assert terminal.process.returncode == 3, (terminal.process.returncode, told)
    assert any(one in told for one in says), told
    assert out.read_text() == "", out.read_text()


def endings(program, driver, out):
    """Ends before and after the first motion."""
    for how, says in ((lambda t: t.press("x"), "a key other than Enter: nothing moved"),
                      (lambda t: t.press("\x03"), "ended by Ctrl-C: nothing moved"),
                      (lambda t: t.process.send_signal(signal.SIGUSR1), "SIGUSR1: nothing moved")):
        terminal = measure(program, driver, out)
        asked = terminal.expect(ASKED).decode()
        assert "Release the handle" in asked and "by up to 40 mm, with up to 3 N" in asked, asked
        how(terminal)
        end(terminal, out, [says])
    # A spring pulls the driver's handle to a place, as if a hand held it.
    terminal = measure(program, driver, out)
    terminal.expect(ASKED)
    terminal.press("\n")
    end(terminal, out, [*HELD, *BUSY])


def refusals(program, driver):
    """Without a terminal there are no questions, and a device that cannot be pushed is named."""
    for words, says in (([driver], "add --yes"), (["evdev"], "renders springs itself"),
                        (["/dev/input/event3"], "renders springs itself"), (["falkon"], "did you mean 'falcon'?"),
                        (["falcon", "--max-force", "2 N"], "--max-force applies to serial boards only"),
                        (["/dev/ttyACM0", "--max-force", "2 m"], "--max-force"),
                        (["mine", "--simulate", "falcon", "--yes"], "--yes needs a real device")):
        ended = subprocess.run([program, "devices", "measure", *words, *([] if says != "--max-force" else ["--yes"])],
                               stdin=subprocess.DEVNULL, capture_output=True, check=False, text=True)
        assert ended.returncode == 2 and says in ended.stderr and ended.stdout == "", (words, ended)
    agreed = subprocess.run([program, "devices", "measure", driver, "--yes"], stdin=subprocess.DEVNULL,
                            capture_output=True, check=False, text=True)
    assert agreed.returncode == 3 and agreed.stdout == "", agreed
    assert any(one in agreed.stderr for one in (*HELD, *BUSY)), agreed


def board(program, model, out):
    """A board with one axis: started with Enter and stopped by a key, Ctrl-C, a signal or its plug; and measured."""
    # The board has a processor of its own.
    urgent = ["chrt", "-f", "30"]
    if shutil.which("chrt") is None or subprocess.run([*urgent, "true"], capture_output=True, check=False).returncode != 0:
        urgent = []

    def plugged():
        process = subprocess.Popen([*urgent, model, "1.5", "1"], stdout=subprocess.PIPE, text=True)
        return process, process.stdout.readline().strip()

    def asked():
        for left in (2, 1, 0):
            process, line = plugged()
            terminal = measure(program, line, out, "--max-force", "5 N")
            try:
                terminal.expect(ASKED)
                return process, terminal
            except SystemExit:
                process.kill()
                if left == 0 or LATE not in terminal.everything.decode():
                    raise

    for how, says in ((lambda t, p: t.press(" "), "a key stopped it"), (lambda t, p: t.press("\x03"), "Ctrl-C stopped it"),
                      (lambda t, p: t.process.send_signal(signal.SIGUSR1), "SIGUSR1 stopped it"),
                      (lambda t, p: p.kill(), "was unplugged")):
        process, terminal = asked()
        terminal.press("\n")
        for _ in range(30):
            terminal.pump()
        how(terminal, process)
        end(terminal, out, [says, *(OVERTAKEN if "SIGUSR1" in says else ()), *BUSY])
        process.kill()
        process.wait()

    if "RECKON_SOAK" not in os.environ:
        return
    process, line = plugged()
    pseudo_terminal.PATIENCE = 120
    terminal = measure(program, line, out, "--max-force", "5 N")
    terminal.expect(ASKED)
    terminal.press("\n")
    terminal.expect_end(drawn=False)
    process.kill()
    process.wait()
    told = terminal.everything.decode()
    if terminal.process.returncode != 0:
        assert any(one in told for one in BUSY) and out.read_text() == "", told
        print("refused, as a busy host is:", told.splitlines()[-1])
        return
    text = out.read_text()
    print(text)
    damping = float(re.search(r"measured ([\d.]+) \+-", text)[1])
    assert abs(damping - 1.5) < 0.15, text
    assert "pushed along x only" in text and "its driver assumed 0.09 N s/m" in text, text
    described = subprocess.run([program, "devices", "describe", str(out)], capture_output=True, check=False, text=True)
    assert described.returncode == 0 and "limits" in described.stdout, described


def main():
    program, driver, model = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "mine.toml"
        refusals(program, driver)
        endings(program, driver, out)
        board(program, model, out)


main()
