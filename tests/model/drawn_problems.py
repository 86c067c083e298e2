# SPDX-License-Identifier: Apache-2.0
"""Problems of many sorts, drawn, changed and made smaller: see attack.py."""

import itertools
import json
from fractions import Fraction

from judged_forces import row_count

def gram(J, W):
    return [[sum(x * y * w for x, y, w in zip(r, s, W) if x and y) for s in J] for r in J]


def times(A, x):
    return [sum(p * q for p, q in zip(row, x)) for row in A]


def is_double(x):
    """Within what doubles hold, and far from its ends."""
    return x == 0 or 1e-300 < abs(x) < 1e300


class Draw:
    """Problems of many sorts; all from one source of randomness."""

    def __init__(self, source, own):
        self.R, self.own = source, own  # own(): a problem of the program's generators, or None
        self.sorts = [self.plain, self.plain, self.jam, self.jam_and_third, self.shadow, self.ghosts, self.stack,
                      self.near_singular, self.unsymmetric, self.edge, self.edge, self.factored, self.edge, self.own]

    def __call__(self):
        R = self.R
        dimension = R.choice([2, 3])
        made = self.island(dimension) if R.random() < .03 else None
        while made is None:
            sort = R.choice(self.sorts)
            made = sort() if sort is self.own else sort(dimension)
        if R.random() < .25 and "factors" not in made:
            self.scale(made, R.choice([4, 20, 100, 200]))
        if R.random() < .2:
            for contact in made["contacts"]:
                if "mu" in contact and R.random() < .6:
                    contact["mu"] = 10.0 ** R.randint(3, 12)
        return made

    def power(self, most):
        return 2.0 ** self.R.randint(-most, most)

    def kind(self, dimension, mixed=True):
        R = self.R
        kind = R.choice(["static"] * 5 + ["sliding", "frictionless", "bilateral"]) if mixed else "static"
        contact = {"kind": kind}
        if kind in ("static", "sliding"):
            contact["mu"] = R.choice([0, .125, .25, .3, .5, .5, .8, 1, 1, 2, 5])
        if kind == "sliding":
            contact["slip"] = R.choice(["1", "-1"]) if dimension == 2 else R.choice(
                [["1", "0"], ["0", "-1"], ["3/5", "4/5"], ["-5/13", "12/13"]])
        return contact

    def parts(self, dimension, n=None, mixed=None, tall=None):
        """Contacts, and rows J of small integers."""
        R = self.R
        mixed = R.random() < .4 if mixed is None else mixed
        contacts = [self.kind(dimension, mixed) for _ in range(n or R.choice([1, 2, 2, 3, 3, 4, 5, 6]))]
        rows = sum(row_count(c, dimension) for c in contacts)
        columns = tall or R.randint(1, 2 * rows)
        density = R.choice([.3, .7, 1])
        return contacts, [[R.randint(-3, 3) if R.random() < density else 0 for _ in range(columns)]
                          for _ in range(rows)]

    def made(self, dimension, contacts, J, W=None, b=None, y=None):
        R = self.R
        W = W or [R.choice([1, 1, 1, .5, .125]) for _ in J[0]]
        if b is None:
            b = times(J, y or [R.choice([-10, -9.8125, -1, 0, 0, 1, 3]) for _ in J[0]])
        return {"dimension": dimension, "contacts": contacts, "A": [[float(x) for x in row] for row in gram(J, W)],
                "b": [float(x) for x in b]}

    def plain(self, dimension):
        contacts, J = self.parts(dimension)
        wide = self.R.choice([0, 0, 10, 30])
        W = [self.power(wide) for _ in J[0]]
        return self.made(dimension, contacts, J, W)

    def jam(self, dimension):
        """The first contact and one against it, pressed beside what is small."""
        contacts, J = self.parts(dimension)
        rows, heavy = row_count(contacts[0], dimension), 2.0 ** self.R.randint(0, 45)
        J += [[-x for x in row] for row in J[:rows]]
        contacts.append(dict(contacts[0]))
        y = [self.R.randint(-9, 9) * self.R.choice([1, 1, heavy]) for _ in J[0]]
        problem = self.made(dimension, contacts, J, y=y)
        problem["b"][0] -= heavy
        problem["b"][-rows] -= self.R.choice([-heavy, heavy, 0])
        return problem

    def jam_and_third(self, dimension):
        problem = self.jam(dimension)
        return self.combined(problem, self.power(20))

    def shadow(self, dimension):
        """A contact that a tiny b alone acts on, beside what is large."""
        problem = self.jam(dimension) if self.R.random() < .5 else self.plain(dimension)
        rows, R = len(problem["b"]), self.R
        contact = self.kind(dimension, False) if R.random() < .5 else {"kind": "frictionless"}
        count = row_count(contact, dimension)
        linked = [[R.choice([0, 0, self.power(4), -self.power(30)]) for _ in range(count)] for _ in range(rows)]
        own = [[1.0 if i == j else R.choice([0, .25]) for j in range(count)] for i in range(count)]
        own = [[own[min(i, j)][max(i, j)] for j in range(count)] for i in range(count)]
        problem["A"] = [row + more for row, more in zip(problem["A"], linked)]
        problem["A"] += [[linked[i][k] for i in range(rows)] + own[k] for k in range(count)]
        problem["b"] += [-self.R.random() * 2.0 ** -R.randint(5, 45) for _ in range(count)]
        problem["contacts"].append(contact)
        return problem

    def ghosts(self, dimension):
        """Contacts that are thrown apart, beside others that weigh little."""
        contacts, J = self.parts(dimension, max(2, self.R.choice([2, 3, 5, 8])))
        problem = self.made(dimension, contacts, J)
        row = 0
        for contact in contacts:
            if self.R.random() < .5:
                problem["b"][row] = 2.0 ** self.R.randint(5, 40)
            row += row_count(contact, dimension)
        return problem

    def stack(self, dimension, n=None):
        """Bodies on each other, each with some contacts, or between walls."""
        R = self.R
        n, each = n or R.randint(2, 6), R.choice([1, 1, 2]) if n is None else 1
        contacts, J = [], []
        for body in range(n):
            for _ in range(each):
                contacts.append(self.kind(dimension, False))
                for d in range(dimension):
                    J.append([0] * (dimension * n))
                    J[-1][dimension * body + d] = 1
                    if body and R.random() < .95:
                        J[-1][dimension * (body - 1) + d] = -1
        heavy = [R.choice([1, 1, self.power(R.choice([2, 10, 30]))]) for _ in range(n)]
        push = R.choice([0, 0, 1, 4])
        y = [-10 if d == 0 else R.randint(-push, push) for _ in range(n) for d in range(dimension)]
        return self.made(dimension, contacts, J, [w for w in heavy for _ in range(dimension)], y=y)

    def island(self, dimension):
        """Many contacts, each a little from being lawful."""
        n = self.R.choice([12, 20, 30]) // (dimension - 1)
        return self.stack(dimension, n) if self.R.random() < .4 else self.edge(dimension, n)

    def near_singular(self, dimension):
        contacts, J = self.parts(dimension, max(2, self.R.randint(2, 5)), mixed=False)
        off = 2.0 ** -self.R.randint(4, 45)
        for i in range(dimension, len(J)):
            if self.R.random() < .7:
                J[i] = [x + off * self.R.randint(-3, 3) for x in J[i % dimension]]
        return self.made(dimension, contacts, J)

    def unsymmetric(self, dimension):
        problem = self.plain(dimension)
        for _ in range(self.R.randint(1, 4)):
            i, j = (self.R.randrange(len(problem["b"])) for _ in "ij")
            problem["A"][i][j] += self.R.choice([-1, 1, .25]) * self.power(self.R.choice([0, 0, 20]))
        return problem

    def edge(self, dimension, n=None):
        """A lawful answer, then b off by as much as may be excused, or by less, or more."""
        R = self.R
        contacts, J = self.parts(dimension, n, tall=R.choice([None, None, 1, 2, 3]))
        x, a = [], []
        for contact in contacts:
            force, acceleration = self.lawful(contact, dimension)
            x, a = x + force, a + acceleration
        A = gram(J, [1] * len(J[0]))
        b = [v - w for v, w in zip(a, times(A, x))]
        off = 10.0 ** -R.uniform(4, 16)
        size = times([[abs(v) for v in row] for row in A], list(map(abs, x)))
        b = [v + R.choice([0, 0, off, -off]) * R.choice([abs(v), abs(v), s]) for v, s in zip(b, size)]
        return self.made(dimension, contacts, J, [1] * len(J[0]), b)

    def lawful(self, contact, dimension):
        """Forces and accelerations that obey the contact's law."""
        R, count = self.R, row_count(contact, dimension)
        if contact["kind"] == "bilateral":
            return [R.randint(-5, 5)], [0]
        normal = R.choice([0, 0, 1, 3, 2.0 ** R.randint(-30, 30)])
        direction = R.choice([[1, 0], [0, -1], [.6, .8]]) if dimension == 3 else [R.choice([1, -1])]
        if normal == 0:
            return [0] * count, [R.choice([0, 1, 2.0 ** R.randint(-30, 30)])] + [R.randint(-2, 2)] * (count - 1)
        if count == 1:
            return [normal], [0]
        if contact["kind"] == "sliding":
            slip = contact["slip"] if isinstance(contact["slip"], list) else [contact["slip"]]
            return [normal, *(float(-contact["mu"] * normal * Fraction(s)) for s in slip)], [0] + [1] * (count - 1)
        slips = R.choice([0, 0, 1, 2.0 ** R.randint(-40, 10)])
        share = 1 if slips else R.choice([0, .5, 1])
        return [normal, *(share * contact["mu"] * normal * d for d in direction)], [0, *(-slips * d for d in direction)]

    def factored(self, dimension):
        """Of factors J and M, where products cancel."""
        contacts, J = self.parts(dimension, tall=self.R.randint(2, 8))
        M = [self.power(self.R.choice([0, 10, 40])) for _ in J[0]]
        w = [float(self.R.randint(-10, 3)) for _ in J[0]]
        exact = [[Fraction(x) for x in row] for row in J]
        A = gram(exact, [1 / Fraction(m) for m in M])
        return {"dimension": dimension, "contacts": contacts, "A": A, "b": times(exact, [Fraction(x) for x in w]),
                "factors": {"J": J, "M": M, "w": w}}

    # ---- What is changed of a problem -----------------------------------------------------------------------------

    def scale(self, problem, most, contact=None):
        """Other units of force by contact."""
        row = 0
        for k, c in enumerate(problem["contacts"]):
            factor = self.power(most) if contact in (None, k) else 1
            for i in range(row, row + row_count(c, problem["dimension"])):
                problem["b"][i] *= factor
                for j in range(len(problem["b"])):
                    problem["A"][i][j] *= factor
                    problem["A"][j][i] *= factor
            row = i + 1

    def combined(self, problem, factor=1):
        """One more contact, the sum of two."""
        R, kinds = self.R, problem["contacts"]
        counts = [row_count(c, problem["dimension"]) for c in kinds]
        like = [k for k, count in enumerate(counts) if count == counts[0]]
        first = first_rows(problem)
        p, q, s = R.choice(like), R.choice(like), R.choice([-1, 0, 0, 1])
        rows = [[0] * len(problem["b"]) for _ in range(counts[0])]
        for d, row in enumerate(rows):
            row[first[p] + d] += R.choice([1, 1, -1]) * factor
            row[first[q] + d] += s * factor
        side = [times(rows, column) for column in zip(*problem["A"])]  # of column j: what the new rows have there
        corner = [times(rows, [times([x], r)[0] for x in problem["A"]]) for r in rows]
        below = [[side[j][d] for j in range(len(problem["b"]))] for d in range(len(rows))]
        right = [times(problem["A"], r) for r in rows]
        A = [row + [right[d][i] for d in range(len(rows))] for i, row in enumerate(problem["A"])]
        A += [below[d] + [corner[e][d] for e in range(len(rows))] for d in range(len(rows))]
        return {**problem, "contacts": kinds + [dict(kinds[p])], "A": A, "b": problem["b"] + times(rows, problem["b"])}

    def changed(self, problem, forces):
        """Another problem like it."""
        R = self.R
        other = copied(problem)
        for _ in range(R.choice([1, 1, 2, 3])):
            other = self.change(other, forces)
        return other if all(map(is_double, itertools.chain(other["b"], *other["A"]))) else copied(problem)

    def change(self, p, forces):
        R, n = self.R, len(p["b"])
        i, j, what = R.randrange(n), R.randrange(n), R.randrange(9)
        if what == 0:
            p["b"][i] = p["b"][i] * R.choice([0, -1, 2, .5, 1 + 2.0 ** -R.randint(1, 50), self.power(30)])
        elif what == 1 and len(forces) == n:  # b that the forces hold, but for little
            held = -times([p["A"][i]], forces)[0]
            p["b"][i] = held + R.choice([0, 1, -1]) * abs(held) * 10.0 ** -R.uniform(5, 17)
        elif what == 2:
            factor = R.choice([0, -1, 2, 1 + 2.0 ** -R.randint(1, 50), 1 - 2.0 ** -R.randint(1, 50)])
            p["A"][i][j] = p["A"][i][j] * factor
            p["A"][j][i] = p["A"][i][j]
        elif what == 3:
            p["A"][i][j] = p["A"][i][j] + R.choice([-1, 1]) * self.power(20)
        elif what == 4:
            contact = R.choice(p["contacts"])
            if "mu" in contact:
                mu = float(contact["mu"])
                contact["mu"] = R.choice([0, 1, 2 * mu, mu / 2, 10.0 ** R.randint(-3, 12)])
        elif what == 5:
            self.scale(p, R.choice([2, 20, 60]), R.randrange(len(p["contacts"])))
        elif what == 6 and len(p["contacts"]) < 8:
            p = self.combined(p, R.choice([1, 1, self.power(30)]))
        elif what == 7 and len(p["contacts"]) > 1:
            p = without(p, R.randrange(len(p["contacts"])))
        else:
            k, kind = R.randrange(len(p["contacts"])), self.kind(p["dimension"])
            if row_count(kind, p["dimension"]) == row_count(p["contacts"][k], p["dimension"]):
                p["contacts"][k] = kind
        return p


