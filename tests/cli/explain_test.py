# SPDX-License-Identifier: Apache-2.0
"""Explain from outside: what it says of a problem is what the other verbs say, and what it tells to type works."""

import json
import os
import shlex
import unittest.mock

import cli

CORPUS = cli.ROOT / "corpus"


class Explain(cli.TestCase):
    def explained(self, file, *options):
        return self.succeeds("explain", file, "--json", *options, cwd=self.folder).json()

    def said(self, file):
        return " ".join(self.succeeds("explain", file, cwd=self.folder).out.split())

    def test_what_a_loop_is_said_to_do_is_what_a_replay_does(self):
        loop = CORPUS / "two-contact-cycle.json"
        found = self.explained(loop)
        replayed = cli.run("replay", loop, "--json").json()
        told = found["policies"]["loops"]
        self.assertEqual((told["policy"], told["proved"]), ("paper", True))
        self.assertEqual((told["start"], told["period"]), (replayed["start"], replayed["period"]))
        counts = cli.run("replay", loop, "--all-policies", "--json").json()["counts"]
        self.assertEqual((found["policies"]["outcomes"], found["policies"]["all"]), (counts, sum(counts.values())))
        words = cli.run("certify", loop, "--all", "--json").json()["words"]
        self.assertEqual(found["solutions"], {"complete": True, "modes": [word["modes"] for word in words], "unique": True})
        self.assertEqual((found["kinds"], found["mu"], found["rank"]), ({"static": 2}, ["1", "1"], 4))
        ends = {run["method"]: run["outcome"] for run in found["methods"]}
        self.assertEqual((ends["baraff"], ends["complete"], ends["lemke"]), ("cycle", "solved", "solved"))
        said = self.said(loop)
        for part in ("Yes, by a theorem (certify/existence.md), for every mu", "meets the paper's assumptions: A is symmetric",
                     "Its forces are the only ones", "A is unsafe: the determinant of a word is negative", "it is safe below 1/3",
                     "Under paper the state after 3 drives recurs 4 drives later, for ever"):
            self.assertIn(part, said)

    def test_every_command_that_it_names_works(self):
        for name in ("two-contact-cycle", "cycle-under-some-policies-a", "space/cycle-under-both-slips"):
            file = self.file("problem.json", (CORPUS / f"{name}.json").read_text())
            found = self.explained(file)
            self.assertTrue(any(claim["certificate"] for claim in found["claims"]))
            for claim in found["claims"]:
                done = cli.run(*shlex.split(claim["command"])[1:], cwd=self.folder)
                without = 3 if claim["state"] == "not decided" else 1
                self.assertEqual(done.code, 0 if claim["certificate"] else without, claim["command"] + done.err)
                if claim["certificate"]:
                    certificate = self.folder / claim["command"].split()[-1]
                    self.assertEqual(json.loads(certificate.read_text())["claim"], claim["certificate"])
                    self.succeeds("check", certificate, "--problem", file)
            for each in found["next"]:
                done = cli.run(*shlex.split(each["command"])[1:], cwd=self.folder)
                self.assertIn(done.code, (0, 1, 3), each["command"] + done.err)

    def test_whether_there_is_a_solution(self):
        self.assertIn("No: that no forces meet all conditions is proved.", self.said(CORPUS / "no-solution-scripted-wedge.json"))
        beyond = self.said(CORPUS / "range-hypothesis-not-necessary.json")
        self.assertIn("b is not in the range of A", beyond)
        self.assertIn("Forces that meet every condition are found, exactly.", beyond)
        self.assertNotIn("by a theorem", self.said(CORPUS / "sliding/rod-with-two-solutions.json"))
        cube = self.said(CORPUS / "space/cube-slides-on-four-corners.json")
        self.assertIn("4 contacts in space: 4 static", cube)
        self.assertIn("Yes, by a theorem (certify/existence.md), for every mu", cube)
        several = self.explained(CORPUS / "nine-solutions-two-contacts.json")["solutions"]
        self.assertEqual((len(several["modes"]), several["unique"]), (9, False))

    def test_a_scene_and_what_is_symmetric_but_for_rounding(self):
        self.assertIn("in the plane", self.said(CORPUS / "scenes/incline-rests.json"))
        rough = {**cli.SOLVED, "A": [["2", "1/1000"], ["0", "3"]]}
        said = self.said(self.file("rough.json", rough))
        self.assertIn("does not meet the paper's assumptions: A is not symmetric.", said)
        self.assertIn("With (A + A')/2 in place of A it meets the paper's assumptions", said)

    def test_it_fits_the_terminal_and_names_each_certificate_once(self):
        with unittest.mock.patch.dict(os.environ, COLUMNS="60"):
            lines = self.succeeds("explain", CORPUS / "two-contact-cycle.json").out.splitlines()
        for line in lines:
            self.assertTrue(len(line) <= 60 or line.startswith("    stiction ") or " " not in line, line)
        for name in ("existence", "psd", "safe", "cycle"):
            self.assertEqual(sum(line.startswith((f"  {name}:", f"  {name},")) for line in lines), 1, name)

    def test_a_large_problem_is_surveyed_alone(self):
        size = 60
        rows = [["2" if i == j else "0" for j in range(size)] for i in range(size)]
        file = self.file("large.json", {**cli.SOLVED, "contacts": [{"kind": "frictionless"}] * size, "A": rows, "b": ["-1"] * size})
        found = self.explained(file)
        self.assertEqual(set(found), {"file", "kinds", "diagonal", "survey", "next"})
        self.assertEqual(found["diagonal"], ["2", "2"])
        self.assertIn("60 contacts in the plane: 60 frictionless", self.said(file))


if __name__ == "__main__":
    cli.main()
