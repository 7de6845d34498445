# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Federates on lo."""
import os
import random
import subprocess
import sys
import threading
import time
import unittest

import reckon
import samples

LONGEST = 30.0  # [s], on a busy machine
EXERCISE = reckon.Exercise(random.randrange(100, 250), 47.05, 8.31)


def join(name, **more):
    return reckon.Federate(EXERCISE, iface="lo", name=name, **more)


def tick_until(done, *federates):
    end = time.monotonic() + LONGEST
    while not done():
        if time.monotonic() > end:
            raise TimeoutError("what was waited for did not happen")
        for federate in federates:
            federate.tick()
        time.sleep(0.005)


class Federates(unittest.TestCase):
    def test_an_entity_is_discovered_moves_and_is_removed(self):
        with join("A") as one, join("B") as other:
            seen, updated, gone = [], [], []
            other.on_discover(seen.append)
            other.on_update(updated.append)
            other.on_remove(lambda entity, cause: gone.append((entity.id, entity.marking, cause)))
            truck = one.own("TRUCK1", type="1.1.225.7", force_id=1, position=(10.0, 20.0, 0.0))
            tick_until(lambda: seen, one, other)
            self.assertEqual((seen[0].id, seen[0].marking, seen[0].force_id), (truck.id, "TRUCK1", 1))
            self.assertTrue(seen[0].type.startswith("1.1.225.7"))
            for axis, true in enumerate((10.0, 20.0, 0.0)):
                self.assertAlmostEqual(seen[0].position[axis], true, delta=0.01)
            truck.move((30.0, 20.0, 0.0), velocity=(0.0, 5.0, 0.0))
            tick_until(lambda: updated and abs(updated[-1].velocity[1] - 5.0) < 0.01, one, other)
            self.assertEqual([entity.id for entity in other.entities()], [truck.id])
            self.assertIsNone(other.find((9, 9, 9)))
            truck_id = truck.id
            truck.remove()
            tick_until(lambda: gone, one, other)
            self.assertEqual(gone, [(truck_id, "TRUCK1", "deactivated")])

    def test_callbacks_run_on_the_thread_that_ticks_and_their_faults_rise_there(self):
        with join("A") as one, join("B") as other:
            threads = []

            def fail(_):
                threads.append(threading.get_ident())
                raise KeyError("of a callback")

            other.on_discover(fail)
            one.own("T", type="1.1")
            with self.assertRaisesRegex(KeyError, "of a callback"):
                tick_until(lambda: False, one, other)
            self.assertEqual(threads, [threading.get_ident()])
            other.tick()  # and it still works

    def test_another_thread_is_refused(self):
        with join("A") as one:
            faults = []

            def tick():
                try:
                    one.tick()
                except RuntimeError as error:
                    faults.append(str(error))

            thread = threading.Thread(target=tick)
            thread.start()
            thread.join()
            self.assertEqual(len(faults), 1)
            self.assertIn("thread that created it", faults[0])

    def test_what_cannot_be_is_told_with_the_remedy(self):
        with self.assertRaisesRegex((RuntimeError, ValueError), "nolan"):
            reckon.Federate(EXERCISE, iface="nolan")
        with self.assertRaisesRegex((RuntimeError, ValueError), "nowhere.toml"):
            reckon.Federate("nowhere.toml", iface="lo")
        with join("A") as one:
            with self.assertRaisesRegex(ValueError, 'type "1.x"'):
                one.own("T", type="1.x")
            with self.assertRaises(ValueError):
                one.own("a marking too long")
            truck = one.own("T")
            with self.assertRaisesRegex(ValueError, "unit quaternion"):
                truck.move((0.0, 0.0, 0.0), orientation=(0.0, 0.0, 0.0, 0.0))
        with self.assertRaisesRegex(RuntimeError, "left the exercise"):
            one.tick()

    def test_trucks_in_two_processes_hear_each_others_fire(self):
        command = [sys.executable, str(samples.SOURCES / "python/examples/truck.py"), "lo", "6"]
        trucks = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=os.environ) for _ in range(2)]
        heard = [truck.communicate(timeout=120)[0] for truck in trucks]
        for truck, words in zip(trucks, heard):
            self.assertEqual(truck.returncode, 0)
            self.assertIn("received EntityId(", words)


if __name__ == "__main__":
    unittest.main()
