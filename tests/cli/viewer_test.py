# SPDX-License-Identifier: Apache-2.0
"""The pages are joined of modules that keep to themselves, and, at night, a browser shows what the program found.

viewer_test.py PATH_TO_STICTION [SOURCES]

What needs npm's packages is SKIPPED, with its reason, where npm reaches no registry. Without npm, nodejs or chromium,
all of which `./run test` installs, it fails.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import cli
from viewer_data_test import PAGES, arguments

WEB = "reports/web"
sys.path.insert(0, str(cli.ROOT / WEB))
import join  # noqa: E402

UNREACHABLE = re.compile(r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ENETUNREACH|EHOSTUNREACH|"
                         r"ERR_SOCKET_TIMEOUT|FETCH_ERROR")


class Packages:
    """A folder with the packages of the pages' lock file."""

    folder = None

    @classmethod
    def get(cls):
        if cls.folder is None:
            if shutil.which("npm") is None:
                raise AssertionError("expected npm: apt-get install npm")
            cls.folder = Path(tempfile.mkdtemp(prefix="stiction-web-"))
            for name in ("package.json", "package-lock.json", ".npmrc"):
                shutil.copy(cli.ROOT / WEB / name, cls.folder)
            cls.install()
        return cls.folder

    @classmethod
    def install(cls):
        done = subprocess.run(["npm", "ci", "--ignore-scripts", "--fetch-retries=1", "--fetch-retry-mintimeout=1000",
                               "--fetch-timeout=60000"], cwd=cls.folder, capture_output=True, text=True, timeout=600)
        if done.returncode != 0 and UNREACHABLE.search(done.stderr):
            print("SKIPPED: the browser: npm reaches no registry here")
            raise unittest.SkipTest("npm reaches no registry")
        if done.returncode != 0:
            raise AssertionError(f"npm ci: {done.stderr}")

    @classmethod
    def remove(cls):
        if cls.folder is not None:
            shutil.rmtree(cls.folder, ignore_errors=True)


unittest.addModuleCleanup(Packages.remove)


