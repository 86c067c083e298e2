# SPDX-License-Identifier: Apache-2.0
"""What a page runs again (cli/live) is what the program says, to the byte: natively, and as WebAssembly under Node.

live_test.py PATH_TO_STICTION [SOURCES]

stiction-live stands beside the program. That the committed module is what its sources give is left out where there is no
Emscripten, which `./run test --matrix` installs; all else is tested all the same, so ctest must not take it for skipped."""

import gzip
import json
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import cli

MODULE = "reports/web/solver/solver.wasm.gz"
READINGS = [("baraff", "paper"), ("baraff", "give-up=second,ties=contacts"), ("baraff", "resume=round,file=yes"),
            ("complete", "paper"), ("lemke", "paper")]
MOST_BYTES = 2_000_000  # that a page may grow by


def planar_corpus():
    """The planar problems of the corpus, as they are, and with numbers of all spellings."""
    for folder in ("", "sliding", "endless"):
        for file in sorted((cli.ROOT / "corpus" / folder).glob("*.json")):
            problem = json.loads(file.read_text())
            if problem["format"] != "stiction-problem" or problem["dimension"] != 2:
                continue
            problem.pop("scene", None)  # of which a page has a picture
            yield problem
            if problem["b"]:
                yield dict(problem, name=f"{problem['name']}-edited", b=["-0.125", *problem["b"][1:-1], "7/30"])


def request(problem, method="baraff", policy="paper"):
    return {"ask": "run", "problem": problem if isinstance(problem, str) else json.dumps(problem), "method": method,
            "policy": policy}


class Native:
    def answers(self, requests):
        return lines([Path(cli.program).with_name("stiction-live")], requests)


class Module:
    def answers(self, requests):
        assert shutil.which("node") is not None, "expected node: apt-get install nodejs"
        return lines(["node", cli.ROOT / "cli/live/lines.mjs", cli.ROOT / MODULE], requests)


def lines(command, requests):
    done = subprocess.run(command, input="".join(json.dumps(request) + "\n" for request in requests), text=True,
                          capture_output=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@unittest.skipIf(cli.SHORT, "the program is the same in every build, and stiction-live is built in the first")
class Live(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        limits = json.loads(Native().answers([{"ask": "switches"}])[0])["limits"]
        cls.limits = [word for name, value in limits.items() for word in (f"--{name}", str(value))]

    def page_data(self, problem, method, policy):
        """As the program puts it into a page."""
        file = self.file("problem.json", problem)
        done = cli.run("replay", file, "--html", "-", "--method", method, "--policy", policy, *self.limits)
        self.assertIn(done.code, (0, 1, 3), done.err)
        data = re.search(r'<script type="application/json" id="data">(.*?)</script>', done.out, re.S)[1]
        return data.replace("\\u003c", "<")

    def test_it_says_what_the_program_says_to_the_byte(self):
        cases = [(problem, *reading) for problem in planar_corpus() for reading in READINGS]
        self.assertGreater(len(cases), 300)
        expected = ['{"data":' + self.page_data(*case) + "}" for case in cases]
        for runner in (Native(), Module()):
            answers = runner.answers([request(*case) for case in cases])
            self.assertEqual(len(answers), len(cases))
            for (problem, *reading), answer, one in zip(cases, answers, expected, strict=True):
                self.assertTrue(answer == one, f"{type(runner).__name__}: {problem['name']}, {reading}:\n"
                                               f"{answer[:300]}\n{one[:300]}")

    def test_what_is_wrong_is_named(self):
        loop = cli.REFERENCE
        wrong = [
            (dict(loop, b=["2", "x", "-2", "2"]), 'problem: b[1]: found "x", expected a number, such as'),
            (dict(loop, A=[["7", "-2", "-6", ""], *loop["A"][1:]]), 'problem: A[0][3]: found ""'),
            (dict(loop, b=["1/0", "0", "0", "0"]), 'problem: b[0]: found "1/0"'),
            (dict(loop, b=["1e20000", "0", "0", "0"]), 'problem: b[0]: found "1e20000"'),
            (dict(loop, contacts=[{"kind": "static", "mu": "-1"}, loop["contacts"][1]]),
             'problem: contacts[0].mu: found "-1", expected mu >= 0'),
            (dict(loop, contacts=[{"kind": "glued"}, loop["contacts"][1]]), 'problem: contacts[0].kind: found "glued"'),
            (json.loads((cli.ROOT / "corpus/space/cycle-under-both-slips.json").read_text()), "dimension: found 3, expected 2"),
            (self.large(65), "contacts: found 65 rows, expected at most 64"),
            ("{", "problem: line 1, column 2"),
        ]
        bad = [*(request(problem) for problem, _ in wrong), request(loop, policy="ties=none"), request(loop, "guess"),
               {"ask": "nothing"}, {}]
        says = [*(text for _, text in wrong), "ties", "guess", "expected run or switches", "request: ask: found nothing"]
        for runner in (Native(), Module()):
            for answer, text in zip(runner.answers(bad), says, strict=True):
                error, = json.loads(answer).items()
                self.assertEqual(error[0], "error")
                self.assertIn(text, error[1])
            # And it goes on.
            first, again = runner.answers([bad[0], request(loop)])
            self.assertEqual(json.loads(again)["data"]["runs"][0]["replay"]["outcome"], "cycle")

    @staticmethod
    def large(n):
        """n contacts without friction."""
        return {"format": "stiction-problem", "version": 1, "name": "large", "dimension": 2,
                "contacts": [{"kind": "frictionless"}] * n,
                "A": [["1" if i == j else "0" for j in range(n)] for i in range(n)], "b": ["-1"] * n}

    def test_an_endless_run_ends_in_a_limit_that_is_said(self):
        endless, = (cli.ROOT / "corpus/endless").glob("*.json")
        problem = json.loads(endless.read_text())
        for runner in (Native(), Module()):
            answer, = runner.answers([request(problem, policy="resume=round")])
            run = json.loads(answer)["data"]["runs"][0]
            self.assertEqual(run["replay"]["outcome"], "limit")
            self.assertRegex(run["end"], "^limit: out of ")

    def test_a_page_grows_by_less_than_it_may(self):
        self.assertLess(4 * (cli.ROOT / MODULE).stat().st_size / 3, MOST_BYTES)

    def test_the_sources_give_the_committed_module(self):
        if shutil.which("emcc") is None:
            self.skipTest("no Emscripten")
        out = self.folder / "solver.wasm.gz"
        done = subprocess.run([sys.executable, cli.ROOT / "cli/live/build.py", out], capture_output=True, text=True,
                              timeout=900)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(gzip.decompress(out.read_bytes()) == gzip.decompress((cli.ROOT / MODULE).read_bytes()),
                        "expected what python3 cli/live/build.py gives")


if __name__ == "__main__":
    cli.main()
