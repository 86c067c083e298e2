#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks stiction certificates: a claim about a contact problem, with an exact witness.

Letters are those of [Baraff94] (D. Baraff, Fast contact force computation for nonpenetrating rigid bodies,
SIGGRAPH 1994), section 5:

  a = A f + b       forces f and accelerations a, one row per variable
  fN, aN            normal force and acceleration of a contact
  fF, aF            friction force, tangential acceleration
  mu                coefficient of friction, abs(fF) <= mu fN

All numbers are fractions.Fraction and all comparisons exact: there is no tolerance. Here stand the claims that
are linear algebra. Those that speak of runs of the published algorithm are checked by check_runs.py, which is
called from here: `cycle`, and the runs of a `counterexample`.

Trusted: Python, certificate_reader.py, and this file, which was written from certify/certificates.md and shares no
code or tables with the C++.
"""

import sys
from fractions import Fraction
from itertools import product
from operator import mul
from math import prod

sys.dont_write_bytecode = True  # where it is installed, nothing is to be left behind

from certificate_reader import (ZERO, Cost, brief, contacts_of, dot, drop_pivot, elimination_operations, exact, fields,
                                integer, integer_rows, items, listed, long_times, main, need, one_of, over,
                                planar_contacts, product_operations, read_entries, require_cheap_product, rows,
                                take_pivot, vector)
from check_runs import CYCLE, ENDLESS, RAY, check_runs

# --- A and b: each check returns the facts to print ---------------------------------

def equal(found, expected, place, meaning):
    for i, (x, y) in enumerate(zip(found, expected)):
        need(x == y, f"{place}[{i}]", x, y, f" ({meaning})")


def factor_of_products(problem, witness, name, squared=False):
    """A vector of the witness, of which A x and A'x are not too dear; `squared`: nor x'Ax and x'b."""
    x = vector(witness[name], f"$.witness.{name}", len(problem.b))
    require_cheap_product(problem, x, squared)
    return x


def check_symmetric(problem, witness):
    for i, (row, column) in enumerate(zip(problem.A, zip(*problem.A))):
        if tuple(row) != column:
            equal(row, column, f"$.problem.A[{i}]", "a symmetric matrix")
    return f"{len(problem.b)} rows"


def check_not_symmetric(problem, witness):
    i, j = (integer(witness[k], f"$.witness.{k}", 0, len(problem.b)) for k in "ij")
    need(problem.A[i][j] != problem.A[j][i], "$.witness", (i, j), "A_ij to differ from A_ji")
    return f"i = {i}, j = {j}"


def factored(problem, witness):
    """D, once A is symmetric and A = L diag(D) L' with D >= 0, so x'Ax = sum of D_i (L'x)_i^2 >= 0. One column of L
    after the other is taken away, so that no number grows beyond the minors of A, whatever L and D are."""
    n = len(problem.b)
    Cost(elimination_operations(n)).all_rows(problem)
    L, D = rows(witness["L"], "$.witness.L", n), vector(witness["D"], "$.witness.D", n)
    check_symmetric(problem, {})
    for i in range(n):
        need(D[i] >= 0, f"$.witness.D[{i}]", D[i], "D >= 0")
        equal(L[i][i:], [1] + [0] * (n - i - 1), f"$.witness.L[{i}][{i}:]",
              "a lower triangle with unit diagonal")
    rest, scales = integer_rows(problem.A)
    minor = 1
    for k in range(n):
        for i, row in enumerate(rest, k):
            if row[0] or L[i][k] and D[k]:
                left = Fraction(row[0], minor * scales[i])
                need(left == L[i][k] * D[k], f"$.witness (A - L diag(D) L')[{i}][{k}]", left,
                     L[i][k] * D[k], " (the column of L, times D)")
        rest, minor = take_pivot(rest, minor) if D[k] else (drop_pivot(rest), minor)
    return D


# --- Factors of the problem (certify/certificates.md, Factors) -----------------------------

BLOCK, PAIR, VELOCITY, ENTRY = 20, 4, 15, 6  # operations of a block of M, two rows of J in it, a velocity, an entry of J


