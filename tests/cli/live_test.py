# SPDX-License-Identifier: Apache-2.0
"""What a page runs again (cli/live), WebAssembly under Node, is what the program says.

live_test.py PATH_TO_STICTION [SOURCES]

At night the module is compiled of these sources, by Emscripten, and answers to the byte. Otherwise it is the committed
one, of an earlier commit: runs end as the program's, with the same forces, in data that the pages can read."""

import functools
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import cli

MODULE = "reports/web/solver/solver.wasm.gz"
READINGS = [("baraff", "paper"), ("baraff", "give-up=second,ties=contacts"), ("baraff", "resume=round,file=yes"),
            ("complete", "paper"), ("lemke", "paper")]
IN_SPACE = [("baraff", "paper"), ("baraff", "slip=redirect"), ("baraff", "give-up=second,ties=contacts"),
            ("baraff", "resume=round,admit=eager,slip=redirect"), ("complete", "paper"), ("lemke", "paper")]
MOST_BYTES = 2_000_000  # that a page may grow by


def corpus(dimension, *folders):
    """The problems of the corpus, as they are, and with numbers of all spellings."""
    for folder in folders:
        for file in sorted((cli.ROOT / "corpus" / folder).glob("*.json")):
            problem = json.loads(file.read_text())
            if problem["format"] != "stiction-problem" or problem["dimension"] != dimension:
                continue
            problem.pop("scene", None)  # of which a page has a picture
            yield problem
            if problem["b"]:
                yield dict(problem, name=f"{problem['name']}-edited", b=["-0.125", *problem["b"][1:-1], "7/30"])


def in_space():
    """The corpus; bilateral and sliding contacts; many rows."""
    yield from corpus(3, "space")
    loop = json.loads((cli.ROOT / "corpus/space/cycle-under-both-slips.json").read_text())
    sliding = {"kind": "sliding", "mu": "1/2", "slip": ["3/5", "4/5"]}
    yield dict(loop, name="sliding", contacts=[sliding, *loop["contacts"][1:]])
    yield beside(dict(loop, contacts=[sliding, *loop["contacts"][1:]]), loop, "sliding-beside")
    yield dict(many(2), name="bilateral", contacts=[{"kind": "bilateral"}, *many(2)["contacts"][1:]],
               A=[[row[0], *row[3:]] for row in [many(2)["A"][0], *many(2)["A"][3:]]],
               b=[many(2)["b"][0], *many(2)["b"][3:]])
    yield many(5)


def beside(problem, other, name):
    """Two problems as one, without a word to each other."""
    n, m = len(problem["b"]), len(other["b"])
    return dict(problem, name=name, contacts=problem["contacts"] + other["contacts"], b=problem["b"] + other["b"],
                A=[row + ["0"] * m for row in problem["A"]] + [["0"] * n + row for row in other["A"]])


def many(contacts):
    """Static contacts in space with a full and definite A of small numbers."""
    n = 3 * contacts
    factor = [[(7 * i * i + 3 * j + i * j) % 11 - 5 for j in range(n)] for i in range(n)]
    product = [[sum(x * y for x, y in zip(row, other)) for other in factor] for row in factor]
    return {"format": "stiction-problem", "version": 1, "name": f"many-{contacts}", "dimension": 3,
            "contacts": [{"kind": "static", "mu": "9"}] * contacts,
            "A": [[str(x + (i == j)) for j, x in enumerate(row)] for i, row in enumerate(product)],
            "b": [str(-9 if i % 3 == 0 else (5 * i) % 7 - 3) for i in range(n)]}


def request(problem, method="baraff", policy="paper"):
    return {"ask": "run", "problem": problem if isinstance(problem, str) else json.dumps(problem), "method": method,
            "policy": policy}


def around(text, other):
    """Where it is another."""
    at = next((i for i, (x, y) in enumerate(zip(text, other)) if x != y), min(len(text), len(other)))
    return text[max(0, at - 200):at + 100]


