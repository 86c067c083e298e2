#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`coulomb-exact`: what its checkers refuse, what they may take, and what `certify` shows.

  coulomb_exact_test.py STICTION SOURCES

False certificates for every clause; certificates just below and above what a check may cost; certificates of the
corpus, shown to both checkers, and altered at random. Python standard library only.
"""

import json
import subprocess
import sys
import tempfile
from fractions import Fraction
from math import hypot
from pathlib import Path

sys.dont_write_bytecode = True
import claim_cases
import tamper_test
from claim_cases import certificate, problem, texts
from limits_test import largest, most_bits, number_of

MOST_CONTACTS = 20
LEAST_SHARE = Fraction(9, 10)  # of the problems in space with a solution
RADIUS = Fraction(1, 1000)
UNIT = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def inverse_of(M):
    """By elimination."""
    n = len(M)
    rows = [[Fraction(x) for x in row] + [Fraction(i == j) for j in range(n)] for i, row in enumerate(M)]
    for k in range(n):
        p = next(i for i in range(k, n) if rows[i][k])
        rows[k], rows[p] = rows[p], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        rows = [row if i == k else [x - row[k] * y for x, y in zip(row, rows[k])] for i, row in enumerate(rows)]
    return [row[n:] for row in rows]


def witness(modes, x, slopes, fixed=(), radius=RADIUS, **changes):
    """`slopes`: of the equations at x, whose inverse is taken."""
    listed = [{"row": row, "f": str(f), "weights": texts(weights)} for row, f, weights in fixed]
    return {"modes": modes, "fixed": listed, "x": texts(x), "inverse": texts(inverse_of(slopes)), "radius": str(radius),
            **changes}


def true(what, of, **given):
    claim_cases.true("coulomb-exact", what, of, **given)


def false(what, of, **given):
    claim_cases.false("coulomb-exact", what, of, **given)


def space(laws, A, b):
    return problem(laws, A, b, 3)


# --- One row: modes, and Krawczyk's test where it is linear -----------------------------------------

def pressed(b, law=None):
    """A contact with A = 1, which asks for a force -b."""
    return space([law], [[1]], [b])


true("touches", pressed(-1), **witness(["touch"], [1], [[1]]))
true("holds, pulled", pressed(1, "hold"), **witness(["hold"], [-1], [[1]]))
true("breaks", pressed(1), **witness(["break"], [], []))
true("x is not the zero, which is in the box", pressed(-1), **witness(["touch"], [1 + RADIUS / 2], [[1]]))
false("in the plane", problem([None], [[1]], [-1]), **witness(["touch"], [1], [[1]]))
false("touches, pulled", pressed(1), **witness(["touch"], [-1], [[1]]))
false("touches without force", pressed(0), **witness(["touch"], [0], [[1]]))
false("touches with a force that a part of the box does not have", pressed(-RADIUS), **witness(["touch"], [RADIUS], [[1]]))
false("breaks, pressed", pressed(-1), **witness(["break"], [], []))
false("breaks without acceleration", pressed(0), **witness(["break"], [], []))
false("x is not the zero, which is at the edge of the box", pressed(-1), **witness(["touch"], [1 + RADIUS], [[1]]))
false("x is far from the zero", pressed(-1), **witness(["touch"], [2], [[1]]))
false("x is far from the zero of a contact that holds", pressed(-1, "hold"), **witness(["hold"], [-1], [[1]]))
false("no radius", pressed(-1), **witness(["touch"], [1], [[1]], radius=0))
false("a negative radius", pressed(-1), **witness(["touch"], [1], [[1]], radius=-RADIUS))
false("the inverse is zero", pressed(-1), **witness(["touch"], [1], [[1]], inverse=[["0"]]))
false("the inverse is twice as large", pressed(-1), **witness(["touch"], [1], [[1]], inverse=[["2"]]))
false("more unknowns than there are", pressed(-1), **witness(["touch"], [1, 1], [[1, 0], [0, 1]]))
false("no unknowns", pressed(-1), **witness(["touch"], [], []))
false("no modes", pressed(-1), **witness([], [1], [[1]]))
false("a mode too many", pressed(-1), **witness(["touch", "touch"], [1], [[1]]))
false("a mode of another kind of contact: hold", pressed(-1), **witness(["hold"], [1], [[1]]))
false("a mode of another kind of contact: stick", pressed(-1), **witness(["stick"], [1], [[1]]))

COUPLED = space([None, None], [[2, 1], [0, 1]], [-3, -1])
true("A that is not symmetric", COUPLED, **witness(["touch", "touch"], [1, 1], [[2, 1], [0, 1]]))
false("the inverse of the transpose", COUPLED, **witness(["touch", "touch"], [1, 1], [[2, 0], [1, 1]]))
false("the last unknown is elsewhere", COUPLED, **witness(["touch", "touch"], [1, 2], [[2, 1], [0, 1]]))
true("the other breaks", space([None, None], [[1, 1], [1, 2]], [-1, 1]), **witness(["touch", "break"], [1], [[1]]))
false("the other breaks, and the force presses it", space([None, None], [[1, -2], [-2, 5]], [-1, 1]),
      **witness(["touch", "break"], [1], [[1]]))
false("the other breaks in a part of the box only", space([None, None], [[1, -2], [-2, 5]], [-1, 2 + RADIUS]),
      **witness(["touch", "break"], [1], [[1]]))

# --- Friction ----------------------------------------------------------------------------------------

true("slides", space([("1/2", ["3/5", "4/5"])], UNIT, [-1, 0, 0]), **witness(["touch"], [1], [[1]]))
DRAGGED = [[2, 1, 0], [1, 2, 0], [0, 0, 1]]
true("slides, and friction presses", space([("1/2", ["1", "0"])], DRAGGED, [-3, 0, 0]),
     **witness(["touch"], [2], [[Fraction(3, 2)]]))
false("slides, without its friction", space([("1/2", ["1", "0"])], DRAGGED, [-3, 0, 0]),
      **witness(["touch"], [Fraction(3, 2)], [[2]]))
true("static without friction", space([0], UNIT, [-1, 3, 4]), **witness(["touch"], [1], [[1]]))
false("static without friction sticks", space([0], UNIT, [-1, 0, 0]), **witness(["stick"], [1, 0, 0], UNIT))
false("static without friction slips", space([0], UNIT, [-1, 3, 4]),
      **witness(["slip"], [1, Fraction(3, 5), Fraction(4, 5), 5], [[int(i == j) for i in range(4)] for j in range(4)]))

true("sticks", space([1], UNIT, [-1, Fraction(1, 2), 0]), **witness(["stick"], [1, Fraction(-1, 2), 0], UNIT))
for name, b in (("outside of its cone", [2, 0]), ("outside by the second tangent", [0, 2]),
                ("outside by both tangents", [Fraction(4, 5), Fraction(4, 5)]), ("at the edge of its cone", [1, 0]),
                ("at the edge by both tangents", [Fraction(3, 5), Fraction(4, 5)])):
    false(f"sticks {name}", space([1], UNIT, [-1, *b]), **witness(["stick"], [1, *(-x for x in b)], UNIT))
false("sticks in the opposite of its cone", space([1], UNIT, [1, 0, 0]), **witness(["stick"], [-1, 0, 0], UNIT))
false("touches with friction", space([1], UNIT, [-1, 0, 0]), **witness(["touch"], [1], [[1]]))
false("sticks, drawn by its second tangent", space([1], UNIT, [-1, 0, Fraction(1, 2)]),
      **witness(["stick"], [1, 0, 0], UNIT))


def slipping(fN, c, s, v, mu=1):
    """Slopes of aN, c^2 + s^2 - 1, aF - v (c, s) with A = 1."""
    return [[1, 0, 0, 0], [0, 2 * c, 2 * s, 0], [-mu * c, -mu * fN - v, 0, -c], [-mu * s, 0, -mu * fN - v, -s]]


def slip(what, kind, b=(-1, 3, 4), x=(1, Fraction(3, 5), Fraction(4, 5), 4), slopes=None, **changes):
    kind(what, space([1], UNIT, b), **witness(["slip"], x, slopes or slipping(*x), **changes))


slip("slips", true)
slip("slips, not quite in the middle of the box", true, x=(1, Fraction(3, 5) + RADIUS / 4, Fraction(4, 5), 4))
slip("slips along its friction", false, x=(1, Fraction(-3, 5), Fraction(-4, 5), -6))
slip("slips without speed", false, b=(-1, Fraction(3, 5), Fraction(4, 5)), x=(1, Fraction(3, 5), Fraction(4, 5), 0))
slip("slips, pulled", false, b=(1, 3, 4), x=(-1, Fraction(3, 5), Fraction(4, 5), 6))
slip("slips with a direction longer than 1", false, x=(1, Fraction(6, 5), Fraction(8, 5), Fraction(3, 2)))
slip("slips, the second tangent elsewhere", false, b=(-1, 3, 5))
slip("slips, the first tangent elsewhere", false, b=(-1, 4, 4))
slip("slips, with a box too large for its test", false, radius=1)
slip("slips, with a box so large that contacts separate in it", false, radius=2)
slip("slips, the inverse of another point", false, slopes=slipping(1, 1, 0, 1))

# --- Forces that are given ---------------------------------------------------------------------------

TWINS = space([None, None], [[1, 1], [1, 1]], [-2, -2])
true("two share a force", TWINS, **witness(["touch", "touch"], [Fraction(3, 2)], [[1]], [(1, Fraction(1, 2), [1])]))
true("the first is given", TWINS, **witness(["touch", "touch"], [Fraction(3, 2)], [[1]], [(0, Fraction(1, 2), [1])]))
BLOCK = [[1, 1], [1, 1]]
false("the given force pulls", TWINS, **witness(["touch", "touch"], [3], [[1]], [(1, -1, [1])]))
false("the given force is zero", TWINS, **witness(["touch", "touch"], [2], [[1]], [(1, 0, [1])]))
false("the other pulls", TWINS, **witness(["touch", "touch"], [-1], [[1]], [(1, 3, [1])]))
false("the sum is another", TWINS, **witness(["touch", "touch"], [1], [[1]], [(1, 2, [1])]))
false("other weights", TWINS, **witness(["touch", "touch"], [1], [[1]], [(1, 1, [2])]))
false("the weights do not fit b", space([None, None], BLOCK, [-2, -3]),
      **witness(["touch", "touch"], [1], [[1]], [(1, 1, [1])]))
false("the weights do not fit a column of A", space([None, None], [[1, 1], [1, 2]], [-2, -2]),
      **witness(["touch", "touch"], [1], [[1]], [(1, 1, [1])]))
false("they fit A', not A", space([None, None], [[1, 0], [1, 0]], [-1, 0]),
      **witness(["touch", "touch"], [1], [[1]], [(1, 1, [0])]))
false("a column of a contact that breaks does not fit", space([None, None, None], [[1, 1, 1], [1, 1, 0], [1, 0, 9]], [-2, -2, 9]),
      **witness(["touch", "touch", "break"], [1], [[1]], [(1, 1, [1])]))
false("the same row twice", TWINS, **witness(["touch", "touch"], [1], [[1]], [(1, 1, [1]), (1, 1, [1])]))
false("no weights", TWINS, **witness(["touch", "touch"], [1], [[1]], [(1, 1, [])]))
false("a weight too many", TWINS, **witness(["touch", "touch"], [1], [[1]], [(1, 1, [1, 0])]))
false("no such row", TWINS, **witness(["touch", "touch"], [1], [[1]], [(2, 1, [1])]))
false("a row of a contact that breaks", space([None, None], [[1, 0], [0, 0]], [-1, 0]),
      **witness(["touch", "break"], [1], [[1]], [(1, 1, [0])]))
TRIPLETS = space([None] * 3, [[1] * 3] * 3, [-3] * 3)
true("three share a force", TRIPLETS, **witness(["touch"] * 3, [1], [[1]], [(1, 1, [1]), (2, 1, [1])]))
false("rows not in their order", TRIPLETS, **witness(["touch"] * 3, [1], [[1]], [(2, 1, [1]), (1, 1, [1])]))
false("all rows given", TWINS, **witness(["touch", "touch"], [], [], [(0, 1, []), (1, 1, [])]))
false("friction of a contact that slips is given", space([1], UNIT, [-1, 3, 4]),
      **witness(["slip"], [1, Fraction(3, 5), Fraction(4, 5), 4], slipping(1, Fraction(3, 5), Fraction(4, 5), 4),
                [(1, 1, [0])]))


# --- What a check may cost ---------------------------------------------------------------------------

def dearest(size=60):
    """Contacts beside each other: b counts once, x twice, each number with a bit for its denominator; 8 bits are
    those of no friction, of Y and of no weights."""
    square = size**2 + 64 * size + 320
    operations = 4 * square // 16 + (2 * size + 4) * square // 16
    unit = texts([[int(i == j) for j in range(size)] for i in range(size)])
    A = {"size": size, "entries": [[i, i, "1"] for i in range(size)]}

    def made(bits):
        x = number_of(bits + 2)
        of = {**space([None] * size, [], []), "A": A, "b": ["-" + x] + ["-2"] * (size - 1)}
        return certificate("coulomb-exact", of, {
            "modes": ["touch"] * size, "fixed": [], "x": [x] + ["2"] * (size - 1), "inverse": unit, "radius": "1"})

    return largest(made, lambda bits, of: 3 * (bits + 2) + 8 <= most_bits(of, operations))


def check_cost(checkers, folder, failures):
    for certificate, accepted in zip(dearest(), (True, False)):
        file = folder / "dearest.json"
        file.write_text(json.dumps(certificate))
        for name, command in checkers:
            if "check_runs" not in name and claim_cases.verdicts(command, [file]) != [accepted]:
                failures.append(f"dearest: {name}: expected {'accepted' if accepted else 'a refusal'}")


# --- What certify shows ------------------------------------------------------------------------------

def problems_in_space(stiction, sources, folder):
    for scene in sorted(Path(sources, "corpus/scenes/space").glob("*.json")):
        subprocess.run([stiction, "assemble", scene, "-o", folder / scene.name], capture_output=True)
    files = [*folder.glob("*.json"), *Path(sources, "corpus/space").glob("*.json"),
             *Path(sources, "corpus/space/critical").glob("*.json")]
    for file in sorted(files, key=lambda file: file.name):
        if len(json.loads(file.read_text())["contacts"]) <= MOST_CONTACTS:
            yield file


def certified(stiction, file):
    """The certificate; None where nothing is shown, which the program says why."""
    done = subprocess.run([stiction, "certify", file, "--claim", "coulomb-exact", "-o", "-"], capture_output=True, text=True)
    if done.returncode == 0:
        return json.loads(done.stdout)
    assert done.returncode == 3 and "coulomb-exact: not decided: " in done.stderr, (file, done.returncode, done.stderr)
    return None


def centre(of, given):
    """Forces in the middle of the box, and their accelerations, in doubles."""
    x, fixed = iter(map(float, map(Fraction, given["x"]))), {item["row"]: item["f"] for item in given["fixed"]}
    f, row = [0.0] * len(of["b"]), 0
    for contact, mode in zip(of["contacts"], given["modes"]):
        mu = float(Fraction(contact.get("mu", 0)))
        for k in range(row, row + {"break": 0, "stick": 3}.get(mode, 1)):
            f[k] = float(Fraction(fixed[k])) if k in fixed else next(x)
        along = [next(x), next(x)] if mode == "slip" else [float(Fraction(u)) for u in contact.get("slip", [])]
        if mode == "slip":
            next(x)
        for k, u in enumerate(along):
            f[row + 1 + k] = -mu * f[row] * u
        row += 3 if contact["kind"] in ("static", "sliding") else 1
    A = [[float(Fraction(entry)) for entry in line] for line in of["A"]]
    return f, [sum(map(float.__mul__, line, f)) + float(Fraction(free)) for line, free in zip(A, of["b"])]


def near_law(certificate, original):
    """Whether the middle of the box meets Coulomb's law nearly: no alteration that matters is as small as the box."""
    of = certificate["problem"]
    f, a = centre(of, certificate["witness"])
    row, small = 0, 1e-6 * max(map(abs, f + a + [1e-300]))
    for contact in of["contacts"]:
        mu, size = float(Fraction(contact.get("mu", 0))), 3 if contact["kind"] in ("static", "sliding") else 1
        fN, aN, fF, aF = f[row], a[row], f[row + 1:row + size], a[row + 1:row + size]
        row += size
        if contact["kind"] == "bilateral":
            holds = abs(aN) <= small
        else:
            holds = min(fN, aN) >= -small and min(abs(fN), abs(aN)) <= small
        if contact["kind"] == "static":
            speed, power = hypot(*aF), sum(map(float.__mul__, fF, aF))
            holds = holds and hypot(*fF) <= mu * fN + small and power <= (small - mu * fN) * speed + small * small
        if not holds:
            return False
    return True


