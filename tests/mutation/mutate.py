#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Mutation testing: bugs of one line, one at a time, and which test notices each.

    mutate.py --drawn N [--seed S]    N bugs drawn from what the tests cover (draw.py)
    mutate.py                         the bugs by hand, one for each clause of the checkers (mutants.py)
    mutate.py --hand --drawn N        both, in one build
    mutate.py --check                 only whether those by hand have their places in the sources

A copy of the sources has every bug beside what it replaces, chosen at run time by an environment variable (mutant.h). It
is built once. A drawn bug that does not compile is dropped. All tests pass without a bug, and note which bugs each of
them reaches: what none reaches is not covered, and dropped. Each bug then meets the tests that reach it, the quickest
first, until one fails, crashes or takes too long.

exit status: 0 if at least 90 % of those drawn are noticed and all of those by hand but what has a reason, otherwise 1.
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
sys.path.insert(1, str(Path(__file__).resolve().parents[1] / "figures"))

from draw import Source, draw  # noqa: E402
from intervals import clopper_pearson  # noqa: E402
from mutants import FOLDERS, HAND  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("bench", "certify", "cli", "cmake", "corpus", "reports", "scene", "search", "solver", "tests")
DRAWN_FROM = ("solver", "certify", "search", "corpus")
NOT_DRAWN_FROM = "certify/ipopt/"  # a program that includes nothing of the others
# The tests of a run: C++ by folder, programs that drive the program from outside, and what is recorded that it says.
LABELS = ("solver", "certify", "search", "corpus", "scene", "model")
PROGRAMS = ("adversary_test", "attacks_test", "certificate_test", "claims_test", "consistency_test", "coulomb_exact_test",
            "critical_test", "damage_test", "existence_test", "explain_test", "factors_test", "false_claims_test",
            "false_loops_in_space_test", "families_test", "formats_test", "input_test", "inputs_test", "kinds_test",
            "limits_test", "loops_in_space_test", "outputs_test", "package_test", "paths_test", "problem_test",
            "problems_test", "questions_test", "replay_test", "residuals_test", "rests_test", "running_test", "safety_test",
            "scene_test", "schema_test", "search_test", "simulate_test", "solve_test", "space_test", "store_test",
            "tamper_test", "terminal_test", "under_test_test", "usage_test")
TARGETS = ("stiction", "stiction-bench", "stiction-ipopt", *(f"test_{label}" for label in LABELS))
INCLUDE = '#include "tests/mutation/mutant.h"\n'
PYTHON = '''import os
_reached = os.environ.get("STICTION_REACHED")
def MUTANT(k):
    if _reached:
        with open(_reached, "r+b") as file:
            file.seek(k)
            file.write(b"1")
    return os.environ.get("STICTION_MUTANT") == str(k)
'''
FLAGS = "-O1 -fno-ivopts -DNDEBUG"  # built in half of the time; ivopts of gcc 12 at -O1 miscompiles a generator
LEAST_SHARE = 0.9
MOST_MUTANTS = 4096  # as in mutant.h
MEMORY = 6 << 30  # bytes of address space of a test

# form: expression, statement, or early, which is put before what is there; number: from 1.
Mutant = namedtuple("Mutant", "number id file begin end mutated form type breaks equivalent")


class Refused(Exception):
    """The table does not fit the sources."""


# --- Places ------------------------------------------------------------------------

def sources_in(folders):
    """Texts by name."""
    paths = [path for folder in folders
             for path in ([ROOT / folder] if (ROOT / folder).is_file() else sorted((ROOT / folder).rglob("*")))]
    return {str(path.relative_to(ROOT)): path.read_text() for path in paths if path.suffix in (".h", ".ipp", ".cpp", ".py")}


