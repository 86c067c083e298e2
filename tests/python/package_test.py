# SPDX-License-Identifier: Apache-2.0
"""package_test.py PROGRAM SOURCES: the Python package says what the program says."""
import ast
import doctest
import inspect
import json
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np
import stiction

PROGRAM, SOURCES = sys.argv[1], Path(sys.argv[2])
LOOP = SOURCES / "corpus/cycle-every-policy-mu-1.json"
A = [[3, -4, 2, 0], [-4, 7, -4, 1], [2, -4, 7, -6], [0, 1, -6, 7]]
B = [-1, 0, 0, -2]


def said(*arguments):
    """What the program prints with --json."""
    return json.loads(subprocess.run([PROGRAM, *map(str, arguments), "--json"], stdout=subprocess.PIPE).stdout)


def without_seconds(json):
    """What two runs have in common."""
    return {key: {k: v for k, v in value.items() if k != "seconds"} if isinstance(value, dict) else value
            for key, value in json.items()}


class Readme(unittest.TestCase):
    def test_the_session_on_the_first_page_prints_what_stands_there(self):
        page = (SOURCES / "README.md").read_text()
        self.assertLess(page.index("    ./run python\n"), page.index("| question |"))  # the first screen
        session = page[page.index("    ./run python\n"):].split("\n\n")[0].splitlines()[1:]
        test = doctest.DocTestParser().get_doctest("\n".join(line.strip() for line in session) + "\n", {}, "README.md",
                                                   "README.md", 0)
        runner = doctest.DocTestRunner(verbose=False)
        runner.run(test)
        self.assertEqual((runner.failures, runner.tries), (0, len(test.examples)))
        self.assertGreaterEqual(len(test.examples), 3)


class Problems(unittest.TestCase):
    def test_doubles_integers_and_files_are_one_problem(self):
        digests = {stiction.load(LOOP).digest, stiction.Problem(A, B, 1).digest,
                   stiction.Problem(np.array(A, float), np.array(B, float), [1, 1]).digest,
                   stiction.Problem(np.array(A, float, order="F")[:, :], np.array(B), "1").digest}
        self.assertEqual(len(digests), 1)

    def test_fractions_are_exact(self):
        problem = stiction.Problem([[1, 0], [0, "1/3"]], [Fraction(-1, 7), 0.1], Fraction(1, 5))
        self.assertEqual(problem.exact_A[1][1], Fraction(1, 3))
        self.assertEqual(problem.exact_b, [Fraction(-1, 7), Fraction(0.1)])
        self.assertEqual(problem.mu, [Fraction(1, 5)])

    def test_views_share_the_problem_s_memory_and_outlive_it(self):
        problem = stiction.Problem(A, B, 1)
        view = problem.A
        self.assertTrue(np.shares_memory(view, problem.A))
        self.assertFalse(view.flags.owndata)
        self.assertFalse(view.flags.writeable)
        del problem
        np.testing.assert_array_equal(view, A)

    def test_sliding_contacts_of_a_file_are_those_of_arrays(self):
        files = sorted((SOURCES / "corpus/sliding").glob("*.json"))
        self.assertGreater(len(files), 1)
        for file in files:
            theirs = stiction.load(file)
            for A, b in ((theirs.exact_A, theirs.exact_b), (theirs.A, theirs.b)):
                ours = stiction.Problem(A, b, theirs.mu, theirs.kinds, theirs.dimension, slips=theirs.slips)
                self.assertEqual((ours.slips, ours.mu), (theirs.slips, theirs.mu))
            self.assertEqual(stiction.Problem(theirs.exact_A, theirs.exact_b, theirs.mu, theirs.kinds, theirs.dimension,
                                              slips=theirs.slips).digest, theirs.digest)
        self.assertTrue(any("sliding" in stiction.load(file).kinds for file in files))
        leaning = stiction.Problem(np.eye(3), [-1, 0, 0], 1, ["sliding"], 3, slips=[("3/5", Fraction(4, 5))])
        self.assertEqual(leaning.slips, [(Fraction(3, 5), Fraction(4, 5))])
        I = np.eye(4)
        for slips, named in ((None, "contacts.1..*slip"), ([None], "slips: found 1"), ([None, 2], "contacts.1..*slip"),
                             ([1, 1], "contacts.0..*no slip on a static"), ([None, (1, 0)], "contacts.1..*slip")):
            with self.assertRaisesRegex(ValueError, named):
                stiction.Problem(I, -I[0], 1, ["static", "sliding"], slips=slips)

    def test_what_is_saved_is_loaded(self):
        with tempfile.TemporaryDirectory() as folder:
            stiction.Problem(A, B, 1).save(Path(folder) / "p.json")
            self.assertEqual(stiction.load(Path(folder) / "p.json").digest, stiction.load(LOOP).digest)