def require_few_velocities(value, n):
    """How many there are, before any number is read: a row touches each block of M, with an entry of J of its own."""
    place = "$.witness.factors"
    fields(value, place, "J", "M", "w", optional=("c",))
    fields(value["J"], place + ".J", "size", "entries")
    size = listed(value["J"]["size"], place + ".J.size", 2)
    integer(size[0], place + ".J.size[0]", n, n + 1)
    velocities = integer(size[1], place + ".J.size[1]", 0, 2**31 - 1)
    entries = len(listed(value["J"]["entries"], place + ".J.entries"))
    blocks = len(listed(value["M"], place + ".M"))
    need(blocks <= entries, place + ".M", f"{blocks} blocks", f"at most {entries}, the entries of J")
    Cost(product_operations(n) + VELOCITY * velocities + ENTRY * entries)
    return velocities


def read_factors(value, n):
    """J as {(row, velocity): number}, the blocks of M, w and c."""
    place = "$.witness.factors"
    velocities = require_few_velocities(value, n)
    J = {at: x for at, x in read_entries(value["J"]["entries"], place + ".J.entries", n, velocities).items() if x}
    M, first, touched = [], 0, {j for _, j in J}
    for at, block in items(value["M"], place + ".M"):
        M.append(rows(block, at, len(block)) if type(block) is list else [[exact(block, at)]])
        need(M[-1], at, block, "a number, or rows of numbers")
        need(M[-1] == [list(column) for column in zip(*M[-1])], at, block, "a symmetric block")
        need(not touched.isdisjoint(range(first, first + len(M[-1]))), at, block, "a block that a row of J touches")
        first += len(M[-1])
    need(sum(map(len, M)) == velocities, place + ".M", sum(map(len, M)), f"blocks of {velocities} velocities")
    w = vector(value["w"], place + ".w", velocities)
    c = vector(value["c"], place + ".c", n) if "c" in value else [ZERO] * n
    return J, M, w, c


def solved(M, columns, place):
    """inv(M) times each of the columns, M definite: all pivots of its elimination are positive."""
    system = [[*row, *right] for row, right in zip(M, zip(*columns))]
    for k in range(len(M)):
        pivot = system[k][k]
        need(pivot > 0, place, pivot, "a pivot > 0 of a definite block")
        system[k] = row = [x / pivot for x in system[k]]
        system = [other if i == k or not other[k] else [x - other[k] * y for x, y in zip(other, row)]
                  for i, other in enumerate(system)]
    return list(zip(*(row[len(M):] for row in system)))


def by_blocks(J, M):
    """Of every block of M the rows of J that have entries in it, and these."""
    block_of = [k for k, block in enumerate(M) for _ in block]
    first = [0]
    for block in M:
        first.append(first[-1] + len(block))
    touched = [{} for _ in M]
    for (i, j), x in sorted(J.items()):
        k = block_of[j]
        touched[k].setdefault(i, [ZERO] * len(M[k]))[j - first[k]] = x
    return touched


def require_cheap_factors(problem, J, M, w, c):
    """The blocks with the rows of J in them, once the work is not too dear."""
    n = len(problem.b)
    sizes, rows_of, by_row = list(map(len, M)), [set() for _ in M], [[] for _ in range(n)]
    block_of = [k for k, size in enumerate(sizes) for _ in range(size)]
    for (i, j), x in J.items():
        rows_of[block_of[j]].add(i)
        by_row[i].append(x)
    of_blocks = sum(BLOCK + 2 * s * (s + len(of))**2 + PAIR * len(of)**2 for s, of in zip(sizes, rows_of))
    cost = Cost(product_operations(n) + VELOCITY * len(w) + ENTRY * len(J) + of_blocks)
    cost.longest_row(problem).numbers(w).numbers(c)
    bits = [0] * n
    for block, of in zip(M, rows_of):
        own = sum(map(cost.bits, block))
        for i in of:
            bits[i] += own
    cost.add(2 * max(map(cost.bits, by_row), default=0)).add(max(bits, default=0))


