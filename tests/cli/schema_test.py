# SPDX-License-Identifier: Apache-2.0
"""Every verb has --json and a schema; the schemas tell a changed answer. Every answer that a test has is held against
them when the test ends (cli.py)."""

import copy
import json
import re
import subprocess

import cli

SCHEMAS = "cli/schemas"


def validated(answers):
    done = subprocess.run(["/usr/bin/python3", cli.ROOT / SCHEMAS / "validate.py"], input=json.dumps(answers), text=True,
                          capture_output=True)
    return done.returncode, done.stderr


class Schemas(cli.TestCase):
    def test_every_verb_has_json_and_a_schema(self):
        verbs = json.loads(self.succeeds("manual", "--json").out)
        for verb in verbs:
            names = [name for row in verb["words"] for name in row["names"]]
            self.assertIn("--json", names, verb["verb"])
        files = {file.name.split(".")[0] for file in (cli.ROOT / SCHEMAS).glob("*.schema.json")}
        self.assertEqual(files, {verb["verb"] for verb in verbs} | {"shared"})

    def answers(self):
        problem, scene = cli.ROOT / "corpus/two-contact-cycle.json", cli.ROOT / "corpus/scenes/two-towers.json"
        store, here = self.folder / "s.store", self.folder
        self.succeeds("search", "--generator", "small", "--contacts", 2, "--problems", 3000, "--store", store)
        self.succeeds("search", "--generator", "small", "--contacts", 2, "--seed", 2, "--problems", 3000, "--store", here / "2.store")
        for words, code in [(("report", store, here / "2.store"), 0), (("report", store, "-o", here / "report"), 0),
                            (("report", store, "--text"), 0), (("solve", problem), 0), (("replay", problem, "--step"), 0), (("status", store), 0),
                            (("replay", problem, "--method", "complete"), 0), (("replay", problem, "--all-policies"), 0),
                            (("certify", problem, "-o", here / "c.json"), 0), (("check", here / "c.json"), 0),
                            (("certify", problem, "--safe"), 0), (("minimize", problem, "-o", here / "m.json"), 0),
                            (("merge", here / "merged.store", store), 0), (("problem", store, 0, 0, "-o", here / "p.json"), 0),
                            (("records",), 0), (("survey", problem), 0), (("policies",), 0), (("methods",), 0), (("words",), 0),
                            (("export", problem, "-o", here / "x.dat", "--format", "siconos-fc"), 0),
                            (("import", here / "x.dat", "-o", here / "y.json"), 0), (("draw", scene, "-o", here / "d.svg"), 0),
                            (("assemble", scene, "-o", here / "a.json", "--explain"), 0),
                            (("simulate", scene, "-o", here / "sim", "--seconds", "0.02", "--no-svg"), 0),
                            (("slurm", cli.ROOT / "search/campaigns/scenes.json", "--shards", 2, "--problems", 100_000_000,
                              "-o", here / "jobs"), 0)]:
            yield words[0], self.succeeds(*words, "--json", code=code, cwd=cli.ROOT).json()

    def test_a_changed_answer_is_refused(self):
        for verb, answer in self.answers():
            with self.subTest(verb=verb):
                self.assertEqual(validated([[verb, json.dumps(answer)]]), (0, ""))
                changed = copy.deepcopy(answer)
                first = changed[0] if isinstance(changed, list) else changed
                first["unknown"] = 1
                code, says = validated([[verb, json.dumps(changed)]])
                self.assertEqual(code, 1)
                self.assertRegex(says, f"^{verb}: [$]")
                for key in [key for key in first if key != "unknown"][:1]:
                    changed = copy.deepcopy(answer)
                    first = changed[0] if isinstance(changed, list) else changed
                    del first[key]
                    self.assertEqual(validated([[verb, json.dumps(changed)]])[0], 1, f"{verb} without {key}")

    def test_text_that_is_no_json_is_refused(self):
        for text in ("", "{", '{"a": NaN}', "solved"):
            code, says = validated([["solve", text]])
            self.assertEqual(code, 1)
            self.assertRegex(says, "^solve: ")
        self.assertRegex(validated([["xyzzy", "{}"]])[1], "xyzzy: has no schema")

    def test_schemas_refer_to_nothing_elsewhere(self):
        for file in (cli.ROOT / SCHEMAS).glob("*.schema.json"):
            for reference in re.findall(r'"\$ref": "([^"]*)"', file.read_text()):
                self.assertRegex(reference, r"^(shared\.schema\.json)?#/\$defs/\w+$")


if __name__ == "__main__":
    cli.main()
