#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Alters certificates and shows them to both checkers.

  tamper_test.py STICTION SOURCES        the program, and the folder with certify/check_certificate.py

A certificate of every claim is made with `stiction certify`; every value in it is altered in turn, and
`stiction check` and check_certificate.py judge each altered certificate. This fails if the two differ, or if
one that is altered in its form is accepted, or one altered in a value of which this file cannot show, from
the numbers alone, that it is true all the same. Python standard library only.
"""

import copy
import importlib
import json
import os
import subprocess
import sys
import tempfile
from fractions import Fraction
from math import prod
from pathlib import Path

BATCH = 500  # files in one call of the program
SHARE = 1 if os.environ.get("STICTION_TESTS") == "all" else 5  # one in so many is shown
POLICIES = ["paper", "ties=contacts", "resume=round", "file=yes"]


# --- Problems ----------------------------------------------------------------------

def problem(contacts, A, b):
    kinds = [{"kind": "frictionless"} if mu is None else {"kind": "static", "mu": mu} for mu in contacts]
    return {"format": "stiction-problem", "version": 1, "name": "tampered", "dimension": 2,
            "contacts": kinds, "A": A, "b": b}


REFERENCE = problem(["1", "1"], [["7", "-2", "-6", "0"], ["-2", "9", "-1", "-7"], ["-6", "-1", "7", "3"],
                                 ["0", "-7", "3", "7"]], ["2", "-1", "-2", "2"])
INDEFINITE = copy.deepcopy(REFERENCE)
INDEFINITE["A"][1][1] = "0"
SINGULAR = problem(["1", None], [["1", "1", "0"], ["1", "1", "0"], ["0", "0", "2"]], ["-1", "-1", "-3/2"])
ASYMMETRIC = copy.deepcopy(SINGULAR)
ASYMMETRIC["A"][0][2] = "1"
OUTSIDE = problem(["1"], [["1", "-1"], ["-1", "1"]], ["-1", "0"])
# b is not in the range of A, and (H) holds.
INSIDE = problem(["1/2", None], [["1", "-1", "0"], ["-1", "1", "0"], ["0", "0", "0"]], ["1", "1", "3"])

SPACE = {"format": "stiction-problem", "version": 1, "name": "tampered", "dimension": 3,
         "contacts": [{"kind": "static", "mu": "1/2"}, {"kind": "frictionless"}],
         "A": [["3", "1", "0", "1"], ["1", "2", "0", "0"], ["0", "0", "1", "0"], ["1", "0", "0", "2"]],
         "b": ["-2", "3", "1", "-1"]}

# In space: (H) holds though b is not in the range of A; it fails; nothing pushes the second contact, whose friction
# the first feels.
BESIDE = {**SPACE, "A": [["1", "-1", "0", "0"], ["-1", "1", "0", "0"], ["0", "0", "0", "0"], ["0", "0", "0", "0"]],
          "b": ["3", "1", "-1/2", "1"]}
WEDGE = {**SPACE, "A": [["1", "-2", "0", "1"], ["-2", "4", "0", "-2"], ["0", "0", "1", "0"], ["1", "-2", "0", "1"]],
         "b": ["-1", "0", "0", "0"]}
DEAD = {**SPACE, "contacts": [{"kind": "bilateral"}, {"kind": "static", "mu": "1/2"}, {"kind": "frictionless"}],
        "A": [["2", "0", "0", "1", "0"], ["0", "0", "0", "0", "0"], ["0", "0", "1", "0", "0"],
              ["1", "0", "0", "2", "0"], ["0", "0", "0", "0", "1"]], "b": ["1", "-1/10", "0", "2", "-1"]}

# claim that is made, what is asked for, problem
CLAIMS = [("solution-exists", "solution-exists", REFERENCE), ("symmetric", "symmetric", SINGULAR),
          ("not-symmetric", "symmetric", ASYMMETRIC), ("psd", "psd", SINGULAR), ("not-psd", "psd", INDEFINITE),
          ("definite", "definite", REFERENCE), ("not-definite", "definite", SINGULAR),
          ("in-range", "in-range", SINGULAR), ("not-in-range", "in-range", OUTSIDE),
          ("solution-exists", "solution-exists", SPACE), ("coulomb-solution", "coulomb-solution", SPACE),
          ("h", "h", BESIDE), ("exists", "exists", BESIDE), ("not-h", "h", WEDGE), ("no-solution", "existence", DEAD),
          ("h", "h", INSIDE), ("not-h", "h", OUTSIDE), ("cycle", "cycle", REFERENCE),
          ("counterexample", "counterexample", REFERENCE)]
OF_RUNS = ("cycle", "counterexample")


def make(stiction, folder, claim, asked, described):
    """The certificate; of runs only the policies of POLICIES."""
    file = folder / "problem.json"
    file.write_text(json.dumps(described))
    command = [stiction, "certify", file, "--claim", asked, "-o", "-"]
    command += ["--policy", "*"] if claim in OF_RUNS else []
    done = subprocess.run(command, capture_output=True)
    # 1: the certificate is of the policies that loop, which are not all.
    assert done.returncode in ((0, 1) if claim in OF_RUNS else (0,)), (command, done.stderr)
    certificate = json.loads(done.stdout)
    assert certificate["claim"] == claim, (certificate["claim"], claim)
    if claim in OF_RUNS:
        runs = certificate["witness"]["runs"]
        for run in runs:
            run["policies"] = [policy for policy in run["policies"] if policy in POLICIES]
        certificate["witness"]["runs"] = [run for run in runs if run["policies"]]
    return certificate


# --- Whether a claim is true, by its equation --------------------------------------

def dot(x, y):
    return sum((u * v for u, v in zip(x, y, strict=True)), Fraction(0))


def numbers(values):
    return [Fraction(value) for value in values]


def rows(values):
    return [numbers(row) for row in values]


def solves(contacts, A, b, f, a):
    if a != [dot(row, f) + x for row, x in zip(A, b, strict=True)]:
        return False
    row = 0
    for contact in contacts:
        fN, aN = f[row], a[row]
        if min(fN, aN) != 0:
            return False
        row += 1
        if contact["kind"] == "frictionless":
            continue
        fF, aF, bound = f[row], a[row], Fraction(contact["mu"]) * fN
        if not (-bound <= fF <= bound and aF * fF <= 0 and (aF == 0 or abs(fF) == bound)):
            return False
        row += 1
    return True


def solves_in_space(contacts, A, b, f, a, bound):
    """(21), (22); or with a bound Coulomb's law up to it."""
    if a != [dot(row, f) + x for row, x in zip(A, b, strict=True)]:
        return False
    row = 0
    for contact in contacts:
        if min(f[row], a[row]) != 0:
            return False
        if contact["kind"] == "static":
            fF, aF = f[row + 1:row + 3], a[row + 1:row + 3]
            cap = (Fraction(contact["mu"]) * f[row])**2
            gap, power = cap - dot(fF, fF), dot(fF, aF)
            strict = bound is not None and power**2 >= bound**2 * cap * dot(aF, aF)
            if gap < 0 or power > 0 or not (strict if bound is not None else gap == 0 or not any(aF)):
                return False
        row += 3 if contact["kind"] == "static" else 1
    return bound is None or 0 < bound <= 1


