# SPDX-License-Identifier: Apache-2.0
"""Numbers that stand for many at once. A sign that is asked for is proved to be the same for all of them; where that is
not shown, ArithmeticError. So a run over them is the run of every one: its decisions are signs.

  Function  a rational function of x and y, for all x > 0 and y > 0
  Affine    p + q t, for all t with 0 <= t < end
"""

from fractions import Fraction
from functools import total_ordering
from math import gcd

# ---- Polynomials in x and y, {(power of x, power of y): coefficient} ------------------------------------------------

ONE = {(0, 0): 1}


def plus(p, q, factor=1):
    r = dict(p)
    for power, c in q.items():
        r[power] = r.get(power, 0) + factor * c
    return {power: c for power, c in r.items() if c}


def product(p, q):
    r = {}
    for (i, j), c in p.items():
        for (k, l), d in q.items():
            r[i + k, j + l] = r.get((i + k, j + l), 0) + c * d
    return {power: c for power, c in r.items() if c}


def value(p, x, y):
    return sum(c * x ** i * y ** j for (i, j), c in p.items())


def quotient(p, q):
    """p / q, if that is a polynomial with integer coefficients."""
    result, (i, j) = {}, max(q)
    while p:
        k, l = max(p)
        c, rest = divmod(p[k, l], q[i, j])
        if rest or k < i or l < j:
            return None
        result[k - i, l - j] = c
        p = plus(p, product({(k - i, l - j): c}, q), -1)
    return result


def digits(n, base):
    """Of least absolute value, from the last."""
    while n:
        n, digit = divmod(n + base // 2, base)
        yield digit - base // 2


def without_common_factor(p, q):
    """The greatest common divisor of the values at large x and y has the coefficients of that of p and q as its digits.
    Division says whether it has; where no try succeeds p and q stay as they are, which is no error."""
    size = 2 * max(map(abs, (*p.values(), *q.values()))) + 29
    for _ in range(6):
        x, y = size, 2 * size ** (2 + max(i for i, _ in (*p, *q)))
        common = gcd(value(p, x, y), value(q, x, y))
        factor = {(i, j): c for j, n in enumerate(digits(common, y)) for i, c in enumerate(digits(n, x)) if c}
        content = gcd(*factor.values())
        factor = {power: c // content for power, c in factor.items()}
        parts = quotient(p, factor), quotient(q, factor)
        if None not in parts:
            return parts
        size = size * 73794 // 27011
    return p, q


def lowest_terms(p, q):
    if q.keys() != ONE.keys():
        p, q = without_common_factor(p, q)
    content = gcd(*p.values(), *q.values()) * (1 if q[max(q)] > 0 else -1)
    return ({power: c // content for power, c in part.items()} for part in (p, q))


# ---- Numbers ------------------------------------------------------------------------------------------------------


class Number:
    """What `sign`, `of`, sums and products say already."""

    def __sub__(self, other):
        return self + -self.of(other)

    def __rsub__(self, other):
        return self.of(other) - self

    def __rtruediv__(self, other):
        return self.of(other) / self

    def __abs__(self):
        return self if self.sign() >= 0 else -self

    def __bool__(self):
        return self.sign() != 0

    def __lt__(self, other):
        return (self - other).sign() < 0


@total_ordering
class Function(Number):
    """p / q."""

    def __init__(self, p, q=ONE):
        self.p, self.q = lowest_terms(p, q) if p else (p, ONE)
        self.known_sign = self.known_hash = None

    @staticmethod
    def of(x):
        if isinstance(x, Function):
            return x
        x = Fraction(x)
        return Function({(0, 0): x.numerator} if x else {}, {(0, 0): x.denominator})

    def sign(self):
        """That of all coefficients of p and of all of q."""
        if self.known_sign is None:
            signs = [{1 if c > 0 else -1 for c in part.values()} for part in (self.p, self.q)]
            if max(map(len, signs)) > 1:
                raise ArithmeticError(f"expected one sign for all x, y > 0: {self.p} / {self.q}")
            self.known_sign = signs[0].pop() * signs[1].pop() if self.p else 0
        return self.known_sign

    def __add__(self, other):
        other = self.of(other)
        if not self.p or not other.p:
            return self if self.p else other
        if self.q == other.q:
            return Function(plus(self.p, other.p), self.q)
        return Function(plus(product(self.p, other.q), product(other.p, self.q)), product(self.q, other.q))

    def __neg__(self):
        return self * Function({(0, 0): -1})

    def __mul__(self, other):
        other = self.of(other)
        return Function(product(self.p, other.p), product(self.q, other.q))

    def __truediv__(self, other):
        other = self.of(other)
        return Function(product(self.p, other.q), product(self.q, other.p))

    __radd__, __rmul__ = __add__, __mul__

    def __eq__(self, other):
        other = self.of(other)
        return (self.p, self.q) == (other.p, other.q) or not (self - other).sign()

    def __hash__(self):
        if self.known_hash is None:
            constant = not self.p or self.p.keys() == self.q.keys() == ONE.keys()
            parts = frozenset(self.p.items()), frozenset(self.q.items())
            self.known_hash = hash(self.at(1, 1) if constant else parts)
        return self.known_hash

    def at(self, x, y):
        return Fraction(value(self.p, x, y)) / value(self.q, x, y)


X, Y = Function({(1, 0): 1}), Function({(0, 1): 1})


@total_ordering
class Affine(Number):
    """p + q t. A product of two that both change with t has only a sign, by those of its factors."""

    def __init__(self, p, q, end):
        self.p, self.q, self.end = p, q, end

    def of(self, x):
        return x if isinstance(x, Affine) else Affine(Fraction(x), Fraction(0), self.end)

    def sign(self):
        """That at 0 and that just before the end; in between there is no other."""
        first, last = self.p, self.p + self.q * self.end or -self.q
        signs = {(x > 0) - (x < 0) for x in (first, last)}
        if len(signs) > 1:
            raise ArithmeticError(f"expected one sign for 0 <= t < {self.end}: {self.p} + {self.q} t")
        return signs.pop()

    def __add__(self, other):
        other = self.of(other)
        return Affine(self.p + other.p, self.q + other.q, self.end)

    def __neg__(self):
        return Affine(-self.p, -self.q, self.end)

    def __mul__(self, other):
        other = self.of(other)
        if self.q and other.q:
            return self.sign() * other.sign()
        return Affine(self.p * other.p, self.p * other.q + self.q * other.p, self.end)

    def __truediv__(self, other):
        other = self.of(other)
        if other.q:
            raise ArithmeticError(f"expected a divisor that is the same for all t: {other.p} + {other.q} t")
        return Affine(self.p / other.p, self.q / other.p, self.end)

    __radd__, __rmul__ = __add__, __mul__

    def __eq__(self, other):
        return (self - other).sign() == 0

    def __hash__(self):
        return hash((self.p, self.q))
