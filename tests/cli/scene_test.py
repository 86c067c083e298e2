# SPDX-License-Identifier: Apache-2.0
"""Scenes: assemble, simulate, draw."""

import csv
import json
import math
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from fractions import Fraction

import cli

FOLDER = cli.ROOT / "corpus" / "scenes"


class Scenes(cli.TestCase):
    def assemble(self, name, *options):
        output = self.folder / f"{name.split('/')[-1]}.json"
        done = cli.run("assemble", FOLDER / f"{name}.json", "-o", output, *options)
        self.assertEqual(done.code, 0, done.err)
        return done.out, output

    def test_assembled_problems_are_solved_exactly(self):
        for name, code in (("rod-at-rest", 0), ("incline-slides", 0), ("ladder-stands", 0),
                           ("pendulum-at-the-bottom", 0), ("rod-without-solution", 1)):
            with self.subTest(scene=name):
                _, output = self.assemble(name)
                self.assertEqual(cli.run("solve", output, "--method", "complete").code, code)
        _, output = self.assemble("rod-at-rest")
        self.assertEqual(cli.run("solve", output, "--method", "complete", "--json").json()["f"], ["17/2", "-3"])

    def test_islands_are_files_of_their_own_and_everything_is_explained(self):
        out, output = self.assemble("two-towers", "--explain")
        rows = [len(json.loads(output.with_name(f"two-towers-{i}.json").read_text())["b"]) for i in (1, 2)]
        self.assertEqual(rows, [8, 2])
        for phrase in ("it parts", "on a flat face", "problem 1 of 2", "frictionless, one row"):
            self.assertIn(phrase, out)
        _, output = self.assemble("two-towers", "--full")
        self.assertEqual(len(json.loads(output.read_text())["b"]), 16)

    def test_one_problem_goes_to_standard_output_and_several_do_not(self):
        done = cli.run("assemble", FOLDER / "rod-at-rest.json", "-o", "-")
        self.assertEqual(json.loads(done.out)["A"][0], ["8/5", "6/5"])
        done = cli.run("assemble", FOLDER / "two-towers.json", "-o", "-")
        self.assertEqual((done.code, done.out), (2, ""))

    def test_a_simulation_writes_pictures_energies_and_drift(self):
        folder, problems = self.folder / "run", self.folder / "problems"
        done = cli.run("simulate", FOLDER / "double-action-jack.json", "-o", folder, "--seconds", "0.5",
                       "--problems", problems)
        self.assertEqual(done.code, 0, done.err)
        with open(folder / "energy.csv", newline="", encoding="utf-8") as file:
            energies = list(csv.DictReader(file))
        self.assertEqual(len(energies), 121)
        for row in energies:
            self.assertAlmostEqual(float(row["kinetic_J"]) + float(row["potential_J"]), float(row["total_J"]), 6)
        self.assertEqual(len((folder / "drift.csv").read_text().splitlines()), 122)
        frames = sorted((folder / "frames").iterdir())
        self.assertGreaterEqual(len(frames), 15)
        for frame in frames:
            ElementTree.parse(frame)
        page = (folder / "animation.html").read_text()
        self.assertNotIn("http://", re.sub(r"http://www\.w3\.org/(2000/svg|1998/Math/MathML)", "", page))
        self.assertNotIn("https://", page)
        written = sorted(problems.iterdir())
        self.assertGreater(len(written), 100)
        counted = next(line.split()[1] for line in done.out.splitlines() if line.startswith("problems "))
        self.assertEqual(len(written), int(counted), "each problem has a file of its own")
        self.assertEqual(cli.run("solve", written[50], "--method", "fast", "--arithmetic", "double").code, 0)

    def test_numbers_beyond_doubles_and_steps_out_of_range_are_refused(self):
        scene = json.loads((FOLDER / "stack.json").read_text())
        huge = "1" + 400 * "0"
        for key, value, place in (("gravity", ["0", huge], "gravity"), ("mu", huge, "gravity, mu, gap"),
                                  ("step", huge, "step"), ("step", "1/" + huge, "step"),
                                  ("seconds", huge, "seconds")):
            path = self.folder / "huge.json"
            path.write_text(json.dumps({**scene, key: value}))
            done = cli.run("simulate", path, "-o", self.folder / "huge")
            self.assertEqual(done.code, 2, done.err)
            self.assertIn(place, done.err)
        scene["bodies"][1]["shapes"] = [{"disc": huge}]
        path.write_text(json.dumps(scene))
        done = cli.run("draw", path, "-o", self.folder / "huge.svg")
        self.assertEqual((done.code, done.out), (2, ""), done.err)

    def test_a_page_holds_each_frame_with_forces_and_the_problem_that_they_solve(self):
        folder = self.folder / "stack"
        self.succeeds("simulate", FOLDER / "stack.json", "-o", folder, "--seconds", "0.5", "--no-svg")
        data = cli.animation(folder / "animation.html")
        self.assertEqual((len(data["frames"]), len(data["bodies"])), (16, 6))
        first, last = data["frames"][0], data["frames"][-1]
        self.assertEqual((last["remark"], last["problems"]), ("last", []))
        problem = json.loads(first["problems"][0])
        forces = first["forces"]
        self.assertEqual([float(Fraction(contact["mu"])) for contact in problem["contacts"]],
                         [force["mu"] for force in forces])
        rows = [row for force in forces for row in force["f"]]
        A = [[float(Fraction(x)) for x in row] for row in problem["A"]]
        for i, b in enumerate(problem["b"]):
            a = sum(x * f for x, f in zip(A[i], rows)) + float(Fraction(b))
            self.assertLess(abs(a), 1e-4, f"row {i} of a stack at rest")  # the page has seven digits of a force
        path = self.file("frame.json", problem)
        self.assertEqual(cli.run("solve", path, "--method", "fast", "--arithmetic", "double").code, 0)

    def test_a_frame_without_an_answer_ends_nothing_and_is_told_exit_3_and_its_problem_is_written(self):
        jaw = {"fixed": True, "shapes": [{"box": [1, 1]}]}
        scene = {"format": "stiction-scene", "version": 1, "name": "vice", "dimension": 2, "bodies": [
            {"name": "left", "position": [-1.25, 0], "velocity": [1, 0], **jaw},
            {"name": "right", "position": [1.25, 0], "velocity": [-1, 0], **jaw},
            {"name": "block", "mass": "1", "shapes": [{"box": [1, 1]}]}]}
        folder = self.folder / "vice"
        done = cli.run("simulate", self.file("vice.json", scene), "-o", folder, "--no-svg", "--json")
        self.assertEqual(done.code, 3)
        statistics = json.loads(done.out)["statistics"]
        self.assertEqual(statistics["frames"], 120)
        self.assertGreater(statistics["undecided"], 0)
        self.assertIn("frame ", done.err)
        self.assertTrue((folder / "animation.html").exists())
        self.assertFalse((folder / "frames").exists())
        problem = json.loads((folder / "undecided.json").read_text())
        self.assertEqual(problem["format"], "stiction-problem")
        for body, place in zip(scene["bodies"], (-1, 1)):
            body["position"] = [place, 0]
        closed = self.file("closed.json", scene)
        drawn = cli.run("draw", closed, "-o", self.folder / "closed.svg", "--json")
        self.assertEqual(json.loads(drawn.out)["undecided"], drawn.err.count("stiction: "))
        self.assertIn("stiction: frame 0", drawn.err)

    def test_a_second_run_leaves_nothing_of_the_first(self):
        out = self.folder / "out"
        self.assertEqual(cli.run("simulate", FOLDER / "scripted-wedge-jams.json", "-o", out).code, 3)
        self.succeeds("simulate", FOLDER / "stack.json", "-o", out, "--seconds", 1)
        self.assertFalse((out / "undecided.json").exists())
        many = len(list((out / "frames").iterdir()))
        self.succeeds("simulate", FOLDER / "stack.json", "-o", out, "--seconds", "0.2")
        self.assertLess(len(list((out / "frames").iterdir())), many)

    def test_names_do_not_leave_the_folder_and_nothing_can_be_drawn(self):
        empty = {"format": "stiction-scene", "version": 1, "name": "none", "dimension": 2, "bodies": []}
        for dimension in (2, 3):
            out = self.folder / "none.svg"
            self.succeeds("draw", self.file("none.json", {**empty, "dimension": dimension}), "-o", out)
            self.assertNotIn("nan", out.read_text())
        scene = json.loads((FOLDER / "stack.json").read_text())
        problems = self.folder / "deep" / "problems"
        self.succeeds("simulate", self.file("up.json", {**scene, "name": "../up"}), "-o", self.folder / "out",
                      "--seconds", "0.1", "--problems", problems)
        self.assertTrue(list(problems.glob("up-*.json")))

    def test_every_scene_is_drawn(self):
        for scene in sorted(FOLDER.glob("**/*.json")):
            with self.subTest(scene=scene.name):
                done = cli.run("draw", scene, "-o", "-")
                self.assertEqual(done.code, 0, done.err)
                picture = ElementTree.fromstring(done.out)
                for line in picture.iter("{http://www.w3.org/2000/svg}line"):
                    x1, y1, x2, y2 = (float(line.get(key)) for key in ("x1", "y1", "x2", "y2"))
                    self.assertLess(math.hypot(x2 - x1, y2 - y1), float(picture.get("height")) / 4 + 1)

    def arrows(self, folder, number):
        return (folder / "frames" / f"{number:05}.svg").read_text().count("<line")

    def test_a_picture_shows_the_forces_of_its_state(self):
        out = self.folder / "out"
        self.succeeds("simulate", FOLDER / "stack.json", "-o", out, "--seconds", "0.1")
        self.assertEqual([self.arrows(out, k) for k in range(4)], [10] * 4)  # from the first to the last

    def test_an_arrow_of_a_force_far_above_the_usual_is_cut_and_dashed(self):
        block = {"shapes": [{"box": [1, 1]}]}
        scene = {"format": "stiction-scene", "version": 1, "name": "weights", "dimension": 2, "gravity": [0, -10],
                 "step": "1/64", "bodies": [
                     {"name": "floor", "fixed": True, "shapes": [{"box": [20, 1]}]},
                     {"name": "light", "mass": 1, "position": [-3, 1], **block},
                     {"name": "heavy", "mass": 1000, "position": [3, 2], **block}]}
        out = self.folder / "out"
        self.succeeds("simulate", self.file("weights.json", scene), "-o", out, "--seconds", "0.6")
        frames = [path.read_text() for path in sorted((out / "frames").iterdir())]
        self.assertEqual((frames[0].count("<line"), frames[0].count("dasharray")), (2, 0))
        self.assertEqual((frames[-1].count("<line"), frames[-1].count("dasharray")), (4, 2))
        picture = ElementTree.fromstring(frames[-1])
        for line in picture.iter("{http://www.w3.org/2000/svg}line"):
            length = float(line.get("y1")) - float(line.get("y2"))
            share = 0.25 if line.get("stroke-dasharray") else 0.15
            self.assertAlmostEqual(length / float(picture.get("height")), share, 2)

    def test_forces_are_drawn_as_they_act_on_what_moves_and_joints_are_in_view(self):
        done = cli.run("draw", FOLDER / "beam-on-two-supports.json", "-o", "-")
        lines = list(ElementTree.fromstring(done.out).iter("{http://www.w3.org/2000/svg}line"))
        self.assertEqual(len(lines), 2)
        for line in lines:
            self.assertLess(float(line.get("y2")), float(line.get("y1")))
        done = cli.run("draw", FOLDER / "pendulum-at-the-bottom.json", "-o", "-")
        picture = ElementTree.fromstring(done.out)
        pin, = (circle for circle in picture.iter("{http://www.w3.org/2000/svg}circle") if circle.get("r") == "7")
        self.assertTrue(0 < float(pin.get("cy")) < float(picture.get("height")))

    def test_results_do_not_depend_on_the_number_of_threads(self):
        for threads in (1, 2, 3):
            self.succeeds("simulate", FOLDER / "many-stacks.json", "-o", self.folder / str(threads), "--seconds", "0.2",
                          "--threads", threads, "--no-svg")
            for name in ("energy.csv", "drift.csv", "animation.html"):
                self.assertEqual((self.folder / str(threads) / name).read_bytes(), (self.folder / "1" / name).read_bytes())

    def test_a_problem_of_the_search_carries_its_scene(self):
        store, file = self.folder / "s.store", self.folder / "p.json"
        self.succeeds("search", "--generator", "scenes", "--contacts", 3, "--mu", "1/2", "--problems", 40,
                      "--store", store)
        for unit, index in ((0, 0), (5, 17)):
            self.succeeds("problem", store, unit, index, "-o", file)
            self.succeeds("assemble", file, "--full", "-o", self.folder / "again.json")
            found, again = (json.loads(path.read_text()) for path in (file, self.folder / "again.json"))
            for key in ("contacts", "A", "b"):
                self.assertEqual(found[key], again[key])
            self.succeeds("draw", file, "-o", self.folder / "p.svg")
            drawn = (self.folder / "p.svg").read_text()
            self.assertGreaterEqual(drawn.count("<polygon") + drawn.count("<path"), len(found["scene"]["bodies"]))
        self.refuses("draw", self.file("bare.json", cli.REFERENCE), "-o", self.folder / "b.svg", says=["scene"])

    def test_a_minimized_problem_says_whose_scene_it_had(self):
        file, small = self.file("p.json", {**cli.REFERENCE, "scene": {"any": "value"}}), self.folder / "small.json"
        self.succeeds("minimize", file, "-o", small)
        small = json.loads(small.read_text())
        self.assertNotIn("scene", small)
        self.assertIn("parent", small["origin"]["scene"])

    def test_a_block_on_two_slopes_makes_the_published_algorithm_loop(self):
        _, output = self.assemble("block-in-a-valley")
        with open(cli.ROOT / "corpus" / "cycle-of-a-block-in-a-valley.json", encoding="utf-8") as file:
            stored = json.load(file)
        for key in ("contacts", "A", "b"):
            self.assertEqual(json.loads(output.read_text())[key], stored[key])

    def test_contacts_given_instead_of_found_make_the_same_problem(self):
        for name, contacts in (("block-in-a-valley", 2), ("weight-on-two-pegs", 2), ("stack", 10), ("space/tripod", 3)):
            with self.subTest(scene=name):
                given, again = self.folder / "given.json", self.folder / "again.json"
                _, problem = self.assemble(name, "--full", "--given", given)
                self.assertEqual(len(json.loads(given.read_text())["contacts"]), contacts)
                done = cli.run("assemble", given, "--full", "-o", again)
                self.assertEqual(done.code, 0, done.err)
                first, second = (json.loads(file.read_text()) for file in (problem, again))
                for key in ("contacts", "A", "b"):
                    self.assertEqual(first[key], second[key])

    def test_a_problem_of_the_whole_scene_carries_it(self):
        for name in ("block-in-a-valley", "space/tripod"):
            with self.subTest(scene=name):
                _, problem = self.assemble(name, "--full")
                again = self.folder / "again.json"
                self.assertEqual(cli.run("assemble", problem, "--full", "-o", again).code, 0)
                self.assertEqual(again.read_text(), problem.read_text())
        _, part = self.assemble("block-in-a-valley")
        self.assertNotIn("scene", json.loads(part.read_text()))

    def test_scenes_in_space(self):
        out, output = self.assemble("space/ball-slides-then-rolls", "--explain")
        self.assertIn("sliding, slip (0, -1)", out)
        self.assertEqual(cli.run("solve", output, "--method", "complete").code, 0)
        out, output = self.assemble("space/tripod")
        self.assertEqual(cli.run("solve", output, "--method", "complete", "--json").json()["f"], ["20", "20/3", "40/3"])
        out, output = self.assemble("space/leaning-gate", "--explain")
        self.assertIn("joint 1, row 5 (hinge of gate and post): bilateral, one row", out)
        solved = cli.run("solve", output, "--method", "complete", "--json").json()
        self.assertEqual((solved["outcome"], len(solved["f"])), ("solved", 5))
        drawn = cli.run("draw", FOLDER / "space" / "slider-crank.json", "-o", "-").out
        drawn = re.sub("<text.*?</text>", "", drawn, flags=re.DOTALL)
        for mark, count in (('stroke-width="3"', 1), ("stroke-dasharray", 1), ('rx="0"', 1), ('rx="4"', 3)):
            self.assertEqual(drawn.count(mark), count, mark)
        folder, problems = self.folder / "run", self.folder / "problems"
        done = cli.run("simulate", FOLDER / "space" / "ball-slides-then-rolls.json", "-o", folder, "--seconds", "0.5",
                       "--problems", problems)
        self.assertEqual(done.code, 0, done.err)
        for frame in (folder / "frames").iterdir():
            ElementTree.parse(frame)
        self.assertEqual(len(cli.animation(folder / "animation.html")["frames"]), 16)
        for problem in sorted(problems.iterdir())[::10]:
            self.assertEqual(cli.run("solve", problem, "--method", "fast", "--arithmetic", "double").code, 0)

    def test_bad_scenes_in_space_are_refused_with_their_place(self):
        good = (FOLDER / "space" / "tripod.json").read_text()
        for change, expected in (
                (lambda s: s["bodies"][1]["shapes"][1]["polyhedron"].append(["1", "0", "-1/2"]),
                 "bodies[1].shapes[1].polyhedron: found corner 5 in the hull of the others"),
                (lambda s: s["bodies"][1].update(inertia=["1", "0", "1"]), 'bodies[1].inertia[1]: found "0"'),
                (lambda s: s["bodies"][1].update(inertia=[[1, 2, 0], [2, 1, 0], [0, 0, 1]]), "positive definite"),
                (lambda s: s["bodies"][1].update(rotation=[0, 0, 0, 0]), "bodies[1].rotation"),
                (lambda s: s["bodies"][1].update(position=[0, 0]), "bodies[1].position"),
                (lambda s: s.update(joints=[{"kind": "pin", "bodies": ["floor", "tripod"]}]),
                 'joints[0].kind: found "pin", expected ball, hinge, rail or slider'),
                (lambda s: s.update(dimension=4), "dimension: found 4, expected 2 or 3")):
            scene = json.loads(good)
            change(scene)
            done = cli.run("assemble", self.file("bad.json", scene), "-o", self.folder / "out")
            self.assertEqual(done.code, 2)
            self.assertIn(expected, done.err)

    def test_bad_scenes_are_refused_with_their_place(self):
        scene = json.loads((FOLDER / "rod-at-rest.json").read_text())
        scene["bodies"][1]["mass"] = "-1"
        file = self.file("bad.json", scene)
        for verb in ("assemble", "simulate", "draw"):
            done = cli.run(verb, file, "-o", self.folder / "out")
            self.assertEqual((done.code, done.out), (2, ""))
            self.assertIn('bodies[1].mass: found "-1", expected a number > 0', done.err)

    def test_a_weight_on_two_pegs_loops_also_where_every_dimension_is_off(self):
        script = cli.ROOT / "tests/setup/tolerance.py"
        draw = lambda scene, *options: subprocess.run(
            [sys.executable, script, cli.program, FOLDER / f"{scene}.json", *map(str, options)],
            capture_output=True, text=True)
        done = draw("weight-on-two-pegs", "--percent", 1, 30, "--draws", 12)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines()[0], "1 %: of 12: 12 cycle")
        self.assertIn("solved", done.stdout.splitlines()[1])  # off by so much few loop
        self.assertIn("found no loop", draw("ladder-stands").stderr)
        self.assertIn("no inertia", draw("block-in-a-valley").stderr)
        record = json.loads((cli.ROOT / "corpus/records/friction-gravity-3-contacts.json").read_text())
        (self.folder / "found.json").write_text(json.dumps(record["problem"]))  # contacts that no file gives
        found = draw(self.folder / "found", "--percent", 0, "--draws", 1)
        self.assertEqual(found.stdout, "0 %: of 1: 1 cycle\n", found.stderr)

    def test_the_benchmark_shows_both_models(self):
        folder = self.folder / "scenes"
        folder.mkdir()
        (folder / "stack.json").write_text((FOLDER / "stack.json").read_text())
        done = cli.run("bench", "--suite", "scenes", "--scenes", folder, "--repeat", 1, "--json")
        (row,) = done.json()
        self.assertEqual((row["scene"], row["minimal"]["rows"], row["full"]["rows"]), ("stack", 20, 20))
        self.assertIn("(", cli.run("bench", "--suite", "scenes", "--scenes", folder, "--repeat", 1).out)
        done = cli.run("bench", "--suite", "scenes", "--scenes", folder, "--repeat", 1, "--threads", 2, "--json")
        (row,) = done.json()
        self.assertEqual(row["1 thread"]["problems"], row["2 threads"]["problems"])
        self.assertLessEqual(row["ratio"]["least"], row["ratio"]["most"])
        self.assertEqual(cli.run("bench", "--suite", "scenes", "--scenes", self.folder / "none").code, 2)


if __name__ == "__main__":
    cli.main()
