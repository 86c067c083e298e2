# SPDX-License-Identifier: Apache-2.0
"""Certificates of every claim that ask for as much work as they can: families by size, and others drawn.

Each family is a function of a size, which drives one thing up: rows, entries, digits, exponents, prefixes, policies,
steps, bits, velocities, levels, texts. Most are true claims or nearly true ones, so that a checker has to do all of
the work before it knows. `families` lists them, `drawn` alters them at random. Python standard library only.
"""

import copy
import json
import random

# --- Parts -------------------------------------------------------------------------


def problem(A, b=None, contacts=None, dimension=2):
    """Of frictionless contacts, one a row, unless told otherwise."""
    size = A["size"] if isinstance(A, dict) else len(A)
    return {"format": "stiction-problem", "version": 1, "dimension": dimension,
            "contacts": contacts or [{"kind": "frictionless"}] * size, "A": A, "b": b or ["0"] * size}


def certificate(claim, of, **witness):
    return {"format": "stiction-certificate", "version": 1, "claim": claim, "problem": of, "witness": witness}


def diagonal(size, value="1"):
    return {"size": size, "entries": [[i, i, value] for i in range(size)]}


def empty(size):
    return {"size": size, "entries": []}


def dense(size, value="1", on_diagonal="2"):
    return [[on_diagonal if i == j else value for j in range(size)] for i in range(size)]


def unit_rows(size):
    return [["1" if i == j else "0" for j in range(size)] for i in range(size)]


def static(count, mu="1"):
    return [{"kind": "static", "mu": mu}] * count


# --- Texts, and what stands in no certificate -----------------------------------------


def stuffed(value):
    """A true claim, and something behind it that no claim has."""
    return certificate("symmetric", problem(diagonal(1)), stuffing=value)