@unittest.skipIf(cli.SHORT, "pages are the same in every build")
class Joined(cli.TestCase):
    def files(self, **texts):
        for name, text in texts.items():
            self.file(f"{name}.js", text)
        return self.folder / "main.js"

    def test_a_module_keeps_to_itself_and_gives_what_it_exports(self):
        main = self.files(
            deep="const own = 1;\nexport const shared = own + 1;\nexport function twice(x) {\n  return 2 * x;\n}\n",
            side="import * as d from './deep.js';\nconst own = 10;\nexport class Side {\n  sum = own + d.shared;\n}\n",
            vendored="const $a = 5;\nexport {$a as five};\n",
            main="import {\n  shared,\n  twice as double\n} from './deep.js';\nimport {Side} from './side.js';\n"
                 "import {five} from './vendored.js';\nconst own = 100;\n"
                 "console.log(own, shared, double(4), new Side().sum, five);\n")
        script = join.Joined(main)
        self.assertEqual([file.stem for file in script.inputs], ["main", "deep", "side", "vendored"])
        done = subprocess.run(["node", "--input-type=module", "-e", script.text], capture_output=True, text=True)
        self.assertEqual(done.stdout, "100 2 8 12 5\n", done.stderr)

    def test_a_name_of_its_own_is_none_of_what_it_imports(self):
        main = self.files(main="import * as all from './other.js';\nconst f = (end) => [...end, all.end];\n",
                          other="export const end = 1;\n")
        self.assertIn("[...end, all.end]", join.Joined(main).text)

    def test_what_it_would_join_wrongly_is_refused_with_file_and_line(self):
        ends = "export const end = 1;\n"
        for main, other, line in (
                ("import {end} from './other.js';\n", "import {x} from './main.js';\n" + ends, "other.js:1: found a circle"),
                ("\nimport {gone} from './other.js';\n", ends, "main.js:2: ./other.js does not export gone"),
                ("import {end} from './nowhere.js';\n", ends, "main.js:1: found no ./nowhere.js"),
                ("import {end} from './other.js';\n", "// One.\nexport let end = 1;\n", "other.js:2: expected a form of export"),
                ("import end from './other.js';\n", ends, "main.js:1: expected a form of import"),
                ("import * as all from './other.js';\n\nconst x = {...end};\n", ends, "main.js:3: end is all.end here"),
                ("const page = '</script>';\n", ends, "main.js: found </script")):
            with self.subTest(line), self.assertRaises(SystemExit) as refused:
                join.Joined(self.files(main=main, other=other))
            self.assertTrue(str(refused.exception).startswith(f"{self.folder}/{line}"), refused.exception)

    def test_a_formula_without_its_mathml_is_refused(self):
        web = self.folder / WEB
        shutil.copytree(cli.ROOT / WEB, web, ignore=shutil.ignore_patterns("node_modules"))
        (self.folder / "solver").symlink_to(cli.ROOT / "solver")
        self.assertIn("<msub><mi>f</mi><mi>N</mi></msub>", join.page("viewer", web)[0])
        page = web / "src/viewer.html"
        page.write_text(page.read_text() + "\\(e^x\\)")
        with self.assertRaises(SystemExit) as refused:
            join.page("viewer", web)
        self.assertIn(r"formulas.json has no MathML of \(e^x\)", str(refused.exception))

    def test_a_module_may_be_an_object(self):
        self.file("cells.json", '{"S": "sticks", "+": "slips"}')
        joined = join.Joined(self.files(main="import * as does from './cells.json';\nimport {S} from './cells.json';\n"))
        self.assertIn('= {"S": "sticks", "+": "slips"};', joined.text)
        self.assertEqual(joined.text.count("sticks"), 1)
        with self.assertRaises(SystemExit):
            join.Joined(self.files(main="import {B} from './cells.json';\n"))

    def test_the_packages_are_those_of_the_lock_file_which_names_no_address(self):
        lock = json.loads((cli.ROOT / WEB / "package-lock.json").read_text())["packages"]
        for name, package in lock.items():
            self.assertNotIn("resolved", package, name)
            self.assertTrue(name == "" or package["integrity"].startswith("sha512-"), name)
        for name, version in (lock[""]["dependencies"] | lock[""]["devDependencies"]).items():
            self.assertRegex(version, r"^\d+\.\d+\.\d+$", name)
        held = re.findall(r"^(\S+) (\d+\.\d+\.\d+)\n\n", (cli.ROOT / WEB / "vendor/plot.LICENSES.txt").read_text(), re.M)
        self.assertIn("@observablehq/plot", dict(held))
        for name, version in held:
            self.assertEqual(version, lock[f"node_modules/{name}"]["version"], f"{name}: ./vendor.sh makes it anew")


@unittest.skipUnless(cli.ALL, "long")
class Browser(cli.TestCase):
    def test_in_a_browser(self):
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        self.assertIsNotNone(browser, "expected a browser: apt-get install chromium")
        packages = Packages.get()
        at_rest = self.file("problem.json", dict(cli.SOLVED, b=["1", "0"]))  # no step at all
        for name, words in [*PAGES.items(), ("at-rest", [at_rest.as_posix()]),
                            ("large", ["corpus/safe-cycle-8-contacts.json"])]:
            done = cli.run("replay", *arguments(words), "--html", self.folder / f"{name}.html", "--step", "--json")
            self.assertIn(done.code, (0, 1), done.err)
            (self.folder / f"{name}.json").write_text(done.out)
        script = Path(__file__).with_name("viewer_browser.mjs")
        done = subprocess.run(["node", "--test", script], capture_output=True, text=True, timeout=900, env=dict(
            os.environ, PAGES=str(self.folder), PACKAGES=str(packages), BROWSER=browser,
            PROGRAM=cli.program))
        self.assertEqual(done.returncode, 0, done.stdout[-8000:] + done.stderr[-2000:])
        passed = re.search(r"^# pass (\d+)$|^ℹ pass (\d+)$", done.stdout, re.M)
        self.assertGreaterEqual(int(passed[1] or passed[2]), 10, done.stdout[-2000:])


if __name__ == "__main__":
    cli.main()
