# SPDX-License-Identifier: Apache-2.0
"""The figures in the text: what their blocks refuse, their intervals, and that no block is refused now.

Takes the path of the program, and that of the sources, as the other scripts do."""

import argparse
import math
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import figures  # noqa: E402
import intervals  # noqa: E402
import markdown  # noqa: E402
from program import Program  # noqa: E402
from registry import DOCUMENTS, MEASURED, Block, Measurement, measured_files  # noqa: E402

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(figures.ROOT / "build/release/stiction")


def counted(program):
    program.show("./run count")
    return "| problems |\n| --- |\n| 17 |"


CHEAP = Block("cheap-one", "README.md", counted)
COSTLY = Measurement("costly-one", "minutes", counted, "What was counted.")
BESIDE = Measurement("costly-one", "minutes", counted, "What was counted.", ("libode-dev",))
BLOCK = f"<!-- figures: cheap-one -->\n{figures.block(CHEAP, PROGRAM)}\n<!-- end of figures: cheap-one -->"
LINK = "[numbers](../reports/measured/costly-one.md)"


class Blocks(unittest.TestCase):
    def refused(self, content):
        return figures.refused_texts({"README.md": content}, [CHEAP], PROGRAM)

    def test_a_block_as_it_was_made_is_not_refused(self):
        self.assertEqual(list(self.refused(f"before\n{BLOCK}\nafter")), [])
        self.assertIn("`./run count`", BLOCK)

    def test_what_differs_is_missing_or_unknown_is_refused(self):
        other = BLOCK.replace("cheap-one", "other-one")
        for content, reason in ((BLOCK.replace("| 17 |", "| 18 |"), "is not what its commands give"),
                                ("", "is missing"), (f"{BLOCK}\n{other}", "nothing makes the block other-one"),
                                (f"{BLOCK}\n{BLOCK}", "stands twice"),
                                (BLOCK.replace("end of figures: cheap-one", "end"), "not closed")):
            self.assertIn(reason, "\n".join(self.refused(content)), content)

    def test_a_block_takes_the_place_of_the_one_before(self):
        new = figures.replaced(f"a\n{BLOCK.replace('17', '16')}\nb", CHEAP, figures.block(CHEAP, PROGRAM))
        self.assertEqual(new, f"a\n{BLOCK}\nb")


class MeasuredFiles(unittest.TestCase):
    def refused(self, content, figure=COSTLY, texts=(LINK,)):
        return figures.refused_measurement(figure, content, texts)

    def test_a_file_as_it_was_made_is_not_refused(self):
        for figure in (COSTLY, BESIDE):
            self.assertEqual(self.refused(figures.measured(figure, PROGRAM), figure), "")

    def test_a_file_says_what_made_it_and_what_it_is(self):
        facts, body = markdown.front_matter(figures.measured(BESIDE, PROGRAM))
        self.assertEqual(list(facts), ["command", "commit", "date", "machine", "peers", "digest"])
        self.assertEqual((facts["command"], facts["commit"]), ("./run count", figures.commit(PROGRAM)))
        self.assertRegex(body, r"^What was counted\.\n\n\| problems \|")

    def test_a_text_edited_by_hand_is_refused(self):
        content = figures.measured(COSTLY, PROGRAM)
        for word, other in (("| 17 |", "| 18 |"), ("What was", "What is")):
            self.assertEqual(self.refused(content.replace(word, other)), "was edited by hand")

    def test_a_fact_that_is_missing_is_refused(self):
        for key in ("command", "commit", "date", "machine", "peers", "digest"):
            content = re.sub(rf"^{key}: .*\n", "", figures.measured(BESIDE, PROGRAM), flags=re.M)
            self.assertEqual(self.refused(content, BESIDE), f"does not say its {key}")

    def test_a_file_that_no_text_links_to_is_refused(self):
        self.assertEqual(self.refused(figures.measured(COSTLY, PROGRAM), texts=["costly-one"]), "is linked from no text")

    def test_a_file_that_nothing_makes_is_refused(self):
        name = f"{MEASURED}/other.md"
        files = {name: figures.measured(COSTLY, PROGRAM)}
        self.assertEqual(list(figures.refused_files(files, [COSTLY], {"README.md": LINK})), [f"{name}: is made by nothing"])

    def test_every_measurement_is_a_file_or_said_to_be_missing(self):
        listed = measured_files()
        for one in figures.MEASUREMENTS:
            there = (figures.ROOT / one.file).exists()
            self.assertEqual(f"]({one.name}.md)" in listed, there, one.name)
            self.assertEqual(f"| `{one.name}` |" in listed, not there, one.name)

    def test_a_program_of_no_commit_measures_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "program"
            program.write_text("#!/bin/sh\necho stiction 0.1.0 0123456789ab-dirty-12345678, GNU 12.2.0\n")
            program.chmod(0o700)
            self.assertEqual(figures.commit(str(program)), "0123456-dirty-12345678")
            options = argparse.Namespace(names=["night"], program=str(program), problems=None)
            with self.assertRaisesRegex(SystemExit, "was built of no commit"):
                figures.refresh(options)

    def test_an_old_program_of_peers_measures_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            program, peers, library = (Path(folder) / name for name in ("stiction", "stiction-peers", "solver/libstiction_a.a"))
            self.assertTrue(figures.are_peers_old(program))
            library.parent.mkdir()
            for path, built in ((peers, 2), (library, 1)):
                path.touch()
                os.utime(path, (built, built))
            self.assertFalse(figures.are_peers_old(program))
            os.utime(library, (3, 3))
            self.assertTrue(figures.are_peers_old(program))

    def test_the_first_screen_shows_what_was_measured(self):
        def code(name):
            return re.findall(r"^ {4}.*", (figures.ROOT / name).read_text(), re.M)

        sample = code(f"{MEASURED}/first-search.md")
        self.assertGreater(len(sample), 10)
        self.assertIn("\n".join(sample), "\n".join(code("README.md")))


