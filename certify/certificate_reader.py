# SPDX-License-Identifier: Apache-2.0
"""Reads stiction certificates and problem files strictly: nothing is guessed or repaired.

What check_certificate.py and check_runs.py have in common: JSON, exact numbers, problems and their digests,
and the command line. All numbers are fractions.Fraction. Trusted: Python, its json, fractions and hashlib
modules, and this file, which was written from certify/certificates.md and shares no code or tables with the C++.

A certificate comes from anywhere. MOST_BYTES of a file, MOST_DEPTH levels, MOST_CHARACTERS of a number, MOST_DIGITS
of all numbers and MOST_ROWS keep reading it from taking memory or time; MOST_OPERATIONS and MOST_WORK keep checking
it from that (certify/certificates.md, What a check may cost).
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import sys
import textwrap
from collections import namedtuple
from fractions import Fraction
from math import isinf, isqrt, lcm
from stat import S_ISREG

MOST_BYTES = 1 << 25
MOST_DEPTH = 100
MOST_CHARACTERS = 40000
MOST_DIGITS = 20_000_000
MOST_ROWS = 3000
MOST_OPERATIONS = 2_000_000
MOST_WORK = 10**13
sys.set_int_max_str_digits(0)  # of what is computed
ZERO = Fraction(0)  # the one that stands where a sparse matrix has no entry: `is` is cheaper than a comparison


class Rejected(Exception):
    """The certificate does not prove its claim; the text says where and why."""


def brief(value):
    kind = {dict: "an object", list: "a list"}.get(type(value))
    text = kind or (str(value) if isinstance(value, Fraction) else json.dumps(value))
    return text if len(text) <= 100 else f"{text[:80]}... ({len(text)} characters)"


def need(ok, place, found, expected, meaning=""):
    if not ok:
        expected = brief(expected) if isinstance(expected, Fraction) else expected
        raise Rejected(f"{place}: found {brief(found)}, expected {expected}{meaning}")


# --- JSON --------------------------------------------------------------------------

def object_of(pairs):
    """A JSON object, with each key once, however it is escaped."""
    result = dict(pairs)
    if len(result) < len(pairs):
        raise ValueError("a key stands twice in an object")
    return result


def number_of(text):
    """A JSON number that 64 bits hold, or a double exactly."""
    nearest, whole = float(text), text.lstrip("-").isdecimal()
    if not text.isascii() or isinf(nearest) or (
            whole and not -2**63 <= int(text) < 2**64 and int(text) != nearest):
        raise ValueError(f"the number {text[:60]} is not finite, or is rounded")
    return int(text) if whole else nearest


def refuse_constant(text):
    raise ValueError(f"{text} is no JSON")


def depth(value):
    """Arrays and objects within each other."""
    inner = value.values() if type(value) is dict else value if type(value) is list else None
    return 0 if inner is None else 1 + max(map(depth, inner), default=0)


def text_of(path):
    """The text of a regular file, or of standard input as -; a named pipe might wait for ever."""
    if path == "-":
        return sys.stdin.buffer.read(MOST_BYTES + 1)
    mode = os.stat(path)
    if not S_ISREG(mode.st_mode) or mode.st_size > MOST_BYTES:
        raise ValueError(f"no regular file of at most {MOST_BYTES} bytes")
    with open(path, "rb") as file:
        return file.read()


def load(path):
    text = text_of(path)
    if len(text) > MOST_BYTES or b"\0" in text:
        raise ValueError(f"a NUL byte, or more than {MOST_BYTES} bytes")
    value = json.loads(text.decode("utf-8"), object_pairs_hook=object_of, parse_constant=refuse_constant,
                       parse_int=number_of, parse_float=number_of)
    if depth(value) > MOST_DEPTH:
        raise ValueError(f"more than {MOST_DEPTH} levels of arrays and objects")
    return value


def fields(value, place, *keys, optional=()):
    """The object `value`, which must have exactly these keys, beside optional ones."""
    need(type(value) is dict, place, value, "an object")
    for key in value:
        need(key in (*keys, *optional), place, key, f"no key but {', '.join(keys)}" if keys else "no key")
    for key in keys:
        need(key in value, place, tuple(value), f"a key {key} as well")
    return value


def items(value, place, length=None):
    """(place, item) for each item of the list `value`."""
    need(type(value) is list, place, value, "a list")
    need(length in (None, len(value)), place, len(value), f"{length} items")
    return [(f"{place}[{i}]", item) for i, item in enumerate(value)]


def one_of(value, place, allowed):
    need(type(value) is str and value in allowed, place, value, f"one of {', '.join(allowed)}")
    return value


def integer(value, place, least, below):
    """A JSON integer with least <= value < below; true and 1.0 are none."""
    need(type(value) is int and least <= value < below, place, value, f"an integer >= {least} and < {below}")
    return value


# --- Numbers -----------------------------------------------------------------------

RATIO = re.compile(r"-?[0-9]+/([0-9]+)")
DECIMAL = re.compile(r"-?[0-9]+(?:\.[0-9]+)?(?:[eE]([+-]?[0-9]+))?")


def digits_of(text):
    """Digits of numerator and denominator of what a text stands for, its exponent written out; 0 if it is no number, or
    one that `exact` refuses."""
    if len(text) > MOST_CHARACTERS:
        return 0
    if RATIO.fullmatch(text):
        return sum(len(part.lstrip("-0")) for part in text.split("/"))
    decimal = DECIMAL.fullmatch(text)
    exponent = int(decimal[1] or 0) if decimal else 0
    if not decimal or abs(exponent) > 10000:
        return 0
    whole, _, fraction = re.split("[eE]", text)[0].partition(".")
    digits = len((whole.lstrip("-") + fraction).lstrip("0"))
    return digits and digits + abs(exponent - len(fraction))


def all_digits(value):
    """Of all texts in a value; it has few levels."""
    if type(value) is str:
        return digits_of(value)
    inner = value.values() if type(value) is dict else value if type(value) is list else ()
    return sum(map(all_digits, inner))


def exact(value, place):
    """The rational that an exact string stands for."""
    need(type(value) is str, place, value, "an exact number as a string")
    need(len(value) <= MOST_CHARACTERS, place, value, f"at most {MOST_CHARACTERS} characters")
    if ratio := RATIO.fullmatch(value):
        need(int(ratio[1]) != 0, place, value, "a denominator that is not zero")
    else:
        decimal = DECIMAL.fullmatch(value)
        need(decimal, place, value, "an exact number such as -3/2, 7 or 1.5e-3")
        need(abs(int(decimal[1] or 0)) <= 10000, place, value, "an exponent within 10000")
    return Fraction(value)


def exact_or_double(value, place):
    """A number of a problem file: an exact string, or a JSON number at its double value."""
    if type(value) is float or (type(value) is int and float(value) == value):
        return Fraction(value)
    return exact(value, place)


def vector(value, place, length, number=exact):
    return [number(item, at) for at, item in items(value, place, length)]


def rows(value, place, size, number=exact):
    return [vector(row, at, size, number) for at, row in items(value, place, size)]


def matrix(value, place, size, number):
    """Dense rows; or entries [i, j, "v"], one below the diagonal standing for its mirror
    image too unless that is listed as well."""
    if type(value) is list:
        return rows(value, place, size, number)
    need(type(value) is dict, place, value, "rows, or an object of size and entries")
    fields(value, place, "size", "entries")
    integer(value["size"], place + ".size", size, size + 1)
    entries = {}
    for at, item in items(value["entries"], place + ".entries"):
        items(item, at, 3)
        i, j = (integer(item[k], f"{at}[{k}]", 0, size) for k in (0, 1))
        need((i, j) not in entries, at, (i, j), "each entry once")
        entries[i, j] = number(item[2], at + "[2]")
    A = [[ZERO] * size for _ in range(size)]
    for (i, j), x in entries.items():
        need(i >= j or (j, i) in entries, place + ".entries", (i, j), f"{[j, i]} as well")
        A[i][j] = x
        A[j][i] = entries.get((j, i), x)
    return A


def dot(x, y):
    return sum((u * v for u, v in zip(x, y) if u and v), Fraction(0))


def times(A, x):
    return [dot(row, x) for row in A]


def entries_of(A):
    """Of every row its (column, number), zeros left out."""
    return [[(j, x) for j, x in enumerate(row) if x is not ZERO and x] for row in A]


def groups_of(entries):
    """The rows by groups: no entry of A lies in the rows of one and the columns of another."""
    first = list(range(len(entries)))  # of its group; of the last of those joined so far: another of it

    def group(i):
        while first[i] != i:
            first[i] = i = first[first[i]]
        return i

    for i, row in enumerate(entries):
        for j, _ in row:
            first[group(j)] = group(i)
    groups = {}
    for i in range(len(entries)):
        groups.setdefault(group(i), []).append(i)
    return list(groups.values())


def long_times(A, x):
    """A x, A square: the numbers of x in every group of rows over their common denominator."""
    entries, product = entries_of(A), [Fraction(0)] * len(x)
    for group in groups_of(entries):
        denominator = lcm(*(x[j].denominator for j in group))
        integers = {j: x[j].numerator * (denominator // x[j].denominator) for j in group if x[j]}
        for i in group:
            product[i] = sum((y * integers[j] for j, y in entries[i] if j in integers), Fraction(0)) / denominator
    return product


# --- Problems ----------------------------------------------------------------------

Contact = namedtuple("Contact", "kind mu slip")  # slip: one component in the plane, two in space
Problem = namedtuple("Problem", "dimension contacts A b")
KEYS = {"bilateral": ("kind",), "frictionless": ("kind",), "static": ("kind", "mu"),
        "sliding": ("kind", "mu", "slip")}


def read_contact(value, place, dimension, number):
    need(type(value) is dict and "kind" in value, place, value, "an object with a key kind")
    kind = one_of(value["kind"], place + ".kind", KEYS)
    fields(value, place, *KEYS[kind])
    mu, slip = None, ()
    if "mu" in value:
        mu = number(value["mu"], place + ".mu")
        need(mu >= 0, place + ".mu", mu, "mu >= 0")
    if "slip" in value and dimension == 2:
        slip = (Fraction(one_of(value["slip"], place + ".slip", ("1", "-1"))),)
    elif "slip" in value:
        slip = tuple(vector(value["slip"], place + ".slip", 2, number))
        need(dot(slip, slip) == 1, place + ".slip", value["slip"], "a unit vector")
    return Contact(kind, mu, slip)


def read_problem(value, place="$.problem", number=exact, optional=()):
    """The problem of a certificate; rows follow contacts, normal first."""
    fields(value, place, "format", "version", "dimension", "contacts", "A", "b", optional=optional)
    one_of(value["format"], place + ".format", ("stiction-problem",))
    integer(value["version"], place + ".version", 1, 2)
    dimension = integer(value["dimension"], place + ".dimension", 2, 4)
    listed = items(value["contacts"], place + ".contacts")
    need(len(listed) <= MOST_ROWS, place + ".contacts", len(listed), f"at most {MOST_ROWS}")
    contacts = [read_contact(item, at, dimension, number) for at, item in listed]
    size = sum(dimension if "mu" in KEYS[contact.kind] else 1 for contact in contacts)
    need(size <= MOST_ROWS, place + ".contacts", f"contacts of {size} rows", f"at most {MOST_ROWS}")
    return Problem(dimension, contacts, matrix(value["A"], place + ".A", size, number),
                   vector(value["b"], place + ".b", size, number))


def read_problem_file(path):
    return read_problem(load(path), "$", exact_or_double, ("name", "scene", "origin", "expect"))


def digest(problem):
    """SHA-256 of the problem written in one way: a line for each contact and row, numbers in lowest terms."""
    lines = ["stiction-problem 1", f"dimension {problem.dimension}"]
    lines += [" ".join([kind, *map(str, [] if mu is None else [mu]), *map(str, slip)])
              for kind, mu, slip in problem.contacts]
    lines += [" ".join([letter, *("0" if x is ZERO else str(x) for x in row)])
              for letter, row in [*(("A", row) for row in problem.A), ("b", problem.b)]]
    return "sha256:" + hashlib.sha256("".join(line + "\n" for line in lines).encode("ascii")).hexdigest()


def planar_contacts(problem):
    """(number, contact, its rows) for each contact of a planar problem."""
    need(problem.dimension == 2, "$.problem.dimension", problem.dimension,
         "2: others are not supported by this checker for this claim")
    row = 0
    for i, contact in enumerate(problem.contacts):
        span = range(row, row + (1 if contact.mu is None else 2))
        yield i, contact, span
        row = span.stop


# --- What a check will cost, bounded before it begins ---------------------------

def require_cheap_product(problem, x, squared=False):
    """Of A x or A'x, added up over the groups of rows that A couples: so many rows of long numbers, and entries by which
    long ones are multiplied. `squared`: all rows are added up, and x counts twice, as for x'Ax."""
    entries, columns = entries_of(problem.A), [[] for _ in x]
    for i, row in enumerate(entries):
        for j, y in row:
            columns[j].append(y)
    work = 0
    for group in [range(len(x))] if squared else groups_of(entries):
        cost = Cost(len(group))
        longest = max((cost.bits(numbers) for i in group
                       for numbers in ([problem.b[i], *(y for _, y in entries[i])], columns[i])), default=0)
        bits = cost.add(longest).numbers([x[i] for i in group], 1 + squared).total
        work += len(group) * bits**2 + sum(len(entries[i]) for i in group) * longest * bits // 8
        need(work <= MOST_WORK, "$", f"a product of work {work}", f"at most {MOST_WORK}")


