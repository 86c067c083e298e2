#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Mutation testing: bugs of one line, one at a time, and which test catches each.

The table of bugs is mutants.py. A copy of the sources is made in which every bug stands beside what it replaces,
chosen at run time by an environment variable (mutant.h), and the copy is built once. All tests have to pass without
a bug. Then each bug: the tests that the table expects to catch it, the quickest first, and if none does, all others.
A test that takes too long, or crashes, has caught it. reports/measured/mutation.md has the figures.

exit status: 0 if at least 95 % are caught and every survivor has a reason in the table, otherwise 1.
Python standard library only.
"""

import argparse
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import namedtuple
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

sys.dont_write_bytecode = True  # beside the sources

from mutants import LABELS, MUTANTS, PROGRAMS, PYTHON  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("bench", "certify", "cli", "cmake", "corpus", "python", "reports", "scene", "search", "solver",
           "tests")
TARGETS = ("stiction", "stiction-ipopt", "stiction-bench", "stiction_python", "stiction_python_package",
           *(f"test_{label}" for label in LABELS))
INCLUDE = '#include "tests/mutation/mutant.h"\n'
FLAGS = "-O1 -fno-ivopts -DNDEBUG"  # built in half of the time; ivopts of gcc 12 at -O1 miscompiles a generator
LEAST_SHARE = 0.95
MEMORY = 6 << 30  # bytes of address space of a test


# --- The mutated sources -----------------------------------------------------------

class Refused(Exception):
    """The table does not fit the sources."""


def place(mutant, text):
    """Where the original stands: once in the file, or once in the context, which stands once in the file."""
    within = mutant.context or mutant.original
    for part, whole, where in ((within, text, mutant.file), (mutant.original, within, "its context")):
        if whole.count(part) != 1:
            raise Refused(f"{mutant.id}: found {whole.count(part)} times in {where}, expected once: {part!r}")
    begin = text.index(within) + within.index(mutant.original)
    return begin, begin + len(mutant.original)


def is_expression(code):
    """As far as one can tell without a compiler: nothing, half of a ?:, a statement or an operator without its operand is none."""
    code = re.sub(r'"[^"]*"|\'[^\']*\'', "0", code).strip()
    body = re.sub(r"\{.*\}", "{}", code)
    return (code != "" and ";" not in body and not re.match(r"(return|if|for|while|else)\b", code)
            and not re.match(r"([/%+<>=|^?:,]|[*&-] |&&)", code) and not re.search(r"[&|+*/%<>=^?:,!~-]$", code)
            and body.count("?") <= len(re.findall(r"(?<!:):(?!:)", body)))


def check_form(mutant):
    """Only an expression, or statements that declare nothing, can be chosen between."""
    for code in (mutant.original, mutant.mutated):
        depth = 0
        for letter in re.sub(r"'.'", "", code):
            depth += (letter in "({[") - (letter in ")}]")
            if depth < 0:
                break
        if depth != 0:
            raise Refused(f"{mutant.id}: found a bracket without its partner in {code!r}")
        if code.endswith(";") and re.match(r"(const|auto|bool|int)\b", code):
            raise Refused(f"{mutant.id}: found a declaration, expected its value alone: {code!r}")
        if not mutant.original.endswith(";") and not is_expression(code):
            raise Refused(f"{mutant.id}: found {code!r}, expected an expression, since what it replaces ends in no ';'")


def numbered():
    """(number, mutant), from 1."""
    return list(enumerate(MUTANTS, 1))


def replacement(original, alternatives):
    """The code for the original and the mutants (number, mutant) that replace it."""
    if original.endswith(";"):
        chain = "".join(f"if (MUTANT({number})) {{ {mutant.mutated} }} else " for number, mutant in alternatives)
        return f"{{ {chain}{{ {original} }} }}"
    as_type = alternatives[0][1].type or ""
    chain = "".join(f"MUTANT({number}) ? {as_type}({mutant.mutated}) : " for number, mutant in alternatives)
    return f"({chain}{as_type}({original}))"


def mutated_text(file, text, mutants):
    """The file with all its mutants (number, mutant) in it."""
    spots = {}
    for number, mutant in mutants:
        spots.setdefault(place(mutant, text), []).append((number, mutant))
    order = sorted(spots)
    for left, right in zip(order, order[1:]):
        if left[1] > right[0]:
            raise Refused(f"{spots[left][0][1].id}, {spots[right][0][1].id}: overlap in {file}")
    for begin, end in reversed(order):
        text = text[:begin] + replacement(text[begin:end], spots[begin, end]) + text[end:]
    first = text.index("#include")
    return text[:first] + INCLUDE + text[first:]


def mutated_files():
    by_file = {}
    for number, mutant in numbered():
        by_file.setdefault(mutant.file, []).append((number, mutant))
    return {file: mutated_text(file, (ROOT / file).read_text(), mutants) for file, mutants in by_file.items()}


def check_table():
    ids = [mutant.id for mutant in MUTANTS]
    for name in ids:
        if ids.count(name) > 1:
            raise Refused(f"{name}: an id that stands twice")
    for mutant in MUTANTS:
        check_form(mutant)
    return len(mutated_files())


def write_if_other(path, data):
    """So that what is the same is not built again."""
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def copy_sources(target):
    """The sources, with the mutants; what is no longer there goes."""
    mutated, kept = mutated_files(), set()
    folders = [path for name in SOURCES for path in (ROOT / name).rglob("*") if path.is_file()]
    for path in [ROOT / "CMakeLists.txt", ROOT / "CITATION.cff", *folders]:
        name = path.relative_to(ROOT)
        if "__pycache__" in name.parts:
            continue
        kept.add(target / name)
        data = mutated[str(name)].encode() if str(name) in mutated else path.read_bytes()
        write_if_other(target / name, data)
        shutil.copymode(path, target / name)
    for path in [path for path in target.rglob("*") if path.is_file() and path not in kept]:
        path.unlink()


def build(folder, jobs):
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    binary = folder / "build"
    subprocess.run(["cmake", *generator, "-S", folder / "sources", "-B", binary, "-DCMAKE_BUILD_TYPE=Release",
                    "-DSTICTION_WERROR=OFF", "-DSTICTION_PYTHON=ON", "-DCMAKE_CXX_FLAGS=-w", f"-DCMAKE_CXX_FLAGS_RELEASE={FLAGS}"],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", binary, "--parallel", str(jobs), "--target", *TARGETS], check=True)
    return binary


# --- Tests -------------------------------------------------------------------------

Test = namedtuple("Test", "name command folder skip environment")
Result = namedtuple("Result", "how seconds output")  # how: passed, failed, skipped, crashed, too slow


def tests_of(binary):
    """Those that the run chooses from."""
    listed = subprocess.run(["ctest", "--test-dir", binary, "--show-only=json-v1"], check=True, capture_output=True)
    tests = []
    for entry in json.loads(listed.stdout)["tests"]:
        properties = {item["name"]: item["value"] for item in entry.get("properties", [])}
        program = re.fullmatch("program: (.*)", entry["name"])
        labels = set(properties.get("LABELS", []))
        if "python" in labels:
            wanted = Path(entry["command"][1]).name in PYTHON
        else:
            wanted = program[1] in PROGRAMS if program else labels & set(LABELS)
        if wanted and "command" in entry:
            name = re.sub(r"^(\w+): *", r"\1: ", entry["name"])  # blanks behind a prefix can get lost
            tests.append(Test(name, entry["command"], properties.get("WORKING_DIRECTORY", binary),
                              properties.get("SKIP_REGULAR_EXPRESSION"),
                              dict(setting.split("=", 1) for setting in properties.get("ENVIRONMENT", []))))
    return tests


def prepare_process():
    """Before a test: little memory, and Ctrl-C heard even where the run itself is in the background."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


