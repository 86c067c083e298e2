#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What forces miss of the law of each contact, from the file that was given and the answer of `stiction solve --json`.

    stiction solve FILE --json > answer.json
    python3 certify/residuals.py FILE answer.json

FILE: a problem in JSON, a Siconos friction problem or LCP (.dat), or an FCLIB problem (.hdf5, by h5py of Debian's
python3-h5py). Prints the largest error, its contact (from 1), and the residual that the answer itself names; exit 1
where the one found here is more than twice that, and 1e-12 more.

a = A f + b over fractions. With S_i = sum_j abs(A_ij f_j), eps = 1e-8 (1e-5 of an answer over float), tau = 8 roundings of
its numbers and theta = tau / eps, a row is held to

    s_N = abs(b_N) + theta S_N,   s_F = abs(b_F) + theta S_F    (abs(b_F): of the tangents of a contact together)

and a contact to the nearest of its modes, the law being Coulomb's: separates (f = 0, aN >= 0), sticks (a = 0, abs(fF) <=
mu fN), slips (aN = 0, abs(fF) = mu fN, aF against fF). Lengths of friction are measured in mu fN. What forces that should
be zero do to a row is added to what it misses.

Trusted: Python and this file, which was written from what solver/problem/errors.h says, and shares no code
with the C++. It judges; it proves nothing: check_certificate.py does."""

import json
import math
import sys
from decimal import Decimal, localcontext
from fractions import Fraction

NONE = math.inf


class Contact:
    def __init__(self, kind, mu=0.0, slip=()):
        self.kind, self.mu, self.slip = kind, mu, slip


class Problem:
    """A by rows, {column: number}; b; contacts with their first rows."""

    def __init__(self, dimension, contacts, b):
        self.dimension, self.contacts, self.b = dimension, contacts, b
        self.A = [{} for _ in b]
        self.first, row = [], 0
        for contact in contacts:
            self.first.append(row)
            row += self.rows_of(contact)
        if row != len(b):
            sys.exit(f"residuals: the contacts have {row} rows, b has {len(b)}")

    def rows_of(self, contact):
        return self.dimension if contact.kind in ("static", "sliding") else 1

    def add(self, i, j, value):
        if value != 0:
            self.A[i][j] = self.A[i].get(j, 0.0) + value


# ---- Files ---------------------------------------------------------------------------------------------------


def number(value):
    """Of JSON, or text of an integer, a decimal or a fraction: its double."""
    return float(Fraction(value)) if isinstance(value, str) else float(value)


def of_json(data):
    data = data.get("problem", data)
    A, b = of_factors(data["factors"]) if "factors" in data else (data["A"], [number(x) for x in data["b"]])
    if "contacts" in data:
        contacts = contacts_of(data)
    else:
        mu = data["mu"]
        count = len(mu) if isinstance(mu, list) else None
        dimension = data.get("dimension") or (len(b) // count if count else 2 if len(b) % 2 == 0 else 3)
        count = count or len(b) // dimension
        contacts = [Contact("static", number(x)) for x in (mu if isinstance(mu, list) else [mu] * count)]
    with_friction = sum(one.kind in ("static", "sliding") for one in contacts)
    rows = len(b) - (len(contacts) - with_friction)
    dimension = data.get("dimension") or (rows // with_friction if with_friction else 2)
    problem = Problem(dimension, contacts, b)
    if isinstance(A, dict):
        listed = {(i, j): number(x) for i, j, x in A["entries"]}
        for (i, j), x in listed.items():
            problem.add(i, j, x)
            if i > j and (j, i) not in listed:
                problem.add(j, i, x)
    else:
        for i, row in enumerate(A):
            for j, x in enumerate(row):
                problem.add(i, j, number(x))
    return problem


def contacts_of(data):
    return [Contact(one["kind"], number(one.get("mu", 0)), [number(x) for x in as_list(one.get("slip", []))])
            for one in data["contacts"]]


def of_factors(factors):
    """A = J inv(M) J' in entries, b = J w + c, rounded once: they are exact until then."""
    J, M = factors["J"], []
    if isinstance(J, dict):
        rows = [{} for _ in range(J["size"][0])]
        for i, j, x in J["entries"]:
            rows[i][j] = Fraction(x)
    else:
        rows = [{j: Fraction(x) for j, x in enumerate(row) if Fraction(x) != 0} for row in J]
    w, c = [Fraction(x) for x in factors["w"]], factors.get("c")
    b = [sum(x * w[j] for j, x in row.items()) + Fraction(c[i] if c else 0) for i, row in enumerate(rows)]
    entries, column = {}, 0
    for block in factors["M"]:
        block = [[Fraction(x) for x in row] for row in block] if isinstance(block, list) else [[Fraction(block)]]
        size = len(block)
        touching = [i for i, row in enumerate(rows) if any(column + k in row for k in range(size))]
        parts = [[rows[i].get(column + k, Fraction(0)) for k in range(size)] for i in touching]
        moved = [solved(block, part) for part in parts]
        for i, part in zip(touching, parts):
            for j, other in zip(touching, moved):
                entries[i, j] = entries.get((i, j), 0) + sum(x * y for x, y in zip(part, other))
        column += size
    return {"entries": [(i, j, float(x)) for (i, j), x in entries.items()]}, [float(x) for x in b]


