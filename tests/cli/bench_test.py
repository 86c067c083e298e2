# SPDX-License-Identifier: Apache-2.0
"""stiction bench: what its tables say is consistent, and but for times the same again. Never how fast."""

import json
import os
import unittest.mock

import cli


class Silent(cli.TestCase):
    """Wrong answers that say nothing of it."""

    @staticmethod
    def silent(*more):
        return cli.run("bench", "--suite", "silent", "--json", "--families", "masses", "range", "near-loops", "stack",
                       "--problems", 400, *more)

    def test_there_is_none_and_threads_change_nothing(self):
        first = self.silent()
        self.assertEqual(first.code, 0, first.err)
        cells = first.json()["cells"]
        for method in ["baraff", "complete", "fast", "lemke"]:
            asked = {cell["arithmetic"]: cell["runs"] for cell in cells if cell["method"] == method}
            self.assertGreater(asked["exact"], 60)
        self.assertEqual(sum(cell["runs"] for cell in cells if cell["arithmetic"] == "exact"), 400)
        self.assertEqual(([cell["wrong"] for cell in cells], first.json()["wrong"]), ([0] * len(cells), []))
        self.assertEqual(self.silent("--threads", 3).json(), first.json())
        self.assertNotEqual(self.silent("--seed", 2).json(), first.json())

    def test_large_problems_come_in_one_round_of_a_hundred(self):
        for families, problems, large in (["masses", "stack"], 12, 5), (["masses"], 7, 0):
            done = cli.run("bench", "--suite", "silent", "--json", "--families", *families, "--problems", problems)
            # the first round, of `complete`, has six settings of masses and five stacks; the second begins after it
            runs = {cell["method"]: cell["runs"] for cell in done.json()["cells"] if cell["arithmetic"] == "exact"}
            self.assertEqual((runs["complete"], runs["lemke"]), (6 + large, 1))


class Gate(cli.TestCase):
    """What is called solved over inexact numbers, judged over rationals."""

    FAMILIES = ["masses", "jam", "levers", "space-two-masses", "space-cube"]
    ENDS = ["solved", "cycle", "stall", "ray", "singular", "limit", "undecided", "no-solution"]

    @classmethod
    def gate(cls, *more):
        return cli.run("bench", "--suite", "gate", "--families", *cls.FAMILIES, "--problems", 2, *more)

    def test_nothing_called_solved_is_wrong_and_every_run_is_counted_once(self):
        first = self.gate("--json")
        self.assertEqual(first.code, 0, first.err)
        cells = first.json()["cells"]
        self.assertEqual((first.json()["wrong"], sum(cell["wrong"] for cell in cells)), ([], 0))
        for cell in cells:
            self.assertEqual(sum(cell[end] for end in self.ENDS), cell["runs"], cell)
            self.assertEqual(cell["runs"] + cell["refused"], 2, cell)
            self.assertEqual(cell["dimension"], 3 if cell["dial"].startswith("space-") else 2)
        self.assertEqual({cell["dial"] for cell in cells}, set(self.FAMILIES))
        self.assertEqual({cell["arithmetic"] for cell in cells}, {"float", "double", "quad", "filtered"})
        self.assertLessEqual({"auto", "fast", "complete", "lemke", "baraff"}, {cell["method"] for cell in cells})
        self.assertGreater(sum(cell["solved"] for cell in cells), 0.5 * sum(cell["runs"] for cell in cells))
        self.assertEqual(self.gate("--json").json(), first.json())
        self.assertNotEqual(self.gate("--json", "--seed", 2).json(), first.json())

    def test_the_tables_are_sums_of_the_cells(self):
        done = self.gate()
        self.assertEqual(done.code, 0, done.err)
        cells = self.gate("--json").json()["cells"]
        runs, solved = (sum(cell[key] for cell in cells) for key in ("runs", "solved"))
        self.assertIn(f"{runs} runs, {solved} called solved, 0 of them wrong", done.out)
        for dial in self.FAMILIES:
            of = sum(cell["runs"] for cell in cells if cell["dial"] == dial)
            self.assertRegex(done.out, rf"(?m)^ +{dial} +{of} ")

    def test_a_dial_that_is_not_known_is_refused(self):
        self.refuses("bench", "--suite", "gate", "--families", "jams", says="'jams'")