@contextmanager
def scratch_folder():
    """Of a short name, since some commands name many files; as open as /tmp, for tests that drop their rights."""
    with tempfile.TemporaryDirectory(prefix="m") as folder:
        os.chmod(folder, 0o1777)
        yield folder


def run_test(test, number, seconds, scratch):
    """One test in a process group of its own, with the bug of this number, 0 for none."""
    environment = {**os.environ, **test.environment, "STICTION_MUTANT": str(number), "TMPDIR": str(scratch)}
    before = time.monotonic()
    process = subprocess.Popen(test.command, cwd=test.folder, env=environment, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                               preexec_fn=prepare_process)
    try:
        output = process.communicate(timeout=seconds)[0].decode(errors="replace")
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return Result("too slow", time.monotonic() - before, "")
    took = time.monotonic() - before
    if process.returncode < 0 or "SIGFPE" in output or "SIGSEGV" in output or "SIGABRT" in output:
        return Result("crashed", took, output)
    skipped = any(re.search(pattern, output) for pattern in test.skip or ())
    return Result("passed" if process.returncode == 0 else "skipped" if skipped else "failed", took, output)


def run_baseline(tests, jobs):
    """Seconds by name, of those that are not skipped. Ends the program if a test does not pass without a bug."""
    def run(test):
        with scratch_folder() as scratch:
            return run_test(test, 0, 900, scratch)

    with ThreadPoolExecutor(jobs) as pool:
        results = list(pool.map(run, tests))
    failed = [(test, result) for test, result in zip(tests, results) if result.how not in ("passed", "skipped")]
    for test, result in failed:
        print(f"without a bug: {test.name}: {result.how}\n{result.output[-3000:]}")
    if failed or not tests:
        sys.exit(f"{len(failed)} of {len(tests)} tests do not pass without a bug")
    return {test.name: result.seconds for test, result in zip(tests, results) if result.how == "passed"}


# --- Mutants -----------------------------------------------------------------------

Verdict = namedtuple("Verdict", "test how seconds run")  # test None: survived; run: number of tests


