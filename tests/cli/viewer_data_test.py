# SPDX-License-Identifier: Apache-2.0
"""The page of a replay holds what the program found, in the words of --step and the numbers of --json."""

import html
import json
import re
import subprocess

import cli

LOOP = "corpus/cycle-every-policy-mu-1.json"
# Page -> the arguments of its replay.
PAGES = {
    "loop": [LOOP],
    "scene": ["corpus/scenes/block-in-a-valley.json"],
    "policy": ["corpus/cycle-or-singular-by-policy.json", "--policy", "give-up=second,ties=contacts"],
    "space": ["corpus/space/cycle-under-both-slips.json"],
    "sliding": ["corpus/sliding/cycle-beside-a-sliding-contact.json"],
    "frictionless": ["corpus/exponential-pivots-5-frictionless.json"],
    "lemke": [LOOP, "--method", "lemke"],
    "complete": [LOOP, "--method", "complete"],
    "scene-in-space": ["corpus/scenes/space/tripod.json"],
}


def arguments(words):
    return [cli.ROOT / word if word.startswith("corpus/") else word for word in words]


def data_of(page):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)[1])


class Data(cli.TestCase):
    def page(self, *words):
        out = self.folder / "page.html"
        done = cli.run("replay", *arguments(words), "--html", out)
        self.assertIn(done.code, (0, 1), done.err)
        return data_of(out.read_text())

    def replay(self, *words):
        done = cli.run("replay", *arguments(words), "--step", "--json")
        self.assertIn(done.code, (0, 1), done.err)
        return done.json()

    def test_runs_are_those_of_json_and_words_those_of_step(self):
        for name, words in PAGES.items():
            with self.subTest(name):
                run = self.page(*words)["runs"][0]
                replay = self.replay(*words)
                for key, value in run["replay"].items():
                    self.assertEqual(value, replay[key], key)
                told = cli.run("replay", *arguments(words), "--step", "--fractions").out
                for pivot, step in zip(run["replay"]["pivots"], run["told"], strict=True):
                    for text in (step["why"], step["event"] if "entering" not in pivot else step["label"]):
                        self.assertIn(text, told)

    def test_complete_driving_stands_beside_it(self):
        first, second = self.page(LOOP)["runs"]
        self.assertEqual(second["replay"], {key: self.replay(LOOP, "--method", "complete")[key]
                                            for key in second["replay"]})
        given_up = [k for k, step in enumerate(first["told"]) if step["mark"] == "given up"]
        fold, = [k for k, step in enumerate(second["told"]) if step["mark"] == "fold"]
        self.assertEqual(first["replay"]["pivots"][given_up[0]]["f"], second["replay"]["pivots"][fold]["f"])
        self.assertIn(f"at step {given_up[0] + 1}, the published algorithm gives", second["told"][fold]["event"])
        self.assertEqual(len(self.page(LOOP, "--method", "complete")["runs"]), 1)

    def test_a_loop_is_two_states_that_are_the_same(self):
        for words in ([LOOP], [LOOP, "--policy", "scan=highest"], ["corpus/two-contact-cycle.json"]):
            run = self.page(*words)["runs"][0]
            loop, pivots, told = run["loop"], run["replay"]["pivots"], run["told"]
            self.assertTrue(loop["exact"])
            self.assertEqual(pivots[loop["from"] - 1]["f"], pivots[loop["to"] - 1]["f"])
            self.assertEqual(told[loop["from"] - 1]["sets"], told[loop["to"] - 1]["sets"])
            drives = {pivot["drive"] for pivot in pivots[loop["from"]:loop["to"]]}
            self.assertEqual(len(drives), run["replay"]["period"])
        self.assertIsNone(self.page("corpus/smallest-integers.json", "--method", "complete")["runs"][0]["loop"])

    def test_a_loop_of_rounded_numbers_is_called_none_that_is_proved(self):
        run = self.page("corpus/space/cycle-under-both-slips.json", "--policy", "slip=redirect")["runs"][0]
        self.assertFalse(run["loop"]["exact"])

    def test_a_run_that_is_too_long_for_a_page_is_refused(self):
        endless = ["corpus/endless/without-repetition.json", "--policy", "resume=round"]
        self.refuses("replay", *arguments(endless), "--max-drives", "1500", "--html", "-", says=["--html: found a run of", "at most 3,000"])
        out = self.folder / "page.html"
        self.assertEqual(cli.run("replay", *arguments(endless), "--max-drives", "20", "--html", out).code, 3)
        self.assertIsNone(data_of(out.read_text())["runs"][0]["loop"])

    def test_every_step_that_gives_up_names_the_reading(self):
        policy = "give-up=second,drop=variable"
        told = self.page("corpus/two-contact-cycle.json", "--policy", policy)["runs"][0]["told"]
        given_up = [step for step in told if step["mark"] == "given up"]
        self.assertGreater(len(given_up), 0)
        for step in told:
            named = [(reading["switch"], reading["here"]) for reading in step.get("readings", [])]
            when, along = [("give-up", "second")], [("drop", "variable")]
            expected = when + along * step["moved"].startswith("N") if step["mark"] == "given up" else []
            self.assertEqual(named, expected)

    def test_other_readings_part_where_it_says(self):
        def states(run):
            return [(pivot, step["sets"]) for pivot, step in zip(run["replay"]["pivots"], run["told"])]

        run = self.page("corpus/two-contact-cycle.json")["runs"][0]
        self.assertGreater(len(run["partings"]), 3)
        for parting in run["partings"]:
            policy = f"{parting['switch']}={parting['there']}"
            other = self.page("corpus/two-contact-cycle.json", "--policy", policy)["runs"][0]
            self.assertEqual(other["replay"]["outcome"], parting["outcome"])
            mine, theirs, step = states(run), states(other), parting["step"]
            self.assertEqual(mine[:step], theirs[:step], policy)
            self.assertNotEqual(mine[step], theirs[step], policy)

    def test_a_scene_is_drawn_and_its_forces_point_into_the_body(self):
        data = self.page("corpus/scenes/block-in-a-valley.json")
        assembled = self.folder / "assembled.json"
        self.succeeds("assemble", cli.ROOT / "corpus/scenes/block-in-a-valley.json", "-o", assembled)
        for key in ("A", "b", "contacts"):
            self.assertEqual(data["problem"][key], json.loads(assembled.read_text())[key])
        self.assertTrue(data["picture"]["svg"].startswith("<svg"))
        for contact in data["picture"]["contacts"]:
            normal, tangent = contact["rows"]
            self.assertLess(normal[1], 0)  # the slopes are below; pixels grow downward
            for way in (normal, tangent):
                self.assertAlmostEqual(way[0] ** 2 + way[1] ** 2, 1, places=1)
        self.assertIsNone(self.page(LOOP)["picture"])

    def test_a_problem_shows_its_scene_only_while_it_is_that_of_the_scene(self):
        scene = json.loads((cli.ROOT / "corpus/scenes/block-in-a-valley.json").read_text())
        problem = json.loads((cli.ROOT / "corpus/cycle-of-a-block-in-a-valley.json").read_text())
        problem["scene"] = scene
        self.assertIsNotNone(self.page(self.file("same.json", problem).as_posix())["picture"])
        problem["b"][0] = "-7"
        self.assertIsNone(self.page(self.file("other.json", problem).as_posix())["picture"])
        problem["scene"] = "none"
        self.assertIsNone(self.page(self.file("none.json", problem).as_posix())["picture"])

    def test_a_name_is_text_wherever_it_stands(self):
        name = '{{data}}</title></script><script>alert("1")</script><!-- &'
        out = self.folder / "page.html"
        cli.run("replay", self.file("p.json", dict(cli.SOLVED, name=name)), "--html", out)
        page = out.read_text()
        self.assertEqual(data_of(page)["name"], name)
        self.assertEqual(page.count("<script"), 3)
        self.assertIn("<title>{{data}}&lt;/title&gt;", page)

    def test_standard_output_holds_the_page_alone_and_bad_use_is_refused(self):
        done = cli.run("replay", cli.ROOT / LOOP, "--html", "-")
        self.assertTrue(done.out.startswith("<!DOCTYPE html>") and done.out.endswith("</html>\n"))
        self.refuses("replay", cli.ROOT / LOOP, "--html", "x.html", "--all-policies", says=["--html", "one policy"])
        self.refuses("replay", cli.ROOT / "corpus/scenes/two-towers.json", says=["independent problems", "expected one"])

    def test_the_foot_of_the_page_names_the_command_the_version_and_the_digest(self):
        out = self.folder / "p.html"
        certificate = cli.ROOT / "corpus/certificates/counterexample.json"
        digest = re.search(r"sha256:[0-9a-f]{64}", self.succeeds("check", certificate).out)[0]
        for options in ((), ("--policy", "ties=contacts"), ("--max-drives", "7")):
            cli.run("replay", cli.ROOT / LOOP, *options, "--html", out)
            foot = re.search(r'<footer id="origin">.*?</footer>', out.read_text(), re.S)[0]
            command = html.unescape(re.search(r"<code>(stiction replay .*?) --html OUT</code>", foot)[1]).split()
            self.assertEqual(command, ["stiction", "replay", str(cli.ROOT / LOOP), *options])
            self.assertIn(digest, foot)
            self.assertIn(f"stiction {cli.run('--version').out.split()[1]}<", foot)

    def test_the_examples_are_whole_and_what_they_claim_holds(self):
        """They are of some earlier commit."""
        examples = cli.ROOT / "reports/examples"
        run, complete = data_of((examples / "counterexample.html").read_text())["runs"]
        self.assertEqual((run["replay"]["outcome"], complete["replay"]["outcome"]), ("cycle", "solved"))
        for sums in (examples / "search/SHA256SUMS", examples / "at-rest/SHA256SUMS"):
            done = subprocess.run(["sha256sum", "--check", "--quiet", sums], cwd=sums.parent, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        certificates = sorted(examples.rglob("*.certificate.json"))
        self.assertGreater(len(certificates), 20)
        self.succeeds("check", *certificates)


if __name__ == "__main__":
    cli.main()