def sizes(contacts, dimension):
    """(contact, its normal row, its tangent rows)"""
    row = 0
    for contact in contacts:
        end = row + (dimension if contact["kind"] in ("static", "sliding") else 1)
        yield contact, row, range(row + 1, end)
        row = end


def in_cones(problem, x, dual):
    """abs(xF) <= mu xN, or xN >= mu abs(xF) for the dual cones, by squares."""
    for contact, row, tangents in sizes(problem["contacts"], problem["dimension"]):
        mu, tangent = Fraction(contact.get("mu", 0)), sum(x[k]**2 for k in tangents)
        if x[row] < 0 or (x[row]**2 < mu**2 * tangent if dual else tangent > mu**2 * x[row]**2):
            return False
    return True


def refuted_in_space(problem, prefixes):
    """Every word of bilateral, frictionless and static contacts, each once."""
    A, b = rows(problem["A"]), numbers(problem["b"])
    modes = [("hold",) if contact["kind"] == "bilateral" else ("break", "touch") for contact in problem["contacts"]]
    covered = 0
    for entry in prefixes:
        y, prefix = numbers(entry["y"]), entry["modes"]
        g = [dot(y, column) for column in zip(*A)]
        if dot(y, b) >= 0 or any(mode not in allowed for mode, allowed in zip(prefix, modes)):
            return False
        for i, (contact, row, tangents) in enumerate(sizes(problem["contacts"], 3)):
            mu = Fraction(contact.get("mu", 0))
            for mode in prefix[i:i + 1] or modes[i]:
                fits = {"hold": g[row] == 0, "break": y[row] >= 0,
                        "touch": g[row] <= 0 and g[row]**2 >= mu**2 * sum(g[k]**2 for k in tangents)}[mode]
                if not fits or any(y[k] for k in tangents):
                    return False
        covered += Fraction(1, prod(len(allowed) for allowed in modes[:len(prefix)]))
    listed = [tuple(entry["modes"]) for entry in prefixes]
    return covered == 1 and not any(x != y and x == y[:len(x)] for x in listed for y in listed)