def factors(problem, witness):
    """c, once A = J inv(M) J' and b = J w + c, every block of M symmetric and definite."""
    n = len(problem.b)
    J, M, w, c = read_factors(witness["factors"], n)
    require_cheap_factors(problem, J, M, w, c)
    A = [{} for _ in range(n)]
    for k, (block, of) in enumerate(zip(M, by_blocks(J, M))):
        answers = solved(block, list(of.values()), f"$.witness.factors.M[{k}]")
        for (i, row), answer in zip(of.items(), answers):
            for j, other in of.items():
                if j <= i:
                    A[i][j] = A[i].get(j, ZERO) + dot(other, answer)
    for i in range(n):
        for j in range(n):
            product = A[max(i, j)].get(min(i, j), ZERO)
            if product is not problem.A[i][j]:
                need(product == problem.A[i][j], f"$.problem.A[{i}][{j}]", problem.A[i][j], "J inv(M) J'")
    b = list(c)
    for (i, j), x in J.items():
        b[i] += x * w[j]
    equal(problem.b, b, "$.problem.b", "J w + c")
    return c


def in_dual_cone(problem, g, place):
    for kind, mu, normal, tangents in cones(problem):
        at, gN = f"{place}[{normal}]", g[normal]
        need(gN == 0 if kind == "bilateral" else gN >= 0, at, gN, "0" if kind == "bilateral" else "gN >= 0")
        need(gN ** 2 >= mu ** 2 * sum(g[k] ** 2 for k in tangents), at, gN, "gN >= mu abs(gF)")


def in_cone(problem, v, name):
    """The friction cones themselves."""
    for kind, mu, normal, tangents in cones(problem):
        place, vN = f"$.witness.{name}[{normal}]", v[normal]
        need(kind == "bilateral" or vN >= 0, place, vN, f"{name}N >= 0")
        need(sum(v[k] ** 2 for k in tangents) <= mu ** 2 * vN ** 2, place, vN, f"abs({name}F) <= mu {name}N")


def check_psd(problem, witness):
    if "factors" in witness:
        factors(problem, witness)
        return f"{len(problem.b)} rows, by factors"
    return f"{len(factored(problem, witness))} rows"


def check_definite(problem, witness):
    """As psd, with D > 0: x'Ax > 0 for all x but 0, L being regular."""
    for i, pivot in enumerate(factored(problem, witness)):
        need(pivot > 0, f"$.witness.D[{i}]", pivot, "D > 0")
    return f"{len(problem.b)} rows"


def stated(witness, computed, meaning):
    """The value of a witness, which must be the one that was computed."""
    value = exact(witness["value"], "$.witness.value")
    need(value == computed, "$.witness.value", value, computed, f" ({meaning})")
    return value


def check_not_psd(problem, witness):
    x = factor_of_products(problem, witness, "x", squared=True)
    value = stated(witness, dot(x, long_times(problem.A, x)), "x'Ax")
    need(value < 0, "$.witness.value", value, "a value < 0")
    return f"{len(x)} rows"


def check_not_definite(problem, witness):
    x = factor_of_products(problem, witness, "x", squared=True)
    need(any(x), "$.witness.x", witness["x"], "a vector other than 0")
    value = stated(witness, dot(x, long_times(problem.A, x)), "x'Ax")
    need(value <= 0, "$.witness.value", value, "a value <= 0")
    return f"{len(x)} rows"


def check_in_range(problem, witness):
    if "factors" in witness:
        c = factors(problem, witness)
        equal(c, [0] * len(c), "$.witness.factors.c", "zero: b = J w, in the range of J and of A")
        return f"{len(c)} rows, by factors"
    x = factor_of_products(problem, witness, "x")
    equal(long_times(problem.A, x), problem.b, "$.witness (A x)", "b")
    return f"{len(x)} rows"


def check_not_in_range(problem, witness):
    y = factor_of_products(problem, witness, "y", squared=True)
    value = stated(witness, dot(y, problem.b), "y'b")
    need(value != 0, "$.witness.value", value, "a value other than 0")
    equal(long_times(zip(*problem.A), y), [0] * len(y), "$.witness (y'A)", "y'A = 0")
    return f"{len(y)} rows"


def cones(problem):
    """(kind, mu, normal row, tangent rows) of each contact; none of them sliding."""
    for i, (kind, mu, _), span in contacts_of(problem):
        need(kind != "sliding", f"$.problem.contacts[{i}].kind", kind, "bilateral, frictionless or static")
        yield kind, mu or Fraction(0), span[0], span[1:]


