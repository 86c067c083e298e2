# SPDX-License-Identifier: Apache-2.0
"""Checks certificates of loops in space: runs section 5.6 of [Baraff94] again, over intervals with gradients.

What a run is, is fixed in solver/published/readings.md, 8; certify/certificates.md, Loops in space, says what stands
in a certificate and why it proves a loop. Called by check_runs.py.

  N1, F1, ...       normal and friction of each contact; rows fN, fx, fy of f and a; no friction: fN alone
  d                 the recorded direction of a contact in NCF
  C NC CF NCF half  the index sets; half: ax = 0 is kept by fx while fy is driven
  Number            a number between two ends, integers over 2^bits; over a box, how much it changes along each side
  memory            what an outer state remembers beyond its sets: resting forces, recorded directions

Every sign that decides is proved; where one is not, Unsure is raised and nothing is guessed. What is zero by the
algorithm, not by its ends, is set to zero. Two of these zeros need to know where the run has been:

  line    f moves along a line on which aF of a contact in NCF was zero at some point. So aF = t da with one number t,
          and both components are zero where one is.
  trail   f moves along the line that it took when a normal left C. Where its aN is zero again, f and a are back.

Trusted: Python and this file, which was written from readings.md and shares no code or tables with the C++.
"""

from fractions import Fraction
from itertools import count
from math import isqrt

from certificate_reader import Cost, brief, integer, items, listed, need, one_of, vector

MOST_BITS = 4096
LARGE = "numbers of A, b and mu are below 2^(bits / 4)"
SWITCHES = {  # the value of the reference policy `paper` first; those of the plane that have a meaning in space
    "scan": ("lowest", "normals-first", "most-violated", "highest"),
    "resume": ("restart", "round"),
    "admit": ("lazy", "eager"),
    "give-up": ("first", "previous", "second"),
    "drop": ("contact", "variable"),
    "rezero": ("rescan", "continue"),
    "ties": ("sets", "contacts"),
    "slip": ("literal", "redirect"),
}
RAY_KEYS = "policy bits word"
BOX_KEYS = "policy kind bits start period word charts centre radii"
KEYS = ("policy kind bits start period word", BOX_KEYS)


class Unsure(Exception):
    """A sign that the ends do not tell."""


class End(Exception):
    """The run ends: its outcome."""


# --- Numbers -----------------------------------------------------------------------

def product(a, b, c, d):
    """Ends of [a, b] [c, d], over 2^bits."""
    if a >= 0:
        low, high = (a if c >= 0 else b) * c, (b if d >= 0 else a) * d
    elif b <= 0:
        low, high = (a if d >= 0 else b) * d, (b if c >= 0 else a) * c
    else:
        low, high = min(a * d, b * c), max(a * c, b * d)
    return low >> Number.bits, -(-high >> Number.bits)


def inverted(low, high):
    if low <= 0 <= high:
        raise Unsure("a divisor")
    unit = 1 << 2 * Number.bits
    return unit // high, -(-unit // low)


def rooted(low, high):
    if low <= 0:
        raise Unsure("a root")
    low, square = isqrt(low << Number.bits), high << Number.bits
    high = isqrt(square)
    return low, high + (high * high < square)


