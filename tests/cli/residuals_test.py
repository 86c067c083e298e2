# SPDX-License-Identifier: Apache-2.0
"""certify/residuals.py finds the error that solve states, from the same file, and more where forces are altered."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import cli

try:
    import h5py
except ImportError:
    h5py = None

SOURCES = Path(__file__).resolve().parents[2]
SCRIPT = SOURCES / "certify/residuals.py"
SCENES = ("card-house", "space/box-on-slope-slides", "space/slider-crank")
CORPUS = ("sliding/hinged-slider", "sliding/rod-with-two-solutions", "space/cube-slides-on-four-corners",
          "space/three-sliding-contacts")
PUBLISHED = ("lcp/lcp_CPS_3.dat", "lcp/lcp_deudeu.dat", "friction/FrictionContactProblem00031.dat",
             "friction/FrictionContact3D_1c.dat", "friction/Confeti-ex03-Fc3D-SBM.dat",
             "friction/fc2d_granularflowonwall_00667_00000.dat")
GLOBAL = ("fclib/CubeH8.hdf5", "fclib/LMGC_GlobalFrictionContactProblem00046.hdf5")
NEAR = 3e-14  # what rounding is worth, of two ways to sum
SUMMED = 1e-9  # the answer counts the rounding of rows that it sums in doubles: a sixteenth of what they may miss


class Residuals(cli.TestCase):
    def judged(self, problem, answer):
        """The error found, the residual said, and the exit code."""
        given = self.file("answer.json", json.dumps(answer))
        done = subprocess.run([sys.executable, SCRIPT, problem, given], capture_output=True, text=True, check=False)
        words = done.stdout.split()
        self.assertEqual(words[:1], ["error"], done.stderr)
        return float(words[1]), float(words[-1]), done.returncode

    def agrees(self, problem):
        answer = self.succeeds("solve", problem, "--arithmetic", "double", "--json").json()
        found, said, code = self.judged(problem, answer)
        self.assertEqual(code, 0)
        self.assertLessEqual(found, said + NEAR + 0.01 * said)
        self.assertLessEqual(said - found, SUMMED + 0.01 * said)
        return answer

    def test_of_the_corpus_in_every_form(self):
        for name in SCENES:
            for form in ((), ("--factors",)):
                with self.subTest(scene=name, form=form):
                    problem = self.folder / f"{name.replace('/', '-')}{''.join(form)}.json"
                    self.succeeds("assemble", SOURCES / f"corpus/scenes/{name}.json", "-o", problem, *form)
                    self.agrees(problem)
        for name in CORPUS:
            with self.subTest(problem=name):
                self.agrees(SOURCES / f"corpus/{name}.json")

    def test_forces_that_are_altered_are_found(self):
        problem = SOURCES / "corpus/space/cube-slides-on-four-corners.json"
        answer = self.agrees(problem)
        loaded = [i for i, x in enumerate(answer["f"]) if abs(x) > 1e-3]
        self.assertGreater(len(loaded), 5)
        for i in loaded:
            with self.subTest(force=i):
                f = list(answer["f"])
                f[i] *= 1 + 1e-6
                found, _, code = self.judged(problem, answer | {"f": f})
                self.assertEqual(code, 1)
                self.assertGreater(found, 1e-8)

    def test_bad_input_is_refused_in_a_line(self):
        problem = SOURCES / "corpus/space/cube-slides-on-four-corners.json"
        none = self.folder / "none"
        for case, arguments in {"no problem": [none, problem], "no answer": [problem, none],
                                "not JSON": [self.file("a.json", "{"), problem],
                                "not Siconos": [self.file("b.dat", "2 x"), problem],
                                "no forces": [problem, problem],
                                "too few": [problem, self.file("c.json", '{"f": [1]}')]}.items():
            with self.subTest(case=case):
                done = subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, r"\Aresiduals: .*expected.*\n\Z")

    def write_global(self, file, equations=1, kind="fclib_global"):
        """Two contacts on a body with a full M, which an equation may hold; each matrix in another storage of CSparse."""
        with h5py.File(file, "w") as out:
            group = out.create_group(kind)
            group["spacedim"] = [2]
            for name, value in {"f": [0.5, -9.0, 1.0], "w": [0.0, 0.25, 0.0, -0.5], "mu": [0.5, 0.25],
                                "b": [0.125] * equations}.items():
                group[f"vectors/{name}"] = value
            M = {"m": 3, "n": 3, "nz": 7, "i": [0, 1, 1, 2, 0, 1, 2], "p": [0, 0, 1, 2, 1, 2, 1],
                 "x": [2.0, 0.5, 3.0, 1.5, 0.5, -0.25, -0.25]}
            H = {"m": 3, "n": 4, "nz": -1, "p": [0, 2, 4, 6, 8], "i": [1, 2, 0, 2, 1, 2, 0, 2],
                 "x": [1.0, -1.0, 1.0, 0.5, 1.0, 1.0, 1.0, 0.5]}
            G = {"m": 3, "n": 1, "nz": -2, "p": [0, 1, 1, 2], "i": [0, 0], "x": [1.0, 0.75]}
            for name, matrix in {"M": M, "H": H, **({"G": G} if equations else {})}.items():
                for part, value in matrix.items():
                    group[f"{name}/{part}"] = value if isinstance(value, list) else [value]
        return file

    @unittest.skipUnless(h5py, "needs h5py")
    def test_global_problems_of_fclib(self):
        for equations in (0, 1):
            with self.subTest(equations=equations):
                file = self.write_global(self.folder / f"global-{equations}.hdf5", equations)
                answer = self.agrees(file)
                self.assertEqual(len(answer["f"]), 4 + equations)
                loaded = [i for i, x in enumerate(answer["f"]) if abs(x) > 1e-3]
                self.assertTrue(loaded)
                for i in loaded:  # the last is that of the equation
                    f = list(answer["f"])
                    f[i] *= 1 + 1e-6
                    self.assertEqual(self.judged(file, answer | {"f": f})[2], 1, f"force {i}")

    @unittest.skipUnless(h5py, "needs h5py")
    def test_other_kinds_of_fclib_are_refused(self):
        answer = self.file("answer.json", '{"f": [0, 0, 0, 0]}')
        rolling = self.write_global(self.folder / "rolling.hdf5", kind="fclib_global_rolling")
        done = subprocess.run([sys.executable, SCRIPT, rolling, answer], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("the local and the global ones are read", done.stderr)

    @unittest.skipUnless(h5py and "STICTION_DATA" in os.environ, "needs h5py and STICTION_DATA")
    def test_of_global_problems_that_others_published(self):
        for name in GLOBAL:
            with self.subTest(file=name):
                self.agrees(Path(os.environ["STICTION_DATA"]) / name)

    @unittest.skipUnless("STICTION_DATA" in os.environ, "needs STICTION_DATA")
    def test_of_problems_that_others_published(self):
        for name in PUBLISHED:
            with self.subTest(file=name):
                self.agrees(Path(os.environ["STICTION_DATA"]) / name)


if __name__ == "__main__":
    cli.main()