class GateCost(cli.TestCase):
    def test_every_problem_is_judged_in_every_turn(self):
        done = cli.run("bench", "--suite", "gate-cost", "--contacts", 2, 4, "--problems", 6, "--json")
        self.assertEqual(done.code, 0, done.err)
        rows = done.json()["gate-cost"]
        self.assertEqual([(row["contacts"], row["problems"], row["passed"]) for row in rows], [(2, 6, 6), (4, 6, 6)])
        for row in rows:
            self.assertGreaterEqual(row["gate/lu at 90 %"], row["gate/lu"])
            self.assertGreater(row["lu us"], 0)


@unittest.skipUnless(cli.ALL, "the packages are built for the first build of the matrix")
class PeersExtremes(cli.TestCase):
    """Packages along dials; those that are not installed are left out, our own are always there."""

    def test_lines_are_consistent_and_our_gate_lets_nothing_wrong_through(self):
        done = cli.run("bench", "--suite", "peers-extremes", "--json", "--problems", 2)
        self.assertEqual(done.code, 0, done.err)
        tables = {table["name"]: table["lines"] for table in done.json()["tables"]}
        self.assertEqual(sorted(tables), ["extremes", "extremes-frictionless"])
        for name, lines in tables.items():
            self.assertGreater(len({(line["dial"], line["at"]) for line in lines}), 60)
            for line in lines:
                with self.subTest(table=name, line=line):
                    if not line["installed"]:
                        self.assertTrue(line["package"])
                        continue
                    self.assertLessEqual(line["solved"] + line["silent"] + line["crashed"], line["tried"])
                    if not line["package"]:
                        self.assertEqual(line["crashed"], 0)
                    if line["name"] in ("fast", "auto"):
                        self.assertEqual(line["silent"], 0)
                    if line["dial"] == "tame" and not line["package"]:
                        self.assertEqual(line["solved"], line["tried"])


class Problems(cli.TestCase):
    """What the studies trade and extremes are given."""

    def test_a_line_for_each_setting_and_the_same_again(self):
        words = ("bench", "--suite", "problems", "--families", "masses", "range", "--problems", 2)
        done = self.succeeds(*words)
        sources = [json.loads(line) for line in done.out.splitlines()]
        self.assertEqual({source["family"]: source["has_solution"] for source in sources}, {"masses": True, "range": False})
        for source in sources:
            self.assertEqual([problem["format"] for problem in source["problems"]], ["stiction-problem"] * 2)
        self.assertEqual(self.succeeds(*words).out, done.out)
        self.assertNotEqual(self.succeeds(*words, "--seed", 2).out, done.out)
        generated = self.succeeds("bench", "--suite", "problems", "--contacts", 3, "--problems", 1).out.splitlines()
        self.assertIn(("psd", 3, 3), [(source["family"], source["setting"], len(source["problems"][0]["contacts"]))
                                      for source in map(json.loads, generated)])


RANDOM = ["full", "half", "planar", "planar-half", "space", "space-half"]
GROWTH = ["growth-frictionless", "growth-planar"]
WALLS = ["growth-walls", "growth-walls-in-space"]
FAMILIES = {"stack-10": (40, 30), "wall-6x5-masses": (180, 81), "wall-6x5-masses-smooth": (90, 54),
            "nearly-dependent": (16, 8), "stack": (20, 15), "space-stack-5": (60, 30)}  # rows and rank


