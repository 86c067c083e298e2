# SPDX-License-Identifier: Apache-2.0
"""Loops in space: certified, accepted by both checkers; altered, refused by both."""

import copy
import json
import subprocess
import sys
from fractions import Fraction
from unittest import mock

import cli

# Under both slips it never leaves a box.
IN_A_BOX = {
    "format": "stiction-problem", "version": 1, "name": "in-a-box", "dimension": 3,
    "contacts": [{"kind": "static", "mu": "3"}, {"kind": "static", "mu": "3"}],
    "A": [["7", "-1", "-4", "1", "-3", "-2"], ["-1", "13", "5", "2", "1", "1"], ["-4", "5", "12", "-3", "3", "3"],
          ["1", "2", "-3", "2", "-1", "0"], ["-3", "1", "3", "-1", "8", "-1"], ["-2", "1", "3", "0", "-1", "8"]],
    "b": ["-1", "2", "-2", "1", "2", "-3"],
}

# Literally read, it never leaves a box, as is known from lines along which f has moved before.
ALONG_LINES = {
    "format": "stiction-problem", "version": 1, "name": "along-lines", "dimension": 3,
    "contacts": [{"kind": "static", "mu": "1"}, {"kind": "static", "mu": "1"}],
    "A": [["11", "-5", "-1", "-6", "3", "5"], ["-5", "21", "7", "12", "3", "-3"], ["-1", "7", "16", "6", "0", "-2"],
          ["-6", "12", "6", "13", "4", "-6"], ["3", "3", "0", "4", "12", "2"], ["5", "-3", "-2", "-6", "2", "6"]],
    "b": ["-1", "4", "2", "0", "4", "3"],
}

# Redirected, a contact turns away with an aF that comes nearer and nearer to zero.
PUNCTURED = {
    "format": "stiction-problem", "version": 1, "name": "punctured", "dimension": 3,
    "contacts": [{"kind": "static", "mu": "1"}, {"kind": "static", "mu": "1"}],
    "A": [["7", "1", "-1", "-2", "-5", "-2"], ["1", "8", "-1", "-2", "-3", "-4"], ["-1", "-1", "8", "3", "-1", "3"],
          ["-2", "-2", "3", "8", "1", "-2"], ["-5", "-3", "-1", "1", "11", "2"], ["-2", "-4", "3", "-2", "2", "7"]],
    "b": ["-1", "2", "3", "-3", "-3", "-1"],
}


