# SPDX-License-Identifier: Apache-2.0
"""Reads stiction certificates and problem files strictly: nothing is guessed or repaired.

What check_certificate.py and check_runs.py have in common: JSON, exact numbers, problems and their digests,
and the command line. All numbers are fractions.Fraction. Trusted: Python, its json, fractions and hashlib
modules, and this file, which was written from certify/certificates.md and shares no code or tables with the C++.

A certificate comes from anywhere. MOST_BYTES of a file, MOST_DEPTH levels, MOST_CHARACTERS of a number and MOST_ROWS
bound what is read; Budget bounds what is done with it, by the length of what was read, before it is done
(certify/certificates.md, What a check may cost).
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
from functools import lru_cache
from math import isinf, isqrt, lcm
from stat import S_ISREG

MOST_BYTES = 1 << 25
MOST_DEPTH = 100
MOST_CHARACTERS = 40000
MOST_EXPONENT = 10000
MOST_ROWS = 3000
REMEMBERED = 1 << 16  # texts of numbers, which come again and again
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


def inside(values):
    """What lies in the arrays and objects among these values."""
    return [item for value in values if type(value) in (list, dict)
            for item in (value if type(value) is list else value.values())]


def depth(value):
    """Arrays and objects within each other."""
    levels, values = 0, [value]
    while any(type(value) in (list, dict) for value in values):
        levels, values = levels + 1, inside(values)
    return levels


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


def listed(value, place, length=None):
    """The list `value`."""
    need(type(value) is list, place, value, "a list")
    need(length in (None, len(value)), place, len(value), f"{length} items")
    return value


def items(value, place, length=None):
    """(place, item) for each item of the list `value`, one after the other."""
    return ((f"{place}[{i}]", item) for i, item in enumerate(listed(value, place, length)))


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


def exponent_of(decimal):
    """Of what DECIMAL found; None beyond MOST_EXPONENT, however it is written."""
    sign, digits = re.fullmatch("([+-]?)0*([0-9]*)", decimal[1] or "").groups()
    if len(digits) > len(str(MOST_EXPONENT)) or int(digits or 0) > MOST_EXPONENT:
        return None
    return int(sign + (digits or "0"))


@lru_cache(maxsize=REMEMBERED)
def digits_of(text):
    """Digits of numerator and denominator of what a text stands for, its exponent written out; 0 if it is no number, or
    one that `exact` refuses."""
    if len(text) > MOST_CHARACTERS:
        return 0
    if RATIO.fullmatch(text):
        return sum(len(part.lstrip("-0")) for part in text.split("/"))
    decimal = DECIMAL.fullmatch(text)
    exponent = exponent_of(decimal) if decimal else None
    if exponent is None:
        return 0
    whole, _, fraction = re.split("[eE]", text)[0].partition(".")
    digits = len((whole.lstrip("-") + fraction).lstrip("0"))
    return digits and digits + abs(exponent - len(fraction))


@lru_cache(maxsize=REMEMBERED)
def value_of(text):
    """The rational that an exact text stands for; otherwise a text: what is expected instead."""
    if len(text) > MOST_CHARACTERS:
        return f"at most {MOST_CHARACTERS} characters"
    if ratio := RATIO.fullmatch(text):
        return Fraction(text) if ratio[1].strip("0") else "a denominator that is not zero"
    decimal = DECIMAL.fullmatch(text)
    if not decimal:
        return "an exact number such as -3/2, 7 or 1.5e-3"
    if exponent_of(decimal) is None:
        return f"an exponent within {MOST_EXPONENT}"
    return Fraction(text)


def exact(value, place):
    """The rational that an exact string stands for."""
    number = value_of(value) if type(value) is str else "an exact number as a string"
    if type(number) is not Fraction:
        need(False, place, value, number)
    return number


def exact_or_double(value, place):
    """A number of a problem file: an exact string, or a JSON number at its double value."""
    if type(value) is float or (type(value) is int and float(value) == value):
        return Fraction(value)
    return exact(value, place)


def vector(value, place, length, number=exact):
    try:
        return [number(item, place) for item in listed(value, place, length)]
    except Rejected:
        for at, item in items(value, place, length):
            number(item, at)  # which one it is
        raise


def rows(value, place, size, number=exact):
    return [vector(row, at, size, number) for at, row in items(value, place, size)]


def read_entries(value, place, rows, columns, number=exact):
    """{(row, column): number} of a list of entries [row, column, number]."""
    entries = {}
    for k, item in enumerate(listed(value, place)):
        fits = type(item) is list and len(item) == 3 and type(item[0]) is int is type(item[1])
        if not (fits and 0 <= item[0] < rows and 0 <= item[1] < columns):
            at = f"{place}[{k}]"
            listed(item, at, 3)
            integer(item[0], at + "[0]", 0, rows)
            integer(item[1], at + "[1]", 0, columns)
        if (item[0], item[1]) in entries:
            need(False, f"{place}[{k}]", item[:2], "each entry once")
        entries[item[0], item[1]] = number(item[2], f"{place}[{k}][2]")
    return entries


def matrix(value, place, size, number):
    """Dense rows; or entries [i, j, "v"], one below the diagonal standing for its mirror
    image too unless that is listed as well."""
    if type(value) is list:
        return rows(value, place, size, number)
    need(type(value) is dict, place, value, "rows, or an object of size and entries")
    fields(value, place, "size", "entries")
    integer(value["size"], place + ".size", size, size + 1)
    entries = read_entries(value["entries"], place + ".entries", size, size, number)
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


def over(numbers):
    """Integers, and the denominator that they have in common."""
    denominator = lcm(*{x.denominator for x in numbers})
    if denominator == 1:
        return [x.numerator for x in numbers], 1
    return [x.numerator * (denominator // x.denominator) for x in numbers], denominator


def long_times(A, x):
    """A x, A square: the numbers of x in every group of rows, and those of every row, over their common denominator."""
    entries, product = entries_of(A), [ZERO] * len(x)
    for group in groups_of(entries):
        integers, denominator = over([x[j] for j in group])
        integers = dict(zip(group, integers))
        for i in group:
            row, below = over([y for _, y in entries[i]])
            total = sum(y * integers[j] for y, (j, _) in zip(row, entries[i]))
            if total:
                product[i] = Fraction(total, below * denominator)
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
    count = len(listed(value["contacts"], place + ".contacts"))
    need(count <= MOST_ROWS, place + ".contacts", count, f"at most {MOST_ROWS}")
    contacts = [read_contact(item, at, dimension, number) for at, item in items(value["contacts"], place + ".contacts")]
    size = sum(dimension if "mu" in KEYS[contact.kind] else 1 for contact in contacts)
    need(size <= MOST_ROWS, place + ".contacts", f"contacts of {size} rows", f"at most {MOST_ROWS}")
    if number is exact:  # a certificate's: a problem file is the reader's own
        Budget.require_cells(size, place + ".contacts")
    return Problem(dimension, contacts, matrix(value["A"], place + ".A", size, number),
                   vector(value["b"], place + ".b", size, number))


def read_problem_file(path):
    return read_problem(load(path), "$", exact_or_double, ("name", "scene", "origin", "expect"))


def digest(problem):
    """SHA-256 of the problem written in one way: a line for each contact and row, numbers in lowest terms."""
    lines = ["stiction-problem 1", f"dimension {problem.dimension}"]
    lines += [" ".join([kind, *map(str, [] if mu is None else [mu]), *map(str, slip)])
              for kind, mu, slip in problem.contacts]
    texts = {}  # by number, of which many are one object

    def text(x):
        known = texts.get(id(x)) or str(x)
        if len(texts) < REMEMBERED:
            texts[id(x)] = known
        return known

    lines += [" ".join([letter, *map(text, row)])
              for letter, row in [*(("A", row) for row in problem.A), ("b", problem.b)]]
    return "sha256:" + hashlib.sha256("".join(line + "\n" for line in lines).encode("ascii")).hexdigest()


def contacts_of(problem):
    """(number, contact, its rows) for each contact."""
    row = 0
    for i, contact in enumerate(problem.contacts):
        span = range(row, row + (1 if contact.mu is None else problem.dimension))
        yield i, contact, span
        row = span.stop


def planar_contacts(problem):
    """The same of a planar problem."""
    need(problem.dimension == 2, "$.problem.dimension", problem.dimension,
         "2: others are not supported by this checker for this claim")
    return contacts_of(problem)


# --- What a check will cost, bounded before it begins ---------------------------

class Budget:
    """What a certificate may cost, by the length of the one that is being checked.

    The unit of work is a millionth of the time that one operation on short numbers takes."""

    FREE_WORK, WORK_PER_CHARACTER = 6 * 10**12, 250_000
    FREE_DIGITS, DIGITS_PER_CHARACTER = 1_000_000, 2
    FREE_CELLS, CELLS_PER_CHARACTER = 2_000_000, 5
    SHORT = 10**6  # the square of the bits with which an operation takes twice as long
    length = 0

    @classmethod
    def of(cls, *values):
        """Sets the length: characters of all texts and keys, and two for every value; refuses too many digits."""
        length = digits = 0
        while values:
            for value in values:
                if type(value) is str:
                    length += len(value)
                    digits += digits_of(value)
                elif type(value) is dict:
                    length += sum(map(len, value))
            length += 2 * len(values)
            values = inside(values)
        cls.length = length
        most = cls.FREE_DIGITS + cls.DIGITS_PER_CHARACTER * length
        need(digits <= most, "$", f"numbers of {digits} digits", f"{LIMIT} of {most} in all, by its length of {length}")

    @classmethod
    def require_cells(cls, size, place):
        """Of a matrix of so many rows."""
        most = cls.FREE_CELLS + cls.CELLS_PER_CHARACTER * cls.length
        need(size**2 <= most, place, f"{size} rows, a matrix of {size**2} entries",
             f"{LIMIT} of {most}, by its length of {cls.length}")

    @classmethod
    def most_work(cls):
        return cls.FREE_WORK + cls.WORK_PER_CHARACTER * cls.length

    @classmethod
    def require_work(cls, work):
        need(work <= cls.most_work(), "$", f"a claim of work {work}",
             f"{LIMIT} of {cls.most_work()}, by its length of {cls.length}")


LIMIT = "no more than the limit"  # begins the reason of all that is refused for what it costs


def require_cheap_product(problem, x, squared=False):
    """Of A x or A'x, added up over the groups of rows that A couples: so many rows of long numbers, and entries by
    which long ones are multiplied. `squared`: all rows are added up, and x counts twice, as for x'Ax."""
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
        work += len(group) * (Budget.SHORT + bits**2) + sum(len(entries[i]) for i in group) * longest * bits // 8
        Budget.require_work(work)


