# SPDX-License-Identifier: Apache-2.0
"""words_test.py PROGRAM SOURCES: explain, methods, policies, assemble and pages of runs are those of the program."""
import html
import inspect
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import stiction
import stiction.plots

PROGRAM, SOURCES = (Path(word).resolve() for word in sys.argv[1:3])
LOOP = SOURCES / "corpus/cycle-every-policy-mu-1.json"
STACK = SOURCES / "corpus/scenes/stack.json"


def told(*words, folder="."):
    return subprocess.run([PROGRAM, *map(str, words)], cwd=folder, check=True, capture_output=True, text=True).stdout


class Words(unittest.TestCase):
    def test_explain(self):
        problem = stiction.load(LOOP)
        with tempfile.TemporaryDirectory() as folder:
            file = f"{problem.name}.json"
            problem.save(Path(folder) / file)
            said = stiction.explain(problem)
            self.assertEqual(str(said), told("explain", file, folder=folder))
            program = json.loads(told("explain", file, "--json", folder=folder))
        for facts in (program, said.json):
            for run in facts["survey"]["runs"]:
                run.pop("seconds", None)
        self.assertEqual(said.json, program)
        self.assertLessEqual(len(repr(said)), 100)
        with self.assertRaisesRegex(ValueError, "columns: found 20"):
            stiction.explain(problem, columns=20)

    def test_methods_and_policies(self):
        self.assertEqual(stiction.methods(), json.loads(told("methods", "--json")))
        self.assertEqual(stiction.policies(), json.loads(told("policies", "--json")))
        for row in stiction.methods():
            if row["path"] and "double" in row["plane"]:
                stiction.replay(stiction.load(LOOP), method=row["name"], arithmetic="double", max_drives=50)

    def test_assemble(self):
        for scene, words, options in [(STACK, [], {}), (STACK, ["--factors"], {"factors": True}),
                                      (STACK, ["--full", "--level", "impulses"], {"full": True, "level": "impulses"})]:
            with tempfile.TemporaryDirectory() as folder:
                told("assemble", scene, "-o", "p.json", *words, folder=folder)
                files = sorted(Path(folder).iterdir())
                for given in (scene, json.loads(scene.read_text())):
                    problems = stiction.assemble(given, **options)
                    self.assertEqual(problems, [stiction.load(file) for file in files])
                self.assertEqual(problems[0].J is not None, "factors" in options)
                self.assertEqual([p.name for p in problems], [stiction.load(file).name for file in files])
        with self.assertRaisesRegex(ValueError, "level: found force, expected forces or impulses"):
            stiction.assemble(STACK, "force")
        with self.assertRaisesRegex(TypeError, "full: found 1, expected True or False"):
            stiction.assemble(STACK, full=1)

    def test_the_page_of_a_run_is_that_of_the_program(self):
        for problem, options, words in [(stiction.load(LOOP), {}, []),
                                        (stiction.load(LOOP), {"policy": "scan=highest", "max_drives": 5},
                                         ["--policy", "scan=highest", "--max-drives", 5]),
                                        (stiction.assemble(STACK, full=True)[0], {"method": "complete"},
                                         ["--method", "complete"])]:
            run = stiction.replay(problem, **options)
            with tempfile.TemporaryDirectory() as folder:
                file = f"{problem.name}.json"
                problem.save(Path(folder) / file)
                subprocess.run([PROGRAM, "replay", file, *map(str, words), "--html", "page.html"], cwd=folder,
                               capture_output=True)
                self.assertEqual(run.page(), (Path(folder) / "page.html").read_text())
            shown = run._repr_html_()
            within = re.fullmatch('<iframe srcdoc="([^"]*)" [^<>]*></iframe>', shown)[1]
            self.assertEqual(html.unescape(within), run.page())


class Documented(unittest.TestCase):
    def test_all_that_is_public_says_what_it_is(self):
        for owner in (stiction, stiction.plots):
            for name in owner.__all__:
                one = getattr(owner, name)
                self.assertTrue(inspect.getdoc(one), name)
                if isinstance(one, type):
                    for part, value in vars(one).items():
                        if not part.startswith("_") and (callable(value) or isinstance(value, property)):
                            self.assertTrue(inspect.getdoc(value), f"{name}.{part}")

    def test_shapes_and_units_are_told(self):
        for one, words in [(stiction.Problem, "1/kg m/s^2 rows"), (stiction.Problem.from_bodies, "kg rows velocities"),
                           (stiction.solve_many, "n rows 1/kg m/s^2"), (stiction.Answers, "N m/s^2 rows"),
                           (stiction.Answer.f, "N row"), (stiction.Simulation.positions, "states bodies m"),
                           (stiction.plots.path, "N"), (stiction.plots.cone, "N")]:
            for word in words.split():
                self.assertRegex(inspect.getdoc(getattr(one, "func", one)), rf"(?<!\w){re.escape(word)}s?(?!\w)")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