def check_h(problem, witness):
    """b = A'y + g, g in the dual of the friction cones: b'v = y'Av + g'v >= 0 where A v = 0."""
    if "factors" in witness:  # g = c: A v = 0 makes J'v = 0
        in_dual_cone(problem, factors(problem, witness), "$.witness.factors.c")
        return f"{len(problem.b)} rows, by factors"
    y = factor_of_products(problem, witness, "y")
    in_dual_cone(problem, [x - z for x, z in zip(problem.b, long_times(zip(*problem.A), y))], "$.witness (b - A'y)")
    return f"{len(y)} rows"


def check_exists(problem, witness):
    """A positive semidefinite and (H): by theorem 1 of certify/existence.md a solution exists, in space one of Coulomb's
    law. No forces are given."""
    if "factors" not in witness:
        check_psd(problem, witness)
    return check_h(problem, witness)


def check_not_h(problem, witness):
    """v in the friction cones with A v = 0 and b'v < 0."""
    v = factor_of_products(problem, witness, "v", squared=True)
    value = stated(witness, dot(v, problem.b), "b'v")
    need(value < 0, "$.witness.value", value, "a value < 0")
    equal(long_times(problem.A, v), [0] * len(v), "$.witness (A v)", "A v = 0")
    in_cone(problem, v, "v")
    return f"{len(v)} rows"


# --- Solutions ---------------------------------------------------------------------

def forces(problem, witness):
    """f and a of a witness, once a = A f + b."""
    f, a = factor_of_products(problem, witness, "f"), vector(witness["a"], "$.witness.a", len(problem.b))
    equal(a, [x + y for x, y in zip(long_times(problem.A, f), problem.b)], "$.witness.a", "A f + b")
    return f, a


def weak(limit2, force2, answer2, power):
    """(16), in space (21), (22), of mu^2 fN^2, fF.fF, aF.aF and fF.aF: the direction of slip is free."""
    return force2 <= limit2 and power <= 0 and (answer2 == 0 or force2 == limit2)


def coulomb(bound):
    """Coulomb's law, the cosine between fF and -aF being >= bound where both matter."""
    def holds(limit2, force2, answer2, power):
        return force2 <= limit2 and power <= 0 and power * power >= bound * bound * limit2 * answer2
    return holds


def check_forces(problem, f, a, law):
    """Every contact by its kind, a static one by the law of friction."""
    for i, contact, span in contacts_of(problem):
        place, of = f"$.witness.f[{span[0]}]", f"of contact {i + 1}, {contact.kind}"
        (fN, *fF), (aN, *aF) = ([values[row] for row in span] for values in (f, a))
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
    return f"{len(problem.contacts)} contacts{' in space' if problem.dimension == 3 else ''}"


def check_solution(problem, witness):
    return check_forces(problem, *forces(problem, witness), weak)


def check_coulomb(problem, witness):
    need(problem.dimension == 3, "$.problem.dimension", problem.dimension, "3")
    bound = exact(witness["bound"], "$.witness.bound")
    need(0 < bound <= 1, "$.witness.bound", bound, "a bound > 0 and <= 1")
    return f"{check_forces(problem, *forces(problem, witness), coulomb(bound))}, bound {brief(bound)}"


def check_rests(problem, witness):
    """f in the friction cones with A f + b = 0."""
    f = factor_of_products(problem, witness, "f")
    equal([x + z for x, z in zip(long_times(problem.A, f), problem.b)], [0] * len(f), "$.witness (A f + b)", "A f + b = 0")
    in_cone(problem, f, "f")
    return f"{len(f)} rows"


def check_cannot_rest(problem, witness):
    """A'y in the dual of the friction cones and b'y > 0: of f in the cones with A f = -b it were 0 <= y'A f = -b'y."""
    y = factor_of_products(problem, witness, "y", squared=True)
    value = stated(witness, dot(y, problem.b), "b'y")
    need(value > 0, "$.witness.value", value, "a value > 0")
    in_dual_cone(problem, long_times(zip(*problem.A), y), "$.witness (A'y)")
    return f"{len(y)} rows"


# --- Contact modes (certify/certificates.md, Modes) ----------------------------------------

def modes_of(contact, dimension=2):
    if contact.kind == "bilateral":
        return ("hold",)
    if dimension == 2 and contact.kind == "static" and contact.mu > 0:
        return ("break", "stick", "slip+", "slip-")
    return ("break", "touch")


def with_friction(values):
    """Normal and friction entry; zero for the friction of a contact that has none."""
    return (*values, Fraction(0))[:2]