def bodies_in(file, text, function):
    """(begin, end) of what the file has of the function, from its head to its end."""
    if file.endswith(".py"):
        for match in re.finditer(rf"^def {function}\(.*\n(?:(?:[ \t].*)?\n)*", text, re.M):
            yield match.span()
        return
    source = Source(text)
    for i, token in enumerate(source.tokens):
        if token.text != function or i + 1 >= len(source.tokens) or source.tokens[i + 1].text != "(":
            continue
        j = source.partner.get(i + 1, i + 1) + 1
        while j < len(source.tokens) and source.tokens[j].text in ("const", "noexcept", "override"):
            j += 1
        if j < len(source.tokens) and source.tokens[j].text == "{" and j in source.partner:
            yield token.begin, source.tokens[source.partner[j]].end


def place(row, texts):
    """(file, begin, end) of the row's original, which its function has once."""
    bodies = [(file, *span) for file, text in texts.items() if row.function in text
              for span in bodies_in(file, text, row.function)]
    if not bodies:
        raise Refused(f"{row.id}: found no function {row.function} in {', '.join(FOLDERS)}")
    found = [(file, begin + match.start()) for file, begin, end in bodies
             for match in re.finditer(re.escape(row.original), texts[file][begin:end])]
    if len(found) != 1:
        raise Refused(f"{row.id}: found {len(found)} times in {row.function}, expected once: {row.original!r}")
    return found[0][0], found[0][1], found[0][1] + len(row.original)


def by_hand():
    texts, mutants = sources_in(FOLDERS), []
    for number, row in enumerate(HAND, 1):
        if any(row.id == other.id for other in HAND[:number - 1]):
            raise Refused(f"{row.id}: an id that stands twice")
        if any(text.count("(") != text.count(")") for text in (row.original, row.mutated)):
            raise Refused(f"{row.id}: found a bracket alone, expected an expression or a statement")
        form = "statement" if row.original.endswith(";") else "expression"
        mutants.append(Mutant(number, row.id, *place(row, texts), row.mutated, form, row.type, row.breaks, row.equivalent))
    return mutants


def overlap(left, right):
    return left.file == right.file and left.begin <= right.end and right.begin <= left.end


def drawn(count, seed, others):
    """The first `count` places of the seed that do not overlap, numbered behind the others."""
    texts, chosen = sources_in(DRAWN_FROM), list(others)
    texts = {file: text for file, text in texts.items() if not file.endswith(".py") and not file.startswith(NOT_DRAWN_FROM)}
    for file, line, site in draw(texts, seed):
        shown = f"{' '.join(texts[file][site.begin:site.end].split())}  ->  {site.mutated}" if site.form != "early" \
            else f"{site.mutated} before  {texts[file][site.begin:].split(chr(10))[0]}"
        mutant = Mutant(len(chosen) + 1, f"{file}:{line} {site.kind}", file, site.begin, site.end, site.mutated, site.form,
                        None, shown, None)
        if not any(overlap(mutant, other) for other in chosen):
            chosen.append(mutant)
        if len(chosen) == len(others) + count:
            break
    return chosen[len(others):]


# --- The mutated sources -----------------------------------------------------------

def replacement(original, alternatives):
    """The code for the original and the mutants that replace it, with the lines of the original."""
    form, number = alternatives[0].form, alternatives[0].number
    if alternatives[0].file.endswith(".py"):
        chain = "".join(f"({mutant.mutated}) if MUTANT({mutant.number}) else " for mutant in alternatives)
        return f"({chain}{original})"
    if form == "early":
        return f"if (MUTANT({number})) {alternatives[0].mutated} "
    if form == "statement":
        chain = "".join(f"if (MUTANT({mutant.number})) {{ {mutant.mutated} }} else " for mutant in alternatives)
        return f"{{ {chain}{{ {original} }} }}"
    as_type = alternatives[0].type or ""
    chain = "".join(f"MUTANT({mutant.number}) ? {as_type}({mutant.mutated}) : " for mutant in alternatives)
    return f"({chain}{as_type}({original}))"


def mutated_text(text, mutants):
    """The file with all its mutants in it."""
    spots = {}
    for mutant in mutants:
        spots.setdefault((mutant.begin, mutant.end), []).append(mutant)
    order = sorted(spots)
    for left, right in zip(order, order[1:]):
        if left[1] > right[0]:
            raise Refused(f"{spots[left][0].id}, {spots[right][0].id}: overlap in {mutants[0].file}")
    for begin, end in reversed(order):
        text = text[:begin] + replacement(text[begin:end], spots[begin, end]) + text[end:]
    python = mutants[0].file.endswith(".py")
    first = text.index("\nimport ") + 1 if python else text.index("#include")
    return text[:first] + (PYTHON if python else INCLUDE) + text[first:]