def many_zeros(size):
    return stuffed([0] * (size // 2))


def many_lists(size):
    return stuffed([[]] * (size // 3))


def many_objects(size):
    return stuffed([{}] * (size // 3))


def many_keys(size):
    return stuffed({f"{i:x}": 0 for i in range(size // 10)})


def many_texts(size):
    return stuffed([""] * (size // 3))


def one_text(size):
    return stuffed("7" * size)


def levels(size):
    text = json.dumps(stuffed(0))
    return text.replace('"stuffing": 0', '"stuffing": ' + "[" * (size // 2) + "]" * (size // 2))


def many_contacts(size):
    return certificate("symmetric", problem(empty(1), contacts=[{"kind": "bilateral"}] * (size // 22)))


def contacts_of_nothing(size):
    return certificate("symmetric", problem(empty(1), contacts=[{}] * (size // 3)))


def many_prefixes_of_nothing(size):
    return certificate("no-solution", problem(diagonal(1)), prefixes=[{}] * (size // 3))


def many_runs_of_nothing(size):
    return certificate("cycle", problem(diagonal(1)), runs=[{}] * (size // 3))


# --- Sizes of the problem ----------------------------------------------------------------


def rows_without_entries(size):
    n = min(size // 32, 3000)
    return certificate("symmetric", problem(empty(n)))


def rows_by_three(size):
    """A contact in space is three rows for the price of one."""
    n = min(size // 45, 1000)
    return certificate("symmetric", problem(empty(3 * n), contacts=static(n), dimension=3))


def diagonal_rows(size):
    n = min(size // 50, 3000)
    return certificate("symmetric", problem(diagonal(n)))


def dense_zeros(size):
    n = int((size / 4)**0.5)
    return certificate("symmetric", problem(dense(n, "0", "0")))


def dense_numbers(size):
    """Each of five digits, all different."""
    n = int((size / 8)**0.5)
    return certificate("symmetric", problem([[str(10000 + (min(i, j) * n + max(i, j)) % 89999) for j in range(n)]
                                             for i in range(n)]))


def repeated_entries(size):
    return certificate("symmetric", problem({"size": 2, "entries": [[1, 0, "1"]] * (size // 12)}))


# --- Numbers ---------------------------------------------------------------------------


def exponents(size):
    """Of ten thousand digits for eight characters."""
    count = size // 30
    n = int(count**0.5) + 1
    entries = [[k // n, k % n, "1e9999"] for k in range(count)]
    return certificate("symmetric", problem({"size": n, "entries": entries}))


def negative_exponents(size):
    count = size // 30
    n = max(int(count**0.5), 1)
    return certificate("not-symmetric", problem([["1e-9999"] * n for _ in range(n)]), i=0, j=0)


def long_numbers(size):
    count = max(size // 40000, 1)
    return certificate("symmetric", problem({"size": count, "entries": [[i, i, "7" * 39990] for i in range(count)]}))


def long_denominators(size):
    count = max(size // 40000, 1)
    values = ["1/" + "7" * 39000 + str(i) for i in range(count)]
    return certificate("symmetric", problem({"size": count, "entries": [[i, i, x] for i, x in enumerate(values)]}))


def fractions(size):
    n = int((size / 18)**0.5)
    return certificate("in-range", problem([[f"{1000 + i}/{10007 + j}" for j in range(n)] for i in range(n)]),
                       x=[f"{i + 1}/{10007 + i}" for i in range(n)])


# --- Products ------------------------------------------------------------------------------


def product_of(claim, key, size, **more):
    n = int((size / 4.2)**0.5)
    return certificate(claim, problem(dense(n), b=["1"] * n), **{key: ["1"] * n}, **more)


def curvature(size):
    return product_of("not-psd", "x", size, value="-1")


def flat(size):
    return product_of("not-definite", "x", size, value="0")


def in_range(size):
    return product_of("in-range", "x", size)


def not_in_range(size):
    return product_of("not-in-range", "y", size, value="1")


def hypothesis(size):
    return product_of("h", "y", size)


def no_hypothesis(size):
    return product_of("not-h", "v", size, value="-1")


def solution(size):
    n = int((size / 4.2)**0.5)
    return certificate("solution-exists", problem(dense(n)), f=["0"] * n, a=["0"] * n)


def solution_in_space(size):
    n = int((size / 38)**0.5)
    of = problem(dense(3 * n), contacts=static(n), dimension=3)
    return certificate("coulomb-solution", of, f=["0"] * 3 * n, a=["0"] * 3 * n, bound="1")


def long_product(size):
    """Few rows of long numbers: A and x have half of the digits each."""
    n = 20
    digits = min(size // (n * n + n), 39000)
    return certificate("in-range", problem([["7" * digits] * n] * n), x=["3" * digits] * n)


# --- Eliminations ------------------------------------------------------------------------


def by_elimination(claim, n, A, D=None, **more):
    return certificate(claim, problem(A), L=unit_rows(n), D=D or ["1"] * n, **more)


def semidefinite(size):
    n = int((size / 5)**0.5)
    return by_elimination("psd", n, diagonal(n))


def semidefinite_of_nothing(size):
    """L is paid, A is not: rows by the thousand."""
    n = min(int((size / 5)**0.5), 2780)
    return by_elimination("psd", n, empty(n), ["0"] * n)


def semidefinite_unstated(size):
    """L and D are not even lists of the right length."""
    n = min(size // 32, 3000)
    return certificate("psd", problem(empty(n)), L=[], D=[])


def semidefinite_in_full(size):
    """I + the matrix of ones: an entry of column k of L is 1 / (k + 2), D_k = (k + 2) / (k + 1)."""
    n = int((size / 9)**0.5)
    L = [["1" if i == j else f"1/{j + 2}" if j < i else "0" for j in range(n)] for i in range(n)]
    return certificate("psd", problem(dense(n)), L=L, D=[f"{k + 2}/{k + 1}" for k in range(n)])


def definite_in_full(size):
    return {**semidefinite_in_full(size), "claim": "definite"}


def exists_in_full(size):
    made = semidefinite_in_full(size)
    n = len(made["problem"]["b"])
    made["witness"]["y"] = ["0"] * n
    return {**made, "claim": "exists"}


def counterexample_in_full(size):
    made = semidefinite_in_full(size)
    n = len(made["problem"]["b"])
    made["witness"].update(f=["0"] * n, a=["0"] * n, runs=[])
    return {**made, "claim": "counterexample"}


def semidefinite_by_rows(size):
    """A = L L' with L of 0 and 1: numbers stay short."""
    n = int((size / 9)**0.5)
    A = [[str(min(i, j) + 1) for j in range(n)] for i in range(n)]
    return certificate("psd", problem(A), L=[["1" if j <= i else "0" for j in range(n)] for i in range(n)],
                       D=["1"] * n)


def safe_by_condition(size):
    n = int((size / 5)**0.5)
    return certificate("safe-by-condition", problem(dense(n, "0", "1")), scaling=["1"] * n, least="1", most="1")


def safe_by_condition_in_full(size):
    n = int((size / 5)**0.5)
    return certificate("safe-by-condition", problem(dense(n)), scaling=["1"] * n, least="1", most=str(n + 1))


def safe_by_condition_sparse(size):
    n = min(size // 50, 3000)
    return certificate("safe-by-condition", problem(diagonal(n)), scaling=["1"] * n, least="1", most="1")


def unsafe(size):
    n = int((size / 5)**0.5)
    return certificate("unsafe", problem(dense(n)), word=["touch"] * n, determinant=str(n + 1))


def unsafe_sparse(size):
    n = min(size // 55, 3000)
    return certificate("unsafe", problem(diagonal(n)), word=["touch"] * n, determinant="1")


def safe(size):
    """4^k words of k contacts."""
    k = 1
    while 4**(k + 1) * 5 <= size:
        k += 1
    A = dense(2 * k, "0", "1")
    return certificate("safe", problem(A, contacts=static(k)), determinants=["1"] * 4**k)


def safe_of_frictionless(size):
    k = 1
    while 2**(k + 1) * 5 <= size:
        k += 1
    return certificate("safe", problem(dense(k, "0", "1")), determinants=["1"] * 2**k)


# --- Factors of the problem ---------------------------------------------------------------


def factors(claim, rows, velocities, entries, M, w=None, A=None):
    J = {"size": [rows, velocities], "entries": entries}
    return certificate(claim, problem(A or empty(rows)), factors={"J": J, "M": M, "w": w or ["0"] * velocities})


def velocities_untouched(size):
    count = size // 8
    return factors("psd", 1, count, [], ["1"] * count)


def velocities_of_no_masses(size):
    return factors("psd", 1, 2**31 - 2, [], [], ["0"] * (size // 4))


def velocities_of_zero_entries(size):
    """Listed, and zero."""
    count = size // 24
    return factors("psd", 1, count, [[0, j, "0"] for j in range(count)], ["1"] * count)


def velocities_touched(size):
    count = size // 24
    return factors("psd", 1, count, [[0, j, "1"] for j in range(count)], ["1"] * count, A=[[str(count)]])


def velocities_by_rows(size):
    n = min(size // 70, 1500)
    return factors("in-range", n, n, [[i, i, "1"] for i in range(n)], ["1"] * n, A=diagonal(n))


def row_of_all(size):
    """One velocity, which every row touches: A is full."""
    n = int((size / 4.3)**0.5)
    return factors("h", n, 1, [[i, 0, "1"] for i in range(n)], ["1"], A=[["1"] * n] * n)


def block_of_masses(size):
    n = int((size / 4)**0.5)
    return factors("exists", 1, n, [[0, 0, "1"]], [dense(n)], A=[["1"]])


def blocks_of_six(size):
    count = size // 230
    entries = [[0, 6 * k + m, "1"] for k in range(count) for m in range(6)]
    A = [[str(6 * count)]]
    return factors("psd", 1, 6 * count, entries, [unit_rows(6)] * count, A=A)


# --- Words and runs ----------------------------------------------------------------------


def prefixes(size):
    """Two words of one contact each as often as there is room; only the last is false."""
    n = 8
    listed = [{"modes": ["break" if k >> i & 1 else "touch" for i in range(n)], "y": ["1"] + ["0"] * (n - 1)}
              for k in range(size // 130)]
    return certificate("no-solution", problem(dense(n, "0", "0"), b=["-1"] * n), prefixes=listed)


def prefix_of_many(size):
    n = int((size / 4.2)**0.5)
    return certificate("no-solution", problem(dense(n, "0", "0"), b=["-1"] * n),
                       prefixes=[{"modes": [], "y": ["1"] * n}])


def prefixes_of_prefixes(size):
    """Each as long as there are contacts: every shorter one is looked for."""
    n = min(max(int((size / 14)**0.5), 2), 1000)
    listed = [{"modes": ["break"] * (n - 1) + [mode], "y": ["1"] + ["0"] * (n - 1)} for mode in ("break", "touch")]
    return certificate("no-solution", problem(empty(n), b=["-1"] * n), prefixes=listed * (size // (14 * n) or 1))


def idle(of, count):
    """A planar problem, and contacts that nothing pushes."""
    n = len(of["b"])
    A = [row + ["0"] * count for row in of["A"]] + [["0"] * n + row for row in dense(count, "0", "1")]
    return {**of, "contacts": of["contacts"] + [{"kind": "frictionless"}] * count, "A": A,
            "b": of["b"] + ["1"] * count}


def idle_runs(cycle, size):
    """The runs of a true cycle, beside contacts that rest: the longer every step."""
    count = int((size / 4)**0.5)
    runs = copy.deepcopy(cycle["witness"]["runs"])
    first = len(cycle["problem"]["contacts"])
    for run in runs:
        run["state"]["sets"].update({f"N{first + k + 1}": "none" for k in range(count)})
        run["state"]["f"] += ["0"] * count
    return certificate("cycle", idle(cycle["problem"], count), runs=runs)


def steps(size):
    run = {"policies": ["paper"], "start": 0, "period": 1, "pivots": [{}] * (size // 3), "state": {}}
    return certificate("cycle", problem(dense(2, "0", "1"), contacts=static(1)), runs=[run])


def policies(cycle, size):
    """Names that no policy has, and those of a true one over and over."""
    run = copy.deepcopy(cycle["witness"]["runs"][0])
    run["policies"] = (run["policies"] * (size // 20))[:size // 20]
    return certificate("cycle", cycle["problem"], runs=[run])


def word_in_space(loop, size):
    made = copy.deepcopy(loop)
    made["witness"]["word"] = (made["witness"]["word"] * size)[:size // 11]
    return made


def bits_in_space(loop, size):
    made = copy.deepcopy(loop)
    made["witness"]["bits"] = min(size, 4096)
    return made


def idle_in_space(loop, size):
    made = copy.deepcopy(loop)
    of, count = made["problem"], int((size / 4)**0.5)
    n = len(of["b"])
    of["A"] = [row + ["0"] * count for row in of["A"]] + [["0"] * n + row for row in dense(count, "0", "1")]
    of["b"] += ["1"] * count
    of["contacts"] += [{"kind": "frictionless"}] * count
    return made


def coordinates(loop, size):
    made = copy.deepcopy(loop)
    count = size // 12
    if "radii" in made["witness"]:
        made["witness"].update(charts=[0] * count, centre=["0"] * count, radii=["1"] * count)
    return made


def box_of_holds(size):
    """`coulomb-exact` of bilateral contacts: m unknowns, all known."""
    n = int((size / 9)**0.5)
    of = problem(dense(n, "0", "1"), contacts=[{"kind": "bilateral"}] * n, dimension=3)
    return certificate("coulomb-exact", of, modes=["hold"] * n, fixed=[], x=["0"] * n, inverse=unit_rows(n), radius="1")


def box_of_slips(size):
    """Of contacts that slip: four unknowns each."""
    k = max(int((size / (4 * 25))**0.5), 1)
    n, m = 3 * k, 4 * k
    of = problem(dense(n, "0", "1"), b=["-1", "1", "0"] * k, contacts=static(k), dimension=3)
    return certificate("coulomb-exact", of, modes=["slip"] * k, fixed=[], x=["1", "1", "0", "0"] * k,
                       inverse=unit_rows(m), radius="1/1000")


def box_of_fixed(size):
    """All rows but one follow from it."""
    n = int((size / 4.5)**0.5)
    of = problem([["1"] * n] * n, contacts=[{"kind": "bilateral"}] * n, dimension=3)
    fixed = [{"row": i, "f": "0", "weights": ["1"]} for i in range(1, n)]
    return certificate("coulomb-exact", of, modes=["hold"] * n, fixed=fixed, x=["0"], inverse=[["1"]], radius="1")


# --- The list ---------------------------------------------------------------------------


def families(cycle, loops):
    """(name, function of a size in bytes): `cycle`, a true one in the plane; `loops`, claims of runs in space."""
    own = [value for name, value in globals().items() if callable(value) and getattr(value, "__module__", "") == __name__
           and value.__code__.co_varnames[:value.__code__.co_argcount] == ("size",) and name not in PARTS]
    yield from ((family.__name__, family) for family in own)
    for family in (idle_runs, policies):
        yield family.__name__, lambda size, family=family: family(cycle, size)
    for loop in loops:
        for family in (word_in_space, bits_in_space, idle_in_space, coordinates):
            yield f"{family.__name__}: {loop['claim']}", lambda size, family=family, loop=loop: family(loop, size)


PARTS = ("diagonal", "empty", "unit_rows")


# --- Drawn ------------------------------------------------------------------------------

LONG = ("1e9999", "-1e-9999", "7" * 39000, "1/" + "3" * 39000, "1e-9999", "0e9999", "1/1" + "0" * 9999, "0" * 39000)
HUGE = (2**31 - 2, 2**31, 2**63, 3000, 2780, 10**6, -1, 0)


def places(value, most=2000):
    """Some of all (container, key) in a value, wherever they lie."""
    found, containers = [], [value]
    while containers and len(found) < most:
        container = containers.pop()
        for key in (container if isinstance(container, dict) else range(min(len(container), 50))):
            found.append((container, key))
            if isinstance(container[key], (dict, list)):
                containers.append(container[key])
    return found


def altered(draw, made):
    """With a few of its values larger than they were."""
    for _ in range(draw.choice((0, 1, 3, 30))):
        container, key = draw.choice(places(made))
        value = container[key]
        if isinstance(value, str):
            container[key] = draw.choice(LONG)
        elif isinstance(value, int):
            container[key] = draw.choice(HUGE)
        elif isinstance(value, list) and value:
            container[key] = draw.choice((value[:1] * draw.choice((1000, 30000)), value * 2, [], [value]))
    return made


def drawn(draw, listed):
    """One of the families, of any size, altered, or what two of them say in one."""
    made, other = ([draw.choice(listed)[1](int(10**draw.uniform(3, 6)))] for _ in range(2))
    made, other = made[0], other[0]
    if isinstance(made, str) or isinstance(other, str):
        return made
    made = copy.deepcopy(made)
    if draw.random() < 0.3:
        made["problem"] = copy.deepcopy(other["problem"])
    if draw.random() < 0.1:
        made["claim"] = other["claim"]
    return altered(draw, made)
