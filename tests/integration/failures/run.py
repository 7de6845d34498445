# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A host that fails: one case for each fault, in network namespaces; each prints its bar and what was
measured, and a table comes at the end.
  run.py [CASE ...] --reckon PROGRAM --scenes FOLDER [--tests BUILD_FOLDER]; without CASE, all."""
import argparse
import pathlib
import signal
import sys
import tempfile
import traceback

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import kit  # noqa: E402
from kit import testbed  # noqa: E402
import interface  # noqa: E402,F401
import process  # noqa: E402,F401
import sockets  # noqa: E402,F401


def order(name):
    return name[0], int("".join(c for c in name if c.isdigit())), name


def measure(name, arguments):
    """(verdict, measured result or reason of the failure)"""
    fault, bar, function = kit.CASES[name]
    print(f"{name}: {fault}\n  bar: {bar}", flush=True)
    try:
        with tempfile.TemporaryDirectory(prefix="reckon_") as folder:
            verdict, text = "passed", function(kit.Setup(arguments, folder))
    except testbed.Skip as reason:
        verdict, text = "skipped", str(reason)
    except testbed.Failure as sentence:
        verdict, text = "FAILED", str(sentence)
    except Exception as error:  # in the case itself: the other cases run anyway
        traceback.print_exc()
        verdict, text = "FAILED", f"the case broke off: {error!r}"
    print(f"  {verdict}: {text}", flush=True)
    return verdict, text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=" ".join(sorted(kit.CASES, key=order)))
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--scenes", required=True)
    parser.add_argument("--tests", default="", help="folder of the test programs of a build")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.cases if name not in kit.CASES]
    if unknown:
        parser.error(f"no case {', '.join(unknown)}; there are {', '.join(sorted(kit.CASES, key=order))}")
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))
    try:
        testbed.need_root_and_ip()
    except testbed.Skip as reason:
        print(f"skipped: {reason}")
        return testbed.SKIP
    names = arguments.cases or sorted(kit.CASES, key=order)
    results = {name: measure(name, arguments) for name in names}
    if len(names) > 1:
        print("\n| case | fault | bar | measured |\n|---|---|---|---|")
        for name, (verdict, text) in results.items():
            fault, bar, _ = kit.CASES[name]
            first = text.splitlines()[0] if text else ""
            print(f"| {name} | {fault} | {bar} | {'' if verdict == 'passed' else verdict + ': '}{first} |")
    verdicts = [verdict for verdict, _ in results.values()]
    if "FAILED" in verdicts:
        return 1
    return testbed.SKIP if set(verdicts) == {"skipped"} else 0


if __name__ == "__main__":
    sys.exit(main())