def judge(number, mutant, tests, seconds):
    """The likely tests first. One that is known to be equivalent is shown to those alone."""
    likely = [test for test in tests if re.search(mutant.tests, test.name)]
    others = [] if mutant.equivalent else [test for test in tests if test not in likely]
    quickest = sorted(likely, key=lambda test: seconds[test.name]) + sorted(others, key=lambda test: seconds[test.name])
    before = time.monotonic()
    with scratch_folder() as scratch:
        for count, test in enumerate(quickest, 1):
            result = run_test(test, number, 20 + 10 * seconds[test.name], scratch)
            if result.how != "passed":
                return Verdict(test.name, result.how, time.monotonic() - before, count)
    return Verdict(None, "survived", time.monotonic() - before, len(quickest))


def describe(mutant, verdict):
    if verdict.test:
        how = "" if verdict.how == "failed" else f" ({verdict.how})"
        return f"{mutant.id}: caught{how} after {verdict.seconds:.1f} s: {verdict.test}"
    return f"{mutant.id}: SURVIVED {verdict.run} tests: {mutant.breaks}"


def judge_all(chosen, tests, seconds, jobs):
    printing = threading.Lock()

    def run(item):
        verdict = judge(*item, tests, seconds)
        with printing:
            print(describe(item[1], verdict), flush=True)
        return verdict

    with ThreadPoolExecutor(jobs) as pool:
        return dict(zip((mutant.id for _, mutant in chosen), pool.map(run, chosen)))


def table(chosen, verdicts):
    """Markdown: by file, mutants, caught, survivors."""
    lines = ["| file | mutants | caught | survivors |", "|---|---|---|---|"]
    for file in dict.fromkeys(mutant.file for _, mutant in chosen):
        here = [mutant for _, mutant in chosen if mutant.file == file]
        left = [mutant.id for mutant in here if verdicts[mutant.id].test is None]
        lines.append(f"| `{file}` | {len(here)} | {len(here) - len(left)} | {', '.join(left)} |")
    caught = sum(verdict.test is not None for verdict in verdicts.values())
    lines.append(f"| all | {len(verdicts)} | {caught} | {len(verdicts) - caught} |")
    return "\n".join(lines)


def report(chosen, verdicts):
    """Prints the table, and returns the exit status."""
    print("\n" + table(chosen, verdicts) + "\n")
    survivors = [mutant for _, mutant in chosen if verdicts[mutant.id].test is None]
    for mutant in survivors:
        print(f"{mutant.id}: " + (f"equivalent: {mutant.equivalent}" if mutant.equivalent else "NOT CAUGHT"))
    for _, mutant in chosen:
        if mutant.equivalent and mutant not in survivors:
            print(f"{mutant.id}: called equivalent, but caught by {verdicts[mutant.id].test}")
    hard = [how for how in ("crashed", "too slow") for verdict in verdicts.values() if verdict.how == how]
    share = 1 - len(survivors) / len(chosen)
    print(f"{100 * share:.1f} % of {len(chosen)} caught, {hard.count('crashed')} by a crash, "
          f"{hard.count('too slow')} by a time limit")
    return 0 if share >= LEAST_SHARE and all(mutant.equivalent for mutant in survivors) else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build/mutation", metavar="DIR",
                        help="where the copy and its build stand (default build/mutation)")
    parser.add_argument("--only", nargs="+", metavar="ID", help="these mutants only")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="(default: the number of cores)")
    parser.add_argument("--check", action="store_true", help="only whether the table fits the sources")
    parser.add_argument("--prepare", action="store_true", help="copy, build and run without a bug, no more")
    arguments = parser.parse_args()
    try:
        files = check_table()
    except Refused as refused:
        sys.exit(f"mutants.py: {refused}")
    if arguments.check:
        print(f"{len(MUTANTS)} mutants in {files} files, each in its place")
        return 0
    unknown = set(arguments.only or ()) - {mutant.id for mutant in MUTANTS}
    if unknown:
        sys.exit(f"no such mutant: {', '.join(sorted(unknown))}")
    before = time.monotonic()
    folder = arguments.build.resolve()
    copy_sources(folder / "sources")
    binary = build(folder, arguments.jobs)
    built = time.monotonic()
    tests = tests_of(binary)
    seconds = run_baseline(tests, arguments.jobs)
    tests = [test for test in tests if test.name in seconds]
    print(f"built in {built - before:.0f} s; {len(tests)} tests pass without a bug, {sum(seconds.values()):.0f} s")
    if arguments.prepare:
        return 0
    chosen = [(number, mutant) for number, mutant in numbered() if mutant.id in (arguments.only or [mutant.id])]
    verdicts = judge_all(chosen, tests, seconds, arguments.jobs)
    status = report(chosen, verdicts)
    print(f"{time.monotonic() - built:.0f} s of tests")
    return status


if __name__ == "__main__":
    sys.exit(main())
