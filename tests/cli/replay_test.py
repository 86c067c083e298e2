# SPDX-License-Identifier: Apache-2.0
"""stiction replay: what is printed of a run, in the plane and in space, is what the run did."""

import json
import re
from fractions import Fraction
from xml.etree import ElementTree

import cli

SPACE = cli.ROOT / "corpus" / "space"

# x to 1, where ax = 0; y until 1 + fy^2 = (5/4)^2.
CIRCLE = {
    "format": "stiction-problem", "version": 1, "name": "circle", "dimension": 3,
    "contacts": [{"kind": "static", "mu": "5/4"}],
    "A": [["2", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]], "b": ["-2", "-1", "-1"],
}


def numbers(values):
    return [Fraction(x) for x in values]


def accelerations(problem, f):
    return [sum(Fraction(x) * y for x, y in zip(row, f)) + Fraction(b) for row, b in zip(problem["A"], problem["b"])]


class Plane(cli.TestCase):
    def test_steps_add_up_from_the_forces_before_the_first_drive(self):
        replay = self.succeeds("replay", self.file("p.json", cli.REFERENCE), "--step", "--json", code=1).json()
        f = numbers(replay["initial"]["f"])
        self.assertEqual(f, [0] * 4)
        for pivot in replay["pivots"]:
            f = [x + Fraction(pivot["step"]) * y for x, y in zip(f, numbers(pivot["df"]))]
            self.assertEqual(numbers(pivot["f"]), f)
            self.assertEqual(numbers(pivot["a"]), accelerations(cli.REFERENCE, f))
        self.assertEqual(numbers(replay["f"]), f)

    def test_a_ray_shows_its_direction(self):
        problem = dict(cli.SOLVED, A=[["1", "-1"], ["-1", "1"]], b=["-1", "0"])
        file = self.file("p.json", problem)
        self.assertEqual(self.succeeds("replay", file, "--json", code=1).json()["ray"], ["1", "1"])
        self.assertIn("no limit to the step along df = (1, 1)", self.succeeds("replay", file, code=1).out)

    def test_rounded_numbers_are_replayed_and_a_suspicion_is_run_again(self):
        replay = self.succeeds("replay", self.file("p.json", cli.REFERENCE), "--arithmetic", "double", "--json",
                               code=1).json()
        self.assertEqual((replay["outcome"], replay["arithmetic"]), ("cycle", "exact"))
        self.assertEqual(replay["suspected"]["outcome"], "cycle")
        replay = self.succeeds("replay", self.file("p.json", cli.SOLVED), "--arithmetic", "double", "--json").json()
        self.assertEqual((replay["outcome"], replay["arithmetic"]), ("solved", "double"))
        self.refuses("replay", self.file("p.json", cli.SOLVED), "--arithmetic", "double", "--all-policies",
                     says=["double", "exact"])


