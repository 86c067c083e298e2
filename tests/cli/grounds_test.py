# SPDX-License-Identifier: Apache-2.0
"""certify/grounds.md: each claim of the first page and of existence.md has an id and a row that says what it rests on;
what the row names is there, theorems among those that Coq proves, certificates accepted by the checkers."""

import json
import re
import subprocess
import sys

import cli

FOLDER = cli.ROOT / "certify"
COQ = FOLDER / "coq"
PAGES = {"README": cli.ROOT / "README.md", "existence": FOLDER / "existence.md"}
ROW = re.compile(r'(?m)^\| <a id="([\w-]+)"></a>`([\w-]+)` \| (.+) \| ([\w, ]+) \| (.+) \|$')
USE = re.compile(r"grounds\.md#([\w-]+)\)")
LINK = re.compile(r"\[([^\]]+)\]\(([^)#]+)\)")
GROUNDS = ("Coq", "certificate", "proof", "campaign", "measurement", "test", "literature")
OF_RUNS = ("cycle", "counterexample")  # what certify/check_runs.py reads
OF = {"counterexample": "cycle-every-policy-mu-1"}  # certificates that are not called as their problem


def proved():
    """The theorems that `./run prove` prints, as FOLDER/FILE.v and name."""
    text = (COQ / "prove.py").read_text()
    return {(f"{folder}/{file}.v", name) for folder, file, name in re.findall(r'\("(\w+)\.(\w+)\.(\w+)", ', text)}


class Grounds(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = (FOLDER / "grounds.md").read_text()
        cls.rows = ROW.findall(cls.text)

    def links(self, ground):
        """What the rows name as this ground: id, text of the link, path."""
        for name, _, _, _, cell in self.rows:
            for part in cell.split("; "):
                kind, what = part.split(": ", 1)
                if kind == ground:
                    for text, path in LINK.findall(what):
                        yield name, text.strip("`"), (FOLDER / path).resolve()

    def test_every_row_is_read_and_no_id_stands_twice(self):
        self.assertEqual(len(self.rows), len(re.findall(r"(?m)^\| <a", self.text)))
        self.assertGreater(len(self.rows), 25)
        names = [row[0] for row in self.rows]
        self.assertEqual(names, [row[1] for row in self.rows])
        self.assertEqual(len(names), len(set(names)))

    def test_ids_and_rows_are_the_same_both_ways(self):
        for page, file in PAGES.items():
            with self.subTest(page=page):
                here = {row[0] for row in self.rows if page in row[3].split(", ")}
                self.assertEqual(set(USE.findall(file.read_text())), here)
        self.assertLessEqual({page for row in self.rows for page in row[3].split(", ")}, set(PAGES))

    def test_every_answer_and_every_line_of_the_table_of_laws_has_an_id(self):
        for page, head in (("README", "| question | answer |"), ("existence", "| law | hypothesis |")):
            table = PAGES[page].read_text().split(head)[1].split("\n\n")[0].splitlines()[2:]
            self.assertGreater(len(table), 3)
            for line in table:
                self.assertRegex(line, USE, page)

    def test_a_row_names_grounds_and_what_shows_them(self):
        for name, _, _, _, cell in self.rows:
            for part in cell.split("; "):
                with self.subTest(id=name, ground=part):
                    self.assertIn(part.split(": ")[0], GROUNDS)
                    self.assertTrue(LINK.search(part))
        explained = re.findall(r"(?m)^\| (\w+) \| ", self.text.split("| id |")[0])
        self.assertEqual(explained, ["ground", *GROUNDS])
        for ground in GROUNDS:
            found = list(self.links(ground))
            self.assertTrue(found, ground)
            for name, _, path in found:
                self.assertTrue(path.is_file(), f"{name}: {path}")

    def test_theorems_stand_in_their_files_and_are_proved(self):
        theorems = proved()
        self.assertGreater(len(theorems), 20)
        for name, theorem, path in self.links("Coq"):
            with self.subTest(id=name, theorem=theorem):
                self.assertRegex(path.read_text(), rf"(?m)^Theorem {theorem}\b")
                self.assertIn((path.relative_to(COQ).as_posix(), theorem), theorems)

    def test_certificates_are_accepted_by_the_checkers(self):
        for name, _, path in self.links("certificate"):
            with self.subTest(id=name, certificate=path.name):
                stated = json.loads(path.read_text())["claim"]
                of = f"{OF.get(path.stem, path.stem.split('.')[0])}.json"
                [problem] = [file for file in (path.parents[1] / of, path.parents[1] / "sliding" / of) if file.is_file()]
                self.assertIn(f".{stated}.json" if path.stem != "counterexample" else "counterexample", path.name)
                self.assertIn("accepted", self.succeeds("check", path, "--problem", problem).out)
                for checker in ("check_certificate.py", *(["check_runs.py"] if stated in OF_RUNS else [])):
                    done = subprocess.run([sys.executable, FOLDER / checker, path, "--problem", problem], capture_output=True,
                                          text=True)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_measurements_and_campaigns_are_those_of_the_repository(self):
        for ground in ("campaign", "measurement"):
            for name, _, path in self.links(ground):
                self.assertIn(path.parent.relative_to(cli.ROOT).as_posix(), ("reports/measured", "tests/setup"), name)


if __name__ == "__main__":
    cli.main()
