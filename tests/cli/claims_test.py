# SPDX-License-Identifier: Apache-2.0
"""Every claim that `certify` takes is proved, disproved or not decided, in the same words in text and JSON."""

import json
import re
import subprocess
import sys

import cli

CORPUS = cli.ROOT / "corpus"
ASYMMETRIC = {**cli.SOLVED, "A": [["2", "1"], ["0", "3"]]}
INDEFINITE = {**cli.SOLVED, "A": [["1", "2"], ["2", "1"]]}
INDEFINITE_AT_REST = {"A": [["-1", "0"], ["0", "1"]], "b": ["1", "0"], "mu": "1"}
SLIPS_IN_SPACE = {"dimension": 3, "contacts": [{"kind": "static", "mu": "1"}],
                  "A": [["2", "0", "0"], ["0", "3", "0"], ["0", "0", "3"]], "b": ["-2", "3", "4"]}
SINGULAR = {**cli.SOLVED, "A": [["1", "1"], ["1", "1"]]}  # b is not in its range
STATIC = {"kind": "static", "mu": "1"}
NONE = CORPUS / "no-solution-zero-matrix.json"


def zero(dimension, contacts, b):
    rows = dimension * contacts
    return {**cli.SOLVED, "dimension": dimension, "contacts": [STATIC] * contacts,
            "A": [["0"] * rows for _ in range(rows)], "b": [b] + ["0"] * (rows - 1)}


REST, SLIDE = CORPUS / "space/cube-rests-on-four-corners.json", CORPUS / "space/three-sliding-contacts.json"
NONE_IN_SPACE = zero(3, 1, "-1")
OPEN_IN_SPACE = CORPUS / "space/no-solution-scripted-wedge.json"  # which nothing here decides


def many():
    """More words than are looked at, all safe: normals are coupled with each other alone, too much for the condition."""
    size = 9
    rows = [["0"] * (2 * size) for _ in range(2 * size)]
    for i in range(size):
        rows[2 * i + 1][2 * i + 1] = "1"
        for j in range(size):
            rows[2 * i][2 * j] = "1001/1000" if i == j else "1"
    return {**cli.SOLVED, "contacts": [STATIC] * size, "A": rows, "b": ["0"] * (2 * size)}


MANY = many()
# Of each claim: a problem of which it is true; one of which it is false, and the claim of the certificate that says so;
# one that is left open, with its options, and what is said of it.
NEVER = None  # it is always decided
TABLE = {
    "existence": ((cli.REFERENCE, "solution-exists"), (NONE, "no-solution"),
                  (OPEN_IN_SPACE, [], "enumerate: a contact mode that nothing refutes")),
    "solution-exists": ((cli.REFERENCE, "solution-exists"), (NONE, "no-solution"),
                        (OPEN_IN_SPACE, [], "enumerate: a contact mode that nothing refutes")),
    "coulomb-solution": ((REST, "coulomb-solution"), (NONE_IN_SPACE, "no-solution"),
                         (OPEN_IN_SPACE, [], "enumerate: a contact mode that nothing refutes")),
    "coulomb-exact": ((SLIDE, "coulomb-exact"), (NONE_IN_SPACE, "no-solution"), (OPEN_IN_SPACE, [], "")),
    "rests": ((REST, "rests"), (NONE_IN_SPACE, "cannot-rest"), (zero(2, 31, "0"), [], "it has 62 rows, and programs take 60")),
    "symmetric": ((cli.SOLVED, "symmetric"), (ASYMMETRIC, "not-symmetric"), NEVER),
    "psd": ((cli.SOLVED, "psd"), (INDEFINITE, "not-psd"), NEVER),
    "definite": ((cli.SOLVED, "definite"), (SINGULAR, "not-definite"), NEVER),
    "in-range": ((cli.SOLVED, "in-range"), (SINGULAR, "not-in-range"), NEVER),
    "h": ((cli.SOLVED, "h"), (SINGULAR, "not-h"), NEVER),  # but in space, where it hangs on a point of a circle
    "exists": ((cli.SOLVED, "exists"), (NONE, "no-solution"), (INDEFINITE_AT_REST, [], "the theorem does not speak of it")),
    "safe": ((cli.SOLVED, "safe"), (cli.REFERENCE, "unsafe"), (MANY, [], "more than 65,536 words")),
    "safe-by-condition": ((CORPUS / "safe-by-condition.json", "safe-by-condition"), (cli.REFERENCE, "unsafe"),
                          (MANY, [], "no scaling was found")),
    "cycle": ((cli.REFERENCE, "cycle"), (cli.SOLVED, None), (cli.REFERENCE, ["--max-drives", 2], "out of drives")),
    "ray": ((CORPUS / "space/ray-under-slip-literal.json", "ray"), (SLIPS_IN_SPACE, None),
            (REST, ["--max-drives", 1], "out of drives")),
    "endless": ((CORPUS / "space/no-state-twice.json", "endless"), (SLIPS_IN_SPACE, None),
                (REST, ["--max-drives", 1], "out of drives")),
    "counterexample": ((cli.REFERENCE, "counterexample"), (cli.SOLVED, None),
                       (cli.REFERENCE, ["--max-drives", 2], "out of drives")),
}


