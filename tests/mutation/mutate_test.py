# SPDX-License-Identifier: Apache-2.0
"""The mutation run, on a project of one source: what is drawn, what does not compile, what is not covered, what survives."""

import contextlib
import io
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True

import draw  # noqa: E402
import mutate  # noqa: E402

SOURCE = """#include "solver/clamp.h"

// The bound that x < least is beyond; "x < y" is no relation here.
int Clamp(int x, int least, int most) {
  const int seen = least + most;
  if (x < least && seen > 0) return least;
  if (x > most) return most;
  return x;
}

int NeverCalled(int x) {
  return x - 1;
}

Tag Tagged() {
  Tag tag(7);
  return tag;
}

constexpr int Twice(int k) {
  return k + k;
}
static_assert(Twice(2) == 4);
"""
HEADER = """#pragma once
struct Tag {
  explicit Tag(int k) : k(k) {}
  int k;
};
int Clamp(int x, int least, int most);
Tag Tagged();
"""
TEST = """#include "solver/clamp.h"
int main() {
  const bool right = Clamp(5, 1, 3) == 3 && Clamp(0, 1, 3) == 1 && Clamp(2, 1, 3) == 2 && Tagged().k == 7;
  return right ? 0 : 1;
}
"""
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(clamp CXX)
set(CMAKE_CXX_STANDARD 20)
enable_testing()
add_executable(test_solver tests/clamp_test.cpp solver/clamp.cpp)
target_include_directories(test_solver PRIVATE .)
add_test(NAME "solver: clamp" COMMAND test_solver)
set_tests_properties("solver: clamp" PROPERTIES LABELS solver)
"""


def sites(text):
    return {(site.kind, text[site.begin:site.end], site.mutated) for line in draw.Source(text).sites().values() for site in line}


class Draw(unittest.TestCase):
    def test_an_operator_has_the_operands_that_its_precedence_gives_it(self):
        found = sites("bool F() {\n  return a + b * c < -d && (e || f);\n}\n")
        self.assertIn(("relation", "a + b * c < -d", "a + b * c <= -d"), found)
        self.assertIn(("clause", "a + b * c < -d && (e || f)", "a + b * c < -d"), found)
        self.assertIn(("clause", "e || f", "e"), found)
        self.assertIn(("sign", "return a + b * c < -d && (e || f);", "return a - b * c < -d && (e || f);"), found)

    def test_brackets_of_templates_comments_and_strings_are_no_code(self):
        self.assertEqual(sites('int x;\n// a < b + 1\nstd::vector<int> y = Make<2>("1 + 1");\n'), set())

    def test_declarations_keep_their_names(self):
        found = sites("void F() {\n  const int x = a + 1;\n  y = 1;\n}\n")
        self.assertIn(("sign", "a + 1", "a - 1"), found)
        self.assertIn(("constant", "y = 1;", "y = 0;"), found)

    def test_one_seed_draws_the_same_and_another_seed_others(self):
        drawn = [[site for _, _, site in draw.draw({"solver/clamp.cpp": SOURCE}, seed)] for seed in (1, 1, 2)]
        self.assertEqual(drawn[0], drawn[1])
        self.assertNotEqual(drawn[0], drawn[2])


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="stiction-mutate-")
        self.addCleanup(folder.cleanup)
        root = Path(folder.name)
        for name, text in (("CMakeLists.txt", PROJECT), ("solver/clamp.cpp", SOURCE), ("solver/clamp.h", HEADER),
                           ("tests/clamp_test.cpp", TEST)):
            (root / name).parent.mkdir(exist_ok=True)
            (root / name).write_text(text)
        (root / "tests/mutation").mkdir()
        shutil.copy(Path(mutate.__file__).parent / "mutant.h", root / "tests/mutation")
        for name, value in (("ROOT", root), ("SOURCES", ("solver", "tests")), ("DRAWN_FROM", ("solver",)),
                            ("TARGETS", ("test_solver",))):
            before = getattr(mutate, name)
            self.addCleanup(setattr, mutate, name, before)
            setattr(mutate, name, value)
        self.root = root

    def test_a_run(self):
        drawn = mutate.drawn(30, 1, [])
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            binary, compiled = mutate.build(self.root / "build", drawn, 2)
            tests = mutate.tests_of(binary)
            baseline = mutate.run_baseline(tests, 1)
            reached = baseline["solver: clamp"].reached
            chosen = [mutant for mutant in compiled if mutant.number in reached]
            verdicts = mutate.judge_all(chosen, tests, baseline, 1)
            mutate.report("drawn", chosen, verdicts, lambda mutant: mutant.id.split()[-1], 0.9)
        self.assertLess(len(compiled), len(drawn), "return {}; of a Tag does not compile")
        self.assertIn("does not compile: solver/clamp.cpp", said.getvalue())
        twice = [any("k + k" in mutant.breaks for mutant in some) for some in (drawn, compiled)]
        self.assertEqual(twice, [True, False], "no constant expression, which the compiler says at the end of the function")
        self.assertTrue(any("x - 1" in mutant.breaks for mutant in compiled if mutant not in chosen), "not covered")
        by_change = {mutant.breaks: verdicts[mutant.id].test for mutant in chosen}
        self.assertEqual(by_change["x > most  ->  x >= most"], None)
        self.assertEqual(by_change["x < least && seen > 0  ->  x < least"], None)
        self.assertTrue(any(test for test in by_change.values()))
        self.assertIn("noticed", said.getvalue())


class Hand(unittest.TestCase):
    def test_a_row_is_a_whole_expression(self):
        """Half of a call would not compile, or be no Python."""
        for original, mutated in (("need(x > 0", "need(x != 0"), ("g(a), b)", "g(a))")):
            row = mutate.HAND[0]._replace(original=original, mutated=mutated)
            with mock.patch.object(mutate, "HAND", [row]), self.assertRaisesRegex(mutate.Refused, "a bracket alone"):
                mutate.by_hand()

    def test_a_place_is_found_in_its_function_whatever_file_has_it(self):
        texts = {"a.cpp": SOURCE, "b.py": "def f(x):\n    return x < 1\n\n\ndef g(x):\n    return x < 1\n"}
        row = mutate.HAND[0]._replace(function="Clamp", original="x > most")
        file, begin, end = mutate.place(row, texts)
        self.assertEqual((file, SOURCE[begin:end]), ("a.cpp", "x > most"))
        file, begin, _ = mutate.place(row._replace(function="g", original="x < 1"), texts)
        self.assertEqual((file, texts[file][:begin].count("\n")), ("b.py", 5))
        for function, original in (("Clamp", "x"), ("Clamp", "nothing"), ("Nowhere", "x")):
            with self.assertRaises(mutate.Refused):
                mutate.place(row._replace(function=function, original=original), texts)


if __name__ == "__main__":
    unittest.main()
