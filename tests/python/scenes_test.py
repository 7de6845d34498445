# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes in simulated time."""
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy
import reckon
import samples

SCENE = samples.SOURCES / "scenes/two_hands.toml"
BAD_NETWORK = "delay=50ms jitter=20ms loss=10%"


def trace_of(run):
    """The trace that `reckon demo --trace` writes for the run."""
    lines = ["t_s,peer,px_m,py_m,pz_m,sx_m,sy_m,sz_m,vx_mps,vy_mps,vz_mps,fx_N,fy_N,fz_N,mesh_fx_N,mesh_fy_N,mesh_fz_N,"
             "hand_fx_N,hand_fy_N,hand_fz_N,record_fx_N,record_fy_N,record_fz_N,ledger_J,need_J,energy_J,contacts,patch,device,pace"]
    vectors = numpy.hstack([run.handle, run.surface_point, run.velocity, run.force, run.mesh_force, run.hand_force,
                            run.record_force, run.ledger[:, None], run.need[:, None], run.energy[:, None]])
    for row, numbers in enumerate(vectors):
        lines.append(f"{run.time[row]:.6f},{run.peer[row]}," + ",".join(f"{number:.9g}" for number in numbers) +
                     f",{run.contacts[row]},{run.patch[row]},{run.device[row]},1")
    return lines


class Scenes(unittest.TestCase):
    def test_the_same_seed_twice_gives_the_same_octets(self):
        first, second = (reckon.run_scene(SCENE, 2.0, seed=5, impair=BAD_NETWORK) for _ in range(2))
        self.assertGreater(len(first), 3000)
        for name in ("time", "handle", "force", "energy", "record_force", "contacts"):
            self.assertTrue(getattr(first, name).tobytes() == getattr(second, name).tobytes(), name)
        other = reckon.run_scene(SCENE, 2.0, seed=6, impair=BAD_NETWORK)
        self.assertEqual(first.numbers, second.numbers)
        self.assertNotEqual(first.numbers["pose_error"], other.numbers["pose_error"])

    def test_a_run_equals_the_trace_of_the_demo(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "trace.csv"
            subprocess.run([samples.PROGRAM, "demo", str(SCENE), "--simulated-time", "--for", "2s", "--seed", "5", "--impair",
                            BAD_NETWORK, "--trace", str(path)], check=True, stdout=subprocess.DEVNULL)
            written = path.read_text().splitlines()
        ours = trace_of(reckon.run_scene(SCENE, 2.0, seed=5, impair=BAD_NETWORK))
        self.assertEqual(len(ours), len(written))
        for number, (one, other) in enumerate(zip(ours, written)):
            self.assertEqual(one, other, f"line {number + 1}")

    def test_rows_can_be_selected_and_the_numbers_are_told(self):
        run = reckon.run_scene(SCENE, 1.0)
        one = run[run.peer == 1]
        self.assertEqual(set(one.peer), {1})
        self.assertAlmostEqual(run.time[-1] - run.time[0], 1.0, delta=0.01)
        self.assertGreater(run.numbers["datagrams"], 0)
        self.assertGreaterEqual(run.numbers["least_energy"], 0.0)

    def test_what_is_wrong_is_told_with_the_remedy(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bad.toml"
            path.write_text("[scene]\nnaem = 'x'\n")
            with self.assertRaisesRegex(reckon.SceneError, r"bad\.toml:2:1: .*name"):
                reckon.run_scene(path, 1.0)
        with self.assertRaisesRegex(reckon.SceneError, "nowhere.toml"):
            reckon.run_scene("nowhere.toml", 1.0)
        with self.assertRaisesRegex(reckon.SceneError, "--seed needs a random impairment"):
            reckon.run_scene(SCENE, 1.0, seed=1)
        for duration in (0.0, -1.0, float("nan"), 1e9):
            with self.assertRaisesRegex(ValueError, "duration"):
                reckon.run_scene(SCENE, duration)
        with self.assertRaisesRegex(ValueError, "65 peers"):
            reckon.run_scene(SCENE, 1.0, peers=65)

    def test_ctrl_c_ends_a_run(self):
        script = f"import reckon\nprint('runs', flush=True)\nreckon.run_scene({str(SCENE)!r}, 1e5)"
        with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
            run.stdout.readline()
            time.sleep(0.5)  # the run would take minutes, so this is within it on any machine
            run.send_signal(signal.SIGINT)
            self.assertIn("KeyboardInterrupt", run.communicate(timeout=60)[1])

    def test_an_effect_of_the_user_is_known_by_its_key(self):
        import honey
        with tempfile.TemporaryDirectory() as folder:
            forces = []
            for strength in (0, 20):
                scene = pathlib.Path(folder) / f"table{strength}.toml"
                scene.write_text('[[object]]\nname = "table"\nplane = [0, 0, 1]\nsurface = {stiffness = 400}\n'
                                 f'honey = {{strength = {strength}}}\n[[operator]]\n'
                                 'sweep = {from = "-30 0 -10 mm", to = "30 0 -10 mm", period = "1 s"}\n')
                run = reckon.run_scene(scene, 3.0, peers=1, effects=honey.effects())
                forces.append(numpy.abs(run.force[run.time - run.time[0] > 1.0, 0]).max())
            self.assertGreater(forces[1], forces[0] + 0.3)
            with self.assertRaisesRegex(reckon.SceneError, "unknown key 'honey'.*exists only in its own program"):
                reckon.run_scene(scene, 1.0)
            with self.assertRaisesRegex(TypeError, "the capsule reckon.CustomEffects"):
                reckon.run_scene(scene, 1.0, effects="honey")


if __name__ == "__main__":
    unittest.main()