def product_operations(n, times=1):
    """Of A x, n rows."""
    return times * (n**2 + 64 * n + 320) // 16


def elimination_operations(n, times=1):
    """Of A."""
    return times * (n**3 + 60 * n**2) // 24


class Cost:
    """So many operations on numbers whose bits add up: a determinant of A has no more bits than the rows of A
    together, each over its common denominator."""

    def __init__(self, operations):
        Budget.require_work(operations * Budget.SHORT)
        self.most, self.total = isqrt(Budget.most_work() // max(operations, 1) - Budget.SHORT), 0

    def bits(self, numbers):
        """Of the common denominator and of the largest numerator; it need not be known exactly beyond the limit."""
        denominator, numerator = 1, 1
        for below in {x.denominator for x in numbers}:
            denominator = lcm(denominator, below)
            if denominator.bit_length() > self.most:
                return self.most + 1
        for x in numbers:
            numerator = max(numerator, (x.numerator * (denominator // x.denominator)).bit_length())
        return denominator.bit_length() + numerator

    def add(self, bits):
        self.total += bits
        need(self.total <= self.most, "$", f"numbers that grow beyond {self.most} bits",
             f"{LIMIT}: fewer bits, for as many operations as the claim takes")
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


# --- Elimination ---------------------------------------------------------------------
#
# Without fractions (E. H. Bareiss, Math. Comp. 22, 1968): rows over their common denominators are integers, and what is
# left after k pivots is, times the k-th leading minor, integer too.

def integer_rows(M):
    """Rows of integers, and the denominator of each."""
    found = list(map(over, M))
    return [row for row, _ in found], [denominator for _, denominator in found]


def take_pivot(rows, minor):
    """Of what is left, times `minor`: the same with its first row and column taken away, which is times their pivot."""
    pivot, *top = rows[0]
    rest = []
    for first, *row in rows[1:]:
        if first:
            row = [(pivot * x - first * y) // minor for x, y in zip(row, top)]
        elif pivot != minor:
            row = [pivot * x // minor for x in row]
        rest.append(row)
    return rest, pivot


def drop_pivot(rows):
    """Without its first row and column, where these are zero."""
    return [row[1:] for row in rows[1:]]


# --- The command line --------------------------------------------------------------

def check(certificate, claims, expected=None):
    """The claim, facts about it and the problem's digest, of a certificate that proves it; or raises Rejected.

    claims: name -> (keys of the witness, check(problem, witness), which returns the facts); keys behind a bar are
    those of another form of it; expected: the digest that is asked for."""
    fields(certificate, "$", "format", "version", "claim", "problem", "witness")
    one_of(certificate["format"], "$.format", ("stiction-certificate",))
    integer(certificate["version"], "$.version", 1, 2)
    claim = one_of(certificate["claim"], "$.claim", claims)
    Budget.of(certificate["problem"], certificate["witness"])
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