class Number:
    """low, high: integers over 2^bits. Over a box also slopes: the ends of the derivatives by coordinates from -1 to 1
    along its sides (None: all zero), and centre: the ends in the middle of the box. By the mean value theorem the
    number is no further from there than the slopes together: the ends are drawn in to that."""

    bits = 256
    __slots__ = ("low", "high", "centre", "slopes")

    def __init__(self, low, high, centre=None, slopes=None):
        self.low, self.high, self.centre, self.slopes = low, high, centre or (low, high), slopes
        if slopes:
            far = sum(max(-a, b) for a, b in slopes)
            self.low, self.high = max(low, centre[0] - far), min(high, centre[1] + far)

    @classmethod
    def around(cls, x, radius=0):
        low, high = (x - radius) * (1 << cls.bits), (x + radius) * (1 << cls.bits)
        return cls(low.numerator // low.denominator, -(-high.numerator // high.denominator))

    @classmethod
    def side(cls, k, size, x, radius):
        """Side k of a box of so many, around x."""
        number, slope = cls.around(x, radius), cls.around(radius)
        slopes = [(slope.low, slope.high) if m == k else (0, 0) for m in range(size)]
        return cls(number.low, number.high, cls.around(x).centre, slopes)

    def is_zero(self):
        """Whether it is zero everywhere in the box, and known to be."""
        return self.low == 0 == self.high and (self.slopes is None or all(s == (0, 0) for s in self.slopes))

    def __neg__(self):
        return Number(-self.high, -self.low, (-self.centre[1], -self.centre[0]),
                      self.slopes and [(-b, -a) for a, b in self.slopes])

    def __add__(self, other):
        slopes = self.slopes or other.slopes
        if self.slopes and other.slopes:
            slopes = [(a + c, b + d) for (a, b), (c, d) in zip(self.slopes, other.slopes)]
        centre = self.centre[0] + other.centre[0], self.centre[1] + other.centre[1]
        return Number(self.low + other.low, self.high + other.high, centre, slopes)

    def __sub__(self, other):
        return self + -other

    def __mul__(self, other):
        if self.is_zero() or other.is_zero():
            return ZERO
        parts = [[product(x.low, x.high, *s) for s in y.slopes]
                 for x, y in ((self, other), (other, self)) if y.slopes]
        slopes = parts[0] if parts else None
        if len(parts) == 2:
            slopes = [(a + c, b + d) for (a, b), (c, d) in zip(*parts)]
        centre = slopes and product(*self.centre, *other.centre)
        return Number(*product(self.low, self.high, other.low, other.high), centre, slopes)

    def inverse(self):
        low, high = inverted(self.low, self.high)
        if self.slopes is None:
            return Number(low, high)
        a, b = product(low, high, low, high)
        return Number(low, high, inverted(*self.centre), [product(-b, -a, *s) for s in self.slopes])

    def __truediv__(self, other):
        return self if self.is_zero() else self * other.inverse()

    def root(self):
        if self.is_zero():
            return self
        low, high = rooted(self.low, self.high)
        if self.slopes is None:
            return Number(low, high)
        if low == 0:
            raise Unsure("the slope of a root")
        over = inverted(2 * low, 2 * high)
        return Number(low, high, rooted(*self.centre), [product(*over, *s) for s in self.slopes])


ZERO = Number(0, 0)


def one():
    return Number(1 << Number.bits, 1 << Number.bits)


def sign(x):
    if x.is_zero():
        return 0
    if x.low > 0:
        return 1
    if x.high < 0:
        return -1
    raise Unsure("a sign")


def inner(x, y):
    return sum((u * v for u, v in zip(x, y) if not (u.is_zero() or v.is_zero())), ZERO)


def scaled(t, x):
    return [t * u for u in x]


def plus(x, y):
    return [v if u.is_zero() else u if v.is_zero() else u + v for u, v in zip(x, y)]


def vanishes(x):
    return all(u.is_zero() for u in x)


def solve(M):
    """x with M x = r, given rows [M | r] of a matrix that is proved to be regular."""
    M, free, order = [list(row) for row in M], list(range(len(M))), []

    def size(x):
        return max(x.low, -x.high)

    for c in range(len(M)):
        best = max(free, key=lambda i: size(M[i][c]))
        if size(M[best][c]) <= 0:
            raise Unsure("a matrix that may be singular")
        free.remove(best)
        order.append(best)
        over = M[best][c].inverse()
        M[best] = [x * over for x in M[best]]
        for i, row in enumerate(M):
            if i != best and not row[c].is_zero():
                M[i] = [x - row[c] * y if k > c else ZERO for k, (x, y) in enumerate(zip(row, M[best]))]
    return [M[i][-1] for i in order]


# --- Axes in a tangent plane ---------------------------------------------------------

# A unit vector and a name: of equal names the vectors are equal, up to their sign.
FIRST_NAME = 1 << 20  # so that no number of a contact is a name
fresh = count(FIRST_NAME)


def axis_along(u):
    """(length, vector, name) of u, which is not zero."""
    for k, name in enumerate("xy"):
        if u[1 - k].is_zero():
            way = sign(u[k])
            if way == 0:
                raise Unsure("a direction of nothing")
            back = way < 0
            unit = [ZERO, ZERO]
            unit[k] = -one() if back else one()
            return (-u[k] if back else u[k]), unit, name
    length = inner(u, u).root()
    over = length.inverse()
    return length, scaled(over, u), next(fresh)


def across(axis, name):
    """The perpendicular axis."""
    return [-axis[1], axis[0]], {"x": "y", "y": "x"}.get(name, ("across", name))


def opposite(u):
    return [-x for x in u]


# --- The algorithm (readings, section 8) --------------------------------------------

class Space:
    """A problem of dimension 3, enclosed."""

    def __init__(self, problem):
        need(problem.dimension == 3, "$.problem.dimension", problem.dimension, "3")
        self.first, self.mu, rows = [], [], 0
        for i, contact in enumerate(problem.contacts):
            need(contact.kind in ("static", "frictionless"), f"$.problem.contacts[{i}].kind", contact.kind,
                 "static or frictionless: others are not supported by this checker for this claim")
            self.first.append(rows)
            self.mu.append(None if contact.mu is None else Number.around(contact.mu))
            rows += 1 if contact.mu is None else 3
        self.A = [[Number.around(x) for x in row] for row in problem.A]
        self.b = [Number.around(x) for x in problem.b]

    def times(self, f):
        used = [j for j, x in enumerate(f) if not x.is_zero()]
        return [sum((row[j] * f[j] for j in used if not row[j].is_zero()), ZERO) for row in self.A]


class Run:
    """A run under one policy: its state, and what is known of where it has been."""

    def __init__(self, space, policy, on_step=lambda step: None):
        """on_step(step) is called after every step, with its text as a certificate has it."""
        contacts, rows = len(space.mu), len(space.b)
        self.space, self.policy, self.on_step = space, policy, on_step
        self.N, self.F = ["none"] * contacts, ["none"] * contacts
        self.f, self.a = [ZERO] * rows, list(space.b)
        self.d, self.d_name = [None] * contacts, [None] * contacts
        self.turned = [False] * contacts  # away: is to be driven anew against its acceleration
        self.on_circle = [False] * contacts  # abs(fF) = mu fN is known, though the contact is not in NCF
        self.force = [None] * contacts  # (d, name) of a friction that is along a direction which was once named
        self.turnings = None  # a list: contacts turn away also where it is not told, (aF beside d, contact, line)
        self.slip_ends = set()  # (contact, line): there is a point of the line with aF = 0
        self.trail, self.last_line, self.followed = None, None, 0
        self.known = set()  # which of the two has told a zero
        self.last, self.drives = None, 0

    def copy(self):
        other = object.__new__(Run)
        other.__dict__ = {key: list(x) if type(x) is list else x for key, x in self.__dict__.items()}
        other.slip_ends = set(self.slip_ends)
        return other

    def tangent(self, values, i):
        row = self.space.first[i]
        return values[row + 1:row + 3]

    def bound(self, i, values=None):
        return self.space.mu[i] * (values or self.f)[self.space.first[i]]

    # What a state is.

    def sets(self):
        last = self.last if self.policy["resume"] == "round" else None
        return (*self.N, *self.F, *self.turned, last)

    def memory(self):
        """(row, contact) of resting forces, (None, contact) of recorded directions."""
        found = []
        for i, row in enumerate(self.space.first):
            if self.N[i] == "none" and not self.f[row].is_zero():
                found.append((row, i))
            if self.F[i] == "NCF":
                found.append((None, i))
            elif self.F[i] == "none" and self.space.mu[i] and not vanishes(self.tangent(self.f, i)):
                found += [(row + 1, i), (row + 2, i)]
        return found

    def coordinates(self, charts):
        """Of the memory: forces; of d the tangent of half its angle, in chart -1 of the opposite angle."""
        for (row, i), chart in zip(self.memory(), charts):
            if row is None:
                x, y = self.d[i] if chart > 0 else opposite(self.d[i])
                yield y / (one() + x)
            else:
                yield self.f[row]

    def standing(self, values, charts, on_step):
        """A run in the sets of this one, with other coordinates: the sets decide all other forces."""
        other = Run(self.space, self.policy, on_step)
        other.N, other.F, other.turned, other.last = list(self.N), list(self.F), list(self.turned), self.last
        other.known = self.known
        f = [ZERO] * len(self.f)
        for (row, i), x, chart in zip(self.memory(), values, charts):
            if row is None:
                over = (one() + x * x).inverse()
                d = [(one() - x * x) * over, (x + x) * over]
                other.d[i], other.d_name[i] = other.force[i] = d if chart > 0 else opposite(d), next(fresh)
            else:
                f[row] = x
        for i, row in enumerate(self.space.first):
            if other.F[i] == "NCF" and other.N[i] != "C":
                f[row + 1:row + 3] = scaled(self.bound(i, f), other.d[i])
        a = plus(self.space.times(f), self.space.b)
        unknown, forces = other.unknowns()
        other.f, other.a = other.follow(unknown, forces, f, a)
        for i, row in enumerate(self.space.first):
            if other.F[i] == "NCF":
                other.f[row + 1:row + 3] = scaled(other.bound(i), other.d[i])
        other.check_sets()
        return other

    def check_sets(self):
        """That what the sets keep holds, and strictly."""
        for i, row in enumerate(self.space.first):
            holds = {"C": lambda: sign(self.f[row]) >= 0, "NC": lambda: sign(self.a[row]) >= 0}
            if self.N[i] in holds and not holds[self.N[i]]():
                raise Unsure("a normal that is not of its set")
            if self.F[i] == "CF":
                fF = self.tangent(self.f, i)
                if sign(self.bound(i) - inner(fF, fF).root()) <= 0:
                    raise Unsure("a force that is not within its circle")

    # Main loop.

    def outer(self):
        """One turn of the main loop."""
        if self.policy["admit"] == "eager":
            for i, row in enumerate(self.space.first):
                if self.N[i] == "none" and sign(self.f[row]) == 0 and sign(self.a[row]) >= 0:
                    self.N[i] = "NC"
        found = self.pick(self.violated)
        if found is None and self.policy["slip"] == "literal":
            found = self.pick(self.opposes_no_more)
        if found is None:
            raise End("solved")
        letter, i = found
        if letter == "N":
            return self.drive("N", i)
        fF = self.tangent(self.f, i)
        if not vanishes(fF):
            self.F[i], self.d[i] = "none", None
            length, axis, name = self.along_force(i)
            self.drive("F", i, axis, name, goal="zero", gap=length)
            if self.policy["rezero"] == "rescan" or not self.violated("F", i):
                return
        self.establish(i)

    def along_force(self, i):
        """(length, axis, name) of fF, which is not zero."""
        fF = self.tangent(self.f, i)
        if self.force[i] is None:
            return axis_along(fF)
        axis, name = self.force[i]
        return inner(axis, fF), axis, name

    def pick(self, fails):
        contacts = range(len(self.N))
        scan, first = self.policy["scan"], self.last if self.policy["resume"] == "round" else None
        if scan == "most-violated":
            for letter in "NF":
                worst = None
                for i in (i for i in contacts if fails(letter, i)):
                    if worst is None or self.worse(letter, i, worst):
                        worst = i
                if worst is not None:
                    return letter, worst
            return None
        step = -1 if scan == "highest" else 1
        first = contacts[-1] * (scan == "highest") if first is None else first
        order = [(first + step * k) % len(contacts) for k in contacts]
        pairs = ([(letter, i) for letter in "NF" for i in order] if scan == "normals-first"
                 else [(letter, i) for i in order for letter in "NF"])
        return next((pair for pair in pairs if fails(*pair)), None)

    def worse(self, letter, i, other):
        if letter == "N":
            return sign(self.a[self.space.first[other]] - self.a[self.space.first[i]]) > 0
        x, y = self.tangent(self.a, i), self.tangent(self.a, other)
        return sign(inner(x, x) - inner(y, y)) > 0

    def violated(self, letter, i):
        """A variable in no set, of which a condition fails: (15), or (21), (22) and aF = 0 or abs(fF) = mu fN."""
        if letter == "N":
            return not self.normal_holds(i)
        return (self.space.mu[i] is not None and self.F[i] == "none" and self.normal_holds(i)
                and not self.friction_holds(i))

    def normal_holds(self, i):
        row = self.space.first[i]
        if self.N[i] != "none":
            return True
        f, a = sign(self.f[row]), sign(self.a[row])
        return f >= 0 and a >= 0 and f * a == 0

    def friction_holds(self, i):
        fF, aF = self.tangent(self.f, i), self.tangent(self.a, i)
        slack = 0 if self.on_circle[i] else sign(self.bound(i) - inner(fF, fF).root())
        if slack < 0:
            return False
        if slack > 0:
            return vanishes(aF) or sign(inner(aF, aF)) == 0
        return vanishes(fF) or sign(inner(fF, aF)) <= 0

    def opposes_no_more(self, letter, i):
        """Whether (21) fails in NCF; fF is along d."""
        if letter == "N" or self.F[i] != "NCF" or not self.normal_holds(i):
            return False
        return sign(self.f[self.space.first[i]]) > 0 and sign(inner(self.d[i], self.tangent(self.a, i))) > 0

    def establish(self, i):
        """fF = 0: x first, then y."""
        x, name = [one(), ZERO], "x"
        if self.turned[i]:
            _, x, name = axis_along(self.tangent(self.a, i))
            x = opposite(x)
        kept = None
        for axis, axis_name in ((x, name), across(x, name)):
            rate = inner(axis, self.tangent(self.a, i))
            way = sign(rate)
            if way == 0:
                self.meet_driven(i, "half" if kept is None else "CF")
            else:
                if way > 0:
                    axis, rate = opposite(axis), -rate
                self.drive("F", i, axis, axis_name, kept, gap=-rate)
            if self.F[i] == "NCF":
                return
            if kept is None and not self.normal_holds(i):
                self.F[i] = "none"
                return
            kept = axis, axis_name

    def meet_driven(self, i, into):
        """A friction that was driven enters a set, which takes its mark away unless it is half."""
        self.F[i], self.force[i] = into, None
        if into == "CF":
            row = self.space.first[i]
            self.a[row + 1] = self.a[row + 2] = ZERO
        if into != "half":
            self.turned[i] = False

    # Drive.

    def column(self, *entries):
        v = [ZERO] * len(self.f)
        for row, x in entries:
            v[row] = x
        return v

    def normal_column(self, i):
        """df if a normal force changes, and with it its friction in NCF."""
        row, entries = self.space.first[i], []
        if self.F[i] == "NCF":
            entries = zip((row + 1, row + 2), scaled(self.space.mu[i], self.d[i]))
        return self.column((row, one()), *entries)

    def unknowns(self, but=None):
        """Equations w.a = 0 and the forces that meet them, of C and CF; `but`: whose friction is driven."""
        tests, forces = [], []
        for i, row in enumerate(self.space.first):
            if self.N[i] == "C":
                tests.append(self.column((row, one())))
                forces.append(self.normal_column(i))
            if self.F[i] == "CF" and i != but:
                for k in (1, 2):
                    tests.append(self.column((row + k, one())))
                    forces.append(tests[-1])
        return tests, forces

    def follow(self, tests, forces, f, a, but=None):
        """f and a, with the forces of C and CF added that make a zero there."""
        effects = [self.space.times(v) for v in forces]
        x = solve([[inner(w, u) for u in effects] + [-inner(w, a)] for w in tests]) if tests else []
        for t, v, u in zip(x, forces, effects):
            f, a = plus(f, scaled(t, v)), plus(a, scaled(t, u))
        for i, row in enumerate(self.space.first):
            if self.N[i] == "C":
                a[row] = ZERO
            if self.F[i] == "CF" and i != but:
                a[row + 1] = a[row + 2] = ZERO
        return f, a

    def direction(self, letter, i, axis, kept):
        row, but = self.space.first[i], i if letter == "F" else None
        tests, forces = self.unknowns(but)
        if letter == "N":
            df = self.normal_column(i)
        else:
            df = self.column((row + 1, axis[0]), (row + 2, axis[1]))
            if kept:
                tests.append(self.column((row + 1, kept[0][0]), (row + 2, kept[0][1])))
                forces.append(tests[-1])
        return self.follow(tests, forces, df, self.space.times(df), but)

    def name_of_line(self, letter, i, axis_name, kept):
        """(direction, forces at rest) of the line of a step: of equal names the lines are equal. Forces at rest: 0 where
        they are zero, otherwise a number for each line that the run has followed. The rest of f follows from a = 0 in C
        and CF and fF = mu fN d in NCF, up to one number; a friction that is driven is along its axes."""
        direction, at_zero = (letter, i, axis_name, kept and kept[1]), True
        for k, row in enumerate(self.space.first):
            moves = self.N[k] == "C" or (letter, k) == ("N", i)
            follows = moves and self.F[k] == "NCF"
            sticks = self.F[k] == "CF" or (letter, k) == ("F", i)
            direction += (moves, sticks, follows and self.d_name[k])
            at_zero = at_zero and (moves or self.f[row].is_zero())
            if self.space.mu[k] is not None and not (sticks or follows):
                at_zero = at_zero and vanishes(self.tangent(self.f, k))
        goes_on = self.last_line is not None and self.last_line[0] == direction
        return direction, 0 if at_zero else self.followed + (not goes_on)

    def drive(self, letter, i, axis=None, axis_name=None, kept=None, goal="establish", gap=None):
        """kept: the axis of half. gap: how far the goal of a friction is, in aF along the axis or in fF."""
        self.drives, self.last = self.drives + 1, i
        left, zero_before = {}, False
        limiting = None
        while limiting != "driven":
            line = self.name_of_line(letter, i, axis_name, kept)
            towards = opposite(axis) if goal == "zero" else axis
            df, da = self.direction(letter, i, towards, kept)
            if goal == "zero":
                fall = one()
            elif letter == "F":
                fall = inner(axis, self.tangent(da, i))
            else:
                fall, gap = da[self.space.first[i]], -self.a[self.space.first[i]]
            t, _, limiting, k, into = self.nearest(self.limits(letter, i, goal, df, da, gap, fall, line))
            zero = t.is_zero()
            self.advance(t, df, da, line, limiting, k, into)
            if not zero and letter == "F":
                gap = gap - t * fall
            self.meet(limiting, k, into, df, line, kept, axis_name)
            if limiting == "driven":
                self.move_driven(letter, i, into)
            else:
                self.move(limiting, k, into, letter, i, left, zero_before, zero, line)
            if not zero:
                self.note_slip_ends(line)
            what = letter if limiting == "driven" else limiting
            self.on_step(f"{letter}{i + 1} {what}{k + 1} {self.N[k] if what == 'N' else self.F[k]}")
            zero_before = zero

    def limits(self, letter, i, goal, df, da, gap, fall, line):
        """(step, rank among ties, what limits, its contact, the set it wants into)."""
        if goal == "zero":
            yield gap, (-1, 0), "driven", i, "none"
        else:
            into = "C" if letter == "N" else "CF"
            yield from ((*limit, "driven", i, into) for limit in self.reached(gap, fall, (-1, 0)))
            if letter == "F":
                yield from ((*limit, "driven", i, "NCF") for limit in self.circle(i, df, (-1, 1)))
        by_set = (lambda place, row: (place, row)) if self.policy["ties"] == "sets" else (lambda place, row: (0, row))
        for k, row in enumerate(self.space.first):
            if letter != "N" or k != i:
                if self.N[k] == "C":
                    yield from ((*x, "N", k, "NC") for x in self.reached(self.f[row], -df[row], by_set(0, row)))
                elif self.N[k] == "NC":
                    yield from ((*x, "N", k, "C") for x in self.reached(self.a[row], -da[row], by_set(1, row)))
            if letter == "F" and k == i:
                continue
            if self.F[k] == "CF":
                yield from ((*x, "F", k, "NCF") for x in self.circle(k, df, by_set(2, row + 1)))
            elif self.F[k] == "NCF":
                yield from ((*x, "F", k, "CF") for x in self.slipping(k, da, by_set(3, row + 1), line))

    @staticmethod
    def reached(gap, fall, rank):
        if sign(fall) > 0:
            yield gap / fall, rank

    def circle(self, i, df, rank):
        """(23): c + 2 B s + K s^2 falls to zero, or below where c = 0."""
        fF, dF = self.tangent(self.f, i), self.tangent(df, i)
        bound, growth = self.bound(i), self.bound(i, df)
        force = inner(fF, fF).root()
        B, K = bound * growth - inner(fF, dF), growth * growth - inner(dF, dF)
        slack = bound - force
        if self.on_circle[i] or slack.is_zero():
            if sign(B) < 0 or sign(B) == 0 and sign(K) < 0:
                yield ZERO, rank
            elif sign(B) > 0 and sign(K) < 0:
                yield -(B + B) / K, rank
            return
        if sign(slack) < 0:
            raise Unsure("a force outside its circle")
        c = slack * (bound + force)
        D = B * B - K * c
        if sign(K) < 0:  # two forms of one root, each good for one sign of B
            yield (c / (D.root() - B) if B.low + B.high <= 0 else (B + D.root()) / -K), rank
        elif sign(B) < 0 and sign(D) >= 0:
            yield c / (D.root() - B), rank

    def slipping(self, i, da, rank, line):
        """Back into CF: at aF = 0, or under slip=redirect at d.aF = 0."""
        aF, dA = self.tangent(self.a, i), self.tangent(da, i)
        one_line = (i, line) in self.slip_ends and not vanishes(aF)
        redirect = self.policy["slip"] == "redirect"
        if not one_line and (redirect or vanishes(aF)):
            yield from self.reached(-inner(self.d[i], aF), inner(self.d[i], dA), rank)
            return
        aside = aF[0] * dA[1] - aF[1] * dA[0]
        if one_line:
            if not redirect and aside.low <= 0 <= aside.high and not aside.is_zero():
                self.known.add("line")
        elif not aside.is_zero() and sign(aside) != 0:
            return
        grows = not redirect or sign(inner(self.d[i], dA)) > 0
        if grows and sign(inner(aF, dA)) < 0:
            yield from self.reached(-inner(aF, dA), inner(dA, dA), rank)

    @staticmethod
    def nearest(limits):
        limits = list(limits)
        if not limits:
            raise End("ray")
        at_once = [limit for limit in limits if limit[0].is_zero()]
        if any(not x[0].is_zero() and sign(x[0]) < 0 for x in limits):
            raise Unsure("a step backwards")
        if at_once:
            return min(at_once, key=lambda limit: limit[1])
        best = limits[0]
        for limit in limits[1:]:
            order = sign(limit[0] - best[0])
            if order == 0:
                raise Unsure("two equal steps")
            best = limit if order < 0 else best
        return best

    def note_slip_ends(self, line):
        self.slip_ends.update((i, line) for i, mu in enumerate(self.space.mu)
                              if mu is not None and vanishes(self.tangent(self.a, i)))

    def advance(self, t, df, da, line, limiting, k, into):
        """f += t df, a += t da; and what is known of where the run has been."""
        if t.is_zero():
            return
        if line != self.last_line:
            self.last_line, self.followed = line, self.followed + 1
        self.note_slip_ends(line)
        trail = self.trail
        if trail and trail["line"] is None:
            trail = self.trail = {**trail, "line": line}
        if trail and (limiting, k, into) == ("N", trail["contact"], "C") and trail["line"] == line:
            self.f, self.a = list(trail["f"]), list(trail["a"])
            self.known.add("trail")
        else:
            self.f, self.a = plus(self.f, scaled(t, df)), plus(self.a, scaled(t, da))
        for i, row in enumerate(self.space.first):
            if not vanishes(df[row:row + 3] if self.space.mu[i] else []):
                self.on_circle[i] = False

    def meet(self, limiting, i, into, df, line, kept, axis_name):
        """The limit is met exactly, and so is abs(fF) = mu fN in NCF."""
        row = self.space.first[i]
        if into == "C":
            self.a[row] = ZERO
        elif into == "NC":
            self.f[row] = ZERO
        elif into == "none":
            self.f[row + 1] = self.f[row + 2] = ZERO
        elif into == "NCF":
            fF, name = self.tangent(self.f, i), axis_name
            if limiting == "driven" and kept is None:  # from fF = 0 along the axis
                self.d[i] = self.tangent(df, i)
            else:
                _, self.d[i], name = axis_along(self.tangent(df, i) if vanishes(fF) else fF)
            self.d_name[i] = next(fresh) if type(name) is str else name
            self.force[i] = self.d[i], name
        elif limiting == "driven":
            if kept:
                self.a[row + 1] = self.a[row + 2] = ZERO
            elif axis_name in ("x", "y"):
                self.a[row + 1 + (axis_name == "y")] = ZERO
        elif self.policy["slip"] == "literal" or (i, line) in self.slip_ends:
            if self.policy["slip"] == "redirect" and not vanishes(self.tangent(self.a, i)):
                self.known.add("line")
            self.a[row + 1] = self.a[row + 2] = ZERO
        for k, at in enumerate(self.space.first):
            if self.F[k] == "NCF" or (k == i and into == "NCF"):
                self.f[at + 1:at + 3] = scaled(self.bound(k), self.d[k])
        if limiting == "N" and into == "NC":
            self.trail = {"contact": i, "f": list(self.f), "a": list(self.a), "line": None}

    def move_driven(self, letter, i, into):
        if letter == "N":
            self.N[i] = "C"
        elif into == "none":
            self.F[i] = "none"
        elif into == "CF" and self.F[i] == "none":
            self.F[i], self.force[i] = "half", None
        else:
            self.F[i], self.turned[i] = into, False
            if into == "CF":
                self.force[i] = None

    def move(self, what, k, into, letter, i, left, zero_before, zero, line):
        """The limiting variable enters the set it wants into, turns away, or is given up."""
        if what == "F" and self.F[k] == "NCF" and self.policy["slip"] == "redirect" and self.turns_away(k, line):
            left[what, k], self.turned[k] = "NCF", True
            self.rest(k)
            return
        give_up = {"first": zero, "previous": zero_before, "second": zero_before and zero}
        if left.get((what, k)) == into and give_up[self.policy["give-up"]]:
            left[what, k] = self.N[k] if what == "N" else self.F[k]
            if what == "F":
                return self.rest(k)
            self.N[k] = "none"
            if self.policy["drop"] == "contact" and k != i and self.F[k] != "none":
                left["F", k] = self.F[k]
                self.rest(k)
        elif what == "N":
            left[what, k], self.N[k] = self.N[k], into
        else:
            left[what, k], self.F[k] = self.F[k], into
            if into == "CF":
                self.on_circle[k], self.d[k], self.force[k] = True, None, None

    def rest(self, i):
        """A friction enters none. From NCF its force rests on the circle."""
        self.on_circle[i] = self.on_circle[i] or self.F[i] == "NCF"
        self.F[i], self.d[i] = "none", None

    def turns_away(self, i, line):
        """At d.aF = 0: whether aF is not zero."""
        aF, row = self.tangent(self.a, i), self.space.first[i]
        aside = self.d[i][0] * aF[1] - self.d[i][1] * aF[0]
        if self.turnings is not None and not (vanishes(aF) or aside.is_zero()):
            self.turnings.append((aside, i, line))
            return True
        if not vanishes(aF) and sign(aside) != 0:
            return True
        self.a[row + 1] = self.a[row + 2] = ZERO
        return False

    def run_until(self, drives):
        """To the first outer state after so many drives."""
        while self.drives < drives:
            self.outer()


# --- The claims cycle and ray in space --------------------------------------------------------

class Stated:
    """The steps that a certificate states, against those that are made."""

    def __init__(self, word, done=0):
        self.word, self.done = word, done

    def __call__(self, step):
        place = f"$.witness.word[{self.done}]"
        need(self.done < len(self.word), "$.witness.word", len(self.word), "more steps: it does not end there")
        need(self.word[self.done] == step, place, self.word[self.done], step)
        self.done += 1

    def must_be_done(self):
        need(self.done == len(self.word), "$.witness.word", len(self.word), f"{self.done} steps")


def same_state_again(run, earlier):
    need(run.sets() == earlier.sets(), "$.witness.period", brief(str(run.sets())), f"the sets {earlier.sets()}")
    need(run.memory() == earlier.memory(), "$.witness.period", brief(str(run.memory())), "the same things remembered")


def check_states(run, witness):
    """The sets decide the state, and recur."""
    need(not run.memory(), "$.witness.start", witness["start"], "a state that remembers nothing but its sets")
    earlier = run.copy()
    run.standing([], [], run.on_step)  # whose matrix is regular
    run.run_until(witness["start"] + witness["period"])
    same_state_again(run, earlier)
    run.on_step.must_be_done()
    return "states"


def distance(x, ends):
    """Of a fraction from the further end of a number."""
    return max(abs(Fraction(end, 1 << Number.bits) - x) for end in ends)


def read_box(run, witness):
    """charts, centre, radii; the run stands in the box."""
    memory = run.memory()
    need(memory, "$.witness.start", witness["start"], "a state that remembers something")
    charts = [integer(item, at, -1, 2) for at, item in items(witness["charts"], "$.witness.charts", len(memory))]
    for m, (chart, (row, _)) in enumerate(zip(charts, memory)):
        need((chart == 0) == (row is not None), f"$.witness.charts[{m}]", chart, "1 or -1 of a direction, 0 of a force")
    centre, radii = (vector(witness[key], f"$.witness.{key}", len(memory)) for key in ("centre", "radii"))
    for m, x in enumerate(run.coordinates(charts)):
        need(radii[m] > 0, f"$.witness.radii[{m}]", radii[m], "a number > 0")
        found = distance(centre[m], (x.low, x.high))
        need(found <= radii[m], f"$.witness.centre[{m}]", centre[m], "a box in which the state at start is")
    return charts, centre, radii


def take_period(walk, run, witness):
    """One period more, of the steps that are stated, to the sets of `run`, which stands at the start; after every step,
    how many names were given in the period."""
    end, first, named = walk.drives + witness["period"], next(fresh), []
    stated = Stated(witness["word"], run.on_step.done)

    def note(step):
        stated(step)
        named.append(next(fresh) - first)

    walk.on_step = note
    walk.run_until(end)
    need(walk.drives == end, "$.witness.period", witness["period"], "drives to a state of the main loop")
    same_state_again(walk, run)
    stated.must_be_done()
    return named


def image(run, witness, values, charts):
    """Of coordinates: what the period makes of them, if contacts turn away where they may; (coordinates, run, run at
    the start)."""
    begins = run.standing(values, charts, None)
    begins.turnings = []
    ends = begins.copy()
    take_period(ends, run, witness)
    return list(ends.coordinates(charts)), ends, begins


def turnings_that_end(run, witness, box, charts):
    """Of each contact that turns away in a period: whether its aF were zero there, if every period were like the one
    before. What one period names the next names again, so many names later: are there lines of which that shows that
    they are one, and has it a point with aF = 0? `box`: all points at once, so that what has one name there is the same
    by the steps that the run takes, not by the numbers of one point."""
    walk = run.standing(box, charts, None)
    walk.turnings, marks, counts, named = [], [next(fresh)], [0], []
    for _ in range(3):
        named.append(take_period(walk, run, witness))
        marks.append(next(fresh))
        counts.append(len(walk.turnings))
    apart = marks[1] - marks[0]
    if any(y - x != apart for x, y in zip(marks, marks[1:])) or not named[0] == named[1] == named[2]:
        raise Unsure("whether two periods name the same")

    def alike(name):
        if type(name) is tuple:
            return tuple(map(alike, name))
        return -1 - (name - marks[0]) % apart if type(name) is int and name >= marks[0] else name

    ends = set(map(alike, walk.slip_ends))
    return [line[1] == 0 and alike((i, line)) in ends for _, i, line in walk.turnings[counts[2]:]]


class Box:
    """The box of a certificate, in which the run stands, and which the period maps into itself."""

    def __init__(self, run, witness):
        self.run, self.witness = run, witness
        self.charts, self.centre, self.radii = read_box(run, witness)
        size, unit = len(self.centre), 1 << Number.bits
        middle, *_ = image(run, witness, [Number.around(x) for x in self.centre], self.charts)
        box = self.sides()
        found, ends, begins = image(run, witness, box, self.charts)
        self.turnings = [aside for aside, *_ in ends.turnings]
        self.slopes = [x.slopes or [(0, 0)] * size for x in found]
        self.moving, self.spread = [], {}
        for m, (row, i) in enumerate(run.memory()):
            if row is None:
                untouched = ends.d_name[i] == begins.d_name[i]
            else:
                untouched = (found[m].low, found[m].high, self.slopes[m]) == (box[m].low, box[m].high, box[m].slopes)
            if untouched:
                continue
            self.moving.append(m)
            self.spread[m] = sum(Fraction(max(map(abs, slope)), unit) for slope in self.slopes[m])
            reach = distance(self.centre[m], (middle[m].low, middle[m].high)) + self.spread[m]  # F(c) + F' (x - c)
            need(reach <= self.radii[m], f"$.witness.radii[{m}]", self.radii[m], reach, ", as far as the period leads")
        if witness["kind"] == "punctured":
            self.must_turn_away()
        elif any(x.low <= 0 <= x.high for x in self.turnings):
            raise Unsure("whether a contact turns away")

    def __str__(self):
        kind = "punctured box" if self.witness["kind"] == "punctured" else "box"
        return f"a {kind} of {len(self.radii)} coordinates, {len(self.radii) - len(self.moving)} untouched"

    def sides(self):
        return [Number.side(m, len(self.centre), x, r) for m, (x, r) in enumerate(zip(self.centre, self.radii))]

    def must_turn_away(self):
        """But at the fixed point, to which the run does not come."""
        need(len(self.moving) == 1, "$.witness.kind", f"{len(self.moving)} coordinates move", "1 in a punctured box")
        ends = turnings_that_end(self.run, self.witness, self.sides(), self.charts)
        if len(ends) != len(self.turnings):
            raise Unsure("which contacts turn away")
        for end, aside in zip(ends, self.turnings):
            if aside.low <= 0 <= aside.high:
                low, high = (aside.slopes or [(0, 0)] * len(self.radii))[self.moving[0]]
                need(end and not low <= 0 <= high, "$.witness.kind", "punctured",
                     "contacts that turn away but at the fixed point")
        self.must_not_repeat()

    def must_not_repeat(self):
        """The period contracts, takes different points to different ones, and moves the first."""
        for m in self.moving:
            need(self.spread[m] < self.radii[m], f"$.witness.radii[{m}]", self.radii[m], f"more than {self.spread[m]}")
        solve([[Number(*self.slopes[m][k]) for k in self.moving] + [ZERO] for m in self.moving])  # so it is regular
        first = list(self.run.coordinates(self.charts))
        then, *_ = image(self.run, self.witness, first, self.charts)
        apart = [m for m in self.moving if first[m].high < then[m].low or then[m].high < first[m].low]
        need(apart, "$.witness.start", self.witness["start"], "a state that the period surely moves")


def step_operations(n, coordinates, steps):
    """Of steps over numbers with so many derivatives."""
    return steps * (1 + coordinates) * (n**3 + 20 * n**2 + 300 * n) // 4


def begin(problem, witness, policy, coordinates=0):
    """A run from f = 0, over numbers of so many bits, of the steps that are stated."""
    Number.bits = integer(witness["bits"], "$.witness.bits", 64, MOST_BITS + 1)
    steps = len(listed(witness["word"], "$.witness.word")) + 1
    Cost(step_operations(len(problem.b), coordinates, steps)).add(Number.bits).longest_row(problem)
    for at, step in items(witness["word"], "$.witness.word"):
        need(type(step) is str, at, step, "a step as a text")
    numbers = [*problem.b, *(x for row in problem.A for x in row), *(contact.mu or 0 for contact in problem.contacts)]
    largest = max(map(abs, numbers), default=0)
    need(largest < 1 << Number.bits // 4, "$.witness.bits", Number.bits, f"more bits: {LARGE}")
    return Run(Space(problem), policy, Stated(witness["word"]))


def refuse_unsure(run, unsure):
    need(False, "$.witness.bits", Number.bits, f"more bits: {unsure} is not told after {run.on_step.done} steps")


def check_ray(problem, witness, policy):
    """The facts to print of a run that comes to a step which nothing limits."""
    run = begin(problem, witness, policy)
    try:
        while True:
            run.outer()
    except Unsure as unsure:
        refuse_unsure(run, unsure)
    except End as end:
        need(str(end) == "ray", "$.witness.word", str(end), "a run that ends in a step without a limit")
    run.on_step.must_be_done()
    return f"in space, after {run.on_step.done} steps"


def check_loop(problem, witness, policy, repeats=True):
    """The facts to print of a loop in space; without `repeats`, of one that repeats no state."""
    kind = one_of(witness["kind"], "$.witness.kind", ("states",) * repeats + ("box", "punctured"))
    start = integer(witness["start"], "$.witness.start", 0, 1 << 31)
    period = integer(witness["period"], "$.witness.period", 1, 1 << 31)
    need((kind != "states") == ("radii" in witness), "$.witness", kind, "charts, centre and radii of a box only")
    coordinates = len(witness["radii"]) if kind != "states" and type(witness["radii"]) is list else 0
    need(coordinates <= 3 * len(problem.contacts), "$.witness.radii", coordinates, "fewer coordinates")
    run = begin(problem, witness, policy, coordinates)
    try:
        run.run_until(start)
        need(run.drives == start, "$.witness.start", start, f"{run.drives}: no outer state after {start} drives")
        how = check_states(run, witness) if kind == "states" else Box(run, witness)
        if not repeats:
            how.must_not_repeat()
    except Unsure as unsure:
        refuse_unsure(run, unsure)
    except End as end:
        need(False, "$.witness.word", str(end), "a run that does not end")
    by = f", by the {' and the '.join(sorted(run.known))}" if run.known else ""
    return f"in space, {how}, start {start}, period {period}{by}{'' if repeats else '; no state recurs'}"
