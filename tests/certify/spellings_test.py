#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One rule for numbers in all checkers: every way to write a number, in every place of every claim where one may stand.

  spellings_test.py STICTION SOURCES

Certificates are the true ones of false_claims_test.py, of the corpus, and of runs. Another spelling of the same number
is accepted, what is no number is refused; whatever is written, all checkers that know the claim say the same. Python
standard library only.
"""

import copy
import json
import os
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

sys.dont_write_bytecode = True
from claim_cases import TRUE, checkers_of
import false_claims_test  # noqa: F401: it notes its true certificates in TRUE

sys.set_int_max_str_digits(0)
SHARE = 1 if os.environ.get("STICTION_TESTS") == "all" else 7  # one in so many is shown

# --- Spellings -------------------------------------------------------------------------


def same(x):
    """Of the same number."""
    sign, p, q = "-" * (x < 0), abs(x.numerator), x.denominator
    yield from (f"{sign}{p}/{q}", f"{sign}000{p}/{q}", f"{sign}{p}/000{q}", f"{sign}{3 * p}/{3 * q}",
                f"{sign}{p}{'0' * 9000}/{q}{'0' * 9000}")
    if q == 1:
        yield from (f"{sign}{p}", f"{sign}0{p}", f"{sign}{p}.0", f"{sign}{p}.{'0' * 9000}", f"{sign}{p}e0",
                    f"{sign}{p}E+0", f"{sign}{p}e-0", f"{sign}{p}0e-1", f"{sign}{p}e{'0' * 5000}", f"{sign}{p}{'0' * 9999}e-9999",
                    f"{sign}{p}{'0' * 10000}e-10000", f"{sign}{p}{'0' * 10000}E-00010000", f"{sign}0.{'0' * 9999}{p}e10000"
                    if p < 10 else f"{sign}{p}")
    if x == 0:
        yield from ("-0", "-0/7", "0e10000", "0e-10000", "-0.0e+10000", "0" * 40000)


NO_NUMBERS = ["", " ", "+", "-", ".", "/", "e", "--1", "+1", "1+", "- 1", " 1", "1 ", "1\n", "\t1", "\u00a01", "1\u2009", "1_000",
              "1,5", "1'000", ".5", "1.", "-.5", "1..0", "1.0.0", "1e", "1e+", "1e-", "1ee1", "1e1.0", "1e+-1", "1e 1", "e5",
              "1/", "/1", "1/0", "0/0", "-0/000", "1/-2", "-1/-2", "1/+2", "1//2", "1/2/3", "1 / 2", "1.5/2", "1/2.0", "1e1/2",
              "1/1e1", "0x10", "0b1", "1d0", "1f", "1L", "inf", "-inf", "Infinity", "nan", "NaN", "null", "true", "\u0661",
              "\uff11", "\u22121", "1\u00b2", "\u00bd", "1\u0000", "1e10001", "1e-10001", "0e10001", "1e+00010001",
              "1e99999999999999999999", "1e" + "9" * 39000, "7" * 40001, "0" * 40001, "1/" + "0" * 39999,
              1, 0, -1, 1.5, 1e300, True, False, None, [], ["1"], {}, {"1": "1"}]
# Numbers of any value; what they make of a claim is not known here, but to all checkers the same.
OTHERS = ["1e10000", "-1e10000", "1e-10000", "-1e-10000", "0.1e10000", "1e9999", "1/1" + "0" * 10000, "7" * 40000, "1e308", "1e309",
          "5e-324", "1e-400", "0.1", "1/3", "-1", "1000000000000000000000000"]
NO_INTEGERS = [1.0, 0.0, 1e300, "0", "1", True, None, [], {}, 2**63, 2**64 - 1, 2**64, -2**63]

# Written into the text of a certificate in place of one value: no JSON, or not what it seems.
TEXTS = ["NaN", "Infinity", "-Infinity", "01", "-01", "+1", "1_0", ".5", "1.", "1e", "0x1", "1e999", "-1e999", "--1", "1 2", "'1'",
         "\"1", "undefined", "", "1,", "// 1\n1", "/* 1 */ 1", "\u0661", "\u00a01", "\ufeff1", str(-2**63 - 1), str(10**25), str(10**5000)]


def is_number(text):
    try:
        return not any(c in text for c in " _") and Fraction(text) is not None
    except (ValueError, ZeroDivisionError):
        return False


# --- Places ------------------------------------------------------------------------------

NAMES = ("policies", "policy", "modes", "word", "sets", "kind", "driven", "limiting", "goal", "from", "to", "format", "claim", "version")


def places(value, path=()):
    """(path, value) of numbers, one of each kind of place: indices count as one, but first and last."""
    if isinstance(value, dict):
        for key, item in value.items():
            if key not in NAMES:
                yield from places(item, path + (key,))
    elif isinstance(value, list):
        for k in sorted({0, len(value) - 1} & set(range(len(value)))):
            yield from places(value[k], path + (k,))
    elif isinstance(value, int) or is_number(value):
        yield path, value


def with_value(certificate, path, value):
    made = copy.deepcopy(certificate)
    place = made
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return made


def spelled(certificate):
    """(what, text, whether it is accepted; None where it is not known)"""
    for path, value in places({key: certificate[key] for key in ("problem", "witness")}):
        name = ".".join(map(str, path))
        if isinstance(value, int):
            cases = [(other, False) for other in NO_INTEGERS]
        else:
            turned = "slip" in path and certificate["problem"]["dimension"] == 2  # the words "1" and "-1"
            cases = [(other, None if turned else True) for other in same(Fraction(value))]
            cases += [(other, False) for other in NO_NUMBERS] + [(other, None) for other in OTHERS]
        for other, accepted in cases:
            yield f"{name} = {json.dumps(other)[:40]}", json.dumps(with_value(certificate, path, other)), accepted


def broken(certificate):
    """The same of texts that are no JSON, or that mean two things."""
    for path, _ in list(places({key: certificate[key] for key in ("problem", "witness")}))[::7]:
        mark = json.dumps(with_value(certificate, path, "here"))
        for text in TEXTS:
            yield f"{path[-1]}: {text[:40]!r}", mark.replace('"here"', text), False
    text = json.dumps(certificate)
    yield "a byte order mark", "\ufeff" + text, False
    yield "a comma too many", text[:-1] + ",}", False
    yield "a comma too many in a list", text.replace("]", ",]", 1), False
    yield "a key twice", text.replace('"dimension": ', '"dimension": 2, "dimension": ', 1), False
    yield "a key twice, once escaped", text.replace('"b": ', '"\\u0062": [], "b": ', 1), False
    yield "a lone surrogate", text.replace('"claim": "', '"claim": "\\ud800', 1), False
    yield "spaces of JSON", text.replace(",", " \t\r\n,\n"), True
    yield "a space of no JSON", text.replace(",", "\u00a0,", 1), False
    yield "a form feed", text.replace(",", "\f,", 1), False


def certificates(sources):
    """One or two of each claim, short ones."""
    known = {}
    for _, certificate in TRUE:
        known.setdefault(certificate["claim"], []).append(certificate)
    folders = (sources / "corpus/certificates", sources / "corpus/space/certificates")
    for file in sorted(file for folder in folders for file in folder.glob("*.json")):
        if file.stat().st_size < 5000:
            certificate = json.loads(file.read_text())
            known.setdefault(certificate["claim"], []).insert(0, certificate)
    for listed in known.values():
        shortest = sorted(listed, key=lambda certificate: len(json.dumps(certificate)))
        yield from shortest[1:2 if SHARE > 1 else 3] or listed


def accepted_by(command, files, failures):
    """The files that a checker accepts, of those shown to it in one call."""
    done = subprocess.run([*map(str, command), *map(str, files)], capture_output=True, text=True, errors="replace")
    if done.returncode not in (0, 1, 2):
        failures.append(f"{command}: exit {done.returncode}: {done.stderr[-300:]}")
    lines = {line.split(": ")[0] for line in done.stdout.splitlines() if ": accepted" in line and "its runs only" not in line}
    return {file for file in files if str(file) in lines}


def judge(certificate, checkers, least, folder, failures):
    """How many texts were shown: those that are JSON all at once."""
    claim = certificate["claim"]
    readable, texts = list(spelled(certificate))[len(claim) % SHARE::SHARE], list(broken(certificate))[len(claim) % SHARE::SHARE]
    cases = [("honest", json.dumps(certificate), True), *readable, *texts]
    files = [folder / f"{k}.json" for k in range(len(cases))]
    for file, (_, text, _) in zip(files, cases):
        file.write_text(text, encoding="utf-8", errors="surrogatepass")
    said = {}
    for name, command in checkers:
        accepted = accepted_by(command, files[:1 + len(readable)], failures)
        if files[0] in accepted:  # it knows the claim
            said[name] = accepted.union(*(accepted_by(command, [file], failures) for file in files[1 + len(readable):]))
    if len(said) < least or checkers[0][0] not in said:
        failures.append(f"{claim}: the certificate itself is accepted by {list(said)} only")
    for file, (what, _, expected) in zip(files, cases):
        answers = {name: file in accepted for name, accepted in said.items()}
        if len(set(answers.values())) > 1 or expected not in (None, *answers.values()):
            failures.append(f"{claim}: {what}: accepted by {answers}, expected {expected}")
    return len(cases)


def main(stiction, sources, *programs):
    failures, count = [], 0
    checkers = [(program, [program]) for program in programs] or checkers_of(stiction, sources)
    if os.environ.get("STICTION_TESTS") == "short":  # the scripts are the same in every build
        checkers = checkers[:1]
    least = 1 if programs or len(checkers) == 1 else 2
    for certificate in certificates(Path(sources)):
        with tempfile.TemporaryDirectory() as folder:
            count += judge(certificate, checkers, least, Path(folder), failures)
    for failure in failures[:50]:
        print("FAILED:", failure)
    print(f"{count} spellings, {len(failures)} failures")
    return 1 if failures or count < 1000 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
