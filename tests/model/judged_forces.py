# SPDX-License-Identifier: Apache-2.0
"""Forces that are called a solution, judged over fractions by what a user would call wrong: see attack.py."""

import collections
import math
from fractions import Fraction

SLACK = 4
EXCUSED = {"float": (Fraction(1, 10**5), Fraction(8, 2**24))}  # eps, tau
USUAL = (Fraction(1, 10**8), Fraction(8, 2**53))
LONG = 128  # bits behind the point of a root

Wrong = collections.namedtuple("Wrong", "badness kind contact")


def ratio(x, unit):
    """x / unit, where x is positive; infinite where it is too large for a number."""
    if x <= 0:
        return 0.0
    try:
        return float(x / unit) if unit else math.inf
    except OverflowError:
        return math.inf


def length(values):
    """Of integers, times 2^LONG."""
    return math.isqrt(sum(x * x for x in values) << 2 * LONG)


def row_count(contact, dimension):
    return dimension if contact["kind"] in ("static", "sliding") else 1


class Numbers:
    """A problem as integers over one denominator, and the rows of its contacts: normal, tangents."""

    def __init__(self, problem):
        A, b = ([[Fraction(x) for x in row] for row in rows] for rows in (problem["A"], [problem["b"]]))
        self.over = math.lcm(*(x.denominator for row in A + b for x in row))
        self.A, b = ([[x.numerator * (self.over // x.denominator) for x in row] for row in rows] for rows in (A, b))
        self.b = b[0]
        self.contacts, row = problem["contacts"], 0
        self.rows = []
        for contact in self.contacts:
            count = row_count(contact, problem["dimension"])
            self.rows.append((row, list(range(row + 1, row + count))))
            row += count


class Judge:
    """Forces of a problem. Accelerations are integers over numbers.over times the forces' denominator."""

    def __init__(self, numbers, forces, eps, tau, law=None, in_angle=False):
        self.p, self.eps, self.law, self.in_angle = numbers, eps, law, in_angle
        forces = [Fraction(x) for x in forces]
        over = math.lcm(*(x.denominator for x in forces))
        self.f = [x.numerator * (over // x.denominator) for x in forces]
        self.products = [[(j, x * y) for j, (x, y) in enumerate(zip(row, self.f)) if x and y] for row in numbers.A]
        self.a = [sum((x for _, x in row), b * over) for row, b in zip(self.products, numbers.b)]
        self.excuse = [0] * len(self.a)  # of b alone
        for normal, tangents in numbers.rows:
            self.excuse[normal] = SLACK * eps * abs(numbers.b[normal] * over)
            for t in tangents:
                self.excuse[t] = SLACK * eps * Fraction(length([numbers.b[k] * over for k in tangents]), 1 << LONG)
        self.tau = SLACK * tau

    def wrongs(self):
        """What is missed, the worst first, with the choice of contacts that carry nothing for which it is least."""
        forced = {k for k, (normal, _) in enumerate(self.p.rows)
                  if self.p.contacts[k]["kind"] != "bilateral" and self.f[normal] <= 0}
        least = self.least(forced, "parts beyond below drives askew sliding")
        # Where no choice is right, what is wrong is named by one that only contacts that move apart are free in.
        return least if least[0].badness <= 1 else self.least(forced, "parts")

    def least(self, idle, kinds):
        """The best choice: takes the worst contact for one that carries nothing, while what is wrong is of these kinds.
        The more carry nothing, the smaller are units and the more do ghosts: no choice without that one is better."""
        best = now = self.of(idle)
        while now[0].kind in kinds.split():
            idle = idle | {now[0].contact}
            now = self.of(idle)
            best = min(best, now, key=lambda wrongs: wrongs[0].badness)
        return best

    def of(self, idle):
        """What is wrong if the contacts `idle` carry nothing."""
        nothing = {j for k in idle for j in [self.p.rows[k][0], *self.p.rows[k][1]]}
        units, ghosts = [], []
        for row, excuse in zip(self.products, self.excuse):
            units.append(excuse + self.tau * sum(abs(x) for j, x in row if j not in nothing))
            ghosts.append(sum(abs(x) for j, x in row if j in nothing))
        pull = not any(self.f[j] for j in nothing if not self.pulls(j))
        found = [Wrong(max(map(ratio, ghosts, units), default=0.0), "pulls" if pull else "ghosts", None)]
        for k in range(len(self.p.rows)):
            found += self.contact(k, k in idle, units)
        return sorted(found, key=lambda w: -w.badness)

    def pulls(self, j):
        return self.f[j] < 0 and any(j == normal for normal, _ in self.p.rows)

    def contact(self, k, idle, units):
        contact, (normal, tangents) = self.p.contacts[k], self.p.rows[k]
        a, unit = self.a[normal], units[normal]
        if contact["kind"] == "bilateral":
            return [Wrong(ratio(abs(a), unit), "moves", k)]
        found = [Wrong(ratio(-a, unit), "sinks", k)]
        if not idle:
            found.append(Wrong(ratio(a, unit), "parts", k))
            if tangents:
                found.append(Wrong(*self.friction(contact, normal, tangents, units), k))
        return found

    def friction(self, contact, normal, tangents, units):
        """Badness and kind, of a contact that is pressed."""
        mu = Fraction(contact["mu"])
        limit = mu.numerator * self.f[normal]
        f, a = [self.f[t] * mu.denominator for t in tangents], [self.a[t] for t in tangents]
        units = [units[t] for t in tangents]
        allowed = SLACK * self.eps * (limit << LONG)
        if contact["kind"] == "sliding":
            slip = contact["slip"] if isinstance(contact["slip"], list) else [contact["slip"]]
            slip = [Fraction(s) for s in slip]
            over = math.lcm(*(s.denominator for s in slip))
            missed = [int((x + s * limit) * over) for x, s in zip(f, slip)]
            return ratio(Fraction(length(missed), over), allowed), "sliding"
        size, full = length(f), limit << LONG
        beyond = ratio(size - full, allowed)
        if not limit:  # it may slip as it likes
            return beyond, "beyond"
        rests = max(map(ratio, map(abs, a), units))
        below, driving = ratio(full - size, allowed), self.driving(f, a, units)
        if max(beyond, rests) < max(beyond, below, driving):
            return max((beyond, "beyond"), (rests, "below"))
        kinds = [(beyond, "beyond"), (below, "below"),
                 (driving, "drives" if sum(x * y for x, y in zip(f, a)) > 0 else "askew")]
        return max(kinds)

    def driving(self, f, a, units):
        """What a slip of acceleration a against friction f misses."""
        if self.law == "baraff" and len(f) == 2:
            return ratio(sum(x * y for x, y in zip(f, a)), sum(abs(x) * unit for x, unit in zip(f, units)))
        if self.in_angle:
            turned = SLACK * self.eps * Fraction(length(a), 1 << LONG)
            units = [unit + turned for unit in units]
        least = Fraction(1, 1 << 4 * LONG)
        p, q = ([Fraction(x) / (unit or least) for x, unit in zip(xs, units)] for xs in (a, f))
        tried = [Fraction(0), *(-x / y for x, y in zip(p, q) if y)]
        if len(p) == 2:  # where both miss the same
            tried += [-(p[0] + s * p[1]) / (q[0] + s * q[1]) for s in (1, -1) if q[0] + s * q[1]]
        return ratio(min(max(abs(x + t * y) for x, y in zip(p, q)) for t in tried if t >= 0), 1)