def limit(contact):
    """mu u: under `touch` a contact has fF = -mu u fN."""
    return contact.mu * contact.slip[0] if contact.kind == "sliding" else Fraction(0)


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


def never_negative_in_space(mode, contact, y, g):
    """The same in space: a contact that touches has its force in its friction cone, whichever way it slips."""
    yN, gN, gF = y[0], g[0], g[1:]
    if mode == "hold":
        return gN == 0
    if any(y[1:]):
        return False
    if mode == "break":
        return yN >= 0
    if contact.kind == "sliding":
        return gN <= contact.mu * dot(contact.slip, gF)
    return gN <= 0 and gN ** 2 >= (contact.mu or 0) ** 2 * dot(gF, gF)


def check_refutation(problem, columns, prefix, y, place):
    """y'b < 0, and y'(a - A f) >= 0 in every word that begins with the prefix; `columns`: those of A."""
    whole, below = over(y)
    yb = dot(y, problem.b)
    g = [Fraction(sum(map(mul, whole, column)), below * scale) for column, scale in columns]
    need(yb < 0, place, yb, "y'b < 0")
    holds = never_negative if problem.dimension == 2 else never_negative_in_space
    for i, contact, span in contacts_of(problem):
        for mode in prefix[i:i + 1] or modes_of(contact, problem.dimension):
            need(holds(mode, contact, [y[row] for row in span], [g[row] for row in span]),
                 place, f"a term of contact {i + 1} that can be negative",
                 f"none in mode {mode}")


def check_no_solution(problem, witness):
    choices = [modes_of(contact, problem.dimension) for contact in problem.contacts]
    operations = product_operations(len(problem.b), len(listed(witness["prefixes"], "$.witness.prefixes")))
    longest = Cost(operations).longest_row(problem).total
    following = [1]  # words for the last 0, 1, ... contacts
    for modes in reversed(choices):
        following.append(following[-1] * len(modes))
    covered, prefixes, columns = 0, {}, list(map(over, zip(*problem.A)))
    for at, entry in items(witness["prefixes"], "$.witness.prefixes"):
        fields(entry, at, "modes", "y")
        named = listed(entry["modes"], at + ".modes")
        need(len(named) <= len(choices), at + ".modes", len(named), f"<= {len(choices)} modes")
        prefix = tuple(one_of(mode, f"{at}.modes[{i}]", modes) for i, (mode, modes) in enumerate(zip(named, choices)))
        need(prefix not in prefixes, at + ".modes", prefix,
             f"no prefix twice, see {prefixes.get(prefix)}")
        prefixes[prefix] = at
        y = vector(entry["y"], at + ".y", len(problem.b))
        Cost(operations).add(longest).numbers(y, 2)
        check_refutation(problem, columns, prefix, y, at + ".y")
        covered += following[len(choices) - len(prefix)]
    begun = None  # by the order of texts each stands right behind what begins it
    for prefix in sorted(prefixes):
        need(begun is None or prefix[:len(begun)] != begun, f"{prefixes[prefix]}.modes", prefix,
             f"no prefix that begins with another, {prefixes.get(begun)}")
        begun = prefix
    need(covered == following[-1], "$.witness.prefixes", covered,
         f"{following[-1]} words covered, all of them")
    return f"{following[-1]} words, {len(prefixes)} prefixes"


# --- Coulomb's law in space, exactly: Krawczyk's test (certify/certificates.md, Within a box) -------------
#
# Polynomials of degree 2: the sorted numbers of a monomial's unknowns -> its coefficient.

def total(factors, polynomials):
    result = {}
    for factor, p in zip(factors, polynomials):
        for monomial, c in p.items() if factor else ():
            result[monomial] = result.get(monomial, 0) + factor * c
    return result


def by(p, q):
    pairs = list(product(p.items(), q.items()))
    return total([c * d for (_, c), (_, d) in pairs], [{tuple(sorted(m + k)): 1} for (m, _), (k, _) in pairs])


def taylor(p, x):
    """At x: the value, the slope in every unknown, and half of all second derivatives' absolute values."""
    value, slope, curvature = Fraction(0), {}, Fraction(0)
    for monomial, c in p.items():
        value += c * prod(x[j] for j in monomial)
        for at, j in enumerate(monomial):
            slope[j] = slope.get(j, Fraction(0)) + c * prod(x[k] for k in monomial[:at] + monomial[at + 1:])
        curvature += abs(c) * (len(monomial) == 2)
    return value, slope, curvature


