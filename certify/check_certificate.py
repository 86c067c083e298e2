#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks stiction certificates: a claim about a contact problem, with an exact witness.

Letters are those of [Baraff94] (D. Baraff, Fast contact force computation for
nonpenetrating rigid bodies, SIGGRAPH 1994), section 5:

  a = A f + b   forces f and accelerations a, one row per variable
  fN, aN        normal force and acceleration of a contact; variable N1, N2, ...
  fF, aF        friction force and tangential acceleration; variable F1, F2, ...
  mu            coefficient of friction, abs(fF) <= mu fN
  df, da, s     a step of length s adds s df to f and s da to a, da = A df
  C NC CF NC- NC+   the index sets of sections 4.1 and 5.3

Every number is a fractions.Fraction and every comparison is exact: there is no
tolerance. For `cycle` and `stall` the published algorithm is run here, from f = 0,
under each policy named, and compared with the certificate step by step. What a run
is, switch by switch, is written in solver/readings.md, and this file follows its
sections; the certificate format is in certify/README.md.

Trusted: Python, its json and fractions modules, and this file. It was written from
the documents named above and shares no code or tables with the C++.
"""

import argparse
import json
import re
import sys
from collections import namedtuple
from fractions import Fraction
from functools import cached_property

sys.set_int_max_str_digits(0)  # numerators may have more than 4300 digits


# --- Reading: strict, nothing is guessed or repaired -------------------------------

class Rejected(Exception):
    """The certificate does not prove its claim; the text says where and why."""


class Repeated(dict):
    """A JSON object that has `key` twice: refused where it is used."""


def unique_keys(pairs):
    keys = [key for key, _ in pairs]
    if len(set(keys)) == len(keys):
        return dict(pairs)
    result = Repeated(pairs)
    result.key = next(key for i, key in enumerate(keys) if key in keys[:i])
    return result


def refuse_constant(text):
    raise ValueError(f"{text} is not JSON")


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file, object_pairs_hook=unique_keys, parse_constant=refuse_constant)


def shown(value):
    if isinstance(value, Fraction):
        text = str(value)
    else:
        text = json.dumps(value, default=str)
    return text if len(text) <= 100 else f"{text[:90]}... ({len(text)} characters)"


def need(ok, place, found, expected):
    if not ok:
        raise Rejected(f"{place}: found {shown(found)}, expected {expected}")


def fields(value, place, *required, optional=()):
    """The object `value`, which must have the required keys and no unknown one."""
    need(isinstance(value, dict), place, value, "an object")
    need(type(value) is dict, place, getattr(value, "key", None), "each key once")
    for key in value:
        need(key in required or key in optional, place, key,
             f"no keys but {', '.join((*required, *optional)) or 'none at all'}")
    for key in required:
        need(key in value, place, sorted(value), f"a key {key}")
    return value


def items(value, place, length=None):
    """(place, item) for each item of a list, of the length given."""
    need(type(value) is list, place, value, "a list")
    need(length is None or len(value) == length, place, f"{len(value)} items", f"{length}")
    return [(f"{place}[{i}]", item) for i, item in enumerate(value)]


def one_of(value, place, allowed):
    need(type(value) is str and value in allowed, place, value, f"one of {' '.join(allowed)}")
    return value


def integer(value, place, least, below=None):
    """A JSON integer; true and 1.0 are none."""
    need(type(value) is int and value >= least and (below is None or value < below), place, value,
         f"an integer >= {least}" + (f" and < {below}" if below is not None else ""))
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
        need(decimal is not None, place, value, 'a number such as "-3/2", "7" or "1.5e-3"')
        need(abs(int(decimal[1] or 0)) <= 10000, place, value, "an exponent within 10000")
    return Fraction(value)


def vector(value, place, length):
    return [exact(item, at) for at, item in items(value, place, length)]


def rows(value, place, size):
    return [vector(row, at, size) for at, row in items(value, place, size)]


def matrix(value, place, size):
    """A: dense rows, or entries [i, j, "v"], where one below the diagonal stands for both
    unless the one above is listed as well."""
    if type(value) is list:
        return rows(value, place, size)
    fields(value, place, "size", "entries")
    need(integer(value["size"], place + ".size", 0) == size, place + ".size", value["size"], size)
    entries = {}
    for at, item in items(value["entries"], place + ".entries"):
        items(item, at, 3)
        i, j = (integer(item[k], f"{at}[{k}]", 0, size) for k in (0, 1))
        need((i, j) not in entries, at, [i, j], "each entry once")
        entries[i, j] = exact(item[2], at + "[2]")
    A = [[Fraction(0)] * size for _ in range(size)]
    for (i, j), v in entries.items():
        need(i >= j or (j, i) in entries, place + ".entries", [i, j],
             "an entry above the diagonal only beside the one below")
        A[i][j] = v
        if (j, i) not in entries:
            A[j][i] = v
    return A


# --- The problem -------------------------------------------------------------------

Contact = namedtuple("Contact", "kind mu slip")
# A planar variable: its name, its contact (from 0), the rows of the contact's normal and
# of its friction (None on a frictionless contact), and mu.
Variable = namedtuple("Variable", "name contact normal friction mu")


class Problem:
    def __init__(self, dimension, contacts, A, b):
        self.dimension, self.contacts, self.A, self.b = dimension, contacts, A, b
        self.directions = {}  # remembered by direction()

    @cached_property
    def variables(self):
        """One per row. Planar static and frictionless contacts only."""
        need(self.dimension == 2, "$.problem.dimension", self.dimension,
             "2: other dimensions are not supported by this checker for this claim")
        result = []
        for i, contact in enumerate(self.contacts):
            need(contact.kind in ("static", "frictionless"), f"$.problem.contacts[{i}].kind",
                 contact.kind,
                 "static or frictionless: other kinds are not supported by this checker "
                 "for this claim")
            normal = len(result)
            friction = normal + 1 if contact.kind == "static" else None
            result.append(Variable(f"N{i + 1}", i, normal, friction, contact.mu))
            if friction is not None:
                result.append(Variable(f"F{i + 1}", i, normal, friction, contact.mu))
        return result

    @cached_property
    def names(self):
        return [x.name for x in self.variables]


def read_slip(value, place, dimension):
    """The direction of sliding: a sign, or a rational unit vector in three dimensions."""
    if dimension == 2:
        return Fraction(one_of(value, place, ("1", "-1")))
    slip = vector(value, place, 2)
    need(sum(x * x for x in slip) == 1, place, value, "a unit vector")
    return slip


def read_contact(value, place, dimension):
    fields(value, place, "kind", optional=("mu", "slip"))
    kind = one_of(value["kind"], place + ".kind", ("bilateral", "frictionless", "static", "sliding"))
    keys = {"static": ("kind", "mu"), "sliding": ("kind", "mu", "slip")}.get(kind, ("kind",))
    fields(value, place, *keys)
    mu = slip = None
    if "mu" in keys:
        mu = exact(value["mu"], place + ".mu")
        need(mu >= 0, place + ".mu", mu, "mu >= 0")
    if "slip" in keys:
        slip = read_slip(value["slip"], place + ".slip", dimension)
    return Contact(kind, mu, slip)


def read_problem(value, place="$.problem"):
    """The problem of a certificate; rows in contact order, normal first."""
    fields(value, place, "format", "version", "dimension", "contacts", "A", "b")
    one_of(value["format"], place + ".format", ("stiction-problem",))
    integer(value["version"], place + ".version", 1, 2)
    dimension = integer(value["dimension"], place + ".dimension", 2, 4)
    contacts = [read_contact(item, at, dimension)
                for at, item in items(value["contacts"], place + ".contacts")]
    size = sum(dimension if c.kind in ("static", "sliding") else 1 for c in contacts)
    return Problem(dimension, contacts, matrix(value["A"], place + ".A", size),
                   vector(value["b"], place + ".b", size))


# --- Claims about A and b, and a solution ------------------------------------------
# Each takes the problem and the witness, and returns the facts to print.

def dot(x, y):
    return sum((u * v for u, v in zip(x, y) if u and v), Fraction(0))


def times(A, x):
    return [dot(row, x) for row in A]


def equal(found, expected, place, meaning):
    for i, (x, y) in enumerate(zip(found, expected)):
        need(x == y, f"{place}[{i}]", x, f"{shown(y)} ({meaning})")


def check_symmetric(problem, witness):
    fields(witness, "$.witness")
    A, n = problem.A, len(problem.b)
    for i in range(n):
        equal(A[i], [A[j][i] for j in range(n)], f"$.problem.A[{i}]", "A symmetric")
    return f"{n} rows"


def check_not_symmetric(problem, witness):
    fields(witness, "$.witness", "i", "j")
    i, j = (integer(witness[k], f"$.witness.{k}", 0, len(problem.b)) for k in "ij")
    need(problem.A[i][j] != problem.A[j][i], "$.witness", [i, j], "A_ij to differ from A_ji")
    return f"A[{i}][{j}] = {shown(problem.A[i][j])}, A[{j}][{i}] = {shown(problem.A[j][i])}"


def check_psd(problem, witness):
    """A = L diag(D) L' with D >= 0, so x'Ax = sum of D_i (L'x)_i^2 >= 0."""
    fields(witness, "$.witness", "L", "D")
    n = len(problem.b)
    L, D = rows(witness["L"], "$.witness.L", n), vector(witness["D"], "$.witness.D", n)
    for i in range(n):
        need(D[i] >= 0, f"$.witness.D[{i}]", D[i], "D >= 0")
        for j in range(i, n):
            need(L[i][j] == (i == j), f"$.witness.L[{i}][{j}]", L[i][j],
                 "a lower triangle with unit diagonal")
    check_symmetric(problem, {})
    for i in range(n):
        scaled = [L[i][k] * D[k] for k in range(i + 1)]
        equal([dot(scaled, L[j]) for j in range(n)], problem.A[i], f"$.witness.(L D L')[{i}]",
              "the entry of A")
    return f"{n} rows, rank {sum(d > 0 for d in D)}"


def check_not_psd(problem, witness):
    fields(witness, "$.witness", "x", "value")
    x = vector(witness["x"], "$.witness.x", len(problem.b))
    value = exact(witness["value"], "$.witness.value")
    need(value < 0, "$.witness.value", value, "a value < 0")
    equal([value], [dot(x, times(problem.A, x))], "$.witness.value", "x'Ax")
    return f"x'Ax = {shown(value)}"


def check_in_range(problem, witness):
    fields(witness, "$.witness", "x")
    x = vector(witness["x"], "$.witness.x", len(problem.b))
    equal(times(problem.A, x), problem.b, "$.witness.(A x)", "b")
    return f"{len(x)} rows"


def check_not_in_range(problem, witness):
    fields(witness, "$.witness", "y", "value")
    n = len(problem.b)
    y = vector(witness["y"], "$.witness.y", n)
    value = exact(witness["value"], "$.witness.value")
    need(value != 0, "$.witness.value", value, "a value /= 0")
    equal(times(zip(*problem.A), y), [Fraction(0)] * n, "$.witness.(y'A)", "y'A = 0")
    equal([value], [dot(y, problem.b)], "$.witness.value", "y'b")
    return f"y'b = {shown(value)}"


def normal_holds(fN, aN):
    """Normal conditions (15)."""
    return fN >= 0 and aN >= 0 and fN * aN == 0


def friction_holds(mu, fN, fF, aF):
    """Friction conditions (16)."""
    return abs(fF) <= mu * fN and aF * fF <= 0 and aF * (mu * fN - abs(fF)) == 0


def check_solution(problem, witness):
    fields(witness, "$.witness", "f", "a")
    variables, n = problem.variables, len(problem.b)
    f, a = (vector(witness[k], f"$.witness.{k}", n) for k in "fa")
    equal(a, [x + y for x, y in zip(times(problem.A, f), problem.b)], "$.witness.a", "A f + b")
    for row, x in enumerate(variables):
        pair = f"f = {f[row]}, a = {a[row]}"
        if row == x.normal:
            need(normal_holds(f[row], a[row]), f"$.witness.f[{row}]", pair,
                 f"the normal conditions (15) of {x.name}")
        else:
            need(friction_holds(x.mu, f[x.normal], f[row], a[row]), f"$.witness.f[{row}]", pair,
                 f"the friction conditions (16) of {x.name}")
    return f"{len(problem.contacts)} contacts"


# --- The published algorithm, sections 4.3 and 5.5, as solver/readings.md fixes it --

SWITCHES = {  # the reference policy `paper` first
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
NORMAL_SETS = ("none", "C", "NC")
FRICTION_SETS = ("none", "CF", "NC-", "NC+", "suspended")
TIE_ORDER = ("C", "NC", "CF", "NC-", "NC+")

# A run: outcome cycle, stall, solved, singular, ray or limit; start, period and state of a
# repetition; every step from f = 0. Pivots and state have the keys of the certificate.
Run = namedtuple("Run", "outcome start period pivots state")
Limit = namedtuple("Limit", "s rank variable into")


class Ended(Exception):
    """The run ends inside a drive."""


def read_policy(text, place="policy"):
    """A policy, written canonically, as a value for every switch."""
    policy = {switch: values[0] for switch, values in SWITCHES.items()}
    for part in [] if text == "paper" else one_line(text, place).split(","):
        switch, _, value = part.partition("=")
        need(value in SWITCHES.get(switch, ()), place, text, "switches and values of a planar policy")
        policy[switch] = value
    canonical = ",".join(f"{switch}={value}" for switch, value in policy.items()
                         if value != SWITCHES[switch][0]) or "paper"
    need(text == canonical, place, text, f"the canonical form {canonical}")
    return policy


def one_line(value, place):
    need(type(value) is str, place, value, "a string")
    return value


def sign(x):
    return (x > 0) - (x < 0)


def solve(M):
    """x with M x = r for rows [M | r]; an unknown whose column depends on the columns
    before it is zero; None if there is no solution."""
    M, n, pivots = [row[:] for row in M], len(M), []
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


def direction(problem, sets, driven, rate):
    """(df, da) while the driven force changes at `rate`, or None: fdirection of 5.5."""
    key = (tuple(sets), driven, rate)
    if key not in problem.directions:
        problem.directions[key] = fdirection(problem, sets, driven, rate)
    return problem.directions[key]


def fdirection(problem, sets, driven, rate):
    def alone(row, change):
        """df if this force changes and only friction at its limit follows: dfF = +-mu dfN."""
        df, x = [Fraction(0)] * len(sets), problem.variables[row]
        df[row] = Fraction(change)
        if row == x.normal and x.friction is not None and sets[x.friction] in ("NC+", "NC-"):
            df[x.friction] = change * (x.mu if sets[x.friction] == "NC+" else -x.mu)
        return df

    unknown = [row for row, where in enumerate(sets) if where in ("C", "CF") and row != driven]
    parts = [alone(row, 1) for row in unknown] + [alone(driven, rate)]
    effects = [times(problem.A, df) for df in parts]
    equations = [[da[row] for da in effects] for row in unknown]
    x = solve([row[:-1] + [-row[-1]] for row in equations])
    if x is None:
        return None
    x.append(Fraction(1))
    return [dot(x, column) for column in zip(*parts)], [dot(x, column) for column in zip(*effects)]


def zero_at(value, rate):
    """The step at which a quantity >= 0 that falls at this rate is zero; None if it does not."""
    return value / -rate if rate < 0 else None


class Published:
    """The published algorithm under one policy: its state, and the pivots made so far."""

    def __init__(self, problem, policy, max_steps):
        self.problem, self.variables, self.policy = problem, problem.variables, policy
        self.max_steps = max_steps
        self.f, self.a = [Fraction(0)] * len(problem.b), list(problem.b)
        self.sets = ["none"] * len(problem.b)
        self.last = None  # the contact driven last
        self.drives, self.pivots = 0, []

    # Main loop (readings, section 2).

    def compute_forces(self):
        seen = {}
        while True:
            state = (*self.sets, *self.f, self.last if self.policy["resume"] == "round" else None)
            if state in seen:
                start = seen[state]
                return Run("cycle", start, self.drives - start, self.pivots, self.outer_state())
            seen[state] = self.drives
            self.sweep()
            v = self.scan()
            if v is None:
                return Run("solved", None, None, self.pivots, self.outer_state())
            try:
                self.establish(v)
            except Ended as end:
                return Run(*end.args[:3], self.pivots, end.args[3])

    def establish(self, v):
        if v == self.variables[v].normal or self.f[v] == 0:
            return self.drive(v, "establish")
        self.drive(v, "zero")
        if self.policy["rezero"] == "continue" and self.violated(v):
            self.drive(v, "establish")

    def violated(self, row):
        x, f, a = self.variables[row], self.f, self.a
        normal = normal_holds(f[x.normal], a[x.normal])
        if row == x.normal:
            return not normal
        return normal and not friction_holds(x.mu, f[x.normal], f[row], a[row])

    def sweep(self):
        for row, x in enumerate(self.variables):
            if self.sets[row] != "none":
                continue
            fN = self.f[x.normal]
            if row == x.normal:
                if self.policy["admit"] == "eager" and fN == 0 and self.a[row] >= 0:
                    self.sets[row] = "NC"
            elif self.policy["file"] == "yes" and not self.violated(x.normal) and not self.violated(row):
                if fN > 0:
                    self.sets[row] = self.filed(row)
                elif self.sets[x.normal] == "NC":
                    self.sets[row] = "suspended"

    def filed(self, row):
        return ("CF", "NC-", "NC+")[sign(self.a[row])]

    def scan(self):
        """The next violated variable, or None."""
        if self.policy["scan"] != "most-violated":
            return next((row for row in self.order() if self.violated(row)), None)
        violated = [row for row in range(len(self.f)) if self.violated(row)]
        normals = [row for row in violated if row == self.variables[row].normal]
        return max(normals or violated, key=lambda row: abs(self.a[row]), default=None)

    def order(self):
        count, down = len(self.problem.contacts), self.policy["scan"] == "highest"
        first = count - 1 if down else 0
        if self.policy["resume"] == "round" and self.last is not None:
            first = self.last
        turn = {(first - k if down else first + k) % count: k for k in range(count)}

        def key(row):
            contact, friction = turn[self.variables[row].contact], row != self.variables[row].normal
            return (friction, contact) if self.policy["scan"] == "normals-first" else (contact, friction)

        return sorted(range(len(self.f)), key=key)

    def outer_state(self):
        state = {"sets": dict(zip(self.problem.names, self.sets)), "f": self.f}
        if self.policy["resume"] == "round" and self.last is not None:
            state["contact"] = self.last + 1
        return state

    # Drive (readings, section 3).

    def drive(self, v, goal):
        self.drives += 1
        self.last = self.variables[v].contact
        self.left = [None] * len(self.f)  # the set each variable last left in this drive
        zero = False                      # whether the last step had length zero
        friction = self.variables[v].friction
        if v != friction and friction is not None and self.sets[friction] == "suspended":
            self.enter(friction, self.filed(friction))
        seen = {}
        while True:
            self.end_if_repeated(seen, zero)
            s, _, j, into = self.step(v, goal)
            before = self.sets[j]
            self.move(j, into, v, zero, s == 0)
            zero = s == 0
            self.pivots.append({
                "drive": self.drives, "driven": self.variables[v].name, "goal": goal, "step": s,
                "limiting": self.variables[j].name, "from": before, "to": self.sets[j]})
            if j == v:
                return

    def end_if_repeated(self, seen, zero):
        state, made = (*self.sets, *self.f, *self.left, zero), len(self.pivots)
        if state in seen:
            names = self.problem.names
            raise Ended("stall", seen[state], made - seen[state], {
                "sets": dict(zip(names, self.sets)), "f": self.f,
                "left": {name: left for name, left in zip(names, self.left) if left}, "zero": zero})
        seen[state] = made
        if made == self.max_steps:
            raise Ended("limit", None, None, None)

    def step(self, v, goal):
        """Goes as far as is legal, and returns what limited the step."""
        rate = 1
        if v != self.variables[v].normal:
            rate = -sign(self.a[v] if goal == "establish" else self.f[v])
        change = direction(self.problem, self.sets, v, rate)
        if change is None:
            raise Ended("singular", None, None, None)
        df, da = change
        limits = [limit for limit in self.limits(v, goal, df, da) if limit.s is not None]
        if not limits:
            raise Ended("ray", None, None, None)
        first = min(limits, key=lambda limit: limit[:2])  # of equals, the one listed first
        self.f = [x + first.s * y for x, y in zip(self.f, df)]
        self.a = [x + first.s * y for x, y in zip(self.a, da)]
        return first

    def limits(self, v, goal, df, da):
        """maxstep of 5.5: for each variable the step to its limit, and the set it wants into."""
        f, a = self.f, self.a

        def bounds(row):
            x = self.variables[row]
            bound, grows = x.mu * f[x.normal], x.mu * df[x.normal]
            return [(zero_at(bound - f[row], grows - df[row]), "NC+"),
                    (zero_at(bound + f[row], grows + df[row]), "NC-")]

        for row, where in enumerate(self.sets):
            rank = (1, TIE_ORDER.index(where) if where in TIE_ORDER else 0, row)
            if self.policy["ties"] == "contacts":
                rank = (1, row)
            if row == v:
                rank, found = (0,), self.goal_reached(v, goal, df, da, bounds)
            elif where == "C":
                found = [(zero_at(f[row], df[row]), "NC")]
            elif where == "NC":
                found = [(zero_at(a[row], da[row]), "C")]
            elif where == "CF":
                found = bounds(row)
            elif where == "NC-":
                found = [(zero_at(a[row], da[row]), "CF")]
            elif where == "NC+":
                found = [(zero_at(-a[row], -da[row]), "CF")]
            else:
                continue
            for s, into in found:
                yield Limit(s, rank, row, into)

    def goal_reached(self, v, goal, df, da, bounds):
        f, a = self.f[v], self.a[v]
        if v == self.variables[v].normal:
            return [(zero_at(-a, -da[v]), "C")]
        if goal == "zero":
            return [(zero_at(abs(f), sign(f) * df[v]), "none")]
        return [(zero_at(abs(a), sign(a) * da[v]), "CF")] + bounds(v)

    def move(self, j, into, v, zero_before, zero_now):
        """j enters the set it wants into, or is given up (5.4, 5.5)."""
        gives_up = {"first": zero_now, "previous": zero_before, "second": zero_before and zero_now}
        x = self.variables[j]
        partner = x.friction if j == x.normal and x.friction != v else None
        if j != v and self.left[j] == into and gives_up[self.policy["give-up"]]:
            self.enter(j, "none")
            if partner is not None and self.policy["drop"] == "contact":
                self.enter(partner, "none")
            return
        self.enter(j, into)
        if partner is None or j == v:
            return
        if into == "NC" and self.policy["apex"] == "suspended" and self.sets[partner] != "none":
            self.enter(partner, "suspended")
        elif into == "C" and self.sets[partner] == "suspended":
            self.enter(partner, self.filed(partner))

    def enter(self, row, into):
        if self.sets[row] != into:
            self.left[row], self.sets[row] = self.sets[row], into


def run(problem, policy, max_steps):
    """The run of the published algorithm from f = 0 under a policy (its canonical text);
    outcome `limit` if it has not ended after max_steps steps."""
    return Published(problem, read_policy(policy), max_steps).compute_forces()


# --- The claims cycle and stall ----------------------------------------------------

def read_set(value, place, name):
    return one_of(value, place, NORMAL_SETS if name[0] == "N" else FRICTION_SETS)


def read_pivot(value, place, names):
    keys = ("drive", "driven", "goal", "step", "limiting", "from", "to")
    pivot = dict(fields(value, place, *keys))
    integer(pivot["drive"], place + ".drive", 1)
    for key in ("driven", "limiting"):
        one_of(pivot[key], f"{place}.{key}", names)
    one_of(pivot["goal"], place + ".goal", ("establish", "zero"))
    for key in ("from", "to"):
        read_set(pivot[key], f"{place}.{key}", pivot["limiting"])
    pivot["step"] = exact(pivot["step"], place + ".step")
    return pivot


def read_state(value, place, claim, names):
    if claim == "cycle":
        state = dict(fields(value, place, "sets", "f", optional=("contact",)))
        if "contact" in state:
            integer(state["contact"], place + ".contact", 1)
    else:
        state = dict(fields(value, place, "sets", "f", "left", "zero"))
        need(type(state["zero"]) is bool, place + ".zero", state["zero"], "true or false")
        for name, where in fields(state["left"], place + ".left", optional=names).items():
            read_set(where, f"{place}.left.{name}", name)
    for name, where in fields(state["sets"], place + ".sets", *names).items():
        read_set(where, f"{place}.sets.{name}", name)
    state["f"] = vector(state["f"], place + ".f", len(names))
    return state


def read_run(value, place, claim, names):
    """(policies, Run) as the certificate states them."""
    fields(value, place, "policies", "start", "period", "pivots", "state")
    policies = items(value["policies"], place + ".policies")
    need(policies, place + ".policies", [], "at least one policy")
    for at, policy in policies:
        read_policy(policy, at)
    start = integer(value["start"], place + ".start", 0)
    period = integer(value["period"], place + ".period", 1)
    pivots = [read_pivot(item, at, names) for at, item in items(value["pivots"], place + ".pivots")]
    state = read_state(value["state"], place + ".state", claim, names)
    return policies, Run(claim, start, period, pivots, state)


def same(stated, computed, place, policy):
    """Objects and lists must agree key by key and item by item; values exactly."""
    if isinstance(stated, dict) and isinstance(computed, dict):
        for key in stated.keys() | computed.keys():
            need(key in computed, place, key, f"no such key under {policy}")
            need(key in stated, place, sorted(stated), f"a key {key} under {policy}")
            same(stated[key], computed[key], f"{place}.{key}", policy)
    elif isinstance(stated, list) and isinstance(computed, list):
        for i, (x, y) in enumerate(zip(stated, computed)):
            same(x, y, f"{place}[{i}]", policy)
        need(len(stated) == len(computed), place, f"{len(stated)} items",
             f"{len(computed)} under {policy}")
    else:
        need(stated == computed, place, stated, f"{shown(computed)} under {policy}")


def compare(stated, computed, place, policy):
    if stated == computed:
        return
    steps = len(computed.pivots)
    same(stated.pivots[:steps], computed.pivots, place + ".pivots", policy)
    if computed.outcome == "limit":
        need(False, place + ".pivots", f"{steps} steps", f"a repetition, but under {policy} "
             "no state recurs in so many")
    need(stated.outcome == computed.outcome, place, stated.outcome,
         f"{computed.outcome} after {steps} steps, the outcome under {policy}")
    for key in ("pivots", "start", "period", "state"):
        same(getattr(stated, key), getattr(computed, key), f"{place}.{key}", policy)


def check_runs(claim, problem, witness):
    fields(witness, "$.witness", "runs")
    places = items(witness["runs"], "$.witness.runs")
    need(places, "$.witness.runs", [], "at least one run")
    runs = [(at, *read_run(item, at, claim, problem.names)) for at, item in places]
    first = {}
    for _, policies, _ in runs:
        for at, policy in policies:
            need(policy not in first, at, policy, f"no policy twice (see {first.get(policy)})")
            first[policy] = at
    for k, (at, _, stated) in enumerate(runs):
        twin = next((other for other, _, earlier in runs[:k] if earlier == stated), None)
        need(twin is None, at, "the same run again", f"one that differs from {twin}")
    for at, policies, stated in runs:
        for _, policy in policies:
            compare(stated, run(problem, policy, len(stated.pivots)), at, policy)
    return facts(runs, "drives" if claim == "cycle" else "steps")


def facts(runs, unit):
    def span(values):
        low, high = min(values), max(values)
        return f"{low}" if low == high else f"{low} to {high}"

    policies = sum(len(policies) for _, policies, _ in runs)
    return (f"{policies} {'policy' if policies == 1 else 'policies'}, "
            f"{len(runs)} {'run' if len(runs) == 1 else 'runs'}, "
            f"start {span([stated.start for _, _, stated in runs])}, "
            f"period {span([stated.period for _, _, stated in runs])} {unit}, "
            f"{span([len(stated.pivots) for _, _, stated in runs])} steps")


# --- The program -------------------------------------------------------------------

CLAIMS = {
    "solution-exists": check_solution,
    "symmetric": check_symmetric,
    "not-symmetric": check_not_symmetric,
    "psd": check_psd,
    "not-psd": check_not_psd,
    "in-range": check_in_range,
    "not-in-range": check_not_in_range,
    "cycle": lambda problem, witness: check_runs("cycle", problem, witness),
    "stall": lambda problem, witness: check_runs("stall", problem, witness),
}


def check(certificate):
    """(claim, facts) of a certificate that is right; otherwise Rejected is raised."""
    fields(certificate, "$", "format", "version", "claim", "problem", "witness")
    one_of(certificate["format"], "$.format", ("stiction-certificate",))
    integer(certificate["version"], "$.version", 1, 2)
    claim = one_of(certificate["claim"], "$.claim", CLAIMS)
    return claim, CLAIMS[claim](read_problem(certificate["problem"]), certificate["witness"])


def check_file(path):
    """Prints the verdict on one file and returns its exit status."""
    try:
        certificate = load(path)
    except (OSError, ValueError, RecursionError) as error:
        print(f"{path}: unreadable: {error}", file=sys.stderr)
        return 2
    try:
        claim, found = check(certificate)
    except Rejected as reason:
        print(f"{path}: REJECTED: {reason}")
        return 1
    print(f"{path}: accepted: {claim} ({found})")
    return 0


def main(arguments=None):
    parser = argparse.ArgumentParser(
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Checks stiction certificates (version 1) in exact rational arithmetic.\n"
                    "Prints one line per file: what was proved, or where the proof fails.",
        epilog="claims:  " + "\n         ".join(
                   [" ".join(list(CLAIMS)[:7]), "cycle stall (the published algorithm is run "
                    "again under every policy named)"]) +
               "\n         solution-exists, cycle and stall: planar problems of static and\n"
               "         frictionless contacts only; the others: every valid problem\n"
               "exit:    0 all accepted, 1 some rejected, 2 a file unreadable or no JSON, or bad usage")
    parser.add_argument("certificates", nargs="+", metavar="CERT", help="a certificate file")
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")
    return max([check_file(path) for path in parser.parse_args(arguments).certificates])


if __name__ == "__main__":
    sys.exit(main())