def solved(block, right):
    """inv(block) right, by elimination; the block is positive definite."""
    rows = [[*row, x] for row, x in zip(block, right)]
    for k, pivot in enumerate(rows):
        for row in rows:
            if row is not pivot and row[k] != 0:
                factor = row[k] / pivot[k]
                row[:] = [x - factor * y for x, y in zip(row, pivot)]
    return [row[-1] / row[k] for k, row in enumerate(rows)]


def as_list(value):
    return value if isinstance(value, list) else [value]


def of_siconos(text):
    words = text.replace(",", " ").split()
    sizes = [int(word) for word in words[:5]]
    friction = sizes[0] in (2, 3) and sizes[3] == sizes[4] == sizes[0] * sizes[1]  # an LCP: n, storage, n, n
    dimension, count = sizes[:2] if friction else (2, sizes[0])
    words = iter(words[2 if friction else 1:])

    def some(kind=int):
        return kind(next(words))

    storage, rows, columns = some(), some(), some()
    entries = []
    if storage == 0:
        some(), some()
        entries = [(k % rows, k // rows, some(float)) for k in range(rows * columns)]
    elif storage == 1:
        _, tall, wide = some(), some(), some()
        down, across = ([0] + [some() for _ in range(n)] for n in (tall, wide))
        pointers, blocks = some(), some()
        start = [some() for _ in range(pointers)]
        at = [some() for _ in range(blocks)]
        for row in range(pointers - 1):
            for block in range(start[row], start[row + 1]):
                some()
                height, width = down[row + 1] - down[row], across[at[block] + 1] - across[at[block]]
                entries += [(down[row] + k % height, across[at[block]] + k // height, some(float))
                            for k in range(height * width)]
    else:
        by_columns = some() == 2
        for word in words:  # ... nnz: N, and in columns 1-norm: X
            if word == "nnz:":
                left = some()
                break
        if by_columns:
            some(str), some(str)
        column = 0
        while len(entries) < left:
            word = some(str)
            if word == "col":  # J : locations FIRST to LAST
                column = some()
                for _ in range(5):
                    some(str)
            else:  # I : X, or I J : X
                j = column if by_columns else some()
                some(str)
                entries.append((int(word), j, some(float)))
    b = [some(float) for _ in range(rows)]
    mu = [some(float) for _ in range(count)] if friction else []
    problem = Problem(dimension, [Contact("static", x) for x in mu] if friction else
                      [Contact("frictionless") for _ in range(count)], b)
    for i, j, x in entries:
        problem.add(i, j, x)
    return problem


def of_fclib(path):
    try:
        import h5py
    except ImportError:
        sys.exit("residuals: HDF5 files are read with h5py: install Debian's python3-h5py")
    with h5py.File(path) as file:
        kind = next((name for name in ("fclib_local", "fclib_global") if name in file), None)
        if kind is None:
            sys.exit("residuals: of FCLIB's problems the local and the global ones are read")
        group = file[kind]
        dimension = int(group["spacedim"][0])
        W, b, equations = (of_local if kind == "fclib_local" else of_global)(group)
        contacts = [Contact("static", float(x)) for x in group["vectors/mu"][()]]
    problem = Problem(dimension, contacts + [Contact("bilateral") for _ in range(equations)], b)
    for i, j, x in W:
        problem.add(i, j, x)
    return problem


def vector(group, name, length=None):
    """Its numbers; without a length none where it is not there."""
    numbers = [float(x) for x in group["vectors"][name][()]] if length is not None or name in group["vectors"] else []
    if length is not None and len(numbers) != length:
        raise ValueError(f"{len(numbers)} numbers in vectors/{name}, for {length} rows")
    return numbers


def of_local(group):
    """Entries of A, b, and how many equations stand behind the contacts."""
    W, rows, _ = triplets(group["W"])
    b, s = vector(group, "q", rows), []
    if "R" in group:
        R, equations, _ = triplets(group["R"])
        s = vector(group, "s", equations) if equations else []
        W += [(rows + i, rows + j, x) for i, j, x in R]
        W += [one for i, j, x in triplets(group["V"])[0] for one in ((i, rows + j, x), (rows + j, i, x))]
    return W, b + s, len(s)


def of_global(group):
    """The same of M v = H r + G l + f, (u, 0) = H'v + (w, 0) and G'v + b: v is eliminated from

        [M  -H  -G  -f]
        [H'  0   0   w]
        [G'  0   0   b]

    over numbers of 60 digits, which are rounded once A is there."""
    M, velocities, _ = triplets(group["M"])
    H, _, rows = triplets(group["H"])
    G, _, equations = triplets(group["G"]) if "G" in group else ([], 0, 0)
    B = H + [(i, rows + j, x) for i, j, x in G]
    right = vector(group, "w", rows) + (vector(group, "b", equations) if equations else [])
    last = velocities + rows + equations
    entries = M + [(i, velocities + j, -x) for i, j, x in B] + [(velocities + j, i, x) for i, j, x in B]
    entries += [(i, last, -x) for i, x in enumerate(vector(group, "f", velocities))]
    entries += [(velocities + i, last, x) for i, x in enumerate(right)]
    with localcontext() as context:
        context.prec = 60
        table = [{} for _ in range(last)]
        for i, j, x in entries:
            table[i][j] = table[i].get(j, 0) + Decimal(x)
        eliminate(table, velocities)
    rest = [row for row in table[velocities:]]
    A = [(i, j - velocities, float(x)) for i, row in enumerate(rest) for j, x in row.items() if velocities <= j < last]
    return A, [float(row.get(last, 0)) for row in rest], equations


def eliminate(table, count):
    """The first `count` columns from all rows below, by the pivots of the diagonal."""
    below = [set() for _ in range(count)]  # rows that have an entry in the column
    for i, row in enumerate(table):
        for j in row:
            if j < min(i, count):
                below[j].add(i)
    for k in range(count):
        pivot = table[k]
        if not pivot.get(k):
            raise ValueError(f"a zero pivot in row {k} of M")
        for i in below[k]:
            factor = table[i].pop(k) / pivot[k]
            for j, x in pivot.items():
                if j > k:
                    table[i][j] = table[i].get(j, 0) - factor * x
                    if j < min(i, count):
                        below[j].add(i)


def triplets(matrix):
    """(row, column, number) of CSparse's three storages, and how many rows and columns. Rows of triplets stand in i, or
    where they do not fit there, in p."""
    m, n, nz = (int(matrix[name][0]) for name in ("m", "n", "nz"))
    p, i, x = (matrix[name][()].tolist() for name in ("p", "i", "x"))
    if nz >= 0:
        if any(k >= m for k in i[:nz]) or any(k >= n for k in p[:nz]):
            i, p = p, i
        return list(zip(i, p, x))[:nz], m, n
    lines = [(line, k) for line in range(n if nz == -1 else m) for k in range(p[line], p[line + 1])]
    return [(i[k], line, x[k]) if nz == -1 else (line, i[k], x[k]) for line, k in lines], m, n


def read(path):
    try:
        with open(path, "rb") as file:
            data = file.read()
        if data.startswith(b"\x89HDF"):
            return of_fclib(path)
        text = data.decode()
        return of_json(json.loads(text)) if text.lstrip().startswith("{") else of_siconos(text)
    except OSError as error:
        sys.exit(f"residuals: {path}: found nothing to read ({error.strerror}), expected a problem")
    except (ValueError, KeyError, IndexError, TypeError, ZeroDivisionError, StopIteration) as error:
        sys.exit(f"residuals: {path}: found no problem that can be read ({type(error).__name__}: {error}), expected "
                 "one in JSON, a Siconos friction problem or LCP, or an FCLIB file; `stiction import` says what is "
                 "wrong, and where")


def forces_of(path, rows):
    """Forces in newtons, the residual that the answer names, and theta of its numbers."""
    try:
        with open(path, encoding="utf-8") as file:
            answer = json.load(file)
        f = [number(x) for x in answer["f"]]
        said = float(answer.get("residual", 0.0))
        narrow = answer.get("arithmetic") == "float"
    except OSError as error:
        sys.exit(f"residuals: {path}: found nothing to read ({error.strerror}), expected what solve --json prints")
    except (ValueError, KeyError, TypeError, AttributeError):
        sys.exit(f"residuals: {path}: found no list f of forces, expected what solve --json prints of a solution")
    if len(f) != rows:
        sys.exit(f"residuals: {path}: found {len(f)} forces, expected {rows}, one for each row of the problem")
    return f, said, 8 * 2.0**-24 / 1e-5 if narrow else 8 * 2.0**-53 / 1e-8


# ---- Errors --------------------------------------------------------------------------------------------------


def over(value, unit):
    return 0.0 if value == 0 else value / unit if unit > 0 else NONE


class Judge:
    """One set of forces: a, s by rows. `a`: where it is known better than A is, to some noise."""

    def __init__(self, problem, f, theta, a=None, noise=0.0):
        self.problem, self.f, self.theta, self.a, self.noise = problem, f, theta, a, noise
        if a is None:
            exact = [Fraction(x) for x in f]
            self.a = [float(sum((Fraction(x) * exact[j] for j, x in row.items() if f[j]), Fraction(b)))
                      for row, b in zip(problem.A, problem.b)]
        self.s, self.columns = [], [[] for _ in f]
        for i, row in enumerate(problem.A):
            self.s.append(theta * math.fsum(abs(x * f[j]) for j, x in row.items()))
            for j, x in row.items():
                self.columns[j].append((i, abs(x)))
        for k, contact in enumerate(problem.contacts):
            first = problem.first[k]
            self.s[first] += abs(problem.b[first])
            tangents = range(first + 1, first + problem.rows_of(contact))
            for i in tangents:
                self.s[i] += math.hypot(*[problem.b[t] for t in tangents])

    def beyond(self, x):
        return max(0.0, abs(x) - self.noise)

    def noticed(self, j):
        """What force j does to the row that notices it most."""
        return max((over(x * abs(self.f[j]), self.s[i]) for i, x in self.columns[j]), default=0.0) if self.f[j] else 0.0

    def contact(self, k):
        """Its error, rows that should be at rest with what they miss, and forces that should be zero."""
        problem, f, a, s = self.problem, self.f, self.a, self.s
        kind, row = problem.contacts[k], problem.first[k]
        rest = range(row + 1, row + problem.rows_of(kind))
        if kind.kind == "bilateral":
            return over(self.beyond(a[row]), s[row]), {row: self.beyond(a[row])}, []
        ghosts = [j for j in (row, *rest) if f[j]]
        sinks = self.beyond(min(0.0, a[row]))
        opened = max([over(sinks, s[row])] + [self.noticed(j) for j in ghosts])
        pulls = self.noticed(row) if f[row] < 0 else 0.0
        missed = {row: self.beyond(a[row])}
        closed, of_friction = max(over(missed[row], s[row]), pulls), 0.0
        if kind.kind in ("static", "sliding"):
            of_friction, of_rows = self.friction(kind, row, rest)
            missed |= of_rows
            closed = max([closed, of_friction] + [over(x, s[i]) for i, x in of_rows.items()])
        if opened < closed:
            return 0.0, {row: sinks}, ghosts
        return of_friction, missed, [row] if f[row] < 0 else []

    def friction(self, kind, row, rest):
        """The error of its length, and what the tangential rows miss; of the nearer of sticking and slipping."""
        f, a, s = self.f, self.a, self.s
        limit = kind.mu * max(0.0, f[row])
        fF, aF, unit = [f[i] for i in rest], [a[i] for i in rest], [s[i] for i in rest]
        if kind.kind == "sliding":
            return over(math.hypot(*[x + y * limit for x, y in zip(fF, kind.slip)]), limit), {}
        force = math.hypot(*fF)
        if limit == 0:
            return NONE if force else 0.0, {}
        sticks = over(max(0.0, force - limit), limit), dict(zip(rest, map(self.beyond, aF)))

        def against(t):  # aF = -t fF
            return [self.beyond(x + t * y) for x, y in zip(aF, fF)]

        tried = [0.0]
        lines = [(x / u, y / u) for x, y, u in zip(aF, fF, unit) if u > 0 and y]
        tried += [-p / q for p, q in lines]
        if len(lines) == 2:
            (p, q), (x, y) = lines
            tried += [(x - p) / (q - y)] if q != y else []
            tried += [-(x + p) / (q + y)] if q != -y else []
        t = min((t for t in tried if t >= 0), key=lambda t: max(map(over, against(t), unit)))
        slips = over(abs(force - limit), limit), dict(zip(rest, against(t)))
        return min(sticks, slips, key=lambda way: max([way[0]] + [over(x, s[i]) for i, x in way[1].items()]))

    def largest(self):
        """The largest error, and its contact, from 1."""
        found = [self.contact(k) for k in range(len(self.problem.contacts))]
        noise = [0.0] * len(self.f)
        for _, _, ghosts in found:
            for j in ghosts:
                for i, x in self.columns[j]:
                    noise[i] += x * abs(self.f[j])
        errors = []
        for k, (of_friction, missed, _) in enumerate(found):
            first = self.problem.first[k]
            rows = range(first, first + self.problem.rows_of(self.problem.contacts[k]))
            errors.append(max([of_friction] + [over(max(noise[i], missed.get(i, 0.0) + noise[i]),
                                                    max(0.0, self.s[i] - self.theta * noise[i])) for i in rows]))
        errors = [min(x, 1 / self.theta) for x in errors]
        worst = max(range(len(errors)), key=errors.__getitem__, default=None)
        return (errors[worst], worst + 1) if errors else (0.0, None)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    problem = read(sys.argv[1])
    f, said, theta = forces_of(sys.argv[2], len(problem.b))
    error, contact = Judge(problem, f, theta).largest()
    print(f"error {error:.3g} at contact {contact}; the answer says {said:.3g}")
    return 1 if error > 2 * said and error - said >= 1e-12 else 0


if __name__ == "__main__":
    sys.exit(main())