def mutated_files(mutants):
    by_file = {}
    for mutant in mutants:
        by_file.setdefault(mutant.file, []).append(mutant)
    return {file: mutated_text((ROOT / file).read_text(), here) for file, here in by_file.items()}


def write_if_other(path, data):
    """So that what is the same is not built again."""
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def copy_sources(target, mutants):
    """The sources, with the mutants; what is no longer there goes."""
    mutated, kept = mutated_files(mutants), set()
    folders = [path for name in SOURCES for path in (ROOT / name).rglob("*")
               if path.is_file() and not {"__pycache__", "node_modules"} & set(path.parts)
               and ROOT / "reports/examples" not in path.parents]
    for path in [*filter(Path.exists, (ROOT / "CMakeLists.txt", ROOT / "CITATION.cff")), *folders]:
        name = path.relative_to(ROOT)
        kept.add(target / name)
        data = mutated[str(name)].encode() if str(name) in mutated else path.read_bytes()
        write_if_other(target / name, data)
        shutil.copymode(path, target / name)
    for path in [path for path in target.rglob("*") if path.is_file() and path not in kept]:
        path.unlink()


def lines_of(mutant):
    """First and last line in the mutated file, which has one line more."""
    text = (ROOT / mutant.file).read_text()
    first = text.count("\n", 0, mutant.begin) + 2
    return first, first + text.count("\n", mutant.begin, mutant.end)


def blamed(output, mutants, sources):
    """The mutants on lines of errors; else on lines that errors name; else the last one before an error, as where the
    end of a constexpr function is wrong."""
    place = rf"{re.escape(str(sources))}/([\w./-]+):(\d+)[:,]"
    wrong, named = ({(match[1], int(match[2])) for match in re.finditer(one, output)}
                    for one in (place + r"(?:\d+:)? (?:fatal )?error:", place))

    def on(lines):
        return [mutant for mutant in mutants
                if any((mutant.file, line) in lines for line in range(lines_of(mutant)[0], lines_of(mutant)[1] + 1))]

    before = [max((mutant for mutant in mutants if mutant.file == file and lines_of(mutant)[0] <= line), key=lines_of,
                  default=None) for file, line in sorted(wrong)]
    return on(wrong) or on(named) or [mutant for mutant in mutants if mutant in before]


def build(folder, mutants, jobs):
    """Builds the copy; returns the binary folder and those mutants that compile."""
    sources, binary = folder / "sources", folder / "build"
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    copy_sources(sources, mutants)
    subprocess.run(["cmake", "--no-warn-unused-cli", *generator, "-S", sources, "-B", binary, "-DCMAKE_BUILD_TYPE=Release", "-DSTICTION_WERROR=OFF",
                    "-DSTICTION_PYTHON=OFF", "-DCMAKE_CXX_FLAGS=-w", f"-DCMAKE_CXX_FLAGS_RELEASE={FLAGS}"],
                   check=True, stdout=subprocess.DEVNULL)
    while True:
        command = ["cmake", "--build", binary, "--parallel", str(jobs), "--target", *TARGETS, "--", "-k", "0"]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        if done.returncode == 0:
            return binary, mutants
        wrong = blamed(done.stdout, mutants, sources)
        if not wrong:
            sys.exit("the copy does not compile, and not for a bug in it:\n" + done.stdout[-6000:])
        for mutant in wrong:
            print(f"does not compile: {mutant.id}: {mutant.breaks}", flush=True)
        mutants = [mutant for mutant in mutants if mutant not in wrong]
        copy_sources(sources, mutants)


# --- Tests -------------------------------------------------------------------------

Test = namedtuple("Test", "name command folder skip environment")
Result = namedtuple("Result", "how seconds output reached")  # how: passed, failed, skipped, crashed, too slow


