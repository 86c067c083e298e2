# SPDX-License-Identifier: Apache-2.0
"""Exact intervals at 95 %, by bisection of the tails: Garwood's of a count, Clopper and Pearson's of a share.

Written apart from corpus/intervals.h, which the program prints; figures_test.py compares the two."""

import math

TAIL = 0.025
TINY = 1e-300


def continued_fraction(terms):
    """The value of 1 / (1 + t1 / (1 + t2 / ...)), by Lentz's method."""
    value = c = 1.0
    d = 0.0
    for term in terms:
        d = 1 / (1 + term * d or TINY)
        c = 1 + term / c or TINY
        value *= c * d
        if abs(c * d - 1) < 1e-15:
            break
    return 1 / value


def beta_tail(p, a, b):
    """The regularized incomplete beta function I_p(a, b): the chance of at least a of a + b - 1 at chance p."""
    if p <= 0 or p >= 1:
        return float(p >= 1)
    if p > (a + 1) / (a + b + 2):
        return 1 - beta_tail(1 - p, b, a)
    terms = (term for m in range(100000)
             for term in (-(a + m) * (a + b + m) * p / ((a + 2 * m) * (a + 2 * m + 1)),
                          (m + 1) * (b - m - 1) * p / ((a + 2 * m + 1) * (a + 2 * m + 2))))
    scale = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(p) + b * math.log1p(-p)
    return math.exp(scale) * continued_fraction(terms) / a


def gamma_tail(mean, k):
    """The chance of at least k events where `mean` are expected."""
    if mean <= 0:
        return 0.0
    largest = max(0.0, mean - k)
    total, term, j = 0.0, 1.0, k
    if largest == 0.0:  # sum up from k
        log_first = k * math.log(mean) - mean - math.lgamma(k + 1)
        while term > 1e-17 * total:
            total += term
            j += 1
            term *= mean / j
        return math.exp(log_first) * total
    log_first = (k - 1) * math.log(mean) - mean - math.lgamma(k)  # sum down from k - 1
    j = k - 1
    while j >= 0 and term > 1e-17 * total:
        total += term
        term *= j / mean
        j -= 1
    return 1 - math.exp(log_first) * total


def root(rising, wanted, low, high):
    for _ in range(200):
        middle = (low + high) / 2
        if rising(middle) < wanted:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def garwood(count):
    """Of the expected number of events, `count` of which were seen."""
    most = 2 * count + 20
    low = root(lambda mean: gamma_tail(mean, count), TAIL, 0, most) if count else 0.0
    return low, root(lambda mean: gamma_tail(mean, count + 1), 1 - TAIL, 0, most)


def clopper_pearson(count, of):
    """Of the chance, `count` times in `of` trials."""
    low = root(lambda p: beta_tail(p, count, of - count + 1), TAIL, 0, 1) if count else 0.0
    high = root(lambda p: beta_tail(p, count + 1, of - count), 1 - TAIL, 0, 1) if count < of else 1.0
    return low, high


# ---- A power of two sizes ------------------------------------------------------------------------------------

NORMAL = 1.959964  # the standard normal's quantile at 97.5 %


def largest(function, low, high):
    """Where a concave function is largest."""
    for _ in range(60):
        left, right = low + (high - low) / 3, high - (high - low) / 3
        if function(left) < function(right):
            low = left
        else:
            high = right
    return (low + high) / 2


def power_law(cells, most=20):
    """The rate C x^p y^q of Poisson counts, fitted by likelihood to cells (count, of, x, y), some of which count. p and q
    with their intervals at 95 %, of the profile likelihood, C, the deviance and its degrees of freedom. Where the law
    misses by more than chance, the deviance being above its degrees, the intervals are wider by the root of what it is
    above (quasi-likelihood)."""
    total = sum(k for k, *_ in cells)

    def expected(p, q):
        return [of * x**p * y**q for _, of, x, y in cells]

    def likelihood(p, q):  # C is best
        return sum(k * (p * math.log(x) + q * math.log(y)) for k, _, x, y in cells) - total * math.log(sum(expected(p, q)))

    def best_q(p):
        return largest(lambda q: likelihood(p, q), -most, most)

    def best_p(q):
        return largest(lambda p: likelihood(p, q), -most, most)

    p = largest(lambda p: likelihood(p, best_q(p)), -most, most)
    q = best_q(p)
    scale = total / sum(expected(p, q))
    misses = [(k, scale * mean) for (k, *_), mean in zip(cells, expected(p, q))]
    deviance = 2 * sum((k * math.log(k / mean) if k else 0) - (k - mean) for k, mean in misses)
    freedom = len(cells) - 3
    drop = NORMAL**2 / 2 * max(1, deviance / freedom)

    def ends(profile, at):
        wanted = profile(at) - drop
        return root(profile, wanted, -most, at), -root(lambda z: profile(-z), wanted, -most, -at)

    def of_p(z):
        return likelihood(z, best_q(z))

    def of_q(z):
        return likelihood(best_p(z), z)

    return {"p": (p, *ends(of_p, p)), "q": (q, *ends(of_q, q)), "C": scale, "deviance": deviance, "freedom": freedom}
