# SPDX-License-Identifier: Apache-2.0
"""./run, in a folder where a program is built and another build is at work: nothing that needs no build waits for it.

run_test.py PATH_TO_STICTION
"""

import fcntl
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

import cli

# Says what it was called with.
PROGRAM = '#!/bin/sh\necho "called: $*"\n'


@unittest.skipIf(cli.SHORT, "the script is the same for every build")
class WhileAnotherBuilds(cli.TestCase):
    def setUp(self):
        super().setUp()
        shutil.copy(cli.ROOT / "run", self.folder / "run")
        self.build = self.folder / "build/release"
        self.build.mkdir(parents=True)
        # No package is asked for: a Debian without them is another test's.
        tools = self.folder / "tools"
        tools.mkdir()
        for tool in ("dirname", "readlink", "mkdir", "flock", "cat", "sleep"):
            (tools / tool).symlink_to(shutil.which(tool))
        self.environment = {**os.environ, "PATH": str(tools)}
        self.holder = os.open(self.build, os.O_RDONLY)
        self.addCleanup(os.close, self.holder)
        fcntl.flock(self.holder, fcntl.LOCK_EX)

    def make(self, *names):
        for name in names:
            (self.build / name).write_text(PROGRAM)
            (self.build / name).chmod(0o755)

    def called(self, *words, seconds=20):
        return subprocess.run([shutil.which("bash"), self.folder / "run", *words], env=self.environment, text=True,
                              capture_output=True, timeout=seconds)

    def test_help_and_a_program_that_is_there_do_not_wait(self):
        self.make("stiction", "stiction-ipopt")
        for words, said in ((["help"], "called: help"), (["--help"], "called: help"), ([], "called: help"),
                            (["help", "solve"], "called: help solve"), (["solve", "--help"], "called: help solve"),
                            (["solve", "-h"], "called: help solve"), (["solve", "x.json"], "called: solve x.json")):
            with self.subTest(words=words):
                done = self.called(*words)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(said, done.stdout)
        self.assertIn("another build is at work", self.called("solve", "x.json").stderr)

    def test_a_search_has_a_program_of_its_own(self):
        self.make("stiction-search", "stiction-ipopt")
        for words, said in ((["search", "--minutes", "1"], "called: search --minutes 1"), (["status", "S"], "called: status S"),
                            (["help", "search"], "called: help search"), (["search", "--help"], "called: help search")):
            with self.subTest(words=words):
                done = self.called(*words)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(said, done.stdout)
        with self.assertRaises(subprocess.TimeoutExpired):  # whose program is built first
            self.called("solve", "x.json", seconds=2)

    def test_a_build_for_searches_is_taken_further(self):
        """Without a lock that another build has, and with a cmake that says how it was called to configure."""
        calls, presets = self.folder / "calls", self.folder / "CMakePresets.json"
        shutil.copy(cli.ROOT / "CMakePresets.json", presets)
        cmake = f'[ $1 != -N ] || exec {shutil.which("cmake")} "$@"; echo "$@" >>{calls}; touch {self.build}/build.ninja'
        for tool, text in (("cmake", cmake), ("ninja", "exit 0")):
            path = self.folder / "tools" / tool
            path.write_text(f"#!{shutil.which('bash')}\n{text}\n")
            path.chmod(0o755)
        for tool in ("awk", "nproc", "touch"):
            (self.folder / "tools" / tool).symlink_to(shutil.which(tool))
        fcntl.flock(self.holder, fcntl.LOCK_UN)
        self.make("stiction", "stiction-search", "stiction-ipopt")
        def configured(*verbs):
            calls.write_text("")
            for verb in verbs:
                self.assertEqual(self.called(verb).returncode, 0)
            return [call[call.index("--preset"):] for call in calls.read_text().splitlines()]
        self.assertEqual(configured("search", "search", "solve", "solve", "search"),
                         ["--preset search-only --fresh",
                          "--preset release"])  # --fresh would throw away what is compiled
        presets.write_text(presets.read_text().replace("-O1", "-O2"))  # of builds of other presets
        self.assertEqual(configured("solve"), [])
        presets.write_text(presets.read_text().replace('"Release"', '"RelWithDebInfo"'))
        self.assertEqual(configured("solve", "solve"), ["--preset release --fresh"])

    def test_help_of_what_is_not_built(self):
        """The verbs are read from their sources: those of a program that is built, by the same jobs."""
        for tool in ("fold", "grep", "sed", "sort", "tr"):
            (self.folder / "tools" / tool).symlink_to(shutil.which(tool))
        (self.folder / "cli").symlink_to(cli.ROOT / "cli")
        done = self.called("help")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("./run test", done.stdout)
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 80)
        listed, group = [], ""
        for line in done.stdout.replace("\n" + 13 * " ", "").splitlines():
            group = line[:-1] if line.endswith(":") else group
            if line.startswith("  "):
                listed.append((group, *line.split(maxsplit=1)))
        verbs = self.succeeds("manual", "--json").json()
        self.assertEqual(listed, [(verb["group"], verb["verb"], verb["purpose"]) for verb in verbs])
        done = self.called("help", "solve")
        self.assertEqual((done.returncode, done.stdout), (0, "  solve      Solve problems\n"))
        self.assertIn("nothing is built yet; ./run solve --help", done.stderr)
        self.assertEqual(self.called("help", "slove").returncode, 2)
        self.assertIn("--if-changed", self.called("help", "prove").stdout)
        for verb, option in (("test", "--nightly"), ("prove", "--if-changed"), ("release", "solver"), ("site", "-o DIR")):
            for word in ("-h", "--help"):  # asks for help alone: nothing is built, tested or proved
                self.assertIn(option, self.called(verb, word).stdout)

    def test_a_program_that_is_not_there_is_waited_for(self):
        self.make("stiction")  # but not stiction-ipopt
        with self.assertRaises(subprocess.TimeoutExpired) as waited:
            self.called("solve", "x.json", seconds=2)
        self.assertIn(b"waiting for another build", waited.exception.stderr)