def factors(A, L, D):
    n = range(len(A))
    shape = all(L[i][j] == (i == j) for i in n for j in n if j >= i)
    scaled = [[x * d for x, d in zip(row, D, strict=True)] for row in L]
    return shape and min(D) >= 0 and all(dot(scaled[i], L[j]) == A[i][j] for i in n for j in n)


def normalized(value):
    """Numbers in strings written in one way."""
    if isinstance(value, dict):
        return {key: normalized(item) for key, item in value.items()}
    if isinstance(value, list):
        return [normalized(item) for item in value]
    try:
        return str(Fraction(value)) if isinstance(value, str) else value
    except ValueError:
        return value


def part_of(altered, original):
    """Each run is one of the original, of the same problem, for some of its policies."""
    def known(run):
        return any(set(run["policies"]) <= set(other["policies"]) and run["policies"] != []
                   and normalized({**run, "policies": 0}) == normalized({**other, "policies": 0})
                   for other in original["witness"]["runs"])
    runs = altered["witness"]["runs"]
    return normalized(altered["problem"]) == normalized(original["problem"]) and runs and all(map(known, runs))


def is_true(altered, original):
    claim, witness = original["claim"], altered["witness"]
    if (claim, altered["claim"]) == ("definite", "psd"):
        claim = "psd"  # of which it is a witness, too
    if altered["claim"] != claim:
        return False
    if claim == "cycle":
        return part_of(altered, original)
    A, b = rows(altered["problem"]["A"]), numbers(altered["problem"]["b"])
    if claim == "counterexample":
        return (part_of(altered, original) and factors(A, rows(witness["L"]), numbers(witness["D"]))
                and min(numbers(witness["D"])) > 0
                and solves(altered["problem"]["contacts"], A, b, numbers(witness["f"]), numbers(witness["a"])))
    if altered["problem"]["dimension"] == 3 and claim in ("solution-exists", "coulomb-solution"):
        bound = Fraction(witness["bound"]) if claim == "coulomb-solution" else None
        return solves_in_space(altered["problem"]["contacts"], A, b, numbers(witness["f"]), numbers(witness["a"]), bound)
    if claim == "solution-exists":
        return solves(altered["problem"]["contacts"], A, b, numbers(witness["f"]), numbers(witness["a"]))
    if claim == "symmetric":
        return A == [list(column) for column in zip(*A)]
    if claim == "not-symmetric":
        return A[witness["i"]][witness["j"]] != A[witness["j"]][witness["i"]]
    if claim in ("psd", "definite"):
        D = numbers(witness["D"])
        return factors(A, rows(witness["L"]), D) and (claim == "psd" or min(D) > 0)
    if claim == "in-range":
        return [dot(row, numbers(witness["x"])) for row in A] == b
    if claim == "no-solution":
        return refuted_in_space(altered["problem"], witness["prefixes"])
    if claim == "exists" and not factors(A, rows(witness["L"]), numbers(witness["D"])):
        return False
    if claim in ("h", "exists"):
        image = [dot(numbers(witness["y"]), column) for column in zip(*A)]
        return in_cones(altered["problem"], [x - y for x, y in zip(b, image, strict=True)], dual=True)
    value = Fraction(witness["value"])
    if claim == "not-h":
        v = numbers(witness["v"])
        return (in_cones(altered["problem"], v, dual=False) and dot(b, v) == value < 0
                and all(dot(row, v) == 0 for row in A))
    if claim in ("not-psd", "not-definite"):
        x = numbers(witness["x"])
        curvature = dot(x, [dot(row, x) for row in A])
        return curvature == value and (value < 0 or (claim == "not-definite" and value == 0 and any(x)))
    y = numbers(witness["y"])
    return all(dot(y, column) == 0 for column in zip(*A)) and dot(y, b) == value != 0


