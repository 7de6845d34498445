# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Studies as arrays."""
import csv
import io
import math
import os
import pathlib
import unittest

import numpy
import reckon
import samples
from reckon import _studies


class Studies(unittest.TestCase):
    def test_a_column_of_numbers_is_one_of_numbers_and_any_other_of_text(self):
        table = _studies.columns_of(csv.DictReader(io.StringIO("name,rms,missed\na,0.5,\nb,1e-3,7\n")))
        self.assertEqual(list(table), ["name", "rms", "missed"])
        self.assertEqual(list(table["name"]), ["a", "b"])
        self.assertEqual(list(table["rms"]), [0.5, 1e-3])
        self.assertTrue(math.isnan(table["missed"][0]))
        self.assertEqual(table["missed"][1], 7.0)
        self.assertEqual(table["rms"].dtype, numpy.float64)

    def test_a_study_is_the_table_that_the_program_writes(self):
        if not pathlib.Path(samples.PROGRAM).with_name("reckon-bench").exists():
            self.skipTest("reckon-bench is not built")
        table = reckon.study("bench", "accuracy", "--touch", "--axis", "order", program=samples.PROGRAM)
        numbers = [name for name, column in table.items() if column.dtype == numpy.float64]
        self.assertGreater(len(numbers), 2, table)
        self.assertGreater(len(next(iter(table.values()))), 2)

    def test_what_the_program_refuses_is_raised_in_its_words(self):
        with self.assertRaisesRegex(reckon.StudyError, "axis"):
            reckon.study("bench", "accuracy", "--touch", "--axis", "none", program=samples.PROGRAM)

    def test_a_program_that_is_not_there_is_named(self):
        before = os.environ["PATH"]
        os.environ["PATH"] = ""
        try:
            with self.assertRaisesRegex(reckon.StudyError, "reckon is not in PATH"):
                reckon.study("bench", "accuracy")
        finally:
            os.environ["PATH"] = before


if __name__ == "__main__":
    unittest.main()
