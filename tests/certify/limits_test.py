#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a check may cost: certificates just below and just above each limit, in every checker.

  limits_test.py STICTION SOURCES            the limits, and certificates far above them
  limits_test.py STICTION SOURCES --dearest  what the dearest legal certificates cost, in seconds and megabytes
"""

import json
import os
import random
import subprocess
import sys
import tempfile
from math import isqrt
from pathlib import Path

sys.set_int_max_str_digits(0)
MOST_ROWS, MOST_CHARACTERS = 3000, 40_000
FREE_WORK, WORK_BY_LENGTH = 6 * 10**12, 250_000
FREE_DIGITS, DIGITS_BY_LENGTH = 1_000_000, 2
FREE_CELLS, CELLS_BY_LENGTH = 2_000_000, 5
SHORT = 10**6
SECONDS = 8  # of processor time, for a refusal before any work is done; the work would take minutes
MEGABYTES = 400


def length_of(value):
    """Characters of texts and keys, and 2 for every value."""
    inner = value if isinstance(value, list) else value.values() if isinstance(value, dict) else ()
    own = len(value) if isinstance(value, str) else sum(map(len, value)) if isinstance(value, dict) else 0
    return 2 + own + sum(map(length_of, inner))


def length(certificate):
    return length_of(certificate["problem"]) + length_of(certificate["witness"])


def most_work(certificate):
    return FREE_WORK + WORK_BY_LENGTH * length(certificate)


def most_bits(certificate, operations):
    """That numbers may have which so many operations are made with."""
    return isqrt(most_work(certificate) // operations - SHORT)


def certificate(claim, A, b=None, contacts=None, **witness):
    """Of frictionless contacts, one a row, unless told otherwise."""
    size = A["size"] if isinstance(A, dict) else len(A)
    contacts = contacts or [{"kind": "frictionless"}] * size
    problem = {"format": "stiction-problem", "version": 1, "dimension": 2, "contacts": contacts, "A": A,
               "b": b or ["0"] * size}
    return {"format": "stiction-certificate", "version": 1, "claim": claim, "problem": problem, "witness": witness}


def diagonal(size, value="1"):
    return {"size": size, "entries": [[i, i, value] for i in range(size)]}


def unit(size, at=0, value="1"):
    return [value if i == at else "0" for i in range(size)]


# --- Far above -----------------------------------------------------------------------

def long_numbers(size=10):
    """Numbers of 9,001 digits, of six characters each."""
    A = [["1e9000" if i != j else "2e9000" for j in range(size)] for i in range(size)]
    return certificate("safe-by-condition", A, scaling=["1e-4500"] * size, least="1", most="20")


def many_contacts():
    return certificate("symmetric", {"size": 2 * MOST_ROWS, "entries": []})


def many_digits():
    return certificate("symmetric", {"size": 1000, "entries": [[i, j, "1e9999"] for i in range(1000) for j in range(3)]})


# --- At a limit: pairs of a true claim that is accepted, and one that is refused -------------------------------

def rows():
    for size in (MOST_ROWS, MOST_ROWS + 1):
        yield certificate("symmetric", diagonal(size), b=["0" * 480] * size)


def cells():
    """Rows of which no entry is listed."""
    size = 1001
    while (size + 1)**2 <= FREE_CELLS + CELLS_BY_LENGTH * length(certificate("symmetric", {"size": size + 1, "entries": []})):
        size += 1
    for n in (size, size + 1):
        yield certificate("symmetric", {"size": n, "entries": []})


def digits():
    """1e9999 has 10,000 digits, zeros have none."""
    size = 20

    def made(count, rest):
        numbers = iter(["1e9999"] * count + [f"1e{rest:04}"] + ["0"] * size**2)
        A = [["0", *(next(numbers) for _ in range(size - 1))] if i == 0 else [next(numbers) for _ in range(size)]
             for i in range(size)]
        return certificate("not-symmetric", A, i=0, j=size - 1)

    count = 0
    while (count + 1) * 10000 + 1001 <= FREE_DIGITS + DIGITS_BY_LENGTH * length(made(count + 1, 1000)):
        count += 1
    rest = FREE_DIGITS + DIGITS_BY_LENGTH * length(made(count, 1000)) - count * 10000 - 1
    for exponent in (rest, rest + 1):
        yield made(count, exponent)


def number_of(bits):
    """A number that counts for so many: its own bits, and the one of its denominator."""
    return str(2**(bits - 2))


def largest(make, fits):
    """The largest size that fits, and the one above."""
    size = 1
    while fits(2 * size, make(2 * size)):
        size *= 2
    step = size
    while step := step // 2:
        if fits(size + step, make(size + step)):
            size += step
    return make(size), make(size + 1)


def products():
    """x'Ax: the bits of the longest row, and twice those of x, which are 2; one entry of A."""
    n = 1000

    def made(bits):
        A = {"size": n, "entries": [[0, 0, "-" + number_of(bits + 2)]]}
        return certificate("not-psd", A, x=unit(n, value="-1"), value="-" + number_of(bits + 2))

    return largest(made, lambda bits, of: n * (SHORT + (bits + 6)**2) + (bits + 2) * (bits + 6) // 8 <= most_work(of))


def groups():
    """A x = b of rows that A does not couple: each counts alone, b as its row, x, and one entry of A."""
    n = 400

    def made(bits):
        value = number_of(bits + 2)
        return certificate("in-range", diagonal(n), b=[value] * n, x=[value] * n)

    def fits(bits, of):
        bits += 2
        return len(number_of(bits)) <= MOST_CHARACTERS and n * (SHORT + (2 * bits)**2 + bits * 2 * bits // 8) <= most_work(of)

    return largest(made, fits)


def denominators():
    """Long together, short in each group: numbers over powers of different primes."""
    primes = [p for p in range(3, 700) if all(p % q for q in range(2, p))][:100]
    values = [f"1/{p**100}" for p in primes]
    return certificate("in-range", diagonal(len(primes)), b=values, x=values)


def long_digits():
    """In numbers of as many as may be."""
    value, count = "7" * MOST_CHARACTERS, 500
    return certificate("symmetric", {"size": count, "entries": [[i, i, value] for i in range(count)]})


def elimination(n, times=1):
    return times * (n**3 + 60 * n**2) // 24


def eliminations():
    """A diagonal matrix: each row counts for its number, and for the coefficients of friction, of which there are none: 2."""
    n = 100

    def made(bits):
        values = [number_of(3 + bits // n + (i < bits % n)) for i in range(n)]
        A = {"size": n, "entries": [[i, i, x] for i, x in enumerate(values)]}
        return certificate("psd", A, L=[unit(n, i) for i in range(n)], D=values)

    return largest(made, lambda bits, of: bits + 5 * n <= most_bits(of, elimination(n)))


def operations():
    """Every row has bits, too: 4, and a bit more for a number that is not 0."""
    def made(n):
        return certificate("psd", diagonal(n), L=[unit(n, i) for i in range(n)], D=["1"] * n)

    def fits(n, of):
        operations = elimination(n)
        return operations * SHORT <= most_work(of) and 4 * n <= most_bits(of, operations)

    return largest(made, fits)


def steps():
    """Runs of one static contact; both are false, and the first is refused for what it says."""
    def made(count):
        run = {"policies": ["paper"], "start": 0, "period": 1, "pivots": [{}] * count, "state": {}}
        return certificate("cycle", [["1", "0"], ["0", "1"]], contacts=[{"kind": "static", "mu": "1"}], runs=[run])

    def fits(count, of):
        operations = (count + 1) * (2**3 // 4 + 3 * 2**2 + 100 * 2 + 5 * 2 + 40)
        return operations * SHORT <= most_work(of) and 2 * (2 + 2) + 0 <= most_bits(of, operations)

    return largest(made, fits)


def words():
    """Runs in space of a static contact, in a box of one coordinate; both false, as those of steps."""
    A = [[str(int(i == j)) for j in range(3)] for i in range(3)]

    def made(count):
        false = certificate("endless", A, contacts=[{"kind": "static", "mu": "1"}], policy="paper", kind="box", bits=64,
                            start=1, period=1, word=["N1 N1 C"] * count, charts=[1], centre=["0"], radii=["1"])
        false["problem"]["dimension"] = 3
        return false

    def fits(count, of):
        operations = (count + 1) * 2 * (3**3 + 20 * 3**2 + 300 * 3) // 4
        return operations * SHORT <= most_work(of) and 64 + 2 <= most_bits(of, operations)

    return largest(made, fits)


# --- Dearest -------------------------------------------------------------------------

def dense(n):
    """Two eliminations of a dense matrix, of all the bits that they may have."""
    def made(bits):
        choose = random.Random(n).getrandbits
        A = [[0] * n for _ in range(n)]
        for i in range(n):
            for j in range(i):
                A[i][j] = A[j][i] = choose(bits)
            A[i][i] = n << bits | choose(bits)
        return certificate("safe-by-condition", [list(map(str, row)) for row in A], scaling=["1"] * n, least="1",
                           most=str(n << bits + 2))

    below, _ = largest(made, lambda bits, of: 2 * n * (bits + 20) <= most_bits(of, elimination(n, 2)))
    return below


# --- The checkers ------------------------------------------------------------------

def run(command, file):
    """Exit code, what was said, processor seconds and megabytes."""
    process = subprocess.Popen([*map(str, command), str(file)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    text = process.stdout.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, text, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main(stiction, sources, *options):
    programs = {"stiction check": [stiction, "check"],
                "check_certificate.py": [sys.executable, Path(sources) / "certify/check_certificate.py"],
                "check_runs.py": [sys.executable, Path(sources) / "certify/check_runs.py"]}
    failures, dearest = [], "--dearest" in options
    if os.environ.get("STICTION_TESTS") == "short":  # the scripts are the same in every build
        programs = {"stiction check": programs["stiction check"]}

    def check(name, value, accepted, cheap=False, says=""):
        file.write_text(json.dumps(value))
        for program, command in programs.items():
            if program == "check_runs.py" and value["claim"] not in ("cycle", "endless"):
                continue
            code, text, seconds, megabytes = run(command, file)
            if says and (says not in text) == accepted:
                continue  # refused, and not for the limit
            if dearest:
                print(f"{name:14} {program:22} {text.split(':')[1].strip()[:9]:9} {seconds:8.2f} s {megabytes:7.0f} MB")
            if (code == 0) != accepted or code not in (0, 1):
                failures.append(f"{name}: {program}: exit {code}, expected {'0' if accepted else '1'}: {text[:200]}")
            if cheap and (seconds > SECONDS or megabytes > MEGABYTES):
                failures.append(f"{name}: {program}: {seconds:.1f} s, {megabytes:.0f} MB")

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "certificate.json"
        for make in (long_numbers, many_contacts, many_digits):
            check(make.__name__, make(), accepted=False, cheap=True)
        for make in (rows, cells, digits, products, eliminations, operations):
            below, above = make()
            check(make.__name__, below, accepted=True)
            check(make.__name__, above, accepted=False)
        check("denominators", denominators(), accepted=True)
        if dearest:
            check("long digits", long_digits(), accepted=True)
            for name, value, accepted in zip(("groups", "groups above"), groups(), (True, False)):
                check(name, value, accepted=accepted)
        for make in (steps, words):
            below, above = make()
            check(make.__name__, below, accepted=True, says="the limit")
            check(make.__name__, above, accepted=False, says="the limit")
        for n in (10, 40, 100) if dearest else (10,):
            check(f"dense {n}", dense(n), accepted=True)
    for failure in failures:
        print("FAILED:", failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
