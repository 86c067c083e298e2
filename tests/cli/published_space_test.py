# SPDX-License-Identifier: Apache-2.0
"""stiction solve and bench in space: the readings of section 5.6, and what is said of runs that find nothing."""

import copy
import json
import math
import subprocess
import sys
import unittest
from pathlib import Path

import cli

SOURCES = Path(__file__).resolve().parents[2]
RAY = SOURCES / "corpus/space/ray-under-slip-literal.json"
CYCLE = SOURCES / "corpus/space/cycle-under-both-slips.json"
IN_SPACE = {SOURCES / "corpus/scenes/block-in-a-valley.json": "cycle-of-a-scene-2-contacts",
            SOURCES / "corpus/records/friction-gravity-3-contacts.json": "cycle-of-a-scene-3-contacts",
            SOURCES / "corpus/records/friction-gravity-4-contacts.json": "cycle-of-a-scene-4-contacts"}

sys.path.insert(0, str(SOURCES / "tests/setup"))
import into_space  # noqa: E402

# x to 1, where ax = 0; y until 1 + fy^2 = (5/4)^2.
CIRCLE = {
    "format": "stiction-problem", "version": 1, "name": "circle", "dimension": 3,
    "contacts": [{"kind": "static", "mu": "5/4"}],
    "A": [["2", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]], "b": ["-2", "-1", "-1"],
}


# Under both slips it never leaves a box.
IN_A_BOX = {
    "format": "stiction-problem", "version": 1, "name": "in-a-box", "dimension": 3,
    "contacts": [{"kind": "static", "mu": "3"}, {"kind": "static", "mu": "3"}],
    "A": [["7", "-1", "-4", "1", "-3", "-2"], ["-1", "13", "5", "2", "1", "1"], ["-4", "5", "12", "-3", "3", "3"],
          ["1", "2", "-3", "2", "-1", "0"], ["-3", "1", "3", "-1", "8", "-1"], ["-2", "1", "3", "0", "-1", "8"]],
    "b": ["-1", "2", "-2", "1", "2", "-3"],
}


