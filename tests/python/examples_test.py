# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the scripts of python/examples as a user does, and checks their types."""
import importlib.util
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import reckon
import samples

EXAMPLES = samples.SOURCES / "python/examples"


def run(script, *arguments):
    return subprocess.run([sys.executable, str(EXAMPLES / script), *map(str, arguments)], capture_output=True, text=True,
                          check=True).stdout


class Examples(unittest.TestCase):
    def test_each_is_short(self):
        for script in EXAMPLES.glob("*.py"):
            code = [line for line in script.read_text().splitlines() if line and not line.startswith(("#", '"""'))]
            self.assertLessEqual(len(code), 21, script.name)

    def test_decode_one(self):
        words = run("decode_one.py").splitlines()
        self.assertIn("firing_entity_id=EntityId(site=1, application=2, entity=3)", words[0])
        self.assertEqual(reckon.decode(bytes.fromhex(words[1])).header.exercise_id, 7)

    def test_capture_errors(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "turn.pcap"
            state = reckon.EntityState()
            state.dead_reckoning_parameters.dead_reckoning_algorithm = 2
            datagrams = []
            for step in range(5):  # a fall of 1 m/s^2 is off by 0.5 m after a second of FPW
                state.entity_location = reckon.WorldCoordinates(x=6.4e6 - step**2 / 2, y=0.0, z=0.0)
                state.entity_linear_velocity = reckon.Vector3Float(x=-float(step), y=0.0, z=0.0)
                datagrams.append((100.0 + step, reckon.encode(state)))
            samples.write_capture(path, datagrams)
            rows = run("capture_errors.py", path).splitlines()
        self.assertEqual(len(rows), 5)
        for row in rows[1:]:
            self.assertTrue(math.isclose(float(row.split(",")[2]), 0.5, abs_tol=1e-3), row)

    def test_many_runs(self):
        words = run("many_runs.py", samples.SOURCES / "scenes/two_hands.toml", 3, 1)
        self.assertRegex(words, r"peak force +median .* N, worst of 3 .* N")

    def test_the_notebook_runs_from_top_to_bottom(self):
        if importlib.util.find_spec("matplotlib") is None:
            self.skipTest("no matplotlib: apt install python3-matplotlib")
        notebook = json.loads((EXAMPLES / "scene_and_track.ipynb").read_text())
        cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(cells), 4)
        for cell in notebook["cells"]:
            self.assertFalse(cell.get("outputs"), "a notebook is kept without its output")
        subprocess.run([sys.executable, "-c", "\n".join(cells)], check=True, cwd=samples.SOURCES,
                       env={**os.environ, "MPLBACKEND": "agg"})

    def test_each_passes_mypy_strictly(self):
        mypy = shutil.which("mypy", path="/usr/bin")
        if mypy is None:
            self.skipTest("no mypy: apt install mypy")
        found = subprocess.run([mypy, "--strict", "--follow-imports=silent", "--cache-dir", "/dev/null", *map(str, sorted(EXAMPLES.glob("*.py")))],
                               capture_output=True, text=True, env={"MYPYPATH": str(pathlib.Path(reckon.__file__).parents[1])})
        self.assertEqual(found.returncode, 0, found.stdout + found.stderr)


if __name__ == "__main__":
    unittest.main()