def copied(problem):
    return {"dimension": problem["dimension"], "contacts": [dict(c) for c in problem["contacts"]],
            "A": [list(row) for row in problem["A"]], "b": list(problem["b"])}


def first_rows(problem):
    """The normal rows of the contacts, and behind them the number of rows."""
    counts = (row_count(c, problem["dimension"]) for c in problem["contacts"])
    return list(itertools.accumulate(counts, initial=0))


def without(problem, contact):
    first = first_rows(problem)
    kept = [i for i in range(len(problem["b"])) if not first[contact] <= i < first[contact + 1]]
    return {**copied(problem), "contacts": [dict(c) for k, c in enumerate(problem["contacts"]) if k != contact],
            "A": [[problem["A"][i][j] for j in kept] for i in kept], "b": [problem["b"][i] for i in kept]}


def written(problem):
    def number(x):
        return str(x) if isinstance(x, Fraction) else x
    content = {"format": "stiction-problem", "version": 1, "dimension": problem["dimension"],
               "contacts": [{key: number(x) for key, x in c.items()} for c in problem["contacts"]]}
    if "factors" in problem:
        return json.dumps({**content, "factors": problem["factors"]})
    return json.dumps({**content, "A": [[number(x) for x in row] for row in problem["A"]],
                       "b": [number(x) for x in problem["b"]]})


def simpler(problem):
    if "factors" in problem:
        yield {key: x for key, x in problem.items() if key != "factors"}
    if len(problem["contacts"]) > 1:
        yield from (without(problem, k) for k in range(len(problem["contacts"])))
    rows = len(problem["b"])
    for i, j in itertools.combinations_with_replacement(range(rows), 2):
        for value in dict.fromkeys([0.0, *(float(f"{float(problem['A'][i][j]):.{k}g}") for k in (1, 3))]):
            if 0 in (problem["A"][i][j], problem["A"][j][i]) or len(str(value)) < len(str(problem["A"][i][j])):
                if problem["A"][i][j] != value:
                    other = copied(problem)
                    other["A"][i][j] = other["A"][j][i] = value
                    yield other
    for i in range(rows):
        for value in dict.fromkeys([0.0, *(float(f"{float(problem['b'][i]):.{k}g}") for k in (1, 3))]):
            if len(str(value)) < len(str(problem["b"][i])):
                other = copied(problem)
                other["b"][i] = value
                yield other
