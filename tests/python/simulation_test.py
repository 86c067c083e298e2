# SPDX-License-Identifier: Apache-2.0
"""simulation_test.py PROGRAM SOURCES: simulations of the Python package are those of the program, to the bit."""
import base64
import csv
import html
import json
import re
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np
import stiction

PROGRAM, SOURCES = sys.argv[1], Path(sys.argv[2])
SCENES = SOURCES / "corpus" / "scenes"


class Simulations(unittest.TestCase):
    def assert_table(self, mine, file):
        with open(file, newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(list(mine), list(rows[0]) if rows else list(mine))
        for name, column in mine.items():
            values = [row[name] for row in rows]
            flat = column.reshape(-1)
            self.assertEqual(len(flat), len(rows))
            if column.dtype.kind == "f":
                self.assertEqual(np.array(values, dtype=np.float64).tobytes(), flat.tobytes(), name)
            else:
                self.assertEqual(values, [str(value) for value in flat], name)

    def test_arrays_are_the_tables_of_the_program(self):
        for name in ("incline-slides", "double-pendulum", "space/stack", "falling-boxes"):
            with self.subTest(scene=name), tempfile.TemporaryDirectory() as folder:
                out = Path(folder) / "run"
                said = json.loads(subprocess.run(
                    [PROGRAM, "simulate", SCENES / f"{name}.json", "-o", out, "--seconds", "0.3", "--no-svg", "--json"],
                    check=True, capture_output=True, text=True).stdout)
                run = stiction.simulate(SCENES / f"{name}.json", seconds=0.3)
                for table in ("bodies", "contacts", "energy", "drift", "motion"):
                    self.assert_table(getattr(run, table), out / f"{table}.csv")
                self.assertEqual(run.statistics, said["statistics"])
                self.assertEqual(run.reason, "")

    def test_shapes_are_states_by_bodies(self):
        run = stiction.simulate(SCENES / "incline-slides.json", seconds=1, step=0.02)
        self.assertEqual((run.times.shape, run.positions.shape, run.angles.shape, run.velocities.shape, run.spins.shape),
                         ((51,), (51, 2, 2), (51, 2), (51, 2, 2), (51, 2)))
        np.testing.assert_allclose(run.times, 0.02 * np.arange(51), atol=1e-12)
        np.testing.assert_allclose(np.diff(run.positions[:, 1], axis=0), 0.02 * run.velocities[1:, 1], atol=1e-12)
        self.assertEqual(run.motion["does"].tolist(), ["slides"])
        self.assertEqual(set(run.contacts["does"]), {"slides"})
        run = stiction.simulate(SCENES / "space/stack.json", seconds=0.1)
        self.assertEqual((run.positions.shape[2], run.quaternions.shape[2], run.spins.shape[2]), (3, 4, 3))
        np.testing.assert_allclose(np.linalg.norm(run.quaternions, axis=2), 1, atol=1e-12)
        with self.assertRaisesRegex(ValueError, "in space"):
            run.angles
        with self.assertRaises(ValueError):
            run.times[0] = 1

    def test_scenes_are_also_dictionaries_and_one_without_contacts_has_empty_columns(self):
        scene = {"format": "stiction-scene", "version": 1, "name": "free", "dimension": 2, "gravity": [0, -10],
                 "bodies": [{"name": "stone", "mass": 1, "shapes": [{"disc": 1}]}]}
        run = stiction.simulate(scene, seconds=1, step=0.01)
        self.assertEqual(run.motion["does"].tolist(), ["flies"])
        self.assertEqual(len(run.contacts["normal_N"]), 0)
        self.assertEqual((run.contacts["normal_N"].dtype, run.contacts["does"].dtype.kind), (np.float64, "U"))
        self.assertAlmostEqual(run.positions[-1, 0, 1], -5, delta=0.1)
        self.assertIn("101 states, 1 bodies", repr(run))

    def test_a_notebook_shows_the_page_that_plays_it(self):
        run = stiction.simulate(SCENES / "incline-slides.json", seconds=1)
        shown = html.unescape(run._repr_html_())
        self.assertTrue(shown.startswith("<iframe srcdoc="))
        data = json.loads(re.search(r'id="data">(.*?)</script>', shown, re.S)[1])
        self.assertEqual(data["motions"][0]["word"], "slides")
        frames = json.loads(zlib.decompress(base64.b64decode(data["frames"])))
        self.assertEqual(len(frames), 31)
        for frame in frames:  # energy of the state that it shows
            at = int(np.argmin(np.abs(run.times - frame["time"])))
            self.assertAlmostEqual(run.times[at], frame["time"], delta=1e-9)
            self.assertAlmostEqual(run.energy["kinetic_J"][at], frame["energy"][0], delta=1e-12)
        self.assertEqual(run.page(), run.page())

    def test_what_is_wrong_is_refused_in_a_line(self):
        with self.assertRaisesRegex(ValueError, "step: found 2"):
            stiction.simulate(SCENES / "stack.json", step=2)
        with self.assertRaisesRegex(ValueError, "scene: "):
            stiction.simulate({"format": "stiction-problem"})
        with self.assertRaisesRegex(TypeError, "seconds"):
            stiction.simulate(SCENES / "stack.json", seconds="1")
        with self.assertRaises(OSError):
            stiction.simulate(SCENES / "none.json")

    def test_a_run_with_a_problem_that_is_not_solved_goes_on_and_says_where(self):
        run = stiction.simulate(SCENES / "scripted-wedge-jams.json", seconds=0.5, step=0.05)
        self.assertEqual(len(run.times), 11)
        self.assertIn("undecided", run.reason)
        self.assertIn(run.reason, repr(run))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