@unittest.skipUnless(cli.ALL, "the packages are built for the first build of the matrix")
class Peers(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        # The environment of whoever asks for more threads does not get through.
        with unittest.mock.patch.dict(os.environ, {"OPENBLAS_NUM_THREADS": "2", "OMP_NUM_THREADS": "2"}):
            cls.done = cli.run("bench", "--suite", "peers", "--json", "--contacts", 2, 5, "--problems", 30,
                               "--repeat", 1, "--scenes", cli.ROOT / "corpus/scenes", "--families", *FAMILIES,
                               timeout=900)

    def setUp(self):
        super().setUp()
        self.assertEqual(self.done.code, 0, self.done.err)
        self.json = self.done.json()
        self.tables = {table["name"]: table for table in self.json["tables"]}
        self.families = {family["name"]: family for family in self.tables["structure"]["families"]}

    def columns(self):
        """Rows of every table and size, and of every family: name -> cell."""
        for name in RANDOM:
            for column in range(2):
                yield name, {row["name"]: {**row["cells"][column], "package": row["package"]}
                             for row in self.tables[name]["rows"]}
        for name, family in self.families.items():
            yield name, {cell["name"]: cell for cell in family["methods"]}

    def test_everything_ran_on_one_thread_and_says_so(self):
        said = self.json["one_thread"]
        self.assertEqual(set(said["variables"].values()), {"1"})
        self.assertLessEqual({"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"}, said["variables"].keys())
        self.assertEqual(self.json["threads"], 1)
        clocks = [self.json["clocks"]]
        clocks += [cell["clocks"] for _, rows in self.columns() for cell in rows.values() if "clocks" in cell]
        self.assertGreater(len(clocks), 100)
        for clock in clocks:
            self.assertLessEqual(clock["all_threads"], 1.05 * clock["one_thread"] + 0.01)
            self.assertLessEqual(clock["all_threads"], 1.05 * clock["wall"] + 0.01)
        self.assertGreater(self.json["clocks"]["all_threads"], 1)

    def test_what_a_ratio_is_to_and_what_findex_solves_is_said(self):
        self.assertTrue(self.json["lu"]["instructions"] and self.json["lu"]["native"])
        for words in ["another law", "abs(fF) <= mu abs(fN)", "before any friction", "pyramid"]:
            self.assertIn(words, self.json["findex"])
        packages = set()
        for name, rows in self.columns():
            self.assertEqual(rows["Eigen LU"]["ratios"], [1, 1, 1], name)
            for linear in ["Gauss, plain loops", "Eigen LU, native"]:
                self.assertGreater(rows[linear]["ratio"], 0, name)
                self.assertNotIn("share", rows[linear])
            packages |= {cell["package"] for cell in rows.values() if not cell["installed"]}
        self.assertEqual(packages, set(self.json["missing"]))

    def test_a_cell_is_consistent(self):
        for name, rows in self.columns():
            self.assertLessEqual({"auto", "fast", "complete"}, rows.keys())
            for method, cell in rows.items():
                with self.subTest(table=name, method=method):
                    self.assertTrue(cell["installed"] or cell["package"])
                    self.assertEqual("ratio" in cell, cell["installed"] and not cell["capped"])
                    if "share" not in cell:
                        continue
                    low, median, high = cell["ratios"]
                    self.assertTrue(0 < low <= median <= high <= cell["ratio_90"])
                    self.assertGreater(cell["processor_seconds"][1], 0)
                    self.assertAlmostEqual(cell["share"], 1 - cell["wrong"] / cell["tried"])
                    self.assertLessEqual(cell["silent"], cell["wrong"])
                    if cell["residual"] is not None and cell["worst"] is not None:
                        self.assertLessEqual(cell["residual"], cell["worst"])
                    self.assertEqual(cell["setting"] != "", method.endswith(", CFM") or "NSN-AC" in method)

    def test_no_answer_of_the_fast_method_is_wrong_on_random_problems(self):
        self.assertEqual(set(self.tables), {*RANDOM, "structure", *GROWTH, *WALLS})
        for name in RANDOM:
            rows = {row["name"]: row for row in self.tables[name]["rows"]}
            self.assertIn("Siconos NSN-AC 1e-9" if "space" in name else "published", rows)
            for method in ["fast", "complete", "auto"]:
                for cell in rows[method]["cells"]:
                    self.assertEqual((cell["tried"], cell["wrong"], cell["silent"]), (30, 0, 0), (name, method))
                    self.assertLessEqual(cell["residual"], 1e-8)
            for row in rows.values():
                self.assertEqual([cell["contacts"] for cell in row["cells"]], [2, 5])
        for name, method in [*((name, "fast") for name in GROWTH), *((name, "newton-bodies") for name in WALLS)]:
            points = [point for point in self.tables[name]["points"] if point["method"] == method]
            self.assertTrue(points and all(point["solved"] for point in points), name)

    def test_problems_with_structure_stand_beside_the_random_ones(self):
        self.assertEqual({name: (family["rows"], family["rank"]) for name, family in self.families.items()}, FAMILIES)
        for name, family in self.families.items():
            self.assertGreater(family["problems"], 1)
            self.assertEqual(family["rows"], family["contacts"] * (family["dimension"] if family["friction"] else 1))
            auto = next(cell for cell in family["methods"] if cell["name"] == "auto")
            self.assertEqual(auto["share"], 1, name)
            self.assertLessEqual(auto["worst"], 1e-8, name)

    def test_a_peer_that_is_ahead_is_named(self):
        for name in RANDOM:
            for peer in self.tables[name]["ahead"]:
                self.assertIn(peer["contacts"], [2, 5])
        for name, family in self.families.items():
            rows = {cell["name"]: cell for cell in family["methods"]}
            for ours in ["fast", "auto"]:
                mine = rows[ours]
                expected = {peer for peer, cell in rows.items() if cell["package"] and "share" in cell and "share" in mine
                            and (cell["share"] > mine["share"] or
                                 (cell["share"] == mine["share"] > 0 and cell["ratio"] < mine["ratio"]))}
                named = {peer["peer"] for peer in family["ahead"] if peer["ours"] == ours}
                self.assertEqual(named, expected, (name, ours))

    def test_the_text_says_what_the_json_says(self):
        done = self.succeeds("bench", "--suite", "structure", "--problems", 2, "--repeat", 1,
                             "--scenes", cli.ROOT / "corpus/scenes", "--families", "stack-10")
        for words in ["OPENBLAS_NUM_THREADS=1", "threads of this process: 1", "another law", "native",
                      "stack of 10 boxes: 20 contacts, 40 rows of rank 30, 2 problems", "processor time of all threads"]:
            self.assertIn(words, done.out)
        self.assertRegex(done.out, r"(?m)^  auto +\d+\.\d\d +\(.*100 % of 2, 2 by fast$")

    def test_families_and_their_scenes_are_asked_for_by_name(self):
        err = self.refuses("bench", "--suite", "structure", "--families", "tower", says=["found 'tower'", "wall-6x5"]).err
        self.assertEqual(len(err.splitlines()), 1)
        self.refuses("bench", "--suite", "structure", "--scenes", self.folder / "none", says=["--scenes", "none"])

    def test_growth_takes_the_same_steps_updated_and_afresh(self):
        done = cli.run("bench", "--suite", "growth", "--json", "--contacts", 3, 8, "--repeat", 1)
        self.assertEqual(done.code, 0, done.err)
        tables = done.json()["tables"]
        self.assertEqual([table["name"] for table in tables], [*GROWTH, *WALLS])
        for table in tables[2:]:
            in_space = table["name"].endswith("space")
            self.assertEqual([point["contacts"] for point in table["points"]], [16, 16] if in_space else [8, 8])
        for table in tables[:2]:
            points = {(point["method"], point["contacts"]): point for point in table["points"]}
            for method in ["published", "complete"]:
                for contacts in [3, 8]:
                    self.assertEqual(points[method, contacts]["counts"], points[method + "-afresh", contacts]["counts"])

    def test_engines_simulate_the_same_boxes_and_what_falls_has_no_rank(self):
        done = cli.run("bench", "--suite", "engines", "--json", "--problems", 60, "--families", "wall-23",
                       "boxes-1-to-10000-space", "dominoes-20", "hit-14-space", timeout=900)
        self.assertEqual(done.code, 0, done.err)
        scenes = {scene["scene"]: scene for scene in done.json()["tables"][0]["scenes"]}
        self.assertEqual({name: scene["bodies"] for name, scene in scenes.items()},
                         {"wall-23": 23, "dominoes-20": 20, "hit-14-space": 15, "boxes-1-to-10000-space": 10})
        moving = ("dominoes-20", "hit-14-space")
        for name, scene in scenes.items():
            rates = sorted((row["frames a second"] for row in scene["rows"] if row["end"] != "falls"), reverse=True)
            for row in scene["rows"]:
                with self.subTest(scene=name, row=row):
                    self.assertTrue(row["version"])
                    self.assertLessEqual(row["frames"], 60)
                    self.assertEqual(row["rank"], None if row["end"] == "falls" else rates.index(row["frames a second"]) + 1)
                    self.assertEqual(row["end"] == "ends", name in moving and row["end"] != "falls")
                    self.assertGreaterEqual(row["worst frame"], 999 / row["frames a second"])
                    if row["engine"] == "stiction" and name not in moving:
                        self.assertEqual((row["end"], row["frames"]), ("stands", 60))
                        self.assertLess(row["moved"], 1e-9)
        self.assertIn("wall-95", self.refuses("bench", "--suite", "engines", "--families", "tower", says="'tower'").err)

    def test_a_search_is_measured_beside_lemke(self):
        done = cli.run("bench", "--suite", "lemke", "--json", "--contacts", 2)
        self.assertEqual(done.code, 0, done.err)
        for row in done.json()["tables"][0]["rows"]:
            self.assertEqual(row["contacts"], 2)
            if "problems" in row:
                self.assertLess(row["wrong of the peer"], row["problems"])

    def test_bad_options_exit_with_2(self):
        self.refuses("bench", "--suite", "peers", "--problems", 0, says=["--problems"])
        self.refuses("bench", "--suite", "search", "--contacts", 9, says=["--contacts", "found 9", "1 to 8", "search"])
        self.refuses("bench", "--suite", "lemke", "--contacts", 6, says=["found 6", "1 to 5"])
        self.refuses("bench", "--suite", "growth", "--contacts", 0, says=["--contacts"])


class Search(cli.TestCase):
    def test_a_search_is_measured(self):
        done = cli.run("bench", "--suite", "search", "--json", "--problems", 2000, "--repeat", 2, "--contacts", 2, 6)
        self.assertEqual(done.code, 0, done.err)
        result = done.json()
        self.assertEqual({row["contacts"] for row in result["rates"]}, {2, 6})
        for row in result["rates"]:
            least, median, most = row["problems a second"]
            self.assertTrue(0 < least <= median <= most, row)
        self.assertEqual(result["lanes"][0]["generator"], "integers")
        self.assertIn("none", result["lanes"][0])
        for row in result["mix"]:
            parts = [row[name] for name in ("generation", "doubles", "filtered", "exact", "compared", "finishing")]
            self.assertAlmostEqual(sum(parts), 1, places=6)
        self.assertEqual([row["threads"] for row in result["threads"]], [1, 2])
        store, = result["store"]
        self.assertTrue(0 < store["median"] <= store["most, a block closed"], store)
        self.assertAlmostEqual(store["cores that it keeps busy"], store["a unit"] / store["with the store, mean"], places=6)
        for row in result["roofline"]:
            self.assertGreater(row["problems a second at most"], row["problems a second"])

    def test_a_search_by_one_generator_has_its_rates_alone(self):
        done = cli.run("bench", "--suite", "search", "--json", "--problems", 500, "--repeat", 1, "--contacts", 3,
                       "--generator", "psd")
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual(set(done.json()), {"rates", "lanes"})


if __name__ == "__main__":
    cli.main()
