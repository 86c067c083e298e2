#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What forces miss of the law of each contact, from the file that was given and the answer of `stiction solve --json`.

    stiction solve FILE --json > answer.json
    python3 certify/residuals.py FILE answer.json

FILE: a problem in JSON, a Siconos friction problem or LCP (.dat), or an FCLIB problem (.hdf5, by h5py of Debian's
python3-h5py). Prints the largest error, its contact (from 1), and the residual that the answer itself names; exit 1
where the one found here is more than twice that, and 1e-12 more.

a = A f + b in doubles, each sum rounded once (math.fsum). A contact's error is that of its nearest mode (separates,
sticks, slips), each condition in the contact's units; the law is Coulomb's:

    unit of a_i   abs(b_i) + min(sum_j abs(A_ij) max(abs(f_j), abs(b_j) / A_jj), sqrt(A_ii W))
    unit of f_i   that of a_i / A_ii
    W             min(abs(f'Af), abs(power of sliding friction - b'f)), over the contacts that A couples to i

Trusted: Python and this file, which was written from what solver/problem/units.h and errors.h say, and shares no code
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
        contacts = [Contact(one["kind"], number(one.get("mu", 0)), [number(x) for x in as_list(one.get("slip", []))])
                    for one in data["contacts"]]
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
    """Forces in newtons, and the residual that the answer names."""
    try:
        with open(path, encoding="utf-8") as file:
            answer = json.load(file)
        f = [number(x) for x in answer["f"]]
        said = float(answer.get("residual", 0.0))
    except OSError as error:
        sys.exit(f"residuals: {path}: found nothing to read ({error.strerror}), expected what solve --json prints")
    except (ValueError, KeyError, TypeError, AttributeError):
        sys.exit(f"residuals: {path}: found no list f of forces, expected what solve --json prints of a solution")
    if len(f) != rows:
        sys.exit(f"residuals: {path}: found {len(f)} forces, expected {rows}, one for each row of the problem")
    return f, said


# ---- Errors --------------------------------------------------------------------------------------------------


def groups(problem):
    """For each row the least contact that A couples to its own, through others too."""
    parent = list(range(len(problem.contacts)))
    of_row = [k for k, contact in enumerate(problem.contacts) for _ in range(problem.rows_of(contact))]

    def root(k):
        while parent[k] != k:
            parent[k] = parent[parent[k]]
            k = parent[k]
        return k

    for i, row in enumerate(problem.A):
        for j in row:
            one, other = root(of_row[i]), root(of_row[j])
            parent[max(one, other)] = min(one, other)
    return [root(k) for k in of_row]


def units(problem, f, a):
    group, b = groups(problem), problem.b
    own = [abs(row.get(i, 0.0)) for i, row in enumerate(problem.A)]
    counted = [max(abs(f[i]), abs(b[i]) / own[i] if own[i] > 0 else 0.0) for i in range(len(b))]
    works = {}
    for i in range(len(b)):
        parts = works.setdefault(group[i], ([], [], []))
        parts[0].append(f[i] * (a[i] - b[i]))
        parts[1].append(b[i] * f[i])
    for k, contact in enumerate(problem.contacts):
        if contact.kind == "sliding":
            row = problem.first[k]
            works[group[row]][2].extend(f[row + 1 + t] * a[row + 1 + t] for t in range(problem.dimension - 1))
    least = {key: min(abs(math.fsum(done)), abs(math.fsum(sliding) - math.fsum(free)))
             for key, (done, free, sliding) in works.items()}
    of_a = []
    for i, row in enumerate(problem.A):
        total = math.fsum(abs(x) * counted[j] for j, x in row.items())
        of_a.append(abs(b[i]) + min(total, math.sqrt(own[i] * least[group[i]])))
    return of_a, [of_a[i] / own[i] if own[i] > 0 else 0.0 for i in range(len(b))]


def over(value, unit):
    return 0.0 if value == 0 else value / unit if unit > 0 else NONE


def slipping(limit, fF, aF, unit_f, unit_a):
    """What friction that slips misses: of the force alone, or, where slip is slow, of both moved."""
    speed = math.hypot(*aF)
    ways = []
    if speed > 0:
        ways.append(over(math.dist(fF, [-limit * x / speed for x in aF]), unit_f))
    if unit_a > 0:
        ratio = unit_f / unit_a
        target = [x - ratio * y for x, y in zip(fF, aF)]
        length = math.hypot(*target)
        if length > limit:
            target = [x * limit / length for x in target]
        ways.append(over(math.dist(fF, target), unit_f))
    return min(ways, default=NONE)


def error_of(problem, k, f, a, of_a, of_f):
    contact, row = problem.contacts[k], problem.first[k]
    rest = range(row + 1, row + problem.rows_of(contact))
    fN, aN, ua, uf = f[row], a[row], of_a[row], of_f[row]
    if contact.kind == "bilateral":
        return over(abs(aN), ua)
    opened = max(over(max(0.0, -aN), ua), over(abs(fN), uf))
    closed = max(over(abs(aN), ua), over(max(0.0, -fN), uf))
    if contact.kind == "frictionless":
        return min(opened, closed)
    fF, aF = [f[i] for i in rest], [a[i] for i in rest]
    unit_a, unit_f = max(of_a[i] for i in rest), max(of_f[i] for i in rest)
    unit = max(unit_f, contact.mu * uf)
    if contact.kind == "sliding":
        missed = over(math.dist(fF, [-s * contact.mu * fN for s in contact.slip]), unit)
        return min(max(opened, missed), max(closed, missed))
    limit = contact.mu * max(0.0, fN)
    opened = max(opened, over(math.hypot(*fF), unit_f))
    sticks = max(closed, over(math.hypot(*aF), unit_a), over(max(0.0, math.hypot(*fF) - limit), unit))
    return min(opened, sticks, max(closed, slipping(limit, fF, aF, unit, unit_a)))


def largest(problem, f):
    """The largest error, and its contact, from 1."""
    a = [math.fsum([*(x * f[j] for j, x in row.items()), problem.b[i]]) for i, row in enumerate(problem.A)]
    of_a, of_f = units(problem, f, a)
    errors = [error_of(problem, k, f, a, of_a, of_f) for k in range(len(problem.contacts))]
    worst = max(range(len(errors)), key=errors.__getitem__, default=None)
    return (errors[worst], worst + 1) if errors else (0.0, None)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    problem = read(sys.argv[1])
    f, said = forces_of(sys.argv[2], len(problem.b))
    error, contact = largest(problem, f)
    print(f"error {error:.3g} at contact {contact}; the answer says {said:.3g}")
    return 1 if error > 2 * said and error - said >= 1e-12 else 0


if __name__ == "__main__":
    sys.exit(main())