def product_operations(n, times=1):
    """Of A x, n rows."""
    return times * (n**2 + 8 * n) // 8


def elimination_operations(n, times=1):
    """Of A."""
    return times * (n**3 + 10 * n**2) // 10


def reduced_operations(n, times=1):
    """Of a reduced matrix: half as large."""
    return times * (n**3 + 240 * n) // 240


class Cost:
    """So many operations on numbers whose bits add up: a determinant of A has no more bits than the rows of A
    together, each over its common denominator."""

    def __init__(self, operations):
        need(operations <= MOST_OPERATIONS, "$", f"a claim that takes {operations} operations",
             f"at most {MOST_OPERATIONS}")
        self.most, self.total = isqrt(MOST_WORK // max(operations, 1)), 0

    def bits(self, numbers):
        """Of the common denominator and of the largest numerator; it need not be known exactly beyond the limit."""
        denominator, numerator = 1, 1
        for x in numbers:
            denominator = lcm(denominator, x.denominator)
            if denominator.bit_length() > self.most:
                return self.most + 1
        for x in numbers:
            numerator = max(numerator, (x.numerator * (denominator // x.denominator)).bit_length())
        return denominator.bit_length() + numerator

    def add(self, bits):
        self.total += bits
        need(self.total <= self.most, "$", f"numbers that grow beyond {self.most} bits",
             "fewer, for as many operations as the claim takes")
        return self

    def numbers(self, numbers, times=1):
        return self.add(times * self.bits(numbers))

    def longest_row(self, problem):
        """Or column, of A and b."""
        longest = 0
        for row, right, column in zip(problem.A, problem.b, zip(*problem.A)):
            longest = max(longest, self.bits([right, *row]), self.bits(column))
            if longest > self.most:
                break
        return self.add(longest)

    def all_rows(self, problem):
        """Of A and b, each with the coefficients of friction."""
        friction = self.bits([contact.mu for contact in problem.contacts if contact.mu is not None])
        for row, right in zip(problem.A, problem.b):
            self.add(self.bits([right, *row]) + friction)
        return self


# --- The command line --------------------------------------------------------------

def check(certificate, claims, expected=None):
    """The claim, facts about it and the problem's digest, of a certificate that proves it; or raises Rejected.

    claims: name -> (keys of the witness, check(problem, witness), which returns the facts); keys behind a bar are
    those of another form of it; expected: the digest that is asked for."""
    fields(certificate, "$", "format", "version", "claim", "problem", "witness")
    one_of(certificate["format"], "$.format", ("stiction-certificate",))
    integer(certificate["version"], "$.version", 1, 2)
    claim = one_of(certificate["claim"], "$.claim", claims)
    digits = all_digits(certificate["problem"]) + all_digits(certificate["witness"])
    need(digits <= MOST_DIGITS, "$", f"numbers of {digits} digits", f"at most {MOST_DIGITS} in all")
    problem = read_problem(certificate["problem"])
    found = digest(problem)
    need(expected in (None, found), "$.problem", found, f"{expected}, the problem that was asked for")
    keys, facts = claims[claim]
    forms, stated = [form.split() for form in keys.split("|")], certificate["witness"]
    form = next((form for form in forms if type(stated) is dict and set(stated) == set(form)), forms[0])
    witness = fields(stated, "$.witness", *form)
    return f"{claim} ({facts(problem, witness)}), problem {found}"


def tell(text):
    """In lines that fit the terminal; in one where nothing says how wide it is."""
    if os.environ.get("COLUMNS") or sys.stdout.isatty():
        text = textwrap.fill(text, shutil.get_terminal_size().columns, subsequent_indent="  ", break_long_words=False,
                             break_on_hyphens=False)
    print(text)


def check_file(path, claims, expected):
    """Prints the verdict on one file; returns its exit status."""
    try:
        certificate = load(path)
    except (OSError, ValueError, RecursionError) as error:
        print(f"{path}: unreadable: {error}", file=sys.stderr)
        return 2
    try:
        tell(f"{path}: accepted: {check(certificate, claims, expected)}")
        return 0
    except Rejected as reason:
        tell(f"{path}: REJECTED: {reason}")
        return 1


EXITS = """
exit status:
  0  every certificate was accepted
  1  one was rejected; its line says where and why
  2  a file could not be read or is no JSON; bad usage
"""


def main(claims, description, epilog):
    parser = argparse.ArgumentParser(description=description, epilog=epilog + EXITS,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("certificates", nargs="+", metavar="CERT", help="a certificate file; - is standard input")
    parser.add_argument("--problem", metavar="FILE", help="the problem file that all of them must speak of")
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")
    arguments = parser.parse_args()
    try:
        expected = arguments.problem and digest(read_problem_file(arguments.problem))
    except (OSError, ValueError, RecursionError, Rejected) as error:
        parser.exit(2, f"{arguments.problem}: no problem: {error}\n")
    return max([check_file(path, claims, expected) for path in arguments.certificates])