@functools.cache
def module():
    if not cli.ALL:
        return cli.ROOT / MODULE
    made = Path(tempfile.mkdtemp(prefix="stiction-module-"), "solver.wasm.gz")
    unittest.addModuleCleanup(shutil.rmtree, made.parent)
    done = subprocess.run([sys.executable, cli.ROOT / "cli/live/build.py", made], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return made


def answers(requests):
    """Of the module, in order."""
    assert shutil.which("node") is not None, "expected node: apt-get install nodejs"
    done = subprocess.run(["node", Path(__file__).with_name("live_lines.mjs"), module()], text=True, capture_output=True,
                          timeout=300, input="".join(json.dumps(request) + "\n" for request in requests))
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@unittest.skipIf(cli.SHORT, "the program is the same in every build")
class Sources(cli.TestCase):
    def test_a_module_can_be_made_of_them(self):
        """At night one is. What compiles with GMP alone is found before."""
        if cli.ALL:
            self.skipTest("one is made")
        done = subprocess.run([sys.executable, cli.ROOT / "cli/live/build.py", "--check", "c++"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


@unittest.skipIf(cli.SHORT, "the program is the same in every build")
class Live(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        limits = json.loads(answers([{"ask": "switches"}])[0])["limits"]
        cls.limits = [word for name, value in limits.items() for word in (f"--{name}", str(value))]

    def page_data(self, problem, method, policy):
        """As the program puts it into a page."""
        file = self.file("problem.json", problem)
        done = cli.run("replay", file, "--html", "-", "--method", method, "--policy", policy, *self.limits)
        self.assertIn(done.code, (0, 1, 3), done.err)
        data = re.search(r'<script type="application/json" id="data">(.*?)</script>', done.out, re.S)[1]
        return data.replace("\\u003c", "<")

    def test_it_says_what_the_program_says(self):
        cases = [(problem, *reading) for problem in corpus(2, "", "sliding", "endless") for reading in READINGS]
        self.assertGreater(len(cases), 300)
        self.compare(cli.share(cases, 20))  # of five readings

    def test_in_space_it_takes_the_steps_that_the_program_takes(self):
        """The published algorithm over doubles alone, which it says; the program has more to say of the end."""
        cases = [(problem, *reading) for problem in in_space() for reading in IN_SPACE]
        self.assertGreater(len(cases), 100)
        self.compare([case for case in cases if case[1] != "baraff"][::4])
        cases = cli.share([case for case in cases if case[1] == "baraff"], 4)
        ends = []
        for case, answer in zip(cases, answers([request(*case) for case in cases]), strict=True):
            ours, theirs = (json.loads(one)["runs"][0] for one in (json.dumps(json.loads(answer)["data"]), self.page_data(*case)))
            if cli.ALL:
                self.assertEqual(ours["replay"]["pivots"], theirs["replay"]["pivots"], (case[0]["name"], *case[1:]))
            else:
                self.assert_agree(ours, theirs, (case[0]["name"], *case[1:]))
            self.assertRegex(ours["end"], "; over doubles alone: stiction replay says what is proved$")
            ends.append(ours["end"])
        for end in ("^solved", "^cycle: after rounding", "^ray"):
            self.assertTrue(any(re.search(end, one) for one in ends), end)

    def compare(self, cases):
        # A page that is run again does not know what the file expects of other policies.
        expected = ['{"data":' + self.page_data(*case).replace(',"every_policy":true', "") + "}" for case in cases]
        for (problem, *reading), answer, one in zip(cases, answers([request(*case) for case in cases]), expected, strict=True):
            if cli.ALL:
                self.assertTrue(answer == one, f"{problem['name']}, {reading}:\n{around(answer, one)}\n{around(one, answer)}")
                continue
            ours, theirs = json.loads(answer)["data"], json.loads(one)["data"]
            self.assertEqual(list(ours), list(theirs))
            for run, other in zip(ours["runs"], theirs["runs"], strict=True):
                self.assertEqual(run["replay"]["outcome"], other["replay"]["outcome"])
                self.assert_agree(run, other, (problem["name"], *reading))

    def assert_agree(self, run, other, case):
        """In the keys that a page reads, and in the forces at the end; over doubles but for rounding."""
        keys = [[key for key in one["replay"] if key != "suspected"] for one in (run, other)]  # nothing runs again in a page
        self.assertEqual((list(run), keys[0]), (list(other), keys[1]), case)
        forces, others = ([x for pivot in one["replay"]["pivots"][-1:] for x in pivot["f"]] for one in (run, other))
        for x, y in zip(forces, others, strict=True):
            tolerance = 0 if isinstance(x, str) else 1e-9
            self.assertTrue(math.isclose(Fraction(x), Fraction(y), rel_tol=tolerance, abs_tol=tolerance), case)

    def test_in_space_the_switches_are_those_that_are_built_there(self):
        answer = json.loads(answers([{"ask": "switches"}])[0])
        plane, space = ({row["name"]: [value["name"] for value in row["values"]] for row in answer[key]}
                        for key in ("switches", "in_space"))
        self.assertEqual(space.pop("slip"), ["literal", "redirect"])
        self.assertEqual(space, {name: values for name, values in plane.items() if name not in ("file", "apex")})

    def test_what_is_wrong_is_named(self):
        loop = cli.REFERENCE
        space = json.loads((cli.ROOT / "corpus/space/cycle-under-both-slips.json").read_text())
        wrong = [
            (dict(loop, b=["2", "x", "-2", "2"]), 'problem: b[1]: found "x", expected a number, such as'),
            (dict(loop, A=[["7", "-2", "-6", ""], *loop["A"][1:]]), 'problem: A[0][3]: found ""'),
            (dict(loop, b=["1/0", "0", "0", "0"]), 'problem: b[0]: found "1/0"'),
            (dict(loop, b=["1e20000", "0", "0", "0"]), 'problem: b[0]: found "1e20000"'),
            (dict(loop, contacts=[{"kind": "static", "mu": "-1"}, loop["contacts"][1]]),
             'problem: contacts[0].mu: found "-1", expected mu >= 0'),
            (dict(loop, contacts=[{"kind": "glued"}, loop["contacts"][1]]), 'problem: contacts[0].kind: found "glued"'),
            (dict(space, b=["1e400", *space["b"][1:]]), "problem: b[0]: found 1"),
            (self.large(65), "contacts: found 65 rows, expected at most 64"),
            ("{", "problem: line 1, column 2"),
        ]
        bad = [*(request(problem) for problem, _ in wrong), request(loop, policy="ties=none"), request(loop, "guess"),
               request(space, policy="apex=suspended"), {"ask": "nothing"}, {}]
        says = [*(text for _, text in wrong), "ties", "guess", "problem: --policy apex=suspended: in space expected",
                "expected run or switches", "request: ask: found nothing"]
        *wrong, again = answers([*bad, request(loop)])
        for answer, text in zip(wrong, says, strict=True):
            error, = json.loads(answer).items()
            self.assertEqual(error[0], "error")
            self.assertIn(text if cli.ALL else text.split(" found")[0], error[1])
        # And it goes on.
        self.assertEqual(json.loads(again)["data"]["runs"][0]["replay"]["outcome"], "cycle")

    @staticmethod
    def large(n):
        """n contacts without friction."""
        return {"format": "stiction-problem", "version": 1, "name": "large", "dimension": 2,
                "contacts": [{"kind": "frictionless"}] * n,
                "A": [["1" if i == j else "0" for j in range(n)] for i in range(n)], "b": ["-1"] * n}

    def test_an_endless_run_ends_in_a_limit_that_is_said(self):
        endless, = (cli.ROOT / "corpus/endless").glob("*.json")
        problem = json.loads(endless.read_text())
        answer, = answers([request(problem, policy="resume=round")])
        run = json.loads(answer)["data"]["runs"][0]
        self.assertEqual(run["replay"]["outcome"], "limit")
        self.assertRegex(run["end"], "^limit: out of ")

    def test_a_page_grows_by_less_than_it_may(self):
        self.assertLess(4 * module().stat().st_size / 3, MOST_BYTES)

    def test_a_page_says_of_which_commit_its_solver_is(self):
        commit = (cli.ROOT / "reports/web/solver/commit.txt").read_text().strip()
        self.assertRegex(commit, "^[0-9a-f]{7}$")
        page = cli.run("replay", cli.ROOT / "corpus/two-contact-cycle.json", "--html", "-").out
        self.assertIn(f'data-solver="{commit}"', page)


if __name__ == "__main__":
    cli.main()
