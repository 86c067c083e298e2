# SPDX-License-Identifier: Apache-2.0
"""search/questions.md: every question names a campaign that is read, every campaign names its questions in its note,
which reports tell; what was tried speaks of these questions."""

import json
import re

import cli

FOLDER = cli.ROOT / "search"
PAGE = FOLDER / "questions.md"
ROW = re.compile(r"(?m)^\| `([\w-]+)` \| (.+) \| (.+) \| \[([\w-]+)\]\(([^)]+)\)(.*) \| (.+) \|$")
STATUS = re.compile(r"(open|settled|refuted)\b.*: \[[^\]]+\]\(([^)]+)\)")
VALLEY = "cycle-2c-5d-14s-b25341001876a8e6"  # the group of corpus/cycle-of-a-block-in-a-valley.json


class Questions(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text, tried = PAGE.read_text().split("<!-- figures: questions -->")
        cls.tried = re.findall(r"(?m)^\| `([\w-]+)` \|", tried)
        cls.rows = ROW.findall(cls.text)
        cls.by_campaign = {}
        for name, *_, campaign, _, _, _ in cls.rows:
            cls.by_campaign.setdefault(campaign, []).append(name)

    def test_every_row_is_read(self):
        self.assertEqual(len(self.rows), len(re.findall(r"(?m)^\| `", self.text)))
        self.assertGreater(len(self.rows), 20)
        names = [row[0] for row in self.rows]
        self.assertEqual(len(names), len(set(names)))

    def test_a_status_is_a_word_and_where_that_is_shown(self):
        for name, *_, status in self.rows:
            with self.subTest(question=name):
                found = STATUS.match(status)
                self.assertTrue(found, status)
                self.assertTrue((FOLDER / found[2]).is_file(), found[2])
        self.assertEqual({STATUS.match(row[-1])[1] for row in self.rows}, {"open", "settled", "refuted"})

    def test_every_campaign_is_read_and_names_its_questions(self):
        for name, _, _, campaign, file, *_ in self.rows:
            self.assertEqual(file, f"campaigns/{campaign}.json", name)
        files = {file.stem: file for file in (FOLDER / "campaigns").glob("*.json")}
        self.assertEqual(set(self.by_campaign), set(files))
        for campaign, questions in self.by_campaign.items():
            with self.subTest(campaign=campaign):
                note = json.loads(files[campaign].read_text())["note"]
                self.assertEqual(note, f"asks {', '.join(questions)}: search/questions.md")
                self.succeeds("slurm", files[campaign], "--shards", 1, "--problems", 1000, "-o", self.folder / campaign)

    def test_two_contacts_under_gravity_that_loop_are_found_again_from_nothing(self):
        store = self.folder / "s.store"
        done = self.succeeds("search", FOLDER / "campaigns/two-under-gravity.json", "--problems", 10000, "--finishing", 0,
                             "--store", store)
        self.assertIn("1 of them in the corpus", done.err)
        problem = json.loads(self.succeeds("problem", store, VALLEY, "-o", "-").out)
        self.assertEqual(len(problem["contacts"]), 2)
        file = self.file("p.json", problem)
        self.assertIn("for ever", self.succeeds("replay", file, code=1).out)

    def test_a_campaign_with_a_wrong_word_is_refused(self):
        campaign = json.loads((FOLDER / "campaigns/safe-ties.json").read_text())
        for key, value in (("policies", ["drop=everything"]), ("contact", [2]), ("generators", ["tiny"])):
            self.refuses("slurm", self.file("c.json", {**campaign, key: value}), "--shards", 1, "--problems", 1000,
                         "-o", self.folder / "out", says=[key])

    def test_a_report_names_the_questions(self):
        campaign = json.loads((FOLDER / "campaigns/safe-ties.json").read_text())
        store, report = self.folder / "s.store", self.folder / "report"
        small = self.file("c.json", {**campaign, "unit_problems": 40})
        self.succeeds("search", small, "--problems", 40, "--finishing", 0, "--store", store)
        self.succeeds("report", store, "-o", report)
        for text in (self.succeeds("report", store, "--text").out, (report / "index.html").read_text()):
            for question in self.by_campaign["safe-ties"]:
                self.assertIn(question, text)

    def test_what_was_tried_is_of_these_questions(self):
        names = [row[0] for row in self.rows]
        self.assertGreater(len(self.tried), 10)
        self.assertEqual(self.tried, [name for name in names if name in self.tried])


if __name__ == "__main__":
    cli.main()