def least(p, x, radius):
    """No value is smaller where no unknown is further than the radius from x."""
    value, slope, curvature = taylor(p, x)
    return value - radius * sum(map(abs, slope.values())) - radius**2 * curvature


def strict_modes(contact):
    if contact.kind == "static" and contact.mu > 0:
        return ("break", "stick", "slip")
    return ("hold",) if contact.kind == "bilateral" else ("break", "touch")


def box_operations(n, fixed, unknowns):
    """Of Krawczyk's test, n rows."""
    return product_operations(n, 2 * fixed + 4) + product_operations(max(unknowns, 0), 2 * max(unknowns, 0) + 4)


def read_fixed(problem, witness, zero):
    """Row -> (force, weights, place) of those of the rows `zero` that follow from the others; and these."""
    fixed, last = {}, -1
    for at, entry in items(witness["fixed"], "$.witness.fixed"):
        fields(entry, at, "row", "f", "weights")
        last = integer(entry["row"], at + ".row", last + 1, len(problem.b))
        need(last in zero, at + ".row", last, "a row whose acceleration is zero")
        fixed[last] = entry, at
    kept = [row for row in zero if row not in fixed]
    return kept, {row: (exact(entry["f"], at + ".f"), vector(entry["weights"], at + ".weights", len(kept)), at)
                  for row, (entry, at) in fixed.items()}


def require_dependence(problem, kept, fixed):
    """Where the rows that are kept have no acceleration, these have none, whatever the forces."""
    columns = [*zip(*problem.A), problem.b]
    for row, (_, weights, at) in fixed.items():
        for column in columns:
            need(dot(weights, [column[k] for k in kept]) == column[row], at + ".weights", column[row],
                 f"the sum by these weights, in every column of A and in b (row {row})")


def require_zero_in_box(equations, x, inverse, radius):
    """Krawczyk's test: x - Y F(x) + (I - Y F'(X))(X - x) is inside the box X, which therefore has a zero of F."""
    expanded = [taylor(p, x) for p in equations]
    values, curvatures = [value for value, _, _ in expanded], [curvature for _, _, curvature in expanded]
    columns = [over([slope.get(j, Fraction(0)) for _, slope, _ in expanded]) for j in range(len(x))]
    for i, row in enumerate(inverse):
        integers, denominator = over(row)
        defects = [Fraction(dot(integers, column), denominator * below) - (i == j)
                   for j, (column, below) in enumerate(columns)]
        image = abs(dot(row, values)) + radius * sum(map(abs, defects)) + 2 * radius**2 * dot(map(abs, row), curvatures)
        need(image < radius, f"$.witness.inverse[{i}]", image, "a distance below the radius, as Krawczyk's test asks for")