class Claims(cli.TestCase):
    def asked(self, claim, problem, options):
        """The answer as JSON, once the text says the same; and where its certificate is."""
        file = problem if not isinstance(problem, dict) else self.file("p.json", problem)
        out = self.folder / "c.json"
        out.unlink(missing_ok=True)
        words = ("certify", file, "--claim", claim, "-o", out, *options)
        said, done = cli.run(*words, "--json"), cli.run(*words)
        answer = said.json()
        self.assertEqual(said.code, done.code)
        text = cli.unwrapped(done.out)
        named = f", {answer['claim']}" if answer["claim"] not in (None, claim) else ""
        self.assertTrue(text.startswith(f"{f'{out}: ' if answer['claim'] else ''}{claim}: {answer['state']}{named}: "), text)
        self.assertIn(cli.unwrapped(answer.get("reason", "")), text)
        self.assertEqual(out.exists(), answer["claim"] is not None)
        return answer, done.code, out

    def accepted(self, out, claim):
        self.assertIn(f"accepted: {claim}", self.succeeds("check", out).out)
        checked = subprocess.run([sys.executable, cli.ROOT / "certify/check_certificate.py", out], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout)

    def test_all_claims_stand_in_the_table(self):
        said = self.refuses("certify", self.file("p.json", cli.SOLVED), "-o", "-", "--claim", "nothing", says="expected one of").err
        self.assertEqual(set(re.search(r"one of ([a-z, -]+[a-z])", cli.unwrapped(said))[1].split(", ")), set(TABLE))

    def test_what_is_true_is_proved(self):
        for claim, ((problem, certified), _, _) in TABLE.items():
            with self.subTest(claim=claim):
                answer, code, out = self.asked(claim, problem, ())
                self.assertEqual((answer["asked"], answer["state"], answer["claim"], code), (claim, "proved", certified, 0))
                self.accepted(out, certified)

    def test_what_is_false_is_disproved_by_its_negation_or_by_a_run(self):
        for claim, (_, (problem, certified), _) in TABLE.items():
            with self.subTest(claim=claim):
                answer, code, out = self.asked(claim, problem, ())
                self.assertEqual((answer["state"], answer["claim"]), ("disproved", certified))
                self.assertEqual(code, 0 if certified else 1)
                if certified:
                    self.accepted(out, certified)
                else:
                    self.assertRegex(answer["reason"], "under paper the published algorithm ends in [a-z]+ after [0-9,]+ drives?, ")

    def test_what_is_left_open_says_what_was_spent_or_cannot_be_told(self):
        for claim, (_, _, left) in TABLE.items():
            if left is NEVER:
                continue
            with self.subTest(claim=claim):
                problem, options, says = left
                answer, code, _ = self.asked(claim, problem, options)
                self.assertEqual((answer["state"], answer["claim"], code), ("not decided", None, 3))
                self.assertIn(says, answer["reason"])
                self.assertNotEqual(answer["reason"], "")

    def test_of_several_policies_it_says_of_how_many(self):
        file, out = CORPUS / "two-contact-cycle.json", self.folder / "c.json"
        counts = cli.run("replay", file, "--all-policies", "--json").json()["counts"]
        self.assertGreater(counts["solved"], 0)
        answer, code, out = self.asked("cycle", file, ("--policy", "*"))
        self.assertEqual((answer["state"], answer["claim"], code), ("disproved", "cycle", 1))
        self.assertEqual((answer["policies"]["so"], answer["policies"]["otherwise"]),
                         (counts["cycle"], {"solved": counts["solved"]}))
        self.accepted(out, "cycle")
        # A budget that all spend decides nothing; one that some spend does, if another ends otherwise.
        answer, code, _ = self.asked("cycle", file, ("--policy", "*", "--max-drives", 1))
        self.assertEqual((answer["state"], answer["policies"]["otherwise"], code),
                         ("not decided", {"limit": sum(counts.values())}, 3))

    def test_of_one_policy_it_says_how_the_loop_goes_on(self):
        answer, _, _ = self.asked("cycle", CORPUS / "two-contact-cycle.json", ())
        self.assertEqual(answer["reason"], "under paper the state after 3 drives recurs 4 drives later, for ever")
        answer, _, _ = self.asked("endless", CORPUS / "space/no-state-twice.json", ())
        self.assertRegex(answer["reason"], "^under paper no state recurs: from the state after .* on it never leaves a box, ")

    def test_a_loop_in_space_refutes_that_the_run_ends_in_a_ray(self):
        loop, ray = CORPUS / "space/cycle-under-both-slips.json", CORPUS / "space/ray-under-slip-literal.json"
        for claim, problem, certified in (("ray", loop, "cycle"), ("cycle", ray, "ray"), ("endless", ray, "ray")):
            answer, code, out = self.asked(claim, problem, ())
            self.assertEqual((answer["state"], answer["claim"], code), ("disproved", certified, 0))
            self.assertEqual(json.loads(out.read_text())["claim"], certified)
            self.assertNotIn("ends in cycle", answer["reason"])  # what never ends has no end

    def test_in_space_all_policies_are_those_that_are_built_there(self):
        file = CORPUS / "space/cycle-under-both-slips.json"
        every = cli.run("replay", file, "--all-policies", "--json").json()
        done = cli.run("certify", file, "--claim", "cycle", "--policy", "*", "-o", self.folder / "c.json", "--json")
        answer = done.json()
        self.assertEqual(answer["policies"]["asked"], len(every["policies"]))
        # Intervals say so of all; the certificate proves it of one.
        self.assertEqual((answer["state"], answer["policies"]["certified"], done.code), ("not decided", 1, 3))
        self.assertIn("as intervals say; the certificate is of 1 of the", answer["reason"])

    def test_without_a_solution_there_is_no_counterexample(self):
        sliding = CORPUS / "sliding"
        for file in (sliding / "cycle-of-sliding-contacts.json", sliding / "cycle-or-ray-without-solution.json"):
            answer, code, out = self.asked("counterexample", file, ())
            existence, _, _ = self.asked("existence", file, ())
            self.assertEqual((existence["claim"], answer["claim"], answer["state"], code),
                             ("no-solution", "no-solution", "disproved", 0))


