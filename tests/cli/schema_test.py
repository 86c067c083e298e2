# SPDX-License-Identifier: Apache-2.0
"""Every verb has --json and a schema; the schemas tell a changed answer. Every answer that a test has is held against
them when the test ends (cli.py)."""

import copy
import json
import re
import subprocess

import cli


def validated(answers):
    """Of pairs of a verb and its answer: the exit code, and a line for each that is wrong."""
    done = subprocess.run(["/usr/bin/python3", cli.ROOT / "cli/validate.py", cli.program], input=json.dumps(answers), text=True,
                          capture_output=True)
    return done.returncode, done.stderr


class Schemas(cli.TestCase):
    def test_every_verb_has_json_and_a_schema(self):
        verbs = json.loads(self.succeeds("manual", "--json").out)
        for verb in verbs:
            names = [name for row in verb["words"] for name in row["names"]]
            self.assertIn("--json", names, verb["verb"])
        self.assertEqual(set(self.schemas()), {verb["verb"] for verb in verbs} | {"campaign"})

    def schemas(self):
        """By verb, as the program writes them."""
        self.succeeds("manual", "--schemas", self.folder / "schemas")
        return {file.name.split(".")[0]: json.loads(file.read_text()) for file in (self.folder / "schemas").glob("*.schema.json")}

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
        """One process judges all: beside what an answer lacks or has too much, its verb."""
        answers = list(self.answers())
        self.assertEqual(validated([[verb, json.dumps(answer)] for verb, answer in answers]), (0, ""))
        for change in ("more", "less"):
            changed = []
            for verb, answer in copy.deepcopy(answers):
                first = answer[0] if isinstance(answer, list) else answer
                if change == "more":
                    first["unknown"] = 1
                else:
                    del first[next(iter(first))]
                changed.append([verb, json.dumps(answer)])
            code, says = validated(changed)
            self.assertEqual(code, 1)
            refused = [line.split(":")[0] for line in says.splitlines()]
            self.assertEqual(refused, [verb for verb, _ in changed], change)

    def test_text_that_is_no_json_is_refused(self):
        for text in ("", "{", '{"a": NaN}', "solved"):
            code, says = validated([["solve", text]])
            self.assertEqual(code, 1)
            self.assertRegex(says, "^solve: ")
        self.assertRegex(validated([["xyzzy", "{}"]])[1], "xyzzy: has no schema")

    def test_names_of_tables_are_those_of_the_program(self):
        shapes = self.schemas()["solve"]["$defs"]
        methods = [row["name"] for row in self.succeeds("methods", "--json").json()]
        self.assertEqual(shapes["method"]["enum"], [*methods, "auto"])
        self.assertEqual(shapes["answer"]["properties"]["why"],
                         {"type": "string", "description": "why `auto` chose this method"})

    def test_campaign_files_fit_theirs(self):
        files = list((cli.ROOT / "search/campaigns").glob("*.json"))
        self.assertGreater(len(files), 10)
        self.assertEqual(validated([["campaign", file.read_text()] for file in files]), (0, ""))
        for member in ('"audit_every": 0', '"audits": 1', '"generators": []', '"arithmetic": "float"'):
            code, says = validated([["campaign", '{"format": "stiction-campaign", "version": 1, %s}' % member]])
            self.assertEqual(code, 1, member)

    def test_a_schema_stands_by_itself(self):
        for verb, schema in self.schemas().items():
            self.assertEqual(schema["title"], "stiction-campaign" if verb == "campaign" else f"stiction {verb} --json")
            for reference in re.findall(r'"\$ref": "([^"]*)"', json.dumps(schema)):
                self.assertIn(reference.removeprefix("#/$defs/"), schema["$defs"], verb)


if __name__ == "__main__":
    cli.main()