class ForPeople(cli.TestCase):
    def test_a_step_by_step_replay_begins_with_the_problem_and_ends_with_its_words(self):
        file = self.file("p.json", cli.REFERENCE)
        out = self.succeeds("replay", file, "--step", code=1).out
        rows = {line.split()[0]: line.split()[1:] for line in out.splitlines() if line.startswith("    a_")}
        self.assertEqual([rows[f"a_{name}"] for name in ("N1", "F1", "N2", "F2")],
                         [row + [b] for row, b in zip(cli.REFERENCE["A"], cli.REFERENCE["b"])])
        self.assertIn("contact 1 mu = 1, contact 2 mu = 1", out)
        self.assertLess(out.index("a_F2"), out.index("Drive 1"))
        words = out[out.index("The words"):]
        for word in ("N1", "CF", "NC+", "given up", "cycle"):
            self.assertRegex(words, rf"(?m)^  ([^ ].*, )?{re.escape(word)} ")
        for word in ("fold", "ray", "NCF", "singular", "cell"):
            self.assertNotRegex(words, rf"(?m)^  {word} ")
        complete = self.succeeds("replay", file, "--method", "complete", "--step").out
        self.assertIn("is driven", complete)
        words = complete[complete.index("The words"):]
        for word in ("stage", "cell, cells"):
            self.assertRegex(words, rf"(?m)^  {word} ")
        self.assertIn("contact 1 from B (breaks) to + (at its upper limit); a fold", " ".join(complete.split()))
        lemke = self.succeeds("replay", file, "--method", "lemke", "--step").out
        words = " ".join(lemke[lemke.index("The words"):].split())
        for name in set(re.findall(r"(\S+) (?:enters,|leaves)", lemke)):
            of_contact_1 = name if name == "z0" else re.sub("[0-9]$", "1", name)
            self.assertRegex(words, rf" {re.escape(of_contact_1)}[ ,]")
        for method in ("baraff", "complete", "lemke"):  # a line for each step has letters, and says who explains them
            short = cli.run("replay", file, "--method", method).out
            self.assertTrue(short.endswith("(--step: the problem, all forces, and what the words mean)\n"), short)
        self.assertNotRegex(words, r"(?m)^  drive ")
        loop = self.succeeds("replay", SPACE / "cycle-under-both-slips.json", "--step").out
        self.assertLess(loop.index("over intervals, proved"), loop.index("The words"))

    def test_the_state_that_recurs_is_marked_where_it_stands(self):
        file = cli.ROOT / "corpus" / "cycle-every-policy-mu-1.json"
        run = self.succeeds("replay", file, "--json", "--step").json()
        for style in ((), ("--step",)):
            out = self.succeeds("replay", file, *style).out
            parts = out.split("----\n")
            self.assertEqual(len(parts), 3)
            drives = [pivot["drive"] for pivot in run["pivots"]]
            told = [len(re.findall(r"(?m)^  s = " if style else r"(?m)^ +\d+ +\d+ ", part)) for part in parts]
            self.assertEqual(told, [drives.count(1) + drives.count(2), len(drives) - told[0], 0])
        forces = [re.findall(r"(?m)^    f = .*\n    C = .*", part)[-1] for part in parts[:2]]
        self.assertEqual(forces[0], forces[1])
        self.assertNotIn("----", self.succeeds("replay", self.file("s.json", cli.SOLVED), "--step").out)

    def test_long_fractions_are_rounded_unless_asked_for(self):
        problem = dict(cli.SOLVED, A=[[3.1, 0.1], [0.1, 3.1]], b=[-1.7, 0.3])
        file = self.file("p.json", problem)
        for verb in ("replay", "solve"):
            words = (verb, file) + (("--step",) if verb == "replay" else ())
            short, full = self.succeeds(*words).out, self.succeeds(*words, "--fractions").out
            self.assertNotRegex(short, r"\d{8}/\d")
            self.assertRegex(full, r"\d{8}/\d")
            self.assertRegex(short, r"~\d\.\d+")
        self.assertRegex(self.succeeds("replay", file, "--step").out, r"a_N1 +3\.1 +0\.1 +-1\.7\n")
        self.assertIn(str(Fraction(3.1)), self.succeeds("replay", file, "--step", "--fractions").out)

    def test_an_answer_is_a_sentence_and_a_table_without_json(self):
        for name, begins in [("cycle-every-policy-mu-1", "solved: these forces meet every condition, (15) and (16), exactly"),
                             ("no-solution-zero-matrix", "no-solution: no forces meet all conditions, proved")]:
            for method in ((), ("--method", "baraff"), ("--arithmetic", "double")):
                out = cli.run("solve", cli.ROOT / "corpus" / f"{name}.json", *method).out
                self.assertNotRegex(out, r'["{}]')
                if not method:
                    self.assertTrue(out.startswith(begins), out)
        out = self.succeeds("solve", cli.ROOT / "corpus" / "cycle-every-policy-mu-1.json").out
        f = dict(re.findall(r"(?m)^  ([NF]\d) +(\S+) ", out))
        self.assertEqual(f, {"N1": "1/3", "F1": "1/3", "N2": "2/3", "F2": "2/3"})

    def test_an_answer_claims_no_more_than_was_shown(self):
        space, plane = SPACE / "three-sliding-contacts.json", cli.ROOT / "corpus" / "cycle-every-policy-mu-1.json"
        for words, code, says in [
                ((space, "--law", "coulomb", "--method", "complete"), 0, "Coulomb's law within"),
                ((space, "--law", "baraff", "--method", "complete"), 0, "(21) and (22), which leave the direction of slip free, exactly"),
                ((plane, "--arithmetic", "filtered"), 0, "forces within these bounds meet every condition, (15) and (16), proved"),
                ((plane, "--arithmetic", "filtered", "--method", "baraff"), 1, "5 drives later, for ever"),
                ((plane, "--method", "fast"), 0, "but for errors of at most"),
                ((SPACE / "cycle-under-both-slips.json", "--method", "baraff", "--arithmetic", "double"), 1,
                 "cycle: after rounding, ")]:
            first = self.succeeds("solve", *words, code=code).out.splitlines()[0]
            self.assertIn(says, first)
            self.assertEqual("exactly" in first, says.endswith("exactly"))

    def test_modes_and_facts_are_words_without_json(self):
        corpus = cli.ROOT / "corpus"
        out = self.succeeds("certify", corpus / "three-solutions-one-contact.json", "--all").out
        self.assertEqual(out.splitlines(), ["3 of the contact modes have solutions, with 3 distinct witnesses (4 linear programs)",
                                            "  break: f = (0, 0)", "  stick: f = (3, -2)", "  slip+: f = (1, -1)"])
        for words in (("certify", corpus / "two-contact-cycle.json", "--safe"),
                      ("check", corpus / "certificates" / "counterexample.json")):
            self.assertNotRegex(self.succeeds(*words).out, r'["{}]')


