#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs one test of the Python package, or prints the reason for skipping it: run.py FOLDER_OF_PACKAGE|OFF RECKON
SCRIPT [ARGUMENTS]

Status 77: skipped. The script has the package in its path, and the program and the sources in RECKON_PROGRAM and
RECKON_SOURCES.
"""
import importlib.util
import os
import pathlib
import subprocess
import sys


def main(package, program, script, *arguments):
    if package == "OFF":
        print("skipped: the Python module is not built (RECKON_PYTHON is off); ./run python builds it")
        return 77
    if importlib.util.find_spec("numpy") is None:
        print("skipped: no numpy; ./run python installs python3-numpy")
        return 77
    root = pathlib.Path(__file__).resolve().parents[2]
    environment = {**os.environ, "PYTHONPATH": package, "RECKON_PROGRAM": program, "RECKON_SOURCES": str(root),
                   "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run([sys.executable, "-B", str(root / "tests/python" / script), *arguments], env=environment).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