class LooseFigures(unittest.TestCase):
    def found(self, text):
        return [line.split("'")[1] for line in figures.loose_figures("README.md", text)]

    def test_measured_numbers_outside_of_blocks_are_found(self):
        for text, number in (("it took 8.1 s", "8.1 s"), ("2.5 % of them", "2.5 %"), ("1,234 times", "1,234"),
                             ("solved 3 of 17", "3 of 17"), ("loops under 900 policies", "900 policies")):
            self.assertEqual(self.found(text), [number], text)

    def test_blocks_code_and_definitions_are_let_be(self):
        for text in (BLOCK.replace("17", "1,700"), "    ./run search    # 8 s", "`1,234`", "<!-- 1,234 -->",
                     "n = 5 contacts, part 10", "```\n1,234\n```"):
            self.assertEqual(self.found(text), [], text)


class Intervals(unittest.TestCase):
    def test_counts(self):
        for count, low, high in ((0, 0, 3.689), (1, 0.0253, 5.572), (10, 4.795, 18.390), (100, 81.364, 121.627)):
            self.assertAlmostEqual(intervals.garwood(count)[0], low, 3)
            self.assertAlmostEqual(intervals.garwood(count)[1], high, 3)

    def test_shares(self):
        for count, of, low, high in ((0, 10, 0, 0.3085), (1, 10, 0.0025, 0.4450), (5, 10, 0.1871, 0.8129),
                                     (10, 10, 0.6915, 1), (2, 13, 0.0192, 0.4545)):
            self.assertAlmostEqual(intervals.clopper_pearson(count, of)[0], low, 4)
            self.assertAlmostEqual(intervals.clopper_pearson(count, of)[1], high, 4)

    def test_a_power_law_is_found_again(self):
        sizes = [(x, y) for x in (0.25, 0.5, 1) for y in (3, 4, 5)]
        # Counts that are as the law has them, and some that miss it.
        exact = [(round(1000 * x**3 * y**2), 1000, x, y) for x, y in sizes]
        law = intervals.power_law(exact)
        for name, value in (("p", 3), ("q", 2)):
            found, low, high = law[name]
            self.assertAlmostEqual(found, value, 2)
            self.assertLess(low, value)
            self.assertLess(value, high)
        self.assertAlmostEqual(law["C"], 1, 2)
        self.assertLess(law["deviance"], law["freedom"])
        missed = [(k * (2 if i % 2 else 1), *rest) for i, (k, *rest) in enumerate(exact)]
        wide = intervals.power_law(missed)
        self.assertGreater(wide["deviance"], 100 * wide["freedom"])
        self.assertGreater(wide["p"][2] - wide["p"][1], 10 * (law["p"][2] - law["p"][1]))

    def test_one_count_has_the_interval_of_its_likelihood(self):
        # Two cells of x alone: k2 / k1 = x^p, and log of it is nearly normal with variance 1 / k1 + 1 / k2.
        law = intervals.power_law([(400, 1, 1, 1), (100, 1, 0.5, 1), (400, 1, 1, 2), (100, 1, 0.5, 2)])
        half = 1.96 * math.sqrt(1 / 800 + 1 / 200) / math.log(2)
        self.assertAlmostEqual(law["p"][0], 2, 3)
        self.assertAlmostEqual(law["p"][1], 2 - half, 1)
        self.assertAlmostEqual(law["p"][2], 2 + half, 1)

    def test_the_program_prints_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Program(PROGRAM, folder)
            summary = program.json("search", "--generator", "bodies", "--contacts", 2, "--problems", 20000,
                                   "--store", Path(folder) / "s")
            cycles, runs = summary["failures"]["cycle"], summary["runs"]
            rate = summary["rates"]["cycle"]["interval"]
            for mine, end in zip(intervals.garwood(cycles), ("low", "high")):
                self.assertAlmostEqual(rate[end], 1e6 * mine / runs, 6)
            share = summary["misjudged_share"]
            low, high = intervals.clopper_pearson(summary["misjudged"], summary["audited"])
            self.assertAlmostEqual(share["low"], low, 9)
            self.assertAlmostEqual(share["high"], high, 9)
            text = program.text("status", Path(folder) / "s")
            self.assertIn(f"{markdown.rate(cycles, runs)} in a million runs", " ".join(text.split()))
            self.assertIn("lower bounds", text)


class Figures(unittest.TestCase):
    def test_the_documents_are_there(self):
        known = [figure.name for figure in [*figures.BLOCKS, *figures.MEASUREMENTS]]
        self.assertGreater(len(DOCUMENTS), 15)
        self.assertEqual(len(set(known)), len(known))
        self.assertLessEqual({figure.file for figure in figures.BLOCKS}, set(DOCUMENTS))

    def test_nothing_is_refused_and_no_measured_number_stands_outside(self):
        self.assertEqual(figures.refusals(PROGRAM), [])


class Pages(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        for name in DOCUMENTS:
            page = figures.ROOT / name
            text = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
            for target in re.findall(r"\]\(([^)\s#]+)[^)\s]*\)", text):
                if not target.startswith("http"):
                    self.assertTrue((page.parent / target).exists(), f"{name}: {target}")

    def test_the_readme_is_short(self):
        text = (figures.ROOT / "README.md").read_text()
        self.assertLess(len(text.split()), 700)
        self.assertIn("](corpus/scenes/block-in-a-valley-loop.svg)", text)


if __name__ == "__main__":
    del sys.argv[1:3]
    unittest.main()