# --- Altering ----------------------------------------------------------------------

WORDS = ["C", "NC-", "NC+", "none", "suspended", "N1", "F2", "establish", "zero", "cycle", "stall", "psd",
         "symmetric", "static", "frictionless", "sliding", "file=yes,drop=variable", "ties=sets",
         "ties=contacts,resume=round", "slip=redirect", "file=yes", "resume=round"]
NOT_NUMBERS = [" 1", "1 ", "+1", "1/0", "0x1", ".5", "1.", "1_0", "1e10001", "\u0661", ""]


def places(value, path=()):
    yield path
    for key in value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ():
        yield from places(value[key], path + (key,))


def at(document, path):
    for key in path:
        document = document[key]
    return document


def edited(document, path, edit):
    """A copy in which edit(parent, key) was applied; the document itself is below the key "root"."""
    holder = {"root": copy.deepcopy(document)}
    path = ("root",) + path
    edit(at(holder, path[:-1]), path[-1])
    return holder["root"]


def is_later_pivot(path):
    """Pivots are all alike: those after the first two are altered in fewer ways."""
    return "pivots" in path and path[-1] != "pivots" and path[path.index("pivots") + 1] > 1


def other_values(path, value):
    """(value, whether the form differs)"""
    few = is_later_pivot(path)
    for other in (None, [], "1") if few else (None, True, 1, 1.5, "1", "x", [], {}):
        if type(other) is not type(value) or isinstance(value, (list, dict)):
            yield other, True
    if isinstance(value, int):
        yield from ((other, False) for other in (value + 1, value - 1, -value, 0))
        yield from ((other, True) for other in (float(value), 2**64 - 1))
    elif isinstance(value, str):
        try:
            x = Fraction(value)
        except ValueError:
            yield value + "x", True
            if len(path) == 1 or path[-2] == "policies":
                yield "a" + "\u00e9" * 60, True
            yield from ((other, False) for other in WORDS[::3 if few else 1])
        else:
            yield from ((str(other), False) for other in (x + 1, -x, 0, x / 2))
            yield f"{x.numerator}0/{x.denominator}0", False
            yield from ((other, True) for other in NOT_NUMBERS[::5 if few else 1])


def alterations(original):
    """(what was done, altered certificate, whether its form differs)"""
    for path in places(original):
        value, name = at(original, path), "$" + "".join(f"[{key!r}]" for key in path)
        for other, form in other_values(path, value):
            yield (f"{name} = {other!r}", form,
                   edited(original, path, lambda parent, key, other=other: parent.__setitem__(key, other)))
        if isinstance(value, dict):
            yield f"{name}: an unknown key", True, edited(original, path + ("extra",), lambda parent, key:
                                                          parent.__setitem__(key, "1"))
            for key in value:
                yield f"{name}: without {key}", True, edited(original, path + (key,), lambda parent, key:
                                                             parent.__delitem__(key))
        if isinstance(value, list):
            open_list = path[-1] in ("policies", "runs")  # with fewer of them it can still be true
            for i in range(len(value)):
                yield f"{name}: without item {i}", not open_list, edited(
                    original, path + (i,), lambda parent, key: parent.__delitem__(key))
                yield f"{name}: item {i} twice", True, edited(
                    original, path + (i,), lambda parent, key: parent.insert(key, copy.deepcopy(parent[key])))
    if original["claim"] in OF_RUNS:
        yield from split_runs(original)


def split_runs(original):
    """One run in two, the second written with other spellings of its numbers."""
    for i, run in enumerate(original["witness"]["runs"]):
        for respelled in (False, True) if len(run["policies"]) > 1 else ():
            certificate = copy.deepcopy(original)
            runs = certificate["witness"]["runs"]
            runs[i]["policies"], second = run["policies"][:1], copy.deepcopy(run)
            second["policies"] = run["policies"][1:]
            if respelled:
                second["pivots"][0]["step"] += "/1" if "/" not in second["pivots"][0]["step"] else ""
                x = Fraction(second["pivots"][0]["step"])
                second["pivots"][0]["step"] = f"{x.numerator * 2}/{x.denominator * 2}"
            runs.append(second)
            yield f"run {i} in two, respelled: {respelled}", True, certificate


