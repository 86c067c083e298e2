# SPDX-License-Identifier: Apache-2.0
"""certify/residuals.py finds the error that solve states, from the same file, and more where forces are altered."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import cli

SOURCES = Path(__file__).resolve().parents[2]
SCRIPT = SOURCES / "certify/residuals.py"
SCENES = ("card-house", "space/box-on-slope-slides", "space/slider-crank")
CORPUS = ("sliding/hinged-slider", "sliding/rod-with-two-solutions", "space/cube-slides-on-four-corners",
          "space/three-sliding-contacts")
PUBLISHED = ("lcp/lcp_CPS_3.dat", "lcp/lcp_deudeu.dat", "friction/FrictionContactProblem00031.dat",
             "friction/FrictionContact3D_1c.dat", "friction/Confeti-ex03-Fc3D-SBM.dat",
             "friction/fc2d_granularflowonwall_00667_00000.dat")
NEAR = 3e-14  # what rounding is worth, of two ways to sum


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
        self.assertAlmostEqual(found, said, delta=NEAR + 0.01 * said)
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

    @unittest.skipUnless("STICTION_DATA" in os.environ, "needs STICTION_DATA")
    def test_of_problems_that_others_published(self):
        for name in PUBLISHED:
            with self.subTest(file=name):
                self.agrees(Path(os.environ["STICTION_DATA"]) / name)


if __name__ == "__main__":
    cli.main()
