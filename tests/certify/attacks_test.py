#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Hostile certificates: each is refused, at once, by `stiction check` and by both independent programs.

  attacks_test.py STICTION SOURCES

Every attack is made from a certificate that is accepted. Python standard library only.
"""

import copy
import json
import os
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

SECONDS = 20  # on a busy machine; each takes a fraction of a second on an idle one
MILLION = "7" * 1000000


def run(*command):
    return subprocess.run(list(map(str, command)), capture_output=True, timeout=SECONDS)


class Makers:
    """Honest certificates, by `stiction certify`."""

    def __init__(self, stiction, sources, folder):
        self.stiction, self.corpus, self.folder = stiction, sources / "corpus", folder

    def make(self, problem, claim, *options):
        file = self.folder / "honest.json"
        done = run(self.stiction, "certify", self.corpus / f"{problem}.json", "--claim", claim, "-o", file, *options)
        assert done.returncode == 0, done.stderr
        return json.loads(file.read_text())


def edited(certificate, *path, value):
    """A copy with another value at the path."""
    result = copy.deepcopy(certificate)
    place = result
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return result


# --- Attacks: (name, certificate or text) ---------------------------------------------

def of_text(honest):
    """Texts that mean two things, or that a careless reader takes for something else."""
    text = json.dumps(honest)

    def respelled(old, new):
        assert old in text
        return text.replace(old, new, 1)

    yield "a key twice", respelled('"claim":', '"claim": "symmetric", "claim":')
    yield "a key twice, once escaped", respelled('"claim":', '"cl\\u0061im": "symmetric", "claim":')
    yield "a key twice in the problem", respelled('"b":', '"b": [], "\\u0062":')
    yield "a key of another alphabet", respelled('"claim":', '"cl\u0430im":')
    yield "version one and a half", respelled('"version": 1', '"version": 1.0')
    yield "true for a version", respelled('"version": 1', '"version": true')
    yield "a NUL byte", respelled('"claim"', '"\\u0000", "claim"') + "\0"
    yield "a byte order mark", "\ufeff" + text
    yield "text behind the end", text + "{}"
    yield "NaN", respelled('"version": 1', '"version": NaN')
    yield "an infinite number", respelled('"version": 1', '"version": 1e999')
    yield "a number of a million digits for an integer", respelled('"version": 1', '"version": ' + MILLION)
    yield "no UTF-8", text.encode().replace(b'"claim"', b'"cl\xffim"', 1)
    for deep in (101, 1000, 1000000):
        yield f"{deep} levels", respelled('"witness": ', '"witness": ' + "[" * deep + "]" * deep + ', "x": ')
    yield "70 megabytes", text + " " * (70 << 20)


NOT_NUMBERS = ["\u0661", "\uff11", "\u22121", "1_000", " 1", "1 ", "+1", "0x10", "1e", "e5", "1/0", "1/-2", "1//2",
               "1.5/2", "inf", "nan", "", "-", "1e10001", "1e-10001", "1e99999999999999999999", MILLION,
               "1/" + MILLION, "0." + MILLION, "1e" + MILLION, 1, 1.5, True, None, [], ["1"], {}]


def of_numbers(honest):
    for number in NOT_NUMBERS:
        name = f"the number {str(number)[:30]!r}"
        yield name + " in A", edited(honest, "problem", "A", 0, 0, value=number)
        yield name + " in b", edited(honest, "problem", "b", 0, value=number)
        yield name + " for mu", edited(honest, "problem", "contacts", 0, "mu", value=number)
        yield name + " in the witness", edited(honest, "witness", "f", 0, value=number)


def of_problems(honest):
    """Another problem than the one that the witness speaks of, or none."""
    problem = honest["problem"]
    yield "b the other way", edited(honest, "problem", "b", value=["-" + x if x[0] != "-" else x[1:] for x in problem["b"]])
    yield "another mu", edited(honest, "problem", "contacts", 0, "mu", value="1/2")
    yield "a negative mu", edited(honest, "problem", "contacts", 0, "mu", value="-1")
    yield "a frictionless contact with mu", edited(honest, "problem", "contacts", 0, "kind", value="frictionless")
    yield "a kind of no kind", edited(honest, "problem", "contacts", 0, "kind", value="Static")
    yield "space", edited(honest, "problem", "dimension", value=3)
    yield "a name", edited(honest, "problem", "name", value="no part of a certificate")
    yield "contacts exchanged", edited(honest, "problem", "contacts", value={"0": problem["contacts"][0]})
    size = len(problem["b"])
    for entries in ([[0, 1, "1"]], [[1, 0, "1"], [1, 0, "1"]], [[-1, 0, "1"]], [[0, size, "1"]], [[0.0, 0, "1"]],
                    [[True, 0, "1"]], [[0, 0]], [[0, 0, "1", "1"]]):
        yield f"entries {entries}", edited(honest, "problem", "A", value={"size": size, "entries": entries})
    for size in (-1, 0, 5, 2**63, 4.0, "4"):
        yield f"size {size}", edited(honest, "problem", "A", value={"size": size, "entries": []})
    many = 200000
    huge = edited(honest, "problem", "contacts", value=[{"kind": "frictionless"}] * many)
    yield f"{many} contacts", edited(huge, "problem", "A", value={"size": many, "entries": []})
    many = 3001  # nothing else is wrong with it
    crowd = {**problem, "contacts": [{"kind": "frictionless"}] * many, "A": {"size": many, "entries": []}, "b": ["0"] * many}
    yield f"a true claim of {many} contacts", {**honest, "claim": "symmetric", "problem": crowd, "witness": {}}


POLICIES = ["", "Paper", " paper", "paper,paper", "scan=lowest", "scan=upward", "slip=redirect", "slip=polygon",
            "ties=contacts,scan=highest", "ties=contacts,ties=contacts", "file=yes,", "file", "file==yes",
            "file=yes;drop=variable", "*", "f\u0456le=yes", 1, None, ["paper"], "ties=contacts" * 1000]


def of_runs(honest):
    """Of a cycle, or the runs of a counterexample."""
    where = ("witness", "runs", 0)
    for policy in POLICIES:
        yield f"the policy {str(policy)[:30]!r}", edited(honest, *where, "policies", value=[policy])
    run = honest["witness"]["runs"][0]
    yield "no policy", edited(honest, *where, "policies", value=[])
    yield "a policy twice", edited(honest, *where, "policies", value=run["policies"] * 2)
    yield "no run", edited(honest, "witness", "runs", value=[])
    yield "a run twice", edited(honest, "witness", "runs", value=[run, run])
    yield "the beginning of a run", edited(honest, *where, "pivots", value=run["pivots"][:-1])
    yield "no step", edited(honest, *where, "pivots", value=[])
    yield "a run and what follows", edited(honest, *where, "pivots", value=run["pivots"] + run["pivots"][-1:])
    for key in ("start", "period"):
        for value in (run[key] + 1, -1, float(run[key]), True, str(run[key]), 2**64, None):
            yield f"{key} {value}", edited(honest, *where, key, value=value)
    nothing = {**honest["problem"], "contacts": [], "A": [], "b": []}
    state = {**run["state"], "sets": {}, "f": []}
    for pivots in ([], run["pivots"]):
        empty = edited(honest, "witness", "runs", value=[{**run, "pivots": pivots, "state": state}])
        yield f"no contacts, {len(pivots)} steps", {**empty, "problem": nothing}
    yield "the claim stall", edited(honest, "claim", value="stall")


def of_long_runs(honest, exponential):
    """Steps by the hundred thousand, stated of a problem that has as many: refused at the first that is false."""
    run = honest["witness"]["runs"][0]
    false = edited(honest, "witness", "runs", value=[{**run, "pivots": run["pivots"][:1] * 100000}])
    yield "a hundred thousand steps", edited(false, "problem", value=exponential)


def of_prefixes(honest):
    """Of a certificate that no solution exists."""
    prefixes = honest["witness"]["prefixes"]
    assert len(prefixes) > 1
    with_other = {**prefixes[0], "y": ["-" + x if x[0] != "-" else x[1:] for x in prefixes[0]["y"]]}
    longer = {**prefixes[0], "modes": prefixes[0]["modes"] + ["break"]}
    for name, value in (("no prefix", []), ("one less", prefixes[1:]), ("one twice", prefixes + prefixes[:1]),
                        ("one longer than there are contacts", [longer] + prefixes[1:]),
                        ("one that begins all", prefixes + [{**prefixes[0], "modes": []}]),
                        ("one refuted by the opposite", [with_other] + prefixes[1:]),
                        ("a mode of another kind", [{**prefixes[0], "modes": ["hold"]}] + prefixes[1:]),
                        ("a mode that is a list", [{**prefixes[0], "modes": [["break"]]}] + prefixes[1:])):
        yield name, edited(honest, "witness", "prefixes", value=value)


ENDLESS = "endless: "  # of which every checker is asked


def of_endless(honest, cycle):
    """Of a run in space that never ends and repeats no state."""
    witness = honest["witness"]
    word, centre, radius = witness["word"], Fraction(witness["centre"][0]), Fraction(witness["radii"][0])
    longer = witness["start"] + witness["period"]  # where the word does not lead
    for name, key, value in (("no last step", "word", word[:-1]), ("a step more", "word", word + word[-1:]),
                             ("another step", "word", ["F1 F1 CF"] + word[1:]), ("start", "start", longer),
                             ("period", "period", 2 * witness["period"]), ("no period", "period", 0),
                             ("few bits", "bits", 64), ("states", "kind", "states"),
                             ("the other slip", "policy", "slip=redirect"), ("the opposite", "charts", [-1]),
                             ("a box elsewhere", "centre", [str(centre + 2 * radius)]),
                             ("a box without room", "radii", ["0"]), ("a box of many words", "radii", ["8"])):
        yield ENDLESS + name, edited(honest, "witness", key, value=value)
    yield ENDLESS + "another mu", edited(honest, "problem", "contacts", 0, "mu", value="1/7")
    yield ENDLESS + "b", edited(honest, "problem", "b", 0, value="2")
    yield ENDLESS + "a loop whose states recur", {**cycle, "claim": "endless"}


def attacks(makers):
    counterexample = makers.make("cycle-every-policy-mu-1", "counterexample")
    cycle = makers.make("two-contact-cycle", "cycle")
    solution = makers.make("two-contact-cycle", "solution-exists")
    done = run(makers.stiction, "problem", "--exponential", "18", "-o", "-")
    exponential = {key: value for key, value in json.loads(done.stdout).items() if key in solution["problem"]}
    yield from of_text(solution)
    yield from of_numbers(solution)
    yield from of_problems(solution)
    for honest in (cycle, counterexample):
        yield from of_runs(honest)
    yield from of_long_runs(cycle, exponential)
    yield from of_prefixes(makers.make("no-solution-scripted-wedge", "solution-exists"))
    yield from of_endless(makers.make("space/no-state-twice", "endless"), cycle)
    yield "a counterexample of another problem", {**counterexample, "problem": cycle["problem"]}
    yield OTHER_SOLUTION, edited(counterexample, "witness", "f", value=solution["witness"]["f"])
    yield "a cycle called a solution", {**cycle, "claim": "solution-exists"}
    for claim in (None, 1, "", "Cycle", "everything", ["cycle"], {"cycle": 1}):
        yield f"the claim {claim!r}", {**cycle, "claim": claim}


# --- The checkers ------------------------------------------------------------------

OTHER_SOLUTION = "a counterexample that misses another solution"  # of which check_runs.py does not speak


def refusals(attack, file, programs):
    """What went wrong: an acceptance, another end than a refusal, or none in time."""
    for name, command in programs.items():
        if (attack, name) == (OTHER_SOLUTION, "check_runs.py"):
            continue
        try:
            done = run(*command, file)
        except subprocess.TimeoutExpired:
            yield f"{name}: no answer after {SECONDS} s"
            continue
        if done.returncode not in (1, 2) or b"accepted" in done.stdout:
            yield f"{name}: exit {done.returncode}: {(done.stdout + done.stderr)[-300:]}"
        elif done.returncode == 1 and b"REJECTED" not in done.stdout or len(done.stdout + done.stderr) > 1500:
            yield f"{name}: no short reason: {(done.stdout + done.stderr)[:300]}"


def other_problem(makers, programs):
    """Honest certificates, asked of another problem, and of their own."""
    certificate = makers.folder / "own.json"
    for own, claim in (("two-contact-cycle", "cycle"), ("space/no-state-twice", "endless")):
        certificate.write_text(json.dumps(makers.make(own, claim)))
        for name, command in programs.items():
            for problem, expected in ((own, 0), ("cycle-every-policy-mu-1", 1), ("README", 2)):
                code = run(*command, certificate, "--problem", makers.corpus / f"{problem}.json").returncode
                if code != expected:
                    yield f"{name}: {claim}: --problem {problem}: exit {code}, expected {expected}"


def main(stiction, sources):
    sources, failures, count = Path(sources), [], 0
    programs = {"stiction check": [stiction, "check"]}
    extent = os.environ.get("STICTION_TESTS")
    for script in () if extent == "short" else ("check_certificate.py", "check_runs.py"):
        programs[script] = [sys.executable, sources / "certify" / script]
    with tempfile.TemporaryDirectory() as name:
        makers = Makers(stiction, sources, Path(name))
        failures += other_problem(makers, programs)
        for count, (attack, content) in enumerate(attacks(makers), 1):
            file = makers.folder / "attack.json"
            content = content if isinstance(content, (str, bytes)) else json.dumps(content)
            file.write_bytes(content if isinstance(content, bytes) else content.encode())
            every = extent == "all" or attack.startswith(ENDLESS)
            asked = programs if every else dict([list(programs.items())[count % len(programs)]])
            failures += [f"{attack}: {failure}" for failure in refusals(attack, file, asked)]
    for failure in failures:
        print("FAILED:", failure)
    print(f"{count} attacks, {len(failures)} failures")
    return 1 if failures or count < 200 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
