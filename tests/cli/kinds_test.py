# SPDX-License-Identifier: Apache-2.0
"""Bilateral constraints (4.5) and sliding contacts (6): every method takes them, and certificates decide."""

import json
import subprocess
import sys

import cli

FOLDER = cli.ROOT / "corpus" / "sliding"
METHODS = ["baraff", "complete", "lemke", "enumerate", "ipopt"]


class Kinds(cli.TestCase):
    def solve(self, name, *options):
        return cli.run("solve", FOLDER / f"{name}.json", "--json", *options)

    def certified(self, name):
        certificate = self.folder / f"{name}.json"
        self.succeeds("certify", FOLDER / f"{name}.json", "-o", certificate)
        self.succeeds("check", certificate)
        done = subprocess.run([sys.executable, cli.ROOT / "certify" / "check_certificate.py", certificate],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(certificate.read_text())["claim"]

    def test_every_method_solves_a_hinge_a_slider_and_a_static_contact(self):
        expected = ["-10/21", "16/21", "8/21", "17/21", "-17/21", "0"]  # the second hinge repeats the first
        for method in METHODS:
            with self.subTest(method=method):
                result = self.solve("hinged-slider", "--method", method).json()
                self.assertEqual(result["outcome"], "solved")
                self.assertEqual(result["f"][1:5], expected[1:5])
                self.assertEqual([result["a"][row] for row in (0, 1, 3, 5)], ["0"] * 4)
        self.assertEqual(self.certified("hinged-slider"), "solution-exists")

    def test_doubles_agree(self):
        for method in ("baraff", "complete", "lemke", "fast"):
            with self.subTest(method=method):
                result = self.solve("hinged-slider", "--method", method, "--arithmetic", "double").json()
                self.assertEqual(result["outcome"], "solved")
                self.assertLess(result["residual"], 1e-12)
                self.assertAlmostEqual(result["f"][1], 16 / 21, places=12)

    def test_an_infinite_step_has_an_impulsive_direction_and_no_solution_is_certified(self):
        for name, direction in (("rod-without-solution", ["1", "-2"]), ("smallest-without-solution", ["1", "-1"])):
            for method in ("baraff", "complete", "lemke"):
                with self.subTest(name=name, method=method):
                    done = self.solve(name, "--method", method)
                    self.assertEqual(done.code, 1)
                    self.assertEqual(done.json()["outcome"], "ray")
                    self.assertEqual(done.json()["ray"], direction)
            self.assertEqual(self.certified(name), "no-solution")

    def test_both_solutions_of_the_rod_are_listed(self):
        words = self.succeeds("certify", FOLDER / "rod-with-two-solutions.json", "--all", "--json").json()["words"]
        self.assertEqual([word["f"] for word in words], [["0", "0"], ["25/2", "-25"]])
        self.assertTrue(all(word["unique"] for word in words))

    def test_hinges_that_contradict_each_other_are_singular_and_without_solution(self):
        problem = {"format": "stiction-problem", "version": 1, "name": "two hinges", "dimension": 2,
                   "contacts": [{"kind": "bilateral"}, {"kind": "bilateral"}],
                   "A": [["1", "2"], ["2", "4"]], "b": ["1", "3"]}
        file = self.file("hinges.json", problem)
        for method in ("baraff", "complete", "lemke"):
            done = cli.run("solve", file, "--json", "--method", method)
            self.assertEqual((done.code, done.json()["outcome"]), (1, "singular"))
            self.assertIn("no forces keep the bilateral constraints", done.json()["reason"])
        certificate = self.folder / "hinges.cert.json"
        self.succeeds("certify", file, "-o", certificate)
        self.assertEqual(json.loads(certificate.read_text())["claim"], "no-solution")


if __name__ == "__main__":
    cli.main()
