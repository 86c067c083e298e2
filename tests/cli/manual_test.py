# SPDX-License-Identifier: Apache-2.0
"""The manual, the completion and --help say the same, which is what the program reads; and the table of words."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import cli


def plain(text):
    return " ".join(text.split())


class Manual(cli.TestCase):
    def setUp(self):
        super().setUp()
        self.verbs = json.loads(self.succeeds("manual", "--json").out)

    def test_the_tables_have_every_verb_of_the_help(self):
        verbs = self.succeeds("--help").out.split("Options:")[0].split("Usage:")[1]
        self.assertEqual([verb["verb"] for verb in self.verbs], re.findall(r"(?m)^  (\S+)", verbs))

    def test_help_says_every_row(self):
        for verb in self.verbs:
            text = plain(self.succeeds(verb["verb"], "--help").out)
            self.assertIn(plain(verb["purpose"]), text)
            for row in verb["words"]:
                self.assertIn(", ".join(row["names"]), text)
                self.assertIn(plain(row["help"]), text)
                for choice in row["choices"]:
                    self.assertIn(choice["name"], text)

    def test_the_program_reads_every_option(self):
        for verb in self.verbs:
            for row in verb["words"]:
                for name in row["names"] if row["kind"] != "positional" else []:
                    done = cli.run(verb["verb"], name, *(["x"] if row["kind"] == "option" else []), "--nonsense")
                    self.assertNotIn(f"found {name},", done.err)
                    self.assertEqual(done.code, 2)

    def test_the_man_page_has_every_row_and_word_and_groff_no_complaint(self):
        page = self.succeeds("manual").out
        source = page.replace("\\-", "-").replace("\\&", "").replace("\\e", "\\")
        for verb in self.verbs:
            self.assertIn(f".SS stiction {verb['verb']} [OPTIONS]", source)
            for row in verb["words"]:
                self.assertIn(f".B {', '.join(row['names'])}", source)
                self.assertIn(row["help"], source)
        for word in json.loads(self.succeeds("words", "--json").out):
            self.assertIn(f".B {word['word']}\n{word['meaning']}", source)
        self.assertIsNotNone(shutil.which("groff"), "expected groff: apt-get install groff-base")
        done = subprocess.run(["groff", "-man", "-Tascii", "-ww"], input=page, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        read = plain(re.sub(r"\x1b\[[0-9;]*m|.\x08", "", done.stdout))
        for section in ("NAME", "SYNOPSIS", "VERBS", "EXIT STATUS", "WORDS", "EXAMPLES"):
            self.assertIn(section, read)

    def test_stiction_bench_has_a_page_of_its_own(self):
        page = self.succeeds("manual", "--format", "man-bench").out
        source = page.replace("\\-", "-").replace("\\&", "").replace("\\e", "\\")
        verb = next(verb for verb in self.verbs if verb["verb"] == "bench")
        self.assertIn("--suite", [name for row in verb["words"] for name in row["names"]])
        for row in verb["words"]:
            self.assertIn(f".B {', '.join(row['names'])}", source)
            self.assertIn(row["help"], source)
            for choice in row["choices"]:
                self.assertIn(choice["name"], source)
        done = subprocess.run(["groff", "-man", "-Tascii", "-ww"], input=page, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        read = plain(re.sub(r"\x1b\[[0-9;]*m|.\x08", "", done.stdout))
        for part in ("stiction-bench - ", "SYNOPSIS", "OPTIONS", "EXIT STATUS", "74 the disk is full"):
            self.assertIn(part, read)

    def test_the_pages_of_all_programs_are_installed(self):
        """What the program writes of itself is written, and installed, by the build."""
        packages = (cli.ROOT / "cmake/packages.cmake").read_text()
        installed = re.search(r"install\(FILES ([^)]*)\s+DESTINATION \$\{CMAKE_INSTALL_MANDIR\}", packages)[1]
        pages = {variable: Path(page).name
                 for variable, page in re.findall(r"set\((\w+) \$\{PROJECT_BINARY_DIR\}/packages/(\S+\.1)\)", packages)}
        for variable, page in pages.items():
            self.assertIn(f"${{{variable}}}.gz", installed)
            self.assertRegex(packages, rf"COMMAND stiction manual[a-z -]* > \$\{{{variable}\}}")
        self.assertEqual(set(pages.values()), {"stiction.1", "stiction-bench.1"})
        self.assertIn("stiction-ipopt.1.gz", installed)

    def completed(self, *words):
        """What bash offers for the last of the words."""
        script = self.folder / "completion"
        script.write_text(self.succeeds("manual", "--format", "bash").out)
        code = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _stiction; '
                'printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-c", code, "bash", script, "stiction", *words], capture_output=True, text=True,
                              cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.split()

    def test_bash_completes_verbs_options_values_and_files(self):
        self.assertEqual(sorted(self.completed("rep")), ["replay", "report"])
        self.assertEqual(self.completed("help", "sol"), ["solve"])
        self.assertEqual(set(self.completed("")), {*(verb["verb"] for verb in self.verbs), "help", "--help", "--version"})
        for verb in self.verbs:
            names = [name for row in verb["words"] if row["kind"] != "positional" for name in row["names"]]
            self.assertEqual(self.completed(verb["verb"], "-"), ["--help", *names])
            for row in verb["words"]:
                if row["kind"] == "option" and row["choices"]:
                    values = [choice["name"] for choice in row["choices"]]
                    self.assertEqual(self.completed(verb["verb"], row["names"][-1], ""), values)
        self.assertEqual(self.completed("bench", "--suite", "peers"), ["peers", "peers-extremes"])
        self.file("a-problem.json", cli.SOLVED)
        self.assertEqual(self.completed("solve", "a-pro"), ["a-problem.json"])

    def test_words_are_explained(self):
        listed = json.loads(self.succeeds("words", "--json").out)
        names = [word["word"] for word in listed]
        for word in ("N1", "F1", "C", "NC", "CF", "NC-", "NC+", "fold", "bounce", "singular", "ray", "cycle", "stall"):
            self.assertIn(word, names)
        self.assertEqual(len(names), len(set(names)))
        text = plain(self.succeeds("words").out)
        for word in listed:
            self.assertTrue(word["meaning"])
            self.assertIn(word["meaning"], text)

    def test_the_sources_of_words_are_sections_of_the_paper_or_pages_here(self):
        for word in json.loads(self.succeeds("words", "--json").out):
            for source in filter(None, word["source"].split(", ")):
                self.assertTrue(re.fullmatch(r"\d(\.\d)?", source) or (cli.ROOT / source).is_file(), word)


if __name__ == "__main__":
    cli.main()
