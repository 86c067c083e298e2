# SPDX-License-Identifier: Apache-2.0
"""The studies of bench/studies, at small size: their tables say what can be known of them otherwise.

    studies_test.py STICTION SOURCES"""

import csv
import itertools
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import stiction

SOURCES = Path(sys.argv[2])


def printed(name, *words):
    done = subprocess.run([sys.executable, SOURCES / "bench/studies" / f"{name}.py", *map(str, words)], text=True,
                          capture_output=True, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
    if done.returncode:
        raise AssertionError(f"{name}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


def tables(name, *words):
    """Rows of each table, by the heads of its columns."""
    found = []
    for block in printed(name, *words).split("\n\n"):
        lines = [line[2:-2].split(" | ") for line in block.splitlines() if line.startswith("|")]
        if lines:
            found.append([dict(zip(lines[0], cells, strict=True)) for cells in lines[2:]])
    return found


def whole(text):
    return int(text.replace(",", ""))


class Studies(unittest.TestCase):
    def test_all_have_a_test_here(self):
        studies = {file.stem for file in (SOURCES / "bench/studies").glob("*.py")} - {"study"}
        self.assertEqual(studies, {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")} - {
            "all_have_a_test_here", "what_they_ask_for_is_refused_by_name"})

    def test_what_they_ask_for_is_refused_by_name(self):
        done = subprocess.run([sys.executable, SOURCES / "bench/studies/patches.py", "--generator", "none"], text=True,
                              capture_output=True, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
        self.assertIn('found "none", expected one of integers', done.stderr)

    def test_smallest(self):
        """Counted again: definite by leading minors, up to tangents reversed; b with a negative normal."""
        def determinant(M):
            if not M:
                return 1
            return sum((-1) ** j * M[0][j] * determinant([row[:j] + row[j + 1:] for row in M[1:]])
                       for j in range(len(M)) if M[0][j])

        (row,), = tables("smallest", "--entries", 1)
        matrices = 0
        for n1f1, n2f2, *rest in itertools.product((0, 1), (0, 1), *[(-1, 0, 1)] * 4):
            A = [[1, n1f1, rest[0], rest[1]], [n1f1, 1, rest[2], rest[3]], [rest[0], rest[2], 1, n2f2],
                 [rest[1], rest[3], n2f2, 1]]
            matrices += all(determinant([line[:k] for line in A[:k]]) > 0 for k in range(1, 5))
        self.assertEqual((row["matrices"], row["problems"]), (str(matrices), str(matrices * (3 ** 4 - 4 * 9))))
        self.assertEqual((row["loops of `paper`"], row["the smallest loop"]), ("0", "-"))

    def test_sliding(self):
        rows, = tables("sliding", "--generator", "integers", "--contacts", 1, 2, "--problems", 1500)
        self.assertEqual([row["contacts, sliding"] for row in rows], ["1, 1", "2, 1", "2, 2"])
        for row in rows:
            ends = [whole(row[end]) for end in ("solved", "ray", "singular", "stall", "limit", "undecided", "cycle")]
            self.assertEqual(sum(ends), 1500)
            self.assertGreater(whole(row["ray"]), 0)
            self.assertLessEqual(sum(map(int, row["with a solution, without"].split(","))), whole(row["cycle"]))

    def test_patches(self):
        rows, = tables("patches", "--generator", "bodies", "--contacts", 3, "--problems", 1500)
        rates = {name: float(rows[0][name].split()[0].replace(",", "")) for name in (
            "give up", "folds", "`give-up=first`", "fold", "Lemke at a give-up", "`complete`")}
        self.assertEqual((rates["Lemke at a give-up"], rates["`complete`"]), (0, 0))
        self.assertLess(rates["`give-up=first`"], 1e4 * rates["give up"])
        self.assertLess(rates["fold"], 1e4 * rates["folds"])
        self.assertGreater(rates["fold"], 0)
        problems = stiction.draw("bodies", 3, 1500)
        folds = (stiction.solve_all(problems, "complete", "exact")["folds"] > 0).sum()
        self.assertAlmostEqual(rates["folds"], folds / 15, delta=0.01)

    def test_work(self):
        runs, folds, pairs, starts = tables("work", "--contacts", 2, 3, "--problems", 24)
        for row in runs:
            ended = row["not solved"].split(", ") if row["not solved"] != "0" else []
            self.assertEqual(whole(row["solved"]) + sum(int(end.split()[0]) for end in ended), whole(row["problems"]))
            if row["method"] != "`baraff`" and row["method"] != "`ipopt`":
                self.assertEqual(row["solved"], row["problems"], row)
        self.assertEqual([row["folds, 95 %"].split()[0] for row in folds if row[""] == "mu = 0"], ["0"])
        for row in pairs:
            ends = ("folds and give-ups", "folds only", "give-ups only", "neither")
            self.assertEqual(sum(whole(row[end]) for end in ends), 48)
        for row in starts:
            counted = sum(whole(row[key]) for key in ("starts: 1", "2", "3", "4 to 20", "none"))
            self.assertEqual(counted, whole(row["problems"]))
        exponential, *_ = tables("work", "--generator", "exponential", "--contacts", 3, "--problems", 8)
        self.assertEqual([row["solved"] for row in exponential if row["method"] == "`complete`"], ["8"])

    def test_space(self):
        sizes, friction = tables("space", "--contacts", 1, 3, "--problems", 20)
        self.assertEqual([row["family, contacts"] for row in sizes],
                         [name for name in ("definite, 1", "definite, 3", "one body, 3") for _ in range(3)])
        ends = ("solved", "recurs", "nearer", "left again", "ray", "otherwise")
        for rows, count in ((sizes, 20), (friction, 12)):
            for row in rows:
                self.assertEqual(sum(whole(row[end]) for end in ends), count, row)
                self.assertEqual(row["differ"], "0")
                if row["`slip`"] == "polygon":
                    self.assertEqual(row["solved"], str(count))

    def test_space_loops(self):
        with tempfile.TemporaryDirectory() as folder:
            rows, = tables("space_loops", "--contacts", 2, "--problems", 1500, "--seeds", 1, "--certificates", folder)
            self.assertEqual([row["`slip`"] for row in rows], ["literal", "redirect"])
            for row in rows:
                ends = [whole(row[end]) for end in ("by states", "by boxes", "punctured", "open", "refused")]
                self.assertEqual(sum(ends), whole(row["suspected"]), row)
                self.assertEqual(row["refused"], "0")
            proved = sum(whole(row[kind]) for row in rows for kind in ("by states", "by boxes", "punctured"))
            self.assertGreater(proved, 0)
            self.assertGreater(sum(whole(row["no state twice"]) for row in rows), 0)
            self.assertEqual(len(list(Path(folder).iterdir())), proved)

    def test_space_solved(self):
        rows, = tables("space_solved", "--contacts", 1, 3, "--problems", 15)
        self.assertEqual([row["problems of"] for row in rows],
                         ["`exceptional`", "`exceptional`", "`space`", "`space`", "`corpus/space/critical`"])
        for row in rows:
            self.assertEqual(row["problems"], "15" if row["contacts"] != "all" else "6")
            self.assertEqual((row["solved"], row["not solved, by cause"]), (row["problems"], "none"))
            self.assertGreaterEqual(whole(row["most"].split(".")[0]), 1)
        self.assertGreater(whole(rows[-1]["most"]), 100_000)  # near a critical load

    def test_adversary(self):
        rows, = tables("adversary", "--objective", "steps", "friction", "--problems", 400)
        self.assertEqual([row["objective"] for row in rows], ["steps", "friction"])
        self.assertGreater(float(rows[0]["best of random"]), 4)
        for name in ("evolution", "nlopt", "continuation"):
            self.assertGreater(float(rows[0][f"gain of {name}"]), 0.3)

    def test_trade(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "trade.csv")
            rows, = tables("trade", "--contacts", 2, "--problems", 6, "--csv", file)
            lines = list(csv.DictReader(file.open()))
        self.assertEqual({row["silently wrong"] for row in rows}, {"0"})
        by = {(row["method"], row["arithmetic"]): row for row in rows}
        self.assertLessEqual({"float", "double", "double scaled", "double regularized", "quad", "filtered", "exact"},
                             {arithmetic for _, arithmetic in by})
        for method in ("`complete`", "`lemke`"):
            self.assertEqual(whole(by[method, "exact"]["solved"]), sum(
                int(line["problems"]) for line in lines if (line["method"], line["arithmetic"]) == ("complete", "exact")))
        for line in lines:
            ends = sum(int(line[end]) for end in ("solved", "undecided", "other", "refused"))
            self.assertEqual(ends, int(line["problems"]), line)
            self.assertLessEqual(float(line["wrong_share_low"]), float(line["wrong_share_high"]))
            decided = sum(int(line[f"decided_on_{rung}"]) for rung in ("double", "double-double", "exact"))
            self.assertEqual(decided > 0, line["arithmetic"] == "filtered", line)
            if line["arithmetic"] == "exact" and line["worst_residual"]:
                self.assertEqual(float(line["worst_residual"]), 0)

        self.assertGreater(max(float(line["worst_residual"] or 0) for line in lines
                               if line["arithmetic"] == "double regularized"), 1e-12)

    def test_extremes(self):
        lines = json.loads(printed("extremes", "--families", "levers", "range", "--problems", 2, "--json"))
        self.assertEqual({line["family"] for line in lines}, {"levers", "range"})
        at = {(line["setting"], line["method"], line["arithmetic"]): line for line in lines if line["family"] == "levers"}
        self.assertEqual(at[150, "complete", "float"]["refused"], 2)  # 10^150 m
        self.assertEqual(at[150, "complete", "exact"]["solved"], 2)
        self.assertIsNone(at[150, "complete", "float"]["microseconds"])
        self.assertEqual(sum(line["silent"] for line in lines), 0)

    def test_methods(self):
        rows, = tables("methods", "--contacts", 2, 3, "--problems", 40)
        must = [row for row in rows if row["method"] in ("complete", "lemke", "enumerate")]
        self.assertEqual(len(must), 10)
        for row in must:
            self.assertEqual((row["solved"], row["wrong"]), (row["problems"], "0"), row)
        self.assertEqual(rows[0]["times `complete`, double"], "1 (1 - 1)")
        generated = json.loads(printed("methods", "--contacts", 2, "--problems", 8, "--generator", "duplicates", "--json"))
        self.assertEqual((generated["generator"], generated["mismatches"], len(generated["times"])), ("duplicates", 0, 10))

    def test_frictionless(self):
        rows = json.loads(printed("frictionless", "--contacts", 4, 40, "--problems", 2, "--json"))["frictionless"]
        self.assertEqual([(row["contacts"], row["problems"]) for row in rows], [(4, 2), (40, 2)])
        for row in rows:
            for method in ("baraff", "lemke", "fast", "ipopt", "qp"):
                self.assertEqual(row[f"{method} solved"], 2, row)
            self.assertGreater(row["qp us"][1], row["lu us"])

    def test_ratios(self):
        runs, walls, searches = tables("ratios", "--contacts", 2, "--problems", 3, "--searched", 200, "--repeat", 1,
                                       "--walls", "2x2", "--limit", 100)
        self.assertEqual({row["method"] for row in runs}, {"`complete`", "`baraff`"})
        for row in runs:
            self.assertGreater(float(row["rationals, times doubles"].replace(",", "")), 1)
        self.assertEqual([(row["wall"], row["in"], row["bodies"]) for row in walls],
                         [("2x2", "plane", "3"), ("2x2", "space", "3")])
        for row in walls:
            self.assertGreater(float(row["`solve`, s"]) + float(row["`certify`, s"]), 0)  # both end with an answer
        self.assertEqual([row["search of"] for row in searches], ["`conditioned`", "`near-degenerate`"])

    def test_large_certificates(self):
        rows, = tables("large_certificates", "--walls", 3, "--pushed", 3, "--pyramids", 3, "--stacks", 4, "--no-published")
        self.assertEqual([row["problem"] for row in rows], ["wall of 3", "wall of 3, pushed", "pyramid of 3", "stack of 4"])
        self.assertEqual({row["altered: refused"] for row in rows}, {"2 of 2"})
        self.assertEqual(rows[0]["claim"], "`solution-exists`")

    def test_coulomb_exact(self):
        rows, = tables("coulomb_exact", "--contacts", 1, 4, "--problems", 40)
        self.assertEqual([row["contacts"] for row in rows], ["1", "4"])
        for row in rows:
            self.assertGreaterEqual(whole(row["certified"]), 36, row)

    def test_many(self):
        rows, = tables("many", "--contacts", 3, "--problems", 400, "--repeat", 2)
        self.assertEqual(len(rows), 6)
        for row in rows:
            library, python = whole(row["library, problems a core second"]), whole(row["Python"])
            self.assertGreater(library, python)
            self.assertGreater(float(row["ratio: median (90 %)"].split()[0]), 0.3)

    def test_impacts(self):
        with tempfile.TemporaryDirectory() as folder:
            options = ("--scenes", 4, "--bodies", 5, 12, "--seconds", 0.15)
            problems, scenes, worst = tables("impacts", *options, "--keep", folder)
            for row in worst:  # judged again over fractions, on A rounded to doubles
                file = Path(folder, row["the worst"])
                done = subprocess.run([sys.executable, SOURCES / "certify/residuals.py", f"{file}.problem.json",
                                       f"{file}.answer.json"], text=True, capture_output=True)
                found, said = (float(done.stdout.replace(";", "").split()[k]) for k in (1, -1))
                self.assertAlmostEqual(found, said, delta=1e-8 + said / 10, msg=done.stdout)
        again, *_ = tables("impacts", *options)
        self.assertEqual(problems, again)
        self.assertEqual({row["problems"] for row in problems}, set(row["problems"] for row in worst))
        self.assertIn("impulses", {row["problems"] for row in problems})
        self.assertEqual(sum(int(row["how many"]) for row in scenes), 4)
        self.assertEqual(sum(int(row["not ended"]) for row in scenes), 0)
        for strict, beyond, lenient in zip(*(problems[k::3] for k in range(3))):
            self.assertEqual([row["error"] for row in (strict, beyond, lenient)], ["strict", "less noise", "lenient"])
            self.assertLess(float(beyond["worst"]), float(strict["worst"]))
            self.assertEqual(lenient["above 1e-5, 95 %"].split()[0], "0", lenient)

    def test_motion(self):
        rows, = tables("motion", "--walls", 2, 4, "--walls-in-space", 2, "--piles", 5, 9)
        self.assertEqual([(row["scene"], row["bodies"]) for row in rows], [
            ("wall", "4"), ("wall", "15"), ("wall", "exponent"), ("wall in space", "4"), ("pile", "6"), ("pile", "10"),
            ("pile", "exponent")])
        for row in rows:
            self.assertEqual(len([cell for cell in row.values() if cell]), 5, row)

    def test_linear_algebra(self):
        systems, runs = tables("linear_algebra", "--contacts", 2, "--sizes", 3, 8, "--problems", 5)
        self.assertEqual([row["rows"] for row in systems], ["3", "8", "3", "8"])
        self.assertEqual(len(runs), 4)
        for row in systems + runs:
            for median, most in (cell[:-1].split(" (") for name, cell in row.items() if cell.endswith(")")):
                self.assertLessEqual(0, float(median.replace(",", "")))
                self.assertLessEqual(float(median.replace(",", "")), float(most.replace(",", "")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
