# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Coupling studies whose two sides run in network namespaces, in lock-step over UDP. One case per call, with the arguments of
namespaces.py."""
import subprocess
import sys

import testbed
from namespaces import run
from testbed import Testbed, check

MODES = ("velocity_exchange", "effort_flow", "transmission_line", "gain_cut", "passivity_controller", "printed_dead_reckoning",
         "reckon")
PORT = 4100


def side(bed, setup, host, word, mode, counterpart):
    own, other = (f"{Testbed.address(h)}:{PORT}" for h in (host, 3 - host))
    return bed.run(host, [setup.coupled, word, mode, counterpart, own, other])


def coupled(setup):
    """Each mode, with a server and with a second hand: both sides do, to the last bit, what one process does."""
    with setup.testbed(2) as bed:
        for counterpart in ("server", "hand"):
            for mode in MODES:
                whole = subprocess.run([setup.coupled, "whole", mode, counterpart], capture_output=True, text=True, check=True)
                sides = [side(bed, setup, 1, "first", mode, counterpart), side(bed, setup, 2, "second", mode, counterpart)]
                for program in sides:
                    check(program.wait(60) == 0, f"{mode}, {counterpart}: {program.error_text()}")
                said = [text for program in sides for _, text in program.lines]
                expected = whole.stdout.splitlines()
                print(f"  {mode}, {counterpart}: {len(said)} samples")
                check(len(expected) == (6000 if counterpart == "hand" else 3000), "the whole study did not run to its end")
                check(said == expected, f"{mode}, {counterpart}: the sides differ from the one process")


CASES = {case.__name__: case for case in (coupled,)}

if __name__ == "__main__":
    sys.exit(testbed.main(CASES, run))