def check_coulomb_exact(problem, witness):
    need(problem.dimension == 3, "$.problem.dimension", problem.dimension, "3")
    named = items(witness["modes"], "$.witness.modes", len(problem.contacts))
    contacts = [(one_of(mode, at, strict_modes(contact)), contact, span)
                for (at, mode), (_, contact, span) in zip(named, contacts_of(problem))]
    radius = exact(witness["radius"], "$.witness.radius")
    need(radius > 0, "$.witness.radius", radius, "a number > 0")
    still = [span if mode == "stick" else span[:mode != "break"] for mode, _, span in contacts]  # a = 0, f an unknown
    n, count = len(problem.b), len(listed(witness["fixed"], "$.witness.fixed"))
    size = sum(map(len, still)) - count + 3 * sum(mode == "slip" for mode, _, _ in contacts)
    cost = Cost(box_operations(n, count, size))
    kept, fixed = read_fixed(problem, witness, [row for span in still for row in span])
    x, inverse = vector(witness["x"], "$.witness.x", size), rows(witness["inverse"], "$.witness.inverse", size)
    cost.longest_row(problem).numbers([*x, radius, *(f for f, _, _ in fixed.values())], 2)
    cost.numbers([part for contact in problem.contacts for part in (contact.mu or Fraction(0), *contact.slip)], 2)
    cost.numbers([y for row in inverse for y in row]).numbers([w for _, weights, _ in fixed.values() for w in weights])
    require_dependence(problem, kept, fixed)

    unknowns = ({(k,): Fraction(1)} for k in range(size))
    f, slips = [{} for _ in range(n)], {}
    for i, (mode, contact, span) in enumerate(contacts):
        for row in still[i]:
            f[row] = {(): fixed[row][0]} if row in fixed else next(unknowns)
        direction = []
        if mode == "slip":
            *direction, speed = slips[i] = [next(unknowns) for _ in range(3)]
        if mode == "touch" and contact.kind == "sliding":
            direction = [{(): part} for part in contact.slip]
        for row, part in zip(span[1:], direction):
            f[row] = total([-contact.mu], [by(part, f[span[0]])])
    a = [total([*row, right], [*f, {(): Fraction(1)}]) for row, right in zip(problem.A, problem.b)]

    equations, positive = [], []
    for i, (mode, contact, span) in enumerate(contacts):
        equations += [a[row] for row in still[i] if row in kept]
        if mode == "slip":
            c, s, v = slips[i]
            equations += [total([1, 1, -1], [by(c, c), by(s, s), {(): Fraction(1)}])]
            equations += [total([1, -1], [a[row], by(v, part)]) for row, part in zip(span[1:], (c, s))]
            positive.append((i, "the speed of slip", v))
        if mode == "stick":
            friction = [by(f[row], f[row]) for row in span]
            positive.append((i, "mu^2 fN^2 - fF.fF", total([contact.mu**2, -1, -1], friction)))
        if mode != "hold":
            positive.append((i, "aN" if mode == "break" else "fN", (a if mode == "break" else f)[span[0]]))
    require_zero_in_box(equations, x, inverse, radius)
    for i, what, p in positive:
        bound = least(p, x, radius)
        need(bound > 0, f"$.witness.modes[{i}]", bound, f"> 0 in the whole box: {what} of contact {i + 1}")
    return f"{len(contacts)} contacts in space, {size} unknowns, radius {brief(radius)}"


# --- Safe and unsafe: determinants of the reduced matrix (certify/certificates.md) -----------

def determinant(M):
    """By an elimination of the rows M."""
    rest, scales = integer_rows(M)
    minor, sign = 1, 1
    while rest:
        p = next((i for i, row in enumerate(rest) if row[0]), None)
        if p is None:
            return ZERO
        if p:
            rest[0], rest[p], sign = rest[p], rest[0], -sign
        rest, minor = take_pivot(rest, minor)
    return Fraction(sign * minor, prod(scales))


def reduced(problem, word, by_column):
    """The rows of the reduced matrix of a word; `by_column`: the columns of A."""
    kept, columns = [], []
    for mode, (_, contact, span) in zip(word, planar_contacts(problem)):
        if mode == "break":
            continue
        kept += span if mode == "stick" else span[:1]
        if mode in ("touch", "stick"):
            columns += [by_column[row] for row in kept[len(columns):]]
        else:
            along = -contact.mu if mode == "slip+" else contact.mu
            columns.append([x + along * y if y else x for x, y in zip(*(by_column[row] for row in span))])
    return [[column[row] for column in columns] for row in kept]


def reduced_determinant(problem, word, by_column, stated, place):
    """det R(word), which must be the number that is stated."""
    value = determinant(reduced(problem, word, by_column))
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


def word_operations(n, times):
    """Of reduced determinants, which have half of the rows on average."""
    return times * (n**3 + 40 * n**2 + 500 * n + 1000) // 300


def check_safe(problem, witness):
    count, choices = words_of(problem)
    smallest = Fraction(1)  # that of the word in which every contact breaks
    stated = items(witness["determinants"], "$.witness.determinants", count)
    Cost(word_operations(len(problem.b), count)).all_rows(problem)
    by_column = list(zip(*problem.A))
    for word, (at, value) in zip(product(*choices), stated):
        value = reduced_determinant(problem, word, by_column, value, at)
        need(value > 0, at, value, "a determinant > 0")
        smallest = min(smallest, value)
    return f"{count} words, smallest determinant {brief(smallest)}"


def is_semidefinite(M):
    """By elimination down the diagonal: pivots >= 0, and where one is zero its column, too."""
    rest, minor = integer_rows(M)[0], 1
    while rest:
        if rest[0][0] < 0 or (rest[0][0] == 0 and any(row[0] for row in rest)):
            return False
        rest, minor = take_pivot(rest, minor) if rest[0][0] else (drop_pivot(rest), minor)
    return True