def check_corpus(stiction, sources, folder, failures):
    """Certificates by name."""
    shown, count = {}, 0
    for file in problems_in_space(stiction, sources, folder):
        solved = subprocess.run([stiction, "solve", file, "--arithmetic", "double"], capture_output=True).returncode == 0
        count += solved
        certificate = certified(stiction, file)
        if certificate is not None:
            shown[file.stem] = certificate
            if not near_law(certificate, certificate):
                failures.append(f"{file.name}: the middle of the box is no solution")
    print(f"{len(shown)} of {count} problems of the corpus in space that doubles solve, of up to {MOST_CONTACTS} contacts")
    if len(shown) < LEAST_SHARE * count:
        failures.append(f"only {len(shown)} of {count} problems in space are certified")
    return shown


ALTERED = ("cube-rests-on-four-corners", "ray-under-slip-literal", "cycle-of-a-scene-4-contacts", "ball-slides-then-rolls",
           "tripod")


def main(stiction, sources):
    status, failures = claim_cases.main(stiction, sources), []
    checkers = claim_cases.checkers_of(stiction, sources)
    script = tamper_test.load_script(Path(sources) / "certify")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        check_cost(checkers, folder, failures)
        (folder / "scenes").mkdir()
        shown = check_corpus(stiction, sources, folder / "scenes", failures)
        for case, certificate in shown.items():
            if not script.reader.check(certificate, script.CLAIMS):
                failures.append(f"{case}: check_certificate.py refuses it")
        for case in ALTERED:
            refused, accepted = tamper_test.judge(stiction, script, folder, shown[case], failures, near_law)
            print(f"{case}: {refused} refused, {accepted} accepted that are true")
            if refused < 100 // tamper_test.SHARE:
                failures.append(f"{case}: only {refused} altered certificates refused")
    for failure in failures[:50]:
        print("FAILED:", failure)
    return 1 if failures or status else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