class Moving(cli.TestCase):
    SCENE = cli.ROOT / "corpus/scenes/block-in-a-valley.json"

    def test_the_picture_of_the_readme_is_made_by_a_command(self):
        out = self.folder / "loop.svg"
        self.succeeds("replay", self.SCENE, "--svg", out, code=1)
        self.assertEqual(out.read_text(), self.SCENE.with_name("block-in-a-valley-loop.svg").read_text())

    def test_each_step_of_the_period_is_seen_and_no_two_at_once(self):
        out = self.folder / "loop.svg"
        self.succeeds("replay", self.SCENE, "--svg", out, code=1)
        replay = cli.run("replay", self.SCENE, "--step", "--json").json()
        period = [pivot for pivot in replay["pivots"] if pivot["drive"] > replay["start"]]
        svg = "{http://www.w3.org/2000/svg}"
        seen, arrows = [], []
        for group in ElementTree.parse(out).iter(f"{svg}g"):
            for animate in group.findall(f"{svg}animate"):
                times = [float(time) for time in animate.get("keyTimes").split(";")] + [1]
                values = animate.get("values").split(";")
                at = values.index("visible")
                seen.append((times[at], times[at + 1]))
                arrows.append(len(group.findall(f"{svg}line")))
        self.assertEqual(len(seen), len(period))
        for (_, end), (begin, _) in zip(seen, seen[1:] + [(1, 1)]):
            self.assertAlmostEqual(end, begin, 4)
        contacts = [{i // 2 for i, f in enumerate(pivot["f"]) if f != "0"} for pivot in period]
        self.assertEqual(arrows, [len(touched) for touched in contacts])

    def test_what_has_no_picture_is_refused(self):
        out = self.folder / "loop.svg"
        self.refuses("replay", self.file("p.json", cli.REFERENCE), "--svg", out, says=["--svg", "a scene", "--html"])
        self.refuses("replay", self.SCENE, "--all-policies", "--svg", out, says=["--svg", "one policy"])
        self.assertFalse(out.exists())


class Space(cli.TestCase):
    def replay(self, file, *more, code=0):
        return self.succeeds("replay", file, "--step", "--json", *more, code=code).json()

    def near(self, found, expected):
        self.assertEqual(len(found), len(expected))
        for x, y in zip(found, expected):
            self.assertAlmostEqual(x, y, places=9)

    def test_sets_and_recorded_directions_of_every_step(self):
        for arithmetic in ["double", "quad"]:
            replay = self.replay(self.file("p.json", CIRCLE), "--arithmetic", arithmetic)
            normal, x, y = replay["pivots"]
            self.assertEqual([p["driven"] for p in replay["pivots"]], ["N1", "F1x", "F1y"])
            self.assertEqual([p["to"] for p in replay["pivots"]], ["C", "CF", "NCF"])
            self.assertEqual([p["sets"]["F1"] for p in replay["pivots"]], ["none", "half", "NCF"])
            self.near(x["df"], [0, 1, 0])
            self.near(y["f"], [1, 1, 0.75])
            self.near(y["a"], [0, 0, -0.25])
            self.assertEqual(x["recorded"], {})
            self.near(y["recorded"]["F1"], [0.8, 0.6])
            self.assertEqual((replay["outcome"], replay["arithmetic"]), ("solved", arithmetic))

    def test_the_text_of_a_run(self):
        out = self.succeeds("replay", self.file("p.json", CIRCLE), "--step").out
        for line in ["f = 0, a = b = (-2, -1, -1); all sets are empty (4.3).",
                     "Drive 1: N1. a_N1 = -2 < 0: increase f_N1 until it is 0 (4.1).",
                     "Drive 2: F1x. Until a_F1x = 0 or abs(f_F1) = mu f_N1 (5.6); f_F1 changes along (1, 0).",
                     "  s = 1: a_F1x = 0, which is kept; y follows",
                     "abs(f_F1) = mu f_N1; the drive ends, F1 joins NCF along (0.8, 0.6)",
                     "    C = {N1}  NC = {}  CF = {}  NCF = {F1 along (0.8, 0.6)}"]:
            self.assertIn(line, out)
        table = self.succeeds("replay", self.file("p.json", CIRCLE)).out
        self.assertEqual(len([line for line in table.splitlines() if "establish" in line]), 3)

    def test_a_loop_is_said_to_be_no_proof_and_a_ray_shows_its_direction(self):
        cycle = SPACE / "cycle-under-both-slips.json"
        replay = self.replay(cycle)  # as the file expects
        self.assertEqual((replay["outcome"], replay["start"], replay["period"]), ("cycle", 7, 6))
        drives = {pivot["drive"]: pivot["f"] for pivot in replay["pivots"]}
        self.near(drives[7], drives[13])
        self.assertIn("this is no proof", self.succeeds("replay", cycle).out)
        ray = SPACE / "ray-under-slip-literal.json"
        replay = self.replay(ray)
        self.assertEqual((replay["outcome"], len(replay["ray"])), ("ray", 6))
        self.assertIn("no limit to the step along df = (", self.succeeds("replay", ray).out)
        redirected = self.replay(ray, "--policy", "slip=redirect")
        self.assertEqual(redirected["outcome"], "solved")
        self.assertTrue(any(pivot.get("turned_away") for pivot in redirected["pivots"]))

    def test_hinges_are_held_and_sliding_friction_follows(self):
        contacts = [{"kind": "bilateral"}, {"kind": "sliding", "mu": "1", "slip": ["3/5", "4/5"]}]
        problem = dict(CIRCLE, contacts=contacts, b=["-3", "-3", "1", "2"],
                       A=[["1", "0", "0", "0"], ["0", "4", "2", "0"], ["0", "2", "4", "1"], ["0", "0", "1", "3"]])
        file = self.file("p.json", problem)
        replay = self.replay(file)
        self.near(replay["initial"]["f"], [3, 0, 0, 0])
        self.assertEqual([(p["driven"], p["limiting"]) for p in replay["pivots"]], [("N2", "N2")])
        self.near(replay["pivots"][0]["df"], [0, 1, -0.6, -0.8])
        self.assertEqual(replay["pivots"][0]["sets"], {"N1": "C", "N2": "C", "F2": "none"})
        out = self.succeeds("replay", file).out
        self.assertIn("Contact 1 is bilateral: N1 stays in C, a_N1 = 0 (4.5).", out)
        self.assertIn("Contact 2 slides: f_F2 = -1 (3/5, 4/5) f_N2 (24).", out)

    def test_every_policy_that_is_built(self):
        replay = self.succeeds("replay", SPACE / "cycle-under-both-slips.json", "--all-policies", "--json",
                               code=1).json()
        self.assertEqual(sum(replay["counts"].values()), 768)
        self.assertEqual(len(replay["policies"]), 768)
        for policy in ["paper", "slip=redirect"]:
            self.assertEqual(replay["policies"][policy], {"outcome": "cycle", "start": 7, "period": 6})
        self.assertNotIn("file=yes", replay["policies"])

    def test_complete_driving_exactly(self):
        file = SPACE / "fold-and-descent-two-contacts.json"
        problem = json.loads(file.read_text())
        replay = self.succeeds("replay", file, "--method", "complete", "--step", "--json").json()
        f = numbers(replay["initial"]["f"])
        for piece in replay["pivots"]:
            f = [x + Fraction(piece["step"]) * y for x, y in zip(f, numbers(piece["df"]))]
            self.assertEqual(numbers(piece["f"]), f)
        self.assertEqual(numbers(replay["f"]), f)
        self.assertEqual(replay["word"], "I I")
        self.assertEqual(accelerations(problem, f), [0] * 6)
        events = " ".join(piece["event"] for piece in replay["pivots"])
        self.assertEqual((events.count("a fold"), events.count("a descent")), (2, 1))
        out = self.succeeds("replay", file, "--method", "complete", "--step").out
        self.assertIn("Piece 1: N2 is driven, cells B ?, determinant > 0", out)
        self.assertIn("cells I I", out)

    def test_what_is_not_built_is_refused(self):
        file = self.file("p.json", CIRCLE)
        self.refuses("replay", file, "--arithmetic", "exact", says=["exact", "double"])
        self.refuses("replay", file, "--policy", "file=yes", says=["file=yes", "slip=redirect"])
        self.refuses("replay", file, "--method", "complete", "--all-policies", says="--method baraff")
        self.refuses("replay", file, "--method", "complete", "--sides", "6", says="multiple of 4")
        self.refuses("replay", self.file("p.json", cli.REFERENCE), "--method", "complete", "--policy", "scan=highest",
                     says=["--policy scan=highest", "--method baraff"])


if __name__ == "__main__":
    cli.main()