def tests_of(binary):
    """Those that the run chooses from."""
    listed = subprocess.run(["ctest", "--test-dir", binary, "--show-only=json-v1"], check=True, capture_output=True)
    tests = []
    for entry in json.loads(listed.stdout)["tests"]:
        properties = {item["name"]: item["value"] for item in entry.get("properties", [])}
        program = re.fullmatch("program: (.*)", entry["name"])
        wanted = program[1] in PROGRAMS if program else set(properties.get("LABELS", [])) & {*LABELS, "golden"}
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


def run_test(test, number, seconds):
    """One test in a process group of its own, with the bug of this number, 0 for none."""
    with scratch_folder() as scratch, tempfile.NamedTemporaryFile() as reached:
        reached.write(bytes(MOST_MUTANTS))
        reached.flush()
        os.chmod(reached.name, 0o666)
        environment = {**os.environ, "STICTION_TESTS": "short", "STICTION_MODEL": "300", **test.environment,
                       "STICTION_MUTANT": str(number), "TMPDIR": scratch}
        if number == 0:
            environment["STICTION_REACHED"] = reached.name
        before = time.monotonic()
        process = subprocess.Popen(test.command, cwd=test.folder, env=environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                                   preexec_fn=prepare_process)
        try:
            output = process.communicate(timeout=seconds)[0].decode(errors="replace")
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return Result("too slow", time.monotonic() - before, "", set())
        took = time.monotonic() - before
        with open(reached.name, "rb") as file:
            numbers = {k for k, mark in enumerate(file.read()) if mark}
    if process.returncode < 0 or "SIGFPE" in output or "SIGSEGV" in output or "SIGABRT" in output:
        return Result("crashed", took, output, numbers)
    skipped = any(re.search(pattern, output) for pattern in test.skip or ())
    return Result("passed" if process.returncode == 0 else "skipped" if skipped else "failed", took, output, numbers)


def run_baseline(tests, jobs):
    """Results by name, of those that are not skipped. Ends the program if a test does not pass without a bug."""
    with ThreadPoolExecutor(jobs) as pool:
        results = list(pool.map(lambda test: run_test(test, 0, 900), tests))
    failed = [(test, result) for test, result in zip(tests, results) if result.how not in ("passed", "skipped")]
    for test, result in failed:
        print(f"without a bug: {test.name}: {result.how}\n{result.output[-3000:]}")
    if failed or not tests:
        sys.exit(f"{len(failed)} of {len(tests)} tests do not pass without a bug")
    return {test.name: result for test, result in zip(tests, results) if result.how == "passed"}


# --- Judging -----------------------------------------------------------------------

Verdict = namedtuple("Verdict", "test how seconds run")  # test None: survived; run: number of tests


def judge(mutant, tests, baseline):
    reaching = [test for test in tests if mutant.number in baseline[test.name].reached]
    before = time.monotonic()
    for count, test in enumerate(sorted(reaching, key=lambda one: baseline[one.name].seconds), 1):
        result = run_test(test, mutant.number, 20 + 10 * baseline[test.name].seconds)
        if result.how != "passed":
            return Verdict(test.name, result.how, time.monotonic() - before, count)
    return Verdict(None, "survived", time.monotonic() - before, len(reaching))


def describe(mutant, verdict):
    if verdict.test:
        how = "" if verdict.how == "failed" else f" ({verdict.how})"
        return f"{mutant.id}: noticed{how} after {verdict.seconds:.1f} s: {verdict.test}"
    return f"{mutant.id}: SURVIVED {verdict.run} tests: {mutant.breaks}"


def judge_all(chosen, tests, baseline, jobs):
    printing = threading.Lock()

    def run(mutant):
        verdict = judge(mutant, tests, baseline)
        with printing:
            print(describe(mutant, verdict), flush=True)
        return verdict

    with ThreadPoolExecutor(jobs) as pool:
        return dict(zip((mutant.id for mutant in chosen), pool.map(run, chosen)))