def check_safe_by_condition(problem, witness):
    """Eigenvalues of DAD in [l, u], and m^2 (u - l)^2 < 4 u l, m = max mu d_N / d_F (condition_number.md)."""
    words_of(problem)  # static and frictionless contacts only
    check_symmetric(problem, {})
    n = len(problem.b)
    Cost(elimination_operations(n, 2))
    d = vector(witness["scaling"], "$.witness.scaling", n)
    for i in range(n):
        need(d[i] > 0, f"$.witness.scaling[{i}]", d[i], "a number > 0")
    least, most = exact(witness["least"], "$.witness.least"), exact(witness["most"], "$.witness.most")
    need(least > 0, "$.witness.least", least, "a number > 0")
    Cost(elimination_operations(n, 2)).all_rows(problem).numbers(d, 2 * n).numbers([least, most], n)
    B = [[d[i] * problem.A[i][j] * d[j] for j in range(n)] for i in range(n)]
    below = [[B[i][j] - least * (i == j) for j in range(n)] for i in range(n)]
    above = [[most * (i == j) - B[i][j] for j in range(n)] for i in range(n)]
    need(is_semidefinite(below), "$.witness.least", least, "no more than the least eigenvalue of DAD")
    need(is_semidefinite(above), "$.witness.most", most, "no less than the largest eigenvalue of DAD")
    friction = max((contact.mu * d[span[0]] / d[span[1]]
                    for _, contact, span in planar_contacts(problem) if contact.kind == "static"), default=Fraction(0))
    need(friction ** 2 * (most - least) ** 2 < 4 * most * least, "$.witness", friction,
         "a largest mu d_N / d_F with m^2 (u - l)^2 < 4 u l")
    return f"condition {brief(most / least)}, friction {brief(friction)}"


def check_unsafe(problem, witness):
    choices = words_of(problem)[1]
    named = items(witness["word"], "$.witness.word", len(choices))
    word = [one_of(mode, at, modes) for (at, mode), modes in zip(named, choices)]
    Cost(elimination_operations(len(problem.b))).all_rows(problem)
    value = reduced_determinant(problem, word, list(zip(*problem.A)), witness["determinant"], "$.witness.determinant")
    need(value <= 0, "$.witness.determinant", value, "a determinant <= 0")
    return f"{' '.join(word)}, determinant {brief(value)}"


# --- The program -------------------------------------------------------------------

def check_counterexample(problem, witness):
    """A definite, a solution; and runs of the published algorithm that never come to it."""
    check_definite(problem, witness)
    check_solution(problem, witness)
    return f"A definite, a solution missed, {check_runs(problem, witness)}"


CLAIMS = {  # the keys of the witness, and what checks it
    "solution-exists": ("f a", check_solution),
    "coulomb-solution": ("f a bound", check_coulomb),
    "coulomb-exact": ("modes fixed x inverse radius", check_coulomb_exact),
    "rests": ("f", check_rests),
    "cannot-rest": ("y value", check_cannot_rest),
    "no-solution": ("prefixes", check_no_solution),
    "symmetric": ("", check_symmetric),
    "not-symmetric": ("i j", check_not_symmetric),
    "psd": ("L D | factors", check_psd),
    "not-psd": ("x value", check_not_psd),
    "definite": ("L D", check_definite),
    "not-definite": ("x value", check_not_definite),
    "in-range": ("x | factors", check_in_range),
    "not-in-range": ("y value", check_not_in_range),
    "h": ("y | factors", check_h),
    "not-h": ("v value", check_not_h),
    "exists": ("L D y | factors", check_exists),
    "safe": ("determinants", check_safe),
    "safe-by-condition": ("scaling least most", check_safe_by_condition),
    "unsafe": ("word determinant", check_unsafe),
    "cycle": CYCLE,
    "ray": RAY,
    "endless": ENDLESS,
    "counterexample": ("L D f a runs", check_counterexample),
}

if __name__ == "__main__":
    sys.exit(main(CLAIMS, "Check stiction certificates in exact rational arithmetic, one line for each.",
                  f"claims: {', '.join(CLAIMS)};\ncertify/certificates.md says what they mean.\n"))