class SameAsTheProgram(unittest.TestCase):
    FILES = sorted((SOURCES / "corpus").glob("cycle-*.json"))[:6]

    def test_solve(self):
        for file in self.FILES:
            for method in ((), ("auto",), ("complete",)):
                theirs = said("solve", file, *(("--method", *method) if method else ()))
                ours = stiction.solve(stiction.load(file), *method).json
                self.assertEqual(ours, {key: theirs[key] for key in theirs if key not in ("why", "assumptions")})

    def test_replay(self):
        for file in self.FILES:
            for arithmetic in ("exact", "double"):
                theirs = said("replay", file, "--step", "--arithmetic", arithmetic)
                theirs.pop("expected", None)
                self.assertEqual(stiction.replay(stiction.load(file), arithmetic=arithmetic).json, theirs)
            self.assertEqual(stiction.replay(stiction.load(file)).json,
                             stiction.replay(stiction.load(file), arithmetic="exact").json)

    def test_replay_in_space_tells_what_intervals_prove(self):
        told = set()
        for file in sorted((SOURCES / "corpus/space").glob("*.json")):
            theirs = said("replay", file, "--step", "--max-drives", 200)
            theirs.pop("expected", None)
            self.assertEqual(stiction.replay(stiction.load(file), max_drives=200).json, theirs)
            self.assertEqual("over_intervals" in theirs, theirs["outcome"] != "solved", file)
            told.add("over_intervals" in theirs)
        self.assertEqual(told, {True, False})

    def test_ends_under_every_policy(self):
        space = SOURCES / "corpus/space/three-sliding-contacts.json"
        for file in (LOOP, space):
            theirs = said("replay", file, "--all-policies", "--max-drives", 50)
            self.assertEqual(stiction.ends(stiction.load(file), max_drives=50), theirs["policies"])
        for chosen, outcome in (({}, "cycle"), ({"max_drives": 2}, "limit")):
            ends = stiction.ends(stiction.load(LOOP), **chosen)
            self.assertEqual((len(ends), {end["outcome"] for end in ends.values()}), (1536, {outcome}))

    def test_certify_and_its_budgets(self):
        problem = stiction.load(LOOP)
        with tempfile.TemporaryDirectory() as folder:
            for chosen in ({}, {"max_drives": 2}, {"max_pivots": 3}, {"max_bits": 1}, {"policy": "*"},
                           {"policy": "give-up=second", "max_drives": 9}):
                out = Path(folder) / "c.json"
                out.unlink(missing_ok=True)
                flags = [text for name, value in chosen.items() for text in ("--" + name.replace("_", "-"), value)]
                theirs = said("certify", LOOP, "--claim", "cycle", "-o", out, *flags)
                ours = stiction.certify(problem, "cycle", **chosen)
                self.assertEqual(ours.text if ours else None, out.read_text() if out.exists() else None, chosen)
                self.assertEqual(ours.kind if ours else None, theirs["claim"], chosen)
                decided = stiction.decide(problem, "cycle", **chosen)
                self.assertEqual((decided.claim, decided.state, decided.reason, decided.policies),
                                 tuple(theirs[key] for key in ("asked", "state", "reason", "policies")), chosen)
                if ours:
                    self.assertEqual(len(ours.policies()), theirs["policies"]["certified"])
                    self.assertIn(f" of {len(ours.policies()):,} ", repr(ours))
        self.assertIsNone(stiction.certify(problem, "cycle", max_drives=2))
        some = stiction.load(SOURCES / "corpus/two-contact-cycle.json")
        decided = stiction.decide(some, "cycle", "*")
        self.assertEqual((decided.state, decided.policies["so"], decided.policies["asked"]), ("disproved", 1320, 1536))
        self.assertIn("1,320 of 1,536 policies loop", repr(decided))
        self.assertIn("of 1,320 policies", repr(stiction.certify(some, "cycle", "*")))