def table(chosen, verdicts, key):
    """Markdown: by key, mutants and those that were noticed."""
    lines = ["| | bugs | noticed |", "|---|---|---|"]
    for name in sorted({key(mutant) for mutant in chosen}):
        here = [verdicts[mutant.id] for mutant in chosen if key(mutant) == name]
        lines.append(f"| {name} | {len(here)} | {sum(one.test is not None for one in here)} |")
    return "\n".join(lines)


def share(noticed, count):
    low, high = clopper_pearson(noticed, count)
    return f"{noticed} of {count} noticed, {100 * noticed / count:.1f} % (95 % interval: {100 * low:.1f} to {100 * high:.1f})"


def report(title, chosen, verdicts, key, least):
    """Prints the table; whether enough were noticed."""
    noticed = [mutant for mutant in chosen if verdicts[mutant.id].test]
    left = [mutant for mutant in chosen if mutant not in noticed]
    print(f"\n{table(chosen, verdicts, key)}\n\n{title}: {share(len(noticed), len(chosen))}")
    for mutant in left:
        print(f"* {mutant.id}: `{mutant.breaks}`: "
              + (f"equivalent: {mutant.equivalent}" if mutant.equivalent else f"no test of {verdicts[mutant.id].run} notices"))
    for mutant in noticed:
        if mutant.equivalent:
            print(f"* {mutant.id}: called equivalent, but noticed by {verdicts[mutant.id].test}")
    return len(noticed) >= least * len(chosen) or all(mutant.equivalent for mutant in left)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--drawn", type=int, default=0, metavar="N", help="N bugs drawn")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="which (default 1)")
    parser.add_argument("--hand", action="store_true", help="those by hand, too")
    parser.add_argument("--build", type=Path, default=ROOT / "build/mutation", metavar="DIR",
                        help="where the copy and its build stand (default build/mutation)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="(default: the number of cores)")
    parser.add_argument("--check", action="store_true", help="only whether those by hand have their places")
    parser.add_argument("--list", action="store_true", help="only print what would be drawn")
    arguments = parser.parse_args()
    try:
        hand = by_hand()
        mutated_files(hand)
    except Refused as refused:
        sys.exit(f"mutants.py: {refused}")
    if arguments.check:
        print(f"{len(hand)} bugs in {len({mutant.file for mutant in hand})} files, each in its place")
        return 0
    if arguments.drawn and not arguments.hand:
        hand = []
    # Some are not covered, some do not compile.
    from_seed = drawn(2 * arguments.drawn, arguments.seed, hand) if arguments.drawn else []
    if arguments.list:
        print(*(f"{mutant.id}: {mutant.breaks}" for mutant in from_seed), sep="\n")
        return 0
    before = time.monotonic()
    binary, mutants = build(arguments.build.resolve(), hand + from_seed, arguments.jobs)
    built = time.monotonic()
    tests = tests_of(binary)
    baseline = run_baseline(tests, arguments.jobs)
    tests = [test for test in tests if test.name in baseline]
    reached = set().union(*(result.reached for result in baseline.values()))
    print(f"built in {built - before:.0f} s; {len(tests)} tests pass without a bug, "
          f"{sum(result.seconds for result in baseline.values()):.0f} s")
    compiled = [mutant for mutant in from_seed if mutant in mutants]
    chosen = [mutant for mutant in compiled if mutant.number in reached][:arguments.drawn]
    uncovered = [mutant for mutant in compiled if mutant.number not in reached]
    for mutant in uncovered:
        print(f"not covered: {mutant.id}")
    verdicts = judge_all(hand + chosen, tests, baseline, arguments.jobs)
    enough = True
    if hand:
        enough &= report("by hand", hand, verdicts, lambda mutant: mutant.file, 1)
    if chosen:
        enough &= report(f"drawn, seed {arguments.seed}", chosen, verdicts, lambda mutant: mutant.id.split()[-1], LEAST_SHARE)
        print(f"Of {len(from_seed)} places drawn {len(from_seed) - len(compiled)} do not compile with their bug and "
              f"{len(uncovered)} are reached by no test.")
    print(f"{built - before:.0f} s of building, {time.monotonic() - built:.0f} s of tests")
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())
