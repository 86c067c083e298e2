# SPDX-License-Identifier: Apache-2.0
"""stiction solve and replay on files: outputs and exit codes."""

import json
from fractions import Fraction

import cli


def changed(problem, **members):
    return {**problem, **members}


def product(A, x):
    return [sum(Fraction(a) * Fraction(v) for a, v in zip(row, x)) for row in A]


class Exponential(cli.TestCase):
    def member(self, n, *more):
        return self.succeeds("problem", "--exponential", n, *more).json()

    def pivots(self, problem, *more):
        result = self.succeeds("solve", self.file("e.json", problem), "--json", *more).json()
        self.assertEqual((result["outcome"], result["assumptions"]), ("solved", []))
        return result["statistics"]

    def test_the_member_of_five_contacts_is_the_one_in_the_corpus(self):
        with open(cli.ROOT / "corpus/exponential-pivots-5-frictionless.json") as stored:
            stored = json.load(stored)
        for key in ["name", "contacts", "A", "b"]:
            self.assertEqual(self.member(5)[key], stored[key])

    def test_two_to_the_n_less_one_pivots(self):
        for n in [1, 2, 7, 10]:
            self.assertEqual(self.pivots(self.member(n), "--method", "baraff")["pivots"], 2 ** n - 1)
            self.assertEqual(self.pivots(self.member(n), "--method", "complete")["pieces"], 2 ** n - 1)
            scaled = self.member(n, "--scaled")
            for scan in ["paper", "scan=most-violated"]:
                self.assertEqual(self.pivots(scaled, "--method", "baraff", "--policy", scan)["pivots"], 2 ** n - 1)
        self.assertLess(self.pivots(self.member(10), "--method", "baraff", "--policy", "scan=most-violated")["pivots"], 20)

    def test_large_members_are_exact_and_bad_usage_is_refused(self):
        large = self.member(200)
        self.assertEqual((len(large["contacts"]), large["A"][0][0]), (200, str(1 + 4 * 199)))
        self.assertEqual(Fraction(large["b"][0]), Fraction(1, 8 ** 200) - 1)
        scaled = self.member(200, "--scaled")
        self.assertEqual(Fraction(scaled["b"][0]), 4 ** 199 * Fraction(large["b"][0]))
        for arguments in [[], ["--scaled"], ["some.store"], ["some.store", 1], ["some.store", 1, 1, "--exponential", 3],
                          ["some.store", 1, 1, "--scaled"]]:
            self.refuses("problem", *arguments, says=["STORE UNIT INDEX", "--exponential"])
        self.refuses("problem", "--exponential", 0, says=["--exponential"])
        self.refuses("problem", "--exponential", 201, says=["--exponential"])


