#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks stiction certificates: a claim about a contact problem, with an exact witness.

Letters are those of [Baraff94] (D. Baraff, Fast contact force computation for
nonpenetrating rigid bodies, SIGGRAPH 1994), section 5:

  a = A f + b       forces f and accelerations a, one row per variable
  fN, aN            normal force and acceleration of a contact: variables N1, N2, ...
  fF, aF            friction force, tangential acceleration: variables F1, F2, ...
  mu                coefficient of friction, abs(fF) <= mu fN
  df, da, s         a step of length s adds s df to f and s da to a; da = A df
  C NC CF NC- NC+   the index sets of sections 4.1 and 5.3

All numbers are fractions.Fraction and all comparisons exact: there is no tolerance.
For `cycle` and `stall` the published algorithm is run here, from f = 0, under every
policy named, and the certificate must agree with that run step by step. What a run
is, switch by switch, is fixed in solver/published/readings.md, whose sections this file
follows; the certificate format is in certify/README.md.

Trusted: Python, its json and fractions modules, and this file, which was written
from those documents and shares no code or tables with the C++.
"""

import argparse
import json
import os
import re
import sys
from collections import namedtuple
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import product
from math import isinf, prod
from stat import S_ISREG

sys.set_int_max_str_digits(0)  # numbers may have more than 4300 digits
MOST_BYTES = 1 << 30  # of a file
MOST_DEPTH = 100


# --- Reading: strict, nothing is guessed or repaired -------------------------------

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


def object_of(pairs):
    """A JSON object, with each key once."""
    result = dict(pairs)
    if len(result) < len(pairs):
        raise ValueError("a key stands twice in an object")
    return result


def number_of(text):
    """A JSON number that 64 bits hold, or a double exactly."""
    nearest = float(text)
    if isinf(nearest) or (text.lstrip("-").isdigit() and not -2**63 <= int(text) < 2**64 and int(text) != nearest):
        raise ValueError(f"the number {text[:60]} is not finite, or is rounded")
    return int(text) if text.lstrip("-").isdigit() else nearest


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


def fields(value, place, *keys):
    """The object `value`, which must have exactly these keys."""
    need(type(value) is dict, place, value, "an object")
    for key in value:
        need(key in keys, place, key, f"no key but {', '.join(keys)}" if keys else "no key")
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
    need(type(value) is int and least <= value < below, place, value,
         f"an integer >= {least} and < {below}")
    return value


RATIO = re.compile(r"-?[0-9]+/([0-9]+)")
DECIMAL = re.compile(r"-?[0-9]+(?:\.[0-9]+)?(?:[eE]([+-]?[0-9]+))?")


def exact(value, place):
    """The rational that an exact string stands for."""
    need(type(value) is str, place, value, "an exact number as a string")
    if ratio := RATIO.fullmatch(value):
        need(int(ratio[1]) != 0, place, value, "a denominator that is not zero")
    else:
        decimal = DECIMAL.fullmatch(value)
        need(decimal, place, value, "an exact number such as -3/2, 7 or 1.5e-3")
        need(abs(int(decimal[1] or 0)) <= 10000, place, value, "an exponent within 10000")
    return Fraction(value)


def vector(value, place, length):
    return [exact(item, at) for at, item in items(value, place, length)]


def rows(value, place, size):
    return [vector(row, at, size) for at, row in items(value, place, size)]


def matrix(value, place, size):
    """Dense rows; or entries [i, j, "v"], one below the diagonal standing for its mirror
    image too unless that is listed as well."""
    if type(value) is list:
        return rows(value, place, size)
    need(type(value) is dict, place, value, "rows, or an object of size and entries")
    fields(value, place, "size", "entries")
    integer(value["size"], place + ".size", size, size + 1)
    entries = {}
    for at, item in items(value["entries"], place + ".entries"):
        items(item, at, 3)
        i, j = (integer(item[k], f"{at}[{k}]", 0, size) for k in (0, 1))
        need((i, j) not in entries, at, (i, j), "each entry once")
        entries[i, j] = exact(item[2], at + "[2]")
    for i, j in entries:
        need(i >= j or (j, i) in entries, place + ".entries", (i, j), f"{[j, i]} as well")
    return [[entries.get((i, j), entries.get((max(i, j), min(i, j)), Fraction(0)))
             for j in range(size)] for i in range(size)]


# --- The problem -------------------------------------------------------------------

Contact = namedtuple("Contact", "kind mu slip")
# A planar variable; contact counts from 0; normal and friction are the rows of the
# contact's two variables, friction None unless the contact is static and never row 0.
Variable = namedtuple("Variable", "name contact normal friction mu")


class Problem:
    def __init__(self, dimension, contacts, A, b):
        self.dimension, self.contacts, self.A, self.b = dimension, contacts, A, b

    @cached_property
    def variables(self):
        """One per row of a planar problem."""
        result = []
        for i, (kind, mu, _), rows in planar_contacts(self):
            friction = rows[1] if kind == "static" else None
            result += [Variable(f"{letter}{i + 1}", i, rows[0], friction, mu)
                       for letter in "NF"[:len(rows)]]
        return result

    @cached_property
    def held(self):
        """The rows of bilateral contacts, which stay in C (4.5)."""
        return [rows[0] for _, contact, rows in planar_contacts(self) if contact.kind == "bilateral"]

    @cached_property
    def sliding(self):
        """For the normal row of each sliding contact the factor of fF = -mu slip fN (24), in the row behind."""
        return {rows[0]: -limit(contact) for _, contact, rows in planar_contacts(self)
                if contact.kind == "sliding"}

    def is_passive(self, row):
        """Whether the algorithm never looks at the conditions of this row."""
        return row in self.held or row - 1 in self.sliding


KEYS = {"bilateral": ("kind",), "frictionless": ("kind",), "static": ("kind", "mu"),
        "sliding": ("kind", "mu", "slip")}


def read_contact(value, place, dimension):
    need(type(value) is dict and "kind" in value, place, value, "an object with a key kind")
    kind = one_of(value["kind"], place + ".kind", KEYS)
    fields(value, place, *KEYS[kind])
    mu = slip = None
    if "mu" in value:
        mu = exact(value["mu"], place + ".mu")
        need(mu >= 0, place + ".mu", mu, "mu >= 0")
    if "slip" in value and dimension == 2:
        slip = one_of(value["slip"], place + ".slip", ("1", "-1"))
    elif "slip" in value:
        slip = vector(value["slip"], place + ".slip", 2)
        need(dot(slip, slip) == 1, place + ".slip", value["slip"], "a unit vector")
    return Contact(kind, mu, slip)


def read_problem(value, place="$.problem"):
    """The problem of a certificate; rows follow contacts, normal first."""
    fields(value, place, "format", "version", "dimension", "contacts", "A", "b")
    one_of(value["format"], place + ".format", ("stiction-problem",))
    integer(value["version"], place + ".version", 1, 2)
    dimension = integer(value["dimension"], place + ".dimension", 2, 4)
    contacts = [read_contact(item, at, dimension)
                for at, item in items(value["contacts"], place + ".contacts")]
    size = sum(dimension if "mu" in KEYS[contact.kind] else 1 for contact in contacts)
    return Problem(dimension, contacts, matrix(value["A"], place + ".A", size),
                   vector(value["b"], place + ".b", size))


# --- Claims on A and b, and a solution: each check returns the facts to print -------

def dot(x, y):
    return sum((u * v for u, v in zip(x, y) if u and v), Fraction(0))


def times(A, x):
    return [dot(row, x) for row in A]


def equal(found, expected, place, meaning):
    for i, (x, y) in enumerate(zip(found, expected)):
        need(x == y, f"{place}[{i}]", x, y, f" ({meaning})")


def check_symmetric(problem, witness):
    fields(witness, "$.witness")
    for i, (row, column) in enumerate(zip(problem.A, zip(*problem.A))):
        equal(row, column, f"$.problem.A[{i}]", "a symmetric matrix")
    return f"{len(problem.b)} rows"


def check_not_symmetric(problem, witness):
    fields(witness, "$.witness", "i", "j")
    i, j = (integer(witness[k], f"$.witness.{k}", 0, len(problem.b)) for k in "ij")
    need(problem.A[i][j] != problem.A[j][i], "$.witness", (i, j), "A_ij to differ from A_ji")
    return f"i = {i}, j = {j}"


def check_psd(problem, witness):
    """A = L diag(D) L' with D >= 0, so x'Ax = sum of D_i (L'x)_i^2 >= 0."""
    fields(witness, "$.witness", "L", "D")
    n = len(problem.b)
    L, D = rows(witness["L"], "$.witness.L", n), vector(witness["D"], "$.witness.D", n)
    check_symmetric(problem, {})
    for i in range(n):
        need(D[i] >= 0, f"$.witness.D[{i}]", D[i], "D >= 0")
        equal(L[i][i:], [1] + [0] * (n - i - 1), f"$.witness.L[{i}][{i}:]",
              "a lower triangle with unit diagonal")
        scaled = [x * y for x, y in zip(L[i], D)]
        equal(times(L, scaled), problem.A[i], f"$.witness (L diag(D) L')[{i}]", "A")
    return f"{n} rows"


def check_not_psd(problem, witness):
    fields(witness, "$.witness", "x", "value")
    x = vector(witness["x"], "$.witness.x", len(problem.b))
    value = exact(witness["value"], "$.witness.value")
    need(value < 0, "$.witness.value", value, "a value < 0")
    xAx = dot(x, times(problem.A, x))
    need(value == xAx, "$.witness.value", value, xAx, " (x'Ax)")
    return f"{len(x)} rows"


def check_in_range(problem, witness):
    fields(witness, "$.witness", "x")
    x = vector(witness["x"], "$.witness.x", len(problem.b))
    equal(times(problem.A, x), problem.b, "$.witness (A x)", "b")
    return f"{len(x)} rows"


def check_not_in_range(problem, witness):
    fields(witness, "$.witness", "y", "value")
    y = vector(witness["y"], "$.witness.y", len(problem.b))
    value = exact(witness["value"], "$.witness.value")
    need(value != 0, "$.witness.value", value, "a value other than 0")
    yb = dot(y, problem.b)
    need(value == yb, "$.witness.value", value, yb, " (y'b)")
    equal(times(zip(*problem.A), y), [0] * len(y), "$.witness (y'A)", "y'A = 0")
    return f"{len(y)} rows"


def cones(problem):
    """(kind, mu, normal row, tangent rows) of each contact; none of them sliding."""
    row = 0
    for i, (kind, mu, _) in enumerate(problem.contacts):
        need(kind != "sliding", f"$.problem.contacts[{i}].kind", kind, "bilateral, frictionless or static")
        end = row + (problem.dimension if kind == "static" else 1)
        yield kind, mu or Fraction(0), row, range(row + 1, end)
        row = end


def check_h(problem, witness):
    """b = A'y + g, g in the dual of the friction cones: b'v = y'Av + g'v >= 0 where A v = 0."""
    fields(witness, "$.witness", "y")
    y = vector(witness["y"], "$.witness.y", len(problem.b))
    g = [x - z for x, z in zip(problem.b, times(zip(*problem.A), y))]
    for kind, mu, normal, tangents in cones(problem):
        place, gN = f"$.witness (b - A'y)[{normal}]", g[normal]
        need(gN == 0 if kind == "bilateral" else gN >= 0, place, gN,
             "0" if kind == "bilateral" else "gN >= 0")
        need(gN ** 2 >= mu ** 2 * sum(g[k] ** 2 for k in tangents), place, gN, "gN >= mu abs(gF)")
    return f"{len(y)} rows"


def check_not_h(problem, witness):
    """v in the friction cones with A v = 0 and b'v < 0."""
    fields(witness, "$.witness", "v", "value")
    v = vector(witness["v"], "$.witness.v", len(problem.b))
    value = exact(witness["value"], "$.witness.value")
    need(value < 0, "$.witness.value", value, "a value < 0")
    bv = dot(v, problem.b)
    need(value == bv, "$.witness.value", value, bv, " (b'v)")
    equal(times(problem.A, v), [0] * len(v), "$.witness (A v)", "A v = 0")
    for kind, mu, normal, tangents in cones(problem):
        place, vN = f"$.witness.v[{normal}]", v[normal]
        need(kind == "bilateral" or vN >= 0, place, vN, "vN >= 0")
        need(sum(v[k] ** 2 for k in tangents) <= mu ** 2 * vN ** 2, place, vN, "abs(vF) <= mu vN")
    return f"{len(v)} rows"


def violated(problem, f, a, row):
    """A normal that fails (15), or a friction variable that fails (16) while (15) holds."""
    if problem.is_passive(row):
        return False
    x = problem.variables[row]
    fN, aN = f[x.normal], a[x.normal]
    holds = fN >= 0 and aN >= 0 and fN * aN == 0
    if row == x.normal or not holds:
        return row == x.normal and not holds
    fF, aF, bound = f[row], a[row], x.mu * fN
    return not (abs(fF) <= bound and aF * fF <= 0 and aF * (bound - abs(fF)) == 0)


def forces(problem, witness):
    """f and a of a witness, once a = A f + b."""
    f, a = (vector(witness[k], f"$.witness.{k}", len(problem.b)) for k in "fa")
    equal(a, [x + y for x, y in zip(times(problem.A, f), problem.b)], "$.witness.a", "A f + b")
    return f, a


def check_solution(problem, witness):
    fields(witness, "$.witness", "f", "a")
    f, a = forces(problem, witness)
    if problem.dimension == 3:
        return check_in_space(problem, f, a, weak)
    for i, contact, rows in planar_contacts(problem):
        force, answer = ([values[row] for row in rows] for values in (f, a))
        need(any(in_mode(mode, contact, force, answer) for mode in modes_of(contact)),
             f"$.witness.f[{rows[0]}]", force[0],
             f"a force by the law of a {contact.kind} contact (number {i + 1})",
             f"; f = {', '.join(map(brief, force))}, a = {', '.join(map(brief, answer))}")
    return f"{len(problem.contacts)} contacts"


# --- Solutions in space (certify/README.md, In space) ----------------------------------

def weak(limit2, force2, answer2, power):
    """(21), (22), of mu^2 fN^2, fF.fF, aF.aF and fF.aF: the direction of slip is free."""
    return force2 <= limit2 and power <= 0 and (answer2 == 0 or force2 == limit2)


def coulomb(bound):
    """Coulomb's law, the cosine between fF and -aF being >= bound where both matter."""
    def holds(limit2, force2, answer2, power):
        return force2 <= limit2 and power <= 0 and power * power >= bound * bound * limit2 * answer2
    return holds


def check_in_space(problem, f, a, law):
    row = 0
    for i, contact in enumerate(problem.contacts):
        place, of = f"$.witness.f[{row}]", f"of contact {i + 1}"
        size = 1 if contact.mu is None else 3
        fN, aN, fF, aF = f[row], a[row], f[row + 1:row + size], a[row + 1:row + size]
        row += size
        if contact.kind == "bilateral":
            need(aN == 0, place, aN, f"aN = 0 {of}")
            continue
        need(fN >= 0 and aN >= 0 and fN * aN == 0, place, (str(fN), str(aN)),
             f"fN, aN >= 0, one of them zero, {of}")
        if contact.kind == "sliding":
            need(fF == [-contact.mu * fN * u for u in contact.slip], place,
                 tuple(str(x) for x in (fN, *fF)), f"fF = -mu fN slip {of}")
        if contact.kind == "static":
            limit = contact.mu * fN
            need(law(limit * limit, dot(fF, fF), dot(aF, aF), dot(fF, aF)), place,
                 tuple(str(x) for x in (fN, *fF, *aF)), f"fN, fF, aF by the law of friction {of}")
    return f"{len(problem.contacts)} contacts in space"


def check_coulomb(problem, witness):
    fields(witness, "$.witness", "f", "a", "bound")
    need(problem.dimension == 3, "$.problem.dimension", problem.dimension, "3")
    bound = exact(witness["bound"], "$.witness.bound")
    need(0 < bound <= 1, "$.witness.bound", bound, "a bound > 0 and <= 1")
    return check_in_space(problem, *forces(problem, witness), coulomb(bound))


# --- Contact modes (certify/README.md, Modes) ----------------------------------------

def planar_contacts(problem):
    """(number, contact, its rows) for each contact of a planar problem."""
    need(problem.dimension == 2, "$.problem.dimension", problem.dimension,
         "2: others are not supported by this checker for this claim")
    row = 0
    for i, contact in enumerate(problem.contacts):
        rows = range(row, row + (1 if contact.mu is None else 2))
        yield i, contact, rows
        row = rows.stop


def modes_of(contact):
    if contact.kind == "bilateral":
        return ("hold",)
    if contact.kind == "static" and contact.mu > 0:
        return ("break", "stick", "slip+", "slip-")
    return ("break", "touch")


def with_friction(values):
    """Normal and friction entry; zero for the friction of a contact that has none."""
    return (*values, Fraction(0))[:2]


def limit(contact):
    """mu u: under `touch` a contact has fF = -mu u fN."""
    return contact.mu * int(contact.slip) if contact.kind == "sliding" else Fraction(0)


def in_mode(mode, contact, f, a):
    """Whether a contact with forces f and accelerations a meets the conditions of the mode."""
    (fN, fF), (aN, aF) = with_friction(f), with_friction(a)
    if mode == "hold":
        return aN == 0
    if mode == "break":
        return fN == fF == 0 <= aN
    if mode == "touch":
        return aN == 0 <= fN and fF == -limit(contact) * fN
    if mode == "stick":
        return aN == aF == 0 and abs(fF) <= contact.mu * fN
    sense = 1 if mode == "slip+" else -1
    return aN == 0 <= fN and fF == -sense * contact.mu * fN and sense * aF >= 0


def never_negative(mode, contact, y, g):
    """Whether yN aN - gN fN + yF aF - gF fF >= 0 wherever a contact is in the mode."""
    (yN, yF), (gN, gF) = with_friction(y), with_friction(g)
    if mode == "hold":
        return gN == 0
    if mode == "break":
        return yN >= 0 == yF
    if mode == "touch":
        return gN <= limit(contact) * gF and yF == 0
    if mode == "stick":
        return gN <= -contact.mu * abs(gF)
    sense = 1 if mode == "slip+" else -1
    return gN <= sense * contact.mu * gF and sense * yF >= 0


def check_refutation(problem, prefix, y, place):
    """y'b < 0, and y'(a - A f) >= 0 in every word that begins with the prefix."""
    yb, g = dot(y, problem.b), times(zip(*problem.A), y)
    need(yb < 0, place, yb, "y'b < 0")
    for i, contact, rows in planar_contacts(problem):
        for mode in prefix[i:i + 1] or modes_of(contact):
            need(never_negative(mode, contact, [y[row] for row in rows], [g[row] for row in rows]),
                 place, f"a term of contact {i + 1} that can be negative",
                 f"none in mode {mode}")


def check_no_solution(problem, witness):
    fields(witness, "$.witness", "prefixes")
    choices = [modes_of(contact) for _, contact, _ in planar_contacts(problem)]
    following = [1]  # words for the last 0, 1, ... contacts
    for modes in reversed(choices):
        following.append(following[-1] * len(modes))
    covered, prefixes = 0, {}
    for at, entry in items(witness["prefixes"], "$.witness.prefixes"):
        fields(entry, at, "modes", "y")
        named = items(entry["modes"], at + ".modes")
        need(len(named) <= len(choices), at + ".modes", len(named), f"<= {len(choices)} modes")
        prefix = tuple(one_of(mode, where, modes) for (where, mode), modes in zip(named, choices))
        need(prefix not in prefixes, at + ".modes", prefix,
             f"no prefix twice, see {prefixes.get(prefix)}")
        prefixes[prefix] = at
        check_refutation(problem, prefix, vector(entry["y"], at + ".y", len(problem.b)), at + ".y")
        covered += following[len(choices) - len(prefix)]
    for prefix, at in prefixes.items():
        for length in range(len(prefix)):
            need(prefix[:length] not in prefixes, at + ".modes", prefix,
                 f"no prefix that begins with another, {prefixes.get(prefix[:length])}")
    need(covered == following[-1], "$.witness.prefixes", covered,
         f"{following[-1]} words covered, all of them")
    return f"{following[-1]} words, {len(prefixes)} prefixes"


# --- Safe and unsafe: determinants of the reduced matrix (certify/README.md) -----------

def determinant(M):
    """By Gaussian elimination of a copy of the rows M."""
    M, result = [list(row) for row in M], Fraction(1)
    for k in range(len(M)):
        p = next((i for i in range(k, len(M)) if M[i][k]), None)
        if p is None:
            return Fraction(0)
        if p != k:
            M[k], M[p], result = M[p], M[k], -result
        result *= M[k][k]
        for i in range(k + 1, len(M)):
            if factor := M[i][k] / M[k][k]:
                M[i] = [x - factor * y for x, y in zip(M[i], M[k])]
    return result


def reduced(problem, word):
    """The rows of the reduced matrix of a word."""
    kept, columns, by_column = [], [], list(zip(*problem.A))
    for mode, (_, contact, rows) in zip(word, planar_contacts(problem)):
        if mode == "break":
            continue
        kept += rows if mode == "stick" else rows[:1]
        if mode in ("touch", "stick"):
            columns += [by_column[row] for row in kept[len(columns):]]
        else:
            along = -contact.mu if mode == "slip+" else contact.mu
            columns.append([x + along * y for x, y in zip(*(by_column[row] for row in rows))])
    return [[column[row] for column in columns] for row in kept]


def reduced_determinant(problem, word, stated, place):
    """det R(word), which must be the number that is stated."""
    value = determinant(reduced(problem, word))
    stated = exact(stated, place)
    need(stated == value, place, stated, value, f" (the reduced determinant of {brief(tuple(word))})")
    return value


def words_of(problem):
    """The number of all words, and the modes of each contact; static and frictionless ones."""
    choices = []
    for i, contact, _ in planar_contacts(problem):
        need(contact.kind in ("static", "frictionless"), f"$.problem.contacts[{i}].kind", contact.kind,
             "static or frictionless: others are not supported by this checker for this claim")
        choices.append(modes_of(contact))
    return prod(map(len, choices)), choices


def check_safe(problem, witness):
    fields(witness, "$.witness", "determinants")
    count, choices = words_of(problem)
    smallest = Fraction(1)  # that of the word in which every contact breaks
    stated = items(witness["determinants"], "$.witness.determinants", count)
    for word, (at, value) in zip(product(*choices), stated):
        value = reduced_determinant(problem, word, value, at)
        need(value > 0, at, value, "a determinant > 0")
        smallest = min(smallest, value)
    return f"{count} words, smallest determinant {brief(smallest)}"


def is_semidefinite(M):
    """By elimination down the diagonal: pivots >= 0, and where one is zero its column, too."""
    M = [list(row) for row in M]
    for k in range(len(M)):
        if M[k][k] < 0 or (M[k][k] == 0 and any(M[i][k] for i in range(k, len(M)))):
            return False
        for i in range(k + 1, len(M)):
            if M[i][k]:
                factor = M[i][k] / M[k][k]
                M[i] = [x - factor * y for x, y in zip(M[i], M[k])]
    return True


def check_safe_by_condition(problem, witness):
    """Eigenvalues of DAD in [l, u], and m^2 (u - l)^2 < 4 u l, m = max mu d_N / d_F (condition_number.md)."""
    fields(witness, "$.witness", "scaling", "least", "most")
    words_of(problem)  # static and frictionless contacts only
    check_symmetric(problem, {})
    n = len(problem.b)
    d = vector(witness["scaling"], "$.witness.scaling", n)
    for i in range(n):
        need(d[i] > 0, f"$.witness.scaling[{i}]", d[i], "a number > 0")
    least, most = exact(witness["least"], "$.witness.least"), exact(witness["most"], "$.witness.most")
    need(least > 0, "$.witness.least", least, "a number > 0")
    B = [[d[i] * problem.A[i][j] * d[j] for j in range(n)] for i in range(n)]
    below = [[B[i][j] - least * (i == j) for j in range(n)] for i in range(n)]
    above = [[most * (i == j) - B[i][j] for j in range(n)] for i in range(n)]
    need(is_semidefinite(below), "$.witness.least", least, "no more than the least eigenvalue of DAD")
    need(is_semidefinite(above), "$.witness.most", most, "no less than the largest eigenvalue of DAD")
    friction = max((contact.mu * d[rows[0]] / d[rows[1]]
                    for _, contact, rows in planar_contacts(problem) if contact.kind == "static"), default=Fraction(0))
    need(friction ** 2 * (most - least) ** 2 < 4 * most * least, "$.witness", friction,
         "a largest mu d_N / d_F with m^2 (u - l)^2 < 4 u l")
    return f"condition {brief(most / least)}, friction {brief(friction)}"


def check_unsafe(problem, witness):
    fields(witness, "$.witness", "word", "determinant")
    choices = words_of(problem)[1]
    named = items(witness["word"], "$.witness.word", len(choices))
    word = [one_of(mode, at, modes) for (at, mode), modes in zip(named, choices)]
    value = reduced_determinant(problem, word, witness["determinant"], "$.witness.determinant")
    need(value <= 0, "$.witness.determinant", value, "a determinant <= 0")
    return f"{' '.join(word)}, determinant {brief(value)}"


# --- The published algorithm: sections 4.1-4.3 and 5.2-5.5, as solver/published/readings.md ---

SWITCHES = {  # the value of the reference policy `paper` first
    "scan": ("lowest", "normals-first", "most-violated", "highest"),
    "resume": ("restart", "round"),
    "admit": ("lazy", "eager"),
    "file": ("no", "yes"),
    "give-up": ("first", "previous", "second"),
    "drop": ("contact", "variable"),
    "rezero": ("rescan", "continue"),
    "ties": ("sets", "contacts"),
    "apex": ("kept", "suspended"),
}
TIE_ORDER = ("C", "NC", "CF", "NC-", "NC+")

# outcome: cycle, stall, solved, singular, ray or limit; start, period and state of what
# recurs; every step from f = 0. Pivots and state have the keys of a certificate.
Run = namedtuple("Run", "outcome start period pivots state")


class Ended(Exception):
    """The run ends inside a drive: outcome, start, period, state."""


def read_policy(text, place="policy"):
    """A value for every switch, from a policy written canonically."""
    need(type(text) is str, place, text, "a policy")
    policy = {switch: values[0] for switch, values in SWITCHES.items()}
    for part in text.split(",") if text != "paper" else []:
        switch, _, value = part.partition("=")
        need(value in SWITCHES.get(switch, ()), place, text, "switches of a planar policy")
        policy[switch] = value
    canonical = ",".join(f"{switch}={value}" for switch, value in policy.items()
                         if value != SWITCHES[switch][0]) or "paper"
    need(text == canonical, place, text, f"it written canonically: {canonical}")
    return policy


def sign(x):
    return (x > 0) - (x < 0)


def solve(M):
    """x with M x = r, given rows [M | r]. An unknown whose column depends linearly on the
    columns before it is zero. None if the system is inconsistent."""
    M, n, pivots = list(M), len(M), []
    for c in range(n):
        top = len(pivots)
        p = next((i for i in range(top, n) if M[i][c]), None)
        if p is None:
            continue
        M[top], M[p] = M[p], M[top]
        M[top] = [x / M[top][c] for x in M[top]]
        for i in range(n):
            if i != top and M[i][c]:
                M[i] = [x - M[i][c] * y for x, y in zip(M[i], M[top])]
        pivots.append(c)
    if any(row[n] for row in M[len(pivots):]):
        return None
    x = [Fraction(0)] * n
    for row, c in zip(M, pivots):
        x[c] = row[n]
    return x


@lru_cache(maxsize=1 << 16)
def fdirection(problem, sets, driven, rate):
    """(df, da) while the driven force changes at `rate`; None if there is none."""
    def following(row, change):
        """df if this force changes, and with a normal its friction in NC+ or NC-."""
        df, x = [Fraction(0)] * len(sets), problem.variables[row]
        df[row] = Fraction(change)
        if row == x.normal and x.friction and sets[x.friction] in ("NC+", "NC-"):
            df[x.friction] = change * (x.mu if sets[x.friction] == "NC+" else -x.mu)
        if row in problem.sliding:
            df[row + 1] = change * problem.sliding[row]
        return df

    unknown = problem.held + [row for row, where in enumerate(sets)
                              if where in ("C", "CF") and row not in problem.held]
    forces = [following(row, 1) for row in unknown] + [following(driven, rate)]
    effects = [times(problem.A, df) for df in forces]
    x = solve([[da[row] for da in effects[:-1]] + [-effects[-1][row]] for row in unknown])
    if x is None:
        return None
    return times(zip(*forces), x + [1]), times(zip(*effects), x + [1])


def held_forces(problem):
    """The forces of bilateral contacts that keep their accelerations at zero while all others rest, as a
    vector of all rows (readings, section 9); None if the contacts are singular or contradict each other."""
    held, A = problem.held, problem.A
    block = [[A[i][j] for j in held] for i in held]

    def against(values):
        """x with A_BB x + values = 0 in the rows of B."""
        return solve([row + [-values[i]] for i, row in zip(held, block)])

    others = [row for row in range(len(problem.b)) if not problem.is_passive(row)]
    for row in others:  # the force of a sliding contact takes its friction along
        factor = problem.sliding.get(row, 0)
        if against([line[row] + factor * line[row + 1] if factor else line[row] for line in A]) is None:
            return None
    for k, j in enumerate(held):  # a column that depends on those before must have no effect elsewhere
        x = solve([row[:k] + [Fraction(0)] * (len(held) - k) + [row[k]] for row in block])
        if x is not None and any(A[row][j] != dot((A[row][i] for i in held), x) for row in others):
            return None
    x = against(problem.b)
    if x is None:
        return None
    f = [Fraction(0)] * len(problem.b)
    for row, force in zip(held, x):
        f[row] = force
    return f


def zero_at(value, rate):
    """The step after which a quantity >= 0 is zero, if it falls; otherwise None."""
    return value / -rate if rate < 0 else None


class Published:
    """The published algorithm under one policy: its state, and the steps made so far."""

    def __init__(self, problem, policy, max_steps):
        self.problem, self.variables = problem, problem.variables
        self.policy, self.max_steps = policy, max_steps
        self.f = held_forces(problem)
        self.a = None if self.f is None else [x + y for x, y in zip(times(problem.A, self.f), problem.b)]
        self.sets = ["C" if row in problem.held else "none" for row in range(len(problem.b))]
        self.last = None  # the contact driven last
        self.drives, self.pivots = 0, []

    # Main loop (readings, section 2).

    def compute_forces(self):
        if self.f is None:
            return Run("singular", None, None, self.pivots, None)
        seen = {}
        while True:
            start = seen.setdefault((*self.sets, *self.f, self.remembered()), self.drives)
            if start < self.drives:
                return Run("cycle", start, self.drives - start, self.pivots, self.outer_state())
            self.sweep()
            v = self.scan()
            if v is None:
                return Run("solved", None, None, self.pivots, self.outer_state())
            try:
                self.establish(v)
            except Ended as end:
                outcome, start, period, state = end.args
                return Run(outcome, start, period, self.pivots, state)

    def remembered(self):
        return self.last if self.policy["resume"] == "round" else None

    def outer_state(self):
        state = {"sets": self.named(self.sets), "f": self.f}
        return state if self.remembered() is None else {**state, "contact": self.last + 1}

    def named(self, values):
        return {x.name: value for x, value in zip(self.variables, values) if value is not None}

    def establish(self, v):
        if v == self.variables[v].normal or self.f[v] == 0:
            return self.drive(v, "establish")
        self.drive(v, "zero")
        if self.policy["rezero"] == "continue" and self.violated(v):
            self.drive(v, "establish")

    def violated(self, row):
        return violated(self.problem, self.f, self.a, row)

    def sweep(self):
        for row, x in enumerate(self.variables):
            fN = self.f[x.normal]
            if self.sets[row] != "none" or self.problem.is_passive(row):
                continue
            if row == x.normal:
                if self.policy["admit"] == "eager" and fN == 0 and self.a[row] >= 0:
                    self.sets[row] = "NC"
            elif self.policy["file"] == "yes" and not any(map(self.violated, (x.normal, row))):
                if fN > 0:
                    self.sets[row] = self.filed(row)
                elif self.sets[x.normal] == "NC":
                    self.sets[row] = "suspended"

    def filed(self, row):
        return ("CF", "NC-", "NC+")[sign(self.a[row])]

    def scan(self):
        """The next violated variable, or None."""
        if self.policy["scan"] != "most-violated":
            return next(filter(self.violated, self.scan_order()), None)
        found = list(filter(self.violated, range(len(self.f))))
        normals = [row for row in found if row == self.variables[row].normal]
        if normals:
            return max(normals, key=lambda row: -self.a[row])
        return max(found, key=lambda row: abs(self.a[row]), default=None)

    def scan_order(self):
        count, down = len(self.problem.contacts), self.policy["scan"] == "highest"
        first = self.remembered()
        if first is None:
            first = count - 1 if down else 0
        turn = {(first - k if down else first + k) % count: k for k in range(count)}

        def key(row):
            x = self.variables[row]
            key = turn[x.contact], row != x.normal
            return key[::-1] if self.policy["scan"] == "normals-first" else key

        return sorted(range(len(self.f)), key=key)

    # Drive (readings, section 3).

    def drive(self, v, goal):
        self.drives += 1
        self.last = self.variables[v].contact
        self.left = [None] * len(self.f)  # the set each variable last left in this drive
        zero = False                      # whether the last step had length zero
        friction = self.variables[v].friction
        if friction and self.sets[friction] == "suspended":
            self.sets[friction] = self.filed(friction)
        seen, j = {}, None
        while j != v:
            self.end_if_repeated(seen, zero)
            s, _, j, into = self.take_step(v, goal)
            before = self.sets[j]
            self.move(j, into, v, zero, s == 0)
            zero = s == 0
            self.pivots.append({
                "drive": self.drives, "driven": self.variables[v].name, "goal": goal, "step": s,
                "limiting": self.variables[j].name, "from": before, "to": self.sets[j]})

    def end_if_repeated(self, seen, zero):
        steps = len(self.pivots)
        start = seen.setdefault((*self.sets, *self.f, *self.left, zero), steps)
        if start < steps:
            raise Ended("stall", start, steps - start,
                        {"sets": self.named(self.sets), "f": self.f,
                         "left": self.named(self.left), "zero": zero})
        if steps == self.max_steps:
            raise Ended("limit", None, None, None)

    def take_step(self, v, goal):
        """Goes as far as is legal; returns the step, its rank, what limits it, and the set
        that wants into."""
        rate = -sign(self.a[v] if goal == "establish" else self.f[v])
        if v == self.variables[v].normal:
            rate = 1
        change = fdirection(self.problem, tuple(self.sets), v, rate)
        if change is None:
            raise Ended("singular", None, None, None)
        limits = [limit for limit in self.limits(v, goal, *change) if limit[0] is not None]
        if not limits:
            raise Ended("ray", None, None, None)
        first = min(limits, key=lambda limit: limit[:2])  # of equals the one found first
        self.f, self.a = ([x + first[0] * y for x, y in zip(now, rates)]
                          for now, rates in zip((self.f, self.a), change))
        return first

    def limits(self, v, goal, df, da):
        """maxstep: (s, rank among ties, variable, set it wants into); s None: no limit."""
        f, a = self.f, self.a

        def at_bound(row):
            x = self.variables[row]
            bound, growth = x.mu * f[x.normal], x.mu * df[x.normal]
            return [(zero_at(bound - f[row], growth - df[row]), "NC+"),
                    (zero_at(bound + f[row], growth + df[row]), "NC-")]

        def driven():
            if v == self.variables[v].normal:
                return [(zero_at(-a[v], -da[v]), "C")]
            if goal == "zero":
                return [(abs(f[v]), "none")]  # it falls at rate 1
            return [(zero_at(abs(a[v]), sign(a[v]) * da[v]), "CF")] + at_bound(v)

        found = {
            "C": lambda row: [(zero_at(f[row], df[row]), "NC")],
            "NC": lambda row: [(zero_at(a[row], da[row]), "C")],
            "CF": at_bound,
            "NC-": lambda row: [(zero_at(a[row], da[row]), "CF")],
            "NC+": lambda row: [(zero_at(-a[row], -da[row]), "CF")],
        }
        yield from ((s, (-1, v), v, into) for s, into in driven())
        for row, where in enumerate(self.sets):
            if where in found and row not in self.problem.held:
                by_set = TIE_ORDER.index(where) if self.policy["ties"] == "sets" else 0
                yield from ((s, (by_set, row), row, into) for s, into in found[where](row))

    def move(self, j, into, v, zero_before, zero_now):
        """j enters the set it wants into, or is given up (5.4, 5.5)."""
        give_up = {"first": zero_now, "previous": zero_before, "second": zero_before and zero_now}
        friction = self.variables[j].friction if j == self.variables[j].normal else None
        if self.left[j] == into and give_up[self.policy["give-up"]]:
            self.enter(j, "none")
            if friction and friction != v and self.policy["drop"] == "contact":
                self.enter(friction, "none")
            return
        self.enter(j, into)
        where = self.sets[friction] if friction else None
        if into == "NC" and self.policy["apex"] == "suspended" and where in ("CF", "NC-", "NC+"):
            self.enter(friction, "suspended")
        elif into == "C" and where == "suspended":
            self.enter(friction, self.filed(friction))

    def enter(self, row, into):
        if self.sets[row] != into:
            self.left[row], self.sets[row] = self.sets[row], into


def run(problem, policy, max_steps):
    """The run from f = 0 under a policy (its canonical text); outcome `limit` if it has
    not ended after max_steps steps."""
    return Published(problem, read_policy(policy), max_steps).compute_forces()


# --- The claims cycle and stall ----------------------------------------------------

def same(value, computed, place, policy):
    """What the certificate states must be what was computed: keys, lengths, types, values."""
    if type(computed) is dict:
        fields(value, place, *computed)
        for key in computed:
            same(value[key], computed[key], f"{place}.{key}", policy)
    elif type(computed) is list:
        for (at, item), expected in zip(items(value, place, len(computed)), computed):
            same(item, expected, at, policy)
    elif type(computed) is Fraction:
        need(exact(value, place) == computed, place, value, computed, f" under {policy}")
    else:
        need(type(value) is type(computed) and value == computed, place, value,
             json.dumps(computed), f" under {policy}")


def check_policy(claim, problem, stated, place, policy):
    """Runs the policy for as many steps as stated; returns the run if it is the one stated."""
    steps = items(stated["pivots"], place + ".pivots")
    found = run(problem, policy, len(steps))
    for (at, pivot), computed in zip(steps, found.pivots):
        same(pivot, computed, at, policy)
    outcome = found.outcome if found.outcome != "limit" else "no repetition yet"
    need(outcome == claim, place, claim, f"{outcome} after {len(found.pivots)} steps",
         f" under {policy}")
    for key in ("start", "period", "pivots", "state"):
        same(stated[key], getattr(found, key), f"{place}.{key}", policy)
    return found


def check_runs(claim, problem, witness):
    fields(witness, "$.witness", "runs")
    first, runs = {}, []
    for place, stated in items(witness["runs"], "$.witness.runs"):
        fields(stated, place, "policies", "start", "period", "pivots", "state")
        policies = items(stated["policies"], place + ".policies")
        need(policies, place + ".policies", [], "at least one policy")
        for at, policy in policies:
            read_policy(policy, at)
            need(policy not in first, at, policy, f"no policy twice, see {first.get(policy)}")
            first[policy] = at
            found = check_policy(claim, problem, stated, place, policy)
        need(found not in runs, place, "a run listed before", "no two runs the same")
        runs.append(found)
    need(runs, "$.witness.runs", [], "at least one run")
    facts = [f"policies {len(first)}", f"runs {len(runs)}"]
    for key in ("start", "period"):
        values = sorted({getattr(found, key) for found in runs})
        facts.append(f"{key} {' '.join(map(str, values))}")
    return ", ".join(facts)


# --- The program -------------------------------------------------------------------

CLAIMS = {
    "solution-exists": check_solution,
    "coulomb-solution": check_coulomb,
    "no-solution": check_no_solution,
    "symmetric": check_symmetric,
    "not-symmetric": check_not_symmetric,
    "psd": check_psd,
    "not-psd": check_not_psd,
    "safe": check_safe,
    "safe-by-condition": check_safe_by_condition,
    "unsafe": check_unsafe,
    "in-range": check_in_range,
    "not-in-range": check_not_in_range,
    "h": check_h,
    "not-h": check_not_h,
    "cycle": lambda problem, witness: check_runs("cycle", problem, witness),
    "stall": lambda problem, witness: check_runs("stall", problem, witness),
}


def check(certificate):
    """The claim, and facts about it, of a certificate that proves it; or raises Rejected."""
    fields(certificate, "$", "format", "version", "claim", "problem", "witness")
    one_of(certificate["format"], "$.format", ("stiction-certificate",))
    integer(certificate["version"], "$.version", 1, 2)
    claim = one_of(certificate["claim"], "$.claim", CLAIMS)
    facts = CLAIMS[claim](read_problem(certificate["problem"]), certificate["witness"])
    return f"{claim} ({facts})"


def check_file(path):
    """Prints the verdict on one file; returns its exit status."""
    try:
        certificate = load(path)
    except (OSError, ValueError, RecursionError) as error:
        print(f"{path}: unreadable: {error}", file=sys.stderr)
        return 2
    try:
        print(f"{path}: accepted: {check(certificate)}")
        return 0
    except Rejected as reason:
        print(f"{path}: REJECTED: {reason}")
        return 1


EPILOG = """claims:
  symmetric, psd, in-range, and these with not- before
                   for every valid problem
  h, not-h         whether b'v >= 0 for all v in the friction cones with A v = 0;
                   for problems without sliding contacts
  solution-exists  for every valid problem; in space conditions (21), (22)
  coulomb-solution for problems in space: the cosine of the angle between
                   friction and the direction opposite to the tangential
                   acceleration is at least the bound of the witness
  no-solution      for planar problems, by a Farkas vector for every word of
                   contact modes, or prefix of words
  safe, unsafe, safe-by-condition
                   for planar problems of static and frictionless contacts:
                   whether all determinants of reduced matrices are positive
  cycle, stall     for planar problems: run the published algorithm again,
                   from f = 0, under every policy that the certificate names

exit status:
  0  every certificate was accepted
  1  one was rejected; its line says where and why
  2  a file could not be read or is no JSON; bad usage
"""


def main():
    parser = argparse.ArgumentParser(
        description="Check stiction certificates in exact rational arithmetic, one line for each.",
        epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("certificates", nargs="+", metavar="CERT", help="a certificate file")
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")
    return max([check_file(path) for path in parser.parse_args().certificates])


if __name__ == "__main__":
    sys.exit(main())
