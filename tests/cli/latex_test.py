# SPDX-License-Identifier: Apache-2.0
"""stiction report --latex: every number of a table or figure is that of the CSV files; the document compiles where
pdflatex is installed. CITATION.cff is that of this version."""

import csv
import re
import shutil
import subprocess

import cli

RATE = re.compile(r"(\S+)(?: \\%)? \{\[\}(\S+), (\S+)\{\]\}")


def numbers(text):
    """The count, or the value and the interval, of a cell."""
    text = text.strip().replace(",", "") if "{[}" not in text else text.strip()
    match = RATE.fullmatch(text)
    return float(text) if not match else tuple(float(part.replace(",", "")) for part in match.groups())


def cells(path):
    lines = path.read_text().split("\\endhead\n")[1].split("\\bottomrule")[0].splitlines()
    assert all(line.endswith(" \\\\") for line in lines), lines
    return [line[:-3].split(" & ") for line in lines]


class Latex(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = cli.Path(cli.tempfile.mkdtemp(prefix="stiction-latex-"))
        cls.addClassCleanup(shutil.rmtree, cls.made, ignore_errors=True)
        store, cls.report = cls.made / "small.store", cls.made / "report"
        for arguments in [("search", "--generator", "conditioned", "near-degenerate", "--contacts", 2, 3, "--problems", 40000, "--seed", 1,
                           "--policy", "paper", "ties=contacts", "--finishing", 0, "--store", store),
                          ("report", store, "-o", cls.report, "--latex")]:
            done = cli.run(*arguments)
            assert done.code == 0, done.err
        cls.store = store

    def table(self, name):
        with open(self.report / name, newline="") as file:
            return list(csv.DictReader(file))

    def loops(self):
        """Loops that exact arithmetic confirmed, and runs, by (generator, policy, contacts)."""
        found = {(row["generator"], row["policy"], int(row["contacts"])): [0, int(row["problems"])]
                 for row in self.table("statistics.csv")}
        for row in self.table("verdicts.csv"):
            if row["exact_outcome"] in ("cycle", "stall"):
                found[row["generator"], row["policy"], int(row["contacts"])][0] += int(row["count"])
        return found

    def assert_rate(self, cell, count, of, scale):
        value, low, high = numbers(cell)
        exact = scale * count / of
        self.assertAlmostEqual(value, exact, delta=max(0.006 * exact, 1e-9))  # three digits
        self.assertTrue(low <= value <= high and (low < high), cell)
        self.assertEqual(count == 0, low == 0)

    def test_loops(self):
        rows = cells(self.report / "latex/loops.tex")
        found = self.loops()
        self.assertEqual(len(rows), len(found))
        self.assertGreater(sum(loops for loops, _ in found.values()), 0)
        for generator, policy, arithmetic, contacts, runs, loops, rate in rows:
            counted, problems = found[generator, policy, int(contacts)]
            self.assertEqual((numbers(runs), numbers(loops), arithmetic), (problems, counted, "double"))
            self.assert_rate(rate, counted, problems, 1e6)

    def test_contacts(self):
        rows = cells(self.report / "latex/contacts.tex")
        found = self.loops()
        self.assertEqual(len(rows), 4)
        for policy, contacts, runs, steps, zero_steps, give_ups, loops in rows:
            mine = [row for row in self.table("statistics.csv") if (row["policy"], row["contacts"]) == (policy, contacts)]
            total = {name: sum(int(row[name]) for row in mine)
                     for name in ("problems", "sum_steps", "with_zero_steps", "with_give_ups")}
            self.assertEqual(numbers(runs), total["problems"])
            self.assertAlmostEqual(float(steps), total["sum_steps"] / total["problems"], delta=0.01)
            self.assert_rate(zero_steps, total["with_zero_steps"], total["problems"], 100)
            self.assert_rate(give_ups, total["with_give_ups"], total["problems"], 100)
            self.assert_rate(loops, sum(count for (_, p, c), (count, _) in found.items() if (p, str(c)) == (policy, contacts)),
                             total["problems"], 1e6)

    def test_methods(self):
        names = ("contacts", "problems", "solved", "with_folds", "with_descents", "compared", "enumerated", "disagreements")
        self.assertEqual([[numbers(cell) for cell in row] for row in cells(self.report / "latex/methods.tex")],
                         [[int(row[name]) for name in names] for row in self.table("agreement.csv")])

    def test_figures(self):
        def drawn(figure):
            return re.search(r"\\pgfplotsinvokeforeach\{(.*)\}\{", figure)[1].split(",")

        def columns(figure):
            return set(re.findall(r"\\thisrow\{(\w+)\}", figure)) | set(re.findall(r"\b[xy]=([\w#]+)", figure))

        figure = (self.report / "latex/figure-loops.tex").read_text()
        self.assertIn("\\legend{{conditioned},{near-degenerate}}\n", figure)
        self.assertEqual({file.name for file in (self.report / "latex").glob("loops-*.csv")},
                         {f"loops-{i}.csv" for i in drawn(figure)})
        found = self.loops()
        for i, generator in zip(drawn(figure), ("conditioned", "near-degenerate"), strict=True):
            rows = self.table(f"latex/loops-{i}.csv")
            self.assertLessEqual(columns(figure), set(rows[0]))
            self.assertEqual({int(row["contacts"]) for row in rows}, {2, 3})
            for row in rows:
                loops, runs = found[generator, "paper", int(row["contacts"])]
                self.assertEqual((int(row["loops"]), int(row["runs"])), (loops, runs))
                rate, low, high = (float(row[name]) for name in ("rate", "low", "high"))
                self.assertAlmostEqual(rate, 1e6 * loops / runs, delta=1e-5 * rate)
                self.assertTrue(low <= rate < high and (low == 0) == (loops == 0), row)
        figure = (self.report / "latex/figure-steps.tex").read_text()
        self.assertEqual(columns(figure), {"steps", "c#1"})
        drawn_steps = {f"c{n}": int(n) for n in drawn(figure)}
        steps = {}
        for row in self.table("steps.csv"):
            if row["policy"] == "paper":
                key = (int(row["steps"]), int(row["contacts"]))
                steps[key] = steps.get(key, 0) + int(row["problems"])
        rows = self.table("latex/steps.csv")
        self.assertEqual(set(rows[0]), {"steps", *drawn_steps})
        self.assertEqual(set(drawn_steps.values()), {2, 3})
        for name, contacts in drawn_steps.items():
            runs = sum(n for (_, c), n in steps.items() if c == contacts)
            for row in rows:
                self.assertAlmostEqual(float(row[name]), steps.get((int(row["steps"]), contacts), 0) / runs, delta=1e-6)

    def test_the_document_compiles(self):
        if shutil.which("pdflatex") is None:
            self.skipTest("pdflatex is not installed")
        folder = shutil.copytree(self.report / "latex", self.folder / "latex")
        for _ in range(2):
            done = subprocess.run(["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "report.tex"], cwd=folder,
                                  capture_output=True, text=True, errors="replace", timeout=300)
            self.assertEqual(done.returncode, 0, done.stdout[-2000:])
        self.assertTrue((folder / "report.pdf").read_bytes().startswith(b"%PDF"))

    def test_without_the_option_there_is_no_latex_but_a_citation(self):
        report = self.folder / "report"
        self.succeeds("report", self.store, "-o", report)
        self.assertFalse((report / "latex").exists())
        citation = (report / "citation.bib").read_text()
        version = self.succeeds("--version").out.split(",")[0].removeprefix("stiction ")
        self.assertIn(f"howpublished = {{Software, version {version}}}", citation)
        self.assertIn("note = {Seed 1, version", citation)
        self.assertEqual(citation.count("{"), citation.count("}"))
        self.refuses("report", self.store, "--latex", "--text", says="found --latex alone, expected -o")

    def test_citation_file(self):
        text = (cli.ROOT / "CITATION.cff").read_text()
        version = re.search(r"project\(stiction VERSION (\S+)", (cli.ROOT / "CMakeLists.txt").read_text())[1]
        fields = dict(re.findall(r"^(\S+): (.*)$", text, re.M))
        self.assertEqual(fields["version"], version)
        self.assertEqual((fields["cff-version"], fields["license"]), ("1.2.0", "Apache-2.0"))
        for key in ("message", "title", "authors", "references"):
            self.assertRegex(text, rf"(?m)^{key}:")
        self.assertNotIn("doi", text.lower())


if __name__ == "__main__":
    cli.main()