def function_of_run(name):
    """A function of the script, as bash reads it."""
    script = (cli.ROOT / "run").read_text()
    function = script[script.index(f"\n{name}() {{") + 1:]
    return function[:function.index("\n}\n") + 3]


def is_gone(process):
    """Or dead, where nobody waits for it."""
    try:
        return "State:\tZ" in Path(f"/proc/{process}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return True


class OfTests(cli.TestCase):
    def test_what_failed_is_shown_as_it_was_printed(self):
        failed = self.file("failed", "12:corpus case: a\n")
        log = self.file("log", "1/3 Testing: corpus case: ab\nfine\n2/3 Testing: corpus case: a\nbroken\nTest Failed.\n"
                               "3/3 Testing: corpus case: b\nfine\n")
        shown = subprocess.run(["bash", "-c", function_of_run("outputs_of_tests") + 'outputs_of_tests "$@"', "bash", failed, log], text=True,
                               capture_output=True, check=True).stdout
        self.assertEqual(shown, "2/3 Testing: corpus case: a\nbroken\nTest Failed.\n")


class Presets(cli.TestCase):
    def test_each_is_configured_built_and_tested_by_its_name_with_options_that_there_are(self):
        presets = json.loads((cli.ROOT / "CMakePresets.json").read_text())
        names = {kind: [one["name"] for one in presets[f"{kind}Presets"] if not one.get("hidden")]
                 for kind in ("configure", "build", "test")}
        self.assertEqual(names["configure"], names["build"])
        self.assertEqual([name for name in names["build"] if name != "search-only"], names["test"])
        known = (cli.ROOT / "CMakeLists.txt").read_text()
        for name in names["configure"]:
            with self.subTest(name=name):
                said = subprocess.run(["cmake", "-N", "-S", cli.ROOT, "--preset", name], text=True, capture_output=True)
                self.assertEqual(said.returncode, 0, said.stderr)
                options = re.findall(r'^  (STICTION_\w+)="', said.stdout, re.M)
                self.assertIn("STICTION_PYTHON", options)
                for option in options:
                    self.assertRegex(known, rf"(?m)^(?:option|set)\({option} ")
        for configuration in re.search(r"^readonly configurations=\((.*)\)$", (cli.ROOT / "run").read_text(), re.M)[1].split():
            self.assertIn(configuration, names["configure"])


@unittest.skipIf(cli.SHORT, "the scripts are the same for every build")
class Nights(cli.TestCase):
    STEPS = ("build", "tests")

    def night(self, program, **commits):
        """What nightly.py says of a program of that commit, after steps that passed on theirs."""
        for name, commit in commits.items():
            (self.folder / f"{name}.tsv").write_text(f"{name}\t60\t0\t{commit}\n")
        script = self.folder / "stiction"
        script.write_text(f"#!/bin/sh\necho stiction 0.3.0 {program}, GNU\n")
        script.chmod(0o755)
        return subprocess.run([sys.executable, cli.ROOT / "tests/setup/nightly.py", self.folder, script, *self.STEPS], text=True,
                              capture_output=True)

    def test_a_step_that_there_is_not_is_refused(self):
        done = subprocess.run([cli.ROOT / "run", "test", "--nightly", "tests", "proof"], text=True, capture_output=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("found proof, expected steps among: build tests", done.stderr)

    def test_an_interrupted_step_of_the_model_leaves_no_attacker(self):
        attack, tests = self.folder / "tests/model/attack.py", self.folder / "build/release/tests/test_model"
        for file in (attack, tests):
            file.parent.mkdir(parents=True)
        (self.folder / "build/nightly").mkdir()
        number = self.folder / "number"  # of the attacker
        attack.write_text(f"import os, pathlib, time\npathlib.Path({str(number)!r}).write_text(str(os.getpid()))\ntime.sleep(600)\n")
        tests.write_text("#!/bin/sh\nsleep 60\n")
        tests.chmod(0o755)
        script = ("set -euo pipefail\ntrap 'exit 130' INT\nroot=$1\ncommit_number() { echo 1; }\n"
                  + function_of_run("nightly_model") + "(nightly_model) 2>&1 | cat\n")
        with subprocess.Popen(["bash", "-c", script, "bash", self.folder], start_new_session=True, stdout=subprocess.DEVNULL,
                              preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)) as step:
            self.wait_until(lambda: number.exists() and number.read_text())
            os.killpg(step.pid, signal.SIGINT)  # as a terminal does
            step.wait(30)
        self.wait_until(lambda: is_gone(int(number.read_text())))

    def test_it_is_written_only_where_all_steps_are_of_the_program_with_nothing_uncommitted(self):
        for program, commits, missing in (("abcdef0", {"build": "abcdef0"}, "tests"),
                                          ("abcdef0", {"tests": "1234567"}, "tests"),
                                          ("abcdef0", {"tests": "abcdef0-dirty"}, "tests"),
                                          ("abcdef0-dirty", {"tests": "abcdef0"}, "build tests")):
            with self.subTest(program=program, commits=commits):
                done = self.night(program, **commits)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertRegex(done.stdout, f"(?m)not written: .* were not run: {missing}$")


if __name__ == "__main__":
    cli.main()