class Options(unittest.TestCase):
    SPACE = SOURCES / "corpus/space/three-sliding-contacts.json"
    LONG = """
import numpy as np, stiction, sys
draw = np.random.default_rng(1)
J = draw.integers(-9, 10, (300, 300)).astype(float)
problem = stiction.Problem(J @ J.T, draw.integers(-9, 10, 300).astype(float), 0.5)
"""

    WRITING = {"help", "json", "fractions", "output", "html", "list", "record", "step", "svg"}
    ELSEWHERE = {"all_policies", "all", "safe", "robust", "coq"}  # which is `ends`, or what the program alone has

    def test_those_of_the_program_can_all_be_chosen(self):
        for verb in ("solve", "replay", "certify"):
            text = subprocess.run([PROGRAM, verb, "--help"], stdout=subprocess.PIPE, text=True).stdout
            theirs = {name.replace("-", "_") for name in re.findall(r"^ +(?:-[a-z], )?--([a-z-]+)", text, re.M)}
            ours = set(inspect.signature(getattr(stiction, verb)).parameters)
            self.assertEqual(ours - {"problem"}, theirs - self.WRITING - self.ELSEWHERE, verb)

    def test_defaults_are_those_of_the_program(self):
        compared = set()
        for verb in ("solve", "replay", "certify"):
            text = subprocess.run([PROGRAM, verb, "--help"], stdout=subprocess.PIPE, text=True).stdout
            for name, ours in inspect.signature(getattr(stiction, verb)).parameters.items():
                if isinstance(ours.default, str) and ours.default:
                    option = re.search(rf"^ +(?:-[a-z], )?--{name} TEXT.*?\(default\s+(\S+?)\)", text, re.M | re.S)
                    self.assertEqual(ours.default, option[1], (verb, name))
                    compared.add((verb, name))
        self.assertLessEqual({("solve", "method"), ("replay", "method"), ("certify", "claim")}, compared)

    def test_they_mean_the_same(self):
        for chosen in ({"law": "coulomb"}, {"law": "coulomb", "sides": 16}, {"max_pivots": 1, "method": "complete"},
                       {"arithmetic": "double", "residual": 1e-17},
                       {"arithmetic": "double", "residual": 1e-17, "method": "complete"},
                       {"arithmetic": "double", "pivot_tolerance": 0.01, "method": "complete"}):
            flags = [text for name, value in chosen.items() for text in ("--" + name.replace("_", "-"), value)]
            theirs = said("solve", self.SPACE, *flags)
            ours = stiction.solve(stiction.load(self.SPACE), **chosen).json
            self.assertEqual(without_seconds(ours), without_seconds({key: theirs[key] for key in theirs if
                                                                     key not in ("why", "assumptions")}), chosen)
        self.assertEqual(stiction.replay(stiction.load(LOOP), max_drives=2).outcome, "limit")

    def test_time_and_ctrl_c_end_a_long_run(self):
        names = {}
        exec(self.LONG, names)
        for method in ("complete", "lemke"):  # auto is done before
            start = time.monotonic()
            answer = stiction.solve(names["problem"], method, arithmetic="exact", seconds=0.2)
            self.assertEqual((answer.outcome, answer.reason), ("undecided", "stopped"), method)
            self.assertLess(time.monotonic() - start, 30, method)
        solving = self.LONG + "print(flush=True)\nstiction.solve(problem, 'complete', arithmetic='exact')"
        run = subprocess.Popen([sys.executable, "-c", solving], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True)
        run.stdout.readline()
        time.sleep(0.3)
        run.send_signal(signal.SIGINT)
        _, error = run.communicate(timeout=60)
        self.assertTrue(error.rstrip().endswith("KeyboardInterrupt"), error)


class Headline(unittest.TestCase):
    def test_the_loop_its_solution_and_the_certificate(self):
        problem = stiction.Problem(A, B, 1)
        run = stiction.replay(problem)
        self.assertEqual((run.outcome, run.start, run.period), ("cycle", 2, 5))
        self.assertEqual(run.pivots[0].step, Fraction(1, 3))
        answer = stiction.solve(problem)
        self.assertEqual(answer.outcome, "solved")
        exact = np.array(problem.exact_A, object) @ answer.exact_f + problem.exact_b
        self.assertEqual(tuple(exact), answer.exact_a)
        certificate = stiction.certify(problem, "counterexample")
        self.assertEqual(certificate.kind, "counterexample")
        self.assertTrue(stiction.check(problem, certificate))
        with self.assertRaisesRegex(ValueError, "digest|problem"):
            stiction.check(stiction.Problem(A, B, 2), certificate)


class NoForces(unittest.TestCase):
    def test_a_problem_without_solution_has_none(self):
        problem = stiction.load(SOURCES / "corpus/no-solution-zero-matrix.json")
        answer = stiction.solve(problem, "enumerate")
        self.assertEqual((answer.outcome, answer.exact_f, answer.exact_a), ("no-solution", (), ()))
        self.assertEqual((answer.f.shape, answer.a.shape), ((0,), (0,)))
        self.assertEqual(stiction.certify(problem).kind, "no-solution")


