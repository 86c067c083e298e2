# SPDX-License-Identifier: Apache-2.0
"""Import, export and survey from outside: problems there and back, refusals, and what a survey says of them."""

import json
import subprocess
from fractions import Fraction

import cli

# u = W r + q of two planar contacts; W is singular and symmetric but for one entry, q in its range.
FRICTION = "2 2 0 4 4 4 4\n2 0 2 0\n0 1 0 1\n2 0 2 0\n0 1.0001 0 1\n-1 0.5 -1 0.5\n0.5 0.25\n"
LCP = "2 0 2 2 2 2\n2 1\n1 2\n-5 -6\n"


class Formats(cli.TestCase):
    def imported(self, text, *options):
        out = self.folder / "problem.json"
        self.succeeds("import", self.file("problem.dat", text), "-o", out, *options)
        return json.loads(out.read_text())

    def test_import_takes_every_number_at_its_double_value(self):
        problem = self.imported(FRICTION)
        self.assertEqual(problem["contacts"], [{"kind": "static", "mu": "1/2"}, {"kind": "static", "mu": "1/4"}])
        self.assertEqual(Fraction(problem["A"][1][3]), Fraction(1.0001))
        self.assertEqual(problem["A"][3][1], "1")
        self.assertEqual(problem["b"], ["-1", "1/2", "-1", "1/2"])
        self.assertEqual(problem["name"], "problem")
        self.assertEqual(problem["origin"], {"format": "siconos-fc", "storage": "dense", "file": "problem.dat"})

    def test_symmetrize_is_exact_and_recorded(self):
        problem = self.imported(FRICTION, "--symmetrize")
        mean = (Fraction(1.0001) + 1) / 2
        self.assertEqual([Fraction(problem["A"][1][3]), Fraction(problem["A"][3][1])], [mean, mean])
        recorded = problem["origin"]["symmetrized"]
        self.assertEqual(Fraction(recorded["largest difference"]), Fraction(1.0001) - 1)
        self.assertEqual((recorded["i"], recorded["j"]), (1, 3))

    def test_an_imported_problem_is_solved_as_any_other(self):
        self.imported(LCP)
        done = self.succeeds("solve", self.folder / "problem.json", "--method", "complete", "--json").json()
        self.assertEqual((done["f"], done["assumptions"]), (["4/3", "7/3"], []))

    def test_three_dimensions_are_imported(self):
        problem = self.imported("3 1 0 3 3 3 3\n15 -1 -2 -1 14 1 -2 1 16\n-1 2 3\n0.1\n")
        self.assertEqual((problem["dimension"], len(problem["b"])), (3, 3))
        self.succeeds("certify", self.folder / "problem.json", "--claim", "psd", "-o", self.folder / "c.json")

    def test_export_and_import_give_the_same_problem(self):
        first = self.imported(FRICTION)
        for name, storages in (("siconos-fc", ("dense", "blocks", "columns", "triplet")),
                               ("fclib", ("columns", "rows", "triplet"))):
            for storage in storages:
                with self.subTest(format=name, storage=storage):
                    out, back = self.folder / "exported", self.folder / "back.json"
                    done = self.succeeds("export", self.folder / "problem.json", "-o", out, "--format", name,
                                         "--storage", storage)
                    self.assertIn("0 numbers rounded", done.out)
                    self.succeeds("import", out, "-o", back)
                    second = json.loads(back.read_text())
                    for key in ("dimension", "contacts", "A", "b"):
                        self.assertEqual(first[key], second[key], key)

    def test_export_rounds_only_where_it_is_told_to(self):
        third = {**cli.SOLVED, "b": ["-1/3", "1"]}
        problem, out = self.file("third.json", third), self.folder / "third.dat"
        self.refuses("export", problem, "-o", out, "--format", "siconos-fc", says=["b[0]", "-1/3", "--round"])
        self.assertFalse(out.exists())
        done = self.succeeds("export", problem, "-o", out, "--format", "siconos-fc", "--round")
        self.assertIn("1 number rounded", done.out)

    def test_bad_files_and_wrong_formats_are_refused_with_their_place(self):
        out = self.folder / "out.json"
        bad = self.file("bad.dat", LCP.replace("-5", "five"))
        self.refuses("import", bad, "-o", out, says=[f"{bad}: line 4: found 'five'", "q[0]"])
        self.refuses("import", self.file("no.dat", "hello"), "-o", out, says="--format")
        self.refuses("import", self.folder / "absent.dat", "-o", out, says="absent.dat")
        self.refuses("import", bad, "-o", out, "--format", "fclib", says="no HDF5 file")
        self.refuses("import", bad, "-o", out, "--format", "matlab", says="matlab")
        self.refuses("export", self.file("p.json", cli.SOLVED), "-o", out, "--format", "siconos-lcp",
                     says="contacts[0].kind")
        self.assertFalse(out.exists())

    def test_files_of_other_kinds_are_refused_with_their_kind_and_nothing_is_written(self):
        out = self.folder / "out.json"
        matrix, cube = "0 2 2 2 2\n4 1\n1 3\n", "0 3 3 3 3\n2 0 0\n0 2 0\n0 0 2\n"
        for name, text, says in [
                ("relay", f"2\n{matrix}-1 -2\n-1 -1\n1 1\n", ["line 6: found 4 numbers more", "a relay problem"]),
                ("rectangular", "1 1 1 1\n0 1 2\n0 1\n0 3 2 3 2\n" + "1 -1 2 " * 6 + "7\n", ["line 4", "MLCP"]),
                ("rolling", "5 1\n0 5 5 5 5\n" + "1 2 3 4 5\n" * 6 + "0.3\n0.1\n", ["line 1", "a rolling friction problem"]),
                ("soclcp", f"3 1\n{cube}-1 2 0\n0 3\n0.5\n", ["2 numbers more", "SOCLCP"]),
                ("gmp", "1 1 1 1 1 1\n1\n1\n2 1\n0 1\n0\n0\n5\n\n-3\n\n2\n", ["line 4", "GMP"]),
                ("plasticity", f"3 1\n{cube}-1 2 0\n0.1\n0.1\n", ["1 number more", "plasticity (eta, theta)"]),
                ("von-mises", f"3 1\n2\n{cube}-1 2 0\n0.5\n", ["line 1", "a plasticity problem"])]:
            with self.subTest(name=name):
                file = self.file(f"{name}.dat", text)
                self.refuses("import", file, "-o", out, says=[f"{file}: line ", *says])
                self.assertFalse(out.exists())
                done = self.succeeds("survey", file, "--json", code=2)
                self.assertIn(says[1], done.json()[0]["error"])

    def test_a_global_problem_keeps_its_factors_and_is_the_same_condensed(self):
        cube, eye = "0 3 3 3 3\n2 0 0\n0 2 0\n0 0 4\n", "0 3 3 3 3\n1 0 0\n0 1 0\n0 0 1\n"
        problem = self.imported(f"3 1\n{cube}{eye}-1 -1 -1 0 0 4\n0.1\n")
        self.assertEqual(problem["factors"]["M"], ["2", "2", "4"])
        self.assertEqual(problem["factors"]["w"], ["-1/2", "-1/2", "-1/4"])
        self.assertEqual(problem["factors"]["c"], ["0", "0", "4"])
        self.assertEqual(problem["origin"]["format"], "siconos-gfc")

    def test_an_mlcp_is_solved_by_bilateral_and_frictionless_contacts(self):
        self.imported("1 0 1 1\n0 1 2\n0 1\n0 2 2 2 2\n4 1\n1 3\n5 -6\n")
        done = self.succeeds("solve", self.folder / "problem.json", "--method", "complete", "--json").json()
        self.assertEqual(done["f"], ["-21/11", "29/11"])

    def test_what_stands_behind_the_last_number_is_refused_but_for_a_flag_and_a_remark(self):
        problem = self.imported(LCP)
        for rest in ("0\n", "1\n"):
            self.assertEqual(self.imported(LCP + rest), problem)
        remarked = self.imported(LCP + "\nExample 3, Rome 1994\n")
        self.assertEqual(remarked["origin"].pop("remark"), "Example 3, Rome 1994")
        self.assertEqual(remarked, problem)
        for rest in ("garbage\n", "1 # 4 5 6\n", "0\n# a remark without an empty line above\n"):
            file = self.file("more.dat", LCP + rest)
            self.refuses("import", file, "-o", self.folder / "out.json", says="found text, from '")
        file = self.file("more.dat", LCP + "\n3 4 # remark\n")
        self.refuses("import", file, "-o", self.folder / "out.json",
                     says=f"{file}: line 6: found 2 numbers more, from '3' on, expected the end of the file")

    def test_bytes_that_are_no_text_do_not_end_a_survey(self):
        file = self.folder / "bytes.dat"
        file.write_bytes(LCP.encode().replace(b"-5", b"\xff\xfe"))
        done = self.succeeds("survey", file, self.file("good.dat", LCP), "--json", code=2)
        self.assertIn("line 4: found '??'", done.json()[0]["error"])

    def survey(self, *paths, code=0):
        return self.succeeds("survey", *paths, "--json", code=code).json()

    def test_hdf5_is_loaded_by_the_first_file_that_needs_it(self):
        loaded = subprocess.run(["ldd", cli.program], capture_output=True, text=True, check=True).stdout
        self.assertIn("libgmp", loaded)
        self.assertNotIn("hdf5", loaded)  # with what it needs it takes longer than all else until the program begins

    def test_survey_tells_which_assumptions_hold_and_what_solves(self):
        entry, = self.survey(self.file("fc.dat", FRICTION))
        self.assertEqual((entry["contacts"], entry["dimension"]), (2, 2))
        self.assertAlmostEqual(entry["asymmetry"]["difference"], 1e-4)
        self.assertFalse(entry["meets assumptions"])
        mended = entry["symmetrized"]
        self.assertFalse(mended["curvature"]["psd"])  # 1 times 1 is less than 1.00005 squared
        self.assertLess(mended["curvature"]["most"], 0)
        for runs in (entry["runs"], mended["runs"]):
            self.assertEqual([run["outcome"] for run in runs[-1:]], ["solved"])
            self.assertEqual(runs[-1]["certificate"], "solution-exists")

    def test_survey_of_several_counts_those_that_meet_the_assumptions(self):
        done = self.succeeds("survey", cli.ROOT / "corpus" / "two-contact-cycle.json", self.file("fc.dat", FRICTION))
        self.assertIn("Of 2 problems 1 meet the paper's assumptions, 1 do not, 0 are undecided.", " ".join(done.out.split()))

    def test_survey_of_a_problem_that_meets_all_assumptions(self):
        symmetric, = self.survey(self.file("fc.dat", FRICTION.replace("1.0001", "1")))
        self.assertIs(symmetric["meets assumptions"], True)
        self.assertNotIn("symmetrized", symmetric)
        double, published, exact = symmetric["runs"]
        self.assertEqual((double["method"], double["arithmetic"], double["outcome"]), ("complete", "double", "solved"))
        self.assertLess(double["residual"], 1e-12)
        self.assertEqual((exact["arithmetic"], exact["residual"]), ("exact", 0))
        self.assertEqual((published["method"], published["arithmetic"], published["outcome"], published["residual"]),
                         ("baraff", "exact", "solved", 0))
        outside, = self.survey(self.file("fc.dat", FRICTION.replace("1.0001", "1").replace("-1 0.5 -1", "-1 0.5 -3")))
        self.assertIs(outside["range"]["in-range"], False)
        # Along the kernel (1, 0, -1, 0) of W: 2 / sqrt(2), of abs(b) = sqrt(10.5).
        self.assertAlmostEqual(outside["range"]["distance"], (2 / 10.5) ** 0.5)
        self.assertIs(outside["meets assumptions"], False)

    def test_survey_counts_how_the_methods_end(self):
        self.file("reference.json", cli.REFERENCE)
        self.file("fc.dat", FRICTION.replace("1.0001", "1"))
        counts = self.succeeds("survey", self.folder).out.split("Each method, and how it ended:\n")[1]
        self.assertRegex(counts, r"(?m)^baraff, exact +cycle 1, solved 1$")
        self.assertRegex(counts, r"(?m)^complete, double +solved 2$")

    def test_suspicions_alone_are_run_over_rationals(self):
        files = [self.file("reference.json", cli.REFERENCE), self.file("solved.json", cli.SOLVED)]
        loop, solved = self.survey(*files, "--suspicions")
        self.assertEqual([(run["method"], run["arithmetic"], run["outcome"]) for run in loop["runs"]],
                         [("complete", "double", "solved"), ("baraff", "double", "cycle"), ("baraff", "exact", "cycle")])
        self.assertEqual([(run["method"], run["arithmetic"], run["outcome"]) for run in solved["runs"]],
                         [("complete", "double", "solved"), ("baraff", "double", "solved")])
        counts = self.succeeds("survey", self.folder, "--suspicions").out.split("and how it ended; exact: those that doubles leave open:\n")[1]
        self.assertRegex(counts, r"(?m)^baraff, double +cycle 1, solved 1$")
        self.assertRegex(counts, r"(?m)^baraff, exact +cycle 1$")
        jammed = self.folder / "jammed.json"
        self.succeeds("assemble", cli.ROOT / "corpus" / "scenes" / "scripted-wedge-jams.json", "-o", jammed)
        entry, = self.survey(jammed, "--suspicions")  # no solution, which only a run over rationals proves
        self.assertEqual([(run["arithmetic"], run["outcome"]) for run in entry["runs"]][-1], ("exact", "no-solution"))

    def test_what_the_matrix_does_not_couple_is_decided_exactly_group_by_group(self):
        size = 60
        rows = [["0"] * size for _ in range(size)]
        for i in range(0, size, 2):
            rows[i][i], rows[i][i + 1], rows[i + 1][i], rows[i + 1][i + 1] = "2", "1", "1", "2"
        problem = {**cli.SOLVED, "contacts": [{"kind": "frictionless"}] * size, "A": rows, "b": ["-5", "-6"] * 30}
        entry, = self.survey(self.file("pairs.json", problem))
        exact = entry["runs"][-1]
        self.assertEqual((exact["arithmetic"], exact["outcome"], exact["groups"]), ("exact", "solved", 30))
        # One pair without a solution: nor has the whole.
        for i in (0, 1):
            rows[i][0] = rows[i][1] = "0"
        entry, = self.survey(self.file("pairs.json", problem))
        self.assertEqual(entry["runs"][-1]["outcome"], "no-solution")
        self.assertIsNone(entry["range"]["in-range"])

    def test_survey_of_a_folder_goes_on_behind_a_bad_file(self):
        self.file("a.dat", "hello")
        self.file("b.dat", LCP)
        self.file("c.txt", "no problem")
        done = cli.run("survey", self.folder, "--json")
        self.assertEqual(done.code, 2)
        self.assertIn("a.dat", done.err)
        bad, good = json.loads(done.out)
        self.assertIn("line 1", bad["error"])
        self.assertIs(good["meets assumptions"], True)
        text = cli.run("survey", self.folder / "b.dat")
        self.assertEqual((text.code, len(text.out.splitlines())), (0, 6))

    def test_survey_of_more_than_fifty_contacts_gives_bounds_that_hold(self):
        size = 60
        rows = [[str(Fraction(2 if i == j else -1 if abs(i - j) == 1 else 0)) for j in range(size)]
                for i in range(size)]
        problem = {**cli.SOLVED, "contacts": [{"kind": "frictionless"}] * size, "A": rows, "b": ["-1"] * size}
        entry, = self.survey(self.file("chain.json", problem))
        self.assertIs(entry["curvature"]["psd"], True)
        # The smallest eigenvalue is 2 - 2 cos(pi / 61) = 0.00265; bounds are relative to 2.
        self.assertLess(entry["curvature"]["least"], 0.00133)
        self.assertIs(entry["range"]["in-range"], True)
        self.assertEqual([(run["method"], run["outcome"]) for run in entry["runs"]],
                         [("proximal", "solved"), ("complete", "solved")])
        rows[0][0] = rows[-1][-1] = "1"  # a chain without ends: singular, with the kernel (1, ..., 1)
        entry, = self.survey(self.file("loose.json", problem))
        self.assertIsNone(entry["range"]["in-range"])
        self.assertAlmostEqual(entry["range"]["distance"], 1, places=6)
        if entry["curvature"]["psd"] is None:
            self.assertLess(-1e-9, entry["curvature"]["least"])
            self.assertLessEqual(entry["curvature"]["least"], 0)
        rows[0][0] = "1/2"
        entry, = self.survey(self.file("indefinite.json", problem))
        self.assertIs(entry["curvature"]["psd"], False)
        self.assertLess(entry["curvature"]["most"], 0)


if __name__ == "__main__":
    cli.main()
