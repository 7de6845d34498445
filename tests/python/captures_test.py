# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Captures as columns and as single PDUs."""
import json
import pathlib
import subprocess
import tempfile
import unittest

import numpy
import reckon
import samples


def state_of(number, x):
    state = reckon.EntityState(entity_id=reckon.EntityId(site=1, application=2, entity=number))
    state.entity_location = reckon.WorldCoordinates(x=x, y=2.0, z=3.0)
    state.entity_linear_velocity = reckon.Vector3Float(x=10.0, y=0.0, z=0.0)
    state.dead_reckoning_parameters.dead_reckoning_algorithm = 2
    state.entity_marking.entity_marking_string = f"CAR{number}"
    return state


class Captures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "some.pcap"

    def test_columns_have_each_state_in_order(self):
        bundle = reckon.encode(state_of(1, 100.0)) + reckon.encode(state_of(2, 200.0)) + reckon.encode(reckon.Fire())
        samples.write_capture(self.path, [(1000.5, bundle), (1001.0, reckon.encode(state_of(1, 105.0)))])
        states = reckon.read_capture(self.path)
        self.assertEqual((len(states), states.pdus, states.damaged, states.problem), (3, 4, 0, ""))
        numpy.testing.assert_allclose(states.time, [1000.5, 1000.5, 1001.0])
        self.assertEqual(states.entities(), [(1, 2, 1), (1, 2, 2)])
        self.assertEqual(states.location.shape, (3, 3))
        numpy.testing.assert_array_equal(states.of((1, 2, 1)).location[:, 0], [100.0, 105.0])
        self.assertEqual(list(states.marking), [b"CAR1", b"CAR2", b"CAR1"])
        self.assertEqual(list(states[states.frame == 2].time), [1001.0])

    def test_columns_are_not_copies(self):
        samples.write_capture(self.path, [(1.0, reckon.encode(state_of(1, 1.0)))])
        states = reckon.read_capture(self.path)
        for column in (states.time, states.location, states.orientation, states.entity_type):
            self.assertFalse(column.flags.owndata)
            self.assertTrue(column.flags.c_contiguous)

    def test_columns_equal_what_the_inspector_reads(self):
        datagrams = [(100.0 + i, octets) for i, (name, octets) in enumerate(samples.golden()) if "entity_state" in name]
        samples.write_capture(self.path, datagrams)
        states = reckon.read_capture(self.path)
        lines = subprocess.run([samples.PROGRAM, "inspect", str(self.path), "--where", "type == entity_state", "--json"],
                               capture_output=True, text=True, check=True).stdout.splitlines()
        rows = [json.loads(line) for line in lines]
        self.assertGreater(len(rows), 0)
        self.assertEqual([row["id"] for row in rows], [":".join(map(str, entity)) for entity in states.entity_id])
        numpy.testing.assert_allclose(states.location, [row["location"] for row in rows], rtol=0, atol=1e-3)

    def test_damaged_pdus_are_counted_and_told_with_their_frame(self):
        good = reckon.encode(state_of(1, 1.0))
        samples.write_capture(self.path, [(1.0, good), (2.0, good + good[:100])])
        self.assertEqual((len(reckon.read_capture(self.path)), reckon.read_capture(self.path).damaged), (2, 1))
        with self.assertRaisesRegex(reckon.DecodeError, r"some\.pcap, frame 2, octet 144: .*E-TRUNCATED"):
            list(reckon.Capture(self.path).pdus())

    def test_a_capture_iterates_over_datagrams_and_pdus(self):
        fire = reckon.encode(reckon.Fire(range=5.0))
        samples.write_capture(self.path, [(1.25, fire + fire), (2.0, fire)])
        capture = reckon.Capture(self.path)
        datagrams = list(capture)
        self.assertEqual([datagram.frame for datagram in datagrams], [1, 2])
        self.assertEqual((datagrams[0].time, datagrams[0].destination), (1.25, "239.192.1.0:3000"))
        self.assertEqual([pdu.range for _, pdu in capture.pdus()], [5.0] * 3)

    def test_a_file_that_is_none_is_refused_with_its_path(self):
        self.path.write_bytes(b"no capture at all")
        for path in (self.path, self.path.with_name("missing.pcap"), self.path.parent):
            with self.assertRaisesRegex(reckon.CaptureError, path.name):
                reckon.read_capture(path)
            with self.assertRaisesRegex(reckon.CaptureError, path.name):
                reckon.Capture(path)

    def test_a_file_that_ends_early_says_so(self):
        samples.write_capture(self.path, [(1.0, reckon.encode(state_of(1, 1.0)))] * 3)
        self.path.write_bytes(self.path.read_bytes()[:-50])
        states = reckon.read_capture(self.path)
        self.assertEqual(len(states), 2)
        self.assertIn("frame", states.problem)


class Prediction(unittest.TestCase):
    def test_one_state_moves_by_its_velocity(self):
        shown = reckon.predict(state_of(1, 6.4e6), [0.0, 1.0, 2.5])
        numpy.testing.assert_allclose(shown.location[:, 0], [6.4e6, 6.4e6 + 10.0, 6.4e6 + 25.0], rtol=0, atol=1e-9)
        numpy.testing.assert_allclose(shown.linear_velocity, [[10.0, 0.0, 0.0]] * 3)

    def test_a_turning_model_follows_its_circle(self):
        state = state_of(1, 6.4e6)
        state.dead_reckoning_parameters.dead_reckoning_algorithm = 7  # RPB: velocity in body axes, which turn
        state.dead_reckoning_parameters.entity_angular_velocity = reckon.Vector3Float(x=0.0, y=0.0, z=0.5)
        times = numpy.linspace(0.0, 4.0, 9)
        shown = reckon.predict(state, times)
        # A circle of 20 m: 10 m/s at 0.5 rad/s. float32 fields hold these numbers exactly.
        numpy.testing.assert_allclose(shown.location[:, 0] - 6.4e6, 20 * numpy.sin(0.5 * times), atol=1e-8)
        numpy.testing.assert_allclose(shown.location[:, 1] - 2.0, 20 * (1 - numpy.cos(0.5 * times)), atol=1e-8)
        numpy.testing.assert_allclose(shown.orientation[:, 0], 0.5 * times, atol=1e-9)

    def test_rows_of_a_capture_are_predicted_from_their_arrival(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "two.pcap"
            samples.write_capture(path, [(10.0, reckon.encode(state_of(1, 6.4e6))), (11.0, reckon.encode(state_of(2, 6.4e6)))])
            states = reckon.read_capture(path)
        numpy.testing.assert_allclose(reckon.predict(states, 12.0).location[:, 0] - 6.4e6, [20.0, 10.0], atol=1e-6)
        numpy.testing.assert_allclose(reckon.predict(states, [10.0, 12.0]).location[:, 0] - 6.4e6, [0.0, 10.0], atol=1e-6)
        self.assertEqual(reckon.predict(states[:1], [10.0, 11.0, 12.0]).location.shape, (3, 3))
        with self.assertRaisesRegex(ValueError, "one time for each state"):
            reckon.predict(states, [1.0, 2.0, 3.0])

    def test_a_state_that_receivers_refuse_has_no_pose(self):
        self.assertTrue(numpy.isnan(reckon.predict(state_of(1, float("nan")), [1.0]).location).all())
        self.assertTrue(numpy.isnan(reckon.predict(state_of(1, 1e12), [1.0]).location).all())


if __name__ == "__main__":
    unittest.main()