class ScenesOfThePlane(cli.TestCase):
    def test_the_corpus_has_them_as_the_script_makes_them(self):
        for scene, name in IN_SPACE.items():
            with self.subTest(scene=scene.name):
                made = self.folder / "made.json"
                done = subprocess.run([sys.executable, SOURCES / "tests/setup/into_space.py", cli.program, scene, "--name",
                                       name, "-o", made], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(made.read_text(), (SOURCES / f"corpus/space/{name}.json").read_text())

    def test_the_problem_is_that_of_its_scene_and_the_plane_is_in_it(self):
        for scene, name in IN_SPACE.items():
            with self.subTest(scene=scene.name):
                problem = json.loads((SOURCES / f"corpus/space/{name}.json").read_text())
                again = self.folder / "again.json"
                self.succeeds("assemble", self.file("scene.json", problem["scene"]), "--full", "-o", again)
                self.assertEqual(*(p["A"] for p in (problem, json.loads(again.read_text()))))
                plane = self.folder / "plane.json"
                content = json.loads(scene.read_text())
                self.succeeds("assemble", self.file("plane.json", content.get("problem", content)), "--full", "-o", plane)
                expected = into_space.mirrored(json.loads(plane.read_text()))
                planar = into_space.planar_part(problem)
                for key in ("A", "b", "contacts"):
                    self.assertEqual(planar[key], expected[key])

    def test_they_loop_and_intervals_never_say_otherwise(self):
        for name in IN_SPACE.values():
            file = SOURCES / f"corpus/space/{name}.json"
            start, period = into_space.loop_by_the_plane(cli.program, json.loads(file.read_text()))
            for policy in into_space.READINGS:
                with self.subTest(file=name, policy=policy):
                    found = into_space.ends(cli.program, file, policy, "interval")
                    self.assertIn(found["outcome"], ("cycle", "undecided"))
                    if found["outcome"] == "cycle":
                        self.assertEqual(found["period"], period)
                        self.assertGreaterEqual(found["start"], start)
        self.assertEqual(into_space.ends(cli.program, SOURCES / "corpus/space/cycle-of-a-scene-2-contacts.json", "slip=redirect",
                                         "interval")["outcome"], "cycle")

    def test_where_the_plane_does_not_tell_nothing_is_said(self):
        problem = json.loads((SOURCES / "corpus/space/cycle-of-a-scene-2-contacts.json").read_text())
        self.assertIsNotNone(into_space.loop_by_the_plane(cli.program, problem))
        for key, at, value in (("b", 2, "1"), ("A", (2, 0), "1"), ("A", (0, 5), "1"), ("b", 0, "8")):
            other = copy.deepcopy(problem)
            if key == "b":
                other["b"][at] = value
            else:
                other["A"][at[0]][at[1]] = value
            self.assertIsNone(into_space.loop_by_the_plane(cli.program, other), (key, at))

        def step(drive, source, to, length):
            return {"drive": drive, "limiting": "F1", "from": source, "to": to, "step": length}

        to_sticking = step(3, "NC-", "CF", "1")
        self.assertTrue(into_space.jumps({"pivots": [to_sticking, step(3, "CF", "NC+", "0")]}))
        for other in (step(3, "CF", "NC+", "1/2"), step(3, "CF", "NC-", "0"), step(4, "CF", "NC+", "0")):
            self.assertFalse(into_space.jumps({"pivots": [to_sticking, other]}), other)


class Solve(cli.TestCase):
    def solve(self, file, *more, code=0):
        return self.succeeds("solve", file, "--json", "--method", "baraff", *more, code=code).json()

    def test_intervals_are_the_default_and_enclose_the_solution(self):
        result = self.solve(self.file("p.json", CIRCLE))
        self.assertEqual((result["outcome"], result["arithmetic"], result["policy"]), ("solved", "interval", "paper"))
        for (low, high), expected in zip(result["f"], [1, 1, 0.75]):
            self.assertLessEqual(low, expected)
            self.assertGreaterEqual(high, expected)
            self.assertLess(high - low, 1e-9)
        self.assertEqual((result["statistics"]["drives"], result["statistics"]["redirects"]), (3, 0))
        self.assertEqual(self.succeeds("solve", self.file("p.json", CIRCLE), "--method", "baraff").out.splitlines()[0],
                         "solved: forces within these bounds meet every condition, (21) and (22), which leave the "
                         "direction of slip free, proved")

    def test_rounded_arithmetics(self):
        for arithmetic in ["float", "double"]:
            with self.subTest(arithmetic=arithmetic):
                result = self.solve(self.file("p.json", CIRCLE), "--arithmetic", arithmetic)
                self.assertEqual((result["outcome"], result["arithmetic"]), ("solved", arithmetic))
                self.assertTrue(all(math.isclose(x, y, rel_tol=1e-6) for x, y in zip(result["f"], [1, 1, 0.75])))
                self.assertLess(result["residual"], 1e-6)
                self.assertNotIn("suspected", result)

    def test_every_problem_of_the_corpus_ends_as_it_says(self):
        for file in [RAY, CYCLE]:
            for policy, outcome in json.loads(file.read_text())["expect"].items():
                with self.subTest(file=file.name, policy=policy):
                    code = 0 if outcome == "solved" else 1
                    result = self.solve(file, "--policy", policy, "--arithmetic", "double", code=code)
                    self.assertEqual((result["outcome"], result["policy"]), (outcome, policy))

    def test_an_unlimited_step_is_proved_and_a_cycle_where_a_state_remembers_nothing(self):
        self.assertEqual(self.solve(RAY, code=1)["outcome"], "ray")
        proved = self.solve(CYCLE, code=1)
        self.assertEqual((proved["outcome"], proved["start"], proved["period"]), ("cycle", 7, 6))
        self.assertIn("proved", proved["evidence"])
        marked = self.solve(CYCLE, "--policy", "slip=redirect", code=1)
        self.assertEqual((marked["outcome"], marked["start"], marked["period"]), ("cycle", 7, 6))
        self.assertEqual(marked["evidence"], proved["evidence"])
        boxed = self.solve(self.file("box.json", IN_A_BOX), code=1)
        self.assertEqual((boxed["outcome"], boxed["period"], boxed["reason"]), ("cycle", 6, "it never leaves a box"))
        self.assertIn("map a box of what it remembers into itself", boxed["evidence"])
        self.assertRegex(self.succeeds("solve", self.file("box.json", IN_A_BOX), "--method", "baraff", code=1).out.splitlines()[0],
                         "^cycle: from the state after [0-9]+ drives on it never leaves a box, the same steps every 6 drives")
        suspected = self.solve(CYCLE, "--arithmetic", "double", code=1)
        self.assertEqual((suspected["start"], suspected["period"]), (7, 6))
        self.assertIn("no proof", suspected["evidence"])
        self.assertEqual(suspected["suspected"]["period"], 6)

    def test_the_polygon_is_complete_driving_and_exact(self):
        for file in [RAY, CYCLE]:  # which the other readings do not solve
            read = self.solve(file, "--policy", "slip=polygon")
            self.assertEqual((read["outcome"], read["method"], read["policy"], read["arithmetic"]),
                             ("solved", "complete", "slip=polygon", "exact"))
            complete = self.succeeds("solve", file, "--method", "complete", "--law", "baraff", "--json").json()
            self.assertEqual(read["f"], complete["f"])

    def test_a_replay_says_what_intervals_prove(self):
        out = self.succeeds("replay", CYCLE).out.splitlines()
        self.assertEqual(out[-2], "over intervals, proved: cycle: the state after 7 drives recurs 6 drives later, for ever")
        out = self.succeeds("replay", CYCLE, "--policy", "slip=redirect").out.splitlines()
        self.assertTrue(out[-2].startswith("over intervals, proved: cycle: the state after 7 drives recurs"), out[-2])
        told = self.succeeds("replay", RAY, "--json").json()
        self.assertEqual((told["outcome"], told["over_intervals"]["outcome"]), ("ray", "ray"))
        self.assertNotIn("over_intervals", self.succeeds("replay", self.file("p.json", CIRCLE), "--json").json())

    def test_a_loop_of_space_is_minimized_as_far_as_intervals_prove_it(self):
        small = self.folder / "small.json"
        done = self.succeeds("minimize", CYCLE, "-o", small, "--json").json()
        self.assertEqual((done["keep"], done["after"]["contacts"]), ("cycle", 2))
        self.assertLess(done["after"]["bits"], done["before"]["bits"])
        self.assertEqual(self.solve(small, code=1)["outcome"], "cycle")
        self.assertEqual(json.loads(small.read_text())["expect"], {"paper": "cycle"})
        for option in [["--keep-signature"], ["--as-scene"], ["--keep", "cycle:*"], ["--policy", "file=yes"],
                       ["--policy", "slip=polygon"]]:
            with self.subTest(option=option):
                self.refuses("minimize", CYCLE, "-o", small, *option, says=["dimension: found 3", " ".join(option)])
        tie = SOURCES / "corpus/space/cycle-of-a-scene-3-contacts.json"
        self.refuses("minimize", tie, "-o", small, says=["undecided", "intervals prove"])

    def test_a_search_of_space(self):
        store = self.folder / "space.store"
        out = self.succeeds("search", "--generator", "space", "--contacts", "2", "--problems", "30000", "--threads", "2",
                            "--store", store).out
        self.assertRegex(out, r"(?m)^  loop for ever +cycle  ")
        flowing = " ".join(out.split())
        self.assertRegex(flowing, r"of (\S+) problems given to complete driving \1 solved")
        self.assertRegex(flowing, r"cycle-2c-\d+d 2 contacts, .*in space, over intervals")
        self.assertNotIn("disagreement-of-methods", out)
        self.succeeds("report", store, "-o", self.folder / "report")
        found = sorted((self.folder / "report/findings").glob("cycle-*d.json"))
        self.assertTrue(found)
        for file in found:
            self.assertEqual(self.solve(file, code=1)["outcome"], "cycle")
            self.succeeds("check", file.with_suffix(".existence.certificate.json"))
        self.refuses("search", "--generator", "space", "--policy", "*", "--store", self.folder / "no", says=["policies", "slip=redirect"])
        self.refuses("search", "--generator", "space", "--objective", "steps", "--store", self.folder / "no",
                     says=["objective", "space", "static contacts of the plane"])

    def test_what_is_not_built_is_refused(self):
        file = self.file("p.json", CIRCLE)
        self.refuses("solve", file, "--method", "baraff", "--arithmetic", "exact", says=["exact", "interval"])
        for policy in ["scan=highest,slip=polygon", "file=yes", "apex=suspended"]:
            self.refuses("solve", file, "--method", "baraff", "--policy", policy, says=[policy, "slip=redirect"])

    def test_bilateral_and_sliding_contacts(self):
        contacts = [{"kind": "bilateral"}, {"kind": "sliding", "mu": "1", "slip": ["3/5", "4/5"]}]
        problem = dict(CIRCLE, contacts=contacts, b=["-3", "-3", "1", "2"],
                       A=[["1", "0", "0", "0"], ["0", "4", "2", "0"], ["0", "2", "4", "1"], ["0", "0", "1", "3"]])
        file = self.file("p.json", problem)
        for arithmetic in ["interval", "double"]:  # aN2 = (4 - 6/5) fN2 - 3
            result = self.solve(file, "--arithmetic", arithmetic)
            f = [sum(x) / 2 for x in result["f"]] if arithmetic == "interval" else result["f"]
            self.assertTrue(all(math.isclose(x, y) for x, y in zip(f, [3, 15 / 14, -9 / 14, -12 / 14])), f)
        problem["contacts"][1]["mu"] = "4"
        ray = self.solve(self.file("p.json", problem), "--arithmetic", "double", code=1)
        self.assertEqual(ray["outcome"], "ray")
        direction = [x / ray["ray"][1] for x in ray["ray"]]  # of any length
        self.assertTrue(all(math.isclose(x, y, abs_tol=1e-15) for x, y in zip(direction, [0, 1, -12 / 5, -16 / 5])), ray)


if __name__ == "__main__":
    cli.main()