class Claims(unittest.TestCase):
    def test_all_of_the_program_can_be_asked_for_and_others_are_refused(self):
        problem = stiction.load(LOOP)
        self.assertEqual(stiction.certify(problem, "safe").kind, "unsafe")
        with self.assertRaisesRegex(ValueError, "claim: found safest, expected one of .*safe-by-condition"):
            stiction.certify(problem, "safest")
        with self.assertRaisesRegex(ValueError, "dimension"):
            stiction.certify(problem, "coulomb-solution")

    def test_safety_and_coulomb_s_law(self):
        safe = stiction.Problem(np.eye(2), [-1, 0], "1/3")
        self.assertEqual(stiction.certify(safe, "safe").kind, "safe")
        slides = stiction.load(SOURCES / "corpus/space/cube-slides-on-four-corners.json")
        certificate = stiction.certify(slides, "coulomb-solution")
        self.assertEqual(certificate.kind, "coulomb-solution")
        self.assertTrue(stiction.check(slides, certificate))
        self.assertEqual(stiction.certify(slides).kind, "coulomb-solution")
        self.assertEqual(stiction.certify(slides, law="baraff").kind, "solution-exists")

    def test_a_check_rejects_what_is_changed(self):
        problem = stiction.load(LOOP)
        text = stiction.certify(problem).text
        self.assertTrue(stiction.check(problem, text))
        with self.assertRaises(ValueError):
            stiction.check(problem, text.replace('"1/3"', '"1/4"', 1))


def members(node, within=""):
    """Name -> number of parameters, without self, of the functions and properties of a stub."""
    found = {}
    for part in node.body:
        if isinstance(part, ast.ClassDef):
            found |= members(part, part.name + ".")
        elif isinstance(part, ast.FunctionDef):
            names = [argument.arg for argument in part.args.args]
            found[within + part.name] = len(names) - names.count("self")
    return found


def compiled(thing, within=""):
    """The same of the compiled module, by the first line of what pybind11 documents."""
    found = {}
    for name, part in vars(thing).items():
        if inspect.isclass(part):
            found |= compiled(part, name + ".")
        elif isinstance(part, property):
            found[within + name] = 0
        elif callable(part) or isinstance(part, staticmethod):
            if name.startswith("__") and (name != "__init__" or within == "Problem."):
                continue
            line = getattr(thing, name).__doc__.splitlines()[0]
            found[within + name] = len(re.findall(r"\barg\d+|\b\w+(?=: )", line)) - ("self: " in line)
    return found


class Documented(unittest.TestCase):
    def test_public_names_have_docstrings_and_types(self):
        for name in stiction.__all__:
            thing = getattr(stiction, name)
            self.assertTrue(thing.__doc__, name)
            self.assertEqual(thing.__module__, "stiction")
            if inspect.isfunction(thing):
                signature = inspect.signature(thing)
                self.assertIsNot(signature.return_annotation, inspect.Signature.empty, name)
                for parameter in signature.parameters.values():
                    self.assertIsNot(parameter.annotation, inspect.Parameter.empty, f"{name}: {parameter}")

    def test_the_types_of_the_module_name_all_that_it_has(self):
        stub = ast.parse((SOURCES / "python/stiction/_stiction.pyi").read_text())
        self.assertEqual(members(stub), compiled(stiction._stiction))


