# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Scripts of Python as users run them, on hosts of a LAN: python/examples, each in a network namespace.
namespaces_python.py FOLDER_OF_PACKAGE|OFF"""
import pathlib
import re
import subprocess
import sys

import testbed
from testbed import Skip, Testbed, check

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = "/usr/bin/python3"
SECONDS = 14


def trucks(package, folder):
    """Two trucks on one host and one on another hear each other fire; a fourth program plots how far off they are
    shown."""
    scripts = ROOT / "python/examples"
    plot = pathlib.Path(folder) / "shown.png"
    with Testbed(2, "") as bed:
        def script(host, name, *arguments):
            return bed.run(host, ["env", f"PYTHONPATH={package}", "PYTHONDONTWRITEBYTECODE=1", "MPLBACKEND=agg", PYTHON,
                                  str(scripts / name), Testbed.address(host), *arguments])

        drivers = [script(1, "truck.py", str(SECONDS)), script(1, "truck.py", str(SECONDS)), script(2, "truck.py", str(SECONDS))]
        has_plots = subprocess.run([PYTHON, "-c", "import matplotlib"], capture_output=True).returncode == 0
        watcher = script(2, "shown_error.py", str(SECONDS - 4), *([str(plot)] if has_plots else []))
        check(watcher.wait(40) == 0, f"the plot failed: {watcher.error_text()}")
        for driver in drivers:
            check(driver.wait(40) == 0, f"a truck failed: {driver.error_text()}")
        shown = [re.fullmatch(r"(\d+) (\d+) (\d+) shown (\d+) times, at most ([\d.]+) m off", text) for _, text in watcher.lines]
        check(len(shown) == 3 and all(shown), f"not three trucks are shown: {watcher.lines}")
        ids = {match.groups()[:3] for match in shown}
        check(len(ids) == 3, f"they are not three entities: {ids}")
        for match in shown:
            print(f"  {match.group(0)}")
            # 10 m/s on a circle of 50 m, sent at a threshold of 1 m, smoothed at the receiver.
            check(int(match.group(4)) > 100 and float(match.group(5)) < 2.0, match.group(0))
        heard = [{tuple(re.findall(r"=(\d+)", text)) for _, text in driver.lines} for driver in drivers]
        for others in heard:
            check(others < ids and len(others) == 2, f"of {ids} a truck hears {others} fire")
        if has_plots:
            check(plot.read_bytes()[:4] == b"\x89PNG", "there is no plot")
            print(f"  the plot has {plot.stat().st_size} octets")


def run(folder):
    package = sys.argv[1]
    if package == "OFF":
        raise Skip("the Python module is not built (RECKON_PYTHON is off); ./run python builds it")
    if subprocess.run([PYTHON, "-c", "import numpy"], capture_output=True).returncode != 0:
        raise Skip("no numpy; ./run python installs python3-numpy")
    print(trucks.__doc__)
    trucks(package, folder)


if __name__ == "__main__":
    sys.exit(testbed.status_of(run))
