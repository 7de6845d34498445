# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The effects of importing the package, each in a separate interpreter."""
import subprocess
import sys
import unittest


def run(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)


class Import(unittest.TestCase):
    def test_loads_no_part_before_it_is_used(self):
        loaded = run("import reckon, sys; print([name for name in sys.modules if name.startswith(('reckon.', 'numpy'))])")
        self.assertEqual(loaded.stdout.strip(), "[]", loaded.stderr)

    def test_each_name_is_there_when_it_is_the_first(self):
        names = run("import reckon; print(*reckon.__all__)").stdout.split()
        self.assertIn("Fire", names)
        self.assertIn("decode", names)
        for name in ("Capture", "DecodeError", "EntityState", "Exercise", "Federate", "Pdu", "States", "decode", "encode",
                     "heading", "predict", "read_capture", "run_scene", "study"):
            self.assertIn(name, names)
            tried = run(f"import reckon; reckon.{name}; print(reckon.{name}.__module__)")
            self.assertEqual(tried.returncode, 0, tried.stderr)

    def test_a_name_that_is_not_there_is_an_attribute_error(self):
        self.assertIn("module 'reckon' has no attribute 'Fyre'", run("import reckon; reckon.Fyre").stderr)
        self.assertIn("cannot import name 'Fyre'", run("from reckon import Fyre").stderr)

    def test_a_star_brings_all_and_help_and_dir_know_them(self):
        self.assertEqual(run("from reckon import *; Fire, run_scene, decode").returncode, 0)
        self.assertIn("run_scene", run("import reckon; print(dir(reckon))").stdout)

    def test_objects_are_unpickled_where_no_class_was_made_yet(self):
        octets = run("import pickle, reckon; print(pickle.dumps(reckon.Fire()).hex())").stdout.strip()
        tried = run(f"import pickle; print(type(pickle.loads(bytes.fromhex('{octets}'))).__name__)")
        self.assertEqual(tried.stdout.strip(), "Fire", tried.stderr)


if __name__ == "__main__":
    unittest.main()
