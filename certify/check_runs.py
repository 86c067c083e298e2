#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks certificates of loops: runs the published algorithm of [Baraff94] again, from f = 0.

Sections 4.1-4.3 and 5.2-5.5 of D. Baraff, Fast contact force computation for nonpenetrating rigid bodies,
SIGGRAPH 1994. What a run is, switch by switch, is fixed in solver/published/readings.md, whose sections this
file follows. A certificate names policies, and every step of their run; each is run here, exactly, and compared
step by step with what is stated. Of a `counterexample` only the runs are checked here; check_certificate.py
checks all of it.

  N1, F1, N2, ...   normal and friction variable of each contact; in order, the rows of f and a
  df, da, s         a step of length s adds s df to f and s da to a; da = A df
  C NC CF NC- NC+   the index sets of sections 4.1 and 5.3

Trusted: Python, certificate_reader.py, and this file, which was written from readings.md and shares no code or
tables with the C++.
"""

import json
import sys
from collections import namedtuple
from fractions import Fraction
from functools import lru_cache
from operator import floordiv, truediv

sys.dont_write_bytecode = True  # where it is installed, nothing is to be left behind

from certificate_reader import Cost, dot, exact, fields, integer_rows, items, listed, main, need, planar_contacts, times
import check_runs_in_space

# --- Problems and policies -----------------------------------------------------------

# A planar variable; contact counts from 0; normal and friction are the rows of the contact's two variables,
# friction None unless the contact is static and never row 0.
Variable = namedtuple("Variable", "name contact normal friction mu")


class Rows:
    """What the rows of a planar problem are."""

    def __init__(self, problem):
        self.A, self.b, self.contacts, self.variables = problem.A, problem.b, len(problem.contacts), []
        self.held = []     # of bilateral contacts, which stay in C (4.5)
        self.sliding = {}  # normal row of a sliding contact: the factor of fF = -mu slip fN (24), in the row behind
        for i, contact, span in planar_contacts(problem):
            friction = span[1] if contact.kind == "static" else None
            self.variables += [Variable(f"{letter}{i + 1}", i, span[0], friction, contact.mu)
                               for letter in "NF"[:len(span)]]
            if contact.kind == "bilateral":
                self.held.append(span[0])
            elif contact.kind == "sliding":
                self.sliding[span[0]] = -contact.mu * contact.slip[0]

    def is_passive(self, row):
        """Whether the algorithm never looks at the conditions of this row."""
        return row in self.held or row - 1 in self.sliding


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



def read_policy(text, place="policy", switches=None):
    """A value for every switch, from a policy written canonically; without `switches` one of the plane."""
    switches, of = switches or SWITCHES, "of a policy in space" if switches else "of a planar policy"
    need(type(text) is str, place, text, "a policy")
    policy = {switch: values[0] for switch, values in switches.items()}
    for part in text.split(",") if text != "paper" else []:
        switch, _, value = part.partition("=")
        need(value in switches.get(switch, ()), place, text, f"switches {of}")
        policy[switch] = value
    canonical = ",".join(f"{switch}={value}" for switch, value in policy.items()
                         if value != switches[switch][0]) or "paper"
    need(text == canonical, place, text, f"it written canonically: {canonical}")
    return policy


# --- Directions --------------------------------------------------------------------

def sign(x):
    return (x > 0) - (x < 0)


def solve(M):
    """x with M x = r, given rows [M | r]. An unknown whose column depends linearly on the
    columns before it is zero. None if the system is inconsistent."""
    whole = all(type(x) is Fraction for row in M for x in row)  # otherwise numbers of another field
    divided = floordiv if whole else truediv
    M, n, pivots, minor = integer_rows(M)[0] if whole else M, len(M), [], 1  # all pivots so far are `minor`
    for c in range(n):
        top = len(pivots)
        p = next((i for i in range(top, n) if M[i][c]), None)
        if p is None:
            continue
        M[top], M[p] = M[p], M[top]
        pivot, row = M[top][c], M[top]
        M = [other if i == top else [divided(pivot * x - other[c] * y, minor) for x, y in zip(other, row)]
             for i, other in enumerate(M)]
        pivots.append(c)
        minor = pivot
    if any(row[n] for row in M[len(pivots):]):
        return None
    x = [Fraction(0)] * n
    for row, c in zip(M, pivots):
        x[c] = Fraction(row[n], minor) if whole else row[n] / minor
    return x


@lru_cache(maxsize=1 << 16)
def fdirection(rows, sets, driven, rate):
    """(df, da) while the driven force changes at `rate`; None if there is none."""
    def following(row):
        """Its row and 1, if this force changes; and with a normal its friction in NC+ or NC-, and how much that does."""
        x, along = rows.variables[row], rows.sliding.get(row)
        if row == x.normal and x.friction and sets[x.friction] in ("NC+", "NC-"):
            along = x.mu if sets[x.friction] == "NC+" else -x.mu
        return [(row, 1)] + ([] if along is None else [(row + 1, along)])

    def effect(row):
        column = [line[row] for line in rows.A]
        for other, along in following(row)[1:]:
            column = [x + along * line[other] if line[other] else x for x, line in zip(column, rows.A)]
        return column

    unknown = rows.held + [row for row, where in enumerate(sets)
                              if where in ("C", "CF") and row not in rows.held]
    effects, last = [effect(row) for row in unknown], [rate * x for x in effect(driven)]
    x = solve([[da[row] for da in effects] + [-last[row]] for row in unknown])
    if x is None:
        return None
    df, da = [Fraction(0)] * len(sets), last
    for row, change in [*zip(unknown, x), (driven, Fraction(rate))]:
        for at, along in following(row):
            df[at] += change * along
    for change, column in zip(x, effects):
        if change:
            da = [y + change * z for y, z in zip(da, column)]
    return df, da


def held_forces(rows):
    """The forces of bilateral contacts that keep their accelerations at zero while all others rest, as a
    vector of all rows (readings, section 9); None if the contacts are singular or contradict each other."""
    held, A = rows.held, rows.A
    block = [[A[i][j] for j in held] for i in held]

    def against(values):
        """x with A_BB x + values = 0 in the rows of B."""
        return solve([row + [-values[i]] for i, row in zip(held, block)])

    others = [row for row in range(len(rows.b)) if not rows.is_passive(row)]
    for row in others:  # the force of a sliding contact takes its friction along
        factor = rows.sliding.get(row, 0)
        if against([line[row] + factor * line[row + 1] if factor else line[row] for line in A]) is None:
            return None
    for k, j in enumerate(held):  # a column that depends on those before must have no effect elsewhere
        x = solve([row[:k] + [Fraction(0)] * (len(held) - k) + [row[k]] for row in block])
        if x is not None and any(A[row][j] != dot((A[row][i] for i in held), x) for row in others):
            return None
    x = against(rows.b)
    if x is None:
        return None
    f = [Fraction(0)] * len(rows.b)
    for row, force in zip(held, x):
        f[row] = force
    return f


def zero_at(value, rate):
    """The step after which a quantity >= 0 is zero, if it falls; otherwise None."""
    return value / -rate if rate < 0 else None


# --- The algorithm: sections 4.1-4.3 and 5.2-5.5, as solver/published/readings.md ----

# outcome: cycle, solved, singular, ray, or what on_step ends it with; start, period and state of what recurs;
# every step from f = 0. Steps and state have the keys of a certificate.
Run = namedtuple("Run", "outcome start period pivots state")


class Ended(Exception):
    """The run ends inside a drive: its outcome."""


class Published:
    """The published algorithm under one policy: its state, and the steps made so far."""

    def __init__(self, rows, policy, on_step):
        """on_step(steps) is called after every step, with all made so far; it may raise Ended."""
        self.rows, self.variables, self.policy, self.on_step = rows, rows.variables, policy, on_step
        self.known = rows.__dict__.setdefault("known", {})  # of points that runs under other policies came to
        self.f, self.a = self.remembered_of(self.first_point, "first")
        self.sets = ["C" if row in rows.held else "none" for row in range(len(rows.b))]
        self.last = None  # the contact driven last
        self.drives, self.steps = 0, []

    def first_point(self):
        f = held_forces(self.rows)
        return f, None if f is None else [x + y for x, y in zip(times(self.rows.A, f), self.rows.b)]

    def remembered_of(self, compute, *of, point=()):
        """What is computed of a point f, a: only once of the same one. Whoever takes the same steps comes to it."""
        key = (*map(id, point), *of)
        if key not in self.known:
            self.known[key] = compute(), point  # which stays, and with it its id
        return self.known[key][0]

    # Main loop (readings, section 2).

    def compute_forces(self):
        """The Run that comes of it."""
        if self.f is None:
            return Run("singular", None, None, self.steps, None)
        seen = {}
        while True:
            start = seen.setdefault((*self.sets, *self.f, self.remembered()), self.drives)
            if start < self.drives:
                return Run("cycle", start, self.drives - start, self.steps, self.state())
            self.sweep()
            v = self.scan()
            if v is None:
                return Run("solved", None, None, self.steps, self.state())
            try:
                self.establish(v)
            except Ended as end:
                return Run(end.args[0], None, None, self.steps, None)

    def remembered(self):
        return self.last if self.policy["resume"] == "round" else None

    def state(self):
        state = {"sets": {x.name: where for x, where in zip(self.variables, self.sets)}, "f": self.f}
        return state if self.remembered() is None else {**state, "contact": self.last + 1}

    def establish(self, v):
        if v == self.variables[v].normal or self.f[v] == 0:
            return self.drive(v, "establish")
        self.drive(v, "zero")
        if self.policy["rezero"] == "continue" and self.violated(v):
            self.drive(v, "establish")

    def violated(self, row):
        """A normal that fails (15), or a friction variable that fails (16) while (15) holds."""
        return self.remembered_of(lambda: self.fails(row), row, point=(self.f, self.a))

    def fails(self, row):
        if self.rows.is_passive(row):
            return False
        x = self.variables[row]
        fN, aN = self.f[x.normal], self.a[x.normal]
        holds = fN >= 0 and aN >= 0 and fN * aN == 0
        if row == x.normal or not holds:
            return row == x.normal and not holds
        fF, aF, bound = self.f[row], self.a[row], self.bound_of(row, self.f)
        return not (abs(fF) <= bound and aF * fF <= 0 and aF * (bound - abs(fF)) == 0)

    def sweep(self):
        for row, x in enumerate(self.variables):
            fN = self.f[x.normal]
            if self.sets[row] != "none" or self.rows.is_passive(row):
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
        count, down = self.rows.contacts, self.policy["scan"] == "highest"
        first = self.remembered()
        if first is None:
            first = count - 1 if down else 0
        turn = {(first - k if down else first + k) % count: k for k in range(count)}

        def key(row):
            x = self.variables[row]
            key = turn[x.contact], row != x.normal
            return key[::-1] if self.policy["scan"] == "normals-first" else key

        return sorted(range(len(self.f)), key=key)

    def bound_of(self, row, values):
        """mu fN of a friction variable, of forces or of a change of them."""
        return self.variables[row].mu * values[self.variables[row].normal]

    # Drive (readings, section 3).

    def drive(self, v, goal):
        self.drives += 1
        self.last = self.variables[v].contact
        self.left = [None] * len(self.f)  # the set each variable last left in this drive
        zero = False                      # whether the last step had length zero
        friction = self.variables[v].friction
        if friction and self.sets[friction] == "suspended":
            self.sets[friction] = self.filed(friction)
        j = None
        while j != v:
            s, _, j, into = self.take_step(v, goal)
            before = self.sets[j]
            self.move(j, into, v, zero, s == 0)
            zero = s == 0
            self.steps.append({
                "drive": self.drives, "driven": self.variables[v].name, "goal": goal, "step": s,
                "limiting": self.variables[j].name, "from": before, "to": self.sets[j]})
            self.on_step(self.steps)

    def take_step(self, v, goal):
        """Goes as far as is legal; returns the step, its rank, what limits it, and the set
        that wants into."""
        rate = -sign(self.a[v] if goal == "establish" else self.f[v])
        if v == self.variables[v].normal:
            rate = 1
        first, self.f, self.a = self.remembered_of(lambda: self.step(v, goal, rate), v, goal, self.policy["ties"],
                                                   *self.sets, point=(self.f, self.a))
        return first

    def step(self, v, goal, rate):
        """The first limit, and the point there."""
        change = fdirection(self.rows, tuple(self.sets), v, rate)
        if change is None:
            raise Ended("singular")
        limits = [limit for limit in self.limits(v, goal, *change) if limit[0] is not None]
        if not limits:
            raise Ended("ray")
        first = min(limits, key=lambda limit: limit[:2])  # of equals the one found first
        return first, *([x + first[0] * y for x, y in zip(now, rates)]
                        for now, rates in zip((self.f, self.a), change))

    def limits(self, v, goal, df, da):
        """maxstep: (s, rank among ties, variable, set it wants into); s None: no limit."""
        f, a = self.f, self.a

        def at_bound(row):
            bound, growth = self.bound_of(row, f), self.bound_of(row, df)
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
            if where in found and row not in self.rows.held:
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


def run(rows, policy, on_step):
    """The run from f = 0 under a policy (its canonical text)."""
    return Published(rows, read_policy(policy), on_step).compute_forces()


# --- The claim cycle ---------------------------------------------------------------

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


def check_policy(rows, stated, place, policy):
    """Runs the policy as long as its steps are those stated; returns the run if it is the one stated."""
    steps = listed(stated["pivots"], place + ".pivots")

    def compare(made):
        need(len(made) <= len(steps), place + ".pivots", len(steps), "more steps: no repetition yet",
             f" under {policy}")
        same(steps[len(made) - 1], made[-1], f"{place}.pivots[{len(made) - 1}]", policy)

    found = run(rows, policy, compare)
    need(found.outcome == "cycle", place, "a cycle", f"{found.outcome} after {len(found.pivots)} steps",
         f" under {policy}")
    for key in ("start", "period", "pivots", "state"):
        same(stated[key], getattr(found, key), f"{place}.{key}", policy)
    return found


def steps_operations(n, witness):
    """Of one step more than are stated: most is done once for all policies."""
    operations = 0
    for place, stated in items(witness["runs"], "$.witness.runs"):
        fields(stated, place, "policies", "start", "period", "pivots", "state")
        policies = len(listed(stated["policies"], place + ".policies"))
        steps = len(listed(stated["pivots"], place + ".pivots")) + 1
        operations += steps * (n**3 // 4 + 3 * n**2 + 100 * n + (5 * n + 40) * policies)
    return operations


def check_runs(problem, witness):
    """The runs of a witness; the facts to print."""
    rows, first, runs = Rows(problem), {}, []
    Cost(steps_operations(len(problem.b), witness)).all_rows(problem)
    for place, stated in items(witness["runs"], "$.witness.runs"):
        need(stated["policies"], place + ".policies", [], "at least one policy")
        for at, policy in items(stated["policies"], place + ".policies"):
            read_policy(policy, at)
            need(policy not in first, at, policy, f"no policy twice, see {first.get(policy)}")
            first[policy] = at
            found = check_policy(rows, stated, place, policy)
        need(found not in runs, place, "a run listed before", "no two runs the same")
        runs.append(found)
    need(runs, "$.witness.runs", [], "at least one run")
    facts = [f"policies {len(first)}", f"runs {len(runs)}"]
    for key in ("start", "period"):
        values = sorted({getattr(found, key) for found in runs})
        facts.append(f"{key} {' '.join(map(str, values))}")
    return ", ".join(facts)


def check_cycle(problem, witness):
    """A loop: of runs in the plane, or of one in space."""
    if "runs" in witness:
        return check_runs(problem, witness)
    policy = read_policy(witness["policy"], "$.witness.policy", check_runs_in_space.SWITCHES)
    return check_runs_in_space.check_loop(problem, witness, policy)


def check_ray(problem, witness):
    """In space: a run that comes to a step which nothing limits."""
    policy = read_policy(witness["policy"], "$.witness.policy", check_runs_in_space.SWITCHES)
    return check_runs_in_space.check_ray(problem, witness, policy)


def check_endless(problem, witness):
    """In space: a run that never ends, and repeats no state."""
    policy = read_policy(witness["policy"], "$.witness.policy", check_runs_in_space.SWITCHES)
    return check_runs_in_space.check_loop(problem, witness, policy, repeats=False)


def check_runs_alone(problem, witness):
    return f"its runs only, {check_runs(problem, witness)}"


# --- The program -------------------------------------------------------------------

CYCLE = (" | ".join(["runs", *check_runs_in_space.KEYS]), check_cycle)
RAY = (check_runs_in_space.RAY_KEYS, check_ray)
ENDLESS = (check_runs_in_space.BOX_KEYS, check_endless)
CLAIMS = {"cycle": CYCLE, "ray": RAY, "endless": ENDLESS, "counterexample": ("L D f a runs", check_runs_alone)}

if __name__ == "__main__":
    sys.exit(main(CLAIMS, "Run the published algorithm again, as stiction certificates say that it runs.",
                  "claims: cycle, ray, endless, and the runs of a counterexample; certify/certificates.md says what they "
                  "mean.\n"))
