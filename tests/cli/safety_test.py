# SPDX-License-Identifier: Apache-2.0
"""`certify --safe` on every scene of the corpus and on generated problems: what it says does not contradict itself,
nor the determinants of all words, found here by another elimination.

safety_test.py PATH_TO_STICTION [SOURCES]

STICTION_SAFETY_PROBLEMS: how many problems are generated, 120 if it is not set.
"""

import itertools
import os
import pathlib
import random
import sys
from fractions import Fraction

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "certify"))
import cli  # noqa: E402
from certificate_reader import planar_contacts, read_problem_file  # noqa: E402
from check_certificate import determinant, modes_of, reduced  # noqa: E402

MOST_WORDS = 4**4


def determinants(problem):
    """Of all words."""
    by_column = list(zip(*problem.A))
    return [determinant(reduced(problem, word, by_column))
            for word in itertools.product(*(modes_of(contact) for _, contact, _ in planar_contacts(problem)))]


def word_count(problem):
    return len(list(itertools.islice(itertools.product(*map(modes_of, problem.contacts)), MOST_WORDS + 1)))


def generated(draw):
    """Positive definite, or of less than full rank, with a mu that may be small."""
    contacts = draw.randint(1, 3)
    rows, columns = 2 * contacts, 2 * contacts - draw.randint(-1, 1)
    J = [[draw.randint(-3, 3) for _ in range(columns)] for _ in range(rows)]
    c = [draw.randint(-3, 3) for _ in range(columns)]
    A = [[str(sum(x * y for x, y in zip(p, q))) for q in J] for p in J]
    mu = str(Fraction(1, draw.choice([1, 1, 2, 4, 8, 16])))
    return {"format": "stiction-problem", "version": 1, "name": "p", "dimension": 2,
            "contacts": [{"kind": "static", "mu": mu}] * contacts, "A": A,
            "b": [str(sum(x * y for x, y in zip(row, c))) for row in J]}


class Safety(cli.TestCase):
    def agree(self, file):
        """What is said of the problem; fails where the determinants say otherwise."""
        said = self.succeeds("certify", file, "--safe", "--json").json()
        values = determinants(read_problem_file(file))
        self.assertEqual(said["safe"], min(values) > 0)
        if min(values) <= 0:
            self.assertEqual(said["weakly_safe"], min(values) == 0)
            self.assertEqual(said["vanishing_words"], values.count(0))
            self.assertLessEqual(said["limit"]["safe"], said["weakly_safe"])
        return said

    def test_generated_problems(self):
        draw, seen = random.Random(7), {"safe": 0, "weakly": 0, "limit": 0, "neither": 0, "condition": 0}
        for index in range(int(os.environ.get("STICTION_SAFETY_PROBLEMS", "120" if cli.ALL else "40"))):
            with self.subTest(index=index):
                file = self.file("p.json", generated(draw))
                said = self.agree(file)
                seen["safe" if said["safe"] else "weakly" if said["weakly_safe"] else "neither"] += 1
                seen["limit"] += said.get("limit", {}).get("safe", False)
                done = cli.run("certify", file, "--claim", "safe-by-condition", "-o", self.folder / "c.json")
                shown = done.code == 0 and "disproved" not in done.out
                seen["condition"] += shown
                self.assertLessEqual(shown, said["safe"])
                if done.code == 0 and not shown:
                    self.assertFalse(said["safe"])
        self.assertTrue(all(seen.values()), seen)

    def test_many_words_are_said_not_to_be_looked_at(self):
        # Seven copies of one contact: rows of a body that cannot be told apart.
        rows = [[["1", "1"], ["1", "1"]][i % 2] * 7 for i in range(14)]
        many = {**generated(random.Random(1)), "contacts": [{"kind": "static", "mu": "1"}] * 7, "A": rows, "b": ["0"] * 14}
        done = self.succeeds("certify", self.file("p.json", many), "--safe")
        self.assertIn("not looked at", done.out)

    def test_scenes_of_the_corpus_with_few_contacts(self):
        spoken = 0
        for scene in sorted((cli.ROOT / "corpus/scenes").glob("*.json")):
            file = self.folder / "p.json"
            with self.subTest(scene=scene.name):
                file.unlink(missing_ok=True)
                if cli.run("assemble", scene, "-o", file).code != 0 or not file.exists():
                    continue
                problem = read_problem_file(file)
                kinds = {contact.kind for contact in problem.contacts}
                if kinds <= {"static", "frictionless"} and word_count(problem) <= MOST_WORDS:
                    spoken += 1
                    said = self.agree(file)
                    # Two sticking contacts of one body: a singular word, of which "unsafe" alone says nothing.
                    self.assertTrue(said["safe"] or "limit" in said)
        self.assertGreater(spoken, 8)


if __name__ == "__main__":
    cli.main()
