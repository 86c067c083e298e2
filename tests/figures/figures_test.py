# SPDX-License-Identifier: Apache-2.0
"""The figures in the text: what their blocks refuse, their intervals, and that no block is refused now.

Takes the path of the program, and that of the sources, as the other scripts do."""

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
from registry import DOCUMENTS, FIGURES, Figure  # noqa: E402

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(figures.ROOT / "build/release/stiction")


def counted(program):
    program.show("./run count")
    return "| problems |\n| --- |\n| 17 |"


CHEAP = Figure("cheap-one", "README.md", "cheap", counted)
COSTLY = Figure("costly-one", "README.md", "minutes", counted, ("algorithm", "search/algorithm_version.h"))


def block(figure):
    """As refresh writes it."""
    return figures.written(figure, figures.made(figure, PROGRAM), PROGRAM)


def refused(figure, content):
    return figures.refused_block(figure, *figures.blocks_of(content)[figure.name], PROGRAM)


class Blocks(unittest.TestCase):
    def test_a_block_as_it_was_made_is_not_refused(self):
        for figure in (CHEAP, COSTLY):
            self.assertEqual(refused(figure, f"before\n{block(figure)}\nafter"), "")

    def test_a_block_says_its_command_and_its_commit(self):
        facts, text = figures.blocks_of(block(COSTLY))["costly-one"]
        self.assertIn("`./run count`", text)
        self.assertEqual(facts["commit"], figures.commit(PROGRAM))

    def test_a_number_that_was_changed_is_refused(self):
        for figure in (CHEAP, COSTLY):
            self.assertNotEqual(refused(figure, block(figure).replace("| 17 |", "| 18 |")), "")

    def test_a_costly_block_is_stale_when_its_sources_have_changed(self):
        content = block(COSTLY)
        code = figures.code_digest(COSTLY.sources)
        self.assertIn("stale", refused(COSTLY, content.replace(f"digest: {code}", "digest: 00000000")))

    def test_a_costly_block_can_be_withdrawn_and_a_cheap_one_cannot(self):
        for figure, reason in ((COSTLY, ""), (CHEAP, "is not what its commands give now")):
            text = figures.WITHDRAWN.format(figure.name)
            self.assertEqual(refused(figure, figures.written(figure, text, PROGRAM)), reason)

    def test_a_program_of_other_sources_makes_no_costly_block(self):
        with tempfile.TemporaryDirectory() as folder:
            version = Path(folder) / "program"
            version.write_text("#!/bin/sh\necho stiction 0.1.0 0123456789ab, GNU 12.2.0\n")
            version.chmod(0o700)
            self.assertEqual(figures.commit(str(version)), "0123456")
            self.assertFalse(figures.built_of_these_sources(COSTLY, str(version)))

    def test_what_tells_how_far_a_suite_is_is_no_part_of_a_digest(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "suite.cpp"
            file.write_text('#include "bench/suite.h"\n\nint Run() {\n  return Count(7);\n}\n')
            plain = figures.significant(file)
            file.write_text('#include "bench/progress.h"\n#include "bench/suite.h"\n\nint Run() {\n'
                            '  progress::Begin(fmt::format("{} contacts", 7),\n                  7 * problems);\n'
                            '  fmt::print(stderr, "{} problems\\n", problems);\n  return Count(7);\n}\n')
            self.assertEqual(figures.significant(file), plain)
            for line in ("  Done(1);", "  const auto count = progress::Done();", '  fmt::print("a row");'):
                file.write_text(f'#include "bench/suite.h"\n\nint Run() {{\n{line}\n  return Count(7);\n}}\n')
                self.assertNotEqual(figures.significant(file), plain)

    def test_comments_and_layout_are_no_part_of_a_digest_and_the_version_is(self):
        def digest(text):
            (figures.ROOT / "search/algorithm_version.h").write_text(text)
            return figures.code_digest(COSTLY.sources), figures.code_digest(["algorithm"])

        with tempfile.TemporaryDirectory() as folder:
            self.addCleanup(setattr, figures, "ROOT", figures.ROOT)
            figures.ROOT = Path(folder)
            (figures.ROOT / "search").mkdir()
            first = digest("// A comment.\ninline constexpr int kAlgorithmVersion = 1;\n")
            same = digest("//  Another,\n// longer.\ninline constexpr   int kAlgorithmVersion = 1;\n")
            self.assertEqual(same, first)
            second = digest("inline constexpr int kAlgorithmVersion = 2;\n")
            self.assertTrue(all(a != b for a, b in zip(first, second)))

    def test_what_is_no_block_of_the_registry_is_refused(self):
        self.assertIn("says cost minutes", refused(CHEAP, block(CHEAP).replace("cost: cheap", "cost: minutes")))
        unclosed = block(CHEAP).replace("end of figures: cheap-one", "end of figures: other")
        self.assertEqual(figures.blocks_of(unclosed), {})

    def test_a_block_takes_the_place_of_the_one_before(self):
        old = block(CHEAP).replace("17", "16")
        new = figures.replace(f"a\n{old}\nb", CHEAP, figures.made(CHEAP, PROGRAM), PROGRAM)
        self.assertEqual(new, f"a\n{block(CHEAP)}\nb")


class LooseFigures(unittest.TestCase):
    def found(self, text):
        return [line.split("'")[1] for line in figures.loose_figures("README.md", text)]

    def test_measured_numbers_outside_of_blocks_are_found(self):
        for text, number in (("it took 8.1 s", "8.1 s"), ("2.5 % of them", "2.5 %"), ("1,234 times", "1,234"),
                             ("solved 3 of 17", "3 of 17"), ("loops under 900 policies", "900 policies")):
            self.assertEqual(self.found(text), [number], text)

    def test_blocks_code_and_definitions_are_let_be(self):
        for text in (block(CHEAP).replace("17", "1,700"), "    ./run search    # 8 s", "`1,234`", "<!-- 1,234 -->",
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
        self.assertGreater(len(DOCUMENTS), 15)
        self.assertEqual(len({figure.name for figure in FIGURES}), len(FIGURES))
        self.assertLessEqual({figure.file for figure in FIGURES}, set(DOCUMENTS))

    def test_no_block_is_refused_and_no_measured_number_stands_outside(self):
        self.assertEqual(list(figures.refusals(PROGRAM, FIGURES)), [])


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
