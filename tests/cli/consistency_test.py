# SPDX-License-Identifier: Apache-2.0
"""What `explain`, `survey`, `certify` and `solve` say of one problem is the same."""

import json

import cli

CORPUS = cli.ROOT / "corpus"
FILES = sorted([*CORPUS.glob("*.json"), *CORPUS.glob("sliding/*.json"), *CORPUS.glob("space/*.json"),
                *CORPUS.glob("scenes/*.json")])
SAMPLE = cli.share(FILES, 4)
ASSUMPTIONS = {"symmetric": lambda entry: entry["asymmetry"]["difference"] == 0,
               "psd": lambda entry: entry["curvature"]["psd"], "in-range": lambda entry: entry["range"]["in-range"]}


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(each) for key, each in value.items() if key not in ("seconds", "file", "name")}
    return [without_times(each) for each in value] if isinstance(value, list) else value


class Consistency(cli.TestCase):
    def said(self, verb, *words):
        """None where it is refused."""
        done = cli.run(verb, *words, "--json", cwd=self.folder, timeout=600)
        self.assertIn(done.code, (0, 1, 2, 3), (verb, words, done.err))
        return json.loads(done.out) if done.code != 2 else None

    def test_all_facts_of_a_problem(self):
        count = 0
        for file in SAMPLE:
            explained = self.said("explain", file)
            if explained is None:  # a scene of several problems, or one in which nothing touches
                continue
            count += 1
            with self.subTest(file=file.name):
                surveyed, = self.said("survey", file)
                self.assertEqual(without_times(explained["survey"]), without_times(surveyed))
                solved = self.said("solve", file)
                self.assumptions(file, surveyed, solved)
                self.ends(file, explained, solved)
                self.claims(file, explained)
                self.safety(file, explained)
                self.modes(file, explained)
        self.assertGreater(count, len(SAMPLE) // 2)

    def assumptions(self, file, surveyed, solved):
        failed = {each["assumption"] for each in solved["assumptions"]}
        for claim, fact in ASSUMPTIONS.items():
            holds = fact(surveyed)
            if holds is None:
                continue
            self.assertEqual(claim in failed, not holds, claim)
            certified = self.said("certify", file, "--claim", claim, "-o", "c.json")
            if certified is not None:  # of an asymmetric A psd is no claim
                self.assertEqual(certified["state"], "proved" if holds else "disproved", claim)

    def ends(self, file, explained, solved):
        if "methods" not in explained:
            return
        self.assertEqual((explained["solve"]["outcome"], explained["solve"].get("unique_accelerations")),
                         (solved["outcome"], solved.get("unique_accelerations")))
        for run in explained["methods"]:
            alone = self.said("solve", file, "--method", run["method"])
            self.assertEqual((run["method"], run["outcome"], run.get("reason")),
                             (run["method"], alone["outcome"], alone.get("reason")))
        # Nothing is solved that has no solution, and the other way round.
        existence = next(each for each in explained["claims"] if each["claim"] == "existence")
        if solved["outcome"] in ("solved", "no-solution"):
            self.assertNotEqual(existence["state"], "disproved" if solved["outcome"] == "solved" else "proved")

    def claims(self, file, explained):
        for claim in explained.get("claims", []):
            policy = claim["command"].partition(" --policy ")[2].split(" ")[0] or "paper"
            certified = self.said("certify", file, "--claim", claim["claim"], "--policy", policy.strip("'"), "-o", "c.json")
            if certified is None or "out of linear programs" in claim["says"]:
                continue  # too dear for the checkers, or for a word of explanation
            self.assertEqual((claim["claim"], claim["state"], claim["certificate"]),
                             (claim["claim"], certified["state"], certified["claim"]))

    def safety(self, file, explained):
        if "safety" not in explained:
            return
        done = cli.run("certify", file, "--safe")
        self.assertEqual(explained["safety"], self.said("certify", file, "--safe"))
        sentence = cli.unwrapped(done.out.splitlines()[0])
        self.assertIn(f"A is {sentence}", cli.unwrapped(cli.run("explain", file).out))

    def modes(self, file, explained):
        if "solutions" not in explained or not explained["solutions"]["complete"]:
            return
        listed = self.said("certify", file, "--all")
        words = listed["words"]
        self.assertEqual(explained["solutions"]["modes"], [word["modes"] for word in words])
        unique = listed["distinct_witnesses"] == 1 and all(word["unique"] for word in words)
        self.assertEqual(explained["solutions"]["unique"], unique)

    def test_newtons_method_in_bodies_has_the_factors_of_a_scene_and_of_a_file(self):
        for name in ("stack", "card-pair-stands", "incline-rests"):
            scene = CORPUS / f"scenes/{name}.json"
            exported = self.folder / "p.json"
            self.succeeds("assemble", scene, "--factors", "-o", exported)
            for file in (scene, exported):
                with self.subTest(file=file.name):
                    explained = self.said("explain", file)
                    run, = [each for each in explained["methods"] if each["method"] == "newton-bodies"]
                    self.assertEqual((run["outcome"], run.get("reason")), ("solved", None))
                    self.assertTrue(explained["survey"]["curvature"]["psd"])
                    alone = self.said("solve", file, "--method", "newton-bodies")
                    self.assertEqual((alone["outcome"], alone["residual"] < 1e-8), ("solved", True))


if __name__ == "__main__":
    cli.main()