class Solve(cli.TestCase):
    def assertSolution(self, problem, f):
        """The conditions (1) and (18) of the paper, exactly, for static contacts."""
        f = [Fraction(x) for x in f]
        a = [x + Fraction(b) for x, b in zip(product(problem["A"], f), problem["b"])]
        for i, contact in enumerate(problem["contacts"]):
            mu = Fraction(contact["mu"])
            fn, ff, an, af = f[2 * i], f[2 * i + 1], a[2 * i], a[2 * i + 1]
            self.assertTrue(fn >= 0 and an >= 0 and fn * an == 0)
            self.assertLessEqual(abs(ff), mu * fn)
            self.assertLessEqual(ff * af, 0)
            self.assertTrue(af == 0 or abs(ff) == mu * fn)

    def test_a_solution_is_exact_and_exits_with_0(self):
        file = self.file("p.json", cli.SOLVED)
        result = self.succeeds("solve", file, "--json", "--method", "baraff").json()
        self.assertEqual(result["outcome"], "solved")
        self.assertEqual(result["f"], ["1/2", "-1/3"])
        self.assertEqual(result["a"], ["0", "0"])
        self.assertEqual(result["assumptions"], [])
        self.assertEqual((result["method"], result["arithmetic"], result["policy"]), ("baraff", "exact", "paper"))
        self.assertGreater(result["statistics"]["drives"], 0)
        text = self.succeeds("solve", file).out
        self.assertEqual(text.splitlines()[0], "solved: these forces meet every condition, (15) and (16), exactly")
        self.assertRegex(text, r"N1 +1/2 +0\n +F1 +-1/3 +0\n")

    def test_other_readings_solve_what_the_reference_policy_does_not(self):
        file = self.file("p.json", cli.REFERENCE)
        outcomes = self.succeeds("replay", file, "--all-policies", "--json", code=1).json()["policies"]
        solving = [policy for policy, entry in outcomes.items() if entry["outcome"] == "solved"]
        self.assertGreater(len(solving), 3)
        for policy in solving[:3]:
            result = self.succeeds("solve", file, "--json", "--method", "baraff", "--policy", policy).json()
            self.assertEqual(result["f"], ["1", "-6/7", "25/14", "-25/14"])  # its only solution
            self.assertSolution(cli.REFERENCE, result["f"])

    def test_a_cycle_exits_with_1(self):
        file = self.file("p.json", cli.REFERENCE)
        result = self.succeeds("solve", file, "--json", "--method", "baraff", code=1).json()
        self.assertEqual((result["outcome"], result["start"], result["period"]), ("cycle", 3, 4))
        self.assertEqual(self.succeeds("solve", file, "--method", "baraff", code=1).out.splitlines()[0], "cycle: the state after 3 drives recurs 4 drives later, for ever")

    def test_no_contacts_at_all_are_solved(self):
        file = self.file("p.json", changed(cli.SOLVED, contacts=[], A=[], b=[]))
        self.assertEqual(self.succeeds("solve", file, "--json").json()["f"], [])
        self.succeeds("replay", file)

    def test_a_budget_exits_with_3_and_says_which(self):
        file = self.file("p.json", cli.REFERENCE)
        for option, reason in [("--max-drives", "drives"), ("--max-pivots", "pivots"), ("--max-bits", "bits")]:
            with self.subTest(option=option):
                result = self.succeeds("solve", file, "--json", "--method", "baraff", option, 1, code=3).json()
                self.assertEqual((result["outcome"], result["reason"]), ("limit", reason))

    def test_rounded_arithmetics(self):
        file = self.file("p.json", cli.SOLVED)
        for arithmetic in ["float", "double", "quad"]:
            with self.subTest(arithmetic=arithmetic):
                result = self.succeeds("solve", file, "--json", "--arithmetic", arithmetic).json()
                self.assertEqual((result["outcome"], result["arithmetic"]), ("solved", arithmetic))
                self.assertAlmostEqual(result["f"][0], 0.5, 6)
                self.assertAlmostEqual(result["f"][1], -1 / 3, 6)
                self.assertLessEqual(result["residual"], 1e-6)
                # What they suspect is claimed only after an exact run.
                cycle = self.succeeds("solve", self.file("c.json", cli.REFERENCE), "--json", "--method", "baraff", "--arithmetic",
                                      arithmetic, code=1).json()
                self.assertEqual((cycle["outcome"], cycle["start"], cycle["period"]), ("cycle", 3, 4))
                self.assertIn(cycle["suspected"]["outcome"], ["cycle", "stall", "limit"])

    def test_filtered_says_what_it_was_decided_on(self):
        for problem, outcome, rung in [(cli.SOLVED, "solved", "double"), (cli.REFERENCE, "cycle", "exact")]:
            with self.subTest(outcome=outcome):
                file = self.file("p.json", problem)
                code = 0 if outcome == "solved" else 1
                result = self.succeeds("solve", file, "--json", "--method", "baraff", "--arithmetic", "filtered", code=code).json()
                self.assertEqual((result["outcome"], result["arithmetic"], result["rung"]), (outcome, "filtered", rung))
                exact = self.succeeds("solve", file, "--json", "--method", "baraff", code=code).json()
                self.assertEqual(result["statistics"], exact["statistics"])
                self.assertNotIn("rung", exact)
                for ends, force in zip(result["f"], exact["f"]) if rung != "exact" else []:
                    self.assertLessEqual(Fraction(ends[0]), Fraction(force))
                    self.assertLessEqual(Fraction(force), Fraction(ends[1]))

    def test_the_errors_of_forces_are_told(self):
        file = self.file("p.json", cli.SOLVED)
        told = self.succeeds("solve", file, "--json", "--arithmetic", "double").json()
        for name in ["acceleration_error", "force_error", "backward_error"]:
            self.assertLess(told[name], 1e-14, name)
        self.assertEqual(told["residual"], max(told["acceleration_error"], told["force_error"]))
        self.assertGreaterEqual(told["amplification"], 1)
        text = self.succeeds("solve", file, "--arithmetic", "double").out
        for name in ["acceleration error", "force error", "backward error", "amplification", "worst contact"]:
            self.assertIn(name, text)
        self.assertNotIn("backward_error", self.succeeds("solve", file, "--json").json())

    def test_the_usual_arithmetic_says_why(self):
        file = self.file("p.json", cli.SOLVED)
        self.assertIn("few rows", self.succeeds("solve", file, "--json").json()["why"])
        self.assertIn("made for doubles", self.succeeds("solve", file, "--json", "--method", "fast").json()["why"])
        self.assertNotIn("why", self.succeeds("solve", file, "--json", "--arithmetic", "double").json())

    def test_what_is_not_built_is_refused(self):
        file = self.file("p.json", cli.SOLVED)
        self.refuses("solve", file, "--arithmetic", "decimal", says=["decimal", "expected one of", "exact"])
        self.refuses("solve", file, "--arithmetic", "interval", "--method", "fast", says=["interval", "expected one of", "exact"])
        self.refuses("solve", file, "--method", "gauss", says=["gauss", "expected one of", "baraff"])

    def test_the_fast_method(self):
        file = self.file("c.json", cli.REFERENCE)
        for arithmetic in [[], ["--arithmetic", "float"], ["--arithmetic", "quad"]]:
            with self.subTest(arithmetic=arithmetic):
                result = self.succeeds("solve", file, "--json", "--method", "fast", *arithmetic).json()
                self.assertEqual((result["outcome"], result["word"]), ("solved", "S-"))
                self.assertEqual(result["arithmetic"], (arithmetic or ["", "double"])[1])
                for found, expected in zip(result["f"], [1, -6 / 7, 25 / 14, -25 / 14]):
                    self.assertAlmostEqual(found, expected, 5)
                self.assertLessEqual(result["residual"], 1e-6)
                self.assertEqual(set(result["statistics"]),
                                 {"sweeps", "exchanges", "factorizations", "updates", "published", "fallbacks"})
        exact = self.succeeds("solve", file, "--json", "--method", "fast", "--arithmetic", "exact").json()
        self.assertEqual(exact["f"], ["1", "-6/7", "25/14", "-25/14"])
        none = self.file("n.json", changed(cli.SOLVED, contacts=[{"kind": "static", "mu": "1"}],
                                           A=[["1", "-1"], ["-1", "1"]], b=["-1", "0"]))
        result = self.succeeds("solve", none, "--json", "--method", "fast", code=3).json()
        self.assertEqual(result["outcome"], "undecided")

    def test_assumptions_that_fail_have_exact_witnesses(self):
        def failed(**members):
            problem = changed(cli.SOLVED, **members)
            done = cli.run("solve", self.file("p.json", problem), "--json")
            self.assertIn(done.code, [0, 1, 3])
            return problem, {entry["assumption"]: entry for entry in done.json()["assumptions"]}

        problem, entries = failed(A=[["2", "1"], ["0", "3"]])
        i, j = entries["symmetric"]["i"], entries["symmetric"]["j"]
        self.assertNotEqual(problem["A"][i][j], problem["A"][j][i])

        problem, entries = failed(A=[["1", "2"], ["2", "1"]])
        x = [Fraction(v) for v in entries["psd"]["x"]]
        value = sum(v * w for v, w in zip(x, product(problem["A"], x)))
        self.assertLess(value, 0)
        self.assertEqual(value, Fraction(entries["psd"]["value"]))

        problem, entries = failed(A=[["1", "1"], ["1", "1"]], b=["-1", "1"])
        y = entries["in-range"]["y"]
        self.assertEqual(product(problem["A"], y), [0, 0])
        value = sum(Fraction(v) * Fraction(b) for v, b in zip(y, problem["b"]))
        self.assertNotEqual(value, 0)
        self.assertEqual(value, Fraction(entries["in-range"]["value"]))
        self.assertNotIn("psd", entries)

    def test_of_many_contacts_an_answer_names_the_verb_that_writes_the_witness(self):
        size = 61
        A = {"size": size, "entries": [[i, i, "2"] for i in range(size - 1)] + [[size - 1, 0, "1"], [size - 1, size - 1, "1/4"]]}
        file = self.file("p.json", changed(cli.SOLVED, contacts=[{"kind": "frictionless"}] * size, A=A, b=["-1"] * size))
        answer = cli.run("solve", file, "--method", "fast", "--json").json()
        failed, = answer["assumptions"]
        self.assertEqual((failed["assumption"], failed["witness"]), ("psd", "certify --claim psd"))
        least = (Fraction(9, 4) - (Fraction(49, 16) + 4) ** Fraction(1, 2)) / 2  # the smallest eigenvalue, negative
        self.assertLess(failed["quotient"], 0)
        self.assertGreaterEqual(failed["quotient"], float(least) - 1e-9)
        self.assertLess(len(json.dumps(answer["assumptions"])), 200)
        certificate = self.folder / "c.json"
        self.succeeds("certify", file, *failed["witness"].split()[1:], "-o", certificate)
        self.succeeds("check", certificate)
        stated = json.loads(certificate.read_text())
        x = [Fraction(v) for v in stated["witness"]["x"]]
        self.assertEqual((stated["claim"], len(x)), ("not-psd", size))
        self.assertAlmostEqual(float(Fraction(stated["witness"]["value"]) / sum(v * v for v in x)), failed["quotient"], 9)

    def test_what_the_method_does_not_handle_is_refused_by_place(self):
        space = changed(cli.SOLVED, dimension=3, A=[["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]],
                        b=["-1", "0", "0"])
        file = self.file("p.json", space)
        for verb in [("minimize", "-o", "-", "--as-scene"), ("certify", "-o", "-", "--claim", "counterexample")]:
            self.refuses(*verb, file, says=[file, "dimension: found 3"])
        frictionless = changed(cli.SOLVED, contacts=[{"kind": "frictionless"}], A=[["2"]], b=["-1"])
        self.assertEqual(self.succeeds("solve", self.file("p.json", frictionless), "--json").json()["f"], ["1/2"])

    def test_wrong_problems_are_refused_by_place(self):
        for members, says in [
            ({"version": 2}, "version: found 2"),
            ({"A": [["1", "0"]]}, "A"),
            ({"b": ["1", "nan"]}, "b[1]: found \"nan\""),
            ({"b": ["1", "1/0"]}, "b[1]"),
            ({"contacts": [{"kind": "static"}]}, "contacts[0].mu"),
            ({"contacts": [{"kind": "static", "mu": "-1"}]}, "contacts[0].mu"),
            ({"extra": 1}, "extra: found an unknown key"),
            ({"expect": {"paper": "fine"}}, "expect"),
            ({"expect": {"paper": "solved", "scan=lowest": "cycle"}}, "expect"),
        ]:
            with self.subTest(members=members):
                file = self.file("p.json", changed(cli.SOLVED, **members))
                self.refuses("solve", file, "--json", says=[file, says, "expected"])


class Replay(cli.TestCase):
    def test_the_reference_point_as_json(self):
        result = self.succeeds("replay", self.file("p.json", cli.REFERENCE), "--json", code=1).json()
        self.assertEqual((result["outcome"], result["start"], result["period"]), ("cycle", 3, 4))
        self.assertEqual((result["policy"], result["expected"]), ("paper", ""))
        period = [pivot for pivot in result["pivots"] if pivot["drive"] > 3]
        self.assertEqual([pivot["step"] for pivot in period], cli.PERIOD)
        self.assertEqual(result["statistics"]["steps"], len(result["pivots"]))
        self.assertEqual(result["statistics"]["drives"], 7)
        self.assertNotIn("f", result["pivots"][0])

    def test_every_step_as_json(self):
        result = self.succeeds("replay", self.file("p.json", cli.REFERENCE), "--json", "--step", code=1).json()
        f = [Fraction(0)] * 4
        for pivot in result["pivots"]:
            f = [x + Fraction(pivot["step"]) * Fraction(d) for x, d in zip(f, pivot["df"])]
            a = [x + Fraction(b) for x, b in zip(product(cli.REFERENCE["A"], f), cli.REFERENCE["b"])]
            self.assertEqual([Fraction(x) for x in pivot["f"]], f)
            self.assertEqual([Fraction(x) for x in pivot["a"]], a)
        self.assertEqual([Fraction(x) for x in result["f"]], f)

    def test_the_reference_point_as_text(self):
        file = self.file("p.json", cli.REFERENCE)
        *lines, hint = self.succeeds("replay", file, code=1).out.splitlines()
        self.assertIn("--step", hint)
        self.assertEqual(lines[0], "two-contact-cycle: 2 contacts, policy paper, exact")
        self.assertEqual(lines[-1], "cycle: the state after 3 drives recurs 4 drives later, for ever")
        first, again = [k for k, line in enumerate(lines) if line.startswith("----")]
        self.assertEqual([line.split()[4] for line in lines[first + 1:again]], cli.PERIOD)
        self.assertEqual(again, len(lines) - 2)
        steps = self.succeeds("replay", file, "--step", code=1).out
        for text in ["f = 0, a = b = (2, -1, -2, 2)", "Drive 7:", "df = (", "s = 65/63:", "CF = {"]:
            self.assertIn(text, steps)
        self.assertIn(f"\n{lines[-1]}\n", steps)

    def test_expect_decides_the_exit_code(self):
        for problem, expect, code in [
            (cli.SOLVED, None, 0), (cli.REFERENCE, None, 1),
            (cli.REFERENCE, {"paper": "cycle"}, 0), (cli.REFERENCE, {"paper": "solved"}, 1),
            (cli.REFERENCE, {"scan=lowest": "cycle"}, 0), (cli.REFERENCE, {"*": "cycle"}, 0),
            (cli.REFERENCE, {"*": "solved", "paper": "cycle"}, 0), (cli.REFERENCE, {"ties=contacts": "cycle"}, 1),
            (cli.SOLVED, {"paper": "cycle"}, 1), (cli.SOLVED, {"ties=contacts": "cycle"}, 0),
        ]:
            with self.subTest(problem=problem["name"], expect=expect):
                file = self.file("p.json", problem if expect is None else changed(problem, expect=expect))
                text = self.succeeds("replay", file, code=code).out
                result = self.succeeds("replay", file, "--json", code=code).json()
                wanted = (expect or {}).get("paper") or (expect or {}).get("scan=lowest") or (expect or {}).get("*", "")
                self.assertEqual(result["expected"], wanted)
                self.assertEqual("expected: " in text, code == 1 and wanted != "")

    def test_a_policy_is_reported_in_its_canonical_name(self):
        result = self.succeeds("replay", self.file("p.json", cli.SOLVED), "--json", "--policy",
                               "ties=contacts,scan=lowest,give-up=second").json()
        self.assertEqual(result["policy"], "give-up=second,ties=contacts")

    def test_all_policies(self):
        file = self.file("p.json", cli.REFERENCE)
        result = self.succeeds("replay", file, "--all-policies", "--json", code=1).json()
        self.assertEqual(len(result["policies"]), 1536)
        self.assertEqual(sum(result["counts"].values()), 1536)
        counts = {}
        for entry in result["policies"].values():
            counts[entry["outcome"]] = counts.get(entry["outcome"], 0) + 1
        self.assertEqual(counts, result["counts"])
        self.assertEqual(result["policies"]["paper"], {"outcome": "cycle", "start": 3, "period": 4})
        self.assertEqual(len(result["unexpected"]), 1536 - counts["solved"])
        text = self.succeeds("replay", file, "--all-policies", code=1).out
        self.assertLess(len(text.splitlines()), 10)
        for outcome, count in counts.items():
            line = next(line for line in text.splitlines() if line.startswith(f"{outcome}: "))
            self.assertIn("all 1536 policies" if count == 1536 else f"{count} of 1536 policies", line)
        listed = self.succeeds("replay", file, "--all-policies", "--list", code=1).out
        self.assertRegex(listed, r"(?m)^cycle +paper$")
        self.assertEqual(len(listed.splitlines()), 1536 + len(text.splitlines()) - ("--list" in text))

        # What the summary says of switches holds for each policy that it counts.
        mixed = cli.ROOT / "corpus" / "cycle-or-singular-by-policy.json"
        by_policy = cli.run("replay", mixed, "--all-policies", "--json").json()["policies"]
        lines = [line for line in cli.run("replay", mixed, "--all-policies").out.splitlines() if " all with " in line]
        self.assertEqual([line.split(":")[0] for line in lines], ["cycle", "singular", "solved"])
        for line in lines:
            outcome = line.split(":")[0]
            for words in line.split(" all with ")[1].split(", "):
                switch, values = words.split("=")
                default = {"admit": "lazy", "file": "no"}[switch]
                found = {dict(w.split("=") for w in name.split(",") if "=" in w).get(switch, default)
                         for name, entry in by_policy.items() if entry["outcome"] == outcome}
                self.assertEqual(found, set(values.split(" or ")), line)

        # Each of some policies alone ends as in the grid.
        for policy in list(result["policies"])[::311]:
            one = cli.run("replay", file, "--json", "--policy", policy).json()
            self.assertEqual((one["policy"], one["outcome"]), (policy, result["policies"][policy]["outcome"]))

        expect = {policy: entry["outcome"] for policy, entry in result["policies"].items()}
        self.succeeds("replay", self.file("e.json", changed(cli.REFERENCE, expect=expect)), "--all-policies")
        expect["paper"] = "solved"
        wrong = self.succeeds("replay", self.file("e.json", changed(cli.REFERENCE, expect=expect)), "--all-policies",
                              "--json", code=1).json()
        self.assertEqual(wrong["unexpected"], ["paper"])
        self.succeeds("replay", self.file("s.json", cli.SOLVED), "--all-policies")


if __name__ == "__main__":
    cli.main()
