# SPDX-License-Identifier: Apache-2.0
"""Inputs that are no files, or too large, are refused at once; "-" is standard input for every verb that reads.

inputs_test.py PATH_TO_STICTION [SOURCES]
"""

import json
import os
import resource
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
import cli  # noqa: E402

CHECKER = cli.ROOT / "certify" / "check_certificate.py"
SECONDS = 20  # refused at once, on a busy machine


class Inputs(cli.TestCase):
    def verbs(self, file):
        out = self.folder / "out"
        return [("solve", file), ("replay", file), ("certify", file, "-o", out), ("check", file),
                ("minimize", file, "-o", out), ("export", file, "-o", out, "--format", "siconos-lcp"),
                ("import", file, "-o", out), ("assemble", file, "-o", out), ("draw", file, "-o", out),
                ("simulate", file, "-o", out), ("search", file, "--store", out)]

    def test_pipes_devices_folders_and_huge_files_are_refused_by_name(self):
        pipe, huge = self.folder / "pipe", self.folder / "huge.json"
        os.mkfifo(pipe)
        with open(huge, "wb") as file:
            file.truncate(3 << 30)
        for file in (pipe, huge, "/dev/zero", self.folder):
            for arguments in self.verbs(file):
                with self.subTest(arguments=arguments):
                    self.refuses(*arguments, says=[file, "nothing to read"], timeout=SECONDS)
            done = subprocess.run([sys.executable, CHECKER, file], capture_output=True, text=True, timeout=SECONDS)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(str(file), done.stderr)

    def test_survey_goes_on_behind_them(self):
        os.mkfifo(self.folder / "pipe.json")
        done = cli.run("survey", self.folder / "pipe.json", self.file("p.json", cli.SOLVED), timeout=SECONDS)
        self.assertEqual(done.code, 2)
        self.assertIn("pipe.json", done.err)
        self.assertIn("p.json", done.out)

    def from_standard_input(self, text, *arguments):
        done = subprocess.run([cli.program, *map(str, arguments)], input=text, capture_output=True, text=True,
                              timeout=120)
        return cli.Run(done.returncode, done.stdout, done.stderr)

    def test_a_dash_is_standard_input(self):
        certificate = self.folder / "c.json"
        problem = self.file("p.json", cli.SOLVED)
        self.succeeds("certify", problem, "-o", certificate)
        scene = (cli.ROOT / "corpus/scenes/stack.json").read_text()
        lcp = self.succeeds("export", cli.ROOT / "corpus/exponential-pivots-5-frictionless.json", "-o", "-",
                            "--format", "siconos-lcp").out
        calls = [(problem.read_text(), call) for call in (
            ("solve", "-", "--json"), ("replay", "-", "--json"), ("certify", "-", "-o", "-"), ("survey", "-"),
            ("certify", "-", "--all"), ("solve", "/dev/stdin", "--json"))]
        calls += [(certificate.read_text(), ("check", "-")), (scene, ("draw", "-", "-o", "-")),
                  (lcp, ("import", "-", "-o", "-")),
                  (json.dumps(cli.REFERENCE), ("minimize", "-", "-o", "-"))]
        for text, arguments in calls:
            with self.subTest(arguments=arguments):
                done = self.from_standard_input(text, *arguments)
                self.assertEqual(done.code, 0, done.err)
                self.assertNotEqual(done.out, "")
        done = subprocess.run([sys.executable, CHECKER, "-"], input=certificate.read_text(), text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_is_wrong_on_standard_input_is_bad_input(self):
        self.assertEqual(self.from_standard_input("nonsense", "solve", "-").code, 2)
        self.refuses("solve", "-", says="standard input", timeout=SECONDS)  # a device

    def test_fclib_passes_through_a_pipe_both_ways(self):
        problem = self.file("p.json", {**cli.SOLVED, "contacts": [{"kind": "static", "mu": "1/2"}]})
        hdf5 = subprocess.run([cli.program, "export", problem, "-o", "-", "--format", "fclib"], capture_output=True)
        self.assertEqual(hdf5.returncode, 0, hdf5.stderr)
        back = subprocess.run([cli.program, "import", "-", "-o", "-"], input=hdf5.stdout, capture_output=True)
        self.assertEqual(back.returncode, 0, back.stderr)
        self.assertEqual(json.loads(back.stdout)["A"], cli.SOLVED["A"])

    def test_a_matrix_that_no_memory_holds_is_refused_before_it_is_made(self):
        for rows in (4001, 200000):
            problem = {**cli.SOLVED, "contacts": [{"kind": "frictionless"}] * rows, "b": [0] * rows,
                       "A": {"size": rows, "entries": []}}
            file = self.file("large.json", problem)
            self.refuses("replay", file, says=[file, f"rows: found {rows}, expected at most 4000 for a dense matrix"])
            self.refuses("solve", file, "--method", "complete", says=[file, f"rows: found {rows}", "dense"])

    def test_numbers_that_no_memory_holds_end_in_one_line(self):
        """Of ten bytes each in the file, and of four kilobytes in memory."""
        rows = 400
        problem = {**cli.SOLVED, "contacts": [{"kind": "frictionless"}] * rows, "b": ["0"] * rows,
                   "A": [["1e9999"] * rows] * rows}
        file = self.file("long.json", problem)
        most = 500 << 20
        done = subprocess.run([cli.program, "solve", file], capture_output=True, text=True, timeout=120,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (most, most)))
        self.assertEqual((done.returncode, done.stdout, done.stderr), (3, "", "stiction: limit: out of memory\n"))

    def test_names_move_no_cursor(self):
        """Control characters of names reach no terminal; files keep them."""
        name = "red\x1b[31m\r\x07\x7f"
        file = self.file("p.json", {**cli.REFERENCE, "name": name})
        for verb in ("solve", "replay"):
            self.assertPlain(cli.run(verb, file))
        done = self.refuses("solve", self.folder / name)
        self.assertNotIn("\x07", done.err)
        self.assertIn("red?[31m", done.err)
        copy = self.folder / "q.json"
        self.succeeds("minimize", file, "-o", copy)
        for at in ("-", copy):
            done = cli.run("export", file, "-o", at, "--format", "siconos-fc")
            self.assertEqual(done.code, 0, done.err)

    def test_both_checkers_call_the_same_files_unreadable(self):
        texts = ["", "{", '{"a": 1, "a": 2}', '{"a": 1e999}', '{"a": ' + "9" * 400 + "}", '{"a": NaN}', "\ufeff{}",
                 '"\0"', "[" * 101 + "]" * 101, "[" * 100000]
        file = self.folder / "c.json"
        for text in texts:
            with self.subTest(text=text[:40]):
                file.write_text(text, encoding="utf-8")
                done = subprocess.run([sys.executable, CHECKER, file], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.refuses("check", file, says=file)


if __name__ == "__main__":
    cli.main()
