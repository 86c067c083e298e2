# SPDX-License-Identifier: Apache-2.0
"""What stands on a terminal: lines that fit it, help that is found, answers of many files, a store for each search.

terminal_test.py PATH_TO_STICTION
"""

import fcntl
import json
import os
import pty
import re
import shutil
import struct
import subprocess
import tempfile
import termios
import time
import unittest
from pathlib import Path

import cli

CORPUS = cli.ROOT / "corpus"


def in_columns(columns, *words, cwd=None):
    """Standard output of the program where COLUMNS says how wide the terminal is."""
    done = subprocess.run([cli.program, *map(str, words)], text=True, capture_output=True, cwd=cwd, timeout=120,
                          env={**os.environ, "COLUMNS": str(columns)})
    return done.stdout


def on_a_terminal(columns, *words, cwd=None):
    """All that the program writes on a terminal of that width."""
    parent, child = pty.openpty()
    fcntl.ioctl(child, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    running = subprocess.Popen([cli.program, *map(str, words)], stdin=child, stdout=child, stderr=child, cwd=cwd,
                               env=environment)
    os.close(child)
    written = b""
    while True:
        try:
            part = os.read(parent, 65536)
        except OSError:  # the last one has closed it
            break
        if not part:
            break
        written += part
    os.close(parent)
    return running.wait(), written.decode()


@unittest.skipIf(cli.SHORT, "texts are the same in every build")
class Terminal(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = Path(tempfile.mkdtemp(prefix="stiction-terminal-"))
        cls.addClassCleanup(shutil.rmtree, cls.made, ignore_errors=True)
        cls.store = cls.made / "a.store"
        done = cli.run("search", "--store", cls.store, "--problems", 20000, "--seed", 5)
        assert done.code == 0, done.err

    def texts(self):
        """Words of the program, one for each kind of text that it prints."""
        loop, space = CORPUS / "cycle-under-some-policies-a.json", CORPUS / "nine-solutions-two-contacts.json"
        scene = next((CORPUS / "scenes").rglob("*.json"))
        yield from (("help",), ("methods",), ("policies",), ("words",), ("records",), ("status", self.store),
                    ("report", self.store, "--text"), ("survey", CORPUS / "space"), ("survey", loop),
                    ("solve", loop, space), ("solve", loop, "-a", "double"), ("solve", loop, "--fractions"),
                    ("replay", loop), ("replay", loop, "--step"), ("replay", loop, "--all-policies", "--list"),
                    ("replay", loop, "--method", "complete", "--step"), ("certify", loop, "--all"),
                    ("certify", loop, "--safe"), ("certify", loop, "-o", self.made / "c.json"),
                    ("check", self.made / "c.json"), ("minimize", loop, "-o", self.made / "m.json"),
                    ("assemble", scene, "-o", self.made / "s.json", "--explain"))
        for verb in cli.run("manual", "--json").json():
            yield ("help", verb["verb"])

    def test_no_line_is_wider_than_the_terminal(self):
        for words in self.texts():
            for columns in (60, 80, 132):
                with self.subTest(words=" ".join(map(str, words)), columns=columns):
                    text = in_columns(columns, *words, cwd=cli.ROOT)
                    self.assertNotEqual(text, "")
                    for line in text.splitlines():
                        # What has no blank cannot be broken: a path, a signature, a fraction; nor are commands.
                        torn = (len(line) > columns and re.search(r"\S \S", line.strip()[:columns])
                                and not line.startswith("    stiction "))
                        self.assertFalse(torn, line)

    def test_a_terminal_is_asked_how_wide_it_is(self):
        for columns in (60, 100):
            code, text = on_a_terminal(columns, "report", self.store, "--text")
            self.assertEqual(code, 0)
            text = re.sub(r"\r\x1b\[K\[[^\r\n]*", "", text).replace("\x1b[K", "")  # without progress
            widest = max(len(line) for line in text.replace("\r", "").split("\n")
                         if " " in line.strip() and not line.startswith("    stiction "))
            self.assertLessEqual(widest, columns)
            self.assertGreater(widest, columns - 20)

    def test_a_refusal_fits_the_terminal_and_is_one_line_elsewhere(self):
        wrong = self.file("wrong.json", {"A": [[1, 0], [0, 1]], "b": [1, 2], "mu": "infinite", "no such key": 1})
        for words in (("solve", wrong), ("search", "--generator", "nothing of this name"), ("solve", self.made / "gone")):
            one = cli.run(*words)
            for columns in (60, 100):
                code, text = on_a_terminal(columns, *words)
                self.assertEqual((code, text.split()), (one.code, one.err.split()))
                self.assertFalse([line for line in text.splitlines()
                                  if len(line) > columns and re.search(r"\S \S", line.strip()[:columns])], text)

    def test_progress_is_one_line_that_changes(self):
        for columns in (60, 80):
            code, text = on_a_terminal(columns, "search", "--minutes", "0.05", "--store", self.made / f"p{columns}.store")
            self.assertEqual(code, 0, text)
            updates = re.findall(r"\r\x1b\[K(\[[^\r\n]*)", text)
            self.assertGreater(len(updates), 2)
            for update in updates:
                self.assertLess(len(update), columns)  # behind the last column some terminals begin a line
            self.assertTrue(any("problems" in update for update in updates), updates)

    def test_what_is_found_has_a_line_when_it_is_found(self):
        """Above the bar; in colour, unless NO_COLOR is set."""
        words = ("search", "--generator", "bodies", "-c", 2, "--problems", 40000, "--seed", 1, "--finishing", 0,
                 "--store")
        code, text = on_a_terminal(80, *words, self.made / "colour.store")
        found = re.findall(r"\r\x1b\[K\d\d:\d\d:\d\d ([^\r\n]*)", text.replace("\r\r", "\r"))
        found += re.findall(r"\n\d\d:\d\d:\d\d ([^\r\n]*)", text)
        groups = cli.run("status", self.made / "colour.store", "--json").json()
        signatures = [row[0] for row in cli.content(self.made / "colour.store")["findings"]]
        self.assertEqual(code, 0, groups)
        self.assertGreater(len(signatures), 1)
        names = [re.sub(r"\x1b\[\d*m", "", line).split(": ")[0] for line in found]
        self.assertEqual(sorted(names), sorted(signatures))
        self.assertTrue(any(line.startswith("\x1b[32mcycle-") for line in found), found)
        self.assertTrue(all("bodies, 2 contacts" in line for line in found), found)
        os.environ["NO_COLOR"] = "1"
        self.addCleanup(os.environ.pop, "NO_COLOR")
        text = on_a_terminal(80, *words, self.made / "plain.store")[1]
        self.assertNotIn("\x1b[3", text)
        self.assertIn(signatures[0], text)

    def test_a_watched_store_is_drawn_anew(self):
        store = self.made / "watched.store"
        search = subprocess.Popen([cli.program, "search", "-c", "2", "--minutes", "0.08", "--store", store],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 60
        while not store.exists() and time.monotonic() < until:
            time.sleep(0.05)
        code, text = on_a_terminal(80, "status", store, "--watch")
        search.wait()
        self.assertEqual(code, 0, text)
        screens = text.split("\x1b[H\x1b[2J")[1:]
        self.assertGreater(len(screens), 1)
        for screen in screens[:-1]:
            self.assertLess(screen.count("\n"), 24)
            self.assertRegex(screen.splitlines()[0], r"runs, .* more; .* groups?, .* new")
            self.assertIn("problems in ", screen)
        self.assertIn("no process works on", screens[-1])

    def test_json_is_not_broken(self):
        for columns in (40, 200):
            json.loads(in_columns(columns, "report", self.store, "--text", "--json"))

    def test_help_is_asked_for_in_every_way(self):
        whole = self.succeeds("--help").out
        for words in ((), ("help",), ("-h",)):
            self.assertEqual(self.succeeds(*words).out, whole)
        self.assertEqual(self.succeeds("help", "solve").out, self.succeeds("solve", "--help").out)
        self.assertEqual(self.succeeds("help", "solve").out, self.succeeds("solve", "-h").out)
        for group in ("Find", "Prove", "Solve", "Show"):
            self.assertIn(f"\n{group}:\n", whole)

    def test_short_options_are_the_long_ones(self):
        problem = CORPUS / "cycle-under-some-policies-a.json"
        short = cli.run("solve", problem, "-m", "baraff", "-a", "double", "-p", "ties=contacts", "-j")
        long = cli.run("solve", problem, "--method", "baraff", "--arithmetic", "double", "--policy", "ties=contacts",
                       "--json")
        self.assertEqual(short.json(), long.json())
        store = self.made / "short.store"
        self.succeeds("search", "-s", store, "-n", 300, "-g", "small", "-c", 2, "-p", "paper", "-t", 1, "-j")
        definition = json.loads(dict(cli.content(store)["campaign"])["definition"])
        self.assertEqual((definition["generators"], definition["contacts"]), (["small"], [2]))
        self.assertEqual(self.succeeds("status", store, "-j").json(), self.succeeds("status", store, "--json").json())

    def test_many_files_are_solved(self):
        files = [CORPUS / "cycle-under-some-policies-a.json", self.folder / "none.json",
                 CORPUS / "no-solution-zero-matrix.json"]
        done = cli.run("solve", *files)
        self.assertEqual(done.code, 2)
        for file in (files[0], files[2]):
            self.assertIn(f"{file}:", done.out.replace("\n", ""))
        self.assertIn("none.json", done.err)
        answers = cli.run("solve", *files, "--json").json()
        self.assertEqual([answer["file"] for answer in answers], list(map(str, files)))
        alone = cli.run("solve", files[2], "--json").json()
        self.assertEqual(answers[2]["answer"]["outcome"], alone["outcome"])
        self.assertIn("error", answers[1])
        self.assertEqual(cli.run("solve", files[0], files[2]).code, 1)

    def test_another_search_has_another_store(self):
        words = ("search", "--problems", 2000, "--threads", 1)
        first = cli.run(*words, cwd=self.folder)
        self.assertEqual(first.code, 0, first.err)
        second = cli.run(*words, "--seed", 2, "--contacts", 2, cwd=self.folder)
        self.assertEqual(second.code, 0, second.err)
        said, = [line for line in second.err.splitlines() if "another search" in line]
        self.assertIn("seed 1, not 2", said)
        self.assertIn("stiction-2.store", said)
        self.assertLess(len(said), 250)
        stores = {file.name for file in self.folder.glob("*.store")}
        self.assertEqual(stores, {"stiction.store", "stiction-2.store"})
        again = cli.run(*words, "--seed", 2, "--contacts", 2, cwd=self.folder)
        self.assertIn("stiction-2.store", again.err)
        self.assertEqual({file.name for file in self.folder.glob("*.store")}, stores)
        named = cli.run(*words, "--seed", 3, "--store", "stiction.store", cwd=self.folder)
        self.assertEqual(named.code, 2)
        self.assertRegex(named.err, r"stiction\.store: holds another search: seed 1, not 3; .*--store NEW_FILE")
        self.assertEqual(named.err.count("\n"), 1)


if __name__ == "__main__":
    cli.main()
