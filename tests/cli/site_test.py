# SPDX-License-Identifier: Apache-2.0
"""./run site: its links are whole, nothing foreign is asked for, what is quoted is what the sources say, and a browser
shows it. What is pasted is read as it was typed, and what the page says of A and b is what the program says.

site_test.py PATH_TO_STICTION [SOURCES]
"""

import html.parser
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from urllib.parse import unquote

import cli
from viewer_test import Packages

BUILD = cli.ROOT / "reports/site/build.py"
SOURCES = cli.ROOT / "reports/web/src"


def build(*words):
    return subprocess.run(["/usr/bin/python3", BUILD, cli.program, *map(str, words)], capture_output=True, text=True,
                          timeout=900)


def node(module, code, given):
    """What a function of a page's source says of each of a list: `code` takes `x`."""
    program = (f"import * as m from {json.dumps((SOURCES / module).as_uri())};\n"
               "import {readFileSync} from 'node:fs';\n"
               "const said = x => { try { return " + code + "; } catch (error) { return error.message; } };\n"
               "console.log(JSON.stringify(JSON.parse(readFileSync(0, 'utf8')).map(said)));")
    done = subprocess.run(["node", "--input-type=module", "-e", program], input=json.dumps(given), capture_output=True,
                          text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


class Page(html.parser.HTMLParser):
    """Where a page leads, what it loads, and the names in it."""

    def __init__(self, text):
        super().__init__()
        self.leads, self.loads, self.names = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names |= {given[key] for key in ("id", "name") if given.get(key)}
        if tag == "a" and given.get("href"):
            self.leads.append(given["href"])
        if tag == "link" and given.get("href"):
            self.loads.append(given["href"])
        if tag != "a" and given.get("src"):
            self.loads.append(given["src"])


@unittest.skipIf(cli.SHORT, "pages are the same in every build")
class Site(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = tempfile.TemporaryDirectory(prefix="stiction-site-")
        cls.addClassCleanup(cls.made.cleanup)
        cls.site = Path(cls.made.name, "site")
        done = build("-o", cls.site)
        if done.returncode != 0:
            raise AssertionError(f"found {done.stderr}; expected python3-markdown: apt-get install python3-markdown")
        cls.pages = {path: Page(path.read_text()) for path in cls.site.rglob("*.html")}

    def test_there_are_all_parts(self):
        names = {path.relative_to(self.site).as_posix() for path in self.pages}
        self.assertLessEqual({"index.html", "gallery.html", "paste.html", "theorem.html", "report/index.html",
                              "docs/index.html", "docs/words.html", "docs/cli/tour.html", "docs/solver/c/index.html",
                              "docs/python/index.html", "docs/corpus/formats/problems.html"}, names)
        self.assertEqual(len([name for name in names if name.startswith("play/")]), 12)

    def test_links_are_whole(self):
        count = 0
        for path, page in self.pages.items():
            for address in page.leads + page.loads:
                if re.match(r"(https?|mailto|data):", address):
                    continue
                file, _, anchor = unquote(address).partition("#")
                target = (path.parent / file).resolve() if file else path
                count += 1
                with self.subTest(page=path.relative_to(self.site).as_posix(), leads_to=address):
                    self.assertTrue(target.is_file(), "no such file")
                    if anchor and target.suffix == ".html" and not anchor.startswith("step-"):
                        self.assertIn(anchor, self.pages[target].names)
        self.assertGreater(count, 1500)

    def test_nothing_is_loaded_from_elsewhere(self):
        for path, page in self.pages.items():
            for address in page.loads:
                self.assertNotRegex(address, r"^(\w+:)?//", path)
        for path in self.site.rglob("*.css"):
            self.assertNotRegex(path.read_text(), r"url\(|@import", path)

    def test_the_statement_in_coq_is_that_of_the_sources(self):
        text = html.unescape((self.site / "theorem.html").read_text())
        quoted = re.search(r"<pre[^>]*><code>(.*?)</code></pre>", text, re.S)[1]
        sources = "".join((cli.ROOT / "certify/coq/existence" / name).read_text()
                          for name in ("Law.v", "Statement.v", "Theorems.v"))
        parts = quoted.split("\n\n")
        self.assertEqual(parts[-1], "Theorem coulomb_solution_exists : coulomb_has_a_solution.")
        for part in parts:
            self.assertIn(part, sources)
            self.assertRegex(part, r"(?s)^(Definition|Theorem) .*\.$")

    def test_no_heading_of_two_ids(self):
        for path in self.site.glob("*.html"):
            ids = re.findall(r'\sid="([^"]+)"', path.read_text().split("<script")[0])
            self.assertEqual(len(ids), len(set(ids)), path)

    def test_a_folder_of_something_else_is_left_alone(self):
        (self.folder / "theirs").mkdir()
        theirs = self.file("theirs/thesis", "mine")
        done = build("-o", theirs.parent)
        self.assertEqual(done.returncode, 1)
        self.assertIn("expected a new or empty folder", done.stderr)
        self.assertEqual([path.name for path in theirs.parent.iterdir()], ["thesis"])

    def test_in_a_browser(self):
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        self.assertIsNotNone(browser, "expected a browser: apt-get install chromium")
        script = Path(__file__).with_name("site_browser.mjs")
        done = subprocess.run(["node", "--test", script], capture_output=True, text=True, timeout=900, env=dict(
            os.environ, PAGES=str(self.site), PACKAGES=str(Packages.get()), BROWSER=browser))
        self.assertEqual(done.returncode, 0, done.stdout[-8000:] + done.stderr[-2000:])
        self.assertGreaterEqual(int(re.search(r"^(?:#|ℹ) pass (\d+)$", done.stdout, re.M)[1]), 18)


@unittest.skipIf(cli.SHORT, "pages are the same in every build")
class Pasted(cli.TestCase):
    def files(self, *texts):
        """Of each A with b and mu."""
        given = [dict({"b": "1 2", "mu": "1", "dimension": ""}, A=text) for text in texts]
        return node("pasted.js", "m.fileOfPasted(x)", given)

    def test_every_form_is_read_and_no_digit_lost(self):
        rows = [["0.10000000000000000555", "-3"], ["-3", "1/7"]]
        forms = (
            "0.10000000000000000555 -3\n-3 1/7",
            "[[0.10000000000000000555 -3.]\n [-3.  1/7]]",
            "array([[0.10000000000000000555, -3.], [-3., 1/7]], dtype=float64)",
            "0.10000000000000000555,-3\n-3,1/7\n",
            "0.10000000000000000555 \u22123; -3 1/7",
            "%%MatrixMarket matrix array real symmetric\n% said\n2 2\n.10000000000000000555\n-3\n1/7\n",
            "%%MatrixMarket matrix array real general\n2 2\n0.10000000000000000555\n-3\n-3\n1/7\n",
            "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 .10000000000000000555\n1 2 -3\n2 1 -3\n"
            "2 2 1/7\n",
            "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n2 2 1/7\n2 1 -3\n1 1 +0.10000000000000000555\n",
        )
        for form, said in zip(forms, self.files(*forms)):
            self.assertEqual(json.loads(said), {"A": rows, "b": ["1", "2"], "mu": "1"}, form)

    def test_a_whole_problem_is_left_as_it_is(self):
        text = '{"A": [[2, 0], [0, 3.0]], "b": [-1, 1e0], "mu": "0.10"}'
        self.assertEqual(self.files(text), [text])

    def test_what_cannot_be_read_is_said(self):
        refused = {
            "": "A: found nothing, expected numbers",
            "1 x\n2 3": "A: found x, expected a number",
            "1 nan\n2 3": "A: found nan, expected a number",
            "1 2 3\n4 5 6": "A: found 2 rows of 3 numbers, expected as many rows",
            "1": "b: found 2 numbers, expected 1, one for each row of A",
            "1 2\n3": "A: found 1 numbers in row 2, expected 2",
            "[[1. 2. ... 3.]]": "A: found ..., where numpy leaves numbers out",
            "%%MatrixMarket matrix coordinate pattern general\n2 2 1\n1 1": "A: found %%MatrixMarket matrix coordinate",
            "%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n": "A: found 3 numbers, expected 4",
            "%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 5\n": "A: found an entry in row 3, column 1",
            "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 5\n": "A: found 3 numbers after its sizes",
        }
        for (text, start), said in zip(refused.items(), self.files(*refused)):
            self.assertTrue(said.startswith(start), f"{text}: {said}")

    def test_what_holds_of_a_and_b_is_what_the_program_says(self):
        names = ("cycle-every-policy-mu-1", "cycle-of-a-block-in-a-valley", "no-solution-scripted-wedge",
                 "smallest-integers", "no-solution-zero-matrix", "frictionless-cycle-without-symmetry",
                 "statically-indeterminate", "range-hypothesis-not-necessary", "scripted-wedge-below-critical-mu",
                 "rod-static-above-critical-mu")
        saddle = self.file("saddle.json", dict(cli.SOLVED, A=[["0", "1"], ["1", "0"]]))
        negative = self.file("negative.json", dict(cli.SOLVED, A=[["2", "1/3"], ["1/3", "1/19"]]))
        files = [*(cli.ROOT / f"corpus/{name}.json" for name in names), saddle, negative]
        problems = [json.loads(self.succeeds("import", file, "-o", "-").out) for file in files]
        expected = []
        for said in cli.run("survey", *files, "--json").json():
            symmetric = said["asymmetry"]["difference"] == 0
            semidefinite = said["curvature"]["psd"] if symmetric else None
            expected.append({"isSymmetric": symmetric, "isSemidefinite": semidefinite,
                             "isInRange": said["range"]["in-range"] if semidefinite else None})
        self.assertEqual(node("hypotheses.js", "m.hypotheses(x.A, x.b)", problems), expected)
        self.assertEqual({said["isInRange"] for said in expected}, {True, False, None})
        self.assertEqual({said["isSemidefinite"] for said in expected}, {True, False, None})


if __name__ == "__main__":
    cli.main()