def broken_texts(text):
    """Texts that no JSON document is, or an ambiguous one."""
    return [("a key twice", text.replace('"version": 1,', '"version": 1, "version": 1,', 1)),
            ("NaN", text.replace('"version": 1,', '"version": NaN,', 1)),
            ("a comma too many", text.replace("]", ",]", 1)), ("a byte order mark", "\ufeff" + text),
            ("text after the end", text + "1"), ("half of it", text[: len(text) // 2]), ("nothing", "")]


# --- Both checkers -----------------------------------------------------------------

def program_verdicts(stiction, files):
    """Accepted or not, of each file. A call that ends neither way is narrowed down to the file that did it."""
    result = subprocess.run([stiction, "check", "--json", *files], capture_output=True)
    if result.returncode in (0, 1):
        verdicts = [report["accepted"] for report in json.loads(result.stdout)]
        assert len(verdicts) == len(files) and all(verdicts) == (result.returncode == 0)
        return verdicts
    if len(files) == 1:
        return [f"exit {result.returncode}: {result.stderr.decode(errors='replace').strip()[:200]}"]
    middle = len(files) // 2
    return program_verdicts(stiction, files[:middle]) + program_verdicts(stiction, files[middle:])


def script_verdict(script, file, program):
    if os.environ.get("STICTION_TESTS") == "short":  # the script is the same in every build
        return program
    try:
        script.reader.check(script.reader.load(file), script.CLAIMS)
        return True
    except script.reader.Rejected:
        return False


def load_script(folder):
    """check_certificate.py, and beside it what it reads with."""
    sys.path.insert(0, str(folder))
    script = importlib.import_module("check_certificate")
    script.reader = importlib.import_module("certificate_reader")
    return script


def judge(stiction, script, folder, original, failures, is_true=is_true):
    """Returns how many were refused, and how many were accepted because they are true."""
    refused = accepted = 0
    altered = [("nothing", False, original)]
    altered += [case for case in alterations(original) if json.dumps(case[2]) != json.dumps(original)]
    altered = altered[::SHARE]
    for first in range(0, len(altered), BATCH):
        batch = altered[first:first + BATCH]
        files = [folder / f"{i}.json" for i in range(len(batch))]
        for file, (_, _, certificate) in zip(files, batch):
            file.write_text(json.dumps(certificate, ensure_ascii=False), encoding="utf-8")
        for file, (what, form, certificate), program in zip(files, batch, program_verdicts(stiction, files)):
            python = script_verdict(script, file, program)
            if program is not python:
                failures.append(f"{original['claim']}, {what}: stiction check: {program}, "
                                f"check_certificate.py: {python}")
            elif python and (form or not is_true(certificate, original)):
                failures.append(f"{original['claim']}, {what}: accepted by both")
            refused += not python
            accepted += python
    return refused, accepted


def judge_texts(stiction, script, folder, original, failures):
    """Texts that are no certificate: neither checker accepts, neither fails by itself."""
    for what, text in broken_texts(json.dumps(original)):
        file = folder / "broken.json"
        file.write_text(text, encoding="utf-8")
        for name, command in (("stiction check", [stiction, "check"]),
                              ("check_certificate.py", [sys.executable, script.__file__])):
            status = subprocess.run([*command, file], capture_output=True).returncode
            if status not in (1, 2):
                failures.append(f"{what}: {name}: exit {status}")


def main(stiction, sources):
    script, failures = load_script(Path(sources) / "certify"), []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for claim, asked, described in CLAIMS:
            original = make(stiction, folder, claim, asked, described)
            if not script.reader.check(original, script.CLAIMS) or not is_true(original, original):
                failures.append(f"{claim}: the certificate itself is not true")
            refused, accepted = judge(stiction, script, folder, original, failures)
            if refused < 100 // SHARE:
                failures.append(f"{claim}: only {refused} altered certificates refused")
            print(f"{claim}: {refused} refused, {accepted} accepted that are true")
        judge_texts(stiction, script, folder, original, failures)
    for failure in failures[:50]:
        print("FAILED:", failure)
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
