# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Studies of `reckon bench` as arrays."""
from __future__ import annotations

import os
import typing

import numpy

if typing.TYPE_CHECKING:
    import csv

    from numpy.typing import NDArray


class StudyError(RuntimeError):
    """A study did not run: the message comes from the program."""


def study(*arguments: str | os.PathLike[str], program: str | os.PathLike[str] = "") -> dict[str, NDArray[typing.Any]]:
    """Runs a study that takes `--csv FILE` and returns its table, one array for each column.

        table = reckon.study("bench", "accuracy", "--touch", "--axis", "integrator")
        table["step_ns"], table["error_rms_n"]

    Columns of numbers have dtype float64, with NaN for empty cells; others are text. program: path of `reckon`, by
    default from PATH. It takes as long as on the command line, and other threads of Python run meanwhile. StudyError
    where the program fails or is not there.
    """
    # Imported here, because an import of reckon should not wait for them.
    import csv
    import pathlib
    import shutil
    import subprocess
    import tempfile

    found = os.fspath(program) or shutil.which("reckon")
    if not found:
        raise StudyError("reckon is not in PATH: write program=\"build/release/reckon\", or install the package reckon")
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "table.csv"
        ran = subprocess.run([found, *map(os.fspath, arguments), "--csv", str(file)], stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True, errors="replace")
        if ran.returncode != 0 or not file.exists():
            words = ran.stderr.strip().splitlines()
            raise StudyError(words[-1] if words else f"{found} wrote no table (exit status {ran.returncode})")
        with open(file, newline="", encoding="utf-8") as text:
            return columns_of(csv.DictReader(text))


def columns_of(rows: csv.DictReader[str]) -> dict[str, NDArray[typing.Any]]:
    """Columns of a CSV file; a column is numeric if all of its cells are."""
    names = list(rows.fieldnames or [])
    cells: dict[str, list[str]] = {name: [] for name in names}
    for row in rows:
        for name in names:
            cells[name].append(row[name] or "")
    return {name: _column(values) for name, values in cells.items()}


def _column(values: list[str]) -> NDArray[typing.Any]:
    try:
        return numpy.array([float(value) if value else numpy.nan for value in values])
    except ValueError:
        return numpy.array(values)