class LoopsInSpace(cli.TestCase):
    def certificate(self, problem, policy):
        file = self.folder / "loop.json"
        self.succeeds("certify", problem, "--claim", "cycle", "--policy", policy, "-o", file)
        return json.loads(file.read_text())

    def verdicts(self, certificates):
        """Of the program, and of the two independent programs."""
        files = []
        for k, certificate in enumerate(certificates):
            files.append(self.folder / f"{k}.json")
            files[-1].write_text(json.dumps(certificate))
        said = [entry["accepted"] for entry in cli.run("check", *files, "--json").json()]
        for name in ("check_certificate.py", "check_runs.py"):
            done = subprocess.run([sys.executable, cli.ROOT / "certify" / name, *files], capture_output=True, text=True)
            self.assertEqual(done.stderr, "")
            lines = [line for line in done.stdout.splitlines() if line.startswith(str(self.folder))]
            self.assertEqual([": accepted: " in line for line in lines], said, done.stdout)
        return said

    def proofs(self, policy):
        """By kind."""
        boxed = self.folder / "box.json"
        boxed.write_text(json.dumps(IN_A_BOX))
        proofs = [self.certificate(problem, policy)
                  for problem in (cli.ROOT / "corpus/space/cycle-under-both-slips.json", boxed)]
        self.assertEqual([proof["witness"]["kind"] for proof in proofs], ["states", "box"])
        return proofs

    def test_both_kinds_are_accepted(self):
        for policy in ("paper", "slip=redirect", "give-up=second,slip=redirect"):
            with self.subTest(policy=policy):
                states, box = self.proofs(policy)
                self.assertEqual(self.verdicts([states, box]), [True, True])
                self.assertEqual(states["witness"]["policy"], policy)
                self.assertEqual(len(box["witness"]["radii"]), len(box["witness"]["charts"]))

    def altered(self, proof):
        """(what, certificate), all of them false."""
        def with_(what, change):
            other = copy.deepcopy(proof)
            change(other["witness"], other["problem"])
            return what, other

        def put(key, value):
            return with_(f"{key} {value}", lambda witness, _: witness.update({key: value}))

        def sign(vector, k):
            def change(_, problem):
                problem[vector][k] = str(-Fraction(problem[vector][k]))
            return with_(f"the sign of {vector}[{k}]", change)

        witness = proof["witness"]
        word = witness["word"]
        yield put("word", word[:-1])
        yield put("word", [*word, word[-1]])
        yield put("word", [word[1], word[0], *word[2:]])
        yield put("word", [*word[:-1], word[-1].rsplit(" ", 1)[0] + " NC"])
        yield put("start", witness["start"] + 1)
        yield put("start", witness["start"] - 1 if witness["start"] else 7)
        yield put("period", witness["period"] + 1)
        yield put("period", 2 * witness["period"])
        yield put("bits", 5000)
        yield put("policy", "slip=redirect" if witness["policy"] == "paper" else "paper")
        yield put("policy", "slip=polygon")
        yield put("kind", "box" if witness["kind"] == "states" else "states")
        yield sign("b", 0)
        yield sign("b", 4)
        yield with_("mu", lambda _, problem: problem["contacts"][0].update(mu="1/7"))
        yield with_("A", lambda _, problem: problem["A"][1].__setitem__(4, "-1"))

    def altered_box(self, proof):
        def put(key, k, value):
            other = copy.deepcopy(proof)
            other["witness"][key][k] = value
            return f"{key}[{k}] {value}", other

        witness = proof["witness"]
        for k in range(len(witness["radii"])):
            centre, radius = (Fraction(witness[key][k]) for key in ("centre", "radii"))
            yield put("centre", k, str(centre + 2 * radius))
            yield put("centre", k, str(centre - 2 * radius))
            yield put("centre", k, str(-centre))
            yield put("radii", k, str(radius / 2**200))  # the run does not come into it
            yield put("radii", k, "8")  # it has many words
            yield put("radii", k, "0")
            yield put("radii", k, str(-radius))
            yield put("charts", k, 1 if witness["charts"][k] == 0 else 0)
            yield put("charts", k, 2)
            if witness["charts"][k]:
                yield put("charts", k, -witness["charts"][k])

    def test_altered_ones_are_refused(self):
        states, box = self.proofs("slip=redirect")
        self.refused([*self.altered(states), *self.altered(box), *self.altered_box(box)], 40)

    def test_what_moved_along_a_line_comes_back_exactly(self):
        problem = self.folder / "lines.json"
        problem.write_text(json.dumps(ALONG_LINES))
        proof = self.certificate(problem, "paper")
        self.assertEqual(self.verdicts([proof]), [True])
        said = subprocess.run([sys.executable, cli.ROOT / "certify/check_runs.py", self.folder / "0.json"],
                              capture_output=True, text=True).stdout
        self.assertIn("by the line", said)
        self.refused([*self.altered(proof), *self.altered_box(proof)], 20)

    def test_a_punctured_box(self):
        problem = self.folder / "punctured.json"
        problem.write_text(json.dumps(PUNCTURED))
        proof = self.certificate(problem, "slip=redirect")
        self.assertEqual(proof["witness"]["kind"], "punctured")
        self.assertEqual(self.verdicts([proof, {**proof, "claim": "endless"}]), [True, True])
        whole = copy.deepcopy(proof)
        whole["witness"]["kind"] = "box"
        self.refused([("a sign is not told in a box", whole), *self.altered(proof), *self.altered_box(proof)], 20)

    def test_other_turnings_are_no_fixed_point(self):
        """Of a box whose signs are all told the independent checker knows of no turning with aF = 0."""
        _, box = self.proofs("slip=redirect")
        run = self.run_of(box)
        from check_runs_in_space import Number, turnings_that_end
        witness = box["witness"]
        run.run_until(witness["start"])
        centre = [Number.around(Fraction(c)) for c in witness["centre"]]
        ends = turnings_that_end(run, witness, centre, witness["charts"])
        self.assertFalse(any(ends))

    def refused(self, cases, least):
        self.assertGreater(len(cases), least)
        for (what, _), accepted in zip(cases, self.verdicts([case for _, case in cases])):
            self.assertFalse(accepted, what)

    def test_a_ray_is_accepted_and_refused_where_it_is_altered(self):
        file = self.folder / "ray.json"
        self.succeeds("certify", cli.ROOT / "corpus/space/ray-under-slip-literal.json", "--claim", "ray", "-o", file)
        ray = json.loads(file.read_text())
        kept = json.loads((cli.ROOT / "corpus/space/certificates/ray-under-slip-literal.ray.json").read_text())
        self.assertEqual(ray, kept)
        word = ray["witness"]["word"]

        def with_(what, change):
            other = copy.deepcopy(ray)
            change(other["witness"], other["problem"])
            return what, other

        def put(key, value):
            return with_(f"{key} {value}", lambda witness, _: witness.update({key: value}))

        far = with_("b scaled", lambda _, problem: problem.update(b=[str(8 * Fraction(x)) for x in problem["b"]]))
        self.assertEqual(self.verdicts([ray, put("bits", 128)[1], far[1]]), [True, True, True])
        self.refused([
            put("word", []), put("word", word[:-1]), put("word", [*word, word[-1]]),
            put("word", [word[1], word[0], *word[2:]]), put("word", [*word[:-1], "F1 F1 CF"]), put("word", 7), put("word", [7]),
            put("policy", "slip=redirect"), put("policy", "resume=round,slip=polygon"), put("policy", "nothing"),
            put("bits", 8), put("bits", 5000), put("bits", "384"), put("kind", "states"),
            with_("no bits", lambda witness, _: witness.pop("bits")),
            *(with_(f"b[{k}]", lambda _, problem, k=k: problem["b"].__setitem__(k, "3")) for k in (0, 1)),
            with_("mu", lambda _, problem: problem["contacts"][1].update(mu="1/9")),
            with_("dimension", lambda _, problem: problem.update(dimension=2)),
            with_("kind", lambda _, problem: problem["contacts"][0].update(kind="sliding", slip=["1", "0"])),
        ], 18)

    def test_no_state_twice(self):
        """Of the corpus; refused where it is altered, and where a state is the fixed point, or recurs."""
        problem = cli.ROOT / "corpus/space/no-state-twice.json"
        for policy, name in (("paper", ""), ("slip=redirect", ".slip-redirect")):
            file = self.folder / "endless.json"
            self.succeeds("certify", problem, "--claim", "endless", "--policy", policy, "-o", file)
            endless = json.loads(file.read_text())
            kept = cli.ROOT / f"corpus/space/certificates/no-state-twice.endless{name}.json"
            self.assertEqual(endless, json.loads(kept.read_text()))
        late = copy.deepcopy(endless)  # so late that the period moves it by less than the bits tell
        witness = late["witness"]
        turns = 10
        late["witness"]["start"] += turns * witness["period"]
        steps = witness["word"]
        once = self.steps_of_a_period(endless)
        late["witness"]["word"] = steps + turns * steps[-once:]
        looping = self.certificate(cli.ROOT / "corpus/space/cycle-under-both-slips.json", policy)
        looping["claim"] = "endless"
        self.assertEqual(self.verdicts([endless, {**late, "claim": "cycle"}]), [True, True])
        self.refused([("too late to be told", late), ("a state recurs", looping), *self.altered(endless),
                      *self.altered_box(endless)], 20)
        self.assertIn("witness.start", cli.run("check", self.folder / "0.json").out)

    def steps_of_a_period(self, proof):
        """How many of the steps of the word are of its last period."""
        run = self.run_of(proof)
        run.run_until(proof["witness"]["start"])
        return len(proof["witness"]["word"]) - run.on_step.done

    def test_a_run_that_ends_or_loops_has_no_ray(self):
        ray, loop = (cli.ROOT / f"corpus/space/{name}.json" for name in ("ray-under-slip-literal", "cycle-under-both-slips"))
        for problem, policy, certified in ((ray, "slip=redirect", None), (loop, "paper", "cycle")):
            done = cli.run("certify", problem, "--claim", "ray", "--policy", policy, "-o", self.folder / "none.json", "--json")
            answer = done.json()
            self.assertEqual((answer["state"], answer["claim"], done.code), ("disproved", certified, 0 if certified else 1))

    def test_numbers_of_the_independent_checker_enclose(self):
        """All small ends, rounded to eighths; and a sign or an inverse that these do not tell is refused."""
        sys.path.insert(0, str(cli.ROOT / "certify"))
        from check_runs_in_space import Number, Unsure, distance, sign
        Number.bits = 3
        unit, ends = Fraction(1, 8), [(a, a + length) for a in range(-8, 9) for length in (0, 1, 5)]

        def holds(number, *values):
            for x in values:
                self.assertTrue(number.low * unit <= x <= number.high * unit, (number.low, number.high, x))

        for a, b in ends:
            x, apart = Number(a, b), not a <= 0 <= b
            told = [(lambda: sign(x), apart or a == b == 0), (x.inverse, apart), (x.root, a > 0 or a == b == 0)]
            for what, known in told:
                if not known:
                    self.assertRaises(Unsure, what)
            if apart:
                self.assertEqual(sign(x), 1 if a > 0 else -1)
                holds(x.inverse(), 1 / (a * unit), 1 / (b * unit))
            if a > 0:
                root = x.root()
                self.assertTrue((root.low * unit)**2 <= a * unit and b * unit <= (root.high * unit)**2)
            self.assertEqual(distance(Fraction(0), (a, b)), max(abs(a), abs(b)) * unit)
            for c, d in ends:
                y = Number(c, d)
                holds(x * y, *(u * v * unit**2 for u in (a, b) for v in (c, d)))
                holds(x - y, (a - d) * unit, (b - c) * unit)
            side = Number.side(0, 1, a * unit, Fraction(5, 16))
            for t in (-1, 0, 1):
                at = a * unit + t * Fraction(5, 16)
                holds(side * side - side, at * at - at)

    def test_states_of_a_box_that_are_not_of_their_sets_are_refused(self):
        """By the independent checker, of points far from the box; of others all that the sets keep holds."""
        kept_one = cli.ROOT / "corpus/space/certificates/no-state-twice.endless.json"  # one contact in CF
        for proof in (self.proofs("slip=redirect")[1], json.loads(kept_one.read_text())):
            run = self.run_of(proof)
            from check_runs_in_space import Number, Unsure
            run.run_until(proof["witness"]["start"])
            refused = kept = 0
            for k in range(-64, 65):
                try:
                    state = run.standing([Number.around(Fraction(k, 16))], proof["witness"]["charts"], None)
                except Unsure:
                    refused += 1
                    continue
                kept += 1
                for i, row in enumerate(run.space.first):
                    fN, fx, fy = (x.low for x in state.f[row:row + 3])
                    self.assertGreaterEqual({"C": fN, "NC": state.a[row].low}.get(state.N[i], 0), 0)
                    if state.F[i] == "CF":
                        self.assertLess(fx**2 + fy**2, (float(run.space.mu[i].low) / 2**Number.bits * fN)**2)
            self.assertGreater(min(refused, kept), 10)

    def test_conditions_of_a_punctured_box_by_themselves(self):
        """Of the independent checker: each is refused where the checker is told that it does not hold."""
        problem = self.folder / "punctured.json"
        problem.write_text(json.dumps(PUNCTURED))
        proof = self.certificate(problem, "slip=redirect")
        self.run_of(proof)
        import check_runs_in_space as checker
        from certificate_reader import Rejected, check
        from check_runs import CLAIMS
        image, name_of_line, ends = checker.image, checker.Run.name_of_line, checker.turnings_that_end

        def of_any_slope(*given):
            found, ends, begins = image(*given)
            for aside, *_ in ends.turnings:
                aside.slopes = aside.slopes and [(min(a, -b), max(b, -a)) for a, b in aside.slopes]
            return found, ends, begins

        self.assertIn("punctured", check(proof, CLAIMS))
        fixed = "but at the fixed point"
        for place, name, told, reason in (
                (checker, "turnings_that_end", lambda *given: [False for _ in ends(*given)], fixed),
                (checker, "turnings_that_end", lambda *_: [], "which contacts turn away"),
                (checker, "image", of_any_slope, fixed),
                (checker.Run, "name_of_line", lambda *given: (name_of_line(*given)[0], 1), fixed)):
            with self.subTest(name=name, reason=reason), mock.patch.object(place, name, told):
                self.assertRaisesRegex(Rejected, reason, check, proof, CLAIMS)
        boxed = self.folder / "box.json"
        boxed.write_text(json.dumps(IN_A_BOX))
        several = self.certificate(boxed, "rezero=continue,slip=redirect")
        self.assertEqual(len(several["witness"]["radii"]), 2)
        several["witness"]["kind"] = "punctured"
        self.assertRaisesRegex(Rejected, "1 in a punctured box", check, several, CLAIMS)

    def run_of(self, proof):
        """The run of a certificate, of the independent checker."""
        sys.path.insert(0, str(cli.ROOT / "certify"))
        from certificate_reader import read_problem
        from check_runs import read_policy
        from check_runs_in_space import SWITCHES, Number, Run, Space, Stated
        witness = proof["witness"]
        Number.bits = witness["bits"]
        return Run(Space(read_problem(proof["problem"])), read_policy(witness["policy"], switches=SWITCHES),
                   Stated(witness["word"]))

    def test_a_box_that_the_period_leaves_is_refused(self):
        """Around the state at start, and too small to hold the point that the period comes near to."""
        _, box = self.proofs("slip=redirect")
        witness, run = box["witness"], self.run_of(box)
        run.run_until(witness["start"])
        here = [Fraction(x.low + x.high, 2 << witness["bits"]) for x in run.coordinates(witness["charts"])]
        apart = [abs(x - Fraction(c)) for x, c in zip(here, witness["centre"])]
        self.assertGreater(min(apart), 0)
        witness["centre"], witness["radii"] = list(map(str, here)), [str(x / 4) for x in apart]
        self.assertEqual(self.verdicts([box]), [False])
        self.assertIn("as far as the period leads", cli.run("check", self.folder / "0.json").out.replace("\n ", ""))

    def test_words_of_loops_are_explained(self):
        """What check and replay print of them, by the table of words."""
        words = {name for row in json.loads(self.succeeds("words", "--json").out) for name in row["word"].split(", ")}
        for proof in self.proofs("paper"):
            self.verdicts([proof])
            kind = f"kind {proof['witness']['kind']}"
            self.assertIn(kind, " ".join(cli.run("check", self.folder / "0.json").out.split()))
            self.assertIn(kind, words)
        self.assertLessEqual({"kind punctured", "endless", "turns away"}, words)
        turning = self.folder / "punctured.json"
        turning.write_text(json.dumps(PUNCTURED))
        said = cli.run("replay", turning, "--policy", "slip=redirect", "--max-drives", "4").out
        self.assertIn("turns away", " ".join(said.split()))

    def test_other_contacts_are_refused_by_name(self):
        file = self.folder / "bilateral.json"
        unit = [[str(int(i == j)) for j in range(4)] for i in range(4)]
        file.write_text(json.dumps({**IN_A_BOX, "contacts": [{"kind": "bilateral"}, {"kind": "static", "mu": "3"}],
                                    "A": unit, "b": ["-1", "-1", "0", "1"]}))
        self.refuses("certify", file, "--claim", "cycle", "-o", self.folder / "c.json",
                     says=["a bilateral or sliding contact", "frictionless and static"])


if __name__ == "__main__":
    cli.main()