# Nothing solves it: f1 - f2 >= 1, and f1 - f2 <= 1 - 1e-17. Over doubles everything does.
ROUNDED_AWAY = {"dimension": 3, "contacts": [{"kind": "frictionless"}] * 2, "A": [["1", "-1"], ["-1", "1"]],
                "b": ["-1", "0.99999999999999999"]}


class Rounded(cli.TestCase):
    """What rounded numbers say is not said of the file."""

    def test_runs_over_doubles_say_so_beside_a_proof_of_the_opposite(self):
        file = self.file("p.json", ROUNDED_AWAY)
        self.assertIn("disproved, no-solution", self.succeeds("certify", file, "-o", self.folder / "c.json").out)
        done = self.succeeds("replay", file, "--all-policies")
        self.assertRegex(cli.unwrapped(done.out), r"solved: all [0-9]+ policies \(double: rounded runs, which prove nothing")
        self.assertEqual(self.succeeds("replay", file, "--all-policies", "--json").json()["arithmetic"], "double")
        self.assertRegex(cli.unwrapped(cli.run("explain", file).out), "readings of its text, over doubles: solved [0-9]+")
        self.assertIn("over doubles", next(step["shows"] for step in cli.run("explain", file, "--json").json()["next"]
                                           if step["command"].endswith("--step")))

    def test_in_the_plane_runs_are_exact(self):
        file = self.file("p.json", cli.REFERENCE)
        done = cli.run("replay", file, "--all-policies", "--json")
        self.assertEqual(done.json()["arithmetic"], "exact")
        self.assertNotIn("over doubles", cli.run("explain", file).out.split("readings of its text")[1][:40])


if __name__ == "__main__":
    cli.main()