class Many(unittest.TestCase):
    def test_each_problem_ends_as_it_does_alone(self):
        problems = [*stiction.draw("bodies", 3, 40), stiction.load(LOOP)]
        for method, arithmetic, policy in (("baraff", "exact", "paper"), ("baraff", "filtered", "apex=suspended"),
                                           ("complete", "double", "paper"), ("auto", "", "paper")):
            with self.subTest(method=method, arithmetic=arithmetic, policy=policy):
                ends = stiction.solve_all(problems, method, arithmetic, policy)
                alone = [stiction.solve(problem, method, arithmetic, policy) for problem in problems]
                self.assertEqual(list(ends["outcome"]), [answer.outcome for answer in alone])
                counters = set(ends) - {"outcome", "seconds", "decided_on"}
                self.assertEqual(counters, {name for answer in alone for name in answer.statistics})
                for name in counters:
                    self.assertEqual(list(ends[name]), [answer.statistics.get(name, 0) for answer in alone], name)
                self.assertTrue((ends["seconds"] > 0).all() and ends["seconds"].sum() < 60)
        self.assertIn("cycle", stiction.solve_all(problems, "baraff")["outcome"])
        unlike = stiction.Problem([[1, "1/3"], [3, 1]], [1, 1], 0, ["bilateral"] * 2)  # as doubles hold it, it has a solution
        self.assertEqual(list(stiction.solve_all([unlike], "enumerate", "double")["outcome"]), ["no-solution"])
        self.assertEqual(len(stiction.solve_all([])["outcome"]), 0)

    def test_answers_are_judged_and_suspicions_told(self):
        problems = [*stiction.draw("bodies", 3, 40), stiction.load(LOOP)]
        given = [problem.rounded("float") for problem in problems]
        for method, arithmetic in (("fast", "float"), ("complete", "filtered"), ("complete", "exact")):
            ends = stiction.solve_all(given, method, arithmetic, judge=given)
            self.assertEqual(list(np.isnan(ends["residual"])), list(ends["outcome"] != "solved"))
            self.assertLessEqual(np.nanmax(ends["residual"]), {"float": 1e-5, "filtered": 1e-8, "exact": 0}[arithmetic])
            self.assertEqual("decided_on" in ends, arithmetic == "filtered")
        others = [stiction.Problem(problem.A, problem.b + 1, problem.mu) for problem in given]
        self.assertGreater(np.nanmax(stiction.solve_all(given, "complete", "exact", judge=others)["residual"]), 0)
        told = stiction.solve_all(problems, "baraff", "double", confirm=False)
        self.assertEqual(told["outcome"][-1], "cycle")

    def test_a_problem_as_numbers_hold_it(self):
        third = stiction.Problem([["1/3", 0], [0, 1]], [-1, 0], "1/3")
        self.assertEqual(third.rounded().exact_A[0][0], Fraction(1 / 3))
        self.assertEqual(third.rounded("float").mu, [Fraction(float(np.float32(1 / 3)))])

    def test_problems_of_a_generator_are_functions_of_what_is_asked_for(self):
        problems = stiction.draw("conditioned", 2, 5, 3, mu="1/3")
        self.assertEqual(problems, stiction.draw("conditioned", 2, 5, 3, mu="1/3"))
        self.assertEqual(problems[2:4], stiction.draw("conditioned", 2, 2, 3, mu="1/3", first=2))
        self.assertEqual(len({*problems, *stiction.draw("conditioned", 2, 5, 4, mu="1/3"), *stiction.draw("psd", 2, 5, 3)}), 15)
        self.assertEqual({mu for problem in problems for mu in problem.mu}, {Fraction(1, 3)})
        self.assertEqual([problem.dimension for problem in stiction.draw("space", 2, 3)], [3] * 3)
        self.assertIn("sliding", stiction.draw("sliding", 3, 1)[0].kinds)
        for problem in problems:
            self.assertEqual(stiction.certify(problem, "symmetric").kind, "symmetric")

    def test_intervals_are_those_that_the_program_prints(self):
        low, high = stiction.interval(0, 1000)
        self.assertEqual(low, 0)
        self.assertAlmostEqual((1 - high) ** 1000, 0.025, places=9)
        self.assertAlmostEqual(np.exp(-stiction.interval(0)[1]), 0.025, places=9)
        low, high = stiction.interval(3, 10)
        self.assertTrue(0.06 < low < 0.07 and 0.65 < high < 0.66)


class Redundant(unittest.TestCase):
    def test_fast_solves_bilateral_rows_that_depend_on_others(self):
        """b in the range of A, held contacts among others: there is a solution, and no method calls it singular."""
        draw, tried = random.Random(3), 0
        for dimension, friction_rows in ((2, 2), (3, 3)):
            for _ in range(400):
                kinds = [draw.choice(["bilateral", "static", "frictionless"]) for _ in range(draw.randint(1, 3))]
                rows = sum(friction_rows if kind == "static" else 1 for kind in kinds)
                J = [[draw.randint(-2, 2) for _ in range(draw.randint(1, rows + 1))]]
                J += [[draw.randint(-2, 2) for _ in J[0]] for _ in range(rows - 1)]
                c = [draw.randint(-3, 3) for _ in J[0]]
                A = [[sum(x * y for x, y in zip(left, right)) for right in J] for left in J]
                b = [sum(x * y for x, y in zip(row, c)) for row in J]
                problem = stiction.Problem(A, b, [int(kind == "static") for kind in kinds], kinds, dimension=dimension)
                self.assertEqual(stiction.solve(problem, "fast").outcome, "solved", (kinds, A, b))
                tried += "bilateral" in kinds
        self.assertGreater(tried, 300)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
